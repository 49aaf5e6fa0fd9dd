"""What a user brings: the bow of docs/your-task.md on a robot of her own, with nothing but `--hardware`."""

from __future__ import annotations

import functools
import json
import re
from pathlib import Path

import mujoco
import numpy as np
import pytest
from tests.hardware.short import shorten

from levade import hardware
from levade.cli import pursuing
from levade.motions import Motion

DOCS = Path(__file__).parents[2] / "docs"

pytestmark = pytest.mark.slow


def test_a_task_and_a_robot_of_one_s_own(
    levade, tmp_path: Path, quadruped: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A URDF says torque and speed limits and ranges; MuJoCo alone says whether the motion keeps them."""
    monkeypatch.setattr(pursuing, "pursue", functools.partial(hardware.pursue, runs=60))
    shorten(monkeypatch)
    text = (DOCS / "your-task.md").read_text(encoding="utf-8")
    bow = next(block for block in re.findall(r"```yaml\n(.*?)```", text, re.S) if block.startswith("# bow.yaml"))
    (tmp_path / "bow.yaml").write_text(bow)
    (tmp_path / "own.urdf").write_text(quadruped().urdf())
    code, out, _ = levade("solve", "bow.yaml", "--robot", "own.urdf", "--hardware", "--seed", "1", "--json")
    assert code == 0
    certificate = json.loads(out)["certificate"]
    assert certificate["passed"] is True
    assert certificate["failed"] == []
    assert certificate["unknown"] == []  # the file says every limit
    motion = Motion.load("bow/motion.npz")
    model = mujoco.MjModel.from_xml_string(motion.model_xml, dict(motion.assets))
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.act[:] = motion["qpos0"], motion["qvel0"], motion["act0"]
    pitch, joints, own = [], [model.joint(name) for name in motion.joint_names], quadruped()
    for row in motion["ctrl"]:
        data.ctrl[:] = row
        mujoco.mj_step(model, data)
        w, x, y, z = data.body(motion.embodiment.trunk).xquat
        pitch.append(np.arcsin(2 * (w * y - z * x)))
        assert max(abs(data.qvel[joint.dofadr[0]]) for joint in joints) < own.VELOCITY
        assert np.abs(data.actuator_force).max() <= own.EFFORT + 1e-9
    held = np.degrees(pitch[motion.horizon_steps - 1 :])
    assert (held.min() >= 10, held.max() <= 25) == (True, True)
