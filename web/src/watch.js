// The page of a solve: createWatch(element, {token}). What it shows comes over the server's events (levade.viewer.watching); what it says
// goes back as commands. It stays as it is when the solve has ended and the server is gone.

import { createControls } from "./controls.js";
import { el } from "./dom.js";
import { createPlayer } from "./player.js";
import { createThemeButton } from "./theme.js";
import { createCurves, looksOf } from "./watch-curves.js";
import { createLink } from "./watch-link.js";
import { createStatus } from "./watch-status.js";
import { createWeights } from "./watch-weights.js";

export function createWatch(element, { token }) {
  const theme = createThemeButton();
  const stage = el("div", { class: "stage" }, el("p", { class: "waiting" }, "Waiting for the first motion \u2026"));
  const badge = el("output", { class: "badge" });
  const controls = el("div", { class: "controls" });
  const side = el("div", { class: "panel status" });
  const search = el("section", { class: "panel", id: "search" });
  const costs = el("section", { class: "panel pair", id: "costs" });
  const title = el("h1", {}, "Solving");
  const lead = el("p", { class: "lead" });
  const facts = el("p", { class: "lead facts-line" });
  element.replaceChildren(
    el("header", { class: "head" }, el("div", { class: "line" }, el("span", { class: "brand" }, "levade"), theme.element), title, lead, facts),
    el("main", {},
      el("div", { class: "top" }, el("div", { class: "place" }, el("div", { class: "player panel" }, stage, controls)), side),
      search, costs));
  stage.append(badge);

  let task = null, rows = [], state = null, status = null, curves = null, weights = null, show = null, drawn = false;
  const link = createLink(token, { onMessage, onState: (word) => { status?.link(word); if (word === "gone") finish(); } });

  function onMessage(message) {
    if (message.task) begin(message.task);
    if (message.rows) rows.push(...message.rows);
    if (message.state) state = message.state;
    if (message.scene) show.scene(message.scene);
    status.update({ rows, state, elapsed: message.elapsed, verdict: message.verdict });
    const last = rows[rows.length - 1];
    weights.update({ factors: state.factors, wanted: state.wanted, stage: last ? last[1] : 0 });
    if (message.rows || message.state) soon();
    if (message.verdict) finish();
    document.title = `${status.word()}: ${task.name}${last ? `, trial ${last[0]}` : ""}`;
  }

  // the first message of a connection; after a break everything is told again
  function begin(told) {
    task = told;
    rows = [];
    title.replaceChildren(task.name.replaceAll("-", " "), el("span", {}, ` on ${task.robot}`));
    lead.textContent = task.description;
    facts.textContent = `Seed ${task.seed}, written to ${task.directory}`;
    const looks = looksOf(task.costs.length);
    status = createStatus(side, task, { say });
    const plots = el("div", {}), sliders = el("div", {});
    costs.replaceChildren(plots, sliders);
    curves = createCurves(search, plots, task, looks);
    weights = createWeights(sliders, task, { looks, onMove: (factors) => say({ say: "factors", factors }) });
    show ??= createShow(stage, controls, badge, theme);
  }

  // the plots are drawn at most once a frame, and not where nobody sees them
  function soon() {
    if (drawn) return;
    drawn = true;
    requestAnimationFrame(() => { drawn = false; curves.update(rows, state); show.say(rows, task); });
  }

  async function say(message) {
    status.notice(await link.say(message));
  }

  function finish() {
    weights?.disable();
    soon();
  }
}

// The best motion so far, looping.
function createShow(stage, controls, badge, theme) {
  let player = null, bar = null, scene = null, kind = "";
  stage.append(badge);

  function rebuild() {
    const wanted = JSON.stringify([scene.motion.horizon, player.duration, scene.layers.map(({ label }) => label)]);
    if (wanted === kind) return;
    kind = wanted;
    bar?.remove();
    bar = createControls(controls, player, { horizon: scene.motion.horizon, end: player.duration, speed: bar ? player.speed : undefined });
  }

  return {
    scene(next) {
      scene = { ...scene, ...next };
      if (player) player.update(next);
      else {
        stage.querySelector(".waiting")?.remove();
        player = createPlayer(stage, scene, { theme: theme.current() });
        theme.onChange((name) => player.setTheme(name));
        player.onTime((t) => bar?.setTime(t));
        player.setLoop(true);
        rebuild();
        player.play();
      }
      rebuild();
    },
    say(rows) {
      const last = rows[rows.length - 1];
      if (!last) return;
      badge.value = `best so far, found by trial ${last[11]}`;
    },
  };
}
