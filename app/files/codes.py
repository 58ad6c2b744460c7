"""Addresses as QR codes, on paper and on a screen."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from typing import Any, Self

import segno

from app.files.addresses import short_form

# Light modules around a code, and the least width of a module [mm]: a phone reads it from a hand's breadth, and a scan
# of 150 dpi has three pixels for each.
QUIET, MODULE = 2, 0.5
# The largest code that a phone reads from a screen: 25 of the 40 versions; light modules around it.
VERSION_MAX, QUIET_ON_SCREEN = 25, 4


@dataclass(frozen=True, slots=True)
class Code:
    """A code as a picture in SVG, and its least width with the light modules around it [mm]."""

    address: str
    picture: str
    least: float

    @classmethod
    def of(cls, address: str, error: str = "l") -> Self:
        """The code of an address in its short form. error: the least share of damage that it bears: l, m, q or h"""
        short, code = _code_of(address, error)
        return cls(short, code.svg_inline(border=QUIET), MODULE * code.symbol_size(border=QUIET)[0])

    def to_json(self, wide: float = 0.0) -> dict[str, Any]:
        """The code as a template takes it. wide: its width if it can be so narrow [mm]"""
        return {"picture": self.picture, "alt": self.address, "wide": max(self.least, wide)}


def _code_of(address: str, error: str) -> tuple[str, segno.QRCode]:
    """The short form of an address, and its code. raises: segno.DataOverflowError for an address too long for one"""
    short = short_form(address)
    beginning, number, digits = short.partition("z=") if short != address else (address, "", "")
    parts: Any = [part for part in (beginning + number, digits) if part]  # segno's types know of one part alone.
    return short, segno.make(parts, error=error, micro=False)


def code_on_screen(address: str) -> bytes | None:
    """The code of an address as a picture in SVG; None for one that is too long for a phone to read."""
    try:
        _, code = _code_of(address, "l")
    except segno.DataOverflowError:
        return None
    picture = BytesIO()
    code.save(picture, kind="svg", border=QUIET_ON_SCREEN, light="#fff")
    return picture.getvalue() if int(code.version) <= VERSION_MAX else None
