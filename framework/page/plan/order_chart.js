// Columns are steps, rows what passes write.

const ROW = 18;
const LETTER = 7.05; // width of one in the font of names
const MOST_LETTERS = 36;
const LABEL = 18 + LETTER * Math.min(MOST_LETTERS, Math.max(18, ...rows.map((row) => row.name.length)));
const EDGE = 26;

class Columns {
  /// `width`: of the whole drawing.
  constructor(width) {
    this.before = plan.once.length > 0 || plan.clears.length > 0;
    const columns = step_count + (this.before ? 1 : 0);
    this.pitch = Math.max(19, Math.min(86, (width - LABEL - EDGE) / Math.max(1, columns)));
    this.left = LABEL + (this.before ? this.pitch : 0);
    this.width = Math.ceil(this.left + this.pitch * step_count + EDGE);
  }
  /// Left end of a step's column; -1: of what comes before the frame's steps.
  x(step) {
    return this.left + step * this.pitch;
  }
  middle(step) {
    return this.x(step) + this.pitch / 2;
  }
}

function step_text(step) {
  const entry = plan.steps[step];
  const lines = [`${plan.once.length + step + 1}. ${entry.pass} (${entry.type})`];
  if (entry.inputs.length > 0)
    lines.push(`reads ${[...new Set(entry.inputs.map((use) => `${port_of(use.value)}${ages_text(use)}`))].join(", ")}`);
  lines.push(`writes ${[...new Set([...entry.outputs, ...entry.scratch].map((use) => port_of(use.value)))].join(", ")}`);
  if (plan.times !== null) lines.push(`takes ${milliseconds_text(plan.times.step_ms[step])}`);
  return lines.join("\n");
}

function port_of(value) {
  return row_of_value.get(value)?.name ?? value;
}

class OrderChart {
  constructor(body) {
    this.body = body;
    this.canvas = el("div", { class: "plan-chart" });
    body.append(this.legend(), this.canvas);
    draw_to_width(this.canvas, (width) => this.draw(width));
  }

  legend() {
    const swatch = (kind) => svg("svg", { width: 26, height: 12, "aria-hidden": "true" }, svg("rect", { x: 0, y: 2, width: 26, height: 8, rx: 3, class: `life ${kind}` }));
    const mark = (kind) => svg("svg", { width: 14, height: 12, "aria-hidden": "true" }, this.mark(kind, 7, 6));
    return el("ul", { class: "legend" },
      ["frame", "history", "persistent", "once", "constant"].filter((kind) => rows.some((row) => row.kept === kind)).map((kind) => el("li", null, swatch(kind), kind)),
      plan.times === null ? [] : el("li", null, svg("svg", { width: 14, height: 12, "aria-hidden": "true" }, svg("rect", { width: 14, height: 12, class: "critical-swatch" })), "step on the critical path"),
      [["write", "write"], ["read", "read"], ["history", "read of earlier frames"], ["observe", "read back or scanned"]].map(([kind, text]) => el("li", null, mark(kind), text)));
  }

  mark(kind, x, y) {
    if (kind === "write") return svg("rect", { x: x - 4, y: y - 4, width: 8, height: 8, class: "mark write" });
    if (kind === "observe") return svg("path", { d: `M${x - 4} ${y + 4}h8l-4 -7z`, class: "mark observe" });
    const circle = svg("circle", { cx: x, cy: y, r: 4, class: `mark ${kind}` });
    return kind === "read" ? circle : svg("g", null, circle, svg("path", { d: `M${x - 7} ${y}h6`, class: "mark dash" }));
  }

  draw(width) {
    const columns = new Columns(width);
    const top = 52 + 0.82 * LETTER * Math.max(6, ...plan.steps.map((step) => step.pass.length));
    const height = top + rows.length * ROW + 12;
    this.marks = [];
    const root = svg("svg", { width: columns.width, height, viewBox: `0 0 ${columns.width} ${height}`, role: "group", "aria-label": "Lifetimes of values over the steps of a frame" });
    root.append(...this.stripes(columns, top, height), ...rows.map((row, i) => this.row(row, columns, top + i * ROW)), ...this.heads(columns, top));
    this.canvas.replaceChildren(root);
    roving_focus(root, () => [...root.querySelectorAll(".order-row")])();
    search.apply();
  }

  stripes(columns, top, height) {
    const critical = new Set(plan.times?.critical_steps ?? []);
    return plan.steps.map((_, step) =>
      svg("rect", { x: columns.x(step), y: top - 24, width: columns.pitch, height: height - top + 18, class: `stripe${step % 2 === 1 ? " odd" : ""}${critical.has(step) ? " critical" : ""}`, "data-step": step }));
  }

  /// Name of a step, its number, and what waits before it.
  heads(columns, top) {
    const heads = plan.steps.map((step, i) => this.head(columns.middle(i), top, step.pass, plan.once.length + i + 1, i));
    if (columns.before) heads.unshift(this.head(columns.middle(-1), top, plan.once.length > 0 ? "once" : "cleared", "", -1));
    return heads;
  }

  head(x, top, name, number, step) {
    const waits = barriers.filter((barrier) => barrier.step === step);
    const text = svg("text", { x: 0, y: 0, transform: `translate(${x + 3} ${top - 40}) rotate(-55)`, class: "step-name" }, name);
    const below = svg("text", { x, y: top - 12, class: "step-number" }, String(number));
    const group = svg("g", { class: "step-head", "data-step": step, "data-find": name }, text, below);
    if (step >= 0) {
      for (const target of [text, below]) add_tooltip(target, () => step_text(step));
      group.addEventListener("pointerenter", () => this.highlight(step));
      group.addEventListener("pointerleave", () => this.highlight(null));
    } else if (plan.once.length > 0) {
      add_tooltip(text, () => plan.once.map((entry) => `${entry.pass}: ${entry.once}`).join("\n"));
    }
    if (waits.length > 0) {
      const dot = svg("g", { class: "wait" }, svg("circle", { cx: x, cy: top - 31, r: 6.5 }), svg("text", { x, y: top - 27.5 }, String(waits.length)));
      add_tooltip(dot, () => `${count_text(waits.length, "barrier", "barriers")} before ${name}\n` + grouped_barriers(waits).map((group) => `${group.subject}: ${group.reason}`).join("\n"));
      group.append(dot);
    }
    return group;
  }

  row(row, columns, y) {
    const middle = y + ROW / 2;
    const group = svg("g", { class: `order-row${row.scratch ? " scratch" : ""}`, tabindex: "-1", "data-find": row.name, role: "img", "aria-label": row_text(row) });
    const bar = (from, to, extra) => svg("rect", { x: from, y: y + 3, width: Math.max(2, to - from), height: ROW - 6, rx: 4, class: `life ${row.kept}${extra}` });
    group.append(svg("rect", { x: 0, y, width: columns.width, height: ROW, class: "row-hit" }));
    const label = row.name.length > MOST_LETTERS ? `${row.name.slice(0, MOST_LETTERS - 1)}…` : row.name;
    group.append(svg("text", { x: LABEL - 8, y: middle + 4, class: "row-name" }, label));
    const begin = row.kept === "once" || row.kept === "constant" ? columns.x(-1) : columns.x(0);
    if (row.kept !== "frame") group.append(bar(begin + 2, columns.x(step_count) + EDGE - 4, " beyond"));
    if (row.first !== null) group.append(bar((row.kept === "once" ? columns.x(-1) : columns.x(row.first)) + 2, columns.x(row.last + 1) - 2, ""));
    else if (row.kept === "once") group.append(bar(columns.x(-1) + 2, columns.x(0) - 2, ""));
    const several = (touch) => row.touches.filter((other) => other.step === touch.step);
    for (const touch of row.touches) {
      const here = several(touch);
      const mark = this.mark(touch.kind, columns.middle(touch.step) + (here.indexOf(touch) - (here.length - 1) / 2) * 9, middle);
      mark.dataset.step = touch.step;
      group.append(mark);
    }
    add_tooltip(group, () => row_text(row));
    return group;
  }

  highlight(step) {
    for (const item of this.canvas.querySelectorAll(".stripe")) item.classList.toggle("near", Number(item.dataset.step) === step);
    for (const row of this.canvas.querySelectorAll(".order-row"))
      row.classList.toggle("apart", step !== null && ![...row.querySelectorAll("[data-step]")].some((mark) => Number(mark.dataset.step) === step));
  }
}
