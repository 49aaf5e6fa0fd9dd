// Play, time, speed and layers of a player: createControls(element, player, {horizon, end, speed}) -> {setTime(t), remove()}.
// speed: at first; one that suits the horizon if left out.

import { timeScale } from "./chart.js";
import { el, fixed, svg } from "./dom.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2];
const FINE = 1000;

// Toggles for the layers of a player, and what those that are shown mean: {toggles, legend}.
export function createLayers(player) {
  const details = [];
  const toggles = el("div", { class: "layers", role: "group", "aria-label": "Show" });
  for (const { name, label, shown } of player.layers) {
    if (name === "robot") continue; // always there
    const [, title, detail] = /^(.*?)(?: \((.*)\))?$/.exec(label);
    const box = el("input", { type: "checkbox", onchange: () => { player.setVisible(name, box.checked); explain(); } });
    box.checked = shown;
    toggles.append(el("label", {}, box, el("span", {}, title)));
    if (detail) details.push([box, `${title}: ${detail}`]);
  }
  // what the layers that are shown mean
  const legend = el("p", { class: "meanings" });
  const explain = () => { legend.textContent = details.filter(([box]) => box.checked).map(([, text]) => text).join("  \u00b7  "); };
  explain();
  return { toggles, legend };
}

export function createControls(element, player, { horizon, end, speed: wished }) {
  const scale = timeScale(horizon, end);
  const play = el("button", { class: "play", type: "button", "aria-label": "Play", title: "Play or pause (space)", onclick: toggle });
  const slider = el("input", { type: "range", min: 0, max: FINE, step: "any", value: 0, "aria-label": "Time", oninput: () => { const t = scale.inverse(slider.value / FINE); player.pause(); player.seek(t); } });
  const track = el("div", { class: "track" }, slider);
  if (scale.horizon) track.append(el("span", { class: "tick", style: `left:${scale.forward(horizon) * 100}%`, title: "horizon T, then the hold" }));
  slider.addEventListener("keydown", onKey);
  const now = el("output", { class: "now" });
  const digits = end < 10 ? 3 : 2;

  const speeds = el("div", { class: "speeds", role: "radiogroup", "aria-label": "Speed" });
  for (const speed of SPEEDS) {
    speeds.append(el("label", {}, el("input", { type: "radio", name: "speed", value: speed, onchange: () => player.setSpeed(speed) }), el("span", {}, `${speed}\u00d7`)));
  }
  // about three seconds for the motion itself
  const first = wished ?? [...SPEEDS].reverse().find((speed) => speed <= 1 && horizon / speed >= 2.5) ?? SPEEDS[0];
  speeds.querySelector(`input[value="${first}"]`).checked = true;
  player.setSpeed(first);

  const { toggles, legend } = createLayers(player);
  element.append(el("div", { class: "transport" }, play, track, now), el("div", { class: "options" }, speeds, toggles, legend));

  function toggle() {
    if (player.playing) player.pause();
    else player.play();
    face();
  }

  // as everywhere else on the page: the player itself leaves sliders alone
  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 10 : 1;
    if (event.key === " ") toggle();
    else if (event.key === "ArrowLeft" || event.key === "ArrowDown") player.stepBy(-step);
    else if (event.key === "ArrowRight" || event.key === "ArrowUp") player.stepBy(step);
    else return;
    event.preventDefault();
  }

  function face() {
    const wanted = player.playing ? "Pause" : "Play";
    if (play.firstChild && play.getAttribute("aria-label") === wanted) return;
    play.setAttribute("aria-label", wanted);
    play.replaceChildren(svg("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("path", { d: player.playing ? "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z" : "M8 4.5v15l12-7.5z" })));
  }

  function setTime(t) {
    slider.value = scale.forward(t) * FINE;
    slider.style.setProperty("--done", `${scale.forward(t) * 100}%`);
    slider.setAttribute("aria-valuetext", `${fixed(t, digits)} seconds of ${fixed(end, digits)}`);
    now.value = `${fixed(t, digits)} / ${fixed(end, digits)} s`;
    face();
  }

  setTime(player.time);
  return { setTime, remove() { element.replaceChildren(); } };
}
