"""Export ``json``: everything in one file."""

from __future__ import annotations

from pathlib import Path

from levade.exports.as_csv import write_json, write_player
from levade.exports.content import Content, describe
from levade.exports.player import canonical, checksum


def write(content: Content, directory: Path) -> list[str]:
    """Write motion.json, and player.py, which reads it.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    samples = content.samples
    meta = describe(content, samples)
    document = {
        "time": samples.time.tolist(),
        "command": {name: getattr(samples, f"command_{name}").tolist() for name in ("position", "velocity", "torque")},
        "state": {
            **{name: getattr(samples, f"joint_{name}").tolist() for name in ("position", "velocity", "torque")},
            "trunk": {
                name: getattr(samples, f"trunk_{name}").tolist()
                for name in ("position", "com_position", "quaternion", "linear_velocity", "angular_velocity")
            },
            "contact_force": {foot: samples.foot_contact_force[:, i].tolist() for i, foot in enumerate(samples.feet)},
        },
    }
    if content.feedback is not None:
        document["feedback"] = {
            "gain": content.feedback.gain.tolist(),
            "reference": content.feedback.reference.tolist(),
        }
    meta |= {"checksum": checksum(meta, canonical(document))}
    write_json(directory / "motion.json", {"meta": meta, **document})
    write_player(directory)
    return []
