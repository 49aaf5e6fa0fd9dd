"""ROS 2 messages: their definitions, as rosbag2 keeps them in a bag, and their bytes (CDR, little endian).

The definitions are those of common_interfaces, geometry2 and rcl_interfaces, without comments. They are the same in Humble and
Jazzy.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np

from levade.arrays import Array

_TIME = "int32 sec\nuint32 nanosec\n"
_HEADER = "builtin_interfaces/Time stamp\nstring frame_id\n"
_PARTS = {
    "builtin_interfaces/Time": _TIME,
    "builtin_interfaces/Duration": _TIME,
    "std_msgs/Header": _HEADER,
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/Transform": "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
    "geometry_msgs/TransformStamped": (
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"
    ),
    "trajectory_msgs/JointTrajectoryPoint": (
        "float64[] positions\nfloat64[] velocities\nfloat64[] accelerations\nfloat64[] effort\n"
        "builtin_interfaces/Duration time_from_start\n"
    ),
}


def _definition(text: str, *parts: str) -> str:
    return "".join([text, *(f"{'=' * 80}\nMSG: {part}\n{_PARTS[part]}" for part in parts)])


DEFINITIONS = {
    "std_msgs/msg/String": _definition("string data\n"),
    "sensor_msgs/msg/JointState": _definition(
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n",
        *("std_msgs/Header", "builtin_interfaces/Time"),
    ),
    "tf2_msgs/msg/TFMessage": _definition(
        "geometry_msgs/TransformStamped[] transforms\n",
        *("geometry_msgs/TransformStamped", "std_msgs/Header", "builtin_interfaces/Time"),
        *("geometry_msgs/Transform", "geometry_msgs/Vector3", "geometry_msgs/Quaternion"),
    ),
    "trajectory_msgs/msg/JointTrajectory": _definition(
        "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint[] points\n",
        *("std_msgs/Header", "builtin_interfaces/Time"),
        *("trajectory_msgs/JointTrajectoryPoint", "builtin_interfaces/Duration"),
    ),
}
"""Message type -> its definition and those of its parts, in the form ``ros2msg``."""

NANO = 1_000_000_000


class _Bytes:
    """Encodes CDR: values in sequence, each aligned to its size, counted from the end of the four header bytes."""

    def __init__(self) -> None:
        self.data = bytearray(b"\x00\x01\x00\x00")

    def number(self, kind: str, value: float) -> None:
        self._align(struct.calcsize(kind))
        self.data += struct.pack(f"<{kind}", value)

    def text(self, value: str) -> None:
        encoded = value.encode() + b"\x00"
        self.number("I", len(encoded))
        self.data += encoded

    def texts(self, values: Sequence[str]) -> None:
        self.number("I", len(values))
        for value in values:
            self.text(value)

    def doubles(self, values: Array) -> None:
        """Add a float64[] of any length."""
        self.number("I", len(values))
        if len(values):
            self.fixed(values)

    def fixed(self, values: Array) -> None:
        self._align(8)
        self.data += np.asarray(values, dtype="<f8").tobytes()

    def time(self, nanoseconds: int) -> None:
        self.number("i", nanoseconds // NANO)
        self.number("I", nanoseconds % NANO)

    def header(self, nanoseconds: int, frame: str) -> None:
        self.time(nanoseconds)
        self.text(frame)

    def _align(self, size: int) -> None:
        self.data += b"\x00" * (-(len(self.data) - 4) % size)


def string(text: str) -> bytes:
    """Encode a std_msgs/msg/String.

    Args:
        text: The text.

    Returns:
        The message in CDR.
    """
    out = _Bytes()
    out.text(text)
    return bytes(out.data)


def joint_state(stamp: int, names: Sequence[str], position: Array, velocity: Array, effort: Array) -> bytes:
    """Encode a sensor_msgs/msg/JointState.

    Args:
        stamp: Time stamp [ns].
        names: Names of the joints.
        position: Positions [rad], shape (joints,).
        velocity: Velocities [rad/s], shape (joints,).
        effort: Torques [Nm], shape (joints,).
    """
    out = _Bytes()
    out.header(stamp, "")
    out.texts(names)
    for values in (position, velocity, effort):
        out.doubles(values)
    return bytes(out.data)


def tf_message(
    stamp: int, frames: Sequence[str], children: Sequence[str], positions: Array, quaternions: Array
) -> bytes:
    """Encode a tf2_msgs/msg/TFMessage.

    Args:
        stamp: Time stamp [ns].
        frames: Names of the parent frames.
        children: Names of the child frames.
        positions: (n, 3) [m].
        quaternions: (n, 4), w-x-y-z, of children in frames.
    """
    out = _Bytes()
    out.number("I", len(children))
    for frame, child, position, quaternion in zip(frames, children, positions, quaternions, strict=True):
        out.header(stamp, frame)
        out.text(child)
        out.fixed(position)
        out.fixed(quaternion[[1, 2, 3, 0]])
    return bytes(out.data)


def joint_trajectory(
    names: Sequence[str], times: Sequence[int], positions: Array, velocities: Array, efforts: Array | None
) -> bytes:
    """Encode a trajectory_msgs/msg/JointTrajectory that starts when it arrives.

    Args:
        names: Names of the joints.
        times: Times from the start [ns].
        positions: Positions [rad], shape (rows, joints).
        velocities: Velocities [rad/s], shape (rows, joints).
        efforts: Torques [Nm], shape (rows, joints); None for none.
    """
    out = _Bytes()
    out.header(0, "")
    out.texts(names)
    out.number("I", len(times))
    none = np.zeros(0)
    for i, instant in enumerate(times):
        out.doubles(positions[i])
        out.doubles(velocities[i])
        out.doubles(none)
        out.doubles(none if efforts is None else efforts[i])
        out.time(instant)
    return bytes(out.data)
