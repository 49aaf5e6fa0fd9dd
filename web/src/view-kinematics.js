// Where a robot's bodies are at given joint angles: createKinematics(tree) -> {pose(trunk, angles), position, quaternion}. tree: as in
// levade.viewer.still, parents before children. The trunk stays level; angles in rad, in the robot's joint order.

import { Quaternion, Vector3 } from "three";

export function createKinematics(tree) {
  const bodies = tree.map((body) => ({
    ...body,
    pos: new Vector3(...body.pos),
    quat: new Quaternion(...body.quat),
    hinges: body.hinges.map((hinge) => ({ ...hinge, anchor: new Vector3(...hinge.anchor), axis: new Vector3(...hinge.axis) })),
    at: new Vector3(),
    turned: new Quaternion(),
  }));
  const places = bodies.filter(({ place }) => place >= 0);
  const position = new Float32Array(3 * places.length);
  const quaternion = new Float32Array(4 * places.length);
  const turn = new Quaternion();
  const arm = new Vector3();

  // trunk: (3,) [m]
  function pose(trunk, angles) {
    for (const body of bodies) {
      const parent = body.parent < 0 ? null : bodies[body.parent];
      if (body.trunk) {
        body.at.fromArray(trunk);
        body.turned.identity();
        continue;
      }
      body.at.copy(body.pos);
      body.turned.copy(body.quat);
      if (parent) {
        body.at.applyQuaternion(parent.turned).add(parent.at);
        body.turned.premultiply(parent.turned);
      }
      for (const { joint, anchor, axis, zero } of body.hinges) {
        // the anchor stays where it is
        body.at.add(arm.copy(anchor).applyQuaternion(body.turned));
        body.turned.multiply(turn.setFromAxisAngle(axis, angles[joint] - zero));
        body.at.sub(arm.copy(anchor).applyQuaternion(body.turned));
      }
    }
    for (const { place, at, turned } of places) {
      at.toArray(position, 3 * place);
      turned.toArray(quaternion, 4 * place);
    }
  }

  return { pose, position, quaternion, bodies };
}
