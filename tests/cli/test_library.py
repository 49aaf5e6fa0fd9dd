"""``levade library``: what it prints, what it writes, and what it says of wrong input."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.cli.app import main
from levade.library import Library

SMALL = ("horizon=0.3", "hold=0.1", "search.polish=0", "search.population=4", "search.trials=24")
EASY = "success={over: {quantity: tilt, maximum: 1.9, at: end}}"

FAMILY = "start={fallen: {height: 0.5, time: 0.4}}"

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Run the command line: exit status, standard output and standard error."""

    def run(*words: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as ended:
            main(words)
        out, err = capsys.readouterr()
        return int(str(ended.value.code)), out, err

    return run


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("built") / "falls"
    changes = [word for change in (*SMALL, EASY, FAMILY) for word in ("--set", change)]
    with pytest.raises(SystemExit) as ended:
        main(["library", "build", "self-righting", "--starts", "4", "--out", str(place), *changes, "--json"])
    assert ended.value.code == 0
    return place


def state(path: Path, **content: Any) -> str:
    path.write_text(json.dumps(content))
    return str(path)


@pytest.mark.slow
def test_it_is_built_asked_and_checked(built: Path, run: Run, tmp_path: Path) -> None:
    asked = state(tmp_path / "state.json", up=[0, 0, -1], joints=[0.0] * 12)
    status, out, _ = run("library", "ask", str(built), "--state", asked)
    assert status == 0
    assert "works with a probability of" in out
    status, out, _ = run("library", "ask", str(built), "--state", asked, "--json")
    answer = json.loads(out)
    assert Path(answer["motion"]).is_file()
    known = Library.load(built).ask([0, 0, -1], np.zeros(12))
    assert (answer["motion"], answer["mirrored"]) == (str(known.path), known.number < 0)
    assert answer["probability"] == known.probability
    status, out, _ = run("library", "check", str(built), "--starts", "2", "--json")
    assert status == 0
    found = json.loads(out)
    assert (found["starts"], found["seed"], found["nominal"]["first"]["runs"]) == (2, 1, 2)
    status, out, _ = run("library", "check", str(built), "--starts", "2")
    assert "within two attempts" in out


@pytest.mark.slow
def test_it_is_shown_and_drawn(built: Path, run: Run, tmp_path: Path) -> None:
    status, out, _ = run("library", "show", str(built), "--json")
    assert status == 0
    shown, library = json.loads(out), Library.load(built)
    assert (shown["done"], shown["coverage"]) == (4, library.coverage)
    assert sum(shown["methods"].values()) == 4
    page = built / "library.html"
    assert (shown["written"], page.is_file()) == ([], True)  # by the build
    before = page.read_bytes()
    page.unlink()
    assert "To open in a browser" not in run("library", "show", str(built), "--no-report")[1]
    assert not page.exists()
    assert str(page) in "".join(run("library", "show", str(built))[1].split())
    assert page.read_bytes() == before
    pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install 'levade[figures]'")
    for place in (tmp_path / "one", tmp_path / "two"):
        status, out, _ = run("library", "show", str(built), "--figures", str(place), "--format", "svg")
        assert status == 0
        assert "lying on its" in out
    one, two = ((tmp_path / name / "library.svg").read_bytes() for name in ("one", "two"))
    assert one == two
    status, _, err = run("library", "show", str(built), "--figures", str(tmp_path), "--format", "gif")
    assert (status, err.count("\n")) == (2, 1)


def test_an_attitude_is_which_way_is_up(built: Path, run: Run, tmp_path: Path) -> None:
    """Half a turn about x: up is down. The joints by name, in any order."""
    library = Library.load(built)
    names = library.ask([0, 0, 1], np.zeros(12)).motion.joint_names
    angles = {name: 0.1 * i for i, name in enumerate(names)}
    one = state(tmp_path / "one.json", attitude=[0, 1, 0, 0], joints=dict(reversed(angles.items())))
    other = state(tmp_path / "other.json", up=[0, 0, -1], joints=list(angles.values()))
    assert run("library", "ask", str(built), "--state", one, "--json") == run(
        *("library", "ask", str(built), "--state", other, "--json")
    )


@pytest.mark.parametrize("attitude", [("--attitude", "0,1,0,0"), ("--up", "0 0 -1")])
@pytest.mark.parametrize("named", [False, True])
def test_the_command_line_asks_as_a_file_does(
    built: Path, run: Run, tmp_path: Path, attitude: tuple[str, str], named: bool
) -> None:
    names = Library.load(built).ask([0, 0, -1], np.zeros(12)).motion.joint_names
    angles = {name: -0.1 * i for i, name in enumerate(names)}
    in_file = state(tmp_path / "state.json", up=[0, 0, -1], joints=list(angles.values()))
    listed = ",".join(map(str, angles.values()))
    typed = ", ".join(f"{name}={angle}" for name, angle in reversed(angles.items())) if named else listed
    assert run("library", "ask", str(built), "--state", in_file, "--json") == run(
        *("library", "ask", str(built), *attitude, "--joints", typed, "--json")
    )


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ([], "give how the robot lies: --state FILE, or else --joints and one of --attitude and --up"),
        (["--up", "0,0,1"], "give how the robot lies"),
        (["--up", "0,0,1", "--attitude", "1,0,0,0", "--joints", "0"], "give how the robot lies"),
        (["--state", "state.json", "--joints", "0"], "give how the robot lies"),
        (["--up", "0,0,1", "--joints", "0,0"], "--joints: should be 12 numbers"),
        (["--up", "0,0,up", "--joints", "0"], "--up: should be 3 numbers"),
        (["--attitude", "0,0,0,0", "--joints", "0"], "--attitude: four zeros are not a rotation"),
        (["--up", "0,0,1", "--joints", "lf_hxe=0"], "--joints: no joint 'lf_hxe'; did you mean lf_hfe"),
        (["--up", "0,0,1", "--joints", "lf_hfe=0"], "--joints: lf_haa is missing"),
    ],
)
def test_wrong_command_lines_are_one_line(built: Path, run: Run, typed: list[str], said: str) -> None:
    status, out, err = run("library", "ask", str(built), *typed)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err


def test_the_reference_is_written_as_a_table(built: Path, run: Run, tmp_path: Path) -> None:
    asked = state(tmp_path / "state.json", up=[0, 0, -1], joints=[0.0] * 12)
    table = tmp_path / "reference.csv"
    assert run("library", "ask", str(built), "--state", asked, "--reference", str(table))[0] == 0
    answer = Library.load(built).ask([0, 0, -1], np.zeros(12))
    head = table.read_text().splitlines()[0].split(",")
    assert head == ["time", *answer.motion.joint_names]
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(rows[:, 1:], answer.reference.position[0])
    np.testing.assert_allclose(np.diff(rows[:, 0]), answer.reference.timestep)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ({"up": [0, 0, 1]}, "joints: should be 12 numbers"),
        ({"joints": [0] * 12}, "give either attitude, a quaternion w-x-y-z, or up"),
        ({"up": [0, 0, 1], "attitude": [1, 0, 0, 0], "joints": [0] * 12}, "give either attitude"),
        ({"up": [0, 0, True], "joints": [0] * 12}, "up: should be 3 numbers"),
        ({"attitude": [0, 0, 0, 0], "joints": [0] * 12}, "four zeros are not a rotation"),
        ({"atitude": [1, 0, 0, 0], "joints": [0] * 12}, "unknown key 'atitude'; did you mean attitude?"),
        ({"up": [0, 0, 1], "joints": {"lf_ha": 0}}, "joints: no joint 'lf_ha'; did you mean lf_haa?"),
        ({"up": [0, 0, 1], "joints": {"lf_haa": 0}}, "joints: lf_hfe is missing"),
    ],
)
def test_wrong_states_are_one_line(built: Path, run: Run, tmp_path: Path, content: dict[str, Any], said: str) -> None:
    status, out, err = run("library", "ask", str(built), "--state", state(tmp_path / "state.json", **content))
    assert (status, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1


def test_what_is_no_library_is_one_line(run: Run, tmp_path: Path) -> None:
    for words in (("check",), ("ask", "--state", "state.json")):
        status, _, err = run("library", words[0], str(tmp_path), *words[1:])
        assert status == 2
        assert "holds no motion library; build one" in err
    status, _, err = run("library", "build", "self-rightin", "--out", str(tmp_path / "x"))
    assert status == 2
    assert "did you mean self-righting" in err
    status, _, err = run("library", "build", "self-righting", "--starts", "0", "--out", str(tmp_path / "x"))
    assert status == 2
    assert "--starts: 0 falls are too few" in err


@pytest.mark.slow
def test_another_task_is_not_built_into_it(built: Path, run: Run) -> None:
    status, _, err = run("library", "build", "self-righting", "--out", str(built), "--starts", "4")
    assert status == 2
    assert "holds the library of another task, robot or seed" in err
    assert "--out DIR" in err


@pytest.mark.slow
def test_shards_are_built_and_merged(built: Path, run: Run, tmp_path: Path) -> None:
    changes = [word for change in (*SMALL, EASY, FAMILY) for word in ("--set", change)]
    for i in range(2):
        build = (
            "library",
            "build",
            "self-righting",
            "--starts",
            "2",
            "--shard",
            f"{i}/2",
            "--out",
            str(tmp_path / str(i)),
        )
        assert run(*build, *changes, "--json")[0] == 0
    status, out, _ = run("library", "merge", str(tmp_path / "0"), str(tmp_path / "1"), "--out", str(tmp_path / "all"))
    assert status == 0
    assert "2 of 2 falls" in out
    status, out, _ = run("library", "build", "self-righting", "--starts", "2", "--out", str(tmp_path / "all"), *changes)
    assert (status, "of 2 falls" in out) == (0, True)
    status, _, err = run("library", "merge", str(built), "--out", str(tmp_path / "other"))
    assert (status, err.count("\n")) == (2, 1)
    assert "is a whole library, not a shard" in err
    for shard, said in (("0:2", "--shard 0:2: should be I/N"), ("2/2", "--shard: 2/2 is not a shard")):
        status, _, err = run("library", "build", "self-righting", "--shard", shard, "--out", str(tmp_path / "x"))
        assert (status, err.count("\n")) == (2, 1)
        assert said in err


@pytest.mark.slow
def test_an_answer_is_refined(built: Path, run: Run, tmp_path: Path) -> None:
    asked = state(tmp_path / "state.json", up=[0, 0, -1], joints=[0.1] * 12)
    status, out, _ = run("library", "ask", str(built), "--state", asked, "--refine", "1 ms", "--json")
    answer = json.loads(out)["refined"]
    assert status == (0 if answer["works"] else 1)
    assert Path(answer["motion"]).is_file()
    status, out, _ = run("library", "ask", str(built), "--state", asked, "--refine", "1 ms")
    assert "In simulation" in out
    status, _, err = run("library", "check", str(built), "--refine", "soon")
    assert (status, err.count("\n")) == (2, 1)
    assert "--refine soon: should be a time, such as 1s" in err


def test_what_does_not_fold_is_not_exported(built: Path, run: Run, tmp_path: Path) -> None:
    status, _, err = run("library", "export", str(built), "--out", str(tmp_path / "robot"))
    assert (status, err.count("\n")) == (2, 1)
    assert "the robot does not fold up first" in err
    assert not (tmp_path / "robot").exists()


def test_too_few_falls_to_learn_from_are_one_line(built: Path, run: Run) -> None:
    pytest.importorskip("sklearn", reason="learning needs scikit-learn: pip install 'levade[learn]'")
    status, _, err = run("library", "learn", str(built))
    assert (status, err.count("\n")) == (2, 1)
    assert "4 falls are too few to learn from; build 10 or more" in err
