"""The architecture: allowed imports between rooms, and the cost of importing core."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import core

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent

# The pipeline: a module imports only modules that stand before it. kernels stands first, it knows no other.
ORDER = (
    "core.kernels.constants",
    "core.kernels.records",
    "core.kernels.budget",
    "core.kernels.fold",
    "core.kernels.spiral",
    "core.kernels.double_double",
    "core.kernels.rectangles",
    "core.kernels.hulls",
    "core.kernels.boxes",
    "core.kernels.route",
    "core.kernels.rounding",
    "core.kernels.chain",
    "core.kernels.stretches",
    "core.kernels.bounds",
    "core.kernels.rings",
    "core.kernels.results",
    "core.kernels.scene",
    "core.kernels.clearance",
    "core.kernels.wobble",
    "core.kernels.gap_curvature",
    "core.kernels.faces",
    "core.kernels.pairs",
    "core.kernels.nearest",
    "core.kernels.repeats",
    "core.kernels.marching",
    "core.kernels.band_march",
    "core.kernels.rates",
    "core.kernels.speed",
    "core.kernels.excess",
    "core.kernels",
    "core.values",
    "core.error_free",
    "core.errors",
    "core.names",
    "core.extras",
    "core.shown",
    "core.tables",
    "core.sampling",
    "core.passages",
    "core.dragon",
    "core.paths",
    "core.motion",
    "core.shapes",
    "core.contact",
    "core.design",
    "core.tolerance",
    "core.ground",
    "core.paths.cubics",
    "core.paths.pieces",
    "core.paths.frame",
    "core.paths.path",
    "core.paths.route",
    "core.paths.spiral",
    "core.paths.turn",
    "core.paths.legs",
    "core.paths.following",
    "core.dance",
    "core.course",
    "core.plots",
    "core.shapes.rectangles",
    "core.motion.trajectory",
    "core.shapes.engines",
    "core.shapes.overlaps",
    "core.tolerance.reach",
    "core.contact.coils",
    "core.contact.march",
    "core.contact.search",
    "core.contact.fold",
    "core.contact.clearance",
    "core.contact.decimal_shapes",
    "core.contact.near_graze",
    "core.contact.answer",
    "core.contact.first_contact",
    "core.venue",
    "core.contact.walls",
    "core.design.straight",
    "core.design.pitch_bands",
    "core.design.ways",
    "core.design.minimum_pitch",
    "core.contact.cross_check",
    "core.design.pitch_scan",
    "core.design.turn_circle",
    "core.design.deepest_turn",
    "core.design.spans",
    "core.design.turn_boxes",
    "core.design.turn_moves",
    "core.design.turn_bounds",
    "core.design.turn_overlap",
    "core.design.turn_places",
    "core.design.shortest_turn",
    "core.design.turn_length",
    "core.design.dubins_turn",
    "core.motion.speed",
    "core.design.quickest_turn",
    "core.motion.joints",
    "core.motion.places",
    "core.ground.tracks",
    "core.ground.envelope",
    "core.tolerance.between",
    "core.tolerance.exhibit",
    "core.tolerance.safe",
    "core.tolerance.tolerance",
    "core.tolerance.curve",
    "core.tolerance.uncertain",
    "core.tolerance.wobble",
    "core.tolerance.union_bound",
    "core.tolerance.chance",
    "core.failures",
    "core.judgement",
    "core",
    "core.proof.pairs",
    "core.proof.ground",
    "core.proof.chain",
    "core.proof.fold",
    "core.proof.route",
    "core.proof.route_stretch",
    "core.proof.sweeps",
    "core.proof.words",
    "core.proof.paths",
    "core.proof.claims",
    "core.proof.dances",
    "core.proof.strays",
    "core.proof.members",
    "core.proof.certificate",
    "core.proof",
    "app",
    "app.extras",
    "app.logs",
    "app.settings",
    "app.start",
    "app.wire",
    "app.files",
    "app.jobs",
    "app.service",
    "app.command",
    "app.wire.question",
    "app.wire.texts",
    "app.wire.benches",
    "app.wire.clocks",
    "app.wire.answers",
    "app.wire.paths",
    "app.wire.geojson",
    "app.wire.degrees",
    "app.wire.dances",
    "app.wire.refusals",
    "app.wire.messages",
    "app.wire.problem",
    "app.wire.faults",
    "app.files.memory",
    "app.files.archives",
    "app.files.markup",
    "app.files.outlines",
    "app.files.workbooks",
    "app.files.tables",
    "app.files.words",
    "app.files.drawing",
    "app.files.fonts",
    "app.files.film_spec",
    "app.files.figures",
    "app.files.film",
    "app.maps",
    "app.maps.features",
    "app.maps.curves",
    "app.maps.joined",
    "app.maps.labels",
    "app.maps.entities",
    "app.maps.geojson",
    "app.maps.kml",
    "app.maps.dxf",
    "app.maps.marks",
    "app.maps.lines",
    "app.maps.layout",
    "app.maps.places",
    "app.plan",
    "app.plan.timing",
    "app.plan.sheet",
    "app.plan.ground",
    "app.plan.tables",
    "app.plan.plan",
    "app.files.flush",
    "app.files.disk",
    "app.files.lock",
    "app.grade",
    "app.grade.errors",
    "app.grade.paper",
    "app.grade.words",
    "app.grade.names",
    "app.grade.grid",
    "app.grade.workbook",
    "app.grade.reading",
    "app.grade.labels",
    "app.grade.cells",
    "app.grade.layout",
    "app.grade.lists",
    "app.grade.sheets",
    "app.grade.expected",
    "app.grade.judged",
    "app.grade.chains",
    "app.grade.geometry",
    "app.grade.contacts",
    "app.grade.shortcuts",
    "app.grade.numbers",
    "app.grade.fits",
    "app.grade.outside",
    "app.grade.rings",
    "app.grade.diagnosis",
    "app.grade.rubric",
    "app.grade.report",
    "app.questions",
    "app.questions.trajectory",
    "app.questions.collision_time",
    "app.questions.course",
    "app.questions.minimum_pitch",
    "app.questions.pitch_scan",
    "app.questions.clearance",
    "app.questions.turn",
    "app.questions.shortest_turn",
    "app.questions.maximum_head_speed",
    "app.questions.turn_time",
    "app.questions.quickest_turn",
    "app.questions.check",
    "app.questions.envelope",
    "app.questions.tolerance",
    "app.questions.tolerance_curve",
    "app.questions.contact_probability",
    "app.questions.figures",
    "app.questions.films",
    "app.questions.maps",
    "app.questions.plan",
    "app.questions.overlaps",
    "app.questions.paper",
    "app.questions.registry",
    "app.contest",
    "app.contest.solved",
    "app.contest.answers",
    "app.contest.tables",
    "app.contest.sensitivity",
    "app.contest.figures",
    "app.contest.films",
    "app.contest.report",
    "app.contest.kit",
    "app.sweeps.questions",
    "app.sweeps.columns",
    "app.sweeps.spec",
    "app.sweeps.designs",
    "app.sweeps.shards",
    "app.sweeps.engines",
    "app.sweeps.worker",
    "app.sweeps.processes",
    "app.sweeps.run",
    "app.sweeps.table",
    "app.sweeps.maps",
    "app.sweeps.cluster",
    "app.sweeps.call",
    "app.sweeps",
    "app.jobs.task",
    "app.jobs.job",
    "app.jobs.reserve",
    "app.jobs.store",
    "app.jobs.keeper",
    "app.jobs.runner",
    "app.jobs.reports",
    "app.jobs.sweeping",
    "app.jobs.work",
    "app.jobs.places",
    "app.service.problems",
    "app.service.examples",
    "app.service.version",
    "app.service.token",
    "app.service.middleware",
    "app.service.reply",
    "app.service.pages",
    "app.service.bodies",
    "app.service.protocol",
    "app.service.routes",
    "app.service.graders",
    "app.service.uploads",
    "app.jobs.wire",
    "app.jobs.metrics",
    "app.jobs.routes",
    "app.service.main",
    "app.service.workers",
    "app.command.streams",
    "app.command.usage",
    "app.command.show",
    "app.command.options",
    "app.command.paths",
    "app.command.prove",
    "app.command.trajectory",
    "app.command.envelope",
    "app.command.figures",
    "app.command.contest",
    "app.command.grade",
    "app.command.places",
    "app.command.sweep",
    "app.command.jobs",
    "app.command.contacts",
    "app.command.overlaps",
    "app.command.designs",
    "app.command.strays",
    "app.command.check",
    "app.command.paper",
    "app.command.serve",
    "app.command.main",
    "app.command.entry",
)
# The classes of paths, in core and in requests. A certificate writes a Turn by its own numbers, any other path by kind.
PATHS = {"Spiral", "Route", "Turn", "Legs", "SpiralPath", "TurnPath", "RoutePath", "WaypointsPath"}
# Uses of Path.spiral by room: for a pitch, a centre or a fold, which only a spiral has.
ON_SPIRALS = {
    "core.dance": 1,  # its end: a fold
    "core.contact.search": 3,  # bounds by radius instead of place
    "core.tolerance.curve": 1,  # the time on a circle around the centre
    "core.tolerance.wobble": 1,  # an error of the pitch
    "core.tolerance.chance": 2,
    "core.proof.paths": 3,
    "core.proof.certificate": 2,  # proofs on spirals alone
    "app.files.figures": 1,  # the pitch in a title
    "app.plan.timing": 1,  # radius and angle of a mark
    "app.grade.geometry": 3,  # known errors on a spiral
    "app.grade.outside": 1,  # handles before its beginning
    "app.grade.rings": 1,
    "app.questions.tolerance": 2,  # a circle, and an error of the pitch
    "app.command.trajectory": 1,  # times before the start
}
# Arrays whose columns core/kernels/constants.py names.
TABLES = {"table", "pieces", "frame", "chain", "motion", "placed", "probed", "probed_later", "opening"}
OUTSIDE_CORE = {"app", "fastapi", "http", "json", "orjson", "pathlib", "pydantic", "starlette", "time"}
OVERLAP_ENGINES = {"fcl", "shapely"}
# Engines of continuous collision detection, only for comparison.
OTHER_ENGINES = {"Box2D", "ipctk"}
# No function is longer, docstring included, or takes more parameters; and no room is longer.
LINES_MOST, PARAMETERS_MOST, ROOM_MOST = 80, 8, 500
HEAVY = ("fcl", "flint", "matplotlib", "pandas", "scipy", "shapely", "xarray")


def module_name(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


MODULES = {module_name(path): path for package in ("core", "app") for path in sorted((ROOT / package).rglob("*.py"))}


CORE = [module for module in MODULES if module.startswith("core")]


@cache
def tree(module: str) -> ast.Module:
    return ast.parse(MODULES[module].read_text(encoding="utf-8"))


def imports(module: str) -> set[str]:
    """Every module named by an import statement anywhere in the file, also inside functions."""
    found: set[str] = set()
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.module, f"{module} has a relative import"
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {name if name in MODULES else node.module for name in names}
    return found


def top_names(module: str) -> set[str]:
    return {name.partition(".")[0] for name in imports(module)}


def test_every_module_has_its_place_in_the_pipeline() -> None:
    assert set(MODULES) == set(ORDER)


def test_imports_point_one_way_along_the_pipeline() -> None:
    itself_or_later = {module: set(ORDER[ORDER.index(module) :]) for module in MODULES}
    assert {module: back for module in MODULES if (back := imports(module) & itself_or_later[module])} == {}


def test_core_knows_no_http_json_files_or_clocks() -> None:
    assert {module: known for module in CORE if (known := top_names(module) & OUTSIDE_CORE)} == {}


def numbered(index: ast.expr) -> bool:
    """True if the last index is a number, or a slice between numbers."""
    given = [one for one in index.elts if ast.unparse(one) != "None"] if isinstance(index, ast.Tuple) else [None]
    last = given[-1]
    parts = [last.lower, last.upper] if isinstance(last, ast.Slice) else [last]
    return any(isinstance(part, ast.Constant) and isinstance(part.value, int) for part in parts)


def without_name(index: ast.expr) -> bool:
    """True if the last index is a number; or the first one, unless the last is the name of a column."""
    if not isinstance(index, ast.Tuple):
        return False
    first, last = index.elts[0], index.elts[-1]
    named = isinstance(last, ast.Name) and last.id.isupper()
    return numbered(index) or (isinstance(first, ast.Constant) and not named)


def test_columns_have_names() -> None:
    for module, node in ((name, node) for name in CORE for node in ast.walk(tree(name))):
        if not isinstance(node, ast.Subscript):
            continue
        if module.startswith("core.kernels"):  # whatever the array
            assert not without_name(node.slice), f"{module}, line {node.lineno}"
        elif numbered(node.slice):
            assert names_in(node.value) & TABLES == set(), f"{module}, line {node.lineno}"


def names_in(node: ast.AST) -> set[str]:
    """The names and the last parts of dotted names in a part of a file."""
    nodes = list(ast.walk(node))
    names = {one.id for one in nodes if isinstance(one, ast.Name)}
    return names | {one.attr for one in nodes if isinstance(one, ast.Attribute)}


def asked_for_its_class(module: str) -> list[str]:
    """The tests for the class of a path: isinstance() and match."""
    asked = [
        node.args[1]
        for node in ast.walk(tree(module))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "isinstance"
    ]
    asked += [node.cls for node in ast.walk(tree(module)) if isinstance(node, ast.MatchClass)]
    return sorted(name for one in asked for name in names_in(one) & PATHS)


def test_a_path_is_asked_for_what_it_does_not_for_its_class() -> None:
    asked = {module: found for module in MODULES if (found := asked_for_its_class(module))}
    assert asked == {"core.proof.paths": ["Turn"]}


def test_few_rooms_ask_whether_a_path_is_a_spiral() -> None:
    asked = [
        module
        for module in MODULES
        for node in ast.walk(tree(module))
        if isinstance(node, ast.Attribute) and node.attr == "spiral" and "path" in names_in(node.value)
    ]
    assert Counter(asked) == ON_SPIRALS


def test_only_the_engines_import_fcl_and_shapely() -> None:
    assert {name for name in MODULES if top_names(name) & OVERLAP_ENGINES} == {"core.shapes.engines"}


def test_only_one_benchmark_imports_other_engines() -> None:
    paths = [*(ROOT / "benchmarks").rglob("*.py"), *(ROOT / "examples").rglob("*.py"), *MODULES.values()]
    found = {}
    for path in paths:
        nodes = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Import)]
        found[module_name(path)] = {alias.name.partition(".")[0] for node in nodes for alias in node.names}
    assert {name for name, named in found.items() if named & OTHER_ENGINES} == {"benchmarks.ccd.engines"}
    assert {name for name, named in found.items() if "fcl" in named} == {
        "benchmarks.ccd.engines",
        "core.shapes.engines",
    }


def test_importing_core_loads_nothing_heavy() -> None:
    code = f"import sys; from core import *; print(*(name for name in {HEAVY} if name in sys.modules))"
    loaded = subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True)
    assert loaded.split() == []


def test_public_names_are_sorted_and_exist() -> None:
    assert core.__all__ == sorted(core.__all__)
    assert set(dir(core)) == {*core.__all__, "__version__", "proof"}
    assert all(hasattr(core, name) for name in core.__all__)
    stub = ast.parse((ROOT / "core" / "__init__.pyi").read_text())
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    imported = [name.name for node in imports if node.module for name in node.names]
    listed = [ast.literal_eval(node.value) for node in stub.body if isinstance(node, ast.Assign)]
    assert listed == [sorted(imported)]  # a typed star import knows only a literal list
    assert [name.name for node in imports if not node.module for name in node.names] == ["proof"]


def test_a_question_named_like_its_room_stays_a_question() -> None:
    # Importing core.tolerance.reach would put the room in place of the function; lazy-loader before 0.6 let it.
    code = "import core, core.course, core.tolerance.reach; print(callable(core.course), callable(core.tolerance))"
    assert subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True).split() == ["True", "True"]


def test_proofs_are_reached_from_core_and_loaded_only_then() -> None:
    code = "import core, sys; print('flint' in sys.modules, core.proof.verify.__module__, 'flint' in sys.modules)"
    said = subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True)
    assert said.split() == ["False", "core.proof.certificate", "True"]


def functions(module: str) -> list[ast.FunctionDef | ast.AsyncFunctionDef]:
    return [node for node in ast.walk(tree(module)) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]


def test_functions_are_short_and_take_few_parameters() -> None:
    for module, function in ((name, function) for name in MODULES for function in functions(name)):
        given, place = function.args, f"{module}, {function.name}"
        parameters = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
        assert (function.end_lineno or 0) - function.lineno + 1 <= LINES_MOST, place
        taken = len([name for name in parameters if name and name.arg not in ("self", "cls")])
        assert taken <= PARAMETERS_MOST or module.startswith("app.command"), place  # a command's options


PAGE = [path for kind in ("js", "html", "css") for path in sorted((ROOT / "app" / "page").rglob(f"*.{kind}"))]
ROOMS = sorted(path.relative_to(ROOT).as_posix() for path in (*MODULES.values(), *PAGE))


def test_rooms_are_small() -> None:
    lines = {room: len((ROOT / room).read_text(encoding="utf-8").splitlines()) for room in ROOMS}
    assert {room: count for room, count in lines.items() if count > ROOM_MOST} == {}
