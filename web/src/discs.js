// How the robot lies after each fall, on the two halves of the sphere of upward directions:
// createDiscs(element, falls, {looks, pitch, onChoose}) -> {show(indices or null), choose(index or null)}.
// falls: [{look, above, x, y, title}], places as levade.library.page.placed gives them. looks: name -> {colour, shape}.

import { markShape } from "./chart.js";
import { el, svg } from "./dom.js";

const RADIUS = 150; // of a disc, in the units of the drawing
const EDGE = 26;
const HALVES = [[true, "Upright, or on its belly", "level"], [false, "Upside down", "flat on its back"]];

export function createDiscs(element, falls, { looks, pitch, onChoose }) {
  const marks = [];
  const rings = [];
  for (const [above, title, middle] of HALVES) {
    const count = falls.filter((fall) => fall.above === above).length;
    const side = 2 * (RADIUS + EDGE);
    const root = svg("svg", { class: "disc", viewBox: `${-side / 2} ${-side / 2} ${side} ${side}`, role: "group", "aria-label": `${title}: ${count} falls` }, ...globe());
    const dots = svg("g");
    const ring = svg("circle", { class: "ring", r: 8 });
    ring.style.display = "none";
    rings.push([above, ring]);
    falls.forEach((fall, k) => {
      if (fall.above !== above) return;
      const { colour, shape } = looks[fall.look];
      const mark = markShape({ colour, shape, r: 0.4 * pitch * RADIUS }, fall.x * RADIUS, -fall.y * RADIUS);
      mark.append(svg("title", {}, fall.title));
      mark.addEventListener("click", () => onChoose(k));
      marks[k] = mark;
      dots.append(mark);
    });
    root.append(dots, ring);
    element.append(el("figure", {}, el("figcaption", {}, el("span", { class: "title" }, title), el("span", { class: "unit" }, `${count} fall${count === 1 ? "" : "s"}; in the middle: ${middle}`)), root));
  }
  return {
    show(indices) {
      const there = indices && new Set(indices);
      marks.forEach((mark, k) => mark.classList.toggle("faint", Boolean(there) && !there.has(k)));
    },
    choose(k) {
      for (const [above, ring] of rings) {
        const here = k !== null && falls[k].above === above;
        ring.style.display = here ? "" : "none";
        if (!here) continue;
        ring.setAttribute("cx", falls[k].x * RADIUS);
        ring.setAttribute("cy", -falls[k].y * RADIUS);
      }
    },
  };
}

// The disc, circles of equal tilt, and what is up at the rim.
function globe() {
  const circles = [30, 60].map((angle) => RADIUS * Math.sqrt(1 - Math.cos((angle * Math.PI) / 180)));
  const rim = RADIUS + 14;
  return [
    svg("circle", { class: "half", r: RADIUS }),
    ...circles.map((r) => svg("circle", { class: "tilt", r })),
    ...[[0, -rim, 0, "nose up"], [0, rim, 0, "nose down"], [-rim, 0, -90, "left side up"], [rim, 0, 90, "right side up"]].map(([x, y, turn, text]) =>
      svg("text", { x: 0, y: 4, transform: `translate(${x} ${y}) rotate(${turn})`, "text-anchor": "middle" }, text)),
    ...[30, 60].map((angle, k) => svg("text", { class: "angle", x: circles[k] * Math.SQRT1_2 + 3, y: circles[k] * Math.SQRT1_2 + 8 }, `${angle}\u00b0`)),
  ];
}
