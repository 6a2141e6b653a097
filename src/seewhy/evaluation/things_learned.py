"""Learn axioms about things, and judge what is proposed on pictures that proposed nothing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.things.thing_axioms import (
    as_few_things,
    axioms_of_rules,
    contradicted_by_scenes,
    decided,
    learn_rules_for_domain,
    with_axioms_about_things,
)
from seewhy.agent.training_pictures import require_same_domain
from seewhy.errors import DatasetError, DomainError
from seewhy.evaluation.held_back import Judged, Proposal, hold_back, not_worse
from seewhy.evaluation.share import Share
from seewhy.induction.things.rule_learning import JudgedRule, ThingLearningOptions

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.domain.domain import Domain
    from seewhy.knowledge.axiom import Axiom
    from seewhy.knowledge.learned_file import Withdrawn

__all__ = ["FEWEST", "LearnedAboutThings", "learn_about_things"]

FEWEST = 20
"""From fewer pictures nothing is learned that would be more than an accident."""

_DEFAULTS = ThingLearningOptions()


@dataclass(frozen=True)
class LearnedAboutThings:
    """What came of learning from scenes of things.

    Attributes
    ----------
    domain : Domain
        Knows what was accepted.
    found, added : tuple of Axiom
        Those that were proposed, and those of them that were accepted.
    withdrawn : tuple of Withdrawn
        Axioms that were learned before, and that the pictures speak against.
    judgements : tuple of JudgedRule
        All rules that were looked at, with the reason why one became no axiom.
    held_back, learned_from : int
        Pictures that judged, and the others.
    before, after : Judged or None
        How the annotated scenes held back are classified, without and with what was accepted.
    judged : tuple of (Proposal, bool)
        Every proposal, and whether it was accepted.
    """

    domain: Domain
    found: tuple[Axiom, ...]
    added: tuple[Axiom, ...]
    withdrawn: tuple[Withdrawn, ...]
    judgements: tuple[JudgedRule, ...]
    held_back: int
    learned_from: int
    before: Judged | None
    after: Judged | None
    judged: tuple[tuple[Proposal, bool], ...]


def learn_about_things(
    domain: Domain,
    dataset: Dataset,
    *,
    options: ThingLearningOptions = _DEFAULTS,
    accept: Callable[[Proposal], bool] = not_worse,
    on_held_back: Callable[[int, int], None] | None = None,
) -> LearnedAboutThings:
    """Learn from annotated scenes which things make a picture be of a class.

    Axioms ask what there is in a picture (one to three things, what they are and how they stand
    to each other), how much of it, and what there is not. A fifth of the pictures proposes
    nothing and judges what the others propose.

    Parameters
    ----------
    domain : Domain
        With ``[things]`` and classes. Those of its axioms that were learned before are withdrawn
        where the pictures speak against them.
    dataset : Dataset
        Of its splits, "train" is used; pictures without a class are not.
    options : ThingLearningOptions
    accept : callable, optional
        Called with each :class:`~seewhy.evaluation.held_back.Proposal`; whether it is to be
        accepted. What lowers the accuracy is not, without it.
    on_held_back : callable, optional
        Called, before anything is proposed, with the number of pictures held back, and of all.

    Raises
    ------
    DomainError
        If the domain has no things, or fewer than two classes.
    DatasetError
        If the dataset is of another domain, too few pictures have a class, all have the same one,
        or none shows a thing.

    Examples
    --------
    >>> import seewhy
    >>> tabletop = seewhy.load_domain("tabletop")
    >>> seewhy.learn_about_things(tabletop, None)
    Traceback (most recent call last):
    ...
    seewhy.errors.DomainError: the domain 'tabletop' has 0 classes, and axioms are learned to tell \
two or more apart; add them under [classes] of its domain.toml
    """
    _require_classes(domain)
    require_same_domain(dataset, domain)
    train = dataset.of_split("train").with_class()
    _require_scenes(train)
    kept, held = hold_back(train, seed=options.seed)
    if on_held_back is not None:
        on_held_back(len(held), len(train))
    few, everything = as_few_things(domain, _scenes([*_rows(kept), *_rows(held)]))
    scenes, judges = _divided(everything, len(kept))
    withdrawn = contradicted_by_scenes(few, scenes, tolerance=options.tolerance or 0.0)
    less = with_axioms_about_things(few, (), without=withdrawn)
    judgements = learn_rules_for_domain(less, scenes, options)
    found = axioms_of_rules(less, judgements, scenes)
    judged: list[tuple[Proposal, bool]] = []
    added: list[Axiom] = []
    first = _judged(few, judges)
    before = _judged(less, judges)
    for axiom in found:
        after = _judged(with_axioms_about_things(less, [*added, axiom]), judges)
        proposal = Proposal(axiom, before, after)
        judged.append((proposal, accept(proposal)))
        if judged[-1][1]:
            added.append(axiom)
            before = after
    return LearnedAboutThings(
        domain=with_axioms_about_things(domain, added, without=withdrawn),
        found=found,
        added=tuple(added),
        withdrawn=tuple(withdrawn),
        judgements=judgements,
        held_back=len(held),
        learned_from=len(kept),
        before=first,
        after=before,
        judged=tuple(judged),
    )


_Row = tuple[tuple[str | None, ...], str, str]


def _rows(dataset: Dataset) -> list[_Row]:
    names = [dataset.name_of(scene) for scene in dataset.scenes]
    return list(zip(dataset.vectors, dataset.classes, names, strict=True))


def _scenes(rows: Sequence[_Row]) -> AnnotatedScenes:
    vectors, labels, pictures = (tuple(column) for column in zip(*rows, strict=True))
    return AnnotatedScenes(vectors, labels, pictures)


def _divided(scenes: AnnotatedScenes, count: int) -> tuple[AnnotatedScenes, AnnotatedScenes]:
    """The first scenes, and the others."""
    parts = (slice(None, count), slice(count, None))
    first, others = (
        AnnotatedScenes(scenes.vectors[part], scenes.labels[part], scenes.pictures[part])
        for part in parts
    )
    return first, others


def _judged(domain: Domain, scenes: AnnotatedScenes) -> Judged | None:
    if not scenes.labels:
        return None
    labels = decided(domain, scenes.vectors)
    right = sum(label == true for label, true in zip(labels, scenes.labels, strict=True))
    share = Share(right, len(scenes.labels))
    return Judged(share, share)


def _require_classes(domain: Domain) -> None:
    if domain.things is None:
        raise DomainError(
            f"the domain '{domain.name}' has no things; train a model of it, and learn with "
            "'seewhy learn MODEL' (in Python: Agent.learn)"
        )
    if len(domain.classes) < 2:
        count = f"{len(domain.classes)} class{'' if len(domain.classes) == 1 else 'es'}"
        raise DomainError(
            f"the domain '{domain.name}' has {count}, and axioms are learned to tell two or more "
            "apart; add them under [classes] of its domain.toml"
        )


def _require_scenes(dataset: Dataset) -> None:
    file = dataset.table.name
    if not len(dataset):
        raise DatasetError(
            f"{file}: no row has a class, of which axioms are learned; fill the column 'class'"
        )
    if len(dataset) < FEWEST:
        raise DatasetError(
            f"{file}: {len(dataset)} pictures have a class, and axioms about things are learned "
            f"from {FEWEST} or more; annotate further ones"
        )
    classes = sorted(set(dataset.classes))
    if len(classes) < 2:
        raise DatasetError(
            f"{file}: all {len(dataset)} pictures are of the class '{classes[0]}', and axioms are "
            "learned to tell classes apart; annotate pictures of another one"
        )
    if not any(scene.things for scene in dataset.scenes):
        raise DatasetError(
            f"{dataset.folder}: no picture has things; list them in things.csv, a row a thing"
        )
