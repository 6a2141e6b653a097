"""Remove a quarter of what is known about traffic signs and learn it again from annotated scenes.

The networks are trained once, on the photographs of the poles outside a fold, and read those of the
fold. Every trial removes a random quarter of the axioms, draws scenes from the annotation of the
training photographs, and classifies the others' photographs three times: with the axioms that are
left, with those learned besides, and with the full knowledge. What is still open is decided by a
tree over the same scenes, each time.

    python experiments/axioms_learned_signs.py MODEL PHOTOS
    python experiments/axioms_learned_signs.py MODEL PHOTOS --answers --trials 5 --sizes 500 2000
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from joblib import Parallel, delayed
from scipy.stats import ttest_rel
from signs_against_end_to_end import DOMAIN, in_fold

from seewhy.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain import Domain, load_domain
from seewhy.evaluation import evaluate
from seewhy.learning import AnnotatedScenes, axioms_of, learn_for_domain
from seewhy.refutation import refuted

SIZES = (100, 200, 500, 1000, 2000, 4000)
TRIALS = 30
SHARE = 0.25
KNOWLEDGE = ("incomplete", "learned", "full")


def divided(scenes: Dataset) -> tuple[Dataset, Dataset]:
    """The photographs to train on and those to test on: poles stay whole."""
    tested = in_fold(scenes, 0)
    chosen = [
        replace(scene, split="test" if out else "train")
        for scene, out in zip(scenes.scenes, tested, strict=True)
    ]
    marked = replace(scenes, scenes=tuple(chosen))
    return marked.of_split("train"), marked.of_split("test")


def incomplete(domain: Domain, rng: np.random.Generator) -> Domain:
    """The domain without a random quarter of its axioms."""
    axioms = domain.knowledge.axioms
    gone = set(rng.permutation(len(axioms))[: round(SHARE * len(axioms))].tolist())
    kept = tuple(own for n, own in enumerate(axioms) if n not in gone)
    return replace(domain, knowledge=replace(domain.knowledge, axioms=kept))


class Remembered:
    """What networks saw in the pictures to test on, in place of the networks."""

    def __init__(self, probabilities: dict[str, np.ndarray]) -> None:
        self._probabilities = probabilities

    def probabilities(self, pictures: np.ndarray) -> dict[str, np.ndarray]:
        """The probabilities of each feature's values; the pictures are always the same."""
        assert all(len(own) == len(pictures) for own in self._probabilities.values())
        return self._probabilities


def trial(
    given: Domain,
    seen: Remembered,
    train: Dataset,
    test: Dataset,
    *,
    size: int,
    seed: int,
    answers: bool,
) -> dict[str, tuple[float, float, float]]:
    """Accuracy of classes, of answers, and share decided by knowledge, with each knowledge."""
    rng = np.random.default_rng([seed, size])
    chosen = rng.integers(len(train), size=size)
    vectors = [train.vectors[n] for n in chosen]
    labels = [train.classes[n] for n in chosen]
    scenes = AnnotatedScenes(tuple(vectors), tuple(labels), ("",) * size)
    less = incomplete(given, np.random.default_rng(seed))
    # What a lost fact made wrong is set aside first, as `seewhy learn` does.
    wrong = refuted(less, scenes)
    aside = [axiom for axiom, _ in wrong]
    rest = tuple(own for own in less.knowledge.axioms if own not in aside)
    right = replace(less, knowledge=replace(less.knowledge, axioms=rest))
    learned = learn_for_domain(right, scenes)
    axioms = axioms_of(right, [own.candidate for own in learned.accepted], scenes)
    pictures = test.pictures(given.pictures.size)
    # Who annotates the answers knows all there is to know.
    annotator = Agent(given).fit_induction(vectors, labels, answers=False).reference
    found = {}
    for name, domain, more, gone in (
        ("incomplete", less, (), ()),
        ("learned", less, axioms, tuple(own for _, own in wrong)),
        ("full", given, (), ()),
    ):
        agent = Agent(domain, seed=seed, known_share=1.0, learned=more, withdrawn=gone)
        agent.extractor = seen
        agent.fit_induction(vectors, labels, answers=answers, reference=annotator)
        given_classes = agent.classify_all(pictures)
        pairs = zip(given_classes, test.classes, strict=True)
        by_knowledge = [own.method == "knowledge" for own in given_classes]
        answered = 0.0
        if answers:
            answered = evaluate(agent, test, seed=seed, reference=annotator).answer_accuracy
        found[name] = (
            float(np.mean([own.label == label for own, label in pairs])),
            float(answered),
            float(np.mean(by_knowledge)),
        )
    return found


def row(size: int, found: Sequence[dict[str, tuple[float, float, float]]]) -> str:
    """The means over the trials, and how sure it is that learning helped (paired t-test)."""
    cells = [str(size)]
    for column in (0, 1):
        values = {name: [100 * own[name][column] for own in found] for name in KNOWLEDGE}
        if not any(values["full"]):
            continue
        cells += [f"{np.mean(values[name]):.2f} %" for name in KNOWLEDGE]
        test = ttest_rel(values["learned"], values["incomplete"], alternative="greater")
        cells.append(f"{test.pvalue:.2g}")
    cells += [f"{100 * np.mean([own[name][2] for own in found]):.1f} %" for name in KNOWLEDGE]
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Train the model if it is missing, and print a row for every number of scenes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("photographs", type=Path)
    parser.add_argument("--sizes", type=int, nargs="*", default=list(SIZES))
    parser.add_argument("--trials", type=int, default=TRIALS)
    parser.add_argument("--drawn", type=int, default=0, help="signs drawn before the photographs")
    parser.add_argument("--answers", action="store_true", help="train and score answers too")
    parser.add_argument("--jobs", type=int, default=-1)
    options = parser.parse_args()
    domain = load_domain(DOMAIN)
    train, test = divided(Dataset.load(options.photographs, domain))
    if not options.model.exists():
        agent = Agent(domain, known_share=1.0)
        agent.fit(train, drawn=options.drawn, answers=False).save(options.model)
    trained = Agent.load(options.model)
    assert trained.extractor is not None
    if trained.trained_on & set(test.picture_digests()):
        parser.error(f"{options.model} was trained on photographs to test on; name another")
    seen = Remembered(trained.extractor.probabilities(test.pictures(domain.pictures.size)))
    kinds = ["classes", "answers"] if options.answers else ["classes"]
    names = [f"{kind}, {name}" for kind in kinds for name in (*KNOWLEDGE, "p")]
    names += [f"by knowledge, {name}" for name in KNOWLEDGE]
    print(f"| scenes | {' | '.join(names)} |")
    print("|---" * (len(names) + 1) + "|")
    for size in options.sizes:
        found = Parallel(n_jobs=options.jobs)(
            delayed(trial)(
                trained.given, seen, train, test, size=size, seed=seed, answers=options.answers
            )
            for seed in range(options.trials)
        )
        print(row(size, found), flush=True)


if __name__ == "__main__":
    main()
