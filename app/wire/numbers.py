"""Numbers that people and other programs write as text."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from core import InvalidValue
from core.quantities import Given, Parameter

Number = TypeVar("Number", int, float)


def number_of(text: str) -> float:
    """The number that a text is. raises: ValueError, also for 1_000, which Python alone takes for a number

    >>> number_of(" -4.5e-1 ")
    -0.45
    """
    if "_" in text:
        raise ValueError(text)
    return float(text)


def numbers_of(option: str, text: str, kind: Callable[[str], Number]) -> list[Number]:
    """A list such as 0,60,120, as the value of an option. raises: InvalidValue naming the entry that is not a number"""
    entries = []
    for k, word in enumerate(text.split(",")):
        try:
            number_of(word)
            entries.append(kind(word))
        except ValueError as error:
            rule = "must be a number, as in --{option} 0,1,2"
            if kind is int:
                rule = "must be a whole number, as in --{option} 0,1,2"
            raise InvalidValue(f"{option}.{k}", rule, got=Given(word), option=Parameter(option)) from error
    return entries
