"""The tables of the store of jobs, and how those of earlier versions become these.

Of a client no address is kept but a keyed hash of it, so that its jobs can be counted. The key is a file beside the
database: whoever has a copy of the database alone cannot find the address by trying all of them.
"""

from __future__ import annotations

import hashlib
import secrets
import sqlite3
from pathlib import Path

from app.files.flush import new_file

# Version of the tables below; a folder with another version is not changed, but for those that become this one.
LAYOUT, EARLIER = 4, (1, 2, 3)
# Calls have a table of their own: SQLite reads the whole of one to reach the columns behind it, and who looks for room
# goes through all jobs.
TABLES = """
CREATE TABLE IF NOT EXISTS jobs (
    id TEXT PRIMARY KEY, question TEXT NOT NULL, client TEXT NOT NULL, state TEXT NOT NULL,
    created REAL NOT NULL, started REAL, finished REAL, updated REAL NOT NULL, message TEXT NOT NULL,
    progress INTEGER NOT NULL DEFAULT 0, rate REAL, time_left REAL, deaths INTEGER NOT NULL DEFAULT 0,
    media_type TEXT, size INTEGER NOT NULL DEFAULT 0, problem BLOB, expired INTEGER NOT NULL DEFAULT 0,
    done INTEGER, total INTEGER, kept INTEGER NOT NULL DEFAULT 0, cost REAL NOT NULL DEFAULT 1,
    call_size INTEGER NOT NULL DEFAULT 0
);
CREATE TABLE IF NOT EXISTS calls (job TEXT PRIMARY KEY REFERENCES jobs ON DELETE CASCADE, data BLOB NOT NULL);
CREATE INDEX IF NOT EXISTS jobs_by_state ON jobs (state, created);
CREATE TABLE IF NOT EXISTS events (
    job TEXT NOT NULL REFERENCES jobs ON DELETE CASCADE, number INTEGER NOT NULL, data BLOB NOT NULL,
    PRIMARY KEY (job, number)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS removals (
    id INTEGER PRIMARY KEY CHECK (id = 0), made INTEGER, cleared INTEGER, gave_way INTEGER NOT NULL DEFAULT 0
);
INSERT OR IGNORE INTO removals (id, made, cleared) VALUES (0, 0, 0);
CREATE TABLE IF NOT EXISTS turns (client TEXT PRIMARY KEY, latest REAL NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS clock (id INTEGER PRIMARY KEY CHECK (id = 0), boot TEXT NOT NULL, ahead REAL NOT NULL);
"""
# Columns that tables of earlier layouts may lack.
ADDED = {
    "jobs": (
        "done INTEGER",
        "total INTEGER",
        "kept INTEGER NOT NULL DEFAULT 0",
        "cost REAL NOT NULL DEFAULT 1",
        "call_size INTEGER NOT NULL DEFAULT 0",
    ),
    "removals": ("gave_way INTEGER NOT NULL DEFAULT 0",),
}
KEY_FILE, KEY_BYTES, NAME_BYTES = "client.key", 32, 12


def prepare(run: sqlite3.Connection, folder: Path) -> bytes:
    """The key of the clients' names, after the tables were made or taken over; within one transaction.

    raises: OSError if the tables belong to another version of this program, or the key cannot be written
    """
    layout = run.execute("PRAGMA user_version").fetchone()[0]
    if layout not in (0, LAYOUT, *EARLIER):
        raise OSError(f"the jobs of {folder} belong to another version of this program (layout {layout})")
    for table in filter(str.strip, TABLES.split(";")):
        run.execute(table)
    key = _key(folder)
    if layout in EARLIER:
        _take_over(run, key, layout)
    if layout != LAYOUT:
        run.execute(f"PRAGMA user_version = {LAYOUT}")
    return key


def _key(folder: Path) -> bytes:
    file = folder / KEY_FILE
    if not file.exists():  # No other process makes one now, because it waits for this transaction.
        file.touch(mode=0o600)
        with new_file(folder, f".{KEY_FILE}", file) as sink:
            sink.write(secrets.token_bytes(KEY_BYTES))
    return file.read_bytes()


def _take_over(run: sqlite3.Connection, key: bytes, layout: int) -> None:
    for table, columns in ADDED.items():
        known = {row[1] for row in run.execute(f"PRAGMA table_info({table})")}
        for column in columns:
            if column.partition(" ")[0] not in known:
                run.execute(f"ALTER TABLE {table} ADD COLUMN {column}")
    run.execute("INSERT INTO calls SELECT id, call FROM jobs WHERE NOT expired")
    run.execute("UPDATE jobs SET call_size = length(call)")
    run.execute("ALTER TABLE jobs DROP COLUMN call")
    if layout < 3:  # Those kept the address itself while the job was not finished.
        for (address,) in run.execute("SELECT DISTINCT client FROM jobs WHERE client != ''").fetchall():
            run.execute("UPDATE jobs SET client = ? WHERE client = ?", (client_name(address, key), address))
    run.execute("UPDATE removals SET made = made + 1")


def client_name(address: str, key: bytes) -> str:
    """The name under which the jobs of a client are counted; empty for an unknown address."""
    return hashlib.blake2b(address.encode(), key=key, digest_size=NAME_BYTES).hexdigest() if address else ""
