"""Version of the package and of its code."""

from __future__ import annotations

import hashlib
import sys
from functools import cache
from importlib.metadata import version
from pathlib import Path

VERSION = version("bench-dragon")
# Packages on whose bytes the answers depend.
PACKAGES = tuple(Path(__file__).parents[2] / name for name in ("core", "app"))


@cache
def build() -> str:
    """Digest of the installed code, part of every tag: a new build, or another library, may give other bytes."""
    installed = {one.name for place in filter(None, sys.path) for one in Path(place).glob("*.dist-info")}
    digest = hashlib.blake2b("\n".join((VERSION, *sorted(installed))).encode(), digest_size=16)
    for package in PACKAGES:
        for file in sorted(path for path in package.rglob("*") if path.suffix in (".py", ".so", ".pyd")):
            digest.update(file.relative_to(package).as_posix().encode() + b"\n" + file.read_bytes())
    return digest.hexdigest()
