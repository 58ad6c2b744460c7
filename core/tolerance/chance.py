"""Probability that benches touch when people wobble, from dances drawn at random, each up to its first contact.

The model is Wobble; core/kernels/wobble.py describes above its code how a wobbling dragon is laid out. The instants are
the same for all samples, at most a fifth of the correlation time apart; contacts between two instants are not seen.

Numbers. The numbers of a sample depend only on the seed and on the number of the sample. The generator Philox turns a
counter into random bits, and the counter holds the sample and the part of its numbers. So a sample is the same on every
machine with the same release of NumPy, in any order, and beside any other samples.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from numbers import Integral

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.checks import checked_type
from core.claims.certificate import WithClaim
from core.claims.claim import ClaimKind, ProbabilityClaim
from core.dance import Dance
from core.display import WithArrays, display
from core.error_free import paired
from core.errors import InvalidValue
from core.kernels import Budget, Halted
from core.language import counted, say
from core.motion.trajectory import trajectory
from core.quantities import Given, Quantity
from core.questions import question_about, too_much
from core.shapes.reach import gains
from core.tolerance.tolerance import tolerance
from core.tolerance.union_bound import union_bound
from core.tolerance.wobble import INSTANTS_PER_TIME, Wobble, check_sizes
from core.values import Floats, Interval, Progress, unheard

# Number of instants whose numbers come from one counter [1]. It is part of the definition of a sample: another value
# changes the samples.
INSTANTS_PER_COUNTER = 32
# Largest number of instants of a dance, and of samples [1].
INSTANTS_MAX, SAMPLES_MAX = 10_000_000, 10_000_000
# Largest seed that every JSON and every spreadsheet holds exactly [1].
SEED_MAX = 2**53 - 1
# Number of handles in a batch of samples that dance side by side [1]: the nominal dance is laid out once for a batch.
HANDLES_TOGETHER = 1_000_000
# Largest safe stray of a bench, relative to the shortest chord [1]: see core/kernels/wobble.py.
SAFE_PART = 0.25
# Confidence of the limits: probability with which the probability of the model lies between them [1].
CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class ContactProbability(WithArrays, WithClaim):
    """Probability that two benches touch at one of some instants when people wobble.

    probability: share of the samples in which two benches touch
    limits: limits of the probability of the model, after Clopper and Pearson, between which it lies with CONFIDENCE
    contacts: number of samples in which two benches touch
    samples: number of samples
    time: first contact of each sample that has one, (contacts,) [s]
    sample: number of that sample, (contacts,)
    benches: the pair of that contact, (contacts, 2)
    strays: largest distance of any hole from its place up to that contact, or to the end, (samples,) [m]
    tolerance: proven: while no hole is further from its place, nothing touches at any time; 0: none is known to be
        safe; None with a pitch error, which moves the places themselves [m]
    union_bound: proven without samples: the probability of the model is no larger at these instants; None with play or
        a pitch error (core/tolerance/union_bound.py)
    step: time between two instants; contacts between them are not seen [s]
    instants: number of instants of each sample
    start: first instant [s]
    stop: last instant [s]
    seed: seed of the random numbers

    >>> from core import Dragon, Spiral
    >>> answer = contact_probability(Dance(Dragon(20), Spiral()), Wobble(), 100, 1, start=390.0, stop=400.0)
    >>> answer.probability, tuple(round(limit, 3) for limit in answer.limits)
    (0.08, (0.035, 0.152))
    """

    probability: float
    limits: Interval
    contacts: int
    samples: int
    time: Floats
    sample: NDArray[np.int64]
    benches: NDArray[np.int64]
    strays: Floats
    tolerance: float | None
    union_bound: float | None
    step: float
    instants: int
    start: float
    stop: float
    seed: int

    @property
    def strayed(self) -> int | None:
        """Number of samples in which a hole was further from its place than the tolerance; no other one can touch."""
        return None if self.tolerance is None else int((self.strays > self.tolerance).sum())

    @property
    def claim(self) -> ProbabilityClaim:
        """What is known about the probability, as values."""
        return ProbabilityClaim(
            ClaimKind.CONTACT_PROBABILITY, self.contacts, self.samples, self.instants, self.step, CONFIDENCE,
            self.union_bound, self.tolerance, self.samples - (self.strayed or 0),
        )  # fmt: skip

    def _line(self) -> str:
        low, high = self.limits
        return say(
            "{probability}, between {low:.6g} and {high:.6g}: {contacts} in {samples}",
            probability=display(self.probability), low=low, high=high,
            contacts=counted(self.contacts, "{count} contact", "{count} contacts"),
            samples=counted(self.samples, "{count} sample", "{count} samples"),
        )  # fmt: skip


@question_about("dance", Dance)
def contact_probability(
    dance: Dance,
    model: Wobble,
    samples: int | range,
    seed: int,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
    progress: Progress | None = None,
) -> ContactProbability:
    """Probability that two benches touch when people wobble, from dances drawn at random.

    samples: their number, or a range of sample numbers, so that others can be drawn elsewhere; seed: from 0 to SEED_MAX
    start, stop: [s]; defaults: dance.begin and the end of the run
    budget: of all work, 1 for each handle of each instant of each sample; by default without limit
    progress: called with the share of the work that is done
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> contact_probability(Dance(Dragon(20), Spiral()), Wobble(), 100, 1, start=380.0, stop=400.0).contacts
    9
    """
    checked_type("model", model, Wobble)
    which, seed = _checked_samples(samples), _checked_seed(seed)
    check_sizes(dance, model)
    begin, until = dance.whole_span(start, stop)
    widest = model.correlation_time / INSTANTS_PER_TIME if model.step is None else model.step
    count = math.ceil((until - begin) / widest) + 1
    if count > INSTANTS_MAX:
        field, factor = ("step", 1) if model.step else ("correlation_time", INSTANTS_PER_TIME)
        least = factor * (until - begin) / (INSTANTS_MAX - 1)
        rule, got = "must be at least {least}: a dance has at most {most} instants", Quantity(factor * widest, "s", 9)
        raise InvalidValue(f"model.{field}", rule, got=got, least=Quantity(least, "s", 3), most=INSTANTS_MAX)
    budget = budget or Budget()
    step = (until - begin) / (count - 1)
    times = np.linspace(begin, until, count)
    steady, at = dance.steady, dance.steady_times(times)  # people wobble in a pause too, so instants are even in time
    sampled = _Sampled(steady, model, at, math.exp(-step / model.correlation_time), seed, budget)
    together = max(1, HANDLES_TOGETHER // (dance.dragon.benches + 1))
    first_contacts = _FirstContacts(len(which))
    try:
        for first in range(0, len(which), together):
            batch = which[first : first + together]
            for share in sampled.dance(batch, first_contacts, first):
                (progress or unheard)((first + share * len(batch)) / len(which))
        bound = None if model.pitch_error or model.play else union_bound(steady, model, at, budget)
    except Halted as halted:
        rule = "must be fewer, or the time asked about shorter: the probability of a contact was not found {then}"
        many = ("samples", rule, len(which)) if len(which) > 1 else ("dragon.benches", rule, dance.dragon.benches)
        raise too_much(halted.budget, *many) from halted
    safe = None if model.pitch_error else tolerance(dance, start=begin, stop=until, budget=budget).stray
    touched = np.flatnonzero(first_contacts.instant < count)
    contacts, total, pairs = touched.size, len(which), first_contacts.benches[touched]
    return ContactProbability(
        contacts / total, clopper_pearson(contacts, total), contacts, total, times[first_contacts.instant[touched]],
        np.asarray(which)[touched], pairs, first_contacts.strays, safe, bound, step, count, begin, until, seed,
    )  # fmt: skip


class _FirstContacts:
    """Result of each sample: the instant of its first contact, or one past the last; the pair; the largest stray."""

    def __init__(self, samples: int) -> None:
        self.instant = np.zeros(samples, dtype=np.int64)
        self.benches = np.zeros((samples, 2), dtype=np.int64)
        self.strays = np.zeros(samples)


class _Sampled:
    """A dance whose people wobble at some instants (T,) [s], each with a memory of the one before [1]."""

    def __init__(self, dance: Dance, model: Wobble, times: Floats, memory: float, seed: int, budget: Budget) -> None:
        self.nominal, self.model, self.times, self.budget = dance, model, times, budget
        dragon, benches = dance.dragon, dance.dragon.benches
        sizes = np.zeros((benches + 1, kernels.SIZE_COLUMNS))
        radii = 0.5 * np.hypot(dragon.lengths, dragon.widths)
        sizes[:benches] = np.stack([dragon.chords, 0.5 * dragon.lengths, 0.5 * dragon.widths, radii], axis=1)
        chain, boxes = (np.zeros((benches + 1, columns)) for columns in (kernels.UY + 1, kernels.BOX_COLUMNS))
        self.wobbler = kernels.Wobbler(sizes, budget, chain, boxes, *np.zeros((2, benches + 1), dtype=np.int8))
        self.wobbler.lateral, self.wobbler.forward, self.wobbler.along = model.lateral, model.forward, model.along
        self.gains = gains(dragon)
        self.safe_most = SAFE_PART * float(dragon.chords.min())
        self.memory = np.full(times.size, memory)
        self.memory[0] = 0.0
        self.numbers = _Numbers(seed)

    def dance(self, batch: range, contacts: _FirstContacts, first: int) -> Iterator[float]:
        """Let a batch of samples dance side by side, from entry `first` of `contacts` on; yields the share done."""
        handles, count = self.nominal.dragon.benches + 1, self.times.size
        state = np.zeros((len(batch), handles, 2))
        play, pitches = self._play(batch), self._pitches(batch)
        going = list(range(len(batch)))
        contacts.instant[first : first + len(batch)] = count
        for part, low in enumerate(range(0, count, INSTANTS_PER_COUNTER), 2):
            if not going:
                break
            rows = slice(low, min(low + INSTANTS_PER_COUNTER, count))
            shared = self._nominal(rows) if self.model.pitch_error == 0.0 else None
            still = []
            for k in going:
                places, tangents, safe = shared or self._on_pitch(rows, pitches[k])
                length = len(places)
                self.budget.afford(float(length * handles))
                drawn = self.numbers.of(batch[k], part).standard_normal((length, handles, 2))
                self.wobbler.furthest = contacts.strays[first + k]
                memory = self.memory[low : low + length]
                clear = self.wobbler.dance(memory, drawn, play[k], places, tangents, safe, state[k])
                contacts.strays[first + k] = self.wobbler.furthest
                if clear < length:
                    contacts.instant[first + k] = low + clear
                    contacts.benches[first + k] = self.wobbler.first, self.wobbler.second
                elif length == rows.stop - low:
                    still.append(k)
            self.budget.look()
            going = still
            yield rows.stop / count

    def _nominal(self, rows: slice) -> tuple[Floats, Floats, Floats]:
        """Nominal places and tangents (T, n + 1, 2) of all handles, and safe stray of every bench (T, n) [m]."""
        placed = trajectory(self.nominal, self.times[rows])
        places, tangents = placed.position, placed.velocity / placed.speed[..., None]
        safe = np.empty((len(places), places.shape[1] - 1))
        self.wobbler.measure(self.safe_most, self.gains, places, safe)
        return places, tangents, safe

    def _play(self, batch: range) -> Sequence[Floats]:
        """Offsets of the holes of every bench from their pins, (n, 4) for every sample [m]."""
        benches, most = self.nominal.dragon.benches, self.model.play
        if most == 0.0:
            return [np.zeros((benches, 4))] * len(batch)
        drawn = np.stack([self.numbers.of(sample, 0).random((2, benches, 2)) for sample in batch])
        radius, angle = most * np.sqrt(drawn[:, 0]), 2.0 * math.pi * drawn[:, 1]
        play: Floats = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
        return list(play.reshape(len(batch), benches, 4))

    def _pitches(self, batch: range) -> list[float]:
        """The pitch of each sample [m]."""
        spiral, size = self.nominal.path.spiral, self.model.pitch_error
        if size == 0.0 or spiral is None:
            return []
        return [spiral.pitch + size * float(self.numbers.of(sample, 1).standard_normal()) for sample in batch]

    def _on_pitch(self, rows: slice, pitch: float) -> tuple[Floats, Floats, Floats]:
        """As _nominal(), on a spiral of another pitch [m], up to its fold at most; no stray counts as safe."""
        spiral, chords = self.nominal.path.spiral, self.nominal.dragon.chords
        assert spiral is not None
        theta = paired(spiral.theta(self.times[rows] * self.nominal.head_speed) * (spiral.pitch / pitch))
        shape = (len(theta), chords.size + 1)
        places, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
        growth = pitch / (2.0 * math.pi)
        length = kernels.spiral_trajectory(growth, theta, chords, 1.0, places, velocity, speed, self.budget)
        tangents = velocity[:length] / speed[:length, :, None]
        return places[:length], tangents, np.zeros((length, chords.size))


class _Numbers:
    """The random numbers of every sample, in parts; see the top of this file. Part 0 is for its play, part 1 for its
    pitch, and each further part for INSTANTS_PER_COUNTER instants."""

    def __init__(self, seed: int) -> None:
        self._bits = np.random.Philox(key=seed)
        self._state = self._bits.state
        self._generator = np.random.Generator(self._bits)

    def of(self, sample: int, part: int) -> np.random.Generator:
        """A generator at the beginning of a part of the numbers of a sample."""
        # Philox counts up from here, in the lowest of the four words.
        self._state["state"]["counter"][:] = (0, part, sample, 0)
        self._bits.state = self._state
        return self._generator


def clopper_pearson(contacts: int, samples: int) -> Interval:
    """Limits between which the probability of a contact lies with CONFIDENCE, from a number of contacts among samples.

    source: Clopper and Pearson, Biometrika 26 (1934), 404-413: at the lower limit this number of contacts or more has
        the probability (1 - CONFIDENCE) / 2, and at the upper limit this number or fewer has it

    >>> [round(limit, 6) for limit in clopper_pearson(0, 100)]
    [0.0, 0.036217]
    """
    from scipy.special import betaincinv  # type: ignore[import-untyped]

    tail = 0.5 * (1.0 - CONFIDENCE)
    low = float(betaincinv(contacts, samples - contacts + 1, tail)) if contacts else 0.0
    high = float(betaincinv(contacts + 1, samples - contacts, 1.0 - tail)) if contacts < samples else 1.0
    return low, high


def _checked_samples(samples: object) -> range:
    if isinstance(samples, Integral) and not isinstance(samples, bool) and 1 <= int(samples) <= SAMPLES_MAX:
        return range(int(samples))
    if isinstance(samples, range) and samples and min(samples) >= 0 and max(samples) < SAMPLES_MAX:
        return samples
    rule = "must be a whole number from 1 to {most}, or a range of numbers below {most}"
    raise InvalidValue("samples", rule, got=Given(samples), most=SAMPLES_MAX)


def _checked_seed(seed: object) -> int:
    if isinstance(seed, Integral) and not isinstance(seed, bool) and 0 <= int(seed) <= SEED_MAX:
        return int(seed)
    raise InvalidValue("seed", "must be a whole number from 0 to {most}", got=Given(seed), most=SEED_MAX)
