/** The page's questions to the service: first contact, pose and minimum pitch at once, the others when input pauses. */

import { Problem, Superseded } from "./api.js";
import { CONTACT, DRAGON } from "./state.js";
import { Track } from "./track.js";

/** Time without a change after which input counts as paused [ms]. */
const REST = 250;
const CLEARANCE_SAMPLES = 400;
/** The curve of how far people may stray is nearly straight. */
const CURVE = { samples: 13 };
/** At a fold the chain is about to break, so the page shows the instant this long before it [s]. */
const BEFORE_END = 1e-6;
/** Distance between samples of the path [m], and the largest number of samples. */
const [PATH_STEP, PATH_SAMPLES] = [0.3, 6_000];
/** Travel of the head before and after the beginning of a turn, whose coils have no end [m]. */
const TURN_TRAVEL = 100;

const MOTION = [...DRAGON, "pitch", "start_turns", "head_speed"];
const CIRCLE = [...DRAGON, "turning_diameter", "start_turns"];
/** While a slider is dragged, the engines judge only the touching pair. */
const QUICK = { cross_check: "pair" };
/** Refusals of these concern a number that a person entered; others only affect what can be shown. The last one wins. */
const ABOUT_NUMBERS = ["minimum", "contact"];

const numbersOf = (texts) => Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, Number(text)]));

/** The last instant shown: first contact, or the time until which nothing touches. */
function lastInstant({ time, time_bracket, end }) {
  return time ?? (end ? end.time - BEFORE_END : time_bracket[0]);
}

export class Questions {
  /** {kind, query, numbers, answer, begin, end, report: of /check if it answered, track} */
  dance = null;
  /** kind -> {answer, query or body, dance}: the newest, to be shown again in another language */
  answers = {};
  /** channel -> Problem */
  refusals = new Map();
  #rest = 0;
  #asked = new Map();
  /** Whether the engines judge the whole dragon at the minimum pitch: at first, and when input pauses. */
  #whole = true;

  /** tell(kind, detail): an answer of this kind came, or a refusal came or went */
  constructor(service, state, tell) {
    Object.assign(this, { service, state, tell });
  }

  /** Ask everything that depends on the numbers of the state. */
  refresh() {
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => this.#atRest(), REST);
    const kind = this.state.get("path");
    const query = this.state.texts([...MOTION, ...CONTACT, ...(kind === "turn" ? ["turning_diameter"] : [])]);
    if (this.#isNew("contact", { kind, ...query })) this.#askContact({ kind, query, numbers: numbersOf(query) });
    const circle = this.state.texts([...CIRCLE, ...CONTACT]);
    if (!this.#isNew("minimum", circle)) return;
    this.#whole = !this.answers.minimum;
    this.#keep("minimum", "minimum-pitch", { query: this.#whole ? circle : { ...circle, ...QUICK } });
  }

  /** Body of a request about a dance; default: the dance shown. */
  body(more, { numbers, kind } = this.dance) {
    const dragon = Object.fromEntries(DRAGON.map((name) => [name, numbers[name]]));
    const path = { kind, pitch: numbers.pitch, start_turns: numbers.start_turns };
    if (kind === "turn") path.turning_diameter = numbers.turning_diameter;
    return { dragon, path, head_speed: numbers.head_speed, ...more };
  }

  /** Body of /check: a spiral is danced to its end. */
  checkBody(asked) {
    const contact = Object.fromEntries(CONTACT.map((name) => [name, asked.numbers[name]]));
    return this.body({ ...contact, ...this.#stretch(asked) }, asked);
  }

  /** The part of a turn that is danced, as its coils have no end; a spiral is danced to its end. */
  #stretch({ kind, numbers }) {
    const time = TURN_TRAVEL / numbers.head_speed;
    return kind === "turn" ? { start: -time, stop: time } : {};
  }

  /** The service's own numbers at one instant. */
  async pose(time) {
    const { dance } = this;
    const table = await this.#answer("pose", "trajectory", { body: this.body({ times: [time] }) });
    if (!table || dance !== this.dance) return;
    this.tell("pose", { time, dance, x: table.x[0], y: table.y[0], speed: table.speed[0] });
  }

  /** Errors in the numbers: name -> the service's message. */
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

  /** The path from behind the tail to the end, sampled as the way of a single bench's head. */
  async #askPath() {
    const { numbers, begin, end } = this.dance;
    // A length exceeds its chord by more than the chord falls short of its arc, so this reaches behind the tail.
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
      this.#keep("minimum", "minimum-pitch", { query: this.state.texts([...CIRCLE, ...CONTACT]) });
    }
    const over = (names, more) => ({ query: { ...this.state.texts(names), ...more } });
    const slow = [["tolerance", "tolerance", this.#toleranceOf()]];
    if (this.state.get("path") === "turn") slow.push(["shortest", "shortest-turn", over([...CIRCLE, ...CONTACT, "pitch"])]);
    slow.push(["scan", "pitch-scan", over([...CIRCLE, "margin"])], ["curve", "tolerance-curve", over(CIRCLE, CURVE)]);
    this.#askInTurn(slow);
  }

  /** The request for how far people may stray on the way to the circle, or on the part of a turn that is danced. */
  #toleranceOf() {
    const kind = this.state.get("path");
    const query = this.state.texts([...MOTION, "turning_diameter"]);
    const asked = { kind, numbers: numbersOf(query) };
    return kind === "turn" ? { body: this.body(this.#stretch(asked), asked) } : { query };
  }

  /** Ask slow questions one after another, because the service takes few at once. slow: [kind, path, question] of each */
  async #askInTurn(slow) {
    const changed = slow.filter(([kind, , question]) => this.#isNew(kind, question));
    for (const [kind] of changed) this.service.tell.busy(kind, true);
    for (const ask of changed) if (!this.#isNew(ask[0], ask[2], false)) await this.#keep(...ask);
  }

  /** Ask once for all that belongs to the dance shown. */
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

  /** The request for a clearance: a query on a spiral, where more benches are allowed; a body on other paths. */
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

  async #keep(kind, path, question, dance = null) {
    const answer = await this.#answer(kind, path, question);
    const outdated = dance && dance !== this.dance;
    if (answer && !outdated) this.#accepted(kind, { answer, ...question, dance });
  }

  #accepted(kind, kept) {
    this.answers[kind] = kept;
    this.refusals.delete(kind);
    this.tell(kind);
  }

  /** Is this another question of its kind than the last one? mark: it becomes the last one */
  #isNew(kind, question, mark = true) {
    const key = JSON.stringify(question);
    if (this.#asked.get(kind) === key) return false;
    if (mark) this.#asked.set(kind, key);
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
