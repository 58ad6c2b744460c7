"""The figures: their texts agree with core's answers, and their drawings can be read back from the SVG."""

import re
import struct
from concurrent.futures import ThreadPoolExecutor
from xml.etree import ElementTree

import pytest

from app.files import figures
from core import Dance, Dragon, Spiral, first_contact, minimum_pitch
from core.design.pitch_scan import scan_near_minimum
from tests.support.depth import some
from tests.support.shared_dances import STREET

SMALL = Dragon(benches=30)
PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def texts(svg):
    """All text of an SVG: matplotlib keeps each string as a comment beside its outlines."""
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    root = ElementTree.fromstring(svg, parser)
    return "\n".join(node.text or "" for node in root.iter() if node.tag is ElementTree.Comment)


def scan_figures(dragon, *formats, samples, margin=0.0):
    circle = {"turning_radius": 4.5, "start_turns": 16.0, "margin": margin}
    result = scan_near_minimum(dragon, samples=samples, **circle)
    return [figures.pitch_scan_figure(dragon, result, **circle, format=form) for form in formats]


def test_trajectory_figure_names_its_axes_units_and_instant():
    words = texts(figures.trajectory_figure(Dance(SMALL, Spiral()), time=120.0))
    for word in ("x [m]", "y [m]", "speed of the handle [m/s]", "120 s", "pitch 0.55 m"):
        assert word in words


def test_contact_figure_states_the_time_pair_and_features_that_core_found():
    contact = first_contact(Dance(Dragon(), Spiral()))
    words = texts(figures.contact_figure(Dance(Dragon(), Spiral())))
    place = "({:.6f} m, {:.6f} m)".format(*contact.point)
    features = "bench 0 (head)", "inner edge of bench 8", "front-outer corner of bench 0"
    assert [word for word in (f"{contact.time:.6f} s", *features, place) if word not in words] == []


def test_contact_figure_with_a_margin_states_it():
    coil = Dance(Dragon(), Spiral())
    five = Dance(Dragon(benches=5), Spiral(9.0, 3.0))
    for words, part in (
        (texts(figures.contact_figure(Dance(SMALL, Spiral()), margin=0.05)), "Within 0.05 m: a gap of 0.050000 m at ("),
        (texts(figures.contact_figure(coil, margin=0.2)), "a gap of 0.169279 m"),
        (texts(*scan_figures(Dragon(benches=8), "svg", margin=0.05, samples=5)), "first within 0.05 m of each other"),
        (texts(figures.contact_figure(five, margin=0.1)), "Never within 0.1 m: the run ends clear at the centre"),
    ):
        assert part in words
        assert not re.search("contact|touch|meet|overlap", words, re.IGNORECASE)


@pytest.mark.parametrize(
    "dance, near, named, other",
    [
        (Dance(Dragon(10), Spiral()), {"margin": 0.3}, "front-outer corner of bench 0", "edge"),
        (
            STREET,
            {"margin": 1.2, "start": 20.0},
            "front edge of bench 2",
            "corner",
        ),
    ],
    ids=["two corners", "parallel edges"],
)
def test_contact_figure_of_two_alike_names_no_other(dance, near, named, other):
    assert getattr(first_contact(dance, **near), other) is None
    words = texts(figures.contact_figure(dance, **near))
    assert named in words
    assert f"{other} of bench" not in words


def test_pitch_scan_figure_marks_minimum_pitch_and_circle():
    least = minimum_pitch(SMALL)
    words = texts(*scan_figures(SMALL, "svg", samples=9))
    assert f"minimum pitch, {least.pitch:.9f} m" in words
    assert "turning circle, 4.5 m" in words


def drawn(kind):
    """A figure as SVG and as PNG."""
    if kind == "scan":
        return scan_figures(SMALL, "svg", "png", samples=5)
    draw = figures.contact_figure if kind == "contact" else figures.trajectory_figure
    return [draw(Dance(SMALL, Spiral()), format=form) for form in ("svg", "png")]


def test_equal_questions_give_equal_bytes_also_in_threads():
    kinds = some(("trajectory", "contact", "scan"), 2)
    alone = list(map(drawn, kinds))
    with ThreadPoolExecutor(len(kinds)) as pool:
        assert list(pool.map(drawn, kinds)) == alone
    for svg, png in alone:
        assert png[:8] == PNG_SIGNATURE
        assert min(struct.unpack(">II", png[16:24])) > 500  # pixels
        assert ElementTree.fromstring(svg).tag.endswith("svg")


def test_pitch_scan_figure_of_a_dragon_that_cannot_touch_says_so():
    assert "No contact at any of these pitches" in texts(*scan_figures(Dragon(benches=2), "svg", samples=3))
