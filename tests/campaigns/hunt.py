"""All random campaigns against slow oracles: python -m tests.campaigns.hunt [SECONDS [SEED]].

The exit code is 1 for any false answer. Each campaign is a module with `hunt(seed, seconds)`, which returns the number
of cases and, second, the false ones, as a number or a list of sentences. The time is shared out among them.
"""

from __future__ import annotations

import sys
import time
from importlib import import_module

# Module of each campaign, and what it judges.
CAMPAIGNS = {
    "tests.campaigns.hunt_contacts": "first contacts, least clearances and verdicts on any path, with passages",
    "tests.campaigns.hunt_clothoids": "the same on routes with clothoids",
    "tests.campaigns.hunt_encounters": "first encounters of two to five dragons on one clock",
    "tests.campaigns.hunt_turns": "turns with any entry and exit, long spirals, boxes of turns that share an overlap",
    "tests.campaigns.hunt_venues": "walls and obstacles, up to the fold",
    "tests.campaigns.hunt_proposals": "dances proposed for random squares, and reasons where there is none",
    "tests.campaigns.differential": "certificates with a changed number, judged by both verifiers",
    "tests.campaigns.hunt_grades": "sheets and typed numbers that are nearly right",
}
SECONDS = 1200.0  # of all campaigns together


def main() -> None:
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())
    share, false = seconds / len(CAMPAIGNS), 0
    print(f"seed {seed}", flush=True)
    for module, what in CAMPAIGNS.items():
        cases, faults, *_ = import_module(module).hunt(seed, share)
        count = faults if isinstance(faults, int) else len(faults)
        for fault in () if isinstance(faults, int) else faults:
            print(fault)
        print(f"{cases:8,d} cases, {count} false: {what}", flush=True)
        false += count
    sys.exit(false > 0)


if __name__ == "__main__":
    main()
