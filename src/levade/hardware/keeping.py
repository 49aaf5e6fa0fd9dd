"""Keep the best motion of a pursuit, with its certificate, in the pursuit's directory.

keep(part, certificate, directory)      # unless a better one is there
"""

from __future__ import annotations

import json
from pathlib import Path

from levade.checks import Certificate
from levade.checks.record import CERTIFICATE
from levade.document import read_yaml
from levade.errors import LevadeError, Remedy
from levade.hardware.page import write_certificate
from levade.hardware.part import Part, rank
from levade.hardware.state import PAGE
from levade.search.run import MOTION, TASK
from levade.search.storage import storing
from levade.tasks import task_to_yaml
from levade.writing import write_text


def keep(part: Part, certificate: Certificate, directory: Path) -> None:
    """Write a motion and its certificate, unless an earlier call left a better certificate for the same demands.

    Args:
        part: The search that found the motion.
        certificate: Its certificate.
        directory: Directory of the pursuit.

    Raises:
        LevadeError: If a file cannot be written.
    """
    if _better_there(certificate, directory):
        return
    with storing(directory, then=Remedy("make room, then go on", "resume", directory)):
        part.motion.save(directory / MOTION)
        write_text(directory / TASK, task_to_yaml(part.motion.task, code=True))
        content = {"motion": MOTION, **certificate.to_json()}
        write_text(directory / CERTIFICATE, json.dumps(content, ensure_ascii=False, indent=1) + "\n")
        write_certificate(part.motion, certificate, directory / PAGE, source=MOTION)


def _better_there(certificate: Certificate, directory: Path) -> bool:
    place = directory / CERTIFICATE
    if not place.is_file() or not (directory / MOTION).is_file():
        return False
    try:
        there, found = read_yaml(place), certificate.to_json()
        return there["demands"] == found["demands"] and rank(there) < rank(found)
    except (LevadeError, LookupError, TypeError, ValueError):
        return False
