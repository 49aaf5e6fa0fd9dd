"""ODE on models of a few bodies, against closed forms and MuJoCo's own simulation of the same model."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from levade.engines import Ode
from levade.engines.ode.library import load
from levade.engines.ode.multibody import multibody_of
from levade.engines.ode.simulation import Record, Simulation
from levade.errors import LevadeError

try:
    load()
except LevadeError as missing:
    pytest.skip(str(missing), allow_module_level=True)

H = 0.002
G = 9.81
GAZEBO, EXACT = Ode(), Ode(solver="exact")


def model_of(body: str, *, world: str = "", option: str = "", more: str = "") -> mujoco.MjModel:
    """A free body called trunk with what is in it, and a ground. Friction 0.5 everywhere."""
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco>
        <option timestep="{H}" integrator="implicitfast" cone="elliptic" impratio="10" {option}/>
        <default><geom friction="0.5 0.005 0.0001"/><joint damping="0"/></default>
        <worldbody>
          <geom name="ground" type="plane" size="0 0 1"/>{world}
          <body name="trunk" pos="0 0 1"><freejoint/>{body}</body>
        </worldbody>{more}
        </mujoco>"""
    )


def simulate(
    model: mujoco.MjModel, steps: int, *, qpos=None, qvel=None, target=None, settings: Ode = GAZEBO, **forces
) -> Record:
    """One trial; target: (steps, J) [rad] of the hinges, at rest."""
    run = Simulation(multibody_of(model), settings, model.opt.timestep)
    joints = len(run.multibody.hinges.names)
    position = np.zeros((1, steps, joints)) if target is None else np.asarray(target, dtype=float)[None]
    start = (model.qpos0 if qpos is None else np.array(qpos, dtype=float), np.zeros(model.nv), np.zeros(model.na))
    start[1][:] = 0 if qvel is None else qvel
    return run.run(*(part[None] for part in start), position, np.zeros_like(position), **forces)


def in_mujoco(model: mujoco.MjModel, steps: int, *, qpos, qvel) -> np.ndarray:
    """(steps, nq)"""
    data, rows = mujoco.MjData(model), []
    data.qpos[:], data.qvel[:] = qpos, qvel
    for _ in range(steps):
        mujoco.mj_step(model, data)
        rows.append(data.qpos.copy())
    return np.array(rows)


BOX = '<geom name="box" type="box" size="0.2 0.15 0.1" mass="10"/>'


@pytest.mark.parametrize("precision", [1e-9])
def test_free_fall(precision: float) -> None:
    """Position after k steps of symplectic Euler: z0 + v h k - g h^2 k (k + 1) / 2; both engines have it."""
    model = model_of(BOX)
    qpos, qvel = [0, 0, 50, 1, 0, 0, 0], [1.0, -2.0, 3.0, 0, 0, 0]
    out = simulate(model, 400, qpos=qpos, qvel=qvel)
    k = np.arange(1, 401)
    z = 50 + 3 * H * k - G * H**2 * k * (k + 1) / 2
    expected = np.stack([H * k, -2 * H * k, z], axis=1)
    scale = 1 if load().dtype == np.float64 else 1e5
    np.testing.assert_allclose(out.position[0], expected, rtol=0, atol=precision * scale)
    np.testing.assert_allclose(in_mujoco(model, 400, qpos=qpos, qvel=qvel)[:, :3], expected, rtol=0, atol=precision)


SLIDERS = {
    "box": BOX,
    "mesh": '<geom name="box" type="mesh" mesh="cuboid" mass="10"/>',
    "four spheres": "".join(
        f'<geom type="sphere" size="0.05" pos="{x} {y} -0.05" mass="2.5"/>' for x in (-0.2, 0.2) for y in (-0.15, 0.15)
    ),
    "two capsules": "".join(
        f'<geom type="capsule" size="0.05 0.2" pos="0 {y} -0.05" euler="0 90 0" mass="5"/>' for y in (-0.15, 0.15)
    ),
}
CUBOID = """<asset><mesh name="cuboid" vertex="-.2 -.15 -.1  .2 -.15 -.1  -.2 .15 -.1  .2 .15 -.1
    -.2 -.15 .1  .2 -.15 .1  -.2 .15 .1  .2 .15 .1"/></asset>"""


@pytest.mark.parametrize("shape", SLIDERS)
def test_a_block_slides_to_rest_as_coulomb_has_it(shape: str) -> None:
    """v^2 / (2 mu g) = 0.408 m from 2 m/s, after v / (mu g) = 0.408 s. The first step already brakes, so a path that is
    shorter by v h / 2 = 2 mm is exact; contacts that sink in add as much again.
    """
    model = model_of(SLIDERS[shape], more=CUBOID if shape == "mesh" else "")
    qpos, qvel = [0, 0, 0.1, 1, 0, 0, 0], [2.0, 0, 0, 0, 0, 0]
    out = simulate(model, 300, qpos=qpos, qvel=qvel, soles=[[1]])
    path = 2.0**2 / (2 * 0.5 * G)
    assert out.position[0, -1, 0] == pytest.approx(path, abs=0.006)
    assert out.position[0, -1, 0] == pytest.approx(in_mujoco(model, 300, qpos=qpos, qvel=qvel)[-1, 0], abs=0.008)
    assert np.abs(out.linear[0, 210:]).max() < 0.02  # at rest after 204 steps
    assert np.abs(out.position[0, :, 1]).max() < 0.005
    assert out.position[0, -1, 2] == pytest.approx(0.1, abs=0.0015)  # sunk in by the surface layer
    if shape in ("box", "mesh"):
        force = out.geom_force[0, 20:190, 0].mean(axis=0)
        np.testing.assert_allclose(force, [-0.5 * 10 * G, 0, 10 * G], rtol=0, atol=1.0)


def test_mujoco_s_rule_decides_which_friction_counts() -> None:
    """The larger of the two coefficients, unless one geom has priority."""
    for mine, expected in (
        ('friction="0.2 0 0"', 0.5),
        ('friction="0.8 0 0"', 0.8),
        ('friction="0.2 0 0" priority="1"', 0.2),
    ):
        model = model_of(f'<geom name="box" type="box" size="0.2 0.15 0.1" mass="10" {mine}/>')
        out = simulate(model, 50, qpos=[0, 0, 0.1, 1, 0, 0, 0], qvel=[2.0, 0, 0, 0, 0, 0])
        assert (2.0 - out.linear[0, -1, 0]) / (50 * H) == pytest.approx(expected * G, rel=0.03)


def pendulum(joint: str = "", inertia: float = 0.05) -> mujoco.MjModel:
    """A hinge with nothing but inertia on a trunk of a thousand tons, far from the ground and without gravity."""
    drive = (
        '<general name="hinge" joint="hinge" gaintype="pid" input="pos vel" biastype="affine" gainprm="0" dynprm="0"'
    )
    return model_of(
        f"""<inertial pos="0 0 0" mass="1e6" diaginertia="1e6 1e6 1e6"/>
        <body name="arm" pos="0 0 0.3"><joint name="hinge" axis="0 1 0" {joint}/>
          <inertial pos="0 0 0" mass="1" diaginertia="1 {inertia} 1"/></body>""",
        option='gravity="0 0 0"',
        more=f'<actuator>{drive} biasprm="0 0 0"/></actuator>',
    )


@pytest.mark.parametrize("armature", [0.0, 0.03])
@pytest.mark.parametrize("damping", [0.0, 0.4])
def test_a_step_of_the_joint_s_reference(armature: float, damping: float) -> None:
    """(I + armature) q'' = kp (0.2 - q) - (kd + damping) q': a damped oscillation, here with I = 0.05, kp = 40, kd = 1.
    A first-order integrator at 2 ms is off by a percent or two.
    """
    model = pendulum(f'armature="{armature}" damping="{damping}"')
    model.actuator_biasprm[0, :3] = 0, -40, -1
    steps = 200
    settings = EXACT if load().dtype == np.float64 else GAZEBO
    out = simulate(model, steps, target=np.full((steps, 1), 0.2), settings=settings)
    inertia, kd = 0.05 + armature, 1.0 + damping
    decay, natural = kd / (2 * inertia), np.sqrt(40 / inertia)
    beat = np.sqrt(natural**2 - decay**2)
    t = H * np.arange(1, steps + 1)
    expected = 0.2 - 0.2 * np.exp(-decay * t) * (np.cos(beat * t) + decay / beat * np.sin(beat * t))
    np.testing.assert_allclose(out.angle[0, :, 0], expected, rtol=0, atol=0.008)


def test_dry_friction_of_a_joint_slows_it_at_a_constant_rate() -> None:
    model = pendulum('frictionloss="0.3"')
    out = simulate(model, 100, qvel=[0, 0, 0, 0, 0, 0, 1.0])
    expected = np.maximum(1.0 - 0.3 / 0.05 * H * np.arange(1, 101), 0.0)
    np.testing.assert_allclose(out.speed[0, :, 0], expected, rtol=0, atol=1e-3)


@pytest.mark.slow
def test_stops_hold_and_may_be_beyond_half_a_turn() -> None:
    model = pendulum('range="10 250" limited="true"')
    model.jnt_range[1] = np.radians([10, 250])
    model.actuator_biasprm[0, :3] = 0, -40, -2
    qpos = [0, 0, 1, 1, 0, 0, 0, np.radians(200)]
    for target, stop in ((6.0, np.radians(250)), (-1.0, np.radians(10))):
        out = simulate(model, 1000, qpos=qpos, target=np.full((1000, 1), target))
        assert out.angle[0, -1, 0] == pytest.approx(stop, abs=0.02)
        # it overshoots by what it travels in one step, at up to 25 rad/s
        assert out.angle[0].max() < np.radians(250) + 25 * H
        assert out.angle[0].min() > np.radians(10) - 25 * H


@pytest.mark.slow
def test_springs_pull_towards_their_rest() -> None:
    model = pendulum('stiffness="20" springref="30" damping="2"')
    out = simulate(model, 1500)
    assert out.angle[0, -1, 0] == pytest.approx(np.radians(30), abs=1e-3)


def test_a_body_and_what_is_welded_to_it_are_one_link() -> None:
    """The compound falls and turns as MuJoCo has it: same mass, centre, inertia."""
    model = model_of(
        '<geom type="box" size="0.2 0.1 0.05" mass="3"/>'
        '<body pos="0.3 0.1 0.2" euler="20 30 40"><geom type="box" size="0.1 0.05 0.02" mass="2" pos="0.1 0 0"/>'
        '<body pos="0.1 0 0.3"><geom type="sphere" size="0.04" mass="1"/></body></body>'
    )
    qpos, qvel = [0, 0, 20, 1, 0, 0, 0], [0, 0, 1, 2.0, 1.0, -3.0]
    s = multibody_of(model)
    assert len(s.mass) == 1
    assert s.mass[0] == pytest.approx(6.0)
    out = simulate(model, 250, qpos=qpos, qvel=qvel)
    expected = in_mujoco(model, 250, qpos=qpos, qvel=qvel)
    np.testing.assert_allclose(out.position[0], expected[:, :3], rtol=0, atol=0.01)
    np.testing.assert_allclose(np.abs(np.sum(out.quaternion[0] * expected[:, 3:7], axis=1)), 1, rtol=0, atol=2e-4)


@pytest.mark.parametrize(
    ("body", "more", "message"),
    [
        ('<geom name="egg" type="ellipsoid" size="0.1 0.2 0.1"/>', "", r"geom egg: the engine ode has no ellipsoid"),
        (
            BOX + '<body name="arm"><joint name="a"/><joint name="b" axis="1 0 0"/><geom size="0.1"/></body>',
            "",
            r"body arm: the engine ode has one joint to a body, and this one has a, b",
        ),
        (
            BOX + '<body><joint name="lift" type="slide"/><geom size="0.1"/></body>',
            "",
            r"joint lift: the engine ode has hinges only",
        ),
        (BOX + '<body><joint name="free"/><geom size="0.1"/></body>', "", r"joint free: has no actuator"),
        (
            BOX + '<body><joint name="turn"/><geom size="0.1"/></body>',
            '<actuator><motor name="raw" joint="turn"/></actuator>',
            r"actuator raw: the engine ode has position and velocity control",
        ),
        (BOX, '<equality><weld body1="trunk"/></equality>', r"has no equality constraints, and the model has 1"),
    ],
)
def test_what_ode_cannot_simulate_is_said(body: str, more: str, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        multibody_of(model_of(body, more=more))
