"""A real Chromium on the real service: every page of a test must stay without errors and without foreign requests."""

import json
from dataclasses import dataclass, field
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect, sync_playwright

from tests.support.browser import browser_path
from tests.support.person import Person
from tests.support.serving import serving

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
HOME, EASY = "?time=end", "?benches=5&time=end"
TIMEOUT = 60_000  # [ms]; no test waits this long for what is coming, however busy the machine

# Longest computation of one answer [s]: on a busy machine the ten seconds of the default are soon over.
DEADLINE = 50.0

# Chromium's own message about a failed request; only tests that make one fail may see it.
FAILED_REQUEST = "Failed to load resource"
# Where many tests share a machine, the service may refuse any request because it is busy; the page then repeats it.
REFUSED = f"{FAILED_REQUEST}: the server responded with a status of "
BUSY = (f"{REFUSED}503 (Service Unavailable)", f"{REFUSED}429 (Too Many Requests)")


@pytest.fixture(scope="session")
def browser():
    """One browser for all tests of a process: starting one costs two seconds of a core."""
    expect.set_options(timeout=TIMEOUT)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path(), args=ARGUMENTS, timeout=TIMEOUT)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """Base URL of the real service of these tests, which is patient."""
    with serving(tmp_path_factory.mktemp("page") / "server.log", deadline_seconds=DEADLINE) as service:
        yield service.url


# Advice of Chromium for reading pixels again, which tests do and the page never does.
READBACK = "Canvas2D: Multiple readback operations"


def is_fault(message):
    """Whether a message on the console is an error or a warning of the page."""
    return message.type in ("error", "warning") and not message.text.startswith(READBACK)


def question_of(answer):
    """What was asked that was refused."""
    return f"{answer.request.method} {answer.url} {answer.request.post_data or ''}"


@dataclass
class Watched:
    """A tab with a page, and the messages and requests of the page since the last check.

    way: the options of its context, in JSON
    """

    page: Page
    way: str
    base: str = ""
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)  # address and body of each refused request
    failing: bool = False  # requests of this page are meant to fail

    def check(self):
        lines, request = [line for line in self.messages if line not in BUSY], list(self.requests)
        refused = "\n".join(self.refused)
        for seen in (self.messages, self.requests, self.refused):
            seen.clear()
        assert [line for line in lines if not (self.failing and line.startswith(FAILED_REQUEST))] == [], refused
        strangers = [
            url for url in request if urlsplit(url)[:2] != urlsplit(self.base)[:2] and not url.startswith("blob:")
        ]
        assert strangers == []

    def leave(self):
        """Empty the tab, so that it is like a new one."""
        options = json.loads(self.way)
        self.page.unroute_all()
        self.page.evaluate("() => { try { localStorage.clear(); } catch {} }")  # A page of a browser's error has none.
        self.page.goto("about:blank")
        self.page.mouse.move(0, 0)
        if options["viewport"] and self.page.viewport_size != options["viewport"]:
            self.page.set_viewport_size(options["viewport"])
        colours, motion = options.get("color_scheme", "light"), options.get("reduced_motion", "no-preference")
        self.page.emulate_media(media="null", color_scheme=colours, reduced_motion=motion)


class Tabs:
    """Tabs of the browser, of which the empty ones are used again; tabs with the same options share a cache."""

    def __init__(self, browser):
        self.browser = browser
        self._contexts = {}
        self._empty = {}

    def opened(self, address, base, without="", **options):
        """A page that loads anew. In an empty tab it takes three quarters of the processor time of one in a new tab."""
        way = json.dumps({"viewport": WIDE, "locale": "en-GB", **options}, sort_keys=True)
        one = self._empty[way].pop() if self._empty.get(way) else self._new(way)
        one.base, one.failing = base, False
        if without:
            one.page.route(without, lambda route: None)
        one.page.goto(f"{base}/{address}")
        return one

    def _new(self, way):
        if way not in self._contexts:
            self._contexts[way] = self.browser.new_context(**json.loads(way))
            self._contexts[way].set_default_timeout(TIMEOUT)
        page = self._contexts[way].new_page()
        one = Watched(page, way)
        page.on("console", lambda text: one.messages.append(text.text) if is_fault(text) else None)
        page.on("pageerror", lambda error: one.messages.append(str(error)))
        page.on("request", lambda request: one.requests.append(request.url))
        page.on("response", lambda answer: one.refused.append(question_of(answer)) if answer.status == 422 else None)
        return one

    def take_back(self, one, base):
        """Take a tab back, and check its page. base: of the service to which tabs return; others are closed"""
        if one.base == base:
            one.leave()
            self._empty.setdefault(one.way, []).append(one)
        else:
            one.page.close()
        one.check()


@pytest.fixture(scope="session")
def tabs(browser):
    return Tabs(browser)


@pytest.fixture
def open_page(tabs, server):
    """open_page(query, failing=False, base=server, without="", **options of the context): a page of this test alone.

    query: by default that of the dance at its end, at rest; a bare address opens in motion
    rest: it has all its answers
    failing: requests of this page are meant to fail, of which the browser itself writes a line
    without: pattern of the requests that get no answer
    """
    pages = []

    def opened(query=HOME, *, failing=False, base=server, without="", rest=True, **options):
        one = tabs.opened(query, base, without, **options)
        one.failing = failing
        pages.append(one)
        person = Person(one.page)
        return person.settles() if rest else person

    yield opened
    for one in pages:
        tabs.take_back(one, server)
