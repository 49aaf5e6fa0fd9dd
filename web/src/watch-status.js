// What the solve is doing, its buttons, and the best motion against the criteria: createStatus(element, task, {say}) -> {update, link, notice,
// word}. It says how it ended when it has.

import { el, fixed, significant, signed, svg } from "./dom.js";
import { command } from "./live-bits.js";

const MINUTE = 60;

export function createStatus(element, task, { say }) {
  const word = el("strong", {});
  const detail = el("span", {});
  const dot = el("i", { class: "dot" });
  const pause = el("button", { type: "button", class: "button", id: "pause", onclick: () => say({ say: paused ? "continue" : "pause" }) }, "Pause");
  const stop = el("button", { type: "button", class: "button warn", id: "stop", title: "As Ctrl-C does: the best motion so far is written, and the run can go on later", onclick: () => { stop.disabled = true; say({ say: "stop" }); } }, "Stop and keep");
  const buttons = el("div", { class: "buttons" }, pause, stop);
  const trials = el("output", { id: "trials" }, "0");
  const bar = el("i", {});
  const progress = el("div", { class: "progress", role: "progressbar", "aria-valuemin": 0, "aria-valuemax": task.budget, "aria-label": "trials" }, bar);
  const figures = el("dl", { class: "figures" });
  const stages = el("ol", { class: "stages" }, task.stages.map(({ name }) => el("li", {}, name)));
  const complaint = el("p", { class: "complaint", role: "alert" });
  const end = el("div", { class: "end", "aria-live": "polite" });
  const goals = el("div", {});
  element.replaceChildren(
    el("div", { class: "state" }, el("p", { class: "word", role: "status" }, dot, word, detail), buttons),
    end, complaint,
    el("div", {}, el("p", { class: "count" }, trials, el("small", {}, ` of ${task.budget} trials`)), progress),
    task.stages.length > 1 ? stages : "",
    figures, goals);

  let rows = [], state = null, verdict = null, paused = false, heard = 0, elapsed = 0, link = "open", timer = 0;
  const pace = []; // [elapsed, trials]

  function update(next) {
    ({ rows, state } = next);
    if (next.verdict) {
      verdict = next.verdict;
      elapsed = verdict.elapsed;
      finish();
    } else if (next.elapsed !== undefined) {
      elapsed = next.elapsed;
      heard = performance.now();
    }
    paused = state.paused;
    const last = rows[rows.length - 1];
    if (last) {
      pace.push([elapsed, last[0]]);
      while (pace.length > 2 && pace[pace.length - 1][0] - pace[0][0] > 10) pace.shift();
      trials.value = String(last[0]);
      bar.style.width = `${Math.min(100, (100 * last[0]) / task.budget)}%`;
      progress.setAttribute("aria-valuenow", last[0]);
      stages.childNodes.forEach((item, k) => { item.className = k === last[1] ? "current" : k < last[1] ? "done" : ""; });
      goals.replaceChildren(criteria(last, task));
    }
    pause.textContent = paused ? "Continue" : "Pause";
    if (state.stopping) stop.disabled = pause.disabled = true;
    paint();
  }

  function paint() {
    const [kind, text, more] = describe();
    dot.className = `dot ${kind}`;
    word.textContent = text;
    detail.textContent = more;
    const now = verdict || paused ? elapsed : elapsed + (heard ? (performance.now() - heard) / 1000 : 0);
    const last = rows[rows.length - 1];
    const rate = !verdict && pace.length > 1 ? (pace[pace.length - 1][1] - pace[0][1]) / Math.max(pace[pace.length - 1][0] - pace[0][0], 1e-3) : 0;
    const facts = [
      ["elapsed", duration(now)],
      ["generation", String(rows.length)],
      ["best cost", last ? significant(last[2], 4) : "\u2013"],
      ["step size", last ? `${significant(last[6])}` : "\u2013"],
    ];
    if (rate > 0 && !paused) facts.splice(1, 0, ["trials a second", significant(rate, 2)], ["at most left", duration((task.budget - last[0]) / rate)]);
    const broken = rows.reduce((sum, row) => sum + row[7], 0);
    if (broken) facts.push(["diverged", String(broken)]);
    figures.replaceChildren(...facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))));
  }

  function describe() {
    const best = rows[rows.length - 1];
    if (verdict) return ended(verdict);
    if (link === "gone") return ["bad", "Out of sight", "the solve is no longer there; this is its last state"];
    if (link === "waiting") return ["rest", "Connecting", "the solve does not answer; it goes on without this page"];
    if (state?.stopping) return ["rest", "Stopping", "after this generation"];
    if (paused) return ["rest", "Paused", ""];
    return best?.[8] ? ["good", "Success", "looking for a lower cost"] : ["busy", "Searching", ""];
  }

  function finish() {
    clearInterval(timer);
    buttons.remove();
    if (!verdict.motion) return;
    const { outcome, motion } = verdict;
    const lines = [["The motion", motion]];
    lines.push(["Look at it closely", `levade show ${quoted(motion)}`]);
    if (outcome === "interrupted") lines.push(["Go on with the search", `levade solve --resume ${quoted(task.directory)}`]);
    end.replaceChildren(...lines.flatMap(([name, text]) => [el("p", { class: "what" }, name), command(text)]));
  }

  timer = setInterval(paint, 500);
  paint();
  return {
    update,
    link(next) { link = next; buttons.inert = next !== "open"; if (next === "gone" && !verdict) buttons.remove(); paint(); },
    notice(text) { complaint.textContent = text ?? ""; },
    word: () => describe()[1],
  };
}

function ended({ outcome, success, trials, trials_to_success: first }) {
  if (outcome === "error") return ["bad", "Ended by an error", "the terminal says which"];
  if (success) return ["good", "Success", `first at trial ${first}, ended at trial ${trials}`];
  if (outcome === "interrupted") return ["rest", "Stopped", `after ${trials} trials; the best so far is kept`];
  return ["bad", "No success", `within ${trials} trials`];
}

// The best motion against what is required.
function criteria(row, task) {
  if (!task.criteria.length) return el("p", { class: "note" }, "The task has no criteria of success.");
  const items = task.criteria.map(({ name, unit, tolerance, target, minimum, maximum }, k) => {
    const error = row[10][k];
    const met = error !== null && Math.abs(error) <= tolerance;
    const goal = target !== null ? `${fixed(target, 3)} \u00b1 ${significant(tolerance)} ${unit}` : [minimum === null ? "" : `\u2265 ${significant(minimum)}`, maximum === null ? "" : `\u2264 ${significant(maximum)}`].filter(Boolean).join(", ") + ` ${unit}`;
    return el("tr", {},
      el("th", { scope: "row" }, name.replaceAll("_", " "), el("small", {}, goal)),
      el("td", {}, error === null ? el("small", {}, "not simulated yet") : el("span", { class: "error" }, signed(error, Math.abs(error) < 100 ? 4 : 1), el("small", {}, ` ${unit}`))),
      el("td", { class: "reach" }, meter(error, tolerance, met)),
      el("td", { class: `met ${met ? "good" : ""}` }, met ? tick() : ""));
  });
  return el("table", { class: "goals" },
    el("thead", {}, el("tr", {}, ["Criterion", "Error of the best", "", ""].map((text, k) => el("th", { scope: "col", class: k === 1 ? "number" : "" }, text)))),
    el("tbody", {}, items));
}

// How far from what is allowed, by powers of ten: full at a thousand times, at the mark when it is met.
function meter(error, tolerance, met) {
  if (error === null) return "";
  const share = Math.abs(error) / (tolerance || 1e-3);
  const far = Math.min(1, Math.max(0, Math.log10(share) / 3));
  return svg("svg", { viewBox: "0 0 80 16", role: "img", "aria-label": `${significant(share, 2)} times what is allowed` },
    svg("rect", { class: "track", x: 0, y: 6, width: 80, height: 4, rx: 2 }),
    svg("rect", { class: "allowed", x: 0, y: 3, width: 14, height: 10, rx: 2 }),
    svg("circle", { class: met ? "good" : "far", cx: met ? 7 : 18 + 58 * far, cy: 8, r: 4 }));
}

function tick() {
  return svg("svg", { viewBox: "0 0 16 16", role: "img", "aria-label": "met" }, svg("path", { d: "M3 8.5l3.2 3.3L13 4.6" }));
}

function duration(seconds) {
  const whole = Math.max(0, Math.round(seconds));
  const hours = Math.floor(whole / 3600), minutes = Math.floor((whole % 3600) / MINUTE);
  if (hours) return `${hours} h ${String(minutes).padStart(2, "0")} min`;
  return minutes ? `${minutes} min ${String(whole % MINUTE).padStart(2, "0")} s` : `${whole} s`;
}

function quoted(path) {
  return /^[\w./-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
