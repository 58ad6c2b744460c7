"""The pictures of docs/gallery.md, each made by the lines of Python below it: python docs/site/gallery.py."""

from __future__ import annotations

import doctest
import io
import re
from pathlib import Path

import matplotlib
from PIL import Image

DOCS = Path(__file__).parent.parent
ENTRY = re.compile(r"\]\((gallery/\w+\.png)\)\n\n```python\n(.*?)```", re.DOTALL)
# Large enough for a page, small enough for a repository [dots per inch].
RESOLUTION, COLOURS = 90, 128


def draw() -> None:
    """Draw all pictures into docs/gallery. raises: AssertionError where the lines print something else than shown"""
    matplotlib.use("agg")
    from matplotlib import pyplot

    for name, code in ENTRY.findall((DOCS / "gallery.md").read_text("utf-8")):
        lines = doctest.DocTestParser().get_doctest(code, {}, name, None, 0)
        failed, _ = doctest.DocTestRunner().run(lines)
        assert not failed, name
        picture = io.BytesIO()
        pyplot.gcf().savefig(picture, dpi=RESOLUTION, transparent=False)
        pyplot.close("all")
        Image.open(picture).convert("RGB").quantize(COLOURS, kmeans=2).save(DOCS / name, optimize=True)


if __name__ == "__main__":
    draw()
