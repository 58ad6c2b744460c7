/** Every word of the page in English and in Simplified Chinese, with the terms of the contest. */

import { FIELDS } from "./state.js";

const WORDS = {
  title: ["Bench Dragon", "板凳龙"],
  tagline: ["Where is everyone, when do two benches first touch, how tight may the spiral be?", "每节板凳在哪里、何时首次碰撞、螺线能盘多紧？"],
  skip: ["Skip to the dance", "跳到舞龙画面"],
  language: ["Language", "语言"],
  share: ["Copy link", "复制链接"],
  copied: ["Copied", "已复制"],
  copyFailed: ["The browser did not allow copying", "浏览器不允许复制"],
  allCalls: ["All calls", "全部接口"],
  lost: ["The service does not answer. What you see is kept; next try in {seconds} s.", "服务没有响应。画面保持不变，{seconds} 秒后重试。"],
  retry: ["Try now", "立即重试"],
  back: ["The service is back.", "服务已恢复。"],

  dance: ["The dance", "舞龙"],
  danceHelp: ["Picture of the dragon. Arrow keys pan, plus and minus zoom, 0 shows all, F follows the head, [ and ] choose a handle, space plays.", "舞龙画面。方向键平移，加减号缩放，0 显示全部，F 跟随龙头，[ 和 ] 选择把手，空格播放。"],
  play: ["Play", "播放"],
  pause: ["Pause", "暂停"],
  stepBack: ["One second back", "后退一秒"],
  stepOn: ["One second on", "前进一秒"],
  time: ["Time", "时间"],
  toEnd: ["To the end", "到终点"],
  rate: ["Speed of play", "播放速度"],
  zoomIn: ["Zoom in", "放大"],
  zoomOut: ["Zoom out", "缩小"],
  showAll: ["Show all", "显示全部"],
  follow: ["Follow the head", "跟随龙头"],
  legend: ["Speed of the handles now", "当前把手速度"],
  allEqual: ["all equal", "全部相等"],
  insetTitle: ["Where the two benches are nearest, enlarged", "两节板凳最近处放大"],
  insetMeet: ["{corner} of {a} meets {edge} of {b}", "{a}的{corner}碰到{b}的{edge}"],
  insetMeetNear: ["{corner} of {a} is nearer than {margin} m to {edge} of {b}", "{a}的{corner}与{b}的{edge}间距小于 {margin} m"],
  gap: ["gap {gap} mm", "间距 {gap} mm"],
  overlap: ["overlap by {depth} mm", "重叠 {depth} mm"],

  controls: ["The dragon and its path", "舞龙队与路径"],
  path: ["Path", "路径"],
  dragon: ["Dragon", "板凳龙"],
  motion: ["Motion", "运动"],
  pitch: ["Pitch", "螺距"],
  start_turns: ["Start", "起始圈数"],
  turning_diameter: ["Turning circle, diameter", "调头空间直径"],
  benches: ["Benches", "板凳节数"],
  head_length: ["Length of the head", "龙头板长"],
  body_length: ["Length of a body bench", "龙身板长"],
  width: ["Width", "板宽"],
  overhang: ["Handle to bench end", "孔心距板头"],
  head_speed: ["Speed of the head", "龙头速度"],
  margin: ["Margin", "安全间距"],
  turns: ["turns", "圈"],
  limits: ["{low} to {high}", "{low} 至 {high}"],
  reset: ["Reset {name}", "重置{name}"],
  resetAll: ["Reset all", "全部重置"],
  slider: ["{name}, slider", "{name}，滑块"],
  spiral: ["Spiral", "螺线"],
  turn: ["Turn", "调头"],

  answers: ["The answers", "结果"],
  firstContact: ["First contact", "首次碰撞"],
  firstContactNear: ["First time nearer than {margin} m", "首次间距小于 {margin} m"],
  contact: ["Contact at {time} s", "{time} s 时碰撞"],
  contactNear: ["Nearer than {margin} m at {time} s", "{time} s 时间距小于 {margin} m"],
  contact_at_start: ["Touching already at the start", "起始时已经碰撞"],
  contact_at_startNear: ["Nearer than {margin} m from the start on", "自起始时间距已小于 {margin} m"],
  clear: ["Nothing touches", "全程无碰撞"],
  clearNear: ["Never nearer than {margin} m", "全程间距不小于 {margin} m"],
  folds: ["The dragon folds at {time} s", "{time} s 时队伍折叠"],
  foldsNear: ["The dragon folds at {time} s", "{time} s 时队伍折叠"],
  undecided: ["Undecided", "无法判定"],
  undecidedNear: ["Undecided", "无法判定"],
  pairMeets: ["{a} and {b} meet at ({x}, {y}) m; the head is {radius} m from the centre.", "{a}与{b}在 ({x}, {y}) m 处相碰，此时龙头距中心 {radius} m。"],
  pairOverlaps: ["{a} and {b} overlap by {depth} mm at ({x}, {y}) m; the head is {radius} m from the centre.", "{a}与{b}在 ({x}, {y}) m 处重叠 {depth} mm，此时龙头距中心 {radius} m。"],
  pairMeetsNear: ["{a} and {b} are nearer than {margin} m, with a gap of {gap} mm, at ({x}, {y}) m; the head is {radius} m from the centre.", "{a}与{b}在 ({x}, {y}) m 处间距为 {gap} mm，小于 {margin} m，此时龙头距中心 {radius} m。"],
  clearUntil: ["Not one pair of benches touches before the run ends at {time} s.", "直到 {time} s 运动结束，没有任何两节板凳相碰。"],
  clearUntilNear: ["Not one pair of benches comes nearer than {margin} m before the run ends at {time} s.", "直到 {time} s 运动结束，没有任何两节板凳间距小于 {margin} m。"],
  foldsUntil: ["The dance fails there, where {name} can no longer follow the spiral. Not one pair of benches touches before.", "舞龙在此失败：{name}无法继续沿螺线行进。此前没有任何两节板凳相碰。"],
  foldsUntilNear: ["The dance fails there, where {name} can no longer follow the spiral. Not one pair of benches comes nearer than {margin} m before.", "舞龙在此失败：{name}无法继续沿螺线行进。此前没有任何两节板凳间距小于 {margin} m。"],
  clearAll: ["Not one pair of benches touches on the stretch that is danced.", "在所示路段上没有任何两节板凳相碰。"],
  clearAllNear: ["Not one pair of benches comes nearer than {margin} m on the stretch that is danced.", "在所示路段上没有任何两节板凳间距小于 {margin} m。"],
  undecidedFrom: ["Proven clear up to {time} s; not decided after that.", "已证明 {time} s 之前无碰撞，其后无法判定。"],
  minimumPitch: ["Minimum pitch", "最小螺距"],
  usePitch: ["Use this pitch", "采用此螺距"],
  toCircle: ["The head reaches the turning circle of {diameter} m without contact at every larger pitch.", "螺距大于此值时，龙头都能无碰撞地到达直径 {diameter} m 的调头空间。"],
  toCircleNear: ["The head reaches the turning circle of {diameter} m at every larger pitch with no bench nearer than {margin} m to another.", "螺距大于此值时，龙头都能到达直径 {diameter} m 的调头空间，且任何两节板凳间距不小于 {margin} m。"],
  toCircleTried: ["The head reaches the turning circle of {diameter} m without contact at every larger pitch that was tried.", "对所检验的每个更大螺距，龙头都能无碰撞地到达直径 {diameter} m 的调头空间。"],
  toCircleTriedNear: ["The head reaches the turning circle of {diameter} m with no bench nearer than {margin} m to another at every larger pitch that was tried.", "对所检验的每个更大螺距，龙头都能到达直径 {diameter} m 的调头空间，且任何两节板凳间距不小于 {margin} m。"],
  limited_graze: ["Limited by {a} and {b} grazing on the way, head at radius {radius} m.", "受限于途中{a}与{b}擦碰，此时龙头半径 {radius} m。"],
  limited_grazeNear: ["Limited by {a} and {b} coming nearer than {margin} m on the way, head at radius {radius} m.", "受限于途中{a}与{b}间距小于 {margin} m，此时龙头半径 {radius} m。"],
  limited_circle: ["Limited by {a} and {b} meeting just as the head is on the circle, radius {radius} m.", "受限于龙头到达调头空间边界（半径 {radius} m）时{a}与{b}相碰。"],
  limited_circleNear: ["Limited by {a} and {b} coming nearer than {margin} m just as the head is on the circle, radius {radius} m.", "受限于龙头到达调头空间边界（半径 {radius} m）时{a}与{b}间距小于 {margin} m。"],
  limited_start: ["Limited by the start: at a smaller pitch the dance starts inside the circle or touching.", "受限于起点：螺距更小时，起点已在圆内或已相碰。"],
  limited_startNear: ["Limited by the start: at a smaller pitch the dance starts inside the circle, or with two benches nearer than {margin} m.", "受限于起点：螺距更小时，起点已在圆内，或起始时已有板凳间距小于 {margin} m。"],
  limited_fold: ["Limited by a fold: at a smaller pitch {name} cannot follow the spiral until the head is on the circle.", "受限于折叠：螺距更小时，在龙头到达调头空间之前，{name}已无法沿螺线行进。"],
  limited_foldNear: ["Limited by a fold: at a smaller pitch {name} cannot follow the spiral until the head is on the circle.", "受限于折叠：螺距更小时，在龙头到达调头空间之前，{name}已无法沿螺线行进。"],
  islands: ["Smaller pitches that also work: {list}", "另外可行的更小螺距：{list}"],
  shortestTurn: ["Deepest entry into the turn", "调头最深起点"],
  entryIs: ["from the centre; the turn that begins there is {length} m long.", "（距中心）；由此开始的调头长 {length} m。"],
  entry_bend: ["Limited by the bend: deeper in, a bench cannot follow any more.", "受限于弯曲：再向内，板凳无法跟随。"],
  entry_contact: ["Limited by contact: deeper in, {a} and {b} touch.", "受限于碰撞：再向内，{a}与{b}相碰。"],
  entry_contactNear: ["Limited by the margin: deeper in, {a} and {b} come nearer than {margin} m.", "受限于安全间距：再向内，{a}与{b}间距小于 {margin} m。"],
  entry_centre: ["Nothing limits it down to the deepest entry that is tried.", "直到所试的最深起点都不受限。"],
  bracketEntry: ["infeasible at {low} m, feasible at {high} m", "{low} m 不可行，{high} m 可行"],
  scanned: ["Entries tried", "所试起点"],
  scannedEntries: ["{evaluations}, each one proven; down from the circle {step} mm apart", "{evaluations} 个，各经证明；自边界向内间隔 {step} mm"],
  highest: ["Highest speed", "最高速度"],
  whose: ["{name}, at {time} s", "{name}，{time} s"],
  headFastest: ["no handle is ever faster than the head", "没有把手比龙头更快"],
  unbounded: ["Grows without bound", "无限增大"],
  towardsFold: ["towards the fold, where a bench cannot follow any more", "接近折叠处，板凳无法继续跟随"],
  foldKnown: ["Where a chord folds, the handle behind it moves as one over the square root of the way that is left.", "在折叠处，后一把手的速度与剩余路程的平方根成反比。"],
  end: ["End of the run", "运动终点"],
  end_contact: ["The dance stops at the first contact.", "在首次碰撞时停止。"],
  end_contactNear: ["The dance is shown until two benches are nearer than {margin} m.", "画面到两节板凳间距小于 {margin} m 为止。"],
  end_fold: ["{name} cannot follow any more: the chain folds.", "{name}无法继续跟随：队伍折叠。"],
  end_centre: ["The head is at the centre.", "龙头到达中心。"],
  end_turn: ["The dance is shown from 100 m before the turn begins to 100 m after.", "画面显示调头开始前 100 m 到其后 100 m。"],
  end_undecided: ["The dance is shown as far as it is proven clear.", "画面到已证明无碰撞处为止。"],
  how: ["How it is known", "依据"],
  bracket: ["Bracket, rounded outwards", "区间（向外取整）"],
  bracketTime: ["clear up to {low} s, overlapping at {high} s", "{low} s 前无碰撞，{high} s 时重叠"],
  bracketTimeNear: ["not nearer up to {low} s, nearer than {margin} m at {high} s", "{low} s 前间距不小于 {margin} m，{high} s 时小于"],
  bracketNone: ["none: at every smaller pitch the dance would begin inside the circle", "无：螺距更小时，起点已在圆内"],
  bracketPitch: ["infeasible at {low} m, feasible at {high} m", "{low} m 不可行，{high} m 可行"],
  bracketSpeed: ["{low} m/s is reached, {high} m/s never exceeded", "达到 {low} m/s，从不超过 {high} m/s"],
  certificate: ["Certificate", "证明"],
  certificateSteps: ["{steps} proven steps; nothing touches up to {until} s, rounded down", "{steps} 个已证明的步；{until} s（向下取整）之前无碰撞"],
  certificateStepsNear: ["{steps} proven steps; nothing is nearer than {margin} m up to {until} s, rounded down", "{steps} 个已证明的步；{until} s（向下取整）之前间距不小于 {margin} m"],
  certificateStart: ["they touch at the start: no time before it is proven clear", "起始时刻即已碰撞，此前没有可证明的时段"],
  certificateStartNear: ["they are nearer than {margin} m at the start: no time before it is proven clear", "起始时刻间距已小于 {margin} m，此前没有可证明的时段"],
  certificateNone: ["nothing is decided from the start on", "自起始时刻起无法判定"],
  leastBefore: ["Narrowest graze", "最险擦过"],
  leastBeforeIs: ["{gap} mm between {a} and {b} at {time} s", "{time} s 时{a}与{b}相距 {gap} mm"],
  justified: ["Every larger pitch", "更大螺距"],
  justified_bound: ["feasible, proven for all at once", "可行，已整体证明"],
  justified_scan: ["feasible as far as a scan shows: up to {from} m single ones are proven, at most {step} mm apart", "经扫描可行：{from} m 以下逐个证明，间隔不超过 {step} mm"],
  proven: ["Proven for every pitch", "全部证明的范围"],
  provenTo: ["from {from} m to {upTo} m", "{from} m 至 {upTo} m"],
  provenToAll: ["from {from} m on, without end", "{from} m 起，无上限"],
  evaluations: ["Ways to the circle computed, for single pitches and for strips", "检验的路程与螺距带数"],
  engines: ["{count} engines", "{count} 种算法"],
  judgedAll: [" on all {count} benches.", "检验全部 {count} 节板凳。"],
  judgedPair: [" on {a} and {b} alone.", "只检验{a}与{b}。"],
  judgedNear: [" on the {count} of {benches} benches near the pair.", "检验 {benches} 节中这一对附近的 {count} 节。"],
  together: ["At the same instant also: {list}.", "同时碰撞的还有：{list}。"],
  noBefore: ["no before", "无之前"],
  engine: ["Engine", "算法"],
  before: ["just before", "之前"],
  after: ["just after", "之后"],
  apart: ["apart", "分离"],
  apartNear: ["not nearer than {margin} m", "间距不小于 {margin} m"],
  overlapping: ["overlapping", "重叠"],
  overlappingNear: ["nearer than {margin} m", "间距小于 {margin} m"],
  agree: ["They agree.", "结论一致。"],
  disagree: ["They differ.", "结论不一致。"],
  noEngines: ["No pair to cross-check.", "没有需要交叉检验的板凳对。"],
  separating_axis: ["separating axis", "分离轴"],
  fcl: ["FCL", "FCL"],
  shapely: ["shapely", "shapely"],
  angle_sum: ["angle sum (paper)", "角度和（论文）"],
  endKnown: ["From the same search as the answer above.", "与上面的结果出自同一次搜索。"],
  unanswered: ["No answer", "没有结果"],

  charts: ["Charts", "图表"],
  clearance: ["Clearance over time", "间距随时间的变化"],
  clearanceHelp: ["Smallest gap between two benches that share no handle. Dots: local minima; dashed: the margin; cross: the first time that it is reached. Click or drag to move the dance.", "不共用把手的两节板凳之间的最小间距。圆点：局部最小值；虚线：安全间距；叉：首次达到安全间距。点击或拖动可移动时间。"],
  clearanceAt: ["{time} s: {gap}, {a} and {b}", "{time} s：{gap}，{a}与{b}"],
  clearanceAxis: ["clearance [mm]", "间距 [mm]"],
  timeAxis: ["time [s]", "时间 [s]"],
  scan: ["Where the head stops, against the pitch", "龙头停止处的半径与螺距"],
  scanHelp: ["Radius of the head at first contact; the curve jumps. Dashed: turning circle; dotted: minimum pitch; line: your pitch. Click to set the pitch.", "首次碰撞时龙头的半径，曲线有跳跃。虚线：调头空间；点线：最小螺距；实线：当前螺距。点击可设定螺距。"],
  scanHelpNear: ["Radius of the head when two benches are first nearer than {margin} m; the curve jumps. Dashed: turning circle; dotted: minimum pitch; line: your pitch. Click to set the pitch.", "两节板凳首次间距小于 {margin} m 时龙头的半径，曲线有跳跃。虚线：调头空间；点线：最小螺距；实线：当前螺距。点击可设定螺距。"],
  scanAt: ["pitch {pitch} m: the head stops at {radius} m", "螺距 {pitch} m：龙头停在 {radius} m"],
  pitchAxis: ["pitch [m]", "螺距 [m]"],
  radiusAxis: ["radius [m]", "半径 [m]"],

  table: ["Handles", "把手"],
  tableAt: ["at {time} s", "{time} s 时"],
  tableAtFold: ["1e-6 s before the fold at {time} s", "{time} s 折叠前 1e-6 s"],
  nearFold: ["Just before the fold at {time} s: towards it the speeds grow without bound.", "即将在 {time} s 折叠：越接近该时刻，速度越大，没有上限。"],
  legendFold: ["{speed} m/s → ∞", "{speed} m/s → ∞"],
  tableHelp: ["Choose a handle here or in the picture. Arrow keys move the choice.", "在此处或画面中选择把手，方向键可移动选择。"],
  handle: ["Handle", "把手"],
  speed: ["speed [m/s]", "速度 [m/s]"],
  keep: ["Keep", "保存"],
  csv: ["Trajectory, CSV", "轨迹 CSV"],
  png: ["Picture, PNG", "画面 PNG"],
  figure: ["Figure, SVG", "插图 SVG"],
  json: ["Answer, JSON", "结果 JSON"],
  curl: ["The same from a terminal", "在终端中得到同样结果"],
  copyCurl: ["Copy command", "复制命令"],
  grade: ["Grade results of the contest", "竞赛结果评阅"],
  gradeHelp: ["What is right in result1, result2 and result4 (xlsx or CSV, up to 20 MB each), and which known error made the rest wrong. Nothing is kept.", "检查 result1、result2、result4（xlsx 或 CSV，每个不超过 20 MB）哪些正确，并指出是哪种已知错误造成的。文件不会保存。"],
  drop: ["Drop files here, or choose them", "把文件拖到此处，或选择文件"],
  typed: ["Typed answers", "填写的答案"],
  typed_collision_time: ["First contact", "首次碰撞时刻"],
  typed_pitch: ["Minimum pitch", "最小螺距"],
  typed_turn_length: ["Length of the turn", "调头曲线长度"],
  typed_speed: ["Maximum head speed", "龙头最大速度"],
  gradeNow: ["Grade", "评阅"],
  gradeClear: ["Clear", "清空"],
  verdict_right: ["right", "正确"],
  verdict_rounded: ["rounded", "已舍入"],
  verdict_incomplete: ["incomplete", "不完整"],
  verdict_wrong: ["wrong", "错误"],
  verdict_unreadable: ["unreadable", "无法读取"],
  rightIs: ["{value} {unit} is right.", "正确值为 {value} {unit}。"],
  nothingFits: ["No known error gives these numbers.", "没有已知错误能得出这些数值。"],
  rubric: ["The points of the reviewers", "评阅要点"],
  sheetIs: ["{title}: {verdict}, {right} of {cells} cells right", "{title}：{verdict}，{cells} 个单元格中 {right} 个正确"],
  holds_position: ["positions", "位置"],
  holds_speed: ["speeds", "速度"],
  holds_contact: ["first contact", "首次碰撞"],
  worstCell: ["Worst: {cell}, {handle}, {quantity} at {time} s is {found}; {expected} is right.", "误差最大：{cell}，{handle}，{time} s 时的 {quantity} 为 {found}，正确为 {expected}。"],
  firstCell: ["First: {cell}, {handle}, {quantity} at {time} s is {found}; {expected} is right.", "首个错误：{cell}，{handle}，{time} s 时的 {quantity} 为 {found}，正确为 {expected}。"],
  marks: ["Where the wrong cells are: handles from the top, instants from the left", "错误单元格的位置：自上而下为把手，自左而右为时刻"],
  saved: ["Saved {name}", "已保存 {name}"],

  sweeps: ["Many designs at once", "批量计算"],
  sweepsHelp: ["One question over one or two numbers, all others as above. The service works it out as a job; you may close the page and come back.", "让一两个参数变化，其余取上方的值。服务在后台计算，可以关闭页面，稍后再来。"],
  sweepQuestion: ["Question", "问题"],
  sweep_collision_time: ["First contact", "首次碰撞"],
  sweep_minimum_pitch: ["Minimum pitch", "最小螺距"],
  sweep_least_clearance: ["Least clearance", "最小间距"],
  sweep_shortest_turn: ["Shortest turn", "最短调头"],
  sweep_maximum_head_speed: ["Highest speed of the head in a turn", "调头时龙头最高速度"],
  value_collision_time: ["first contact [s]", "首次碰撞 [s]"],
  value_minimum_pitch: ["minimum pitch [m]", "最小螺距 [m]"],
  value_least_clearance: ["least clearance [m]", "最小间距 [m]"],
  value_shortest_turn: ["length of the turn [m]", "调头长度 [m]"],
  value_maximum_head_speed: ["speed of the head [m/s]", "龙头速度 [m/s]"],
  sweepParameter: ["Parameter", "参数"],
  sweepParameter0: ["First parameter", "第一个参数"],
  sweepParameter1: ["Second parameter", "第二个参数"],
  sweepNone: ["none", "无"],
  sweepFrom: ["from", "从"],
  sweepTo: ["to", "到"],
  sweepCount: ["how many", "个数"],
  sweepStart: ["Start", "开始计算"],
  sweepTwice: ["The two parameters must differ.", "两个参数不能相同。"],
  sweep: ["Sweep", "批量计算"],
  sweepOver: ["{question} over {names}", "{question}，变化：{names}"],
  and: [" and ", "、"],
  comma: [", ", "，"],
  colon: [": ", "："],
  jobs: ["Jobs", "任务"],
  jobsNone: ["No jobs yet.", "还没有任务。"],
  jobStarted: ["The job has started.", "任务已开始。"],
  jobReady: ["The map is drawn.", "图已绘出。"],
  jobWaits: ["waits for its turn", "等待中"],
  jobRuns: ["runs", "进行中"],
  jobDone: ["done", "已完成"],
  jobFailed: ["failed", "失败"],
  jobDismissed: ["cancelled", "已取消"],
  jobDesigns: ["{done} of {total} designs", "已算 {done} / {total}"],
  jobRate: ["{rate} per second, {left} s left", "每秒 {rate} 个，还需 {left} s"],
  jobMap: ["Map", "图"],
  jobResult: ["Result", "结果"],
  jobCancel: ["Cancel", "取消"],
  jobRemove: ["Remove", "删除"],
  tokenTitle: ["This service asks for a token?", "服务要求令牌？"],
  token: ["Token: it starts jobs and lists all of them", "令牌：用于启动任务并列出全部任务"],
  mapValue: ["Value", "数值"],
  mapHelp: ["Map of the value. Arrow keys choose a design, Enter opens its dance.", "数值分布图。方向键选择方案，回车打开该舞龙。"],
  mapHint: ["Lines: equal values. Blank: no such value. Click a design to open its dance.", "线：等值线。空白：没有该数值。点击可打开该方案的舞龙。"],
  mapEmpty: ["no such value", "没有该数值"],
  mapNone: ["Only numbers over one or two parameters can be drawn.", "只能绘制一两个数值参数的结果。"],

  head: ["head", "龙头"],
  body: ["body {k}", "第{k}节龙身"],
  tail: ["tail", "龙尾"],
  theHead: ["the head", "龙头"],
  theTail: ["the tail", "龙尾"],
  tailRear: ["tail (rear)", "龙尾（后）"],
  "front-outer": ["front outer corner", "前外角"],
  "front-inner": ["front inner corner", "前内角"],
  "rear-outer": ["rear outer corner", "后外角"],
  "rear-inner": ["rear inner corner", "后内角"],
  front: ["front edge", "前边"],
  rear: ["rear edge", "后边"],
  outer: ["outer edge", "外边"],
  inner: ["inner edge", "内边"],
};

/** Translations of the service's messages, which read `NAME must be RULE, got VALUE: REASON`. */
const RULES = [
  [/^at least (.+?) turns, or the turning circle smaller$/, "至少应为 $1 圈，或缩小调头空间"],
  [/^more than (.+?) turns, which is the turning circle$/, "应大于 $1 圈，即起点在调头空间之外"],
  [/^more than (.+?) turns, where bench (\d+) of this dragon folds$/, "应大于 $1 圈（$2 号板凳在该处折叠）"],
  [/^less than half of (“.+”) \((.+)\)$/, "应小于$1的一半（$2）"],
  [/^less than a quarter of (“.+”) \((.+)\)$/, "应小于$1的四分之一（$2）"],
  [/^at least ([^ ]+(?: [^ ]+)?)$/, "至少应为 $1"],
  [/^more than ([^ ]+(?: [^ ]+)?)$/, "应大于 $1"],
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

/** The same, in the words for a positive margin [m], with which benches in contact need not touch. */
export function sayNear(key, margin, values = {}) {
  return margin > 0 ? say(`${key}Near`, { margin, ...values }) : say(key, values);
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
