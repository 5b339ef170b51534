// Every step in words.

function use_list(title, uses, text) {
  if (uses.length === 0) return null;
  return el("div", null, el("h4", null, title), el("ul", null, uses.map((use) => el("li", { class: "mono" }, text(use)))));
}

function written_text(use) {
  const value = value_by_name.get(use.value);
  return `${port_text(use)}: ${value.format} ${extent_text(value)}${value.layers > 1 ? `, ring of ${value.layers}` : ""}, ${bytes_text(value.bytes)}`;
}

function step_card(step, number) {
  const waits = grouped_barriers(step.barriers);
  const params = Object.entries(step.params);
  const notes = [];
  if (step.host) notes.push("on the host");
  if (waits.length > 0) notes.push(count_text(step.barriers.length, "barrier", "barriers"));
  if (plan.times !== null && step.once === null) notes.push(milliseconds_text(plan.times.step_ms[number - plan.once.length - 1]));
  if (step.once !== null) notes.push("once");
  return el("details", { class: "step", "data-find": `${step.pass} ${step.type}` },
    el("summary", null, el("span", { class: "number" }, `${number}.`), el("b", null, step.pass), " ", el("span", { class: "soft" }, step.type), el("span", { class: "tail" }, notes.join(" · "))),
    el("div", { class: "step-body" },
      step.once === null ? null : el("p", null, `Runs in the first frame alone: ${step.once}.`),
      waits.length === 0 ? null : el("div", null, el("h4", null, "waits"), el("ul", null, waits.map((wait) => el("li", null, el("span", { class: "mono" }, wait.subject), `: ${wait.reason}`, el("span", { class: "soft" }, ` (${kind_text(wait)})`))))),
      use_list("reads", step.inputs, (use) => `${port_text(use)} = ${use.value}${ages_text(use)}`),
      use_list("writes", step.outputs, written_text),
      use_list("scratch", step.scratch, written_text),
      use_list("not connected", step.unconnected.map((port) => ({ port })), (use) => use.port),
      use_list("then", step.observations, (entry) => `${entry.observer === "scan" ? "scan" : "read back"} ${entry.value}`),
      params.length === 0 ? null : el("div", null, el("h4", null, "params"), el("ul", null, params.map(([name, value]) => el("li", { class: "mono" }, `${name} = ${value}`))))));
}

function start_steps(body) {
  const cards = [...plan.once, ...plan.steps].map((step, i) => step_card(step, i + 1));
  const all = el("button", { type: "button" }, "Open all");
  all.addEventListener("click", () => {
    const open = !cards.every((card) => card.open);
    cards.forEach((card) => (card.open = open));
  });
  cards.forEach((card) => card.addEventListener("toggle", () => (all.textContent = cards.every((other) => other.open) ? "Close all" : "Open all")));
  body.append(el("div", { class: "controls" }, all), ...cards);
}
