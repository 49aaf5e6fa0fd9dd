// Triangles of the scene's shapes (levade.report.shapes), merged: one mesh for each body and material.

import * as THREE from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { mergeGeometries, mergeVertices, toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { unpack } from "./player-data.js";

const FINEST = 28; // corners of a circle; a multiple of 4
const CREASE = 0.6; // rad: a mesh's edges sharper than this stay sharp
const LARGE = 1e3; // m: half edge of a plane without end

// Merged geometries of the geoms of some layers, in their bodies' frames: {body, material, geometry}, each pair once.
export function mergedShapes(model, layers) {
  const parts = new Map();
  for (const geom of model.geoms) {
    if (!layers.includes(geom.layer)) continue;
    const key = `${geom.body} ${geom.material}`;
    if (!parts.has(key)) parts.set(key, { ...geom, geometries: [] });
    parts.get(key).geometries.push(placed(geom, model.meshes));
  }
  return [...parts.values()].map(({ body, material, geometries }) => {
    const geometry = mergeGeometries(geometries);
    for (const one of geometries) one.dispose();
    return { body, material, geometry };
  });
}

function placed(geom, meshes) {
  const made = shape(geom, meshes);
  for (const name of Object.keys(made.attributes)) {
    if (name !== "position" && name !== "normal") made.deleteAttribute(name);
  }
  const geometry = made.index ? made : mergeVertices(made);
  const pose = new THREE.Matrix4().compose(
    new THREE.Vector3(...geom.pos),
    new THREE.Quaternion(...geom.quat),
    new THREE.Vector3(1, 1, 1),
  );
  return geometry.applyMatrix4(pose);
}

function shape(geom, meshes) {
  const [a, b, c] = geom.size;
  const round = corners(a);
  if (geom.type === "sphere") return new THREE.SphereGeometry(a, round, round / 2);
  if (geom.type === "ellipsoid") return new THREE.SphereGeometry(1, FINEST, FINEST / 2).scale(a, b, c);
  if (geom.type === "capsule") return new THREE.CapsuleGeometry(a, 2 * b, Math.round(round / 5), round).rotateX(Math.PI / 2);
  if (geom.type === "cylinder") return cylinder(a, b);
  if (geom.type === "box") return box(a, b, c);
  if (geom.type === "plane") return new THREE.PlaneGeometry(2 * (a || LARGE), 2 * (b || LARGE));
  return mesh(meshes[geom.mesh]);
}

// Of a circle of some radius [m]: fewer where nobody could tell.
function corners(radius) {
  return radius > 0.05 ? FINEST : radius > 0.03 ? 20 : radius > 0.012 ? 16 : 12;
}

// With a slight bevel: edges that catch the light look solid.
function cylinder(radius, half) {
  const bevel = Math.min(0.16 * radius, 0.3 * half, 0.006);
  const ring = (angle) => [radius - bevel * (1 - Math.sin(angle)), half - bevel * (1 - Math.cos(angle))];
  const slant = Math.PI / 4;
  // radius, height, and the normal's angle from the axis: flat, round the edge, along the side
  const upper = [[0, half, 0], [...ring(0), 0], [...ring(slant), slant], [...ring(2 * slant), 2 * slant]];
  const outline = [...upper, ...upper.map(([r, z, angle]) => [r, -z, Math.PI - angle]).reverse()];
  const round = corners(radius);
  const position = [];
  const normal = [];
  const index = [];
  const n = outline.length;
  for (let i = 0; i <= round; i += 1) {
    const [x, y] = [Math.cos((2 * Math.PI * i) / round), Math.sin((2 * Math.PI * i) / round)];
    outline.forEach(([r, z, angle], k) => {
      position.push(r * x, r * y, z);
      normal.push(Math.sin(angle) * x, Math.sin(angle) * y, Math.cos(angle));
      if (i === round || k === n - 1) return;
      const here = i * n + k;
      index.push(here, here + 1, here + n, here + n, here + 1, here + n + 1);
    });
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
  return geometry.setIndex(index);
}

function box(a, b, c) {
  const bevel = Math.min(0.3 * Math.min(a, b, c), 0.008);
  return new RoundedBoxGeometry(2 * a, 2 * b, 2 * c, 1, bevel);
}

function mesh(packed) {
  const corners = unpack(packed.vertices);
  const position = new Float32Array(corners.length);
  for (let i = 0; i < corners.length; i += 1) position[i] = packed.low[i % 3] + packed.scale[i % 3] * corners[i];
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setIndex(new THREE.BufferAttribute(unpack(packed.faces), 1));
  return toCreasedNormals(geometry, CREASE);
}
