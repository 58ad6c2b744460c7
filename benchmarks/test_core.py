"""The rows of the performance table that need no service. Rows of one group are compared with its baseline."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from pytest_benchmark.fixture import BenchmarkFixture

import core
from benchmarks import baselines
from core.values import Floats

ROOT = Path(__file__).parent.parent
DRAGON, SPIRAL = core.Dragon(), core.Spiral()
TIMES = np.arange(301.0)
SAMPLED_TIMES = TIMES[::60]
SAMPLED_LOOKS = np.arange(400.0, 401.0, baselines.STEP)
GROUND_STEP = 0.04  # time between two poses, in which the head goes as far as in a cell of core.envelope() [s]
AGREEMENT = 1e-9  # [m] and [m/s], between the baseline and core


def test_trajectory(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "trajectory"
    result = benchmark(lambda: core.trajectory(core.Dance(DRAGON, SPIRAL), TIMES))
    assert result.position.shape == (301, 224, 2)


def test_trajectory_baseline(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "trajectory"
    benchmark.extra_info["scale"] = TIMES.size / SAMPLED_TIMES.size

    def rows() -> list[tuple[Floats, Floats]]:
        return [baselines.handles_and_velocities(DRAGON, SPIRAL, float(time)) for time in SAMPLED_TIMES]

    position, velocity = map(np.stack, zip(*benchmark.pedantic(rows, rounds=3), strict=True))
    expected = core.trajectory(core.Dance(DRAGON, SPIRAL), SAMPLED_TIMES)
    np.testing.assert_allclose(position, expected.position, rtol=0, atol=AGREEMENT)
    np.testing.assert_allclose(velocity, expected.velocity, rtol=0, atol=AGREEMENT)


# Pitches at which no benches touch before the dragon folds; the bound on the rest is nearest to failing at 0.66 [m].
CLEAR_PITCHES = (0.66, 0.7, 0.8, 1.7)


@pytest.mark.parametrize("benches", [223, 1_000, 10_000, 100_000])
def test_first_contact(benchmark: BenchmarkFixture, benches: int) -> None:
    benchmark.group = "first contact"
    dragon = core.Dragon(benches)
    contact = benchmark(lambda: core.first_contact(core.Dance(dragon, SPIRAL)))
    assert contact.benches == (0, 8)


def test_first_contact_baseline(benchmark: BenchmarkFixture) -> None:
    time = core.first_contact(core.Dance(DRAGON, SPIRAL)).time
    assert time is not None
    benchmark.group = "first contact"
    benchmark.extra_info["scale"] = baselines.looks_for_first_contact(time) / SAMPLED_LOOKS.size
    assert not any(benchmark.pedantic(baselines.looks, (DRAGON, SPIRAL, SAMPLED_LOOKS), rounds=3))
    assert baselines.looks(DRAGON, SPIRAL, np.array([time - 1e-6, time + 1e-6])) == [False, True]


def test_minimum_pitch(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "minimum pitch"
    assert benchmark(core.minimum_pitch, DRAGON).limited_by is core.LimitedBy.GRAZE


@pytest.mark.parametrize("pitch", CLEAR_PITCHES)
def test_first_contact_clear(benchmark: BenchmarkFixture, pitch: float) -> None:
    benchmark.group = "first contact"
    dance = core.Dance(DRAGON, core.Spiral(pitch))
    assert benchmark(core.first_contact, dance).outcome is core.Outcome.CLEAR


@pytest.mark.parametrize("kept", ["margin", "stray"])
def test_first_contact_within(benchmark: BenchmarkFixture, kept: str) -> None:
    benchmark.group = "first contact within 2 cm"
    contact = benchmark(lambda: core.first_contact(core.Dance(DRAGON, SPIRAL), **{kept: 0.02}))
    assert contact.outcome is core.Outcome.CONTACT


@pytest.mark.parametrize("kept", ["margin", "stray"])
def test_minimum_pitch_within(benchmark: BenchmarkFixture, kept: str) -> None:
    benchmark.group = "minimum pitch within 2 cm"
    result = benchmark(lambda: core.minimum_pitch(DRAGON, **{kept: 0.02}))
    assert result.limited_by is core.LimitedBy.GRAZE


def test_minimum_pitch_baseline(benchmark: BenchmarkFixture) -> None:
    pitch = core.minimum_pitch(DRAGON).pitch
    benchmark.group = "minimum pitch"
    benchmark.extra_info["scale"] = baselines.looks_for_minimum_pitch(pitch, 16.0, 4.5) / SAMPLED_LOOKS.size
    path, times = core.Spiral(pitch), SAMPLED_LOOKS - 200.0
    assert not any(benchmark.pedantic(baselines.looks, (DRAGON, path, times), rounds=3))


TWO = [core.Spiral(1.1, 16.0, rotation=turn) for turn in (0.0, np.pi)]
PLACES = [(45.0 * k, 45.0 * row) for row in range(3) for k in range(3)] + [(135.0, 0.0)]
TEN = [core.Spiral(1.1, 14.0, place, 0.7 * k, k % 2 == 1) for k, place in enumerate(PLACES)]
SHORTER = core.Dragon(200)


def performance(dragon: core.Dragon, paths: list[core.Spiral]) -> core.Performance:
    return core.Performance([core.Part(core.Dance(dragon, path)) for path in paths])


def test_first_encounter(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "first encounter"
    assert benchmark(core.first_encounter, performance(DRAGON, TWO)).outcome is core.Outcome.CONTACT


def test_first_encounter_baseline(benchmark: BenchmarkFixture) -> None:
    time = core.first_encounter(performance(DRAGON, TWO)).time
    assert time is not None
    benchmark.group = "first encounter"
    benchmark.extra_info["scale"] = baselines.looks_for_first_contact(time) / SAMPLED_LOOKS.size
    assert not any(benchmark.pedantic(baselines.looks_at_several, (DRAGON, TWO, SAMPLED_LOOKS), rounds=3))
    assert baselines.looks_at_several(DRAGON, TWO, np.array([time - 1e-6, time + 1e-6])) == [False, True]


def test_ten_dragons(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "ten dragons"
    square = performance(SHORTER, TEN)
    assert benchmark(core.first_encounter, square, stop=300.0).outcome is core.Outcome.CLEAR


def test_ten_dragons_baseline(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "ten dragons"
    times = np.array([100.0, 300.0])
    benchmark.extra_info["scale"] = 300.0 / baselines.STEP / times.size
    assert not any(benchmark.pedantic(baselines.looks_at_several, (SHORTER, TEN, times), rounds=3))
    for path, part in zip(TEN, core.trajectory(performance(SHORTER, TEN), times), strict=True):
        plain = np.stack([baselines.handles(SHORTER, path, time) for time in times])
        assert abs(plain - part.position).max() < AGREEMENT


def test_envelope(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "envelope"
    assert benchmark(core.envelope, core.Dance(DRAGON, SPIRAL)).excess < 1e-3


def test_envelope_baseline(benchmark: BenchmarkFixture) -> None:
    dance = core.Dance(DRAGON, SPIRAL)
    whole = core.envelope(dance)
    benchmark.group = "envelope"
    benchmark.extra_info["scale"] = (whole.stop - whole.start) / GROUND_STEP / SAMPLED_LOOKS.size
    times = 400.0 + GROUND_STEP * np.arange(SAMPLED_LOOKS.size)
    swept = benchmark.pedantic(baselines.ground, (DRAGON, SPIRAL, times), rounds=3)
    polygons = core.envelope(dance, start=times[0], stop=times[-1]).polygons
    held = shapely.union_all([shapely.Polygon(rings[0], rings[1:]) for rings in polygons])
    assert held.covers(swept)


@pytest.fixture(scope="module")
def long_dragon() -> tuple[core.Dragon, Floats]:
    """A dragon of 100,000 benches a moment after its first contact, and the places of its handles."""
    dragon = core.Dragon(100_000)
    return dragon, core.trajectory(core.Dance(dragon, SPIRAL), [412.5]).position[0]


def test_overlaps(benchmark: BenchmarkFixture, long_dragon: tuple[core.Dragon, Floats]) -> None:
    dragon, handles = long_dragon
    benchmark.group = "overlaps"
    result = benchmark(core.overlaps, core.bench_poses(handles), dragon.lengths, dragon.widths)
    assert result.pairs.tolist() == [[0, 8]]


def test_overlaps_baseline(benchmark: BenchmarkFixture, long_dragon: tuple[core.Dragon, Floats]) -> None:
    benchmark.group = "overlaps"
    pairs = benchmark.pedantic(lambda: baselines.overlapping_pairs(baselines.polygons(*long_dragon)), rounds=3)
    assert pairs.tolist() == [[0, 8]]


def run_cold(code: str) -> None:
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)


def test_cold_start(benchmark: BenchmarkFixture) -> None:
    benchmark.group = "cold start"
    benchmark.pedantic(
        run_cold, ("import core; core.first_contact(core.Dance(core.Dragon(), core.Spiral()))",), rounds=7
    )


def test_cold_start_baseline(benchmark: BenchmarkFixture) -> None:
    """Imports alone, without any search."""
    benchmark.group = "cold start"
    benchmark.pedantic(run_cold, ("import numpy, scipy.optimize, shapely",), rounds=7)


def test_cold_command(benchmark: BenchmarkFixture) -> None:
    """bench-dragon collision-time, with its check by four engines and its table."""
    benchmark.group = "cold start"
    code = "import sys; sys.argv[1:] = ['collision-time']; from app.command.entry import main; main()"
    benchmark.pedantic(run_cold, (code,), rounds=7)
