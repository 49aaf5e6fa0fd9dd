"""Find motions that hardware can do: within every limit, on robots that differ from the model, and with a certificate.

pursued = pursue(load_task("rearing"), seed=0, directory=Path("rearing"))
pursued.passed                  # what the certificate says
pursued.motion                  # the motion with the best certificate
obstacles(pursued)              # which demands it fails, and what could be changed
"""

from levade.hardware.page import certificate_page, write_certificate
from levade.hardware.part import Part, Pursued
from levade.hardware.pursuit import pursue
from levade.hardware.state import discard, is_pursuit, read_pursuit
from levade.hardware.verdict import binding, obstacles
from levade.tasks.plan import Plan

__all__ = [
    "Part",
    "Plan",
    "Pursued",
    "binding",
    "certificate_page",
    "discard",
    "is_pursuit",
    "obstacles",
    "pursue",
    "read_pursuit",
    "write_certificate",
]
