"""The question templates of a domain: patterns with slots, and every wording that they make."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product, zip_longest

from seewhy.dialogue.asked import Asks, Question
from seewhy.domain.domain import Domain
from seewhy.domain.question_tables import QuestionTable
from seewhy.errors import DomainError
from seewhy.files.toml_file import lines_of_tables
from seewhy.text.nearest import did_you_mean
from seewhy.text.nouns import singular
from seewhy.text.slots import filled, wrong_slot
from seewhy.text.visible import visible

__all__ = ["MOST_OPTIONAL", "MOST_WORDINGS", "as_what", "embedded", "expanded"]

_ONE = ("one", "1")
"""Words for a value behind which a noun stands in the singular."""

MOST_OPTIONAL = 8
"""Parts of a pattern that may be left out: so many make 256 wordings."""

MOST_WORDINGS = 50_000
"""Of all questions of a domain; the largest that is bundled has a fifth."""

_ABOUT_A_CLASS = {
    Asks.IS_CLASS, Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS,
    Asks.DIFFERENCE_TO_CLASS,
}  # fmt: skip
_ABOUT_A_FEATURE = {Asks.FEATURE_VALUE, Asks.FEATURE_IS}
_ASKED_BY_TEMPLATES = tuple(asks for asks in Asks if Question(asks, "", ()).is_of_templates)


def expanded(domain: Domain, normalise: Callable[[str], tuple[str, ...]]) -> Iterator[Question]:
    """Yield every wording of a domain's templates, in their order.

    Raises
    ------
    DomainError
        Where a template names something that the domain does not have.
    """
    path = domain.folder / "questions.toml"
    lines = lines_of_tables(path.read_text(encoding="utf-8-sig"), "question")
    told: list[tuple[QuestionTable, Asks, str, list[_Slot]]] = []
    wordings = 0
    for table, line in zip_longest(domain.questions.question, lines, fillvalue=1):
        if isinstance(table, int):
            break  # what looks like one more heading stands in a text
        place = f"{path}:{line}"
        asks = _check_table(table, domain, place)
        for pattern in table.patterns:
            _check_pattern(pattern, place)
            slots = _slots(table, asks, domain, pattern, place)
            told.append((table, asks, pattern, slots))
            wordings += len(slots) << pattern.count("[")
            if wordings > MOST_WORDINGS:
                raise DomainError(
                    f"{place}: with '{visible(pattern)}' there are {wordings:,} wordings of "
                    f"questions, more than {MOST_WORDINGS:,}; leave out patterns or [...]"
                )
    for table, asks, pattern, slots in told:
        for variant in _optional(pattern):
            for slot in slots:
                said = {"it": domain.subject, "class": slot.word, "value": slot.word}
                text = filled(variant, said)
                if "not not" in text:
                    continue  # a class that is worded as "not …" in a question with "not"
                agreeing = filled(_of_one(variant), said) if slot.word in _ONE else text
                yield Question(
                    asks=asks,
                    text=" ".join(agreeing.split()),
                    words=normalise(text),
                    label=slot.label,
                    feature=table.feature,
                    value=slot.value,
                    predicate=table.predicate,
                )


def _of_one(pattern: str) -> str:
    """A pattern as it reads where its value is one: "is there {value} block".

    What is understood stays as the pattern has it, so that the wordings are told apart as before.

    Examples
    --------
    >>> _of_one("are there {value} blocks"), _of_one("does {it} have {value} boxes")
    ('is there {value} block', 'does {it} have {value} box')
    """
    said = re.sub(r"(?<=\{value\} )\w{4,}", lambda noun: singular(noun[0]), pattern)
    return re.sub(r"\bare there (?=\{value\})", "is there ", said) if said != pattern else said


def as_what(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return words in which "which" asks like "what".

    Examples
    --------
    >>> as_what(("which", "shape", "is", "it"))
    ('what', 'shape', 'is', 'it')
    """
    return tuple("what" if word == "which" else word for word in words)


def embedded(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """Yield a template's normalised words as they stand behind "tell me", and by themselves.

    Examples
    --------
    >>> list(embedded(("what", "colour", "is", "it")))
    [('what', 'colour', 'is', 'it'), ('what', 'colour', 'it', 'is')]
    >>> list(embedded(("what", "is", "colour", "of", "it")))[1:]
    [('what', 'is', 'it', 'colour'), ('it', 'colour'), ('colour', 'of', 'it')]
    >>> list(embedded(("what", "colour", "doe", "it", "have")))[2:]
    [('what', 'colour', 'is', 'it', 'have'), ('what', 'colour', 'has', 'it')]
    """
    words = as_what(words)
    yield words
    if words[:1] != ("what",) and words[:1] != ("how",):
        return
    for position in range(len(words) - 1):
        if words[position : position + 2] == ("is", "it"):
            rest = words[position + 2 :]
            yield (*words[:position], "it", "is", *rest)
        if words[position : position + 2] == ("doe", "it"):
            said = ("has" if word == "have" else word for word in words[position + 2 :])
            yield (*words[:position], "it", *said)
            # "What is it showing?", "what colour has it?"
            yield (*words[:position], "is", "it", *words[position + 2 :])
            if words[position + 2 :] == ("have",):
                yield (*words[:position], "has", "it")
    if "is" in words and words[-2:] == ("of", "it"):
        # "What is the sign's colour?", "what is its colour?": both are "it colour" in these words.
        position = words.index("is") + 1
        yield (*words[:position], "it", *words[position:-2])
        if words[:2] == ("what", "is"):
            yield ("it", *words[2:-2])
    if words[:2] == ("what", "is") and "of" in words[3:]:
        yield words[2:]


def _check_pattern(pattern: str, place: str) -> None:
    """Raise a DomainError where a pattern has an unknown slot or brackets that do not pair."""
    if wrong_slot(pattern, ("it", "class", "value")) is not None:
        raise DomainError(
            f"{place}: '{pattern}' has a slot that does not exist; there are {{it}}, {{class}} and "
            "{value}"
        )
    brackets = "".join(re.findall(r"[\[\]]", pattern))
    if brackets.replace("[]", ""):
        raise DomainError(
            f"{place}: the brackets of '{pattern}' do not pair; [...] is what may be left out"
        )
    if len(brackets) > 2 * MOST_OPTIONAL:
        raise DomainError(
            f"{place}: '{visible(pattern)}' has {len(brackets) // 2} parts that may be left out, "
            f"more than {MOST_OPTIONAL}; write several patterns"
        )


def _optional(pattern: str) -> Iterator[str]:
    """Every reading of a pattern with its [optional] parts left in or out."""
    parts = re.split(r"\[([^\]]*)\]", pattern)
    fixed, optional = parts[::2], parts[1::2]
    for chosen in product((True, False), repeat=len(optional)):
        kept = [part if keep else "" for part, keep in zip(optional, chosen, strict=True)]
        yield "".join(a + b for a, b in zip(fixed, [*kept, ""], strict=True))


@dataclass(frozen=True)
class _Slot:
    """A word for the slot of a pattern and what it stands for."""

    word: str = ""
    label: str | None = None
    value: str | None = None


def _slots(
    table: QuestionTable, asks: Asks, domain: Domain, pattern: str, place: str
) -> list[_Slot]:
    """All ways to fill the slots of a pattern."""
    if "{class}" in pattern:
        if asks not in _ABOUT_A_CLASS:
            raise DomainError(f"{place}: '{pattern}' names {{class}}, but asks '{asks}'; remove it")
        return [
            _Slot(word=word, label=key)
            for key, scene_class in domain.classes.items()
            for word in scene_class.words
        ]
    if asks in _ABOUT_A_CLASS:
        raise DomainError(f"{place}: '{pattern}' asks about a class; name it as {{class}}")
    if "{value}" in pattern:
        if table.feature is None or asks is not Asks.FEATURE_IS or table.value is not None:
            raise DomainError(
                f"{place}: '{pattern}' names {{value}}; that goes with asks = 'feature_is', a "
                "feature, and no value of its own"
            )
        feature = domain.features[table.feature]
        return [
            _Slot(word=word, value=value)
            for value in feature.values
            for word in feature.words[value]
        ]
    if asks is Asks.FEATURE_IS and table.value is None:
        raise DomainError(f"{place}: '{pattern}' needs {{value}}, or the question a 'value'")
    return [_Slot(value=table.value)]


def _check_table(table: QuestionTable, domain: Domain, place: str) -> Asks:
    if table.asks not in _ASKED_BY_TEMPLATES:
        raise DomainError(
            f"{place}: asks = '{table.asks}' is not known; "
            f"{did_you_mean(table.asks, [asks.value for asks in _ASKED_BY_TEMPLATES])}"
        )
    asks = Asks(table.asks)
    if asks in _ABOUT_A_FEATURE and table.feature is None:
        raise DomainError(f"{place}: asks = '{asks}' needs a feature; add feature = \"…\"")
    if asks not in _ABOUT_A_FEATURE and table.feature is not None:
        raise DomainError(f"{place}: asks = '{asks}' is about no feature; remove 'feature'")
    if asks is Asks.BELIEF_VALUE and table.predicate is None:
        raise DomainError(f"{place}: asks = '{asks}' needs a static; add predicate = \"…\"")
    if asks is not Asks.BELIEF_VALUE and table.predicate is not None:
        raise DomainError(f"{place}: asks = '{asks}' is about no static; remove 'predicate'")
    if table.predicate is not None and table.predicate in domain.features:
        raise DomainError(
            f"{place}: '{table.predicate}' is a feature; ask for it with asks = "
            f"'{Asks.FEATURE_VALUE}' and feature = \"{table.predicate}\""
        )
    if table.predicate is not None and table.predicate not in domain.beliefs:
        raise DomainError(
            f"{place}: '{table.predicate}' is no static of knowledge.al that gives "
            f"'{domain.scene}' a value; {did_you_mean(table.predicate, domain.beliefs)}"
        )
    if table.feature is not None and table.feature not in domain.features:
        raise DomainError(
            f"{place}: '{table.feature}' is no feature of domain.toml; "
            f"{did_you_mean(table.feature, domain.features)}"
        )
    if table.value is not None:
        values = domain.features[table.feature].values if table.feature else ()
        if table.value not in values:
            raise DomainError(
                f"{place}: '{table.value}' is no value of '{table.feature}'; "
                f"{did_you_mean(table.value, values)}"
            )
    return asks
