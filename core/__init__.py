"""Bench Dragon: where is everyone, when do two benches first touch, how tight may the curve be."""

from typing import TYPE_CHECKING

from core.bend import SharpestBend, sharpest_bend
from core.check import Failure, FailureKind, Judgement, Report, check
from core.contact import (
    Certificate,
    ClearanceProfile,
    Feature,
    FirstContact,
    Graze,
    HeadState,
    Outcome,
    clearance_profile,
    first_contact,
)
from core.cross import ContactCheck, contact_check, pitch_check
from core.design import LimitedBy, MinimumPitch, minimum_pitch
from core.dragon import Dragon
from core.engines import Engine
from core.errors import BenchDragonError, InvalidValue, OutsideRun, TooLarge, TooMuchWork
from core.kinematics import EndReason, RunEnd, Trajectory, bench_poses, run_end, trajectory
from core.least import LeastClearance, least_clearance
from core.overlaps import CrossCheck, Overlaps, Verdict, cross_check, overlaps, verdicts
from core.paths import Spiral
from core.rectangles import Separation, separation
from core.route import Arc, Coil, Line, Piece, Route, Waypoints
from core.shortest import ShortestTurn, TurnLimit, shortest_turn
from core.speed import HighestSpeed, MaximumHeadSpeed, highest_speed, maximum_head_speed
from core.turn import Turn, turn
from core.venue import Area, AreaClearance, Nearest, Stray, Venue, VenueClearance, venue_clearance

__all__ = [
    "Arc",
    "Area",
    "AreaClearance",
    "BenchDragonError",
    "Certificate",
    "ClearanceProfile",
    "Coil",
    "ContactCheck",
    "CrossCheck",
    "Dragon",
    "EndReason",
    "Engine",
    "Failure",
    "FailureKind",
    "Feature",
    "FirstContact",
    "Graze",
    "HeadState",
    "HighestSpeed",
    "InvalidValue",
    "Judgement",
    "LeastClearance",
    "LimitedBy",
    "Line",
    "MaximumHeadSpeed",
    "MinimumPitch",
    "Nearest",
    "Outcome",
    "OutsideRun",
    "Overlaps",
    "Piece",
    "Report",
    "Route",
    "RunEnd",
    "Separation",
    "SharpestBend",
    "ShortestTurn",
    "Spiral",
    "Stray",
    "TooLarge",
    "TooMuchWork",
    "Trajectory",
    "Turn",
    "TurnLimit",
    "Venue",
    "VenueClearance",
    "Verdict",
    "Waypoints",
    "bench_poses",
    "check",
    "clearance_profile",
    "contact_check",
    "cross_check",
    "first_contact",
    "highest_speed",
    "least_clearance",
    "maximum_head_speed",
    "minimum_pitch",
    "overlaps",
    "pitch_check",
    "run_end",
    "separation",
    "sharpest_bend",
    "shortest_turn",
    "trajectory",
    "turn",
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
