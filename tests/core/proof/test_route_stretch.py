"""Stretches of routes in ball arithmetic: what they enclose, against poses in between and sampled curves."""

import itertools

import numpy as np
import pytest
from flint import acb, arb, ctx

from core.proof.paths import chain_on, recorded_path
from core.proof.route import RouteChain
from core.proof.route_stretch import RouteStretch, half_angle
from tests.core.proof.test_route import BENT, DOUBLES, ROUTES, SMALL

SPANS = [(name, width) for name in ROUTES if name not in ("free turn", *BENT) for width in (0.1, 1.0)]


@pytest.mark.parametrize("name, width", [*SPANS, *((name, 0.02) for name in BENT)])
def test_a_stretch_of_a_route_encloses_every_pose_in_it_and_every_velocity(name, width):
    chain = chain_on(SMALL, recorded_path(ROUTES[name]), 0.0)
    assert isinstance(chain, RouteChain)
    start = 0.0 if name == "turn" else 44.995 if name in BENT else 42.0
    with ctx.workprec(128):
        for high in np.arange(-start, -start - 8.0, -0.2 if name in BENT else -1.3):
            stretch = RouteStretch(chain, 0, float(high) - width, float(high), SMALL.benches)
            poses = [chain.pose_at(0, arb(place)) for place in np.linspace(high, high - width, 6)]
            for pose in poses:
                pose.grow_to(9)
            while len(stretch.placed) < 9:
                stretch.grow()
            for before, after in itertools.pairwise(poses):
                step = before.places[0] - after.places[0]
                for k, (velocity, rate) in enumerate(stretch.placed):
                    assert stretch.speeds[k + 1].overlaps((before.places[k + 1] - after.places[k + 1]) / step)
                    # A difference quotient is a velocity somewhere between.
                    assert rate.overlaps((after.along[k] * before.along[k].conjugate()).arg() / step)
                    if k >= 2:
                        assert_seen(stretch, before, after, k, step)
                    middle = (after.centres[k] - before.centres[k]) / step
                    assert (abs(velocity) - abs(middle)).upper() >= 0


def assert_seen(stretch, before, after, k, step):
    """Bench k as seen from the first one: place, direction and velocity are enclosed."""
    along, velocity = stretch.relative(k)
    place = stretch.between(k, along, velocity)
    (there, turned), (then, _) = before.seen(0, k), after.seen(0, k)
    assert along.overlaps(turned)
    assert place.overlaps(there)
    move = velocity - acb(0, 1) * stretch.placed[0][1] * place
    assert move.overlaps((then - there) / step)


def test_on_a_circle_the_angles_are_exact():
    for bend in ("0.5", "-0.5"):
        angle = half_angle(arb(bend), arb(bend), arb("1.65"))
        assert angle.contains((arb(bend) * arb("1.65") / 2).asin())
        assert float(angle.rad()) < DOUBLES
    wide = half_angle(arb("-0.2"), arb("0.5"), arb("1.65"))
    assert wide.contains((arb("0.25") * arb("1.65")).asin())
    assert wide.contains((arb("-0.1") * arb("1.65")).asin())
