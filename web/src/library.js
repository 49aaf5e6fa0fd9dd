// library.html: createLibrary(element, data) builds the page: how the robot lies, which motions get it up, a few of them to be played.
// data: what levade.library.page.library_data gives.

import { createChart, linearScale, logScale, markShape } from "./chart.js";
import { createControls } from "./controls.js";
import { createDiscs } from "./discs.js";
import { degrees, el, fixed, significant, svg } from "./dom.js";
import { unpack } from "./player-data.js";
import { createPlayer } from "./player.js";
import { swatch } from "./plots.js";
import { icon } from "./summary.js";
import { createThemeButton } from "./theme.js";

const LOOKS = {
  known: { colour: "var(--front-right)", shape: "dot", words: "a known motion" },
  near: { colour: "var(--front-left)", shape: "triangle", words: "a search around a known motion" },
  cold: { colour: "var(--hind-right)", shape: "square", words: "a search from nothing" },
  none: { colour: "var(--bad)", shape: "cross", words: "not solved" },
};
const MANY = 24; // failures that are listed one by one

export function createLibrary(element, data) {
  LOOKS.none.words = data.certificates ? "no motion whose certificate passes" : "not solved";
  const falls = fallsOf(data);
  const theme = createThemeButton();
  const parts = { stage: el("div", { class: "stage" }), controls: el("div", { class: "controls" }), theme };
  const map = createMap(falls, data);
  const list = createList(data);
  let play = () => {};
  const player = data.scene && el("div", { class: "player panel" }, parts.stage, parts.controls, el("div", { class: "which options" }, (parts.choice = el("div", { class: "layers", role: "radiogroup", "aria-label": "Motion" })), (parts.said = el("p", { class: "note said", "aria-live": "polite" }))));
  const side = el("div", { class: "panel side" }, cover(data), lying(data));
  element.replaceChildren(head(data, theme.element), el("main", {},
    el("div", { class: "top" }, map.element, list.element),
    player ? el("div", { class: "top" }, el("div", { class: "place" }, player), side) : side,
    trials(falls, data),
    failures(falls, data, (k) => { map.choose(k); play({ fall: falls[k].number }); map.element.scrollIntoView({ block: "nearest" }); }),
    provenance(data)));

  // One motion may be chosen: its falls stand out on the map. Those that the page holds can be played.
  list.onChoose((motion) => {
    const row = data.listed.find((one) => one.motion === motion);
    map.show(row ? unpack(row.falls) : null, row ? `${named(row)}: gets up from the ${row.works} falls that stand out.` : "");
    if (row) play({ motion });
  });
  requestAnimationFrame(() => {
    if (data.scene) play = start(data, parts);
    document.documentElement.dataset.ready = "";
  });
}

function fallsOf({ falls, methods, lying, certificates }) {
  const column = (name) => falls[name] && unpack(falls[name]);
  const [number, method, spent, face, tilt, above, place, works, perturbed] = ["number", "method", "trials", "face", "tilt", "above", "place", "works", "perturbed"].map(column);
  return Array.from(number, (_, k) => {
    const fall = { number: number[k], look: methods[method[k]], motion: falls.motion[k], trials: spent[k], face: lying[face[k]], tilt: tilt[k], above: above[k] === 1, x: place[2 * k], y: place[2 * k + 1], works: works[k], perturbed: perturbed && perturbed[k] };
    return { ...fall, title: `Fall ${fall.number}: on its ${fall.face}, tilted ${degrees(fall.tilt, 0)}. ${fall.look === "none" ? (certificates ? "No motion passes its certificate" : "Not solved") : `Solved by ${LOOKS[fall.look].words}`}${fall.motion === null || fall.motion === fall.number ? "" : `, ${motionName(fall.motion)}`}, ${fall.trials} trials.` };
  });
}

function motionName(number) {
  return number < 0 ? `the image of motion ${-1 - number}` : `motion ${number}`;
}

function named(row) {
  return row.mirrored ? `Motion ${row.fall}, mirrored` : `Motion ${row.fall}`;
}

function percent(n, all) {
  if (!all) return "\u2013";
  const share = (100 * n) / all;
  return `${n === all ? "100" : fixed(Math.min(share, 99.9), 1)} %`;
}

function head({ task, robot, description, falls, starts, complete, motions, mirrored, coverage, perturbed, certificates, provenance: { seed, trials } }, themeButton) {
  const done = falls.motion.length;
  const good = complete && coverage === done && done === starts;
  const text = `from ${coverage} of ${done} falls${done < starts ? `; ${starts - done} are still to do` : ""}`;
  const facts = [
    ["Motions", `${motions}${mirrored ? ", and their mirror images" : ""}`],
    perturbed === null ? null : ["On robots that differ", `${percent(perturbed, done)} of the falls`],
    certificates ? ["Certificates", `${certificates.passed} of ${certificates.motions} pass`] : null,
    ["Trials", trials.toLocaleString("en")],
    ["Seed", String(seed)],
  ].filter(Boolean);
  return el("header", { class: "head" },
    el("div", { class: "line" }, el("span", { class: "brand" }, "levade motion library"), themeButton),
    el("h1", {}, task.replaceAll("-", " "), el("span", {}, ` on ${robot}`)),
    description ? el("p", { class: "lead" }, description) : null,
    el("div", { class: "line facts" },
      el("p", { class: `verdict ${good ? "good" : coverage < done ? "bad" : ""}` }, good ? icon(true) : coverage < done ? icon(false) : null, el("strong", {}, done ? percent(coverage, done) : "Empty"), el("span", {}, `gets up ${certificates ? "within the limits " : ""}${text}`)),
      el("dl", {}, facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))))));
}

function key(look) {
  const { colour, shape } = LOOKS[look];
  return svg("svg", { class: "swatch dot", viewBox: "-7 -7 14 14", "aria-hidden": "true" }, markShape({ colour, shape, r: 4.5 }, 0, 0));
}

function legend(falls) {
  const looks = Object.keys(LOOKS).map((look) => [look, falls.filter((fall) => fall.look === look).length]).filter(([, n]) => n);
  return el("p", { class: "legend" }, looks.map(([look, n]) => el("span", { class: "item" }, key(look), el("span", {}, `${LOOKS[look].words}: ${n}`))));
}

function createMap(falls, { pitch, folds }) {
  const discs = el("div", { class: "discs" });
  const about = el("p", { class: "note about", "aria-live": "polite" });
  const hint = "Click a fall, or a motion of the list.";
  about.textContent = hint;
  const drawn = createDiscs(discs, falls, { looks: LOOKS, pitch, onChoose: choose });
  let chosen = null;
  function choose(k) {
    chosen = k === chosen ? null : k;
    drawn.choose(chosen);
    about.textContent = chosen === null ? hint : words(falls[chosen]);
  }
  const note = `Each dot is a fall. Its place is the direction of up in the robot's own axes${folds ? ", once the robot has folded its legs" : ""}: in the middle the trunk is level, at the rim it is on edge. Equal areas are equal shares of all directions. Dots that would overlap lie side by side.`;
  const element = el("section", { class: "panel", id: "map" },
    el("header", {}, el("h2", {}, "How it lies, and what solved it"), el("p", { class: "note" }, note)), legend(falls), discs, about);
  return {
    element,
    choose,
    show(indices, text) {
      drawn.show(indices);
      about.textContent = text || (chosen === null ? hint : words(falls[chosen]));
    },
  };
}

function words({ title, works, perturbed }) {
  if (!works) return `${title} No motion works from here.`;
  const many = works === 1 ? "1 motion works" : `${works} motions work`;
  return `${title} ${many} from here${perturbed === null ? "" : `, ${perturbed} on robots that differ from the model`}.`;
}

// Motions, each a button; one at a time is chosen.
function createList({ listed, falls, motions, mirrored, cover: few, certificates }) {
  const all = falls.motion.length;
  let choose = () => {}, chosen = null;
  const buttons = new Map();
  const rows = listed.map((row) => {
    const button = el("button", { type: "button", class: "pick", "aria-pressed": "false", onclick: () => set(row.motion === chosen ? null : row.motion) }, named(row));
    buttons.set(row.motion, button);
    return el("tr", {},
      el("th", { scope: "row" }, button, el("small", { class: "also" }, `fall ${row.fall}, ${row.trials.toLocaleString("en")} trials`)),
      el("td", {}, percent(row.works, all)),
      el("td", {}, row.perturbed === null ? "\u2013" : percent(row.perturbed, all)),
      el("td", {}, row.covered === null ? "" : percent(row.covered, all)),
      row.certificate ? el("td", {}, verdict(row.certificate)) : null);
  });
  function set(motion) {
    chosen = motion;
    for (const [number, button] of buttons) button.setAttribute("aria-pressed", String(number === motion));
    choose(motion);
  }
  const count = motions * (mirrored ? 2 : 1);
  const more = count > listed.length ? ` The ${count - listed.length} that work from fewer falls are not listed.` : "";
  const demands = certificates && certificates.failed.length ? ` Demands that certificates fail: ${certificates.failed.map(({ name, motions: n }) => `${name} (${n})`).join(", ")}.` : "";
  const note = `${few.length === 1 ? "The first one covers" : `The first ${few.length} together cover`} every fall that any motion gets up from; the others can be spared.${more}${demands}`;
  const heads = [["Motion", ""], ["Works", "number"], ["Robots that differ", "number"], ["Together", "number"], ...(certificates ? [["Certificate", ""]] : [])];
  const element = el("section", { class: "panel", id: "motions" },
    el("header", {}, el("h2", {}, "Motions"), el("p", { class: "note" }, listed.length ? note : "There is none yet.")),
    listed.length ? el("div", { class: "scroll" }, el("table", { class: "goals" }, el("thead", {}, el("tr", {}, heads.map(([text, cls]) => el("th", { scope: "col", class: cls }, text)))), el("tbody", {}, rows))) : null);
  return { element, onChoose(fn) { choose = fn; } };
}

// What a motion's certificate says, and the limit that it comes nearest to.
function verdict({ failed, share, binding }) {
  const said = failed.length ? `fails ${failed.join(", ")}` : "passes";
  return [said, el("small", { class: "also" }, `${fixed(100 * share, 1)} % of perturbed robots${binding ? `; ${binding}` : ""}`)];
}

// How many falls are left at each number of motions.
function cover({ cover: few, falls }) {
  const all = falls.motion.length;
  const body = el("div", { class: "body" });
  const block = el("div", { class: "block" }, el("h2", {}, "Fewest motions"),
    el("p", { class: "note" }, few.length ? `Each motion adds as many falls as it can. ${few.length === 1 ? "One is" : `${few.length} are`} enough for ${percent(few[few.length - 1].falls, all)}.` : "No motion yet."), body);
  if (!few.length) return block;
  const x = few.map((_, k) => k + 1), y = few.map((one) => (100 * one.falls) / all);
  const across = linearScale(0.5, few.length + 0.5, Math.min(8, few.length));
  const low = Math.max(0, Math.min(...y) - 0.15 * Math.max(10, 100 - Math.min(...y)));
  createChart(body, { label: "share of the falls that so many motions get up from", height: 170, margin: { left: 46, right: 14 }, follow: false,
    lines: [{ x, y, colour: "var(--accent)" }], marks: x.map((v, k) => ({ x: v, y: y[k], colour: "var(--accent)" })),
    x: { ...across, ticks: across.ticks.filter(Number.isInteger) }, y: linearScale(low, 100 + 0.05 * (100 - low), 5) });
  body.prepend(el("p", { class: "legend" }, el("span", { class: "item" }, swatch("var(--accent)"), "falls that one of so many motions gets up from [%]")));
  return block;
}

function lying({ faces }) {
  const rows = [...faces].sort((a, b) => b.falls - a.falls).map(({ name, falls, works, perturbed }) => el("tr", {}, el("th", { scope: "row" }, `its ${name}`), el("td", {}, String(falls)), el("td", {}, percent(works, falls)), el("td", {}, perturbed === null ? "\u2013" : percent(perturbed, falls))));
  const heads = [["It lies on", ""], ["Falls", "number"], ["Solved", "number"], ["Robots that differ", "number"]];
  return el("div", { class: "block" }, el("h2", {}, "By what it lies on"),
    el("div", { class: "scroll" }, el("table", { class: "goals" }, el("thead", {}, el("tr", {}, heads.map(([text, cls]) => el("th", { scope: "col", class: cls }, text)))), el("tbody", {}, rows))));
}

function trials(falls, { rounds, starts }) {
  if (!falls.length) return null;
  const body = el("div", { class: "body" });
  const most = Math.max(...falls.map((fall) => fall.trials), 10);
  const x = [], y = [];
  for (const { first, last, trials: mean } of rounds) {
    x.push(Math.max(first + 0.5, 0.8), last + 1.5);
    y.push(Math.max(mean, 1), Math.max(mean, 1));
  }
  const all = falls.length, across = logScale(0.8, 1.1 * Math.max(starts, all, 9));
  const order = Object.keys(LOOKS);
  const marks = falls.map((fall, k) => ({ x: k + 1, y: Math.max(fall.trials, 1), r: fall.look === "known" ? 2 : 3.5, colour: LOOKS[fall.look].colour, shape: LOOKS[fall.look].shape, look: fall.look }));
  marks.sort((a, b) => order.indexOf(a.look) - order.indexOf(b.look)); // the rare ones on top
  createChart(body, { label: "trials of each fall", height: 240, margin: { left: 52 }, follow: false, marks, lines: [{ x, y, colour: "var(--ink)" }],
    x: { ...across, ticks: [...across.ticks.filter((v) => v < 0.7 * all), all], unit: "falls" }, y: logScale(Math.max(0.8, 0.5 * Math.min(...marks.map((mark) => mark.y))), 1.6 * most) });
  const legendOf = el("p", { class: "legend" }, el("span", { class: "item" }, swatch("var(--ink)"), "mean of a round"), Object.keys(LOOKS).filter((look) => falls.some((fall) => fall.look === look)).map((look) => el("span", { class: "item" }, key(look), LOOKS[look].words)));
  const rest = falls.filter((_, k) => k >= falls.length / 2).map((fall) => fall.trials);
  const note = `Roll-outs that each fall took, in the order of the build, rare ones last; both scales are logarithmic. The falls of a round see the motions of the rounds before it. Mean of the last half: ${significant(rest.reduce((a, b) => a + b, 0) / rest.length)} trials a fall.`;
  return el("section", { class: "panel", id: "trials" }, el("header", {}, el("h2", {}, "Trials per fall"), el("p", { class: "note" }, note)), el("figure", {}, el("figcaption", {}, el("span", { class: "title" }, "Trials", el("span", { class: "unit" }, " over falls")), legendOf), body));
}

function failures(falls, { complete }, choose) {
  const groups = [
    ["No motion works", falls.map((fall, k) => [fall, k]).filter(([fall]) => !fall.works)],
    complete ? ["A motion works on the model, but none on the robot that differs", falls.map((fall, k) => [fall, k]).filter(([fall]) => fall.works && !fall.perturbed)] : null,
  ].filter(Boolean);
  const blocks = groups.map(([title, list]) => el("div", { class: "block" }, el("h2", {}, title, el("span", { class: "total" }, String(list.length))), list.length
    ? el("ul", { class: "failed" }, list.slice(0, MANY).map(([fall, k]) => el("li", {}, el("button", { type: "button", class: "pick", onclick: () => choose(k) }, `Fall ${fall.number}`), el("small", {}, `on its ${fall.face}, ${degrees(fall.tilt, 0)}; ${fall.trials.toLocaleString("en")} trials`))),
      list.length > MANY ? el("li", {}, el("small", {}, `and ${list.length - MANY} more`)) : null)
    : el("p", { class: "note" }, "None.")));
  const note = complete ? "Every motion was tried from every fall, on the model and on one robot that differs from it in masses, friction, gains and delays." : "Not every motion was tried from every fall yet: build the library again to do so.";
  return el("section", { class: "panel", id: "failures" }, el("header", {}, el("h2", {}, "Failures"), el("p", { class: "note" }, note)), el("div", { class: "columns" }, blocks));
}

function provenance({ task, robot, starts, rare, provenance: { seed, fallen, written_by: writer } }) {
  const rows = [["Task", task], ["Robot", robot], ["Falls asked for", `${starts - rare}${rare ? `; and ${rare} rare ones, which the build added` : ""}`], ["Seed", String(seed)], fallen ? ["Dropped from", `${fixed(fallen.height, 3)} m, any attitude, any joint angles`] : null].filter(Boolean);
  return el("footer", { class: "panel", id: "provenance" }, el("header", {}, el("h2", {}, "Provenance")),
    el("dl", {}, rows.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))),
    el("p", { class: "made" }, `Made by ${writer}. Falls that the library has never seen: levade library check.`));
}

// Plays the motions of the page, and failures; returns what shows one, {motion} or {fall}, if the page holds it.
function start({ scene, played, failed, listed, folds }, { stage, controls, theme, choice, said }) {
  const player = createPlayer(stage, scene, { theme: theme.current() });
  theme.onChange((name) => player.setTheme(name));
  const before = `Before it begins, the robot has fallen${folds ? " and folded its legs" : ""}.`;
  const all = [...played, ...failed];
  let bar = null;
  const inputs = all.map(({ fall, motions: [number] }, k) => {
    const input = el("input", { type: "radio", name: "motion", onchange: () => show(k) });
    choice.append(el("label", {}, input, el("span", {}, fall === undefined ? `motion ${number}` : `fall ${fall}: fails`)));
    return input;
  });
  function show(k) {
    inputs[k].checked = true;
    const { motion, layers, horizon, end, motions: [number], fall, missed } = all[k];
    player.update({ motion, layers });
    bar?.remove();
    bar = createControls(controls, player, { horizon, end });
    player.seek(0);
    const row = listed.find((one) => one.motion === number);
    said.textContent = fall === undefined
      ? `Motion ${number}, from the fall that it was found for${row ? `: it gets up from ${row.works} falls` : ""}. ${before}`
      : `No motion gets up from fall ${fall}. This is the likeliest one, ${motionName(number)}${missed.length ? `: it misses ${missed.map(({ name, error }) => `${name.replaceAll("_", " ")} by ${significant(Math.abs(error), 2)}`).join(", ")}` : ""}. ${before}`;
  }
  player.onTime((t) => bar?.setTime(t));
  show(0);
  return ({ motion, fall }) => {
    const k = all.findIndex((one) => (fall === undefined ? one.fall === undefined && one.motions.includes(motion) : one.fall === fall));
    if (k >= 0) show(k);
  };
}
