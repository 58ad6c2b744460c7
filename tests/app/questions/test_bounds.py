"""Every call at about its largest input: stopped, it ends soon, takes little memory and gives it back."""

import gc
import threading
import time
from contextlib import suppress

import psutil
import pytest

from app.questions.registry import CALLS
from app.settings import Settings
from app.wire.question import Terms
from core import Budget, TooMuchWork
from tests.support.asking import box, line
from tests.support.depth import few

# Time after which a call is stopped [s], and the longest time of the processor until it has ended [s].
STOPPED, ENDS_WITHIN = 0.5, 1.0
GROWS, KEEPS = 200.0, 100.0  # [MB]; imports are kept
UNEVEN = {"lengths": [2.2 + 0.001 * (k % 97) for k in range(2000)], "widths": [0.3] * 2000, "overhangs": [0.275] * 2000}
COIL = {"kind": "spiral", "pitch": 1.1, "start_turns": 100}
ON_COIL = {"dragon": UNEVEN, "path": COIL, "stray": 0.05}
IN_TURN = {"dragon": UNEVEN, "path": {"kind": "turn"}}
THIN = {"benches": 6308, "head_length": 0.001, "body_length": 0.001, "overhang": 0}
WIDE = {"benches": 2000, "pitch": 10, "start_turns": 200}
WIDE_TURN = WIDE | {"turning_diameter": 200}
CROSSING = {
    "dances": [
        {"dragon": {"benches": 2000}, "path": line((0, 0), (9000, 0))},
        {"dragon": {"benches": 2000}, "path": line((4000, -4500), (4000, 5000))},
    ]
}
PARADES = {
    "dances": [
        {"dragon": {"benches": 50}, "path": line((0, 3 * k), (400, 3 * k + 1)), "delay": 0.5 * k} for k in range(200)
    ]
}
PLACES = [
    {"x": 2.0 * (k % 140), "y": 0.7 * (k // 140), "heading": 0.1, "length": 2.2, "width": 0.3} for k in range(20_000)
]
# A request of each call.
LARGEST = {
    "trajectory": PARADES | {"times": {"start": 0, "stop": 400, "step": 5}},
    "collision_time": THIN,
    "collision_time_of": ON_COIL,
    "encounter": PARADES,
    "safe_delay": CROSSING,
    "minimum_pitch": THIN,
    "pitch_scan": THIN,
    "pitch_scan_of": {"dragon": UNEVEN},
    "minimum_pitch_of": {"dragon": UNEVEN},
    "clearance": WIDE,
    "clearance_of": IN_TURN,
    "turn": {"pitch": 10},
    "turn_of": {"path": {"kind": "turn", "pitch": 10}},
    "shortest_turn": WIDE_TURN,
    "shortest_turn_of": {"dragon": UNEVEN, "pitch": 10, "turning_diameter": 200},
    "turn_time": WIDE_TURN,
    "turn_time_of": IN_TURN,
    "quickest_turn": WIDE_TURN,
    "quickest_turn_of": {"dragon": UNEVEN, "pitch": 10, "turning_diameter": 200},
    "maximum_head_speed": {"head_length": 1.001},
    "maximum_head_speed_of": IN_TURN,
    "check": PARADES,
    "proposals": {"venue": box(-2000, -2000, 2000, 2000), "dragon": {"benches": 2000}},
    "course": ON_COIL,
    "envelope": IN_TURN,
    "tolerance": WIDE,
    "tolerance_of": CROSSING,
    "tolerance_curve": {"head_length": 1.001},
    "tolerance_curve_of": {"dragon": UNEVEN},
    "contact_probability": IN_TURN,
    "overlaps": {"benches": PLACES},
    "paper": {},
    "trajectory_figure": {"benches": 5000},
    "trajectory_figure_of": PARADES,
    "contact_figure": {"benches": 5000},
    "contact_figure_of": CROSSING,
    "encounter_figure": PARADES,
    "pitch_scan_figure": {"head_length": 1.001},
    "pitch_scan_figure_of": {"dragon": UNEVEN},
    "films": {"dragon": {"benches": 500}, "path": COIL, "seconds": 60},
    "maps": IN_TURN,
    "plan": CROSSING,
    "cues": {"dragon": {"benches": 2000}, "path": COIL, "last_bench": 999, "reach": 1000, "stop": 1000},
    "crew": ON_COIL,
    "contest_kit": {},
}


def test_every_call_has_a_largest_input():
    assert LARGEST.keys() == CALLS.keys()


@pytest.mark.parametrize("name", few(list(LARGEST), 8))
def test_a_call_that_is_stopped_ends_soon_and_gives_its_memory_back(name):
    question, budget, stopped = CALLS[name].question, Budget(), []
    inputs = CALLS[name].request_type.model_validate(LARGEST[name])
    process, done = psutil.Process(), threading.Event()

    def memory():
        return process.memory_info().rss / 1e6

    def stop():
        stopped.append(time.process_time())
        budget.stop()

    def look():
        while not done.wait(0.01):
            most.append(memory())

    gc.collect()
    most = [memory()]
    watch, timer = threading.Thread(target=look), threading.Timer(STOPPED, stop)
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
    gc.collect()
    assert late < ENDS_WITHIN, f"{name} computed for {late:.2f} s after it was stopped"
    assert max(most) - most[0] < GROWS
    assert memory() - most[0] < KEEPS
