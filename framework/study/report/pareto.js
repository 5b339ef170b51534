// Error against milliseconds, with the front of settings that no other beats in both.

const PLOT = { left: 64, right: 18, top: 26, bottom: 50 };

class ParetoPlot {
  constructor(container) {
    this.metric = main_metric;
    this.log = { x: true, y: true };
    this.chart = el("div", { class: "chart" });
    this.status = el("p", { class: "hint", role: "status" });
    const metrics = data.metrics.map((metric) => [metric.name, metric.label]);
    container.append(
      el("div", { class: "controls" },
        el("label", null, "Metric", select_box(metrics, this.metric?.name, (name) => ((this.metric = metric_by_name.get(name)), this.redraw()), { id: "pareto-metric" })),
        checkbox("log time", true, (on) => ((this.log.x = on), this.redraw())), checkbox("log error", true, (on) => ((this.log.y = on), this.redraw()))),
      el("ul", { class: "legend" }, this.legend()), el("div", { class: "plot" }, this.chart), this.status);
    this.redraw = draw_to_width(this.chart, (width) => this.draw(width));
    this.update_focus = roving_focus(this.chart, () => [...this.chart.querySelectorAll(".point")]);
    this.update_focus();
    on_change(() => this.redraw());
  }

  legend() {
    const item = (name, shape, text) => el("li", null, svg("svg", { viewBox: "-9 -7 18 14" }, svg("g", { class: name }, shape)), text);
    return [item("point front", this.mark("front", 0, 0), "on the front"), item("point", this.mark("", 0, 0), "beaten in both"), item("point baseline", this.mark("baseline", 0, 0), "baseline"),
            item("point selected", svg("circle", { class: "ring", r: 5.5 }), "selected"), item("", svg("path", { class: "front-line", d: "M-9 0H9" }), "front")];
  }

  mark(kind, x, y) {
    if (kind === "baseline") return svg("rect", { class: "mark", x: x - 4.5, y: y - 4.5, width: 9, height: 9, transform: `rotate(45 ${x} ${y})` });
    return svg("circle", { class: "mark", cx: x, cy: y, r: kind === "front" ? 5 : 4.5 });
  }

  draw(width) {
    if (this.metric === null) return;
    const height = Math.round(Math.min(520, Math.max(320, width * 0.55)));
    const { points, left_out } = pareto_points(this.metric, this.log.x, this.log.y);
    const ends = (key) => points.flatMap((point) => [point[key].mean, point[key].low, point[key].high]);
    const x = make_scale(ends("time"), this.log.x, PLOT.left, width - PLOT.right);
    const y = make_scale(ends("value"), this.log.y, height - PLOT.bottom, PLOT.top);
    for (const point of points) Object.assign(point, { x: x.at(point.time.mean), y: y.at(point.value.mean) });
    place_labels(points, width, height - PLOT.bottom);
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, height, role: "group", "aria-label": `${this.metric.label} against milliseconds a frame, ${points.length} settings; arrow keys move from point to point` },
      this.axes(x, y, width, height), svg("path", { class: "front-line", d: front_path(points) }), points.map((point) => this.point(point, x, y)));
    const focused = document.activeElement?.closest?.(".point")?.dataset.setting;
    this.chart.replaceChildren(picture);
    this.update_focus?.();
    if (focused !== undefined) [...this.chart.querySelectorAll(".point")].find((point) => point.dataset.setting === focused)?.focus({ preventScroll: true });
    this.status.textContent = `${points.length} settings drawn${left_out > 0 ? `; ${left_out} have no number that these axes can show` : ""}. Bars are 95 % confidence intervals.`;
  }

  axes(x, y, width, height) {
    const bottom = height - PLOT.bottom;
    const right = width - PLOT.right;
    const across = axis_ticks(x, Math.max(3, Math.floor(width / 75))).map((value) => {
      const at = x.at(value).toFixed(1);
      return svg("g", null, svg("path", { class: "grid", d: `M${at} ${PLOT.top}V${bottom}` }), svg("text", { class: "soft", x: at, y: bottom + 17, "text-anchor": "middle" }, tick_text(value)));
    });
    const up = axis_ticks(y, Math.max(3, Math.floor(height / 45))).map((value) => {
      const at = y.at(value).toFixed(1);
      return svg("g", null, svg("path", { class: "grid", d: `M${PLOT.left} ${at}H${right}` }), svg("text", { class: "soft", x: PLOT.left - 8, y: Number(at) + 4, "text-anchor": "end" }, tick_text(value)));
    });
    const size = this.metric.best === "zero" && this.log.y ? `|${this.metric.label}|` : this.metric.label;
    const unit = this.metric.unit ? `, ${this.metric.unit}` : "";
    return svg("g", { "aria-hidden": "true" }, across, up, svg("path", { class: "axis", d: `M${PLOT.left} ${PLOT.top}V${bottom}H${right}` }),
      svg("text", { x: 4, y: 14 }, `${size}${unit} (${best_text(this.metric)})`), svg("text", { x: right, y: height - 10, "text-anchor": "end" }, "frame, ms (further left is faster)"));
  }

  point(point, x, y) {
    const { row } = point;
    const names = ["point", point.front ? "front" : "", row.baseline ? "baseline" : "", row.setting === state.setting ? "selected" : ""].filter(Boolean).join(" ");
    const words = () => `${row.setting}\n${this.metric.label} ${estimate_text(row.metrics[this.metric.name])} ${this.metric.unit}\n${estimate_text(point.time)} ms a frame${point.front ? "\non the front" : ""}`;
    const whisker = (from, to) => svg("path", { class: "whisker", d: `M${from.map((v) => v.toFixed(1)).join(" ")}L${to.map((v) => v.toFixed(1)).join(" ")}` });
    const choose = () => change({ setting: row.setting, reference_right: false });
    const group = svg("g", { class: names, tabindex: "-1", role: "button", "aria-label": words(), "data-setting": row.setting, onclick: choose },
      half_width(point.value) !== null ? whisker([point.x, y.at(point.value.low)], [point.x, y.at(point.value.high)]) : null,
      half_width(point.time) !== null ? whisker([x.at(point.time.low), point.y], [x.at(point.time.high), point.y]) : null,
      svg("circle", { class: "ring", cx: point.x, cy: point.y, r: 10 }), this.mark(row.baseline ? "baseline" : point.front ? "front" : "", point.x, point.y),
      point.label ? svg("text", { class: "point-label", x: point.label.x, y: point.label.y }, point.label.text) : null);
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      choose();
    });
    add_tooltip(group, words);
    return group;
  }
}
