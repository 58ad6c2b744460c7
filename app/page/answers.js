/** The answers, each with its evidence, in the words of the service. */

import { button, make } from "./elements.js";
import { LABELS } from "./fields.js";
import { fixed, formatNumber, isExact } from "./numbers.js";
import { language, say } from "./text.js";

/** The mark of each outcome: a dance fails with a contact or a fold, passes, or is undecided. */
const MARKS = { contact: "✕", contact_at_start: "✕", folds: "!", clear: "✓", undecided: "?" };

const paragraph = (textContent, more) => make("p", { textContent, ...more });
/** A separation in words: the gap, or for a negative one the depth of the overlap. metres: [m] */
export function gapWords(metres) {
  const gap = fixed(1000 * metres, 3);
  return gap.startsWith("-") ? say("overlap by {depth} mm", { depth: gap.slice(1) }) : say("gap {gap} mm", { gap });
}

/** The section of the page "How it works" that explains the answer in a box. */
const IDEAS = { "minimum-pitch": "staircase", tolerance: "stray", "head-speed": "speed", "turn-time": "speed", "highest-speed": "speed", "shortest-turn": "turn", "quickest-turn": "turn", "run-end": "chord" };
const idea = ({ id }) => make("a", { href: `how?lang=${language()}#${IDEAS[id] ?? "step"}`, textContent: say("How it works") });

/** The answer in a few words, with the digits that are wanted. words: of the answer */
export const headlineOf = ({ headline, exact }) => (isExact() ? exact : headline);

/** Rows of a table of the service; the first one are its heads. */
function engines({ caption, rows }) {
  const row = (texts, isHead) => make("tr", {}, ...texts.map((textContent, k) => make(isHead || !k ? "th" : "td", { textContent, ...(isHead ? { scope: "col" } : !k && { scope: "row" }) })));
  const [heads, ...others] = rows;
  return make("table", {}, make("caption", { textContent: caption }), make("thead", {}, row(heads, true)), make("tbody", {}, ...others.map((texts) => row(texts, false))));
}

/**
 * Replace the content of a box, but keep its details open. words: of the answer; sentences: below its value; offer: [the text of its
 * button, what that does]; outcome: colours the box
 */
export function show(box, { words, sentences, certificate = null }, offer = null, outcome = "") {
  const open = box.querySelector("details")?.open ?? false;
  const { title, headline, exact, facts = [], notes = [], engines: judged } = words;
  const rows = headline === exact || isExact() ? facts : [[say("More digits"), exact], ...facts];
  const list = rows.length ? [make("dl", {}, ...rows.flatMap(([name, text]) => [make("dt", { textContent: name }), make("dd", { textContent: text })]))] : [];
  const known = [...list, ...[...(certificate ? [certificate.method] : []), ...notes].map((note) => paragraph(note, { className: "method" })), ...(judged ? [engines(judged)] : [])];
  const details = known.length ? [make("details", { open }, make("summary", { textContent: say("How it is known") }), ...known, idea(box))] : [];
  box.dataset.outcome = outcome;
  const mark = outcome ? [make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[outcome] })] : [];
  const value = make("p", { className: "value" }, ...mark, headlineOf(words));
  box.replaceChildren(paragraph(say("Older than your numbers"), { className: "old" }), make("h3", { textContent: title }), value, ...sentences.map((line) => paragraph(line)), ...(offer ? [button({ textContent: say(offer[0]) }, offer[1])] : []), ...details);
}

/** The outcome, or "folds" for a dance that folds without a contact. */
const stateOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? "folds" : outcome);

/** The outcome with its mark, for small screens. answer: of /collision-time */
export const verdictWords = (answer) => `${MARKS[stateOf(answer)]} ${headlineOf(answer.words)}`;

/** Time of the fold [s] if a dance ends in one; else null. */
export const foldOf = ({ outcome, end }) => (outcome === "clear" && end?.reason === "fold" ? end.time : null);

/** An instant of a dance with its usual digits; just before the end it is written as the end. */
export const instantWords = (time, { answer, end }) => formatNumber(time === end && answer.time === null ? (answer.end?.time ?? time) : time, 6, 2);

/** answer: of /collision-time */
export const showFirstContact = (box, answer) => show(box, answer, null, stateOf(answer));

/** answer: of /check; a run to a fold has no highest speed */
export function showHighestSpeed(box, { highest_speed: fastest, first_contact: { words } }) {
  show(box, fastest ?? { words: words.fold, sentences: words.fold.sentences });
}

/** The end of a dance. */
export function showEnd(box, { answer, kind, end }) {
  const last = answer.end?.time ?? end;
  const [headline, exact] = [2, 6].map((decimals) => `${fixed(last, decimals)} s`);
  const isCut = kind === "turn" && answer.outcome === "clear";
  const sentences = isCut ? [say("The dance is shown from 100 m before the turn begins to 100 m after.")] : answer.words.ends;
  show(box, { words: { title: say("End of the run"), headline, exact, notes: [say("From the same search as the answer above.")] }, sentences });
}

/** title: of the answer; problem: the service's problem; null if it is shown elsewhere; names: of the fields beside which it is shown */
export function showRefusal(box, title, problem, names) {
  const none = say("No answer");
  const why = problem?.sentence ?? (names.length ? mendWords(names) : say("See the reason above."));
  show(box, { words: { title: say(title), headline: none, exact: none }, sentences: [why] });
}

/** What is to be mended before there is an answer. names: of fields */
export const mendWords = (names) => say("An answer appears as soon as {names} is right.", { names: [...new Set(names)].map((name) => say("“{name}”", { name: say(LABELS[name]) })).join(say(" and ")) });
