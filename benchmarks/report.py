"""python -m benchmarks.report docs/performance.md: run every benchmark, rewrite the tables between the markers."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.test_core import CLEAR_PITCHES

ROOT = Path(__file__).parent.parent
BEGIN, END = "<!-- performance:begin -->", "<!-- performance:end -->"

# Label of the row, benchmark, baseline, required time, desired time.
ROWS = (
    ("trajectory, 301 x 224, positions and velocities", "trajectory", "trajectory_baseline", "6 ms", "3 ms"),
    ("first contact, certified", "first_contact[223]", "first_contact_baseline", "20 ms", "4 ms"),
    ("minimum pitch, 9 m circle", "minimum_pitch", "minimum_pitch_baseline", "250 ms", "60 ms"),
    ("first contact, 100,000 benches", "first_contact[100000]", None, "2x the default", "the same"),
    (
        "two dragons of 223 in one spiral to their encounter",
        "first_encounter",
        "first_encounter_baseline",
        "60 ms",
        "10 ms",
    ),
    ("ten dragons of 200 in a square, 300 s", "ten_dragons", "ten_dragons_baseline", "2 s", "0.5 s"),
    ("envelope of the default dance to its fold", "envelope", "envelope_baseline", "1 s", "0.3 s"),
    ("overlapping pairs of 100,000 benches", "overlaps", "overlaps_baseline", "1 s", "0.2 s"),
    (
        "`GET /collision-time`, four engines on the whole dragon, p50",
        "get_collision_time[dragon]",
        "first_contact_baseline",
        "12 ms",
        "8 ms",
    ),
    ("the same on the touching pair (`cross_check=pair`)", "get_collision_time[pair]", None, "2.5 ms", "2 ms"),
    ("the same without a cross-check (`cross_check=none`)", "get_collision_time[none]", None, "1.5 ms", "1 ms"),
    ("`POST /trajectory`, p50", "post_trajectory", "trajectory_baseline", "40 ms", "15 ms"),
    ("import of `core` and first contact, cold process", "cold_start", "cold_start_baseline", "1.5 s", "0.6 s"),
    ("`bench-dragon collision-time`, cold process", "cold_command", "cold_start_baseline", "0.30 s", "0.15 s"),
)
BENCHES = (223, 1_000, 10_000, 100_000)
# Required ratio of requests per second on two cores to those on one.
SCALING_MUST = 1.7
SCALES_BY_THREADS = ("The threads of one process use both cores.",)
SCALES_BY_PROCESSES = (
    "The threads of one process do not use both cores well: only the search runs without Python's lock, the rest of",
    "an answer (the cross-check, the framework) in one thread at a time. So `serve` starts one process for each core.",
)
Results = dict[str, dict[str, Any]]


def run_benchmarks() -> Results:
    """The entries of pytest-benchmark's JSON, by test name."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "benchmarks.json"
        command = [sys.executable, "-m", "pytest", "benchmarks", f"--benchmark-json={output}"]
        subprocess.run([*command, "--benchmark-columns=median,rounds"], cwd=ROOT, check=True)
        entries = json.loads(output.read_text(encoding="utf-8"))["benchmarks"]
    return {entry["name"].removeprefix("test_"): entry for entry in entries}


def seconds(results: Results, name: str) -> float:
    """Median of a benchmark, scaled up if only a part of the work was measured."""
    entry = results[name]
    return float(entry["stats"]["median"] * entry["extra_info"].get("scale", 1.0))


def format_time(time: float) -> str:
    """A time in seconds or milliseconds, to three digits."""
    value, unit = (time * 1e3, "ms") if time < 1.0 else (time, "s")
    return f"{value:,.0f} {unit}" if value >= 100 else f"{value:.3g} {unit}"


def table(results: Results) -> list[str]:
    """One row for each kind of work, beside its baseline of the same run."""
    lines = ["| work | must | aim | measured | plain SciPy | ratio |", "|---|---|---|---|---|---|"]
    for label, name, baseline, must, aim in ROWS:
        time = seconds(results, name)
        cells = [label, must, aim, format_time(time), "", ""]
        if baseline:
            ratio = seconds(results, baseline) / time
            cells[4:] = [format_time(seconds(results, baseline)), f"{ratio:,.0f}x" if ratio >= 10 else f"{ratio:.1f}x"]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def beside(label: str, cases: list[str], times: list[float], words: str, one: float) -> list[str]:
    """One column per case: its time, and its ratio to a reference time [s], with a label."""
    return [
        f"| {label} | {' | '.join(cases)} |",
        f"|---|{'---|' * len(cases)}",
        f"| time | {' | '.join(map(format_time, times))} |",
        f"| {words} | {' | '.join(f'{time / one:.2f}x' for time in times)} |",
    ]


def growth(results: Results) -> list[str]:
    """Rows on the growth of first contact with the number of benches."""
    times = [seconds(results, f"first_contact[{benches}]") for benches in BENCHES]
    return beside("first contact, benches", [f"{benches:,}" for benches in BENCHES], times, "growth", times[0])


def clear(results: Results) -> list[str]:
    """Rows on a dance without a contact beside one with it."""
    times = [seconds(results, f"first_contact_clear[{pitch}]") for pitch in CLEAR_PITCHES]
    pitches, one = [f"{pitch} m" for pitch in CLEAR_PITCHES], seconds(results, "first_contact[223]")
    return beside("no contact (must 2.5x a contact), pitch", pitches, times, "beside a contact at 0.55 m", one)


def strays(results: Results) -> list[str]:
    """Rows on what a stray costs beside a margin of the same size."""
    lines = ["| with 2 cm | must | as a margin | as a stray | ratio |", "|---|---|---|---|---|"]
    for work in ("first contact", "minimum pitch"):
        name = f"{work.replace(' ', '_')}_within"
        margin, stray = (seconds(results, f"{name}[{kept}]") for kept in ("margin", "stray"))
        lines.append(f"| {work} | 1.5x | {format_time(margin)} | {format_time(stray)} | {stray / margin:.2f}x |")
    return lines


def throughput(results: Results) -> list[str]:
    """Rows on requests per second: one process on one core, one process on two cores, two processes on two cores."""
    rates = {
        name: entry["extra_info"]["requests"] / entry["stats"]["min"]
        for service in ("1on1", "1on2", "2on2")
        if (entry := results.get(name := f"throughput[{service}]"))
    }
    one = rates["throughput[1on1]"]
    rows = (
        ("one process (`serve --workers 1`), on one core (`taskset -c 0`)", "throughput[1on1]"),
        ("one process, on two cores", "throughput[1on2]"),
        ("two processes (`serve --workers 2`, the default on two cores), on two cores", "throughput[2on2]"),
    )
    lines = [
        "| `/collision-time?cross_check=pair`, each at its own pitch, eight at a time | requests/s (best) | ratio |",
        "|---|---|---|",
        *(f"| {label} | {rates[name]:,.0f} | {rates[name] / one:.2f}x |" for label, name in rows if name in rates),
    ]
    if len(rates) == len(rows):
        threads, processes = rates["throughput[1on2]"] / one, rates["throughput[2on2]"] / one
        lines += ["", *(SCALES_BY_THREADS if threads >= SCALING_MUST else SCALES_BY_PROCESSES)]
        if max(threads, processes) < SCALING_MUST:
            lines.append(f"Two cores must give {SCALING_MUST}x; in this run neither did.")
    return lines


def section(results: Results) -> str:
    """Everything between the markers, in Markdown."""
    machine = f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    return "\n".join(
        [
            f"Medians on {machine}, warm unless cold is said; made by `make bench`.",
            "`must` and `aim` are goals for an idle machine with two cores; on a busy one times may miss them.",
            "",
            *table(results),
            "",
            "Plain SciPy is one `brentq` for each handle at each instant, and shapely's tree over all benches every",
            "0.1 s (which can miss a contact) with a bisection at the end. It is measured in the same run, on part of",
            "the instants, and scaled to the whole; its cold start is only `import numpy, scipy.optimize, shapely`.",
            "",
            *growth(results),
            "",
            *clear(results),
            "",
            *strays(results),
            "",
            *throughput(results),
        ]
    )


def main() -> None:
    """Rewrite the part between the markers in the file named on the command line."""
    page = Path(sys.argv[1])
    before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        sys.exit(f"{page} needs the lines {BEGIN} and {END}")
    text = section(run_benchmarks())
    page.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
