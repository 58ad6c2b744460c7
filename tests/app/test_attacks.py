"""Each attack, and the answers to another client during it."""

import pytest

from app.files.tables import ARROW_TYPE
from tests.support.attacks import ATTACKS, PATIENCE, memory, tables, watching
from tests.support.depth import examples
from tests.support.serving import serving

# Duration of an attack, and longest wait of another client, which is 0.1 s on an idle machine [s]. What keeps others
# waiting does so until it is done, also after its clients have gone.
SECONDS = examples(1, 4) / 2
SLOWEST = 1.0
# Tries: waits that the service causes occur each time, those that other programs cause do not.
TIMES = 3
# One of each kind: much to compute, to parse, to write, to read, and bodies and heads that come slowly.
FEW = (
    "largest_inputs messages long_thin_dragon full_store long_jobs strange_hosts "
    "deep_brackets large_csv files_to_grade tiny_chunks half_open"
)


@pytest.fixture(scope="module")
def attacked(tmp_path_factory):
    """A service of its own: what an attack leaves running ends with it."""
    with serving(tmp_path_factory.mktemp("attacked") / "server.log", grace_seconds=1) as service:
        yield service


def slowest(service, name):
    """The longest that another client waits for the service during an attack [s]; it is always answered."""
    with watching(service.url, pid=service.process.pid) as watch:
        ATTACKS[name](service.url, SECONDS)
    assert watch.failures == []
    return max(watch.slowest.values())


@pytest.mark.parametrize(
    "name",
    ["deep_brackets", "half_open", "long_jobs", "long_names", "long_thin_dragon", "names_twice", "strange_hosts"],
)
def test_another_client_is_answered_meanwhile(attacked, name):
    assert slowest(attacked, name) < PATIENCE


@pytest.mark.thorough
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name in FEW.split() else [pytest.mark.deep]) for name in sorted(ATTACKS)]
)
def test_another_client_never_waits_for_long(attacked, name):
    waits = []
    while len(waits) < TIMES and min(waits, default=SLOWEST) >= SLOWEST:
        waits.append(slowest(attacked, name))
    assert min(waits) < SLOWEST, waits


# Memory that tables of 24 MB, eight at once and three times, may leave behind after the first time [MB]; 100 to 360 if
# freed memory is kept. As Arrow they take a tenth of the time that they take as CSV.
LEFT_BEHIND = 60.0


@pytest.mark.thorough
def test_large_tables_leave_no_memory_behind(tmp_path):
    with serving(tmp_path / "server.log") as service:
        left = []
        for _ in range(3):
            tables(service.url, 8, ARROW_TYPE)
            left.append(memory(service.process.pid))
    assert left[-1] - left[0] < LEFT_BEHIND, left
