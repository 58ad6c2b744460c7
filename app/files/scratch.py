"""Temporary folders of this program, and the end of those whose processes were killed.

    TMPDIR/bench-dragon-KIND...   a folder; alive.lock in it is locked while its process lives

A folder is removed when all locks in it are free: its own, and those of jobs in it, whose processes may outlive the one
that made the folder. A folder without a lock is not touched.
"""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from app.files.lock import FolderLock

PREFIX, ALIVE = "bench-dragon-", "alive"
# Number of folders that are tried: another process may take one for left, before it is locked.
TRIES = 5


@contextmanager
def temporary(kind: str = "") -> Iterator[str]:
    """A new temporary folder, which is removed after the context; first, those that killed processes left are removed.

    kind: a word for its name
    raises: OSError
    """
    reclaim()
    folder, lock = _locked(f"{PREFIX}{kind}")
    try:
        yield folder
    finally:
        lock.give_back()
        shutil.rmtree(folder, ignore_errors=True)


def _locked(prefix: str) -> tuple[str, FolderLock]:
    for _ in range(TRIES):
        folder = tempfile.mkdtemp(prefix=prefix)
        lock = FolderLock(Path(folder), ALIVE)
        with suppress(OSError):
            if lock.take():
                return folder, lock
        shutil.rmtree(folder, ignore_errors=True)
    raise OSError(errno.EACCES, os.strerror(errno.EACCES), tempfile.gettempdir())


def reclaim() -> list[Path]:
    """Remove the temporary folders of this user whose processes were killed, and return them."""
    gone = []
    with suppress(OSError):
        for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
            with suppress(OSError):
                if _is_ours(folder) and _is_left(folder):
                    gone.append(folder)
    return gone


def _is_ours(folder: Path) -> bool:
    mine = os.getuid() if hasattr(os, "getuid") else 0  # On Windows each user has a folder of temporary files.
    return folder.is_dir() and not folder.is_symlink() and folder.stat().st_uid == mine


def _is_left(folder: Path) -> bool:
    """True if no process uses the folder, which then is removed."""
    locks = [FolderLock(folder, file.stem) for file in folder.glob("*.lock")]
    with ExitStack() as held:
        for lock in locks:
            held.callback(lock.give_back)
            if not lock.take():
                return False
        if locks:
            shutil.rmtree(folder, ignore_errors=True)
    return bool(locks)
