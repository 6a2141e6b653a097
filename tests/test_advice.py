"""What figures say in words: whole texts for figures that are made up."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from seewhy.evaluation.advice import advice
from seewhy.evaluation.curve import CurvePoint, LearningCurve
from seewhy.evaluation.recognition import Recognition, recognition_of
from seewhy.evaluation.redeciding import Redecided
from seewhy.evaluation.result import Evaluation

COLOURS = ("red", "green", "blue")


def recognised(
    counts: dict[tuple[str, str | None], int],
    *,
    order: tuple[str, ...],
    probability: float | None = None,
) -> Recognition:
    """A recognition of so many pictures of each annotated and said value."""
    pairs = [pair for pair, count in counts.items() for _ in range(count)]
    share = sum(true == said for true, said in pairs) / len(pairs)
    probability = share if probability is None else probability
    return recognition_of([(true, said, probability) for true, said in pairs], order=order)


def good(count: int = 1000) -> Recognition:
    half = count // 2
    return recognised({("good", "good"): half, ("bad", "bad"): half}, order=("good", "bad"))


def evaluation(**changes: Any) -> Evaluation:
    """An evaluation of a thousand pictures about which there is nothing to say."""
    colours = recognised({(c, c): 300 for c in COLOURS}, order=COLOURS)
    plain = Evaluation(
        scenes=1000,
        without_class=0,
        groups=1000,
        has_splits=True,
        seen_in_training=0,
        class_recognition=good(),
        feature_recognition={"colour": colours},
        without=(),
        unknown=0.0,
        answer_accuracy=1.0,
        answer_accuracy_strict=1.0,
        explanation_accuracy=1.0,
        explanation_accuracy_strict=1.0,
        decided_by_knowledge=1.0,
        accuracy_by_method={"knowledge": 1.0},
        determined=1.0,
        redecided=Redecided(0, 0, {"colour": 0}, {"colour": 0}, 0),
        depended_on={"colour": True},
        asked_by_axioms={"colour": True},
        training_pictures={
            "class": {"good": 500, "bad": 500},
            "colour": {"red": 300, "green": 300, "blue": 300},
        },
        wrong=(),
        axioms=(),
    )
    return replace(plain, **changes)


def test_figures_that_say_nothing() -> None:
    assert advice(evaluation()) == ()


def test_pictures_trained_on_come_first() -> None:
    seen = evaluation(seen_in_training=7)
    assert advice(seen) == ("7 of 1000 pictures were trained on; results on them prove nothing.",)
    assert advice(replace(seen, has_splits=False)) == (
        "7 of 1000 pictures were trained on; results on them prove nothing: the table keeps none "
        "for evaluation; add a column split, with test in a quarter of the rows, and train again.",
    )
    assert advice(evaluation(has_splits=False)) == ()


def test_few_pictures_are_uncertain() -> None:
    few = evaluation(
        scenes=20,
        groups=5,
        class_recognition=recognised(
            {("good", "good"): 10, ("bad", "bad"): 9, ("bad", "good"): 1}, order=("good", "bad")
        ),
    )
    assert advice(few) == (
        "20 pictures are few to evaluate on: 95.0 % of the classes were right, which may as well "
        "be 76.4 % to 99.1 %.",
        "The 20 pictures are of 5 groups: figures are less certain than their intervals, which "
        "take pictures as independent.",
    )


def test_what_always_saying_the_same_gets_as_well() -> None:
    order = ("yes", "no")
    lean = {("no", "no"): 790, ("no", "yes"): 10, ("yes", "yes"): 20, ("yes", "no"): 180}
    found = evaluation(
        feature_recognition={
            "lean": recognised(lean, order=order),
            "bent": recognised({**lean, ("yes", "yes"): 0, ("yes", "no"): 200}, order=order),
            "dark": recognised({("no", "no"): 990, ("no", "yes"): 10}, order=order),
        },
        training_pictures={
            "class": {"good": 500, "bad": 500},
            **{key: {"yes": 99, "no": 800} for key in ("lean", "bent", "dark")},
        },
    )
    assert advice(found) == (
        "'lean': 81.0 % are right, 80.0 % would be by always saying no; so few pictures do not "
        "tell whether the model is better than that.",
        "'bent': 79.0 % are right, 80.0 % would be by always saying no; it is not so that the "
        "model is better than that.",
        "All 1000 pictures evaluated have 'dark' no: whether others are recognised is not known.",
        "'lean': 81.0 % are right of all pictures, but 54.4 % where every value counts alike: "
        "what is rare is recognised worse.",
        "'bent': 79.0 % are right of all pictures, but 49.4 % where every value counts alike: "
        "what is rare is recognised worse.",
        "None of 200 pictures of bent = yes was recognised; most were taken for no.",
        "No picture evaluated shows dark = yes: how well such are recognised is not known.",
    )


def test_which_feature_holds_the_class_back() -> None:
    both = {"colour": 3, "shape": 7}
    found = evaluation(redecided=Redecided(20, 4, both, {"colour": 0, "shape": 1}, 11))
    assert advice(found) == (
        "'shape' holds the class back most: 7 of 20 wrong classes would be right if only it were "
        "read rightly (and 1 right would be wrong); 3 for 'colour'.",
        "4 of 20 wrong classes are of pictures that the model says it does not know.",
        "5 of 20 wrong classes would stay wrong with every annotated feature read rightly. There "
        "the knowledge, the tree or the annotation is at fault, not what is seen; 'seewhy learn' "
        "looks for axioms that are missing.",
    )
    assert advice(replace(found, determined=0.995))[-1] == (
        "5 of 20 wrong classes would stay wrong with every annotated feature read rightly. There "
        "the features do not tell: pictures that are annotated alike have several classes, which "
        "one more feature or better annotation would have to tell apart."
    )
    assert advice(replace(found, determined=0.997))[-1].endswith(
        "'seewhy learn' looks for axioms that are missing, but 3 of 1000 no axiom tells: pictures "
        "that are annotated alike have several classes."
    )


def test_a_feature_that_spoils_as_much_as_it_mends_is_not_named() -> None:
    found = evaluation(redecided=Redecided(2, 0, {"colour": 2}, {"colour": 2}, 2))
    assert advice(found) == ()


def test_values_with_too_few_pictures_are_named() -> None:
    colours = recognised(
        {("red", "red"): 300, ("green", "green"): 297, ("green", "red"): 3, ("blue", "blue"): 297,
         ("blue", "red"): 103}, order=COLOURS,
    )  # fmt: skip
    found = evaluation(
        feature_recognition={"colour": colours},
        training_pictures={
            "class": {"good": 12, "bad": 1000},  # 12 are enough: it is recognised well
            "colour": {"red": 3, "green": 30, "blue": 12},
        },
    )
    assert advice(found) == (
        "12 pictures to train on show colour = blue, 74.2 % of 400 evaluated were recognised: "
        "label 30 more.",
    )
    found.training_pictures["colour"]["green"] = 39
    worse = recognised(
        {("red", "red"): 500, ("green", "red"): 99, ("green", "green"): 1, ("blue", "red"): 40,
         ("blue", "blue"): 360}, order=COLOURS,
    )  # fmt: skip
    asked = advice(replace(found, feature_recognition={"colour": worse}))[-2:]
    assert asked == (
        "39 pictures to train on show colour = green, 1.0 % of 100 evaluated were recognised: "
        "label 10 more.",
        "12 pictures to train on show colour = blue, 90.0 % of 400 evaluated were recognised: "
        "label 30 more.",
    )
    nowhere = recognised({("red", "red"): 500, ("green", "green"): 500}, order=COLOURS)
    found = replace(
        found,
        feature_recognition={"colour": nowhere},
        training_pictures={
            "class": {"good": 500, "bad": 500},
            "colour": {"red": 300, "green": 300, "blue": 0},
        },
    )
    assert advice(found) == (
        "No picture to train on shows colour = blue, no picture evaluated does: label 40.",
    )


def test_of_many_values_only_some_are_named() -> None:
    order = tuple(f"v{number}" for number in range(9))
    found = evaluation(
        feature_recognition={
            "kind": recognised(
                {(v, v): 50 for v in order} | {(v, "v0"): 20 for v in order[1:]}, order=order
            )
        },
        training_pictures={
            "class": {"good": 500, "bad": 500},
            "kind": {v: 10 + n for n, v in enumerate(order)},
        },
    )
    said = advice(found)
    assert said[0] == (
        "11 pictures to train on show kind = v1, 71.4 % of 70 evaluated were recognised: label 30 "
        "more."
    )
    assert said[-1] == (
        "3 more values have fewer than 40 pictures to train on and are not recognised well."
    )
    assert len(said) == 6


def test_a_class_left_out_on_purpose_is_not_asked_for() -> None:
    classes = recognised(
        {("good", "good"): 990, ("bad", "bad"): 600, ("bad", "good"): 50}, order=("good", "bad")
    )
    found = evaluation(
        class_recognition=classes,
        without=("bad",),
        training_pictures={"class": {"good": 500, "bad": 0}, "colour": dict.fromkeys(COLOURS, 300)},
    )
    assert advice(found) == ()
    assert advice(replace(found, without=()))[0].startswith(
        "No picture to train on shows the class bad, 92.3 % of 650 evaluated were recognised"
    )


@pytest.mark.parametrize(
    ("probability", "said"),
    [
        (0.99, "Surer than it is right, on average: the class (99.0 % said, 90.0 % right)."),
        (
            0.6,
            "Right more often than it is sure, on average: the class (60.0 % said, 90.0 % right).",
        ),
    ],
)
def test_what_is_too_sure(probability: float, said: str) -> None:
    classes = recognised(
        {("good", "good"): 450, ("good", "bad"): 50, ("bad", "bad"): 450, ("bad", "good"): 50},
        order=("good", "bad"),
        probability=probability,
    )
    assert advice(evaluation(class_recognition=classes)) == (said,)
    colours = recognised({(c, c): 300 for c in COLOURS}, order=COLOURS, probability=0.5)
    both = evaluation(class_recognition=classes, feature_recognition={"colour": colours})
    assert " ".join(advice(both)).count("'colour' (50.0 % said, 100.0 % right)") == 1


def test_a_feature_that_could_be_dropped() -> None:
    idle = evaluation(depended_on={"colour": False}, asked_by_axioms={"colour": False})
    assert advice(idle) == (
        "No class of these pictures depends on 'colour', and no axiom speaks of it: it could be "
        "dropped, unless somebody asks about it.",
    )
    assert advice(replace(idle, asked_by_axioms={"colour": True})) == ()


# The learning curve ---------------------------------------------------------------------------


def point(pictures: int, right: int, of: int = 100, *, colours: int = 90) -> CurvePoint:
    """A point with the first so many of the held-out pictures right."""
    classes = recognised(
        {("good", "good"): right, ("good", "bad"): of - right}, order=("good", "bad")
    )
    colour = recognised({("red", "red"): colours, ("red", "blue"): 100 - colours}, order=COLOURS)
    outcomes = (True,) * right + (False,) * (of - right)
    return CurvePoint(pictures, classes, {"colour": colour}, outcomes)


def test_a_curve_that_rises() -> None:
    curve = LearningCurve((point(100, 60), point(200, 80, colours=95)), 100)
    assert curve.sentences() == (
        "From 100 to 200 pictures to train on, 20 of 100 held-out classes became right and 0 "
        "wrong (60.0 % to 80.0 %): more labels help. Twice as many may bring about 90.0 %, if "
        "mistakes go on to become fewer as they did.",
        "Of the features, 'colour' gained most: 5.0 points.",
    )


def test_a_curve_promises_no_more_than_the_features_tell() -> None:
    curve = LearningCurve((point(100, 60), point(200, 80)), 100, determined=0.85)
    assert "Twice as many may bring about 85.0 %" in curve.sentences()[0]


def test_a_curve_that_is_flat() -> None:
    curve = LearningCurve(
        (point(1000, 93), point(2000, 94)), 100, skipped=((250, "scenes.csv: no two classes"),)
    )
    assert curve.sentences() == (
        "No model could be trained on 250 pictures: scenes.csv: no two classes.",
        "From 1,000 to 2,000 pictures to train on, 1 of 100 held-out classes became right and 0 "
        "wrong (93.0 % to 94.0 %): no more than chance. More labels of the same kind may help "
        "little; 100 held-out pictures do not tell smaller gains from none.",
    )


def test_other_curves() -> None:
    assert LearningCurve((point(9, 50),), 100).sentences() == (
        "One point is no curve: there are too few pictures to train on parts of them.",
    )
    assert LearningCurve((point(9, 100), point(18, 100)), 100).sentences() == (
        "From 9 to 18 pictures to train on, 0 of 100 held-out classes became right and 0 wrong "
        "(100.0 % to 100.0 %): nothing is left to gain on these pictures.",
    )
    assert LearningCurve((point(9, 90), point(18, 50)), 100).sentences()[0] == (
        "From 9 to 18 pictures to train on, 0 of 100 held-out classes became right and 40 wrong "
        "(90.0 % to 50.0 %): more labels did harm; look at the annotation of what was added."
    )


def test_a_curve_for_a_program() -> None:
    record = LearningCurve((point(100, 60), point(200, 80)), 100).to_dict()
    assert [(row["pictures"], row["classification_accuracy"]) for row in record["points"]] == [
        (100, 0.6),
        (200, 0.8),
    ]
    assert record["points"][0]["feature_accuracy"] == {"colour": 0.9}
    assert record["held_out"] == 100
    assert record["advice"][0].startswith("From 100 to 200 pictures")
