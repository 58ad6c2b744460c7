"""Films: their frames decoded again and compared with the poses, from the command, the service and a job."""

import io
import json

import numpy as np
import pytest
import shapely
from PIL import Image, ImageSequence

from app.files.film import DPI, FRONT_SHARE, MARKED_LEAST, FilmPicture, film
from app.files.film_labels import numbered, pictures_of, size_of
from app.files.film_spec import GIF_TYPE, MP4_TYPE, FilmSpec
from app.wire.degrees import place_of
from core import (
    Budget,
    Dance,
    Dragon,
    Route,
    Spiral,
    TooMuchWork,
    Turn,
    Waypoints,
    bench_outlines,
    bench_poses,
    first_contact,
    trajectory,
)
from core.people.beats import Bars, Music
from core.plots import BLUE
from tests.conftest import ROOT
from tests.support.command import said
from tests.support.depth import further, some
from tests.support.near import assert_near
from tests.support.random_squares import polygon

# Colours of the head and of the body; video keeps them to within a few parts of 255.
HEAD = (213, 94, 0)
BODY = (0, 114, 178)
NEAR = 60
SMALL = {"dragon": {"benches": 12}, "seconds": 1, "rate": 6, "height": 360, "stop": 60}


def opened(data):
    import av

    return av.open(io.BytesIO(data))


def decoded(data):
    if data.startswith(b"GIF"):
        with Image.open(io.BytesIO(data)) as picture:
            return [np.array(frame.convert("RGB")) for frame in ImageSequence.Iterator(picture)]
    with opened(data) as file:
        return [frame.to_ndarray(format="rgb24") for frame in file.decode(video=0)]


def is_like(pixel, colour):
    return np.abs(pixel.astype(int) - colour).max() < NEAR


def on_picture(stage, places):
    """Rows and columns of places in metres."""
    columns, rows = stage.axes.transData.transform(places).T
    return np.rint(np.stack([stage.canvas.get_width_height()[1] - rows, columns], axis=1)).astype(int)


def centres(stage, dance, instant):
    """Rows and columns of the middle of every bench at one instant."""
    return on_picture(stage, bench_poses(trajectory(dance, [instant]).position[0])[:, :2])


def outlines_of(dance, instant):
    return bench_outlines(dance.dragon, trajectory(dance, [instant]).position)[0]


def filmed(file, *options):
    """Frames of a film that the command writes."""
    said("film", *options, "--output", str(file), aside=None)
    return decoded(file.read_bytes())


def test_every_frame_shows_every_bench_where_it_is(tmp_path):
    words = "--path turn --start -20 --stop 40 --benches 30 --seconds 1 --rate 4"
    result = filmed(tmp_path / "dance.mp4", *words.split())
    # It has the pitch of the turn, not of the spiral, as in the table of `trajectory --path turn`.
    dance = Dance(Dragon(benches=30), Turn(1.7))
    spec = FilmSpec(-20.0, 40.0, 1.0, 4)
    stage = FilmPicture(dance, spec, None, "")
    for instant, picture in zip(spec.times, result, strict=True):
        assert picture.shape == (1080, 1920, 3)
        places = centres(stage, dance, float(instant))
        assert is_like(picture[tuple(places[0])], HEAD), instant
        assert all(is_like(picture[tuple(place)], BODY) for place in places[1:]), instant
        orange = np.argwhere((np.abs(picture.astype(int) - HEAD) < NEAR).all(axis=-1))
        assert np.abs(orange.mean(axis=0) - places[0]).max() < 3.0, instant


def test_the_last_frame_alone_marks_both_benches_that_touch(tmp_path):
    pictures = filmed(tmp_path / "dance.mp4", "--seconds=1", "--rate=2", "--height=1080", "--head-length=1.55")
    dance = Dance(Dragon(head_length=1.55), Spiral())
    time = first_contact(dance).time
    stage = FilmPicture(dance, FilmSpec(0.0, time), None, "")
    for instant, picture, marked in zip((0.0, time), pictures, ({0}, {0, 1, 8}), strict=True):
        places = centres(stage, dance, instant)
        assert {k for k, place in enumerate(places) if is_like(picture[tuple(place)], HEAD)} == marked


def test_a_film_plays_as_long_as_asked_and_a_gif_too(ask):
    data = ask.file("films", SMALL, MP4_TYPE)
    # A player can begin before it has all of it: the table stands before the pictures.
    assert 0 < data.find(b"moov") < data.find(b"mdat")
    with opened(data) as file:
        stream = file.streams.video[0]
        assert (stream.width, stream.height, stream.frames, float(stream.average_rate)) == (640, 360, 6, 6.0)
        assert len(file.streams.audio) == 0
    with Image.open(io.BytesIO(ask.file("films", SMALL, GIF_TYPE))) as picture:
        assert (picture.format, picture.size, picture.n_frames) == ("GIF", (640, 360), 6)
        assert 900 <= picture.info["duration"] * picture.n_frames <= 1100


@pytest.mark.parametrize("form", further([MP4_TYPE, GIF_TYPE], 1))
@pytest.mark.parametrize("frames", some(range(0, 20, 2), 2))
def test_stopping_a_film_harms_no_other(form, frames):
    """Its encoder may be writing a frame. The process lives on, and the next film is drawn."""
    budget = Budget()

    def stop_after(share):
        if share * spec.times.size >= frames:
            budget.stop()

    dance = Dance(Dragon(benches=5), Spiral())
    spec = FilmSpec(0.0, 60.0, 2.0, 12)
    # With a spent budget it must not be the trajectory of the first frames that ends it.
    for progress in (stop_after, lambda share: None):
        with pytest.raises(TooMuchWork, match="the film was not drawn"):
            film(dance, spec, form, budget=budget, progress=progress)
    assert len(film(dance, FilmSpec(0.0, 1.0, 0.2, 10), form)) > 1000


# A march of which a film shows a part in slow motion, and the error with which a stroke may be heard [s].
MARCH = [{"bars": 2, "tempo": 96, "step": 0.6}, {"bars": 2, "tempo": 132, "step": 0.3, "beats": 3}]
HEARD = 0.010
# A stroke begins where the sound is louder than LOUD [1] for the first time in APART [s].
LOUD = 0.15
APART = 0.2


def onsets(data):
    """Times at which the sound of a film begins to be loud [s], by the times that its packets name."""
    with opened(data) as file:
        stream = file.streams.audio[0]
        assert stream.codec_context.name == "aac"
        parts = [(float(frame.pts * frame.time_base), frame.to_ndarray()[0]) for frame in file.decode(stream)]
        rate = stream.codec_context.sample_rate
    times = np.concatenate([begin + np.arange(part.size) / rate for begin, part in parts])
    loud = times[np.abs(np.concatenate([part for _, part in parts])) > LOUD]
    return [float(one) for k, one in enumerate(loud) if k == 0 or one - loud[k - 1] > APART]


def assert_heard(data, beats, spec):
    """A stroke on each of the beats [s of the dance], and none beside them."""
    # Each frame shows its instant as long as it stands; between two of them time goes on evenly.
    heard = np.interp(beats, spec.times, np.arange(spec.times.size) / spec.rate)
    assert_near(onsets(data), heard, HEARD)


def test_the_drum_of_a_film_is_on_the_beat(ask):
    spec = FilmSpec(1.0, 6.0, 8.0, 10)
    times = {"start": 1.0, "stop": 6.0, "seconds": 8.0, "rate": 10, "height": 90}
    request = {"dragon": {"benches": 3}, "beats": MARCH, **times}
    data = ask.file("films", request, MP4_TYPE)
    assert_heard(data, [60 / 96 * k for k in range(2, 8)] + [5.0 + 60 / 132 * k for k in range(3)], spec)
    with opened(data) as file:
        video, sound = file.streams
        assert video.frames == spec.times.size
        assert_near(float(sound.duration * sound.time_base), 8.0, 0.05)
    assert ask.file("films", request, MP4_TYPE) == data


def test_a_film_counts_bars_and_beats_and_shows_the_time_of_day():
    music = Music([Bars(2, 96.0, 0.6), Bars(2, 132.0, 0.3, beats=3)])
    dance = Dance(Dragon(3), Spiral(), 1.0, music.passages)
    stage = FilmPicture(dance, FilmSpec(0.0, 9.0, music=music, start_clock="19:30"), None, "")
    for instant, words in ((5.46, "bar 3 beat 2  19:30:05 (5.46 s)"), (8.5, "19:30:08 (8.50 s)")):
        stage.frame(instant, [outlines_of(dance, instant)])
        assert stage.time.text == words


def fronts(stage, outlines):
    """Rows and columns halfway from the middle of each bench to its front."""
    return on_picture(stage, 0.5 * (outlines.mean(axis=1) + outlines[:, :2].mean(axis=1)))


def test_the_head_and_every_tenth_bench_have_their_numbers():
    dance = Dance(Dragon(), Spiral())
    stage = FilmPicture(dance, FilmSpec(0.0, 300.0), None, "")
    for instant in (0.0, 171.3):
        outlines = outlines_of(dance, instant)
        picture = stage.frame(instant, [outlines])
        places = fronts(stage, outlines)
        for k, (_, left, top) in zip(range(0, 223, 10), stage.layers[0].labels[0].placed, strict=True):
            digits = pictures_of([str(k)], size_of(1080), BLUE, DPI)[0]
            high, wide, _ = digits.shape
            assert np.abs(places[k] - (top + 0.5 * high, left + 0.5 * wide)).max() <= 1.0
            there = picture[top : top + high, left : left + wide]
            assert (there == digits[..., :3])[digits[..., 3] == 255].all(), (instant, k)


@pytest.mark.parametrize(
    "benches, spacing, step",
    [(223, 110.0, 10), (300, 110.0, 10), (24, 110.0, 1), (223, 2.0, 50), (2000, 9.0, 100)],
)
def test_a_small_picture_and_a_long_dragon_have_fewer_numbers(benches, spacing, step):
    assert list(numbered(benches, spacing, size_of(1080))) == list(range(0, benches, step))


YELLOW = (240, 228, 66)
VILLAGE = ROOT / "examples" / "village_square.geojson"


def village(height=540):
    """A picture of a dragon that winds across the village square, so far away that a bench is two pixels wide."""
    venue = place_of(json.loads(VILLAGE.read_bytes()), None, Dragon()).venue
    winding = Waypoints([(-67, -8), (-12, -8), (-3, -9), (6, -8), (10.5, -3), (7, 2.5), (0, 3.5), (-4.5, 7), (-1, 10.5),
                         (6, 10.5), (12, 15), (12, 62)])  # fmt: skip
    dance = Dance(Dragon(benches=24), Route([winding], start=50.0))
    return FilmPicture(dance, FilmSpec(0.0, 119.0, height=height, marked=((0, 17),)), venue, ""), venue


@pytest.mark.parametrize("height", further([540, 1080], 1))
def test_a_marked_bench_is_wide_enough_to_be_seen(height):
    stage, _ = village(height)
    for instant in (0.0, 40.0, 70.0, 90.0, 119.0):
        outlines = outlines_of(stage.filmed, instant)
        picture = stage.frame(instant, [outlines]).astype(int)
        front, rear = outlines[17].reshape(2, 2, 2).mean(axis=1)
        # Its front is dark, so the yellow is behind.
        shares = np.array([0.0, 0.5 * FRONT_SHARE, 0.5 * (1.0 + FRONT_SHARE), 1.0])[:, None]
        first, dark, behind, last = on_picture(stage, front + shares * (rear - front))
        yellow = np.argwhere((np.abs(picture - YELLOW) < NEAR).all(axis=-1))
        assert len(yellow) > 0.5 * (1.0 - FRONT_SHARE) * MARKED_LEAST * height * np.hypot(*(first - last))
        assert np.hypot(*(np.median(yellow, axis=0) - behind)) < 3.0
        assert picture[tuple(dark)].max() < 60


def test_a_number_stands_on_the_outer_side_of_a_bend_and_does_not_flicker():
    stage, _ = village()
    numbers = stage.layers[0].labels[1]
    changes = 0
    before = 0.0
    for instant in np.linspace(0.0, 119.0, 400):
        outlines = outlines_of(stage.filmed, instant)
        numbers.place(outlines)
        changes, before = changes + (numbers.sides[0] != before), float(numbers.sides[0])
        middles = stage.axes.transData.transform(outlines[12:23].mean(axis=1))
        bend = middles.mean(axis=0) - middles[5]  # towards the inner side
        if np.hypot(*bend) > 10.0:
            assert (numbers.places[0] - middles[5]) @ bend < 0.0, instant
    assert 2 <= changes <= 5


def test_names_of_areas_stand_where_these_are_wide_and_off_the_path():
    stage, venue = village()
    (names,) = stage.names
    places = map(shapely.Point, stage.axes.transData.inverted().transform(names.places))
    square, *others = map(polygon, venue.areas)
    of_square, *of_others = places
    path = shapely.LineString(stage.axes.lines[0].get_xydata())
    free = square.difference(shapely.union_all(others))
    assert free.boundary.union(path).distance(of_square) > 3.0  # a street is 6 m wide
    assert free.contains(of_square)
    for area, shape, place in zip(venue.obstacles, others, of_others, strict=True):
        if area.name == "stage":
            assert shape.centroid.distance(place) < 0.1
        else:  # too small: beside
            assert 0.0 < shape.distance(place) < 8.0, area.name


def test_marked_benches_have_number_and_name_and_are_chosen_by_either(tmp_path):
    names = [*("" for _ in range(11)), "Li"]
    dance = Dance(Dragon(benches=12).named(names), Spiral())
    stage = FilmPicture(dance, FilmSpec(0.0, 60.0, marked=((0, 7), (0, 11))), None, "")
    assert stage.layers[0].words == {7: "7", 11: "11 Li"}
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(SMALL | {"dragon": {"benches": 12, "names": names}}))
    films = [filmed(tmp_path / "dance.gif", str(file), *bench.split()) for bench in ("--bench 11", "--bench Li", "")]
    assert np.array_equal(films[0], films[1])
    assert not np.array_equal(films[0], films[2])


def test_the_time_stands_in_the_lower_right_corner():
    stage, _ = village()
    dark = []
    for words in ("", "benches 3 and 9 touch\n1:23.0 (83.06 s)"):
        stage.time.text = words
        stage.planes.begin()
        stage.planes.lay(stage.time.placed)
        dark.append(stage.planes.picture[..., 0] < 100)
    letters = np.argwhere(dark[1] & ~dark[0])
    assert len(letters) > 400
    assert np.abs(letters.max(axis=0) - (0.97 * 540, 0.985 * 960)).max() < 6.0
