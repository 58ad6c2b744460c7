"""The guide for assistants: the pages of the documentation as resources in Markdown, where it is installed."""

from __future__ import annotations

import re
from pathlib import Path

from mcp import types

PAGES = Path(__file__).parent.parent / "guide" / "pages"
PREFIX, MARKDOWN = "bench-dragon://guide/", "text/markdown"


def resources() -> list[types.Resource]:
    """The pages of the guide; none where it is not installed (make docs)."""
    return [
        types.Resource(uri=f"{PREFIX}{path.stem}", name=path.stem, title=_title(path), mime_type=MARKDOWN)
        for path in sorted(PAGES.glob("*.md"))
    ]


def read(uri: str) -> str | None:
    """Text of a page; None where there is no such page."""
    path = PAGES / f"{uri.removeprefix(PREFIX)}.md"
    return path.read_text("utf-8") if path in PAGES.glob("*.md") else None


def _title(path: Path) -> str:
    heading = re.search(r"^# (.+)$", path.read_text("utf-8"), re.MULTILINE)
    return heading[1] if heading else path.stem
