/** Speeds and times of the head: passages in addition to the head speed, and the time of day at time 0. */

import { button, make, numberIn, worded } from "./elements.js";
import { refusalWords, say } from "./text.js";

const DAY = 86_400;
const [HOUR, MINUTE] = [3_600, 60];
const CLOCK = /^([01]\d|2[0-3]):[0-5]\d(:[0-5]\d)?$/;
/** End of a passage: a place [m] or a time [s]. */
const ENDS = { m: "until_s", s: "until_time" };
/** Duration of an added pause, and of an added passage [s]. */
const [PAUSE, LONG] = [10, 20];

/** Passages of an address, such as 0.5@20m_0@100s, in the service's format; the service refuses wrong numbers. */
export function passagesIn(text) {
  return text.split("_").filter(Boolean).map((one) => {
    const [, speed, until, unit] = /^(.*?)@(.*?)([ms]?)$/.exec(one) ?? [null, one, "", ""];
    return { speed: numberIn(speed), [ENDS[unit] ?? ENDS.s]: numberIn(until) };
  });
}

/** Passages as the text of an address. */
export const passagesText = (passages) =>
  passages.map(({ speed, until_s: place, until_time: time }) => `${speed}@${place ?? time}${place === undefined || place === null ? "s" : "m"}`).join("_");

/** The passages of the dance made faster by a factor. */
export const quickened = (passages, factor) =>
  passages.map(({ speed, until_time: time, ...place }) => ({ speed: speed * factor, ...place, ...(time !== undefined && { until_time: time / factor }) }));

/** A typed time of day, such as 19:30, 7:30 or 19:30:15, in the service's format; null if it is none. */
export function clockIn(text) {
  const typed = text.trim().replaceAll("：", ":");
  const full = /^\d:/.test(typed) ? `0${typed}` : typed;
  return full === "" || CLOCK.test(full) ? full : null;
}

/** Time at which the head has travelled this far since time 0 [s]. */
export function timeAfter(distance, speed, passages) {
  const { time, gone, speed: own } = beginsOf(passages, speed).findLast(({ gone }) => gone < distance);
  return time + (distance - gone) / own;
}

/** Time [s], way of the head since time 0 [m] and speed [m/s] where each passage begins, and what comes after them. */
function beginsOf(passages, after) {
  const begins = [{ time: 0, gone: 0 }];
  for (const { speed, until_s: place, until_time: until } of passages) {
    const { time, gone } = Object.assign(begins.at(-1), { speed });
    const stop = until ?? time + (place - gone) / speed;
    begins.push({ time: stop, gone: place ?? gone + speed * (stop - time) });
  }
  Object.assign(begins.at(-1), { speed: after });
  return begins;
}

/** The time of day at a time of the dance [s], down to the whole second; clock: that at time 0, such as 19:30 */
export function timeOfDay(time, clock) {
  const [hours, minutes, seconds = 0] = clock.split(":").map(Number);
  const now = (((Math.floor(HOUR * hours + MINUTE * minutes + seconds + time) % DAY) + DAY) % DAY);
  return [now / HOUR, (now / MINUTE) % MINUTE, now % MINUTE].map((part) => String(Math.floor(part)).padStart(2, "0")).join(":");
}

export class Pace {
  #rows = [];

  /** field: that of the head speed, above these elements */
  constructor(field, state) {
    this.state = state;
    this.title = make("summary");
    this.list = make("ol");
    this.error = make("p", { className: "error", hidden: true });
    const adds = ["passageAdd", "pauseAdd"].map((id) => worded(id, () => this.#add(id === "pauseAdd"), { id }));
    const help = make("p", { className: "hint", "data-text": "passagesHelp" });
    const box = make("details", { id: "passages" }, this.title, help, this.list, this.error, ...adds);
    this.clock = make("input", { id: "start_clock", autocomplete: "off", placeholder: "19:30", "aria-describedby": "clock-error", onchange: () => this.#start() });
    this.wrong = make("p", { id: "clock-error", className: "error", hidden: true, "data-text": "clockWrong" });
    const label = make("label", { className: "starts" }, make("span", { "data-text": "start_clock" }), " ", this.clock);
    field.after(make("div", { id: "pace" }, box, label, this.wrong));
    state.listen((names) => (names.has("passages") || names.has("start_clock")) && this.show());
    this.show();
  }

  /** The typed passages: [speed, until, unit] of each. */
  get #typed() {
    return this.#rows.map(({ speed, until, unit }) => `${numberIn(speed.value)}@${numberIn(until.value)}${unit.value}`);
  }

  /** A passage after the last one, or a pause at the instant shown if that comes later. */
  #add(isPause) {
    const last = Math.round(beginsOf(passagesIn(this.state.get("passages")), 0).at(-1).time) || 0;
    const until = Math.round((isPause && this.state.get("time")) || last + LONG);
    const begun = Math.max(until, last);
    const added = [...(begun > last ? [`${this.state.get("head_speed")}@${begun}s`] : []), ...(isPause ? [`0@${begun + PAUSE}s`] : [])];
    this.state.set({ passages: [...this.#typed, ...added].join("_") });
    this.#rows.at(-1).until.focus();
  }

  #start() {
    const clock = clockIn(this.clock.value);
    this.wrong.hidden = clock !== null;
    this.clock.setAttribute("aria-invalid", clock === null);
    if (clock === null) return;
    this.clock.value = clock;
    this.state.set({ start_clock: clock });
  }

  #row() {
    const label = (key) => ({ "data-label": key, "aria-label": say(key) });
    const onchange = () => this.state.set({ passages: this.#typed.join("_") });
    const number = (key) => make("input", { inputMode: "decimal", autocomplete: "off", onchange, ...label(key) });
    const unit = make("select", { onchange, ...label("passageUnit") }, ...Object.keys(ENDS).map((one) => new Option(one, one)));
    const drop = () => this.state.set({ passages: this.#typed.toSpliced(this.#rows.indexOf(row), 1).join("_") });
    const remove = button({ className: "reset", textContent: "✕", ...label("passageRemove") }, drop);
    const row = { until: number("passageUntil"), unit, speed: number("passageSpeed") };
    const word = make("span", { "data-text": "passageUntilWord", textContent: say("passageUntilWord") });
    row.box = make("li", {}, word, row.until, unit, row.speed, make("span", { className: "unit", textContent: "m/s" }), remove);
    return row;
  }

  show() {
    const passages = passagesIn(this.state.get("passages"));
    while (this.#rows.length > passages.length) this.#rows.pop().box.remove();
    while (this.#rows.length < passages.length) {
      this.#rows.push(this.#row());
      this.list.append(this.#rows.at(-1).box);
    }
    passages.forEach(({ speed, until_s: place, until_time: time }, k) => {
      const row = this.#rows[k];
      for (const [field, value] of [[row.until, place ?? time], [row.speed, speed]]) if (document.activeElement !== field) field.value = value;
      row.unit.value = place === undefined ? "s" : "m";
    });
    this.list.parentElement.open ||= passages.length > 0;
    this.title.textContent = passages.length ? say("passagesCount", { count: passages.length }) : say("passages");
    if (document.activeElement !== this.clock) this.clock.value = this.state.get("start_clock");
  }

  /** error: of the service about the passages, or none */
  refuse(error) {
    this.error.hidden = !error;
    Object.assign(this.error, error ? refusalWords(error) : { textContent: "" });
  }
}
