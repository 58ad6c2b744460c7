from . import proof as proof
from .claims.claim import (
    BenchBetween,
    ClaimKind,
    ContactClaim,
    DanceSummary,
    DragonSummary,
    EncounterClaim,
    GroundClaim,
    PartSummary,
    ProbabilityClaim,
    StrayClaim,
    TailClaim,
)
from .contact.answer import Evidence, Feature, FirstContact, Graze, Outcome
from .contact.clearance import ClearanceProfile, LeastClearance, clearance_profile, least_clearance
from .contact.cross_check import ContactCheck, EncounterCheck, contact_check, encounter_check
from .contact.encounter import first_encounter
from .contact.encounter_answer import EncounterEvidence, FirstEncounter, NearPass
from .contact.first_contact import first_contact
from .contact.first_contacts import first_contacts
from .contact.stage_clearance import PerformanceClearance, PerformanceLeastClearance
from .contact.walls import AreaClearance, Misplaced, Nearest, VenueClearance, venue_clearance
from .course import Course, TightBend, course
from .dance import Dance, EndReason, RunEnd
from .design.deepest_turn import DeepestTurn, TurnLimit, deepest_turn
from .design.dubins_turn import DubinsTurn, dubins_turn
from .design.followed_turn import followed_turn
from .design.minimum_pitch import MinimumPitch, minimum_pitch
from .design.pitch_check import pitch_check
from .design.pitch_scan import PitchScan, pitch_scan
from .design.pitch_search import JustifiedBy, LimitedBy
from .design.quickest_turn import TurnTime, quickest_turn, turn_time
from .design.shortest_turn import ShortestTurn, shortest_turn
from .design.turn_length import turn_length_bounds
from .dragon import Dragon, Stray
from .errors import BenchDragonError, InvalidValue, OutsideRun, ProofRefused, TooLarge, TooMuchWork
from .extremes.joints import SharpestBend, sharpest_bend
from .extremes.speed import (
    FirstExcess,
    HighestSpeed,
    MaximumHeadSpeed,
    first_excess,
    highest_speed,
    maximum_head_speed,
)
from .failures import Failure, FailureKind, PerformanceFailure
from .ground.envelope import Envelope, SweepProof, envelope
from .ground.loose_tail import TailProof, TailReach, tail_reach
from .ground.stays import Stay, Stays, stays
from .judgement import Judgement, PerformanceReport, Report, check, quick_check
from .kernels import Budget
from .motion.trajectory import Trajectory, trajectory
from .passages import Passage
from .paths.clothoid_turn import ClothoidTurn
from .paths.following import Hindrance
from .paths.legs import Legs
from .paths.path import HeadState, PathSummary
from .paths.pieces import Arc, Clothoid, Coil, Line, Piece, Waypoints
from .paths.route import Route
from .paths.spiral import Spiral
from .paths.turn import Turn
from .people.cards import Card, Cue, CueKind, card_of
from .people.crew import Carried, Crew, Relief, Spell, crew
from .people.cues import BenchCues, Meeting, Pause, Side, Stand, Turning, bench_cues
from .people.fastest import FastestMoment
from .performance import Part, Performance, PerformanceEnd
from .proposal.answer import Near, Objective, Proposal, Proposals, Reason, ReasonKind
from .proposal.figures import Figure
from .proposal.gates import Gate, GateUse
from .proposal.propose import propose
from .quantities import Given, Parameter, Quantity
from .safe_delay import SafeDelays, safe_delay
from .shapes.engines import Engine
from .shapes.overlaps import CrossCheck, Overlaps, Verdict, cross_check, overlaps, separation, verdicts
from .shapes.rectangles import Separation, bench_outlines, bench_poses
from .tolerance.between_dragons import PerformanceExhibit
from .tolerance.chance import ContactProbability, contact_probability
from .tolerance.curve import ToleranceCurve, tolerance_curve
from .tolerance.exhibit import Exhibit
from .tolerance.tolerance import Limit, PerformanceTolerance, StrayProof, Tolerance, tolerance
from .tolerance.uncertain import uncertain_tolerance
from .tolerance.wobble import Wobble
from .venue import Area, Venue

__all__ = [
    "Arc",
    "Area",
    "AreaClearance",
    "BenchBetween",
    "BenchCues",
    "BenchDragonError",
    "Budget",
    "Card",
    "Carried",
    "ClaimKind",
    "ClearanceProfile",
    "Clothoid",
    "ClothoidTurn",
    "Coil",
    "ContactCheck",
    "ContactClaim",
    "ContactProbability",
    "Course",
    "Crew",
    "CrossCheck",
    "Cue",
    "CueKind",
    "Dance",
    "DanceSummary",
    "DeepestTurn",
    "Dragon",
    "DragonSummary",
    "DubinsTurn",
    "EncounterCheck",
    "EncounterClaim",
    "EncounterEvidence",
    "EndReason",
    "Engine",
    "Envelope",
    "Evidence",
    "Exhibit",
    "Failure",
    "FailureKind",
    "FastestMoment",
    "Feature",
    "Figure",
    "FirstContact",
    "FirstEncounter",
    "FirstExcess",
    "Gate",
    "GateUse",
    "Given",
    "Graze",
    "GroundClaim",
    "HeadState",
    "HighestSpeed",
    "Hindrance",
    "InvalidValue",
    "Judgement",
    "JustifiedBy",
    "LeastClearance",
    "Legs",
    "Limit",
    "LimitedBy",
    "Line",
    "MaximumHeadSpeed",
    "Meeting",
    "MinimumPitch",
    "Misplaced",
    "Near",
    "NearPass",
    "Nearest",
    "Objective",
    "Outcome",
    "OutsideRun",
    "Overlaps",
    "Parameter",
    "Part",
    "PartSummary",
    "Passage",
    "PathSummary",
    "Pause",
    "Performance",
    "PerformanceClearance",
    "PerformanceEnd",
    "PerformanceExhibit",
    "PerformanceFailure",
    "PerformanceLeastClearance",
    "PerformanceReport",
    "PerformanceTolerance",
    "Piece",
    "PitchScan",
    "ProbabilityClaim",
    "ProofRefused",
    "Proposal",
    "Proposals",
    "Quantity",
    "Reason",
    "ReasonKind",
    "Relief",
    "Report",
    "Route",
    "RunEnd",
    "SafeDelays",
    "Separation",
    "SharpestBend",
    "ShortestTurn",
    "Side",
    "Spell",
    "Spiral",
    "Stand",
    "Stay",
    "Stays",
    "Stray",
    "StrayClaim",
    "StrayProof",
    "SweepProof",
    "TailClaim",
    "TailProof",
    "TailReach",
    "TightBend",
    "Tolerance",
    "ToleranceCurve",
    "TooLarge",
    "TooMuchWork",
    "Trajectory",
    "Turn",
    "TurnLimit",
    "TurnTime",
    "Turning",
    "Venue",
    "VenueClearance",
    "Verdict",
    "Waypoints",
    "Wobble",
    "bench_cues",
    "bench_outlines",
    "bench_poses",
    "card_of",
    "check",
    "clearance_profile",
    "contact_check",
    "contact_probability",
    "course",
    "crew",
    "cross_check",
    "deepest_turn",
    "dubins_turn",
    "encounter_check",
    "envelope",
    "first_contact",
    "first_contacts",
    "first_encounter",
    "first_excess",
    "followed_turn",
    "highest_speed",
    "least_clearance",
    "maximum_head_speed",
    "minimum_pitch",
    "overlaps",
    "pitch_check",
    "pitch_scan",
    "propose",
    "quick_check",
    "quickest_turn",
    "safe_delay",
    "separation",
    "sharpest_bend",
    "shortest_turn",
    "stays",
    "tail_reach",
    "tolerance",
    "tolerance_curve",
    "trajectory",
    "turn_length_bounds",
    "turn_time",
    "uncertain_tolerance",
    "venue_clearance",
    "verdicts",
]

__version__: str
