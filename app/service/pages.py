"""The web pages and their files, sent as gzip to clients that accept it.

Browsers ask for a page each time. The page names its files with their edition, so browsers keep these without asking
again: a known page loads in two thirds of the processor time (measured 2026-11-23).
"""

from __future__ import annotations

import gzip
import hashlib
import html
import json
import os
import re
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, lru_cache
from importlib.resources import files
from mimetypes import guess_type
from pathlib import Path
from typing import Annotated, Any
from urllib.parse import unquote

import orjson
from fastapi import FastAPI, Response
from pydantic import TypeAdapter
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from app.extras import require
from app.service.negotiation import GZIPPED, accepted, tags_in
from app.service.problems import CLOSE, Refused
from app.wire.fields import LABELLED, extra_of
from app.wire.labels import labels_of
from app.wire.problem import PROBLEM_TYPE
from app.wire.question import JSON
from core.language import COMPILED, ROOM, Language, catalogues, phrase, say, sense, speaking

PAGE = Path(__file__).parent.parent / "page"
GUIDE = Path(__file__).parent.parent / "guide"
INLINE = re.compile(rb"<script(?![^>]*\ssrc=)[^>]*>(.+?)</script>", re.DOTALL)
# Swagger UI comes from a pip package; its start script is a separate file because the policy forbids inline scripts.
DOCS = b"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Bench Dragon: all calls</title>
<link rel="stylesheet" href="docs/assets/swagger-ui.css">
<link rel="icon" href="docs/assets/favicon-32x32.png">
</head>
<body>
<p><a href=".">Bench Dragon</a></p>
<div id="calls"></div>
<script src="docs/assets/swagger-ui-bundle.js"></script>
<script src="docs/start.js"></script>
</body>
</html>
"""
DOCS_START = b'SwaggerUIBundle({ url: "openapi.json", dom_id: "#calls", deepLinking: true });\n'
# Swagger UI and the guide use inline styles and icons from data: addresses, and the guide has a search form.
POLICY = (
    "default-src 'self'; base-uri 'none'; frame-ancestors 'none'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:"
)
DOCS_POLICY = f"{POLICY}; form-action 'none'"
PYTHON = (".py", ".pyc")
# Files that gzip makes smaller.
TEXT = ("text/", "application/javascript", "application/json", "image/svg")
# In the scripts of the page: its sentences are among the literals; one with a meaning; imports of other scripts.
LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"')
SENSE = re.compile(r'\bsense\("([^"]+)", "([^"]+)"')
IMPORT = re.compile(r'^(?:import|export) .*?"(\.{1,2}/[\w./-]+\.js)";$', re.MULTILINE)
# In its HTML: an element whose text is a sentence, and a label.
TEXT_MARK = re.compile(r"(<[^<>]*\bdata-text)(?=[\s>])([^<>]*>)([^<>]+)(?=</)")
LABEL_MARK = re.compile(r'\bdata-label="([^"]+)"')
# Texts of a language for the page: those of its first view, of the parts that load later, of "How it works"; and the
# labels of the columns of sweeps, in English too.
CATALOGUE = re.compile(r"words/(\w+)-(first|more|how|columns)\.json")
# For files whose address changes with their content: a year, the longest time that caches heed.
KEPT = "public, max-age=31536000, immutable"
# Pages whose addresses a person follows: a too long one is answered in sentences, by its language.
FOLLOWED = ("/", "/how")
# Title, what is wrong, what happens to what the address held, and the words of a link to the page.
TOO_LONG = (
    phrase("This address is too long"),
    phrase("The address has {got:,} characters after its question mark; at most {most:,} can be read."),
    phrase("Save a large drawing as a file and send that instead of its address."),
    phrase("Open the page as it begins"),
)
# The same of an installation whose guide is not made.
NO_GUIDE = (
    phrase("This installation has no guide"),
    phrase("The command “make docs” makes it in a minute or two."),
    phrase("Then load this page again."),
    phrase("Open Bench Dragon"),
)
SENTENCES = """<!doctype html>
<html lang="{tag}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{0}</title>
<script src="{up}page/theme.js"></script>
<link rel="stylesheet" href="{up}page/style.css">
<link rel="stylesheet" href="{up}page/how.css">
</head>
<body>
<main class="article">
<h1>{0}</h1>
<p>{1}</p>
<p>{2}</p>
<p><a href="{up}">{3}</a></p>
</main>
</body>
</html>
"""
# Descriptions kept in memory, one for each path under which proxies show the service.
ROOTS = 8
# Files kept in memory: those of the page, of uPlot and of Swagger UI are about 70.
KEPT_FILES = 256
# The button of English, after which those of the other languages stand, and that of any language.
ENGLISH_BUTTON = '<button type="button" lang="en" data-lang="en">English</button>'
BUTTON = '\n      <button type="button" lang="{tag}" data-lang="{code}">{name}</button>'
# What the page knows of the fields of its questions.
FIELDS_MARK = '<meta name="fields">'
# Tags of languages whose catalogues have another name in HTML.
TAGS = {"zh": "zh-Hans"}


@lru_cache(KEPT_FILES)
def _forms(content: bytes, kind: str) -> tuple[str, bytes | None]:
    """Tag of a content, and its gzip if that is smaller."""
    packed = gzip.compress(content, mtime=0) if kind.startswith(TEXT) else content
    tag = hashlib.blake2b(content, digest_size=8).hexdigest()
    return tag, packed if len(packed) < len(content) else None


def reply_with(request: Headers, content: bytes, kind: str) -> Response:
    """A file in a form that the client accepts; 304 if the client has it. Its tag depends on content and form."""
    tag, packed = _forms(content, kind)
    headers = {"ETag": f'"{tag}"', "Vary": "Accept-Encoding"}
    if packed is not None and accepted(request.get("accept-encoding", "identity"), ["identity", "gzip"]) == "gzip":
        content = packed
        headers |= {"ETag": f'"{tag}{GZIPPED}"', "Content-Encoding": "gzip"}
    known = tags_in(request.get("if-none-match", ""))
    if headers["ETag"] in known or "*" in known:
        return Response(status_code=304, headers={name: headers[name] for name in ("ETag", "Vary")})
    return Response(content, headers=headers, media_type=kind)


@lru_cache(KEPT_FILES)
def _content(path: str, changed: int) -> bytes:
    """Content of a file. changed: time of its last change [ns]"""
    return Path(path).read_bytes()


@lru_cache(1)
def _digest(files: tuple[tuple[str, int], ...]) -> str:
    digest = hashlib.blake2b(digest_size=8)
    for path, changed in files:
        digest.update(_content(path, changed))
    return digest.hexdigest()


class Files(StaticFiles):
    """Files of a page, without the Python file that makes their folder a package."""

    def edition(self) -> str:
        """Name of the current files, which changes with their content; equal files have it on every machine."""
        return _digest(tuple((path, os.stat(path).st_mtime_ns) for path in self.paths() if not path.endswith(PYTHON)))

    def paths(self) -> list[str]:
        """All files that change what a page shows."""
        folders = [folder for place in self.all_directories for folder in sorted(os.walk(place))]
        return [os.path.join(folder, name) for folder, _, names in folders for name in sorted(names)]

    def lookup_path(self, path: str) -> tuple[str, os.stat_result | None]:
        return ("", None) if path.endswith(PYTHON) else super().lookup_path(path)

    async def get_response(self, path: str, scope: Scope) -> Response:
        """raises: HTTPException 405 for another method, 404 for a path that is not a file"""
        if scope["method"] not in ("GET", "HEAD"):
            raise HTTPException(status_code=405)
        edition = scope["path_params"].get("edition")
        return await run_in_threadpool(self._response, path, Headers(scope=scope), edition)

    def content(self, path: str) -> tuple[bytes, str]:
        """A file and its media type. raises: HTTPException 404 for a path that is not a file"""
        try:
            file, stat = self.lookup_path(path)
        except (OSError, ValueError) as error:  # a name that no file can have
            raise HTTPException(status_code=404) from error
        if stat is None or not os.path.isfile(file):
            raise HTTPException(status_code=404)
        return _content(file, stat.st_mtime_ns), guess_type(file)[0] or "text/plain"

    def _response(self, path: str, headers: Headers, edition: str | None) -> Response:
        response = reply_with(headers, *self.content(path))
        if edition and edition == self.edition():
            response.headers["Cache-Control"] = KEPT
        return response


class Page(Files):
    """The files of the page. Its HTML has the texts that its modules would write, seconds later on a slow line."""

    def written(self, name: str, language: str) -> tuple[bytes, str]:
        """A page in a language, and its media type."""
        return _written(self, name, language, self.edition()), "text/html"

    def paths(self) -> list[str]:
        return super().paths() + sorted(str(file) for file in files(ROOM).iterdir() if file.name.endswith(COMPILED))

    def content(self, path: str) -> tuple[bytes, str]:
        part = CATALOGUE.fullmatch(path)
        if part and part[2] == "columns" and part[1] in list(Language):
            return _columns(part[1]), JSON
        if part and part[1] in catalogues():
            return _texts(self, part[1], part[2], self.edition()), JSON
        return super().content(path)

    def text(self, name: str) -> str:
        return self.content(name)[0].decode()

    def modules(self, name: str) -> set[str]:
        """A script of the page, and those that load with it."""
        found, due = set[str](), [name]
        while due:
            if (script := due.pop()) not in found:
                found.add(script)
                near = os.path.dirname(script)
                due += [os.path.normpath(os.path.join(near, one)) for one in IMPORT.findall(self.text(script))]
        return found


@cache
def _fields() -> dict[str, dict[str, Any]]:
    """Labels and hints of fields, and of those with a hint [least, most, unit]."""
    labels, hints = (
        {k: text for k, field in LABELLED.items() if (text := extra_of(field, w))} for w in ("label", "hint")
    )
    limits = {}
    for name in hints:
        kind: Any = Annotated[LABELLED[name].annotation, LABELLED[name]]
        schema = TypeAdapter(kind).json_schema()
        schema |= schema.get("anyOf", [{}])[0]
        least = schema.get("minimum", schema.get("exclusiveMinimum"))
        limits[name] = [least, schema["maximum"], schema.get("x-unit", "")]
    return {"labels": labels, "hints": hints, "limits": limits}


def _sentences(page: Page, names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Meanings, empty without one, and texts of these files that may be in a catalogue."""
    for name in names:
        text = page.text(name)
        if name.endswith(".html"):
            yield from (("", html.unescape(mark[2])) for mark in TEXT_MARK.findall(text))
            yield from (("", html.unescape(label)) for label in LABEL_MARK.findall(text))
            yield from (("", words) for words in (*_fields()["labels"].values(), *_fields()["hints"].values()))
        else:
            yield from SENSE.findall(text)
            yield from (("", json.loads(literal)) for literal in LITERAL.findall(text) if "\\" not in literal)


@lru_cache(8)
def _texts(page: Page, language: str, part: str, edition: str) -> bytes:
    """The sentences of a part of the page, with their texts in a language."""
    first = page.modules("main.js") | {"index.html"}
    how = page.modules("how/main.js") | {"how.html"}
    scripts = {file.name for file in PAGE.glob("*.js")}
    names = {"first": first, "how": how, "more": scripts - first}[part]
    with speaking(language):
        said = [
            (meaning, text, sense(meaning, text) if meaning else say(text))
            for meaning, text in _sentences(page, sorted(names))
            if text
        ]
    return orjson.dumps({f"{meaning}\4{text}".lstrip("\4"): words for meaning, text, words in said if words != text})


@cache
def _columns(language: str) -> bytes:
    """The labels of the columns in tables of sweeps, as texts of the page."""
    from app.sweeps.questions import QUESTIONS  # No other file of the page needs it.

    with speaking(language):
        labels = labels_of(form.answer for forms in QUESTIONS.values() for form in forms)
    return orjson.dumps({f"column\4{name}": words for name, words in labels.items()})


@lru_cache(8)
def _written(page: Page, name: str, language: str, edition: str) -> bytes:
    def translated(mark: re.Match[str]) -> str:
        english = html.unescape(mark[3])
        return f'{mark[1]}="{html.escape(english)}"{mark[2]}{html.escape(say(english), quote=False)}'

    text, buttons = page.text(name), ENGLISH_BUTTON
    if language != Language.ENGLISH:
        with speaking(language):
            text = TEXT_MARK.sub(translated, text)
        text = text.replace('<html lang="en">', f'<html lang="{TAGS.get(language, language)}">')
    for code in catalogues():
        with speaking(code):
            buttons += BUTTON.format(tag=TAGS.get(code, code), code=code, name=sense("language", "English"))
    known = f'{FIELDS_MARK[:-1]} content="{html.escape(orjson.dumps(_fields()).decode())}">'
    text = text.replace(ENGLISH_BUTTON, buttons).replace(FIELDS_MARK, known)
    return text.replace('"page/', f'"page-{edition}/').encode()


def language_of(request: Request) -> str:
    """The language of a page as the page chooses it: that of its address, or that of the browser, or English."""
    wanted = request.query_params.get("lang") or request.headers.get("accept-language", "")
    code = wanted.lower().partition("-")[0].partition(",")[0].partition(";")[0].strip()
    return code if code in catalogues() else Language.ENGLISH.value


def long_address(request: Request, got: int, most: int) -> Response | None:
    """The answer (414) to a person who followed a too long address of a page; None for a program, or another path.

    got: length of the query; most: the largest one that is read
    """
    if request.url.path not in FOLLOWED or not is_person(request):
        return None
    return sentences_page(request, 414, TOO_LONG, CLOSE, got=got, most=most)


def is_person(request: Request) -> bool:
    """True if a page answers the request better than a problem."""
    return accepted(request.headers.get("accept"), [PROBLEM_TYPE, "text/html"]) == "text/html"


def sentences_page(
    request: Request, status: int, templates: Iterable[str], headers: Mapping[str, str], **values: int
) -> Response:
    """A page of some sentences. templates: as in TOO_LONG; values: in them"""
    language = language_of(request)
    with speaking(language):
        sentences = [say(template, **values) for template in templates]
    path = request.scope["path"].removeprefix(request.scope["root_path"].removesuffix("/guide"))
    up = "../" * (path.count("/") - 1) or "./"
    text = SENTENCES.format(*sentences, tag=TAGS.get(language, language), up=up)
    kept = {**headers, "Cache-Control": "no-store", "Vary": "Accept, Accept-Language"}
    return Response(text, status, kept, media_type="text/html")


class Guide(Files):
    """The pages of the documentation as `make docs` makes them, also while the service runs."""

    async def check_config(self) -> None:
        """Nothing: get_response() says where there is no guide."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """raises: HTTPException 404 for a path that is not a file, with the command that makes the guide"""
        if GUIDE.is_dir():
            return await super().get_response(path, scope)
        request = Request(scope)
        if is_person(request):
            return sentences_page(request, 404, NO_GUIDE, {})
        raise Refused(404, "This installation has no guide: make docs makes it.")

    def _response(self, path: str, headers: Headers, edition: str | None) -> Response:
        content, kind = self.content("index.html" if path == "." else path)
        response = reply_with(headers, content, kind)
        if kind == "text/html":
            response.headers["Content-Security-Policy"] = guide_policy(content)
        return response


@lru_cache(KEPT_FILES)
def guide_policy(page: bytes) -> str:
    """What a browser may load for a page of the guide; the short scripts in the page are named by their digests."""
    digests = sorted({b64encode(hashlib.sha256(script).digest()).decode() for script in INLINE.findall(page)})
    scripts = " ".join(["script-src 'self'", *(f"'sha256-{digest}'" for digest in digests)])
    return f"{POLICY}; form-action 'self'; {scripts}"


def add_pages(app: FastAPI) -> None:
    """The pages for people and where their files are, and the description of all calls."""

    @lru_cache(ROOTS)
    def description(root: str) -> bytes:
        servers = [{**server, "url": root or server["url"]} for server in app.servers]
        return orjson.dumps(app.openapi() | {"servers": servers})

    @app.get("/docs", include_in_schema=False)
    async def docs(request: Request) -> Response:
        response = reply_with(request.headers, DOCS, "text/html")
        response.headers["Content-Security-Policy"] = DOCS_POLICY
        return response

    @app.get("/docs/start.js", include_in_schema=False)
    async def docs_start(request: Request) -> Response:
        return reply_with(request.headers, DOCS_START, "text/javascript")

    @app.get("/openapi.json", include_in_schema=False)
    async def described(request: Request) -> Response:
        return reply_with(request.headers, description(request.scope["root_path"]), JSON)

    own = Page(directory=PAGE, packages=[("uplot", "static")])

    def page(request: Request, name: str) -> Response:
        response = reply_with(request.headers, *own.written(name, language_of(request)))
        response.headers["Vary"] += ", Accept-Language"
        return response

    @app.get("/", include_in_schema=False)
    def index(request: Request) -> Response:
        return page(request, "index.html")

    @app.get("/how", include_in_schema=False)
    def how(request: Request) -> Response:
        return page(request, "how.html")

    @app.get("/carrier-worker.js", include_in_schema=False)
    def worker(request: Request) -> Response:
        """The worker of a carrier's card, whose place says which pages it may answer for."""
        return reply_with(request.headers, *own.content("carrier_worker.js"))

    @app.get("/code.svg", include_in_schema=False)
    def code(request: Request) -> Response:
        """The QR code of the address that the query is; 404 for one too long for a phone to read."""
        require("paper", "code", "A QR code")
        from app.files.codes import code_on_screen

        picture = code_on_screen(unquote(request.url.query))
        if picture is None:
            raise HTTPException(status_code=404)
        return reply_with(request.headers, picture, "image/svg+xml")

    @app.get("/guide", include_in_schema=False)
    async def guide() -> Response:
        return RedirectResponse("guide/")

    app.mount("/guide", Guide(directory=GUIDE, check_dir=False))
    app.mount("/docs/assets", Files(packages=[("fastapi_swagger", "resources")]))
    app.mount("/page-{edition}", own)
    app.mount("/page", own)
