"""What a person has made survives: in the address, in a saved file, in a map, and after a reload."""

from urllib.parse import urlencode

import pytest

from tests.support.node import evaluate

NUMBERS = {"benches": "9", "head_length": "3.3", "body_length": "2.1", "width": "0.25", "overhang": "0.2"}
PACE = {"head_speed": "0.8", "margin": "0.01", "stray": "0.02", "hole": "0.03", "pin": "0.02"}
PLACE = {
    "things": "a.square..-40,-30_40,-30_40,30_-40,30~b.house..20,20_28,20_28,28_20,28.22,22_22,26_26,26_26,22"
    "~c.linden.0!4.30,-20~w.fence.0!2.-30,20_-20,20~g.East.3!1.38,0~g.West..-38,0",
    "yard": "-38,-28_38,-28_38,28_-38,28",
    "grid": "500000,4000000",
}
ON_EARTH = {"origin": "119.6,29.5"}
DRAWN = {"path": "route", "route": "*-30,-10_*0,-10_*10,-20_30,-20", "corner": "3", "begin": "22"}
WALKED = {"path": "route", "walk": "-30,-10,0_40_8,1.5_15", "begin": "21"}
COIL = '{"pitch":1.2,"start_turns":8,"kind":"spiral","centre":[0,0],"rotation":0,"clockwise":true}'
TABLE = "name,length,width,overhang\nLi,3,0.3,0.2\nWu,2.2,0.3,0.25\nHe,2.1,0.25,0.25"
DANCES = (
    "name:Chen!colour:#123456!delay:4~passages:0.5@20s!path:turn!pitch:1.8!start_turns:12!turning_diameter:10!ratio:1.5"
    "!entry_radius:4.9!exit_radius:4.8!benches:7!head_length:3.4!body_length:2!width:0.2!overhang:0.2!head_speed:0.7"
    f"~rotation:30!csv:{TABLE}!passages:0.96@10d!beats:4,96,0.6!path:spiral!pitch:1.1!start_turns:9!head_speed:1"
)
ON_PATH = {"route", "corner", "walk", "begin", "start", *ON_EARTH}
# Of each project, what a map holds too, all else that a file holds, and the button that saves it.
PROJECTS = {
    "drawn": (
        DRAWN | PLACE,
        NUMBERS
        | PACE
        | {"start": "0", "limit": "1.7", "passages": "0.5@15m_0@5d", "start_clock": "19:30", "ends": "20"},
        "#save",
    ),
    "walked": (
        WALKED | PLACE | ON_EARTH,
        PACE | {"csv": TABLE, "beats": "4,96,0.6", "begin_clock": "08:00:30", "start": "0", "limit": "1.4"},
        "#save",
    ),
    "other": ({"path": "route", "raw": COIL}, NUMBERS, "#save"),
    "several": (
        DRAWN | PLACE,
        NUMBERS | PACE | {"limit": "2", "dances": DANCES, "begin_clock": "20:00", "ends": "20:20", "laps": "2"},
        "#dragons-save",
    ),
}
# How the page is looked at, which no file holds.
VIEW = {"time": "2", "rate": "5", "follow": "true", "handle": "3", "view": "1,2,9", "lang": "zh", "door": "all"}
# Who is followed or chosen, the drawing as a whole, and a photo; then numbers that a dance on a drawn path has not.
ELSEWHERE = {"bench", "dragon", "drawing", "photo", "speed_limit"}
OF_SEVERAL = {"pitch", "start_turns", "turning_diameter", "ratio", "entry_radius", "exit_radius"}
NAMES = """async () => {
  const [{ DEFAULTS }, { PARTS }] = [await page("state.js"), await page("drawing.js")];
  return [...Object.keys(DEFAULTS), ...PARTS];
}"""


def query(address):
    return f"?{urlencode(address)}"


def reopened(person, name, file, folder):
    """The address after a file was opened, without how it is looked at."""
    path = folder / name
    path.write_bytes(file)
    before = person.address()
    person.takes(str(path)).presses("#instead").sees({"#status": name})
    opened = person.settles().address()
    # One step back leads to what was there, also after a reload.
    person.page.reload()
    assert person.settles().presses("#undo").settles().address() == before
    assert person.presses("#redo").settles().address() == opened
    return {one: text for one, text in opened.items() if one not in VIEW}


@pytest.mark.node
def test_every_part_of_the_state_is_tried_here():
    tried = set(VIEW).union(*(held | more for held, more, _ in PROJECTS.values()))
    assert set(evaluate(NAMES)) == tried | ELSEWHERE | OF_SEVERAL
    assert all(f"!{name}:" in DANCES for name in OF_SEVERAL)


def test_reloads_languages_saved_files_maps_and_undo_keep_every_part_of_the_state(open_page, tmp_path):
    for case, (held, more, save) in PROJECTS.items():
        person = open_page(query(held | more | VIEW))
        assert person.address() == held | more | VIEW
        person.page.reload()
        assert person.settles().address() == held | more | VIEW
        assert person.speaks("en").speaks("zh").address() == held | more | VIEW
        file = person.saves(save)
        form = {"drawn": "DXF", "walked": "KML"}.get(case, "GeoJSON")
        map_file = person.reaches().saves(f"#keepMap-{form}")
        # It is said where the same format may hold degrees too.
        assert ("米" in person.text("#status")) is (form == "GeoJSON")
        # Another dance, of which nothing stays.
        held_before, more_before, _ = PROJECTS["walked" if case == "drawn" else "drawn"]
        before = held_before | more_before
        assert reopened(person.opens(query(before)), "dance.json", file, tmp_path) == held | more
        # What a map has not stays as it was; when a dance starts on its path belongs to the path.
        kept = {name: text for name, text in before.items() if name not in ON_PATH}
        assert reopened(person.opens(query(before)), f"map.{form.lower()}", map_file, tmp_path) == kept | held
    _a_square_without_a_path_is_kept_too(person, tmp_path)


def _a_square_without_a_path_is_kept_too(person, folder):
    """Also half of a path, and a gate that has lost its square."""
    for held in (PLACE, {"things": "c.linden.0!4.30,-20~g.East.3!1.38,0"}, {"things": "g.West..-38,0", "route": "3,4"}):
        unfinished = {"path": "route", "limit": "1.7"} | NUMBERS | held
        file = person.opens(query(unfinished)).saves("#save")
        assert reopened(person.opens(query(DRAWN | PACE)), "dance.json", file, folder) == unfinished
    person.opens("?path=route").sees({"#save:disabled": True})
