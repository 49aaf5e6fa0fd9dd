"""The basin of attraction of a motion's hold: from how far off its regulator still catches the robot.

    python benchmarks/basin.py levade/motion.npz --figure docs/figures/basin.png

The robot is put where the motion is at its horizon, turned about the point midway between what touches the ground, and with
another pitch rate; then it holds. The success criteria of the hold judge its second half, on the nominal model, with the
regulator and without: the robot may swing on the way.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import success
from levade.engines import MujocoEngine, State
from levade.feedback import Feedback
from levade.motions import Motion, RecordedSimulation
from levade.robots.shapes import support
from levade.rotations import multiply, rotate
from levade.trajectory import JointReference


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motion", type=Path)
    parser.add_argument("--pitch", type=float, default=20.0, help="[deg] to either side")
    parser.add_argument("--rate", type=float, default=1.5, help="[rad/s] to either side")
    parser.add_argument("--points", type=int, default=31, help="on each axis")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--figure", type=Path)
    parser.add_argument("--out", type=Path, help="JSON with the map")
    options = parser.parse_args()
    motion = Motion.load(options.motion)
    if motion.steps == motion.horizon_steps:
        parser.error(f"{options.motion}: has no hold to be caught in; give a motion of a task with hold")
    pitch = np.linspace(-options.pitch, options.pitch, options.points)
    rate = np.linspace(-options.rate, options.rate, options.points)
    caught = {
        name: basin(motion, np.radians(pitch), rate, held, options.threads) for name, held in arms(motion).items()
    }
    for name, one in caught.items():
        print(
            f"{name}: {one.mean():.1%} of the map; on its axes {span(pitch, one[:, len(rate) // 2])} degrees,"
            f" {span(rate, one[len(pitch) // 2])} rad/s"
        )
    if options.out:
        content = {
            "pitch": pitch.tolist(),
            "rate": rate.tolist(),
            **{name: one.tolist() for name, one in caught.items()},
        }
        options.out.write_text(json.dumps(content) + "\n")
    if options.figure:
        draw(options.figure, motion, pitch, rate, caught)


def arms(motion: Motion) -> dict[str, Feedback | None]:
    """What is compared."""
    found: dict[str, Feedback | None] = {"open loop": None}
    if motion.feedback is not None:
        found["regulator"] = in_hold(motion.feedback, motion)
    return found


def in_hold(feedback: Feedback, motion: Motion) -> Feedback:
    """The feedback as it is from the horizon on."""
    tick = -(-motion.horizon_steps // feedback.steps(motion.timestep))
    return replace(
        feedback, gain=feedback.gain[-1:], reference=feedback.reference[min(tick, len(feedback.reference) - 1) :]
    )


def basin(motion: Motion, pitch: Array, rate: Array, feedback: Feedback | None, threads: int) -> Array:
    """Whether the robot is caught: (pitch offsets, rate offsets). pitch: [rad]. rate: [rad/s]."""
    simulation = RecordedSimulation(motion, threads=threads)
    engine, reference, steps = simulation.engine, simulation.reference, motion.horizon_steps
    assert isinstance(engine, MujocoEngine)
    arrays = engine.states(simulation.start, reference, ["qpos", "qvel", *(["act"] if engine.model.na else [])])[0]
    at = {name: values[0, steps - 1] for name, values in arrays.items()}
    turns, rates = (axis.ravel() for axis in np.meshgrid(pitch, rate, indexing="ij"))
    starts = pushed(engine, at, turns, rates, reference.position[0, steps - 1])
    held = JointReference(
        reference.position[:, steps:], reference.velocity[:, steps:], reference.timestep, horizon_steps=1
    )
    criteria = {name: one for name, one in simulation.criteria.items() if one.at in ("hold", "end")}
    met = []
    for first in range(0, len(turns), 64):
        rows = slice(first, first + 64)
        trajectories = engine.rollout(starts[rows], held, feedback=feedback)
        # what it is judged by is whether it is there in the second half: it may swing on the way
        half = held.steps // 2
        later = replace(trajectories, horizon_steps=half)
        met.append(success(criteria, later))
    return np.concatenate(met).reshape(len(pitch), len(rate))


def pushed(engine: MujocoEngine, at: dict[str, Array], turns: Array, rates: Array, commanded: Array) -> State:
    """States with the robot turned about the midpoint of what touches, by pitch [rad], and turning about it [rad/s] more."""
    model, layout = engine.model, engine.layout
    data = mujoco.MjData(model)
    data.qpos[:] = at["qpos"]
    mujoco.mj_forward(model, data)
    points = np.array([contact.pos for contact in data.contact])
    pivot = 0.5 * (points.min(axis=0) + points.max(axis=0)) if len(points) else data.subtree_com[1] * [1, 1, 0]
    n = len(turns)
    qpos, qvel = np.repeat(at["qpos"][None], n, axis=0), np.repeat(at["qvel"][None], n, axis=0)
    root, velocity = layout.root_qpos, layout.root_qvel
    turn = np.column_stack([np.cos(turns / 2), 0 * turns, np.sin(turns / 2), 0 * turns])
    arm = rotate(turn, qpos[:, root : root + 3] - pivot)
    qpos[:, root : root + 3] = pivot + arm
    qpos[:, root + 3 : root + 7] = multiply(turn, qpos[:, root + 3 : root + 7])
    axis = np.column_stack([0 * rates, rates, 0 * rates])
    qvel[:, velocity : velocity + 3] = rotate(turn, qvel[:, velocity : velocity + 3]) + np.cross(axis, arm)
    qvel[:, velocity + 4] += rates  # the trunk's own y axis is the world's, as far as it is not rolled
    lifted(engine, data, qpos, root)
    act = np.repeat(at["act"][None], n, axis=0) if "act" in at else np.zeros((n, 0))
    return layout.state(qpos, qvel, act, joint_reference=np.repeat(commanded[None], n, axis=0))


def lifted(engine: MujocoEngine, data: mujoco.MjData, qpos: Array, root: int) -> None:
    """Move each up or down so that its lowest point is as deep in the ground as before the turn."""
    model, down = engine.model, np.array([0.0, 0.0, -1.0])
    parts = np.flatnonzero(((model.geom_contype | model.geom_conaffinity) != 0) & (model.geom_bodyid != 0))
    deep = data.contact.dist.min(initial=0.0)
    for row in qpos:
        data.qpos[:] = row
        mujoco.mj_kinematics(model, data)
        row[root + 2] += deep - min(support(model, data, int(geom), down)[2] for geom in parts)


def span(values: Array, caught: Array) -> str:
    """The stretch around the middle in which all are caught."""
    middle = len(values) // 2
    if not caught[middle]:
        return "none"
    low, high = middle, middle
    while low > 0 and caught[low - 1]:
        low -= 1
    while high + 1 < len(values) and caught[high + 1]:
        high += 1
    return f"{values[low]:+.1f} to {values[high]:+.1f}"


def draw(path: Path, motion: Motion, pitch: Array, rate: Array, caught: dict[str, Array]) -> None:
    """One map an arm, and both on the same axes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.colors import ListedColormap

    from levade.report.style import LIGHT

    figure, axes = plt.subplots(1, len(caught), figsize=(5.4 * len(caught), 4.4), sharey=True, squeeze=False)
    for axis, (name, one) in zip(axes[0], caught.items(), strict=True):
        held = one.T.astype(float)
        axis.pcolormesh(
            pitch, rate, held, cmap=ListedColormap([LIGHT.page, LIGHT.front_left]), vmin=0, vmax=1, shading="nearest"
        )
        axis.axhline(0, color=LIGHT.grid, lw=0.8)
        axis.axvline(0, color=LIGHT.grid, lw=0.8)
        axis.plot(0, 0, "o", color=LIGHT.page, mec=LIGHT.ink, ms=6)
        axis.annotate("the motion", (0, 0), (8, -14), textcoords="offset points", fontsize=9, color=LIGHT.page)
        whose = "without feedback" if name == "open loop" else "with the regulator"
        axis.set_title(f"Blue: where {motion.task_name} catches itself {whose}", fontsize=10, color=LIGHT.ink)
        axis.set_xlabel("pitch off at the horizon [degrees], negative: farther back")
    axes[0][0].set_ylabel("pitch rate off [rad/s], negative: backward")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
