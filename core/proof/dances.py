"""The claims about any path, clear and contact: what each says, its way, how it ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from flint import arb

from core.dragon import Dragon
from core.errors import InvalidValue, said
from core.kinematics import EndReason, checked_head_speed, checked_span, run_end
from core.proof.chain import Chain, Stretch, slopes
from core.proof.claims import TIME_BRACKET, check_near, checked_margin, near_pair, settle
from core.proof.pairs import Unproven, above, below
from core.proof.paths import chain_on, core_path, described
from core.proof.route import RouteChain
from core.proof.sweeps import AnyChain, Progress
from core.proof.words import apart_words, contact_words, dragon_words

# How much later than the stop of a claim the run has ended for certain, where the claim says so: an exact decimal [s].
END_BRACKET = "1e-9"
ENDINGS = ("stop", "fold", "centre", "end")
# Pieces of a bend that are looked at before a fold counts as not shown; 20 to 60 are usual.
FOLD_PIECES = 10_000
# Where the wall of 12. is looked for: by steps of this [rad], so many.
WALL_STEP, WALL_STEPS = 0.01, 700


@dataclass(frozen=True)
class Clear:
    """Nothing touches in [start, stop] [s], or comes within the margin [m].

    path: as paths.py writes it; until: "stop", or what the run has come to END_BRACKET later: a fold, the centre of
    the spiral, the end of the route
    way, find_overlap(), check_overlap(), search_share: as of CollisionTime
    """

    kind: ClassVar[str] = "clear"
    search_share: ClassVar[float] = 0.0
    dragon: Dragon
    path: Mapping[str, Any]
    head_speed: float
    start: float
    stop: float
    until: str = "stop"
    margin: float = 0.0

    def __post_init__(self) -> None:
        _settle_span(self, self.stop)
        endings = ("stop", "fold", "centre") if self.path["kind"] == "spiral" else ("stop", "end")
        if self.until not in endings:
            words = f"until must be {' or '.join(endings)} on a {self.path['kind']}, got {self.until}"
            raise InvalidValue("until", words)

    @cached_property
    def chain(self) -> AnyChain:
        return chain_on(self.dragon, self.path, self.margin)

    @property
    def way(self) -> tuple[float, float]:
        return _way(self.chain, arb(self.start) * self.head_speed, arb(self.stop) * self.head_speed)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {}

    def check_overlap(self, overlap: dict[str, Any]) -> str:
        span = f"from {said(self.start)} s to {said(self.stop)} s{self._ending()}"
        return f"{_dance_words(self)}: {apart_words(self.margin)} {span}."

    def _ending(self) -> str:
        if self.until == "stop":
            return ""
        later = (self.stop + arb(END_BRACKET)) * self.head_speed
        chain = self.chain
        if isinstance(chain, RouteChain):
            if not chain.place_after(later) <= chain.path.pieces[-1].low:
                raise Unproven(f"the route is not shown to end before {said(self.stop)} + {END_BRACKET} s")
            return f", and the route ends before {said(self.stop)} + {END_BRACKET} s"
        if self.until == "centre":
            if not chain.arc(chain.start) <= later:
                raise Unproven(f"the head is not shown to reach the centre before {said(self.stop)} + {END_BRACKET} s")
            return f", and the head reaches the centre before {said(self.stop)} + {END_BRACKET} s"
        before = chain.place_after(self.stop * arb(self.head_speed))
        bench = folding(chain, before, chain.place_after(later))
        return f", and bench {bench} cannot follow any more (it folds) before {said(self.stop)} + {END_BRACKET} s"


@dataclass(frozen=True)
class Contact:
    """Nothing touches in [start, time - 1e-10], and one pair strictly overlaps at time + 1e-10 [s].

    path: as paths.py writes it; margin, way, find_overlap(), check_overlap(), search_share: as of CollisionTime
    """

    kind: ClassVar[str] = "contact"
    search_share: ClassVar[float] = 0.1
    dragon: Dragon
    path: Mapping[str, Any]
    head_speed: float
    start: float
    time: float
    margin: float = 0.0

    def __post_init__(self) -> None:
        _settle_span(self, self.time)

    @cached_property
    def chain(self) -> AnyChain:
        return chain_on(self.dragon, self.path, self.margin)

    @property
    def _after(self) -> arb:
        return self.chain.place_after((self.time + arb(TIME_BRACKET)) * self.head_speed)

    @property
    def way(self) -> tuple[float, float]:
        before = (self.time - arb(TIME_BRACKET)) * self.head_speed
        return _way(self.chain, arb(self.start) * self.head_speed, before)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {"benches": near_pair(self.chain, self._after, f"at {said(self.time)} + {TIME_BRACKET} s")}

    def check_overlap(self, overlap: dict[str, Any]) -> str:
        a, b = overlap["benches"]
        check_near(self.chain, self._after, a, b, f"at {said(self.time)} + {TIME_BRACKET} s")
        clear = bool(self.time - arb(TIME_BRACKET) > self.start)
        words = contact_words([a, b], self.margin, self.start, self.time, TIME_BRACKET, clear=clear)
        return f"{_dance_words(self)}: {words}"


def last_stop(dragon: Dragon, path: Mapping[str, Any], head_speed: float) -> tuple[float, str]:
    """When a clear run is to stop for a claim that includes its end [s], and which end that is."""
    end = run_end(dragon, core_path(path), head_speed=head_speed)
    at_once = end.reason is EndReason.END  # every place up to the end of a route has its chain
    return end.time - (0.0 if at_once else float(END_BRACKET) / 2), end.reason.value


def _settle_span(claim: Clear | Contact, last: float) -> None:
    path, speed = core_path(claim.path), checked_head_speed(claim.head_speed)
    settle(claim, head_speed=speed, margin=checked_margin(claim.margin))
    end = run_end(claim.dragon, path, head_speed=speed)
    start, stop = checked_span(claim.dragon, path, claim.start, last, end, speed)
    settle(claim, start=start, **{"stop" if isinstance(claim, Clear) else "time": stop})


def _way(chain: AnyChain, first: arb, last: arb) -> tuple[float, float]:
    return above(chain.place_after(first)), below(chain.place_after(last))


def _dance_words(claim: Clear | Contact) -> str:
    return f"{dragon_words(claim.dragon)}, its head at {said(claim.head_speed)} m/s on {described(claim.path)}"


def folding(chain: Chain, before: arb, after: arb) -> int:
    """The bench that cannot follow any more when the head gets from one theta to another (12.) [rad].

    raises: Unproven
    """
    pose = chain.pose_at(0, after)
    try:
        pose.grow(chain.count)
    except Unproven:
        bench = len(pose.bends)
    else:
        raise Unproven("every bench is shown to follow past the end that is claimed")
    highest = before
    if bench:
        stretch = Stretch(chain, 0, below(after), above(before), chain.count)
        while len(stretch.placed) < bench:
            stretch.grow()
        highest = stretch.thetas[bench]
    needed, lowest = chain.needed[bench], pose.thetas[bench]
    start = chain.pose_at(0, before)
    start.grow(bench + 1)
    wall = _wall(float(lowest), float(start.bends[bench]))
    if not (start.bends[bench] < wall and _moved(highest, arb(wall)) < needed):
        raise Unproven(f"no wall is found behind bench {bench}")
    if not _stays_short(lowest, wall, needed):
        raise Unproven(f"bench {bench} is not shown to fold")
    return bench


def _moved(theta: arb, d: arb) -> arb:
    """F(theta, d)."""
    return d**2 + 2 * theta * (theta + d) * (1 - d.cos())


def _wall(theta: float, d: float) -> float:
    """About the first local minimum of F(theta, .) beyond d [rad]."""
    falls = False
    for k in range(WALL_STEPS):
        slope = float(slopes(arb(theta), arb(d + k * WALL_STEP))[1])
        if falls and slope > 0.0:
            return d + k * WALL_STEP
        falls = falls or slope < 0.0
    raise Unproven("bends of every size are possible")


def _stays_short(theta: arb, wall: float, needed: arb) -> bool:
    """Is F(theta, d) < needed for all d from 0 to the wall [rad]?"""
    pieces = [(0.0, wall)]
    for _ in range(FOLD_PIECES):
        if not pieces:
            return True
        low, high = pieces.pop()
        hull, middle = arb(low).union(arb(high)), arb((low + high) / 2)
        if not _moved(theta, middle) + slopes(theta, hull)[1] * (hull - middle) < needed:
            pieces += [(low, float(middle)), (float(middle), high)]
    return False
