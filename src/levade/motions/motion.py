"""A motion: the result of a search, in one self-contained file that anyone with only mujoco and numpy can replay.

    motion = Motion.load("motion.npz")
    motion                                             # Motion(rearing on hyq2max: success, T = 0.3 s, 512 trials)
    motion.result.success, motion.result.errors["pitch"]
    motion["joint_position"]                           # (steps, joints) [rad]
    motion.task.success, motion.embodiment.limits      # the task, and the robot as the file knows it
    motion.save("copy.npz")

`levade.search.recording.record` makes one of what a search found. docs/motion-file.md documents the file, and replaying
it needs none of levade:

    data = np.load("motion.npz")
    assets = {name[6:]: data[name].tobytes() for name in data if name.startswith("asset:")}
    model = mujoco.MjModel.from_xml_string(str(data["model_xml"]), assets)
    state = mujoco.MjData(model)
    state.qpos[:], state.qvel[:], state.act[:] = data["qpos0"], data["qvel0"], data["act0"]
    for ctrl in data["ctrl"]:
        state.ctrl[:] = ctrl
        mujoco.mj_step(model, state)
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.embodiment import Embodiment
from levade.engines import State
from levade.errors import LevadeError, did_you_mean
from levade.feedback import Feedback
from levade.feedback import names as sensed_names
from levade.motions import file
from levade.motions.facts import actuator_lines, embodiment_of, legs_of
from levade.motions.model import compile_text
from levade.policies import Policy, policy_from_dict
from levade.robots import Leg
from levade.robots.addresses import Addresses
from levade.tasks import Task, looks_at_hold, task_from_dict, task_to_dict
from levade.trajectory import JointReference


class UnknownArray(LevadeError, KeyError):
    """A motion has no array of that name; also a KeyError."""

    __str__ = Exception.__str__  # a KeyError would put the message in quotes


@dataclass(frozen=True)
class Result:
    """Reports how well a motion does, and what the search took.

    Attributes:
        success: Whether it meets its task's criteria on the model, and for a robust task on enough perturbed models.
        diverged: Whether its simulation broke down.
        errors: Criterion -> error [SI], as in `levade.costs.Criterion.error`.
        values: Criterion -> value of its quantity [SI], as in `levade.costs.Criterion.value`. Files of early versions, and
            trials that broke down, lack it.
        cost: Weighted sum of the terms.
        cost_terms: Cost -> value of its term.
        cost_weights: Cost -> its weight in ``cost``: the task's, unless it changed during the search.
        trials: Trials of the search.
        trials_to_success: Trials until the first success. None if there was none.
    """

    success: bool
    diverged: bool
    errors: Mapping[str, float]
    values: Mapping[str, float]
    cost: float
    cost_terms: Mapping[str, float]
    cost_weights: Mapping[str, float]
    trials: int
    trials_to_success: int | None
    stopped: str


@dataclass(frozen=True)
class Provenance:
    """Where a motion comes from.

    Attributes:
        engine: The engine that simulated it.
        versions: Library -> version; they decide the bits.
        seed: The search's random seed.
        initial: How many motions the search began around; 0 for none.
        schema: Version of the file's layout.
    """

    engine: str
    versions: Mapping[str, str]
    seed: int
    schema: int
    initial: int = 0


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """Holds the commands to the actuators, the robot's motion, and the model. It never changes.

    Attributes:
        meta: The file's JSON. The attributes and properties below offer its content.
        model_xml: MJCF of the model, robot and scene.
        arrays: Name -> array: see `levade.motions.ARRAYS`, with rows as in `levade.trajectory`.
        assets: Files that the model needs, by name.
        source_task: The search's task, if it holds Python code, which no file does. None otherwise.
    """

    meta: Mapping[str, Any]
    model_xml: str
    arrays: Mapping[str, Array]
    assets: Mapping[str, bytes]
    source_task: Task | None = None

    @classmethod
    def load(cls, path: str | Path) -> Motion:
        """Load a motion file.

        Args:
            path: The file.

        Returns:
            The motion.

        Raises:
            LevadeError: If it is missing, damaged, or something else.
        """
        content = file.read(path)
        return cls(content.meta, content.model_xml, content.arrays, content.assets)

    def save(self, path: str | Path) -> None:
        """Write the motion to a file, completely or not at all.

        Args:
            path: The file.

        Raises:
            OSError: If it cannot be written.
        """
        file.write(path, file.Content(self.meta, self.model_xml, self.arrays, self.assets))

    def __getitem__(self, name: str) -> Array:
        """Look up an array by name. Raises `UnknownArray`, which names the nearest one."""
        try:
            return self.arrays[name]
        except KeyError:
            raise UnknownArray(f"motion: no array {name!r}; {did_you_mean(str(name), self.arrays)}") from None

    @cached_property
    def checksum(self) -> str:
        """Identify this motion by a SHA-256 in hexadecimal, which is the same in every file of it.

        It covers the model, the arrays, the limits and the stabiliser, but not other information such as the task.
        """
        told = {name: self.meta.get(name) for name in ("limits", "feedback", "timestep", "horizon_steps")}
        parts = [json.dumps(told, sort_keys=True).encode(), self.model_xml.encode()]
        for name, content in sorted(self.assets.items()):
            parts += [name.encode(), content]
        for name, values in sorted(self.arrays.items()):
            whole = np.ascontiguousarray(values)
            parts += [f"{name} {whole.dtype.str} {whole.shape}".encode(), whole.tobytes()]
        found = hashlib.sha256()
        for part in parts:
            found.update(len(part).to_bytes(8, "big") + part)
        return found.hexdigest()

    def __contains__(self, name: object) -> bool:
        return name in self.arrays

    def __repr__(self) -> str:
        found = "diverged" if self.result.diverged else "success" if self.result.success else "no success"
        hold = f" and {self.hold:g} s of hold" if self.hold > 1e-9 else ""
        return f"Motion({self.task_name} on {self.robot}: {found}, T = {self.horizon:g} s{hold}, {self.result.trials} trials)"

    # what was asked for

    @cached_property
    def task(self) -> Task:
        """The task, with every default filled in: `source_task`, or that of the file.

        In a task from a file, a cost that was Python code is a `levade.tasks.code.MissingCode`.

        Raises:
            LevadeError: If this version of levade does not accept it.
        """
        if self.source_task is not None:
            return self.source_task
        return task_from_dict(self.meta["task"], where="the motion's task", code=True)

    @property
    def task_name(self) -> str:
        """The task's name; cheaper than `task`."""
        return str(self.meta["task"]["name"])

    @cached_property
    def policy(self) -> Policy | None:
        """The policy whose weights are ``motion["weights"]``. None if the file lacks it, as files of layout 1 do.

        `levade.motions.ReferenceCurve` also finds it for these.
        """
        content = self.meta.get("policy")
        return None if content is None else policy_from_dict(content)

    # the robot

    @property
    def robot(self) -> str:
        """The robot's name."""
        return str(self.meta["robot"])

    @property
    def trunk(self) -> str:
        """Name of the trunk's body."""
        return str(self.meta["trunk"])

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, in the order of every array."""
        return tuple(str(name) for name in self["joint_names"])

    @cached_property
    def legs(self) -> tuple[Leg, ...]:
        """The legs: names of joints and feet, and their geometry."""
        return legs_of(self.meta)

    @property
    def held(self) -> Mapping[str, float]:
        """Joints that the model holds fixed -> their position [rad], for slides [m]. Empty in files of early versions."""
        return self.meta.get("held", {})

    @property
    def model_joints(self) -> tuple[str, ...]:
        """All joints of the robot's file in its order, including held ones. Empty in files of early versions."""
        return tuple(self.meta.get("model_joints", ()))

    @cached_property
    def embodiment(self) -> Embodiment:
        """The robot as simulations and costs describe it. Its ``legs`` are empty in files of early versions."""
        return embodiment_of(self.meta, self.joint_names, lambda: actuator_lines(self.compiled(), self.joint_names))

    def compiled(self) -> mujoco.MjModel:
        """Compile the model. Each call makes a new one.

        Returns:
            The model.

        Raises:
            LevadeError: If MuJoCo refuses it, or it does not fit the arrays.
        """
        model = compile_text(self.model_xml, self.assets)
        for name, size in (("qpos0", model.nq), ("qvel0", model.nv), ("act0", model.na), ("ctrl", model.nu)):
            if self[name].shape[-1] != size:
                raise LevadeError(
                    f"motion: {name} has {self[name].shape[-1]} numbers, its model {size}; the file is damaged"
                )
        if not np.isclose(model.opt.timestep, self.timestep, rtol=1e-6, atol=0.0):
            raise LevadeError(
                f"motion: has steps of {self.timestep:g} s, its model of {model.opt.timestep:g} s; the file is damaged"
            )
        self._check_names(model)
        return model

    def _check_names(self, model: mujoco.MjModel) -> None:
        """Raise LevadeError unless the model has the motion's trunk, joints, feet, and actuators with one control each."""
        kind = mujoco.mjtObj
        for what, of, names in (
            ("body", kind.mjOBJ_BODY, [self.trunk]),
            ("joint", kind.mjOBJ_JOINT, self.joint_names),
            ("actuator", kind.mjOBJ_ACTUATOR, self.joint_names),
            ("geom", kind.mjOBJ_GEOM, [leg.foot for leg in self.legs]),
        ):
            for name in names:
                if mujoco.mj_name2id(model, of, name) < 0:
                    raise LevadeError(f"motion: its model has no {what} {name!r}; the file is damaged")
        hinge, free = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_FREE
        first = int(model.body(self.trunk).jntadr[0])
        if (
            first < 0
            or model.jnt_type[first] != free
            or {int(model.joint(n).type[0]) for n in self.joint_names} != {hinge}
        ):
            raise LevadeError(
                "motion: its trunk does not move freely, or joints of it are no hinges; the file is damaged"
            )

    def addresses(self, model: mujoco.MjModel) -> Addresses:
        """Look up the trunk and the joints in the motion's model.

        Args:
            model: The compiled model, from `compiled`.

        Returns:
            Their addresses in MuJoCo's vectors.
        """
        return Addresses.of(model, self.trunk, self.joint_names)

    # what the robot did

    @property
    def timestep(self) -> float:
        """Time step [s]."""
        return float(self.meta["timestep"])

    @property
    def horizon(self) -> float:
        """Horizon T [s]."""
        return float(self.meta["horizon"])

    @property
    def horizon_steps(self) -> int:
        """Rows up to the horizon; later ones are the hold."""
        return int(self.meta["horizon_steps"])

    @property
    def steps(self) -> int:
        """Number of rows of every array over time."""
        return len(self["time"])

    @property
    def duration(self) -> float:
        """Duration with the hold [s]."""
        return float(self["time"][-1])

    @property
    def hold(self) -> float:
        """Duration of the hold after the horizon [s]."""
        return max(0.0, self.duration - self.horizon)

    @cached_property
    def start(self) -> State:
        """The state at the start, one row.

        Files of early versions lack the last commands of the joints. The joint positions stand in for them.
        """
        joint_position = self["qpos0"][self.addresses(self.compiled()).joint_qpos]
        commanded = self.arrays.get("joint_position_reference0", joint_position)
        parts = (self["qpos0"], self["qvel0"], self["act0"], joint_position, commanded)
        return State(*(np.array(part, dtype=float)[None] for part in parts))

    @cached_property
    def reference(self) -> JointReference:
        """The joint references, as a reference of one trial."""
        return JointReference(
            self["joint_position_reference"][None],
            self["joint_velocity_reference"][None],
            self.timestep,
            self.horizon_steps,
            self.arrays.get("joint_position_reference0"),
        )

    @cached_property
    def result(self) -> Result:
        """How well it does, and what the search took."""
        meta = self.meta
        weights = meta.get("cost_weights") or {name: cost["weight"] for name, cost in meta["task"]["costs"].items()}
        return Result(
            success=bool(meta["success"]),
            diverged=bool(meta["diverged"]),
            errors=meta["errors"],
            values=meta.get("values", {}),
            cost=float(meta["cost"]),
            cost_terms=meta["cost_terms"],
            cost_weights=weights,
            trials=int(meta["trials"]),
            trials_to_success=meta["trials_to_success"],
            stopped=meta["stopped"],
        )

    @cached_property
    def provenance(self) -> Provenance:
        """Where it comes from."""
        meta = self.meta
        return Provenance(
            str(meta["engine"]), meta["versions"], meta["seed"], int(meta["schema"]), int(meta.get("initial", 0))
        )

    def meets(self, criterion: str) -> bool:
        """Tell whether the motion meets a criterion of its task on the model, by the numbers in its file.

        Args:
            criterion: Name of the criterion in the task.

        Returns:
            Whether its error is within the tolerance, which is 0 if the criterion has none.
        """
        return abs(self.result.errors[criterion]) <= (self.task.success[criterion].tolerance or 0.0)

    @property
    def met(self) -> bool:
        """Whether the motion meets every criterion of its task on the model."""
        return not self.result.diverged and all(self.meets(name) for name in self.task.success)

    @property
    def falls_late(self) -> bool:
        """Whether it meets every criterion on the model up to the hold, and misses one in the hold."""
        missed = [criterion for name, criterion in self.task.success.items() if not self.meets(name)]
        return bool(missed) and not self.result.diverged and all(looks_at_hold(criterion) for criterion in missed)

    @property
    def met_on_the_model_only(self) -> bool:
        """Whether it meets every criterion on the model, but is not a success: a motion of a robust search."""
        return self.met and not self.result.success

    # the stabiliser

    @cached_property
    def feedback(self) -> Feedback | None:
        """The stabiliser, if the motion has one.

        The recorded motion has no disturbance, so there the stabiliser does nothing.
        """
        return None if self.stabiliser is None else Feedback.of(self.stabiliser, self.arrays)

    @property
    def stabiliser(self) -> Mapping[str, Any] | None:
        """The file's description of the stabiliser, as JSON. None if there is none."""
        return self.meta.get("feedback")

    def with_task(self, task: Task) -> Motion:
        """Return the same motion with another task of the same robot, scene and costs in its file.

        Args:
            task: The task.

        Returns:
            The motion with the task.
        """
        meta = {**self.meta, "task": task_to_dict(task, code=True)}
        return Motion(meta, self.model_xml, self.arrays, self.assets, None if self.source_task is None else task)

    def stabilised(self, feedback: Feedback | None, **about: Any) -> Motion:
        """Return the same motion with a stabiliser, or without.

        Args:
            feedback: The stabiliser. None removes it.
            about: Further keys of its description.

        Returns:
            The motion.
        """
        arrays = {
            name: self.arrays[name] for name in (*file.ARRAYS, *file.LATER_ARRAYS) if name in self.arrays
        }  # but not those of another stabiliser
        meta = {key: value for key, value in self.meta.items() if key != "feedback"}
        if feedback is not None:
            arrays |= feedback.arrays()
            meta["feedback"] = {
                "rate": 1.0 / feedback.period,
                "period_steps": feedback.steps(self.timestep),
                "latency": feedback.period,
                "bound": feedback.bound,
                "sensed": sensed_names(self.joint_names),
                **about,
            }
        return Motion(meta, self.model_xml, arrays, self.assets, self.source_task)
