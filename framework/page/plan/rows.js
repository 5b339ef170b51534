// What passes write, port by port: the images of a bundle are one row.

const rows = [];
const row_of_value = new Map();

function touch_row(name, step, kind, ages) {
  const row = row_of_value.get(name);
  if (!row) return;
  const touch = row.touches.find((other) => other.step === step && other.kind === kind);
  if (touch) touch.names.add(name);
  else row.touches.push({ step, kind, ages, names: new Set([name]) });
}

function make_rows() {
  for (const value of plan.values) {
    const name = `${value.pass}.${value.port}`;
    let row = rows.find((other) => other.name === name);
    if (!row) {
      row = { name, pass: value.pass, values: [], touches: [], kept: value.kept, scratch: value.scratch };
      rows.push(row);
    }
    row.values.push(value);
    if (value.kept === "history") row.kept = "history";
    row_of_value.set(value.name, row);
  }
  for (const [step, entries] of [[-1, plan.once], ...plan.steps.map((step, i) => [i, [step]])])
    for (const entry of entries) {
      for (const use of [...entry.outputs, ...entry.scratch]) touch_row(use.value, step, "write", "");
      for (const use of entry.inputs) {
        if (use.first_age === 0) touch_row(use.value, step, "read", "");
        if (use.last_age > 0) touch_row(use.value, step, "history", ages_text(use));
      }
      for (const observation of entry.observations) touch_row(observation.value, step, "observe", "");
    }
  for (const row of rows) {
    const steps = row.values.filter((value) => value.first_step !== null);
    row.first = steps.length === 0 ? null : Math.min(...steps.map((value) => value.first_step));
    row.last = steps.length === 0 ? null : Math.max(...steps.map((value) => value.last_step));
    row.bytes = row.values.reduce((sum, value) => sum + value.bytes, 0);
    row.layers = Math.max(...row.values.map((value) => value.layers));
    const written = row.touches.find((touch) => touch.kind === "write");
    row.written = written ? written.step : -2;
  }
  rows.sort((a, b) => a.written - b.written);
}

make_rows();

function row_text(row) {
  const first = row.values[0];
  const parts = row.values.length > 1 ? `${row.values.length} images: ${row.values.map((value) => value.part).join(", ")}` : first.format;
  const readers = row.touches.filter((touch) => touch.kind === "read" || touch.kind === "history");
  const lines = [
    row.name,
    `${extent_text(first)}, ${parts}`,
    `${bytes_text(row.bytes)}${row.layers > 1 ? ` in a ring of ${row.layers} frames` : ""}${row.scratch ? ", scratch" : ""}`,
    KEPT[row.kept],
  ];
  if (readers.length > 0)
    lines.push(`read by ${[...new Set(readers.map((touch) => `${touch.step < 0 ? "what runs once" : plan.steps[touch.step].pass}${touch.ages}`))].join(", ")}`);
  else lines.push("no pass reads it");
  return lines.join("\n");
}
