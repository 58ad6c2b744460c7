"""Tests stand in the rooms of what they test: core/paths/turn.py has tests/core/paths/test_turn.py.

Those of app go by what a user asks for, which several modules answer together. What several files of tests use stands
in tests/support, what runs for minutes or hours in tests/campaigns.
"""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent
TESTS = ROOT / "tests"


def has_tests(file: Path) -> bool:
    """True for a file of tests that holds at least one."""
    name = file.relative_to(ROOT).as_posix()
    return any(isinstance(node, ast.FunctionDef) and node.name.startswith("test_") for node in trees().get(name, []))


def test_every_module_of_core_has_its_file_of_tests() -> None:
    modules = [path.relative_to(ROOT) for path in sorted((ROOT / "core").rglob("[!_]*.py"))]
    assert len(modules) > 50
    assert [one for one in modules if not has_tests(TESTS / one.with_name(f"test_{one.name}"))] == []


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
    used: list[str] = []
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            used += [alias.name for alias in node.names]
        elif isinstance(node, ast.Attribute) and ast.unparse(node.value) not in ("self", "cls"):
            used.append(node.attr)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("attr"):
            used += [str(each.value).rpartition(".")[2] for each in node.args if isinstance(each, ast.Constant)]
    return [name for name in used if re.fullmatch(r"_.*[^_]", name) and name not in PUBLIC]


def test_no_test_uses_a_private_name() -> None:
    assert {path: used for path, nodes in trees().items() if (used := private_names(nodes))} == {}


# Arrays of the kernels, and the axis of their columns.
CHAINS = dict.fromkeys(("placed", "tried", "probed", "probed_later", "opening"), 1)  # of a Search
COLUMNS = {"chain": 1, "chains": 2, "table": 1, "row": 0, "sizes": 1, "motion": 1, "shifts": 1}


def axis_of_columns(node: ast.expr) -> int | None:
    """Axis of the columns of an array, or of a part of one; None for anything else."""
    if isinstance(node, ast.Subscript):
        axis = axis_of_columns(node.value)
        return None if axis is None else axis - sum(not isinstance(index, ast.Slice) for index in indices(node)[:axis])
    *owner, name = ast.unparse(node).split(".")
    return (COLUMNS | CHAINS if owner == ["search"] else COLUMNS).get(name)


def indices(node: ast.Subscript) -> list[ast.expr]:
    return node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]


def numeric_columns(nodes: list[ast.AST]) -> list[str]:
    """Columns of the kernels' arrays that are written as numbers."""
    entries = []
    for node in nodes:
        axis = axis_of_columns(node.value) if isinstance(node, ast.Subscript) else None
        if axis is not None and 0 <= axis < len(indices(node)):
            parts = ast.unparse(indices(node)[axis]).split(":")
            entries += [ast.unparse(node)] if any(part.lstrip("-").isdecimal() for part in parts) else []
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
