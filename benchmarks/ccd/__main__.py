"""python -m benchmarks.ccd: make the queries, ask every engine, and write the table and the figures into docs/.

An interrupted run continues: existing files in its folder are not made again.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from benchmarks.ccd.files import load_shard, save_csv, save_shard, shard_of
from benchmarks.ccd.queries import dance_queries
from benchmarks.ccd.report import PAGE, SAMPLE, SAMPLED, collected, report
from benchmarks.ccd.running import Worker, answers_path, installed, save_answers

ROOT = Path(__file__).parents[2]
# Dances in one file of queries.
DANCES = 10


def run(folder: Path, seed: int, count: int, names: Iterable[str]) -> None:
    """Make a least number of queries, file by file, and have these engines answer them."""
    folder.mkdir(parents=True, exist_ok=True)
    workers, done, number = {name: Worker(name) for name in names}, 0, 0
    while done < count:
        path = folder / f"queries-{number:04}.npz"
        if not path.exists():
            made = {k: dance_queries(seed, k) for k in range(DANCES * number, DANCES * (number + 1))}
            known = [one for _, queries in made.values() for one in queries]
            save_shard(path, shard_of({k: record for k, (record, _) in made.items()}, known))
        here = len(load_shard(path))
        for name, worker in workers.items():
            answered = answers_path(path, name)
            if not answered.exists():
                save_answers(answered, worker.answered(path, here))
        done, number = done + here, number + 1
        print(f"{path}: {done} queries answered", flush=True)
    for worker in workers.values():
        worker.stop()


def at_least(least: int) -> Callable[[str], int]:
    """A reader of whole numbers that are not below the least one."""

    def read(text: str) -> int:
        if not text.lstrip("-").isdecimal() or int(text) < least:
            raise argparse.ArgumentTypeError(f"must be a whole number of at least {least}, got {text}")
        return int(text)

    return read


def main() -> None:
    """Run, then write what was found."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ccd", description=__doc__)
    parser.add_argument(
        "--queries", type=at_least(1), default=100_000, help="least number of queries; default: 100,000"
    )
    parser.add_argument("--seed", type=at_least(0), default=2026, help="seed of the random dances; default: 2026")
    parser.add_argument(
        "--folder", type=Path, default=ROOT / "build" / "ccd", help="folder of queries and answers; default: build/ccd"
    )
    parser.add_argument(
        "--docs", type=Path, default=ROOT / "docs", help="folder of the page and the figures; default: docs"
    )
    parser.add_argument("--sample", action="store_true", help=f"also write {SAMPLED} of the queries to {SAMPLE.name}")
    parser.add_argument("--only-report", action="store_true", help="write the report from the answers so far")
    options = parser.parse_args()
    folder = options.folder / f"seed-{options.seed}"
    if not (options.docs / PAGE).is_file():
        parser.error(f"--docs must be a folder with {PAGE}, the page that gets the tables, got {options.docs}")
    if not options.only_report:
        try:
            run(folder, options.seed, options.queries, installed())
        except KeyboardInterrupt:
            print(f"interrupted: the answers so far are in {folder}, and the same command continues", file=sys.stderr)
            sys.exit(130)
    results = collected(folder)
    if results is None:
        parser.error(f"--folder has no answered queries of the seed {options.seed}: {folder}")
    if options.sample:
        sample = results.sample(SAMPLED)
        save_shard(SAMPLE, sample)
        save_csv(SAMPLE.with_suffix(".csv"), sample)
    print(report(results, options.docs))


if __name__ == "__main__":
    main()
