"""Things that a picture shows: their features and relations, checked against the knowledge."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from seewhy.domain.conclusions import Conclusion, Group, read_conclusion, read_group
from seewhy.domain.key_place import KeyPlace
from seewhy.domain.thing_tables import Measure, RelationTable, ThingFeatureTable, ThingsTable
from seewhy.domain.whole_picture import WholePicture
from seewhy.errors import DomainError
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.text.nearest import did_you_mean
from seewhy.text.nouns import plural, with_article

__all__ = ["CONCLUDED", "RESERVED", "SEEN", "Relation", "ThingFeature", "Things", "read_things"]

RESERVED = ("image", "thing", "left", "top", "right", "bottom", "kind", "x", "y", "z")
"""Columns of things.csv that are no features."""

SEEN = "seen"
"""The measure of a relation that a head on the two things sees."""

CONCLUDED = "axioms"
"""The measure of a relation that only axioms conclude."""


@dataclass(frozen=True)
class ThingFeature:
    """A feature of things.

    Attributes
    ----------
    key, name : str
        In the knowledge, and in answers.
    values : tuple of str
        In the order of the sort; yes and no where there is none.
    say : mapping
        Value → the clause that says it, with {it}.
    words, nouns : mapping
        Value → the adjectives and the nouns by which questions may name it.
    behind : mapping
        Value → what stands behind the noun instead of an adjective; of others nothing.
    called : tuple of str
        The words for the feature itself, its name first.
    how, participles : tuple of str
        As in domain.toml.
    ordered : bool
        Whether ``values`` go from the least to the most.
    """

    key: str
    name: str
    values: tuple[str, ...]
    say: Mapping[str, str]
    words: Mapping[str, tuple[str, ...]]
    nouns: Mapping[str, tuple[str, ...]]
    called: tuple[str, ...]
    how: tuple[str, ...] = ()
    participles: tuple[str, ...] = ()
    ordered: bool = False
    behind: Mapping[str, str] = field(default_factory=dict)

    def value_called(self, said: str) -> str | None:
        """Return the value of a name or of one of its words; None of none, or of several.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> colour = load_domain("tabletop").things.features["colour"]
        >>> colour.value_called("Grey"), colour.value_called("mauve")
        ('gray', None)
        """
        if said in self.values:
            return said
        word = said.casefold()
        called = [
            value
            for value in self.values
            if any(
                word == known.casefold()
                for known in (value, *self.words[value], *self.nouns[value])
            )
        ]
        return called[0] if len(called) == 1 else None


@dataclass(frozen=True)
class Relation:
    """What may hold between two things; the attributes are those of domain.toml."""

    key: str
    measure: Measure
    say: str
    words: tuple[str, ...] = ()
    verbs: tuple[str, ...] = ()
    most: tuple[str, ...] = ()
    side: tuple[str, ...] = ()
    converse: str | None = None
    removed: str | None = None


@dataclass(frozen=True)
class Things:
    """What a domain says of the things in its pictures.

    Attributes
    ----------
    sort : str
        The sort that stands for them.
    most : int
        The most things that a picture may show.
    one, many : str
        The noun for one of them, and for several.
    words : tuple of str
        Nouns for any of them, in the singular, ``one`` first.
    features : mapping of str to ThingFeature
    relations : mapping of str to Relation
    support : str or None
        The relation of a thing to what it stands on.
    conclusions : mapping of str to Conclusion
        What axioms conclude of each thing.
    groups : mapping of str to Group
        What axioms conclude of several things together.
    detector : str or None
        A file of the domain's folder that finds them.
    whole : WholePicture
        What the picture that shows them is called, and of which classes it may be.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> list(things.features), list(things.relations)[:4]
    (['size', 'colour', 'material', 'shape'], ['left', 'right', 'in_front', 'behind'])
    >>> things.features["shape"].nouns["cube"]
    ('cube', 'block')
    """

    sort: str
    most: int
    one: str
    many: str
    words: tuple[str, ...]
    features: Mapping[str, ThingFeature]
    relations: Mapping[str, Relation]
    support: str | None = None
    conclusions: Mapping[str, Conclusion] = field(default_factory=dict)
    groups: Mapping[str, Group] = field(default_factory=dict)
    detector: str | None = None
    whole: WholePicture = field(default_factory=WholePicture)

    @property
    def seen(self) -> tuple[str, ...]:
        """The features, and the relations that are not concluded by axioms."""
        measured = (key for key, found in self.relations.items() if found.measure != CONCLUDED)
        return (*self.features, *measured)


def read_things(table: ThingsTable, knowledge: Knowledge, place: KeyPlace) -> Things:
    """Return what ``[things]`` says, checked against the knowledge.

    Raises
    ------
    DomainError
        Where knowledge.al declares the sort, a feature, a value or a relation otherwise or not at
        all, or a word stands for two of them.
    """
    sorts = knowledge.signature.sorts
    if table.sort not in sorts:
        raise DomainError(
            f"{place.at('things', 'sort')}: sort = '{table.sort}' is no sort of knowledge.al; "
            f"{did_you_mean(table.sort, sorts)}"
        )
    if not sorts[table.sort].of_things:
        raise DomainError(
            f"{place.at('things', 'sort')}: the sort '{table.sort}' stands for things and must be "
            f"declared as '#sort {table.sort} = things.', see {sorts[table.sort].location}"
        )
    features = {
        key: _feature(key, feature, table, knowledge, place)
        for key, feature in table.features.items()
    }
    relations = {
        key: _relation(key, relation, table, knowledge, place)
        for key, relation in table.relations.items()
    }
    things = Things(
        sort=table.sort,
        most=table.most,
        one=table.one,
        many=table.many or plural(table.one),
        words=_each_once((table.one, *table.words)),
        features=MappingProxyType(features),
        relations=MappingProxyType(relations),
        support=_support(table, place),
        conclusions={
            key: read_conclusion(key, conclusion, table, knowledge, place)
            for key, conclusion in table.conclusions.items()
        },
        groups={
            key: read_group(key, group, table, knowledge, place)
            for key, group in table.groups.items()
        },
        detector=table.detector,
    )
    _check_words(things, place)
    return things


def _support(table: ThingsTable, place: KeyPlace) -> str | None:
    support = table.support
    if support is not None and (
        support not in table.relations or table.relations[support].measure != "seen"
    ):
        seen = [key for key, relation in table.relations.items() if relation.measure == "seen"]
        raise DomainError(
            f"{place.at('things', 'support')}: support = '{support}' is no relation that is seen; "
            f"{did_you_mean(support, seen)}"
        )
    return support


def _each_once(words: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(words))


def _feature(
    key: str, table: ThingFeatureTable, things: ThingsTable, knowledge: Knowledge, place: KeyPlace
) -> ThingFeature:
    here = ("things", "features", key)
    if key in RESERVED:
        raise DomainError(
            f"{place.at(*here)}: '{key}' is what another column of things.csv is called; call the "
            "feature otherwise"
        )
    predicate = _declared(key, "feature", here, knowledge, place)
    sort = things.sort
    if predicate.sorts[:1] != (sort,) or len(predicate.sorts) > 2:
        raise DomainError(
            f"{place.at(*here)}: the feature '{key}' of things must be declared as '#static "
            f"{key}({sort}).' (yes or no) or '#static {key}({sort}, SORT).', got '{predicate}' "
            f"({predicate.location})"
        )
    values: tuple[str, ...] = ("yes", "no")
    if len(predicate.sorts) == 2:
        values = knowledge.signature.members(predicate.sorts[1])
    for value in table.values:
        if value not in values:
            raise DomainError(
                f"{place.at(*here, 'values', value)}: '{value}' is no value of '{key}' in "
                f"knowledge.al; {did_you_mean(value, values)}"
            )
    name = table.name or key.replace("_", " ")
    words, nouns, say = {}, {}, {}
    for value in values:
        said = table.values.get(value)
        nouns[value] = said.nouns if said else ()
        by_name = () if nouns[value] or len(predicate.sorts) == 1 else (_spoken(value),)
        words[value] = _each_once((*by_name, *(said.words if said else ())))
        say[value] = said.say if said and said.say else _clause(name, value, words, nouns)
    return ThingFeature(
        key=key,
        name=name,
        values=values,
        say=MappingProxyType(say),
        words=MappingProxyType(words),
        nouns=MappingProxyType(nouns),
        called=_each_once((name, *table.words)),
        how=table.how,
        participles=table.participles,
        ordered=table.ordered,
        behind={value: said.behind for value, said in table.values.items() if said.behind},
    )


def _spoken(value: str) -> str:
    return value.strip('"').replace("_", " ")


def _clause(
    name: str,
    value: str,
    words: Mapping[str, tuple[str, ...]],
    nouns: Mapping[str, tuple[str, ...]],
) -> str:
    """The clause that says a value for which domain.toml has none."""
    if nouns[value]:
        return f"{{it}} is {with_article(nouns[value][0])}"
    if words[value]:
        return f"{{it}} is {words[value][0]}"
    return f"{{it}} is {'' if value == 'yes' else 'not '}{name}"


def _relation(
    key: str, table: RelationTable, things: ThingsTable, knowledge: Knowledge, place: KeyPlace
) -> Relation:
    here = ("things", "relations", key)
    predicate = _declared(key, "relation", here, knowledge, place)
    sort = things.sort
    if predicate.sorts != (sort, sort):
        raise DomainError(
            f"{place.at(*here)}: the relation '{key}' must be declared as '#static {key}({sort}, "
            f"{sort}).', got '{predicate}' ({predicate.location})"
        )
    if key in things.features:
        raise DomainError(
            f"{place.at(*here)}: '{key}' is a feature of things, too; call one of the two otherwise"
        )
    if table.converse is not None and table.converse not in things.relations:
        raise DomainError(
            f"{place.at(*here, 'converse')}: converse = '{table.converse}' is no relation; "
            f"{did_you_mean(table.converse, things.relations)}"
        )
    if table.converse is not None and (back := things.relations[table.converse].converse) != key:
        has = "no converse" if back is None else f"converse = '{back}'"
        raise DomainError(
            f"{place.at(*here, 'converse')}: '{table.converse}' is the converse of '{key}', but "
            f"has {has}; write converse = '{key}' in [things.relations.{table.converse}]"
        )
    if table.removed is not None and table.removed not in things.conclusions:
        raise DomainError(
            f"{place.at(*here, 'removed')}: removed = '{table.removed}' is no conclusion; "
            f"{did_you_mean(table.removed, things.conclusions)}"
        )
    return Relation(key=key, **table.model_dump())


def _declared(
    key: str, what: str, here: tuple[str, ...], knowledge: Knowledge, place: KeyPlace
) -> Predicate:
    predicates = knowledge.signature.predicates
    predicate = predicates.get(key)
    if predicate is None:
        raise DomainError(
            f"{place.at(*here)}: the {what} '{key}' of things is not declared in knowledge.al; "
            f"{did_you_mean(key, predicates)}"
        )
    if predicate.kind is not PredicateKind.STATIC:
        raise DomainError(
            f"{place.at(*here)}: the {what} '{key}' of things must be declared as a static, got "
            f"'#{predicate.kind.value} {predicate}' ({predicate.location})"
        )
    return predicate


def _check_words(things: Things, place: KeyPlace) -> None:
    """Refuse a word that stands for two values of one feature, or a noun for two kinds."""
    nouns = dict.fromkeys((word.casefold() for word in things.words), f"any {things.one}")
    for key, group in things.groups.items():
        for word in group.words:
            if nouns.setdefault(word.casefold(), key) != key:
                raise DomainError(
                    f"{place.at('things', 'groups', key)}: '{word}' stands for '{key}' and for "
                    f"'{nouns[word.casefold()]}'; let it stand for one"
                )
    spoken_behind: dict[str, tuple[str, str]] = {}
    for key, feature in things.features.items():
        adjectives: dict[str, str] = {}
        for value in feature.values:
            for words, spoken in ((feature.words, adjectives), (feature.nouns, nouns)):
                for word in words[value]:
                    if spoken.setdefault(word.casefold(), value) != value:
                        raise DomainError(
                            f"{place.at('things', 'features', key, 'values', value)}: '{word}' "
                            f"stands for '{value}' and for '{spoken[word.casefold()]}'; let it "
                            "stand for one"
                        )
        for value, phrase in feature.behind.items():
            if spoken_behind.setdefault(phrase.casefold(), (key, value)) != (key, value):
                of_feature, of_value = spoken_behind[phrase.casefold()]
                raise DomainError(
                    f"{place.at('things', 'features', key, 'values', value, 'behind')}: '{phrase}' "
                    f"stands for '{of_value}' of '{of_feature}', too; let it stand for one"
                )
    spoken = {}
    for key, relation in things.relations.items():
        for word in (*relation.words, *relation.verbs, *relation.most):
            if spoken.setdefault(word.casefold(), key) != key:
                raise DomainError(
                    f"{place.at('things', 'relations', key)}: '{word}' stands for '{key}' and for "
                    f"'{spoken[word.casefold()]}'; let it stand for one"
                )
