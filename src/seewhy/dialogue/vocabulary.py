"""The words of questions in one domain: synonyms, what may be left out, inflections."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from seewhy.dialogue.grammar_file import around_phrases, aside_phrases
from seewhy.dialogue.inflection import ARTICLES, lemma, lemmas, stem_of
from seewhy.dialogue.question_words import words_of
from seewhy.domain.domain import Domain
from seewhy.errors import DomainError

__all__ = ["MANY", "SUBJECTS", "Vocabulary", "says_something"]

MANY = "many_of_its_kind"
"""What the grammar reads for a noun in the plural: "structures" are not the one that is shown."""

SUBJECTS = frozenset({"it", "this", "that", "these", "those"})
"""Words that stand for what a picture shows."""

_LONGEST_AROUND = 4
"""Words of a phrase that may stand before or behind a question."""
_LEAST_BARE = 3
"""Words of a question that stands by itself: "and blue?" asks what was asked before."""
_SUPPOSES = frozenset({"if", "when", "once"})
"""Behind "tell me" they ask whether or when; without it, "if it leaned" supposes something."""
_THOUGHT_OF = frozenset({"about", "of"})
"""Behind "do you think" they ask for what somebody thinks, where "tell me about it" asks for it."""
_ASKING = frozenset({"think", "wonder"})
_AUXILIARIES = frozenset(
    {"is", "was", "do", "does", "did", "has", "have", "will", "would", "can", "could"}
)
_ANY_ONE = frozenset({"a", "an", "any", "some", "one"})
_WITH_MORE = frozenset({"with", "without", "that", "which", "like"})
_POINTING = frozenset({"the", "this", "that", "my", "our"})
_ASKED_FOR = frozenset({"please", "kindly"})
_Pair = tuple[tuple[str, ...], tuple[str, ...]]


class Vocabulary:
    """What questions in one domain are made of.

    Raises
    ------
    DomainError
        Where a subject, a synonym or a filler is not made of words.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> words = Vocabulary(load_domain("structure_stability"))
    >>> words.for_grammar("Is the tower tilting, please?")
    ('is', 'structur', 'lean')
    >>> words.for_templates("Is the tower tilting, please?")
    ('is', 'it', 'lean')
    """

    def __init__(self, domain: Domain) -> None:
        _check_words(domain)
        questions = domain.questions
        self._subject = {stem_of(word) for word in (words_of(domain.subject)[-1], *SUBJECTS)}
        pairs = [
            (words_of(other), words_of(canonical))
            for canonical, others in questions.synonyms.items()
            for other in others
        ]
        fillers = [words_of(filler) for filler in questions.fillers]
        self.spelled = frozenset(
            word for pair in pairs for words in pair for word in words
        ) | frozenset(word for words in fillers for word in words)
        self._for_templates = _by_first(
            [(_stems(other), _stems(canonical)) for other, canonical in pairs]
            + [(_stems(filler), ()) for filler in fillers]
        )
        self._synonyms = _by_first(
            [(_lemmas(other), _lemmas(canonical)) for other, canonical in pairs]
        )
        self._adverbs, self._aside = _asides()
        self._before, self._behind = (
            frozenset(_lemmas(words_of(phrase)) for phrase in phrases)
            for phrases in around_phrases()
        )
        nouns = {words_of(domain.subject)[-1], words_of(domain.scene)[-1]}
        one = _lemmas(words_of(domain.subject))[-1:]
        nouns |= {other[-1] for other, canonical in pairs if _lemmas(canonical)[-1:] == one}
        self._nouns = frozenset(map(stem_of, nouns))
        self._one_of_it = {lemma(noun): noun for noun in sorted(nouns)}
        self._states = {
            word for scene_class in domain.classes.values() for word in scene_class.words
        }
        self._named = {
            word
            for feature in domain.features.values()
            for word in _lemmas(words_of(feature.name))[-1:]  # none where it is called "A"
        } | {"people"}
        self._fillers = sorted(map(_lemmas, fillers), key=len, reverse=True)
        for key, said in (("subject", domain.subject), ("scene", domain.scene)):
            if not self.for_grammar(said):
                raise DomainError(
                    f"{domain.folder / 'domain.toml'}: {key} = '{said}' is what questions may "
                    "leave out; write what the picture shows"
                )

    def for_templates(self, text: str) -> tuple[str, ...]:
        """Return the words of a text as templates and the recurrent network read them."""
        tokens = self._own_places(_without_articles(words_of(text)))
        stems = _replaced([stem_of(token) for token in tokens], self._for_templates)
        words: list[str] = []
        for stem in stems:
            word = "it" if stem in self._subject else stem
            if not (word == "it" and words and words[-1] == "it"):
                words.append(word)
        return tuple(words)

    def for_grammar(self, text: str) -> tuple[str, ...]:
        """Return the words of a text without inflections, synonyms and what may be left out."""
        words = [
            part
            for word in _without_articles(words_of(text))
            for part in _of_owner(word)
            if part not in self._adverbs
        ]
        words = [MANY if self._is_of_many(word) else word for word in words]
        words = _replaced(lemmas(words), self._synonyms)
        return self._unfilled(tuple(_replaced(words, self._aside)))

    def _own_places(self, tokens: list[str]) -> list[str]:
        """Words in which "its place" is not the place that is shown, where a place is a subject."""
        return [
            f"{before} {token}" if before == "its" and stem_of(token) in self._nouns else token
            for before, token in zip(["", *tokens], tokens, strict=False)
        ]

    def speaks_of_many(self, text: str) -> bool:
        """Whether a text speaks of more than what is shown: "why do structures fall?".

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> words = Vocabulary(load_domain("structure_stability"))
        >>> words.speaks_of_many("why do towers fall"), words.speaks_of_many("why does it fall")
        (True, False)
        """
        return any(map(self._is_of_many, words_of(text)))

    def speaks_of_another(self, text: str) -> bool:
        """Whether a text speaks of one that need not be shown: "is a tower stable?".

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> words = Vocabulary(load_domain("structure_stability"))
        >>> words.speaks_of_another("is a tower stable"), words.speaks_of_another("is it a tower")
        (True, False)
        """
        words = ["", *words_of(text), "", ""]
        return any(
            article in _ANY_ONE
            and stem_of(noun) in self._nouns
            and behind not in _WITH_MORE
            and (before in ("", "like") or (place == 1 and before in _AUXILIARIES))
            for place, (before, article, noun, behind) in enumerate(
                zip(words, words[1:], words[2:], words[3:], strict=False)
            )
        )

    def is_command(self, text: str) -> bool:
        """Whether a text wants something done: "empty the room", where "empty room" asks.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> words = Vocabulary(load_domain("robot_assistant"))
        >>> words.is_command("please empty the room"), words.is_command("is it an empty room")
        (True, False)
        """
        words = words_of(text)
        start = next((place for place, word in enumerate(words) if word not in _ASKED_FOR), 0)
        verb, pointing, noun = [*words[start:], "", "", ""][:3]
        return verb in self._states and pointing in _POINTING and stem_of(noun) in self._nouns

    def _is_of_many(self, word: str) -> bool:
        """Whether a word is the plural of what a picture shows; "sign's" is none."""
        if word.endswith("'s"):
            return False
        one = self._one_of_it.get(lemma(word), word)
        return word != one and word.endswith("s") and not one.endswith("s")

    def plainly(self, text: str) -> str:
        """Return a text without what may stand in any question and changes nothing of it.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> Vocabulary(load_domain("traffic_signs")).plainly("what does it really mean, please")
        'what does it mean'
        """
        words = [word for word in words_of(text) if word not in self._adverbs]
        kept = [lemma(word) for word in words]
        position = 0
        while position < len(words):
            for phrase, _ in self._aside.get(kept[position], ()):
                end = position + len(phrase)
                if tuple(kept[position:end]) == phrase:
                    del words[position:end], kept[position:end]
                    position -= 1
                    break
            position += 1
        return " ".join(words)

    def bare(self, words: tuple[str, ...]) -> tuple[str, ...]:
        """Return normalised words without what may stand before and behind any question.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> words = Vocabulary(load_domain("structure_stability"))
        >>> words.bare(words.for_grammar("Okay, but is it stable too?"))
        ('is', 'it', 'stabl')
        """
        for length in range(min(len(words) - 1, _LONGEST_AROUND), 0, -1):
            if words[:length] in self._before and len(words) - length >= _LEAST_BARE:
                return self.bare(words[length:])
            # "A chair like this" is one of a kind, where "can it stay like this?" asks of it.
            of_a_kind = words[-length] == "like" and words[-length - 1] in self._named
            if words[-length:] in self._behind and not of_a_kind:
                return self.bare(words[:-length])
        return words

    def _unfilled(self, words: tuple[str, ...]) -> tuple[str, ...]:
        """Words without the domain's fillers around them; "how do you know" is none inside."""
        for filler in self._fillers:
            behind = words[len(filler) : len(filler) + 1]
            kept = _SUPPOSES | (_THOUGHT_OF if _ASKING.intersection(filler) else frozenset())
            if filler and words[: len(filler)] == filler and not kept.issuperset(behind):
                return self._unfilled(words[len(filler) :])
            # "If Bob leaves, tell me" asks to be told when he does.
            if words and words[0] in _SUPPOSES and "me" in filler:
                continue
            if filler and words[-len(filler) :] == filler:
                return self._unfilled(words[: -len(filler)])
        return words


def says_something(text: str) -> bool:
    """Whether anything is left of a text without what questions may leave out in any domain.

    Examples
    --------
    >>> [says_something(text) for text in ("the apple", "the", "★", "er", "honestly")]
    [True, False, False, False, False]
    """
    adverbs, aside = _asides()
    words = [word for word in _without_articles(words_of(text)) if word not in adverbs]
    return bool(_replaced(lemmas(words), aside))


@cache
def _asides() -> tuple[frozenset[str], dict[str, list[_Pair]]]:
    """Adverbs and phrases that may stand in any question and change nothing of it."""
    # "Clearly" says nothing of a picture, where "clear" may.
    adverbs = frozenset(
        phrase for phrase in aside_phrases() if " " not in phrase and phrase.endswith("ly")
    )
    phrases = [phrase for phrase in aside_phrases() if phrase not in adverbs]
    return adverbs, _by_first([(_lemmas(words_of(phrase)), ()) for phrase in phrases])


def _without_articles(words: Sequence[str]) -> list[str]:
    """Words without articles; "the only one" is not "only one"."""
    return [
        "sole" if before == "the" and word == "only" else word
        for before, word in zip(["", *words], words, strict=False)
        if word not in ARTICLES
    ]


def _of_owner(word: str) -> tuple[str, ...]:
    """ "The tower's base" is its base."""
    return (word[:-2], "its") if word.endswith("'s") else (word,)


def _stems(words: Sequence[str]) -> tuple[str, ...]:
    return tuple(map(stem_of, words))


def _lemmas(words: Sequence[str]) -> tuple[str, ...]:
    return tuple(lemmas([word for word in words if word not in ARTICLES]))


def _by_first(pairs: Sequence[_Pair]) -> dict[str, list[_Pair]]:
    """First word → the phrases that begin with it and what they stand for, longest first."""
    found: dict[str, list[_Pair]] = {}
    for pair in sorted(pairs, key=lambda pair: -len(pair[0])):
        if pair[0]:
            found.setdefault(pair[0][0], []).append(pair)
    return found


def _replaced(words: list[str], phrases: dict[str, list[_Pair]]) -> list[str]:
    """The words with phrases replaced by what they stand for."""
    words = list(words)
    position = 0
    while position < len(words):
        for phrase, instead in phrases.get(words[position], ()):
            if tuple(words[position : position + len(phrase)]) == phrase:
                words[position : position + len(phrase)] = instead
                position += len(instead) - 1
                break
        position += 1
    return words


def _check_words(domain: Domain) -> None:
    """Raise a DomainError where a subject, synonym or filler is not made of words."""
    for key, said, example in (
        ("subject", domain.subject, "the apple"),
        ("scene", domain.scene, "apple"),
    ):
        if not _without_articles(words_of(said)):
            raise DomainError(
                f"{domain.folder / 'domain.toml'}: {key} = '{said}' has no word; "
                f'write one such as "{example}"'
            )
    questions = domain.questions
    phrases = {f"synonyms of '{key}'": (key, *words) for key, words in questions.synonyms.items()}
    phrases["fillers"] = tuple(questions.fillers)
    for where, some in phrases.items():
        for phrase in some:
            if not words_of(phrase):
                raise DomainError(
                    f"{domain.folder / 'questions.toml'}: '{phrase}' in the {where} has no word; "
                    "remove it"
                )
