"""Numbers that people and other programs write as text."""

from __future__ import annotations


def number_of(text: str) -> float:
    """The number that a text is. raises: ValueError, also for 1_000, which Python alone takes for a number

    >>> number_of(" -4.5e-1 ")
    -0.45
    """
    if "_" in text:
        raise ValueError(text)
    return float(text)
