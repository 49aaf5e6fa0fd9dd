"""Ranges in which robots differ from the model, as data, and samples from them.

    perturbation = Perturbation(friction=(0.5, 1.5), latency=None)      # others as by default
    sample = perturbation.draw(model, joints, n=500, seed=0)            # joints: their number
    sample.values["kp"]                                                 # (500, joints), factors
    starts, models = perturbed_models(model, layout, sample, start)     # see `levade.engines.models`

Every number is drawn uniformly within its range, independently of all others. Run i of a sample depends neither on the number
of runs nor on which other parameters are off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.scenes import GROUND, PLATFORM

Range = tuple[float, float] | None
"""Lowest and highest value; None keeps the model's own."""


@dataclass(frozen=True)
class Parameter:
    """Describes one perturbed quantity.

    Attributes:
        unit: "x" for a factor on the model's value, otherwise the SI unit of an offset.
        per: What has its own number: the model (one number), the axes, turns about them, tilts about x and y, the joints, the
            obstacles' axes.
        what: What it is, in a sentence.
        why: Why the default range is as wide as it is.
    """

    unit: str
    per: Literal["model", "axis", "turn", "tilt", "joint", "obstacle"]
    what: str
    why: str

    @property
    def nominal(self) -> float:
        """The value of the nominal model."""
        return 1.0 if self.unit == "x" else 0.0


PARAMETERS: dict[str, Parameter] = {
    "friction": Parameter(
        *("x", "model"),
        "friction coefficient of every contact",
        "rubber on lab floors, dust and wear: 0.5 to 0.9 where 0.7 is assumed",
    ),
    "mass": Parameter(
        *("x", "model"),
        "mass (and with it the inertia) of all bodies",
        "oil, hoses, cables and batteries are not in CAD; a data sheet rounds",
    ),
    "com": Parameter(
        *("m", "axis"),
        "the trunk's centre of mass, along its x, y and z",
        "what is mounted on the trunk changes from day to day",
    ),
    "inertia": Parameter(
        *("x", "model"),
        "rotational inertia of all bodies, next to that of mass",
        "seldom measured; CAD leaves out what mass leaves out, and further from the centre",
    ),
    "kp": Parameter(
        *("x", "joint"),
        "position gain of each joint",
        "the inner torque loop delivers 10 to 20 % more or less than commanded",
    ),
    "kd": Parameter(
        *("x", "joint"),
        "velocity gain of each joint",
        "as for kp; damping of seals and gears comes on top of it",
    ),
    "torque_lag": Parameter(
        *("x", "model"),
        "time constant from commanded to delivered torque",
        "bandwidth depends on load, supply pressure and temperature, and is rarely known to better than a factor 2",
    ),
    "torque_limit": Parameter(
        *("x", "model"),
        "largest torque and stall torque",
        "supply pressure or battery voltage sags under load; it does not rise",
    ),
    "latency": Parameter(
        *("s", "model"),
        "delay from a reference to its servo, which until then keeps its command from before the start",
        "up to two cycles of a 500 Hz controller or field bus",
    ),
    "start_joint": Parameter(
        *("rad", "joint"),
        "joint angles at the start",
        "encoder offsets after homing, and how the robot happened to be put down",
    ),
    "start_attitude": Parameter(
        *("rad", "turn"),
        "the trunk's attitude at the start, about x, y and z",
        "the floor under one foot is 1 cm higher; error of the attitude estimate",
    ),
    "start_velocity": Parameter(
        *("m/s", "axis"),
        "the trunk's velocity at the start",
        "the robot still sways when the motion begins",
    ),
    "start_rate": Parameter(
        *("rad/s", "axis"),
        "the trunk's angular velocity at the start",
        "as for start_velocity",
    ),
    "start_joint_velocity": Parameter(
        *("rad/s", "joint"),
        "joint velocities at the start",
        "as for start_velocity, seen by the joints",
    ),
    "ground_height": Parameter(
        *("m", "model"),
        "height of the ground, against obstacles and the height that is asked for",
        "carpets, mats, and the zero of the height estimate",
    ),
    "ground_slope": Parameter(
        *("rad", "tilt"),
        "tilt of ground and obstacles about x and y, the robot standing on them",
        "floors slope by up to 2 %",
    ),
    "obstacle": Parameter(
        *("m", "obstacle"),
        "position of each obstacle, along x, y and z",
        "a range finder sees it to a centimetre",
    ),
    "softness": Parameter(
        *("x", "model"),
        "time that a contact takes to push bodies apart, and what it may be short of the full force",
        "off: numbers of the simulation, not of the robot; a certificate tries both ends of 0.5 to 2",
    ),
    "cone": Parameter(
        *("-", "model"),
        "friction cone of contacts: the model's own below 0.5, the other of pyramidal and elliptic from there on",
        "off, as softness; a certificate tries the other one",
    ),
}
"""Name -> description, in the order of `Perturbation`."""

_LATE = {"softness": 1_819_440_229, "cone": 1_668_247_141}
"""Parameters with random numbers of their own, and their tags. So the numbers of the others are as they were without these."""


@dataclass(frozen=True)
class Perturbation:
    """Ranges in which robots differ. Factors (unit "x") are around 1, offsets around 0, in SI units.

    `PARAMETERS` and docs/check.md describe each, with the number of its values and the reason for its default. A parameter that
    a robot or scene lacks (a lag, an obstacle) has no effect.

    Raises:
        LevadeError: If a range is not valid.
    """

    friction: Range = (0.7, 1.3)
    mass: Range = (0.9, 1.1)
    com: Range = (-0.02, 0.02)
    inertia: Range = (0.8, 1.2)
    kp: Range = (0.8, 1.2)
    kd: Range = (0.8, 1.2)
    torque_lag: Range = (0.5, 2.0)
    torque_limit: Range = (0.9, 1.0)
    latency: Range = (0.0, 0.004)
    start_joint: Range = (-0.03, 0.03)
    start_attitude: Range = (-0.02, 0.02)
    start_velocity: Range = (-0.03, 0.03)
    start_rate: Range = (-0.05, 0.05)
    start_joint_velocity: Range = (-0.1, 0.1)
    ground_height: Range = (-0.005, 0.005)
    ground_slope: Range = (-0.02, 0.02)
    obstacle: Range = (-0.01, 0.01)
    softness: Range = None
    cone: Range = None

    def __post_init__(self) -> None:
        for name, about in PARAMETERS.items():
            ends = getattr(self, name)
            if ends is None:
                continue
            low, high = ends
            if not (math.isfinite(low) and math.isfinite(high) and low <= high):
                raise LevadeError(f"perturb.{name}: {list(ends)} should be [lowest, highest], two finite numbers")
            least = {"x": 0.01, "s": 0.0}.get(about.unit)
            if about.unit == "-" and not 0.0 <= low <= high <= 1.0:
                raise LevadeError(
                    f"perturb.{name}: {list(ends)} should be within 0 and 1; [0, 1] takes either cone alike"
                )
            if least is not None and low < least:
                raise LevadeError(f"perturb.{name}: {low} is too low; {least} or more, {about.nominal:g} is nominal")

    def spread(self, model: mujoco.MjModel, joints: int, *, n: int, seed: int | tuple[int, ...]) -> Sample:
        """Sample n runs that together cover every range evenly: a Latin hypercube, for few runs that represent many.

        Each range is cut into n parts, and each run has its number in another part (McKay, Beckman and Conover, Technometrics
        21, 1979).

        Args:
            model: The nominal model.
            joints: Number of joints.
            n: Number of runs.
            seed: One number, or several that together form one.

        Returns:
            The sample.
        """

        def spread(generator: np.random.Generator, size: int) -> Array:
            part = np.argsort(generator.random((n, size)), axis=0, kind="stable")
            return np.asarray((part + generator.random(part.shape)) / n)

        return self._drawn(spread, _sizes(model, joints), seed)

    def draw(self, model: mujoco.MjModel, joints: int, *, n: int, seed: int | tuple[int, ...]) -> Sample:
        """Draw n runs at random. Run i does not depend on n.

        Args:
            model: The nominal model.
            joints: Number of joints.
            n: Number of runs.
            seed: One number, or several that together form one.

        Returns:
            The sample.
        """
        return self._drawn(lambda generator, size: generator.random((n, size)), _sizes(model, joints), seed)

    def nominal(self, model: mujoco.MjModel, joints: int, *, n: int = 1) -> Sample:
        """Return n runs in which nothing is perturbed.

        Args:
            model: The nominal model.
            joints: Number of joints.
            n: Number of runs.

        Returns:
            The sample.
        """
        sizes = _sizes(model, joints)
        return Sample({name: np.full((n, size), PARAMETERS[name].nominal) for name, size in sizes.items()})

    def corners(self, model: mujoco.MjModel, joints: int, name: str, *, n: int, seed: int) -> Sample:
        """Sample runs in which only one parameter is perturbed, with each of its numbers at one end of the range.

        A single number takes both ends, one run each. Several take n random combinations and their opposites.

        Args:
            model: The nominal model.
            joints: Number of joints.
            name: Name of the parameter.
            n: Number of combinations.
            seed: Seed of the combinations.

        Returns:
            The sample.
        """
        size = _sizes(model, joints)[name]
        if size <= 1:
            ends = np.array([[0.0], [1.0]][: 2 * size]).reshape(2 * size, size)
        else:
            half = np.random.default_rng(seed).integers(0, 2, (n // 2, size)).astype(float)
            ends = np.concatenate([half, 1.0 - half])
        values: dict[str, Array] = dict(self.nominal(model, joints, n=len(ends)).values)
        values[name] = self._scaled(name, ends)
        return Sample(values)

    def _drawn(
        self,
        draw: Callable[[np.random.Generator, int], Array],
        shapes: Mapping[str, int],
        seed: int | tuple[int, ...],
    ) -> Sample:
        """Make a sample from numbers in [0, 1], shape (n, size) each, that ``draw`` returns."""
        seeds = seed if isinstance(seed, tuple) else (seed,)
        early = {name: size for name, size in shapes.items() if name not in _LATE}
        unit = draw(np.random.default_rng(seed), sum(early.values()))
        late = [draw(np.random.default_rng((*seeds, tag)), shapes[name]) for name, tag in _LATE.items()]
        return self._sample(np.concatenate([unit, *late], axis=1), {**early, **{name: shapes[name] for name in _LATE}})

    def _sample(self, unit: Array, shapes: Mapping[str, int]) -> Sample:
        values: dict[str, Array] = {}
        column = 0
        for name, size in shapes.items():
            values[name] = self._scaled(name, unit[:, column : column + size])
            column += size
        return Sample(values)

    def _scaled(self, name: str, unit: Array) -> Array:
        """Scale numbers in [0, 1] to the range."""
        ends = getattr(self, name)
        if ends is None:
            return np.full(unit.shape, PARAMETERS[name].nominal)
        return ends[0] + (ends[1] - ends[0]) * unit


@dataclass(frozen=True, eq=False)
class Sample:
    """Holds the values of every parameter in n runs: name -> factors, or offsets in SI units, shape (n, numbers)."""

    values: Mapping[str, Array]

    def __len__(self) -> int:
        return len(next(iter(self.values.values())))

    def __getitem__(self, rows: slice | Sequence[int] | NDArray[np.intp]) -> Sample:
        """Select runs, in the order given."""
        return Sample({name: values[rows] for name, values in self.values.items()})


def joined(samples: list[Sample]) -> Sample:
    """Join the runs of several samples, in sequence.

    Args:
        samples: Samples of the same robot and scene, at least one.

    Returns:
        One sample of all runs.
    """
    return Sample({name: np.concatenate([s.values[name] for s in samples]) for name in samples[0].values})


def ground(model: mujoco.MjModel) -> list[int]:
    """List the geoms on which the robot stands where there is no obstacle. With gaps, these are platforms.

    Args:
        model: Robot and scene.

    Returns:
        Indices of the geoms, in ascending order.
    """
    names = {i: model.geom(i).name for i in range(model.ngeom) if model.geom_bodyid[i] == 0}
    return [i for i, name in names.items() if name == GROUND or name.startswith(PLATFORM)]


def obstacles(model: mujoco.MjModel) -> list[int]:
    """List the geoms of the scene that are not ground.

    Args:
        model: Robot and scene.

    Returns:
        Indices of the geoms, in ascending order.
    """
    level = ground(model)
    return [i for i in range(model.ngeom) if model.geom_bodyid[i] == 0 and i not in level]


def labels(model: mujoco.MjModel, joint_names: tuple[str, ...], name: str) -> list[str]:
    """Name each number of a parameter: joint names, axes, obstacles; one empty text for a single number.

    Args:
        model: Robot and scene.
        joint_names: Names of the joints, in order.
        name: Name of the parameter, a key of `PARAMETERS`.

    Returns:
        A name for each number, in the order of the sample's columns.
    """
    return {
        "model": [""],
        "axis": ["x", "y", "z"],
        "turn": ["about x", "about y", "about z"],
        "tilt": ["about x", "about y"],
        "joint": list(joint_names),
        "obstacle": [f"{model.geom(i).name} {axis}" for i in obstacles(model) for axis in "xyz"],
    }[PARAMETERS[name].per]


def _sizes(model: mujoco.MjModel, joints: int) -> dict[str, int]:
    """Return how many numbers each parameter takes."""
    count = {"model": 1, "axis": 3, "turn": 3, "tilt": 2, "joint": joints, "obstacle": 3 * len(obstacles(model))}
    return {name: count[about.per] for name, about in PARAMETERS.items()}
