"""Contact probability over HTTP and from a terminal: what stands beside core's numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest

import core
from tests.support.asking import Asking
from tests.support.command import run

MODEL = {"lateral": 0.02, "forward": 0.005, "correlation_time": 4.0, "step": 0.5, "hole": 0.055, "pin": 0.05}


def test_quantiles_and_the_pair_are_of_the_first_contacts(ask: Asking) -> None:
    body = {"dragon": {"benches": 20}, **MODEL, "samples": 60, "seed": 3, "start": 395.0, "stop": 405.0}
    got = ask("contact-probability", body)
    dance = core.Dance(core.Dragon(20), core.Spiral())
    result = core.contact_probability(dance, core.Wobble(**MODEL), 60, 3, start=395.0, stop=405.0)
    assert 5 < result.contacts < 60
    assert got["time_quantiles"] == np.quantile(result.time, (0.05, 0.5, 0.95)).tolist()
    pairs = [tuple(pair) for pair in result.benches.tolist()]
    assert tuple(got["benches"]) == max(sorted(set(pairs)), key=pairs.count)


def test_the_command_asks_for_the_way_to_the_circle(ask: Asking) -> None:
    options = "--benches 12 --start-turns 7 --pitch 0.5 --turning-diameter 6 --samples 20 --lateral 0.03 --json"
    got = json.loads(run("contact-probability", *options.split()).stdout)
    assert core.Spiral(0.5, 7.0).head(got["stop"]).radius == pytest.approx(3.0, abs=1e-9)
    spiral = {"kind": "spiral", "pitch": 0.5, "start_turns": 7}
    body = {"dragon": {"benches": 12}, "path": spiral, "lateral": 0.03, "samples": 20}
    assert ask("contact-probability", body | {"stop": got["stop"]}) == got
    assert ask("contact-probability", body | {"turning_diameter": 6}) == got
    assert got["union_bound"] == 1.0


def test_without_a_contact_or_with_a_pitch_error_some_fields_are_null(ask: Asking) -> None:
    still = {"dragon": {"benches": 20}, "lateral": 0, "forward": 0, "samples": 2, "stop": 10}
    clear, other = (ask("contact-probability", still | more) for more in ({}, {"pitch_error": 0.01}))
    assert (clear["contacts"], clear["time_quantiles"], clear["benches"], clear["strayed"]) == (0, None, None, 0)
    assert 0.0 < clear["union_bound"] < 1e-9
    assert other["contacts"] == 0
    assert other["tolerance"] is other["strayed"] is other["union_bound"] is None


def test_the_command_refuses_in_its_own_words() -> None:
    done = run("contact-probability", "--hole", "0.05", "--pin", "0.06")
    assert (done.returncode, done.stderr) == (2, "Error: pin must be no wider than its hole (0.05 m), got 0.06 m\n")
