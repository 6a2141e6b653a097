"""A history: what was observed and what was done, step by step, as a file or in memory."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.ground_literal import read_ground_literal
from seewhy.knowledge.signature import PredicateKind, Signature
from seewhy.knowledge.statements import Statement, statements
from seewhy.text.nearest import did_you_mean

_STATEMENT = re.compile(r"([a-z]+)(\s+)(.+?)\s+at\s+(\d{1,6})\s*$", re.DOTALL)
_FACT = re.compile(r"-?\s*([a-z]\w*)\s*\(.*\)\s*$", re.DOTALL)
_WORDS = ("observed", "happened", "attempted")


@dataclass(frozen=True)
class Observation:
    """A literal about a fluent that was seen to hold at a step."""

    literal: Literal
    step: int

    def __str__(self) -> str:
        return f"observed {self.literal} at {self.step}."


@dataclass(frozen=True)
class Occurrence:
    """An action that happened between a step and the next.

    ``attempted`` is True where it is known only that it was tried: it may have failed.
    """

    action: Literal
    step: int
    attempted: bool = False

    def __str__(self) -> str:
        return f"{'attempted' if self.attempted else 'happened'} {self.action} at {self.step}."


@dataclass(frozen=True)
class History:
    """Observations and actions, in the order of the steps (statement (6) of the paper).

    ``statics`` is what the record of a run says of the things that it was about: what they are
    like, which never changes.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort place = {library, kitchen}. #fluent basic robot_in(place).")
    >>> history = read_history("observed robot_in(library) at 0.", known.signature)
    >>> history.last_step, [str(observation) for observation in history.observations]
    (0, ['observed robot_in(library) at 0.'])
    """

    observations: tuple[Observation, ...] = ()
    occurrences: tuple[Occurrence, ...] = ()
    statics: tuple[Literal, ...] = ()

    @property
    def last_step(self) -> int:
        """The step that the history reaches: that after its last action."""
        seen = [observation.step for observation in self.observations]
        return max([0, *seen, *(occurrence.step + 1 for occurrence in self.occurrences)])

    def with_observations(self, literals: Iterable[Literal], *, step: int) -> History:
        """Return the history with what was seen at a step; what is there already is not doubled."""
        new = dict.fromkeys(
            [*self.observations, *(Observation(literal, step) for literal in literals)]
        )
        return replace(self, observations=tuple(new))

    def with_occurrence(self, action: Literal, *, step: int, attempted: bool = False) -> History:
        """Return the history with an action that happened, or was tried, at a step."""
        return replace(self, occurrences=(*self.occurrences, Occurrence(action, step, attempted)))

    def __str__(self) -> str:
        facts = (f"{literal}." for literal in self.statics)
        return "\n".join([*facts, *map(str, (*self.observations, *self.occurrences))])


def history_text(history: History, *, title: str) -> str:
    """Return a history as the text of a file, step by step, under a comment that says what it is.

    What never changes stands before the first step.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic lit. #action press. press causes lit.")
    >>> source = "observed -lit at 0. observed lit at 1. happened press at 0."
    >>> print(history_text(read_history(source, known.signature), title="a lamp"))
    % a lamp
    observed -lit at 0.
    happened press at 0.
    observed lit at 1.
    <BLANKLINE>
    """
    entries: list[Observation | Occurrence] = [*history.observations, *history.occurrences]
    entries.sort(key=lambda entry: entry.step)
    facts = (f"{literal}." for literal in history.statics)
    return "\n".join([f"% {' '.join(title.split())}", *facts, *map(str, entries), ""])


def read_history_file(path: Path | str, signature: Signature) -> History:
    """Read a history from a file; errors as :func:`read_history`."""
    path = Path(path)
    try:
        source = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise KnowledgeError(f"{path}: there is no such file") from None
    except (OSError, UnicodeDecodeError) as problem:
        raise KnowledgeError(f"{path}: cannot be read as UTF-8 text ({problem})") from None
    return read_history(source, signature, file=str(path))


def read_history(source: str, signature: Signature, *, file: str = "history.al") -> History:
    """Read ``observed literal at step.``, ``happened action at step.`` and ``attempted …``.

    A literal about a static alone, such as ``colour(thing1, red).``, is what never changed.

    Raises
    ------
    KnowledgeError
        Where a statement is none of these, speaks of something unknown, or contradicts another
        of the same step; the text names file, line and column.
    """
    observations: dict[Observation, Statement] = {}
    occurrences: dict[Occurrence, Statement] = {}
    statics: dict[Literal, Statement] = {}
    for statement in statements(source, file=file):
        if _is_fact(statement.text, signature):
            fact = read_ground_literal(
                statement.text, signature, of="static", place=statement.location
            )
            _refuse_denied(statement, fact, statics)
            statics.setdefault(fact, statement)
            continue
        match = _STATEMENT.match(statement.text)
        word = match.group(1) if match else statement.text.split()[0]
        if match is None or word not in _WORDS:
            remedy = "" if word in _WORDS else f"; {did_you_mean(word, _WORDS)}"
            raise KnowledgeError(
                f"{statement.location}: a history says 'observed literal at step.', 'happened "
                f"action at step.' or 'attempted action at step.', got '{statement.line}'{remedy}"
            )
        step = int(match.group(4))
        place = statement.place(statement.location.line, statement.location.column + match.start(3))
        if word == "observed":
            literal = read_ground_literal(match.group(3), signature, of="fluent", place=place)
            _refuse_contradiction(statement, literal, step, observations)
            observations.setdefault(Observation(literal, step), statement)
        else:
            action = read_ground_literal(match.group(3), signature, of="action", place=place)
            occurrences.setdefault(
                Occurrence(action, step, attempted=word == "attempted"), statement
            )
    return History(
        tuple(sorted(observations, key=lambda observation: observation.step)),
        tuple(sorted(occurrences, key=lambda occurrence: occurrence.step)),
        tuple(statics),
    )


def _is_fact(text: str, signature: Signature) -> bool:
    """Whether a statement says a literal about a static, and nothing of a step."""
    match = _FACT.match(text)
    declared = signature.predicates.get(match.group(1)) if match else None
    return declared is not None and declared.kind is PredicateKind.STATIC


def _refuse_denied(statement: Statement, fact: Literal, earlier: dict[Literal, Statement]) -> None:
    first = earlier.get(fact.complement)
    if first is not None:
        raise KnowledgeError(
            f"{statement.location}: '{fact}' is said, and its opposite at {first.location}; remove "
            "one of the two"
        )


def _refuse_contradiction(
    statement: Statement, literal: Literal, step: int, earlier: dict[Observation, Statement]
) -> None:
    denied = key_of(literal.complement)
    for observation, first in earlier.items():
        if observation.step == step and key_of(observation.literal) == denied:
            raise KnowledgeError(
                f"{statement.location}: '{literal}' was observed at step {step}, and its opposite "
                f"at {first.location}; remove one of the two"
            )
