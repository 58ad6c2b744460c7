"""Poses that seek a contact: two benches of the default dragon, every chord kept, all holes within a little less than
the answer of tolerance().

`python -m tests.campaigns.adversaries` says how near a million of them come: scipy's differential evolution varies the
turn and the middle of both benches. Poses beyond the stray are taken back to its edge.
"""

import numpy as np
from scipy.optimize import differential_evolution

from core import Dance, Dragon, Spiral, bench_poses, clearance_profile, tolerance, trajectory
from core.shapes.rectangles import frames, frames_separation
from tests.support.random_strays import strays_of
from tests.support.scenes import lengths_and_widths

CIRCLE = 4.5  # radius of the turning circle [m]
# Turn and middle of a bench, in strays: see strays_of().
BOUNDS = [(-1.0, 1.0), (-2.0, 2.0), (-2.0, 2.0)] * 2
# Rounds at a place where benches come near, and at any other; times of these [1].
ROUNDS = 350
FEW_ROUNDS = 2
ANY_TIMES = 30
POPULATION = 100  # poses of a round, for each number that is varied [1]


def to_circle(pitch):
    """The default dragon on a spiral, and when its head is on the circle [s]."""
    spiral = Spiral(pitch)
    return Dance(Dragon(), spiral), spiral.travel_to(CIRCLE)


def gaps_of(dance, time, pair, stray):
    """The function of strayed places of two benches (6, N) [stray] whose value is their gaps (N,) [m]."""
    handles = trajectory(dance, time).position
    sizes = lengths_and_widths(dance.dragon)

    def framed(bench, shapes):
        chord = handles[bench : bench + 2]
        cosine, sine = (chord[0] - chord[1]) / dance.dragon.chords[bench]
        strays = strays_of(shapes[0], shapes[1:].T, dance.dragon.chords[bench], stray)
        poses = bench_poses(chord + strays @ [[cosine, sine], [-sine, cosine]])[:, 0]
        return frames(poses, np.broadcast_to(sizes[bench], (len(poses), 2)))

    def gaps(places):
        both = zip(pair, np.split(stray * places, 2), strict=True)
        return frames_separation(*(framed(*one) for one in both)).separation

    return gaps


def seek(dance, known, part=0.999, rounds=ROUNDS):
    """Gaps [m] of poses of a default dance with this part of its tolerance, where and when benches are the nearest."""
    at = known.time
    rng = np.random.default_rng(7)
    others = clearance_profile(dance, rng.uniform(0.0, known.stop, ANY_TIMES))
    places = [(at, (0, 19)), (at - 1.0, (0, 19)), (known.stop, (0, 18)), (322.9, (0, 17)), (320.0, (1, 20))]
    sought = []
    for k, (time, pair) in enumerate([*places, *zip(others.time, others.benches.tolist(), strict=True)]):
        gaps = gaps_of(dance, time, pair, part * known.stray)
        differential_evolution(
            lambda shapes, gaps=gaps: sought.append(gaps(shapes)) or sought[-1],
            BOUNDS, popsize=POPULATION, maxiter=rounds if k < len(places) else FEW_ROUNDS, tol=0.0, seed=7,
            polish=False, updating="deferred", vectorized=True,
        )  # fmt: skip
    return np.concatenate(sought)


def main():
    dance, stop = to_circle(0.55)
    known = tolerance(dance, stop=stop)
    gaps = seek(dance, known)
    result = "none touches" if gaps.min() > 0.0 else "some touch"
    most = 0.999 * known.stray
    print(f"{gaps.size} poses with strays up to {most:.6f} m: {result}; the nearest gap is {gaps.min():.2e} m")


if __name__ == "__main__":
    main()
