"""Tests stand in the rooms of what they test: core/paths/turn.py has tests/core/paths/test_turn.py.

So does app, but for the modules that a file tests together, as users ask for them. What several files use stands in
tests/support, what runs for minutes or hours in tests/campaigns.
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
    "assistant/test_assistant.py": "assistant/guide assistant/requests assistant/server assistant/tools command/mcp",
    "cards/test_cards.py": "cards/tables cards/words command/people questions/cues",
    "cards/test_crew.py": "cards/timeline questions/crew",
    "contest/test_kit.py": "command/contest contest/answers contest/figures contest/films contest/report"
    " contest/sensitivity contest/solved contest/tables questions/contest_kit",
    "files/test_figures.py": "files/figure_words",
    "files/test_film.py": "files/drum files/film_spec questions/films",
    "grade/test_command.py": "command/grade grade/contacts grade/names grade/numbers grade/shortcuts",
    "grade/test_diagnosis.py": "grade/chains grade/fits grade/geometry grade/outside grade/rings grade/rubric",
    "grade/test_layout.py": "grade/cells grade/judged grade/labels grade/lists grade/report grade/sheets",
    "grade/test_reading.py": "grade/expected grade/grid grade/workbook",
    "grade/test_service.py": "files/workbooks service/graders service/uploads",
    "grade/test_words.py": "grade/errors",
    "jobs/test_command.py": "command/jobs jobs/places",
    "jobs/test_disk.py": "jobs/reserve",
    "jobs/test_limits.py": "jobs/keeper service/token",
    "service/test_job_routes.py": "jobs/task service/job_bodies service/job_metrics",
    "jobs/test_runner.py": "files/lock jobs/reports jobs/work",
    "jobs/test_store.py": "files/flush jobs/job jobs/room jobs/tables jobs/turns",
    "jobs/test_sweeps.py": "jobs/sweeping",
    "maps/test_maps.py": "command/places files/words maps/dxf maps/features maps/geojson maps/kml maps/layout"
    " maps/lines maps/marks maps/places questions/maps",
    "maps/test_tracks.py": "maps/gpx",
    "plan/test_plan.py": "files/fonts plan/ground plan/sheet plan/tables plan/timing questions/plan",
    "processes/test_pool.py": "processes/child processes/messages processes/parent",
    "questions/test_encounter.py": "command/encounter files/performances wire/performances",
    "questions/test_envelope.py": "command/envelope files/outlines",
    "questions/test_paper.py": "grade/paper",
    "questions/test_proposals.py": "command/propose files/proposals",
    "questions/test_registry.py": "questions/clearance questions/maximum_head_speed questions/overlaps"
    " questions/pitch_scan questions/quickest_turn questions/shortest_turn questions/turn_time",
    "questions/test_tolerance.py": "command/strays questions/tolerance_curve",
    "service/test_problems.py": "service/negotiation wire/faults wire/problem",
    "service/test_reply.py": "service/short_tries",
    "sweeps/test_command.py": "command/sweep",
    "sweeps/test_run.py": "sweeps/engines sweeps/processes",
    "sweeps/test_shards.py": "sweeps/questions",
    "test_answers.py": "wire/answers",
    "test_any_path.py": "questions/turn wire/dances wire/paths",
    "test_api.py": "service/main service/queries service/routes service/version",
    "test_api_limits.py": "settings",
    "test_api_reference.py": "questions/collision_time questions/minimum_pitch questions/trajectory",
    "test_cli.py": "command/contacts command/entry command/main command/options command/overlaps"
    " command/paper command/paths command/serve command/show command/trajectory command/usage",
    "test_cli_check.py": "command/check command/designs",
    "test_cli_file.py": "command/figures files/drawing maps/dances questions/figures",
    "test_holding.py": "service/bodies service/clients service/hosts service/job_calls service/lanes service/middleware"
    " service/protocol service/request_limits service/workers",
    "test_openapi.py": "service/examples wire/question",
    "test_prove.py": "command/prove",
    "test_streams.py": "command/streams",
    "test_whole_dance.py": "wire/beats wire/benches wire/clocks",
}
SHARED = {Path(f"{module}.py"): Path(file) for file, modules in TOGETHER.items() for module in modules.split()}


def modules_of(package: str) -> list[Path]:
    """Modules of a package, by their paths in it."""
    return [path.relative_to(ROOT / package) for path in sorted((ROOT / package).rglob("[!_]*.py"))]


def own_file(module: Path) -> Path:
    return module.with_name(f"test_{module.name}")


def has_tests(file: Path) -> bool:
    """True for a file of tests that holds at least one."""
    name = file.relative_to(ROOT).as_posix()
    return any(isinstance(node, ast.FunctionDef) and node.name.startswith("test_") for node in trees().get(name, []))


def test_every_module_of_core_has_its_file_of_tests() -> None:
    assert [module for module in modules_of("core") if not has_tests(TESTS / "core" / own_file(module))] == []


def test_every_module_of_app_has_a_file_of_tests_and_one_alone() -> None:
    modules = modules_of("app")
    files = {module: TESTS / "app" / SHARED.get(module, own_file(module)) for module in modules}
    assert [module for module in modules if not has_tests(files[module])] == []
    assert [module for module in modules if module in SHARED and (TESTS / "app" / own_file(module)).is_file()] == []


def test_every_module_in_the_list_exists() -> None:
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
CHAINS = dict.fromkeys(("placed", "tried", "probed", "probed_later", "opening"), 1)  # of a Search
COLUMNS = {"chain": 1, "chains": 2, "table": 1, "row": 0, "sizes": 1, "motion": 1, "shifts": 1}


def axis_of_columns(node: ast.expr) -> int | None:
    """Axis of the columns of an array, or of a part of one; None for anything else."""
    if isinstance(node, ast.Subscript):
        axis = axis_of_columns(node.value)
        return None if axis is None else axis - sum(not isinstance(one, ast.Slice) for one in indices(node)[:axis])
    if isinstance(node, ast.Attribute):
        return (COLUMNS | CHAINS if ast.unparse(node.value) == "search" else COLUMNS).get(node.attr)
    return COLUMNS.get(node.id) if isinstance(node, ast.Name) else None


def indices(node: ast.Subscript) -> list[ast.expr]:
    return node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]


def is_number(part: ast.expr | None) -> bool:
    part = part.operand if isinstance(part, ast.UnaryOp) else part
    return isinstance(part, ast.Constant) and type(part.value) is int


def numeric_columns(nodes: list[ast.AST]) -> list[str]:
    """Columns of the kernels' arrays that are written as numbers."""
    entries = []
    for node in nodes:
        axis = axis_of_columns(node.value) if isinstance(node, ast.Subscript) else None
        if axis is None or not 0 <= axis < len(indices(node)):
            continue
        column = indices(node)[axis]
        parts = [column.lower, column.upper] if isinstance(column, ast.Slice) else [column]
        entries += [ast.unparse(node)] if any(map(is_number, parts)) else []
    return entries


@pytest.mark.parametrize(
    "code", ["table[:, 3]", "table[:, -1]", "table[0][3]", "search.placed[2:5, 6:10]", "search.chains[0][:, 6]"]
)
def test_a_column_written_as_a_number_is_noticed(code: str) -> None:
    assert numeric_columns(list(ast.walk(ast.parse(code)))) == [code]
    assert numeric_columns(list(ast.walk(ast.parse("search.chains[0, 3, THETA] + table[2:9, X0 : X3 + 1]")))) == []


def test_columns_of_the_kernels_are_named() -> None:
    of_core = ("tests/core/", "tests/support/", "tests/campaigns/")
    files = {path: nodes for path, nodes in trees().items() if path.startswith(of_core)}
    assert {path: used for path, nodes in files.items() if (used := numeric_columns(nodes))} == {}
