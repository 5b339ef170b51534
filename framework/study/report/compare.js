// Two pictures on one another with a slider between them.

class Compare {
  constructor(container) {
    this.split = 50;
    this.reader = new PixelReader();
    this.bottom = el("div", { class: "bottom" });
    this.top = el("div", { class: "top" });
    this.tags = ["left", "right"].map((side) => el("span", { class: `tag ${side}` }));
    this.handle = el("div", { class: "handle", role: "slider", tabindex: "0", "aria-valuemin": "0", "aria-valuemax": "100", "aria-orientation": "horizontal", "aria-label": "Border between the two pictures" });
    this.stage = el("div", { class: "viewport stage", tabindex: "0", role: "group", "aria-label": "Two pictures; + and − zoom, 0 shows all, arrow keys pan" }, this.bottom, this.top, this.tags, this.handle);
    this.probe = el("p", { class: "probe" });
    this.note = el("p", { class: "hint" });
    this.pickers = el("div", { class: "controls" });
    container.append(this.pickers, this.stage, this.probe, this.note);
    this.listen();
    on_change(() => this.update());
    zoom.listeners.push(() => mark_magnified(this.stage));
    new ResizeObserver(() => requestAnimationFrame(() => mark_magnified(this.stage))).observe(this.stage);
    this.update();
    this.set_split(50);
  }

  listen() {
    add_zoom(this.stage, true);
    this.handle.addEventListener("keydown", (event) => this.key(event));
    const follow = (event) => this.set_split(((event.clientX - this.stage.getBoundingClientRect().left) / this.stage.clientWidth) * 100);
    this.stage.addEventListener("pointerdown", (event) => {
      const on_handle = event.target === this.handle;
      if (event.button !== 0 || (zoom.scale > 1 && !on_handle)) return;
      this.stage.setPointerCapture(event.pointerId);
      this.handle.focus({ preventScroll: true });
      event.preventDefault();
      follow(event);
      this.stage.addEventListener("pointermove", follow);
    });
    for (const end of ["pointerup", "pointercancel"]) this.stage.addEventListener(end, () => this.stage.removeEventListener("pointermove", follow));
    this.stage.addEventListener("pointermove", (event) => this.show_pixel(event));
    this.stage.addEventListener("pointerleave", () => (this.probe.textContent = ""));
  }

  key(event) {
    const step = event.shiftKey ? 10 : 1;
    const to = { ArrowLeft: this.split - step, ArrowDown: this.split - step, ArrowRight: this.split + step, ArrowUp: this.split + step, PageDown: this.split - 10, PageUp: this.split + 10, Home: 0, End: 100 }[event.key];
    if (to === undefined) return zoom_keys(event);
    event.preventDefault();
    this.set_split(to);
  }

  set_split(percent) {
    this.split = Math.min(100, Math.max(0, percent));
    this.stage.style.setProperty("--split", `${this.split}%`);
    const rounded = Math.round(this.split);
    this.handle.setAttribute("aria-valuenow", rounded);
    this.handle.setAttribute("aria-valuetext", `${rounded} % ${this.tags[0].textContent}, ${100 - rounded} % ${this.tags[1].textContent}`);
  }

  picker(label, value, on_pick) {
    const options = picture_choices().map((choice) => [choice, choice === REFERENCE ? "reference" : choice]);
    return el("label", null, label, select_box(options, value, on_pick));
  }

  choices() {
    const known = picture_choices();
    const left = known.includes(state.left) ? state.left : (known[0] ?? REFERENCE);
    const right = known.includes(state.setting) && !state.reference_right ? state.setting : state.reference_right ? REFERENCE : (known[1] ?? left);
    return [left, right];
  }

  update() {
    const [left, right] = this.choices();
    const focused = [...this.pickers.querySelectorAll("select, input")].indexOf(document.activeElement);
    const has_heat = rows_of_view(state.view).some((row) => row.heat_map !== null);
    this.pickers.replaceChildren(
      this.picker("Left", left, (choice) => change({ left: choice })),
      this.picker("Right", right, (choice) => change(choice === REFERENCE ? { reference_right: true } : { reference_right: false, setting: choice })),
      has_heat ? checkbox("heat maps", state.heat, (on) => change({ heat: on })) : "", has_heat && state.heat ? magma_key() : "", zoom_buttons());
    if (focused >= 0) this.pickers.querySelectorAll("select, input")[focused]?.focus({ preventScroll: true });
    const pictures = [left, right].map((choice) => picture_of(choice));
    show_picture(this.bottom, pictures[0]);
    show_picture(this.top, pictures[1]);
    this.tags.forEach((tag, i) => (tag.textContent = pictures[i].title));
    fit_picture(this.stage, "74vh");
    this.set_split(this.split);
    const view = data.views[state.view];
    const noise = view && finite(view.relmse) && view.relmse > 0 ? ` Its own noise is about ${number_text(view.relmse)} relMSE.` : "";
    this.note.textContent = view?.reference === null || !view ? "There is no picture of a reference here." : `Reference: ${view.note || "as the study names it"}.${noise}`;
  }

  show_pixel(event) {
    const [x, y] = picture_point(this.stage, event);
    const read = [this.bottom, this.top].map((holder) => this.reader.read(holder.querySelector("img"), x, y));
    if (!read[0] || x < 0 || y < 0 || x >= 1 || y >= 1) return;
    const text = (pixel, tag) => {
      if (!pixel) return [];
      const swatch = el("span", { class: "swatch" });
      swatch.style.background = `rgb(${pixel.colour.join(" ")})`;
      return ["  ", swatch, `${tag.textContent} ${pixel.colour.join(" ")}`];
    };
    this.probe.replaceChildren(`pixel ${read[0].column}, ${read[0].line}`, ...text(read[0], this.tags[0]), ...text(read[1], this.tags[1]));
  }
}

function magma_key() {
  return el("span", { class: "magma" }, "FLIP 0", el("i"), "1, the same scale everywhere");
}

function zoom_buttons() {
  const level = el("span", { class: "zoom-level", role: "status" });
  const show = () => (level.textContent = `${number_text(zoom.scale, 2)}×`);
  zoom.level = show;
  const button = (text, label, action) => el("button", { type: "button", "aria-label": label, onclick: action }, text);
  show();
  return el("span", { class: "zoom-buttons" }, button("−", "Zoom out", () => zoom_at(1 / 1.5, 0.5, 0.5)), level, button("+", "Zoom in", () => zoom_at(1.5, 0.5, 0.5)), button("All", "Show the whole picture", () => set_zoom(1, 0.5, 0.5)));
}
