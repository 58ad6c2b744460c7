"""First encounter of two dragons, with a certificate.

The proof is written above its loops: `core/kernels/ensemble.py` for the bounds, `march.py` here for the steps. In
short: time advances from t to t' only if, for every two benches of different dragons that can be near, one axis fixed
in one of the two separates them by more than the margin over all of [t, t'].
"""

from __future__ import annotations

from core import kernels
from core.checks import checked_number
from core.claims.claim import PARTS_LISTED, ClaimKind, DanceSummary, EncounterClaim, PartSummary
from core.contact.answer import OUTCOMES, Feature, Outcome, features
from core.contact.brackets import TOUCHES
from core.contact.encounter_answer import EncounterEvidence, FirstEncounter, NearPass
from core.contact.search import MARGIN_MAX, WORK_BUDGET
from core.contact.stage import PROBED, Stage
from core.contact.stage_march import EncounterMarch, beyond, to_fold
from core.dance import EndReason
from core.dragon import Stray
from core.kernels import Budget, Ended
from core.kernels.results import Marched
from core.paths.path import HeadState
from core.performance import Performance, PerformanceEnd
from core.questions import question_about
from core.values import Pair, Point

# A feature with its dragon.
Owned = tuple[Feature | None, int | None]


@question_about("performance", Performance, "the first encounter was not decided")
def first_encounter(
    performance: Performance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> FirstEncounter:
    """First time at which benches of two different dragons come within the margin, proven to miss no earlier one.

    What each dragon does by itself does not count: see first_contact() for that.
    margin: required clearance [m]; an encounter means separation <= margin
    stray: largest distance of every hole from its place [m]: the answer is then the first time at which two benches may
        come within the margin, because the grounds that they may cover do (core/shapes/reach.py)
    start, stop: interval of the search [s]; None for the beginning and the end of the performance
    returns: see FirstEncounter. The bracket [proven clear up to, within the margin at] is at most 1e-9 s wide. It is
        wider where two benches meet so slowly that rounding hides the gap, as in a slow passage: below about 2 mm/s
        within 50 m of the origin and 6 mm/s 300 m away (1e-9 to 1e-6 s there); within about 1e-5 m of a graze, on paths
        or over times of many kilometres or days, and with a stray. Both ends hold in spite of rounding. The answer is
        undecided if rounding hides it: for benches whose clearance equals the margin to about 1e-11 m at the start or
        in a graze, or for a while; `overlapping` then names a pair that is certainly within the margin at the end of
        the bracket, if any
    raises: InvalidValue; OutsideRun for times outside the performance; TooMuchWork

    >>> import math
    >>> from core import Dance, Dragon, Part, Performance, Spiral
    >>> turned = [Spiral(1.1, 8.0, rotation=rotation) for rotation in (0.0, math.pi)]
    >>> met = first_encounter(Performance([Part(Dance(Dragon(60), spiral)) for spiral in turned]))
    >>> met.outcome.value, round(met.time, 6), met.dragons, met.benches
    ('contact', 207.378361, (0, 1), (3, 0))
    """
    budget = budget or Budget()
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed = performance.checked_stray(stray)
    span = performance.span(start, stop)
    stage = Stage(performance, span, margin, stray=strayed, work=WORK_BUDGET, budget=budget)
    met = marched(stage)
    end = performance.end
    if stop is not None and span[1] < end.time:
        end = PerformanceEnd(EndReason.STOP, span[1])
    if met.ended is Ended.STUCK:
        answer = _undecided(stage, met)
        budget.afford()  # it may be undecided because the work is spent
        return answer
    return _decided(stage, met, end)


def marched(stage: Stage, *, dips: bool = True) -> Marched:
    """The march over the span of a stage, from where its rings no longer prove all to be clear; up to a fold if it ends
    there."""
    begin, until = stage.span
    if len(stage.players) == 1:
        return Marched(Ended.REACHED, until)
    march, first = EncounterMarch(stage, dips=dips), max(begin, stage.clear_until())
    if first >= until:
        return Marched(Ended.REACHED, until)
    folding = stage.folding(until)
    return to_fold(stage, march, first, until, folding) if folding else march.run(first, until)


def summary(performance: Performance) -> dict[str, object]:
    """What a claim says of a performance, by the names of its fields."""
    parts = []
    for part in performance.parts if len(performance.parts) <= PARTS_LISTED else ():
        frame = part.dance.path.frame
        place = frame.centre, frame.rotation, frame.clockwise
        parts.append(PartSummary(part.name, DanceSummary.of(part.dance), part.delay, *place))
    benches = sum(part.dance.dragon.benches for part in performance.parts)
    return {"parts": tuple(parts), "part_count": len(performance.parts), "bench_count": benches}


def encounter_claim(stage: Stage, kind: ClaimKind, **values: object) -> EncounterClaim:
    about = {"margin": stage.margin, "stray": stage.stray, "start": stage.span[0], **values}
    return EncounterClaim(kind, **summary(stage.performance), **about)  # type: ignore[arg-type]


def _evidence(stage: Stage, met: Marched, claim: EncounterClaim) -> EncounterEvidence:
    near = None
    if met.graze is not None:
        near = NearPass(met.graze.moment, met.graze.gap, *stage.pair(*met.graze.pair))
    return EncounterEvidence(claim, met.steps, claim.clear_until, met.gap_curvature, near)


def _undecided(stage: Stage, met: Marched) -> FirstEncounter:
    """The answer of a search that gave up."""
    begin, until = stage.span
    later = beyond(stage, met, until)
    overlapping = None
    values: dict[str, object] = {"clear_until": met.proven if met.proven > begin else None}
    if later is not None and later.touching is not None:
        until, overlapping = later.touching, stage.pair(*later.pair)
        values |= {"time": until, "dragons": overlapping[0], "benches": overlapping[1]}
    return FirstEncounter(
        Outcome.UNDECIDED,
        time_bracket=(met.proven, until),
        overlapping=overlapping,
        certificate=_evidence(stage, met, encounter_claim(stage, ClaimKind.UNDECIDED, **values)),
        margin=stage.margin,
        stray=stage.stray,
        performance=stage.performance,
    )


def _decided(stage: Stage, met: Marched, end: PerformanceEnd) -> FirstEncounter:
    outcome, performance = OUTCOMES[met.ended], stage.performance
    about = {"margin": stage.margin, "stray": stage.stray, "performance": performance}
    if met.ended not in TOUCHES or met.touching is None:
        claim = encounter_claim(stage, ClaimKind.CLEAR, clear_until=stage.span[1], end=end.reason)
        return FirstEncounter(outcome, end=end, certificate=_evidence(stage, met, claim), **about)  # type: ignore[arg-type]
    at_start = outcome is Outcome.CONTACT_AT_START
    begin = stage.span[0]
    if at_start and met.touching > begin:  # right where the rings end that prove the time before
        outcome, at_start = Outcome.CONTACT, False
    time = begin if at_start else max(met.touching - met.half, begin)
    dragons, benches = stage.pair(*met.pair)
    clear_until = met.proven if met.proven > begin and not at_start else None
    kind = ClaimKind.CONTACT if clear_until is not None else ClaimKind.CONTACT_AT_START
    claim = encounter_claim(stage, kind, clear_until=clear_until, dragons=dragons, benches=benches, time=met.touching)
    features, point, gap = _features(stage, time, met.pair)
    (corner, of_corner), (edge, of_edge) = features
    return FirstEncounter(
        outcome,
        time=time,
        time_bracket=None if at_start else (met.proven, met.touching),
        dragons=dragons,
        benches=benches,
        corner=corner,
        edge=edge,
        feature_dragons=(of_corner, of_edge),
        point=point,
        heads=(_head(stage, dragons[0], time), _head(stage, dragons[1], time)),
        certificate=_evidence(stage, met, claim),
        gap=gap if at_start or stage.stray else stage.margin,
        **about,  # type: ignore[arg-type]
    )


def _head(stage: Stage, k: int, time: float) -> HeadState:
    player = stage.players[k]
    return player.part.dance.path.head(player.travel(time))


def _features(stage: Stage, time: float, rows: Pair) -> tuple[tuple[Owned, Owned], Point, float]:
    """The corner and the edge that meet, each with its dragon; the place of the corner [m]; and the separation [m]."""
    stage.probe(time, rows)
    placed = stage.chains[PROBED]
    met = kernels.bench_separation(*rows, stage.own_sizes, placed)
    dragons, benches = stage.pair(*rows)
    centres = [stage.players[k].part.dance.path.frame.centre for k in dragons]
    corner, edge, point = features(met, benches, placed[list(rows)], centres)
    owned = [(one[1], dragons[one[0]]) if one else (None, None) for one in (corner, edge)]
    return (owned[0], owned[1]), point, float(met.separation)
