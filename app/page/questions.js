/** The page's questions to the service: first contact, pose and minimum pitch at once, the others when input pauses. */

import { Problem, Superseded } from "./api.js";
import { numbersOfListed } from "./read_table.js";
import { pathOf, placeOf, venueOf } from "./drawing.js";
import { CONTACT, DRAGON, FIELDS, TURN, numbersOf } from "./fields.js";
import { clockAtZero, timeAfter } from "./passages.js";
import { Pause } from "./pending.js";
import { EXTRAS } from "./state.js";
import { language } from "./text.js";
import { Track, speedTimes } from "./track.js";

/** Time without a change after which input counts as paused [ms]. */
const REST = 250;
const CLEARANCE_SAMPLES = 400;
/** Fewest benches of which two share no handle. */
const PAIRED = 3;
/** Samples of the curve of strays: few, because it is nearly straight. */
const CURVE = { samples: 13 };
/** Request for the first view of the pitch chart, many times faster than with the jumps between samples. */
const LOOK = { samples: 41, locate: false };
const nameOf = ({ name, pointer = "" }) => name ?? (/^\/(passages|beats)/.test(pointer) ? "passages" : pointer.split("/").at(-1));
/** Time before a fold, or before the end of a path, of the last shown instant [s], because the chain ends there. */
const BEFORE_END = 1e-6;
/** Distance between samples of the path [m], and the largest number of samples. */
const [PATH_STEP, PATH_SAMPLES] = [0.3, 6_000];
/** Travel of the head before and after the beginning of a turn, whose coils have no end [m]. */
const TURN_TRAVEL = 100;

const MOTION = [...DRAGON, "pitch", "start_turns", "head_speed"];
const CIRCLE = [...DRAGON, "turning_diameter", "start_turns"];
const HEAD = [...DRAGON, "pitch", "start_turns", ...TURN, "speed_limit"];
/** While a slider is dragged, the engines judge only the touching pair. */
const QUICK = { cross_check: "pair" };
/** While a path is being drawn, the only question is whether it can be danced. */
const VERDICT = { cross_check: "none", details: false };
/** Channels of the questions at rest about a drawn dance. */
const AT_REST = ["speeds", "clearance", "fastest", "tolerance"];
/** Questions whose refusals concern an entered number; other refusals only affect what can be shown. The last one wins. */
const ABOUT_NUMBERS = ["time", "quickest", "head", "shortest", "minimum", "contact"];
/** Those of them that are asked about each kind of path. */
const CHANNELS_OF = { spiral: ["minimum", "contact"], turn: ABOUT_NUMBERS, route: ["contact"] };

/** The last shown instant: first contact, or the time until which nothing touches. */
const lastInstant = ({ time, time_bracket, end }) => time ?? (end ? end.time - BEFORE_END : time_bracket[0]);

const picked = (from, names) => Object.fromEntries(names.map((name) => [name, from[name]]));

/** True if its numbers describe a dance completely, so that a query can ask about it on a spiral. */
export const fitsQuery = ({ extras: { csv, passages } }) => !csv && !passages.length;

export class Questions {
  /** {kind, query, numbers, extras, answer, begin, end, clock: time of day at time 0 or null, report: of /check if it answered, track, isExplored: whether all else is asked; drawn: drawing, failures, verdict} */
  dance = null;
  /** The drawn path from the service: {s, x, y, knots, bends, drawing} */
  course = null;
  /** kind -> {answer, request: the numbers as texts, query or body, dance}: the newest, to be shown again in another language */
  answers = {};
  /** channel -> Problem */
  refusals = new Map();
  #rest = new Pause("questions");
  /** True while a hand drags what is asked about: only the quick verdict follows it. */
  isHeld = () => false;
  #latest = new Map();
  /** Charts near the view; the slow questions of other charts are not asked. */
  #near = new Set();
  /** The slow questions, and the first view of the staircase: in progress or answered. */
  #turn = null;
  #looked = null;
  /** What the newest question about several dances keeps. @type {any} */
  #kept = null;
  /** True if the engines judge the whole dragon at the minimum pitch: at first, and when input pauses. */
  #whole = true;

  /**
   * tell(kind, detail): called for a new answer of this kind, and for a new or solved refusal
   * @param {Service} service
   * @param {State} state
   */
  constructor(service, state, tell) {
    this.service = service;
    this.state = state;
    this.tell = tell;
  }

  /** Ask everything that depends on the numbers of the state. */
  refresh() {
    this.#rest.begin(REST, () => this.#atRest());
    const kind = this.state.get("path");
    // An answer about the former path would take the place of this one.
    this.service.drop([kind === "route" ? "path" : "course"]);
    this.#forget(ABOUT_NUMBERS.filter((channel) => !CHANNELS_OF[kind].includes(channel)));
    if (kind === "route") return this.#refreshDrawn();
    this.#latest.delete("course");
    const query = this.state.texts([...MOTION, ...CONTACT, ...(kind === "turn" ? TURN : [])]);
    const request = this.#danceOf(kind, query);
    if (this.#isNew("contact", { kind, ...query, ...request.extras })) this.#askContact(request);
    if (this.#isFollowed) return;
    const circle = this.#over([...CIRCLE, ...CONTACT]);
    if (!this.#isNew("minimum", circle)) return;
    this.#whole = !this.answers.minimum;
    this.#keep("minimum", "minimum-pitch", this.#whole ? circle : this.#over([...CIRCLE, ...CONTACT], QUICK));
  }

  /** Drop these questions with their refusals, which would be about another path. */
  #forget(channels) {
    this.service.drop(channels);
    for (const channel of channels) this.#latest.delete(channel);
    if (channels.filter((channel) => this.refusals.delete(channel)).length) this.tell("refused");
  }

  /** Numbers in questions about a dance of this kind; with a table of benches those of the table. */
  #danceOf(kind, query) {
    const extras = this.state.extras();
    const numbers = numbersOf(query);
    numbers.top_speed = Math.max(numbers.head_speed, ...extras.passages.map(({ speed }) => Number(speed) || 0));
    const { listed } = extras;
    if (!listed) return { kind, query, numbers, extras };
    return { kind, query, numbers: { ...numbers, ...numbersOfListed(listed) }, extras };
  }

  /** A question over these numbers: a query, or a body with the table of benches. */
  #over(names, more = {}) {
    const texts = this.state.texts(names);
    const { csv, listed } = this.state.extras();
    if (!csv) return { request: texts, query: { ...texts, ...more } };
    const others = Object.entries(numbersOf(texts)).filter(([name]) => !DRAGON.includes(name));
    return { request: { ...texts, benches: listed.lengths.length }, body: { dragon: { csv }, ...Object.fromEntries(others), ...more } };
  }

  /**
   * Ask about several dances on one clock. body: of /check; course: body of the question about the chosen path, if it is drawn;
   * kept: what the dance keeps: drawing, numbers, extras, parts, file: of all of them
   */
  async askTogether({ body, course, ...kept }) {
    this.#rest.end();
    this.#forget(ABOUT_NUMBERS.filter((channel) => channel !== "contact"));
    this.service.drop([...AT_REST, "path", ...(course ? [] : ["course"])]);
    if (course && this.#isNew("course", course)) this.#askCourse(course, kept.drawing);
    this.#kept = kept;
    if (!this.#isNew("contact", body)) return this.#chosen();
    const report = await this.#answer("contact", "check", { body: { ...body, ...VERDICT } });
    if (!report) return;
    const { encounter, start: begin, stop, failures, verdict, sentences } = report;
    const answer = { ...encounter, end: encounter.time === null ? { reason: "path", time: stop } : null };
    // The chosen one may be another by now; other dances are asked about anew, and this answer is about its own.
    const own = JSON.stringify(this.#kept.file) === JSON.stringify(kept.file) ? this.#kept : kept;
    this.#take({ ...own, kind: "dances", answer, report, failures, verdict, sentences, begin, end: encounter.time ?? stop - BEFORE_END, clock: clockAtZero(kept.extras, begin), track: null });
    this.tell("dance");
  }

  /** The same dances with another one of them chosen need no new answer. */
  #chosen() {
    const { dance } = this;
    if (!dance?.parts || dance.active === this.#kept.active || JSON.stringify(dance.file) !== JSON.stringify(this.#kept.file)) return;
    Object.assign(dance, this.#kept);
    if (dance.track) dance.track.active = dance.active;
    this.tell("dance");
  }

  /** Ask everything for a drawn path. */
  #refreshDrawn() {
    const request = this.drawn();
    const { drawing } = request;
    // Without a drawing nothing stays visible, so the next one is asked about again, even if it is an earlier one.
    if (!drawing.path && drawing.points.length < 2) {
      this.#forget(["contact", "course", ...AT_REST]);
      this.#take(null);
      return this.#latest.clear();
    }
    const body = this.checkBody(request);
    const { start_clock: clock, begin_clock: begins, ...course } = body;
    const [isOtherCourse, isOther] = [this.#isNew("course", course), this.#isNew("contact", body)];
    // Questions about the former dance would delay the verdict on the new one.
    if (isOther) this.service.drop(AT_REST);
    if (isOther) for (const channel of AT_REST) this.#latest.delete(channel);
    const verdict = isOther ? this.#askContact(request) : true;
    if (!isOtherCourse) return;
    const ask = (isAnswered) => isAnswered && this.#askCourse({ ...course, breaches: true }, drawing);
    // While a hand drags, the verdict comes first: both at once would each take as long as one after the other.
    if (this.isHeld()) Promise.resolve(verdict).then(ask);
    else ask(true);
  }

  /** The dance that the present drawing describes. */
  drawn() {
    const request = this.#danceOf("route", this.state.texts([...DRAGON, "head_speed", ...CONTACT]));
    return { ...request, numbers: { ...request.numbers, drawn: true }, drawing: this.state.get("drawing") };
  }

  /** Body of a request about a dance; default: the shown dance. */
  body(more, { numbers, kind, drawing, extras: { csv, passages, beats = null, clock, beginClock } } = this.dance) {
    const dragon = csv ? { csv } : picked(numbers, DRAGON);
    // Where a dance on a proposed path starts at 0 s, that is its beginning for every question.
    const begins = beginClock && { [kind === "route" && drawing.path && drawing.start === 0 ? "start_clock" : "begin_clock"]: beginClock };
    const pace = { head_speed: numbers.head_speed, ...(beats ? { beats } : passages.length && { passages }), ...(clock && { start_clock: clock }), ...begins };
    if (kind === "route") return { dragon, path: pathOf(drawing), ...pace, ...more };
    const names = ["pitch", "start_turns", ...(kind === "turn" ? TURN : [])];
    return { dragon, path: { kind, ...picked(numbers, names) }, ...pace, ...more };
  }

  /** Body of a request about the dance shown, in the square that is drawn. */
  placed(more) {
    const venue = this.dance.kind === "route" && venueOf(this.dance.drawing);
    return this.body({ ...more, ...(venue && { venue }) });
  }

  /** Body of /check: a spiral is danced to its end. */
  checkBody(request) {
    return this.body({ ...picked(request.numbers, CONTACT), ...this.#stretch(request) }, request);
  }

  /** Body of a question about those who dance the dance shown: from its beginning as checked, on a spiral or a turn to its end. */
  danced(more = {}) {
    const { kind, begin, end } = this.dance;
    return { ...this.checkBody(this.dance), start: begin, ...(kind !== "route" && { stop: end }), ...more };
  }

  /** The time of the cues of the shown dance: to its end, or until benches touch, after which nobody is where a card says. */
  get cued() {
    const { parts, answer, begin, end } = this.dance;
    return { start: begin, ...((parts || answer.time !== null) && { stop: end }) };
  }

  /** The shown part of a turn, whose coils have no end; a spiral is shown to its end, a drawn path in its place. */
  #stretch(/** @type {any} */ { kind, numbers: { head_speed: speed }, extras, drawing = null }) {
    if (kind === "route") return placeOf(drawing);
    return kind === "turn" ? { start: -TURN_TRAVEL / speed, stop: timeAfter(TURN_TRAVEL, speed, extras.passages) } : {};
  }

  /** The service's own numbers at one instant. */
  async pose(time) {
    const { dance } = this;
    const table = await this.#answer("pose", "trajectory", { body: this.body({ times: [time] }) });
    if (!table || dance !== this.dance) return;
    this.tell("pose", { time, dance, x: table.x[0], y: table.y[0], speed: table.speed[0] });
  }

  /** Names of the numbers that a refusal concerns, which show it beside their fields; else none. */
  fieldsOf(channel) {
    if (!ABOUT_NUMBERS.includes(channel)) return [];
    return this.refusals.get(channel).errors.map(nameOf).filter((name) => EXTRAS.includes(name) || FIELDS.some((field) => field.name === name));
  }

  /** Errors in the numbers: name -> error. */
  errors() {
    return new Map(ABOUT_NUMBERS.flatMap((channel) => this.refusals.get(channel)?.errors ?? []).map((error) => [nameOf(error), error]));
  }

  /** Ask about the first contact; false if a newer question took the place of this one. */
  async #askContact(request) {
    if (request.kind === "spiral") {
      const question = fitsQuery(request) ? { query: { ...request.query, ...QUICK } } : { body: { ...this.checkBody(request), ...QUICK } };
      const answer = await this.#answer("contact", "collision-time", question);
      if (answer) this.#accept({ ...request, answer, begin: 0, end: lastInstant(answer) });
      return answer !== undefined;
    }
    const isRoute = request.kind === "route";
    const report = await this.#answer("contact", "check", { body: { ...this.checkBody(request), ...(isRoute ? VERDICT : QUICK) } });
    if (!report) return report !== undefined;
    const { failures, verdict, sentences, start: begin, stop, first_contact: first } = report;
    const answer = { ...first, end: isRoute && first.time === null ? { reason: "path", time: stop } : null };
    const last = isRoute ? stop - BEFORE_END : stop;
    this.#accept({ ...request, answer, begin, end: answer.time ?? last, ...(isRoute ? { failures, verdict, sentences } : { report }) });
    return true;
  }

  #accept(dance) {
    this.#take({ ...dance, clock: clockAtZero(dance.extras, dance.begin), track: null });
    this.tell("dance");
    if (dance.kind !== "route") this.#askPath();
    if (!this.#rest.lasts) this.#askDance();
  }

  /** Take a dance in place of the shown one; null: none. */
  #take(dance) {
    if (this.dance?.track) this.dance.track.stopped = true;
    this.dance = dance;
  }

  /** The path from behind the tail to the end, sampled as the way of a single bench's head. */
  async #askPath() {
    const { numbers, begin, end } = this.dance;
    // A length exceeds its chord by more than the chord falls short of its arc, so this reaches behind the tail.
    const start = begin - (numbers.head_length + numbers.benches * numbers.body_length) / numbers.head_speed;
    const step = Math.max(PATH_STEP / numbers.top_speed, (end - start) / PATH_SAMPLES);
    const body = this.body({ times: { start, stop: end, step }, decimals: 4 });
    body.dragon = { ...picked(numbers, DRAGON), benches: 1 };
    const table = await this.#answer("path", "trajectory", { body });
    if (table) this.tell("path", { x: table.x.map((row) => row[0]), y: table.y.map((row) => row[0]) });
  }

  async #askCourse(body, drawing) {
    const answer = await this.#answer("course", "course", { body });
    if (!answer) return;
    this.course = { ...answer, drawing };
    this.tell("path", answer);
  }

  /** True for a carrier, who needs only the dance itself. */
  get #isFollowed() {
    return this.state.get("bench") !== null;
  }

  #atRest() {
    if (this.isHeld()) return this.#rest.begin(REST, () => this.#atRest());
    this.#askDance();
    if (this.#isFollowed || this.state.get("path") === "route") return;
    if (!this.#whole) this.#keep("minimum", "minimum-pitch", this.#over([...CIRCLE, ...CONTACT]));
    this.#whole = true;
    const staircase = [...CIRCLE, "margin"];
    const look = this.#over(staircase, LOOK);
    if (this.#near.has("scan") && this.#isNew("look", look)) this.#looked = this.#keep("look", "pitch-scan", look);
    const slow = /** @type {any[]} */ ([["tolerance", "tolerance", this.toleranceOf()]]);
    if (this.state.get("path") === "turn") {
      slow.push(["head", "maximum-head-speed", this.#fastestHead()]);
      slow.push(["time", "turn-time", this.#turnTime()]);
      slow.push(["shortest", "shortest-turn", this.#over([...CIRCLE, ...CONTACT, "pitch", "ratio"])]);
      slow.push(["quickest", "quickest-turn", this.#over([...CIRCLE, "margin", "pitch", "ratio", "speed_limit"])]);
    }
    const charts = [["scan", "pitch-scan", this.#over(staircase)], ["curve", "tolerance-curve", this.#over(CIRCLE, CURVE)]];
    this.#askInTurn([...slow, ...charts.filter(([kind]) => this.#near.has(kind))]);
  }

  /** Ask from now on for this chart too: scan or curve. */
  near(kind) {
    this.#near.add(kind);
    if (!this.#rest.lasts) this.#atRest();
  }

  /** The request for the tolerance on the way to the circle, or in the shown part of a turn. */
  toleranceOf() {
    const kind = this.state.get("path");
    if (kind === "route") return { request: { benches: this.dance.numbers.benches }, body: this.placed({}) };
    const query = this.state.texts([...MOTION, "turning_diameter", ...(kind === "turn" ? TURN : [])]);
    const dance = this.#danceOf(kind, query);
    const { benches, turning_diameter } = dance.numbers;
    if (kind === "turn") return { request: { benches }, body: this.body(this.#stretch(dance), dance) };
    const request = { ...query, benches };
    return fitsQuery(dance) ? { request, query } : { request, body: this.body({ turning_diameter }, dance) };
  }

  /** The request for the highest speed of the head in a turn. */
  #fastestHead() {
    const query = this.state.texts([...HEAD, "head_speed"]);
    const dance = this.#danceOf("turn", query);
    const { head_speed, ...flat } = query;
    return fitsQuery(dance) ? { query: flat } : { body: this.body({ speed_limit: dance.numbers.speed_limit }, dance) };
  }

  /** The request for the time of the head through the shown turn. */
  #turnTime() {
    const query = this.state.texts(HEAD);
    const dance = this.#danceOf("turn", query);
    if (!dance.extras.csv) return { query };
    const { dragon, path } = this.body({}, dance);
    return { body: { dragon, path, speed_limit: dance.numbers.speed_limit } };
  }

  /** The requests for the smallest pitch, and for the radius at first contact against the pitch. */
  pitchOf(names) {
    return this.#over([...CIRCLE, ...names]);
  }

  /** Ask slow questions one after another, because the service takes few at once. slow: [kind, path, question] of each */
  #askInTurn(slow) {
    const changed = slow.filter(([kind, , question]) => this.#isNew(kind, question));
    for (const [kind] of changed) this.service.tell.busy(kind, true);
    this.#turn = this.#askEach(changed, this.#turn);
  }

  async #askEach(changed, before) {
    // A chart that comes near the view waits for questions in progress; new numbers do not.
    if (changed.every(([kind]) => this.#near.has(kind))) await before;
    for (const ask of changed) {
      if (ask[0] === "scan") await this.#looked; // A first view that came later would take the place of the whole staircase.
      if (!this.#isNew(ask[0], ask[2], false)) await this.#keep(...ask);
    }
  }

  /** Ask once for everything that belongs to the shown dance. */
  #askDance() {
    const { dance } = this;
    if (!dance || dance.parts) return; // Several dragons have their own questions.
    if (!dance.track) this.#startTrack(dance);
    if (dance.isExplored || this.#isFollowed) return;
    dance.isExplored = true;
    const { begin, end } = dance;
    this.#keep("speeds", "trajectory", { body: this.body({ times: speedTimes(dance), decimals: 6 }) }, dance);
    // Two benches share a handle, so that there is no gap to ask about.
    if (dance.numbers.benches < PAIRED) this.#accepted("clearance", { answer: null, dance });
    else this.#keep("clearance", "clearance", this.#clearanceOf(dance, begin, end, (end - begin) / CLEARANCE_SAMPLES || 1), dance);
    if (dance.report) this.#accepted("fastest", { answer: dance.report, dance });
    else this.#keep("fastest", "check", { body: this.checkBody(dance) }, dance);
    if (dance.kind === "route") this.#askInTurn([["tolerance", "tolerance", this.toleranceOf()]]);
  }

  /** The request for a clearance: a query on a spiral, where more benches are allowed; a body on other paths. */
  #clearanceOf(dance, start, stop, step) {
    if (dance.kind !== "spiral" || !fitsQuery(dance)) return { body: this.body({ times: { start, stop, step } }) };
    return { query: { ...picked(dance.query, MOTION), start, stop, step } };
  }

  #startTrack(dance) {
    const ask = (chunk, times, decimals) => this.service.ask(`track ${chunk}`, "trajectory", { body: this.body({ times, decimals }) });
    const ready = () => dance === this.dance && this.tell("track");
    dance.track = new Track(ask, [dance.begin, dance.end], dance.numbers.benches + 1, dance.numbers.top_speed, ready);
    this.tell("track");
  }

  async #keep(kind, path, question, dance = null) {
    const answer = await this.#answer(kind, path, question);
    if (answer && (!dance || dance === this.dance)) this.#accepted(kind, { answer, ...question, dance });
  }

  #accepted(kind, kept) {
    this.answers[kind] = kept;
    this.refusals.delete(kind);
    this.tell(kind);
  }

  /** True if a question, or its language, differs from the last one of its kind. mark: it becomes the last one */
  #isNew(kind, question, mark = true) {
    const key = JSON.stringify([language(), question]);
    if (this.#latest.get(kind) === key) return false;
    if (mark) this.#latest.set(kind, key);
    return true;
  }

  /** The answer; null if it was refused, undefined if superseded. question: with `request`, which is of the page alone */
  async #answer(channel, path, /** @type {any} */ { request, ...question }) {
    try {
      const answer = await this.service.ask(channel, path, question);
      if (this.refusals.delete(channel)) this.tell("refused");
      return answer;
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      this.refusals.set(channel, error);
      this.tell("refused");
      return null;
    }
  }
}
