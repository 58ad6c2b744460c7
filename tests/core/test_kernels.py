"""The compiled loops against the same files uncompiled: to the last bit, through the questions of core that use any."""

import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import core
from core import kernels
from tests.conftest import ROOT
from tests.support.depth import further
from tests.support.every_digit import every_digit

SOURCES = ROOT / "core" / "kernels"
# Modules with a .pxd beside them are compiled, except these two: their .pxd follow from them.
NAMES = {"constants", "records"}
COMPILED = sorted({path.stem for path in SOURCES.glob("*.pxd")} & {path.stem for path in SOURCES.glob("*.py")} - NAMES)

needs_compiled = pytest.mark.skipif(not kernels.COMPILED, reason="the kernels run uncompiled")

# A process in which Python finds nothing but source files in core/kernels; it prints what each expression gives, one
# on a line.
UNCOMPILED = """
import importlib.machinery, sys
def sources(folder):
    if not folder.endswith("kernels"):
        raise ImportError
    return importlib.machinery.FileFinder(folder, (importlib.machinery.SourceFileLoader, [".py"]))
sys.path_hooks.insert(0, sources)
import numpy as np
import core
from core import *
modules = [name for name in sys.modules if name.startswith("core.kernels.")]
assert len(modules) > 9 and not core.kernels.COMPILED
assert all(sys.modules[name].__file__.endswith(".py") for name in modules)
from tests.support.every_digit import every_digit
for expression in sys.argv[1:]:
    print(ascii(every_digit(eval(expression))))
"""

EXPRESSIONS = {
    "trajectory": "core.trajectory(Dance(Dragon(40), Spiral()), [-5.0, 0.0, 300.0, 432.0])",
    "trajectory bench by bench": "core.trajectory(Dance(Dragon.of([3, 2, 4], [0.3] * 3, [0.2] * 3), Spiral()), [9])",
    "trajectory in blocks": "core.trajectory("
    "Dance(Dragon.of([3, 1, 2, 2, 2, 2, 2, 4, 2], [0.3] * 9, [0.2] * 9), Spiral()), np.linspace(-50, 430, 19))",
    "run to the fold": "Dance(Dragon(), Spiral()).end",
    "run to the centre": "Dance(Dragon(5), Spiral(9.0, 3.0)).end",
    "separation": "core.separation([[0, 0, 0.1]] * 3, [2, 1], [[1, 1, 2], [3, 1, 2], [2, 0, 0.1]], [2, 0.5])",
    "overlaps": "core.overlaps(core.bench_poses(np.random.default_rng(1).random((30, 2)) * 9), [1.0] * 29, [0.3] * 29)",
    "first contact": "core.first_contact(Dance(Dragon(30), Spiral()))",
    "first contact with a margin": "core.first_contact(Dance(Dragon(30), Spiral()), margin=0.05)",
    "route": "core.Route([core.Waypoints(((0, 0), (6, 1), (11, 6), (9, 13), (2, 14)))]).table",
    "places on a route": "core.Route([core.Waypoints(((0, 0), (6, 1), (11, 6), (9, 13)))]).position([21.0, 3.0, 14.0])",
    "trajectory on a turn": "core.trajectory(Dance(Dragon(20), Turn(1.7)), [0.0, 14.0, 30.0])",
    "long spiral": "core.trajectory(Dance(Dragon(6), Spiral(0.3, 1e4), 1.3), [1e4])",
    "long coil": "core.trajectory(Dance(Dragon(6), core.Route([core.Coil(0.3, 1e4, 9.0, rotation=1.0)]), 1.3), [1e4])",
    "clothoids": "core.trajectory(Dance(Dragon(6), core.Route([core.Line((0, 0), (20, 0)), core.Clothoid((20, 0), 0, "
    "0, 0.6, 9), core.Clothoid(core.Clothoid((20, 0), 0, 0, 0.6, 9).end, 2.7, 0.6, -0.4, 30)])), [20.0, 31.0, 52.0])",
    "corners": "core.check(Dance(Dragon(6), core.Legs([(0, 0), (30, 0), (36, 5), (42, 3)], [0, 1, 2], radius=0)))",
    "first excess": "core.extremes.speed.first_excess(Dance(Dragon(20), Turn(1.7)), 1.5, start=0.0, stop=30.0)",
    "first excess before a fold": "core.extremes.speed.first_excess(Dance(Dragon(4), Spiral(1.2, 3.0)), 3.0)",
    "minimum pitch": "core.minimum_pitch(Dragon(10), turning_radius=2.5, start_turns=5.0)",
    "first contact with a stray": "core.first_contact(Dance(Dragon(30), Spiral()), stray=0.02, start=370.0)",
    "minimum pitch with a stray": "core.minimum_pitch(Dragon(10), turning_radius=2.5, start_turns=5.0, stray=0.02)",
    "contacts by chance": "core.contact_probability("
    "Dance(Dragon(9), Spiral()), Wobble(0.05, 0.02, 4.0, hole=0.06, pin=0.04), 4, 1, start=409.0, stop=413.0)",
    "clearance profile": "core.clearance_profile(Dance(Dragon(30), Spiral()), [400.0, 405.0, 410.0])",
    "least clearance": "core.least_clearance(Dance(Dragon(20), Spiral()), start=405.0, stop=411.0)",
    "edges of a venue": "core.venue_clearance(Dance(Dragon(4), Turn(1.7)), core.Venue(core.Area("
    "'square', (((-9, -9), (9, -9), (9, 9), (-9, 9), (-9, -9)),))), start=0.0, stop=6.0)",
    "edges of a venue before a fold": "core.venue_clearance(Dance(Dragon(3), Spiral(0.8, 3.0)), core.Venue(core.Area("
    "'square', (((-9, -9), (9, -9), (9, 9), (-9, 9), (-9, -9)),)), (core.Area("
    "'post', (((0, -1.9), (0.1, -1.9), (0, -2), (0, -1.9)),)),)), start=16.0)",
    "highest speed": "core.highest_speed(Dance(Dragon(4), Turn(1.7)), start=8.0, stop=14.0)",
    "highest speed before a fold": "core.highest_speed(Dance(Dragon(4), Spiral(1.2, 3.0)), stop=30.7)",
    "envelope": "core.envelope(Dance(Dragon(4), Turn(1.7)), start=6.0, stop=8.0)",
    "tolerance": "core.tolerance(Dance(Dragon(9), Spiral()), start=406.0, stop=410.0)",
    "first encounter": "core.first_encounter(core.Performance([core.Part("
    "Dance(Dragon(9), Spiral(1.1, 3.0, rotation=turn))) for turn in (0.0, 3.0)]), start=9.0)",
    "first encounter with a stray": "core.first_encounter(core.Performance([core.Part(Dance(Dragon(4), core.Route("
    "[core.Line((-x, -y), (x, y))]))) for x, y in ((20, 0), (0, 20))]), margin=0.1, stray=0.02, start=15.0)",
    "first encounter up to a fold": "core.first_encounter(core.Performance([core.Part("
    "Dance(Dragon(3), Spiral(1.2, 2.0, (x, 0.0)))) for x in (0.0, 9.0)]))",
    "shortest turn": "core.shortest_turn(Dragon(4), 1.7)",
    "rectangles of a picture": "(lambda plane: [core.kernels.fill_rectangles(plane, np.array([[9.3, 8.1, 0.8, 0.6, 6, "
    "2]]), 0.4, np.array([[90.0], [7.0]])), plane])(np.full((20, 20, 1), 255, np.uint8))",
    "pitch scan": "core.pitch_scan(Dragon(10), [0.53, 0.55], start_turns=5.0)",
}


# These take most of the time without compiled loops.
SLOW = ("edges of a venue before a fold", "minimum pitch with a stray", "pitch scan", "route", "shortest turn")


@cache
def uncompiled(slow):
    """What a process without compiled loops gives for the slow expressions, or for the others."""
    expressions = {name: one for name, one in EXPRESSIONS.items() if (name in SLOW) is slow}
    command = [sys.executable, "-c", UNCOMPILED, *expressions.values()]
    lines = subprocess.check_output(command, cwd=ROOT, text=True).splitlines()
    return dict(zip(expressions, lines, strict=True))


@needs_compiled
@pytest.mark.parametrize("module", COMPILED)
def test_compiled_file_is_not_older_than_its_source(module):
    compiled = Path(str(sys.modules[f"core.kernels.{module}"].__file__))
    sources = (SOURCES / f"{module}.py", SOURCES / f"{module}.pxd", *(SOURCES / f"{name}.py" for name in NAMES))
    assert compiled.suffix != ".py", "all modules are compiled, or none"
    assert compiled.stat().st_mtime >= max(source.stat().st_mtime for source in sources), "run make setup"


@needs_compiled
@pytest.mark.parametrize("name", further(sorted(EXPRESSIONS, key=SLOW.__contains__), len(EXPRESSIONS) - len(SLOW)))
def test_uncompiled_gives_the_same_to_the_last_bit(name):
    names = {name: getattr(core, name) for name in core.__all__} | {"core": core, "np": np}
    assert ascii(every_digit(eval(EXPRESSIONS[name], names))) == uncompiled(name in SLOW)[name]
