/**
 * The form: for each number a field, its meaning, a slider with adjustable ends, its unit, its limits, a reset, and the
 * service's message if it is wrong.
 */

import { $$, button, make, onClick, onSlide } from "./elements.js";
import { EMPTY_NAMES, FIELDS, HINTS, LABELS, LIMITS } from "./fields.js";
import { Pause } from "./pending.js";
import { say } from "./text.js";

/** Groups of numbers. @type {Phrases} */
const GROUPS = {
  path: "Path",
  dragon: "Dragon",
  motion: "Motion",
  people: "People",
};

/** A typed number counts after this pause [ms], or with Enter, so that half-typed numbers are not sent. */
const TYPING = 300;
const ENDS = ["min", "max"];
/** Number -> part of the bench in the sketch. */
const PARTS = { head_length: "length", body_length: "length", width: "width", overhang: "overhang", hole: "hole", pin: "hole" };

/** A typed number, also with a decimal comma, the only one on some phones. */
const typed = (text) => text.trim().replace(/^([-+]?\d*),(\d+)$/, "$1.$2");
/** A number in another unit, without the noise of binary fractions; other texts stay unchanged. */
export const times = (text, factor) => (factor !== 1 && text !== "" && Number.isFinite(Number(text)) ? String(Number((Number(text) * factor).toPrecision(12))) : text);
/** Factor from the service's unit to the shown unit. */
export const FACTORS = Object.fromEntries(FIELDS.map(({ name, centimetres }) => [name, centimetres ? 100 : 1]));

export class Controls {
  #rows = new Map();

  /**
   * @param {State} state
   */
  constructor(form, state) {
    this.state = state;
    form.addEventListener("submit", (event) => event.preventDefault());
    onClick("#reset-all", () => state.reset());
    for (const [group, fields] of Map.groupBy(FIELDS, (field) => field.group)) {
      const legend = make("legend", { "data-text": GROUPS[group], className: "unseen" });
      form.append(make("fieldset", { "data-group": group }, legend, ...fields.map((field) => this.#row(field))));
    }
    // The default pitch and the set of numbers depend on the path.
    state.listen((names) => names.forEach((name) => this.#show(name === "path" ? "pitch" : name)));
    state.listen((names) => names.has("path") && this.#offer());
    form.append(button({ id: "more", "aria-expanded": "false", "data-text": "More numbers and answers" }, null));
    this.#offer();
    for (const type of ["focusin", "focusout"]) form.addEventListener(type, ({ target }) => this.#point(type === "focusin" ? target.id : null));
  }

  /** Mark the part of the bench in the sketch that belongs to the chosen number. */
  #point(name) {
    for (const part of $$("#sketch [data-part]")) part.classList.toggle("chosen", PARTS[name] === part.dataset.part);
  }

  #row({ name, slider: [min, max, step], doors = [] }) {
    const change = ({ target }) => this.state.set({ [name]: times(typed(target.value), 1 / FACTORS[name]) });
    const typing = new Pause(name);
    const acts = { oninput: (event) => typing.begin(TYPING, () => change(event)), onchange: change };
    const described = { "aria-describedby": `${name}-help ${name}-limits ${name}-error` };
    const row = {
      text: make("input", { id: name, inputMode: "decimal", autocomplete: "off", spellcheck: false, onkeydown: (event) => this.#key(event, name), ...acts, ...described }),
      slider: make("input", { type: "range", tabIndex: -1, min, max, step }),
      ends: ENDS.map((end) => this.#end(name, end, end === "min" ? min : max)),
      reset: button({ className: "reset", tabIndex: -1, textContent: "↺" }, () => this.state.reset([name])),
      unit: make("span", { className: "unit" }),
      limits: make("span", { id: `${name}-limits`, className: "limits" }),
      error: make("p", { id: `${name}-error`, className: "error", hidden: true }),
    };
    onSlide(row.slider, () => change({ target: row.slider }));
    this.#rows.set(name, row);
    this.#show(name);
    const label = make("label", { htmlFor: name, "data-text": LABELS[name] });
    const help = make("span", { id: `${name}-help`, className: "help", "data-text": HINTS[name] });
    const what = make("div", { className: "what" }, label, help, row.limits);
    row.box = make("div", { className: "field", "data-field": name, "data-doors": doors.join(" ") }, what, row.text, row.unit, row.reset, row.ends[0], row.slider, row.ends[1], row.error);
    return row.box;
  }

  /** A number is one Tab stop: its arrow keys move the slider, and Escape resets it. */
  #key(event, name) {
    const { slider } = this.#rows.get(name);
    if (event.key === "Escape") this.state.reset([name]);
    else if (event.key === "ArrowUp") slider.stepUp();
    else if (event.key === "ArrowDown") slider.stepDown();
    else return;
    event.preventDefault();
    if (event.key !== "Escape") slider.dispatchEvent(new Event("input"));
  }

  /** The field for one end of a slider. */
  #end(name, end, value) {
    const onchange = ({ target: field }) => {
      const { slider } = this.#rows.get(name);
      const [low, high] = ENDS.map((one) => Number(typed(one === end ? field.value : slider[one])));
      if (field.value.trim() && low < high) slider[end] = end === "min" ? low : high;
      this.#show(name);
    };
    return make("input", { className: "end", tabIndex: -1, inputMode: "decimal", autocomplete: "off", value, onchange });
  }

  /** Show only the numbers of this path. */
  #offer() {
    for (const { name, only } of FIELDS) this.#rows.get(name).box.hidden = Boolean(only) && only !== this.state.get("path");
  }

  #show(name) {
    const row = this.#rows.get(name);
    if (!row) return;
    const text = times(this.state.get(name), FACTORS[name]);
    if (row.text.value.trim() !== text) row.text.value = text;
    row.slider.value = text;
    row.ends.forEach((field, k) => (field.value = row.slider[ENDS[k]]));
    row.reset.disabled = this.state.get(name) === this.state.initial(name);
  }

  translate() {
    for (const [name, row] of this.#rows) {
      const nameOfField = { name: say(LABELS[name]) };
      row.slider.setAttribute("aria-label", say("{name}, slider", nameOfField));
      row.reset.setAttribute("aria-label", say("Reset {name}", nameOfField));
      row.ends.forEach((field, k) => field.setAttribute("aria-label", say(ENDS[k] === "min" ? "Slider of {name} begins at" : "Slider of {name} ends at", nameOfField)));
      const [low, high, unit = ""] = LIMITS[name];
      row.unit.textContent = unit === "turns" ? say("turns") : FACTORS[name] > 1 ? "cm" : unit;
      row.limits.textContent = say(name === "stray" ? "{low} to half of the shortest distance between two handles" : "{low} to {high}", { low: low * FACTORS[name], high: high * FACTORS[name] });
      if (this.state.initial(name) === "") row.text.placeholder = say(EMPTY_NAMES[name]);
    }
  }

  /** errors: name -> error of the service; a name that is not a field is not shown here */
  refuse(errors) {
    for (const [name, row] of this.#rows) {
      const error = errors.get(name);
      const sentence = error?.sentence ?? "";
      if (row.error.textContent !== sentence) row.error.textContent = sentence;
      row.error.hidden = !error;
      row.box.classList.toggle("wrong", Boolean(error));
      row.text.setAttribute("aria-invalid", Boolean(error));
    }
  }
}
