"""The compiled loops against the same file uncompiled: to the last bit, through everything in core that uses them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import core
from core import kernels

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "core" / "kernels.py"
COMPILED = Path(kernels.__file__)

pytestmark = pytest.mark.skipif(COMPILED.suffix == ".py", reason="the kernels run uncompiled")

# A process in which core.kernels is the source file; it prints what each expression gives, one on a line.
UNCOMPILED = """
import importlib.util, sys
import numpy as np
spec = importlib.util.spec_from_file_location("core.kernels", "core/kernels.py")
kernels = importlib.util.module_from_spec(spec)
sys.modules["core.kernels"] = kernels
spec.loader.exec_module(kernels)
assert not kernels.COMPILED
import core
with np.printoptions(floatmode="unique", threshold=sys.maxsize, legacy="1.25"):
    for expression in sys.argv[1:]:
        print(ascii(repr(eval(expression))))
"""

EXPRESSIONS = {
    "trajectory": "core.trajectory(core.Dragon(40), core.Spiral(), [-5.0, 0.0, 300.0, 432.0])",
    "trajectory bench by bench": "core.trajectory(core.Dragon.of([3, 2, 4], [0.3] * 3, [0.2] * 3), core.Spiral(), [9])",
    "trajectory in blocks": "core.trajectory("
    "core.Dragon.of([3, 1, 2, 2, 2, 2, 2, 4, 2], [0.3] * 9, [0.2] * 9), core.Spiral(), np.linspace(-50, 430, 19))",
    "run to the fold": "core.run_end(core.Dragon(), core.Spiral())",
    "run to the centre": "core.run_end(core.Dragon(5), core.Spiral(9.0, 3.0))",
    "separation": "core.separation([[0, 0, 0.1]] * 3, [2, 1], [[1, 1, 2], [3, 1, 2], [2, 0, 0.1]], [2, 0.5])",
    "overlaps": "core.overlaps(core.bench_poses(np.random.default_rng(1).random((30, 2)) * 9), [1.0] * 29, [0.3] * 29)",
    "first contact": "core.first_contact(core.Dragon(30), core.Spiral())",
    "first contact with a margin": "core.first_contact(core.Dragon(30), core.Spiral(), margin=0.05)",
    "route": "core.Route([core.Waypoints(((0, 0), (6, 1), (11, 6), (9, 13), (2, 14)))]).table",
    "places on a route": "core.Route([core.Waypoints(((0, 0), (6, 1), (11, 6), (9, 13)))]).position([21.0, 3.0, 14.0])",
    "trajectory on a turn": "core.trajectory(core.Dragon(20), core.turn(1.7).path, [0.0, 14.0, 30.0])",
    "minimum pitch": "core.minimum_pitch(core.Dragon(20), turning_radius=3.0, start_turns=8.0)",
    "clearance profile": "core.clearance_profile(core.Dragon(30), core.Spiral(), [400.0, 405.0, 410.0])",
}


@pytest.fixture(scope="module")
def uncompiled() -> dict[str, str]:
    command = [sys.executable, "-c", UNCOMPILED, *EXPRESSIONS.values()]
    lines = subprocess.check_output(command, cwd=ROOT, text=True).splitlines()
    return dict(zip(EXPRESSIONS, lines, strict=True))


def test_compiled_file_is_not_older_than_its_source() -> None:
    assert COMPILED.stat().st_mtime >= SOURCE.stat().st_mtime, "run make setup"


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_uncompiled_gives_the_same_to_the_last_bit(name: str, uncompiled: dict[str, str]) -> None:
    with np.printoptions(floatmode="unique", threshold=sys.maxsize, legacy="1.25"):  # np.float64 is written like float
        compiled = repr(eval(EXPRESSIONS[name], {"core": core, "np": np}))
    assert ascii(compiled) == uncompiled[name]
