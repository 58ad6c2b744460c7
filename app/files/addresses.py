"""Addresses of the page on paper: of the card of a bench, and in a short form for codes.

A code of digits holds 2.4 times as many characters as one of letters. So a query whose names are all those of the page
is written as one number, which stands as `z` in the address; app/page/short.js reads it. In hexadecimal the number is a
1, then one digit for each of CHARACTERS, and ESCAPE with two digits for each of WORDS, and for any other character by
its code. Nothing is kept anywhere: who has the address has the dance, as before, and nobody else.
"""

from __future__ import annotations

import re
from urllib.parse import urlsplit, urlunsplit

# Parts of an address that say how a dance is looked at, and by whom.
VIEWED = ("bench", "dragon", "view", "handle", "time", "follow", "rate")
# Characters of one hexadecimal digit each; beginnings of parts of an address, and of characters in percent-encoding.
CHARACTERS, ESCAPE, FIRST_WORD = "0123456789,._-!", "f", 128
WORDS = [
    "&path=route", "&path=turn", "&door=village", "&door=contest", "&route=", "&things=", "&yard=", "&walk=", "&raw=",
    "&start=", "&origin=", "&grid=", "&corner=", "&begin=", "&limit=", "&benches=", "&bench=", "&dragon=", "&dances=",
    "&pitch=", "&start_turns=", "&turning_diameter=", "&ratio=", "&entry_radius=", "&exit_radius=", "&head_length=",
    "&body_length=", "&width=", "&overhang=", "&head_speed=", "&margin=", "&speed_limit=", "&stray=", "&hole=",
    "&pin=", "&csv=", "&passages=", "&beats=", "&start_clock=", "&begin_clock=", "&door=", "&path=", "_*", "~o.",
    "~g.", "~s.", "..", ".!", "0!", "!benches:", "!pitch:", "!start_turns:", "!rotation:", "!delay:", "!path:",
    "name:", "00", "50", "%20", "%E3%8", "%E4%B", "%E5%", "%E6%", "%E7%", "%E8%", "%E9%", "%8", "%9", "%A", "%B", "%",
]  # fmt: skip
# Names that only the page has, so that an address with one of them is that of a dance.
DANCES = {"route", "walk", "raw", "dances"}
NAMES = {word[1:].partition("=")[0] for word in WORDS if word.startswith("&")}
PIECE = re.compile("|".join(map(re.escape, sorted(WORDS, key=len, reverse=True))) + "|.")


def address_of_bench(address: str, bench: int, dragon: int | None) -> str:
    """The address of the page that opens the card of a bench. address: of the page that shows the dance

    >>> address_of_bench("https://dragon.example/?benches=5&bench=2&time=3", 4, None)
    'https://dragon.example/?benches=5&bench=4'
    """
    parts = urlsplit(address)
    query = [one for one in parts.query.split("&") if one and one.partition("=")[0] not in VIEWED]
    query += ([f"dragon={dragon}"] if dragon else []) + [f"bench={bench}"]
    return urlunsplit(parts._replace(query="&".join(query), fragment=""))


def short_form(address: str) -> str:
    """The same address for a code: as it is, unless it is that of a drawn dance, or of several, on the page.

    The language stays readable, because the service answers in it.

    >>> short_form("https://dragon.example/?lang=zh&path=route&route=0,0_9,5")
    'https://dragon.example/?lang=zh&z=8867528002554277'
    """
    parts = urlsplit(address)
    query = [one for one in parts.query.split("&") if one]
    names = {one.partition("=")[0] for one in query}
    if not names & DANCES or not names <= {*NAMES, "lang"}:
        return address
    language = [one for one in query if one.startswith("lang=")]
    text = "".join(f"&{one}" for one in query if one not in language)
    number = int("1" + "".join(map(_digits, PIECE.findall(text))), 16)
    return urlunsplit(parts._replace(query="&".join([*language, f"z={number}"]), fragment=""))


def _digits(piece: str) -> str:
    if piece in CHARACTERS:
        return f"{CHARACTERS.index(piece):x}"
    code = FIRST_WORD + WORDS.index(piece) if piece in WORDS else ord(piece)
    return f"{ESCAPE}{code:02x}"
