/** The editor of the head's speeds and times: passages, and the time of day at time 0. */

import { button, make, numberIn, textButton } from "./elements.js";
import { LABELS } from "./fields.js";
import { announce } from "./overlays.js";
import { beatsOf, beginsOf, clockIn, endOf, passagesIn, timeOfDay } from "./passages.js";
import { phrase, say, sentencesOf } from "./text.js";

/** How the end of a passage may be stated. @type {Phrases} */
const END_NAMES = {
  m: "until [m]",
  s: "until [s]",
  d: "for [s]",
};

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
    const adds = [textButton("Add a passage", () => this.#add(false), { id: "passageAdd" }), textButton("Pause at this instant", () => this.#add(true), { id: "pauseAdd" })];
    const help = make("p", { className: "hint", "data-text": "Parts of the dance with other speeds, in order from time 0 on; then the head speed applies. Metres count from the head's place at time 0. Speed 0 is a pause." });
    const box = make("details", { id: "passages" }, this.title, help, this.list, this.error, ...adds);
    this.clock = make("input", { id: "begin_clock", autocomplete: "off", "aria-describedby": "clock-error clock-help", onchange: () => this.#start() });
    this.wrong = make("p", { id: "clock-error", className: "error", hidden: true });
    const label = make("label", {}, make("span", { "data-text": LABELS.begin_clock }), " ", this.clock);
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
    this.clock.placeholder = say("hh:mm");
    this.wrong.textContent = sentencesOf([say("Write the time of day as 19:30 or 19:30:15."), this.#begins && say("Until then it starts at {clock}.", { clock: this.#begins })]);
  }

  /** Show when a dance ends, and when it begins if its time of day is given at time 0, as in old addresses and files. */
  begun({ clock, extras: { clock: atZero }, answer, begin, end, verdict = null }) {
    this.help.hidden = !clock || verdict === "fails";
    this.#begins = clock ? timeOfDay(Number(begin.toFixed(DECIMALS)), clock) : "";
    this.#say();
    if (!clock) return;
    const start = this.#begins;
    const ends = say("It ends at {end}.", { end: timeOfDay(Number((answer.end?.time ?? end).toFixed(DECIMALS)), clock) });
    this.help.textContent = atZero && begin !== 0 ? sentencesOf([say("The file or the address says {clock} at 0 s; the dance starts at {start}.", { clock: atZero, start }), ends]) : ends;
    if (atZero && document.activeElement !== this.clock) this.clock.value = start;
  }

  #row() {
    const label = (words) => ({ "data-label": words, "aria-label": say(words) });
    const onchange = () => this.state.set({ passages: this.#typed.join("_") });
    const number = (words) => make("input", { inputMode: "decimal", autocomplete: "off", onchange, ...label(words) });
    const unit = make("select", { onchange, ...label(phrase("Until a place, until a time, or for a time")) }, ...Object.entries(END_NAMES).map(([value, words]) => make("option", { value, "data-text": words, textContent: say(words) })));
    const drop = () => this.state.set({ passages: this.#typed.toSpliced(this.#rows.indexOf(row), 1).join("_") });
    const remove = button({ className: "reset", textContent: "✕", ...label(phrase("Remove the passage")) }, drop);
    const row = { until: number(phrase("End of the passage")), unit, speed: number(phrase("Speed of the passage")) };
    row.box = make("li", {}, unit, row.until, row.speed, make("span", { className: "unit", textContent: "m/s" }), remove);
    return row;
  }

  /** The beats that give the speeds, or null; other speeds take the place of theirs. */
  get #beats() {
    const [passages, beats] = ["passages", "beats"].map((name) => this.state.get(name));
    const all = beatsOf({ passages, beats });
    if (beats && !all) {
      this.state.set({ beats: "" });
      announce(() => say("These speeds take the place of the beats: the film has no drum any more."));
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
    this.title.textContent = beats ? say("Speeds by the beats of a drum ({bars} bars)", { bars }) : passages.length ? say("Slower, faster, pauses: {count}", { count: passages.length }) : say(LABELS.passages);
    this.#say();
    if (document.activeElement !== this.clock) this.clock.value = this.state.get("begin_clock") || this.state.get("start_clock");
  }

  /** error: of the service about the passages, or none */
  refuse(error) {
    this.error.hidden = !error;
    this.error.textContent = error?.sentence ?? "";
  }
}
