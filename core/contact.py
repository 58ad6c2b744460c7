"""First contact and clearance along time, with a certificate."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.dragon import Dragon, Floats
from core.kinematics import RunEnd
from core.paths import Spiral


class Outcome(StrEnum):
    """How a search for first contact ended."""

    CONTACT = "contact"
    CONTACT_AT_START = "contact_at_start"
    CLEAR = "clear"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class HeadState:
    """Handle 0 at one instant: theta [rad, unwrapped], radius [m], x [m], y [m]."""

    theta: float
    radius: float
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Feature:
    """A corner or an edge of one bench. Corners: front-outer, front-inner, rear-outer, rear-inner;
    edges: front, rear, outer, inner. front is towards the lower handle, outer away from the centre."""

    bench: int
    name: str


@dataclass(frozen=True, slots=True)
class Graze:
    """A local minimum of the clearance over time: time [s], clearance [m], the pair."""

    time: float
    clearance: float
    benches: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Certificate:
    """How the answer is known.

    method: one sentence; steps: proven steps taken; clear_until: nothing touches in [0, clear_until] [s]
    bound: the largest bound on the second derivative of a gap along the head's way that a step used [1/m]
    least_clearance: the narrowest graze met before the contact (or over the whole run), None if none
    """

    method: str
    steps: int
    clear_until: float
    bound: float
    least_clearance: Graze | None


@dataclass(frozen=True, slots=True)
class FirstContact:
    """When two benches that share no handle first come within the margin.

    time: [s], None when clear or undecided; 0 for contact_at_start
    time_bracket: (proven clear up to, overlapping at) [s], at most 1e-9 s wide for a contact; for
        undecided (proven clear up to, not decided from there to); None when clear or at the start
    head: the head at that time; benches: the pair (a, b), a < b; corner, edge: the features that meet;
    point: (x, y) [m] of the corner; end: where the run ends when clear
    """

    outcome: Outcome
    time: float | None
    time_bracket: tuple[float, float] | None
    head: HeadState | None
    benches: tuple[int, int] | None
    corner: Feature | None
    edge: Feature | None
    point: tuple[float, float] | None
    end: RunEnd | None
    certificate: Certificate


@dataclass(frozen=True, slots=True)
class ClearanceProfile:
    """time (T,) [s], clearance (T,) [m], benches (T, 2), and the local minima between the first and last time."""

    time: Floats
    clearance: Floats
    benches: Floats
    grazes: tuple[Graze, ...]


def first_contact(
    dragon: Dragon, path: Spiral, *, head_speed: float = 1.0, margin: float = 0.0
) -> FirstContact:
    """When two benches first come within the margin, certified."""
    raise NotImplementedError


def clearance_profile(
    dragon: Dragon, path: Spiral, times: Floats, *, head_speed: float = 1.0
) -> ClearanceProfile:
    """Exact clearance and its pair at every time, and its local minima refined."""
    raise NotImplementedError
