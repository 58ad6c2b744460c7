"""The paper's numbers, the reasons for their differences and the evidence, in English and in Chinese."""

from __future__ import annotations

PAPER = {
    "paper_title": ("The paper beside this program", "论文与本程序对照"),
    "paper_others": ("Other publications", "其他论文"),
    "paper_quantity": ("quantity", "数值"),
    "paper_paper": ("paper", "论文"),
    "paper_published": ("published", "发表值"),
    "paper_ours": ("here", "本程序"),
    "paper_difference": ("difference", "差"),
    "paper_unknown": ("No known shortcut gives it.", "没有已知的简化做法得出该数值。"),
    "paper_length": ("arc length of the spiral", "螺线弧长"),
    "paper_length_at": ("eq. 2", "式 2"),
    "paper_length_why": ("The same, to the paper's six decimals.", "在论文给出的六位小数内相同。"),
    "paper_time": ("time of first contact", "首次碰撞时刻"),
    "paper_time_at": ("figure 7", "图 7"),
    "paper_time_why": (
        "The paper's rule adds angles and calls 360 degrees a collision. Near an edge the sum nears 360 degrees without a contact: it passes {angle:g} degrees at {loose:.2f} s, where benches {a} and {b} are {gap:.1f} mm apart. Rounding such a sum up to 360 gives the paper's time.",
        "论文的判据把夹角相加，等于 360° 即判为碰撞。靠近边缘时，未碰撞的夹角和也接近 360°：它在 {loose:.2f} s 超过 {angle:g}°，此时板凳 {a} 与 {b} 相距 {gap:.1f} mm。把这样的和进位为 360 就得到论文的时刻。",
    ),
    "paper_time_largest": ("largest angle sum at the paper's time", "论文所给时刻的最大夹角和"),
    "paper_time_loose": ("first time of an angle sum of {angle:g} degrees", "夹角和首次达到 {angle:g}° 的时刻"),
    "paper_time_gap": ("clearance at the paper's time, benches {a} and {b}", "论文所给时刻板凳 {a} 与 {b} 的净距"),
    "paper_time_exact": ("first time of an angle sum of 360 degrees", "夹角和首次达到 360° 的时刻"),
    "paper_time_literal": (
        "the same with eq. 12 as printed: w/2 cos theta of the wrong sign in all four y",
        "同上，按印出的式 12：四个 y 中 w/2·cos θ 的符号均有误",
    ),
    "paper_radius": ("radius of the head at first contact", "首次碰撞时龙头的极径"),
    "paper_radius_at": ("section 3.3", "第 3.3 节"),
    "paper_radius_why": (
        "The paper's own numbers exclude each other: at its {time:g} s the head is at {radius:.3f} m, and it passes {paper:g} m at {passed:.2f} s. No reading was found that gives the paper's number.",
        "论文自己的数值互相矛盾：在其 {time:g} s 时龙头的极径为 {radius:.3f} m，而龙头在 {passed:.2f} s 经过 {paper:g} m。未找到能得出论文数值的解读。",
    ),
    "paper_radius_there": ("radius of the head at the paper's time", "论文所给时刻龙头的极径"),
    "paper_radius_passed": ("time at which the head passes the paper's radius", "龙头经过论文所给极径的时刻"),
    "paper_pitch": ("minimum pitch", "最小螺距"),
    "paper_pitch_at": ("section 3.3", "第 3.3 节"),
    "paper_pitch_why": (
        "The paper bisects the radius of first contact towards {circle:g} m, but that radius jumps from {below:.3f} to {above:.3f} m at a pitch of {jump:.7f} m: none gives {circle:g} m, so the error that it drives to 1e-10 cannot vanish. At the paper's pitch the head gets to {reached:.3f} m, well inside the circle. No reading was found that gives the paper's number.",
        "论文对首次碰撞的极径向 {circle:g} m 作二分，但该极径在螺距 {jump:.7f} m 处从 {below:.3f} m 跳到 {above:.3f} m：没有螺距恰好给出 {circle:g} m，所以要降到 1e-10 的误差不可能消失。按论文的螺距，龙头能到达 {reached:.3f} m，远在圆内。未找到能得出论文数值的解读。",
    ),
    "paper_pitch_jump": ("pitch at which a bisection of the radius ends", "对极径二分所终止的螺距"),
    "paper_pitch_below": ("radius of first contact just below it", "螺距略小于该值时首次碰撞的极径"),
    "paper_pitch_above": ("radius of first contact just above it", "螺距略大于该值时首次碰撞的极径"),
    "paper_pitch_reached": ("radius of first contact at the paper's pitch", "论文所给螺距下首次碰撞的极径"),
    "paper_pitch_alone": (
        "largest pitch at which the pose on the circle alone touches",
        "仅看龙头在圆上时的位形，仍有碰撞的最大螺距",
    ),
    "paper_pitch_head": (
        "the same with the pairs of the head only, as in eqs. 14-17",
        "同上，只考虑含龙头的板凳对（式 14-17）",
    ),
}
