"""Which benches overlap at one instant, four ways, and whether the four agree."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from core.dragon import Floats
from core.rectangles import Separation

Pairs = NDArray[np.int64]


class Engine(StrEnum):
    """Four independent ways to find overlapping rectangles."""

    SEPARATING_AXIS = "separating_axis"
    FCL = "fcl"
    SHAPELY = "shapely"
    ANGLE_SUM = "angle_sum"


@dataclass(frozen=True, slots=True)
class Overlaps:
    """pairs (P, 2), a < b, sorted; contact: separation, witness points and normal of each pair."""

    pairs: Pairs
    contact: Separation


@dataclass(frozen=True, slots=True)
class CrossCheck:
    """pairs: what each engine found; agree: all the same; only: pairs by engine that not all engines found.
    missing: pairs by engine that some other engine found and this one did not."""

    agree: bool
    pairs: dict[Engine, Pairs]
    only: dict[Engine, Pairs]
    missing: dict[Engine, Pairs]


@dataclass(frozen=True, slots=True)
class Verdict:
    """Does an engine find the pair overlapping just before and just after first contact?"""

    before: bool
    after: bool


def overlaps(
    poses: Floats,
    lengths: Floats,
    widths: Floats,
    *,
    engine: Engine = Engine.SEPARATING_AXIS,
    margin: float = 0.0,
    chained: bool = True,
) -> Overlaps:
    """All pairs with separation <= margin (neighbours in the chain left out when chained).

    poses: (n, 3) x [m], y [m], heading [rad]; lengths, widths: (n,) [m]
    """
    raise NotImplementedError


def cross_check(
    poses: Floats, lengths: Floats, widths: Floats, *, margin: float = 0.0, chained: bool = True
) -> CrossCheck:
    """The four engines side by side at one instant."""
    raise NotImplementedError


def verdicts(
    before: Floats, after: Floats, lengths: Floats, widths: Floats, *, margin: float = 0.0
) -> dict[Engine, Verdict]:
    """Each engine's word on one pair just before and just after contact.

    before, after: (2, 3) poses of the two benches; lengths, widths: (2,) [m]
    """
    raise NotImplementedError
