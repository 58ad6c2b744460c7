"""Routes of lines, arcs and coils, on which dances are proven."""

import math

from core import Arc, Coil, Line, Route

LOOP = Route(
    [
        Line((-90.0, 0.0), (0.0, 0.0)),
        Arc((0.0, 5.0), 5.0, -math.pi / 2, 1.5 * math.pi),
        Line((-5.0, 5.0), (-5.0, -20.0)),
    ]
)
HAIRPIN = Route(
    [Line((0.0, 0.0), (40.0, 0.0)), Arc((40.0, 1.5), 1.5, -math.pi / 2, math.pi), Line((40.0, 3.0), (0.0, 3.0))]
)
OUTWARDS = Route([Coil(0.9, 3.0, 9.0)])
TURNED = Route([Coil(0.7, 9.0, 3.5, centre=(2.0, -1.0), rotation=0.4)], start=10.0)
