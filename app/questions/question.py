"""A question as the service, the command and other programs ask it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.settings import Settings
from app.wire.models import JSON, Answer, Wire


@dataclass(frozen=True)
class Question:
    """One question: its requests and the function that answers it.

    answer: function of a request and the settings, and of a form if there are several; its name is the name of the
        question, and its first line summarises the answer
    model: type of the answer's JSON; None for a picture
    flat, body: the request as parameters of a query, and as a JSON object with a dragon and a path
    forms: media types of the answer; the first is the default
    tells: the function takes `progress` and calls it with the share of its work that is done, from 0 to 1
    """

    answer: Callable[..., Any]
    model: type[Answer] | None
    flat: type[Wire] | None = None
    body: type[Wire] | None = None
    forms: tuple[str, ...] = (JSON,)
    tells: bool = False

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

    def told(
        self, asked: Wire, settings: Settings, form: str, progress: Callable[[float], None] = lambda share: None
    ) -> bytes:
        """The answer in one of its forms, as the service gives it."""
        forms = (form,) * (len(self.forms) > 1)
        found = self.answer(asked, settings, *forms, **({"progress": progress} if self.tells else {}))
        data: bytes = found if isinstance(found, bytes) else found.to_json()
        return data


@dataclass(frozen=True)
class Call:
    """One way to ask a question at the service: over a query (GET), or over a body (POST).

    name: operation id, as the question is named; over a body, where it can be asked both ways, `collision_time_of`
    asked: what the request becomes
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
