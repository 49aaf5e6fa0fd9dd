// One plot in SVG: lines, bands, bars, limits and marks over x, with a cursor. Colours are CSS variables, so that a change
// of theme needs no new drawing. It redraws itself when its width changes.
//
//   const c = createChart(host, {height: 180, x: timeScale(series), lines: [{x, y, colour, dash}], onSeek: (x) => ...})
//   c.setCursor(0.12); c.update({lines: [...]})

import { significant, svg } from "./dom.js";

const MARGIN = { left: 40, right: 10, top: 8, bottom: 20 };

// x -> [0, 1] and back. Where the hold is longer than half the horizon, it is drawn to a shorter scale.
export function timeScale(horizon, end) {
  const short = end > 1.5 * horizon;
  const rate = short ? ((end - horizon) * 3) / horizon : 1; // then the hold takes a quarter of the width
  const full = horizon + (end - horizon) / rate;
  const forward = (t) => (t <= horizon ? t : horizon + (t - horizon) / rate) / full;
  const inverse = (u) => (u * full <= horizon ? u * full : horizon + (u * full - horizon) * rate);
  const step = niceStep(short ? horizon : end, 4);
  const last = short ? horizon : end;
  const ticks = [];
  for (let k = 0; k * step < last - step * 0.45; k++) ticks.push(k * step);
  if (short) ticks.push(horizon);
  ticks.push(end);
  return { min: 0, max: end, forward, inverse, ticks, unit: "s", horizon: end - horizon > 1e-9 ? horizon : null, short };
}

export function linearScale(min, max, parts = 5) {
  const ticks = niceTicks(min, max, parts);
  return { min, max, forward: (v) => (v - min) / (max - min), inverse: (u) => min + u * (max - min), ticks };
}

export function logScale(min, max) {
  const low = Math.log10(min), high = Math.log10(max);
  const all = [];
  for (let p = Math.floor(low); p <= Math.ceil(high); p++) {
    for (const f of high - low < 2 ? [1, 2, 5] : [1]) all.push(f * 10 ** p);
  }
  const inside = all.filter((v) => v >= min * 0.999 && v <= max * 1.001);
  const every = Math.max(1, Math.ceil(inside.length / 7));
  const ticks = inside.length > 1 ? inside.filter((v, i) => i % every === 0) : niceTicks(min, max, 4).filter((v) => v > 0);
  return { min, max, log: true, forward: (v) => (Math.log10(v) - low) / (high - low), inverse: (u) => 10 ** (low + u * (high - low)), ticks };
}

export function niceStep(span, parts) {
  const raw = span / parts, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((f) => f * power).reduce((a, b) => (Math.abs(Math.log(b / raw)) < Math.abs(Math.log(a / raw)) ? b : a));
}

function niceTicks(min, max, parts) {
  const step = niceStep(max - min, parts), ticks = [];
  for (let k = Math.ceil(min / step - 1e-9); k * step <= max + step * 1e-9; k++) ticks.push(Math.abs(k) < 1e-12 ? 0 : k * step);
  return ticks;
}

function label(value, ticks, log) {
  if (log) return value >= 1e-3 && value < 1e4 ? String(Number(value.toPrecision(2))) : significant(value, 1);
  const step = ticks.length > 1 ? Math.min(...ticks.slice(1).map((t, i) => t - ticks[i]).filter((d) => d > 0)) : 1;
  const digits = Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
  const precise = Math.abs(value * 10 ** digits - Math.round(value * 10 ** digits)) > 1e-6 ? digits + 1 : digits;
  const text = Math.abs(value).toFixed(precise);
  return (value < 0 && Number(text) !== 0 ? "\u2212" : "") + text;
}

// Bounds that show all lines and all that is wanted, and do not blow up noise.
export function bounds(arrays, least, wanted = []) {
  let low = Infinity, high = -Infinity;
  for (const values of [...arrays, wanted]) {
    for (const v of values) if (Number.isFinite(v)) { if (v < low) low = v; if (v > high) high = v; }
  }
  if (low > high) [low, high] = [0, 1];
  const room = Math.max(0, least - (high - low)) / 2 + 0.06 * Math.max(high - low, least);
  return [low - room, high + room];
}

export function createChart(host, spec) {
  const root = svg("svg", { class: "chart", role: "img", "aria-label": spec.label ?? "plot" });
  host.append(root);
  let state = spec, width = 0, at = null, seen = true, late = 0, plot = null;

  function draw() {
    const w = Math.max(120, Math.round(width || host.clientWidth || 320)), h = state.height;
    const m = { ...MARGIN, ...(state.margin ?? {}) };
    const inner = { w: w - m.left - m.right, h: h - m.top - m.bottom };
    const { x, y } = state;
    const px = (v) => m.left + x.forward(v) * inner.w;
    const py = (v) => m.top + (1 - y.forward(v)) * inner.h;
    root.setAttribute("viewBox", `0 0 ${w} ${h}`);
    const back = svg("g"), front = svg("g"), cursor = svg("g", { class: "cursor" });
    const clip = { x: m.left, y: m.top, width: inner.w, height: inner.h };

    if (x.horizon) back.append(svg("rect", { class: "hold", x: px(x.horizon), y: m.top, width: px(x.max) - px(x.horizon), height: inner.h }));
    for (const v of y.ticks) {
      const at = py(v);
      back.append(svg("line", { class: v === 0 && !y.log ? "zero" : "grid", x1: m.left, x2: m.left + inner.w, y1: at, y2: at }));
      if (!y.names) back.append(svg("text", { class: "tick", x: m.left - 6, y: at + 3.5, "text-anchor": "end" }, label(v, y.ticks, y.log)));
    }
    (y.names ?? []).forEach((name, k) => back.append(svg("text", { class: "tick name", x: m.left - 8, y: py(k) + 4, "text-anchor": "end" }, name)));
    const labels = x.ticks.map((v) => label(v, x.ticks, false));
    const width1 = 6.2 * Math.max(...labels.map((text) => text.length)) + 10;
    let free = -Infinity, reserved = m.left + inner.w - width1 - 8;
    x.ticks.forEach((v, k) => {
      const last = k === x.ticks.length - 1, at = px(v);
      back.append(svg("line", { class: "stub", x1: at, x2: at, y1: m.top + inner.h, y2: m.top + inner.h + 4 }));
      if (!last && (at - width1 / 2 < free || at + width1 / 2 > reserved)) return;
      free = at + width1 / 2;
      const end = last && at > m.left + inner.w - 20;
      back.append(svg("text", { class: "tick", x: end ? w - 2 : at, y: h - 4, "text-anchor": end ? "end" : "middle" }, last && x.unit ? `${labels[k]} ${x.unit}` : labels[k]));
    });
    for (const limit of state.limits ?? []) shade(back, limit, px, py, clip);
    if (x.horizon) back.append(svg("line", { class: "horizon", x1: px(x.horizon), x2: px(x.horizon), y1: m.top, y2: m.top + inner.h }));
    for (const rule of state.rules ?? []) vertical(back, rule, px, clip);
    for (const goal of state.goals ?? []) {
      back.append(svg("line", { class: "goal", stroke: goal.colour, x1: m.left, x2: px(goal.time), y1: py(goal.target), y2: py(goal.target) }));
      front.append(svg("path", { class: "tolerance", stroke: goal.colour, d: whisker(px(goal.time), py(goal.target - goal.tolerance), py(goal.target + goal.tolerance)) }));
      front.append(svg("circle", { class: "target", stroke: goal.colour, cx: px(goal.time), cy: py(goal.target), r: 4 }));
    }
    for (const band of state.bands ?? []) back.append(svg("path", { class: "band", fill: band.colour, d: area(band, px, py, y) }));
    for (const bar of state.bars ?? []) back.append(svg("rect", { class: "span", fill: bar.colour, x: px(bar.from), y: py(bar.row) - 6, width: Math.max(1, px(bar.to) - px(bar.from)), height: 12, rx: 2 }));
    const dots = [];
    for (const line of state.lines ?? []) {
      const look = { class: `line ${line.dash ?? ""}`, stroke: line.colour, style: line.width ? `stroke-width:${line.width}` : null };
      back.append(svg("path", { ...look, d: path(line, px, py, inner.w) }));
      if (state.follow !== false && line.follow !== false) {
        const dot = svg("circle", { r: 3, fill: line.colour });
        dots.push([line, dot]);
        cursor.append(dot);
      }
    }
    for (const mark of state.marks ?? []) front.append(markShape(mark, px(mark.x), py(mark.y)));
    const rule = svg("line", { y1: m.top, y2: m.top + inner.h, x1: 0, x2: 0 });
    cursor.prepend(rule);
    root.replaceChildren(back, front, cursor);
    plot = { px, py, rule, dots, cursor, m, inner, w };
    showCursor();
  }

  function showCursor() {
    if (!plot) return;
    plot.cursor.style.display = at === null ? "none" : "";
    if (at === null) return;
    const x = plot.px(Math.min(Math.max(at, state.x.min), state.x.max));
    plot.rule.setAttribute("x1", x);
    plot.rule.setAttribute("x2", x);
    for (const [line, dot] of plot.dots) {
      const value = line.y[nearest(line.x, at)];
      const shown = Number.isFinite(value) && at <= line.x[line.x.length - 1] + 1e-6;
      dot.style.display = shown ? "" : "none";
      if (shown) { dot.setAttribute("cx", x); dot.setAttribute("cy", plot.py(value)); }
    }
  }

  function fromEvent(event) {
    const box = root.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * plot.w;
    return state.x.inverse(Math.min(1, Math.max(0, (x - plot.m.left) / plot.inner.w)));
  }

  if (spec.onSeek) {
    root.classList.add("seekable");
    let held = false;
    root.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      held = true;
      root.setPointerCapture(event.pointerId);
      state.onSeek(fromEvent(event));
    });
    root.addEventListener("pointermove", (event) => held && state.onSeek(fromEvent(event)));
    for (const name of ["pointerup", "pointercancel"]) root.addEventListener(name, () => { held = false; });
  }
  if (spec.onHover) {
    root.addEventListener("pointermove", (event) => state.onHover(fromEvent(event)));
    root.addEventListener("pointerleave", () => state.onHover(null));
  }

  const resized = new ResizeObserver(([entry]) => {
    const w = Math.round(entry.contentRect.width);
    if (w && w !== width) { width = w; draw(); }
  });
  resized.observe(host);
  const watched = new IntersectionObserver((entries) => {
    seen = entries[entries.length - 1].isIntersecting;
    if (seen) showCursor();
  }, { rootMargin: "100px" });
  watched.observe(root);
  width = host.clientWidth;
  draw();

  return {
    element: root,
    // where it cannot be seen, the cursor comes after once the time stands still
    setCursor(x) {
      at = x;
      clearTimeout(late);
      if (seen) showCursor();
      else late = setTimeout(showCursor, 300);
    },
    update(changes) { state = { ...state, ...changes }; draw(); },
    destroy() { clearTimeout(late); resized.disconnect(); watched.disconnect(); root.remove(); },
  };
}

// Index of the sample that is in force at x: the first whose own x is not before it.
export function nearest(xs, x) {
  let low = 0, high = xs.length - 1;
  while (low < high) {
    const mid = (low + high) >> 1;
    if (xs[mid] < x - 1e-6) low = mid + 1; else high = mid;
  }
  return low;
}

// As many points as can be seen: of each pixel's samples the lowest and the highest.
function path({ x, y }, px, py, width) {
  const n = y.length, size = Math.max(1, Math.floor(n / (2 * width)));
  let d = "", pen = false;
  const to = (i) => {
    if (!Number.isFinite(y[i])) { pen = false; return; }
    d += `${pen ? "L" : "M"}${px(x[i]).toFixed(1)} ${py(y[i]).toFixed(1)}`;
    pen = true;
  };
  if (size === 1) for (let i = 0; i < n; i++) to(i);
  else {
    for (let i = 0; i < n; i += size) {
      let low = i, high = i;
      for (let k = i; k < Math.min(n, i + size); k++) { if (y[k] < y[low]) low = k; if (y[k] > y[high]) high = k; }
      to(Math.min(low, high));
      if (low !== high) to(Math.max(low, high));
    }
    to(n - 1);
  }
  return n === 1 && d ? `${d}h0.01` : d; // a dot
}

function area({ x, low, high }, px, py, y) {
  const inside = (v) => Math.min(Math.max(v, y.min), y.max);
  const up = [], down = [];
  for (let i = 0; i < x.length; i++) {
    if (!Number.isFinite(low[i])) continue;
    up.push(`${px(x[i]).toFixed(1)} ${py(inside(Number.isFinite(high[i]) ? high[i] : y.max)).toFixed(1)}`);
    down.unshift(`${px(x[i]).toFixed(1)} ${py(inside(low[i])).toFixed(1)}`);
  }
  return up.length ? `M${[...up, ...down].join("L")}Z` : "";
}

function shade(group, { from, to }, px, py, clip) {
  const edge = py(from), far = to > 0 ? clip.y : clip.y + clip.height;
  const top = Math.max(clip.y, Math.min(edge, far)), height = Math.min(clip.y + clip.height, Math.max(edge, far)) - top;
  if (height <= 0) return;
  group.append(svg("rect", { class: "beyond", x: clip.x, width: clip.width, y: top, height }));
  group.append(svg("line", { class: "limit", x1: clip.x, x2: clip.x + clip.width, y1: edge, y2: edge }));
}

function vertical(group, { x, text, above }, px, clip) {
  const at = px(x);
  if (x > 0) group.append(svg("line", { class: "horizon", x1: at, x2: at, y1: clip.y, y2: clip.y + clip.height }));
  const edge = at > clip.x + clip.width - 60;
  if (text) group.append(svg("text", { class: "tick stage", x: edge ? at - 4 : at + 4, y: above ? clip.y - 5 : clip.y + 10, "text-anchor": edge ? "end" : "start" }, text));
}

function whisker(x, a, b) {
  return `M${x} ${a}V${b}M${x - 3} ${a}h6M${x - 3} ${b}h6`;
}

// A mark at x, y: a star, a triangle, a square, a cross or a dot, about as large as a dot of radius r.
export function markShape({ shape, colour, r = 3 }, x, y) {
  if (shape === "star") {
    const points = Array.from({ length: 10 }, (_, i) => {
      const far = i % 2 ? 2.8 : 6.5, a = (Math.PI * i) / 5;
      return `${(x + far * Math.sin(a)).toFixed(1)},${(y - far * Math.cos(a)).toFixed(1)}`;
    });
    return svg("polygon", { class: "mark", points: points.join(" "), fill: colour });
  }
  if (shape === "triangle") return svg("path", { class: "mark", fill: colour, d: `M${x} ${y - 1.35 * r}l${1.25 * r} ${2.2 * r}h${-2.5 * r}z` });
  if (shape === "square") return svg("rect", { class: "mark", fill: colour, x: x - r, y: y - r, width: 2 * r, height: 2 * r });
  if (shape === "cross") return svg("path", { class: "mark cross", style: `stroke:${colour}`, d: `M${x - r} ${y - r}l${2 * r} ${2 * r}m0 ${-2 * r}l${-2 * r} ${2 * r}` });
  return svg("circle", { class: "mark", cx: x, cy: y, r, fill: colour });
}
