"""A drawing of more than a venue may have is read in part: some of its layers, or an area of it."""

import pytest

from app.maps.choice import Choice, listed
from app.maps.places import drawn_layers, places_of
from core import InvalidValue
from tests.app.maps.test_entities import drawing, new
from tests.support.command import run
from tests.support.floor_plan import EDGES, SITE, TREES, WALLS, floor_plan, town

HEADERS = {"Content-Type": "image/vnd.dxf"}


MAP = town()
# The same in degrees of longitude and latitude.
IN_DEGREES = town((1 / 74_630, 1 / 111_250), (9.0, 48.0))


@pytest.mark.parametrize("data", [MAP, IN_DEGREES], ids=["metres", "degrees"])
def test_a_map_of_more_than_a_venue_may_have_is_read_by_layers_or_an_area(data):
    """The layer of a thing is its property, or else its role, its name or its shape."""
    layers = {one.name: one.edges for one in drawn_layers(data)}
    assert list(layers) == [WALLS, "kerb", "obstacle", "SITE"]
    assert (layers[WALLS], layers["obstacle"], layers["SITE"]) == (4 * 1300, 8 * TREES, 4)
    with pytest.raises(InvalidValue, match=f"got {sum(layers.values())}: read only some layers") as refusal:
        places_of(data, None)
    assert refusal.value.field == "file"
    for choice in (
        Choice.of("site,OBSTACLE", None),
        Choice.of(None, "-45,-30,45,0"),
        Choice.of("obstacle", "-45,-30,45,0"),
    ):
        result = places_of(data, None, choice=choice)
        assert sum(one.shape == "point" for one in result.things) == TREES
        assert any("were read" in note or "was read" in note for note in result.notes)


@pytest.fixture(scope="module")
def plan():
    return floor_plan()


def places(client, plan, **query):
    return client.post("/places", params=query, content=plan, headers=HEADERS)


def test_the_layers_of_a_drawing_that_is_refused_are_listed_with_their_edges(client, plan):
    """They are counted as the limit counts them."""
    problem = places(client, plan).json()
    assert problem["status"] == 422
    assert problem["errors"][0]["name"] == "file"
    layers = places(client, plan, only_layers=True).raise_for_status().json()["layers"]
    assert {one["name"]: one["edges"] for one in layers} == EDGES
    assert f"got {sum(EDGES.values())}" in problem["detail"]


def test_a_layer_has_as_many_edges_in_the_list_as_when_it_is_read(client):
    space = new(unit=4, square=False)  # millimetres
    points = [(0, 0, 0, 0, 1), (60_000, 0, 0, 0, 1)]  # two half circles
    space.add_lwpolyline(points, close=True, dxfattribs={"layer": "SQUARE"})
    (layer,) = places(client, drawing(space), only_layers=True).json()["layers"]
    (square,) = places(client, drawing(space)).json()["venue"]["features"]
    assert layer == {"name": "SQUARE", "edges": len(square["geometry"]["coordinates"][0]) - 1}


@pytest.mark.parametrize("query", [{"layers": "site, TREES"}, {"area": "-5,-5,85,30"}], ids=str)
def test_the_chosen_part_is_read(client, plan, query):
    square, *trees = places(client, plan, **query).raise_for_status().json()["venue"]["features"]
    assert square["geometry"]["coordinates"][0][:-1] == SITE
    assert [one["geometry"]["type"] for one in trees] == ["Point"] * TREES


@pytest.mark.parametrize(
    "query, name",
    [({"layers": "SITE,LAWN"}, "layers"), ({"area": "0,0,9"}, "area"), ({"area": "9,0,0,9"}, "area")],
    ids=str,
)
def test_what_is_no_layer_and_no_area_is_refused(client, plan, query, name):
    answer = places(client, plan, **query)
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["name"] == name
    for other in (MAP, b"[dragon]\nbenches = 4\n"):
        assert places(client, other, **query).json()["errors"][0]["name"] == name


@pytest.mark.parametrize("form", ["DXF", "metres", "degrees"])
def test_an_area_that_holds_nothing_is_refused_as_an_area(plan, form):
    data = {"DXF": plan, "metres": MAP, "degrees": IN_DEGREES}[form]
    with pytest.raises(InvalidValue, match="something reaches") as refusal:
        places_of(data, None, choice=Choice.of(None, "500,500,600,600"))
    assert refusal.value.field == "area"


def test_the_command_reads_the_same_part_and_names_its_options(plan, tmp_path):
    file = tmp_path / "plan.dxf"
    file.write_bytes(plan)
    assert run("places", str(file), "--layers", "SITE,TREES").stdout.count("obstacle") >= TREES
    assert "A-HATCH" in run("places", str(file), "--only-layers").stdout
    assert "with --layers, or an area of it with --area" in run("places", str(file)).stderr


def test_a_layer_with_a_comma_in_its_name_is_chosen_in_quotation_marks(client, plan):
    for layers in (f'"{WALLS}",SITE', f'site , "{WALLS}"', listed([WALLS, "SITE"])):
        notes = places(client, plan, layers=layers).raise_for_status().json()["notes"]
        assert any(f'"{WALLS}"' in note for note in notes)
    assert f'"{WALLS}"' in places(client, plan, layers=WALLS).json()["detail"]
    assert places(client, plan, layers=f'"{WALLS}').json()["errors"][0]["name"] == "layers"
