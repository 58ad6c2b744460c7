"""The proven claim of a search for first contact, in complete sentences.

Numbers have all their digits, because a rounded one would describe another dance, or an instant that is not proven.
"""

from __future__ import annotations

from core.dance import Dance, EndReason
from core.dragon import Dragon
from core.errors import said

PROOF = (
    "Proven in steps, each by a bound on the second derivative of the gap along an axis fixed in a bench, and further "
    "out by ring bounds in closed form; computed in doubles, with allowances for their rounding."
)
NO_PAIR = "Fewer than three benches have no two that share no handle."
TRIED = "Computed in doubles, with allowances for their rounding."
MEASURED = "Measured at that instant, in doubles."
ENDS = {
    EndReason.FOLD: ", where a bench folds and the run ends.",
    EndReason.CENTRE: ", where the head is at the centre.",
    EndReason.END: ", where the path ends.",
    EndReason.STOP: ", where the search was to stop.",
}


def claim(dance: Dance, margin: float, stray: float, span: tuple[float, float], then: str) -> str:
    """The claim in words: dragon, path, head speed, margin, stray, and the span of time [s] without a contact.

    then: the rest of the sentence
    """
    start, stop = map(said, span)
    near = f"are nearer to each other than {said(margin)} m" if margin else "touch"
    never = f"from {start} s to {stop} s no two benches that share no handle {near}"
    return f"{_dance(dance)}: {_strayed(stray)}{never}{then} {PROOF if dance.dragon.benches > 2 else NO_PAIR}"


def claim_at_start(dance: Dance, margin: float, stray: float, start: float, pair: tuple[int, int]) -> str:
    """claim() for two benches within the margin at the start [s]."""
    near = f"{_be(stray)} nearer to each other than {said(margin)} m" if margin else f"{'may ' if stray else ''}touch"
    touching = f"at {said(start)} s benches {pair[0]} and {pair[1]} {near}."
    return f"{_dance(dance)}: {_strayed(stray)}{touching} {MEASURED}"


def claim_undecided(dance: Dance, margin: float, stray: float, start: float) -> str:
    """claim() for a search that gave up at the start [s]."""
    near = f"are nearer to each other than {said(margin)} m" if margin else "touch"
    never = f"from {said(start)} s on it is not decided whether two benches that share no handle {near}."
    return f"{_dance(dance)}: {_strayed(stray)}{never} {TRIED}"


def contact_then(pair: tuple[int, int], margin: float, stray: float, time: float) -> str:
    """The end of a claim's sentence for a contact that is certain at a time [s]."""
    near = f"{_be(stray)} nearer than {said(margin)} m" if margin else f"{'may ' if stray else ''}overlap"
    return f", and at {said(time)} s benches {pair[0]} and {pair[1]} {near}."


UNDECIDED_THEN = "; whether any do after that is not decided."


def _strayed(stray: float) -> str:
    return (
        f"while every hole is within {said(stray)} m of its place, and every chord keeps its length, " if stray else ""
    )


def _be(stray: float) -> str:
    return "may be" if stray else "are"


def _dance(dance: Dance) -> str:
    return f"{_dragon(dance.dragon)} on {dance.path.words()}, the head at {dance.clock.words()}"


def _dragon(dragon: Dragon) -> str:
    count = f"{dragon.benches} bench{'es' if dragon.benches > 1 else ''}"
    widths, overhangs = dragon.widths, dragon.overhangs
    if dragon.uniform_from > 1 or widths[0] != widths[-1] or overhangs[0] != overhangs[-1]:
        return f"{count} given one by one"
    head, body, width, overhang = map(said, (dragon.lengths[0], dragon.lengths[-1], widths[0], overhangs[0]))
    lengths = f"head {head} m" + (f", body {body} m" if dragon.benches > 1 else "")
    return f"{count} ({lengths}, width {width} m, overhang {overhang} m)"
