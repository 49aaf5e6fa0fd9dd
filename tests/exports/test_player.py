"""The player: against MuJoCo made from the motion's own model, against robots that misbehave, and on its own."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.exports import export
from levade.exports.player import Motion as Played
from levade.exports.player import StandIn, Stopped, clock, main, play
from levade.motions import Motion
from levade.rotations import roll_pitch_yaw


def no_clock(instant: float) -> float:
    return 0.0


@dataclass
class Simulated:
    """The robot of a motion in MuJoCo, one physics step a command.

    lagging: driven as in the motion, by its own actuators; torque goes in by way of the position, ``position + torque / kp``.
    Else by ideal drives, which deliver what is commanded up to the torque limit.
    """

    motion: Motion
    lagging: bool
    timestep: float | None = None
    states: list[np.ndarray] = field(default_factory=list)

    def __post_init__(self) -> None:
        spec = mujoco.MjSpec.from_string(self.motion.model_xml)
        names = self.motion["joint_names"].tolist()
        if not self.lagging:
            for name, limit in zip(names, self.motion.meta["limits"]["torque"], strict=True):
                actuator = spec.actuator(name)
                actuator.set_to_motor()
                actuator.ctrlspec, actuator.actdim = 0, -1
                actuator.forcerange = [-limit, limit]
        if self.timestep is not None:
            spec.option.timestep = self.timestep
        self.model = spec.compile()
        assert self.model.nu == (24 if self.lagging else 12)
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:], self.data.qvel[:] = self.motion["qpos0"], self.motion["qvel0"]
        self.data.act[:] = self.motion["act0"][: self.model.na]

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos[7:].copy(), self.data.qvel[6:].copy()

    def write(self, position, velocity, torque, kp, kd) -> None:
        self.states.append(np.concatenate([self.data.qpos, self.data.qvel]))
        if self.lagging:
            self.data.ctrl[0::2], self.data.ctrl[1::2] = position + torque / kp, velocity
        else:
            now, rate = self.read()
            self.data.ctrl[:] = kp * (position - now) + kd * (velocity - rate) + torque
        mujoco.mj_step(self.model, self.data)

    def off(self) -> tuple[float, float]:
        """[rad], [m]: pitch and height at the last command, the horizon, against the motion."""
        qpos = self.states[-1][:19]
        row = self.motion.horizon_steps - 1
        pitch, meant = (roll_pitch_yaw(q)[1] for q in (qpos[3:7], self.motion["trunk_quaternion"][row]))
        return abs(pitch - meant), abs(qpos[2] - self.motion["trunk_position"][row, 2])


def played(motion: Motion, directory: Path, **options) -> Played:
    export(motion, "csv", directory, hold=False, **options)
    return Played.load(directory / "motion.csv")


@pytest.mark.golden
def test_commanded_references_are_the_simulation_again_to_the_bit(rearing: Motion, tmp_path: Path) -> None:
    robot = Simulated(rearing, lagging=True)
    worst = play(played(rearing, tmp_path, reference="commanded"), robot, ramp=0.0, wait=no_clock)
    states = np.array(robot.states)[1:]
    assert worst == 0.0
    np.testing.assert_array_equal(states[:, :3], rearing["trunk_position"])
    np.testing.assert_array_equal(states[:, 3:7], rearing["trunk_quaternion"])
    np.testing.assert_array_equal(states[:, 7:19], rearing["joint_position"])
    np.testing.assert_array_equal(states[:, 25:], rearing["joint_velocity"])


@pytest.mark.parametrize("reference", ["commanded", "measured"])
def test_after_the_ramp_the_goal_is_reached(rearing: Motion, tmp_path: Path, reference: str) -> None:
    """From a stand that is not quite the start, on drives with the lag that the motion was found with."""
    robot = Simulated(rearing, lagging=True)
    robot.data.qpos[7:] += 0.03 * np.random.default_rng(0).normal(size=12)
    worst = play(played(rearing, tmp_path, reference=reference), robot, ramp=1.0, wait=no_clock)
    pitch, height = robot.off()
    assert len(robot.states) == 500 + 151
    assert pitch < 0.03
    assert height < 0.03
    assert worst < 0.3


@pytest.mark.slow
@pytest.mark.parametrize("rate", [500.0, 1000.0])
def test_measured_references_reach_the_goal_on_other_drives_and_commanded_ones_do_not(
    rearing: Motion, tmp_path: Path, rate: float
) -> None:
    """Drives without lag, and with half the gains: measured references bring their torque along. So they are the default."""
    off = {}
    for reference, options in (("measured", {}), ("measured", {"kp": 300.0, "kd": 12.0}), ("commanded", {})):
        robot = Simulated(rearing, lagging=False, timestep=1 / rate)
        motion = played(rearing, tmp_path, rate=rate, reference=reference, **options)
        play(motion, robot, ramp=1.0, tolerance=9.0, wait=no_clock)
        off[reference, len(options)] = robot.off()
    for pitch, height in (off["measured", 0], off["measured", 2]):
        assert pitch < 0.03
        assert height < 0.03
    assert sum(off["commanded", 0]) > 2 * max(sum(off["measured", 0]), sum(off["measured", 2]))


@pytest.fixture(scope="module")
def motion(rearing: Motion, tmp_path_factory: pytest.TempPathFactory) -> Played:
    return played(rearing, tmp_path_factory.mktemp("player"))


@dataclass
class Faulty:
    """Does what it should, but for one fault."""

    motion: Played
    start: np.ndarray | None = None
    freeze_at: int | None = None
    nan_at: int | None = None
    jump_at: int | None = None
    sent: list[tuple[np.ndarray, ...]] = field(default_factory=list)

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        row = len(self.sent) if self.freeze_at is None else min(len(self.sent), self.freeze_at)
        position = self.motion.expected[min(row, len(self.motion.expected) - 1)].copy()
        if self.start is not None:
            position = self.start.copy()
        if self.jump_at is not None and len(self.sent) >= self.jump_at:
            position[2] += 0.6
        if self.nan_at is not None and len(self.sent) >= self.nan_at:
            position[4] = np.nan
        return position, np.zeros(12)

    def write(self, *command: np.ndarray) -> None:
        self.sent.append(command)


def damps(motion: Played, robot: Faulty) -> bool:
    """Whether the last commands are damping and nothing else, for a second."""
    last = robot.sent[-500:]
    return all(
        (kp == 0).all() and (tau == 0).all() and (qd == 0).all() and (kd == motion.kd).all()
        for _, qd, tau, kp, kd in last
    )


def test_it_does_not_begin_far_from_the_start(motion: Played) -> None:
    robot = Faulty(motion, start=motion.start_position + np.eye(12)[7] * 0.6)
    with pytest.raises(Stopped, match=r"lh_hfe is at .* before the ramp: bring it near the start first"):
        play(motion, robot, wait=no_clock)
    assert robot.sent == []  # the robot may stand, held by its own controller


def test_it_does_not_begin_if_the_ramp_did_not_get_there(motion: Played) -> None:
    robot = Faulty(motion, start=motion.start_position + np.eye(12)[2] * 0.4)
    with pytest.raises(Stopped, match=r"lf_kfe .* within 0.3 at 0.000 s"):
        play(motion, robot, ramp=0.1, tolerance=0.3, wait=no_clock)
    assert len(robot.sent) == 50 + 500


def test_it_stops_when_a_joint_is_left_behind(motion: Played) -> None:
    robot = Faulty(motion, freeze_at=20)
    with pytest.raises(Stopped, match=r"_[hk]fe is at .* should be at .* within 0.5 at 0\.\d\d\d s"):
        play(motion, robot, ramp=0.0, wait=no_clock)
    assert 20 < len(robot.sent) - 500 < 120
    assert damps(motion, robot)


def test_it_stops_at_readings_that_are_no_numbers_and_at_exceptions(motion: Played) -> None:
    robot = Faulty(motion, nan_at=10)
    with pytest.raises(Stopped, match="should be 12 numbers"):
        play(motion, robot, ramp=0.0, wait=no_clock)
    assert damps(motion, robot)
    robot = Faulty(motion)

    def interrupted(instant: float) -> float:
        if instant > 0.05:
            raise KeyboardInterrupt
        return 0.0

    with pytest.raises(KeyboardInterrupt):
        play(motion, robot, ramp=0.0, wait=interrupted)
    assert damps(motion, robot)


def test_it_stops_in_the_ramp_and_in_the_hold_too(motion: Played) -> None:
    robot = Faulty(motion, start=motion.start_position, jump_at=200)
    with pytest.raises(Stopped, match=r"lf_kfe .* within 0.3 in the ramp at 0.400 s"):
        play(motion, robot, ramp=0.8, start_tolerance=0.3, wait=no_clock)
    assert len(robot.sent) == 200 + 500
    assert damps(motion, robot)
    for fault, message in (({"nan_at": 160}, "should be 12 numbers"), ({"jump_at": 160}, "in the hold at 0.018 s")):
        robot = Faulty(motion, **fault)
        with pytest.raises(Stopped, match=message):
            play(motion, robot, ramp=0.0, hold=1.0, wait=no_clock)
        assert len(robot.sent) == 160 + 500  # 151 rows, nine of the hold
        assert damps(motion, robot)


@pytest.mark.parametrize("name", ["ramp", "start_tolerance", "tolerance", "hold"])
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1.0])
def test_times_and_tolerances_are_numbers(motion: Played, name: str, value: float) -> None:
    robot = Faulty(motion)
    with pytest.raises(ValueError, match=f"{name}: .* should be a number, 0 or more"):
        play(motion, robot, wait=no_clock, **{name: value})
    assert robot.sent == []


def test_it_stops_when_it_is_late(motion: Played) -> None:
    with pytest.raises(Stopped, match="the loop is 30 ms late; 500 Hz is too fast for it"):
        play(motion, Faulty(motion), ramp=0.0, wait=lambda instant: 0.03 if instant > 0.1 else 0.0)


def test_what_it_sends_is_within_the_limits(motion: Played) -> None:
    narrow = replace(
        motion,
        lower=motion.position.min(axis=0) + 0.02,
        upper=motion.position.max(axis=0) - 0.02,
        torque_limit=np.full(12, 50.0),
    )
    robot = Faulty(motion)
    play(narrow, robot, ramp=0.2, start_tolerance=9.0, tolerance=9.0, wait=no_clock)  # it does not follow the ramp
    position, _, torque = (np.array(values) for values in list(zip(*robot.sent, strict=True))[:3])
    sent = position[100:]
    assert (sent >= narrow.lower).all()
    assert (sent <= narrow.upper).all()
    assert np.abs(torque).max() <= 50.0
    assert (np.abs(motion.torque) > 50.0).any()
    inside = (motion.position > narrow.lower) & (motion.position < narrow.upper)
    np.testing.assert_array_equal(sent[inside], motion.position[inside])


def test_the_ramp_leads_from_where_the_joints_are_and_the_last_row_is_held(motion: Played) -> None:
    robot = StandIn(motion, ramp=0.5)
    first, _ = robot.read()
    commands: list[tuple[np.ndarray, ...]] = []
    write = robot.write
    robot.write = lambda *command: (commands.append(command), write(*command))[1]  # type: ignore[method-assign]
    assert play(motion, robot, ramp=0.5, hold=0.1, wait=no_clock) < 1e-9
    assert len(commands) == 250 + 151 + 50
    position = np.array([command[0] for command in commands])
    assert np.abs(position[0] - first).max() < 1e-4
    np.testing.assert_allclose(position[249], motion.start_position, atol=1e-12)
    assert np.abs(np.diff(position[:250], axis=0)).max() < 0.05 * 2 / 250
    np.testing.assert_allclose(commands[249][2], motion.start_torque, atol=1e-9)
    np.testing.assert_array_equal(position[-50:], np.tile(motion.position[-1], (50, 1)))


def test_without_clamp_positions_go_as_far_out_as_they_were_told(motion: Played) -> None:
    narrow = replace(motion, lower=motion.expected.min(axis=0), upper=motion.expected.max(axis=0))
    assert (narrow.clamped()[0] == motion.position).all()  # measured ones are within: as told beyond is another thing
    out = replace(narrow, position=motion.position + 0.5)
    sent = {}
    for clamp in (True, False):
        robot = Faulty(motion)
        play(out, robot, ramp=0.0, clamp=clamp, wait=no_clock)
        sent[clamp] = np.array([command[0] for command in robot.sent])
    assert (sent[True] <= narrow.upper).all()
    np.testing.assert_array_equal(sent[False], out.position)


def test_the_holding_torque_is_there_after_20_ms_and_the_last_row_stands_still(motion: Played) -> None:
    robot = StandIn(motion, ramp=2.0)
    commands: list[tuple[np.ndarray, ...]] = []
    write = robot.write
    robot.write = lambda *command: (commands.append(command), write(*command))[1]  # type: ignore[method-assign]
    play(motion, robot, ramp=2.0, wait=no_clock)
    torque, velocity = (np.array([command[i] for command in commands]) for i in (2, 1))
    assert np.abs(torque[0]).max() < 0.1 * np.abs(motion.start_torque).max()
    np.testing.assert_allclose(torque[9:1000], np.tile(motion.start_torque, (991, 1)))
    np.testing.assert_array_equal(velocity[1000:-1], motion.velocity[:-1])
    assert np.abs(motion.velocity[-1]).max() > 1.0
    assert (velocity[-1] == 0.0).all()


@pytest.mark.parametrize("ramp", [0.1, 0.5])
def test_a_robot_that_stands_does_not_sink_in_the_ramp(rearing: Motion, tmp_path: Path, ramp: float) -> None:
    """Without the holding torque it would, by 17 mm."""
    robot = Simulated(rearing, lagging=False)
    motion = played(rearing, tmp_path)
    play(motion, robot, ramp=ramp, wait=no_clock)
    height = np.array(robot.states)[: round(ramp * 500) + 1, 2]
    assert np.abs(height - rearing["qpos0"][2]).max() < 0.003


class Careless(Simulated):
    """Gives its own buffers away, and works in those that it is given."""

    def read(self):
        return self.data.qpos[7:], self.data.qvel[6:]

    def write(self, position, velocity, torque, kp, kd) -> None:
        super().write(position, velocity, torque, kp, kd)
        for values in (position, velocity, torque, kp, kd):
            values *= 0.9


@pytest.mark.slow
def test_robots_may_keep_using_their_own_arrays(rearing: Motion, tmp_path: Path) -> None:
    motion, states = played(rearing, tmp_path), []
    for kind in (Simulated, Careless):
        robot = kind(rearing, lagging=False)
        robot.data.qpos[7:] += 0.03 * np.random.default_rng(0).normal(size=12)
        play(motion, robot, ramp=0.5, wait=no_clock)
        states.append(np.array(robot.states))
    np.testing.assert_array_equal(*states)


def test_a_drive_that_knows_no_gains_but_its_own_stays_where_it_is_when_stopped(
    rearing: Motion, tmp_path: Path
) -> None:
    class Stiff(Simulated):
        def write(self, position, velocity, torque, kp, kd) -> None:
            super().write(position, velocity, torque, np.maximum(kp, 1.0), kd)

    class Blinking(Stiff):
        def read(self):
            position, velocity = super().read()
            return (position * np.nan if len(self.states) == 100 else position), velocity

    robot = Blinking(rearing, lagging=True)
    with pytest.raises(Stopped, match="should be 12 numbers"):
        play(played(rearing, tmp_path), robot, ramp=1.0, wait=no_clock)
    height = np.array(robot.states)[:, 2]
    assert len(height) == 100 + 500
    assert np.abs(height - height[100]).max() < 0.03  # at the zero pose legs are straight: 0.3 m higher


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGINT"])
def test_told_to_end_it_leaves_drives_that_damp(rearing: Motion, tmp_path: Path, name: str) -> None:
    export(rearing, "csv", tmp_path)
    (tmp_path / "mine.py").write_text(
        "import json, numpy as np\n"
        "start = np.array(json.load(open('meta.json'))['start']['position'])\n"
        "class Robot:\n"
        "    def read(self): return start, np.zeros(12)\n"
        "    def write(self, position, velocity, torque, kp, kd): print(f'kp {kp[0]:g}', flush=True)\n"
    )
    command = [sys.executable, "player.py", "motion.csv", "--robot", "mine:Robot", "--ramp", "60"]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("kp"):
            break
    process.send_signal(getattr(signal, name))
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "player: stopped: interrupted" in err
    assert out.splitlines()[-500:] == ["kp 0"] * 500


def test_no_tick_comes_before_its_time() -> None:
    wait = clock()
    began = time.perf_counter()
    for tick in range(1, 11):
        wait(tick * 0.002)
        assert time.perf_counter() - began >= (tick - 1) * 0.002 - 1e-4  # the clock begins with the first tick
    time.sleep(0.05)
    assert wait(0.024) > 0.02


@pytest.mark.slow
def test_csv_and_json_hold_the_same(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "csv", tmp_path)
    export(rearing, "json", tmp_path)
    one, two = (Played.load(tmp_path / name) for name in ("motion.csv", "motion.json"))
    for name, value in vars(one).items():
        np.testing.assert_array_equal(value, getattr(two, name), err_msg=name)


BARE = """
import runpy, sys
for name in ("levade", "mujoco", "yaml", "rich"):
    sys.modules[name] = None
sys.argv = ["player.py", *sys.argv[1:]]
runpy.run_path("player.py", run_name="__main__")
"""


@pytest.mark.slow
@pytest.mark.parametrize("to", ["csv", "json", "unitree", "mjlab"])
def test_on_its_own_with_numpy_alone(rearing: Motion, tmp_path: Path, to: str) -> None:
    export(rearing, to, tmp_path)
    name = "motion.json" if to == "json" else "motion.csv"
    command = [sys.executable, "-c", BARE, name, "--dry-run"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "played to the end; largest tracking error" in done.stdout


def test_its_command_line(
    rearing: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    export(rearing, "csv", tmp_path)
    for arguments, message in (
        (["motion.csv"], "give one of --dry-run and --robot"),
        (["motion.csv", "--dry-run", "--ramp", "-1"], "should be numbers, 0 or more"),
        (["motion.csv", "--dry-run", "--tolerance", "nan"], "should be numbers, 0 or more"),
    ):
        with pytest.raises(SystemExit) as exit_:
            main(arguments)
        assert exit_.value.code == 2
        assert message in capsys.readouterr().err
    assert main(["none.csv", "--dry-run"]) == 2
    assert "none.csv" in capsys.readouterr().err
    assert main(["motion.csv", "--robot", "my_robot"]) == 2
    assert "should be MODULE:CLASS" in capsys.readouterr().err
    (tmp_path / "my_robot_here.py").write_text(
        "import numpy as np\n"
        "class Lying:\n"
        "    def read(self): return np.zeros(12), np.zeros(12)\n"
        "    def write(self, *command): pass\n"
    )
    assert main(["motion.csv", "--robot", "my_robot_here:Lying"]) == 1
    assert "stopped: " in capsys.readouterr().err
    lines = (tmp_path / "motion.csv").read_text().splitlines()
    (tmp_path / "motion.csv").write_text("\n".join(lines[:100]) + "\n")
    assert main(["motion.csv", "--dry-run"]) == 2
    assert "not 151 rows of numbers" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("motion.csv", "", "motion.csv: not a whole table; export the motion again"),
        ("motion.csv", "a,b\n1,2\n3", "motion.csv: not a whole table; export the motion again"),
        ("motion.csv", "a,b\n1,2\n", r"motion.csv: has no 'command/lf_haa/position'; give motion.csv or motion.json"),
        ("meta.json", "[]", "motion.csv: it, or a file next to it, is damaged .*; export the motion again"),
    ],
)
def test_files_that_are_not_of_an_export_are_said(
    rearing: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, content: str, message: str
) -> None:
    export(rearing, "csv", tmp_path)
    (tmp_path / name).write_text(content)
    assert main([str(tmp_path / "motion.csv"), "--dry-run"]) == 2
    said = capsys.readouterr().err
    assert re.search(message, said)
    assert said.count("\n") == 1


def test_classes_that_are_no_robots_are_said(
    rearing: Motion, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    export(rearing, "csv", tmp_path)
    (tmp_path / "not_robots.py").write_text(
        "import numpy as np\n"
        "class Wanting:\n    def __init__(self, address): pass\n"
        "class Mute:\n    def read(self): return np.zeros(12), np.zeros(12)\n"
        "class Short(Mute):\n"
        "    def read(self): return np.zeros(12), np.zeros(3)\n"
        "    def write(self, *command): pass\n"
        "class Interrupted(Short):\n    def read(self): raise KeyboardInterrupt\n"
    )
    for kind, status, message in (
        ("Wanting", 2, "--robot not_robots:Wanting: cannot be made (TypeError: "),
        ("Mute", 2, "--robot not_robots:Mute: has no method write; it needs read and write"),
        ("Short", 1, "stopped: the robot reads [0.0, 0.0, 0.0] as velocity; should be 12 numbers"),
        ("Interrupted", 1, "stopped: interrupted"),
    ):
        assert main(["motion.csv", "--robot", f"not_robots:{kind}"]) == status
        assert message in capsys.readouterr().err
