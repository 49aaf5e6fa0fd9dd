"""The honest baseline: what one writes by hand with pycma and `mujoco.rollout`, in an environment of its own.

    python plain.py CASE SEED TRIALS UNTIL STEP        # called by run.py, which wrote CASE; prints one JSON object

Plain CMA-ES with the library's defaults over the kernel weights: full covariance that starts as the identity, one stage,
the task's cost. Model, start, kernels and controls are read from files; the loop below is all there is. Only the cost terms
and the success test are levade's functions, which is what makes them the same.
"""

from __future__ import annotations

import dataclasses
import json
import sys
import time
from importlib.metadata import version
from pathlib import Path

import cma
import mujoco
import numpy as np
from mujoco import rollout

from levade.costs import DIVERGED, errors, evaluate, total
from levade.robots import load_robot
from levade.tasks import load_task
from levade.trajectory import JointReference, Trajectories


class Problem:
    def __init__(self, case: Path) -> None:
        self.task = load_task(case / "task.yaml")
        choice = dataclasses.asdict(self.task.robot)
        self.robot = load_robot(choice.pop("name"), **choice)
        assets = {path.name: path.read_bytes() for path in (case / "assets").iterdir()}
        spec = mujoco.MjSpec.from_string((case / "model.xml").read_text(), assets=assets)
        for joint in self.robot.joint_names:  # what roll-outs return of torques comes through sensors
            spec.add_sensor(
                name=f"torque {joint}",
                type=mujoco.mjtSensor.mjSENS_ACTUATORFRC,
                objtype=mujoco.mjtObj.mjOBJ_ACTUATOR,
                objname=joint,
            )
        self.model = model = spec.compile()
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
        self.data = mujoco.MjData(model)
        arrays = np.load(case / "arrays.npz")
        self.mean, self.phi, self.phi_rate = arrays["mean"], arrays["phi"], arrays["phi_rate"]
        self.index, self.sign = arrays["index"], arrays["sign"]
        self.ends = tuple(arrays[name] for name in ("factor", "added", "factor_rate", "added_rate"))
        self.rows, self.hold = len(self.phi), self.task.hold_steps
        start = mujoco.MjData(model)
        start.qpos[:], start.qvel[:], start.act[:] = arrays["qpos"], arrays["qvel"], arrays["act"]
        whole = mujoco.mjtState.mjSTATE_FULLPHYSICS
        self.start = np.empty(mujoco.mj_stateSize(model, whole))
        mujoco.mj_getState(model, start, self.start, whole)
        self.qpos = [int(model.joint(joint).qposadr[0]) for joint in self.robot.joint_names]
        self.qvel = [int(model.joint(joint).dofadr[0]) for joint in self.robot.joint_names]
        self.ctrl = [int(model.actuator_ctrladr[model.actuator(joint).id]) for joint in self.robot.joint_names]
        self.torque = [int(model.sensor(f"torque {joint}").adr[0]) for joint in self.robot.joint_names]
        self.root = model.joint(int(model.body(self.robot.trunk).jntadr[0]))
        bodies = sorted({body for cost in self.task.costs.values() for body in getattr(cost.term, "bodies", ())})
        self.forces = {body: int(model.sensor(f"{body}_scene_force").adr[0]) for body in bodies}
        self.weights = {name: cost.weight for name, cost in self.task.costs.items()}

    def evaluate(self, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Cost and success of (n, d)."""
        n, steps = len(weights), self.rows + self.hold
        w = weights.reshape(n, -1, self.phi.shape[1])[:, self.index] * self.sign[:, None]
        position = np.empty((n, steps, len(self.index)))
        velocity = np.zeros_like(position)
        position[:, : self.rows] = np.einsum("rk,njk->nrj", self.phi, w)
        velocity[:, : self.rows] = np.einsum("rk,njk->nrj", self.phi_rate, w)
        factor, added, factor_rate, added_rate = self.ends
        velocity[:, : self.rows] = (
            factor * velocity[:, : self.rows] + factor_rate * position[:, : self.rows] + added_rate
        )
        position[:, : self.rows] = factor * position[:, : self.rows] + added
        position[:, self.rows :] = position[:, self.rows - 1 : self.rows]
        control = np.zeros((n, steps, self.model.nu))
        control[..., self.ctrl] = position
        control[..., [address + 1 for address in self.ctrl]] = velocity
        state, sensors = rollout.rollout(self.model, self.data, self.start[None], control, persistent_pool=True)
        state = state[..., 1:]  # time
        nq, root, free = self.model.nq, int(self.root.qposadr[0]), self.model.nq + int(self.root.dofadr[0])
        done = Trajectories(
            joint_position=state[..., self.qpos],
            joint_velocity=state[..., [nq + address for address in self.qvel]],
            joint_torque=sensors[..., self.torque],
            trunk_position=state[..., root : root + 3],
            trunk_quaternion=state[..., root + 3 : root + 7],
            trunk_linear_velocity=state[..., free : free + 3],
            trunk_angular_velocity=state[..., free + 3 : free + 6],
            reference=JointReference(position, velocity, self.task.physics.timestep, self.rows),
            embodiment=self.robot.embodiment,
            timestep=self.task.physics.timestep,
            horizon_steps=self.rows,
            diverged=~(np.isfinite(state).all(axis=(1, 2)) & (np.abs(state) < 1e10).all(axis=(1, 2))),
            body_contact_force={b: np.linalg.norm(sensors[..., a : a + 3], axis=-1) for b, a in self.forces.items()},
        )
        with np.errstate(all="ignore"):  # of trials that broke down
            terms = evaluate({name: cost.term for name, cost in self.task.costs.items()}, done)
            cost = np.where(done.diverged, DIVERGED, total(terms, self.weights))
            success = ~done.diverged
            for name, off in errors(self.task.success, done).items():
                success &= self.task.success[name].met(off)
        return np.where(np.isfinite(cost), cost, DIVERGED), success


def main(case: str, seed: str, trials: str, until: str, step: str) -> None:
    problem = Problem(Path(case))
    if until == "check":  # costs of the same weights as run.py's own, to compare
        cost, success = problem.evaluate(np.load(Path(case) / "check.npy"))
        print(json.dumps({"cost": cost.tolist(), "success": success.tolist()}))
        return
    began = time.process_time()
    search = cma.CMAEvolutionStrategy(problem.mean, float(step), {"seed": int(seed) + 1, "verbose": -9, "tolfun": 0,
                                      "tolfunhist": 0, "tolx": 0, "tolflatfitness": 10**9, "tolstagnation": 10**9})  # fmt: skip
    spent, best, first, diverged = 0, (True, np.inf), None, 0
    while spent + search.popsize <= int(trials):
        asked = search.ask()
        cost, success = problem.evaluate(np.array(asked))
        search.tell(asked, cost.tolist())
        spent += len(asked)
        diverged += int((cost == DIVERGED).sum())
        best = min([best, *zip((~success).tolist(), cost.tolist(), strict=True)])
        if first is None and success.any():
            first = {"trials": spent, "core_seconds": time.process_time() - began, "cost": best[1]}
            if until == "success":
                break
    print(
        json.dumps(
            {
                "trials": spent,
                "core_seconds": time.process_time() - began,
                "cost": best[1],
                "first": first,
                "diverged": diverged,
                "steps_a_trial": problem.rows + problem.hold,
                "version": f"cma {version('cma')} by hand, mujoco {version('mujoco')}",
            }
        )
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
