"""The numbers and names that the loops share: the same for the compiler."""

import inspect
import re
from pathlib import Path

import pytest

from core.kernels import constants

pytestmark = pytest.mark.uncompiled

DECLARED = Path(constants.__file__).with_suffix(".pxd").read_text(encoding="utf-8")


STATES = {
    name: kind
    for name, kind in vars(constants).items()
    if inspect.isclass(kind) and kind.__module__ == constants.__name__
}


def declared(text):
    return {name: float(value) for name, value in re.findall(r"(\w+) = (\d+)", text)}


def test_constants_are_the_same_for_the_compiler():
    unnamed = re.search(r"cdef enum:\n((?:    .*\n)+)", DECLARED)
    assert unnamed is not None
    literals = {name: float(value) for name, value in re.findall(r'(\w+) "([^"]+)"', DECLARED)}
    assert {**literals, **declared(unnamed[1])} == {
        name: value
        for name, value in vars(constants).items()
        if isinstance(value, int | float) and not name.endswith("_COLUMNS")
    }


def test_states_have_the_same_names_and_numbers_for_the_compiler():
    compiled = dict(re.findall(r"cdef enum (\w+):\n((?:    .*\n)+)", DECLARED))
    assert {name: declared(text) for name, text in compiled.items()} == {
        name: dict(states.__members__) for name, states in STATES.items()
    }
    assert set(STATES) == {"Ended", "Step", "Judged"}
