"""Designs: any of them from its index alone."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

from app.sweeps.designs import designs, sample_points
from app.sweeps.spec import Range, Samples, Spec

GRID = {"pitch": [0.5, 0.6, 0.7], "width": {"start": 0.2, "stop": 0.4, "count": 3}, "benches": [5, 6]}
SAMPLED = {"pitch": {"start": 0.4, "stop": 0.6}, "benches": [5, 6], "width": {"start": 0.1, "stop": 1, "scale": "log"}}


def spec_of(over: dict[str, Any], **more: Any) -> Spec:
    return Spec.of({"question": "collision_time", "over": over, **more})


SPECS = {
    "grid": spec_of(GRID),
    "sobol": spec_of(SAMPLED, samples={"count": 50}),
    "philox": spec_of(SAMPLED, samples={"count": 50, "sequence": "philox", "seed": 3}),
}


def test_a_grid_is_the_product_of_its_lists_the_last_fastest() -> None:
    result = designs(SPECS["grid"], 0, 18)
    product = itertools.product([0.5, 0.6, 0.7], [0.2, 0.3, 0.4], [5, 6])
    assert list(zip(*result.values(), strict=True)) == list(product)


@pytest.mark.parametrize("kind", SPECS)
def test_each_design_is_the_same_alone_and_among_others(kind: str) -> None:
    spec = SPECS[kind]
    every = designs(spec, 0, spec.designs)
    alone = [designs(spec, k, k + 1) for k in range(spec.designs)]
    assert {name: [one[name][0] for one in alone] for name in every} == every
    assert len(set(zip(*every.values(), strict=True))) == spec.designs


@pytest.mark.parametrize(("dimensions", "count"), [(1, 256), (2, 1024), (7, 64), (40, 16)])
def test_sobol_points_are_those_of_scipy(dimensions: int, count: int) -> None:
    theirs = qmc.Sobol(dimensions, scramble=False, bits=30).random(count)
    ours = sample_points(Samples(count=count), dimensions, np.arange(count))
    assert np.array_equal(ours, theirs)


def test_a_far_sobol_point_is_that_of_scipy() -> None:
    far = 2**22 + 12_345
    sequence = qmc.Sobol(3, scramble=False, bits=30)
    sequence.fast_forward(far)
    assert np.array_equal(sample_points(Samples(count=10**7), 3, np.array([far])), sequence.random(1))


def test_philox_points_lie_evenly_and_depend_on_the_seed() -> None:
    points = sample_points(Samples(count=40_000, sequence="philox"), 5, np.arange(40_000))
    other = sample_points(Samples(count=40_000, sequence="philox", seed=1), 5, np.arange(40_000))
    # The mean of 40,000 even numbers has a deviation of 0.0014, a correlation one of 0.005.
    assert np.abs(points.mean(axis=0) - 0.5).max() < 0.008
    assert np.abs(np.corrcoef(points.T) - np.eye(5)).max() < 0.03
    assert 0.0 <= points.min() < 1e-3 < 0.999 < points.max() < 1.0
    assert not (points == other).any()


def test_the_last_of_a_hundred_million_designs_needs_no_other() -> None:
    spec = spec_of({"pitch": {"start": 0.4, "stop": 0.6, "count": 10**8}})
    assert designs(spec, 10**8 - 1, 10**8) == {"pitch": [0.6]}


def test_both_ends_of_a_range_are_exact_and_logarithms_are_even() -> None:
    for scale in ("linear", "log"):
        grid = Range(start=0.1, stop=0.7, count=4, scale=scale).grid()
        assert (grid[0], grid[-1]) == (0.1, 0.7)
    ratios = np.diff(np.log(grid))
    assert np.ptp(ratios) < 1e-12


def test_even_values_are_written_as_a_person_would() -> None:
    assert [str(value) for value in Range(start=0.4, stop=0.5, count=11).grid()[1:4]] == ["0.41", "0.42", "0.43"]
    assert Range(start=-2.0, stop=1.0, count=4).grid() == [-2.0, -1.0, 0.0, 1.0]
    near = Range(start=0.5, stop=0.5 + 1e-13, count=3).grid()
    assert near == sorted(set(near))
    assert Range(start=0.5, stop=0.5, count=3).grid() == [0.5, 0.5, 0.5]
    assert Range(start=1.0, stop=2.0, count=4).grid() == pytest.approx([1.0, 4.0 / 3.0, 5.0 / 3.0, 2.0], abs=1e-10)
