"""Addresses as QR codes on paper, and the addresses of single benches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self
from urllib.parse import urlsplit, urlunsplit

import segno

# Light modules around a code, and the least width of a module [mm]: a phone reads it from a hand's breadth, and a scan
# of 150 dpi has more than two pixels for each.
QUIET, MODULE = 2, 0.42
# Parts of an address that say how a dance is looked at, and by whom.
VIEWED = ("bench", "dragon", "view", "handle", "time", "follow", "rate")


@dataclass(frozen=True, slots=True)
class Code:
    """A code as a picture in SVG, and its least width with the light modules around it [mm]."""

    address: str
    picture: str
    least: float

    @classmethod
    def of(cls, address: str, error: str = "l") -> Self:
        """The code of an address. error: the least share of damage that it bears: l, m, q or h"""
        code = segno.make(address, error=error, micro=False)
        return cls(address, code.svg_inline(border=QUIET), MODULE * code.symbol_size(border=QUIET)[0])

    def to_json(self, wide: float = 0.0) -> dict[str, Any]:
        """The code as a template takes it. wide: its width if it can be so narrow [mm]"""
        return {"picture": self.picture, "alt": self.address, "wide": max(self.least, wide)}


def address_of_bench(address: str, bench: int, dragon: int | None) -> str:
    """The address of the page that opens the card of a bench. address: of the page that shows the dance

    >>> address_of_bench("https://dragon.example/?benches=5&bench=2&time=3", 4, None)
    'https://dragon.example/?benches=5&bench=4'
    """
    parts = urlsplit(address)
    query = [one for one in parts.query.split("&") if one and one.partition("=")[0] not in VIEWED]
    query += ([f"dragon={dragon}"] if dragon else []) + [f"bench={bench}"]
    return urlunsplit(parts._replace(query="&".join(query), fragment=""))
