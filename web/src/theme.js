// Light or dark: as the reader's system has it, until the button says otherwise.

import { el, svg } from "./dom.js";

const SUN = "M12 7a5 5 0 1 0 0 10 5 5 0 0 0 0-10zM12 1v3M12 20v3M1 12h3M20 12h3M4.2 4.2l2.1 2.1M17.7 17.7l2.1 2.1M4.2 19.8l2.1-2.1M17.7 6.3l2.1-2.1";
const MOON = "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z";

export function createThemeButton() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const listeners = [];
  const current = () => document.documentElement.dataset.theme ?? (system.matches ? "dark" : "light");
  const button = el("button", { class: "theme", type: "button", onclick: () => { document.documentElement.dataset.theme = current() === "dark" ? "light" : "dark"; changed(); } });
  function changed() {
    const other = current() === "dark" ? "light" : "dark";
    button.setAttribute("aria-label", `Switch to ${other}`);
    button.title = `Switch to ${other}`;
    button.replaceChildren(svg("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("path", { d: other === "dark" ? MOON : SUN })));
    listeners.forEach((fn) => fn(current()));
  }
  system.addEventListener("change", changed);
  changed();
  return { element: button, current, onChange(fn) { listeners.push(fn); fn(current()); } };
}
