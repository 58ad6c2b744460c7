"""Claims of every kind and form, as the searches of core make them but with short numbers."""

from dataclasses import replace
from pathlib import Path

from core import Dance, Dragon, EndReason, Line, Passage, Route, Spiral, Waypoints
from core.claims.claim import (
    BenchBetween,
    ClaimKind,
    ContactClaim,
    DanceSummary,
    EncounterClaim,
    GroundClaim,
    PartSummary,
    ProbabilityClaim,
    StrayClaim,
    TailClaim,
)
from core.paths.path import PathSummary

ONE, TWO = (DanceSummary.of(Dance(Dragon(count), Spiral(0.9, 4.0))) for count in (1, 2))
FIVE = DanceSummary.of(Dance(Dragon(5, 3.0, 2.0, 0.25, 0.2), Spiral(0.6, 8.0), 0.5))
ODD = DanceSummary.of(
    Dance(Dragon.of([3.0, 2.0, 2.5], [0.3] * 3, [0.2] * 3), Route([Line((0.0, 0.0), (60.0, 0.0))], 20.0))
)
PAUSING = DanceSummary.of(Dance(Dragon(5), Spiral(), 2.0, [Passage(0.5, until_s=5.0), Passage(0.0, until_time=60.5)]))
MANY = DanceSummary.of(Dance(Dragon(5), Spiral(), 1.0, [Passage(1.5, until_time=float(k + 1)) for k in range(7)]))
CURVE = Waypoints(((0.0, 0.0), (30.0, 3.0), (60.0, 0.0)))
WINDING = replace(
    DanceSummary.of(Dance(Dragon(3), Route([CURVE], 20.0))),
    path=PathSummary("route", 0.0, 60.0, pieces=("arc", "coil", "line", "waypoints")),
)
CLEAR, CONTACT, START, UNDECIDED = list(ClaimKind)[:4]
SAFE = ClaimKind.SAFE_STRAY
UNSAFE = ClaimKind.NO_SAFE_STRAY
MET = {"benches": (0, 3), "time": 12.5}

EAST = PartSummary("red", FIVE, 0.0, (0.0, 0.0), 0.0, True)
SECOND = PartSummary(None, TWO, 12.5, (3.0, -1.5), 0.5, False)
BOTH = ((EAST, SECOND), 2, 7)
TEN = ((), 10, 2000)
TOGETHER = {"dragons": (0, 1), "benches": (3, 0), "time": 12.5}

CLAIMS = {
    "fold": ContactClaim(CLEAR, TWO, 0.0, 0.0, 0.0, 20.5, EndReason.FOLD),
    "centre": ContactClaim(CLEAR, ONE, 0.1, 0.0, 0.0, 20.5, EndReason.CENTRE),
    "end": ContactClaim(CLEAR, ODD, 0.0, 0.02, -1.5, 40.0, EndReason.END),
    "stop": ContactClaim(CLEAR, WINDING, 0.05, 0.02, 0.0, 40.0, EndReason.STOP),
    "contact": ContactClaim(CONTACT, FIVE, 0.0, 0.0, 0.0, 12.25, **MET),
    "contact within a margin": ContactClaim(CONTACT, FIVE, 0.05, 0.0, 0.0, 12.25, **MET),
    "contact with a stray": ContactClaim(CONTACT, PAUSING, 0.0, 0.02, 0.0, 12.25, **MET),
    "contact with both": ContactClaim(CONTACT, MANY, 0.05, 0.02, 0.0, 12.25, **MET),
    "start": ContactClaim(START, FIVE, 0.0, 0.0, 12.5, **MET),
    "start within a margin": ContactClaim(START, FIVE, 0.05, 0.0, 12.5, **MET),
    "start with a stray": ContactClaim(START, FIVE, 0.0, 0.02, 12.5, **MET),
    "start with both": ContactClaim(START, FIVE, 0.05, 0.02, 12.5, **MET),
    "undecided": ContactClaim(UNDECIDED, FIVE, 0.0, 0.0, 0.0, 10.0),
    "undecided before a contact": ContactClaim(UNDECIDED, FIVE, 0.0, 0.02, 0.0, 10.0, **MET),
    "undecided before a contact within a margin": ContactClaim(UNDECIDED, FIVE, 0.05, 0.0, 0.0, 10.0, **MET),
    "undecided from the start": ContactClaim(UNDECIDED, FIVE, 0.05, 0.0, 10.0),
    "undecided from the start before a contact": ContactClaim(UNDECIDED, FIVE, 0.05, 0.02, 10.0, **MET),
    "encounter": EncounterClaim(CONTACT, *BOTH, 0.0, 0.0, 0.0, 12.25, **TOGETHER),
    "encounter with both": EncounterClaim(CONTACT, *TEN, 0.05, 0.02, 0.0, 12.25, **TOGETHER),
    "no encounter up to a fold": EncounterClaim(CLEAR, *BOTH, 0.0, 0.0, 0.0, 20.5, EndReason.FOLD),
    "no encounter up to an end": EncounterClaim(CLEAR, *TEN, 0.05, 0.0, 0.0, 20.5, EndReason.END),
    "no encounter up to a stop": EncounterClaim(CLEAR, *TEN, 0.0, 0.0, 0.0, 20.5, EndReason.STOP),
    "a lone dragon": EncounterClaim(CLEAR, (EAST,), 1, 5, 0.0, 0.0, 0.0, 20.5, EndReason.END),
    "encounter at the start": EncounterClaim(START, *TEN, 0.0, 0.0, 12.5, **TOGETHER),
    "undecided encounter": EncounterClaim(UNDECIDED, *TEN, 0.0, 0.0, 0.0, 10.0),
    "undecided before an encounter": EncounterClaim(UNDECIDED, *TEN, 0.05, 0.0, 0.0, 10.0, **TOGETHER),
    "encounters undecided from the start": EncounterClaim(UNDECIDED, *TEN, 0.0, 0.0, 10.0, **TOGETHER),
    "safe stray": StrayClaim(SAFE, FIVE, False, 0.0, 9.5, 0.0125000000000009, False, None),
    "safe stray in a venue": StrayClaim(SAFE, ODD, True, 0.0, 9.5, 0.0125, False, BenchBetween.HELD),
    "safe stray of three": StrayClaim(SAFE, WINDING, False, 0.0, 9.5, 0.0125, False, BenchBetween.UNUSED),
    "no stray": StrayClaim(UNSAFE, FIVE, False, 0.0, 9.5, 0.0, True, None),
    "no stray in a venue": StrayClaim(UNSAFE, FIVE, True, 0.0, 9.5, 0.0, True, None),
    "no stray proven": StrayClaim(UNSAFE, FIVE, True, 0.0, 9.5, 0.0, False, None),
    "probability": ProbabilityClaim(ClaimKind.CONTACT_PROBABILITY, 9, 100, 21, 0.5, 0.95, None, None, 100),
    "probability with bounds": ProbabilityClaim(ClaimKind.CONTACT_PROBABILITY, 9, 100, 21, 0.5, 0.95, 0.25, 0.0125, 3),
    "probability of wide strays": ProbabilityClaim(ClaimKind.CONTACT_PROBABILITY, 9, 9, 21, 0.5, 0.95, 1.5, 0.0125, 0),
    "ground": GroundClaim(ClaimKind.SWEPT_GROUND, 0.0, 9.5, 0.00099987, 1, 30.125, 88),
    "loose tail": TailClaim(ClaimKind.LOOSE_TAIL, 0.0, 9.5, 3, 5.2310005, 0.0, 0.06),
    "loose tail of people who stray": TailClaim(ClaimKind.LOOSE_TAIL, 0.0, 9.5, 1, 1.93, 0.05, 0.06),
}

# Sentences of each claim, in English and in Chinese: a file of its name, both, and an empty line.
_LINES = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines()
SENTENCES = {name: words for name, *words in zip(_LINES[::4], _LINES[1::4], _LINES[2::4], strict=True)}
