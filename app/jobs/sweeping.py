"""The job of a sweep: its shards are in a folder of the job, from which it continues if its process is killed.

The table has the same bytes as that of `bench-dragon sweep` with the same spec.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from app.extras import MissingPackage
from app.files.tables import PARQUET_TYPE
from app.jobs.reports import Reports
from app.jobs.task import Task
from app.settings import Settings
from app.sweeps.call import engine_of
from app.sweeps.engines import NoAnswer, NoScheduler
from app.sweeps.processes import CannotStart
from app.sweeps.run import SPEC_FILE, Progress, run
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep
from app.wire.faults import in_body, refusal_problem
from app.wire.problem import Problem, problem_of
from core import BenchDragonError

# Errors that stop a sweep although its spec is valid.
FAILURES = (CannotStart, MissingPackage, NoAnswer, NoScheduler)
# Longest wait for a scheduler that has not answered yet [s].
FIRST_SECONDS = 60.0


class TooManyBytes(BenchDragonError):
    """The files of a sweep exceed their limit."""

    code = "content-too-large"


def answer_sweep(task: Task, settings: Settings, folder: Path, reports: Reports) -> Path | Problem:
    """File of the table in the format of the task, or the problem of a sweep without one.

    folder: of the shards; existing shards are not answered again
    """
    try:
        spec = Spec.of(task.request)
        _renew(folder, spec)
        engine = engine_of(
            settings.dask or None, settings.sweep_processes, patience=settings.sweep_seconds_max, first=FIRST_SECONDS
        )
        reporting = _Reporting(folder, settings.sweep_bytes_max, reports)
        run(spec, folder, question=spec.asks, engine=engine, progress=reporting)
        reporting.report(Progress(spec.designs, spec.designs, 0.0, None))
        return _table(Sweep(folder, spec), task.form)
    except FAILURES as error:
        return problem_of(503, error.code, "The sweep failed: {why}.", why=error.message)
    except TooManyBytes as error:
        return problem_of(413, error.code, error)
    except BenchDragonError as error:
        return refusal_problem(error, in_body(task.request))
    except OSError as error:
        words = "The sweep could not be written into the data folder: {why}. Make room and ask again."
        return problem_of(507, "insufficient-storage", words, why=str(error.strerror))


class _Reporting:
    """Reports the progress of a run, and ends it when its files exceed their limit."""

    def __init__(self, folder: Path, bytes_max: int, reports: Reports) -> None:
        self.folder, self.bytes_max, self.reports = folder, bytes_max, reports
        self.begun = False

    def __call__(self, progress: Progress) -> None:
        """raises: TooManyBytes"""
        if not self.begun:
            self.begun = True
            self.reports.send(kept=progress.designs)
        if self.reports.is_due():
            self.report(progress)

    def report(self, progress: Progress) -> None:
        """raises: TooManyBytes"""
        size = sum(file.stat().st_size for file in self.folder.glob("*.parquet"))
        if size > self.bytes_max:
            words = "The sweep has {size} bytes after {designs} of {total} designs; the limit is {most} here"
            values = {"size": size, "designs": progress.designs, "total": progress.total, "most": self.bytes_max}
            raise TooManyBytes.in_words("over", f"{words}: ask for fewer designs.", **values)
        share, rate = progress.designs / progress.total, progress.rate / progress.total
        self.reports.send(share=share, rate=rate or None, done=progress.designs, total=progress.total, size=size)


def _renew(folder: Path, spec: Spec) -> None:
    """Remove shards of another version of this program, whose answers may differ."""
    file = folder / SPEC_FILE
    if folder.exists() and not (file.exists() and file.read_bytes() == spec.canonical()):
        shutil.rmtree(folder)


def _table(sweep: Sweep, form: str) -> Path:
    whole = sweep.compact()
    if form == PARQUET_TYPE:
        return whole
    file = sweep.folder / "table"
    sweep.save(file, form)
    return file
