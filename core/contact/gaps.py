"""Least gaps at sampled moments, and over an interval: of the pairs of one path, and of a stage with several dragons.

A moment is a travel of the head [m] on one path (core/contact/stretch.py), and a time [s] on a stage
(core/contact/stage.py). Both look at gaps in their own way; what follows from looking stands here once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Protocol, TypeVar

import numpy as np

from core.kernels import Ended
from core.kernels.results import Dip, Marched
from core.sampling import dips
from core.values import Interval, Pair

# Step of the samples of a clearance, as a part of the shortest chord [1], longer if that is too much work.
PROFILE_STEP = 0.2
# Width to which the least distance is proven [m]; the second one is used if the first needs too many steps.
PROOF_WIDTHS = (1e-5, 1e-3)
# Number of lowest samples to refine before the proof begins.
DIPS_REFINED = 5
# Most smaller distances that a proof may find; each one is smaller by PROOF_WIDTHS[0] or more.
ROUNDS = 100
# Largest number of samples of a dance [1], and largest share of the work for them [1].
SAMPLES = 20_000
SAMPLED_SHARE = 0.1


def sample_count(steps: float, work: float, work_each: float) -> int:
    """Number of samples over a span of so many steps, or fewer if the remaining work requires it [1]."""
    affordable = min(float(SAMPLES), SAMPLED_SHARE * work / work_each)
    return max(3, int(min(3.0 + steps, affordable)))


class Gaps(Protocol):
    """Pairs between two moments. count: number of samples between them; spacing: of a dip's ends and its middle"""

    @property
    def span(self) -> Interval: ...
    @property
    def count(self) -> int: ...
    @property
    def spacing(self) -> float: ...
    def look(self, moment: float, known: Pair = (0, 0)) -> Dip:
        """The least gap at a moment; known: a pair to begin with, which stays if no other is nearer."""

    def sample(self, moment: float, known: Pair = (0, 0)) -> Dip:
        """The least gap at a moment as look(), or only of the pairs that a search needs; affordable work."""

    def gap_rate(self, moment: float, pair: Pair) -> float:
        """Rate at which a pair parts."""

    def bottom(self, low: float, high: float, pair: Pair) -> float:
        """Moment between two at which a pair stops approaching."""


G = TypeVar("G", bound=Gaps)


def moments_of(gaps: Gaps) -> list[float]:
    """Moments in even steps over the span."""
    moments: list[float] = np.linspace(*gaps.span, gaps.count).tolist()
    return moments


def sampled(gaps: Gaps) -> list[Dip]:
    """The least gaps in even steps over the span."""
    return [gaps.sample(moment) for moment in moments_of(gaps)]


def sampled_again(gaps: Gaps, known: Sequence[Dip], within: float) -> list[Dip]:
    """The samples, looked at again where the known gap is at most `within` [m]."""
    return [gaps.sample(dip.moment, dip.pair) if dip.gap <= within else dip for dip in known]


def sampled_least(gaps: Gaps, samples: Sequence[Dip]) -> Dip:
    """The least gap at the ends and in the dips of the samples."""
    moments = [dip.moment for dip in samples]
    lowest = dips(np.array([dip.gap for dip in samples]), DIPS_REFINED).tolist()
    ends = [gaps.look(moments[0]), gaps.look(moments[-1])]
    return min(ends + [_in_dip(gaps, *moments[k - 1 : k + 2]) for k in lowest])


def refined(gaps: Gaps, moment: float) -> Dip:
    """The bottom of the dip around a moment."""
    (begin, until), spacing = gaps.span, gaps.spacing
    return _in_dip(gaps, max(begin, moment - spacing), moment, min(until, moment + spacing))


def _in_dip(gaps: Gaps, low: float, middle: float, high: float) -> Dip:
    """The bottom of the dip around the middle moment; searched again if another pair is nearer there."""
    best = gaps.look(middle)
    for _ in range(2):
        best = min(best, gaps.look(gaps.bottom(low, high, best.pair), best.pair))
    return best


# Where the nearest pair changes, the clearance has a kink that points up. So each local minimum is one of a single
# pair: the nearest pair at one end of a step, if it approaches at the beginning of the step and parts at its end.
def grazes(gaps: Gaps, samples: Sequence[Dip]) -> Iterator[Dip]:
    """The local minima between samples."""
    for before, after in pairwise(samples):
        for pair in sorted({before.pair, after.pair}):
            if gaps.gap_rate(before.moment, pair) < 0.0 < gaps.gap_rate(after.moment, pair):
                lowest = gaps.look(gaps.bottom(before.moment, after.moment, pair), pair)
                if lowest.pair == pair:
                    yield lowest


# The least gap of the samples is an upper bound of the least gap of all. The margin of the march is this gap less a
# width. Either the march reaches the end, which proves that nothing comes nearer than the margin, or it meets a smaller
# gap. Then this gap is refined, and the march goes on from there with a smaller margin; the way that it has passed is
# clear by the larger margin, and so by the smaller one too. Where the bottom of a dip is between the margin and the
# gap, steps are far shorter than the dip is wide, so the march refines it.
def least_over(
    gaps: G,
    march: Callable[[float, float], tuple[G, Marched, float | None]],
    first_touch: Callable[[float, Dip], tuple[Dip, float | None]],
) -> tuple[Dip, float | None]:
    """The least gap over the span, and its proven lower bound [m].

    march: with a margin and from a moment on; the gaps that it has looked at, its result, and what is proven of the
        least gap, if it reached the end or gave up
    first_touch: the answer if a dip has no gap, and nothing touches before a moment
    """
    best = sampled_least(gaps, sampled(gaps))
    begin, proven = gaps.span[0], None
    for width in PROOF_WIDTHS:
        for _ in range(ROUNDS):
            if best.gap <= 0.0:
                return first_touch(begin, best)
            margin = max(best.gap - width, 0.0)
            gaps, marched, left = march(margin, begin)
            if marched.graze is not None and marched.graze.gap < best.gap:
                best = marched.graze
            if marched.ended in (Ended.REACHED, Ended.STUCK):
                if left is not None and left >= margin:
                    return best, margin
                proven = max(proven or 0.0, left or 0.0) or None
                break
            begin = max(begin, marched.proven)
            assert marched.touching is not None
            best = min(best, refined(gaps, marched.touching))
    return best, proven
