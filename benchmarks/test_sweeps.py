"""Cost of a design in a sweep, compared with the bare search."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

import core
from app.sweeps.designs import designs
from app.sweeps.spec import Spec
from tests.support.sweeping import answered

# All included: the request checked, the dance made, the answer, its row, the file; to a loop over the library, which
# makes each dance and searches it [1].
COST_MAX = 1.25
# Largest number of rounds: on a busy machine the first ones may measure other programs.
ROUNDS = 20


def test_a_design_costs_little_more_than_its_search(tmp_path: Path) -> None:
    over = {"pitch": {"start": 0.45, "stop": 0.6, "count": 15}, "width": {"start": 0.25, "stop": 0.35, "count": 10}}
    spec = Spec.of({"question": "collision_time", "over": over, "shard_size": 150})
    values = list(zip(*designs(spec, 0, spec.designs).values(), strict=True))
    bare: list[float] = []
    all_included: list[float] = []
    for _ in range(ROUNDS):
        begun = time.thread_time()
        for pitch, width in values:
            core.first_contact(core.Dance(core.Dragon(width=width), core.Spiral(pitch)))
        bare.append(time.thread_time() - begun)
        answered(tmp_path, spec)
        all_included.append(time.thread_time() - begun - bare[-1])
        # The least of each: other processes only add to a time.
        if len(bare) > 2 and min(all_included) <= COST_MAX * min(bare):
            return
    pytest.fail(f"{min(all_included):.3f} s against {min(bare):.3f} s for the search alone")
