// What is around the robot: light, ground with a grid that fades into the sky, shadow.

import * as THREE from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";

const SUN = new THREE.Vector3(1.4, -1.9, 3.6).normalize(); // from where
const SHADOW = 1024; // pixels

const groundShader = {
  vertexShader: `
    varying vec2 place;
    varying vec3 world;
    void main() {
      place = position.xy;
      vec4 there = modelMatrix * vec4(position, 1.0);
      world = there.xyz;
      gl_Position = projectionMatrix * viewMatrix * there;
    }`,
  fragmentShader: `
    uniform vec3 ground, line;
    uniform float cell, radius;
    uniform vec2 centre;
    varying vec2 place;
    varying vec3 world;
    float grid(float size, float width) {
      vec2 at = place / size;
      vec2 step = fwidth(at);
      vec2 away = abs(fract(at - 0.5) - 0.5) / max(step, 1e-6);
      vec2 lines = clamp(width - away, 0.0, 1.0) * clamp(1.0 - 2.5 * step, 0.0, 1.0);
      return max(lines.x, lines.y);
    }
    void main() {
      float far = length(place - centre) / radius;
      float lines = max(0.45 * grid(cell, 1.1), grid(2.0 * cell, 1.3));
      vec3 colour = mix(ground, line, lines);
      float shown = 1.0 - smoothstep(0.25, 1.0, far);
      gl_FragColor = vec4(colour, shown);
      #include <colorspace_fragment>
    }`,
};

export class Stage {
  constructor(renderer) {
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color();
    const generator = new THREE.PMREMGenerator(renderer);
    const room = new RoomEnvironment();
    this.environment = generator.fromScene(room, 0.04);
    this.scene.environment = this.environment.texture;
    room.dispose();
    generator.dispose();

    this.sun = new THREE.DirectionalLight(0xffffff, 2);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(SHADOW, SHADOW);
    this.sun.shadow.radius = 4;
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.012;
    this.rim = new THREE.DirectionalLight(0xffffff, 0.6);
    this.scene.add(this.sun, this.sun.target, this.rim, this.rim.target);

    this.ground = new THREE.Group();
    this.scene.add(this.ground);
    this.look = new THREE.ShaderMaterial({
      ...groundShader,
      uniforms: {
        ground: { value: new THREE.Color() },
        line: { value: new THREE.Color() },
        cell: { value: 0.5 },
        radius: { value: 5 },
        centre: { value: new THREE.Vector2() },
      },
      transparent: true,
      depthWrite: false,
    });
    this.shade = new THREE.ShadowMaterial({ transparent: true, depthWrite: false });
    this.shade.polygonOffset = true;
    this.shade.polygonOffsetFactor = -1;
  }

  // The scene's planes; size: of the robot [m]; reach: of the motion [m]; middle: of it.
  setGround(planes, size, reach, middle) {
    this.clearGround();
    const cell = niceBelow(size / 2);
    const radius = Math.max(6 * size, 1.5 * reach + 3 * size);
    this.look.uniforms.cell.value = cell;
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
      const shade = new THREE.Mesh(geometry, this.shade);
      look.renderOrder = -2;
      shade.renderOrder = -1;
      shade.receiveShadow = true;
      place.add(look, shade);
      this.ground.add(place);
    }
    const half = 1.1 * size;
    const camera = this.sun.shadow.camera;
    Object.assign(camera, { left: -half, right: half, top: half, bottom: -half, near: 0.1, far: 8 * size });
    camera.updateProjectionMatrix();
    this.size = size;
  }

  clearGround() {
    this.ground.traverse((object) => object.geometry?.dispose());
    this.ground.clear();
  }

  // Keeps the sun, and with it the shadow's sharp part, over the robot.
  follow(place) {
    this.sun.target.position.copy(place);
    this.sun.position.copy(place).addScaledVector(SUN, 4 * this.size);
    this.rim.target.position.copy(place);
    this.rim.position.set(place.x - 2 * this.size, place.y + 2.2 * this.size, place.z + 1.2 * this.size);
  }

  setTheme(palette, dark) {
    this.scene.background.set(palette.sky);
    this.look.uniforms.ground.value.set(palette.ground);
    this.look.uniforms.line.value.set(palette.ground_line);
    this.shade.opacity = dark ? 0.5 : 0.28;
    this.sun.intensity = dark ? 2.2 : 2.2;
    this.rim.intensity = dark ? 1.4 : 0.6;
    this.scene.environmentIntensity = dark ? 0.75 : 0.7;
  }

  dispose() {
    this.clearGround();
    this.look.dispose();
    this.shade.dispose();
    this.environment.dispose();
    this.sun.dispose();
    this.rim.dispose();
  }
}

// The largest of 1, 2, 5 times a power of ten that is not above a length.
export function niceBelow(length) {
  const decade = 10 ** Math.floor(Math.log10(length));
  return decade * [5, 2, 1].find((step) => step * decade <= length * 1.0001);
}
