/** A drawing: its address, its place in a request, and the changes of its points and things. */

import assert from "node:assert/strict";
import { test } from "node:test";
import * as changes from "../../../app/page/changes.js";
import * as drawing from "../../../app/page/drawing.js";
import { PRESETS, isPresetPath, isPresetVenue, shownAt } from "../../../app/page/presets.js";
import * as square from "../../../app/page/square.js";
import { widest } from "../../../app/page/venue.js";

const { EMPTY } = drawing;
const YARD = [[-12, -10], [12, -10], [12, 10], [-12, 10]];
const THINGS = [
  { kind: "area", name: "square", points: YARD },
  { kind: "circle", name: "old ~oak.", points: [[5.3, 4]], radius: 0.25 },
  { kind: "block", name: "舞台", points: [[0, 0], [3, 0], [3, 2]], holes: [[[1, 0.5], [2, 0.5], [2, 1]]] },
  { kind: "wall", name: "fence-1", points: [[-5, 3.5], [-4, 3.5]], radius: 0.05 },
  { kind: "gate", name: "gate", points: [[-12, 3]], heading: null },
  { kind: "lane", name: "ambulances", points: [[-12, 8], [12, 8]], radius: 1.5 },
];
const DRAWN = { ...EMPTY, points: [[-11, -8], [0, 0.5], [11, -8]], straight: [0], radius: 3, begin: 4.5, limit: 1.1, things: THINGS, origin: { longitude: 119.64, latitude: 29.11 }, grid: { x: 500_000, y: 3_220_000 }, yard: YARD };
const again = (one) => drawing.fromAddress(new URLSearchParams(new URLSearchParams(drawing.toAddress(one)).toString()));
const near = (a, b, words) => assert.ok(Math.abs(a - b) < 1e-9, `${words}: ${a}, ${b}`);

test("a drawing is the same after an address", () => {
  const back = again(DRAWN);
  // A gate straight into the square has no heading of its own.
  assert.deepEqual(back, { ...DRAWN, things: DRAWN.things.map(({ heading, ...thing }) => thing) });
  const gate = { ...THINGS[4], heading: -1.5 };
  const turned = { ...DRAWN, things: [THINGS[0], gate, { ...gate, name: "way in", use: "in", street_width: 4.5, street_length: 60 }] };
  assert.deepEqual(again(turned), turned);
  const kept = drawing.drawingOf({ venue: drawing.keptVenueOf(turned) });
  assert.deepEqual(kept.things, turned.things);
  assert.deepEqual(drawing.toAddress(EMPTY), []);
});

test("a path of lines and arcs is written as a walk, to every digit, and any other path as it is", () => {
  const walk = { kind: "route", start: 2, pieces: [{ kind: "line", start: [0, 0], end: [5, 0] }] };
  const names = (one) => drawing.toAddress(one).map(([name]) => name);
  assert.deepEqual(names({ ...EMPTY, path: walk, begin: 2, start: 1.5 }), ["begin", "walk", "start"]);
  assert.deepEqual(again({ ...EMPTY, path: walk, begin: 2, start: 1.5 }).path.pieces, walk.pieces);
  const other = { kind: "turn", pitch: 1.7 };
  assert.deepEqual(names({ ...EMPTY, path: other }), ["raw"]);
  assert.deepEqual(again({ ...EMPTY, path: other }).path, other);
});

test("of an address that was cut off what can be read opens", () => {
  const read = (text) => drawing.fromAddress(new URLSearchParams(text));
  assert.deepEqual(read("route=0,0_1,x"), EMPTY);
  assert.deepEqual(read("route=0,0_9,0&things=a.square..0,0_9,0_9,9~q.what..1,1~c.tree.1.x,2&walk=1,2").things.map(({ name }) => name), ["square"]);
  assert.deepEqual(read("route=0,0_9,0&raw={").points, [[0, 0], [9, 0]]);
  assert.deepEqual([read("corner=wide").radius, read("limit=").limit], [EMPTY.radius, null]);
});

test("the service gets a drawing as waypoints in a venue", () => {
  assert.deepEqual(drawing.pathOf(DRAWN), { kind: "waypoints", points: DRAWN.points, straight: [0], start: 4.5 });
  assert.equal(drawing.pathOf({ ...DRAWN, straight: [0, 1] }).radius, 3);
  const { venue, speed_limit } = drawing.placeOf(DRAWN);
  assert.equal(speed_limit, 1.1);
  assert.deepEqual(venue.features.map(({ geometry, properties }) => [geometry.type, properties.name]), [["Polygon", "square"], ["Point", "old ~oak."], ["Polygon", "舞台"], ["LineString", "fence-1"]]);
  assert.deepEqual(venue.features[0].geometry.coordinates[0], [...YARD, YARD[0]]);
  assert.deepEqual([venue.grid, venue.origin], [DRAWN.grid, DRAWN.origin]);
  // Obstacles alone stand on an endless plain; gates alone, or half a square, are no venue.
  assert.equal(drawing.venueOf({ ...EMPTY, things: [THINGS[1]] }).features[0].properties.name, "plain");
  assert.equal(drawing.venueOf({ ...EMPTY, things: [THINGS[4], { kind: "area", name: "", points: YARD.slice(2) }] }), null);
  // A file keeps gates and lanes, whatever else there is.
  const kept = drawing.keptVenueOf({ ...EMPTY, things: THINGS.slice(4) });
  assert.deepEqual(kept.features.map(({ properties }) => properties.name), ["plain", "gate", "ambulances"]);
  assert.deepEqual(kept.features[2].properties, { name: "ambulances", role: "emergency lane", radius: 1.5 });
  assert.deepEqual(drawing.drawingOf({ path: null, venue: kept }).things.map(({ kind, radius }) => [kind, radius]), [["gate", undefined], ["lane", 1.5]]);
  assert.deepEqual(drawing.lanesOf(DRAWN), [{ name: "ambulances", points: [[-12, 8], [12, 8]], width: 3 }]);
  assert.equal(drawing.keptVenueOf(EMPTY), null);
  assert.deepEqual(drawing.placeOf(EMPTY), {});
  assert.deepEqual(drawing.placeOf({ ...EMPTY, path: { kind: "turn" }, start: 0 }), { start: 0 });
  assert.deepEqual(drawing.placeOf({ ...EMPTY, start: 3 }), { start: 3 });
  const least = { area: 3, block: 3, circle: 1, wall: 2, gate: 1, lane: 2 };
  for (const [kind, count] of Object.entries(least)) for (const more of [-1, 0]) assert.equal(drawing.isWhole({ kind, points: YARD.slice(0, count + more) }), more === 0, kind);
});

test("a dance of a file becomes the drawing that it came from", () => {
  const back = drawing.drawingOf({ path: drawing.pathOf(DRAWN), ...drawing.placeOf(DRAWN) });
  assert.deepEqual(back, { ...DRAWN, radius: EMPTY.radius, yard: null, things: THINGS.slice(0, 4) });
  // Lines and the curves that follow them are legs.
  const pieces = [{ kind: "line", start: [0, 0], end: [9, 0] }, { kind: "waypoints", points: [[9, 0], [12, 3], [9, 6]] }, { kind: "line", start: [9, 6], end: [0, 6] }];
  const { points, straight, path } = drawing.drawingOf({ path: { kind: "route", pieces } });
  assert.deepEqual([points, straight, path], [[[0, 0], [9, 0], [12, 3], [9, 6], [0, 6]], [0, 3], null]);
  const arcs = { kind: "route", pieces: [{ kind: "arc" }], start: 3 };
  assert.deepEqual([drawing.drawingOf({ path: arcs }).path, drawing.drawingOf({ path: arcs }).begin], [arcs, 3]);
  // What has a heading of its own at an end is no list of points, unless a line follows there.
  const curve = (more) => drawing.drawingOf({ path: { kind: "waypoints", points: [[0, 0], [9, 0]], ...more } });
  assert.deepEqual([curve({}).path, curve({}).begin, curve({ start_heading: null, end_heading: null }).points.length], [null, 0, 2]);
  for (const end of ["start_heading", "end_heading"]) assert.deepEqual([curve({ [end]: 0 }).path.kind, curve({ [end]: 0 }).begin, curve({ [end]: 0 }).points], ["waypoints", 0, []]);
  const along = { kind: "waypoints", points: [[9, 0], [12, 3]], start_heading: 0 };
  assert.equal(drawing.drawingOf({ path: { kind: "route", pieces: [pieces[0], along] } }).path, null);
  assert.notEqual(drawing.drawingOf({ path: { kind: "route", pieces: [along, pieces[0]] } }).path, null);
  assert.notEqual(drawing.drawingOf({ path: { kind: "route", pieces: [pieces[0], { ...along, end_heading: 1 }] } }).path, null);
  assert.equal(drawing.drawingOf({ path: { kind: "route", pieces: [pieces[0], { ...along, end_heading: 1 }, pieces[2]] } }).path, null);
  // Unnamed things get names, and the square is what is called so.
  const polygon = (name, size) => ({ type: "Feature", properties: { name }, geometry: { type: "Polygon", coordinates: [[[0, 0], [size, 0], [size, size], [0, 0]]] } });
  const { things } = drawing.drawingOf({ path: null, venue: { type: "FeatureCollection", features: [polygon("", 2), polygon("square", 9), polygon("", 1)] } });
  assert.deepEqual(things.map(({ kind, name }) => [kind, name]), [["block", "block"], ["area", "square"], ["block", "block 2"]]);
});

test("points are put in, taken away, moved and bent", () => {
  const street = { ...EMPTY, points: [[0, 0], [10, 0], [20, 0]], straight: [0, 1], path: { kind: "turn" } };
  const more = changes.inserted(street, null, 1, [5, 0.00001]);
  assert.deepEqual([more.points[1], more.straight, more.path], [[5, 0], [0, 1, 2], null]);
  assert.deepEqual(changes.removed(more, null, 1), { ...street, path: null });
  const bend = { ...street, points: [...street.points, [20, 9], [30, 9]], straight: [1, 3] };
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((k) => changes.inserted(bend, null, k, [1, 1]).straight), [[2, 4], [2, 4], [1, 2, 4], [1, 4], [1, 3, 4], [1, 3]]);
  assert.deepEqual([0, 1, 2, 3, 4].map((k) => changes.removed(bend, null, k).straight), [[0, 2], [2], [2], [1], [1]]);
  assert.deepEqual(changes.removed({ ...street, straight: [1] }, null, 1).straight, []);
  const laps = { ...EMPTY, points: [[0, 0], [9, 0], [9, 9], [0, 0], [9, 0], [9, 9]], straight: [0, 3] };
  assert.deepEqual(changes.placesOf(laps, null), new Set([0, 1, 2]));
  assert.deepEqual(changes.moved(laps, null, 4, [8, 1]).points, [[0, 0], [8, 1], [9, 9], [0, 0], [8, 1], [9, 9]]);
  assert.deepEqual(changes.left(laps, null, 1).points, [[0, 0], [9, 9], [0, 0], [9, 9]]);
  const divided = changes.inserted(laps, null, 1, [5, 0]);
  assert.deepEqual([divided.points.length, divided.points[5], divided.straight], [8, [5, 0], [0, 1, 4, 5]]);
  assert.deepEqual(changes.moved(street, null, 2, [20, 7]).points[2], [20, 7]);
  assert.deepEqual(changes.bent(street, 0).straight, [1]);
  assert.deepEqual(changes.bent(changes.bent(street, 0), 0).straight, [0, 1]);
  assert.deepEqual(changes.removed({ ...EMPTY, things: THINGS }, 1, 0).things.map(({ name }) => name), ["square", "舞台", "fence-1", "gate", "ambulances"]);
});

test("gates stay on the border, straight into the square", () => {
  const drawn = { ...EMPTY, things: [THINGS[0], THINGS[4]] };
  assert.deepEqual(changes.moved(drawn, 1, 0, [9, 1]).things[1].points, [[12, 1]]);
  assert.deepEqual(changes.withPoints(drawn, 0, YARD.map(([x, y]) => [1.25 * x, y])).things[1].points, [[-15, 3]]);
  near(changes.headingOf(drawn, THINGS[4]), 0, "from the left");
  near(Math.abs(square.onBorder(YARD.toReversed(), [11, 1]).heading), 3.1416, "from the right, of a clockwise ring");
  assert.equal(changes.headingOf(drawn, { ...THINGS[4], heading: 0.3 }), 0.3);
  // A corner that is moved is moved in the square without streets too.
  const withStreet = { ...drawn, yard: YARD, things: [{ ...THINGS[0], points: [...YARD, [-30, 3]] }, THINGS[4]] };
  assert.deepEqual(changes.moved(withStreet, 0, 2, [14, 10]).yard[2], [14, 10]);
  // A corner put into a side, or taken away, is one of the square without streets too; one in a street is not.
  const middle = YARD[0].map((one, axis) => (one + YARD[1][axis]) / 2);
  assert.deepEqual(changes.inserted(withStreet, 0, 1, middle).yard, [YARD[0], middle, ...YARD.slice(1)]);
  assert.deepEqual(changes.removed(withStreet, 0, 1).yard, YARD.toSpliced(1, 1));
  assert.deepEqual(changes.inserted(withStreet, 0, 5, [-28, 5]).yard, YARD);
});

test("an L, a T and a U lose what is cut out, and stay around their middle", () => {
  const area = (ring) => ring.reduce((sum, [x, y], k) => sum + (ring.at(k - 1)[0] * y - x * ring.at(k - 1)[1]) / 2, 0);
  for (const [shape, times] of [[square.lShape, 1], [square.tShape, 2], [square.uShape, 1]]) {
    const ring = shape(42, 28, 14, 10, [3, 4]);
    assert.deepEqual(square.shapeOf(ring, [["it", shape]]), { name: "it", cut: [14, 10] });
    assert.deepEqual([ring, [ring[1], ring[0], ...ring.slice(2)]].map(square.crossesItself), [false, true]);
    assert.equal(area(ring), 42 * 28 - times * 140);
    assert.deepEqual(square.extent(ring), { width: 42, height: 28, middle: [3, 4] });
  }
});

test("a square is drawn by its size, and measured", () => {
  const box = square.rectangle(24, 18, [1, 2]);
  assert.deepEqual(square.extent(box), { width: 24, height: 18, middle: [1, 2] });
  const round = square.measures(square.circle(26.5, [0, 0]), true).lengths;
  assert.ok(Math.abs(round.reduce((sum, one) => sum + one, 0) - Math.PI * 26.5) < 0.1 && Math.max(...round) - Math.min(...round) < 1e-3);
  for (const [x, y] of square.circle(26.5, [0, 0])) assert.ok(Math.abs(Math.hypot(x, y) - 13.25) < 1e-4);
  assert.deepEqual(square.measures([[0, 0], [3, 4]], true).lengths, [5, null]); // Its one side is measured once.
  const { lengths, angles } = square.measures(box, true);
  assert.deepEqual(lengths, [24, 18, 24, 18]);
  for (const ring of [box, box.toReversed()]) square.measures(ring, true).angles.forEach((one) => near(one, 90, "corner"));
  assert.equal(angles.length, 4);
  const wall = square.measures([[0, 0], [3, 0], [3, 4]], false);
  assert.deepEqual([wall.lengths, wall.angles.map((one) => one && Math.round(one))], [[3, 4, null], [null, 90, null]]);
});

test("presets are told from one's own square and path", () => {
  assert.ok(isPresetVenue(PRESETS.village) && isPresetVenue(EMPTY) && !isPresetVenue({ things: THINGS }));
  assert.ok(isPresetPath(PRESETS.s) && !isPresetPath(DRAWN) && !isPresetPath({ ...PRESETS.s, path: {} }));
  assert.deepEqual([shownAt(PRESETS.village), shownAt(PRESETS.s)], [75, null]);
  assert.equal(drawing.freeName(THINGS, "gate"), "gate 2");
});

test("a name stands where its area is widest", () => {
  // A square of 40 m with a street of 60 m: its middle. A ring of 50,000 corners with two lobes: in the larger one.
  const street = [[0, 0], [40, 0], [40, 18], [100, 18], [100, 22], [40, 22], [40, 40], [0, 40]];
  const [x, y, width] = widest(street);
  assert.ok(Math.abs(x - 20) < 1 && Math.abs(y - 20) < 1 && width > 38.8 && width <= 40 + 1e-9);
  const turns = Array.from({ length: 50_000 }, (_, k) => (2 * Math.PI * k) / 50_000);
  const lobes = turns.map((turn) => [(30 + 12 * Math.cos(turn)) * Math.cos(turn), 12 * Math.sin(turn)]);
  const [lx, ly, wide] = widest(lobes);
  const room = Math.min(...lobes.map(([px, py]) => Math.hypot(px - lx, py - ly)));
  assert.ok(Math.abs(wide / 2 - room) < 0.01 * room, `${wide} m wide, and ${room} m to the edge`);
  // No other place has more room, by more than 3 %.
  const ring = lobes.filter((_, k) => k % 100 === 0);
  for (let px = -18; px <= 42; px += 1)
    for (let py = -12; py <= 12; py += 1) {
      const sides = ring.map((one, k) => [one, ring.at(k - 1)]).filter(([[, ay], [, by]]) => ay > py !== by > py);
      const isInside = sides.filter(([[ax, ay], [bx, by]]) => px < ax + ((bx - ax) * (py - ay)) / (by - ay)).length % 2;
      if (isInside) assert.ok(0.97 * Math.min(...ring.map(([ax, ay]) => Math.hypot(ax - px, ay - py))) < room, `${px}, ${py}`);
    }
});

test("things of a file without a name have one in the language of the page", () => {
  const ring = [[0, 0], [9, 0], [9, 9], [0, 0]];
  const polygon = { type: "Polygon", coordinates: [ring] };
  const features = [polygon, polygon, { type: "Point", coordinates: [1, 1] }].map((geometry) => ({ type: "Feature", properties: { radius: 1 }, geometry }));
  const words = { area: "广场", block: "障碍", circle: "树" };
  const { things } = drawing.drawingOf({ venue: { type: "FeatureCollection", features } }, (kind) => words[kind]);
  assert.deepEqual(things.map(({ name }) => name), ["广场", "障碍", "树"]);
});
