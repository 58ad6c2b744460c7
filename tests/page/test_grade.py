"""The page grades dropped workbooks and typed answers, in both languages, on a phone, and forgets them on request."""

import pytest

from core import Dragon
from tests.support.students import SPIRAL_TIMES, by_xlsxwriter, contact_workbook, rows_of, spiral

# Instants of a workbook that is soon read; and a short dragon: this is not about its dance.
FEW, EASY = SPIRAL_TIMES[:21], "?benches=5&time=end"
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
