"""Threads that ask at the same time get the answers that each would get alone, also without Python's global lock."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np

from core import (
    Dance,
    Dragon,
    Part,
    Performance,
    Spiral,
    Turn,
    first_contact,
    first_encounter,
    minimum_pitch,
    tolerance,
    trajectory,
)
from tests.support.every_digit import every_digit

THREADS = 8


def answers(shared, number):
    """Every digit of answers from each family of loops, of one dance that all threads share and of the thread's own."""
    own = Dance(Dragon(60 + number), Spiral(0.5 + 0.01 * number, 8))
    turn = Dance(Dragon(20 + number), Turn(1.7))
    both = Performance([Part(own, name="own"), Part(Dance(Dragon(40), Spiral(1.1, 8)), 0.5 * number, "other")])
    results = (
        first_contact(shared),
        first_contact(own, stray=0.02),
        minimum_pitch(own.dragon),
        tolerance(shared),
        trajectory(turn, np.linspace(-20.0, 20.0, 41)),
        first_contact(turn, start=-20.0, stop=20.0),
        first_encounter(both),
    )
    return repr([every_digit(result) for result in results])


def test_eight_threads_at_once_get_the_digits_that_each_gets_alone():
    alone = [answers(Dance(Dragon(80), Spiral(0.55, 8)), number) for number in range(THREADS)]
    assert len(set(alone)) == THREADS
    shared = Dance(Dragon(80), Spiral(0.55, 8))
    together = Barrier(THREADS)

    def at_once(number):
        together.wait()
        return answers(shared, number)

    with ThreadPoolExecutor(THREADS) as pool:
        assert list(pool.map(at_once, range(THREADS))) == alone
