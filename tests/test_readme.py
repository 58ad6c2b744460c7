"""What README says of this repository is there, and its Python runs."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
CLAIMS = re.search(r"^### Each claim.*?(?=^##)", README, re.DOTALL | re.MULTILINE)
NAMED = re.findall(r"\[(test_\w+)\]\(([\w/.]+)\)", CLAIMS[0] if CLAIMS else "")
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
SNIPPETS = [
    (f"{page.name}:{text.count(chr(10), 0, found.start()) + 2}", found[1])
    for page in PAGES
    for text in [page.read_text(encoding="utf-8")]
    for found in re.finditer(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
]
LINKS = sorted(set(re.findall(r"\]\(((?!https?:)[^)#\s]+)\)", README)))


def test_each_claim_names_a_test() -> None:
    rows = [line for line in (CLAIMS[0] if CLAIMS else "").splitlines() if line.startswith("| ")][1:]
    assert len(rows) > 10
    assert all("test_" in row for row in rows)


@pytest.mark.parametrize(("test", "file"), NAMED)
def test_a_test_that_a_claim_names_exists(test: str, file: str) -> None:
    assert re.search(rf"^def {test}\(", (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("link", LINKS)
def test_what_readme_links_to_exists(link: str) -> None:
    assert (ROOT / link).exists()


def test_there_is_python_to_run() -> None:
    assert any(place.startswith("README.md") for place, _ in SNIPPETS)


@pytest.mark.parametrize(("place", "source"), SNIPPETS, ids=[place for place, _ in SNIPPETS])
def test_python_gives_what_is_printed_below_it(place: str, source: str) -> None:
    told: list[str] = []
    test = doctest.DocTestParser().get_doctest(source, {}, place, place, 0)
    assert len(test.examples) == source.count(">>> ") > 0
    doctest.DocTestRunner().run(test, out=told.append)
    assert "".join(told) == ""
