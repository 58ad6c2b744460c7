"""The service under attack, seen by another client: each attack alone, then all in turn beside 64 clients.

`make soak`: python -m tests.campaigns.soak SECONDS FOLDER, which writes soak.csv and soak.png into FOLDER.
"""

import multiprocessing
import sys
import tempfile
import threading
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

from tests.support.attacks import ATTACKS, ask, memory, watching
from tests.support.serving import serving

# Every process of the service has loaded all it needs by then [s].
START_SECONDS = 5.0
# Ordinary clients at once, the length of one attack, and how often the curve has a point [s].
CONNECTIONS = 64
ATTACK_SECONDS = 10.0
POINTS = 180
COLUMNS = ("seconds", "memory_mb", "answered", "busy", "other", "slowest_healthz_s", "slowest_collision_time_s")
# The clients are processes of their own: none waits for Python's lock of another.
SPAWN = multiprocessing.get_context("spawn")


def ordinary_clients(url, seconds, statuses):
    """Clients that ask again as soon as they are answered, each from an address of its own.

    They ask quick questions, and one in eight times a heavy one.
    """
    end = time.monotonic() + seconds

    def client(number):
        request = 0
        while time.monotonic() < end:
            request += 1
            pitch = 0.45 + 1e-7 * (request * CONNECTIONS + number)
            heavy = f"/minimum-pitch?turning_diameter={9.0 + pitch:.9f}"
            try:
                path = heavy if request % 8 == 0 else f"/collision-time?pitch={pitch:.9f}"
                status, _ = ask(url, "GET", path, client=f"127.0.1.{1 + number}")
            except OSError:
                status = 0
            statuses.put(status)

    threads = [threading.Thread(target=client, args=(number,)) for number in range(CONNECTIONS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def attackers(url, seconds):
    """All attacks in turn; what each must be answered with is judged by the tests."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for attack in ATTACKS.values():
            with suppress(OSError, AssertionError):
                attack(url, ATTACK_SECONDS / 2)


def one_by_one(url):
    """The slowest answers that another client sees during each attack."""
    print(f"{'attack':28} {'slowest /healthz [ms]':>22} {'/collision-time [ms]':>21}   others")
    for name, attack in ATTACKS.items():
        # An attack is a process of its own: its threads must not slow the client that watches.
        attacker = SPAWN.Process(target=attack, args=(url, ATTACK_SECONDS), daemon=True)
        attacker.start()
        with watching(url) as watch:
            attacker.join()
        healthz, collision_time = (1e3 * watch.slowest[path] for path in ("/healthz", "/collision-time"))
        verdict = "all answered" if not watch.failures else f"{len(watch.failures)} of {watch.sent} not answered well"
        print(f"{name:28} {healthz:22.0f} {collision_time:21.0f}   {verdict}", flush=True)


def all_at_once(url, pid, seconds):
    """Points of the curve: a row of COLUMNS for every part of the time."""
    statuses = SPAWN.SimpleQueue()
    others = [
        SPAWN.Process(target=ordinary_clients, args=(url, seconds, statuses), daemon=True),
        SPAWN.Process(target=attackers, args=(url, seconds), daemon=True),
    ]
    for other in others:
        other.start()
    start = time.monotonic()
    rows = []
    step = max(seconds / POINTS, 5.0)
    while (now := time.monotonic() - start) < seconds:
        with watching(url) as watch:
            time.sleep(step)
        seen = Counter[int]()
        while not statuses.empty():
            seen[statuses.get()] += 1
        other_statuses = sum(count for status, count in seen.items() if status not in {200, 429, 503})
        slowest = (watch.slowest["/healthz"], watch.slowest["/collision-time"])
        rows.append((now + step, memory(pid), seen[200], seen[429] + seen[503], other_statuses, *slowest))
        print(*(f"{value:8.3g}" if value < 100 else f"{value:8.0f}" for value in rows[-1]), flush=True)
        for failure in watch.failures[:2]:
            print("  one more client:", failure)
    for other in others:
        other.join()
    return rows


def soak(seconds, folder):
    import pandas

    folder.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, serving(Path(scratch) / "log", workers=2) as service:
        time.sleep(START_SECONDS)
        one_by_one(service.url)
        print(*COLUMNS)
        rows = all_at_once(service.url, service.process.pid, seconds)
        lines = (Path(scratch) / "log").read_text(errors="replace").splitlines()
    table = pandas.DataFrame(rows, columns=COLUMNS)
    table.to_csv(folder / "soak.csv", index=False)
    panels = [COLUMNS[1:2], COLUMNS[2:4], COLUMNS[5:]]
    axes = table.drop(columns="other").plot("seconds", subplots=panels, figsize=(8.0, 6.0), grid=True)
    axes[0].figure.savefig(folder / "soak.png", dpi=120)
    print(table[["answered", "busy", "other"]].sum().to_string())
    print("tracebacks in the log of the service:", sum(line.startswith("Traceback") for line in lines))


if __name__ == "__main__":
    soak(float(sys.argv[1]), Path(sys.argv[2]))
