"""Links and frames against MuJoCo's own kinematics; the URDF against MuJoCo's own reading of it."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest

from levade.export.links import body_frames, frames_of, links_of
from levade.export.samples import Joints, Samples, sample
from levade.export.urdf import urdf
from levade.motions import Motion

ODD = """
<mujoco><compiler angle="radian"/><worldbody><body name="trunk" pos="0 0 1"><freejoint/><geom type="box" size=".3 .1 .05"/>
  <body name="hip" pos=".2 .1 0" euler=".3 -.2 .5">
    <joint name="one" axis="1 0 0" pos=".01 .02 -.03" ref=".4" range="-1 1.2" damping="2" frictionloss=".5"/>
    <joint name="two" axis="0 .6 .8" pos="-.02 .04 .05" range="-2 2"/>
    <geom type="capsule" size=".03 .1" pos="0 0 -.1" euler="0 .3 0"/>
    <body name="pad" pos="0 .1 -.1" euler="0 0 1"><geom type="sphere" size=".04"/>
      <body name="toe" pos="0 0 -.2"><joint name="three" axis="0 0 1"/><geom type="cylinder" size=".02 .05"/></body></body>
  </body></body></worldbody></mujoco>"""


def random_samples(model: mujoco.MjModel, like: Samples, rows: int = 7) -> tuple[Samples, list[mujoco.MjData]]:
    """Random states of a model whose first joint is free, and what MuJoCo makes of each."""
    random = np.random.default_rng(0)
    names = tuple(model.joint(i).name for i in range(1, model.njnt))
    qpos, qvel = random.normal(size=(rows, model.nq)), random.normal(size=(rows, model.nv))
    qpos[:, 3:7] /= np.linalg.norm(qpos[:, 3:7], axis=1, keepdims=True)
    states = []
    for position, velocity in zip(qpos, qvel, strict=True):
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:] = position, velocity
        mujoco.mj_forward(model, data)
        states.append(data)
    none = np.full(len(names), np.inf)
    limited = model.jnt_limited[1:].astype(bool)
    lower, upper = (np.where(limited, model.jnt_range[1:, i], bound) for i, bound in ((0, -np.inf), (1, np.inf)))
    joints = Joints(names, none, none, lower, upper, none, none, none, none)
    return (
        replace(
            like,
            time=np.arange(rows) * 0.1,
            joints=joints,
            joint_position=qpos[:, 7:],
            joint_velocity=qvel[:, 6:],
            trunk_position=qpos[:, :3],
            trunk_quaternion=qpos[:, 3:7],
            trunk_linear_velocity=qvel[:, :3],
            trunk_angular_velocity=np.array(
                [d.body(1).xmat.reshape(3, 3) @ v[3:6] for d, v in zip(states, qvel, strict=True)]
            ),
        ),
        states,
    )


@pytest.fixture
def like(rearing: Motion, rearing_model: mujoco.MjModel) -> Samples:
    return sample(rearing, rearing_model, rate=100.0)


def models(rearing: Motion) -> list[mujoco.MjModel]:
    return [mujoco.MjModel.from_xml_string(xml) for xml in (rearing.model_xml, ODD)]


def test_bodies_are_where_mujoco_has_them_and_move_as_it_says(rearing: Motion, like: Samples) -> None:
    for model in models(rearing):
        samples, states = random_samples(model, like)
        links = links_of(model)
        found = body_frames(links, frames_of(links, samples))
        assert [link.name for link in links if link.body is not None] == [
            model.body(i).name for i in range(1, model.nbody)
        ]
        for row, data in enumerate(states):
            np.testing.assert_allclose(found.position[row], data.xpos[1:], atol=1e-12)
            same = np.abs(np.sum(found.quaternion[row] * data.xquat[1:], axis=1))
            np.testing.assert_allclose(same, 1.0, atol=1e-12)
            for body in range(1, model.nbody):
                velocity = np.empty(6)
                mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, 0)
                np.testing.assert_allclose(found.angular_velocity[row, body - 1], velocity[:3], atol=1e-12)
                np.testing.assert_allclose(found.linear_velocity[row, body - 1], velocity[3:], atol=1e-12)


def test_each_frame_is_its_parents_and_what_is_between(rearing: Motion, like: Samples) -> None:
    for model in models(rearing):
        samples, _ = random_samples(model, like)
        links = links_of(model)
        frames = frames_of(links, samples)
        for i, link in enumerate(links):
            if link.parent is None:
                continue
            position, quaternion = np.empty(3), np.empty(4)
            for row in range(len(samples.time)):
                mujoco.mju_mulPose(
                    position,
                    quaternion,
                    frames.position[row, link.parent],
                    frames.quaternion[row, link.parent],
                    frames.relative_position[row, i],
                    frames.relative_quaternion[row, i],
                )
                np.testing.assert_allclose(position, frames.position[row, i], atol=1e-12)
                np.testing.assert_allclose(quaternion, frames.quaternion[row, i], atol=1e-12)


def test_mujoco_reads_the_same_robot_from_the_urdf(rearing: Motion, like: Samples) -> None:
    for model in models(rearing):
        samples, states = random_samples(model, like)
        if model.njnt == 13:
            samples = replace(samples, joints=like.joints)
        text = urdf(model, samples.joints, "robot")
        # MuJoCo wants mass where something turns: between two hinges of one body there is none
        kept = '<mujoco><compiler fusestatic="false" boundmass="1e-12" boundinertia="1e-12"/></mujoco></robot>'
        spec = mujoco.MjSpec.from_string(text.replace("</robot>", kept))
        spec.worldbody.first_body().add_freejoint()
        read = spec.compile()
        data = mujoco.MjData(read)
        for row, of in enumerate(states):
            data.qpos[:3], data.qpos[3:7] = samples.trunk_position[row], samples.trunk_quaternion[row]
            for name, angle in zip(samples.joints.names, samples.joint_position[row], strict=True):
                data.joint(name).qpos[0] = angle
            mujoco.mj_forward(read, data)
            np.testing.assert_allclose(data.subtree_com[1], of.subtree_com[1], atol=1e-9)
            for body in range(1, model.nbody):
                name = model.body(body).name
                np.testing.assert_allclose(data.body(name).xipos, of.body(name).xipos, atol=1e-9)
                turned = (
                    data.body(name).ximat.reshape(3, 3)
                    * read.body(name).inertia
                    @ data.body(name).ximat.reshape(3, 3).T
                )
                meant = (
                    of.body(name).ximat.reshape(3, 3) * model.body(name).inertia @ of.body(name).ximat.reshape(3, 3).T
                )
                np.testing.assert_allclose(turned, meant, atol=1e-9)
        np.testing.assert_allclose(read.body_mass.sum(), model.body_mass.sum(), rtol=1e-9)
        for name, lower, upper in zip(samples.joints.names, samples.joints.lower, samples.joints.upper, strict=True):
            if np.isfinite(lower):
                np.testing.assert_allclose(read.joint(name).range, [lower, upper], atol=1e-9)
            assert read.joint(name).damping[0] == pytest.approx(model.joint(name).damping[0])


def test_the_urdf_has_limits_and_shapes(like: Samples, rearing_model: mujoco.MjModel) -> None:
    root = ElementTree.fromstring(urdf(rearing_model, like.joints, "hyq2max"))
    assert root.get("name") == "hyq2max"
    limit = root.find("joint[@name='lf_hfe']/limit")
    assert limit is not None
    assert {key: float(value) for key, value in limit.items()} == pytest.approx(
        {"lower": -2.35619, "upper": 2.35619, "effort": 245.0, "velocity": 12.0}
    )
    assert len(root.findall("joint[@type='revolute']")) == 12
    for role in ("visual", "collision"):
        assert root.findall(f"link[@name='lf_lower']/{role}/geometry")
    foot = root.findall("link[@name='lf_lower']/collision/geometry/sphere")
    assert foot, "a foot is a ball"


def test_a_mesh_is_the_box_round_it_and_a_link_with_no_visible_geoms_shows_those_that_collide(
    rearing: Motion, like: Samples
) -> None:
    spec = mujoco.MjSpec.from_string(rearing.model_xml)
    corners = np.array([[0, 0, 0], [0.3, 0, 0], [0, 0.2, 0], [0, 0, 0.1]], dtype=float)
    spec.add_mesh(name="wedge", uservert=corners.ravel().tolist())
    place, turn = np.array([0.1, -0.2, 0.3]), np.array([0.8, 0.0, 0.6, 0.0])
    body = spec.body("lf_hip")
    for geom in body.geoms:
        spec.delete(geom)
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="wedge", pos=place, quat=turn, group=3)
    model = spec.compile()
    root = ElementTree.fromstring(urdf(model, like.joints, "robot"))
    link = root.find("link[@name='lf_hip']")
    assert link is not None
    (visual,), (collision,) = link.findall("visual"), link.findall("collision")
    boxes = []
    for part in (visual, collision):
        origin, box = part.find("origin"), part.find("geometry/box")
        assert origin is not None
        assert box is not None
        boxes.append(
            (*(np.array(origin.get(key, "").split(), dtype=float) for key in ("xyz", "rpy")), box.get("size", ""))
        )
    np.testing.assert_array_equal(boxes[0][0], boxes[1][0])
    (middle, angles, size), turned = boxes[0], np.zeros(4)
    mujoco.mju_euler2Quat(turned, angles, "XYZ")  # about fixed axes, as in URDF
    matrix, given = np.zeros(9), np.zeros(9)
    mujoco.mju_quat2Mat(matrix, turned)
    mujoco.mju_quat2Mat(given, turn)
    inside = (place + corners @ given.reshape(3, 3).T - middle) @ matrix.reshape(3, 3)
    half = np.array(size.split(), dtype=float) / 2
    np.testing.assert_allclose(inside.max(axis=0), half, atol=1e-6)
    np.testing.assert_allclose(inside.min(axis=0), -half, atol=1e-6)
