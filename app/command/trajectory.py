"""The tables of the command bench-dragon trajectory, as many instants as fit a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from pydantic import Field
from rich.cells import cell_len

import core
from app.command import show
from app.command.asked import command_of
from app.files import tables
from app.files.tables import PAPER_HANDLES
from app.questions.trajectory import QUESTION, TrajectoryRequest
from app.wire.fields import Wire
from app.wire.labels import DISPLAY_DECIMALS, Part, TextTable
from app.wire.numbers import numbers_of
from app.wire.question import Terms
from core import Dragon, InvalidValue, RunEnd, Trajectory
from core.language import counted, say

# Largest number of instants that a terminal shows, if that many fit.
PRINTED_INSTANTS = 7
# In a run that ends in a fold: a handle this many times faster than the head shows that the fold is near [1]; and the
# mark of such an instant.
FAST = 2.0
NEAR_FOLD = " *"
# With at least this many instants, even spacing is preferred to one or two instants more.
EVEN_INSTANTS = 5


class Rows(Wire):
    """The rows of the tables."""

    handles: str | None = Field(
        None, description="Handles in the table, such as 0,1,51; default: those that the contest asks for"
    )


def _printed(request: TrajectoryRequest, terms: Terms, handles: str | None) -> Iterator[Part]:
    """Tables of a dragon, or of each of several. handles: those to show, as in Rows"""
    cells_max, is_list = terms.settings.cells_max, isinstance(request.times, list)
    if request.dances is None:
        dance = request.to_dance(terms.settings.benches_max)
        rows = _handles(handles, dance.dragon)
        result = core.trajectory(dance, request.times_of(dance, cells_max))
        look = _Look("", is_list, request.decimals, dance.end if dance.end.bench is not None else None)
        yield from _parts(result, rows, tables.own_names(result), look)
        return
    performance = request.to_performance(terms.settings)
    dragons = [part.dance.dragon for part in performance.parts]
    rows = _handles(handles, min(dragons, key=lambda dragon: dragon.benches))
    results = core.trajectory(performance, request.times_of(performance, cells_max))
    for k, (part, result) in enumerate(zip(performance.parts, results, strict=True)):
        fold = replace(part.dance.end, time=part.end) if part.folds else None
        names = tables.own_names(result, own=dragons[k].names)
        look = _Look(f"{performance.name_of(k)}: ", is_list, request.decimals, fold)
        yield from _parts(result, rows, names, look)


def _handles(text: str | None, dragon: Dragon) -> list[int] | None:
    """The handles in an option; None without the option. raises: InvalidValue"""
    if text is None:
        return None
    handles = numbers_of("handles", text, int)
    for k, handle in enumerate(handles):
        if not 0 <= handle <= dragon.benches:
            rule = "must be from 0 to {last} for this dragon"
            raise InvalidValue(f"handles.{k}", rule, got=handle, last=dragon.benches)
    return handles


@dataclass(frozen=True, slots=True)
class _Look:
    """The look of tables.

    title: what stands before the titles; decimals: of every number; None: DISPLAY_DECIMALS
    all_instants: all instants, in as many tables as needed; else up to PRINTED_INSTANTS, evenly spaced, in one table
    fold: end of the run, if it is a fold; instants just before it are marked, as speeds grow without bound there
    """

    title: str
    all_instants: bool
    decimals: int | None
    fold: RunEnd | None


def _parts(result: Trajectory, handles: Sequence[int] | None, names: Sequence[str], look: _Look) -> Iterator[Part]:
    """Tables of some handles at some instants.

    handles: those to show; None: those of the contest and the last; names: of all handles
    """
    fold, all_instants = look.fold, look.all_instants
    instants, number = result.speed.shape
    rows = list(handles) if handles else sorted({k for k in PAPER_HANDLES if k < number} | {number - 1})
    labels = [f"{k} {names[k]}" for k in rows]
    x, y = result.position[..., 0], result.position[..., 1]
    places = DISPLAY_DECIMALS if look.decimals is None else look.decimals
    instant_names = [_instant(result, t, fold) for t in range(instants)]
    widest = max(map(cell_len, [*labels, say("handle")]))
    room = show.new_console().width - show.TABLE_SPACE - show.COLUMN_SPACE - widest
    blocks = _blocks(result, rows, instant_names, room, all_instants, places)
    for what, values in (("x [m]", x), ("y [m]", y), (say("speed [m/s]"), result.speed)):
        for block in blocks:
            table = TextTable(f"{look.title}{what}", say("handle"), *(instant_names[t] for t in block))
            for k, label in zip(rows, labels, strict=True):
                table.add(label, *(_entry(value, places) for value in values[block, k]))
            yield table
    count = sum(map(len, blocks))
    of_handles = counted(number, "{rows} of {count} handle", "{rows} of {count} handles", rows=len(rows))
    of_instants = counted(instants, "{shown} of {count} instant", "{shown} of {count} instants", shown=count)
    texts = {"handles": of_handles, "instants": of_instants}
    choosing = [name for name, chosen in (("--handles", handles is not None), ("--times", all_instants)) if not chosen]
    if choosing:
        choose = counted(
            len(choosing),
            "{options} chooses",
            "{options} choose",
            options=" ".join(choosing) if len(choosing) == 1 else say("--handles and --times"),
        )
        yield say("{handles}, {instants}: --output has all, {choose}.", **texts, choose=choose)
    else:
        yield say("{handles}, {instants}: --output has all.", **texts)
    if fold and any(instant_names[t].endswith(NEAR_FOLD) for block in blocks for t in block):
        yield say(
            "{mark} Just before bench {bench} folds, at {time:.9f} s: towards that instant the speeds of handles "
            "behind it grow without bound.",
            mark=NEAR_FOLD.strip(), bench=fold.bench, time=fold.time,
        )  # fmt: skip


def _blocks(
    result: Trajectory, rows: Sequence[int], names: Sequence[str], room: int, all_instants: bool, decimals: int
) -> list[list[int]]:
    """The instants of each table, as many as fit into the room [characters]. names: of the instants"""
    instants = len(result.time)
    values = np.concatenate([result.position[:, rows].reshape(instants, -1), result.speed[:, rows]], axis=1)

    def width(t: int) -> int:
        return show.COLUMN_SPACE + max(map(len, [names[t], *(_entry(value, decimals) for value in values[t])]))

    if not all_instants:
        counts = range(min(PRINTED_INSTANTS, instants), 1, -1)
        even = [count for count in counts if count >= EVEN_INSTANTS and (instants - 1) % (count - 1) == 0]
        for count in (*even, *counts):
            spaced = np.linspace(0, instants - 1, count).round().astype(int).tolist()
            if sum(map(width, spaced)) <= room:
                return [spaced]
        return [[0]] if instants else []
    blocks: list[list[int]] = []
    left = 0
    for t in range(instants):
        taken = width(t)
        if not blocks or taken > left:
            blocks.append([])
            left = room
        blocks[-1].append(t)
        left -= taken
    return blocks


def _instant(result: Trajectory, t: int, fold: RunEnd | None) -> str:
    near = fold is not None and result.speed[t].max() > FAST * result.speed[t, 0]
    return f"{result.time[t]:.12g} s{NEAR_FOLD if near else ''}"


def _entry(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


trajectory = command_of(QUESTION, Rows, _printed)
