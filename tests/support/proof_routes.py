"""Routes of lines, arcs and coils, on which dances are proven."""

import math

import numpy as np

from core import Arc, Coil, Legs, Line, Route

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


def cornered(lengths, degrees):
    """Lines of these lengths [m], with a turn at each corner between them [degrees]."""
    headings = np.radians(np.cumsum([0.0, *degrees]))
    points = np.cumsum([0.0, *(np.array(lengths) * np.exp(1j * headings))])
    return Legs([(point.real, point.imag) for point in points], range(len(lengths)), radius=0.0)


def rounded(before, radius, degrees, after):
    """An arc of a radius [m] and a turn [degrees] between two lines of these lengths [m]."""
    turn = math.radians(degrees)
    end = complex(before + radius * math.sin(turn), radius * (1.0 - math.cos(turn)))
    far = end + after * complex(math.cos(turn), math.sin(turn))
    arc = Arc((before, radius), radius, -0.5 * math.pi, turn)
    return Route([Line((0.0, 0.0), (before, 0.0)), arc, Line((end.real, end.imag), (far.real, far.imag))])
