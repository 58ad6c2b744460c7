/** The form: for each number a field, a slider, its unit, its limits, a reset, and the service's words when it is wrong. */

import { FIELDS } from "./state.js";
import { say } from "./text.js";

/** An element with these properties and children; `class` and attributes with a dash or of ARIA go in by name. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** Half-typed numbers are not asked: a text counts after a pause of the hand [ms], or with Enter. */
const TYPING = 300;

export class Controls {
  #rows = new Map();
  #groups = new Map();

  constructor(form, state) {
    this.state = state;
    form.addEventListener("submit", (event) => event.preventDefault());
    form.querySelector("#reset-all").addEventListener("click", () => state.reset());
    for (const field of FIELDS) this.#group(form, field.group).append(this.#row(field));
    state.addEventListener("change", ({ detail }) => detail.forEach((name) => this.#show(name)));
  }

  #group(form, name) {
    if (!this.#groups.has(name)) {
      const group = make("fieldset", {}, make("legend", { "data-text": name }));
      this.#groups.set(name, group);
      form.append(group);
    }
    return this.#groups.get(name);
  }

  #row({ name, unit, slider: [min, max, step] }) {
    const change = (event) => this.state.set({ [name]: event.target.value.trim() });
    const described = { "aria-describedby": `${name}-limits ${name}-error` };
    const row = {
      text: make("input", { id: name, inputMode: "decimal", autocomplete: "off", spellcheck: false, ...described }),
      slider: make("input", { type: "range", min, max, step }),
      reset: make("button", { type: "button", className: "reset", textContent: "↺" }),
      limits: make("span", { id: `${name}-limits`, className: "limits" }),
      error: make("p", { id: `${name}-error`, className: "error", lang: "en", hidden: true }),
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
    const shownUnit = make("span", { className: "unit", ...(unit === "turns" ? { "data-text": unit } : { textContent: unit }) });
    return make("div", { className: "field" }, label, row.text, shownUnit, row.reset, row.slider, row.limits, row.error);
  }

  #show(name) {
    const row = this.#rows.get(name);
    if (!row) return;
    const text = this.state.get(name);
    if (row.text.value.trim() !== text) row.text.value = text;
    row.slider.value = text;
    row.reset.disabled = text === FIELDS.find((field) => field.name === name).value;
  }

  /** limits: name -> [low, high] as the service states them */
  translate(limits) {
    for (const [name, row] of this.#rows) {
      row.slider.setAttribute("aria-label", say("slider", { name: say(name) }));
      row.reset.setAttribute("aria-label", say("reset", { name: say(name) }));
      const [low, high] = limits[name] ?? [];
      row.limits.textContent = low === undefined ? "" : say("limits", { low, high });
    }
  }

  /** errors: name -> the service's words; a name that is no field is not shown here */
  refuse(errors) {
    for (const [name, row] of this.#rows) {
      const words = errors.get(name) ?? "";
      if (row.error.textContent !== words) row.error.textContent = words;
      row.error.hidden = !words;
      row.text.setAttribute("aria-invalid", String(Boolean(words)));
    }
  }
}
