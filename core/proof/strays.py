"""A claim about strays: nothing touches within a stray, and a pose with a slightly larger one shows a contact."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from flint import acb, arb

from core.dance import Dance
from core.dragon import checked_stray
from core.errors import InvalidValue
from core.language import say
from core.paths.spiral import Spiral
from core.proof.chain import Chain
from core.proof.claims import SpiralClaim, checked_pair, settle
from core.proof.pairs import Benches, Unproven, above, below
from core.proof.words import apart_words, danced_words, spiral_words
from core.quantities import Quantity, format_number
from core.tolerance.exhibit import Exhibit
from core.values import Progress

# Added to the strays of a pose in doubles, to be shown in balls: above the rounding of places up to 1e4 m [m].
POSE_ROUNDING = 1e-9


@dataclass(frozen=True)
class ToleranceClaim(SpiralClaim):
    """While every hole is within the stray of its place and every chord keeps its length, nothing touches in
    [start, stop] [s]; in a pose that the certificate shows, with strays below `shown`, one pair strictly overlaps.

    stray, shown: [m]; shown is None if no pose is part of the claim
    """

    kind: ClassVar[str] = "tolerance"
    head_speed: float
    start: float
    stop: float
    stray: float
    shown: float | None = None

    def __post_init__(self) -> None:
        path = Spiral(self.pitch, self.start_turns)
        dance = Dance(self.dragon, path, self.head_speed)
        start, stop = dance.span(self.start, self.stop)
        stray = checked_stray(self.stray, self.dragon)
        if not stray > 0.0:
            raise InvalidValue("stray", "must be positive: prove clear without one", got=Quantity(stray, "m"))
        settle(self, pitch=path.pitch, start_turns=path.start_turns, head_speed=dance.head_speed)
        settle(self, start=start, stop=stop, stray=stray)

    @cached_property
    def chain(self) -> Chain:
        return Chain(self.dragon, arb(self.pitch), self.start_turns, stray=self.stray)

    @property
    def way(self) -> tuple[float, float]:
        return above(self._place(self.start)), below(self._place(self.stop))

    def _place(self, time: float) -> arb:
        return self.chain.place_after(time * arb(self.head_speed))

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {}

    def verify_overlap(self, overlap: dict[str, Any]) -> str:
        dance = danced_words(self.dragon, self.head_speed, spiral_words(self.pitch, self.start_turns))
        statement = say(
            "{dance}: while every hole is within {stray} m of its place and every chord keeps its length, {apart} from "
            "{start} s to {stop} s",
            dance=dance, stray=format_number(self.stray), apart=apart_words(0.0), start=format_number(self.start),
            stop=format_number(self.stop),
        )  # fmt: skip
        if self.shown is None:
            return say("{statement}.", statement=statement)
        a, b = self._verify_pose(overlap, self.shown)
        return say(
            "{statement}, and benches {a} and {b} overlap in a pose with strays below {shown} m at {time} s.",
            statement=statement, a=a, b=b, shown=format_number(self.shown), time=format_number(overlap["time"]),
        )  # fmt: skip

    def _verify_pose(self, overlap: dict[str, Any], most: float) -> list[int]:
        """Check that two benches that are not neighbours strictly overlap in a pose (17.), and return them.

        raises: Unproven
        """
        chain, time, headings = self.chain, overlap["time"], overlap["headings"]
        a, b = checked_pair(chain, *overlap["benches"])
        if not (self.start <= time <= self.stop and len(headings) == chain.count):
            raise Unproven("the pose is not one of this dragon in this time")
        head = self._place(time)
        nominal, rotation = chain.pose_at(0, head), acb(0, head).exp()
        nominal.grow_to(chain.count)
        handle, pair = acb(*overlap["head"]), Benches([chain.sizes[a], chain.sizes[b]])
        for k, place in enumerate(nominal.points):
            if not abs(handle - rotation * place) < most:
                words = "handle {handle} of the pose is not shown to be within {most} of its place"
                raise Unproven(words, handle=k, most=Quantity(most, "m"))
            if k < chain.count:
                sine, cosine = arb(headings[k]).sin_cos()
                along = acb(cosine, sine)
                rear = handle - chain.sizes[k].chord * along
                if k in (a, b):
                    pair.centres.append((handle + rear) / 2)
                    pair.along.append(along)
                handle = rear
        if not pair.overlapping(1):
            raise Unproven("benches {a} and {b} are not shown to overlap in the pose", a=a, b=b)
        return [a, b]


def recorded_pose(exhibit: Exhibit) -> tuple[dict[str, Any], float]:
    """A pose by its headings, so that every chord is exact (17.), and its strays, rounded up [m].

    raises: InvalidValue for a pose of a bench and an edge of a venue
    """
    if exhibit.benches[1] is None:
        raise InvalidValue("exhibit", "must be a pose of two benches: a venue is not part of a proof")
    links = exhibit.handles[:-1] - exhibit.handles[1:]
    pose = {"head": exhibit.handles[0].tolist(), "headings": np.arctan2(links[:, 1], links[:, 0]).tolist()}
    return {"benches": list(exhibit.benches), "time": exhibit.time} | pose, exhibit.stray + POSE_ROUNDING
