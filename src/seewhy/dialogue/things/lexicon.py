"""The words of a domain's things, by the categories of the grammar."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations, product

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.lexicon import NUMBERS
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.things.chart import Category, Chart, Ending
from seewhy.dialogue.things.query import (
    Concluded,
    Corner,
    Description,
    Extreme,
    HasValue,
    Not,
    Ranked,
    Reference,
    References,
)
from seewhy.domain.conclusions import Conclusion
from seewhy.domain.things import ThingFeature, Things
from seewhy.domain.whole_picture import WholePicture
from seewhy.text.comparison import comparative, superlative
from seewhy.text.nouns import plural
from seewhy.text.predicate_words import past_form

__all__ = ["RANKS", "Entries", "lexicon_of", "vocabulary_of"]

RANKS = (
    "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth",
    "eleventh", "twelfth",
)  # fmt: skip


class Entries:
    """Phrases of one category, by their first word; the longest is tried first."""

    def __init__(self) -> None:
        self._by_first: dict[str, list[tuple[tuple[str, ...], tuple[Binding, ...]]]] = {}

    def add(self, phrase: str, *bindings: Binding) -> None:
        """Let a phrase mean something."""
        words = tuple(words_of(phrase))
        if not words:
            return
        listed = self._by_first.setdefault(words[0], [])
        if (words, bindings) not in listed:
            listed.append((words, bindings))
            listed.sort(key=lambda entry: -len(entry[0]))

    def __call__(self, chart: Chart, at: int) -> Sequence[Ending]:
        """Return the phrases that begin at a place."""
        words = chart.words
        if at >= len(words) or words[at] not in self._by_first:
            return ()
        return [
            Ending(at + len(phrase), bindings)
            for phrase, bindings in self._by_first[words[at]]
            if words[at : at + len(phrase)] == phrase
        ]

    @property
    def first_words(self) -> frozenset[str]:
        """The words with which phrases begin."""
        return frozenset(self._by_first)

    def words(self) -> Iterator[str]:
        """Yield the words of all phrases."""
        for listed in self._by_first.values():
            for phrase, _ in listed:
                yield from phrase


_CATEGORIES = (
    "adjective", "noun", "value", "feature", "how", "participle", "preposition", "verb", "verbing",
    "comparative", "superlative", "extreme", "side", "rank", "number", "occurs", "falling", "group",
    "behind", "corner", "class", "class_verb", "whole_noun",
    "whole_place", "how_more",
)  # fmt: skip


def lexicon_of(things: Things) -> dict[str, Category]:
    """Return the categories of the grammar, filled with the words of a domain's things.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> lexicon = lexicon_of(load_domain("tabletop").things)
    >>> lexicon["preposition"](Chart("to the left of it".split()), 0)[0].end
    4
    """
    entries = {name: Entries() for name in _CATEGORIES}
    for word in things.words:
        _add_noun(entries["noun"], word, things.many if word == things.one else plural(word), ())
    _add_noun(entries["noun"], "one", "ones", ())
    named = {
        word for feature in things.features.values() for n in feature.nouns.values() for word in n
    }
    for word in ("thing", "object"):
        if word not in named:
            _add_noun(entries["noun"], word, plural(word), ())
    for feature in things.features.values():
        _add_feature(entries, feature)
    for key, relation in things.relations.items():
        for word in relation.words:
            entries["preposition"].add(word, Binding("relation", key))
        for verb in relation.verbs:
            for form in _forms((verb,)):
                entries["verb"].add(form, Binding("relation", key))
            entries["verbing"].add(_gerund(verb), Binding("relation", key))
        for word in relation.most:
            entries["extreme"].add(word, Binding("extreme", Extreme(key)))
        for word in relation.side:
            entries["side"].add(word, Binding("side", key))
    _add_corners(entries["corner"], things)
    for conclusion in things.conclusions.values():
        _add_conclusion(entries, conclusion)
    for relation in things.relations.values():
        if relation.removed is not None:
            for form in _forms(things.conclusions[relation.removed].verbs):
                entries["falling"].add(form, Binding("relation", relation.key))
    for group in things.groups.values():
        meant = Binding("group", group.key)
        for word in group.words:
            entries["group"].add(word, meant)
            entries["group"].add(group.many if word == group.one else plural(word), meant)
    _add_classes(entries, things.whole)
    for number, rank in enumerate(RANKS, start=1):
        entries["rank"].add(rank, Binding("rank", number))
    entries["rank"].add("last", Binding("rank", -1))
    for number, word in enumerate(NUMBERS):
        entries["number"].add(word, Binding("number", number))
        entries["number"].add(str(number), Binding("number", number))
    return {
        **entries,
        "pronoun": _Antecedent(_PRONOUNS),
        "its": _Antecedent(_OWNERS),
        "them": _Antecedents(frozenset({"them", "these", "those"})),
        "these": _These(frozenset({"these", "those", "they", "them", "the", "all"})),
    }


def vocabulary_of(lexicon: Mapping[str, Category]) -> frozenset[str]:
    """Return the domain's own words."""
    listed: Iterable[Entries] = (e for e in lexicon.values() if isinstance(e, Entries))
    return frozenset(word for entries in listed for word in entries.words())


def _add_feature(entries: Mapping[str, Entries], feature: ThingFeature) -> None:
    asked = Binding("feature", feature.key)
    for word in feature.called:
        for form in (word, plural(word)):
            entries["feature"].add(form, asked)
    for word in feature.how:
        entries["how"].add(word, asked)
    for phrase in feature.participles:
        entries["participle"].add(phrase, asked)
    for value in feature.values:
        for word in feature.words[value]:
            meant = Binding("condition", HasValue(feature.key, value))
            entries["adjective"].add(word, meant)
            entries["value"].add(word, meant)
        if value in feature.behind:
            meant = Binding("condition", HasValue(feature.key, value))
            entries["behind"].add(feature.behind[value], meant)
        for noun in feature.nouns[value]:
            meant = Binding("condition", HasValue(feature.key, value, noun=True))
            _add_noun(entries["noun"], noun, plural(noun), (meant,))
            for form in (noun, f"a {noun}", f"an {noun}", plural(noun)):
                entries["value"].add(form, meant)
    if not feature.ordered:
        return
    for word in feature.how:
        more = word not in feature.words[feature.values[0]]
        compared = Binding("compared", (feature.key, more))
        entries["how_more"].add(word, compared)
        entries["comparative"].add(comparative(word), compared)
        entries["superlative"].add(superlative(word), Binding("ranked", Ranked(feature.key, more)))
    for value, more in ((feature.values[0], False), (feature.values[-1], True)):
        for word in feature.words[value]:
            compared = Binding("compared", (feature.key, more))
            entries["comparative"].add(comparative(word), compared)
            entries["superlative"].add(
                superlative(word), Binding("ranked", Ranked(feature.key, most=more))
            )


def _add_corners(corners: Entries, things: Things) -> None:
    """Two ways at once, neither of which is the other or its opposite: "top left"."""
    ways = [relation for relation in things.relations.values() if relation.side or relation.most]
    for one, other in permutations(ways, 2):
        if other.key != one.converse:
            corner = Binding("corner", Corner((one.key, other.key)))
            for words in product((*one.side, *one.most), (*other.side, *other.most)):
                corners.add(" ".join(words), corner)


def _add_conclusion(entries: Mapping[str, Entries], conclusion: Conclusion) -> None:
    meant = Binding("condition", Concluded(conclusion.key))
    for word in conclusion.words:
        entries["adjective"].add(word, meant)
    for verb in conclusion.verbs:
        entries["adjective"].add(_gerund(verb), meant)
    for form in _forms(conclusion.verbs):
        entries["occurs"].add(form, meant)
    # What denies it in words of its own says it, too: "it will keep", where else it spoils.
    denied = _OF_IT.fullmatch(conclusion.deny)
    if denied is not None and "not" not in words_of(conclusion.deny):
        for form in _forms((denied["verb"],)):
            entries["occurs"].add(form, Binding("condition", Not(Concluded(conclusion.key))))


def _add_classes(entries: Mapping[str, Entries], whole: WholePicture) -> None:
    """Words for the picture as a whole, of a domain with classes."""
    for label, known in whole.classes.items():
        meant = Binding("class", label)
        for word in dict.fromkeys((known.say, *known.words)):
            entries["class"].add(word, meant)
        for form in _forms(known.verbs):
            entries["class_verb"].add(form, meant)
    for noun in dict.fromkeys((*whole.nouns, *_PICTURES)):
        entries["whole_place"].add(noun)
        if whole.classes:
            entries["whole_noun"].add(noun)
    if whole.classes:
        for pronoun in ("it", "this", "that"):
            entries["whole_noun"].add(pronoun)


def _forms(verbs: Iterable[str]) -> Iterator[str]:
    """The forms of verbs behind a subject."""
    for verb in verbs:
        yield from (verb, _third_person(verb), past_form(verb))


def _add_noun(nouns: Entries, one: str, many: str, bindings: tuple[Binding, ...]) -> None:
    nouns.add(one, *bindings, Binding("many", False))
    nouns.add(many, *bindings, Binding("many", True))


def _third_person(verb: str) -> str:
    first, _, rest = verb.partition(" ")
    return f"{plural(first)} {rest}".strip()


def _gerund(verb: str) -> str:
    first, _, rest = verb.partition(" ")
    return f"{first.removesuffix('e')}ing {rest}".strip()


_OF_IT = re.compile(r"\{it\} (?:will|would|can|could) (?P<verb>[\w ]+)")
_PICTURES = ("picture", "image", "photo", "photograph", "scene")
"""What any picture may be called as a whole."""
_PRONOUNS = frozenset({"it", "this", "that", "they", "them", "these", "those"})
_OWNERS = frozenset({"its", "their"})


@dataclass(frozen=True)
class _Antecedent:
    """Words for what was spoken of before."""

    first_words: frozenset[str]

    def __call__(self, chart: Chart, at: int) -> Sequence[Ending]:
        if chart.antecedent is None or at >= len(chart.words):
            return ()
        if chart.words[at] not in self.first_words:
            return ()
        return (Ending(at + 1, (Binding("one", chart.antecedent),)),)


@dataclass(frozen=True)
class _Antecedents:
    """Words for the things that were spoken of before, or else for all of them."""

    first_words: frozenset[str]

    def __call__(self, chart: Chart, at: int) -> Sequence[Ending]:
        if at >= len(chart.words) or chart.words[at] not in self.first_words:
            return ()
        meant = chart.antecedent
        described = meant.description if isinstance(meant, Reference) else Description(many=True)
        return (Ending(at + 1, (Binding("them", described),)),)


@dataclass(frozen=True)
class _These:
    """Words for several things: those that were spoken of before, or else all that are there."""

    first_words: frozenset[str]

    def __call__(self, chart: Chart, at: int) -> Sequence[Ending]:
        words = chart.words
        if at >= len(words) or words[at] not in self.first_words:
            return ()
        meant = chart.antecedent or Reference(Description(many=True), References.EVERY)
        binding = (Binding("one", meant),)
        counted = at + 1 < len(words) and (words[at + 1] in NUMBERS or words[at + 1].isdigit())
        if counted:
            return (Ending(at + 2, binding),)
        return () if words[at] in ("the", "all") else (Ending(at + 1, binding),)
