"""Calls that take their values from the query, all of them validated at once."""

from __future__ import annotations

import collections
from typing import Annotated, get_type_hints

from fastapi import Depends, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from pydantic import ValidationError

from app.service.deadlines import Handler
from app.service.problems import Refused
from app.service.reply import Reply
from app.wire.problem import ERRORS_MAX


async def reply_query(request: Request) -> Reply:
    """Reply to a call that takes its values from the query. raises: Refused (422) for a name that is given twice"""
    values = request.query_params.multi_items()
    if len(values) > len(request.query_params):
        times = collections.Counter(name for name, _ in values)
        twice = sorted(name for name in times if times[name] > 1)[:ERRORS_MAX]
        raise Refused.names(twice, "is given more than once", "give it once")
    return Reply(request)


class QueryRoute(APIRoute):
    """A call whose query becomes one object; its endpoint takes the reply and this object.

    FastAPI validates the values one by one, which takes 0.3 ms more, a sixth of an answer (2026-11-22).
    """

    def get_route_handler(self) -> Handler:
        model = get_type_hints(self.endpoint)["inputs"]

        async def handled(request: Request) -> Response:
            reply = await reply_query(request)
            try:
                inputs = model.model_validate(dict(request.query_params))
            except ValidationError as error:
                faults = [{**one, "loc": ("query", *one["loc"])} for one in error.errors(include_url=False)]
                raise RequestValidationError(faults) from error
            response: Response = await self.endpoint(reply, inputs)
            return response

        return handled


QueryReply = Annotated[Reply, Depends(reply_query)]
