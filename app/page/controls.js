/** The form: for each number a field, a slider, its unit, its limits, a reset, and the service's words when it is wrong. */

import { make, onClick } from "./elements.js";
import { FIELDS } from "./state.js";
import { refusalWords, say } from "./text.js";

/** Half-typed numbers are not asked: a text counts after a pause of the hand [ms], or with Enter. */
const TYPING = 300;

export class Controls {
  #rows = new Map();

  constructor(form, state) {
    this.state = state;
    form.addEventListener("submit", (event) => event.preventDefault());
    onClick("#reset-all", () => state.reset());
    for (const [group, fields] of Map.groupBy(FIELDS, (field) => field.group)) {
      const legend = make("legend", { "data-text": group });
      form.append(make("fieldset", {}, legend, ...fields.map((field) => this.#row(field))));
    }
    // Another path has another pitch to reset to.
    state.listen((names) => names.forEach((name) => this.#show(name === "path" ? "pitch" : name)));
  }

  #row({ name, slider: [min, max, step] }) {
    const change = (event) => this.state.set({ [name]: event.target.value.trim() });
    const described = { "aria-describedby": `${name}-limits ${name}-error` };
    const row = {
      text: make("input", { id: name, inputMode: "decimal", autocomplete: "off", spellcheck: false, ...described }),
      slider: make("input", { type: "range", min, max, step }),
      reset: make("button", { type: "button", className: "reset", textContent: "↺" }),
      unit: make("span", { className: "unit" }),
      limits: make("span", { id: `${name}-limits`, className: "limits" }),
      error: make("p", { id: `${name}-error`, className: "error", hidden: true }),
    };
    let typing = 0;
    row.text.addEventListener("input", (event) => {
      clearTimeout(typing);
      typing = setTimeout(change, TYPING, event);
    });
    row.text.addEventListener("change", change);
    row.slider.addEventListener("input", change);
    row.reset.addEventListener("click", () => this.state.reset([name]));
    this.#rows.set(name, row);
    this.#show(name);
    const label = make("label", { htmlFor: name, "data-text": name });
    return make("div", { className: "field" }, label, row.text, row.unit, row.reset, row.slider, row.limits, row.error);
  }

  #show(name) {
    const row = this.#rows.get(name);
    if (!row) return;
    const text = this.state.get(name);
    if (row.text.value.trim() !== text) row.text.value = text;
    row.slider.value = text;
    row.reset.disabled = text === this.state.initial(name);
  }

  /** limits: name -> [low, high, unit] as the service states them */
  translate(limits) {
    for (const [name, row] of this.#rows) {
      row.slider.setAttribute("aria-label", say("slider", { name: say(name) }));
      row.reset.setAttribute("aria-label", say("reset", { name: say(name) }));
      const [low, high, unit = ""] = limits[name] ?? [];
      row.unit.textContent = unit === "turns" ? say(unit) : unit;
      row.limits.textContent = low === undefined ? "" : say("limits", { low, high });
    }
  }

  /** errors: name -> the service's words; a name that is no field is not shown here */
  refuse(errors) {
    for (const [name, row] of this.#rows) {
      const detail = errors.get(name) ?? "";
      const said = refusalWords(detail);
      if (row.error.textContent !== said.textContent) Object.assign(row.error, said);
      row.error.hidden = !detail;
      row.text.setAttribute("aria-invalid", Boolean(detail));
    }
  }
}
