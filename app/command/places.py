"""The commands bench-dragon places, maps and plan: what a map holds, a dance as a map, and as a PDF to print."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

import orjson
import typer

from app.command import show
from app.command.asked import write_answer
from app.command.options import Json, changed, numbers
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output
from app.maps.choice import PARTLY, Choice
from app.maps.dance_parts import DanceParts
from app.maps.places import Places, drawn_layers, map_data, read_map
from app.maps.tracks import CHORD
from app.questions.maps import QUESTION as MAPS
from app.questions.maps import MapFormat, MapsRequest, OriginFields
from app.questions.plan import PDF_TYPE, PlanRequest
from app.questions.plan import QUESTION as PLAN
from app.questions.safety_sheet import QUESTION as SAFETY_SHEET
from app.questions.safety_sheet import SafetySheetRequest
from app.wire.labels import Table
from app.wire.messages import checked
from app.wire.question import JSON, Coordinates, Terms
from app.wire.refusals import refusing
from core import InvalidValue
from core.errors import Given
from core.language import counted, phrase, say

# Advice for a drawing with more than a venue may have.
PARTLY_BY_OPTIONS = phrase(
    "read only some of its layers with --layers, or an area of it with --area, or draw it with fewer points"
)
# Kinds of paths.
PATHS = {
    "spiral": phrase("spiral"), "turn": phrase("turn"), "route": phrase("route"), "waypoints": phrase("waypoints"),
}  # fmt: skip


def places(
    file: Annotated[
        Path,
        path_argument("FILE", "A map: .geojson, .kml, .kmz, .gpx, .dxf, or a dance as .toml or .json."),
    ],
    units: Annotated[
        str | None,
        typer.Option(metavar="metres|degrees", help="Unit of its coordinates; default: recognised from them."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="Write a .json file for check: the square, its obstacles and the path.")
    ] = None,
    times: Annotated[bool, typer.Option("--times", help="Keep the times of a track as passages in that file.")] = False,
    longest_chord: Annotated[
        float,
        typer.Option(min=1e-3, max=50.0, help="Longest distance of two handles, for which a track is smoothed [m]."),
    ] = CHORD,
    layers: Annotated[
        str | None,
        typer.Option(
            help='Layers of a DXF or GeoJSON to read, with commas between them, as in SITE,"A, B"; default: all.'
        ),
    ] = None,
    area: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,X,Y", help="Read what reaches into this area of a DXF or GeoJSON [m]: least x and y, largest."
        ),
    ] = None,
    only_layers: Annotated[
        bool, typer.Option("--only-layers", help="Name the layers of a DXF or GeoJSON, and their edges.")
    ] = False,
    json: Json = False,
) -> None:
    """The square, its obstacles and the path in a map: GeoJSON, KML, KMZ, GPX or DXF (extra dxf)."""
    if units not in (None, "metres", "degrees"):
        raise InvalidValue.in_words("units", "--units must be metres or degrees", got=Given(units))
    if output:
        checked_output("output", output, (".json",))
    coordinates: dict[str | None, Coordinates | None] = {None: None, "metres": "metres", "degrees": "degrees"}
    if only_layers:
        _print_layers(file, json)
        return
    try:
        parts = read_map(file, coordinates[units], longest_chord, Choice.of(layers, area))
    except InvalidValue as error:
        raise error.because(PARTLY_BY_OPTIONS) if error.reason == PARTLY else error from None
    answer = Places.of(parts)
    if output:
        names = ("path", "venue", "passages") if times else ("path", "venue")
        of_map = {name: part for name in names if (part := getattr(answer, name)) is not None}
        show.write(output, orjson.dumps((answer.dance or {}) | of_map, option=orjson.OPT_INDENT_2) + b"\n")
    if json:
        show.print_json(answer.to_json())
        return
    for note in parts.notes:
        print(note, file=sys.stderr)
    _print(parts)


def _print_layers(file: Path, json: bool) -> None:
    layers = drawn_layers(map_data(file))
    if json:
        show.print_json(Places(path=None, venue=None, dance=None, passages=None, notes=[], layers=layers).to_json())
        return
    table = Table(say("Layers"), say("layer"), say("edges"))
    for layer in layers:
        table.add(layer.name, str(layer.edges))
    show.print_parts(table)


def _print(parts: DanceParts) -> None:
    heads = say("name"), say("what"), "x [m]", "y [m]"
    table = Table(say("What the map holds"), *heads)
    for area in parts.venue.areas if parts.venue else ():
        is_square = parts.venue is not None and area is parts.venue.square
        what = say("square") if is_square else say("obstacle")
        x, y = zip(*area.rings[0], strict=True)
        spans = (say("{low:.3f} to {high:.3f}", low=min(side), high=max(side)) for side in (x, y))
        table.add(area.name, what, *spans)
    if parts.path is not None:
        kind = str(parts.path.get("kind", "spiral"))
        points = parts.path.get("points")
        kind = say(PATHS[kind]) if kind in PATHS else kind
        count = counted(len(points), "{count} point", "{count} points") if points else ""
        table.add(say("path"), say(", ").join(filter(None, (kind, count))), "", "")
    show.print_parts(table)


def maps(
    context: typer.Context,
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon, path and venue as for check, as a .toml or .json file."),
    ],
    output: Annotated[Path, typer.Option(help="Write .geojson, .kml or .dxf (extra dxf).")] = Path("dance.geojson"),
    spacing: Annotated[float | None, typer.Option(help="Distance of the chalk marks along the path [m]")] = None,
    longitude: Annotated[
        float | None, typer.Option(help="Longitude of x = y = 0 [degrees], for a venue in metres")
    ] = None,
    latitude: Annotated[float | None, typer.Option(help="Latitude of x = y = 0 [degrees]")] = None,
) -> None:
    """The square, the path and the chalk marks as a map."""
    ending = checked_output("output", output, tuple(f".{one}" for one in MapFormat))
    if ending == ".dxf":
        require("dxf", "output", "DXF")
    if (longitude is None) != (latitude is None):
        raise InvalidValue.in_words("longitude", "--longitude and --latitude must be given together")
    place = {"longitude": longitude, "latitude": latitude}
    origin = None if longitude is None else checked(OriginFields, place).model_dump()
    request = changed(file, MapsRequest, context, spacing=spacing, origin=origin)
    data = write_answer(MAPS, request, say("map"), output, MapFormat(ending[1:]).media_type)
    if ending == ".geojson" and "origin" not in orjson.loads(data):
        words = say(
            "Its coordinates are metres, not longitude and latitude: --longitude and --latitude of x = y = 0 give "
            "these."
        )
        print(words, file=sys.stderr)


Gates: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(help="NAME,X,Y of a gate whose times the paper names; may be given several times."),
]


def _gate(text: str) -> dict[str, Any]:
    """A gate of an option. raises: InvalidValue"""
    name, *place = text.rsplit(",", 2)
    if len(place) != 2 or not name:
        raise InvalidValue.in_words("gate", "--gate must be NAME,X,Y [m]", got=Given(text))
    return {"name": name, **dict(zip("xy", numbers("gate", ",".join(place), float), strict=True))}


def plan(
    context: typer.Context,
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon, path, venue and limits as for check: .toml or .json."),
    ],
    output: Annotated[Path, typer.Option(help="Write a .pdf file.")] = Path("plan.pdf"),
    paper: Annotated[Literal["A4", "A3"] | None, typer.Option(help="Size of the paper; default: A4.")] = None,
    title: Annotated[str | None, typer.Option(help="Title of the plan")] = None,
    spacing: Annotated[float | None, typer.Option(help="Distance of the chalk marks along the path [m]")] = None,
    gate: Gates = None,
    clear: Annotated[
        float | None, typer.Option(help="Width of the zone to keep clear [m]; default: the margin, or 0.5 m")
    ] = None,
) -> None:
    """A PDF to print, true to scale: map, place of each person, points to paint, times (extra paper)."""
    checked_output("output", output, (".pdf",))
    require("paper", "output", "A plan")
    gates = [_gate(text) for text in gate] if gate else None
    request = changed(file, PlanRequest, context, paper=paper, title=title, spacing=spacing, clear=clear, gates=gates)
    write_answer(PLAN, request, say("plan"), output)


def _lane(text: str) -> dict[str, Any]:
    """A lane of an option. raises: InvalidValue"""
    name, *rest = text.split(",")
    if len(rest) < 5 or len(rest) % 2 == 0 or not name:
        raise InvalidValue.in_words("lane", "--lane must be NAME,WIDTH,X,Y,X,Y,... [m]", got=Given(text))
    width, *places = numbers("lane", ",".join(rest), float)
    return {
        "name": name,
        "width": width,
        "points": [list(pair) for pair in zip(places[::2], places[1::2], strict=True)],
    }


def safety_sheet(
    context: typer.Context,
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon, path, venue and limits as for check: .toml or .json."),
    ],
    output: Annotated[Path, typer.Option(help="Write a .pdf or .json file.")] = Path("safety-sheet.pdf"),
    title: Annotated[str | None, typer.Option(help="Title of the dance")] = None,
    lane: Annotated[
        list[str] | None,
        typer.Option(help="NAME,WIDTH,X,Y,X,Y,... of a lane to keep free and its middle; may be given several times."),
    ] = None,
    gate: Gates = None,
    spectators: Annotated[
        float | None, typer.Option(help="Distance of people from the ground that benches sweep [m]; default: 1")
    ] = None,
    loose: Annotated[int | None, typer.Option(help="Last benches that may be let go; default: 3, or all")] = None,
    reaction: Annotated[
        float | None, typer.Option(help="Time from the call to stop until all stand [s]; default: 2")
    ] = None,
    stopper: Annotated[str | None, typer.Option(help="Who stops the dance")] = None,
    date: Annotated[str | None, typer.Option(help="Date of the sheet; default: a line to fill in")] = None,
    address: Annotated[str | None, typer.Option(help="Address of the dance, which stands there as a QR code")] = None,
    json: Json = False,
) -> None:
    """One page for whoever permits a festival: verdict, nearest approaches, ground and lanes to keep free, stopping."""
    ending = ".json" if json else checked_output("output", output, (".pdf", ".json"))
    if ending == ".pdf":
        require("paper", "output", "A safety sheet")
    gates, lanes = ([read(text) for text in texts] if texts else None for read, texts in ((_gate, gate), (_lane, lane)))
    request = changed(
        file, SafetySheetRequest, context, title=title, gates=gates, lanes=lanes, spectators=spectators, loose=loose,
        reaction=reaction, stopper=stopper, date=date, address=address,
    )  # fmt: skip
    if json:
        with refusing(request), show.waiting(say("safety sheet")) as progress:
            show.print_json(SAFETY_SHEET.to_bytes(request, Terms(progress=progress), JSON))
    else:
        write_answer(SAFETY_SHEET, request, say("safety sheet"), output, PDF_TYPE if ending == ".pdf" else JSON)
