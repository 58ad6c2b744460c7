/** The claim of a certificate in Chinese, from its kind and values; core/claims/chinese.py has the same sentences. */

import { bound } from "./numbers.js";

const PAIRS = "不共用把手的任何两节板凳";
const TRIED = "以双精度计算，并计入舍入误差。";
const PROOF = `逐步证明：每一步以固定在板凳上的轴向间距的二阶导数界为据，外圈以闭式的环间距界为据；${TRIED}`;
const HULLS = `对板凳此时可能占据的全部位置的凸包逐步证明，方法与首次碰撞相同；${TRIED}`;
const NO_PAIR = "少于三节时，没有两节不共用把手的板凳。";
const MEASURED = "在该时刻以双精度测得。";
const ENDS = { fold: "；此时有板凳折叠，运动结束。", centre: "；此时龙头到达中心。", end: "；此时路径结束。", stop: "；搜索到此为止。" };
const BETWEEN = {
  held: "中间只隔一节的两节板凳由中间那节撑开：由把手间的距离证明。",
  unused: "起限制作用的两节板凳中间只隔一节，此处未计入那一节的作用，视两者独立离位，因此所得离位偏小。",
};
const PIECES = { line: "直线", arc: "圆弧", coil: "螺线", clothoid: "回旋曲线", waypoints: "过点曲线" };

const within = (metres) => `只要每个孔离其位置不超过 ${metres} m 且每节孔距不变，`;
const pathWords = ({ pitch, start_turns: turns, begin, end, pieces }) =>
  pitch === null ? `，沿弧长 ${begin} m 至 ${end} m 的路径（${pieces.map((piece) => PIECES[piece]).join("、")}）` : `，沿螺距 ${pitch} m 的螺线自第 ${turns} 圈盘入`;

function dragonWords({ benches, head_length: head, body_length: body, width, overhang }) {
  if (head === null) return `${benches} 节逐一给定的板凳`;
  return `${benches} 节板凳（龙头长 ${head} m，${body === null ? "" : `龙身长 ${body} m，`}宽 ${width} m，孔心距板头 ${overhang} m）`;
}

function headWords({ head_speed: speed, passages, passage_count: count }) {
  const each = passages.map((one) => `${one.speed} m/s 直到 ${one.until_s === null ? `${one.until_time} s` : `${one.until_s} m`}，`).join("");
  if (each) return `，龙头速度 ${each}其后 ${speed} m/s：`;
  return count ? `，先有 ${count} 段逐一给定的速度，其后龙头速度 ${speed} m/s：` : `，龙头速度 ${speed} m/s：`;
}

/** A claim about the first contact of a dance. */
function contactWords({ kind, dance, margin, stray, start, clear_until: clear, end, benches, time }) {
  const may = stray ? "可能" : "";
  const names = benches && `${benches[0]} 号与 ${benches[1]} 号板凳`;
  const meet = (touch) => `${time} s 时 ${names}${margin ? `间距${may}小于 ${margin} m` : may + touch}。`;
  const about = `${dragonWords(dance.dragon)}${pathWords(dance.path)}${headWords(dance)}${stray ? within(stray) : ""}`;
  if (kind === "contact_at_start") return `${about}${meet("相碰")}${MEASURED}`;
  if (clear === null) return `${about}自 ${start} s 起，${names ? `在 ${time} s（届时 ${names}相碰或过近）之前，` : ""}无法判定${PAIRS}是否相碰或过近。${TRIED}`;
  const open = names ? `；其后在 ${time} s 之前无法判定，届时 ${names}相碰或过近。` : "；其后无法判定。";
  const then = { clear: ENDS[end], contact: `；${meet("重叠")}`, undecided: open }[kind];
  const apart = margin ? `间距都不小于 ${margin} m` : "都不相碰";
  return `${about}${start} s 至 ${clear} s，${PAIRS}${apart}${then}${dance.dragon.benches > 2 ? PROOF : NO_PAIR}`;
}

/** A claim about the strays of people in a dance. */
function strayWords({ kind, dance: { dragon, path }, venue, start, stop, stray, touches, between }) {
  const [long, wide] = [dragon.lengths, dragon.widths].map(([low, high]) => [...(low < high ? [low] : []), high].map((one) => Number(one.toPrecision(9))).join(" 至 "));
  const about = `${dragon.benches} 节板凳（长 ${long} m，宽 ${wide} m）${pathWords(path)}：${start} s 至 ${stop} s，`;
  if (kind === "safe_stray") return `${about}${within(Number(bound(stray, 12, -1)))}${PAIRS}都不会相碰${venue ? "，也不会碰到场地边缘" : ""}。${HULLS}${BETWEEN[between] ?? ""}`;
  return `${about}没有已知安全的离位：${touches ? `各在原位时，板凳已相碰${venue ? "或碰到场地边缘" : ""}。` : "对任何离位都未能证明。"}`;
}

export const claimInChinese = (claim) => (claim.kind.endsWith("safe_stray") ? strayWords(claim) : contactWords(claim));
