// Triangles of the scene's shapes (levade.report.shapes), merged: one mesh for each body and material.

import * as THREE from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { mergeGeometries, toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { unpack } from "./player-data.js";

const CREASE = 0.6; // rad: a mesh's edges sharper than this stay sharp
const LARGE = 1e3; // m: half edge of a plane without end

// A map "body material" -> merged geometry of the geoms of some layers, in their bodies' frames.
export function mergedShapes(model, layers, byMaterial = true) {
  const parts = new Map();
  for (const geom of model.geoms) {
    if (!layers.includes(geom.layer)) continue;
    const key = byMaterial ? `${geom.body} ${geom.material}` : `${geom.body} 0`;
    if (!parts.has(key)) parts.set(key, []);
    parts.get(key).push(placed(geom, model.meshes));
  }
  const merged = new Map();
  for (const [key, geometries] of parts) {
    merged.set(key, mergeGeometries(geometries));
    for (const geometry of geometries) geometry.dispose();
  }
  return merged;
}

function placed(geom, meshes) {
  const made = shape(geom, meshes);
  const geometry = made.index ? made.toNonIndexed() : made;
  if (geometry !== made) made.dispose();
  for (const name of Object.keys(geometry.attributes)) {
    if (name !== "position" && name !== "normal") geometry.deleteAttribute(name);
  }
  const pose = new THREE.Matrix4().compose(
    new THREE.Vector3(...geom.pos),
    new THREE.Quaternion(...geom.quat),
    new THREE.Vector3(1, 1, 1),
  );
  return geometry.applyMatrix4(pose);
}

function shape(geom, meshes) {
  const [a, b, c] = geom.size;
  if (geom.type === "sphere") return new THREE.SphereGeometry(a, 28, 18);
  if (geom.type === "ellipsoid") return new THREE.SphereGeometry(1, 32, 20).scale(a, b, c);
  if (geom.type === "capsule") return new THREE.CapsuleGeometry(a, 2 * b, 7, 22).rotateX(Math.PI / 2);
  if (geom.type === "cylinder") return cylinder(a, b);
  if (geom.type === "box") return box(a, b, c);
  if (geom.type === "plane") return new THREE.PlaneGeometry(2 * (a || LARGE), 2 * (b || LARGE));
  return mesh(meshes[geom.mesh]);
}

// With a slight bevel: edges that catch the light look solid.
function cylinder(radius, half) {
  const bevel = Math.min(0.16 * radius, 0.3 * half, 0.006);
  const rim = (angle) => [
    radius - bevel + bevel * Math.sin(angle),
    half - bevel + bevel * Math.cos(angle),
  ];
  const outline = [[0, half], rim(0), rim(Math.PI / 4), rim(Math.PI / 2)];
  const points = [...outline, ...outline.map(([r, z]) => [r, -z]).reverse()].map(([r, z]) => new THREE.Vector2(r, z));
  const lathe = new THREE.LatheGeometry(points.reverse(), 28).rotateX(Math.PI / 2);
  return toCreasedNormals(lathe, CREASE);
}

function box(a, b, c) {
  const bevel = Math.min(0.3 * Math.min(a, b, c), 0.008);
  return new RoundedBoxGeometry(2 * a, 2 * b, 2 * c, 2, bevel);
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
