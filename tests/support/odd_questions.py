"""Quick questions for sweeps, with designs that fail or kill the process that answers them."""

import os
import signal

from pydantic import BaseModel, Field

from app.sweeps.questions import SweepQuestion
from core import InvalidValue


class OddRequest(BaseModel, extra="forbid"):
    """A place."""

    x: float = Field(0.0, le=100.0)
    y: float = 0.0
    word: str = "word"
    deadly: list[float] = []


class Height(BaseModel):
    """The height of a place."""

    height: float
    side: str | None
    around: tuple[float, float]
    digits: list[int]


def height(request):
    """x times y; refused at x = 13, a mistake at x = 14, the end of the process at the deadly places."""
    if request.x == 13.0:
        raise InvalidValue("x", "must not be 13 m")
    if request.x == 14.0:
        raise ZeroDivisionError("a mistake of ours")
    if request.x in request.deadly:
        os._exit(7)
    product = request.x * request.y
    return Height(
        height=product, side="left" if product > 5.0 else None, around=(product - 1.0, product + 1.0), digits=[1]
    )


def interrupted_height(request):
    """Killed by another one at the deadly places, as by the kernel of a machine that is out of memory."""
    if request.x in request.deadly:
        os.kill(os.getpid(), signal.SIGKILL)
    return height(request)


class Unanswerable:
    """A question that no other process can unpack."""

    def __call__(self, request):
        """The height."""
        return height(request)

    def __reduce__(self):
        """A recipe that fails when a worker unpacks it."""
        return _missing, ("no such module",)


def _missing(what):
    raise ImportError(what)


LAND = SweepQuestion("height", OddRequest, Height, height, 1e-3, "height")
UNANSWERABLE = SweepQuestion("height", OddRequest, Height, Unanswerable(), 1e-3, "height")
INTERRUPTED = SweepQuestion("interrupted_height", OddRequest, Height, interrupted_height, 1e-3, "height")
