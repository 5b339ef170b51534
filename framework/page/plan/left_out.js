// What does not run in a frame, and why.

function reason_table(title, lead, entries) {
  if (entries.length === 0) return [];
  return [el("h3", null, title), el("p", { class: "lead" }, lead),
    el("table", { class: "plain" }, el("tbody", null, entries.map(([name, reason]) => el("tr", { "data-find": name }, el("td", { class: "mono" }, name), el("td", null, reason)))))];
}

function start_left_out(body) {
  const reasons = (list) => list.map((entry) => [entry.pass, entry.reason]);
  body.append(
    ...reason_table("Once", "The first frame runs these; what they made serves all others.", plan.once.map((step) => [step.pass, step.once])),
    ...reason_table("Off", "Who reads their outputs gets what stands in for them.", reasons(plan.bypassed)),
    ...reason_table("Not needed", "Nothing that is written or dumped depends on them.", reasons(plan.culled)),
    ...reason_table("Notes", "", plan.notes.map((note) => ["", note])));
}

/// Fades what does not have the words that are searched for.
const search = {
  words: "",
  apply() {
    for (const item of document.querySelectorAll("[data-find]")) {
      const found = item.dataset.find.toLowerCase().includes(search.words);
      item.classList.toggle("unfound", search.words !== "" && !found);
      item.classList.toggle("found", search.words !== "" && found);
    }
  },
};
