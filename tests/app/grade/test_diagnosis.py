"""Results with one known error each are diagnosed; four with errors of no known kind are not."""

import itertools
from functools import cache, partial
from io import BytesIO

import numpy as np
import openpyxl
import pytest

from app.grade.decimals import digits_of
from app.grade.limits import TIGHTER_TURN
from app.grade.report import graded
from core import Budget, Dance, Dragon, Spiral, first_contact
from tests.campaigns.hunt_grades import hunt
from tests.support import students
from tests.support.depth import further, often
from tests.support.student_files import as_csv, as_file, in_layout
from tests.support.students import AT_CONTACT, CONTACT, SPIRAL_TIMES, TURN_TIMES, lines, spiral, turn

ONCE = Dragon(overhang=0.1375)


# Most errors show in every tenth instant too, and a tenth of the lines is read in a tenth of the time; whole: for the
# others.
TENTH = slice(None, None, 10)
FEWER = TURN_TIMES[TENTH]


def tenth(results, times, *, whole=False):
    lines = slice(None) if whole else TENTH
    return students.lines((results[0][lines], results[1][lines]), times[lines])


first, fourth = (partial(tenth, times=times) for times in (SPIRAL_TIMES, TURN_TIMES))


# Error -> the file. Further errors are named beside others below.
KNOWN = {
    "equal_arcs": lambda: first(students.equal_arcs()),
    "overhang_once": lambda: first(spiral(dragon=ONCE)),
    "arc_of_circle": lambda: first(students.circle_angle()),
    "steady_angle": lambda: first(students.steady_angle()),
    "wrong_ring": lambda: first(students.wrong_ring(7)),
    "forward_difference": lambda: first(students.quotient(0.0, 0.1), whole=True),
    "central_difference": lambda: first(students.gradient(), whole=True),
    "rounded_early": lambda: first(spiral(pitch=0.0875 * 2.0 * np.pi)),
    "other_start": lambda: first(spiral(start_turns=15.0)),
    "degrees": lambda: first(students.in_degrees()),
    "other_pitch": lambda: first(spiral(pitch=0.6, start_turns=8.8 / 0.6)),
    "other_speed": lambda: first(students.of(Dance(Dragon(), Spiral(), 1.2), SPIRAL_TIMES)),
    "ratio_inverted": lambda: fourth(turn(ratio=0.5)),
    "other_entry_radius": lambda: fourth(turn(turning_radius=4.9)),
    "arcs_not_tangent": lambda: students.lines(students.semicircles(FEWER), FEWER),
    "wrong_centre": lambda: students.lines(students.mirrored_arcs(FEWER), FEWER),
    "own_lengths": lambda: first(spiral(dragon=Dragon(overhang=0.225))),
    "other_question": lambda: tenth(turn(TURN_TIMES[:101]), TURN_TIMES[:101] + 100.0),
    "outside_blank": lambda: first(students.outside(np.nan)),
    "outside_line": lambda: first(students.on_line()),
    "contact: other_pitch_then": lambda: students.contact_workbook(of_pitch(0.5)),
    "contact: other_instant": lambda: students.contact_workbook(spiral(np.array([412.48]))),
}
# What no student does: each is wrong, and none of the known errors gives it.
UNKNOWN = {
    "one cell": lambda: first(one_cell()),
    "noise": lambda: first(noise()),
    "some handles swapped": lambda: first(swapped()),
    "contact: moved": lambda: students.contact_workbook((spiral(AT_CONTACT)[0] + 0.05, spiral(AT_CONTACT)[1])),
}


def of_pitch(pitch, **start):
    """The first contact on a spiral of another pitch."""
    dance = Dance(Dragon(), Spiral(pitch, **start))
    return students.of(dance, [first_contact(dance).time])


def rounded(results, decimals):
    return tuple(part.round(decimals) for part in results)


def shifted(results, rows=1):
    """Handle k has the numbers of handle k + rows."""
    return tuple(np.roll(part, -rows, axis=1) for part in results)


def turned(results, degrees):
    """The places turned about the centre against the clock."""
    c = np.cos(np.radians(degrees))
    s = np.sin(np.radians(degrees))
    return results[0] @ np.array([[c, s], [-s, c]]), results[1]


def one_cell():
    position, speed = spiral()
    position[120, 40, 0] += 0.7
    return position, speed


def noise():
    position, speed = spiral()
    return position + np.random.default_rng(4).normal(0.0, 0.01, position.shape), speed


def swapped():
    position, speed = spiral()
    return np.concatenate([position[:, :100], position[:, 99::-1], position[:, 200:]], axis=1), speed


def grade(data):
    return graded("upload.xlsx", data, Budget())


def grade_contact(results):
    return grade(students.contact_workbook(results))


@cache
def known(name):
    return grade(KNOWN[name]())


# Errors of which each run shows one of every kind; make test-all has the others too.
OFTEN = ("equal_arcs", "overhang_once", "wrong_ring", "forward_difference", "other_start", "other_entry_radius",
         "ratio_inverted", "arcs_not_tangent", "other_question", "outside_blank", "contact: other_instant")  # fmt: skip


@pytest.mark.parametrize("name", often(KNOWN, OFTEN))
def test_a_known_error_is_diagnosed_with_its_numbers(name):
    result = known(name)
    # What is left out is missing.
    assert result.verdict == "wrong" or (name, result.verdict) == ("outside_blank", "incomplete")
    assert result.diagnosis[0].error == name.rpartition(" ")[2]
    assert any(letter.isdigit() for letter in result.diagnosis[0].evidence)


@pytest.mark.parametrize("name", UNKNOWN)
def test_an_error_of_no_known_kind_is_not_diagnosed(name):
    result = grade(UNKNOWN[name]())
    assert result.verdict == "wrong"
    assert result.diagnosis == []


def test_files_are_compared_by_numbers_that_no_common_error_gives():
    """The same cells of each file; none of a right one, a rounded one, or one with an error that many make."""
    unusual, again = (grade(first(noise())).unusual for _ in range(2))
    assert unusual == again
    assert len(unusual) == 24
    assert len(grade(first(one_cell())).unusual) == 1
    assert len(grade(first(spiral(pitch=0.5))).unusual) == 24
    for common in (spiral(), rounded(spiral(), 3), spiral(dragon=Dragon(overhang=0.0)), students.outside(0.0)):
        assert grade(first(common)).unusual == []


def test_the_numbers_of_an_error_are_reported():
    [one] = known("forward_difference").diagnosis
    assert one.words == "The speeds are forward difference quotients with a step of 0.1 s."
    inverted, *_ = known("ratio_inverted").diagnosis
    assert inverted.words.endswith("the first one's radius should be twice the second one's.")
    [early] = grade(first(students.rounded_head())).diagnosis
    assert early.words == "A number was rounded before it was used: theta of the head, 3 decimals."
    deeper = grade(fourth(rounded(turn(turning_radius=4.35), 2)))  # allowed: judged by itself, with its numbers
    assert deeper.diagnosis == []
    assert "it begins 4.35 m and ends 4.35 m from the centre" in deeper.notes[0]


def met(result, criterion):
    """Whether a point of the rubric is met."""
    return {point.criterion: point.met for point in result.rubric}[criterion]


def test_a_handle_on_the_wrong_coil_of_the_turn_is_reported():
    result = grade(students.lines(students.wrong_coil(7, FEWER), FEWER))
    [one] = result.diagnosis
    assert result.workbook == "result4"
    assert one.error == "wrong_ring"
    assert one.evidence.startswith(
        "At -100 s handle 7 is 1.650000 m from the one before, as it should be, but 266.853 m in front"
    )
    assert met(result, "branch") is False


def errors(result):
    return [one.error for one in result.diagnosis]


OWN_TURNS = {
    "deeper": {"entry_radius": 4.35},
    "of another ratio": {"ratio": 1.4},
    "to another exit": {"ratio": 1.2, "entry_radius": 4.3, "exit_radius": 4.4},
}


@pytest.mark.parametrize("decimals", [6, 4])
@pytest.mark.parametrize("own", often(OWN_TURNS, ("to another exit",)))
def test_a_turn_that_question_4_allows_is_judged_by_itself(own, decimals):
    results = rounded(turn(TURN_TIMES, **OWN_TURNS[own]), decimals)
    result = graded("result4.csv", lines(results, TURN_TIMES), Budget())
    assert (result.verdict, result.diagnosis) == ("right" if decimals == 6 else "rounded", [])
    sizes = {"ratio": 2.0, "entry_radius": 4.5} | OWN_TURNS[own]
    leaving = sizes.get("exit_radius", sizes["entry_radius"])
    words = f"begins {sizes['entry_radius']:g} m and ends {leaving:g} m from the centre, its arcs have the ratio "
    assert words + f"{sizes['ratio']:g} : 1" in result.notes[-1]


def test_wrong_speeds_on_a_turn_of_its_own_are_wrong():
    position, speed = turn(FEWER, entry_radius=4.35)
    assert errors(graded("result4.csv", lines((position, np.ones_like(speed)), FEWER), Budget())) == ["equal_speeds"]


def test_the_shortest_turn_known_is_not_accused_of_what_question_4_allows():
    """Its speeds jump, and it is none of the errors."""
    ratio, entry, leaving = TIGHTER_TURN
    shorter = turn(TURN_TIMES, ratio=ratio, entry_radius=entry, exit_radius=leaving)
    result = graded("result4.csv", lines(shorter, TURN_TIMES), Budget())
    assert result.verdict == "rounded"
    assert result.diagnosis == []
    assert "Question 4 allows it" in result.notes[-1]


def test_a_wrong_instant_is_traced_to_its_steps():
    assert errors(known("contact: other_instant")) == ["other_instant", "time_steps"]


def test_a_right_instant_that_was_rounded_is_called_so_and_contradicts_no_point_of_the_rubric():
    # It is also the last step of 0.01 s before the contact, and nothing shows that it was found so.
    result = grade_contact(spiral(np.array([412.47])))
    assert errors(result) == ["other_instant", "rounded_instant"]
    assert "right one to 2 decimals: it was rounded" in result.diagnosis[1].words
    assert met(result, "refined") is None


def test_a_rounded_instant_that_fits_a_shortcut_is_only_a_guess():
    result = grade_contact(spiral(np.array([406.43])))
    assert errors(result) == ["other_instant"]
    [guess] = result.possible
    assert guess.error == "loose_angle"
    assert 0.002 < guess.probability < 0.05
    assert guess.words.startswith("Possibly: ")
    assert met(result, "refined") is not True


@pytest.mark.parametrize("decimals", [1, 2, 3, 5])
def test_equal_speeds_of_two_decimals_are_right_ones_rounded(decimals):
    """A workbook does not show that speeds of 1.00 have two decimals; more decimals of places are said to show none."""
    position, speed = (part.round(k) for part, k in zip(spiral(SPIRAL_TIMES[:4]), (decimals, 2), strict=True))
    result = grade(students.by_xlsxwriter(students.rows_of((position, speed), SPIRAL_TIMES[:4])))
    assert result.sheets[1].verdict == "incomplete"
    assert result.diagnosis == []
    assert result.sheets[1].notes[0].startswith("Every number is 1, ") is (decimals > 2)


@pytest.mark.parametrize("speed, verdict", [("1.00", "incomplete"), ("1.000000", "wrong"), ("-1.00", "wrong")])
def test_text_shows_the_decimals_of_equal_speeds(speed, verdict):
    """All right speeds are 1.00 to two decimals, whatever the decimals of the places."""
    times = SPIRAL_TIMES[TENTH]
    text = students.lines(spiral(times), times).decode()
    lines = [line.rpartition(",")[0] + f",{speed}" for line in text.splitlines()[1:]]
    result = grade("\n".join(["time,handle,x,y,speed", *lines]).encode())
    causes = {"1.00": [], "1.000000": ["equal_speeds"], "-1.00": ["speeds_negated"]}
    assert result.verdict == verdict
    assert errors(result) == causes[speed]
    # So do the formats of a workbook, in which 1.00 is stored as 1.
    book = openpyxl.load_workbook(BytesIO(students.by_xlsxwriter(students.rows_of(spiral(times), times))))
    for row in book["速度"].iter_rows(min_row=2, min_col=2):
        for cell in row:
            cell.value = float(speed)
            cell.number_format = f"0.{'0' * len(speed.partition('.')[2])}"
    book.save(file := BytesIO())
    assert errors(grade(file.getvalue())) == causes[speed]


def test_a_table_has_the_decimals_of_its_numbers_that_show_some():
    assert (digits_of(np.append(np.ones(10_000), 0.9965).reshape(1, -1, 1)) == 4).all()


def test_another_instant_is_named_beside_a_further_error():
    position, speed = spiral(np.array([414.0]))
    speed[:, 1:] *= 0.9924
    result = grade_contact((position, speed))
    assert errors(result) == ["other_instant", "other_speeds"]
    assert result.diagnosis[1].evidence.startswith("Sheet1: 223 of 224 speeds differ")
    assert met(result, "speeds") is False
    mirrored = grade_contact((position * [-1.0, 1.0], spiral(np.array([414.0]))[1]))
    assert errors(mirrored) == ["x_negated", "other_instant"]


# What places and speeds of a result2 may be, beside each other.
PARTS = {
    "right": lambda: spiral(AT_CONTACT),
    "rows + 1": lambda: shifted(spiral(AT_CONTACT)),
    "rows - 3": lambda: shifted(spiral(AT_CONTACT), -3),
    "other instant": lambda: spiral(np.array([409.4])),
    "no overhang": lambda: spiral(AT_CONTACT, dragon=Dragon(overhang=0.0)),
    "rounded": lambda: rounded(spiral(AT_CONTACT), 3),
    "negated": lambda: tuple(-part for part in spiral(AT_CONTACT)),
}
# What is said of each, of its places and of its speeds.
SAID = {
    "right": (None, None),
    "rows + 1": ("handle k has the numbers of handle k + 1.",) * 2,
    "rows - 3": ("handle k has the numbers of handle k - 3.",) * 2,
    "other instant": ("The positions are those at 409.400000 s.", "The speeds are those at 409.400 s."),
    "no overhang": ("the overhang of 0.275 m at both ends was forgotten.",) * 2,
    "rounded": (None, None),
    "negated": ("turned about the centre by +180°", "Every speed has the wrong sign"),
}
OFTEN_BESIDE = {("right", one) for one in PARTS} | {("rows + 1", "rows + 1"), ("rows + 1", "rounded")}
OFTEN_BESIDE |= {("negated", "right")}


@pytest.mark.parametrize(
    "places, speeds",
    often(itertools.product(PARTS, PARTS), OFTEN_BESIDE),
)
def test_the_errors_of_places_and_of_speeds_are_named_each(places, speeds):
    """Speeds of the same motion as the places have no error of their own, but the evidence counts them too."""
    result = grade_contact((PARTS[places]()[0], PARTS[speeds]()[1]))
    wanted = [SAID[places][0], SAID[speeds][1] if speeds != places or speeds == "negated" else None]
    wanted = [words for words in wanted if words]
    assert len(result.diagnosis) == len(wanted)
    for one, words in zip(result.diagnosis, wanted, strict=True):
        assert words in one.words
        assert ("m/s" in one.evidence) is (one is result.diagnosis[-1] and speeds not in ("right", "rounded"))
    is_rounded = "rounded" in (places, speeds)
    assert result.verdict == ("wrong" if wanted else "rounded" if is_rounded else "right")


@pytest.mark.parametrize("by, decimals", [(0.582, 6), (-0.09, 4), (-0.437, 5)])
def test_speeds_of_other_times_tell_no_digit_of_the_shift_that_they_do_not_know(by, decimals):
    places = turn()[0]
    speeds = np.round(turn(TURN_TIMES + by)[1], decimals)
    (error,) = grade(students.lines((places, speeds), TURN_TIMES)).diagnosis
    assert f"{by:+} s" in error.words


@pytest.mark.parametrize("by", further([1, -2], 1))
def test_speeds_in_shifted_rows_are_not_called_rounded(by):
    """Those of neighbours on the spiral differ in the third decimal."""
    result = grade(first(shifted(spiral(), by), whole=True))
    assert [one.verdict for one in result.sheets] == ["wrong", "wrong"]
    assert errors(result) == ["shifted_rows"]
    assert result.diagnosis[0].words.endswith(f"numbers of handle k {'+' if by > 0 else '-'} {abs(by)}.")


@pytest.mark.parametrize("change", [[-1.0, 1.0], [1.0, -1.0]])
def test_one_sheet_of_a_result2_does_not_miss_another(change):
    position, speed = spiral(AT_CONTACT)
    result = grade_contact((position * change, speed))
    [words] = [one.words for one in result.rubric if one.criterion == "speeds"]
    assert words == "Speeds consistent with the positions: not shown here."
    position, speed = spiral(SPIRAL_TIMES[:4])
    for title, rows in students.rows_of((position, -speed), SPIRAL_TIMES[:4]).items():
        alone = grade(students.by_xlsxwriter({title: rows}))
        assert any("both sheets are necessary" in one.words for one in alone.rubric)


@pytest.mark.parametrize(
    "angle, decimals, words",
    [(30.0, 6, "+30°"), (-40.1, 6, "-40.1°"), (30.0, 3, "+30.000°"), (40.107, 2, "+40.11°")],
)
def test_another_instant_is_seen_in_turned_places(angle, decimals, words):
    results = turned(spiral(np.array([405.25])), angle)
    result = grade_contact(rounded(results, decimals))
    assert errors(result) == ["turned", "other_instant"]
    assert f"by {words}" in result.diagnosis[0].words
    instant = float(result.diagnosis[1].words.removeprefix("The positions are those at ").removesuffix(" s."))
    assert abs(instant - 405.25) < 10.0 ** (1 - decimals)


@pytest.mark.parametrize("missing", [[0, 1], [2]], ids=["places", "speeds"])
def test_speeds_belong_to_positions_only_where_both_are_given(missing):
    position, speed = spiral(AT_CONTACT)
    values = np.dstack([position, speed]).round(6)
    values[..., missing] = np.nan
    rows = [["" if cell != cell else cell for cell in row] for row in in_layout(values, [CONTACT], "columns")["both"]]
    result = graded("result2.csv", as_csv(rows), Budget())
    assert result.workbook == "result2"
    assert met(result, "speeds") is None


def test_two_errors_are_reported_beside_each_other():
    """Zeros outside the spiral, and quotients for the speeds."""
    position, speed = students.outside(0.0)
    speed = np.where(speed == 0.0, 0.0, students.quotient(-1.0, 0.0)[1])
    result = grade(students.lines((position, speed), SPIRAL_TIMES))
    assert errors(result) == ["outside_zero", "backward_difference"]


@pytest.mark.parametrize("size", further([1e-3, 1e-6], 1))
def test_quotients_are_reported_beside_positions_with_noise(size):
    """Noise of the last digit, and noise that no known error explains."""
    position, speed = students.quotient(-1.0, 0.0, turn)
    noisy = position + np.random.default_rng(5).uniform(-size, size, position.shape)
    [one] = grade(students.lines((noisy, speed), TURN_TIMES)).diagnosis
    assert one.words == "The speeds are backward difference quotients with a step of 1 s."


def test_quotients_of_the_own_places_are_reported():
    """Whatever is wrong with the places."""
    position, speed = spiral()
    position = np.round(position * [1.0, 1.01], 6)
    speed[1:] = np.linalg.norm(np.diff(position, axis=0), axis=-1)
    [one] = grade(students.lines((position, speed), SPIRAL_TIMES)).diagnosis
    assert one.error == "backward_difference"


def test_quotients_that_give_the_same_digits_are_named_together():
    """On the spiral the speeds hardly change in 0.1 s: with a little noise three quotients agree with them."""
    position, speed = students.quotient(0.0, 0.1)
    noisy = speed + np.random.default_rng(3).uniform(-1e-6, 1e-6, speed.shape)
    [one] = grade(students.lines((position, noisy), SPIRAL_TIMES)).diagnosis
    spans = "t ... t + 0.1 s; t - 0.1 ... t s; t - 0.05 ... t + 0.05 s"
    assert one.words == f"The speeds are difference quotients. These all give the same digits: {spans}."


def test_speeds_with_a_small_bias_are_no_quotients():
    """Those over 0.01 s are too large by 5e-6 m/s at nearly all handles, as any speeds with such a bias are."""
    position, speed = spiral(AT_CONTACT)
    result = grade_contact((position, speed + 4.8e-6))
    assert result.verdict == "rounded"
    assert result.diagnosis == []
    before = spiral(AT_CONTACT - 0.01)[0]
    quotients = np.linalg.norm(position - before, axis=-1) / 0.01
    [one] = grade_contact((position, quotients)).diagnosis
    assert one.words == "The speeds are backward difference quotients with a step of 0.01 s."


def test_sparse_instants_do_not_contradict_the_speeds():
    """Over a minute a handle turns: its way is far from its speed times the time."""
    position, speed = spiral(SPIRAL_TIMES[::60])
    wrong = position.copy()
    wrong[0, 5] += 1.0
    assert met(grade(students.lines((wrong, speed), SPIRAL_TIMES[::60])), "speeds") is None


@pytest.mark.parametrize("cases", further([25, 150], 1))
def test_nobody_is_accused_by_chance(cases):
    """Some cases of the campaign; `python -m tests.campaigns.hunt_grades` has as many as there is time for."""
    assert hunt(20261126, cases=cases)[:2] == (cases, 0)


@pytest.mark.parametrize("handles", [[0, 1, 51, 101, 151, 201, 223], range(1, 224)], ids=["printed", "no head"])
def test_another_instant_is_seen_in_few_decimals_of_any_handles(handles):
    """The rounding of one place leaves it uncertain; all places tell it together."""
    times = TURN_TIMES[::50]
    [heads, *lines] = in_layout(np.dstack(turn(times + 0.5)).round(2), times, "list")["list"]
    result = grade(as_csv([heads, *(line for k, line in enumerate(lines) if k % 224 in handles)]))
    assert [one.words[-18:] for one in result.diagnosis] == ["shifted by +0.5 s."]
    [heads, *lines] = students.contact_rows(rounded(spiral(np.array([411.5])), 2))
    [one] = grade(students.by_xlsxwriter({"Sheet1": [heads, *(lines[h] for h in handles)]})).diagnosis
    assert abs(float(one.words.split()[-2]) - 411.5) < 0.01


def test_labels_hold_where_wrong_numbers_fit_the_order_of_the_rows_by_chance():
    """Three rows are missing, so that those behind are in another order; the head was treated as a body."""
    lines = first(rounded(spiral(dragon=Dragon(head_length=2.2)), 2)).decode().splitlines()
    result = grade("\n".join(line for line in lines if line.split(",")[1] not in ("50", "51")).encode())
    assert errors(result) == ["head_as_body"]
    assert "shifted" not in " ".join(note for sheet in result.sheets for note in sheet.notes)


def longer(values, decimals, more):
    """Numbers of so many decimals, one of which has more."""
    result = values.round(decimals)
    result.flat[values.size // 2] = values.flat[values.size // 2].round(more)
    return result


def significant(values, digits):
    return np.vectorize(lambda value: float(f"{value:.{digits}g}"))(values)


def by_instant(values, *decimals):
    return np.stack([row.round(decimals[k % len(decimals)]) for k, row in enumerate(values)])


def by_axis(values, *decimals):
    return np.dstack([values[..., k].round(each) for k, each in enumerate(decimals)])


# Honest ways to round the numbers of a file.
UNEVEN = {
    "a longer place": lambda places, speeds: (longer(places, 2, 4), speeds.round(2)),
    "a longer speed": lambda places, speeds: (places.round(2), longer(speeds, 2, 4)),
    "both longer": lambda places, speeds: (longer(places, 3, 6), longer(speeds, 3, 5)),
    "significant digits": lambda places, speeds: (significant(places, 4), significant(speeds, 4)),
    "scientific": lambda places, speeds: (significant(places, 6), significant(speeds, 3)),
    "a format of each instant": lambda places, speeds: (by_instant(places, 2, 6), by_instant(speeds, 6, 2, 4)),
    "a format of each axis": lambda places, speeds: (by_axis(places, 2, 5), speeds),
}


@pytest.mark.parametrize("way", often(UNEVEN, ("a longer place", "significant digits")))
def test_numbers_of_unequal_decimals_are_neither_accused_nor_excused(way):
    """Each counts with the decimals of its like."""
    times = SPIRAL_TIMES[::60]
    wrong = {
        "anticlockwise": students.mirrored(spiral(times)),
        "length_for_chord": spiral(times, dragon=Dragon(overhang=0.0)),
        "speeds_negated": (spiral(times)[0], -spiral(times)[1]),
    }
    for error, results in ({"": spiral(times)} | wrong).items():
        values = np.dstack(UNEVEN[way](*results))
        for form in ("sheets", "list", "beside"):
            result = grade(as_file(in_layout(values, times, form)))
            assert errors(result) == ([error] if error else [])
            assert (result.verdict == "wrong") is bool(error)


TWO = {
    ("x_negated", "shifted_rows"): lambda times, dance: turned_x(shifted(dance(times))),
    ("x_negated", "length_for_chord"): lambda times, dance: turned_x(dance(times, dragon=Dragon(overhang=0.0))),
    ("axes_exchanged", "shifted_time"): lambda times, dance: exchanged(dance(times - 1.0)),
    ("turned", "head_as_body"): lambda times, dance: turned(dance(times, dragon=Dragon(head_length=2.2)), 180.0),
    ("shifted_rows", "length_for_chord"): lambda times, dance: shifted(dance(times, dragon=Dragon(overhang=0.0))),
    ("shifted_time", "length_for_chord"): lambda times, dance: dance(times - 1.0, dragon=Dragon(overhang=0.0)),
    ("other_pitch", "length_for_chord"): lambda times, dance: dance(times, pitch=0.5, dragon=Dragon(overhang=0.0)),
    ("speeds_negated", "equal_speeds"): lambda times, dance: (dance(times)[0], -np.ones((len(times), 224))),
}


def turned_x(results):
    return results[0] * [-1.0, 1.0], results[1]


def exchanged(results):
    return results[0][..., ::-1], results[1]


@pytest.mark.parametrize("decimals", [6, 3])
@pytest.mark.parametrize("two", TWO, ids=" ".join)
def test_two_errors_in_the_same_numbers_are_both_named(two, decimals):
    times = SPIRAL_TIMES[1::60]
    results = rounded(TWO[two](times, spiral), decimals)
    assert errors(grade(students.lines(results, times))) == list(two)
    if not {"shifted_time", "other_pitch"} & {*two}:
        assert errors(grade_contact(rounded(TWO[two](AT_CONTACT, spiral), decimals))) == list(two)
