// Goal against result, peaks against limits, and the terms of the cost: createSummary(element, summary) -> {update(summary)}.
// summary: what levade.report.summary.summary_data gives.

import { degrees, el, fixed, signed, significant, svg } from "./dom.js";

export function createSummary(element, summary) {
  const show = () => element.replaceChildren(...[goals(summary), peaks(summary), terms(summary)].filter(Boolean));
  show();
  return { update(next) { summary = { ...summary, ...next }; show(); } };
}

export function verdict({ success, verdict }) {
  return el("p", { class: `verdict ${success ? "good" : "bad"}` }, icon(success), el("strong", {}, success ? "Success" : "Not reached"), el("span", {}, verdict));
}

export function icon(good) {
  return svg("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, svg("path", { d: good ? "M3 8.5l3.2 3.3L13 4.6" : "M4 4l8 8M12 4l-8 8" }));
}

// A row per criterion, under headings that say when it is judged.
function goals({ criteria }) {
  if (!criteria?.length) return null;
  const groups = new Map();
  for (const criterion of criteria) groups.set(criterion.when, [...(groups.get(criterion.when) ?? []), criterion]);
  const heads = [["Criterion"], ["Goal", "number"], ["Result", "number"], ["Error", "number"], ["Allowed", "number"], [el("span", { class: "unseen" }, "Error in its tolerance")], [el("span", { class: "unseen" }, "Verdict")]];
  const table = el("table", { class: "goals" }, el("thead", {}, el("tr", {}, heads.map(([text, cls]) => el("th", { scope: "col", class: cls }, text)))));
  for (const [when, group] of groups) {
    table.append(el("tbody", {}, el("tr", { class: "when" }, el("th", { scope: "rowgroup", colspan: heads.length }, when)), group.map(row)));
  }
  return block("Goal and result", el("div", { class: "scroll" }, table));
}

function row({ name, quantity, unit, target, minimum, maximum, tolerance, result, error, met }) {
  const plain = name.replaceAll("_", " ");
  const angle = unit === "rad" && target ? (value) => el("small", { class: "also" }, degrees(value)) : () => null;
  const goal = target !== null ? fixed(target, 4) : minimum === null ? `\u2264 ${fixed(maximum, 4)}` : maximum === null ? `\u2265 ${fixed(minimum, 4)}` : `${fixed(minimum, 4)} to ${fixed(maximum, 4)}`;
  return el("tr", {},
    el("th", { scope: "row" }, plain, plain.includes(quantity.replaceAll("_", " ")) ? null : el("small", {}, ` ${quantity.replaceAll("_", " ")}`), el("small", {}, ` [${unit}]`)),
    el("td", { "data-head": "goal" }, goal, angle(target)),
    el("td", { "data-head": "result" }, result === null ? "within" : fixed(result, 4), result === null ? null : angle(result)),
    el("td", { "data-head": "error" }, signed(error, 4)),
    el("td", { "data-head": "allowed" }, target === null ? "" : `\u00b1${significant(tolerance)}`),
    el("td", { class: "gauge" }, target === null ? null : gauge(error, tolerance, met)),
    el("td", { class: `met ${met ? "good" : "bad"}` }, icon(met), met ? "met" : "missed"));
}

// Where the error lies in its tolerance: twice the tolerance to each side.
function gauge(error, tolerance, met) {
  const share = Math.max(-1, Math.min(1, tolerance > 0 ? error / (2 * tolerance) : Math.sign(error)));
  const x = 40 + 36 * share;
  return svg("svg", { viewBox: "0 0 80 16", role: "img", "aria-label": `${Math.round(Math.abs(error / tolerance) * 100)} % of the tolerance` },
    svg("rect", { class: "track", x: 2, y: 6.5, width: 76, height: 3, rx: 1.5 }),
    svg("rect", { class: "allowed", x: 22, y: 4, width: 36, height: 8, rx: 2 }),
    svg("line", { class: "centre", x1: 40, x2: 40, y1: 2, y2: 14 }),
    Math.abs(share) === 1 && !met
      ? svg("path", { class: "bad", d: share > 0 ? "M72 3l6 5-6 5z" : "M8 3l-6 5 6 5z" })
      : svg("circle", { class: met ? "good" : "bad", cx: x, cy: 8, r: 4 }));
}

function peaks({ peaks }) {
  if (!peaks?.length) return null;
  const rows = peaks.map(({ what, joint, unit, value, limit, share }) => {
    const bound = limit === null ? "no limit" : Array.isArray(limit) ? `${fixed(limit[0], 2)} to ${fixed(limit[1], 2)}` : fixed(limit, 1);
    const over = share !== null && share > 1 + 1e-9;
    return el("li", { class: over ? "over" : "" },
      el("span", { class: "what" }, what, el("small", {}, joint)),
      el("span", { class: "value" }, fixed(value, unit === "rad" ? 2 : 1), el("small", {}, limit === null ? ` ${unit}, no limit` : ` of ${bound} ${unit}`)),
      share === null ? null : el("span", { class: "share" }, `${Math.round(share * 100)} %`),
      share === null ? null : bar(share, over));
  });
  return block("Nearest to the limits", el("ul", { class: "bars peaks" }, rows));
}

// The bar's full length is twice the limit where the limit is passed, and the limit where it is not.
function bar(share, over) {
  const full = over ? Math.max(1.25, share) : 1;
  return el("span", { class: "bar" }, el("i", { style: `width:${(Math.min(share, 1) / full) * 100}%` }), over ? el("b", { style: `left:${100 / full}%;width:${((share - 1) / full) * 100}%` }) : null);
}

function terms({ terms, cost }) {
  if (!terms?.length) return null;
  const largest = Math.max(...terms.map((term) => Math.abs(term.weighted)), 1e-300);
  const rows = [...terms].sort((a, b) => Math.abs(b.weighted) - Math.abs(a.weighted)).map(({ name, value, weight, weighted }) =>
    el("li", {},
      el("span", { class: "what" }, name.replaceAll("_", " ")),
      el("span", { class: "value" }, el("small", {}, `${significant(weight)} \u00d7 ${significant(value)} =`)),
      el("span", { class: "share" }, significant(weighted)),
      el("span", { class: "bar" }, el("i", { style: `width:${(Math.abs(weighted) / largest) * 100}%` }))));
  return block(["Cost ", el("span", { class: "total" }, significant(cost, 4))], el("ul", { class: "bars terms" }, rows));
}

function block(title, content) {
  return el("div", { class: "block" }, el("h2", {}, title), content);
}
