"""All random campaigns against slow oracles: python -m tests.hunt [SECONDS [SEED]]; exit code 1 for any false answer.

Each campaign is a module with `hunt(seed, seconds)`, which returns the number of cases and the false ones, as a number
or a list of sentences. The time is shared out among them.
"""

from __future__ import annotations

import sys
import time
from importlib import import_module

# Module of each campaign, and what it judges.
CAMPAIGNS = {
    "tests.core.hunt_contacts": "first contacts, least clearances and verdicts on any path, with passages",
    "tests.core.hunt_turns": "turns with any entry and exit, long spirals, boxes of turns that share an overlap",
    "tests.core.hunt_venues": "walls and obstacles, up to the fold",
    "tests.core.proof.differential": "certificates with a changed number, judged by both verifiers",
    "tests.app.grade.hunt_grades": "sheets and typed numbers that are nearly right",
}
SECONDS = 1200.0  # of all campaigns together


def main() -> None:
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())
    share, false = seconds / len(CAMPAIGNS), 0
    print(f"seed {seed}", flush=True)
    for module, what in CAMPAIGNS.items():
        cases, faults = import_module(module).hunt(seed, share)
        count = faults if isinstance(faults, int) else len(faults)
        for fault in () if isinstance(faults, int) else faults:
            print(fault)
        print(f"{cases:8,d} cases, {count} false: {what}", flush=True)
        false += count
    sys.exit(false > 0)


if __name__ == "__main__":
    main()
