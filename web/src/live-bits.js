// Small parts that the served pages share.

import { el } from "./dom.js";

// A round mark in a colour.
export function spot(colour) {
  return el("i", { class: "spot", style: `background:${colour}` });
}

// A line to be typed in a shell, or put into a file, with a button that copies it.
export function command(text, attributes = {}) {
  const code = el("code", attributes, text);
  const button = el("button", { type: "button", class: "copy", onclick: () => copy(code, button) }, "Copy");
  return el("div", { class: "command" }, code, button);
}

async function copy(code, button) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = "Copied";
  } catch {
    const range = document.createRange();
    range.selectNodeContents(code);
    getSelection().removeAllRanges();
    getSelection().addRange(range);
    button.textContent = "Selected";
  }
  setTimeout(() => { button.textContent = "Copy"; }, 1500);
}
