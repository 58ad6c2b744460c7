/** Buttons around a thing, which make it larger, turn it and move it. */

import { dancedOf, figured, turned, withThing } from "./changes.js";
import { make } from "./elements.js";
import { carried, ringOf } from "./photo_place.js";
import { extent } from "./square.js";
import { say } from "./text.js";
import { FINE_STEP, KEYS, STEP } from "./touch.js";

/** What the buttons around a thing do. @type {Phrases} */
const GRIPS = { size: "Larger or smaller", turn: "Turn it", move: "Move it" };
/** Steps of their keys, alone and with Shift: radius [m], share of the size [1], angle [degrees], that of a photo; distance from the thing [px]. */
const [RADIUS_STEPS, SIZE_STEPS, TURN_STEPS, FINE_TURNS, GRIP_FAR] = [[0.1, 0.01], [0.05, 0.01], [5, 1], [1, 0.1], 28];

export class Grips {
  /** kind -> button */
  buttons = Object.fromEntries(Object.keys(GRIPS).map((kind) => [kind, this.#grip(kind)]));

  /**
   * hold(event, kind): a pointer has pressed one; dragging: what a pressed button does while its pointer moves
   * @param {Editor} editor
   */
  constructor(editor, hold, dragging) {
    this.editor = editor;
    this.hold = hold;
    for (const one of Object.values(this.buttons)) Object.assign(one, dragging);
  }

  /** After a change of anything. */
  show() {
    const kinds = this.#held?.kinds ?? [];
    for (const [kind, grip] of Object.entries(this.buttons)) {
      grip.hidden = !kinds.includes(kind);
      grip.setAttribute("aria-label", say(GRIPS[kind]));
    }
  }

  /** Move the buttons around the thing to their places: beside it, and above it. */
  place() {
    const held = this.#held;
    if (!held) return;
    const { view } = this.editor.dance;
    const shown = held.points.map((point) => view.toScreen(...point));
    const reach = shown.length > 1 ? GRIP_FAR : Math.max((held.radius ?? 0) * view.scale, GRIP_FAR);
    const { width, height, middle } = extent(shown);
    const places = { size: [middle[0] + width / 2 + reach, middle[1] + (shown.length > 1 ? height / 2 + reach : 0)], turn: [middle[0], middle[1] - height / 2 - 1.5 * reach], move: middle };
    const inside = (at, size) => Math.min(Math.max(at, GRIP_FAR), size - GRIP_FAR);
    for (const [kind, [x, y]] of Object.entries(places)) this.buttons[kind].style.transform = `translate(${inside(x, view.width)}px, ${inside(y, view.height)}px)`;
  }

  /** What the buttons are around: {points [m], radius, kinds: of its buttons}; null without. */
  get #held() {
    const { photo, hasFigure, whole } = this.editor;
    const all = Object.keys(GRIPS);
    if (photo) return { points: ringOf(photo), kinds: all };
    if (hasFigure) return { points: dancedOf(this.editor.drawing), kinds: all };
    return whole && { ...whole, kinds: whole.points.length > 1 ? ["size", "turn"] : whole.radius === undefined ? [] : ["size"] };
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
      const { points } = this.#held;
      const steps = kind === "turn" ? this.#turns : points.length > 1 ? SIZE_STEPS : RADIUS_STEPS;
      const step = kind === "move" ? way.map((one) => one * (event.shiftKey ? FINE_STEP : STEP)) : (way[0] + way[1]) * steps[Number(event.shiftKey)];
      this.editor.takes(this.formed(this.editor.edited, kind, step), `${this.editor.item} ${kind}`);
    };
    return make("button", { type: "button", className: `grip ${kind}`, hidden: true, textContent: { size: "↔", turn: "↻", move: "✥" }[kind], onpointerdown, onkeydown });
  }

  get #turns() {
    return this.editor.photo ? FINE_TURNS : TURN_STEPS;
  }

  /** A drawing with the chosen thing larger by a step of its radius [m] or size [1], turned by one [degrees], or moved by one [m]; a place of the photo likewise. */
  formed(base, kind, step) {
    const { photo, hasFigure, item } = this.editor;
    const change = kind === "move" ? { by: step } : kind === "turn" ? { angle: (step * Math.PI) / 180 } : { scale: Math.max(1 + step, SIZE_STEPS[1]) };
    if (photo) return carried(base, { about: extent(ringOf(base)).middle, ...change });
    if (hasFigure) return figured(base, change);
    const { points, radius } = base.things[item];
    if (kind === "turn" || points.length > 1) return turned(base, item, change.angle, change.scale);
    return withThing(base, item, { radius: Math.max(Number((radius + step).toFixed(2)), RADIUS_STEPS[1]) });
  }

  /** The drawing with the thing as large, or turned as far, as the pointer went about its middle. */
  around(event, { base, k, from }) {
    const { points, radius } = this.editor.photo ? { points: ringOf(base) } : this.editor.hasFigure ? { points: dancedOf(base) } : base.things[this.editor.item];
    const [x, y] = this.editor.dance.view.toScreen(...extent(points).middle);
    const [was, is] = [from, [event.clientX, event.clientY]].map((place) => this.editor.inBox(...place)).map(([px, py]) => [px - x, y - py]);
    const [first, now] = [was, is].map((way) => Math.hypot(...way) || 1);
    const rest = (number, steps) => steps[Number(event.altKey)] * Math.round(number / steps[Number(event.altKey)]);
    if (k === "turn") return this.formed(base, k, rest(((Math.atan2(is[1], is[0]) - Math.atan2(was[1], was[0])) * 180) / Math.PI, this.#turns));
    return this.formed(base, k, points.length > 1 ? now / first - 1 : rest(radius + (now - first) / this.editor.dance.view.scale, RADIUS_STEPS) - radius);
  }
}
