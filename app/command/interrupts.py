"""Ctrl-C in the command."""

from __future__ import annotations

from types import FrameType


class Interrupts:
    """Ctrl-C, which a library may catch where it comes: in a destructor, in an import, in what it is called back by."""

    def __init__(self) -> None:
        self.came = False

    def take(self, number: int, frame: FrameType | None) -> None:
        """The handler of the signal. raises: KeyboardInterrupt"""
        self.came = True
        raise KeyboardInterrupt

    def heed(self) -> None:
        """Called now and then by what takes long. raises: KeyboardInterrupt if one came, so that none is lost"""
        if self.came:
            raise KeyboardInterrupt


interrupts = Interrupts()
