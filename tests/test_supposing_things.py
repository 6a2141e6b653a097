"""What if things were otherwise: read from an address, answered, and what follows."""

from __future__ import annotations

from itertools import product

import pytest

from seewhy.agent.things.thing_supposing import SupposedThings, say_edits, suppose_things
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.domain.domain import Domain
from seewhy.errors import SeeWhyError
from seewhy.knowledge.reasoner import Reasoner
from seewhy.studio.supposing_things import edits_of, fields_of, read_supposition
from test_things_read import ask, reasoner, shelf, sighting

__all__ = ["reasoner", "shelf"]

# A red box, with another on it that is blue, and a blue ball at the right.
SEEN = sighting((0.99, 0.98, 0.97), (0.99, 0.02, 0.96), (0.99, 0.01, 0.02), on={(1, 0): 0.97})
HOW_MANY = "how many red boxes are there?"


def supposed(
    shelf: Domain, reasoner: Reasoner, question: str, *fields: tuple[str, str]
) -> tuple[SupposedThings, list[str]]:
    reply = ask(shelf, reasoner, SEEN, question)
    edits = edits_of(read_supposition(fields, reply.read), reply.read)
    assert shelf.things is not None
    found = suppose_things(ThingAnswerer(shelf.things), reply, edits)
    return found, say_edits(reply.read, edits)


def test_the_answer_is_that_of_a_scene_which_is_so(shelf: Domain, reasoner: Reasoner) -> None:
    """All values of two things at once, beside counting."""
    reply = ask(shelf, reasoner, SEEN, HOW_MANY)
    assert shelf.things is not None
    answerer = ThingAnswerer(shelf.things)
    for one, two in product(product(("red", "blue"), ("box", "ball")), repeat=2):
        fields = [
            (f"shows.{number}.{key}", value)
            for number, values in ((1, one), (3, two))
            for key, value in zip(("colour", "form"), values, strict=True)
        ]
        edits = edits_of(read_supposition(fields, reply.read), reply.read)
        then = answerer.suppose(reply.reply, reply.read.scene, edits)
        assert then.value == [one, two].count(("red", "box"))


@pytest.mark.parametrize(
    ("question", "fields", "clauses", "text"),
    [
        (
            HOW_MANY,
            [("gone", "1")],
            ["the red small box were not there"],
            "There is no red box.",
        ),
        (
            "what is on the red box?",
            [("holds.on.2.1", "no"), ("holds.on.3.1", "yes")],
            [
                "it were not so that the blue small box is on the red small box",
                "the blue small ball were on the red small box",
            ],
            "There is one shape on the red small box: the blue small ball.",
        ),
        (
            "what is the leftmost shape?",
            [("place.left.3", "0")],
            ["the blue small ball were left of the red small box"],
            "It is the blue small ball: it is blue, it is a ball and it is small.",
        ),
        (
            HOW_MANY,
            [("more", ""), ("shows.4.size", "large")],
            ["there were a red large box right of the blue small ball as well"],
            "There are two red boxes: the red small box and the red large box.",
        ),
        (
            "is there a red box on a red box?",
            [("added", "1"), ("holds.on.4.1", "yes"), ("holds.on.2.4", "yes")],
            [
                "there were a red small box right of the blue small ball on the red small box "
                "as well",
                "the blue small box were on the red small box (shape 4)",
            ],
            "Yes: there is one red box on a red box: the red small box (shape 4).",
        ),
    ],
)
def test_what_is_supposed_is_said_and_answered(
    shelf: Domain,
    reasoner: Reasoner,
    question: str,
    fields: list[tuple[str, str]],
    clauses: list[str],
    text: str,
) -> None:
    then, said = supposed(shelf, reasoner, question, *fields)
    assert (said, then.reply.text) == (clauses, text)


def test_the_class_follows_by_the_rules(shelf: Domain, reasoner: Reasoner) -> None:
    then, _ = supposed(shelf, reasoner, HOW_MANY, ("shows.2.form", "ball"))
    assert (then.was, then.label, then.contradicts) == (None, "untidy", False)
    then, _ = supposed(shelf, reasoner, HOW_MANY, ("shows.1.form", "ball"))
    assert then.contradicts  # nothing lies on a ball
    then, said = supposed(shelf, reasoner, HOW_MANY)
    assert (then.label, said, then.begins, then.ends) == (None, [], (), ())


def test_what_is_so_anyway_is_no_change_and_all_else_is_kept(
    shelf: Domain, reasoner: Reasoner
) -> None:
    read = ask(shelf, reasoner, SEEN, HOW_MANY).read
    so = [("shows.1.colour", "red"), ("place.left.1", "0"), ("holds.on.2.1", "yes"), ("at", "1")]
    assert edits_of(read_supposition(so, read), read) == ()
    fields = [
        ("shows.1.colour", "blue"),
        ("shows.4.form", "ball"),
        ("place.left.3", "0"),
        ("holds.on.2.1", "no"),
        ("holds.on.2.1", "yes"),
        ("holds.on.3.1", "yes"),
        ("gone", "2"),
        ("gone", "3"),
        ("added", "1"),
    ]
    said = read_supposition(fields, read)
    kept = list(fields_of(said))
    assert set(kept) == set(fields) - {("holds.on.2.1", "no"), ("holds.on.2.1", "yes")}
    assert read_supposition(kept, read) == said
    assert not any(name.startswith("shows.1.") for name, _ in fields_of(said, but=0))


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("shows.9.colour", "red", "a thing is a number up to 3, got '9'"),
        ("shows.0.colour", "red", "things are counted from 1"),
        ("shows.1.hue", "red", "'hue' is no feature of things"),
        ("shows.1.colour", "reed", "'reed' is no value of 'colour'; did you mean 'red'"),
        ("place.on.1", "0", "'on' is no relation that can be said so"),
        ("place.left.1", "3", "place.left.1 is a number up to 2, got '3'"),
        ("holds.left.1.2", "yes", "'left' is no relation that can be said so"),
        ("holds.on.1.2", "maybe", "'holds.on.1.2' is 'yes' or 'no', got 'maybe'"),
        ("gone", "-1", "a thing is a number up to 3, got '-1'"),
        ("added", "3", "there would be 6 shapes, and the domain allows 5; take one away first"),
        ("added", "٣", "added is a number up to 5"),
        ("go", "x", "a thing is a number up to 3, got 'x'"),
    ],
)
def test_what_cannot_be_supposed_is_said(
    shelf: Domain, reasoner: Reasoner, field: str, value: str, complaint: str
) -> None:
    read = ask(shelf, reasoner, SEEN, HOW_MANY).read
    with pytest.raises(SeeWhyError) as refused:
        read_supposition([(field, value)], read)
    assert complaint in str(refused.value)
