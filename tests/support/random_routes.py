"""Routes of random pieces, each of which joins the one before it smoothly, and the dragon that follows them."""

import cmath
import math

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from scipy.optimize import brentq

from core import Arc, Clothoid, Coil, Dragon, Line, Route, Waypoints

DRAGON = Dragon(benches=16, head_length=1.8, body_length=1.4, width=0.3, overhang=0.2)


class Pen:
    """Draws pieces one after the other from a place in a direction, so that every joint is smooth."""

    def __init__(self, place=0j, heading=0.0):
        self.place = place
        self.heading = heading
        self.pieces = []

    def line(self, length):
        end = self.place + length * cmath.rect(1.0, self.heading)
        self.pieces.append(Line((self.place.real, self.place.imag), (end.real, end.imag)))
        self.place = end

    def arc(self, radius, sweep):
        angle = self.heading - math.copysign(0.5 * math.pi, sweep)
        centre = self.place - cmath.rect(radius, angle)
        self.pieces.append(Arc((centre.real, centre.imag), radius, angle, sweep))
        self.place, self.heading = centre + cmath.rect(radius, angle + sweep), self.heading + sweep

    def coil(self, pitch, start, end):
        growth = pitch / (2.0 * math.pi)
        sign = 1.0 if end > start else -1.0
        theta = 2.0 * math.pi * start
        last = 2.0 * math.pi * end
        rotation = self.heading - cmath.phase(sign * complex(1.0, theta)) - theta
        centre = self.place - cmath.rect(growth * theta, theta + rotation)
        self.pieces.append(Coil(pitch, start, end, (centre.real, centre.imag), rotation))
        self.place = centre + cmath.rect(growth * last, last + rotation)
        self.heading = cmath.phase(sign * complex(1.0, last)) + last + rotation

    def clothoid(self, first, last, length):
        self.pieces.append(Clothoid((self.place.real, self.place.imag), self.heading, first, last, length))
        self.place, self.heading = complex(*self.pieces[-1].end), self.pieces[-1].end_heading

    def waypoints(self, legs):
        points = [self.place]
        place = self.place
        heading = self.heading
        for length, swerve in legs:
            heading += swerve
            place += cmath.rect(length, heading)
            points.append(place)
        self.pieces.append(Waypoints(tuple((p.real, p.imag) for p in points), self.heading, heading))
        self.place = place
        self.heading = heading


lengths = st.floats(0.3, 3.0)
radii = st.floats(0.9, 3.0)
sweeps = st.floats(0.2, 5.5).flatmap(lambda angle: st.sampled_from([angle, -angle]))
coils = st.tuples(st.floats(0.9, 2.0), st.floats(2.0, 3.5), st.floats(2.0, 3.5)).filter(
    lambda c: abs(c[2] - c[1]) > 0.1
)
legs = st.lists(st.tuples(st.floats(2.5, 5.0), st.floats(-0.5, 0.5)), min_size=2, max_size=4)
strokes = st.one_of(
    st.tuples(st.just("line"), lengths.map(lambda x: (x,))),
    st.tuples(st.just("arc"), st.tuples(radii, sweeps)),
    st.tuples(st.just("coil"), coils),
    st.tuples(st.just("waypoints"), legs.map(lambda x: (x,))),
)


@st.composite
def routes(draw):
    """Three to seven smooth pieces of any kind behind a line as long as the dragon; they may cross themselves."""
    pen = Pen(complex(draw(st.floats(-20, 20)), draw(st.floats(-20, 20))), draw(st.floats(-3.0, 3.0)))
    pen.line(1.01 * float(DRAGON.chords.sum()))
    for kind, values in draw(st.lists(strokes, min_size=3, max_size=7)):
        getattr(pen, kind)(*values)
    route = Route(pen.pieces)
    assume(0.5 * route.sharpest[0] * DRAGON.chords.max() < 0.9)
    return route


def first_behind(route, s, chord):
    """The first place behind s at the chord's distance, by a dense scan and brentq."""

    def beyond(back):
        return np.hypot(*(route.position(s - back) - route.position(s)).T) - chord

    backs = np.linspace(0.0, 2.0 * chord, 2_001)
    k = int(np.argmax(beyond(backs) >= 0.0))
    assert k > 0
    return s - brentq(beyond, backs[k - 1], backs[k], xtol=1e-14)
