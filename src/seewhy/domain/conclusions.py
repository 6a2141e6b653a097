"""What axioms conclude of each thing, and of several together, checked against the knowledge."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.domain.key_place import KeyPlace
from seewhy.domain.thing_tables import ConclusionTable, GroupTable, ThingsTable
from seewhy.errors import DomainError
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.text.nearest import did_you_mean
from seewhy.text.nouns import plural, with_article

__all__ = ["Conclusion", "Group", "read_conclusion", "read_group"]


@dataclass(frozen=True)
class Conclusion:
    """What axioms conclude of a thing; the attributes are those of domain.toml."""

    key: str
    say: str
    deny: str
    words: tuple[str, ...] = ()
    verbs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Group:
    """What axioms conclude of so many things together, in whatever order.

    Attributes
    ----------
    key : str
    size : int
        How many things it takes.
    one, many : str
        The noun for such a group, and for several.
    words : tuple of str
        Nouns for it, in the singular, ``one`` first.
    say, deny : str
        The clauses that say and deny it, with {them}.
    """

    key: str
    size: int
    one: str
    many: str
    words: tuple[str, ...]
    say: str
    deny: str


def read_conclusion(
    key: str, table: ConclusionTable, things: ThingsTable, knowledge: Knowledge, place: KeyPlace
) -> Conclusion:
    """Return what ``[things.conclusions.NAME]`` says.

    Raises
    ------
    DomainError
        Where knowledge.al declares it otherwise or not at all, or it is seen.
    """
    here = ("things", "conclusions", key)
    predicate = _concluded(key, here, things, knowledge, place)
    if predicate.sorts != (things.sort,):
        raise DomainError(
            f"{place.at(*here)}: the conclusion '{key}' must be declared as '#static "
            f"{key}({things.sort}).', got '{predicate}' ({predicate.location})"
        )
    deny = table.deny or f"it is not so that {table.say}"
    return Conclusion(key, table.say, deny, table.words, table.verbs)


def read_group(
    key: str, table: GroupTable, things: ThingsTable, knowledge: Knowledge, place: KeyPlace
) -> Group:
    """Return what ``[things.groups.NAME]`` says.

    Raises
    ------
    DomainError
        Where knowledge.al declares it otherwise or not at all, or it is seen.
    """
    here = ("things", "groups", key)
    predicate = _concluded(key, here, things, knowledge, place)
    size = len(predicate.sorts)
    if size < 2 or set(predicate.sorts) != {things.sort}:
        raise DomainError(
            f"{place.at(*here)}: the group '{key}' must be declared of two things or more, as in "
            f"'#static {key}({things.sort}, {things.sort}, {things.sort}).', got '{predicate}' "
            f"({predicate.location})"
        )
    one = table.one or key.replace("_", " ")
    words = tuple(dict.fromkeys((one, *table.words)))
    say = table.say or f"{{them}} are {with_article(one)}"
    deny = f"it is not so that {table.say}" if table.say else f"{{them}} are no {one}"
    deny = table.deny or deny
    return Group(key, size, one, table.many or plural(one), words, say, deny)


def _concluded(
    key: str,
    here: tuple[str, ...],
    things: ThingsTable,
    knowledge: Knowledge,
    place: KeyPlace,
) -> Predicate:
    predicates = knowledge.signature.predicates
    predicate = predicates.get(key)
    what = here[1].removesuffix("s")
    if predicate is None:
        raise DomainError(
            f"{place.at(*here)}: the {what} '{key}' is not declared in knowledge.al; "
            f"{did_you_mean(key, predicates)}"
        )
    if predicate.kind is not PredicateKind.STATIC:
        raise DomainError(
            f"{place.at(*here)}: the {what} '{key}' must be declared as a static, got "
            f"'#{predicate.kind.value} {predicate}' ({predicate.location})"
        )
    if key in things.features or key in things.relations:
        seen = "feature" if key in things.features else "relation"
        raise DomainError(
            f"{place.at(*here)}: '{key}' is a {seen} of things, too; leave one of the two out"
        )
    return predicate
