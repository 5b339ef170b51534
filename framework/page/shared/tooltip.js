// One tooltip for all drawings, shown by the pointer or by focus, hidden by Escape.

const tooltip = el("div", { id: "tooltip", role: "tooltip", hidden: true });
document.body.append(tooltip);

function show_tooltip(text, x, y) {
  tooltip.textContent = text;
  tooltip.hidden = false;
  const box = tooltip.getBoundingClientRect();
  const left = Math.max(4, Math.min(innerWidth - box.width - 4, x + 14));
  const top = y + 18 + box.height > innerHeight ? y - box.height - 10 : y + 18;
  tooltip.style.left = `${left}px`;
  tooltip.style.top = `${Math.max(4, top)}px`;
}

function hide_tooltip() {
  tooltip.hidden = true;
}

/// `text`: a function that gives what to show.
function add_tooltip(element, text) {
  element.addEventListener("pointermove", (event) => show_tooltip(text(), event.clientX, event.clientY));
  element.addEventListener("pointerleave", hide_tooltip);
  element.addEventListener("focus", () => {
    if (!element.matches(":focus-visible")) return;
    const box = element.getBoundingClientRect();
    show_tooltip(text(), box.left + Math.min(box.width / 2, 80), box.bottom - 12);
  });
  element.addEventListener("blur", hide_tooltip);
}

addEventListener("keydown", (event) => event.key === "Escape" && hide_tooltip());
addEventListener("scroll", hide_tooltip, { passive: true });
