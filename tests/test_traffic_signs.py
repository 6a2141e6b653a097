"""The traffic signs: what the knowledge decides of the table, and what can be asked."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from typing import Any

import clingo
import pytest

from seewhy.dialogue.answer import word_answer
from seewhy.dialogue.question import Questions
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.templates import expanded
from seewhy.dialogue.vocabulary import Vocabulary
from seewhy.domain.domain import load_domain
from seewhy.errors import QuestionError
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.program import UNKNOWN, program_text
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import why

DOMAIN = load_domain("traffic_signs")
FEATURES = tuple(DOMAIN.features)
TABLE = {
    row["class"]: row
    for row in csv.DictReader((DOMAIN.folder / "classes.csv").open(encoding="utf-8"))
}
ROWS: dict[str, FeatureVector] = {
    name: tuple(row[feature] for feature in FEATURES) for name, row in TABLE.items()
}
LEFT_OPEN = {
    "children_ahead",
    "level_crossing",
    "priority_at_junction",
    "no_overtaking",
    "roundabout",
    "separate_paths",
    "parking_on_pavement",
    "dead_end",
}
DECIDED = [name for name in ROWS if name not in LEFT_OPEN]
AXIOMS: dict[str, Axiom] = {
    axiom.head.predicate: axiom for axiom in DOMAIN.knowledge.axioms if axiom.head.predicate in ROWS
}
REASONER = Reasoner(DOMAIN.knowledge, DOMAIN.schema)
QUESTIONS = Questions(DOMAIN)
REASONED = ReasonedAnswers(DOMAIN, REASONER)
PAGE = Path(__file__).parents[1] / "docs" / "traffic_signs.md"


def conditions(name: str) -> dict[str, str]:
    """The features that a class's axiom asks for, with their values."""
    found = {}
    for condition in AXIOMS[name].body:
        assert condition.literal is not None
        assert condition.literal.positive
        assert not condition.absent
        found[condition.literal.predicate] = condition.literal.arguments[1]
    return found


def of_the_same_look(name: str, features: tuple[str, ...]) -> list[str]:
    """The classes that share these features' values with a class."""
    return [
        other
        for other, row in TABLE.items()
        if all(row[feature] == TABLE[name][feature] for feature in features)
    ]


def fewest_features(name: str) -> int:
    """How few features tell a class from the others, by trying all sets of features."""
    return next(
        size
        for size in range(1, len(FEATURES) + 1)
        if any(of_the_same_look(name, chosen) == [name] for chosen in combinations(FEATURES, size))
    )


def classified_vectors() -> dict[FeatureVector, list[str]]:
    """Every complete feature vector that is believed to be of exactly one class, by clingo.

    The knowledge has no defaults and no choices of its own: one answer set for every vector.
    """
    literals = "; ".join(f"holds({scene_class.literal})" for scene_class in DOMAIN.classes.values())
    program = [
        program_text(DOMAIN.knowledge, DOMAIN.schema),
        ":- not strict.",
        f":- observed(_, {UNKNOWN}).",
        f":- not 1 {{ {literals} }} 1.",
        "#show observed/2.",
        *(
            f"#show {name} : holds({scene_class.literal})."
            for name, scene_class in DOMAIN.classes.items()
        ),
    ]
    control = clingo.Control(["0", "--warn=none"])
    control.add("base", [], "\n".join(program))
    control.ground([("base", [])])
    found: dict[FeatureVector, list[str]] = {}

    def on_model(model: clingo.Model) -> None:
        shown = model.symbols(shown=True)
        seen = {str(s.arguments[0]): str(s.arguments[1]) for s in shown if s.name == "observed"}
        vector = tuple(seen[feature] for feature in FEATURES)
        found.setdefault(vector, []).extend(str(s) for s in shown if s.name != "observed")

    control.solve(on_model=on_model)
    return found


# The folder ---------------------------------------------------------------------------------


def test_the_domain_has_the_values_and_classes_of_the_table() -> None:
    assert list(DOMAIN.classes) == list(TABLE)
    for feature, declared in DOMAIN.features.items():
        assert set(declared.values) == {row[feature] for row in TABLE.values()}
    assert len(set(ROWS.values())) == 62


def test_pictures_of_signs_are_read_consistently_and_never_mirrored() -> None:
    assert DOMAIN.reading == "consistent"
    assert not DOMAIN.pictures.flip


# The knowledge ------------------------------------------------------------------------------


def test_every_class_but_eight_has_one_axiom_with_a_sentence() -> None:
    heads = Counter(a.head.predicate for a in DOMAIN.knowledge.axioms)
    assert {name for name in ROWS if heads[name] != 1} == LEFT_OPEN
    assert all(heads[name] == 0 for name in LEFT_OPEN)
    for axiom in DOMAIN.knowledge.axioms:
        if axiom.body:
            assert axiom.text != str(axiom).rstrip("."), str(axiom)


@pytest.mark.parametrize("name", DECIDED)
def test_an_axiom_rests_on_the_fewest_features_that_tell_its_class(name: str) -> None:
    asked = conditions(name)
    assert all(TABLE[name][feature] == value for feature, value in asked.items())
    assert of_the_same_look(name, tuple(asked)) == [name]
    assert len(asked) == fewest_features(name)


def test_a_class_that_is_left_open_has_a_value_of_its_own() -> None:
    """Where all its values occur in other signs, a class is known before it is ever seen."""
    for name in LEFT_OPEN:
        telling = [f for f in FEATURES if of_the_same_look(name, (f,)) == [name]]
        assert telling, name


def test_the_vectors_that_are_classified_are_the_rows_of_the_table() -> None:
    assert classified_vectors() == {ROWS[name]: [name] for name in DECIDED}


def test_no_sign_with_one_feature_changed_is_taken_for_a_sign() -> None:
    names = {row: name for name, row in ROWS.items()}
    near = {
        (*row[:place], value, *row[place + 1 :])
        for row in ROWS.values()
        for place, feature in enumerate(DOMAIN.features.values())
        for value in feature.values
    }
    vectors = sorted(near)
    for vector, decision in zip(vectors, REASONER.decide_all(vectors), strict=True):
        name = names.get(vector)
        assert decision.label == (None if name in LEFT_OPEN else name), vector


def test_signs_that_are_left_open_contradict_nothing() -> None:
    decisions = REASONER.decide_all([ROWS[name] for name in LEFT_OPEN])
    assert {decision.verdict for decision in decisions} == {Verdict.SILENT}


@pytest.mark.parametrize("name", DECIDED)
def test_what_an_axiom_asks_for_is_enough_and_is_the_whole_reason(name: str) -> None:
    assert REASONER.decide(DOMAIN.vector(conditions(name))).label == name
    node = why(REASONER, ROWS[name], DOMAIN.classes[name].literal)
    assert node is not None
    assert set(node.features()) == set(conditions(name))


@pytest.mark.parametrize("start", ["no_parking", "cycle_crossing", "roundabout", "parking_arrow"])
def test_the_smallest_change_gives_the_whole_look_of_a_sign(start: str) -> None:
    changes = ChangeFinder(REASONER)
    for name, row in ROWS.items():
        found = changes.smallest(ROWS[start], name)
        assert [change.vector for change in found] == ([row] if name in DECIDED else [])


def test_a_sign_that_breaks_a_convention_contradicts_the_knowledge() -> None:
    for changed in ({"main_color": "blue"}, {"cross": "red"}, {"secondary_symbol": "car"}):
        vector = DOMAIN.vector({**DOMAIN.named(ROWS["cattle_ahead"]), **changed})
        assert REASONER.decide(vector).verdict is Verdict.CONTRADICTION


# Answers ------------------------------------------------------------------------------------


def answered(text: str, name: str) -> str:
    question = QUESTIONS.understand(text)
    answer = REASONED.answer(question, ROWS[name], name)
    return word_answer(DOMAIN, question, answer.kind, vector=ROWS[name], label=name)


def test_every_class_has_one_message_and_one_response() -> None:
    for predicate in ("message", "response"):
        told = [
            (axiom.head.arguments[1], axiom.body[0].literal.predicate)
            for axiom in DOMAIN.knowledge.axioms
            if axiom.head.predicate == predicate and axiom.body[0].literal is not None
        ]
        assert sorted(name for _, name in told) == sorted(ROWS)
        assert {value for value, _ in told} == set(DOMAIN.beliefs[predicate].words)
    messages = {answered("what does it mean?", name) for name in ROWS}
    assert len(messages) == 62


ANSWERS = [
    ("what sign is this?", "The sign is a no parking sign."),
    ("what is the sign's message?", "The sign tells the driver: parking is forbidden."),
    ("how should the driver respond to this sign?", "The driver must not park here."),
    ("is this a stop sign?", "No, the sign is a no parking sign."),
    ("why is it a no parking sign?", "The sign is mainly blue, and it shows no main symbol."),
    ("why is it not a stop sign?", "The sign is round."),
    (
        "how does it differ from a stop sign?",
        "A stop sign is octagonal, whereas the sign is round.",
    ),
    (
        "what would it have to look like to be a stop sign?",
        "For the sign to be a stop sign, make it octagonal, paint it red, give it a white border, "
        "show the word stop and take the bar away.",
    ),
    ("what shape is it?", "The sign is round."),
    ("what is the second symbol?", "The sign shows no second symbol."),
    ("is it crossed out?", "The sign is crossed out in red."),
    ("is it red?", "No, the sign is mainly blue."),
]


@pytest.mark.parametrize(("text", "said"), ANSWERS)
def test_a_no_parking_sign_is_spoken_of_in_plain_english(text: str, said: str) -> None:
    assert answered(text, "no_parking") == said


# Questions ----------------------------------------------------------------------------------

ABOUT_THE_SIGN = {
    ("class", None, None, None): [
        "what sign is this?",
        "Which traffic sign do you see?",
        "what kind of road sign is that",
        "What's this?",
        "please tell me what sign it is",
        "is it a stop sign or a give way sign?",
    ],
    ("belief_value", None, "message", None): [
        "what is the sign's message?",
        "what is its message?",
        "what's the traffic sign's meaning?",
        "what does this sign mean?",
        "What's the meaning of this traffic sign",
        "what does it tell the driver?",
        "what does it tell me",
        "waht does the sing mean",
    ],
    ("belief_value", None, "response", None): [
        "how should the driver respond to this sign?",
        "How should a motorist react?",
        "what should the driver do?",
        "what do I have to do here?",
        "what am I supposed to do",
        "what should I do now?",
        "how should the driver repsond?",
    ],
    ("feature_value", None, "shape", None): [
        "what shape is it?",
        "what is the shape of this sign",
        "which shape does it have",
        "what is the sign's shape?",
        "what shape has it?",
    ],
    ("feature_value", None, "main_color", None): [
        "what colour is it?",
        "What color is the sign?",
        "what's its main colour",
    ],
    ("feature_value", None, "border_color", None): [
        "what colour is the border?",
        "which color does the edge have",
        "which border is the sign showing?",
        "what border does it have?",
    ],
    ("feature_value", None, "primary_symbol", None): [
        "what symbol is it showing?",
        "what symbol has it got?",
        "which symbol is on it?",
        "what does it show?",
        "what icon does the sign show",
    ],
    ("feature_value", None, "secondary_symbol", None): [
        "what is the second symbol?",
        "is there a second symbol",
        "does it have a second symbol?",
    ],
    ("feature_value", None, "background_image", None): [
        "what is in the background?",
        "what background does it have?",
    ],
    ("feature_value", None, "cross", None): [
        "is it crossed out?",
        "is the sign struck through",
        "is there a bar across it",
    ],
    ("feature_is", None, "cross", "red"): ["is it crossed out in red?"],
    ("feature_is", None, "cross", "none"): ["is it not crossed out?"],
    ("feature_is", None, "main_color", "red"): ["is it red?", "is the sign mainly red"],
    ("feature_is", None, "shape", "triangle"): ["is it triangular?", "is this a triangle"],
    ("feature_is", None, "shape", "octagon"): ["is it an octagon?", "is the sign octagonal"],
    ("feature_is", None, "border_color", "blue"): ["is the border blue?", "has it a blue rim?"],
    ("feature_is", None, "background_image", "square"): ["is there a square in the background?"],
    ("feature_is", None, "primary_symbol", "cow"): ["does it show a cow?", "is there a cow on it"],
    ("feature_is", None, "primary_symbol", "cyclist"): ["does it show a bycicle?"],
    ("feature_is", None, "secondary_symbol", "car"): ["is the second symbol a car?"],
    ("explain", None, None, None): [
        "please explain this answer",
        "explain",
        "why?",
        "how do you know?",
    ],
}

ABOUT_A_CLASS = {
    "is_class": ["is this {}?", "IS IT {}", "does it mean {}?", "could this be {}"],
    "why_class": [
        "why is it {}?",
        "why do you think this is {}?",
        "what makes you think that it's {}",
        "how do you know it is {}",
    ],
    "why_not_class": ["why is it not {}?", "why isn't this {}?", "why not {}?"],
    "difference_to_class": [
        "how does it differ from {}?",
        "how is this different from {}",
        "what is the difference between this and {}?",
    ],
    "change_to_class": [
        "what would it have to look like to be {}?",
        "what would make it {}?",
        "what would need to change to make it {}?",
    ],
}


@pytest.mark.parametrize(
    ("text", "query"), [(text, q) for q, texts in ABOUT_THE_SIGN.items() for text in texts]
)
def test_a_question_about_the_sign_is_understood(text: str, query: tuple[Any, ...]) -> None:
    assert QUESTIONS.understand(text).query == query


def names_of(name: str) -> Iterator[str]:
    """What a class is called: as it is said, by its meaning, by its code."""
    yield DOMAIN.classes[name].say
    yield TABLE[name]["meaning"]
    yield f"a {TABLE[name]['code']} sign"


@pytest.mark.parametrize("asks", ABOUT_A_CLASS)
def test_a_question_about_a_class_is_understood_for_every_class(asks: str) -> None:
    for name in ROWS:
        for phrase in names_of(name):
            for pattern in ABOUT_A_CLASS[asks]:
                text = pattern.format(phrase)
                assert QUESTIONS.understand(text).query == (asks, name, None, None), text


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("is it a yield sign?", "give_way"),
        ("is it a stopp sign", "stop_sign"),
        ("is this a roundabuot?", "roundabout"),
        ("is this the end of a priority road?", "end_of_priority_road"),
        ("are these roadworks?", "road_works"),
        ("is the road slippery?", "slippery_road"),
        ("is this road slippery?", "slippery_road"),
        ("is it true that the road is uneven?", "uneven_road"),
        ("is it a no trucks sign", "no_lorries"),
        ("is it a bike path?", "cycle_path"),
        ("is this a zebra crossing?", "pedestrian_crossing"),
        ("is it B5?", "stop_sign"),
    ],
)
def test_a_class_has_several_names(text: str, name: str) -> None:
    assert QUESTIONS.understand(text).query == ("is_class", name, None, None)


@pytest.mark.parametrize(
    "text",
    [
        "where am I?",
        "what is the weather like?",
        "is it raining",
        "who are you",
        "banana",
        "is this a cat?",
        "how old is the driver",
        "how much does it cost?",
        "what is the capital of Belgium?",
        "asdf qwer",
        "?!",
    ],
)
def test_what_is_no_question_about_a_sign_is_refused(text: str) -> None:
    with pytest.raises(QuestionError):
        QUESTIONS.understand(text)


def test_every_wording_means_what_its_template_says() -> None:
    for question in QUESTIONS.all:
        assert QUESTIONS.understand(f"{question.text}?").query == question.query


def test_no_wording_is_hidden_behind_that_of_another_question() -> None:
    asked: dict[tuple[str, ...], tuple[str | None, ...]] = {}
    for question in expanded(DOMAIN, Vocabulary(DOMAIN).for_templates):
        assert asked.setdefault(question.words, question.query) == question.query, question.text


# The page -----------------------------------------------------------------------------------


def page_rows() -> Iterator[str]:
    """The rows of the page's table, from the knowledge."""
    for name, row in TABLE.items():
        told = (
            ", ".join(f"{feature} = {value}" for feature, value in conditions(name).items())
            if name in AXIOMS
            else "left open"
        )
        yield f"| {row['code']} | {row['meaning']} | {told} |"


def test_the_page_has_the_axioms_of_the_knowledge() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert [line for line in page.splitlines() if re.match(r"\| [A-F]\d", line)] == [*page_rows()]


def test_the_page_counts_the_axioms_rightly() -> None:
    page = " ".join(PAGE.read_text(encoding="utf-8").split())
    heads = [axiom.head.predicate for axiom in DOMAIN.knowledge.axioms]
    facts = sum(not axiom.body for axiom in DOMAIN.knowledge.axioms)
    classifying = sum(head in ROWS for head in heads)
    telling = sum(head in DOMAIN.beliefs for head in heads)
    conventions = len(heads) - facts - classifying - telling
    sizes = Counter(len(conditions(name)) for name in DECIDED)
    assert f"| {classifying} | classify" in page
    assert f"| {conventions} | are conventions" in page
    assert f"| {facts} | are facts" in page
    assert f"| {telling} | say" in page
    more = len(DECIDED) - sizes[1] - sizes[2]
    assert f"{sizes[1]} rest on one feature, {sizes[2]} on two, {more} on three or more" in page
