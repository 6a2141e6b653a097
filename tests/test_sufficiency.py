"""Reasons that suffice, beside brute force over small tables of annotated scenes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reference import experience_of
from seewhy_lab.experiments.sufficiency import ENOUGH, Sufficiency, answer_suffices

FEATURES = ("blocks", "lean", "displaced")
CLASSES = ("stable", "unstable")
Scenes = list[tuple[tuple[str, str, str], str]]

vectors = st.tuples(st.sampled_from("123"), st.sampled_from("ny"), st.sampled_from("ny"))
tables = st.lists(st.tuples(vectors, st.sampled_from(CLASSES)), min_size=1, max_size=30)


def sufficiency(scenes: Scenes, *, decided: str | None = None) -> Sufficiency:
    experience = experience_of([vector for vector, _ in scenes], [label for _, label in scenes])
    return Sufficiency(experience, FEATURES, decide=lambda _: decided)


def share(scenes: Scenes, values: frozenset[tuple[str, str]], label: str) -> float | None:
    labels = [
        annotated
        for vector, annotated in scenes
        if all(vector[FEATURES.index(feature)] == value for feature, value in values)
    ]
    return labels.count(label) / len(labels) if labels else None


def subsets(values: frozenset[tuple[str, str]]) -> Iterator[frozenset[tuple[str, str]]]:
    for kept in product((True, False), repeat=len(values)):
        yield frozenset(value for value, keep in zip(sorted(values), kept, strict=True) if keep)


@given(tables, vectors, st.sampled_from(CLASSES))
def test_what_suffices_is_what_counting_says(
    scenes: Scenes, vector: tuple[str, str, str], label: str
) -> None:
    judge = sufficiency(scenes)
    scene = judge.values(vector)
    most, least = share(scenes, scene, label), share(scenes, frozenset(), label)
    for reason in subsets(scene):
        said = share(scenes, reason, label)
        enough = (
            most is not None
            and said is not None
            and least is not None
            and most > least
            and said - least >= ENOUGH * (most - least)
        )
        assert judge.suffices(reason, scene, frozenset({label})) is enough


@given(tables, vectors)
def test_all_values_suffice_where_any_do_and_none_never_does(
    scenes: Scenes, vector: tuple[str, str, str]
) -> None:
    judge = sufficiency(scenes)
    scene = judge.values(vector)
    for label in CLASSES:
        some = any(judge.suffices(reason, scene, frozenset({label})) for reason in subsets(scene))
        assert judge.suffices(scene, scene, frozenset({label})) is some
        assert not judge.suffices(frozenset(), scene, frozenset({label}))


@given(tables, vectors, vectors, st.sampled_from(CLASSES))
def test_what_changes_lead_to_is_what_most_scenes_are(
    scenes: Scenes, vector: tuple[str, str, str], after: tuple[str, str, str], decided: str
) -> None:
    judge = sufficiency(scenes, decided=decided)
    changes = tuple(
        (feature, new)
        for feature, old, new in zip(FEATURES, vector, after, strict=True)
        if old != new
    )
    counts = Counter(label for other, label in scenes if other == after)
    for label in CLASSES:
        most = 2 * counts[label] > counts.total() if counts else label == decided
        assert judge.leads_to(vector, changes, label) is (bool(changes) and most)


# Answers -----------------------------------------------------------------------------------------

# Two blocks that do not lean are never displaced: two reasons for one class.
TABLE: Scenes = [
    (("2", "n", "n"), "stable"),
    (("3", "n", "n"), "stable"),
    (("2", "y", "y"), "unstable"),
    (("3", "n", "y"), "unstable"),
    (("3", "y", "y"), "unstable"),
    (("3", "y", "n"), "stable"),
    (("3", "y", "n"), "unstable"),
] * 10
SCENE = ("2", "n", "n")
SEEN = dict(zip(FEATURES, SCENE, strict=True))
WHY = Question(Asks.WHY_CLASS, "", (), label="stable")
WHY_NOT = Question(Asks.WHY_NOT_CLASS, "", (), label="unstable")
CHANGE = Question(Asks.CHANGE_TO_CLASS, "", (), label="unstable")
DIFFERENCE = Question(Asks.DIFFERENCE_TO_CLASS, "", (), label="unstable")
GOLD = AnswerType("reasons", ("blocks", "lean"))


def judged(
    kind: AnswerType,
    *,
    question: Question = WHY,
    gold: AnswerType = GOLD,
    vector: tuple[str, str, str] = SCENE,
    label: str = "stable",
    seen: dict[str, str | None] | None = None,
    strict: bool = False,
    decided: str | None = None,
) -> bool:
    return answer_suffices(
        kind,
        gold,
        question,
        vector,
        label,
        seen=seen or dict(zip(FEATURES, vector, strict=True)),
        strict=strict,
        sufficiency=sufficiency(TABLE, decided=decided),
    )


@pytest.mark.parametrize(
    ("mentions", "enough"),
    [
        (("blocks", "lean"), True),
        (("lean", "displaced"), True),
        (("blocks", "displaced"), True),
        (("lean",), False),
        (("blocks",), False),
        ((), False),
    ],
)
def test_any_reasons_that_suffice_are_right(mentions: tuple[str, ...], enough: bool) -> None:
    assert judged(AnswerType("reasons", mentions)) is enough
    against = AnswerType("against", mentions)
    assert judged(against, question=WHY_NOT, gold=replace_form(GOLD, "against")) is enough


def replace_form(kind: AnswerType, form: str) -> AnswerType:
    return AnswerType(form, kind.mentions, kind.changes)


def test_what_is_not_so_is_no_reason() -> None:
    kind = AnswerType("reasons", ("lean", "displaced"))
    assert judged(kind)
    assert not judged(kind, seen={**SEEN, "lean": "y"})
    assert not judged(kind, seen={**SEEN, "lean": None})
    assert judged(kind, seen={**SEEN, "blocks": "3"})
    # What is said of a class that the scene is not of has another form.
    assert not judged(replace_form(kind, "false_premise"))


def test_where_no_reason_can_suffice_that_of_the_annotator_is_asked_for() -> None:
    kind = AnswerType("reasons", ("lean", "displaced"))
    odd = ("3", "y", "n")
    for strict in (True, False):
        # Half of these scenes are stable, more than of all: then any reason is judged.
        assert judged(kind, vector=odd, strict=strict)
        # Of unstable ones there are fewer than among all.
        why = Question(Asks.WHY_CLASS, "", (), label="unstable")
        assert judged(kind, question=why, vector=odd, label="unstable", strict=strict) is strict
        unseen = ("1", "n", "n")
        assert judged(kind, vector=unseen, strict=strict) is strict


def test_why_not_one_of_many_classes_is_about_that_class() -> None:
    experience = experience_of(
        [("circle", "red"), ("circle", "blue"), ("triangle", "red"), ("triangle", "blue")] * 5,
        ["forbidden", "ordered", "danger", "works"] * 5,
    )
    judge = Sufficiency(experience, ("shape", "colour"), decide=lambda _: None)
    seen = {"shape": "circle", "colour": "red"}

    def enough(mentions: tuple[str, ...], *, label: str) -> bool:
        question = Question(Asks.WHY_NOT_CLASS, "", (), label=label)
        kind = AnswerType("against", mentions)
        return answer_suffices(
            kind, kind, question, ("circle", "red"), "forbidden", seen=seen, strict=False,
            sufficiency=judge,
        )  # fmt: skip

    assert enough(("shape",), label="danger")
    assert not enough(("colour",), label="danger")
    assert enough(("colour",), label="ordered")
    assert enough(("shape",), label="works")
    assert enough(("colour",), label="works")


@pytest.mark.parametrize(("question", "form"), [(CHANGE, "change"), (DIFFERENCE, "difference")])
def test_changes_have_to_lead_to_the_class(question: Question, form: str) -> None:
    def enough(*changes: tuple[tuple[str, str], ...], decided: str | None = None) -> bool:
        kind = AnswerType(form, (), changes)
        return judged(kind, question=question, gold=kind, decided=decided)

    both = (("lean", "y"), ("displaced", "y"))
    assert enough(both)
    assert enough(both, (("blocks", "3"), ("displaced", "y")))
    assert not enough(both, (("blocks", "3"),))
    assert not enough((("lean", "y"), ("blocks", "3")))  # as many stable as unstable ones
    assert not enough((("lean", "n"),))  # so already
    assert not enough()
    # There are no such scenes: the knowledge decides.
    assert not enough((("displaced", "y"),))
    assert enough((("displaced", "y"),), decided="unstable")


def test_other_answers_are_judged_by_what_the_annotator_says() -> None:
    none = AnswerType("no_change")
    for strict in (True, False):
        assert judged(none, question=CHANGE, gold=none, strict=strict) is strict
        bare = AnswerType("against")
        assert judged(bare, question=WHY_NOT, gold=bare, strict=strict) is strict
    change = AnswerType("change", changes=((("lean", "y"), ("displaced", "y")),))
    # A class that the scene is of already, and a question that asks for no change.
    stable = Question(Asks.CHANGE_TO_CLASS, "", (), label="stable")
    assert not judged(change, question=stable, gold=AnswerType("already"))
    assert not judged(change, question=WHY)
