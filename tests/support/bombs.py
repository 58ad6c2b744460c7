"""Small files that need much memory or time to read, made here and never kept as files; and their limits."""

import io
import os
import zipfile
import zlib
from functools import cache, partial

SHEET = "xl/worksheets/sheet1.xml"
MAIN = b'<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
END = b"</sheetData></worksheet>"


def zipped(parts, method):
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", method) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    return sink.getvalue()


@cache
def zeros(name, method):
    """An archive with one part of 300 MB of zeros, written in pieces."""
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", method) as archive, archive.open(name, "w") as part:
        for _ in range(300):
            part.write(bytes(1_000_000))
    return sink.getvalue()


def lying(data, name, length, content):
    """The archive with another length and sum of a part in both of its records. content: the first bytes of it"""
    changed = bytearray(data)
    crc = zlib.crc32(content[:length]).to_bytes(4, "little")
    for mark, sum_at, name_at in ((b"PK\3\4", 14, 30), (b"PK\1\2", 16, 46)):
        at = -1
        while (at := data.find(mark, at + 1)) >= 0:
            if data[at + name_at : at + name_at + len(name)] == name.encode():
                changed[at + sum_at : at + sum_at + 4] = crc
                changed[at + sum_at + 8 : at + sum_at + 12] = length.to_bytes(4, "little")
    return bytes(changed)


def fit_points_of_dxf():
    points = "".join(f"11\n{k % 7}\n21\n{k}\n" for k in range(20_000))
    return drawn(f"0\nSPLINE\n8\nA\n70\n8\n71\n3\n74\n20000\n{points}")


def vertices_of_dxf():
    corners = "10\n0\n20\n1\n" * 1_000_000
    return drawn(f"0\nLWPOLYLINE\n100\nAcDbEntity\n100\nAcDbPolyline\n90\n1000000\n70\n0\n{corners}".rstrip())


def sections(**records):
    """A drawing with these sections."""
    return (
        "".join(f"0\nSECTION\n2\n{name}\n{text}\n0\nENDSEC\n" for name, text in records.items()).encode() + b"0\nEOF\n"
    )


def drawn(entities):
    """A drawing of the version of the year 2000."""
    return sections(HEADER="9\n$ACADVER\n1\nAC1015", ENTITIES=entities)


BLOCK = "0\nBLOCK\n2\nTREE\n70\n0\n10\n0\n20\n0\n0\nCIRCLE\n10\n0\n20\n0\n40\n1\n0\nENDBLK"
INSERTED = "0\nINSERT\n2\nTREE\n10\n0\n20\n0\n70\n32000\n71\n32000\n44\n5\n45\n5"


def workbook(sheet, text=b""):
    """A workbook with this sheet. text: the first text that its cells share"""
    import xlsxwriter

    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, {"in_memory": True}) as book:
        book.add_worksheet().write(0, 0, "text")
    with zipfile.ZipFile(sink) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    shared = parts["xl/sharedStrings.xml"].replace(b"text", text or b"text")
    return zipped(parts | {SHEET: sheet, "xl/sharedStrings.xml": shared}, zipfile.ZIP_DEFLATED)


def shared_text():
    """A text of 10 MB in 200,000 cells."""
    row = b"<row>" + b'<c t="s"><v>0</v></c>' * 500 + b"</row>"
    return workbook(MAIN + row * 400 + END, b" x" * 5_000_000)


def attributes():
    """1.5 million of them."""
    return b" ".join(b'a%d=""' % k for k in range(1_500_000))


MAPS = {
    # 700 bytes that become 300 MB.
    "bzip2": lambda: zeros("doc.kml", zipfile.ZIP_BZIP2),
    "deflated": lambda: zeros("doc.kml", zipfile.ZIP_DEFLATED),
    "deflated_that_lies": lambda: lying(zeros("doc.kml", zipfile.ZIP_DEFLATED), "doc.kml", 100, bytes(100)),
    "attributes_of_kml": lambda: b"<kml><Placemark " + attributes() + b"/></kml>",
    "tables_of_toml": lambda: b"".join(b"[a%d]\n" % k for k in range(1_400_000)),
    "quoted_toml": lambda: b'"a" . ' * 300_000 + b"a = 1",
    "deep_toml": lambda: b"x = " + b"{a = " * 300 + b"1" + b"}" * 300,
    "brackets_of_json": lambda: b'{"type": "FeatureCollection", "features": [' + b"[]," * 6_600_000 + b"[]]}",
    "points_of_geojson": lambda: b'{"type": "MultiPoint", "coordinates": [' + b"[1,2]," * 3_300_000 + b"[1,2]]}",
    # 73 bytes whose arc would be 1e152 straight lines.
    "arc_of_dxf": lambda: drawn("0\nARC\n10\n0\n20\n0\n40\n1e300\n50\n0\n51\n90"),
    # 5,000 arcs as large as an arc may be.
    "arcs_of_dxf": lambda: drawn("\n".join(["0\nARC\n10\n0\n20\n0\n40\n99999\n50\n0\n51\n359"] * 5_000)),
    "entities_of_dxf": lambda: drawn("\n".join(["0\nPOINT\n10\n0\n20\n0"] * 900_000)),
    "signed_records_of_dxf": lambda: b"0\nSECTION\n2\nENTITIES\n" + b"+0\nPOINT\n" * 900_000 + b"00\nENDSEC\n0\nEOF\n",
    "fit_points_of_dxf": fit_points_of_dxf,
    "vertices_of_dxf": vertices_of_dxf,
    # A block that is inserted a thousand million times.
    "array_of_dxf": partial(sections, BLOCKS=BLOCK, ENTITIES=INSERTED),
}
GRADES = {
    "bzip2_of_a_workbook": lambda: zeros("xl/workbook.xml", zipfile.ZIP_BZIP2),
    "workbook_that_lies": lambda: lying(
        zeros("xl/workbook.xml", zipfile.ZIP_DEFLATED), "xl/workbook.xml", 90, bytes(90)
    ),
    "cells": lambda: workbook(MAIN + b"<row>" + b"<c/>" * 1_900_000 + b"</row>" + END),
    # A sheet that is a long text, and one that ends early.
    "styles": lambda: workbook(MAIN + b"<row><c><v>" + b"1" * 90_000_000),
    "attributes": lambda: workbook(MAIN + b"<row " + attributes() + b"/>" + END),
    "shared_text": shared_text,
}


def end(file, budget):
    """What a fault in a library of C does to the process that reads a file. file: gets a line"""
    with file.open("a") as log:
        log.write("ended\n")
    os._exit(11)


def take_memory(data, budget):
    return len(data * 10_000)


def fail(data, budget):
    raise ZeroDivisionError(f"near {data!r}")
