"""Intervals of numbers and of their derivatives, for many boxes of parameters at once: mean value forms.

A quantity q of the parameters p is known on a box |p - p0| <= h by q(p0) and by intervals that hold its derivatives on
the whole box: q lies within q(p0) + sum of [dq / dp] [-h, h], by the mean value theorem along the segment from p0 to p
(Moore, Interval Analysis, 1966). Everything is computed in doubles; users of the results allow for the rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.values import Floats


@dataclass(frozen=True)
class Span:
    """Intervals from low to high, (N,)."""

    low: Floats
    high: Floats

    def __add__(self, other: Span) -> Span:
        return Span(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Span) -> Span:
        return Span(self.low - other.high, self.high - other.low)

    def __neg__(self) -> Span:
        return Span(-self.high, -self.low)

    def __mul__(self, other: Span) -> Span:
        products = (self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high)
        return Span(np.minimum.reduce(products), np.maximum.reduce(products))

    def scaled(self, factor: float | Floats) -> Span:
        """The intervals times a positive number."""
        return Span(factor * self.low, factor * self.high)

    def increasing(self, of: Callable[[Floats], Floats]) -> Span:
        """Values of an increasing function."""
        return Span(of(self.low), of(self.high))

    def inverse(self) -> Span:
        """1 / x of positive intervals; up to infinity where they reach 0."""
        with np.errstate(divide="ignore"):
            return Span(
                np.where(self.high > 0.0, 1.0 / self.high, np.inf), np.where(self.low > 0.0, 1.0 / self.low, np.inf)
            )

    def squared(self) -> Span:
        """x^2."""
        ends = (self.low * self.low, self.high * self.high)
        inside = (self.low <= 0.0) & (self.high >= 0.0)
        return Span(np.where(inside, 0.0, np.minimum(*ends)), np.maximum(*ends))

    def sine(self) -> Span:
        """sin x: between its values at the ends, and +-1 where they pass a quarter turn."""
        ends = (np.sin(self.low), np.sin(self.high))
        top = np.floor(self.high / (2.0 * np.pi) - 0.25) > np.floor(self.low / (2.0 * np.pi) - 0.25)
        bottom = np.floor(self.high / (2.0 * np.pi) + 0.25) > np.floor(self.low / (2.0 * np.pi) + 0.25)
        return Span(np.where(bottom, -1.0, np.minimum(*ends)), np.where(top, 1.0, np.maximum(*ends)))

    @property
    def furthest(self) -> Floats:
        """Largest |x|, (N,)."""
        return np.maximum(np.abs(self.low), np.abs(self.high))


@dataclass(frozen=True)
class Known:
    """A quantity on boxes: intervals of its value and of its derivatives by each parameter."""

    value: Span
    slopes: tuple[Span, ...]

    def __add__(self, other: Known) -> Known:
        return Known(self.value + other.value, tuple(a + b for a, b in zip(self.slopes, other.slopes, strict=True)))

    def __sub__(self, other: Known) -> Known:
        return Known(self.value - other.value, tuple(a - b for a, b in zip(self.slopes, other.slopes, strict=True)))

    def __neg__(self) -> Known:
        return Known(-self.value, tuple(-slope for slope in self.slopes))

    def __mul__(self, other: Known) -> Known:
        slopes = (a * other.value + self.value * b for a, b in zip(self.slopes, other.slopes, strict=True))
        return Known(self.value * other.value, tuple(slopes))

    def __truediv__(self, other: Known) -> Known:
        return self * other.inverse()

    def scaled(self, factor: float | Floats) -> Known:
        """The quantity times a positive number."""
        return Known(self.value.scaled(factor), tuple(slope.scaled(factor) for slope in self.slopes))

    def plus(self, number: float) -> Known:
        """The quantity plus a number."""
        return Known(Span(self.value.low + number, self.value.high + number), self.slopes)

    def inverse(self) -> Known:
        """1 / x of a positive quantity."""
        value = self.value.inverse()
        return Known(value, tuple(-(slope * value.squared()) for slope in self.slopes))

    def squared(self) -> Known:
        """x^2."""
        twice = self.value.scaled(2.0)
        return Known(self.value.squared(), tuple(twice * slope for slope in self.slopes))

    def root(self) -> Known:
        """sqrt x of a quantity that is not negative."""
        value = self.value.increasing(lambda x: np.sqrt(np.maximum(x, 0.0)))
        rate = value.scaled(2.0).inverse()
        return Known(value, tuple(slope * rate for slope in self.slopes))

    def exponential(self) -> Known:
        """e^x."""
        value = self.value.increasing(np.exp)
        return Known(value, tuple(slope * value for slope in self.slopes))

    def sine(self) -> Known:
        """sin x."""
        rate = Span(self.value.low + 0.5 * np.pi, self.value.high + 0.5 * np.pi).sine()
        return Known(self.value.sine(), tuple(slope * rate for slope in self.slopes))

    def cosine(self) -> Known:
        """cos x."""
        return self.plus(0.5 * np.pi).sine()


def angle_slopes(x: Known, y: Known, squared: Span) -> tuple[Span, ...]:
    """Derivatives of the angle of (x, y), whose squared length is known and positive: (x dy - y dx) / (x^2 + y^2)."""
    over = squared.inverse()
    return tuple((x.value * dy - y.value * dx) * over for dx, dy in zip(x.slopes, y.slopes, strict=True))


def parameters(centres: Floats, halves: Floats) -> tuple[Known, ...]:
    """The parameters themselves on boxes. centres, halves: (P, N), their middles and half widths."""
    zero, one = np.zeros(centres.shape[1]), np.ones(centres.shape[1])
    known = []
    for k, (centre, half) in enumerate(zip(centres, halves, strict=True)):
        slopes = tuple(Span(one, one) if k == other else Span(zero, zero) for other in range(len(centres)))
        known.append(Known(Span(centre - half, centre + half), slopes))
    return tuple(known)


def mean_value(at: Floats, slopes: tuple[Span, ...], halves: Floats) -> Span:
    """Intervals of a quantity on boxes, from its values at their middles, (N,), and its slopes on them."""
    with np.errstate(invalid="ignore"):
        reach = np.nan_to_num(
            sum(slope.furthest * half for slope, half in zip(slopes, halves, strict=True)), nan=np.inf
        )
    return Span(at - reach, at + reach)
