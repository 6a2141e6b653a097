"""Say literals, features and classes in the words of the domain."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from seewhy.domain.belief import Belief
from seewhy.domain.domain import Domain
from seewhy.domain.thing_wording import say_of_things, say_thing
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.predicate_words import named_clause
from seewhy.text.slots import filled

_MOST_VALUES_LISTED = 3
_FROM_SO_MANY_LISTED = 3
"""Things of a predicate that no clause is made of."""
_VERB_AND_VALUE = re.compile(r"\{it\} ([\w ]+) \{value\}")
_PART_OF_IT = re.compile(r"^the ([^{}]+) of \{it\} ")


def say_literal(
    domain: Domain, literal: Literal, *, names: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Return a literal as a clause.

    ``names`` says how things are called; those left out are called by their numbers.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> say_literal(domain, domain.classes["unstable"].literal)
    'the structure is unstable'
    >>> say_literal(domain, domain.features["lean"].literals["yes"])
    'the structure leans to one side'
    """
    for scene_class in domain.classes.values():
        if scene_class.literal.predicate == literal.predicate and scene_class.literal == literal:
            return f"{domain.subject} is {scene_class.say}"
    feature = domain.features.get(literal.predicate)
    if feature is not None:
        for value, known in feature.literals.items():
            if known == literal:
                return feature.say[value].replace("{it}", domain.subject)
        for value, known in feature.literals.items():
            if known == literal.complement:
                return f"it is not so that {feature.say[value].replace('{it}', domain.subject)}"
    belief = domain.beliefs.get(literal.predicate)
    if belief is not None and literal.arguments[0] == domain.scene:
        return _say_belief(domain, belief, literal)
    if (of_things := say_of_things(domain, literal, names)) is not None:
        return of_things
    about = [_say_argument(domain, argument, names) for argument in literal.arguments]
    if len(about) < _FROM_SO_MANY_LISTED:
        return named_clause(literal.predicate, len(about))[not literal.positive].format(*about)
    said = f"{literal.predicate.replace('_', ' ')} ({', '.join(about)})"
    return said if literal.positive else f"not: {said}"


def _say_argument(domain: Domain, argument: str, names: Mapping[str, str]) -> str:
    if argument == domain.scene:
        return domain.subject
    if domain.things is not None:
        return say_thing(domain, argument, names)
    return argument.strip('"').replace("_", " ")


def say_open(domain: Domain, belief: Belief) -> str:
    """Return a static without its value, as what is asked for.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("traffic_signs")
    >>> say_open(domain, domain.beliefs["response"])
    'what the response of the sign is'
    """
    found = _VERB_AND_VALUE.fullmatch(belief.say)
    if found is None:
        return f"what the {belief.name} of {domain.subject} is"
    return f"what {domain.subject} {found.group(1)}"


def _say_belief(domain: Domain, belief: Belief, literal: Literal) -> str:
    value = next((value for value, other in belief.literals.items() if other == literal), None)
    if value is not None:
        return filled(belief.say, {"it": domain.subject, "value": belief.words[value]})
    opposite = next(
        (value for value, other in belief.literals.items() if other == literal.complement), None
    )
    said = belief.words[opposite] if opposite else str(literal.arguments[-1])
    said = filled(belief.say, {"it": domain.subject, "value": said})
    return said if literal.positive else f"it is not so that {said}"


def say_features(
    domain: Domain,
    vector: FeatureVector,
    features: Sequence[str],
    *,
    subject: str | None = None,
) -> str:
    """Return the values of some features as one sentence without a full stop.

    Clauses that begin with the same words are drawn together, and the subject is named once,
    as the domain does or as ``subject``.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> vector = ("5", "narrow", "no", "no")
    >>> say_features(domain, vector, tuple(domain.features))  # doctest: +NORMALIZE_WHITESPACE
    'the structure has five blocks and a narrow base, it is standing straight, and no block is
     displaced'
    """
    values = domain.named(vector)
    clauses = [
        domain.features[feature].say[value]
        for feature in domain.features
        if feature in features and (value := values[feature]) is not None
    ]
    return join_clauses(draw_together(clauses), subject=subject or domain.subject)


def draw_together(clauses: Sequence[str]) -> list[str]:
    """Join neighbouring clauses that share their subject and verb.

    Examples
    --------
    >>> draw_together(["{it} has one block", "{it} has a wide base", "{it} leans"])
    ['{it} has one block and a wide base', '{it} leans']
    """
    groups: list[tuple[str, list[str]]] = []
    for clause in clauses:
        words = clause.split(" ", 2)
        beginning = " ".join(words[:2]) if len(words) == 3 and words[0] == "{it}" else ""
        if beginning and groups and groups[-1][0] == beginning:
            groups[-1][1].append(words[2])
        else:
            groups.append((beginning, [words[2] if beginning else clause]))
    return [
        f"{beginning} {join_words(parts)}" if beginning else parts[0] for beginning, parts in groups
    ]


def join_clauses(clauses: Sequence[str], *, subject: str) -> str:
    """Join clauses, naming the subject in the first clause that has one and then saying "it".

    Examples
    --------
    >>> thumb, index = "the thumb of {it} is folded", "the index of {it} is stretched"
    >>> join_clauses([thumb, index], subject="the hand")
    'the thumb of the hand is folded, and its index is stretched'
    """
    named: list[str] = []
    for clause in clauses:
        first = not any("{it}" in earlier for earlier in clauses[: len(named)])
        if first:
            clause = clause.replace("{it}", subject, 1)
        named.append(_PART_OF_IT.sub(r"its \1 ", clause).replace("{it}", "it"))
    return f"{', '.join(named[:-1])}, and {named[-1]}" if len(named) > 1 else "".join(named)


def join_words(words: Sequence[str], *, word: str = "and") -> str:
    """Join words or phrases with commas and a conjunction.

    Examples
    --------
    >>> join_words(["one", "two", "three"], word="or")
    'one, two or three'
    """
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {word} {words[-1]}"


def say_one_of(clauses: Sequence[str], *, word: str = "or") -> str:
    """Join alternatives, saying what they share once.

    Examples
    --------
    >>> say_one_of(["{it} has four blocks", "{it} has five blocks"])
    '{it} has four or five blocks'
    >>> say_one_of(["{it} has two blocks"])
    '{it} has two blocks'
    """
    split = [clause.split() for clause in clauses]
    shortest = min(len(words) for words in split)
    head = 0
    while head < shortest and len({words[head] for words in split}) == 1:
        head += 1
    tail = 0
    while tail < shortest - head and len({words[-1 - tail] for words in split}) == 1:
        tail += 1
    if len(split) == 1:
        return clauses[0]
    middles = [" ".join(words[head : len(words) - tail]) for words in split]
    if not all(middles) or head == 0:
        return join_words(clauses, word=word)
    before, after = split[0][:head], split[0][len(split[0]) - tail :] if tail else []
    return " ".join([*before, join_words(middles, word=word), *after])


def say_values(domain: Domain, feature: str, values: Sequence[str]) -> str:
    """Return "one of these values" of a feature as a clause.

    A run of numbers is said as its two ends, and most of many values as "anything but" the others.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> say_values(domain, "num_blocks", ("2", "3", "4"))
    '{it} has two to four blocks'
    >>> say_values(domain, "base", ("wide", "narrow"))
    '{it} has a wide or narrow base'
    >>> signs = load_domain("traffic_signs")
    >>> shapes = signs.features["shape"].values
    >>> others = [shape for shape in shapes if shape not in ("circle", "octagon")]
    >>> say_values(signs, "shape", others)
    'the shape of {it} is anything but round or octagonal'
    """
    described = domain.features[feature]
    numbers = [int(value) for value in values if value.lstrip("-").isdecimal()]
    all_numbers = len(numbers) == len(values) > 2
    if all_numbers and numbers == list(range(numbers[0], numbers[0] + len(numbers))):
        return say_one_of([described.say[values[0]], described.say[values[-1]]], word="to")
    others = [value for value in described.values if value not in values]
    if len(values) > _MOST_VALUES_LISTED and 0 < len(others) < len(values):
        excluded = join_words([described.words[value][0] for value in others], word="or")
        return f"the {described.name} of {{it}} is anything but {excluded}"
    return say_one_of([described.say[value] for value in values])


def as_clause(text: str) -> str:
    """Return a sentence as it goes on behind others: what is no "I" begins small.

    Examples
    --------
    >>> as_clause("There is one."), as_clause("I don't know.")
    ('there is one.', "I don't know.")
    """
    return text if text.startswith(("I ", "I'")) else f"{text[:1].lower()}{text[1:]}"


def sentence(text: str) -> str:
    """Return text with a capital at the beginning and a full stop at the end.

    Examples
    --------
    >>> sentence("it leans")
    'It leans.'
    """
    text = text.strip()
    return f"{text[:1].upper()}{text[1:]}{'' if text.endswith(('.', '?', '!')) else '.'}"
