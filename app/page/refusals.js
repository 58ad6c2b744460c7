/** The service's refusals in sentences for people: with the labels and the units of the page, in both languages. */

import { FIELDS, LABELS } from "./fields.js";
import { phrase } from "./text.js";
import { PLACES, REASONS, RULES, WHOLE } from "./words/refusals.js";

/** Labels of the numbers, and names in tables of benches and of passages. */
const NAMES = { ...LABELS, length: phrase("Length"), speed: phrase("Speed of the passage"), until_s: phrase("until, in metres"), until_time: phrase("until, in seconds"), duration: phrase("for, in seconds") };
const UNITS = { m: "metres", cm: "centimetres", "m/s": "metres per second", s: "seconds", turns: "turns", rad: "radians" };
const CHINESE = { turns: " 圈", degrees: "°" };
/** An example of a number in each unit, for fields without a default. */
const EXAMPLES = { m: "0.55", cm: "2", "m/s": "1.5", s: "300", turns: "16" };
/** Words in templates that stand for numbers of benches. */
const BENCHES = ["bench", "a", "b", "between"];
const LANGS = ["en", "zh-Hans"];
const TABLE = "{table}: ";
const IN_LINE = `${TABLE}line {line}: `;

const fieldOf = (name) => FIELDS.find((field) => field.name === name);
const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);

/** The first number in a dotted name, counted from 1. */
const numberIn = (name) => Number(/\d+/.exec(name)?.[0]) + 1;

/** The last name in a dotted name that is no number. */
const lastOf = (name) => name.split(".").findLast((part) => Number.isNaN(Number(part)));

/**
 * A refusal as text and its language. problem: the service's problem or one of its errors: {detail, template, got, reason,
 * values, pointer}; chinese: true for Chinese; say(name): the label of a field
 */
export function refusalIn(problem, chinese, say) {
  const { template, values } = problem;
  const rest = [IN_LINE, TABLE].find((begin) => template.startsWith(begin));
  if (!rest) return new Refusal(problem, chinese, say).inWords();
  const refusal = refusalIn({ ...problem, template: template.slice(rest.length) }, chinese, say);
  if (rest === TABLE) return refusal;
  const words = say("Line {line}: {words}", { line: values.line.text, words: refusal.textContent });
  return { textContent: words, lang: chinese ? LANGS[1] : LANGS[0] };
}

/** One refusal and how it is worded; its arguments are those of refusalIn(). */
class Refusal {
  constructor({ detail, template, got, reason, values, pointer }, chinese, say) {
    this.detail = detail;
    this.template = template;
    this.got = got;
    this.reason = reason;
    this.values = values ?? {};
    this.pointer = pointer;
    this.chinese = chinese;
    this.say = say;
    this.column = chinese ? 1 : 0;
    this.parameter = this.values.field?.parameter ?? "";
    this.field = fieldOf(lastOf(this.parameter));
    this.unit = this.field?.centimetres ? "cm" : this.values.unit?.text;
  }

  /** The whole sentence. */
  inWords() {
    const whole = WHOLE[`${this.template} (${lastOf(this.parameter)})`] ?? WHOLE[this.kind()];
    const textContent = whole?.[this.column]
      ? this.fill(whole[this.column]) + (this.chinese ? "。" : ".")
      : this.chinese ? this.inChinese() : this.inEnglish();
    return { textContent, lang: LANGS[this.column] };
  }

  /** The key of a whole sentence: the template, but one for all that took too much time or work. */
  kind() {
    const { then } = this.values;
    return then ? `within ${then.unit ?? "work"}${this.parameter === "file" ? " file" : ""}` : this.template;
  }

  /** The template after "{field} must "; undefined if it does not begin so. */
  rule() {
    const [, rule] = this.template.split(/^\{field\} must /);
    return rule;
  }

  /** The reason, without what is said of metres where the page shows centimetres. */
  why() {
    return this.field?.centimetres && this.reason?.startsWith("lengths are") ? "" : this.reason;
  }

  inChinese() {
    const [, rule] = RULES[this.rule()] ?? [];
    if (!rule) return `服务的答复：${this.detail}`;
    const why = this.why() ? `（${this.fill(REASONS[this.why()] ?? this.why())}）` : "";
    return `${this.place()}${this.fill(rule)}${this.got ? `，${this.value()}` : ""}${why}。`;
  }

  /** In English also what is not known here: in the words of the service. */
  inEnglish() {
    const rule = this.rule();
    const ended = (words) => this.fill(words).replace(/([?.])?$/, (_, mark) => mark ?? ".");
    if (!rule)
      return ended(this.template + (this.got ? `, got ${this.got.text}` : "") + (this.reason ? `: ${this.reason}` : ""));
    const must = `${this.place()} must ${this.fill(RULES[rule]?.[0] ?? rule)}${this.got ? `; ${this.value()}` : ""}.`;
    return this.why() ? `${must} ${capital(ended(this.why()))}` : must;
  }

  /** A number as the page shows it. */
  quantity({ text, value, unit }) {
    if (unit === "m" && this.field?.centimetres) return `${Number((100 * value).toPrecision(12))} cm`;
    if (unit === "rad") return `${Number(((180 * value) / Math.PI).toFixed(2))}°`;
    return this.chinese && CHINESE[unit] ? `${value}${CHINESE[unit]}` : text;
  }

  /** The name of a parameter on the page. */
  label(dotted) {
    const name = lastOf(dotted);
    return NAMES[name] ? `“${this.say(NAMES[name])}”` : dotted.replace(/\.(\d+)/g, "[$1]");
  }

  /** The place of the error, with the number of a point or of a thing. */
  place() {
    const { values, pointer, parameter } = this;
    if (!parameter) return values.field.value ?? values.field.text;
    for (const one of [pointer?.slice(1).replaceAll("/", ".") ?? "", parameter]) {
      const known = PLACES[one.replace(/\d+/g, "#")];
      if (known) return known[this.column].replace("#", numberIn(one));
    }
    return this.label(parameter);
  }

  /** A text with its words replaced; {word+1}: one more than the value, {word~}: rounded to millimetres. */
  fill(text) {
    // Names of benches, such as body 3, need no noun before them.
    return text
      .replace(/\bbench(?:es)? (?=\{(?:bench|a|between)\})/g, "")
      .replace(/\{([\w.]+)(\+1|~)?\}/g, (all, word, how) => this.substitute(word, how) ?? all);
  }

  /** What stands in the place of a word; undefined if nothing is known of it. */
  substitute(word, how) {
    const { field, unit } = this;
    if (word === "field") return this.place();
    if (word === "units") return UNITS[unit] ?? unit;
    if (word === "unit") return (CHINESE[unit] ?? unit).trim();
    if (word === "field.number") return numberIn(this.parameter);
    if (word === "example")
      return (field?.centimetres ? EXAMPLES.cm : Number(field?.value) && field.value) || (EXAMPLES[unit] ?? 1);
    const value = word === "got" ? this.got : this.values[word];
    if (!value) return undefined;
    if (word === "then") return `${value.value} ${value.unit}`;
    if (how) return how === "~" ? Number(value.value.toFixed(3)) : value.value + 1;
    if (BENCHES.includes(word)) return value.value ? this.say("body {k}", { k: value.value }) : this.say("the head");
    if (value.parameter) return this.label(value.parameter);
    return value.unit ? this.quantity(value) : (value.value ?? value.text);
  }

  /** What was given. */
  value() {
    const { got, column } = this;
    if (got.text === "more") return ["it has more", "现已超出"][column];
    if (got.value === "" || (got.value === undefined && ["null", "None"].includes(got.text)))
      return ["it is empty", "现在为空"][column];
    if (typeof got.value === "string") return [`you typed “${got.value}”`, `现为“${got.value}”`][column];
    const verb = this.rule().startsWith("have") ? "has" : "is";
    return [`it ${verb} ${this.quantity(got)}`, `现为 ${this.quantity(got)}`][column];
  }
}
