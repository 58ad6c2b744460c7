"""The architecture: allowed imports between rooms, and the cost of importing core."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import core

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent

# Arrays whose columns core/kernels/constants.py names.
TABLES = {"table", "pieces", "frame", "chain", "motion", "placed", "probed", "probed_later", "opening"}
OUTSIDE_CORE = {"app", "fastapi", "http", "json", "orjson", "pathlib", "pydantic", "starlette", "time"}
OVERLAP_ENGINES = {"fcl", "shapely"}
# Engines of continuous collision detection, only for comparison.
OTHER_ENGINES = {"Box2D", "ipctk"}
# No function is longer, docstring included, or takes more parameters.
LINES_MOST, PARAMETERS_MOST = 80, 8
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
    entries: set[str] = set()
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Import):
            entries |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.module, f"{module} has a relative import"
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            entries |= {name if name in MODULES else node.module for name in names}
    return entries


def top_names(module: str) -> set[str]:
    return {name.partition(".")[0] for name in imports(module)}


def rooms_drawn() -> list[list[str]]:
    """The rooms of core and app in each line of docs/architecture.md, from the ground up."""
    drawing = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8").split("```")[1]
    lines: list[list[str]] = []
    for line in drawing.splitlines():
        if match := re.match(r"(\w+)/ ", line):
            package = match[1]
            lines.append([package])
        elif match := re.match(r"  ((?:\w+(?:/|\.py)(?:, )?)+)", line):
            rooms = [f"{package}.{re.split(r'[/.]', word)[0]}" for word in match[1].split(", ")]
            lines.append([package if room.endswith("__init__") else room for room in rooms])
    return [rooms for rooms in lines if rooms[0].partition(".")[0] in ("core", "app")]


# A package whose own file has a line of its own stands there.
LINE_OF = {room: number for number, rooms in enumerate(rooms_drawn()) for room in rooms}


def line_of(module: str) -> int:
    """The line of a module's room; -1 for a module without one."""
    package = ".".join(module.split(".")[:2])
    return LINE_OF.get(package, -1)


def test_every_module_has_a_room_and_every_room_is_there() -> None:
    assert [module for module in MODULES if line_of(module) < 0] == []
    rooms = {".".join(module.split(".")[:2]) for module in MODULES} | {"app.page"}
    assert rooms == set(LINE_OF)


def test_imports_point_to_rooms_above() -> None:
    ours = {module: imports(module) & set(MODULES) for module in MODULES}
    assert {(module, one) for module in MODULES for one in ours[module] if line_of(one) > line_of(module)} == set()


def test_no_modules_import_one_another_in_a_circle() -> None:
    # A package stands for its own file, which its modules do not import.
    order = TopologicalSorter({module: imports(module) & set(MODULES) - {module} for module in MODULES})
    order.prepare()  # graphlib.CycleError names the circle


def test_no_scripts_of_the_page_import_one_another_in_a_circle() -> None:
    page = ROOT / "app" / "page"
    pattern = re.compile(r"""(?:from|import|import\() ?"(\.{1,2}/[\w./-]+\.js)\"""")
    scripts = {path: path.read_text(encoding="utf-8") for path in page.rglob("*.js")}
    used = {path: {(path.parent / name).resolve() for name in pattern.findall(text)} for path, text in scripts.items()}
    assert {one for names in used.values() for one in names} <= set(scripts)
    assert sum(map(len, used.values())) > len(scripts)
    TopologicalSorter(used).prepare()


def test_core_knows_no_http_json_files_or_clocks() -> None:
    assert {module: known for module in CORE if (known := top_names(module) & OUTSIDE_CORE)} == {}


def numbered(index: ast.expr) -> bool:
    """True if the last index is a number, or a slice between numbers."""
    entries = [one for one in index.elts if ast.unparse(one) != "None"] if isinstance(index, ast.Tuple) else [None]
    last = entries[-1]
    parts = [last.lower, last.upper] if isinstance(last, ast.Slice) else [last]
    return any(isinstance(part, ast.Constant) and isinstance(part.value, int) for part in parts)


def without_name(index: ast.expr) -> bool:
    """True if the last index is a number; or the first one, unless the last is the name of a column."""
    if not isinstance(index, ast.Tuple):
        return False
    first, last = index.elts[0], index.elts[-1]
    has_column_name = isinstance(last, ast.Name) and last.id.isupper()
    return numbered(index) or (isinstance(first, ast.Constant) and not has_column_name)


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


def test_only_the_engines_import_fcl_and_shapely() -> None:
    assert {name for name in MODULES if top_names(name) & OVERLAP_ENGINES} == {"core.shapes.engines"}


def test_only_one_benchmark_imports_other_engines() -> None:
    paths = [*(ROOT / "benchmarks").rglob("*.py"), *(ROOT / "examples").rglob("*.py"), *MODULES.values()]
    entries = {}
    for path in paths:
        nodes = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Import)]
        entries[module_name(path)] = {alias.name.partition(".")[0] for node in nodes for alias in node.names}
    assert {name for name, imported in entries.items() if imported & OTHER_ENGINES} == {"benchmarks.ccd.engines"}
    assert {name for name, imported in entries.items() if "fcl" in imported} == {
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
    # Importing core.shapes.reach would put the room in place of the function; lazy-loader before 0.6 let it.
    code = "import core, core.course, core.shapes.reach; print(callable(core.course), callable(core.tolerance))"
    assert subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True).split() == ["True", "True"]


def test_proofs_are_reached_from_core_and_loaded_only_then() -> None:
    code = "import core, sys; print('flint' in sys.modules, core.proof.verify.__module__, 'flint' in sys.modules)"
    output = subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True)
    assert output.split() == ["False", "core.proof.certificate", "True"]


def functions(module: str) -> list[ast.FunctionDef | ast.AsyncFunctionDef]:
    return [node for node in ast.walk(tree(module)) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]


def test_functions_are_short_and_take_few_parameters() -> None:
    for module, function in ((name, function) for name in MODULES for function in functions(name)):
        arguments, place = function.args, f"{module}, {function.name}"
        parameters = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]
        assert (function.end_lineno or 0) - function.lineno + 1 <= LINES_MOST, place
        taken = len([name for name in parameters if name and name.arg not in ("self", "cls")])
        assert taken <= PARAMETERS_MOST or module.startswith("app.command"), place  # a command's options
