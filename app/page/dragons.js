/** Several dragons on one clock: their list, the question about all of them, and their common picture. */

import { Problem, Superseded, TOO_LONG } from "./api.js";
import { joined, offsetOf, shiftedPath } from "./changes.js";
import { SPAN, announceOpened, leftWords, wishesIn, wishesOf } from "./files.js";
import { benchesOf, numbersOfListed } from "./read_table.js";
import { EMPTY, THINGS, drawingOf, fromAddress, keptVenueOf, venueOf } from "./drawing.js";
import { $, button, download, hide, make, numberIn, textButton } from "./elements.js";
import { CONTACT, DRAGON, TURN, numbersOf } from "./fields.js";
import { stepsOf } from "./history.js";
import { Judgement } from "./judgement.js";
import { announce, announceStep } from "./overlays.js";
import { beatsOf, passagesIn } from "./passages.js";
import { pending } from "./pending.js";
import { announceReplaced, isPresetVenue } from "./presets.js";
import { isFurther, queued } from "./queue.js";
import { announceSaved } from "./saved.js";
import { language, phrase, say, sayIn, writeTexts } from "./text.js";
import { LEGS, OWN, PARTS, PRESETS, Tracks, isForeign, legsOf, recordOf, recordText, recordsIn, trackOf, wayOf } from "./together.js";

/** Dances to begin with. @type {Phrases} */
const PRESET_NAMES = {
  spiral: "two in one spiral",
  streets: "streets that cross",
  parade: "a parade of three",
};
/** Names of the first dragons. */
const COLOURED = [phrase("red"), phrase("blue"), phrase("green")];

/** Colours of the dragons on a light and on a dark ground; each can be read as a name beside its head. */
const LIGHT = ["#b3261e", "#0b5cad", "#1a6f33", "#a3158f", "#b85c00", "#0f7b7b", "#6b5b95", "#7a5200"];
const DARK = ["#ff8b7c", "#6cb4ff", "#63d585", "#ff8de9", "#ff9d4d", "#4fc7c7", "#b9a6e6", "#f0bd5b"];
const isDark = () => document.documentElement.dataset.theme === "dark" && !matchMedia("print").matches;
/** Largest delay [s], and waiting time of a copy [s]. */
const [DELAY_MOST, LATER] = [1e6, 30];
/** What a preset changes of a spiral besides its pitch. */
const START = ["benches", "start_turns"];
/** Longest wait of a dragon behind another one that is looked for [s]. */
const WAIT_MOST = 600;
const DEGREE = Math.PI / 180;

/** Way of an arrow key along a row. */
const WAYS = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 };
/** @returns {any[]} */
const partsOf = (row) => [...row.querySelectorAll("button, input")].filter((one) => !one.disabled);

/** True for values with a drawn path. */
const isDrawn = ({ path }) => path === "route";
/** A dragon with another drawn path. */
const on = (record, drawing) => ({ ...Object.fromEntries(Object.entries(record).filter(([name]) => !LEGS.includes(name))), ...Object.fromEntries(legsOf(drawing)) });

export class Dragons {
  #loads = Symbol("dragons");
  /** The dance before a preset took its place, as a record. */
  #before = {};
  /** True while the list is to come into view, because a person has opened it. */
  #comes = false;
  /** Paths of the dragons of the shown dance. @type {any[]} */
  #ways = [];

  /**
   * paths(ways): draws the paths; draw(): the picture
   * @param {{ state: State, service: Service, questions: Questions, dance: any, draw: any, player: any }} parts
   */
  constructor({ state, service, questions, dance, draw, player }) {
    this.state = state;
    this.service = service;
    this.questions = questions;
    this.steps = stepsOf(state);
    this.picture = dance;
    this.draw = draw;
    this.player = player;
    this.box = $("#dragons");
    this.list = make("ul", { "aria-labelledby": "dragons-title" });
    this.list.addEventListener("keydown", (event) => this.#move(event));
    this.list.addEventListener("focusin", ({ target }) => this.#rest(target));
    this.wrong = make("p", { className: "error", role: "alert" });
    /** The dragons of which no delay of the last one is known to be safe: {text, k, least: delay [s], problem: of the search, or null}; null without. @type {any} */
    this.note = null;
    this.apart = make("p", { className: "error", id: "dragons-apart", role: "status", hidden: true });
    const presets = Object.entries(PRESET_NAMES).map(([name, words]) => textButton(words, () => this.begin(name), { "data-dragons": name }));
    this.panel = make(
      "div",
      { hidden: true },
      make("h2", { id: "dragons-title", "data-text": "Dragons" }),
      make("p", { className: "hint", "data-text": "The numbers below are those of the chosen dragon. All dance on one clock. Arrow keys move along a row." }),
      this.list,
      this.wrong,
      this.apart,
      make("p", { className: "buttons" }, textButton("Add a dragon", () => this.add(), { id: "dragon-add" }), textButton("Save all as a file", () => this.#save(), { id: "dragons-save" }), textButton("One dragon again", () => this.#close(), { id: "dragons-close" })),
    );
    this.offer = make("p", { className: "buttons" }, make("span", { className: "hint", "data-text": "Or begin with:" }), ...presets);
    this.box.append(this.panel, this.offer);
    dance.headTapped = (k) => this.choose(k);
    this.judgement = new Judgement($("#judgement"), (failure) => player.seek(failure.time), () => {});
  }

  get #records() {
    const text = this.state.get("dances");
    return text ? recordsIn(text) : [];
  }

  get #active() {
    return Math.min(this.state.get("dragon"), this.#records.length - 1);
  }

  #nameOf(records, k, lang = language()) {
    return records[k].name || (k < COLOURED.length ? sayIn(lang, COLOURED[k]) : sayIn(lang, "dragon {number}", { number: k + 1 }));
  }

  #colourOf = (record, k) => (/^#[0-9a-f]{6}$/.test(record.colour ?? "") ? record.colour : (isDark() ? DARK : LIGHT)[k % LIGHT.length]);

  /** The texts of the shown dance that differ from the defaults. */
  #present() {
    const path = this.state.get("path");
    const pairs = PARTS.filter((name) => this.state.get(name) !== this.state.initial(name, path)).map((name) => [name, this.state.get(name)]);
    return Object.fromEntries([...pairs, ...(path === "route" ? legsOf(this.state.get("drawing")) : [])]);
  }

  /**
   * All values of the dance of a record, among what stands in the common square.
   * common: the drawing of the square
   * @returns {any}
   */
  #valuesOf(record, common = this.state.get("drawing")) {
    const path = record.path ?? "spiral";
    const values = Object.fromEntries(PARTS.map((name) => [name, record[name] ?? this.state.initial(name, path)]));
    const { things, origin, grid, yard, limit } = common;
    const legs = LEGS.filter((name) => name in record).map((name) => [name, record[name]]);
    return { ...values, path, drawing: { ...(path === "route" ? fromAddress(new URLSearchParams(legs)) : EMPTY), things, origin, grid, yard, limit } };
  }

  /** Take other dragons; the chosen one is the shown dance. others: changes of the state */
  #take(records, active = this.#active, others = {}) {
    this.steps.change({ ...others, dances: this.#textOf(records, active), dragon: active });
  }

  /** The text of dragons in an address. */
  #textOf(records, active) {
    const texts = records.map((record, k) => recordText(k === active ? Object.fromEntries(Object.entries(record).filter(([name]) => OWN.includes(name))) : record));
    // A list of one dragon without anything would be no list.
    return texts.join("~") || "name:";
  }

  /** The records, with the shown dance in that of the chosen dragon; the shown dance alone where there is no list. */
  #whole() {
    if (!this.state.get("dances")) return [this.#present()];
    return this.#records.map((record, k) => (k === this.#active ? { ...record, ...this.#present() } : record));
  }

  /** True for the benches and the start of a preset. */
  get #isPreset() {
    return START.every((name) => this.state.get(name) === PRESETS.spiral[0][name]);
  }

  begin(name) {
    const records = PRESETS[name];
    if (!this.#isPreset) this.#before = this.#present();
    // A person's own square stays, and the verdict says what does not fit into it.
    const drawing = this.state.get("drawing");
    const values = this.#valuesOf(records[0], isPresetVenue(drawing) ? EMPTY : drawing);
    this.#take(records, 0, { ...values, time: null, view: null, follow: false });
    announceReplaced(drawing, values.drawing);
  }

  /** Open a FILE of several: in place of what is there, or beside it. name: of the file */
  open({ venue = null, speed_limit: limit = null, start_clock: clock = "", begin_clock: begins = "", ...content }, name, isBeside = false) {
    const square = drawingOf({ path: null, venue, speed_limit: limit }, (kind) => say(THINGS[kind]));
    const before = this.state.get("drawing");
    const by = isBeside ? offsetOf(before, square) : [0, 0];
    const dances = content.dances.map((one) => ({ ...one, path: shiftedPath(one.path, by) }));
    const foreign = dances.findIndex(({ path }) => isForeign(path));
    if (foreign >= 0) return announce(() => say("{name}: the page shows spirals around x = y = 0 that are danced clockwise; use the command for this file.", { name: dances[foreign].name ?? say("dragon {number}", { number: foreign + 1 }) }));
    const records = dances.map(recordOf);
    const unread = SPAN.filter((one) => typeof content[one] === "number");
    const others = { time: null, view: null, handle: null };
    if (isBeside) {
      const { drawing, left } = joined(before, square);
      const isEmpty = !this.state.get("dances") && before.points.length < 2 && !before.path;
      const [all, active] = isEmpty ? [records, 0] : [[...this.#whole(), ...records], Math.max(this.#active, 0)];
      this.#take(all, active, { ...this.#valuesOf(all[active], drawing), ...others });
      return announceOpened(name, unread, leftWords(left));
    }
    const numbers = Object.fromEntries(CONTACT.map((one) => [one, typeof content[one] === "number" ? String(content[one]) : this.state.initial(one)]));
    this.#take(records, 0, { ...this.#valuesOf(records[0], square), ...numbers, ...wishesOf(content), start_clock: clock, begin_clock: begins, ...others });
    announceOpened(name, unread);
  }

  choose(k) {
    const records = this.#whole();
    this.#take(records, k, { ...this.#valuesOf(records[k]), handle: null });
  }

  /** Add a dragon like the chosen one: in the same spiral from the other side, or behind the last one on its drawn path. */
  add() {
    this.#comes = !this.state.get("dances");
    if (this.state.get("path") === "route") return this.#follow(this.#whole().length - 1);
    const spiral = this.state.get("path") === "spiral";
    const k = Math.max(this.#active, 0);
    const record = this.#whole()[k];
    this.#copy(k, spiral ? { rotation: String((Number(record.rotation ?? 0) + 180) % 360 || "") } : {}, spiral ? 0 : LATER);
  }

  /**
   * Add a dragon like dragon k behind the last one of its street, with the shortest delay that the service has proven safe,
   * or say that there is none.
   */
  async #follow(k) {
    const records = this.#whole();
    const values = records.map((record) => this.#valuesOf(record));
    const rear = values.reduce((last, one, at) => (isDrawn(one) && isFurther(one.drawing, values[last].drawing, true) ? at : last), k);
    const [numbers, own] = [values[rear], values[k]].map((one) => this.#numbersOf(one));
    const row = isDrawn(values[k]) ? queued(values[rear].drawing, numbers, own) : null;
    // Whoever ends in the street of the last one goes on, so that the new one has room there.
    const ahead = (record, at) => (row && isDrawn(values[at]) && isFurther(values[at].drawing, values[rear].drawing, false) ? on(record, queued(values[at].drawing, numbers, own).ahead) : record);
    const next = [...records.map(ahead), { ...(row ? on(records[k], row.behind) : records[k]), name: "", colour: "" }];
    const active = Math.max(this.#active, 0);
    const shown = this.#valuesOf(next[active]);
    this.#take(next, active, { ...shown, drawing: { ...shown.drawing, ...(row && { things: row.things }) }, view: null, handle: null });
    await this.#wait(records.length, Number(records[row ? rear : k].delay ?? 0));
  }

  /** The numbers of a dance as `streetLength` takes them. */
  #numbersOf(values) {
    return { get: (name) => values[name] ?? this.state.get(name), extras: () => ({ csv: values.csv, listed: values.csv ? benchesOf(values.csv) : null }) };
  }

  /** Give dragon k the shortest safe delay, from that of the one before [s]. isStep: as a change of its own, of which a sentence says what it is */
  async #wait(k, least, isStep = false) {
    const text = this.#text;
    const { dances, ...limits } = this.#file();
    const contact = Object.fromEntries(CONTACT.filter((name) => name in limits).map((name) => [name, limits[name]]));
    const spoken = language();
    let [answer, problem] = [{ safe: [], summary: "" }, null];
    const ask = (from, most) => this.service.ask("safe delay", "safe-delay", { body: { dances, ...contact, part: k, least: from, most } });
    try {
      answer = await ask(least, least + WAIT_MOST);
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      ({ problem } = error);
      // Once the others have ended, one look suffices.
      const end = Math.ceil(this.questions.dance?.report?.stop ?? 0);
      if (problem.type === TOO_LONG && end > least) answer = await ask(end, end + 1).catch(() => answer);
    }
    if (this.#text !== text) return; // A person has changed the dragons meanwhile.
    const [first] = answer.safe;
    this.note = first ? null : { text, k, least, problem, words: answer.summary, spoken };
    if (!first) return this.#noted();
    const tenth = Math.ceil(10 * first[0]) / 10;
    const delay = tenth <= first[1] ? tenth : first[0];
    const records = this.#whole();
    const next = records.with(k, { ...records[k], delay: delay ? String(delay) : "" });
    if (isStep) {
      this.#take(next);
      const name = this.#nameOf(next, k);
      announceStep(() => (problem ? say("The shortest wait of {name} takes too long to find; {delay} s are safe: then the others have ended.", { name, delay }) : answer.summary));
      // It belongs to the step in which the dragon was added.
    } else if (delay > least) this.state.set({ dances: this.#textOf(next, this.#active) });
  }

  /** Let the chosen dragon, which has a new path, come in behind who begins at its place; it waits until they let it pass, or those behind it wait. */
  async waits() {
    const [records, k] = [this.#whole(), this.#active];
    const values = records.map((record) => this.#valuesOf(record));
    const own = this.#numbersOf(values[k]);
    let { drawing } = values[k];
    const others = [...records.keys()].filter((at) => at !== k && isDrawn(values[at]));
    const rowOf = (at, one = drawing) => queued(one, this.#numbersOf(values[at]), own);
    const begins = (at, one) => isFurther(values[at].drawing, one, true);
    // Who stands further out leaves this place free, and follows.
    for (let at = 0; at !== undefined; ) {
      at = others.find((one) => rowOf(one) && begins(one, drawing) && !begins(one, rowOf(one).behind));
      if (at !== undefined) drawing = { ...rowOf(at).behind, things: rowOf(at).things };
    }
    const behind = others.filter((at) => begins(at, drawing));
    // Whoever is ahead in the street in which both end goes on, so that the other one has room there.
    for (const at of behind) if (isFurther(drawing, values[at].drawing, false) && rowOf(at)) drawing = { ...rowOf(at).ahead, things: rowOf(at).things };
    const isAhead = (at) => others.includes(at) && !behind.includes(at) && isFurther(values[at].drawing, drawing, false);
    const next = records.map((record, at) => (isAhead(at) && rowOf(at, values[at].drawing) ? on(record, rowOf(at, values[at].drawing).ahead) : record));
    if (drawing !== values[k].drawing) this.#take(next, k, { drawing, view: null });
    for (const at of behind.length ? behind : [k]) await this.#wait(at, 0, true);
  }

  /** Say that no delay keeps the last dragon apart, or why none was found, as long as they and their square are these. */
  #noted() {
    const is = this.note !== null && this.note.text === this.#text;
    if (!is) this.note = null;
    hide(this.apart, !is);
    if (!is) return;
    const { k, least, problem, words, spoken } = this.note;
    if (spoken !== language()) return this.#wait(k, least);
    const name = this.#nameOf(this.#records, k);
    this.apart.textContent = problem ? say("How long {name} has to wait was not found: {why} It dances without a delay of its own: type one, or make the dragons or the path shorter.", { name, why: problem.sentence }) : words;
  }

  /** Copy dragon k; on a drawn path it comes in behind it. changes: of the copy; later: how much later it dances [s] */
  #copy(k, changes = {}, later = LATER) {
    const records = this.#whole();
    if (this.#valuesOf(records[k]).path === "route") return this.#follow(k);
    const delay = Number(records[k].delay ?? 0) + later;
    this.#take([...records, { ...records[k], name: "", colour: "", delay: delay ? String(delay) : "", ...changes }], Math.max(this.#active, 0));
  }

  #remove(k) {
    const records = this.#whole();
    const left = records.toSpliced(k, 1);
    const active = this.#active;
    if (k !== active) return this.#take(left, active - (k < active ? 1 : 0));
    const next = Math.min(k, left.length - 1);
    this.#take(left, next, { ...this.#valuesOf(left[next]), handle: null });
  }

  #close() {
    // Who just looks sees no start of a preset, so the one of before comes back, and the benches.
    const isHidden = this.#isPreset && this.state.get("door") === "look" && this.state.get("path") === "spiral";
    const before = this.#valuesOf(this.#before);
    this.steps.change({ dances: "", dragon: 0, ...(isHidden && Object.fromEntries(START.map((name) => [name, before[name]]))) });
  }

  /** Change what dragon k has in addition to its dance. */
  #set(k, name, text) {
    const records = this.#whole();
    this.#take(records.with(k, { ...records[k], [name]: text }));
  }

  #number(k, name, field) {
    const number = numberIn(field.value);
    const isNumber = field.value.trim() === "" || (typeof number === "number" && Math.abs(number) <= DELAY_MOST);
    field.setAttribute("aria-invalid", !isNumber);
    this.wrong.textContent = isNumber ? "" : say("“{text}” is no number.", { text: field.value });
    if (isNumber) this.#set(k, name, Number(number) ? String(number) : "");
  }

  #rename(k, field) {
    const records = this.#records;
    const name = field.value.trim();
    const isTaken = records.some((_, other) => other !== k && this.#nameOf(records, other) === name);
    field.setAttribute("aria-invalid", isTaken);
    this.wrong.textContent = isTaken ? say("Another dragon is called “{name}”.", { name }) : "";
    if (!isTaken) this.#set(k, "name", name);
  }

  /** After a change of the state or of the language. */
  show() {
    const records = this.#records;
    const isOn = records.length > 0;
    $("main").classList.toggle("several", isOn);
    this.panel.hidden = !isOn;
    $("#several").hidden = isOn;
    if (!isOn) {
      this.list.replaceChildren();
      this.picture.scene.parts = null;
      this.#ways = [];
      this.picture.setWays([]);
      $("#judgement").hidden = this.state.get("path") !== "route";
      return;
    }
    $("#judgement").hidden = false;
    const focused = document.activeElement?.id;
    this.list.replaceChildren(...records.map((record, k) => this.#row(records, record, k)));
    if (focused && this.list.querySelector(`#${CSS.escape(focused)}`)) $(`#${CSS.escape(focused)}`).focus();
    this.#noted();
    writeTexts();
    if (this.#comes) this.panel.scrollIntoView();
    this.#comes = false;
  }

  #row(records, record, k) {
    const name = this.#nameOf(records, k);
    const isActive = k === this.#active;
    const label = (words, input) => make("label", {}, make("span", { textContent: say(words) }), input);
    const input = (key, value, properties) => make("input", { id: `${key}-${k}`, value, autocomplete: "off", ...properties });
    const numbers = [label(phrase("Delay [s]"), input("dragon-delay", record.delay ?? "0", { inputMode: "decimal", onchange: ({ target }) => this.#number(k, "delay", target) }))];
    const path = isActive ? this.state.get("path") : (record.path ?? "spiral");
    if (path === "spiral") numbers.push(label(phrase("Turned by [°]"), input("dragon-turn", record.rotation ?? "0", { inputMode: "decimal", onchange: ({ target }) => this.#number(k, "rotation", target) })));
    const alone = records.length < 2;
    numbers.push(button({ id: `dragon-wait-${k}`, textContent: say("Smallest safe delay"), disabled: alone }, () => this.#wait(k, 0, true)));
    const row = make(
      "li",
      { "data-dragon": k },
      button({ id: `dragon-choose-${k}`, textContent: k + 1, "aria-pressed": isActive, "aria-label": say("Choose {name}", { name }) }, () => this.choose(k)),
      input("dragon-colour", this.#colourOf(record, k), { type: "color", "aria-label": say("Colour"), onchange: ({ target }) => this.#set(k, "colour", target.value) }),
      label(phrase("Name"), input("dragon-name", name, { maxLength: 40, onchange: ({ target }) => this.#rename(k, target) })),
      button({ id: `dragon-copy-${k}`, textContent: "×2", title: say("Copy {name}", { name }), "aria-label": say("Copy {name}", { name }) }, () => this.#copy(k)),
      button({ id: `dragon-remove-${k}`, textContent: "✕", disabled: alone, title: say("Remove {name}", { name }), "aria-label": say("Remove {name}", { name }) }, () => this.#remove(k)),
      make("div", { className: "numbers" }, ...numbers),
    );
    const [first, ...others] = partsOf(row);
    first.tabIndex = 0;
    for (const one of others) one.tabIndex = -1;
    return row;
  }

  /** A row is one Tab stop: the part of it that had the focus last. */
  #rest(target) {
    for (const one of partsOf(target.closest("li"))) one.tabIndex = one === target ? 0 : -1;
  }

  /** Arrow keys move along a row, and those to the side leave a text only at its end. */
  #move(event) {
    const { key, target } = event;
    const way = WAYS[key];
    if (!way || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    const end = way < 0 ? 0 : target.value.length;
    const isSideways = key === "ArrowLeft" || key === "ArrowRight";
    if (isSideways && target.type === "text" && (target.selectionStart !== end || target.selectionEnd !== end)) return;
    event.preventDefault();
    const parts = partsOf(target.closest("li"));
    const next = parts[parts.indexOf(target) + way];
    if (!next) return;
    // What was typed counts, and the list is written anew.
    target.blur();
    const there = $(`#${next.id}`);
    there?.focus();
    there?.select?.();
  }

  /** The dance of each record: its numbers, its body in a request, and what the picture needs. */
  #parts() {
    const records = this.#whole();
    return records.map((record, k) => {
      const values = this.#valuesOf(record);
      const { path: kind, csv, drawing } = values;
      const names = [...DRAGON, "pitch", "start_turns", "head_speed", ...(kind === "turn" ? TURN : [])];
      const numbers = /** @type {any} */ (numbersOf(Object.fromEntries(names.map((name) => [name, String(values[name])]).filter(([, text]) => text !== ""))));
      const listed = csv ? benchesOf(csv) : null;
      const extras = { csv, listed, passages: passagesIn(values.passages), beats: beatsOf(values), clock: "", beginClock: "" };
      if (listed) Object.assign(numbers, numbersOfListed(listed));
      const top = Math.max(numbers.head_speed, ...extras.passages.map(({ speed }) => Number(speed) || 0));
      const { dragon, path, head_speed, passages, beats } = this.questions.body({}, { numbers, kind, drawing, extras });
      const rotation = Number(record.rotation ?? 0) * DEGREE;
      const body = { dragon, path: kind === "spiral" && rotation ? { ...path, rotation } : path, head_speed, ...(passages && { passages }), ...(beats && { beats }) };
      const common = { width: numbers.width, overhang: numbers.overhang, ...this.#stray() };
      return { kind, numbers: { ...numbers, ...common }, top, body, delay: Number(record.delay ?? 0), name: this.#nameOf(records, k), nameIn: (lang) => this.#nameOf(records, k, lang), colour: this.#colourOf(record, k) };
    });
  }

  #stray() {
    return numbersOf(this.state.texts(CONTACT));
  }

  /** The FILE of the performance. */
  #file(parts = this.#parts()) {
    const { clock, beginClock } = this.state.extras();
    const drawing = this.state.get("drawing");
    const venue = venueOf(drawing);
    const limits = { ...this.#stray(), ...(venue && { venue }), ...(drawing.limit && { speed_limit: drawing.limit }), ...(clock && { start_clock: clock }), ...(beginClock && { begin_clock: beginClock }) };
    return { dances: parts.map(({ name, body, delay }) => ({ name, ...body, ...(delay && { delay }) })), ...limits };
  }

  /** The FILE to keep: also what the questions about the performance do not need, and only names that a person has given. */
  #kept() {
    const [records, venue, { dances, ...others }] = [this.#records, keptVenueOf(this.state.get("drawing")), this.#file()];
    const own = dances.map(({ name, ...dance }, k) => ({ ...(records[k].name && { name }), ...dance, ...(records[k].colour && { colour: records[k].colour }) }));
    return { dances: own, ...others, ...(venue && { venue }), ...wishesIn(this.state) };
  }

  /** What tells one performance from another, in every language. */
  get #text() {
    return this.state.get("dances") && JSON.stringify(this.#kept());
  }

  #save() {
    download(new Blob([JSON.stringify(this.#kept(), null, 2)], { type: "application/json" }), "dances.json");
    announceSaved("dances.json", this.state.get("drawing"));
  }

  /** Draw each dragon in the colour that it has now: a person, the theme or paper has changed it. */
  recolour() {
    const { dance } = this.questions;
    const records = this.#records;
    if (dance?.parts?.length !== records.length) return;
    dance.parts.forEach((part, k) => (part.colour = this.#colourOf(records[k], k)));
    this.picture.setWays(this.#ways.slice(0, records.length).map((way, k) => ({ ...way, colour: dance.parts[k].colour })));
    for (const field of this.list.querySelectorAll("input[type=color]")) field.value = dance.parts[field.closest("li").dataset.dragon].colour;
    this.player.update(false);
    this.draw();
  }

  /** Ask about the dragons as they are now. */
  refresh() {
    const parts = this.#parts();
    this.#noted();
    this.recolour();
    const active = this.#active;
    const own = parts[active];
    const course = own.kind === "route" ? { ...own.body, ...this.#stray() } : null;
    if (!course) this.picture.setPath(null);
    const file = this.#file(parts);
    this.questions.askTogether({ body: file, file, active, parts, course, drawing: this.state.get("drawing"), numbers: { ...own.numbers, top_speed: own.top }, extras: this.state.extras() });
  }

  /** After an answer: the tracks and the paths of all dragons, and the verdict. */
  async showDance() {
    const { dance } = this.questions;
    this.judged();
    if (dance.track || dance.isLoading) return;
    dance.isLoading = true;
    pending(this.#loads, true);
    const ready = () => dance === this.questions.dance && this.player.update(false);
    try {
      const tracks = await Promise.all(dance.parts.map((_, k) => trackOf(this.service, dance, k, ready)));
      if (dance !== this.questions.dance) return;
      dance.track = new Tracks(tracks, dance.active);
      this.player.update(false);
      const ways = await Promise.all(dance.parts.map((_, k) => wayOf(this.service, dance, k)));
      if (dance !== this.questions.dance) return;
      this.#ways = ways;
      this.recolour();
    } catch (error) {
      // A newer question has taken its place; a refusal of the question itself is shown already.
      if (!(error instanceof Superseded || error instanceof Problem)) throw error;
    } finally {
      pending(this.#loads, false);
    }
  }

  /** The verdict on all of them. */
  judged() {
    const { dance, refusals } = this.questions;
    const refusal = refusals.get("contact");
    if (refusal) {
      const [, k] = /\/dances\/(\d+)\//.exec(refusal.errors[0]?.pointer ?? "") ?? [];
      const name = k === undefined ? "" : `${this.#nameOf(this.#records, Number(k))}${say(": ")}`;
      return this.judgement.refuse({ ...refusal.problem, sentence: name + refusal.problem.sentence });
    }
    if (dance?.kind !== "dances") return;
    this.judgement.show({ ...dance, known: [dance.answer.certificate.method] });
    $("#stage").setAttribute("aria-busy", "false");
  }
}
