/** The sentences of this page in English and in Simplified Chinese. {names} are numbers to drag or numbers of the answers. */

export const WORDS = {
  title: ["How it works", "原理"],
  intro: [
    "In a bench dragon everybody's place follows from the place of the head. So a computation can say not only what will probably happen in the dance, but what must happen. Five ideas carry all the answers. Drag the blue numbers, or move them with the arrow keys: each figure asks the same service that draws the dance.",
    "板凳龙里，龙头在哪里，其余每个人的位置就随之确定。所以计算给出的不只是“大概会怎样”，而是“必定会怎样”。全部答案都建立在下面五个想法上。蓝色的数字可以拖动，也可以用方向键调整：每幅图都在向画出舞龙画面的同一个服务提问。",
  ],
  metre: ["m", "m"],
  centimetre: ["cm", "cm"],
  second: ["s", "s"],
  turns: ["turns", "圈"],
  time_axis: ["time [s]", "时间 [s]"],
  gap_axis: ["least gap [mm]", "最小间距 [mm]"],
  pitch_axis: ["pitch [m]", "螺距 [m]"],
  radius_axis: ["head stops at [m]", "龙头止步半径 [m]"],
  turning_circle: ["turning circle", "调头空间"],
  lost: ["The service does not answer; the figure is older than your numbers. Next try in {seconds} s.", "服务没有响应，图形早于当前数值。{seconds} 秒后重试。"],
  trying: ["The service does not answer; the figure is older than your numbers. Trying again now.", "服务没有响应，图形早于当前数值。正在重试。"],

  chord_title: ["One chord after another", "一个孔距接一个孔距"],
  chord_lead: [
    "Every handle walks on the same spiral, and each bench keeps two handles at a fixed distance: its chord. A circle of {chord} around the first handle meets the spiral behind it; there the second handle stands. From the second handle the next chord leads to the third, and so on to the tail.",
    "所有把手都走在同一条螺线上，每节板凳让两个把手保持固定的距离，即孔距。以第一个把手为圆心、{chord} 为半径作圆，圆与它身后的螺线相交，第二个把手就在那里。从第二个把手再量一个孔距，便是第三个，如此直到龙尾。",
  ],
  chord_verdict: [
    "The second handle is at ({x}, {y}). While the head moves at 1 m/s, this handle moves at {speed}.",
    "第二个把手在 ({x}, {y})。龙头以 1 m/s 前进时，它的速度是 {speed}。",
  ],
  chord_more: [
    "The circle meets other rings too, but only the first meeting along the spiral counts: no handle jumps to another ring. Speeds need no differences in time. A bench does not stretch, so both its handles are equally fast along it, and each one's direction is known. Now let the head stand {turns} from the centre and pull the chord longer: too far in, the circle no longer finds its first meeting. The bench folds, and the dance ends there.",
    "圆还会与别的圈相交，但只有沿螺线的第一个交点算数：把手不会跳到另一圈上。速度也不靠时间差分求得：板凳不会伸缩，所以两个把手沿板凳方向的分速度相等，而各自的行进方向是已知的。现在让龙头停在离中心 {turns}处，再把孔距拉长：太靠里时，圆再也找不到那第一个交点。板凳折叠，舞龙到此为止。",
  ],
  chord_refused: ["The bench folds here: the circle no longer finds its first meeting.", "板凳在此折叠：圆再也找不到第一个交点。"],
  chord_first: ["head", "龙头"],
  chord_second: ["second handle", "第二个把手"],
  chord_dial_chord: ["Chord of the head bench", "龙头的孔距"],
  chord_dial_turns: ["Place of the head in turns from the centre", "龙头离中心的圈数"],
  chord_alt: ["The head of the dragon on its spiral; a circle around the first handle meets the spiral at the second", "螺线上的龙头；以第一个把手为圆心的圆与螺线相交于第二个把手"],

  staircase_title: ["A staircase with jumps", "带跳跃的阶梯"],
  staircase_lead: [
    "How far in does the dragon get before two benches touch? At a pitch of {pitch} the head stops {radius} from the centre: there {a} touches {b}.",
    "两节板凳相碰之前，龙能盘进多深？螺距为 {pitch} 时，龙头止步于离中心 {radius} 处：{a}与{b}在此相碰。",
  ],
  staircase_verdict: [
    "A wider spiral mostly lets the head further in, but not smoothly. Compare {pitch=0.4503} with {pitch=0.4504}: a tenth of a millimetre more, and the head gets 17 cm further. At the smaller pitch a corner just catches another bench. At the larger one it just passes, and the next contact comes much later.",
    "螺距加大，龙头一般能盘得更深，但并不平滑。比较 {pitch=0.4503} 与 {pitch=0.4504}：只多十分之一毫米，龙头却多进了 17 cm。螺距较小时，一个板角恰好碰到另一节板凳；较大时恰好擦过，下一次碰撞要晚得多。",
  ],
  staircase_more: [
    "So no pitch near here lets the head stop at 4.5 m, on the edge of the turning circle. A search that halves an interval of pitches until that radius is 4.5 m looks for something that does not exist. The service asks another question: at which pitch does the least gap on the whole way to the circle just reach zero? The answer is {least}, and every larger pitch is proven to be free as well.",
    "因此在这附近，没有哪个螺距能让龙头正好停在 4.5 m 处，即调头空间的边界上。若对螺距二分，想凑出 4.5 m 这个半径，找的就是并不存在的东西。服务换了一个问法：螺距为多少时，到达调头空间之前全程的最小间距恰好为零？答案是 {least}，并且已证明更大的螺距也都可行。",
  ],
  staircase_dial_pitch: ["Pitch of the spiral", "螺线的螺距"],
  staircase_alt: ["Where the head stops against the pitch, a staircase with jumps, and the dragon at first contact", "龙头止步半径随螺距变化的带跳跃阶梯，以及首次碰撞时的板凳龙"],

  step_title: ["Steps that are proofs", "每一步都是证明"],
  step_lead: [
    "Suppose that we know how far the nearest benches are apart at {time}, and again {length} later. May they have touched in between? A gap cannot change its direction at will: its second derivative is bounded, here by {bound}. So between the two instants it stays above the sagging curve.",
    "假设已知 {time} 时最近两节板凳的间距，也知道再过 {length} 时的间距。这中间它们会不会碰过？间距不能随意掉头：它的二阶导数有界，此处不超过 {bound}。因此在两个时刻之间，间距总在那条下垂的曲线之上。",
  ],
  step_verdict: ["{said}", "{said}"],
  step_0: [
    "Here the benches are so far apart that a formula settles the whole interval without a step: no touch is possible in it.",
    "这里板凳相距很远，一个公式就能判定整个区间：其中不可能相碰。",
  ],
  step_1: [
    "The sagging curve stays above zero: no touch is possible in this interval. The service proves it in one step.",
    "下垂的曲线始终在零以上：这个区间内不可能相碰。服务一步就证明了它。",
  ],
  step_2: [
    "The sagging curve dips below zero, so one step over this interval would prove nothing. The service takes {steps} shorter steps, each of them a proof: no touch is possible in this interval either.",
    "下垂的曲线降到零以下，所以一步跨过这个区间什么也证明不了。服务改走 {steps} 个更短的步，每一步都是证明：这个区间内同样不可能相碰。",
  ],
  step_contact: [
    "Two benches touch in this interval, at {time} s. Until then the steps prove that nothing touches.",
    "这个区间内有两节板凳相碰，在 {time} s。在此之前，各步证明没有相碰。",
  ],
  step_more: [
    "In this way the service walks through the dance: in long steps where benches are far apart, in short ones where they are near. First contact of the contest's dance, at {contact}, takes {all} steps. No contact is missed, not even a very short one.",
    "服务就这样走完整场舞：板凳相距远时步子长，离得近时步子短。赛题中的首次碰撞在 {contact}，只需 {all} 步。无论碰撞多么短暂，都不会被跨过去。",
  ],
  step_dial_time: ["Start of the interval", "区间起点"],
  step_dial_length: ["Length of the interval", "区间长度"],
  step_alt: ["The least gap over time, and under it the lowest curve that the bound allows", "最小间距随时间的变化，以及其下方由上界允许的最低曲线"],

  graze_title: ["Why sampling misses a graze", "取样为什么会漏掉擦碰"],
  graze_lead: [
    "It seems easier to look every {step} whether benches overlap. At a pitch of {pitch} that makes {count} looks in this figure. {looked}",
    "每隔 {step} 看一眼板凳是否重叠，似乎更省事。螺距为 {pitch} 时，图中共看 {count} 次。{looked}",
  ],
  graze_missed: ["Each one finds all benches apart.", "每一次看到的板凳都是分开的。"],
  graze_seen: ["In {seen} of them benches overlap.", "其中有 {seen} 次看到板凳重叠。"],
  graze_verdict: ["What really happens is the curve: {truth}", "真实的过程是这条曲线：{truth}"],
  graze_touch: ["two benches touch at {time} s, and then overlap by up to {depth} mm.", "{time} s 时两节板凳相碰，随后重叠最多达 {depth} mm。"],
  graze_free: ["nothing touches in the figure; first contact comes at {time} s.", "图中没有相碰；首次碰撞在 {time} s。"],
  graze_more: [
    "Look every {step=0.4}, and this graze is found; but a pitch of {pitch=0.45033} hides it again, and so on for any interval. Nor does it help to halve an interval between “apart” and “overlapping”: benches that overlap may come apart and overlap again. A step that is a proof leaves no time between two looks.",
    "改为每隔 {step=0.4} 看一眼，这次擦碰就会被发现；但螺距换成 {pitch=0.45033}，它又躲了过去，如此没有尽头。在“分开”与“重叠”之间二分也无济于事：重叠的板凳会分开，然后再次重叠。而作为证明的步子，两眼之间不留任何空隙。",
  ],
  graze_dial_step: ["Time between two looks", "两次查看的间隔"],
  graze_dial_pitch: ["Pitch of the spiral", "螺线的螺距"],
  graze_alt: ["The least gap over time near a graze, with the instants at which somebody looks", "擦碰附近最小间距随时间的变化，以及查看的各个时刻"],

  stray_title: ["How far people may stray", "人可以偏离多远"],
  stray_lead: [
    "Nobody dances to the millimetre. Let every handle be up to {stray} away from its place, in any direction, at any time. Then each bench stays inside the pale band around it; as long as the bands are apart, nothing can touch.",
    "没有人能跳得分毫不差。设每个把手随时都可向任意方向偏离应在位置至多 {stray}。这样每节板凳都不会超出周围的浅色带；只要色带彼此分开，就不可能相碰。",
  ],
  stray_verdict: ["{said}", "{said}"],
  stray_safe: [
    "With this stray nothing can touch on the whole way to the turning circle: that is proven.",
    "在这样的偏离下，到达调头空间之前全程都不可能相碰：这已得到证明。",
  ],
  stray_between: ["This stray lies between the two numbers below: neither proven safe nor shown to touch.", "这一偏离介于下面两个数之间：既未证明安全，也未找到相碰的实例。"],
  stray_may: [
    "From {time} s on benches may touch. The dashed outlines show how: in one pose of the whole dragon these two do.",
    "从 {time} s 起可能相碰。虚线画出了相碰的方式：在全队的某个姿态中，这两节板凳确实相碰。",
  ],
  stray_more: [
    "At a pitch of {pitch} people may stray by {low}, but not by {high}. The first number is proven by the same steps, taken for bands instead of benches. The second is not an estimate but an example: a place for every handle, with every chord kept, in which two benches overlap. A wider spiral buys room: at {pitch=0.70} people may stray more than twice as far as at {pitch=0.55}.",
    "螺距为 {pitch} 时，每人可以偏离 {low}，但不能达到 {high}。第一个数由同样的步子证明，只是以色带代替板凳。第二个数不是估计，而是实例：给出每个把手的位置，所有孔距保持不变，而其中两节板凳重叠。螺线越宽，余地越大：螺距 {pitch=0.70} 时可偏离的距离是 {pitch=0.55} 时的两倍多。",
  ],
  stray_dial_stray: ["How far every handle may stray", "每个把手可偏离的距离"],
  stray_dial_pitch: ["Pitch of the spiral", "螺线的螺距"],
  stray_alt: ["The two benches that come nearest, with the bands that they may cover", "最接近的两节板凳，以及它们可能到达的色带"],

  end: [
    "These five ideas are in every “How it is known” of the dance. There each answer shows its bracket and its proof, and four engines that share no code judge each first contact.",
    "舞龙画面中的每个“依据”都来自这五个想法。那里的每个答案都给出所在的区间和证明，每次首次碰撞还由四种互不共用代码的引擎判定。",
  ],
};
