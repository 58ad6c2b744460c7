"""Tests stand in the rooms of what they test: core/paths/turn.py has tests/core/paths/test_turn.py.

Those of app go by what a user asks for, which several modules answer together. What several files of tests use stands
in tests/support, what runs for minutes or hours in tests/campaigns.
"""

import ast

import pytest

from tests.conftest import ROOT
from tests.test_architecture import nodes

pytestmark = pytest.mark.uncompiled

TESTS = ROOT / "tests"


def has_tests(file):
    """True for a file of tests that holds at least one."""
    return file.exists() and any(
        isinstance(node, ast.FunctionDef) and node.name.startswith("test_") for node in nodes(file)
    )


# Modules that hold names alone, from which setup.py declares those of the compiler.
NAMES = {"constants", "records"}


def test_every_module_of_core_has_its_file_of_tests():
    paths = [path for path in sorted((ROOT / "core").rglob("[!_]*.py")) if path.stem not in NAMES]
    modules = [path.relative_to(ROOT) for path in paths]
    assert len(modules) > 50
    assert [one for one in modules if not has_tests(TESTS / one.with_name(f"test_{one.name}"))] == []
