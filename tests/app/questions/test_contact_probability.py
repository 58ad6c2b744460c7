"""Contact probability over HTTP and from a terminal: what stands beside core's numbers."""


def test_without_a_contact_or_with_a_pitch_error_some_fields_are_null(ask):
    still = {"dragon": {"benches": 20}, "lateral": 0, "forward": 0, "samples": 2, "stop": 10}
    clear, other = (ask("contact-probability", still | more) for more in ({}, {"pitch_error": 0.01}))
    assert (clear["contacts"], clear["time_quantiles"], clear["benches"], clear["strayed"]) == (0, None, None, 0)
    assert 0.0 < clear["union_bound"] < 1e-9
    assert other["contacts"] == 0
    assert other["tolerance"] is other["strayed"] is other["union_bound"] is None
