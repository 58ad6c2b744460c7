/** Changes of a drawing: its points and things moved, inserted and removed. Drawings are never changed, only replaced. */

import { EMPTY, freeName, isArea, place, yardOf } from "./drawing.js";
import { extent, isInside, onBorder } from "./square.js";
import { nearestLeg } from "./touch.js";
import { roundedRoute } from "./walk.js";

/** How far beside the border of a square a corner that divides it may lie [m]. */
const BESIDE = 1;

/** The edited item of a drawing: null for the path, else the number of a thing. */
export const pointsOf = (drawing, item) => (item === null ? drawing.points : (drawing.things[item]?.points ?? []));

/** Without the path of a figure or a file, whose dance started on that path. */
const freed = (/** @type {any} */ { path, start }) => ({ path: null, start: path ? null : start });

/** True if two points are one place, which the laps of a ring pass again and again. */
const isSame = (a, b) => a?.[0] === b?.[0] && a?.[1] === b?.[1];
/** Numbers of the points of an item at the place of point k: on a path all its laps, elsewhere this one. */
export const lapsOf = (drawing, item, k) => (item === null ? drawing.points.flatMap((point, at) => (isSame(point, drawing.points[k]) ? [at] : [])) : [k]);
/** Numbers of the points of an item, each place of a path once. */
export function placesOf(drawing, item) {
  const points = pointsOf(drawing, item);
  return new Set(item === null ? new Map([...points.keys()].reverse().map((k) => [String(points[k]), k])).values() : points.keys());
}

/** The drawing with other points of one item; gates stay on the border. */
export function withPoints(drawing, item, points) {
  if (item === null) return { ...drawing, points, ...freed(drawing) };
  const changed = withThing(drawing, item, { points });
  return isArea(drawing.things[item]) ? gated(changed, drawing.things[item].points) : changed;
}

/** The border of a square without its streets after one corner of the whole was moved, inserted or removed; null after any other change. before, now: corners of the whole */
function followed(yard, before, now) {
  const isOf = (ring, corner) => ring.some((one) => isSame(one, corner));
  if (now.length === before.length) return yard.map((corner) => now[before.findIndex((one) => isSame(one, corner))] ?? corner);
  const left = yard.filter((corner) => isOf(now, corner) || !isOf(before, corner));
  if (now.length === before.length - 1) return left.length > 2 ? left : null;
  if (now.length !== before.length + 1) return null;
  const corner = now.find((one) => !isOf(before, one));
  if (!corner) return yard;
  const { k, far } = nearestLeg(yard, corner, true);
  // One that divides the side of a street leaves the square as it is.
  return far <= BESIDE ? yard.toSpliced(k, 0, corner) : yard;
}

/** The drawing with its gates moved to the border of a square that was changed. before: corners of the square then */
function gated(drawing, before) {
  const now = yardOf({ ...drawing, yard: null });
  const yard = drawing.yard && followed(drawing.yard, before, now);
  const ring = yard ?? now;
  const things = ring.length < 3 ? drawing.things : drawing.things.map((thing) => (thing.kind === "gate" ? { ...thing, points: [onBorder(ring, thing.points[0]).point] } : thing));
  return { ...drawing, yard, things };
}

/** Heading of those who enter by a gate [rad]: its own one, or straight into the square. */
export const headingOf = (drawing, { points, heading }) => heading ?? onBorder(yardOf(drawing), points[0]).heading;

export function withThing(drawing, item, changes) {
  return { ...drawing, things: drawing.things.map((thing, k) => (k === item ? { ...thing, ...changes } : thing)) };
}

/** The drawing with a new point before point k of an item, and on the same leg of the other laps. */
export function inserted(drawing, item, k, point) {
  const isLeg = (at) => at === k || (item === null && at > 0 && isSame(drawing.points[at - 1], drawing.points[k - 1]) && isSame(drawing.points[at], drawing.points[k]));
  const legs = [...pointsOf(drawing, item).keys(), pointsOf(drawing, item).length].filter(isLeg);
  return legs.reduceRight((all, leg) => divided(all, item, leg, point), drawing);
}

/** The drawing with a new point before point k of an item; both parts of a straight leg stay straight. */
function divided(drawing, item, k, point) {
  const changed = withPoints(drawing, item, pointsOf(drawing, item).toSpliced(k, 0, place(point)));
  if (item !== null) return changed;
  const straight = drawing.straight.flatMap((leg) => (leg < k - 1 ? [leg] : leg === k - 1 && k < changed.points.length - 1 ? [leg, leg + 1] : [leg + (leg >= k - 1)]));
  return { ...changed, straight };
}

/** The drawing without a place of an item, which the path may pass several times. */
export const left = (drawing, item, k) => lapsOf(drawing, item, k).reduceRight((all, lap) => removed(all, item, lap), drawing);

/** The drawing without point k of an item; a thing without points is removed. */
export function removed(drawing, item, k) {
  const points = pointsOf(drawing, item).toSpliced(k, 1);
  if (item !== null) return points.length ? withPoints(drawing, item, points) : { ...drawing, things: drawing.things.toSpliced(item, 1) };
  const isStraight = (leg) => drawing.straight.includes(leg);
  // The two legs at this point become one, straight if both were.
  const legs = points.slice(1).flatMap((_, leg) => (leg < k - 1 ? isStraight(leg) : leg === k - 1 ? isStraight(leg) && isStraight(k) : isStraight(leg + 1)) ? [leg] : []);
  return { ...drawing, points, straight: legs, ...freed(drawing) };
}

/** The drawing with point k of an item, and all laps through it, at another place. */
export function moved(drawing, item, k, point) {
  const ring = drawing.things[item]?.kind === "gate" ? yardOf(drawing) : [];
  const now = ring.length ? onBorder(ring, point).point : place(point);
  const laps = lapsOf(drawing, item, k);
  return withPoints(drawing, item, pointsOf(drawing, item).map((one, at) => (laps.includes(at) ? now : one)));
}

/** The drawing with a point a step further [m]; a gate whose border does not go that way comes to the next side there. */
export function stepped(drawing, item, k, by) {
  const point = pointsOf(drawing, item)[k];
  const { width, height } = extent(drawing.things[item]?.kind === "gate" ? yardOf(drawing) : [point]);
  for (let far = 0; far <= width + height; far++) {
    const way = 1 + far / Math.hypot(...by);
    const [x, y] = point.map((one, axis) => one + way * by[axis]);
    const next = moved(drawing, item, k, [x, y]);
    const now = pointsOf(next, item)[k];
    if (!isSame(now, point) && Math.hypot(now[0] - x, now[1] - y) <= 1) return next;
  }
  return drawing;
}

/** The drawing with a leg made straight, or curved again. */
export function bent(drawing, leg) {
  const { straight } = drawing;
  return { ...drawing, ...freed(drawing), straight: straight.includes(leg) ? straight.filter((one) => one !== leg) : [...straight, leg].sort((a, b) => a - b) };
}

/** A thing of a drawing moved by [m]; with a square go its gates and its border without streets. */
export function shifted(drawing, item, by) {
  const shift = (points) => points.map((point) => place(point.map((one, axis) => one + by[axis])));
  const thing = drawing.things[item];
  if (thing.kind === "gate") return moved(drawing, item, 0, shift(thing.points)[0]);
  const whole = withThing(drawing, item, { points: shift(thing.points), ...(thing.holes && { holes: thing.holes.map(shift) }) });
  if (!isArea(thing)) return whole;
  const things = whole.things.map((one) => (one.kind === "gate" ? { ...one, points: shift(one.points) } : one));
  return { ...whole, things, yard: drawing.yard && shift(drawing.yard) };
}

/** Several things of a drawing moved by [m]; with a square go its gates, once. */
export function shiftedAll(drawing, items, by) {
  const isCarried = (item) => drawing.things[item].kind === "gate" && items.some((one) => isArea(drawing.things[one]));
  return items.filter((item) => !isCarried(item)).reduce((all, item) => shifted(all, item, by), drawing);
}

/** Several things in a row or in a column with the first of them, or at equal distances between the outermost two. how: row, column or gaps */
export function aligned(drawing, items, how) {
  const middleOf = (item) => extent(drawing.things[item].points).middle;
  const middles = items.map(middleOf);
  const { width, height } = extent(middles);
  const axis = how === "gaps" ? Number(height > width) : Number(how === "row");
  const places = items.toSorted((a, b) => middleOf(a)[axis] - middleOf(b)[axis]);
  const [low, high] = [places[0], places.at(-1)].map((item) => middleOf(item)[axis]);
  const wanted = (item) => (how === "gaps" ? low + ((high - low) * places.indexOf(item)) / (places.length - 1) : middles[0][axis]);
  return items.reduce((all, item) => shifted(all, item, [0, 0].with(axis, wanted(item) - middleOf(item)[axis])), drawing);
}

/** The drawing without several things. */
export const withoutThings = (drawing, items) => ({ ...drawing, things: drawing.things.filter((_, k) => !items.includes(k)) });

/** The drawing with a thing after all others, under a name of its own. */
export function copied(drawing, thing) {
  return { ...drawing, things: [...drawing.things, { ...thing, name: freeName(drawing.things, thing.name.replace(/ \d+$/, "")) }] };
}

/** A thing turned about the middle of its points [rad], and scaled from there [1]. */
export function turned(drawing, item, angle = 0, scale = 1) {
  const thing = drawing.things[item];
  const [x, y] = extent(thing.points).middle;
  const [c, s] = [scale * Math.cos(angle), scale * Math.sin(angle)];
  const turn = (points) => points.map(([px, py]) => place([x + c * (px - x) - s * (py - y), y + s * (px - x) + c * (py - y)]));
  return withPoints({ ...drawing, things: drawing.things.map((one) => (one === thing && one.holes ? { ...one, holes: one.holes.map(turn) } : one)) }, item, turn(thing.points));
}

/** Kinds of pieces of which a figure consists. */
const PIECES = ["line", "arc", "coil"];

/** True for the path of a figure: one of lines, arcs and coils, such as a proposed ring. */
export const isFigure = ({ path }) => path?.kind === "route" && path.pieces.every(({ kind }) => PIECES.includes(kind));

/** True for a figure that has a mirror image: a coil turns one way alone. */
export const canMirror = ({ path }) => path.pieces.every(({ kind }) => kind !== "coil");

/** The points of a figure, without those in streets. */
export function dancedOf(drawing) {
  const danced = drawing.points.filter((point) => isInside(yardOf(drawing), point));
  return danced.length > 1 ? danced : drawing.points;
}

/** A figure moved by [m], turned [rad], scaled [1] and mirrored left to right about its middle; it stays a figure. */
export function figured(drawing, { by = [0, 0], angle = 0, scale = 1, isMirrored = false }) {
  const { middle: [x, y] } = extent(dancedOf(drawing));
  const [c, s, side] = [scale * Math.cos(angle), scale * Math.sin(angle), isMirrored ? -1 : 1];
  const carry = ([px, py]) => {
    const [dx, dy] = [side * (px - x), py - y];
    return [x + c * dx - s * dy + by[0], y + s * dx + c * dy + by[1]];
  };
  const turns = {
    line: ({ start, end }) => ({ start: carry(start), end: carry(end) }),
    arc: ({ centre, radius, start_angle: first, sweep }) => ({ centre: carry(centre), radius: scale * radius, start_angle: angle + (isMirrored ? Math.PI - first : first), sweep: side * sweep }),
    coil: ({ centre, pitch, rotation = 0 }) => ({ centre: carry(centre), pitch: scale * pitch, rotation: rotation + angle }),
  };
  const pieces = drawing.path.pieces.map((piece) => ({ ...piece, ...turns[piece.kind](piece) }));
  const begin = scale * drawing.begin;
  // A larger or smaller one begins when the whole dragon is on it.
  return { ...drawing, path: roundedRoute({ ...drawing.path, pieces, start: begin }), begin, start: scale === 1 ? drawing.start : null, points: drawing.points.map((point) => place(/** @type {[number, number]} */ (carry(point)))) };
}

/** Half the longer axis of the earth [m], and its flattening [1]. */
const [AXIS, FLATTENING] = [6_378_137, 1 / 298.257_223_563];

/** How far east and north one place on earth, {longitude, latitude} [degrees], is of another not far away [m]. */
function eastNorth(from, to) {
  const [degree, squared] = [Math.PI / 180, FLATTENING * (2 - FLATTENING)];
  const latitude = (degree * (from.latitude + to.latitude)) / 2;
  const share = 1 - squared * Math.sin(latitude) ** 2;
  const across = AXIS / Math.sqrt(share);
  return [degree * (to.longitude - from.longitude) * across * Math.cos(latitude), (degree * (to.latitude - from.latitude) * across * (1 - squared)) / share];
}

/** Where x = y = 0 of another drawing is in this one [m]: known if both are on earth, or on a survey grid. */
export function offsetOf(drawing, other) {
  if (drawing.grid && other.grid) return [other.grid.x - drawing.grid.x, other.grid.y - drawing.grid.y];
  return drawing.origin && other.origin ? eastNorth(drawing.origin, other.origin) : [0, 0];
}

/** A path in the service's format, moved by [m]. */
export function shiftedPath(path, by) {
  if (!path || !by.some(Boolean)) return path;
  const shift = (point) => point.map((one, axis) => one + by[axis]);
  const isPlace = (name, value) => ["centre", "end"].includes(name) || (name === "start" && Array.isArray(value));
  const shiftOf = (name, value) => (isPlace(name, value) ? shift(value) : name === "points" ? value.map(shift) : name === "pieces" ? value.map((piece) => shiftedPath(piece, by)) : value);
  return Object.fromEntries(Object.entries(path).map(([name, value]) => [name, shiftOf(name, value)]));
}

/** A drawing with another one beside it: {drawing, left: things of the other one for which there is no room, such as a second square}. */
export function joined(drawing, other) {
  const by = offsetOf(drawing, other);
  const shift = (points) => points.map((point) => place(point.map((one, axis) => one + by[axis])));
  const hasSquare = drawing.things.some(isArea);
  const hasPath = drawing.points.length > 0 || Boolean(drawing.path);
  // Gates stand on the border of their own square.
  const isLeft = ({ kind }) => hasSquare && (kind === "area" || (kind === "gate" && other.things.some(isArea)));
  const taken = other.things.filter((thing) => !isLeft(thing));
  const things = taken.reduce((all, thing) => [...all, { ...thing, name: freeName(all, thing.name), points: shift(thing.points), ...(thing.holes && { holes: thing.holes.map(shift) }) }], drawing.things);
  const { points, straight, radius, begin, path, start } = hasPath ? drawing : { ...other, points: shift(other.points), path: shiftedPath(other.path, by) };
  const yard = hasSquare ? drawing.yard : other.yard && shift(other.yard);
  const [origin, grid, limit] = ["origin", "grid", "limit"].map((name) => drawing[name] ?? other[name]);
  return { drawing: { ...EMPTY, points, straight, radius, begin, path, start, things, yard, origin, grid, limit }, left: other.things.filter(isLeft) };
}
