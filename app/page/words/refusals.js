/**
 * Refusals of the service as sentences for people. {word} stands for a value of the refusal, {word+1} for one more than
 * it, {field} for the label of the field, {unit} and {units} for its unit and the unit in words, {example} for a number.
 */

/** What stands for a place in a request, # for a number: [English, Chinese], with # for one more than the first number. */
export const PLACES = {
  file: ["The file", "文件"],
  path: ["The path", "路径"],
  venue: ["The square", "广场"],
  "path.start": ["“Head at time 0, along the path”", "“0 s 时龙头沿路径的位置”"],
  "path.radius": ["“Radius of corners”", "“转角半径”"],
  "venue.origin.latitude": ["“Latitude of x = y = 0”", "“原点的纬度”"],
  "venue.origin.longitude": ["“Longitude of x = y = 0”", "“原点的经度”"],
  "venue.features.#.properties.radius": ["The radius of thing #", "第 # 个图形的半径"],
  "venue.features.#.properties.name": ["The name of thing #", "第 # 个图形的名称"],
  "venue.features.#.geometry.coordinates.#.#.#": ["A coordinate of thing #", "第 # 个图形的坐标"],
  points: ["The list of points", "点的列表"],
  "path.points.#": ["A coordinate of point # of the path", "路径第 # 点的坐标"],
  "path.points.#.#": ["A coordinate of point # of the path", "路径第 # 点的坐标"],
  "dragon.names.#": ["The name of bench #", "第 # 节板凳的名称"],
  passages: ["“Slower, faster, pauses”", "“变速与停顿”"],
};

/** What a field must do: [English, Chinese]; without English, that of the service stands. */
export const RULES = {
  "be a number [{unit}]": ["be a number of {units}, such as {example}", "应为数字（单位 {unit}），例如 {example}"],
  "be a finite number [{unit}]": ["be a number of {units}, such as {example}", "应为数字（单位 {unit}），例如 {example}"],
  "be a number [{unit}] in digits, such as 0.4503": ["be a number of {units} in digits, such as 0.4503", "应为数字（单位 {unit}），例如 0.4503"],
  "be a number": [undefined, "应为数字"],
  "be a finite number": [undefined, "应为数字"],
  "be a whole number": ["be a whole number, such as {example}", "应为整数"],
  "be a number in metres": [undefined, "应为数字（单位 m）"],
  "be at least {least}": [undefined, "至少应为 {least}"],
  "be more than {least}": [undefined, "应大于 {least}"],
  "be at most {most}": [undefined, "最多为 {most}"],
  "be from {least} to {most}": [undefined, "应在 {least} 至 {most} 之间"],
  "be positive": [undefined, "应大于 0"],
  "be zero or more": [undefined, "应为 0 或更大"],
  "be smaller": [undefined, "应更小"],
  "be larger": [undefined, "应更大"],
  "be smaller, or the benches narrower": ["be smaller, or “Width”", "应更小，或减小“板宽”"],
  "be at least {least}, or the turning circle smaller": ["be at least {least}, or “Turning circle” smaller", "至少应为 {least}，或减小“调头空间直径”"],
  "be larger, or the pitch": [undefined, "应更大，或加大螺距"],
  "be larger than {given}": [undefined, "应大于 {given}"],
  "leave the arcs inside the circle": ["leave both arcs inside the turning circle", "应使两段圆弧留在调头空间内"],
  "be nearer to 1 than {given}": [undefined, "应比 {given} 更接近 1"],
  "be less than {gap}": [undefined, "应小于 {gap}"],
  "be at least 3, so that two share no handle": [undefined, "至少应为 3，否则没有两节不共用把手的板凳"],
  "be at least {least} to start outside the circle at a pitch of {pitch}": [undefined, "至少应为 {least}，才能在螺距为 {pitch} 时从圆外开始"],
  "be more than {least}, so that the coil begins outside the circle": [undefined, "应大于 {least}，即起点在调头空间之外"],
  "be more than {least}, where bench {bench} of this dragon folds": [undefined, "应大于 {least}（{bench}在该处折叠）"],
  "be less than half of {length} ({size} / 2 = {half})": [undefined, "应小于{length}的一半（{size} / 2 = {half}）"],
  "be less than a quarter of {body} ({length} / 4 = {quarter})": [undefined, "应小于{body}的四分之一（{length} / 4 = {quarter}）"],
  "be at most half the chord of bench {bench} ({most})": [undefined, "最多为{bench}孔距的一半（{most}）"],
  "be no wider than its {hole} ({size})": ["be no wider than its hole ({size})", "不得大于板孔直径（{size}）"],
  "be larger: no pitch up to {most} lets this dragon reach the circle": [undefined, "应更大：螺距直到 {most}，这支队伍都到不了这样的圆"],
  "allow pitches of {pitch} and more": [undefined, "应更大，使螺距可为 {pitch} 及以上"],
  "have at most {most} characters": [undefined, "最多为 {most} 个"],
  "have at most {most} entries": [undefined, "最多为 {most} 个"],
  "have at least {least} entries": [undefined, "至少应有 {least} 项"],
  "have at least {least} entry": [undefined, "至少应有 {least} 项"],
  "have at most {most} different sizes of benches with a stray of {stray}": [undefined, "离位为 {stray} 时，最多有 {most} 种不同尺寸"],
  "be one line of plain text": [undefined, "应为一行普通文字"],
  "be after the passage begins, at {begin}": [undefined, "应晚于该段开始的时刻（{begin}）"],
  "be further than where the passage begins, at {begin}": [undefined, "应超过该段开始的位置（{begin}）"],
  "be given": [undefined, "应填写时刻"],
  "be 0, for a pause, or at least {least}": [undefined, "应为 0（停顿），或至少为 {least}"],
};

const CHORD = ": the chord of bench {between} between them is {chord}, their overhangs {front} and {rear}";
const STRAIGHT = "on a straight line, and so on every wide enough spiral, benches {a} and {b} ";
const TURN = "in a turn that begins on the circle benches {a} and {b} ";
/** Contacts in a turn, in both languages. */
const NEAR = [
  ["touch", "相碰"],
  ["come within {margin}", "间距不超过 {margin}"],
  ["may touch with strays up to {stray}", "若离位达 {stray} 可能相碰"],
  ["may come within {margin} with strays up to {stray}", "若离位达 {stray}，间距可能不超过 {margin}"],
];
const ENDS = [
  ["bench {bench} folds", "{bench}已折叠"],
  ["the head is at the centre", "龙头已到达中心"],
];

/** What follows a rule, in Chinese. */
export const REASONS = {
  "lengths are in metres, and {cm} is {m}": "长度以米为单位，{cm} 即 {m}",
  "lengths are in metres": "长度以米为单位",
  "speeds are in metres per second": "速度以米每秒为单位",
  "angles are in radians": "角度以弧度为单位",
  "a pause does not reach {place}": "停顿应以时刻结束",
  "the turn bends to a radius of {bend}, and bench {bench} follows none below {least}": "调头的弯曲半径为 {bend}，而{bench}至少需要 {least}",
  "they are up to {extent} from its centre, more than {radius}": "圆弧距中心最远 {extent}，超过 {radius}",
  "a turn that begins on the circle bends to a radius of {bend}, too tight for the longest chord ({chord})": "自边界开始的调头弯曲半径为 {bend}，对最长的孔距（{chord}）过小",
  "the minimum pitch is {pitch}, and pitches are at most {most} here": "最小螺距为 {pitch}，而此处螺距最多为 {most}",
  "at a pitch of {pitch} the dance starts on that circle": "螺距为 {pitch} 时，起点就在该圆上",
  "at a pitch of {pitch} the dance starts inside that circle": "螺距为 {pitch} 时，起点在该圆内",
  [`${STRAIGHT}are {gap} apart${CHORD}`]: "在直线上，因而在足够宽的螺线上，{a}与{b}相距 {gap}",
  [`${STRAIGHT}touch${CHORD}`]: "在直线上，因而在足够宽的螺线上，{a}与{b}相碰",
  [`${STRAIGHT}may then touch`]: "在直线上，因而在足够宽的螺线上，{a}与{b}可能相碰",
  [`${STRAIGHT}may then come within {margin}`]: "在直线上，因而在足够宽的螺线上，{a}与{b}可能过近",
  [`at a pitch of {pitch} benches {a} and {b} touch, and on a straight line they are {gap} apart${CHORD}`]: "即使螺距为 {pitch}，{a}与{b}也相碰；在直线上两者相距 {gap}",
  [`at a pitch of {pitch} benches {a} and {b} are nearer than that, and on a straight line they are {gap} apart${CHORD}`]: "即使螺距为 {pitch}，{a}与{b}也过近；在直线上两者相距 {gap}",
  "in a turn that begins on the circle benches come so near to the margin of {margin} that it is not decided whether they keep it": "自边界开始调头时，板凳间距与 {margin} 过于接近，无法判定",
  ...Object.fromEntries(
    NEAR.flatMap(([english, chinese]) => [
      [`${TURN}${english} {time} after the entry at 1 m/s`, `自边界开始调头时，{a}与{b}在进入调头后 {time} ${chinese}`],
      [`${TURN}${english} {time} before the entry at 1 m/s`, `自边界开始调头时，{a}与{b}在进入调头前 {time} ${chinese}`],
    ]),
  ),
  ...Object.fromEntries(ENDS.map(([english, chinese]) => [`${english} at {end}, before the head is on that circle`, `龙头到达该圆之前，${chinese}（{end}）`])),
};

/** Ends of a dance, by their templates: [English, Chinese]. */
const OUTSIDE = [
  ["bench {bench} folds", "where {bench} folds", "{bench}折叠"],
  ["the path ends", "when the path ends", "路径结束"],
  ["the head is at the centre", "when the head is at the centre", "龙头到达中心"],
].flatMap(([end, english, chinese]) =>
  ["at most", "before"].map((until) => [
    `{field} must be ${until} {end}, when ${end}`,
    [`The dance ends at {end}, ${english}: there is no {got}`, `运动在 {end} 结束，此时${chinese}，没有 {got}`],
  ]),
);
const FAULTS = [
  ["a self-intersection", "自身相交"],
  ["a ring that touches itself", "边界碰到自身"],
  ["a hole outside the outer ring", "有孔位于边界之外"],
  ["a hole inside another hole", "有孔位于另一孔之内"],
  ["an inside cut in two by rings that touch", "内部被相碰的边界切成两块"],
  ["a ring of fewer than three different points", "不同的点少于三个"],
].map(([fault, chinese]) => [
  `venue: {polygon} must be a valid polygon, got ${fault} at {at}`,
  [`“{polygon}” is not a valid area: ${fault} at {at}. Move a corner near that place`, `“{polygon}”不是可用的区域：在 {at} 处${chinese}，请移动那里的一个角`],
]);
const NOTHING = ["The file holds no polygon, line or point", "文件中没有多边形、线或点"];
const TWO_POINTS = ["A path needs at least two points", "路径至少需要两个点"];
const UNPACKED = ["This KMZ file cannot be unpacked", "文件不是可以解压的 KMZ"];
const TOO_COMPLEX = [undefined, "文件过于复杂：请删去与场地无关的内容"];
const FULL = [undefined, "保存的任务已达上限：请删除不需要的任务"];
const GONE = [undefined, "任务已取消或结果已过期：请重新计算"];

/** Templates whose sentence is told as a whole, by their template: [English, Chinese]; without English, that of the service stands. */
export const WHOLE = {
  "within s": ["No answer was found within {then}, the time limit for one answer here. Take fewer benches, or try again later", "在一次回答允许的 {then} 内没有算完：请减少板凳节数，或稍后再试"],
  "within s file": ["The file was not read within {then}. Try again, or leave out everything that does not belong to the square", "文件在 {then} 内没有读完：请重试，或删去与场地无关的内容"],
  "within work": ["No answer was found within the work limit of one question. Take fewer benches", "在一个问题允许的计算量内没有算完：请减少板凳节数"],
  "instants x handles must be at most {most} here": ["There would be {got} instants times handles, and there may be {most} here. Take a larger step, a shorter time or fewer benches", "时刻数乘以把手数在此处最多为 {most}，现为 {got}，请加大步长、缩短时段或减少板凳"],
  "benches must be at most {most} here": ["“Benches” must be at most {most}; it is {got}. Shorten the dragon", "“板凳节数”最多为 {most}，现为 {got}（请缩短队伍）"],
  "{field} must be at least {least}, when the whole dragon is on the path": ["The whole dragon is on the path only from {least} on, which is later than {got}", "整条队伍自 {least} 起才都在路径上，{got} 早于该时刻"],
  ...Object.fromEntries(OUTSIDE),
  "{field} must be after start ({start})": ["The end, {got}, must be after the beginning, {start}", "终点时刻 {got} 应晚于起点时刻 {start}"],
  "{field} must not be before {start} ({begin})": ["The end, {got}, must be after the beginning, {begin}", "终点时刻 {got} 应晚于起点时刻 {begin}"],
  "{field} must be at least 2 points": TWO_POINTS,
  "{field} must have at least {least} entries (points)": TWO_POINTS,
  "{field} must be at least {least} from the point before it": ["Point {field.number} of the path lies on the point before it. Move one of them, or delete it", "路径的第 {field.number} 点与前一点重合：请移动或删除其中一个"],
  "{field} must not be where two straight legs turn back": ["At point {field.number} of the path two straight legs turn back. Make one of them a curve", "路径在第 {field.number} 点处由两段直线折返：请将其中一段改为曲线"],
  "{field} must not make the curve stop or turn on the spot, as between points {first} and {second}": ["Between its points {first+1} and {second+1} the path turns on the spot. Move one of them", "路径在第 {first+1} 点与第 {second+1} 点之间原地折返：请移动其中一个"],
  "{field} is too short for the whole dragon, which takes {least} of it from handle 0 to handle {last} (more along bends)": ["The path is too short: it is {got~} m long, and the dragon takes {least~} m of it, more along bends. Draw it longer, or take fewer benches", "路径太短：长 {got~} m，而队伍要占 {least~} m（弯道处更多）。请延长路径或减少板凳节数"],
  "{field} must not bend tighter than a radius of {least} for the chord of bench {bench} ({chord}), got {bend} near {at}, s = {s}": ["The path bends too tightly near {at}: its radius is {bend}, and {bench} needs {least}", "路径在 {at} 附近弯得过急：半径为 {bend}，而{bench}至少需要 {least}"],
  "the joint of {before} and {after} must close": ["The pieces of the path do not join smoothly at {at}", "路径的各段在 {at} 处没有平滑相接"],
  "the joint of {before} and {after} must be smooth": ["The pieces of the path do not join smoothly at {at}", "路径的各段在 {at} 处没有平滑相接"],
  ...Object.fromEntries(FAULTS),
  "venue: a ring of {polygon} must be closed and have at least 4 points": ["“{polygon}” needs at least three corners", "“{polygon}”至少需要三个角"],
  "{field} must have at most {most} edges": ["The square and its obstacles have {got} edges, and may have at most {most} together. Leave out what the dance does not need", "广场与障碍物合计最多 {most} 条边，现为 {got} 条：请删去与表演无关的内容"],
  "{field} must give each polygon its own name, got {polygon} twice": ["Two things are named “{polygon}”. Give one of them another name", "有两个图形都叫“{polygon}”：请改掉其中一个的名称"],
  "{field} must hold at least one polygon, the square": ["The square is missing. Draw it as an area", "缺少广场：请将其绘制为区域"],
  "{field} must be a time of day such as 19:30 or 19:30:15": ["A time of day is like 19:30 or 19:30:15", "时刻的格式为 19:30 或 19:30:15"],
  "marks must be at most {most} here": ["The path is too long for chalk marks: there would be {got} of them, and there may be {most}", "路径过长：将有 {got} 个粉笔标记，最多可有 {most} 个"],
  "{field} must be known for KML, which is in degrees": ["KML needs a place on earth, which a Route has if its latitude and longitude are given. Keep GeoJSON or DXF otherwise, which are in metres", "KML 需要地球上的位置：只有“路线”可以填写纬度和经度；否则请改存以米为单位的 GeoJSON、DXF"],
  "{field} must be GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON": ["This file cannot be read here. Save it as GeoJSON, KML, KMZ or DXF, or as a dance in TOML or JSON", "无法读取此文件：请存为 GeoJSON、KML、KMZ 或 DXF，或 TOML、JSON 格式的舞龙文件"],
  "Send a map as the body: GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON.": ["The file is empty", "文件是空的"],
  "{field} must hold a map: GeoJSON, KML, DXF, or a dance as TOML or JSON": ["The file is empty", "文件是空的"],
  "{field} must be JSON without a fault": ["The file is not valid JSON", "文件不是正确的 JSON"],
  "{field} must be DXF as text": ["The file is a binary DXF. Save it as ASCII DXF", "文件是二进制 DXF：请存为 ASCII DXF"],
  "{field} must be DXF": ["The file is a DWG. Save it as DXF", "文件是 DWG：请存为 DXF"],
  "{field} must be DXF that can be read": ["The DXF file cannot be read. Save it again as ASCII DXF", "无法读取此 DXF 文件：请重新存为 ASCII DXF"],
  "{field} must state its unit": ["The drawing states no unit, and is {across} across, which cannot be metres. Set its unit, or scale it to metres", "图纸未注明单位，且宽达 {across} 个单位，不可能以米计：请注明单位（如毫米），或换算为米"],
  "{field} must be KML": ["The file is XML, but not KML", "文件是 XML，但不是 KML"],
  "{field} must be KML, got {fault} in line {line}": ["The KML has a fault in line {line}: {fault}", "KML 文件第 {line} 行有误"],
  "file must not have a document type or entities: save it again as plain KML": ["The file has a document type or entities. Save it again as plain KML", "文件含文档类型或实体声明：请重新存为普通 KML"],
  "{field} must be a KMZ file that can be unpacked": UNPACKED,
  "{field} must be a KMZ file with a .kml document": UNPACKED,
  "{field} must hold a polygon, a line or a point": NOTHING,
  "{field} must be a list with at least one entry": NOTHING,
  "{field} must hold a path with at least two points {apart} apart": [undefined, "文件中的路径至少应有两个相距 {apart} 的点"],
  "{field} must draw at most {most} entities, counting a block at each use": [undefined, "图纸最多可有 {most} 个图元：请删去与场地无关的内容"],
  "{field} must hold at most {features} features with {points} points in all": [undefined, "地图最多可有 {features} 个图形、共 {points} 个点：请删去与场地无关的内容"],
  "{field} must be at most {most} across, got about {across}": ["The map is about {across} across: leave out what is not near the square, at most {most}", "地图宽约 {across}，最多为 {most}：请删去远离广场的内容"],
  "{field} must have longitudes within 180 and latitudes within 90 degrees": ["Longitudes go to 180° and latitudes to 90°: they may be swapped in this file, where longitude comes first", "经度应在 ±180° 以内，纬度应在 ±90° 以内：文件中两者可能颠倒，应先经度、后纬度"],
  "{field} must have coordinates such as 120.1,30.2 in degrees": [undefined, "坐标应如 120.1,30.2（度），现为“{got}”"],
  "{file} must describe a path": ["The path in the file is not valid: it needs at least two points, each with two coordinates", "文件中的路径不可用：至少需要两个点，每点两个坐标"],
  "{field} must be a position of two numbers": ["A position in the file is not a pair of numbers", "文件中有一处坐标不是两个数字"],
  "{field} must be in metres, got what looks like longitude and latitude, a square of {width} by {height}, narrower than a bench of {length}": ["The square is only {width} by {height} m large: its coordinates look like longitude and latitude", "广场只有 {width} × {height} m：其坐标像是经纬度"],
  "{field} must be in metres, got what looks like latitude and longitude in that order, a square of {width} by {height}, narrower than a bench of {length}": ["The square is only {width} by {height} m large: its coordinates look like latitude and longitude", "广场只有 {width} × {height} m：其坐标像是经纬度，且纬度在前"],
  "{field} must not nest elements deeper than {most}": TOO_COMPLEX,
  "{field} must not nest objects deeper than {most}": TOO_COMPLEX,
  "{field} must unpack to at most {most} bytes": TOO_COMPLEX,
  "{field} must draw no line of more than {most} points": TOO_COMPLEX,
  "The body must be at most {most} bytes": ["The file is longer than {most} bytes", "文件超过 {most} 字节"],
  "The service failed on this request; its log has the reason.": [undefined, "服务在处理这一请求时出错，原因见其日志"],
  "The limit of {most} at once is reached": ["The service is busy with {most} computations: try again in {seconds}", "服务正忙（已有 {most} 个计算），请 {seconds} 后再试"],
  "Your limit of {most} at once is reached": ["You have {most} computations running: try again in {seconds}", "您已有 {most} 个计算在进行，请 {seconds} 后再试"],
  "Your limit of {most} is reached": ["You have {most} unfinished jobs, which is the limit: wait for one, or dismiss it", "您有 {most} 个任务未完成，已达上限：请等待或取消一个"],
  "The limit of {most} is reached": ["The service keeps {most} jobs, which is the limit: remove some, or try again later", "保存的任务已达上限：请删除不需要的任务"],
  "Your limit of {most} and {bytes} is reached": ["You keep as many jobs or results as you may, and the latest stays for ten minutes: remove some, or try again later", "您保存的任务或结果已达上限，最新的结果会保留十分钟：请删除一些，或稍后再试"],
  "Jobs and uploads need the token of this service: send the header Authorization: Bearer TOKEN.": ["Jobs and uploads need the token of this service: give it below, at “Token, if this service needs one”", "该服务的任务与上传需要令牌：请在下方“服务要求令牌？”处填写"],
  "This service has no token, so it lists no jobs: keep the address that Location gave you.": ["This service has no token, so it lists no jobs", "该服务未设令牌，因此不列出任务"],
  "This service takes no jobs: {why}.": [undefined, "该服务不接受任务"],
  "The kept jobs take all the room that they may have": FULL,
  "The store of the jobs failed ({why}): try again.": [undefined, "任务的存储出错，请重试"],
  "There is no job {job}: it was removed, it has expired, or its ID is wrong.": [undefined, "没有这个任务：它已被删除或已过期"],
  "The job was dismissed: there is no result, ask the question again.": GONE,
  "The result has expired: there is no result, ask the question again.": GONE,
  "The result gave way to newer jobs: there is no result, ask the question again.": GONE,
  "The job took longer than {most}, the limit here: ask for less.": [undefined, "任务超过了此处允许的 {most}：请缩小问题"],
  "The answer has {size} bytes, the limit for a kept one is {most}: ask for less.": [undefined, "答案有 {size} 字节，最多可保存 {most} 字节：请缩小问题"],
  "The job needs more memory than {most} bytes, the limit here: ask for less.": [undefined, "任务需要的内存超过 {most} 字节：请缩小问题"],
  "The service failed on this job; its log has the reason.": [undefined, "服务在处理这一任务时出错，原因见其日志"],
  "must be the names of columns name,length,width,overhang": ["The first line names the columns: name,length,width,overhang", "首行应为各列名称：name,length,width,overhang"],
  "must be the first bench, the head": ["The first bench, the head, is missing here", "此处缺少第一节板凳，即龙头"],
  "must have {count} entries, as the first line has": ["The number of entries is {got}, and {count} in the first line", "有 {got} 项，而首行有 {count} 项"],
  "a column must be named once": ["The column “{got}” appears twice", "列“{got}”重复"],
  "a column must be name, length, width or overhang": ["The column “{got}” is unknown: use name, length, width and overhang", "列“{got}”不可识别，应为 name、length、width 或 overhang"],
  "the column {column} is missing": [undefined, "缺少 {column} 列"],
  "overhang must be less than half of the length, {length}": ["The overhang must be less than half of the length, {length}; it is {got}", "孔心距板头应小于板长的一半（{length}），现为 {got}"],
  "{field} must end at until_s [m] or at until_time [s]": ["A passage ends at a place or at a time", "每段应以位置或时刻之一结束"],
  "designs must be at most {most} here": ["A sweep may have at most {most} designs here, and this one has {got}", "一次最多计算 {most} 个方案，现为 {got} 个"],
  "{field} must have at least {least} entry (over)": ["Choose a parameter", "请选择一个参数"],
  "{field} is unknown here": [undefined, "“{field}”不可识别"],
  "HTTP {status}": ["The service answered with HTTP {status} and gave no reason", "服务的回答为 HTTP {status}，没有说明原因"],
};
