// The graph of the baseline, drawn where the layout put it; passes that the selected row does without are greyed.

const LONGEST_NAME = 28;

function shortened(text, length = LONGEST_NAME) {
  return text.length <= length ? text : `${text.slice(0, length - 1)}…`;
}

/// "disabled", "culled" or "" for a pass in a row.
function absence(row, pass) {
  if (!row || row.failed) return "";
  return row.disabled.includes(pass.name) ? "disabled" : row.culled.includes(pass.name) ? "culled" : "";
}

class GraphView {
  constructor(container) {
    this.drawing = data.drawing;
    this.side = el("div", { class: "card", "aria-live": "polite" });
    this.nodes = this.drawing.passes.map((pass, index) => this.node(pass, index));
    this.edges = this.drawing.edges.map((edge) => this.edge(edge));
    const { width, height } = this.drawing;
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "group", "aria-label": "Passes of the graph; arrow keys move from pass to pass" },
      this.markers(), this.edges.map((edge) => edge.group), this.nodes.map((node) => node.group));
    const update_focus = roving_focus(picture, () => this.nodes.map((node) => node.group), (target) => this.show(this.nodes.findIndex((node) => node.group === target)));
    update_focus();
    picture.addEventListener("pointerleave", () => this.show(null));
    picture.addEventListener("focusout", () => this.show(null));
    container.append(el("div", { class: "graph" }, el("div", { class: "canvas" }, picture), el("div", { class: "graph-side" }, this.side, this.key())));
    on_change(() => this.update());
    this.update();
    this.show(null);
  }

  markers() {
    const marker = (id, name) => svg("marker", { id, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto-start-reverse" }, svg("path", { d: "M0 0.6 8 4 0 7.4z", class: name }));
    return svg("defs", null, marker("arrow", "arrow"), marker("arrow-history", "arrow history"));
  }

  node(pass, index) {
    const { x, y, width, height } = pass;
    const type = svg("text", { class: "type", x: x + width / 2, y: y + 31 });
    const inner = pass.hoisted ? svg("rect", { class: "inner", x: x + 3, y: y + 3, width: width - 6, height: height - 6, rx: 4 }) : null;
    const group = svg("g", { class: pass.hoisted ? "node hoisted" : "node", role: "img", "data-pass": pass.name, onpointerenter: () => this.show(index) },
      svg("rect", { x, y, width, height, rx: 6 }), inner, svg("text", { x: x + width / 2, y: y + 17 }, shortened(pass.name)), type);
    return { pass, group, type };
  }

  edge(edge) {
    const line = svg("path", { class: edge.history ? "edge history" : "edge", d: edge.path, "marker-end": edge.history ? "url(#arrow-history)" : "url(#arrow)" });
    const hit = svg("path", { class: "edge-hit", d: edge.path });
    add_tooltip(hit, () => this.edge_text(edge));
    const age = edge.ages ? svg("text", { class: "age", x: edge.x, y: edge.y }, edge.ages) : null;
    return { edge, line, age, group: svg("g", null, line, age, hit) };
  }

  name(index) {
    return this.drawing.passes[index].name;
  }

  edge_text(edge) {
    return `${this.name(edge.from)} → ${this.name(edge.to)}${edge.ages ? ` ${edge.ages}, of earlier frames` : ""}\n${edge.labels.join("\n")}`;
  }

  key() {
    const box = (dashes, inner) => svg("svg", { viewBox: "0 0 42 20" }, svg("g", { class: dashes ? "node off" : "node" }, svg("rect", { x: 3, y: 2, width: 36, height: 16, rx: 4 }), inner ? svg("rect", { class: "inner", x: 5.5, y: 4.5, width: 31, height: 11, rx: 2 }) : null));
    const line = (name) => svg("svg", { viewBox: "0 0 42 20" }, svg("path", { class: name, d: "M2 10H40" }));
    return el("div", { class: "key" }, line("edge"), "a value of this frame", line("edge history"), "of earlier frames, with their age",
              box(false, true), "hoisted: runs once, before the first frame", box(true, false), "not run in the selected setting");
  }

  update() {
    const row = selected_row();
    const off = this.drawing.passes.map((pass) => absence(row, pass));
    this.nodes.forEach(({ pass, group, type }, i) => {
      group.classList.toggle("off", off[i] !== "");
      type.textContent = off[i] || shortened(pass.type, 32);
      const how = off[i] ? `${off[i]} in ${row.setting}` : pass.hoisted ? "hoisted: runs once" : "runs each frame";
      group.setAttribute("aria-label", `${pass.name}, ${pass.type}, ${how}`);
    });
    for (const { edge, line, age } of this.edges) {
      const gone = off[edge.from] !== "" || off[edge.to] !== "";
      line.classList.toggle("off", gone);
      age?.classList.toggle("off", gone);
    }
    const names = (what) => this.drawing.passes.filter((pass, i) => off[i] === what).map((pass) => pass.name);
    const parts = ["disabled", "culled"].map((what) => [what, names(what)]).filter(([, list]) => list.length > 0).map(([what, list]) => `${what}: ${list.join(", ")}`);
    const without = parts.length > 0 ? ` ${row.setting} does without: ${parts.join("; ")}.` : row && !row.failed ? ` ${row.setting} runs every pass of it.` : "";
    by_id("graph-lead").textContent = `The baseline's ${this.drawing.passes.length} passes in the order in which they run, from top to bottom.${without}`;
  }

  /// Marks a pass and what it is linked with; null for none.
  show(index) {
    this.edges.forEach(({ edge, line }) => line.classList.toggle("near", index !== null && (edge.from === index || edge.to === index)));
    this.nodes.forEach(({ group }, i) => group.classList.toggle("near", i === index));
    if (index === null || index < 0) {
      this.side.replaceChildren(el("p", { class: "hint" }, "Point at a pass, or focus the graph and use the arrow keys: its ports are named here."));
      return;
    }
    const { pass } = this.nodes[index];
    const list = (title, edges, other) => edges.length === 0 ? [] : [el("h4", null, title), el("ul", null, edges.map((edge) => el("li", null, el("b", null, this.name(edge[other])), edge.ages ? ` ${edge.ages}` : "", edge.labels.length > 0 ? `: ${edge.labels.join(", ")}` : "")))];
    const gone = absence(selected_row(), pass);
    const timing = selected_row()?.passes.find((entry) => entry.pass === pass.name);
    this.side.replaceChildren(el("h3", null, pass.name), el("p", { class: "hint" }, pass.type, pass.hoisted ? ", hoisted" : "", gone ? `, ${gone} in ${state.setting}` : timing ? `, ${number_text(timing.hoisted ? timing.once : timing.frame.median)} ms ${timing.hoisted ? "once" : "a frame"} in ${state.setting}` : ""),
      ...list("Reads from", this.drawing.edges.filter((edge) => edge.to === index), "from"), ...list("Read by", this.drawing.edges.filter((edge) => edge.from === index), "to"));
  }
}
