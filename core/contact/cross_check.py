"""Cross-check of a contact: four engines judge the dance just before and just after it.

A judgement uses only the claim of the search: the time or the pitch, and the pair. It covers the whole dragon: before,
no two benches that share no handle may be within the margin; after, only the reported pair may be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.contact.answer import FirstContact, Outcome
from core.contact.encounter_answer import FirstEncounter
from core.dance import Dance
from core.display import Readable, display
from core.kernels import Budget
from core.language import say
from core.motion.trajectory import trajectory
from core.performance import Part
from core.questions import or_about, question_about
from core.shapes.engines import JUDGES, Engine, able, engine_pairs, unions_meet
from core.shapes.overlaps import Verdict
from core.shapes.reach import SHORT, Reach, reach
from core.shapes.rectangles import Pairs, bench_poses, corners, frames, frames_separation, meeting_pairs, upright_boxes
from core.values import Floats, Pair

Indices = NDArray[np.int64]

# Head travel between first contact and the judged poses [m]: far above the rounding of positions (1e-13 m), far below
# the size of a bench. Within 1e-10 m of a pitch at which two benches only graze, the gap is then too small for the
# angle sum (1e-12 m).
CHECK_TRAVEL = 1e-6
# The same travel in units of the last digit of arc lengths so long that rounding hides a shorter one [1].
CHECK_DIGITS = 64
# Largest depth of a second pair that counts as meeting together with the reported one [m]. The two poses are 2e-6 m
# apart, in which two benches approach by at most twice the highest handle speed over the head's, or by the turns
# between them for each metre of pitch. Near a fold speeds are higher; such a pair counts as a different contact there.
TOGETHER_DEPTH = 1e-5
# Longest dragon that is judged as a whole [benches], and largest number of meeting pairs of cubes around its benches
# [1]: FCL takes about 1 microsecond for each, 3 if the benches touch, and 30 if they touch with a margin.
WHOLE_BENCHES = 2_000
CLOSE_MAX = 30_000


@dataclass(frozen=True, slots=True, repr=False)
class ContactCheck(Readable):
    """Verdicts of independent engines just before and just after; within the margin counts as overlapping.

    agree: True if every engine asked finds nothing before, and only the reported pair after
    judged: benches judged: all, or only those near the pair, or the pair, if there are more than 2,000 or they are very
        crowded; with cross_check=pair only the pair
    engines: verdict of each engine; angle_sum cannot judge a margin, so it is asked only if the margin is 0
    together: other pairs that come within the margin, or touch if it is 0, at the same time as the reported one, as
        when a corner meets two benches of a straight row at once: apart just before, and barely within the margin just
        after
    left_out: engines that were not asked because they cannot judge this case: the angle sum sees only corners inside a
        bench, so it cannot judge a margin or, at the start, benches that cross without a corner inside the other

    The exact separation alone decides what is together, by a depth of at most TOGETHER_DEPTH: engines may find these
    pairs or not.

    >>> from core import Dragon, Spiral, first_contact
    >>> verdict = contact_check(first_contact(Dance(Dragon(), Spiral())))
    >>> verdict.agree, verdict.engines[Engine.SHAPELY]
    (True, Verdict(before=False, after=True))
    """

    agree: bool
    judged: tuple[int, ...]
    engines: dict[Engine, Verdict]
    together: tuple[Pair, ...]
    left_out: tuple[Engine, ...]

    def _line(self) -> str:
        return agreement_words(self.agree, len(self.engines), len(self.judged))

    def _rows(self) -> list[tuple[str, str]]:
        return [("agree", display(self.agree)), ("judged", display(self.judged)), *_engine_rows(self)]


def _engine_rows(check: ContactCheck | EncounterCheck) -> list[tuple[str, str]]:
    """A row for the findings of each engine, and what came together or was left out."""
    verdicts = [(engine.value.replace("_", " "), verdict._line()) for engine, verdict in check.engines.items()]
    return [*verdicts, ("together", display(check.together)), ("left out", display(check.left_out))]


def agreement_words(agree: bool, engines: int, benches: int) -> str:
    """Whether so many engines agree on so many benches."""
    if agree:
        return say("{count} engines agree on {benches} benches", count=engines, benches=benches)
    return say("{count} engines disagree on {benches} benches", count=engines, benches=benches)


# Both dragons and their benches, as in a FirstEncounter.
Pairing = tuple[Pair, Pair]


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

    >>> from core import Dragon, Line, Performance, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> contact_check(first_contact(crossing)).agree
    True
    """

    agree: bool
    judged: tuple[tuple[int, ...], ...]
    engines: dict[Engine, Verdict]
    together: tuple[Pairing, ...]
    left_out: tuple[Engine, ...]

    def _line(self) -> str:
        count = sum(map(len, self.judged))
        return agreement_words(self.agree, len(self.engines), count)

    def _rows(self) -> list[tuple[str, str]]:
        return [("agree", display(self.agree)), *_engine_rows(self)]


@question_about("encounter", FirstEncounter, "the engines' verdict on the encounter was not found")
def encounter_check(
    encounter: FirstEncounter, *, whole: bool = True, budget: Budget | None = None
) -> EncounterCheck | None:
    """The engines' verdicts on all benches while the faster head goes CHECK_TRAVEL before and after the bracket.

    whole: True judges the benches of all dragons, False only the reported pair
    An encounter at the start is judged at the start and that much after it, and counts if it is found at one of them.
    returns: None if no dragons meet or nothing is decided
    raises: TooMuchWork

    >>> from core import Dragon, Line, Performance, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> encounter_check(first_contact(Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])))
    <EncounterCheck: 4 engines agree on 10 benches>
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


@or_about(FirstEncounter, encounter_check)
@question_about("contact", (FirstContact, FirstEncounter), "the engines' verdict on the contact was not found")
def contact_check(contact: FirstContact, *, whole: bool = True, budget: Budget | None = None) -> ContactCheck | None:
    """The engines' verdicts CHECK_TRAVEL of head travel before and after the bracket of a first contact; of a
    FirstEncounter an EncounterCheck.

    A contact at the start is judged at the start and CHECK_TRAVEL after it, and counts if it is found at one of them.
    whole: True judges the whole dragon, False only the reported pair. With a stray each pair has its own distance: the
        engines judge the reported pair with its gap at that time, and shapely judges the ground that benches may cover
    returns: None if nothing touches or nothing is decided
    raises: TooMuchWork

    >>> from core import Dragon, Spiral, first_contact
    >>> check = contact_check(first_contact(Dance(Dragon(), Spiral())))
    >>> check.agree, len(check.judged)
    (True, 223)
    """
    margin, clock, dance = contact.margin, contact.dance.clock, contact.dance.steady
    dragon, path, head_speed = dance.dragon, dance.path, dance.head_speed
    if contact.time is None or contact.benches is None:
        return None
    at_start = contact.outcome is Outcome.CONTACT_AT_START
    first, last = clock.steady(np.array(contact.time_bracket or (contact.time, contact.time))).tolist()
    rounding = CHECK_DIGITS * float(np.spacing(path.place + abs(first) * head_speed))
    travel = max(CHECK_TRAVEL, rounding) / head_speed
    times = [first if at_start else first - travel, last + travel]
    if not whole:  # A bench does not affect those in front of it.
        dance = dance.leading(contact.benches[1] + 1)
    poses = judged_poses(dance, times, budget)
    size = np.stack([dragon.lengths, dragon.widths], axis=-1)[: poses.shape[1]]
    pair = contact.benches
    if not contact.stray or contact.gap is None:
        return judged_contact(poses, size, pair, margin=margin, whole=whole, at_start=at_start, budget=budget)
    own = judged_contact(poses, size, pair, margin=contact.gap, whole=False, at_start=at_start)
    if not whole:
        return own
    between = 1 if contact.certificate.claim.between is None else 2
    ground = reach(dragon, contact.stray)
    on_ground = judged_grounds(poses, ground, pair, margin=margin, at_start=at_start, between=between)
    return replace(
        on_ground,
        agree=on_ground.agree and own.agree,
        engines=own.engines | on_ground.engines,
        left_out=own.left_out,
    )


def judged_poses(dance: Dance, times: list[float], budget: Budget | None) -> Floats:
    """Poses (T, n, 3) of the steady dragon at instants, moved into the run if they are outside."""
    inside = np.clip(times, dance.earliest, dance.end.time)
    return bench_poses(trajectory(dance, inside, budget=budget).position)


def judged_contact(
    poses: Floats,
    sizes: Floats,
    pair: Pair,
    *,
    margin: float = 0.0,
    whole: bool = True,
    at_start: bool = False,
    owners: Indices | None = None,
    budget: Budget | None = None,
) -> ContactCheck:
    """The engines' verdicts on a pair that, by the search, comes within the margin between two instants.

    poses: (2, n, 3) just before and just after, or at a start and just after; sizes: (n, 2) length and width [m]
    owners: (n,) the dragon of each bench: then only pairs of two dragons count; by default all are of one dragon, and
        all pairs but neighbours count
    """
    judged = judged_benches(poses[1], sizes, pair, margin) if whole else np.array(pair)
    two, size = poses[:, list(pair)], sizes[list(pair)]
    together: set[Pair] = set()
    verdicts = {}
    if len(judged) == len(pair):
        verdicts = {engine: _verdict(JUDGES[engine](two, size, margin), at_start) for engine in able(margin)}
    else:
        near, own = poses[:, judged], sizes[judged]
        pairs_of = {engine: _pairs_of(engine, near, own, margin, judged, budget, owners) for engine in able(margin)}
        if not at_start:
            together = _meeting_together(sorted(pairs_of[Engine.SEPARATING_AXIS][1] - {pair}), poses, sizes, margin)
        for engine, (before, after) in pairs_of.items():
            if at_start:
                verdicts[engine] = _verdict([pair in before, pair in after], at_start)
            else:
                verdicts[engine] = Verdict(bool(before), pair in after and after <= together | {pair})
    if at_start:
        _leave_out_blind(verdicts, two, size)
    return _check(verdicts, judged, tuple(sorted(together)))


def _leave_out_blind(verdicts: dict[Engine, Verdict], poses: Floats, sizes: Floats) -> None:
    """Leave the angle sum out if no corner of either bench is inside the other, because it cannot see them cross.

    poses: (2, 2, 3) of the reported pair at both instants; sizes: (2, 2) length and width [m]
    """
    places, half = corners(poses, sizes), 0.5 * sizes
    for own, other in ((0, 1), (1, 0)):
        offset = places[:, other] - poses[:, own, None, :2]
        cos, sin = np.cos(poses[:, own, 2, None]), np.sin(poses[:, own, 2, None])
        along, left = offset[..., 0] * cos + offset[..., 1] * sin, offset[..., 1] * cos - offset[..., 0] * sin
        inside = (np.abs(along) <= half[own, 0]) & (np.abs(left) <= half[own, 1])
        if inside.any():
            return
    verdicts.pop(Engine.ANGLE_SUM, None)


def judged_grounds(
    poses: Floats,
    ground: Reach,
    pair: Pair,
    *,
    margin: float = 0.0,
    at_start: bool = False,
    owners: Indices | None = None,
    between: int = 1,
    budget: Budget | None = None,
) -> ContactCheck:
    """Shapely's verdict on the ground that benches may cover, as judged_contact() for the whole dragon, or for several
    equal ones.

    between: fewest benches between the two of a pair of one dragon that counts
    together: pairs that meet between the two instants. The search uses the largest gap along a direction as the
    distance, which is up to SHORT less than the true one. So the grounds must be apart by the margin before, and within
    the margin and SHORT after.
    """
    sizes = np.stack([ground.bounds.lengths, ground.bounds.widths], axis=-1)
    sizes = np.tile(sizes, (len(poses[0]) // len(sizes), 1))
    judged = judged_benches(poses[1], sizes, pair, margin)
    before, after = (
        _grounds_met(pose, ground, within, {one for one in near if owners is not None or one[1] - one[0] > between})
        for pose, within in zip(poses, (margin, margin * (1.0 + SHORT)), strict=True)
        for near in _pairs_of(Engine.SHAPELY, pose[None, judged], sizes[judged], within, judged, budget, owners)
    )
    together = set() if at_start else after - before - {pair}
    verdict = _verdict([pair in before, pair in after], at_start) if at_start else Verdict(bool(before), pair in after)
    return _check({Engine.SHAPELY: verdict}, judged, tuple(sorted(together)))


def _grounds_met(pose: Floats, ground: Reach, margin: float, near: set[Pair]) -> set[Pair]:
    """Pairs of grounds within the margin. near: pairs whose bounding rectangles are within it"""
    if not near:
        return set()
    placed = []
    for benches in np.array(sorted(near)).T:
        x, y, heading = pose[benches].T[:, :, None, None]
        kinds = ground.kinds[np.minimum(benches % len(ground.bounds.lengths), len(ground.kinds) - 1)]
        along, left = np.moveaxis(ground.hulls[kinds], -1, 0)
        c, s = np.cos(heading), np.sin(heading)
        placed.append(np.stack([x + along * c - left * s, y + along * s + left * c], axis=-1))
    meet = unions_meet(placed[0], placed[1], margin)
    return {pair for pair, meets in zip(sorted(near), meet.tolist(), strict=True) if meets}


def _verdict(within: list[bool], at_start: bool) -> Verdict:
    return Verdict(None, any(within)) if at_start else Verdict(*within)


def _check(verdicts: dict[Engine, Verdict], judged: Indices, together: tuple[Pair, ...]) -> ContactCheck:
    agree = all(verdict.after and not verdict.before for verdict in verdicts.values())
    left_out = tuple(engine for engine in Engine if engine not in verdicts)
    return ContactCheck(agree, tuple(judged.tolist()), verdicts, together, left_out)


# The judged benches need not be consecutive, so the engines search among all of them, and neighbours are removed by
# their numbers.
def _pairs_of(
    engine: Engine,
    poses: Floats,
    sizes: Floats,
    margin: float,
    judged: Indices,
    budget: Budget | None,
    owners: Indices | None = None,
) -> list[set[Pair]]:
    """Pairs that an engine finds at each instant, by their numbers in the dragon, or among all benches."""
    chained = owners is None and len(judged) == int(judged[-1] - judged[0]) + 1
    pairs_at = []
    for indices in engine_pairs(engine, poses, sizes, margin, chained=chained, budget=budget):
        a, b = judged[indices].reshape(-1, 2).T
        apart = b - a != 1 if owners is None else owners[a] != owners[b]
        pairs_at.append(set(zip(a[apart].tolist(), b[apart].tolist(), strict=True)))
    return pairs_at


def _meeting_together(others: list[Pair], poses: Floats, sizes: Floats, margin: float) -> set[Pair]:
    """Pairs that come within the margin between the two instants, and are barely within it after."""
    if not others:
        return set()
    a, b = np.array(others).T
    frame = frames(poses, sizes)
    before, after = frames_separation(frame[:, a], frame[:, b]).separation
    meeting = (before > margin) & (after <= margin) & (after >= margin - TOGETHER_DEPTH)
    return {pair for pair, meets in zip(others, meeting.tolist(), strict=True) if meets}


def judged_benches(poses: Floats, sizes: Floats, pair: Pair, margin: float) -> Indices:
    """The benches to judge, ascending: all of them, those near the pair, or only the pair, as the work allows.

    A bench is near if its upright box comes within the length of the longest bench of the box around the pair.
    poses: (n, 3); sizes: (n, 2)
    """
    everyone = np.arange(len(poses))
    if len(poses) <= WHOLE_BENCHES and _is_manageable(poses, sizes, margin):
        return everyone
    low, high = np.split(upright_boxes(frames(poses, sizes)), 2, axis=1)
    reach = float(sizes[:, 0].max()) + margin
    rows = list(pair)
    is_near = (low <= high[rows].max(axis=0) + reach) & (high >= low[rows].min(axis=0) - reach)
    near: Indices = everyone[is_near.all(axis=1)]
    if len(near) <= WHOLE_BENCHES and _is_manageable(poses[near], sizes[near], margin):
        return near
    return np.array(pair)


# FCL's tree compares upright cubes around the spheres around the boxes, not the upright boxes themselves.
def _is_manageable(poses: Floats, sizes: Floats, margin: float) -> bool:
    """True if so few cubes around benches meet that FCL finishes in 0.1 s, or in 1 s with a margin."""
    if len(poses) * (len(poses) - 1) // 2 <= CLOSE_MAX:
        return True
    upright = np.column_stack([poses[:, :2], np.zeros(len(poses))])
    radius = np.hypot(np.hypot(sizes[:, 0] + margin, sizes[:, 1] + margin), sizes[:, 1] + margin)
    cubes = frames(upright, np.stack([radius, radius], axis=-1))
    meeting: Pairs = meeting_pairs(cubes, 0.0, False, exact=False)
    return len(meeting) <= CLOSE_MAX
