"""Claims in Chinese; the page has the same sentences (app/page/proofs.js)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from core.claims.claim import (
    BenchBetween,
    Claim,
    ClaimKind,
    ContactClaim,
    DanceSummary,
    DragonSummary,
    EncounterClaim,
    GroundClaim,
    PartSummary,
    ProbabilityClaim,
    StrayClaim,
    format_safe,
)
from core.dance import EndReason
from core.display import format_range
from core.errors import format_number
from core.passages import Passage
from core.paths.path import PathSummary

PAIRS = "不共用把手的任何两节板凳"
PROOF = (
    "逐步证明：每一步以固定在板凳上的轴向间距的二阶导数界为据，外圈以闭式的环间距界为据；以双精度计算，并计入舍入误差。"
)
NO_PAIR = "少于三节时，没有两节不共用把手的板凳。"
TRIED = "以双精度计算，并计入舍入误差。"
MEASURED = "在该时刻以双精度测得。"
ENDS = {
    EndReason.FOLD: "；此时有板凳折叠，运动结束。",
    EndReason.CENTRE: "；此时龙头到达中心。",
    EndReason.END: "；此时路径结束。",
    EndReason.STOP: "；搜索到此为止。",
}
ENCOUNTERS = (
    "按时间逐步对全部板凳证明：每一步以固定在板凳上的轴向间距的二阶导数界为据，同一螺线的外圈以闭式的环间距界为据；"
    "以双精度计算，并计入舍入误差。"
)
ONE_DRAGON = "只有一条龙，没有可比较的板凳。"
PERFORMANCE_ENDS = {
    EndReason.FOLD: "；此时有板凳折叠，表演结束。",
    EndReason.END: "；此时最后一条路径结束。",
    EndReason.STOP: ENDS[EndReason.STOP],
}
HULLS = "对板凳此时可能占据的全部位置的凸包逐步证明，方法与首次碰撞相同；以双精度计算，并计入舍入误差。"
BETWEEN = {
    None: "",
    BenchBetween.HELD: "中间只隔一节的两节板凳由中间那节撑开：由把手间的距离证明。",
    BenchBetween.UNUSED: "起限制作用的两节板凳中间只隔一节，此处未计入那一节的作用，视两者独立离位，因此所得离位偏小。",
}
PIECES = {"line": "直线", "arc": "圆弧", "coil": "螺线", "clothoid": "回旋曲线", "waypoints": "过点曲线"}


def contact(claim: ContactClaim) -> str:
    proof = PROOF if claim.dance.dragon.benches > 2 else NO_PAIR
    return _search(claim, _dance(claim.dance), (PAIRS, PAIRS), ENDS, proof)


def encounter(claim: EncounterClaim) -> str:
    parts = "；".join(_part(k, part) for k, part in enumerate(claim.parts))
    parts = parts or f"{claim.part_count} 条龙，共 {claim.bench_count} 节板凳"
    pairs = ("不同龙的板凳", "不同龙的任何两节板凳")
    return _search(claim, parts, pairs, PERFORMANCE_ENDS, ENCOUNTERS if claim.part_count > 1 else ONE_DRAGON)


def _search(
    claim: ContactClaim | EncounterClaim,
    scene: str,
    pairs: tuple[str, str],
    ends: Mapping[EndReason, str],
    proof: str,
) -> str:
    """The claim of a search.

    scene: what dances; pairs: which benches it judges, without and with a result; ends, proof: words of such a search
    """
    start, may = format_number(claim.start), "可能" if claim.stray else ""
    within = f"间距{may}小于 {format_number(claim.margin)} m"
    if claim.kind is ClaimKind.CONTACT_AT_START:
        fact, proof = f"{_pair(claim)}{within if claim.margin else f'{may}相碰'}。", MEASURED
    elif claim.clear_until is None:
        before = (
            f"在 {format_number(claim.time)} s（届时 {_benches(claim)}相碰或过近）之前，"
            if claim.time is not None
            else ""
        )
        fact, proof = f"自 {start} s 起，{before}无法判定{pairs[0]}是否相碰或过近。", TRIED
    else:
        apart = f"间距都不小于 {format_number(claim.margin)} m" if claim.margin else "都不相碰"
        then = _end(claim, ends) or f"；{_pair(claim)}{within if claim.margin else f'{may}重叠'}。"
        fact = f"{start} s 至 {format_number(claim.clear_until)} s，{pairs[1]}{apart}{then}"
    strayed = f"只要每个孔离其位置不超过 {format_number(claim.stray)} m 且每节孔距不变，"
    return f"{scene}：{strayed if claim.stray else ''}{fact}{proof}"


def stray(claim: StrayClaim) -> str:
    dragon = claim.dance.dragon
    long, wide = (format_range(sizes, "m").replace(" to ", " 至 ") for sizes in (dragon.lengths, dragon.widths))
    span = f"{format_number(claim.start)} s 至 {format_number(claim.stop)} s"
    danced = f"{dragon.benches} 节板凳（长 {long}，宽 {wide}）{_path(claim.dance.path)}：{span}，"
    if claim.kind is ClaimKind.NO_SAFE_STRAY:
        touching = f"各在原位时，板凳已相碰{'或碰到场地边缘' if claim.venue else ''}。"
        return f"{danced}没有已知安全的离位：{touching if claim.touches else '对任何离位都未能证明。'}"
    edge = "，也不会碰到场地边缘" if claim.venue else ""
    strayed = f"只要每个孔离其位置不超过 {format_safe(claim.stray)} m 且每节孔距不变"
    return f"{danced}{strayed}，{PAIRS}都不会相碰{edge}。{HULLS}{BETWEEN[claim.between]}"


def probability(claim: ProbabilityClaim) -> str:
    words = (
        f"从模型中随机抽取的 {claim.samples} 次舞龙里，有 {claim.contacts} 次在 {claim.instants} 个相隔 "
        f"{format_number(claim.step)} s 的时刻之一有不共用把手的两节板凳相碰；两个时刻之间不作判断。上下限由 "
        "Clopper–Pearson 方法得出：无论模型的概率是多少，至多有 "
        f"{100.0 * (1.0 - claim.confidence):.3g} % 的种子使它落在上下限之外。"
    )
    if claim.union_bound is not None:
        words += (
            f"不论抽样结果如何，模型在这些时刻的概率至多为 {format_number(claim.union_bound)}："
            "这是对所有板凳对和所有时刻求和的上界，取一阶近似并计入余项的界，以双精度计算。"
        )
    if claim.tolerance:
        within = f"有 {claim.within} 次在这些时刻没有孔离得更远" if claim.within else "每次都有孔在这些时刻之一离得更远"
        words += f"已证明：只要没有孔离其位置超过 {format_safe(claim.tolerance)} m，任何时刻都不会相碰；{within}。"
    return words


def ground(claim: GroundClaim) -> str:
    return (
        f"{format_number(claim.start)} s 至 {format_number(claim.stop)} s，没有板凳越出这些多边形，"
        f"其上任一点离板凳经过的地面都不超过 {claim.excess:.3g} m。同一尺寸的板凳合起来扫过的，"
        f"就是其中一节走遍它们全部位置所扫过的：{claim.sizes} 种尺寸，路径长 {claim.length:.6g} m，"
        f"分为 {claim.cells} 段。每段以二阶导数的界限定板凳上一点离其首末两位置连线的距离。"
        "多边形是各边沿这些连线扫过部分的并集，并向外扩大了比这更大的距离。"
    )


def _benches(claim: ContactClaim | EncounterClaim) -> str:
    assert claim.benches is not None
    if isinstance(claim, EncounterClaim) and claim.dragons is not None:
        (i, j), (a, b) = claim.dragons, claim.benches
        return f"{i} 号龙的 {a} 号板凳与 {j} 号龙的 {b} 号板凳"
    return f"{claim.benches[0]} 号与 {claim.benches[1]} 号板凳"


def _pair(claim: ContactClaim | EncounterClaim) -> str:
    assert claim.time is not None
    return f"{format_number(claim.time)} s 时 {_benches(claim)}"


def _end(claim: ContactClaim | EncounterClaim, ends: Mapping[EndReason, str]) -> str:
    """The end of the sentence about a time without a contact, unless a contact ends it."""
    if claim.kind is not ClaimKind.UNDECIDED:
        return ends[claim.end] if claim.end else ""
    if claim.time is None:
        return "；其后无法判定。"
    return f"；其后在 {format_number(claim.time)} s 之前无法判定，届时 {_benches(claim)}相碰或过近。"


def _part(k: int, part: PartSummary) -> str:
    name = f"{k} 号龙" if part.name is None else f"{k} 号龙（{part.name}）"
    x, y = map(format_number, part.centre)
    place = f"，中心 ({x}, {y}) m" if part.centre != (0.0, 0.0) else ""
    place += f"，转过 {format_number(part.rotation)} rad" if part.rotation else ""
    place += "" if part.clockwise else "，逆时针"
    delay = f"，推迟 {format_number(part.delay)} s" if part.delay else ""
    return f"{name}，{_dance(part.dance)}{place}{delay}"


def _dance(dance: DanceSummary) -> str:
    speed = f"{format_number(dance.head_speed)} m/s"
    head = (
        f"先有 {dance.passage_count} 段逐一给定的速度，其后龙头速度 {speed}"
        if dance.passage_count
        else f"龙头速度 {speed}"
    )
    if dance.passages:
        head = f"龙头速度 {'，'.join(map(_passage, dance.passages))}，其后 {speed}"
    return f"{_dragon(dance.dragon)}{_path(dance.path)}，{head}"


def _dragon(dragon: DragonSummary) -> str:
    if dragon.head_length is None or dragon.width is None or dragon.overhang is None:
        return f"{dragon.benches} 节逐一给定的板凳"
    body = "" if dragon.body_length is None else f"龙身长 {format_number(dragon.body_length)} m，"
    width, overhang = format_number(dragon.width), format_number(dragon.overhang)
    sizes = f"龙头长 {format_number(dragon.head_length)} m，{body}宽 {width} m，孔心距板头 {overhang} m"
    return f"{dragon.benches} 节板凳（{sizes}）"


def _path(path: PathSummary) -> str:
    if path.pitch is not None and path.start_turns is not None:
        return f"，沿螺距 {format_number(path.pitch)} m 的螺线自第 {format_number(path.start_turns)} 圈盘入"
    pieces = "、".join(PIECES[piece] for piece in path.pieces)
    return f"，沿弧长 {format_number(path.begin)} m 至 {format_number(path.end)} m 的路径（{pieces}）"


def _passage(passage: Passage) -> str:
    end = f"{format_number(passage.until_time or 0.0)} s"
    if passage.until_s is not None:
        end = f"{format_number(passage.until_s)} m"
    return f"{format_number(passage.speed)} m/s 直到 {end}"


# The function that puts each class of claims in sentences.
SENTENCES: dict[type[Claim], Callable[[Any], str]] = {
    ContactClaim: contact,
    EncounterClaim: encounter,
    StrayClaim: stray,
    ProbabilityClaim: probability,
    GroundClaim: ground,
}
