"""Tests stand in the rooms of what they test: core/paths/turn.py has tests/core/paths/test_turn.py.

So does app, but for the modules that a file tests together, as users ask for them.
"""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import pytest

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent
TESTS = ROOT / "tests"
# Files of tests of app, and modules without a file of their own that each of them tests.
TOGETHER = {
    "contest/test_kit.py": "command/contest contest/answers contest/figures contest/films contest/report"
    " contest/sensitivity contest/solved contest/tables",
    "files/test_film.py": "files/film_spec questions/films",
    "grade/test_command.py": "command/grade grade/contacts grade/shortcuts",
    "grade/test_diagnosis.py": "grade/chains grade/geometry grade/rings grade/rubric",
    "grade/test_layout.py": "grade/labels grade/report grade/judged",
    "grade/test_reading.py": "grade/expected grade/grid grade/workbook",
    "grade/test_service.py": "files/workbooks service/graders service/uploads",
    "grade/test_words.py": "grade/errors",
    "jobs/test_command.py": "command/jobs jobs/places",
    "jobs/test_disk.py": "jobs/reserve",
    "jobs/test_limits.py": "jobs/keeper service/token",
    "jobs/test_routes.py": "jobs/metrics jobs/task jobs/wire",
    "jobs/test_runner.py": "files/lock jobs/reports jobs/work logs",
    "jobs/test_store.py": "files/flush jobs/job",
    "jobs/test_sweeps.py": "jobs/sweeping",
    "maps/test_maps.py": "command/places files/words maps/dxf maps/features maps/geojson maps/kml maps/layout"
    " maps/marks maps/places questions/maps",
    "plan/test_plan.py": "files/fonts plan/ground plan/sheet plan/tables plan/timing questions/plan",
    "questions/test_envelope.py": "command/envelope files/outlines",
    "questions/test_paper.py": "grade/paper",
    "questions/test_registry.py": "questions/clearance questions/course questions/maximum_head_speed questions/overlaps"
    " questions/pitch_scan questions/shortest_turn",
    "questions/test_tolerance.py": "command/strays questions/tolerance_curve",
    "service/test_problems.py": "wire/faults wire/problem",
    "sweeps/test_command.py": "command/sweep",
    "sweeps/test_run.py": "sweeps/engines sweeps/processes sweeps/worker",
    "sweeps/test_shards.py": "sweeps/questions",
    "test_answers.py": "wire/answers",
    "test_any_path.py": "questions/check questions/turn wire/dances wire/paths",
    "test_api.py": "service/main service/reply service/routes service/version",
    "test_api_limits.py": "settings",
    "test_api_reference.py": "questions/collision_time questions/minimum_pitch questions/trajectory",
    "test_cli.py": "command/contacts command/entry command/main command/options command/overlaps"
    " command/paper command/paths command/serve command/show command/trajectory command/usage",
    "test_cli_check.py": "command/check command/designs",
    "test_cli_file.py": "command/figures files/drawing questions/figures",
    "test_holding.py": "service/bodies service/middleware service/protocol service/workers",
    "test_openapi.py": "service/examples wire/question",
    "test_prove.py": "command/prove",
    "test_whole_dance.py": "wire/benches wire/clocks",
}
SHARED = {Path(f"{module}.py"): Path(file) for file, modules in TOGETHER.items() for module in modules.split()}


def modules_of(package: str) -> list[Path]:
    """Modules of a package, by their paths in it."""
    return [path.relative_to(ROOT / package) for path in sorted((ROOT / package).rglob("[!_]*.py"))]


def own_file(module: Path) -> Path:
    return module.with_name(f"test_{module.name}")


@pytest.mark.parametrize("module", modules_of("core"), ids=str)
def test_every_module_of_core_has_its_file_of_tests(module: Path) -> None:
    assert (TESTS / "core" / own_file(module)).is_file()


@pytest.mark.parametrize("module", modules_of("app"), ids=str)
def test_every_module_of_app_has_a_file_of_tests_and_one_alone(module: Path) -> None:
    assert (TESTS / "app" / SHARED.get(module, own_file(module))).is_file()
    assert not (module in SHARED and (TESTS / "app" / own_file(module)).is_file())


def test_no_module_is_said_to_be_tested_that_is_not_there() -> None:
    assert set(SHARED) - set(modules_of("app")) == set()
    assert len(SHARED) == sum(len(modules.split()) for modules in TOGETHER.values())


# -- names that tests use ------------------------------------------------------------------------------------


@cache
def trees() -> dict[str, list[ast.AST]]:
    """The syntax of each file of tests."""
    return {
        path.relative_to(ROOT).as_posix(): list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
        for path in sorted((ROOT / "tests").rglob("*.py"))
    }


# Public in spite of their underscore.
PUBLIC = {"_asdict", "_exit", "_fields", "_replace"}


def private_names(nodes: list[ast.AST]) -> list[str]:
    """Private names that code imports, asks another object for, or replaces."""
    used = [one.name for node in nodes if isinstance(node, ast.ImportFrom) for one in node.names]
    used += [
        node.attr
        for node in nodes
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) not in ("self", "cls")
    ]
    calls = [node for node in nodes if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("attr")]
    used += [str(one.value).rpartition(".")[2] for call in calls for one in call.args if isinstance(one, ast.Constant)]
    return [name for name in used if name.startswith("_") and not name.endswith("_") and name not in PUBLIC]


def test_no_test_uses_a_private_name() -> None:
    assert {path: used for path, nodes in trees().items() if (used := private_names(nodes))} == {}


# Arrays of the kernels, and the axis of their columns.
COLUMNS = {"table": 1, "row": 0, "sizes": 1, "motion": 1, "chain": 1, "chains": 2, "shifts": 1}


def numeric_columns(nodes: list[ast.AST]) -> list[str]:
    """Columns of the kernels' arrays that are written as numbers."""
    found = []
    for node in nodes:
        if not isinstance(node, ast.Subscript) or not isinstance(node.value, ast.Attribute | ast.Name):
            continue
        axis = COLUMNS.get(node.value.attr if isinstance(node.value, ast.Attribute) else node.value.id)
        index = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        column = index[axis] if axis is not None and axis < len(index) else None
        parts = [column.lower, column.upper] if isinstance(column, ast.Slice) else [column]
        found += [ast.unparse(node) for part in parts if isinstance(part, ast.Constant) and type(part.value) is int]
    return found


def test_columns_of_the_kernels_are_named() -> None:
    core = {path: nodes for path, nodes in trees().items() if path.startswith("tests/core/")}
    assert {path: used for path, nodes in core.items() if (used := numeric_columns(nodes))} == {}
