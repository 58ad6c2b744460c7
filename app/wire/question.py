"""A question as service, command and other programs ask it: its requests, its answer, and how a terminal asks it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Self

from pydantic import (
    BaseModel,
)

from app.settings import Settings
from app.wire.fields import Answer, Wire
from core import Budget
from core.language import Language, speaking, spoken
from core.values import Progress, unheard

JSON = "application/json"
# Any file.
BYTES = "application/octet-stream"
# Estimated time of a question without an estimate of its own, which makes it a heavy one [s].
UNKNOWN_COST = 1.0


class FileFormat(StrEnum):
    """Formats of a file: endings of an address, each with its media type."""

    media_type: str

    def __new__(cls, ending: str, media_type: str = "") -> Self:
        one = str.__new__(cls, ending)
        one._value_, one.media_type = ending, media_type
        return one


@dataclass(frozen=True)
class Terms:
    """Limits of an answer, and the listener to its progress.

    settings: limits of the sizes
    budget: limit of the work, and the flag that ends it
    progress: called with the share of the work that is done, from 0 to 1
    part: called with each part of the answer as soon as it is known, where an answer has such parts
    words: whether the answer is wanted in words too
    """

    settings: Settings = field(default_factory=Settings)
    budget: Budget = field(default_factory=Budget)
    progress: Progress = unheard
    part: Callable[[Answer], None] = unheard
    words: bool = False


@dataclass(frozen=True)
class Output:
    """A file that a command writes.

    help: of the option that names it
    forms: form of the file, by the ending of its name; none: a folder with several
    default: its name without the option; empty: no file
    extras: optional part of the program that it needs, by the ending
    note: what is said beside its name, from the request and the bytes; empty: nothing
    options: further options about this file, which makes it
    """

    help: str
    forms: Mapping[str, str]
    default: str = ""
    extras: Mapping[str, str] = field(default_factory=dict)
    note: Callable[[Any, bytes], str] = lambda request, data: ""
    options: type[Wire] = Wire


@dataclass(frozen=True)
class ListOption:
    """An option that may be given several times, each time with an entry of a list of the request.

    name: of the list
    read: the entry that a text states
    """

    name: str
    help: str
    read: Callable[[str], Any] = str


# Makes a file in a form, or the files of a folder by their names; its further options are arguments.
Writer = Callable[..., bytes | dict[str, bytes]]


@dataclass(frozen=True)
class Command:
    """How a question is asked in a terminal, where fields are options, and a FILE holds the body of a request.

    help: what the command answers
    title: title of the answer, from the request
    parts: what is printed of the answer to a request; its fields by default, each with its label
    options: the request as options, if no query asks the question; by default, what its body has beside a dance
    file: what FILE holds, if that is no dance as for check, or the options are none that describe one
    instead: which strays count in place of those in a FILE, for a question about strays
    lists: options for lists of the request, by their names
    outputs: the files that it writes, by the names of their options
    solve: function of a request and the terms that gives the answer, and for each output what makes the file, if these
        stand beside the printed answer; None: a file is the answer in another form, in place of the printed one
    warning: what a request should not ask, in words; empty: nothing
    """

    help: str
    title: Callable[[Any], str]
    parts: Callable[[Any, Any], Iterable[Any]] | None = None
    options: type[Wire] | None = None
    file: str = ""
    instead: str = ""
    lists: Mapping[str, ListOption] = field(default_factory=dict)
    outputs: Mapping[str, Output] = field(default_factory=dict)
    solve: Callable[[Any, Terms], tuple[Any, Mapping[str, Writer]]] | None = None
    warning: Callable[[Any], str] = lambda request: ""


@dataclass(frozen=True)
class Question:
    """One question: its requests and the function that answers it.

    answer: function of a request and the terms, and of a form if there are several; its name is the name of the
        question, and its first line summarises the answer
    model: type of the answer's JSON; None for a picture
    flat, body: the request as parameters of a query, and as a JSON object with a dragon and a path
    forms: media types of the answer; the first is the default
    at: path of its address if that does not follow from its name
    several: type of the answer's JSON where the request holds the dances of several dragons; None if none may
    formats: endings of its address, one for each form, if the address names the form of the answer
    cost: estimated time of the answer [s], from a request and a form, before anything is computed
    command: how a terminal asks it; None if the command does more than ask it
    """

    answer: Callable[..., Any]
    model: type[Answer] | None
    flat: type[Wire] | None = None
    body: type[Wire] | None = None
    forms: tuple[str, ...] = (JSON,)
    cost: Callable[..., float] = lambda request, *form: UNKNOWN_COST
    at: str = ""
    formats: type[FileFormat] | None = None
    several: type[Answer] | None = None
    command: Command | None = None

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
    def summary(self) -> str:
        return (self.answer.__doc__ or "").partition("\n")[0]

    def estimate(self, request: Wire, form: str) -> float:
        """Estimated time of the answer in one of its forms [s]."""
        return self.cost(request, *self._form_argument(form))

    def encode(self, request: Wire, terms: Terms, form: str) -> bytes | Iterator[bytes]:
        """The answer in one of its forms as bytes, whole or in blocks; its sentences in the language of the request."""
        with speaking(language_for(request)):
            result = self.answer(request, terms, *self._form_argument(form))
            return result if isinstance(result, bytes | Iterator) else result.to_json()

    def to_bytes(self, request: Wire, terms: Terms, form: str) -> bytes:
        """The answer in one of its forms as bytes, in one piece."""
        data = self.encode(request, terms, form)
        return data if isinstance(data, bytes) else b"".join(data)

    def _form_argument(self, form: str) -> tuple[str, ...]:
        """The form as an argument of `answer` and `cost`, which take one only if there are several forms."""
        return (form,) if len(self.forms) > 1 else ()


@dataclass(frozen=True)
class Call:
    """One way to ask a question at the service: over a query (GET), or over a body (POST).

    name: operation id, the name of the question; with the ending `_of` for a body if a query can ask it too
    request_type: model of the request
    """

    name: str
    question: Question
    method: str
    request_type: type[Wire]


def calls_of(question: Question) -> list[Call]:
    calls = [Call(question.name, question, "GET", question.flat)] if question.flat else []
    if question.body:
        name = f"{question.name}_of" if question.flat else question.name
        calls.append(Call(name, question, "POST", question.body))
    return calls


def language_for(inputs: BaseModel) -> Language:
    """The language that a request states; without one, the language that its client accepts."""
    stated = getattr(inputs, "language", None) if "language" in inputs.model_fields_set else None
    return stated or spoken()
