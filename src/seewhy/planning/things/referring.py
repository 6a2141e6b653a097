"""What a phrase in a goal refers to: things of the scene, or any thing of some values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError, members
from seewhy.dialogue.things.query import Description, HasValue, Reference, References
from seewhy.dialogue.things.reading import QuestionReader
from seewhy.dialogue.things.telling import tell_failure
from seewhy.dialogue.things.wording import ThingWords
from seewhy.errors import PlanningError
from seewhy.planning.things.initial_scene import SceneOfPlan

__all__ = ["Referent", "ThingReferences"]


@dataclass(frozen=True)
class Referent:
    """What a phrase refers to.

    ``terms`` are the things that are meant, all of them; where there are none, any thing is meant
    that has the values of some features.
    """

    terms: tuple[str, ...] = ()
    values: tuple[tuple[str, str], ...] = ()

    def conditions(self, variable: str) -> list[str]:
        """What is asked of a variable that stands for any such thing."""
        asked = []
        for feature, value in self.values:
            if value in ("yes", "no"):
                asked.append(f"{'' if value == 'yes' else '-'}{feature}({variable})")
            else:
                asked.append(f"{feature}({variable}, {value})")
        return asked


class ThingReferences:
    """Reads phrases about the things of a scene.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> phrases = ThingReferences(load_planning_domain("tabletop").at_first)
    >>> phrases.read("the red block").terms, phrases.read("a cube").values
    (('thing1',), (('shape', 'cube'),))
    """

    def __init__(self, at_first: SceneOfPlan) -> None:
        self.at_first = at_first
        self.reader = QuestionReader(at_first.things)
        self._evaluation: Evaluation | None = None

    @property
    def evaluation(self) -> Evaluation:
        """What evaluates phrases in the scene, with what follows in it."""
        if self._evaluation is None:
            self._evaluation = Evaluation(self.at_first.concluded, self.at_first.things)
        return self._evaluation

    def read(self, phrase: str) -> Referent | None:
        """Return what a phrase refers to; None where it is no such phrase.

        Raises
        ------
        PlanningError
            If it speaks of one thing, and there is none, or there are several, which are named.
        """
        unclear: PlanningError | None = None
        for reference in self.reader.references(phrase):
            try:
                return self._referent(reference)
            except UnclearReferenceError as problem:
                said = tell_failure(problem, ThingWords(self.evaluation))
                unclear = unclear or PlanningError(said)
        if unclear is not None:
            raise unclear
        return None

    def _referent(self, reference: Reference) -> Referent:
        if reference.which is References.THE:
            return self._of([self.evaluation.the(reference)])
        found = list(members(self.evaluation.fits(reference.description).surely))
        if reference.which is References.EVERY or len(found) == 1:
            return self._of(found)
        phrase = ThingWords(self.evaluation).phrase(reference.description, many=False)
        if not found:
            raise PlanningError(f"There is no {phrase}.")
        return Referent(values=_values(reference.description, phrase))

    def _of(self, numbers: Sequence[int]) -> Referent:
        return Referent(tuple(map(self.at_first.term, numbers)))


def _values(description: Description, phrase: str) -> tuple[tuple[str, str], ...]:
    """The values that a description asks for, if it asks for nothing else."""
    asked = [found for found in description.conditions if isinstance(found, HasValue)]
    if len(asked) < len(description.conditions) or description.selection is not None:
        raise PlanningError(f"There are several of '{phrase}'; say which, with 'the'.")
    return tuple((condition.feature, condition.value) for condition in asked)
