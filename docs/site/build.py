"""The site of the documentation: python docs/site/build.py FOLDER. The pages of docs/ and the reference, by Sphinx.

The pages stand in docs/ as they are; here they are copied, links out of docs/ lead to copies of the files, and the
reference is made from the docstrings of core and the description of the service.
"""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
from pathlib import Path

from reference import ROOMS, http_pages, library_pages

from app.service.main import create_app

SITE = Path(__file__).parent
DOCS = SITE.parent
ROOT = DOCS.parent
# The sections of the site, with the pages of docs/ on each; a page of docs/ on none of them is an error.
SECTIONS = {
    "everyone": ("Everyone", ["child", "gallery", "conventions", "command"]),
    "students": ("Students", ["student", "teacher", "contest", "grade", "method", "paper"]),
    "organisers": (
        "Organisers",
        [
            *("organiser", "paths-and-venues", "propose", "maps", "plan", "safety-sheet", "cues", "crew"),
            *("performances", "tolerance", "envelope"),
        ],
    ),
    "scientists": ("Scientists", ["scientist", "library", "proofs", "claims", "sweeps", "performance", "dragon-ccd"]),
    "operators": ("Operators", ["engineer", "http", "operations", "assistants"]),
    "reference": ("Reference", [*(f"reference/{page}" for page in ROOMS), "http-reference"]),
    "project": ("Project", ["architecture", "contributing", "changelog", "security"]),
}
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s#]+)(#[^)\s]*)?\)")
IMAGE = re.compile(r'src="docs/')


def _linked(text: str, folder: Path, pages: dict[Path, str]) -> str:
    """Markdown whose links lead to pages of the site, to pictures, or to copies of files; folders lose their links."""

    def link(match: re.Match[str]) -> str:
        words, target, anchor = match[1], match[2], match[3] or ""
        if "://" in target:
            return match[0]
        path = (folder / target).resolve()
        if path in pages:
            return f"{words}({pages[path]}.md{anchor})"
        if path.is_file() and path.is_relative_to(DOCS):
            return f"{words}({path.relative_to(DOCS)})"
        if path.is_file():
            return f"{words}({_copy_of(path)})"
        return words[1:-1]

    return LINK.sub(link, IMAGE.sub('src="', text))


def _copy_of(file: Path) -> Path:
    """Where the site has a file from outside docs/: as text, which a browser shows, not as a module of Python."""
    return Path("files", f"{file.relative_to(ROOT)}.txt")


def assemble(source: Path) -> None:
    """Write the source of the site into an empty folder."""
    listed = {page for _, pages in SECTIONS.values() for page in pages}
    guides = {path.stem for path in DOCS.glob("*.md")} - {"README"}
    if missing := guides - listed:
        raise SystemExit(f"pages of docs/ in no section of docs/site/build.py: {', '.join(sorted(missing))}")
    pages = {(DOCS / f"{page}.md").resolve(): page for page in guides}
    pages |= {(ROOT / "README.md").resolve(): "start", (ROOT / "README.zh.md").resolve(): "zh"}
    pages |= {(ROOT / "CONTRIBUTING.md").resolve(): "contributing", (DOCS / "README.md").resolve(): "index"}
    pages |= {(ROOT / "CHANGELOG.md").resolve(): "changelog", (ROOT / "SECURITY.md").resolve(): "security"}
    for path, page in pages.items():
        text = path.read_text("utf-8")
        for target in {match[2] for match in LINK.finditer(text)}:
            file = (path.parent / target).resolve()
            if file.is_file() and file not in pages and not file.is_relative_to(DOCS):
                copy = source / _copy_of(file)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, copy)
        (source / f"{page}.md").write_text(_linked(text, path.parent, pages), "utf-8")
    for picture in DOCS.glob("*.png"):
        shutil.copyfile(picture, source / picture.name)
    shutil.copytree(DOCS / "gallery", source / "gallery")
    shutil.copytree(SITE / "_static", source / "_static")
    shutil.copyfile(SITE / "conf.py", source / "conf.py")
    (source / "reference").mkdir()
    for page, text in library_pages().items():
        (source / "reference" / f"{page}.rst").write_text(text, "utf-8")
    for page, text in http_pages(create_app().openapi()).items():
        (source / f"{page}.md").write_text(text, "utf-8")
    for name, (title, entries) in SECTIONS.items():
        tree = "\n".join(entries)
        (source / f"{name}.md").write_text(f"# {title}\n\n```{{toctree}}\n:maxdepth: 1\n\n{tree}\n```\n", "utf-8")
    with (source / "index.md").open("a", encoding="utf-8") as index:
        index.write("\n".join(["", "```{toctree}", ":hidden:", "", "Start <start>", *SECTIONS, "中文 <zh>", "```", ""]))


def build(target: Path) -> int:
    """Build the site into a folder, whose files it replaces. returns: exit code of Sphinx; a warning is an error"""
    from sphinx.cmd.build import main as sphinx

    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "source")
        source.mkdir()
        assemble(source)
        shutil.rmtree(target, ignore_errors=True)
        code = sphinx(["-q", "-W", "--keep-going", "-b", "html", "-d", f"{folder}/doctrees", str(source), str(target)])
        # The pages as text, for assistants.
        (target / "pages").mkdir()
        for page in source.glob("*.md"):
            shutil.copy(page, target / "pages")
    for name in (".buildinfo", "objects.inv", "_static/webpack-macros.html"):
        (target / name).unlink(missing_ok=True)
    return code


if __name__ == "__main__":
    sys.exit(build(Path(sys.argv[1])))
