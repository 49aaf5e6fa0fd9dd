// The robot and the obstacles as objects of the stage: built once from the model, posed as often as need be.

import * as THREE from "three";
import { Poses } from "./player-data.js";
import { disposeOf, Ghost } from "./player-overlays.js";
import { mergedShapes } from "./player-shapes.js";

export class Robot {
  constructor(model) {
    this.key = model.key;
    this.bodies = model.bodies.map(() => new THREE.Group());
    this.robot = new THREE.Group().add(...this.bodies);
    this.scenery = new THREE.Group();
    this.materials = model.materials.map((look) => {
      const { color, opacity, roughness, metalness } = look;
      return new THREE.MeshStandardMaterial({ color, opacity, roughness, metalness, transparent: opacity < 1 });
    });
    this.boxes = this.bodies.map(() => new THREE.Box3());
    this.obstacles = [];
    for (const [key, geometry] of mergedShapes(model, ["robot", "scene"])) {
      const [body, material] = key.split(" ").map(Number);
      const mesh = new THREE.Mesh(geometry, this.materials[material]);
      mesh.castShadow = mesh.receiveShadow = true;
      (body < 0 ? this.scenery : this.bodies[body]).add(mesh);
      geometry.computeBoundingBox();
      if (body < 0) this.obstacles.push(geometry.boundingBox);
      else this.boxes[body].union(geometry.boundingBox);
    }

    this.reference = this.ghosts(mergedShapes(model, ["robot"], false), 1, 4);
    this.collision = this.ghosts(mergedShapes(model, ["collision"], false), 0.8, 8);
  }

  ghosts(geometries, strength, order) {
    const ghost = new Ghost(strength);
    const group = new THREE.Group();
    const bodies = this.bodies.map(() => new THREE.Group());
    for (const [key, geometry] of geometries) {
      const body = Number(key.split(" ")[0]);
      if (body >= 0) bodies[body].add(...ghost.meshes(geometry, order));
    }
    group.add(...bodies);
    return { ghost, group, bodies };
  }

  setMotion(motion) {
    this.poses = new Poses(motion.position && motion, this.bodies.length);
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

  at(where) {
    this.bodies.forEach((body, i) => {
      this.poses.apply(where, i, body);
      this.collision.bodies[i].position.copy(body.position);
      this.collision.bodies[i].quaternion.copy(body.quaternion);
    });
    if (this.reference.group.visible) {
      this.legs.forEach((body, i) => this.wanted.apply(where, i, this.reference.bodies[body]));
    }
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
    this.reference.ghost.setColour(palette.ghost);
    this.collision.ghost.setColour(palette.limit);
  }

  dispose() {
    for (const group of [this.robot, this.scenery, this.reference.group, this.collision.group]) disposeOf(group);
    for (const material of this.materials) material.dispose();
    this.reference.ghost.dispose();
    this.collision.ghost.dispose();
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
