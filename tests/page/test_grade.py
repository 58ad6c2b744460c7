"""The page grades dropped workbooks and typed answers, in both languages, on a phone, and forgets them on request."""

from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from core import Dragon
from tests.support.students import SPIRAL_TIMES, by_xlsxwriter, contact_workbook, rows_of, spiral

# Instants of a workbook that is soon read; and a short dragon: this is not about its dance.
FEW = SPIRAL_TIMES[:21]
EASY = "?benches=5&time=end"
BOX = "#grades .answer"
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
    assert person.texts("#grades .class tbody td:first-child") == ["Red", "Gold"]


def test_a_class_is_graded_from_an_archive_sorted_saved_and_two_equal_files_are_pointed_out(open_page, files, tmp_path):
    archive = tmp_path / "class.zip"
    with ZipFile(archive, "w", ZIP_DEFLATED) as written:
        for team, file in (("红队", files[1]), ("Gold", files[1]), ("Blue", files[3])):
            written.write(file, f"{team}/results/{file.name}" if team == "Gold" else f"{team}/{file.name}")
        written.writestr("__MACOSX/Gold/._result2.xlsx", b"of a system")
        written.writestr("Blue/screenshot.png", b"\x89PNG\r\n\x1a\n" + bytes(99))
    person = open_page(EASY, failing=True).reaches_below()
    person.takes(archive, "#files").sees({"#grades .class h3": "Class: 4 files", "#grades .class tbody tr": 4})
    person.sees({"#grades .class .hint": "红队/result2.xlsx, Gold/result2.xlsx"})
    teams = "#grades .class tbody td:first-child"
    assert person.texts(teams) == ["红队", "Gold", "Blue", "Blue"]
    person.presses("#grades .class th:first-child button").has("#grades .class th:first-child", aria_sort="ascending")
    assert person.texts(teams)[:3] == ["Blue", "Blue", "Gold"]
    person.presses("#grades tr:has-text('screenshot.png') td button").sees(
        {f"{BOX}": "is a picture, such as a screenshot"}
    )
    assert person.findings("#grades") == []
    rubric = person.saves("#grades .class .buttons button >> nth=2", "rubric.csv").decode("utf-8-sig")
    (tmp_path / "mine.csv").write_text(rubric.replace("result2,20", "result2,55"), encoding="utf-8")
    person.takes(tmp_path / "mine.csv", "#grades .class input[type=file]").sees(
        {"#grades tr:has-text('Gold') .number >> nth=2": "55"}
    )
    (tmp_path / "typo.csv").write_text("rounded,o.5\n")
    person.takes(tmp_path / "typo.csv", "#grades .class input[type=file]").sees({"#status": "o.5"})
    assert b"Gold" in person.saves("#grades .class .buttons button >> nth=1", "class.csv")
    person.speaks("zh").sees({"#grades .class h3": "班级：4 个文件", "#grades .class th >> nth=0": "队伍"})
