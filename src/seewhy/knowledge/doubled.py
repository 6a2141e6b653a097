"""Axioms that say nothing beside another: the same twice, or one that asks more for the same."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.knowledge.axiom import Axiom, substitute, variables_in

__all__ = ["doubled"]


def doubled(axioms: Sequence[Axiom]) -> list[str]:
    """Return a sentence for every axiom that another one makes idle.

    Compared is how axioms are written, apart from the names of variables and the order of
    conditions: that ``N > 3`` includes ``N > 2`` is not seen.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort apple. #static brown(apple). #static soft(apple). #static bad(apple).
    ... bad(A) if brown(A).
    ... bad(B) if soft(B), brown(B).
    ... bad(X) if brown(X).
    ... ''')
    >>> for note in doubled(known.axioms): print(note)
    knowledge.al:4:1: 'bad(B) if soft(B), brown(B).' adds nothing: line 3 concludes it without \
'soft(B)'
    knowledge.al:5:1: 'bad(X) if brown(X).' is the axiom of line 3 once more
    """
    said: list[str] = []
    forms = [_form(axiom) for axiom in axioms]
    for position, (axiom, (head, body)) in enumerate(zip(axioms, forms, strict=True)):
        for other_position, (other, (other_head, other_body)) in enumerate(
            zip(axioms, forms, strict=True)
        ):
            if axiom is other or head != other_head or not set(other_body) <= set(body):
                continue
            place = _place(other, beside=axiom)
            if set(body) == set(other_body):
                if other_position < position:
                    said.append(f"{axiom.location}: '{axiom}' is the axiom of {place} once more")
                    break
                continue
            more = [
                condition.text
                for condition, form in zip(axiom.body, body, strict=True)
                if form not in other_body
            ]
            said.append(
                f"{axiom.location}: '{axiom}' adds nothing: {place} concludes it without "
                f"'{', '.join(more)}'"
            )
            break
    return said


def _place(other: Axiom, *, beside: Axiom) -> str:
    same_file = other.location.file == beside.location.file
    return f"line {other.location.line}" if same_file else str(other.location)


def _form(axiom: Axiom) -> tuple[str, list[str]]:
    """An axiom's head and conditions with variables named in the order in which they appear."""
    texts = [condition.text for condition in axiom.body]
    # In an order that no name has a say in.
    ordered = sorted(
        texts, key=lambda text: substitute(text, dict.fromkeys(variables_in(text), "_"))
    )
    head = f"{axiom.kind.value} {axiom.action or ''} {axiom.head}"
    named: dict[str, str] = {}
    for text in (head.split(" ", 1)[1], *ordered):
        for variable in variables_in(text):
            named.setdefault(variable, f"V{len(named) + 1}")
    return substitute(head, named), [substitute(text, named) for text in texts]
