"""Conservation laws and mirror symmetry of the HyQ2Max model: the physics is right or these fail."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from levade.robots import load_robot

MIRROR_Y = np.array([1.0, -1.0, 1.0])


def free_robot(*, gravity: bool, timestep: float = 1e-3) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Without actuators, damping, joint limits and contact, in a random state."""
    model = mujoco.MjModel.from_xml_string(load_robot("hyq2max").mjcf)
    model.opt.timestep, model.opt.integrator = timestep, mujoco.mjtIntegrator.mjINT_RK4
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    model.dof_damping[:] = 0
    if not gravity:
        model.opt.gravity[:] = 0
    data = mujoco.MjData(model)
    generator = np.random.default_rng(1)
    data.qpos[7:] = load_robot("hyq2max").postures["neutral"]
    data.qvel[:] = generator.normal(scale=2.0, size=model.nv)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.slow
def test_the_centre_of_mass_falls_as_galileo_says() -> None:
    model, data = free_robot(gravity=True)
    mujoco.mj_subtreeVel(model, data)
    com, velocity = data.subtree_com[0].copy(), data.subtree_linvel[0].copy()
    for _ in range(500):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    t = data.time
    np.testing.assert_allclose(data.subtree_com[0], com + velocity * t - [0, 0, 9.81 * t**2 / 2], atol=1e-6)


@pytest.mark.slow
def test_energy_stays() -> None:
    model, data = free_robot(gravity=True)
    before, kinetic = data.energy.sum(), data.energy[1]
    for _ in range(500):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    assert abs(data.energy.sum() - before) < 1e-5 * kinetic


@pytest.mark.slow
def test_momentum_stays_without_gravity() -> None:
    model, data = free_robot(gravity=False)
    mujoco.mj_subtreeVel(model, data)
    linear, angular = model.body_subtreemass[0] * data.subtree_linvel[0], data.subtree_angmom[0].copy()
    assert np.linalg.norm(linear) > 10
    assert np.linalg.norm(angular) > 1
    for _ in range(500):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    mujoco.mj_subtreeVel(model, data)
    np.testing.assert_allclose(
        model.body_subtreemass[0] * data.subtree_linvel[0], linear, atol=1e-6 * np.linalg.norm(linear)
    )
    np.testing.assert_allclose(data.subtree_angmom[0], angular, atol=1e-6 * np.linalg.norm(angular))


def mirrored(model: mujoco.MjModel, qpos: np.ndarray, qvel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The state seen in the mirror y -> -y: lf <-> rf, lh <-> rh, and every joint's angle keeps its sign."""
    swap = np.array([3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8])
    q, v = np.empty_like(qpos), np.empty_like(qvel)
    q[:3] = MIRROR_Y * qpos[:3]
    q[3:7] = qpos[3:7] * [1, -1, 1, -1]
    q[7:] = qpos[7:][swap]
    v[:3] = MIRROR_Y * qvel[:3]
    v[3:6] = -MIRROR_Y * qvel[3:6]
    v[6:] = qvel[6:][swap]
    return q, v


def mirror_error(*, symmetric_masses: bool) -> float:
    """Largest difference [share of the largest acceleration] between mirrored accelerations and the mirror's own."""
    model, data = free_robot(gravity=True)
    if symmetric_masses:  # what the published numbers lack: the trunk's y, and left and right legs alike
        trunk = model.body("trunk")
        trunk.ipos[1] = 0
        trunk.iquat[:] = 1, 0, 0, 0
        for end, part in ((e, p) for e in "fh" for p in ("hip", "upper", "lower")):
            left, right = model.body(f"l{end}_{part}"), model.body(f"r{end}_{part}")
            right.ipos[:] = MIRROR_Y * left.ipos
            right.inertia[:] = left.inertia
            right.iquat[:] = np.array(left.iquat) * [1, -1, 1, -1]
    generator = np.random.default_rng(2)
    qpos, qvel = data.qpos.copy(), data.qvel.copy()
    qpos[3:7] = generator.normal(size=4)
    qpos[3:7] /= np.linalg.norm(qpos[3:7])
    qpos[7:] += generator.uniform(-0.3, 0.3, size=12)
    accelerations = []
    for q, v in ((qpos, qvel), mirrored(model, qpos, qvel)):
        data.qpos[:], data.qvel[:] = q, v
        mujoco.mj_forward(model, data)
        accelerations.append(data.qacc.copy())
    image = mirrored(model, qpos, accelerations[0])[1]
    return float(np.abs(image - accelerations[1]).max() / np.abs(image).max())


def test_left_and_right_accelerate_alike() -> None:
    assert mirror_error(symmetric_masses=True) < 1e-9


@pytest.mark.slow
def test_the_published_masses_break_the_symmetry_only_slightly() -> None:
    assert 1e-6 < mirror_error(symmetric_masses=False) < 0.05


@pytest.mark.parametrize("factor", [0.5, 3.0])
def test_damping_scale_scales_the_joints_damping_only(factor: float) -> None:
    robot = load_robot("hyq2max")
    model = mujoco.MjModel.from_xml_string(robot.spec(damping_scale=factor).to_xml())
    np.testing.assert_allclose(model.dof_damping[6:], 0.1 * factor)
    np.testing.assert_array_equal(model.dof_damping[:6], 0)
