"""Workbooks as LibreOffice writes them: python -m tests.campaigns.libreoffice [--renew]

It has LibreOffice read and write the contest's three workbooks, and grades all of their cells. --renew writes the small
ones of tests/reference/libreoffice anew, with which the tests do without it.
"""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from app.grade.report import graded
from core import Budget
from tests.support.students import ALL_CELLS, by_xlsxwriter, three

SMALL = Path(__file__).parents[1] / "reference" / "libreoffice"
# Instants of the small workbooks.
FEW = 4
SECONDS = 300  # longest conversion [s]; the largest takes about 10


def by_libreoffice(sheets):
    """A workbook from XlsxWriter, read and written again by LibreOffice."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "given.xlsx"
        file.write_bytes(by_xlsxwriter(sheets))
        command = ["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", "xlsx"]
        command += ["--outdir", f"{folder}/out", str(file)]
        subprocess.run(command, check=True, capture_output=True, timeout=SECONDS)
        return (Path(folder) / "out" / file.name).read_bytes()


def main():
    version = subprocess.run(["soffice", "--version"], check=True, capture_output=True, text=True).stdout.strip()
    if "--renew" in sys.argv[1:]:
        SMALL.mkdir(exist_ok=True)
        for name, sheets in zip(("result1", "result2", "result4"), three(), strict=True):
            few = {title: [row[: FEW + 1] for row in rows] for title, rows in sheets.items()}
            (SMALL / f"{name}.xlsx").write_bytes(by_libreoffice(few))
        return
    right = 0
    for sheets in three():
        result = graded("upload", by_libreoffice(sheets), Budget())
        right += sum(sheet.right for sheet in result.sheets)
        counts = ", ".join(f"{sheet.right:,}" for sheet in result.sheets)
        print(f"{result.workbook}: {result.verdict}, {counts} cells right")
    print(f"{right:,} of {ALL_CELLS:,} cells right, written by {version}")
    if right != ALL_CELLS:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
