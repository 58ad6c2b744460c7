"""Follow every link of a built site: python docs/site/links.py FOLDER. Prints what is dead; the exit code counts."""

from __future__ import annotations

import sys
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit

# What the theme writes where conf.py names no mode; its own script then reports an error on every page.
NO_MODE = 'localStorage.getItem("mode") || ""'


class Page(HTMLParser):
    """Addresses and anchors of a page.

    links: addresses that a reader follows; loaded: those that the browser loads; has_mode: whether its theme has one
    """

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.anchors = {""}
        text = path.read_text("utf-8")
        self.has_mode = NO_MODE not in text
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attributes}
        self.anchors |= {values[name] for name in ("id", "name") if name in values}
        if address := values.get("src") or values.get("href"):
            follows = tag == "a" or (tag == "link" and values.get("rel") in ("index", "search", "next", "prev"))
            (self.links if follows else self.loaded).add(address)


def dead_links(site: Path) -> list[str]:
    """What leads nowhere, and what a page would load from another host, in a sentence each."""
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    dead = defaultdict(set)
    for path, page in pages.items():
        if not page.has_mode:
            dead["the theme has no mode"].add(path)
        for address in page.links | page.loaded:
            target, anchor = urldefrag(address)
            parts = urlsplit(target)
            if parts.scheme in ("data", "mailto"):
                continue
            if parts.netloc:
                if address in page.loaded:
                    dead[f"{address} is loaded from another host"].add(path)
                continue
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            file = file / "index.html" if file.is_dir() else file
            if not file.is_file() or not file.is_relative_to(site):
                dead[f"{target} does not exist"].add(path)
            elif file in pages and unquote(anchor) not in pages[file].anchors:
                dead[f"{address} has no such anchor"].add(path)
    return [f"{what}: {', '.join(str(path.relative_to(site)) for path in paths)}" for what, paths in dead.items()]


if __name__ == "__main__":
    folder = Path(sys.argv[1]).resolve()
    dead = dead_links(folder)
    print(*dead or [f"No dead link in {folder}"], sep="\n")
    sys.exit(bool(dead))
