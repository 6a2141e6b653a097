"""Reading pictures: alone or consistently, exactly, and with a gate on the networks' confidence."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from conftest import draw_tile, one_process, write_domain
from knowledge_builders import VALUES, Rule, World, worlds
from seewhy.agent.agent import Agent
from seewhy.agent.consistent_reading import ConsistentReading, open_vectors
from seewhy.agent.fitting_reading_weights import fit_reading_weights
from seewhy.agent.picture_reading import read_separately
from seewhy.agent.reading_weights import ReadingWeights
from seewhy.agent.trace import trace_of
from seewhy.cli.ask import print_reply
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reply import FeatureReading
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.tables import CLASS
from seewhy.errors import DomainError, ModelError, NotFittedError
from seewhy.knowledge.candidates import decided_vectors, most_probable_decided
from seewhy.knowledge.justification import Basis
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.extractor import Seen
from seewhy.report.card import draw_card

SPACE: list[FeatureVector] = list(product(*VALUES.values()))
many = settings(max_examples=60)


@st.composite
def distributions(draw: st.DrawFn) -> dict[str, np.ndarray[Any, Any]]:
    """The networks' probabilities for one picture of a random world; zeros and ties included."""
    found = {}
    for key, values in VALUES.items():
        weights = draw(
            st.lists(st.integers(0, 5), min_size=len(values), max_size=len(values)).filter(any)
        )
        found[key] = np.array([weights], dtype=float) / sum(weights)
    return found


def logarithm(sure: dict[str, np.ndarray[Any, Any]], vector: FeatureVector) -> float:
    """The log-probability of a vector, one feature after another."""
    return sum(
        float(np.log(max(sure[key][0, VALUES[key].index(value or "")], 1e-300)))
        for key, value in zip(VALUES, vector, strict=True)
    )


def reader_of(world: World, opened: list[FeatureVector], **options: int) -> ConsistentReading:
    reasoner = Reasoner(world.knowledge, world.schema)
    return ConsistentReading(
        reasoner, opened, label_of=lambda vector: reasoner.decide(vector).label, **options
    )


# Several answer sets: the knowledge decides less than one of them believes.
CHOICE = World(
    (
        Rule("p(S)", ("f(S)",)),
        Rule("q(S)", ("not r(S)",)),
        Rule("r(S)", ("not q(S)",)),
        Rule("-p(S)", ("-f(S)", "not -q(S)"), default=True),
    ),
    "three",
)
NOTHING = World((Rule("q(S)", ("f(S)",)),), "two")
EVEN = {key: np.full((1, len(values)), 1 / len(values)) for key, values in VALUES.items()}


# Candidates ---------------------------------------------------------------------------------


@many
@given(world=worlds())
@example(world=CHOICE)
def test_the_decided_vectors_are_those_of_the_book(world: World) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    expected = tuple(vector for vector in SPACE if world.decision(vector)[0] is not None)
    assert decided_vectors(reasoner, limit=len(SPACE)) == expected


def test_too_many_vectors_are_not_listed(structures: Domain) -> None:
    reasoner = Reasoner(structures.knowledge, structures.schema)
    assert len(decided_vectors(reasoner, limit=30) or ()) == 30
    assert decided_vectors(reasoner, limit=29) is None


# Exactness ----------------------------------------------------------------------------------


@many
@given(
    world=worlds(),
    sure=distributions(),
    opened=st.lists(st.sampled_from(SPACE), max_size=2),
    listed=st.sampled_from([1000, -1]),
    tried=st.sampled_from([0, 3, 1000]),
)
@example(world=CHOICE, sure=EVEN, opened=[], listed=1000, tried=0)
@example(world=CHOICE, sure=EVEN, opened=[], listed=-1, tried=0)
@example(world=CHOICE, sure=EVEN, opened=[("no", "light", "3")], listed=-1, tried=0)
@example(world=NOTHING, sure=EVEN, opened=[], listed=-1, tried=0)
def test_the_reading_is_the_most_probable_of_all_candidates(
    world: World,
    sure: dict[str, np.ndarray[Any, Any]],
    opened: list[FeatureVector],
    listed: int,
    tried: int,
) -> None:
    """Listed, tried in falling order or optimised: the same as trying everything."""
    candidates = [v for v in SPACE if world.decision(v)[0] is not None or v in opened]
    (found,) = reader_of(world, opened, listed=listed, tried=tried).read(sure)
    if not candidates:
        (alone,) = read_separately(world.schema, sure)
        assert found.vector == alone.vector
        assert logarithm(sure, found.vector) == pytest.approx(
            max(logarithm(sure, vector) for vector in SPACE)
        )
        return
    assert found.vector in candidates
    best = max(logarithm(sure, vector) for vector in candidates)
    assert logarithm(sure, found.vector) == pytest.approx(best, abs=1e-5)
    assert found.score == pytest.approx(best, abs=1e-5)
    if listed == -1:
        return
    joint = np.array([np.exp(logarithm(sure, vector)) for vector in candidates])
    if joint.sum() > 0:
        label = world.decision(found.vector)[0]
        same = [world.decision(vector)[0] == label for vector in candidates]
        assert found.probability == pytest.approx(joint[same].sum() / joint.sum())


@many
@given(world=worlds(), sure=distributions(), above=st.floats(-20, 0))
def test_what_is_not_above_is_not_searched(
    world: World, sure: dict[str, np.ndarray[Any, Any]], above: float
) -> None:
    reasoner = Reasoner(world.knowledge, world.schema)
    logarithms = [np.log(np.maximum(table[0], 1e-300)) for table in sure.values()]
    best = most_probable_decided(reasoner, logarithms)
    for tried in (0, 100):
        found = most_probable_decided(reasoner, logarithms, above=above, tried=tried)
        assert (found is None) == (best is None or best[1] <= above)


def test_a_batch_is_read_like_single_pictures(tiles: Domain) -> None:
    generator = np.random.default_rng(0)
    sure = {
        key: generator.dirichlet(np.ones(len(feature.values)), size=50)
        for key, feature in tiles.features.items()
    }
    reasoner = Reasoner(tiles.knowledge, tiles.schema)
    reader = ConsistentReading(
        reasoner, [("green", "yes")], label_of=lambda vector: reasoner.decide(vector).label
    )
    whole = reader.read(sure)
    for n, reading in enumerate(whole):
        (single,) = reader.read({key: table[n : n + 1] for key, table in sure.items()})
        assert (single.vector, single.features) == (reading.vector, reading.features)
        assert (single.score, single.probability) == pytest.approx(
            (reading.score, reading.probability)
        )
    assert reader.read({key: table[:0] for key, table in sure.items()}) == []


def test_which_annotated_vectors_are_open(tiles: Domain) -> None:
    """Decided vectors and those of a contradiction are none."""
    reasoner = Reasoner(tiles.knowledge, tiles.schema)
    assert open_vectors(reasoner, {("green", "yes"): 1, ("red", "no"): 2, ("green", None): 1}) == [
        ("green", "yes"),
        ("green", None),
    ]
    # An annotated vector with an unknown value is nothing that could be read.
    reader = ConsistentReading(reasoner, [("green", None)], label_of=lambda _: None)
    (reading,) = reader.read(
        {"colour": np.array([[0.1, 0.8, 0.1]]), "round": np.array([[0.5, 0.5]])}
    )
    assert reading.vector[0] != "green"


def test_contradictory_vectors_are_never_read(tmp_path: Path) -> None:
    knowledge = (write_domain(tmp_path / "tiles") / "knowledge.al").read_text()
    domain = load_domain(
        write_domain(tmp_path / "tiles", knowledge=knowledge + "-good(T) if round(T).\n")
    )
    reasoner = Reasoner(domain.knowledge, domain.schema)
    assert reasoner.decide(("red", "yes")).verdict.value == "contradiction"
    experience = {("red", "yes"): 1, ("green", "no"): 1}
    assert open_vectors(reasoner, experience) == [("green", "no")]


# The agent ----------------------------------------------------------------------------------


class Networks:
    """Gives the probabilities that it is told, one row a picture."""

    size = 16

    def __init__(
        self,
        colour: list[float],
        is_round: list[float],
        classes: list[float] | None = None,
        witnessed: Sequence[str] = ("good", "bad"),
    ) -> None:
        self.witnessed = frozenset(witnessed if classes is not None else ())
        self.rows = {"colour": np.array([colour]), "round": np.array([is_round])}
        if classes is not None:
            self.rows[CLASS] = np.array([classes])

    def see(self, pictures: np.ndarray[Any, Any]) -> Seen:
        return Seen(self.probabilities(pictures), {})

    def probabilities(self, pictures: np.ndarray[Any, Any]) -> dict[str, np.ndarray[Any, Any]]:
        return {key: row.repeat(len(pictures), axis=0) for key, row in self.rows.items()}

    def shown(self, name: str) -> frozenset[str]:
        return self.witnessed if name == CLASS else frozenset()


def agent_seeing(
    domain: Domain,
    colour: list[float],
    is_round: list[float],
    classes: list[float] | None = None,
    *,
    witnessed: Sequence[str] = ("good", "bad"),
    **options: Any,
) -> Agent:
    agent = Agent(domain, **options)
    agent.fit_induction(
        [("red", "yes"), ("green", "yes"), ("green", "no")], ["good", "good", "bad"]
    )
    agent.extractor = Networks(colour, is_round, classes, witnessed)  # type: ignore[assignment]
    return agent


@pytest.fixture(scope="module")
def certain_reds(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    """Tiles of which the knowledge leaves open all that are blue and round."""
    return load_domain(write_domain(tmp_path_factory.mktemp("reds") / "tiles"))


BLUE_AND_ROUND = ([0.3, 0.15, 0.55], [0.6, 0.4])
"""Blue and round is the most probable, but nobody has ever seen it: blue with corners fits."""


def test_the_knowledge_overrules_what_the_network_alone_saw(certain_reds: Domain) -> None:
    agent = agent_seeing(certain_reds, *BLUE_AND_ROUND, reading="consistent")
    scene = agent.classify(draw_tile("blue", "no", 0))
    assert scene.vector == ("blue", "no")
    assert scene.features["colour"] == FeatureReading("blue", 0.55)
    assert scene.features["round"] == FeatureReading("no", 0.4, ("yes", 0.6))
    assert (scene.label, scene.method, scene.verdict) == ("bad", "knowledge", "believed")
    # By hand: red 0.3, green 0.15 (as annotated; the tree says good and bad), blue cornered 0.22.
    assert scene.score == pytest.approx(np.log(0.55 * 0.4))
    assert scene.probability == pytest.approx((0.22 + 0.15 * 0.4) / (0.3 + 0.15 + 0.22))


def test_argmax_reads_what_the_paper_reads(certain_reds: Domain) -> None:
    agent = agent_seeing(certain_reds, *BLUE_AND_ROUND)
    scene = agent.classify(draw_tile("blue", "no", 0))
    assert scene.vector == ("blue", "yes")
    assert [reading.overruled for reading in scene.features.values()] == [None, None]
    assert (scene.method, scene.verdict) == ("tree", "silent")
    # By hand: red, and by the tree green and round, blue and round.
    assert scene.probability == pytest.approx(0.3 + 0.15 * 0.6 + 0.55 * 0.6)
    # Bad are blue with corners, by the knowledge, and green with corners, by the tree.
    (other,) = scene.otherwise
    assert (other.label, other.vector, other.method) == ("bad", ("blue", "no"), "knowledge")
    assert other.probability == pytest.approx(0.55 * 0.4 + 0.15 * 0.4)
    assert scene.score == pytest.approx(np.log(0.55 * 0.6))


def test_a_reply_says_what_was_overruled(
    certain_reds: Domain, capsys: pytest.CaptureFixture[str]
) -> None:
    agent = agent_seeing(certain_reds, *BLUE_AND_ROUND, reading="consistent")
    picture = draw_tile("blue", "no", 0)
    reply = agent.ask(picture, "why is it bad?")
    print_reply(reply)
    assert capsys.readouterr().out == (
        "Perhaps because the tile is blue, and it has corners.\n"
        "\n"
        "asked: why is the tile bad?\n"
        "seen: colour blue (0.55), round no (0.40)\n"
        "the knowledge overruled: round read as yes (p = 0.60), no (0.40) is what fits\n"
        "not sure: round no (0.40)\n"
        "by: knowledge\n"
        "because:\n"
        '  the tile is bad: "a blue tile with corners is bad" (knowledge.al:11)\n'
        "  ├─ the tile is blue (p = 0.55)\n"
        "  └─ the tile has corners (p = 0.40; the network alone saw yes, p = 0.60)\n"
    )
    record = json.loads(json.dumps(reply.to_dict()))
    assert record["features"] == {
        "colour": {"value": "blue", "probability": 0.55, "overruled": None},
        "round": {
            "value": "no",
            "probability": 0.4,
            "overruled": {"value": "yes", "probability": 0.6},
        },
    }
    assert record["class_probability"] == 0.4179
    leaf = record["justification"]["children"][1]
    assert leaf["overruled"] == {"value": "yes", "probability": 0.6}
    assert "the network alone saw yes (p = 0.60)" in draw_card(reply, picture).svg


def test_the_domain_says_how_it_is_read(tmp_path: Path, tiles: Domain) -> None:
    assert (tiles.reading, Agent(tiles).reading) == (None, "argmax")
    assert Agent(tiles, eyes="efficientnet-lite0").reading == "with_class"
    folder = write_domain(tmp_path / "tiles")
    path = folder / "domain.toml"
    text = path.read_text()
    path.write_text(text.replace("[domain]\n", '[domain]\nreading = "consistent"\n'))
    domain = load_domain(folder)
    assert Agent(domain).reading == "consistent"
    assert Agent(domain, reading="argmax").reading == "argmax"
    path.write_text(text.replace("[domain]\n", '[domain]\nreading = "best"\n'))
    with pytest.raises(DomainError) as problem:
        load_domain(folder)
    assert str(problem.value) == (
        f"{path}:2: 'domain.reading': input should be 'argmax', 'consistent' or 'with_class', got "
        "'best'"
    )


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"reading": "consitent"}, "'consitent' is no way to read features; did you mean "
         "'consistent'?"),
        ({"gate": 1.5}, "gate must be 0 to 1, got 1.5"),
        ({"gate": -0.1}, "gate must be 0 to 1, got -0.1"),
        ({"known_share": 0.0}, "known_share must be above 0, at most 1, got 0.0"),
        ({"known_share": 1.1}, "known_share must be above 0, at most 1, got 1.1"),
    ],
)  # fmt: skip
def test_options_that_are_none(tiles: Domain, options: dict[str, Any], said: str) -> None:
    with pytest.raises(DomainError) as problem:
        Agent(tiles, **options)
    assert str(problem.value) == said


# With a network of the class ------------------------------------------------------------------


@many
@given(
    world=worlds(),
    sure=distributions(),
    weights=st.lists(st.integers(0, 5), min_size=3, max_size=3).filter(any),
    shown=st.sets(st.integers(0, 2)),
    opened=st.lists(st.sampled_from(SPACE), max_size=2),
    listed=st.sampled_from([1000, -1]),
    tried=st.sampled_from([0, 3, 1000]),
)
@example(world=CHOICE, sure=EVEN, weights=[0, 1, 5], shown={0, 1, 2}, opened=[], listed=-1, tried=0)
def test_the_class_that_is_seen_is_one_more_witness(
    world: World,
    sure: dict[str, np.ndarray[Any, Any]],
    weights: list[int],
    shown: set[int],
    opened: list[FeatureVector],
    listed: int,
    tried: int,
) -> None:
    """A vector counts as its features do, times its class; a class never shown is not judged."""
    names = list(world.schema.classes)
    chances = np.array([weights[: len(names)]], dtype=float) + 1e-3
    chances /= chances.sum()
    witnessed = [name for n, name in enumerate(names) if n in shown]
    reasoner = Reasoner(world.knowledge, world.schema)
    reader = ConsistentReading(
        reasoner,
        opened,
        label_of=lambda vector: reasoner.decide(vector).label,
        witnessed=witnessed,
        listed=listed,
        tried=tried,
    )
    (found,) = reader.read({**sure, CLASS: chances})

    def score(vector: FeatureVector) -> float:
        label = world.decision(vector)[0]
        if label not in witnessed:
            return logarithm(sure, vector)
        chance = chances[0, names.index(label or "")] / chances.max()
        return logarithm(sure, vector) + float(np.log(chance))

    candidates = [v for v in SPACE if world.decision(v)[0] is not None or v in opened]
    if not candidates:
        assert logarithm(sure, found.vector) == pytest.approx(
            max(logarithm(sure, vector) for vector in SPACE)
        )
        return
    assert found.vector in candidates
    assert score(found.vector) == pytest.approx(max(map(score, candidates)), abs=1e-5)
    assert found.score == pytest.approx(logarithm(sure, found.vector), abs=1e-5)
    if witnessed:
        assert found.class_seen == (names[int(chances.argmax())], float(chances.max()))
    else:
        assert found.class_seen is None


GOOD_SEEN = [0.99, 0.01]


def test_a_witness_changes_what_is_read(certain_reds: Domain) -> None:
    """Red and round, good, is less probable than blue with corners, bad, but good is seen."""
    sure = ([0.3, 0.1, 0.6], [0.6, 0.4])
    alone = agent_seeing(certain_reds, *sure, reading="consistent")
    with_class = agent_seeing(certain_reds, *sure, GOOD_SEEN, reading="with_class")
    picture = draw_tile("red", "yes", 0)
    assert alone.classify(picture).vector == ("blue", "no")
    scene = with_class.classify(picture)
    assert (scene.vector, scene.label) == (("red", "yes"), "good")
    assert scene.class_seen == ("good", 0.99)
    # By hand, every candidate times its class: green and round is good by the tree, without bad.
    good, bad = 0.99 * (0.3 * 0.6 + 0.1 * 0.6), 0.01 * (0.3 * 0.4 + 0.1 * 0.4 + 0.6 * 0.4)
    assert scene.probability is not None
    assert scene.probability > good / (good + bad) - 0.02
    assert scene.score == pytest.approx(np.log(0.3 * 0.6))


def test_a_reply_says_what_the_witness_saw(
    certain_reds: Domain, capsys: pytest.CaptureFixture[str]
) -> None:
    sure = ([0.3, 0.1, 0.6], [0.6, 0.4])
    agent = agent_seeing(certain_reds, *sure, GOOD_SEEN, reading="with_class")
    picture = draw_tile("red", "yes", 0)
    reply = agent.ask(picture, "why is it good?")
    print_reply(reply)
    assert capsys.readouterr().out == (
        "Perhaps because the tile is red.\n"
        "\n"
        "asked: why is the tile good?\n"
        "seen: colour red (0.30), round yes (0.60), class good (0.99)\n"
        "the knowledge and the class seen overruled: colour read as blue (p = 0.60), "
        "red (0.30) is what fits\n"
        "not sure: colour red (0.30)\n"
        "by: knowledge\n"
        "because:\n"
        '  the tile is good: "a red tile is good" (knowledge.al:8)\n'
        "  └─ the tile is red (p = 0.30; the network alone saw blue, p = 0.60)\n"
    )
    assert reply.to_dict()["class_seen"] == {"class": "good", "probability": 0.99}
    assert "class: good (p = 0.99), a witness to the features" in draw_card(reply, picture).svg


@pytest.fixture(scope="module")
def agent_with_class(tiles: Domain, dataset: Dataset) -> Agent:
    with one_process():
        return Agent(tiles, seed=3, reading="with_class").fit(dataset)


def test_the_network_of_the_class_is_trained_and_kept(
    agent_with_class: Agent, agent: Agent, dataset: Dataset, tmp_path: Path
) -> None:
    assert agent_with_class.extractor is not None
    assert agent.extractor is not None
    assert list(agent_with_class.extractor.networks) == ["colour", "round", "class"]
    assert agent_with_class.extractor.values["class"] == ("good", "bad")
    pictures = dataset.pictures(16)
    with_class, plain = (
        each.extractor.probabilities(pictures) for each in (agent_with_class, agent)
    )
    assert all(np.array_equal(with_class[key], plain[key]) for key in plain)
    agent_with_class.save(tmp_path / "model")
    loaded = Agent.load(tmp_path / "model")
    assert loaded.extractor is not None
    assert loaded.extractor.shown("class") == {"good", "bad"}
    assert agent.extractor.shown("class") == frozenset()
    assert loaded.classify_all(pictures) == agent_with_class.classify_all(pictures)
    # The witness can be left out afterwards, but not called where there is none.
    without = Agent.load(tmp_path / "model", reading="argmax")
    assert without.classify_all(pictures) == agent.classify_all(pictures)


def test_a_model_without_a_witness_cannot_call_one(model_folder: Path) -> None:
    with pytest.raises(ModelError) as problem:
        Agent.load(model_folder, reading="with_class")
    assert str(problem.value) == (
        f"{model_folder}: the model has no network of the class; train it with --reading "
        "with_class, or read its pictures in another way"
    )


def test_a_class_left_out_is_not_voted_down(tiles: Domain) -> None:
    """The network of the class never saw it; what it says is held against no vector of it."""
    seen = ([0.9, 0.05, 0.05], [0.9, 0.1], [0.001, 0.999])
    both = agent_seeing(tiles, *seen, reading="with_class")
    agent = agent_seeing(tiles, *seen, witnessed=["bad"], reading="with_class")
    picture = draw_tile("red", "yes", 0)
    assert both.classify(picture).label == "bad"
    # Experience, which scenes of both classes are part of, does not change what the network saw.
    for _ in range(2):
        scene = agent.classify(picture)
        assert (scene.vector, scene.label) == (("red", "yes"), "good")
        agent.fit_induction([("red", "yes"), ("green", "no")], ["good", "bad"])


def test_a_witness_that_is_not_there_cannot_be_called(tiles: Domain) -> None:
    agent = agent_seeing(tiles, [0.9, 0.05, 0.05], [0.9, 0.1])
    agent.reading = "with_class"
    with pytest.raises(NotFittedError) as problem:
        agent.classify(draw_tile("red", "yes", 0))
    assert str(problem.value) == (
        "pictures are to be read with the class, but no network sees it; train with "
        "reading='with_class', or read in another way"
    )


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("class", "other networks than a feature's are"),
        ("together", "other networks than a feature's are"),
        ("reasons", "another column of scenes.csv is"),
        ("group", "another column of scenes.csv is"),
    ],
)
def test_names_of_other_things_are_no_features(tmp_path: Path, name: str, what: str) -> None:
    folder = write_domain(tmp_path / "tiles")
    for file in ("domain.toml", "knowledge.al", "questions.toml"):
        text = (folder / file).read_text()
        (folder / file).write_text(text.replace("round", name))
    with pytest.raises(DomainError) as problem:
        load_domain(folder)
    assert str(problem.value).endswith(
        f": '{name}' is what {what} called; call the feature otherwise"
    )


# The gate -----------------------------------------------------------------------------------

RED_AND_ROUND = ([0.7, 0.2, 0.1], [0.95, 0.05])


@pytest.mark.parametrize(
    ("gate", "decided"),
    [(None, ("good", "knowledge", "believed")), (0.0, ("good", "knowledge", "believed")),
     (0.7, ("good", "knowledge", "believed")), (0.71, ("good", "tree", "uncertain"))],
)  # fmt: skip
def test_an_uncertain_scene_is_sent_to_the_tree(
    tiles: Domain, gate: float | None, decided: tuple[str, str, str]
) -> None:
    scene = agent_seeing(tiles, *RED_AND_ROUND, gate=gate).classify(draw_tile("red", "yes", 0))
    assert (scene.label, scene.method, scene.verdict) == decided
    assert scene.vector == ("red", "yes")
    assert (scene.probability is None) == (decided[1] == "tree")


def test_the_gate_asks_what_the_network_alone_saw(certain_reds: Domain) -> None:
    """What was overruled has a low probability of its own; the network was sure all the same."""
    sure = ([0.02, 0.02, 0.96], [0.97, 0.03])
    agent = agent_seeing(certain_reds, *sure, reading="consistent", gate=0.9)
    scene = agent.classify(draw_tile("blue", "yes", 0))
    assert scene.features["round"] == FeatureReading("no", 0.03, ("yes", 0.97))
    assert (scene.method, scene.verdict) == ("knowledge", "believed")


def test_a_reply_says_why_the_knowledge_was_not_asked(tiles: Domain) -> None:
    agent = agent_seeing(tiles, *RED_AND_ROUND, gate=0.9)
    reply = agent.ask(draw_tile("red", "yes", 0), "is it good?")
    assert (reply.text, reply.method) == ("Yes, the tile is good.", "tree")
    assert reply.justification.basis is Basis.TREE
    assert reply.justification.children[-1].text == (
        "the knowledge is not asked: the colour is seen with a probability of 0.70 only, and "
        "0.90 is demanded"
    )
    told = agent.ask(draw_tile("red", "yes", 0), "please explain this answer").text
    assert "The knowledge is not asked: the colour is seen with" in told


def test_without_a_tree_the_knowledge_is_asked(tiles: Domain) -> None:
    agent = Agent(tiles, gate=0.9).fit_induction([("red", "yes"), ("red", "no")], ["good", "good"])
    agent.extractor = Networks(*RED_AND_ROUND)  # type: ignore[assignment]
    scene = agent.classify(draw_tile("red", "yes", 0))
    assert (scene.label, scene.method) == ("good", "knowledge")


@pytest.mark.usefixtures("in_one_process")
def test_uncertain_training_scenes_train_the_tree(agent: Agent, dataset: Dataset) -> None:
    """With a gate of 1 no network is ever sure enough: all scenes train the tree."""
    again = Agent(agent.domain, seed=3, gate=1.0).fit(dataset, start_from=agent)
    assert sum(path.support for path in again.tree.paths()) == 40
    assert sum(path.support for path in agent.tree.paths()) == 22
    assert {scene.method for scene in again.classify_all(dataset.pictures(16))} == {"tree"}


# On disk ------------------------------------------------------------------------------------


def test_the_model_remembers_how_it_reads(agent: Agent, tmp_path: Path) -> None:
    other = Agent(agent.domain, seed=3, reading="consistent", gate=0.6, known_share=0.9)
    other.extractor, other.tree, other.answerer = agent.extractor, agent.tree, agent.answerer
    other.experience = agent.experience
    other.save(tmp_path / "model")
    loaded = Agent.load(tmp_path / "model")
    assert (loaded.reading, loaded.gate, loaded.known_share) == ("consistent", 0.6, 0.9)
    loaded = Agent.load(tmp_path / "model", reading="argmax", gate=0, known_share=1.0)
    assert (loaded.reading, loaded.gate, loaded.known_share) == ("argmax", None, 1.0)
    with pytest.raises(DomainError, match="gate must be 0 to 1, got 2"):
        Agent.load(tmp_path / "model", gate=2)


# What the knowledge leaves open, and the tree doubts ---------------------------------------------

GREEN_AND_ROUND = ([0.05, 0.9, 0.05], [0.9, 0.1])


def agent_in_doubt(domain: Domain, classes: list[float], weights: ReadingWeights | None) -> Agent:
    """Two of three green disks were good, which is all that the tree knows of them."""
    agent = agent_seeing(domain, *GREEN_AND_ROUND, classes, reading="with_class")
    vectors: list[FeatureVector] = [("green", "yes")] * 9
    agent.fit_induction([*vectors, ("red", "yes")], ["good", "good", "bad"] * 3 + ["good"])
    agent.reading_weights = {} if weights is None else {"with_class": weights}
    return agent


@pytest.mark.parametrize(
    ("classes", "weights", "label"),
    [
        ([0.3, 0.7], ReadingWeights(1.0, 1.0), "bad"),  # 0.67 · 0.3 against 0.33 · 0.7
        ([0.4, 0.6], ReadingWeights(1.0, 1.0), "good"),  # 0.67 · 0.4 against 0.33 · 0.6
        ([0.3, 0.7], ReadingWeights(1.0, 0.5), "good"),  # the witness counts half
        ([0.3, 0.7], ReadingWeights(1.0, 0.0), "good"),
        ([0.3, 0.7], None, "good"),  # nobody weighed the witness
    ],
)
def test_a_weighed_witness_may_outweigh_the_tree(
    certain_reds: Domain, classes: list[float], weights: ReadingWeights | None, label: str
) -> None:
    agent = agent_in_doubt(certain_reds, classes, weights)
    scene = agent.classify(draw_tile("green", "yes", 0))
    assert (scene.vector, scene.label, scene.method) == (("green", "yes"), label, "tree")


def test_an_answer_says_that_the_witness_outweighs_the_tree(certain_reds: Domain) -> None:
    agent = agent_in_doubt(certain_reds, [0.1, 0.9], ReadingWeights(1.0, 1.0))
    picture = draw_tile("green", "yes", 0)
    reply = agent.ask(picture, "why is it bad?")
    assert "the class seen by itself, bad (p = 0.90), outweighs the tree" in (
        reply.justification.to_text()
    )
    scene = agent.classify(picture)
    assert scene.probability == pytest.approx(0.9 / 3 / (0.9 / 3 + 0.1 * 2 / 3), abs=0.02)
    assert "outweighed by the class seen by itself: bad (p = 0.90)" in (
        trace_of(agent, scene).to_text()
    )


# How much the witness counts, found out by pictures that taught nobody ---------------------------


def kept_out(*, witness_right: float, features_right: float) -> tuple[dict[str, Any], list[str]]:
    """Two hundred red or blue tiles with corners, as seen by features and by a witness."""
    generator = np.random.default_rng(3)
    labels = ["good" if number % 2 else "bad" for number in range(200)]
    good = np.array([label == "good" for label in labels])

    def told(right: float) -> np.ndarray[Any, Any]:
        said = np.where(generator.random(200) < right, good, ~good)
        return np.where(said, 0.95, 0.05)

    red, witness = told(features_right), told(witness_right)
    return {
        "colour": np.stack([red, np.full(200, 0.0), 1.0 - red], axis=1),
        "round": np.tile([0.02, 0.98], (200, 1)),
        CLASS: np.stack([witness, 1.0 - witness], axis=1),
    }, labels


@pytest.mark.parametrize(
    ("witness_right", "features_right", "asked"),
    [(0.5, 0.95, False), (0.95, 0.5, True), (0.95, 0.95, True)],
)
def test_a_witness_counts_as_much_as_it_is_right(
    certain_reds: Domain, witness_right: float, features_right: float, asked: bool
) -> None:
    reasoner = Reasoner(certain_reds.knowledge, certain_reds.schema)
    reader = ConsistentReading(
        reasoner,
        (),
        label_of=lambda vector: reasoner.decide(vector).label,
        witnessed=("good", "bad"),
    )
    probabilities, labels = kept_out(witness_right=witness_right, features_right=features_right)
    weights = fit_reading_weights(reader, probabilities, labels)
    assert (weights.witness > 0.2) == asked

    def loss(weighed: ReadingWeights) -> float:
        classes = reader.weighing(weighed).class_probabilities(probabilities)
        assert classes is not None
        true = [("good", "bad").index(label) for label in labels]
        return float(-np.log(np.maximum(classes[np.arange(200), true], 1e-3)).mean())

    assert loss(weights) <= loss(ReadingWeights()) + 1e-9
    assert loss(weights) <= loss(ReadingWeights(1.0, 0.0)) + 1e-9


def test_too_few_pictures_weigh_nothing(certain_reds: Domain) -> None:
    reasoner = Reasoner(certain_reds.knowledge, certain_reds.schema)
    reader = ConsistentReading(reasoner, (), label_of=lambda _: None)
    probabilities, labels = kept_out(witness_right=0.5, features_right=0.5)
    unknown = [None] * 195 + labels[:5]
    assert fit_reading_weights(reader, probabilities, unknown) == ReadingWeights()
