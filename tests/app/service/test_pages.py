"""Files of the pages over HTTP: gzip for clients that accept it, entity tags, no Python."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import httpx
import pytest

from app.service.pages import Files

FILES = ["/", "/how", "/page/main.js", "/page/uPlot.iife.js", "/docs", "/openapi.json"]
UNPACKED, PACKED = {"Accept-Encoding": "identity"}, {"Accept-Encoding": "gzip"}


@pytest.mark.parametrize("path", FILES)
def test_a_file_is_the_same_as_gzip_and_plain_with_a_tag_of_each_form(client: httpx.Client, path: str) -> None:
    answer = client.get(path, headers=UNPACKED).raise_for_status()
    with client.stream("GET", path, headers=PACKED) as packed:
        assert gzip.decompress(b"".join(packed.iter_raw())) == answer.content
    assert (packed.headers["Content-Encoding"], "Content-Encoding" in answer.headers) == ("gzip", False)
    assert int(packed.headers["Content-Length"]) < len(answer.content)
    vary = "Accept-Encoding, Accept-Language" if path in ("/", "/how") else "Accept-Encoding"
    assert answer.headers["Vary"] == packed.headers["Vary"] == vary
    assert answer.headers["Content-Type"] == packed.headers["Content-Type"]
    assert answer.headers["ETag"] != packed.headers["ETag"]
    for form, tag in ((UNPACKED, answer.headers["ETag"]), (PACKED, packed.headers["ETag"])):
        again, other = (client.get(path, headers=form | {"If-None-Match": one}) for one in (tag, '"older"'))
        assert (again.status_code, again.content, again.headers["ETag"], other.status_code) == (304, b"", tag, 200)


@pytest.mark.parametrize(
    ("query", "language", "lang", "word"),
    [
        ("", "de, en;q=0.5", "en", "Contest"),
        ("", "zh-CN, en;q=0.5", "zh-Hans", "竞赛题"),
        ("?lang=en", "zh-CN", "en", "Contest"),
        ("?door=village&lang=zh", "en", "zh-Hans", "竞赛题"),
    ],
)
def test_a_page_has_its_words_before_its_modules_come(
    server: str, query: str, language: str, lang: str, word: str
) -> None:
    text = httpx.get(f"{server}/{query}", headers={"Accept-Language": language}).text
    assert f'<html lang="{lang}">' in text
    assert f'data-text="door_contest">{word}</button>' in text
    assert re.findall(r'data-text="(\w+)"[^>]*></', text) == []


@pytest.mark.parametrize(
    ("path", "kind"), [("/docs/assets/favicon-32x32.png", "image/png"), ("/docs/start.js", "text/javascript")]
)
def test_what_gzip_makes_no_smaller_is_sent_as_it_is(server: str, path: str, kind: str) -> None:
    answer = httpx.get(server + path, headers=PACKED)
    assert answer.raise_for_status().headers["Content-Type"].startswith(kind)
    assert "Content-Encoding" not in answer.headers


@pytest.mark.parametrize(
    "path",
    [
        *("/page/nowhere.js", "/page/", "/page/how", "/page/../main.py", "/docs/assets/__init__.py"),
        *("/page/%00", "/docs/assets/%00", "/page-x/%00", "/page/%1b%5B2J%0d", f"/page/{300 * 'a'}"),
    ],
)
def test_only_files_of_the_pages_are_sent(server: str, path: str) -> None:
    answer = httpx.get(server + path)
    assert answer.status_code == 404
    assert answer.headers["Content-Type"] == "application/problem+json"


def test_a_file_takes_no_other_method(server: str) -> None:
    assert httpx.post(f"{server}/page/main.js").status_code == 405


@pytest.mark.parametrize("path", ["/", "/how"])
def test_browsers_keep_the_files_of_a_page_until_one_changes(server: str, path: str) -> None:
    addresses = re.findall(r'(?:href|src)="(page[^"]*)"', httpx.get(server + path).raise_for_status().text)
    assert len(addresses) > 3
    for address in addresses:
        kept = httpx.get(f"{server}/{address}").raise_for_status()
        assert kept.headers["Cache-Control"] == "public, max-age=31536000, immutable"
        second = httpx.get(f"{server}/page/{address.partition('/')[2]}")
        assert (second.content, second.headers["Cache-Control"]) == (kept.content, "no-cache")
        # A page that was open before a new version came.
        older = httpx.get(f"{server}/page-0123456789abcdef/{address.partition('/')[2]}")
        assert (older.content, older.headers["Cache-Control"]) == (kept.content, "no-cache")


def test_the_edition_depends_on_the_files_alone(tmp_path: Path) -> None:
    editions = []
    for place, script, others in [("a", "1", ["b.py"]), ("b", "1", []), ("c", "2", [])]:
        folder = tmp_path / place / "words"
        folder.mkdir(parents=True)
        (folder / "main.js").write_text(script)
        for name in others:
            (folder / name).touch()
        editions.append(Files(directory=tmp_path / place).edition())
    assert editions[0] == editions[1] != editions[2]
    (tmp_path / "c" / "words" / "main.js").write_text("1, as before")
    assert Files(directory=tmp_path / "c").edition() not in editions


# What Chromium asks a page for.
BROWSER = "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,image/webp,*/*;q=0.8"
LONG = "x" * 20_000


@pytest.mark.parametrize(
    ("query", "asked", "lang", "words"),
    [
        (LONG, "de, en", "en", "The address has 20,000 characters after its question mark; at most 8,000 can be read."),
        (LONG, "zh-CN, en;q=0.5", "zh-Hans", "地址在问号之后有 20,000 个字符，最多可读取 8,000 个。"),
        (f"lang=zh&{LONG}", "en", "zh-Hans", "地址在问号之后有 20,008 个字符，最多可读取 8,000 个。"),
    ],
    ids=["English", "Chinese browser", "Chinese address"],
)
@pytest.mark.parametrize("path", ["/", "/how"])
def test_a_too_long_address_is_answered_to_a_person_in_a_page(
    server: str, path: str, query: str, asked: str, lang: str, words: str
) -> None:
    answer = httpx.get(f"{server}{path}?{query}", headers={"Accept": BROWSER, "Accept-Language": asked})
    assert answer.status_code == 414
    assert answer.headers["Content-Type"] == "text/html; charset=utf-8"
    assert answer.headers["Connection"] == "close"
    assert f'<html lang="{lang}">' in answer.text
    assert f"<p>{words}</p>" in answer.text
    assert '<a href=".">' in answer.text
    # Nothing of the address stands in the page.
    assert "xxx" not in answer.text


@pytest.mark.parametrize(("path", "accept"), [("/", "*/*"), ("/", "application/json"), ("/turn", BROWSER)])
def test_a_too_long_address_is_a_problem_to_a_program(server: str, path: str, accept: str) -> None:
    answer = httpx.get(f"{server}{path}?{LONG}", headers={"Accept": accept})
    assert (answer.status_code, answer.headers["Content-Type"]) == (414, "application/problem+json")
