"""Tests mirror core: core/paths/turn.py has tests/core/paths/test_turn.py."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent
CORE, TESTS = ROOT / "core", ROOT / "tests" / "core"
MODULES = [path.relative_to(CORE) for path in sorted(CORE.rglob("*.py")) if path.name != "__init__.py"]


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_every_module_has_its_file_of_tests(module: Path) -> None:
    assert (TESTS / module.with_name(f"test_{module.name}")).is_file()


# -- names that tests use ------------------------------------------------------------------------------------

TREES = {
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
    assert {path: used for path, nodes in TREES.items() if (used := private_names(nodes))} == {}


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
    core = {path: nodes for path, nodes in TREES.items() if path.startswith("tests/core/")}
    assert {path: used for path, nodes in core.items() if (used := numeric_columns(nodes))} == {}
