/** The form of a sweep: a question for many values of one or two parameters, the others as on the page. */

import { commandFor } from "./api.js";
import { make } from "./elements.js";
import { CONTACT, DRAGON, FIELDS, LABELS } from "./fields.js";
import { phrase, say } from "./text.js";

const SPIRAL = [...DRAGON, "pitch", "start_turns", "head_speed"];
const CIRCLE = [...DRAGON, "turning_diameter", "start_turns"];
/** Questions for sweeps on the page: the parameters of each, its main value, and the path of its dance. */
export const QUESTIONS = {
  collision_time: { title: phrase("First contact"), parameters: [...SPIRAL, ...CONTACT], value: "time", path: "spiral", named: phrase("first contact [s]") },
  minimum_pitch: { title: phrase("Minimum pitch"), parameters: [...CIRCLE, ...CONTACT], value: "pitch", path: "spiral", named: phrase("minimum pitch [m]") },
  least_clearance: { title: phrase("Least clearance"), parameters: SPIRAL, value: "distance", path: "spiral", named: phrase("least clearance [m]") },
  shortest_turn: { title: phrase("Shortest turn"), parameters: [...CIRCLE, "pitch", ...CONTACT], value: "length", path: "turn", named: phrase("length of the turn [m]") },
  quickest_turn: { title: phrase("Quickest turn"), parameters: [...CIRCLE, "pitch", "margin"], value: "time", path: "turn", named: phrase("time through the turn [s]") },
  tolerance: { title: phrase("How far people may stray"), parameters: [...SPIRAL, "turning_diameter"], value: "stray", path: "spiral", named: phrase("stray [m]") },
  maximum_head_speed: { title: phrase("Highest speed of the head in a turn"), parameters: [...CIRCLE, "pitch"], value: "head_speed", path: "turn", named: phrase("speed of the head [m/s]") },
};
/** First values of the form: parameter, from, to, count. */
const FIRST = [["pitch", 0.45, 0.6, 31], ["width", 0.25, 0.35, 11]];
const COUNT_MAX = 200;
const NONE = "";
const CSV = "text/csv";
/** The form in which tables of sweeps are kept. */
export const TABLE = "application/vnd.apache.parquet";

function labelledOption(value) {
  const text = value ? LABELS[value] : phrase("none");
  return make("option", { value, "data-text": text, textContent: say(text) });
}

export class SweepForm {
  #rows;

  /**
   * start(spec): asks the service; throws its refusal
   * @param {State} state
   */
  constructor(form, state, start) {
    this.state = state;
    this.start = start;
    const options = Object.entries(QUESTIONS).map(([value, { title }]) => make("option", { value, "data-text": title }));
    this.question = make("select", { id: "sweep-question", onchange: () => this.#offer() }, ...options);
    this.#rows = FIRST.map((first, k) => this.#row(k, first));
    this.error = make("p", { id: "sweep-error", className: "error", role: "alert" });
    const go = make("button", { className: "main", "data-text": "Start" });
    const label = make("label", { htmlFor: "sweep-question", "data-text": "Question" });
    const command = make("code");
    const text = make("pre", { tabIndex: 0, role: "region", "data-label": "Command for this sweep" }, command);
    const terminal = make("details", {}, make("summary", { "data-text": "The same from a terminal" }), text);
    const tell = () => terminal.open && (command.textContent = this.#commands());
    for (const [one, event] of [[terminal, "toggle"], [form, "change"]]) one.addEventListener(event, tell);
    state.listen(tell);
    form.append(make("p", {}, label, " ", this.question), ...this.#rows.map(({ box }) => box), make("p", {}, go), this.error, terminal);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#submit();
    });
    this.#offer();
  }

  #row(k, /** @type {(string | number)[]} */ [name, from, to, count]) {
    const number = (label, value, more = {}) => make("input", { type: "number", step: "any", required: true, value, "data-label": label, ...more });
    const row = {
      k,
      name: make("select", { id: `sweep-name-${k}`, "data-label": "Parameter", onchange: ({ target }) => this.#choose(row, (row.chosen = target.value)) }),
      from: number(phrase("from"), from, { id: `sweep-sweepFrom-${k}` }),
      to: number(phrase("to"), to, { id: `sweep-sweepTo-${k}` }),
      count: number(phrase("how many"), count, { id: `sweep-sweepCount-${k}`, step: 1, min: 2, max: COUNT_MAX }),
      wanted: name,
      chosen: name,
      kept: {},
    };
    const legend = make("legend", { "data-text": k ? phrase("Second parameter") : phrase("First parameter") });
    const part = (key) => make("label", { htmlFor: row[key].id }, make("span", { "data-text": row[key].dataset.label }), row[key]);
    row.numbers = ["from", "to", "count"].map(part);
    row.box = make("fieldset", {}, legend, make("div", { className: "axis" }, row.name, ...row.numbers));
    return row;
  }

  /** Offer the parameters of the question; one that it does not have is replaced until a question has it again. */
  #offer() {
    const { parameters } = QUESTIONS[this.question.value];
    const has = ({ chosen }) => parameters.includes(chosen);
    const taken = new Set(this.#rows.filter(has).map(({ chosen }) => chosen));
    for (const row of this.#rows) {
      const known = row.k ? [NONE, ...parameters] : parameters;
      const options = known.map((name) => labelledOption(name));
      row.name.replaceChildren(...options);
      const wanted = has(row) || row.chosen === NONE ? row.chosen : known.find((name) => !taken.has(name));
      if (wanted === row.wanted) row.name.value = wanted;
      else this.#choose(row, wanted);
      taken.add(wanted);
    }
  }

  #choose(row, name) {
    row.kept[row.wanted] = [row.from.value, row.to.value];
    row.name.value = row.wanted = name;
    for (const part of row.numbers) part.hidden = !name;
    for (const key of ["from", "to", "count"]) row[key].disabled = !name;
    const field = FIELDS.find((one) => one.name === name);
    if (field) [row.from.value, row.to.value] = row.kept[name] ?? field.slider.map((one) => (field.centimetres ? one / 100 : one));
  }

  /** The spec of the sweep. */
  spec() {
    const question = this.question.value;
    const rows = this.#rows.filter((row) => row.wanted);
    const over = Object.fromEntries(rows.map((row) => [row.wanted, axis(row)]));
    const others = QUESTIONS[question].parameters.filter((name) => !(name in over));
    const request = Object.fromEntries(others.map((name) => [name, Number(this.state.get(name))]));
    return { question, over, request, accept: TABLE };
  }

  /** The commands that start the sweep, wait for its end and save its table. */
  #commands() {
    const at = (path) => `"${new URL("jobs/", location.href).href}$job/${path}"`;
    return [
      `job=$(${commandFor("sweeps", { ...this.spec(), accept: CSV })} | grep -o '"jobID":"[^"]*"' | cut -d'"' -f4)`,
      `curl ${at("events")} >/dev/null`,
      `curl ${at("result")} -o sweep.csv`,
    ].join("\n");
  }

  async #submit() {
    const [first, second] = this.#rows.map((row) => row.wanted);
    this.error.textContent = first === second ? say("The two parameters must differ.") : "";
    if (this.error.textContent) return;
    await this.start(this.spec()).catch((error) => {
      if (!error.problem) throw error;
      this.error.textContent = error.problem.sentence;
    });
  }
}

/** Values of a parameter: a range, or whole numbers. */
function axis({ wanted, from, to, count }) {
  const [start, stop, steps] = [from, to, count].map((field) => Number(field.value));
  if (wanted !== "benches") return { start, stop, count: steps };
  const whole = Array.from({ length: steps }, (_, k) => Math.round(start + ((stop - start) * k) / (steps - 1)));
  return [...new Set(whole)];
}
