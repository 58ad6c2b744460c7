"""Cue cards on paper, as CSV and of several dragons; their times, places and meetings: test_two_dragons.py."""

import csv
import io
import json

import numpy as np
import pytest
import shapely
import zxingcpp

from app.files.addresses import short_form
from app.maps.dances import read_dance
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.questions.registry import QUESTIONS
from app.wire.messages import checked
from app.wire.question import Terms
from core import Budget, TooMuchWork, bench_outlines, trajectory
from tests.conftest import ROOT
from tests.support.near import assert_near
from tests.support.paper import assert_printable, pages_of, shapes_of, sheets_of, words_of
from tests.support.refusal_rows import assert_refused

VILLAGE = read_dance(ROOT / "examples" / "village_square.toml")
NAMES = ["=1+1", "Wang", *[f"family {k}" for k in range(2, 24)]]
# Pauses, and the time of the day.
FESTIVE = {
    "start_clock": "19:45", "language": "en", "title": "Lantern night", "dragon": {"benches": 24, "names": NAMES},
    "passages": [{"speed": 0, "until_time": 4}, {"speed": 1, "until_s": 30}, {"speed": 0, "until_time": 50}],
}  # fmt: skip
TWO = json.loads("""{"dances": [
    {"name": "east", "dragon": {"benches": 4, "names": ["Zhou", "Wu", "", "Wang"]},
     "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [30, 0]}]}},
    {"dragon": {"benches": 3}, "delay": 3,
     "path": {"kind": "route", "pieces": [{"kind": "line", "start": [30, 2], "end": [0, 2]}]}}
], "start_clock": "19:45", "title": "Lantern night"}""")


def cards_of(ask, request):
    return ask("cues", request)["cards"]


def table_of(ask, request):
    return list(csv.DictReader(io.StringIO(ask.file("cues", request, "text/csv").decode())))


def text_of(ask, request):
    return " ".join(sheets_of(ask.file("cues", request, "application/pdf")))


def cells_of(one, names):
    return ["" if one[name] is None else str(one[name]) for name in names.split()]


def test_the_table_has_the_same_numbers_and_runs_in_no_spreadsheet(ask):
    lines = table_of(ask, VILLAGE | FESTIVE)
    assert {line["name"] for line in lines if line["bench"] == "0"} == {"'=1+1"}
    assert not any(cell.startswith(("=", "+", "@")) for line in lines for cell in line.values())
    at = "past_mark steps mark time clock x y"
    names = "kind time since until x y clock words"
    for request, of, other in ((VILLAGE | FESTIVE, "bench", ""), (TWO, "dragon dragon_name bench", " dragon")):
        lines = table_of(ask, request)
        for card in cards_of(ask, request):
            stand, *others = [line for line in lines if cells_of(line, of) == cells_of(card, of)]
            assert stand["kind"] == "stand"
            assert cells_of(stand, at) == cells_of(card["start"], at)
            for line, cue in zip(others, card["cues"], strict=True):
                assert cells_of(line, names) == cells_of(cue, names)
                if met := cue["nearest"]:
                    of_other = cells_of(line, "other gap side" + other.replace(" ", " other_"))
                    assert of_other == cells_of(met, "bench gap side" + other)


def test_four_cards_stand_on_a_sheet_with_fonts_and_marks_to_cut(ask):
    request = VILLAGE | FESTIVE | {"first_bench": 15, "last_bench": 20}
    data = ask.file("cues", request, "application/pdf")
    tags = b"/S/H1", b"/S/LI", b"/S/Figure", b"/Alt(Map of the way of your front handle"
    assert_printable(data, b"/Lang(en)", *tags)
    first, second = pages_of(data)
    assert first.get_size() == second.get_size() == pytest.approx((595.28, 841.89), abs=0.01)
    wide, high = (0.5 * side for side in first.get_size())
    for k, card in enumerate(cards_of(ask, request)):
        left = wide * (k % 2)
        bottom = high * (1 - k // 2 % 2)
        text = words_of((first, second)[k // 4], left, bottom, left + wide, bottom + high).replace(" ", "")
        place = f"x {card['start']['x']:.2f} m, y {card['start']['y']:.2f} m"
        verdict = "The whole dance was checked: nobody touches another bench"
        times = [cue["clock"] for cue in card["cues"]]
        words = [f"{card['bench']} {NAMES[card['bench']]}", "Stand", place, "Before you", *times, verdict]
        places = [text.find(word.replace(" ", "")) for word in ["Lantern night", *words]]
        assert -1 not in places
        assert places[1:] == sorted(places[1:])  # The order in which they are read aloud.
    picture = second.render(scale=2.0).to_numpy()[..., :3].min(axis=-1)
    y = picture.shape[0] // 2
    x = picture.shape[1] // 2
    for row, column in ((y, x + 20), (y + 20, x), (4, x), (y, 4)):
        assert picture[row - 3 : row + 4, column - 3 : column + 4].min() < 200
    assert picture[y + 60 : -60, 60 : x - 60].min() == 255  # The last two places are empty.


def test_who_comes_near_without_being_abreast_is_met_where_it_is_nearest(ask):
    dance = CuesRequest.model_validate(VILLAGE).to_dance(24)
    near = [(card["bench"], met) for card in cards_of(ask, VILLAGE) for met in card["meetings"] if met["ahead"]]
    assert len(near) > 10
    for bench, met in near:
        times = met["time"] + np.arange(-20, 21) * 0.05
        corners = bench_outlines(dance.dragon, trajectory(dance, times).position)
        gaps = shapely.distance(*(shapely.polygons(corners[:, k]) for k in (bench, met["bench"])))
        assert_near(met["gap"], gaps[20], 1e-9)
        assert met["gap"] <= gaps.min() + 1e-4


def test_turns_name_what_they_go_around_also_a_gate_and_where_north_is(ask):
    (head,) = cards_of(ask, VILLAGE | {"cards": [0], "gates": [{"name": "north gate", "x": 12, "y": 45}]})
    turns = [cue["words"] for cue in head["cues"] if cue["angle"]]
    around = "turn back to the left around “well”."
    towards = "turn left, towards “north gate”."
    assert turns[0] == f"Near mark 65 m: {around}"
    assert turns[-1] == f"Near mark 110 m: {towards}"
    geographic = VILLAGE | {"cards": [0], "origin": {"longitude": 10, "latitude": 50}}
    assert cards_of(ask, geographic)[0]["cues"][0]["words"] == "Walk towards “linden tree”, east."


# The longest one.
DRAWN = "_".join(f"{0.37 * k * k:.2f},{-3.1 * k:.1f}" for k in range(50))
ADDRESS = f"https://dragon.example/dance/?lang=zh&door=village&path=route&benches=24&time=4&route={DRAWN}"[:600]


@pytest.mark.parametrize("labels, dpi", [(False, 150), (False, 300), (True, 150), (True, 300)])
def test_a_phone_reads_the_code_of_every_bench_from_cards_and_labels(ask, labels, dpi):
    request = VILLAGE | {"first_bench": 8, "last_bench": 11, "address": ADDRESS, "labels": labels}
    (page,) = pages_of(ask.file("cues", request, PDF_TYPE))
    codes = zxingcpp.read_barcodes(page.render(scale=dpi / 72).to_pil())
    read = {code.text for code in codes if code.text.startswith("https")}  # All else is chance.
    assert read == {short_form(ADDRESS.replace("&time=4", "") + f"&bench={k}") for k in range(8, 12)}
    assert all(one.startswith("https://dragon.example/dance/?lang=zh&z=") for one in read)


@pytest.mark.parametrize("labels, pages", [(False, 3), (True, 1)])
def test_a_sheet_of_a3_holds_twice_as_many(ask, labels, pages):
    request = VILLAGE | {"address": ADDRESS, "labels": labels, "paper": "A3"}
    sheets = pages_of(ask.file("cues", request, PDF_TYPE))
    assert [sheet.get_size() for sheet in sheets] == [pytest.approx((1190.55, 841.89), abs=0.01)] * pages
    codes = [zxingcpp.read_barcodes(sheet.render(scale=150 / 72).to_pil()) for sheet in sheets]
    assert {code.text for part in codes for code in part} >= {
        short_form(ADDRESS.replace("&time=4", "") + f"&bench={k}") for k in range(24)
    }


def test_a_map_that_is_turned_has_the_first_steps_of_the_bench_up(ask):
    (page,) = pages_of(ask.file("cues", VILLAGE | {"cards": [17], "map_up": "way"}, PDF_TYPE))
    dots = [box for box in shapes_of(page) if 2.5 < box[2] - box[0] < 2.8 and 2.5 < box[3] - box[1] < 2.8]
    begin, turn = dots[:2]
    assert turn[1] - begin[1] > 10.0 * abs(turn[0] - begin[0])


def test_cards_are_chosen_by_name_and_by_number(ask):
    request = VILLAGE | {"dragon": {"benches": 24, "names": ["", "Wang", "17", *[""] * 21]}}  # bench 2 is named 17
    cards = cards_of(ask, request | {"cards": ["Wang", 5, "17", "6"]})
    assert [card["bench"] for card in cards] == [1, 5, 2, 6]
    assert cards[1:2] == cards_of(ask, request | {"first_bench": 5, "last_bench": 5})


@pytest.mark.parametrize(
    "row",
    [
        '{"dragon": {"benches": 3, "names": ["Li", "Wang", "Li"]}} -> /dragon/names/2 dragon.names[0]',
        '{"first_bench": 24} -> /first_bench 23 24',
        '{"first_bench": 9, "last_bench": 7} -> /last_bench first_bench 9 7',
        '{"dragon": {"benches": 100000}, "path": {"kind": "spiral"}, "stop": 5} -> /last_bench 1000 100000',
        '{"path": {"kind": "spiral"}} -> /stop speeds',
        '{"cards": ["Li"]} -> /cards/0 Li',
        '{"cards": [3, 24]} -> /cards/1 23 24',
        '{"cards": [3], "last_bench": 5} -> /last_bench cards',
        '{"step_length": 0} -> /step_length',
        '{"map_up": "left"} -> /map_up',
        '{"reach": -1} -> /reach',
        '{"beats": [{"bars": 4, "tempo": 0, "step": 0.5}]} -> /beats/0/tempo 10 0',
    ],
)
def test_cards_that_cannot_be_are_refused(client, row):
    assert_refused(client, "/cues", VILLAGE, row)


def test_a_card_of_a_dance_that_fails_says_so(ask):
    spiral = {"kind": "spiral", "pitch": 0.45}
    request = {"dragon": {"benches": 60}, "path": spiral, "stop": 330, "last_bench": 0}
    assert "Checked: benches touch" in text_of(ask, request)


# -- several dances ------------------------------------------------------------------------------------------


def test_paper_of_several_has_the_sheets_of_each_dragon(ask):
    first, second = sheets_of(ask.file("cues", TWO, "application/pdf"))
    assert "Lantern night: east" in first
    assert "Lantern night: dragon 1" in second
    assert "of east" in second
    assert all("The whole dance was checked: nobody touches another bench" in sheet for sheet in (first, second))


def test_one_of_several_gets_cards_by_its_name_or_its_number(ask):
    whole = cards_of(ask, TWO)
    for part, some in (("east", whole[:4]), (1, whole[4:]), ("1", whole[4:])):
        assert cards_of(ask, TWO | {"part": part}) == some
    assert cards_of(ask, TWO | {"part": 0, "cards": ["Wu"]}) == [whole[1]]


def test_each_of_several_counts_its_own_beats_from_its_delay_on(ask):
    beats = [{"bars": 6, "tempo": 60, "step": 1}, {"bars": 2, "tempo": 60, "step": 0}]
    drummed = TWO | {"dances": [TWO["dances"][0], TWO["dances"][1] | {"beats": beats}]}
    cards = cards_of(ask, drummed)
    assert {cue["count"] for card in cards[:4] for cue in card["cues"]} == {None}
    cues = [cue for card in cards[4:] for cue in card["cues"]]
    for beat, count in ((round(cue["time"] - 3.0), cue["count"]) for cue in cues):
        assert count == (f"{beat // 4 + 1}.{beat % 4 + 1}" if beat <= 32 else None)
    counts = [cue["count"] or "" for card in cards for cue in card["cues"]]
    assert [row["count"] for row in table_of(ask, drummed) if row["kind"] != "stand"] == counts


@pytest.mark.parametrize(
    "row",
    [
        '{"part": "west"} -> /part west 2',
        '{"part": 2} -> /part 2',
        '{"part": true} -> /part number name',
        '{"last_bench": 3} -> /last_bench 2 3',
        '{"head_speed": 1} -> /head_speed dances',
        '{"dances": null, "path": {}, "part": 0} -> /part dances',
        '{"stop": 9, "dances": [{}, {"dragon": {"benches": 2, "names": ["a", "a"]}}]} -> /dances/1/dragon/names/1 [0]',
    ],
)
def test_what_is_wrong_with_cards_of_several_is_refused(client, row):
    assert_refused(client, "/cues", TWO, row)


def test_crosses_stand_at_the_chalk_marks_of_start_and_end(ask):
    request = VILLAGE | {"cards": [17]}
    (card,) = cards_of(ask, request)
    boxes = np.array(shapes_of(pages_of(ask.file("cues", request, "application/pdf"))[0]))
    sizes = boxes[:, 2:] - boxes[:, :2]
    middles = 0.5 * (boxes[:, 2:] + boxes[:, :2])
    wide = np.where(np.abs(sizes[:, 0] - sizes[:, 1]) < 0.05, sizes[:, 0], 0.0)
    # Arrows along the way, which leads along x for the most part.
    assert (np.abs(sizes - [7.4, 5.1]) < 0.4).all(axis=1).any()
    # A dot stands at each moment, the first one at the start and the last one at the end.
    (before, ahead), dots = (middles[(low < wide) & (wide < high)] for low, high in ((7.3, 8.0), (2.5, 2.8)))
    start = dots[0]
    done = dots[-1]
    scale = (done - start)[0] / (card["done"]["x"] - card["start"]["x"])
    # The street of the start leads along x, that of the end along y.
    assert_near(before, start - [scale * card["start"]["past_mark"], 0.0], 0.05)
    assert_near(ahead, done - [0.0, scale * card["done"]["past_mark"]], 0.05)


@pytest.mark.parametrize(
    "name, body, paper",
    [("plan", VILLAGE, "plan was"), ("cues", VILLAGE, "cards were"), ("cues", TWO, "cards were"),
     ("crew", VILLAGE, "timeline was")],
)  # fmt: skip
def test_a_deadline_while_a_paper_is_set_is_a_refusal(name, body, paper):
    question = QUESTIONS[name]
    budget = Budget()
    terms = Terms(budget=budget, progress=lambda _: budget.stop("within 2 s"))
    with pytest.raises(TooMuchWork, match=f"the {paper} not drawn within 2 s"):
        question.to_bytes(checked(question.body, body), terms, PDF_TYPE)
