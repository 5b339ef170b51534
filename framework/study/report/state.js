// What the parts of the page share. A part that changes it calls change(); all listeners then look again.

const state = { view: 0, setting: null, left: "", reference_right: false, heat: false };
const listeners = [];

function on_change(listener) {
  listeners.push(listener);
}

function change(values) {
  Object.assign(state, values);
  if (selected_row() === null) state.setting = first_choice();
  for (const listener of listeners) listener();
}

function selected_row() {
  return find_row(state.view, state.setting);
}

/// The setting that a reader most likely wants to see first: the best by the study's metric that is not the baseline.
function first_choice() {
  const rows = rows_of_view(state.view).filter((row) => !row.failed);
  const others = rows.filter((row) => !row.baseline);
  if (others.length === 0) return (rows[0] ?? data.rows[0])?.setting ?? null;
  if (main_metric === null) return others[0].setting;
  const score = (row) => badness(main_metric, metric_mean(row, main_metric));
  return others.reduce((best, row) => (score(row) < score(best) ? row : best)).setting;
}

state.setting = first_choice();
