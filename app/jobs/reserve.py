"""Reserve of room on the disk: SQLite writes its log before it removes a job, also when the disk is full."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

# Size of the reserve and of its pieces [bytes]: the removal of a job with 100 events writes 0.1 MB ahead.
RESERVED, PIECE = 1 << 18, 1 << 12


class Reserve:
    """A file of random bytes, which is removed when a change needs its room and written again afterwards."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self._fill()

    @contextmanager
    def released(self) -> Iterator[None]:
        """Context of a change that must be possible on a full disk."""
        if shutil.disk_usage(self.file.parent).free < RESERVED:
            self.file.unlink(missing_ok=True)
        try:
            yield
        finally:
            self._fill()

    def _fill(self) -> None:
        """Write as much of the file as fits on the disk; the next call writes the rest."""
        with suppress(OSError), self.file.open("ab", buffering=0) as file:
            while file.tell() < RESERVED:
                file.write(os.urandom(PIECE))  # Zeros would take no room on a disk that compresses.
