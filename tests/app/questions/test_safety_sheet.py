"""The safety sheet: each number again by plain code from the trajectory, its words, and its page opened again."""

import json
import re

import numpy as np
import pytest
import shapely
import zxingcpp

from app.files.addresses import short_form
from app.questions.plan import PDF_TYPE
from core import bench_outlines, trajectory
from tests.support.asking import box, line, polygon
from tests.support.near import assert_near
from tests.support.paper import pages_of, shapes_of, sheets_of, words_of
from tests.support.shared_dances import CROSSING, STREET

IN_STREET = {"dragon": {"benches": 5}, "path": line((0, 0), (60, 0))}
YARD = {"type": "GeometryCollection", "geometries": [box(-5, -8, 65, 8), box(20, 1.0, 22, 3.0)]}
BODY = IN_STREET | {
    "venue": YARD,
    "margin": 0.1,
    "stray": 0.05,
    "speed_limit": 1.5,
    "spectators": 2.0,
    "loose": 2,
    "reaction": 1.5,
    "gates": [{"name": "east gate", "x": 50, "y": 0.2}],
    "lanes": [
        {"name": "ambulances", "points": [[30, -8], [30, 8]], "width": 4},
        {"name": "north lane", "points": [[0, 3], [60, 3]], "width": 6.5},
        {"name": "over the path", "points": [[0, 0], [60, 0]], "width": 4},
    ],
}
STEP = 0.01  # [s]


def benches(answer):
    times = np.arange(answer["start"], answer["stop"], STEP)
    motion = trajectory(STREET, times)
    return times, motion, shapely.polygons(bench_outlines(STREET.dragon, motion.position))


def test_lanes_and_gates_are_those_of_small_steps_and_spectators_stand_as_far_back_as_asked(ask):
    answer = ask("safety-sheet", BODY)
    times, motion, outlines = benches(answer)
    swept, kept = (shapely.from_geojson(json.dumps(one)) for one in (answer["swept"]["ground"], answer["spectators"]))
    assert shapely.contains(kept, shapely.buffer(swept, 2.0 + 0.05))
    assert not shapely.contains(kept, shapely.buffer(swept, 2.0 + 0.3))
    assert answer["loose_tail"]["beyond_spectators"]
    lanes = [{"name": f"{y} m north", "points": [[0, y], [60, y]], "width": 4} for y in (5, 9)]
    wider = ask("safety-sheet", BODY | {"spectators": 4.0, "lanes": lanes})
    assert not wider["loose_tail"]["beyond_spectators"]
    assert [(one["stays"], one["in_loose_reach"]) for one in wider["lanes"]] == [([], True), ([], False)]
    crossed, beside, over = answer["lanes"]
    inside = (shapely.distance(outlines, shapely.box(28, -8, 32, 8)) <= 0.0).any(axis=1)
    assert crossed["free_width"] == 0.0
    assert_near(crossed["total"], inside.sum() * STEP, 0.3)  # people may stray, forwards too
    (stay,) = crossed["stays"]
    assert stay["begin"] <= times[inside].min()
    assert stay["end"] >= times[inside].max()
    assert stay["first"] == 0
    assert stay["last"] == 4
    (stay,) = beside["stays"]
    assert stay["begin"] == answer["start"]
    assert stay["end"] == answer["stop"]
    assert 3.25 + 2.7 < beside["free_width"] < 3.25 + 2.85
    assert 2.0 - 0.15 - 0.1 < over["free_width"] < 2.0 - 0.15 - 0.05
    (gate,) = answer["gates"]
    passed = [times[np.argmax(motion.position[:, k, 0] >= 50.0)] for k in (0, -1)]
    assert_near((gate["head"], gate["lasts"]), (passed[0], 2.86 + 4 * 1.65), 0.02)


def test_lanes_and_gates_of_the_venue_are_those_of_the_request(ask):
    drawn = [
        {"type": "Feature", "properties": {"name": one["name"], "role": "emergency lane", "radius": 0.5 * one["width"]},
         "geometry": {"type": "LineString", "coordinates": one["points"]}}
        for one in BODY["lanes"]
    ]  # fmt: skip
    gates = [
        {
            "type": "Feature",
            "properties": {"name": name, "role": "gate"},
            "geometry": {"type": "Point", "coordinates": at},
        }
        for name, at in (("east gate", [50, 0.2]), ("a gate that nobody passes", [20, 8]))
    ]
    venue = {
        "type": "FeatureCollection",
        "features": [{"type": "Feature", "geometry": YARD, "properties": {}}, *drawn, *gates],
    }
    answer = ask("safety-sheet", BODY | {"venue": venue, "lanes": [], "gates": []})
    expected = ask("safety-sheet", BODY)
    assert answer["lanes"] == expected["lanes"]
    assert answer["gates"] == expected["gates"]
    assert "a gate that nobody passes" in words_of(
        pages_of(ask.file("safety-sheet", BODY | {"venue": venue}, PDF_TYPE))[0]
    )
    ask.refuses("/venue 10 11", "safety-sheet", BODY | {"venue": venue, "lanes": BODY["lanes"][:1] * 8})


# Two dragons cross, the second one later and faster; it stands in the lane at the end.
TWO = {
    "dances": [
        {"name": "blue", "dragon": {"benches": 5}, "path": line((-40, 0), (40, 0))},
        {"name": "red", "dragon": {"benches": 5}, "path": line((0, -40), (0, 40)), "head_speed": 1.1, "delay": 15},
    ],
    "venue": {"type": "GeometryCollection", "geometries": [box(-50, -50, 50, 50), box(3, 2.0, 5, 4.0)]},
    "spectators": 2.0,
    "loose": 2,
    "reaction": 1.5,
    "gates": [{"name": "north gate", "x": 0, "y": 30}],
    "lanes": [{"name": "ambulances", "points": [[-20, 37], [20, 37]], "width": 4}],
}


def test_several_dragons_have_one_sheet_whose_numbers_are_those_of_small_steps_on_one_clock(ask):
    answer = ask("safety-sheet", TWO)
    assert (answer["start"], answer["stop"]) == pytest.approx((CROSSING.begin, CROSSING.end.time))
    times = np.linspace(
        answer["start"], answer["stop"], 1 + 10 * round(0.1 * (answer["stop"] - answer["start"]) / STEP)
    )
    motions = trajectory(CROSSING, times)
    blue, red = (shapely.polygons(bench_outlines(STREET.dragon, motion.position)) for motion in motions)
    swept, loose = (shapely.from_geojson(json.dumps(answer[name]["ground"])) for name in ("swept", "loose_tail"))
    passed = shapely.union_all(np.concatenate([one[::10].ravel() for one in (blue, red)]))
    assert shapely.contains(swept, passed)
    assert shapely.contains(shapely.buffer(passed, 0.02), swept)
    reach = 1.65 + np.hypot(1.65 + 0.275, 0.15)
    assert swept.area == pytest.approx(answer["swept"]["area"])
    assert answer["loose_tail"]["reach"] == pytest.approx(reach)
    joints = np.concatenate([motion.position[::50, 3] for motion in motions])
    assert shapely.contains(loose, shapely.buffer(shapely.points(joints), 0.999 * reach)).all()
    kept = shapely.from_geojson(json.dumps(answer["spectators"]))
    assert shapely.contains(kept, shapely.buffer(swept, 2.0))
    # The least gap of the two, and to the obstacle.
    gaps = np.array([shapely.distance(blue[:, [a]], red) for a in range(5)])
    between, own, other, tree, _ = answer["approaches"]
    assert_near((between["distance"], between["time"]), (gaps.min(), times[gaps.min(axis=(0, 2)).argmin()]), 0.01)
    assert [(one["distance"], one["dragons"]) for one in (own, other)] == [
        (pytest.approx(1.1), [0, 0]), (pytest.approx(1.1), [1, 1])
    ]  # fmt: skip
    assert between["dragons"] == [0, 1]
    assert between["sentence"] == "the tail of blue and the head of red"
    assert tree["distance"] == pytest.approx(
        min(shapely.distance(shapely.box(3, 2, 5, 4), one).min() for one in (blue, red))
    )
    assert tree["area"] == "obstacle 1"
    assert tree["dragons"] == [0]
    (lane,) = answer["lanes"]
    inside = (shapely.distance(red, shapely.box(-20, 35, 20, 39)) <= 0.0).any(axis=1)
    (stay,) = lane["stays"]
    assert stay["dragon"] == 1
    assert stay["end"] == answer["stop"]
    assert_near(lane["total"], inside.sum() * STEP, 0.02)
    (gate,) = answer["gates"]
    passed = times[np.argmax(motions[1].position[:, 0, 1] >= 30.0)]
    assert (gate["dragon"], gate["head"], gate["lasts"]) == (
        1,
        pytest.approx(passed, abs=0.02),
        pytest.approx(9.46 / 1.1),
    )
    assert answer["fastest"]["dragon"] == 1
    assert answer["fastest"]["speed"] == pytest.approx(1.1)
    assert_near(answer["stopping"]["distance"], 1.5 * 1.1, 1e-5)


def test_the_sheet_of_several_dragons_names_them_and_says_when_two_meet(ask):
    (page,) = pages_of(ask.file("safety-sheet", TWO, PDF_TYPE))
    words = words_of(page)
    assert [
        one for one in ("2 dragons, 10 benches", "of blue and the head of red", "red: north gate") if one not in words
    ] == []
    blue, red = TWO["dances"]
    met = ask("safety-sheet", TWO | {"dances": [blue, red | {"delay": 8}]})
    assert met["verdict"] == "fails"
    assert " of red touch." in met["sentences"][0]


def test_what_is_assumed_is_told_from_what_is_given(ask):
    yours = {one["label"]: one["yours"] for one in ask("safety-sheet", BODY)["assumptions"]}
    assert yours["people stand back"]
    assert not yours["speed of the head"]
    bare = ask("safety-sheet", IN_STREET)
    assert [one["label"] for one in bare["assumptions"] if one["yours"]] == ["benches"]
    assert bare["lanes"] == []
    assert bare["gates"] == []
    # A page sends all fields: one that is the default may be one that nobody has thought of.
    sent = {"head_length": 3.41, "width": 0.3, "benches": 5}
    every = IN_STREET | {"dragon": sent, "head_speed": 1.0, "margin": 0.0, "stray": 0.0, "reaction": 2.0}
    assert ask("safety-sheet", every)["assumptions"] == bare["assumptions"]
    (page,) = sheets_of(ask.file("safety-sheet", every, PDF_TYPE))
    assert "nobody leaves their place, which is only assumed" in " ".join(page.split())


def test_streets_that_were_added_are_assumed_and_only_who_leaves_the_square_passes_a_gate(ask):
    """A path enters by the gate in the west, comes back to it twice on the square, and leaves by that in the north."""
    ways = [(-20, 0), (20, 0), (20, 14), (3, 14), (3, -14), (17, -14), (17, 10), (3, 10), (3, -10), (12, -10), (12, 40)]
    square = [[0, -20], [40, -20], [40, 20], [0, 20], [0, -20]]
    area = [[0, -20], [40, -20], [40, 20], [14, 20], [14, 50], [10, 50], [10, 20], [0, 20]]
    area += [[0, 2], [-25, 2], [-25, -2], [0, -2], [0, -20]]

    def aside(kind, coordinates, **properties):
        return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}

    inner = aside("LineString", square, role="square without streets")
    gates = [aside("Point", at, role="gate", name=name) for name, at in (("west", [0, 0]), ("north", [12, 20]))]
    body = {"dragon": {"benches": 3}, "path": line(*ways, radius=1.5, straight=list(range(10))), "spectators": 2.0}
    venues = [
        {"type": "FeatureCollection", "features": [polygon(area, name="square"), *gates, *more]}
        for more in ([], [inner])
    ]
    answers = [ask("safety-sheet", body | {"venue": venue}) for venue in venues]
    drawn, added = ({one["label"]: one["yours"] for one in answer["assumptions"]} for answer in answers)
    assert drawn["square, streets and obstacles"]
    assert (added["square and obstacles"], added["streets beyond the gates"]) == (True, False)
    assert [one["name"] for one in answers[0]["gates"]] == ["west", "west", "west", "north"]
    assert [one["name"] for one in answers[1]["gates"]] == ["west", "north"]
    words = " ".join(sheets_of(ask.file("safety-sheet", body | {"venue": venues[0]}, PDF_TYPE))[0].split())
    assert words.count("west: head") == 2
    assert re.search(r"west: head .*\(first of 3 times\).*west: head .*\(last of 3 times\).*north: head", words)


@pytest.mark.parametrize(
    "more, verdict, words",
    [
        ({}, "passes", "It can be danced"),
        ({"speed_limit": 0.5}, "fails", "It cannot be danced like this"),
        ({"dragon": {"benches": 1}, "lanes": [], "loose": 1}, "passes", "It can be danced"),
        ({"margin": 1.5, "start": 20}, "fails", "It cannot be danced like this"),
    ],
    ids=["passes", "too fast", "one bench", "too near from the start on"],
)
def test_the_verdict_is_said_in_two_sentences(ask, more, verdict, words):
    answer = ask("safety-sheet", BODY | more)
    assert answer["verdict"] == verdict
    assert answer["sentences"][0].startswith(words)
    assert len(answer["sentences"]) == 2


@pytest.mark.parametrize(
    "more, expected",
    [
        ({"loose": 6}, "/loose 6 5"),
        ({"lanes": [{"name": "a", "points": [[0, 0], [0, 0]]}]}, "/lanes/0/points line"),
        ({"gates": [{"name": "far", "x": 0, "y": 90}]}, "/gates/0 far 5"),
        ({"address": "dragon.example"}, "/address https"),
    ],
    ids=["more loose benches than there are", "a lane without a length", "a gate off the path", "no address"],
)
def test_what_the_dance_does_not_have_is_refused(ask, more, expected):
    ask.refuses(expected, "safety-sheet", BODY | more)


ADDRESS = "https://dragon.example/?door=village&benches=5&route=" + "0,1.5_" * 40
SAID = {
    "en": ["It can be danced", "Nearest approaches", "ambulances, 4 m wide", "Li Wei"],
    "zh": ["可以舞", "最近之处", "ambulances，宽 4 m", "Li Wei"],
}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_page_has_its_words_in_order_a_map_to_scale_and_a_code_that_a_phone_reads(ask, language):
    body = BODY | {"title": "Lantern festival", "language": language, "address": ADDRESS, "stopper": "Li Wei"}
    data = ask.file("safety-sheet", body, PDF_TYPE)
    (page,) = pages_of(data)
    words = words_of(page)
    assert "3.6 m" in words  # the reach of two loose benches, 3.58 m, rounded up
    verdict, near, lane, stop = (words.index(one) for one in SAID[language])
    assert 0 == words.index("Lantern festival") < verdict < near < lane < stop
    for dpi in (150, 300):
        code = zxingcpp.read_barcode(page.render(scale=dpi / 72).to_pil())
        assert code.text == short_form(ADDRESS)
    assert data == ask.file("safety-sheet", body, PDF_TYPE)


@pytest.mark.parametrize("paper, size", [("A4", (210, 297)), ("A3", (297, 420))])
def test_the_scale_on_the_sheet_is_true_to_two_tenths_of_a_millimetre(ask, paper, size):
    (page,) = pages_of(ask.file("safety-sheet", BODY | {"paper": paper}, PDF_TYPE))
    assert_near(page.get_size(), [side * 72 / 25.4 for side in size], 0.01)
    scale = int(re.search(r"1:(\d+) ", words_of(page))[1])
    # The obstacle of 2 m by 2 m and the square of 70 m by 16 m; bounds hold the line around a shape twice.
    boxes = np.array(shapes_of(page)) * 25.4 / 72.0
    sizes = boxes[:, 2:] - boxes[:, :2]
    for wide, high, edge in ((2.0, 2.0, 0.7), (70.0, 16.0, 1.2)):
        expected = np.array([wide, high]) * 1000.0 / scale + 2.0 * edge * 25.4 / 72.0
        assert np.abs(sizes - expected).max(axis=1).min() < 0.2


def test_many_lanes_and_gates_take_a_second_page_and_nothing_is_lost(ask):
    lanes = [{"name": f"lane number {k}", "points": [[30 + k, -8], [30 + k, 8]], "width": 1} for k in range(10)]
    gates = [{"name": f"gate number {k}", "x": 10 + 2 * k, "y": 0} for k in range(20)]
    sheets = sheets_of(ask.file("safety-sheet", BODY | {"lanes": lanes, "gates": gates}, PDF_TYPE))
    words = " ".join(sheets)
    assert len(sheets) == 2
    assert [one["name"] for one in (*lanes, *gates) if one["name"] not in words] == []
    assert "signature" in sheets[-1]


def test_the_verdict_names_what_its_reader_must_not_overlook(ask):
    used = next(one for one in ask("safety-sheet", BODY)["lanes"] if one["stays"])
    bare = {name: value for name, value in BODY.items() if name != "stray"}
    for body, assumed in ((BODY, False), (bare, True)):
        words = " ".join(sheets_of(ask.file("safety-sheet", body, PDF_TYPE))[0].split())
        assert (
            f"Not to be overlooked: {'nobody leaves their place, which is only assumed; ' if assumed else ''}" in words
        )
        assert ("only assumed" in words) == assumed
        assert f"benches are in “{used['name']}” for {used['total']:.0f} s" in words


def test_two_thousand_benches_have_one_page_and_any_name_is_text(ask):
    benches = 2000
    street = line((0, 0), (60 + 1.7 * benches, 0)) | {"start": 1.7 * benches}
    (long,) = sheets_of(ask.file("safety-sheet", {"dragon": {"benches": benches}, "path": street}, PDF_TYPE))
    assert "2000 benches" in long
    names = ["n" * 200, "\U0001f409" * 50, "\u05e9\u05dc\u05d5\u05dd", "#let *x* <b>$"]
    dragon = {"benches": 5, "names": [*names, ""]}
    venue = {"type": "FeatureCollection", "features": [polygon(*YARD["geometries"][0]["coordinates"], name=names[2])]}
    body = BODY | {"dragon": dragon, "venue": venue, "stopper": names[3], "title": names[1][:80]}
    sheet = "".join(" ".join(sheets_of(ask.file("safety-sheet", body, PDF_TYPE))).split())
    shown = [names[2], names[2][::-1]], ["".join(names[3].split())]
    assert [one for one in shown if not any(words in sheet for words in one)] == []
