"""Stretches of routes in ball arithmetic: what they enclose, against poses in between and sampled curves."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from flint import acb, arb, ctx

from core.proof.pairs import Benches
from core.proof.paths import chain_on, recorded_path
from core.proof.route import RouteChain
from core.proof.route_stretch import RouteStretch, half_angle
from tests.core.proof.test_route import DOUBLES, ROUTES, SMALL

# Samples of an integral [1], and its error with them [m], [rad].
SAMPLES, SAMPLED = 4001, 1e-5


@pytest.mark.parametrize("name", ROUTES)
@pytest.mark.parametrize("width", [0.1, 1.0])
def test_a_stretch_of_a_route_encloses_every_pose_in_it_and_every_velocity(name: str, width: float) -> None:
    chain = chain_on(SMALL, recorded_path(ROUTES[name]), 0.0)
    assert isinstance(chain, RouteChain)
    start = 0.0 if name == "turn" else 42.0
    with ctx.workprec(128):
        for high in np.arange(-start, -start - 8.0, -1.3):
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


def assert_seen(stretch: RouteStretch, before: Benches, after: Benches, k: int, step: arb) -> None:
    """Bench k as seen from the first one: place, direction and velocity are enclosed."""
    along, velocity = stretch.relative(k)
    place = stretch.between(k, along, velocity)
    (there, turned), (then, _) = before.seen(0, k), after.seen(0, k)
    assert along.overlaps(turned)
    assert place.overlaps(there)
    move = velocity - acb(0, 1) * stretch.placed[0][1] * place
    assert move.overlaps((then - there) / step)


def test_the_angles_of_a_chord_stay_within_those_that_the_curvature_allows() -> None:
    random = np.random.default_rng(7)
    for _ in range(300):
        bends = np.sort(random.uniform(-1.0, 1.0, 2))
        length = random.uniform(0.1, math.pi) / np.abs(bends).max()
        s = np.linspace(0.0, length, SAMPLES)
        curvature = bends[random.integers(0, 2, 6)][np.minimum((s / length * 6).astype(int), 5)]
        turned = np.concatenate([[0.0], np.cumsum((curvature[1:] + curvature[:-1]) / 2 * np.diff(s))])
        steps = np.exp(1j * (turned[1:] + turned[:-1]) / 2) * np.diff(s)
        chord = steps.sum()
        if np.abs(bends).max() * abs(chord) >= 2.0 - SAMPLED:
            continue
        allowed = half_angle(arb(float(bends[0])), arb(float(bends[1])), arb(float(abs(chord))))
        heading = float(np.angle(chord))
        for angle in (turned[-1] - heading, heading):
            assert float(allowed.lower()) - SAMPLED <= angle <= float(allowed.upper()) + SAMPLED


def test_on_a_circle_the_angles_are_exact() -> None:
    angle = half_angle(arb("0.5"), arb("0.5"), arb("1.65"))
    assert angle.contains((arb("0.5") * arb("1.65") / 2).asin())
    assert float(angle.rad()) < DOUBLES
