"""The safety sheet on paper: one page of A4, with a map true to scale.

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
from app.plan.paper import Paper
from app.plan.tables import Json
from core import Budget
from core.language import say

# Size of the map [mm].
MAP = Paper(190.0, 100.0, 0.0, 0.0)
# Where the arrow up stands on it [mm].
ARROW = (177.0, 0.0)


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


def safety_pdf(words: SafetyWords, ground: GroundMap, layers: SafetyLayers, face: Face, budget: Budget) -> bytes:
    """The bytes of the sheet. raises: InvalidValue if the dance is too large for it; Halted at the end of the budget"""
    drawing = draw_safety(ground, layers, scale_in([MAP], *layers.box), face, budget)
    ratio, bar = drawing.scale.ratio, drawing.scale.bar
    own, *others = ({"heading": heading, "lines": list(lines)} for heading, lines in words.lines)
    data: dict[str, Any] = {
        "title": words.title,
        "subtitle": words.subtitle,
        "dated": say("date: {date}", date=words.date or "_" * 16),
        "version": f"Bench Dragon {core.__version__}",
        "verdict": words.verdict,
        "sentences": words.sentences,
        "map": {
            **drawing.to_json(),
            "height": MAP.height,
            "alt": say("Map, 1:{ratio}", ratio=ratio),
            "arrow": ARROW,
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
