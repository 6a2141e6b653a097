"""Questions about what a scene's class makes believed: the message and the response of a sign."""

from __future__ import annotations

import random
import re
import tomllib
from importlib import resources
from pathlib import Path

import pytest

from conftest import seen
from seewhy.agent.agent import Agent
from seewhy.dialogue.answer import AnswerType, answer_templates, word_answer
from seewhy.dialogue.learned import MOST_EXAMPLES, dealt
from seewhy.dialogue.question import Asks, Question, Questions
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import load_domain
from seewhy.errors import DomainError
from seewhy.evaluation import score_answer
from seewhy.knowledge.why_not import why_not
from signs_builder import (
    ANSWERS,
    BELIEFS,
    FEATURES,
    FOUR,
    many_signs,
    trained_signs,
    write_signs,
)

MANY = many_signs(30)
OPEN = ("no_entry", "sign_3", "sign_7")


@pytest.fixture(scope="module")
def signs(tmp_path_factory: pytest.TempPathFactory) -> Agent:
    """Four signs; scenes of the one that the knowledge leaves open trained the tree."""
    return trained_signs(tmp_path_factory.getbasetemp())


@pytest.fixture(scope="module")
def many(tmp_path_factory: pytest.TempPathFactory) -> Agent:
    """Thirty signs, of three of which the knowledge says nothing."""
    return Agent(load_domain(write_signs(tmp_path_factory.mktemp("s") / "s", MANY, unknown=OPEN)))


def ask(agent: Agent, vector: tuple[str | None, ...], question: str) -> Reply:
    return agent.answer(seen(agent, *vector), agent.questions.understand(question))


# By the knowledge -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("sign", "question", "text", "values"),
    [
        (
            "uneven_road",
            "what is the message of the sign?",
            "The sign tells the driver: uneven road ahead.",
            ("uneven_road",),
        ),
        (
            "stop_sign",
            "wich mesage is it",
            "The sign tells the driver: stop sign.",
            ("stop_sign",),
        ),
        (
            "stop_sign",
            "what is the response of it",
            "The response of the sign is stop.",
            ("stop",),
        ),
        (
            "uneven_road",
            "which response is it?",
            "The response of the sign is slow down and be careful.",
            ("slow_down", "be_careful"),
        ),
        (
            "give_way",
            "what is the message of the sign?",
            "Nothing that is known says what the message of the sign is.",
            (),
        ),
    ],
)
def test_the_value_that_is_believed(
    signs: Agent, sign: str, question: str, text: str, values: tuple[str, ...]
) -> None:
    reply = ask(signs, FOUR[sign], question)
    assert (reply.text, reply.method, reply.kind.values) == (text, "knowledge", values)


def test_the_second_execution_example_of_the_paper(signs: Agent) -> None:
    """A triangular, white and red sign with a bumpy road, no secondary symbol and no cross."""
    reply = ask(signs, FOUR["uneven_road"], "what is the message of the sign?")
    assert reply.text == "The sign tells the driver: uneven road ahead."
    assert re.sub(r":\d+\)", ":#)", reply.justification.to_text()) == (
        'the sign tells the driver: uneven road ahead: "the sign uneven road says so" '
        "(knowledge.al:#)\n"
        '└─ the sign is an uneven road: "a triangle with the symbol bumpy_road is the sign uneven '
        'road" (knowledge.al:#)\n'
        "   ├─ the sign is triangle (p = 0.90)\n"
        "   ├─ the sign shows the symbol bumpy road (p = 0.90)\n"
        "   └─ the sign shows the plate none (p = 0.90)"
    )
    explain = signs.questions.understand("please explain this answer")
    scene = seen(signs, *FOUR["uneven_road"])
    assert signs.answer(scene, explain, previous=reply).text == (
        "You asked: what is the message of the sign? I see that the sign is triangle, and it shows "
        "the symbol bumpy road and the plate none (each with a probability of at least 0.90). "
        'The sign is an uneven road, because "a triangle with the symbol bumpy_road is the sign '
        'uneven road". The sign tells the driver: uneven road ahead, because "the sign uneven '
        'road says so".'
    )


def test_every_value_has_its_justification(signs: Agent) -> None:
    node = ask(signs, FOUR["uneven_road"], "which response is it?").justification
    assert [(child.literal, child.axiom is not None) for child in node.children] == [
        ("response(sign, slow_down)", True),
        ("response(sign, be_careful)", True),
    ]


def test_what_nothing_says_is_explained_by_the_class(signs: Agent) -> None:
    reply = ask(signs, FOUR["give_way"], "what is the message of the sign?")
    assert reply.kind == AnswerType("no_belief")
    assert not reply.justification.holds
    assert [child.text for child in reply.justification.children] == ["the sign is a give way"]
    explain = signs.questions.understand("explain")
    told = signs.answer(seen(signs, *FOUR["give_way"]), explain, previous=reply).text
    assert told.endswith("Nothing that is known says what the message of the sign is.")


def test_without_a_table_a_belief_is_said_by_its_name(tmp_path: Path) -> None:
    agent = Agent(load_domain(write_signs(tmp_path / "signs", beliefs="")))
    assert ask(agent, FOUR["uneven_road"], "what is the message of the sign?").text == (
        "The message of the sign is uneven road."
    )
    assert list(agent.domain.beliefs) == ["kind", "message", "response"]


def test_what_contradicts_what_is_seen_is_told(many: Agent) -> None:
    row = FOUR["uneven_road"]
    scene = seen(many, row[0], "blue", *row[2:])
    explain = many.questions.understand("explain")
    assert many.answer(scene, explain).text.endswith(
        'The knowledge contradicts itself here: "the sign uneven road is mainly white" and "a '
        'triangle with the symbol bumpy_road is the sign uneven road" do not agree with what is '
        "seen. There were no such scenes to learn from either."
    )


def test_a_fact_without_a_sentence_is_no_step_of_an_explanation(tmp_path: Path) -> None:
    axioms = "#static grave(kinds).\ngrave(stop_sign).\n%% grave signs call for care\n"
    axioms += "response(S, be_careful) if kind(S, K), grave(K).\n"
    agent = Agent(load_domain(write_signs(tmp_path / "signs", axioms=axioms)))
    reply = ask(agent, FOUR["stop_sign"], "which response is it?")
    assert "stop sign is grave" in reply.justification.to_text()
    explain = agent.questions.understand("explain")
    told = agent.answer(seen(agent, *FOUR["stop_sign"]), explain, previous=reply).text
    assert '"grave signs call for care"' in told
    assert "rave (stop sign)" not in told


# By the tree ----------------------------------------------------------------------------------


def test_the_class_of_the_tree_is_the_basis_of_what_follows(signs: Agent) -> None:
    reply = ask(signs, FOUR["no_entry"], "what is the message of the sign?")
    assert (reply.text, reply.method) == ("The sign tells the driver: no entry.", "tree")
    lines = re.sub(r":\d+\)", ":#)", reply.justification.to_text()).splitlines()
    assert lines[:5] == [
        'the sign tells the driver: no entry: "the sign no entry says so" (knowledge.al:#)',
        "└─ the sign is a no entry",
        "   ├─ of the signs that no rule decides, if the sign shows the symbol symbol 0,"
        " then it is a no entry (1 of 7 features "
        "tested, 100 % of 10 signs)",
        "   │  └─ the sign shows the symbol symbol 0 (p = 0.90)",
        "   └─ the knowledge does not decide: no axiom concludes a class",
    ]
    explain = signs.questions.understand("explain")
    told = signs.answer(seen(signs, *FOUR["no_entry"]), explain, previous=reply).text
    assert told.startswith("You asked: what is the message of the sign? I see that the sign is")
    assert told.endswith(
        "The knowledge does not decide: no axiom concludes a class. So the decision tree is "
        "asked: of the signs that no rule decides, if the sign shows the symbol symbol 0, then it "
        "is a no entry (1 of 7 features tested, 100 % of 10 signs). The sign tells the driver: no "
        'entry, because "the sign no '
        'entry says so".'
    )


def test_what_follows_from_the_class_is_not_learned(signs: Agent) -> None:
    assert signs.answerer is not None
    forms = {AnswerType.parse(text).form for text in signs.answerer.answer_types}
    assert not forms & {"belief", "no_belief"}
    assert "difference" in forms


def test_told_a_class_its_values_are_believed_whatever_is_seen(many: Agent) -> None:
    """Also where what is seen contradicts the class, or is decided to be another."""
    question = many.questions.understand("what is the message of the sign?")
    generator = random.Random(1)
    vectors: list[tuple[str | None, ...]] = [*MANY.values()]
    vectors += [
        tuple(generator.choice((*values, None)) for values in FEATURES.values()) for _ in range(20)
    ]
    for vector in vectors:
        for label in generator.sample(list(MANY), 6):
            expected = () if label == "give_way" else (label,)
            assert many.reasoned.kind(question, vector, label).values == expected
            reasoned = many.reasoned.answer(question, vector, label)
            assert reasoned.kind.values == expected


def test_what_is_seen_counts_beside_the_class_that_is_told(tmp_path: Path) -> None:
    axioms = "response(S, give_way) if kind(S, no_entry), cross(S, black).\n"
    agent = Agent(load_domain(write_signs(tmp_path / "signs", axioms=axioms)))
    question = agent.questions.understand("which response is it?")
    crossed = (*FOUR["no_entry"][:6], "black")
    kinds = [agent.reasoned.kind(question, v, "no_entry") for v in (FOUR["no_entry"], crossed)]
    assert [set(kind.values) for kind in kinds] == [{"stop"}, {"stop", "give_way"}]


def test_a_class_that_is_not_decided_makes_nothing_believed(many: Agent) -> None:
    vector = ("circle", "white", "white", "square", "stop", "plate_8", "black")
    reply = ask(many, vector, "what is the message of the sign?")
    assert reply.text == (
        "I cannot tell whether the sign is an uneven road, a stop sign or one of 28 others: the "
        "knowledge does not decide, and there was nothing to learn it from."
    )


# Scoring --------------------------------------------------------------------------------------


def test_two_classes_with_one_response_are_equally_right(signs: Agent) -> None:
    question = signs.questions.understand("which response is it?")
    gold = signs.reference.answer(question, FOUR["no_entry"], "no_entry")
    same = ask(signs, FOUR["stop_sign"], "which response is it?").kind
    other = ask(signs, FOUR["give_way"], "which response is it?").kind
    more = ask(signs, FOUR["uneven_road"], "which response is it?").kind
    values: dict[str, str | None] = {}
    for kind, right in ((same, True), (other, False), (more, False)):
        scored = score_answer(kind, gold, seen=values, true=values, right_class=False)
        assert scored == (right, right)
    none = AnswerType("no_belief")
    for kind, right in ((none, True), (same, False)):
        scored = score_answer(kind, none, seen=values, true=values, right_class=True)
        assert scored == (right, right)


def test_an_answer_type_keeps_its_values() -> None:
    for kind in (
        AnswerType("belief", values=("stop", "slow_down")),
        AnswerType("belief", ("a", "b"), ((("lean", "no"),),), ("stop",)),
    ):
        assert AnswerType.parse(kind.identifier) == kind


# What users write wrongly ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("beliefs", "error"),
    [
        (
            BELIEFS.replace("beliefs.message", "beliefs.mesage"),
            "the belief 'mesage' is not declared in knowledge.al; did you mean 'message'?",
        ),
        (
            '[beliefs.shape]\nname = "shape"\n',
            "'shape' is a feature, which is seen and not believed; say its values under "
            "[features.shape.values] and remove [beliefs.shape]",
        ),
        (
            '[beliefs.lit]\nname = "lit"\n',
            "the belief 'lit' must be declared as '#static lit(sign, SORT).' or, where it is no "
            "class, '#static lit(sign).', got 'lit(kinds)' (",
        ),
        (
            BELIEFS.replace("uneven_road =", "unevn_road ="),
            "'unevn_road' is no value of 'message' in knowledge.al; did you mean 'uneven_road'?",
        ),
        (
            BELIEFS.replace("{value}", "{valu}"),
            "'beliefs.message.say': must have the slot {value} and may have {it}, got "
            "'{it} tells the driver: {valu}'",
        ),
        (
            BELIEFS.replace("say =", "sya ="),
            "'beliefs.message.sya' is not known here; did you mean 'say'?",
        ),
    ],
)
def test_a_wrong_table_of_beliefs_is_named_with_its_line(
    tmp_path: Path, beliefs: str, error: str
) -> None:
    folder = write_signs(tmp_path / "signs", beliefs=beliefs, axioms="#static lit(kinds).\n")
    with pytest.raises(DomainError) as problem:
        load_domain(folder)
    place, _, said = str(problem.value).partition(": ")
    file, _, line = place.rpartition(":")
    assert file == str(folder / "domain.toml")
    text = (folder / "domain.toml").read_text().splitlines()[int(line) - 1]
    assert re.search("beliefs|road|say|sya", text)
    assert said.startswith(error)


@pytest.mark.parametrize(
    ("question", "error"),
    [
        (
            'asks = "belief_value"\npatterns = ["what"]',
            "asks = 'belief_value' needs a static; add predicate = \"…\"",
        ),
        (
            'asks = "class"\npredicate = "message"\npatterns = ["what"]',
            "asks = 'class' is about no static; remove 'predicate'",
        ),
        (
            'asks = "belief_value"\npredicate = "mesage"\npatterns = ["what"]',
            "'mesage' is no static of knowledge.al that gives 'sign' a value; did you mean "
            "'message'?",
        ),
        (
            'asks = "belief_value"\npredicate = "shape"\npatterns = ["what"]',
            "'shape' is a feature; ask for it with asks = 'feature_value' and feature = \"shape\"",
        ),
    ],
)
def test_a_wrong_question_about_a_belief_is_named_with_its_line(
    tmp_path: Path, question: str, error: str
) -> None:
    folder = write_signs(tmp_path / "signs", questions=f"[[question]]\n{question}\n")
    with pytest.raises(DomainError) as problem:
        Questions(load_domain(folder))
    path = folder / "questions.toml"
    line = 1 + path.read_text().splitlines().index("[[question]]") if question else 0
    place, _, said = str(problem.value).partition(": ")
    assert said == error
    assert int(place.rpartition(":")[2]) > line


# Every form can be reworded -------------------------------------------------------------------

FORMS = tomllib.loads(
    resources.files("seewhy.dialogue").joinpath("answers.toml").read_text(encoding="utf-8")
)


@pytest.mark.parametrize("form", FORMS)
def test_every_form_can_be_reworded(tmp_path: Path, form: str) -> None:
    reworded = f'[answers]\n{form} = "as {{asked}} goes, {{it}} it is"\n'
    agent = Agent(load_domain(write_signs(tmp_path / "signs", answers=reworded)))
    asks = Question(asks=Asks.IS_CLASS, text="", words=(), label="stop_sign")
    if form == "explain":
        reply = ask(agent, FOUR["stop_sign"], "explain")
        assert reply.text == "as  goes, the sign it is"
        return
    base = form.removesuffix("_bare")
    kind = AnswerType("reasons" if form == "no_reasons" else base)
    if form == base and f"{base}_bare" in answer_templates(agent.domain):
        kind = AnswerType(base, ("shape",))
    said = word_answer(agent.domain, asks, kind, vector=FOUR["stop_sign"], label="stop_sign")
    if form == "reasons":
        kind = AnswerType(base, ("shape",))
        said = word_answer(agent.domain, asks, kind, vector=FOUR["stop_sign"], label="stop_sign")
    assert said == "As a stop sign goes, the sign it is."


def test_a_change_reads_well_of_what_is_a_thing(signs: Agent) -> None:
    assert "change" in ANSWERS
    assert ask(signs, FOUR["give_way"], "what would make it a stop sign?").text == (
        "To be a stop sign, the sign would have to be octagon, be mainly red, have a white border "
        "and show the symbol stop."
    )


# Many classes ---------------------------------------------------------------------------------


def test_why_many_classes_are_not_decided_shows_the_nearest(many: Agent) -> None:
    row = MANY["no_entry"]
    node = ask(many, row, "what is it?").justification
    *nearest, others = node.children
    assert len(nearest) == 3
    assert others.text == ("nor does it follow that the sign is of one of the 27 other classes")

    def failed(label: str) -> int:
        literal = many.domain.classes[label].literal
        refused = why_not(many.reasoner, row, literal)
        conditions = refused.children[0].children if refused.children else ()
        return sum(not condition.holds for condition in conditions) if conditions else 99

    shown = {child.literal for child in nearest}
    ranked = sorted(MANY, key=failed)
    least = sorted(map(failed, ranked[:3]))
    chosen = [label for label in MANY if str(many.domain.classes[label].literal) in shown]
    assert sorted(map(failed, chosen)) == least


def test_questions_that_are_drawn_leave_no_query_out(many: Agent) -> None:
    by_query: dict[tuple[str, str | None, str | None, str | None], list[Question]] = {}
    for question in many.questions.all:
        by_query.setdefault(question.query, []).append(question)
    labels = [OPEN[n % 3] for n in range(40)]
    most = 2 * len(by_query)
    drawn = list(dealt(by_query, labels, most=most, seed=4))
    assert drawn == list(dealt(by_query, labels, most=most, seed=4))
    assert drawn != list(dealt(by_query, labels, most=most, seed=5))
    assert sum(len(queries) for _, queries in drawn) <= most
    assert {query for _, queries in drawn for query in queries} == set(by_query)
    assert {scene for scene, _ in drawn} == set(range(40))
    for scene, queries in drawn:
        assert len(set(queries)) == len(queries)
        of_class = {query for query in by_query if query[1] == labels[scene]}
        assert of_class <= set(queries)
    # More scenes than examples, and few enough questions to ask them all.
    assert sum(len(queries) for _, queries in dealt(by_query, labels, most=7, seed=0)) == 7
    every = list(dealt(by_query, labels[:2], most=MOST_EXAMPLES, seed=0))
    assert every == [(0, list(by_query)), (1, list(by_query))]
