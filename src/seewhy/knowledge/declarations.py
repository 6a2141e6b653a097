"""Read the declarations of a knowledge file: sorts, statics, fluents and actions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import clingo

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import STRING
from seewhy.knowledge.signature import Location, Predicate, PredicateKind, Sort
from seewhy.knowledge.statements import Statement, one_line
from seewhy.text.nearest import did_you_mean

_NAME = r"_*[a-z][A-Za-z0-9_]*"
_NAMES = re.compile(_NAME)
_SORT = re.compile(rf"#sort\s+({_NAME})\s*(?:=\s*(\S.*))?$", re.DOTALL)
_UNION = re.compile(rf"{_NAME}(?:\s*\+\s*{_NAME})*$")
_RANGE = re.compile(r"(-?\d+)\s*\.\.\s*(-?\d+)$")
_PREDICATE = re.compile(rf"({_NAME})\s*(?:\(([^()]*)\))?\s*$", re.DOTALL)
_KINDS = {
    "#static": PredicateKind.STATIC,
    "#fluent basic": PredicateKind.FLUENT_BASIC,
    "#fluent defined": PredicateKind.FLUENT_DEFINED,
    "#action exogenous": PredicateKind.EXOGENOUS_ACTION,
    "#action": PredicateKind.ACTION,
}
_DIRECTIVES = ("#sort", "#static", "#fluent", "#action")
_MOST_MEMBERS = 10_000
_THINGS = "things"
"""What the members of a sort are that stands for whatever is found in the picture."""
_WORDS = ("not", "if", "causes")
_FIRST_WORDS = ("default", "impossible")


class Declarations:
    """The sorts and predicates declared so far, in the order of the file."""

    def __init__(self) -> None:
        self.sorts: dict[str, Sort] = {}
        self.predicates: dict[str, Predicate] = {}

    def add(self, statement: Statement) -> None:
        """Read one statement that begins with ``#``.

        Raises
        ------
        KnowledgeError
            Where it declares nothing, something unknown, or something a second time.
        """
        word = statement.text.split()[0]
        if word == "#sort":
            sort = _read_sort(statement, self.sorts)
            _refuse_reserved(sort.name, "sort", (*_WORDS, *_FIRST_WORDS), statement)
            for name in sorted(set().union(*map(_names_in, sort.members or ()))):
                _refuse_reserved(name, f"member of sort '{sort.name}'", _WORDS, statement)
            self._refuse_second(sort.name, sort.location)
            self.sorts[sort.name] = sort
        elif word in _DIRECTIVES:
            predicate = _read_predicate(statement, self.sorts)
            _refuse_reserved(
                predicate.name, predicate.kind.value, (*_WORDS, *_FIRST_WORDS), statement
            )
            self._refuse_second(predicate.name, predicate.location)
            self.predicates[predicate.name] = predicate
        else:
            raise KnowledgeError(
                f"{statement.location}: found '{word}', expected a declaration; "
                f"{did_you_mean(word, _DIRECTIVES)}"
            )

    def _refuse_second(self, name: str, location: Location) -> None:
        known: dict[str, Sort | Predicate] = {**self.sorts, **self.predicates}
        if name in known:
            raise KnowledgeError(
                f"{location}: '{name}' is declared a second time (first at "
                f"{known[name].location}); remove one of the two or rename it"
            )


def _refuse_reserved(name: str, what: str, words: Iterable[str], statement: Statement) -> None:
    """Refuse the language's own words, and names such as the programs give to what they add."""
    if name in words:
        raise KnowledgeError(
            f"{statement.location}: '{name}' is a word of the language and cannot be the name of "
            f"a {what}; call it otherwise, '{name}_it' for instance"
        )
    if name.endswith("__"):
        raise KnowledgeError(
            f"{statement.location}: '{name}' is no name of a {what}: names that end in '__' are "
            f"kept for what is added to the knowledge; call it '{name.rstrip('_')}'"
        )


def _names_in(member: str) -> set[str]:
    """The names that a term is made of, those in texts left out."""
    return set(_NAMES.findall(STRING.sub("", member)))


def _read_sort(statement: Statement, sorts: Mapping[str, Sort]) -> Sort:
    match = _SORT.match(statement.text)
    if match is None:
        raise KnowledgeError(
            f"{statement.location}: a sort is declared as '#sort name.', '#sort name = 1..5.', "
            f"'#sort name = {{a, b}}.', '#sort name = sort + sort.' or '#sort name = things.', got "
            f"'{statement.line}'"
        )
    name, definition = match.group(1), (match.group(2) or "").strip()
    members: tuple[str, ...] | None = None
    if definition == _THINGS and _THINGS not in sorts:
        _refuse_second_found(name, statement, sorts)
        return Sort(name=name, members=None, location=statement.location, of_things=True)
    if definition:
        span = _RANGE.match(definition)
        if span:
            members = _read_range(span.group(1), span.group(2), name, statement)
        elif definition.startswith("{") and definition.endswith("}"):
            members = _read_members(definition[1:-1].strip(), statement)
        elif _UNION.match(definition):
            members = _read_union(definition, name, statement, sorts)
        else:
            raise KnowledgeError(
                f"{statement.location}: the members of sort '{name}' must be a range (1..5), a "
                "set ({wide, narrow}) or other sorts (robot + person), got "
                f"'{one_line(definition)}'"
            )
        if not members:
            raise KnowledgeError(
                f"{statement.location}: sort '{name}' has no members; give at least one"
            )
        if len(set(members)) < len(members):
            twice = next(m for m in members if members.count(m) > 1)
            raise KnowledgeError(
                f"{statement.location}: sort '{name}' lists '{twice}' twice; remove one of them"
            )
    return Sort(name=name, members=members, location=statement.location)


def _refuse_second_found(name: str, statement: Statement, sorts: Mapping[str, Sort]) -> None:
    first = next((sort for sort in sorts.values() if sort.of_things), None)
    if first is not None:
        raise KnowledgeError(
            f"{statement.location}: '{name}' is a second sort of things (the first, "
            f"'{first.name}', is at {first.location}); let all things be of one sort, and what "
            "kind of thing each is be a static of it"
        )


def _read_range(first: str, last: str, name: str, statement: Statement) -> tuple[str, ...]:
    if int(last) - int(first) >= _MOST_MEMBERS:
        raise KnowledgeError(
            f"{statement.location}: sort '{name}' would have more than {_MOST_MEMBERS} members "
            f"({first}..{last}); axioms are tried with each of them, give a smaller range"
        )
    return tuple(str(number) for number in range(int(first), int(last) + 1))


def _read_members(inside: str, statement: Statement) -> tuple[str, ...]:
    if not inside:
        return ()
    members = _term(f"({inside},)")
    if members is not None:
        return tuple(map(str, members.arguments))
    parts = [part.strip() for part in inside.split(",")]
    wrong = next((part for part in parts if _term(part) is None), inside)
    raise KnowledgeError(
        f"{statement.location}: '{one_line(wrong)}' cannot be a member of a sort; write a name "
        "that begins with a small letter, or a number"
    )


def _term(text: str) -> clingo.Symbol | None:
    try:
        return clingo.parse_term(text, logger=lambda *_: None)
    except RuntimeError:
        return None


def _read_union(
    definition: str, name: str, statement: Statement, sorts: Mapping[str, Sort]
) -> tuple[str, ...]:
    members: dict[str, None] = {}
    for part in (summand.strip() for summand in definition.split("+")):
        if part not in sorts:
            raise KnowledgeError(
                f"{statement.location}: sort '{name}' is made of '{part}', which is no sort "
                f"declared above; {did_you_mean(part, sorts)} (a set of names is written "
                f"{{{part}}})"
            )
        if sorts[part].members is None:
            raise KnowledgeError(
                f"{statement.location}: sort '{name}' is made of '{part}', which stands for "
                f"{'what is found in ' if sorts[part].of_things else ''}the picture; give it sorts "
                "with members"
            )
        members.update(dict.fromkeys(sorts[part].members or ()))
    return tuple(members)


def _read_predicate(statement: Statement, sorts: Mapping[str, Sort]) -> Predicate:
    text = one_line(statement.text)
    directive = next((keyword for keyword in _KINDS if text.startswith(f"{keyword} ")), "")
    match = _PREDICATE.match(text[len(directive) :].strip()) if directive else None
    if match is None:
        raise KnowledgeError(
            f"{statement.location}: {_form(text.split()[0])}, got '{statement.line}'"
        )
    name, inside = match.group(1), match.group(2)
    arguments = tuple(part.strip() for part in inside.split(",")) if inside else ()
    for argument in arguments:
        if argument not in sorts:
            raise KnowledgeError(
                f"{statement.location}: '{name}' uses the sort '{one_line(argument)}', which is "
                f"not declared above; {did_you_mean(argument, sorts)}"
            )
    return Predicate(
        name=name, sorts=arguments, kind=_KINDS[directive], location=statement.location
    )


def _form(word: str) -> str:
    return {
        "#static": "a static is declared as '#static name(sort, sort).'",
        "#fluent": "a fluent is declared as '#fluent basic name(sort, sort).' or "
        "'#fluent defined name(sort, sort).'",
        "#action": "an action is declared as '#action name(sort, sort).' or, where it happens "
        "unasked, '#action exogenous name(sort, sort).'",
    }[word]
