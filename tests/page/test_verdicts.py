"""Verdicts on the page: green for a pass, red or amber for a failure; and the words for a margin."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import expect

from core import Dragon, minimum_pitch
from core.design.pitch_bands import BORDER_WIDTH
from tests.support.pending import settled

MARKS = {"clear": "✓", "folds": "!", "contact": "✕", "contact_at_start": "✕"}
WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
TOUCHING = re.compile(r"touch|meet|contact|overlap|碰|重叠", re.IGNORECASE)


def tone(page: Any, name: str) -> str:
    """A colour of the page as the browser writes it."""
    probe = f"(() => {{ const one = document.createElement('i'); one.style.color = 'var(--{name})'; "
    probe += "document.body.append(one); const seen = getComputedStyle(one).color; one.remove(); return seen; })()"
    return str(page.evaluate(probe))


def times_of_the_fold(page: Any) -> set[str]:
    """The times of the fold as written for people; a command to copy has all digits of the instant shown."""
    text = " ".join(page.locator(place).inner_text() for place in ("#answers", "#handles", "#dance", "#charts"))
    return set(re.findall(r"238\.2149\d*", text))


def verdict(page: Any) -> tuple[str, str, str]:
    """Outcome, mark and words of the first answer."""
    box = page.locator("#first-contact")
    box.locator(".value").wait_for()
    words = box.locator(".value").inner_text().strip()
    return str(box.get_attribute("data-outcome")), words[0], words[1:].strip()


@pytest.mark.parametrize(
    ("query", "outcome", "colour", "words"),
    [
        ("?benches=40&pitch=1.2&start_turns=8", "folds", "undecided", "The dragon folds at 238.214985 s"),
        pytest.param(
            "?benches=40&pitch=1.2&start_turns=8&margin=0.1",
            "folds",
            "undecided",
            "The dragon folds at 238.214985 s",
            marks=pytest.mark.deep,
        ),
        ("?benches=5&pitch=9&start_turns=3", "clear", "clear", "Nothing touches"),
        ("?benches=5&pitch=9&start_turns=3&margin=0.1", "clear", "clear", "Never within 0.1 m"),
        ("?benches=20", "contact", "contact", "Contact at "),
        pytest.param("?benches=20&margin=0.05", "contact", "contact", "Within 0.05 m at ", marks=pytest.mark.deep),
        ("?margin=0.2", "contact_at_start", "contact", "Within 0.2 m from the start on"),
    ],
    ids=["fold", "fold with a margin", "centre", "centre with a margin", "contact", "margin", "margin at the start"],
)
def test_a_dance_passes_in_green_alone(visit: Any, query: str, outcome: str, colour: str, words: str) -> None:
    page = visit(query)
    page.locator(f"#first-contact[data-outcome={outcome}]").wait_for()
    assert verdict(page)[:2] == (outcome, MARKS[outcome])
    assert verdict(page)[2].startswith(words)
    # The box is drawn anew when another answer of the same dance comes in.
    expect(page.locator("#first-contact .value")).to_have_css("color", tone(page, colour))


def test_an_undecided_search_names_in_both_languages_the_pair_that_surely_meets(visit: Any) -> None:
    pitch = minimum_pitch(Dragon(60)).pitch_bracket[1] - BORDER_WIDTH
    page = visit(f"?benches=60&pitch={pitch!r}")
    page.locator("#first-contact[data-outcome=undecided]").wait_for()
    text = page.locator("#first-contact").inner_text()
    assert re.search(r"Proven clear up to 216\.338\d* s; .+ and .+ meet at 226\.780\d* s at the latest\.", text)
    page.get_by_role("button", name="中文").click()
    page.locator("#first-contact", has_text="最迟在 226.780").wait_for()
    # The answer, with its details, is replaced when the words of the proof have loaded.
    proof = page.locator("#first-contact .method", has_text="之前无法判定，届时")
    proof.wait_for(state="attached")
    method = proof.text_content()
    assert not re.search("[a-z]{4,}", method)


def test_a_fold_says_in_both_languages_that_the_dance_fails_and_who_folds(visit: Any) -> None:
    page = visit("?benches=40&pitch=1.2&start_turns=8")
    page.locator("#run-end .value").wait_for()
    text = page.locator("#first-contact").inner_text()
    assert "The dance fails there, where the head can no longer follow the spiral." in text
    assert "The head cannot follow any more: the chain folds." in page.locator("#run-end").inner_text()
    page.get_by_role("button", name="中文").click()
    page.locator("#first-contact .value", has_text="238.214985 s 时队伍折叠").wait_for()
    assert "舞龙在此失败" in page.locator("#first-contact").inner_text()


def test_one_event_has_one_time_and_speeds_before_a_fold_are_marked(visit: Any) -> None:
    page = visit("?benches=40&pitch=1.2&start_turns=8")
    page.locator("#run-end .value").wait_for()
    page.locator("#table-fold").wait_for()
    for size in (PHONE, WIDE):
        page.set_viewport_size(size)
        settled(page)
        assert times_of_the_fold(page) == {"238.214985"}
    note = "Just before the fold at 238.214985 s: towards it the speeds grow without bound."
    assert page.locator("#table-fold").inner_text() == note
    assert "Handles 1e-6 s before the fold at 238.214985 s" in page.locator("#table-time").inner_text()
    assert "m/s → ∞" in page.locator("#legend").inner_text()
    page.get_by_role("button", name="中文").click()
    page.locator("#table-fold", has_text="即将在 238.214985 s 折叠").wait_for()
    assert times_of_the_fold(page) == {"238.214985"}
    page = visit("?benches=40&pitch=1.2&start_turns=8&time=100")
    page.locator("#table-time", has_text="100.000000").wait_for()
    assert page.locator("#table-fold").is_hidden()
    assert "∞" in page.locator("#legend").inner_text()  # the colours are those of the whole dance


def test_of_benches_too_near_at_the_start_no_clear_time_is_claimed(visit: Any) -> None:
    page = visit("?benches=60&margin=0.2")
    page.locator("#first-contact[data-outcome=contact_at_start]").wait_for()
    page.locator("#first-contact summary").click()
    text = page.locator("#first-contact").inner_text()
    assert "They are within 0.2 m at the start: no time before it is proven clear".lower() in text.lower()
    assert "up to 0" not in text
    page.get_by_role("button", name="中文").click()
    page.locator("#first-contact dl", has_text="起始时刻间距已不超过 0.2 m").wait_for()


@pytest.mark.parametrize(
    "query",
    [
        pytest.param("?benches=12&margin=0.05", marks=pytest.mark.deep),
        "?benches=12&margin=0.2",
        "?path=turn&benches=20&margin=0.35",
    ],
)
def test_with_a_margin_no_answer_speaks_of_a_touch(visit: Any, query: str) -> None:
    page = visit(query, failing=True)  # with such a margin no turn can begin on the circle, as it then says
    margin = query.rpartition("=")[2]
    page.locator("#inset figcaption", has_text="mm").wait_for()
    page.locator("#minimum-pitch .value").wait_for()
    for language, near in (("English", f"ithin {margin} m"), ("中文", f"间距不超过 {margin} m")):
        page.get_by_role("button", name=language).click()
        page.locator("#first-contact h3", has_text=near).wait_for()
        page.evaluate("document.querySelectorAll('#answers details').forEach((one) => (one.open = true))")
        # The stray at which benches touch is another question, which knows no margin.
        for place in (".answer:not(#tolerance, [hidden])", "#inset figcaption", "#scan", "#clearance"):
            text = " ".join(page.locator(place).all_inner_texts())
            assert not TOUCHING.search(text), TOUCHING.search(text)
        for place in ("#inset figcaption", "#scan .hint", "#first-contact"):
            assert near in page.locator(place).inner_text()
        assert "mm" in page.locator("#first-contact").inner_text()
