"""A path that crosses itself: a contact of the returning head with the body is found like any other."""

import numpy as np

from core import (
    Dance,
    Dragon,
    Outcome,
    Route,
    Waypoints,
    bench_poses,
    contact_check,
    first_contact,
    overlaps,
    trajectory,
)

# A straight way to the crossing of a figure eight, one of its loops, and on over the crossing [m].
T = np.linspace(0.0, 1.2 * np.pi, 40)
LOOP = np.stack([12.0 * np.sin(T), 6.0 * np.sin(2.0 * T)], axis=-1)
EIGHT = Route([Waypoints(tuple(map(tuple, [*np.linspace([-45.0] * 2, [-1.5] * 2, 16), *LOOP])))])


def test_the_head_of_a_long_dragon_meets_its_body_on_the_crossing():
    dance = Dance(Dragon(30), EIGHT)
    contact = first_contact(dance, start=dance.begin)
    assert (contact.outcome, contact.benches) == (Outcome.CONTACT, (0, 21))
    assert contact.head.radius < 1.0  # the crossing is at the origin
    assert contact_check(contact).agree
    times = [*np.arange(dance.begin, contact.time, 0.25), contact.time - 1e-6, contact.time + 1e-6]
    sizes = dance.dragon.lengths, dance.dragon.widths
    met = [overlaps(poses, *sizes).pairs.tolist() for poses in bench_poses(trajectory(dance, times).position)]
    assert met == [[]] * (len(times) - 1) + [[[0, 21]]]


def test_a_dragon_that_has_left_the_crossing_before_its_head_is_back_meets_nothing():
    dance = Dance(Dragon(15), EIGHT)
    assert first_contact(dance, start=dance.begin).outcome is Outcome.CLEAR
