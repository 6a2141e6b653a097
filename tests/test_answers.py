"""Answers in words: golden texts for scenes whose features are given, without networks."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conftest import QUESTIONS, seen, write_domain
from seewhy.agent.agent import Agent
from seewhy.dialogue.answer import AnswerType, word_answer
from seewhy.dialogue.learned import answer_form
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import ReferenceAnswers, experience_of, relevant_features
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.wording import (
    draw_together,
    join_words,
    say_features,
    say_literal,
    say_one_of,
    say_values,
)
from seewhy.errors import DomainError
from seewhy.knowledge.axiom import Literal

UNDECIDED = (
    "I cannot tell whether the structure is {}: the knowledge does not decide, and there was "
    "nothing to learn it from."
)
WIDE = "it has a wide base, it is standing straight, and no block is displaced."
NARROW = "it has five blocks and a narrow base, and it leans to one side."

GOLDEN = {
    ("3", "wide", "no", "yes"): {
        "is it stable?": "No, the structure is unstable.",
        "is it unstable?": "Yes, the structure is unstable.",
        "is it stable or unstable?": "The structure is unstable.",
        "why is it stable?": "The structure is not stable: it is unstable, since a block is "
        "displaced.",
        "why is it unstable?": "A block is displaced.",
        "why is it not stable?": "A block is displaced.",
        "why is it not unstable?": "The structure is unstable, since a block is displaced.",
        "what would need to be changed to make it stable?": "To make the structure stable, put "
        "the displaced block back in place.",
        "what would make it unstable?": "The structure is unstable already.",
        "how many blocks are there?": "The structure has three blocks.",
        "does it have three blocks?": "Yes, the structure has three blocks.",
        "is the base narrow?": "No, the structure has a wide base.",
        "does it lean?": "No, the structure is standing straight.",
        "is it straight?": "Yes, the structure is standing straight.",
        "is a block displaced?": "Yes, a block is displaced.",
        "please explain this answer": "I see that a block is displaced (with a probability of "
        '0.90). The structure is unstable, because "a block that is not balanced on the one '
        'below it falls".',
    },
    ("5", "narrow", "yes", "no"): {
        "is it stable?": "No, the structure is unstable.",
        "why is it stable?": f"The structure is not stable: it is unstable, since {NARROW}",
        "why is it unstable?": f"The structure {NARROW[3:]}",
        "why is it not stable?": f"The structure {NARROW[3:]}",
        "why is it not unstable?": f"The structure is unstable, since {NARROW}",
        "what would need to be changed to make it stable?": "To make the structure stable, give "
        "it a wide base and straighten it.",
        "does it have three blocks?": "No, the structure has five blocks.",
        "is a block displaced?": "No, no block is displaced.",
        "please explain this answer": "I see that the structure has five blocks and a narrow "
        "base, and it leans to one side (each with a probability of at least 0.90). The "
        'structure is unstable, because "a leaning structure of more than three blocks on a '
        'narrow base topples".',
    },
    ("5", "wide", "no", "no"): {
        "is it stable?": "Yes, the structure is stable.",
        "is it unstable?": "No, the structure is stable.",
        "why is it stable?": f"The structure {WIDE[3:]}",
        "why is it unstable?": f"The structure is not unstable: it is stable, since {WIDE}",
        "why is it not stable?": f"The structure is stable, since {WIDE}",
        "why is it not unstable?": f"The structure {WIDE[3:]}",
        "what would make it stable?": "The structure is stable already.",
        "what would make it unstable?": "To make the structure unstable, displace a block.",
    },
    ("5", "narrow", "no", "no"): {
        "is it stable?": UNDECIDED.format("stable"),
        "is it unstable?": UNDECIDED.format("unstable"),
        "is it stable or unstable?": UNDECIDED.format("stable or unstable"),
        "why is it not stable?": UNDECIDED.format("stable"),
        "what would make it stable?": UNDECIDED.format("stable"),
        "how many blocks are there?": "The structure has five blocks.",
        "does it lean?": "No, the structure is standing straight.",
        "please explain this answer": "I see that the structure has five blocks and a narrow "
        "base, it is standing straight, and no block is displaced (each with a probability of at "
        "least 0.90). The knowledge does not decide: no axiom concludes a class. There were no "
        "such scenes to learn from either.",
    },
    ("2", "wide", "no", "yes"): {
        "is it stable?": (
            "I cannot tell what the structure is: the knowledge contradicts itself about it."
        ),
        "please explain this answer": "I see that the structure has two blocks, it is standing "
        "straight, and a block is displaced (each with a probability of at least 0.90). The "
        'knowledge contradicts itself here: "two blocks that do not lean stay where they are" '
        'and "a block that is not balanced on the one below it falls" cannot both hold. There '
        "were no such scenes to learn from either.",
    },
}


@pytest.mark.parametrize(
    ("vector", "question", "text"),
    [(vector, *pair) for vector, answers in GOLDEN.items() for pair in answers.items()],
)
def test_answers_about_structures(
    reasoning: Agent, vector: tuple[str, ...], question: str, text: str
) -> None:
    reply = reasoning.answer(seen(reasoning, *vector), reasoning.questions.understand(question))
    assert reply.text == text


def test_the_form_of_text_of_the_specification(structures: Domain) -> None:
    vector = ("5", "narrow", "no", "no")
    question = _ask(Agent(structures), vector, "why is it stable?").question
    kind = AnswerType("reasons", tuple(structures.features))
    assert word_answer(structures, question, kind, vector=vector, label="stable") == (
        "The structure has five blocks and a narrow base, it is standing straight, and no block "
        "is displaced."
    )


def _ask(agent: Agent, vector: tuple[str | None, ...], question: str) -> Reply:
    return agent.answer(seen(agent, *vector), agent.questions.understand(question))


def test_the_justification_of_an_answer_names_axiom_file_and_line(reasoning: Agent) -> None:
    reply = _ask(reasoning, ("3", "wide", "no", "yes"), "why is it unstable?")
    assert reply.justification.to_text() == (
        'the structure is unstable: "a block that is not balanced on the one below it falls" '
        "(knowledge.al:11)\n└─ a block is displaced (p = 0.90)"
    )


def test_the_values_of_a_proposed_change_have_no_probability(reasoning: Agent) -> None:
    reply = _ask(reasoning, ("5", "narrow", "yes", "no"), "what would make it stable?")
    after = reply.justification.children[-1]
    assert after.to_text() == (
        'with this change, the structure is stable: "a structure on a wide base does not fall '
        'when it stands straight and every block is balanced" (knowledge.al:23)\n'
        "├─ the structure has a wide base\n"
        "├─ the structure is standing straight\n"
        "└─ no block is displaced (p = 0.90)"
    )
    assert reply.kind == AnswerType("change", changes=((("base", "wide"), ("lean", "no")),))


def test_why_the_knowledge_does_not_decide(reasoning: Agent) -> None:
    reply = _ask(reasoning, ("5", "narrow", "no", "no"), "is it stable?")
    node = reply.justification
    assert (reply.method, reply.label, reply.kind.form) == ("none", None, "undecided")
    assert node.text == "the knowledge does not decide: no axiom concludes a class"
    assert [child.text for child in node.children] == [
        "it does not follow that the structure is stable",
        "it does not follow that the structure is unstable",
    ]


def test_an_explanation_is_of_the_answer_before(reasoning: Agent) -> None:
    scene = seen(reasoning, "5", "narrow", "yes", "no")
    explain = reasoning.questions.understand("please explain this answer")
    before = reasoning.answer(scene, reasoning.questions.understand("does it lean?"))
    reply = reasoning.answer(scene, explain, previous=before)
    assert reply.text == (
        "You asked: does the structure lean? I see that the structure leans to one side (with a "
        "probability of 0.90)."
    )
    assert reply.justification == before.justification
    assert reply.kind.form == "explain"


def test_two_classes_at_once_are_said_to_be_two(tmp_path: Path) -> None:
    knowledge = (
        "#sort tile.\n#sort hue = {red, green, blue}.\n#static colour(tile, hue).\n"
        "#static round(tile).\n#static good(tile).\n#static ugly(tile).\n"
        "%% red is good\ngood(T) if colour(T, red).\n%% red is ugly\nugly(T) if colour(T, red).\n"
    )
    folder = write_domain(tmp_path / "tiles", knowledge=knowledge)
    text = (folder / "domain.toml").read_text().replace("-good(T)", "ugly(T)")
    (folder / "domain.toml").write_text(text)
    agent = Agent(load_domain(folder))
    reply = _ask(agent, ("red", "yes"), "is it good?")
    assert reply.classification.verdict == "several classes"
    assert (
        reply.justification.text
        == "the knowledge does not decide: it concludes more than one class"
    )
    assert [child.to_text() for child in reply.justification.children] == [
        'the tile is good: "red is good" (knowledge.al:8)\n└─ the tile is red (p = 0.90)',
        'the tile is bad: "red is ugly" (knowledge.al:10)\n└─ the tile is red (p = 0.90)',
    ]


# Forms of answer ------------------------------------------------------------------------------

NAMES = st.from_regex(r"[a-z][a-z0-9_]{0,8}", fullmatch=True)
VALUES = st.from_regex(r"-?[a-z0-9_]{1,6}", fullmatch=True)
CHANGES = st.lists(st.tuples(NAMES, VALUES), min_size=1, max_size=3).map(tuple)


@given(
    st.builds(
        AnswerType,
        NAMES,
        st.lists(NAMES, max_size=4).map(tuple),
        st.lists(CHANGES, max_size=3).map(tuple),
    )
)
def test_an_identifier_names_one_answer_type(kind: AnswerType) -> None:
    assert AnswerType.parse(kind.identifier) == kind


def test_reasoned_answers_have_the_form_that_learned_ones_have(reasoning: Agent) -> None:
    """Reasoning and the network answer in the same forms, for every question and scene."""
    for vector in (("3", "wide", "no", "yes"), ("5", "wide", "no", "no")):
        label = reasoning.decide(dict(zip(reasoning.domain.features, vector, strict=True)))
        assert label is not None
        for question in reasoning.questions.one_of_each():
            if question.asks is Asks.EXPLAIN:
                continue
            kind = reasoning.reasoned.answer(question, vector, label).kind
            expected = answer_form(reasoning.domain, question, vector, label)
            assert kind.form in (expected, "no_change"), question.text


def test_an_explanation_is_no_question_about_a_scene(reasoning: Agent) -> None:
    explain = reasoning.questions.understand("explain")
    with pytest.raises(ValueError, match="'explain' is not a question about the scene"):
        reasoning.reasoned.answer(explain, ("1", "wide", "no", "no"), "stable")
    with pytest.raises(ValueError, match="'explain' is not a question about the scene"):
        answer_form(reasoning.domain, explain, ("1", "wide", "no", "no"), "stable")


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        (AnswerType("reasons"), "The structure is stable, and no single feature accounts for it."),
        (AnswerType("false_premise"), "The structure is not unstable: it is stable."),
        (AnswerType("denied_not"), "The structure is unstable."),
        (AnswerType("against"), "Nothing that is known concludes that the structure is unstable."),
        (AnswerType("no_change"), "Nothing that is known would make the structure unstable."),
        (
            AnswerType("change", changes=((("lean", "yes"),), (("base", "narrow"),))),
            "To make the structure unstable, let it lean, or give it a narrow base.",
        ),
    ],
)
def test_forms_without_reasons(structures: Domain, kind: AnswerType, text: str) -> None:
    question = Agent(structures).questions.understand("why is it unstable?")
    said = word_answer(structures, question, kind, vector=("1", None, "no", None), label="stable")
    assert said == text


@pytest.mark.parametrize(
    ("answers", "message"),
    [
        ('yess = "yes"', "2: 'yess' is no form of answer; did you mean 'yes'?"),
        (
            'yes = "yes, {reason}"',
            "2: the answer 'yes' has '{reason}', which is no slot; {SLOTS}",
        ),
        (
            'yes = "yes, {it.name}"',
            "2: the answer 'yes' has '{it.name}', which is no slot; {SLOTS}",
        ),
        (
            'yes = "yes, {it:>1000000000}"',
            "2: the answer 'yes' has '{it:>1000000000}', which is no slot; {SLOTS}",
        ),
        (
            'yes = "yes, {it[0]}, {0}, {}, {it!r} {{it}}"',
            "2: the answer 'yes' has '{it[0]}', which is no slot; {SLOTS}",
        ),
        (
            'yes = "yes, {"',
            "2: the answer 'yes' has '{', which is no slot; {SLOTS}",
        ),
    ],
)
def test_a_wrong_answer_template_is_found_before_training(
    tmp_path: Path, answers: str, message: str
) -> None:
    folder = write_domain(tmp_path / "tiles", questions=f"[answers]\n{answers}\n{QUESTIONS}")
    text = (folder / "questions.toml").read_text().replace('fillers = ["please"]\n', "")
    (folder / "questions.toml").write_text(text)
    with pytest.raises(DomainError) as problem:
        Agent(load_domain(folder))
    there_are = (
        "there are {it}, {reasons}, {changes}, {asked}, {class}, {explanation}, {scene}, "
        "{required}, {belief}, {name}, {value}, {probably}, {open}"
    )
    message = message.replace("{SLOTS}", there_are)
    assert str(problem.value) == f"{folder}/questions.toml:{message}"


def test_a_domain_words_its_own_answers(tmp_path: Path) -> None:
    questions = QUESTIONS.replace('fillers = ["please"]', '[answers]\nyes_class = "aye, {class}"')
    agent = Agent(load_domain(write_domain(tmp_path / "tiles", questions=questions)))
    assert _ask(agent, ("red", "yes"), "is it good?").text == "Aye, good."


# Reference answers ----------------------------------------------------------------------------


def test_relevant_features_where_one_alone_is_as_certain_as_all() -> None:
    experience = experience_of(
        [("a", "x"), ("a", "y"), ("b", "x"), ("b", "y")] * 5, ["up", "up", "down", "up"] * 5
    )
    features = ["first", "second"]
    assert relevant_features(experience, features, ("a", "x"), "up") == ("first",)
    assert relevant_features(experience, features, ("b", "x"), "down") == ("first", "second")
    assert relevant_features(experience, features, (None, None), "up") == ()


def test_reference_answers_where_the_knowledge_is_wrong(reasoning: Agent) -> None:
    vector = ("5", "wide", "no", "no")
    experience = experience_of([vector, ("5", "wide", "yes", "no")], ["unstable", "stable"])
    reasoned: ReasonedAnswers = reasoning.reasoned
    reference = ReferenceAnswers(reasoning.domain, reasoned, experience)
    answers = {
        "is it stable?": "no_class()",
        "why is it stable?": "false_premise(lean)",
        "why is it unstable?": "reasons(lean)",
        "why is it not stable?": "against(lean)",
        "why is it not unstable?": "denied_not(lean)",
        "how many blocks are there?": "value(num_blocks)",
        "what would make it unstable?": "already()",
    }
    for question, identifier in answers.items():
        understood = reasoning.questions.understand(question)
        assert reference.answer(understood, vector, "unstable").identifier == identifier, question


# Words ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("literal", "said"),
    [
        (Literal("stable", ("structure",)), "the structure is stable"),
        (Literal("stable", ("structure",), positive=False), "the structure is unstable"),
        (Literal("num_blocks", ("structure", "3")), "the structure has three blocks"),
        (
            Literal("num_blocks", ("structure", "3"), positive=False),
            "it is not so that the structure has three blocks",
        ),
        (Literal("lean", ("structure",), positive=False), "the structure is standing straight"),
        (Literal("top_heavy", ("structure", "very")), "the top heavy of the structure is very"),
        (Literal("windy", (), positive=False), "it is not windy"),
    ],
)
def test_a_literal_in_words(structures: Domain, literal: Literal, said: str) -> None:
    assert say_literal(structures, literal) == said


def test_features_that_are_not_known_are_not_said(structures: Domain) -> None:
    assert say_features(structures, (None, "wide", None, "no"), tuple(structures.features)) == (
        "the structure has a wide base, and no block is displaced"
    )
    assert say_features(structures, ("1", "wide", "no", "no"), ()) == ""


def test_clauses_and_words_are_joined() -> None:
    assert draw_together(["{it} has a", "no b is c", "{it} has d"]) == [
        "{it} has a",
        "no b is c",
        "{it} has d",
    ]
    assert [join_words(list("abc")[:n]) for n in range(4)] == ["", "a", "a and b", "a, b and c"]
    assert say_one_of(["it leans", "a block is off"]) == "it leans or a block is off"
    assert say_one_of(["{it} has a wide base", "{it} has a narrow base"]) == (
        "{it} has a wide or narrow base"
    )


def test_values_of_categories_and_numbers(tiles: Domain, structures: Domain) -> None:
    assert say_values(tiles, "colour", ("red", "green", "blue")) == "{it} is red, green or blue"
    assert say_values(structures, "num_blocks", ("2", "3", "5")) == (
        "{it} has two, three or five blocks"
    )
    assert say_values(structures, "num_blocks", ("2", "3", "4")) == "{it} has two to four blocks"
    assert say_values(structures, "lean", ("no",)) == "{it} is standing straight"


def test_the_most_of_many_values_is_said_by_the_others() -> None:
    signs = load_domain("traffic_signs")
    shapes, symbols = (signs.features[key].values for key in ("shape", "primary_symbol"))
    but_one = [shape for shape in shapes if shape != "circle"]
    assert say_values(signs, "shape", but_one) == "the shape of {it} is anything but round"
    but_two = [symbol for symbol in symbols if symbol not in ("cow", "bump")]
    assert say_values(signs, "primary_symbol", but_two) == (
        "the symbol of {it} is anything but a bump or a cow"
    )
    half = [shape for shape in shapes if shape in shapes[:4]]
    assert "anything but" not in say_values(signs, "shape", half)
    assert "anything but" not in say_values(signs, "shape", shapes)
