// Barriers as a table; those of a bundle's images that differ in nothing else are one line.

function grouped_barriers(list) {
  const groups = new Map();
  for (const barrier of list) {
    const value = value_by_name.get(barrier.value);
    const port = value ? `${value.pass}.${value.port}` : barrier.value;
    const key = JSON.stringify([barrier.step, barrier.where, port, barrier.from, barrier.to, barrier.hazard, barrier.reason, barrier.previous_frame]);
    const group = groups.get(key) ?? { ...barrier, port, parts: [] };
    if (value && value.part !== "") group.parts.push(value.part);
    groups.set(key, group);
  }
  return [...groups.values()].map((group) => ({ ...group, subject: group.parts.length > 0 ? `${group.port}.{${group.parts.join(", ")}}` : group.port }));
}

function access_cell(name) {
  const access = plan.accesses[name];
  const cell = el("span", { class: "mono dotted", tabindex: "0" }, name.replaceAll("_", " "));
  add_tooltip(cell, () => `${name}\nstages ${access.stages.join(", ") || "none"}\naccess ${access.access.join(", ") || "none"}`);
  return cell;
}

function kind_text(barrier) {
  if (barrier.takes_over) return barrier.previous_frame ? "takes memory over, from the frame before" : "takes memory over";
  return barrier.hazard + (barrier.previous_frame ? ", frame before" : "");
}

function barrier_row(barrier) {
  return el("tr", { "data-find": `${barrier.where} ${barrier.subject} ${barrier.reason}`, "data-kind": barrier.takes_over ? "memory" : barrier.previous_frame ? "frames" : "values" },
    el("td", { class: "mono" }, barrier.where), el("td", { class: "mono" }, barrier.subject), el("td", null, access_cell(barrier.from), " → ", access_cell(barrier.to)),
    el("td", null, kind_text(barrier)), el("td", null, barrier.reason));
}

function start_barriers(body) {
  const groups = grouped_barriers(barriers);
  const table = el("table", { class: "plain" },
    el("thead", null, el("tr", null, ["before", "value", "waits for → who waits", "kind", "reason"].map((name) => el("th", null, name)))),
    el("tbody", null, groups.map(barrier_row)));
  const kinds = [["values", "between passes of a frame"], ["frames", "between frames"], ["memory", "for shared memory"]];
  const boxes = kinds.filter(([kind]) => groups.some((group) => (group.takes_over ? "memory" : group.previous_frame ? "frames" : "values") === kind))
    .map(([kind, text]) => checkbox(text, true, (on) => table.querySelectorAll(`[data-kind="${kind}"]`).forEach((row) => row.classList.toggle("unwanted", !on))));
  body.append(el("p", { class: "lead" }, `${count_text(barriers.length, "barrier", "barriers")} in ${count_text(groups.length, "line", "lines")}; the images of a bundle share one.`),
    el("div", { class: "controls" }, boxes), el("div", { class: "scroll" }, table));
}
