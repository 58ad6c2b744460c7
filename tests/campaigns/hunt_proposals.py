"""Proposals for random squares with obstacles and gates, against dense samples of every dance compared by shapely.

`python -m tests.campaigns.hunt_proposals SEED SQUARES`, by default 200 squares. Every proposal must pass its check
and a dense sampling; where there is none, the reason must be right by other means (tests/support/random_squares.py).
"""

from functools import partial

from core import InvalidValue, TooMuchWork
from tests.campaigns import hunting
from tests.support.random_squares import random_case, refuted, wrong_reason

SQUARES = 200


def fault(*seed):
    """The kind of the answer for one random square, and its fault in words ('' for none)."""
    square = random_case(seed)
    try:
        result = square.answer()
    except TooMuchWork:
        return "too much work", ""
    if isinstance(result, InvalidValue):
        # A street has no room beside another one, or beside a corner; any other refusal of a valid square is false.
        return "refused", "" if result.field.startswith("gates.") else str(result)
    if result.reason is not None:
        return f"none: {result.reason.kind.value}", wrong_reason(square, result)
    wrong = [refuted(square, one) for one in result.proposals]
    return f"{len(wrong)} proposals", "; ".join(one for one in wrong if one)


hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    seed, squares = hunting.arguments(0, SQUARES)
    hunting.main(hunt, "squares", seed, 0.0, squares)
