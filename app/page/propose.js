/** The square by its size, and dances proposed for it: one of the cards becomes the route. */

import { Problem, Superseded, TOO_LONG } from "./api.js";
import { cardPicture } from "./cards.js";
import { headingOf, withPoints } from "./changes.js";
import { FACTORS, times } from "./controls.js";
import { Corners } from "./corners.js";
import { EMPTY, THINGS, drawingOf, freeName, ownOf, venueOf, yardOf } from "./drawing.js";
import { $, bearer, button, hide, make, numberIn, textButton } from "./elements.js";
import { HINTS, LABELS, strayOf } from "./fields.js";
import { helpOf } from "./helps.js";
import { KITS } from "./kits.js";
import { knotsOf } from "./knots.js";
import { clockIn, secondsBetween } from "./passages.js";
import { pending } from "./pending.js";
import { isPresetPath, isPresetVenue } from "./presets.js";
import { circle, extent, lShape, rectangle, shapeOf, tShape, uShape } from "./square.js";
import { roundedRoute } from "./walk.js";
import { between, language, phrase, say, sentencesOf, writeTexts } from "./text.js";

/** What may be put into a square. @type {Phrases} */
const TOOLS = {
  gate: "Gate",
  circle: "Tree",
  fountain: "Fountain",
  block: "Obstacle",
  area: "Square",
};
/** Squares by their size, and what a typed corner is cut from. @type {Record<string, { name: string, draw: any }>} */
const SHAPES = {
  rectangle: { name: phrase("a rectangle"), draw: rectangle },
  l: { name: phrase("an L"), draw: lShape },
  t: { name: phrase("a T"), draw: tShape },
  u: { name: phrase("a U"), draw: uShape },
  circle: { name: phrase("a circle"), draw: circle },
};
/** What is cut from a square that is no rectangle, at first [m]. */
const NOTCH = ["14", "10"];
/** Size of a square before any is drawn [m], and the largest one. */
const [WIDTH, HEIGHT, MOST] = [30, 40, 10_000];
/** Difference of width and height of a round square, from rounding [m]. */
const SAME = 1e-3;
/** Numbers of the dragon that are asked for beside the square, and what says how long it may dance. */
const [DRAGON, WHEN] = [["benches", "body_length", "head_length", "head_speed", "stray"], ["ends", "laps", "begin_clock"]];
/** Number of dances that are proposed, and time between two looks at the search [ms]. */
const [COUNT, SECOND] = [3, 1_000];
/** What a good dance has much of. @type {Phrases} */
const OBJECTIVES = {
  tolerance: "room for people",
  benches: "as many benches as fit",
  turns: "many turns",
  duration: "a long dance",
};
/** True for a thing that has no point in the rectangle around a ring. */
function isBeyond(thing, ring) {
  const { width, height, middle: [x, y] } = extent(ring);
  return thing.points.every(([px, py]) => Math.abs(px - x) > width / 2 || Math.abs(py - y) > height / 2);
}
/** The drawing with its gates at the same share of the sides of another square. ring, points: corners before and after */
function stretched(drawing, ring, points) {
  if (!ring.length) return drawing;
  const [before, after] = [extent(ring), extent(points)];
  const at = ([x, y]) => [after.middle[0] + ((x - before.middle[0]) * after.width) / before.width, after.middle[1] + ((y - before.middle[1]) * after.height) / before.height];
  return { ...drawing, things: drawing.things.map((thing) => (thing.kind === "gate" ? { ...thing, points: thing.points.map(at) } : thing)) };
}
const isDrawn = ({ points, path }) => points.length > 0 || Boolean(path);
/** A number of minutes as people write it, perhaps with its unit. */
const MINUTES = /^(\d+(?:[.,]\d+)?)\s*(\p{L}*)$/u;
/** Longest and shortest time of a dance [s], and most times around [1], as in the service. */
const [SHORTEST, LONGEST, LAPS_MOST] = [1, 86_400, 100];
/** Words for the stray behind the door of the village, and those of the other doors. */
const STRAY = { true: [phrase("People may stray up to"), phrase("from their place")], false: [LABELS.stray, HINTS.stray] };
/** A drawing without a path. */
const { points, straight, path, start, begin } = EMPTY;
const WITHOUT_PATH = { points, straight, path, start, begin };
const WAITING = ["accepted", "running"];
const field = (label, properties) => make("input", { inputMode: "decimal", autocomplete: "off", "data-label": label, "aria-label": say(label), ...properties });

export class Propose {
  /** Of the last question: {key, yard, things, proposals, courses, and the rest of the answer unless it is on its way}; null before. */
  #answer = null;
  /** The search that runs: {began, share: of the figures that were tried [%], job, end}; null without one. */
  #search = null;
  #problem = null;
  #chosen = null;
  /** The path of the chosen dance, and the question that it answers. */
  #made = { path: null, key: "" };
  /** What the cards show. */
  #drawn = null;
  #looking = Symbol("search");
  /** True once a search took too long for one answer. */
  #takesLong = false;
  /** True for a square that is one of the shapes. */
  #shaped = false;

  /**
   * @param {any} box
   * changed(): called when a search begins or ends, or a dance is found; placed(): when one is chosen
   * @param {{ state: State, service: Service, questions: Questions, steps: Steps, editor: Editor, changed: () => void, placed: () => void }} parts
   */
  constructor(box, { state, service, questions, steps, editor, changed, placed }) {
    this.changed = changed;
    this.placed = placed;
    this.box = box;
    this.state = state;
    this.service = service;
    this.questions = questions;
    this.steps = steps;
    this.editor = editor;
    /** What is said in place of the answer, in the language of the page. @type {(() => string) | null} */
    this.note = null;
    /** Why a size is refused; null without. @type {(() => string) | null} */
    this.refusal = null;
    const line = (...parts) => make("p", { className: "line" }, ...parts);
    const words = (text) => make("span", { "data-text": text });
    const unit = () => make("span", { textContent: "m" });
    const size = (text, ...fields) => make("span", { className: "size" }, ...(text ? [words(text), " "] : []), ...fields.flatMap((one, k) => (k ? [" × ", one] : [one])), " m");
    this.sizes = [field(phrase("Width of the square"), { id: "place-width" }), field(phrase("Length of the square"), { id: "place-height" }), field(phrase("Diameter of the square"), { id: "place-diameter" })];
    const [width, height, diameter] = this.sizes;
    this.notch = [field(phrase("Width of what is cut out"), { id: "notch-width", value: NOTCH[0] }), field(phrase("Length of what is cut out"), { id: "notch-height", value: NOTCH[1] })];
    this.shape = make("select", { id: "place-shape", "data-label": "Shape of the square", onchange: () => this.#reshape() }, ...Object.entries(SHAPES).map(([value, { name }]) => make("option", { value, "data-text": name })));
    this.dragon = DRAGON.map((name) => field(LABELS[name], { onchange: ({ target }) => this.#setNumber(name, target) }));
    this.ends = field(phrase("It must end by"), { id: "ends", inputMode: "text", onchange: ({ target }) => this.steps.change({ ends: target.value.trim() }), "aria-describedby": "ends-wrong" });
    this.laps = field(phrase("Times around a ring or an eight"), { id: "laps", onchange: ({ target }) => this.steps.change({ laps: target.value.trim() }), "aria-describedby": "ends-wrong" });
    this.objective = make("select", { "data-label": "Best is", id: "objective" }, ...Object.entries(OBJECTIVES).map(([value, words]) => make("option", { value, "data-text": words })));
    this.ask = textButton("Propose a dance", () => this.#ask(), { id: "propose", className: "main" });
    this.words = make("p", { role: "status", id: "proposed" });
    this.stop = textButton("Stop", () => this.#stop(), { hidden: true });
    this.cardsTitle = make("h3", { id: "cards-title" });
    this.cardsOld = make("p", { className: "error", id: "cards-old", "data-text": "These were proposed for an earlier square, other gates or another dragon. Propose again." });
    this.cards = make("ol", { id: "cards" });
    this.corners = new Corners({ state, steps, editor }, (refused) => this.#tell(refused));
    const tools = Object.entries(TOOLS).map(([tool, words]) => textButton(words, () => this.#tool(tool), { "data-add": tool }));
    tools.push(textButton("More …", () => {}, { "data-add": "kits", popoverTargetElement: $("#kits") }));
    box.append(
      line(words(phrase("Our square is")), this.shape, (this.sides = size("", width, height)), (this.across = size("", diameter)), (this.cut = size(phrase("without"), ...this.notch)), textButton("Draw it", () => this.#draw(), { id: "take-shape", "data-label": "Draw it: the square by its size" })),
      (this.wrong = make("p", { className: "error", id: "place-wrong", role: "alert" })),
      (this.help = make("p", { className: "hint", id: "add-help", role: "status" })),
      (this.tools = make("p", { className: "buttons" }, ...tools)),
      (this.done = textButton("Done", () => this.editor.turn(false), { id: "place-done" })),
      this.corners.box,
      (this.dragonLine = line(words(phrase("We have")), this.dragon[0], words(phrase("benches of")), this.dragon[1], unit(), words(phrase("and a head of")), this.dragon[2], unit())),
      line(words(phrase("It goes")), this.dragon[3], make("span", { textContent: "m/s" }), words(phrase("people stray")), this.dragon[4], make("span", { textContent: "cm" })),
      (this.start = make("div")),
      line(make("label", { htmlFor: "ends", "data-text": "It must end by" }), this.ends),
      line(make("label", { htmlFor: "laps", "data-text": "or go around" }), this.laps, words(phrase("times"))),
      (this.endsWrong = make("p", { className: "error", id: "ends-wrong", role: "alert" })),
      line(make("label", { htmlFor: "objective", "data-text": "Best is" }), this.objective),
      make("p", { className: "buttons" }, this.ask, this.stop),
      this.words,
      this.cardsTitle,
      this.cardsOld,
      this.cards,
    );
    for (const one of [...this.sizes, ...this.notch]) {
      one.addEventListener("input", () => (one.typed = true));
      one.addEventListener("change", () => this.#reshape());
    }
    // Where the dragon is typed in, a phone has no room for the tools and for the numbers of a thing. A button would move away under the finger.
    box.addEventListener("focusin", ({ target }) => editor.active && target.matches("input, select") && this.dragonLine.compareDocumentPosition(target) & (Node.DOCUMENT_POSITION_FOLLOWING | Node.DOCUMENT_POSITION_CONTAINED_BY) && editor.turn(false));
    state.listen((names) => [...DRAGON, ...WHEN, "csv", "margin", "hole", "pin", "drawing", "path", "door"].some((name) => names.has(name)) && this.show());
  }

  get #drawing() {
    return this.state.get("drawing");
  }

  /** The question about the drawn square. */
  #request() {
    const { numbers, extras, ...request } = /** @type {any} */ (this.questions.drawn());
    const drawing = { ...this.#drawing, things: this.#drawing.things.map((thing) => (thing.kind === "area" ? { ...thing, points: yardOf(this.#drawing) } : thing)) };
    const gates = drawing.things.filter(({ kind }) => kind === "gate").map((gate) => ({ name: gate.name, point: gate.points[0], ...ownOf(gate), heading: headingOf(this.#drawing, gate) }));
    const { dragon } = this.questions.body({}, { numbers, extras, ...request });
    const { seconds, laps } = this.#howLong;
    const limits = { head_speed: numbers.head_speed, margin: numbers.margin, stray: strayOf(numbers), ...(drawing.limit && { speed_limit: drawing.limit }), ...(seconds && { duration_limit: seconds }), ...(laps && { laps }) };
    return { venue: venueOf(drawing), dragon, gates, ...limits, objective: this.objective.value, count: COUNT };
  }

  /** How long the dance may last: {seconds, laps, each null without one; wrong: why it cannot be read, or an empty text; by: the field}. */
  get #howLong() {
    const [ends, laps, begins] = WHEN.map((name) => this.state.get(name));
    const around = laps === "" ? null : numberIn(laps);
    if (around !== null && !(Number.isInteger(around) && around >= 1 && around <= LAPS_MOST)) return { seconds: null, laps: null, by: this.laps, wrong: say("A dance goes around 1 to {most} times; you typed “{text}”.", { most: LAPS_MOST, text: laps }) };
    const clock = /[:：]|[ap]m$/i.test(ends) || (begins && /\./.test(ends)) ? clockIn(ends) : null;
    const [, minutes, unit = ""] = MINUTES.exec(ends) ?? [];
    const seconds = clock ? begins && secondsBetween(begins, clock) : minutes && say("minutes").startsWith(unit.toLowerCase()) ? 60 * numberIn(minutes) : ends && NaN;
    if (ends === "" || (seconds >= SHORTEST && seconds <= LONGEST)) return { seconds: seconds || null, laps: around, wrong: "", by: null };
    const wrong = clock && !begins ? say("Say at “Starts at” when the dance starts, or here for how many minutes it may last, such as 20.") : clock ? say("The dance starts at {begins}: {text} is not after that.", { begins, text: ends }) : say("Write a time of day after the start, such as 19:50, or minutes, such as 20; you typed “{text}”.", { text: ends });
    return { seconds: null, laps: null, by: this.ends, wrong };
  }

  #setNumber(name, target) {
    this.steps.change({ [name]: times(String(numberIn(target.value)), 1 / FACTORS[name]) });
  }

  /** After a change of the shape or of a size: draw it at once, unless that would take corners that a hand has put. */
  #reshape() {
    const drawing = this.#drawing;
    if (!yardOf(drawing).length || isPresetVenue(drawing) || this.#shaped) this.#draw();
    this.show();
  }

  /** Draw the square of the chosen shape by its size; what stands in it stays, and so does a path of one's own. */
  #draw() {
    const { draw: shape } = SHAPES[this.shape.value];
    const sides = this.sizes.slice(0, 2);
    const fields = shape === circle ? [this.sizes[2]] : shape === rectangle ? sides : [...sides, ...this.notch];
    const numbers = fields.map(({ value }) => numberIn(value));
    // What is cut out leaves a part on each side of it; a T loses it twice.
    const most = fields.map((_, k) => (k < 2 ? MOST : numbers[k - 2] / (k === 2 && shape === tShape ? 2 : 1)));
    fields.forEach((one, k) => one.setAttribute("aria-invalid", !(numbers[k] > 0 && (k < 2 ? numbers[k] <= MOST : numbers[k] < most[k]))));
    const wrong = fields.find((one) => one.getAttribute("aria-invalid") === "true");
    const high = wrong && most[fields.indexOf(wrong)];
    this.refusal = wrong ? () => say(high === MOST ? "“{what}” must be more than 0 m and at most {high} m; you typed “{text}”. The square stays as it was." : "“{what}” must be more than 0 m and less than {high} m; you typed “{text}”. The square stays as it was.", { what: say(wrong.dataset.label), high: high.toLocaleString("en"), text: wrong.value }) : null;
    if (wrong) return this.show();
    // A number typed for the other shape stays, unless it is wrong.
    for (const one of [...this.sizes, ...this.notch]) {
      if (fields.includes(one) || one.getAttribute("aria-invalid") === "true") one.typed = false;
      one.removeAttribute("aria-invalid");
    }
    const before = this.#drawing;
    const drawing = { ...before, ...(isPresetPath(before) && WITHOUT_PATH), ...(isPresetVenue(before) && { things: [], yard: null }) };
    const yard = yardOf(drawing);
    const points = shape(...numbers, yard.length ? extent(yard).middle : [0, 0]);
    const k = drawing.things.findIndex(({ kind }) => kind === "area");
    const area = { kind: "area", name: freeName(drawing.things, say(THINGS.area)), points };
    const drawn = k < 0 ? { ...drawing, things: [area, ...drawing.things] } : withPoints({ ...stretched(drawing, yard, points), yard: null }, k, points);
    this.steps.change({ drawing: drawn, view: null, time: null });
    this.editor.edit(null);
    const beyond = drawing.things.filter((thing) => !["area", "gate", "lane"].includes(thing.kind) && isBeyond(thing, points)).map(({ name }) => name);
    this.#tell(beyond.length ? () => say("Outside the square now: {names}. They stay in the drawing; remove them in its list under “More numbers and answers”.", { names: beyond.join(between()) }) : null);
  }

  /** Let taps on the picture add things of this kind. */
  #tool(tool) {
    this.editor.turn(true);
    this.editor.take(KITS[tool]?.kind ?? tool, KITS[tool]);
    this.#tell(null);
    for (const one of [$("#dance"), this.help]) one.scrollIntoView({ block: "nearest" });
  }

  /** Say something below the button. words(): in the language of the page; null: what the answer says */
  #tell(words) {
    this.note = words;
    this.show();
  }

  async #ask() {
    if (!yardOf(this.#drawing).length) return this.#tell(() => say("First say how large your square is."));
    const { by } = this.#howLong;
    if (by) return by.focus();
    const request = this.#request();
    const search = { began: performance.now(), share: 0, job: null, end: new AbortController() };
    this.note = null;
    [this.#search, this.#answer, this.#problem, this.#chosen] = [search, null, null, null];
    const hasFocus = document.activeElement === this.ask;
    this.editor.turn(false); // it shows all, which asks again for an answer in another language
    this.changed();
    // Keys go on where they were: at what can be done now.
    if (hasFocus) this.stop.focus({ preventScroll: true });
    this.words.scrollIntoView({ block: "nearest" });
    pending(this.#looking, true);
    const clock = setInterval(() => this.show(), SECOND);
    try {
      const answer = await this.#answerTo(request, search);
      if (search !== this.#search) return;
      // Cards that are there stay in their places: somebody may be reading them. A better dance takes the place of another.
      const { proposals: found, courses: theirs } = this.#answer ?? { proposals: [], courses: [] };
      const texts = answer.proposals.map(({ dance }) => JSON.stringify(dance));
      const known = found.map(({ dance }) => texts.indexOf(JSON.stringify(dance)));
      const further = [...texts.keys()].filter((k) => !known.includes(k));
      const order = [...known.map((k) => (k < 0 ? further.shift() : k)), ...further].filter((k) => k !== undefined);
      const courses = await Promise.all(order.map((k) => theirs[known.indexOf(k)] ?? this.#courseOf(answer.proposals[k], k)));
      this.#take({ ...this.#about(request), ...answer, proposals: order.map((k) => answer.proposals[k]), courses });
    } catch (error) {
      if (search !== this.#search) return;
      if (error instanceof Problem) this.#problem = error.problem;
      else if (!(error instanceof Superseded)) throw error;
    } finally {
      clearInterval(clock);
      search.end.abort();
      if (!this.#search || search === this.#search) pending(this.#looking, false);
    }
    this.#search = null;
    const hadFocus = document.activeElement === this.stop;
    this.changed();
    // Without a path, the best dance is shown at once.
    if (this.next === "choose" && !isDrawn(this.#drawing) && !this.state.get("dances")) this.#choose(0);
    if (hadFocus) (this.cards.querySelector("button") ?? this.ask).focus({ preventScroll: true });
    if (!this.#answer?.proposals.length) this.words.scrollIntoView({ block: "nearest" }); // a reason has more lines
  }

  /** The square and the question of an answer. */
  #about(request) {
    return { key: this.#keyOf(request), yard: yardOf(this.#drawing), things: this.#drawing.things, language: language() };
  }

  /** Show an answer; its first cards come into view. */
  #take(answer) {
    const isFirst = !this.#answer && answer.proposals.length > 0;
    this.#answer = answer;
    this.changed();
    if (isFirst) this.cards.scrollIntoView({ block: "nearest" });
  }

  #courseOf({ dance: { path, dragon } }, k) {
    return this.service.ask(`card ${k}`, "course", { body: { path, dragon } });
  }

  /** Show the proposals of a job as they are found. */
  async #follow(request, search) {
    const answer = { ...this.#about(request), proposals: [], courses: [] };
    for await (const { part } of this.service.events(`jobs/${search.job}/events`, search.end.signal)) {
      if (!part || search !== this.#search) continue;
      const course = await this.#courseOf(part, answer.proposals.length).catch(() => null);
      if (!course || search !== this.#search) continue;
      answer.proposals.push(part);
      answer.courses.push(course);
      this.#take(answer);
    }
  }

  /** The proposals, at once or, where that takes too long for one answer, by a job. */
  async #answerTo(body, search) {
    // Once a search took too long, the next ones are jobs at once, so that nobody waits for both.
    try {
      if (!this.#takesLong) return await this.service.ask("proposals", "proposals", { body });
    } catch (error) {
      if (!(error instanceof Problem) || error.problem.type !== TOO_LONG) throw error;
      this.#takesLong = true;
    }
    let status = await this.service.ask("proposals", "proposals", { body, headers: { Prefer: "respond-async", ...bearer() } });
    search.job = status.jobID;
    this.#follow(body, search);
    while (WAITING.includes(status.status)) {
      await new Promise((resolve) => setTimeout(resolve, SECOND));
      if (search !== this.#search) throw new Superseded();
      status = await this.service.ask("proposals", `jobs/${search.job}`, { cache: "no-store" });
      search.share = status.progress;
    }
    if (status.problem) throw new Problem(status.problem.status, status.problem);
    const answer = await this.service.ask("proposals", `jobs/${search.job}/result`);
    this.#remove(search.job);
    return answer;
  }

  /** Remove a job, whose answer is here or not wanted any more. */
  #remove(job) {
    this.service.ask(`end ${job}`, `jobs/${job}`, { method: "DELETE" }).catch(() => {});
  }

  #stop() {
    this.#search?.end.abort();
    if (this.#search?.job) this.#remove(this.#search.job);
    this.service.drop(["proposals"]);
    this.#search = null;
    this.changed();
  }

  /** What a question is known by: another name of a gate is no other question. */
  #keyOf({ gates, ...request }) {
    return JSON.stringify([request, gates.map(({ name, ...gate }) => gate)]);
  }

  /** Make the dance of a card the route. */
  #choose(k) {
    if (this.#search) this.#stop();
    const { proposals, courses } = this.#answer;
    const { dance, duration } = proposals[k];
    const drawing = this.#drawing;
    const opened = drawingOf(dance);
    const yard = yardOf(drawing);
    const area = opened.things.find(({ kind }) => kind === "area");
    const hasStreets = drawing.things.some(({ kind }) => kind === "gate");
    // The streets in which other dragons stand already stay.
    const isCommon = hasStreets && drawing.yard && this.state.get("dances");
    const things = drawing.things.map((thing) => (thing.kind === "area" && !isCommon ? { ...thing, points: hasStreets ? area.points : yard } : thing));
    // What is judged and shown is what the address says, to every digit.
    const { path, start, begin } = { ...opened, path: roundedRoute(dance.path), start: dance.start, begin: dance.path.start };
    this.editor.turn(false);
    this.editor.take("path");
    const benches = dance.dragon.benches ?? dance.dragon.lengths?.length;
    const numbers = { head_speed: String(dance.head_speed), ...(benches && !this.state.get("csv") && { benches: String(benches) }) };
    this.#chosen = k;
    this.steps.change({ ...numbers, time: duration / 2, view: null, drawing: { ...drawing, things, yard: hasStreets ? yard : null, path, start, begin, ...knotsOf(courses[k]) } });
    this.#answer.key = this.#keyOf(this.#request());
    this.#made = { path: this.#drawing.path, key: this.#answer.key };
    this.changed();
    this.placed();
  }

  /** True for an answer to another question than that of what is shown now. */
  get #isOld() {
    return Boolean(this.#answer) && this.#answer.key !== this.#keyOf(this.#request());
  }

  /** What comes next without a path; null while dances are looked for. */
  get next() {
    if (!yardOf(this.#drawing).length) return "path";
    if (this.#search) return null;
    return this.#answer?.proposals.length && !this.#isOld ? "choose" : "propose";
  }

  /** What the verdict on the dance has to say of gates and of an earlier square, or an empty text. */
  get remark() {
    const { path, things, yard } = this.#drawing;
    if (path && path === this.#made.path) return this.#made.key === this.#keyOf(this.#request()) ? "" : say("This dance was proposed for an earlier square, other gates or another dragon: “Propose a dance” finds one for what is shown now.");
    return !yard && things.some(({ kind }) => kind === "gate") ? say("The verdict is on the path drawn here. Gates do not count for it: only “Propose a dance” uses them.") : "";
  }

  /** How many benches the area of the square bounds, if they are what counts. */
  #most({ most_benches: most = null }) {
    return this.objective.value === "benches" && most !== null ? say("By its area the square has room for at most {most}.", { most }) : "";
  }

  /** After a change of anything. */
  show() {
    const drawing = this.#drawing;
    const isRoute = this.state.get("path") === "route";
    hide(this.box, !isRoute);
    this.#showStart(isRoute);
    const [label, help] = STRAY[String(this.state.get("door") === "village")];
    if ($("#stray-help").dataset.text !== help) {
      $("label[for=stray]").dataset.text = label;
      $("#stray-help").dataset.text = help;
      writeTexts();
    }
    if (!isRoute) return;
    this.#showSizes(yardOf(drawing));
    const isCircle = this.shape.value === "circle";
    hide(this.sides, isCircle);
    hide(this.across, !isCircle);
    hide(this.cut, isCircle || this.shape.value === "rectangle");
    hide(this.wrong, !this.refusal);
    this.wrong.textContent = this.refusal?.() ?? "";
    this.help.textContent = this.editor.active ? helpOf(this.editor) : say("What is in it? Choose, then tap the picture.");
    // While drawing, the tools stand above the picture.
    hide(this.tools, this.editor.active);
    hide(this.done, !this.editor.active);
    this.corners.show();
    hide(this.dragonLine, Boolean(this.state.get("csv")));
    const { wrong, by } = this.#howLong;
    hide(this.endsWrong, !by);
    this.endsWrong.textContent = wrong;
    this.ends.placeholder = say("19:50 or 20 min");
    for (const one of [this.ends, this.laps]) {
      one.setAttribute("aria-invalid", one === by);
      if (document.activeElement !== one) one.value = this.state.get(one.id);
    }
    for (const [k, name] of DRAGON.entries()) if (document.activeElement !== this.dragon[k]) this.dragon[k].value = times(this.state.get(name), FACTORS[name]);
    hide(this.stop, !this.#search);
    this.ask.disabled = Boolean(this.#search);
    const isOld = this.#isOld;
    // A reason in another language is asked for again.
    const reason = this.#problem ?? (isOld || this.#answer?.proposals.length ? null : this.#answer);
    if (reason && !this.#search && reason.language !== language()) return void this.#ask();
    this.#showWords(isOld ? null : this.#answer);
    this.#showCards(this.#answer, isOld);
  }

  /** The time of day of the start among the numbers of the square, or else beside the speeds. */
  #showStart(isRoute) {
    const [starts, home] = [$("#starts"), isRoute ? this.start : $("#pace")];
    if (starts.parentElement !== home) home.append(starts);
  }

  #showSizes(yard) {
    const { width, height } = yard.length ? extent(yard) : { width: WIDTH, height: HEIGHT };
    if (yard !== this.sized) {
      // A square that was opened has its shape and its sizes here too, to be drawn again.
      const known = yard.length ? shapeOf(yard, Object.entries(SHAPES).map(([name, { draw }]) => [name, draw])) : null;
      this.#shaped = Boolean(known);
      if (known) this.shape.value = known.name;
      if (known?.cut.length && !this.notch.some(({ typed }) => typed)) this.notch.forEach((one, k) => (one.value = String(known.cut[k])));
      this.sized = yard;
    }
    // Only a round square has a diameter: the field keeps its number beside any other.
    const isRound = yard.length > 4 && Math.abs(width - height) < SAME;
    const values = [width, height, isRound || !this.sizes[2].value ? Math.min(width, height) : null];
    this.sizes.forEach((one, k) => {
      if (values[k] === null || one.typed || document.activeElement === one || one.getAttribute("aria-invalid") === "true") return;
      one.value = String(Number(values[k].toFixed(2)));
    });
  }

  #showWords(answer) {
    const seconds = this.#search && Math.round((performance.now() - this.#search.began) / 1000);
    const result = answer && (answer.proposals.length ? sentencesOf([say(answer.tried ? "The best {count} of {tried} tried; each has passed its check." : "{count} found so far.", { count: answer.proposals.length, tried: answer.tried }), say("Choose one; then you may edit it."), this.#most(answer)]) : answer.reason);
    const going = () => say(answer ? "{count} found so far, the search goes on: {seconds} s" : "Looking for dances that fit: {seconds} s", { seconds, count: answer?.proposals.length }) + (this.#search.job ? say(", {share} % of the kinds of dance tried", this.#search) : "");
    const text = this.#search ? going() : (this.note?.() ?? result ?? "");
    const problem = !this.#search && !text && this.#problem;
    this.words.textContent = problem?.sentence ?? text;
    this.words.className = problem || (answer && !answer.proposals.length) ? "error" : "hint";
  }

  #showCards(answer, isOld) {
    const count = answer?.proposals.length ?? 0;
    hide(this.cardsTitle, !count);
    hide(this.cardsOld, !count || !isOld);
    this.cardsTitle.textContent = count ? say(count === 1 ? "1 dance" : "{count} dances", { count }) : "";
    // Cards that stay the same keep the focus while the search goes on.
    const drawn = answer && JSON.stringify([answer.key, isOld, count, answer.tried, this.#chosen, this.state.get("lang")]);
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    if (!answer) return this.cards.replaceChildren();
    const cards = answer.proposals.map((proposal, k) => {
      const { title, size, good, tight, is_tight: isTight } = proposal.cards[language()];
      const lines = [["good", "✓", good], [isTight ? "tight" : "near", isTight ? "!" : "↔", tight]].map(([className, mark, text]) => make("span", { className }, make("b", { "aria-hidden": "true", textContent: mark }), " ", text));
      const picture = make("span", { className: "picture", "aria-hidden": "true", innerHTML: cardPicture(answer, answer.courses[k]) });
      return make("li", {}, button({ "aria-pressed": this.#chosen === k && !isOld, disabled: isOld }, () => this.#choose(k), picture, make("b", { textContent: title }), make("span", { className: "hint", textContent: size }), ...lines));
    });
    this.cards.replaceChildren(...cards);
  }
}
