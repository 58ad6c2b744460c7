"""The safety sheet on paper: one page with a map true to scale.

The same sheet gives the same bytes on the same fonts and versions of the libraries: its date is the one that is given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.resources import files
from typing import Any

import core
from app.files.codes import Code
from app.files.typeset import Face, measured, typeset
from app.plan.drawing import PAD, scale_in
from app.plan.ground import GroundMap, SafetyLayers, draw_safety, legend_of_safety
from app.plan.paper import MARGIN, PAPERS, Paper, PaperName
from app.plan.tables import Json
from core import Budget
from core.language import say

# Least height of the map, height of its legend with the space around it, and distance of the arrow up from the right
# side of the map [mm].
MAP_LEAST, LEGEND, ARROW = 70.0, 16.0, 13.0


@dataclass(frozen=True, slots=True)
class SafetyWords:
    """The words of a sheet, all but those on its map.

    title, subtitle: of the sheet; verdict: passes, fails or undecided; sentences: two; date: empty for a line to fill
    tables: nearest approaches, and assumptions; left, right: heading and sentences of each part below these
    """

    title: str
    subtitle: str
    verdict: str
    sentences: Sequence[str]
    date: str
    address: str
    approaches: Json
    assumptions: Json
    left: Sequence[tuple[str, Sequence[str]]]
    right: Sequence[tuple[str, Sequence[str]]]
    paper: PaperName


def safety_pdf(
    words: SafetyWords, grounds: Sequence[GroundMap], layers: SafetyLayers, face: Face, budget: Budget
) -> bytes:
    """The bytes of the sheet. raises: InvalidValue if the dance is too large for it; Halted at the end of the budget"""
    short, long = PAPERS[words.paper]
    left, right = (
        [{"heading": heading, "lines": list(lines)} for heading, lines in parts] for parts in (words.left, words.right)
    )
    data: dict[str, Any] = {
        "paper": {"width": short, "height": long},
        "title": words.title,
        "subtitle": words.subtitle,
        "dated": say("date: {date}", date=words.date or "_" * 16),
        "version": f"Bench Dragon {core.__version__}",
        "verdict": words.verdict,
        "sentences": words.sentences,
        "map": None,
        "approaches": words.approaches,
        "assumptions": words.assumptions,
        "left": left,
        "right": right,
        "code": Code.of(words.address, "m").to_json(22.0) if words.address else None,
        "signatures": [say("organiser: name, date, signature"), say("authority: name, date, signature")],
    }
    template = files("app.plan").joinpath("safety.typ").read_bytes()
    # The map takes what the words leave of one page.
    rest = long - 2.0 * MARGIN - LEGEND - measured(template, face, data, budget)
    room = Paper(short - 2.0 * MARGIN, max(MAP_LEAST, rest), 0.0, 0.0)
    scale = scale_in([room], *layers.box, words.paper)
    high = float(layers.box[1][1] - layers.box[0][1]) * 1000.0 / scale.ratio + 2.0 * PAD
    room = replace(room, height=min(room.height, max(MAP_LEAST, high)))
    drawing = draw_safety(grounds, layers, replace(scale, paper=room), face, budget)
    ratio, bar = drawing.scale.ratio, drawing.scale.bar
    data["map"] = {
        **drawing.to_json(),
        "height": room.height,
        "alt": say("Map, 1:{ratio}", ratio=ratio),
        "arrow": (room.width - ARROW, 0.0),
        "geographic": grounds[0].geographic,
    }
    data["bar"] = {"scale": f"1:{ratio}", "marks": [f"{bar:g} m"], "wide": bar * 1000.0 / ratio}
    data["legend"] = legend_of_safety(drawing, grounds[0], layers)
    return typeset(template, face, data, budget)
