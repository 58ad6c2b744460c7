"""Contact probability over HTTP and from a terminal: what stands beside core's numbers."""

import numpy as np

from tests.app.questions.test_registry import REQUESTS


def test_quantiles_and_the_pair_are_of_the_first_contacts(ask):
    body, request, _ = REQUESTS["contact-probability"]
    got = ask("contact-probability", body)
    result = request()
    assert 5 < result.contacts < 60
    assert got["time_quantiles"] == np.quantile(result.time, (0.05, 0.5, 0.95)).tolist()
    pairs = result.benches.tolist()
    assert got["benches"] == max(sorted(pairs), key=pairs.count)


def test_without_a_contact_or_with_a_pitch_error_some_fields_are_null(ask):
    still = {"dragon": {"benches": 20}, "lateral": 0, "forward": 0, "samples": 2, "stop": 10}
    clear, other = (ask("contact-probability", still | more) for more in ({}, {"pitch_error": 0.01}))
    assert (clear["contacts"], clear["time_quantiles"], clear["benches"], clear["strayed"]) == (0, None, None, 0)
    assert 0.0 < clear["union_bound"] < 1e-9
    assert other["contacts"] == 0
    assert other["tolerance"] is other["strayed"] is other["union_bound"] is None
