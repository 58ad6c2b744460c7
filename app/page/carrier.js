/** The view of one carrier: the bench of the address, of several dragons that of the chosen one, in large type, its next cue counted down. Once loaded it needs no network, and where the browser can keep it, it opens without one. */

import { Problem, Superseded } from "./api.js";
import { $, $$, button, hide, make, numberIn, textButton } from "./elements.js";
import { canKeep, forget, isKept, keep } from "./kept.js";
import { secondsBetween, timeOfDay } from "./passages.js";
import { benchTitle, language, languages, learn, phrase, say, sentencesOf } from "./text.js";

/** Time between two pictures, in motion and with reduced motion [ms]. */
const [FRAME, STEP] = [50, 500];
/** Part of the ground across the picture [m]. */
const ACROSS = 14;
/** A cue is the present one for this long [s]; correction of the clock by a button [s]. */
const [PRESENT, CORRECTION] = [6, 5];
/** Kinds of cues that hold until the next one of them. */
const LASTING = ["begin", "turn", "done"];
/** Largest dance whose picture is held: samples times handles. */
const HELD_MOST = 2_000_000;
/** Where the browser keeps when a dance began, so that a page that was loaded again goes on. */
const STORED = "bench-dragon-began";

const digits = (number) => String(number).padStart(2, "0");
/** A duration such as 0:07 or 1:02:03, to the whole second above. seconds: at least 0 */
function minutesAndSeconds(seconds) {
  const whole = Math.ceil(seconds);
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours ? `${hours}:${digits(minutes)}:${digits(whole % 60)}` : `${minutes}:${digits(whole % 60)}`;
}

/** A time of the dance [s] as on the card and in the film: 1:23.1 */
function cardTime(time) {
  const tenths = Math.round(Math.abs(time) * 10);
  return `${time < 0 && tenths ? "-" : ""}${Math.floor(tenths / 600)}:${digits(Math.floor((tenths % 600) / 10))}.${tenths % 10}`;
}

/** The time of day now, with the seconds. */
const clockNow = (date = new Date()) => [date.getHours(), date.getMinutes(), date.getSeconds()].map(digits).join(":");

export class Carrier {
  /** Card by language, and what it belongs to. */
  #cards = {};
  #of = null;
  #problem = null;
  /** When the dance is at time 0 [ms since 1970]; null: it has not begun. */
  #began = null;
  #track = null;
  #frame = 0;
  #drawn = 0;
  /** The dance in the picture. */
  #drawnDance = null;
  #lock = null;
  #network = true;
  /** What is kept on this device: the card and the dance, and whether a person wants that. */
  #kept = false;
  #keeping = null;
  #isWanted = true;
  /** Where the carrier stands before the dance. */
  #standing = "";

  /**
   * show(pose): draws it; choose(k): chooses dragon k of several
   * @param {{ state: State, service: Service, questions: Questions, dance: any, show: any, choose: any }} parts
   */
  constructor({ state, service, questions, dance, show, choose }) {
    this.state = state;
    this.service = service;
    this.questions = questions;
    this.dance = dance;
    this.draw = show;
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    this.title = make("h1", { id: "carrier-title" });
    this.number = make("input", { id: "card-bench", inputMode: "numeric", autocomplete: "off", "data-label": "Bench", onchange: ({ target }) => this.#choose(target) });
    this.dragon = make("select", { id: "card-dragon", "data-label": "Dragon", onchange: ({ target }) => choose(Number(target.value)) });
    this.other = button({}, () => state.set({ lang: this.#next.dataset.lang }));
    const close = button({ "data-label": "Close", textContent: "✕" }, () => state.push({ bench: null, view: null }));
    this.clock = make("p", { className: "clock" });
    this.when = make("p", { className: "when" });
    this.stand = make("p", { className: "stand" });
    this.beside = make("p", { className: "beside" });
    this.note = make("p", { className: "hint" });
    this.remove = textButton("Remove from this device", () => this.#forget(), { id: "card-remove" });
    this.cue = make("p", { className: "cue", "aria-live": "polite" });
    this.start = textButton("Start", () => this.#begin(this.#span.begin), { className: "main", id: "card-start" });
    this.byClock = textButton("By the clock", () => this.#goByClock(), { id: "card-clock" });
    this.again = textButton("Start again", () => this.#begin(this.#span.begin));
    const correct = (key, seconds) => textButton(key, () => this.#begin(this.#now + seconds), { "data-correct": seconds });
    this.corrections = [correct(phrase("We are 5 s behind"), -CORRECTION), correct(phrase("We are 5 s ahead"), CORRECTION)];
    this.list = make("ol", { "aria-labelledby": "card-cues" });
    const heading = make("h2", { id: "card-cues", "data-text": "All cues" });
    const row = (...parts) => make("p", { className: "row" }, ...parts);
    this.present = make("div", {}, this.when, this.cue);
    this.box = make("section", { id: "carrier", "aria-labelledby": "carrier-title" }, row(this.title, this.dragon, make("label", {}, make("span", { "data-text": "Bench" }), this.number), this.other, close), this.clock, this.present, row(this.start));
    this.more = make("section", { id: "card-more", "aria-labelledby": "card-cues" }, this.stand, this.beside, heading, this.list, row(...this.corrections, this.again, this.byClock), this.note, row(this.remove));
    $("#front").prepend(this.box);
    $("#dance").after(this.more);
    dance.above.push((pen, colours) => this.#mark(pen, colours));
    document.addEventListener("visibilitychange", () => this.#keepAwake());
  }

  get #bench() {
    return this.state.get("bench");
  }

  get #card() {
    return this.#cards[language()] ?? Object.values(this.#cards)[0] ?? null;
  }

  /** The button of the language that comes after this one. */
  get #next() {
    const all = $$("[data-lang]");
    return all[(languages().indexOf(language()) + 1) % all.length];
  }

  get #span() {
    return this.questions.dance ?? { begin: 0, end: 0 };
  }

  /** Time of the dance now, also before its beginning and after its end [s]. */
  get #now() {
    return this.#began === null ? this.#span.begin : (Date.now() - this.#began) / 1000;
  }

  /** After a change of the bench, the dance or the language. */
  show() {
    const isOpen = this.#bench !== null;
    const wasOpen = "carrier" in document.documentElement.dataset;
    this.box.hidden = this.more.hidden = !isOpen;
    if (isOpen) document.documentElement.dataset.carrier = "";
    else delete document.documentElement.dataset.carrier;
    cancelAnimationFrame(this.#frame);
    if (!isOpen) return this.#keepAwake();
    if (!wasOpen) this.#look();
    this.number.value = this.#bench;
    const { textContent, lang } = this.#next;
    Object.assign(this.other, { textContent, lang });
    this.#ask();
    this.hold();
    this.#showCard();
    this.#keepAwake();
    this.#tick(performance.now());
  }

  /** Whether the service can be reached. */
  network(is) {
    this.#network = is;
    this.#showNote();
  }

  /** Hold all samples of the dance, so that its picture needs no network. */
  async hold() {
    const { dance } = this.questions;
    const track = dance?.track;
    if (this.#bench === null || !track || track === this.#track) return;
    this.#track = track;
    if (track.cells <= HELD_MOST) await track.hold();
    this.#showNote();
  }

  /** The part of the ground around the bench. */
  #look() {
    const { view } = this.dance;
    view.measure();
    view.set(view.x, view.y, Math.min(view.width, view.height) / ACROSS);
  }

  #choose(field) {
    const bench = numberIn(field.value);
    if (Number.isInteger(bench) && bench >= 0) this.state.set({ bench });
    else field.value = this.#bench;
  }

  /** Keep the card and the dance on this device, once for each of them. */
  async #keepHere() {
    const of = this.#of;
    if (!this.#isWanted || this.#keeping === of || !canKeep()) return;
    this.#keeping = of;
    this.#kept = false;
    const kept = (await isKept(this.service.asked)) || (this.#network && (await keep(this.service.asked)));
    if (of !== this.#of) return;
    this.#kept = kept;
    if (kept) navigator.storage?.persist?.();
    else if (!this.#network) this.#keeping = null;
    this.#showNote();
  }

  async #forget() {
    [this.#isWanted, this.#kept] = [false, false];
    this.#keep(null);
    await forget();
    this.#showNote();
  }

  /** Ask for the card of this bench in all languages, because a network may be gone when another one is wanted. */
  async #ask() {
    const { dance } = this.questions;
    const of = { dance, bench: this.#bench, dragon: dance?.active };
    if (!dance || Object.entries(of).every(([name, value]) => this.#of?.[name] === value)) return;
    [this.#of, this.#cards, this.#problem] = [of, {}, null];
    this.#resume();
    const { benches } = dance.numbers;
    if (of.bench >= benches) return;
    const own = { ...this.questions.cued, cards: [of.bench] };
    try {
      for (const one of new Set([language(), ...languages()])) {
        await learn(this.service, one, "more");
        const { cards } = await this.service.ask(`cues ${one}`, "cues", { body: { ...this.#body(one), ...own, language: one } });
        if (of !== this.#of) return;
        this.#cards[one] = cards[0];
        this.#showCard();
      }
    } catch (error) {
      if (error instanceof Superseded || of !== this.#of) return;
      if (!(error instanceof Problem)) throw error;
      this.#problem = error.problem;
      this.#showCard();
    }
  }

  /** Body of a question about the dance, or about all dragons with their names in a language. */
  #body(lang) {
    const { dance } = this.questions;
    if (!dance.parts) return this.questions.danced();
    return { ...dance.file, dances: dance.file.dances.map((one, k) => ({ ...one, name: dance.parts[k].nameIn(lang) })), part: dance.active };
  }

  /** Go on as before the page was loaded again, or by the clock of the dance. */
  #resume() {
    const { begin, end, clock } = this.#span;
    this.#began = null;
    try {
      const { of, began } = JSON.parse(localStorage.getItem(STORED));
      const now = (Date.now() - began) / 1000;
      if (of === this.#key() && begin <= now && now < end) this.#began = began;
    } catch {
      // Nothing is stored, or the browser allows no storage.
    }
    if (this.#began === null && clock) this.#goByClock();
  }

  #key() {
    return JSON.stringify(this.#body("en"));
  }

  #goByClock() {
    const date = new Date();
    this.#began = Date.now() - 1000 * secondsBetween(this.#span.clock, clockNow(date)) - date.getMilliseconds();
    this.#keep(null);
  }

  /** The dance is at this time now [s]. */
  #begin(time) {
    this.#began = Date.now() - 1000 * time;
    this.#keep(this.#began);
    this.#keepAwake();
    this.#showTime();
  }

  #keep(began) {
    try {
      if (began === null) localStorage.removeItem(STORED);
      else localStorage.setItem(STORED, JSON.stringify({ of: this.#key(), began }));
    } catch {
      // Without storage a page that is loaded again begins anew.
    }
  }

  /** Keep the screen on while this view is seen; a browser ends that when the page is hidden. */
  async #keepAwake() {
    if (this.#bench === null || document.hidden) {
      this.#lock?.release();
      this.#lock = null;
    } else if (!this.#lock || this.#lock.released) {
      this.#lock = (await navigator.wakeLock?.request("screen").catch(() => null)) ?? null;
    }
    this.#showNote();
  }

  #tick(now) {
    this.#frame = requestAnimationFrame((next) => this.#tick(next));
    if (now - this.#drawn < (this.still.matches ? STEP : FRAME)) return;
    this.#drawn = now;
    this.hold();
    this.#showTime();
  }

  /** Time of a cue as on the card: of day, or of the dance. */
  #timeOf(time) {
    const { clock } = this.#span;
    return clock ? timeOfDay(time, clock) : cardTime(time);
  }

  /** What stands on the card. */
  #showCard() {
    const { dance } = this.questions;
    const card = this.#card;
    const benches = dance?.numbers.benches ?? Infinity;
    const bench = this.#bench < benches ? benchTitle(this.#bench, benches) : `${say("Bench")} ${this.#bench}`;
    const dragons = dance?.parts?.map(({ nameIn }) => nameIn(language())) ?? [];
    this.dragon.replaceChildren(...dragons.map((textContent, value) => make("option", { value, textContent, selected: value === dance.active })));
    this.dragon.hidden = !dragons.length;
    this.title.textContent = dragons.length ? say("{dragon}: {bench}", { bench, dragon: dragons[dance.active] }) : bench;
    document.title = `${this.title.textContent} · ${say("Bench Dragon")}`;
    this.beside.textContent = card?.beside ?? "";
    this.#standing = card?.place ?? "";
    this.list.replaceChildren(...(card?.cues ?? []).map((cue) => make("li", {}, make("span", { textContent: this.#timeOf(cue.time) }), make("span", { textContent: cue.words }))));
    this.byClock.hidden = !dance?.clock;
    this.#showTime();
    this.#showNote();
  }

  #showNote() {
    const isWhole = this.#track?.isWhole;
    const cards = Object.keys(this.#cards).length === languages().length;
    const isLarge = this.#track?.cells > HELD_MOST;
    if (cards && isWhole) this.#keepHere();
    hide(this.remove, !this.#kept);
    this.box.dataset.kept = String(this.#kept);
    const stays = this.#network ? phrase("All is here and stays on this device: it opens again without the network, also tomorrow.") : phrase("No network: the card goes on, and opens again from this device.");
    const held = cards && isWhole ? phrase("All is here: it goes on without the network while this page stays open. Do not reload it then.") : cards && isLarge ? phrase("The cues are here while this page stays open. The dance is too large to hold its picture, which needs the network.") : phrase("Loading: stay within reach of the network.");
    const distances = this.#card?.cues.some(({ nearest }) => nearest) ? [phrase("Distances are from edge to edge at the time named; just before and after it a bench beside you may be nearer.")] : [];
    const { answer = null } = this.questions.dance ?? {};
    const until = answer && answer.time !== null ? [phrase("Benches touch in this dance: the cues end there.")] : [];
    const words = [...until, ...distances, this.#kept ? stays : this.#network ? held : phrase("No network: the card goes on while this page stays open. Do not reload it."), this.#lock ? phrase("The screen stays on.") : phrase("Set your device so that its screen stays on.")];
    this.note.textContent = sentencesOf(words.map((one) => say(one)));
    this.box.dataset.held = String(Boolean(cards && isWhole));
    this.box.dataset.awake = String(Boolean(this.#lock));
  }

  /** The picture and the countdown of this moment. */
  #showTime() {
    const { dance, refusals } = this.questions;
    if (this.#bench === null) return;
    const put = (element, text) => element.textContent === text || (element.textContent = text);
    const refusal = refusals.get("contact")?.problem ?? this.#problem;
    if (!dance) return put(this.cue, refusal?.sentence ?? "");
    const { begin, end, numbers: { benches } } = dance;
    const time = this.#now;
    const pose = dance.track?.at(Math.min(Math.max(time, begin), end));
    // At rest nothing is drawn anew.
    if (pose && (this.dance.scene.pose?.time !== pose.time || this.#drawnDance !== dance)) {
      this.#drawnDance = dance;
      this.draw(pose);
      $("#stage").setAttribute("aria-busy", "false");
    }
    const isGoing = this.#began !== null;
    put(this.clock, dance.clock ? clockNow() : isGoing ? cardTime(Math.floor(Math.max(time, begin))).slice(0, -2) : "");
    hide(this.start, isGoing);
    for (const one of [...this.corrections, this.again]) hide(one, !isGoing);
    const cues = this.#card?.cues ?? [];
    // The card has them by the time at which benches are nearest; who waits for one hears of it when it begins.
    // Who begins in a turn hears first how to begin.
    const begun = cues.toSorted((a, b) => a.since - b.since || Number(a.kind === "begin") - Number(b.kind === "begin"));
    const next = begun.find(({ since }) => since > time || !isGoing);
    // A turn goes on while the next cue is counted down.
    const lasts = ({ kind, since, until }) => (kind === "turn" ? since : until);
    const present = isGoing && begun.findLast((one) => one.since <= time && time < Math.max(lasts(one), one.since + PRESENT));
    const isOver = isGoing && time >= end && !present;
    const [cue, at] = present ? [present, lasts(present)] : [next, next?.since];
    this.present.classList.toggle("present", Boolean(present));
    // What goes on takes the place of where one stands, once that is over; a cue that is large above is not said twice.
    const doing = cues.findLast(({ kind, since }) => LASTING.includes(kind) && since <= time);
    put(this.stand, !isGoing || time <= begin ? this.#standing : doing && doing !== present ? say("Now: {words}", { words: doing.words }) : "");
    const left = minutesAndSeconds(Math.max(at - time, 0));
    const lacks = this.#bench >= benches ? say("This dragon has no bench {bench}: its tail is bench {last}.", { bench: this.#bench, last: benches - 1 }) : refusal?.sentence ?? "";
    put(this.when, lacks || isOver || !cue || !isGoing ? "" : !present ? say("in {time}", { time: left }) : at > time ? say("still {time}", { time: left }) : say("Now"));
    const words = isOver ? say(dance.answer.time === null ? "The dance is over." : "Stop: benches touch here, and the cues end.") : isGoing ? (cue?.words ?? "") : sentencesOf([say("Press Start when the dance begins."), cue && `${say("Next")}${say(": ")}${cue.words}`]);
    put(this.cue, lacks || words);
    [...this.list.children].forEach((row, k) => (row.className = cues[k] === cue ? "following" : isGoing && cues[k].until <= time ? "past" : ""));
  }

  /** Mark the bench in the picture, and the one that it meets next. */
  #mark(pen, colours) {
    const { scene } = this.dance;
    if (this.#bench === null || !scene.pose || this.#bench > scene.pose.x.length - 2) return;
    const met = this.#card?.cues.find(({ nearest, until }) => nearest && until > this.#now)?.nearest;
    for (const [k, colour, of] of [[met?.bench, colours.second, scene.parts?.[met?.dragon] ?? scene], [this.#bench, colours.pick, scene]]) {
      if (k === undefined) continue;
      const { x, y } = of.pose;
      const outline = this.dance.bench(k, new Path2D(), of);
      pen.fill(outline, colour);
      pen.stroke(outline, colours.text, 2);
      pen.label(String(k), (x[k] + x[k + 1]) / 2, (y[k] + y[k + 1]) / 2, colour, colours.card);
    }
  }
}
