"""Random routes with bends of any radius: a bench is proven to follow just those on which small steps see it follow.

Both verifiers of certificates prove this up to the place of a refusal, and not beyond.

python -m tests.campaigns.hunt_bends [SEED [SECONDS [CASES]]]: 10,000 cases take 20 minutes.
"""

from core import Clothoid, Dragon, Waypoints
from core.errors import ProofRefused
from core.kernels.constants import REAR_COSINE_LEAST
from core.paths.following import bends_widely, following
from core.proof.paths import recorded_path
from tests.campaigns import hunting
from tests.campaigns.differential import followed_to, proven_by_second
from tests.support.slow_follower import cosines_at, followed_slowly, twisted

# Part by which u . T at the rear handle may differ from the limit, and u . T at the front handle from 0 [1]; how far
# below the chord a nearer place must stay, which small steps see to 1e-5 m [m].
PART = 0.01
FRONT = 0.005
NEARER = 1e-4
# How far beyond the place of a refusal the small steps look again, and up to how near to it there are certificates [m].
JUST, NEAR = 1e-5, 1e-3


def judged(route, dragon):
    """What was said of the one bench on a route, and what the steps saw against it, '' for nothing."""
    if bends_widely(dragon, route):
        return "wide", ""
    proof = following(dragon, route)
    if wrong := certified(route, dragon, proof.obstacles):
        return "certified", wrong
    steps = followed_slowly(route, float(dragon.chords[0]))
    jumps = steps.jumps_at is not None
    if not proof.obstacles:
        worse = steps.rear_cosine < REAR_COSINE_LEAST * (1.0 - PART) or steps.front_cosine < -FRONT
        return "followed", str(steps) if jumps or worse or steps.spare < -NEARER else ""
    kind = proof.obstacles[0].reason.name.lower()
    if jumps or steps.spare < NEARER or fails(steps.rear_cosine, steps.front_cosine):
        return kind, ""
    # small steps may miss a narrow dip, and a short jump: there is one at the place of the refusal, or just beyond
    places = [proof.obstacles[0].s + beyond for beyond in (0.0, JUST)]
    true = any(fails(*cosines_at(route, float(dragon.chords[0]), s)) for s in places)
    return kind, "" if true else f"{proof}, but {steps}"


def certified(route, dragon, obstacles):
    """What is wrong with certificates of the ways before and beyond the first obstacle, '' for nothing."""
    begin = route.begin + float(dragon.chords[0]) + NEAR
    end = min((obstacle.s for obstacle in obstacles), default=route.end)
    if end - NEAR <= begin or any(isinstance(piece, Clothoid | Waypoints) for piece in route.pieces):
        return ""
    path = recorded_path(route)
    try:
        certificate = followed_to(dragon, path, begin, end - NEAR)
    except ProofRefused as refused:
        return str(refused)
    proven, words = proven_by_second(certificate)
    if not proven or not obstacles:
        return "" if proven else words
    try:
        followed_to(dragon, path, begin, end + NEAR)
    except ProofRefused:
        return ""
    return f"certified beyond {obstacles}"


def fails(rear_cosine, front_cosine):
    """Whether u . T at the handles is not clearly within the limits."""
    return rear_cosine < REAR_COSINE_LEAST * (1.0 + PART) or front_cosine < FRONT


def fault(seed, case):
    """The kind of the answer to a random case, and its fault in words ('' for none)."""
    rng = hunting.generator(seed, case)
    route = None
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
