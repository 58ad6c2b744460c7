/** The people of a dance: a form, who carries how long, and who is where at a time; the paper with the timeline, and a table. */

import { Problem, Superseded } from "./api.js";
import { $, button, download, make, numberIn, textButton } from "./elements.js";
import { LABELS } from "./fields.js";
import { announce } from "./overlays.js";
import { clockIn } from "./passages.js";
import { benchTitle, between, language, phrase, say } from "./text.js";

/** Numbers of the form: the field of the service, its first value; an empty one is left to the service. */
const NUMBERS = { head_people: "8", bench_people: "2", spares: "0", shift: "", rest: "0" };
/** @type {Phrases} */
const POINT = { x: "change near x [m]", y: "and y [m]" };
const FORMS = { A4: "application/pdf", A3: "application/pdf", CSV: "text/csv" };
const MINUTE = 60;

const minutes = (seconds) => `${Math.floor(seconds / MINUTE)}:${String(Math.floor(seconds % MINUTE)).padStart(2, "0")}`;

export class Crew {
  /** The last answer, with the dance that it is about. */
  #answer = null;
  #of = null;
  #problem = null;
  /** The language of the last question. */
  #language = "";

  /**
   * player: knows the time shown
   * @param {Service} service
   * @param {Questions} questions
   */
  constructor(service, questions, player) {
    this.service = service;
    this.questions = questions;
    this.player = player;
    const field = ([name, value]) => make("label", { className: "line" }, make("span", { "data-text": POINT[name] ?? LABELS[name] }), make("input", { id: `crew-${name}`, value, inputMode: "decimal", autocomplete: "off" }));
    this.at = make("input", { id: "crew-at", autocomplete: "off", placeholder: "0" });
    this.result = make("div", { id: "crew-result", "aria-live": "polite" });
    const save = Object.keys(FORMS).map((form) => button({ id: `crew-${form}`, textContent: form }, () => this.#save(form)));
    this.box = make(
      "details",
      { id: "crew" },
      make("summary", { "data-text": "Who carries when" }),
      make("p", { className: "hint", "data-text": "People change after a shift, or where a bench passes a point; spares come in. Empty: not so." }),
      ...Object.entries({ ...NUMBERS, x: "", y: "" }).map(field),
      make("label", { className: "line" }, make("span", { "data-text": LABELS.at }), this.at),
      make("p", { className: "buttons" }, textButton("Plan the crew", () => this.#ask(), { className: "main", id: "crew-ask" }), ...save),
      this.result,
    );
    $("#cues").before(this.box);
    this.box.addEventListener("toggle", () => this.#open());
  }

  /** The time shown is the one asked about, until a person types another. */
  #open() {
    if (this.box.open && !this.at.value) this.at.value = String(Math.trunc(this.player.time));
  }

  /** What the service is asked about the shown dance, as a text; empty without one. */
  get #dance() {
    return this.questions.dance ? JSON.stringify(this.questions.danced()) : "";
  }

  /** {path, body} of the question. throws: Problem for what is no number */
  #question() {
    const { questions } = this;
    const { clock } = questions.dance;
    const typed = (name) => numberIn($(`#crew-${name}`).value);
    const numbers = Object.fromEntries(Object.keys(NUMBERS).map((name) => [name, typed(name)]).filter(([, value]) => value !== ""));
    const [x, y] = [typed("x"), typed("y")];
    const at = numberIn(this.at.value);
    const day = clock && typeof at === "string" && at ? clockIn(at) : null;
    const time = day ? { at_clock: day } : at === "" ? {} : { at };
    const points = x === "" && y === "" ? [] : [{ x, y }];
    return questions.danced({ ...numbers, points, ...time, language: language() });
  }

  async #ask() {
    if (!this.questions.dance) return;
    [this.#problem, this.#of, this.#language] = [null, this.#dance, language()];
    try {
      this.#answer = await this.service.ask("crew", "crew", { body: this.#question() });
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      [this.#answer, this.#problem] = [null, error.problem];
    }
    this.show();
  }

  async #save(form) {
    try {
      const isPaper = form !== "CSV";
      const name = isPaper ? `crew-${form.toLowerCase()}.pdf` : "crew.csv";
      download(await this.service.ask(`crew ${form}`, "crew", { body: { ...this.#question(), ...(isPaper && { paper: form }) }, accept: FORMS[form] }), name);
      announce(() => say("Saved {name}.", { name }));
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      [this.#answer, this.#problem] = [null, error.problem];
      this.show();
    }
  }

  /** After an answer, a change of the language or of the dance. */
  show() {
    if ((this.#problem ?? this.#answer) && this.#language !== language() && this.#of === this.#dance) return this.#ask();
    if (this.#problem) return this.result.replaceChildren(make("p", { className: "error", textContent: this.#problem.sentence }));
    // People of another dance are none of this one.
    if (!this.#answer || this.#of !== this.#dance) return this.result.replaceChildren();
    const { sentences: [summary, ...lacks], at, carriers, start, stop } = this.#answer;
    const parts = [make("p", { textContent: summary }), ...lacks.map((textContent) => make("p", { className: "error", textContent }))];
    if (at) parts.push(this.#roll(at));
    this.result.replaceChildren(...parts, this.#people(carriers, start, stop));
  }

  #table(title, heads, rows) {
    const head = make("tr", {}, ...heads.map((words) => make("th", { scope: "col", textContent: say(words) })));
    const isNumber = (content) => typeof content === "string" && /^\d/.test(content);
    const cell = (content, k) => make(k ? "td" : "th", { className: isNumber(content) ? "number" : "", ...(k ? {} : { scope: "row" }) }, content);
    const body = rows.map((cells) => make("tr", {}, ...cells.map(cell)));
    return make("details", { open: true }, make("summary", { textContent: title }), make("table", {}, make("thead", {}, head), make("tbody", {}, ...body)));
  }

  /** Who is where at the time asked about. */
  #roll({ time, clock, benches, resting }) {
    const rows = benches.map(({ bench, people, mark }) => [benchTitle(bench, benches.length), people.join(between()), String(mark)]);
    const box = this.#table(say("Who is where at {time}", { time: clock ?? `${time} s` }), [phrase("bench"), phrase("people"), phrase("mark")], rows);
    box.append(make("p", { textContent: say(resting.length ? "Resting: {names}." : "Nobody rests.", { names: resting.join(between()) }) }));
    return box;
  }

  /** Each person with minutes, metres and the times in which they carry. */
  #people(carriers, start, stop) {
    const share = (time) => `${(100 * (time - start)) / (stop - start)}%`;
    const line = (spells) => {
      const bars = spells.map(({ begin, end, bench }) => {
        const bar = make("i", { title: `${bench}${say(": ")}${minutes(begin - start)}–${minutes(end - start)}` });
        Object.assign(bar.style, { left: share(begin), width: share(start + end - begin) });
        return bar;
      });
      return make("span", { className: "bars", role: "img", "aria-label": spells.map(({ begin, end, bench }) => say("bench {bench} from {begin} to {end}", { bench, begin: minutes(begin - start), end: minutes(end - start) })).join(say(", ")) }, ...bars);
    };
    const rows = carriers.map(({ label, time, way, spells }) => [label, minutes(time), way.toFixed(0), line(spells)]);
    return this.#table(say("Everybody's minutes and metres"), [phrase("person"), phrase("time"), phrase("way [m]"), phrase("when")], rows);
  }
}
