"""Meaning of a label: handle, axis, unit or instant.

It knows the words of the contest's workbooks, in Chinese and English, and their usual variants.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.grade.grid import Cell, normalized

UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "米": 1.0, "厘米": 1e-2, "毫米": 1e-3}
# Units of angles: numbers with them are not places.
ANGLE_UNITS = {"rad", "radian", "radians", "deg", "degree", "degrees", "°", "弧度", "度"}
TIME = re.compile(r"(?:t\s*=?\s*)?([-+]?\d+(?:\.\d+)?)\s*(s|sec|seconds?|秒)?", re.IGNORECASE)
# A time beside other words, as in "60s x(m)" or "x (t = 60)".
TIME_INSIDE = re.compile(
    r"t\s*=\s*([-+]?\d+(?:\.\d+)?)\s*(?:s\b|sec\b|seconds?\b|秒)?|([-+]?\d+(?:\.\d+)?)\s*(?:s|sec|seconds?|秒)(?![a-z])",
    re.IGNORECASE,
)
# A time without its unit before an axis or a speed, as in "60 x (m)".
TIME_BEFORE = re.compile(
    r"([-+]?\d+(?:\.\d+)?)[\s_,:;]+((?:[xyv](?![a-z])|横坐标|纵坐标|速度|speed|velocity).*)", re.IGNORECASE
)
# A time after its name, as in "碰撞时刻：412.47"; and its name in the cell before the number.
TIME_NAMED = re.compile(r"(?:时间|时刻|\btime|instant)\D{0,20}?([-+]?\d+\.\d+)", re.IGNORECASE)
NAME_OF_TIME = re.compile(r"时间|时刻|\btime\b|instant|\bt\s*(?:[(\[][^)\]]*[)\]])?\s*[=:]?$", re.IGNORECASE)
JOINTS = re.compile(r"^[\s_,;:@-]+|[\s_,;:@-]+$")
EMPTY_BRACKETS = re.compile(r"[(\[]\s*[)\]]")
UNIT = re.compile(r"[(\[]\s*([a-zμ米厘毫°弧度]+)\s*(/\s*(?:s|秒))?\s*[)\]]?$", re.IGNORECASE)
# x and y at the end of a label, or with a word for a place behind or before them, such as x_position or pos_y.
AXIS = re.compile(
    r"(?:^|[^a-z]|pos|position|coord|head|body|tail|rear)([xy])[\s_-]*(?:坐标|轴|pos(?:ition)?|coord(?:inate)?s?|axis)?$",
    re.IGNORECASE,
)
ACROSS, UPWARD = re.compile(r"横坐标$"), re.compile(r"纵坐标$")
ANGLE_WORD = re.compile(r"角度|极角|夹角|弧度|angle|theta|θ|\bphi\b|φ", re.IGNORECASE)
LENGTH_WORD = re.compile(r"半径|极径|弧长|radius|\barc|\brho\b|ρ|^r$", re.IGNORECASE)
HEAD, REAR = re.compile(r"龙头|head", re.IGNORECASE), re.compile(r"[(（]\s*后|后把手|rear", re.IGNORECASE)
TAIL = re.compile(r"龙尾|tail", re.IGNORECASE)
BODY = re.compile(r"第?\s*(\d+)\s*节|body\D*(\d+)|龙身\D*(\d+)", re.IGNORECASE)
SPEED_WORD = re.compile(r"速度|速率|speed|velocity|^v$", re.IGNORECASE)
TIME_WORD = re.compile(r"时间|时刻|time|^t$|^t[\s_(]|instant|^(?:s|seconds?|秒)$", re.IGNORECASE)
# Headings of a column that names or numbers the handles; and of one that numbers the handles or anything else.
HANDLE_NAME = re.compile(r"把手|节点|节数|节号|板凳|龙节|^节$|handle|section|segment|node|bench|joint", re.IGNORECASE)
NUMBER_WORD = re.compile(r"编号|序号|index|number|^(?:id|no\.?|n|k|i)$", re.IGNORECASE)
# Components of a number, in the order of the last axis of a table.
X, Y, SPEED = 0, 1, 2
# Components of an angle, and of a radius or an arc length, which no table of the contest holds.
ANGLE, LENGTH = 3, 4


@dataclass(frozen=True)
class Label:
    """handle: -1: the tail, -2: its rear; handle and component: None if the label names none.

    component: X, Y, SPEED, ANGLE or LENGTH
    """

    handle: int | None
    component: int | None
    unit: float


def label_of(cell: Cell) -> Label | None:
    """Meaning of a text beside a line of numbers; None if it is not a label."""
    if not isinstance(cell, str):
        return None
    text = normalized(cell)
    unit, component = 1.0, None
    if match := UNIT.search(text):
        unit = UNITS.get(match[1].lower(), 1.0)
        component = SPEED if match[2] else None
        text = text[: match.start()].rstrip() if match[2] or match[1].lower() in UNITS else text
    if match and match[1].lower() in ANGLE_UNITS:
        component, text = ANGLE, text[: match.start()].rstrip()
    elif component is None:
        component = _component(text)
    handle = None
    if HEAD.search(text):
        handle = 0
    elif TAIL.search(text):
        handle = -2 if REAR.search(text) else -1
    elif body := BODY.search(text):
        handle = int(next(filter(None, body.groups())))
    return None if handle is None and component is None else Label(handle, component, unit)


def heading_of(cell: Cell) -> tuple[float | None, Label | None]:
    """Instant [s] and label of a cell that names one of them, or both, as "60s x(m)"."""
    if (time := instant_of(cell)) is not None or not isinstance(cell, str):
        return time, None
    text = normalized(cell)
    if match := TIME_BEFORE.fullmatch(text):
        return float(match[1]), label_of(match[2])
    match = TIME_INSIDE.search(text)
    if match is None:
        return None, label_of(text)
    rest = EMPTY_BRACKETS.sub("", text[: match.start()] + " " + text[match.end() :])
    rest = JOINTS.sub("", rest)
    return float(match[1] or match[2]), label_of(rest)


def _component(text: str) -> int | None:
    """Component that a label without its unit names."""
    if axis := AXIS.search(text):
        return "xy".index(axis[1].lower())
    if ACROSS.search(text) or UPWARD.search(text):
        return X if ACROSS.search(text) else Y
    if SPEED_WORD.search(text):
        return SPEED
    if ANGLE_WORD.search(text):
        return ANGLE
    return LENGTH if LENGTH_WORD.search(text) else None


def instant_of(cell: Cell) -> float | None:
    """Time in a cell [s], given as text with or without a unit, or as a number."""
    if isinstance(cell, float):
        return cell
    match = TIME.fullmatch(normalized(cell)) if isinstance(cell, str) else None
    return float(match[1]) if match else None


def stated_instant(rows: Iterable[Sequence[Cell]]) -> float | None:
    """The instant that cells above a table state [s], the most precise one of several; None if they state none."""
    numbers: list[str] = []
    for row in rows:
        for before, cell in zip([None, *row], row, strict=False):
            if isinstance(cell, str):
                text = normalized(cell)
                matches = TIME_INSIDE.search(text), TIME_NAMED.search(text)
                numbers += [next(filter(None, match.groups())) for match in matches if match]
            elif isinstance(cell, float) and isinstance(before, str) and NAME_OF_TIME.search(normalized(before)):
                numbers.append(str(cell))
    return float(max(numbers, key=len)) if numbers else None


def is_handle_heading(text: str) -> bool:
    return bool(HANDLE_NAME.search(text) or NUMBER_WORD.search(text))
