"""Dragon: the benches and their handles, frozen and checked once; and Stray, the largest distance of its holes from
their places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from numbers import Integral
from typing import Any

import numpy as np

from core.checks import SIZE_MAX, SIZE_MIN, checked_number, checked_size
from core.display import REPR_MOST, TABLE_DIGITS, Readable, display, format_range
from core.errors import InvalidValue
from core.language import say
from core.names import checked_name
from core.quantities import Given, Parameter, Quantity, Value, from_to, quantities
from core.values import Floats

BENCHES_MAX = 10_000_000
# The sizes that make a dragon.
COLUMNS = ("lengths", "widths", "overhangs")
# Decimals of a sum in metres [1], so that 1 cm and 0.5 cm give 0.015 m, not 0.015000000000000001 m.
DECIMALS = 15


def _column(name: str, values: object, benches: int | None) -> Floats:
    try:
        column = np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidValue(name, "must be numbers in metres, one for each bench") from error
    if column.ndim != 1 or column.size == 0:
        raise InvalidValue(name, "must be a list with one number for each bench")
    if benches is not None and column.size != benches:
        raise InvalidValue(name, "must have {count} numbers, one for each bench", got=column.size, count=benches)
    low = 0.0 if name == "dragon.overhangs" else SIZE_MIN
    wrong = np.flatnonzero(~(np.isfinite(column) & (column >= low) & (column <= SIZE_MAX)))
    if wrong.size:
        k = int(wrong[0])
        limits = from_to("m", low, SIZE_MAX) | quantities("m", got=column[k])
        raise InvalidValue(f"{name}.{k}", "must be from {least} to {most}", **limits)
    return column


def _no_chord(field: str, of: str, length: float, overhang: float) -> InvalidValue:
    """The error for an overhang that leaves no chord. of: name of the length"""
    rule = "must be less than half of {length} ({size} / 2 = {half})"
    values = quantities("m", size=length, half=length / 2)
    return InvalidValue(field, rule, got=Quantity(float(overhang), "m"), length=Parameter(of), **values)


def chord_values(dragon: Dragon) -> dict[str, Value]:
    """The number of chords and the range of their lengths, for messages."""
    ends = quantities("m", 6, shortest=dragon.chords.min(), longest=dragon.chords.max())
    return {"benches": dragon.benches, **ends}


@dataclass(frozen=True, init=False, eq=False)
class Dragon(Readable):
    """n benches in a row, joined by n + 1 handles; bench 0 is the head, handle 0 leads.

    benches: number of benches; there is one more handle
    lengths: length of each bench, (n,), read-only [m]
    widths: width of each bench, (n,), read-only [m]
    overhangs: distance from each handle to the nearer end of its bench, (n,), read-only [m]
    chords: distance of the two handles of each bench, length - 2 overhang > 0, (n,), read-only [m]
    uniform_from: index of the bench from which all benches to the tail are equal (0 or 1 for a uniform body)
    names: one for each bench, empty for a bench without; no entries if no bench has a name

    >>> dragon = Dragon()
    >>> dragon.benches, dragon.chords[0].round(3), dragon.chords[1].round(3)
    (223, np.float64(2.86), np.float64(1.65))
    """

    benches: int = field(repr=False)
    lengths: Floats
    widths: Floats
    overhangs: Floats
    chords: Floats = field(repr=False)
    uniform_from: int = field(repr=False)
    names: tuple[str, ...] = field(repr=False)

    def __init__(
        self,
        benches: int = 223,
        head_length: float = 3.41,
        body_length: float = 2.20,
        width: float = 0.30,
        overhang: float = 0.275,
    ) -> None:
        if not isinstance(benches, Integral) or isinstance(benches, bool):
            raise InvalidValue("dragon.benches", "must be a whole number", got=Given(benches))
        if not 1 <= benches <= BENCHES_MAX:
            raise InvalidValue("dragon.benches", "must be from 1 to {most} benches", got=int(benches), most=BENCHES_MAX)
        head_length = checked_size("dragon.head_length", head_length)
        body_length = checked_size("dragon.body_length", body_length)
        width = checked_size("dragon.width", width)
        overhang = checked_number("dragon.overhang", overhang, "m", 0.0, SIZE_MAX)
        for name, length in (("head_length", head_length), ("body_length", body_length)):
            if length - 2.0 * overhang < SIZE_MIN:
                raise _no_chord("dragon.overhang", f"dragon.{name}", length, overhang)
        lengths = np.full(int(benches), body_length)
        lengths[0] = head_length
        self._freeze(lengths, np.full(int(benches), width), np.full(int(benches), overhang))

    @classmethod
    def of(
        cls, lengths: Sequence[float] | Floats, widths: Sequence[float] | Floats, overhangs: Sequence[float] | Floats
    ) -> Dragon:
        """A dragon with sizes for each bench.

        lengths, widths, overhangs: (n,) [m], head first
        raises: InvalidValue naming the bench when sizes are missing, out of range or leave no chord
        """
        lengths = _column("dragon.lengths", lengths, None)
        widths = _column("dragon.widths", widths, lengths.size)
        overhangs = _column("dragon.overhangs", overhangs, lengths.size)
        wrong = np.flatnonzero(lengths - 2.0 * overhangs < SIZE_MIN)
        if wrong.size:
            k = int(wrong[0])
            raise _no_chord(f"dragon.overhangs.{k}", f"dragon.lengths.{k}", lengths[k], overhangs[k])
        return cls._made(lengths, widths, overhangs)

    @classmethod
    def _made(cls, lengths: Floats, widths: Floats, overhangs: Floats, names: tuple[str, ...] = ()) -> Dragon:
        """A dragon of columns that are checked already."""
        dragon = cls.__new__(cls)
        dragon._freeze(lengths, widths, overhangs, names)
        return dragon

    def _freeze(self, lengths: Floats, widths: Floats, overhangs: Floats, names: tuple[str, ...] = ()) -> None:
        chords = lengths - 2.0 * overhangs
        same = (lengths == lengths[-1]) & (widths == widths[-1]) & (overhangs == overhangs[-1])
        different = np.flatnonzero(~same)
        for name, column in (("lengths", lengths), ("widths", widths), ("overhangs", overhangs), ("chords", chords)):
            column.flags.writeable = False
            object.__setattr__(self, name, column)
        object.__setattr__(self, "benches", lengths.size)
        object.__setattr__(self, "uniform_from", int(different[-1]) + 1 if different.size else 0)
        object.__setattr__(self, "names", names)

    def named(self, names: Sequence[str]) -> Dragon:
        """The same benches with names: one for each, empty for a bench without; or none at all.

        returns: this dragon itself if it has these names already
        raises: InvalidValue

        >>> Dragon(2).named(["Zhou", ""]).called(0)
        '0 (Zhou)'
        """
        if isinstance(names, str) or not isinstance(names, Sequence):
            raise InvalidValue("dragon.names", "must be a list of strings", got=Given(names))
        if names and len(names) != self.benches:
            rule = "must have {count} entries, one for each bench"
            raise InvalidValue("dragon.names", rule, got=len(names), count=self.benches)
        for k, name in enumerate(names):
            checked_name(f"dragon.names.{k}", name)
        if tuple(names) == self.names:
            return self
        return self._made(self.lengths, self.widths, self.overhangs, tuple(names))

    def called(self, bench: int) -> str:
        """A bench in a sentence: its number, and its name if it has one."""
        name = self.names[bench] if self.names else ""
        return f"{bench} ({name})" if name else str(bench)

    def leading(self, benches: int) -> Dragon:
        """The dragon of the first `benches` benches, from 1 to all of them."""
        return self._made(self.lengths[:benches], self.widths[:benches], self.overhangs[:benches], self.names[:benches])

    def outlined(self, overhangs: Floats, widths: Floats) -> Dragon:
        """A dragon with the same chords, to the last bit, and other overhangs and widths (n,) [m]."""
        dragon = self._made(self.chords + 2.0 * overhangs, widths, overhangs, self.names)
        object.__setattr__(dragon, "chords", self.chords)
        object.__setattr__(dragon, "uniform_from", self.uniform_from)
        return dragon

    def __repr__(self) -> str:
        sizes = [getattr(self, name) for name in COLUMNS]
        if not self.names and self.uniform_from <= 1 and all((column[1:] == column[0]).all() for column in sizes[1:]):
            lengths = f"head_length={self.lengths[0]}, body_length={self.lengths[-1]}"
            numbers = f"{lengths}, width={self.widths[0]}, overhang={self.overhangs[0]}"
            return f"Dragon(benches={self.benches}, {numbers})"
        text = f"Dragon.of({', '.join(str(column.tolist()) for column in sizes)})"
        text += f".named({list(self.names)})" if self.names else ""
        return text if len(text) <= REPR_MOST else super().__repr__()

    def _line(self) -> str:
        lengths, widths = format_range(self.lengths, "m"), format_range(self.widths, "m")
        return say("{count} benches, {lengths} long, {widths} wide", count=self.benches, lengths=lengths, widths=widths)

    def _rows(self) -> list[tuple[str, str]]:
        rows = [(name, format_range(getattr(self, name), "m", TABLE_DIGITS)) for name in (*COLUMNS, "chords")]
        return [("benches", str(self.benches)), *rows]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Dragon) or self.names != other.names:
            return False
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in COLUMNS)

    def __hash__(self) -> int:
        return hash(tuple(getattr(self, name).tobytes() for name in COLUMNS))


@dataclass(frozen=True, slots=True)
class Stray(Readable):
    """Largest distance of every hole from its place, by people and by play.

    people: largest distance of a person from the nominal place [m]
    hole: diameter of the holes in the benches [m]
    pin: diameter of the pins in these holes [m]

    A pin has (hole - pin) / 2 of play on every side, which adds to the stray of people.

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
            raise wider_pin("stray.pin", "stray.hole", self)

    @property
    def total(self) -> float:
        """Largest distance of a hole from its place, people and play together [m]."""
        return round(self.people + 0.5 * (self.hole - self.pin), DECIMALS) if self.hole > self.pin else self.people

    def _line(self) -> str:
        return say("{length} in all", length=display(self.total, "m"))


def wider_pin(field: str, hole: str, of: Any) -> InvalidValue:
    """The error for a pin wider than its hole. hole: its name; of: has both sizes"""
    values = quantities("m", got=of.pin, size=of.hole)
    return InvalidValue(field, "must be no wider than its {hole} ({size})", hole=Parameter(hole), **values)


def checked_stray(stray: object, dragon: Dragon) -> float:
    """The stray of every hole of a dragon [m], from 0 to half of its shortest chord. raises: InvalidValue

    stray: a number [m] or a Stray
    """
    total = stray.total if isinstance(stray, Stray) else checked_number("stray", stray, "m", 0.0, SIZE_MAX)
    if total == 0.0:
        return 0.0
    bench = int(dragon.chords.argmin())
    most = 0.5 * float(dragon.chords[bench])
    if total > most:
        rule, got = "must be at most half the chord of bench {bench} ({most})", Quantity(total, "m", 9)
        raise InvalidValue("stray", rule, got=got, bench=bench, most=Quantity(most, "m", 9))
    return total
