/** A dragon that comes in behind another one on the same path: its street of entry is longer, and the other one goes on further. */

import { place } from "./drawing.js";
import { streetLength } from "./square.js";
import { roundedRoute } from "./walk.js";

/** Room between the two dragons beside that of a street [m]; how far beside a path the corners of its street stand [m]. */
const [GAP, STREET_HALF] = [1, 10];
/** Largest difference of two numbers of the same place [m]. */
const SAME = 1e-3;
/** How far beside the street of another path one may end in the same street [m]. */
const BESIDE = 0.05;

const along = ([x, y], [ax, ay]) => {
  const length = Math.hypot(ax - x, ay - y);
  return length > SAME ? [(ax - x) / length, (ay - y) / length] : null;
};
/** @returns {[number, number]} the point that is so far away in a direction [m] */
const shifted = (point, way, length) => [point[0] + length * way[0], point[1] + length * way[1]];

/** The first or the last leg of a drawn path, if it is straight: {end, out: direction away from the path}; else null. */
function streetOf({ points, straight, path }, isFirst) {
  const piece = path?.pieces?.at(isFirst ? 0 : -1);
  if (path && piece?.kind !== "line") return null;
  if (!path && (points.length < 2 || !straight.includes(isFirst ? 0 : points.length - 2))) return null;
  const ends = path ? [piece.start, piece.end] : [points.at(isFirst ? 0 : -2), points.at(isFirst ? 1 : -1)];
  const [inner, end] = isFirst ? [ends[1], ends[0]] : ends;
  const out = along(inner, end);
  return out && { end, out };
}

/** The drawing with its path longer by a length at its first or last leg [m]; null if that leg is bent. */
function longer(drawing, isFirst, length) {
  const street = streetOf(drawing, isFirst);
  if (!street) return null;
  const { points, path } = drawing;
  const end = shifted(street.end, street.out, length);
  if (!path) return { ...drawing, points: points.with(isFirst ? 0 : points.length - 1, place(end)) };
  const k = isFirst ? 0 : path.pieces.length - 1;
  return { ...drawing, path: roundedRoute({ ...path, pieces: path.pieces.with(k, { ...path.pieces[k], [isFirst ? "start" : "end"]: end }) }) };
}

/** The things with the street around one end of a path longer by a length [m], which stands beyond the square. */
function withStreet(drawing, isFirst, length) {
  const { end, out } = streetOf(drawing, isFirst);
  const isBeyond = ([x, y]) => {
    const [dx, dy] = [x - end[0], y - end[1]];
    return dx * out[0] + dy * out[1] > 0 && Math.abs(dx * out[1] - dy * out[0]) < STREET_HALF;
  };
  return drawing.things.map((thing) => (thing.kind === "area" ? { ...thing, points: thing.points.map((point) => (isBeyond(point) ? place(shifted(point, out, length)) : point)) } : thing));
}

/**
 * The drawings of a dragon and of one that follows it: {ahead, behind, things}, or null where a street is bent, or
 * ends with a square that somebody has drawn. numbers, own: of the dragon ahead and of the other, as `streetLength` takes them
 */
export function queued(drawing, numbers, own) {
  if (!drawing.yard && drawing.things.some(({ kind }) => kind === "area")) return null;
  const most = Math.max(streetLength(numbers), streetLength(own));
  const length = most + GAP;
  const [ahead, behind] = [longer(drawing, false, length), longer(drawing, true, length)];
  if (!ahead || !behind) return null;
  const things = withStreet({ ...drawing, things: withStreet(drawing, true, length) }, false, length);
  // Who follows begins as far behind the tail of the one ahead, and may be the longer one.
  return { ahead, behind: { ...behind, begin: Number((drawing.begin + most - streetLength(numbers)).toFixed(4)) }, things };
}

/** True if a drawn path ends, or begins, where another one does, or further out in the same street. isFirst: it begins */
export function isFurther(drawing, other, isFirst) {
  const [one, last] = [drawing, other].map((each) => streetOf(each, isFirst));
  if (!one || !last) return false;
  const [dx, dy] = one.end.map((number, axis) => number - last.end[axis]);
  return dx * last.out[0] + dy * last.out[1] > -BESIDE && Math.abs(dx * last.out[1] - dy * last.out[0]) < BESIDE;
}
