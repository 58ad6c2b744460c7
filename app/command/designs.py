"""The commands that choose a path or a speed: minimum pitch, the turn, its time, the shortest and the quickest one,
maximum head speed."""

from __future__ import annotations

from app.command import show
from app.command.options import Json, asks
from app.questions import maximum_head_speed as speeds
from app.questions import minimum_pitch as pitches
from app.questions import quickest_turn as quickest
from app.questions import shortest_turn as shortest
from app.questions import turn as turns
from app.questions import turn_time as times
from app.questions.maximum_head_speed import MaximumHeadSpeedQuery, MaximumHeadSpeedRequest
from app.questions.minimum_pitch import MinimumPitchQuery, MinimumPitchRequest
from app.questions.quickest_turn import QuickestTurnQuery, QuickestTurnRequest
from app.questions.shortest_turn import ShortestTurnQuery, ShortestTurnRequest
from app.questions.turn import TurnQuery
from app.questions.turn_time import TurnTimeQuery, TurnTimeRequest
from app.wire.question import Terms
from core.errors import format_number
from core.language import say


@asks(MinimumPitchQuery, MinimumPitchRequest)
def minimum_pitch(request: MinimumPitchQuery | MinimumPitchRequest, json: Json = False) -> None:
    """The smallest pitch such that every larger one lets the head reach the turning circle."""
    with show.waiting(say("minimum pitch")):
        answer = pitches.minimum_pitch(request, Terms())
    gap = f" and no bench within {format_number(request.margin)} m of another" if request.margin else ""
    title = f"Minimum pitch for a turning circle of {format_number(request.turning_diameter)} m{gap}"
    show.print_answer(title, answer, json, margin=request.margin, benches=request.benches)


@asks(TurnQuery)
def turn(request: TurnQuery, json: Json = False) -> None:
    """Two tangent arcs that lead from a spiral inwards to the same spiral, rotated by half a turn, outwards."""
    show.print_answer("Turn", turns.turn(request, Terms()), json)


@asks(ShortestTurnQuery, ShortestTurnRequest)
def shortest_turn(request: ShortestTurnQuery | ShortestTurnRequest, json: Json = False) -> None:
    """The shortest turn inside its circle that the dragon can dance, and what limits it."""
    with show.waiting(say("shortest turn")):
        answer = shortest.shortest_turn(request, Terms())
    gap = f" with no bench within {format_number(request.margin)} m of another" if request.margin else ""
    show.print_answer(f"Shortest turn{gap}", answer, json, margin=request.margin)


@asks(TurnTimeQuery, TurnTimeRequest)
def turn_time(request: TurnTimeQuery | TurnTimeRequest, json: Json = False) -> None:
    """How long the head takes through a turn at the highest speed at which no handle exceeds the limit."""
    answer = times.turn_time(request, Terms())
    show.print_answer(
        f"Time through the turn with no handle above {format_number(request.speed_limit)} m/s", answer, json
    )


@asks(QuickestTurnQuery, QuickestTurnRequest)
def quickest_turn(request: QuickestTurnQuery | QuickestTurnRequest, json: Json = False) -> None:
    """The turn inside its circle that takes the head the shortest time of those in a scan."""
    with show.waiting(say("quickest turn")):
        answer = quickest.quickest_turn(request, Terms())
    show.print_answer(
        f"Quickest turn with no handle above {format_number(request.speed_limit)} m/s",
        answer,
        json,
        margin=request.margin,
    )


@asks(MaximumHeadSpeedQuery, MaximumHeadSpeedRequest)
def maximum_head_speed(request: MaximumHeadSpeedQuery | MaximumHeadSpeedRequest, json: Json = False) -> None:
    """The largest constant head speed at which no handle exceeds the limit on the way through a turn."""
    with show.waiting(say("maximum head speed")):
        answer = speeds.maximum_head_speed(request, Terms())
    show.print_answer(f"Maximum head speed for {format_number(request.speed_limit)} m/s", answer, json)
