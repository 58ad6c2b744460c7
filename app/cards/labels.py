"""Labels to cut, fifteen on a sheet of A4, thirty on A3: the code of every bench, which opens its card on a phone.

The same labels give the same bytes on the same fonts and versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files

from app.cards.cards import code_of_bench
from app.files.typeset import Face, typeset
from app.plan.paper import PaperName
from core import Budget
from core.language import say


@dataclass(frozen=True, slots=True)
class LabelDeck:
    """The benches of one dragon that get labels.

    title: of the dance, with the name of the dragon if it is one of several; names: of all benches, empty for none
    dragon: its number in a performance, None for the only one
    """

    title: str
    benches: Sequence[int]
    names: Sequence[str]
    dragon: int | None = None


def labels_pdf(
    title: str, address: str, decks: Sequence[LabelDeck], paper: PaperName, face: Face, budget: Budget
) -> bytes:
    """The bytes of the PDF. address: of the page with the dance; raises: Halted once the budget is stopped"""
    labels = [
        [
            {
                "number": str(k),
                "name": (deck.names[k] if deck.names else "") or (say("head") if k == 0 else ""),
                "title": deck.title,
                "code": code_of_bench(address, k, deck.dragon),
            }
            for k in deck.benches
        ]
        for deck in decks
    ]
    scan = say("The code opens the card of this bench on a phone.")
    data = {"title": title, "paper": paper, "scan": scan, "decks": labels}
    return typeset(files("app.cards").joinpath("labels.typ").read_bytes(), face, data, budget)
