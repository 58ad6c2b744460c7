/** A number in a sentence to drag: a slider for the mouse, for fingers and for the keyboard. */

import { make } from "../elements.js";

/** Length of a drag through the whole range [px], and its factor with Shift. */
const [REACH, FINE] = [280, 10];
/** Steps of other keys than the arrows. */
const LEAP = 10;
const KEYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: LEAP, PageDown: -LEAP };

export class Dial {
  element = make("span", { className: "dial", role: "slider", tabindex: 0 });
  #drag = null;

  /** plan: {value, min, max, step, decimals, unit(value) -> text after the number, exact: an address and a button may set what is between two steps}; changed() after each change */
  constructor(plan, changed) {
    this.plan = plan;
    this.changed = changed;
    this.value = plan.value;
    const listen = (...pairs) => pairs.forEach(([name, act]) => this.element.addEventListener(name, (event) => act(event)));
    listen(["keydown", (event) => this.#key(event)], ["pointerdown", (event) => this.#grab(event)]);
    listen(["pointermove", (event) => this.#move(event)], ["lostpointercapture", () => (this.#drag = null)]);
  }

  /** Set the number to the nearest step of the slider. */
  set(value) {
    this.choose(this.#near(value));
  }

  /** Set the number to one that the page offers. */
  choose(value) {
    const before = this.value;
    this.take(value);
    if (this.value === before) return;
    this.show();
    this.changed();
  }

  /** Take over a number before the page is drawn. */
  take(value) {
    const { min, max, exact } = this.plan;
    this.value = Math.min(Math.max(exact ? value : this.#near(value), min), max);
  }

  #near(value) {
    const { min, step, decimals } = this.plan;
    return Number((min + Math.round((value - min) / step) * step).toFixed(decimals));
  }

  /** The number with its unit. */
  words(value = this.value) {
    return `${value.toFixed(this.plan.decimals)} ${this.plan.unit()}`;
  }

  /** label: name for a screen reader; default: unchanged */
  show(label = this.element.getAttribute("aria-label")) {
    const { min, max } = this.plan;
    const words = this.words();
    const attributes = { label, valuemin: min, valuemax: max, valuenow: this.value, valuetext: words };
    for (const [name, value] of Object.entries(attributes)) this.element.setAttribute(`aria-${name}`, value);
    this.element.textContent = words;
  }

  #key(event) {
    const { min, max, step } = this.plan;
    const ends = { Home: min, End: max };
    if (!(event.key in KEYS || event.key in ends) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.set(ends[event.key] ?? this.value + KEYS[event.key] * step);
  }

  #grab(event) {
    if (event.button) return;
    this.#drag = { at: event.clientX, value: this.value };
    this.element.setPointerCapture(event.pointerId);
    this.element.focus();
    event.preventDefault();
  }

  #move(event) {
    if (!this.#drag) return;
    const { min, max } = this.plan;
    const way = ((event.clientX - this.#drag.at) * (max - min)) / REACH;
    this.set(this.#drag.value + (event.shiftKey ? way / FINE : way));
  }
}
