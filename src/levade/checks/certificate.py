"""The certificate: all findings of a check, and whether they meet its demands."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from levade.checks.engines import Replayed
from levade.checks.numerics import Numeric
from levade.checks.perturbed import Perturbed
from levade.checks.slack import Margin
from levade.checks.verdicts import Verdict
from levade.engines import Perturbation
from levade.tasks import Demands


@dataclass(frozen=True)
class Goal:
    """What a criterion asks for, in words and SI units.

    Attributes:
        criterion: Name of the criterion.
        task: What the task says.
        model: What the motion has to meet on the model.
        perturbed: What it has to meet on perturbed models, with other numerics and in other engines. "" if nothing.
    """

    criterion: str
    task: str
    model: str
    perturbed: str


@dataclass(frozen=True)
class Certificate:
    """All findings of a check.

    Attributes:
        task: Name of the motion's task.
        robot: Name of the robot.
        criteria: Name of the task whose success criteria were used.
        goal: What each criterion asks for.
        checksum: Checksum of the motion (`levade.motions.Motion.checksum`).
        versions: Library -> version, for those that decide the bits of a result.
        demands: Thresholds that the motion has to meet.
        ranges: Ranges that the perturbed runs were drawn from.
        perturbed: Result of the perturbed runs, with the stabiliser if the motion has one.
        numerics: Name of a variant -> result, with the stabiliser if the motion has one.
        engines: Name of an engine -> result.
        margins: Kind of limit -> slack.
        open_loop: Result of the perturbed runs without the stabiliser; None if the motion has none.
        interrupted: Whether the check was interrupted. Then it has fewer perturbed runs, and no other results.
    """

    task: str
    robot: str
    criteria: str
    goal: tuple[Goal, ...]
    checksum: str
    versions: Mapping[str, str]
    demands: Demands
    ranges: Perturbation
    perturbed: Perturbed
    numerics: Mapping[str, Numeric]
    engines: Mapping[str, Replayed]
    margins: Mapping[str, Margin]
    open_loop: Perturbed | None = None
    interrupted: bool = False

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Verdicts on all demands: pass, fail or unknown."""
        return (self._perturbed(), *self._numerics(), *self._engines(), *self._margins())

    @property
    def passed(self) -> bool:
        """Whether the check is complete and no demand is failed. Demands may still be unknown: see `unknown`."""
        return not self.interrupted and all(verdict.passed is not False for verdict in self.verdicts)

    @property
    def failed(self) -> tuple[str, ...]:
        """Names of the demands that are not met."""
        return tuple(verdict.name for verdict in self.verdicts if verdict.passed is False)

    @property
    def unknown(self) -> tuple[str, ...]:
        """Names of the demands that cannot be judged, because the robot's limit is not known, or only assumed."""
        return tuple(verdict.name for verdict in self.verdicts if verdict.unknown)

    def to_json(self) -> dict[str, Any]:
        """Write the certificate as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        return {
            "passed": self.passed,
            "interrupted": self.interrupted,
            "task": self.task,
            "robot": self.robot,
            "criteria": self.criteria,
            "goal": [asdict(one) for one in self.goal],
            "checksum": self.checksum,
            "versions": dict(self.versions),
            "failed": list(self.failed),
            "unknown": list(self.unknown),
            "perturbed": self.perturbed.to_json(),
            "open_loop": None if self.open_loop is None else self.open_loop.to_json(),
            "numerics": {name: one.to_json() for name, one in self.numerics.items()},
            "engines": {name: one.to_json() for name, one in self.engines.items()},
            "margins": {name: one.to_json() for name, one in self.margins.items()},
            "demands": asdict(self.demands),
            "ranges": asdict(self.ranges),
        }

    def _perturbed(self) -> Verdict:
        found, share, without = self.perturbed, self.demands.share, self.open_loop
        beside = "" if without is None else f"; without the stabiliser {without.share:.1%}"
        return Verdict(
            "perturbed",
            None if share is None else found.share >= share,
            f"{found.successes} of {found.runs} runs ({found.share:.1%}; {found.low:.1%} to {found.high:.1%}){beside}",
            "" if share is None else f"{share:.0%}",
            "" if share is not None else "not demanded",
        )

    def _numerics(self) -> list[Verdict]:
        judged = self.demands.numerics
        return [
            Verdict(
                name,
                one.success if judged else None,
                ("broke down" if one.diverged else "succeeds" if one.success else "does not succeed")
                + f"; {_off(one.apart)}",
                "success",
                "" if judged else "not demanded",
            )
            for name, one in self.numerics.items()
        ]

    def _engines(self) -> list[Verdict]:
        found = []
        for name, one in self.engines.items():
            if one.success is None or one.apart is None:
                found.append(Verdict(f"engine {name}", None, "", "success", one.reason))
                continue
            moved = f"; {_off(one.apart)}"
            moved += "; without the stabiliser" * (self.open_loop is not None)
            found.append(
                Verdict(
                    f"engine {name}",
                    one.success if self.demands.engines else None,
                    ("succeeds" if one.success else "does not succeed") + moved,
                    "success",
                    "" if self.demands.engines else "not demanded",
                )
            )
        return found

    def _margins(self) -> list[Verdict]:
        return [
            Verdict(
                name.replace("_", " "),
                one.passed,
                _number(one) + (f"; fails: {', '.join(one.failed)}" if one.failed and one.passed is False else ""),
                "" if one.required is None else _required(name, one),
                one.reason if one.passed is None else "",
                unknown=one.passed is None and bool(one.unknown),
            )
            for name, one in self.margins.items()
        ]


MEASURED = (
    *("power", "robot_power", "flow", "pump_flow"),
    *("foot_force", "impact_speed", "part_force", "part_impact_speed", "trunk_acceleration"),
    *("self_collision", "self_force", "self_impact_speed"),
)
"""Margins with an upper bound on what is measured; the others have a lower bound on the slack."""


def _off(apart: Mapping[str, float]) -> str:
    distance = 1000 * apart["position_at_horizon"]
    number = f"{distance:.0f}" if distance >= 10 or distance < 1e-3 else f"{distance:.2g}"
    return f"{number} mm off at the horizon"


def _number(margin: Margin) -> str:
    if margin.value is None:
        return margin.said or ("none" if margin.unit in ("m", "m/s", "robot weights") and not margin.reason else "")
    if margin.unit.startswith("share"):
        return f"{margin.value:+.1%} left, {margin.least}{margin.said and f': {margin.said}'}"
    return f"{margin.value:.4g} {margin.unit}, {margin.least}"


def _required(name: str, margin: Margin) -> str:
    assert margin.required is not None
    bound = "at most" if name in MEASURED else "at least"
    share = margin.unit.startswith("share")
    return f"{bound} {margin.required:.0%}" if share else f"{bound} {margin.required:g} {margin.unit}"
