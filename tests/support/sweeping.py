"""Sweeps of the tests: their specs, and their tables as this process answers them, shard by shard."""

import json

from app.sweeps.run import begin
from app.sweeps.shards import ShardPiece, write_part
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep


def spec_of(question, over, **more):
    return Spec.of({"question": question.name, "over": over, **more}, question)


def grid_of(question, designs=60, shard_size=6, **request):
    """Two rows of places of tests.support.odd_questions."""
    over = {"x": list(map(float, range(designs // 2))), "y": [1.0, 2.0]}
    return spec_of(question, over, request=request, shard_size=shard_size)


def answered(folder, spec, question=None):
    """The whole sweep in its folder. question: the one of the spec, if it is not in the registry"""
    begin(folder, spec)
    for shard in range(spec.shards):
        write_part(folder, spec, shard, [ShardPiece.whole(spec, question or spec.asks, shard).answer()])
    return Sweep(folder, spec)


def assert_undisturbed(folder, spec, question):
    """Compact a sweep; its table must have the bytes of the same sweep answered here."""
    expected = answered(folder.with_name("undisturbed"), spec, question)
    assert Sweep(folder, spec).compact().read_bytes() == expected.compact().read_bytes()


# A sweep of 40 designs for a service, a quarter of which are refused.
SPEC = {
    "question": "collision_time",
    "over": {"pitch": {"start": 0.42, "stop": 0.60, "count": 10}, "width": [0.25, 0.30, 0.35, -1.0]},
    "request": {"benches": 60},
    "shard_size": 10,
}


def followed(client, address):
    """The last status of a sweep, and all from the first one that says how many designs are done."""
    with client.stream("GET", f"{address}/events") as events:
        lines = [json.loads(line[6:]) for line in events.iter_lines() if line.startswith("data: ")]
    return lines[-1], [status for status in lines if status["done"] is not None]
