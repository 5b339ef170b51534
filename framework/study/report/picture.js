// One picture in a frame that the shared zoom moves: a row's, its heat map, or the reference.

const REFERENCE = "";  // a choice that no setting can have: settings have names

/// {index, title}: which picture shows a choice in the current view; index null where there is none.
function picture_of(choice, heat = state.heat) {
  if (choice === REFERENCE) return { index: data.views[state.view]?.reference ?? null, title: "reference" };
  const row = find_row(state.view, choice);
  if (heat && row?.heat_map !== null && row !== null) return { index: row.heat_map, title: `${choice}: heat map` };
  return { index: row?.picture ?? null, title: choice };
}

/// Settings of the view that have a picture, the reference first where it has one.
function picture_choices() {
  const choices = rows_of_view(state.view).filter((row) => row.picture !== null).map((row) => row.setting);
  return data.views[state.view]?.reference !== null ? [REFERENCE, ...choices] : choices;
}

function show_picture(holder, picture) {
  if (picture.index === null) {
    holder.replaceChildren(el("div", { class: "missing" }, `no picture of ${picture.title}`));
    return;
  }
  const shown = holder.querySelector("img");
  if (shown?.dataset.index === String(picture.index)) {
    shown.alt = picture.title;
    return;
  }
  holder.replaceChildren(el("img", { src: picture_uri(picture.index), alt: picture.title, "data-index": picture.index, draggable: "false", decoding: "async" }));
}

/// Gives the frame the shape of the first picture that it shows, and says when texels are larger than pixels.
function fit_picture(viewport, height_limit) {
  const image = viewport.querySelector("img");
  if (!image) {
    viewport.style.aspectRatio = "4 / 3";
    return;
  }
  const apply = () => {
    if (image.naturalWidth === 0) return;
    viewport.style.aspectRatio = `${image.naturalWidth} / ${image.naturalHeight}`;
    if (height_limit) viewport.style.width = `min(100%, ${height_limit} * ${image.naturalWidth / image.naturalHeight})`;
    mark_magnified(viewport);
  };
  if (image.complete) apply();
  image.addEventListener("load", apply, { once: true });
}

function mark_magnified(viewport) {
  const image = viewport.querySelector("img");
  if (!image || image.naturalWidth === 0) return;
  viewport.classList.toggle("pixelated", (viewport.clientWidth * zoom.scale) / image.naturalWidth >= 1.5);
}

/// Red, green and blue of one pixel, 0..255, as the PNG holds them.
class PixelReader {
  constructor() {
    this.canvases = new Map();
  }

  read(image, x, y) {
    if (!image?.complete || image.naturalWidth === 0) return null;
    const column = Math.min(image.naturalWidth - 1, Math.floor(x * image.naturalWidth));
    const line = Math.min(image.naturalHeight - 1, Math.floor(y * image.naturalHeight));
    return { column, line, colour: [...this.context(image).getImageData(column, line, 1, 1).data].slice(0, 3) };
  }

  context(image) {
    let context = this.canvases.get(image.dataset.index);
    if (!context) {
      const canvas = el("canvas", { width: image.naturalWidth, height: image.naturalHeight });
      context = canvas.getContext("2d", { willReadFrequently: true });
      context.drawImage(image, 0, 0);
      this.canvases.set(image.dataset.index, context);
    }
    return context;
  }
}
