"""The words of the figures in Chinese: core draws them in English, and here each text of a figure gets its twin.

A text that is not listed, such as the name of an area, stays as it is.
"""

from __future__ import annotations

import re

from matplotlib.figure import Figure
from matplotlib.text import Text

# Parts of benches, and places where a run ends.
NAMES = {
    "front": "前", "rear": "后", "inner": "内", "outer": "外",
    "front-outer": "前外", "front-inner": "前内", "rear-outer": "后外", "rear-inner": "后内",
    "centre": "中心", "end": "终点", "stop": "所求时刻",
}  # fmt: skip
TEXTS = {
    "head": "龙头",
    "speed of the handle [m/s]": "把手速度 [m/s]",
    "Handles and their speeds at {time} s": "{time} s 时各把手的位置与速度",
    "Handles and their speeds at {time} s (pitch {pitch} m)": "{time} s 时各把手的位置与速度（螺距 {pitch} m）",
    "bench {bench}": "{bench} 号板凳",
    "bench {bench} (head)": "{bench} 号板凳（龙头）",
    "{name} edge of bench {bench}": "{bench} 号板凳的{name}边",
    "{name} corner of bench {bench}": "{bench} 号板凳的{name}角",
    "nearest point": "最近点",
    "First contact: {time} s, head at radius {radius} m": "首次碰撞：{time} s，龙头半径 {radius} m",
    "First within {margin} m: {time} s, head at radius {radius} m":
        "首次相距 {margin} m：{time} s，龙头半径 {radius} m",
    "They meet at {place}": "相碰于 {place}",
    "Within {margin} m: a gap of {gap} m at {place}": "相距不足 {margin} m：{place} 处间距 {gap} m",
    "Within {margin} m from the start on": "从一开始就相距不足 {margin} m",
    "First contact: already at the start": "首次碰撞：起始时即相碰",
    "No contact, but bench {bench} folds at {time} s": "没有碰撞，但 {bench} 号板凳在 {time} s 折叠",
    "Never within {margin} m, but bench {bench} folds at {time} s":
        "相距从不小于 {margin} m，但 {bench} 号板凳在 {time} s 折叠",
    "No contact: the run ends clear at the {name}, {time} s": "没有碰撞：{time} s 到达{name}",
    "Never within {margin} m: the run ends clear at the {name}, {time} s":
        "相距从不小于 {margin} m：{time} s 到达{name}",
    "Undecided": "未能判定",
    "Undecided: clear up to {time} s": "未能判定：{time} s 之前没有碰撞",
    "first contact": "首次碰撞",
    "first within {margin} m of each other": "首次相距 {margin} m",
    "jump": "跳跃",
    "start of the dance": "舞龙起点",
    "turning circle, {radius} m": "调头圆，{radius} m",
    "minimum pitch, {pitch} m": "最小螺距，{pitch} m",
    "pitch [m]": "螺距 [m]",
    "radius of the head at first contact [m]": "首次碰撞时龙头的半径 [m]",
    "radius of the head when two benches are first within {margin} m of each other [m]":
        "两节板凳首次相距 {margin} m 时龙头的半径 [m]",
    "Radius of the head at first contact, against the pitch": "首次碰撞时龙头的半径与螺距",
    "Radius of the head when two benches are first within {margin} m of each other, against the pitch":
        "两节板凳首次相距 {margin} m 时龙头的半径与螺距",
    "At {time} s": "{time} s 时",
    "bench {bench} of {dragon} and bench {other} of {second} touch at {time} s":
        "{dragon}的 {bench} 号板凳与{second}的 {other} 号板凳在 {time} s 相碰",
    "bench {bench} of {dragon} and bench {other} of {second} come within {margin} m at {time} s":
        "{dragon}的 {bench} 号板凳与{second}的 {other} 号板凳在 {time} s 相距 {margin} m",
    "no benches of two dragons touch until {time} s": "到 {time} s 为止，各龙之间没有板凳相碰",
    "no benches of two dragons touch until {time} s, where the last path ends":
        "到 {time} s 最后一条路径结束为止，各龙之间没有板凳相碰",
    "no benches of two dragons touch until {time} s, where bench {bench} of {dragon} folds":
        "到 {time} s {dragon}的 {bench} 号板凳折叠为止，各龙之间没有板凳相碰",
    "no benches of two dragons come within {margin} m until {time} s":
        "到 {time} s 为止，各龙之间的板凳相距从不小于 {margin} m",
    "no benches of two dragons come within {margin} m until {time} s, where the last path ends":
        "到 {time} s 最后一条路径结束为止，各龙之间的板凳相距从不小于 {margin} m",
    "no benches of two dragons come within {margin} m until {time} s, where bench {bench} of {dragon} folds":
        "到 {time} s {dragon}的 {bench} 号板凳折叠为止，各龙之间的板凳相距从不小于 {margin} m",
    "undecided from {time} s on": "从 {time} s 起未能判定",
    # After the sentences that begin in the same way.
    "bench {bench} of {dragon}": "{dragon}的 {bench} 号板凳",
    "dragon {number}": "{number} 号龙",
    "No contact at any of these pitches": "这些螺距都没有碰撞",
    "Never within {margin} m at any of these pitches": "在这些螺距下相距从不小于 {margin} m",
}  # fmt: skip


def _pattern(text: str) -> re.Pattern[str]:
    """What a text looks like, with a name, a number or a point in place of each {value}."""
    kinds = {"name": "[a-z-]+", "place": r"\(.+\)", "dragon": ".+", "second": ".+"}
    pieces = re.split(r"\{(\w+)\}", text)
    return re.compile(
        "".join(
            f"(?P<{piece}>{kinds.get(piece, '[-+.0-9e]+')})" if k % 2 else re.escape(piece)
            for k, piece in enumerate(pieces)
        )
    )


PATTERNS = [(_pattern(text), chinese) for text, chinese in TEXTS.items()]


def in_chinese(text: str) -> str:
    """A text of a figure in Chinese; one that is not known stays.

    >>> in_chinese("bench 8"), in_chinese("inner edge of bench 8"), in_chinese("12.5")
    ('第 8 节板凳', '第 8 节板凳的内边', '12.5')
    """
    for pattern, chinese in PATTERNS:
        if match := pattern.fullmatch(text):
            values = match.groupdict()
            if "name" in values and values["name"] not in NAMES:
                continue
            values |= {one: in_chinese(values[one]) for one in ("dragon", "second") if one in values}
            return chinese.format(**values | {"name": NAMES.get(values.get("name", ""), "")})
    return text


def translate(figure: Figure) -> None:
    """Put the texts of a figure into Chinese."""
    for text in figure.findobj(Text):
        if (words := in_chinese(text.get_text())) != text.get_text():
            text.set_text(words)
