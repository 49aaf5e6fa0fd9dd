// All plots of a motion: createPlots(element, series) -> {setTime(t), onSeek(fn), update(series)}. onSeek: of clicks in plots.
// series: what levade.report.series.series_data gives; parts that are missing are left out.

import { bounds, createChart, linearScale, logScale, nearest, timeScale } from "./chart.js";
import { el, fixed, significant, svg, unpack } from "./dom.js";

const AXES = ["var(--x)", "var(--y)", "var(--z)"];
const AXIS_DASHES = ["", "dashed", "dashdot"];
const LEG_DASHES = ["", "dashed", "dashdot", "dotted"];

// What is drawn of which part of the series, in the order of the page.
const PARTS = { trunk: [trunk], cost: [cost], joints: [angles, torques, speeds], feet: [feet], policy: [policy] };

export function createPlots(element, series) {
  const holders = {}, charts = {};
  let seek = () => {}, time = null;

  for (const part of Object.keys(PARTS)) {
    holders[part] = el("div", { class: "part" });
    charts[part] = [];
  }
  element.replaceChildren(...Object.values(holders));

  function build(part) {
    const height = element.offsetHeight;
    element.style.minHeight = `${height}px`; // what the reader looks at stays where it is
    for (const chart of charts[part]) chart.destroy();
    charts[part] = [];
    holders[part].replaceChildren();
    if (series[part]) {
      const context = { series, onSeek: (t) => seek(t), x: null, times: null, add: (chart) => (charts[part].push(chart), chart) };
      if (series.time) Object.assign(context, { x: timeScale(series.horizon, series.end), times: unpack(series.time).data });
      for (const draw of PARTS[part]) draw(context, holders[part]);
      if (time !== null) for (const chart of charts[part]) chart.setTime?.(time);
    }
    element.style.minHeight = "";
  }

  Object.keys(PARTS).forEach(build);
  return {
    setTime(t) {
      time = t;
      for (const chart of Object.values(charts).flat()) chart.setTime?.(t);
    },
    onSeek(fn) { seek = fn; },
    // a new motion draws all anew; a new part, such as {cost}, only that
    update(next) {
      series = { ...series, ...next };
      const all = ["time", "horizon", "end", "legs"].some((key) => key in next);
      Object.keys(PARTS).filter((part) => all || part in next).forEach(build);
    },
  };
}

function section(host, id, title, note, columns) {
  const grid = el("div", { class: `plots ${columns}` });
  host.append(el("section", { class: "panel", id }, el("header", {}, el("h2", {}, title), note ? el("p", { class: "note" }, note) : null), grid));
  return grid;
}

// One plot with its caption: title, unit, and a legend whose values follow the cursor.
function plot(grid, context, { title, unit, lines = [], digits = 3, legend = [], timed = true, small = false, ...spec }) {
  const body = el("div", { class: "body" });
  const values = lines.map(() => el("output", {}));
  const items = [
    ...lines.map((line, k) => el("span", { class: "item" }, swatch(line.colour, line.dash), line.name ? el("span", {}, line.name) : null, timed ? values[k] : null)),
    ...legend.map((item) => el("span", { class: "item" }, item.swatch ?? swatch(item.colour, item.dash), el("span", {}, item.name))),
  ];
  const caption = el("figcaption", {}, el("span", { class: "title" }, title, unit ? el("span", { class: "unit" }, ` [${unit}]`) : null), small ? (timed ? el("span", { class: "legend" }, values) : null) : el("span", { class: "legend" }, items));
  grid.append(el("figure", { class: small ? "small" : "" }, caption, body));
  const chart = createChart(body, { label: `${title}${unit ? ` in ${unit}` : ""}, plotted`, lines, height: 190, ...(timed ? { x: context.x, onSeek: context.onSeek } : {}), ...spec });
  if (timed) {
    chart.setTime = (t) => {
      chart.setCursor(t);
      lines.forEach((line, k) => { values[k].value = fixed(line.y[nearest(line.x, t)], digits); });
    };
    chart.setTime(0);
  }
  return context.add(chart);
}

export function swatch(colour, dash = "") {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("path", { class: `line ${dash}`, stroke: colour, d: "M0 4H18" }));
}

function shadeSwatch() {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("rect", { class: "beyond", width: 18, height: 8 }), svg("path", { class: "limit", d: "M0 0.5H18" }));
}

function goalSwatch() {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("path", { class: "goal", stroke: "var(--ink)", d: "M0 4H18" }), svg("circle", { class: "target", stroke: "var(--ink)", cx: 9, cy: 4, r: 3 }));
}

function bandSwatch() {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("rect", { class: "band", fill: "var(--reference)", width: 18, height: 8 }));
}

function holdNote({ x }) {
  if (!x?.horizon) return "";
  return `Shaded: the hold after T = ${significant(x.horizon)} s${x.short ? ", drawn to a shorter scale" : ""}.`;
}

function trunk(context, host) {
  const { series, times } = context;
  const grid = section(host, "trunk", "Trunk", `Position of its centre of mass, and orientation as roll, pitch, yaw. ${holdNote(context)}`, "two");
  const of = [["position", "Position", "m", ["x", "y", "z"], 0.02], ["orientation", "Orientation", "rad", ["roll", "pitch", "yaw"], 0.02]];
  for (const [what, title, unit, names, least] of of) {
    const values = unpack(series.trunk[what]);
    const lines = names.map((name, k) => ({ name, x: times, y: values.column(k), colour: AXES[k], dash: AXIS_DASHES[k] }));
    const goals = (series.trunk.goals ?? []).filter((goal) => goal.what === what).map((goal) => ({ ...goal, colour: AXES[goal.column] }));
    const wanted = goals.flatMap((goal) => [goal.target - goal.tolerance, goal.target + goal.tolerance]);
    plot(grid, context, {
      title, unit, lines, goals, height: 240, digits: 4,
      y: linearScale(...bounds(lines.map((line) => line.y), least, wanted)),
      legend: goals.length ? [{ name: "goal", swatch: goalSwatch() }] : [],
    });
  }
}

function cost(context, host) {
  const { trials, best, low, median, high, stages, first_success: first } = context.series.cost;
  const positive = (values) => values.map((v) => (v !== null && v > 0 ? v : NaN));
  const lines = [
    { name: "best so far", x: trials, y: positive(best), colour: "var(--best)", width: 2 },
    { name: "generation, median", x: trials, y: positive(median), colour: "var(--reference)", dash: "dashed", width: 1.2 },
  ];
  const band = { x: trials, low: positive(low), high: positive(high), colour: "var(--reference)" };
  const finite = [...lines.flatMap((line) => line.y), ...band.low, ...band.high].filter(Number.isFinite);
  if (!finite.length) finite.push(1);
  const across = linearScale(0, trials[trials.length - 1], 6);
  const grid = section(host, "search", "Search", "Cost over the trials, a generation at a time; dotted lines are where a stage begins and the cost changes.", "one");
  const readout = el("output", { class: "readout" });
  const value = (v) => significant(v ?? NaN, 4);
  const marks = trials.length === 1 ? [{ x: trials[0], y: lines[0].y[0], colour: "var(--best)" }] : [];
  if (first !== null && first !== undefined) {
    const k = Math.max(0, trials.findIndex((count) => count >= first));
    marks.push({ shape: "star", x: first, y: lines[0].y[k], colour: "var(--good)" });
  }
  const show = (at) => {
    const k = at === null ? trials.length - 1 : nearest(trials, at);
    chart?.setCursor(at === null ? null : trials[k]);
    readout.value = `trial ${trials[k]}: best ${value(best[k])}, generation ${value(low[k])} to ${value(high[k])}`;
  };
  let chart = null;
  chart = plot(grid, context, {
    title: "Cost", lines, timed: false, height: 240, bands: [band], marks,
    margin: { left: 52 },
    legend: [{ name: "generation, best to worst", swatch: bandSwatch() }, ...(first ? [{ name: `first success, trial ${first}`, swatch: starSwatch() }] : [])],
    rules: stages.map((stage) => ({ x: stage.start, text: stages.length > 1 ? stage.name : "" })),
    x: { ...across, ticks: across.ticks.filter(Number.isInteger), unit: "trials" },
    y: logScale(Math.min(...finite) / 1.3, Math.max(...finite) * 1.3),
    onHover: show,
  });
  chart.element.parentElement.append(readout);
  show(null);
}

function starSwatch() {
  return svg("svg", { class: "swatch star", viewBox: "-8 -8 16 16", "aria-hidden": "true" }, svg("polygon", { fill: "var(--good)", points: Array.from({ length: 10 }, (_, i) => `${(i % 2 ? 3 : 7) * Math.sin((Math.PI * i) / 5)},${-(i % 2 ? 3 : 7) * Math.cos((Math.PI * i) / 5)}`).join(" ") }));
}

// A column per leg, a row per joint.
function perJoint(context, grid, spec) {
  const { legs } = context.series;
  const depth = Math.max(...legs.map((leg) => leg.joints.length));
  grid.style.setProperty("--columns", legs.length);
  for (let row = 0; row < depth; row++) {
    for (const leg of legs) {
      const joint = leg.joints[row];
      if (!joint) { grid.append(el("span", { class: "gap" })); continue; }
      plot(grid, context, { title: `${leg.name.toUpperCase()} ${joint.short}`, small: true, height: 118, margin: { left: 36 }, ...spec(joint, `var(--${leg.colour})`, leg) });
    }
  }
}

function key(grid, ...items) {
  grid.before(el("p", { class: "legend key" }, items.map(([mark, name]) => el("span", { class: "item" }, mark, el("span", {}, name)))));
}

function limitsAndScale(lines, low, high, least) {
  let [bottom, top] = bounds(lines.map((line) => line.y), least);
  if (low !== null && high !== null) {
    const room = 0.07 * (high - low);
    [bottom, top] = [Math.min(bottom, low - room), Math.max(top, high + room)];
  }
  const limits = [];
  if (high !== null && high < top) limits.push({ from: high, to: 1 });
  if (low !== null && low > bottom) limits.push({ from: low, to: -1 });
  return { limits, y: linearScale(bottom, top, 3) };
}

function angles(context, host) {
  const { series, times } = context;
  const reference = unpack(series.joints.reference), position = unpack(series.joints.position);
  const grid = section(host, "angles", "Joint angles", `What the policy asks for, and what the joint does. The figure beside each name is the measured angle. ${holdNote(context)}`, "legs");
  key(grid, [swatch("var(--ink)"), "measured [rad]"], [swatch("var(--ink)", "dashed"), "reference [rad]"], [shadeSwatch(), "beyond the joint's range"]);
  perJoint(context, grid, (joint, colour) => {
    const lines = [
      { x: times, y: position.column(joint.index), colour, width: 1.8 },
      { x: times, y: reference.column(joint.index), colour: "var(--ink)", dash: "dashed", width: 1.1, follow: false },
    ];
    return { lines, unit: "rad", readouts: 1, ...limitsAndScale(lines, joint.lower, joint.upper, 0.1) };
  });
}

function limited(context, host, { id, title, name, what, unit, limit, note }) {
  const { series, times } = context;
  const values = unpack(series.joints[what]);
  const grid = section(host, id, title, note, "legs");
  key(grid, [swatch("var(--ink)"), `${name} [${unit}]`], [shadeSwatch(), "beyond the limit"]);
  perJoint(context, grid, (joint, colour) => {
    const lines = [{ x: times, y: values.column(joint.index), colour, width: 1.5 }];
    const bound = joint[limit];
    return { lines, unit, digits: 1, ...limitsAndScale(lines, bound === null ? null : -bound, bound, 1) };
  });
}

function torques(context, host) {
  limited(context, host, { id: "torques", title: "Joint torques", name: "torque", what: "torque", unit: "Nm", limit: "torque", note: "Delivered by the actuators." });
}

function speeds(context, host) {
  limited(context, host, { id: "speeds", title: "Joint speeds", name: "speed", what: "velocity", unit: "rad/s", limit: "velocity", note: null });
}

function feet(context, host) {
  const { series, times, x } = context;
  const { legs } = series;
  const grid = section(host, "feet", "Feet", `Contact force on each foot, and when each foot is in contact (more than ${significant(series.feet.touches)} N). ${holdNote(context)}`, "two");
  const forces = {};
  for (const [what, title] of [["vertical", "Vertical force"], ["horizontal", "Horizontal force"]]) {
    const values = unpack(series.feet[what]);
    const lines = legs.map((leg, k) => ({ name: leg.name.toUpperCase(), x: times, y: values.column(k), colour: `var(--${leg.colour})`, dash: LEG_DASHES[k % 4] }));
    forces[what] = lines;
    const high = Math.max(1, ...lines.map((line) => line.y.reduce((a, b) => Math.max(a, b), 0)));
    plot(grid, context, { title, unit: "N", lines, digits: 0, y: linearScale(0, high * 1.05), margin: { left: 46 } });
  }
  const bars = legs.flatMap((leg, k) => {
    const row = legs.length - 1 - k;
    const touching = forces.vertical[k].y.map((v, i) => Math.hypot(v, forces.horizontal[k].y[i]) >= series.feet.touches ? 1 : 0);
    return spans(times, touching).map(([from, to]) => ({ row, from, to, colour: `var(--${leg.colour})` }));
  });
  const y = { ...linearScale(-0.6, legs.length - 0.4), ticks: [], names: legs.map((leg) => leg.name.toUpperCase()).reverse() };
  const wide = el("div", { class: "wide" });
  grid.append(wide);
  plot(wide, context, { title: "In contact", bars, y, x, height: 34 + 20 * legs.length, follow: false, margin: { left: 46 } });
}

function spans(times, on) {
  const found = [], step = times.length > 1 ? times[1] - times[0] : times[0];
  for (let i = 0; i < on.length; i++) {
    if (!on[i]) continue;
    if (i > 0 && on[i - 1]) found[found.length - 1][1] = times[i];
    else found.push([times[i] - step, times[i]]);
  }
  return found;
}

function policy(context, host) {
  const { series } = context;
  const times = unpack(series.policy.time).data, means = unpack(series.policy.means).data;
  const phi = unpack(series.policy.kernels), count = phi.shape[1];
  const x = timeScale(times[times.length - 1], times[times.length - 1]);
  const inner = { ...context, x };
  const grid = section(host, "policy", "Policy", `${count} normalised Gaussian kernels over the horizon; each policy is their sum, weighted, and is the desired angle of the joints it is named after.`, "policies");
  const lines = Array.from({ length: count }, (_, k) => ({ x: times, y: phi.column(k), colour: k % 2 ? "var(--x)" : "var(--z)", dash: LEG_DASHES[k % 2], width: 1.2 }));
  const wide = el("div", { class: "wide" });
  grid.append(wide);
  const chart = plot(wide, inner, { title: "Kernels", unit: "\u2013", lines, legend: [], height: 130, small: true, timed: false, follow: false, x, onSeek: context.onSeek, y: linearScale(0, 1.02 * Math.max(...lines.map((line) => line.y.reduce((a, b) => Math.max(a, b), 0))), 3) });
  chart.setTime = (t) => chart.setCursor(t);
  for (const { name, weights, angle } of series.policy.policies) {
    const w = unpack(weights).data, curve = unpack(angle).data;
    plot(grid, inner, {
      title: name, small: true, height: 118, margin: { left: 36 },
      lines: [{ x: times, y: curve, colour: "var(--ink)", width: 1.5 }],
      marks: Array.from(w, (value, i) => ({ x: means[i], y: value, colour: "var(--x)" })),
      y: linearScale(...bounds([curve, w], 0.1), 3),
    });
  }
  key(grid, [swatch("var(--ink)"), "desired angle [rad]"], [dotSwatch(), "weights, at the means of their kernels [rad]"]);
}

function dotSwatch() {
  return svg("svg", { class: "swatch", viewBox: "0 0 18 8", "aria-hidden": "true" }, svg("circle", { cx: 9, cy: 4, r: 3, fill: "var(--x)" }));
}
