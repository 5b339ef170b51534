// What settings reach at the same time, and what time they need for the same error.

class TradeTables {
  constructor(container) {
    const metric = main_metric?.label ?? "error";
    const common = [
      { label: "Setting", name: true, value: (entry) => entry.setting },
      { label: "frame", unit: "ms", number: true, value: (entry) => entry.milliseconds },
      { label: metric, number: true, value: (entry) => entry.error },
      { label: "how", wrap: true, value: (entry) => entry.note },
    ];
    const target = (unit) => ({ label: "aim", unit, number: true, value: (entry) => entry.target });
    this.parts = [
      { title: "Equal time", lead: "The error that each reaches in the time aimed at.", entries: data.equal_time, columns: [target("ms"), ...common] },
      { title: "Equal error", lead: `The time that each needs for the ${metric} aimed at.`, entries: data.equal_error, columns: [target(metric), ...common] },
    ].filter((part) => part.entries.length > 0);
    for (const part of this.parts) part.table = new SortTable({ caption: part.title, columns: part.columns, rows: [], class: "results", tall: true });
    container.append(el("div", { class: "pair" }, this.parts.map((part) => el("div", null, el("h3", null, part.title), el("p", { class: "hint" }, part.lead), part.table.element))));
    on_change(() => this.update());
    this.update();
  }

  update() {
    const view = data.views[state.view];
    for (const part of this.parts) part.table.update(part.columns, part.entries.filter((entry) => entry.scene === view.scene && entry.camera === view.camera), `${part.title} in ${view.title}`);
  }
}
