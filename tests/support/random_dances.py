"""Random dragons, spirals and dances: strategies of hypothesis, and dances of a seed beside their slow search."""

import numpy as np
from hypothesis import strategies as st

from core import Dance, Dragon, InvalidValue, Spiral
from tests.campaigns.hunt_contacts import random_dragon
from tests.support.slow_search import SlowDance

DRAGONS = st.one_of(
    st.builds(
        Dragon, st.integers(1, 25), st.floats(0.5, 4.0), st.floats(0.5, 4.0), st.floats(0.05, 1.0), st.floats(0, 0.2)
    ),
    st.lists(st.floats(0.3, 3.0), min_size=1, max_size=12).map(
        lambda chords: Dragon.of(chords, [0.2] * len(chords), [0.1] * len(chords))
    ),
)
SPIRALS = st.builds(Spiral, pitch=st.floats(0.2, 3.0), start_turns=st.floats(3.0, 20.0))


def stands(dragon, spiral):
    try:
        return Dance(dragon, spiral).end.time > 1.0
    except InvalidValue:
        return False


DANCES = st.tuples(DRAGONS, SPIRALS).filter(lambda dance: stands(*dance))


def unlike_dance(rng):
    """A few benches of any lengths on a spiral of any pitch."""
    benches = int(rng.integers(1, 8))
    dragon = Dragon.of(10 ** rng.uniform(-0.5, 0.6, benches), [0.1] * benches, [0.05] * benches)
    return Dance(dragon, Spiral(10 ** rng.uniform(-0.5, 0.8), 4.0))


def random_dance(seed):
    """A dance, and the slow one: its dragon stands apart at the start of a spiral short enough for the slow search."""
    rng = np.random.default_rng(seed)
    while True:
        dragon = random_dragon(rng)
        spiral = Spiral(dragon.widths.max() * rng.uniform(1.2, 4.0), rng.uniform(1.0, 6.0))
        try:
            dance = Dance(dragon, spiral)
            way = dance.end.time
        except InvalidValue:
            continue
        slow = SlowDance.of(dragon, spiral)
        if 2.0 < way / dragon.chords.min() < 60.0 and slow.clearance([0.0])[0][0] > 0.0:
            return dance, slow
