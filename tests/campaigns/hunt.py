"""All random campaigns against slow oracles: python -m tests.campaigns.hunt [SECONDS [SEED]].

The exit code is 1 for any false answer. Each campaign is a module with `hunt(seed, seconds)`, as in hunting.py. Time
is shared out among them.
"""

import sys
import time
from importlib import import_module

from tests.campaigns import hunting

# Module of each campaign, and what it judges.
CAMPAIGNS = {
    "tests.campaigns.hunt_contacts": "first contacts, least clearances and verdicts on any path, with passages",
    "tests.campaigns.hunt_corners": "the same on lines with corners, and handles and speeds there",
    "tests.campaigns.hunt_bends": "benches on routes with bends of any radius",
    "tests.campaigns.hunt_encounters": "first encounters of two to five dragons on one clock",
    "tests.campaigns.hunt_turns": "turns with any entry and exit, and long spirals",
    "tests.campaigns.hunt_venues": "walls and obstacles, up to the fold",
    "tests.campaigns.hunt_proposals": "dances proposed for random squares, and reasons where there is none",
    "tests.campaigns.differential": "certificates with a changed number, judged by both verifiers",
    "tests.campaigns.hunt_grades": "sheets and typed numbers that are nearly right",
}
SECONDS = 1200.0  # of all campaigns together


def main():
    (seconds, seed), false = hunting.arguments(SECONDS, int(time.time())), 0
    print(f"seed {seed}", flush=True)
    for module, what in CAMPAIGNS.items():
        result = import_module(module).hunt(seed, seconds / len(CAMPAIGNS))
        print(f"{result.cases:8,d} cases, {result.faults} false: {what}", flush=True)
        false += result.faults
    sys.exit(false > 0)


if __name__ == "__main__":
    main()
