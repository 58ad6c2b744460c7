"""The page in Firefox: drawing, dragging, saving, the language and a job."""

import pytest

from tests.support.firefox import running_firefox
from tests.support.pending import REACH

pytestmark = pytest.mark.firefox
QUIET = "document.documentElement.dataset.pending === ''"
ROUTE = "path=route&route=*-40,0_40,0&begin=30&benches=9&time=40"


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    with running_firefox(tmp_path_factory.mktemp("firefox")) as firefox:
        yield firefox


@pytest.fixture
def firefox(running):
    """The browser of this file; a page must stay without errors."""
    running.errors.clear()
    yield running
    assert running.errors == []


def words(firefox, selector):
    return str(firefox.evaluate(f"document.querySelector({selector!r}).textContent"))


def test_answers_follow_a_slider_and_the_language_a_path_is_drawn_and_a_file_is_saved(firefox, server):
    firefox.open(f"{server}/?benches=20&time=end&lang=en")
    firefox.wait(QUIET)
    before = words(firefox, "#first-contact .value")
    assert before.startswith("✕Contact at ")
    firefox.drag("[data-field=pitch] input[type=range]", right=60)
    firefox.wait(QUIET)
    assert firefox.evaluate("Number(document.querySelector('#pitch').value)") > 0.8
    assert words(firefox, "#first-contact .value") != before
    firefox.click("[data-lang=zh]")
    firefox.wait("document.documentElement.lang === 'zh-Hans'")
    firefox.wait("location.search.includes('lang=zh')")
    firefox.open(f"{server}/?path=route&benches=3&lang=en")
    firefox.wait(QUIET)
    firefox.click("#invite .main")
    for x in (-250, -50, 150):
        firefox.click("#canvas", at=(x, 0))
    firefox.wait("document.querySelectorAll('#knots .knot').length === 3")
    firefox.wait(QUIET)
    before = firefox.evaluate("location.search")
    firefox.drag("#knots .knot:nth-child(2)", down=40)
    firefox.wait(QUIET)
    firefox.wait(f"location.search !== {before!r}")
    assert "be danced" in words(firefox, "#judgement .value")
    firefox.press("n")
    firefox.wait("document.querySelectorAll('#knots .knot').length === 4")
    firefox.open(f"{server}/?door=village&{ROUTE}&lang=en")
    firefox.wait(QUIET)
    firefox.evaluate(REACH)
    firefox.wait(QUIET)
    firefox.click("#keepCues-CSV")
    assert firefox.saved("cues.csv").startswith(b"bench,")
