"""Engines answer pieces of shards, in whatever order. Files are the truth, so an engine is disposable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from app.sweeps.shards import Piece
from core import BenchDragonError

# Pieces submitted and not answered yet, for each worker.
WINDOW = 4


@dataclass(frozen=True, slots=True)
class Done:
    """A piece and its rows as an Arrow stream; None: the process that had it died."""

    piece: Piece
    rows: bytes | None


class NoAnswer(BenchDragonError):
    """A worker failed at a whole piece, not at one of its designs: it lacks something, or the mistake is ours."""

    code = "no-answer"


class NoScheduler(BenchDragonError):
    """Nobody answers at the address of a cluster."""

    code = "no-scheduler"


def attempt(piece: Piece) -> tuple[bytes | None, str]:
    """Rows of a piece, else why there are none: errors with fields of their own do not travel between processes."""
    try:
        return piece.answered(), ""
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"


def arrived(piece: Piece, attempted: tuple[bytes | None, str]) -> Done:
    """The result of attempt(). raises: NoAnswer"""
    rows, why = attempted
    if rows is None:
        raise NoAnswer("workers", f"workers cannot answer: {why}")
    return Done(piece, rows)


class Engine(Protocol):
    """Where pieces are answered.

    alone: a process has one piece at a time, so that if it dies the piece is the cause or the process was killed
    """

    alone: bool

    @property
    def workers(self) -> int:
        """Number of pieces that are answered at the same time now; at least 1."""

    def submit(self, piece: Piece) -> None:
        """Take a piece."""

    def wait(self, seconds: float) -> list[Done]:
        """Pieces answered since the last call; waits for one, up to a time limit."""

    def close(self) -> None:
        """End the engine; unanswered pieces are lost."""
