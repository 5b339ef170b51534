// One zoom for all pictures: a scale and the point of the picture, 0..1, that stands in the middle.

const MOST_ZOOM = 64;
const zoom = { scale: 1, x: 0.5, y: 0.5, root: null, listeners: [] };

function set_zoom(scale, x, y) {
  zoom.scale = Math.min(MOST_ZOOM, Math.max(1, scale));
  const half = 0.5 / zoom.scale;
  zoom.x = Math.min(1 - half, Math.max(half, x));
  zoom.y = Math.min(1 - half, Math.max(half, y));
  const shift = (centre) => `${((0.5 - centre * zoom.scale) * 100).toFixed(4)}%`;
  zoom.root.style.setProperty("--zoom", `translate(${shift(zoom.x)}, ${shift(zoom.y)}) scale(${zoom.scale.toFixed(4)})`);
  zoom.root.classList.toggle("zoomed", zoom.scale > 1);
  for (const listener of zoom.listeners) listener();
}

/// Scales by `factor` so that the point (u, v) of the viewport, 0..1, keeps its place.
function zoom_at(factor, u, v) {
  const scale = Math.min(MOST_ZOOM, Math.max(1, zoom.scale * factor));
  const under_x = zoom.x + (u - 0.5) / zoom.scale;
  const under_y = zoom.y + (v - 0.5) / zoom.scale;
  set_zoom(scale, under_x - (u - 0.5) / scale, under_y - (v - 0.5) / scale);
}

/// The point of the picture, 0..1, under a pointer.
function picture_point(viewport, event) {
  const box = viewport.getBoundingClientRect();
  return [zoom.x + ((event.clientX - box.left) / box.width - 0.5) / zoom.scale, zoom.y + ((event.clientY - box.top) / box.height - 0.5) / zoom.scale];
}

function zoom_keys(event) {
  const step = 0.1 / zoom.scale;
  const actions = {
    "+": () => zoom_at(1.5, 0.5, 0.5), "=": () => zoom_at(1.5, 0.5, 0.5), "-": () => zoom_at(1 / 1.5, 0.5, 0.5), 0: () => set_zoom(1, 0.5, 0.5),
    ArrowLeft: () => set_zoom(zoom.scale, zoom.x - step, zoom.y), ArrowRight: () => set_zoom(zoom.scale, zoom.x + step, zoom.y),
    ArrowUp: () => set_zoom(zoom.scale, zoom.x, zoom.y - step), ArrowDown: () => set_zoom(zoom.scale, zoom.x, zoom.y + step),
  };
  const action = actions[event.key];
  if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key.startsWith("Arrow") && zoom.scale === 1) return;
  event.preventDefault();
  action();
}

/// The wheel turns pages as well: it zooms a picture of the grid only while that has the focus or Ctrl is held, and a
/// whole picture never swallows the wheel's way out.
function zoom_wheel(viewport, eager) {
  return (event) => {
    if (!eager && !event.ctrlKey && !viewport.contains(document.activeElement)) return;
    if (zoom.scale === 1 && event.deltaY > 0) return;
    event.preventDefault();
    const box = viewport.getBoundingClientRect();
    const factor = Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.002));
    zoom_at(factor, (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  };
}

/// Lets keys, wheel and drag move the zoom. `eager`: the wheel needs no focus.
function add_zoom(viewport, eager) {
  viewport.addEventListener("keydown", (event) => event.target === viewport && zoom_keys(event));
  viewport.addEventListener("wheel", zoom_wheel(viewport, eager), { passive: false });
  viewport.addEventListener("pointerdown", (event) => {
    if (zoom.scale === 1 || event.button !== 0 || event.target.closest("[role=slider]")) return;
    viewport.setPointerCapture(event.pointerId);
    let [last_x, last_y] = [event.clientX, event.clientY];
    const move = (now) => {
      const box = viewport.getBoundingClientRect();
      set_zoom(zoom.scale, zoom.x - (now.clientX - last_x) / box.width / zoom.scale, zoom.y - (now.clientY - last_y) / box.height / zoom.scale);
      [last_x, last_y] = [now.clientX, now.clientY];
    };
    const end = () => {
      viewport.removeEventListener("pointermove", move);
      viewport.removeEventListener("pointerup", end);
      viewport.removeEventListener("pointercancel", end);
    };
    viewport.addEventListener("pointermove", move);
    viewport.addEventListener("pointerup", end);
    viewport.addEventListener("pointercancel", end);
  });
}
