"""Meaning of a label: handle, axis, unit or instant.

It knows the words of the contest's workbooks, in Chinese and English, and their usual variants.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from app.grade.grid import Cell, plain

UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "米": 1.0, "厘米": 1e-2, "毫米": 1e-3}
TIME = re.compile(r"(?:t\s*=?\s*)?([-+]?\d+(?:\.\d+)?)\s*(s|sec|seconds?|秒)?", re.IGNORECASE)
UNIT = re.compile(r"[(\[]\s*([a-zμ米厘毫]+)\s*(/\s*(?:s|秒))?\s*[)\]]?$", re.IGNORECASE)
HEAD, REAR = re.compile(r"龙头|head", re.IGNORECASE), re.compile(r"[(（]\s*后|后把手|rear", re.IGNORECASE)
TAIL = re.compile(r"龙尾|tail", re.IGNORECASE)
BODY = re.compile(r"第?\s*(\d+)\s*节|body\D*(\d+)|龙身\D*(\d+)", re.IGNORECASE)
SPEED_WORD = re.compile(r"速度|速率|speed|velocity|^v$", re.IGNORECASE)
TIME_WORD, HANDLE_WORD = re.compile(r"时间|time|^t$", re.IGNORECASE), re.compile(r"把手|handle", re.IGNORECASE)
# Components of a number, in the order of the last axis of a table.
X, Y, SPEED = 0, 1, 2


@dataclass(frozen=True)
class Label:
    """handle: -1: the tail, -2: its rear; handle and component: None if the label names none."""

    handle: int | None
    component: int | None
    unit: float


def label_of(cell: Cell) -> Label | None:
    """Meaning of a text beside a line of numbers; None if it is no label."""
    if not isinstance(cell, str):
        return None
    text = plain(cell)
    unit, component = 1.0, None
    if found := UNIT.search(text):
        unit = UNITS.get(found[1].lower(), 1.0)
        component = SPEED if found[2] else None
        text = text[: found.start()].rstrip() if found[2] or found[1].lower() in UNITS else text
    if component is None and (axis := re.search(r"([xy])\s*(?:坐标|轴)?$", text, re.IGNORECASE)):
        component = "xy".index(axis[1].lower())
    elif component is None and SPEED_WORD.search(text):
        component = SPEED
    handle = None
    if HEAD.search(text):
        handle = 0
    elif TAIL.search(text):
        handle = -2 if REAR.search(text) else -1
    elif body := BODY.search(text):
        handle = int(next(filter(None, body.groups())))
    return None if handle is None and component is None else Label(handle, component, unit)


def instant_of(cell: Cell) -> float | None:
    """Time in a cell [s], given as text with or without a unit, or as a number."""
    if isinstance(cell, float):
        return cell
    found = TIME.fullmatch(plain(cell)) if isinstance(cell, str) else None
    return float(found[1]) if found else None
