"""Stray of holes from their nominal places: one number, or that of people and the play of pins in their holes."""

from __future__ import annotations

from dataclasses import dataclass

from core.dragon import Dragon
from core.errors import InvalidValue, said
from core.shown import Shown, worded
from core.values import SIZE_MAX, checked_number

# Of a sum in metres: 1 cm and 0.5 cm are 0.015 m, not 0.015000000000000001 m [1].
DECIMALS = 15


@dataclass(frozen=True, slots=True)
class Stray(Shown):
    """Largest distance of every hole from its place, by people and by play.

    people: largest distance of a person from their place [m]; hole, pin: diameters in a joint [m]. A pin has
    (hole - pin) / 2 of play on every side, which adds to the stray of people.

    >>> Stray(people=0.02, hole=0.055, pin=0.045).total
    0.025
    """

    people: float = 0.0
    hole: float = 0.0
    pin: float = 0.0

    def __post_init__(self) -> None:
        for name in ("people", "hole", "pin"):
            object.__setattr__(self, name, checked_number(f"stray.{name}", getattr(self, name), "m", 0.0, SIZE_MAX))
        if self.pin > self.hole:
            rule = f"must be no wider than its hole (stray.hole = {said(self.hole)} m)"
            raise InvalidValue("stray.pin", f"stray.pin {rule}, got {said(self.pin)} m")

    @property
    def total(self) -> float:
        """Largest distance of a hole from its place, people and play together [m]."""
        return round(self.people + 0.5 * (self.hole - self.pin), DECIMALS) if self.hole > self.pin else self.people

    def _line(self) -> str:
        return f"{worded(self.total, 'm')} in all"


def checked_stray(stray: object, dragon: Dragon) -> float:
    """The stray of every hole of a dragon [m], from 0 to half of its shortest chord.

    stray: a number [m] or a Stray
    raises: InvalidValue
    """
    total = stray.total if isinstance(stray, Stray) else checked_number("stray", stray, "m", 0.0, SIZE_MAX)
    if total == 0.0:
        return 0.0
    bench = int(dragon.chords.argmin())
    most = 0.5 * float(dragon.chords[bench])
    if total > most:
        rule = f"must be at most half the chord of bench {bench} ({most:.9g} m)"
        raise InvalidValue("stray", f"stray {rule}, got {total:.9g} m")
    return total
