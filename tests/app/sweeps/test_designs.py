"""Designs: any of them from its index alone."""

import itertools

import numpy as np
import pytest

from app.sweeps.designs import designs, sample_points
from app.sweeps.spec import Range, Samples, Spec

GRID = {"pitch": [0.5, 0.6, 0.7], "width": {"start": 0.2, "stop": 0.4, "count": 3}, "benches": [5, 6]}
SAMPLED = {"pitch": {"start": 0.4, "stop": 0.6}, "benches": [5, 6], "width": {"start": 0.1, "stop": 1, "scale": "log"}}


def spec_of(over, **samples):
    return Spec.of({"question": "collision_time", "over": over, "samples": samples or None})


SPECS = {
    "grid": spec_of(GRID),
    "sobol": spec_of(SAMPLED, count=50),
    "philox": spec_of(SAMPLED, count=50, sequence="philox", seed=3),
}


def test_a_grid_is_the_product_of_its_lists_the_last_fastest():
    result = designs(SPECS["grid"], 0, 18)
    assert [*zip(*result.values(), strict=True)] == [*itertools.product([0.5, 0.6, 0.7], [0.2, 0.3, 0.4], [5, 6])]


@pytest.mark.parametrize("kind", SPECS)
def test_each_design_is_the_same_alone_and_among_others(kind):
    spec = SPECS[kind]
    every = designs(spec, 0, spec.designs)
    alone = [designs(spec, k, k + 1) for k in range(spec.designs)]
    assert {name: [design[name][0] for design in alone] for name in every} == every
    assert len(set(zip(*every.values(), strict=True))) == spec.designs


@pytest.mark.parametrize("dimensions, first, count", [(1, 0, 256), (40, 0, 1024), (3, 2**22 + 12_345, 1)])
def test_sobol_points_are_those_of_scipy(dimensions, first, count):
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimensions, scramble=False, bits=30)
    if first:
        sequence.fast_forward(first)
    ours = sample_points(Samples(count=10**7), dimensions, np.arange(first, first + count))
    assert np.array_equal(ours, sequence.random(count))


def test_philox_points_lie_evenly_and_depend_on_the_seed():
    samples = [Samples(count=40_000, sequence="philox", seed=seed) for seed in (0, 1)]
    points, other = (sample_points(each, 5, np.arange(40_000)) for each in samples)
    # The mean of 40,000 even numbers has a deviation of 0.0014, a correlation one of 0.005.
    assert np.abs(points.mean(axis=0) - 0.5).max() < 0.008
    assert np.abs(np.corrcoef(points.T) - np.eye(5)).max() < 0.03
    assert 0.0 <= points.min() < 1e-3 < 0.999 < points.max() < 1.0
    assert not (points == other).any()


def test_the_last_of_a_hundred_million_designs_needs_no_other():
    spec = spec_of({"pitch": {"start": 0.4, "stop": 0.6, "count": 10**8}})
    assert designs(spec, 10**8 - 1, 10**8) == {"pitch": [0.6]}


def grid(start, stop, count, scale="linear"):
    return Range(start=start, stop=stop, count=count, scale=scale).grid()


def test_both_ends_of_a_range_are_exact_and_values_are_even_and_written_as_a_person_would():
    for scale, measure in (("linear", np.array), ("log", np.log)):
        values = grid(0.1, 0.7, 4, scale)
        assert values[0] == 0.1
        assert values[-1] == 0.7
        assert np.ptp(np.diff(measure(values))) < 1e-9
    assert list(map(str, grid(0.4, 0.5, 11)[1:4])) == ["0.41", "0.42", "0.43"]
    near = grid(0.5, 0.5 + 1e-13, 3)
    assert near == sorted(set(near))
    assert grid(0.5, 0.5, 3) == [0.5, 0.5, 0.5]
