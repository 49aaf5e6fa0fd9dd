"""The bag, read by rosbags, and the trajectory in YAML; definitions against those that rosbags has of ROS itself."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yaml

from levade.errors import LevadeError
from levade.exports import export
from levade.motions import Motion

reason = "bags are written by mcap and read by rosbags: pip install 'levade[dev]'"
pytest.importorskip("mcap", reason=reason)
rosbag2 = pytest.importorskip("rosbags.rosbag2", reason=reason)
from rosbags.typesys import Stores, get_types_from_msg, get_typestore  # noqa: E402

from levade.exports.rosmsgs import DEFINITIONS  # noqa: E402


@pytest.fixture(scope="module")
def exported(rearing: Motion, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("ros2")
    export(rearing, "ros2", directory, command="levade export motion.npz --to ros2")
    return directory


def read(directory: Path) -> dict[str, list]:
    """Topic -> (time, message) of a bag, by the definitions in the bag itself."""
    store = get_typestore(Stores.EMPTY)
    messages: dict[str, list] = {}
    with rosbag2.Reader(directory / "bag") as reader:
        for connection in reader.connections:
            store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        for connection, time, data in reader.messages():
            messages.setdefault(connection.topic, []).append((time, store.deserialize_cdr(data, connection.msgtype)))
    return messages


@pytest.mark.parametrize("name", ["ROS2_HUMBLE", "ROS2_JAZZY", "LATEST"])
@pytest.mark.parametrize("kind", DEFINITIONS)
def test_definitions_are_those_of_ros(name: str, kind: str) -> None:
    theirs = get_typestore(getattr(Stores, name))
    ours = get_types_from_msg(DEFINITIONS[kind], kind)
    assert kind in ours
    for part, (_, fields) in ours.items():
        assert fields == theirs.get_msgdef(part).fields, part
    store = get_typestore(Stores.EMPTY)
    store.register(ours)
    assert store.hash_rihs01(kind) == theirs.hash_rihs01(kind)


def test_the_bag_is_whole(exported: Path) -> None:
    with rosbag2.Reader(exported / "bag") as reader:
        assert reader.message_count == 2 + 2 * 151
        assert reader.duration == 300_000_001  # rosbags counts the last nanosecond
        assert {topic: (info.msgtype, info.msgcount) for topic, info in reader.topics.items()} == {
            "/robot_description": ("std_msgs/msg/String", 1),
            "/joint_trajectory": ("trajectory_msgs/msg/JointTrajectory", 1),
            "/joint_states": ("sensor_msgs/msg/JointState", 151),
            "/tf": ("tf2_msgs/msg/TFMessage", 151),
        }
        for connection in reader.connections:
            (quality,) = connection.ext.offered_qos_profiles
            late = connection.topic in ("/robot_description", "/joint_trajectory")
            assert quality.durability.name == ("TRANSIENT_LOCAL" if late else "VOLATILE")
            assert quality.reliability.name == "RELIABLE"


def test_joint_states_and_trajectory_are_the_motion(rearing: Motion, exported: Path) -> None:
    messages = read(exported)
    states = messages["/joint_states"]
    assert states[0][1].name == rearing["joint_names"].tolist()
    np.testing.assert_array_equal([m.position for _, m in states][1:], rearing["joint_position"])
    np.testing.assert_array_equal([m.velocity for _, m in states][1:], rearing["joint_velocity"])
    np.testing.assert_array_equal([m.effort for _, m in states][:-1], rearing["joint_torque"])
    times = [time for time, _ in states]
    assert times == [1_000_000_000 + k * 2_000_000 for k in range(151)]
    assert [m.header.stamp.sec * 1_000_000_000 + m.header.stamp.nanosec for _, m in states] == times
    ((_, trajectory),) = messages["/joint_trajectory"]
    assert trajectory.joint_names == rearing["joint_names"].tolist()
    assert (trajectory.header.stamp.sec, trajectory.header.stamp.nanosec) == (0, 0)  # starts when it arrives
    np.testing.assert_array_equal([p.positions for p in trajectory.points][1:], rearing["joint_position"])
    np.testing.assert_array_equal([p.velocities for p in trajectory.points][1:], rearing["joint_velocity"])
    np.testing.assert_array_equal([p.effort for p in trajectory.points][:-1], rearing["joint_torque"])
    instants = [p.time_from_start.sec + 1e-9 * p.time_from_start.nanosec for p in trajectory.points]
    np.testing.assert_allclose(instants[1:], rearing["time"], atol=1e-9)


@pytest.mark.slow
def test_transforms_lead_from_the_world_to_every_body(
    rearing: Motion, rearing_model: mujoco.MjModel, exported: Path
) -> None:
    data = mujoco.MjData(rearing_model)
    for row in (0, 74, 149):
        _, message = read(exported)["/tf"][row + 1]
        data.qpos[:] = np.concatenate(
            [rearing[name][row] for name in ("trunk_position", "trunk_quaternion", "joint_position")]
        )
        mujoco.mj_kinematics(rearing_model, data)
        placed = {"world": (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))}
        for transform in message.transforms:
            t, r = transform.transform.translation, transform.transform.rotation
            position, quaternion = np.empty(3), np.empty(4)
            parent = placed[transform.header.frame_id]
            mujoco.mju_mulPose(position, quaternion, *parent, np.array([t.x, t.y, t.z]), np.array([r.w, r.x, r.y, r.z]))
            placed[transform.child_frame_id] = position, quaternion
        assert len(placed) == rearing_model.nbody
        for name, (position, quaternion) in placed.items():
            np.testing.assert_allclose(position, data.body(name).xpos, atol=1e-12)
            np.testing.assert_allclose(abs(quaternion @ data.body(name).xquat), 1.0, atol=1e-12)


def test_the_robot_description_is_a_urdf_with_these_frames(rearing_model: mujoco.MjModel, exported: Path) -> None:
    ((_, message),) = read(exported)["/robot_description"]
    fused = "<mujoco><compiler fusestatic='false'/></mujoco></robot>"
    robot = mujoco.MjModel.from_xml_string(message.data.replace("</robot>", fused))
    assert [robot.body(i).name for i in range(robot.nbody)] == [
        rearing_model.body(i).name for i in range(rearing_model.nbody)
    ]
    assert robot.nu == 0
    assert robot.njnt == 12


def test_provenance_and_gains_are_in_the_bag(exported: Path) -> None:
    reader = importlib.import_module("mcap.reader")
    with (exported / "bag/bag_0.mcap").open("rb") as file:
        opened = reader.make_reader(file)
        assert opened.get_header().profile == "ros2"
        (record,) = opened.iter_metadata()
    assert record.name == "levade"
    assert record.metadata["task"] == "rearing"
    assert record.metadata["command"] == "levade export motion.npz --to ros2"
    assert yaml.safe_load(record.metadata["kp"]) == [600.0] * 12


@pytest.mark.slow
def test_the_trajectory_in_yaml(rearing: Motion, exported: Path, tmp_path: Path) -> None:
    text = (exported / "joint_trajectory.yaml").read_text()
    assert "# task: rearing\n" in text
    message = yaml.safe_load(text)
    store = get_typestore(Stores.LATEST)
    assert list(message) == [name for name, _ in store.get_msgdef("trajectory_msgs/msg/JointTrajectory").fields]
    assert message["joint_names"] == rearing["joint_names"].tolist()
    assert len(message["points"]) == 151
    np.testing.assert_array_equal([p["effort"] for p in message["points"]][:-1], rearing["joint_torque"])
    assert message["points"][-1]["time_from_start"] == {"sec": 0, "nanosec": 300000000}
    # controllers without effort take no effort, and end at rest
    export(rearing, "ros2", tmp_path, reference="commanded")
    plain = yaml.safe_load((tmp_path / "joint_trajectory.yaml").read_text())
    assert all(point["effort"] == [] for point in plain["points"])
    assert set(plain["points"][-1]["velocities"]) == {0.0}
    np.testing.assert_array_equal([p["positions"] for p in plain["points"]][:-1], rearing["ctrl"][:, 0::2])
    ((_, trajectory),) = read(tmp_path)["/joint_trajectory"]
    assert all(len(point.effort) == 0 for point in trajectory.points)


@pytest.mark.slow
def test_a_command_of_several_lines_stays_a_comment(rearing: Motion, tmp_path: Path) -> None:
    export(rearing, "ros2", tmp_path, command="levade export 'a\nb.npz' --to ros2")
    text = (tmp_path / "joint_trajectory.yaml").read_text()
    assert "# command: \"levade export 'a\\nb.npz' --to ros2\"\n" in text
    assert len(yaml.safe_load(text)["points"]) == 151


def test_without_mcap_it_says_what_to_install(rearing: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    with pytest.raises(LevadeError, match=r"to: ros2: a bag needs mcap; pip install 'levade\[ros2\]', or take csv"):
        export(rearing, "ros2", tmp_path / "out")
    assert list(tmp_path.iterdir()) == []
