"""A path that crosses itself: a contact of the returning head with the body is found like any other."""

from __future__ import annotations

import math

import numpy as np

from core import Dance, Dragon, Outcome, Route, Waypoints, contact_check, first_contact, overlaps, trajectory
from core.shapes.rectangles import bench_poses

# A straight way to the crossing of a figure eight, one of its loops, and on over the crossing [m].
STRAIGHT = [(-k, -k) for k in np.linspace(45.0, 1.5, 16).tolist()]
LOOP = [(12.0 * math.sin(t), 6.0 * math.sin(2.0 * t)) for t in np.linspace(0.0, 1.2 * math.pi, 40).tolist()]
EIGHT = Route([Waypoints((*STRAIGHT, *LOOP))])


def test_the_head_of_a_long_dragon_meets_its_body_on_the_crossing() -> None:
    dance = Dance(Dragon(30), EIGHT)
    contact = first_contact(dance, start=dance.begin)
    assert contact.outcome is Outcome.CONTACT
    assert contact.benches == (0, 21)
    assert contact.head is not None
    assert contact.head.radius < 1.0  # the crossing is at the origin
    judged = contact_check(contact)
    assert judged is not None
    assert judged.agree
    assert contact.time is not None
    times = np.append(np.arange(dance.begin, contact.time, 0.25), [contact.time - 1e-6, contact.time + 1e-6])
    sizes = dance.dragon.lengths, dance.dragon.widths
    met = [overlaps(poses, *sizes).pairs.tolist() for poses in bench_poses(trajectory(dance, times).position)]
    assert met == [[]] * (times.size - 1) + [[[0, 21]]]


def test_a_dragon_that_has_left_the_crossing_before_its_head_is_back_meets_nothing() -> None:
    dance = Dance(Dragon(15), EIGHT)
    assert first_contact(dance, start=dance.begin).outcome is Outcome.CLEAR
