// Every picture of the view beside the others, under the same zoom.

class PictureGrid {
  constructor(container) {
    this.cells = el("div", { class: "cells" });
    container.append(el("h3", null, "All settings"), el("p", { class: "hint" }, "All pictures share one zoom. Click one to focus it; then the wheel, + − 0, the arrow keys and dragging move them all (Ctrl and the wheel without a click)."), this.cells);
    zoom.listeners.push(() => this.mark());
    on_change(() => this.update());
    this.update();
  }

  cell(choice) {
    const row = choice === REFERENCE ? null : find_row(state.view, choice);
    const picture = picture_of(choice);
    const viewport = el("div", { class: "viewport", tabindex: "0", role: "group", "aria-label": `${picture.title}; + and − zoom all pictures` });
    show_picture(viewport, picture);
    fit_picture(viewport);
    add_zoom(viewport, false);
    const name = row ? el("button", { type: "button", onclick: () => change({ setting: choice, reference_right: false }) }, choice) : el("b", null, "reference");
    const value = row && main_metric && row.metrics[main_metric.name] ? el("span", { class: "value" }, `${main_metric.label} ${estimate_text(row.metrics[main_metric.name])}`) : null;
    return el("figure", { "data-choice": choice }, viewport, el("figcaption", null, name, value));
  }

  update() {
    const key = `${state.view} ${state.heat}`;
    if (key !== this.key) this.cells.replaceChildren(...picture_choices().map((choice) => this.cell(choice)));
    this.key = key;
    for (const figure of this.cells.children) figure.classList.toggle("selected", figure.dataset.choice === state.setting);
  }

  mark() {
    for (const viewport of this.cells.querySelectorAll(".viewport")) mark_magnified(viewport);
    zoom.level?.();
  }
}
