"""Chains in ball arithmetic on a route: what they enclose."""

import numpy as np
import pytest
from flint import arb, ctx

from core import Dance, Dragon, Turn, trajectory
from core.proof.paths import chain_on, recorded_path
from core.proof.route import RouteChain
from tests.support.proof_routes import HAIRPIN, LOOP, OUTWARDS, TURNED, cornered, rounded

# Chains in doubles, as trajectory() has them, are this near to the true ones [m].
DOUBLES = 1e-11
SMALL = Dragon(14)
FREE = Turn(1.7, ratio=1.1, entry_radius=4.3, exit_radius=3.9)
ROUTES = {
    "loop": LOOP,
    "hairpin": HAIRPIN,
    "outwards": OUTWARDS,
    "inwards": TURNED,
    "turn": Turn(1.7),
    "free turn": FREE,
    "tight arc": rounded(45.0, 1.0, 107.0, 20.0),
    "corners": cornered([45.0, 3.1, 0.53, 20.0], [40.0, -30.0, 80.0]),
}
BENT = ("tight arc", "corners")


@pytest.mark.parametrize("name", ROUTES)
def test_the_chain_in_balls_is_the_dance_of_core(name):
    path = ROUTES[name]
    chain = chain_on(SMALL, recorded_path(path), 0.0)
    assert isinstance(chain, RouteChain)
    with ctx.workprec(128):
        for time in np.linspace(30.0, 55.0, 26) - (35.0 if name in ("turn", "free turn") else 0.0):
            pose = chain.pose_at(0, arb(-time))
            pose.grow_to(SMALL.benches)
            there = trajectory(Dance(SMALL, path), [float(time)]).position[0]
            away = np.array([complex(point) for point in pose.points]) - there @ [1.0, 1.0j]
            assert np.abs(away).max() < DOUBLES
            for (piece, t), place in zip(pose.handles, pose.places, strict=True):
                assert abs(float(piece.curvature_at(t)) - float(path.curvature(-float(place)))) < DOUBLES
