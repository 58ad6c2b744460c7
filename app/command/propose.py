"""The command bench-dragon propose: dances that fit into a square, as files and pictures."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import orjson
import typer

import core
from app.command import show
from app.command.options import Json
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import object_words
from app.maps.dances import read_dance
from app.questions.proposals import Proposals, ProposalsRequest, answer_of, proposed
from app.wire.labels import Heading, Part, Table, value_word
from app.wire.messages import checked
from app.wire.question import Terms
from app.wire.refusals import refusing
from core.language import say


def propose(
    file: Annotated[
        Path,
        path_argument("FILE", "Venue, dragon, gates and wishes as for POST /proposals, as a .toml or .json file."),
    ],
    output: Annotated[
        Path | None,
        typer.Option(help="Write a file for check and a picture of each dance, and an overview, into this folder."),
    ] = None,
    json: Json = False,
) -> None:
    """Dances that fit into a square, each certified by a check; or the reason why none does. The exit code is 0."""
    if output:
        require("figures", "output", "--output")
        output.mkdir(exist_ok=True)
    held = read_dance(file)
    # A file for check may be asked about too: its path is what is looked for.
    wishes = {name: value for name, value in held.items() if name not in ("path", "head_speed", "start", "stop")}
    request = checked(ProposalsRequest, wishes, object_words(file))
    with refusing(request), show.waiting(say("propose")) as progress:
        result, place = proposed(request, Terms(progress=progress))
    answer = answer_of(request, result, place)
    if output:
        for name, data in _files(result, answer).items():
            show.write(output / name, data)
    show.print_result(answer, json, _parts(answer, request.objective))


def _files(result: core.Proposals, answer: Proposals) -> dict[str, bytes]:
    """A file for check and a picture of each dance, and an overview of several."""
    from app.files.proposals import overview, proposal_picture  # matplotlib takes a second to import

    files = {}
    for k, (one, body) in enumerate(zip(result.proposals, answer.proposals, strict=True), start=1):
        name = f"{k}-{one.figure.value}"
        files[f"{name}.json"] = orjson.dumps(body.dance, option=orjson.OPT_INDENT_2)
        files[f"{name}.png"] = proposal_picture(one)
    return files | ({"overview.png": overview(result.proposals)} if result.proposals else {})


def _parts(answer: Proposals, objective: core.Objective) -> Iterator[Part]:
    yield Heading(answer.summary)
    if not answer.proposals:
        return
    counts = objective is core.Objective.BENCHES
    has_gates = bool(answer.proposals[0].gates)
    table = Table(
        say("Proposals"), say("figure"), *[say("gates")] * has_gates, *[say("benches")] * counts, say("safe stray"),
        say("duration"), say("length"), say("turns"), say("nearest"), say("with stray"), say("highest speed"),
    )  # fmt: skip
    for one in answer.proposals:
        near = f"{one.near.in_place:.3f} m, {one.near.name}"
        speed = "" if one.highest_speed is None else f"{one.highest_speed:.2f} m/s"
        way = [" → ".join(map(str, one.gates))] * has_gates
        row: list[Any] = [value_word(one.figure.value), *way, *[str(_benches(one.dance["dragon"]))] * counts]
        row += [f"{one.tolerance:.3f} m", f"{one.duration:.0f} s", f"{one.length:.0f} m"]
        table.add(*row, f"{one.turns:.1f}", near, f">= {one.near.distance:.3f} m", speed)
    yield table
    if counts and answer.most_benches is not None:
        yield say(
            "By the area of the square, no dragon of this kind has more than {most} benches.", most=answer.most_benches
        )


def _benches(dragon: dict[str, Any]) -> int:
    """Number of the benches of a dragon in a body."""
    return len(dragon["lengths"]) if "lengths" in dragon else int(dragon["benches"])
