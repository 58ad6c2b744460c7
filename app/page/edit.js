/** Drawing on the picture: the points of one item are buttons to drag or to move by keys, and taps add points. */

import { inserted, isFigure, left, moved, placesOf, pointsOf, shiftedAll, stepped, withPoints } from "./changes.js";
import { Chosen } from "./chosen.js";
import { LANE_RADIUS, THINGS, freeName, isLine, place, yardOf } from "./drawing.js";
import { $, $$, SMALL_TYPE, inType, make, onClick } from "./elements.js";
import { Grips } from "./grips.js";
import { helpOf } from "./helps.js";
import { announce } from "./overlays.js";
import { crossesItself, extent, onBorder, rectangle } from "./square.js";
import { say } from "./text.js";
import { Start } from "./start.js";
import { Stroke } from "./stroke.js";
import { FINE_STEP, KEYS, STEP, decimetres, nameUnder, nearestLeg, squared, thingUnder, thingsWithin } from "./touch.js";

/** Largest movement of a press that is not a drag [px]; largest distance from the path, an edge or a thing of a tap that means it [px]. */
const [TRAVEL, ON_PATH] = [3, 16];
/** Distance between two points below which the second one is a dot [px]. */
const NEAR = 24;
/** Tools of which every tap begins a new thing. */
const ONE_POINT = ["circle", "gate"];
const THINGS_INSIDE = ["gate", "circle", "wall", "block", "lane"];
/** Distance of a point put by a key from the one before, as a share of the width of the picture. */
const STRIDE = 0.15;
const TREE_RADIUS = 0.5;
const WALL_RADIUS = 0.15;

export class Editor extends Chosen {
  /** What a tap with the tool puts ready-made: {kind, name, radius or size}; null without. @type {any} */
  kit = null;
  /** Points between which a distance is measured, at most two [m]. @type {number[][]} */
  measured = [];
  #knots = [];
  /** What is heard of the chosen thing. */
  #told = make("p", { id: "told", className: "unseen", role: "status" });
  /** The frame that chooses things. */
  #frame = make("div", { className: "frame", hidden: true });
  #grips = new Grips(this, (event, kind) => this.#hold(event, { k: kind }), this.#dragging);
  #drag = null;
  /** @type {Start} */
  #start;
  /** @type {Stroke} */
  #stroke;

  /**
   * course(): the drawn path from the service, or null; sampled(): the same while a newer one is awaited; chosen(): called when another item is edited
   * @param {State} state
   * @param {Steps} steps
   */
  constructor(dance, state, steps, course, sampled, chosen) {
    super(dance, state, steps, chosen);
    this.course = course;
    this.box = $("#knots");
    this.#start = new Start(this, sampled, (event) => this.#hold(event, { k: "start" }), this.#dragging);
    this.box.after(this.#told, make("div", { id: "grips" }, this.#frame, this.#start.button, ...Object.values(this.#grips.buttons)));
    dance.tapped = (x, y) => this.#tap(x, y);
    for (const button of $$("[data-tool]")) button.addEventListener("click", () => this.take(button.dataset.tool));
    onClick("#edit", () => this.turn(!this.active));
    onClick("#delete", () => this.#delete());
    const canvas = $("#canvas");
    canvas.addEventListener("keydown", (event) => this.#nudge(event), { capture: true });
    canvas.addEventListener("keydown", (event) => this.#next(event));
    canvas.addEventListener("pointerdown", (event) => this.#seize(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.#pull(event));
    // Wherever it ends: what is dragged may have been removed meanwhile.
    for (const type of ["pointerup", "pointercancel"]) addEventListener(type, (event) => this.#drop(/** @type {PointerEvent} */ (event)));
    addEventListener("keydown", (event) => this.#command(event));
    // A tool that was taken by a key is used by keys.
    addEventListener("click", ({ detail, target }) => !detail && target instanceof Element && target.matches(":is([data-tool], [data-add]):not([data-tool=kits], [data-add=kits])") && this.active && canvas.focus({ preventScroll: true }));
    this.#stroke = new Stroke(dance, (points) => this.#extend(points));
  }

  /** Add the points of a stroke at the end of the path. */
  #extend(points) {
    this.#last = null;
    this.steps.take(points.reduce((drawing, point) => inserted(drawing, null, drawing.points.length, decimetres(point)), this.drawing));
    this.chosen();
  }

  /** Begin or end drawing. */
  turn(active) {
    this.active = active;
    this.chosen();
  }

  /** The place of the dragged point, or of the one that has the focus, in the edited item; null without one. */
  get held() {
    const k = this.#drag?.k ?? this.#knots.indexOf(/** @type {any} */ (document.activeElement));
    return k >= 0 ? k : null;
  }

  /** True while something is dragged. */
  get isDragging() {
    return Boolean(this.#drag?.far);
  }

  /** The drawing before the drag that goes on; null without one. */
  get base() {
    return this.isDragging && this.#drag.part === "drawing" ? this.#drag.base : null;
  }

  /** Where the photo lies, while it is moved; else null. */
  get photo() {
    return this.canEdit && this.tool === "photo" ? this.state.get("photo") : null;
  }

  /** The part of the state that is edited. */
  get #part() {
    return this.photo ? "photo" : "drawing";
  }

  get edited() {
    return this.state.get(this.#part);
  }

  /** Replace what is edited. kind, before: as for steps.take() */
  takes(changed, kind = null, before = null) {
    const part = this.#part;
    if (changed !== (before ?? this.edited)) this.steps.change({ [part]: changed }, kind, before && { [part]: before });
  }

  /** Choose nothing; keys go on at the picture, because what had the focus is gone. */
  leave() {
    super.leave();
    if (document.activeElement === document.body || !document.activeElement.checkVisibility()) $("#canvas").focus({ preventScroll: true });
  }

  /** Draw with this tool from now on; a new obstacle begins with the next tap. kit: what a tap puts ready-made, or null */
  take(tool, kit = null) {
    [this.tool, this.kit, this.measured] = [tool, kit, []];
    const area = this.drawing.things.findIndex(({ kind }) => kind === "area");
    this.edit(tool === "area" && area >= 0 ? area : null);
  }

  /** Edit this item. */
  edit(item) {
    [this.item, this.others] = [item, []];
    this.isDrawing = true;
    if (item !== null) [this.tool, this.kit] = [this.drawing.things[item].kind, null];
    this.chosen();
  }

  /** The measured distance [m]. */
  get distance() {
    const [[ax, ay], [bx, by]] = this.measured;
    return Math.hypot(bx - ax, by - ay);
  }

  /** True while touches change the drawing. */
  get canEdit() {
    return this.active && this.isRoute;
  }

  /** Choose the point or the thing at a place of the window [px], unless it is chosen already; what is held there is let go. */
  reach(x, y) {
    this.#drag = null;
    this.dance.view.release();
    const knot = document.elementFromPoint(x, y)?.closest(".knot");
    if (knot instanceof HTMLElement) knot.focus({ preventScroll: true });
    if (knot && !this.whole) return;
    const item = this.#under(...this.inBox(x, y));
    if (item === null || !this.items.includes(item)) this.choose(item);
  }

  /** The chosen thing, unless taps on the picture still add points to it. */
  get whole() {
    return this.others.length || (this.isDrawing && this.thing && !ONE_POINT.includes(this.thing.kind)) ? null : this.thing;
  }

  /** True while the path is a figure, which is edited as a whole. */
  get hasFigure() {
    return this.canEdit && this.item === null && this.tool === "path" && isFigure(this.drawing) && this.drawing.points.length > 0;
  }

  get #isLine() {
    return this.item === null || isLine(this.drawing.things[this.item]);
  }

  /** After a change of anything. */
  show() {
    if (Math.max(this.item ?? 0, ...this.others) >= this.drawing.things.length) [this.item, this.others] = [null, []];
    const on = this.active && this.isRoute;
    $("#edit").setAttribute("aria-pressed", on);
    for (const button of $$("[data-tool]")) {
      button.hidden = !on;
      button.setAttribute("aria-pressed", button.dataset.tool === (this.kit ? this.kit.tool ?? "kits" : this.tool));
    }
    $("[data-tool=gate]").disabled = !yardOf(this.drawing).length;
    $("#delete").hidden = !on;
    this.steps.changed();
    $("#delete").disabled = !this.#points.length;
    $("#draw-help").hidden = !on;
    $("#draw-help").textContent = helpOf(this);
    this.#fit();
  }

  /** The points of the edited item; those of the path only while the path itself is drawn. */
  get #points() {
    if (!this.active || !this.isRoute || this.others.length || this.hasFigure || (this.item === null && this.tool !== "path")) return [];
    return pointsOf(this.drawing, this.item);
  }

  /** The name and the place of the chosen thing are heard. */
  #tellPlace() {
    const [x, y] = extent(this.thing.points).middle.map((one) => Number(one.toFixed(2)));
    this.#told.textContent = say("{name}: x {x} m, y {y} m", { name: this.names, x, y });
  }

  /** The keys [ and ] choose one thing of the square after another. True if they did. */
  #step(key) {
    const { things } = this.drawing;
    const way = { "[": -1, "]": 1 }[key];
    if (!way || !things.length || !this.canEdit) return false;
    this.choose(((this.item ?? (way > 0 ? -1 : 0)) + way + things.length) % things.length);
    this.dance.view.reveal(...extent(this.thing.points).middle);
    this.#tellPlace();
    return true;
  }

  /** Arrow keys move what is chosen, and Delete removes it. */
  #nudge(event) {
    if (!event.ctrlKey && !event.metaKey && !event.altKey && this.#step(event.key)) {
      event.preventDefault();
      return event.stopImmediatePropagation();
    }
    if (!this.items.length || (this.isDrawing && !this.others.length) || event.ctrlKey || event.metaKey || event.altKey) return;
    const way = KEYS[event.key];
    const by = event.shiftKey ? FINE_STEP : STEP;
    if (way) {
      const far = way.map((one) => one * by);
      const isGate = this.thing.kind === "gate" && !this.others.length;
      this.steps.take(isGate ? stepped(this.drawing, this.item, 0, far) : shiftedAll(this.drawing, this.items, far), `nudge ${this.items}`);
      this.#tellPlace();
    } else if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  /** Ctrl+C, Ctrl+V and Ctrl+D copy things, put copies beside them, or both at once; Escape leaves them. */
  #command(event) {
    if (!this.active || !this.isRoute || event.defaultPrevented || (event.target instanceof Element && event.target.matches("input, textarea, select"))) return;
    const key = event.key.toLowerCase();
    if (key === "escape" && (this.thing || this.photo) && !$$(":popover-open, dialog[open]").length) this.leave();
    else if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    else if (key === "c" && this.thing && getSelection().isCollapsed) this.copy();
    else if (key === "v" && this.canPaste) this.paste();
    else if (key === "d" && this.thing) this.duplicate();
    else return;
    event.preventDefault();
  }

  /** As many buttons as points, each with its name. */
  #fit() {
    const points = this.#points;
    const held = /** @type {any} */ (document.activeElement);
    while (this.#knots.length > points.length) this.#knots.pop().remove();
    if (held?.matches(".knot") && !held.isConnected) $("#canvas").focus({ preventScroll: true });
    while (this.#knots.length < points.length) this.box.append(this.#knot(this.#knots.length));
    this.#grips.show();
    this.#start.show();
    const places = placesOf(this.drawing, this.item);
    points.forEach(([x, y], k) => {
      this.#knots[k].hidden = !places.has(k);
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
    this.#grips.place();
    this.#start.place();
  }

  #begun(event, drag) {
    return this.#start.along(event, drag);
  }

  #formed(event, drag) {
    return this.#grips.around(event, drag);
  }

  /** What a pressed button does while its pointer moves. */
  get #dragging() {
    return { onpointermove: (event) => this.#pull(event) };
  }

  #knot(k) {
    const drag = { onpointerdown: (event) => this.#grab(event), ...this.#dragging };
    const keys = { onkeydown: (event) => this.#key(event, k), onfocus: () => this.#reveal(k) };
    this.#knots.push(make("button", { type: "button", className: "knot", textContent: k + 1, ...drag, ...keys }));
    return this.#knots.at(-1);
  }

  /** A press on a thing, whatever the tool, takes this thing: it is edited, and moves with the pointer. */
  #seize(event) {
    if (!this.active || !this.isRoute || !event.isPrimary || (event.button && event.button !== 2)) return;
    if (["measure", "photo"].includes(this.tool)) return;
    const item = this.#under(event.offsetX, event.offsetY);
    const isSeveral = (event.shiftKey || this.tool === "several") && !event.button;
    if (item === null && !isSeveral && this.hasFigure && !event.button && this.#onPath(event.offsetX, event.offsetY, false)) {
      event.stopPropagation();
      return this.#carry(event, null);
    }
    if (item === null && !isSeveral && !event.button && this.tool === "path" && !this.hasFigure) this.#stroke.begin(event);
    if (item === null ? !isSeveral : item === this.item && this.isDrawing && this.#points.length > 1) return;
    event.stopPropagation();
    if (item === null) return this.#carry(event, "frame");
    const isChosen = this.items.includes(item);
    // With the tool for several, a drag moves them and a tap chooses one more.
    if (isSeveral && (event.shiftKey || !isChosen)) this.toggle(item);
    else if (!isChosen || !this.others.length) this.choose(item);
    if (event.button || (isSeveral && event.shiftKey)) return;
    if (!this.others.length && this.drawing.things[item].points.length === 1) return this.#grab(event);
    this.#carry(event, null);
  }

  /** Follow the pointer on the picture with what is chosen, or with a frame. */
  #carry(event, k) {
    event.preventDefault();
    const canvas = $("#canvas");
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    this.#hold(event, { k });
  }

  /** Show the frame from where the pointer was pressed to where it is. */
  #framed(event, drag) {
    drag.corners = [drag.from, [event.clientX, event.clientY]].map((place) => this.inBox(...place));
    const [[ax, ay], [bx, by]] = drag.corners;
    this.#frame.hidden = false;
    Object.assign(this.#frame.style, { transform: `translate(${Math.min(ax, bx)}px, ${Math.min(ay, by)}px)`, width: `${Math.abs(bx - ax)}px`, height: `${Math.abs(by - ay)}px` });
  }

  /** The thing at a place of the picture [px]. Gates are drawn on the border of the square, and paths and lanes across it. */
  #under(px, py, isInside = ["path", "gate", "lane"].includes(this.tool)) {
    const { hidden, labels, view } = this.dance;
    const kinds = ["area", ...THINGS_INSIDE].filter((kind) => (kind === "area" ? !isInside : !hidden.has("things")));
    return thingUnder(this.drawing.things, view, [px, py], kinds) ?? nameUnder(labels, [px, py], inType(SMALL_TYPE));
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
    this.#hold(event, { k, shift: shifts[k] });
  }

  #hold({ pointerId: pointer, clientX, clientY }, drag) {
    if (this.isDragging) return announce(() => say("Something is being dragged already: let it go first."));
    this.dance.view.fitted = false;
    this.#drag = { ...drag, pointer, from: [clientX, clientY], part: this.#part, base: this.edited, far: false };
  }

  #pull(event) {
    const drag = this.#drag;
    if (!drag || event.pointerId !== drag.pointer) return;
    drag.far ||= Math.hypot(event.clientX - drag.from[0], event.clientY - drag.from[1]) > TRAVEL;
    if (!drag.far) return;
    if (drag.k === "frame") return this.#framed(event, drag);
    const change = drag.k === "start" ? this.#begun : drag.k === null || drag.k === "move" ? this.#carried : drag.k in this.#grips.buttons ? this.#formed : this.#bent;
    const drawing = change.call(this, event, drag);
    if (change === this.#bent && this.#crosses(drawing) && !this.#crosses(drag.base)) {
      // The last one that does not cross itself stays.
      if (!drag.crosses) announce(() => say("Here the sides would cross each other: it stays as it was before."));
      drag.crosses = true;
      return;
    }
    this.state.set({ [drag.part]: drawing }, false);
  }

  /** The drawing with the dragged point where the pointer is: in line with its neighbours and in whole decimetres, with Alt as it is. */
  #bent(event, { base, k, shift }) {
    const { view } = this.dance;
    const point = view.toWorld(event.clientX + shift[0], event.clientY + shift[1]);
    const points = pointsOf(base, this.item);
    const rest = event.altKey ? point.map((one) => Math.round(100 * one) / 100) : this.item === null ? decimetres(point) : squared(points, k, point, !this.#isLine, view.scale);
    return moved(base, this.item, k, rest);
  }

  /** The drawing with what is chosen as far as the pointer went. */
  #carried(event, { base, from }) {
    const { scale } = this.dance.view;
    const by = [(event.clientX - from[0]) / scale, (from[1] - event.clientY) / scale];
    const rest = event.altKey ? by : decimetres(by);
    return this.photo || this.hasFigure ? this.#grips.formed(base, "move", this.photo ? by : rest) : shiftedAll(base, this.items, rest);
  }

  /** True if the edited thing is an area whose sides cross. */
  #crosses(drawing) {
    return !this.#isLine && crossesItself(pointsOf(drawing, this.item));
  }

  #drop({ pointerId }) {
    const drag = this.#drag;
    if (drag && drag.pointer !== pointerId) return;
    this.#drag = null;
    this.#frame.hidden = true;
    if (drag?.corners) {
      const items = [...new Set([...this.items, ...thingsWithin(this.drawing.things, this.dance.view, ...drag.corners)])];
      this.choose(items[0] ?? null, items.slice(1));
    } else if (drag?.k === "frame") this.leave();
    else if (drag?.far) this.takes(this.edited, null, drag.base);
    else if (drag && typeof drag.k === "number" && this.#points.length > 1) announce(() => say("Point {k}: drag it, or delete it with ⌫. To add a point beside it, or to drag one that is a dot, enlarge the picture with + first.", { k: drag.k + 1 }));
  }

  #key(event, k) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = KEYS[event.key];
    if (way) {
      const by = event.shiftKey ? FINE_STEP : STEP;
      this.steps.take(stepped(this.drawing, this.item, k, way.map((one) => one * by)), `${this.item} ${k}`);
      this.#reveal(k);
    } else if (event.key.toLowerCase() === "n") return this.#next(event);
    else if (this.#step(event.key)) $("#canvas").focus({ preventScroll: true });
    else if (event.key === "Enter") this.divide(k);
    else if (event.key === "Delete" || event.key === "Backspace") this.removePoint(k);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Insert a point after point k (after the last one: before it), on the path or half way along an edge. */
  divide(k) {
    const points = this.#points;
    if (points.length < 2) return;
    const next = !this.#isLine ? (k + 1) % points.length : Math.min(k + 1, points.length - 1);
    const from = next === k ? k - 1 : k;
    const { knots, s, x, y } = this.item === null ? (this.course() ?? {}) : {};
    const half = () => points[from].map((one, axis) => (one + points[next][axis]) / 2);
    const on = knots?.length === points.length ? s.findIndex((one) => one >= (knots[from] + knots[next]) / 2) : -1;
    this.steps.take(inserted(this.drawing, this.item, from + 1, on < 0 ? half() : [x[on], y[on]]));
    this.#knots[from + 1]?.focus({ preventScroll: true });
  }

  removePoint(k) {
    this.steps.take(left(this.drawing, this.item, k));
    this.#knots[Math.min(k, this.#knots.length - 1)]?.focus({ preventScroll: true });
  }

  /** Delete the point that has the focus, or else the last one. */
  #delete() {
    const k = this.#last ?? this.#points.length - 1;
    if (this.#points.length) this.removePoint(Math.min(k, this.#points.length - 1));
  }

  #last = null;

  /** Move the picture so that a point that got the focus is in view. */
  #reveal(k) {
    this.#last = k;
    this.dance.view.reveal(...this.#points[k]);
  }

  /** Handle the key that puts the next point without a pointer: it gets the focus, to be moved by arrow keys. */
  #next(event) {
    if (["several", "measure", "photo"].includes(this.tool) || !this.active || !this.isRoute || event.key.toLowerCase() !== "n" || event.ctrlKey || event.metaKey || event.altKey) return;
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
    const points = this.#isPut ? [] : pointsOf(this.drawing, this.item);
    if (!points.length || (this.item === null && this.tool !== "path")) return view.toWorld(view.width / 2, view.height / 2);
    const [[ax, ay], [bx, by]] = [points.at(-2) ?? points[0].with(0, points[0][0] - 1), points.at(-1)];
    const far = (STRIDE * view.width) / view.scale / (Math.hypot(bx - ax, by - ay) || 1);
    const [dx, dy] = [far * (bx - ax), far * (by - ay)];
    return this.tool === "path" || isLine({ kind: this.tool }) || points.length < 2 ? [bx + dx, by + dy] : [bx - dy, by + dx];
  }

  /** Handle a tap on the picture; returns true if it drew or chose something. */
  #tap(px, py) {
    if (!this.isRoute) return false;
    if (!this.active) {
      const item = this.#under(px, py, true);
      if (item === null) return false;
      this.choose(item);
      return true;
    }
    if (this.tool === "photo") return true;
    if (this.tool === "path" && this.item === null && this.dance.headUnder(px, py) >= 0) {
      this.#start.choose();
      return true;
    }
    if (this.tool === "measure") {
      this.measured = [...(this.measured.length < 2 ? this.measured : []), this.dance.view.toWorld(px, py)];
      this.chosen();
      return true;
    }
    const drawing = this.drawing;
    const point = decimetres(this.dance.view.toWorld(px, py));
    this.#last = null;
    this.dance.view.fitted = false;
    const onPath = drawing.points.length > 1 && this.tool !== "gate" && !(this.isDrawing && this.item !== null) ? this.#onPath(px, py) : null;
    if (onPath && this.tool !== "path") this.take("path");
    else this.#put(point, this.tool === "path" ? onPath : this.#onEdge(px, py));
    return true;
  }

  /** Add a point to what is drawn. spot: where it divides the path or an edge; null: after the last one */
  #put(point, spot = null) {
    const drawing = this.drawing;
    if (this.hasFigure) return announce(() => helpOf(this));
    if (this.tool === "path") this.steps.take(inserted(drawing, null, spot?.k ?? drawing.points.length, spot?.point ?? point));
    else if (this.item === null || !this.isDrawing || this.#isPut) this.#begin(drawing, point);
    else this.steps.take(inserted(drawing, this.item, spot?.k ?? pointsOf(drawing, this.item).length, point));
    this.chosen();
  }

  /** The edge of the edited thing that a tap divides: number of the next point; null without one. */
  #onEdge(px, py) {
    if (this.item === null || !this.isDrawing) return null;
    const points = pointsOf(this.drawing, this.item).map((point) => this.dance.view.toScreen(...point));
    const { k, far } = nearestLeg(points, [px, py], !this.#isLine);
    return far <= ON_PATH ? { k } : null;
  }

  /** The division of the path by a tap: number of the next point, and place of the new one. isDivided: at a point of its own */
  #onPath(px, py, isDivided = true) {
    const course = this.course();
    if (!isDivided) return course && this.dance.view.nearest(course, px, py, ON_PATH) !== null;
    if (course?.knots.length !== this.drawing.points.length) return null;
    const { s, x, y, knots } = course;
    const best = this.dance.view.nearest(course, px, py, ON_PATH);
    if (best === null) return null;
    const k = knots.findIndex((knot) => knot > s[best]);
    return { k: k < 0 ? knots.length - 1 : k, point: [x[best], y[best]] };
  }

  /** True if every tap puts a whole thing. */
  get #isPut() {
    return Boolean(this.kit) || ONE_POINT.includes(this.tool);
  }

  /** Add a new thing at this point. */
  #begin(drawing, wanted) {
    if (this.kit) return this.#putKit(drawing, wanted);
    const kind = this.tool;
    if (kind === "gate" && !yardOf(drawing).length) return;
    const point = kind === "gate" ? onBorder(yardOf(drawing), wanted).point : wanted;
    const radius = { circle: TREE_RADIUS, wall: WALL_RADIUS, lane: LANE_RADIUS }[kind];
    // The first of two gates is the way in and the second one the way out, unless the first one is a way out.
    const uses = kind === "gate" ? drawing.things.flatMap((one) => (one.kind === "gate" ? [one.use] : [])) : [];
    const use = uses.length === 1 && (uses[0] === "out" ? "in" : "out");
    const others = use && !uses[0] ? drawing.things.map((one) => (one.kind === "gate" ? { ...one, use: "in" } : one)) : drawing.things;
    const thing = { kind, name: freeName(drawing.things, say(THINGS[kind])), points: [], ...(radius && { radius }), ...(use && { use }) };
    [this.item, this.others] = [drawing.things.length, []];
    this.isDrawing = true;
    this.steps.take(withPoints({ ...drawing, things: [...others, thing] }, this.item, [point]));
  }

  /** Add the ready-made thing with its middle at this point, and choose it. */
  #putKit(drawing, point) {
    const { kind, name, radius, size } = this.kit;
    const thing = { kind, name: freeName(drawing.things, say(name)), points: size ? rectangle(...size, point) : [place(point)], ...(radius && { radius }) };
    this.steps.take({ ...drawing, things: [...drawing.things, thing] });
    this.choose(drawing.things.length);
  }
}
