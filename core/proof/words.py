"""Claims in words of the language that is spoken, each number as it stands in the certificate."""

from __future__ import annotations

from itertools import groupby

from core.dragon import Dragon
from core.language import counted, say
from core.quantities import format_number

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
        return say("A dragon of {benches} benches with the sizes that the certificate lists", benches=dragon.benches)
    each = [
        say(
            "{count} of {length} m by {width} m, overhang {overhang} m",
            count=n, length=format_number(length), width=format_number(width), overhang=format_number(over),
        )
        for n, length, width, over in rows
    ]  # fmt: skip
    sizes = say("; ").join(each)
    return counted(
        dragon.benches, "A dragon of {count} bench ({sizes})", "A dragon of {count} benches ({sizes})", sizes=sizes
    )


def danced_words(dragon: Dragon, head_speed: float, path: str) -> str:
    """A dragon in words, with the speed of its head on a path that is given in words."""
    speed = format_number(head_speed)
    return say("{dragon}, its head at {speed} m/s on {path}", dragon=dragon_words(dragon), speed=speed, path=path)


def spiral_words(pitch: float, start_turns: float) -> str:
    """A spiral in words."""
    turns = format_number(start_turns)
    return say("the spiral of pitch {pitch} m inwards from {turns} turns", pitch=format_number(pitch), turns=turns)


def apart_words(margin: float) -> str:
    """The words for benches that stay apart."""
    if not margin:
        return say("no two benches except neighbours touch")
    return say(
        "no two benches except neighbours come nearer to one another than {margin} m", margin=format_number(margin)
    )


def contact_words(benches: list[int], margin: float, start: float, time: float, bracket: str, *, clear: bool) -> str:
    """A contact of two benches within `bracket` [s] of a time [s], and the clear run until the bracket before it.

    clear: whether a clear run comes before; a contact at the start lies within twice the bracket of the start
    """
    at = format_number(time)
    near = say("{pair} at {time} + {bracket} s", pair=near_words(benches, margin), time=at, bracket=bracket)
    if not clear:
        return say(
            "{near}, within {within} s of the start, so that no time before is claimed to be clear.",
            near=near,
            within=format_number(2.0 * float(bracket)),
        )
    return say(
        "{apart} from {start} s to {time} - {bracket} s, and {near}.",
        apart=apart_words(margin), start=format_number(start), time=at, bracket=bracket, near=near,
    )  # fmt: skip


def near_words(benches: list[int], margin: float) -> str:
    """The words for two benches that meet."""
    a, b = benches
    if not margin:
        return say("benches {a} and {b} overlap", a=a, b=b)
    return say("benches {a} and {b} are nearer than {margin} m", a=a, b=b, margin=format_number(margin))
