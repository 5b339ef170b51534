// Numbers as text: three significant digits.

const NONE = "–";

function finite(value) {
  return typeof value === "number" && Number.isFinite(value);
}

function decimals_of(value, digits) {
  const size = Math.abs(value);
  return size === 0 ? 0 : Math.min(8, Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
}

function minus(text) {
  return text.replace(/-/g, "−");
}

function number_text(value, digits = 3) {
  if (value === null || value === undefined) return NONE;
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-4)) return minus(value.toExponential(digits - 2));
  return minus(value.toFixed(decimals_of(value, digits)));
}

function bytes_text(bytes) {
  if (!finite(bytes) || bytes <= 0) return NONE;
  const units = ["B", "KiB", "MiB", "GiB", "TiB"];
  const power = Math.min(units.length - 1, Math.floor(Math.log2(bytes) / 10));
  return `${number_text(bytes / 1024 ** power)} ${units[power]}`;
}
