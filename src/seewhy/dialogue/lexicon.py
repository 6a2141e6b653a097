"""What the words of a domain mean in questions: read off how its features and classes are said."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from seewhy.dialogue.first_words import Beginning
from seewhy.dialogue.grammar import Binding, Match
from seewhy.dialogue.inflection import ARTICLES, lemma
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.static_lexicon import add_statics
from seewhy.dialogue.vocabulary import MANY
from seewhy.domain.domain import Domain
from seewhy.domain.feature import Feature
from seewhy.text.number_words import NUMBERS

__all__ = ["CATEGORIES", "NUMBERS", "Entries", "Value", "lexicon_of", "persons_of", "words_in"]

Value = tuple[str, str]
"""A feature and a value of it."""

CATEGORIES = (
    "noun", "class", "class_bare", "class_noun", "class_modifier", "does_class", "adjective",
    "possession", "existing", "verb", "word", "feature", "quality", "counted", "counts", "piece",
    "part", "every", "state", "every_state", "change", "person", "group", "belief", "belief_act",
    "asked_quality", "shared_noun", "kind_noun", "kinds", "possible", "happens", "able", "obliged",
    "static_verb", "static_relation", "static_sort", "described",
)  # fmt: skip
"""The phrases of the grammar that a domain's own words fill."""

_LEAST_ALIKE = 3
_BE = {"is", "are"}
_HAVE = {"has", "have"}
_BEFORE_MORE = {"for", "of", "to", "from", "on", "over", "in"}
_TRIVIAL = {"yes", "no", "none", "there", "away", "missing", "absent"}


@dataclass
class Entries:
    """Phrases of one category, by their first word."""

    by_first: dict[str, list[tuple[tuple[str, ...], tuple[Binding, ...]]]] = field(
        default_factory=dict
    )
    other_words: tuple[Binding, ...] = ()
    """What every other word means, but those of ``means_something``."""
    means_something: frozenset[str] = frozenset()
    holds: bool = False
    """Whether the category is no word, but something that is so in the domain."""

    @property
    def beginning(self) -> Beginning | None:
        """How the phrases of the category begin; None where any word does."""
        return None if self.other_words else Beginning(frozenset(self.by_first), self.holds)

    def add(self, words: Sequence[str], *bindings: Binding) -> None:
        """Let a row of normalised words mean something."""
        if words:
            entry = (tuple(words), bindings)
            listed = self.by_first.setdefault(words[0], [])
            if entry not in listed:
                listed.append(entry)

    def at(self, words: Sequence[str], position: int) -> Iterator[Match]:
        """Yield the phrases that begin at a position."""
        if self.holds:
            yield Match(position, ())
        if position >= len(words):
            return
        listed = self.by_first.get(words[position], ())
        for phrase, bindings in listed:
            end = position + len(phrase)
            if tuple(words[position:end]) == phrase:
                yield Match(end, bindings)
        if self.other_words and not listed and words[position] not in self.means_something:
            yield Match(position + 1, self.other_words)


Normalise = Callable[[str], tuple[str, ...]]
"""The words of a text without inflections, synonyms and articles."""


def lexicon_of(domain: Domain, normalise: Normalise) -> dict[str, Entries]:
    """Return what every category of the grammar holds in a domain.

    Parameters
    ----------
    domain : Domain
    normalise : callable
        What the words of a question go through as well.
    """
    found = {name: Entries() for name in CATEGORIES}
    subject = normalise(domain.subject)
    found["noun"].add(subject)
    found["noun"].add(normalise(domain.scene))
    found["kinds"].add((MANY,))
    found["happens"].holds = any(scene_class.verbs for scene_class in domain.classes.values())
    named = normalise(domain.name.replace("_", " "))
    full_name = tuple(subject[-1] if word == MANY else word for word in named)
    if full_name[-len(subject) :] == subject:
        found["noun"].add(full_name)  # "traffic sign" of "traffic_signs"
    for key, scene_class in domain.classes.items():
        if normalise(scene_class.say)[-len(subject) :] == subject:
            found["kind_noun"].add(subject)  # its classes are kinds of it
        for word in dict.fromkeys((*scene_class.words, scene_class.say, key.replace("_", " "))):
            words = normalise(word)
            if words[:1] == ("not",):
                continue  # the grammar denies by itself
            found["class"].add(words, Binding("label", key))
            for number in _number_words(word, normalise):
                found["class"].add(number, Binding("label", key))
                found["class_bare"].add(number, Binding("label", key))
            rest = words[: -len(subject)] if words[-len(subject) :] == subject else ()
            found["class_bare"].add(rest or words, Binding("label", key))
            for place in range(1, len(words) - 1) if subject[-1] not in words else ():
                if words[place] in _BEFORE_MORE:
                    # "Parking for lorries" is "a parking sign for lorries", too.
                    named = (*words[:place], *subject, *words[place:])
                    found["class"].add(named, Binding("label", key))
            if len(rest or words) == 2 and words_of(word)[0] in ("a", "an"):
                # Of "a slippery road" can be asked whether the road is slippery.
                modifier, noun = rest or words
                found["class_noun"].add((noun,), Binding("label", key))
                found["class_modifier"].add((modifier,), Binding("label", key))
            if not scene_class.verbs and len(words) == 1 and subject[-1] not in words:
                found["does_class"].add(words, Binding("label", key))  # "why does it win?"
        for verb in scene_class.verbs:
            found["does_class"].add(normalise(verb), Binding("label", key))
    for feature in domain.features.values():
        _add_feature(feature, found, normalise)
    _add_groups(domain, found, normalise)
    _add_features_alike(domain, found)
    _add_beliefs(domain, found, normalise)
    add_statics(domain, normalise, lambda name, words, meaning: found[name].add(words, meaning))
    return found


def _add_feature(feature: Feature, found: dict[str, Entries], normalise: Normalise) -> None:
    yes_or_no = set(feature.values) == {"yes", "no"}
    parts = {value: _taken_apart(clause) for value, clause in feature.say.items()}
    nouns = [normalise(feature.name), normalise(feature.key.replace("_", " "))]
    if "of" in nouns[0][1:-1]:
        # "The width of the base" is the base width.
        position = nouns[0].index("of")
        nouns.append((*nouns[0][position + 1 :], *nouns[0][:position]))
        nouns.append((*nouns[0][position + 1 :], "its", *nouns[0][:position]))
        if not yes_or_no and not _number_of(feature.name):
            # Of "the shape of the head" is asked "what shape is the head?".
            quality, of_what = nouns[0][:position], nouns[0][position + 1 :]
            for between in (("is",), ("are",), ("have",)):
                found["asked_quality"].add(
                    (*quality, *between, *of_what), Binding("feature", feature.key)
                )
            found["asked_quality"].add(
                (*quality, "do", *of_what, "have"), Binding("feature", feature.key)
            )
    had = [
        set(normalise(part.rest))
        for part in parts.values()
        if part.verb in _HAVE and part.subject == "{it}"
    ]
    if len(had) == len(parts) > 1 and not _number_of(feature.name):
        shared = set.intersection(*had)
        nouns.append(tuple(w for w in normalise(parts[feature.values[0]].rest) if w in shared))
    merely_there = yes_or_no and any(
        part.subject == "there" or (part.subject != "{it}" and "{it}" in part.rest)
        for part in parts.values()
    )
    for noun in filter(None, nouns if not merely_there else ()):
        found["possible"].add(noun, Binding("feature", feature.key))
        found["described"].add(noun, Binding("feature", feature.key))
    for noun in dict.fromkeys(filter(None, nouns)):
        found["feature"].add(noun, Binding("feature", feature.key))
        if yes_or_no:
            found["existing"].add(noun, Binding("fact", (feature.key, "yes")))
        else:
            found["quality"].add(noun, Binding("feature", feature.key))
    adjectives = [normalise(part.rest) for part in parts.values() if part.verb in _BE]
    for value in feature.values:
        meaning = Binding("fact", (feature.key, value))
        part = parts[value]
        rest = normalise(part.rest)
        if part.subject == "{it}":
            if part.verb in _BE:
                found["adjective"].add(rest, meaning)
                if len(rest) > 1 and sum(other[-1:] == rest[-1:] for other in adjectives) > 1:
                    # "Slightly or heavily rusted" names the rust once.
                    found["shared_noun"].add(rest[:-1], meaning)
            elif part.verb in _HAVE:
                found["possession"].add(rest, meaning)
            else:
                found["verb"].add((lemma(part.verb), *rest), meaning)
                if yes_or_no and rest:
                    found["verb"].add((lemma(part.verb),), meaning)
                found["existing"].add(rest, meaning)
                shown = part.verb not in _BE | _HAVE and not yes_or_no
                for word in feature.words[value] if shown else ():
                    if word not in _TRIVIAL:
                        found["existing"].add(normalise(word), meaning)
        elif part.subject == "there":
            thing = normalise(part.rest.split(" in {it}")[0].split(" on {it}")[0])
            if thing[:1] != ("no",):
                found["existing"].add(thing, meaning)
        elif part.subject:
            about = normalise(part.subject)
            predicate = normalise(part.rest.split(" in {it}")[0])
            where = "{it}" in part.rest
            if where:
                if not predicate or predicate[0] != "not":
                    found["existing"].add(about, meaning)
            elif "{it}" not in part.subject and about[0] != "no":
                _add_part(feature.key, part.subject, predicate, meaning, found, normalise)
        _add_words(feature, value, meaning, found, normalise)
        change = feature.change.get(value)
        if change:
            found["change"].add(
                normalise(change.replace("{it}", "it")), Binding("fact", (feature.key, value))
            )


def _add_part(
    feature: str,
    subject: str,
    predicate: tuple[str, ...],
    meaning: Binding,
    found: dict[str, Entries],
    normalise: Normalise,
) -> None:
    """A part of what is shown, and the state that it is in: "a block is displaced"."""
    about = Binding("about", feature)
    noun = normalise(subject)
    found["part"].add(noun, about)
    found["state"].add(predicate, meaning)
    found["possession"].add((*predicate, *noun), meaning)
    found["possession"].add((*noun, "that", "is", *predicate), meaning)
    found["possession"].add((*noun, "that", "have", "been", *predicate), meaning)
    found["possession"].add((*noun, "which", "have", "been", *predicate), meaning)
    if subject.split()[0] in ("a", "an"):
        # That one is so is denied of every one: "are all blocks aligned?".
        found["part"].add((lemma("something"),), about)
        found["part"].add((lemma("anything"),), about)
        for some in (("one", *noun), ("of", *noun), ("one", "of", *noun)):
            found["part"].add(some, about)
        everything = lemma("everything")
        for every in (
            ("all", *noun),
            (lemma("every"), *noun),
            ("each", *noun),
            (everything,),
            noun,
        ):
            found["every"].add(every, about)


def _add_words(
    feature: Feature,
    value: str,
    meaning: Binding,
    found: dict[str, Entries],
    normalise: Normalise,
) -> None:
    number = _number_of(feature.name)
    for word in dict.fromkeys((*feature.words[value], value.replace("_", " "))):
        if word in _TRIVIAL:
            continue
        words = normalise(word)
        for named in _number_words(word, normalise):
            found["word"].add(named, meaning)
        if number:
            thing = normalise(number)
            found["counted"].add((*words, *thing), meaning)
            found["word"].add(words, meaning)
        else:
            found["word"].add(words, meaning)
            if value == "no":
                found["every_state"].add(words, meaning)
    if number:
        found["counts"].add(normalise(number), Binding("feature", feature.key))
        found["piece"].add(normalise(number))


def _number_words(word: str, normalise: Normalise) -> list[tuple[str, ...]]:
    """What else names a number: "three" and "number three" of "3"."""
    if not word.isdecimal():
        return []
    named = [normalise(NUMBERS[int(word)])] if int(word) < len(NUMBERS) else []
    noun = lemma("number")
    return [*named, *((noun, *number) for number in (normalise(word), *named))]


def _add_groups(domain: Domain, found: dict[str, Entries], normalise: Normalise) -> None:
    """Nouns that several features share, as fingers, and those that are persons."""
    by_head: dict[str, list[str]] = {}
    by_values: dict[tuple[str, ...], list[str]] = {}
    for key, feature in domain.features.items():
        by_values.setdefault(feature.values, []).append(key)
        name = normalise(feature.name)
        if name:
            by_head.setdefault(name[-1], []).append(key)
    for key in persons_of(domain):
        found["person"].add(normalise(domain.features[key].name), Binding("fact", (key, "yes")))
    for head, keys in by_head.items():
        if len(keys) < 2:
            continue
        for key in keys:
            modifier = normalise(domain.features[key].name)[:-1]
            if modifier and "yes" in domain.features[key].values:
                # "A small or a large box" names the box once.
                found["shared_noun"].add(modifier, Binding("fact", (key, "yes")))
        alike = by_values[domain.features[keys[0]].values]
        # A thumb is a finger, though it is not called one.
        members = alike if set(keys) <= set(alike) and len(keys) * 2 > len(alike) else keys
        members = [key for key in members if _same_states(domain, keys[0], key)]
        if len(members) < 2:
            continue
        found["group"].add((head,), Binding("group", tuple(members)))


def _add_features_alike(domain: Domain, found: dict[str, Entries]) -> None:
    """Of what most features are, another noun may speak: thumb, index and ring are fingers.

    Only where at least three features, and more than half of all, are in the same states: then
    nothing else can be meant by "which fingers are stretched?".
    """
    by_states: dict[tuple[str, ...], list[str]] = {}
    for key, feature in domain.features.items():
        clauses = [_taken_apart(clause) for clause in feature.say.values()]
        if all(clause.rest and clause.subject not in ("{it}", "there") for clause in clauses):
            by_states.setdefault(tuple(clause.rest for clause in clauses), []).append(key)
    largest = max(by_states.values(), key=len, default=[])
    if found["group"].by_first or len(largest) < _LEAST_ALIKE:
        return
    if len(largest) * 2 > len(domain.features):
        found["group"].other_words = (Binding("group", tuple(largest)),)
        found["group"].means_something = frozenset(words_in(found.values()))


def persons_of(domain: Domain) -> list[str]:
    """Return the features that are named like persons, with a capital letter."""
    return [key for key, feature in domain.features.items() if feature.name[:1].isupper()]


def _same_states(domain: Domain, first: str, other: str) -> bool:
    def states(key: str) -> list[str]:
        return [_taken_apart(clause).rest for clause in domain.features[key].say.values()]

    return states(first) == states(other)


def _add_beliefs(domain: Domain, found: dict[str, Entries], normalise: Normalise) -> None:
    for key, belief in domain.beliefs.items():
        for name in (belief.name, key.replace("_", " ")):
            found["belief"].add(normalise(name), Binding("belief", key))
        for act in belief.acts:
            found["belief_act"].add(normalise(act), Binding("belief", key))


@dataclass(frozen=True)
class _Clause:
    subject: str
    verb: str
    rest: str


def _taken_apart(clause: str) -> _Clause:
    """A clause's subject, verb and what follows; empty where there is no plain verb.

    "the finger is folded" has the subject "the finger", "there is a desk in {it}" has "there".
    """
    words = clause.split()
    if words and words[0] == "{it}" and len(words) > 1:
        return _Clause("{it}", words[1], " ".join(words[2:]))
    for number, word in enumerate(words):
        if word in _BE | _HAVE and number:
            return _Clause(" ".join(words[:number]), word, " ".join(words[number + 1 :]))
    return _Clause("", "", clause)


def _number_of(name: str) -> str:
    """What a feature counts, where it does: "blocks" of "number of blocks"."""
    words = words_of(name)
    return " ".join(words[2:]) if words[:2] == ["number", "of"] else ""


def words_in(entries: Iterable[Entries]) -> set[str]:
    """Return all words of phrases."""
    return {
        word
        for entry in entries
        for phrases in entry.by_first.values()
        for phrase, _ in phrases
        for word in phrase
        if word not in ARTICLES
    }
