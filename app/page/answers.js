/** The answers, each with its evidence. */

import { button, make } from "./elements.js";
import { strayOf } from "./fields.js";
import { bound, fixed, formatNumber, isExact } from "./numbers.js";
import { benchName, handleName, refusalWords, say, sayOf, sentencesOf, titleOf } from "./text.js";

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
  return gap.startsWith("-") ? say("overlap", { depth: gap.slice(1) }) : say("gap", { gap });
}

/** A safe stray in centimetres, rounded down. metres: [m] */
export const centimetres = (metres) => bound(100 * metres, 2, -1);
const ends = ([low, high], decimals) => ({ low: bound(low, decimals, -1), high: bound(high, decimals, 1) });
const bracket = (key, both, decimals) => [say("bracket"), say(key, ends(both, decimals))];

/** The section of the page "How it works" that explains the answer in a box. */
const IDEAS = { "minimum-pitch": "staircase", tolerance: "stray", "head-speed": "chord", "turn-time": "chord", "highest-speed": "chord", "run-end": "chord" };
const idea = ({ id }) => make("a", { href: `how?lang=${document.documentElement.lang.slice(0, 2)}#${IDEAS[id] ?? "step"}`, textContent: say("howPage") });

/**
 * Replace the content of a box, but keep its details open. title: text; known: elements; outcome: colours the box; digits: the value
 * with all of its digits, if the shown one may have fewer
 */
function show(box, title, value, lines, known = [], { outcome = "", digits = "" } = {}) {
  const open = box.querySelector("details")?.open ?? false;
  const details = known.length ? [make("details", { open }, make("summary", { textContent: say("how") }), ...(digits && !isExact() ? [facts([say("allDigits"), digits])] : []), ...known, idea(box))] : [];
  box.dataset.outcome = outcome;
  const heading = make("h3", { textContent: title });
  box.replaceChildren(paragraph(say("old"), { className: "old" }), heading, make("p", { className: "value" }, ...[value].flat()), ...lines.map((line) => paragraph(line)), ...details);
}

const facts = (...rows) => make("dl", {}, ...rows.flatMap((row) => ["dt", "dd"].map((tag, k) => make(tag, { textContent: row[k] }))));

/** The benches that the engines judged, in words. benches: of the dragon */
function judgedWords({ judged }, benches, request) {
  const count = judged.length;
  if (count === benches) return sayOf("judgedAll", request, { count });
  return count === 2 ? sayOf("judgedPair", request, pair(judged, benches)) : say("judgedNear", { count, benches });
}

function engines(check, benches, request) {
  if (!check) return paragraph(say("noEngines"));
  const word = (overlaps) => (overlaps === null ? say("noBefore") : sayOf(overlaps ? "overlapping" : "apart", request));
  const cell = (overlaps) => make("td", { textContent: word(overlaps) });
  const head = (key, scope) => make("th", { scope, textContent: say(key) });
  const rows = Object.entries(check.engines).map(([name, { before, after }]) => make("tr", {}, head(name, "row"), cell(before), cell(after)));
  const heads = make("tr", {}, ...["engine", "before", "after"].map((key) => head(key, "col")));
  const grounds = rows.length === 1 && say("judgedGrounds", { count: check.judged.length });
  const words = [grounds || `${say("engines", { count: rows.length })}${judgedWords(check, benches, request)}`, say(check.agree ? "agree" : "disagree")];
  const list = check.together.map((both) => Object.values(pair(both, benches)).join(say("listed"))).join(say("semicolon"));
  if (list) words.push(say("together", { list }));
  const caption = make("caption", { textContent: sentencesOf(words) });
  return make("table", {}, caption, make("thead", {}, heads), make("tbody", {}, ...rows));
}

/** The outcome, or "folds" for a dance that folds without a contact. */
const stateOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? "folds" : outcome);

/** The outcome in a few words. answer: of /collision-time */
export function outcomeWords(answer, request) {
  const time = answer.time ?? answer.end?.time;
  const state = stateOf(answer);
  if (state === "clear" && request.drawn && !(Number(request.margin) > 0 || strayOf(request) > 0)) return say("clearDrawn");
  return sayOf(state, request, { time: time === undefined ? "" : formatNumber(time, 6, 2) });
}

/** The same with its mark, for small screens. */
export const verdictWords = (answer, request) => `${MARKS[stateOf(answer)]} ${outcomeWords(answer, request)}`;

/** Time of the fold [s] if a dance ends in one; else null. */
export const foldOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? end.time : null);

/** An instant of a dance with its usual digits; just before the end it is written as the end. */
export const instantWords = (time, { answer, end }) => formatNumber(time === end && answer.time === null ? (answer.end?.time ?? time) : time, 6, 2);

function contactLine(answer, request) {
  const { time_bracket, overlapping: met, point, benches: both, head, end, gap } = answer;
  const { benches } = request;
  const state = stateOf(answer);
  if (state === "undecided") {
    const [time, late] = [bound(time_bracket[0], 9, -1), bound(time_bracket[1], 9, 1)];
    return met ? sayOf("undecidedMet", request, { ...pair(met, benches), time, late }) : say("undecidedFrom", { time });
  }
  if (state === "folds") return sayOf("foldsUntil", request, { name: benchName(end.bench, benches) });
  if (state === "clear" && end && request.drawn) return sayOf("clearToEnd", request);
  if (state === "clear") return end ? sayOf("clearUntil", request, { time: formatNumber(end.time, 6, 2) }) : sayOf("clearAll", request);
  const [x, y, radius] = [...point, head.radius].map((one) => formatNumber(one, 6, 2));
  const values = { ...pair(both, benches), x, y, radius };
  if (request.drawn) return sayOf("pairDrawn", request, values);
  const millis = millimetres(gap);
  if (millis.startsWith("-")) return say("pairOverlaps", { ...values, depth: millis.slice(1) });
  return sayOf("pairMeets", request, { ...values, gap: millis });
}

/** The time up to which it is proven that nothing touches; none for a contact at the start, or an undecided search. */
function certificateWords({ outcome, certificate: { steps, clear_until: until } }, request) {
  if (until !== null) return sayOf("certificateSteps", request, { steps, until: bound(until, 10, -1) });
  return outcome === "undecided" ? say("certificateNone") : sayOf("certificateStart", request);
}

const methodOf = (certificate) => make("p", { textContent: certificate.method, className: "method" });

/** answer: of /collision-time */
export function showFirstContact(box, answer, request) {
  const { time, time_bracket, certificate } = answer;
  const lines = [contactLine(answer, request)];
  const open = answer.outcome === "undecided" && !answer.overlapping;
  const known = (values) => (open ? say("bracketOpen", values) : sayOf("bracketTime", request, values));
  const rows = time_bracket ? [[say("bracket"), known(ends(time_bracket, 10))]] : [];
  rows.push([say("certificate"), certificateWords(answer, request)]);
  const least = certificate.least_clearance;
  if (least) {
    const values = { ...pair(least.benches, request.benches), gap: millimetres(least.clearance), time: least.time.toFixed(6) };
    rows.push([say("leastBefore"), sayOf("leastBeforeIs", request, values)]);
  }
  const state = stateOf(answer);
  const mark = make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[state] });
  const evidence = [facts(...rows), methodOf(certificate), engines(answer.cross_check, request.benches, request)];
  show(box, titleOf("firstContact", request), [mark, outcomeWords(answer, request)], lines, evidence, { outcome: state, digits: time === null || time === undefined ? "" : `${time.toFixed(6)} s` });
}

/** A button of an answer, with its text and its action. */
const offer = (box, key, act) => box.querySelector("details").before(button({ textContent: say(key) }, act));

/** answer: of /minimum-pitch; use(pitch) sets it; key: of the button's text */
export function showMinimumPitch(box, answer, request, key, use) {
  const [benches, diameter] = [Number(request.benches), request.turning_diameter];
  const names = answer.benches ? pair(answer.benches, benches) : {};
  const name = answer.bench === null ? "" : benchName(answer.bench, benches);
  const limit = sayOf(`limited_${answer.limited_by}`, request, { ...names, name, radius: answer.head_radius?.toFixed(6) });
  const { scan_step: step, proven_up_to: upTo } = answer;
  const all = step === null && upTo === null;
  const from = bound(answer.proven_from, 9, 1);
  const pitches = say(all ? "larger" : "largerTried");
  const lines = [sayOf("toCircle", request, { diameter, pitches }), limit];
  const islands = answer.other_feasible_intervals.map(([low, high]) => `${low.toFixed(6)}–${high.toFixed(6)} m`);
  if (islands.length) lines.push(say("islands", { list: islands.join(say("listed")) }));
  const [low, high] = answer.pitch_bracket;
  const rows = [
    low < high ? bracket("bracketPitch", [low, high], 13) : [say("bracket"), say("bracketNone")],
    [say("justified"), say(`justified_${answer.justified_by}`, { from, step: step === null ? "" : millimetres(step) })],
    [say("proven"), say(upTo === null ? "provenToAll" : "provenTo", { from, upTo })],
    [say("evaluations"), answer.evaluations],
  ];
  const known = [facts(...rows), engines(answer.cross_check, benches, request)];
  const digits = `${answer.pitch.toFixed(9)} m`;
  show(box, titleOf("minimumPitch", request), isExact() ? digits : `${bound(100 * answer.pitch, 2, 1)} cm`, lines, known, { digits });
  offer(box, key, () => use(high));
}

/** answer: of /shortest-turn; use(entry, exit) sets both radii of the turn */
export function showShortestTurn(box, answer, request, use) {
  const { entry_radius, exit_radius, length, limited_by } = answer;
  const lines = [say("turnIs", { entry: entry_radius.toFixed(6), exit: exit_radius.toFixed(6) }), sayOf(`entry_${limited_by}`, request)];
  const known = facts(bracket("bracketLength", answer.length_bracket, 9), bracket("bracketEntry", answer.entry_bracket, 9), bracket("bracketExit", answer.exit_bracket, 9));
  show(box, titleOf("shortestTurn", request), `${formatNumber(length, 6, 2)} m`, lines, [known], { digits: `${length.toFixed(6)} m` });
  offer(box, "useEntry", () => use(entry_radius, exit_radius));
}

const timeWords = ({ length, head_speed }, { speed_limit: limit }) => say("turnTimeIs", { length: length.toFixed(6), speed: head_speed.toFixed(6), limit });

/** answer: of /quickest-turn; use(entry, exit) sets both radii of the turn */
export function showQuickestTurn(box, answer, request, use) {
  const { entry_radius, exit_radius, time, scan_step } = answer;
  const lines = [timeWords(answer, request), say("quickestIs", { entry: entry_radius.toFixed(6), exit: exit_radius.toFixed(6) })];
  show(box, say("quickestTurn"), `${formatNumber(time, 6, 2)} s`, lines, [paragraph(say("quickestKnown", { step: centimetres(scan_step) }))], { digits: `${time.toFixed(6)} s` });
  offer(box, "useQuickest", () => use(entry_radius, exit_radius));
}

/** answer: of /turn-time */
export function showTurnTime(box, answer, request) {
  show(box, say("turnTime"), `${formatNumber(answer.time, 6, 2)} s`, [timeWords(answer, request)], [paragraph(say("turnTimeKnown"))], { digits: `${answer.time.toFixed(6)} s` });
}

/** answer: of /maximum-head-speed; use(speed) sets it */
export function showHeadSpeed(box, answer, request, use) {
  const { head_speed, head_speed_bracket: [low, high], handles, time } = answer;
  const name = handles.map((handle) => handleName(handle, Number(request.benches))).join(say("listed"));
  const lines = [say("headSpeedIs", { limit: request.speed_limit, name, time: time.toFixed(6) })];
  const known = low === null ? paragraph(say("headSpeedOpen", { high: bound(high, 9, 1) })) : facts(bracket("bracketHeadSpeed", [low, high], 9));
  show(box, say("headSpeed"), `${formatNumber(head_speed, 9, 3)} m/s`, lines, [known], { digits: `${head_speed.toFixed(9)} m/s` });
  offer(box, "useSpeed", () => use(low ?? head_speed));
}

/** answer: of /tolerance on the way to a circle of this diameter [m]; without one, in the shown part of a turn */
export function showTolerance(box, answer, benches, diameter) {
  const { stray, stray_bracket: [low, high], limited_by: limit, time, certificate } = answer;
  const values = { ...(answer.benches && pair(answer.benches, benches)), time: time?.toFixed(6), area: answer.area };
  const safe = stray > 0 ? say(diameter ? "toleranceCircle" : "toleranceTurn", { diameter, stray: centimetres(stray) }) : "";
  const lines = stray > 0 ? [safe, say(`tolerance_${limit}`, values)] : [say(high === null ? "toleranceNone" : limit === "venue" ? "tolerance_touchingVenue" : "tolerance_touching", values)];
  const cm = (metres, way) => bound(100 * metres, 7, way);
  const both = high === null ? say("bracketStrayOpen", { low: cm(low, -1) }) : say("bracketStray", { low: cm(low, -1), high: cm(high, 1) });
  const rows = [[say("bracket"), both], [say("certificate"), say("stepsTaken", { steps: certificate.steps })]];
  show(box, say("tolerance"), `${isExact() ? centimetres(stray) : bound(100 * stray, 1, -1)} cm`, lines, [facts(...rows), methodOf(certificate)], { digits: `${centimetres(stray)} cm` });
}

/** fastest: highest_speed of /check; null in a run to a fold */
export function showHighestSpeed(box, fastest, { benches }) {
  if (!fastest) return show(box, say("highest"), say("unbounded"), [say("towardsFold")], [paragraph(say("foldKnown"))]);
  const { speed, speed_bracket, time, handles } = fastest;
  const name = handles.map((handle) => handleName(handle, benches)).join(say("listed"));
  const whose = handles.includes(0) ? say("headFastest") : say("whose", { name, time: time.toFixed(6) });
  const known = speed_bracket[1] === null ? [] : [facts(bracket("bracketSpeed", speed_bracket, 9))];
  show(box, say("highest"), `${formatNumber(speed, 6, 2)} m/s`, [whose], known, { digits: `${speed.toFixed(6)} m/s` });
}

/** begin, time: of the dance [s] */
export function showEnd(box, answer, { begin, end: time }, request) {
  const reason = answer.end?.reason ?? { undecided: "undecided", clear: "turn" }[answer.outcome] ?? "contact";
  const name = reason === "fold" ? benchName(answer.end.bench, request.benches) : "";
  const words = reason === "contact" ? sayOf("end_contact", request) : say(`end_${reason}`, { name });
  const last = answer.end?.time ?? time;
  show(box, say("end"), `${formatNumber(last, 6, 2)} s`, [words, ...(request.drawn && Math.abs(begin) >= SHOWN ? [say("endBegins", { begin: formatNumber(begin, 6, 2) })] : [])], [paragraph(say("endKnown"))], { digits: `${last.toFixed(6)} s` });
}

/** problem: the service's problem; null if it is shown elsewhere; names: of the fields beside which it is shown */
export function showRefusal(box, title, problem, names) {
  show(box, say(title), say("unanswered"), []);
  if (problem) box.append(make("p", refusalWords(problem)));
  else box.append(paragraph(names.length ? mendWords(names) : say("seeAbove")));
}

/** What is to be mended before there is an answer. names: of fields */
export const mendWords = (names) => say("mend", { names: [...new Set(names)].map((name) => say("quoted", { name: say(name) })).join(say("and")) });

/** The caption of the enlarged view. gap: [m] between the two benches, null while unknown */
export function insetWords({ benches: [a, b], corner, edge }, gap, request) {
  const name = (bench) => benchName(bench, request.benches);
  const meet = () => sayOf("insetMeet", request, { corner: say(corner.name), a: name(corner.bench), edge: say(edge.name), b: name(edge.bench) });
  const words = corner && edge ? meet() : [a, b].map(name).join(say("listed"));
  return gap === null ? words : `${words}${say("semicolon")}${gapWords(gap)}`;
}
