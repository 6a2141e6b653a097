"""A class of a domain: the literal that stands for it, and how it is said."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from seewhy.domain.key_place import KeyPlace
from seewhy.domain.tables import ClassTable, DomainFile
from seewhy.errors import DomainError, KnowledgeError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_literal
from seewhy.text.nearest import did_you_mean


@dataclass(frozen=True)
class SceneClass:
    """A class of scenes: the literal that stands for it and how it is said."""

    key: str
    literal: Literal
    say: str
    words: tuple[str, ...]
    verbs: tuple[str, ...] = ()


def class_of_table(
    key: str, table: ClassTable, file: DomainFile, knowledge: Knowledge, place: KeyPlace
) -> SceneClass:
    """Return the class of a table, checked against the knowledge.

    Raises
    ------
    DomainError
        If its literal cannot be read, or is none of knowledge.al.
    """

    def here() -> str:
        # Finding a line reads the file anew: only where there is something to say about it.
        return place.at("classes", key, "literal")

    scene = file.domain.scene
    try:
        literal = read_literal(table.literal)
    except KnowledgeError as problem:
        raise DomainError(f"{here()}: {problem}") from None
    predicates = knowledge.signature.predicates
    if literal.predicate not in predicates:
        raise DomainError(
            f"{here()}: the literal '{literal}' of class '{key}' uses '{literal.predicate}', which "
            f"knowledge.al does not declare; {did_you_mean(literal.predicate, predicates)}"
        )
    sorts = predicates[literal.predicate].sorts
    if len(sorts) != len(literal.arguments):
        raise DomainError(
            f"{here()}: '{literal.predicate}' takes {len(sorts)} "
            f"argument{'s' * (len(sorts) != 1)}, got '{literal}'"
        )
    arguments = []
    for argument, sort in zip(literal.arguments, sorts, strict=True):
        members = (scene,) if sort == scene else knowledge.signature.members(sort)
        term = scene if sort == scene and argument[0].isupper() else argument
        if term not in members:
            raise DomainError(
                f"{here()}: '{argument}' is not of sort '{sort}' in the literal '{literal}'; "
                f"{did_you_mean(argument, members)}"
            )
        arguments.append(term)
    return SceneClass(
        key=key,
        literal=Literal(
            predicate=literal.predicate, arguments=tuple(arguments), positive=literal.positive
        ),
        say=table.say,
        words=table.words or (table.say,),
        verbs=table.verbs,
    )


def check_literals(classes: Mapping[str, SceneClass], place: KeyPlace) -> None:
    """Refuse a literal that stands for two classes."""
    keys: dict[Literal, str] = {}
    for key, scene_class in classes.items():
        first = keys.setdefault(scene_class.literal, key)
        if first != key:
            raise DomainError(
                f"{place.at('classes', key, 'literal')}: the literal '{scene_class.literal}' "
                f"stands for the classes '{first}' and '{key}'; no scene could be one of them and "
                "not the other, give each class a literal of its own"
            )
