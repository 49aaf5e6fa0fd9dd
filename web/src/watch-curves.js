// How the search goes, over the trials: createCurves(search, terms, task, looks) -> {update(rows, state)}. rows: as levade.viewer.watching
// tells them, one for each generation.

import { el, significant } from "./dom.js";
import { bandSwatch, createFigure, swatch } from "./live-figure.js";

const COLOURS = ["var(--x)", "var(--z)", "var(--y)", "var(--hind-right)", "var(--limit)", "var(--muted)"];
const DASHES = ["", "dashed", "dashdot", "dotted"];
const ALLOWED = { colour: "var(--good)", dash: "dotted", width: 1.6 };
const MANY = 3; // changes of weights that there is room to name
const FAR = 1e10; // a cost above this is of a trial that broke down

// A look for each of n lines: colours in turn, then dashes.
export function looksOf(n) {
  return Array.from({ length: n }, (_, k) => ({ colour: COLOURS[k % COLOURS.length], dash: DASHES[Math.floor(k / COLOURS.length) % DASHES.length] }));
}

export function createCurves(search, terms, task, looks) {
  const grid = el("div", { class: "plots two" });
  search.replaceChildren(el("header", {}, el("h2", {}, "Search"), el("p", { class: "note" }, "A point for each generation. Dotted lines are where a stage begins, or weights were changed.")), grid);
  const cost = createFigure(grid, {
    title: "Cost", room: 14,
    series: [
      { name: "best so far", colour: "var(--best)", width: 2 },
      { name: "generation, median", colour: "var(--reference)", dash: "dashed", width: 1.2 },
    ],
    extra: [{ name: "best to worst", swatch: bandSwatch("var(--reference)") }],
  });
  const errors = task.criteria.length
    ? createFigure(grid, {
      title: "Errors of the best, as a share of what is allowed", room: 14, guides: [{ value: 1, ...ALLOWED }], floor: 0.02,
      series: task.criteria.map(({ name }, k) => ({ name: name.replaceAll("_", " "), width: 1.8, ...looksOf(task.criteria.length)[k] })),
      extra: [{ name: "allowed", swatch: swatch(ALLOWED) }],
    })
    : null;
  const figures = el("div", { class: "plots" });
  terms.replaceChildren(el("header", {}, el("h2", {}, "Cost terms"), el("p", { class: "note" }, "What each term adds to the cost of the best motion.")), figures);
  const parts = createFigure(figures, {
    title: "Weighted terms of the best", room: 14, height: Math.max(250, 58 * task.costs.length),
    series: task.costs.map(({ name }, k) => ({ name: name.replaceAll("_", " "), width: 1.8, ...looks[k] })),
  });

  function update(rows, state) {
    if (!rows.length) return;
    const x = rows.map((row) => row[0]);
    const rules = rulesOf(rows, task, state);
    const note = (k) => `generation ${k + 1}, stage ${task.stages[rows[k][1]].name}, step ${significant(rows[k][6])}`;
    const least = task.population ?? 1;
    cost.update({
      x, rules, note, least,
      lines: [rows.map((row) => row[2]), rows.map((row) => row[4])],
      bands: [{ low: rows.map((row) => row[3]), high: rows.map((row) => (row[5] > FAR ? row[4] : row[5])), colour: "var(--reference)" }],
    });
    errors?.update({
      x, rules, note, least,
      lines: task.criteria.map(({ tolerance }, k) => rows.map((row) => (row[10][k] === null ? null : Math.abs(row[10][k]) / (tolerance || 1)))),
    });
    parts.update({ x, rules, note, least, lines: task.costs.map((_, k) => rows.map((row) => (row[9][k] === null ? null : Math.abs(row[9][k])))) });
  }

  return { update };
}

// Where stages begin, and where weights were changed.
function rulesOf(rows, task, state) {
  const rules = [];
  rows.forEach((row, k) => {
    if (k === 0 || row[1] !== rows[k - 1][1]) rules.push({ x: k === 0 ? 0 : rows[k - 1][0], text: task.stages.length > 1 ? task.stages[row[1]].name : "", above: true });
  });
  const changes = (state?.changes ?? []).filter(({ generation }) => generation <= rows.length);
  for (const { generation, factors } of changes) {
    const text = changes.length > MANY ? "" : Object.entries(factors).map(([name, factor]) => `${name.replaceAll("_", " ")} \u00d7${significant(factor)}`).join(", ");
    rules.push({ x: generation < 2 ? 0 : rows[generation - 2][0], text });
  }
  return rules;
}
