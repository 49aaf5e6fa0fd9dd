"""Words for limbs and joints: they name the same parts on every robot, and mirror images of each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.policies import FreePolicy
from levade.robots import Robot, load_robot
from levade.robots.naming import joints_of, limbs_of
from levade.tasks import load_task
from levade.tasks.policy import make_policy

HEXAPOD = Path(__file__).parents[2] / "benchmarks" / "robots" / "hexapod.xml"


@pytest.fixture(scope="module", params=["hyq2max", str(HEXAPOD)], ids=["hyq2max", "hexapod"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def feet(robot: Robot, posture: dict[str, float | str]) -> dict[str, np.ndarray]:
    """Position of each foot in the trunk's frame."""
    data = robot.data_at(robot.posture(posture))
    return {leg.name: data.geom(leg.foot).xpos.copy() for leg in robot.legs}


def test_words_name_the_limbs_that_they_say(robot: Robot) -> None:
    for word, part in (("hind", "end"), ("front", "end"), ("left", "side"), ("lf", "name"), ("leg", "kind")):
        named = limbs_of(robot, word)
        assert named
        assert named == tuple(leg for leg in robot.legs if getattr(leg, part) == word)
    assert len(limbs_of(robot, "middle")) == len(robot.legs) - 4
    assert limbs_of(robot, "arm") == ()


@pytest.mark.parametrize("role", ["hfe", "kfe"])
def test_a_role_moves_the_feet_of_both_sides_alike(robot: Robot, role: str) -> None:
    joint = next(i for i in joints_of(robot, f"hind {role}"))
    lower, upper = robot.limits.lower[joint], robot.limits.upper[joint]
    angle = float(robot.posture("neutral")[joint] * 0.7 + 0.3 * (lower + upper) / 2)
    still, moved = feet(robot, {}), feet(robot, {f"hind {role}": angle})
    np.testing.assert_allclose(moved["lh"] * [1, -1, 1], moved["rh"], atol=2e-3)
    assert np.linalg.norm(moved["lh"] - still["lh"]) > 0.01
    np.testing.assert_array_equal(moved["lf"], still["lf"])


def test_angles_of_several_limbs_are_those_of_the_first_and_its_mirror_images() -> None:
    robot = load_robot("hyq2max")  # knees ><: those of the hind legs bend the other way
    angles = robot.posture({"leg kfe": -1.5, "hind hip flexion": "crouched"})
    names = robot.joint_names
    assert {name: angles[names.index(name)] for name in names if name.endswith("kfe")} == {
        "lf_kfe": -1.5,
        "rf_kfe": -1.5,
        "lh_kfe": 1.5,
        "rh_kfe": 1.5,
    }
    crouched = robot.posture("crouched")
    at = [names.index("lh_hfe"), names.index("rh_hfe")]
    np.testing.assert_array_equal(angles[at], crouched[at])


def test_a_range_of_a_role_is_mirrored_too() -> None:
    robot = load_robot("hyq2max")
    changes = ["policy.goal={leg knee: [-1.6, -1.2], hind haa: free}", "policy.groups=pairs"]
    policy = make_policy(load_task("squat-jump", changes=changes), robot)
    assert isinstance(policy, FreePolicy)
    goal = policy.goal
    assert goal is not None
    names = [robot.joint_names[i] for i in policy.policy.leaders[goal.joints]]
    bounds = dict(zip(names, zip(goal.lower.tolist(), goal.upper.tolist(), strict=True), strict=True))
    assert bounds["lf_kfe"] == (-1.6, -1.2)
    assert bounds["lh_kfe"] == (1.2, 1.6)
    hip = robot.joint_names.index("lh_haa")
    assert bounds["lh_haa"] == (robot.limits.lower[hip], robot.limits.upper[hip])


@pytest.mark.parametrize(
    ("goal", "says"),
    [
        (
            "{middle: free}",
            r"^policy.goal: middle: hyq2max has no such limb, only leg \(lf, rf, lh, rh\); valid names: .*hind",
        ),
        ("{arm: free}", r"^policy.goal: arm: hyq2max has no such limb"),
        ("{arm kfe: 1.0, hind: free}", r"arm kfe: hyq2max has no such limb"),
        ("{hind ankle: free}", r"^policy.goal: hind ankle: hind of hyq2max has no joint with the role 'ankle'.*kfe"),
        ("{hind: [-0.1, 0.1]}", r"^policy.goal: hind: a number is for joints; add their role, such as 'hind knee'$"),
        ("{hind kfe: 1.5, left kfe: -1.0}", r"joint lh_kfe fits 'hind kfe' and 'left kfe'"),
        ("{hind kfe: 1.5, '?h_kfe': 1.0}", r"joint lh_kfe fits 'hind kfe' and '\?h_kfe'"),
        ("{hind kfe: 9}", r"lh_kfe 9.0 rad is out of its range"),
    ],
)
def test_what_a_robot_lacks_is_one_line(goal: str, says: str) -> None:
    task, robot = load_task("squat-jump", changes=[f"policy.goal={goal}"]), load_robot("hyq2max")
    with pytest.raises(LevadeError, match=says) as error:
        make_policy(task, robot)
    assert "\n" not in str(error.value)


@pytest.mark.slow
def test_a_task_for_legs_that_another_robot_lacks_does_not_apply_to_it(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(
        f"name: own\nextends: squat-jump\nrobot: {{name: {HEXAPOD}}}\npolicy: {{goal: {{middle kfe: 1.0}}}}\n"
    )
    assert load_task(path).policy.goal == {"middle kfe": 1.0}
    with pytest.raises(
        LevadeError, match=r"^own: does not apply to hyq2max: policy.goal: middle kfe: hyq2max has no such"
    ):
        load_task(path, robot="hyq2max")
