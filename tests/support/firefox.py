"""A real Firefox for the tests of the page, driven by WebDriver BiDi, which it speaks itself.

Playwright drives only a Firefox of its own making, and Debian 12 has no geckodriver. So this is the part of BiDi that
the tests need. An error of a page ends its test.
"""

import json
import os
import re
import shutil
import subprocess
import time
from contextlib import contextmanager
from functools import cache

from websockets.sync.client import connect

from tests.support.browser import version_of
from tests.support.pending import QUIET

NAMES = ("firefox-esr", "firefox")
MISSING = "no Firefox starts here: apt install firefox-esr, or set FIREFOX to the path of one"
# Longest wait for the browser, and for what is coming on a page [s].
PATIENCE = 120.0
LISTENS = re.compile(r"WebDriver BiDi listening on ws://127\.0\.0\.1:(\d+)")
# Files are saved without a question, and Firefox asks nobody else for anything.
SETTINGS = {
    "browser.download.folderList": 2,
    "browser.download.useDownloadDir": True,
    "browser.download.always_ask_before_handling_new_types": False,
    "browser.helperApps.neverAsk.saveToDisk": "text/csv,application/zip,image/svg+xml,application/octet-stream",
    "intl.accept_languages": "en-GB,en",
    "app.update.auto": False,
    "browser.aboutwelcome.enabled": False,
    "datareporting.policy.dataSubmissionEnabled": False,
}


@cache
def firefox_path():
    """Path of the first Firefox that reports its version. Ubuntu's command only says that a snap is missing."""
    programs = filter(None, [os.environ.get("FIREFOX"), *map(shutil.which, NAMES)])
    return next((program for program in programs if "Firefox" in version_of(program)), None)


class Firefox:
    """One tab. downloads: folder of saved files; errors: what the pages complained of"""

    def __init__(self, port, downloads):
        self.downloads = downloads
        self.errors = list[str]()
        self._socket = connect(f"ws://127.0.0.1:{port}/session", proxy=None, open_timeout=PATIENCE, max_size=None)
        self._number = 0
        self._ask("session.new", capabilities={})
        self._ask("session.subscribe", events=["log.entryAdded"])
        self._tab = self._ask("browsingContext.getTree")["contexts"][0]["context"]

    def _ask(self, method, **params):
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "method": method, "params": params}))
        while True:
            message = json.loads(self._socket.recv(PATIENCE))
            if message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                self.errors.append(message["params"]["text"])
            if message.get("id") == self._number:
                assert message["type"] == "success", message
                return message["result"]

    def open(self, url):
        self._ask("browsingContext.setViewport", context=self._tab, viewport={"width": 1366, "height": 900})
        self._ask("browsingContext.navigate", context=self._tab, url=url, wait="complete")

    def evaluate(self, expression):
        """Value of a JavaScript expression, which may be a promise."""
        code = f"(async () => JSON.stringify((await ({expression})) ?? null))()"
        answer = self._ask("script.evaluate", expression=code, target={"context": self._tab}, awaitPromise=True)
        assert answer["type"] == "success", answer.get("exceptionDetails")
        return json.loads(answer["result"]["value"])

    def wait(self, expression):
        """Value of an expression as soon as it is true."""
        end = time.monotonic() + PATIENCE
        while not (value := self.evaluate(expression)):
            assert time.monotonic() < end, expression
            time.sleep(0.1)
        return value

    def _middle(self, selector):
        one = f"document.querySelector({json.dumps(selector)})"
        # What comes into sight may be asked for then, and move what stands below it.
        self.evaluate(f"{one}.scrollIntoView({{ block: 'center' }})")
        self.evaluate(f"({QUIET})(null)")
        place = f"""(() => {{
          const one = {one};
          one.scrollIntoView({{ block: "center" }});
          const {{ left, top, width, height }} = one.getBoundingClientRect();
          return [Math.round(left + width / 2), Math.round(top + height / 2)];
        }})()"""
        x, y = self.evaluate(place)
        return x, y

    def drag(self, selector, right=0, down=0, *, at=(0, 0)):
        """Press the mouse on the middle of an element, or beside it, move it by pixels, and release it."""
        x, y = (one + off for one, off in zip(self._middle(selector), at, strict=True))
        steps = [{"type": "pointerMove", "x": x + right * k // 4, "y": y + down * k // 4} for k in range(1, 5)]
        moves = steps if right or down else []
        press = [{"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0}]
        actions = [*press, *moves, {"type": "pointerUp", "button": 0}]
        self._act({"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions})

    def click(self, selector, at=(0, 0)):
        self.drag(selector, at=at)

    def press(self, key):
        actions = [{"type": kind, "value": key} for kind in ("keyDown", "keyUp")]
        self._act({"type": "key", "id": "keys", "actions": actions})

    def _act(self, actions):
        self._ask("input.performActions", context=self._tab, actions=[actions])

    def saved(self, name):
        """The content of a file that the page saves, once it is there."""
        end = time.monotonic() + PATIENCE
        file = self.downloads / name
        while not file.is_file() or not file.stat().st_size or list(self.downloads.glob("*.part")):
            assert time.monotonic() < end, name
            time.sleep(0.1)
        return file.read_bytes()

    def close(self):
        self._socket.close()


@contextmanager
def running_firefox(folder):
    """A Firefox without windows that keeps its profile and its downloads in a folder."""
    program = firefox_path()
    assert program, MISSING
    profile = folder / "profile"
    downloads = folder / "downloads"
    for place in (profile, downloads):
        place.mkdir()
    lines = {**SETTINGS, "browser.download.dir": str(downloads)}
    text = "".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in lines.items())
    (profile / "user.js").write_text(text, encoding="utf-8")
    command = [program, "--headless", "--no-remote", "--profile", str(profile), "--remote-debugging-port", "0"]
    log = folder / "firefox.log"
    with log.open("w") as sink:
        process = subprocess.Popen(command, stdout=sink, stderr=sink, env=os.environ | {"HOME": str(folder)})
    try:
        end = time.monotonic() + PATIENCE
        while not (match := LISTENS.search(log.read_text(encoding="utf-8", errors="replace"))):
            assert process.poll() is None, log.read_text(encoding="utf-8", errors="replace")
            assert time.monotonic() < end, "Firefox does not listen"
            time.sleep(0.1)
        firefox = Firefox(int(match[1]), downloads)
        try:
            yield firefox
        finally:
            firefox.close()
    finally:
        process.terminate()
        process.wait(PATIENCE)
