// The robot and the obstacles as objects of the stage: built once from the model, posed as often as need be.

import * as THREE from "three";
import { Poses } from "./player-data.js";
import { disposeOf, Ghost } from "./player-overlays.js";
import { solid } from "./player-shaders.js";
import { mergedShapes } from "./player-shapes.js";

export class Robot {
  constructor(model) {
    this.model = model;
    this.key = model.key;
    this.bodies = model.bodies.map(() => new THREE.Group());
    this.robot = new THREE.Group().add(...this.bodies);
    this.scenery = new THREE.Group();
    this.materials = model.materials.map(solid);
    this.boxes = this.bodies.map(() => new THREE.Box3());
    this.obstacles = [];
    this.reference = new Ghosts(this.bodies.length, 1, 4);
    this.collision = new Ghosts(this.bodies.length, 0.8, 8);
    for (const { body, material, geometry } of mergedShapes(model, ["robot", "scene"])) {
      const mesh = new THREE.Mesh(geometry, this.materials[material]);
      mesh.castShadow = mesh.receiveShadow = true;
      (body < 0 ? this.scenery : this.bodies[body]).add(mesh);
      geometry.computeBoundingBox();
      if (body < 0) this.obstacles.push(geometry.boundingBox);
      else this.boxes[body].union(geometry.boundingBox);
      if (body >= 0) this.reference.add(body, geometry);
    }
  }

  get objects() {
    return [this.robot, this.scenery, this.reference.group, this.collision.group];
  }

  setMotion(motion) {
    this.poses = new Poses(motion, this.bodies.length);
    this.wanted = motion.reference && new Poses(motion.reference, motion.reference.bodies.length);
    this.legs = motion.reference?.bodies ?? [];
    // a ghost of what has no reference of its own would only flicker on the robot
    this.reference.bodies.forEach((body, i) => (body.visible = this.legs.includes(i)));
  }

  // one pose, whatever the time
  hold(position, quaternion) {
    this.poses = {
      apply: (where, place, object) => {
        object.position.fromArray(position, 3 * place);
        object.quaternion.fromArray(quaternion, 4 * place);
      },
    };
  }

  setShown(shown) {
    this.robot.visible = Boolean(shown.robot);
    this.reference.group.visible = Boolean(shown.reference);
    this.collision.group.visible = Boolean(shown.collision);
    if (!shown.collision || this.collision.filled) return;
    for (const { body, geometry } of mergedShapes(this.model, ["collision"])) this.collision.add(body, geometry);
  }

  at(where) {
    this.bodies.forEach((body, i) => {
      this.poses.apply(where, i, body);
      this.collision.bodies[i].position.copy(body.position);
      this.collision.bodies[i].quaternion.copy(body.quaternion);
    });
    this.legs.forEach((body, i) => this.wanted.apply(where, i, this.reference.bodies[body]));
  }

  // Corners of the bodies' boxes, as they are posed now.
  corners() {
    const points = [];
    this.bodies.forEach((body, i) => {
      if (!this.boxes[i].isEmpty()) points.push(...cornersOf(this.boxes[i], body));
    });
    return points;
  }

  setTheme(palette) {
    this.reference.setColour(palette.ghost);
    this.collision.setColour(palette.limit);
  }

  dispose() {
    for (const group of this.objects) {
      disposeOf(group);
      group.removeFromParent();
    }
    for (const material of this.materials) material.dispose();
  }
}

// Bodies in a ghost's skin.
class Ghosts {
  constructor(bodies, strength, order) {
    this.ghost = new Ghost(strength);
    this.order = order;
    this.bodies = Array.from({ length: bodies }, () => new THREE.Group());
    this.group = new THREE.Group().add(...this.bodies);
    this.filled = false;
  }

  add(body, geometry) {
    this.filled = true;
    this.bodies[body].add(...this.ghost.meshes(geometry, this.order));
  }

  setColour(colour) {
    this.ghost.setColour(colour);
  }
}

export function cornersOf(box, object) {
  const points = [];
  for (let i = 0; i < 8; i += 1) {
    const corner = new THREE.Vector3(
      i & 1 ? box.max.x : box.min.x,
      i & 2 ? box.max.y : box.min.y,
      i & 4 ? box.max.z : box.min.z,
    );
    if (object) corner.applyQuaternion(object.quaternion).add(object.position);
    points.push(corner);
  }
  return points;
}
