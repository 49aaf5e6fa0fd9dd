"""Settings that every test shares, a robot that tests write to files, and mistakes for those that fuzz."""

from __future__ import annotations

import bdb
import copy
import math
import os
import random
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import settings

from levade.errors import LevadeError

if TYPE_CHECKING:
    from levade.robots import Robot

# The same examples in every run, and no time limit for one: CI machines differ in speed by a factor.
settings.register_profile("levade", derandomize=True, deadline=None)
settings.load_profile("levade")


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config: pytest.Config) -> None:
    """Use a process per core, except where ``-n`` says otherwise or a person debugs: workers have no terminal.

    With ``--pdb``, ``--trace``, ``-s`` or under a debugger everything runs in this process. `-p no:xdist` works, too.
    """
    keep_bytecode(config.rootpath)
    option = config.option
    if hasattr(config, "workerinput") or not hasattr(option, "numprocesses"):
        return  # in a worker, or without xdist
    if option.numprocesses is None and option.tx == []:
        option.numprocesses = 0 if _debugging(option) else "auto"
    if option.numprocesses and option.dist == "no":
        option.dist = "worksteal"


def keep_bytecode(root: Path) -> None:
    """Let Python keep compiled modules where it may not, as in many containers: in pytest's cache, not next to the sources.

    Hundreds of processes that tests start would compile levade, and each worker the tests, in every run.
    """
    if sys.dont_write_bytecode and sys.pycache_prefix is None and os.access(root, os.W_OK):
        sys.dont_write_bytecode, sys.pycache_prefix = False, str(root / ".pytest_cache" / "bytecode")
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix


LONGEST = ("test_paper_tasks.py", "test_docs.py", "test_watch_page.py")
"""Files with tests of half a minute."""


@pytest.hookimpl(tryfirst=True)  # before -m is applied
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every test in a browser as slow: a page takes seconds to draw. Begin with the longest, so that none is left alone.

    A worker that has no more tests takes from those that another has not begun.
    """
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.slow)
    items.sort(key=lambda item: not (item.path.name in LONGEST and item.get_closest_marker("slow")))


def _debugging(option: Any) -> bool:
    """Whether a debugger is asked for or there already: Python's own, or that of an editor."""
    traced = isinstance(getattr(sys.gettrace(), "__self__", None), bdb.Bdb)
    attached = not {"debugpy", "pydevd"}.isdisjoint(sys.modules)
    return bool(option.usepdb or option.trace or option.capture == "no" or traced or attached)


@pytest.fixture(scope="session")
def packaged() -> Callable[[str], Robot]:
    """Load a robot whose files a package has. Without that package, which the tests do not need, the test is skipped."""
    from levade.robots import load_robot

    def packaged(name: str) -> Robot:
        try:
            return load_robot(name)
        except LevadeError as error:
            if "is not installed; pip install" not in str(error):
                raise
            pytest.skip(str(error))

    return packaged


WOUND = """
name: wound
model: {model}
actuations:
  motors:
    kind: dcmotor
    stall_torque: 400
    no_load_speed: 35
    kp: 600
    kd: 20
    winding: {winding}
"""


@pytest.fixture
def wound(tmp_path: Path) -> Callable[[str], Path]:
    """Write the description of HyQ2Max with motors whose windings are the text: `robot.yaml` in the test's folder."""
    from levade.robots import load_robot

    def wound(winding: str) -> Path:
        model = Path(load_robot("hyq2max").source).with_name("hyq2max.xml")
        (tmp_path / "robot.yaml").write_text(WOUND.format(model=model, winding=winding))
        return tmp_path / "robot.yaml"

    return wound


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium, headless, drawing in software."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="the pages are tried in a browser, driven by playwright: pip install playwright"
    )
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        pytest.skip("the pages are tried in a browser: no chromium here (Debian: apt-get install chromium)")
    flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium, args=flags)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def offline(browser: Any) -> Iterator[Callable[[Path], Any]]:
    """Opens a page from disk with the network off, and keeps what it asked for and complained of."""
    contexts = []

    def opened(path: Path) -> Any:
        context = browser.new_context(viewport={"width": 1280, "height": 800})
        contexts.append(context)
        context.set_offline(True)
        tab = context.new_page()
        tab.asked, tab.complaints = [], []
        tab.on("request", lambda request: tab.asked.append(request.url))
        tab.on("console", lambda message: message.type == "error" and tab.complaints.append(message.text))
        tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
        tab.goto(path.as_uri())
        tab.wait_for_selector("html[data-ready]")
        return tab

    yield opened
    for context in contexts:
        context.close()


VALUES: list[Any] = [
    *(
        None,
        True,
        0,
        -1,
        3,
        10**17,
        1e308,
        -1e-320,
        math.inf,
        math.nan,
        "",
        "x",
        "nan",
        "1e999 m",
        "60 deg",
        "1 m",
        "2 heights",
    ),
    *("99 parsecs", "all", "a" * 200, "a" * 5000, "\u202e", "\x1b[31m", "../../../etc/passwd", "/dev/zero"),
    *([], [1], [[]], ["x"], [1, 2, 3], {}, {"x": 1}, {"term": []}),
]
"""What a fuzz puts in the place of anything."""


def places(content: Any) -> Iterator[tuple[Any, Any]]:
    """Every table or list in a document, with each of its keys."""
    for key, value in content.items() if isinstance(content, dict) else enumerate(content):
        yield content, key
        if isinstance(value, (dict, list)):
            yield from places(value)


@pytest.fixture(scope="session")
def mistaken() -> Callable[[Any, random.Random], Any]:
    """A function that makes one to three mistakes in tables and lists: other values, other keys, keys that are gone or
    elsewhere.
    """

    def mistaken(content: Any, chance: random.Random) -> Any:
        content = copy.deepcopy(content)
        for _ in range(chance.randint(1, 3)):
            found = list(places(content))
            if not found:
                break
            (table, key), (other, another) = chance.choice(found), chance.choice(found)
            kind = chance.randrange(6)
            if kind == 0:
                del table[key]
            elif kind == 1 and isinstance(table, dict):
                table[chance.choice([str(another), "x", "a" * 300, "\x1b[31m"])] = table.pop(key)
            else:
                table[key] = copy.deepcopy(other[another] if kind == 2 else chance.choice(VALUES))
        return content

    return mistaken


@dataclass(frozen=True)
class Quadruped:
    """A robot of boxes and balls, as URDF or MJCF; every number is also here, for closed forms.

    legs: name -> direction along x and y. joints: of a leg: 2 without hip abduction, 4 with an ankle. knees: "inward", as
    HyQ's, or "back", all the same way, as Go1's. forward: axis of the file's frame that points forward, "x" or "y".
    """

    legs: tuple[tuple[str, int, int], ...] = (("lf", 1, 1), ("rf", 1, -1), ("lh", -1, 1), ("rh", -1, -1))
    joints: int = 3
    knees: str = "inward"
    forward: str = "x"

    LINK = 0.2  # m, thigh and shank
    HIP = (0.2, 0.08)  # m, of the abduction's axis
    OUT = 0.05  # m, from abduction to hip flexion
    FOOT = 0.02  # m, radius
    MASS = (6.0, 0.5, 0.8, 0.2, 0.05)  # kg, trunk, hip, thigh, shank, foot
    EFFORT, VELOCITY, DAMPING = 20.0, 15.0, 0.1
    ABDUCTION, FLEXION, KNEE = (-0.8, 0.8), (-1.5, 1.5), (0.2, 2.5)  # rad

    @property
    def mass(self) -> float:
        trunk, hip, thigh, shank, foot = self.MASS
        return trunk + len(self.legs) * ((hip if self.joints > 2 else 0) + thigh + shank + foot)

    def _place(self, x: float, y: float, z: float) -> str:
        return f"{x:g} {y:g} {z:g}" if self.forward == "x" else f"{-y:g} {x:g} {z:g}"

    @property
    def _axes(self) -> tuple[str, str]:
        """Along the robot, and to its left."""
        return (self._place(1, 0, 0), self._place(0, 1, 0))

    def _knee(self, end: int) -> tuple[float, float]:
        back = end > 0 or self.knees == "back"
        return (-self.KNEE[1], -self.KNEE[0]) if back else self.KNEE

    def _chain(self, name: str, end: int, side: int) -> list[tuple[str, str, str, str, tuple[float, float], float]]:
        """(link, joint, place, axis, range, mass) of the leg's moving links."""
        ahead, left = self._axes
        hip = self._place(end * self.HIP[0], side * self.HIP[1], 0)
        thigh = self._place(0, side * self.OUT, 0)
        if self.joints == 2:
            hip, thigh = "", self._place(end * self.HIP[0], side * (self.HIP[1] + self.OUT), 0)
        down = f"0 0 {-self.LINK:g}"
        chain = [
            (f"{name}_hip", f"{name}_haa", hip, ahead, self.ABDUCTION, self.MASS[1]),
            (f"{name}_thigh", f"{name}_hfe", thigh, left, self.FLEXION, self.MASS[2]),
            (f"{name}_shank", f"{name}_kfe", down, left, self._knee(end), self.MASS[3]),
            (f"{name}_toe", f"{name}_ankle", down, left, self.FLEXION, 0.1),
        ]
        return chain[1:3] if self.joints == 2 else chain[: self.joints]

    def urdf(self) -> str:
        text = [f'<robot name="toy">{_link("trunk", self.MASS[0], 0.1, _BOX)}']
        for name, end, side in self.legs:
            parent = "trunk"
            for link, joint, place, axis, limits, mass in self._chain(name, end, side):
                z = 0.0 if link.endswith("_hip") else -self.LINK / 2
                text.append(_link(link, mass, 0.002, "", z))
                text.append(
                    f'<joint name="{joint}" type="revolute"><parent link="{parent}"/><child link="{link}"/>'
                    f'<origin xyz="{place}"/><axis xyz="{axis}"/><dynamics damping="{self.DAMPING}" friction="0"/>'
                    f'<limit lower="{limits[0]}" upper="{limits[1]}" effort="{self.EFFORT}" velocity="{self.VELOCITY}"/>'
                    "</joint>\n"
                )
                parent = link
            text.append(_link(f"{name}_foot", self.MASS[4], 1e-5, f'<sphere radius="{self.FOOT}"/>'))
            text.append(
                f'<joint name="{name}_foot_joint" type="fixed"><parent link="{parent}"/><child link="{name}_foot"/>'
                f'<origin xyz="0 0 {-self.LINK:g}"/></joint>\n'
            )
        return "".join([*text, "</robot>\n"])

    def mjcf(self, actuator: str = '<position joint="{}" kp="60" kv="1.5" forcerange="-18 18"/>') -> str:
        """actuator: one line, with the joint's name in the braces."""
        text = [
            '<mujoco model="toy"><compiler angle="radian"/><worldbody><geom name="floor" type="plane" size="1 1 1"/>\n'
        ]
        text += ['<body name="trunk" pos="0 0 0.4"><freejoint/>', _inertial(self.MASS[0], 0.1)]
        text.append('<geom name="trunk" type="box" size="0.2 0.04 0.05"/>\n')
        names = []
        for name, end, side in self.legs:
            chain = self._chain(name, end, side)
            for link, joint, place, axis, limits, mass in chain:
                z = 0.0 if link.endswith("_hip") else -self.LINK / 2
                text.append(f'<body name="{link}" pos="{place}"><joint name="{joint}" axis="{axis}" ')
                text.append(f'range="{limits[0]} {limits[1]}" damping="{self.DAMPING}"/>{_inertial(mass, 0.002, z)}\n')
                names.append(joint)
            text.append(f'<geom name="{name}_foot" size="{self.FOOT}" pos="0 0 {-self.LINK:g}"/>')
            text.append("</body>" * len(chain) + "\n")
        text.append("</body></worldbody><actuator>\n")
        text += [actuator.format(joint) for joint in names]
        return "".join([*text, "</actuator>\n</mujoco>\n"])


_BOX = '<box size="0.4 0.08 0.1"/>'


def _inertial(mass: float, inertia: float, z: float = 0.0) -> str:
    return f'<inertial mass="{mass}" pos="0 0 {z:g}" diaginertia="{inertia} {inertia} {inertia}"/>'


def _link(name: str, mass: float, inertia: float, shape: str, z: float = 0.0) -> str:
    collision = f"<collision><geometry>{shape}</geometry></collision>" if shape else ""
    return (
        f'<link name="{name}"><inertial><origin xyz="0 0 {z:g}"/><mass value="{mass}"/>'
        f'<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial>{collision}</link>\n'
    )


@pytest.fixture(scope="session")
def quadruped() -> type[Quadruped]:
    """`Quadruped`, from which a test makes the robot that it wants."""
    return Quadruped
