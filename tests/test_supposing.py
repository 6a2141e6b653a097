"""Questions that presume what a picture is not taken to be: who asks may be believed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import TRUTH, draw_tile, seen
from knowledge_builders import VALUES, World, worlds
from seewhy.agent.agent import Agent
from seewhy.agent.class_shares import with_class_shares
from seewhy.agent.consistent_reading import ConsistentReading, open_vectors
from seewhy.agent.picture_reading import read_separately
from seewhy.cli.ask import print_reply
from seewhy.data.dataset import Dataset
from seewhy.dialogue.certainty import SURE_FROM, Certainty
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reply import Classification, FeatureReading
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.tables import CLASS
from seewhy.errors import DomainError
from seewhy.evaluation import evaluate
from seewhy.knowledge.candidates import decided_vectors
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.extractor import Seen
from test_reading import SPACE, distributions, logarithm

# What else a picture may be -----------------------------------------------------------------


@settings(max_examples=80)
@given(
    world=worlds(),
    sure=distributions(),
    opened=st.lists(st.sampled_from(SPACE), max_size=4, unique=True),
    parts=st.lists(st.integers(0, 3), min_size=12, max_size=12),
    seen_classes=st.lists(st.integers(1, 5), min_size=3, max_size=3),
    least=st.sampled_from([0.02, 0.1, 0.4]),
    witnessed=st.booleans(),
)
def test_other_classes_are_as_probable_as_all_their_candidates_together(
    world: World,
    sure: dict[str, np.ndarray[Any, Any]],
    opened: list[FeatureVector],
    parts: list[int],
    seen_classes: list[int],
    least: float,
    witnessed: bool,
) -> None:
    """Against going through all pairs of a candidate and a class."""
    reasoner = Reasoner(world.knowledge, world.schema)
    names = list(world.schema.classes)
    given_shares: dict[FeatureVector, dict[str, float]] = {}
    for number, vector in enumerate(opened):
        portions = parts[3 * (number % 4) :][: len(names)]
        if sum(portions):
            given_shares[vector] = {
                n: p / sum(portions) for n, p in zip(names, portions, strict=True)
            }

    def shares(vector: FeatureVector) -> dict[str, float]:
        label = reasoner.decide(vector).label
        return {label: 1.0} if label is not None else given_shares.get(vector, {})

    def label_of(vector: FeatureVector) -> str | None:
        by_class = shares(vector)
        return max(by_class, key=lambda name: by_class[name]) if by_class else None

    weights = dict(zip(names, seen_classes, strict=False))
    sure = {**sure, CLASS: np.array([[weights[n] / sum(weights.values()) for n in names]])}
    reader = ConsistentReading(
        reasoner,
        opened,
        label_of=label_of,
        shares_of=shares,
        other_from=least,
        witnessed=names if witnessed else (),
    )
    (found,) = reader.read(sure)
    candidates = [v for v in SPACE if world.decision(v)[0] is not None or v in opened]
    pairs: dict[tuple[str | None, FeatureVector], float] = {}
    for vector in candidates:
        alone = float(np.exp(logarithm(sure, vector)))
        for name, share in (shares(vector) or {None: 1.0}).items():
            witness = 1.0
            if witnessed and name is not None:
                witness = weights[name] / max(weights.values())
            pairs[name, vector] = alone * share * witness
    total = sum(pairs.values())
    if not candidates or total < 1e-200:
        return
    probable = {
        name: sum(probability for (label, _), probability in pairs.items() if label == name) / total
        for name in names
    }
    read = label_of(found.vector)
    expected = {n: p for n, p in probable.items() if n != read and p >= least * (1 + 1e-9)}
    certain = {
        other.label: other for other in found.others if probable[other.label] >= least * (1 + 1e-9)
    }
    assert certain.keys() == expected.keys()
    for other in certain.values():
        assert other.probability == pytest.approx(expected[other.label])
        best = max(p for (label, _), p in pairs.items() if label == other.label)
        assert pairs[other.label, other.vector] == pytest.approx(best)
        assert tuple(reading.value for reading in other.features.values()) == other.vector
    order = [other.probability for other in found.others]
    assert order == sorted(order, reverse=True)
    assert read not in {other.label for other in found.others}


# Answers ------------------------------------------------------------------------------------


def doubted(agent: Agent) -> Classification:
    """A structure that is taken for stable, and may be one that leans."""
    stable = seen(agent, "2", "wide", "no", "no")
    leaning = replace(seen(agent, "5", "narrow", "yes", "no"), probability=0.2)
    assert (stable.label, leaning.label) == ("stable", "unstable")
    return replace(stable, probability=0.8, otherwise=(leaning,))


@pytest.mark.parametrize(
    ("question", "text"),
    [
        (
            "why is it unstable?",
            "I took the structure to be stable. If it is unstable, as you say: the structure has "
            "five blocks and a narrow base, and it leans to one side.",
        ),
        (
            "why is it not stable?",
            "I took the structure to be stable. If it is not, as you say, it is unstable: the "
            "structure has five blocks and a narrow base, and it leans to one side.",
        ),
        (
            "what would make it stable?",
            "I took the structure to be stable. If it is not, as you say, it is unstable: to make "
            "the structure stable, give it a wide base and straighten it.",
        ),
        # What presumes nothing is answered as it is seen.
        ("is it unstable?", "Probably not: it seems that the structure is stable."),
        (
            "why is it stable?",
            "Probably because the structure has two blocks and a wide base, it is standing "
            "straight, and no block is displaced.",
        ),
        ("does it lean?", "No, the structure is standing straight."),
    ],
)
def test_who_asks_is_believed_where_it_may_be_so(
    reasoning: Agent, question: str, text: str
) -> None:
    scene = doubted(reasoning)
    reply = reasoning.answer(scene, reasoning.questions.understand(question))
    assert reply.text == text
    assert reply.label == "stable"
    assert reply.classification is scene
    believed = "as you say" in text
    assert (reply.supposed is scene.otherwise[0]) is believed
    assert reply.features is (scene.otherwise[0] if believed else scene).features
    assert reply.to_dict()["supposed"] == (
        {"class": "unstable", "probability": 0.2} if believed else None
    )
    # Many at once are answered alike, and nothing is supposed where nothing may be.
    asked = [(scene, reply.question), (replace(scene, otherwise=()), reply.question)]
    again, alone = reasoning.answer_all(asked)
    assert again == reply
    assert "as you say" not in alone.text


def test_what_cannot_be_is_denied(reasoning: Agent) -> None:
    scene = replace(doubted(reasoning), otherwise=())
    reply = reasoning.answer(scene, reasoning.questions.understand("why is it unstable?"))
    assert reply.text == (
        "The structure is probably not unstable but stable, since it has two blocks and a wide "
        "base, it is standing straight, and no block is displaced."
    )


def test_an_explanation_is_of_what_was_supposed(reasoning: Agent) -> None:
    before = reasoning.answer(
        doubted(reasoning), reasoning.questions.understand("why is it unstable?")
    )
    explain = reasoning.questions.understand("please explain this answer")
    reply = reasoning.answer(before.classification, explain, previous=before)
    assert reply.supposed is before.supposed
    assert reply.text.startswith(
        "You asked: why is the structure unstable? I took the structure to be stable; what follows "
        "supposes that it is unstable. I see that the structure has five blocks and a narrow base, "
        "and it leans to one side (each with a probability of at least 0.90)."
    )


def test_a_printed_reply_shows_what_was_supposed(
    reasoning: Agent, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = doubted(reasoning)
    (other,) = scene.otherwise
    leaning = FeatureReading("yes", 0.3, ("no", 0.7))
    other = replace(other, features={**other.features, "lean": leaning})
    scene = replace(scene, otherwise=(other,))
    print_reply(reasoning.answer(scene, reasoning.questions.understand("why is it unstable?")))
    out = capsys.readouterr().out
    assert "what is supposed overruled: lean read as no (p = 0.70), yes (0.30) is what fits" in out
    assert "supposed: unstable (0.20), as asked, instead of stable (0.80)" in out
    assert "lean yes" in out
    print_reply(reasoning.answer(scene, reasoning.questions.understand("why is it stable?")))
    assert "supposed" not in capsys.readouterr().out


# The agent ----------------------------------------------------------------------------------


@pytest.mark.parametrize("reading", ["argmax", "consistent"])
def test_what_the_tree_is_in_doubt_about_may_be_otherwise(
    agent: Agent, dataset: Dataset, reading: str
) -> None:
    """Round green tiles are left open; of the annotated ones half are bad now."""
    doubtful = Agent(agent.given, seed=3, reading=reading)
    vectors = list(dataset.vectors)
    labels = list(dataset.labels)
    open_ones = [n for n, vector in enumerate(vectors) if vector == ("green", "yes")]
    for n in open_ones[::3]:
        labels[n] = "bad" if labels[n] == "good" else "good"
    doubtful.fit_induction(vectors, labels)
    doubtful.extractor = agent.extractor
    picture = draw_tile("green", "yes", 1)
    scene = doubtful.classify(picture)
    assert (scene.method, scene.label) == ("tree", "good")
    (other,) = scene.otherwise
    assert (other.label, other.method, other.vector) == ("bad", "tree", scene.vector)
    assert other.probability == pytest.approx(
        doubtful.tree.probability(scene.vector)["bad"], abs=0.05
    )
    reply = doubtful.ask(picture, "why is it bad?")
    assert reply.text.startswith("I took the tile to be good. If it is bad, as you say: ")
    assert reply.kind.form == "reasons"
    never = Agent(agent.given, seed=3, reading=reading, trust=0.0)
    never.fit_induction(vectors, labels)
    never.extractor = agent.extractor
    assert never.classify(picture) == replace(scene, otherwise=())
    # Without answers that were learned there is nothing to say of it.
    doubtful.answerer = None
    assert doubtful.ask(picture, "why is it bad?").kind.form == "undecided"


def test_below_the_gate_the_tree_alone_is_in_doubt(agent: Agent, dataset: Dataset) -> None:
    """The knowledge, which decides blue tiles, is not asked about them."""
    gated = Agent(agent.given, seed=3, gate=1.0)
    vectors, labels = list(dataset.vectors), list(dataset.labels)
    blue = [n for n, vector in enumerate(vectors) if vector == ("blue", "no")]
    for n in blue[::3]:
        labels[n] = "good"
    gated.fit_induction(vectors, labels, uncertain=range(len(vectors)))
    gated.extractor = agent.extractor
    scene = gated.classify(draw_tile("blue", "no", 1))
    assert (scene.method, scene.verdict) == ("tree", "uncertain")
    shares = gated.tree.probability(scene.vector)
    assert {presumed.label: presumed.probability for presumed in scene.otherwise} == {
        label: share for label, share in shares.items() if label != scene.label and share >= 0.1
    }
    assert scene.otherwise
    for presumed in scene.otherwise:
        assert (presumed.method, presumed.verdict, presumed.vector) == (
            "tree",
            "uncertain",
            scene.vector,
        )


def test_an_evaluation_asks_whatever_the_class_is_and_is_not_believed(
    agent: Agent, dataset: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = evaluate(agent, dataset)
    classify = agent.classify_all

    def doubting(pictures: np.ndarray[Any, Any]) -> list[Classification]:
        found = classify(pictures)
        other = {scene.label: scene for scene in found}
        return [
            replace(scene, otherwise=tuple(o for label, o in other.items() if label != scene.label))
            for scene in found
        ]

    monkeypatch.setattr(agent, "classify_all", doubting)
    assert evaluate(agent, dataset) == before


@pytest.mark.parametrize("wrong", [1.0, -0.1, float("nan")])
def test_a_share_out_of_range(agent: Agent, wrong: float) -> None:
    with pytest.raises(DomainError, match="trust must be at least 0, below 1, got"):
        Agent(agent.given, trust=wrong)


def test_with_many_classes_little_suffices_for_who_names_one() -> None:
    """Of those who are wrong few would name this class, of 62; being denied it tells less."""
    agent = Agent(load_domain("traffic_signs"))
    assert agent.settings.believed_from(agent.domain) == pytest.approx(0.1 / (0.1 + 0.9 * 61))
    structures = load_domain("structure_stability")
    assert Agent(structures).settings.believed_from(structures) == pytest.approx(0.1)
    first, second, third = (replace(decided, probability=0.04) for decided in scenes_of(agent)[:3])
    scene = replace(first, probability=0.92, otherwise=(second, third))

    def supposed(question: str) -> Classification | None:
        return agent.answer(scene, agent.questions.understand(question)).supposed

    said = [agent.domain.classes[decided.label or ""].say for decided in (first, third)]
    assert supposed(f"why is it {said[1]}?") is third
    assert supposed(f"why is it not {said[0]}?") is None
    scene = replace(scene, otherwise=(replace(second, probability=0.06), third))
    assert supposed(f"why is it not {said[0]}?") is scene.otherwise[0]


def scenes_of(agent: Agent) -> list[Classification]:
    """Scenes of different classes that the knowledge decides."""
    vectors = decided_vectors(agent.reasoner, limit=1000) or ()
    found = {scene.label: scene for scene in (seen(agent, *vector) for vector in vectors)}
    return list(found.values())


# Nothing silently, however pictures are read --------------------------------------------------


class Seeing:
    """What networks would see of one picture."""

    size = 56

    def __init__(self, tables: dict[str, np.ndarray[Any, Any]], classes: Iterable[str]) -> None:
        self.tables = tables
        self.classes = frozenset(classes)

    def see(self, pictures: np.ndarray[Any, Any]) -> Seen:
        return Seen(self.probabilities(pictures), {})

    def probabilities(self, pictures: np.ndarray[Any, Any]) -> dict[str, np.ndarray[Any, Any]]:
        return {key: np.repeat(table, len(pictures), axis=0) for key, table in self.tables.items()}

    def shown(self, feature: str) -> frozenset[str]:
        return self.classes if feature == CLASS else frozenset()


@st.composite
def sights(draw: st.DrawFn, domain: Domain) -> dict[str, np.ndarray[Any, Any]]:
    """Random probabilities of features and class, near to sure as often as not."""
    found = {}
    values = {key: feature.values for key, feature in domain.features.items()}
    for key, names in {**values, CLASS: tuple(domain.classes)}.items():
        weights = np.array(
            draw(
                st.lists(
                    st.sampled_from([0.001, 0.05, 0.1, 0.5, 1.0, 3.0]),
                    min_size=len(names),
                    max_size=len(names),
                )
            )
        )
        weights[draw(st.integers(0, len(names) - 1))] *= draw(st.sampled_from([1.0, 10.0, 100.0]))
        found[key] = (weights / weights.sum())[None]
    return found


def class_probabilities(
    agent: Agent, sight: dict[str, np.ndarray[Any, Any]], rule: str
) -> dict[str, float]:
    """By going through all feature vectors."""
    found = dict.fromkeys(agent.domain.classes, 0.0)
    total = 0.0
    features = agent.domain.features
    opened = open_vectors(agent.reasoner, agent.experience)
    witness = sight[CLASS][0] / sight[CLASS].max()
    for places in np.ndindex(*(len(feature.values) for feature in features.values())):
        vector = tuple(
            feature.values[n] for feature, n in zip(features.values(), places, strict=True)
        )
        decided = agent.reasoner.decide(vector).label is not None
        if rule != "argmax" and not decided and vector not in opened:
            continue
        probability = float(
            np.prod([sight[key][0, n] for key, n in zip(features, places, strict=True)])
        )
        shares = agent.deciding.class_shares(vector)
        for n, label in enumerate(found):
            weight = witness[n] if rule == "with_class" else 1.0
            found[label] += probability * shares.get(label, 0.0) * weight
            total += probability * shares.get(label, 0.0) * weight
        total += 0.0 if shares else probability
    return {label: portion / total for label, portion in found.items()}


@pytest.fixture(scope="module")
def learned(tiles: Domain) -> Agent:
    """An agent that learned answers about green tiles, of which some are otherwise than most."""
    agent = Agent(tiles, seed=3)
    vectors = [*TRUTH] * 6
    labels = [TRUTH[vector] for vector in vectors]
    green = [n for n, vector in enumerate(vectors) if vector == ("green", "yes")]
    for n in green[:2]:
        labels[n] = "bad"
    agent.fit_induction(vectors, labels)
    return agent


@settings(max_examples=120)
@given(
    data=st.data(),
    rule=st.sampled_from(["argmax", "consistent", "with_class"]),
    trust=st.sampled_from([0.0, 0.5, 0.9, 0.99]),
)
def test_nothing_is_supposed_silently_however_pictures_are_read(
    structures: Domain, data: st.DataObject, rule: str, trust: float
) -> None:
    agent = Agent(structures, reading=rule, known_share=1.0, trust=trust)
    sight = data.draw(sights(structures))
    agent.extractor = Seeing(sight, structures.classes)  # type: ignore[assignment]
    (scene,) = agent.classify_all(np.zeros((1, 56, 56, 3), dtype=np.uint8))
    probable = class_probabilities(agent, sight, rule)
    question = data.draw(st.sampled_from(agent.questions.one_of_each()))
    reply = agent.answer(scene, question)
    # What the answer speaks of is what the picture is taken to be, or it says what it supposes.
    assert (reply.supposed is not None) == ("as you say" in reply.text)
    if scene.label is None:
        assert reply.supposed is None
        return
    presumed = reply.supposed
    if presumed is not None:
        assert reply.text.startswith("I took the structure to be ")
        assert f"to be {structures.classes[scene.label].say}." in reply.text
        assert presumed.label != scene.label
        assert presumed.probability == pytest.approx(probable[presumed.label or ""], abs=2e-3)
        assert (presumed.probability or 0.0) >= agent.settings.believed_from(agent.domain)
    assert scene.probability == pytest.approx(probable[scene.label], abs=2e-3)
    other = sum(probability for label, probability in probable.items() if label != scene.label)
    presumes_another = (question.asks is Asks.WHY_CLASS and question.label != scene.label) or (
        question.asks in (Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS, Asks.DIFFERENCE_TO_CLASS)
        and question.label == scene.label
    )
    if trust and presumes_another and abs(other - (1.0 - trust)) > 3e-3:
        assert (presumed is not None) == (other > 1.0 - trust)
    if not trust or not presumes_another:
        assert presumed is None
    # What is said flatly is at least as probable as what is said flatly has to be.
    if presumed is None and question.feature is None and question.asks is not Asks.EXPLAIN:
        if probable[scene.label] < SURE_FROM - 2e-3:
            assert reply.certainty is not Certainty.SURE
        if probable[scene.label] <= 0.05:
            assert reply.certainty is Certainty.PERHAPS
    for feature in reply.kind.mentions:
        if reply.features[feature].probability < SURE_FROM:
            assert reply.certainty is not Certainty.SURE
            assert reply.certainty is not None
            assert reply.certainty.adverb in reply.text.casefold()


@settings(max_examples=120)
@given(data=st.data(), rule=st.sampled_from(["argmax", "consistent", "with_class"]))
def test_what_a_tree_is_in_doubt_about_is_not_supposed_silently_either(
    learned: Agent, data: st.DataObject, rule: str
) -> None:
    agent = Agent(learned.given, seed=3, reading=rule, known_share=1.0)
    agent.tree, agent.answerer = learned.tree, learned.answerer
    agent.experience = learned.experience
    sight = data.draw(sights(agent.domain))
    agent.extractor = Seeing(sight, agent.domain.classes)  # type: ignore[assignment]
    (scene,) = agent.classify_all(np.zeros((1, 56, 56, 3), dtype=np.uint8))
    assert scene.label is not None
    probable = class_probabilities(agent, sight, rule)
    assert scene.probability == pytest.approx(probable[scene.label], abs=2e-3)
    (other,) = set(agent.domain.classes) - {scene.label}
    for words in (f"why is it {other}?", f"why is it not {scene.label}?"):
        reply = agent.answer(scene, agent.questions.understand(words))
        assert (reply.supposed is not None) == reply.text.startswith("I took the tile to be ")
        if probable[other] > agent.settings.believed_from(agent.domain) + 3e-3:
            assert reply.supposed is not None
        if reply.supposed is not None:
            assert (reply.supposed.probability or 0.0) >= agent.settings.believed_from(agent.domain)
        elif probable[scene.label] < SURE_FROM - 2e-3:
            assert reply.certainty is not Certainty.SURE
    plain = agent.answer(scene, agent.questions.understand(f"is it {other}?"))
    assert plain.supposed is None
    assert (plain.certainty is Certainty.SURE) <= (probable[scene.label] >= SURE_FROM - 2e-3)


@settings(max_examples=60)
@given(data=st.data())
def test_the_classes_of_a_picture_read_feature_by_feature(data: st.DataObject) -> None:
    """Against going through all vectors; shares of open ones count as the tree would say."""
    world = data.draw(worlds())
    sure = data.draw(distributions())
    least = data.draw(st.sampled_from([0.02, 0.1, 0.4, 1.0]))
    reasoner = Reasoner(world.knowledge, world.schema)
    names = list(world.schema.classes)

    def shares(vector: FeatureVector) -> dict[str, float]:
        label = reasoner.decide(vector).label
        if label is not None:
            return {label: 1.0}
        return {names[0]: 0.7, names[1]: 0.3} if vector[0] == "yes" else {}

    def label_of(vector: FeatureVector) -> str | None:
        by_class = shares(vector)
        return max(by_class, key=lambda name: by_class[name]) if by_class else None

    (alone,) = read_separately(world.schema, sure)
    (found,) = with_class_shares(
        [alone],
        world.schema,
        sure,
        shares_of_all=lambda vectors: [shares(vector) for vector in vectors],
        label_of=label_of,
        other_from=least,
    )
    pairs = {
        (name, vector): float(np.exp(logarithm(sure, vector))) * share
        for vector in SPACE
        for name, share in shares(vector).items()
    }
    probable = {
        name: sum(probability for (label, _), probability in pairs.items() if label == name)
        for name in names
    }
    read = label_of(alone.vector)
    assert (found.vector, found.features, found.score) == (
        alone.vector,
        alone.features,
        alone.score,
    )
    assert found.probability == pytest.approx(
        alone.probability if read is None else probable[read], abs=1.1e-3
    )
    expected = {n for n, p in probable.items() if n != read and p >= least + 2e-3 and least < 1.0}
    others = {other.label: other for other in found.others}
    assert expected <= others.keys() <= {n for n, p in probable.items() if p >= least - 1e-9}
    for other in found.others:
        assert other.probability == pytest.approx(probable[other.label], abs=1.1e-3)
        best = max(p for (label, _), p in pairs.items() if label == other.label)
        assert pairs[other.label, other.vector] == pytest.approx(best)
        for (key, reading), value in zip(other.features.items(), other.vector, strict=True):
            assert reading.value == value
            assert reading.probability == sure[key][0, VALUES[key].index(value or "")]
            assert (reading.overruled is None) == (reading.probability == sure[key].max())
    order = [other.probability for other in found.others]
    assert order == sorted(order, reverse=True)


def test_more_vectors_than_are_looked_at_make_no_class_more_probable() -> None:
    signs = load_domain("traffic_signs")
    agent = Agent(signs, reading="argmax", known_share=1.0)
    even = {
        key: np.full((1, len(feature.values)), 1 / len(feature.values))
        for key, feature in signs.features.items()
    }
    (reading,) = agent.reading_by.read(even, "argmax")
    assert reading.probability < 0.05
    assert sum(other.probability for other in reading.others) < 0.05
