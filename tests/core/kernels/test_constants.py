"""The numbers and names that the loops share: the same for the compiler."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from core.kernels import constants

pytestmark = pytest.mark.uncompiled

DECLARED = Path(constants.__file__).with_suffix(".pxd").read_text(encoding="utf-8")


def test_constants_are_the_same_for_the_compiler() -> None:
    literals = re.findall(r'(\w+) "([^"]+)"', DECLARED) + re.findall(r"(\w+) = (\d+)", DECLARED)
    assert {name: float(value) for name, value in literals} == {
        name: value
        for name, value in vars(constants).items()
        if isinstance(value, int | float) and not name.endswith("_COLUMNS")
    }


def test_every_state_of_a_march_has_a_name() -> None:
    states = ("REACHED", "TOUCHED", "TOUCHED_AT_START", "STUCK", "CAPACITY", "TURNED")
    assert [constants.MARCH_STATES[getattr(constants, name)].upper() for name in states] == list(states)
