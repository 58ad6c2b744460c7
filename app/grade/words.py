"""Texts of the grader and of the comparison with the paper, in English and in Chinese, with the contest's terms."""

from __future__ import annotations

from dataclasses import dataclass, field

from app.files.tables import Language
from app.grade.errors import ERRORS
from app.grade.paper import PAPER


@dataclass(frozen=True)
class Note:
    """A remark: its name in WORDS, and its values."""

    code: str
    values: dict[str, object] = field(default_factory=dict)

    def text(self, language: Language) -> str:
        return say(self.code, language, **self.values)


def note(code: str, **values: object) -> Note:
    return Note(code, values)


def say(code: str, language: Language, **values: object) -> str:
    """A text of WORDS with its values, which may be notes themselves."""
    english, chinese = WORDS[code]
    texts = {name: value.text(language) if isinstance(value, Note) else value for name, value in values.items()}
    return (chinese if language is Language.CHINESE else english).format(**texts)


# fmt: off
WORDS = ERRORS | PAPER | {
    # -- files that cannot be graded --
    "too_long": ("The file has more than {most} MB, so it was not read: a workbook of the contest is about 2 MB.",
        "文件超过 {most} MB，未读取：竞赛工作簿约 2 MB。"),
    "empty": ("The file is empty.", "文件为空。"),
    "encrypted": ("The workbook is encrypted: save it without a password.", "工作簿已加密：请取消密码后另存。"),
    "old_format": ("The workbook has the old format .xls: save it as .xlsx.", "工作簿为旧格式 .xls：请另存为 .xlsx。"),
    "truncated": ("The workbook is damaged: its archive ends early or does not unpack. Save or upload it again.",
        "工作簿已损坏：压缩包不完整或无法解压。请重新保存或上传。"),
    "broken": ("The workbook is damaged and cannot be opened ({why}).", "工作簿已损坏，无法打开（{why}）。"),
    "bomb": ("The archive would unpack to more than the limit of {most} MB in {parts} parts.",
        "压缩包解压后超过限制：{most} MB、{parts} 个部分。"),
    "long_tag": ("The workbook was not read: {part} has an element of more than {most} bytes, which no spreadsheet program writes.",
        "工作簿的 {part} 含有超过 {most} 字节的元素，电子表格软件不会写入：未读取。"),
    "memory": ("The file was not read: that takes more than {most} MB of memory.", "未读取该文件：读取需要超过 {most} MB 内存。"),
    "other_archive": ("The file is an archive, such as a .docx, but not an .xlsx workbook: save the sheets as .xlsx or .csv.",
        "文件是压缩包，但不是 .xlsx 工作簿（例如 .docx）：请另存为 .xlsx 或 .csv。"),
    "declared": ("The workbook was not read: {part} declares a document type, which no spreadsheet program writes.",
        "工作簿的 {part} 含有文档类型声明，电子表格软件不会写入：未读取。"),
    "strict": ("The workbook has the format Strict Open XML: save it as an ordinary .xlsx.",
        "工作簿为“Strict Open XML”格式：请另存为普通 .xlsx。"),
    "too_many_elements": ("The workbook has more than {most} elements of XML, such as cells and values: delete what is not needed.",
        "工作簿的 XML 元素（单元格、数值等）超过 {most} 个：请删除多余内容。"),
    "long_row": ("The workbook was not read: {part} has a row of more than {most} cells, which no spreadsheet program writes.",
        "工作簿的 {part} 有一行超过 {most} 个单元格，电子表格软件不会写入：未读取。"),
    "too_many_cells": ("The table has more than {most} cells.", "表格超过 {most} 个单元格。"),
    "no_csv": ("The file is neither a workbook nor a table of text (CSV).",
        "文件既不是工作簿，也不是文本表格（CSV）。"),
    "no_workbook": ("The file has the name of a workbook, but its content is text: save the sheets as .xlsx.",
        "文件名是工作簿，内容却是文本，不是工作簿：请把工作表另存为 .xlsx。"),
    "failed": ("The grader failed on this file ({why}). This is an error in the grader: please report it.",
        "评阅程序处理此文件时出错（{why}），这是程序的缺陷：请反馈。"),
    "not_opened": ("The file cannot be opened: {why}.", "无法打开文件：{why}。"),
    "file_missing": ("no such file", "没有此文件"),
    "file_forbidden": ("permission denied", "没有读取权限"),
    "file_folder": ("it is a folder", "它是文件夹"),
    "no_table": ("No sheet has labels such as 龙头x (m) and times such as 0 s, or numbers for 224 handles.",
        "没有任何工作表含有“龙头x (m)”之类的标签和“0 s”之类的时间，或 224 个把手的数据。"),
    "no_numbers": ("The sheet has labels for {handles} handles, but no numbers beside them: fill in {kind}.",
        "工作表有 {handles} 个把手的标签，但应有数据处没有数值：请补全{kind}。"),
    # -- notes --
    "macros": ("The workbook holds macros: they were not run.", "工作簿含有宏：未运行。"),
    "formulas": ("Cells with formulas: {count}, the first is {cell}. The values stored with them were read.",
        "{count} 个单元格含有公式，第一个是 {cell}：读取的是随公式保存的数值。"),
    "unstored": ("Cells with formulas but no stored value: {count}, the first is {cell}. Open and save the workbook in a spreadsheet.",
        "{count} 个单元格的公式没有保存结果，第一个是 {cell}：请用电子表格软件打开并保存，使结果随公式保存。"),
    "merged": ("Merged ranges of cells: {count}, the first is {cell}. Only the first cell of each has a value.",
        "{count} 处合并单元格，第一处是 {cell}：只有首个单元格有值。"),
    "text_number": ("The number in {cell} is stored as text.", "{cell} 中的数值以文本形式保存。"),
    "text": ("{cell} should hold a number, but holds the text “{text}”.", "{cell} 应为数值，却是文本“{text}”。"),
    "texts": ("{count} cells hold the text “{text}” instead of a number, the first is {cell}.",
        "{count} 个单元格的内容是文本“{text}”而不是数值，第一个是 {cell}。"),
    "text_numbers": ("Numbers that are stored as text: {count}, the first is in {cell}.",
        "{count} 个数值以文本形式保存，第一个在 {cell}。"),
    "cut": ("Of the sheet {title} only the first {rows} rows were read, because the rows are too wide.",
        "工作表 {title} 的行过宽：只读取了前 {rows} 行。"),
    "angles": ("The sheet {title} holds angles, which the contest does not ask for: it was not graded.",
        "工作表 {title} 的内容是角度，不属于赛题要求：未评分。"),
    "curve": ("A table of angles or radii beside x and y, without handles and speeds, is not one of the contest: it was not graded.",
        "表格在 x、y 之外只有角度或极径，没有把手和速度，不属于赛题要求：未评分。"),
    "titled_otherwise": ("The sheet {title} holds {kind}, in spite of its title.", "工作表 {title} 的内容是{kind}，与标题不符。"),
    "named_otherwise": ("The name of the file says {named}, but its sheets are laid out as {workbook}: it was graded as {workbook}.",
        "文件名为 {named}，但表格布局属于 {workbook}：已按 {workbook} 评阅。"),
    "name_coded": ("The name of the file is not UTF-8: it was read as GBK.", "文件名不是 UTF-8 编码：已按 GBK 读取。"),
    "name_escaped": ("The name of the file is not UTF-8: bytes that cannot be read stand as \\x and two digits.",
        "文件名不是 UTF-8 编码：无法读取的字节以 \\x 加两位数字表示。"),
    "more_text": ("Further cells with text: {count}.", "另有 {count} 个单元格为文本。"),
    "unit": ("The numbers are in {unit}, and were converted.", "数值单位为 {unit}：已按此读取。"),
    "by_order": ("The labels of the handles are shifted: the handles were read in the order of the rows.",
        "把手标签有错位：已按排列顺序对应把手。"),
    "extra_handles": ("Extra handles: {count}. The dragon has 224, from the head to the rear of the tail.",
        "多出 {count} 个把手：从龙头到龙尾（后）共 224 个。"),
    "extra_times": ("{count} columns were not graded: their times are not part of the contest.",
        "{count} 列的时刻不在赛题要求之内：未评分。"),
    "missing": ("{count} cells are missing ({handles} handles and {times} instants without any).",
        "缺少 {count} 个单元格（{handles} 个把手、{times} 个时刻完全没有数据）。"),
    "no_sheet": ("The sheet of the {kind} is missing.", "缺少{kind}工作表。"),
    "position": ("positions", "位置"),
    "speeds": ("speeds", "速度"),
    "speed": ("maximum speed of the head", "龙头最大速度"),
    "contact": ("positions and speeds at first contact", "首次碰撞时的位置与速度"),
    # -- the rubric --
    "rubric_branch_yes": ("Every handle is on the right branch behind the one before.",
        "每个把手都在正确的一圈上（紧随前一把手）。"),
    "rubric_branch_no": ("A handle is on the wrong branch: it must be at the first root behind the one before.",
        "有把手不在正确的一圈上：应为前一把手之后的第一个根。"),
    "rubric_branch_unknown": ("The branch of the next handle: not shown.", "下一把手在哪一圈上：本文件无法判断。"),
    "rubric_speeds_yes": ("The speeds belong to the positions.", "速度与位置相符。"),
    "rubric_speeds_no": ("The speeds do not belong to the positions.", "速度与位置不符。"),
    "rubric_speeds_unknown": ("Speeds consistent with the positions: not shown, both sheets are necessary.",
        "速度与位置是否相符：需要两张工作表。"),
    "rubric_speeds_alone": ("Speeds consistent with the positions: not shown here.", "速度与位置是否相符：本文件无法判断。"),
    "rubric_overhang_yes": ("Benches are rectangles with their overhang.", "板凳按整块矩形（含两端伸出部分）计算。"),
    "rubric_overhang_no": ("Benches lack their overhang.", "板凳缺少伸出部分。"),
    "rubric_overhang_unknown": ("Rectangles with overhang: not shown here.",
        "板凳是否按整块矩形（含两端伸出部分）计算：本文件无法判断。"),
    "rubric_refined_yes": ("First contact was refined.", "首次碰撞时刻经过进一步精确求解。"),
    "rubric_refined_no": ("The time of first contact is only a step of the search: refine it, for example by bisection.",
        "首次碰撞只按固定步长搜索：应进一步精确求解，例如用二分法。"),
    "rubric_refined_unknown": ("Refined time of first contact: not shown here.", "碰撞时刻是否进一步精确求解：本文件无法判断。"),
    "rubric_tangents_yes": ("The path is smooth where the arcs begin and end.", "圆弧与螺线相切，路径光滑。"),
    "rubric_tangents_no": ("The path has kinks where the arcs begin or end: the arcs must be tangent to the spirals and to each other.",
        "路径在圆弧端点处有折角：圆弧应与螺线相切，且两弧相切。"),
    "rubric_tangents_unknown": ("Continuity at the tangents: not shown here.", "圆弧在切点处是否光滑相接：本文件无法判断。"),
    "rubric_speeds_share": ("{share} % of the speeds agree with the motion between two instants.",
        "{share} % 的速度与相邻时刻的位移相符。"),
    # -- verdicts and lines of the command --
    "right": ("right", "正确"),
    "rounded": ("rounded", "仅舍入不同"),
    "incomplete": ("incomplete", "不完整"),
    "infeasible": ("infeasible", "不可行"),
    "wrong": ("wrong", "错误"),
    "unreadable": ("unreadable", "无法读取"),
    "not_rounded": ("All numbers are right to {decimals} decimals, but are written with {written}.",
        "数值准确到 {decimals} 位小数，但并非舍入到该位数：数值有 {written} 位小数。"),
    "to_digits": (", as far as its digits go ({digits})", "（{digits} 位有效数字）"),
    "to_decimals": (" to {decimals} decimals", "到 {decimals} 位小数"),
    "sheet_line": ("{title}: {verdict}, {right} of {cells} cells right",
        "{title}：{verdict}，{cells} 个单元格中 {right} 个正确"),
    "worst_cell": ("worst: {cell}, {handle}, {quantity} at {time} s: {found}, right: {expected}",
        "误差最大：{cell}，{handle}，{time} s 时，{quantity}：{found}，正确为 {expected}"),
    "first_cell": ("first: {cell}, {handle}, {quantity} at {time} s: {found}, right: {expected}",
        "首个错误：{cell}，{handle}，{time} s 时，{quantity}：{found}，正确为 {expected}"),
    "quantity_speed": ("speed", "速度"),
    "nothing_fits": ("No known error gives these numbers.", "没有已知错误能得出这些数值。"),
    "too_few_digits": ("Its digits are too few to tell why.", "位数太少，无法判断原因。"),
    "too_few_decimals": ("The numbers have too few decimals to tell why: at least {least} are necessary.",
        "小数位太少，无法判断原因：至少需要 {least} 位小数。"),
    "few_numbers": ("Only {count} of {cells} cells have a number ({handles}); {empty} handles have none, and their labels stand beside empty cells. Fill these in: fewer than {least} numbers do not tell why they are wrong.",
        "{cells} 个单元格中只有 {count} 个有数值（{handles}），其余 {empty} 个把手没有数据，只有标签。请补全：少于 {least} 个数值无法判断原因。"),
    "few_numbers_alone": ("Only {count} of {cells} cells have a number ({handles}); the table lacks {empty} handles. Fill these in: fewer than {least} numbers do not tell why they are wrong.",
        "{cells} 个单元格中只有 {count} 个有数值（{handles}），表格缺少 {empty} 个把手。请补全：少于 {least} 个数值无法判断原因。"),
    "may_be": ("Possibly: {error}", "可能是：{error}"),
    "chance": ("One in {count} numbers with as many digits fits a known error by chance.",
        "同样位数的数值中，约每 {count} 个有一个会碰巧符合某种已知错误。"),
    "is_right": ("The right value is {right} {unit}.", "正确值为 {right} {unit}。"),
    "collision_time": ("time of first contact", "首次碰撞时刻"),
    "pitch": ("minimum pitch", "最小螺距"),
    "turn_length": ("length of the turn", "调头曲线长度"),
    "summary": ("All files", "全部文件"),
    "and_error": ("; ", "；"),
    "colon": (": ", "："),
    "and_breaks": ("{verdict}, {breaks}", "{verdict}，{breaks}"),
    "column_file": ("file", "文件"),
    "column_workbook": ("workbook", "工作簿"),
    "column_verdict": ("verdict", "判定"),
    "column_cells": ("cells", "单元格"),
    "column_right": ("right", "正确"),
    "column_missing": ("missing", "缺少"),
    "column_decimals": ("decimals", "小数位"),
    "column_diagnosis": ("diagnosis", "诊断"),
}
# fmt: on
