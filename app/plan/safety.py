"""The safety sheet on paper: one page with a map true to scale.

The same sheet gives the same bytes on the same fonts and versions of the libraries: its date is the one that is given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import core
from app.files.codes import Code
from app.files.typeset import Face, typeset
from app.plan.drawing import scale_in
from app.plan.ground import GroundMap, SafetyLayers, draw_safety, legend_of_safety
from app.plan.paper import MARGIN, PAPERS, Paper, PaperName
from app.plan.tables import Json
from core import Budget
from core.language import say

# Height of a sheet without its map, and distance of the arrow up from the right side of the map [mm].
BESIDE_MAP, ARROW = 197.0, 13.0


@dataclass(frozen=True, slots=True)
class SafetyWords:
    """The words of a sheet, all but those on its map.

    title, subtitle: of the sheet; verdict: passes, fails or undecided; sentences: two; date: empty for a line to fill
    tables: nearest approaches, and assumptions; lines: heading and sentences of each further part, the ground first
    """

    title: str
    subtitle: str
    verdict: str
    sentences: Sequence[str]
    date: str
    address: str
    approaches: Json
    assumptions: Json
    lines: Sequence[tuple[str, Sequence[str]]]
    paper: PaperName


def safety_pdf(words: SafetyWords, ground: GroundMap, layers: SafetyLayers, face: Face, budget: Budget) -> bytes:
    """The bytes of the sheet. raises: InvalidValue if the dance is too large for it; Halted at the end of the budget"""
    short, long = PAPERS[words.paper]
    room = Paper(short - 2.0 * MARGIN, long - BESIDE_MAP, 0.0, 0.0)
    drawing = draw_safety(ground, layers, scale_in([room], *layers.box, words.paper), face, budget)
    ratio, bar = drawing.scale.ratio, drawing.scale.bar
    own, *others = ({"heading": heading, "lines": list(lines)} for heading, lines in words.lines)
    data: dict[str, Any] = {
        "paper": {"width": short, "height": long},
        "title": words.title,
        "subtitle": words.subtitle,
        "dated": say("date: {date}", date=words.date or "_" * 16),
        "version": f"Bench Dragon {core.__version__}",
        "verdict": words.verdict,
        "sentences": words.sentences,
        "map": {
            **drawing.to_json(),
            "height": room.height,
            "alt": say("Map, 1:{ratio}", ratio=ratio),
            "arrow": (room.width - ARROW, 0.0),
            "geographic": ground.geographic,
        },
        "bar": {"scale": f"1:{ratio}", "marks": [f"{bar:g} m"], "wide": bar * 1000.0 / ratio},
        "legend": legend_of_safety(drawing, ground, layers),
        "approaches": words.approaches,
        "assumptions": words.assumptions,
        "ground": own,
        "parts": others,
        "code": Code.of(words.address, "m").to_json(22.0) if words.address else None,
        "signatures": [say("organiser: name, date, signature"), say("authority: name, date, signature")],
    }
    template = files("app.plan").joinpath("safety.typ").read_bytes()
    return typeset(template, face, data, budget)
