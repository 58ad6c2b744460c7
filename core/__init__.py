"""Bench Dragon: where is everyone, when do two benches first touch, how tight may the curve be."""

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
from core.design import LimitedBy, MinimumPitch, minimum_pitch
from core.dragon import Dragon
from core.errors import BenchDragonError, InvalidValue, OutsideRun, TooLarge
from core.kinematics import EndReason, RunEnd, Trajectory, bench_poses, run_end, trajectory
from core.overlaps import CrossCheck, Engine, Overlaps, Verdict, cross_check, overlaps, verdicts
from core.paths import Spiral
from core.rectangles import Separation, separation

__all__ = [
    "BenchDragonError",
    "Certificate",
    "ClearanceProfile",
    "CrossCheck",
    "Dragon",
    "EndReason",
    "Engine",
    "Feature",
    "FirstContact",
    "Graze",
    "HeadState",
    "InvalidValue",
    "LimitedBy",
    "MinimumPitch",
    "Outcome",
    "OutsideRun",
    "Overlaps",
    "RunEnd",
    "Separation",
    "Spiral",
    "TooLarge",
    "Trajectory",
    "Verdict",
    "bench_poses",
    "clearance_profile",
    "cross_check",
    "first_contact",
    "minimum_pitch",
    "overlaps",
    "run_end",
    "separation",
    "trajectory",
    "verdicts",
]
