// The study's results as the page got them, with numbers that JSON cannot hold put back.

const UNUSUAL = { inf: Infinity, "-inf": -Infinity, nan: NaN };

function revive(value) {
  return value in UNUSUAL ? UNUSUAL[value] : value;
}

function revive_numbers(record) {
  if (!record) return;
  for (const [key, value] of Object.entries(record)) if (typeof value === "string") record[key] = revive(value);
}

function read_data() {
  const data = JSON.parse(by_id("data").textContent);
  data.rows.forEach((row, id) => {
    row.id = id;
    row.view = data.views.findIndex((view) => view.scene === row.scene && view.camera === row.camera);
    row.failed = row.error !== "";
    Object.values(row.metrics).forEach(revive_numbers);
    for (const verdict of Object.values(row.verdicts)) {
      verdict.ratio = revive(verdict.ratio);
      revive_numbers(verdict.difference);
    }
    for (const pass of row.passes) {
      pass.once = revive(pass.once);
      revive_numbers(pass.frame);
    }
    for (const timing of [row.frame_ms, row.frame, row.wall]) revive_numbers(timing);
    row.once_ms = revive(row.once_ms);
    row.first_frame_ms = revive(row.first_frame_ms);
  });
  data.views.forEach((view, index) => {
    view.relmse = revive(view.relmse);
    view.title = view.camera === "" ? view.scene : `${view.scene}, ${view.camera}`;
    const rows = data.rows.filter((row) => row.view === index);
    if (rows.length > 0) rows[0].baseline = true;
  });
  for (const entry of [...data.equal_time, ...data.equal_error])
    for (const key of ["target", "milliseconds", "error"]) entry[key] = revive(entry[key]);
  return data;
}

const data = read_data();
const metric_by_name = new Map(data.metrics.map((metric) => [metric.name, metric]));
const main_metric = metric_by_name.get(data.metric) ?? data.metrics[0] ?? null;

function rows_of_view(view) {
  return data.rows.filter((row) => row.view === view);
}

function find_row(view, setting) {
  return data.rows.find((row) => row.view === view && row.setting === setting) ?? null;
}

function metric_mean(row, metric) {
  return metric === null || row.failed ? null : (row.metrics[metric.name]?.mean ?? null);
}

/// Smaller is better, whatever the metric.
function badness(metric, value) {
  if (value === null || Number.isNaN(value)) return Infinity;
  return metric.best === "high" ? -value : metric.best === "zero" ? Math.abs(value) : value;
}

function best_text(metric) {
  return { high: "higher is better", low: "lower is better", zero: "nearest 0 is best" }[metric.best];
}

function picture_uri(index) {
  return `data:image/png;base64,${data.pictures[index]}`;
}
