"""The five questions of the contest, each answered with its reasons: what is handed in is what grading calls right."""

import io
import re
from zipfile import ZipFile

import pytest

from app.contest.kit import PARTS
from app.questions.contest_kit import ContestKitRequest, contest_kit
from app.wire.question import Terms
from core import Dance, Dragon, Turn, trajectory
from core.language import Language
from tests.support.near import assert_near

TEXTS = {
    1: "(4.420274, 2.320429) m",
    2: "412.473838 s",
    3: "0.450338 m",
    4: "13.621245 m",
    5: "1.246266 m/s",
}
# What a reader finds among the reasons of each answer.
REASONS = {
    1: ["(1.785033, 9.301164) m", "0.996478 m/s"],
    2: ["The head and body 8 meet", "at 409.83 s two benches pass with 0.865 mm"],
    3: ["the head and body 19 touch on the way", "falls in jumps"],
    4: ["no ratio changes this length", "3.021487 rad", "4.508127 m", "1.430 m"],
    5: [
        "handles 3, 4, 5, 6, 7",
        "1.6048 times the speed of the head",
        "(-0.46, 1.68) m",
        "2 / 1.604793 = 1.246266 m/s",
    ],
}


def answered(client, question, **more):
    return client.get("/contest-answer", params={"question": question, **more}).raise_for_status().json()


@pytest.mark.parametrize("question", TEXTS)
def test_each_question_has_its_digits_its_reasons_and_a_picture_in_both_languages(client, question):
    answer = answered(client, question)
    assert answer["text"] == TEXTS[question]
    words = " ".join(answer["sentences"])
    assert [one for one in REASONS[question] if one not in words] == []
    lines = answer["picture"]["strokes"]
    assert {"head", "mark", "first_arc"} & {line["role"] for line in lines}
    assert all(line["points"] for line in lines)
    chinese = client.get("/contest-answer", params={"question": question}, headers={"Accept-Language": "zh"}).json()
    said = [
        chinese["asks"],
        *chinese["sentences"],
        chinese["picture"]["words"],
        *(one["words"] for one in chinese["offers"]),
    ]
    assert [one for one in said if not re.search("[一-鿿]", one) or re.search("[a-z]{4}", one)] == []


def test_what_an_answer_says_is_judged_right_and_its_example_too(client):
    for question in TEXTS:
        answer = answered(client, question)
        if name := answer["number"]:
            for text in (answer["example"], answer["text"]):
                query = {name: text}
                [verdict] = client.post(
                    "/grade", params=query, content=b"", headers={"Content-Type": "application/octet-stream"}
                ).json()["answers"]
                assert verdict["verdict"] == "right"
        else:
            assert answer["workbook"]


def test_the_shortest_turns_come_when_they_are_asked_for_and_can_be_danced(client):
    brief = answered(client, 4)
    whole = answered(client, 4, further=True)
    assert brief["more"] == "How much shorter?"
    assert whole["more"] is None
    words = " ".join(whole["sentences"][len(brief["sentences"]) :])
    assert [
        one
        for one in (
            "11.799152 m",
            "4.290395 m",
            "8.223984 m",
            "whose bends have radii of at least 1.4314 m",
            "7.693408 m",
            "0.951 m",
        )
        if one not in words
    ] == []
    lengths = []
    for offer in whole["offers"]:
        numbers = offer["numbers"]
        turn = Turn(
            1.7, ratio=numbers["ratio"], entry_radius=numbers["entry_radius"], exit_radius=numbers["exit_radius"]
        )
        assert trajectory(Dance(Dragon(), turn), [numbers["time"]]).position.shape == (1, 224, 2)
        lengths.append(round(turn.length, 6))
    assert lengths == [13.621245, 11.799152, 8.223984, 7.693408]
    # No ratio changes a length, and a deeper entry shortens it, until an arc is too tight.
    table = whole["turns"]["lengths"]
    rows = [{round(length, 9) for length in row if length is not None} for row in table]
    assert [len(row) for row in rows] == [1] * len(rows)
    assert sorted(rows, key=max) == rows
    assert rows[-1] == {round(Turn(1.7).length, 9)}
    assert sum(length is None for length in table[0]) > sum(length is None for length in table[-1]) > 0


def test_the_fastest_handle_is_where_the_answer_says(client):
    [offer] = answered(client, 5)["offers"]
    numbers = offer["numbers"]
    motion = trajectory(Dance(Dragon(), Turn(1.7), numbers["head_speed"]), [numbers["time"]])
    handle = int(numbers["handle"])
    assert motion.speed[0].argmax() in (handle, *range(handle, 8))
    assert_near(motion.speed[0, handle], 2.0, 1e-8)
    assert motion.position[0, handle].round(2).tolist() == [-0.46, 1.68]


@pytest.mark.parametrize("question", PARTS)
def test_what_is_handed_in_for_one_question_is_its_part_of_the_kit(question):
    request = ContestKitRequest(benches=6, stop=60.0, span=10.0, question=question, language=Language.ENGLISH)
    with ZipFile(io.BytesIO(contest_kit(request, Terms()))) as archive:
        names = archive.namelist()
    stems = {name.rpartition("/")[2].rpartition(".")[0] for name in names} - {"answers"}
    assert stems == {part.removesuffix(".xlsx") for part in PARTS[question]}
