// certificate.html: createCertificate(element, data) builds the page: verdict, what was tried, and the poorest runs to be played.
// data: what levade.hardware.page.certificate_data gives.

import { bounds, createChart, linearScale, nearest, timeScale } from "./chart.js";
import { createControls } from "./controls.js";
import { el, fixed, significant, signed, unpack } from "./dom.js";
import { unpack as unpackAny } from "./player-data.js";
import { createPlayer } from "./player.js";
import { swatch } from "./plots.js";
import { icon } from "./summary.js";
import { createThemeButton } from "./theme.js";

const MARKS = { true: ["good", "passed"], false: ["bad", "failed"] };
const KINDS = { speed: "speed limit", torque_speed: "torque\u2013speed line", torque: "torque limit", range: "joint range" };
const COLOURS = ["var(--x)", "var(--y)", "var(--z)", "var(--muted)"];
const DASHES = ["", "dashed", "dashdot", "dotted"];
const SHOWN = 6; // parameters

export function createCertificate(element, data) {
  const stage = el("div", { class: "stage" });
  const controls = el("div", { class: "controls" });
  const theme = createThemeButton();
  const said = el("p", { class: "note said", "aria-live": "polite" });
  const choice = el("div", { class: "layers", role: "radiogroup", "aria-label": "Run" });
  const player = el("div", { class: "player panel" }, stage, controls, el("div", { class: "which options" }, choice, said));
  const main = el("main", {},
    el("div", { class: "top" }, el("div", { class: "place" }, player), el("div", { class: "panel" }, verdicts(data))),
    goal(data),
    limits(data.limits),
    el("div", { class: "columns" }, missed(data), sensitivity(data)),
    tried(data),
    provenance(data));
  element.replaceChildren(head(data, theme.element), main);
  requestAnimationFrame(() => start(data, { stage, controls, theme, choice, said }));
}

function head({ task, robot, description, passed, interrupted, failed, unknown, share, horizon, hold, feedback, provenance: { motion } }, themeButton) {
  const text = interrupted ? "interrupted before its end" : passed ? (unknown.length ? `what is known; unknown: ${unknown.join(", ")}` : "everything that is demanded") : `fails ${failed.join(", ")}`;
  const facts = [
    ["Horizon", `${significant(horizon)} s${hold > 1e-9 ? `, then ${significant(hold)} s of hold` : ""}`],
    ["Perturbed robots", `${share.successes} of ${share.runs} succeed`],
    ["Feedback", feedback === null ? "none, open loop" : `${significant(feedback)} Hz`],
    motion ? ["Motion", motion] : null,
  ].filter(Boolean);
  return el("header", { class: "head" },
    el("div", { class: "line" }, el("span", { class: "brand" }, "levade certificate"), themeButton),
    el("h1", {}, task.replaceAll("-", " "), el("span", {}, ` on ${robot}`)),
    description ? el("p", { class: "lead" }, description) : null,
    el("div", { class: "line facts" },
      el("p", { class: `verdict ${passed ? "good" : "bad"}` }, icon(passed), el("strong", {}, passed ? "Passes" : "Does not pass"), el("span", {}, text)),
      el("dl", {}, facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))))));
}

function verdicts({ verdicts, criteria, task }) {
  const rows = verdicts.map(({ name, passed, unknown, value, required, reason }) => {
    const [cls, word] = passed === null ? ["", unknown ? "unknown" : "not judged"] : MARKS[passed];
    return el("tr", {},
      el("th", { scope: "row" }, name, el("small", { class: "also" }, [value, reason].filter(Boolean).join("; "))),
      el("td", {}, required),
      el("td", { class: `met ${cls}` }, passed === null ? null : icon(passed), word));
  });
  const heads = [["What was tried, and what came of it"], ["Required", "number"], ["Verdict", "number"]];
  return el("div", { class: "block" }, el("h2", {}, "Verdicts"),
    criteria === task ? null : el("p", { class: "note" }, `By the criteria of ${criteria}.`),
    el("div", { class: "scroll" }, el("table", { class: "goals" },
      el("thead", {}, el("tr", {}, heads.map(([text, cls]) => el("th", { scope: "col", class: cls }, text)))), el("tbody", {}, rows))));
}

// What is left of each kind of limit, and whose it is at the cursor.
function limits({ time, horizon, end, joints, kinds }) {
  if (!kinds.length) return null;
  const x = unpack(time).data;
  const body = el("div", { class: "body" });
  const lines = kinds.map(({ left }, k) => ({ x, y: unpack(left).data, colour: COLOURS[k], dash: DASHES[k] }));
  const who = kinds.map(({ joint }) => unpackAny(joint));
  const outputs = kinds.map(() => el("output", { class: "who" }));
  const legend = el("span", { class: "legend" }, kinds.map(({ name }, k) => el("span", { class: "item" },
    swatch(COLOURS[k], DASHES[k]), el("span", {}, KINDS[name]), outputs[k])));
  const scale = linearScale(...bounds(lines.map(({ y }) => y), 0.2, [0, 1]));
  const chart = createChart(body, { label: "share of each limit that is left", lines, height: 220, x: timeScale(horizon, end), y: scale, limits: [{ from: 0, to: -1 }], onSeek: (t) => set(t) });
  function set(t) {
    chart.setCursor(t);
    kinds.forEach((kind, k) => {
      const row = nearest(x, t);
      outputs[k].value = `${fixed(100 * lines[k].y[row], 0)} % ${joints[who[k][row]]}`;
    });
  }
  const least = kinds.map((kind, k) => ({ kind, k, row: lines[k].y.indexOf(Math.min(...lines[k].y)) })).sort((a, b) => lines[a.k].y[a.row] - lines[b.k].y[b.row])[0];
  set(x[least.row]);
  const note = `Of the joint that has least left at each instant, on the model. Nearest: ${joints[who[least.k][least.row]]} at ${fixed(x[least.row], 3)} s, ${fixed(100 * lines[least.k].y[least.row], 1)} % of its ${KINDS[least.kind.name]} left.`;
  return el("section", { class: "panel", id: "limits" }, el("header", {}, el("h2", {}, "Limits"), el("p", { class: "note" }, note)),
    el("figure", {}, el("figcaption", {}, el("span", { class: "title" }, "left of the limit", el("span", { class: "unit" }, " [share]")), legend), body));
}

// What the motion has to do. Where a task asks for more than robots that differ can do, both are named.
function goal({ goal }) {
  const rows = goal.map(({ criterion, task, model, perturbed }) => el("tr", {}, el("th", { scope: "row" }, criterion.replaceAll("_", " ")),
    ...[task, model, perturbed || "\u2013"].map((text) => el("td", {}, text))));
  return table("What it has to do", "In SI units. Other numerics and engines are judged as perturbed robots are.", ["Criterion", "The task", "On the model", "On perturbed robots"], rows);
}

function missed({ errors, share }) {
  const rows = errors.map(({ name, lowest, mean, highest, missed }) => el("tr", {}, el("th", { scope: "row" }, name.replaceAll("_", " ")),
    ...[lowest, mean, highest].map((value) => el("td", {}, signed(value, 4))), el("td", {}, `${missed} of ${share.runs}`)));
  return table("Error on perturbed robots", `In SI units. By chance alone, the share of all such robots is ${fixed(100 * share.low, 1)} to ${fixed(100 * share.high, 1)} % (95 %).`, ["Criterion", "Lowest", "Mean", "Highest", "Missed"], rows);
}

function sensitivity({ sensitivity }) {
  const rows = sensitivity.slice(0, SHOWN).map(({ parameter, number, explains, alone }) => el("tr", {}, el("th", { scope: "row" }, `${parameter.replaceAll("_", " ")} ${number}`.trim()),
    el("td", {}, `${fixed(100 * explains, 0)} %`), el("td", {}, alone.runs ? `${alone.successes} of ${alone.runs}` : "\u2013")));
  return table("What breaks it", "How much of the differences between the runs goes along with a parameter, and how often the motion succeeds with it alone at the ends of its range.", ["Parameter", "Explains", "Succeeds with it alone"], rows);
}

function tried({ ranges }) {
  const rows = ranges.map(({ name, low, high, unit }) => el("li", {}, el("span", {}, name.replaceAll("_", " ")), el("span", {}, `${significant(low)} to ${significant(high)}${unitText(unit)}`)));
  return el("section", { class: "panel", id: "ranges" }, el("header", {}, el("h2", {}, "What the robots differ in"), el("p", { class: "note" }, "Factors where no unit is given. Is your robot within these ranges? If not, this certificate says nothing about it: levade check --perturb.")), el("ul", { class: "ranges" }, rows));
}

function table(title, note, heads, rows) {
  return el("section", { class: "panel" }, el("header", {}, el("h2", {}, title), el("p", { class: "note" }, note)),
    el("div", { class: "scroll" }, el("table", { class: "goals" }, el("thead", {}, el("tr", {}, heads.map((text, i) => el("th", { scope: "col", class: i ? "number" : "" }, text)))), el("tbody", {}, rows))));
}

function provenance({ provenance: { motion, checksum, seed, timestep, versions, written_by: writer }, share }) {
  const rows = [
    motion ? ["Motion file", motion] : null,
    ["Checksum of model and arrays (SHA-256)", checksum],
    ["Perturbed runs", `${share.runs}, seed ${seed}, steps of ${significant(1000 * timestep)} ms`],
    ["Versions", Object.entries(versions).map(([name, version]) => `${name} ${version}`).join(", ")],
  ].filter(Boolean);
  return el("footer", { class: "panel", id: "provenance" }, el("header", {}, el("h2", {}, "Provenance")),
    el("dl", {}, rows.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))),
    el("p", { class: "made" }, `Made by ${writer}. A certificate is about a simulation: who switches the robot on is responsible for it.`));
}

function start({ runs, scene, limits: { horizon, end } }, { stage, controls, theme, choice, said }) {
  const player = createPlayer(stage, scene, { theme: theme.current() });
  theme.onChange((name) => player.setTheme(name));
  const bar = createControls(controls, player, { horizon, end });
  player.onTime((t) => bar.setTime(t));
  const all = [{ name: "on the model", motion: scene.motion, layers: scene.layers }, ...runs];
  all.forEach((run, k) => {
    const input = el("input", { type: "radio", name: "run", onchange: () => show(k) });
    input.checked = k === 0;
    choice.append(el("label", {}, input, el("span", {}, run.name)));
  });
  function show(k) {
    player.update({ motion: all[k].motion, layers: all[k].layers });
    said.textContent = words(all[k], k);
  }
  said.textContent = words(all[0], 0);
  player.seek(0);
  document.documentElement.dataset.ready = "";
}

function words({ missed, differs, diverged }, k) {
  if (k === 0) return "The motion on the model as it is. Beside it the runs that came out poorest of all perturbed ones, drawn on the model's ground: theirs may lie and slope otherwise.";
  const off = missed.map(({ name, error }) => `${name.replaceAll("_", " ")} ${signed(error, 3)}`).join(", ");
  const robot = differs.map(({ name, value, unit }) => `${name.replaceAll("_", " ")} ${significant(value)}${unitText(unit)}`).join(", ");
  return `${diverged ? "The simulation broke down. " : off ? `It misses ${off}. ` : "It succeeds. "}What differs most on its robot: ${robot}.`;
}

function unitText(unit) {
  return unit && unit !== "x" && unit !== "-" ? ` ${unit}` : "";
}
