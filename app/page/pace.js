/** The editor of the head's speeds and times: passages, and the time of day at time 0. */

import { button, make, numberIn, textButton } from "./elements.js";
import { announce } from "./overlays.js";
import { ENDS, beatsOf, beginsOf, clockIn, endOf, passagesIn, timeOfDay } from "./passages.js";
import { refusalWords, say, sentencesOf } from "./text.js";

/** Duration of an added pause, and of an added passage [s]. */
const [PAUSE, LONG] = [10, 20];

/** Decimals of the times of a dance. */
const DECIMALS = 6;

export class Pace {
  #rows = [];
  /** Time of day at which the dance shown begins; empty without one. */
  #begins = "";

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
    this.clock = make("input", { id: "begin_clock", autocomplete: "off", "aria-describedby": "clock-error clock-help", onchange: () => this.#start() });
    this.wrong = make("p", { id: "clock-error", className: "error", hidden: true });
    const label = make("label", {}, make("span", { "data-text": "begin_clock" }), " ", this.clock);
    /** Says when the dance ends, and of an address or a file with the time of day at time 0 when it begins. */
    this.help = make("p", { id: "clock-help", className: "hint", hidden: true });
    // Of a drawn dance it stands beside the square.
    const starts = make("div", { id: "starts" }, label, this.wrong, this.help);
    field.after(make("div", { id: "pace" }, box, starts));
    state.listen((names) => ["passages", "beats", "start_clock", "begin_clock"].some((name) => names.has(name)) && this.show());
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
    const added = [...(begun > last ? [`${this.state.get("head_speed")}@${begun}s`] : []), ...(isPause ? [`0@${PAUSE}d`] : [])];
    this.state.set({ passages: [...this.#typed, ...added].join("_") });
    this.#rows.at(-1).until.focus();
  }

  #start() {
    const clock = clockIn(this.clock.value);
    this.wrong.hidden = clock !== null;
    this.clock.setAttribute("aria-invalid", clock === null);
    this.#say();
    if (clock === null) return;
    this.clock.value = clock;
    this.state.set({ begin_clock: clock, start_clock: "" });
  }

  /** Say what a time must look like, and which one holds meanwhile. */
  #say() {
    this.clock.placeholder = say("clockExample");
    this.wrong.textContent = sentencesOf([say("clockWrong"), this.#begins && say("clockKept", { clock: this.#begins })]);
  }

  /** Show when a dance ends, and when it begins if its time of day is given at time 0, as in old addresses and files. */
  begun({ clock, extras: { clock: atZero }, answer, begin, end, verdict = null }) {
    this.help.hidden = !clock || verdict === "fails";
    this.#begins = clock ? timeOfDay(Number(begin.toFixed(DECIMALS)), clock) : "";
    this.#say();
    if (!clock) return;
    const start = this.#begins;
    const ends = say("clockEnds", { end: timeOfDay(Number((answer.end?.time ?? end).toFixed(DECIMALS)), clock) });
    this.help.textContent = atZero && begin !== 0 ? sentencesOf([say("clockAtZero", { clock: atZero, start }), ends]) : ends;
    if (atZero && document.activeElement !== this.clock) this.clock.value = start;
  }

  #row() {
    const label = (key) => ({ "data-label": key, "aria-label": say(key) });
    const onchange = () => this.state.set({ passages: this.#typed.join("_") });
    const number = (key) => make("input", { inputMode: "decimal", autocomplete: "off", onchange, ...label(key) });
    const unit = make("select", { onchange, ...label("passageUnit") }, ...Object.keys(ENDS).map((one) => make("option", { value: one, "data-text": `passageEnd_${one}`, textContent: say(`passageEnd_${one}`) })));
    const drop = () => this.state.set({ passages: this.#typed.toSpliced(this.#rows.indexOf(row), 1).join("_") });
    const remove = button({ className: "reset", textContent: "✕", ...label("passageRemove") }, drop);
    const row = { until: number("passageUntil"), unit, speed: number("passageSpeed") };
    row.box = make("li", {}, unit, row.until, row.speed, make("span", { className: "unit", textContent: "m/s" }), remove);
    return row;
  }

  /** The beats that give the speeds, or null; other speeds take the place of theirs. */
  get #beats() {
    const [passages, beats] = ["passages", "beats"].map((name) => this.state.get(name));
    const all = beatsOf({ passages, beats });
    if (beats && !all) {
      this.state.set({ beats: "" });
      announce(() => say("beatsGone"));
    }
    return all;
  }

  show() {
    const passages = passagesIn(this.state.get("passages"));
    const beats = this.#beats;
    while (this.#rows.length > passages.length) this.#rows.pop().box.remove();
    while (this.#rows.length < passages.length) {
      this.#rows.push(this.#row());
      this.list.append(this.#rows.at(-1).box);
    }
    passages.forEach((passage, k) => {
      const row = this.#rows[k];
      const [sign, end] = endOf(passage);
      for (const [field, value] of [[row.until, end], [row.speed, passage.speed]]) if (document.activeElement !== field) field.value = value;
      row.unit.value = sign;
    });
    this.list.parentElement.open ||= passages.length > 0;
    const bars = beats?.reduce((sum, one) => sum + one.bars, 0);
    this.title.textContent = beats ? say("beatsKept", { bars }) : passages.length ? say("passagesCount", { count: passages.length }) : say("passages");
    this.#say();
    if (document.activeElement !== this.clock) this.clock.value = this.state.get("begin_clock") || this.state.get("start_clock");
  }

  /** error: of the service about the passages, or none */
  refuse(error) {
    this.error.hidden = !error;
    Object.assign(this.error, error ? refusalWords(error) : { textContent: "" });
  }
}
