"""The questions, each with its request and its answer. QUESTIONS holds all of them by name.

CALLS holds the service's calls that ask them, by operation id.
"""

from __future__ import annotations

from app.questions import (
    check,
    class_table,
    clearance,
    collision_time,
    contact_probability,
    contest_answer,
    contest_kit,
    course,
    crew,
    cues,
    encounter,
    envelope,
    figures,
    films,
    maps,
    maximum_head_speed,
    minimum_pitch,
    overlaps,
    paper,
    pitch_scan,
    plan,
    proposals,
    quickest_turn,
    safe_delay,
    safety_sheet,
    shortest_turn,
    tolerance,
    tolerance_curve,
    trajectory,
    turn,
    turn_time,
)
from app.wire.question import Call, Question, calls_of

# In the order in which they are documented.
_ALL = (
    trajectory.QUESTION,
    collision_time.QUESTION,
    encounter.QUESTION,
    safe_delay.QUESTION,
    minimum_pitch.QUESTION,
    pitch_scan.QUESTION,
    clearance.QUESTION,
    turn.QUESTION,
    shortest_turn.QUESTION,
    turn_time.QUESTION,
    quickest_turn.QUESTION,
    maximum_head_speed.QUESTION,
    check.QUESTION,
    proposals.QUESTION,
    course.QUESTION,
    envelope.QUESTION,
    tolerance.QUESTION,
    tolerance_curve.QUESTION,
    contact_probability.QUESTION,
    overlaps.QUESTION,
    paper.QUESTION,
    contest_answer.QUESTION,
    class_table.QUESTION,
    figures.TRAJECTORY,
    figures.CONTACT,
    figures.ENCOUNTER,
    figures.PITCH_SCAN,
    films.QUESTION,
    maps.QUESTION,
    plan.QUESTION,
    safety_sheet.QUESTION,
    cues.QUESTION,
    crew.QUESTION,
    contest_kit.QUESTION,
)
QUESTIONS: dict[str, Question] = {question.name: question for question in _ALL}
CALLS: dict[str, Call] = {call.name: call for question in _ALL for call in calls_of(question)}
