// What a row of the results opens into: the command that makes it again, every metric, every pass.

function copy_text(text, button) {
  const said = (words) => {
    button.textContent = words;
    setTimeout(() => (button.textContent = "Copy"), 1500);
  };
  const by_selection = () => {
    const area = el("textarea", { class: "skip" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    button.focus();
    said(done ? "Copied" : "Select and copy it");
  };
  if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => said("Copied"), by_selection);
  else by_selection();
}

function command_block(row) {
  if (row.command.length === 0) return null;
  const text = command_text(row.command);
  const button = el("button", { type: "button", class: "copy", "aria-live": "polite" }, "Copy");
  button.addEventListener("click", () => copy_text(text, button));
  return el("div", null, el("h4", null, "Makes one cell of this row again"), el("div", { class: "command" }, el("pre", null, text), button));
}

function small_table(title, headings, rows) {
  if (rows.length === 0) return null;
  const head = el("tr", null, headings.map((text, i) => el("th", { scope: "col", class: i > 0 ? "number" : null }, text)));
  const body = rows.map((cells) => el("tr", null, cells.map((cell, i) => el(i === 0 ? "th" : "td", { scope: i === 0 ? "row" : null, class: i > 0 ? "number" : null }, cell))));
  return el("div", null, el("h4", null, title), el("table", null, el("thead", null, head), el("tbody", null, body)));
}

function metrics_block(row) {
  const shown = data.metrics.filter((metric) => row.metrics[metric.name]);
  const lines = shown.map((metric) => [
    el("span", { title: metric.doc || null }, metric.label, metric.unit ? el("span", { class: "unit" }, ` ${metric.unit}`) : null),
    estimate_cell(row.metrics[metric.name]),
    verdict_cell(row, metric),
  ]);
  return small_table("Metrics", ["metric", "mean ± 95 %", "against the baseline"], lines);
}

function passes_block(row) {
  const lines = row.passes.map((pass) => [
    el("span", { class: "mono" }, pass.pass),
    pass.hoisted ? NONE : number_text(pass.frame.median),
    pass.hoisted ? NONE : number_text(pass.frame.p95),
    pass.hoisted ? number_text(pass.once) : NONE,
  ]);
  return small_table("Passes, in order", ["pass", "median ms", "p95 ms", "once ms"], lines);
}

function lists_block(row) {
  const line = (name, values) => (values.length > 0 ? el("p", null, el("b", null, `${name}: `), values.join(", ")) : null);
  const axes = row.values.map(([name, value]) => `${name} = ${value}`);
  return el("div", null, line("Setting", axes), line("Disabled", row.disabled), line("Culled with them", row.culled),
            row.disturbed ? el("p", { class: "worse" }, "Other cells ran at the same time: these times say little.") : null);
}

function row_details(row) {
  return el("div", { class: "inside" }, command_block(row), lists_block(row), el("div", { class: "columns" }, metrics_block(row), passes_block(row)));
}
