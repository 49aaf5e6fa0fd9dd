// The 3D player: a motion on a canvas, from a scene of levade.report.scene. It draws the canvas only; play button and
// slider belong to the page.
//
//   const player = createPlayer(element, scene, {theme: "light"});
//   player.onTime((t, playing) => ...);   // returns a function that ends it
//   player.play();
//
// Keys, anywhere but in a form: space plays and pauses, the arrows go a frame back and on (with shift, ten frames).
// Drag to turn, right drag or two fingers to move, wheel (after a click) or pinch to zoom, double click to start over.

import * as THREE from "three";
import { Clock } from "./player-clock.js";
import { locate, unpack } from "./player-data.js";
import { Forces, Goal, goalCorners, Path } from "./player-overlays.js";
import { cornersOf, Robot } from "./player-robot.js";
import { Stage } from "./player-stage.js";
import { isSoftware, Pace } from "./player-pace.js";
import { CameraView } from "./player-view.js";

const LAYERS = ["robot", "reference", "path", "forces", "goal", "collision"];
const STILL = 24; // poses of the motion that the camera makes room for
const SLIDING = 200; // ms
const LARGE = 1.5; // m: obstacles with a longer half edge need not be seen whole

export function createPlayer(element, scene, options = {}) {
  const clock = new Clock(0);
  const listeners = new Set();
  const shown = {};
  let times = new Float64Array(1);
  let picture = null;
  let theme = options.theme ?? "light";
  let frame = 0;
  let before = 0; // when the last picture was, while things move
  let drawn = -Infinity;
  let later = 0;

  const tell = () => listeners.forEach((listener) => listener(clock.time, clock.playing));

  function wake() {
    if (!frame) frame = requestAnimationFrame(step);
  }

  function step(now) {
    frame = 0;
    const passed = before ? Math.min(Math.max(now - before, 0) / 1000, 0.5) : 0;
    const moved = clock.advance(passed);
    if (moved) tell();
    // soon after another picture somebody is moving the slider: coarse now, fine when that is over
    const sliding = now - drawn < SLIDING && !clock.playing;
    drawn = now;
    const gliding = picture?.draw(clock.time, clock.playing || sliding, passed) ?? false;
    before = clock.playing || gliding ? now : 0;
    if (before) wake();
    clearTimeout(later);
    if (!before && picture?.coarse) later = setTimeout(wake, SLIDING + 20);
  }

  try {
    picture = new Picture(element, wake);
  } catch (error) {
    const note = document.createElement("p");
    note.textContent = "No 3D picture: this browser has no WebGL, or it is turned off.";
    note.className = "player-note";
    note.style.padding = "2em";
    element.append(note);
    console.warn(`player: ${error.message}`);
  }

  function update(next) {
    scene = { ...scene, ...next };
    times = Float64Array.from(unpack(scene.motion.time), (time) => Math.round(time * 1e6) / 1e6); // 0.3, not 0.30000001
    clock.duration = times[times.length - 1];
    clock.time = Math.min(clock.time, clock.duration);
    for (const { name, shown: visible } of scene.layers) shown[name] ??= visible;
    picture?.setScene(scene, times, shown, theme);
    tell();
    wake();
  }

  const player = {
    get duration() {
      return clock.duration;
    },
    get time() {
      return clock.time;
    },
    get playing() {
      return clock.playing;
    },
    get speed() {
      return clock.speed;
    },
    get layers() {
      return scene.layers.map((layer) => ({ ...layer, shown: Boolean(shown[layer.name]) }));
    },
    seek(t) {
      clock.seek(t);
      tell();
      wake();
    },
    play() {
      if (clock.playing) return;
      clock.play();
      before = performance.now();
      tell();
      wake();
    },
    pause() {
      if (!clock.playing) return;
      clock.playing = false;
      tell();
      wake();
    },
    setSpeed(speed) {
      if (speed > 0) clock.speed = speed;
    },
    setLoop(loop) {
      clock.loop = Boolean(loop);
    },
    setFollow(follow) {
      picture?.setFollow(Boolean(follow));
      wake();
    },
    setVisible(layer, visible) {
      if (!LAYERS.includes(layer)) throw new RangeError(`layer ${layer}: one of ${LAYERS.join(", ")}`);
      shown[layer] = Boolean(visible);
      picture?.setShown(shown);
      wake();
    },
    setTheme(name) {
      theme = name;
      picture?.setTheme(scene.palette[theme], theme === "dark");
      wake();
    },
    resetView() {
      picture?.view.reset();
      wake();
    },
    resize() {
      picture?.resize();
      wake();
    },
    onTime(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
    // a frame on or back
    stepBy(frames) {
      const { row, share } = locate(times, clock.time);
      const from = frames < 0 && share > 1e-3 ? row + 1 : row;
      clock.playing = false;
      player.seek(times[Math.min(Math.max(from + frames, 0), times.length - 1)]);
    },
    update,
    // Poses the bodies as the motion does not have them, until the next update: (bodies, 3) and (bodies, 4) x-y-z-w, flat.
    pose(position, quaternion) {
      picture?.setPose(position, quaternion);
      wake();
    },
    // Puts an object on a body, or at -1 into the world, for as long as the shapes stay; returns what draws it anew.
    attach(body, object) {
      (body < 0 ? picture?.stage.scene : picture?.robot.bodies[body])?.add(object);
      const changed = () => {
        picture?.redraw();
        wake();
      };
      changed();
      return changed;
    },
    dispose() {
      cancelAnimationFrame(frame);
      clearTimeout(later);
      document.removeEventListener("keydown", onKey);
      listeners.clear();
      picture?.dispose();
      element.replaceChildren();
    },
  };

  function onKey(event) {
    const elsewhere = event.target instanceof Element && event.target.closest(TAKES_KEYS);
    if (elsewhere || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === " ") clock.playing ? player.pause() : player.play();
    else if (event.key === "ArrowLeft") player.stepBy(event.shiftKey ? -10 : -1);
    else if (event.key === "ArrowRight") player.stepBy(event.shiftKey ? 10 : 1);
    else return;
    event.preventDefault();
  }
  if (options.keys !== false) document.addEventListener("keydown", onKey);

  update({});
  return player;
}

const TAKES_KEYS = "input, textarea, select, button, a, summary, audio, video, [contenteditable], [role=slider]";

// The canvas and what is on it. Throws where there is no WebGL.
class Picture {
  constructor(element, wake) {
    this.element = element;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, powerPreference: "low-power" });
    const { renderer } = this;
    renderer.toneMapping = THREE.NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFShadowMap;
    renderer.shadowMap.autoUpdate = false;
    const canvas = renderer.domElement;
    Object.assign(canvas.style, { display: "block", width: "100%", height: "100%", outline: "none" });
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "the motion in 3D");
    element.append(canvas);
    this.stage = new Stage();
    this.view = new CameraView(canvas, wake);
    canvas.addEventListener("dblclick", () => {
      this.view.reset();
      wake();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.time = null;
      wake();
    });
    this.observer = new ResizeObserver(() => {
      this.resize();
      wake();
    });
    this.observer.observe(element);
    this.overlays = [];
    this.pace = new Pace(isSoftware(renderer.getContext()));
    this.follow = false;
    this.trunk = new THREE.Vector3();
    this.resize();
  }

  setScene(scene, times, shown, theme) {
    const { stage } = this;
    this.times = times;
    this.time = null;
    const same = this.robot?.key === scene.model.key;
    if (!same) {
      this.robot?.dispose();
      this.robot = new Robot(scene.model);
      stage.scene.add(...this.robot.objects);
    }
    this.robot.setMotion(scene.motion);
    for (const overlay of this.overlays) {
      stage.scene.remove(overlay.group);
      overlay.dispose();
    }
    const points = this.subject(scene);
    const { size, reach, middle } = measured(points, this.robot.corners());
    const { path, forces, goal } = scene.motion;
    this.path = path && new Path(path, size);
    this.forces = forces && new Forces(forces, this.robot.bodies, size);
    this.goal = goal && new Goal(goal, size);
    this.overlays = [this.path, this.forces, this.goal].filter(Boolean);
    for (const overlay of this.overlays) stage.scene.add(overlay.group);
    if (!same) {
      const planes = scene.model.geoms.filter((geom) => geom.layer === "ground");
      stage.setGround(planes, size, reach, middle);
      this.view.setSubject(points, scene.camera);
    } else this.view.keepInSight(points);
    this.setTheme(scene.palette[theme], theme === "dark");
    this.setShown(shown);
  }

  setPose(position, quaternion) {
    this.robot.hold(position, quaternion);
    this.time = null;
  }

  redraw() {
    this.time = null;
  }

  // Points that should be seen: the robot on its way, what it may touch, where it should get.
  subject(scene) {
    const points = [];
    const last = this.times.length - 1;
    for (let i = 0; i < STILL; i += 1) {
      this.robot.at({ row: Math.round((last * i) / (STILL - 1)), share: 0 });
      points.push(...this.robot.corners());
    }
    if (scene.motion.goal) points.push(...goalCorners(scene.motion.goal));
    for (const box of this.robot.obstacles) {
      const half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
      if (Math.max(half.x, half.y, half.z) < LARGE) points.push(...cornersOf(box));
    }
    return points;
  }

  setShown(shown) {
    this.robot.setShown(shown);
    for (const name of ["path", "forces", "goal"]) if (this[name]) this[name].group.visible = Boolean(shown[name]);
    this.time = null;
  }

  setTheme(palette, dark) {
    this.stage.setTheme(palette, dark);
    this.robot.setTheme(palette);
    for (const overlay of this.overlays) overlay.setTheme(palette);
  }

  setFollow(follow) {
    this.follow = follow;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.pace.ratio);
    this.renderer.setSize(width, height, false);
    this.view.resize(width / height);
  }

  get coarse() {
    return this.renderer.getPixelRatio() < this.pace.finest;
  }

  // Draws the motion at a time; true while the view is still gliding. passed: since the picture before [s], or 0.
  draw(time, playing, passed) {
    const gliding = this.view.update();
    const ratio = this.pace.next(passed, playing || gliding);
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
    if (time !== this.time) {
      const where = locate(this.times, time);
      this.robot.at(where);
      this.path?.at(where);
      this.forces?.at(where);
      const trunk = this.robot.bodies[0]?.position ?? this.trunk;
      if (this.follow && this.time !== null) this.view.shift(trunk.clone().sub(this.trunk));
      this.trunk.copy(trunk);
      this.stage.follow(this.trunk);
      this.renderer.shadowMap.needsUpdate = true;
      this.time = time;
    }
    this.goal?.face(this.view.camera);
    this.renderer.render(this.stage.scene, this.view.camera);
    return gliding;
  }

  dispose() {
    this.observer.disconnect();
    this.robot?.dispose();
    for (const overlay of this.overlays) overlay.dispose();
    this.stage.dispose();
    this.view.dispose();
    this.renderer.dispose();
  }
}

// Size of the robot and of its whole way [m], and the middle of that.
function measured(points, robot) {
  const all = new THREE.Box3().setFromPoints(points);
  const one = new THREE.Box3().setFromPoints(robot);
  return {
    size: one.getSize(new THREE.Vector3()).length() / 1.2,
    reach: all.getSize(new THREE.Vector3()).length(),
    middle: all.getCenter(new THREE.Vector3()),
  };
}
