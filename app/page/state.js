/** The whole state of the page; its address holds every value that differs from the default. */

import { benchesOf } from "./read_table.js";
import { EMPTY, PARTS, fromAddress, toAddress } from "./drawing.js";
import { FIELDS } from "./fields.js";
import { beatsIn, beatsOf, clockIn, paceTexts, passagesIn } from "./passages.js";
import { Pause } from "./pending.js";
import { writtenOut } from "./short.js";
import { languages } from "./text.js";

export const RATES = [1, 2, 5, 10, 20, 50];
/** Default pitch of a turn, from the contest: a turn needs a wider spiral. */
const PITCHES = { spiral: "0.55", turn: "1.7" };
/** Default number of benches of a drawn dance: more benches need a longer path than fits on a square. */
const DRAWN_BENCHES = "24";
/** Longest address that all browsers and chat programs accept [characters]. */
const ADDRESS_MOST = 8_000;

/** Parts of a dance in addition to its numbers, as text: a table of benches, passages, the beats that give them, the time of day at time 0 or when it begins. */
export const EXTRAS = ["csv", "passages", "beats", "start_clock", "begin_clock"];
const NUMBERS = Object.fromEntries([...FIELDS.map(({ name, value }) => [name, value]), ...EXTRAS.map((name) => [name, ""])]);
/** True if the address has nothing except the language: then the page opens with the dance in motion. */
const isBare = (address) => [...address.keys()].every((name) => name === "lang");
/** photo: where a photo behind the square lies, or null, which stays on the device; time: null is the end of the dance; ends, laps: when a proposed dance must end, and how often it goes around, as typed; dances: those of several dragons, as in an address; dragon: the chosen one; bench: the one that a carrier follows, or null; view: [x, y, pixels per metre], null shows the whole path. */
export const DEFAULTS = { ...NUMBERS, door: null, drawing: EMPTY, photo: null, path: "spiral", time: null, rate: 20, follow: false, handle: null, bench: null, ends: "", laps: "", dances: "", dragon: 0, view: null, lang: null };

const whole = (text) => (/^\d+$/.test(text) ? Number(text) : null);
const oneOf = (values) => (text) => values.find((value) => String(value) === text);
const READ = {
  door: oneOf(["arrival", "contest", "village", "look", "all"]),
  path: oneOf(["spiral", "turn", "route"]),
  time: (text) => (text.trim() && Number.isFinite(Number(text)) ? Number(text) : null),
  rate: oneOf(RATES),
  follow: (text) => text === "true",
  handle: whole,
  bench: whole,
  dragon: (text) => whole(text) ?? 0,
  view(text) {
    const numbers = text.split(",").map(Number);
    return numbers.length === 3 && numbers.every(Number.isFinite) && numbers[2] > 0 ? numbers : null;
  },
  lang: (text) => oneOf(languages())(text),
  beats: (text) => beatsIn(text) && text,
  start_clock: clockIn,
  begin_clock: clockIn,
};

export class State {
  #values = { ...DEFAULTS };
  #listeners = [];
  #writing = new Pause("address");
  /** @type {string[][]} */
  strange = [];
  /** @type {string[][]} */
  unread = [];
  /** True if the whole dance is in the address. */
  fits = true;

  constructor() {
    const query = writtenOut(location.search);
    if (query !== location.search) history.replaceState(history.state, "", location.pathname + query);
    this.#read();
    // The browser's back and forward buttons.
    addEventListener("popstate", () => {
      const before = this.#values;
      this.#writing.end();
      this.#read();
      this.#tell(Object.keys(DEFAULTS).filter((name) => name === "view" || JSON.stringify(before[name]) !== JSON.stringify(this.#values[name])));
    });
  }

  /** Take over all values of the address; a drawing too long for it is kept beside the address. */
  #read() {
    const address = new URLSearchParams(location.search);
    const values = { ...DEFAULTS };
    for (const [name, text] of address) if (name in DEFAULTS) values[name] = (READ[name] ?? String)(text) ?? DEFAULTS[name];
    /** The door of the address, if there is none of that name. */
    this.noDoor = address.has("door") && !values.door ? address.get("door") : null;
    /** What a newer page may have written: names that this one does not know, which stay in the address, and values that it cannot read. */
    this.strange = [...address].filter(([name]) => !(name in DEFAULTS || PARTS.includes(name)));
    this.unread = [...address].filter(([name, text]) => name !== "door" && text && `${name}=${text}` !== "time=end" && READ[name] && (READ[name](text) ?? null) === null);
    if (!address.has("passages") && values.beats) Object.assign(values, paceTexts({ beats: beatsIn(values.beats) }));
    if (!beatsOf(values)) values.beats = "";
    for (const name of ["csv", "dances"]) if (history.state?.[name]) values[name] = history.state[name];
    values.photo = history.state?.photo === undefined ? this.#values.photo : history.state.photo;
    values.drawing = history.state?.drawing ?? (PARTS.some((name) => address.has(name)) ? fromAddress(address) : EMPTY);
    // Behind this door stand drawn dances alone.
    if (values.door === "village" && !address.has("path")) values.path = "route";
    this.#values = values;
    for (const name of ["pitch", "benches"]) if (!address.has(name)) values[name] = this.initial(name);
    this.opensInMotion = isBare(address) && !history.state?.csv && !history.state?.dances;
    if (this.opensInMotion) Object.assign(values, { time: 0, door: "arrival" });
  }

  get(name) {
    return this.#values[name];
  }

  /** Default value of a name. */
  initial(name, path = this.#values.path) {
    if (name === "benches" && path === "route") return DRAWN_BENCHES;
    return name === "pitch" ? (PITCHES[path] ?? DEFAULTS[name]) : DEFAULTS[name];
  }

  /** The entered numbers of these names, without empty ones that are empty by default. */
  texts(names) {
    return Object.fromEntries(names.map((name) => [name, this.#values[name]]).filter(([name, text]) => text || DEFAULTS[name]));
  }

  /** Parts in addition to the numbers: the table of benches and its benches, passages, the beats that give them or null, the time of day at time 0 or when the dance begins. */
  extras() {
    const { csv, passages, start_clock: clock, begin_clock: begins } = this.#values;
    return { csv, listed: csv ? benchesOf(csv) : null, passages: passagesIn(passages), beats: beatsOf(this.#values), clock: begins ? "" : clock, beginClock: begins };
  }

  /** listener(names): called after each change with the set of names that changed */
  listen(listener) {
    this.#listeners.push(listener);
  }

  /** write: also into the address, after a pause in changes */
  set(changes, write = true) {
    // Who asks for a view gets it: a hand may have moved the picture since the last one.
    const names = Object.keys(changes).filter((name) => name === "view" || changes[name] !== this.#values[name]);
    if (!names.length) return;
    Object.assign(this.#values, changes);
    // Browsers refuse more than a few changes of the address per second.
    if (write && !this.#writing.lasts) this.#writing.begin(300, () => this.write());
    this.#tell(names);
  }

  #tell(names) {
    for (const listener of this.#listeners) listener(new Set(names));
  }

  reset(names = Object.keys(NUMBERS)) {
    this.set(Object.fromEntries(names.map((name) => [name, this.initial(name)])));
  }

  /** What changes with another kind of path. */
  changesOf(path) {
    if (path === this.get("path")) return {};
    const benches = this.get("benches") === this.initial("benches") ? this.initial("benches", path) : this.get("benches");
    // A turn is seen where it begins, with the head on its circle.
    return { time: path === "turn" ? 0 : null, view: null, path, benches, pitch: this.initial("pitch", path) };
  }

  /** more: other changes, which are made in any case */
  choosePath(path, more = {}) {
    this.push({ ...this.changesOf(path), ...more });
  }

  /** Change the state so that the browser's back button leads back to the present view. */
  push(changes = {}) {
    if (Object.keys(changes).length) this.write();
    history.pushState(history.state, "", location.href);
    this.set(changes);
    this.write();
  }

  write() {
    this.#writing.end();
    const { drawing, csv, dances, photo, ...others } = this.#values;
    // An address without anything is that of the doors.
    const rest = Object.keys(others).every((name) => name === "lang" || others[name] === this.initial(name));
    const query = new URLSearchParams(rest && !csv && !dances ? { door: "all" } : {});
    for (const [name, value] of Object.entries(others)) {
      // Beats give the passages.
      if (value === this.initial(name) || (name === "passages" && others.beats)) continue;
      query.set(name, { view: () => value.map((one) => +one.toPrecision(6)), time: () => +value.toFixed(9) }[name]?.() ?? value);
    }
    for (const [name, text] of this.strange) query.append(name, text);
    const withoutDrawing = query.toString();
    if (csv) query.set("csv", csv);
    if (dances) query.set("dances", dances);
    const isDrawn = this.#values.path === "route" || dances;
    if (isDrawn) for (const [name, text] of toAddress(drawing)) query.set(name, text);
    this.fits = query.toString().length <= ADDRESS_MOST;
    const text = (this.fits ? query.toString() : withoutDrawing).replace(/%(?:2C|7E|21|3A|40)/g, decodeURIComponent);
    history.replaceState({ photo, ...(!this.fits && { drawing, csv, dances }) }, "", location.pathname + (text && `?${text}`));
  }
}
