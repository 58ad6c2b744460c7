/** The picture: benches as rectangles between their handles, coloured by speed, over the faint path. */

import { colours } from "./elements.js";
import { strayOf } from "./fields.js";
import { Pen, SHADES, addGround, edge, outline, palette, scaleBar, sizeOf, smooth, trace } from "./pen.js";
import { View } from "./view.js";

const COLOURS = ["text", "outline", "path", "circle", "head", "first", "second", "pick", "card", "halo", "thing", "ground", "drawn", "gate", "lane", "speed"];
/** Speeds closer together than this [m/s] get one colour, so that colours do not show rounding. */
const SPEED_SPREAD_MIN = 1e-9;
/** A click within this distance of a handle [px] selects it. */
const PICK_RADIUS = 22;
/** Number of arrows along the path, and their size [px]. */
const [ARROWS, ARROW] = [9, 5];
/** Least width of a drawn bench on a route, and least size of the head [px]. */
const [LEAST_WIDTH, HEAD] = [6, 15];
/** The head of the dragon, 2 units long, looking along x: skull with snout, horns, eyes. */
const SKULL = new Path2D("M-.6 .45Q-.1 .75 .45 .5Q.75 .4 1.1 .42Q1.35 .3 1.3 0Q1.35 -.3 1.1 -.42Q.75 -.4 .45 -.5Q-.1 -.75 -.6 -.45Q-.45 0 -.6 .45Z");
const HORNS = new Path2D("M.1 .5Q-.6 .7 -1.1 1.15Q-.9 .6 -.3 .35ZM.1 -.5Q-.6 -.7 -1.1 -1.15Q-.9 -.6 -.3 -.35Z");
const EYES = new Path2D("M.5 .27A.13 .13 0 1 1 .24 .27A.13 .13 0 1 1 .5 .27ZM.5 -.27A.13 .13 0 1 1 .24 -.27A.13 .13 0 1 1 .5 -.27Z");
/** How far a path of several dragons, and an outdated dragon on a drawn path, hide what is below them [1]. */
const [WAY, FADED] = [0.4, 0.4];
/** Half side of the inset around the point of contact, in bench widths. */
const INSET_WIDTHS = 1.6;
/** Room for the inset on a phone; a drawn path, which may be wide, has no room for it [px]. */
const INSET = 100;

const least = (numbers) => numbers.reduce((a, b) => Math.min(a, b));
const largest = (numbers) => numbers.reduce((a, b) => Math.max(a, b));

/** [smallest, largest] speed of a pose; null when all are equal except for rounding. */
export function speedRange({ speed }) {
  const [low, high] = [least(speed), largest(speed)];
  return [high - low > SPEED_SPREAD_MIN ? low : null, high];
}

/** Smallest and largest of rows of speeds [m/s]. */
export const spanOf = (rows) => [least(rows.map(least)), largest(rows.map(largest))];

export class Dance {
  /**
   * pose {x, y, speed}, its dragon {width, overhang, stray, hole, pin}, contact: the service's answer while its instant is shown, handle:
   * the chosen one, names of head and handle, circle: radius of the turning circle [m]; speeds: [lowest, highest] of the
   * whole dance [m/s], which have the first and the last colour; null: those of the pose; parts: several dragons, or null;
   * faded: not of the numbers as they are
   */
  scene = { pose: null, dragon: null, contact: null, handle: null, headName: "", handleName: "", circle: null, speeds: null, parts: null, faded: false };
  /** Functions of a pen and the colours that draw additional layers: the ground, names over which the dragon passes, and what is above it. */
  below = [];
  names = [];
  above = [];
  /** (x, y) -> whether a tap there was for a drawing [px]; null: none is edited */
  tapped = null;
  /** Called with the number of the dragon of several whose head is tapped, if it is not the chosen one. @type {((k: number) => void) | null} */
  headTapped = null;
  /** True if the path is drawn by hand, so that it must be clearly visible. */
  drawn = false;
  #path = null;
  #points = null;
  #around = [];
  /** Corners of a square with streets, or null; and whether the streets are shown too. */
  #yard = null;
  #beyond = false;
  /** Layers that are hidden: things, photo, measures, marks, dragons. @type {Set<string>} */
  hidden = new Set();
  /** Where names of things are drawn: {k: number of the thing, left, bottom, width}. @type {{ k: number, left: number, bottom: number, width: number }[]} [px] */
  labels = [];
  /** Paths of several dragons: {x, y, line, colour} */
  #ways = [];
  #bounds = null;
  #colours = {};
  #palette = [];

  constructor(canvas, inset, { moved, picked }) {
    this.canvas = canvas;
    this.inset = inset;
    this.view = new View(canvas, { moved, clicked: (x, y) => this.#isHead(x, y) || this.tapped?.(x, y) || picked(this.#nearest(x, y)) });
    this.restyle();
  }

  restyle() {
    this.view.measure();
    const colour = colours(this.canvas);
    for (const name of COLOURS) this.#colours[name] = colour(name);
    this.#palette = palette(colour("ramp"));
  }

  /**
   * The path of the head, {x, y}, as sampled by the service, or null
   * around: further points [x, y] to be shown; yard: corners of a square with streets, which is shown without them at first, or null
   */
  setPath(path, around = [], yard = null) {
    this.#beyond &&= yard === this.#yard;
    [this.#path, this.#points, this.#around, this.#yard] = [path && smooth(path), path, around, yard];
    this.#bound();
  }

  /** Show all; of a square with streets the square, and what is beyond it as well if that is what is shown. */
  showAll() {
    this.#beyond = this.view.fitted && !this.#beyond;
    this.view.fitted = true;
    this.#bound();
  }

  /** The paths of several dragons, each {x, y, colour}. */
  setWays(ways) {
    this.#ways = ways.map((way) => ({ ...way, line: smooth(way) }));
    this.#bound();
  }

  /** What must be visible. */
  #bound() {
    const isYard = this.#yard && !this.#ways.length && !this.#beyond;
    const [xs, ys] = ["x", "y"].map((axis, k) => (isYard ? this.#yard.map((corner) => corner[k]) : [...(this.#points?.[axis] ?? []), ...this.#ways.flatMap((way) => way[axis]), ...this.#around.map((point) => point[k])]));
    if (xs.length) this.#bounds = [least(xs), least(ys), largest(xs), largest(ys)];
  }

  draw() {
    const { pose, circle } = this.scene;
    if (this.view.fitted && this.#bounds && this.view.width) this.view.fit(this.#bounds, this.drawn ? 0 : INSET);
    const [pen, colours] = [new Pen(this.canvas, this.view), this.#colours];
    for (const layer of this.below) layer(pen, colours);
    if (this.#path) this.#drawPath(pen);
    pen.context.globalAlpha = WAY;
    for (const { line, colour } of this.#ways) pen.stroke(line, colour, 2);
    pen.context.globalAlpha = 1;
    if (circle > 0 && !this.scene.parts) pen.stroke(pen.circle(0, 0, circle * pen.scale), colours.circle, 1.5);
    const { metres, pixels } = scaleBar(this.view.scale);
    pen.bar(`${metres} m`, pixels, colours.text, colours.card, this.view.scaleIsLeft);
    for (const layer of this.names) layer(pen, colours);
    // On a drawn path the dragon alone fades: what is drawn is as it is.
    pen.context.globalAlpha = this.scene.faded && this.drawn ? FADED : 1;
    if (pose && !this.hidden.has("dragons")) this.#drawDragon(pen);
    pen.context.globalAlpha = 1;
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
    for (const part of this.#parts) this.#drawHead(pen, part);
    for (const part of this.#parts) if (part.name) pen.label(part.name, part.pose.x[0], part.pose.y[0], part.colour, colours.card);
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

  /** The number of the dragon whose head is at a place [px]: 0 for the one shown alone; -1 for none. */
  headUnder(px, py) {
    return this.scene.pose ? this.#parts.findIndex(({ pose: { x: [x], y: [y] } }) => this.view.nearest({ x: [x], y: [y] }, px, py, PICK_RADIUS) !== null) : -1;
  }

  /** True after a tap on the head of another one of several dragons, which is chosen now. */
  #isHead(px, py) {
    const k = this.scene.parts ? this.headUnder(px, py) : -1;
    if (k < 0 || this.#parts[k].pose === this.scene.pose) return false;
    this.headTapped?.(k);
    return true;
  }

  #nearest(px, py) {
    const { pose } = this.scene;
    return pose && this.view.nearest(pose, px, py, PICK_RADIUS);
  }
}
