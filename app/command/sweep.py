"""The command bench-dragon sweep."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.cells import cell_len
from rich.console import Console
from rich.progress import BarColumn, TextColumn
from rich.progress import Progress as Bar

from app.command.show import write
from app.command.usage import Commands, path, path_argument
from app.extras import require
from app.files.disk import checked_output
from app.settings import WORKERS_MAX
from core.language import say

if TYPE_CHECKING:
    from app.sweeps.run import Progress

# Width of the names in a summary [characters].
NAME_WIDTH = 24
# Exit code that shells use for a command stopped by Ctrl-C.
INTERRUPTED = 130

Folder = Annotated[Path, path_argument("FOLDER", "Folder of the sweep.")]

sweep = typer.Typer(
    cls=Commands,
    help="One question for many values of its parameters: up to 10^8 designs in a folder, which a later run continues.",
    add_completion=False,
)


@contextmanager
def _bar(what: str, total: int) -> Iterator[Callable[[Progress], None]]:
    """A bar on standard error with rate and time left; yields the function that takes the progress."""
    if not sys.stderr.isatty():
        yield lambda progress: None
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[rate]}"))
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=total, rate="")
        yield lambda progress: bar.update(task, completed=progress.designs, rate=progress.words())


@sweep.command()
def run(
    spec: Annotated[Path, path_argument("FILE", "Question, parameters and their values, .toml or .json.")],
    output: Annotated[
        Path, typer.Option(parser=path, help="Folder for the answers: created if missing, continued if it exists.")
    ],
    dask: Annotated[
        str | None,
        typer.Option(help="Dask scheduler (tcp://...), or local for a cluster here; default: processes here."),
    ] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, max=WORKERS_MAX, help="Processes of this machine; default: one for each core.")
    ] = None,
) -> None:
    """Answer every design that has no answer yet. After Ctrl-C or a crash the same command continues."""
    require("sweep", "sweep", "sweep")
    from app.sweeps.call import engine_of
    from app.sweeps.run import run as run_sweep
    from app.sweeps.spec import Spec

    sweep_spec = Spec.read(spec)
    engine = engine_of(dask, workers)
    with _bar(sweep_spec.question, sweep_spec.designs) as progress:
        try:
            run_sweep(sweep_spec, output, question=sweep_spec.asks, engine=engine, progress=progress)
        except KeyboardInterrupt:
            print(say("Stopped: the same command continues {file}", file=output), file=sys.stderr)
            raise typer.Exit(INTERRUPTED) from None
    words = say("{file}: {spec.designs} designs in {spec.shards} shards", file=output, spec=sweep_spec)
    print(words, file=sys.stderr)


@sweep.command()
def show(
    folder: Folder,
    output: Annotated[Path | None, typer.Option(help="Draw a map into a .svg or .png file.")] = None,
    value: Annotated[str | None, typer.Option(help="Column to show; default: the main value of the question.")] = None,
) -> None:
    """Summary of a sweep, or a map of one value over one or two parameters."""
    require("sweep", "sweep", "sweep")
    ending = checked_output("output", output, (".svg", ".png")) if output else ""
    if output:
        require("figures", "output", "A map")
    from app.sweeps.table import Sweep

    sweep = Sweep.open(folder)
    column = value or sweep.spec.asks.map_column
    if output:
        from app.files.drawing import file_bytes
        from app.sweeps.maps import value_map

        write(output, file_bytes(value_map(sweep, column), ending[1:]))
        return
    from app.sweeps.table import summary

    for name, text in summary(sweep, column).lines():
        print(f"{name}{' ' * (NAME_WIDTH - cell_len(name))} {text}")


@sweep.command()
def compact(
    folder: Folder, csv: Annotated[Path | None, typer.Option(help="Write the table as CSV too.")] = None
) -> None:
    """Join the parts of a complete sweep into one Parquet file."""
    require("sweep", "sweep", "sweep")
    if csv:
        checked_output("csv", csv, (".csv",))
    from app.sweeps.table import Sweep

    sweep = Sweep.open(folder)
    print(sweep.compact(), file=sys.stderr)
    if csv:
        sweep.to_csv(csv)
        print(csv, file=sys.stderr)
