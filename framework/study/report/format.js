// Estimates as text, with the decimals that their interval deserves; command lines.

/// Half the width of the interval; null where nothing is known of the spread.
function half_width(estimate) {
  const half = (estimate.high - estimate.low) / 2;
  return estimate.count > 1 && finite(half) ? half : null;
}

/// ["0.0712", "0.0021" or null]
function estimate_parts(estimate) {
  if (!estimate || estimate.count === 0) return [NONE, null];
  const half = half_width(estimate);
  const size = Math.abs(estimate.mean);
  if (half === null || !finite(estimate.mean)) return [number_text(estimate.mean), null];
  if (Math.max(size, half) >= 1e7 || Math.max(size, half) < 1e-4) return [number_text(estimate.mean), number_text(half, 2)];
  const decimals = Math.min(7, Math.max(decimals_of(estimate.mean, 3), Math.min(decimals_of(half, 1), decimals_of(estimate.mean, 4))));
  const tiny = half > 0 && half < 0.5 * 10 ** -decimals;
  return [minus(estimate.mean.toFixed(decimals)), (tiny ? "<" : "") + (tiny ? 10 ** -decimals : half).toFixed(decimals)];
}

function estimate_text(estimate) {
  const [mean, half] = estimate_parts(estimate);
  return half === null ? mean : `${mean} ± ${half}`;
}

function estimate_cell(estimate) {
  const [mean, half] = estimate_parts(estimate);
  return half === null ? mean : el("span", null, mean, el("span", { class: "spread" }, ` ± ${half}`));
}

/// One word of a POSIX shell's command line.
function shell_word(word) {
  return /^[A-Za-z0-9_@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

function command_text(words) {
  return words.map(shell_word).join(" ");
}
