"""Reserve of room on the disk: SQLite writes its log before it removes a job, also when the disk is full."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

# Size of the reserve and of its pieces [bytes]: the removal of a job with 100 events writes 0.1 MB ahead.
RESERVED, PIECE = 1 << 19, 1 << 12


class Reserve:
    """A file of random bytes, which is removed when a change needs its room and written again afterwards."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self._fill()

    @property
    def is_needed(self) -> bool:
        """True if the disk has too little room for a change that is larger than most."""
        return shutil.disk_usage(self.file.parent).free < RESERVED

    def keep(self, size: int) -> None:
        """Leave the reserve whole. size: of what a change writes [bytes]; raises: OSError if there is no room"""
        if shutil.disk_usage(self.file.parent).free < size:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    @contextmanager
    def released(self) -> Iterator[bool]:
        """Context of a change that must be possible on a full disk; its value: whether it is one."""
        if is_full := self.is_needed:
            self.file.unlink(missing_ok=True)
        try:
            yield is_full
        finally:
            self._fill()

    def _fill(self) -> None:
        """Write as much of the file as fits on the disk; the next call writes the rest."""
        with suppress(OSError), self.file.open("ab", buffering=0) as file:
            while file.tell() < RESERVED:
                file.write(os.urandom(PIECE))  # Zeros would take no room on a disk that compresses.
