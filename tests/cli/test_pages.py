"""``levade view`` and ``levade solve --watch`` on the command line: what they write, print, serve and refuse."""

from __future__ import annotations

import re
import signal
import urllib.request
from pathlib import Path

import pytest

from levade.search.run import run as run_task
from levade.tasks import load_task


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hyq2max", "rearing"])
def test_a_page_is_written(name: str, levade) -> None:
    assert levade(*f"view {name} --out pages/page.html".split()) == (0, "To open in a browser: pages/page.html\n", "")
    text = Path("pages/page.html").read_text(encoding="utf-8")
    assert name in text[: text.index("</title>")]
    assert re.findall(r"https?://(?!www\.w3\.org)[a-z.]+", re.sub(r"<script>.*</script>", "", text, flags=re.S)) == []
    assert levade(*f"view {name} --out pages/page.html".split())[0] == 0  # its own may be replaced


@pytest.mark.slow
def test_a_motion_is_shown_as_its_report(levade) -> None:
    task = load_task("rearing", changes=["search.population=8", "search.trials=8", "horizon=0.06"])
    run_task(task, seed=0, directory=Path("rearing"))
    assert levade("view", "rearing/motion.npz", "--out", "page.html")[0] == 0
    levade("show", "rearing/motion.npz")
    assert Path("page.html").read_bytes() == Path("rearing/report.html").read_bytes()
    # the name alone is the task, and says so
    status, out, _ = levade("view", "rearing", "--out", "task.html")
    assert (status, out.splitlines()[0]) == (
        0,
        "This is the built-in task. For the motion in rearing/: levade view rearing/motion.npz",
    )


@pytest.mark.slow
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
        ("solve rearing --watch-port 8000", "--watch-port only works with --watch"),
        ("solve rearing --open --keep-open", "--open and --keep-open only work with --watch"),
        ("solve rearing --watch --watch-host no.such.host.invalid", "no.such.host.invalid:0: cannot be listened at"),
    ],
)
def test_one_line_says_what_is_wrong(arguments: str, message: str, levade) -> None:
    Path("mine.html").write_text("mine")
    status, out, err = levade(*arguments.split())
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1
    assert [path.name for path in Path().iterdir()] == ["mine.html"]


@pytest.mark.slow
def test_view_serves_until_ctrl_c(process) -> None:
    viewing = process("view", "hyq2max")
    assert viewing.stdout is not None
    found = re.fullmatch(r"Look at it at (http://127\.0\.0\.1:\d+/)\n", viewing.stdout.readline())
    assert found
    assert viewing.stdout.readline() == "Ctrl-C ends it.\n"
    assert b"<title>hyq2max</title>" in urllib.request.urlopen(found[1], timeout=100).read()
    viewing.send_signal(signal.SIGINT)
    out, err = viewing.communicate(timeout=300)
    assert (viewing.returncode, out.strip(), err) == (0, "", "")
