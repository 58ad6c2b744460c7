"""A question as the service, the command and other programs ask it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.wire.models import JSON, Answer, Wire


@dataclass(frozen=True)
class Question:
    """One question: its requests and the function that answers it.

    answer: function of a request and the settings, and of a form if there are several; its name is the name of the
        question, and its first line summarises the answer
    model: type of the answer's JSON; None for a picture
    flat, body: the request as parameters of a query, and as a JSON object with a dragon and a path
    forms: media types of the answer; the first is the default
    """

    answer: Callable[..., Any]
    model: type[Answer] | None
    flat: type[Wire] | None = None
    body: type[Wire] | None = None
    forms: tuple[str, ...] = (JSON,)

    @property
    def name(self) -> str:
        return self.answer.__name__

    @property
    def path(self) -> str:
        """Path of its address at the service."""
        words = self.name.replace("_", "-")
        return f"/{words}" if self.model else f"/figures/{words.removesuffix('-figure')}.{{format}}"

    @property
    def summary(self) -> str:
        return (self.answer.__doc__ or "").partition("\n")[0]
