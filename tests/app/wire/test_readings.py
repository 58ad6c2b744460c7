"""What answers say to people, in both languages."""

import pytest

from tests.support.asking import box, dance, line

ENGINES = "separating axis", "FCL", "shapely", "angle sum (paper)"
SHORT = dance(3, (0, 0), (60, 0))
YARD = box(0, -0.15, 80, 9)
# A call, its query or body, and what stands in its sentences in English; {name} is a value of the answer.
SAID = [
    (
        "collision-time",
        {"margin": 0.02},
        "The head and body 12 come within 0.02 m at ({point[0]:.2f}, | The head is 2.67 m",
    ),
    (
        "collision-time",
        {"benches": 1},
        "No two benches touch before the run ends at 432.92 s. | the head can no longer",
    ),
    ("collision-time", {"benches": 40, "stray": 0.02}, "may touch with strays up to 0.02 m | a gap of 41.728 mm"),
    ("collision-time", SHORT | {"stop": 20}, "No two benches touch in this part of the dance."),
    (
        "minimum-pitch",
        {"benches": 20},
        "the circle of 9 m, and no two benches touch. | the head and the tail touch on the way",
    ),
    ("minimum-pitch", {"benches": 1}, "would begin inside the circle"),
    ("shortest-turn", {"benches": 9}, "It enters {entry_radius:.6f} m | the least radius of a bend"),
    ("quickest-turn", {"benches": 9}, "{length:.6f} m, with the head at {head_speed:.6f} m/s | 9 cm apart were tried"),
    ("turn-time", {"benches": 9}, "{length:.6f} m, with the head at {head_speed:.6f} m/s"),
    ("maximum-head-speed", {"benches": 9}, "exceeds 2 m/s; it is reached at {time:.6f} s by handles"),
    ("tolerance", {"benches": 40}, "Limited by the head and body 19, which are nearest to a contact at {time:.2f} s."),
    ("tolerance", {"benches": 9}, "until the head is on the circle of 9 m | limit up to half"),
    ("tolerance", SHORT, "In this part of the dance | There is no limit up to half of the shortest chord."),
    ("tolerance", SHORT | {"venue": YARD}, "The tail and square touch, or nearly touch, at {time:.2f} s"),
]


@pytest.mark.parametrize("call, about, words", SAID)
def test_an_answer_says_what_it_means_to_people(client, call, about, words):
    def answered(language):
        how = {"json": about} if "path" in about else {"params": about}
        headers = {"Accept-Language": language}
        return client.request("POST" if "path" in about else "GET", call, headers=headers, **how).json()

    answer = answered("en")
    text = " ".join(answer["sentences"])
    assert [part for part in words.split(" | ") if part.format(**answer).lower() not in text.lower()] == [], text
    chinese = answered("zh")["sentences"]
    assert len(chinese) == len(answer["sentences"])
    assert all("\u4e00" <= one[-2] <= "\u9fff" or one[-2] in "）m" for one in chinese), chinese


def test_a_bend_that_is_too_tight_says_what_its_bench_needs(client):
    body = {"path": line((0, 0), (5, 0), (5, 1), (0, 1), (0, 20))}
    for bend in client.post("course", json=body).json()["bends"]:
        assert f"a radius of {bend['radius']:.2f} m: " in bend["sentence"]
        assert f" With {bend['least_radius']:.2f} m the head can always follow." in bend["sentence"]


@pytest.mark.parametrize(
    "limits, sentences",
    [
        ({}, ["The tail touches square."]),
        ({"margin": 0.1}, ["The tail comes within 0.1 m of square."]),
        ({"stray": 0.1}, ["The tail may touch square with strays up to 0.1 m."]),
        (
            {"speed_limit": 0.5},
            ["The tail touches square.", "Too fast: the head exceeds 0.5 m/s; the highest speed is 1.00 m/s."],
        ),
    ],
)
def test_a_failure_names_benches_as_people_do_and_leaves_its_time_to_the_row(client, limits, sentences):
    answer = client.post("check", json=SHORT | {"venue": YARD} | limits).json()
    assert [one["sentence"] for one in answer["failures"]] == sentences


def test_words_say_how_an_answer_is_known_where_a_language_is_asked_for_and_only_there(client):
    asked = {"benches": 12, "cross_check": "pair"}
    plain, worded = (
        client.get("collision-time", params=asked, headers=more) for more in ({}, {"Accept-Language": "en"})
    )
    assert plain.json()["words"] is None
    assert plain.headers["etag"] != worded.headers["etag"]
    words = worded.json()["words"]
    assert words["title"] == "First contact"
    assert words["exact"] == f"Contact at {worded.json()['time']:.6f} s"
    assert words["engines"]["rows"][1:] == [[name, "apart", "they overlap"] for name in ENGINES]
    assert "alone. They agree." in words["engines"]["caption"]
