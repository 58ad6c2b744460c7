"""The command bench-dragon places: what a map holds."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import orjson
import typer

from app.command import show
from app.command.options import Json
from app.command.usage import path_argument
from app.files.disk import checked_output
from app.maps.choice import PARTLY, Choice
from app.maps.dance_parts import DanceParts
from app.maps.places import Places, drawn_layers, map_data, read_map
from app.maps.tracks import CHORD
from app.wire.fields import Coordinates
from app.wire.labels import TextTable
from core import InvalidValue
from core.language import counted, phrase, say
from core.quantities import Given

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
    table = TextTable(say("Layers"), say("layer"), say("edges"))
    for layer in layers:
        table.add(layer.name, str(layer.edges))
    show.print_parts(table)


def _print(parts: DanceParts) -> None:
    heads = say("name"), say("what"), "x [m]", "y [m]"
    table = TextTable(say("What the map holds"), *heads)
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
