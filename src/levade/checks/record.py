"""The file that a certificate is kept in, and whether it vouches for a motion.

reason = doubt(Path("certificate.json"), motion)        # None: it is the motion's, and it passes
"""

from __future__ import annotations

from pathlib import Path

from levade.document import read_yaml
from levade.errors import LevadeError
from levade.motions import Motion

CERTIFICATE, CERTIFICATE_PAGE = "certificate.json", "certificate.html"
"""The files' usual names, beside the motion's."""


JUDGED = (*("share", "numerics", "engines"), *("position", "speed", "torque", "torque_speed", "self_collision"))
"""Demands that a certificate has to make to vouch for a motion."""

FEWEST = 100
"""Perturbed runs that it has to have."""


def certificate_beside(motion_file: Path, motion: Motion) -> dict[str, str] | None:
    """The page of the certificate that lies beside a motion's file, and what it says of the motion.

    None where there is no such page or certificate, or where it is another motion's.
    """
    record, page = motion_file.with_name(CERTIFICATE), motion_file.with_name(CERTIFICATE_PAGE)
    try:
        content = read_yaml(record) if record.is_file() and page.is_file() else None
    except LevadeError:  # a broken file beside a motion is no reason not to show the motion
        return None
    if not isinstance(content, dict) or content.get("checksum") != motion.checksum:
        return None
    failed = ", ".join(map(str, content.get("failed") or ()))
    return {
        "page": page.name,
        "says": "passes" if content.get("passed") else f"fails {failed}" if failed else "ended early",
    }


def doubt(path: Path, motion: Motion) -> str | None:
    """Why a certificate's file does not vouch for a motion, in a few words; None if it does.

    Raises:
        LevadeError: If there is no such file, or it is no certificate.
    """
    content = read_yaml(path)
    if not isinstance(content, dict) or not isinstance(content.get("passed"), bool):
        raise LevadeError(f"{path}: is no certificate; levade check writes one")
    if content.get("checksum") != motion.checksum:
        return "it is of another motion"
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
        return f"it has {runs} perturbed runs, and {FEWEST} are the least that say much"
    return None
