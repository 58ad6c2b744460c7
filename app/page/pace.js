/** The editor of the head's speeds and times: passages, and the time of day at time 0. */

import { button, make, numberIn, textButton } from "./elements.js";
import { ENDS, beginsOf, clockIn, passagesIn } from "./passages.js";
import { refusalWords, say } from "./text.js";

/** Duration of an added pause, and of an added passage [s]. */
const [PAUSE, LONG] = [10, 20];

export class Pace {
  #rows = [];

  /**
   * field: that of the head speed, above these elements
   * @param {State} state
   */
  constructor(field, state) {
    this.state = state;
    this.title = make("summary");
    this.list = make("ol");
    this.error = make("p", { className: "error", hidden: true });
    const adds = ["passageAdd", "pauseAdd"].map((id) => textButton(id, () => this.#add(id === "pauseAdd"), { id }));
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
