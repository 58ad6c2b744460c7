"""Drawings of other programs: nothing in them is lost, and nothing is invented."""

import io
import time

import ezdxf
import numpy as np
import pytest
from ezdxf.math import Vec2
from ezdxf.render.mleader import ConnectionSide

from app.maps.places import places_of
from core import InvalidValue
from core.language import speaking
from core.quantities import Quantity
from tests.app.maps.test_maps import map_of, names, posted, things
from tests.support.near import assert_near
from tests.support.refusal_rows import assert_refused
from tests.support.refused import refused
from tests.support.slow_search import in_plane


def new(unit=6, version="R2010", square=True):
    """The space of a new drawing, with a square of 100 m around (0, 0)."""
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = unit
    space = document.modelspace()
    if square:
        ring(space, 50, layer="SQUARE")
    return space


@pytest.fixture
def space():
    return new()


@pytest.fixture
def empty():
    """The space of a drawing without a square."""
    return new(square=False)


def ring(space, half, x=0.0, y=0.0, close=True, **attributes):
    """The sides of a square around a place."""
    corners = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
    space.add_lwpolyline(corners, close=close, dxfattribs=attributes)


def drawing(space):
    sink = io.StringIO()
    space.doc.write(sink)
    return sink.getvalue().encode(space.doc.output_encoding)


def read(space):
    return places_of(drawing(space), None)


def corners(result):
    """The outline of the square."""
    return [*result.venue.square.rings[0]]


def test_an_array_of_blocks_has_all_of_them(space):
    space.doc.blocks.new("TREE").add_circle((0, 0), 0.4)
    array = {"row_count": 2, "column_count": 3, "row_spacing": 4.0, "column_spacing": 5.0}
    space.add_blockref("TREE", (0, 0), dxfattribs=array)
    assert sorted(things(read(space))) == [("Point", [x, y], 0.4) for x in (0.0, 5.0, 10.0) for y in (0.0, 4.0)]


@pytest.mark.parametrize("version", ["R12", "R2010"])
@pytest.mark.parametrize("across", [0.1, 2_000.0, 60_000.0])
def test_a_drawing_without_a_unit_is_in_metres_or_refused_where_it_cannot_be(version, across):
    space = new(0, version, square=False)
    for place in ((120.0, 29.0), (120.0 + across, 29.0)):
        space.add_circle(place, 0.04)
    if across > 2_000.0:
        with refused("file", across=Quantity(across, "", 6)):
            read(space)
        return
    result = read(space)
    (_, first, radius), (_, second, _) = things(result)
    assert (*first, radius, second[0] - first[0]) == pytest.approx((120.0, 29.0, 0.04, across))
    assert "The file states no unit: its numbers are metres." in result.notes


def test_a_map_that_is_too_wide_for_a_dance_is_refused(empty):
    for x in (500_000.0, 600_000.0):
        empty.add_circle((x, 3_000_000.0), 1.0)
    with pytest.raises(InvalidValue, match="20 km across, got about 100 km"):
        read(empty)


@pytest.mark.parametrize("unit, metres", [(2, 0.3048), (21, 1200 / 3937), (23, 3600 / 3937), (15, 10.0), (8, 2.54e-8)])
def test_every_unit_of_a_drawing_is_known(unit, metres):
    space = new(unit=unit, square=False)
    space.add_circle((30 / metres, 0), 2 / metres)
    assert things(read(space)) == [("Point", [pytest.approx(30.0), 0.0], pytest.approx(2.0))]


def test_what_cannot_be_seen_or_read_is_left_out_and_said(space):
    document = space.doc
    document.layers.add("TREES").off()
    document.layers.add("OLD").freeze()
    document.blocks.new("TREE").add_circle((0, 0), 1.0)
    for layer in ("TREES", "OLD"):
        space.add_circle((10, 5), 1.0, dxfattribs={"layer": layer})
        space.add_blockref("TREE", (40, 5), dxfattribs={"layer": layer})
    space.add_circle((30, 5), 1.0, dxfattribs={"invisible": 1})
    space.add_polymesh((2, 2))
    space.add_polyface()
    damaged = space.add_spline(degree=3)
    damaged.control_points = [(k, k * k, 0) for k in range(4)]
    damaged.knots = [0, 0, 0, 0, 1, 1, 1, 0.5]
    document.add_xref_def("other.dwg", "OTHER")
    for name in ("LOST", "OTHER"):
        space.add_blockref(name, (3, 3))
    space.add_circle((0, 30), 1.0)
    result = read(space)
    assert things(result) == [("Point", [0.0, 30.0], 1.0)]
    assert {one for one in result.notes if one.startswith("Left out")} == {
        "Left out, because hidden: 4 CIRCLEs.", "Left out, because hidden: 1 INSERT.", "Left out: 1 POLYMESH.",
        "Left out: 1 POLYFACE.", "Left out: 1 damaged SPLINE.", "Left out: 1 damaged INSERT.",
        "Left out: 1 block of another drawing.",
    }  # fmt: skip


def test_a_block_squeezed_to_a_line_is_left_out_and_one_of_no_height_is_drawn(space):
    space.doc.blocks.new("TREE").add_circle((0, 0), 0.3)
    plan = space.doc.blocks.new("ROW")
    plan.add_blockref("TREE", (1, 2))
    plan.add_circle((3, 4), 0.5)
    space.add_blockref("ROW", (29, 8), dxfattribs={"xscale": 7.25})
    space.add_blockref("ROW", (9, 8), dxfattribs={"zscale": 0.0})
    result = places_of(drawing(space).replace(b"7.25", b"0.0"), None)
    assert things(result) == [("Point", [10.0, 10.0], 0.3), ("Point", [12.0, 12.0], 0.5)]
    assert "Left out: 1 damaged INSERT." in result.notes


# Entities as small programs write them, without the markers (code 100) of their parts.
UNMARKED = """0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 ENTITIES
0 LWPOLYLINE 8 square 90 4 70 1 10 0 20 0 10 40 20 0 10 40 20 30 10 0 20 30
0 SPLINE 8 walls 71 1 72 4 73 2 74 0 40 0 40 0 40 1 40 1 10 5 20 5 10 9 20 5
0 MULTILEADER 8 words 300 CONTEXT_DATA{ 40 1.0 301 }
0 CIRCLE 8 trees 10 20 20 15 40 0.5 0 ENDSEC 0 EOF"""


def test_entities_without_the_markers_of_their_parts_are_read_or_named_as_left_out():
    result = places_of("\n".join(UNMARKED.split()).encode(), None)
    assert corners(result)[:4] == [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0)]
    assert things(result)[1] == ("Point", [20.0, 15.0], 0.5)
    assert things(result)[0][0] == "LineString"
    assert "Left out: 1 damaged MULTILEADER." in result.notes


@pytest.mark.parametrize(
    "row",
    [
        "HATCH 8 x -> HATCH",
        "IMAGE 8 x 10 3 20 3 -> IMAGE",
        "CIRCLE 8 x 10 20 20 15 40 1_0.5 -> CIRCLE",
        "CIRCLE 8 x 10 20 20 15 40 0,5 -> CIRCLE",
        "CIRCLE 8 x 10 20 20 15 40 0.5.3 -> CIRCLE",
        "CIRCLE 8 x 10 20 20 15 40 nan -> CIRCLE",
        "3DFACE 8 x 10 1_0 20 15 -> 3DFACE",
        "CIRCLE 8 x 10 20 40 0.5 -> CIRCLE",
        "LINE 8 x 10 20 20 5 -> LINE",
        "LINE 8 x 70 ten 10 20 20 5 11 20 21 9 -> LINE",
        "HELIX 8 x 10 20 20 5 -> HELIX",
        "POLYLINE 8 x 66 1 0 VERTEX 8 x 10 1_0 20 0 0 VERTEX 8 x 10 3 20 0 0 SEQEND -> POLYLINE",
    ],
)
def test_an_entity_that_cannot_be_read_is_left_out_alone(row):
    entity, kind = row.split(" -> ")
    words = UNMARKED.replace("0 ENDSEC 0 EOF", f"0 {entity} 0 ENDSEC 0 EOF").split()
    result = places_of("\n".join(words).encode(), None)
    assert things(result)[1:] == [("Point", [20.0, 15.0], 0.5)]
    assert f"Left out: 1 damaged {kind}." in result.notes


def bare(data, kinds):
    """A drawing without the markers of some kinds, or of all of them."""
    lines = data.decode().split("\n")
    result = []
    kind = ""
    for code, value in zip(lines[::2], lines[1::2], strict=False):
        kind = value.strip() if code.strip() == "0" else kind
        if code.strip() != "100" or (kinds and kind not in kinds):
            result += [code, value]
    return "\n".join([*result, ""]).encode()


def test_a_number_that_dxf_does_not_have_leaves_out_no_layer(space):
    space.doc.layers.add("CHAIRS").off()
    space.add_circle((3, 3), 0.5, dxfattribs={"layer": "CHAIRS"})
    data = drawing(space)
    broken = data.replace(b"\n  2\nCHAIRS\n", b"\n  2\nCHAIRS\n 48\n1,5\n", 1)
    assert broken != data
    assert "Left out, because hidden: 1 CIRCLE." in places_of(data, None).notes
    assert places_of(broken, None).notes == places_of(data, None).notes


@pytest.mark.parametrize("content", ["text", "block"])
def test_a_note_with_an_arrow_is_left_out_by_name_also_without_markers(content, space):
    if content == "text":
        leader = space.add_multileader_mtext("Standard")
        leader.set_content("Old oak")
    else:
        space.doc.blocks.new("TAG").add_circle((0, 0), 1)
        leader = space.add_multileader_block("Standard")
        leader.set_content("TAG")
    leader.add_leader_line(ConnectionSide.left, [Vec2(5, 5)])
    leader.build(insert=Vec2(10, 10))
    data = drawing(space)
    for part, word in (
        (data, "MULTILEADER"),
        (bare(data, ["MULTILEADER"]), "damaged MULTILEADER"),
        (bare(data, []), "damaged MULTILEADER"),
    ):
        result = places_of(part, None)
        assert [note for note in result.notes if note.startswith("Left out")] == [f"Left out: 1 {word}."]
        assert corners(result)[0] == (-50.0, -50.0)


def test_a_note_calls_a_thing_without_a_name_by_a_word_of_its_language(space):
    space.add_circle((10, 5), 0.0)
    space.add_line((20, 5), (20.0002, 5))
    space.add_point((30, 5))
    with speaking("zh"):
        notes = read(space).notes
    assert "未读取：1 个半径小于 0.001 m 的圆：圆。" in notes
    assert "未读取：1 个小于 0.001 m 的图形：线。" in notes
    assert "Left out: 1 shape of less than 0.001 m: line." in read(space).notes


@pytest.mark.parametrize("length", [0.0002, 0.0005, 0.02])
def test_a_stroke_in_a_plan_is_neither_its_path_nor_a_refusal(length, space):
    space.add_circle((20, 0), 0.4, dxfattribs={"layer": "TREES"})
    space.add_line((8, 5), (8 + length, 5), dxfattribs={"layer": "STROKE"})
    space.add_arc((12, 5), 0.5 * length, 0, 90, dxfattribs={"layer": "DOT"})
    space.add_lwpolyline([(16, 5), (16 + length, 5), (16, 5 + length)], close=True, dxfattribs={"layer": "CHIP"})
    space.add_circle((20, 5), length, dxfattribs={"layer": "NAIL"})
    result = read(space)
    assert result.path is None
    notes = ["3 shapes of less than 0.001 m: STROKE, DOT, CHIP.", "1 circle with a radius of less than 0.001 m: NAIL."]
    assert [f"Left out: {note}" in result.notes for note in notes] == [length < 0.001] * 2
    assert len(things(result)) == (1 if length < 0.001 else 5)


def test_of_two_areas_called_square_a_tiny_one_is_left_out(empty):
    for half in (0.0002, 40):
        ring(empty, half, layer="SQUARE")
    assert corners(read(empty))[0] == (-40.0, -40.0)


def test_where_all_is_hidden_the_refusal_says_what(empty):
    empty.doc.layers.add("PLAN").freeze()
    empty.add_line((0, 0), (9, 0), dxfattribs={"layer": "PLAN"})
    with pytest.raises(InvalidValue, match=r"1 LINE is hidden; show it or its layer$"):
        read(empty)
    empty.add_line((0, 9), (9, 9), dxfattribs={"layer": "PLAN"})
    with pytest.raises(InvalidValue, match=r"2 LINEs are hidden; show them or their layers$"):
        read(empty)
    empty.add_point((0, 0), dxfattribs={"layer": "PLAN"})
    with speaking("zh"), pytest.raises(InvalidValue, match=r"2 个 LINE、1 个 POINT 被隐藏"):
        read(empty)


def test_entities_of_a_block_take_its_layer(empty):
    ring(empty.doc.blocks.new("BED"), 1, 1, 1)
    empty.add_blockref("BED", (5, 5), dxfattribs={"layer": "障碍"})
    ring(empty, 60)
    result = read(empty)
    assert corners(result)[0] == (-60.0, -60.0)
    assert [form for form, *_ in things(result)] == ["Polygon"]


def test_only_a_ring_in_an_area_of_its_layer_is_a_hole(space):
    ring(space, 5, layer="HOUSE")
    for x in (0, 30):
        ring(space, 2, x, layer="HOUSE_HOLES")
    space.add_circle((0, 30), 0.4, dxfattribs={"layer": "PLANT_HOLES"})
    space.add_circle((0, 0), 0.3, dxfattribs={"layer": "HOUSE_HOLES"})
    house, lone, *round_ones = things(read(space))
    assert [len(house[1]), len(lone[1])] == [2, 1]
    assert round_ones == [("Point", [0.0, 30.0], 0.4), ("Point", [0.0, 0.0], 0.3)]


def test_a_closed_spline_is_the_area_in_it(space):
    sides = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)]
    entity = space.add_spline(degree=3, dxfattribs={"layer": "OBSTACLES", "flags": 3})
    entity.control_points = [*sides, *sides[:3]]
    entity.knots = range(11)
    [(form, rings, _)] = things(read(space))
    assert form == "Polygon"
    assert_near((np.min(rings), np.max(rings)), (0.417, 9.583), 0.005)


@pytest.mark.parametrize("unit, metres", [(6, 1.0), (4, 0.001)])
def test_a_wide_line_is_a_wall_of_its_width(unit, metres):
    space = new(unit, square=False)
    points = [(-10 / metres, 0), (10 / metres, 0)]
    space.add_lwpolyline(points, dxfattribs={"const_width": 0.6 / metres})
    # A line of changing width is as wide as its widest place: the safe side.
    wide = [(x, 20 / metres, 0.4 / metres, 2.0 / metres) for x, _ in points]
    space.add_lwpolyline(wide, format="xyse")
    space.add_polyline2d(wide, format="xyse")
    # In a block it is as wide as the block is large.
    space.doc.blocks.new("HEDGE").add_lwpolyline(points, dxfattribs={"const_width": 0.5 / metres})
    space.add_blockref("HEDGE", (0, 0), dxfattribs={"xscale": 2.0, "yscale": 2.0, "zscale": 2.0})
    radii = [("LineString", pytest.approx(radius)) for radius in (0.3, 1.0, 1.0, 0.5)]
    assert [(form, radius) for form, _, radius in things(read(space))] == radii


def test_the_wide_outline_of_an_area_is_a_wall_around_it(empty):
    ring(empty, 60, const_width=1.0)
    ring(empty, 2, const_width=1.0, layer="OBSTACLES")
    result = read(empty)
    assert corners(result)[0] == (-60.0, -60.0)
    (*_, around), (area, rings, none), (line, places, radius) = things(result)
    assert (area, line, none, radius, around) == ("Polygon", "LineString", None, 0.5, 0.5)
    assert rings[0] == places


def test_a_text_names_what_it_stands_in_or_beside(space):
    space.add_lwpolyline([(20, 20), (30, 20)], dxfattribs={"layer": "WALL", "const_width": 0.6})
    space.add_text("garden wall", height=2.5, dxfattribs={"insert": (22, 21)})
    space.add_circle((0, 0), 1.0)
    label = space.add_text("old elm", height=0.5)
    label.set_placement((0, 1.5), align=ezdxf.enums.TextEntityAlignment.MIDDLE_CENTER)
    space.add_mtext("bed\nof roses", dxfattribs={"insert": (-30, 30), "char_height": 1.0})
    space.add_lwpolyline([(-32, 25), (-25, 25), (-25, 29), (-32, 29)], close=True)
    assert names(read(space)) == ["square", "garden wall", "old elm", "bed of roses"]


def test_an_attribute_of_a_block_names_what_is_beside_it(space):
    block = space.doc.blocks.new("TREE")
    block.add_circle((0, 0), 0.4)
    block.add_attdef("NAME", (0.5, 0), height=0.3)
    space.add_blockref("TREE", (7, 7)).add_auto_attribs({"NAME": "camphor"})
    assert names(read(space))[1:] == ["camphor"]


def test_a_circle_on_the_layer_of_the_square_is_a_round_square(empty):
    empty.add_circle((5, 0), 30.0, dxfattribs={"layer": "SQUARE"})
    away = np.hypot(*(np.array(corners(read(empty))) - (5.0, 0.0)).T)
    assert away == pytest.approx(30.0)
    assert len(away) > 100


def test_lines_and_arcs_of_the_path_are_one_path():
    space = new()
    on_path = {"layer": "PATH"}
    for ends in ([(0, 0), (10, 0)], [(10, 10), (0, 10)], [(30, 30), (40, 40)]):
        space.add_line(*ends, dxfattribs=on_path)
    space.add_arc((10, 5), 5.0, -90, 90, dxfattribs=on_path)
    result = read(space)
    points = np.array(result.path["points"])
    assert sorted(points[[0, -1]].tolist()) == [[0.0, 0.0], [0.0, 10.0]]
    assert np.abs(points[:, 0] - 15.0).min() < 0.1
    assert things(result) == []
    assert "2 lines are called path; the first is the path, and the others are left out." in result.notes


def test_the_line_of_a_square_that_is_not_closed_is_closed_and_said(empty):
    ring(empty, 60, close=False, layer="SQUARE")
    empty.add_circle((5, 5), 1.0)
    result = read(empty)
    assert len(corners(result)) == 5
    assert any("does not end where it begins" in note for note in result.notes)


# -- survey grids ------------------------------------------------------------------------------------------------


def on_grid(x, y):
    space = new(square=False)
    ring(space, 50, x, y, layer="SQUARE")
    space.add_circle((x + 5, y + 5), 1.0, dxfattribs={"layer": "TREES"})
    space.add_lwpolyline([(x - 40, y), (x + 40, y - 9)], dxfattribs={"layer": "PATH"})
    return drawing(space)


@pytest.mark.parametrize("x, y", [(500_000.0, 3_220_000.0), (39_500_000.0, 3_220_000.0), (-200_000.0, 1_000.0)])
def test_a_survey_grid_is_moved_to_its_middle_and_kept(client, x, y):
    got = posted(client, on_grid(x, y))
    assert got["venue"]["grid"] == {"x": x, "y": y}
    assert got["venue"]["features"][1]["geometry"]["coordinates"] == [5.0, 5.0]
    assert got["path"]["points"] == [[-40.0, 0.0], [40.0, -9.0]]
    assert f"The coordinates are those of a survey grid; x = y = 0 is its x {x:.10g} m, y {y:.10g} m." in got["notes"]
    # What goes out is on the grid again, and comes in as it was.
    place = {"path": got["path"], "venue": got["venue"]}
    assert client.post("/check", json={"dragon": {"benches": 2}, **place}).status_code == 200
    drawn, features = (map_of(client, form, **place) for form in ("dxf", "geojson"))
    [circle] = ezdxf.read(io.StringIO(drawn.text)).modelspace().query("CIRCLE[layer=='OBSTACLES']")
    assert [*circle.dxf.center][:2] == [x + 5, y + 5] == features.json()["features"][1]["geometry"]["coordinates"]
    for out in (drawn, features):
        again = posted(client, out.content)
        assert got["path"].items() <= again["path"].items()
        assert again["venue"]["grid"] == got["venue"]["grid"]
        before, after = ([one["geometry"] for one in answer["venue"]["features"]] for answer in (got, again))
        assert before == after


@pytest.mark.parametrize("row", ['{"x": 1.0} -> ', '{"x": 1.0, "y": 1e9} -> /y 1e+08', '"here" -> '])
def test_a_venue_says_its_grid_in_two_numbers(client, row):
    grid, named = row.split(" -> ")
    square = '"type": "Polygon", "coordinates": [[[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]]]'
    change = f'{{"venue": {{{square}, "grid": {grid}}}}}'
    assert_refused(client, "/check", {"dragon": {"benches": 2}}, f"{change} -> /venue/grid{named}")


def rounded(corner_count, place=0.0):
    angles = np.linspace(0.0, 2 * np.pi, corner_count, endpoint=False)
    return (20.0 * in_plane(np.exp(1j * angles)) + place).tolist()


@pytest.mark.parametrize("square", [True, False])
def test_many_edges_are_refused_before_they_are_compared(square):
    space = new(square=square)
    for place in (0.0, 200.0):
        space.add_lwpolyline(rounded(16_000, place), close=True)
    begun = time.process_time()
    with pytest.raises(InvalidValue, match=f"5000 edges, got {32_000 + 4 * square}: .*, or draw it with fewer points"):
        read(space)
    assert time.process_time() - begun < 10.0  # It took 20 s.


def test_a_long_path_beside_the_square_is_compared(empty):
    empty.add_lwpolyline(rounded(1_900), close=True)
    line = [(300.0 + 0.001 * k, 300.0) for k in range(15_000)]
    empty.add_lwpolyline(line, dxfattribs={"layer": "PATH"})
    result = read(empty)
    assert result.path is not None
    assert any("No polygon is the square" in note for note in result.notes)


def test_names_of_a_chinese_drawing_are_read():
    space = new(version="R2000")
    space.doc.encoding = "gbk"
    space.doc.layers.add("障碍")
    space.add_circle((3, 4), 1.0, dxfattribs={"layer": "障碍"})
    space.add_text("樟树", height=0.5, dxfattribs={"insert": (3, 4)})
    assert names(read(space))[1:] == ["樟树"]


def test_more_texts_than_can_be_compared_name_nothing_and_are_said(space):
    for k in range(3_000):
        space.add_text("x", height=0.1, dxfattribs={"insert": (0, 0.01 * k)})
    space.add_lwpolyline([(300.0 + 0.1 * k, 300.0) for k in range(1_500)], dxfattribs={"layer": "PATH"})
    result = read(space)
    assert "Left out: 3000 texts." in result.notes
    assert names(result) == ["square"]
