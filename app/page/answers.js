/** The answers, and for each how it is known. */

import { make } from "./controls.js";
import { handleName, say } from "./text.js";

const MARKS = { contact: "✕", contact_at_start: "✕", clear: "✓", undecided: "?" };
/** Metres in millimetres; what rounds to zero has no sign. */
export const millimetres = (metres) => (1000 * metres).toFixed(3).replace(/^-(0\.0+)$/, "$1");
const pair = ([a, b], benches) => ({ a: handleName(a, benches), b: handleName(b, benches) });

/** Replace what a box shows, but keep its details open. */
function show(box, title, value, lines, known, outcome = "") {
  const open = box.querySelector("details")?.open ?? false;
  const summary = make("summary", { textContent: say("how") });
  const details = known.length ? [make("details", { open }, summary, ...known)] : [];
  box.dataset.outcome = outcome;
  const paragraphs = lines.map((line) => (typeof line === "string" ? make("p", { textContent: line }) : line));
  const heading = make("h3", { textContent: title });
  box.replaceChildren(heading, make("p", { className: "value" }, value), ...paragraphs, ...details);
}

function facts(rows) {
  const list = make("dl");
  for (const [term, text] of rows) list.append(make("dt", { textContent: term }), make("dd", { textContent: text }));
  return list;
}

function engines(check) {
  if (!check) return [make("p", { textContent: say("noEngines") })];
  const cell = (overlaps) => make("td", { textContent: say(overlaps ? "overlapping" : "apart") });
  const head = (key, scope) => make("th", { scope, textContent: say(key) });
  const rows = Object.entries(check.engines).map(([name, { before, after }]) =>
    make("tr", {}, head(name, "row"), cell(before), cell(after)),
  );
  const heads = make("tr", {}, ...["engine", "before", "after"].map((key) => head(key, "col")));
  const caption = make("caption", { textContent: `${say("engines")}. ${say(check.agree ? "agree" : "disagree")}` });
  return [make("table", {}, caption, make("thead", {}, heads), make("tbody", {}, ...rows))];
}

/** answer: of /collision-time */
export function showFirstContact(box, answer, { benches, margin }) {
  const { outcome, time, certificate } = answer;
  const lines = [];
  if (outcome.startsWith("contact")) {
    const [x, y] = answer.point.map((one) => one.toFixed(6));
    lines.push(say("pairMeets", { ...pair(answer.benches, benches), x, y, radius: answer.head.radius.toFixed(6) }));
  } else if (outcome === "clear") {
    lines.push(answer.end ? say("clearUntil", { time: answer.end.time.toFixed(6) }) : say("clearAll"));
  } else lines.push(say("undecidedFrom", { time: answer.time_bracket[0].toFixed(9) }));
  if (margin > 0) lines.push(say("nearMargin", { margin }));
  const rows = [];
  if (answer.time_bracket) {
    const [low, high] = answer.time_bracket.map((one) => one.toFixed(10));
    rows.push([say("bracket"), say("bracketTime", { low, high })]);
  }
  const proven = { steps: certificate.steps, until: certificate.clear_until.toFixed(10) };
  rows.push([say("certificate"), say("certificateSteps", proven)]);
  const least = certificate.least_clearance;
  if (least) {
    const values = { ...pair(least.benches, benches), gap: millimetres(least.clearance), time: least.time.toFixed(6) };
    rows.push([say("leastBefore"), say("leastBeforeIs", values)]);
  }
  const method = make("p", { lang: "en", className: "method", textContent: certificate.method });
  const mark = make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[outcome] });
  const value = make("span", {}, mark, say(outcome, { time: time?.toFixed(6) }));
  show(box, say("firstContact"), value, lines, [facts(rows), method, ...engines(answer.cross_check)], outcome);
}

/** answer: of /minimum-pitch; use(pitch) sets it */
export function showMinimumPitch(box, answer, { benches, diameter }, use) {
  const lines = [say("toCircle", { diameter })];
  const names = answer.benches ? pair(answer.benches, benches) : {};
  lines.push(say(`limited_${answer.limited_by}`, { ...names, radius: answer.head_radius?.toFixed(6) }));
  const islands = answer.other_feasible_intervals.map(([low, high]) => `${low.toFixed(6)}–${high.toFixed(6)} m`);
  if (islands.length) lines.push(say("islands", { list: islands.join(", ") }));
  const button = make("button", { type: "button", textContent: say("usePitch") });
  button.addEventListener("click", () => use(answer.pitch_bracket[1]));
  const [low, high] = answer.pitch_bracket.map((one) => one.toFixed(10));
  const rows = [
    [say("bracket"), say("bracketPitch", { low, high })],
    [say("justified"), say(`justified_${answer.justified_by}`)],
    [say("evaluations"), answer.evaluations],
  ];
  const known = [facts(rows), ...engines(answer.cross_check)];
  show(box, say("minimumPitch"), `${answer.pitch.toFixed(9)} m`, [...lines, button], known);
}

/** table: a trajectory at evenly spaced instants over the whole dance, which ends as answer says */
export function showHighestSpeed(box, table, { end }, { benches, head_speed }) {
  let best = { speed: -1 };
  table.speed.forEach((row, k) =>
    row.forEach((speed, handle) => {
      if (speed > best.speed) best = { speed, handle, time: table.time[k] };
    }),
  );
  const words = { name: handleName(best.handle, benches), speed: best.speed.toFixed(1), time: best.time.toFixed(3) };
  const folds = end?.reason === "fold" && best.speed > head_speed;
  const whose = say(folds ? "towardsFold" : best.handle ? "whose" : "headFastest", words);
  const known = make("p", { textContent: say(folds ? "foldKnown" : "speedKnown", { count: table.time.length }) });
  show(box, say("highest"), folds ? say("unbounded") : `${best.speed.toFixed(6)} m/s`, [whose], [known]);
}

/** fastest: the proven highest speed of /check */
export function showProvenSpeed(box, { speed, speed_bracket: [low, high], time, handles }, { benches }) {
  const names = handles.map((handle) => handleName(handle, benches)).join(", ");
  const rows = [[say("bracket"), say("bracketSpeed", { low: low.toFixed(9), high: high.toFixed(9) })]];
  show(box, say("highest"), `${speed.toFixed(6)} m/s`, [say("whose", { name: names, time: time.toFixed(6) })], [facts(rows)]);
}

export function showEnd(box, answer, time) {
  const reason = answer.end?.reason ?? { undecided: "undecided", clear: "turn" }[answer.outcome] ?? "contact";
  show(box, say("end"), `${time.toFixed(6)} s`, [say(`end_${reason}`)], [make("p", { textContent: say("endKnown") })]);
}

export function showRefusal(box, title, words) {
  show(box, say(title), say("unanswered"), [words], []);
}

/** What stands under the enlarged view. gap: [m] between the two benches, null while unknown */
export function insetWords({ benches: [a, b], corner, edge }, gap, benches) {
  const name = (bench) => handleName(bench, benches);
  const words =
    corner && edge
      ? say("insetMeet", { corner: say(corner.name), a: name(corner.bench), edge: say(edge.name), b: name(edge.bench) })
      : `${name(a)}, ${name(b)}`;
  return gap === null ? words : `${words}; ${say("gap", { gap: millimetres(gap) })}`;
}
