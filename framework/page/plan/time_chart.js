// Steps as they could run if only values ordered them, and one after another.

const TIME_ROW = 20;

class TimeChart {
  constructor(body) {
    this.times = plan.times;
    this.critical = new Set(this.times.critical_steps);
    const gain = this.times.sum_ms - this.times.critical_path_ms;
    this.canvas = el("div", { class: "plan-chart" });
    body.append(
      el("p", { class: "lead" }, `One after another the passes take ${milliseconds_text(this.times.sum_ms)}; the longest chain of them ${milliseconds_text(this.times.critical_path_ms)}. Overlapping what can be overlapped saves at most ${milliseconds_text(gain)} of a frame. Medians of `, el("code", null, this.times.run), "."),
      el("ul", { class: "legend" }, [["on", "on the critical path"], ["off", "beside it, as early as it could run"]].map(([kind, text]) =>
        el("li", null, svg("svg", { width: 26, height: 12, "aria-hidden": "true" }, svg("rect", { x: 0, y: 2, width: 26, height: 8, rx: 2, class: `time ${kind}` })), text))),
      this.canvas);
    draw_to_width(this.canvas, (width) => this.draw(width));
  }

  draw(width) {
    const left = LABEL;
    const right = width - 70;
    const longest = Math.max(this.times.sum_ms, 1e-9);
    const x = (ms) => left + ((right - left) * ms) / longest;
    const top = 26;
    const height = top + step_count * TIME_ROW + 30;
    const root = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "When each pass could run" });
    for (const [ms, name, kind] of [[this.times.critical_path_ms, "critical path", "bound"], [this.times.sum_ms, "sum", "heap-end"]])
      root.append(svg("path", { d: `M${x(ms)} ${top - 6}V${height - 26}`, class: kind }),
        svg("text", { x: x(ms), y: kind === "bound" ? height - 10 : 14, class: "axis-text" }, `${name} ${milliseconds_text(ms)}`));
    plan.steps.forEach((step, i) => root.append(this.step(step, i, x, top + i * TIME_ROW)));
    this.canvas.replaceChildren(root);
    roving_focus(root, () => [...root.querySelectorAll(".time-row")])();
    search.apply();
  }

  step(step, i, x, y) {
    const start = this.times.earliest_ms[i];
    const ms = this.times.step_ms[i];
    const kind = this.critical.has(i) ? "on" : "off";
    const group = svg("g", { class: "time-row", tabindex: "-1", "data-find": step.pass, role: "img", "aria-label": `${step.pass} ${milliseconds_text(ms)}` });
    group.append(svg("text", { x: LABEL - 8, y: y + 14, class: `row-name ${kind}` }, step.pass),
      svg("rect", { x: x(start), y: y + 3, width: Math.max(1.5, x(start + ms) - x(start)), height: TIME_ROW - 6, rx: 2, class: `time ${kind}` }),
      svg("text", { x: x(start + ms) + 5, y: y + 14, class: "value-text" }, milliseconds_text(ms)));
    add_tooltip(group, () => `${step.pass} (${step.type})\n${milliseconds_text(ms)}, ${number_text((100 * ms) / this.times.sum_ms, 2)} % of the sum\ncould begin ${milliseconds_text(start)} into the frame${kind === "on" ? "\non the critical path" : ""}`);
    return group;
  }
}
