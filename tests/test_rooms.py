"""Tests mirror core: core/paths/turn.py has tests/core/paths/test_turn.py."""

from __future__ import annotations

from pathlib import Path

import pytest

pytestmark = pytest.mark.uncompiled

ROOT = Path(__file__).parent.parent
CORE, TESTS = ROOT / "core", ROOT / "tests" / "core"
# Modules that are tested with others, as the parts of one answer.
TESTED_WITH = {
    "contact/answer.py": "test_plots.py",
    "contact/march.py": "contact/test_search.py",
    "contact/walls.py": "test_venue.py",
    "failures.py": "test_verdict.py",
    "kernels/bends.py": "kernels/test_pairs.py",
    "kernels/stretches.py": "kernels/test_bounds.py",
    "kernels/faces.py": "kernels/test_hulls.py",
    "kernels/results.py": "kernels/test_marching.py",
    "paths/following.py": "paths/test_route.py",
    "tolerance/exhibit.py": "tolerance/test_tolerance.py",
    "tolerance/safe.py": "tolerance/test_tolerance.py",
    "values.py": "test_errors.py",
}
MODULES = [path.relative_to(CORE) for path in sorted(CORE.rglob("*.py")) if path.name != "__init__.py"]


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_every_module_has_its_file_of_tests(module: Path) -> None:
    own = module.with_name(f"test_{module.name}")
    assert (TESTS / TESTED_WITH.get(module.as_posix(), own)).is_file()


def test_no_module_is_said_to_be_tested_elsewhere_that_is_not_there() -> None:
    assert set(TESTED_WITH) <= {module.as_posix() for module in MODULES}
