"""Settings that every test shares."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import settings

# The same examples in every run, and no time limit for one: CI machines differ in speed by a factor.
settings.register_profile("levade", derandomize=True, deadline=None)
settings.load_profile("levade")


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
