"""The campaign of hunt_contacts.py on lines with corners: `python -m tests.campaigns.hunt_corners SEED SECONDS`.

The lines bend back towards themselves, or zigzag, at corners of up to 84 degrees. Besides, all handles are compared.
"""

from functools import partial

import numpy as np

from core import Legs, highest_speed, trajectory
from tests.campaigns import hunt_contacts, hunting
from tests.support.slow_route import SlowLines

# Accuracy of places [m], and of speeds from differences of them over SHORT [m/s] at 1 m/s.
PLACE = 1e-9
SPEED = 1e-3
SHORT = 1e-7
# Instants at which handles are compared [1].
INSTANTS = 200


def cornered_route(rng, dragon):
    """A line, two to seven corners, and a line, the outer ones as long as the dragon."""
    chord = float(dragon.chords.max())
    way = float(sum(dragon.chords) + rng.uniform(1.0, 6.0) * chord)
    corners = int(rng.integers(2, 8))
    side = float(rng.choice([-1.0, 1.0]))
    sides = np.where(rng.uniform(size=corners) < 0.2, -side, side)
    headings = np.cumsum([0.0, *(sides * rng.uniform(0.2, 1.46, corners))])
    lengths = [way, *(chord * 10.0 ** rng.uniform(-0.7, 0.6, corners - 1)), way]
    points = np.cumsum([-way, *(lengths * np.exp(1j * headings))])
    # s = 0 before, between and beyond the corners.
    start = float(rng.choice([way - 1.0, way, way + sum(lengths[1:-1]) * rng.uniform(), sum(lengths[:-1]) + 1.0]))
    return Legs([(point.real, point.imag) for point in points], range(corners + 1), radius=0.0, start=start)


def handles_fault(dance, slow):
    """What is wrong with the handles of a dance, and with its highest speed."""
    times = np.linspace(dance.earliest, dance.end.time, INSTANTS)
    travels = np.array([dance.clock.travel(time) for time in times])
    wrong = np.abs(trajectory(dance, times).position - slow.handles(travels)).max()
    if wrong > PLACE:
        return f"a handle is {wrong} m away"
    before, after = (slow.handles(np.clip(travels + shift, travels[0], travels[-1])) for shift in (-SHORT, SHORT))
    seen = np.linalg.norm(after - before, axis=-1)[1:-1].max() / (2.0 * SHORT)
    highest = highest_speed(dance.steady)
    if seen > highest.speed_bracket[1] + SPEED:
        return f"{highest!r}, but a handle has {seen} m/s"
    return ""


def judged(dance, margin, start, stop, look):
    """The kind of the answers about a dance, and their fault in words."""
    kind, wrong = hunt_contacts.judged(dance, margin, start, stop, look)
    if not wrong and (fault := handles_fault(dance, SlowLines.of(dance.dragon, dance.path))):
        wrong = f"{fault} in {dance!r}"
    return kind, wrong


def random_case(seed, case):
    """hunt_contacts.random_case() on such lines."""
    return hunt_contacts.random_case(seed, case, cornered_route, SlowLines)


fault = partial(hunting.unless_refused, judged, random_case)
hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "dances on lines with corners")
