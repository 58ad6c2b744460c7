"""Files of the pages over HTTP: gzip for clients that accept it, entity tags, no Python."""

from __future__ import annotations

import gzip

import httpx
import pytest

FILES = ["/", "/how", "/page/main.js", "/page/uplot/uPlot.iife.js", "/docs", "/openapi.json"]
PLAIN, PACKED = {"Accept-Encoding": "identity"}, {"Accept-Encoding": "gzip"}


@pytest.mark.parametrize("path", FILES)
def test_a_file_is_the_same_as_gzip_and_plain_with_a_tag_of_each_form(server: str, path: str) -> None:
    plain = httpx.get(server + path, headers=PLAIN)
    with httpx.stream("GET", server + path, headers=PACKED) as packed:
        assert gzip.decompress(b"".join(packed.iter_raw())) == plain.raise_for_status().content
    assert packed.headers["Content-Encoding"] == "gzip"
    assert int(packed.headers["Content-Length"]) < len(plain.content)
    assert "Content-Encoding" not in plain.headers
    assert plain.headers["Vary"] == packed.headers["Vary"] == "Accept-Encoding"
    assert plain.headers["Content-Type"] == packed.headers["Content-Type"]
    assert plain.headers["ETag"] != packed.headers["ETag"]


@pytest.mark.parametrize("path", FILES)
@pytest.mark.parametrize("form", [PLAIN, PACKED], ids=["plain", "gzip"])
def test_who_has_a_file_is_told_so(server: str, path: str, form: dict[str, str]) -> None:
    tag = httpx.get(server + path, headers=form).headers["ETag"]
    again = httpx.get(server + path, headers={**form, "If-None-Match": tag})
    assert (again.status_code, again.content, again.headers["ETag"]) == (304, b"", tag)
    other = httpx.get(server + path, headers={**form, "If-None-Match": '"older"'})
    assert other.status_code == 200


@pytest.mark.parametrize(
    ("path", "kind"), [("/docs/assets/favicon-32x32.png", "image/png"), ("/docs/start.js", "text/javascript")]
)
def test_what_gzip_makes_no_smaller_is_sent_as_it_is(server: str, path: str, kind: str) -> None:
    answer = httpx.get(server + path, headers=PACKED)
    assert answer.raise_for_status().headers["Content-Type"].startswith(kind)
    assert "Content-Encoding" not in answer.headers


@pytest.mark.parametrize(
    "path", ["/page/nowhere.js", "/page/", "/page/how", "/page/../main.py", "/docs/assets/__init__.py"]
)
def test_only_files_of_the_pages_are_sent(server: str, path: str) -> None:
    answer = httpx.get(server + path)
    assert answer.status_code == 404
    assert answer.headers["Content-Type"] == "application/problem+json"


def test_a_file_takes_no_other_method(server: str) -> None:
    assert httpx.post(f"{server}/page/main.js").status_code == 405
