"""Say in words what keeps a motion from the hardware: which limit binds, what fails, and what could be changed."""

from __future__ import annotations

from levade.checks import Certificate, Margin
from levade.hardware.part import Pursued
from levade.hardware.state import LIMITS, MORE, NEAR
from levade.motions import Motion

_SHARES = {"speed": "speed limit", "torque_speed": "torque-speed line", "linkage": "linkage's torque"}


def binding(certificate: Certificate) -> str:
    """Name the limit that a motion comes nearest to, and the slack that is left.

    Args:
        certificate: Certificate of the motion.

    Returns:
        A sentence. "" if no limit is known.
    """
    left = {
        name: margin
        for name, margin in certificate.margins.items()
        if name in _SHARES and margin.value is not None and (margin.passed is not None or margin.unknown)
    }
    if not left:
        return ""
    name = min(left, key=lambda one: left[one].value or 0.0)
    margin = left[name]
    assumed = " (assumed)" if margin.least in margin.unknown else ""
    return f"{margin.least} comes nearest to a limit: {margin.value:.1%} of its {_SHARES[name]}{assumed} left"


def obstacles(pursued: Pursued) -> list[str]:
    """List the demands that the best certificate fails, and what could be changed.

    Args:
        pursued: The outcome of a pursuit.

    Returns:
        A line for each.
    """
    part, certificate = pursued.best, pursued.certificate
    failed = set(certificate.failed)
    said = [
        _of_margin(name, margin, part.motion)
        for name, margin in certificate.margins.items()
        if name.replace("_", " ") in failed
    ]
    missed = [name for name in pursued.plan.goal if not part.motion.meets(name)]
    if missed:
        off = ", ".join(f"{name} {part.motion.result.errors[name]:+.3g}" for name in missed)
        said.append(f"the goal is missed within the limits ({off}): ask for less, or allow a longer horizon")
    within_limits = part.name.rpartition("/")[2] in (*LIMITS, *MORE, NEAR)
    if "perturbed" in failed and not (missed and within_limits):
        said.append(_of_perturbed(certificate))
    others = [name for name in sorted(failed) if name != "perturbed" and name not in _names(certificate)]
    if others and not (missed and within_limits):
        said.append(f"the motion fails with {', '.join(others)}: its success depends on how contact is computed")
    return said


def _names(certificate: Certificate) -> set[str]:
    return {name.replace("_", " ") for name in certificate.margins}


def _of_margin(name: str, margin: Margin, motion: Motion) -> str:
    joints, limits = motion.joint_names, motion.embodiment.limits
    if margin.value is None or margin.least not in joints:
        if name == "self_collision" and margin.value is not None:
            return f"{margin.least} overlap by {1000 * margin.value:.0f} mm: try a slower motion, or legs farther apart"
        return f"{name.replace('_', ' ')}: {margin.least} {margin.value} {margin.unit}"
    joint, required = joints.index(margin.least), margin.required or 0.0
    if name == "power":
        return f"{margin.least} takes {margin.value:.0f} W, but only {required:.0f} W are allowed: try a slower motion"
    asked = f", but {required:.0%} should be left" * (required > 0)
    if name == "speed":
        needed = limits.velocity[joint] * (1 - margin.value) / max(1 - required, 1e-2)
        return (
            f"{margin.least} reaches {1 - margin.value:.2f} of its speed limit{asked}: try a joint with {needed:.3g} rad/s,"
            " a slower motion, or a goal that asks for less"
        )
    if name == "torque_speed":
        return (
            f"{margin.least} leaves {margin.value:.0%} of its stall torque to its torque-speed line{asked}: try a stronger"
            " joint, a slower motion, or a goal that asks for less"
        )
    if name == "linkage":
        return (
            f"{margin.least} leaves {margin.value:.0%} of the torque that its linkage transmits{asked}: try a stronger joint,"
            " other postures, a slower motion, or a goal that asks for less"
        )
    if name == "position":
        return (
            f"{margin.least} leaves {margin.value:.3g} rad of its range, but {required:.3g} rad should be left: try a wider"
            " range, or a goal that asks for less"
        )
    return (
        f"{margin.least} leaves {margin.value:.0%} of its {name.replace('_', ' ')} limit{asked}: try a stronger joint"
    )


def _of_perturbed(certificate: Certificate) -> str:
    found = certificate.perturbed
    worst = max(found.errors, key=lambda name: found.errors[name]["missed"], default="")
    breaks = found.sensitivity[0].parameter if found.sensitivity else ""
    wanted = certificate.demands.share or 0.0
    return (
        f"the motion succeeds on {found.share:.1%} of perturbed robots, but {wanted:.0%} are demanded: {worst} is missed most"
        f"{breaks and f', {breaks} matters most'}; try a wider tolerance of {worst}, or measure the robot more precisely"
    )
