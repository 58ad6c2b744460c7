"""A computation ends at its deadline, and when its client is gone."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import asynccontextmanager
from typing import Any

from fastapi import Request, Response
from fastapi.routing import APIRoute

from app.service.lanes import Lanes
from app.settings import Settings
from core import Budget
from core.language import phrase, say
from core.quantities import Quantity

Handler = Callable[[Request], Coroutine[Any, Any, Response]]


WITHIN = phrase("within {time}, the time that one answer may take here")


class Deadline(Quantity):
    """The longest time of an answer, as the end of an error's sentence."""

    def __str__(self) -> str:
        return WITHIN.format(time=super().__str__())

    def said(self) -> str:
        """The text in the language that is spoken."""
        return say(WITHIN, time=super().__str__())


@asynccontextmanager
async def watched(request: Request, seconds: float) -> AsyncIterator[None]:
    """Context in which the request has a budget, which is stopped after `seconds` and when the client is gone."""
    await request.body()  # After the body, the only message is the end of the connection.
    request.state.budget = Budget()
    task = asyncio.create_task(_watch(request, seconds, request.state.budget))
    try:
        yield
    finally:
        task.cancel()


async def _watch(request: Request, seconds: float, budget: Budget) -> None:
    lanes: Lanes = request.app.state.lanes
    try:
        async with asyncio.timeout(seconds):
            while (await request.receive())["type"] != "http.disconnect":
                pass
    except TimeoutError:
        lanes.stopped.labels("deadline").inc()
        budget.stop(Deadline(seconds, "s", 6))
    else:
        lanes.stopped.labels("client gone").inc()
        budget.stop(phrase("before its client was gone"))


class WatchedRoute(APIRoute):
    """A call whose computation ends at the deadline, and when its client is gone."""

    def get_route_handler(self) -> Handler:
        answer = self.unwatched()

        async def handled(request: Request) -> Response:
            self.refuse_head(request)
            async with watched(request, self.seconds(request.app.state.settings)):
                return await answer(request)

        return handled

    def seconds(self, settings: Settings) -> float:
        """Longest time of the computation [s]."""
        return settings.deadline_seconds

    def refuse_head(self, request: Request) -> None:
        """Refuse a request before its body is read. raises: Refused"""

    def unwatched(self) -> Handler:
        return super().get_route_handler()
