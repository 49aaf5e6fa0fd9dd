"""What docs/export.md shows, done literally."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from levade.cli import main
from levade.exports import FORMATS, export
from levade.exports.as_csv import columns
from levade.exports.as_unitree import G1, HELD_KD, HELD_KP
from levade.exports.samples import sample
from levade.motions import Motion

TEXT = (Path(__file__).parents[2] / "docs/export.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


def block(containing: str) -> str:
    return next(found for found in BLOCKS if containing in found)


@pytest.fixture
def here(motion_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "rearing").mkdir()
    (tmp_path / "rearing" / "motion.npz").write_bytes(motion_file.read_bytes())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def levade(*arguments: str) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(list(arguments))
    assert stopped.value.code == 0


@pytest.mark.slow
def test_the_commands_at_the_top(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (commands,) = re.findall(r"```sh\n(.*?)```", TEXT, re.DOTALL)
    _, export_line, play_line = (shlex.split(line) for line in commands.splitlines())
    levade(*export_line[1:])
    capsys.readouterr()
    done = subprocess.run([sys.executable, *play_line[1:]], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_csv_is_read_and_played_in_simulation(
    here: Path, rearing: Motion, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    levade("export", "rearing/motion.npz", "--to", "csv")
    capsys.readouterr()
    exec(compile(block("csv.DictReader"), "export.md", "exec"), {})
    assert capsys.readouterr().out.startswith("rearing 151 ")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.delitem(sys.modules, "player", raising=False)
    scope: dict[str, Any] = {"__name__": "example"}
    exec(compile(block("class Simulated"), "export.md", "exec"), scope)
    assert scope["worst"] < 0.2
    # one step after the last command, which came at the horizon
    assert abs(scope["robot"].state.qpos[2] - rearing["trunk_position"][-1, 2]) < 0.04
    sys.modules.pop("player", None)


def test_mjlab(here: Path, rearing: Motion, capsys: pytest.CaptureFixture[str]) -> None:
    levade("export", "rearing/motion.npz", "--to", "mjlab")
    capsys.readouterr()
    exec(compile(block("motion-mjlab"), "export.md", "exec"), {})
    place = rearing["trunk_position"][-1].astype(np.float32).tolist()
    assert capsys.readouterr().out == f"50 (16, 12) {place}\n"


@pytest.mark.slow
def test_the_bag(here: Path, rearing: Motion, capsys: pytest.CaptureFixture[str]) -> None:
    reason = "bags are written by mcap and read by rosbags: pip install 'levade[dev]'"
    pytest.importorskip("mcap", reason=reason)
    pytest.importorskip("rosbags", reason=reason)
    levade("export", "rearing/motion.npz", "--to", "ros2")
    capsys.readouterr()
    exec(compile(block("AnyReader"), "export.md", "exec"), {})
    assert capsys.readouterr().out == f"1300000000 lf_haa {rearing['joint_position'][-1, 0]}\n"


def stand_in_for_unitree(
    monkeypatch: pytest.MonkeyPatch, kind: str, command: dict[str, Any], state: dict[str, Any]
) -> list:
    """Put a stand-in for the SDK where imports find it; return the list of commands that it publishes."""
    written: list[Any] = []
    motors = [SimpleNamespace(q=0.1 * i, dq=-0.1 * i) for i in range(35)]

    class Publisher:
        def __init__(self, topic: str, kind: object) -> None:
            assert topic == "rt/lowcmd"

        def Init(self) -> None: ...
        def Write(self, command: Any) -> None:
            written.append(command)

    class Subscriber:
        def __init__(self, topic: str, kind: object) -> None:
            assert topic == "rt/lowstate"

        def Init(self, hear: Any, depth: int) -> None:
            hear(SimpleNamespace(motor_state=motors, **state))

    def low_cmd() -> SimpleNamespace:
        return SimpleNamespace(motor_cmd=[SimpleNamespace() for _ in range(35)], crc=0, **command)

    contents: dict[str, dict[str, Any]] = {
        "core.channel": {
            "ChannelFactoryInitialize": lambda domain: None,
            "ChannelPublisher": Publisher,
            "ChannelSubscriber": Subscriber,
        },
        "idl.default": {f"{kind}_msg_dds__LowCmd_": low_cmd},
        f"idl.{kind}.msg.dds_": {"LowCmd_": object, "LowState_": object},
        "utils.crc": {"CRC": type("CRC", (), {"Crc": lambda self, command: 7})},
    }
    for name, values in contents.items():
        module = ModuleType(f"unitree_sdk2py.{name}")
        vars(module).update(values)
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return written


def test_unitrees_interface_with_a_stand_in_for_its_sdk(monkeypatch: pytest.MonkeyPatch) -> None:
    """The names are those of unitree_sdk2_python's example/go2/low_level/go2_stand_example.py."""
    written = stand_in_for_unitree(monkeypatch, "unitree_go", {"head": [0, 0], "level_flag": 0}, {})
    scope: dict[str, Any] = {"__name__": "example"}
    exec(compile(block("class Go2"), "export.md", "exec"), scope)
    robot = scope["Go2"]()
    np.testing.assert_allclose(robot.read(), [0.1 * np.arange(12), -0.1 * np.arange(12)])
    robot.write(*(np.arange(12) + 100.0 * i for i in range(5)))
    (command,) = written
    assert vars(command.motor_cmd[3]) == {"mode": 1, "q": 3.0, "dq": 103.0, "tau": 203.0, "kp": 303.0, "kd": 403.0}
    assert (command.head[:2], command.level_flag, command.crc) == ([0xFE, 0xEF], 0xFF, 7)


def test_g1s_interface_with_a_stand_in_for_its_sdk(monkeypatch: pytest.MonkeyPatch) -> None:
    """The names are those of unitree_sdk2_python's example/g1/low_level/g1_low_level_example.py."""
    written = stand_in_for_unitree(monkeypatch, "unitree_hg", {"mode_pr": 1, "mode_machine": 0}, {"mode_machine": 5})
    scope: dict[str, Any] = {"__name__": "example"}
    exec(compile(block("class G1"), "export.md", "exec"), scope)
    joints = {motor: motor.lower() for motor in G1}
    still = {"waistyaw": 0.3, "leftwristroll": -0.2}
    moved = [motor for motor in G1 if joints[motor] not in still]
    robot = scope["G1"]({"provenance": {"motors": joints}, "held": still, "joints": moved})
    indices = [i for i in range(29) if i not in (12, 19)]
    np.testing.assert_allclose(robot.read(), [0.1 * np.array(indices), -0.1 * np.array(indices)])
    robot.write(*(np.array(indices) + 100.0 * k for k in range(5)))
    (command,) = written
    assert vars(command.motor_cmd[28]) == {"mode": 1, "q": 28.0, "dq": 128.0, "tau": 228.0, "kp": 328.0, "kd": 428.0}
    assert vars(command.motor_cmd[12]) == {
        "mode": 1,
        "q": 0.3,
        "dq": 0.0,
        "tau": 0.0,
        "kp": HELD_KP["WaistYaw"],
        "kd": HELD_KD,
    }
    assert vars(command.motor_cmd[19]) == {"mode": 1, "q": -0.2, "dq": 0.0, "tau": 0.0, "kp": 40.0, "kd": HELD_KD}
    assert not vars(command.motor_cmd[29])
    assert (command.mode_pr, command.mode_machine, command.crc) == (0, 5, 7)


def test_every_format_column_and_key_is_documented(rearing: Motion, rearing_model: Any, tmp_path: Path) -> None:
    for name in FORMATS:
        assert f"| `{name}` |" in TEXT
    samples = sample(rearing, rearing_model, rate=100.0)
    for column in columns(samples):
        general = column.replace("lf_foot", "FOOT").replace("lf_haa", "JOINT")
        parts = general.split("/")
        if parts[1:2] and parts[1] not in ("JOINT", "FOOT", "trunk"):
            continue  # another joint's, or foot's
        head = "/".join(parts[:-1])
        assert f"`{general}`" in TEXT or (f"`{head}/" in TEXT and f"`{parts[-1]}`" in TEXT), column
    export(rearing, "csv", tmp_path)
    meta = json.loads((tmp_path / "meta.json").read_text())
    facts = meta["simulation"]
    joint = facts["joints"]["lf_haa"]
    for key in (*meta, *facts, *joint, *joint["drive"], *facts["shapes"][0]):
        assert f"`{key}`" in TEXT, key
