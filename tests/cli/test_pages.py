"""``levade view`` and ``levade solve --watch`` on the command line: what they write, print, serve and refuse."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from levade.cli import main
from levade.run import run as run_task
from levade.tasks import load_task


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def levade(capsys: pytest.CaptureFixture[str], arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as stopped:
        main(arguments.split())
    out, err = capsys.readouterr()
    assert isinstance(stopped.value.code, int)
    return stopped.value.code, out, err


@pytest.mark.parametrize("name", ["hyq2max", "rearing"])
def test_a_page_is_written(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert levade(capsys, f"view {name} --out pages/page.html") == (0, "To open in a browser: pages/page.html\n", "")
    text = Path("pages/page.html").read_text(encoding="utf-8")
    assert name in text[: text.index("</title>")]
    assert re.findall(r"https?://(?!www\.w3\.org)[a-z.]+", re.sub(r"<script>.*</script>", "", text, flags=re.S)) == []
    assert levade(capsys, f"view {name} --out pages/page.html")[0] == 0  # its own may be replaced


def test_a_motion_is_shown_as_its_report(capsys: pytest.CaptureFixture[str]) -> None:
    task = load_task("rearing", changes=["search.population=8", "search.trials=8", "horizon=0.06"])
    run_task(task, seed=0, directory=Path("rearing"))
    assert levade(capsys, "view rearing/motion.npz --out page.html")[0] == 0
    levade(capsys, "show rearing/motion.npz")
    assert Path("page.html").read_bytes() == Path("rearing/report.html").read_bytes()
    # the name alone is the task, and says so
    status, out, _ = levade(capsys, "view rearing --out task.html")
    assert (status, out.splitlines()[0]) == (
        0,
        "The built-in task; the motion in rearing/ is: levade view rearing/motion.npz",
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("view rearin", "view: no robot, task or file 'rearin'; did you mean rearing?"),
        ("view hyq2max --out mine.html", "mine.html: is no report of levade's and would be replaced; move it away"),
        ("view hyq2max --out page.html --port 1", "--out page.html: writes the page instead of serving it"),
        ("view hyq2max --host no.such.host.invalid", "no.such.host.invalid:0: cannot be listened at"),
        ("view hyq2max --port 70000", "Invalid value for '--port'"),
        ("view mine.html", "mine.html: cannot be read as a motion"),
        ("view", "Missing argument"),
        ("solve rearing --watch-port 8000", "--watch-port: of the page, so say --watch too"),
        ("solve rearing --open --keep-open", "--open and --keep-open: of the page, so say --watch too"),
        ("solve rearing --watch --watch-host no.such.host.invalid", "no.such.host.invalid:0: cannot be listened at"),
    ],
)
def test_one_line_says_what_is_wrong(arguments: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("mine.html").write_text("mine")
    status, out, err = levade(capsys, arguments)
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1
    assert [path.name for path in Path().iterdir()] == ["mine.html"]


def test_view_serves_until_ctrl_c() -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "levade", "view", "hyq2max"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    assert process.stdout is not None
    found = re.fullmatch(r"Look at it at (http://127\.0\.0\.1:\d+/)\n", process.stdout.readline())
    assert found
    assert process.stdout.readline() == "Ctrl-C ends it.\n"
    assert b"<title>hyq2max</title>" in urllib.request.urlopen(found[1], timeout=100).read()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=300)
    assert (process.returncode, out.strip(), err) == (0, "", "")
