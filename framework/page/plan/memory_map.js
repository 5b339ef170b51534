// Bytes against steps, a heap at a time.

const MAP_HEIGHT = 300;

/// Bytes that are live in each step.
function live_bytes(values) {
  return plan.steps.map((_, step) =>
    values.filter((value) => value.first_step <= step && step <= value.last_step).reduce((sum, value) => sum + value.place.bytes, 0));
}

class MemoryMap {
  constructor(body, heap, index) {
    this.heap = heap;
    this.values = plan.values.filter((value) => value.place?.heap === index);
    const percent = heap.lower_bound > 0 ? 100 * (heap.bytes / heap.lower_bound - 1) : 0;
    const text = `${this.values.length} values share ${bytes_text(heap.bytes)}; apart they would need ${bytes_text(heap.unshared)}. No sharing needs less than ${bytes_text(heap.lower_bound)}: this is ${percent < 0.05 ? "the least possible" : `${number_text(percent, 2)} % more`}.`;
    this.canvas = el("div", { class: "plan-chart" });
    body.append(el("h3", null, `Heap ${index}`), el("p", { class: "lead" }, text), this.canvas);
    draw_to_width(this.canvas, (width) => this.draw(width));
  }

  y(bytes) {
    return 14 + MAP_HEIGHT * (1 - bytes / Math.max(1, this.heap.bytes));
  }

  draw(width) {
    const columns = new Columns(width);
    const height = MAP_HEIGHT + 54;
    const right = columns.x(step_count);
    const root = svg("svg", { width: columns.width, height, viewBox: `0 0 ${columns.width} ${height}`, role: "group", "aria-label": "Where values lie in memory over the steps of a frame" });
    for (let tick = 0; tick <= 4; ++tick) {
      const bytes = (this.heap.bytes * tick) / 4;
      root.append(svg("path", { d: `M${LABEL} ${this.y(bytes)}H${right}`, class: "grid" }), svg("text", { x: LABEL - 8, y: this.y(bytes) + 4, class: "row-name" }, tick === 0 ? "0" : bytes_text(bytes)));
    }
    root.append(...plan.steps.map((_, step) => svg("text", { x: columns.middle(step), y: this.y(0) + 16, class: "step-number" }, String(plan.once.length + step + 1))));
    root.append(...this.values.map((value) => this.box(value, columns)));
    root.append(svg("path", { d: this.skyline(columns), class: "live" }));
    root.append(svg("path", { d: `M${LABEL} ${this.y(this.heap.bytes)}H${right}`, class: "heap-end" }));
    root.append(svg("path", { d: `M${LABEL} ${this.y(this.heap.lower_bound)}H${right}`, class: "bound" }));
    root.append(svg("text", { x: right - 4, y: this.y(0) + 32, class: "axis-text" }, "step; dotted: bytes live in it; dashed: the most of them"));
    this.canvas.replaceChildren(root);
    roving_focus(root, () => [...root.querySelectorAll(".place")])();
    search.apply();
  }

  skyline(columns) {
    return live_bytes(this.values).map((bytes, step) => `${step === 0 ? "M" : "L"}${columns.x(step)} ${this.y(bytes)}H${columns.x(step + 1)}`).join("");
  }

  box(value, columns) {
    const { offset, bytes } = value.place;
    const x = columns.x(value.first_step) + 1;
    const top = this.y(offset + bytes);
    const size = { width: columns.x(value.last_step + 1) - 1 - x, height: Math.max(1.5, this.y(offset) - top - 1) };
    const group = svg("g", { class: "place", tabindex: "-1", "data-find": value.name, role: "img", "aria-label": value.name });
    group.append(svg("rect", { x, y: top, ...size, rx: Math.min(3, size.height / 3), class: `hue-${plan.steps.findIndex((step) => step.pass === value.pass) % 6}` }));
    const fits = Math.floor((size.width - 8) / 6.2);
    if (size.height >= 13 && fits >= 4)
      group.append(svg("text", { x: x + 5, y: top + size.height / 2 + 3.5, class: "inside" }, value.name.length > fits ? `${value.name.slice(0, fits - 1)}…` : value.name));
    add_tooltip(group, () => [value.name, `${extent_text(value)}, ${value.format}`, `${bytes_text(bytes)} at ${offset.toLocaleString("en")}`,
      `from ${plan.steps[value.first_step].pass} to ${plan.steps[value.last_step].pass}`].join("\n"));
    return group;
  }
}

function start_memory(body) {
  if (plan.memory.heaps === null) {
    body.append(el("p", { class: "lead" }, "No device was asked what the values need: "), el("pre", null, "lightloom plan GRAPH --format html --memory"));
    return;
  }
  plan.memory.heaps.forEach((heap, index) => new MemoryMap(body, heap, index));
  const own = plan.values.filter((value) => value.place === null);
  const largest = [...own].sort((a, b) => b.bytes - a.bytes).slice(0, 12);
  const all = own.reduce((sum, value) => sum + value.bytes, 0);
  if (own.length === 0) return;
  body.append(el("h3", null, "Memory of their own"),
    el("p", { class: "lead" }, `${count_text(own.length, "value has", "values have")} memory of ${own.length === 1 ? "its" : "their"} own, ${bytes_text(all)}: histories, persistent values, constants, outputs and what is made once. The largest:`),
    el("table", { class: "plain" }, el("thead", null, el("tr", null, el("th", null, "value"), el("th", { class: "number" }, "bytes"), el("th", null, "frames"), el("th", null, "why"))),
      el("tbody", null, largest.map((value) => el("tr", { "data-find": value.name }, el("td", { class: "mono" }, value.name), el("td", { class: "number" }, bytes_text(value.bytes)), el("td", null, String(value.layers)),
        el("td", null, value.kept === "frame" ? "an output of the graph" : KEPT[value.kept]))))));
}
