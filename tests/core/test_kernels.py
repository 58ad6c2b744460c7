"""The compiled loops against the same file uncompiled."""

from __future__ import annotations

import importlib.util
import math
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from core import kernels

SOURCE = Path(__file__).parents[2] / "core" / "kernels.py"
COMPILED = Path(kernels.__file__)

pytestmark = pytest.mark.skipif(COMPILED.suffix == ".py", reason="the kernels run uncompiled")


@pytest.fixture(scope="module")
def uncompiled() -> ModuleType:
    spec = importlib.util.spec_from_file_location("uncompiled_kernels", SOURCE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert not module.COMPILED
    return module


def test_compiled_file_is_not_older_than_its_source() -> None:
    assert COMPILED.stat().st_mtime >= SOURCE.stat().st_mtime, "run make setup"


def test_trajectory_is_the_same_to_the_last_bit(uncompiled: ModuleType) -> None:
    growth = 0.55 / (2 * math.pi)
    thetas = np.linspace(32 * math.pi, 16.0, 7)
    chords = np.r_[2.86, np.full(40, 1.65), 2.0]

    def rows(module: ModuleType) -> list[np.ndarray]:
        shape = (thetas.size, chords.size + 1)
        out = [np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)]
        assert module.spiral_trajectory(growth, thetas, chords, 1.0, *out) == -1
        return out

    for fast, slow in zip(rows(kernels), rows(uncompiled), strict=True):
        np.testing.assert_array_equal(fast, slow)


@pytest.mark.parametrize("chord", [0.5, 3.0, 5.0, 18.845, 32.7, 200.0])
@pytest.mark.parametrize(("name", "first"), [("fold_theta", ()), ("first_root", (20.0,)), ("previous_theta", (9.0,))])
def test_roots_are_the_same_to_the_last_bit(
    uncompiled: ModuleType, name: str, first: tuple[float, ...], chord: float
) -> None:
    assert getattr(kernels, name)(*first, chord**2) == getattr(uncompiled, name)(*first, chord**2)


def test_separations_are_the_same_to_the_last_bit(uncompiled: ModuleType) -> None:
    random = np.random.default_rng(2026)
    pairs = 2_000
    heading = random.uniform(-math.pi, math.pi, (2, pairs))
    middle = random.uniform(-2.0, 2.0, (2, pairs, 2))
    half = random.uniform(0.05, 1.5, (2, pairs, 2))
    a, b = np.concatenate([middle, np.cos(heading)[..., None], np.sin(heading)[..., None], half], axis=-1)
    fast, slow = np.empty((pairs, 8)), np.empty((pairs, 8))
    kernels.pair_separations(a, b, fast)
    uncompiled.pair_separations(a, b, slow)
    np.testing.assert_array_equal(fast, slow)
    assert np.any(fast[:, 0] > 0)
    assert np.any(fast[:, 0] < 0)
