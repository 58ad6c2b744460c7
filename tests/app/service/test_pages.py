"""Files of the pages over HTTP: gzip for clients that accept it, entity tags, no Python."""

import gzip
import re

import httpx
import pytest

from app.service.pages import Files

FILES = ["/", "/how", "/page/main.js", "/page/uPlot.iife.js", "/docs", "/openapi.json", "/code.svg?http%3A%2F%2Fa%2F"]
UNPACKED = {"Accept-Encoding": "identity"}
PACKED = {"Accept-Encoding": "gzip"}


@pytest.mark.parametrize("path", FILES)
def test_a_file_is_the_same_as_gzip_and_plain_with_a_tag_of_each_form(client, path):
    answer = client.get(path, headers=UNPACKED).raise_for_status()
    with client.stream("GET", path, headers=PACKED) as packed:
        assert gzip.decompress(b"".join(packed.iter_raw())) == answer.content
    assert packed.headers["Content-Encoding"] == "gzip"
    assert "Content-Encoding" not in answer.headers
    assert int(packed.headers["Content-Length"]) < len(answer.content)
    vary = "Accept-Encoding, Accept-Language" if path in ("/", "/how") else "Accept-Encoding"
    assert answer.headers["Vary"] == packed.headers["Vary"] == vary
    assert answer.headers["ETag"] != packed.headers["ETag"]
    for form, tag in ((UNPACKED, answer.headers["ETag"]), (PACKED, packed.headers["ETag"])):
        again, other = (client.get(path, headers=form | {"If-None-Match": one}) for one in (tag, '"older"'))
        assert (again.status_code, again.content, other.status_code) == (304, b"", 200)


@pytest.mark.parametrize(
    "query, language, lang, word",
    [
        ("", "de, en;q=0.5", "en", "Contest"),
        ("", "zh-CN, en;q=0.5", "zh-Hans", "竞赛题"),
        ("?lang=en", "zh-CN", "en", "Contest"),
        ("?door=village&lang=zh", "en", "zh-Hans", "竞赛题"),
    ],
)
def test_a_page_has_its_words_before_its_modules_come(server, query, language, lang, word):
    text = httpx.get(f"{server}/{query}", headers={"Accept-Language": language}).text
    assert f'<html lang="{lang}">' in text
    assert re.search(rf'data-text(="Contest")?>{word}</button>', text)
    assert re.findall(r"data-text[^>]*></", text) == []


@pytest.mark.parametrize(
    "path",
    [
        *("/page/nowhere.js", "/page/", "/page/how", "/page/../main.py", "/docs/assets/__init__.py"),
        *("/page/%00", "/docs/assets/%00", "/page-x/%00", "/page/%1b%5B2J%0d", f"/page/{300 * 'a'}"),
        f"/code.svg?{1274 * 'a'}",
    ],
)
def test_only_files_of_the_pages_are_sent(server, path):
    answer = httpx.get(server + path)
    assert answer.status_code == 404
    assert answer.headers["Content-Type"] == "application/problem+json"


@pytest.mark.parametrize("path", ["/", "/how"])
def test_browsers_keep_the_files_of_a_page_until_one_changes(client, path):
    addresses = re.findall(r'(?:href|src)="page-\w+/([^"]*)"', client.get(path).text)
    assert len(addresses) > 3
    edition = re.findall(r'(?:href|src)="(page-\w+)/', client.get(path).text)[0]
    for address in addresses:
        kept = client.get(f"/{edition}/{address}").raise_for_status()
        assert kept.headers["Cache-Control"] == "public, max-age=31536000, immutable"
        # Of no edition, and of a page that was open before a new version came.
        for folder in ("page", "page-0123456789abcdef"):
            other = client.get(f"/{folder}/{address}")
            assert other.content == kept.content
            assert other.headers["Cache-Control"] == "no-cache"


def test_the_edition_depends_on_the_files_alone(tmp_path):
    def edition(place, **files):
        (tmp_path / place / "words").mkdir(parents=True, exist_ok=True)
        for name, text in files.items():
            (tmp_path / place / "words" / name.replace("_", ".")).write_text(text)
        return Files(directory=tmp_path / place).edition()

    assert edition("a", main_js="1", b_py="x") == edition("b", main_js="1") != edition("c", main_js="2")
    assert edition("c", main_js="1, as before") not in (edition("a"), edition("c", main_js="2"))


# What Chromium asks a page for.
BROWSER = "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,image/webp,*/*;q=0.8"
LONG = "x" * 20_000


@pytest.mark.parametrize(
    "path, language, lang, words",
    [
        (
            "/",
            "de, en",
            "en",
            "The address has 20,000 characters after its question mark; at most 8,000 can be read.",
        ),
        ("/how", "zh-CN, en;q=0.5", "zh-Hans", "地址在问号之后有 20,000 个字符，最多可读取 8,000 个。"),
    ],
    ids=["English", "Chinese"],
)
def test_a_too_long_address_is_answered_to_a_person_in_a_page(server, path, language, lang, words):
    answer = httpx.get(f"{server}{path}?{LONG}", headers={"Accept": BROWSER, "Accept-Language": language})
    assert answer.status_code == 414
    assert answer.headers["Connection"] == "close"
    assert answer.headers["Content-Type"] == "text/html; charset=utf-8"
    for text in (f'<html lang="{lang}">', f"<p>{words}</p>", '<a href="./">'):
        assert text in answer.text
    # Nothing of the address stands in the page.
    assert "xxx" not in answer.text


@pytest.mark.parametrize("path, accept", [("/", "*/*"), ("/turn", BROWSER)])
def test_a_too_long_address_is_a_problem_to_a_program(server, path, accept):
    answer = httpx.get(f"{server}{path}?{LONG}", headers={"Accept": accept})
    assert answer.status_code == 414
    assert answer.headers["Content-Type"] == "application/problem+json"
