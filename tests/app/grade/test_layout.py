"""Sheets in other layouts, units and formats are recognised."""

import numpy as np
import pytest

from tests.app.grade.test_reading import grade
from tests.support import students
from tests.support.depth import further, thorough
from tests.support.student_files import FORMS, NAMES, as_csv, as_file, beside, in_layout, on_side
from tests.support.students import SPIRAL_TIMES, by_xlsxwriter, few, spiral, three


def bare_times(rows):
    return [[None, *range(len(rows[0]) - 1)], *rows[1:]]


def transposed_bare(rows):
    return on_side(bare_times(rows))


def by_wps(rows):
    """A title, a head of two lines, labels without blanks and with full-width brackets, a note below."""
    labels = [[str(row[0]).replace(" ", "").replace("(", "（").replace(")", "）"), *row[1:]] for row in rows[1:]]
    return [["表1 问题一结果"], ["把手", "时间（s）"], bare_times(rows)[0], *labels, [], ["注：保留六位小数"]]


def by_google(rows):
    """Blanks to the end of a sheet that nobody filled: 1,000 lines of 26 columns, times as text."""
    wide = [[*row, *[None] * (26 - len(row))] for row in rows]
    return [*wide, *[[""] * 26] * (1000 - len(rows))]


def by_pandas_without_index(rows):
    return [["Unnamed: 0", *rows[0][1:]], *rows[1:]]


def by_pandas_with_numbers(rows):
    """The labels are a column of the table, and its own index stands before them."""
    return [[None, "handle", *rows[0][1:]], *([k, *row] for k, row in enumerate(rows[1:]))]


def numbered(rows, numbers=range(448)):
    """Numbers of the handles, or of the lines of x and y, in the place of their names."""
    return [rows[0], *([k, *row[1:]] for k, row in zip(numbers, rows[1:], strict=False))]


def without_axes(rows):
    """Each handle's name twice, above x and above y."""
    return [rows[0], *([label.removesuffix("x (m)").removesuffix("y (m)"), *row] for label, *row in rows[1:])]


LAYOUTS = [by_wps, by_google, by_pandas_without_index, by_pandas_with_numbers, on_side, transposed_bare, bare_times,
           without_axes]  # fmt: skip
# Right cells of positions and of speeds, of few instants.
FEW = [4 * 448, 4 * 224]


def right(result):
    return [sheet.right for sheet in result.sheets]


def held(result):
    """What its tables hold, and the number of right cells of each."""
    return sorted((sheet.holds, sheet.right) for sheet in result.sheets)


def assert_right_contact(result):
    assert (result.workbook, result.verdict, right(result)) == ("result2", "right", [672])


def assert_right(data):
    """A whole result1 of positions, as CSV, right in every cell."""
    sheet, _ = grade(data, "result1.csv").sheets
    assert sheet.verdict == "right"
    assert sheet.right == 301 * 448


@pytest.mark.parametrize("change", LAYOUTS, ids=lambda change: change.__name__)
def test_other_layouts_are_recognised(change):
    result = grade(by_xlsxwriter({title: change(rows) for title, rows in few().items()}))
    assert right(result) == FEW, result


def test_a_whole_result1_may_stand_on_its_side():
    # It has more instants than handles, so that its last lines are as many as the handles.
    assert_right(as_csv(on_side([line.split(",") for line in wide_csv().splitlines()])))


def test_a_result4_without_instants_begins_at_minus_100_s():
    sheet, _ = grade(as_csv(three()[2]["位置"][1:]), "result4.csv").sheets
    assert sheet.verdict == "right"
    assert sheet.right == 201 * 448


@pytest.mark.parametrize("title, factor", [("位置", 100.0), ("速度", 100.0), ("速度", 1000.0)])
def test_numbers_in_smaller_units_are_read_as_such(title, factor):
    heads, *rows = few()[title]
    small = [[row[0].replace(" (m/s)", ""), *(factor * value for value in row[1:])] for row in rows]
    result = grade(by_xlsxwriter(few() | {title: [heads, *small]}))
    assert right(result) == FEW
    assert title == "速度" or "The numbers are in cm, and were converted." in result.sheets[0].notes


@pytest.mark.parametrize("factors", [(1000.0, 1000.0, 1.0), (1000.0, 1000.0, 1000.0), (1.0, 1.0, 100.0)])
def test_places_and_speeds_of_result2_have_units_of_their_own(factors):
    heads, *rows = students.contact_rows(spiral(students.AT_CONTACT))
    small = [[row[0], *(factor * value for factor, value in zip(factors, row[1:], strict=True))] for row in rows]
    [sheet] = grade(by_xlsxwriter({"Sheet1": [heads, *small]}), "result2.xlsx").sheets
    assert (sheet.verdict, sheet.right) == ("right", sheet.cells)
    assert sum("were converted" in words for words in sheet.notes) == 1


def test_a_handle_too_many_is_left_out_and_one_too_few_is_missing():
    sheets = few()
    for title, lines in (("位置", 2), ("速度", 1)):
        sheets[title] += [
            [label.replace("龙尾（后）", "龙尾（后）（后）"), *row] for label, *row in sheets[title][-lines:]
        ]
    assert right(grade(by_xlsxwriter(sheets))) == FEW
    sheets = few()
    del sheets["位置"][101:103]
    position, _ = grade(by_xlsxwriter(sheets)).sheets
    assert position.verdict == "incomplete"
    assert position.right == 4 * 446


@pytest.mark.parametrize("written", [by_xlsxwriter, lambda sheets: as_csv(*sheets.values())], ids=["workbook", "CSV"])
def test_a_missing_sheet_makes_the_file_incomplete(written):
    result = grade(written({"位置": few()["位置"]}))
    assert result.sheets[1].notes == ["The sheet of the speeds is missing, or has no numbers."]
    assert result.verdict == "incomplete"


# The numbers that the paper prints: seven handles at six instants.
PRINTED = [0, 1, 51, 101, 151, 201, 223]
MINUTES = SPIRAL_TIMES[::60]


def numbers_at(times):
    """Right numbers (T, H, 3)."""
    position, speed = spiral(times)
    return np.dstack([position.round(6), speed.round(6)])


@pytest.mark.parametrize("form", FORMS)
def test_tables_of_every_form_are_graded_beside_each_other(form):
    """The instant of result2 with six decimals is right, and so are the numbers then, which are of numbered handles."""
    for heading in ("{:g}s", "{:g}"):
        sheets = in_layout(numbers_at(MINUTES), MINUTES, form, heading=heading)
        assert held(grade(as_file(sheets))) == [("position", 6 * 448), ("speed", 6 * 224)]
    for time in (students.CONTACT, 412.473838):
        sheets = in_layout(numbers_at(np.array([time])), [412.473838], form, numbered=True)
        assert_right_contact(grade(as_file(sheets), "result2"))


def assert_printed(result):
    """All numbers that the paper prints are right."""
    assert result.verdict == "incomplete"
    assert held(result) == [("position", 84), ("speed", 42)]


def printed(corner=""):
    """Tables of the printed positions and of the printed speeds."""
    sheets = in_layout(numbers_at(MINUTES), MINUTES, "sheets")
    (heads, *positions), (_, *speeds) = sheets["位置"], sheets["速度"]
    heads = [corner, *heads[1:]]
    return [heads, *(positions[2 * h + k] for h in PRINTED for k in (0, 1))], [heads, *(speeds[h] for h in PRINTED)]


def without_heads(rows):
    return [[None] * len(rows[0]), *rows[1:]]


def test_printed_handles_are_known_by_their_numbers_alone():
    """Those lead in unequal steps from the head to the tail, as no instants do; six columns are the printed ones."""
    (_, *position), (_, *speed) = map(numbered, printed(), (sorted(2 * PRINTED), PRINTED))
    assert_printed(grade(by_xlsxwriter({"a": position, "b": on_side(speed)})))
    [why] = grade(by_xlsxwriter({"c": [row[:4] for row in speed]})).notes
    assert "headings such as 0 s or x (m)" in why


SIDES = {
    "a gap": beside,
    "no gap": lambda position, speed: beside(position, speed, 0),
    "titles": lambda position, speed: beside([["位置"], *position], [["速度"], *speed]),
    "titles beside": lambda position, speed: beside([["位置"], *position], [["", "速度"], *speed]),
    "speeds first": lambda position, speed: beside(speed, position),
    "one line of times": lambda position, speed: beside(position, without_heads(speed)),
    "latest first": lambda *tables: beside(*([[row[0], *row[:0:-1]] for row in table] for table in tables)),
    "on its side": lambda position, speed: on_side(beside(position, speed)),
}


@pytest.mark.parametrize("corner", ["", "对象"])
@pytest.mark.parametrize("side", SIDES)
def test_tables_beside_each_other_are_graded_at_their_times(side, corner):
    rows = SIDES[side](*printed(corner))
    for result in (grade(as_csv(rows)), grade(by_xlsxwriter({"Sheet": rows}))):
        assert_printed(result)


def test_tables_of_one_sheet_are_named_by_what_they_hold():
    """The title of the sheet names neither; also where it is a word for one of them."""
    for title in ("Sheet", "位置"):
        sheets = grade(by_xlsxwriter({title: beside(*printed())})).sheets
        assert [(sheet.sheet, len(sheet.notes)) for sheet in sheets] == [("positions", 1), ("speeds", 1)]


def test_x_y_and_speeds_with_labels_of_their_own_are_one_table():
    rows = in_layout(numbers_at(students.AT_CONTACT), [412.473838], "columns", heading="")["both"]
    apart = [[*row[:3], row[0], row[3]] for row in rows]
    assert right(grade(as_csv(apart), "result2.csv")) == [672]


TITLES = {
    "corner": lambda rows: [["t = 412.473838 s", *rows[0][1:]], *rows[1:]],
    "title": lambda rows: [["t=412.473838s 时的位置与速度"], *rows],
    "title with a step": lambda rows: [["步长 0.01 s，碰撞时刻：412.473838"], *rows],
    "cells of a title": lambda rows: [["time of first contact (s)", 412.473838], [], *rows],
}


@pytest.mark.parametrize("numbered", [False, True])
@pytest.mark.parametrize("title", TITLES)
def test_a_result2_may_state_its_instant_above_the_table(title, numbered):
    values = numbers_at(np.array([412.473838]))
    rows = in_layout(values, [0.0], "columns", heading="", numbered=numbered)["both"]
    rows[0] = ["handle" if numbered else "", "x (m)", "y (m)", "v (m/s)"]
    assert right(grade(as_csv(rows), "result2.csv"))[0] < 672
    rows = TITLES[title](rows)
    assert_right_contact(grade(as_csv(rows), "result2.csv"))
    assert_right_contact(grade(by_xlsxwriter({"Sheet": rows}), "result2.xlsx"))


def test_another_number_of_seconds_in_a_title_accuses_nobody():
    rows = in_layout(numbers_at(students.AT_CONTACT), [0.0], "columns", heading="")["both"]
    assert_right_contact(grade(as_csv([["速度 1 m/s，步长 1 s"], *rows]), "result2.csv"))


@pytest.mark.parametrize("heads", ["theta,radius,x,y", "n,theta,radius,x,y", ",radius,x,y", "u,x,y", "a,b,c"])
@pytest.mark.parametrize("count", [224, 500])
def test_a_table_that_is_not_of_the_contest_is_unreadable(heads, count):
    names = heads.split(",")
    rows = [[k if name in ("", "n") else 0.01 * k for name in names] for k in range(count)]
    result = grade(as_csv([names, *rows]), "result2.csv")
    assert result.workbook is None
    assert result.verdict == "unreadable"


@pytest.mark.parametrize("labels", [True, False])
def test_sheets_with_exchanged_names_are_read_for_what_they_hold(labels):
    position, speed = (rows if labels else numbered(rows) for rows in few().values())
    result = grade(by_xlsxwriter({"速度": position, "位置": speed}))
    assert held(result) == [("position", FEW[0]), ("speed", FEW[1])]
    assert [sheet.notes[0] for sheet in result.sheets] == [
        "The sheet 速度 holds positions, in spite of its title.",
        "The sheet 位置 holds speeds, in spite of its title.",
    ]


@pytest.mark.parametrize("coding", further(["gb18030", "utf-16"], 1))
def test_csv_of_a_sheet_is_graded(coding):
    assert_right(wide_csv().encode(coding))


@pytest.mark.parametrize("separator", further([";", "\t"], 1))
def test_csv_with_decimal_commas_is_graded(separator):
    """Also below a title, which has no separator."""
    for title in ("", "问题一，结果\n"):
        assert_right((title + wide_csv().replace(",", separator).replace(".", ",")).encode())


FROM_0 = range(224)
FROM_1 = range(1, 225)
# Headings of lists with a line for each handle and instant, and the names of the handles in them.
HEADS = {
    "time,handle,x,y,speed": FROM_0,
    "time,section,x_position,y_position,velocity": FROM_0,
    "t,node,x,y,v": FROM_1,
    "time (s),bench,X,Y,speed (m/s)": FROM_0,
    "时间,节点编号,横坐标,纵坐标,速度": FROM_1,
    "时刻（s）,板凳编号,x坐标（m）,y坐标（m）,速度（m/s）": FROM_0,
    "Time [s],Index,pos_x,pos_y,Speed": FROM_0,
    "时间/s,把手编号,x/m,y/m,v/(m/s)": FROM_0,
    "t/s,node,横坐标/m,纵坐标/m,速度/(m·s⁻¹)": FROM_1,
    "时间,位置,x (m),y (m),速度 (m/s)": NAMES,
}


@pytest.mark.parametrize("heads", HEADS)
@pytest.mark.parametrize("title", ["问题一的结果,,,,\n", *thorough("")])
def test_lists_are_recognised_under_other_names(heads, title):
    lines = [",".join(map(str, row)) for row in list_of(3, HEADS[heads])]
    result = grade((title + "\n".join([heads, *lines])).encode(), "dance.csv")
    assert held(result) == [("position", 3 * 448), ("speed", 3 * 224)]


def test_headings_of_single_handles_are_none_of_a_list():
    """On its side, the corner names the handles, and below it stand times without a unit."""
    rows = few()["位置"][1:]
    assert right(grade(as_csv(on_side([["handle", *range(4)], *rows]))))[0] == FEW[0]


def test_wrong_numbers_of_handles_that_are_counted_from_one_stay_those_of_their_handles():
    """They do not fit the order of the lines either, which tells that right ones are counted from one."""
    rows = list_of(3, FROM_1)
    lines = [",".join(map(str, [time, handle, y, x, speed])) for time, handle, x, y, speed in rows]
    result = grade("\n".join(["time,node,x,y,v", *lines]).encode(), "dance.csv")
    assert [one.error for one in result.diagnosis] == ["axes_exchanged"]
    assert [sheet.missing for sheet in result.sheets] == [298 * 448, 298 * 224]


def list_of(instants, names):
    position, speed = spiral(SPIRAL_TIMES[:instants])
    lines = [(t, h) for t in range(instants) for h in range(224)]
    return [[t, names[h], *map(float, position[t, h].round(6)), float(speed[t, h].round(6))] for t, h in lines]


@pytest.mark.parametrize("below", [[], [[None] * 5], [["注：保留六位小数"]]], ids=["nothing", "a blank", "a remark"])
def test_a_sheet_of_speeds_is_no_sheet_of_positions(below):
    """Its title says that it holds speeds; below its last handle there may be a line without a label."""
    heads, *rows = few()["速度"]
    rows = [[row[0].removesuffix(" (m/s)"), *row[1:]] for row in rows]
    [sheet, *_] = grade(by_xlsxwriter({"速度表": [heads, *rows, *below]})).sheets
    assert sheet.holds == "speed"
    assert sheet.right == 4 * 224


def in_angles(rows):
    """The polar angle of every handle instead of its speed."""
    theta = [[100.0 + 0.3 * k - 0.1 * t for t in range(4)] for k in range(224)]
    return [rows[0], *([row[0].removesuffix(" (m/s)"), *angles] for row, angles in zip(rows[1:], theta, strict=True))]


@pytest.mark.parametrize("title", ["极角", "theta", "角度 (rad)"])
def test_angles_are_not_graded(title):
    sheets = few()
    result = grade(by_xlsxwriter({**sheets, title: in_angles(sheets["速度"])}))
    assert right(result) == FEW
    assert result.notes == [f"The sheet {title} holds angles, which the contest does not ask for: it was not graded."]


def test_angles_without_a_name_are_no_centimetres():
    sheets = grade(by_xlsxwriter({"Sheet1": in_angles(few()["速度"])})).sheets
    [notes] = [sheet.notes for sheet in sheets if sheet.holds == "speed"]
    assert not any("were converted" in note for note in notes)


def test_empty_columns_and_rows_count_as_missing_instants_and_handles():
    rows = [line.split(",") for line in wide_csv().splitlines()]
    for row in rows[1:]:
        row[202:] = [""] * 100
    for row in rows[21:23]:
        row[1:] = [""] * 301
    sheet, _ = grade(as_csv(rows), "result1.csv").sheets
    assert sheet.notes == [
        f"Cells that are missing: {100 * 448 + 201 * 2} (handles without any: 1, instants without any: 100)."
    ]


@pytest.mark.parametrize(
    "name, count", [("result1.xlsx", 1), ("Result_1.xlsx", 1), ("result4.xlsx", 0), ("li.xlsx", 0)]
)
def test_a_file_with_the_name_of_another_question_is_reported(name, count):
    times = students.TURN_TIMES[:4]
    result = grade(by_xlsxwriter(students.rows_of(students.turn(times), times)), name)
    assert result.workbook == "result4"
    assert right(result) == FEW
    words = "The name of the file says result1, but its sheets are laid out as result4: it was graded as result4."
    assert result.notes == [words] * count


def wide_csv(decimals=6):
    """The positions of result1 as CSV."""
    lines = [",".join(["", *(f"{t:g} s" for t in SPIRAL_TIMES)])]
    points = spiral()[0].transpose(1, 2, 0).reshape(-1, 301)
    rows = zip(students.labels("position"), points, strict=True)
    return "\r\n".join(lines + [",".join([label, *(f"{value:.{decimals}f}" for value in row)]) for label, row in rows])


@pytest.mark.parametrize("decimals", [5, 2, 1, *thorough(3, 4)])
def test_rounded_results_are_named_with_their_decimals(decimals):
    result = grade(wide_csv(decimals).encode(), "result1.csv")
    sheet, _ = result.sheets
    assert (sheet.verdict, sheet.decimals, result.diagnosis) == ("rounded", decimals, [])


NUMBERED = {
    "below": lambda position, speed: [*position, [], *speed],
    "below, without a line between": lambda position, speed: [*position, *speed],
    **{name: SIDES[name] for name in ("a gap", "speeds first", "on its side")},
}


@pytest.mark.parametrize("side", NUMBERED)
def test_speeds_of_numbered_handles_are_graded_beside_positions_of_named_ones(side):
    """All handles, or the printed ones, with a heading above their numbers or none."""
    for name in ("", "把手"):
        position = printed()[0]
        speed = numbered(printed(name)[1], PRINTED)
        assert_printed(grade(by_xlsxwriter({"位置": position, "速度": speed})))
        assert_printed(grade(as_csv(NUMBERED[side](position, speed))))
    every = grade(as_csv(NUMBERED[side](few()["位置"], numbered(few()["速度"]))))
    assert held(every) == [("position", FEW[0]), ("speed", FEW[1])]


@pytest.mark.parametrize("has_title", [False, True], ids=["labels", "title"])
def test_a_table_of_x_and_one_of_y_are_joined(has_title):
    """The axis stands in the labels or in a title; tables of every form have it in the corner."""
    heads, *rows = few()["位置"]
    if has_title:
        x, y = ([[f"{name}坐标"], heads, *without_axes(few()["位置"])[k + 1 :: 2]] for k, name in enumerate("xy"))
    else:
        x, y = ([heads, *rows[k::2]] for k in range(2))
    for data in (as_csv([*x, [], *y]), as_csv(beside(x, y)), by_xlsxwriter({"x": x, "y": y})):
        [sheet, _] = grade(data).sheets
        assert sheet.holds == "position"
        assert sheet.right == FEW[0]
