"""Read the file of a certificate, and decide whether it vouches for a motion.

reason = doubt(Path("certificate.json"), motion)        # None: it is the motion's, and it passes
"""

from __future__ import annotations

from pathlib import Path

from levade.document import read_yaml
from levade.errors import LevadeError
from levade.motions import Motion

CERTIFICATE, CERTIFICATE_PAGE = "certificate.json", "certificate.html"
"""Usual names of the files, next to the motion's."""


JUDGED = (*("share", "numerics", "engines"), *("position", "speed", "torque", "torque_speed", "self_collision"))
"""Demands that a certificate has to make so that it vouches for a motion."""

FEWEST = 100
"""Least number of perturbed runs in such a certificate."""


def certificate_beside(motion_file: Path, motion: Motion) -> dict[str, str] | None:
    """Find the certificate next to a motion's file.

    Args:
        motion_file: File of the motion.
        motion: The motion.

    Returns:
        Name of its "page", and what it "says" about the motion; None if there is no page or certificate, or it belongs to
        another motion.
    """
    record, page = motion_file.with_name(CERTIFICATE), motion_file.with_name(CERTIFICATE_PAGE)
    try:
        content = read_yaml(record) if record.is_file() and page.is_file() else None
    except LevadeError:  # a motion is shown even if the file next to it is damaged
        return None
    if not isinstance(content, dict) or content.get("checksum") != motion.checksum:
        return None
    failed = ", ".join(map(str, content.get("failed") or ()))
    return {
        "page": page.name,
        "says": "passes" if content.get("passed") else f"fails {failed}" if failed else "ended early",
    }


def doubt(path: Path, motion: Motion) -> str | None:
    """Find out whether a certificate vouches for a motion.

    Args:
        path: File of the certificate.
        motion: The motion.

    Returns:
        Why it does not vouch for the motion, in a few words; None if it does.

    Raises:
        LevadeError: If there is no such file, or it is not a certificate.
    """
    content = read_yaml(path)
    if not isinstance(content, dict) or not isinstance(content.get("passed"), bool):
        raise LevadeError(f"{path}: is not a certificate; levade check writes one")
    if content.get("checksum") != motion.checksum:
        return "it belongs to another motion"
    if content.get("interrupted"):
        return "its check was interrupted"
    if not content["passed"]:
        return f"it fails {', '.join(map(str, content.get('failed') or ()))}"
    demands = content.get("demands") or {}
    left_out = [
        name for name in JUDGED if demands.get(name) is None or demands[name] is False
    ]  # a margin of 0 is judged
    if left_out:
        return f"it does not judge {', '.join(left_out)}"
    runs = content.get("perturbed", {}).get("runs", 0)
    if runs < FEWEST:
        return f"it has {runs} perturbed runs, but at least {FEWEST} are needed"
    return None
