"""The architecture that the paper compares with: networks from end to end, no knowledge, no tree.

Networks map the picture to its features and, directly, to its class; an LSTM maps what they make
of the picture, and the question, to the type of the answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import torch

from seewhy.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.learned import MOST_EXAMPLES, dealt
from seewhy.dialogue.question import Asks, Query, Question, Questions
from seewhy.dialogue.recurrent import Asked, grown_network, hold_out
from seewhy.dialogue.recurrent_network import FORMAT, Description, Encoding, Network
from seewhy.dialogue.recurrent_options import RecurrentOptions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain import Domain
from seewhy.experiments.questioning import Asked as AskedQuestion
from seewhy.experiments.questioning import answer_scores
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.domain_options import training_options
from seewhy.perception.extractor import FeatureExtractor, fit_extractor
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal

__all__ = ["CLASS", "Answers", "EndToEnd", "class_options", "fit_answers", "fit_class_network"]

CLASS = "class"
"""The name under which the network of the class is trained."""

_SHOWN_AT_ONCE = 4096
Pictures = npt.NDArray[np.uint8]
Representation = npt.NDArray[np.float32]


def class_options(domain: Domain, *, seed: int) -> TrainingOptions:
    """How the network of the class is trained: as the domain's hardest feature is.

    It grows until it is as accurate as the most accurate of them must be, and is as wide as the
    widest.
    """
    options = training_options(domain, seed=seed).values()
    largest = max(options, key=lambda own: (sum(own.channels), own.dense))
    return replace(largest, threshold=max(own.threshold for own in options))


def fit_class_network(
    scenes: Dataset,
    *,
    options: TrainingOptions,
    start_from: FeatureExtractor | None = None,
    rehearsal: Rehearsal | None = None,
    validation: npt.NDArray[np.int64] | None = None,
) -> FeatureExtractor:
    """Train one network from the picture to the class, like the network of a feature."""
    return fit_extractor(
        scenes.pictures(scenes.domain.pictures.size),
        {CLASS: scenes.labels},
        values={CLASS: tuple(scenes.domain.classes)},
        options=options,
        groups=scenes.groups,
        validation=validation,
        start_from=start_from,
        rehearsal=rehearsal,
        workers=1,
    )


class Answers:
    """An LSTM over a question and what networks make of a picture; see :func:`fit_answers`."""

    def __init__(self, network: Network, description: Description) -> None:
        self._network = network.eval()
        self.description = description
        self._encoding = Encoding(description)
        self.types = tuple(map(AnswerType.parse, description.answers))

    def answer(self, questions: Sequence[Question], shown: Representation) -> list[AnswerType]:
        """The most probable answer type for each question about the picture beside it.

        Parameters
        ----------
        questions : sequence of Question, length n
        shown : ndarray of float32, shape (n, width)
            What networks make of the picture that each question is about.
        """
        found: list[AnswerType] = []
        with torch.inference_mode():
            for start in range(0, len(questions), _SHOWN_AT_ONCE):
                some = questions[start : start + _SHOWN_AT_ONCE]
                words, lengths, _ = self._encoding.encode([(own.words, ("",), "") for own in some])
                scenes = torch.from_numpy(shown[start : start + _SHOWN_AT_ONCE])
                best = self._network(words, lengths, scenes).argmax(dim=1).tolist()
                found += [self.types[n] for n in best]
        return found


def fit_answers(
    questions: Questions,
    reference: ReferenceAnswers,
    scenes: Dataset,
    shown: Representation,
    *,
    seed: int,
    most_examples: int = MOST_EXAMPLES,
) -> Answers:
    """Train an LSTM on questions about all pictures of a dataset, layer by layer.

    It is the recurrent network that SeeWhy has for scenes that reasoning leaves open, with the
    same options, and with numbers that networks make of the picture in place of its features and
    its class; it learns from every picture where that one learns from those left open.
    """
    by_query: dict[Query, list[Question]] = {}
    for question in questions.all:
        if question.asks is not Asks.EXPLAIN:
            by_query.setdefault(question.query, []).append(question)
    asked: list[tuple[Question, int]] = []
    answers: list[str] = []
    for number, queries in dealt(by_query, scenes.labels, most=most_examples, seed=seed):
        for query in queries:
            same = by_query[query]
            asked.append((same[number % len(same)], number))
            kind = reference.answer(same[0], scenes.vectors[number], scenes.labels[number])
            answers.append(kind.identifier)
    options = RecurrentOptions(seed=seed)
    numbers = [number for _, number in asked]
    train, held_out = hold_out(numbers, options)
    description = Description(
        format=FORMAT,
        layers=1,
        width=options.width,
        embedding=options.embedding,
        words=tuple(sorted({word for i in train for word in asked[i][0].words})),
        features={"picture": tuple(map(str, range(shown.shape[1])))},
        labels=(),
        answers=tuple(sorted(set(answers))),
        held_out_accuracy=0.0,
        held_out=len(held_out),
        digest="",
    )
    words, lengths, _ = Encoding(description).encode([(own.words, ("",), "") for own, _ in asked])
    place = {answer: i for i, answer in enumerate(description.answers)}
    examples = Asked(
        words,
        lengths,
        torch.from_numpy(shown[numbers]),
        torch.tensor([place[answer] for answer in answers]),
    )
    return Answers(
        *grown_network(description, examples, train=train, held_out=held_out, options=options)
    )


class EndToEnd:
    """The trained architecture: what it takes pictures to be, and what it answers.

    Parameters
    ----------
    domain : Domain
    features : FeatureExtractor
        The networks of the features. They are trained as SeeWhy's are, by themselves.
    classes : FeatureExtractor
        The network of the class.
    """

    def __init__(
        self, domain: Domain, features: FeatureExtractor, classes: FeatureExtractor
    ) -> None:
        self.domain = domain
        self.features = features
        self.classes = classes
        self.answers: Answers | None = None

    def classify(self, pictures: Pictures) -> list[str]:
        """The most probable class of each picture."""
        names = self.classes.values[CLASS]
        found = self.classes.probabilities(pictures)[CLASS].argmax(axis=1)
        return [names[n] for n in found]

    def vectors(self, pictures: Pictures) -> list[FeatureVector]:
        """The most probable value of every feature of each picture."""
        seen = self.features.probabilities(pictures)
        columns = [
            [self.features.values[key][n] for n in seen[key].argmax(axis=1)]
            for key in self.domain.features
        ]
        return list(zip(*columns, strict=True))

    def represent(self, pictures: Pictures) -> Representation:
        """What the LSTM is shown of each picture: the probabilities of all values and classes."""
        seen = {**self.features.probabilities(pictures), **self.classes.probabilities(pictures)}
        return np.concatenate(list(seen.values()), axis=1).astype(np.float32)

    def fit_answers(
        self, scenes: Dataset, questions: Questions, reference: ReferenceAnswers, *, seed: int
    ) -> None:
        """Train the LSTM on questions about annotated pictures."""
        shown = self.represent(scenes.pictures(self.domain.pictures.size))
        self.answers = fit_answers(questions, reference, scenes, shown, seed=seed)

    def score(
        self, test: Dataset, asked: Sequence[AskedQuestion], reference: ReferenceAnswers
    ) -> dict[str, float]:
        """Its measures on pictures and questions about them."""
        assert self.answers is not None
        pictures = test.pictures(self.domain.pictures.size)
        labels, vectors = self.classify(pictures), self.vectors(pictures)
        shown = self.represent(pictures)
        kinds = self.answers.answer(
            [own.question for own in asked], shown[[own.picture for own in asked]]
        )
        right = [own == true for own, true in zip(labels, test.labels, strict=True)]
        return {
            "accuracy": float(np.mean(right)),
            **answer_scores(asked, kinds, test, reference, vectors=vectors, labels=labels),
        }
