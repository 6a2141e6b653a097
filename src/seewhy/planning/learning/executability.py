"""What an action usually does not achieve, as an executability condition with its exceptions."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import Candidate, tally
from seewhy.induction.scene_table import SceneTable
from seewhy.induction.tree import PathCondition
from seewhy.planning.learning.candidates import AS_OFTEN_WRONG, is_usual
from seewhy.planning.learning.features import NO, ArgumentFeatures
from seewhy.planning.learning.learned_defaults import (
    argument_terms,
    condition_parts,
    values_left_out,
)

__all__ = ["exceptions_in", "impossible_statement"]


def exceptions_in(
    candidate: Candidate, features: ArgumentFeatures, table: SceneTable
) -> Iterator[str]:
    """Yield the features whose conditions only make exceptions of what is usual without them.

    Without such a condition a candidate is still right more often than wrong; what the condition
    leaves out usually works.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.learning.relations import Attribute
    >>> known = read_knowledge("#sort box = {b}. #sort extent = {big, tiny}. "
    ...     "#static size(box, extent). #static full(box). #action lift(box).")
    >>> size, values = Attribute("size", (0, None)), {"size(0, ?)": ("big", "tiny")}
    >>> features = ArgumentFeatures(signature=known.signature, predicate="lift", relations={},
    ...     places={}, values=values, same={}, attributes={"size(0, ?)": size})
    >>> tries = [("big",)] * 20 + [("tiny",)] * 6
    >>> table = scene_table(values, tries, ["yes"] * 20 + ["no"] * 6)
    >>> heavy = Candidate("yes", (PathCondition("size(0, ?)", ("big",)),))
    >>> list(exceptions_in(heavy, features, table))
    ['size(0, ?)']
    >>> impossible_statement(heavy, features, unless=["size(0, ?)"])
    'impossible lift(B) if not size(B, tiny).'
    """
    for condition in candidate.conditions:
        if condition.feature not in features.attributes:
            continue
        others = tuple(other for other in candidate.conditions if other != condition)
        general = Candidate(candidate.label, others)
        left_out = PathCondition(condition.feature, tuple(values_left_out(condition, features)))
        works = tally(Candidate(NO, (*others, left_out)), table)
        is_exception = at_least(works.right, works.right + works.wrong, 0.5) <= AS_OFTEN_WRONG
        if is_exception and is_usual(general, table):
            yield condition.feature


def impossible_statement(
    candidate: Candidate, features: ArgumentFeatures, *, unless: Collection[str] = ()
) -> str:
    """Return the axiom that says what one of :func:`.learned_defaults.single` says of an action."""
    terms = argument_terms(candidate, features)
    parts = condition_parts(candidate, features, terms, unless=unless)
    action = f"{features.predicate}({', '.join(terms)})" if terms else features.predicate
    return f"impossible {action}{' if ' if parts else ''}{', '.join(parts)}."
