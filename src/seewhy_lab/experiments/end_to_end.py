"""The architecture that the paper compares with: networks from end to end, no knowledge, no tree.

Networks map the picture to its features and, directly, to its class; an LSTM maps what they make
of the picture, and the question, to the type of the answer.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import torch

from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Question, Questions
from seewhy.dialogue.recurrent import Asked, grown_network, hold_out
from seewhy.dialogue.recurrent_network import FORMAT, Description, Encoding, Network
from seewhy.dialogue.recurrent_options import RecurrentOptions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain.domain import Domain
from seewhy.knowledge.scene import FeatureVector
from seewhy_lab.experiments.questioning import (
    QUESTIONS,
    answer_scores,
    draw_questions,
    suitable,
    wordings_of,
)
from seewhy_lab.experiments.questioning import Asked as AskedQuestion
from seewhy_lab.experiments.seeing import Shown

__all__ = ["Answers", "EndToEnd", "fit_answers", "questions_to_learn", "represented"]

WIDTH = 96
"""Units of each layer of the LSTM: twice as many as where only what is left open is learned.

It has to learn what the knowledge states, from several times as many questions. At 48 its answers
were 1.6 points worse (400 structures), twice as many passes at 48 were no better than 96; shown the
outputs of the networks' dense layers, with or without the probabilities, they were 15 points worse.
"""

MOST_QUESTIONS, EACH = 20_000, 250
"""Questions to learn from at most; where many can be asked, so many for each."""

PASSES, MOST_SHOWN = 10, 400_000
"""Passes over the questions, fewer where that made more than so many questions shown."""

_SHOWN_AT_ONCE = 4096
Representation = npt.NDArray[np.float32]


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
                words, lengths, _ = self._encoding.encode(
                    [(question.words, ("",), "") for question in some]
                )
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
) -> Answers:
    """Train an LSTM on questions about all pictures of a dataset, layer by layer.

    It is the recurrent network that SeeWhy has for scenes that reasoning leaves open, wider, and
    with numbers that networks make of the picture in place of its features and its class; it
    learns from every picture where that one learns from those left open, and from such questions
    as it is asked afterwards (:func:`questions_to_learn`).
    """
    vectors, labels = scenes.vectors, scenes.classes
    asked = questions_to_learn(questions, labels, seed=seed)
    numbers = [asked_question.picture for asked_question in asked]
    answers = [
        reference.answer(asked_question.question, vectors[n], labels[n]).identifier
        for asked_question, n in zip(asked, numbers, strict=True)
    ]
    passes = max(1, min(PASSES, round(MOST_SHOWN / len(asked))))
    options = RecurrentOptions(seed=seed, width=WIDTH, epochs=passes)
    train, held_out = hold_out(numbers, options)
    description = Description(
        format=FORMAT,
        layers=1,
        width=options.width,
        embedding=options.embedding,
        words=tuple(sorted({word for i in train for word in asked[i].question.words})),
        features={"picture": tuple(map(str, range(shown.shape[1])))},
        labels=(),
        answers=tuple(sorted(set(answers))),
        held_out_accuracy=0.0,
        held_out=len(held_out),
        digest="",
    )
    words, lengths, _ = Encoding(description).encode(
        [(asked_question.question.words, ("",), "") for asked_question in asked]
    )
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


def questions_to_learn(
    questions: Questions, labels: Sequence[str], *, seed: int, most: int | None = None
) -> list[AskedQuestion]:
    """Draw questions about pictures of some classes as those to test on are drawn, more often.

    Twice as many as there are different ones, at most ``most``, which is :data:`MOST_QUESTIONS`
    or, where more can be asked, so many that each can be asked :data:`EACH` times. Every picture
    is asked as much as every other.
    """
    wordings = [same[0] for same in wordings_of(questions).values()]
    fitting = {
        label: sum(suitable(question, label) for question in wordings) for label in set(labels)
    }
    most = max(MOST_QUESTIONS, EACH * len(wordings)) if most is None else most
    total = min(most, 2 * sum(fitting[label] for label in labels))
    left = max(1, total // max(1, len(labels)))
    asked: list[AskedQuestion] = []
    for turn in range(-(-left // QUESTIONS)):
        count = min(QUESTIONS, left - turn * QUESTIONS)
        asked += draw_questions(questions, labels, seed=seed, count=count, stream=(3, turn))
    return asked


class EndToEnd:
    """The trained architecture: what it takes pictures to be, and what it answers.

    Its networks of the features are SeeWhy's: both train them in the same way, each by itself.

    Parameters
    ----------
    domain : Domain
    train : Shown
        The pictures that its networks were trained on.
    """

    def __init__(self, domain: Domain, train: Shown) -> None:
        self.domain = domain
        self.train = train
        self.answers: Answers | None = None

    def fit_answers(self, questions: Questions, reference: ReferenceAnswers, *, seed: int) -> None:
        """Train the LSTM on questions about all pictures."""
        shown = represented(self.train)
        self.answers = fit_answers(questions, reference, self.train.scenes, shown, seed=seed)

    def classify(self, shown: Shown) -> list[str]:
        """The most probable class of each picture."""
        names = list(self.domain.classes)
        return [names[n] for n in shown.classes.argmax(axis=1)]

    def accuracy(self, test: Shown) -> float:
        """The share of pictures whose class is the annotated one."""
        pairs = zip(self.classify(test), test.scenes.classes, strict=True)
        return float(np.mean([predicted == true for predicted, true in pairs]))

    def vectors(self, shown: Shown) -> list[FeatureVector]:
        """The most probable value of every feature of each picture."""
        columns = [
            [feature.values[n] for n in shown.features[key].argmax(axis=1)]
            for key, feature in self.domain.features.items()
        ]
        return list(zip(*columns, strict=True))

    def score(
        self, test: Shown, asked: Sequence[AskedQuestion], reference: ReferenceAnswers
    ) -> dict[str, float]:
        """Its measures on pictures and questions about them."""
        assert self.answers is not None
        labels, vectors = self.classify(test), self.vectors(test)
        kinds = self.answers.answer(
            [asked_question.question for asked_question in asked],
            represented(test)[[asked_question.picture for asked_question in asked]],
        )
        scores = answer_scores(
            asked,
            kinds,
            test.scenes,
            reference,
            vectors=[vectors[asked_question.picture] for asked_question in asked],
            labels=[labels[asked_question.picture] for asked_question in asked],
        )
        return {"accuracy": self.accuracy(test), **scores}


def represented(shown: Shown) -> Representation:
    """What the LSTM is shown of each picture: the probabilities of all values and classes."""
    parts = [*shown.features.values(), shown.classes]
    return np.concatenate(parts, axis=1).astype(np.float32)
