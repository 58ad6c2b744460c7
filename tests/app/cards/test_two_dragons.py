"""Cards of two dragons in one spiral: all on them is found a second time, without core and its search.

Handles are complex numbers on r = growth theta; the head is where the arc length says, and every other handle where the
chord to its leader says. Meetings are changes of sign in small steps, narrowed by bisection; gaps, and what hides a
bench, are shapely's.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import httpx
import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from app.questions.cues import QUESTION as CUES
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.wire.messages import checked
from app.wire.question import Terms
from core.people.cards import CUES_MOST, FASTER, TOGETHER
from core.people.cues import REACH
from core.people.meetings import ABREAST, EVEN
from tests.support.paper import pages_of, words_of

Floats = NDArray[np.float64]
Places = NDArray[np.complex128]

# Both wind into one spiral from opposite sides. The second one begins later, hurries, pauses, and goes on slowly.
PITCH, TURNS, STOP = 1.7, 5.0, 118.0
NAMES = ["Zhou", "Wu", "", "Wang", *[f"family {k}" for k in range(4, 20)]]
SPIRAL = {"kind": "spiral", "pitch": PITCH, "start_turns": TURNS}
TWO: dict[str, Any] = {
    "dances": [
        {"name": "blue", "dragon": {"benches": 20, "names": NAMES}, "path": SPIRAL},
        {"name": "red", "delay": 6, "head_speed": 0.95, "dragon": {"benches": 11},
         "passages": [{"speed": 1.1, "until_time": 12}, {"speed": 0, "until_time": 20}],
         "path": SPIRAL | {"rotation": math.pi}},
    ],
    "stop": STOP, "start_clock": "19:45", "title": "Lantern night",
}  # fmt: skip
# Time between two looks of the search [s], and halvings of such a time.
LOOK, HALVINGS = 0.02, 45
# Rounding of places and gaps [m], of angles [rad], and of speeds [m/s]; a time from a slow change of sign [s].
ROUNDING, MOMENT = 1e-9, 1e-5
SPACING, STEP = 5.0, 0.75  # of the chalk marks, of a step [m]
WIDTH, OVERHANG, HEAD, BODY = 0.3, 0.275, 3.41, 2.2  # of benches [m]


@dataclass(frozen=True)
class Coil:
    """A dragon on its arm of the spiral.

    benches: their number; rotation: of the arm [rad]; times, ways: of the head, at the ends of its speeds [s], [m];
    pause: the times between which it stands after it has begun [s]
    """

    benches: int
    rotation: float
    times: tuple[float, ...]
    ways: tuple[float, ...]
    pause: tuple[float, float] | None = None

    @property
    def lengths(self) -> Floats:
        return np.array([HEAD] + [BODY] * (self.benches - 1))

    def head_speed(self, times: Floats) -> Floats:
        """Speed of the head [m/s]; where it changes, the higher one."""
        speeds = np.concatenate([[0.0], np.diff(self.ways) / np.diff(self.times), [0.0]])
        ends = np.array(self.times)
        return np.maximum(*(speeds[np.searchsorted(ends, times, side=side)] for side in ("left", "right")))

    def angles(self, times: Floats) -> Floats:
        """Polar angles of all handles (T, n + 1) [rad]."""
        growth, ways = PITCH / math.tau, np.interp(times, self.times, self.ways)
        wanted = (arc(math.tau * TURNS) - ways) / growth
        theta = np.sqrt(2.0 * wanted)
        for _ in range(6):
            theta -= (arc(theta) / growth - wanted) / np.hypot(1.0, theta)
        angles = [theta]
        for chord in (self.lengths - 2.0 * OVERHANG) / growth:
            front, rear = angles[-1], angles[-1] + chord / np.hypot(1.0, angles[-1])
            for _ in range(8):
                cos, sin = np.cos(rear - front), np.sin(rear - front)
                value = front**2 + rear**2 - 2.0 * front * rear * cos - chord**2
                rear = rear - value / (2.0 * (rear - front * cos + front * rear * sin))
            angles.append(rear)
        return np.stack(angles, axis=-1)

    def handles(self, times: Floats) -> Places:
        angles = self.angles(times)
        places: Places = PITCH / math.tau * angles * np.exp(1j * (angles + self.rotation))
        return places

    def tangents(self, times: Floats) -> Places:
        """Directions in which the handles walk, as complex numbers of length 1."""
        angles = self.angles(times)
        inwards: Places = -(1.0 + 1j * angles) * np.exp(1j * (angles + self.rotation)) / np.hypot(1.0, angles)
        return inwards

    def speeds(self, times: Floats) -> Floats:
        """Speeds of all handles (T, n + 1) [m/s]: both ends of a bench go equally fast along it."""
        handles, tangents = self.handles(times), self.tangents(times)
        along = -np.diff(handles, axis=1)
        front, rear = ((one * along.conj()).real for one in (tangents[:, :-1], tangents[:, 1:]))
        first = self.head_speed(times)[:, None]
        return np.concatenate([first, first * np.cumprod(front / rear, axis=1)], axis=1)


def numbers_in(runs: str) -> set[int]:
    """The numbers that a text such as 3-5, 7 names."""
    ends = [[int(one) for one in part.split("-")] for part in runs.split(", ")]
    return {number for part in ends for number in range(part[0], part[-1] + 1)}


def arc(theta: Any) -> Any:
    """Arc length from the centre of the spiral [m]."""
    return PITCH / math.tau / 2.0 * (theta * np.hypot(1.0, theta) + np.arcsinh(theta))


BLUE = Coil(20, 0.0, (0.0, STOP), (0.0, STOP))
RED = Coil(11, math.pi, (6.0, 18.0, 26.0, STOP), (0.0, 13.2, 13.2, 13.2 + 0.95 * (STOP - 26.0)), (18.0, 26.0))
COILS = (BLUE, RED)
# Dragon and number of each bench, dragon by dragon.
BENCHES = [(dragon, bench) for dragon, coil in enumerate(COILS) for bench in range(coil.benches)]


class Met(NamedTuple):
    """A meeting: time [s], dragon and bench, side, gap [m], whether it is oncoming, and the own middle."""

    time: float
    dragon: int
    bench: int
    side: str
    gap: float
    oncoming: bool
    middle: complex


def benches_at(times: Floats) -> tuple[Places, Places]:
    """Middles and directions of all benches (T, N)."""
    handles = [coil.handles(times) for coil in COILS]
    middles = np.concatenate([0.5 * (one[:, :-1] + one[:, 1:]) for one in handles], axis=1)
    along = np.concatenate([one[:, :-1] - one[:, 1:] for one in handles], axis=1)
    return middles, along / np.abs(along)


def outlines(middles: Places, along: Places) -> Any:
    """All benches as polygons (T, N)."""
    lengths = np.concatenate([coil.lengths for coil in COILS])[:, None]
    corners = 0.5 * lengths * np.array([1, 1, -1, -1]) + 0.5j * WIDTH * np.array([1, -1, -1, 1])
    points = middles[..., None] + along[..., None] * corners
    return shapely.polygons(np.stack([points.real, points.imag], axis=-1))


def changes() -> list[tuple[int, int, float, float]]:
    """Own and other bench, and two times [s]: more than EVEN ahead at one of them, and behind at the other."""
    times = np.linspace(0.0, STOP, round(STOP / LOOK) + 1)
    middles, along = benches_at(times)
    pairs = []
    for own, (dragon, bench) in enumerate(BENCHES):
        ahead = ((middles - middles[:, own, None]) * along[:, own, None].conj()).real
        for other, (its_dragon, its_bench) in enumerate(BENCHES):
            if its_dragon == dragon and abs(its_bench - bench) <= 1:
                continue
            counts = np.flatnonzero(np.abs(ahead[:, other]) > EVEN)
            for before, after in pairwise(counts.tolist()):
                if ahead[before, other] * ahead[after, other] < 0.0:
                    pairs.append((own, other, float(times[before]), float(times[after])))
    return pairs


def every_meeting() -> dict[tuple[int, int], list[Met]]:
    """The meetings of each bench, in order of time."""
    columns = [np.array(column) for column in zip(*changes(), strict=True)]
    (own, other), (low, high) = columns[:2], columns[2:]
    rows = np.arange(own.size)

    def ahead(times: Floats) -> Floats:
        middles, along = benches_at(times)
        way: Floats = ((middles[rows, other] - middles[rows, own]) * along[rows, own].conj()).real
        return way

    begins_ahead = ahead(low) > 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = (ahead(middle) > 0.0) == begins_ahead
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    middles, along = benches_at(low)
    shapes = outlines(middles, along)
    gaps = shapely.distance(shapes[rows, own], shapes[rows, other])
    ends = np.stack([middles[rows, own], middles[rows, other]], axis=-1)
    sights = shapely.linestrings(np.stack([ends.real, ends.imag], axis=-1))
    hides = shapely.intersects(shapes, sights[:, None])
    hides[rows, own] = hides[rows, other] = False
    to_it = (middles[rows, other] - middles[rows, own]) * along[rows, own].conj()
    oncoming = (along[rows, other] * along[rows, own].conj()).real < 0.0
    met: dict[tuple[int, int], list[Met]] = {one: [] for one in BENCHES}
    for k in np.flatnonzero((gaps <= REACH) & ~hides.any(axis=1)).tolist():
        side = "left" if to_it[k].imag > 0.0 else "right"
        one = Met(float(low[k]), *BENCHES[other[k]], side, float(gaps[k]), bool(oncoming[k]), middles[k, own[k]])
        met[BENCHES[own[k]]].append(one)
    return {bench: sorted(some) for bench, some in met.items()}


@pytest.fixture(scope="module")
def cards(client: httpx.Client) -> list[dict[str, Any]]:
    answer: list[dict[str, Any]] = client.post("/cues", json=TWO).raise_for_status().json()["cards"]
    return answer


def clock(time: float) -> str:
    return f"19:{45 + int(time) // 60:02d}:{int(time) % 60:02d}"


def test_every_bench_of_both_has_a_card_with_its_neighbours(cards: Any) -> None:
    assert [(card["dragon"], card["bench"]) for card in cards] == BENCHES
    for card in cards:
        dragon, bench = card["dragon"], card["bench"]
        names = dict(enumerate((NAMES, [""] * 11)[dragon]))
        near = [one and (one["bench"], one["name"]) for one in (card["ahead"], card["behind"])]
        assert card["name"] == names[bench]
        assert near == [(k, names[k]) if k in names else None for k in (bench - 1, bench + 1)]


def test_every_meeting_has_its_time_place_side_and_distance_and_there_is_no_other(cards: Any) -> None:
    slow = every_meeting()
    for card in cards:
        own, met = (card["dragon"], card["bench"]), card["meetings"]
        expected = [(one.dragon, one.bench, one.side, one.oncoming) for one in slow[own]]
        assert [(one["dragon"], one["bench"], one["side"], one["oncoming"]) for one in met] == expected
        assert [one["time"] for one in met] == pytest.approx([one.time for one in slow[own]], abs=MOMENT)
        for one in met:
            dragon, bench = one["dragon"], one["bench"]
            middles, along = benches_at(np.array([one["time"]]))
            pair = [BENCHES.index(own), BENCHES.index((dragon, bench))]
            first, second = middles[0, pair]
            assert abs(((second - first) * along[0, pair[0]].conj()).real) <= ABREAST + ROUNDING
            assert complex(one["x"], one["y"]) == pytest.approx(first, abs=ROUNDING)
            assert one["gap"] == pytest.approx(shapely.distance(*outlines(middles, along)[0, pair]), abs=ROUNDING)
            assert one["clock"] == clock(one["time"])
            assert (one["dragon_name"], one["name"]) == (("blue", NAMES[bench]), ("red", ""))[dragon]
    every = [one for met in slow.values() for one in met]
    assert len(every) > 150
    assert len({(one.side, one.oncoming, one.dragon) for one in every}) > 4


def test_where_and_when_each_bench_stands_begins_pauses_and_ends(cards: Any) -> None:
    for card in cards:
        coil, bench = COILS[card["dragon"]], card["bench"]
        begin = coil.times[0]
        pauses = [cue for cue in card["cues"] if cue["kind"] == "pause"]
        assert [(one["since"], one["until"]) for one in pauses] == ([coil.pause] if coil.pause else [])
        stands = [(card["start"], 0.0), (card["begin"], begin), (card["done"], STOP)]
        for at, time in [*stands, *((one, one["since"]) for one in pauses)]:
            assert (at["time"], at["clock"]) == (time, clock(time))
            assert complex(at["x"], at["y"]) == pytest.approx(coil.handles(np.array([time]))[0, bench], abs=ROUNDING)
        first = coil.tangents(np.array([begin]))[0, bench]
        assert np.exp(1j * card["direction"]) == pytest.approx(first, abs=ROUNDING)
        # On a spiral a mark is where the head stands at time 0, and mark 0 is the last one behind the tail.
        ways = arc(math.tau * TURNS) - arc(coil.angles(np.array([0.0, begin, STOP])))
        zero = SPACING * math.floor(ways[0, -1] / SPACING)
        for (at, _), way in zip(stands, ways[:, bench], strict=True):
            assert at["mark"] % SPACING == 0.0
            assert at["mark"] + at["past_mark"] == pytest.approx(way - zero, abs=ROUNDING)
            assert abs(at["past_mark"]) <= 0.5 * SPACING
            assert at["steps"] == round(at["past_mark"] / STEP)


def test_no_bench_is_faster_than_its_fastest_moment(cards: Any) -> None:
    speeds = [coil.speeds(np.linspace(0.0, STOP, round(STOP / LOOK) + 1)) for coil in COILS]
    for card in cards:
        dragon, bench, fastest = card["dragon"], card["bench"], card["fastest"]
        then, handle = np.array([fastest["time"]]), fastest["handle"]
        assert handle in (bench, bench + 1)
        assert fastest["speed"] == pytest.approx(COILS[dragon].speeds(then)[0, handle], abs=ROUNDING)
        assert fastest["speed"] >= speeds[dragon][:, bench : bench + 2].max() - ROUNDING
        place = COILS[dragon].handles(then)[0, handle]
        assert complex(fastest["x"], fastest["y"]) == pytest.approx(place, abs=ROUNDING)
        assert fastest["speed_ratio"] == pytest.approx(fastest["speed"] / (1.0, 1.1)[dragon], abs=ROUNDING)


def ruled(card: dict[str, Any]) -> tuple[list[tuple[str, float]], list[float]]:
    """Kind and time of the cues that the rule of the docs chooses, and the gaps of the meetings left out [m]."""
    groups: list[list[dict[str, Any]]] = []
    for kind in {(one["side"], one["oncoming"], one["dragon"]) for one in card["meetings"]}:
        last = -math.inf
        for one in (one for one in card["meetings"] if (one["side"], one["oncoming"], one["dragon"]) == kind):
            if one["time"] - last > TOGETHER:
                groups.append([])
            groups[-1].append(one)
            last = one["time"]
    nearest = sorted((min(group, key=lambda one: one["gap"]) for group in groups), key=lambda one: one["gap"])
    pause = COILS[card["dragon"]].pause
    chosen = [("begin", card["begin"]["time"]), ("done", card["done"]["time"])]
    chosen += [("pause", pause[0])] if pause else []
    if card["fastest"]["speed_ratio"] > 1.0 + FASTER:
        chosen.append(("fastest", card["fastest"]["time"]))
    room = CUES_MOST - len(chosen)
    chosen += [("meeting", one["time"]) for one in nearest[:room]]
    return sorted(chosen, key=lambda cue: (cue[1], cue[0] == "done")), [one["gap"] for one in nearest[room:]]


def test_the_cues_are_those_that_the_rule_chooses_and_the_paper_has_them(cards: Any) -> None:
    paper = CUES.to_bytes(checked(CuesRequest, TWO), Terms(), PDF_TYPE)  # which no deadline ends
    text = "".join(map(words_of, pages_of(paper))).replace(" ", "")
    again = 0
    for card in cards:
        chosen, gaps = ruled(card)
        assert [(cue["kind"], cue["time"]) for cue in card["cues"]] == chosen
        assert card["left_out"] == len(gaps)
        assert card["least_left_out"] == min(gaps, default=None)
        for cue in card["cues"]:
            assert cue["clock"] == clock(cue["time"])
            assert "".join(cue["words"].split()) in text
            if near := cue["nearest"]:
                assert re.search(rf"straight on your {near['side']}, {near['gap']:.2f} m\b", cue["words"])
                # One bench that comes abreast again and again is not several.
                several, times = len(set(cue["others"])), len(cue["others"])
                listed = re.search(r"Benches ([\d, -]+) (?:pass you the other way|walk your way)", cue["words"])
                assert bool(listed) == (several > 1)
                assert listed is None or numbers_in(listed[1]) == set(cue["others"])
                assert (f"at the nearest of {times} times" in cue["words"]) == (several == 1 < times)
                again += several == 1 < times
    assert again > 0
    assert any(card["left_out"] for card in cards)
