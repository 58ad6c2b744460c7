"""Drawings of other programs: nothing in them is lost, and nothing is invented."""

from __future__ import annotations

import io
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import httpx
import numpy as np
import pytest

from app.files.tables import Language
from app.files.words import Say
from app.maps.layout import DanceParts
from app.maps.places import places_of
from core import InvalidValue
from tests.support.command import run

Draw = Callable[[Any], object]


def drawing(draw: Draw, unit: int = 6, version: str = "R2010", square: bool = True) -> bytes:
    """A drawing of a square of 100 m around (0, 0), and what `draw` adds."""
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = unit
    if square:
        corners = [(-50, -50), (50, -50), (50, 50), (-50, 50)]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"layer": "SQUARE"})
    draw(document)
    sink = io.StringIO()
    document.write(sink)
    return sink.getvalue().encode()


def read(draw: Draw, unit: int = 6, version: str = "R2010", square: bool = True) -> DanceParts:
    return places_of(drawing(draw, unit, version, square), None, Say(Language.ENGLISH))


def things(result: DanceParts) -> list[tuple[str, str, Any, float | None]]:
    """Name, form, coordinates and radius of the obstacles."""
    assert result.geometry is not None
    values = [(one["properties"], one["geometry"]) for one in result.geometry["features"][1:]]
    return [(own["name"], form["type"], form["coordinates"], own.get("radius")) for own, form in values]


def tree(document: Any) -> Any:
    block = document.blocks.new("TREE")
    block.add_circle((0, 0), 0.4)
    return document.modelspace()


def test_an_array_of_blocks_has_all_of_them() -> None:
    def draw(document: Any) -> None:
        array = {"row_count": 2, "column_count": 3, "row_spacing": 4.0, "column_spacing": 5.0}
        tree(document).add_blockref("TREE", (0, 0), dxfattribs=array)

    result = things(read(draw))
    assert [(form, radius) for _, form, _, radius in result] == [("Point", 0.4)] * 6
    assert sorted(place for _, _, place, _ in result) == [[x, y] for x in (0.0, 5.0, 10.0) for y in (0.0, 4.0)]


def test_the_service_finds_every_tree_of_an_array(client: httpx.Client) -> None:
    def draw(document: Any) -> None:
        array = {"row_count": 2, "column_count": 3, "row_spacing": 4.0, "column_spacing": 5.0}
        tree(document).add_blockref("TREE", (0, 0), dxfattribs=array)

    headers = {"Content-Type": "image/vnd.dxf"}
    answer = client.post("/places", content=drawing(draw), headers=headers).raise_for_status().json()
    assert len(answer["venue"]["features"]) == 7


@pytest.mark.parametrize("place", [(3.0, 4.0), (119.64, 29.11)])
def test_a_drawing_without_a_unit_is_in_metres_however_small_it_is(place: tuple[float, float]) -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_circle(place, 1.5)
        document.modelspace().add_circle((place[0] + 0.1, place[1] + 0.05), 0.2)

    result = read(draw, unit=0, square=False)
    (_, _, first, wide), (_, _, second, narrow) = things(result)
    assert first == pytest.approx(place)
    assert np.hypot(*(np.array(second) - first)) == pytest.approx(0.1118, abs=1e-4)
    assert (wide, narrow) == (1.5, 0.2)
    assert "The file states no unit: its numbers are metres." in result.notes


@pytest.mark.parametrize(("unit", "metres"), [(2, 0.3048), (21, 1200 / 3937), (15, 10.0), (8, 2.54e-8)])
def test_every_unit_of_a_drawing_is_known(unit: int, metres: float) -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_circle((30 / metres, 0), 2 / metres)

    [(_, _, place, radius)] = things(read(draw, unit=unit, square=False))
    assert (place[0], radius) == (pytest.approx(30.0), pytest.approx(2.0))


def test_what_cannot_be_seen_is_left_out_and_said() -> None:
    def draw(document: Any) -> None:
        document.layers.add("TREES").off()
        document.layers.add("OLD").freeze()
        document.blocks.new("TREE").add_circle((0, 0), 1.0)
        space = document.modelspace()
        space.add_circle((10, 5), 1.0, dxfattribs={"layer": "TREES"})
        space.add_circle((20, 5), 1.0, dxfattribs={"layer": "OLD"})
        space.add_circle((30, 5), 1.0, dxfattribs={"invisible": 1})
        space.add_blockref("TREE", (40, 5), dxfattribs={"layer": "OLD"})
        space.add_blockref("TREE", (40, 9), dxfattribs={"layer": "TREES"})
        space.add_circle((0, 30), 1.0)

    result = read(draw)
    assert [place for _, _, place, _ in things(result)] == [[0.0, 30.0]]
    assert "Left out, because hidden: 4 CIRCLEs." in result.notes
    assert "Left out, because hidden: 1 INSERT." in result.notes


def test_entities_of_a_block_take_its_layer() -> None:
    def draw(document: Any) -> None:
        document.blocks.new("BED").add_lwpolyline([(0, 0), (2, 0), (2, 2), (0, 2)], close=True)
        document.modelspace().add_blockref("BED", (5, 5), dxfattribs={"layer": "障碍"})
        document.modelspace().add_lwpolyline([(-60, -60), (60, -60), (60, 60), (-60, 60)], close=True)

    result = read(draw, square=False)
    assert result.venue is not None
    assert result.venue.square.rings[0][0] == (-60.0, -60.0)
    assert [form for _, form, _, _ in things(result)] == ["Polygon"]


def test_meshes_are_left_out_and_the_rest_is_read() -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_polymesh((2, 2))
        document.modelspace().add_polyface()
        document.modelspace().add_circle((10, 5), 1.0)

    result = read(draw)
    assert [place for _, _, place, _ in things(result)] == [[10.0, 5.0]]
    assert {"Left out: 1 POLYMESH.", "Left out: 1 POLYFACE."} <= set(result.notes)


def test_only_a_ring_in_an_area_of_its_layer_is_a_hole() -> None:
    def ring(x: float, half: float) -> list[tuple[float, float]]:
        return [(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)]

    def draw(document: Any) -> None:
        space = document.modelspace()
        space.add_lwpolyline(ring(0, 5), close=True, dxfattribs={"layer": "HOUSE"})
        for x in (0, 30):
            space.add_lwpolyline(ring(x, 2), close=True, dxfattribs={"layer": "HOUSE_HOLES"})
        space.add_circle((0, 30), 0.4, dxfattribs={"layer": "PLANT_HOLES"})
        space.add_circle((0, 0), 0.3, dxfattribs={"layer": "HOUSE_HOLES"})

    house, lone, plant, inner = things(read(draw))
    assert [len(house[2]), len(lone[2])] == [2, 1]
    assert (plant[2], plant[3]) == ([0.0, 30.0], 0.4)
    assert (inner[2], inner[3]) == ([0.0, 0.0], 0.3)


def test_a_closed_spline_is_the_area_in_it() -> None:
    def draw(document: Any) -> None:
        corners = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0), (10, 0), (10, 10)]
        entity = document.modelspace().add_spline(degree=3, dxfattribs={"layer": "OBSTACLES", "flags": 3})
        entity.control_points, entity.knots = [(*one, 0) for one in corners], range(11)

    [(_, form, rings, _)] = things(read(draw))
    assert form == "Polygon"
    assert np.min(rings) == pytest.approx(0.417, abs=0.005)
    assert np.max(rings) == pytest.approx(9.583, abs=0.005)


def test_a_spline_that_is_damaged_is_left_out_and_said() -> None:
    def draw(document: Any) -> None:
        entity = document.modelspace().add_spline(degree=3)
        entity.control_points, entity.knots = [(0, 0, 0), (1, 2, 0), (3, 4, 0), (9, 9, 0)], [0, 0, 0, 0, 1, 1, 1, 0.5]
        document.modelspace().add_circle((10, 5), 1.0)

    result = read(draw)
    assert len(things(result)) == 1
    assert "Left out: 1 damaged SPLINE." in result.notes


@pytest.mark.parametrize(("version", "unit"), [("R12", 6), ("R2010", 6), ("R2010", 4)])
def test_a_wide_line_is_a_wall_of_its_width(version: str, unit: int) -> None:
    metres = {6: 1.0, 4: 0.001}[unit]

    def draw(document: Any) -> None:
        points, space = [(-10 / metres, 0), (10 / metres, 0)], document.modelspace()
        if version == "R12":
            space.add_polyline2d([(*point, 2 / metres, 2 / metres) for point in points], format="xyse")
            return
        line = space.add_lwpolyline(points, dxfattribs={"const_width": 0.6 / metres})
        assert line.dxf.const_width == pytest.approx(0.6 / metres)
        space.add_lwpolyline([(x, 20 / metres, 0.4 / metres, 2.0 / metres) for x, _ in points], format="xyse")

    result = things(read(draw, unit=unit, version=version, square=False))
    assert {form for _, form, _, _ in result} == {"LineString"}
    # A line of changing width is as wide as its widest place: the safe side.
    assert [radius for *_, radius in result] == pytest.approx([1.0] if version == "R12" else [0.3, 1.0])


def test_a_wide_line_in_a_block_is_as_wide_as_the_block_is_large() -> None:
    def draw(document: Any) -> None:
        document.blocks.new("HEDGE").add_lwpolyline([(0, 0), (5, 0)], dxfattribs={"const_width": 0.5})
        document.modelspace().add_blockref("HEDGE", (0, 0), dxfattribs={"xscale": 2.0, "yscale": 2.0, "zscale": 2.0})

    [(_, form, places, radius)] = things(read(draw))
    assert (form, places, radius) == ("LineString", [[0.0, 0.0], [10.0, 0.0]], 0.5)


def test_the_outline_of_an_area_reaches_to_both_sides() -> None:
    def draw(document: Any) -> None:
        bed = [(0, 0), (4, 0), (4, 4), (0, 4)]
        document.modelspace().add_lwpolyline(bed, close=True, dxfattribs={"const_width": 1.0, "layer": "OBSTACLES"})

    (_, area, rings, none), (_, line, places, radius) = things(read(draw))
    assert (area, line, none, radius) == ("Polygon", "LineString", None, 0.5)
    assert rings[0] == places


def test_a_wide_outline_of_the_square_leaves_the_square() -> None:
    def draw(document: Any) -> None:
        corners = [(-60, -60), (60, -60), (60, 60), (-60, 60)]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"const_width": 1.0})

    result = read(draw, square=False)
    assert result.venue is not None
    assert result.venue.square.rings[0][0] == (-60.0, -60.0)
    assert [(form, radius) for _, form, _, radius in things(result)] == [("LineString", 0.5)]


def test_a_text_beside_a_wall_names_the_wall() -> None:
    def draw(document: Any) -> None:
        space = document.modelspace()
        space.add_lwpolyline([(20, 20), (30, 20)], dxfattribs={"layer": "WALL", "const_width": 0.6})
        space.add_text("garden wall", height=2.5, dxfattribs={"insert": (22, 21)})
        space.add_text("Temple square", height=2.5, dxfattribs={"insert": (-20, -20)})
        space.add_circle((0, 0), 1.0)
        label = space.add_text("old elm", height=0.5)
        label.set_placement((0, 1.5), align=ezdxf.enums.TextEntityAlignment.MIDDLE_CENTER)
        space.add_mtext("bed\nof roses", dxfattribs={"insert": (-30, 30), "char_height": 1.0})
        space.add_lwpolyline([(-32, 25), (-25, 25), (-25, 29), (-32, 29)], close=True)

    result = read(draw)
    assert result.venue is not None
    assert [area.name for area in result.venue.areas] == ["Temple square", "garden wall", "old elm", "bed of roses"]


def test_an_attribute_of_a_block_names_what_is_beside_it() -> None:
    def draw(document: Any) -> None:
        block = document.blocks.new("TREE")
        block.add_circle((0, 0), 0.4)
        block.add_attdef("NAME", (0.5, 0), height=0.3)
        document.modelspace().add_blockref("TREE", (7, 7)).add_auto_attribs({"NAME": "camphor"})

    result = read(draw)
    assert [name for name, *_ in things(result)] == ["camphor"]


def test_a_circle_on_the_layer_of_the_square_is_a_round_square() -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_circle((5, 0), 30.0, dxfattribs={"layer": "SQUARE"})
        document.modelspace().add_circle((5, 5), 1.0, dxfattribs={"layer": "TREES"})

    result = read(draw, square=False)
    assert result.venue is not None
    away = np.hypot(*(np.array(result.venue.square.rings[0]) - (5.0, 0.0)).T)
    assert away == pytest.approx(30.0)
    assert len(away) > 100
    assert len(things(result)) == 1


def test_four_lines_that_close_are_the_square() -> None:
    corners = [(-60, -60), (60, -60), (60, 60), (-60, 60)]

    def draw(document: Any) -> None:
        for k in (0, 2, 1, 3):
            document.modelspace().add_line(corners[k], corners[(k + 1) % 4], dxfattribs={"layer": "SQUARE"})
        document.modelspace().add_circle((5, 5), 1.0)

    result = read(draw, square=False)
    assert result.venue is not None
    assert set(result.venue.square.rings[0]) == set(corners)
    assert len(things(result)) == 1


def test_lines_and_arcs_of_the_path_are_one_path() -> None:
    def draw(document: Any) -> None:
        on_path = {"layer": "PATH"}
        document.modelspace().add_line((0, 0), (10, 0), dxfattribs=on_path)
        document.modelspace().add_arc((10, 5), 5.0, -90, 90, dxfattribs=on_path)
        document.modelspace().add_line((10, 10), (0, 10), dxfattribs=on_path)
        document.modelspace().add_line((30, 30), (40, 40), dxfattribs=on_path)

    result = read(draw)
    assert result.path is not None
    points = np.array(result.path["points"])
    assert {tuple(points[0]), tuple(points[-1])} == {(0.0, 0.0), (0.0, 10.0)}
    assert np.abs(points[:, 0] - 15.0).min() < 0.1
    assert things(result) == []
    assert "2 lines are called path; the first is the path, and the others are left out." in result.notes


def test_the_line_of_a_square_that_is_not_closed_is_closed_and_said() -> None:
    def draw(document: Any) -> None:
        corners = [(-60, -60), (60, -60), (60, 60), (-60, 60)]
        document.modelspace().add_lwpolyline(corners, dxfattribs={"layer": "SQUARE"})
        document.modelspace().add_circle((5, 5), 1.0)

    result = read(draw, square=False)
    assert result.venue is not None
    assert len(result.venue.square.rings[0]) == 5
    assert any("does not end where it begins" in note for note in result.notes)


def test_a_large_arc_is_as_round_as_it_is() -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_arc((0, 0), 40.0, 0, 90, dxfattribs={"layer": "WALL"})

    [(_, _, places, _)] = things(read(draw))
    assert np.abs(np.hypot(*np.array(places).T) - 40.0).max() < 1e-9
    assert np.hypot(*np.diff(places, axis=0).T).max() < 2.0 * (2 * 40 * 0.005) ** 0.5


# -- survey grids ------------------------------------------------------------------------------------------------


def on_grid(x: float, y: float) -> Draw:
    def draw(document: Any) -> None:
        corners = [(x - 50, y - 50), (x + 50, y - 50), (x + 50, y + 50), (x - 50, y + 50)]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"layer": "SQUARE"})
        document.modelspace().add_circle((x + 5, y + 5), 1.0, dxfattribs={"layer": "TREES"})
        document.modelspace().add_lwpolyline([(x - 40, y), (x + 40, y - 9)], dxfattribs={"layer": "PATH"})

    return draw


@pytest.mark.parametrize("place", [(500_000.0, 3_220_000.0), (39_500_000.0, 3_220_000.0), (-200_000.0, 1_000.0)])
def test_a_survey_grid_is_moved_to_its_middle_and_kept(client: httpx.Client, place: tuple[float, float]) -> None:
    x, y = place
    headers = {"Content-Type": "image/vnd.dxf"}
    data = drawing(on_grid(x, y), square=False)
    got = client.post("/places", content=data, headers=headers).raise_for_status().json()
    assert got["venue"]["grid"] == {"x": x, "y": y}
    assert got["venue"]["features"][1]["geometry"]["coordinates"] == [5.0, 5.0]
    assert got["path"]["points"] == [[-40.0, 0.0], [40.0, -9.0]]
    assert f"The coordinates are those of a survey grid; x = y = 0 is its x {x:.10g} m, y {y:.10g} m." in got["notes"]
    # What goes out is on the grid again, and comes in as it was.
    body = {"dragon": {"benches": 2}, "path": got["path"], "venue": got["venue"]}
    assert client.post("/check", json=body).status_code == 200
    for form in ("dxf", "geojson"):
        out = client.post(f"/maps.{form}", json=body).raise_for_status().content
        if form == "dxf":
            [circle] = ezdxf.read(io.StringIO(out.decode())).modelspace().query("CIRCLE[layer=='OBSTACLES']")
            assert tuple(circle.dxf.center)[:2] == (x + 5, y + 5)
        else:
            assert json.loads(out)["features"][1]["geometry"]["coordinates"] == [x + 5, y + 5]
        headers = {"Content-Type": "application/octet-stream"}
        again = client.post("/places", content=out, headers=headers).raise_for_status().json()
        assert again["venue"]["grid"] == got["venue"]["grid"]
        assert {name: again["path"][name] for name in got["path"]} == got["path"]
        came = [one["geometry"]["coordinates"] for one in again["venue"]["features"]]
        assert came == [one["geometry"]["coordinates"] for one in got["venue"]["features"]]


def test_the_command_keeps_a_survey_grid(tmp_path: Path) -> None:
    (tmp_path / "grid.dxf").write_bytes(drawing(on_grid(500_000.0, 3_220_000.0), square=False))
    done = run("places", str(tmp_path / "grid.dxf"), "--output", str(tmp_path / "dance.json"))
    assert "The coordinates are those of a survey grid; x = y = 0 is its x 500000 m, y 3220000 m." in done.stderr
    answer = json.loads((tmp_path / "dance.json").read_text())
    (tmp_path / "dance.json").write_text(json.dumps(answer | {"dragon": {"benches": 2}}))
    assert run("check", str(tmp_path / "dance.json")).returncode == 0
    assert run("maps", str(tmp_path / "dance.json"), "--output", str(tmp_path / "again.dxf")).returncode == 0
    [circle] = ezdxf.readfile(tmp_path / "again.dxf").modelspace().query("CIRCLE[layer=='OBSTACLES']")
    assert tuple(circle.dxf.center)[:2] == (500_005.0, 3_220_005.0)


def test_a_venue_says_its_grid_in_two_numbers(client: httpx.Client) -> None:
    square = {"type": "Polygon", "coordinates": [[[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]]]}
    for grid, words in (
        ({"x": 1.0}, "venue.grid must have x and y in metres"),
        ({"x": 1.0, "y": 1e9}, "venue.grid.y must be at most 1e+08 m"),
        ("here", "venue.grid must have x and y in metres"),
    ):
        answer = client.post("/check", json={"dragon": {"benches": 2}, "venue": square | {"grid": grid}})
        assert answer.status_code == 422
        assert words in answer.json()["detail"]


def test_a_map_that_is_too_wide_for_a_dance_is_refused() -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_circle((600_000.0, 3_000_000.0), 1.0)
        document.modelspace().add_circle((500_000.0, 3_000_000.0), 1.0)

    with pytest.raises(InvalidValue, match="file must be at most 20 km across, got about 100 km"):
        read(draw, square=False)


@pytest.mark.parametrize("square", [True, False])
def test_many_edges_are_refused_before_they_are_compared(square: bool) -> None:
    def draw(document: Any) -> None:
        angles = np.linspace(0.0, 2 * np.pi, 16_000, endpoint=False)
        for place in (0.0, 200.0):
            points = 20.0 * np.stack([np.cos(angles), np.sin(angles)], axis=-1) + place
            document.modelspace().add_lwpolyline(points.tolist(), close=True)

    begun = time.process_time()
    with pytest.raises(InvalidValue, match=f"file must have at most 2000 edges, got {32_000 + 4 * square}"):
        read(draw, square=square)
    assert time.process_time() - begun < 10.0  # It took 20 s.


def test_a_long_path_beside_the_square_is_compared() -> None:
    def draw(document: Any) -> None:
        angles = np.linspace(0.0, 2 * np.pi, 1_900, endpoint=False)
        outline = 20.0 * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        document.modelspace().add_lwpolyline(outline.tolist(), close=True)
        line = [(300.0 + 0.001 * k, 300.0) for k in range(15_000)]
        document.modelspace().add_lwpolyline(line, dxfattribs={"layer": "PATH"})

    result = read(draw, square=False)
    assert result.path is not None
    assert any("No polygon is the square" in note for note in result.notes)


def test_blocks_that_are_not_in_the_file_are_left_out_and_said() -> None:
    def draw(document: Any) -> None:
        document.modelspace().add_blockref("LOST", (3, 3))
        document.add_xref_def("other.dwg", "OTHER")
        document.modelspace().add_blockref("OTHER", (5, 5))
        document.modelspace().add_circle((10, 5), 1.0)

    result = read(draw)
    assert len(things(result)) == 1
    assert {"Left out: 1 damaged INSERT.", "Left out: 1 block of another drawing."} <= set(result.notes)


@pytest.mark.parametrize("version", ["R2000", "R2010"])
def test_names_of_a_chinese_drawing_are_read(version: str) -> None:
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = 6
    if version == "R2000":
        document.encoding = "gbk"
    document.layers.add("障碍")
    document.modelspace().add_circle((3, 4), 1.0, dxfattribs={"layer": "障碍"})
    document.modelspace().add_text("樟树", height=0.5, dxfattribs={"insert": (3, 4)})
    sink = io.StringIO()
    document.write(sink)
    result = places_of(sink.getvalue().encode(document.output_encoding), None, Say(Language.ENGLISH))
    assert [name for name, *_ in things(result)] == ["樟树"]


def test_more_texts_than_can_be_compared_name_nothing_and_are_said() -> None:
    def draw(document: Any) -> None:
        for k in range(3_000):
            document.modelspace().add_text("x", height=0.1, dxfattribs={"insert": (0, 0.01 * k)})
        line = [(300.0 + 0.1 * k, 300.0) for k in range(1_500)]
        document.modelspace().add_lwpolyline(line, dxfattribs={"layer": "PATH"})

    result = read(draw)
    assert "Left out: 3000 texts." in result.notes
    assert result.venue is not None
    assert result.venue.square.name == "square"
