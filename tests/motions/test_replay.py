"""A motion from its file, in either engine."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from levade.engines import Ode
from levade.engines.ode.library import load
from levade.errors import LevadeError
from levade.motions import Motion, replay_in, versions
from levade.search.run import resume, run
from levade.tasks import load_task

try:
    load()
except LevadeError as missing:
    pytest.skip(str(missing), allow_module_level=True)

NAMES = ("joint_position", "joint_velocity", "joint_torque", "trunk_position", "trunk_quaternion", "foot_contact_force")


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Motion]:
    """From its file, 51 trials into the rearing in an engine."""
    made: dict[str, Motion] = {}

    def get(engine: str) -> Motion:
        if engine not in made:
            folder = tmp_path_factory.mktemp(engine)
            run(load_task("rearing", changes=[f"physics.engine={engine}", "search.trials=51"]), directory=folder)
            made[engine] = Motion.load(folder / "motion.npz")
        return made[engine]

    return get


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "ode"])
def test_in_its_own_engine_it_is_the_motion_to_the_bit(engine: str, motion: Callable[[str], Motion]) -> None:
    found = motion(engine)
    assert found.meta["engine"] == engine
    assert found.meta["task"]["physics"]["engine"] == engine
    assert ("ode" in found.meta["versions"]) == (engine == "ode")
    replay = replay_in(engine, found)
    for name in NAMES:
        np.testing.assert_array_equal(getattr(replay.trajectories, name)[0], found[name], err_msg=name)
    assert replay.errors == found.meta["errors"]
    assert replay.success == found.meta["success"]


@pytest.mark.slow
@pytest.mark.parametrize(("made", "other"), [("mujoco", "ode"), ("ode", "mujoco")])
def test_in_the_other_engine_it_is_much_the_same_at_first(
    made: str, other: str, motion: Callable[[str], Motion]
) -> None:
    """Same start, same references: within 2 cm for a tenth of a second, and not the same."""
    found = motion(made)
    replay = replay_in(other, found)
    apart = np.linalg.norm(replay.trajectories.trunk_position[0] - found["trunk_position"], axis=1)
    assert apart[:50].max() < 0.02
    assert apart[-1] > 1e-4
    assert replay.errors.keys() == found.meta["errors"].keys()
    assert replay.trajectories.horizon_steps == found.horizon_steps


@pytest.mark.slow
def test_settings_of_ode_may_be_given(motion: Callable[[str], Motion]) -> None:
    found = motion("ode")
    exact = replay_in("ode", found, ode=Ode(solver="exact")).trajectories
    assert not np.array_equal(exact.trunk_position[0], found["trunk_position"])
    np.testing.assert_allclose(exact.trunk_position[0, :50], found["trunk_position"][:50], rtol=0, atol=0.02)


@pytest.mark.slow
def test_an_engine_that_is_none_is_named(motion: Callable[[str], Motion]) -> None:
    with pytest.raises(LevadeError, match=r"no engine 'odd'; did you mean ode\?"):
        replay_in("odd", motion("mujoco"))


@pytest.mark.slow
def test_pictures_show_a_motion_of_ode_as_it_was_recorded(motion: Callable[[str], Motion]) -> None:
    from levade.report.rendering import replay

    found = motion("ode")
    poses = replay(found)
    np.testing.assert_array_equal(poses.qpos[1:, :3], found["trunk_position"])
    np.testing.assert_array_equal(poses.qpos[1:, 7:], found["joint_position"])
    np.testing.assert_array_equal(poses.qpos[0], found["qpos0"])


@pytest.mark.slow
def test_a_run_in_ode_goes_on_where_it_stopped_to_the_same_motion(tmp_path: Path) -> None:
    task = load_task("rearing", changes=["physics.engine=ode", "search.trials=51", "start.settled.time=0.3"])
    whole = run(task, seed=3, directory=tmp_path / "whole").motion

    def stop(generation) -> None:
        if generation.generation == 2:
            raise KeyboardInterrupt

    run(task, seed=3, directory=tmp_path / "part", observe=stop)
    again = resume(tmp_path / "part").motion
    for name in whole.arrays:
        np.testing.assert_array_equal(again[name], whole[name], err_msg=name)
    text = (tmp_path / "whole" / "task.yaml").read_text()
    assert "engine: ode" in text
    assert load_task(tmp_path / "whole" / "task.yaml").physics == dataclasses.replace(task.physics)
    assert versions("ode")["ode"] == load().name
