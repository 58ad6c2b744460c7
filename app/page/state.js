/** The whole state of the page; its address holds every value that differs from the default. */

/**
 * The numbers a person may set. Limits and units come from the service's OpenAPI document; `slider` is a useful range:
 * [from, to, step].
 */
export const FIELDS = [
  { name: "pitch", value: "0.55", group: "path", slider: [0.3, 2, 0.001] },
  { name: "start_turns", value: "16", group: "path", slider: [4, 40, 0.5] },
  { name: "turning_diameter", value: "9", group: "path", slider: [2, 16, 0.1] },
  { name: "benches", value: "223", group: "dragon", slider: [1, 400, 1] },
  { name: "head_length", value: "3.41", group: "dragon", slider: [1, 6, 0.01] },
  { name: "body_length", value: "2.2", group: "dragon", slider: [1, 4, 0.01] },
  { name: "width", value: "0.3", group: "dragon", slider: [0.05, 0.6, 0.005] },
  { name: "overhang", value: "0.275", group: "dragon", slider: [0, 0.45, 0.005] },
  { name: "head_speed", value: "1", group: "motion", slider: [0.1, 3, 0.05] },
  { name: "margin", value: "0", group: "motion", slider: [0, 0.2, 0.005] },
  { name: "stray", value: "0", group: "people", slider: [0, 0.2, 0.001] },
  { name: "hole", value: "0", group: "people", slider: [0, 0.1, 0.001] },
  { name: "pin", value: "0", group: "people", slider: [0, 0.1, 0.001] },
];

const namesOf = (wanted) => FIELDS.filter(({ group }) => group === wanted).map(({ name }) => name);
export const DRAGON = namesOf("dragon");
/** What counts as a contact. */
export const CONTACT = ["margin", ...namesOf("people")];
/** How far every hole may be from its place in all [m]: what people do, and half of what the pin lacks. */
export const strayOf = ({ stray, hole, pin }) => Number(stray) + (hole - pin) / 2;
export const RATES = [1, 2, 5, 10, 20, 50];
/** Default pitch of a turn, from the contest: a turn needs a wider spiral. */
const PITCHES = { spiral: "0.55", turn: "1.7" };

const NUMBERS = Object.fromEntries(FIELDS.map(({ name, value }) => [name, value]));
/** time: null is the end of the dance; view: [x, y, pixels per metre], null shows the whole path. */
const DEFAULTS = { ...NUMBERS, path: "spiral", time: null, rate: 20, follow: false, handle: null, view: null, lang: null };

const oneOf = (values) => (text) => values.find((value) => String(value) === text);
const READ = {
  path: oneOf(["spiral", "turn"]),
  time: (text) => (text.trim() && Number.isFinite(Number(text)) ? Number(text) : null),
  rate: oneOf(RATES),
  follow: (text) => text === "true",
  handle: (text) => (/^\d+$/.test(text) ? Number(text) : null),
  view(text) {
    const numbers = text.split(",").map(Number);
    return numbers.length === 3 && numbers.every(Number.isFinite) && numbers[2] > 0 ? numbers : null;
  },
  lang: oneOf(["en", "zh"]),
};

export class State {
  #values = { ...DEFAULTS };
  #listeners = [];
  #writing = 0;

  constructor() {
    const given = new URLSearchParams(location.search);
    for (const [name, text] of given) {
      if (name in DEFAULTS) this.#values[name] = (READ[name] ?? String)(text) ?? DEFAULTS[name];
    }
    if (!given.has("pitch")) this.#values.pitch = this.initial("pitch");
  }

  get(name) {
    return this.#values[name];
  }

  /** Default value of a name. */
  initial(name) {
    return name === "pitch" ? PITCHES[this.#values.path] : DEFAULTS[name];
  }

  /** The numbers of these names, as entered. */
  texts(names) {
    return Object.fromEntries(names.map((name) => [name, this.#values[name]]));
  }

  /** listener(names): called after each change with the set of names that changed */
  listen(listener) {
    this.#listeners.push(listener);
  }

  set(changes) {
    const names = Object.keys(changes).filter((name) => changes[name] !== this.#values[name]);
    if (!names.length) return;
    Object.assign(this.#values, changes);
    // Browsers refuse more than a few changes of the address per second.
    this.#writing ||= setTimeout(() => this.write(), 300);
    for (const listener of this.#listeners) listener(new Set(names));
  }

  reset(names = Object.keys(NUMBERS)) {
    this.set(Object.fromEntries(names.map((name) => [name, this.initial(name)])));
  }

  choosePath(path) {
    if (path !== this.get("path")) this.set({ path, pitch: PITCHES[path], time: null, view: null });
  }

  write() {
    clearTimeout(this.#writing);
    this.#writing = 0;
    const query = new URLSearchParams();
    for (const [name, value] of Object.entries(this.#values)) {
      if (value !== this.initial(name)) query.set(name, name === "view" ? value.map((one) => +one.toPrecision(6)) : value);
    }
    const text = query.toString().replaceAll("%2C", ",");
    history.replaceState(null, "", location.pathname + (text && `?${text}`));
  }
}
