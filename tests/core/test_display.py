"""Displays of every public value in a console and in a notebook: short, with units, and escaped."""

import html
import pickle
import re
import typing
from dataclasses import fields, is_dataclass
from enum import Enum
from itertools import chain

import numpy as np
import pytest

import core
from core import Arc, Area, Coil, Dance, Dragon, Line, Route, Spiral, Turn, Venue, Waypoints
from core.display import Readable, WithArrays, display, format_range, meanings
from core.errors import BenchDragonError
from core.language import speaking
from tests.support.public_calls import CALLS
from tests.support.shared_dances import lane, square, there_and_back

# A line of a console and a half: nothing public is longer [characters].
LINE_MOST = 220
DANCE = Dance(Dragon(), Spiral())
SQUARE = square(20)
# Numbers without a unit: ratios, probabilities, directions, numbers of benches; have and need have that of the reason.
PURE = {
    *("confidence", "correlation_benches", "have", "limits", "need", "normal", "probability", "speed_ratio", "turns"),
    "union_bound",
}
CURVE = Waypoints(tuple((float(k), 0.01 * k * k) for k in range(1000)))
STREETS = ((-40.0, 0.0), (40.0, 0.0)), ((0.0, -40.0), (0.0, 40.0))
LEGS = core.Legs([(0, 0), (9, 0), (1, 3)], [0, 1], radius=0.5)


def parts(value):
    """A value and all values in it that have a display."""
    inner = value if isinstance(value, (list, tuple)) else value.values() if isinstance(value, dict) else ()
    if is_dataclass(value) and not isinstance(value, type):
        inner = [getattr(value, field.name) for field in fields(value)]
    return chain([value] * isinstance(value, Readable), *map(parts, inner))


def results():
    """One of every public result: of the short calls, and of others where these have none."""
    yield from (call(**arguments) for call, arguments in CALLS.items())
    yield from (core.first_contact(DANCE), core.check(DANCE, venue=SQUARE), core.tolerance(DANCE, stop=10.0))
    yield core.first_excess(Dance(Dragon(4), Spiral(1.2, 3.0)), 3.0)
    chance = core.contact_probability(DANCE, core.Wobble(), 2, 1, start=400.0, stop=410.0)
    yield from (chance, chance.claim)
    yield core.propose(SQUARE, Dragon(150), figures=["ring"]).reason
    yield core.course(LEGS, Dragon(2))
    passages = core.Passage(1.0, until_s=9.0), core.Passage(0.0, until_time=20.0)
    yield core.card_of(core.bench_cues(Dance(Dragon(12), there_and_back(40), 1.0, passages), [5])[0])
    yield core.crew(DANCE, [2] * 223, stop=9.0).carried[:1]
    yield core.Misplaced("well", 3, (1.0, 2.0))
    yield core.NearPass(75.06, 0.06, (0, 1), (1, 4))


INPUTS = [
    Dragon(benches=1, overhang=0.0),
    Dragon.of([3.0, 2.0, 4.0], [0.3, 0.2, 0.3], [0.2, 0.1, 0.2]),
    Dragon(2).named(["Zhou", ""]),
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
    Dance(Dragon(3), Spiral(), passages=(core.Passage(0.5, until_s=20.0),)),
]


@pytest.fixture(scope="module")
def values():
    """Everything that is shown: results, one of each kind, and inputs."""
    entries = {type(value): value for value in parts(list(results()))}
    # Where the loops are not compiled, the long route takes half a second.
    long = Dragon.of(np.linspace(2.0, 3.0, 300), [0.3] * 300, [0.2] * 300), CURVE, Route([CURVE])
    return [*entries.values(), *INPUTS, *long, Turn(1.7), LEGS, SQUARE, SQUARE.square]


# The public results: all classes but enumerations, errors and their values, names of kinds, and the budget.
OTHERS = (Enum, BenchDragonError, core.Budget, core.Given, core.Parameter, core.Quantity)
PUBLIC = [one for one in map(vars(core).get, core.__all__) if isinstance(one, type) and not issubclass(one, OTHERS)]


def inside(hint):
    """A hint and all that it is made of."""
    return {hint}.union(*map(inside, typing.get_args(hint)))


def hints(kind):
    """Types of the public fields of a dataclass; names known to type checkers alone stand for anything."""
    names = {**vars(__import__(kind.__module__, fromlist=["_"])), "pandas": core, "xarray": core, "Axes": object}
    hints_of = typing.get_type_hints(kind, globalns=names)
    return {field.name: hints_of[field.name] for field in fields(kind)}


def test_every_public_result_is_shown_here(values):
    assert set(PUBLIC) - set(map(type, values)) == set(), "a call in tests/support/public_calls.py must return one"


@pytest.mark.parametrize("kind", [*filter(is_dataclass, PUBLIC)], ids=lambda kind: kind.__name__)
def test_the_fields_of_a_public_result_have_public_types_and_every_number_but_a_count_its_unit(kind):
    types = {name: inside(hint) for name, hint in hints(kind).items()}
    known = meanings(kind)
    held = {one for some in types.values() for one in some if isinstance(one, type)}
    assert {one.__name__ for one in held if one.__module__.startswith("core.")} <= set(core.__all__)
    for name, some in types.items():
        assert name in known, f"the docstring of {kind.__name__} must say what {name} is"
        if {float, np.float64} & some:
            assert known[name].unit or name in PURE, f"the docstring of {kind.__name__} must end {name} with its unit"
        else:
            assert int not in some or not known[name].unit, f"{name} of {kind.__name__} is a count"


def test_results_with_the_same_numbers_are_equal(values):
    assert sum(isinstance(value, WithArrays) for value in values) == 15
    for value in values:
        again = pickle.loads(pickle.dumps(value))
        assert again is not value
        assert again == value != 3
        if isinstance(value, WithArrays):
            with pytest.raises(TypeError, match="unhashable"):
                hash(value)
    assert core.trajectory(DANCE, [0.0]) != core.trajectory(DANCE, [1.0])


def test_every_value_has_one_short_line_and_a_table(values):
    for value in values:
        line = repr(value)
        table = value._repr_html_()
        name = type(value).__name__
        assert name in line
        assert "\n" not in line
        assert len(line) <= LINE_MOST, line
        assert table.startswith(f"<table><caption>{name}</caption><tr>")
        assert table.count("<tr>") == table.count("</tr>") > 0
        # Neither calls that make a value nor codes.
        assert not re.search(r"object at 0x|[A-Z]\w+\(|[a-z]_[a-z]", table), table


# Names in lines and tables: classes, units, corners, packages, given ones; a call that makes a value is no sentence.
NAMES = f"{core.__all__} deg rad square well Zhou spiral front rear inner outer fcl shapely"
CODES = [list(kind) for kind in map(vars(core).get, core.__all__) if isinstance(kind, type(Enum))]


def test_a_line_and_a_table_are_in_the_language_that_is_spoken(values):
    for value in values:
        known = [dir(part) for part in parts(value)]
        if "message" not in str(known):  # It was composed before.
            with speaking("zh"):
                table = html.unescape(re.sub("<svg.*|<[^>]*>", " ", value._repr_html_()))
                line = re.sub(r"\w+\(.*\)", "", repr(value))
            for shown, names in ((table, NAMES), (line, f"{NAMES} {CODES} {known}")):
                assert {*re.findall("[A-Za-z]{3,}", shown)} <= {*re.findall("[A-Za-z]{3,}", names)}, shown


@pytest.mark.parametrize(
    "value", [*INPUTS, lane((0.0, 0.0), (9.0, 0.0), start=2.0), Turn(1.7, entry_radius=4.0)], ids=repr
)
def test_a_short_input_prints_the_call_that_makes_it(value):
    again = eval(repr(value), vars(core))
    assert type(again) is type(value)
    assert again == value


def spent():
    """A budget of which a part is spent, and which was stopped."""
    budget = core.Budget(10.0)
    budget.spend(3.0)
    budget.stop()
    return budget


LINES = {
    "<FirstContact: no two benches touch until 637.662028 s, where bench 0 folds>": lambda: core.first_contact(
        Dance(Dragon(), Spiral(0.8))
    ),
    "<Trajectory: 1 instant at 300 s; 224 handles, 0.99647754 to 1 m/s>": lambda: core.trajectory(DANCE, 300.0),
    "<MinimumPitch: 0.450337393 m, limited by graze of benches 0 and 19; proven for every larger pitch>": lambda: (
        core.minimum_pitch(Dragon())
    ),
    "<Budget: 7 of 10 steps of work left, stopped>": spent,
}


@pytest.mark.parametrize("line", LINES)
def test_a_line_says_what_was_found_with_its_unit(line):
    assert repr(LINES[line]()) == line


def test_a_table_has_every_field_with_its_unit_and_both_ends_of_a_bracket():
    contact = core.first_contact(DANCE)
    low, high = (f"{end:.15g}" for end in contact.time_bracket)
    assert low != high
    rows = {"time": "412.473837682115 s", "benches": "0, 8", "margin": "0 m", "time bracket": f"{low}, {high} s"}
    for name, text in rows.items():
        assert f">{name}</th><td>{text}</td></tr>" in contact._repr_html_()


def test_first_contacts_of_many_dances_are_a_table_with_units_in_its_head():
    found = core.first_contacts([Dance(Dragon(5), Spiral(pitch, 4.0)) for pitch in np.linspace(0.5, 0.6, 20)])
    for answers, rows in ((found, 20), (found[5:8], 3)):
        table = answers._repr_html_()
        assert "time [s]" in re.findall("<th.*?>(.*?)</th>", table)
        cells = re.findall("<td>(.*?)</td>", table.split("<tr>")[2])
        assert cells[1:3] == [display(answers[0].outcome), display(answers[0].time)]
        assert table.count("<tr>") == 1 + (rows if rows < 13 else 13)


def test_an_answer_about_an_instant_has_a_small_picture_with_the_benches_that_touch_filled():
    crossing = core.Performance([core.Part(Dance(Dragon(5), lane(*ends))) for ends in STREETS])
    answers = core.first_contact(DANCE), core.first_contact(crossing), core.trajectory(DANCE, [0.0, 9.0])
    for answer, benches, touching in zip(answers, (223, 10, 223), ([2], [2], []), strict=True):
        outlines, *filled = re.findall('<path d="(.*?)"', answer._repr_html_())
        assert outlines.count("z") == benches
        assert [path.count("z") for path in filled] == touching
    # The benches that touch are a part of the drawing: benches 0 and 8 at their places at the contact.
    drawn = re.findall("M.*?z", re.findall('<path d="(.*?)"', answers[0]._repr_html_())[0])
    assert drawn[0] + drawn[8] in answers[0]._repr_html_()


@pytest.mark.parametrize(
    "path", [Spiral(), core.Turn(1.7), lane((0.0, 0.0), (3.0, 4.0))], ids=["spiral", "turn", "lane"]
)
def test_a_path_and_a_dance_on_it_have_a_small_picture_of_the_way(path):
    dance = Dance(Dragon(2), path)
    shown = [path, dance, core.Performance([core.Part(dance)])]
    if isinstance(path, Turn):
        shown.append(core.turn_time(Dragon(2), path))
    pictures = [re.findall('<path d="(.*?)"', one._repr_html_()) for one in shown]
    assert pictures == [pictures[0]] * len(shown) != [[]] * len(shown)
    x, y = (float(one) for one in pictures[0][0].removeprefix("M").split()[-1].split(","))
    drawn = path.drawn(np.zeros((1, 2)))
    assert np.hypot(*(drawn - (x, -y)).T).min() < 0.01


def test_zero_has_no_sign_and_an_unknown_bound_is_called_so():
    assert format_range([-0.0, 1.0], "m") == "0 to 1 m"
    assert display((1.5, None), "m/s") == "1.5, unknown m/s"


def test_a_name_in_a_table_is_escaped():
    html = Venue(Area("<script>alert('&')</script>", SQUARE.square.rings))._repr_html_()
    assert "<script>" not in html
    assert "&lt;script&gt;alert(&#x27;&amp;&#x27;)&lt;/script&gt;" in html


def test_a_table_of_many_pieces_or_points_stays_small():
    route = Route([Line((float(x), 0.0), (x + 1.0, 0.0)) for x in range(300)])
    for value, words in ((route, "<td>294</td>"), (CURVE, "and 994 more")):
        table, _, picture = value._repr_html_().partition("<svg")
        assert len(table) < 1_000
        assert len(picture) < 14_000
        assert words in table
