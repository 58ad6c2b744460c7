"""Bench Dragon: where is everyone, when do two benches first touch, how tight may the curve be."""

from typing import TYPE_CHECKING

from core.budget import Budget
from core.contact.clearance import ClearanceProfile, Graze, LeastClearance, clearance_profile, least_clearance
from core.contact.cross_check import ContactCheck, contact_check, pitch_check
from core.contact.first_contact import (
    Evidence,
    Feature,
    FirstContact,
    Outcome,
    first_contact,
)
from core.dance import Dance, EndReason, RunEnd
from core.design.minimum_pitch import LimitedBy, MinimumPitch, minimum_pitch
from core.design.pitch_scan import PitchScan, pitch_scan
from core.design.shortest_turn import ShortestTurn, TurnLimit, shortest_turn
from core.dragon import Dragon
from core.errors import BenchDragonError, InvalidValue, OutsideRun, ProofRefused, TooLarge, TooMuchWork
from core.ground.envelope import Envelope, SweepProof, envelope
from core.motion.joints import SharpestBend, sharpest_bend
from core.motion.speed import (
    FirstExcess,
    HighestSpeed,
    MaximumHeadSpeed,
    first_excess,
    highest_speed,
    maximum_head_speed,
)
from core.motion.trajectory import Trajectory, bench_outlines, bench_poses, trajectory
from core.paths.path import HeadState
from core.paths.pieces import Arc, Coil, Line, Piece, Waypoints
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.paths.turn import Turn
from core.shapes.engines import Engine
from core.shapes.overlaps import CrossCheck, Overlaps, Verdict, cross_check, overlaps, verdicts
from core.shapes.rectangles import Separation, separation
from core.tolerance.chance import ContactProbability, contact_probability
from core.tolerance.curve import ToleranceCurve, tolerance_curve
from core.tolerance.exhibit import Exhibit
from core.tolerance.stray import Stray
from core.tolerance.tolerance import Limit, StrayProof, Tolerance, tolerance
from core.tolerance.uncertain import uncertain_tolerance
from core.tolerance.wobble import Wobble
from core.venue import Area, AreaClearance, Misplaced, Nearest, Venue, VenueClearance, venue_clearance
from core.verdict import Failure, FailureKind, Judgement, Report, check

__all__ = [
    "Arc",
    "Area",
    "AreaClearance",
    "BenchDragonError",
    "Budget",
    "ClearanceProfile",
    "Coil",
    "ContactCheck",
    "ContactProbability",
    "CrossCheck",
    "Dance",
    "Dragon",
    "EndReason",
    "Engine",
    "Envelope",
    "Evidence",
    "Exhibit",
    "Failure",
    "FailureKind",
    "Feature",
    "FirstContact",
    "FirstExcess",
    "Graze",
    "HeadState",
    "HighestSpeed",
    "InvalidValue",
    "Judgement",
    "LeastClearance",
    "Limit",
    "LimitedBy",
    "Line",
    "MaximumHeadSpeed",
    "MinimumPitch",
    "Misplaced",
    "Nearest",
    "Outcome",
    "OutsideRun",
    "Overlaps",
    "Piece",
    "PitchScan",
    "ProofRefused",
    "Report",
    "Route",
    "RunEnd",
    "Separation",
    "SharpestBend",
    "ShortestTurn",
    "Spiral",
    "Stray",
    "StrayProof",
    "SweepProof",
    "Tolerance",
    "ToleranceCurve",
    "TooLarge",
    "TooMuchWork",
    "Trajectory",
    "Turn",
    "TurnLimit",
    "Venue",
    "VenueClearance",
    "Verdict",
    "Waypoints",
    "Wobble",
    "bench_outlines",
    "bench_poses",
    "check",
    "clearance_profile",
    "contact_check",
    "contact_probability",
    "cross_check",
    "envelope",
    "first_contact",
    "first_excess",
    "highest_speed",
    "least_clearance",
    "maximum_head_speed",
    "minimum_pitch",
    "overlaps",
    "pitch_check",
    "pitch_scan",
    "separation",
    "sharpest_bend",
    "shortest_turn",
    "tolerance",
    "tolerance_curve",
    "trajectory",
    "uncertain_tolerance",
    "venue_clearance",
    "verdicts",
]

if TYPE_CHECKING:
    __version__: str
else:

    def __getattr__(name: str) -> str:
        """__version__ of the installed distribution, read when somebody asks: it takes 20 ms."""
        if name != "__version__":
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from importlib.metadata import version

        return version("bench-dragon")
