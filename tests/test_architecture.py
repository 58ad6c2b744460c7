"""The architecture: allowed imports between rooms, and the cost of importing core."""

import ast
import re
import subprocess
import sys
from functools import cache
from graphlib import TopologicalSorter

import pytest

import core
from tests.conftest import ROOT

pytestmark = pytest.mark.uncompiled


# Arrays whose columns core/kernels/constants.py names.
TABLES = {"table", "pieces", "frame", "chain", "motion", "placed", "probed", "probed_later", "opening"}
OUTSIDE_CORE = {"app", "fastapi", "http", "json", "orjson", "pathlib", "pydantic", "starlette", "time"}
OVERLAP_ENGINES = {"fcl", "shapely"}
# Engines of continuous collision detection, only for comparison.
OTHER_ENGINES = {"Box2D", "ipctk"}
# No function is longer, docstring included, or takes more parameters.
LINES_MOST = 80
PARAMETERS_MOST = 8
HEAVY = ("fcl", "flint", "matplotlib", "pandas", "scipy", "shapely", "xarray")


def printed(code):
    """What a new process prints."""
    return subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True).strip()


def module_name(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


MODULES = {module_name(path): path for package in ("core", "app") for path in sorted((ROOT / package).rglob("*.py"))}
CORE = [module for module in MODULES if module.startswith("core")]


def nodes(path):
    """The syntax of a file, which is not kept: that of all files takes 110 MB."""
    return ast.walk(ast.parse(path.read_text("utf-8")))


@cache
def imports(path):
    """Every module named by an import statement anywhere in the file, also inside functions."""
    entries = set()
    for node in nodes(path):
        if isinstance(node, ast.Import):
            entries |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.module, f"{path} has a relative import"
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            entries |= {name if name in MODULES else node.module for name in names}
    return entries


def top_names(path):
    return {name.partition(".")[0] for name in imports(path)}


def rooms_drawn():
    """The rooms of core and app in each line of docs/architecture.md, from the ground up."""
    drawing = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8").split("```")[1]
    lines = []
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


def importers(names, paths):
    """The modules, by their names, that import one of these packages."""
    return {module for module, path in paths.items() if top_names(path) & names}


def imports_of_ours():
    """The modules of core and app that each of them imports."""
    return {module: imports(path) & MODULES.keys() for module, path in MODULES.items()}


def line_of(module):
    """The line of a module's room; -1 for a module without one."""
    return LINE_OF.get(".".join(module.split(".")[:2]), -1)


def test_every_module_has_a_room_and_imports_point_to_rooms_above():
    assert [module for module in MODULES if line_of(module) < 0] == []
    assert {".".join(module.split(".")[:2]) for module in MODULES} | {"app.page"} == set(LINE_OF)
    pairs = [(module, name) for module, names in imports_of_ours().items() for name in names]
    assert [(module, name) for module, name in pairs if line_of(name) > line_of(module)] == []


def test_no_modules_import_one_another_in_a_circle():
    # A package stands for its own file, which its modules do not import.
    # CycleError names the circle.
    TopologicalSorter({module: names - {module} for module, names in imports_of_ours().items()}).prepare()


def test_no_scripts_of_the_page_import_one_another_in_a_circle():
    pattern = re.compile(r"""(?:from|import|import\() ?"(\.{1,2}/[\w./-]+\.js)\"""")
    scripts = {path: path.read_text("utf-8") for path in (ROOT / "app" / "page").rglob("*.js")}
    used = {path: {(path.parent / name).resolve() for name in pattern.findall(text)} for path, text in scripts.items()}
    assert set().union(*used.values()) <= scripts.keys()
    assert sum(map(len, used.values())) > len(scripts)
    TopologicalSorter(used).prepare()


def test_core_knows_no_http_json_files_or_clocks_and_only_the_engines_import_fcl_and_shapely():
    assert importers(OUTSIDE_CORE, {module: MODULES[module] for module in CORE}) == set()
    assert importers(OVERLAP_ENGINES, MODULES) == {"core.shapes.engines"}
    others = {module_name(path): path for room in ("benchmarks", "examples") for path in (ROOT / room).rglob("*.py")}
    assert importers(OTHER_ENGINES, others | MODULES) == {"benchmarks.ccd.engines"}
    assert importers({"fcl"}, others | MODULES) == {"benchmarks.ccd.engines", "core.shapes.engines"}


def numbered(index):
    """True if the last index is a number, or a slice between numbers."""
    entries = [one for one in index.elts if ast.unparse(one) != "None"] if isinstance(index, ast.Tuple) else [None]
    last = entries[-1]
    parts = [last.lower, last.upper] if isinstance(last, ast.Slice) else [last]
    return any(isinstance(part, ast.Constant) and isinstance(part.value, int) for part in parts)


def without_name(index):
    """True if the last index is a number; or the first one, unless the last is the name of a column."""
    if not isinstance(index, ast.Tuple):
        return False
    first = index.elts[0]
    last = index.elts[-1]
    has_column_name = isinstance(last, ast.Name) and last.id.isupper()
    return numbered(index) or (isinstance(first, ast.Constant) and not has_column_name)


def test_columns_have_names():
    for module in CORE:
        in_kernels = module.startswith("core.kernels")  # whatever the array
        for node in nodes(MODULES[module]):
            if isinstance(node, ast.Subscript) and (in_kernels or names_in(node.value) & TABLES):
                is_wrong = without_name if in_kernels else numbered
                assert not is_wrong(node.slice), f"{module}, line {node.lineno}"


def names_in(node):
    """The names and the last parts of dotted names in a part of a file."""
    parts = list(ast.walk(node))
    names = {part.id for part in parts if isinstance(part, ast.Name)}
    return names | {part.attr for part in parts if isinstance(part, ast.Attribute)}


@pytest.mark.parametrize(
    "code, output",
    [
        (f"import sys; from core import *; print(*(name for name in {HEAVY} if name in sys.modules))", ""),
        # Importing core.shapes.reach would put the room in place of the function; lazy-loader before 0.6 let it.
        (
            "import core, core.course, core.shapes.reach; print(callable(core.course), callable(core.tolerance))",
            "True True",
        ),
        (
            "import core, sys; print('flint' in sys.modules, core.proof.verify.__module__, 'flint' in sys.modules)",
            "False core.proof.certificate True",
        ),
    ],
    ids=[
        "importing core loads nothing heavy",
        "a question keeps its name",
        "proofs are loaded when they are asked for",
    ],
)
def test_importing_core_loads_what_is_asked_for(code, output):
    assert printed(code) == output


def test_public_names_are_sorted_and_exist():
    assert core.__all__ == sorted(core.__all__)
    assert set(dir(core)) == {*core.__all__, "__version__", "proof"}
    assert all(hasattr(core, name) for name in core.__all__)
    stub = ast.parse((ROOT / "core" / "__init__.pyi").read_text()).body
    lines = [(node.module, [name.name for name in node.names]) for node in stub if isinstance(node, ast.ImportFrom)]
    listed = [ast.literal_eval(node.value) for node in stub if isinstance(node, ast.Assign)]
    assert listed == [
        sorted(name for module, names in lines if module for name in names)
    ]  # a literal, for star imports
    assert (None, ["proof"]) in lines


def test_functions_are_short_and_take_few_parameters():
    for module, path in MODULES.items():
        for node in nodes(path):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                place = f"{module}, {node.name}"
                assert (node.end_lineno or 0) - node.lineno < LINES_MOST, place
                names = {part.arg for part in ast.walk(node.args) if isinstance(part, ast.arg)} - {"self", "cls"}
                assert len(names) <= PARAMETERS_MOST or module.startswith("app.command"), place  # options of a command
