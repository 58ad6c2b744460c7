"""Claims about any path: a clear run and a contact. Each has a statement, a way and an end."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from flint import arb

from core.dance import Dance, EndReason
from core.errors import InvalidValue
from core.language import say
from core.proof.claims import TIME_BRACKET, Claim, checked_margin, near_pair, settle, soon_after, verify_near
from core.proof.fold import folding
from core.proof.pairs import Unproven, above, below
from core.proof.paths import chain_on, core_path, path_words
from core.proof.route import RouteChain
from core.proof.route_stretch import RouteStretch
from core.proof.sweeps import AnyChain
from core.proof.words import apart_words, contact_words, danced_words
from core.quantities import Given, format_number
from core.values import Progress

# Time after the stop of a claim by which the run is certainly over, if the claim includes the end: exact decimal [s].
END_BRACKET = "1e-9"
ENDINGS = ("stop", "fold", "centre", "end")


@dataclass(frozen=True)
class DanceClaim(Claim):
    """A claim about a dance on any path, from `start` on [s]. path: as paths.py writes it"""

    path: Mapping[str, Any]
    head_speed: float
    start: float

    @property
    def chain(self) -> AnyChain:
        raise NotImplementedError

    @property
    def follows(self) -> bool:
        return isinstance(self.chain, RouteChain) and not self.chain.gentle

    @property
    def _danced(self) -> str:
        danced = danced_words(self.dragon, self.head_speed, path_words(self.path))
        if not self.follows:
            return danced
        words = (
            "{danced}, where every rear handle goes forwards, less than 87.44 degrees off its bench, and never jumps"
        )
        return say(words, danced=danced)


@dataclass(frozen=True)
class DanceClearClaim(DanceClaim):
    """Nothing touches in [start, stop] [s], or comes within the margin [m].

    until: "stop", or the end that the run has reached END_BRACKET later: a fold, the centre of the spiral, the end of
    the route
    """

    kind: ClassVar[str] = "clear"
    stop: float
    until: str = "stop"
    margin: float = 0.0

    def __post_init__(self) -> None:
        _settle_span(self, self.stop)
        endings = ("stop", "fold", "centre") if self.path["kind"] == "spiral" else ("stop", "end")
        if self.until not in endings:
            values = {"endings": " or ".join(endings), "kind": str(self.path["kind"])}
            got = Given(self.until, str(self.until))
            raise InvalidValue("until", "must be {endings} on a {kind}", got=got, **values)

    @cached_property
    def chain(self) -> AnyChain:
        return chain_on(self.dragon, self.path, self.margin)

    @property
    def way(self) -> tuple[float, float]:
        return _way(self.chain, arb(self.start) * self.head_speed, arb(self.stop) * self.head_speed)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {}

    def verify_overlap(self, overlap: dict[str, Any]) -> str:
        return say(
            "{dance}: {apart} from {start} s to {stop} s{ending}.",
            dance=self._danced, apart=apart_words(self.margin), start=format_number(self.start),
            stop=format_number(self.stop), ending=self._ending(),
        )  # fmt: skip

    def _ending(self) -> str:
        if self.until == "stop":
            return ""
        later, when = (self.stop + arb(END_BRACKET)) * self.head_speed, soon_after(self.stop, END_BRACKET)
        chain = self.chain
        if isinstance(chain, RouteChain):
            if not chain.place_after(later) <= chain.path.pieces[-1].low:
                raise Unproven("the route is not shown to end before {when}", when=when)
            return say(", and the route ends before {when}", when=when)
        if self.until == "centre":
            if not chain.arc(chain.start) <= later:
                raise Unproven("the head is not shown to reach the centre before {when}", when=when)
            return say(", and the head reaches the centre before {when}", when=when)
        bench = folding(chain, chain.place_after(self.stop * arb(self.head_speed)), chain.place_after(later))
        return say(", and bench {bench} cannot follow any more (it folds) before {when}", bench=bench, when=when)


@dataclass(frozen=True)
class DanceContactClaim(DanceClaim):
    """Nothing touches in [start, time - 1e-10], and one pair strictly overlaps at time + 1e-10 [s].

    margin: as of CollisionTimeClaim
    """

    kind: ClassVar[str] = "contact"
    search_share: ClassVar[float] = 0.1
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
    def _before(self) -> arb:
        return (self.time - arb(TIME_BRACKET)) * self.head_speed

    @property
    def way(self) -> tuple[float, float]:
        return _way(self.chain, arb(self.start) * self.head_speed, self._before)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {"benches": near_pair(self.chain, self._after, self.time)}

    def verify_overlap(self, overlap: dict[str, Any]) -> str:
        a, b = overlap["benches"]
        verify_near(self.chain, self._after, a, b, when=soon_after(self.time))
        chain = self.chain
        if isinstance(chain, RouteChain) and self.follows:
            bracket = RouteStretch(chain, 0, below(self._after), above(chain.place_after(self._before)), chain.count)
            while len(bracket.placed) <= b:
                bracket.grow()
        clear = bool(self.time - arb(TIME_BRACKET) > self.start)
        words = contact_words([a, b], self.margin, self.start, self.time, TIME_BRACKET, clear=clear)
        return say("{name}: {text}", name=self._danced, text=words)


def last_stop(dance: Dance) -> tuple[float, str]:
    """Stop of a clear run whose claim includes the end [s], and the kind of end."""
    end = dance.end
    at_once = end.reason is EndReason.END  # the chain exists at every place up to the end of a route
    return end.time - (0.0 if at_once else float(END_BRACKET) / 2), end.reason.value


def _settle_span(claim: DanceClearClaim | DanceContactClaim, last: float) -> None:
    dance = Dance(claim.dragon, core_path(claim.path), claim.head_speed)
    settle(claim, head_speed=dance.head_speed, margin=checked_margin(claim.margin))
    start, stop = dance.span(claim.start, last)
    settle(claim, start=start, **{"stop" if isinstance(claim, DanceClearClaim) else "time": stop})


def _way(chain: AnyChain, first: arb, last: arb) -> tuple[float, float]:
    return above(chain.place_after(first)), below(chain.place_after(last))
