"""Export ``mjlab``: a reference motion for mjlab's tracking task.

mjlab 1.6.0 reads reference.npz with ``MotionLoader`` of mjlab/tasks/tracking/mdp/commands.py: joint_pos, joint_vel, body_pos_w,
body_quat_w, body_lin_vel_w, body_ang_vel_w, a row per control step. Its own mjlab/scripts/csv_to_npz.py writes the same arrays,
with ``fps``, from the entity's joint_pos, joint_vel and body_link_*_w. Hinges and bodies are in the model's order. Frames are
those of bodies, not of their centres of mass. Axes are the world's, quaternions w-x-y-z.

reference.csv is the input of csv_to_npz.py: position and quaternion x-y-z-w of the trunk, then joint angles, without a header.
"""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.exports import as_csv
from levade.exports.content import Content, held
from levade.exports.links import body_frames, frames_of, links_of

RATE = 50.0
"""Control rate of mjlab's tracking task [Hz]: four steps of 5 ms per control."""


def write(content: Content, directory: Path) -> list[str]:
    """Write reference.npz and reference.csv, and the files for playing.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    samples, model = content.samples, content.model
    names, position, velocity = _all_joints(content)
    links = links_of(model)
    bodies = body_frames(links, frames_of(links, samples))
    rate = samples.rate
    arrays = {
        "fps": np.array([int(rate) if rate == int(rate) else rate]),
        "joint_pos": position,
        "joint_vel": velocity,
        "body_pos_w": bodies.position,
        "body_quat_w": bodies.quaternion,
        "body_lin_vel_w": bodies.linear_velocity,
        "body_ang_vel_w": bodies.angular_velocity,
    }
    np.savez(
        directory / "reference.npz",
        **{name: array if name == "fps" else array.astype(np.float32) for name, array in arrays.items()},
        joint_names=np.array(names),
        body_names=np.array([link.name for link in links if link.body is not None]),
        provenance=np.array(as_csv.to_json(content.provenance)),
    )
    trunk = np.concatenate([samples.trunk_position, samples.trunk_quaternion[:, [1, 2, 3, 0]]], axis=1)
    rows = np.concatenate([trunk, position], axis=1)
    np.savetxt(directory / "reference.csv", rows, fmt="%.9g", delimiter=",")
    as_csv.write(content, directory)
    return []


def _all_joints(content: Content) -> tuple[list[str], Array, Array]:
    """Return the joints of the robot's own MJCF: names in its order, positions and velocities, shape (rows, joints).

    Joints that the simulation holds are also in mjlab's model. There they stay where they are held.
    """
    samples, model, still = content.samples, content.model, held(content.motion)
    free = [model.joint(i).name for i in range(model.njnt) if model.jnt_type[i] == mujoco.mjtJoint.mjJNT_HINGE]
    names = list(content.motion.model_joints or free)
    columns = {name: i for i, name in enumerate(samples.joints.names)}
    position, velocity = np.empty((2, len(samples.time), len(names)))
    for k, name in enumerate(names):
        position[:, k] = still[name] if name in still else samples.joint_position[:, columns[name]]
        velocity[:, k] = 0.0 if name in still else samples.joint_velocity[:, columns[name]]
    return names, position, velocity
