"""The service agrees with /openapi.json, and /openapi.json is complete."""

import json
from functools import cache

import pytest
from hypothesis import HealthCheck, assume, given, settings

from app.service.examples import EXAMPLES, FILE
from app.service.main import create_app
from app.settings import Settings
from app.wire.problem import PROBLEM_TYPE
from app.wire.question import JSON
from tests.app.conftest import ANSWER_TIMEOUT
from tests.support.depth import examples, few
from tests.support.renew_examples import text

EXAMPLES_PER_CALL = examples(5, 25)
# Examples with right values for the calls that take up to a second each, and with wrong ones for files,
# some of which are drawn. A picture has no schema to conform to, and its request is that of the question that it draws.
SLOW = ("POST /contest-kit", "POST /crew", "POST /cues", "POST /films", "POST /maps.{format}", "POST /plan")
# With right values these take up to ten seconds each, for arbitrary dragons and films of any size.
SLOWER = (
    "pitch-scan pitch-scan.{format} tolerance-curve contact-probability envelope proposals contest-kit crew cues films "
    "plan safe-delay"
)
EXAMPLES_OF_SLOW = examples(3, 8)
# Grazes are flat in time, so theirs is known to 1e-7 s only [m], [s], [rad] and relative.
EXAMPLE_TOLERANCE = 1e-6
SPENT = "steps marches bound evaluations method evidence at_least head_speed_bracket speed_bracket"
# Requests that fit the schema may still be refused: an overhang beyond half a bench, an instant after the fold.
UNCHECKED = "positive_data_acceptance"
# Kinds of values that schemathesis makes, which only the tests that ask it load: it takes 65 MB.
RIGHT = "positive"
WRONG = "negative"

DOCUMENT = create_app(Settings()).openapi()
CALLS = [f"{method.upper()} {path}" for path, methods in DOCUMENT["paths"].items() for method in methods]
DESCRIBED = [call for methods in DOCUMENT["paths"].values() for call in methods.values()]


def without_tuples(schema):
    """A tuple as an array of what its places may hold: schemathesis 4.32 reads no tuples in answers."""
    if isinstance(schema, list):
        return [without_tuples(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    plain = {key: without_tuples(part) for key, part in schema.items() if key != "prefixItems"}
    if "prefixItems" in schema:
        plain["items"] = {"anyOf": without_tuples(schema["prefixItems"])}
    return plain


@cache
def operations():
    """The calls as schemathesis reads them, all before the first, and what it checks in each answer."""
    import schemathesis
    from schemathesis.checks import CHECKS

    described = schemathesis.openapi.from_dict(without_tuples(DOCUMENT)).get_all_operations()
    calls = {call.label: call for call in (operation.ok() for operation in described)}
    return calls, [check for check in CHECKS.get_all() if check.__name__ != UNCHECKED]


def is_tried(call, mode):
    """Every call with right values, but for the slower ones; with wrong ones if it takes any."""
    method, path = call.split()
    if mode == RIGHT:
        return not path.endswith(tuple(SLOWER.split()))
    description = DOCUMENT["paths"][path][method.lower()]
    return "requestBody" in description or "parameters" in description


def examples_of(call, mode):
    is_slow = call in SLOW or (mode == RIGHT and ("/figures/" in call or "/minimum-pitch" in call))
    return EXAMPLES_OF_SLOW if is_slow else EXAMPLES_PER_CALL


def is_a_spiral_that_does_not_say_so(body):
    """A path without a kind: the schema asks for one, so that clients tell paths apart; the service takes a spiral."""
    path = body.get("path") if isinstance(body, dict) else None
    return isinstance(path, dict) and "kind" not in path


TRIED = [(call, mode) for call in CALLS for mode in (RIGHT, WRONG) if is_tried(call, mode)]


@pytest.mark.parametrize("tried", few(TRIED, 6), ids=" ".join)
def test_every_call_conforms_to_its_description(server, tried):
    from schemathesis import GenerationMode
    from schemathesis.core import NOT_SET

    call, mode = tried
    calls, checks = operations()
    strategy = calls[call].as_strategy(generation_mode=GenerationMode(mode))

    @given(case=strategy)
    @settings(
        max_examples=examples_of(call, mode), deadline=None, derandomize=True, suppress_health_check=list(HealthCheck)
    )
    def conforms(case):
        assume(not (mode == WRONG and is_a_spiral_that_does_not_say_so(case.body)))
        # Without a body the question is a right one, about the default dance.
        if call in SLOW or (call.startswith("POST ") and not is_tried(call, RIGHT)):
            assume(case.body is not NOT_SET)
        has_play = isinstance(case.body, dict) and "hole" in case.body
        if call == "POST /minimum-pitch" and has_play and case.body.get("dragon", {}) == {}:
            case.body["dragon"] = {"benches": 40}  # 223 with much play of their pins take 5 s.
        if call == "POST /films" and isinstance(case.body, dict):  # 1080 pixels take 18 s of computing.
            case.body.setdefault("height", 90)
        case.call_and_validate(base_url=server, checks=checks, timeout=ANSWER_TIMEOUT)

    conforms()


def holds_floats(field):
    inner = [*field.get("anyOf", []), *field.get("prefixItems", []), *([field["items"]] if "items" in field else [])]
    return field.get("type") == "number" or any(isinstance(one, dict) and holds_floats(one) for one in inner)


# Directions, ratios, probabilities and numbers of benches have no unit, and the paper's numbers theirs beside them;
# what there is and what it takes have the unit of the reason.
WITHOUT_UNIT = (
    "rows probability limits confidence union_bound correlation_benches normal ratio speed_ratio paper published ours "
    "difference value found expected have need"
)


def test_every_field_is_described_and_every_measure_has_its_unit():
    schemas = DOCUMENT["components"]["schemas"].values()
    fields = [pair for one in schemas for pair in one.get("properties", {}).items()]
    fields += [(one["name"], one | one["schema"]) for call in DESCRIBED for one in call.get("parameters", [])]
    assert [name for name, field in fields if "$ref" not in field and not field.get("description")] == []
    bare = [name for name, field in fields if holds_floats(field) and "[" not in field["description"]]
    assert set(bare) <= set(WITHOUT_UNIT.split())
    in_words = [(name, field) for name, field in fields if field.get("description", "").endswith("]")]
    assert len(in_words) > 200
    assert [name for name, field in in_words if not field["description"].endswith(f"[{field.get('x-unit')}]")] == []


def test_a_token_may_guard_the_calls_that_make_and_list_jobs_and_take_files():
    locks = {call["operationId"]: call["security"] for call in DESCRIBED if call["security"]}
    guarded = ("ask_later", "list_jobs", "sweep", "grade", "places")
    assert locks == {name: [{"token": []}, {}] for name in guarded}


def test_every_path_says_its_kind():
    schemas = DOCUMENT["components"]["schemas"]
    path, _ = schemas["CheckRequest"]["properties"]["path"]["anyOf"]
    kinds = path["discriminator"]["mapping"].values()
    assert all("kind" in schemas[kind.rpartition("/")[2]]["required"] for kind in kinds)


@pytest.mark.parametrize("call", ["trajectory", "turn", "maximum-head-speed"])
def test_null_counts_as_left_out_where_the_schema_cannot_state_the_default(ask, call):
    form = DOCUMENT["paths"][f"/{call}"]["post"]["requestBody"]["content"][JSON]["schema"]["$ref"].rpartition("/")[2]
    fields = DOCUMENT["components"]["schemas"][form]["properties"].items()
    nulls = {
        name: None for name, field in fields if {"type": "null"} in field.get("anyOf", []) and "default" not in field
    }
    assert "path" in nulls
    assert ask(call, nulls) == ask(call, {})


@pytest.mark.filterwarnings("error")
def test_the_most_benches_stated_are_the_most_taken():
    """No model warns either while it is described."""
    document = create_app(Settings(benches_max=321)).openapi()
    parameters = document["paths"]["/collision-time"]["get"]["parameters"]
    wires = document["components"]["schemas"].values()
    stated = [one["schema"] for one in parameters if one["name"] == "benches"]
    stated += [wire["properties"]["benches"] for wire in wires if "benches" in wire.get("properties", {})]
    assert {field["maximum"] for field in stated if "maximum" in field} == {stated[0]["maximum"]} == {321}


@pytest.mark.parametrize("call", EXAMPLES)
def test_the_example_of_every_call_is_true(ask, call):
    example, (method, path) = EXAMPLES[call], call.split()
    forms = DOCUMENT["paths"][path][method.lower()]["responses"]["200"]["content"]
    # Many clients ask for the form that stands first.
    got = ask.send(path[1:], example.body, next(iter(forms)), **example.query).raise_for_status()
    if got.headers["content-type"] == JSON:
        assert same(got.json(), forms[JSON]["example"]), got.text
    else:
        assert got.headers["content-type"] in forms
        assert example.answer is None


def test_the_examples_stand_as_make_examples_writes_them():
    assert text(json.loads(FILE.read_bytes())) + "\n" == FILE.read_text(encoding="utf-8")


def same(got, documented):
    """Equal but for rounding, and for what a search spent or how narrowly it proved."""
    if isinstance(documented, dict):
        names = documented.keys() - set(SPENT.split())
        return got.keys() == documented.keys() and all(same(got[name], documented[name]) for name in names)
    if isinstance(documented, list):
        return len(got) == len(documented) and all(map(same, got, documented))
    if isinstance(documented, float):
        return got == pytest.approx(documented, rel=EXAMPLE_TOLERANCE, abs=EXAMPLE_TOLERANCE)
    return got == documented


FILES = ("/contest-kit", "/figures", "/films", "/grade", "/healthz", "/maps", "/places", "/plan", "/readyz")


def test_every_call_has_an_example_and_its_problems():
    for path, methods in DOCUMENT["paths"].items():
        for method, call in () if path.startswith(FILES) else methods.items():
            # Answers about jobs are never the same.
            of_job = path.startswith(("/jobs", "/sweeps"))
            known = of_job or f"{method.upper()} {path}" in EXAMPLES
            assert known, f"app/service/examples.json needs a request of {method.upper()} {path}, then `make examples`"
            for status in ("422", "500", "503") if of_job else ("406", "422", "500", "503"):
                assert list(call["responses"][status]["content"]) == [PROBLEM_TYPE], (path, status)
