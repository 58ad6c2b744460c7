"""The designs of a sweep: each follows from its index alone."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.sweeps.spec import Range, Samples, Spec
from core.values import Floats

Indices = NDArray[np.int64]

# Words of 64 bits from one round of Philox; the upper 53 bits of a word give a number in [0, 1).
PHILOX_WORDS = 4
DROPPED_BITS, UNIT = np.uint64(11), 2.0**-53
# Bits of Sobol points: the coordinates of up to 2^bits points are multiples of 2^-bits.
SOBOL_BITS = 30


def designs(spec: Spec, start: int, stop: int) -> dict[str, list[Any]]:
    """Values of every parameter that varies, for the designs from `start` to before `stop`.

    The index of a design is a number in a mixed base: the number of the sample, then one digit for each parameter that
    is not sampled, which is its place in the list of values.
    """
    rest = np.arange(start, stop, dtype=np.int64)
    values: dict[str, list[Any]] = {}
    for name, count in reversed(spec.counts.items()):
        rest, place = np.divmod(rest, count)
        axis = spec.over[name]
        at = place.tolist()
        values[name] = [axis.value(k) for k in at] if isinstance(axis, Range) else [axis[k] for k in at]
    if spec.samples:
        points = sample_points(spec.samples, len(spec.sampled), rest)
        for column, (name, axis) in zip(points.T, spec.sampled.items(), strict=True):
            values[name] = [axis.at(share) for share in column.tolist()]
    return {name: values[name] for name in spec.over}


def sample_points(samples: Samples, dimensions: int, indices: Indices) -> Floats:
    """Samples with these indices, (n, dimensions) in [0, 1)."""
    distinct, where = np.unique(indices, return_inverse=True)
    points = _sobol if samples.sequence == "sobol" else _philox
    first, last = int(distinct[0]), int(distinct[-1])
    return points(samples, dimensions, first, last - first + 1)[where]


def _philox(samples: Samples, dimensions: int, first: int, count: int) -> Floats:
    """Independent samples: sample k uses the rounds from k * rounds on, with rounds = dimensions / 4 rounded up."""
    rounds = -(-dimensions // PHILOX_WORDS)
    words = np.random.Philox(key=samples.seed, counter=first * rounds).random_raw(count * rounds * PHILOX_WORDS)
    return np.asarray((words >> DROPPED_BITS).reshape(count, -1)[:, :dimensions] * UNIT, np.float64)


def _sobol(samples: Samples, dimensions: int, first: int, count: int) -> Floats:
    """Sobol points: sample k is the exclusive or of the directions at the bits of its Gray code k ^ (k >> 1)."""
    bits = samples.count.bit_length()
    directions = _directions(dimensions, bits)
    index = np.arange(first, first + count, dtype=np.uint64)
    gray = index ^ (index >> np.uint64(1))
    words = np.zeros((count, dimensions), dtype=np.uint64)
    for bit in range(bits):
        chosen = (gray >> np.uint64(bit)) & np.uint64(1)
        words ^= chosen[:, None] * directions[bit]
    return np.asarray(words * 2.0**-SOBOL_BITS, np.float64)


@lru_cache(maxsize=4)
def _directions(dimensions: int, bits: int) -> NDArray[np.uint64]:
    """The first directions (bits, dimensions): sample 2^(b + 1) - 1 has the Gray code 2^b, so it is direction b.

    scipy reaches them sample by sample, which takes a second for 10^8 samples, once in a process.
    """
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimensions, scramble=False, bits=SOBOL_BITS)
    directions, at = [], 0
    for bit in range(bits):
        index = 2 ** (bit + 1) - 1
        sequence.fast_forward(index - at)
        directions.append(sequence.random(1)[0])
        at = index + 1
    return (np.array(directions) * 2.0**SOBOL_BITS).astype(np.uint64)
