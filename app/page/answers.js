/** The answers, each with its evidence. */

import { button, make } from "./elements.js";
import { LABELS, strayOf } from "./fields.js";
import { bound, fixed, formatNumber, isExact } from "./numbers.js";
import { benchName, between, language, phrase, say, sayOf, sentencesOf, titleOf } from "./text.js";

/** Why every larger pitch is right. @type {Phrases} */
const JUSTIFIED = {
  bound: "feasible, proven for all at once",
  scan: "feasible by a scan: up to {from} m only single pitches are proven, at most {step} mm apart",
};

/** Why a run ends, except for a contact. @type {Phrases} */
const ENDS = {
  centre: "The head is at the centre.",
  turn: "The dance is shown from 100 m before the turn begins to 100 m after.",
  path: "The head is at the end of its path.",
  undecided: "The dance is shown as far as it is proven clear.",
};

/** Engines that judge a contact. @type {Phrases} */
const ENGINES = {
  separating_axis: "separating axis",
  fcl: "FCL",
  shapely: "shapely",
  angle_sum: "angle sum (paper)",
};

/** Corners and edges of a bench. @type {Phrases} */
const PLACES = {
  "front-outer": "front outer corner",
  "front-inner": "front inner corner",
  "rear-outer": "rear outer corner",
  "rear-inner": "rear inner corner",
  front: "front edge",
  rear: "rear edge",
  outer: "outer edge",
  inner: "inner edge",
};

/** The mark of each outcome: a dance fails with a contact or a fold, passes, or is undecided. */
const MARKS = { contact: "✕", contact_at_start: "✕", folds: "!", clear: "✓", undecided: "?" };

/** A time that is worth a word [s]. */
const SHOWN = 0.05;

/** Metres in millimetres; a value that rounds to zero has no sign. */
const millimetres = (metres) => fixed(1000 * metres, 3);
const paragraph = (textContent, more) => make("p", { textContent, ...more });
const pair = ([a, b], benches) => ({ a: benchName(a, benches), b: benchName(b, benches) });
/** A separation in words: the gap, or for a negative one the depth of the overlap. metres: [m] */
export function gapWords(metres) {
  const gap = millimetres(metres);
  return gap.startsWith("-") ? say("overlap by {depth} mm", { depth: gap.slice(1) }) : say("gap {gap} mm", { gap });
}

/** A safe stray in centimetres, rounded down. metres: [m] */
export const centimetres = (metres) => bound(100 * metres, 2, -1);
const ends = ([low, high], decimals) => ({ low: bound(low, decimals, -1), high: bound(high, decimals, 1) });
const bracket = (template, both, decimals) => [say("Bracket, rounded outwards"), say(template, ends(both, decimals))];

/** The section of the page "How it works" that explains the answer in a box. */
const IDEAS = { "minimum-pitch": "staircase", tolerance: "stray", "head-speed": "speed", "turn-time": "speed", "highest-speed": "speed", "shortest-turn": "turn", "quickest-turn": "turn", "run-end": "chord" };
const idea = ({ id }) => make("a", { href: `how?lang=${language()}#${IDEAS[id] ?? "step"}`, textContent: say("How it works") });

/**
 * Replace the content of a box, but keep its details open. title: text; known: elements; outcome: colours the box; digits: the value
 * with all of its digits, if the shown one may have fewer
 */
function show(box, title, value, lines, known = [], { outcome = "", digits = "" } = {}) {
  const open = box.querySelector("details")?.open ?? false;
  const details = known.length ? [make("details", { open }, make("summary", { textContent: say("How it is known") }), ...(digits && !isExact() ? [facts([say("More digits"), digits])] : []), ...known, idea(box))] : [];
  box.dataset.outcome = outcome;
  const heading = make("h3", { textContent: title });
  box.replaceChildren(paragraph(say("Older than your numbers"), { className: "old" }), heading, make("p", { className: "value" }, ...[value].flat()), ...lines.map((line) => paragraph(line)), ...details);
}

const facts = (...rows) => make("dl", {}, ...rows.flatMap((row) => ["dt", "dd"].map((tag, k) => make(tag, { textContent: row[k] }))));

/** The benches that the engines judged, in words. benches: of the dragon */
function judgedWords({ judged }, benches, request) {
  const count = judged.length;
  if (count === benches) return sayOf("judgedAll", request, { count });
  return count === 2 ? sayOf("judgedPair", request, pair(judged, benches)) : say(" judged the {count} of {benches} benches near the pair.", { count, benches });
}

function engines(check, benches, request) {
  if (!check) return paragraph(say("No pair to cross-check."));
  const word = (overlaps) => (overlaps === null ? say("contact at the start") : sayOf(overlaps ? "overlapping" : "apart", request));
  const cell = (overlaps) => make("td", { textContent: word(overlaps) });
  const head = (words, scope) => make("th", { scope, textContent: say(words) });
  const rows = Object.entries(check.engines).map(([name, { before, after }]) => make("tr", {}, head(ENGINES[name], "row"), cell(before), cell(after)));
  const heads = make("tr", {}, ...[phrase("Engine"), phrase("just before"), phrase("just after")].map((words) => head(words, "col")));
  const grounds = rows.length === 1 && say("shapely judged the area that {count} benches may cover.", { count: check.judged.length });
  const words = [grounds || `${say("{count} engines", { count: rows.length })}${judgedWords(check, benches, request)}`, say(check.agree ? "They agree." : "They differ.")];
  const list = check.together.map((both) => Object.values(pair(both, benches)).join(between())).join(say("; "));
  if (list) words.push(say("At the same instant also: {list}.", { list }));
  const caption = make("caption", { textContent: sentencesOf(words) });
  return make("table", {}, caption, make("thead", {}, heads), make("tbody", {}, ...rows));
}

/** The outcome, or "folds" for a dance that folds without a contact. */
const stateOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? "folds" : outcome);

/** The outcome in a few words. answer: of /collision-time */
export function outcomeWords(answer, request) {
  const time = answer.time ?? answer.end?.time;
  const state = stateOf(answer);
  if (state === "clear" && request.drawn && !(Number(request.margin) > 0 || strayOf(request) > 0)) return say("Benches with each other: never touch");
  return sayOf(state, request, { time: time === undefined ? "" : formatNumber(time, 6, 2) });
}

/** The same with its mark, for small screens. */
export const verdictWords = (answer, request) => `${MARKS[stateOf(answer)]} ${outcomeWords(answer, request)}`;

/** Time of the fold [s] if a dance ends in one; else null. */
export const foldOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? end.time : null);

/** An instant of a dance with its usual digits; just before the end it is written as the end. */
export const instantWords = (time, { answer, end }) => formatNumber(time === end && answer.time === null ? (answer.end?.time ?? time) : time, 6, 2);

const methodOf = (certificate) => make("p", { textContent: certificate.method, className: "method" });

/** answer: of /collision-time */
export function showFirstContact(box, answer, request) {
  const { time, certificate } = answer;
  const rows = [];
  const least = certificate.least_clearance;
  if (least) {
    const values = { ...pair(least.benches, request.benches), gap: millimetres(least.clearance), time: least.time.toFixed(6) };
    rows.push([say("Narrowest graze"), sayOf("leastBeforeIs", request, values)]);
  }
  const state = stateOf(answer);
  const mark = make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[state] });
  const evidence = [...(rows.length ? [facts(...rows)] : []), methodOf(certificate), engines(answer.cross_check, request.benches, request)];
  show(box, titleOf("firstContact", request), [mark, outcomeWords(answer, request)], answer.sentences, evidence, { outcome: state, digits: time === null || time === undefined ? "" : `${time.toFixed(6)} s` });
}

/** A button of an answer, with its text and its action. */
const offer = (box, words, act) => box.querySelector("details").before(button({ textContent: say(words) }, act));

/** answer: of /minimum-pitch; use(pitch) sets it; key: of the button's text */
export function showMinimumPitch(box, answer, request, key, use) {
  const benches = Number(request.benches);
  const { scan_step: step, proven_up_to: upTo } = answer;
  const from = bound(answer.proven_from, 9, 1);
  const [low, high] = answer.pitch_bracket;
  const rows = [
    low < high ? bracket(phrase("infeasible at {low} m, feasible at {high} m"), [low, high], 13) : [say("Bracket, rounded outwards"), say("none: at every smaller pitch the dance would begin inside the circle")],
    [say("Every larger pitch"), say(JUSTIFIED[answer.justified_by], { from, step: step === null ? "" : millimetres(step) })],
    [say("Proven for every pitch"), say(upTo === null ? "from {from} m on, without limit" : "from {from} m to {upTo} m", { from, upTo })],
    [say("Runs to the circle that were computed, for single pitches and for bands of pitches"), answer.evaluations],
  ];
  const known = [facts(...rows), engines(answer.cross_check, benches, request)];
  const digits = `${answer.pitch.toFixed(9)} m`;
  show(box, titleOf("minimumPitch", request), isExact() ? digits : `${bound(100 * answer.pitch, 2, 1)} cm`, answer.sentences, known, { digits });
  offer(box, key, () => use(high));
}

/** answer: of /shortest-turn; use(entry, exit) sets both radii of the turn */
export function showShortestTurn(box, answer, request, use) {
  const { entry_radius, exit_radius, length } = answer;
  const known = facts(bracket(phrase("none is shorter than {low} m; this one was danced: {high} m"), answer.length_bracket, 9), bracket(phrase("turns as short enter from {low} m to {high} m from the centre"), answer.entry_bracket, 9), bracket(phrase("and leave from {low} m to {high} m from it"), answer.exit_bracket, 9));
  show(box, titleOf("shortestTurn", request), `${formatNumber(length, 6, 2)} m`, answer.sentences, [known], { digits: `${length.toFixed(6)} m` });
  offer(box, phrase("Dance this turn"), () => use(entry_radius, exit_radius));
}

/** answer: of /quickest-turn; use(entry, exit) sets both radii of the turn */
export function showQuickestTurn(box, answer, use) {
  const { entry_radius, exit_radius, time } = answer;
  show(box, say("Quickest turn"), `${formatNumber(time, 6, 2)} s`, answer.sentences.slice(0, 2), answer.sentences.slice(2).map((one) => paragraph(one)), { digits: `${time.toFixed(6)} s` });
  offer(box, phrase("Dance the quickest turn"), () => use(entry_radius, exit_radius));
}

/** answer: of /turn-time */
export function showTurnTime(box, answer) {
  show(box, say("Time through this turn"), `${formatNumber(answer.time, 6, 2)} s`, answer.sentences, [paragraph(say("The length of both arcs over the maximum speed of the head, which is proven."))], { digits: `${answer.time.toFixed(6)} s` });
}

/** answer: of /maximum-head-speed; use(speed) sets it */
export function showHeadSpeed(box, answer, use) {
  const { head_speed, head_speed_bracket: [low, high] } = answer;
  const known = low === null ? paragraph(say("{high} m/s reaches the limit; no lower speed is proven to keep it.", { high: bound(high, 9, 1) })) : facts(bracket(phrase("{low} m/s keeps the limit, {high} m/s reaches it"), [low, high], 9));
  show(box, say("Maximum head speed"), `${formatNumber(head_speed, 9, 3)} m/s`, answer.sentences, [known], { digits: `${head_speed.toFixed(9)} m/s` });
  offer(box, phrase("Dance at this speed"), () => use(low ?? head_speed));
}

/** answer: of /tolerance */
export function showTolerance(box, answer) {
  const { stray, stray_bracket: [low, high], certificate } = answer;
  const cm = (metres, way) => bound(100 * metres, 7, way);
  const both = high === null ? say("nothing touches up to {low} cm; no pose that overlaps is known", { low: cm(low, -1) }) : say("nothing touches up to {low} cm; a pose with {high} cm overlaps", { low: cm(low, -1), high: cm(high, 1) });
  const rows = [[say("Bracket, rounded outwards"), both]];
  show(box, say("How far people may stray"), `${isExact() ? centimetres(stray) : bound(100 * stray, 1, -1)} cm`, answer.sentences, [facts(...rows), methodOf(certificate)], { digits: `${centimetres(stray)} cm` });
}

/** fastest: highest_speed of /check; null in a run to a fold */
export function showHighestSpeed(box, fastest) {
  if (!fastest) return show(box, say("Highest speed"), say("Grows without bound"), [say("towards the fold, where a bench cannot follow any more")], [paragraph(say("Near a fold, the speed of the handle behind it grows as one over the square root of the remaining way."))]);
  const { speed, speed_bracket, sentences } = fastest;
  const known = speed_bracket[1] === null ? [] : [facts(bracket(phrase("{low} m/s is reached, {high} m/s never exceeded"), speed_bracket, 9))];
  show(box, say("Highest speed"), `${formatNumber(speed, 6, 2)} m/s`, sentences, known, { digits: `${speed.toFixed(6)} m/s` });
}

/** begin, time: of the dance [s] */
export function showEnd(box, answer, { begin, end: time }, request) {
  const reason = answer.end?.reason ?? { undecided: "undecided", clear: "turn" }[answer.outcome] ?? "contact";
  const words = reason === "contact" ? sayOf("end_contact", request) : reason === "fold" ? answer.sentences.at(-1) : say(ENDS[reason]);
  const last = answer.end?.time ?? time;
  show(box, say("End of the run"), `${formatNumber(last, 6, 2)} s`, [words, ...(request.drawn && Math.abs(begin) >= SHOWN ? [say("Times count from 0 s; the dance begins at {begin} s.", { begin: formatNumber(begin, 6, 2) })] : [])], [paragraph(say("From the same search as the answer above."))], { digits: `${last.toFixed(6)} s` });
}

/** problem: the service's problem; null if it is shown elsewhere; names: of the fields beside which it is shown */
export function showRefusal(box, title, problem, names) {
  show(box, say(title), say("No answer"), []);
  box.append(paragraph(problem?.sentence ?? (names.length ? mendWords(names) : say("See the reason above."))));
}

/** What is to be mended before there is an answer. names: of fields */
export const mendWords = (names) => say("An answer appears as soon as {names} is right.", { names: [...new Set(names)].map((name) => say("“{name}”", { name: say(LABELS[name]) })).join(say(" and ")) });

/** The caption of the enlarged view. gap: [m] between the two benches, null while unknown */
export function insetWords({ benches: [a, b], corner, edge }, gap, request) {
  const name = (bench) => benchName(bench, request.benches);
  const meet = () => sayOf("insetMeet", request, { corner: say(PLACES[corner.name]), a: name(corner.bench), edge: say(PLACES[edge.name]), b: name(edge.bench) });
  const words = corner && edge ? meet() : [a, b].map(name).join(between());
  return gap === null ? words : `${words}${say("; ")}${gapWords(gap)}`;
}
