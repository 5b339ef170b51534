// The main table: one row a setting and view. A click selects the row for the rest of the page.

const DEFAULT_METRICS = 3;

class ResultsTable {
  constructor(container) {
    this.open = new Set();
    this.all_views = false;
    this.filter = "";
    this.shown = new Set([...data.metrics.slice(0, DEFAULT_METRICS).map((metric) => metric.label), "p95", "once", "memory"]);
    this.count = el("span", { class: "hint", role: "status" });
    this.table = new SortTable({ caption: "Results", columns: [], rows: [], class: "results", tall: true, make_row: (row, columns) => this.make_row(row, columns) });
    container.append(this.controls(), this.chooser(), this.table.element);
    on_change(() => this.update());
    this.update();
  }

  controls() {
    const search = el("input", { type: "search", placeholder: "name or value", size: 16 });
    search.addEventListener("input", () => {
      this.filter = search.value.trim().toLowerCase();
      this.update();
    });
    const all = data.views.length > 1 ? checkbox("all views", false, (on) => ((this.all_views = on), this.update())) : null;
    return el("div", { class: "controls" }, el("label", null, "Filter ", search), all, this.count);
  }

  chooser() {
    const box = (column) => checkbox(column.label, this.shown.has(column.label), (on) => {
      if (on) this.shown.add(column.label);
      else this.shown.delete(column.label);
      this.update();
    });
    return el("details", { class: "chooser" }, el("summary", null, "Columns"), el("div", null, this.optional_columns().map(box)));
  }

  optional_columns() {
    const axis = (name) => ({ label: name, title: "an axis of the study", value: (row) => row.values.find(([key]) => key === name)?.[1] ?? null });
    const metric_column = (metric) => ({
      label: metric.label, unit: metric.unit, number: true, title: `${metric.doc} ${best_text(metric)}`.trim(),
      value: (row) => metric_mean(row, metric), cell: (row) => estimate_cell(row.metrics[metric.name]),
    });
    return [
      ...data.axes.map(axis),
      ...data.metrics.map(metric_column),
      { label: "p95", unit: "ms", number: true, title: "95th percentile of the frame", value: (row) => row.frame.p95 },
      { label: "wall", unit: "ms", number: true, title: "whole frames on the host, read-back included, median", value: (row) => row.wall.median },
      { label: "once", unit: "ms", number: true, title: "hoisted passes, before the first frame", value: (row) => row.once_ms },
      { label: "first frame", unit: "ms", number: true, title: "wall time of the first frame, with pipelines made", value: (row) => row.first_frame_ms },
      { label: "memory", number: true, title: "values of the graph", value: (row) => row.memory_bytes, cell: (row) => bytes_text(row.memory_bytes) },
    ];
  }

  columns() {
    const optional = this.optional_columns().filter((column) => this.shown.has(column.label));
    const wanted = (column) => metric_labels.has(column.label);
    const metric_labels = new Set(data.metrics.map((metric) => metric.label));
    const axes = optional.filter((column) => data.axes.includes(column.label) && !wanted(column));
    const metrics = optional.filter(wanted);
    const rest = optional.filter((column) => !axes.includes(column) && !metrics.includes(column));
    const verdict = main_metric && { label: `${main_metric.label} verdict`, title: "against the baseline, seed by seed", value: (row) => verdict_of(row, main_metric).order, cell: (row) => verdict_cell(row, main_metric) };
    return [
      { label: "Setting", name: true, value: (row) => row.setting, cell: (row) => this.name_cell(row) },
      this.all_views ? { label: "View", value: (row) => data.views[row.view].title } : null,
      ...axes,
      ...metrics.slice(0, 1), verdict, ...metrics.slice(1),
      { label: "frame", unit: "ms", number: true, title: "median of frames; mean over seeds", value: (row) => row.frame_ms.mean, cell: (row) => this.time_cell(row) },
      ...rest.slice(0, 1),
      { label: "time verdict", title: "frame time against the baseline", value: (row) => verdict_of(row, TIME_METRIC).order, cell: (row) => verdict_cell(row, TIME_METRIC) },
      ...rest.slice(1),
      { label: "culled also", wrap: true, title: "passes that fell away with those disabled", value: (row) => row.culled.join(", "), cell: (row) => row.culled.join(", ") || NONE },
    ].filter(Boolean);
  }

  time_cell(row) {
    const text = estimate_cell(row.frame_ms.count > 0 ? row.frame_ms : { mean: row.frame.median, low: 0, high: 0, count: 1 });
    return row.disturbed ? el("span", { title: "other cells ran at the same time" }, text, " ⚠") : text;
  }

  name_cell(row) {
    const open = this.open.has(row.id);
    const toggle = el("button", { type: "button", class: "open", "aria-expanded": String(open), "aria-label": `Details of ${row.setting}`, onclick: (event) => {
      event.stopPropagation();
      this.toggle(row.id);
    } });
    const choose = el("button", { type: "button", class: "choose", "aria-current": this.is_selected(row) ? "true" : null, onclick: (event) => {
      event.stopPropagation();
      this.select(row, true);
    } }, row.setting);
    const badges = [row.baseline ? el("span", { class: "badge" }, "baseline") : null, row.pareto && !row.failed ? el("span", { class: "badge front", title: "no other setting here is both faster and better" }, "◆ front") : null, row.failed ? el("span", { class: "badge failed" }, "✕ failed") : null];
    return el("span", null, toggle, choose, el("span", { class: "badges" }, badges));
  }

  is_selected(row) {
    return row.view === state.view && row.setting === state.setting;
  }

  select(row, keep_focus) {
    change({ view: row.view, setting: row.setting });
    if (keep_focus) this.table.body.querySelector(`tr[data-row="${row.id}"] .choose`)?.focus({ preventScroll: true });
  }

  toggle(id) {
    if (this.open.has(id)) this.open.delete(id);
    else this.open.add(id);
    this.table.render();
    this.table.body.querySelector(`tr[data-row="${id}"] .open`)?.focus({ preventScroll: true });
  }

  make_row(row, columns) {
    const names = ["row", row.failed ? "failed" : "", this.is_selected(row) ? "selected" : ""].filter(Boolean).join(" ");
    const leading = columns.filter((column) => column.name || column.label === "View");
    const cells = row.failed
      ? [...leading.map((column) => table_cell(column, row)), el("td", { class: "reason", colspan: columns.length - leading.length }, row.error)]
      : columns.map((column) => table_cell(column, row));
    const line = el("tr", { class: names, "data-row": row.id, onclick: () => this.select(row, false) }, cells);
    if (!this.open.has(row.id)) return [line];
    return [line, el("tr", { class: "details" }, el("td", { class: "details-cell", colspan: columns.length }, row_details(row)))];
  }

  update() {
    const text_of = (row) => [row.setting, data.views[row.view].title, ...row.values.flat(), ...row.disabled, ...row.culled].join(" ").toLowerCase();
    const rows = data.rows.filter((row) => (this.all_views || row.view === state.view) && text_of(row).includes(this.filter));
    const total = this.all_views ? data.rows.length : rows_of_view(state.view).length;
    this.count.textContent = `${rows.length} of ${total} rows`;
    const where = this.all_views || data.views.length === 0 ? "all views" : data.views[state.view].title;
    const scroll = this.table.element.scrollTop;
    this.table.update(this.columns(), rows, `Results in ${where}. Select a setting to see it in the graph, the pictures and the plots.`);
    this.table.element.scrollTop = scroll;
  }
}
