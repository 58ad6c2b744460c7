/** The proof of an answer in Chinese: the service's sentences, part by part. */

const PLACE = "不共用把手的任何两节板凳";
/** Parts of a sentence in the order of translation. */
const PARTS = [
  [/^(\d+) bench(?:es)? \(head (.+?) m(?:, body (.+?) m)?, width (.+?) m, overhang (.+?) m\)/, (_, n, head, body, width, overhang) =>
    `${n} 节板凳（龙头长 ${head} m，${body ? `龙身长 ${body} m，` : ""}宽 ${width} m，孔心距板头 ${overhang} m）`],
  [/^(\d+) bench(?:es)? given one by one/, "$1 节逐一给定的板凳"],
  [/^(\d+) benches, (.+?) m long, (.+?) m wide/, (_, n, long, wide) => `${n} 节板凳（长 ${long.replace(" to ", " 至 ")} m，宽 ${wide.replace(" to ", " 至 ")} m）`],
  [/ on a spiral of (.+?) m pitch from (.+?) turns/, "，沿螺距 $1 m 的螺线自第 $2 圈盘入"],
  [/ on a route from s = (.+?) m to (.+?) m \((.+?)\)/, (_, from, to, kinds) => `，沿弧长 ${from} m 至 ${to} m 的路径（${kinds.replaceAll(", ", "、").replaceAll("coil", "螺线").replaceAll("arc", "圆弧").replaceAll("line", "直线").replaceAll("waypoints", "过点曲线")}）`],
  [/, the head (at .+?), and then (at .+?): /, (_, passages, last) => `，龙头速度 ${[...passages.split(", "), last].map((one) => one.replace(/^(?:at )?(\S+ m\/s)(?: until (.+))?$/, (__, speed, until) => (until ? `${speed} 直到 ${until}` : `其后 ${speed}`))).join("，")}：`],
  [/, the head at (\S+) m\/s after (\d+) passages given one by one: /, "，先有 $2 段逐一给定的速度，其后龙头速度 $1 m/s："],
  [/, the head at (.+?) m\/s: /, "，龙头速度 $1 m/s："],
  [/: from (\S+) s to (\S+) s, while every hole is within (.+?) m of its place and every chord keeps its length, no bench touches another that it shares no handle with( or an edge of the venue)?\./, (_, from, to, stray, venue) =>
    `：${from} s 至 ${to} s，只要每个孔离其位置不超过 ${stray} m 且每节孔距不变，${PLACE}都不会相碰${venue ? "，也不会碰到场地边缘" : ""}。`],
  [/: from (\S+) s to (\S+) s no stray is known to be safe: /, "：$1 s 至 $2 s，没有已知安全的离位："],
  [/a bench touches another or an edge of the venue with everybody in place\./, "各在原位时，板凳已相碰或碰到场地边缘。"],
  [/a bench touches another with everybody in place\./, "各在原位时，板凳已相碰。"],
  [/none was proven\./, "对任何离位都未能证明。"],
  [/The two benches that limit it have one between them, which is not used here: they are assumed to stray independently, so the stray is lower than it could be\./, "起限制作用的两节板凳中间只隔一节，此处未计入那一节的作用，视两者独立离位，因此所得离位偏小。"],
  [/while every hole is within (.+?) m of its place, and every chord keeps its length, /, "只要每个孔离其位置不超过 $1 m 且每节孔距不变，"],
  [/from (\S+) s to (\S+) s no two benches that share no handle touch/, `$1 s 至 $2 s，${PLACE}都不相碰`],
  [/from (\S+) s to (\S+) s no two benches that share no handle are nearer to each other than (.+?) m(?=[,;])/, `$1 s 至 $2 s，${PLACE}间距都不小于 $3 m`],
  [/from (\S+) s on it is not decided whether two benches that share no handle (?:touch|are nearer to each other than .+? m) before (\S+) s, when benches (\d+) and (\d+) (?:overlap|may overlap|are nearer than .+? m|may be nearer than .+? m)\./, `自 $1 s 起，在 $2 s（届时 $3 号与 $4 号板凳相碰或过近）之前，无法判定${PLACE}是否相碰或过近。`],
  [/from (\S+) s on it is not decided whether two benches that share no handle (?:touch|are nearer to each other than .+? m)\./, `自 $1 s 起，无法判定${PLACE}是否相碰或过近。`],
  [/, and at (\S+) s benches (\d+) and (\d+) (may )?overlap\./, (_, time, a, b, may) => `；${time} s 时 ${a} 号与 ${b} 号板凳${may ? "可能" : ""}重叠。`],
  [/, and at (\S+) s benches (\d+) and (\d+) (may be|are) nearer than (.+?) m\./, (_, time, a, b, may, margin) => `；${time} s 时 ${a} 号与 ${b} 号板凳间距${may === "are" ? "" : "可能"}小于 ${margin} m。`],
  [/at (\S+) s benches (\d+) and (\d+) (may )?touch\./, (_, time, a, b, may) => `${time} s 时 ${a} 号与 ${b} 号板凳${may ? "可能" : ""}相碰。`],
  [/at (\S+) s benches (\d+) and (\d+) (may be|are) nearer to each other than (.+?) m\./, (_, time, a, b, may, margin) => `${time} s 时 ${a} 号与 ${b} 号板凳间距${may === "are" ? "" : "可能"}小于 ${margin} m。`],
  [/; whether any do after that is not decided\./, "；其后无法判定。"],
  [/; whether any do after that is not decided before (\S+) s, when benches (\d+) and (\d+) (?:overlap|may overlap|are nearer than .+? m|may be nearer than .+? m)\./, "；其后在 $1 s 之前无法判定，届时 $2 号与 $3 号板凳相碰或过近。"],
  [/; there a bench folds, and the run ends\./, "；此时有板凳折叠，运动结束。"],
  [/; there the head is at the centre\./, "；此时龙头到达中心。"],
  [/; there the path ends\./, "；此时路径结束。"],
  [/; the search was to stop there\./, "；搜索到此为止。"],
  [/Proven in steps, each by a bound on the second derivative of the gap along an axis fixed in a bench, and further out by ring bounds in closed form; computed in doubles, with allowances for their rounding\./, "逐步证明：每一步以固定在板凳上的轴向间距的二阶导数界为据，外圈以闭式的环间距界为据；以双精度计算，并计入舍入误差。"],
  [/Proven in steps for the hulls of all places that benches can have then, as first contacts are for benches; computed in doubles, with allowances for their rounding\./, "对板凳此时可能占据的全部位置的凸包逐步证明，方法与首次碰撞相同；以双精度计算，并计入舍入误差。"],
  [/Two benches with one between them are held apart by it: distances of handles prove that\./, "中间只隔一节的两节板凳由中间那节撑开：由把手间的距离证明。"],
  [/Of fewer than three benches, any two share a handle, so there is no pair to judge\./, "少于三节时，没有两节不共用把手的板凳。"],
  [/Computed in doubles, with allowances for their rounding\./, "以双精度计算，并计入舍入误差。"],
  [/Measured at that instant, in doubles\./, "在该时刻以双精度测得。"],
];

/** The method of a certificate in Chinese. */
export function proofInChinese(method) {
  return PARTS.reduce((words, [pattern, chinese]) => words.replace(pattern, chinese), method).replaceAll("。 ", "。");
}
