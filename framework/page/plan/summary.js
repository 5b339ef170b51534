// What is to be known at a glance.

function count_text(count, one, many) {
  return `${count} ${count === 1 ? one : many}`;
}

/// Whatever has `barriers`, whatever its depth.
function all_barriers() {
  const list = [];
  const add = (barriers, where, step) => barriers.forEach((barrier) => list.push({ ...barrier, where, step }));
  const add_observations = (observations, step) =>
    observations.forEach((entry) => add(entry.barriers, `${entry.observer === "scan" ? "scan of" : "read-back of"} ${entry.value}`, step));
  add(plan.prologue_barriers, "after the clears", -1);
  for (const step of plan.once) {
    add(step.barriers, step.pass, -1);
    add_observations(step.observations, -1);
  }
  add(plan.once_barriers, "after what runs once", -1);
  add(plan.frame_start, "start of the frame", -1);
  add(plan.inputs_ready, "after the scene's upload", -1);
  add_observations(plan.opening_observations, -1);
  plan.steps.forEach((step, i) => {
    add(step.barriers, step.pass, i);
    add_observations(step.observations, i);
  });
  return list;
}

const barriers = all_barriers();

function start_summary() {
  const shared = plan.memory.heaps;
  const sentences = [
    `${count_text(step_count, "pass runs", "passes run")} in every frame${plan.once.length > 0 ? `, ${plan.once.length} once` : ""}, with ${count_text(barriers.length, "barrier", "barriers")}.`,
    `${count_text(plan.values.length, "image", "images")} of ${bytes_text(plan.memory.total_bytes)} together${plan.memory.ring_bytes > 0 ? `, ${bytes_text(plan.memory.ring_bytes)} of it in histories` : ""}.`,
  ];
  if (shared !== null && shared.length > 0) {
    const sum = (key) => shared.reduce((total, heap) => total + heap[key], 0);
    sentences.push(`What lives within a frame shares ${bytes_text(sum("bytes"))} instead of ${bytes_text(sum("unshared"))}; no sharing needs less than ${bytes_text(sum("lower_bound"))}.`);
  }
  if (plan.times !== null) {
    const { sum_ms, critical_path_ms } = plan.times;
    const share = sum_ms > 0 ? (100 * (sum_ms - critical_path_ms)) / sum_ms : 0;
    sentences.push(`A frame takes ${milliseconds_text(sum_ms)}; overlapping passes could save at most ${number_text(share, 2)} %.`);
  }
  by_id("summary").textContent = sentences.join(" ");
  const facts = [
    ["hash of what is executed", plan.hash],
    ["view", `${plan.view.width}×${plan.view.height}`],
    ["trace", `${plan.trace.width}×${plan.trace.height}`],
    ...Object.entries(plan.params).map(([name, value]) => [`param ${name}`, String(value)]),
    ...plan.outputs.map((output) => [`output ${output.name}`, output.value + (output.age > 0 ? `@${output.age}` : "")]),
  ];
  by_id("facts").append(...facts.map(([name, text]) => el("div", null, el("dt", null, name), el("dd", { class: "mono" }, text))));
}
