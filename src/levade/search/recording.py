"""Turn a solution into a motion: simulate the best trial once more and record everything."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.costs import errors, evaluate, success
from levade.motions import ARRAYS, LATER_ARRAYS, SCHEMA, Motion, versions
from levade.motions.facts import robot_facts
from levade.policies import FreePolicy, Policy, policy_to_dict
from levade.search.objective import Objective
from levade.search.outcome import Solution
from levade.tasks import holds_code, task_to_dict


def record(objective: Objective, solution: Solution, *, seed: int) -> Motion:
    """Simulate the best trial of a solution once more and record everything.

    Args:
        objective: Objective of the search.
        solution: What the search found.
        seed: Seed of the search.

    Returns:
        The motion, with the feedback of the search if the trial had any.
    """
    engine, state = objective.engine, objective.state
    policy, weights = objective.policy, solution.best.weights
    trajectories = objective.rollout(weights[None], feet=True).alone(0)
    if isinstance(policy, FreePolicy):
        policy, weights = policy.chosen(weights)
    reference = trajectories.reference
    assert trajectories.foot_contact_force is not None
    arrays: dict[str, Array] = {
        "qpos0": state.qpos[0],
        "qvel0": state.qvel[0],
        "act0": state.act[0],
        "ctrl": engine.ctrl(reference)[0],
        "time": trajectories.time,
        "joint_names": np.array(objective.robot.joint_names),
        "joint_position_reference0": state.joint_reference[0],
        "joint_position_reference": reference.position[0],
        "joint_velocity_reference": reference.velocity[0],
        "joint_position": trajectories.joint_position[0],
        "joint_velocity": trajectories.joint_velocity[0],
        "joint_torque": trajectories.joint_torque[0],
        "trunk_position": trajectories.trunk_position[0],
        "trunk_com_position": trajectories.trunk_com_position()[0],
        "trunk_quaternion": trajectories.trunk_quaternion[0],
        "trunk_linear_velocity": trajectories.trunk_linear_velocity[0],
        "trunk_angular_velocity": trajectories.trunk_angular_velocity[0],
        "foot_contact_force": trajectories.foot_contact_force[0],
        "weights": weights,
    }
    task = replace(objective.task, search=replace(objective.task.search, changes=solution.changes))
    met = bool(success(task.success, trajectories)[0])
    meta: dict[str, Any] = {
        "schema": SCHEMA,
        "task": task_to_dict(task, code=True),
        "robot": objective.robot.name,
        **robot_facts(objective.robot.embodiment, objective.robot.legs),
        "held": dict(objective.robot.held),
        "model_joints": list(objective.robot.model_joints),
        "policy": policy_to_dict(policy) if isinstance(policy, Policy) else None,
        "engine": task.physics.engine,
        "versions": versions(task.physics.engine),
        "seed": seed,
        "initial": solution.initial,
        "timestep": task.physics.timestep,
        "horizon": trajectories.horizon_steps * task.physics.timestep,
        "horizon_steps": trajectories.horizon_steps,
        # in a robust search a success also needs enough of the perturbed models, and only the search knows these
        "success": met and (task.robust is None or solution.best.success),
        "diverged": bool(trajectories.diverged[0]),
        "errors": {name: float(error[0]) for name, error in errors(task.success, trajectories).items()},
        "values": {
            name: float(value)
            for name, criterion in task.success.items()
            for value in criterion.value(trajectories)
            if np.isfinite(value)
        },
        "cost": float(solution.best.cost),
        "cost_weights": dict(solution.cost_weights),
        "cost_terms": {name: float(value[0]) for name, value in evaluate(objective.terms, trajectories).items()},
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "stopped": str(solution.stopped),
    }
    arrays = {name: np.ascontiguousarray(arrays[name]).copy() for name in (*ARRAYS, *LATER_ARRAYS)}
    motion = Motion(meta, engine.xml, arrays, dict(engine.assets), task if holds_code(task) else None)
    gains = solution.best.gains
    if gains is None:
        return motion
    feedback = objective.regulator(gains, seed=seed).along(objective.sensed(solution.best.weights))
    return motion.stabilised(feedback, made="in the search")
