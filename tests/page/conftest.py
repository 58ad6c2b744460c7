"""A real Chromium on the real service: every page of a test must stay without errors and without foreign requests."""

from dataclasses import dataclass, field
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect, sync_playwright

from tests.support.browser import browser_path
from tests.support.person import Person
from tests.support.serving import PATIENT, serving

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
HOME = "?time=end"
EASY = "?benches=5&time=end"
TIMEOUT = 180_000  # [ms]; no test waits this long for what is coming, however busy the machine

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
    with serving(tmp_path_factory.mktemp("page") / "server.log", deadline_seconds=PATIENT) as service:
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
    """A tab with a page, and its messages and requests."""

    page: Page
    base: str
    failing: bool  # requests of this page are meant to fail
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)  # address and body of each refused request

    def __post_init__(self):
        self.page.on("console", lambda text: self.messages.append(text.text) if is_fault(text) else None)
        self.page.on("pageerror", lambda error: self.messages.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("response", lambda one: self.refused.append(question_of(one)) if one.status == 422 else None)

    def check(self):
        lines = [line for line in self.messages if line not in BUSY]
        assert [line for line in lines if not (self.failing and line.startswith(FAILED_REQUEST))] == [], self.refused
        home = urlsplit(self.base)[:2]
        assert [url for url in self.requests if urlsplit(url)[:2] != home and not url.startswith("blob:")] == []


@pytest.fixture
def open_page(browser, server):
    """open_page(query, failing=False, base=server, **options of the context): a page of this test alone.

    query: by default that of the dance at its end, at rest; a bare address opens in motion
    rest: it has all its answers
    failing: requests of this page are meant to fail, of which the browser itself writes a line
    """
    pages = []

    def opened(query=HOME, *, failing=False, base=server, rest=True, **options):
        context = browser.new_context(**{"viewport": WIDE, "locale": "en-GB", **options})
        context.set_default_timeout(TIMEOUT)
        pages.append(Watched(context.new_page(), base, failing))
        person = Person(pages[-1].page)
        person.page.goto(f"{base}/{query}")
        return person.settles() if rest else person

    yield opened
    for one in pages:
        one.page.context.close()
    for one in pages:
        one.check()
