"""The command bench-dragon envelope: the ground that benches sweep, as a table or a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import Json, asks
from app.extras import require
from app.files.disk import checked_output, ending_of
from app.files.outlines import WRITERS
from app.questions.envelope import (
    Envelope,
    EnvelopeQuery,
    EnvelopeRequest,
    PerformanceEnvelope,
    envelope_of,
    envelopes_of,
)
from app.wire.labels import fields_of
from app.wire.question import Terms
from core.language import say


@asks(EnvelopeQuery, EnvelopeRequest)
def envelope(
    request: EnvelopeQuery | EnvelopeRequest,
    output: Annotated[
        Path | None, typer.Option(help="Write the polygons to a .geojson, .json or .dxf file (extra dxf), in metres.")
    ] = None,
    json: Json = False,
) -> None:
    """The ground that benches sweep: polygons proven to hold every pose and to reach at most 1 mm further.

    Of a FILE of several dragons, the ground of each.
    """
    write = WRITERS[checked_output("output", output, tuple(WRITERS))] if output else None
    if output and ending_of(output) == ".dxf":
        require("dxf", "output", "DXF")
    answer: Envelope | PerformanceEnvelope
    with show.waiting(say("envelope")):
        if isinstance(request, EnvelopeRequest) and request.dances is not None:
            performance, results, grounds = envelopes_of(request, Terms())
            answer = PerformanceEnvelope.together(results, request, performance)
            data = write[1](grounds) if write else b""
        else:
            result = envelope_of(request, Terms())
            answer, data = Envelope.of(result, request), write[0](result) if write else b""
    if output:
        show.write(output, data)
    show.print_result(answer, json, fields_of(say("Ground that benches sweep"), answer, request))
