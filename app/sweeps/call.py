"""A sweep as one call in Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from app.extras import require
from app.sweeps.engines import SweepEngine
from app.sweeps.processes import Processes
from app.sweeps.questions import SweepQuestion
from app.sweeps.run import Progress, run
from app.sweeps.spec import Range, Samples, Spec
from app.sweeps.table import Sweep


def sweep(
    question: str | SweepQuestion,
    over: Mapping[str, Any],
    folder: str | PathLike[str],
    *,
    request: Mapping[str, Any] | None = None,
    samples: Samples | None = None,
    shard_size: int | None = None,
    dask: str | None = None,
    progress: Callable[[Progress], None] = lambda progress: None,
) -> Sweep:
    """Answer a question for every design into a folder; the same call continues a stopped sweep.

    question: an operation id such as "collision_time", or your own SweepQuestion
    over: parameters that vary, by dotted names: a list or array of values, or a Range; all combinations are designs
    request: the other parameters, default: their defaults; samples: method for ranges without a count
    shard_size: designs in one file, default: about 5 s of work; dask: address of a scheduler, or "local"
    raises: InvalidValue, TooLarge, MissingPackage, OSError
    """
    own = question if isinstance(question, SweepQuestion) else None
    values = {
        "question": own.name if own else question,
        "over": {name: _axis(axis) for name, axis in over.items()},
        "request": dict(request or {}),
        "samples": None if samples is None else samples.model_dump(),
        "shard_size": shard_size,
    }
    spec, place = Spec.of(values, own), Path(folder)
    run(spec, place, question=own or spec.asks, engine=engine_of(dask), progress=progress)
    return Sweep(place, spec)


def engine_of(dask: str | None, workers: int | None = None, **waits: float) -> Callable[[], SweepEngine]:
    """Function that starts the engine: processes of this machine, or a Dask cluster with `patience` and `first` wait.

    raises: MissingPackage
    """
    if not dask:
        return lambda: Processes(workers)
    require("dask", "dask", "Dask")
    from app.sweeps.cluster import Cluster

    return lambda: Cluster(dask, workers, **waits)


def _axis(values: Any) -> Any:
    if isinstance(values, Range):
        return values.model_dump()
    return values.tolist() if hasattr(values, "tolist") else list(values)
