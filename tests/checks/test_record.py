"""Whether a certificate's file vouches for a motion, and the checksum that tells."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from levade.checks import Demands
from levade.checks.record import JUDGED, certificate_beside, doubt
from levade.errors import LevadeError
from levade.motions import Motion

DEMANDS = asdict(Demands())


def test_what_the_stabiliser_is_counts(standing: Motion, changed: Callable[..., Motion]) -> None:
    one = changed(standing, meta={"feedback": {"bound": 0.3}})
    assert len({standing.checksum, one.checksum, changed(standing, meta={"feedback": {"bound": 0.4}}).checksum}) == 3


def test_a_motion_keeps_its_checksum_in_every_file(standing: Motion, tmp_path: Path) -> None:
    standing.save(tmp_path / "one.npz")
    loaded = Motion.load(tmp_path / "one.npz")
    loaded.save(tmp_path / "two.npz")
    assert standing.checksum == loaded.checksum == Motion.load(tmp_path / "two.npz").checksum
    task = replace(standing.task, description="another")
    assert standing.with_task(task).checksum == standing.checksum


def test_any_other_number_has_another_checksum(standing: Motion, changed: Callable[..., Motion]) -> None:
    ctrl = standing["ctrl"].copy()
    ctrl[-1, -1] = np.nextafter(ctrl[-1, -1], 1.0)
    other = changed(standing, ctrl=ctrl)
    assert other.checksum != standing.checksum
    assert replace(standing, model_xml=standing.model_xml + " ").checksum != standing.checksum


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ({}, None),
        ({"passed": False, "failed": ["speed", "perturbed"]}, "it fails speed, perturbed"),
        ({"passed": False, "interrupted": True}, "its check was interrupted"),
        ({"checksum": "0" * 64}, "it belongs to another motion"),
        ({"demands": {**DEMANDS, "share": None, "numerics": False}}, "it does not judge share, numerics"),
        ({"demands": None}, f"it does not judge {', '.join(JUDGED)}"),
        ({"perturbed": {"runs": 1}}, "it has 1 perturbed runs, but at least 100 are needed"),
    ],
)
def test_a_certificate_vouches_for_the_motion_it_is_of(
    standing: Motion, tmp_path: Path, content: dict[str, object], reason: str | None
) -> None:
    place = tmp_path / "certificate.json"
    usual = {"passed": True, "checksum": standing.checksum, "demands": DEMANDS, "perturbed": {"runs": 500}}
    place.write_text(json.dumps({**usual, **content}))
    assert doubt(place, standing) == reason


@pytest.mark.parametrize("text", ["{}", "[1]", '{"passed": "yes"}'])
def test_what_is_no_certificate_is_said(standing: Motion, tmp_path: Path, text: str) -> None:
    place = tmp_path / "certificate.json"
    place.write_text(text)
    with pytest.raises(LevadeError, match="certificate"):
        doubt(place, standing)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ({"passed": True, "failed": []}, "passes"),
        ({"passed": False, "failed": ["torque speed", "perturbed"]}, "fails torque speed, perturbed"),
        ({"passed": False, "failed": []}, "ended early"),
        ({"passed": True, "checksum": "0" * 64}, None),
        ([], None),
    ],
)
def test_a_motion_names_the_page_of_its_own_certificate(
    standing: Motion, tmp_path: Path, content: dict[str, object] | list[object], says: str | None
) -> None:
    motion_file = tmp_path / "motion.npz"
    certificate = {"checksum": standing.checksum, **content} if isinstance(content, dict) else content
    (tmp_path / "certificate.json").write_text(json.dumps(certificate))
    assert certificate_beside(motion_file, standing) is None  # there is no page yet
    (tmp_path / "certificate.html").write_text("a page")
    expected = None if says is None else {"page": "certificate.html", "says": says}
    assert certificate_beside(motion_file, standing) == expected
    (tmp_path / "certificate.json").write_text("{")
    assert certificate_beside(motion_file, standing) is None
