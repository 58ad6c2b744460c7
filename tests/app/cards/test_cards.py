"""Cue cards: those of the village square held against its trajectory; the same as CSV, as PDF and from a terminal."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium
import pytest
from scipy.integrate import quad

import core
from app.cards.words import Chalk, runs
from app.maps.dances import read_dance
from app.questions.cues import QUESTION as CUES
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.settings import Settings
from app.wire.messages import checked
from app.wire.question import Terms
from core import Budget, TooMuchWork
from core.people.cards import CUES_MOST, TOGETHER
from core.people.meetings import MeetingColumns
from tests.support.command import run
from tests.support.slow_meetings import same_meetings

VILLAGE = Path(__file__).parents[3] / "examples" / "village_square.toml"
# Places, and the way along the path, which is integrated here [m]; a time of a meeting, from its root [s].
ROUNDING, INTEGRATED, MOMENT = 1e-10, 1e-6, 1e-7
NAMES = ["=1+1", "Wang", *[f"family {k}" for k in range(2, 24)]]
# Pauses, and the time of the day.
FESTIVE = {
    "start_clock": "19:45", "language": "en", "title": "Lantern night",
    "passages": [{"speed": 0, "until_time": 4}, {"speed": 1, "until_s": 30}, {"speed": 0, "until_time": 50}],
}  # fmt: skip


@pytest.fixture(scope="module")
def body() -> dict[str, Any]:
    return read_dance(VILLAGE)


@pytest.fixture(scope="module")
def dance(body: dict[str, Any]) -> core.Dance:
    return checked(CuesRequest, body).to_dance(100)


@pytest.fixture(scope="module")
def cards(client: httpx.Client, body: dict[str, Any]) -> list[dict[str, Any]]:
    answer: list[dict[str, Any]] = client.post("/cues", json=body).raise_for_status().json()["cards"]
    return answer


def festive(body: dict[str, Any], **more: Any) -> dict[str, Any]:
    return body | FESTIVE | {"dragon": {"benches": 24, "names": NAMES}} | more


def answer_of(client: httpx.Client, request: dict[str, Any], accept: str) -> bytes:
    return client.post("/cues", json=request, headers={"accept": accept}).raise_for_status().content


def test_every_meeting_of_the_village_square_is_one_of_a_slow_search(cards: Any, dance: core.Dance) -> None:
    met = [(card["bench"], one) for card in cards for one in card["meetings"]]
    assert len(met) > 200
    columns = zip(*((own, one["bench"], one["time"], 0.0, one["gap"], 0.0) for own, one in met), strict=True)
    slow = same_meetings(MeetingColumns(*map(np.array, columns)), dance, (0.0, dance.end.time), 8.0, 0.1)
    assert [one["side"] for _, one in met] == ["left" if left else "right" for *_, left in slow]
    for (own, one), (_, other, travel, gap, _) in zip(met, slow, strict=True):
        assert one["time"] == pytest.approx(travel, abs=MOMENT)  # the head goes at 1 m/s
        assert one["gap"] == pytest.approx(gap, abs=MOMENT)
        handles = core.trajectory(dance, [one["time"]]).position[0]
        assert (one["x"], one["y"]) == pytest.approx(0.5 * (handles[own] + handles[own + 1]), abs=1e-9)
        directions = [handles[k] - handles[k + 1] for k in (own, other)]
        assert one["oncoming"] == bool(directions[0] @ directions[1] < 0.0)


def test_where_each_bench_stands_and_ends_is_on_the_path_and_counted_in_steps(cards: Any, dance: core.Dance) -> None:
    path, times = dance.path, [0.0, dance.end.time]
    handles = core.trajectory(dance, times).position
    for card in cards:
        for at, moment in ((card["start"], 0), (card["done"], 1)):
            assert at["time"] == times[moment]
            assert (at["x"], at["y"]) == pytest.approx(handles[moment, card["bench"]], abs=ROUNDING)
            # The mark, and the way from it, along the path as its tangent gives it.
            assert at["mark"] % 5.0 == 0.0
            mark = at["mark"] + path.tail_begin
            way = [quad(lambda s, axis=axis: path.tangent(s)[axis], mark, mark + at["past_mark"])[0] for axis in (0, 1)]
            assert path.position(mark) + way == pytest.approx([at["x"], at["y"]], abs=INTEGRATED)
            assert abs(at["past_mark"]) <= 2.5 + ROUNDING
            assert at["steps"] == round(at["past_mark"] / 0.75)
        assert card["direction"] == card["start"]["heading"] == 0.0
        ahead, behind = (card[name] and card[name]["bench"] for name in ("ahead", "behind"))
        assert (ahead, behind) == (
            card["bench"] - 1 if card["bench"] else None,
            card["bench"] + 1 if card["bench"] < 23 else None,
        )


def test_no_bench_is_faster_than_its_fastest_moment(cards: Any, dance: core.Dance) -> None:
    speed = core.trajectory(dance, np.arange(0.0, dance.end.time, 0.05)).speed
    for card in cards:
        fastest, bench = card["fastest"], card["bench"]
        assert fastest["speed"] > speed[:, bench : bench + 2].max() - ROUNDING
        then = core.trajectory(dance, [fastest["time"]])
        assert fastest["speed"] == pytest.approx(then.speed[0, fastest["handle"]], abs=ROUNDING)
        assert fastest["speed"] == then.speed[0, bench : bench + 2].max()
        assert fastest["speed_ratio"] == pytest.approx(fastest["speed"])


def test_a_card_has_at_most_eight_cues_and_the_nearest_meetings(cards: Any, client: httpx.Client) -> None:
    spiral = {"dragon": {"benches": 60}, "path": {"kind": "spiral", "pitch": 0.7}, "stop": 200, "first_bench": 20}
    some = client.post("/cues", json=spiral).raise_for_status().json()["cards"]
    assert max(len(card["cues"]) for card in (*cards, *some)) == CUES_MOST
    assert any(card["left_out"] for card in some)
    for card in (*cards, *some):
        cues, times = card["cues"], [cue["time"] for cue in card["cues"]]
        assert times == sorted(times)
        assert (cues[0]["kind"], cues[-1]["kind"]) == ("begin", "done")
        kept = {(one["time"], one["bench"]) for cue in cues if (one := cue["nearest"])}
        inside = [
            one
            for cue in cues
            for one in card["meetings"]
            if cue["nearest"] and cue["since"] <= one["time"] <= cue["until"]
        ]
        assert kept <= {(one["time"], one["bench"]) for one in card["meetings"]}
        for cue in cues:
            if cue["nearest"]:
                assert cue["time"] == cue["nearest"]["time"]
                assert cue["until"] - cue["since"] <= TOGETHER * len(cue["others"])
        if card["least_left_out"] is not None:
            left = [one["gap"] for one in card["meetings"] if one not in inside]
            assert card["least_left_out"] <= min(left)
            assert card["least_left_out"] >= max(cue["nearest"]["gap"] for cue in cues if cue["nearest"])


def test_a_carrier_finds_bench_17_where_its_card_says(client: httpx.Client, body: dict[str, Any]) -> None:
    request = festive(body, first_bench=17, last_bench=17)
    card = json.loads(answer_of(client, request, "application/json"))["cards"][0]
    dance = checked(CuesRequest, request).to_dance(100)
    kinds = [cue["kind"] for cue in card["cues"]]
    assert kinds[:2] == ["begin", "pause"]
    begin, pause, done = card["cues"][0], card["cues"][1], card["cues"][-1]
    assert (begin["clock"], begin["time"], pause["since"], pause["until"]) == ("19:45:04", 4.0, 34.0, 50.0)
    assert (card["start"]["clock"], pause["clock"]) == ("19:45:00", "19:45:34")
    for cue in (begin, pause, done):
        x, y = core.trajectory(dance, [cue["time"]]).position[0, 17]
        assert (cue["x"], cue["y"]) == pytest.approx((x, y), abs=ROUNDING)
    before, after = core.trajectory(dance, [pause["since"], pause["until"]]).position
    assert before == pytest.approx(after, abs=ROUNDING)


def test_the_table_has_the_same_numbers_and_runs_in_no_spreadsheet(client: httpx.Client, body: dict[str, Any]) -> None:
    request = festive(body)
    cards = json.loads(answer_of(client, request, "application/json"))["cards"]
    data = answer_of(client, request, "text/csv").decode()
    lines = list(csv.DictReader(io.StringIO(data)))
    assert [line["kind"] for line in lines if line["bench"] == "3"] == [
        "stand",
        *(one["kind"] for one in cards[3]["cues"]),
    ]
    assert {line["name"] for line in lines if line["bench"] == "0"} == {"'=1+1"}
    assert not any(cell.startswith(("=", "+", "@")) for line in lines for cell in line.values())
    for card in cards:
        stand, *others = [line for line in lines if line["bench"] == str(card["bench"])]
        assert float(stand["past_mark"]) == card["start"]["past_mark"]
        assert (int(stand["steps"]), float(stand["mark"])) == (card["start"]["steps"], card["start"]["mark"])
        for line, cue in zip(others, card["cues"], strict=True):
            assert [float(line[name]) for name in ("time", "since", "until", "x", "y")] == [
                cue[name] for name in ("time", "since", "until", "x", "y")
            ]
            assert (line["clock"], line["words"]) == (cue["clock"], cue["words"])
            if met := cue["nearest"]:
                assert (int(line["other"]), float(line["gap"]), line["side"]) == (met["bench"], met["gap"], met["side"])


def test_four_cards_stand_on_a_sheet_with_fonts_and_marks_to_cut(client: httpx.Client, body: dict[str, Any]) -> None:
    request = festive(body, first_bench=15, last_bench=20)
    data, cards = (
        answer_of(client, request, "application/pdf"),
        json.loads(answer_of(client, request, "application/json")),
    )
    pages = list(pypdfium2.PdfDocument(data))
    assert len(pages) == 2
    assert pages[0].get_size() == pytest.approx((595.28, 841.89), abs=0.01)
    wide, high = pages[0].get_size()
    for k, card in enumerate(cards["cards"]):
        page, place = pages[k // 4], k % 4
        left, bottom = wide / 2 * (place % 2), high / 2 * (1 - place // 2)
        words = page.get_textpage().get_text_bounded(left, bottom, left + wide / 2, bottom + high / 2)
        text = " ".join(words.split())
        assert text.count(NAMES[card["bench"]]) >= 1
        assert f"x {card['start']['x']:.2f} m, y {card['start']['y']:.2f} m" in text
        for cue in card["cues"]:
            assert cue["clock"] in text
            assert cue["words"].replace(" ", "") in text.replace(" ", "")
        assert "The whole dance was checked: nobody touches another bench" in text
        assert "Lantern night" in text
    fonts = [one.get_font() for page in pages for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_TEXT])]
    assert fonts
    assert all(font.is_embedded for font in fonts)
    assert b"/FontFile2" in data  # TrueType
    assert b"/Type3" not in data
    picture = pages[1].render(scale=2.0).to_numpy()[..., :3]
    middle = picture.shape[0] // 2, picture.shape[1] // 2
    for y, x in ((middle[0], middle[1] + 20), (middle[0] + 20, middle[1]), (4, middle[1]), (middle[0], 4)):
        assert picture[y - 3 : y + 4, x - 3 : x + 4].min() < 200
    # The last two places are empty.
    assert picture[middle[0] + 60 : -60, 60 : middle[1] - 60].min() == 255


@pytest.mark.chinese_font
def test_chinese_cards_are_the_same_from_a_terminal(client: httpx.Client, body: dict[str, Any], tmp_path: Path) -> None:
    request = festive(body, language="zh", last_bench=1, title="元宵")
    file = tmp_path / "dance.json"
    file.write_text(json.dumps({name: value for name, value in request.items() if name != "last_bench"}))
    for name, accept in (("cues.pdf", "application/pdf"), ("cues.csv", "text/csv"), ("cues.json", "application/json")):
        run("cues", str(file), "--last-bench", "1", "--output", str(tmp_path / name))
        assert (tmp_path / name).read_bytes() == answer_of(client, request, accept)
    data = (tmp_path / "cues.pdf").read_bytes()
    text = "".join(pypdfium2.PdfDocument(data)[0].get_textpage().get_text_bounded().split())
    cues = "前面：无后面：1号（Wang）", "起步，方向：图上向右（0°）。", "停下，至19:45:50（16秒）。"
    for words in (*cues, "元宵", "整场舞龙已检查：板凳互不相碰"):
        assert words in text


def test_cards_are_chosen_by_name_and_by_number(client: httpx.Client, body: dict[str, Any], tmp_path: Path) -> None:
    names = ["", "Wang", "17", *[""] * 21]  # bench 2 is named 17
    request = body | {"dragon": {"benches": 24, "names": names}}
    cards = json.loads(answer_of(client, request | {"cards": ["Wang", 5, "17", "6"]}, "application/json"))["cards"]
    assert [card["bench"] for card in cards] == [1, 5, 2, 6]
    alone = json.loads(answer_of(client, request | {"first_bench": 5, "last_bench": 5}, "application/json"))["cards"]
    assert cards[1:2] == alone
    file, output = tmp_path / "dance.json", tmp_path / "cues.json"
    file.write_text(json.dumps(request))
    run("cues", str(file), "--bench", "Wang", "--bench", "6", "--output", str(output))
    assert [card["bench"] for card in json.loads(output.read_text())["cards"]] == [1, 6]


@pytest.mark.parametrize(
    ("change", "pointer", "words"),
    [
        ({"dragon": {"benches": 3, "names": ["Li", "Wang", "Li"]}}, "/dragon/names/2", "differ from dragon.names[0]"),
        ({"first_bench": 24}, "/first_bench", "first_bench must be at most 23, the tail, got 24"),
        ({"first_bench": 9, "last_bench": 7}, "/last_bench", "must not be before first_bench (9), got 7"),
        ({"dragon": {"benches": 100_000}, "path": {"kind": "spiral"}, "stop": 5}, "/last_bench",
         "cards must be at most 1000: choose the benches with first_bench and last_bench, got 100000"),
        ({"path": {"kind": "spiral"}}, "/stop", "speeds grow without bound"),
        ({"cards": ["Li"]}, "/cards/0", "cards[0] must be the name or the number of a bench, got 'Li'"),
        ({"cards": [3, 24]}, "/cards/1", "cards[1] must be at most 23, the tail, got 24"),
        ({"cards": [3], "last_bench": 5}, "/last_bench", "last_bench must be left out beside cards, got 5"),
        ({"step_length": 0}, "/step_length", "must be"),
        ({"reach": -1}, "/reach", "must be"),
        ({"beats": [{"bars": 4, "tempo": 0, "step": 0.5}]}, "/beats/0/tempo",
         "tempo must be at least 10 beats/min, got 0 beats/min"),
    ],
    ids=[
        "one name twice", "no such bench", "backwards", "too many", "fold", "no name", "no number", "twice", "no step",
        "no reach", "no tempo",
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence(client: httpx.Client, body: Any, change: Any, pointer: str, words: str) -> None:
    refused = client.post("/cues", json=body | change)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == pointer
    assert words in refused.json()["detail"]


def test_the_last_benches_of_a_hundred_thousand_have_cards(patient: str) -> None:
    request = {
        "dragon": {"benches": 100_000}, "path": {"kind": "spiral", "pitch": 0.55}, "stop": 2.0, "first_bench": 99_998,
    }  # fmt: skip
    with httpx.Client(base_url=patient, timeout=600.0) as client:
        cards = json.loads(answer_of(client, request, "application/json"))["cards"]
        paper = answer_of(client, request, "application/pdf")
    assert [card["bench"] for card in cards] == [99_998, 99_999]
    assert cards[1]["behind"] is None
    assert paper.startswith(b"%PDF")


def test_a_card_of_a_dance_that_fails_says_so(client: httpx.Client) -> None:
    request = {"dragon": {"benches": 60}, "path": {"kind": "spiral", "pitch": 0.45}, "stop": 330, "last_bench": 0}
    data = client.post("/cues", json=request, headers={"accept": "application/pdf"}).raise_for_status().content
    assert "Checked: benches touch" in pypdfium2.PdfDocument(data)[0].get_textpage().get_text_bounded()


def test_chalk_marks_are_counted_in_whole_steps_both_ways() -> None:
    chalk = Chalk(-10.0, 5.0, 0.5)
    nearest = [chalk.nearest(s) for s in (-10.0, -7.6, -7.4, 3.0)]
    assert [mark for mark, _ in nearest] == [0.0, 0.0, 5.0, 15.0]
    assert [past for _, past in nearest] == pytest.approx([0.0, 2.4, -2.4, -2.0])
    assert [chalk.steps(past) for past in (0.0, 0.24, 0.26, -2.4)] == [0, 0, 1, -5]
    assert runs([1]) == "1"
    assert math.isclose(chalk.nearest(1e6)[1], 0.0, abs_tol=ROUNDING)


# -- several dances ------------------------------------------------------------------------------------------

LANES = [
    {"kind": "route", "pieces": [{"kind": "line", "start": [a, y], "end": [b, y]}]}
    for a, b, y in ((0, 30, 0), (30, 0, 2))
]
TWO: dict[str, Any] = {
    "dances": [
        {"name": "east", "dragon": {"benches": 4, "names": ["Zhou", "Wu", "", "Wang"]}, "path": LANES[0]},
        {"dragon": {"benches": 3}, "path": LANES[1], "delay": 3},
    ],
    "start_clock": "19:45",
    "title": "Lantern night",
}


def test_cards_of_several_are_those_of_core(client: httpx.Client) -> None:
    cards = client.post("/cues", json=TWO).raise_for_status().json()["cards"]
    performance, _ = CuesRequest.model_validate(TWO).to_placed(Settings())
    known = [(k, one) for k in (0, 1) for one in core.performance_cues(performance, k)]
    assert [(card["dragon"], card["bench"]) for card in cards] == [(k, one.bench) for k, one in known]
    assert {card["dragon_name"] for card in cards} == {"east", "dragon 1"}
    for card, (_, one) in zip(cards, known, strict=True):
        assert [card[name]["time"] for name in ("start", "begin", "done")] == [
            one.start.time, one.begin.time, one.done.time
        ]  # fmt: skip
        assert [(m["time"], m["dragon"], m["bench"], m["side"], m["gap"]) for m in card["meetings"]] == [
            (m.time, m.dragon, m.bench, m.side.value, m.gap) for m in one.meetings
        ]
        nearest = [cue["nearest"] for cue in card["cues"] if cue["nearest"]]
        assert nearest
        assert all(near["dragon"] != card["dragon"] for near in nearest)
    met = next(cue for cue in cards[4]["cues"] if cue["kind"] == "meeting")
    assert re.match(r"Bench \d (Zhou|Wu|Wang)? ?of east straight on your left, 1\.70 m\. Benches \d", met["words"])
    assert met["nearest"]["name"] == ["Zhou", "Wu", "", "Wang"][met["nearest"]["bench"]]
    assert met["clock"].startswith("19:45:")
    chinese = client.post("/cues", json=TWO | {"language": "zh"}).raise_for_status().json()["cards"]
    words = [cue["words"] for card in chinese[:4] for cue in card["cues"] if cue["kind"] == "meeting"]
    assert all(one.startswith("1 号龙的 ") for one in words)


def test_one_of_several_gets_cards_by_its_name_or_its_number(client: httpx.Client) -> None:
    whole = client.post("/cues", json=TWO).raise_for_status().json()["cards"]
    for part, some in (("east", whole[:4]), (1, whole[4:]), ("1", whole[4:])):
        assert client.post("/cues", json=TWO | {"part": part}).raise_for_status().json()["cards"] == some
    wu = client.post("/cues", json=TWO | {"part": 0, "cards": ["Wu"]}).raise_for_status().json()["cards"]
    assert wu == [whole[1]]


@pytest.mark.parametrize("several", [False, True], ids=["one", "several"])
def test_a_deadline_while_cards_are_drawn_is_a_refusal(body: dict[str, Any], several: bool) -> None:
    budget = Budget()
    terms = Terms(budget=budget, progress=lambda _: budget.stop("within 2 s"))
    with pytest.raises(TooMuchWork, match="the cards were not drawn within 2 s"):
        CUES.to_bytes(checked(CuesRequest, TWO if several else body), terms, PDF_TYPE)


def test_csv_and_paper_of_several_name_the_dragon(client: httpx.Client, tmp_path: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(answer_of(client, TWO, "text/csv").decode())))
    cards = client.post("/cues", json=TWO).raise_for_status().json()["cards"]
    assert [(row["dragon"], row["dragon_name"], row["bench"]) for row in rows if row["kind"] == "stand"] == [
        (str(card["dragon"]), card["dragon_name"], str(card["bench"])) for card in cards
    ]
    met = [row for row in rows if row["kind"] == "meeting"]
    assert {(row["dragon"], row["other_dragon"]) for row in met} == {("0", "1"), ("1", "0")}
    assert {row["other_dragon"] for row in rows if row["kind"] == "begin"} == {""}
    file, paper = tmp_path / "two.json", tmp_path / "two.pdf"
    file.write_text(json.dumps(TWO))
    assert run("cues", str(file), "--output", str(paper)).returncode == 0
    assert paper.read_bytes() == answer_of(client, TWO, "application/pdf")
    pages = [page.get_textpage().get_text_bounded() for page in pypdfium2.PdfDocument(paper)]
    sheets = [" ".join(words.split()) for words in pages]
    assert ["Lantern night: east" in sheet for sheet in sheets] == [True, False]
    assert "Lantern night: dragon 1" in sheets[1]
    assert all("The whole dance was checked: nobody touches another bench" in sheet for sheet in sheets)
    assert "of east" in sheets[1]


def test_each_of_several_counts_its_own_beats_from_its_delay_on(client: httpx.Client) -> None:
    east, west = TWO["dances"]
    beats = [{"bars": 6, "tempo": 60, "step": 1}, {"bars": 2, "tempo": 60, "step": 0}]
    drummed = TWO | {"dances": [east, west | {"beats": beats}]}
    cards = client.post("/cues", json=drummed).raise_for_status().json()["cards"]
    assert {cue["count"] for card in cards if card["dragon"] == 0 for cue in card["cues"]} == {None}
    counted = 0
    for card in cards[4:]:
        for cue in card["cues"]:
            beat = round(cue["time"] - 3.0)
            assert cue["count"] == (f"{beat // 4 + 1}.{beat % 4 + 1}" if beat <= 32 else None)
            counted += beat <= 32
        pause = next(cue for cue in card["cues"] if cue["kind"] == "pause")
        assert (pause["since"], pause["count"]) == (27.0, "7.1")
        assert "Stand still until 9.1 19:45:35" in pause["words"]
    assert counted > 6
    rows = list(csv.DictReader(io.StringIO(answer_of(client, drummed, "text/csv").decode())))
    counts = [cue["count"] or "" for card in cards for cue in card["cues"]]
    assert [row["count"] for row in rows if row["kind"] != "stand"] == counts


@pytest.mark.parametrize(
    ("change", "pointer", "words"),
    [
        ({"part": "west"}, "/part", "part must be a dragon's name, or its number below 2, got 'west'"),
        ({"part": 2}, "/part", "part must be a dragon's name, or its number below 2, got 2"),
        ({"part": True}, "/part", "part must be the number of a dragon, in the order of the dances, or its name"),
        ({"last_bench": 3}, "/last_bench", "last_bench must be at most 2, the tail, got 3"),
        ({"head_speed": 1}, "/head_speed", "head_speed must stand in each of the dances, got it beside them"),
        ({"dances": None, "path": LANES[0], "part": 0}, "/part", "part must be left out without dances, got 0"),
        (
            {"dances": [TWO["dances"][1], {"dragon": {"benches": 3, "names": ["Li", "", "Li"]}, "path": LANES[0]}]},
            "/dances/1/dragon/names/2",
            "dances[1].dragon.names[2] must differ from dances[1].dragon.names[0], got 'Li'",
        ),
    ],
)
def test_what_is_wrong_with_cards_of_several_is_refused(
    client: httpx.Client, change: dict[str, Any], pointer: str, words: str
) -> None:
    refused = client.post("/cues", json=TWO | change)
    assert refused.status_code == 422
    (error,) = refused.json()["errors"]
    assert (error["pointer"], error["detail"][: len(words)]) == (pointer, words)


def test_crosses_stand_at_the_chalk_marks_of_start_and_end(tmp_path: Path) -> None:
    paper, data = tmp_path / "card.pdf", tmp_path / "card.json"
    for output in (paper, data):
        run("cues", "examples/village_square.toml", "--bench", "17", "--output", str(output))
    (card,) = json.loads(data.read_text())["cards"]
    page, places = pypdfium2.PdfDocument(paper)[0], dict[float, list[tuple[float, float]]]()
    for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_PATH]):
        left, bottom, right, top = one.get_bounds()
        if abs((right - left) - (top - bottom)) < 0.01:
            places.setdefault(round(right - left, 1), []).append((0.5 * (left + right), 0.5 * (bottom + top)))
    # Two strokes a cross; a dot a moment, the first one at the start and the last one at the end.
    strokes = next(some for size, some in places.items() if 7.0 < size < 8.5)
    dots = next(some for size, some in places.items() if 4.5 < size < 6.0)
    (start, done), (before, ahead) = (dots[0], dots[-1]), strokes[::2]
    assert strokes[::2] == strokes[1::2]
    scale = (done[0] - start[0]) / (card["done"]["x"] - card["start"]["x"])
    # The street of the start leads along x, that of the end along y.
    assert before == pytest.approx((start[0] - scale * card["start"]["past_mark"], start[1]), abs=0.05)
    assert ahead == pytest.approx((done[0], done[1] - scale * card["done"]["past_mark"]), abs=0.05)
