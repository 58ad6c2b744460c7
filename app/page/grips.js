/** Buttons around a thing, which make it larger, turn it and move it. */

import { figured, turned, withThing } from "./changes.js";
import { yardOf } from "./drawing.js";
import { make } from "./elements.js";
import { extent, isInside } from "./square.js";
import { say } from "./text.js";
import { FINE_STEP, KEYS, STEP } from "./touch.js";

/** What the buttons around a thing do. @type {Phrases} */
const GRIPS = { size: "Larger or smaller", turn: "Turn this thing", move: "Move the figure" };
/** Steps of their keys, alone and with Shift: radius [m], share of the size [1], angle [degrees]; distance from the thing [px]. */
const [RADIUS_STEPS, SIZE_STEPS, TURN_STEPS, GRIP_FAR] = [[0.1, 0.01], [0.05, 0.01], [5, 1], 28];

export class Grips {
  /** kind -> button */
  buttons = Object.fromEntries(Object.keys(GRIPS).map((kind) => [kind, this.#grip(kind)]));

  /**
   * hold(event, kind): a pointer has pressed one; dragging: what a pressed button does while its pointer moves and when it is let go
   * @param {Editor} editor
   */
  constructor(editor, hold, dragging) {
    this.editor = editor;
    this.hold = hold;
    for (const one of Object.values(this.buttons)) Object.assign(one, dragging);
  }

  /** After a change of anything. */
  show() {
    const { hasFigure, whole } = this.editor;
    for (const [kind, grip] of Object.entries(this.buttons)) {
      grip.hidden = hasFigure ? false : kind === "move" || !whole || (whole.points.length < 2 && (kind === "turn" || whole.radius === undefined));
      grip.setAttribute("aria-label", say(GRIPS[kind]));
    }
  }

  /** Move the buttons around the thing to their places: beside it, and above it. */
  place() {
    if (!this.editor.whole && !this.editor.hasFigure) return;
    const { view } = this.editor.dance;
    const shown = (this.editor.hasFigure ? this.#danced : this.editor.whole.points).map((point) => view.toScreen(...point));
    const reach = shown.length > 1 ? GRIP_FAR : Math.max((this.editor.thing.radius ?? 0) * view.scale, GRIP_FAR);
    const { width, height, middle } = extent(shown);
    const places = { size: [middle[0] + width / 2 + reach, middle[1] + (shown.length > 1 ? height / 2 + reach : 0)], turn: [middle[0], middle[1] - height / 2 - 1.5 * reach], move: middle };
    const inside = (at, size) => Math.min(Math.max(at, GRIP_FAR), size - GRIP_FAR);
    for (const [kind, [x, y]] of Object.entries(places)) this.buttons[kind].style.transform = `translate(${inside(x, view.width)}px, ${inside(y, view.height)}px)`;
  }

  /** The points of a figure, without those in streets. */
  get #danced() {
    const { points } = this.editor.drawing;
    const danced = points.filter((point) => isInside(yardOf(this.editor.drawing), point));
    return danced.length > 1 ? danced : points;
  }

  #grip(kind) {
    const onpointerdown = (event) => {
      event.preventDefault();
      this.buttons[kind].focus({ preventScroll: true });
      this.buttons[kind].setPointerCapture(event.pointerId);
      this.hold(event, kind);
    };
    const onkeydown = (event) => {
      const way = KEYS[event.key];
      if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      if (kind === "move") return this.editor.steps.take(figured(this.editor.drawing, { by: way.map((one) => one * (event.shiftKey ? FINE_STEP : STEP)) }), "figure move");
      const step = (way[0] + way[1]) * (kind === "turn" ? TURN_STEPS : this.editor.hasFigure || this.editor.whole.points.length > 1 ? SIZE_STEPS : RADIUS_STEPS)[Number(event.shiftKey)];
      this.editor.steps.take(this.#formed(this.editor.drawing, kind, step), `${this.editor.item} ${kind}`);
    };
    return make("button", { type: "button", className: `grip ${kind}`, hidden: true, textContent: { size: "↔", turn: "↻", move: "✥" }[kind], onpointerdown, onkeydown });
  }

  /** The drawing with the chosen thing larger by a step of its radius [m] or size [1], or turned by a step [degrees]. */
  #formed(drawing, kind, step) {
    if (this.editor.hasFigure) return figured(drawing, kind === "turn" ? { angle: (step * Math.PI) / 180 } : { scale: Math.max(1 + step, SIZE_STEPS[1]) });
    const { points, radius } = drawing.things[this.editor.item];
    if (kind === "turn") return turned(drawing, this.editor.item, (step * Math.PI) / 180);
    if (points.length > 1) return turned(drawing, this.editor.item, 0, Math.max(1 + step, SIZE_STEPS[1]));
    return withThing(drawing, this.editor.item, { radius: Math.max(Number((radius + step).toFixed(2)), RADIUS_STEPS[1]) });
  }

  /** The drawing with the thing as large, or turned as far, as the pointer went about its middle. */
  around(event, { base, k, from }) {
    const { points, radius } = this.editor.hasFigure ? base : base.things[this.editor.item];
    const [x, y] = this.editor.dance.view.toScreen(...extent(points).middle);
    const [was, is] = [from, [event.clientX, event.clientY]].map((place) => this.editor.inBox(...place)).map(([px, py]) => [px - x, y - py]);
    const [first, now] = [was, is].map((way) => Math.hypot(...way) || 1);
    const rest = (number, steps) => steps[Number(event.altKey)] * Math.round(number / steps[Number(event.altKey)]);
    if (k === "turn") return this.#formed(base, k, rest(((Math.atan2(is[1], is[0]) - Math.atan2(was[1], was[0])) * 180) / Math.PI, TURN_STEPS));
    return this.#formed(base, k, points.length > 1 ? now / first - 1 : rest(radius + (now - first) / this.editor.dance.view.scale, RADIUS_STEPS) - radius);
  }
}
