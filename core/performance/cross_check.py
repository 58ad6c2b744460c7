"""Cross-check of an encounter: four engines judge the whole scene just before and just after it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.contact.answer import Outcome
from core.contact.cross_check import CHECK_TRAVEL, judged_contact
from core.display import Readable, display
from core.errors import question_about
from core.kernels import Budget
from core.motion.trajectory import trajectory
from core.performance.answer import FirstEncounter
from core.performance.performance import Part
from core.shapes.engines import Engine
from core.shapes.overlaps import Verdict
from core.shapes.rectangles import bench_poses
from core.values import Floats

# Both dragons and their benches, as in a FirstEncounter.
Pairing = tuple[tuple[int, int], tuple[int, int]]


@dataclass(frozen=True, slots=True, repr=False)
class EncounterCheck(Readable):
    """Verdicts of independent engines on the benches of several dragons; within the margin counts as overlapping.

    agree: True if every engine asked finds nothing before, and only the reported pair after
    judged: benches judged, a list for each dragon: all, or only those near the pair if there are more than 2,000 or
        they are very crowded; with cross_check=pair or a stray only the pair
    engines: verdict of each engine; angle_sum cannot judge a margin, so it is asked only if the margin is 0
    together: other pairs that come within the margin, or touch if it is 0, at the same time as the reported one
    left_out: engines that were not asked because they cannot judge this case: the angle sum sees only corners inside a
        bench, so it cannot judge a margin or, at the start, benches that cross without a corner inside the other

    With a stray only the reported pair is judged, with its gap at that time as the margin.
    """

    agree: bool
    judged: tuple[tuple[int, ...], ...]
    engines: dict[Engine, Verdict]
    together: tuple[Pairing, ...]
    left_out: tuple[Engine, ...]

    def _line(self) -> str:
        count = sum(map(len, self.judged))
        return f"{len(self.engines)} engines {'agree' if self.agree else 'disagree'} on {count} benches"

    def _rows(self) -> list[tuple[str, str]]:
        engines = [(engine.value, repr(verdict)) for engine, verdict in self.engines.items()]
        rest = [("together", display(self.together)), ("left out", display(self.left_out))]
        return [("agree", display(self.agree)), *engines, *rest]


@question_about("encounter", FirstEncounter, "the engines' verdict on the encounter was not found")
def encounter_check(
    encounter: FirstEncounter, *, whole: bool = True, budget: Budget | None = None
) -> EncounterCheck | None:
    """The engines' verdicts on all benches while the faster head goes CHECK_TRAVEL before and after the bracket.

    whole: True judges the benches of all dragons, False only the reported pair
    An encounter at the start is judged at the start and that much after it, and counts if it is found at one of them.
    returns: None if no dragons meet or nothing is decided
    raises: TooMuchWork
    """
    dragons, benches, performance = encounter.dragons, encounter.benches, encounter.performance
    if encounter.time is None or dragons is None or benches is None:
        return None
    parts = performance.parts
    at_start = encounter.outcome is Outcome.CONTACT_AT_START
    first, last = encounter.time_bracket or (encounter.time, encounter.time)
    clocks = [parts[k].dance.clock for k in dragons]
    step = CHECK_TRAVEL / max(clock.slowest for clock in clocks)
    times = np.array([first if at_start else first - step, last + step])
    poses = np.concatenate([part_poses(part, times, budget) for part in parts], axis=1)
    sizes = np.concatenate([np.stack([one.dance.dragon.lengths, one.dance.dragon.widths], axis=-1) for one in parts])
    counts = [part.dance.dragon.benches for part in parts]
    firsts, owners = np.cumsum([0, *counts]), np.repeat(np.arange(len(parts)), counts)
    pair = (int(firsts[dragons[0]]) + benches[0], int(firsts[dragons[1]]) + benches[1])
    strays = encounter.stray > 0.0 and encounter.gap is not None
    margin = encounter.gap if strays and encounter.gap is not None else encounter.margin
    check = judged_contact(
        poses, sizes, pair, margin=margin, whole=whole and not strays, at_start=at_start, owners=owners, budget=budget
    )
    together = tuple(
        ((int(owners[a]), int(owners[b])), (a - int(firsts[owners[a]]), b - int(firsts[owners[b]])))
        for a, b in check.together
    )
    judged = tuple(
        tuple(bench - int(firsts[k]) for bench in check.judged if owners[bench] == k) for k in range(len(parts))
    )
    return EncounterCheck(check.agree, judged, check.engines, together, check.left_out)


def part_poses(part: Part, times: Floats, budget: Budget | None) -> Floats:
    """Poses (T, n, 3) of a dragon at times of the performance."""
    own = [part.own_time(time) for time in times.tolist()]
    return bench_poses(trajectory(part.dance, own, budget=budget).position)
