// Where the time of a frame goes: one bar a row, one part a pass. Passes beyond the palette's length get a texture.

const PALETTE = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#9a9a9a"];
const DARK_INK = "#14171b";
const BAR = { height: 24, label: 19, gap: 12 };

function pass_names() {
  const names = [];
  for (const row of data.rows) for (const pass of row.passes) if (!pass.hoisted && !names.includes(pass.pass)) names.push(pass.pass);
  return names;
}

function ink_on(colour) {
  return ["#0072b2"].includes(colour) ? "#ffffff" : DARK_INK;
}

class PassBars {
  constructor(container) {
    this.names = pass_names();
    this.chart = el("div", { class: "chart bars", role: "group", "aria-label": "Time of a frame by pass; the same figures stand in the table below" });
    this.table = el("div");
    container.append(
      el("p", { class: "lead" }, "Median time of each pass in a frame; hoisted passes, which run once, are in the table alone."),
      el("ul", { class: "legend" }, this.names.map((name, i) => el("li", null, svg("svg", { viewBox: "0 0 18 14" }, this.patterns("legend"), this.swatch(i)), name))),
      el("div", { class: "plot" }, this.chart), el("details", { class: "chooser" }, el("summary", null, "The same as a table"), this.table));
    this.redraw = draw_to_width(this.chart, (width) => this.draw(width));
    on_change(() => (this.redraw(), this.update_table()));
    this.update_focus = roving_focus(this.chart, () => [...this.chart.querySelectorAll(".segment")]);
    this.update_table();
  }

  swatch(i) {
    const area = { width: 18, height: 14, rx: 2 };
    return svg("g", null, svg("rect", { ...area, fill: PALETTE[i % PALETTE.length] }), this.texture(i, area, "legend"));
  }

  texture(i, area, where) {
    const round = Math.floor(i / PALETTE.length);
    return round === 0 ? null : svg("rect", { ...area, fill: `url(#${where}-texture-${1 + ((round - 1) % 2)})`, "pointer-events": "none" });
  }

  patterns(where) {
    const lines = (id, paths) => svg("pattern", { id: `${where}-texture-${id}`, width: 7, height: 7, patternUnits: "userSpaceOnUse" }, svg("path", { d: paths, stroke: DARK_INK, "stroke-width": 1.4, fill: "none" }));
    return svg("defs", null, lines(1, "M-1 8 8 -1M-1 1 1 -1M6 8 8 6"), lines(2, "M0 3.5H7"));
  }

  draw(width) {
    const rows = rows_of_view(state.view).filter((row) => !row.failed && row.passes.length > 0);
    const sum = (row) => row.passes.reduce((total, pass) => total + (pass.hoisted || !finite(pass.frame.median) ? 0 : pass.frame.median), 0);
    const longest = Math.max(...rows.map(sum), 1e-9);
    const step = BAR.height + BAR.label + BAR.gap;
    const height = rows.length * step;
    const bars = rows.map((row, i) => this.bar(row, i * step, width / longest, width));
    this.chart.replaceChildren(rows.length === 0 ? el("p", { class: "hint" }, "no times to show") : svg("svg", { viewBox: `0 0 ${width} ${height}`, height }, this.patterns("bars"), bars));
    this.update_focus?.();
  }

  bar(row, y, pixels, width) {
    const selected = row.setting === state.setting;
    const name = svg("text", { class: selected ? "bar-name selected" : "bar-name", x: 0, y: y + 13 }, shortened((selected ? "▸ " : "") + row.setting, Math.max(12, Math.floor(width / 8) - 12)));
    const total = svg("text", { class: "soft", x: width, y: y + 13, "text-anchor": "end" }, `${number_text(row.frame.median)} ms`);
    const parts = [];
    let x = 0;
    for (const pass of row.passes) {
      if (pass.hoisted || !finite(pass.frame.median)) continue;
      const length = pass.frame.median * pixels;
      parts.push(this.segment(row, pass, { x: x.toFixed(1), y: y + BAR.label, width: length.toFixed(1), height: BAR.height }));
      x += length;
    }
    return svg("g", null, name, total, parts);
  }

  segment(row, pass, area) {
    const i = this.names.indexOf(pass.pass);
    const colour = PALETTE[i % PALETTE.length];
    const words = () => `${row.setting}: ${pass.pass}\nmedian ${number_text(pass.frame.median)} ms, p95 ${number_text(pass.frame.p95)} ms`;
    const shape = svg("rect", { class: "segment", ...area, fill: colour, role: "img", "aria-label": words(), tabindex: "-1" });
    add_tooltip(shape, words);
    const fits = pass.pass.length * 6.4 + 10 < area.width && i < PALETTE.length;
    const text = fits ? svg("text", { class: "inside", x: Number(area.x) + 6, y: area.y + 16, style: `fill:${ink_on(colour)}` }, pass.pass) : null;
    return svg("g", null, shape, this.texture(i, area, "bars"), text);
  }

  update_table() {
    const rows = rows_of_view(state.view).filter((row) => !row.failed);
    const names = [];
    for (const row of rows) for (const pass of row.passes) if (!names.includes(pass.pass)) names.push(pass.pass);
    const find = (row, name) => row.passes.find((pass) => pass.pass === name);
    const value = (pass) => (pass ? (pass.hoisted ? pass.once : pass.frame.median) : null);
    const columns = [{ label: "Setting", name: true, value: (row) => row.setting }, { label: "frame", unit: "ms", number: true, value: (row) => row.frame.median }, ...names.map((name) => ({
      label: name, number: true, unit: "ms", value: (row) => value(find(row, name)),
      cell: (row) => (find(row, name)?.hoisted ? `${number_text(value(find(row, name)))} once` : number_text(value(find(row, name)))),
    }))];
    if (this.sorted) this.sorted.update(columns, rows);
    else {
      this.sorted = new SortTable({ caption: "Median time of each pass", columns, rows, class: "results" });
      this.table.append(this.sorted.element);
    }
  }
}
