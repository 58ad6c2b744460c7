"""Docstrings of core in reStructuredText, for Sphinx."""

from __future__ import annotations

import re

# An entry of a docstring says what a parameter or an attribute is, or follows returns:, raises: or source:.
ENTRY = re.compile(r"(\w+(?:, \w+)*)(?: (\[[^]]+\]))?[:;]\s+(\S.*)")
# Marks of reStructuredText, which docstrings do not use; what stands between backquotes is code and stays.
MARKS = re.compile(r"(`[^`]*`)|([*|\\])|(?<=\w)(_)(?!\w)")


# Every search takes one, so docstrings name it only where its default is of their own.
BUDGET = "budget: remaining work, which questions may share and a thread may stop; None: the default of the question"


def with_budget(lines: list[str]) -> list[str]:
    """The docstring of a function that takes a budget, with an entry for it before raises: or the examples."""
    if any(re.search(r"\bbudget(, \w+)*: ", line) for line in lines):
        return lines
    ends = (at for at, line in enumerate(lines) if line.startswith(("raises:", "source:", ">>>")))
    at = next(ends, len(lines))
    before = lines[:at]
    while before and not before[-1]:
        before.pop()
    return [*before, BUDGET, *([""] if lines[at:] and lines[at].startswith(">>>") else []), *lines[at:]]


def escape(text: str) -> str:
    return MARKS.sub(lambda mark: mark[1] or f"\\{mark[2] or mark[3]}", text)


def as_fields(lines: list[str]) -> list[str]:
    """A docstring in reStructuredText: its entries become fields; its examples, which come last, stay as they are."""
    examples = next((at for at, line in enumerate(lines) if line.lstrip().startswith(">>>")), len(lines))
    result: list[str] = []
    in_entry = False
    for line in lines[:examples]:
        entry = ENTRY.fullmatch(line)
        continues = in_entry and not entry and bool(re.match("[ a-z(\\[]", line))
        starts = entry is not None and not in_entry
        ends = in_entry and not entry and not continues
        if (starts or ends) and result and result[-1] and line:
            result.append("")
        if entry:
            names, unit, meaning = entry.groups()
            result.append(f":{names}: " + escape(f"{unit}; {meaning}" if unit else meaning))
        else:
            result.append(f"    {escape(line.strip())}" if continues else escape(line))
        in_entry = bool(entry) or continues
    return [*result, "", *lines[examples:], ""]
