// Puts the page together; a section with nothing to show goes away, its link too.

function start_section(id, has_content, make) {
  if (has_content) make(by_id(`${id}-body`));
  else {
    by_id(id).hidden = true;
    document.querySelector(`.links a[href="#${id}"]`).hidden = true;
  }
}

start_theme();
start_summary();
by_id("search").addEventListener("input", (event) => {
  search.words = event.target.value.trim().toLowerCase();
  search.apply();
});
start_section("order", step_count + plan.once.length > 0, (body) => new OrderChart(body));
start_section("memory", plan.values.length > 0, start_memory);
start_section("times", plan.times !== null && step_count > 0, (body) => new TimeChart(body));
start_section("steps", step_count + plan.once.length > 0, start_steps);
start_section("barriers", barriers.length > 0, start_barriers);
start_section("left", plan.once.length + plan.bypassed.length + plan.culled.length + plan.notes.length > 0, start_left_out);
document.documentElement.dataset.ready = "true";
