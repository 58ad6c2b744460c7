"""Results of a run: a table for each class of queries, and two figures, for docs/dragon-ccd.md."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.ccd.engines import ENGINES
from benchmarks.ccd.files import ENDS, Shard, joined, load, load_shard
from benchmarks.ccd.queries import CLASSES, CONTACT, FAR, GRAZE
from benchmarks.ccd.running import Answers, answers_path, installed
from core.plots import BLUE, GREY, VERMILION

HEADINGS = (
    "engine",
    "false negatives",
    "false positives",
    "undecided / crash / hang",
    "latest [s]",
    "earliest [s]",
    "median error [s]",
    "µs, median (99 %)",
    "evaluations",
)
PAGE = "dragon-ccd.md"
BEGIN, END = "<!-- dragon-ccd:begin -->", "<!-- dragon-ccd:end -->"
# The committed sample, and how many queries it has.
SAMPLE = Path(__file__).with_name("sample.npz")
SAMPLED = 1_000
# The first dances with queries, from which the sample is taken.
SAMPLE_DANCES = 60
# Dots of one engine in the figure.
DOTS = 2_000
# Errors below this are shown as this: the bracket of our own engine [s].
FLOOR = 1e-13
COLOURS = dict(
    zip(
        (engine.name for engine in ENGINES),
        (VERMILION, BLUE, "#56B4E9", "#009E73", "#8FBC8F", GREY, "#000000", "#CC79A7"),
        strict=True,
    )
)
MARKERS = dict(zip(COLOURS, "ovspD^dP", strict=True))


class Results(NamedTuple):
    """All queries, and each engine's answers to them, by its name."""

    queries: Shard
    answers: dict[str, Answers]

    @property
    def truly(self) -> NDArray[np.bool_]:
        """Whether the corner meets the edge."""
        return np.isfinite(self.queries.columns["low"])

    def sample(self, count: int) -> Shard:
        """A number of queries drawn from the first dances."""
        rows = np.random.Generator(np.random.Philox(key=count)).permutation(len(self.queries))
        early = np.unique(self.queries.columns["dance"])[:SAMPLE_DANCES]
        rows = rows[np.isin(self.queries.columns["dance"][rows], early)][:count]
        return self.queries.taken(np.sort(rows))


class Score(NamedTuple):
    """Results of one engine on some queries.

    missed, invented: false negatives and positives; other: those without an answer, in the order of ENDS
    late, early: largest, against a certified contact [s]; median: of the errors' sizes [s]
    microseconds: median, and the one that 99 % keep; evaluations: median
    """

    missed: int
    invented: int
    other: tuple[int, ...]
    late: float
    early: float
    median: float
    microseconds: tuple[float, float]
    evaluations: float


def collected(folder: Path) -> Results | None:
    """All files of queries in a folder that every engine with answers there has answered; None without any."""
    names = [
        engine.name for engine in ENGINES if any(folder.glob(answers_path(Path("queries-*.npz"), engine.name).name))
    ]
    shards, parts = [], {name: [] for name in names}
    for path in sorted(folder.glob("queries-????.npz")):
        files = {name: answers_path(path, name) for name in names}
        if all(file.exists() for file in files.values()):
            shards.append(load_shard(path))
            for name, file in files.items():
                parts[name].append(load(file))
    if not shards or not names:
        return None
    answers = {
        name: {key: np.concatenate([part[key] for part in each]) for key in each[0]} for name, each in parts.items()
    }
    return Results(joined(shards), answers)


def errors(results: Results, name: str) -> NDArray[np.float64]:
    """Delay of an engine's contact after the certified one [s], 0 within the bracket; not a number without contact."""
    answers, columns = results.answers[name], results.queries.columns
    travel = np.where(answers["touches"] == 1, answers["travel"], np.nan)
    delay: NDArray[np.float64] = np.maximum(travel - columns["high"], 0.0) + np.minimum(travel - columns["low"], 0.0)
    return delay


def score(results: Results, name: str, rows: NDArray[np.bool_]) -> Score:
    """The score of an engine on some of the queries."""
    answers = results.answers[name]
    answered = rows & (answers["end"] == ENDS.index("answered"))
    touches, truly = answers["touches"] == 1, results.truly
    off = errors(results, name)[answered & touches & truly]
    spent = answers["microseconds"][rows & np.isfinite(answers["microseconds"])]
    return Score(
        int((answered & truly & ~touches).sum()),
        int((answered & ~truly & touches).sum()),
        tuple(int((rows & (answers["end"] == k)).sum()) for k in range(1, len(ENDS))),
        float(off.max(initial=0.0)),
        float(-off.min(initial=0.0)),
        float(np.median(np.abs(off))) if off.size else 0.0,
        (float(np.median(spent)), float(np.percentile(spent, 99))) if spent.size else (0.0, 0.0),
        float(np.median(answers["evaluations"][rows])) if rows.any() else 0.0,
    )


def table(results: Results, rows: NDArray[np.bool_]) -> list[str]:
    """One row for each engine."""
    lines = [
        f"| {' | '.join(HEADINGS)} |",
        f"|{'---|' * len(HEADINGS)}",
    ]
    for name in results.answers:
        scores = score(results, name, rows)
        other = " / ".join(map(str, scores.other))
        times = f"{scores.microseconds[0]:,.0f} ({scores.microseconds[1]:,.0f})"
        cells = (
            name,
            f"{scores.missed:,}",
            f"{scores.invented:,}",
            other,
            *map(format_error, (scores.late, scores.early, scores.median)),
        )
        lines.append(f"| {' | '.join(cells)} | {times} | {scores.evaluations:,.0f} |")
    return lines


def format_error(time: float) -> str:
    """An error in two digits."""
    return f"{time:.1e}" if time else "0"


def by_depth(results: Results) -> list[str]:
    """False negatives and positives of grazes, one row for each engine, one column for each depth."""
    columns = results.queries.columns
    decades = np.where(columns["kind"] == GRAZE, np.round(-np.log10(np.abs(columns["depth"]))), 0).astype(int)
    depths = [k for k in range(3, 10) if (decades == k).any()]
    lines = [
        f"| engine | {' | '.join(f'1e-{k} m' for k in depths)} |",
        f"|---|{'---|' * len(depths)}",
    ]
    for name in results.answers:
        scores = [score(results, name, decades == k) for k in depths]
        lines.append(f"| {name} | {' | '.join(f'{each.missed} / {each.invented}' for each in scores)} |")
    counts = [
        f"{int(((decades == k) & results.truly).sum())} / {int(((decades == k) & ~results.truly).sum())}"
        for k in depths
    ]
    return [*lines, f"| *of contacts / clear* | {' | '.join(counts)} |"]


def section(results: Results) -> str:
    """Everything between the markers, in Markdown."""
    kinds, dances = results.queries.columns["kind"], len(np.unique(results.queries.columns["dance"]))
    counts = ", ".join(f"{int((kinds == k).sum()):,} {name}" for k, name in enumerate(CLASSES))
    versions = installed()
    settings = [
        f"- {engine.name} {versions[engine.name]}: {engine.settings}" for engine in ENGINES if engine.name in versions
    ]
    machine = f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    lines = [
        f"{len(kinds):,} queries about {dances:,} dances ({counts}); {int(results.truly.sum()):,} of them meet.",
        f"{machine}.",
        "",
        *settings,
        "",
        "All queries:",
        "",
        *table(results, np.ones(len(kinds), dtype=bool)),
    ]
    for kind in (CONTACT, GRAZE, FAR):
        lines += ["", f"Class {CLASSES[kind]}:", "", *table(results, kinds == kind)]
    lines += ["", "False negatives / false positives of grazes, by depth:", "", *by_depth(results)]
    return "\n".join(lines)


def report(results: Results, docs: Path) -> str:
    """Rewrite the part of docs/dragon-ccd.md between its markers, and both figures; returns that part."""
    text = section(results)
    page = docs / PAGE
    before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise ValueError(f"{page} needs the lines {BEGIN} and {END}")
    page.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")
    draw(results, docs)
    return text


def draw(results: Results, docs: Path) -> None:
    """The figures: error against the time of a query, and against the depth of the graze."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 5), layout="constrained")
    for name in results.answers:
        off, spent = np.abs(errors(results, name)), results.answers[name]["microseconds"]
        rows = np.flatnonzero(np.isfinite(off) & np.isfinite(spent))[:DOTS]
        axes.plot(
            spent[rows],
            np.maximum(off[rows], FLOOR),
            MARKERS[name],
            ms=3,
            alpha=0.35,
            mew=0,
            color=COLOURS[name],
            label=name,
        )
    axes.set(
        xscale="log", yscale="log", xlabel="processor time of a query [µs]", ylabel="error of the time of contact [s]"
    )
    _legend(axes)
    figure.savefig(docs / "ccd-time.png", dpi=110)
    pyplot.close(figure)
    figure, axes = pyplot.subplots(figsize=(8, 5), layout="constrained")
    columns = results.queries.columns
    for name in results.answers:
        off = np.abs(errors(results, name))
        depths = [10.0**-k for k in range(3, 10)]
        delays = [
            off[
                (columns["kind"] == GRAZE)
                & np.isclose(columns["depth"], -depth, rtol=1e-6, atol=0.0)
                & np.isfinite(off)
            ]
            for depth in depths
        ]
        kept = [
            (depth, np.percentile(each, [50, 100])) for depth, each in zip(depths, delays, strict=True) if each.size
        ]
        if not kept:  # an engine that crashed or hung at every graze
            continue
        x, values = [depth for depth, _ in kept], np.maximum([pair for _, pair in kept], FLOOR)
        axes.plot(x, values[:, 0], MARKERS[name] + "-", color=COLOURS[name], label=name)
        axes.plot(x, values[:, 1], ":", color=COLOURS[name], lw=1)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="depth of the graze [m]",
        ylabel="error of the time of contact [s]: median, largest (dotted)",
    )
    _legend(axes)
    figure.savefig(docs / "ccd-depth.png", dpi=110)
    pyplot.close(figure)


def _legend(axes: Any) -> None:
    axes.grid(alpha=0.3)
    legend = axes.legend(fontsize=8, markerscale=2)
    for handle in legend.legend_handles:
        handle.set_alpha(1.0)
