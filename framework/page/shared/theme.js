// Dark and light: the system's choice until the button is pressed, which is remembered where the browser allows it.

const THEME_KEY = "lightloom-report-theme";

function stored_theme() {
  try {
    return localStorage.getItem(THEME_KEY);
  } catch {
    return null;
  }
}

function start_theme() {
  const root = document.documentElement;
  const button = by_id("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const is_dark = () => (root.dataset.theme ? root.dataset.theme === "dark" : system.matches);
  const show = () => {
    button.textContent = is_dark() ? "☀ Light" : "☾ Dark";
    button.setAttribute("aria-label", is_dark() ? "Switch to the light theme" : "Switch to the dark theme");
  };
  const stored = stored_theme();
  if (stored === "dark" || stored === "light") root.dataset.theme = stored;
  button.addEventListener("click", () => {
    root.dataset.theme = is_dark() ? "light" : "dark";
    try {
      localStorage.setItem(THEME_KEY, root.dataset.theme);
    } catch {
      // A browser may refuse to keep anything for a file: the theme then holds until the page closes.
    }
    show();
  });
  system.addEventListener("change", show);
  show();
}
