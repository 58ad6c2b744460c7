/** The service's refusals in sentences for people: with the labels and the units of the page, in both languages. */

import { FIELDS } from "./state.js";
import { PLACES, REASONS, RULES, WHOLE } from "./words/refusals.js";

/** Names in tables of benches and of passages: the key of their words. */
const NAMES = { length: "csvLength", speed: "passageSpeed", until_s: "passagePlace", until_time: "passageTime" };
const UNITS = { m: "metres", cm: "centimetres", "m/s": "metres per second", s: "seconds", turns: "turns", rad: "radians" };
const CHINESE = { turns: " 圈", degrees: "°" };
/** An example of a number in each unit, for fields without a default. */
const EXAMPLES = { m: "0.55", cm: "2", "m/s": "1.5", s: "300", turns: "16" };
/** Words in templates that stand for numbers of benches. */
const BENCHES = ["bench", "a", "b", "between"];
const FIELD = "{field} ";
const TABLE = "{table}: ";
const IN_LINE = `${TABLE}line {line}: `;

const fieldOf = (name) => FIELDS.find((field) => field.name === name);
const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);

/** The last name in a dotted name that is no number. */
const lastOf = (name) => name.split(".").findLast((part) => Number.isNaN(Number(part)));

/**
 * A refusal as text and its language. told: the service's problem or one of its errors: {detail, template, got, reason,
 * values, pointer}; chinese: true for Chinese; say(name): the label of a field
 */
export function refusalIn(told, chinese, say) {
  const { template, got, reason, values = {}, pointer } = told;
  const lang = chinese ? "zh-Hans" : "en";
  const column = chinese ? 1 : 0;
  const parameter = values.field?.parameter ?? "";
  const field = fieldOf(lastOf(parameter));
  const unit = field?.centimetres ? "cm" : values.unit?.text;

  /** A number as the page shows it. */
  function shown({ text, value, unit }) {
    if (unit === "m" && field?.centimetres) return `${Number((100 * value).toPrecision(12))} cm`;
    return chinese && CHINESE[unit] ? `${value}${CHINESE[unit]}` : text;
  }

  /** The name of a parameter on the page. */
  function label(dotted) {
    const name = lastOf(dotted);
    return fieldOf(name) || NAMES[name] ? `“${say(NAMES[name] ?? name)}”` : dotted.replace(/\.(\d+)/g, "[$1]");
  }

  /** The place of the error, with the number of a point or of a thing. */
  function place() {
    if (!parameter) return values.field.value ?? values.field.text;
    for (const one of [pointer?.slice(1).replaceAll("/", ".") ?? "", parameter]) {
      const known = PLACES[one.replace(/\d+/g, "#")];
      if (known) return known[column].replace("#", Number(/\d+/.exec(one)?.[0]) + 1);
    }
    return label(parameter);
  }

  const own = {
    field: place,
    units: () => UNITS[unit] ?? unit,
    unit: () => (CHINESE[unit] ?? unit).trim(),
    "field.number": () => Number(/\d+/.exec(parameter)?.[0]) + 1,
    example: () => (field?.centimetres ? EXAMPLES.cm : Number(field?.value) && field.value) || (EXAMPLES[unit] ?? 1),
  };

  /** A text with its words replaced; {word+1}: one more than the value, {word~}: rounded to millimetres. */
  function filled(text) {
    // Names of benches, such as body 3, need no noun before them.
    return text.replace(/\bbench(?:es)? (?=\{(?:bench|a|between)\})/g, "").replace(/\{([\w.]+)(\+1|~)?\}/g, (all, word, how) => {
      const value = word === "got" ? got : values[word];
      if (own[word]) return own[word]();
      if (!value) return all;
      if (word === "then") return `${value.value} ${value.unit}`;
      if (how) return how === "~" ? Number(value.value.toFixed(3)) : value.value + 1;
      if (BENCHES.includes(word)) return value.value ? say("body", { k: value.value }) : say("theHead");
      if (value.parameter) return label(value.parameter);
      return value.unit ? shown(value) : (value.value ?? value.text);
    });
  }

  /** What was given. */
  function given(rule) {
    if (got.text === "more") return chinese ? "现已超出" : "it has more";
    if (got.value === undefined && ["null", "None"].includes(got.text)) return chinese ? "现在为空" : "it is empty";
    if (typeof got.value !== "string") return chinese ? `现为 ${shown(got)}` : `it ${rule.startsWith("have") ? "has" : "is"} ${shown(got)}`;
    if (!got.value) return chinese ? "现在为空" : "it is empty";
    return chinese ? `现为“${got.value}”` : `you typed “${got.value}”`;
  }

  /** The sentence in the words of the service, for what is not known here. */
  const plain = (words) => filled(words).replace(/([?.])?$/, (_, mark) => mark ?? ".");

  if (template.startsWith(IN_LINE)) {
    const inner = refusalIn({ ...told, template: template.slice(IN_LINE.length) }, chinese, say);
    return { textContent: say("csvLine", { line: values.line.text, words: inner.textContent }), lang };
  }
  if (template.startsWith(TABLE)) return refusalIn({ ...told, template: template.slice(TABLE.length) }, chinese, say);
  const name = lastOf(parameter);
  const whole = WHOLE[`${template} (${name})`] ?? WHOLE[values.then ? `within ${values.then.unit ?? "work"}${parameter === "file" ? " file" : ""}` : template];
  if (whole?.[column]) return { textContent: filled(whole[column]) + (chinese ? "。" : "."), lang };
  const rule = template.startsWith(`${FIELD}must `) && template.slice(FIELD.length + "must ".length);
  const [english = rule, translated] = RULES[rule] ?? [];
  const why = reason && !(field?.centimetres && reason.startsWith("lengths are")) ? reason : "";
  if (chinese && !translated) return { textContent: `服务的答复：${told.detail}`, lang };
  if (chinese) {
    const because = why ? `（${filled(REASONS[why] ?? why)}）` : "";
    return { textContent: `${place()}${filled(translated)}${got ? `，${given(rule)}` : ""}${because}。`, lang };
  }
  if (!rule) return { textContent: plain(template + (got ? `, got ${got.text}` : "") + (reason ? `: ${reason}` : "")), lang };
  const sentences = [`${place()} must ${filled(english ?? rule)}${got ? `; ${given(rule)}` : ""}.`, why && capital(plain(why))];
  return { textContent: sentences.filter(Boolean).join(" "), lang };
}
