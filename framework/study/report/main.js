// Puts the page together; a section with nothing to show goes away, its link too.

function start_section(id, has_content, make) {
  if (has_content) make(by_id(`${id}-body`));
  else {
    by_id(id).hidden = true;
    document.querySelector(`.links a[href="#${id}"]`).hidden = true;
  }
}

function start_toolbar() {
  const view = by_id("view");
  const setting = by_id("setting");
  view.append(...data.views.map((entry, i) => el("option", { value: i }, entry.title)));
  view.addEventListener("change", () => change({ view: Number(view.value) }));
  setting.addEventListener("change", () => change({ setting: setting.value, reference_right: false }));
  by_id("view-pick").hidden = data.views.length < 2;
  setting.closest("label").hidden = data.rows.length === 0;
  const update = () => {
    view.value = state.view;
    setting.replaceChildren(...rows_of_view(state.view).map((row) => el("option", { value: row.setting, selected: row.setting === state.setting }, row.setting)));
  };
  on_change(update);
  update();
}

start_theme();
start_toolbar();
zoom.root = by_id("pictures");
const measured = data.rows.filter((row) => !row.failed);
start_section("graph", data.drawing.passes.length > 0, (body) => new GraphView(body));
start_section("results", data.rows.length > 0, (body) => new ResultsTable(body));
start_section("pictures", data.rows.some((row) => row.picture !== null) || data.views.some((view) => view.reference !== null), (body) => {
  new Compare(body);
  new PictureGrid(body);
  set_zoom(1, 0.5, 0.5);
});
start_section("times", measured.some((row) => row.passes.length > 0), (body) => new PassBars(body));
start_section("pareto", measured.length > 0 && main_metric !== null, (body) => new ParetoPlot(body));
start_section("equal", data.equal_time.length + data.equal_error.length > 0, (body) => new TradeTables(body));
document.documentElement.dataset.ready = "true";
