"""The same numbers in the layouts in which students write them."""

from itertools import zip_longest

from tests.support.students import by_xlsxwriter, labels

NAMES = [label.removesuffix(" (m/s)") for label in labels("speed")]
# Forms of a table: a line for each handle and instant; a line for each handle, under one heading or two; lines of x, y
# and speed, below one another, beside each other, or in sheets of their own; tables of x, of y and of speed, likewise.
FORMS = ("list", "columns", "two heads", "stack", "stack with heads", "beside", "sheets",
         "axes below", "axes beside", "axes in sheets")  # fmt: skip
# Forms of an instant in a heading.
INSTANTS = ("{:.9g} s", "{:.9g}s", "t={:.9g}")


def in_layout(values, times, form, *, heading=INSTANTS[0], numbered=False):
    """Rows of sheets with these numbers (T, H, 3) of all handles. numbered: numbers in the place of their names"""
    table = values.tolist()
    count = values.shape[1]
    handles = list(range(count)) if numbered else NAMES[:count]
    instants = [heading.format(time) for time in times]
    if form == "list":
        entries = [(t, h) for t in range(len(times)) for h in range(count)]
        lines = [[times[t], handles[h], *table[t][h]] for t, h in entries]
        return {"list": [["time", "handle", "x", "y", "speed"], *lines]}
    if form == "columns":
        heads = [["", *(f"{time} {axis}" for time in instants for axis in ("x (m)", "y (m)", "v (m/s)"))]]
        return {"both": heads + by_handle(handles, table)}
    if form == "two heads":
        heads = [["", *(cell for time in instants for cell in (time, None, None))], ["", *"xyv" * len(instants)]]
        return {"both": heads + by_handle(handles, table)}
    heads = [["", *instants]]
    if form.startswith("axes"):
        return axes_apart(values, instants, handles, form.removeprefix("axes "))
    position, speed = (
        [[label, *values[:, k // len(axes), axes[k % len(axes)]].tolist()] for k, label in enumerate(some)]
        for some, axes in ((labels("position")[: 2 * count], (0, 1)), (labels("speed")[:count], (2,)))
    )
    speed = [[h, *row[1:]] for h, row in enumerate(speed)] if numbered else speed
    if form == "sheets":
        return {"位置": heads + position, "速度": heads + speed}
    if form == "beside":
        return {"both": beside(heads + position, heads + speed)}
    return {"both": [*heads, *position, *([[None], *heads] if form == "stack with heads" else []), *speed]}


def axes_apart(values, instants, handles, way):
    """Tables of x, of y and of the speed, each with its name in the corner, below or beside each other or in sheets."""
    x, y, speed = (
        [[name, *instants], *([h, *column] for h, column in zip(handles, values[..., k].T.tolist(), strict=True))]
        for k, name in enumerate(("x (m)", "y (m)", "v (m/s)"))
    )
    if way == "in sheets":
        return {"x": x, "y": y, "v": speed}
    return {"all": beside(beside(x, y), speed) if way == "beside" else [*x, [], *y, [], *speed]}


def beside(left, right, gap=1):
    """Rows of two tables beside each other. gap: number of columns between them"""
    width = max(map(len, left)) + gap
    rows = ((one or [], other or []) for one, other in zip_longest(left, right))
    return [[*one, *[None] * (width - len(one)), *other] for one, other in rows]


def by_handle(handles, table):
    return [[handle, *(number for line in table for number in line[h])] for h, handle in enumerate(handles)]


def on_side(rows):
    width = max(map(len, rows))
    return [list(line) for line in zip(*(row + [None] * (width - len(row)) for row in rows), strict=True)]


def as_csv(rows):
    return "\n".join(",".join("" if cell is None else str(cell) for cell in row) for row in rows).encode()


def as_file(sheets):
    """A CSV of one sheet, a workbook of several."""
    return by_xlsxwriter(sheets) if len(sheets) > 1 else as_csv(*sheets.values())


def in_random_layout(values, times, random):
    """Rows of sheets, and the name of their layout."""
    form = FORMS[random.integers(len(FORMS))]
    heading = INSTANTS[random.integers(len(INSTANTS))]
    numbered = bool(random.integers(2))
    turned = form != "list" and bool(random.integers(2))
    sheets = in_layout(values, times, form, heading=heading, numbered=numbered)
    if turned:
        sheets = {title: on_side(rows) for title, rows in sheets.items()}
    return sheets, f"{form}, {heading}{', numbered' * numbered}{', on its side' * turned}"
