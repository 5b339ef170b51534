// How a row stands to the baseline, in words; never by colour alone.

const TIME_METRIC = { name: "frame_ms", label: "frame", unit: "ms", best: "low" };

/// {text, class, title, order}: order sorts from better to worse.
function verdict_of(row, metric) {
  if (row.failed || metric === null) return { text: NONE, class: "same", title: "", order: null };
  const verdict = row.verdicts[metric.name];
  if (row.baseline && !verdict) return { text: "baseline", class: "same", title: "The others are compared with this row.", order: 0 };
  if (!verdict) return { text: NONE, class: "same", title: "", order: null };
  const difference = verdict.difference;
  const title = `row minus baseline: ${estimate_text(difference)} ${metric.unit}`.trim();
  if (difference.count < 2) return { text: `${change_text(verdict, metric)}, one seed`, class: "same", title, order: verdict_order(verdict, metric) };
  if (verdict.within_noise) return { text: "≈ within noise", class: "same", title, order: 0 };
  const better = is_improvement(verdict, metric);
  const words = metric === TIME_METRIC ? ["faster", "slower"] : ["better", "worse"];
  return {
    text: `${difference.mean < 0 ? "▼" : "▲"} ${change_text(verdict, metric)} ${better ? words[0] : words[1]}`,
    class: better ? "better" : "worse",
    title,
    order: verdict_order(verdict, metric),
  };
}

function is_improvement(verdict, metric) {
  if (metric.best === "zero") return Math.abs(verdict.ratio) < 1;
  return metric.best === "high" ? verdict.difference.mean > 0 : verdict.difference.mean < 0;
}

/// Decibels and signed figures by difference, others by ratio.
function by_difference(verdict, metric) {
  return metric.unit === "dB" || metric.best === "zero" || !finite(verdict.ratio) || verdict.ratio <= 0;
}

function change_text(verdict, metric) {
  if (by_difference(verdict, metric)) {
    const mean = verdict.difference.mean;
    return `${mean > 0 ? "+" : ""}${number_text(mean)}${metric.unit ? ` ${metric.unit}` : ""}`;
  }
  if (verdict.ratio > 2 || verdict.ratio < 0.5) return `${number_text(verdict.ratio)}×`;
  return `${number_text(Math.abs(verdict.ratio - 1) * 100, 2)} %`;
}

function verdict_order(verdict, metric) {
  const size = by_difference(verdict, metric) ? verdict.difference.mean : Math.log(verdict.ratio);
  if (metric.best === "zero") return Math.abs(verdict.ratio) - 1;
  return metric.best === "high" ? -size : size;
}

function verdict_cell(row, metric) {
  const verdict = verdict_of(row, metric);
  return el("span", { class: verdict.class, title: verdict.title || null }, verdict.text);
}
