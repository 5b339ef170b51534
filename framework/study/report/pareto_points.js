// What the plot of error against time shows: points, their front, and where names find room.

/// Points of the current view that can stand in the plot, and how many cannot.
function pareto_points(metric, log_x, log_y) {
  const rows = rows_of_view(state.view).filter((row) => !row.failed);
  const points = rows.map((row) => {
    const time = row.frame_ms.count > 0 ? row.frame_ms : { mean: row.frame.median, low: row.frame.median, high: row.frame.median, count: 1 };
    const value = row.metrics[metric.name] ?? null;
    const folded = metric.best === "zero" && log_y && value ? fold(value) : value;
    return { row, time, value: folded };
  });
  const fits = (estimate, log) => estimate && finite(estimate.mean) && (!log || estimate.mean > 0);
  const shown = points.filter((point) => fits(point.time, log_x) && fits(point.value, log_y));
  mark_front(shown, metric);
  return { points: shown, left_out: rows.length - shown.length };
}

/// The size of a signed figure, for a logarithmic axis.
function fold(estimate) {
  const ends = [Math.abs(estimate.low), Math.abs(estimate.high)];
  const holds_zero = estimate.low <= 0 && estimate.high >= 0;
  return { ...estimate, mean: Math.abs(estimate.mean), low: holds_zero ? 0 : Math.min(...ends), high: Math.max(...ends) };
}

function mark_front(points, metric) {
  const bad = (point) => badness(metric, point.value.mean);
  for (const point of points) {
    point.front = !points.some((other) => other.time.mean <= point.time.mean && bad(other) <= bad(point) && (other.time.mean < point.time.mean || bad(other) < bad(point)));
  }
}

function boxes_meet(a, b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Names near their points where nothing is in the way; the selected one first, then the front, then the rest.
function place_labels(points, width, height) {
  const order = [...points].sort((a, b) => rank(a) - rank(b));
  const taken = points.map((point) => ({ x: point.x - 7, y: point.y - 7, width: 14, height: 14 }));
  for (const point of order) {
    const text = shortened(point.row.setting, 30);
    const size = { width: text.length * 6.6 + 6, height: 15 };
    const spots = [[11, -8], [-11 - size.width, -8], [-size.width / 2, -25], [-size.width / 2, 11], [9, 6], [-9 - size.width, 6], [9, -22], [-9 - size.width, -22]];
    const boxes = spots.map(([dx, dy]) => ({ x: point.x + dx, y: point.y + dy, ...size }));
    const free = boxes.find((box) => box.x >= 0 && box.x + box.width <= width && box.y >= 0 && box.y + box.height <= height && !taken.some((other) => boxes_meet(box, other)));
    if (!free) continue;
    taken.push(free);
    point.label = { text, x: free.x + 2, y: free.y + 12 };
  }
}

function rank(point) {
  return point.row.setting === state.setting ? 0 : point.front ? 1 : point.row.baseline ? 2 : 3;
}

/// Path of the front: between two of its points nothing better is known than the slower one's worse neighbour.
function front_path(points) {
  const front = points.filter((point) => point.front).sort((a, b) => a.x - b.x);
  return front.map((point, i) => (i === 0 ? `M${point.x.toFixed(1)} ${point.y.toFixed(1)}` : `H${point.x.toFixed(1)}V${point.y.toFixed(1)}`)).join("");
}
