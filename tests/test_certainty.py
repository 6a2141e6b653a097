"""What is not sure is not said as sure, whatever is asked, in every domain."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import QUESTIONS, TRUTH, seen, write_domain
from seewhy.agent.agent import Agent
from seewhy.agent.trace import trace_of
from seewhy.cli.ask import print_reply
from seewhy.dialogue.answer import default_answer_templates
from seewhy.dialogue.certainty import (
    PROBABLE_FROM,
    SURE_FROM,
    Certainty,
    Ground,
    certainty_of,
    weakest,
)
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reply import Classification, FeatureReading
from seewhy.domain.domain import Domain, load_domain
from seewhy.knowledge.candidates import decided_vectors
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

TOPPLES = ("5", "narrow", "yes", "no")
WHY_TOPPLES = "the structure has five blocks and a narrow base, and it leans to one side."


def scene_of(
    agent: Agent,
    vector: FeatureVector,
    unsure: dict[str, float],
    *,
    otherwise: float = 0.97,
    class_probability: float | None = None,
) -> Classification:
    """A scene whose features are seen with these probabilities, all others with ``otherwise``."""
    scene = seen(agent, *vector, probability=otherwise)
    features = {
        key: replace(reading, probability=unsure.get(key, otherwise))
        for key, reading in scene.features.items()
    }
    return replace(scene, features=features, probability=class_probability)


# In words -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("unsure", "class_probability", "question", "text"),
    [
        ({"lean": 0.7}, None, "is it stable or unstable?", "The structure is probably unstable."),
        ({"lean": 0.6}, None, "is it stable or unstable?", "The structure is perhaps unstable."),
        ({"lean": 0.9}, None, "is it stable or unstable?", "The structure is unstable."),
        ({}, 0.7, "is it stable or unstable?", "The structure is probably unstable."),
        ({}, 0.7, "is it unstable?", "Probably the structure is unstable."),
        ({}, 0.6, "is it stable?", "Perhaps not: it seems that the structure is unstable."),
        ({"lean": 0.7}, 0.99, "why is it unstable?", f"Probably because {WHY_TOPPLES}"),
        ({"lean": 0.6}, 0.99, "why is it not stable?", f"Perhaps because {WHY_TOPPLES}"),
        (
            {"base": 0.7},
            0.99,
            "why is it stable?",
            f"The structure is probably not stable but unstable, since it{WHY_TOPPLES[13:]}",
        ),
        (
            {"base": 0.7},
            0.99,
            "why is it not unstable?",
            f"The structure is probably unstable, since it{WHY_TOPPLES[13:]}",
        ),
        (
            {"base": 0.7},
            0.99,
            "what would make it stable?",
            "Probably this would make the structure stable: give it a wide base and straighten it.",
        ),
        # What stays as it is has to be so, too: nothing would help where a block were displaced.
        (
            {"block_displaced": 0.7},
            0.99,
            "what would make it stable?",
            "Probably this would make the structure stable: give it a wide base and straighten it.",
        ),
        ({}, 0.7, "what would make it unstable?", "The structure is probably unstable already."),
        ({"base": 0.7}, None, "how wide is the base?", "Probably the structure has a narrow base."),
        ({"base": 0.7}, None, "is the base narrow?", "Probably the structure has a narrow base."),
        (
            {"base": 0.7},
            None,
            "is the base wide?",
            "Probably not: it seems that the structure has a narrow base.",
        ),
        # An answer about one feature rests on nothing else.
        ({"base": 0.2}, 0.2, "does it lean?", "Yes, the structure leans to one side."),
        # A feature that no answer of this kind rests on.
        ({"block_displaced": 0.2}, None, "is it unstable?", "Yes, the structure is unstable."),
        (
            {"lean": 0.7},
            0.99,
            "please explain this answer",
            f"Probably {WHY_TOPPLES[:-1]} (each with a probability of at least 0.70). Probably the "
            'structure is unstable, because "a leaning structure of more than three blocks on a '
            'narrow base topples".',
        ),
        (
            {},
            0.6,
            "please explain this answer",
            f"I see that {WHY_TOPPLES[:-1]} (each with a probability of at least 0.97). Perhaps "
            'the structure is unstable, because "a leaning structure of more than three blocks on '
            'a narrow base topples".',
        ),
    ],
)
def test_unsure_answers_about_structures(
    reasoning: Agent,
    unsure: dict[str, float],
    class_probability: float | None,
    question: str,
    text: str,
) -> None:
    scene = scene_of(reasoning, TOPPLES, unsure, class_probability=class_probability)
    assert reasoning.answer(scene, reasoning.questions.understand(question)).text == text


def test_of_two_reasons_the_surer_is_enough_unless_both_are_told(reasoning: Agent) -> None:
    scene = scene_of(reasoning, ("5", "narrow", "yes", "yes"), {"base": 0.5})
    asked = reasoning.questions.understand
    assert reasoning.answer(scene, asked("is it stable?")).text == "No, the structure is unstable."
    why = reasoning.answer(scene, asked("why is it unstable?"))
    assert why.text.startswith("Perhaps because ")
    assert reasoning.answer(scene, asked("please explain this answer"), previous=why).text == (
        "You asked: why is the structure unstable? Perhaps the structure has five blocks "
        "and a narrow base, it leans to one side, and a block is displaced (each with a "
        'probability of at least 0.50). The structure is unstable, because "a block that '
        'is not balanced on the one below it falls". Perhaps the structure is unstable, because '
        '"a leaning structure of more than three blocks on a narrow base topples".'
    )


def test_an_overruled_network_leaves_doubt(reasoning: Agent) -> None:
    """What is read against what the network saw is as probable as the network says."""
    scene = scene_of(reasoning, TOPPLES, {}, class_probability=0.95)
    lean = FeatureReading("yes", 0.2, ("no", 0.8))
    scene = replace(scene, features={**scene.features, "lean": lean})
    reply = reasoning.answer(scene, reasoning.questions.understand("does it lean?"))
    assert reply.text == "Perhaps the structure leans to one side."
    assert reply.least_sure == Ground("lean", "yes", 0.2)


@pytest.mark.parametrize(
    ("class_probability", "concluded"), [(0.6, "Perhaps the tile is good. "), (0.95, "")]
)
def test_what_a_tree_concludes_is_told_no_surer_than_it_is(
    agents: dict[str, Agent], class_probability: float, concluded: str
) -> None:
    agent = agents["tiles"]
    scene = scene_of(agent, ("green", "yes"), {}, class_probability=class_probability)
    told = agent.answer(scene, agent.questions.understand("please explain this answer")).text
    assert f"(1 of 2 features tested, 100 % of 8 tiles). {concluded}The answer was chosen" in told


def test_what_is_supposed_is_no_doubt_but_what_would_be_seen_is(reasoning: Agent) -> None:
    stable = scene_of(reasoning, ("2", "wide", "no", "no"), {}, class_probability=0.8)
    leaning = scene_of(reasoning, TOPPLES, {"lean": 0.2}, class_probability=0.2)
    ask = reasoning.questions.understand("why is it unstable?")
    reply = reasoning.answer(replace(stable, otherwise=(leaning,)), ask)
    assert reply.text == (
        "I took the structure to be stable. If it is unstable, as you say: perhaps because "
        f"{WHY_TOPPLES}"
    )
    sure = replace(leaning, features=scene_of(reasoning, TOPPLES, {}).features)
    reply = reasoning.answer(replace(stable, otherwise=(sure,)), ask)
    assert reply.text.endswith(f"as you say: {WHY_TOPPLES}")
    assert reply.certainty is Certainty.SURE


def test_what_cannot_be_told_is_neither_sure_nor_unsure(reasoning: Agent) -> None:
    scene = scene_of(reasoning, ("5", "narrow", "no", "no"), {}, otherwise=0.4)
    reply = reasoning.answer(scene, reasoning.questions.understand("is it stable?"))
    assert (reply.kind.form, reply.certainty, reply.least_sure) == ("undecided", None, None)
    assert reply.to_dict()["certainty"] is None


# Every kind of answer -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def agents(tiles: Domain) -> dict[str, Agent]:
    """Agents without networks; the one of the tiles has learned what its knowledge leaves open."""
    learned = Agent(tiles, seed=3)
    vectors = [*TRUTH] * 4
    learned.fit_induction(vectors, [TRUTH[vector] for vector in vectors])
    return {
        "structures": Agent(load_domain("structure_stability")),
        "signs": Agent(load_domain("traffic_signs")),
        "tiles": learned,
    }


SCENES = {
    "structures": list(product("12345", ("wide", "narrow"), ("yes", "no"), ("yes", "no"))),
    "tiles": list(TRUTH),
}


@settings(max_examples=150)
@given(data=st.data(), name=st.sampled_from(["structures", "signs", "tiles"]))
def test_a_word_says_so_exactly_where_something_is_unsure(
    agents: dict[str, Agent], data: st.DataObject, name: str
) -> None:
    agent = agents[name]
    vectors = SCENES.get(name) or sorted(decided_vectors(agent.reasoner, limit=1000) or ())
    vector = data.draw(st.sampled_from(vectors))
    shares = st.sampled_from([0.05, 0.3, 0.64, 0.65, 0.8, 0.89, 0.9, 0.95, 1.0])
    unsure = {key: data.draw(shares) for key in agent.domain.features}
    class_probability = data.draw(st.none() | shares)
    scene = scene_of(agent, vector, unsure, class_probability=class_probability)
    plain = scene_of(agent, vector, {}, otherwise=1.0)
    question = data.draw(st.sampled_from(agent.questions.one_of_each()))
    reply, sure = agent.answer(scene, question), agent.answer(plain, question)
    assert reply.kind == sure.kind
    words = reply.text.casefold().split()
    assert reply.text[0].isupper()
    assert "  " not in reply.text
    assert not {"{", "}"} & set(reply.text)
    told = {
        "probably": Certainty.PROBABLY,
        "perhaps": Certainty.PERHAPS,
    }
    found = {
        certainty for word, certainty in told.items() if any(word in spoken for spoken in words)
    }
    if reply.certainty in (None, Certainty.SURE):
        assert not found
        assert question.asks is Asks.EXPLAIN or reply.text == sure.text
    else:
        assert reply.certainty in found
        assert question.asks is Asks.EXPLAIN or found == {reply.certainty}
    # Whatever the answer says of features and class is at least as probable as it sounds.
    grounds = [unsure[key] for key in reply.kind.mentions]
    grounds += [unsure[key] for change in reply.kind.changes for key, _ in change]
    if reply.certainty is not None and question.feature is None and scene.label is not None:
        grounds.append(1.0 if class_probability is None else class_probability)
    least = min(grounds, default=1.0)
    assert reply.certainty is not Certainty.SURE or least >= SURE_FROM
    assert reply.certainty is not Certainty.PROBABLY or least >= PROBABLE_FROM
    if reply.least_sure is not None:
        assert reply.certainty in (None, certainty_of(reply.least_sure))
        ground = reply.least_sure
        expected = class_probability if ground.feature == "class" else unsure[ground.feature]
        assert ground.probability == expected
        assert ground.value == (
            scene.label if ground.feature == "class" else scene.features[ground.feature].value
        )


def test_every_form_that_says_what_is_seen_has_a_wording_that_does_not_say_it_as_sure() -> None:
    templates = default_answer_templates()
    silent = {
            "undecided", "several", "contradictory", "unknown", "no_belief", "no_difference",
            "explain", "feature_unknown",
        }  # fmt: skip
    forms = {form for form in templates if not form.endswith("_unsure")}
    for form in forms - silent - {"supposed", "supposed_not"}:
        assert "{probably}" in templates[f"{form}_unsure"], form
    for form in silent:
        assert f"{form}_unsure" not in templates


@pytest.mark.parametrize(
    ("answers", "text"),
    [
        ('class = "behold: {class}"', "Probably, behold: good."),
        ('class = "behold: {probably} {class}"', "Behold: probably good."),
        (
            'class = "behold: {class}"\nclass_unsure = "behold, {probably}: {class}"',
            "Behold, probably: good.",
        ),
        ('class_unsure = "{class}, {probably}"', "Good, probably."),
    ],
)
def test_a_domain_words_what_is_not_sure(tmp_path: Path, answers: str, text: str) -> None:
    questions = QUESTIONS.replace('fillers = ["please"]', f"[answers]\n{answers}")
    agent = Agent(load_domain(write_domain(tmp_path / "tiles", questions=questions)))
    asked = agent.questions.understand("what can you say about the tile?")
    unsure = scene_of(agent, ("red", "yes"), {"colour": 0.7})
    assert agent.answer(unsure, asked).text == text
    sure = scene_of(agent, ("red", "yes"), {})
    assert "probably" not in agent.answer(sure, asked).text.casefold()


# What a belief needs --------------------------------------------------------------------------


def test_what_a_belief_needs() -> None:
    def leaf(feature: str, probability: float | None, *, holds: bool = True) -> Node:
        return Node("", "", Basis.FEATURE, holds, feature=feature, probability=probability)

    def node(basis: Basis, *children: Node) -> Node:
        return Node("", "", basis, children=children)

    assert weakest(node(Basis.AXIOM)) is None
    assert weakest(leaf("a", None)) is None
    assert weakest(node(Basis.AXIOM, leaf("a", 0.5), leaf("b", 0.4))) == Ground("b", "", 0.4)
    either = node(Basis.REASONS, leaf("a", 0.5), leaf("b", 0.4))
    assert weakest(either) == Ground("a", "", 0.5)
    # A reason that is certain by itself leaves no doubt.
    assert weakest(node(Basis.REASONS, leaf("a", 0.5), node(Basis.AXIOM))) is None
    # What fails is no support.
    assert weakest(node(Basis.TREE, leaf("a", 0.5), leaf("b", 0.1, holds=False))) == Ground(
        "a", "", 0.5
    )


# For people and programs ----------------------------------------------------------------------


def test_json_and_print_and_trace_say_what_is_not_sure(
    reasoning: Agent, capsys: pytest.CaptureFixture[str]
) -> None:
    question = reasoning.questions.understand("why is it unstable?")
    unsure = scene_of(reasoning, TOPPLES, {"lean": 0.7123456}, class_probability=0.8)
    reply = reasoning.answer(unsure, question)
    least = {"feature": "lean", "value": "yes", "probability": 0.7123}
    told = json.loads(json.dumps(reply.to_dict()))
    assert (told["certainty"], told["least_sure"]) == ("probably", least)
    print_reply(reply)
    assert "\nnot sure: lean yes (0.71)\n" in capsys.readouterr().out
    traced = trace_of(reasoning, unsure, asked="why is it unstable?", reply=reply)
    assert "Agent: Probably because the structure has five blocks" in traced.to_text()
    assert "\n  not sure; the least sure that it rests on is lean: yes (p = 0.71)\n" in (
        traced.to_text()
    )
    answer = traced.to_dict()["answer"]
    assert (answer["certainty"], answer["least_sure"]) == ("probably", least)

    doubtful = scene_of(reasoning, TOPPLES, {}, class_probability=0.6)
    reply = reasoning.answer(doubtful, question)
    assert reply.to_dict()["least_sure"] == {
        "feature": "class",
        "value": "unstable",
        "probability": 0.6,
    }
    traced = trace_of(reasoning, doubtful, asked="why is it unstable?", reply=reply)
    assert "the least sure that it rests on is the class: unstable (p = 0.60)" in traced.to_text()

    sure = reasoning.answer(scene_of(reasoning, TOPPLES, {}), question)
    assert sure.to_dict()["certainty"] == "sure"
    print_reply(sure)
    assert "not sure" not in capsys.readouterr().out
    traced = trace_of(reasoning, doubtful, asked="why is it unstable?", reply=sure)
    assert "not sure" not in traced.to_text()
