"""A feature of a domain: its values, how they are said, and what each lets believe."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from seewhy.domain.key_place import KeyPlace
from seewhy.domain.tables import (
    CLASS,
    NO_THINGS,
    RESERVED,
    SCENE,
    TOGETHER,
    DomainFile,
    FeatureTable,
)
from seewhy.errors import DomainError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Predicate
from seewhy.knowledge.things import literals_about
from seewhy.text.nearest import did_you_mean


@dataclass(frozen=True)
class Feature:
    """A feature: its values and how they are said.

    ``literals`` gives for every value the literal that is believed when the value is seen.
    """

    key: str
    name: str
    values: tuple[str, ...]
    say: Mapping[str, str]
    words: Mapping[str, tuple[str, ...]]
    change: Mapping[str, str]
    threshold: float
    channels: tuple[int, ...] | None
    dense: int | None
    change_cost: int
    literals: Mapping[str, Literal]


def feature_of_table(
    key: str, table: FeatureTable, file: DomainFile, knowledge: Knowledge, place: KeyPlace
) -> Feature:
    """Return the feature of a table, checked against the knowledge.

    Raises
    ------
    DomainError
        If its name is taken, or knowledge.al declares it or its values otherwise.
    """
    predicate = _declared(key, file, knowledge, place)
    literals = literals_about(predicate, (file.domain.scene,), knowledge.signature)
    _check_values(key, table, literals, place)
    tables = {value: table.values[value] for value in literals}
    return Feature(
        key=key,
        name=table.name,
        values=tuple(literals),
        say=MappingProxyType({value: value_table.say for value, value_table in tables.items()}),
        words=MappingProxyType(
            {value: (*value_table.words, value) for value, value_table in tables.items()}
        ),
        change=MappingProxyType(
            {
                value: value_table.change
                for value, value_table in tables.items()
                if value_table.change
            }
        ),
        threshold=table.threshold,
        channels=table.channels,
        dense=table.dense,
        change_cost=table.change_cost,
        literals=MappingProxyType(literals),
    )


def _declared(key: str, file: DomainFile, knowledge: Knowledge, place: KeyPlace) -> Predicate:
    """The predicate that stands for a feature."""
    predicate = knowledge.signature.predicates.get(key)

    def here() -> str:
        # Finding a line reads the file anew: only where there is something to say about it.
        return place.at("features", key)

    scene = file.domain.scene
    if key in (CLASS, TOGETHER):
        raise DomainError(
            f"{here()}: '{key}' is what other networks than a feature's are called; call the "
            "feature otherwise"
        )
    if key == SCENE or key in file.classes:
        raise DomainError(
            f"{here()}: '{key}' is what "
            f"{'a whole picture' if key == SCENE else 'a class of this domain'} is called; call "
            "the feature otherwise"
        )
    if key in RESERVED or (key == NO_THINGS and file.things is not None):
        raise DomainError(
            f"{here()}: '{key}' is what another column of scenes.csv is called; call the feature "
            "otherwise"
        )
    if predicate is None:
        raise DomainError(
            f"{here()}: the feature '{key}' is not declared in knowledge.al; "
            f"{did_you_mean(key, knowledge.signature.predicates)}"
        )
    if not predicate.sorts or predicate.sorts[0] != scene or len(predicate.sorts) > 2:
        raise DomainError(
            f"{here()}: the feature '{key}' must be declared as '#static {key}({scene}).' (yes or "
            f"no) or '#static {key}({scene}, SORT).', got '{predicate}' "
            f"({predicate.location})"
        )
    return predicate


def _check_values(
    key: str, table: FeatureTable, literals: Mapping[str, Literal], place: KeyPlace
) -> None:
    """Refuse values without words, and words without a value."""
    for value in table.values:
        if value not in literals:
            raise DomainError(
                f"{place.at('features', key, 'values', value)}: '{value}' is no value of "
                f"'{key}' in knowledge.al; {did_you_mean(value, literals)}"
            )
    for value in literals:
        if value not in table.values:
            raise DomainError(
                f"{place.at('features', key)}: nothing says how '{key}' = '{value}' is said; add "
                f'[features.{key}.values.{value}] with say = "…"'
            )
