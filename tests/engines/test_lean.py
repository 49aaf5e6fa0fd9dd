"""What is stepped has no visual shapes: the same motion to the bit, of any version of a model, and of what a user changed."""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

from levade.engines import Engine, MujocoEngine, Perturbation, State, perturbed_models
from levade.engines.lean import Lean
from levade.trajectory import JointReference

BOTH = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 0.1"/>
    <body name="ball" pos="0 0 1">
      <freejoint/>
      {inertia}
      <geom name="core" size="0.1"/>
      <geom name="hat" pos="0 0 0.2" size="0.1" contype="0" conaffinity="0" {hat}/>
    </body>
  </worldbody>
  {more}
</mujoco>
"""


def lean_of(**parts: str) -> tuple[mujoco.MjModel, Lean]:
    xml = BOTH.format(**{"inertia": "", "hat": "", "more": "", **parts})
    model = mujoco.MjModel.from_xml_string(xml)
    return model, Lean.of(model, xml, {})


@pytest.mark.parametrize("versions", [False, True])
def test_motions_have_the_same_bits_without_visual_shapes(
    engine: Engine, state: State, wave: Callable[..., JointReference], versions: bool
) -> None:
    starts, models = state, None
    if versions:
        sample = Perturbation().draw(engine.model, engine.embodiment.joints, n=3, seed=2)
        starts, models = perturbed_models(engine.model, engine.layout, sample, state)
    whole = MujocoEngine(engine.xml, engine.assets, engine.embodiment, engine.physics, threads=1)
    vars(whole)["_lean"] = Lean(whole.model, np.arange(whole.model.ngeom))
    assert isinstance(engine, MujocoEngine)
    assert engine._lean.model.ngeom < whole.model.ngeom
    reference = wave(state.joint_reference[:1], n=3)
    lean, other = (one.rollout(starts, reference, models=models) for one in (engine, whole))
    for name in ("joint_position", "joint_velocity", "joint_torque", "trunk_position", "trunk_quaternion"):
        np.testing.assert_array_equal(getattr(lean, name), getattr(other, name), err_msg=name)


def test_massless_shapes_go() -> None:
    model, lean = lean_of(hat='mass="0"')
    assert (model.ngeom, lean.model.ngeom) == (3, 2)
    np.testing.assert_array_equal(lean.kept, [0, 1])


@pytest.mark.parametrize(
    "parts",
    [
        {"more": '<sensor><distance geom1="floor" geom2="hat"/></sensor>', "hat": 'mass="0"'},
        {"more": '<contact><pair geom1="floor" geom2="hat"/></contact>', "hat": 'mass="0"'},
    ],
    ids=["a sensor", "a pair"],
)
def test_shapes_that_something_names_stay(parts: dict[str, str]) -> None:
    model, lean = lean_of(**parts)
    assert lean.model is model


def test_the_mass_of_a_visual_shape_stays() -> None:
    model, lean = lean_of(hat='density="1000"')
    np.testing.assert_array_equal(lean.model.body_mass, model.body_mass)
    np.testing.assert_array_equal(lean.model.body_inertia, model.body_inertia)


def test_what_was_changed_after_compiling_counts() -> None:
    xml = BOTH.format(inertia="", hat='mass="0"', more="")
    model = mujoco.MjModel.from_xml_string(xml)
    model.opt.timestep, model.opt.cone = 0.0005, mujoco.mjtCone.mjCONE_ELLIPTIC
    model.geom_solref[:, 0], model.geom_friction[1, 0], model.geom_condim[1] = 0.05, 0.3, 6
    model.dof_damping[:] = 0.7
    model.jnt_limited[:] = not model.jnt_limited[0]
    model.stat.meaninertia *= 2
    lean = Lean.of(model, xml, {})
    assert (lean.model.opt.timestep, lean.model.opt.cone) == (0.0005, mujoco.mjtCone.mjCONE_ELLIPTIC)
    for name in ("geom_solref", "geom_friction", "geom_condim"):
        np.testing.assert_array_equal(getattr(lean.model, name), getattr(model, name)[:2], err_msg=name)
    np.testing.assert_array_equal(lean.model.dof_damping, model.dof_damping)
    np.testing.assert_array_equal(lean.model.jnt_limited, model.jnt_limited)
    assert lean.model.stat.meaninertia == model.stat.meaninertia


def test_values_of_shapes_are_those_that_are_left() -> None:
    _, lean = lean_of(hat='mass="0"')
    friction = np.arange(18.0).reshape(2, 3, 3)
    np.testing.assert_array_equal(lean.fields("geom_friction", friction), friction[:, :2])
    mass = np.arange(4.0).reshape(2, 2)
    assert lean.fields("body_mass", mass) is mass
