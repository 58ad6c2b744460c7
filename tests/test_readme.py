"""What README says of this repository is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
CLAIMS = re.search(r"^### Each claim.*?(?=^##)", README, re.DOTALL | re.MULTILINE)
NAMED = re.findall(r"\[(test_\w+)\]\(([\w/.]+)\)", CLAIMS[0] if CLAIMS else "")
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
