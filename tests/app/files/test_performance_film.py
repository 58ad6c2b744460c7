"""Films of several dragons: every bench where it is, in the colour of its dragon, up to the first touch."""

import json

import pytest
from matplotlib.colors import to_rgb

from app.files.film import FilmPicture
from app.files.film_spec import GIF_TYPE, FilmSpec
from app.files.looks import colour_of
from app.questions.films import QUESTION, FilmRequest, shared_music
from app.settings import Settings
from app.wire.messages import checked
from app.wire.question import Terms
from core import bench_outlines, first_contact, first_encounter, trajectory
from core.language import Language, speaking
from tests.app.files.test_film import assert_heard, decoded
from tests.support.near import assert_near

TWO = json.loads("""{"dances": [
    {"name": "east", "dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[0, 0], [30, 0]]}},
    {"dragon": {"benches": 4}, "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}, "delay": 2}
], "venue": {"type": "Polygon", "coordinates": [[[-5, -25], [35, -25], [35, 25], [-5, 25], [-5, -25]]]},
    "seconds": 1, "rate": 4, "height": 180, "start_clock": "19:30"}""")
EAST, NORTH = TWO["dances"]
PERFORMANCE, _ = FilmRequest.model_validate(TWO).to_placed(Settings())


def film_of(body):
    """Pictures of a film as GIF."""
    return decoded(QUESTION.to_bytes(checked(FilmRequest, body), Terms(), GIF_TYPE))


def test_every_bench_is_drawn_in_the_colour_of_its_dragon():
    stage = FilmPicture(PERFORMANCE, FilmSpec(14.0, 30.0, height=720, start_clock="19:30"), None, "Lanterns")
    for time in (14.0, 20.5):  # the second one still stands at the first time
        outlines = outlines_at(time)
        picture = stage.frame(time, outlines)
        for k, own in enumerate(outlines):
            for x, y in stage.axes.transData.transform(own.mean(axis=1)):
                colour = picture[round(len(picture) - 1 - y), round(x)] / 255.0
                assert_near(colour, to_rgb(colour_of(PERFORMANCE, k)), 0.02)
    assert stage.time.text == "19:30:20 (20.50 s)"


def outlines_at(time):
    pairs = zip(PERFORMANCE.parts, trajectory(PERFORMANCE, time), strict=True)
    return [bench_outlines(part.dance.dragon, one.position) for part, one in pairs]


@pytest.mark.parametrize(
    "language, words",
    [
        (Language.ENGLISH, "bench 2 of east and bench 0 of dragon 1 touch\n"),
        pytest.param(Language.CHINESE, "east的 2 号板凳与 1 号龙的 0 号板凳相碰", marks=pytest.mark.chinese_font),
    ],
)
def test_the_benches_that_touch_are_named(language, words):
    with speaking(language):
        spec = FilmSpec(20.0, 30.0, height=180, touching=(2, 0), dragons=(0, 1))
        stage = FilmPicture(PERFORMANCE, spec, None, "")
        stage.frame(20.5, outlines_at(20.5), is_last=True)
    assert stage.time.text.startswith(words)


def test_the_film_ends_at_the_first_encounter_or_contact_and_marks_it():
    coiled = {"dragon": {"benches": 12}, "path": {"kind": "spiral", "start_turns": 5}}
    contact = first_contact(checked(FilmRequest, coiled).to_dance(100))
    far = NORTH | {"path": {"kind": "waypoints", "points": [[90, -20], [90, 20]]}}
    for body, stop in (
        (TWO, first_encounter(PERFORMANCE).time),
        (TWO | {"dances": [far, coiled | {"delay": 1}], "venue": None}, contact.time + 1.0),
    ):
        whole = film_of(body)
        cut = film_of(body | {"stop": stop})
        assert [(a == b).all() for a, b in zip(whole, cut, strict=True)] == [True] * 3 + [False]


BEATS = [{"bars": 8, "tempo": 96, "step": 0.6}]


def counted(dances, time):
    """The words of a picture at a time, before those of the time."""
    request = checked(FilmRequest, TWO | {"dances": dances})
    spec = FilmSpec(14.0, 18.0, height=90, **shared_music(request.dances or []))
    stage = FilmPicture(request.to_placed(Settings())[0], spec, None, "")
    return stage.words(time).partition("  ")[0]


def test_the_drum_is_that_of_the_first_dragon_with_beats_on_the_clock_of_all(client):
    body = TWO | {"dances": [EAST, NORTH | {"beats": BEATS}], "start": 14, "stop": 18, "seconds": 6, "rate": 10}
    data = client.post("/films", json=body).raise_for_status().content
    # The second dragon begins at 2 s.
    beats = [beat for beat in (2.0 + 60 / 96 * k for k in range(32)) if 14.0 <= beat <= 18.0]
    assert len(beats) == 6
    assert_heard(data, beats, FilmSpec(14.0, 18.0, 6.0, 10))


def test_the_count_names_its_dragon_unless_all_have_the_same_beats():
    own = {"beats": BEATS}
    other = {"beats": [{"bars": 8, "tempo": 120, "step": 0.5}]}
    # 12 s are 19.2 beats of the first music, and 14 s are 22.4 of it.
    assert counted([EAST, NORTH | own], 14.0) == "dragon 1: bar 5 beat 4"
    assert counted([EAST | own, NORTH | other], 14.0) == "east: bar 6 beat 3"
    assert counted([EAST | own, NORTH | own | {"delay": 0}], 14.0) == "bar 6 beat 3"
    assert counted([EAST, NORTH], 14.0) == "0:14.0 (14.00 s)"
