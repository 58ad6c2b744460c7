"""Engines: they answer pieces of shards in any order. All results are in files, so an engine may end at any time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from app.sweeps.shards import ShardPiece
from core import BenchDragonError

# Pieces that are submitted but not answered, for each worker.
WINDOW = 4


@dataclass(frozen=True, slots=True)
class Done:
    """A piece and its rows as an Arrow stream; None: its process died."""

    piece: ShardPiece
    rows: bytes | None


class NoAnswer(BenchDragonError):
    """A worker failed at a whole piece, not at one design: a package is missing, or this program has an error."""

    code = "no-answer"


class NoScheduler(BenchDragonError):
    """No scheduler answers at the address of a cluster."""

    code = "no-scheduler"


def attempt(piece: ShardPiece) -> tuple[bytes | None, str]:
    """Rows of a piece, or the reason why there are none: errors with extra fields cannot be sent between processes."""
    try:
        return piece.answer(), ""
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"


def done_of(piece: ShardPiece, attempted: tuple[bytes | None, str]) -> Done:
    """The piece with the rows of its attempt(). raises: NoAnswer"""
    rows, why = attempted
    if rows is None:
        raise NoAnswer("workers", "cannot answer: {why}", why=why)
    return Done(piece, rows)


class SweepEngine(Protocol):
    """The place where pieces are answered.

    alone: True if a process has one piece at a time: if it dies, the piece is the cause, or a kill from outside
    """

    alone: bool

    @property
    def workers(self) -> int:
        """Number of pieces that can be answered at the same time now; at least 1."""

    def submit(self, piece: ShardPiece) -> None:
        """Take a piece."""

    def wait(self, seconds: float) -> list[Done]:
        """Pieces answered since the last call; waits for one, up to a time limit."""

    def close(self) -> None:
        """End the engine; unanswered pieces are lost."""
