"""The site of the documentation: its reference, its links, and how the service shows it."""

import re
import runpy
from types import SimpleNamespace

import pytest

import core
from app.service.pages import GUIDE, guide_policy
from tests.app.test_openapi import CALLS, DOCUMENT
from tests.conftest import ROOT

SITE = ROOT / "docs" / "site"


def module(name):
    return SimpleNamespace(**runpy.run_path(str(SITE / f"{name}.py")))


def test_every_public_name_of_core_stands_on_one_page():
    text = "\n".join(module("reference").library_pages().values())
    names = re.findall(r"^\.\. [\w:]+:: core\.(\w+)$", text, re.MULTILINE)
    assert sorted(names) == sorted(core.__all__)


def test_every_page_of_docs_has_a_section(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(SITE))
    module("build").assemble(tmp_path)
    pages = {path.stem for path in SITE.parent.glob("*.md")} - {"README"}
    assert pages <= {path.stem for path in tmp_path.glob("*.md")}


def test_every_call_and_every_schema_has_its_place():
    text = module("reference").http_pages(DOCUMENT)["http-reference"]
    assert sorted(re.findall(r"^### (.+)$", text, re.MULTILINE)) == sorted([*CALLS, *DOCUMENT["components"]["schemas"]])
    anchors, links = (set(re.findall(form, text)) for form in (r"\((schema-[\w-]+)\)=", r"\(#(schema-[\w-]+)\)"))
    assert links <= anchors


def test_entries_of_docstrings_become_fields():
    docstring = """What comes back.

margin: required clearance [m]; `x*y` and a * b
    goes on here
pitch, radius [m]; speed: of a_
the same entry goes on
A paragraph.

>>> 1 *1"""
    fields = r"""What comes back.

:margin: required clearance [m]; `x*y` and a \* b
    goes on here
:pitch, radius: [m]; speed: of a\_
    the same entry goes on

A paragraph.


>>> 1 *1
"""
    assert "\n".join(module("docstrings").as_fields(docstring.split("\n"))) == fields


@pytest.mark.parametrize(
    "page, dead",
    [
        ('<a href="other.html#here">', ""),
        ('<a href="https://example.org/gone">', ""),
        ('<a href="none.html">', "none.html does not exist"),
        ('<a href="other.html#gone">', "other.html#gone has no such anchor"),
        ('<a href="../outside.html">', "../outside.html does not exist"),
        ('<img src="https://example.org/a.png">', "https://example.org/a.png is loaded from another host"),
        ('<link rel="stylesheet" href="none.css">', "none.css does not exist"),
        ('<script>mode = localStorage.getItem("mode") || "";</script>', "the theme has no mode"),
    ],
)
def test_dead_links_are_named(tmp_path, page, dead):
    site = tmp_path / "site"
    site.mkdir()
    (tmp_path / "outside.html").write_text("")
    (site / "index.html").write_text(page)
    (site / "other.html").write_text('<p id="here">')
    assert module("links").dead_links(site) == ([f"{dead}: index.html"] if dead else [])


def test_a_page_of_the_guide_may_run_its_own_scripts_and_no_others():
    policy = guide_policy(b'<script src="a.js"></script><script>let a = 1;</script><script data-b="c">b()</script>')
    assert policy.count("'sha256-") == 2
    assert "script-src 'self' 'sha256-" in policy
    assert "unsafe" not in policy.split("script-src")[1]


def test_the_service_shows_the_guide_or_says_that_there_is_none(client):
    assert client.get("/guide").headers["location"] == "guide/"
    answer = client.get("/guide/")
    if GUIDE.is_dir():
        assert answer.status_code == 200
        assert "'sha256-" in answer.headers["content-security-policy"]
        assert client.get("/guide/none.html").status_code == 404
    else:
        assert answer.status_code == 404
        assert "make docs" in answer.json()["detail"]
        for language, path, up in (("en", "/guide/", "../"), ("zh", "/guide/a/b.html", "../../")):
            page = client.get(path, headers={"Accept": "text/html", "Accept-Language": language})
            assert (page.status_code, "make docs" in page.text, f'href="{up}page/style.css"' in page.text) == (
                404,
                True,
                True,
            )
