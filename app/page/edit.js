/** Drawing on the picture: the points of one item are buttons to drag or to move by keys, and taps add points. */

import { inserted, moved, pointsOf, removed, withPoints } from "./changes.js";
import { THINGS, freeName, yardOf } from "./drawing.js";
import { $, $$, make, onClick } from "./elements.js";
import { announce } from "./overlays.js";
import { onBorder, streetLength } from "./square.js";
import { say } from "./text.js";

/** What each tool does. @type {Phrases} */
const HELPS = {
  path: "Tap the picture to extend the path, tap the path to insert a point, drag a point to move it.",
  area: "Tap the corners of the square one after another; drag them to move them.",
  block: "Tap the corners of an obstacle one after another. Choose Obstacle again for the next one.",
  circle: "Tap where a tree, a well or a person is; its radius is in the list “Square and obstacles”.",
  wall: "Tap along the wall. Choose Wall again for the next one.",
  gate: "Tap the border: the dragon comes in or goes out there. Beyond it a straight street of about {length} m is added, as long as your dragon, which stands in it before or after the dance.",
};

/** Largest movement of a press that is not a drag [px]; largest distance from the path, an edge or a thing of a tap that means it [px]. */
const [TRAVEL, ON_PATH] = [3, 16];
/** Distance between two points below which the second one is a dot [px]. */
const NEAR = 24;
/** Step of an arrow key that moves a point, alone and with Shift [m]. */
const [STEP, LONG_STEP] = [0.1, 1];
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
/** Tools of which every tap begins a new thing. */
const ONE_POINT = ["circle", "gate"];
/** Distance of a point put by a key from the one before, as a share of the width of the picture. */
const STRIDE = 0.15;
const TREE_RADIUS = 0.5;
const WALL_RADIUS = 0.15;

export class Editor {
  /** True if taps draw. */
  active = false;
  tool = "path";
  /** The edited item: null for the path, else the number of a thing. */
  item = null;
  #knots = [];
  /** A mouse stands beside a keyboard. */
  #hasKeys = matchMedia("(pointer: fine)");
  #drag = null;

  /**
   * course(): the drawn path from the service; chosen(): called when another item is edited
   * @param {State} state
   * @param {Steps} steps
   */
  constructor(dance, state, steps, course, chosen) {
    this.dance = dance;
    this.state = state;
    this.steps = steps;
    this.course = course;
    this.chosen = chosen;
    this.box = $("#knots");
    dance.tapped = (x, y) => this.#tap(x, y);
    for (const button of $$("[data-tool]")) button.addEventListener("click", () => this.take(button.dataset.tool));
    onClick("#edit", () => this.turn(!this.active));
    onClick("#delete", () => this.#delete());
    $("#canvas").addEventListener("keydown", (event) => this.#next(event));
    $("#canvas").addEventListener("pointerdown", (event) => this.#seize(event), { capture: true });
  }

  get #drawing() {
    return this.state.get("drawing");
  }

  get #isRoute() {
    return this.state.get("path") === "route";
  }

  /** Begin or end drawing. */
  turn(active) {
    this.active = active;
    this.chosen();
  }

  /** The place of the dragged point, or of the one that has the focus, in the edited item; null without one. */
  get held() {
    const k = this.#drag?.k ?? this.#knots.indexOf(/** @type {any} */ (document.activeElement));
    return k < 0 ? null : k;
  }

  get dragging() {
    return Boolean(this.#drag?.far);
  }

  /** What a tap draws with the tool. */
  get help() {
    const words = say(HELPS[this.tool], { length: this.tool === "gate" ? streetLength(this.state) : "" });
    return this.#hasKeys.matches ? `${words}${say(" Keys: N puts the next point, arrows move it by 0.1 m, with Shift by 1 m, Enter inserts one, Delete removes it.")}` : words;
  }

  /** Draw with this tool from now on; a new obstacle begins with the next tap. */
  take(tool) {
    this.tool = tool;
    const area = this.#drawing.things.findIndex(({ kind }) => kind === "area");
    this.edit(tool === "area" && area >= 0 ? area : null);
  }

  /** Edit this item. */
  edit(item) {
    this.item = item;
    if (item !== null) this.tool = this.#drawing.things[item].kind;
    this.chosen();
  }

  /** After a change of anything. */
  show() {
    if (this.item !== null && this.item >= this.#drawing.things.length) this.item = null;
    const on = this.active && this.#isRoute;
    $("#edit").setAttribute("aria-pressed", on);
    for (const button of $$("[data-tool]")) {
      button.hidden = !on;
      button.setAttribute("aria-pressed", this.tool === button.dataset.tool);
    }
    $("[data-tool=gate]").disabled = !yardOf(this.#drawing).length;
    $("#delete").hidden = !on;
    this.steps.changed();
    $("#delete").disabled = !this.#points.length;
    $("#draw-help").hidden = !on;
    $("#draw-help").textContent = this.help;
    this.#fit();
  }

  /** The points of the edited item; those of the path only while the path itself is drawn. */
  get #points() {
    if (!this.active || !this.#isRoute || (this.item === null && this.tool !== "path")) return [];
    return pointsOf(this.#drawing, this.item);
  }

  /** As many buttons as points, each with its name. */
  #fit() {
    const points = this.#points;
    while (this.#knots.length > points.length) this.#knots.pop().remove();
    while (this.#knots.length < points.length) this.box.append(this.#knot(this.#knots.length));
    points.forEach(([x, y], k) => {
      const label = say("Point {k} of {count}, x {x} m, y {y} m", { k: k + 1, count: points.length, x, y });
      if (this.#knots[k].getAttribute("aria-label") !== label) this.#knots[k].setAttribute("aria-label", label);
    });
  }

  /** Move the buttons to the points in the picture, at each drawing of it; a point near one before it is a dot, to be enlarged. */
  place() {
    const shown = [];
    this.#points.forEach((point, k) => {
      const knot = this.#knots[k];
      if (!knot) return;
      const [px, py] = this.dance.view.toScreen(...point);
      knot.style.transform = `translate(${px}px, ${py}px)`;
      const isNear = shown.some(([x, y]) => Math.hypot(x - px, y - py) < NEAR);
      knot.classList.toggle("near", isNear);
      if (!isNear) shown.push([px, py]);
    });
  }

  #knot(k) {
    const drop = () => this.#drop();
    const drag = { onpointerdown: (event) => this.#grab(event), onpointermove: (event) => this.#pull(event), onpointerup: drop, onpointercancel: drop };
    const keys = { onkeydown: (event) => this.#key(event, k), onfocus: () => this.#reveal(k) };
    this.#knots.push(make("button", { type: "button", className: "knot", textContent: k + 1, ...drag, ...keys }));
    return this.#knots.at(-1);
  }

  /** A press on a tree or a gate, while things are drawn, takes this thing: it is edited, and moves with the pointer. */
  #seize(event) {
    if (!this.active || !this.#isRoute || this.tool === "path" || !event.isPrimary || event.button) return;
    const item = this.#under(event.offsetX, event.offsetY);
    if (item === null) return;
    event.stopPropagation();
    this.edit(item);
    this.#grab(event);
  }

  /** The tree or gate at a place of the picture [px], the nearest of several; null without one. */
  #under(px, py) {
    const { view } = this.dance;
    let [best, least] = [null, Infinity];
    this.#drawing.things.forEach(({ kind, points, radius = 0 }, k) => {
      if (!ONE_POINT.includes(kind) || !points.length) return;
      const [x, y] = view.toScreen(...points[0]);
      const far = Math.hypot(x - px, y - py);
      if (far <= Math.max(radius * view.scale, ON_PATH) && far < least) [best, least] = [k, far];
    });
    return best;
  }

  /** Take the point nearest to the pointer, because buttons of near points overlap. */
  #grab(event) {
    event.preventDefault();
    const { left, top } = this.box.getBoundingClientRect();
    const from = [event.clientX, event.clientY];
    const shifts = this.#points.map((point) => this.dance.view.toScreen(...point).map((one, axis) => one - from[axis]));
    const far = shifts.map(([dx, dy], k) => (this.#knots[k].matches(".near:not(:focus)") ? Infinity : Math.hypot(dx + left, dy + top)));
    const k = far.indexOf(Math.min(...far));
    this.#knots[k].focus({ preventScroll: true });
    this.#knots[k].setPointerCapture(event.pointerId);
    this.dance.view.fitted = false;
    this.#drag = { k, from, shift: shifts[k], base: this.#drawing, far: false };
  }

  #pull(event) {
    const drag = this.#drag;
    if (!drag) return;
    drag.far ||= Math.hypot(event.clientX - drag.from[0], event.clientY - drag.from[1]) > TRAVEL;
    if (!drag.far) return;
    const point = this.dance.view.toWorld(event.clientX + drag.shift[0], event.clientY + drag.shift[1]);
    const centimetres = point.map((one) => Math.round(100 * one) / 100);
    this.state.set({ drawing: moved(drag.base, this.item, drag.k, centimetres) }, false);
  }

  #drop() {
    const drag = this.#drag;
    this.#drag = null;
    if (drag?.far) this.steps.take(this.#drawing, null, drag.base);
    else if (drag) announce(() => say("Point {k}: drag it, or delete it with ⌫. To add a point beside it, or to drag one that is a dot, enlarge the picture with + first.", { k: drag.k + 1 }));
  }

  #key(event, k) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = KEYS[event.key];
    if (way) {
      const by = event.shiftKey ? LONG_STEP : STEP;
      const [x, y] = this.#points[k];
      this.steps.take(moved(this.#drawing, this.item, k, [x + by * way[0], y + by * way[1]]), `${this.item} ${k}`);
      this.#reveal(k);
    } else if (event.key.toLowerCase() === "n") return this.#next(event);
    else if (event.key === "Enter") this.#divide(k);
    else if (event.key === "Delete" || event.key === "Backspace") this.#remove(k);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Insert a point after point k (after the last one: before it), on the path or half way along an edge. */
  #divide(k) {
    const points = this.#points;
    if (points.length < 2) return;
    const next = this.item !== null && this.tool !== "wall" ? (k + 1) % points.length : Math.min(k + 1, points.length - 1);
    const from = next === k ? k - 1 : k;
    const { knots, s, x, y } = this.item === null ? (this.course() ?? {}) : {};
    const half = () => points[from].map((one, axis) => (one + points[next][axis]) / 2);
    const on = knots?.length === points.length ? s.findIndex((one) => one >= (knots[from] + knots[next]) / 2) : -1;
    this.steps.take(inserted(this.#drawing, this.item, from + 1, on < 0 ? half() : [x[on], y[on]]));
    this.#knots[from + 1]?.focus({ preventScroll: true });
  }

  #remove(k) {
    this.steps.take(removed(this.#drawing, this.item, k));
    this.#knots[Math.min(k, this.#knots.length - 1)]?.focus({ preventScroll: true });
  }

  /** Delete the point that has the focus, or else the last one. */
  #delete() {
    const k = this.#last ?? this.#points.length - 1;
    if (this.#points.length) this.#remove(Math.min(k, this.#points.length - 1));
  }

  #last = null;

  /** Move the picture so that a point that got the focus is in view. */
  #reveal(k) {
    this.#last = k;
    this.dance.view.reveal(...this.#points[k]);
  }

  /** Handle the key that puts the next point without a pointer: it gets the focus, to be moved by arrow keys. */
  #next(event) {
    if (!this.active || !this.#isRoute || event.key.toLowerCase() !== "n" || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { view } = this.dance;
    view.fitted = false;
    this.#put(this.#after().map((one) => Math.round(10 * one) / 10));
    this.#knots.at(-1)?.focus({ preventScroll: true });
  }

  /** Place of the next point: the middle of the picture, or beyond the last point, for a thing with a turn to the left. */
  #after() {
    const { view } = this.dance;
    const points = ONE_POINT.includes(this.tool) ? [] : pointsOf(this.#drawing, this.item);
    if (!points.length || (this.item === null && this.tool !== "path")) return view.toWorld(view.width / 2, view.height / 2);
    const [[ax, ay], [bx, by]] = [points.at(-2) ?? points[0].with(0, points[0][0] - 1), points.at(-1)];
    const far = (STRIDE * view.width) / view.scale / (Math.hypot(bx - ax, by - ay) || 1);
    const [dx, dy] = [far * (bx - ax), far * (by - ay)];
    return this.tool === "path" || this.tool === "wall" || points.length < 2 ? [bx + dx, by + dy] : [bx - dy, by + dx];
  }

  /** Handle a tap on the picture; returns true if it drew something. */
  #tap(px, py) {
    if (!this.active || !this.#isRoute) return false;
    const drawing = this.#drawing;
    const point = this.dance.view.toWorld(px, py).map((one) => Math.round(10 * one) / 10);
    this.#last = null;
    this.dance.view.fitted = false;
    const spot = this.tool !== "path" ? this.#onEdge(px, py) : drawing.points.length > 1 ? this.#onPath(px, py) : null;
    this.#put(point, spot);
    return true;
  }

  /** Add a point to what is drawn. spot: where it divides the path or an edge; null: after the last one */
  #put(point, spot = null) {
    const drawing = this.#drawing;
    if (this.tool === "path") this.steps.take(inserted(drawing, null, spot?.k ?? drawing.points.length, spot?.point ?? point));
    else if (this.item === null || ONE_POINT.includes(this.tool)) this.#begin(drawing, point);
    else this.steps.take(inserted(drawing, this.item, spot?.k ?? pointsOf(drawing, this.item).length, point));
    this.chosen();
  }

  /** The edge of the edited thing that a tap divides: number of the next point; null without one. */
  #onEdge(px, py) {
    const points = this.item === null ? [] : pointsOf(this.#drawing, this.item).map((point) => this.dance.view.toScreen(...point));
    const ends = this.tool === "wall" || points.length < 3 ? points.slice(1) : [...points.slice(1), points[0]];
    const far = ends.map(([bx, by], k) => {
      const [ax, ay] = points[k];
      const share = ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / (Math.hypot(bx - ax, by - ay) ** 2 || 1);
      const on = Math.min(Math.max(share, 0), 1);
      return Math.hypot(ax + on * (bx - ax) - px, ay + on * (by - ay) - py);
    });
    const least = Math.min(...far);
    return least <= ON_PATH ? { k: far.indexOf(least) + 1 } : null;
  }

  /** The division of the path by a tap: number of the next point, and place of the new one. */
  #onPath(px, py) {
    const course = this.course();
    if (course?.knots.length !== this.#drawing.points.length) return null;
    const { s, x, y, knots } = course;
    const best = this.dance.view.nearest(course, px, py, ON_PATH);
    if (best === null) return null;
    const k = knots.findIndex((knot) => knot > s[best]);
    return { k: k < 0 ? knots.length - 1 : k, point: [x[best], y[best]] };
  }

  /** Add a new thing at this point. */
  #begin(drawing, wanted) {
    const kind = this.tool;
    if (kind === "gate" && !yardOf(drawing).length) return;
    const point = kind === "gate" ? onBorder(yardOf(drawing), wanted).point : wanted;
    const radius = { circle: TREE_RADIUS, wall: WALL_RADIUS }[kind];
    const thing = { kind, name: freeName(drawing.things, say(THINGS[kind])), points: [], ...(radius && { radius }) };
    this.item = drawing.things.length;
    this.steps.take(withPoints({ ...drawing, things: [...drawing.things, thing] }, this.item, [point]));
  }
}
