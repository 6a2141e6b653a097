"""Statics of the picture that are no features, and how their values are said."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from seewhy.domain.key_place import KeyPlace
from seewhy.domain.tables import BeliefTable, DomainFile
from seewhy.errors import DomainError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.text.nearest import did_you_mean
from seewhy.text.predicate_words import named_clause

__all__ = ["Belief", "read_beliefs"]


@dataclass(frozen=True)
class Belief:
    """A static of the scene that is no feature: its value is believed, not seen.

    One without a second argument has the values "yes" and "no". ``say`` has the slots {it} and
    {value}; ``words`` says each value, ``literals`` stands for it.
    """

    key: str
    name: str
    say: str
    words: Mapping[str, str]
    literals: Mapping[str, Literal]
    acts: tuple[str, ...] = ()

    @property
    def is_yes_or_no(self) -> bool:
        """Whether it is so or not, and has no other values."""
        return any(not literal.positive for literal in self.literals.values())


def read_beliefs(
    file: DomainFile, of_classes: Collection[str], knowledge: Knowledge, place: KeyPlace
) -> dict[str, Belief]:
    """Return the statics of the scene, by themselves or with one sort, that are no features.

    ``of_classes`` are the predicates that stand for classes.

    Raises
    ------
    DomainError
        Where [beliefs.NAME] names no such static, or a value that it does not have.
    """
    scene = file.domain.scene
    predicates = {
        name: predicate
        for name, predicate in knowledge.signature.predicates.items()
        if predicate.kind is PredicateKind.STATIC
        and predicate.sorts[:1] == (scene,)
        and (len(predicate.sorts) == 2 or (len(predicate.sorts) == 1 and name not in of_classes))
        and name not in file.features
    }
    for key in file.beliefs:
        if key in predicates:
            continue
        here = place.at("beliefs", key)
        if key in file.features:
            raise DomainError(
                f"{here}: '{key}' is a feature, which is seen and not believed; say its values "
                f"under [features.{key}.values] and remove [beliefs.{key}]"
            )
        declared = knowledge.signature.predicates.get(key)
        if declared is None:
            raise DomainError(
                f"{here}: the belief '{key}' is not declared in knowledge.al; "
                f"{did_you_mean(key, predicates)}"
            )
        raise DomainError(
            f"{here}: the belief '{key}' must be declared as '#static {key}({scene}, SORT).' or, "
            f"where it is no class, '#static {key}({scene}).', got '{declared}' "
            f"({declared.location})"
        )
    beliefs: dict[str, Belief] = {}
    for key, predicate in predicates.items():
        table = file.beliefs.get(key, BeliefTable())
        literals = _literals(key, predicate, scene, knowledge)
        for value in table.values:
            if value not in literals:
                raise DomainError(
                    f"{place.at('beliefs', key, 'values', value)}: '{value}' is no value of "
                    f"'{key}' in knowledge.al; {did_you_mean(value, literals)}"
                )
        say, words = _said(key, table, literals)
        beliefs[key] = Belief(
            key=key,
            name=table.name or key.replace("_", " "),
            say=say,
            words=MappingProxyType(words),
            literals=MappingProxyType(literals),
            acts=table.acts,
        )
    return beliefs


def _literals(
    key: str, predicate: Predicate, scene: str, knowledge: Knowledge
) -> dict[str, Literal]:
    """Value of a static of the scene → the literal that stands for it."""
    if len(predicate.sorts) == 1:
        holds = Literal(predicate=key, arguments=(scene,))
        return {"yes": holds, "no": holds.complement}
    return {
        value: Literal(predicate=key, arguments=(scene, value))
        for value in knowledge.signature.members(predicate.sorts[1])
    }


def _said(
    key: str, table: BeliefTable, literals: Mapping[str, Literal]
) -> tuple[str, dict[str, str]]:
    """The clause that says a value of a belief, and its values in words."""
    if any(not literal.positive for literal in literals.values()):
        holds, denied = (clause.removeprefix("{0} ") for clause in named_clause(key, 1))
        words = {"yes": holds, "no": denied, **table.values}
        return table.say or "{it} {value}", words
    words = {
        value: table.values.get(value, value.strip('"').replace("_", " ")) for value in literals
    }
    if table.name is not None and table.say is None:
        return f"the {table.name} of {{it}} is {{value}}", words
    clause, _ = named_clause(key, 2)
    return table.say or clause.replace("{0}", "{it}").replace("{1}", "{value}"), words
