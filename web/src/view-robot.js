// A robot to take by the joints: sliders within their limits, postures, and what there is to know of the robot.

import { el, fixed, significant } from "./dom.js";
import { command, spot } from "./live-bits.js";
import { createAxes, createFan, createNames } from "./view-marks.js";
import { createKinematics } from "./view-kinematics.js";

const WIDE = ["", "Neutral"]; // columns that a phone does without
const FREE = Math.PI; // rad to each side, where a joint has no limit

export function createRobot({ side, below, toggles, player, theme, data }) {
  const { joints, tree, scene, postures, together } = data;
  const kinematics = createKinematics(tree);
  const feet = scene.motion.feet;
  const size = 1.6 * data.trunk.position[2];
  let angles = [...postures.neutral];
  let way = null; // of moving several legs

  // marks on the robot
  const legs = [...new Set(joints.map(({ leg }) => leg))];
  const colour = (palette) => (leg) => palette.legs[legs.indexOf(leg) % palette.legs.length];
  const names = createNames(feet, size, (palette) => feet.map(({ leg }) => colour(palette)(leg)));
  const axes = createAxes(kinematics.bodies, size, (palette) => joints.map(({ leg }) => colour(palette)(leg)));
  const fan = createFan(kinematics.bodies, size);
  let redraw = player.attach(-1, fan.group);
  for (const mark of [...names.objects, ...axes.objects]) redraw = player.attach(mark.body, mark.object);
  theme.onChange((name) => { for (const part of [names, axes, fan]) part.setTheme(scene.palette[name]); redraw(); });
  for (const [objects, label, shown] of [[names.objects, "feet", true], [axes.objects, "joint axes", false]]) {
    const box = el("input", { type: "checkbox", onchange: () => show() });
    const show = () => { for (const { object } of objects) object.visible = box.checked; redraw(); };
    box.checked = shown;
    show();
    toggles.append(el("label", {}, box, el("span", {}, label)));
  }

  const rows = joints.map((joint, k) => slider(joint, k));
  const groups = legs.map((leg) => {
    const own = rows.filter((_, k) => joints[k].leg === leg);
    return el("section", { class: "leg" }, el("h3", {}, spot(`var(--${joints.find((joint) => joint.leg === leg).colour})`), leg.toUpperCase()), el("ul", {}, own.map(({ row }) => row)));
  });
  const presets = el("div", { class: "presets", role: "group", "aria-label": "Postures" }, Object.entries(postures).map(([name, values]) => el("button", { type: "button", class: "quiet", onclick: () => set(values) }, name)));
  const ways = together.length
    ? el("div", { class: "speeds", role: "radiogroup", "aria-label": "Move" }, [{ label: "one leg", joints: null }, ...together].map((each, k) => {
      const radio = el("input", { type: "radio", name: "way", onchange: () => { way = each.joints; } });
      radio.checked = k === 0;
      return el("label", {}, radio, el("span", {}, each.label));
    }))
    : null;
  const text = command("", { id: "posture" });
  const code = text.querySelector("code");
  side.append(
    el("header", { class: "split" }, el("h2", {}, "Joints"), presets),
    el("div", { class: "options ways" }, ways ? el("span", { class: "what" }, "A slider moves") : null, ways),
    el("div", { class: "joints" }, groups),
    el("div", {}, el("p", { class: "what" }, "This posture, for a robot.yaml or a task"), text));

  function slider(joint, k) {
    const lower = joint.lower ?? -FREE, upper = joint.upper ?? FREE;
    const input = el("input", {
      type: "range", min: lower, max: upper, step: "any", "aria-label": joint.name,
      oninput: () => move(k, Number(input.value)), onfocus: () => mark(k), onblur: () => mark(null), onpointerdown: () => mark(k),
    });
    const value = el("output", {});
    const neutral = (postures.neutral[k] - lower) / (upper - lower);
    const row = el("li", { onpointerenter: () => mark(k), onpointerleave: () => mark(document.activeElement === input ? k : null) },
      el("span", { class: "name" }, short(joint)), value,
      el("div", { class: "track" }, input, el("span", { class: "tick", style: `left:${100 * neutral}%`, title: "neutral" })),
      el("small", {}, joint.lower === null ? "no limit" : degrees(lower)), el("small", {}, joint.upper === null ? "no limit" : degrees(upper)));
    return { row, input, value, lower, upper };
  }

  function move(k, value) {
    const next = [...angles];
    if (way) {
      const [group, sign] = way[k];
      way.forEach(([other, its], i) => { if (other === group) next[i] = clamp(value * sign * its, rows[i]); });
    }
    next[k] = value;
    set(next);
    mark(k);
  }

  let marked = null;
  function mark(k) {
    marked = k;
    if (k === null) fan.hide();
    else fan.show(k, angles[k], joints[k].lower, joints[k].upper, feet.find(({ leg }) => leg === joints[k].leg)?.centre);
    redraw();
  }

  // the trunk stays level, and as high as the lowest foot wants it
  function set(values) {
    angles = [...values];
    kinematics.pose([0, 0, 0], angles);
    const lowest = Math.min(...feet.map(lowestOf));
    kinematics.pose([data.trunk.position[0], data.trunk.position[1], -lowest], angles);
    player.pose(kinematics.position, kinematics.quaternion);
    rows.forEach(({ input, value, lower, upper }, k) => {
      if (document.activeElement !== input || Number(input.value) !== angles[k]) input.value = angles[k];
      const here = (angles[k] - lower) / (upper - lower), from = (postures.neutral[k] - lower) / (upper - lower);
      input.style.setProperty("--from", `${100 * Math.min(here, from)}%`);
      input.style.setProperty("--to", `${100 * Math.max(here, from)}%`);
      input.setAttribute("aria-valuetext", `${fixed(angles[k], 2)} rad`);
      value.replaceChildren(fixed(angles[k], 2), el("small", {}, ` rad  ${degrees(angles[k])}`));
    });
    const changed = joints.map(({ name }, k) => [name, angles[k], postures.neutral[k], rows[k]]).filter(([, angle, before]) => Math.abs(angle - before) > 5e-4);
    code.textContent = changed.length ? `{${changed.map(([name, angle, , bounds]) => `${name}: ${rounded(angle, bounds)}`).join(", ")}}` : "neutral";
    if (marked !== null) mark(marked);
  }

  function lowestOf({ body, centre, down }) {
    const [x, y, z] = centre;
    const [a, b, c, d] = kinematics.quaternion.subarray(4 * body, 4 * body + 4);
    // third row of the rotation: how high the foot's centre is over its body
    const up = 2 * (a * c - b * d) * x + 2 * (b * c + a * d) * y + (1 - 2 * (a * a + b * b)) * z;
    return kinematics.position[3 * body + 2] + up - down;
  }

  set(angles);
  below.append(about(data));
  window.levade = { set, kinematics, get angles() { return [...angles]; } }; // for tests, and for the curious
}

// What is known of the robot, and every joint's limits.
function about({ facts, joints, postures }) {
  const heads = ["Joint", "Range", "", "Speed", "Torque", "Neutral"];
  const limit = (value, unit) => (value === null ? el("small", {}, "no limit") : [significant(value, 4), el("small", {}, ` ${unit}`)]);
  const rows = joints.map((joint, k) => el("tr", {},
    el("th", { scope: "row" }, spot(`var(--${joint.colour})`), joint.name),
    el("td", {}, joint.lower === null ? el("small", {}, "no limit") : `${fixed(joint.lower, 3)} to ${fixed(joint.upper, 3)}`, joint.lower === null ? "" : el("small", {}, " rad")),
    el("td", { class: "wide-only" }, joint.lower === null ? "" : el("small", {}, `${degrees(joint.lower)} to ${degrees(joint.upper)}`)),
    el("td", {}, limit(joint.velocity, "rad/s")), el("td", {}, limit(joint.torque, "Nm")), el("td", { class: "wide-only" }, fixed(postures.neutral[k], 3), el("small", {}, " rad"))));
  return el("section", { class: "panel" },
    el("header", {}, el("h2", {}, "The robot")),
    el("dl", { class: "known" }, facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))),
    el("div", { class: "wide-table" }, el("table", { class: "plain" },
      el("thead", {}, el("tr", {}, heads.map((text) => el("th", { scope: "col", class: WIDE.includes(text) ? "wide-only" : "" }, text)))), el("tbody", {}, rows))));
}

// To a milliradian, and never beyond the limits, which would be no posture.
function rounded(angle, { lower, upper }) {
  return Math.min(Math.max(Math.round(1000 * angle), Math.ceil(1000 * lower)), Math.floor(1000 * upper)) / 1000;
}

function clamp(value, { lower, upper }) {
  return Math.min(Math.max(value, lower), upper);
}

function degrees(radians) {
  return `${fixed((radians * 180) / Math.PI, 0)}\u00b0`;
}

// lf_haa of leg lf -> HAA
function short({ name, leg }) {
  const rest = (name.toLowerCase().startsWith(leg.toLowerCase()) ? name.slice(leg.length) : name).replace(/^[_-]+/, "").replace(/_joint$/, "") || name;
  return rest.length <= 4 ? rest.toUpperCase() : rest;
}
