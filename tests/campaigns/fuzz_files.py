"""Damaged files: maps, dances and results of every form, one to four steps away from good ones; and small bombs."""

import io
import json
import random
import re
import zipfile
from functools import cache, partial

import ezdxf
import httpx

from tests.campaigns.fuzz import SLOWEST, Tally
from tests.support.asking import box
from tests.support.bombs import GRADES, MAPS, lying, zipped
from tests.support.students import by_xlsxwriter, few

NUMBER = re.compile(rb"-?\d+(?:\.\d+)?")
ODD_NUMBERS = (
    *(b"0", b"-0", b"1e300", b"-1e300", b"nan", b"inf", b"1e-300", b"4294967296", b"-1", b"119.64", b"499950.5"),
    *(b"99999999999999999999", b"", b"1_0", b"0x10", b"1,5", "１２".encode()),
)
ODD_TEXTS = (
    *(b"\0", b"\xff\xfe", b"\xef\xbb\xbf", b"<", b">", b"&amp;", b"]]>", b'"', b"{", b"[", b"}", b"\r", b"\n"),
    *(b"<!DOCTYPE a>", b'<?xml version="1.0" encoding="utf-7"?>', "龙".encode(), "龙".encode("gbk"), b"\xed\xa0\x80"),
)
ENCODINGS = ("utf-16", "utf-16-le", "gb18030", "utf-32", "utf-7", "latin-1")
# Chance that a file is a bomb [1].
BOMBS = 0.01


def _drawing():
    document = ezdxf.new("R2010", units=6)
    document.layers.add("OLD").freeze()
    space = document.modelspace()
    space.add_lwpolyline([(-50, -50), (50, -50), (50, 50), (-50, 50)], close=True, dxfattribs={"layer": "SQUARE"})
    space.add_lwpolyline([(0, 0, 0.5), (9, 9, 0)], format="xyb", dxfattribs={"const_width": 0.4})
    space.add_arc((0, 0), 20.0, 0, 90)
    space.add_ellipse((9, 9), (3, 0), 0.5)
    space.add_spline([(0, 0), (5, 9), (9, 0)])
    document.blocks.new("TREE").add_circle((0, 0), 0.4)
    space.add_blockref("TREE", (3, 3), dxfattribs={"row_count": 2, "column_count": 2, "row_spacing": 4.0})
    space.add_circle((20, 20), 1.0, dxfattribs={"layer": "OLD"})
    space.add_text("elm", height=1.0, dxfattribs={"insert": (3, 4)})
    space.add_mtext("oak", dxfattribs={"insert": (9, 4)})
    space.add_line((0, -40), (30, -40), dxfattribs={"layer": "PATH"})
    sink = io.StringIO()
    document.write(sink)
    return sink.getvalue().encode()


KML = """<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><name>寺</name><Folder><name>Trees</name><Placemark>
<name>elm</name><ExtendedData><Data name="radius"><value>0.8</value></Data></ExtendedData><Point><coordinates>
120.0001,30.0001,5</coordinates></Point></Placemark></Folder><Placemark><visibility>1</visibility><name>square</name>
<Polygon><outerBoundaryIs><LinearRing><coordinates>120,30 120.0004,30 120.0004,30.0003 120,30.0003 120,30
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark><Placemark><name>Route</name><LineString>
<coordinates>120.0001,30.0002 120.0003,30.0002</coordinates></LineString></Placemark></Document></kml>"""
LINES = [[[0, 0], [9, 9]], [[1, 1], [2, 5]]]
THINGS = (
    ({"name": "elm", "radius": 0.5}, {"type": "Point", "coordinates": [3, 4]}),
    ({"role": "path"}, {"type": "MultiLineString", "coordinates": LINES}),
)
FEATURES = [
    box(-50, -50, 50, 50, name="square"),
    *({"type": "Feature", "properties": own, "geometry": form} for own, form in THINGS),
]
GEOJSON = {"type": "FeatureCollection", "grid": {"x": 5e5, "y": 3e6}, "features": FEATURES}
DANCE = {"dragon": {"benches": 4}, "path": {"kind": "spiral", "pitch": 1.5}, "venue": GEOJSON, "margin": 0.1}
TOML = 'margin = 0.1\nvenue = "square.kml"\n[dragon]\nbenches = 4\n[path]\nkind = "spiral"\npitch = 1.5\n'


@cache
def samples():
    """Good files, by their calls."""
    kml = KML.encode()
    result = by_xlsxwriter(few())
    csv = "\n".join(f"head x (m),{k},{k}.5,8.800000" for k in range(300)).encode()
    maps = [kml, zipped({"a.png": b"", "doc.kml": kml}, zipfile.ZIP_DEFLATED), _drawing(), TOML.encode()]
    maps += [json.dumps(one).encode() for one in (GEOJSON, DANCE)]
    return [("places", one) for one in maps] + [("grade", one) for one in (result, csv)]


@cache
def small_bombs():
    calls = {"places": MAPS, "grade": GRADES}.items()
    return [(call, made()) for call, some in calls for made in some.values() if len(made()) < 100_000]


def damaged(data, chance):
    """The file with one thing in it changed."""
    steps = [_cut, _flipped, _inserted, _twice, _number, _number, _text]
    if data.startswith(b"PK"):
        steps += [_repacked] * 4
    return chance.choice(steps)(data, chance)


def _at(data, chance):
    return chance.randrange(len(data) + 1)


def _cut(data, chance):
    at = _at(data, chance)
    return data[:at] + (b"" if chance.random() < 0.3 else data[at + chance.randrange(200) :])


def _flipped(data, chance):
    changed = bytearray(data)
    for _ in range(chance.choice((1, 3, 20)) if data else 0):
        changed[chance.randrange(len(data))] = chance.randrange(256)
    return bytes(changed)


def _inserted(data, chance):
    at = _at(data, chance)
    return data[:at] + chance.choice(ODD_TEXTS) * chance.choice((1, 1, 2, 300)) + data[at:]


def _twice(data, chance):
    a, b = sorted((_at(data, chance), _at(data, chance)))
    return data[:b] + data[a:b] * chance.choice((1, 3)) + data[b:] if len(data) < 200_000 else data[a:b]


def _number(data, chance):
    result = list(NUMBER.finditer(data))
    if not result:
        return data
    one = chance.choice(result)
    return data[: one.start()] + chance.choice(ODD_NUMBERS) + data[one.end() :]


def _text(data, chance):
    return data.decode("utf-8", "replace").encode(chance.choice(ENCODINGS), "replace")


def _repacked(data, chance):
    """The archive with one part damaged, left out, with another length in its records, or packed by another method."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = {name: archive.read(name) for name in archive.namelist()}
        name = chance.choice(list(parts))
    except Exception:
        return _flipped(data, chance)
    if chance.random() < 0.25:
        return lying(data, name, chance.choice((0, len(parts[name]) // 2, len(parts[name]) + 9, 2**31)), parts[name])
    parts[name] = damaged(parts[name], chance) if chance.random() < 0.8 else b""
    methods = (zipfile.ZIP_DEFLATED, zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA)
    return zipped(parts, chance.choice(methods))


def file_of(chance):
    """A damaged file, or a small bomb."""
    if chance.random() < BOMBS:
        return chance.choice(small_bombs())
    call, data = chance.choice(samples())
    for _ in range(chance.randrange(1, 5)):
        data = damaged(data, chance)
    return call, data[:3_000_000]


def ask_files(url, count, seed=0, kept=None):
    """Send a number of them. kept: folder that gets a file at which the service fails"""
    chance = random.Random(seed)
    tally = Tally()
    headers = {"Content-Type": "application/octet-stream"}
    with httpx.Client(base_url=url, timeout=4.0 * SLOWEST) as client:
        for number in range(count):
            call, data = file_of(chance)
            try:
                ask = partial(client.post, f"/{call}", content=data, headers=headers)
                tally.add(ask, f"{call} {number}: {data[:150]!r}")
            except AssertionError:
                if kept is not None:
                    (kept / f"{call}-{seed}-{number}").write_bytes(data)
                raise
    return tally


def readers_over(metrics, limit):
    """Number of files whose readers took more memory than a limit, or ended. metrics: of the service; limit: [bytes]"""
    lines = [line.rpartition(" ") for line in metrics.splitlines()]
    counts = {name.removeprefix("bench_dragon_reader"): float(value) for name, _, value in lines if name[:1] != "#"}
    within = counts.get(
        f'_memory_bytes_bucket{{le="{limit:g}"}}', counts.get(f'_memory_bytes_bucket{{le="{limit}"}}', 0.0)
    )
    return round(counts.get("_memory_bytes_count", 0.0) - within + counts.get("s_ended_total", 0.0))
