/** The service's refusals in sentences for people: with the labels and the units of the page, in both languages. */

import { FIELDS } from "./state.js";
import { PLACES, REASONS, RULES, WHOLE, WORDS } from "./words/refusals.js";

/** Names in tables of benches and of passages: the key of their words. */
const NAMES = { length: "csvLength", speed: "passageSpeed", until_s: "passagePlace", until_time: "passageTime" };
const UNITS = { m: "metres", cm: "centimetres", "m/s": "metres per second", s: "seconds", turns: "turns", rad: "radians" };
/** An example of a number in each unit, for fields without a default. */
const EXAMPLES = { m: "0.55", cm: "2", "m/s": "1.5", s: "300", turns: "16" };
/** Advice for clients of the service, which the page leaves out. */
export const FOR_CLIENTS = /\.? Ask for it as a job, which may take longer: .*$/s;

const fieldOf = (name) => FIELDS.find((field) => field.name === name);
const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);
const bench = (k, say) => (Number(k) ? say("body", { k }) : say("theHead"));

/** A text with the groups of a pattern filled in. */
function filled(text, found, say) {
  return text.replace(/\{(\d)(\+1|[bwur])?\}/g, (_, k, how) => {
    const word = found[k];
    if (how === "+1") return Number(word) + 1;
    if (how === "r") return Number(Number(word).toFixed(3));
    if (how === "b") return bench(word, say);
    if (how === "u") return word ? `（单位 ${Object.keys(UNITS).find((unit) => UNITS[unit] === word)}），例如 ${found[2]}` : "";
    return how === "w" ? (WORDS[word] ?? word) : word;
  });
}

/** The text of the first matching pattern, from a column of the table; null without one. */
function told(table, words, column, say) {
  const row = table.find(([pattern]) => pattern.test(words));
  return row?.[column] ? filled(row[column], row[0].exec(words), say) : null;
}

/** Benches by their names on the page. */
const named = (words, say) =>
  words.replace(/\bbenches (\d+) and (\d+)\b/g, (_, a, b) => `${bench(a, say)} and ${bench(b, say)}`).replace(/\bbench (\d+)\b/g, (_, k) => bench(k, say));

/** The given value, without the quotes of JSON. */
function given(value, rule, chinese) {
  if (['""', "null", "None"].includes(value)) return chinese ? "现在为空" : "it is empty";
  const typed = /^"(.*)"$/.exec(value);
  if (chinese) return typed ? `现为“${typed[1]}”` : `现为 ${value}`;
  return typed ? `you typed “${typed[1]}”` : `it ${rule.startsWith("have") ? "has" : "is"} ${value}`;
}

/** Lengths in centimetres, if the page uses them for this number. */
const inCentimetres = (words) => words.replace(/(-?\d[\d.e+-]*) m\b/g, (_, metres) => `${Number((100 * metres).toPrecision(12))} cm`).replace("[m]", "[cm]");

/** Names of fields on the page. */
function labelled(detail, chinese, say) {
  const [pattern, english, other] = PLACES.find(([pattern]) => pattern.test(detail)) ?? [];
  if (pattern) return detail.replace(pattern, filled(chinese ? other : english, pattern.exec(detail), say));
  const label = (name) => (fieldOf(name) || NAMES[name] ? `“${say(NAMES[name] ?? name)}”` : name);
  return detail
    .replace(/^(?:dragon\.|path\.|passages\[\d+\]\.)?(\w+)/, (_, name) => label(name))
    .replace(/\b(?:dragon\.|path\.)?([a-z]+_[a-z]+)\b/g, (_, name) => label(name));
}

/** The rule of a refusal with a unit in words and an example. */
function asked(rule, field) {
  const { value, centimetres } = field ?? {};
  const example = centimetres ? EXAMPLES.cm : Number(value) && value;
  return rule
    .replace(/^be a(?: finite)? number \[(.+)\]$/, (_, unit) => `be a number of ${UNITS[unit] ?? unit}, such as ${example || (EXAMPLES[unit] ?? 1)}`)
    .replace(/^be a whole number$/, example ? `be a whole number, such as ${example}` : "$&");
}

/**
 * A refusal as text and its language. detail: the service's message; chinese: true for Chinese;
 * say(name): the label of a field
 */
export function refusalIn(detail, chinese, say) {
  const [, line, inLine] = /^csv: line (\d+): (.+)$/s.exec(detail) ?? [];
  if (line) {
    const { textContent, lang } = refusalIn(inLine.replace(/^must/, "it must"), chinese, say);
    return { textContent: say("csvLine", { line, words: textContent }), lang };
  }
  const lang = chinese ? "zh-Hans" : "en";
  const stop = chinese ? "。" : ".";
  const plain = detail.replace(FOR_CLIENTS, "").replace(/ \(and \d+ more\)$/, "");
  const whole = told(WHOLE, plain, chinese ? 2 : 1, say);
  if (whole) return { textContent: whole + stop, lang };
  const field = fieldOf(/^(?:dragon\.|path\.)?(\w+)/.exec(plain)?.[1]);
  const words = labelled(plain, chinese, say);
  const [, name, must, value, reason] = /^(“.+?”|\w+|.+?) must (.+?)(?:, got ("(?:[^"]*)"|[^:]+?))?(?:: (.+?))?$/.exec(words) ?? [];
  const unknown = { textContent: chinese ? `服务的答复：${words}` : named(words, say).replace(/\.?$/, "."), lang };
  if (!name) return unknown;
  const [rule, got] = [asked(field?.centimetres ? inCentimetres(must) : must, field), field?.centimetres && value ? inCentimetres(value) : value];
  const why = field?.centimetres && /^(?:lengths|[\d.e+]+ cm)/.test(reason) ? "" : reason;
  if (!chinese) {
    const sentences = [`${name} must ${rule}${got ? `; ${given(got, rule, false)}` : ""}.`, why && `${capital(named(why, say)).replace(/\.$/, "")}.`];
    return { textContent: sentences.filter(Boolean).map((one) => named(one, say)).join(" "), lang };
  }
  const known = told(RULES, rule, 1, say);
  if (!known) return unknown;
  const because = why ? `（${told(REASONS, why, 1, say) ?? why}）` : "";
  return { textContent: `${name}${known}${got ? `，${given(got, rule, true)}` : ""}`.replace(/ turns\b/g, " 圈").replace(/ degrees\b/g, "°") + `${because}。`, lang };
}
