"""Strategies of hypothesis: dragons, spirals, and dances that run for more than a second."""

from __future__ import annotations

from hypothesis import strategies as st

from core import Dance, Dragon, InvalidValue, Spiral

DRAGONS = st.one_of(
    st.builds(
        Dragon, st.integers(1, 25), st.floats(0.5, 4.0), st.floats(0.5, 4.0), st.floats(0.05, 1.0), st.floats(0, 0.2)
    ),
    st.lists(st.floats(0.3, 3.0), min_size=1, max_size=12).map(
        lambda chords: Dragon.of(chords, [0.2] * len(chords), [0.1] * len(chords))
    ),
)
SPIRALS = st.builds(Spiral, pitch=st.floats(0.2, 3.0), start_turns=st.floats(3.0, 20.0))


def stands(dragon: Dragon, spiral: Spiral) -> bool:
    try:
        return Dance(dragon, spiral).end.time > 1.0
    except InvalidValue:
        return False


DANCES = st.tuples(DRAGONS, SPIRALS).filter(lambda dance: stands(*dance))
