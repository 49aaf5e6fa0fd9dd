"""Write certificate.html: a page that needs no network, with the certificate, its ranges and its poorest runs to play.

    write_certificate(motion, certificate, "rearing/certificate.html", source="motion.npz")

The page has the script and style of `levade.report.page`. The same motion and certificate give the same bytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.checks import Certificate
from levade.costs import Criterion
from levade.engines import FOOT_CONTACT_FORCE
from levade.engines.perturbation import PARAMETERS, labels
from levade.errors import LevadeError
from levade.motions import Motion, RecordedSimulation, run_again
from levade.report.packing import pack
from levade.report.page import assembled, save_page
from levade.report.scene import scene_data
from levade.trajectory import Trajectories
from levade.version import __version__

_KINDS = ("speed", "torque_speed", "torque", "range")
"""Kinds of limits that the plot shows, in its order."""

_SHOWN = 6
"""Number of the shown parameters in which a run's robot differs most."""

_RATE = 60.0
"""Most poses of a run per second [Hz]. A page holds several runs."""


def write_certificate(
    motion: Motion,
    certificate: Certificate,
    path: str | Path,
    *,
    criteria: Mapping[str, Criterion] | None = None,
    source: str | None = None,
    instead: str = "give another path",
) -> Path:
    """Write a certificate's page.

    Args:
        motion: The motion.
        certificate: Its certificate, from `levade.checks.check`.
        path: File to write.
        criteria: Criteria of the certificate. Defaults to those that the motion's task calls good enough on perturbed models.
        source: Name of the motion's file on the page.
        instead: What to do instead, for an error's message.

    Returns:
        The page's path.

    Raises:
        LevadeError: If the certificate belongs to another motion or other criteria, the file cannot be written, or the path
            holds a file that is no page of levade.
    """
    text = certificate_page(motion, certificate, criteria=criteria, source=source)
    return save_page(text, path, instead=instead)


def certificate_page(
    motion: Motion,
    certificate: Certificate,
    *,
    criteria: Mapping[str, Criterion] | None = None,
    source: str | None = None,
) -> str:
    """Return the page as text.

    Args:
        motion: The motion.
        certificate: Its certificate.
        criteria: Criteria of the certificate, as in `write_certificate`.
        source: Name of the motion's file on the page.

    Raises:
        LevadeError: If the certificate belongs to another motion or other criteria.
    """
    data = certificate_data(motion, certificate, criteria=criteria, source=source)
    return assembled(f"Certificate: {certificate.task} on {certificate.robot}", data, "certificate")


def certificate_data(
    motion: Motion,
    certificate: Certificate,
    *,
    criteria: Mapping[str, Criterion] | None = None,
    source: str | None = None,
) -> dict[str, Any]:
    """Return the page's data for JSON. web/src/certificate.js draws it.

    Args:
        motion: The motion.
        certificate: Its certificate.
        criteria: Criteria of the certificate, as in `write_certificate`.
        source: Name of the motion's file on the page.

    Raises:
        LevadeError: If the certificate belongs to another motion or other criteria.
    """
    if certificate.checksum != motion.checksum:
        raise LevadeError("certificate: belongs to another motion; give the motion that was checked")
    if criteria is None and certificate.criteria != certificate.task:
        raise LevadeError(f"certificate: uses the criteria of {certificate.criteria}; give these criteria")
    found = certificate.perturbed
    scene = scene_data(motion, rate=_RATE)
    return {
        "task": certificate.task,
        "description": motion.task.description,
        "robot": certificate.robot,
        "criteria": certificate.criteria,
        "goal": [asdict(one) for one in certificate.goal],
        "horizon": motion.horizon,
        "hold": motion.hold,
        "feedback": None if motion.stabiliser is None else motion.stabiliser["rate"],
        "passed": certificate.passed,
        "interrupted": certificate.interrupted,
        "failed": list(certificate.failed),
        "unknown": list(certificate.unknown),
        "share": {"runs": found.runs, "successes": found.successes, "low": found.low, "high": found.high},
        "verdicts": [asdict(verdict) for verdict in certificate.verdicts],
        "errors": [{"name": name, **values} for name, values in found.errors.items()],
        "sensitivity": [one.to_json() for one in found.sensitivity],
        "ranges": list(_ranges(certificate)),
        "limits": limits_data(motion),
        "scene": scene,
        "runs": list(_poorest(motion, certificate, criteria or motion.task.on_others, scene)),
        "provenance": {
            "motion": source,
            "checksum": certificate.checksum,
            "seed": found.seed,
            "timestep": found.timestep,
            "versions": dict(certificate.versions),
            "written_by": f"levade {__version__}",
        },
    }


def limits_data(motion: Motion) -> dict[str, Any]:
    """Return the slack to each kind of limit over time, as a share, and the joint that has the least.

    A linkage lowers the torque limit of its joint.

    Args:
        motion: The motion.
    """
    limits, names = motion.embodiment.limits, motion.joint_names
    angle, speed, torque = (motion[f"joint_{name}"] for name in ("position", "velocity", "torque"))
    half = (limits.upper - limits.lower) / 2
    half[~(np.isfinite(half) & (half > 0))] = np.nan  # a range with only one end has no shares
    with np.errstate(invalid="ignore"):
        left: dict[str, Array] = {
            "speed": limits.speed_left(speed),
            "torque": np.minimum(1 - np.abs(torque) / limits.torque, limits.linkage_left(angle, torque)),
            "range": limits.angle_left(angle) / half,
        }
        if limits.stall_torque is not None:
            left["torque_speed"] = limits.torque_speed_left(torque, speed)
    kinds = []
    for name in _KINDS:
        there = None if name not in left else np.where(np.isfinite(left[name]), left[name], np.inf)
        if there is None or np.isinf(there).all():
            continue
        kinds.append({"name": name, "left": pack(there.min(axis=1)), "joint": pack(there.argmin(axis=1), "u2")})
    return {
        "time": pack(motion["time"]),
        "horizon": motion.horizon,
        "end": motion.duration,
        "joints": list(names),
        "kinds": kinds,
    }


def _ranges(certificate: Certificate) -> Iterator[dict[str, Any]]:
    """Yield the ranges from which the perturbed runs were drawn."""
    for name, ends in asdict(certificate.ranges).items():
        if ends is not None:
            yield {"name": name, "low": ends[0], "high": ends[1], "unit": PARAMETERS[name].unit}


def _poorest(
    motion: Motion, certificate: Certificate, criteria: Mapping[str, Criterion], scene: Mapping[str, Any]
) -> Iterator[dict[str, Any]]:
    """Yield the poorest runs: their scenes, the criteria that they missed, and how their robots differed."""
    found = certificate.perturbed
    if certificate.interrupted:
        return
    whole = RecordedSimulation(motion, criteria=criteria)
    parts = round(motion.timestep / found.timestep)
    simulation = whole.divided(parts)
    sample = certificate.ranges.draw(simulation.model, simulation.joints, n=found.runs, seed=found.seed)
    done = run_again(
        simulation, sample, found.poorest, feedback=motion.feedback, seed=found.seed, record=[FOOT_CONTACT_FORCE]
    )
    starts = simulation.starts(sample[list(found.poorest)])
    for i, run in enumerate(found.poorest):
        judged = {name: one.judge(done[i : i + 1])[0] for name, one in criteria.items()}
        missed = [
            {"name": name, "error": float(off[0])} for name, off in judged.items() if not criteria[name].met(off)[0]
        ]
        other = scene_data(_recorded(motion, done, starts.qpos, i, parts), like=scene, rate=_RATE)
        yield {
            "name": f"run {run}",
            "motion": {**other["motion"], "reference": None},
            "layers": [layer for layer in other["layers"] if layer["name"] != "reference"],
            "missed": missed,
            "diverged": bool(done.diverged[i]),
            "differs": _farthest(
                certificate, simulation, {name: values[run] for name, values in sample.values.items()}
            ),
        }


def _farthest(
    certificate: Certificate, simulation: RecordedSimulation, values: Mapping[str, Array]
) -> list[dict[str, Any]]:
    """Return the parameters in which a robot differs most, by shares of the ranges: names, values and units."""
    found = []
    for name, numbers in values.items():
        ends = getattr(certificate.ranges, name)
        if ends is None or ends[0] == ends[1]:
            continue
        about = labels(simulation.model, simulation.embodiment.joint_names, name)
        for label, value in zip(about, numbers.tolist(), strict=True):
            far = abs(value - (ends[0] + ends[1]) / 2) / (ends[1] - ends[0])
            found.append((far, {"name": f"{name} {label}".strip(), "value": value, "unit": PARAMETERS[name].unit}))
    return [one for _, one in sorted(found, key=lambda pair: -pair[0])[:_SHOWN]]


def _recorded(motion: Motion, done: Trajectories, qpos: Array, trial: int, parts: int) -> Motion:
    """Return one trial as if it had been recorded. Of rows at shorter time steps, only those of the motion remain."""
    rows = slice(parts - 1, None, parts)
    assert done.foot_contact_force is not None
    arrays = {
        "qpos0": qpos[trial],
        "joint_position": done.joint_position[trial, rows],
        "trunk_position": done.trunk_position[trial, rows],
        "trunk_quaternion": done.trunk_quaternion[trial, rows],
        "trunk_com_position": done.trunk_com_position()[trial, rows],
        "foot_contact_force": done.foot_contact_force[trial, rows],
    }
    return replace(motion, arrays={**motion.arrays, **arrays})
