/** The picture: benches as rectangles between their handles, coloured by speed, over the faint path. */

import { colours, inType } from "./elements.js";
import { strayOf } from "./fields.js";
import { View } from "./view.js";

const SHADES = 48;
const COLOURS = ["text", "outline", "path", "circle", "head", "first", "second", "pick", "card", "halo", "thing", "ground", "drawn", "gate", "speed"];
/** Speeds closer together than this [m/s] get one colour, so that colours do not show rounding. */
const SPEED_SPREAD_MIN = 1e-9;
/** A click within this distance of a handle [px] selects it. */
const PICK_RADIUS = 22;
/** Longest scale bar [px], its distance from the edges, and its possible lengths in metres, times a power of ten. */
const [BAR, BAR_EDGE, ROUND] = [120, 14, [5, 2, 1]];
/** Number of arrows along the path, and their size [px]. */
const [ARROWS, ARROW] = [9, 5];
/** Least width of a drawn bench on a route, and least size of the head [px]. */
const [LEAST_WIDTH, HEAD] = [6, 15];
/** The head of the dragon, 2 units long, looking along x: skull with snout, horns, eyes. */
const SKULL = new Path2D("M-.6 .45Q-.1 .75 .45 .5Q.75 .4 1.1 .42Q1.35 .3 1.3 0Q1.35 -.3 1.1 -.42Q.75 -.4 .45 -.5Q-.1 -.75 -.6 -.45Q-.45 0 -.6 .45Z");
const HORNS = new Path2D("M.1 .5Q-.6 .7 -1.1 1.15Q-.9 .6 -.3 .35ZM.1 -.5Q-.6 -.7 -1.1 -1.15Q-.9 -.6 -.3 -.35Z");
const EYES = new Path2D("M.5 .27A.13 .13 0 1 1 .24 .27A.13 .13 0 1 1 .5 .27ZM.5 -.27A.13 .13 0 1 1 .24 -.27A.13 .13 0 1 1 .5 -.27Z");
/** How far a path of several dragons hides what is below it [1]. */
const WAY = 0.4;
/** Half side of the inset around the point of contact, in bench widths. */
const INSET_WIDTHS = 1.6;

/** A number of colours interpolated along a list such as "#00224e, #fee838". */
export function palette(ramp) {
  const stops = ramp.split(",").map((colour) => [1, 3, 5].map((at) => parseInt(colour.trim().slice(at, at + 2), 16)));
  return Array.from({ length: SHADES }, (_, k) => {
    const place = (k / SHADES) * (stops.length - 1);
    const [low, high] = [stops[Math.floor(place)], stops[Math.floor(place) + 1]];
    return `rgb(${low.map((one, at) => Math.round(one + (high[at] - one) * (place % 1))).join(" ")})`;
  });
}

const least = (numbers) => numbers.reduce((a, b) => Math.min(a, b));
const largest = (numbers) => numbers.reduce((a, b) => Math.max(a, b));

/** [smallest, largest] speed of a pose; null when all are equal except for rounding. */
export function speedRange({ speed }) {
  const [low, high] = [least(speed), largest(speed)];
  return [high - low > SPEED_SPREAD_MIN ? low : null, high];
}

/** Smallest and largest of rows of speeds [m/s]. */
export const spanOf = (rows) => [least(rows.map(least)), largest(rows.map(largest))];

/** The scale bar for a number of pixels per metre: {metres, pixels}, as long as fits. */
export function scaleBar(scale) {
  const rough = BAR / scale;
  const power = 10 ** Math.floor(Math.log10(rough));
  const metres = Number((ROUND.find((one) => one * power <= rough) * power).toPrecision(1));
  return { metres, pixels: metres * scale };
}

/** {overhang, width} of bench k of a dragon; listed: its benches one by one, if they are given so. */
const sizeOf = ({ listed, overhang, width }, k) => (listed ? { overhang: listed.overhangs[k], width: listed.widths[k] } : { overhang, width });

/** Corners of bench k in a drawn pose: front left, front right, rear right, rear left. least: width that it has at least [m] */
function outline({ x, y }, dragon, k, least = 0) {
  const { overhang, width: own } = sizeOf(dragon, k);
  const width = Math.max(own, least);
  const length = Math.hypot(x[k] - x[k + 1], y[k] - y[k + 1]);
  const [ux, uy] = [(x[k] - x[k + 1]) / length, (y[k] - y[k + 1]) / length];
  const [ox, oy, wx, wy] = [ux * overhang, uy * overhang, (-uy * width) / 2, (ux * width) / 2];
  const [fx, fy, rx, ry] = [x[k] + ox, y[k] + oy, x[k + 1] - ox, y[k + 1] - oy];
  return [[fx + wx, fy + wy], [fx - wx, fy - wy], [rx - wx, ry - wy], [rx + wx, ry + wy]];
}

/**
 * Adds to a path the ground that bench k of a pose covers while each of its holes is within the stray [m] of its place:
 * a side moves out by the stray between the holes, and a corner by (d + D) / chord times the stray, where d and D are
 * its distances from the two holes. The path is left open, as filling closes it.
 */
export function addGround(path, { x, y }, dragon, k, stray) {
  const { overhang, width } = sizeOf(dragon, k);
  const half = width / 2;
  const [dx, dy] = [x[k] - x[k + 1], y[k] - y[k + 1]];
  const chord = Math.hypot(dx, dy);
  const reach = (stray * (Math.hypot(overhang, half) + Math.hypot(chord + overhang, half))) / chord;
  const front = Math.atan2(dy, dx);
  [k, k + 1].forEach((hole, end) => {
    const way = front + end * Math.PI;
    const [ux, uy] = [Math.cos(way), Math.sin(way)];
    const place = (along, left) => [x[hole] + along * ux - left * uy, y[hole] + along * uy + left * ux];
    path[end ? "lineTo" : "moveTo"](...place(0, -half - stray));
    path.arc(...place(overhang, -half), reach, way - Math.PI / 2, way);
    path.arc(...place(overhang, half), reach, way, way + Math.PI / 2);
    path.lineTo(...place(0, half + stray));
  });
}

/** The two ends of an edge by its name in the service; inner is the side nearer to the centre. */
function edge(corners, name) {
  const far = (/** @type {number[][]} */ [a, b]) => Math.hypot(a[0] + b[0], a[1] + b[1]);
  const [inner, outer] = [[corners[0], corners[3]], [corners[1], corners[2]]].sort((a, b) => far(a) - far(b));
  return { front: [corners[0], corners[1]], rear: [corners[2], corners[3]], inner, outer }[name];
}

/** A path along points [x, y], added to another. */
export function trace(points, path = new Path2D(), isClosed = true) {
  points.forEach(([x, y], k) => (k ? path.lineTo(x, y) : path.moveTo(x, y)));
  if (isClosed) path.closePath();
  return path;
}

/** A smooth line through the middles of the given points. */
function smooth({ x, y }) {
  const path = new Path2D();
  path.moveTo(x[0], y[0]);
  for (let k = 1; k < x.length - 1; k++) path.quadraticCurveTo(x[k], y[k], (x[k] + x[k + 1]) / 2, (y[k] + y[k + 1]) / 2);
  path.lineTo(x.at(-1), y.at(-1));
  return path;
}

/** Draws in metres on a cleared canvas centred at (x, y); radii and line widths are in pixels. */
class Pen {
  constructor(canvas, { x, y, scale, width: wide, height: high }) {
    const [width, height] = [wide, high].map((size) => Math.round(size * devicePixelRatio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const [context, zoom] = [canvas.getContext("2d"), scale * devicePixelRatio];
    context.resetTransform();
    context.clearRect(0, 0, width, height);
    context.setTransform(zoom, 0, 0, -zoom, width / 2 - x * zoom, height / 2 + y * zoom);
    this.context = context;
    this.scale = scale;
    /** Boxes of the names that are drawn, [left, bottom, width]. @type {number[][]} [px] */
    this.names = [];
    this.left = x - wide / (2 * scale);
    this.top = y + high / (2 * scale);
    this.right = x + wide / (2 * scale);
  }

  fill(path, colour) {
    this.context.fillStyle = colour;
    this.context.fill(path);
  }

  stroke(path, colour, width = 1) {
    Object.assign(this.context, { strokeStyle: colour, lineWidth: width / this.scale });
    this.context.stroke(path);
  }

  /** An arrow's tip at (x, y) towards the direction (dx, dy); size: [px] */
  tip(x, y, dx, dy, size) {
    const reach = size / this.scale / Math.hypot(dx, dy);
    const [ux, uy] = [dx * reach, dy * reach];
    return trace([[x - ux - uy, y - uy + ux], [x, y], [x - ux + uy, y - uy - ux]], new Path2D(), false);
  }

  /** The scale, at the lower right. */
  bar(words, pixels, colour, halo) {
    const { context } = this;
    const { width, height } = context.canvas;
    context.save();
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    const [right, bottom] = [width / devicePixelRatio - BAR_EDGE, height / devicePixelRatio - BAR_EDGE];
    Object.assign(context, { font: `600 ${inType(12)}px system-ui, sans-serif`, textAlign: "center", lineJoin: "round" });
    for (const [strokeStyle, lineWidth] of [[halo, 5], [colour, 2]]) {
      Object.assign(context, { strokeStyle, lineWidth });
      context.beginPath();
      for (const [x, y] of [[right - pixels, bottom - 6], [right - pixels, bottom], [right, bottom], [right, bottom - 6]]) context.lineTo(x, y);
      context.stroke();
    }
    Object.assign(context, { strokeStyle: halo, lineWidth: 4, fillStyle: colour });
    context.strokeText(words, right - pixels / 2, bottom - 6);
    context.fillText(words, right - pixels / 2, bottom - 6);
    context.restore();
  }

  circle(x, y, radius) {
    const path = new Path2D();
    path.arc(x, y, radius / this.scale, 0, 2 * Math.PI);
    return path;
  }

  label(text, x, y, colour, halo) {
    const { context, scale } = this;
    context.save();
    context.translate(x, y);
    context.scale(1 / scale, -1 / scale);
    Object.assign(context, { font: `600 ${inType(14)}px system-ui, sans-serif`, lineWidth: 4, lineJoin: "round", strokeStyle: halo, fillStyle: colour });
    const { width } = context.measureText(text);
    const from = x + (10 + width) / scale > this.right ? -10 - width : 10;
    this.names.push([(x - this.left) * scale + from, (this.top - y) * scale - 10, width]);
    context.strokeText(text, from, -10);
    context.fillText(text, from, -10);
    context.restore();
  }
}

export class Dance {
  /**
   * pose {x, y, speed}, its dragon {width, overhang, stray, hole, pin}, contact: the service's answer while its instant is shown, handle:
   * the chosen one, names of head and handle, circle: radius of the turning circle [m]; speeds: [lowest, highest] of the
   * whole dance [m/s], which have the first and the last colour; null: those of the pose
   */
  scene = { pose: null, dragon: null, contact: null, handle: null, headName: "", handleName: "", circle: null, speeds: null };
  /** Functions of a pen and the colours that draw additional layers: below the benches, and above them. */
  below = [];
  above = [];
  /** (x, y) -> whether a tap there was for a drawing [px]; null: none is edited */
  tapped = null;
  /** True if the path is drawn by hand, so that it must be clearly visible. */
  drawn = false;
  #path = null;
  #points = null;
  #around = [];
  /** Paths of several dragons: {x, y, line, colour} */
  #ways = [];
  #bounds = null;
  #colours = {};
  #palette = [];

  constructor(canvas, inset, { moved, picked }) {
    this.canvas = canvas;
    this.inset = inset;
    this.view = new View(canvas, { moved, clicked: (x, y) => this.tapped?.(x, y) || picked(this.#nearest(x, y)) });
    this.restyle();
  }

  restyle() {
    this.view.measure();
    const colour = colours(this.canvas);
    for (const name of COLOURS) this.#colours[name] = colour(name);
    this.#palette = palette(colour("ramp"));
  }

  /** The path of the head, {x, y}, as sampled by the service, or null; around: further points [x, y] to be shown. */
  setPath(path, around = []) {
    [this.#path, this.#points, this.#around] = [path && smooth(path), path, around];
    this.#bound();
  }

  /** The paths of several dragons, each {x, y, colour}. */
  setWays(ways) {
    this.#ways = ways.map((way) => ({ ...way, line: smooth(way) }));
    this.#bound();
  }

  /** What must be visible. */
  #bound() {
    const [xs, ys] = ["x", "y"].map((axis, k) => [...(this.#points?.[axis] ?? []), ...this.#ways.flatMap((way) => way[axis]), ...this.#around.map((point) => point[k])]);
    if (xs.length) this.#bounds = [least(xs), least(ys), largest(xs), largest(ys)];
  }

  draw() {
    const { pose, circle } = this.scene;
    if (this.view.fitted && this.#bounds && this.view.width) this.view.fit(this.#bounds);
    const [pen, colours] = [new Pen(this.canvas, this.view), this.#colours];
    for (const layer of this.below) layer(pen, colours);
    if (this.#path) this.#drawPath(pen);
    pen.context.globalAlpha = WAY;
    for (const { line, colour } of this.#ways) pen.stroke(line, colour, 2);
    pen.context.globalAlpha = 1;
    if (circle > 0 && !this.scene.parts) pen.stroke(pen.circle(0, 0, circle * pen.scale), colours.circle, 1.5);
    const { metres, pixels } = scaleBar(this.view.scale);
    pen.bar(`${metres} m`, pixels, colours.text, colours.card);
    if (pose) this.#drawDragon(pen);
    for (const layer of this.above) layer(pen, colours);
  }

  /** What is drawn: the dragon, or each of several as {pose, dragon, colour, name}. @type {any[]} */
  get #parts() {
    return this.scene.parts ?? [this.scene];
  }

  #drawDragon(pen) {
    const { pose, contact, handle, headName, handleName } = this.scene;
    const colours = this.#colours;
    for (const part of this.#parts) {
      this.#grounds(pen, part);
      this.#benches(pen, part);
      pen.stroke(this.bench(0, new Path2D(), part), part.colour ?? colours.head, 2.5);
    }
    if (contact) this.#pair(pen);
    if (contact?.point) pen.stroke(pen.circle(...contact.point, 9), colours.text, 3);
    const [[x], [y]] = [pose.x, pose.y];
    for (const part of this.#parts) {
      this.#drawHead(pen, part);
      if (part.name) pen.label(part.name, part.pose.x[0], part.pose.y[0], part.colour, colours.card);
    }
    if (!this.scene.parts) pen.label(headName, x, y, colours.head, colours.card);
    if (handle !== null && handle < pose.x.length) {
      const [x, y] = [pose.x[handle], pose.y[handle]];
      pen.stroke(pen.circle(x, y, 8), colours.pick, 3);
      if (handle > 0) pen.label(handleName, x, y, colours.pick, colours.card);
    }
    if (contact?.point) this.#drawInset();
  }

  /** Number of handles, and weight of the point of contact, in each rectangle {left, top, right, bottom} [px]. */
  covered(rectangles) {
    const { pose, contact } = this.scene;
    const places = Array.from(pose.x, (x, k) => this.view.toScreen(x, pose.y[k]));
    const point = contact?.point ? this.view.toScreen(contact.point[0], contact.point[1]) : [NaN, NaN];
    return rectangles.map(({ left, top, right, bottom }) => {
      const isUnder = (place) => place[0] > left && place[0] < right && place[1] > top && place[1] < bottom;
      return places.filter(isUnder).length + (isUnder(point) ? places.length : 0);
    });
  }

  /** The path, with arrows in the direction of travel. */
  #drawPath(pen) {
    const { x, y } = this.#points;
    pen.stroke(this.#path, this.drawn ? this.#colours.drawn : this.#colours.path, this.drawn ? 2 : 1);
    for (let k = 1; k <= ARROWS; k++) {
      const at = Math.round((k * (x.length - 1)) / (ARROWS + 1));
      if (at > 0) pen.stroke(pen.tip(x[at], y[at], x[at] - x[at - 1], y[at] - y[at - 1], ARROW), this.#colours.circle, 1.5);
    }
  }

  /** Least width of a drawn bench [m], so that a dragon on a long route is no hairline; a spiral has no room for it. */
  #leastWidth(scale) {
    return this.drawn ? LEAST_WIDTH / scale : 0;
  }

  /** The head of the dragon, from above, at the front end of its bench. */
  #drawHead(pen, { pose: { x, y }, dragon, colour: own }) {
    const { overhang, width } = sizeOf(dragon, 0);
    const way = Math.atan2(y[0] - y[1], x[0] - x[1]);
    const size = Math.max(1.5 * Math.max(width, this.#leastWidth(pen.scale)), HEAD / pen.scale);
    const { context } = pen;
    context.save();
    context.translate(x[0] + overhang * Math.cos(way), y[0] + overhang * Math.sin(way));
    context.rotate(way);
    context.scale(size, size);
    Object.assign(context, { lineWidth: 1.5 / (size * pen.scale), lineJoin: "round", strokeStyle: this.#colours.card });
    for (const [shape, colour] of [[HORNS, "text"], [SKULL, "head"], [EYES, "card"]]) {
      context.fillStyle = (colour === "head" && own) || this.#colours[colour];
      context.fill(shape);
      if (shape === SKULL) context.stroke(shape);
    }
    context.restore();
  }

  /** Outline of bench k in the picture. part: its dragon, one of several */
  bench(k, path = new Path2D(), /** @type {any} */ { pose, dragon } = this.scene) {
    return trace(outline(pose, dragon, k, this.#leastWidth(this.view.scale)), path);
  }

  #benches(pen, /** @type {any} */ { pose, dragon, colour, speeds = null }) {
    const [low, high] = speeds ?? speedRange(pose);
    const paths = this.#palette.map(() => new Path2D());
    const share = (speed) => Math.min(Math.max((speed - low) / (high - low), 0), 1);
    const shade = (speed) => (colour || low === null || high - low < SPEED_SPREAD_MIN ? SHADES - 1 : Math.round(share(speed) * (SHADES - 1)));
    for (let k = pose.x.length - 2; k >= 0; k--) {
      const corners = outline(pose, dragon, k, this.#leastWidth(pen.scale));
      trace([...corners, corners[0]], paths[shade(pose.speed[k])], false); // in Chromium each closePath() looks at the whole path
    }
    const all = new Path2D();
    paths.forEach((path, k) => {
      pen.fill(path, colour ?? this.#palette[k]);
      all.addPath(path);
    });
    pen.stroke(all, this.#colours.outline);
  }

  /** The ground that the benches may cover, as one band. */
  #grounds(pen, { pose, dragon }) {
    const [path, stray] = [new Path2D(), strayOf(dragon)];
    if (!(stray > 0)) return;
    for (let k = pose.x.length - 2; k >= 0; k--) addGround(path, pose, dragon, k, stray);
    pen.fill(path, this.#colours.halo);
  }

  /** The two benches that touch. */
  #pair(pen) {
    const { benches, dragons = [0, 0] } = this.scene.contact;
    benches.forEach((bench, k) => {
      const path = this.bench(bench, new Path2D(), this.#parts[dragons[k]]);
      pen.fill(path, this.#colours[k ? "second" : "first"]);
      pen.stroke(path, this.#colours.text);
    });
  }

  /** The two benches enlarged around the point where they meet. */
  #drawInset() {
    const { pose, dragon, contact } = this.scene;
    const [x, y] = contact.point;
    const { clientWidth: width, clientHeight: height } = this.inset;
    const pen = new Pen(this.inset, { x, y, scale: height / (2 * INSET_WIDTHS * dragon.width), width, height });
    for (const part of this.#parts) this.#grounds(pen, part);
    for (const part of this.#parts) this.#benches(pen, part);
    this.#pair(pen);
    if (contact.edge) {
      const ends = edge(outline(pose, dragon, contact.edge.bench), contact.edge.name);
      pen.stroke(trace(ends), this.#colours.text, 4);
    }
    pen.fill(pen.circle(x, y, 6), this.#colours.card);
    pen.stroke(pen.circle(x, y, 6), this.#colours.text, 3);
  }

  #nearest(px, py) {
    const { pose } = this.scene;
    return pose && this.view.nearest(pose, px, py, PICK_RADIUS);
  }
}
