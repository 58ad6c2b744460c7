"""The paper's numbers, the reasons for their differences and the evidence."""

from __future__ import annotations

from core.language import Phrases

# fmt: off
PAPER: Phrases = {
    "paper_title": "The paper beside this program",
    "paper_others": "Other publications",
    "paper_quantity": "quantity",
    "paper_paper": "paper",
    "paper_published": "published",
    "paper_ours": "here",
    "paper_difference": "difference",
    "paper_unknown": "No known shortcut gives it.",
    "paper_length": "arc length of the spiral",
    "paper_length_at": "eq. 2",
    "paper_length_why": "The same, to the paper's six decimals.",
    "paper_time": "time of first contact",
    "paper_time_at": "figure 7",
    "paper_time_why": "The paper's rule adds angles and calls 360 degrees a collision. Near an edge the sum nears 360 degrees without a contact: it passes {angle:g} degrees at {loose:.2f} s, where benches {a} and {b} are {gap:.1f} mm apart. Rounding such a sum up to 360 gives the paper's time.",
    "paper_time_largest": "largest angle sum at the paper's time",
    "paper_time_loose": "first time of an angle sum of {angle:g} degrees",
    "paper_time_gap": "clearance at the paper's time, benches {a} and {b}",
    "paper_time_exact": "first time of an angle sum of 360 degrees",
    "paper_time_literal": "the same with eq. 12 as printed: w/2 cos theta of the wrong sign in all four y",
    "paper_radius": "radius of the head at first contact",
    "paper_radius_at": "section 3.3",
    "paper_radius_why": "The paper's own numbers exclude each other: at its {time:g} s the head is at {radius:.3f} m, and it passes {paper:g} m at {passed:.2f} s. No reading was found that gives the paper's number.",
    "paper_radius_there": "radius of the head at the paper's time",
    "paper_radius_passed": "time at which the head passes the paper's radius",
    "paper_pitch": "minimum pitch",
    "paper_pitch_at": "section 3.3",
    "paper_pitch_why": "The paper bisects the radius of first contact towards {circle:g} m, but that radius jumps from {below:.3f} to {above:.3f} m at a pitch of {jump:.7f} m: none gives {circle:g} m, so the error that it drives to 1e-10 cannot vanish. At the paper's pitch the head gets to {reached:.3f} m, well inside the circle. No reading was found that gives the paper's number.",
    "paper_pitch_jump": "pitch at which a bisection of the radius ends",
    "paper_pitch_below": "radius of first contact just below it",
    "paper_pitch_above": "radius of first contact just above it",
    "paper_pitch_reached": "radius of first contact at the paper's pitch",
    "paper_pitch_alone": "largest pitch at which the pose on the circle alone touches",
    "paper_pitch_head": "the same with the pairs of the head only, as in eqs. 14-17",
}
# fmt: on
