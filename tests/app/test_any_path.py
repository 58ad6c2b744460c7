"""Turns, routes, waypoints and venues through the real service; wire/test_refusals.py has what is wrong with them."""

import json
import math
from itertools import pairwise

import pytest

import core
from app.questions.shortest_turn import ShortestTurnRequest, shortest_turn
from app.wire.question import Terms
from tests.support.asking import assert_motion, line

TURN = {"kind": "turn", "pitch": 1.7, "turning_diameter": 9, "ratio": 2}
LANE = {"kind": "line", "start": [0, 0], "end": [60, 0]}
SHORT = {"benches": 4}


def route(*pieces, start=0):
    return {"kind": "route", "pieces": list(pieces), "start": start}


# Four benches are 7.81 m from handle 0 to handle 4.
STRAIGHT = line((0, 0), (20, 0), (40, 0), (60.5, 0))
LONG_LANE = route(LANE | {"end": [900, 0]})


# -- turns ---------------------------------------------------------------------------------------------------


def test_a_turn_of_any_ratio_is_that_of_core():
    """A little work gives one of them, and a wide bracket."""
    request = ShortestTurnRequest(pitch=1.7, any_ratio=True)
    answer = shortest_turn(request, Terms(budget=core.Budget(1e7)))
    known = core.shortest_turn(core.Dragon(), 1.7, ratio=None, budget=core.Budget(1e7))
    assert answer.ratio == known.turn.ratio
    assert answer.length_bracket == known.length_bracket
    assert answer.sentences[-1].startswith("The work was spent")


def test_a_turn_with_any_bend_is_that_of_core_and_a_whole_answer_says_nothing_of_work():
    request = ShortestTurnRequest(pitch=1.7, ratio=1.25, any_bend=True)
    answer = shortest_turn(request, Terms(budget=core.Budget(5e7)))
    known = core.followed_turn(core.Dragon(), 1.7, ratio=1.25, budget=core.Budget(5e7))
    assert answer.length_bracket == known.length_bracket
    assert answer.limited_by is core.TurnLimit.FOLLOWING
    assert answer.sentences[-1].startswith("The work was spent")
    whole = shortest_turn(ShortestTurnRequest(pitch=1.7), Terms(budget=core.Budget()))
    assert not any(sentence.startswith("The work") for sentence in whole.sentences)


# -- routes and waypoints ------------------------------------------------------------------------------------


BEND = ((60.0, 4.0), 4.0, -0.5 * math.pi, 0.5)
# Every kind of a path and of a piece, with each of its fields -> the path of core.
KINDS = {
    '{"kind": "spiral", "pitch": 0.6, "start_turns": 9, "centre": [3, -2], "rotation": 0.4, "clockwise": false}': (
        core.Spiral(0.6, 9.0, (3.0, -2.0), 0.4, clockwise=False)
    ),
    '{"kind": "turn", "pitch": 1.6, "turning_diameter": 8.6, "ratio": 1.5, "start_turns": 12, "entry_radius": 4.2, '
    '"exit_radius": 4.1}': core.Turn(1.6, 4.3, 1.5, start_turns=12.0, entry_radius=4.2, exit_radius=4.1),
    '{"kind": "turn", "ratio": 1, "middle": 4, "ends": 0.5}': core.ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5),
    '{"kind": "waypoints", "points": [[0, 0], [20, 3], [60, 0]], "start_heading": 0.1, '
    '"end_heading": -0.2, "start": 9}': (
        core.Route([core.Waypoints(((0.0, 0.0), (20.0, 3.0), (60.0, 0.0)), 0.1, -0.2)], 9.0)
    ),
    '{"kind": "waypoints", "points": [[0, 0], [30, 0], [30, 30]], "straight": [0, 1], "radius": 5}': (
        core.Legs(((0.0, 0.0), (30.0, 0.0), (30.0, 30.0)), (0, 1), radius=5.0)
    ),
    '{"kind": "route", "start": 20, "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}, {"kind": "arc", '
    '"centre": [60, 4], "radius": 4, "start_angle": -1.5707963267948966, "sweep": 0.5}]}': (
        core.Route([core.Line((0.0, 0.0), (60.0, 0.0)), core.Arc(*BEND)], 20.0)
    ),
    '{"kind": "route", "pieces": [{"kind": "coil", "pitch": 0.55, "start_turns": 16, "end_turns": 3, "centre": [1, 2], '
    '"rotation": 0.3}]}': core.Route([core.Coil(0.55, 16.0, 3.0, (1.0, 2.0), 0.3)]),
    '{"kind": "route", "pieces": [{"kind": "clothoid", "start": [1, 2], "heading": 0.3, "start_curvature": 0.1, '
    '"end_curvature": 0.3, "length": 20}]}': core.Route([core.Clothoid((1.0, 2.0), 0.3, 0.1, 0.3, 20.0)]),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_path_and_piece_is_that_of_core(ask, kind):
    dance = core.Dance(core.Dragon(**SHORT), KINDS[kind])
    times = [dance.begin + 1.0, dance.begin + 4.0]
    answer = ask("trajectory", {"dragon": SHORT, "path": json.loads(kind), "times": times})
    assert_motion(answer, core.trajectory(dance, times))


# A path and times, as far as they are given -> the first and the last instant of the answer, and its step.
INSTANTS = {
    "LANE null": (8, 60, 1),
    "LANE+5 null": (3, 55, 1),
    "LANE+9 null": (0, 51, 1),
    "LONG null": (8, 308, 1),
    "TURN null": (0, 300, 1),
    'LANE {"stop": 20}': (8, 20, 1),
    'LANE {"start": 20}': (20, 60, 1),
    'STRAIGHT {"stop": 20, "step": 5}': (8, 18, 5),
    'LONG {"start": 7.9, "step": 100}': (7.9, 207.9, 100),
    'TURN {"start": -50, "step": 50}': (-50, 300, 50),
}
PATHS = {"LANE": route(LANE), "STRAIGHT": STRAIGHT, "LONG": LONG_LANE, "TURN": TURN}


@pytest.mark.parametrize("call", ["trajectory", "clearance"])
@pytest.mark.parametrize("given", INSTANTS)
def test_a_start_or_stop_that_is_left_out_lies_in_the_run(ask, call, given):
    (name, _, start), times = given.partition(" ")[0].partition("+"), json.loads(given.partition(" ")[2])
    body = {"dragon": SHORT, "path": PATHS[name] | ({"start": int(start)} if start else {})}
    got = ask(call, body | {"times": times})["time"]
    assert (got[0], got[-1], {after - before for before, after in pairwise(got)}) == (
        *INSTANTS[given][:2],
        {INSTANTS[given][2]},
    )
    if times is None:
        assert ask(call, body)["time"] == got
