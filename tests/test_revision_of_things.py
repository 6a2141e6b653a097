"""Rules about several things are doubted: exceptions, conditions, and rules from reasons."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import QuestionError, RevisionError
from seewhy.knowledge.justification import Basis, Node
from seewhy.revision.consequences import annotated_scenes
from seewhy.revision.edit import FileName, edited
from seewhy.revision.proposal import Cause, Doubted
from seewhy.revision.things.doubted_scene import axioms_behind, doubted_scene
from seewhy.revision.things.narrowed_rules import applies, thing_rule_revisions
from seewhy.revision.things.new_rule import new_thing_rule
from seewhy.revision.things.reasons import class_named, gives_reason, rule_of_reason
from things_builder import write_domain, write_shelf

PICTURE = "images/003.png"
"""A large blue ball lies on a large blue box; small balls, red and blue, lie beside it."""


@pytest.fixture(scope="module")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    return load_domain(write_domain(tmp_path_factory.mktemp("doubted") / "shelf"))


@pytest.fixture(scope="module")
def dataset(domain: Domain, tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    folder: Path = write_shelf(tmp_path_factory.mktemp("doubted") / "data", 48)
    return Dataset.load(folder, domain)


def doubted(
    domain: Domain, dataset: Dataset, *, wanted: str | None = None, picture: str = PICTURE
) -> Doubted:
    scenes = annotated_scenes(dataset, {})
    text = (domain.folder / "knowledge.al").read_text()
    texts: dict[FileName, str] = {"knowledge.al": text, "learned.al": ""}
    vector = scenes.vectors[scenes.pictures.index(picture)]
    return doubted_scene(domain, texts, vector, scenes, wanted=wanted)


def test_exceptions_are_offered_with_what_they_change(domain: Domain, dataset: Dataset) -> None:
    about = doubted(domain, dataset)
    assert [axiom.text for axiom in axioms_behind(about)] == [
        "the picture is untidy where a ball lies on something"
    ]
    first, second = thing_rule_revisions(about)
    assert first.cause is second.cause is Cause.EXCEPTION
    assert first.statement == (
        "untidy(P) if picture(P), form(X, ball), on(X, Y), not colour(Y, blue)."
    )
    assert first.sentence.endswith("lies on something, unless the other shape is blue")
    assert second.sentence.endswith("lies on something, unless the ball is large")
    assert first.decision.label is None
    assert first.consequences is not None
    assert (first.consequences.scenes, len(first.consequences.changed)) == (48, 5)
    written = edited(about.texts, first.edits)["knowledge.al"]
    assert first.statement in written
    assert f"%% {first.sentence}\n" in written
    undone = edited({"knowledge.al": written}, [edit.undone for edit in first.edits])
    assert undone["knowledge.al"] == about.texts["knowledge.al"]


def test_exceptions_are_those_by_which_it_is_of_the_class_that_is_wanted(
    domain: Domain, dataset: Dataset
) -> None:
    """A rule for the other class that had given way to the first one speaks then."""
    file = domain.folder / "knowledge.al"
    before = file.read_text()
    file.write_text(before + "%% the rest is tidy\ntidy(P) if picture(P), not untidy(P).\n")
    try:
        about = doubted(load_domain(domain.folder), dataset, wanted="tidy")
        found = thing_rule_revisions(about)
        assert {proposal.decision.label for proposal in found} == {"tidy"}
    finally:
        file.write_text(before)


def test_of_what_is_no_class_it_is_told_where_the_rule_applies(
    domain: Domain, dataset: Dataset
) -> None:
    """Without classes, too: "nothing lies on a ball"."""
    apart = replace(domain, classes={})
    one_ball = next(
        dataset.name_of(scene)
        for scene in dataset.scenes
        if [thing.values["form"] for thing in scene.things].count("ball") == 1
    )
    about = doubted(apart, dataset, picture=one_ball)
    box_on_ball = next(axiom for axiom in domain.knowledge.axioms if axiom.head.predicate == "on")
    reasons = Node("-on(thing1, thing2)", "", Basis.AXIOM, axiom=box_on_ball)
    found = thing_rule_revisions(about, reasons)
    assert {proposal.about for proposal in found} == {"nothing lies on a ball"}
    told = applies(about, found[0])
    assert told is not None
    assert told.scenes == 48
    assert 0 < told.after < told.before
    of_class = doubted(domain, dataset)
    assert applies(of_class, thing_rule_revisions(of_class)[0]) is None


@pytest.mark.parametrize(
    ("said", "statement"),
    [
        ("it is tidy because there is a red ball",
         "tidy(S) if picture(S), colour(X, red), form(X, ball)."),
        ("No, the picture is tidy because a small ball lies on a large box.",
         "tidy(S) if picture(S), on(X, Y), form(X, ball), size(X, small), form(Y, box), "
         "size(Y, large)."),
        ("it is untidy because there are two red balls",
         "untidy(S) if picture(S), #count { U : colour(U, red), form(U, ball) } >= 2."),
        ("it is untidy because there are exactly two balls",
         "untidy(S) if picture(S), #count { U : form(U, ball) } >= 2, "
         "#count { U : form(U, ball) } < 3."),
        ("it is untidy because there are fewer than two boxes",
         "untidy(S) if picture(S), #count { U : form(U, box) } < 2."),
        ("it is untidy because no ball is on a box",
         "untidy(S) if picture(S), #count { U, V : on(U, V), form(U, ball), form(V, box) } = 0."),
        ("it is untidy because every ball is red and there is a box",
         "untidy(S) if picture(S), #count { U : -colour(U, red), form(U, ball) } = 0, "
         "form(X, box)."),
        ("it is untidy because a ball and a box have the same colour",
         "untidy(S) if picture(S), form(X, ball), form(Y, box), colour(X, Colour1), "
         "colour(Y, Colour1), X != Y."),
        ("it is untidy because the light is off and there is a ball",
         "untidy(S) if picture(S), light(S, dark), form(X, ball)."),
        ("it is untidy because of a red ball",
         "untidy(S) if picture(S), colour(X, red), form(X, ball)."),
    ],
)  # fmt: skip
def test_a_reason_in_words_is_a_rule(
    domain: Domain, dataset: Dataset, said: str, statement: str
) -> None:
    assert gives_reason(said)
    proposal = new_thing_rule(doubted(domain, dataset), rule_of_reason(domain, said))
    assert proposal.statement == statement
    assert proposal.consequences is not None


@pytest.mark.parametrize(
    ("said", "complaint"),
    [
        ("it is broken because there is a ball", "names no class"),
        ("it is tidy because moo", "'moo' is not understood as a reason"),
        ("it is tidy because the leftmost ball is red", "is no condition that a rule can have"),
        ("it is tidy because there are more balls than boxes", "is no condition that a rule"),
        ("it is tidy because a red ball is blue", "is no condition that a rule can have"),
        ("it is tidy because a ball is on a box and a red ball is on a blue box",
         "a rule speaks of 3 things at most"),
    ],
)  # fmt: skip
def test_what_is_no_rule_is_said(domain: Domain, said: str, complaint: str) -> None:
    with pytest.raises(QuestionError, match=complaint):
        rule_of_reason(domain, said)


def test_rules_of_another_class_give_way(domain: Domain, dataset: Dataset) -> None:
    about = doubted(domain, dataset)
    reason = "it is tidy because a large ball lies on a large box"
    proposal = new_thing_rule(about, rule_of_reason(domain, reason))
    assert proposal.exceptions == (
        "the picture is untidy where a ball lies on something, unless it is tidy",
    )
    assert proposal.decision.label == "tidy"
    written = edited(about.texts, proposal.edits)["knowledge.al"]
    assert "untidy(P) if picture(P), form(X, ball), on(X, Y), not tidy(P).\n" in written


def test_a_rule_that_is_known_is_not_offered(domain: Domain, dataset: Dataset) -> None:
    with pytest.raises(RevisionError, match="the rule is known already: "):
        new_thing_rule(
            doubted(domain, dataset),
            rule_of_reason(domain, "it is untidy because a ball lies on something"),
        )


def test_which_class_a_remark_names(domain: Domain) -> None:
    assert class_named(domain, "no, it is tidy!") == "tidy"
    assert class_named(domain, "the picture is untidy") == "untidy"
    assert class_named(domain, "the ball is red") is None
    assert not gives_reason("is it tidy because there is a ball?")
