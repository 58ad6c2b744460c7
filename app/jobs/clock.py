"""The clock of the store: ages go on evenly when the clock of the machine jumps.

A machine without a battery for its clock starts with a wrong time, and steps by months when it reaches a time server.
Then results would expire at once, or stay until the old time comes again. So the store knows how far the clock of the
machine is ahead of the time since its start, which never jumps and goes on in sleep. When that changes by a step, all
times in the store move by it. Another start of the machine has nothing to compare with: then no time may lie ahead.

input   the transaction of a change, and both clocks of the machine
state   the row of the table clock
output  times of the tables jobs and turns
"""

from __future__ import annotations

import sqlite3
import time
from functools import cache
from pathlib import Path

# Smallest step of the clock that moves the times of the store [s]; time servers slew what is less.
STEP = 2.0
BOOT = Path("/proc/sys/kernel/random/boot_id")
TIMES = ("created", "started", "finished", "updated")


@cache
def name_of_boot() -> str:
    """Name of the last start of this machine; empty if it has none."""
    try:
        return BOOT.read_text().strip()
    except OSError:  # not Linux
        return ""


def follow_clock(run: sqlite3.Connection) -> float:
    """The time now [s]; before that the times of the store move by the step that the clock has made, if it has."""
    now, boot = time.time(), name_of_boot()
    ahead = now - time.clock_gettime(time.CLOCK_BOOTTIME) if boot else 0.0
    known = run.execute("SELECT boot, ahead FROM clock").fetchone() or ("", 0.0)
    is_comparable = boot != "" and known[0] == boot
    if is_comparable and abs(ahead - known[1]) < STEP:
        return now
    if is_comparable:
        _move(run, ahead - known[1])
    _cut(run, now)
    if boot:
        run.execute("INSERT OR REPLACE INTO clock (id, boot, ahead) VALUES (0, ?, ?)", (boot, ahead))
    return now


def _move(run: sqlite3.Connection, step: float) -> None:
    run.execute(f"UPDATE jobs SET {', '.join(f'{name} = {name} + :step' for name in TIMES)}", {"step": step})
    run.execute("UPDATE turns SET latest = latest + ?", (step,))


def _cut(run: sqlite3.Connection, now: float) -> None:
    """Leave no time that has yet to come. SQLite's min() of a missing time is missing."""
    cut = ", ".join(f"{name} = min({name}, :now)" for name in TIMES)
    run.execute(f"UPDATE jobs SET {cut} WHERE updated > :now", {"now": now})
    run.execute("UPDATE turns SET latest = :now WHERE latest > :now", {"now": now})
