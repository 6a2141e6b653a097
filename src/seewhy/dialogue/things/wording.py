"""Things, descriptions and conditions in the words of a domain."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from seewhy.dialogue.things import query
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.lexicon import RANKS
from seewhy.domain.thing_wording import described
from seewhy.domain.wording import join_words
from seewhy.text.comparison import comparative, superlative
from seewhy.text.nouns import plural, with_article
from seewhy.text.number_words import number_word

__all__ = ["ThingWords", "number_word"]

_PLURAL = {"is": "are", "has": "have"}


def _relative(clause: str, subject: str, *, many: bool) -> str:
    """A clause behind the noun that is its subject: "that would fall"."""
    if not clause.startswith(f"{subject} "):
        return f"such that {clause.replace(subject, 'they' if many else 'it')}"
    said = clause.removeprefix(f"{subject} ")
    if many:
        said = re.sub(r"^(is|has)\b", lambda verb: _PLURAL[verb[0]], said)
    return f"that {said}"


class ThingWords:
    """Says the things of one scene.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> seen = {"size": "small", "colour": "red", "material": "metal", "shape": "cube"}
    >>> scene = thing_scene(things, [seen, {"colour": "red"}], relations={})
    >>> words = ThingWords(Evaluation(scene, things))
    >>> words.name(0), words.name(1)
    ('the small red metal cube', 'the red thing')
    >>> words.phrase(query.Description((query.HasValue("colour", "red"),), many=True))
    'red things'
    """

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.things = evaluation.things
        scene = evaluation.scene
        values = [
            {key: column[number] for key, column in scene.values.items()}
            for number in range(scene.count)
        ]
        said = [self.described(of_one) for of_one in values]
        self._references: dict[int, tuple[query.Reference, str]] = {}
        self._names = [
            f"the {name}" if said.count(name) == 1 else f"the {name} ({self.things.one} {at})"
            for at, name in enumerate(said, start=1)
        ]

    def described(self, values: Mapping[str, str | None]) -> str:
        """Return a thing of some values, without an article: "small red metal cube"."""
        return described(self.things, values)

    def term(self, number: int) -> str:
        """Return what a thing is called in the knowledge language."""
        return f"{self.things.sort}{number + 1}"

    def name(self, number: int) -> str:
        """Return a thing as it is told from the others."""
        return self._names[number]

    def names(self, numbers: Sequence[int]) -> str:
        """Return several things as a list."""
        return join_words([self.name(number) for number in numbers])

    def value(self, feature: str, value: str) -> str:
        """Return a value as an adjective, or as a noun."""
        described = self.things.features[feature]
        words = described.nouns[value] or described.words[value]
        return words[0] if words else value

    def denied(self, feature: str, value: str) -> str:
        """Return that something does not have a value, behind what it has: ", not a cube"."""
        noun = self.things.features[feature].nouns[value]
        return f", not {with_article(noun[0]) if noun else self.value(feature, value)}"

    def clause(self, feature: str, value: str, subject: str) -> str:
        """Return that something has a value."""
        return self.things.features[feature].say[value].replace("{it}", subject)

    def being(self, condition: query.Condition, subject: str, *, many: bool = False) -> str:
        """Return that something is so of a subject: "two of them are red", "it has two symbols"."""
        clause = f"{subject} is {self.predicate(condition, many=many)}"
        if isinstance(condition, query.HasValue) and self._stands_behind(condition):
            clause = self.clause(condition.feature, condition.value, subject)
        said = clause.removeprefix(subject)
        if many:
            said = re.sub(r"^ (is|has)\b", lambda verb: f" {_PLURAL[verb[1]]}", said)
        return f"{subject}{said}"

    def counted(self, count: int, description: query.Description) -> str:
        """Return so many of a description: "three red cubes"."""
        number = "no" if count == 0 else number_word(count)
        return f"{number} {self.phrase(description, many=count != 1)}"

    def reference(self, reference: query.Reference) -> str:
        """Return what a reference refers to: the thing by its name, where there is one."""
        known = self._references.get(id(reference))
        if known is None:
            known = self._references[id(reference)] = (reference, self._referred(reference))
        return known[1]

    def _referred(self, reference: query.Reference) -> str:
        if reference.which is query.References.THE:
            try:
                return self.name(self.evaluation.the(reference))
            except UnclearReferenceError:
                return f"the {self.phrase(reference.description, many=False)}"
        if reference.which is query.References.SOME:
            return with_article(self.phrase(reference.description, many=False))
        return f"every {self.phrase(reference.description, many=False)}"

    def phrase(self, description: query.Description, *, many: bool | None = None) -> str:
        """Return a description without an article: "red cubes left of the blue ball"."""
        if isinstance(description.selection, query.Fixed):
            return self.name(description.selection.number).removeprefix("the ")
        several = description.many if many is None else many
        adjectives, noun, behind = [], "", []
        for condition in description.conditions:
            if isinstance(condition, query.HasValue) and self._stands_behind(condition):
                behind.append(self._stands_behind(condition))
            elif isinstance(condition, query.HasValue) and not self._as_noun(condition):
                words = self.things.features[condition.feature].words[condition.value]
                adjectives.append(words[0] if words else f"({condition.value})")
            elif isinstance(condition, query.HasValue) and not noun:
                noun = self.value(condition.feature, condition.value)
            else:
                behind.append(self._behind(condition, several))
        noun = noun or self.things.one
        if several:
            noun = self.things.many if noun == self.things.one else plural(noun)
        if isinstance(description.selection, query.Nearest):
            behind.append(self._at_distance(description.selection))
        selected = self._selected(description)
        return " ".join(filter(None, [selected, *adjectives, noun, " and ".join(behind)]))

    def _as_noun(self, condition: query.HasValue) -> bool:
        return bool(self.things.features[condition.feature].nouns[condition.value])

    def _stands_behind(self, condition: query.HasValue) -> str:
        return self.things.features[condition.feature].behind.get(condition.value, "")

    def _selected(self, description: query.Description) -> str:
        match description.selection:
            case query.Extreme(relation=relation, rank=rank, from_end=from_end):
                words = self.things.relations[relation].most or (f"most {relation}",)
                counted = "" if rank == 1 else RANKS[rank - 1] if rank <= len(RANKS) else str(rank)
                return " ".join(filter(None, ["last" if from_end else counted, words[0]]))
            case query.Corner(relations=relations):
                ways = [self.things.relations[relation] for relation in relations]
                return " ".join([*way.side, *way.most, way.key][0] for way in ways)
            case query.Ranked(feature=feature, most=most):
                values = self.things.features[feature].values
                return superlative(self.value(feature, values[-1 if most else 0]))
            case query.Numbered(number=number):
                return "last" if number < 0 else RANKS[number - 1] if number <= 12 else str(number)
        return ""

    def _at_distance(self, nearest: query.Nearest) -> str:
        far = "farthest from" if nearest.farthest else "nearest to"
        return f"{far} {self.reference(nearest.to)}"

    def _behind(self, condition: query.Condition, many: bool) -> str:
        """A condition behind a noun."""
        if isinstance(condition, query.Concluded):
            say = self.things.conclusions[condition.conclusion].say
            return _relative(say, "{it}", many=many)
        if isinstance(condition, query.Related) and not condition.inverse:
            relation = self.things.relations[condition.relation]
            if not relation.words:
                clause = relation.say.replace("{1}", self.reference(condition.to))
                return _relative(clause, "{0}", many=many)
        if isinstance(
            condition,
            query.HasValue | query.PartOf | query.Not | query.All | query.AnyOf | query.Is,
        ):
            return f"that {'are' if many else 'is'} {self.predicate(condition, many=many)}"
        return self.predicate(condition, many=many)

    def predicate_of(self, relation: str, named: str) -> str:
        """Return a relation to something as it stands behind "is"."""
        words = self.things.relations[relation].words
        if words:
            return f"{words[0]} {named}"
        return f"such that {self.things.relations[relation].say.format('it', named)}"

    def predicate(self, condition: query.Condition, *, many: bool = False) -> str:
        """Return a condition as it stands behind "is": "red", "left of the blue ball"."""
        match condition:
            case query.HasValue(feature=feature, value=value):
                said = self._stands_behind(condition) or self.value(feature, value)
                if not self._as_noun(condition):
                    return said
                return plural(said) if many else with_article(said)
            case query.Concluded(conclusion=conclusion):
                known = self.things.conclusions[conclusion]
                said = known.say.replace("{it}", "they" if many else "it")
                return known.words[0] if known.words else f"such that {said}"
            case query.PartOf(group=group):
                return f"part of {with_article(self.things.groups[group].one)}"
            case query.Related(relation=relation, to=to, inverse=True):
                converse = self.things.relations[relation].converse
                if converse is not None:
                    return self.predicate_of(converse, self.reference(to))
                said = self.things.relations[relation].say.format(self.reference(to), "it")
                return f"such that {said}"
            case query.Related(relation=relation, to=to):
                return self.predicate_of(relation, self.reference(to))
            case query.Shares(feature=feature, other=other):
                name = self.things.features[feature].name
                return f"of the same {name} as {self.reference(other)}"
            case query.Compares(feature=feature, more=more, than=than):
                return f"{self._more_or_less(feature, more=more)} than {self.reference(than)}"
            case query.Between(first=first, second=second):
                return f"between {self.reference(first)} and {self.reference(second)}"
            case query.Apart(one=one):
                return "" if one is None else f"other than {self.reference(one)}"
            case query.Is(one=one) if one.description.selection is not None:
                return f"the {self.phrase(one.description, many=False)}"
            case query.Is(one=one):
                return self.reference(one)
            case query.Not(condition=query.PartOf(group=group)):
                return f"part of no {self.things.groups[group].one}"
            case query.Not(condition=inner):
                return f"not {self.predicate(inner, many=many)}"
            case query.All(conditions=inners):
                return self._together(inners, "and", many)
            case query.AnyOf(conditions=inners):
                return self._together(inners, "or", many)
        raise TypeError(f"must be a condition, got {condition!r}")

    def _more_or_less(self, feature: str, *, more: bool) -> str:
        """The comparative of an ordered feature: of its last or first value, or of "how"."""
        known = self.things.features[feature]
        said = self.value(feature, known.values[-1 if more else 0])
        ways = [word for word in known.how if word not in known.words[known.values[0]]]
        if said in known.how or not ways:
            return comparative(said)
        return comparative(ways[0]) if more else f"less {ways[0]}"

    def _together(self, conditions: Sequence[query.Condition], word: str, many: bool) -> str:
        if not conditions:
            return self.things.many if many else with_article(self.things.one)
        if (
            any(isinstance(c, query.HasValue) and self._as_noun(c) for c in conditions)
            and word == "and"
        ):
            phrase = self.phrase(query.Description(tuple(conditions)), many=many)
            return phrase if many else with_article(phrase)
        return join_words([self.predicate(c, many=many) for c in conditions], word=word)
