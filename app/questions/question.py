"""A question as the service, the command and other programs ask it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from app.settings import Settings
from app.wire.models import JSON, Answer, Wire
from core import Budget

# Estimated time of a question without an estimate of its own, which makes it a heavy one [s].
UNKNOWN_COST = 1.0


def unknown_cost(asked: Wire, *form: str) -> float:
    return UNKNOWN_COST


def unheard(share: float) -> None:
    """Progress that nobody follows."""


class FileFormat(StrEnum):
    """Formats of a file, each the ending of an address; their media types are those of `media_types`, in order."""

    @classmethod
    def media_types(cls) -> tuple[str, ...]:
        raise NotImplementedError

    @property
    def media_type(self) -> str:
        return self.media_types()[list(type(self)).index(self)]


@dataclass(frozen=True)
class Terms:
    """Limits of an answer, and the listener to its progress.

    settings: limits of the sizes
    budget: limit of the work, and the flag that ends it
    progress: called with the share of the work that is done, from 0 to 1
    """

    settings: Settings = field(default_factory=Settings)
    budget: Budget = field(default_factory=Budget)
    progress: Callable[[float], None] = unheard


@dataclass(frozen=True)
class Question:
    """One question: its requests and the function that answers it.

    answer: function of a request and the terms, and of a form if there are several; its name is the name of the
        question, and its first line summarises the answer
    model: type of the answer's JSON; None for a picture
    flat, body: the request as parameters of a query, and as a JSON object with a dragon and a path
    forms: media types of the answer; the first is the default
    at: path of its address if that does not follow from its name
    formats: endings of its address, one for each form, if the address names the form of the answer
    cost: estimated time of the answer [s], from a request and a form, before anything is computed
    """

    answer: Callable[..., Any]
    model: type[Answer] | None
    flat: type[Wire] | None = None
    body: type[Wire] | None = None
    forms: tuple[str, ...] = (JSON,)
    cost: Callable[..., float] = unknown_cost
    at: str = ""
    formats: type[FileFormat] | None = None

    @property
    def name(self) -> str:
        return self.answer.__name__

    @property
    def path(self) -> str:
        """Path of its address at the service."""
        if self.at:
            return self.at
        words = self.name.replace("_", "-")
        return f"/{words}" if self.model else f"/figures/{words.removesuffix('-figure')}.{{format}}"

    @property
    def format_in_path(self) -> bool:
        """Whether its address names the form of the answer."""
        return self.formats is not None

    @property
    def summary(self) -> str:
        return (self.answer.__doc__ or "").partition("\n")[0]

    def estimate(self, asked: Wire, form: str) -> float:
        """Estimated time of the answer in one of its forms [s]."""
        return self.cost(asked, *(form,) * (len(self.forms) > 1))

    def told(self, asked: Wire, terms: Terms, form: str) -> bytes | Iterator[bytes]:
        """The answer in one of its forms, whole or in blocks, as the service gives it."""
        found = self.answer(asked, terms, *(form,) * (len(self.forms) > 1))
        return found if isinstance(found, bytes | Iterator) else found.to_json()

    def whole(self, asked: Wire, terms: Terms, form: str) -> bytes:
        """The answer in one of its forms, as `told` gives it, in one piece."""
        found = self.told(asked, terms, form)
        return found if isinstance(found, bytes) else b"".join(found)


@dataclass(frozen=True)
class Call:
    """One way to ask a question at the service: over a query (GET), or over a body (POST).

    name: operation id, the name of the question; with the ending `_of` for a body if a query can ask it too
    asked: type of the request
    """

    name: str
    question: Question
    method: str
    asked: type[Wire]


def calls_of(question: Question) -> list[Call]:
    found = [Call(question.name, question, "GET", question.flat)] if question.flat else []
    if question.body:
        name = f"{question.name}_of" if question.flat else question.name
        found.append(Call(name, question, "POST", question.body))
    return found
