"""On a Ray cluster a library has the bytes of one process, whichever nodes die and whatever they share."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.library.rolling import contents, rolling_quickly

from levade.cli import main
from levade.errors import LevadeError
from levade.library import Progress, build, spreading
from levade.library.spreading import News, Outpost, Parcel
from levade.robots import load_robot

STARTS = 7


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    directory = tmp_path_factory.mktemp("libraries") / "whole"
    build(rolling_quickly(), starts=STARTS, directory=directory, threads=1)
    return contents(directory)


# with a cluster


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Two nodes on this computer, with one CPU each."""
    os.environ.setdefault(
        "RAY_raylet_start_wait_time_s", "300"
    )  # before the import: workers of a busy computer are slow
    pytest.importorskip("ray", reason="builds on a cluster need ray: pip install ray")
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
    cluster.second = cluster.add_node(num_cpus=1)
    yield cluster
    cluster.shutdown()


needs_cluster = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]  # of Ray's own


@pytest.fixture
def elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """The build leaves its mark where nodes do not look for it, as if they had another directory of that name."""
    monkeypatch.setattr(spreading, "MARK", ".levade-nowhere")


class TestOnACluster:
    pytestmark = needs_cluster

    def test_nodes_without_the_directory_send_the_same_bytes(
        self, cluster: Any, elsewhere: None, whole: dict[str, bytes], tmp_path: Path
    ) -> None:
        """Also when the library grows: nodes are told what works from the falls that were there."""
        for starts in (3, STARTS):
            build(rolling_quickly(), starts=starts, directory=tmp_path, ray=cluster.address)
        assert contents(tmp_path) == whole

    def test_the_robots_file_need_not_be_on_the_nodes(
        self,
        cluster: Any,
        elsewhere: None,
        quadruped: Any,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        """It is gone when they begin."""
        monkeypatch.chdir(tmp_path)
        toy = tmp_path / "toy.xml"
        toy.write_text(quadruped().mjcf())
        build(rolling_quickly("toy.xml"), starts=2, directory=tmp_path / "alone", threads=1)
        task = rolling_quickly("toy.xml")
        build(task, starts=2, directory=tmp_path / "there", ray=cluster.address, observe=lambda _: toy.unlink(True))
        assert not toy.exists()
        assert contents(tmp_path / "there") == contents(tmp_path / "alone")

    def test_a_node_that_dies_loses_only_what_it_works_on(
        self, cluster: Any, whole: dict[str, bytes], tmp_path: Path
    ) -> None:
        """In the last round, once one of its falls is done, both nodes work."""
        seen: list[Progress] = []

        def observe(progress: Progress) -> None:
            seen.append(progress)
            if progress.done == 5 and cluster.second is not None:
                cluster.remove_node(cluster.second, allow_graceful=False)
                cluster.second = None

        build(rolling_quickly(), starts=STARTS, directory=tmp_path, ray=cluster.address, observe=observe)
        assert [one.done for one in seen] == [0, *range(1, STARTS + 1)]
        assert seen[0].cpus == 2
        assert contents(tmp_path) == whole
        assert not list(tmp_path.glob(".levade*"))

    def test_what_goes_wrong_on_a_node_is_one_line(
        self, cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(spreading, "versions", lambda: {"mujoco": "1.0"})
        with pytest.raises(LevadeError, match=r"^fall 0 on .*: has mujoco .*, the computer that builds has 1\.0; inst"):
            build(rolling_quickly(), starts=1, directory=tmp_path, ray=cluster.address)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_interrupted_it_shuts_its_own_cluster_down_and_goes_on_to_the_same_bytes(
    whole: dict[str, bytes], tmp_path: Path
) -> None:
    """Ctrl-C reaches every process of the terminal."""
    pytest.importorskip("ray", reason="builds on a cluster need ray: pip install ray")
    program = (
        "import signal, sys\nfrom pathlib import Path\n"
        f"sys.path.insert(0, {str(Path(__file__).parents[2])!r})\n"
        "from tests.library.rolling import rolling_quickly\n"
        "from levade.cli.stopping import stop_between\nfrom levade.library import build\n"
        "with stop_between() as stopping:\n"
        f"    build(rolling_quickly(), starts={STARTS}, directory=Path({str(tmp_path)!r}), ray='local', stopping=stopping,\n"
        "          observe=lambda progress: print(progress.done, flush=True))\n"
        "    print('stopped' if stopping() else 'finished', signal.getsignal(signal.SIGTERM).__name__)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-W", "ignore", "-c", program], stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    assert process.stdout is not None
    for line in process.stdout:
        if line.strip() == "3":
            break
    _signal_group(process.pid, signal.SIGINT)
    with process.stdout as stdout:
        said = stdout.read().split()
    assert process.wait(60) == 0
    assert said[-2:] == ["stopped", "ask"]
    assert not _signal_group(process.pid, 0)  # no process of the cluster is left
    there = contents(tmp_path)
    assert there.items() <= whole.items()
    assert 3 <= sum(name.startswith("falls/") for name in there) < STARTS
    build(rolling_quickly(), starts=STARTS, directory=tmp_path, threads=1)
    assert contents(tmp_path) == whole


def _signal_group(group: int, number: int) -> bool:
    """Whether the group still exists."""
    until = time.monotonic() + 10
    while True:
        try:
            os.killpg(group, number)
        except ProcessLookupError:
            return False
        if number or time.monotonic() > until:
            return True
        time.sleep(0.1)


# without one


@pytest.mark.slow
@pytest.mark.parametrize("shared", [True, False])
def test_a_fall_that_a_node_solves_is_that_of_the_library(
    shared: bool, whole: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where it shares the directory, it writes there; else it leaves nothing behind."""
    library, temporary = tmp_path / "library", tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    for name, content in whole.items():
        (library / name).parent.mkdir(parents=True, exist_ok=True)
        (library / name).write_bytes(content)
    news = News.of(library, range(4))
    gone = [library / "falls" / "000004.json", *(library / "motions").iterdir()]
    for path in gone:
        path.unlink(missing_ok=True)
    (library / spreading.MARK).write_text("mine" if shared else "another build's")
    monkeypatch.setattr(spreading, "fetch", lambda reference: reference)
    outpost = Outpost(library, "mine", load_robot("hyq2max"))
    delivery = outpost(Parcel(spreading.Fall(4, (0, 1, 2, 3)), (news,)))
    assert delivery.rows is None
    assert "falls/000004.json" in delivery.files
    for name, content in delivery.files.items():
        assert content == (None if shared else whole[name])
        assert (library / name).exists() == shared
        if shared:
            assert (library / name).read_bytes() == whole[name]
    assert list(temporary.iterdir()) == []


def test_a_file_that_does_not_appear_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spreading, "_PATIENCE", 0.0)
    spread = spreading.Spread(tmp_path)
    with pytest.raises(LevadeError, match="a node has written it, but after 0 s it has not appeared here"):
        spread._store(tmp_path / "falls" / "000000.json", None, None)


def test_other_versions_on_a_node_are_said() -> None:
    with pytest.raises(LevadeError, match=r"has numpy 2\.1, the computer that builds has 2\.4; install the same"):
        spreading._check_versions({"numpy": "2.1"}, {"numpy": "2.4"})
    with pytest.raises(LevadeError, match=r"linear algebra is x Zen, .* is x Haswell, .*set OPENBLAS_CORETYPE"):
        spreading._check_versions({"blas": "x Zen"}, {"blas": "x Haswell"})
    spreading._check_versions({"numpy": "2.4", "more": "1"}, {"numpy": "2.4"})


@pytest.mark.slow
def test_without_ray_it_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    for words in (["--ray"], ["--ray", "10.0.0.1:6379"], ["--ray", "--starts", "3"]):
        with pytest.raises(SystemExit, match="2"):
            main(["library", "build", "self-righting", "--out", str(tmp_path / "out"), *words])
        assert capsys.readouterr().err == "levade: --ray: a cluster needs ray; pip install 'levade[ray]'\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--ray", "nowhere"], "--ray: nowhere: is not an address; give HOST:PORT"),
        (["--ray", "ray://h:1"], "--ray: ray://h:1: should be HOST:PORT"),
        (
            ["--ray", "127.0.0.1:1"],
            "--ray: 127.0.0.1:1: no Ray cluster answers there (Connection refused); give the",
        ),
        (["--ray", "--jobs", "2"], "--jobs: 2 processes are for this computer"),
    ],
)
def test_wrong_addresses(words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("ray", reason="builds on a cluster need ray: pip install ray")
    with pytest.raises(SystemExit, match="2"):
        main(["library", "build", "self-righting", "--out", str(tmp_path / "out"), *words])
    assert f"levade: {said}" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
