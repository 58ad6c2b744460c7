"""The two checkers of certificates against each other: they must have one verdict on changed ones with fitted digests.

python -m tests.campaigns.differential [CASES] [SEED] checks 100,000 changed certificates and prints those about which
core/proof and examples/verify.py disagree; exit code 1 if there is any.

A stretch that one of them cannot show at once may be shown in parts: their enclosures differ, and verify.py halves
stretches. So where only one proves a certificate, the same one with finer stretches must be proven by both.
"""

import copy
import importlib.util
import itertools
import math
import random
from functools import cache
from pathlib import Path

from flint import ctx

from core import Arc, Coil, Dance, Dragon, Line, Route, Spiral, Turn, first_contact, minimum_pitch
from core.errors import ProofRefused
from core.proof import (
    prove_clear,
    prove_collision_time,
    prove_contact,
    prove_minimum_pitch,
    prove_tolerance,
    verify,
)
from core.proof.certificate import PRECISION, digest
from core.proof.paths import chain_on
from core.proof.sweeps import proven_sweeps, searched_stretches
from core.proof.words import runs
from core.tolerance.tolerance import tolerance
from core.values import unheard
from tests.campaigns import hunting
from tests.support.forgeries import places, through_json
from tests.support.proof_routes import cornered, rounded

VERIFY = Path(__file__).parents[2] / "examples" / "verify.py"
# Parts of each stretch, where only one of the two proves a certificate.
PARTS = (8, 64)
# Factors and values that a number may get.
FACTORS = (0.0, -1.0, 0.5, 2.0, 1e3, 1e-3, 1.0 + 1e-12, 1.0 - 1e-12, 1.0 + 1e-6, 1.0 - 1e-6, 1.01, 0.99)
ODD = (0, -0.0, 1e-320, 1e308, math.nan, math.inf, True, None, "", [], {}, 10**30, "fold", 0.001, 10_000)


@cache
def second():
    """examples/verify.py as a module."""
    spec = importlib.util.spec_from_file_location("second_verifier", VERIFY)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _contact(dragon, path, before, margin=0.0):
    dance = Dance(dragon, path)
    when = first_contact(dance, margin=margin, start=dance.default_start).time
    assert when is not None
    return prove_contact(dance, when, start=when - before, margin=margin)


def _pitch(dragon, radius, turns, margin=0.0):
    pitch = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin).pitch + 1e-9
    return prove_minimum_pitch(dragon, pitch, turning_radius=radius, start_turns=turns, margin=margin)


def _collision():
    dance = Dance(Dragon(4, 3.61, 2.4, 0.12, 0.1), Spiral(0.48, 3.4))
    when = first_contact(dance).time
    assert when is not None
    return prove_collision_time(dance, when)


def _strayed(with_exhibit):
    dance = Dance(Dragon(6), Spiral(0.7, 5.0))
    result = tolerance(dance, start=44.0, stop=44.9)
    stray = result.stray if with_exhibit else 0.02
    return prove_tolerance(dance, stray, exhibit=result.exhibit if with_exhibit else None, start=44.0, stop=44.9)


# The shortest turn known that benches follow (docs/contest.md), with a free exit.
SHORT = Turn(1.7, ratio=0.66439183, entry_radius=3.8721413324, exit_radius=4.4999969274, start_turns=5.0)
MAKERS = {
    "collision time": _collision,
    "contact": lambda: _contact(Dragon(9), Spiral(0.55, 6.0), 0.5),
    "contact with a margin": lambda: _contact(Dragon(9), Spiral(0.55, 6.0), 0.5, 0.04),
    "minimum pitch": lambda: _pitch(Dragon(4), 1.8, 3.0),
    "minimum pitch with a margin": lambda: _pitch(Dragon(4), 1.8, 3.0, 0.02),
    "minimum pitch at a fold": lambda: _pitch(Dragon(4, 2.21, 1.47, 0.06, 0.12), 0.85, 2.5),
    "minimum pitch at the start": lambda: prove_minimum_pitch(Dragon(2), 0.28125),
    "clear": lambda: prove_clear(Dance(Dragon(4), Spiral(0.8, 5.0)), 3.0, start=1.0),
    "clear with a margin": lambda: prove_clear(Dance(Dragon(4), Spiral(0.8, 5.0)), 3.0, start=-1.0, margin=0.1),
    "clear to the fold": lambda: prove_clear(Dance(Dragon(4), Spiral(0.9, 3.0)), start=14.0),
    "clear to the centre": lambda: prove_clear(Dance(Dragon(3), Spiral(9.0, 0.7))),
    "turn": lambda: prove_clear(Dance(Dragon(3), Turn(1.7, start_turns=5.0)), 3.0, start=-1.0),
    "turn with a margin": lambda: prove_clear(Dance(Dragon(3), Turn(1.7)), 16.0, start=14.0, margin=0.3),
    "turn with a tight arc": lambda: prove_clear(Dance(Dragon(3), SHORT), 11.0, start=7.0),
    "route": lambda: prove_clear(
        Dance(Dragon(3), Route([Line((0, 0), (10, 0)), Arc((10, 3), 3.0, -math.pi / 2, 2.0)], start=1.0)), start=10.0
    ),
    "coil outwards": lambda: prove_clear(Dance(Dragon(3), Route([Coil(1.5, 1.5, 2.2, (1, 2), 0.5)])), start=8.5),
    "corner": lambda: prove_clear(Dance(Dragon(5), cornered([12.0, 12.0], [40.0]))),
    "tight arc": lambda: prove_clear(Dance(Dragon(5), rounded(12.0, 1.0, 107.0, 12.0))),
    "contact over corners": lambda: _contact(Dragon(18), cornered([32.0, 4.0, 4.0, 4.0, 30.0], [60.0] * 4), 0.2),
    "two benches at a corner": lambda: prove_clear(Dance(Dragon(2), cornered([6.0, 6.0], [-70.0]))),
    "stray": lambda: _strayed(False),
    "stray with a pose": lambda: _strayed(True),
}


@cache
def made(name):
    """A true certificate with few stretches."""
    return through_json(MAKERS[name]())


def fitted(content):
    """The content with a digest that fits it."""
    content = {name: value for name, value in content.items() if name != "digest"}
    return content | {"digest": digest(content)}


def followed_to(dragon, path, start, stop):
    """The certificate that one bench follows a path, as a certificate writes it, between two places of the head [m].

    raises: ProofRefused if core/proof does not find its stretches
    """
    claim = {"kind": "clear", "path": path, "head_speed": 1.0, "start": start, "stop": stop, "until": "stop"}
    chain, ways = chain_on(dragon, path, 0.0), (-math.nextafter(start, -math.inf), -math.nextafter(stop, math.inf))
    with ctx.workprec(PRECISION):
        sweeps = proven_sweeps(chain, *ways, 0, searched_stretches(chain), unheard, follows=True)
    return fitted(made("two benches at a corner") | {"dragon": runs(dragon), "claim": claim, "sweeps": sweeps})


def proven_by_core(certificate):
    """Whether core/proof proves it, and the statement or the reason."""
    try:
        return True, verify(copy.deepcopy(certificate)).statement
    except ProofRefused as refused:
        return False, refused.message


def proven_by_second(certificate):
    """The same of examples/verify.py."""
    module = second()
    try:
        return True, module.verified(copy.deepcopy(certificate))
    except module.Refused as refused:
        return False, str(refused)


def cut(certificate, parts):
    """The same certificate, each stretch in so many parts, and each sweep some last digits longer, because the checkers
    enclose the place at which it has to arrive in their own ways."""
    content = copy.deepcopy(certificate)
    for sweep in content["sweeps"]:
        tiles, sweep["stretches"] = sweep["stretches"], []
        for high, low, *faces in tiles:
            places = [high, *(high + (low - high) * k / parts for k in range(1, parts)), low]
            sweep["stretches"] += [[start, end, *faces] for start, end in itertools.pairwise(places)]
        if sweep["stretches"]:
            last = sweep["stretches"][-1]
            last[1] -= 4.0 * math.ulp(last[1])
    return fitted(content)


def _stops_at_the_end(certificate, stop):
    """Whether core/proof does not refuse the stop that is 16 last digits earlier for coming after the end."""
    earlier = copy.deepcopy(certificate)
    earlier["claim"]["stop"] = stop - 16.0 * math.ulp(stop)
    return "when the path ends, got" not in proven_by_core(fitted(earlier))[1]


def disagreement(certificate):
    """How the two checkers disagree about a certificate; empty if they agree."""
    first = proven_by_core(certificate)
    other = proven_by_second(certificate)
    # The end of a route is a double that core rounds on its way: a stop some last digits later is no disagreement.
    stop = certificate.get("claim", {}).get("stop") if isinstance(certificate.get("claim"), dict) else None
    edge = "when the path ends, got" in first[1] and isinstance(stop, float)
    if first[0] == other[0] or (edge and _stops_at_the_end(certificate, stop)):
        return ""
    for parts in PARTS:
        finer = cut(certificate, parts)
        finer_first = proven_by_core(finer)
        finer_other = proven_by_second(finer)
        if finer_first[0] and finer_other[0]:
            return ""
    return f"only {'core/proof' if first[0] else 'verify.py'} proves it: {first[1][:300]} | {other[1][:300]}"


def changed(certificate, dice):
    """A certificate with one change, sometimes two, and a digest that fits."""
    content = copy.deepcopy({name: value for name, value in certificate.items() if name != "digest"})
    for _ in range(dice.choice((1, 1, 1, 2))):
        _change(content, dice)
    try:
        return fitted(content)
    except TypeError:  # names that cannot be sorted
        return certificate


def _change(content, dice):
    # Half of the changes are outside of the stretches, which are most of a certificate.
    outside = {name: content[name] for name in content if name != "sweeps"}
    result = places(outside if dice.random() < 0.5 else content, most=None)[1:]
    place = dice.choice(result)
    inside = content
    for step in place[:-1]:
        inside = inside[step]
    name = place[-1]
    value = inside[place[-1]]
    kind = dice.random()
    if isinstance(value, float | int) and not isinstance(value, bool) and kind < 0.8:
        inside[name] = _number(value, dice)
    elif isinstance(value, str) and value.isdigit() and kind < 0.9:
        k = dice.randrange(len(value))
        inside[name] = value[:k] + dice.choice((*"0123456789", "", 2 * value[k])) + value[k + 1 :]
    elif isinstance(value, list) and value and kind < 0.9:
        k = dice.randrange(len(value))
        other = dice.randrange(len(value))
        dice.choice(
            (
                lambda: value.pop(k),
                lambda: value.insert(other, copy.deepcopy(value[k])),
                value.reverse,
                lambda: _join(value, k),
            )
        )()
    elif isinstance(inside, dict) and kind < 0.9:
        dice.choice((lambda: inside.pop(name), lambda: inside.__setitem__(str(name) + "s", value)))()
    else:
        inside[name] = dice.choice(ODD)


def _join(entries, k):
    """Joins two stretches, if these entries are any."""
    if k + 1 < len(entries) and all(isinstance(entry, list) and len(entry) > 2 for entry in entries[k : k + 2]):
        entries[k][1] = entries.pop(k + 1)[1]


def _number(value, dice):
    if isinstance(value, int):
        return value + dice.choice((-1, 1, 2, -value, 1000))
    return dice.choice(
        (
            value * dice.choice(FACTORS),
            math.nextafter(value, math.inf),
            math.nextafter(value, -math.inf),
            value + dice.choice((-1, 1)) * 10.0 ** dice.uniform(-12.0, 1.0),
            round(value, dice.randrange(9)),
        )
    )


def hunt(seed, seconds=0.0, cases=None):
    """Changed certificates, one after the other from one row of random numbers, and the disagreements about them."""
    dice = random.Random(seed)

    def fault(seed, case):
        name = dice.choice(list(MAKERS))
        certificate = changed(made(name), dice)
        try:
            return name, disagreement(certificate)
        except Exception as error:  # a checker that ends in any other way is wrong too
            return name, repr(error)

    return hunting.hunt(fault, seed, seconds, cases)


if __name__ == "__main__":
    cases, seed = hunting.arguments(100_000, 0)
    hunting.main(hunt, "changed certificates", seed, 0.0, cases)
