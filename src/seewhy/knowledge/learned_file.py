"""The file of learned axioms: the knowledge language, with what each axiom rests on above it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.errors import KnowledgeError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.signature import Signature

__all__ = [
    "LEARNED",
    "Withdrawn",
    "learned_text",
    "parse_learned",
    "parse_withdrawn",
    "read_learned",
    "with_origins",
    "write_learned",
]

LEARNED = "learned.al"

_FROM = re.compile(r"% learned from (\d+) (.+), ([0-9.]+) % of them rightly$")
_RESTS = re.compile(r"% rests on (.+)$")
_WITHDRAWN = re.compile(r"% (withdrawn|set aside): (.+?\.) because (.+)$")


@dataclass(frozen=True)
class Withdrawn:
    """An axiom that was learned once and is known no more, or a given one that is set aside."""

    statement: str
    reason: str
    given: bool = False

    @property
    def fate(self) -> str:
        """What became of the axiom, in words."""
        return "set aside" if self.given else "withdrawn"


def learned_text(
    axioms: Iterable[Axiom],
    withdrawn: Iterable[Withdrawn] = (),
    *,
    source: str = "annotated pictures",
) -> str:
    """Return learned axioms as the text of a file; ``source`` is what they were learned from.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> (axiom,) = read_knowledge('''#sort structure. #static stable(structure).
    ... %% all are stable
    ... stable(S) if structure(S).''').axioms
    >>> origin = Origin(learned=True, support=3, pictures=("a.png",), things="structures")
    >>> print(learned_text([replace(axiom, origin=origin)], [Withdrawn("-stable(S).", "it fell")]))
    % Axioms that 'seewhy learn' found in annotated pictures.
    <BLANKLINE>
    %% all are stable
    % learned from 3 structures, 100.0 % of them rightly
    % rests on a.png
    stable(S) if structure(S).
    <BLANKLINE>
    % withdrawn: -stable(S). because it fell
    <BLANKLINE>
    """
    lines = [f"% Axioms that 'seewhy learn' found in {source}.", ""]
    for axiom in axioms:
        origin = axiom.origin
        lines += [
            f"%% {axiom.text}",
            f"% learned from {origin.support} {origin.things}, {100 * origin.precision:.1f} % of "
            "them rightly",
            *(f"% rests on {picture}" for picture in origin.pictures),
            str(axiom),
            "",
        ]
    lines += [
        f"% {withdrawal.fate}: {withdrawal.statement} because {withdrawal.reason}"
        for withdrawal in withdrawn
    ]
    return "\n".join(lines) + "\n"


def write_learned(
    folder: Path, axioms: Iterable[Axiom], withdrawn: Iterable[Withdrawn] = ()
) -> None:
    """Write ``learned.al`` into a folder."""
    write_whole(folder / LEARNED, learned_text(axioms, withdrawn))


def read_learned(
    path: Path, signature: Signature
) -> tuple[tuple[Axiom, ...], tuple[Withdrawn, ...]]:
    """Read what :func:`write_learned` wrote; without a file, nothing was learned.

    Raises
    ------
    KnowledgeError
        If an axiom is wrong, or nothing says what it rests on.
    """
    if not path.is_file():
        return (), ()
    source = path.read_text(encoding="utf-8")
    return parse_learned(source, signature, file=str(path)), parse_withdrawn(source)


def parse_withdrawn(source: str) -> tuple[Withdrawn, ...]:
    """Read which axioms are known no more, of the text of :func:`learned_text`.

    Examples
    --------
    >>> parse_withdrawn("% set aside: stable(S). because nobody believes it")
    (Withdrawn(statement='stable(S).', reason='nobody believes it', given=True),)
    """
    found = (match for line in source.splitlines() if (match := _WITHDRAWN.match(line)))
    gone = (parsed.groups() for parsed in found)
    return tuple(
        Withdrawn(statement, reason, fate == "set aside") for fate, statement, reason in gone
    )


def parse_learned(source: str, signature: Signature, *, file: str = LEARNED) -> tuple[Axiom, ...]:
    """Read the axioms of :func:`learned_text` with what they rest on, numbered in their order.

    Raises
    ------
    KnowledgeError
        As :func:`read_learned`.
    """
    lines = source.splitlines()
    return tuple(
        replace(axiom, origin=_origin(axiom, lines))
        for axiom in read_axioms(source, signature, file=file)
    )


def with_origins(axioms: Iterable[Axiom], source: str) -> tuple[Axiom, ...]:
    """Return axioms of a text with what they rest on, where comments above them say it.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> text = '''#sort structure. #static stable(structure).
    ... %% all are stable
    ... % learned from 3 structures, 100.0 % of them rightly
    ... stable(S) if structure(S).'''
    >>> [axiom.origin.support for axiom in with_origins(read_knowledge(text).axioms, text)]
    [3]
    """
    lines = source.splitlines()
    found = ((axiom, _origin_above(axiom, lines)) for axiom in axioms)
    return tuple(
        axiom if origin is None else replace(axiom, origin=origin) for axiom, origin in found
    )


def _origin(axiom: Axiom, lines: Sequence[str]) -> Origin:
    """What the comment lines above an axiom say of it."""
    found = _origin_above(axiom, lines)
    if found is None:
        raise KnowledgeError(
            f"{axiom.location}: nothing says what this axiom was learned from; put axioms of your "
            "own into knowledge.al"
        )
    return found


def _origin_above(axiom: Axiom, lines: Sequence[str]) -> Origin | None:
    pictures: list[str] = []
    for line in reversed(lines[: axiom.location.line - 1]):
        if rests := _RESTS.match(line):
            pictures.append(rests.group(1))
        elif learned := _FROM.match(line):
            support, things, share = learned.groups()
            return Origin(
                learned=True,
                support=int(support),
                precision=float(share) / 100,
                pictures=tuple(reversed(pictures)),
                things=things,
            )
        else:
            break
    return None
