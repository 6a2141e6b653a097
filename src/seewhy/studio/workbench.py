"""What the page Label shows of one picture: questions, their values with keys, and proposals."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.new_domain.words import plain_words
from seewhy.studio.label import Label
from seewhy.studio.labels import Labels
from seewhy.studio.proposing import Proposals

__all__ = [
    "NO_THINGS_KEY",
    "RESERVED",
    "Choice",
    "Question",
    "Workbench",
    "letters_of",
    "question",
    "question_names",
    "value_keys",
    "workbench",
]

RESERVED = frozenset("ursax")
"""Letters that do something else than to lead to a feature: undo, redo, sheet, all, boxes."""

NO_THINGS_KEY = "n"
"""The letter that says that nothing is in the picture, where the domain has things."""

MOST_SHOWN = 10
"""Values that have a button and a key; of more, the most probable have."""


@dataclass(frozen=True)
class Choice:
    """A value that can be chosen.

    Attributes
    ----------
    value, words : str
    key : str
        The key that chooses it while its question is at hand.
    probability : float or None
        None where nothing is proposed.
    chosen, proposed : bool
        Whether somebody said it; whether it is what the heads propose, unconfirmed.
    """

    value: str
    words: str
    key: str
    probability: float | None
    chosen: bool
    proposed: bool


@dataclass(frozen=True)
class Question:
    """A feature, or the class, of the picture.

    Attributes
    ----------
    name, words : str
    key : str
        The letter that leads to it.
    choices : tuple of Choice
    others : tuple of str
        Values without a button.
    label : Label or None
        What somebody said.
    rules : str or None
        The class that the rules conclude, where it is another than the heads'.
    is_reason : bool
        Whether the class was said to rest on it.
    """

    name: str
    words: str
    key: str
    choices: tuple[Choice, ...]
    others: tuple[str, ...]
    label: Label | None
    rules: str | None = None
    is_reason: bool = False

    @property
    def is_class(self) -> bool:
        """Whether it asks for the class."""
        return self.name == CLASS

    @property
    def proposed(self) -> Choice | None:
        """What Enter would confirm."""
        return next((choice for choice in self.choices if choice.proposed), None)


@dataclass(frozen=True)
class Workbench:
    """All that is shown of one picture.

    Attributes
    ----------
    picture : str
    questions : tuple of Question
    at : str
        The question whose values the number keys choose.
    """

    picture: str
    questions: tuple[Question, ...]
    at: str

    @property
    def confirmable(self) -> dict[str, str]:
        """Feature or class → the value that Enter confirms."""
        return {
            question.name: question.proposed.value
            for question in self.questions
            if question.proposed is not None
        }


def question_names(domain: Domain, *, class_first: bool) -> tuple[str, ...]:
    """The features and the class, where there is one, in the order in which they are asked for."""
    features = tuple(domain.features)
    classes = (CLASS,) if domain.classes else ()
    return (*classes, *features) if class_first else (*features, *classes)


def workbench(
    picture: str,
    domain: Domain,
    labels: Labels,
    proposals: Proposals,
    *,
    class_first: bool,
    at: str = "",
) -> Workbench:
    """Return what is shown of a picture.

    Parameters
    ----------
    picture : str
    domain : Domain
    labels : Labels
    proposals : Proposals
    class_first : bool
        Whether the class is asked for before the features, which then follow from it.
    at : str
        The question at hand; the first that is open where it is none.
    """
    names = question_names(domain, class_first=class_first)
    taken = {"c", *RESERVED, *(NO_THINGS_KEY if domain.things is not None else "")}
    letters = {CLASS: "c"} | letters_of([name for name in names if name != CLASS], taken=taken)
    said = labels.of.get(picture, {})
    if at not in names:
        at = next((name for name in names if name not in said), next(iter(names), ""))
    questions = []
    for name in names:
        values = tuple(domain.classes) if name == CLASS else domain.features[name].values
        found = question(
            name,
            "class" if name == CLASS else domain.features[name].name,
            values,
            key=letters[name],
            label=said.get(name),
            shares=proposals.of(picture, name),
        )
        rules = proposals.by_rules.get(picture) if name == CLASS else None
        best = found.proposed
        disputed = rules is not None and best is not None and rules != best.value
        questions.append(
            replace(
                found,
                rules=rules if disputed else None,
                is_reason=name in labels.reasons.get(picture, ()),
            )
        )
    return Workbench(picture, tuple(questions), at)


def question(
    name: str,
    words: str,
    values: Sequence[str],
    *,
    key: str,
    label: Label | None,
    shares: Mapping[str, float] = MappingProxyType({}),
) -> Question:
    """Return a question with its values, some of which are proposed where nothing is said.

    Parameters
    ----------
    name, words : str
    values : sequence of str
    key : str
        The letter that leads to it.
    label : Label or None
        What somebody said.
    shares : mapping of str to float
        Value → probability, the most probable first; empty where nothing is proposed.
    """
    shown = _shown(values, shares, label)
    best = next(iter(shares), None) if label is None else None
    return Question(
        name=name,
        words=words,
        key=key,
        choices=tuple(
            Choice(
                value,
                plain_words(value),
                value_key,
                shares.get(value),
                chosen=label is not None and label.value == value,
                proposed=value == best,
            )
            for value, value_key in zip(shown, value_keys(shown), strict=True)
        ),
        others=tuple(value for value in values if value not in shown),
        label=label,
    )


def value_keys(values: Sequence[str]) -> list[str]:
    """The key of each of at most ten values: what they are called where these are digits.

    Examples
    --------
    >>> value_keys(["red", "green"]), value_keys(["0", "1", "2"])
    (['1', '2'], ['0', '1', '2'])
    """
    if all(len(value) == 1 and value.isdecimal() and value.isascii() for value in values):
        return list(values)
    return [str((place + 1) % 10) for place in range(len(values))]


def _shown(
    values: Sequence[str], shares: Mapping[str, float], label: Label | None
) -> tuple[str, ...]:
    if len(values) <= MOST_SHOWN:
        return tuple(values)
    first = [label.value] if label is not None and label.value in values else []
    ranked = [*first, *(value for value in (*shares, *values) if value not in first)]
    return tuple(dict.fromkeys(ranked))[:MOST_SHOWN]


def letters_of(names: Sequence[str], *, taken: Collection[str]) -> dict[str, str]:
    """A letter for each name: one of its own where that is not taken.

    Examples
    --------
    >>> letters_of(["size", "colour"], taken="s")
    {'size': 'i', 'colour': 'c'}
    """
    found: dict[str, str] = {}
    used = set(taken)
    for name in names:
        wanted = [letter for letter in name if letter.isascii() and letter.isalpha()]
        letter = next(
            (
                candidate
                for candidate in (*wanted, *"abcdefghijklmnopqrstuvwxyz")
                if candidate not in used
            ),
            "",
        )
        found[name] = letter
        used.add(letter)
    return found
