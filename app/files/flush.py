"""Files and their names, safe on the disk."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

# Permissions of a new file, before the user's mask.
NEW_FILE = 0o666


@contextmanager
def new_file(folder: Path, prefix: str, target: Path | None = None) -> Iterator[BinaryIO]:
    """A new file in a folder, safe on the disk after the context; it then replaces the target in one step, if any.

    An existing target keeps its mode. Nothing remains of a file that is not complete.
    raises: OSError
    """
    handle, name = tempfile.mkstemp(prefix=prefix, dir=folder)
    try:
        with open(name, "wb", opener=lambda *_: handle) as file:
            yield file
            if target is not None:
                os.chmod(name, _mode(target))
            file.flush()
            os.fsync(file.fileno())
        if target is not None:
            os.replace(name, target)
    except BaseException:
        with suppress(FileNotFoundError):
            os.unlink(name)
        raise


def _mode(target: Path) -> int:
    """Permissions of a file; of one that is not there, those of new files."""
    with suppress(FileNotFoundError):
        return target.stat().st_mode & 0o7777
    mask = os.umask(0)
    os.umask(mask)
    return NEW_FILE & ~mask


def flush_folder(folder: Path) -> None:
    """Flush the names of a folder to the disk, if the system supports it."""
    if os.name == "nt":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
