// A plot that grows: createFigure(host, {title, unit, series: [{name, colour, dash, width}], ...}) -> {update({...})}. Values are of the
// log scale, so only those above 0 are drawn.

import { createChart, linearScale, logScale, nearest } from "./chart.js";
import { el, significant, svg } from "./dom.js";

const LEAST = 1.6; // the y axis spans at least this factor

export function createFigure(host, { title, unit, series, extra = [], height = 230, floor = null, guides = [], digits = 3, room = 0 }) {
  const values = series.map(() => el("output", {}));
  const legend = [
    ...series.map((line, k) => el("span", { class: "item" }, swatch(line), el("span", {}, line.name), values[k])),
    ...extra.map((item) => el("span", { class: "item" }, item.swatch, el("span", {}, item.name))),
  ];
  const where = el("output", { class: "readout" });
  const body = el("div", { class: "body" });
  const caption = el("figcaption", {}, el("span", { class: "title" }, title, unit ? el("span", { class: "unit" }, ` [${unit}]`) : null), el("span", { class: "legend" }, legend));
  host.append(el("figure", {}, caption, body, where));
  let state = { x: [], lines: series.map(() => []), rules: [], marks: [] };
  let hovered = null;
  const chart = createChart(body, {
    label: `${title}, plotted over the trials`, height, margin: { left: 50, top: 8 + room },
    x: { ...linearScale(0, 1, 4), unit: "trials" }, y: logScale(0.1, 10), lines: [],
    onHover: (at) => { hovered = at; point(); },
  });

  function point() {
    const k = state.x.length ? (hovered === null ? state.x.length - 1 : nearest(state.x, hovered)) : null;
    chart.setCursor(hovered === null || k === null ? null : state.x[k]);
    series.forEach((_, i) => { values[i].value = k === null ? "\u2013" : significant(state.lines[i][k] ?? NaN, digits); });
    where.value = k === null ? "" : hovered === null ? "" : `trial ${state.x[k]}${state.note ? `, ${state.note(k)}` : ""}`;
  }

  // x: trials; lines: values, one array for each of the series; bands: [{low, high, colour}]; rules: [{x, text}]
  function update(next) {
    state = { ...state, ...next };
    const positive = (array) => array.map((v) => (v !== null && v > 0 ? v : NaN));
    const lines = series.map((line, k) => ({ ...line, x: state.x, y: positive(state.lines[k]) }));
    const bands = (state.bands ?? []).map((band) => ({ ...band, x: state.x, low: positive(band.low), high: positive(band.high) }));
    let low = Infinity, high = -Infinity;
    for (const array of [...lines.map((line) => line.y), ...bands.flatMap((band) => [band.low, band.high]), guides.map(({ value }) => value)]) {
      for (const v of array) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
    }
    if (low > high) [low, high] = [0.1, 10];
    if (floor !== null) low = Math.max(low, Math.min(floor, high / 10));
    const middle = Math.sqrt(low * high), half = Math.max(Math.sqrt(high / low), LEAST);
    const last = Math.max(state.x[state.x.length - 1] ?? 0, state.least ?? 1);
    const across = guides.map((guide) => ({ ...guide, x: [0, last], y: [guide.value, guide.value], follow: false }));
    chart.update({
      lines: [...across, ...lines], bands, rules: state.rules, marks: state.marks,
      x: { ...linearScale(0, last, 5), unit: "trials" },
      y: logScale((middle / half) / 1.15, middle * half * 1.3),
    });
    point();
  }

  point();
  return { update };
}

export function swatch({ colour, dash = "" }) {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("path", { class: `line ${dash}`, stroke: colour, d: "M0 4H18" }));
}

export function bandSwatch(colour) {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("rect", { class: "band", fill: colour, width: 18, height: 8 }));
}
