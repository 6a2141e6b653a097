"""Saying "I don't know": the threshold, the pictures that are refused, and what is answered."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from conftest import DOMAIN, QUESTIONS, one_process, seen, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.cli.main import main
from seewhy.cli.train import print_refusal
from seewhy.data.dataset import Dataset
from seewhy.dialogue.reply import Classification
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DomainError
from seewhy.evaluation import evaluate
from seewhy.perception.conformal_threshold import refusal_threshold
from seewhy.perception.extractor import Seen
from seewhy.perception.familiarity import Familiarity, Known


@given(
    scores=st.lists(st.floats(0, 1), min_size=2, max_size=60),
    known_share=st.sampled_from([0.5, 0.75, 0.9, 0.95, 0.99, 1.0]),
)
def test_the_share_is_kept(scores: list[float], known_share: float) -> None:
    """Of pictures that are all alike, any may be the new one: the share is kept on average."""
    refused = 0
    for n, score in enumerate(scores):
        threshold = refusal_threshold(scores[:n] + scores[n + 1 :], known_share=known_share)
        refused += threshold is not None and score < threshold
    assert refused <= (1 - known_share) * len(scores) + 1e-6


@pytest.mark.parametrize(
    ("known_share", "enough"), [(0.5, 1), (0.9, 9), (0.95, 19), (0.99, 99), (0.995, 199)]
)
def test_how_many_pictures_are_enough(known_share: float, enough: int) -> None:
    scores = [1 - n / 1000 for n in range(enough)]
    assert refusal_threshold(scores, known_share=known_share) == min(scores)
    assert refusal_threshold(scores[1:], known_share=known_share) is None
    assert refusal_threshold(scores, known_share=1.0) is None


# Trained ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def wary(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    """Tiles of which 90 % are to be answered."""
    text = DOMAIN.replace("[domain]\n", '[domain]\nknown_share = 0.9\nreading = "consistent"\n')
    return load_domain(write_domain(tmp_path_factory.mktemp("wary") / "tiles", domain=text))


@pytest.fixture(scope="module")
def many(wary: Domain, tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    """Tiles of which those for testing are drawn: every third is unlike the others."""
    folder = write_tiles(tmp_path_factory.mktemp("many") / "tiles", count=180)
    scenes = Dataset.load(folder, wary)
    tested = set(np.random.default_rng(0).permutation(180)[:60].tolist())
    splits = [
        replace(scene, split="test" if n in tested else "train")
        for n, scene in enumerate(scenes.scenes)
    ]
    return replace(scenes, scenes=tuple(splits))


@pytest.fixture(scope="module")
def wary_agent(wary: Domain, many: Dataset) -> Agent:
    with one_process():
        return Agent(wary, seed=1).fit(many)


def noise(count: int) -> np.ndarray[Any, Any]:
    return np.random.default_rng(0).integers(0, 256, size=(count, 16, 16, 3), dtype=np.uint8)


def test_the_threshold_is_that_of_the_validation_pictures(wary_agent: Agent) -> None:
    assert wary_agent.extractor is not None
    records = wary_agent.extractor.records
    assert {record.validation_pictures for record in records.values()} == {18}
    for scores in wary_agent.validation_scores.values():
        assert len(scores) == 18
        assert all(0 < score < 1 for score in scores)
    assert wary_agent.unknown_below == min(wary_agent.validation_scores["consistent"])


def test_no_validation_picture_is_among_those_compared_with(
    wary_agent: Agent, many: Dataset
) -> None:
    """Where they are, a picture is like itself and the threshold is 1."""
    assert wary_agent.familiarity is not None
    assert wary_agent.extractor is not None
    for key, known in wary_agent.familiarity.known.items():
        assert sum(known.counts) == wary_agent.extractor.records[key].training_pictures
    trained = wary_agent.classify_all(many.of_split("train").pictures(16))
    itself = sum(scene.score is not None and scene.score > 0.999999 for scene in trained)
    assert itself >= wary_agent.extractor.records["colour"].training_pictures


def test_a_network_may_be_sure_of_what_it_never_saw(wary_agent: Agent) -> None:
    """Noise that is read with more certainty than some genuine tile is refused all the same."""
    readings = wary_agent.read(noise(40))
    least = np.sort([reading.score for reading in readings])[20]
    found = wary_agent.classify_all(noise(40))
    sure = [scene for scene, other in zip(found, readings, strict=True) if other.score >= least]
    assert {scene.verdict for scene in sure} == {"unknown"}


def test_what_is_like_the_training_is_answered_and_noise_is_not(
    wary_agent: Agent, many: Dataset
) -> None:
    genuine = wary_agent.classify_all(many.of_split("test").pictures(16))
    assert np.mean([scene.verdict == "unknown" for scene in genuine]) <= 0.2
    refused = [scene for scene in wary_agent.classify_all(noise(40)) if scene.verdict == "unknown"]
    assert len(refused) >= 30
    for scene in refused:
        assert (scene.label, scene.method, scene.probability) == (None, "none", None)
        assert scene.score is not None
        assert wary_agent.unknown_below is not None
        assert scene.score < wary_agent.unknown_below


def test_the_model_keeps_the_threshold(wary_agent: Agent, many: Dataset, tmp_path: Path) -> None:
    wary_agent.save(tmp_path / "model")
    loaded = Agent.load(tmp_path / "model")
    assert loaded.unknown_below == wary_agent.unknown_below
    assert loaded.classify_all(noise(40)) == wary_agent.classify_all(noise(40))
    genuine = many.of_split("test").pictures(16)
    assert loaded.classify_all(genuine) == wary_agent.classify_all(genuine)
    files = json.loads((tmp_path / "model" / "model.json").read_text())["files"]
    assert "perception/familiarity.json" in files
    assert "perception/familiarity.safetensors" in files
    # Each way of reading has a scale of its own, and any share has its threshold.
    alone = Agent.load(tmp_path / "model", reading="argmax")
    assert alone.unknown_below == min(wary_agent.validation_scores["argmax"])
    half = Agent.load(tmp_path / "model", known_share=0.5)
    assert half.unknown_below == sorted(wary_agent.validation_scores["consistent"])[8]
    never = Agent.load(tmp_path / "model", known_share=1.0)
    assert never.unknown_below is None
    assert "unknown" not in {scene.verdict for scene in never.classify_all(noise(40))}


def test_a_training_of_a_domain_that_asks_for_nothing_refuses_nothing(agent: Agent) -> None:
    assert (agent.known_share, agent.validation_scores, agent.unknown_below) == (1.0, {}, None)
    assert agent.familiarity is None
    assert "unknown" not in {scene.verdict for scene in agent.classify_all(noise(40))}


# Answers ------------------------------------------------------------------------------------


class Blurred:
    """Networks that see hardly anything: what they make of it is at an angle to all they know."""

    size = 16

    def shown(self, _: str) -> frozenset[str]:
        return frozenset()

    def see(self, pictures: np.ndarray[Any, Any]) -> Seen:
        rows = {"colour": [[0.4, 0.3, 0.3]], "round": [[0.5, 0.5]]}
        known = {"colour": [[3.0, 4.0]], "round": [[1.0, 0.0]]}
        return Seen(
            {key: np.array(row).repeat(len(pictures), axis=0) for key, row in rows.items()},
            {
                key: np.array(embedding, dtype=np.float32).repeat(len(pictures), axis=0)
                for key, embedding in known.items()
            },
        )


KNOWN = Familiarity(
    {
        # Red is read, with a cosine of 0.6 to the nearest red; the one to green does not count.
        "colour": Known(
            np.array([[0.0, 1.0], [0.6, 0.8], [0.0, -1.0], [1.0, 0.0]], dtype=np.float16),
            ("blue", "green", "red"),
            (1, 1, 2),
        ),
        "round": Known(np.array([[1.0, 0.0], [0.0, 1.0]], dtype=np.float16), ("no", "yes"), (1, 1)),
    }
)
"""Three colours weigh twice as much as two shapes: the likeness is (2 · 0.6 + 0) / 3."""


def unknowing(domain: Domain) -> Agent:
    agent = Agent(domain, known_share=0.9)
    agent.fit_induction([("green", "yes"), ("green", "no")], ["good", "bad"])
    agent.extractor = Blurred()  # type: ignore[assignment]
    agent.familiarity = KNOWN
    agent.validation_scores = {"argmax": [0.75 + 0.01 * n for n in range(19)]}
    return agent


def test_every_question_about_an_unknown_picture_has_one_answer(tiles: Domain) -> None:
    agent = unknowing(tiles)
    picture = noise(1)[0]
    scene = agent.classify(picture)
    assert scene.verdict == "unknown"
    for question in agent.questions.one_of_each():
        if question.asks != "explain":
            reply = agent.answer(scene, question)
            assert reply.text == "I don't know: the picture shows no tile that I know."
            assert (reply.method, reply.label) == ("none", None)
            assert reply.to_dict()["verdict"] == "unknown"
            assert reply.justification.to_text().splitlines() == [
                "what is seen is like nothing that is known: its likeness to pictures of training "
                "is 0.400, and 90.0% of the pictures like those of training have at least 0.760",
                "├─ the tile is red (p = 0.40)",
                "└─ the tile is round (p = 0.50)",
            ]
    explained = agent.ask(picture, "please explain this answer")
    assert explained.text == (
        "Perhaps the tile is red and round (each with a probability of at least 0.40). "
        "What is seen is like nothing that is known: its likeness to pictures of training is "
        "0.400, and 90.0% of the pictures like those of training have at least 0.760."
    )


def test_the_domain_words_what_is_not_known(tmp_path: Path) -> None:
    questions = QUESTIONS.replace(
        "[[question]]", '[answers]\nunknown = "is {it} a {scene} at all?"\n\n[[question]]', 1
    )
    domain = load_domain(write_domain(tmp_path / "tiles", questions=questions))
    reply = unknowing(domain).ask(noise(1)[0], "is it good?")
    assert reply.text == "Is the tile a tile at all?"


class Stub(Agent):
    """Knows every other picture."""

    def classify_all(self, pictures: np.ndarray[Any, Any]) -> list[Classification]:
        found = []
        for n in range(len(pictures)):
            known = seen(self, "red", "yes")
            unknown = Classification(
                None, "none", known.vector, known.features, "unknown", None, 0.1
            )
            found.append(unknown if n % 2 else known)
        return found


def test_the_evaluation_counts_what_was_not_known(tiles: Domain, dataset: Dataset) -> None:
    result = evaluate(Stub(tiles), dataset.take(range(8)), questions_per_scene=1)
    assert (result.unknown, result.decided_by_knowledge) == (0.5, 0.5)
    assert result.accuracy_by_method["none"] == 0.0


# The command line ---------------------------------------------------------------------------


def test_what_training_says_of_refusal(
    tiles: Domain, wary_agent: Agent, capsys: pytest.CaptureFixture[str]
) -> None:
    print_refusal(Agent(tiles))
    assert capsys.readouterr().out == ""
    print_refusal(wary_agent)
    assert capsys.readouterr().out == (
        'a picture that shows something else is answered with "I don\'t know", as are 10.0 % of '
        "pictures like the 18 that were compared\n"
    )
    wary_agent.known_share = 0.99
    try:
        print_refusal(wary_agent)
    finally:
        wary_agent.known_share = 0.9
    assert capsys.readouterr().out == (
        "every picture is answered: 18 pictures are too few to know which are strange and refuse "
        "at most 1.0 % of the others\n"
    )


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--known-share", "2"), "seewhy: known_share must be above 0, at most 1, got 2.0\n"),
        (("--known-share", "0"), "seewhy: known_share must be above 0, at most 1, got 0.0\n"),
        (("--gate", "7"), "seewhy: gate must be 0 to 1, got 7.0\n"),
        (("--reading", "best"), "seewhy: 'best' is no way to read features; it must be one of: "
         "argmax, consistent, with_class\n"),
    ],
)  # fmt: skip
def test_wrong_options(
    model_folder: Path,
    tiles_data: Path,
    options: tuple[str, ...],
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    picture = next((tiles_data / "images").iterdir())
    given = ["seewhy", "ask", str(model_folder), str(picture), "is it good?", *options]
    monkeypatch.setattr("sys.argv", given)
    with pytest.raises(SystemExit) as ended:
        main()
    assert (ended.value.code, capsys.readouterr().err) == (2, said)


def test_a_share_that_is_none(tmp_path: Path) -> None:
    text = DOMAIN.replace("[domain]\n", "[domain]\nknown_share = 0\n")
    with pytest.raises(DomainError) as problem:
        load_domain(write_domain(tmp_path / "tiles", domain=text))
    assert str(problem.value) == (
        f"{tmp_path}/tiles/domain.toml:2: 'domain.known_share': input should be greater than 0, "
        "got 0"
    )
