/** Layers of a drawing on the picture: the square and its obstacles, stretches on which a limit fails, benches at fault. */

import { headingOf } from "./changes.js";
import { isLine, isWhole, yardOf } from "./drawing.js";
import { $, SMALL_TYPE, inType } from "./elements.js";
import { radiiOf } from "./judgement.js";
import { trace } from "./pen.js";
import { measures } from "./square.js";
import { say } from "./text.js";

/** What is wrong on a piece of the way. @type {Phrases} */
const BREACH_NAMES = {
  speed: "too fast",
  margin: "too near",
  stray: "too near if people stray",
};

// Widths of lines, radius of a ring, and width of the line around a name on the screen [px].
const BEND_WIDTH = 7;
/** Colour of a stretch on which a limit fails, by the limit. */
const BREACHES = { speed: "speed", margin: "head", stray: "pick" };
const FAULT_WIDTH = 4;
const RING = 14;
const HALO = 4;
/** Width and length of the arrow of a gate, and the shortest side that has its length [px]. */
const [GATE, GATE_LENGTH, SIDE] = [4, 26, 44];
/** A failure is drawn at times that differ from its own by at most this [s]. */
const SAME_TIME = 1e-6;

function outlineOf({ kind, points, radius, holes = [] }) {
  const path = new Path2D();
  if (kind === "circle") path.arc(points[0][0], points[0][1], radius, 0, 2 * Math.PI);
  else [points, ...holes].forEach((ring) => trace(ring, path, !isLine({ kind })));
  return path;
}

function drawThing(pen, colours, thing) {
  const { kind, points, radius } = thing;
  const { context } = pen;
  if (kind === "lane") return pen.stroke(trace(points, new Path2D(), false), colours.lane, Math.max(2 * radius * pen.scale, 2));
  if (kind === "wall") {
    Object.assign(context, { lineCap: "round", lineJoin: "round" });
    pen.stroke(trace(points, new Path2D(), false), colours.thing, Math.max(2 * radius * pen.scale, 2));
    Object.assign(context, { lineCap: "butt", lineJoin: "miter" });
    return;
  }
  const path = outlineOf(thing);
  context.fillStyle = kind === "area" ? colours.ground : colours.thing;
  context.fill(path, "evenodd");
  pen.stroke(path, colours.circle, kind === "area" ? 2 : 1);
}

/** A gate: an arrow through the border, both ways where a dance may enter and leave there. */
function drawGate(pen, colours, drawing, gate) {
  const [[x, y]] = gate.points;
  const heading = headingOf(drawing, gate);
  const [dx, dy] = [Math.cos(heading), Math.sin(heading)].map((one) => (one * GATE_LENGTH) / pen.scale);
  pen.stroke(trace([[x - dx / 2, y - dy / 2], [x + dx / 2, y + dy / 2]], new Path2D(), false), colours.gate, GATE);
  const ways = [...(gate.use === "out" ? [] : [1]), ...(gate.use === "in" ? [] : [-1])];
  for (const way of ways) pen.stroke(pen.tip(x + (way * dx) / 2, y + (way * dy) / 2, way * dx, way * dy, 9), colours.gate, GATE);
}

/** Lengths and angles of a thing while it is drawn, of all corners or of those beside the held one. */
function drawMeasures(pen, view, colours, { kind, points }, held, taken) {
  const isClosed = !isLine({ kind });
  const { lengths, angles } = measures(points, isClosed);
  const count = points.length;
  const isLabelled = (k) => count <= 12 || held === null || Math.min((k - held + count) % count, (held - k + count) % count) < 2;
  points.forEach((point, k) => {
    const next = points[(k + 1) % count];
    if (isLabelled(k) && lengths[k] * view.scale > SIDE) label(pen, view, `${lengths[k].toFixed(2)} m`, point.map((one, axis) => (one + next[axis]) / 2), colours.pick, colours, taken, 4);
    if (isLabelled(k) && angles[k] !== null && lengths[k] * view.scale > SIDE) label(pen, view, `${angles[k].toFixed(0)}°`, point, colours.pick, colours, taken, 14);
  });
}

/** Whether a line of text [left, bottom, width] overlaps none of those taken, each of this height [px]. */
export const isClear = (/** @type {number[]} */ [left, bottom, width], /** @type {number[][]} */ taken, /** @type {number} */ high) =>
  taken.every(([other, below, wide]) => Math.abs(bottom - below) >= high || left > other + wide || other > left + width);

/** Lines [left, bottom, width] that fill a box, each of this height [px]. */
export function linesIn(/** @type {{ left: number, top: number, bottom: number, width: number }} */ { left, top, bottom, width }, /** @type {number} */ high) {
  const count = Math.max(Math.ceil((bottom - top) / high), 1);
  return Array.from({ length: count }, (_, k) => [left, bottom - (k * (bottom - top)) / count, width]);
}

/** The lines that the controls on the picture take, which no name covers. */
function linesOfControls(/** @type {HTMLCanvasElement} */ canvas) {
  const { left, top } = canvas.getBoundingClientRect();
  const box = $("#views").getBoundingClientRect();
  return linesIn({ left: box.left - left, top: box.top - top, bottom: box.bottom - top, width: box.width }, inType(SMALL_TYPE));
}

/** How large a thing is, for the order in which names are drawn [m²]. */
function sizeOf({ kind, points, radius }) {
  if (kind === "circle") return Math.PI * radius ** 2;
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  return (Math.max(...xs) - Math.min(...xs)) * (Math.max(...ys) - Math.min(...ys));
}

/**
 * Draw a name beside its place, where it overlaps none of the names before it, whose boxes are in `taken`. Without room a
 * name in the colour of text is left out until the picture is enlarged; one in another colour is drawn nevertheless.
 */
function label(pen, view, text, /** @type {number[]} */ [x, y, room = 0], colour, colours, taken, away = 8) {
  const { context } = pen;
  const [atX, atY] = view.toScreen(x, y);
  context.save();
  context.translate(x, y);
  context.scale(1 / pen.scale, -1 / pen.scale);
  Object.assign(context, { font: `600 ${inType(SMALL_TYPE)}px system-ui, sans-serif`, lineWidth: HALO, lineJoin: "round", strokeStyle: colours.card, fillStyle: colour, textAlign: "left" });
  const { width } = context.measureText(text);
  const high = inType(SMALL_TYPE);
  const centred = width < room * pen.scale ? [[-width / 2, high / 2]] : [];
  const beside = [away, -width / 2, -away - width].flatMap((dx) => [-away, away + high].map((dy) => [dx, dy]));
  const isInside = (/** @type {number[]} */ [dx]) => atX + dx >= 0 && atX + dx + width <= view.width;
  const isFree = (/** @type {number[]} */ [dx, dy]) => isClear([atX + dx - HALO, atY + dy, width + 2 * HALO], taken, high + HALO);
  const places = [...centred, ...beside];
  const place = places.find((one) => isInside(one) && isFree(one)) ?? (colour === colours.text ? null : (places.find(isInside) ?? places[0]));
  if (place) {
    taken.push([atX + place[0], atY + place[1], width]);
    context.strokeText(text, place[0], place[1]);
    context.fillText(text, place[0], place[1]);
  }
  context.restore();
}

/** Cells of a grid along each side; most corners of an area that are looked at. */
const [GRID, CORNERS] = [24, 500];
/** Middles and widths of the widest places of areas, by their points. @type {WeakMap<number[][], number[]>} */
const WIDEST = new WeakMap();

/** The middle of the largest circle inside an area, and its width, of those around the points of a grid that becomes finer. */
export function widest(/** @type {number[][]} */ all) {
  const known = WIDEST.get(all);
  if (known) return known;
  const each = Math.ceil(all.length / CORNERS);
  const points = all.filter((_, k) => k % each === 0);
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  let [low, step, best, room] = [[Math.min(...xs), Math.min(...ys)], [0, 0], points[0], 0];
  step = [(Math.max(...xs) - low[0]) / GRID, (Math.max(...ys) - low[1]) / GRID];
  for (let round = 0; round < 3; round++) {
    for (let i = 0; i <= GRID; i++)
      for (let j = 0; j <= GRID; j++) {
        const at = [low[0] + i * step[0], low[1] + j * step[1]];
        const free = roomAround(points, at);
        if (free > room) [room, best] = [free, at];
      }
    low = best.map((middle, k) => middle - step[k]);
    step = step.map((one) => (2 * one) / GRID);
  }
  const place = [...best, 2 * room];
  WIDEST.set(all, place);
  return place;
}

/** Distance of a point inside an area to its edge; 0 outside [m]. */
function roomAround(/** @type {number[][]} */ points, /** @type {number[]} */ [x, y]) {
  let [inside, least] = [false, Infinity];
  for (const [k, [ax, ay]] of points.entries()) {
    const [bx, by] = points[(k + 1) % points.length];
    if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
    const along = Math.min(Math.max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2 || 1), 0), 1);
    least = Math.min(least, Math.hypot(ax + along * (bx - ax) - x, ay + along * (by - ay) - y));
  }
  return inside ? least : 0;
}

/** Place of a thing's name: its middle, or where an area is widest; and the width that it has there. */
function labelPlace({ kind, points }) {
  if (kind === "area") return points.length > 2 ? widest(points) : points[0];
  const [x, y] = points.reduce(([a, b], [c, d]) => [a + c, b + d], [0, 0]);
  const xs = points.map(([one]) => one);
  return [x / points.length, y / points.length, kind === "block" ? Math.max(...xs) - Math.min(...xs) : 0];
}

/** The layers of a drawn dance. get(): {drawing, editing, selected, chosen, measured, held, failure, course, benches}, or null in another kind of dance */
export function layers(dance, get) {
  const isShown = ({ kind }) => kind === "area" || !dance.hidden.has("things");
  const below = (pen, colours) => {
    const drawn = get();
    if (!drawn) return;
    const { things } = drawn.drawing;
    const order = [...things.keys()].sort((a, b) => Number(things[b].kind === "area") - Number(things[a].kind === "area"));
    for (const k of order) if (isWhole(things[k]) && things[k].kind !== "gate" && isShown(things[k])) drawThing(pen, colours, things[k]);
    if (dance.hidden.has("marks")) return;
    for (const { kind, points } of drawn.course?.breaches ?? []) pen.stroke(trace(points, new Path2D(), false), colours[BREACHES[kind]], BEND_WIDTH);
    for (const bend of drawn.course?.bends ?? []) pen.stroke(trace(bend.points, new Path2D(), false), colours.head, BEND_WIDTH);
  };
  const name = (pen, colours, { drawing, editing, chosen, failure }, names) => {
    const isMeantOne = (k) => chosen.includes(k) || failure?.area === drawing.things[k].name;
    dance.labels = [];
    const order = [...drawing.things.keys()].filter((k) => isShown(drawing.things[k])).sort((a, b) => Number(isMeantOne(b)) - Number(isMeantOne(a)) || sizeOf(drawing.things[b]) - sizeOf(drawing.things[a]));
    for (const k of order) {
      const [thing, isMeant] = [drawing.things[k], isMeantOne(k)];
      const colour = isMeant ? colours.pick : colours.text;
      // The square itself is known by its border.
      if (!thing.points.length || !(editing || isMeant || thing.kind !== "area")) continue;
      const count = names.length;
      label(pen, dance.view, thing.name, labelPlace(thing), colour, colours, names);
      // A touch of the square's name means the ground there.
      if (names.length > count && thing.kind !== "area") dance.labels.push({ k, left: names[count][0], bottom: names[count][1], width: names[count][2] });
    }
  };
  // The dragon passes over the names, but what is edited can be read everywhere.
  const names = (pen, colours) => {
    const drawn = get();
    if (!drawn) return;
    pen.names.push(...linesOfControls(pen.context.canvas));
    if (!drawn.editing) name(pen, colours, drawn, pen.names);
  };
  const above = (pen, colours) => {
    const drawn = get();
    if (!drawn) return;
    const { drawing, selected, chosen, failure } = drawn;
    const names = [...pen.names];
    if (yardOf(drawing).length && !dance.hidden.has("things")) for (const thing of drawing.things) if (thing.kind === "gate") drawGate(pen, colours, drawing, thing);
    const measured = drawing.things[selected];
    const isMeasured = !dance.hidden.has("measures");
    if (isMeasured && measured?.points.length > 1 && chosen.length < 2) drawMeasures(pen, dance.view, colours, measured, drawn.held, names);
    if (isMeasured) for (const point of drawn.measured) pen.stroke(pen.circle(...point, 4), colours.pick, 2);
    if (isMeasured && drawn.measured.length === 2) {
      const [[ax, ay], [bx, by]] = drawn.measured;
      pen.stroke(trace(drawn.measured, new Path2D(), false), colours.pick, 2);
      label(pen, dance.view, `${Math.hypot(bx - ax, by - ay).toFixed(2)} m`, [(ax + bx) / 2, (ay + by) / 2], colours.pick, colours, names);
    }
    if (drawn.editing) name(pen, colours, drawn, names);
    drawing.things.forEach((thing, k) => {
      const isMeant = failure?.area === thing.name || (chosen.length > 1 && chosen.includes(k));
      if (isMeant && isWhole(thing) && thing.kind !== "gate") pen.stroke(outlineOf(thing), colours.pick, FAULT_WIDTH);
    });
    if (dance.hidden.has("marks")) return;
    for (const { points, ...bend } of drawn.course?.bends ?? []) {
      const middle = points[Math.floor(points.length / 2)];
      pen.stroke(pen.circle(...middle, RING), colours.head, 3);
      label(pen, dance.view, say("{radius} m, {least} m suffices", radiiOf(bend)), middle, colours.head, colours, names, RING + 6);
    }
    for (const kind of Object.keys(BREACHES)) {
      const first = drawn.course?.breaches?.find((one) => one.kind === kind);
      if (first) label(pen, dance.view, say(BREACH_NAMES[kind]), first.points[Math.floor(first.points.length / 2)], colours[BREACHES[kind]], colours, names);
    }
    const { pose } = dance.scene;
    if (!failure || !pose || Math.abs(pose.time - failure.time) > SAME_TIME) return;
    for (const k of failure.benches) if (k < pose.x.length - 1) pen.stroke(dance.bench(k), colours.pick, FAULT_WIDTH);
    const first = failure.benches[0];
    if (first === undefined) return;
    const last = Math.min(first + 1, pose.x.length - 1);
    pen.stroke(pen.circle((pose.x[first] + pose.x[last]) / 2, (pose.y[first] + pose.y[last]) / 2, RING), colours.pick, 3);
  };
  return { below, names, above };
}
