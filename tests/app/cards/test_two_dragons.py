"""Cards of two dragons in one spiral: the cues of core for each bench, on the clock of both, and on paper.

That these cues are all there are is tried in tests/core/people/test_performance_cues.py, the choice of a card in
tests/core/people/test_cards.py.
"""

import math
import re

import pytest

import core
from app.questions.cues import QUESTION as CUES
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.settings import Settings
from app.wire.clocks import time_of_day
from app.wire.messages import checked
from app.wire.question import Terms
from core.people.cards import card_of
from tests.support.asking import json_like
from tests.support.near import assert_near
from tests.support.paper import sheets_of

# Both wind into one spiral from opposite sides. The second one begins later, hurries, pauses, and goes on slowly.
NAMES = ["Zhou", "Wu", "", "Wang", *[f"family {k}" for k in range(4, 20)]]
SPIRAL = {"kind": "spiral", "pitch": 1.7, "start_turns": 5.0}
TWO = {
    "dances": [
        {"name": "blue", "dragon": {"benches": 20, "names": NAMES}, "path": SPIRAL},
        {"name": "red", "delay": 6, "head_speed": 0.95, "dragon": {"benches": 11},
         "passages": [{"speed": 1.1, "until_time": 12}, {"speed": 0, "until_time": 20}],
         "path": SPIRAL | {"rotation": math.pi}},
    ],
    "stop": 118.0, "start_clock": "19:45", "title": "Lantern night",
}  # fmt: skip
ROUNDING = 1e-9  # of places [m]
SPACING, STEP = 5.0, 0.75  # of the chalk marks, of a step [m]


@pytest.fixture(scope="module")
def pairs(client):
    """Each card of the answer, with the dragon and the card of core."""
    performance, _ = CuesRequest.model_validate(TWO).to_placed(Settings())
    answer = client.post("/cues", json=TWO).raise_for_status().json()["cards"]
    several = [(k, card_of(cues)) for k in (0, 1) for cues in core.bench_cues(performance, dragon=k, stop=TWO["stop"])]
    return [(card, k, of_core) for card, (k, of_core) in zip(answer, several, strict=True)]


def name_of(dragon, bench):
    return "" if dragon else NAMES[bench]


def assert_same(answer, value, names):
    """The answer has these values of a result of core, and the time of the day."""
    known = json_like(value)
    assert [answer[name] for name in names.split()] == [known[name] for name in names.split()]
    clock = time_of_day(value.time, "19:45")
    assert answer.get("clock", clock) == clock


def assert_met(answer, met):
    assert_same(answer, met, "time dragon bench side gap oncoming x y")
    assert answer["dragon_name"] == ("blue", "red")[met.dragon]
    assert answer["name"] == name_of(met.dragon, met.bench)


def test_every_card_has_the_cues_of_its_bench(pairs):
    for card, dragon, known in pairs:
        bench = known.bench
        assert (card["dragon"], card["bench"], card["name"]) == (dragon, bench.bench, name_of(dragon, bench.bench))
        near = [other and (other["bench"], other["name"]) for other in (card["ahead"], card["behind"])]
        assert near == [k if k is None else (k, name_of(dragon, k)) for k in (bench.ahead, bench.behind)]
        assert card["direction"] == bench.direction
        assert card["least_left_out"] == known.least_left_out
        assert card["left_out"] == len(known.left_out)
        assert_same(card["fastest"], bench.fastest, "time speed handle x y")
        assert card["fastest"]["speed_ratio"] == bench.fastest.speed / (1.1 if dragon else 1.0)
        for met, meeting in zip(card["meetings"], bench.meetings, strict=True):
            assert_met(met, meeting)
        for answer, cue in zip(card["cues"], known.cues, strict=True):
            assert_same(answer, cue, "kind time since until x y")
            assert answer["others"] == [met.bench for met in cue.meetings]
            if cue.nearest:
                assert_met(answer["nearest"], cue.nearest)
    assert any(card["left_out"] for card, *_ in pairs)


def test_a_bench_stands_where_its_chalk_marks_say(pairs):
    # Mark 0 is the last one behind both handles of the last bench at the start.
    zeros = [SPACING * math.floor(known.bench.start.s / SPACING) for _, _, known in (pairs[19], pairs[30])]
    # The last mark is the last one that the head reaches: no step is counted from one that nobody paints.
    lengths = [max(known.bench.done.s for _, one, known in pairs if one == k) - zeros[k] for k in (0, 1)]
    lasts = [SPACING * math.floor(length / SPACING) for length in lengths]
    assert any(card["done"]["past_mark"] > 0.5 * SPACING for card, *_ in pairs)
    for card, dragon, known in pairs:
        for name in ("start", "begin", "done"):
            at = card[name]
            stand = getattr(known.bench, name)
            assert_same(at, stand, "time x y heading")
            assert at["mark"] % SPACING == 0.0
            assert_near(at["mark"] + at["past_mark"], stand.s - zeros[dragon], ROUNDING)
            assert abs(at["past_mark"]) <= 0.5 * SPACING or at["mark"] == lasts[dragon]
            assert at["mark"] <= lasts[dragon]
            assert at["steps"] == round(at["past_mark"] / STEP)


def numbers_in(runs):
    """The numbers that a text such as 3-5, 7 names."""
    ends = [[int(number) for number in part.split("-")] for part in runs.split(", ")]
    return {number for part in ends for number in range(part[0], part[-1] + 1)}


def where(met):
    return "straight" if not met["ahead"] else "ahead" if met["ahead"] > 0.0 else "behind"


def test_the_words_of_a_meeting_name_all_benches_and_the_paper_has_them(pairs):
    paper = CUES.to_bytes(checked(CuesRequest, TWO), Terms(), PDF_TYPE)  # which no deadline ends
    text = "".join(sheets_of(paper)).replace(" ", "")
    again = 0
    for cue in [cue for card, *_ in pairs for cue in card["cues"]]:
        assert "".join(cue["words"].split()) in text
        if near := cue["nearest"]:
            assert re.search(rf"{where(near)} on your {near['side']}, {near['gap']:.2f} m\b", cue["words"])
            # One bench that comes abreast again and again is not several.
            several = len(set(cue["others"]))
            times = len(cue["others"])
            apart = " from " in cue["words"]
            listed = re.search(r"Benches ([\d, -]+) (?:pass you the other way|walk your way)", cue["words"])
            assert bool(listed) == (several > 1)
            assert listed is None or numbers_in(listed[1]) == set(cue["others"])
            assert (f"at the nearest of {times} times from" in cue["words"]) == (several == 1 < times and apart)
            again += several == 1 < times
    assert again > 0
