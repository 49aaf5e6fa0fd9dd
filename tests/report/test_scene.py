"""The page's scene: where the bodies are, what they look like, and how much room it all takes."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest

from levade.motions import Motion
from levade.report.packing import UNIT, pack, pack_unit, unpack
from levade.report.rendering import replay
from levade.report.scene import FRAMES, configurations, force_scale, frame_rows, scene_data
from levade.report.shapes import TRIANGLES, shapes_of, simplify
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


def solved(name: str, *changes: str) -> Motion:
    objective = make_objective(load_task(name, changes=["search.population=8", "search.trials=16", *changes]))
    return record(objective, solve(objective, seed=0), seed=0)


@pytest.fixture(scope="module")
def rearing() -> Motion:
    return solved("rearing", "hold=0.05")


@pytest.fixture(scope="module")
def recovery() -> Motion:
    return solved("posture-recovery", "hold=0.05")


@pytest.fixture(scope="module")
def scene(rearing: Motion) -> dict[str, Any]:
    return scene_data(rearing)


def turn_between(one: Any, other: Any) -> Any:
    """Angle [rad] between the rotations of quaternions (..., 4)."""
    one, other = (q / np.linalg.norm(q, axis=-1, keepdims=True) for q in (one, other))
    sine = np.linalg.norm(one - other * np.sign(np.sum(one * other, axis=-1, keepdims=True)), axis=-1) / 2
    return 4 * np.arcsin(np.minimum(sine, 1))


def kinematics(motion: Motion, model: Any, row: int, joints: str) -> Any:
    """MuJoCo's state at a row of the file, the joints measured or wanted."""
    data = mujoco.MjData(model)
    data.qpos[:3], data.qpos[3:7] = motion["trunk_position"][row], motion["trunk_quaternion"][row]
    for name, angle in zip(motion["joint_names"], motion[joints][row], strict=True):
        data.joint(str(name)).qpos[0] = angle
    mujoco.mj_forward(model, data)
    return data


@pytest.mark.slow
def test_every_pose_is_what_forward_kinematics_says(rearing: Motion, scene: dict[str, Any]) -> None:
    model, moving = rearing.compiled(), scene["motion"]
    rows = [round(time / rearing.meta["timestep"]) for time in unpack(moving["time"])]
    position, quaternion = unpack(moving["position"]), unpack(moving["quaternion"]) / UNIT
    wanted = moving["reference"]
    for frame, row in enumerate(rows[1:], start=1):
        data = kinematics(rearing, model, row - 1, "joint_position")
        bodies = [data.body(name) for name in scene["model"]["bodies"]]
        np.testing.assert_allclose(position[frame], [body.xpos for body in bodies], atol=1e-6)
        assert turn_between(quaternion[frame], np.roll([body.xquat for body in bodies], -1, axis=-1)).max() < 8e-5
        data = kinematics(rearing, model, row - 1, "joint_position_reference")
        legs = [data.body(scene["model"]["bodies"][place]).xpos for place in wanted["bodies"]]
        np.testing.assert_allclose(unpack(wanted["position"])[frame], legs, atol=1e-6)


def test_the_legs_have_a_reference_and_the_trunk_does_not(scene: dict[str, Any]) -> None:
    names = scene["model"]["bodies"]
    assert [names[place] for place in scene["motion"]["reference"]["bodies"]] == [n for n in names if n != "trunk"]


def test_start_horizon_and_end_are_kept_and_poses_do_not_jump(rearing: Motion, scene: dict[str, Any]) -> None:
    time = unpack(scene["motion"]["time"])
    assert time[0] == 0.0
    assert time[-1] == np.float32(rearing["time"][-1])
    assert np.float32(rearing["time"][rearing.horizon_steps - 1]) in time
    np.testing.assert_array_equal(
        unpack(scene["motion"]["position"])[-1, 0], rearing["trunk_position"][-1].astype(np.float32)
    )
    start = unpack(scene["motion"]["position"])[0, 0]
    np.testing.assert_array_equal(start, rearing["qpos0"][:3].astype(np.float32))
    quaternion = unpack(scene["motion"]["quaternion"]).astype(float)
    assert (np.sum(quaternion[1:] * quaternion[:-1], axis=-1) > 0).all()  # the short way round


@pytest.mark.parametrize(("steps", "horizon", "timestep"), [(150, 150, 0.002), (301, 150, 0.001), (10**5, 99, 1e-4)])
def test_frames_are_few_and_even(steps: int, horizon: int, timestep: float) -> None:
    rows = frame_rows(steps, horizon, timestep)
    assert {0, horizon, steps} <= set(rows.tolist())
    assert len(rows) <= min(FRAMES, math.ceil(250 * steps * timestep)) + 3
    assert np.diff(rows).min() > 0
    assert np.diff(rows).max() <= max(math.ceil(1 / (250 * timestep)), math.ceil(steps / FRAMES))


def test_configurations_are_the_replayed_ones(rearing: Motion) -> None:
    """What was recorded is used: on another platform a replay may go elsewhere. Here both are the same."""
    model = rearing.compiled()
    np.testing.assert_array_equal(configurations(rearing, model), replay(rearing).qpos)


def test_a_motion_that_broke_down_stays_where_it_last_was(rearing: Motion) -> None:
    broken = {name: array.copy() for name, array in rearing.arrays.items()}
    for name in ("trunk_position", "joint_position", "trunk_com_position", "foot_contact_force"):
        broken[name][40:] = np.nan
    moving = scene_data(replace(rearing, arrays=broken))["motion"]
    position = unpack(moving["position"])
    assert np.isfinite(position).all()
    assert np.isfinite(unpack(moving["path"])).all()
    np.testing.assert_array_equal(position[-1], position[20])
    assert moving["goal"] is None


def test_forces_start_at_the_feet(rearing: Motion, scene: dict[str, Any]) -> None:
    moving, model = scene["motion"], rearing.compiled()
    rows = [round(time / rearing.meta["timestep"]) for time in unpack(moving["time"])]
    forces = unpack(moving["forces"]["force"])
    np.testing.assert_array_equal(forces[1:], rearing["foot_contact_force"][np.array(rows[1:]) - 1].astype(np.float32))
    data = kinematics(rearing, model, -1, "joint_position")
    for foot, leg in zip(moving["forces"]["feet"], rearing.meta["legs"].values(), strict=True):
        body = data.body(scene["model"]["bodies"][foot["body"]])
        place = body.xpos + body.xmat.reshape(3, 3) @ foot["centre"]
        np.testing.assert_allclose(place, data.geom(leg["foot"]).xpos, atol=1e-6)


@pytest.mark.parametrize("force", [1.0, 17.0, 790.0, 9.99e5])
def test_a_metre_of_arrow_is_a_round_number_of_newtons(force: float) -> None:
    scale = force_scale(force, 0.5)
    assert force / scale <= 0.5 * (1 + 1e-9)
    assert force / scale > 0.5 / 1.7
    assert scale / 10 ** math.floor(math.log10(scale)) in (1, 1.5, 2, 3, 5, 7)


def test_the_goal_is_a_box_round_the_trunk_where_it_should_be(rearing: Motion, scene: dict[str, Any]) -> None:
    """HyQ2Max's trunk collides as a box about its frame's origin: put there, it is the goal's box."""
    goal, model = scene["motion"]["goal"], rearing.compiled()
    assert goal["centre"][2] == 0.9
    x, y, z, w = goal["quaternion"]
    assert math.asin(2 * (w * y - x * z)) == pytest.approx(-1.0472, abs=1e-5)
    frame, size = np.empty(9), model.geom("trunk").size
    mujoco.mju_quat2Mat(frame, np.array([w, x, y, z]))
    origin = np.array(goal["centre"]) - frame.reshape(3, 3) @ rearing.meta["trunk_com_offset"]
    np.testing.assert_allclose(goal["box"], origin, atol=0.005)  # the looks reach a little farther in front
    np.testing.assert_allclose(goal["half"], size, atol=0.01)
    assert scene["layers"][4]["label"] == "goal (pitch \N{MINUS SIGN}60°, height 0.9 m)"


def test_layers_are_those_that_there_is_something_of(rearing: Motion, scene: dict[str, Any]) -> None:
    names = [layer["name"] for layer in scene["layers"]]
    assert names == ["robot", "reference", "path", "forces", "goal", "collision"]
    other = {"success": {"speed": {"target": 0, "tolerance": 1}}, "stages": [{"name": "full"}]}
    meta = {**rearing.meta, "task": {**rearing.meta["task"], **other}}
    assert "goal" not in [layer["name"] for layer in scene_data(replace(rearing, meta=meta))["layers"]]


def test_looks_and_collision_shapes_are_told_apart(rearing: Motion, recovery: Motion, scene: dict[str, Any]) -> None:
    model = rearing.compiled()
    group = {"robot": 2, "collision": 3}
    for layer, number in group.items():
        drawn = [geom for geom in scene["model"]["geoms"] if geom["layer"] == layer]
        assert len(drawn) == int(np.sum((model.geom_group == number) & (model.geom_bodyid != 0)))
    assert [geom["type"] for geom in scene["model"]["geoms"] if geom["layer"] == "ground"] == ["plane"]
    (box,) = [geom for geom in scene_data(recovery)["model"]["geoms"] if geom["layer"] == "scene"]
    assert (box["type"], box["size"], box["pos"]) == ("box", [0.45, 0.15, 0.125], [0.0, 0.35, 0.125])


def test_small_and_the_same_every_time(rearing: Motion, recovery: Motion, scene: dict[str, Any]) -> None:
    assert json.dumps(scene, allow_nan=False) == json.dumps(scene_data(rearing))
    assert len(json.dumps(scene)) < 150_000
    assert scene["model"]["key"] == shapes_of(rearing.compiled())["key"]
    assert scene["model"]["key"] != scene_data(recovery)["model"]["key"]


@pytest.mark.slow
def test_a_motion_of_three_seconds_takes_less_than_a_megabyte() -> None:
    motion = solved("rearing", "horizon=3 s")
    assert len(motion["time"]) == 1500
    assert len(json.dumps(scene_data(motion))) < 1_000_000


MESHES = """
<mujoco>
  <asset>
    <mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
    <hfield name="hills" nrow="2" ncol="3" size="3 2 1 0.1" elevation="0 0 0  1 1 0.5"/>
    <material name="red" rgba="1 0 0 1" specular="0" shininess="0"/>
  </asset>
  <worldbody>
    <geom type="hfield" hfield="hills" pos="0 0 -1"/>
    <body name="a" pos="0 0 1">
      <freejoint/>
      <geom type="mesh" mesh="wedge" material="red"/>
      <geom type="mesh" mesh="wedge" pos="0 0 1"/>
      <geom type="sphere" size="0.1" group="3"/>
      <body name="b"><geom type="capsule" size="0.1 0.3" pos="0 2 0"/><joint axis="1 0 0"/></body>
    </body>
  </worldbody>
</mujoco>
"""


def test_meshes_and_height_fields_become_triangles_once() -> None:
    model = mujoco.MjModel.from_xml_string(MESHES)
    shapes = shapes_of(model)
    assert [geom["type"] for geom in shapes["geoms"]] == ["mesh", "mesh", "mesh", "sphere", "capsule"]
    assert [geom["layer"] for geom in shapes["geoms"]] == ["scene", "robot", "robot", "collision", "robot"]
    assert len(shapes["meshes"]) == 2
    hills, wedge = (
        np.array(mesh["low"]) + np.array(mesh["scale"]) * unpack(mesh["vertices"]) for mesh in shapes["meshes"]
    )
    assert (hills.min(axis=0), hills.max(axis=0)) == (pytest.approx([-3, -2, 0]), pytest.approx([3, 2, 1]))
    one, two, three = (hills[unpack(shapes["meshes"][0]["faces"])[:, corner]] for corner in range(3))
    assert (np.cross(two - one, three - one)[:, 2] > 0).all()  # seen from above
    order = np.lexsort(wedge.T)
    start = model.mesh_vert[: len(wedge)]
    np.testing.assert_allclose(wedge[order], start[np.lexsort(start.T)], atol=2e-5)
    colours = [shapes["materials"][geom["material"]]["color"] for geom in shapes["geoms"]]
    assert colours[1] == "#ff0000"
    assert colours[2] != colours[4]  # two greys in turn, where there is no colour


def test_large_meshes_keep_their_form_with_fewer_triangles() -> None:
    """A sphere of 130 000 triangles."""
    n = 256
    across, along = np.meshgrid(np.linspace(0, 2 * np.pi, n, endpoint=False), np.linspace(0, np.pi, n), indexing="ij")
    points = np.stack([np.sin(along) * np.cos(across), np.sin(along) * np.sin(across), np.cos(along)], axis=-1)
    i, k = np.meshgrid(np.arange(n), np.arange(n - 1), indexing="ij")
    corner, right = (i * n + k).ravel(), (((i + 1) % n) * n + k).ravel()
    faces = np.concatenate(
        [np.stack([corner, corner + 1, right], axis=1), np.stack([right, corner + 1, right + 1], axis=1)]
    )
    ((vertices, kept),) = simplify([(points.reshape(-1, 3), faces)], 20_000)
    assert 8_000 < len(kept) <= 20_000
    assert np.abs(np.linalg.norm(vertices, axis=1) - 1).max() < 0.01
    one, two, three = (vertices[kept[:, corner]] for corner in range(3))
    volume = np.sum(one * np.cross(two, three)) / 6
    assert abs(volume) == pytest.approx(4 / 3 * np.pi, rel=0.01)
    assert TRIANGLES >= 20_000


def test_packing_is_exact() -> None:
    for dtype, values in (("f4", [0.1, -3e8]), ("i2", [-32768, 32767]), ("u2", [65535]), ("u4", [2**32 - 1])):
        np.testing.assert_array_equal(unpack(pack(np.array(values), dtype)), np.array(values).astype(dtype))
    unit = np.linspace(-1, 1, 77)
    assert np.abs(unpack(pack_unit(unit)) / UNIT - unit).max() <= 0.5 / UNIT + 1e-12
    with pytest.raises(ValueError, match="between -1 and 1"):
        pack_unit(np.array([1.01]))
