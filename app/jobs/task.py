"""The task of a job: one call of the service as a value, answered by the same function as a direct call."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, Self

from app.questions.registry import CALLS
from app.settings import Settings
from app.wire.faults import in_body, in_query, refusal_problem
from app.wire.fields import Answer, Wire
from app.wire.problem import Problem
from app.wire.question import UNKNOWN_COST, Call, Terms
from app.wire.refusals import reworded
from core import BenchDragonError, Budget
from core.language import Language, speaking
from core.values import Progress


@dataclass(frozen=True)
class Task:
    """call: operation id; request: valid input of the call, as JSON; form: media type of the answer

    language: of its sentences, where the request does not state one
    """

    call: str
    request: Any
    form: str
    language: str = Language.ENGLISH

    def to_bytes(self) -> bytes:
        return json.dumps(asdict(self)).encode()

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        return cls(**json.loads(data))

    def answer(self, settings: Settings, progress: Progress, part: Callable[[Answer], None]) -> bytes | Problem:
        """The answer of the service to the call. progress, part: as in Terms"""
        call = CALLS[self.call]
        request = call.request_type.model_validate(self.request)
        with speaking(self.language):
            try:
                return call.question.to_bytes(request, Terms(settings, Budget(math.inf), progress, part), self.form)
            except BenchDragonError as error:
                item = in_query if call.method == "GET" else in_body(self.request)
                return refusal_problem(reworded(error, request), item)


def cost_of(call: Call, request: Wire, form: str) -> float:
    """Estimated time of the answer to a call [s], from which the order of jobs follows; a job may find it wrong."""
    try:
        return call.question.estimate(request, form)
    except BenchDragonError:  # Its job will fail with this error.
        return UNKNOWN_COST
