"""Least gaps between two moments, of two pairs whose gaps are parabolas."""

from dataclasses import dataclass

from core.contact.gaps import SAMPLES, grazes, refined, sample_count, sampled, sampled_again, sampled_least
from core.kernels.results import Dip

# Each pair with the moment and the gap of its bottom.
BOTTOMS = {(0, 2): (3.0, 0.5), (1, 3): (7.0, 0.25)}
FIRST, SECOND = (Dip(gap, moment, pair) for pair, (moment, gap) in BOTTOMS.items())


@dataclass
class Parabolas:
    """The gaps of both pairs, which part with the square of the time from their bottoms."""

    span: tuple[float, float] = (0.0, 10.0)
    count: int = 15
    spacing: float = 1.0

    def look(self, moment, known=(0, 0)):
        return min(Dip(gap + (moment - at) ** 2, moment, pair) for pair, (at, gap) in BOTTOMS.items())

    sample = look

    def gap_rate(self, moment, pair):
        return 2.0 * (moment - BOTTOMS[pair][0])

    def bottom(self, low, high, pair):
        return min(max(BOTTOMS[pair][0], low), high)


def test_every_bottom_is_a_graze_and_the_lowest_one_is_the_least_gap():
    gaps = Parabolas()
    samples = sampled(gaps)
    assert list(grazes(gaps, samples)) == [FIRST, SECOND]
    assert sampled_least(gaps, samples) == refined(gaps, 6.5) == SECOND
    assert refined(gaps, 2.5) == FIRST


def test_a_gap_at_an_end_of_the_span_counts():
    gaps = Parabolas(span=(4.0, 6.5))
    assert sampled_least(gaps, sampled(gaps)) == Dip(0.5, 6.5, (1, 3))


def test_only_samples_that_may_matter_are_looked_at_again():
    gaps = Parabolas()
    wide = [dip._replace(gap=dip.gap + 5.0) for dip in sampled(gaps)]
    again = sampled_again(gaps, wide, 6.0)
    assert [new.gap < old.gap for new, old in zip(again, wide, strict=True)] == [old.gap <= 6.0 for old in wide]


def test_the_number_of_samples_follows_the_span_and_the_work_that_is_left():
    counts = [sample_count(steps, work, 10.0) for steps, work in ((97.0, 1e9), (0.2, 1e9), (1e9, 1e9), (97.0, 500.0))]
    assert counts == [100, 3, SAMPLES, 5]
