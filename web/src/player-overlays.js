// What is drawn over the robot: ghosts, the path, forces, the goal. Each is a group that can be hidden.

import * as THREE from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { Track, unpack } from "./player-data.js";
import { ghostShader } from "./player-shaders.js";

const UP = new THREE.Vector3(0, 1, 0);

// A translucent skin: hardly there where it faces the reader, clear at its outline.
export class Ghost {
  constructor(strength = 1) {
    this.skin = new THREE.ShaderMaterial({
      ...ghostShader,
      uniforms: { colour: { value: new THREE.Color() }, strength: { value: strength } },
      transparent: true,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    });
    // first only its depth, so that what is inside does not shine through
    this.depth = new THREE.MeshBasicMaterial({
      colorWrite: false,
      transparent: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    });
  }

  meshes(geometry, order) {
    return [this.depth, this.skin].map((material, i) => {
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = order + i;
      return mesh;
    });
  }

  setColour(colour) {
    this.skin.uniforms.colour.value.set(colour);
  }

  dispose() {
    this.skin.dispose();
    this.depth.dispose();
  }
}

// The way of the trunk's centre of mass: thin as a whole, thick up to now, and a dot.
export class Path {
  constructor(packed, size) {
    this.group = new THREE.Group();
    this.points = new Track(unpack(packed), 3);
    this.here = new Float32Array(3);
    const behind = { depthTest: false, transparent: true };
    this.whole = new LineMaterial({ linewidth: 1.5, opacity: 0.75, ...behind });
    this.done = new LineMaterial({ linewidth: 3.5, ...behind });
    this.dot = new THREE.MeshBasicMaterial(behind);
    const points = Array.from(this.points.values);
    if (this.points.rows > 1) {
      this.line = new Line2(new LineGeometry().setPositions(points), this.done);
      this.add(new Line2(new LineGeometry().setPositions(points), this.whole), 20);
      this.add(this.line, 21);
    }
    this.mark = new THREE.Mesh(new THREE.SphereGeometry(0.013 * size, 20, 14), this.dot);
    this.add(this.mark, 22);
  }

  add(object, order) {
    object.renderOrder = order;
    object.frustumCulled = false;
    this.group.add(object);
  }

  at(where) {
    this.mark.position.fromArray(this.points.at(where, 0, this.here));
    if (this.line) {
      this.line.visible = where.row > 0;
      this.line.geometry.instanceCount = Math.min(where.row, this.points.rows - 1);
    }
  }

  setTheme(palette) {
    this.whole.color.set(palette.muted);
    this.done.color.set(palette.accent);
    this.dot.color.set(palette.accent);
  }

  dispose() {
    disposeOf(this.group);
  }
}

// An arrow on each foot, from where it touches, in the colour of its leg.
export class Forces {
  constructor(packed, bodies, size) {
    this.group = new THREE.Group();
    this.feet = packed.feet;
    this.bodies = bodies;
    this.force = new Track(unpack(packed.force), 3 * this.feet.length);
    this.here = new Float32Array(3);
    this.perMetre = packed.scale;
    this.longest = packed.longest ?? Infinity;
    this.least = 0.01 * size;
    this.head = 0.055 * size;
    const shaft = new THREE.CylinderGeometry(0.0085 * size, 0.0085 * size, 1, 16).translate(0, 0.5, 0);
    const head = new THREE.ConeGeometry(0.024 * size, this.head, 20).translate(0, -0.5 * this.head, 0);
    this.arrows = this.feet.map((_, i) => {
      const material = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 1 });
      const arrow = new THREE.Group();
      arrow.add(new THREE.Mesh(shaft, material), new THREE.Mesh(head, material), new THREE.Mesh(head, material));
      for (const part of arrow.children) part.renderOrder = 30 + i;
      this.group.add(arrow);
      return arrow;
    });
  }

  at(where) {
    this.feet.forEach((foot, i) => {
      const arrow = this.arrows[i];
      const force = vector.fromArray(this.force.at(where, i, this.here));
      const whole = force.length() / this.perMetre;
      const length = Math.min(whole, this.longest);
      arrow.visible = length > this.least;
      if (!arrow.visible) return;
      force.normalize();
      arrow.quaternion.setFromUnitVectors(UP, force);
      const body = this.bodies[foot.body];
      arrow.position.fromArray(foot.centre).applyQuaternion(body.quaternion).add(body.position);
      arrow.position.addScaledVector(force, -foot.radius);
      const [shaft, head, second] = arrow.children;
      const shrink = Math.min(1, length / (2.5 * this.head)); // short ones are small all over
      shaft.scale.set(shrink, Math.max(length - this.head * shrink, 1e-4), shrink);
      head.scale.setScalar(shrink);
      head.position.y = length;
      second.visible = whole > this.longest; // there is more than fits
      second.position.y = length - 0.8 * this.head;
    });
  }

  setTheme(palette) {
    this.arrows.forEach((arrow, i) => arrow.children[0].material.color.set(palette.legs[i % palette.legs.length]));
  }

  dispose() {
    disposeOf(this.group);
  }
}

// Where the trunk should be at the horizon: a dashed box, and its centre of mass over the ground.
export class Goal {
  constructor(goal, size) {
    this.group = new THREE.Group();
    const [a, b, c] = goal.half;
    const frame = new THREE.BoxGeometry(2 * a, 2 * b, 2 * c);
    const edges = new THREE.EdgesGeometry(frame);
    const dashes = { linewidth: 2, dashed: true, dashSize: 0.035 * size, gapSize: 0.022 * size, transparent: true };
    this.outline = new LineMaterial(dashes);
    const box = new LineSegments2(new LineSegmentsGeometry().fromEdgesGeometry(edges), this.outline);
    box.position.fromArray(goal.box);
    box.quaternion.fromArray(goal.quaternion);
    box.computeLineDistances();
    box.renderOrder = 15;
    frame.dispose();
    edges.dispose();
    this.fill = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
    const ring = new THREE.Mesh(new THREE.TorusGeometry(0.026 * size, 0.0045 * size, 10, 36), this.fill);
    ring.position.fromArray(goal.centre);
    ring.renderOrder = 23;
    this.ring = ring;
    this.group.add(box, ring);
  }

  // the ring always faces the reader
  face(camera) {
    this.ring.quaternion.copy(camera.quaternion);
  }

  setTheme(palette) {
    this.outline.color.set(palette.goal);
    this.fill.color.set(palette.goal);
  }

  dispose() {
    disposeOf(this.group);
  }
}

export function goalCorners({ box, half, quaternion }) {
  const turn = new THREE.Quaternion(...quaternion);
  return Array.from({ length: 8 }, (_, i) =>
    new THREE.Vector3(...half.map((length, axis) => (i & (1 << axis) ? length : -length)))
      .applyQuaternion(turn)
      .add(vector.fromArray(box)),
  );
}

export function disposeOf(group) {
  group.traverse((object) => {
    object.geometry?.dispose();
    object.material?.dispose();
  });
  group.clear();
}

const vector = new THREE.Vector3();
