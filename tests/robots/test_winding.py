"""Windings: I^2 R, warming up with the thermal time constant, and MuJoCo's own thermal model."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import load_robot
from levade.robots.winding import HOTTEST, Thermal, Winding

Wound = Callable[[str], Path]

CONST, OHM, KELVIN_PER_WATT, CAPACITY, AMBIENT = 0.45, 0.26, 1.25, 32.0, 20.0


def winding(tempcoef: float = 0.0, reftemp: float = AMBIENT) -> Winding:
    one = np.ones(1)
    thermal = Thermal(
        KELVIN_PER_WATT * one, CAPACITY * one, tempcoef * one, reftemp * one, AMBIENT * one, HOTTEST * one, assumed=True
    )
    return Winding(CONST * one, 40 * one, OHM * one, thermal)


def test_current_is_torque_over_the_motor_constant_and_heat_is_its_square() -> None:
    torque = np.array([[9.0], [-18.0]])
    assert winding().currents(torque).ravel() == pytest.approx([20.0, 40.0])
    assert winding().heat(torque).ravel() == pytest.approx([400 * OHM, 1600 * OHM])


@pytest.mark.parametrize("timestep", [pytest.param(0.002, marks=pytest.mark.slow), 10.0])
def test_a_motor_held_at_constant_torque_warms_up_with_the_thermal_time_constant(timestep: float) -> None:
    """63 % of the way to I^2 R R_th after R_th C = 40 s, for any time step."""
    steps = round(120 / timestep)
    temperature = winding().temperatures(np.full((steps, 1), 9.0), timestep)[:, 0]
    time, end = timestep * np.arange(1, steps + 1), 400 * OHM * KELVIN_PER_WATT
    assert temperature == pytest.approx(AMBIENT + end * (1 - np.exp(-time / 40.0)), abs=1e-8)
    assert winding().repeated(np.full((steps, 1), 9.0)) == pytest.approx([AMBIENT + end])


def test_without_torque_a_warm_winding_cools_down_with_it_too() -> None:
    torque = np.concatenate([np.full((1000, 1), 9.0), np.zeros((4000, 1))])
    temperature = winding().temperatures(torque, 0.01)[:, 0]
    assert (temperature[999 + 4000] - AMBIENT) / (temperature[999] - AMBIENT) == pytest.approx(np.exp(-1.0))


def test_resistance_that_grows_heats_more_until_it_runs_away() -> None:
    """At 30 A the resistance grows by 0.0039 / K * 234 W * 1.25 K / W = 1.14 of what cools: no balance, e^(+0.14 t / 40 s)."""
    copper, torque = winding(0.0039), np.full((4000, 1), 30 * CONST)
    heat = 900 * OHM
    loss = 1 / KELVIN_PER_WATT - heat * 0.0039
    assert loss < 0
    rise = heat / loss * (1 - np.exp(-loss * 40.0 / CAPACITY))
    assert copper.temperatures(torque, 0.01)[-1, 0] == pytest.approx(AMBIENT + rise)
    assert copper.repeated(torque).tolist() == [np.inf]
    warm = winding(0.0039, reftemp=AMBIENT - 10)  # 3.9 % more resistance at the start
    first = [one.temperatures(torque[:1], 0.01)[0, 0] - AMBIENT for one in (warm, copper)]
    assert first[0] / first[1] == pytest.approx(1.039, rel=1e-6)


MOTOR = """
<mujoco>
  <option timestep="0.001" gravity="0 0 0"/>
  <worldbody><body><joint name="j" axis="0 1 0" damping="2000"/><geom size="0.1" mass="100"/></body></worldbody>
</mujoco>
"""


def test_mujoco_s_thermal_model_agrees() -> None:
    """A torque that changes, with copper's coefficient: MuJoCo integrates by Euler steps, the winding in closed form."""
    spec = mujoco.MjSpec.from_string(MOTOR)
    motor = spec.add_actuator(name="m", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="j")
    motor.set_to_dcmotor(
        motorconst=[CONST, 0.0],
        resistance=OHM,
        thermal=[KELVIN_PER_WATT, CAPACITY, 0.0, 0.0039, 25.0, AMBIENT],
        controller=[0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ctrlspec=4,  # torque
    )
    model = spec.compile()
    data = mujoco.MjData(model)
    torque, rise = np.empty((6000, 1)), np.empty(6000)
    for row in range(len(torque)):
        data.ctrl[0] = 12.0 * np.sin(0.003 * row)
        mujoco.mj_step(model, data)
        torque[row], rise[row] = data.actuator_force[0], data.act[-1]
    assert rise[-1] > 10
    assert winding(0.0039, 25.0).temperatures(torque, 0.001)[:, 0] == pytest.approx(AMBIENT + rise, abs=0.01)


def described(wound: Wound, winding: str) -> Winding:
    made = getattr(load_robot(wound(winding)).actuation, "winding", None)
    assert isinstance(made, Winding)
    return made


def test_a_description_gives_windings_behind_gears(wound: Wound) -> None:
    made = described(
        wound,
        "{motorconst: 0.1, gear: {'*_haa': 6, '*_?fe': 9}, current: 30, resistance: 0.2,"
        " thermal: {timeconst: 40, capacitance: 32, limit: 120}}",
    )
    assert made.motorconst[:3] == pytest.approx([0.6, 0.9, 0.9])
    assert made.current.tolist() == [30.0] * 12
    assert made.thermal is not None
    assert made.thermal.resistance == pytest.approx(np.full(12, 1.25))
    assert (made.thermal.limit[0], made.thermal.assumed, made.thermal.ambient[0]) == (120.0, False, 25.0)
    plain = described(wound, "{motorconst: 0.1}")
    assert (plain.current == np.inf).all()
    assert plain.resistance is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{motorconst: 0.1, thermal: {resistance: 1, capacitance: 2}}", r"winding\.resistance: missing"),
        ("{motorconst: 0.1, resistance: 1, thermal: {resistance: 1}}", r"thermal: has 1 of .* give two of them"),
        (
            "{motorconst: 0.1, resistance: 1, thermal: {resistance: 1, capacitance: 2, limit: 20}}",
            r"thermal\.limit: 20 degC is not above the ambient 25 degC",
        ),
        ("{resistance: 1}", r"motorconst: missing"),
    ],
)
def test_windings_that_lack_something_are_refused(text: str, message: str, wound: Wound) -> None:
    with pytest.raises(LevadeError, match=message):
        load_robot(wound(text))


def test_dc_motors_of_an_mjcf_bring_their_windings(tmp_path: Path) -> None:
    spec = mujoco.MjSpec.from_file(str(Path(load_robot("hyq2max").source).with_name("hyq2max.xml")))
    joints = [joint.name for joint in spec.joints if joint.type == mujoco.mjtJoint.mjJNT_HINGE]
    for joint in joints:
        motor = spec.add_actuator(name=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT, target=joint)
        motor.gear[0] = 6.0
        motor.set_to_dcmotor(
            motorconst=[0.5, 0.0],
            resistance=0.3,
            saturation=[20.0, 0.0, 0.0],
            thermal=[1.25, 32.0, 0.0, 0.004, 25.0, 30.0],
        )
    (tmp_path / "motors.xml").write_text(spec.to_xml())
    made = getattr(load_robot(tmp_path / "motors.xml").actuation, "winding", None)
    assert made is not None
    assert made.motorconst == pytest.approx(np.full(12, 3.0))
    assert made.current == pytest.approx(np.full(12, 40.0))  # 120 Nm at the joint
    assert made.thermal is not None
    assert (made.thermal.ambient[0], made.thermal.limit[0], made.thermal.assumed) == (30.0, HOTTEST, True)
    assert made.thermal.tempcoef == pytest.approx(np.full(12, 0.004))
