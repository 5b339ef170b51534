// The plan as the page got it.

const plan = JSON.parse(by_id("data").textContent);
const value_by_name = new Map(plan.values.map((value) => [value.name, value]));
/// Steps of a frame are columns 0, 1, …; what comes before them is column -1.
const step_count = plan.steps.length;

function milliseconds_text(ms) {
  return `${number_text(ms)} ms`;
}

function ages_text(input) {
  if (input.last_age === 0) return "";
  return `@${input.first_age}${input.last_age > input.first_age ? `..${input.last_age}` : ""}`;
}

/// "surface.normal", or "radiance" for a single image.
function port_text(use) {
  return use.part === "" ? use.port : `${use.port}.${use.part}`;
}

function extent_text(value) {
  return `${value.width}×${value.height}${value.dimension === 3 ? `×${value.depth}` : ""}`;
}

const KEPT = {
  frame: "lives within the frame",
  history: "history: later frames read it",
  persistent: "persistent: its pass goes on from what it left",
  once: "made in the first frame, for all of them",
  constant: "a constant, cleared once",
};
