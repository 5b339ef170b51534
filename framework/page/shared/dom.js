// Making elements. Text always goes in as text, so that no name can become markup.

const SVG = "http://www.w3.org/2000/svg";

function fill_element(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

function el(tag, attributes, ...children) {
  return fill_element(document.createElement(tag), attributes, children);
}

function svg(tag, attributes, ...children) {
  return fill_element(document.createElementNS(SVG, tag), attributes, children);
}

function by_id(id) {
  return document.getElementById(id);
}

function checkbox(label, checked, on_change) {
  const input = el("input", { type: "checkbox", checked });
  input.addEventListener("change", () => on_change(input.checked));
  return el("label", null, input, label);
}

/// `options`: [value, text] pairs.
function select_box(options, value, on_change, attributes) {
  const box = el("select", attributes, options.map(([key, text]) => el("option", { value: key, selected: key === value }, text)));
  box.addEventListener("change", () => on_change(box.value));
  return box;
}

/// Calls draw(width) now and whenever the width changes.
function draw_to_width(container, draw) {
  let width = 0;
  const check = () => {
    const now = Math.floor(container.clientWidth);
    if (now > 0 && now !== width) draw((width = now));
  };
  new ResizeObserver(() => requestAnimationFrame(check)).observe(container);
  check();
  return () => width > 0 && draw(width);
}

/// One stop for the Tab key among `items()`; arrow keys, Home and End move on. Returns what to call after a change.
function roving_focus(group, items, on_focus) {
  let at = 0;
  const update = () => items().forEach((item, i) => item.setAttribute("tabindex", i === at ? "0" : "-1"));
  group.addEventListener("focusin", (event) => {
    const i = items().indexOf(event.target);
    if (i < 0) return;
    at = i;
    update();
    on_focus?.(event.target);
  });
  group.addEventListener("keydown", (event) => {
    const list = items();
    if (!list.includes(event.target)) return;
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const to = event.key === "Home" ? 0 : event.key === "End" ? list.length - 1 : step === undefined ? null : at + step;
    if (to === null || to < 0 || to >= list.length) return;
    event.preventDefault();
    list[to].focus();
  });
  return () => {
    at = Math.min(at, Math.max(0, items().length - 1));
    update();
  };
}
