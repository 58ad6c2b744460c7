"""Known errors and the numbers that support them, in English and in Chinese."""

from __future__ import annotations

ERRORS = {
    "error_anticlockwise": ("The dragon goes anticlockwise, not clockwise.", "盘入方向为逆时针，应为顺时针。"),
    "error_equal_arcs": (
        "The handles are equal arcs apart, not chords: a rigid bench keeps the straight distance.",
        "相邻把手按弧长等距，应为弦长：刚性板凳保持的是直线距离。",
    ),
    "error_length_for_chord": (
        "The length of a bench was used as the distance of its handles: the overhang of 0.275 m at both ends was forgotten.",
        "把板长当作把手间距：忘记减去两端各 0.275 m。",
    ),
    "error_overhang_once": (
        "The overhang was subtracted at one end only: the distance of the handles is the length minus 2 x 0.275 m.",
        "只减去一端的 0.275 m：把手间距应为板长减 2 × 0.275 m。",
    ),
    "error_head_as_body": ("The head bench was taken for a body bench of 2.20 m.", "把龙头当作 2.20 m 的龙身。"),
    "error_body_as_head": (
        "All benches were given the length of the head, 3.41 m.",
        "所有板凳都取了龙头的板长 3.41 m。",
    ),
    "error_arc_of_circle": (
        "The angle was computed from ds = r dtheta, which holds on a circle: on the spiral ds = b sqrt(1 + theta^2) dtheta.",
        "角度由圆弧公式 ds = r dθ 得出：螺线上应为 ds = b√(1+θ²) dθ。",
    ),
    "error_arc_without_logarithm": (
        "The arc length lacks its logarithmic term: it is b/2 (theta sqrt(1 + theta^2) + asinh theta).",
        "弧长公式缺少对数项：应为 b/2·(θ√(1+θ²) + arsinh θ)。",
    ),
    "error_steady_angle": (
        "The angular speed of the start was kept: at a constant speed along the spiral it must grow inwards.",
        "角速度保持为初始值：沿螺线匀速时，越向内角速度越大。",
    ),
    "error_euler_steps": (
        "The angle was integrated by Euler's method in steps of 1 s: the closed form of the arc length is exact.",
        "角度用步长 1 s 的欧拉法积分：弧长有精确公式。",
    ),
    "error_rounded_early": ("A number was rounded before it was used: {what}.", "中间数值过早舍入：{what}。"),
    "error_other_start": (
        "The head starts on turn {turns}, not on turn 16 (8.8 m from the centre).",
        "龙头起点在第 {turns} 圈，应为第 16 圈（距中心 8.8 m）。",
    ),
    "error_shifted_time": (
        "Time 0 is wrong: all times are shifted by {shift} s.",
        "时间零点有误：所有时刻偏移 {shift} s。",
    ),
    "error_other_instant": ("The positions are those at {time} s.", "队伍处于 {time} s 时的位置。"),
    "error_ratio_inverted": (
        "The ratio of the two arcs is inverted: the first one's radius should be twice the second one's.",
        "两段圆弧的半径比颠倒：前一段半径应为后一段的 2 倍。",
    ),
    "error_equal_arcs_of_turn": ("Both arcs of the turn have the same radius.", "两段圆弧半径相等。"),
    "error_arcs_not_tangent": (
        "The arcs are semicircles on the line from entry to exit: they are tangent to each other, but not to the spirals.",
        "圆弧是以进出点连线为直径的半圆：两弧相切，但与螺线不相切。",
    ),
    "error_wrong_centre": (
        "The centres of the arcs lie on the wrong side of the line from entry to exit.",
        "圆弧圆心位于进出点连线的错误一侧。",
    ),
    "error_equal_speeds": ("All handles have the speed of the head.", "所有把手速度都等于龙头速度。"),
    "error_forward_difference": (
        "The speeds are forward difference quotients with a step of {step} s.",
        "速度由向前差商得出，步长 {step} s。",
    ),
    "error_backward_difference": (
        "The speeds are backward difference quotients with a step of {step} s.",
        "速度由向后差商得出，步长 {step} s。",
    ),
    "error_central_difference": (
        "The speeds are central difference quotients with a step of {step} s.",
        "速度由中心差商得出，步长 {step} s。",
    ),
    "error_wrong_ring": (
        "A handle was put on the wrong ring: another root of the chord equation was taken.",
        "把手落在错误的一圈上：取了弦长方程的另一个根。",
    ),
    "error_time_steps": (
        "The contact was searched for in steps of {step} s: this is the first step after it.",
        "以 {step} s 为步长搜索：这是碰撞后的第一个时刻。",
    ),
    "error_time_steps_before": (
        "The contact was searched for in steps of {step} s: this is the last step before it.",
        "以 {step} s 为步长搜索：这是碰撞前的最后一个时刻。",
    ),
    "error_no_overhang": (
        "The rectangles end at the handles: the overhang of 0.275 m at both ends was forgotten.",
        "矩形只画到把手处：忘记两端各 0.275 m。",
    ),
    "error_loose_angle": (
        "The sum of angles counted as 360 degrees although {angle} degrees were missing: nothing touches at that time.",
        "角度和还差 {angle}° 时就当作 360°：此时并未碰撞。",
    ),
    "error_literal_corners": (
        "The corners follow equation 12 of a paper, which is printed with a wrong sign: they do not form a rectangle.",
        "顶点按论文公式 12 的印刷形式计算，符号有误：画出的不是矩形。",
    ),
    "error_pose_on_circle": (
        "Only the pose with the head on the circle was checked: benches touch earlier, on the way there.",
        "只检验了龙头位于圆上的一个时刻：在途中更早就会碰撞。",
    ),
    "error_pose_on_circle_head": (
        "Only the head was checked, and only in the pose on the circle: benches touch earlier, on the way there.",
        "只检验了龙头，且只在圆上的一个时刻：在途中更早就会碰撞。",
    ),
    "error_one_corner": (
        "Only the outer front corner of the head was checked, and only in the pose on the circle.",
        "只检验了龙头前外角，且只在圆上的一个时刻。",
    ),
    "error_pitch_time_steps": (
        "The way to the circle was checked in steps of {step} s, which miss the closest graze.",
        "以 {step} s 为步长检验途中，跨过了最险的擦碰。",
    ),
    "error_pitch_steps": (
        "The pitch was searched for in steps: this is the first feasible one of them.",
        "以固定步长搜索螺距：这是其中第一个可行值。",
    ),
    "error_truncated": (
        "The number was cut off after {decimals} decimals: it is smaller than the minimum pitch, so benches touch.",
        "数值在第 {decimals} 位小数后被截断：小于最小可行螺距，会发生碰撞。",
    ),
    "error_speed_time_steps": (
        "The highest speed was searched for in steps of {step} s, which miss its peak.",
        "以 {step} s 为步长寻找最高速度，错过了峰值。",
    ),
    "error_other_entry": (
        "The turn begins inside the circle, {entry} m from the centre, not on its edge at 4.5 m.",
        "调头起点在圆内，距中心 {entry} m，而不是在 4.5 m 的边界上。",
    ),
    "other_turn": (
        "This is the shortest turn with the ratio {ratio} : 1, entered inside the circle; the turn from its edge has {length} m.",
        "这是半径比为 {ratio} : 1、在圆内更深处进入的最短调头曲线；从圆的边界进入时，问题 4 的曲线长 {length} m。",
    ),
    "evidence": (
        "{sheet}: recomputed with this error, {share} % of the {count} wrong cells agree within {tolerance} {unit}; their largest distance from the right values is {worst} {unit}.",
        "{sheet}：按此错误重新计算，{count} 个错误单元格中 {share} % 在 {tolerance} {unit} 内吻合；与正确值最多相差 {worst} {unit}。",
    ),
    "evidence_behind": (
        "At {time} s handle {handle} is {chord} m from the one before, as it should be, but {way} m behind it along the path instead of {right} m; {count} links in all are wrong.",
        "{time} s 时，{handle} 号把手与前一把手相距 {chord} m（正确），但沿曲线落后 {way} m，应为 {right} m；共 {count} 处有误。",
    ),
    "evidence_in_front": (
        "At {time} s handle {handle} is {chord} m from the one before, as it should be, but {way} m in front of it along the path instead of {right} m behind; {count} links in all are wrong.",
        "{time} s 时，{handle} 号把手与前一把手相距 {chord} m（正确），但沿曲线超前 {way} m，应落后 {right} m；共 {count} 处有误。",
    ),
    "gives_on_grid": (
        "Recomputed with this error the number is {gives} {unit}, and the next step of {grid} {unit} is {value} {unit}; the right value is {right} {unit}.",
        "按此错误重新计算得 {gives} {unit}，以 {grid} {unit} 为步长的下一个值为 {value} {unit}；正确为 {right} {unit}。",
    ),
    "gives": (
        "Recomputed with this error the number is {gives} {unit}; the given value is {value} {unit}, the right value {right} {unit}.",
        "按此错误重新计算得 {gives} {unit}；所给为 {value} {unit}，正确为 {right} {unit}。",
    ),
}
