"""The page grades dropped workbooks and typed answers, in both languages, on a phone, and forgets them on request."""

from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from core import Dragon
from tests.support.students import SPIRAL_TIMES, by_xlsxwriter, contact_workbook, rows_of, spiral

# Instants of a workbook that is soon read; and a short dragon: this is not about its dance.
FEW = SPIRAL_TIMES[:21]
EASY = "?benches=5&time=end"
BOX = "#grades .answer"
TEAMS, RUBRIC = "#grades .class tbody th", "#grades .class input[type=file]"
DROP = """data => {
  const files = new DataTransfer();
  files.items.add(new File([new Uint8Array(data)], "result2.xlsx"));
  const event = new DragEvent("drop", { dataTransfer: files, bubbles: true, cancelable: true });
  document.querySelector("#drop").dispatchEvent(event);
  return event.defaultPrevented;
}"""


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("student")
    position, speed = spiral(FEW, Dragon(overhang=0.0))
    position[0] = spiral(FEW)[0][0]  # right at first, as the picture shows
    contents = {
        "result1.xlsx": by_xlsxwriter(rows_of((position, speed), FEW)),
        "result2.xlsx": contact_workbook(),
        "result4.xlsx": b"PK, but no workbook",
        "result1.csv": b"",
    }
    for name, data in contents.items():
        (folder / name).write_bytes(data)
    return [folder / name for name in contents]


def test_chosen_files_typed_answers_and_a_dropped_file_are_graded_each_for_itself_and_cleared(open_page, files):
    person = open_page(EASY).reaches_below()
    person.takes(files, "#files")
    person.sees({BOX: 4, "#grades [role=status]": 0}).sees(
        {
            f"{BOX} >> nth=0 >> .value": "✕wrong",
            f"{BOX} .finding": "The length of a bench was used as the distance between its handles",
            f"{BOX} >> nth=0 >> canvas.marks": 1,
            f"{BOX} >> nth=1 >> .value": "✓right",
            f"{BOX} >> nth=2 >> .value": "✕unreadable",
            f"{BOX} >> nth=3": "The file is empty.",
        }
    )
    assert person.findings("#grade") == []
    person.speaks("zh").sees({f"{BOX} .finding": "把板长当作把手间距", f"{BOX} >> nth=1 >> .value": "✓正确"})
    person.page.set_viewport_size({"width": 390, "height": 844})
    assert not person.settles().overflows(390)
    person.speaks("en").presses("#grade-clear").sees({BOX: 0})
    types_and_drops(open_page(EASY, failing=True).reaches_below(), files)


def types_and_drops(person, files):
    for pitch, results in (
        ("0,4202", {f"{BOX} >> nth=0": "Possibly: Only the pose", f"{BOX} >> nth=1": "✓right"}),
        ("0.4503", {f"{BOX} >> nth=0 >> .value": "✕infeasible, breaks the limit: benches 0 and 19 touch"}),
        ("0.45x", {"#grades .error": "got '0.45x'", "#grades .value": "✓right"}),
    ):
        person.at("#typed-speed").fill("1.246266")
        person.types({"#typed-pitch": pitch}).sees(results).presses("#grade-clear").sees({BOX: 0})
    assert person.ask(DROP, list(files[1].read_bytes()))
    person.reads({"#grades .value": "✓right"}).presses("#grade-clear")
    person.page.route("**/grade?*", lambda route: None)  # no answer comes
    person.takes(files[:2], "#files").sees({"#grades [role=status]": "result1.xlsx (1 of 2)"})


def row_of(team):
    return f"#grades tr:has(th:text-is('{team}'))"


# A folder as a browser hands it over when it is dropped, with a folder for each team, in two readings.
DROP_FOLDER = """data => {
  const file = (name) => new File([new Uint8Array(data)], name);
  const entry = (path, inside) => ({ fullPath: path, isDirectory: !!inside,
    file: (take) => take(file(path.split("/").at(-1))),
    createReader: () => ({ readEntries: (take) => take(inside.splice(0, 1)) }) });
  const teams = ["Red", "Gold"].map((team) => entry(`/class/${team}`, [entry(`/class/${team}/result2.xlsx`)]));
  const event = new DragEvent("drop", { bubbles: true, cancelable: true });
  const items = [{ webkitGetAsEntry: () => entry("/class", teams) }];
  Object.defineProperty(event, "dataTransfer", { value: { items, files: [file("class")], types: ["Files"] } });
  document.querySelector("#drop").dispatchEvent(event);
}"""


def test_a_dropped_folder_is_a_class(open_page, files):
    person = open_page(EASY).reaches_below()
    person.ask(DROP_FOLDER, list(files[1].read_bytes()))
    person.sees({"#grades .class tbody tr": 2, "#grades .class .hint": "Red/result2.xlsx, Gold/result2.xlsx"})
    assert person.texts(TEAMS) == ["Gold", "Red"]


# The next file is read once it may be.
SLOW = """() => {
  const { arrayBuffer } = Blob.prototype;
  const ready = new Promise((resolve) => (globalThis.read = resolve));
  Blob.prototype.arrayBuffer = function () {
    Blob.prototype.arrayBuffer = arrayBuffer;
    return ready.then(() => this.arrayBuffer());
  };
}"""


def test_a_class_is_graded_from_an_archive_sorted_saved_and_two_equal_files_are_pointed_out(open_page, files, tmp_path):
    inner, archive = tmp_path / "ours.zip", tmp_path / "class.zip"
    with ZipFile(inner, "w", ZIP_DEFLATED) as written:
        written.write(files[0], "result1.xlsx")
    with ZipFile(archive, "w", ZIP_DEFLATED) as written:
        for team, file in (("红队", files[1]), ("Gold", files[1]), ("Blue", files[3])):
            written.write(file, f"{team}/results/{file.name}" if team == "Gold" else f"{team}/{file.name}")
        written.writestr("__MACOSX/Gold/._result2.xlsx", b"of a system")
        written.writestr("Blue/screenshot.png", b"\x89PNG\r\n\x1a\n" + bytes(99))
        written.write(inner, "Green/ours.zip")
        written.writestr("Grey/", b"")
        written.writestr("Pink/ours.rar", b"Rar!")
    person = open_page(f"{EASY}&door=contest", failing=True).presses("#to-grade").reaches_below()
    person.ask(SLOW)
    person.takes(archive, "#files").sees({"#grades [role=status]": "Unpacking the files"}).presses("#grade-clear")
    person.sees({"#grades [role=status]": 0}).ask("() => read()")
    person.sees({TEAMS: 0, "#grades [role=status]": 0})  # what was cleared does not come back
    person.takes(archive, "#files").sees({"#grades .class h3": "Class: 6 teams, 7 files", TEAMS: 6})
    person.sees({"#grades .class .hint >> nth=0": "红队/result2.xlsx, Gold/result2.xlsx"})
    assert person.texts(TEAMS)[:5] == ["Blue", "Gold", "Green", "Grey", "Pink"]
    person.sees(
        {
            f"{row_of('Green')} td >> nth=1": "length for chord",
            f"{row_of('Grey')}": "The folder is empty",
            f"{row_of('Pink')}": "workbook or a table (.xlsx or .csv): ours.rar",
            f"{row_of('Gold')} td >> nth=0": "20 of 100",
        }
    )
    points = "#grades .class th:nth-child(2)"
    person.presses(f"{points} button").presses(f"{points} button").has(points, aria_sort="descending")
    assert set(person.texts(TEAMS)[:2]) == {"红队", "Gold"}
    person.presses(f"{row_of('Blue')} button:has-text('screenshot.png')").sees({f"{BOX}": "is a picture, such as a"})
    assert person.findings("#grades") == []
    person.chooses({"#typed-team": "Gold"}).types({"#typed-pitch": "0.4504"}).sees(
        {f"{row_of('Gold')} td >> nth=0": "29 of 110", "#typed-collision_time": False}
    )
    person.types({"#typed-speed": "2"}).sees({f"{row_of('Gold')} td >> nth=0": "29 of 120"})  # no rounding gives it
    rubric = person.saves("#grades .class .buttons button >> nth=2", "rubric.csv").decode("utf-8-sig")
    (tmp_path / "mine.csv").write_text(rubric.replace("result2,20", "result2,55"), encoding="utf-8")
    person.takes(tmp_path / "mine.csv", RUBRIC).sees(
        {f"{row_of('Gold')} td >> nth=0": "64 of 155", "#grades .class .hint >> nth=1": "The rubric is mine.csv."}
    )
    (tmp_path / "typo.csv").write_text("rounded,o.5\n")
    person.takes(tmp_path / "typo.csv", RUBRIC).sees({"#status": "o.5"}).has(points, aria_sort="descending")
    # While the class is graded in another language, what is saved has the one of its table.
    held = person.holds_back("**/grade?*")
    person.at("[data-lang=zh]:visible").click()
    person.sees({"#grades [role=status]": "9"})
    person.presses(f"{row_of('Blue')} button:has-text('screenshot.png')")  # nothing is said of it yet
    saved = person.saves("#grades .class .buttons button >> nth=1", "class.csv").decode()
    assert "what was found" in saved
    assert "班级" not in saved
    assert "发现" not in saved
    held.let_go()
    person.sees({"#grades .class h3": "班级：6 个队，9 个文件", TEAMS: 6})
    assert "发现" in person.saves("#grades .class .buttons button >> nth=1", "class.csv").decode()
