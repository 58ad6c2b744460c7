/** Texts of the page: its words in the chosen language, and the service's refusals. */

import { FIELDS, strayOf } from "./state.js";
import { WORDS } from "./words.js";

/** Translations of the service's messages, which read `NAME must be RULE, got VALUE: REASON`. */
const RULES = [
  [/^at least (.+?) turns, or the turning circle smaller$/, "至少应为 $1 圈，或缩小调头空间"],
  [/^more than (.+?) turns, which is the turning circle$/, "应大于 $1 圈，即起点在调头空间之外"],
  [/^more than (.+?) turns, where bench (\d+) of this dragon folds$/, "应大于 $1 圈（$2 号板凳在该处折叠）"],
  [/^less than half of (“.+”) \((.+)\)$/, "应小于$1的一半（$2）"],
  [/^less than a quarter of (“.+”) \((.+)\)$/, "应小于$1的四分之一（$2）"],
  [/^at least ([^ ]+(?: [^ ]+)?)$/, "至少应为 $1"],
  [/^more than ([^ ]+(?: [^ ]+)?)$/, "应大于 $1"],
  [/^at most half the chord of bench (\d+) \((.+)\)$/, "最多为 $1 号板凳孔距的一半（$2）"],
  [/^no wider than its hole \((.+)\)$/, "不得大于板孔直径（$1）"],
  [/^at most ([^ ]+(?: m(?:\/s)?)?)(?: here)?$/, "最多为 $1"],
  [/^less than ([^ ]+ m)$/, "应小于 $1"],
  [/^a(?: finite)? number(?: \[.+\])?$/, "应为数字"],
  [/^a whole number$/, "应为整数"],
  [/^smaller$/, "应更小"],
  [/^smaller, or the benches narrower$/, "应更小，或缩小板宽"],
  [/^larger$/, "应更大"],
  [/^larger than (.+ m)$/, "应大于 $1"],
];
const REASONS = [
  [/^lengths are in metres, and (.+) is (.+)$/, "长度以米为单位，$1 即 $2"],
  [/^lengths are in metres$/, "长度以米为单位"],
  [/^speeds are in metres per second$/, "速度以米每秒为单位"],
  [/^the turn bends to a radius of (.+), and bench (\d+) follows none below (.+)$/, "调头的弯曲半径为 $1，而 $2 号板凳至少需要 $3"],
  [/^a turn that begins on the circle bends to a radius of (.+), too tight for the longest chord \((.+)\)$/, "自边界开始的调头弯曲半径为 $1，对最长的孔距（$2）过小"],
  [/^at a pitch of (.+) the dance starts (?:on|inside) that circle$/, "螺距为 $1 时，起点已在该圆上或圆内"],
  [/^bench (\d+) folds at (.+), before the head is on that circle$/, "龙头到达该圆之前，$1 号板凳已在 $2 时折叠"],
  [/^shorten the dragon$/, "请缩短队伍"],
  [/^the minimum pitch is (.+), and pitches are at most (.+) here$/, "最小螺距为 $1，而此处螺距最多为 $2"],
  [/^on a straight line, and so on every wide enough spiral, benches (\d+) and (\d+) are (.+) apart: .+$/, "在直线上，因而在足够宽的螺线上，$1 号与 $2 号板凳相距 $3"],
  [/^on a straight line, and so on every wide enough spiral, benches (\d+) and (\d+) touch: .+$/, "在直线上，因而在足够宽的螺线上，$1 号与 $2 号板凳相碰"],
];

let column = 0;

/** Set the language to the choice, en or zh, or to the browser's preference. */
export function setLanguage(choice) {
  const language = choice ?? (navigator.language.toLowerCase().startsWith("zh") ? "zh" : "en");
  column = language === "zh" ? 1 : 0;
  document.documentElement.lang = language === "zh" ? "zh-Hans" : "en";
  document.title = say("title");
  for (const element of document.querySelectorAll("[data-text]")) element.textContent = say(element.dataset.text);
  for (const element of document.querySelectorAll("[data-label]")) {
    element.setAttribute("aria-label", say(element.dataset.label));
    if (element.tagName === "BUTTON") element.title = say(element.dataset.label);
  }
  return language;
}

/** The text of this key, with {names} replaced. */
export function say(key, values = {}) {
  return WORDS[key][column].replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

/**
 * The same, in the words for what is asked: with a margin benches in contact need not touch, and with a stray they may
 * touch. {touch} and {touches} in a text are the words for a contact. asked: {margin, stray, hole, pin}, [m]
 */
export function sayOf(key, asked, values = {}) {
  const [near, strays] = [Number(asked.margin) > 0, strayOf(asked) > 0];
  const form = (name) => [strays && `${name}Stray`, near && `${name}Near`].find((one) => one in WORDS) ?? name;
  const { margin } = asked;
  const touch = say(near ? "touchNear" : "touch", { margin });
  return say(form(key), { margin, touch, touches: say(form("touches"), { margin, touch }), ...values });
}

/** A title, with the stray for which the answer holds. */
export function titleOf(key, asked) {
  const [title, stray] = [sayOf(key, asked), strayOf(asked)];
  return stray > 0 ? say(asked.hole > 0 ? "withinPlay" : "within", { title, stray: Number((100 * stray).toPrecision(9)) }) : title;
}

/** A refusal of the service, with the page's labels for its names, and in Chinese as far as RULES cover it. */
export function refusalWords(detail) {
  const label = (name) => (FIELDS.some((field) => field.name === name) ? `“${say(name)}”` : name);
  const english = detail
    .replace(/^(?:dragon\.|path\.)?(\w+)/, (_, name) => label(name))
    .replace(/\b(?:dragon\.|path\.)?([a-z]+_[a-z]+)\b/g, (_, name) => label(name));
  const [, name, rule, value, reason] = english.match(/^(“.+?”) must be (.+?)(?:, got ([^:]+?))?(?:: (.+?))?(?: \(and \d+ more\))?$/) ?? [];
  const known = column && translated(RULES, rule);
  if (!known) return { textContent: english, lang: "en" };
  const why = reason ? `（${translated(REASONS, reason) ?? reason}）` : "";
  const words = `${name}${known}${value ? `，现为 ${value}` : ""}`.replace(/ turns\b/g, " 圈");
  return { textContent: `${words}${why}。`, lang: "zh-Hans" };
}

function translated(table, words) {
  const [pattern, chinese] = table.find(([pattern]) => pattern.test(words)) ?? [];
  return pattern && words.replace(pattern, chinese);
}

/** Name of bench k in a sentence. */
export function benchName(k, benches) {
  if (k === 0) return say("theHead");
  return k === benches - 1 ? say("theTail") : say("body", { k });
}

/** Name of handle k, after the bench that it leads; bench k has the same name. */
export function handleName(k, benches) {
  if (k === 0) return say("head");
  if (k === benches) return say("tailRear");
  return k === benches - 1 ? say("tail") : say("body", { k });
}
