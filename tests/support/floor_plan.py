"""A drawing as an architect has it: a site with trees, and a building whose rooms have walls, chairs and hatches."""

import io

import ezdxf

# Layers and the edges that are drawn on each, that of the walls, and the square of the site [m].
WALLS = "墙, walls"
EDGES = {"A-HATCH": 1200, "A-FURN": 900, WALLS: 480, "TREES": 6, "SITE": 4}
SITE = [[0.0, 0.0], [80.0, 0.0], [80.0, 50.0], [0.0, 50.0]]


def floor_plan():
    """The drawing as DXF, in millimetres."""
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = 4
    space = document.modelspace()

    def outline(layer, x, y, width, height):
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        points = [(1000 * a, 1000 * b) for a, b in corners]
        space.add_lwpolyline(points, close=True, dxfattribs={"layer": layer})

    chair = document.blocks.new("CHAIR")
    chair.add_lwpolyline([(0, 0), (450, 0), (450, 450), (0, 450)], close=True)
    chair.add_line((0, 400), (450, 400))
    outline("SITE", 0, 0, 80, 50)
    for k in range(6):
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
