"""Learn axioms, and judge what is proposed on pictures of which nothing was learned.

Those pictures are training pictures that are held back, by group: what judges here must not be
what `evaluate` judges by, or its figures would flatter from then on.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from seewhy.agent.learning_from_pictures import AnnotatedScenes, Learning, scenes_of
from seewhy.agent.training_pictures import require_same_domain
from seewhy.evaluation.other_knowledge import with_axioms
from seewhy.evaluation.redeciding import classes_of
from seewhy.evaluation.share import Share
from seewhy.induction.axiom_learning import DEFAULTS, LearningOptions
from seewhy.knowledge.learned_file import Withdrawn

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset
    from seewhy.dialogue.reference import Experience
    from seewhy.knowledge.axiom import Axiom

__all__ = ["HELD_BACK", "Judged", "JudgedLearning", "Proposal", "hold_back", "learn_judged"]

HELD_BACK = 0.2
"""The share of the training pictures that judges."""

MOST = 2000
"""So many pictures judge as well as more would."""


@dataclass(frozen=True)
class Judged:
    """How the annotated features of the pictures held back are classified.

    Attributes
    ----------
    right : Share
        Rightly, by the knowledge or, where it decides nothing, by the tree.
    by_knowledge : Share
        Rightly, by the knowledge alone.
    """

    right: Share
    by_knowledge: Share


@dataclass(frozen=True)
class Proposal:
    """An axiom to add, or a given one to set aside, and what that would do.

    Attributes
    ----------
    proposed : Axiom or Withdrawn
        An axiom to add, or what is to be set aside, with the reason.
    before, after : Judged or None
        Without and with what is proposed, besides what was accepted before; None where no picture
        is held back.
    """

    proposed: Axiom | Withdrawn
    before: Judged | None
    after: Judged | None

    @property
    def statement(self) -> str:
        """The axiom that is to be added or set aside."""
        proposed = self.proposed
        return proposed.statement if isinstance(proposed, Withdrawn) else str(proposed)

    @property
    def lost(self) -> int:
        """By how many pictures fewer would be classified rightly; below 0: so many more."""
        if self.before is None or self.after is None:
            return 0
        return self.before.right.right - self.after.right.right

    @property
    def falls(self) -> bool:
        """Whether accuracy would fall."""
        return self.lost > 0


@dataclass(frozen=True)
class JudgedLearning:
    """What came of learning, judged.

    Attributes
    ----------
    agent : Agent
        Knows what was accepted; its tree and answers are trained on all the pictures again.
    learning : Learning
    held_back : int
        Pictures that judged; 0 where there were too few to hold any back.
    learned_from : int
        The other pictures.
    before, after : Judged or None
    judged : tuple of (Proposal, bool)
        Every proposal, and whether it was accepted.
    """

    agent: Agent
    learning: Learning
    held_back: int
    learned_from: int
    before: Judged | None
    after: Judged | None
    judged: tuple[tuple[Proposal, bool], ...]


Change = TypeVar("Change", bound="Axiom | Withdrawn")


def not_worse(proposal: Proposal) -> bool:
    """Accept what does not lower the accuracy on the pictures held back."""
    return not proposal.falls


def learn_judged(
    agent: Agent,
    dataset: Dataset,
    *,
    options: LearningOptions = DEFAULTS,
    accept: Callable[[Proposal], bool] = not_worse,
    seed: int = 0,
    answers: bool = True,
    on_held_back: Callable[[int, int], None] | None = None,
) -> JudgedLearning:
    """Learn as :meth:`seewhy.Agent.learn` does, from four fifths of the pictures to train on.

    The others judge every proposal, one after the other. The tree that decides what the knowledge
    leaves open is trained without them for that. What is accepted is kept, and then tree and
    answers are trained on all pictures. The agent that is given stays as it was.

    Parameters
    ----------
    agent : Agent
    dataset : Dataset
        Of its splits, "train" is used; pictures without a class are not.
    options : LearningOptions
    accept : callable, optional
        Called with each :class:`Proposal`; whether it is to be accepted. What lowers the accuracy
        is not, without it.
    seed : int, default 0
        Of the choice of the pictures held back.
    answers : bool, default True
        False leaves the recurrent network out.
    on_held_back : callable, optional
        Called, before anything is proposed, with the number of pictures held back, and of all.

    Raises
    ------
    DatasetError
        If the dataset is of another domain, or there is one class only.
    """
    require_same_domain(dataset, agent.domain)
    train = dataset.of_split("train").with_class()
    kept, held = hold_back(train, seed=seed)
    if on_held_back is not None:
        on_held_back(len(held), len(train))
    counted = agent.training_pictures.counted
    learner = with_axioms(agent, agent.learned, agent.withdrawn)
    learner.experience = _experience_without(agent, held, counted)
    scenes = scenes_of(kept, learner.experience, counted)
    judged: list[tuple[Proposal, bool]] = []

    def judge(learned: Sequence[Axiom], withdrawn: Sequence[Withdrawn]) -> Judged | None:
        if not len(held):
            return None
        trial = with_axioms(learner, learned, withdrawn)
        trial.fit_induction(scenes.vectors, scenes.labels, answers=False)
        return _judged(trial, held)

    def accepted(axioms: Sequence[Axiom]) -> list[Axiom]:
        return chosen(axioms, lambda some: judge([*learner.learned, *some], learner.withdrawn))

    def set_aside(refuted: Sequence[Withdrawn]) -> list[Withdrawn]:
        return chosen(refuted, lambda some: judge(learner.learned, [*learner.withdrawn, *some]))

    def chosen(
        proposed: Sequence[Change], judge_with: Callable[[Sequence[Change]], Judged | None]
    ) -> list[Change]:
        """Those that are accepted, each judged beside those accepted before it."""
        taken: list[Change] = []
        before = judge_with(taken) if proposed else None
        for change in proposed:
            after = judge_with([*taken, change])
            proposal = Proposal(change, before, after)
            judged.append((proposal, accept(proposal)))
            if judged[-1][1]:
                taken.append(change)
                before = after
        return taken

    first = judge(learner.learned, learner.withdrawn) if _two_classes(scenes) else None
    learning = learner.learn(
        kept, options=options, accept=accepted, set_aside=set_aside, answers=False
    )
    last = _judged(learner, held) if len(held) else None
    everything = scenes_of(train, agent.experience, counted)
    learner.fit_induction(everything.vectors, everything.labels, answers=answers)
    learned_from = frozenset(train.picture_digests())
    learner.trained_on |= learned_from
    learner.without_class -= learned_from
    return JudgedLearning(learner, learning, len(held), len(kept), first, last, tuple(judged))


def hold_back(train: Dataset, *, seed: int = 0) -> tuple[Dataset, Dataset]:
    """Divide pictures into those to learn from and a fifth that judges, groups whole.

    Every class gives its share and keeps pictures to learn from; of a few pictures none may judge.
    """
    from seewhy.perception.validation import split

    share = min(HELD_BACK, MOST / max(1, len(train)))
    kept, held = split(train.labels, share=share, seed=seed, groups=train.groups)
    return train.take(kept.tolist()), train.take(held.tolist())


def _experience_without(agent: Agent, held: Dataset, counted: frozenset[str]) -> Experience:
    """What an agent remembers of its pictures but for those held back."""
    counts = {vector: Counter(labels) for vector, labels in agent.experience.items()}
    rows = zip(held.vectors, held.classes, held.picture_digests(), strict=True)
    for vector, label, digest in rows:
        if digest in counted and counts.get(vector, Counter())[label] > 0:
            counts[vector][label] -= 1
    kept = {vector: dict(+labels) for vector, labels in counts.items()}
    return {vector: labels for vector, labels in kept.items() if labels}


def _judged(agent: Agent, held: Dataset) -> Judged:
    labels = classes_of(agent, held.vectors)
    decisions = agent.reasoner.decide_all(held.vectors)
    right = [
        labels[vector] == true for vector, true in zip(held.vectors, held.classes, strict=True)
    ]
    known = [decision.label == true for decision, true in zip(decisions, held.classes, strict=True)]
    return Judged(Share(sum(right), len(held)), Share(sum(known), len(held)))


def _two_classes(scenes: AnnotatedScenes) -> bool:
    return len(set(scenes.labels)) > 1
