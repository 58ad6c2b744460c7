"""Every call at about its largest input: stopped, it ends soon, takes little memory and gives it back."""

import gc
import threading
import time
from contextlib import suppress

import psutil
import pytest

from app.files.drawing import in_turn
from app.questions.registry import CALLS
from app.settings import Settings
from app.wire.question import Terms
from core import Budget, TooMuchWork
from tests.support.depth import few
from tests.support.largest import LARGEST

# Time after which a call is stopped [s], and the longest time of the processor until it has ended [s].
STOPPED = 0.5
ENDS_WITHIN = 1.0
GROWS, KEEPS = 200.0, 100.0  # [MB]
# Times that a call is asked: in the first ones modules and caches come, which are kept.
ROUNDS = 3


def test_every_call_has_a_largest_input():
    assert LARGEST.keys() == CALLS.keys()


def asked(name):
    """Time of the processor from the stop to the end [s], and the most memory meanwhile [MB]."""
    question = CALLS[name].question
    budget = Budget()
    stopped = []
    inputs = CALLS[name].request_type.model_validate(LARGEST[name])
    done = threading.Event()
    most = [memory()]

    def stop():
        stopped.append(time.process_time())
        budget.stop()

    def look():
        while not done.wait(0.01):
            most.append(memory())

    watch = threading.Thread(target=look)
    timer = threading.Timer(STOPPED, stop)
    watch.start()
    timer.start()
    try:
        with suppress(TooMuchWork):
            question.to_bytes(inputs, Terms(Settings(), budget), question.forms[0])
    finally:
        late = time.process_time() - stopped[0] if stopped else 0.0
        timer.cancel()
        done.set()
        watch.join()
    in_turn(lambda: None)  # A drawing that has begun goes on.
    gc.collect()
    return late, max(most)


def memory():
    return psutil.Process().memory_info().rss / 1e6


@pytest.mark.parametrize("name", few(list(LARGEST), 8))
def test_a_call_that_is_stopped_ends_soon_and_gives_its_memory_back(name):
    for _ in range(ROUNDS):
        before = memory()
        late, most = asked(name)
        if late < ENDS_WITHIN and most - before < GROWS and memory() - before < KEEPS:
            break
    assert late < ENDS_WITHIN, f"{name} computed for {late:.2f} s after it was stopped"
    assert most - before < GROWS
    assert memory() - before < KEEPS
