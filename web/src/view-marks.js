// What can be pinned to a robot's bodies: names of the feet, axes of the joints, and the range of one joint as a fan.

import * as THREE from "three";

const HIGH = 0.055; // of a name, as a share of the robot's size
const TURN = 2 * Math.PI;
const STEP = 0.05; // rad between the fan's corners

// A name over each foot: {objects: [{body, object}], setTheme}
export function createNames(feet, size, colours) {
  const names = feet.map(({ leg, body, centre }, k) => {
    const canvas = document.createElement("canvas");
    const texture = new THREE.CanvasTexture(canvas);
    texture.colorSpace = THREE.SRGBColorSpace;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, depthTest: false, transparent: true, toneMapped: false }));
    sprite.position.fromArray(centre);
    sprite.center.set(0.5, -0.35);
    sprite.renderOrder = 40;
    const draw = (palette) => {
      const text = leg.toUpperCase();
      const context = canvas.getContext("2d");
      context.font = "600 56px sans-serif";
      canvas.width = Math.ceil(context.measureText(text).width) + 56;
      canvas.height = 88;
      context.font = "600 56px sans-serif";
      context.fillStyle = colours(palette)[k];
      context.beginPath();
      context.roundRect(0, 0, canvas.width, canvas.height, 44);
      context.fill();
      context.fillStyle = light(colours(palette)[k]) ? "#14171a" : "#ffffff";
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.fillText(text, canvas.width / 2, canvas.height / 2 + 3);
      sprite.scale.set((HIGH * size * canvas.width) / canvas.height, HIGH * size, 1);
      texture.dispose();
      texture.needsUpdate = true;
    };
    return { body, object: sprite, draw };
  });
  return { objects: names, setTheme: (palette) => names.forEach(({ draw }) => draw(palette)) };
}

// A thin rod along each joint's axis.
export function createAxes(bodies, size, colours) {
  const rods = [];
  for (const { place, hinges } of bodies) {
    for (const { joint, anchor, axis } of place < 0 ? [] : hinges) {
      const material = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9, toneMapped: false });
      const rod = new THREE.Mesh(new THREE.CylinderGeometry(0.006 * size, 0.006 * size, 0.22 * size, 12), material);
      rod.position.copy(anchor);
      rod.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.clone().normalize());
      rod.renderOrder = 35;
      rods.push({ body: place, object: rod, joint });
    }
  }
  return { objects: rods, setTheme: (palette) => rods.forEach(({ object, joint }) => object.material.color.set(colours(palette)[joint])) };
}

// The range of a joint, around its axis, with a line where the limb is: {group, show(joint, angle, limits), hide, setTheme}
export function createFan(bodies, size) {
  const group = new THREE.Group();
  const radius = 0.26 * size;
  const look = { depthTest: false, transparent: true, side: THREE.DoubleSide, toneMapped: false };
  const inside = new THREE.MeshBasicMaterial({ ...look, opacity: 0.28 });
  const edge = new THREE.LineBasicMaterial({ depthTest: false, transparent: true });
  const fan = new THREE.Mesh(new THREE.BufferGeometry(), inside);
  const rim = new THREE.LineLoop(new THREE.BufferGeometry(), edge);
  const needle = new THREE.Line(new THREE.BufferGeometry(), edge);
  group.add(fan, rim, needle);
  group.children.forEach((part, k) => { part.renderOrder = 36 + k; part.frustumCulled = false; });
  group.visible = false;

  function show(joint, angle, lower, upper, tip) {
    const body = bodies.find(({ hinges }) => hinges.some((hinge) => hinge.joint === joint));
    if (!body) return;
    const hinge = body.hinges.find((one) => one.joint === joint);
    const axis = hinge.axis.clone().normalize();
    const child = bodies.find(({ parent }) => bodies[parent] === body);
    const along = (child ? child.pos.clone() : new THREE.Vector3(...tip)).sub(hinge.anchor);
    along.addScaledVector(axis, -along.dot(axis));
    if (along.lengthSq() < 1e-9) along.set(axis.z, axis.x, axis.y).cross(axis);
    along.setLength(radius);
    // in the world, where the limb is now; the range is around that
    const place = hinge.anchor.clone().applyQuaternion(body.turned).add(body.at);
    const spin = axis.clone().applyQuaternion(body.turned);
    const limb = along.applyQuaternion(body.turned);
    const from = lower === null ? -Math.PI : lower, to = upper === null ? Math.PI : upper;
    const turned = (q) => limb.clone().applyAxisAngle(spin, q - angle);
    const count = Math.max(2, Math.ceil(Math.min(to - from, TURN) / STEP));
    const arc = Array.from({ length: count + 1 }, (_, k) => turned(from + ((to - from) * k) / count));
    const corners = [];
    for (let k = 0; k < count; k += 1) corners.push(new THREE.Vector3(), arc[k], arc[k + 1]);
    rim.geometry.dispose();
    rim.geometry = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), ...arc]);
    fan.geometry.dispose();
    fan.geometry = new THREE.BufferGeometry().setFromPoints(corners);
    needle.geometry.dispose();
    needle.geometry = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), limb.clone().multiplyScalar(1.18)]);
    group.position.copy(place);
    group.visible = true;
  }

  return {
    group,
    show,
    hide() { group.visible = false; },
    setTheme(palette) { inside.color.set(palette.limit); edge.color.set(palette.limit); },
  };
}

// Whether black is easier to read on a colour, "#rrggbb", than white.
function light(colour) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
  return 0.299 * r + 0.587 * g + 0.114 * b > 0.55;
}
