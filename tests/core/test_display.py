"""Displays of every public value in a console and in a notebook: short, with units, and escaped."""

from __future__ import annotations

import math
import pickle
import typing
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from typing import Any

import numpy as np
import pytest

import core
from core import (
    Arc,
    Area,
    Coil,
    Dance,
    Dragon,
    Line,
    Route,
    Spiral,
    Turn,
    Venue,
    Waypoints,
)
from core.display import Readable, WithArrays, display, format_range, units_of
from core.errors import BenchDragonError
from tests.support.public_calls import CALLS

# A line of a console and a half: nothing public is longer [characters].
LINE_MOST = 220
DANCE = Dance(Dragon(), Spiral())
SQUARE = Venue(Area("square", (((-20, -20), (20, -20), (20, 20), (-20, 20), (-20, -20)),)))
CURVE = Waypoints(tuple((float(k), 0.01 * k * k) for k in range(1000)))


def parts(value: Any) -> Iterator[Any]:
    """A value and all values in it that have a display."""
    if isinstance(value, Readable):
        yield value
    if is_dataclass(value) and not isinstance(value, type):
        for field in fields(value):
            yield from parts(getattr(value, field.name))
    elif isinstance(value, (list, tuple)):
        for one in value:
            yield from parts(one)
    elif isinstance(value, dict):
        yield from parts(list(value.values()))


def results() -> Iterator[Any]:
    """One of every public result: of the short calls, and of others where these have none."""
    for call, arguments in CALLS.items():
        yield from parts(call(**arguments))
    yield from parts(core.first_contact(DANCE))
    yield from parts(core.check(DANCE, venue=SQUARE))
    yield from parts(core.tolerance(DANCE, stop=10.0))
    yield core.first_excess(Dance(Dragon(4), Spiral(1.2, 3.0)), 3.0)
    chance = core.contact_probability(DANCE, core.Wobble(), 2, 1, start=400.0, stop=410.0)
    yield from (chance, chance.claim)
    yield core.propose(SQUARE, Dragon(150), figures=["ring"]).reason
    yield from parts(core.course(core.Legs([(0, 0), (9, 0), (9, 9)], [0, 1], radius=1.0), Dragon(2)))
    there_and_back = Route(
        [Line((0, 0), (40, 0)), Arc((40, 2), 2.0, -0.5 * math.pi, math.pi), Line((40, 4), (0, 4))], 30
    )
    paused = Dance(
        Dragon(12), there_and_back, 1.0, [core.Passage(1.0, until_s=9.0), core.Passage(0.0, until_time=20.0)]
    )
    yield from parts(core.card_of(core.bench_cues(paused, [5])[0]))
    yield from core.crew(DANCE, [2] * 223, stop=9.0).carried[:1]
    yield core.Misplaced("well", 3, (1.0, 2.0))
    yield core.NearPass(75.06, 0.06, (0, 1), (1, 4))


INPUTS = [
    Dragon(),
    Dragon(benches=1, overhang=0.0),
    Dragon.of([3.0, 2.0, 4.0], [0.3, 0.2, 0.3], [0.2, 0.1, 0.2]),
    Dragon(2).named(["Zhou", ""]),
    Spiral(pitch=0.8),
    Spiral(centre=(7.0, -2.0), clockwise=False),
    core.Passage(0.5, until_s=20.0),
    core.Stray(0.02, 0.055, 0.05),
    core.Gate((-20.0, 3.0), 0.1),
    core.Relief(4, 600.0, (20.0, 45.5), rest=60.0),
    core.Wobble(lateral=0.02, pitch_error=0.001),
    Line((0.0, 1.0), (2.0, 3.0)),
    Arc((0.0, 0.0), 4.5, 0.25, -1.5),
    Coil(0.55, 3.0, 2.0),
    Waypoints(((0.0, 0.0), (6.0, 1.0), (11.0, 6.0)), start_heading=0.5),
    Dance(Dragon(3), Spiral(), head_speed=0.5),
    Dance(Dragon(3), Spiral(), passages=(core.Passage(0.5, until_s=20.0),)),
]


def others() -> list[Any]:
    """Inputs of another form; where the loops are not compiled, the long route takes half a second."""
    return [
        Dragon.of(np.linspace(2.0, 3.0, 300), [0.3] * 300, [0.2] * 300),
        CURVE,
        Route([CURVE]),
        Turn(1.7),
        core.Legs([(0, 0), (9, 0), (9, 9)], [0]),
        SQUARE,
        SQUARE.square,
    ]


def spent() -> core.Budget:
    """A budget of which a part is spent, and which was stopped."""
    budget = core.Budget(10.0)
    budget.spend(3.0)
    budget.stop()
    return budget


@pytest.fixture(scope="module")
def values() -> list[Any]:
    """Everything that is shown: results, one of each kind, and inputs."""
    entries = {type(value): value for value in results()}
    return [*entries.values(), *INPUTS, *others()]


def public() -> list[type]:
    """The public results: all classes but enumerations, errors and their values, names of kinds, and the budget."""
    every = (getattr(core, name) for name in core.__all__)
    others = (Enum, BenchDragonError, core.Budget, core.Given, core.Parameter, core.Quantity)
    return [one for one in every if isinstance(one, type) and not issubclass(one, others)]


def inside(hint: Any) -> Iterator[Any]:
    """A hint and all that it is made of."""
    yield hint
    for part in typing.get_args(hint):
        yield from inside(part)


def hints(kind: type) -> dict[str, Any]:
    """Types of the public fields of a dataclass; names known to type checkers alone stand for anything."""
    names = {**vars(__import__(kind.__module__, fromlist=["_"])), "pandas": core, "xarray": core, "Axes": object}
    hints_of = typing.get_type_hints(kind, globalns=names)
    return {field.name: hints_of[field.name] for field in fields(kind)}


def test_every_public_result_is_shown_here(values: list[Any]) -> None:
    kinds = set(map(type, values))
    assert set(public()) - kinds == set(), "a call in tests/support/public_calls.py must return one"


def test_the_types_of_public_fields_are_public() -> None:
    for kind in filter(is_dataclass, public()):
        held = {part for hint in hints(kind).values() for part in inside(hint) if isinstance(part, type)}
        ours = {part.__name__ for part in held if part.__module__.startswith("core.")}
        assert ours - set(core.__all__) == set(), kind


def test_every_number_of_a_public_result_has_its_unit() -> None:
    for kind in filter(is_dataclass, public()):
        floats = {name for name, hint in hints(kind).items() if {float, np.float64} & set(inside(hint))}
        assert floats - units_of(kind).keys() == set(), f"{kind.__name__} needs units for them, in its _units"


def test_a_number_of_a_bench_or_a_count_has_no_unit() -> None:
    for kind in filter(is_dataclass, public()):
        whole = {name for name, hint in hints(kind).items() if int in inside(hint) and float not in inside(hint)}
        assert {name: units_of(kind)[name] for name in whole if units_of(kind).get(name)} == {}, kind


def test_results_with_the_same_numbers_are_equal(values: list[Any]) -> None:
    with_arrays = [value for value in values if isinstance(value, WithArrays)]
    assert len(with_arrays) == 14
    for value in with_arrays:
        assert value != 3
        with pytest.raises(TypeError, match="unhashable"):
            hash(value)
    for value in values:
        again = pickle.loads(pickle.dumps(value))
        assert again is not value
        assert again == value
    assert core.trajectory(DANCE, [0.0, 1.0]) != core.trajectory(DANCE, [0.0, 2.0])
    assert core.trajectory(DANCE, [0.0]) != core.trajectory(DANCE, [0.0, 0.0])


def test_a_repr_is_one_short_line(values: list[Any]) -> None:
    for value in values:
        line = repr(value)
        assert type(value).__name__ in line
        assert "\n" not in line
        assert len(line) <= LINE_MOST, line


def test_a_notebook_gets_a_table(values: list[Any]) -> None:
    for value in values:
        html = value._repr_html_()
        assert html.startswith(f"<table><caption>{type(value).__name__}</caption><tr>")
        assert html.count("<tr>") == html.count("</td></tr>") == html.count("<th") > 0
        assert "object at 0x" not in html


@pytest.mark.parametrize("value", INPUTS, ids=repr)
def test_a_short_input_prints_the_call_that_makes_it(value: object) -> None:
    assert eval(repr(value), vars(core)) == value


@pytest.mark.parametrize("path", [Route([Line((0.0, 0.0), (9.0, 0.0))], start=2.0), Turn(1.7, entry_radius=4.0)])
def test_a_short_route_prints_the_call_that_makes_it(path: Route) -> None:
    again = eval(repr(path), vars(core))
    assert type(again) is type(path)
    assert np.array_equal(again.table, path.table)


def test_a_line_says_what_was_found_with_its_unit() -> None:
    for value, line in (
        (DANCE.end, "<RunEnd: reason fold, time 432.917924 s, theta 14.7346193 rad, bench 0>"),
        (core.first_contact(DANCE), "<FirstContact: benches 0 and 8 touch at 412.473838 s>"),
        (
            core.first_contact(DANCE, margin=0.05),
            "<FirstContact: benches 0 and 14 come within 0.05 m at 383.867583 s>",
        ),
        (core.first_contact(DANCE, stop=100.0), "<FirstContact: no two benches touch until 100 s>"),
        (
            core.first_contact(Dance(Dragon(), Spiral(0.8))),
            "<FirstContact: no two benches touch until 637.662028 s, where bench 0 folds>",
        ),
        (core.trajectory(DANCE, 300.0), "<Trajectory: 1 instant at 300 s; 224 handles, 0.99647754 to 1 m/s>"),
        (core.trajectory(DANCE, []), "<Trajectory: 0 instants; 224 handles>"),
        (
            core.minimum_pitch(Dragon()),
            "<MinimumPitch: 0.450337393 m, limited by graze of benches 0 and 19; proven for every larger pitch>",
        ),
        (
            core.highest_speed(DANCE, stop=10.0),
            "<HighestSpeed: speed 1 m/s, time 0 s, handles 0>",
        ),
        (core.Budget(), "<Budget: the default work of each question>"),
        (core.Budget(math.inf, brief=True), "<Budget: no limit, brief>"),
        (spent(), "<Budget: 7 of 10 steps of work left, stopped>"),
        (core.check(DANCE, stop=10.0), "<Report: passes, judged from 0 to 10 s>"),
        (CURVE, "<Waypoints: 1000 points from (0.0, 0.0) to (999.0, 9980.01) m>"),
        (core.separation([0, 0, 0], [2, 1], [3, 0, 0], [2, 1]), "<Separation: 1 m>"),
    ):
        assert repr(value) == line


def test_a_table_has_every_field_with_its_unit() -> None:
    html = core.first_contact(DANCE)._repr_html_()
    assert '<tr><th scope="row">time</th><td>412.473837682115 s</td></tr>' in html
    assert '<tr><th scope="row">benches</th><td>0, 8</td></tr>' in html
    assert '<tr><th scope="row">margin</th><td>0 m</td></tr>' in html
    fastest = core.highest_speed(Dance(Dragon(9), Turn(1.7)), start=0.0, stop=30.0)
    assert '<tr><th scope="row">handles</th><td>3, 4, 5, 6, 7</td></tr>' in fastest._repr_html_()


def test_zero_has_no_sign_and_an_unknown_bound_is_called_so() -> None:
    assert format_range([-0.0, 1.0], "m") == "0 to 1 m"
    assert display((1.5, None), "m/s") == "1.5, unknown m/s"


def test_a_name_in_a_table_is_escaped() -> None:
    area = Area("<script>alert('&')</script>", SQUARE.square.rings)
    html = Venue(area)._repr_html_()
    assert "<script>" not in html
    assert "&lt;script&gt;alert(&#x27;&amp;&#x27;)&lt;/script&gt;" in html


def test_ends_of_a_bracket_differ_in_a_table() -> None:
    low, high = core.first_contact(DANCE).time_bracket or (0.0, 0.0)
    assert f"{low:.15g}, {high:.15g} s" in core.first_contact(DANCE)._repr_html_()
    assert f"{low:.15g}" != f"{high:.15g}"


def test_a_long_route_is_displayed_by_its_pieces() -> None:
    lines = [Line((float(k), 0.0), (k + 1.0, 0.0)) for k in range(40)]
    assert repr(Route(lines, start=2.5)) == "<Route: 40 pieces (Line, Line, Line, Line, ...), s from -2.5 to 37.5 m>"


def test_a_table_of_many_pieces_or_points_stays_small() -> None:
    route = Route([Line((float(x), 0.0), (x + 1.0, 0.0)) for x in range(300)])
    table = route._repr_html_()
    assert len(table) < 1_000
    assert "<td>294</td>" in table
    ring = tuple((20.0 * math.cos(k / 80.0), 20.0 * math.sin(k / 80.0)) for k in range(500))
    table = Area("pond", ((*ring, ring[0]),))._repr_html_()
    assert len(table) < 1_000
    assert "and 495 more" in table


def test_a_bracket_stands_in_one_line_only_where_its_ends_differ() -> None:
    highest = core.highest_speed(DANCE, stop=10.0)
    assert "bracket" not in repr(replace(highest, speed_bracket=(1.0, 1.0 + 1e-12)))
    assert "speed bracket 1, 2 m/s" in repr(replace(highest, speed_bracket=(1.0, 2.0)))
    assert "speed bracket" in highest._repr_html_()
