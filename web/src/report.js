// report.html: createReport(element, data) builds the page, and ties player, plots and keyboard to one time.

import { createControls } from "./controls.js";
import { el, significant, svg } from "./dom.js";
import { createPlayer } from "./player.js";
import { createPlots } from "./plots.js";
import { createProvenance } from "./provenance.js";
import { createSummary, verdict } from "./summary.js";
import { createThemeButton } from "./theme.js";

export function createReport(element, data) {
  const stage = el("div", { class: "stage" });
  const controls = el("div", { class: "controls" });
  const side = el("div", { class: "side" });
  const plots = el("div", { class: "sections" });
  const foot = el("footer", { class: "panel", id: "provenance" });
  const theme = createThemeButton();
  const player = el("div", { class: "player panel" }, stage, controls);
  const main = el("main", {}, el("div", { class: "top" }, el("div", { class: "place" }, player), el("div", { class: "panel" }, side)), plots, foot);
  element.replaceChildren(head(data, theme.element), main);
  requestAnimationFrame(() => start(data, { stage, controls, side, plots, foot, theme, player }));
}

function head({ summary, provenance }, themeButton) {
  const { task, robot, seed, horizon, hold, trials, trials_to_success: first, description } = provenance;
  const facts = [
    ["Horizon", `${significant(horizon)} s${hold > 1e-9 ? `, then ${significant(hold)} s of hold` : ""}`],
    ["Trials", String(trials)],
    ["First success", first === null ? "none" : `trial ${first}`],
    ["Seed", String(seed)],
  ];
  return el("header", { class: "head" },
    el("div", { class: "line" }, el("span", { class: "brand" }, "levade"), themeButton),
    el("h1", {}, task.replaceAll("-", " "), el("span", {}, ` on ${robot}`)),
    description ? el("p", { class: "lead" }, description) : null,
    el("div", { class: "line facts" }, verdict(summary), el("dl", {}, facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))))));
}

function start({ summary, series, scene, provenance }, { stage, controls, side, plots, foot, theme, player: box }) {
  createSummary(side, summary);
  createProvenance(foot, provenance);
  const drawn = createPlots(plots, series);
  const player = createPlayer(stage, scene, { theme: theme.current() });
  theme.onChange((name) => player.setTheme(name));
  const bar = createControls(controls, player, series);
  player.onTime((t) => { drawn.setTime(t); bar.setTime(t); });
  drawn.onSeek((t) => { player.pause(); player.seek(t); });
  player.seek(0);
  float(box, stage);
  forPrint();
  document.documentElement.dataset.ready = "";
}

// Once scrolled past, the player stays in sight in a corner, so that plots can be read beside it; until it is sent away.
function float(box, stage) {
  const place = box.parentElement;
  let dismissed = false;
  const away = el("button", { type: "button", class: "away", "aria-label": "Close the small player", onclick: () => { dismissed = true; box.classList.remove("floating"); } }, svg("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, svg("path", { d: "M3 3l10 10M13 3L3 13" })));
  stage.append(away);
  new IntersectionObserver(([entry]) => {
    const past = !entry.isIntersecting && entry.boundingClientRect.bottom < 0;
    place.style.height = past ? `${entry.boundingClientRect.height}px` : "";
    box.classList.toggle("floating", past && !dismissed);
  }).observe(place);
}

// Paper is light.
function forPrint() {
  const root = document.documentElement.dataset;
  let before;
  addEventListener("beforeprint", () => { before = root.theme; root.theme = "light"; });
  addEventListener("afterprint", () => { if (before) root.theme = before; else delete root.theme; });
}
