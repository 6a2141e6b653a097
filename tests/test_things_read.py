"""What is read of things that were seen: scenes that can be, doubt, answers; nothing is trained."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seewhy.agent.things.thing_reading import SceneReader, ThingReading
from seewhy.agent.things.thing_reply import PictureReply, ReadScene
from seewhy.agent.things.thing_seeing import Sighting
from seewhy.data.measured import MEASURES, how_probable
from seewhy.dialogue.certainty import Certainty
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import Domain, load_domain
from seewhy.knowledge.reasoner import Reasoner, Verdict
from things_builder import write_domain


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    return load_domain(write_domain(tmp_path_factory.mktemp("shelf")))


@pytest.fixture(scope="module")
def reasoner(shelf: Domain) -> Reasoner:
    return Reasoner(shelf.knowledge, shelf.schema)


def sighting(
    *things: tuple[float, float, float],
    on: dict[tuple[int, int], float] | None = None,
    spread: float = 0.0,
    left_out: int = 0,
) -> Sighting:
    """Things beside each other: how surely each is there, red, and a box."""
    count = len(things)
    boxes = np.array([[20.0 * n, 50, 20 * n + 14, 64] for n in range(count)]).reshape(-1, 4)
    table = np.zeros((count, count))
    for pair, share in (on or {}).items():
        table[pair] = share
    off = np.full((count, 4), spread)
    values = {
        "colour": np.array([[red, 1 - red] for _, red, _ in things]).reshape(-1, 2),
        "form": np.array([[box, 1 - box] for _, _, box in things]).reshape(-1, 2),
        "size": np.array([[0.99, 0.01]] * count).reshape(-1, 2),
    }
    related = {"on": table, "under": table.T}
    for key in ("left", "right"):
        related[key] = how_probable(MEASURES[key], boxes, off)
    presence = np.array([there for there, _, _ in things])
    whole = {"light": np.array([0.9, 0.1]), "class": np.array([0.7, 0.3])}
    return Sighting(boxes, presence, values, related, whole, left_out)


def values_of(reading: ThingReading, key: str) -> list[str]:
    return [thing.values[key].value for thing in reading.things]


def ask(shelf: Domain, reasoner: Reasoner, seen: Sighting, question: str) -> PictureReply:
    assert shelf.things is not None
    read = ReadScene(shelf, SceneReader(shelf, reasoner).read(seen), reasoner)
    reply = ThingAnswerer(shelf.things).answer(question, read.scene)
    return PictureReply(reply, read, *read.doubt(reply))


def test_what_is_seen_surely_is_read_so(shelf: Domain, reasoner: Reasoner) -> None:
    reading = SceneReader(shelf, reasoner).read(sighting((0.99, 0.9, 0.9), (0.99, 0.2, 0.1)))
    assert values_of(reading, "colour") == ["red", "blue"]
    assert values_of(reading, "form") == ["box", "ball"]
    assert (reading.settled, reading.tried, reading.doubtful) == (True, 1, ())
    assert (reading.label, reading.method, reading.verdict) == ("tidy", "seen", Verdict.SILENT)


def test_the_knowledge_overrules_the_less_sure_of_two(shelf: Domain, reasoner: Reasoner) -> None:
    # Nothing lies on a ball: either it is no ball, or nothing lies on it.
    relation = SceneReader(shelf, reasoner).read(
        sighting((0.99, 0.9, 0.9), (0.99, 0.9, 0.05), on={(0, 1): 0.7})
    )
    assert values_of(relation, "form") == ["box", "ball"]
    shown = dict(zip(shelf.schema.features, relation.vector, strict=True))
    assert shown["on(thing1,thing2)"] == "no"
    value = SceneReader(shelf, reasoner).read(
        sighting((0.99, 0.9, 0.9), (0.99, 0.9, 0.4), on={(0, 1): 0.95})
    )
    assert values_of(value, "form") == ["box", "box"]
    assert value.things[1].values["form"].overruled == ("ball", 0.6)
    assert value.tried > 1


def test_a_doubtful_thing_is_left_out_where_that_is_likelier(
    shelf: Domain, reasoner: Reasoner
) -> None:
    reading = SceneReader(shelf, reasoner).read(
        sighting((0.99, 0.9, 0.9), (0.6, 0.9, 0.01), on={(0, 1): 0.99})
    )
    assert len(reading.things) == 1
    assert [thing.probability for thing in reading.doubtful] == [0.6]


def test_it_is_said_that_no_reading_tried_is_consistent(shelf: Domain, reasoner: Reasoner) -> None:
    sure = sighting((0.99, 0.9, 0.9), (0.99, 0.9, 0.001), on={(0, 1): 0.999})
    reading = SceneReader(shelf, reasoner).read(sure)
    assert not reading.settled
    assert values_of(reading, "form") == ["box", "ball"]
    bounded = SceneReader(shelf, reasoner, tried=1).read(
        sighting((0.99, 0.9, 0.9), (0.99, 0.9, 0.4), on={(0, 1): 0.95})
    )
    assert (bounded.settled, bounded.tried) == (False, 1)


def test_readings_come_in_falling_order_of_probability(shelf: Domain, reasoner: Reasoner) -> None:
    """The search finds what listing all readings finds."""
    from itertools import product

    generator = np.random.default_rng(3)
    reader = SceneReader(shelf, reasoner, tried=100_000, seconds=60)
    for _ in range(6):
        rows = generator.uniform(0.2, 0.8, (2, 3))
        rows[:, 0] = generator.uniform(0.5, 0.8, 2)
        on = {
            (0, 1): float(generator.uniform(0.3, 0.9)),
            (1, 0): float(generator.uniform(0.3, 0.9)),
        }
        seen = sighting(*(tuple(row) for row in rows), on=on)
        best = max(
            (
                score
                for there in product((True, False), repeat=2)
                for red in product((0, 1), repeat=2)
                for form in product((0, 1), repeat=2)
                for upon in product((True, False), repeat=2)
                if (score := _score(seen, there, red, form, upon)) is not None
            ),
        )
        found = reader.read(seen)
        places = dict(zip(found.places, (True,) * len(found.things), strict=False))
        there = (places.get(0, False), places.get(1, False))
        by_place = dict(zip(found.places, (*found.things, *found.doubtful), strict=True))
        red = tuple(int(by_place[n].values["colour"].value != "red") for n in (0, 1))
        form = tuple(int(by_place[n].values["form"].value != "box") for n in (0, 1))
        shown = dict(zip(shelf.schema.features, found.vector, strict=True))
        upon = (
            shown["on(thing1,thing2)"] == "yes",
            shown["on(thing2,thing1)"] == "yes",
        )
        score = _score(seen, there, red, form, upon)
        assert score == pytest.approx(best)


def _score(
    seen: Sighting,
    there: tuple[bool, ...],
    red: tuple[int, ...],
    form: tuple[int, ...],
    upon: tuple[bool, ...],
) -> float | None:
    """What a reading costs beside each choice's most probable; None where it cannot be."""
    if all(there) and ((upon[0] and form[1]) or (upon[1] and form[0])):
        return None
    score = 0.0
    for n in (0, 1):
        presence = seen.presence[n]
        score += np.log((presence if there[n] else 1 - presence) / max(presence, 1 - presence))
        if there[n]:
            for key, chosen in (("colour", red[n]), ("form", form[n])):
                row = seen.values[key][n]
                score += np.log(row[chosen] / row.max())
    if all(there):
        for at, pair in enumerate(((0, 1), (1, 0))):
            share = seen.related["on"][pair]
            score += np.log((share if upon[at] else 1 - share) / max(share, 1 - share))
    return float(score)


def test_an_answer_that_rests_on_what_is_unsure_says_so(shelf: Domain, reasoner: Reasoner) -> None:
    seen = sighting((0.99, 0.97, 0.99), (0.99, 0.7, 0.99))
    reds = ask(shelf, reasoner, seen, "how many red shapes are there?")
    assert reds.text.startswith("Probably there are two")
    assert reds.certainty is Certainty.PROBABLY
    assert "is red (0.70)" in str(reds.say_least_sure())
    boxes = ask(shelf, reasoner, seen, "how many boxes are there?")
    assert boxes.certainty is Certainty.SURE
    assert boxes.text.startswith("There are two")


def test_what_may_be_there_makes_a_count_unsure_but_not_each_answer(
    shelf: Domain, reasoner: Reasoner
) -> None:
    seen = sighting((0.99, 0.99, 0.99), (0.4, 0.01, 0.99))
    every = ask(shelf, reasoner, seen, "how many shapes are there?")
    assert (every.reply.value, every.certainty) == (1, Certainty.PERHAPS)
    assert "is not there (0.60)" in str(every.say_least_sure())
    reds = ask(shelf, reasoner, seen, "how many red shapes are there?")
    assert (reds.reply.value, reds.certainty) == (1, Certainty.SURE)


def test_boxes_nearly_above_each_other_make_their_order_unsure(
    shelf: Domain, reasoner: Reasoner
) -> None:
    question = "is the red box left of the blue box?"
    apart = sighting((0.99, 0.99, 0.99), (0.99, 0.01, 0.99), spread=1.0)
    assert ask(shelf, reasoner, apart, question).certainty is Certainty.SURE
    near = sighting((0.99, 0.99, 0.99), (0.99, 0.01, 0.99), spread=30.0)
    assert ask(shelf, reasoner, near, question).certainty is not Certainty.SURE


def test_a_picture_without_things_is_answered(shelf: Domain, reasoner: Reasoner) -> None:
    empty = sighting()
    assert ask(shelf, reasoner, empty, "how many shapes are there?").reply.value == 0
    assert ask(shelf, reasoner, empty, "is there a ball?").text.startswith("No")
    missing = ask(shelf, reasoner, empty, "what colour is the ball?")
    assert "no ball" in missing.text


def test_which_is_asked_back_where_several_could_be_meant(
    shelf: Domain, reasoner: Reasoner
) -> None:
    seen = sighting((0.99, 0.99, 0.99), (0.99, 0.99, 0.99))
    assert ask(shelf, reasoner, seen, "what size is the red box?").text.startswith("Which red box?")


def test_a_scene_as_json_has_boxes_values_and_probabilities(
    shelf: Domain, reasoner: Reasoner
) -> None:
    seen = sighting((0.99, 0.9, 0.9), (0.3, 0.9, 0.9), left_out=2)
    told = ask(shelf, reasoner, seen, "what is there?").to_dict()
    (thing,) = told["scene"]["things"]
    assert thing["box"] == [0.0, 50.0, 14.0, 64.0]
    assert thing["values"]["colour"] == {"value": "red", "probability": 0.9, "overruled": None}
    assert [one["probability"] for one in told["scene"]["doubtful"]] == [0.3]
    assert told["scene"]["left_out"] == 2


def test_a_card_draws_what_the_answer_rests_on(
    shelf: Domain, reasoner: Reasoner, tmp_path: Path
) -> None:
    from seewhy.report.thing_card import draw_thing_card, rests_on

    seen = sighting((0.99, 0.99, 0.99), (0.99, 0.01, 0.99), (0.3, 0.5, 0.5))
    reply = ask(shelf, reasoner, seen, "what colour is the leftmost shape?")
    drawn = draw_thing_card(reply, np.zeros((80, 80, 3), dtype=np.uint8))
    assert drawn.svg.count("<rect x=") >= 3
    assert "stroke-dasharray" in drawn.svg
    assert "thing1" in rests_on(reply)
    assert drawn.save(tmp_path / "card.svg").is_file()


def test_how_sure_an_answer_is_can_be_asked(shelf: Domain, reasoner: Reasoner) -> None:
    """Of what is seen with its probability; of the class that eyes see, with that of the eyes."""
    assert shelf.things is not None
    answerer = ThingAnswerer(shelf.things)
    seen = sighting((0.99, 0.8, 0.99), (0.99, 0.01, 0.99))
    read = ReadScene(shelf, SceneReader(shelf, reasoner).read(seen), reasoner)
    red = answerer.answer("how many red boxes are there?", read.scene)
    sure = answerer.answer("how sure are you?", read.scene, previous=red)
    told = PictureReply(sure, read, *read.doubt(sure))
    assert told.text == (
        "I am not sure: it is right with a probability of 0.80; the least sure is that the red "
        "small box is red (0.80)."
    )
    whole = ask(shelf, reasoner, seen, "is it tidy?")
    assert (whole.text, round(whole.probability, 2)) == ("Probably yes, the picture is tidy.", 0.7)
    assert whole.say_least_sure() == "the picture is tidy (0.70)"
    assert "the picture looks tidy as a whole" in whole.justification.to_text()
