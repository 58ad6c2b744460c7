"""The people of a dance: their benches one by one, their speeds, the time of day, and who carries when."""

import re

import pytest

from tests.support import paper, polite
from tests.support.person import alike

thorough = pytest.mark.thorough
STREET = "path=route&route=*-40,0_40,0&benches=9"
CREW = f"?door=village&lang=en&{STREET}&begin=30&time=20&start_clock=19%3A30"
BODY = {
    "dragon": {"benches": 9},
    "path": {"kind": "waypoints", "points": [[-40, 0], [40, 0]], "straight": [0], "start": 30},
    "start_clock": "19:30",
}
TABLE = "name,length,width,overhang\nZhou,3.41,0.3,0.275\nLi,2.2,0.3,0.275\nWu,1.8,0.7,0.2\nHe,2,0.3,0.2"
PASSAGES = [{"speed": 0.5, "until_s": 20}, {"speed": 0, "until_time": 100}, {"speed": 1.5, "until_s": 60}]
A3_WIDE = 420 / 25.4 * 72  # [points]
RESULT = "#crew-result"


def crew(server, **fields):
    """The people from the beginning of the dance as it is checked."""
    start = polite.answer(server, "check", BODY)["start"]
    return polite.answer(server, "crew", BODY | {"start": start} | fields)


def contact_of(server, **request):
    """Time of first contact by the service, in the words of the page."""
    result = polite.answer(server, "collision-time", {"path": {"kind": "spiral"}, **request})
    return f"{result['time'] if result['time'] is not None else result['end']['time']:.6f} s"


def test_who_carries_when_and_where_is_as_the_service_says(open_page, server):
    person = open_page(CREW, failing=True).reaches_below().presses("#crew summary").holds({"#crew-at": "20"})
    numbers = {"spares": "3", "shift": "15", "rest": "10", "x": "0", "y": "0,5"}
    person.types({f"#crew-{name}": number for name, number in numbers.items()}, "Tab").presses("#crew-ask")
    answer = crew(server, spares=3, shift=15, rest=10, points=[{"x": 0, "y": 0.5}], at=20)
    assert answer["changes"] > 6
    person.sees({f"{RESULT} .error": [f"{answer['enough']} spares are enough", f"{len(answer['unrelieved'])} of "]})
    people = f"{answer['people']} people, 3 of them spare"
    person.sees(
        {
            f"{RESULT} > .error + details": True,
            f"{RESULT} p": people,
            RESULT: "Who is where at 19:30:20",
            f"{RESULT} table": 2,
        }
    )
    cells = [person.all(f"{RESULT} table >> nth={k} >> tbody tr").all() for k in range(2)]
    roll, carriers = ([row.locator("th, td").all_inner_texts() for row in rows] for rows in cells)
    benches = [[", ".join(one["people"]), f"{one['mark']:g}"] for one in answer["at"]["benches"]]
    assert [row[1:] for row in roll] == benches
    carried = [[one["label"], f"{one['way']:.0f}"] for one in answer["carriers"]]
    assert [[row[0], row[2]] for row in carriers] == carried
    assert [row.locator("i").count() for row in cells[1]] == [len(one["spells"]) for one in answer["carriers"]]
    assert person.saves("#crew-A4").startswith(b"%PDF")
    assert person.saves("#crew-CSV").startswith(b"person,label")
    person.types({"#crew-at": "19:30:30", "#crew-shift": "600"}, "Tab").presses("#crew-ask")
    person.sees({f"{RESULT} .error": "got 600 s"}).types({"#crew-shift": "20"}, "Tab").presses("#crew-ask")
    person.sees({RESULT: "Who is where at 19:30:30"}).speaks("zh").sees({f"{RESULT} p": "其中替补 3 人"})
    # Those people were of another dance.
    person.types({"#benches": "8"}).sees({f"{RESULT} table": 0})


def test_benches_one_by_one_are_danced_drawn_named_shared_and_refused_by_line(open_page, server):
    person = open_page("?time=0&benches=5&view=8,-3,40", failing=True).presses("#one-by-one summary")
    answer = "#first-contact .value"
    narrow = TABLE.replace("1.8,0.7", "1.8,0.2")
    wu = "#rows tr:has-text('body 2 (Wu)')"
    person.types({"#csv": TABLE}, "Tab").sees({answer: contact_of(server, dragon={"csv": TABLE}), wu: True})
    wide = person.settles().picture()
    # One bench narrower: its chord, and so the whole pose, stays; the picture does not.
    person.types({"#csv": narrow}, "Tab").arrives("**csv=*0.2,0.2*")
    assert not alike(wide, person.settles().picture())
    person.reaches_below().sees({"#curl": "Wu,1.8,0.2"})
    assert person.saves("#keepTrajectory-CSV").splitlines()[2].endswith(b",Li")
    person.page.reload()
    person.sees({wu: True}).holds({"#csv": narrow}).types({"#csv": TABLE.replace("2.2,0.3", "2.2,30", 1)}, "Tab")
    person.sees({"#csv-error": ["Line 3", "30 m"]})
    person.presses("#csvClear").sees({answer: contact_of(server, dragon={"benches": 5})})


@thorough
def test_passages_and_the_time_of_day_change_every_time_of_a_spiral_and_of_a_drawn_dance(open_page, server):
    # A pause lies at the instant shown.
    person = open_page("?benches=30&time=50", failing=True).presses("#passages summary", "#pauseAdd")
    person.arrives("**passages=1@50s_0@10d*").opens("?benches=30&time=50").presses("#passages summary")
    for k, (until, unit, speed) in enumerate([("20", "m", "0.5"), ("100", "s", "0"), ("60", "m", "1.5")]):
        row = f"#passages li >> nth={k}"
        person.presses("#passageAdd").chooses({f"{row} >> select": unit})
        person.types({f"{row} >> input >> nth=0": until, f"{row} >> input >> nth=1": speed}, "Tab")
    person.types({"#begin_clock": "7.30 AM"}, "Tab")
    contact = {"#first-contact .value": contact_of(server, dragon={"benches": 30}, passages=PASSAGES)}
    # The head rests, and so does everybody.
    person.sees({**contact, "#clock": re.compile(r"^50.000000 s\s*07:30:50$")})
    person.reads({"#rows tbody td >> nth=3": "0.000000"})
    person.arrives("**passages=0.5@20m_0@100s_1.5@60m*begin_clock=*")
    person.page.reload()
    person.sees({**contact, "#passages li": 3}).types({"#begin_clock": "25 o'clock"}, "Tab")
    person.sees({"#clock-error": "07:30:00"}).chooses({"#passages li >> nth=1 >> select": "m"})
    person.sees({"#passages .error": True})
    limits = {"speed_limit": 0.9, "start_clock": "19:30", "passages": PASSAGES[:2]}
    body = BODY | limits | {"head_speed": 1}
    failure = polite.answer(server, "check", body)["failures"][0]
    person.opens(f"?{STREET}&begin=30&limit=0.9&passages=0.5@20m_0@100s&start_clock=19:30")
    person.reads({".failures button": f"{failure['time']:.6f} s · {failure['clock']}"}).reaches()
    (first, *_) = paper.pages_of(person.saves("#keepPlan-A3"))
    assert max(first.get_size()) == pytest.approx(A3_WIDE, abs=1)
    # Head and first bench lead by 16 s of the 80 s of the path.
    person.opens(f"?{STREET}&start_clock=19:30").sees({"#judgement": "It starts at 19:30:16"})
    person.types({"#begin_clock": "20:00"}, "Tab").settles()
    person.sees({"#judgement": "It starts at 20:00:00", "#clock-help": "20:01:03"})
    assert {"start_clock", "begin_clock"} & person.address().keys() == {"begin_clock"}
