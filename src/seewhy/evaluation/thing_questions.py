"""How many questions about annotated scenes of things are answered rightly, and how fast."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from seewhy.data.importers.clevr import AskedOfScene
from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.answering import ThingAnswerer, ThingReply
from seewhy.dialogue.things.outcome import Value
from seewhy.domain.things import Things
from seewhy.errors import QuestionError
from seewhy.evaluation.share import Share

__all__ = ["ThingEvaluation", "WrongAnswer", "evaluate_thing_questions"]


@dataclass(frozen=True)
class WrongAnswer:
    """A question that was not answered as annotated.

    ``text`` is what was answered, or why the question was not understood; ``understood`` is what
    it was taken to ask.
    """

    place: str
    question: str
    answer: bool | int | str | None
    got: Value
    text: str
    understood: str | None

    def to_dict(self) -> dict[str, Any]:
        """Return it as values that JSON can hold."""
        got = list(self.got) if isinstance(self.got, tuple) else self.got
        return {**vars(self), "got": got}


@dataclass(frozen=True)
class ThingEvaluation:
    """Answers to questions about scenes of things, beside those that are annotated.

    Attributes
    ----------
    questions, understood, right : int
        Of all that have an annotated answer. One that is understood has some meaning, right or not.
    without_answer : int
        Questions that have none, and do not count.
    seconds, processor_seconds : float
        That reading, answering and making all reasons took: by the clock, and of one core's time,
        which is the same where nothing else computes.
    steps : int
        The steps of all justifications together.
    majority : Share
        The most frequent answer.
    families : mapping of str to Share
    wrong : tuple of WrongAnswer
    """

    questions: int
    understood: int
    right: int
    without_answer: int
    seconds: float
    processor_seconds: float
    steps: int
    majority: Share
    families: Mapping[str, Share] = field(default_factory=dict)
    wrong: tuple[WrongAnswer, ...] = ()

    @property
    def questions_per_second(self) -> float:
        """Questions that were answered, with all reasons, in a second of one core's time."""
        asked = self.questions + self.without_answer
        return asked / self.processor_seconds if self.processor_seconds else 0.0

    def to_dict(self) -> dict[str, Any]:
        """Return the evaluation as values that JSON can hold."""
        return {
            "questions": self.questions,
            "understood": self.understood,
            "right": self.right,
            "accuracy": Share(self.right, self.questions).value,
            "interval": list(Share(self.right, self.questions).interval),
            "majority": self.majority.value,
            "without_answer": self.without_answer,
            "seconds": round(self.seconds, 3),
            "processor_seconds": round(self.processor_seconds, 3),
            "questions_per_second": round(self.questions_per_second, 1),
            "reasons": "made for every answer",
            "steps_of_reasons": self.steps,
            "families": {
                name: {"questions": share.of, "right": share.right}
                for name, share in self.families.items()
            },
            "wrong": [wrong.to_dict() for wrong in self.wrong],
        }


def evaluate_thing_questions(
    things: Things,
    scenes: Mapping[int, ThingScene],
    questions: Sequence[AskedOfScene],
    *,
    on_progress: Callable[[int], None] | None = None,
) -> ThingEvaluation:
    """Answer questions about annotated scenes, make all reasons, and compare.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scenes = {0: thing_scene(things, [{"shape": "cube"}], relations={})}
    >>> asked = AskedOfScene(0, "How many blocks are there?", 1, "count", "here")
    >>> evaluate_thing_questions(things, scenes, [asked]).right
    1
    """
    answerer = ThingAnswerer(things)
    wrong: list[WrongAnswer] = []
    of_family: Counter[str] = Counter()
    right_of_family: Counter[str] = Counter()
    understood = steps = without_answer = 0
    begun, computing = time.perf_counter(), time.process_time()
    for done, asked in enumerate(questions, start=1):
        reply, text = _answered(answerer, asked, scenes[asked.image])
        steps += 0 if reply is None else sum(1 for _ in reply.justification.walk())
        if on_progress is not None and done % 100 == 0:
            on_progress(done)
        if asked.answer is None:
            without_answer += 1
            continue
        of_family[asked.family] += 1
        understood += reply is not None
        if reply is not None and _is_right(reply.value, asked.answer, things):
            right_of_family[asked.family] += 1
            continue
        wrong.append(
            WrongAnswer(
                place=asked.place,
                question=asked.text,
                answer=asked.answer,
                got=None if reply is None else reply.value,
                text=text,
                understood=None if reply is None else str(reply.query),
            )
        )
    return ThingEvaluation(
        questions=sum(of_family.values()),
        understood=understood,
        right=sum(right_of_family.values()),
        without_answer=without_answer,
        seconds=time.perf_counter() - begun,
        processor_seconds=time.process_time() - computing,
        steps=steps,
        majority=_majority(asked.answer for asked in questions),
        families={
            name: Share(right_of_family[name], count) for name, count in sorted(of_family.items())
        },
        wrong=tuple(wrong),
    )


def _answered(
    answerer: ThingAnswerer, asked: AskedOfScene, scene: ThingScene
) -> tuple[ThingReply | None, str]:
    try:
        reply = answerer.answer(asked.text, scene)
    except QuestionError as problem:
        return None, str(problem)
    return reply, reply.text


def _is_right(value: Value, answer: bool | int | str, things: Things) -> bool:
    """Whether an answer is the annotated one; a value may be annotated by any word for it."""
    if isinstance(answer, str):
        return isinstance(value, str) and any(
            value in feature.values
            and answer in (value, *feature.words[value], *feature.nouns[value])
            for feature in things.features.values()
        )
    return isinstance(value, bool) == isinstance(answer, bool) and value == answer


def _majority(answers: Iterable[bool | int | str | None]) -> Share:
    counted = Counter(repr(answer) for answer in answers if answer is not None)
    return Share(max(counted.values(), default=0), counted.total())
