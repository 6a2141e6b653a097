"""Questions and answers where features are alike and classes are numbers: golden whole texts."""

from __future__ import annotations

import pytest

from conftest import seen
from seewhy.agent.agent import Agent
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import QuestionError

FINGERS = ("thumb", "index", "middle", "ring", "little")


@pytest.fixture(scope="module")
def hands(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    folder = tmp_path_factory.mktemp("hands")
    features = "".join(
        f"""
[features.{finger}]
name = "{finger}"
[features.{finger}.values]
yes = {{ say = "the {finger} is stretched", words = ["stretched"] }}
no = {{ say = "the {finger} is folded", words = ["folded"] }}
"""
        for finger in FINGERS
    )
    classes = "".join(
        f"""
[classes.{number}]
literal = "digit(H, {number})"
say = "{number}"
"""
        for number in range(4)
    )
    (folder / "domain.toml").write_text(
        f"""
[domain]
name = "hands"
title = "Hands"
scene = "hand"
subject = "the hand"
eyes = "none"
{features}{classes}"""
    )
    statics = "".join(f"#static {finger}(hand).\n" for finger in FINGERS)
    (folder / "knowledge.al").write_text(
        f"""#sort hand.
#sort number = 0..3.
{statics}#static digit(hand, number).
digit(H, 0) if hand(H), not thumb(H), not index(H), not middle(H).
digit(H, 1) if index(H), not middle(H).
digit(H, 2) if index(H), middle(H), not thumb(H).
digit(H, 3) if thumb(H), index(H).
"""
    )
    (folder / "questions.toml").write_text(
        '[[question]]\nasks = "explain"\npatterns = ["explain"]\n'
    )
    return load_domain(folder)


UNDERSTOOD = {
    "which fingers are stretched?": ("which", None, None, "yes", *FINGERS),
    "how many fingers are folded?": ("how_many", None, None, "no", *FINGERS),
    "why is it a two?": ("why_class", "2", None, None),
    "is it number three?": ("is_class", "3", None, None),
    "what if the thumb and the ring were stretched?": (
        "what_if", None, None, None, "thumb=yes", "ring=yes",
    ),
    "are the thumb and the index stretched?": (
        "all", None, None, None, "thumb=yes", "index=yes",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("wording", "query"), UNDERSTOOD.items())
def test_alike_features_and_numbers_are_understood(
    hands: Domain, wording: str, query: tuple[str | None, ...]
) -> None:
    assert Questions(hands).understand(wording).query == query


def test_the_picture_itself_is_none_of_its_features(hands: Domain) -> None:
    with pytest.raises(QuestionError):
        Questions(hands).understand("which hands are stretched?")


@pytest.mark.parametrize("number", ["11", "eleven"])
def test_a_number_that_is_no_class_is_answered_with_those_there_are(
    hands: Domain, number: str
) -> None:
    with pytest.raises(QuestionError) as refused:
        Questions(hands).understand(f"why not {number}?")
    assert str(refused.value) == (
        f"'why not {number}?' is not understood: '{number}' is no class; the classes are 0, 1, 2 "
        "and 3"
    )


def test_where_rules_conclude_several_classes_these_are_named(hands: Domain) -> None:
    agent = Agent(hands)
    scene = seen(agent, "yes", "yes", "no", "no", "no")
    reply = agent.answer(scene, agent.questions.understand("is it 1?"))
    assert reply.text == (
        "I cannot tell what the hand is: by what is known it is both 1 and 3, and only one can be."
    )
