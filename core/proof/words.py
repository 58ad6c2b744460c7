"""Claims in words, each number as it stands in the certificate."""

from __future__ import annotations

from itertools import groupby

from core.dragon import Dragon
from core.errors import format_number

# Largest number of runs of equal benches that are listed; beyond it only their number is given.
RUNS_LISTED = 4


def runs(dragon: Dragon) -> list[list[float]]:
    """Runs of equal benches as [count, length, width, overhang]."""
    rows = zip(dragon.lengths.tolist(), dragon.widths.tolist(), dragon.overhangs.tolist(), strict=True)
    return [[len(list(run)), *sizes] for sizes, run in groupby(rows)]


def dragon_words(dragon: Dragon) -> str:
    """A dragon in words."""
    rows = runs(dragon)
    if len(rows) > RUNS_LISTED:
        return f"A dragon of {dragon.benches} benches with the sizes that the certificate lists"
    sizes = "; ".join(
        f"{n} of {format_number(length)} m by {format_number(width)} m, overhang {format_number(over)} m"
        for n, length, width, over in rows
    )
    return f"A dragon of {dragon.benches} bench{'es' if dragon.benches > 1 else ''} ({sizes})"


def danced_words(dragon: Dragon, head_speed: float, path: str) -> str:
    """A dragon in words, with the speed of its head on a path that is given in words."""
    return f"{dragon_words(dragon)}, its head at {format_number(head_speed)} m/s on {path}"


def spiral_words(pitch: float, start_turns: float) -> str:
    """A spiral in words."""
    return f"the spiral of pitch {format_number(pitch)} m inwards from {format_number(start_turns)} turns"


def apart_words(margin: float) -> str:
    """The words for benches that stay apart."""
    touch = f"come nearer to one another than {format_number(margin)} m" if margin else "touch"
    return f"no two benches except neighbours {touch}"


def contact_words(benches: list[int], margin: float, start: float, time: float, bracket: str, *, clear: bool) -> str:
    """A contact of two benches within `bracket` [s] of a time [s], and the clear run until the bracket before it.

    clear: whether a clear run comes before; a contact at the start lies within twice the bracket of the start
    """
    near = f"{near_words(benches, margin)} at {format_number(time)} + {bracket} s"
    if not clear:
        within = f"within {format_number(2.0 * float(bracket))} s of the start"
        return f"{near}, {within}, so that no time before is claimed to be clear."
    return f"{apart_words(margin)} from {format_number(start)} s to {format_number(time)} - {bracket} s, and {near}."


def near_words(benches: list[int], margin: float) -> str:
    """The words for two benches that meet."""
    return f"benches {benches[0]} and {benches[1]} " + (
        f"are nearer than {format_number(margin)} m" if margin else "overlap"
    )
