"""A Node.js, which runs modules of the page without a browser."""

import json
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

from tests.support.browser import version_of

PAGE = Path(__file__).parents[2] / "app" / "page"
OLDEST = (22, 7)  # the first that takes a module of the page for what it is
MISSING = (
    "they run modules of the page in Node.js: make test-setup installs it, else apt install nodejs (22.7 or later)"
)
PATIENCE = 120.0  # longest wait for a value [s]
# Enough of a document to load any module, and to set the language. Then the value for these arguments, in JSON.
PROGRAM = """
const root = { dataset: {}, lang: "" };
globalThis.document = { documentElement: root, querySelector: () => null, querySelectorAll: () => [] };
const page = (name) => import(%s + name);
let text = "";
for await (const part of process.stdin) text += part;
process.stdout.write(JSON.stringify(await (%s)(...JSON.parse(text))) ?? "null");
"""


@cache
def node_path():
    """Path of a Node.js that is new enough: that of the environment of this Python, or one in PATH."""
    for program in (str(Path(sys.executable).parent / "node"), shutil.which("node")):
        found = re.match(r"v(\d+)\.(\d+)", version_of(str(program)))
        if found and tuple(map(int, found.groups())) >= OLDEST:
            return program
    return None


def evaluate(function, *values):
    """Value of a JavaScript function, which may be asynchronous, for these values.

    In it page("walk.js") is a promise of that module of the page.
    """
    program = PROGRAM % (json.dumps(f"{PAGE.as_uri()}/"), function)
    command = [str(node_path()), "--no-warnings", "--input-type=module", "--eval", program]
    done = subprocess.run(command, input=json.dumps(values), capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
