/** The service's refusals in sentences for people: with the labels of the page, in both languages. */

import { FIELDS } from "./state.js";

/** Rules of messages that read `NAME must RULE, got VALUE: REASON`, in Chinese. */
const RULES = [
  [/^be at least (.+?) turns, or the turning circle smaller$/, "至少应为 $1 圈，或缩小调头空间"],
  [/^be more than (.+?) turns, which is the turning circle$/, "应大于 $1 圈，即起点在调头空间之外"],
  [/^be more than (.+?) turns, where bench (\d+) of this dragon folds$/, "应大于 $1 圈（$2 号板凳在该处折叠）"],
  [/^be less than half of (“.+”) \((.+)\)$/, "应小于$1的一半（$2）"],
  [/^be less than a quarter of (“.+”) \((.+)\)$/, "应小于$1的四分之一（$2）"],
  [/^be at least (\d+) for two to share no handle$/, "至少应为 $1，否则没有两节不共用把手的板凳"],
  [/^be at least ([^ ]+(?: [^ ]+)?)$/, "至少应为 $1"],
  [/^be more than ([^ ]+(?: [^ ]+)?)$/, "应大于 $1"],
  [/^be at most half the chord of bench (\d+) \((.+)\)$/, "最多为 $1 号板凳孔距的一半（$2）"],
  [/^be no wider than its hole \((.+)\)$/, "不得大于板孔直径（$1）"],
  [/^be at most ([^ ]+ s), when the path ends$/, "最多为 $1，此时路径结束"],
  [/^be at most ([^ ]+(?: (?:m(?:\/s)?|turns))?)(?: here)?$/, "最多为 $1"],
  [/^be less than ([^ ]+ m)$/, "应小于 $1"],
  [/^be a(?: finite)? number(?: of (.+?))?(?:, such as (.+))?$/, "应为数字"],
  [/^be a whole number(?:, such as (.+))?$/, "应为整数"],
  [/^be nearer to 1 than (.+)$/, "应比 $1 更接近 1"],
  [/^be less than half of the length, (.+ m)$/, "应小于板长的一半（$1）"],
  [/^be a number in metres$/, "应为数字（米）"],
  [/^be from (.+?) to (.+ m)$/, "应在 $1 至 $2 之间"],
  [/^have (\d+) entries, as the first line has$/, "应有 $1 项，与首行一致"],
  [/^be the names of columns: .+$/, "应为各列名称：name,length,width,overhang"],
  [/^be the first bench, the head; got nothing$/, "应为第一节板凳，即龙头"],
  [/^be given$/, "应填写时刻"],
  [/^be after the passage begins, at (.+ s)$/, "应晚于该段开始的时刻（$1）"],
  [/^be further than where the passage begins, at (.+ m)$/, "应超过该段开始的位置（$1）"],
  [/^be 0, for a pause, or at least (.+ m\/s)$/, "应为 0（停顿），或至少为 $1"],
  [/^be a time of day such as .+$/, "应为时刻，例如 19:30 或 19:30:15"],
  [/^be positive$/, "应大于 0"],
  [/^be zero or more$/, "应为 0 或更大"],
  [/^be smaller$/, "应更小"],
  [/^be smaller, or the benches narrower$/, "应更小，或缩小板宽"],
  [/^be larger$/, "应更大"],
  [/^be larger than (.+ m)$/, "应大于 $1"],
  [/^be larger, or benches fewer$/, "应更大，或减少板凳节数"],
  [/^be larger, or the pitch$/, "应更大，或加大螺距"],
  [/^be fewer, or benches$/, "应减少，或减少板凳节数"],
];
/** What follows the rule. */
const REASONS = [
  [/^lengths are in metres, and (.+) is (.+)$/, "长度以米为单位，$1 即 $2"],
  [/^lengths are in metres$/, "长度以米为单位"],
  [/^(.+) cm is (.+ m)$/, "$1 cm 即 $2"],
  [/^a pause does not reach .+$/, "停顿应以时刻结束"],
  [/^speeds are in metres per second$/, "速度以米每秒为单位"],
  [/^the turn bends to a radius of (.+), and bench (\d+) follows none below (.+)$/, "调头的弯曲半径为 $1，而 $2 号板凳至少需要 $3"],
  [/^a turn that begins on the circle bends to a radius of (.+), too tight for the longest chord \((.+)\)$/, "自边界开始的调头弯曲半径为 $1，对最长的孔距（$2）过小"],
  [/^at a pitch of (.+) the dance starts (?:on|inside) that circle$/, "螺距为 $1 时，起点已在该圆上或圆内"],
  [/^bench (\d+) folds at (.+), before the head is on that circle$/, "龙头到达该圆之前，$1 号板凳已在 $2 时折叠"],
  [/^shorten the dragon$/, "请缩短队伍"],
  [/^the minimum pitch is (.+), and pitches are at most (.+) here$/, "最小螺距为 $1，而此处螺距最多为 $2"],
  [/^on a straight line, and so on every wide enough spiral, benches (\d+) and (\d+) are (.+) apart: .+$/, "在直线上，因而在足够宽的螺线上，$1 号与 $2 号板凳相距 $3"],
  [/^on a straight line, and so on every wide enough spiral, benches (\d+) and (\d+) touch: .+$/, "在直线上，因而在足够宽的螺线上，$1 号与 $2 号板凳相碰"],
  [/^in a turn that begins on the circle benches (\d+) and (\d+) touch (.+) s (after|before) the entry.*$/, (_, a, b, time, side) => `自边界开始调头时，${a} 号与 ${b} 号板凳在进入调头${side === "after" ? "后" : "前"} ${time} s 相碰`],
  [/^in a turn that begins on the circle benches (\d+) and (\d+) come nearer than (.+) m (.+) s (after|before) the entry.*$/, (_, a, b, margin, time, side) => `自边界开始调头时，${a} 号与 ${b} 号板凳在进入调头${side === "after" ? "后" : "前"} ${time} s 间距小于 ${margin} m`],
  [/^in a turn that begins on the circle benches (\d+) and (\d+) may touch with strays up to (.+) m (.+) s (after|before) the entry.*$/, (_, a, b, stray, time, side) => `自边界开始调头时，若离位达 ${stray} m，${a} 号与 ${b} 号板凳在进入调头${side === "after" ? "后" : "前"} ${time} s 可能相碰`],
  [/^.*not found within (.+) s, the time that one answer may take here.*$/, "在一次回答允许的 $1 s 内没有算完"],
  [/^.*not found within (.+) steps of work.*$/, "在允许的 $1 步计算内没有算完"],
];
/** Whole messages that have no such shape. */
const WHOLE = [
  [/^instants x handles must be at most (.+) here, got (.+): .+$/, "时刻数乘以把手数在此处最多为 $1，现为 $2，请加大步长、缩短时段或减少板凳"],
  [/^stop must be at most (.+) s, when the path ends, got (.+) s$/, "路径在 $1 s 结束，不能算到 $2 s"],
  [/^The service failed on this request; its log has the reason\.$/, "服务在处理这一请求时出错，原因见其日志"],
  [/^(\d+) .+ computations are running, as many as may: try again in (.+) s\.$/, "服务正忙（已有 $1 个计算），请 $2 s 后再试"],
  [/^(\d+) of your .+ computations are running, as many as one client may have: try again in (.+) s\.$/, "您已有 $1 个计算在进行，请 $2 s 后再试"],
  [/^Jobs need the token of this service.*$/, "该服务的任务需要令牌：请在下方“服务要求令牌？”处填写"],
  [/^(\d+) of your jobs are not finished, as many as may.*$/, "您有 $1 个任务未完成，已达上限：请等待或取消一个"],
  [/^(?:The jobs that are kept take|\d+ jobs are kept).*$/, "保存的任务已达上限：请删除不需要的任务"],
  [/^There is no job .+$/, "没有这个任务：它已被删除或已过期"],
  [/^(?:The job was dismissed|The result has expired): .+$/, "任务已取消或结果已过期：请重新计算"],
  [/^a column must be named once, got '(.+)'$/, "列“$1”重复"],
  [/^a column must be .+, got '(.*)'$/, "列“$1”不可识别，应为 name、length、width 或 overhang"],
  [/^the column (.+) is missing$/, "缺少 $1 列"],
  [/^(?:passages\[\d+\]|“.+?”) must end at until_s \[m\] or at until_time \[s\], got .+$/, "每段应以位置或时刻之一结束"],
  [/^passages must be at most (\d+), got (\d+)$/, "变速段最多为 $1 段，现为 $2 段"],
  [/^HTTP (\d+)$/, "服务的回答为 HTTP $1"],
];
/** Names in tables of benches and of passages: the key of their words. */
const NAMES = { length: "csvLength", it: "csvIt", speed: "passageSpeed", until_s: "passagePlace", until_time: "passageTime" };
const UNITS = { m: "metres", "m/s": "metres per second", s: "seconds", turns: "turns", rad: "radians" };
/** A number of each unit, such as a person may type. */
const EXAMPLES = { m: "0.55", "m/s": "1.5", s: "300", turns: "16" };

const translated = (table, words) => {
  const [pattern, chinese] = table.find(([pattern]) => pattern.test(words)) ?? [];
  return pattern && words.replace(pattern, chinese);
};

const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);

/** What was given, without the quotes of JSON. */
function given(value, chinese) {
  if (value === '""' || value === "null") return chinese ? "现在为空" : "it is empty";
  const typed = /^"(.*)"$/.exec(value);
  if (chinese) return typed ? `现为“${typed[1]}”` : `现为 ${value}`;
  return typed ? `you typed “${typed[1]}”` : `it is ${value}`;
}

/** Names of fields, as the page calls them. */
function labelled(detail, say) {
  const label = (name) => (FIELDS.some((field) => field.name === name) || NAMES[name] ? `“${say(NAMES[name] ?? name)}”` : name);
  return detail
    .replace(/^(?:dragon\.|path\.|passages\[\d+\]\.)?(\w+)/, (_, name) => label(name))
    .replace(/\b(?:dragon\.|path\.)?([a-z]+_[a-z]+)\b/g, (_, name) => label(name))
    .replace(/ \(and \d+ more\)$/, "");
}

/**
 * A refusal as text and its language. detail: the service's message; chinese: the language that is wanted;
 * say(name): the label of a field
 */
export function refusalIn(detail, chinese, say) {
  const [, line, inLine] = /^csv: line (\d+): (.+)$/s.exec(detail) ?? [];
  if (line) {
    const { textContent, lang } = refusalIn(inLine.replace(/^must/, "it must"), chinese, say);
    return { textContent: say("csvLine", { line, words: textContent }), lang };
  }
  const whole = chinese && translated(WHOLE, detail);
  if (whole) return { textContent: `${whole}。`, lang: "zh-Hans" };
  const english = labelled(detail, say);
  const [, name, must, value, reason] = /^(“.+?”|\w+) must (.+?)(?:, got ("(?:[^"]*)"|[^:]+?))?(?:: (.+?))?$/.exec(english) ?? [];
  if (!name) return chinese ? { textContent: `服务的答复：${english}`, lang: "zh-Hans" } : { textContent: english, lang: "en" };
  const rule = must.replace(/^be a(?: finite)? number \[(.+)\]$/, (_, unit) => `be a number of ${UNITS[unit] ?? unit}, such as ${EXAMPLES[unit] ?? 1}`);
  if (!chinese) {
    const words = [`${name} must ${rule}${value ? `; ${given(value, false)}` : ""}.`, reason && `${capital(reason).replace(/\.$/, "")}.`];
    return { textContent: words.filter(Boolean).join(" "), lang: "en" };
  }
  const known = translated(RULES, rule);
  if (!known) return { textContent: `服务的答复：${english}`, lang: "zh-Hans" };
  const why = reason ? `（${translated(REASONS, reason) ?? reason}）` : "";
  const words = `${name}${known}${value ? `，${given(value, true)}` : ""}`.replace(/ turns\b/g, " 圈");
  return { textContent: `${words}${why}。`, lang: "zh-Hans" };
}
