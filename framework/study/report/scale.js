// Axes: a range of numbers on a length, straight or logarithmic, with round ticks.

function make_scale(values, log, from, to) {
  const used = values.filter((value) => finite(value) && (!log || value > 0));
  let low = Math.min(...used);
  let high = Math.max(...used);
  if (used.length === 0) [low, high] = log ? [0.1, 1] : [0, 1];
  if (log) {
    const room = Math.max(1.08, (high / low) ** 0.06);
    [low, high] = [low / room, high * room];
  } else {
    if (low > 0 && low < 0.6 * high) low = 0;
    const room = (high - low || Math.abs(high) || 1) * 0.06;
    [low, high] = [low === 0 ? 0 : low - room, high + room];
  }
  const place = log ? (value) => Math.log(value / low) / Math.log(high / low) : (value) => (value - low) / (high - low);
  const at = (value) => from + place(Math.min(high, Math.max(low, value))) * (to - from);
  return { low, high, log, at, holds: (value) => finite(value) && (!log || value > 0) };
}

function straight_ticks(low, high, most) {
  const rough = (high - low) / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= rough);
  const ticks = [];
  for (let i = Math.ceil(low / step); i * step <= high * (1 + 1e-9); ++i) ticks.push(i * step);
  return ticks;
}

function log_ticks(low, high, most) {
  const ticks = (factors) => {
    const list = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
      for (const factor of factors) if (factor * 10 ** power >= low && factor * 10 ** power <= high) list.push(factor * 10 ** power);
    return list;
  };
  for (const factors of [[1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]]) {
    const list = ticks(factors);
    if (list.length <= most && list.length > 1) return list;
  }
  const decades = ticks([1]);
  return decades.length > 1 ? decades.filter((tick, i) => i % Math.ceil(decades.length / most) === 0) : straight_ticks(low, high, most);
}

function axis_ticks(scale, most) {
  return scale.log ? log_ticks(scale.low, scale.high, most) : straight_ticks(scale.low, scale.high, most);
}

function tick_text(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-3)) return minus(value.toExponential().replace(/\.?(\d*?)0*e/, (all, digits) => (digits ? `.${digits.slice(0, 2)}e` : "e")));
  return minus(String(Number(value.toPrecision(4))));
}
