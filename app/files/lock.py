"""A lock that gives a role in a folder to one process at a time; the system frees it when that process dies."""

from __future__ import annotations

import errno
import sqlite3
from pathlib import Path


class FolderLock:
    """A role in a folder, which one of all processes can hold.

    It is the exclusive lock of an empty SQLite database: SQLite can lock a file on every system, and no process that
    the holder starts inherits the lock.
    """

    def __init__(self, folder: Path, role: str) -> None:
        self._file = folder / f"{role}.lock"
        self._held: sqlite3.Connection | None = None

    def take(self, patience: float = 0.0) -> bool:
        """True if this object holds the lock now. patience: longest wait [s]; raises: OSError"""
        if self._held is not None:
            return True
        connection = None
        try:
            connection = sqlite3.connect(self._file, timeout=patience, isolation_level=None, check_same_thread=False)
            connection.execute("PRAGMA journal_mode = MEMORY")  # Nothing is ever written.
            connection.execute("BEGIN EXCLUSIVE")
        except sqlite3.OperationalError as error:
            if connection is not None:
                connection.close()
            if error.sqlite_errorcode == sqlite3.SQLITE_BUSY:
                return False
            raise OSError(errno.EACCES, f"cannot be locked: {error}", str(self._file)) from error
        self._held = connection
        return True

    def give_back(self) -> None:
        if self._held is not None:
            self._held.close()
            self._held = None
