"""PDF files, opened again by another program."""

import pypdfium2
import pypdfium2.raw as pdfium


def pages_of(data):
    return list(pypdfium2.PdfDocument(data))


def words_of(page, *box):
    """All words of a page with single blanks between them. box: left, bottom, right, top [pt]"""
    return " ".join(page.get_textpage().get_text_bounded(*box).split())


def sheets_of(data):
    """The words of each page of a file."""
    return [words_of(page) for page in pages_of(data)]


def shapes_of(page):
    """Boxes of all drawn shapes: left, bottom, right, top [pt]."""
    return [one.get_bounds() for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_PATH])]


def assert_printable(data, *tags):
    """Every font is in the file and of a type that journals and printers take, and so are the tags."""
    for page in pages_of(data):
        fonts = [one.get_font() for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_TEXT])]
        assert fonts
        assert all(font.is_embedded for font in fonts)
    assert b"/FontFile2" in data  # TrueType
    assert b"/Type3" not in data
    assert [tag for tag in tags if tag not in data] == []
