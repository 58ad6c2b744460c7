"""What is wrong in a request of any call is refused by a name that its author used or can use, with the values."""

import json
import re
from pathlib import Path

import httpx
import pytest

from app.wire.problem import DETAIL_MAX
from app.wire.sentences import INSTEAD
from tests.support.asking import assert_problem
from tests.support.command import refusal
from tests.support.depth import few

# Names of core that no request has.
INSIDE = re.compile(r"turning_radius|path\.path|pieces|times\[|dragon\.|path\.")
# A call with a query -> the name of what is wrong, then the words and numbers of its refusal. Each of these stands in
# the options of the command too. Benches i and i + 2 of the first dragon are 4e-9 m apart on a straight line, and
# overlap on the widest spiral that is allowed.
OPTIONS = {
    "minimum-pitch?benches=5&head_length=2.2&overhang=0.549999999": "overhang 0.549999999 10000",
    "minimum-pitch?margin=1.0999999": "margin 1.0999999 10000",
    "minimum-pitch?margin=1.09": "margin 1.09 708.344074",
    "minimum-pitch?start_turns=0.2": "start_turns 0.45 0.2 22.5",
    "minimum-pitch?overhang=0.56": "overhang 2.2",
    "minimum-pitch?overhang=0.549": "overhang 0.549",
    "minimum-pitch?margin=1.2": "margin 1.1 1.2",
    "minimum-pitch?start_turns=1e-05": "start_turns 0.00045",
    "minimum-pitch?overhang=0.6&body_length=2.2": "overhang 0.55 0.6 straight",
    "collision-time?start_turns=0.5": "start_turns 2.345",
    "collision-time?overhang=1.1": "overhang half body_length 2.2 1.1",
    "collision-time?head_length=0.5&overhang=0.25": "overhang half head_length",
    "collision-time?benches=100001": "benches 100000 100001 shorten",
    "shortest-turn?turning_diameter=8": "turning_diameter 2.86",
    "shortest-turn?margin=0.4": "turning_diameter 0.4",
    "shortest-turn?pitch=0.8": "turning_diameter 15 13.286258",
    "shortest-turn?start_turns=2": "start_turns 2.64706",
    "quickest-turn?turning_diameter=7": "turning_diameter 2.86",
    "quickest-turn?margin=0.8": "turning_diameter 0.8",
    "turn?start_turns=2": "start_turns 2.64706",
    "turn?entry_radius=5": "entry_radius 4.5",
    "turn?exit_radius=9": "exit_radius 4.5",
    "turn?pitch=0.001&turning_diameter=0.002": "turning_diameter arcs",
    "turn?pitch=0.001&turning_diameter=0.01&ratio=0.01": "ratio arcs",
    "turn?ends=1": "ends middle",
    "turn?middle=40": "middle 40",
    "turn-time?entry_radius=2": "entry_radius",
    "turn-time?ratio=1&middle=0.5&ends=3&head_length=5": "ends shorter",
    "maximum-head-speed?turning_diameter=4": "turning_diameter larger 3.07841 1.432",
    "maximum-head-speed?entry_radius=2": "entry_radius larger",
    "maximum-head-speed?ratio=20": "ratio nearer 20",
    "maximum-head-speed?entry_radius=4.4&ratio=2.1": "entry_radius 4.4",
    "maximum-head-speed?turning_diameter=8": "turning_diameter larger",
    "maximum-head-speed?turning_diameter=4&entry_radius=2&ratio=3": "turning_diameter",
    "maximum-head-speed?pitch=0.55&turning_diameter=8.58": "pitch 0.55",
    "maximum-head-speed?start_turns=2": "start_turns 2.64706",
}
QUERIES = {
    "collision-time?pitch=NaN": "pitch finite NaN",
    "collision-time?pitch=inf": "pitch finite inf",
    "collision-time?pitch=1e400": "pitch finite 1e400",
    "collision-time?pitch=wide": "pitch wide",
    "collision-time?pitch=": "pitch [m]",
    "collision-time?width=-0.3": "width 0.001 -0.3",
    "collision-time?body_length=0": "body_length 0.001",
    "collision-time?overhang=-0.1": "overhang -0.1",
    "collision-time?head_length=1e308": "head_length 50 1e308",
    "collision-time?pitch=55": "pitch 10 55 0.55",
    "collision-time?width=30": "width 0.3",
    "collision-time?head_length=341": "head_length 50 3.41",
    "collision-time?body_length=220": "body_length 50 2.2",
    "collision-time?overhang=27.5": "overhang 0.275",
    "collision-time?margin=5": "margin 2 0.05",
    "collision-time?head_speed=100": "head_speed 20",
    "collision-time?benches=0": "benches",
    "collision-time?benches=2.5": "benches whole 2.5",
    "collision-time?benches=1000000": "benches 100000 1000000",
    "collision-time?benches=1000000000000000000000000000000": "benches 10000000",
    "collision-time?pitch=0.5&pitch=0.6": "pitch once",
    "collision-time?cross_check=everybody": "cross_check dragon pair none",
    "collision-time?stray=1": "stray chord",
    "collision-time?stray=-0.1": "stray -0.1",
    "minimum-pitch?hole=0.05&pin=0.06": "pin 0.05 0.06",
    "minimum-pitch?turning_diameter=900": "turning_diameter 200 9",
    "minimum-pitch?turning_diameter=0": "turning_diameter least",
    "minimum-pitch?turning_diameter=1_0": "turning_diameter 1_0",
    "minimum-pitch?benches=1_0": "benches 1_0",
    "clearance?stop=440.5": "stop 432.917924228 440.5",
    "clearance?start=432.9179242284&stop=433": "start 432.917924228 432.9179242284",
    "clearance?start=435&stop=440": "start 432.917924228",
    "clearance?start=5&stop=1": "stop before 5",
    "clearance?step=0.0001": "step 1000000 larger",
    "clearance?benches=2": "benches",
    "clearance?step=0": "step",
    "pitch-scan?benches=5&head_length=2.2&overhang=0.549999999": "overhang 0.549999999 10000",
    "pitch-scan?turning_diameter=0.036&benches=1&head_length=0.005&overhang=0": "turning_diameter 0.00125 0.036",
    "pitch-scan?benches=10001": "benches 10000 10001",
    "figures/trajectory.svg?time=440": "time 432.917924228",
    "figures/contact.svg?start_turns=0.5": "start_turns 2.345",
    "figures/contact.svg?benches=50000": "benches 5000",
    "turn?ratio=0": "ratio 0.01",
    "turn?middle=0": "middle 0.001",
    "turn-time?speed_limit=0": "speed_limit 0.001",
    "shortest-turn?ratio=0": "ratio 0.01",
    "shortest-turn?exit_opposite=true&any_ratio=true": "any_ratio exit_opposite",
    "shortest-turn?any_bend=true&any_ratio=true": "any_bend any_ratio",
    "shortest-turn?margin=3": "margin",
    "shortest-turn?turning_diameter=7.9&exit_opposite=true": "turning_diameter 2.86",
    "shortest-turn?benches=2001": "benches 2000",
    "quickest-turn?speed_limit=0": "speed_limit 0.001",
    "quickest-turn?benches=2001": "benches 2000",
    "maximum-head-speed?speed_limit=0": "speed_limit 0.001",
    "maximum-head-speed?benches=2001": "benches 2000",
    "tolerance?turning_diameter=40": "turning_diameter smaller 40 0.55",
    "tolerance?turning_diameter=17.6": "turning_diameter starts",
    "tolerance?turning_diameter=1": "turning_diameter before",
    "tolerance-curve?from_pitch=0.6&to_pitch=0.6": "to_pitch 0.6",
}
UNKNOWN = (
    *("collision-time?colour=red", "paper?pitch=1", "healthz?pitch=1", "quickest-turn?entry_radius=4"),
    *("shortest-turn?entry_radius=4", "pitch-scan?cross_check=pair", "clearance?cross_check=pair"),
    *("figures/contact.svg?cross_check=pair", "collision-time?times=1"),
)
# Parts of bodies by short names. EAST and NORTH cross, and LANE is a piece of 60 m.
PARTS = {
    "LANE": '{"kind": "line", "start": [0, 0], "end": [60, 0]}',
    "EAST": '{"dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[-20, 0], [20, 0]]}}',
    "NORTH": '{"name": "3", "dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[0, -20], [0, 20]]}}',
    "TIGHT": '{"kind": "turn", "turning_diameter": 4}',
    "BENCH": '{"x": 0, "y": 0, "heading": 0, "length": 2, "width": 0.3}',
    "FLAT": '{"type": "Polygon", "coordinates": [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]]}',
    "DEGREES": '{"type": "Polygon", "coordinates": [[[120, 28], [120.001, 28], [120.001, 28.001], [120, 28]]]}',
    "SWAPPED": '{"type": "Polygon", "coordinates": [[[28, 120], [28, 120.001], [28.001, 120.001], [28, 120]]]}',
    "WITHIN": '"venue": {"type": "Polygon", "coordinates"',
    "NAMED": '{"type": "Feature", "geometry": YARD, "properties": {"name"',
    "RING": '"coordinates": "degrees", "venue": {"type": "Polygon", "coordinates"',
    "SYSTEM": '"venue": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]], "crs"',
    "GATE": '{"type": "Feature", "properties": {"role": "gate", "heading"',
    "FEATURES": '"venue": {"type": "FeatureCollection", "features"',
    "POINT": '"geometry": {"type": "Point", "coordinates"',
    "COLLECTION": '{"type": "GeometryCollection", "geometries"',
    "CSV": '{"dragon": {"csv"',
    "TABLE": '"name;length;width;overhang\\nZhou;3,41;x;0,275\\n"',
    "YARD": '{"type": "Polygon", "coordinates": [[[0, 0], [24, 0], [24, 20], [0, 20], [0, 0]]]}',
}
# What stands beside the fields of a body, by a word before them.
WHOLES = {
    "SHORT": '{"dragon": {"benches": 4}, "path": {"kind": "route", "pieces": [LANE]}}',
    "NINE": '{"dragon": {"benches": 9}, "path": {"kind": "route", "pieces": [LANE]}}',
    "SEVERAL": '{"dances": [EAST, NORTH], "least": -60, "most": 60}',
    "TWO": '{"dances": [EAST, NORTH]}',
    "FOUR": '{"dragon": {"lengths": [3, 2, 2, 2], "widths": [0.3, 0.3, 0.3, 0.3], "overhangs": [0, 0, 0, 0]}}',
    "WOBBLE": '{"dragon": {"benches": 20}, "correlation_time": 4, "hole": 0.055, "pin": 0.05}',
    "CIRCLE": '{"dragon": {"benches": 40}, "turning_diameter": 12}',
    "INEXACT": '{"dragon": {"benches": 12}, "turning_diameter": 9, "length_error": 0.01}',
    "WISH": '{"venue": YARD, "dragon": {"benches": 10}, "figures": ["ring"], "count": 2}',
    "BARS": '{"dragon": {"benches": 6}, "path": {"kind": "route", "pieces": [LANE]}, "start": 20}',
}
# A call with a body -> the pointer to what is wrong, then the words and numbers of its refusal.
BODIES = {
    'trajectory {"path": {"start_turns": 0.5}}': "/path/start_turns path.start_turns 2.3",
    'trajectory {"dragon": {"overhang": 1.1}}': "/dragon/overhang dragon.overhang half",
    'trajectory {"times": {"stop": 440.5}}': "/times/stop times.stop 432.917924228 440.5",
    'trajectory {"times": {"start": 435, "stop": 440}}': "/times/start 432.9179",
    'trajectory {"times": [0, 440]}': "/times/1 times[1] 432.917924228",
    'trajectory {"path": {"pitch": 0.3, "start_turns": 12}}': "/times/stop 300",
    'trajectory NINE {"times": {"stop": 5}}': "/times/stop times.stop least 16.0",
    'trajectory NINE {"times": {"start": 5}}': "/times/start least 16.0",
    'trajectory NINE {"times": [-100000]}': "/times/0 least",
    'trajectory SHORT {"times": {"start": 2}}': "/times/start 7.810001 2",
    'trajectory SHORT {"times": {"stop": 2}}': "/times/stop 7.810001 2",
    'trajectory SHORT {"times": {"stop": 99}}': "/times/stop 60.000000000 99",
    'trajectory {"path": {"kind": "turn", "start_turns": 2}}': "/path/start_turns",
    'trajectory {"path": {"kind": "turn", "turning_diameter": 0.002, "pitch": 0.001}}': "/path/turning_diameter 0.002",
    'trajectory {"path": {"kind": "turn", "entry_radius": 9}}': "/path/entry_radius",
    'trajectory {"path": TIGHT}': "/path/turning_diameter larger 3.07841 1.432",
    'trajectory {"path": {"kind": "route", "pieces": [LANE, LANE]}}': "/path/pieces/1 close",
    'trajectory {"path": {"kind": "route", "pieces": [LANE]}}': "/path short 369.16 223 60",
    'trajectory {"path": {"pitch": NaN}}': "/path/pitch finite NaN",
    'trajectory {"path": {"pitch": Infinity}}': "/path/pitch finite Infinity",
    'trajectory {"path": {"pitch": 1e400}}': "/path/pitch finite",
    'trajectory {"path": {"pitch": 1e308}}': "/path/pitch 10",
    'trajectory {"path": {"pitch": "0.55"}}': '/path/pitch "0.55"',
    'trajectory {"dragon": {"width": true}}': "/dragon/width true",
    'trajectory {"dragon": {"width": null}}': "/dragon/width null",
    'trajectory {"dragon": {"width": 30}}': "/dragon/width 0.3",
    'trajectory {"dragon": {"benches": 1000000}}': "/dragon/benches 100000",
    'trajectory {"dragon": {"benches": 2.5}}': "/dragon/benches whole 2.5",
    'trajectory {"dragon": {"lengths": [2]}}': "/dragon/widths missing",
    'trajectory {"dragon": {"lengths": [2, 2], "widths": [1], "overhangs": [0, 0]}}': "/dragon/widths 2",
    'trajectory {"dragon": {"lengths": [2, 2], "widths": [1, 1], "overhangs": [0, 1]}}': "/dragon/overhangs/1 half",
    'trajectory {"times": {"step": 1e-6}}': "/times/step 1000000",
    'trajectory {"times": {"stop": 1e9}}': "/times/stop 1000000",
    'trajectory {"times": {"step": 0}}': "/times/step 1e-06",
    'trajectory {"times": {"start": 5, "stop": 1}}': "/times/stop 5 1",
    'trajectory {"times": []}': "/times 1",
    'trajectory {"times": [0, "1"]}': '/times/1 "1"',
    'trajectory {"times": "all"}': "/times JSON list",
    'trajectory {"path": {"kind": "maze"}}': '/path/kind "spiral" "route" maze',
    'trajectory {"path": {"kind": null}}': '/path/kind "spiral" null',
    'trajectory {"path": {"kind": 3}}': '/path/kind "spiral" 3',
    'trajectory {"path": {"kind": []}}': '/path/kind "turn"',
    'trajectory {"path": {"points": [[0, 0], [9, 9]]}}': '/path/points "spiral" "waypoints"',
    'trajectory {"path": []}': "/path JSON",
    'trajectory {"path": {"pich": 0.5}}': "/path/pich pitch",
    'trajectory {"path": {"kind": "spiral", "pitch": 0.5, "pitch": 0.6}}': ' "pitch" once',
    'trajectory {"a/b": 1}': "/a~1b",
    'trajectory {"decimals": 99}': "/decimals 15",
    'trajectory FOUR {"passages": [{"speed": 1, "until_s": 5}, {"speed": 0, "until_time": 5}]}': (
        "/passages/1/until_time"
    ),
    'trajectory FOUR {"passages": [{"speed": 0, "until_s": 5}]}': "/passages/0/until_time",
    'trajectory FOUR {"passages": [{"speed": 1}]}': "/passages/0",
    'trajectory FOUR {"passages": [{"speed": 1, "until_s": 5, "duration": 3}]}': "/passages/0/duration",
    'trajectory FOUR {"passages": [{"speed": 0, "duration": 0}]}': "/passages/0/duration",
    'trajectory FOUR {"passages": [{"speed": 0, "until_time": 5, "duration": 3}]}': "/passages/0/duration until_time",
    'trajectory FOUR {"passages": [{"speed": -1, "until_s": 5}]}': "/passages/0/speed",
    'trajectory {"path": {"kind": "spiral", "centre": [0, 1000000000]}}': "/path/centre/1",
    'trajectory {"path": {"kind": "spiral", "clockwise": 1}}': "/path/clockwise",
    'trajectory {"dragon": {"benches": 2, "names": ["Zhou"]}}': "/dragon/names",
    'trajectory {"dragon": {"benches": 2, "names": ["Zhou", "Li\\nWu"]}}': "/dragon/names/1",
    'trajectory {"dragon": {"csv": TABLE}}': "/dragon/csv",
    'trajectory CSV: ""}}': "/dragon/csv line 1: columns",
    'trajectory CSV: "length,width\\n"}}': "/dragon/csv line 1: overhang",
    'trajectory CSV: "length,width,overhang,weight\\n"}}': "/dragon/csv line 1: 'weight'",
    'trajectory CSV: "length,length,width,overhang\\n"}}': "/dragon/csv line 1: once",
    'trajectory CSV: "\\n\\nlength,width,overhang\\n"}}': "/dragon/csv line 4: first bench",
    'trajectory CSV: "length,width,overhang\\n2.2,0.3\\n"}}': "/dragon/csv line 2: 3 entries",
    'trajectory CSV: "length,width,overhang\\n2.2,wide,0.3\\n"}}': "/dragon/csv line 2: width number metres 'wide'",
    'trajectory CSV: "length,width,overhang\\n2.2,nan,0.3\\n"}}': "/dragon/csv line 2: width",
    'trajectory CSV: "length,width,overhang\\n\\n2.2,0.3,1.1\\n"}}': "/dragon/csv line 3: overhang half 2.2",
    'trajectory CSV: "Zhou,3.41,0.3\\n"}}': "/dragon/csv line 1: Zhou",
    'trajectory CSV: "3.41,0.3,0.275\\n2.2,0.3\\n"}}': "/dragon/csv line 2: 3 entries first 2",
    'trajectory CSV: "3.41,0.3\\n"}}': "/dragon/csv line 1: column",
    'trajectory CSV: "sep=;\\n"}}': "/dragon/csv line 1: column",
    'trajectory CSV: "Zhou,3.41,0.3,0.275\\nWu,wide,0.3,0.275\\n"}}': "/dragon/csv line 2: length",
    'trajectory TWO {"beats": []}': "/beats",
    'trajectory TWO {"times": {"start": 9, "stop": 5}}': "/times/stop times.start 9 5",
    'trajectory TWO {"times": {"step": 1e-6}}': "/times/step instants",
    'trajectory {"start_clock": "24:00"}': "/start_clock",
    'trajectory {"begin_clock": "7:30"}': "/begin_clock",
    'check {"cross_check": null}': "/cross_check",
    'check {"start_clock": "19:30", "begin_clock": "19:31"}': "/begin_clock start_clock",
    'check {"path": TIGHT}': "/path/turning_diameter",
    'check {"path": {"kind": "waypoints", "straight": [0, 1, 2, 3, 4], "radius": 0, "points": [[0, 0], [60, 0], '
    '[60.5, 0.5], [60.2, 0.9], [59.8, 0.6], [60.3, -30]]}, "dragon": {"benches": 9}}': "/path 60.7071 backwards",
    'check {"path": {"kind": "route", "pieces": [LANE, {"kind": "arc", "centre": [60, 0.001], "radius": 0.001, '
    '"start_angle": -1.5707963267948966, "sweep": 6.0}]}, "dragon": {"benches": 9}}': "/path 60.0016 backwards",
    'check {"path": {"kind": "turn", "ratio": 20}}': "/path/ratio 20",
    'check {"path": {"kind": "turn", "entry_radius": 2}}': "/path/entry_radius",
    'check {"path": {"kind": "turn"}, "dragon": {"lengths": [4], "widths": [0.3], "overhangs": [0]}}': (
        "/path/turning_diameter 2.00"
    ),
    'check {"path": {"kind": "turn", "turning_diameter": 0.002, "pitch": 0.001, "entry_radius": 0.001}}': (
        "/path/entry_radius arcs"
    ),
    'check {"start": 500}': "/start 432.917924228 500",
    'check {"start": 5, "stop": 5}': "/stop after 5",
    'check NINE {"stop": 10000}': "/stop 60.0",
    'check {"path": {"kind": "turn"}, "stop": 100000}': "/stop most",
    'check TWO {"dragon": {"benches": 9}}': "/dragon dances",
    'check TWO {"head_speed": 1}': "/head_speed dances",
    'check {"dances": []}': "/dances",
    'check {"dances": [{"dragon": {"benches": 0}}]}': "/dances/0/dragon/benches",
    'check {"dances": [EAST], "stop": 500}': "/stop",
    'check {"dances": [{"dragon": {"benches": 90000}}]}': "/dances",
    'check SHORT {"start": 1}': "/start 7.81 whole 1",
    'check SHORT {"stop": 61}': "/stop 60.0",
    'check SHORT {"start": 30, "stop": 20}': "/stop 20",
    'check SHORT {"speed_limit": 0}': "/speed_limit 0.001",
    'check SHORT {"dragon": {"benches": 2001}}': "/dragon/benches 2000 2001",
    'check SHORT {"venue": {"type": "Feature", "properties": {"name": "bow"}, "geometry": FLAT}}': (
        "/venue 'bow' self-intersection (4.5, 4.5)"
    ),
    'check SHORT {"venue": {"type": "Point", "coordinates": [0, 0]}}': "/venue/type Polygon 'Point'",
    'check SHORT {"venue": {}}': "/venue/type",
    'check SHORT {"venue": "square"}': "/venue JSON",
    'check SHORT {"venue": {"type": "Polygon", "coordinates": [[1, 2, 3]]}}': "/venue/coordinates/0/0",
    'check BARS {"beats": [{"bars": 16, "tempo": 0, "step": 0.6}]}': "/beats/0/tempo 10",
    'check BARS {"beats": [{"bars": 16, "tempo": 96, "step": 0.001}]}': "/beats/0/step 0",
    'check BARS {"beats": [{"bars": 0.5, "tempo": 96, "step": 1}]}': "/beats/0/bars whole",
    'check BARS {"beats": [{"bars": 4, "tempo": 96, "step": 1}], "passages": [{"speed": 1, "until_s": 5}]}': (
        "/passages beats"
    ),
    'check {"venue": DEGREES}': '/venue longitude latitude 3.41 "coordinates": "degrees"',
    'check {"venue": DEGREES, "coordinates": null}': '/venue longitude latitude 3.41 "coordinates": "degrees"',
    'check {"venue": DEGREES, "coordinates": "metres"}': '/venue longitude latitude 3.41 "coordinates": "degrees"',
    'figures/trajectory.svg {"venue": DEGREES}': "/venue longitude latitude 3.41",
    'figures/contact.svg {"venue": DEGREES}': "/venue longitude latitude 3.41",
    'check {"venue": SWAPPED}': "/venue swapped",
    'check {"venue": SWAPPED, "coordinates": "metres"}': "/venue swapped",
    'check {"venue": SWAPPED, "coordinates": "degrees"}': "/venue/coordinates/0/0/1 swapped",
    "check {RING: [[[28, 120], [28.001, 120], [28.001, 120.001], [28, 120]]]}}": "/venue/coordinates/0/0/1 90 120",
    "check {RING: [[[361, 0], [361.001, 0], [361, 0.001], [361, 0]]]}}": "/venue/coordinates/0/0/0 360",
    "check {RING: [[[120, 28], [120.3, 28], [120.3, 28.001], [120, 28.001], [120, 28]]]}}": "/venue 20 29.49",
    "check {RING: [[[120, 28], [120.001, 28], [120.001]]]}}": "/venue/coordinates/0/2 [longitude, latitude]",
    "check {RING: [[[120, 28], [120.001, 28.001], [120.001, 28], [120, 28.001], [120, 28]]]}}": (
        "/venue self-intersection"
    ),
    "check {RING: [[[120, 28], [120.001, 28], [120.001, 28.001]]]}}": "/venue closed",
    'check {SYSTEM: "EPSG:4326"}}': "/venue/crs",
    'check {SYSTEM: {"type": "link"}}}': "/venue/crs",
    'check {SYSTEM: {"type": "name", "properties": {}}}}': "/venue/crs",
    "check {SYSTEM: 4326}}": "/venue/crs",
    "check {SYSTEM: []}}": "/venue/crs",
    'check {SYSTEM: {"type": "name", "properties": {"name": "EPSG:43260"}}}}': "/venue/crs CRS84 EPSG:43260",
    'check {"coordinates": "degrees", SYSTEM: {"type": "name", "properties": {"name": "EPSG:3857"}}}}': "/coordinates",
    'check {"coordinates": "metres", SYSTEM: {"type": "name", "properties": {"name": "EPSG:4326"}}}}': "/coordinates",
    'check {"venue": {"type": "FeatureCollection", "features": [{"type": "Feature", "crs": {}, "geometry": YARD}]}}': (
        "/venue/features/0/crs venue.crs"
    ),
    'check {"venue": {"type": "GeometryCollection", "geometries": [{"crs": {}}]}}': "/venue/geometries/0/crs venue.crs",
    'check {"venue": {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {"crs": 1}}]}}': (
        "/venue/features/0/geometry/crs venue.crs"
    ),
    "check {WITHIN: [[[0, 0], [3.4, 0], [3.4, 3.4], [0, 3.4], [0, 0]]]}}": "/venue longitude latitude",
    "check {WITHIN: [[[-180, -90], [-178, -90], [-178, -88], [-180, -90]]]}}": "/venue longitude latitude",
    'check {"venue": {"type": "GeometryCollection", "geometries": [DEGREES, YARD]}}': "/venue longitude latitude",
    'check {"venue": []}': "/venue",
    'check {"venue": {"type": "Polygon"}}': "/venue/coordinates",
    'check {"venue": {"type": "FeatureCollection", "features": [{"geometry": {"geometries": [{"crs": 1}]}}]}}': (
        "/venue/features/0/geometry/geometries/0/crs venue.crs"
    ),
    "check {WITHIN: []}}": "/venue/coordinates",
    "check {WITHIN: [3]}}": "/venue/coordinates/0",
    "check {WITHIN: [[[0, 0], [1, 0], 5]]}}": "/venue/coordinates/0/2",
    "check {WITHIN: [[[0, 0], [1], [1, 1], [0, 0]]]}}": "/venue/coordinates/0/1",
    "check {WITHIN: [[[0, 0], [1, NaN], [1, 1], [0, 0]]]}}": "/venue/coordinates/0/1/1",
    "check {WITHIN: [[[0, 0], [2e5, 0], [1, 1], [0, 0]]]}}": "/venue/coordinates/0/1/0",
    "check {WITHIN: [[[0, 0], [9, 0], [9, 9]]]}}": "/venue closed",
    "check {WITHIN: [[]]}}": "/venue/coordinates/0",
    'check {"venue": {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "coordinates": [[]]}, YARD]}}': (
        "/venue/geometries/0/coordinates/0"
    ),
    'check {"venue": {"type": "FeatureCollection", "features": []}}': "/venue",
    'check {"venue": {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": null}]}}': (
        "/venue/features/0/geometry"
    ),
    'check {"venue": {"type": "FeatureCollection", "features": [NAMED: 7}}, NAMED: "a"}}]}}': (
        "/venue/features/0/properties/name"
    ),
    'check {"venue": {"type": "FeatureCollection", "features": [NAMED: "a"}}, NAMED: "a"}}]}}': "/venue",
    'check {"venue": {"type": "FeatureCollection", "features": [NAMED: "a\\nb"}}]}}': (
        "/venue/features/0/properties/name line"
    ),
    f'check {{"venue": {{"type": "FeatureCollection", "features": [NAMED: "{"x" * 201}"}}}}]}}}}': (
        "/venue/features/0/properties/name 200"
    ),
    'check {FEATURES: [NAMED: "a"}}, GATE: "east"}, POINT: [0, 0]}}]}}': "/venue/features/1/properties/heading",
    'check {FEATURES: [NAMED: "a"}}, GATE: 1.5}, POINT: [1]}}]}}': "/venue/features/1/geometry/coordinates/0",
    'check SHORT {"dragon": {"benches": 1, "names": ["Li\\u202e.csv"]}}': "/dragon/names/0 line",
    'plan SHORT {"gates": [{"name": "Li\\u202e.csv", "x": 0, "y": 0}]}': "/gates/0/name line",
    'plan SHORT {"title": "Li\\u202e.csv"}': "/title line",
    'cues SHORT {"title": "Li\\u202e.csv"}': "/title line",
    'crew SHORT {"title": "Li\\u202e.csv"}': "/title line",
    'films SHORT {"title": "Li\\u202e.csv"}': "/title line",
    'films {"seconds": 120, "rate": 60, "height": 2160}': "/seconds 4000",
    'films {"stop": 500}': "/stop",
    'films TWO {"head_speed": 1}': "/head_speed",
    'films TWO {"stop": 99}': "/stop 39.9",
    'check {"coordinates": "metres"}': "/coordinates metres",
    'check {"coordinates": "degrees"}': "/coordinates degrees",
    'figures/trajectory.svg {"coordinates": "degrees"}': "/coordinates degrees",
    'figures/contact.svg {"coordinates": "metres"}': "/coordinates metres",
    'clearance {"path": TIGHT}': "/path/turning_diameter",
    'clearance {"dragon": {"benches": 2}}': "/dragon/benches 3",
    'clearance {"dances": [EAST]}': "/dances two",
    'clearance TWO {"path": {"kind": "spiral"}}': "/path dances",
    'clearance {"dances": [{}, {"path": {"kind": "spiral", "centre": [50, 0]}}], "times": {"stop": 900, "step": 9}}': (
        "/times/stop most"
    ),
    'clearance TWO {"times": {"stop": 40, "step": 1e-06}}': "/times/step",
    'figures/contact.svg {"path": TIGHT}': "/path/turning_diameter",
    'figures/contact.svg {"path": {"kind": "turn"}, "stop": 100000}': "/stop",
    'figures/contact.svg TWO {"head_speed": 1}': "/head_speed",
    'figures/trajectory.svg TWO {"head_speed": 1}': "/head_speed",
    'figures/trajectory.svg {"time": 440}': "/time 432.917924228",
    'figures/encounter.svg TWO {"head_speed": 1}': "/head_speed",
    'figures/encounter.png {"dances": [{}], "time": 500}': "/time 432.917924228",
    'maximum-head-speed {"path": {"kind": "spiral"}}': "/stop 432",
    'maximum-head-speed {"path": {"kind": "spiral"}, "stop": null}': "/stop fold",
    "overlaps {}": "/benches",
    'overlaps {"benches": []}': "/benches 1",
    'overlaps {"benches": [BENCH, {"x": 0, "y": 0, "heading": 0, "length": 2, "width": 0}]}': "/benches/1/width 0.001",
    'overlaps {"benches": [{"x": 0, "y": 0, "heading": 0, "length": 220, "width": 1}]}': "/benches/0/length 2.2",
    'overlaps {"benches": [{"x": 0, "y": 0, "heading": 10000, "length": 2, "width": 0.3}]}': "/benches/0/heading 1000",
    'overlaps {"benches": [{"x": 0}]}': "/benches/0/y missing",
    'overlaps {"benches": [BENCH], "chained": 1}': "/chained",
    'encounter {"dances": []}': "/dances 1",
    "encounter {}": "/dances missing",
    'encounter {"dances": [{"name": "a"}, {"name": "b"}, {"name": "a"}]}': "/dances/2/name dances[0].name",
    'encounter {"dances": [{"name": "a\\nb"}]}': "/dances/0/name line",
    'encounter {"dances": [{"delay": 1e9}]}': "/dances/0/delay 1000000 1000000000",
    'encounter {"dances": [{}, {"delay": 1000}]}': "/dances/1/delay 1000 432.917924",
    'encounter {"dances": [{"dragon": {"benches": 6000}}, {"dragon": {"benches": 6000}}]}': "/dances 10000 12000",
    'encounter {"dances": [{}, {"dragon": {"width": 30}}]}': "/dances/1/dragon/width 30 0.3",
    'encounter {"dances": [{}, {"dragon": {"overhang": 1.2}}]}': "/dances/1/dragon/overhang dances[1].dragon.overhang",
    'encounter {"dances": [{}, {"path": {"kind": "turn", "turning_diameter": 2}}]}': (
        "/dances/1/path/turning_diameter dances[1].path.turning_diameter 2"
    ),
    'encounter {"dances": [{}], "dragon": {}}': '/dragon "dragon" dances',
    'encounter {"dances": [{"delay": 5}], "start": 1}': "/start 5.000000",
    'encounter {"dances": [{}], "stop": 500}': "/stop 432.917924228",
    'encounter {"dances": [{}], "stray": 2}': "/stray",
    'safe-delay {"dances": []}': "/dances 1",
    'safe-delay SEVERAL {"part": 2}': "/part below 2",
    'safe-delay SEVERAL {"part": "west"}': "/part below 2",
    'safe-delay SEVERAL {"part": true}': "/part order",
    'safe-delay SEVERAL {"part": 0.5}': "/part order",
    'safe-delay SEVERAL {"least": 60}': "/most 60",
    'safe-delay SEVERAL {"most": 1e9}': "/most 1000000 1000000000",
    'safe-delay {"dances": [{}, NORTH]}': "/stop 432.917924",
    'envelope SHORT {"start": 12, "stop": 11}': "/stop after 12 11",
    'envelope SHORT {"stop": 10000}': "/stop",
    'envelope SHORT {"spectators": []}': "/spectators",
    'envelope SHORT {"spectators": [[1]]}': "/spectators/0",
    'envelope SHORT {"excess": 0.1}': '/excess "excess"',
    'envelope TWO {"start": -500}': "/start least",
    'envelope TWO {"stop": 10000}': "/stop most",
    'envelope TWO {"head_speed": 1}': "/head_speed dances",
    'tolerance INEXACT {"turning_diameter": null}': "/length_error 0",
    'tolerance INEXACT {"venue": YARD}': "/length_error 0",
    'tolerance INEXACT {"path": {"kind": "turn"}, "turning_diameter": null}': "/length_error 0",
    'tolerance INEXACT {"length_error": 0.9}': "/length_error 0.825 0.9",
    'tolerance CIRCLE {"path": {"kind": "turn"}}': "/turning_diameter spiral stop 12",
    'tolerance CIRCLE {"stop": 10}': "/turning_diameter spiral stop 12",
    'tolerance CIRCLE {"start": 300}': "/start 236.721489 300",
    'tolerance CIRCLE {"turning_diameter": 40}': "/turning_diameter smaller 40",
    'tolerance TWO {"turning_diameter": 9}': "/turning_diameter",
    'tolerance TWO {"length_error": 0.01}': "/length_error",
    'tolerance TWO {"path": {"kind": "spiral"}}': "/path",
    'tolerance TWO {"start": -9}': "/start",
    'contact-probability CIRCLE {"path": {"kind": "turn"}}': "/turning_diameter spiral stop 12",
    'contact-probability CIRCLE {"stop": 10}': "/turning_diameter spiral stop 12",
    'contact-probability CIRCLE {"start": 300}': "/start 236.721489 300",
    'contact-probability CIRCLE {"turning_diameter": 40}': "/turning_diameter smaller 40",
    'contact-probability WOBBLE {"samples": 1000000}': "/samples 100000 1000000",
    'contact-probability WOBBLE {"samples": 0}': "/samples",
    'contact-probability WOBBLE {"correlation_time": 0}': "/correlation_time",
    'contact-probability WOBBLE {"step": 0.9}': "/step 0.8 0.9",
    'contact-probability WOBBLE {"correlation_benches": 0}': "/correlation_benches",
    'contact-probability WOBBLE {"lateral": -0.01}': "/lateral -0.01",
    'contact-probability WOBBLE {"lateral": 0.5}': "/lateral 0.1 bench 1",
    'contact-probability WOBBLE {"pin": 0.06}': "/pin 0.055 0.06",
    'contact-probability WOBBLE {"pitch_error": 0.3}': "/pitch_error 0.1",
    'contact-probability WOBBLE {"stop": 1000}': "/stop",
    'proposals WISH {"gates": [{"point": [5, 6], "heading": 0}]}': "/gates/0/point border",
    'proposals WISH {"gates": [{"point": [0, 10], "heading": 3.14}]}': "/gates/0/heading into",
    'proposals WISH {"figures": ["parade"]}': "/figures two",
    'proposals WISH {"figures": ["polka"]}': "/figures/0 spiral",
    'proposals WISH {"count": 0}': "/count",
    'proposals WISH {"venue": null}': "/venue given",
    'proposals WISH {"dragon": {"benches": 100000}}': "/dragon/benches most",
    'proposals WISH {"venue": FLAT}': "/venue self-intersection",
}
FILES = [entry for entry in BODIES if entry.startswith("check {") and "dances" not in entry]
# So much that it is made here.
MANY = {
    f'trajectory {{"dragon": {{"benches": {"9" * 4000}}}}}': "/dragon/benches 10000000",
    f'trajectory {{"path": {{"pitch": 1{"0" * 400}}}}}': "/path/pitch finite",
    f"trajectory {json.dumps(dict.fromkeys(map(str, range(101)), 0))}": " 100",
    f'overlaps {{"benches": [{"BENCH, " * 20_000}BENCH]}}': "/benches 20000 20001",
    f'overlaps {{"chained": false, "benches": [{"BENCH, " * 399}BENCH]}}': "/benches pairs 20000",
    f'encounter {{"dances": [{"{}, " * 200}{{}}]}}': "/dances 200",
    f'check SHORT {{"venue": {{"a": {"[" * 900}{"]" * 900}}}}}': "/venue 20",
    f'check SHORT {{"venue": {"COLLECTION: [" * 9}{{}}{"]}" * 9}}}': "/venue 8",
    f'proposals WISH {{"venue": {{"type": "Polygon", "coordinates": [[{"[0, 0], " * 50_000}[0, 0]]]}}}}': (
        "/venue 5000 50000"
    ),
}
# Paths, each refused by every call that takes one, at a pointer into the path.
PATHS = {
    '{"kind": "route", "pieces": [LANE, {"kind": "arc", "centre": [60.1, 20], BEND}]}': "/pieces/1 0.1",
    '{"kind": "route", "pieces": [LANE, {"kind": "arc", "centre": [60, 20.1], BEND}]}': "/pieces/1 close",
    '{"kind": "route", "pieces": [LANE, {"kind": "line", "start": [60, 0], "end": [60, 9]}]}': "/pieces/1 90",
    '{"kind": "waypoints", "points": [[0, 0], [60, 0], [30, 0]], "straight": [0, 1], "radius": 0}': "/points/1 180",
    '{"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [0, 0]}]}': "/pieces/0 1e-06 0",
    '{"kind": "route", "pieces": [{"kind": "arc", "centre": [0, 0], "radius": 9, "start_angle": 0, "sweep": 0}]}': (
        "/pieces/0 0"
    ),
    '{"kind": "route", "pieces": [{"kind": "arc", "centre": [0, 0], "radius": 0, "start_angle": 0, "sweep": 1}]}': (
        "/pieces/0/radius 0.001"
    ),
    '{"kind": "route", "pieces": [{"kind": "arc", "centre": [0, 0], "radius": 1, "start_angle": 0, "sweep": 1}]}': (
        " short 223 1"
    ),
    '{"kind": "route", "pieces": []}': "/pieces 1",
    f'{{"kind": "route", "pieces": [{"LANE, " * 1000}LANE]}}': "/pieces 1000",
    '{"kind": "route", "pieces": [{"start": [0, 0], "end": [1, 0]}]}': "/pieces/0/kind missing",
    '{"kind": "route", "pieces": [{"kind": "loop"}]}': '/pieces/0/kind "line" "coil" "loop"',
    '{"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0], "pitch": 1}]}': (
        '/pieces/0/pitch "line" "coil"'
    ),
    '{"kind": "route", "pieces": [3]}': "/pieces/0 JSON",
    '{"kind": "route", "pieces": [{"kind": "line", "start": [0], "end": [60, 0]}]}': "/pieces/0/start 2 1",
    '{"kind": "route", "pieces": [{"kind": "line", "start": [0, 0, 0], "end": [60, 0]}]}': "/pieces/0/start 2",
    '{"kind": "route", "pieces": [{"kind": "line", "start": [0, "a"], "end": [1, 0]}]}': "/pieces/0/start/1 start[1]",
    '{"kind": "waypoints", "points": [[0, 0]]}': "/points 2",
    '{"kind": "waypoints", "points": [[0, 0], [9, 0], [9, 0]]}': "/points/2 path.points[2] 0.001",
    f'{{"kind": "waypoints", "points": [{"[0, 0], [1, 0], " * 499}[0, 0]]}}': "/points spot",
    '{"kind": "route", "pieces": [LANE, {"kind": "waypoints", "points": [[60, 0], [99, 0], [60, 0]]}]}': (
        "/pieces/1/points path.pieces[1].points 0 1"
    ),
    f'{{"kind": "waypoints", "points": {json.dumps([[k, 0] for k in range(1001)])}}}': "/points 1000",
    f'{{"kind": "route", "pieces": [{{"kind": "waypoints", "points": {json.dumps([[k, 0] for k in range(600)])}}}, '
    f'{{"kind": "waypoints", "points": {json.dumps([[k, 0] for k in range(600, 1200)])}}}]}}': "/pieces 1000",
    '{"kind": "route", "pieces": [RAMP, HALF: 2}, {"kind": "line", "start": [1.95, 0.33], "end": [9, 9]}]}': (
        "/pieces/1 close 1.95057538, 0.3274"
    ),
    '{"kind": "route", "pieces": [RAMP, "length": 2, "end_curvature": 10000}]}': "/pieces/0/end_curvature 1000",
    '{"kind": "route", "pieces": [RAMP, "length": 40, "end_curvature": 3}]}': " bench 0",
    '{"kind": "route", "pieces": [RAMP, HALF: 2001}]}': "/pieces/0/length 2000 1000",
    '{"kind": "route", "pieces": [RAMP, HALF: 1999}, RAMP, HALF: 1999}, RAMP, HALF: 1999}]}': ("/pieces 2500 2999"),
    '{"kind": "route", "pieces": [{"kind": "clothoid", "start": [0, 0], "start_curvature": 0, "end_curvature": 1, '
    '"length": 2}]}': "/pieces/0/heading missing",
    '{"kind": "turn", "start_turns": 2}': "/start_turns path.start_turns 2.64706",
    '{"kind": "turn", "turning_diameter": 2}': "/turning_diameter radius bench 0",
    '{"kind": "turn", "entry_radius": 5}': "/entry_radius 4.5 5",
    '{"kind": "turn", "ratio": 1000}': "/ratio 100 1000",
    '{"kind": "turn", "radius": 4.5}': "/radius",
    '{"kind": "waypoints", "points": [[0, 0], [20, 0], [40, 0], [60.5, 0]]}': " short 369.16 223 60",
}
PARTS |= {
    "BEND": '"radius": 20, "start_angle": -1.5707963267948966, "sweep": 1.5',
    "RAMP": '{"kind": "clothoid", "start": [0, 0], "heading": 0, "start_curvature": 0',
    "HALF": '"end_curvature": 0.5, "length"',
}


def request_of(entry):
    """The call and the body of an entry."""
    head, _, fields = expanded(entry).partition(" {")
    call, *whole = head.split()
    text = f"{{{fields}"
    return call, json.dumps(json.loads(expanded(WHOLES[whole[0]])) | json.loads(text)) if whole else text


def expanded(text):
    for name, part in PARTS.items():
        text = text.replace(name, part)
    return text


def post(client, call, body):
    return client.post(f"/{call}", content=body, headers={"Content-Type": "application/json"})


def shortened(entry):
    return str(entry)[:70]


@pytest.fixture(scope="module")
def parameters(ask):
    """The parameters of each call with a query."""
    calls = ask("openapi.json")["paths"].items()
    return {path: {one["name"] for one in call["get"].get("parameters", [])} for path, call in calls if "get" in call}


@pytest.mark.parametrize("request_", OPTIONS | QUERIES)
def test_a_query_is_refused_by_its_own_name_and_value(ask, parameters, request_):
    expected = (OPTIONS | QUERIES)[request_]
    ask.refuses(expected, request_)
    assert not INSIDE.search(ask.send(request_).json()["detail"])
    assert expected.split()[0] in parameters["/" + request_.partition("?")[0].replace(".svg", ".{format}")]


@pytest.mark.parametrize("request_", UNKNOWN)
def test_a_name_that_the_call_does_not_take_is_refused(ask, request_):
    ask.refuses(f"{request_.partition('?')[2].partition('=')[0]} unknown", request_)


@pytest.mark.parametrize("request_", few([*OPTIONS], 9))
def test_an_option_is_refused_in_the_same_words(ask, request_):
    call, _, query = request_.partition("?")
    refused = refusal(call, *(f"--{one.replace('_', '-')}" for one in query.split("&")))
    assert refused == f"Error: {ask.send(request_).json()['detail']}\n"


@pytest.mark.parametrize("entry", BODIES | MANY, ids=shortened)
def test_a_body_is_refused_by_a_place_in_it(client, entry):
    answer = post(client, *request_of(entry))
    assert_problem(answer, 422, (BODIES | MANY)[entry])
    assert not re.search("turning_radius|path\\.path|\u202e", answer.json()["detail"])


@pytest.mark.parametrize("call", few(["check", "trajectory", "clearance", "figures/trajectory.svg"], 1))
@pytest.mark.parametrize("path", PATHS, ids=shortened)
def test_an_invalid_path_is_refused_at_its_place_by_every_call(client, call, path):
    assert_problem(post(client, call, f'{{"path": {expanded(path)}}}'), 422, f"/path{PATHS[path]}")


@pytest.mark.parametrize("entry", few(FILES, 4))
def test_a_file_of_a_dance_is_refused_as_a_body_is(client, tmp_path, entry):
    call, text = request_of(entry)
    (tmp_path / "dance.json").write_text(text)
    assert refusal("check", str(tmp_path / "dance.json")) == f"Error: {post(client, call, text).json()['detail']}\n"


# Requests that the service refuses, one a line: [query], [path, body in JSON], or [path, text of a file in Latin-1].
WRONG = [json.loads(line) for line in Path(__file__).with_name("wrong_requests.jsonl").read_text("utf-8").splitlines()]
# What no person should read: names of fields, and places in a body.
DOTTED = re.compile(r"[a-z]_[a-z]|[a-z]\.[a-z]|\w\[\d|\bNone\b|POST|Authorization")
CHINESE = re.compile("[\u4e00-\u9fff]")
# Requests, and what people read about them.
READ = [
    (["collision-time?stray=0.9"], "en", "“Stray” must be at most half the chord of bench 1 (82.5 cm), got 90 cm."),
    (["collision-time?pitch="], "en", "“Pitch” must be a number [m], got an empty field."),
    (["collision-time?start_turns=-1"], "zh", "“起始圈数”应大于 0 圈，现为 -1 圈。"),
    (
        ["check", {"path": {"kind": "waypoints", "points": [[0, 0], [20, 0], [0, 0]]}}],
        "en",
        "The list of points must not make the curve stop or turn on the spot, as between points 1 and 2.",
    ),
    (["places", "PNG"], "zh", "无法读取此文件：请存为 GeoJSON、KML、KMZ 或 DXF，或 TOML、JSON 格式的舞龙文件。"),
]


def problems(client, requests, language="en"):
    """What the service answers to these requests in a language, where it refuses."""
    for path, *body in requests:
        is_file = bool(body) and isinstance(body[0], str)
        answer = client.request(
            "POST" if body else "GET",
            path,
            content=(body[0].encode("latin-1") if is_file else json.dumps(body[0])) if body else None,
            headers={
                "Accept-Language": language,
                "Content-Type": f"application/{'octet-stream' if is_file else 'json'}",
            },
        )
        if answer.is_error:
            yield answer.json()


@pytest.fixture(scope="module")
def refused(client, service_with):
    """Problems of all kinds."""
    strict = service_with(token="secret", places_bytes_max=9, deadline_seconds=0.2).url
    with httpx.Client(base_url=strict, timeout=60.0) as other:
        late = ["minimum-pitch?benches=9&turning_diameter=0.01"]
        return [*problems(other, [late, ["jobs"], ["places", "PNG" * 9]]), *problems(client, WRONG)]


def test_a_refusal_is_a_sentence_for_people(client, refused):
    assert len(refused) > len(WRONG) - 25  # a few of the wrong texts are right for some field
    sentences = [one["sentence"] for problem in refused for one in (problem, *problem["errors"])]
    assert [one for one in sentences if DOTTED.search(one) or one[0].islower() or one[-1] not in ".?"] == []
    assert INSTEAD.keys() <= {problem["template"] for problem in refused}
    chinese = [problem["sentence"] for problem in problems(client, WRONG, "zh")]
    assert [one for one in chinese if not CHINESE.search(one) or one[-1] not in "。？"] == []


@pytest.mark.parametrize("request_, language, sentence", READ)
def test_people_read_labels_and_the_units_of_the_page(client, request_, language, sentence):
    assert [problem["sentence"] for problem in problems(client, [request_], language)] == [sentence]


def test_a_refusal_is_its_template_with_the_values(refused):
    for problem in (one for whole in refused for one in (whole, *whole["errors"])):
        values = problem["values"]

        def fill(text, values=values):
            return re.sub(r"\{(\w+)\}", lambda word: values[word[1]]["text"] if word[1] in values else word[0], text)

        value_in_words = f", got {problem['got']['text']}" if "got" in problem else ""
        why = f": {fill(problem['reason'])}" if "reason" in problem else ""
        whole = fill(problem["template"]) + value_in_words + why
        rest = problem["detail"].removeprefix(whole)
        assert not rest or rest.startswith((" (and ", ". Ask for it as a job")) or len(whole) > DETAIL_MAX, problem
        # A template is the same for all values: it holds none of them.
        for value in (*values.values(), *([problem["got"]] if "got" in problem else [])):
            assert "parameter" in value or len(value["text"]) < 4 or value["text"] not in problem["template"], problem
