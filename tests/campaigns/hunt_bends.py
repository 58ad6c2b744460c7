"""Random routes with bends of any radius: a bench is proven to follow just those on which small steps see it follow.

python -m tests.campaigns.hunt_bends [SEED [SECONDS [CASES]]]: 10,000 cases take 20 minutes.
"""

from core import Dragon
from core.kernels.constants import REAR_COSINE_LEAST
from core.paths.following import bends_widely, following
from tests.campaigns import hunting
from tests.support.slow_follower import followed_slowly, twisted

# Part by which u . T at the rear handle may differ from the limit, and u . T at the front handle from 0 [1]; how far
# below the chord a nearer place must stay, which small steps see to 1e-5 m [m].
PART, FRONT, NEARER = 0.01, 0.005, 1e-4


def judged(route, dragon):
    """What was said of the one bench on a route, and what the steps saw against it, '' for nothing."""
    if bends_widely(dragon, route):
        return "wide", ""
    proof, steps = following(dragon, route), followed_slowly(route, float(dragon.chords[0]))
    jumps = steps.jumps_at is not None
    if not proof.obstacles:
        worse = steps.rear_cosine < REAR_COSINE_LEAST * (1.0 - PART) or steps.front_cosine < -FRONT
        return "followed", str(steps) if jumps or worse or steps.spare < -NEARER else ""
    better = steps.rear_cosine > REAR_COSINE_LEAST * (1.0 + PART) and steps.front_cosine > FRONT
    false = better and steps.spare > NEARER and not jumps
    return proof.obstacles[0].reason.name.lower(), f"{proof}, but {steps}" if false else ""


def fault(seed, case):
    """The kind of the answer to a random case, and its fault in words ('' for none)."""
    rng, route = hunting.generator(seed, case), None
    dragon = Dragon(1, rng.uniform(1.4, 2.4), overhang=0.2)
    while route is None:
        route = twisted(rng, 3.0 * float(dragon.chords[0]))
    return judged(route, dragon)


def hunt(seed, seconds=hunting.SECONDS, cases=None):
    """Judge case after case."""
    return hunting.hunt(fault, seed, seconds, cases)


if __name__ == "__main__":
    seed, seconds, cases = hunting.arguments(0, hunting.SECONDS, 0)
    hunting.main(hunt, "routes", seed, seconds, cases or None)
