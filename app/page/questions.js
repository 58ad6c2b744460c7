/** What the page asks the service, and when: first contact, pose and minimum pitch at once, the rest when the hand rests. */

import { Problem, Superseded } from "./api.js";
import { DRAGON } from "./state.js";
import { Track } from "./track.js";

/** A hand rests when nothing changed for so long [ms]. */
const REST = 250;
const CLEARANCE_SAMPLES = 400;
/** The end of a run is a fold, where the chain is about to break: shown is the instant this long before [s]. */
const BEFORE_END = 1e-6;
/** The path is sampled every so many metres, or in so many samples when it is long. */
const [PATH_STEP, PATH_SAMPLES] = [0.3, 6_000];
/** Of a turn, which has coils without end, so much of the head's way before and after its beginning is danced [m]. */
const TURN_TRAVEL = 100;

const MOTION = [...DRAGON, "pitch", "start_turns", "head_speed"];
const CIRCLE = [...DRAGON, "turning_diameter", "start_turns", "margin"];
/** While a hand drags, the engines judge the touching pair alone. */
const QUICK = { cross_check: "pair" };
/** Their refusals are about a number that a person wrote; others only say what cannot be shown of it. The last wins. */
const ABOUT_NUMBERS = ["minimum", "contact"];

/** The last instant that is shown: first contact, or as far as nothing touches. */
function lastInstant({ time, time_bracket, end }) {
  return time ?? (end ? end.time - BEFORE_END : time_bracket[0]);
}

export class Questions {
  /** {kind, query, numbers, answer, begin, end, report: of /check where that answered, track} */
  dance = null;
  /** kind -> {answer, query, dance}: the newest, to be shown again in another language */
  answers = {};
  /** channel -> Problem */
  refusals = new Map();
  #rest = 0;
  #asked = new Map();
  /** Do the engines judge the whole dragon at the newest minimum pitch? At first, and when the hand rests. */
  #whole = true;

  /** tell(kind, detail): an answer of this kind came, or a refusal came or went */
  constructor(service, state, tell) {
    Object.assign(this, { service, state, tell });
  }

  /** Everything that depends on the numbers of the state. */
  refresh() {
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => this.#atRest(), REST);
    const kind = this.state.get("path");
    const query = this.state.texts([...MOTION, "margin", ...(kind === "turn" ? ["turning_diameter"] : [])]);
    const numbers = Object.fromEntries(Object.entries(query).map(([name, text]) => [name, Number(text)]));
    if (this.#isNew("contact", { kind, ...query })) this.#askContact({ kind, query, numbers });
    const circle = this.state.texts(CIRCLE);
    if (!this.#isNew("minimum", circle)) return;
    this.#whole = !this.answers.minimum;
    this.#keep("minimum", "minimum-pitch", { query: this.#whole ? circle : { ...circle, ...QUICK } });
  }

  /** Body of a request about the dance that is shown, or about another one. */
  body(more, { numbers, kind } = this.dance) {
    const dragon = Object.fromEntries(DRAGON.map((name) => [name, numbers[name]]));
    const path = { kind, pitch: numbers.pitch, start_turns: numbers.start_turns };
    if (kind === "turn") path.turning_diameter = numbers.turning_diameter;
    return { dragon, path, head_speed: numbers.head_speed, ...more };
  }

  /** Body of /check: a spiral is danced to its end. */
  checkBody(asked) {
    const { margin, head_speed } = asked.numbers;
    const time = TURN_TRAVEL / head_speed;
    return this.body({ margin, ...(asked.kind === "turn" && { start: -time, stop: time }) }, asked);
  }

  /** The service's own numbers at one instant. */
  async pose(time) {
    const { dance } = this;
    const table = await this.#answer("pose", "trajectory", { body: this.body({ times: [time] }) });
    if (!table || dance !== this.dance) return;
    this.tell("pose", { time, dance, x: table.x[0], y: table.y[0], speed: table.speed[0] });
  }

  /** What is wrong with the numbers: name -> the service's words. */
  errors() {
    const all = ABOUT_NUMBERS.flatMap((channel) => this.refusals.get(channel)?.errors ?? []);
    return new Map(all.map(({ name, pointer, detail }) => [(name ?? pointer).split("/").at(-1), detail]));
  }

  async #askContact(asked) {
    if (asked.kind === "spiral") {
      const answer = await this.#answer("contact", "collision-time", { query: { ...asked.query, ...QUICK } });
      if (answer) this.#accept({ ...asked, answer, begin: 0, end: lastInstant(answer) });
    } else {
      const report = await this.#answer("contact", "check", { body: { ...this.checkBody(asked), ...QUICK } });
      if (!report) return;
      const answer = { ...report.first_contact, end: null };
      this.#accept({ ...asked, answer, begin: report.start, end: answer.time ?? report.stop, report });
    }
  }

  #accept(dance) {
    if (this.dance?.track) this.dance.track.stopped = true;
    this.dance = { ...dance, track: null };
    this.tell("dance");
    this.#askPath();
    if (!this.#rest) this.#askDance();
  }

  /** The head's way from behind the tail to the end: one bench dances it alone. */
  async #askPath() {
    const { numbers, begin, end } = this.dance;
    // Lengths exceed chords by more than chords fall short of the arc, so this reaches behind the tail.
    const start = begin - (numbers.head_length + numbers.benches * numbers.body_length) / numbers.head_speed;
    const step = Math.max(PATH_STEP / numbers.head_speed, (end - start) / PATH_SAMPLES);
    const body = this.body({ times: { start, stop: end, step }, decimals: 4 });
    body.dragon.benches = 1;
    const table = await this.#answer("path", "trajectory", { body });
    if (table) this.tell("path", { x: table.x.map((row) => row[0]), y: table.y.map((row) => row[0]) });
  }

  #atRest() {
    this.#rest = 0;
    this.#askDance();
    if (!this.#whole) {
      this.#whole = true;
      this.#keep("minimum", "minimum-pitch", { query: this.state.texts(CIRCLE) });
    }
    this.#askOnce("scan", "pitch-scan", CIRCLE);
    if (this.state.get("path") === "turn") this.#askOnce("shortest", "shortest-turn", [...CIRCLE, "pitch"]);
  }

  /** What belongs to the dance that is shown, once. */
  #askDance() {
    const { dance } = this;
    if (!dance || dance.track) return;
    this.#startTrack(dance);
    const { begin, end } = dance;
    if (dance.answer.time !== null) this.#keep("gap", "clearance", this.#clearanceOf(dance, end, end, 1), dance);
    this.#keep("clearance", "clearance", this.#clearanceOf(dance, begin, end, (end - begin) / CLEARANCE_SAMPLES || 1), dance);
    if (dance.report) this.#accepted("fastest", { answer: dance.report, dance });
    else this.#keep("fastest", "check", { body: this.checkBody(dance) }, dance);
  }

  /** The question of a clearance: flat on a spiral, where it may be of more benches; in a body on other paths. */
  #clearanceOf({ kind, query }, start, stop, step) {
    if (kind !== "spiral") return { body: this.body({ times: { start, stop, step } }) };
    return { query: { ...Object.fromEntries(MOTION.map((name) => [name, query[name]])), start, stop, step } };
  }

  #startTrack(dance) {
    const ask = (chunk, times, decimals) => this.service.ask(`track ${chunk}`, "trajectory", { body: this.body({ times, decimals }) });
    const ready = () => dance === this.dance && this.tell("track");
    dance.track = new Track(ask, [dance.begin, dance.end], dance.numbers.benches + 1, dance.numbers.head_speed, ready);
    this.tell("track");
  }

  #askOnce(kind, path, names) {
    const query = this.state.texts(names);
    if (this.#isNew(kind, query)) this.#keep(kind, path, { query });
  }

  async #keep(kind, path, question, dance = null) {
    const answer = await this.#answer(kind, path, question);
    const outdated = dance && dance !== this.dance;
    if (answer && !outdated) this.#accepted(kind, { answer, query: question.query, dance });
  }

  #accepted(kind, kept) {
    this.answers[kind] = kept;
    this.refusals.delete(kind);
    this.tell(kind);
  }

  #isNew(kind, query) {
    const key = JSON.stringify(query);
    if (this.#asked.get(kind) === key) return false;
    this.#asked.set(kind, key);
    return true;
  }

  /** The answer, or undefined when it was refused or superseded. */
  async #answer(channel, path, question) {
    try {
      const answer = await this.service.ask(channel, path, question);
      if (this.refusals.delete(channel)) this.tell("refused");
      return answer;
    } catch (error) {
      if (error instanceof Superseded) return undefined;
      if (!(error instanceof Problem)) throw error;
      this.refusals.set(channel, error);
      this.tell("refused");
      return undefined;
    }
  }
}
