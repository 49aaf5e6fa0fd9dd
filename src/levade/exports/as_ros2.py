"""Export ``ros2``: a bag for ``ros2 bag play`` and Foxglove, and the trajectory in YAML for a JointTrajectoryController.

    bag/metadata.yaml, bag/bag_0.mcap      /joint_trajectory, /joint_states, /tf, /robot_description
    joint_trajectory.yaml                  trajectory_msgs/msg/JointTrajectory

It needs mcap (`pip install 'levade[ros2]'`), not ROS. The bag begins at 1 s after the epoch, so the same motion gives the same
bytes.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from levade.errors import LevadeError
from levade.exports import as_csv, rosmsgs
from levade.exports.content import Content, held
from levade.exports.links import frames_of, links_of
from levade.exports.rosmsgs import NANO
from levade.exports.samples import Samples
from levade.exports.urdf import urdf
from levade.motions import Motion

WORLD = "world"
"""Frame of the trunk's pose."""

_START = NANO
"""Start of the bag [ns]. Some tools read a stamp of zero as "now", others as "latest"."""

_TOPICS = {
    "/robot_description": "std_msgs/msg/String",
    "/joint_trajectory": "trajectory_msgs/msg/JointTrajectory",
    "/joint_states": "sensor_msgs/msg/JointState",
    "/tf": "tf2_msgs/msg/TFMessage",
}
_KEPT = ("/robot_description", "/joint_trajectory")
"""Topics that are sent once, and kept for later subscribers (transient local)."""


def check(motion: Motion) -> None:
    """Check that mcap is installed.

    Args:
        motion: The motion; its content does not matter.

    Raises:
        LevadeError: If mcap is missing.
    """
    try:
        import mcap.writer  # noqa: F401
    except ImportError:
        raise LevadeError("ros2: a bag needs mcap; pip install 'levade[ros2]', or take csv", field="to") from None


def write(content: Content, directory: Path) -> list[str]:
    """Write the bag, the YAML, and the files for playing.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        An empty list: there are no notes for the user.
    """
    bag = directory / "bag"
    bag.mkdir()
    counts = _write_bag(content, bag / "bag_0.mcap")
    times = nanoseconds(content.samples)
    (bag / "metadata.yaml").write_text(_yaml(_metadata(counts, times)), encoding="utf-8")
    head = content.provenance | {"held": held(content.motion)}
    comments = "".join(f"# {key}: {_in_a_line(value)}\n" for key, value in head.items())
    (directory / "joint_trajectory.yaml").write_text(comments + _yaml(_trajectory(content.samples)), encoding="utf-8")
    as_csv.write(content, directory)
    return []


def _in_a_line(value: object) -> str:
    return value if isinstance(value, str) and value.isprintable() else as_csv.to_json(value)


def nanoseconds(samples: Samples) -> list[int]:
    """Return the time of each row from the start.

    Args:
        samples: The rows.

    Returns:
        Times [ns], one for each row.
    """
    return np.rint(samples.time * NANO).astype(np.int64).tolist()


def _efforts(samples: Samples) -> np.ndarray | None:
    """Return the torques to send; None if there are none.

    A JointTrajectoryController without effort interface only takes none.
    """
    return samples.command_torque if samples.reference == "measured" else None


def _messages(content: Content) -> Iterator[tuple[int, str, bytes]]:
    """Yield time [ns], topic and bytes, in the order of time."""
    samples, names = content.samples, content.samples.joints.names
    times = nanoseconds(samples)
    yield (
        _START,
        "/robot_description",
        rosmsgs.string(urdf(content.model, samples.joints, content.motion.robot)),
    )
    yield (
        _START,
        "/joint_trajectory",
        rosmsgs.joint_trajectory(names, times, samples.command_position, samples.command_velocity, _efforts(samples)),
    )
    links = links_of(content.model)
    frames = frames_of(links, samples)
    parents = [WORLD if link.parent is None else links[link.parent].name for link in links]
    children = [link.name for link in links]
    for row, time in enumerate(times):
        stamp = _START + time
        state = samples.joint_position[row], samples.joint_velocity[row], samples.joint_torque[row]
        yield stamp, "/joint_states", rosmsgs.joint_state(stamp, names, *state)
        pose = frames.relative_position[row], frames.relative_quaternion[row]
        yield stamp, "/tf", rosmsgs.tf_message(stamp, parents, children, *pose)


def _write_bag(content: Content, path: Path) -> dict[str, int]:
    """Write the bag. Returns the number of messages of each topic."""
    from mcap.writer import Writer

    counts = dict.fromkeys(_TOPICS, 0)
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="levade")
        schemas = {
            kind: writer.register_schema(name=kind, encoding="ros2msg", data=text.encode())
            for kind, text in rosmsgs.DEFINITIONS.items()
        }
        channels = {
            topic: writer.register_channel(
                topic=topic,
                message_encoding="cdr",
                schema_id=schemas[kind],
                metadata={"offered_qos_profiles": _quality(topic)},
            )
            for topic, kind in _TOPICS.items()
        }
        # every value of an MCAP metadata record is a text
        record = {
            key: value if isinstance(value, str) else as_csv.to_json(value) for key, value in content.provenance.items()
        }
        gains = {name: as_csv.to_json(getattr(content.samples.joints, name).tolist()) for name in ("kp", "kd")}
        joints = {"joints": as_csv.to_json(content.samples.joints.names), "held": as_csv.to_json(held(content.motion))}
        writer.add_metadata("levade", record | gains | joints)
        for time, topic, data in _messages(content):
            writer.add_message(channels[topic], log_time=time, publish_time=time, data=data, sequence=counts[topic])
            counts[topic] += 1
        writer.finish()
    return counts


def _metadata(counts: dict[str, int], times: list[int]) -> dict[str, Any]:
    """Return metadata.yaml in the layout of version 5, which every rosbag2 from Humble on reads."""
    start, duration = {"nanoseconds_since_epoch": _START}, {"nanoseconds": times[-1]}
    total = sum(counts.values())
    return {
        "rosbag2_bagfile_information": {
            "version": 5,
            "storage_identifier": "mcap",
            "duration": duration,
            "starting_time": start,
            "message_count": total,
            "topics_with_message_count": [
                {
                    "topic_metadata": {
                        "name": topic,
                        "type": kind,
                        "serialization_format": "cdr",
                        "offered_qos_profiles": _quality(topic),
                    },
                    "message_count": counts[topic],
                }
                for topic, kind in _TOPICS.items()
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": ["bag_0.mcap"],
            "files": [{"path": "bag_0.mcap", "starting_time": start, "duration": duration, "message_count": total}],
        }
    }


def _quality(topic: str) -> str:
    """Return the quality of service of a topic as YAML: reliable, and transient local or volatile. The numbers are rmw's."""
    ever = {"sec": 9223372036, "nsec": 854775807}
    profile = {
        "history": 1,  # keep last
        "depth": 1 if topic in _KEPT else 100,
        "reliability": 1,
        "durability": 1 if topic in _KEPT else 2,
        "deadline": ever,
        "lifespan": ever,
        "liveliness": 1,
        "liveliness_lease_duration": ever,
        "avoid_ros_namespace_conventions": False,
    }
    return _yaml([profile])


def _trajectory(samples: Samples) -> dict[str, Any]:
    """Return the message as ``ros2 topic pub`` takes it."""
    efforts = _efforts(samples)
    return {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""},
        "joint_names": list(samples.joints.names),
        "points": [
            {
                "positions": samples.command_position[row].tolist(),
                "velocities": samples.command_velocity[row].tolist(),
                "accelerations": [],
                "effort": [] if efforts is None else efforts[row].tolist(),
                "time_from_start": {"sec": time // NANO, "nanosec": time % NANO},
            }
            for row, time in enumerate(nanoseconds(samples))
        ],
    }


class _Plain(yaml.CSafeDumper if yaml.__with_libyaml__ else yaml.SafeDumper):  # type: ignore[misc]
    """Writes YAML without anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _yaml(content: Any) -> str:
    out = io.StringIO()
    yaml.dump(content, out, Dumper=_Plain, default_flow_style=None, sort_keys=False, width=1_000_000)
    return out.getvalue()
