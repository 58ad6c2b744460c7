"""Odd requests: valid and invalid ones made from the description of every call, and examples with odd values.

`make fuzz`: python -m tests.campaigns.fuzz CASES MUTANTS [SEED [FILES]] asks a service this many of each, sends it
damaged files (5,000 by default), and prints its answers; at last how long a quiet client waits beside ten busy ones.
"""

import copy
import json
import random
import tempfile
import time
from collections import Counter
from functools import partial
from pathlib import Path

import httpx
from hypothesis import HealthCheck, given, settings

from app.service.examples import EXAMPLES
from app.wire.problem import PROBLEM_TYPE
from tests.campaigns import hunting
from tests.support.attacks import ten_at_once, watching
from tests.support.largest import LARGEST
from tests.support.serving import serving

# Longest wait of a quiet client beside busy ones [s].
QUICK = 0.25
# Nothing takes longer than the deadline of an answer and a busy machine need [s].
SLOWEST = 20.0
ODD = (
    None, True, -1, 0, 0.0, -0.0, 1e-308, 1e308, -1e9, 1e6, 2**31, 2**63, 10**40, 0.1 + 0.2, "", "0", "NaN", "1e999",
    "龙", "a$\\frac{$", "\u0000", "\ud800", "x" * 5000, [], {}, [[]], [None] * 50, {"kind": "spiral"}, [1e300, -1e300],
    {"a": {"b": {"c": []}}},
)  # fmt: skip


class Tally:
    """Counts of a service's answers."""

    def __init__(self):
        self.statuses = Counter()
        self.slowest = (0.0, "")

    def __str__(self):
        return f"answers by status: {dict(sorted(self.statuses.items()))}; slowest {self.slowest}"

    def add(self, ask, request):
        """An answer, counted. raises: AssertionError for a fault of the service, or one without problem details"""
        begun = time.monotonic()
        try:
            answer = ask()
        except httpx.HTTPError as error:
            error.add_note(request)
            raise
        seconds = time.monotonic() - begun
        status = answer.status_code
        text = answer.content.decode(errors="replace")
        self.statuses[status] += 1
        self.slowest = max(self.slowest, (seconds, request[:200]))
        assert status < 500 or (status == 503 and "retry-after" in answer.headers), (request, text[:500])
        assert status < 400 or PROBLEM_TYPE in answer.headers["content-type"], (request, text[:500])
        assert "Traceback" not in text, request
        assert seconds < SLOWEST, (request, seconds)
        return answer


def mutated(value, chance):
    """The value with one thing in it changed: a part left out, renamed, repeated, or odd."""
    inner = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else []
    if not inner or chance.random() < 0.15:
        return copy.deepcopy(chance.choice(ODD))
    values = copy.deepcopy(value)
    at = chance.choice(inner)
    match chance.randrange(6):
        case 0:
            del values[at]
        case 1 if isinstance(values, dict):
            values[f"{at}_"] = values.pop(at)
        case 1:
            values += values
        case _:
            values[at] = mutated(values[at], chance)
    return values


def mutant(call, chance):
    """Path and options of a request that is one to three steps away from an example."""
    example = EXAMPLES[call]
    path = call.split()[1]
    request = (example.query if example.body is None else example.body) or {"pitch": 0.5}
    for _ in range(chance.randrange(1, 4)):
        request = mutated(request, chance)
    if example.body is None:
        pairs = request.items() if isinstance(request, dict) else [("pitch", request)]
        words = [(name, json.dumps(value) if isinstance(value, (dict, list)) else str(value)) for name, value in pairs]
        return path, {"params": [(name, word.encode("utf-8", "replace").decode()) for name, word in words]}
    content = json.dumps(request, allow_nan=True).encode()
    if chance.random() < 0.1:
        cut = chance.randrange(len(content) + 1)
        content = content[:cut] + chance.randbytes(chance.randrange(4)) + content[cut + chance.randrange(3) :]
    return path, {"content": content, "headers": {"Content-Type": "application/json"}}


def ask_mutants(url, count, seed=0):
    """Ask a number of them, each call in turn."""
    chance = random.Random(seed)
    tally = Tally()
    calls = sorted(EXAMPLES)
    with httpx.Client(base_url=url, timeout=2.0 * SLOWEST) as client:
        for number in range(count):
            call = calls[number % len(calls)]
            path, options = mutant(call, chance)
            tally.add(partial(client.request, call.split()[0], path, **options), f"{call} {options}")
    return tally


def ask_described(url, count):
    """Ask all calls as /openapi.json describes them, rightly and wrongly, with every check of schemathesis."""
    from schemathesis import GenerationMode

    from tests.app.test_openapi import TRIED, operations

    calls, checks = operations()
    tally = Tally()

    def conforms(case):
        request = f"{case.method} {case.path} {case.query} {case.body}"
        answer = tally.add(partial(case.call, base_url=url, timeout=2.0 * SLOWEST), request)
        case.validate_response(answer, checks=checks)

    for call, mode in TRIED:
        cases = calls[call].as_strategy(generation_mode=GenerationMode(mode))
        few = -(-count // len(TRIED))
        settings(max_examples=few, deadline=None, suppress_health_check=list(HealthCheck))(given(cases)(conforms))()
        print(f"{call} {mode}: {tally.statuses.total()} so far, slowest {tally.slowest[0]:.1f} s", flush=True)
    return tally


def beside_ten(folder):
    """Longest wait of a quiet client for /healthz, beside ten others with the largest input of each call [s]."""
    waits = {}
    with serving(folder / "ten.log") as service:
        for name in LARGEST:
            with watching(service.url, ("/healthz",), service.process.pid) as watch:
                ten_at_once(service.url, name)
            assert watch.failures == [], name
            waits[name] = watch.slowest["/healthz"]
    return dict(sorted(waits.items(), key=lambda wait: -wait[1]))


def main():
    from tests.campaigns.fuzz_files import ask_files, readers_over

    cases, mutants, seed, files = hunting.arguments(10_000, 12_000, 0, 5_000)
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder) / "log", workers=2) as service:
        print("files:", ask_files(service.url, files, seed, Path(tempfile.gettempdir())), flush=True)
        print("readers over their limit:", readers_over(httpx.get(f"{service.url}/metrics").text, 1e9), flush=True)
        print(ask_mutants(service.url, mutants, seed), flush=True)
        if cases:
            print(ask_described(service.url, cases))
    with tempfile.TemporaryDirectory() as folder:
        waits = beside_ten(Path(folder))
        print("longest waits for /healthz beside ten of the largest [s]:", waits)
        print(f"{sum(wait < QUICK for wait in waits.values())} of {len(waits)} below {QUICK} s")


if __name__ == "__main__":
    main()
