// What is around the robot: light, and ground with a grid that fades into the sky and takes the shadow.

import * as THREE from "three";
import { groundShader, outline, studio } from "./player-shaders.js";

const SUN = new THREE.Vector3(1.3, -1.7, 3.4).normalize(); // from where
const SHADOW = 1024; // pixels

export class Stage {
  constructor() {
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color();
    this.sun = new THREE.DirectionalLight(0xffffff, 2.2);
    this.sun.castShadow = true;
    const { shadow } = this.sun;
    shadow.mapSize.set(SHADOW, SHADOW);
    Object.assign(shadow, { radius: 2, bias: -0.0006, normalBias: 0.01 });
    this.scene.add(this.sun, this.sun.target);

    this.ground = new THREE.Group();
    this.scene.add(this.ground);
    const own = {
      ground: { value: new THREE.Color() },
      line: { value: new THREE.Color() },
      shade: { value: 0.3 },
      cell: { value: 0.5 },
      radius: { value: 5 },
      centre: { value: new THREE.Vector2() },
    };
    this.look = new THREE.ShaderMaterial({
      ...groundShader,
      uniforms: { ...THREE.UniformsUtils.clone(THREE.UniformsLib.lights), ...own },
      lights: true,
      transparent: true,
      depthWrite: false,
    });
  }

  // The scene's planes; size: of the robot [m]; reach: of the motion [m]; middle: of it.
  setGround(planes, size, reach, middle) {
    this.clearGround();
    this.size = size;
    const radius = Math.max(6 * size, 1.5 * reach + 3 * size);
    this.look.uniforms.cell.value = niceBelow(size / 2);
    this.look.uniforms.radius.value = radius;
    for (const plane of planes) {
      const place = new THREE.Group();
      place.position.fromArray(plane.pos);
      place.quaternion.fromArray(plane.quat);
      place.updateMatrixWorld();
      const centre = place.worldToLocal(middle.clone());
      this.look.uniforms.centre.value.set(centre.x, centre.y);
      const [a, b] = plane.size;
      const geometry = new THREE.PlaneGeometry(a ? 2 * a : 2 * radius, b ? 2 * b : 2 * radius);
      geometry.translate(a ? 0 : centre.x, b ? 0 : centre.y, 0);
      const look = new THREE.Mesh(geometry, this.look);
      look.renderOrder = -1;
      look.receiveShadow = true;
      place.add(look);
      this.ground.add(place);
    }
    const half = 1.15 * size;
    const { camera } = this.sun.shadow;
    Object.assign(camera, { left: -half, right: half, top: half, bottom: -half, near: 0.5 * size, far: 8 * size });
    camera.updateProjectionMatrix();
  }

  clearGround() {
    this.ground.traverse((object) => object.geometry?.dispose());
    this.ground.clear();
  }

  // Keeps the sun, and with it the shadow's sharp part, over the robot.
  follow(place) {
    this.sun.target.position.copy(place);
    this.sun.position.copy(place).addScaledVector(SUN, 4 * this.size);
  }

  setTheme(palette, dark) {
    this.scene.background.set(palette.sky);
    this.look.uniforms.ground.value.set(palette.ground);
    this.look.uniforms.line.value.set(palette.ground_line);
    this.look.uniforms.shade.value = dark ? 0.62 : 0.34;
    studio.value = dark ? 0.8 : 0.7;
    outline.value = dark ? 0.32 : 0.05;
  }

  dispose() {
    this.clearGround();
    this.look.dispose();
    this.sun.dispose();
  }
}

// The largest of 1, 2, 5 times a power of ten that is not above a length.
export function niceBelow(length) {
  const decade = 10 ** Math.floor(Math.log10(length));
  return decade * [5, 2, 1].find((step) => step * decade <= length * 1.0001);
}
