"""Whose turn it is: the order in which waiting jobs run.

It is the turn of the client with the fewest running jobs; among those, of the one that has waited longest since its
last job began or ended, or since it asked for the oldest of those that wait; and of its jobs, that of the shortest
estimate, then the oldest. So places alternate between clients, however many jobs each of them has, and a client that
removes its jobs, or comes under another address, gains nothing before those that waited meanwhile.
"""

from __future__ import annotations

import sqlite3
import time
from typing import Any

from app.jobs.job import SWEEP
from app.jobs.room import DAY

NEXT = f"""
WITH of_client AS (
    SELECT client, sum(state = 'running') AS running, min(CASE state WHEN 'accepted' THEN created END) AS since
    FROM jobs WHERE state IN ('accepted', 'running') GROUP BY client
)
SELECT id, question, client FROM jobs JOIN of_client USING (client) LEFT JOIN turns USING (client)
WHERE state = 'accepted' AND (:of_client < 0 OR running < :of_client) AND (question != '{SWEEP}' OR
    (SELECT count(*) FROM jobs WHERE state = 'running' AND question = '{SWEEP}') < :sweeps)
ORDER BY running, max(since, coalesce(latest, 0)), cost, created LIMIT 1
"""


def next_job(run: sqlite3.Connection, sweeps: int, of_client: int | None) -> Any:
    """Name, question and client of the job that runs next; None if none may.

    sweeps: largest number of running sweeps; of_client: of running jobs of one client, None: no limit
    """
    limits = {"sweeps": sweeps, "of_client": -1 if of_client is None else of_client}
    return run.execute(NEXT, limits).fetchone()


def note_turn(run: sqlite3.Connection, client: str) -> None:
    """Record that a job of the client began or ended; it is forgotten after a day."""
    now = time.time()
    run.execute("INSERT OR REPLACE INTO turns VALUES (?, ?)", (client, now))
    run.execute("DELETE FROM turns WHERE latest < ?", (now - DAY,))
