// The camera: frames the whole motion, orbits, zooms, pans, and goes along if asked.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const MARGIN = 1.08;
const NEARER = 0.75; // of the distance: the camera comes nearer only for so much

const seen = new THREE.Vector3();

export class CameraView {
  constructor(canvas, onChange) {
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.02, 200);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = 0.497 * Math.PI;
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => (this.touched = true));
    // a finger that goes up or down scrolls the page, one that goes sideways turns the view
    canvas.style.touchAction = "pan-y";
    // the wheel scrolls the page too, until the reader has clicked into the picture
    this.controls.enableZoom = false;
    canvas.addEventListener("pointerdown", () => {
      canvas.focus({ preventScroll: true });
      this.controls.enableZoom = true;
    });
    canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
    canvas.addEventListener("wheel", (event) => event.ctrlKey && (this.controls.enableZoom = true), { capture: true });
    this.touched = false;
    this.points = [];
  }

  // points: what should be seen, THREE.Vector3; look: {azimuth, elevation, fov} in degrees, as levade's Camera has
  // them, and margin, room around the subject, as a factor
  setSubject(points, look) {
    this.points = points;
    this.look = look;
    this.camera.fov = look.fov;
    this.reset();
  }

  // another subject in the same place: the camera moves only if it has to, and never against the reader
  keepInSight(points) {
    this.points = points;
    if (this.touched) return;
    this.camera.updateMatrixWorld();
    const out = points.some((point) => {
      const { x, y } = seen.copy(point).project(this.camera);
      return Math.abs(x) > 1 || Math.abs(y) > 1;
    });
    const { position } = this.camera;
    const before = { place: position.clone(), distance: position.distanceTo(this.controls.target) };
    const target = this.controls.target.clone();
    this.reset();
    if (out || position.distanceTo(this.controls.target) < NEARER * before.distance) return;
    position.copy(before.place);
    this.controls.target.copy(target);
    this.controls.update();
  }

  resize(aspect) {
    this.camera.aspect = aspect;
    if (this.touched || !this.look) this.camera.updateProjectionMatrix();
    else this.reset();
  }

  reset() {
    this.touched = false;
    const { camera, controls } = this;
    controls.enableDamping = false; // what is left of an earlier turn is spent here
    controls.update();
    controls.enableDamping = true;
    const azimuth = THREE.MathUtils.degToRad(this.look.azimuth);
    const elevation = THREE.MathUtils.degToRad(this.look.elevation);
    const forward = new THREE.Vector3(
      Math.cos(elevation) * Math.cos(azimuth),
      Math.cos(elevation) * Math.sin(azimuth),
      Math.sin(elevation),
    );
    const right = new THREE.Vector3(Math.sin(azimuth), -Math.cos(azimuth), 0);
    const up = new THREE.Vector3().crossVectors(right, forward);
    const tangent = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) / (this.look.margin ?? MARGIN);
    // the frustum's planes touch the points: see Camera.frame in levade.report.rendering
    const place = [];
    let depth = Infinity;
    for (const [axis, slope] of [[right, tangent * camera.aspect], [up, tangent]]) {
      let high = -Infinity;
      let low = -Infinity;
      for (const point of this.points) {
        const across = point.dot(axis);
        const ahead = point.dot(forward);
        high = Math.max(high, across - slope * ahead);
        low = Math.max(low, -across - slope * ahead);
      }
      place.push((high - low) / 2);
      depth = Math.min(depth, -(high + low) / (2 * slope));
    }
    const ahead = this.points.map((point) => point.dot(forward));
    const middle = (Math.min(...ahead) + Math.max(...ahead)) / 2;
    controls.target.set(0, 0, 0).addScaledVector(right, place[0]).addScaledVector(up, place[1]);
    controls.target.addScaledVector(forward, middle);
    const distance = middle - depth;
    camera.position.copy(controls.target).addScaledVector(forward, -distance);
    camera.near = distance / 60;
    camera.far = distance * 30;
    controls.minDistance = distance / 12;
    controls.maxDistance = distance * 5;
    camera.updateProjectionMatrix();
    controls.update();
  }

  // goes along with something that moved from one place to another
  shift(by) {
    this.controls.target.add(by);
    this.camera.position.add(by);
  }

  // true while the view is still gliding
  update() {
    return this.controls.update();
  }

  dispose() {
    this.controls.dispose();
  }
}
