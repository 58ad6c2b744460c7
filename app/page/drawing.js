/**
 * A drawing: the path through its points, and the things in the square. Drawings are never changed, only replaced.
 *
 * points: [[x, y]] [m]; straight: numbers of the legs that are straight; radius: of rounded corners [m]; begin: place of
 * the head at time 0 [m]; limit: of every speed [m/s] or null; path: a proposed one, or one from a file that is no list of
 * points, or null: it is danced until a point is edited; start: of the dance [s], or null: with the whole dragon on the path
 * things: [{kind, name, points, radius, holes, heading, use, street_width, street_length}]: one area to stay in, blocks,
 * circles, walls, lanes to keep free, and gates, which are both way in and way out unless their use is in or out, and
 * whose heading [rad] is null if it is straight into the square; origin: of a map, or null
 * grid: {x, y}, the place of x = y = 0 on the survey grid of a map [m], or null
 * yard: corners of the area without the streets that a proposal has added beyond its gates, or null
 */

import { piecesOf, walkText } from "./walk.js";

/** Kinds of things in a drawing. @type {Phrases} */
export const THINGS = {
  area: "square",
  block: "obstacle",
  circle: "tree",
  wall: "wall",
  gate: "gate",
  lane: "emergency lane",
};

export const EMPTY = { points: [], straight: [], radius: 5, begin: 0, limit: null, path: null, start: null, things: [], origin: null, grid: null, yard: null };
/** Names of the parts of a drawing in an address. */
export const PARTS = ["route", "corner", "begin", "limit", "things", "raw", "walk", "start", "origin", "grid", "yard"];
/** Half a side of the ground without a drawn area [m]. */
const FAR = 90_000;
const DECIMALS = 4;
const NUMBER = /^-?\d+(\.\d+)?(e-?\d+)?$/;
/** Roles of features that no bench can touch, in the service's words. */
const [GATE, YARD, LANE] = ["gate", "square without streets", "emergency lane"];
/** Half of the width of a lane without one [m]. */
export const LANE_RADIUS = 1.75;
const LANE_NAME_MOST = 40;
const KINDS = { a: "area", b: "block", c: "circle", w: "wall", g: "gate", l: "lane" };

const rounded = (number) => Number(number.toFixed(DECIMALS));
export const place = ([x, y]) => [rounded(x), rounded(y)];

/** The path in the service's format. */
export function pathOf({ points, straight, radius, begin, path }) {
  if (path) return "start" in path ? { ...path, start: begin } : path;
  const drawn = { kind: "waypoints", points, straight };
  if (straight.some((leg) => straight.includes(leg + 1))) drawn.radius = radius;
  if (begin) drawn.start = begin;
  return drawn;
}

const closed = (points) => [...points, points[0]];
const needs = { area: 3, block: 3, circle: 1, wall: 2, gate: 1, lane: 2 };
/** True if a thing has as many points as its kind needs. */
export const isWhole = ({ kind, points }) => points.length >= needs[kind];

/** Names of the things that have fewer points than their kind needs, of which no file has a form. */
export const unfinishedOf = ({ things }) => things.filter((thing) => !isWhole(thing)).map(({ name }) => name);

function featureOf(thing) {
  const { kind, name, points, radius, holes = [] } = thing;
  const properties = kind === "circle" || kind === "wall" ? { name, radius } : { name };
  const geometry = {
    circle: () => ({ type: "Point", coordinates: points[0] }),
    wall: () => ({ type: "LineString", coordinates: points }),
  }[kind] ?? (() => ({ type: "Polygon", coordinates: [points, ...holes].map(closed) }));
  return { type: "Feature", properties, geometry: geometry() };
}

/** What only gates have, of a gate or of the properties of a feature. */
const OWN = ["heading", "use", "street_width", "street_length"];
const isOwn = { use: (value) => ["in", "out"].includes(value) };
export const ownOf = (gate) => Object.fromEntries(OWN.map((name) => [name, gate[name]]).filter(([name, value]) => (isOwn[name] ?? Number.isFinite)(value)));

export const isArea = ({ kind }) => kind === "area";
/** True for a thing of points in a row, with a width. */
export const isLine = ({ kind }) => kind === "wall" || kind === "lane";
/** True for what no bench can touch. */
const isAside = ({ kind }) => kind === "gate" || kind === "lane";
/** The corners of the square without added streets; none if it has no area. */
export const yardOf = ({ things, yard }) => yard ?? things.find((thing) => isArea(thing) && isWhole(thing))?.points ?? [];

/** The venue in the service's format; null without one. */
export const venueOf = (drawing) => venueWith(drawing, []);

/** The venue with features that no bench can touch; null without anything. What has no area stands on an endless plain. */
function venueWith({ things, origin, grid }, asides) {
  const whole = things.filter((thing) => isWhole(thing) && !isAside(thing));
  if (!whole.length && !asides.length) return null;
  const corners = [[-FAR, -FAR], [FAR, -FAR], [FAR, FAR], [-FAR, FAR]];
  const ground = whole.find(isArea) ?? { kind: "area", name: freeName(things, "plain"), points: corners };
  const features = [...[ground, ...whole.filter((thing) => thing !== ground)].map(featureOf), ...asides];
  return { type: "FeatureCollection", ...(origin && { origin }), ...(grid && { grid }), features };
}

/** The venue as a file keeps it: with the gates, the lanes, and the square without the streets that were added to it. */
export function keptVenueOf(drawing) {
  const [gates, lanes] = ["gate", "lane"].map((kind) => drawing.things.filter((thing) => thing.kind === kind && isWhole(thing)));
  const asides = [
    ...gates.map((gate) => aside("Point", gate.points[0], { name: gate.name, role: GATE, ...ownOf(gate) })),
    ...lanes.map(({ name, points, radius }) => aside("LineString", points, { name, role: LANE, radius })),
    ...(drawing.yard ? [aside("LineString", closed(drawing.yard), { role: YARD })] : []),
  ];
  return venueWith(drawing, asides);
}

/** The lanes to keep free as the safety sheet takes them beside a dance, for a drawing in which nothing else stands. */
export const lanesOf = ({ things }) => things.filter((thing) => thing.kind === "lane" && isWhole(thing)).map(({ name, points, radius }) => ({ name: name.slice(0, LANE_NAME_MOST), points, width: 2 * radius }));

const aside = (type, coordinates, properties) => ({ type: "Feature", properties, geometry: { type, coordinates } });

/** Path, venue and speeds of the dance: the fields of /check that are not null. */
export function placeOf(drawing) {
  const [venue, limit, start] = [venueOf(drawing), drawing.limit, drawing.start];
  return { ...(venue && { venue }), ...(limit && { speed_limit: limit }), ...(start !== null && { start }) };
}

/** A name that no other thing has. */
export function freeName(things, name, own = null) {
  const taken = new Set(things.filter((thing) => thing !== own).map((thing) => thing.name));
  for (let k = 1; ; k++) {
    const free = k === 1 ? name : `${name} ${k}`;
    if (!taken.has(free)) return free;
  }
}

const featuresOf = (venue) => (venue.type === "FeatureCollection" ? venue.features : [venue.type === "Feature" ? venue : { properties: {}, geometry: venue }]);
const isYard = ({ properties, geometry: { type } }) => properties?.role === YARD && type === "LineString";

/** Things of a GeoJSON venue, the square first, as in the service. nameOf(kind): of one without a name */
function thingsOf(venue, nameOf) {
  const things = [];
  for (const { properties, geometry } of featuresOf(venue)) {
    const { type, coordinates } = geometry;
    const addThing = (kind, points, more) => things.push({ kind, name: properties?.name ? freeName(things, properties.name) : "", points, ...more });
    if (properties?.role === GATE && type === "Point") addThing("gate", [place(coordinates)], ownOf(properties));
    else if (isYard({ properties, geometry })) continue;
    else if (properties?.role === LANE && type === "LineString") addThing("lane", coordinates.map(place), { radius: properties.radius ?? LANE_RADIUS });
    else if (type === "Point") addThing("circle", [place(coordinates)], { radius: properties.radius });
    else if (type === "LineString") addThing("wall", coordinates.map(place), { radius: properties.radius });
    else if (type === "Polygon") {
      const [outer, ...holes] = coordinates.map((ring) => ring.slice(0, -1).map(place));
      addThing("block", outer, holes.length ? { holes } : {});
    }
  }
  const square = things.find(({ kind, name }) => kind === "block" && name === "square") ?? things.find(({ kind }) => kind === "block");
  if (square) square.kind = "area";
  for (const thing of things) thing.name ||= freeName(things, nameOf(thing.kind));
  return things.filter(({ points, kind }) => kind !== "area" || Math.abs(points[0][0]) < FAR);
}

/** The drawing of a dance from a request of /check, or from an answer of /places. nameOf(kind): of a thing without a name */
export function drawingOf({ path, venue, speed_limit: limit, start = null }, nameOf = (kind) => kind) {
  const { origin = null, grid = null } = venue ?? {};
  const yard = venue ? featuresOf(venue).find(isYard) : null;
  const drawing = { ...EMPTY, limit: limit ?? null, things: venue ? thingsOf(venue, nameOf) : [], origin, grid, yard: yard ? yard.geometry.coordinates.slice(0, -1).map(place) : null };
  if (!path) return drawing;
  return { ...drawing, start, ...(legsOf(path) ?? { path, points: [], begin: path.start ?? 0 }) };
}

/** The points and straight legs of a path, if it consists of lines and of curves that follow them. */
function legsOf(path) {
  const begin = path.start ?? 0;
  const isFree = (heading) => heading === undefined || heading === null;
  if (path.kind === "waypoints" && isFree(path.start_heading) && isFree(path.end_heading)) {
    return { points: path.points, straight: path.straight ?? [], radius: path.radius ?? EMPTY.radius, begin };
  }
  const isFirst = (k) => k === 0;
  const isLast = (k) => k === path.pieces.length - 1;
  const free = ({ kind, start_heading: first, end_heading: last }, k) =>
    kind === "line" || (kind === "waypoints" && (isFirst(k) ? isFree(first) : path.pieces[k - 1].kind === "line") && (isLast(k) ? isFree(last) : path.pieces[k + 1].kind === "line"));
  if (path.kind !== "route" || !path.pieces.every(free)) return null;
  const points = [];
  const straight = [];
  for (const piece of path.pieces) {
    const more = piece.kind === "line" ? [piece.start, piece.end] : piece.points;
    if (piece.kind === "line") straight.push(Math.max(points.length - 1, 0));
    points.push(...(points.length ? more.slice(1) : more));
  }
  return { points: points.map(place), straight, begin };
}

const pointsText = (points) => points.map(([x, y]) => `${x},${y}`).join("_");
const pointsIn = (text) => text.split("_").map((point) => point.replace(/^\*/, "").split(",").map(Number));
/** Names in an address: the characters that separate things are escaped. */
const escaped = (name) => encodeURIComponent(name).replace(/[~_.!'()*-]/g, (one) => `%${one.charCodeAt(0).toString(16)}`).replaceAll("%", "-");
const unescaped = (name) => decodeURIComponent(name.replaceAll("-", "%"));

/** The text of a path that gives it back to every digit, or an empty text. */
export function walkOf(path) {
  const text = path && "start" in path && walkText(path);
  return text && JSON.stringify(piecesOf(text)) === JSON.stringify(path.pieces) ? text : "";
}

/** The same of a gate as the text of an address, and back: a text without commas is its heading alone, as in old addresses. */
const gateText = (gate) => OWN.map((name) => gate[name] ?? "").join(",").replace(/,+$/, "");
const gateIn = (text) => ownOf(Object.fromEntries(text.split(",").map((one, k) => [OWN[k], OWN[k] === "use" ? one : one && Number(one)])));

/** Parts of an address: name -> text. The points of a path that is written as a walk follow from it. */
export function toAddress(drawing) {
  const { points, straight, radius, begin, limit, things, path, start, origin, grid, yard } = drawing;
  const legs = points.map(([x, y], k) => `${straight.includes(k) ? "*" : ""}${x},${y}`).join("_");
  const texts = things.map(({ kind, name, points: own, radius: wide = "", holes = [], ...gate }) =>
    [kind[0], escaped(name), ...[kind === "gate" ? gateText(gate) : String(wide), ...[own, ...holes].map(pointsText)].map((part) => part.replaceAll(".", "!"))].join("."),
  );
  const walk = walkOf(path);
  const parts = {
    route: walk ? "" : legs,
    corner: radius === EMPTY.radius ? "" : radius,
    begin: begin || "",
    limit: limit ?? "",
    things: texts.join("~"),
    walk,
    raw: path && !walk ? JSON.stringify(pathOf(drawing)) : "",
    start: start ?? "",
    origin: origin ? `${origin.longitude},${origin.latitude}` : "",
    grid: grid ? `${grid.x},${grid.y}` : "",
    yard: yard ? pointsText(yard) : "",
  };
  return Object.entries(parts).filter(([, text]) => text !== "");
}

/** The drawing in an address; unreadable parts are left out. address: URLSearchParams */
export function fromAddress(address) {
  const number = (name, otherwise) => (NUMBER.test(address.get(name) ?? "") ? Number(address.get(name)) : otherwise);
  const finite = (points) => points.every((point) => point.length === 2 && point.every(Number.isFinite));
  const drawing = { ...EMPTY, radius: number("corner", EMPTY.radius), begin: number("begin", 0), limit: number("limit", null), start: number("start", null) };
  try {
    const legs = address.get("route") ?? "";
    const points = legs ? pointsIn(legs) : [];
    if (finite(points)) Object.assign(drawing, { points, straight: legs.split("_").flatMap((text, k) => (text.startsWith("*") ? [k] : [])) });
    for (const text of address.get("things")?.split("~") ?? []) {
      const [kind, name, wide, own, ...holes] = text.split(".").map((one) => one.replaceAll("!", "."));
      const thing = { kind: KINDS[kind], name: unescaped(name), points: own ? pointsIn(own) : [] };
      if (wide) Object.assign(thing, thing.kind === "gate" ? gateIn(wide) : { radius: Number(wide) });
      if (holes.length) thing.holes = holes.map(pointsIn);
      if (thing.kind && finite(thing.points)) drawing.things = [...drawing.things, thing];
    }
    if (address.has("walk")) drawing.path = { kind: "route", start: drawing.begin, pieces: piecesOf(address.get("walk")) };
    if (address.has("raw")) drawing.path = JSON.parse(address.get("raw"));
    if (drawing.path && !address.has("begin")) drawing.begin = drawing.path.start ?? 0;
    const yard = pointsIn(address.get("yard") ?? "");
    if (address.has("yard") && finite(yard)) drawing.yard = yard;
    const [longitude, latitude] = (address.get("origin") ?? "").split(",").map(Number);
    if (address.has("origin")) drawing.origin = { longitude, latitude };
    const [x, y] = (address.get("grid") ?? "").split(",").map(Number);
    if (address.has("grid") && finite([[x, y]])) drawing.grid = { x, y };
  } catch {
    // An address that was cut off still opens with its readable part.
  }
  return drawing;
}
