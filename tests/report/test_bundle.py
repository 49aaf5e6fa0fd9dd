"""The script in the package is what web/ makes of its sources, whole, and asks for nothing from outside."""

from __future__ import annotations

import hashlib
import json
import re
from importlib.resources import files
from pathlib import Path

import pytest

WEB = Path(__file__).parents[2] / "web"


@pytest.fixture(scope="module")
def bundle() -> str:
    return (files("levade.report") / "web" / "levade.js").read_text(encoding="utf-8")


def test_three_is_in_the_package_once(bundle: str) -> None:
    scripts = [path.name for path in (Path(str(files("levade"))).rglob("*.js"))]
    assert scripts == ["levade.js"]
    assert bundle.count("three.js authors") == 1


def test_the_lock_names_no_host() -> None:
    lock = (WEB / "package-lock.json").read_text()
    assert "resolved" not in lock
    assert "http" not in re.sub(r'"url": "https://[^"]*"', "", lock)  # of funding


def test_it_was_made_from_the_sources_that_are_here(bundle: str) -> None:
    """As web/build.mjs counts: name, length and text of every source, in order of their names."""
    names = [path.relative_to(WEB).as_posix() for path in (WEB / "src").rglob("*") if path.is_file()]
    names = [name for name in names if re.search(r"\.(js|css|html|json)$", name)]
    digest = hashlib.sha256()
    for name in sorted([*names, "package.json"]):
        text = (WEB / name).read_bytes().replace(b"\r\n", b"\n")
        digest.update(f"{name}\n{len(text)}\n".encode() + text)
    (said,) = re.findall(r"sources ([0-9a-f]{64})", bundle.splitlines()[0])
    assert said == digest.hexdigest(), (
        "the bundle is out of date: cd web && npm ci && npm run build, and commit what it writes"
    )


def test_versions_are_pinned_and_those_of_the_bundle(bundle: str) -> None:
    wanted = json.loads((WEB / "package.json").read_text())
    lock = json.loads((WEB / "package-lock.json").read_text())
    for name, version in (wanted["dependencies"] | wanted["devDependencies"]).items():
        assert re.fullmatch(r"\d+\.\d+\.\d+", version)
        assert lock["packages"][f"node_modules/{name}"]["version"] == version
    assert f"three.js {wanted['dependencies']['three']}:" in bundle


def test_it_keeps_the_licence_of_three(bundle: str) -> None:
    assert "The above copyright notice and this permission notice shall be included" in bundle
    assert re.search(r"Copyright © 2010-\d{4} three\.js authors", bundle)


def test_it_can_stand_inside_a_page(bundle: str) -> None:
    """One script without modules, that asks the network for nothing."""
    assert "</script" not in bundle
    assert not re.search(r"^\s*(import|export)\b", bundle, re.MULTILINE)
    assert not re.search(r"""(fetch|importScripts|Worker|src=|url)\(?["'`]https?:""", bundle)
