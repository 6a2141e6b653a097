"""Axioms put into a knowledge file, or given one more condition; the rest stays as it was typed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seewhy.errors import RevisionError
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn, learned_text
from seewhy.knowledge.statements import Statement, statements
from seewhy.revision.edit import KNOWLEDGE, LEARNED, Edit, FileName, newline_of, raw_places

__all__ = [
    "axiom_added",
    "condition_added",
    "learned_removed",
    "narrowed_statement",
    "with_learned",
]

_PICTURES = 3
"""So many pictures are named above a learned axiom in a file that somebody writes."""


def axiom_added(text: str, statement: str, sentence: str) -> Edit:
    r"""Return the edit by which an axiom and its sentence stand at the end of a knowledge file.

    Examples
    --------
    >>> axiom_added("stable(S) if low(S).\n", "-stable(S) if lean(S).", "what leans falls").after
    '\n%% what leans falls\n-stable(S) if lean(S).\n'
    """
    newline = newline_of(text)
    between = newline if not text or text.endswith(("\n", "\r")) else newline * 2
    added = f"{between}%% {' '.join(sentence.split())}{newline}{statement}{newline}"
    return Edit(KNOWLEDGE, len(text), "", added)


def condition_added(text: str, axiom: Axiom, condition: str, said: str) -> Edit:
    """Return the edit by which an axiom asks one more condition, and its sentence says so.

    Parameters
    ----------
    text : str
        The file, as it stands on the disk.
    axiom : Axiom
        As it was read from this text.
    condition : str
        In the language, with the axiom's variables.
    said : str
        What the sentence above the axiom says more; nothing is written where it has none.

    Raises
    ------
    RevisionError
        If the axiom does not stand in the text where it was read.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> text = '''#sort thing. #static wet(thing). #static old(thing). #static bad(thing).
    ... %% what is wet is bad
    ... bad(T) if wet(T). % so it is
    ... '''
    >>> axiom = read_knowledge(text).axioms[0]
    >>> edit = condition_added(text, axiom, "not old(T)", "unless it is old")
    >>> print(edit.applied(text).split("thing).")[-1])
    <BLANKLINE>
    %% what is wet is bad, unless it is old
    bad(T) if wet(T), not old(T). % so it is
    <BLANKLINE>
    """
    statement = _statement_of(text, axiom)
    places = raw_places(text)
    begins, stops = places[statement.begins], places[statement.stops]
    before = text[begins : stops + 1]
    after = f"{before[:-1]}{_joined_by(axiom)} {condition}."
    if statement.sentence:
        end = places[statement.said] - begins
        sentence = before[:end].rstrip()
        after = f"{sentence.removesuffix('.')}, {said}{after[len(sentence) :]}"
    return Edit(KNOWLEDGE, begins, before, after)


def narrowed_statement(axiom: Axiom, condition: str) -> str:
    """Return an axiom's statement with one more condition.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_axioms, read_knowledge
    >>> known = read_knowledge("#sort thing. #static wet(thing). #static bad(thing).")
    >>> narrowed_statement(read_axioms("bad(T) if wet(T).", known.signature)[0], "not old(T)")
    'bad(T) if wet(T), not old(T).'
    """
    return f"{str(axiom)[:-1]}{_joined_by(axiom)} {condition}."


def learned_removed(text: str, axiom: Axiom) -> Edit:
    """Return the edit by which a learned axiom is gone from the file of learned axioms.

    Raises
    ------
    RevisionError
        If the axiom does not stand in the text.

    Examples
    --------
    >>> from seewhy.knowledge.learned_file import learned_text
    >>> from seewhy.knowledge.language import read_axioms, read_knowledge
    >>> known = read_knowledge("#sort thing. #static wet(thing). #static bad(thing).")
    >>> axioms = read_axioms("bad(T) if wet(T). -bad(T) if -wet(T).", known.signature)
    >>> left = learned_removed(learned_text(axioms), axioms[0]).applied(learned_text(axioms))
    >>> left == learned_text(axioms[1:])
    True
    """
    return _statement_removed(text, str(axiom), LEARNED)


def _statement_removed(text: str, statement: str, file: FileName) -> Edit:
    lines = text.splitlines(keepends=True)
    found = [number for number, line in enumerate(lines) if line.rstrip() == statement]
    if not found:
        raise RevisionError(f"{file} has changed: '{statement}' does not stand there any more")
    first = found[0]
    while first and lines[first - 1].startswith("%"):
        first -= 1
    block = "".join(lines[first : found[0] + 2])
    return Edit(file, len("".join(lines[:first])), block, "")


def with_learned(text: str, added: Sequence[Axiom], withdrawn: Sequence[Withdrawn]) -> str:
    r"""Return a knowledge file with learned axioms at its end, and without those withdrawn.

    A few of the pictures that an axiom rests on are named above it.

    Raises
    ------
    RevisionError
        If an axiom that is withdrawn does not stand in the text.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_axioms, read_knowledge
    >>> known = read_knowledge("#sort thing. #static wet(thing). #static bad(thing).")
    >>> (axiom,) = read_axioms("bad(T) if wet(T).", known.signature)
    >>> text = with_learned("#static bad(thing).\n", [axiom], [])
    >>> with_learned(text, [], [Withdrawn(str(axiom), "it was otherwise")]).splitlines()[-1]
    '% withdrawn: bad(T) if wet(T). because it was otherwise'
    """
    for gone in withdrawn:
        text = _statement_removed(text, gone.statement, KNOWLEDGE).applied(text)
    few = [
        replace(axiom, origin=replace(axiom.origin, pictures=axiom.origin.pictures[:_PICTURES]))
        for axiom in added
    ]
    heading, _, said = learned_text(few, withdrawn).partition("\n\n")
    if not said.strip():
        return text
    newline = newline_of(text)
    lines = [*([] if heading in text else [heading, ""]), said.rstrip("\n"), ""]
    return f"{text.rstrip()}{newline * 2}{newline.join(newline.join(lines).splitlines())}{newline}"


def _joined_by(axiom: Axiom) -> str:
    """What stands between an axiom and one more condition of it."""
    if not axiom.body:
        return " if"
    last = axiom.body[-1]
    return ";" if last.is_local and "{" not in last.text else ","


def _statement_of(text: str, axiom: Axiom) -> Statement:
    place = (axiom.location.line, axiom.location.column)
    for statement in statements(text, file=axiom.location.file):
        if (statement.location.line, statement.location.column) == place:
            return statement
    raise RevisionError(
        f"{axiom.location}: '{axiom}' does not stand there any more; ask again, so that the file "
        "is read as it is now"
    )
