/** A handle beside the place of the head at time 0: it moves the dragon along its path, by hand, by keys, or by a typed number. */

import { $, button, hide, make, numberIn } from "./elements.js";
import { dragonOf } from "./square.js";
import { phrase, say } from "./text.js";
import { KEYS } from "./touch.js";

/** Distance of the handle from the path [px]; steps of its keys, alone and with Shift [m]. */
const [ASIDE, STEPS] = [26, [1, 0.1]];
/** Way of the shortest dance [m]. */
const END = 0.1;
/** How far along the path counts, beside how far from the pointer: where a path crosses itself, the dragon stays on its part of it [1]. */
const ALONG = 0.3;

export class Start {
  /**
   * course(): the path as sampled, or null; hold(event): a pointer has pressed the handle; dragging: as for Grips
   * @param {Editor} editor
   */
  constructor(editor, course, hold, dragging) {
    this.editor = editor;
    this.course = course;
    const onpointerdown = (event) => {
      event.preventDefault();
      this.choose();
      this.button.setPointerCapture(event.pointerId);
      hold(event);
    };
    const onkeydown = (event) => {
      const way = KEYS[event.key];
      if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      this.#move((way[0] + way[1]) * STEPS[Number(event.shiftKey)]);
    };
    this.button = button({ className: "grip start", textContent: "⚑", onpointerdown, onkeydown, ...dragging });
    this.field = make("input", { id: "start-place", inputMode: "decimal", autocomplete: "off", "data-label": "Head at time 0, along the path", onchange: () => this.#typed() });
    this.bar = make("p", { className: "bar", hidden: true }, make("label", { htmlFor: this.field.id, "data-text": phrase("The head starts at") }), this.field, make("span", { "data-text": phrase("m of the path.") }));
    $("#stage").append(this.bar);
    for (const one of [this.button, this.bar]) one.addEventListener("focusout", ({ relatedTarget }) => hide(this.bar, !this.bar.contains(relatedTarget) && relatedTarget !== this.button));
    this.button.addEventListener("focus", () => this.#begin());
  }

  /** Take hold of the dragon: its numbers stand below the picture. */
  choose() {
    this.button.focus({ preventScroll: true });
  }

  /** Show the dragon where it starts, which is what is moved. */
  #begin() {
    hide(this.bar, false);
    this.editor.state.set({ time: 0 });
    this.show();
  }

  get #begins() {
    return this.editor.drawing.begin;
  }

  /** The sample of the path at the place of the head at time 0; null without a path. */
  get #at() {
    const course = this.course();
    if (!course || !this.editor.canEdit || this.editor.tool !== "path" || this.editor.item !== null) return null;
    const s = this.#begins - course.drawing.begin;
    const k = course.s.findIndex((one) => one >= s);
    return { course, k: Math.max(k < 0 ? course.s.length - 1 : k, 1) };
  }

  /** After a change of anything. */
  show() {
    hide(this.button, !this.#at);
    if (document.activeElement !== this.field) this.field.value = String(this.#begins);
    const label = say("Start of the dragon: head {place} m along the path", { place: this.#begins });
    if (this.button.ariaLabel !== label) this.button.ariaLabel = label;
  }

  /** At each drawing of the picture: to the left of the head. */
  place() {
    const at = this.#at;
    hide(this.button, !at);
    if (!at) return;
    const { course: { x, y }, k } = at;
    const [[ax, ay], [bx, by]] = [k - 1, k].map((one) => this.editor.dance.view.toScreen(x[one], y[one]));
    const far = ASIDE / (Math.hypot(bx - ax, by - ay) || 1);
    this.aside = [far * (by - ay), far * (ax - bx)];
    this.button.style.transform = `translate(${bx + this.aside[0]}px, ${by + this.aside[1]}px)`;
  }

  /** The drawing with the head where the path is nearest to the pointer, in decimetres, with Alt in centimetres. */
  along(event, { base, from }) {
    const { course: { s, x, y, drawing } } = this.#at;
    const { view } = this.editor.dance;
    const first = base.begin - drawing.begin;
    const start = s.findIndex((one) => one >= first);
    const [sx, sy] = view.toScreen(x.at(start), y.at(start));
    const [px, py] = [sx + event.clientX - from[0], sy + event.clientY - from[1]];
    const now = this.#begins - drawing.begin;
    const costs = x.map((one, k) => {
      const [ax, ay] = view.toScreen(one, y[k]);
      return Math.hypot(ax - px, ay - py) + ALONG * Math.abs(s[k] - now) * view.scale;
    });
    const steps = event.altKey ? 100 : 10;
    return this.#placed(base, Math.round(steps * (s[costs.indexOf(Math.min(...costs))] + drawing.begin)) / steps);
  }

  /** The drawing whose dance starts with the head at a place of the path [m], or, where the dragon is not yet whole on it, as soon as it is. */
  #placed(drawing, place) {
    const { s, drawing: { begin: before } } = this.#at.course;
    const begin = Number(Math.min(Math.max(place, 0), s.at(-1) + before - END).toFixed(2));
    return { ...drawing, begin, start: begin > dragonOf(this.editor.state).length ? 0 : null };
  }

  #move(by) {
    const { drawing, steps } = this.editor;
    steps.take(this.#placed(drawing, this.#begins + by), "start");
  }

  #typed() {
    const place = numberIn(this.field.value);
    const isRight = typeof place === "number";
    this.field.setAttribute("aria-invalid", String(!isRight));
    if (isRight) this.editor.steps.take(this.#placed(this.editor.drawing, place));
    this.field.value = isRight ? String(this.#begins) : this.field.value;
  }
}
