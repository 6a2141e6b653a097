"""Print how many questions of CLEVR's kind are answered rightly from pictures alone.

    python -m seewhy_lab questions_from_pictures MODEL --data tables --scenes scenes.json \
        --questions questions.json

The wordings come from a file of questions in CLEVR's format; what they were asked about there does
not matter. Of every picture that is kept for evaluation, families of questions are gone through in
random order, and the first wording of each that has an answer in what is annotated of the picture
is asked, until so many are. The same is then
asked of what the model sees in the picture, and both answers are compared. A question that is
answered in the annotated scene and not in the one that was seen counts as wrong.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seewhy.agent.things.thing_agent import ThingAgent
from seewhy.cli.screen import complain, output, say, table
from seewhy.data.dataset import Dataset
from seewhy.data.importers.clevr import read_questions, read_scenes
from seewhy.data.scene import Scene
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.scene_beliefs import SceneBeliefs
from seewhy.dialogue.things.answering import ThingAnswerer
from seewhy.dialogue.things.outcome import Value
from seewhy.errors import QuestionError, SeeWhyError
from seewhy.evaluation.share import Share
from seewhy.text.percentage import percent

__all__ = ["Compared", "asked_of", "compared", "main"]

_EACH = 10


@dataclass(frozen=True)
class Compared:
    """A question about a picture.

    Attributes
    ----------
    family : str
        Which questions are made like it.
    question : str
    annotated, seen : bool, int, str, tuple or None
        The answer from what is annotated, and from what the model saw.
    """

    family: str
    question: str
    annotated: Value
    seen: Value

    @property
    def is_right(self) -> bool:
        """Whether both answers are the same, of the same kind."""
        return type(self.annotated) is type(self.seen) and self.annotated == self.seen


def asked_of(
    wordings: Mapping[str, Sequence[str]],
    scene: ThingScene,
    answerer: ThingAnswerer,
    *,
    each: int,
    generator: np.random.Generator,
) -> Iterator[tuple[str, str, Value]]:
    """Yield up to ``each`` wordings that have an answer in a scene, no two of one family.

    Yields
    ------
    family, question : str
    answer : bool, int, str or tuple
    """
    asked = 0
    for number in generator.permutation(len(wordings)):
        family = list(wordings)[number]
        for question in generator.permutation(list(wordings[family])).tolist():
            answer = _answer(answerer, question, scene)
            if answer is not None:
                yield family, question, answer
                asked += 1
                break
        if asked == each:
            return


def _answer(answerer: ThingAnswerer, question: str, scene: ThingScene) -> Value:
    try:
        return answerer.answer(question, scene).value
    except QuestionError:
        return None


def compared(
    agent: ThingAgent,
    dataset: Dataset,
    wordings: Mapping[str, Sequence[str]],
    *,
    each: int,
    seed: int,
) -> list[Compared]:
    """Ask of every picture what is annotated of it, and what is seen in it."""
    answerer = ThingAnswerer(agent.things)
    generator = np.random.default_rng(seed)
    found: list[Compared] = []
    readings = agent.read_all([scene.picture for scene in dataset.scenes])
    for scene, reading in zip(dataset.scenes, readings, strict=True):
        seen = agent.scene_of(reading).scene
        true = _annotated(agent, scene)
        found += [
            Compared(family, question, answer, _answer(answerer, question, seen))
            for family, question, answer in asked_of(
                wordings, true, answerer, each=each, generator=generator
            )
        ]
    return found


def _annotated(agent: ThingAgent, scene: Scene) -> ThingScene:
    domain = agent.domain
    vector = vector_with_things(domain, scene.vector, scene.things, scene.related)
    names = [thing.name for thing in scene.things]
    return SceneBeliefs(domain, vector, names, reasoner=agent.reasoner).scene


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        "python -m seewhy_lab questions_from_pictures",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("model", type=Path)
    parser.add_argument("--data", type=Path, required=True, help="A dataset with things.")
    parser.add_argument("--scenes", type=Path, required=True, help="Scenes in CLEVR's format.")
    parser.add_argument("--questions", type=Path, required=True, help="Questions about these.")
    parser.add_argument("--each", type=int, default=_EACH, help="Questions about a picture.")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    try:
        agent = ThingAgent.load(options.model)
        dataset = Dataset.load(options.data, agent.domain).of_split("test")
        questions = read_questions(options.questions, read_scenes(options.scenes, agent.things))
        wordings: dict[str, list[str]] = defaultdict(list)
        for question in questions:
            wordings[question.family].append(question.text)
        found = compared(agent, dataset, wordings, each=options.each, seed=options.seed)
    except SeeWhyError as problem:
        complain(str(problem))
        sys.exit(2)
    _print(found, pictures=len(dataset))


def _print(found: Sequence[Compared], *, pictures: int) -> None:
    kinds: dict[str, list[Compared]] = defaultdict(list)
    for asked in found:
        kinds[asked.family.rpartition(" ")[0] or asked.family].append(asked)
    rows = table("questions like", ">questions", ">right", ">the most frequent answer")
    for kind in sorted(kinds):
        rows.add_row(kind, str(len(kinds[kind])), _right(kinds[kind]), _majority(kinds[kind]))
    rows.add_row("all", str(len(found)), _right(found), _majority(found))
    output().print(rows)
    right = Share(sum(asked.is_right for asked in found), len(found))
    low, high = right.interval
    say(
        f"{pictures} pictures; {right.right} of {right.of} right, 95 % interval "
        f"{percent(low)} to {percent(high)}"
    )


def _right(asked: Sequence[Compared]) -> str:
    return percent(Share(sum(question.is_right for question in asked), len(asked)).value)


def _majority(asked: Sequence[Compared]) -> str:
    counted = Counter(repr(question.annotated) for question in asked)
    return percent(Share(max(counted.values(), default=0), len(asked)).value)


if __name__ == "__main__":
    main()
