"""A belief of a domain: what is concluded of a scene, beside its class, and how it is said."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from seewhy.domain.key_place import KeyPlace
from seewhy.domain.tables import BeliefTable, DomainFile
from seewhy.errors import DomainError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.text.nearest import did_you_mean


@dataclass(frozen=True)
class Belief:
    """A static ``key(scene, sort)`` that is no feature: its value is believed, not seen.

    ``say`` has the slots {it} and {value}; ``words`` says each value, ``literals`` stands for it.
    """

    key: str
    name: str
    say: str
    words: Mapping[str, str]
    literals: Mapping[str, Literal]
    acts: tuple[str, ...] = ()


def beliefs_of_file(file: DomainFile, knowledge: Knowledge, place: KeyPlace) -> dict[str, Belief]:
    """Every static of the scene and one sort that is no feature, with its words.

    Raises
    ------
    DomainError
        If a table of beliefs, or a value of one, is none of knowledge.al.
    """
    scene = file.domain.scene
    predicates = {
        name: predicate
        for name, predicate in knowledge.signature.predicates.items()
        if predicate.kind is PredicateKind.STATIC
        and len(predicate.sorts) == 2
        and predicate.sorts[0] == scene
        and name not in file.features
    }
    _check_declared(file, knowledge, predicates, place)
    beliefs: dict[str, Belief] = {}
    for key, predicate in predicates.items():
        table = file.beliefs.get(key, BeliefTable())
        members = knowledge.signature.members(predicate.sorts[1])
        for value in table.values:
            if value not in members:
                raise DomainError(
                    f"{place.at('beliefs', key, 'values', value)}: '{value}' is no value of "
                    f"'{key}' in knowledge.al; {did_you_mean(value, members)}"
                )
        name = table.name or key.replace("_", " ")
        beliefs[key] = Belief(
            key=key,
            name=name,
            say=table.say or f"the {name} of {{it}} is {{value}}",
            words=MappingProxyType(
                {
                    value: table.values.get(value, value.strip('"').replace("_", " "))
                    for value in members
                }
            ),
            literals=MappingProxyType(
                {value: Literal(predicate=key, arguments=(scene, value)) for value in members}
            ),
            acts=table.acts,
        )
    return beliefs


def _check_declared(
    file: DomainFile, knowledge: Knowledge, predicates: Mapping[str, Predicate], place: KeyPlace
) -> None:
    """Refuse words for what is no belief."""
    scene = file.domain.scene
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
            f"{here}: the belief '{key}' must be declared as '#static {key}({scene}, SORT).', "
            f"got '{declared}' ({declared.location})"
        )
