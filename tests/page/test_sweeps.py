"""Sweeps on the page: the form starts a job of the real service, the list follows it, the map shows its table."""

import subprocess

import pytest

from tests.support import polite
from tests.support.job_service import PATIENCE, SHORT, JobService
from tests.support.serving import PATIENT

thorough = pytest.mark.thorough
PHONE = {"width": 390, "height": 844}
TOKEN = "correct horse"
LOCKED = "Jobs and uploads need the token of this service"
# The middle of the map: its margins are 64 px on the left, 16 on the right, 12 above and 44 below.
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 12, 44
DONE = "#jobs li[data-state=successful]"
MAP = "#map canvas"
READING = "#map .reading"
SHADES = """canvas => {
  const { data, width } = canvas.getContext("2d").getImageData(70, 20, canvas.width - 100, canvas.height - 80);
  return new Set(Array.from({ length: data.length / 4 }, (_, k) => data.slice(4 * k, 4 * k + 4).join(" "))).size;
}"""
OUTSIDE = """(width) => [...document.querySelectorAll("#sweeps *")]
  .filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > width + 1)
  .map((one) => one.outerHTML)"""
SHEET = {"name": "result1.csv", "mimeType": "text/csv", "buffer": b"1,2"}


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    with JobService(tmp_path_factory.mktemp("page"), sweep_processes=1, deadline_seconds=PATIENT) as service:
        yield service


def base(service):
    return f"http://127.0.0.1:{service.port}"


def begins(person, question, *axes):
    """Fill the form and start the sweep."""
    person.reaches_below().chooses({"#sweep-question": question})
    person.chooses({f"#sweep-name-{k}": axes[k][0] if k < len(axes) else "" for k in range(2)})
    for k, (_, *numbers) in enumerate(axes):
        for key, number in zip(("sweepFrom", "sweepTo", "sweepCount"), numbers, strict=True):
            person.at(f"#sweep-{key}-{k}").fill(str(number))
    return person.presses("#sweep button")


def middle(person):
    box = person.box(MAP)
    return {"x": (box["width"] + LEFT - RIGHT) / 2, "y": (box["height"] + TOP - BOTTOM) / 2}


def test_a_sweep_of_two_parameters_becomes_a_map_whose_designs_open(open_page, service):
    person = open_page("?benches=40&margin=0.05", base=base(service))
    begins(person, "collision_time", ("pitch", 0.5, 0.6, 5), ("width", 0.2, 0.3, 3))
    person.sees({f"{DONE}:has-text('First contact over Pitch and Width')": True})
    for form, begin in (("CSV", b"design"), ("Parquet", b"PAR1"), ("Arrow", b"ARROW1")):
        assert person.saves(f"#map-save [data-save={form}]").lstrip(b'"').startswith(begin)
    person.at(MAP).hover(position=middle(person))
    query = {"pitch": 0.55, "width": 0.25, "benches": 40, "margin": 0.05, "cross_check": "none"}
    answer = polite.answer(base(service), "collision-time", **query)
    person.reads({READING: f"Pitch [m] 0.55, Width [m] 0.25: first contact [s] {answer['time']:.6g}"})
    assert person.at(MAP).evaluate(SHADES) > 10
    person.chooses({"#map-value": "head.radius"}).at(MAP).hover(position=middle(person))
    person.sees({READING: f"head · radius [m] {answer['head']['radius']:.6g}"}).at(MAP).click(position=middle(person))
    person.holds({"#pitch": "0.55", "#width": "0.25"}).sees({"#first-contact .value": f"{answer['time']:.6f}"})
    # A new map has nothing of the one before.
    begins(person, "collision_time", ("pitch", 0.5, 0.52, 2)).sees({f"{READING}:empty": 1})


@thorough
@pytest.mark.curl
def test_the_list_outlives_the_page_its_jobs_are_removed_and_commands_save_the_table(open_page, service, tmp_path):
    person = open_page("?benches=12", base=base(service), timezone_id="UTC")
    begins(person, "shortest_turn", ("pitch", 1.6, 1.8, 90))
    running = "#jobs li[data-state=running]"
    gone = "#jobs li[data-state=dismissed]"
    person.sees({running: "of 90 designs", f"{running} progress": True}).page.reload()
    person.reaches_below().sees({running: "Shortest turn over Pitch"})
    address = person.at(f"{running} button").get_attribute("id").replace("jobCancel-", "/jobs/")
    assert service.status(address)["total"] == 90
    person.at(f"{running} button").press("Enter")
    person.sees({gone: "cancelled"}).at(f"{gone} button").press("Enter")
    person.sees({"#no-jobs": True})
    assert service.client.get(address).status_code == 404
    begins(person, "collision_time", ("pitch", 0.5, 0.52, 3), ("width", 0.2, 0.3, 2)).sees({DONE: True})
    commands = person.presses("#sweep summary").sees({"#sweep code": "-o sweep.csv"}).text("#sweep code")
    subprocess.run(["sh", "-ec", commands], check=True, cwd=tmp_path, capture_output=True, timeout=PATIENCE)
    table = person.saves("#map-save [data-save=CSV]")
    assert (tmp_path / "sweep.csv").read_bytes() == table
    assert table.count(b"\n") == 7
    _a_map_of_one_parameter_is_read_by_keyboard_and_danced(person.speaks("zh").types({"#benches": "30"}), service)


def _a_map_of_one_parameter_is_read_by_keyboard_and_danced(person, service):
    # A switch of the question keeps the axes that it can.
    person.chooses({"#sweep-question": "collision_time", "#sweep-name-0": "pitch", "#sweep-name-1": "width"})
    person.types({"#sweep-sweepFrom-0": "0.51", "#sweep-sweepTo-1": "0.33"}, "Tab")
    person.chooses({"#sweep-question": "minimum_pitch"})  # which has no pitch
    assert person.at("#sweep-name-0").input_value() not in ("pitch", "width")
    person.chooses({"#sweep-question": "least_clearance"}).holds({"#sweep-name-0": "pitch", "#sweep-name-1": "width"})
    person.holds({"#sweep-sweepFrom-0": "0.51", "#sweep-sweepTo-1": "0.33"})
    begins(person, "minimum_pitch", ("turning_diameter", 8, 10, 3))
    # The map of the sweep before stays until that of the new one has come.
    person.sees({f"{DONE}:has-text('最小螺距，变化：调头空间直径')": True, "#map-value": "最小螺距"}).at(MAP).focus()
    query = {"turning_diameter": 10, "benches": 30, "cross_check": "none"}
    pitch = polite.answer(base(service), "minimum-pitch", **query)["pitch"]
    person.strikes(*["ArrowRight"] * 3).reads({READING: f"调头空间直径 [m] 10：最小螺距 [m] {pitch:.6g}"})
    person.strikes("Enter").holds({"#pitch": str(pitch), "#turning_diameter": "10"})


@thorough
def test_who_has_the_token_sees_all_jobs_and_everyone_can_use_it(open_page, tmp_path):
    limits = {"token": TOKEN, "sweep_processes": 1, "sweep_designs_max": 100, "deadline_seconds": PATIENT}
    with JobService(tmp_path, **limits) as guarded:
        address = guarded.post(SHORT)
        person = open_page("?benches=12", base=base(guarded), failing=True, viewport=PHONE, is_mobile=True)
        begins(person, "least_clearance", ("pitch", 0.7, 0.9, 2), ("benches", 8, 10, 2))
        person.sees({"#sweep-error": LOCKED, "#no-jobs": True}).takes(SHEET, "#files")
        person.sees({"#grades .error": LOCKED}).presses("#sweeps details:has(#token) summary")
        person.types({"#token": TOKEN}).takes(SHEET, "#files")
        person.sees({"#grades .answer .value": "unreadable"}).presses("#sweep button").sees(
            {
                "#jobs li:has-text('First contact with its certificate')": True,
                f"{DONE}:has-text('Least clearance over Pitch and Benches')": True,
                "#map": True,
            }
        )
        guarded.client.delete(address)
        assert person.speaks("zh").findings("#sweeps") == []
        person.page.emulate_media(color_scheme="dark")
        assert person.findings("#sweeps", in_colours=True) == []
        # A job's name and state stand beside its buttons, never below them.
        name, state, buttons = (person.box(f"#jobs li {part}") for part in (".title", ".state", ".buttons"))
        assert max(name["x"] + name["width"], state["x"] + state["width"]) <= buttons["x"]
        assert person.ask(OUTSIDE, PHONE["width"]) == []
        begins(person, "collision_time", ("pitch", 0.5, 0.6, 11), ("width", 0.2, 0.3, 11))
        person.sees({"#sweep-error": "121"})
        begins(person, "collision_time", ("pitch", 0.5, 0.6, 11), ("pitch", 0.2, 0.3, 11))
        person.sees({"#sweep-error": True})
