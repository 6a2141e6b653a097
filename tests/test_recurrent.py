"""The LSTM that answers questions about scenes that reasoning left open."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import torch

from seewhy.dialogue import recurrent
from seewhy.dialogue.recurrent import _improves, fit_answerer
from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
from seewhy.dialogue.recurrent_options import AnswererEvent, AnswerExample, RecurrentOptions
from seewhy.errors import DatasetError, DomainError, ModelError
from seewhy.perception.one_thread import one_thread

FEATURES = {"num_blocks": ["1", "2", "3", "4", "5"], "lean": ["yes", "no"], "base": ["wide", "no"]}
QUESTIONS = {
    "stable": "is the structure stable",
    "why": "why is the structure unstable",
    "change": "what would make the structure stable",
    "count": "how many blocks are there",
    "lean": "does the tower lean to one side",
}


def right_answer(question: str, features: tuple[str, ...], label: str) -> str:
    """Follows from the kind of question, two features and the class."""
    blocks, lean, base = features
    return {
        "stable": label,
        "why": "because it leans" if lean == "yes" else f"because its base is {base}",
        "change": "straighten it" if lean == "yes" and base == "wide" else "widen it",
        "count": f"{blocks} blocks",
        "lean": lean,
    }[question]


def examples(scenes: int, *, seed: int = 0) -> list[AnswerExample]:
    rng = np.random.default_rng(seed)
    found = []
    for scene in range(scenes):
        features = tuple(str(rng.choice(values)) for values in FEATURES.values())
        label = str(rng.choice(["steady", "shaky"]))
        found += [
            AnswerExample(
                tuple(text.split()),
                features,
                label,
                right_answer(question, features, label),
                scene,
            )
            for question, text in QUESTIONS.items()
        ]
    return found


@pytest.fixture(scope="module", autouse=True)
def _as_often_as_outside_of_tests() -> Iterator[None]:
    """Here is asked how well it learns."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(recurrent, "ENOUGH_EXAMPLES", 3000)
        yield


@pytest.fixture(scope="module")
def answerer() -> RecurrentAnswerer:
    return fit_answerer(examples(100), feature_values=FEATURES, options=RecurrentOptions(epochs=6))


def test_learns_what_follows_from_question_features_and_class(answerer: RecurrentAnswerer) -> None:
    fresh = examples(60, seed=1)
    found = answerer.answers([(e.words, e.features, e.label) for e in fresh])
    wrong = [(e, got) for e, (got, _) in zip(fresh, found, strict=True) if got != e.answer]
    assert wrong == []
    assert min(probability for _, probability in found) > 0.5
    assert answerer.held_out_accuracy == 1.0
    assert answerer.held_out == 100  # every fifth of 100 scenes, five questions each
    assert answerer.layers == 1  # nothing was left for a second to improve


def test_words_in_another_order_mean_another_question() -> None:
    asked = [
        AnswerExample(tuple(text.split()), ("yes",), "x", answer)
        for text, answer in (
            ("is the red block above the blue", "above"),
            ("is the blue block above the red", "below"),
        )
    ] * 40
    fitted = fit_answerer(asked, feature_values={"lean": ["yes", "no"]})
    for example in asked[:2]:
        assert fitted.answer(example.words, ("yes",), "x")[0] == example.answer


def test_one_at_a_time_agrees_with_many(answerer: RecurrentAnswerer) -> None:
    fresh = examples(4, seed=2)
    many = answerer.answers([(e.words, e.features, e.label) for e in fresh])
    for example, (answer, probability) in zip(fresh, many, strict=True):
        alone = answerer.answer(example.words, example.features, example.label)
        assert alone[0] == answer
        assert alone[1] == pytest.approx(probability, abs=1e-5)
    assert answerer.answers([]) == []


def test_unknown_words_are_understood_past(answerer: RecurrentAnswerer) -> None:
    words = ["how", "many", "bricks", "are", "there"]  # "bricks" was never met
    assert answerer.answer(words, ("3", "yes", "wide"), "steady")[0] == "3 blocks"
    assert answerer.answer([], ("3", "yes", "wide"), "steady")[0] in answerer.answer_types
    assert answerer.answer(words, ("9", "?", "?"), "new")[0] in answerer.answer_types


def test_only_allowed_types_are_answered(answerer: RecurrentAnswerer) -> None:
    words = QUESTIONS["count"].split()
    scene = (("3", "yes", "wide"), "steady")
    allowed = {"steady", "shaky"}
    answer, probability = answerer.answer(words, *scene, allowed=allowed)
    assert answer in allowed
    assert 0.5 <= probability <= 1.0
    assert answerer.answer(words, *scene, allowed=["3 blocks"]) == ("3 blocks", 1.0)
    mixed = answerer.answers([(words, *scene)] * 2, allowed=[None, allowed])
    assert [found[0] for found in mixed] == ["3 blocks", answer]
    assert answerer.answer(words, *scene, allowed=["new", "also new"]) == ("also new", 0.5)
    with pytest.raises(DatasetError, match="allowed must name at least one answer type, got none"):
        answerer.answer(words, *scene, allowed=[])
    with pytest.raises(DatasetError, match=r"one entry a question \(1\), got 0"):
        answerer.answers([(words, *scene)], allowed=[])


def test_a_layer_is_added_only_for_a_significant_improvement() -> None:
    before = np.array([True] * 90 + [False] * 10)

    def after(won: int, lost: int) -> np.ndarray:
        found = before.copy()
        found[90 : 90 + won] = True
        found[:lost] = False
        return found

    assert _improves(before, after(5, 0), 0.05)  # 1/32
    assert not _improves(before, after(4, 0), 0.05)  # 1/16
    assert not _improves(before, after(5, 1), 0.05)
    assert not _improves(before, after(0, 5), 0.05)
    assert not _improves(before, before, 0.05)


def test_growing_tries_the_next_layer_and_keeps_the_smaller_network() -> None:
    rng = np.random.default_rng(0)
    guesswork = [
        AnswerExample(("is", "it"), ("yes",), "x", str(rng.choice(["a", "b"]))) for _ in range(100)
    ]
    events: list[AnswererEvent] = []
    fitted = fit_answerer(
        guesswork,
        feature_values={"lean": ["yes", "no"]},
        options=RecurrentOptions(epochs=1),
        on_progress=events.append,
    )
    assert fitted.layers == 1
    assert sorted({event.layers for event in events}) == [1, 2]
    last = next(event for event in events if event.held_out_accuracy is not None)
    assert last.epoch == last.epochs
    assert last.message == (
        f"answers: epoch {last.epochs} of {last.epochs}, 1 LSTM layer, "
        f"{last.held_out_accuracy:.1%} on held-out questions"
    )
    assert last.held_out_accuracy == fitted.held_out_accuracy


def test_a_layer_that_helps_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seewhy.dialogue.recurrent._improves", lambda *_: True)
    rng = np.random.default_rng(0)
    guesswork = [
        AnswerExample(("is", "it"), ("yes",), "x", str(rng.choice(["a", "b"]))) for _ in range(60)
    ]
    fitted = fit_answerer(
        guesswork,
        feature_values={"lean": ["yes", "no"]},
        options=RecurrentOptions(epochs=1, max_layers=2),
    )
    assert fitted.layers == 2


def test_scenes_are_held_out_whole() -> None:
    # The answer is the scene's own, told by nothing but its features: only by having seen other
    # questions about a scene could a held-out one be answered.
    features = {f"f{i}": ["0", "1"] for i in range(7)}
    asked = [
        AnswerExample((word,), tuple(f"{scene:07b}"), "x", f"answer {scene}", scene)
        for scene in range(40)
        for word in ("who", "what", "where")
    ]
    options = RecurrentOptions(max_layers=1)
    assert fit_answerer(asked, feature_values=features, options=options).held_out_accuracy == 0.0


def test_same_seed_same_answers_and_the_callers_randomness_is_untouched() -> None:
    options = RecurrentOptions(epochs=1, max_layers=1)
    threads = torch.get_num_threads()
    torch.manual_seed(1)
    expected = torch.rand(3)
    torch.manual_seed(1)
    one = fit_answerer(examples(20), feature_values=FEATURES, options=options)
    assert torch.equal(torch.rand(3), expected)
    assert torch.get_num_threads() == threads
    two = fit_answerer(examples(20), feature_values=FEATURES, options=options)
    other = fit_answerer(
        examples(20), feature_values=FEATURES, options=RecurrentOptions(epochs=1, seed=1)
    )
    asked = [(e.words, e.features, e.label) for e in examples(10, seed=3)]
    assert one.answers(asked) == two.answers(asked)
    assert one.answers(asked) != other.answers(asked)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_few_examples(n: int) -> None:
    fitted = fit_answerer(examples(1)[:n], feature_values=FEATURES)
    example = examples(1)[0]
    answer, probability = fitted.answer(example.words, example.features, example.label)
    assert answer == example.answer
    assert 0 < probability <= 1
    assert fitted.held_out == 0


def test_one_answer_type_only() -> None:
    asked = [AnswerExample(("is", "it"), ("yes",), "x", "always", i) for i in range(10)]
    fitted = fit_answerer(asked, feature_values={"lean": ["yes", "no"]})
    assert fitted.answer(("what",), ("no",), "y") == ("always", 1.0)
    assert fitted.layers == 1


def test_no_features() -> None:
    asked = [AnswerExample((word,), (), "x", word) for word in ("a", "b") * 20]
    fitted = fit_answerer(asked, feature_values={})
    assert fitted.answer(("a",), (), "x")[0] == "a"


def test_what_does_not_fit_is_refused(answerer: RecurrentAnswerer) -> None:
    with pytest.raises(DatasetError, match="there is no question to learn from: add scenes"):
        fit_answerer([], feature_values=FEATURES)
    with pytest.raises(DatasetError) as caught:
        fit_answerer([AnswerExample(("is",), ("1",), "x", "a")], feature_values=FEATURES)
    assert str(caught.value) == (
        "an example must have one value for each of num_blocks, lean, base, got ('1',)"
    )
    with pytest.raises(DatasetError, match="a scene must have 3 features, got 1"):
        answerer.answer(("is",), ("1",), "x")
    with pytest.raises(DomainError, match="max_layers must be 1 to 8, got 0"):
        RecurrentOptions(max_layers=0)


def test_an_answer_takes_milliseconds(answerer: RecurrentAnswerer) -> None:
    spent = []
    with one_thread():  # processor time, so that what else the machine does is not counted
        for _ in range(20):
            start = time.process_time()
            answerer.answer(QUESTIONS["why"].split(), ("3", "yes", "wide"), "steady")
            spent.append(time.process_time() - start)
    assert min(spent) < 0.02


# On disk


def test_saved_and_loaded(answerer: RecurrentAnswerer, tmp_path: Path) -> None:
    answerer.save(tmp_path / "model")
    loaded = RecurrentAnswerer.load(tmp_path / "model")
    asked = [(e.words, e.features, e.label) for e in examples(5, seed=4)]
    assert loaded.answers(asked) == answerer.answers(asked)
    for name in ("layers", "held_out_accuracy", "held_out", "answer_types"):
        assert getattr(loaded, name) == getattr(answerer, name)
    loaded.save(tmp_path / "again")
    assert RecurrentAnswerer.load(tmp_path / "again").answers(asked) == answerer.answers(asked)


@pytest.mark.parametrize("file", ["answers.json", "answers.safetensors"])
def test_missing_file(answerer: RecurrentAnswerer, tmp_path: Path, file: str) -> None:
    answerer.save(tmp_path)
    (tmp_path / file).unlink()
    with pytest.raises(ModelError) as caught:
        RecurrentAnswerer.load(tmp_path)
    assert str(caught.value) == (
        f"{tmp_path / file} cannot be read (No such file or directory): train the model again, "
        "or copy its folder again from where it is whole"
    )


def test_damaged_files(answerer: RecurrentAnswerer, tmp_path: Path) -> None:
    answerer.save(tmp_path)
    description, weights = tmp_path / "answers.json", tmp_path / "answers.safetensors"
    whole = json.loads(description.read_text())

    description.write_text(json.dumps({**whole, "words": [*whole["words"], "more"]}))
    with pytest.raises(ModelError, match=r"answers\.safetensors does not hold the weights that"):
        RecurrentAnswerer.load(tmp_path)
    description.write_text(json.dumps({**whole, "format": 99}))
    with pytest.raises(ModelError, match="has format 99, this version of SeeWhy reads 1"):
        RecurrentAnswerer.load(tmp_path)
    description.write_text(json.dumps({**whole, "layers": "many"}))
    with pytest.raises(ModelError, match=r"answers\.json is damaged \(layers: Input should be"):
        RecurrentAnswerer.load(tmp_path)
    description.write_text("{")
    with pytest.raises(ModelError, match=r"answers\.json is damaged \(its text: "):
        RecurrentAnswerer.load(tmp_path)
    description.write_text(json.dumps(whole))
    weights.write_bytes(weights.read_bytes()[:-8])
    with pytest.raises(ModelError, match=r"answers\.safetensors is damaged or belongs to"):
        RecurrentAnswerer.load(tmp_path)
