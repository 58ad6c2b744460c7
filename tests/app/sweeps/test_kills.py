"""A sweep on a real Dask cluster with two kills; `make sweep-kills` has many, also of the client."""

from __future__ import annotations

from pathlib import Path

from app.sweeps.run import run
from app.sweeps.spec import Spec
from tests.app.sweeps.kills import collisions, disturbed, table_hash


def test_kills_of_scheduler_and_worker_change_no_byte(tmp_path: Path) -> None:
    told = collisions(120, shards=12)
    spec = Spec.of(told)
    killed = disturbed(told, tmp_path, kills=2, seed=4)
    assert killed == {"scheduler": 1, "worker": 1}
    run(spec, tmp_path / "undisturbed", question=spec.asks)
    assert table_hash(tmp_path / "out", spec) == table_hash(tmp_path / "undisturbed", spec)
