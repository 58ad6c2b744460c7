"""A drawing as architects have it: trees, and a building whose rooms have walls, chairs and hatches; and a map."""

import io
import json

import ezdxf
import numpy as np

from tests.support.asking import box

# Layers and the edges of each in a venue, where a line and a tree have those of outlines; that of the walls, and the
# square of the site [m].
WALLS = "墙, walls"
TREES = 6
EDGES = {"A-HATCH": 34 * 1200, "A-FURN": 34 * 180 + 4 * 180, WALLS: 480, "TREES": 8 * TREES, "SITE": 4}
SITE = [[0.0, 0.0], [80.0, 0.0], [80.0, 50.0], [0.0, 50.0]]


def floor_plan():
    """The drawing as DXF, in millimetres."""
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = 4
    space = document.modelspace()

    def outline(layer, x, y, width, height):
        points = 1000 * np.array(box(x, y, x + width, y + height)["coordinates"][0][:-1])
        space.add_lwpolyline(points, close=True, dxfattribs={"layer": layer})

    chair = document.blocks.new("CHAIR")
    chair.add_lwpolyline([(0, 0), (450, 0), (450, 450), (0, 450)], close=True)
    chair.add_line((0, 400), (450, 400))
    outline("SITE", 0, 0, 80, 50)
    for k in range(TREES):
        space.add_circle((1000 * (10 + 10 * k), 8000), 400, dxfattribs={"layer": "TREES"})
    for x, y in ((2 + 1.9 * i, 36 + 2 * j) for i in range(10) for j in range(6)):
        for inside in (0, 0.1):
            outline(WALLS, x + inside, y + inside, 1.9 - 2 * inside, 2 - 2 * inside)
        for k in range(3):
            space.add_blockref("CHAIR", (1000 * (x + 0.3 + 0.5 * k), 1000 * (y + 0.4)), dxfattribs={"layer": "A-FURN"})
        for k in range(20):
            begin = (1000 * (x + 0.09 * k), 1000 * y)
            space.add_line(begin, (begin[0] + 50, begin[1] + 100), dxfattribs={"layer": "A-HATCH"})
        space.add_text("room", dxfattribs={"layer": "A-TEXT", "height": 200}).set_placement((1000 * x, 1000 * y))
    text = io.StringIO()
    document.write(text)
    return text.getvalue().encode()


def area(layer, x, y, width, height):
    return {"type": "Feature", "properties": layer, "geometry": box(x, y, x + width, y + height)}


def thing(properties, kind, *places):
    coordinates = places[0] if kind == "Point" else places
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def town(scale=(1.0, 1.0), middle=(0.0, 0.0)):
    """A map as GeoJSON of a square with trees beside 1300 houses and 20 kerbs, around (0, 0)."""
    features = [
        area({"Layer": "SITE", "name": "square"}, -40, -25, 80, 50),
        *(thing({"role": "tree", "radius": 0.4}, "Point", (-30 + 10 * k, -17)) for k in range(TREES)),
        *(area({"layer": WALLS}, -38 + k % 30 * 2, 11 + k // 30 * 0.5, 1, 0.3) for k in range(1300)),
        *(thing({"name": "kerb"}, "LineString", (k, 5), (k + 1, 5), (k + 1, 6)) for k in range(20)),
    ]
    for one in features:
        places = one["geometry"]["coordinates"]
        one["geometry"]["coordinates"] = (np.array(places) * scale + middle).tolist()
    return json.dumps({"type": "FeatureCollection", "features": features}).encode()
