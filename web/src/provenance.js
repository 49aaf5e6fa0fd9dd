// Where a motion is from: createProvenance(element, provenance). provenance: levade.report.summary.provenance_data.

import { el, fixed, significant } from "./dom.js";

export function createProvenance(element, provenance) {
  const { task, robot, seed, timestep, horizon, hold, engine, versions, trials, stopped, command, builtin, task_yaml: yaml, motion, certificate, written_by: writer } = provenance;
  const rows = [
    ["Task", task],
    ["Robot", robot],
    ["Seed", String(seed)],
    ["Search", `${trials} trials${stopped ? `, ended: ${stopped}` : ""}`],
    ["Simulation", `${engine}, steps of ${significant(timestep * 1e3)} ms, T = ${significant(horizon)} s${hold > 1e-9 ? `, hold ${fixed(hold, 1)} s` : ""}`],
    ["Versions", Object.entries(versions).map(([name, version]) => `${name} ${version}`).join(", ")],
    motion ? ["Motion file", motion] : null,
    certificate ? ["Certificate", el("a", { href: certificate.page }, certificate.says)] : null,
  ].filter(Boolean);
  const code = el("code", {}, command);
  const copy = el("button", { type: "button", class: "copy", onclick: () => copied(copy, command) }, "Copy");
  element.replaceChildren(
    el("header", {}, el("h2", {}, "Provenance")),
    el("dl", {}, rows.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))),
    el("p", { class: "again" }, builtin ? "The same versions give the same motion again with" : "With the task below saved as task.yaml, the same versions give the same motion again with"),
    el("div", { class: "command" }, code, copy),
    yaml ? el("details", {}, el("summary", {}, "The task, with every default filled in"), el("pre", {}, yaml)) : "",
    el("p", { class: "made" }, `Made by ${writer}. Distances in m, angles in rad, quaternions w-x-y-z, z up.`),
  );
}

async function copied(button, text) {
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    const range = document.createRange();
    range.selectNodeContents(button.previousElementSibling);
    getSelection().removeAllRanges();
    getSelection().addRange(range);
    button.textContent = "Selected";
  }
  setTimeout(() => { button.textContent = "Copy"; }, 1500);
}
