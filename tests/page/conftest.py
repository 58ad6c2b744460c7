"""A real Chromium on the real service: every page that a test opens must stay without errors and without strangers."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import pytest
from matplotlib.image import imread
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

from tests.page.browser import found

ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
WIDE = {"width": 1440, "height": 900}
TIMEOUT = 30_000  # [ms]; no test waits this long for what is coming

# Chromium smooths the same edge now this way, now that: so many pixels of two equal pictures may differ [1].
PIXELS_UNLIKE = 1e-3

# What Chromium itself writes when a request fails; only tests that make one fail may see it.
FAILED_REQUEST = "Failed to load resource"


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """One browser for all tests of a process: starting one costs two seconds of a core."""
    expect.set_options(timeout=TIMEOUT)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found(), args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def contexts() -> dict[str, BrowserContext]:
    """One browser's memory for each way of opening pages, so that its cache serves all tests."""
    return {}


@pytest.fixture
def open_page(browser: Browser, contexts: dict[str, BrowserContext], server: str) -> Iterator[Callable[..., Page]]:
    """open_page(query, failing=False, base=server, **options of the context): a page, watched until the test ends.

    query: by default that of the dance at its end, at rest; a bare address opens in motion
    failing: requests of this page are meant to fail, of which the browser itself writes a line
    """
    watched: list[tuple[Page, str, bool, list[str], list[str]]] = []

    def opened(query: str = "?time=end", *, failing: bool = False, base: str = server, **options: Any) -> Page:
        options = {"viewport": WIDE, "locale": "en-GB", **options}
        key = json.dumps(options, sort_keys=True)
        if key not in contexts:
            contexts[key] = browser.new_context(**options)
            contexts[key].set_default_timeout(TIMEOUT)
        page = contexts[key].new_page()
        told: list[str] = []
        asked: list[str] = []
        page.on("console", lambda message: told.append(message.text) if message.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: told.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        watched.append((page, base, failing, told, asked))
        page.goto(f"{base}/{query}")
        return page

    yield opened
    for page, base, failing, told, asked in watched:
        page.close()
        assert [line for line in told if not (failing and line.startswith(FAILED_REQUEST))] == []
        strangers = [url for url in asked if urlsplit(url)[:2] != urlsplit(base)[:2] and not url.startswith("blob:")]
        assert strangers == []


@pytest.fixture
def settled() -> Callable[[Page], None]:
    """settled(page) returns when nothing is being computed for the page any more."""

    def until_settled(page: Page) -> None:
        page.locator("#scan .uplot").wait_for()
        expect(page.locator("[aria-busy=true]")).to_have_count(0)
        page.evaluate("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))")

    return until_settled


@pytest.fixture
def picture() -> Callable[[Page], np.ndarray]:
    """picture(page): the pixels of the dance (height, width, 4)."""

    def pixels(page: Page) -> np.ndarray:
        address = page.locator("#canvas").evaluate("canvas => canvas.toDataURL()")
        return imread(io.BytesIO(base64.b64decode(address.partition(",")[2])))

    return pixels


@pytest.fixture
def alike() -> Callable[[np.ndarray, np.ndarray], bool]:
    """alike(a, b): two pictures show the same."""

    def pictures_alike(a: np.ndarray, b: np.ndarray) -> bool:
        return a.shape == b.shape and float((a != b).any(axis=-1).mean()) < PIXELS_UNLIKE

    return pictures_alike
