// Sliders for the costs' weights: createWeights(element, task, {onMove(factors)}) -> {update({...}), disable()}. A slider is a factor on what
// the task says, from a tenth to ten times; it is sent when it is let go, and holds from the next generation on.

import { el, significant } from "./dom.js";
import { swatch } from "./live-figure.js";

const SNAP = 0.04; // in decades: nearer to 1 than this is 1
const PATIENCE = 1500; // ms that a slider stays where it was let go, without an answer

export function createWeights(element, { costs, range, stages }, { looks, onMove }) {
  const span = Math.log10(range);
  const reset = el("button", { type: "button", class: "quiet", onclick: () => move(Object.fromEntries(costs.map(({ name }) => [name, 1]))) }, "Reset all");
  const sent = new Map(); // name -> {factor, until}: what the solve has not answered yet
  let factors = {}, wanted = {}, stage = 0, held = null, dead = false;

  const rows = costs.map(({ name, weight }, k) => {
    const slider = el("input", { type: "range", min: -span, max: span, step: "any", value: 0, "aria-label": `Weight of ${name}` });
    const factor = el("output", { class: "factor" });
    const now = el("span", { class: "weight" });
    const note = el("small", { class: "note" });
    const one = el("button", { type: "button", class: "quiet one", title: `Back to the task's ${significant(weight)}`, "aria-label": `Reset ${name}`, onclick: () => move({ [name]: 1 }) }, "\u21ba");
    const read = () => (Math.abs(slider.value) < SNAP ? 1 : Number((10 ** slider.value).toPrecision(3)));
    slider.addEventListener("input", () => { held = name; paint(); });
    slider.addEventListener("change", () => { held = null; move({ [name]: read() }); });
    slider.addEventListener("dblclick", () => move({ [name]: 1 }));
    const row = el("li", { class: weight === 0 ? "off" : "" },
      el("span", { class: "name" }, swatch(looks[k]), name.replaceAll("_", " ")), now, factor, one,
      el("div", { class: "track" }, slider, el("span", { class: "tick", style: "left:50%" })), note);
    return { name, weight, slider, factor, now, note, one, read, row };
  });
  element.replaceChildren(
    el("header", { class: "split" }, el("h2", {}, "Weights"), reset),
    el("p", { class: "note" }, "Move a weight, and the search goes by it from the next generation on. What you change is recorded in the run\u2019s task.yaml."),
    el("ul", { class: "weights" }, rows.map(({ row }) => row)));

  function move(changed) {
    for (const [name, factor] of Object.entries(changed)) sent.set(name, { factor, until: performance.now() + PATIENCE });
    paint();
    onMove(changed);
  }

  function paint() {
    const own = stages[stage]?.weights ?? {};
    let moved = false;
    for (const { name, weight, slider, factor, now, note, one, read, row } of rows) {
      const target = held === name ? read() : (sent.get(name)?.factor ?? wanted[name] ?? factors[name] ?? 1);
      if (held !== name) slider.value = Math.log10(target);
      const inForce = factors[name] ?? 1;
      const base = own[name] ?? weight;
      const share = (Number(slider.value) + span) / (2 * span);
      slider.style.setProperty("--from", `${Math.min(share, 0.5) * 100}%`);
      slider.style.setProperty("--to", `${Math.max(share, 0.5) * 100}%`);
      slider.setAttribute("aria-valuetext", `${significant(target)} times the task's`);
      slider.disabled = one.disabled = dead || weight === 0 && base === 0;
      factor.value = `\u00d7${significant(target)}`;
      now.textContent = significant(base * inForce);
      row.classList.toggle("pending", target !== inForce);
      row.classList.toggle("moved", target !== 1);
      note.textContent = held === name ? `let go to use ${significant(base * target)}`
        : target !== inForce && !dead ? `${significant(base * target)} from the next generation on`
        : own[name] !== undefined && own[name] !== weight ? `stage ${stages[stage].name} weighs it ${significant(own[name])}; the task ${significant(weight)}`
        : "";
      moved ||= target !== 1;
    }
    reset.disabled = dead || !moved;
  }

  paint();
  return {
    // factors: in force; wanted: still to come; stage: index
    update(next) {
      ({ factors = factors, wanted = wanted, stage = stage } = next);
      for (const [name, { factor, until }] of sent) {
        if ((wanted[name] ?? factors[name] ?? 1) === factor || performance.now() > until) sent.delete(name);
      }
      paint();
    },
    disable() { dead = true; wanted = {}; sent.clear(); held = null; paint(); },
  };
}
