"""A belief's justification: a tree of literals, axioms and features, for people and programs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from html import escape
from itertools import chain
from typing import Any

from seewhy.knowledge.axiom import Axiom


class Basis(StrEnum):
    """What a node of a justification rests on."""

    FEATURE = "feature"
    AXIOM = "axiom"
    DEFAULT = "default"
    REASONS = "several reasons"
    ABSENCE = "absence"
    COMPARISON = "comparison"
    JOINTLY = "several literals"
    ASSUMED = "assumed"
    CASES = "several answer sets"
    OTHERWISE = "without the exception"
    CONSISTENCY = "nothing else is consistent"
    TOLD_BEFORE = "told before"
    FACT = "fact"
    EXCEPTION = "exception"
    CONFLICT = "conflict"
    UNFOUNDED = "nothing concludes it"
    TREE = "decision tree"
    PATH = "path of the tree"
    PICTURES = "annotated pictures"
    RECURRENT = "recurrent network"
    CLASS_SEEN = "class seen by itself"


@dataclass(frozen=True)
class Node:
    """One step of a justification.

    Attributes
    ----------
    literal : str
        The literal or condition in the knowledge language.
    text : str
        The same as a clause in words.
    basis : Basis
    holds : bool
        False where a justification says why something is not believed.
    axiom : Axiom or None
        The axiom that was used, with its text and place.
    feature, value : str or None
        The feature and the value that the picture shows.
    probability : float or None
        The network's probability of that value.
    children : tuple of Node
        What the step rests on.
    overruled : (str, float) or None
        The more probable value that the network alone saw, where it does not fit what is known.
    beside : tuple of str
        Further features that its text tells together with ``feature``, as that nothing else is in
        the picture.

    Examples
    --------
    >>> leaf = Node(literal="lean(structure)", text="it leans", basis=Basis.FEATURE)
    >>> print(Node("-stable(structure)", "it falls", Basis.AXIOM, children=(leaf,)).to_text())
    it falls
    └─ it leans
    """

    literal: str
    text: str
    basis: Basis
    holds: bool = True
    axiom: Axiom | None = None
    feature: str | None = None
    value: str | None = None
    probability: float | None = None
    children: tuple[Node, ...] = ()
    overruled: tuple[str, float] | None = None
    beside: tuple[str, ...] = ()

    def walk(self) -> Iterator[Node]:
        """Yield this node and all below it, parents first."""
        yield self
        for child in self.children:
            yield from child.walk()

    def features(self) -> tuple[str, ...]:
        """Return the features that the justification rests on, each once."""
        named = ((node.feature, *node.beside) for node in self.walk() if node.feature is not None)
        return tuple(dict.fromkeys(chain.from_iterable(named)))

    def with_probabilities(
        self,
        seen: Mapping[str, tuple[str, float]],
        overruled: Mapping[str, tuple[str, float]] | None = None,
    ) -> Node:
        """Return the tree with the probability of every value that the picture shows.

        ``seen`` gives each feature's value and its probability, ``overruled`` the value that the
        network alone saw where it is another. The values of a proposed change are no readings
        and have no probability.
        """
        value, probability = seen.get(self.feature or "", (None, None))
        shown = self.feature is not None and self.value in (None, value)
        alone = (overruled or {}).get(self.feature or "")
        return replace(
            self,
            probability=probability if shown else self.probability,
            overruled=alone if shown else self.overruled,
            children=tuple(child.with_probabilities(seen, overruled) for child in self.children),
        )

    def label(self) -> str:
        """Return the node as one line: its clause, the axiom's sentence, the probability."""
        line = self.text
        if self.axiom is not None:
            place = self.axiom.location
            origin = self.axiom.origin
            learned = f", learned from {origin.support} {origin.things}" if origin.learned else ""
            file = place.file.replace("\\", "/").rsplit("/", 1)[-1]
            said = f'"{self.axiom.text}" ({file}:{place.line}{learned})'
            if self.is_refuted:
                line = f"does not apply: {said}"
            else:
                line = f"{'but ' if self.is_in_the_way else ''}{line}: {said}"
        elif self.is_in_the_way:
            line = f"but {line}"
        if self.probability is not None:
            line += f" (p = {self.probability:.2f}{self._said_overruled()})"
        return line

    def _said_overruled(self) -> str:
        if self.overruled is None:
            return ""
        value, probability = self.overruled
        return f"; the network alone saw {value}, p = {probability:.2f}"

    @property
    def is_refuted(self) -> bool:
        """Whether its axiom is one that does not apply, and its children say why."""
        if self.axiom is None or self.holds or self.basis is Basis.OTHERWISE:
            return False
        head = self.axiom.head
        name = f"{'' if head.positive else '-'}{head.predicate}"
        return self.literal.split("(", 1)[0] == name

    @property
    def is_in_the_way(self) -> bool:
        """Whether it says what is so instead of a condition that fails."""
        if self.holds or self.is_refuted or self.basis is Basis.OTHERWISE:
            return False
        return self.axiom is not None or self.basis in (
            Basis.FEATURE,
            Basis.COMPARISON,
            Basis.JOINTLY,
        )

    def to_text(self) -> str:
        """Return the tree as indented lines."""
        return "\n".join(_lines(self, "", ""))

    def _repr_html_(self) -> str:
        """What a notebook shows: the tree, whose steps fold."""
        line = escape(self.label())
        if not self.children:
            return f"<div>{line}</div>"
        below = "".join(child._repr_html_() for child in self.children)
        inside = f'<div style="margin-left: 1.5em">{below}</div>'
        return f"<details open><summary>{line}</summary>{inside}</details>"

    def to_dict(self) -> dict[str, Any]:
        """Return the tree as values that JSON can hold."""
        axiom = self.axiom
        return {
            "literal": self.literal,
            "text": self.text,
            "basis": self.basis.value,
            "holds": self.holds,
            "axiom": None
            if axiom is None
            else {
                "identifier": axiom.identifier,
                "text": axiom.text,
                "statement": str(axiom),
                "file": axiom.location.file,
                "line": axiom.location.line,
                "learned": axiom.origin.learned,
                "support": axiom.origin.support if axiom.origin.learned else None,
            },
            "feature": self.feature,
            "value": self.value,
            **({"beside": list(self.beside)} if self.beside else {}),
            "probability": self.probability,
            "overruled": None
            if self.overruled is None
            else {"value": self.overruled[0], "probability": self.overruled[1]},
            "children": [child.to_dict() for child in self.children],
        }


def _lines(node: Node, first: str, rest: str) -> Iterator[str]:
    yield first + node.label()
    for number, child in enumerate(node.children, start=1):
        last = number == len(node.children)
        yield from _lines(
            child, rest + ("└─ " if last else "├─ "), rest + ("   " if last else "│  ")
        )
