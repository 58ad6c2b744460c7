"""The records that inner loops hand on: the same fields in the same order for the compiler."""

import re
from pathlib import Path

import pytest

from core.kernels import records

pytestmark = pytest.mark.uncompiled

DECLARED = Path(records.__file__).with_suffix(".pxd").read_text(encoding="utf-8")


def test_records_are_the_same_for_the_compiler():
    structs = {
        name: tuple(", ".join(re.findall(r"    (?:double|Py_ssize_t|bint|View) (.+)\n", fields)).split(", "))
        for name, fields in re.findall(r"cdef struct (\w+):\n((?:    .+\n)+)", DECLARED)
    }
    assert len(structs) > 9
    assert structs == {name: record._fields for name, record in vars(records).items() if hasattr(record, "_fields")}


def test_counts_and_numbers_are_distinguished_as_by_the_compiler():
    counts = set(", ".join(re.findall(r"Py_ssize_t (.+)", DECLARED)).split(", "))
    annotated = {
        field
        for record in vars(records).values()
        if hasattr(record, "_fields")
        for field, kind in record.__annotations__.items()
        if kind is int
    }
    assert counts == annotated
