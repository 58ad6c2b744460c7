"""An end to every computation: at its deadline, or when its client is gone."""

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

Handler = Callable[[Request], Coroutine[Any, Any, Response]]


class WatchedRoute(APIRoute):
    """A call whose computation ends at the deadline, and when its client is gone."""

    def get_route_handler(self) -> Handler:
        answer = self.unwatched()

        async def handled(request: Request) -> Response:
            await request.body()  # What is received after it is the end of the connection.
            async with watched(request, self.seconds(request.app.state.settings)):
                return await answer(request)

        return handled

    def seconds(self, settings: Settings) -> float:
        """How long the computation may take [s]."""
        return settings.deadline_seconds

    def unwatched(self) -> Handler:
        return super().get_route_handler()


@asynccontextmanager
async def watched(request: Request, seconds: float) -> AsyncIterator[None]:
    """Gives the request a budget, which is stopped after so many seconds and when the client is gone."""
    request.state.budget = Budget()
    task = asyncio.create_task(_watch(request, seconds))
    try:
        yield
    finally:
        task.cancel()


async def _watch(request: Request, seconds: float) -> None:
    lanes: Lanes = request.app.state.lanes
    budget = request.state.budget
    try:
        async with asyncio.timeout(seconds):
            while (await request.receive())["type"] != "http.disconnect":
                pass
    except TimeoutError:
        lanes.stopped.labels("deadline").inc()
        budget.stop(f"within {seconds:g} s, the time that one answer may take here")
    else:
        lanes.stopped.labels("client gone").inc()
        budget.stop("before its client was gone")
