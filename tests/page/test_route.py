"""A dance drawn on the picture by mouse, touch and keys: its verdict, its address and its files."""

import json
import math
import re
from io import BytesIO

import openpyxl
import pytest
from PIL import Image
from playwright.sync_api import expect

from tests.conftest import ROOT
from tests.support import paper, polite
from tests.support.floor_plan import EDGES, WALLS, floor_plan, town
from tests.support.person import COVERED, PHONE, TABLET, alike

thorough = pytest.mark.thorough
S_CURVE = "?path=route&route=*-80,-16_0,-16_16,-8_0,0_-16,8_*0,16_80,16"
VILLAGE = (
    "?path=route&route=*-67,-8_-12,-8_-3,-9_6,-8_10.5,-3_7,2.5_0,3.5_-4.5,7_-1,10.5_6,10.5_*12,15_12,62&begin=45&limit=1.1"
    "&things=a.square..-70,-11_-20,-11_-20,-15_20,-15_20,15_15,15_15,65_9,65_9,15_-20,15_-20,-5_-70,-5"
    "~c.well.1!5.6!5,-6!5~b.stage..-17,1!5_-6,1!5_-6,9!5_-17,9!5~w.fence.0!2.10!5,3!5_18,4"
)
VERDICT = "#judgement .value"
LONG_PRESS = 700.0  # surely one [ms]
YES = {VERDICT: "Can be danced"}
NO = {VERDICT: "Cannot be danced"}
LABEL = "document.activeElement.getAttribute('aria-label')"
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([text], name));
  for (const type of ["dragenter", "dragover", "drop"])
    stage.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""


def points(person):
    """The points of the path as the page shares them, once it has written its address and drawn the path."""
    person.settles("course")
    text = person.address().get("route", "")
    return [[float(one) for one in point.lstrip("*").split(",")] for point in text.split("_") if point]


def file_of(person):
    return json.loads(person.saves("#save"))


def knot(k):
    return f".knot >> nth={k}"


def test_points_are_dragged_moved_by_keys_put_in_and_taken_away_and_every_step_is_taken_back(open_page):
    person = open_page(failing=True).presses("[data-path=route]").sees({**YES, ".knot": 7})
    before = points(person)
    bend = person.box(knot(2))
    corner = person.box(knot(3))
    person.drags(knot(2), corner["x"] - bend["x"] - 16, corner["y"] - bend["y"] - 10)
    person.sees({**NO, ".failures li:has-text('The bend is too tight')": True})
    after = points(person)
    assert after[:2] + after[3:] == before[:2] + before[3:]
    assert points(person.strikes("ControlOrMeta+z").sees(YES)) == before
    person.presses("#redo").sees(NO).page.go_back()
    assert points(person.sees(YES)) == before
    _keys_and_taps_change_points(person.opens(S_CURVE).sees(YES).presses("#edit"))


def _keys_and_taps_change_points(person):
    before = points(person)
    person.focuses("#delete")
    assert "Point 2 of 7" in person.strikes("Tab", "Tab", "Tab").ask(LABEL)  # after the picture and the first point
    after = points(person.strikes("ArrowRight", "ArrowRight", "Shift+ArrowUp"))
    assert after[1] == pytest.approx([before[1][0] + 0.2, before[1][1] + 0.01])
    assert "Point 3 of 8" in person.strikes("Enter").ask(LABEL)
    assert len(points(person.strikes("Delete"))) == 7
    # A tap on the path divides it, and one beside it goes on from its end; the list has fields for both.
    first = person.box(knot(0))
    second = person.box(knot(1))
    person.page.mouse.click((first["x"] + second["x"]) / 2 + 11, (first["y"] + second["y"]) / 2 + 11)
    drawn = points(person.sees({".knot": 8}))
    assert drawn[0][0] < drawn[1][0] < drawn[2][0]
    last = person.box(knot(7))
    person.page.mouse.click(last["x"] + 11, last["y"] - 60)
    person.sees({".knot": 9}).presses("#points summary")
    assert points(person.types({"#points tbody tr >> nth=8 >> input": "75.5"}))[8][0] == 75.5


def test_a_square_with_a_tree_and_a_wall_is_drawn_named_judged_and_changed_by_the_mouse(open_page):
    person = open_page(S_CURVE).sees(YES).presses("#zoom-out", "#edit").settles()
    canvas = person.box("#canvas")
    left, top, right, low = (canvas["x"] + 120, canvas["y"] + 60, canvas["x"] + canvas["width"] - 30, canvas["y"] + 480)
    for tool, places in (
        ("area", [(left, low), (right, low), (right, top), (left, top)]),
        ("circle", [(left + 20, top + 20)]),
        ("wall", [(right - 20, low - 20), (right - 60, low - 20)]),
        ("lane", [(left, top + 60), (right, top + 60)]),
    ):
        person.presses(f"[data-tool={tool}]")
        for x, y in places:
            person.page.mouse.click(x, y)
    names = [name.input_value() for name in person.all("#things li > input:first-of-type").all()]
    assert names == ["square", "tree", "wall", "emergency lane"]
    person.types({"#things li >> nth=1 >> input": "old oak"}).sees({**YES, "#tolerance[aria-busy=false] .value": True})
    kept = file_of(person)["venue"]["features"]
    shapes = [(one["properties"]["name"], one["geometry"]["type"]) for one in kept]
    lane = ("emergency lane", "LineString")
    assert shapes == [("square", "Polygon"), ("old oak", "Point"), ("wall", "LineString"), lane]
    (sheet,) = paper.sheets_of(person.saves("#to-safety"))
    assert "emergency lane, 3.5 m wide: " in sheet
    # A file and an address keep it, and no bench can touch it.
    assert person.opens(f"?{person.page.url.partition('?')[2]}").sees(YES).counts("#things li") == 4
    _a_press_on_a_tree_moves_it_and_a_tap_on_an_edge_adds_a_corner_there(person.opens(S_CURVE).sees(YES))


def _a_press_on_a_tree_moves_it_and_a_tap_on_an_edge_adds_a_corner_there(person):
    person.presses("#zoom-out", "#edit", "[data-tool=circle]").settles()
    canvas = person.box("#canvas")
    mouse = person.page.mouse
    x = canvas["x"] + 200
    y = canvas["y"] + 120

    def drawn():
        return [one["geometry"]["coordinates"] for one in file_of(person.settles())["venue"]["features"]]

    mouse.click(x, y)
    # The tool begins a new tree, as long as it meets none.
    before = drawn()
    person.presses("[data-tool=circle]").sees({".knot": 0}).drags_from(x, y, 60, 40).sees({".knot": 1})
    assert len(before) == len(drawn())
    assert before[-1][0] < drawn()[-1][0]
    person.presses("[data-tool=area]")
    left, right, top, low = x - 60, x + 360, y - 40, y + 280
    for place in ((left, low), (right, low), (right, top), (left, top), (0.5 * (left + right), low + 4)):
        mouse.click(*place)
    ring = drawn()[0][0]
    assert len(ring) == 6
    assert ring[0][0] < ring[1][0] < ring[2][0]


def test_a_touch_takes_a_thing_whatever_the_tool_and_its_numbers_stand_beside_it(open_page):
    person = open_page(f"{S_CURVE}&things=b.stage..-5,20_5,20_5,26_-5,26&view=0,20,10").sees(YES).settles()
    before = points(person)

    def middle():
        return person.spot("#canvas", down=-30)

    def stage():
        return [
            feature["geometry"]["coordinates"][0][0] for feature in file_of(person.settles())["venue"]["features"][1:]
        ]

    person.sees({"#beside": False}).page.mouse.click(*middle())
    person.sees({"#beside": True, ".knot": 4}).settles().drags_from(*middle(), 60, -40)
    assert stage() == [[1, 24]]
    person.strikes("ControlOrMeta+d").sees({"#things li": 2}).types({"#beside input >> nth=0": "bandstand"})
    person.drags(".grip.turn", 200, 0)
    assert stage()[0] == [1, 24] != stage()[1]
    person.strikes("Escape").sees({"#beside": False})
    for _ in range(4):
        person.presses("#undo")
    assert stage() == [[-5, 20]]
    assert points(person) == before


def test_an_l_is_drawn_by_its_size_and_a_tap_puts_a_fountain_of_a_usual_size_there(open_page):
    person = open_page("?door=village&path=route&benches=9", **PHONE).chooses({"#place-shape": "l"})
    size = {"#place-width": "42", "#place-height": "28", "#notch-width": "42", "#notch-height": "10"}
    person.types(size, "Tab").sees({"#place-wrong": "less than 42 m; you typed “42”"})
    person.types({"#notch-width": "14"}, "Tab").sees({"#place-wrong": False}).settles()
    assert person.address()["things"] == "a.square..-21,-14_21,-14_21,4_7,4_7,14_-21,14"
    assert person.presses("[data-add=kits]").sees({"#kits": ["fountain 3 m across", "stage 8 × 5 m"]}).findings() == []
    person.presses("#kits button:has-text('fountain')").settles().at("#canvas").tap()
    person.sees({"#beside": True}).holds({"#beside input >> nth=0": "fountain", "#beside input >> nth=1": "1.5"})
    assert person.ask(COVERED) == []
    person.presses("#tools [data-tool=kits]", "#kits button:has-text('wall')").has(
        "[data-tool=wall]", aria_pressed="true"
    )


@thorough
@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_shape_of_a_square_and_every_ready_made_thing_comes_by_a_tap_and_can_be_changed(open_page, language):
    person = open_page(f"?door=village&path=route&benches=9&lang={language}", **PHONE)
    for shape in [one.get_attribute("value") for one in person.all("#place-shape option").all()]:
        person.chooses({"#place-shape": shape}).settles().sees({"#place-wrong": False})
        assert len(person.address()["things"].split("..")[1].split("_")) >= 4, shape
    person.presses("[data-add=kits]")
    for k in range(person.counts("#kits button")):
        if not person.at("#kits").is_visible():
            person.presses("#tools [data-tool=kits]")
        kit = person.at(f"#kits button >> nth={k}")
        name = kit.locator("[data-text]").inner_text()
        kit.click()
        box = person.settles().box("#canvas")
        before = person.counts("#things li")
        left = box["x"] + 0.5 * box["width"]
        for right in (-30, 30):
            person.page.touchscreen.tap(left + right, box["y"] + 0.5 * box["height"])
        person.settles()
        if k + 1 < person.counts("#kits button"):
            assert person.counts("#things li") > before, name
            assert person.at("#things li:last-child > input:first-of-type").input_value().startswith(name)
        while person.counts("#things li") > before:
            person.presses("#undo").settles()
    assert person.findings() == []


def test_a_photo_stays_behind_the_square_on_the_device_with_the_scale_of_a_measured_distance(open_page, tmp_path):
    person = open_page("?door=village&path=route&benches=9", **PHONE)

    def file(name, content, mime="image/png"):
        return {"name": name, "mimeType": mime, "buffer": content}

    large = tmp_path / "c.png"
    with large.open("wb") as sparse:
        sparse.truncate(50_000_001)
    for wrong, words in (
        (file("a.heic", b"x", "image/heic"), "Browsers cannot show HEIC photos such as “a.heic”"),
        (file("b.png", b"x"), "“b.png” is no picture that this browser can show"),
        (large, "“c.png” has 51 MB; a photo may have at most 50 MB"),
    ):
        person.takes(wrong, "#photo-file").sees({"#status": words, "#photo": False})
    yard = BytesIO()
    Image.new("RGB", (80, 60), "#804020").save(yard, "PNG")
    person.takes(file("yard.png", yard.getvalue()), "#photo-file").sees({"#status": "stays on this device"}).settles()
    wide = person.coloured("#804020")
    assert wide > 1000
    for right in (-40, 40):
        person.page.touchscreen.tap(*person.spot("#canvas", right))
    person.sees({"#photo-size": True}).types({"#photo-metres": "200"}).sees({"#photo-size": False}).settles()
    assert person.presses("#show-all").settles().coloured("#804020") == pytest.approx(wide, rel=0.1)
    assert person.findings() == []
    person.page.reload()
    person.settles().sees({"#photo": True}).presses("#photo-hide").settles()
    assert person.coloured("#804020") == 0
    _a_photo_is_moved_turned_and_sized_by_fingers_keys_and_numbers(person.presses("#photo-hide"))
    person.presses("#photo-remove").sees({"#photo": False}).page.reload()
    person.settles().sees({"#photo": False})


def _a_photo_is_moved_turned_and_sized_by_fingers_keys_and_numbers(person):
    def place():
        return person.settles().ask("history.state.photo")

    before = place()
    x, y = person.presses("#photo-move").sees({".grip:visible": 3, "#photo-moving": True}).spot("#canvas")
    assert person.findings() == []
    expect(person.at(".grip.move")).to_be_focused()
    person.strikes("ArrowRight", "Shift+ArrowUp")
    steps = [place()]
    assert (steps[0]["x"] - before["x"], steps[0]["y"] - before["y"]) == pytest.approx((0.1, 0.01))
    person.swipes(x + 20, y + 30, 40, 0)
    steps.append(place())
    assert steps[1]["x"] > steps[0]["x"]
    assert steps[1]["y"] == pytest.approx(steps[0]["y"])
    # Two fingers a quarter of a turn about the first, which stays, to half the distance.
    person.pinches([(x, y, 0, 0), (x + 80, y, -80, -40)])
    steps.append(place())
    assert steps[2]["angle"] == pytest.approx(math.pi / 2)
    assert steps[2]["scale"] == pytest.approx(0.5 * steps[1]["scale"])
    person.drags(".grip.turn", 40, 0)
    steps.append(place())
    person.types({"#photo-angle": "-12,5", "#photo-wide": "120"})
    assert place()["angle"] == pytest.approx(math.radians(-12.5))
    assert place()["scale"] * place()["width"] == pytest.approx(120)
    person.types({"#photo-wide": "0"}).has("#photo-wide", aria_invalid="true")
    # One gesture is one step, also after the page was loaded again.
    person.page.reload()
    person.settles().presses("#undo", "#undo")
    for step in (*reversed(steps), before):
        assert place() == step
        person.presses("#undo")
    person.presses("#redo")


def test_the_verdict_follows_the_hand_and_a_line_says_what_its_change_has_done(open_page):
    person = open_page(f"{S_CURVE}&things=c.elm.1.0,24&view=0,10,10").sees(YES).presses("#edit").settles()
    mouse = person.page.mouse
    x, y = person.spot("#canvas", down=-140)
    mouse.move(x, y)
    mouse.down()
    bodies = []
    person.page.on("request", lambda one: bodies.append((one.url.rpartition("/")[2], one.post_data_json or {})))
    mouse.move(x, y + 80, steps=4)
    person.sees({"#change": "✕ The head touches elm", VERDICT: "Cannot be danced"})
    mouse.move(x, y + 40, steps=4)
    person.sees({"#change": "✓ Can be danced"})
    # However long the hand stays, only what is quick is asked for until it lets go.
    person.page.wait_for_timeout(1_000)
    assert {name for name, _ in bodies} <= {"check", "course", "trajectory", "healthz"}
    assert [body for name, body in bodies if name == "check" and body.get("details", True)] == []
    mouse.up()
    person.sees({"#change": re.compile(r"✓ “elm”: 2\.\d\d m free \(was 6\.\d\d\)")}).strikes("Escape").settles()
    # An example that takes the place of the path is no change of it.
    person.presses("#preset", "[data-begin=street]").settles().sees({"#change": False, **YES})


RING = (
    "?path=route&begin=40.9&start=0&things=a.square..-15,-20_15,-20_15,20_-15,20&walk=9.5,-4.8,1.570796327_0.7_9.6,"
    "3.141592654_1.4_9.6,3.141592654_1.4_9.6,3.141592654_1.4_9.6,3.141592654_1.4_9.6,3.141592654_1.4_9.6,0.88"
)


def test_a_figure_is_moved_sized_turned_and_mirrored_as_a_whole_until_it_is_freed_with_few_points(open_page):
    person = open_page(RING).sees(YES).presses("#edit").settles().sees({".knot": 0, "#figure": True})
    before = person.address()["walk"]
    person.drags(".grip.move", 20, 0).settles()
    start, *steps = person.address()["walk"].split("_")
    assert float(start.split(",")[0]) > 9.6
    assert steps == before.split("_")[1:]
    person.sees(YES).drags(".grip.size", -20, -20).settles()
    radius = float(person.sees(YES).address()["walk"].split("_")[2].split(",")[0])
    assert 8 < radius < 9.5
    canvas = person.box("#canvas")
    person.drags(".grip.turn", 40, 0).presses("#mirror").sees(YES).settles()
    assert ",-3.14159265" in person.address()["walk"]
    # Its numbers are typed too.
    person.types({"#figure [data-label^='Largest radius']": "0.1"}, "Tab")
    person.sees({"#status": "“Largest radius of its bends [m]” must be a number from 0.5 to 1000; you typed “0.1”"})
    person.types({"#figure [data-label^='Largest radius']": "9", "#figure [data-label$='x [m]']": "0,5"}, "Tab")
    person.holds({"#figure [data-label$='x [m]']": "0.5"}).types({"#figure [data-label^='Direction']": "90"}).settles()
    start, _, bend, *_ = person.address()["walk"].split("_")
    assert (start.split(",")[2], bend.split(",")[0]) == ("1.570796327", "9")
    # A tap on free ground breaks nothing.
    person.page.mouse.click(canvas["x"] + 60, canvas["y"] + canvas["height"] - 60)
    person.sees({"#status": "This path is a figure"}).strikes("Escape")
    for _ in range(7):
        person.presses("#undo")
    assert person.settles().address()["walk"] == before
    # Four corners make a ring; all of its laps go with a corner that is dragged.
    person.presses("#free").sees({"#status": "The figure is now a path of 7 points", ".knot:visible": 7, **YES})
    ring = person.address()["route"].split("_")
    bent = person.drags(knot(1), 20, -20).sees(YES).settles().address()["route"].split("_")
    assert bent == [bent[1] if one == ring[1] else one for one in ring] != ring
    assert bent.count(bent[1]) == 3
    person.strikes("Delete").sees({".knot:visible": 6})
    person.presses("#undo", "#undo", "#undo").sees({"#figure": True, ".knot": 0})
    # On a phone its numbers stand below the picture.
    person = open_page(RING, **PHONE).sees(YES).presses("#edit").settles()
    canvas = person.box("#canvas")
    assert person.box("#figure")["y"] >= canvas["y"] + canvas["height"] - 1
    assert person.findings() == []


def test_by_keys_alone_a_list_leads_on_and_a_square_is_drawn_changed_taken_back_and_danced_in(open_page):
    person = open_page("?door=village&path=route&benches=9").strikes("?")
    person.sees({"#keys .main": "Next: The size of the square"})
    assert person.findings() == []
    person.strikes("Enter", "Tab")
    # In a field for a number it is no character.
    person.types({"#place-width": "42", "#place-height": "24"}).strikes("?").sees(
        {"#keys .main": "Next: Propose a dance"}
    ).strikes("Escape")
    expect(person.at("#place-height")).to_be_focused()
    tree = person.focuses("[data-add=circle]").strikes("Enter", "n", "Shift+ArrowUp").settles().address()["things"]
    x, y = (float(one.replace("!", ".")) for one in tree.partition("~c.tree.0!5.")[2].split(","))
    assert round(100 * y) % 10 in (1, 9)
    # The keys [ and ] choose things on the picture, which say where they are.
    person.focuses("#canvas").strikes("]").sees({"#told": "square: x 0 m", "#beside": True})
    person.strikes("[").sees({"#told": f"tree: x {x:g} m, y {y:g} m"})
    person.strikes("ArrowLeft").sees({"#told": f"tree: x {x - 0.1:.2g} m"})
    person.strikes("Shift+F10").sees({"#menu": ["Duplicate", "Delete"]}).strikes("Escape")
    person.strikes("ControlOrMeta+d", "Delete", "ControlOrMeta+z", "ControlOrMeta+z", "ControlOrMeta+z")
    assert person.settles().address()["things"] == tree
    # A gate comes to the side across, where its own side does not go that way, and a second one says what each is.
    person.focuses("[data-tool=gate]").strikes("Enter", "n", "ArrowUp", "ArrowDown", "n", "ArrowUp")
    person.sees({"#draw-help": "The dragon comes in at “gate” and goes out at “gate 2”"}).settles()
    gates = person.address()["things"].split("~g.gate")[1:]
    assert [re.fullmatch(r".*(in|out)\.[^,]*,(.*)", gate).groups() for gate in gates] == [("in", "-12"), ("out", "12")]
    # Keys go on at what has been found.
    person.strikes("Escape", "?").sees({"#keys .main": "Next: Propose a dance"}).strikes("Shift+Tab", "Tab", "Enter")
    person.strikes("Enter").sees({"#cards button": 3})
    expect(person.at("#cards button")).to_be_focused()
    person.speaks("zh").strikes("?").sees({"#keys": ["下一步：结果", "按住 Shift 为 1 cm"]})


def test_a_dragon_is_dragged_along_its_path_and_starts_there(open_page):
    person = open_page(f"{S_CURVE}&benches=9&begin=30", **TABLET).sees(YES).presses("#edit").settles()
    before = person.address()
    box = person.box(".grip.start")
    person.swipes(box["x"] + 11, box["y"] + 11, 60, 20)
    person.sees({**YES, "#start-place": True}).settles()
    begins = float(person.address()["begin"])
    assert 40 < begins < 60
    assert person.findings() == []
    # The dance starts there, at time 0, and its numbers go on from there by keys and as typed.
    assert (person.address()["start"], person.address()["time"]) == ("0", "0")
    person.sees({"#judgement": f"on the first {begins:.1f} m"}).strikes("ArrowRight", "Shift+ArrowRight")
    assert float(person.settles().address()["begin"]) == pytest.approx(begins + 1.1)
    person.types({"#start-place": "62,5"}).sees({"#judgement": "on the first 62.5 m"})
    # Where the dragon is not yet whole on its path, the dance starts as soon as it is.
    person.types({"#start-place": "7"}).sees({"#judgement": "on the first 16.1 m"})
    for _ in range(4):
        person.presses("#undo")
    assert {**person.settles().address(), "time": "0"} == {**before, "time": "0"}


def test_a_touch_of_a_name_takes_its_thing_and_layers_are_hidden_and_shown_again(open_page):
    person = open_page(f"{S_CURVE}&things=c.elm.1.10,8&view=0,10,10", failing=True, **PHONE).sees({"#verdict": True})
    x, y = person.presses("#edit").settles().spot("#canvas", 100, 20)
    person.page.touchscreen.tap(x + 24, y - 14)
    person.holds({"#beside input": "elm"}).presses("#beside button:has-text('✓')").settles()
    assert person.findings() == []
    tree = person.coloured("thing")
    person.presses("#layers").sees({"#shown": ["Dragons", "Photo or plan"]}).presses("#shown [name=things]")
    assert abs(person.spot("#shown [name=things]")[1] - person.spot("#shown label >> nth=0")[1]) < 2
    person.presses("#shown button:has-text('Close')").sees({"#shown": False}).settles()
    assert person.coloured("thing") == 0 < tree
    # What is hidden is not touched: there the path goes on.
    person.page.touchscreen.tap(x, y)
    person.sees({"#beside": False}).presses("#undo", "#layers", "#shown [name=things]")
    person.presses("#shown button:has-text('Close')").sees({"#shown": False}).settles()
    assert person.coloured("thing") == tree


def test_several_things_are_chosen_moved_brought_into_line_copied_and_removed_together(open_page):
    trees = "c.well.1.20,22~c.elm.1.30,25~c.oak.1.33,28"
    person = open_page(f"{S_CURVE}&things=b.stage..-5,20_5,20_5,26_-5,26~{trees}&view=0,10,10").sees(YES)
    before = person.presses("#edit").settles().address()["things"]
    page = person.page

    def at(x, y):
        return person.spot("#canvas", 10 * x, -10 * (y - 10))

    page.mouse.click(*at(20, 22))
    page.keyboard.down("Shift")
    for place in ((30, 25), (0, 23)):
        page.mouse.click(*at(*place))
    page.keyboard.up("Shift")
    person.sees({"#beside": "3 things"}).page.mouse.click(*at(0, 23), button="right")
    assert person.sees({"#menu": ["Copy", "Delete"]}).findings() == []
    person.presses("#menu button:has-text('In a row')").drags_from(*at(0, 22), 30, 50)
    person.strikes("ArrowLeft", "Shift+ArrowUp").settles()
    stage = "b.stage..-2!1,14!01_7!9,14!01_7!9,20!01_-2!1,20!01"
    moved = f"{stage}~c.well.1.22!9,17!01~c.elm.1.32!9,17!01~c.oak.1.33,28"
    assert person.address()["things"] == moved
    person.strikes("ControlOrMeta+d").sees({"#things li": 7}).strikes("Delete").sees({"#things li": 4})
    for _ in range(5):
        person.presses("#undo")
    assert person.settles().address()["things"] == before
    # A frame chooses what is in it, a press on free ground nothing.
    person.presses("[data-tool=several]").drags_from(*at(15, 15), 200, -150).sees({"#beside": "3 things"})
    page.mouse.click(*at(-20, -5))
    person.sees({"#beside": False}).presses("[data-tool=path]").page.mouse.click(*at(-20, -5), button="right")
    # A press beside the menu closes it, and adds no point.
    person.sees({"#menu": "Choose several"}).page.mouse.click(*at(20, -5))
    person.sees({"#menu": False, ".knot": 7})


def test_a_long_press_opens_the_menu_of_a_point_on_a_phone(open_page):
    person = open_page(f"{S_CURVE}&view=0,10,10", **PHONE).sees({"#verdict": True}).presses("#edit").settles()
    finger = person.page.context.new_cdp_session(person.page)
    place = dict(zip("xy", person.spot(knot(5)), strict=True))
    finger.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [place]})
    person.sees({"#menu": ["Insert a point", "Delete point 6"]})
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    person.presses("#menu button:has-text('Delete point 6')").sees({"#menu": False, ".knot": 6})


def test_a_finger_drags_points_and_trees_on_a_phone_and_nothing_is_cut_off(open_page):
    person = open_page(S_CURVE, locale="zh-CN", **PHONE).sees({VERDICT: "可以表演"}).presses("#edit").settles()
    before = points(person)
    # A finger that has begun to drag, however little, may rest: no menu opens.
    person.swipes(*person.spot(knot(2)), 0, -6, rest=LONG_PRESS)
    assert points(person.sees({"#menu": False, "#verdict": "可以表演"}))[2][1] > before[2][1]
    assert not person.overflows(390)
    assert person.findings() == []
    _a_mouse_takes_nothing_while_a_finger_drags(person)
    _a_tree_goes_upwards_as_far_as_the_finger(person.opens(S_CURVE))
    _a_stroke_draws_a_path_to_which_the_next_one_is_added(person.opens("?door=village&path=route&benches=2"))


def _a_mouse_takes_nothing_while_a_finger_drags(person):
    before = points(person)
    first, second = (person.box(knot(k)) for k in (2, 4))
    finger = person.page.context.new_cdp_session(person.page)
    for kind, y in (("touchStart", 0), ("touchMove", 10), ("touchMove", 20)):
        place = {"x": first["x"] + 11, "y": first["y"] + 11 + y}
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [place]})
    person.drags_from(second["x"] + 11, second["y"] + 11, 30, 0).sees({"#status": "已有东西在拖动"})
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    after = points(person)
    assert [k for k, point in enumerate(after) if point != before[k]] == [2]
    assert points(person.presses("#undo")) == before


def _a_tree_goes_upwards_as_far_as_the_finger(person):
    person.presses("#edit", "[data-tool=circle]").settles()
    canvas = person.box("#canvas")
    x = canvas["x"] + 0.5 * canvas["width"]
    y = canvas["y"] + 0.8 * canvas["height"]

    def tree():
        return person.box(".knot")["y"]

    person.page.touchscreen.tap(x, y)
    before = tree()
    person.presses("[data-tool=circle]").sees({".knot": 0}).swipes(x, y, 0, -80)
    assert tree() == pytest.approx(before - 80, abs=3)


def _a_stroke_draws_a_path_to_which_the_next_one_is_added(person):
    person.presses("#invite .main").settles()
    x, y = person.spot("#canvas")
    person.swipes(x - 80, y, 120, -60)
    person.sees({".knot": 2}).swipes(x + 80, y, 0, 60)
    assert len(points(person.sees({".knot": 4}))) == 4


@thorough
def test_each_failure_is_shown_on_the_picture_and_the_dance_opens_again_from_its_address_and_file(open_page, server):
    person = open_page(VILLAGE, failing=True).sees({**NO, "#run-end[aria-busy=false]": True})
    body = file_of(person)
    answer = polite.answer(server, "check", body)["failures"]
    assert [one["kind"] for one in answer] == ["venue", "speed"]
    assert person.texts(".failures li button") == [f"{one['time']:.6f} s" for one in answer]
    person.sees({".failures li": "The head touches well.", ".failures li >> nth=1": "is 1.20 m/s"})
    person.presses(".failures li button").arrives(f"**time={round(answer[0]['time'], 9)}**")
    marked = person.sees({"#clock": f"{answer[0]['time']:.6f}"}).settles().picture()
    assert alike(marked, person.presses("#on", "#back").settles().picture())
    address = person.page.url
    person.page.goto(address)
    assert file_of(person.sees(NO)) == body
    person.presses("#things li >> nth=1 >> button >> nth=-1").sees({".failures li:has-text('touches')": 0})
    _a_dance_that_starts_in_the_wrong_place_or_is_refused_is_said_to_be_so(person)


def _a_dance_that_starts_in_the_wrong_place_or_is_refused_is_said_to_be_so(person):
    for things, words in (
        ("a.court..-9,-9_30,-9_30,9_-9,9", "starts outside court"),
        ("a.court..-30,-9_30,-9_30,9_-30,9~c.elm.2.-18,0", "starts inside elm"),
    ):
        person.opens(f"?path=route&benches=3&route=*-20,0_20,0&things={things}").sees({**NO, ".failures li": words})
    person.opens("?path=route&benches=9&route=*-60,0_*0,0_-40,8&corner=0.3").sees(NO)
    person.presses("#judgement button:has-text('Show')").arrives("**view=**")
    assert max(map(abs, map(float, person.address()["view"].split(",")[:2]))) < 3
    person.opens("?path=route&benches=40&route=0,0_9,0")
    person.sees({**NO, "#play": False, "#legend": False}).types({"[data-field=benches] input": "3"}).settles()
    person.sees({**YES, "#play": True})
    # Of a dance that cannot follow a change the dragon fades, and the drawing does not.
    square = "things=a.square..-70,-9_9,-9_9,49_-70,49"
    person.opens(f"?path=route&benches=9&route=*-60,0_*0,0_0,40&{square}").sees(YES)
    person.types({"[data-field=benches] input": "90"}).settles().sees(NO)
    assert [person.coloured(name) > 0 for name in ("head", "circle")] == [False, True]


def _a_dance_that_begins_later_can_begin_at_time_0(person):
    offer = "#route .hint button:has-text('Begin at time 0: head at')"
    person.presses(offer).arrives("**begin=40.9*")
    person.sees({offer: False, **YES}).page.go_back()
    # A path too short for the dragon is refused; the dance does not begin later instead.
    person.sees({offer: True}).types({"#benches": "200"}, "Tab").sees({**NO, offer: False})


@thorough
def test_what_comes_late_is_not_shown_without_a_drawing_nor_of_another_kind_of_dance(open_page):
    person = open_page("?benches=5&time=end")
    _the_picture_has_the_drawn_path_alone(person)
    for late in ("check", "course"):
        person.opens("?path=route&benches=3&route=*-20,0_20,0&lang=en").sees(YES).presses("#edit")
        held = person.holds_back(f"**/{late}")
        with person.page.expect_request(f"**/{late}"):
            person.types({"#benches": "4"}, "Tab")
        person.presses("#delete")
        held.let_go()
        for language, words in (("zh", "可以"), ("en", "Can be danced")):
            assert words not in person.speaks(language).text("#judgement")


def _the_picture_has_the_drawn_path_alone(person):
    held = person.holds_back("**/trajectory")
    with person.page.expect_request(lambda one: '"decimals":4' in (one.post_data or "")):  # the path of the spiral
        person.types({"#pitch": "0.6"}, "Tab")
    person.presses("[data-path=route]").sees(YES).settles("course")
    held.let_go()
    canvas = person.settles().box("#canvas")
    knots = [one.bounding_box() for one in person.all(".knot").all()]
    beside = [(box["x"] - canvas["x"], box["y"] - canvas["y"]) for box in knots]
    assert len(knots) > 1
    assert all(0 < x < canvas["width"] and 0 < y < canvas["height"] for x, y in beside)


@thorough
def test_every_preset_can_be_danced_leaves_a_square_of_ones_own_and_a_later_start_can_be_at_time_0(open_page):
    person = open_page("?path=route&benches=24&route=0,0_150,0", failing=True)
    _a_dance_that_begins_later_can_begin_at_time_0(person)
    person.types({"#benches": "24"}, "Tab").sees(YES)
    for name in ("inout", "eight", "street", "village", "s"):
        before = person.address()
        person.presses("#preset", f"[data-begin={name}]").sees({"#presets": False}).settles().sees(YES)
    assert person.presses("#undo").settles().address() == before
    person.opens("?path=route&route=0,0_30,0_60,9&things=a.court..-99,-99_99,-99_99,99_-99,99~c.elm.1.40,40")
    for name, count in (("street", 2), ("empty", 0)):
        person.presses("#preset", f"[data-begin={name}]").sees({"#points summary": f": {count}", "#things li": 2})
        person.sees({"#status": "has taken the place of the path; Undo brings it back"}).presses("#status")
    person.presses("#preset", "[data-begin=village]", "#beside-it").sees({"#things li": 6}).presses("#undo")
    person.presses("#preset", "[data-begin=village]", "#instead").sees({"#status": "the place of the square; Undo"})
    person.presses("#undo").sees({"#things li": 2})
    assert person.text("#status") == ""


def test_drawings_maps_tables_and_workbooks_are_opened_and_a_survey_grid_is_kept(open_page, tmp_path):
    person = open_page("?path=route&benches=5", failing=True)
    _a_part_of_a_drawing_that_is_too_large_is_chosen(person)
    _files_dropped_on_the_picture_are_opened_and_maps_are_kept(person.opens(f"{S_CURVE}&things=c.well.1!5.0,-40"))
    person.opens("?path=route")
    corners = [[499_950, 3_219_950], [500_050, 3_219_950], [500_050, 3_220_050], [499_950, 3_219_950]]
    grid, table, book = (tmp_path / f"one.{ending}" for ending in ("geojson", "csv", "xlsx"))
    square = {"type": "Polygon", "coordinates": [corners]}
    line = {"type": "LineString", "coordinates": [[499_960, 3_220_000], [500_040, 3_219_990]]}
    grid.write_text(json.dumps({"type": "GeometryCollection", "geometries": [square, line]}))
    person.takes(grid)
    person.sees({"#status": "x = y = 0 is its x 500000 m, y 3220000 m"})
    assert person.address()["grid"] == "500000,3220000"
    person.page.goto(person.page.url)
    assert file_of(person.settles())["venue"]["grid"] == {"x": 500_000, "y": 3_220_000}
    table.write_bytes("周,3.41,0.3,0.275\n李,2.2,0.3,0.275\n".encode("gb18030"))
    person.takes(table).holds({"#csv": "周,3.41,0.3,0.275\n李,2.2,0.3,0.275\n"}).presses("#undo").holds({"#csv": ""})
    workbook = openpyxl.Workbook()
    workbook.active.append(["吴", 3.41, 0.3, 0.275])
    workbook.save(book)
    person.takes(book, "#csv-file").holds({"#csv": "吴,3.41,0.3,0.275\n"}).presses("#undo").holds({"#csv": ""})


def _a_part_of_a_drawing_that_is_too_large_is_chosen(person):
    plan = {"name": "plan.dxf", "mimeType": "image/vnd.dxf", "buffer": floor_plan()}
    person.takes(plan).sees({"#drawing-parts li": len(EDGES)}).strikes("Escape").sees({"#drawing-parts": 0})
    person.takes(plan).sees({"#drawing-parts li": len(EDGES)}).presses(
        "#drawing-parts [value=SITE]", "#drawing-parts [value=A-HATCH]"
    )
    person.presses("#drawing-parts [value=A-HATCH]", "#parts-open").sees({"#drawing-parts": 0, "#things li": 1})
    # The name of a layer may hold a comma.
    person.takes(plan).presses("#drawing-parts [value=SITE]", f'#drawing-parts [value="{WALLS}"]', "#parts-open")
    person.presses("#instead").sees({"#drawing-parts": 0, "#things li": 121})
    town_map = {"name": "town.geojson", "mimeType": "application/geo+json", "buffer": town()}
    person.takes(town_map).sees({"#drawing-parts li": 4}).presses("#drawing-parts [value=SITE]", "#parts-open")
    person.presses("#instead").sees({"#drawing-parts": 0, "#things li": 1})


def test_a_file_comes_beside_what_is_drawn_a_dance_as_a_further_dragon_or_not_at_all(open_page, tmp_path):
    dance = tmp_path / "dance.json"
    dance.write_bytes(open_page("?path=route&route=*-30,12_30,12&benches=5&things=c.elm.1.0,20").saves("#save"))
    person = open_page(f"{S_CURVE}&things=a.court..-99,-99_99,-99_99,99_-99,99~c.well.1.40,40").sees(YES)
    before = person.address()
    square = ROOT / "examples/village_square.geojson"
    person.takes(square).sees({"#opening": "Open village_square.geojson"}).strikes("Escape").sees({"#opening": 0})
    assert person.findings() == []
    person.takes(square).presses("#beside-it")
    person.sees({"#status": "these of the file are left out: “square”", "#things li": 6}).settles()
    names = [one.input_value() for one in person.all("#things li > input:first-of-type").all()]
    assert names[:3] == ["court", "well", "well 2"]
    assert person.address()["route"] == before["route"]
    assert person.presses("#undo").settles().address() == before
    person.takes(dance).presses("#beside-it").sees({"#dragons li": 2, "#things li": 3, VERDICT: True}).settles()
    assert "*-30,12_30,12" in person.address()["dances"]
    assert person.presses("#undo").settles().address() == before


def _drops(person, name):
    person.ask(DROP, [name, (ROOT / "examples" / name).read_text()])
    # Nobody has made an example, so it is replaced without a question.
    if person.counts("#things li") == 1:
        person.presses("#instead")
    person.sees({"#status": f"Opened {name}"})


def _files_dropped_on_the_picture_are_opened_and_maps_are_kept(person):
    person.sees(YES)
    before = person.address()
    _drops(person, "village_square.toml")
    now = person.settles().address()
    assert person.ask(COVERED) == []
    assert person.strikes("ControlOrMeta+z").settles().address() == before
    assert person.presses("#redo").settles().address() == now
    _drops(person, "village_square.geojson")
    body = file_of(person.sees({"#things li >> nth=4": True, "#points summary": "12", **YES}))
    assert (body["margin"], body["path"]["start"]) == (0.5, 45.0)
    assert b'"stage"' in person.reaches().saves("#keepMap-GeoJSON")
    # KML needs the place on earth, which the form takes, and the page leads there; it is in the address.
    latitude, longitude = (f"#{name}" for name in ("latitude", "longitude"))
    person.presses("#keepMap-KML").sees({"#status": "KML is in degrees"})
    expect(person.at(latitude)).to_be_focused()
    person.types({latitude: "29,11", longitude: "119.64"}, "Tab").arrives("**origin=119.64,29.11*")
    assert b">119.64" in person.saves("#keepMap-KML")
