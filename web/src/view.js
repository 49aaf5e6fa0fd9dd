// The page of a robot or of a task, standing still: createView(element, data). data: levade.viewer.still.

import { createLayers } from "./controls.js";
import { el } from "./dom.js";
import { createPlayer } from "./player.js";
import { createThemeButton } from "./theme.js";
import { createRobot } from "./view-robot.js";
import { createTask } from "./view-task.js";

export function createView(element, data) {
  const theme = createThemeButton();
  const stage = el("div", { class: "stage" });
  const controls = el("div", { class: "controls" });
  const side = el("div", { class: "panel side" });
  const below = el("div", { class: "sections" });
  element.replaceChildren(
    el("header", { class: "head" },
      el("div", { class: "line" }, el("span", { class: "brand" }, "levade"), theme.element),
      data.what === "task" ? el("h1", {}, data.name.replaceAll("-", " "), el("span", {}, ` on ${data.scene.robot}`)) : el("h1", { class: "as-is" }, data.name),
      data.description ? el("p", { class: "lead" }, data.description) : null),
    el("main", {},
      el("div", { class: "top" }, el("div", { class: "place" }, el("div", { class: "player panel" }, stage, controls)), side),
      below,
      el("p", { class: "made" }, `Made by ${data.written_by}. Distances in m, angles in rad, z up.`)));
  const player = createPlayer(stage, data.scene, { theme: theme.current(), keys: false });
  theme.onChange((name) => player.setTheme(name));
  const { toggles, legend } = createLayers(player);
  const reset = el("button", { type: "button", class: "quiet", onclick: () => player.resetView() }, "Reset view");
  controls.append(el("div", { class: "options" }, toggles, reset, legend));
  const create = { robot: createRobot, task: createTask }[data.what];
  create({ side, below, toggles, stage, player, theme, data });
}
