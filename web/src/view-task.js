// A task before it is solved: what is wanted, what it costs, how it is looked for.

import { degrees, el, fixed, significant } from "./dom.js";
import { command } from "./live-bits.js";

export function createTask({ side, below, data }) {
  const { criteria, costs, stages, facts, command: line, yaml } = data;
  side.append(
    goals(criteria),
    el("div", { class: "block" }, el("h2", {}, "The task"), el("dl", { class: "known" }, facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))))),
    el("div", {}, el("p", { class: "what" }, "To solve it, and watch"), command(line)));
  below.append(
    el("section", { class: "panel" },
      el("header", {}, el("h2", {}, "Cost"), el("p", { class: "note" }, stages.length > 1 ? "The weight of each term, in each stage of the search; what a stage weighs otherwise than the task is in bold." : "The weight of each term.")),
      el("div", { class: "wide-table" }, weights(costs, stages))),
    el("section", { class: "panel" }, el("details", {}, el("summary", {}, "The task, with every default filled in"), el("pre", {}, yaml))));
}

function goals(criteria) {
  if (!criteria.length) return el("p", { class: "note" }, "The task has no criteria of success.");
  const rows = criteria.map(({ name, quantity, unit, when, target, tolerance, minimum, maximum }) => {
    const value = target !== null
      ? [`${fixed(target, 4)} \u00b1 ${significant(tolerance)}`, el("small", {}, ` ${unit}`)]
      : [[minimum === null ? "" : `\u2265 ${significant(minimum)}`, maximum === null ? "" : `\u2264 ${significant(maximum)}`].filter(Boolean).join(", "), el("small", {}, ` ${unit}`)];
    return el("tr", {},
      el("th", { scope: "row" }, name.replaceAll("_", " "), el("small", {}, name === quantity ? when : `${quantity}, ${when.toLowerCase()}`)),
      el("td", {}, el("span", {}, value), target !== null && unit === "rad" ? el("small", { class: "also" }, degrees(target)) : null));
  });
  return el("div", { class: "block" }, el("h2", {}, "What is wanted"), el("table", { class: "goals wanted" }, el("tbody", {}, rows)));
}

function weights(costs, stages) {
  const several = stages.length > 1;
  const names = several ? stages.map(({ name }) => name) : ["weight"];
  const rows = costs.map(({ name, weight, stages: own }) => el("tr", {},
    el("th", { scope: "row" }, name.replaceAll("_", " ")),
    own.map((value) => el("td", { class: several && value !== weight ? "other" : "" }, significant(value)))));
  const ends = several && stages.some(({ promote }) => Object.keys(promote).length)
    ? el("tr", { class: "ends" }, el("th", { scope: "row" }, "ends when a trial is within"), stages.map(({ promote, trials }, k) => el("td", {},
      Object.entries(promote).map(([name, value]) => el("small", {}, `${name.replaceAll("_", " ")} ${significant(value)}`)),
      trials ? el("small", {}, `or after ${trials} trials`) : null,
      k === stages.length - 1 ? el("small", {}, "the last") : null)))
    : null;
  return el("table", { class: "plain" }, el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Term"), names.map((name) => el("th", { scope: "col" }, name)))), el("tbody", {}, rows, ends));
}
