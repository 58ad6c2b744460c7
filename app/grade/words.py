"""Texts of the grader and of the comparison with the paper, with the contest's terms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from app.grade.errors import ERRORS, NAMES
from app.grade.paper import PAPER
from core.language import Phrases, say

# The values in a text, by their names.
Values = Mapping[str, object]


@dataclass(frozen=True)
class Note:
    """A remark: its name in WORDS, and its values. As text it is in the language that is spoken."""

    code: str
    values: Values = field(default_factory=dict)

    def __str__(self) -> str:
        return say(WORDS[self.code], **self.values)


def note(code: str, **values: object) -> Note:
    return Note(code, values)


def word(code: str, **values: object) -> str:
    """A text of WORDS with its values, which may be notes themselves."""
    return str(Note(code, values))


# fmt: off
WORDS: Phrases = ERRORS | PAPER | {f"name_{code}": name for code, name in NAMES.items()} | {
    # -- numbers as people type them --
    "read_as": "Read as {number}.",
    "full_width": "Its digits are full-width ones, as a Chinese keyboard writes them: a workbook takes them for text.",
    "with_unit": "The unit {unit} is meant anyway and need not be written.",
    "converted": "It was written in {written} and is converted to {unit}.",
    "with_comma": "The comma counts as the decimal point.",
    # -- files that cannot be graded --
    "too_long": "The file has more than {most} MB, so it was not read: a workbook of the contest is about 2 MB.",
    "empty": "The file is empty.",
    "encrypted": "The workbook is encrypted: save it without a password.",
    "old_format": "The workbook has an old format, such as .xls of Excel or .et of WPS: save it as .xlsx.",
    "other_program": "The file is a table of {program}, which is not read here: save it as .xlsx there.",
    "web_page": "The file is a web page, which some programs save with the ending .xls: open it in a spreadsheet and save it as .xlsx.",
    "commas": "Commas separate the cells and stand in the numbers too, so that nothing tells one from the other: separate the cells by semicolons, or write the numbers with a point.",
    "truncated": "The workbook is damaged: its archive ends early or does not unpack. Save or upload it again.",
    "broken": "The workbook is damaged and cannot be opened ({why}).",
    "bomb": "The archive would unpack to more than the limit of {most} MB in {parts} parts.",
    "long_tag": "The workbook was not read: {part} has an element of more than {most} bytes, which no spreadsheet program writes.",
    "memory": "The file was not read: that takes more than {most} MB of memory.",
    "other_archive": "The file is an archive, such as a .docx or a .zip, but not an .xlsx workbook: unpack it, or save the sheets as .xlsx or .csv.",
    "declared": "The workbook was not read: {part} declares a document type, which no spreadsheet program writes.",
    "strict": "The workbook has the format Strict Open XML: save it as an ordinary .xlsx.",
    "too_many_elements": "The workbook has more than {most} elements of XML, such as cells and values: delete what is not needed.",
    "long_row": "The workbook was not read: {part} has a row of more than {most} cells, which no spreadsheet program writes.",
    "too_many_cells": "The table has more than {most} cells.",
    "no_csv": "The file is neither a workbook nor a table of text (CSV).",
    "picture": "The file is a picture, such as a screenshot, in which no number can be read: hand in the table itself, saved as .xlsx or .csv.",
    "document": "The file is a PDF, not a workbook: hand in the table itself, saved as .xlsx or .csv.",
    "no_workbook": "The file has the name of a workbook, but its content is text: save the sheets as .xlsx.",
    "failed": "The grader failed on this file ({why}). This is an error in the grader: please report it.",
    "not_opened": "The file cannot be opened: {why}.",
    "file_missing": "no such file",
    "file_forbidden": "permission denied",
    "file_folder": "it is a folder",
    "no_table": "No sheet has names of three handles or more, such as 龙头x (m), or their numbers below the heading handle, with headings such as 0 s or x (m) above the columns. Without these a table must have all 224 handles, or the seven that the paper prints at its instants.",
    "no_numbers": "The sheet has labels for {handles} handles, but no numbers beside them: fill in {kind}.",
    # -- notes --
    "macros": "The workbook holds macros: they were not run.",
    "formulas": "Cells with formulas: {count}, the first is {cell}. The values stored with them were read.",
    "unstored": "Cells with formulas but no stored value: {count}, the first is {cell}. Open and save the workbook in a spreadsheet.",
    "merged": "Merged ranges of cells: {count}, the first is {cell}. Only the first cell of each has a value.",
    "text_number": "The number in {cell} is stored as text.",
    "text": "{cell} should hold a number, but holds the text “{text}”.",
    "texts": "{count} cells hold the text “{text}” instead of a number, the first is {cell}.",
    "text_numbers": "Numbers that are stored as text: {count}, the first is in {cell}.",
    "cut": "Of the sheet {title} only the first {rows} rows were read, because the rows are too wide.",
    "angles": "The sheet {title} holds angles, which the contest does not ask for: it was not graded.",
    "curve": "A table of angles or radii beside x and y, without handles and speeds, is not one of the contest: it was not graded.",
    "titled_otherwise": "The sheet {title} holds {kind}, in spite of its title.",
    "named_otherwise": "The name of the file says {named}, but its sheets are laid out as {workbook}: it was graded as {workbook}.",
    "name_coded": "The name of the file is not UTF-8: it was read as GBK.",
    "name_escaped": "The name of the file is not UTF-8: bytes that cannot be read stand as \\x and two digits.",
    "vague": "Every number is {number}, as the right ones are if they are rounded to {decimals} decimals: more decimals would show whether they were computed.",
    "more_text": "Further cells with text: {count}.",
    "unit": "The numbers are in {unit}, and were converted.",
    "by_order": "The labels of the handles are shifted: the handles were read in the order of the rows.",
    "extra_handles": "Extra handles: {count}. The dragon has 224, from the head to the rear of the tail.",
    "extra_times": "{count} columns were not graded: their times are not part of the contest.",
    "missing": "Cells that are missing: {count} (handles without any: {handles}, instants without any: {times}).",
    "no_sheet": "The sheet of the {kind} is missing, or has no numbers.",
    "other_turn": "The numbers were compared with the turn of 2 : 1 from the edge of the circle, which is {length} m long. Question 4 allows other turns: if the team states another one, these numbers may be right for it.",
    "own_turn": "The sheets were judged by the turn that the head's places show: it begins {entry} m and ends {exit} m from the centre, its arcs have the ratio {ratio} : 1, and it is {length} m long. Question 4 allows it, if the team states these numbers.",
    "own_turn_touches": "The head's places show a turn of the team's own, which begins {entry} m and ends {exit} m from the centre and has arcs of the ratio {ratio} : 1. On it benches {a} and {b} touch at {time} s, so it cannot be danced, and the sheets were judged by the turn of 2 : 1 from the edge of the circle.",
    "position": "positions",
    "speeds": "speeds",
    "speed": "maximum speed of the head",
    "contact": "positions and speeds at first contact",
    # -- the rubric --
    "rubric_branch_yes": "Every handle is on the right branch behind the one before.",
    "rubric_branch_no": "A handle is on the wrong branch: it must be at the first root behind the one before.",
    "rubric_branch_unknown": "The branch of the next handle: not shown.",
    "rubric_speeds_yes": "The speeds belong to the positions.",
    "rubric_speeds_no": "The speeds do not belong to the positions.",
    "rubric_speeds_unknown": "Speeds consistent with the positions: not shown, both sheets are necessary.",
    "rubric_speeds_alone": "Speeds consistent with the positions: not shown here.",
    "rubric_overhang_yes": "Benches are rectangles with their overhang.",
    "rubric_overhang_no": "Benches lack their overhang.",
    "rubric_overhang_unknown": "Rectangles with overhang: not shown here.",
    "rubric_refined_yes": "First contact was refined.",
    "rubric_refined_no": "The time of first contact is only a step of the search: refine it, for example by bisection.",
    "rubric_refined_unknown": "Refined time of first contact: not shown here.",
    "rubric_tangents_yes": "The path is smooth where the arcs begin and end.",
    "rubric_tangents_no": "The path has kinks where the arcs begin or end: the arcs must be tangent to the spirals and to each other.",
    "rubric_tangents_unknown": "Continuity at the tangents: not shown here.",
    "rubric_speeds_share": "{share} % of the speeds agree with the motion between two instants.",
    # -- verdicts and lines of the command --
    "right": "right",
    "rounded": "rounded",
    "incomplete": "incomplete",
    "infeasible": "infeasible",
    "wrong": "wrong",
    "unreadable": "unreadable",
    "right_near": "right to {decimals} decimals only, written with {written}",
    "given": "The {count} cells that have a number are {how}.",
    "to_digits": "right to its {digits} digits; the contest asks for six decimals",
    "not_to_the_nearest": "rounded, but not to the nearest",
    "not_best_pitch": "possible, but not the smallest",
    "not_best_speed": "possible, but not the highest",
    "not_best_turn_length": "not the shortest",
    "rounded_to_decimals": "right, rounded to {decimals} decimals",
    "rounded_to_decimal": "right, rounded to 1 decimal",
    "sheet_line": "{title}: {verdict}, {right} of {cells} cells right",
    "sheet_line_rounded": "{title}: {verdict}, {right} of {cells} cells right to six decimals, {rounded} more to fewer",
    "worst_cell": "Largest error: cell {cell} ({handle}, {quantity} at {time} s) holds {found} instead of {expected}.",
    "first_cell": "First wrong cell, row by row: {cell} ({handle}, {quantity} at {time} s) holds {found} instead of {expected}.",
    "only_cell": "First wrong cell, and the largest error: {cell} ({handle}, {quantity} at {time} s) holds {found} instead of {expected}.",
    "quantity_speed": "speed",
    "in_other_unit": "This looks like the right answer in {other}; the contest asks for {unit}, which makes it {number} {unit}.",
    "nothing_fits": "No known error gives these numbers.",
    "slips": "All other numbers agree: {count} cells are wrong, which look like slips.",
    "slip": "All other numbers agree: one cell is wrong, which looks like a slip.",
    "too_few_digits": "Its digits are too few to tell why.",
    "too_few_decimals": "The numbers have too few decimals to tell why: at least {least} are necessary.",
    "few_numbers": "Only {count} of {cells} cells have a number ({handles}); {empty} handles have none, and their labels stand beside empty cells. Fill these in: fewer than {least} numbers do not tell why they are wrong.",
    "few_numbers_alone": "Only {count} of {cells} cells have a number ({handles}); the table lacks {empty} handles. Fill these in: fewer than {least} numbers do not tell why they are wrong.",
    "may_be": "Possibly: {error}",
    "chance": "One in {count} numbers with as many digits fits a known error by chance.",
    "is_right": "The right value is {right} {unit}.",
    "collision_time": "time of first contact",
    "pitch": "minimum pitch",
    "turn_length": "length of the turn",
    "summary": "All files",
    "and_error": "; ",
    "and_breaks": "{verdict}, {breaks}",
    "class_team": "team",
    "class_file": "file",
    "class_workbook": "workbook",
    "class_verdict": "verdict",
    "class_cells": "cells",
    "class_right": "right",
    "class_points": "points",
    "class_finding": "what was found",
    "class_rounded": "right to fewer decimals",
    "class_missing": "missing",
    "class_team_points": "points of the team",
    "class_alike": "files that are alike",
    "class_points_most": "most points",
    "class_team_most": "most points of the team",
    "class_lacking": "cells that are missing: {missing} of {cells}",
    "class_own_turn": "judged by the team's own turn",
    "class_own_turn_touches": "benches touch on its own turn",
    "class_points_of": "{points} of {most}",
    "scheme": "Most points: {points}. A number that is right to fewer than six decimals gets {share} of those of a right one.",
    "scheme_typed": "Questions 3 and 5 have no workbook: each counts once the number of any team is typed.",
    "class_sheet": "class",
    "rubric_what": "what",
    "rubric_points": "points",
    "alike": "These are the same file, byte for byte: {files}. Perhaps one was handed in by mistake, or a program wrote both, as Bench Dragon writes the same for everyone: ask before you judge.",
    "same_wrong": "The same wrong numbers stand in {count} of the {most} cells that were compared of these files, such as {number}: {files}. A table or a program that was shared gives that, and so does the same error in both: ask before you judge.",
    "column_file": "file",
    "column_workbook": "workbook",
    "column_verdict": "verdict",
    "column_cells": "cells",
    "column_right": "right",
    "column_missing": "missing",
    "column_decimals": "decimals",
    "column_diagnosis": "diagnosis",
}
# fmt: on
