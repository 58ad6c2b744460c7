"""How many samples of the gaps between two moments are taken; the gaps: test_clearance.py."""

from core.contact.gaps import SAMPLES, sample_count


def test_the_number_of_samples_follows_the_span_and_the_work_that_is_left():
    counts = [sample_count(steps, work, 10.0) for steps, work in ((97.0, 1e9), (0.2, 1e9), (1e9, 1e9), (97.0, 500.0))]
    assert counts == [100, 3, SAMPLES, 5]
