"""Questions about reasons: when, what matters, because of what, what else, what if it were not."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy.agent.agent import Agent
from seewhy.check.domain import check_domain
from seewhy.dialogue.reply import Reply
from seewhy.domain.assignments import named_values
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import QuestionError
from seewhy.knowledge.doubled import doubled

KNOWLEDGE = """#sort game.
#sort hue = {red, blue, green}.
#static colour(game, hue).
#static solid(game).
#static round(game).
#static win(game).
#static lose(game).
%% a red game is lost
lose(G) if colour(G, red).
%% a solid game that is not red is won
win(G) if solid(G), not colour(G, red).
"""
TABLES = """[domain]
name = "games"
title = "Games"
scene = "game"
subject = "the game"
[pictures]
size = 32
[features.colour]
name = "colour"
[features.colour.values]
red = { say = "{it} is red" }
blue = { say = "{it} is blue" }
green = { say = "{it} is green" }
[features.solid]
name = "filling"
[features.solid.values]
yes = { say = "{it} is solid" }
no = { say = "{it} is hollow" }
[features.round]
name = "form"
[features.round.values]
yes = { say = "{it} is round" }
no = { say = "{it} is flat" }
[classes.win]
literal = "win(G)"
say = "a win"
[classes.lose]
literal = "lose(G)"
say = "a lose"
"""


def games(folder: Path, *, more: str = "") -> Domain:
    folder.joinpath("knowledge.al").write_text(KNOWLEDGE + more, encoding="utf-8")
    folder.joinpath("domain.toml").write_text(TABLES, encoding="utf-8")
    folder.joinpath("questions.toml").write_text("", encoding="utf-8")
    return load_domain(str(folder))


def told(domain: Domain, values: list[str], *questions: str) -> list[str]:
    """The answers of one conversation."""
    agent = Agent(domain)
    scene = agent.classify_values(named_values(domain, values))
    before: Reply | None = None
    said = []
    for question in questions:
        asked = agent.questions.understand(question, previous=before and before.question)
        before = agent.answer(scene, asked, previous=before)
        said.append(before.text)
    return said


@pytest.mark.parametrize(
    ("question", "right"),
    [
        ("why does it win?", "The game is blue and solid."),
        (
            "when is it a win?",
            'The game is a win by the rule "a solid game that is not red is won" '
            "(knowledge.al:11).",
        ),
        (
            "when does it lose?",
            'The game is a lose by the rule "a red game is lost" (knowledge.al:9).',
        ),
        ("does the colour matter?", "Yes: if the game is red, it is a lose."),
        ("is the colour important?", "Yes: if the game is red, it is a lose."),
        (
            "does the form matter?",
            "No: no rule about the classes speaks of the form, and whatever the form is, the game "
            "is a win.",
        ),
        (
            "what if it were solid but not red?",
            "If the game is solid and it is not red, it is still a win.",
        ),
        (
            "what if it were not blue?",
            "If the game is not blue, it depends: it is a lose, for instance, if the game is red; "
            "it is a win, for instance, if the game is green.",
        ),
        ("is it a lose because it is red?", "No, the game is a win, since it is blue and solid."),
        ("is it a win because it is solid?", "Yes, since the game is blue and solid."),
        (
            "is it a win because it is round?",
            "No, not because of the form: the game is a win, since it is blue and solid.",
        ),
        (
            "is it a win because it is hollow?",
            "No, the game is solid; it is a win, since it is blue and solid.",
        ),
    ],
)  # fmt: skip
def test_a_newcomer_asks_for_reasons(tmp_path: Path, question: str, right: str) -> None:
    values = ["colour=blue", "solid=yes", "round=yes"]
    assert told(games(tmp_path), values, question) == [right]


def test_what_else_goes_on_where_the_answer_before_ended(tmp_path: Path) -> None:
    values = ["colour=blue", "solid=yes", "round=yes"]
    questions = ("why is it a win?", "what else?", "anything else?")
    assert told(games(tmp_path), values, *questions) == [
        "The game is blue and solid.",
        "There is no other reason; I was also told that the game is round.",
        "Nothing else: that is all that I know of it.",
    ]
    (first,) = told(games(tmp_path), values, "what else?")
    assert first == "I was also told that the game is blue."


def test_several_reasons_are_told_apart() -> None:
    values = ["num_blocks=5", "base=narrow", "lean=yes", "block_displaced=yes"]
    domain = load_domain("structure_stability")
    assert told(domain, values, "is it unstable because it leans?", "does the base matter?") == [
        "Yes, since the structure has five blocks and a narrow base, and it leans to one side; "
        "that a block is displaced is a reason as well.",
        "Not here: whatever the width of the base is, the structure is unstable; elsewhere it may, "
        'by the rule "a structure on a wide base does not fall when it stands straight and every '
        'block is balanced" (knowledge.al:23).',
    ]


def test_where_no_rule_says_when(tmp_path: Path) -> None:
    domain = games(tmp_path)
    domain.folder.joinpath("knowledge.al").write_text(
        KNOWLEDGE.split("%% a solid")[0], encoding="utf-8"
    )
    (said,) = told(load_domain(str(tmp_path)), ["colour=red"], "when is it a win?")
    assert said == "No rule of the knowledge says when the game is a win."


@pytest.mark.parametrize("question", ["", "glorp?", "why is it wet?"])
def test_a_domain_without_templates_asks_back(tmp_path: Path, question: str) -> None:
    agent = Agent(games(tmp_path))
    with pytest.raises(QuestionError) as caught:
        agent.questions.understand(question)
    assert caught.value.nearest


def test_rules_said_twice_are_noted(tmp_path: Path) -> None:
    more = "lose(X) if colour(X, red).\nwin(H) if not colour(H, red), round(H), solid(H).\n"
    domain = games(tmp_path, more=more)
    notes = doubled(domain.knowledge.axioms)
    assert [note.split(": ", 1)[1] for note in notes] == [
        "'lose(X) if colour(X, red).' is the axiom of line 9 once more",
        "'win(H) if not colour(H, red), round(H), solid(H).' adds nothing: line 11 concludes it "
        "without 'round(H)'",
    ]
    assert set(notes) <= set(check_domain(domain).warnings)
    assert not doubled(load_domain("traffic_signs").knowledge.axioms)
