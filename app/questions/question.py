"""What a question is, whoever asks it: the service, the command, or a program."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.wire.models import JSON, Answer, Wire

# What a question costs that says nothing else: more than a call that answers at once [s].
UNKNOWN_COST = 1.0


def unknown_cost(asked: Wire, *form: str) -> float:
    return UNKNOWN_COST


@dataclass(frozen=True)
class Question:
    """One question: how it is asked, and what answers it.

    answer: function of a request and the settings, and of a form where there are several; its name is that of the
        question, and its first line says what is answered
    model: what the JSON of the answer holds; None for a picture
    flat, body: the request as parameters of a query, and as a JSON object with a dragon and a path
    cost: about how long the answer takes [s], from a request and a form, known before anything is computed
    forms: media types that the answer is given in, the first where nobody asks for one
    """

    answer: Callable[..., Any]
    model: type[Answer] | None
    flat: type[Wire] | None = None
    body: type[Wire] | None = None
    forms: tuple[str, ...] = (JSON,)
    cost: Callable[..., float] = unknown_cost

    @property
    def name(self) -> str:
        return self.answer.__name__

    @property
    def path(self) -> str:
        """Its address at the service."""
        words = self.name.replace("_", "-")
        return f"/{words}" if self.model else f"/figures/{words.removesuffix('-figure')}.{{format}}"

    @property
    def summary(self) -> str:
        return (self.answer.__doc__ or "").partition("\n")[0]
