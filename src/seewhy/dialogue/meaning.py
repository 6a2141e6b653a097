"""What is asked by what a phrase of the grammar binds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.lexicon import persons_of
from seewhy.dialogue.said import Said, all_said, companion_of_the_absent, roles, stated
from seewhy.dialogue.verbless import verbs_shared
from seewhy.domain.domain import Domain

__all__ = [
    "anybody",
    "because",
    "change",
    "choice",
    "contrast",
    "contrast_turned",
    "difference",
    "grouped",
    "joined",
    "matters",
    "neither",
    "of_static",
    "persons",
    "plain",
    "polar",
    "possible",
    "preferred",
    "rule",
    "supposing",
    "sure",
    "told",
    "value",
    "when",
    "where",
    "whether_or_not",
    "why",
]


def polar(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether one thing is so."""
    for said in all_said(bindings)[:1]:
        turned = _turned(domain, said) if said.denied else said.statement
        if said.denied and any(binding.role == "asking_tag" for binding in bindings):
            yield _is(said.statement)  # "it is not brown, is it?"
        elif said.denied and turned == said.statement:
            # "Is it not brown?" of many colours: which it is answers it, whatever is meant.
            yield (
                _question(Asks.CLASS)
                if turned.label
                else _question(Asks.FEATURE_VALUE, feature=turned.feature)
            )
        else:
            yield _is(turned)


def preferred(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether one thing is so rather than another of its kind: "is it red rather than white?"."""
    said = all_said(bindings)
    if len(said) != 2 or said[0].denied or said[0].statement == said[1].statement:
        return
    if said[0].statement.feature == said[1].statement.feature:
        yield _is(said[0].statement)


def joined(domain: Domain, bindings: tuple[Binding, ...], asks: Asks) -> Iterator[Question]:
    """Whether several things are so, or one of them."""
    spoken_of = verbs_shared(bindings, all_said(bindings))
    if spoken_of is None or companion_of_the_absent(spoken_of):
        return
    said = [_turned(domain, spoken) if spoken.denied else spoken.statement for spoken in spoken_of]
    if any(spoken.denied and spoken.statement in said for spoken in spoken_of):
        return  # "neither round nor square" says not what it is instead
    if len(set(said)) < 2:
        return
    features = {clause.feature for clause in said}
    if asks is Asks.EITHER and len(features) == 1:
        feature = said[0].feature
        yield (
            _question(Asks.CLASS)
            if feature is None
            else _question(Asks.FEATURE_VALUE, feature=feature)
        )
        return
    if asks is Asks.ALL and len(features) < len(said):
        return
    yield _question(asks, statements=tuple(said))


def neither(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether none of two things is so."""
    denied = [replace(spoken, denied=not spoken.denied) for spoken in all_said(bindings)]
    yield from joined(domain, tuple(Binding("said", binding) for binding in denied), Asks.ALL)


def why(
    _domain: Domain, bindings: tuple[Binding, ...], *, denied: bool = False
) -> Iterator[Question]:
    """Why something is so, or is not."""
    for spoken in all_said(bindings)[:1]:
        statement = spoken.statement
        if spoken.denied != spoken.forward or denied:
            asks = Asks.WHY_NOT_CLASS if statement.label else Asks.WHY_NOT_VALUE
        else:
            asks = Asks.WHY_CLASS if statement.label else Asks.WHY_VALUE
        yield _about(asks, statement)


def contrast(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Why one class or value rather than another."""
    said = all_said(bindings)
    if len(said) != 2 or said[0].denied or said[0].statement == said[1].statement:
        return
    first, other = said[0].statement, said[1].statement
    if said[0].forward:
        first, other = other, first  # "why isn't it red rather than white?": it is white
    if first.feature == other.feature:
        yield _question(Asks.CONTRAST, statements=(first, other))


def contrast_turned(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """The same where what is not so is named first: "why is it not stable but unstable?"."""
    yield from contrast(domain, tuple(reversed(bindings)))


def supposing(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """What would be if some features were different."""
    parts: list[Statement] = []
    for label in roles(bindings, "supposed_class"):
        yield _question(Asks.WHAT_IF, label=label)
        return
    said = verbs_shared(bindings, all_said(bindings))
    if said is None or companion_of_the_absent(said):
        return
    if any(clause.named for clause in said):
        said = [replace(clause, denied=said[-1].denied, named=False) for clause in said]
    for clause in said:
        statement = clause.statement
        if statement.label is not None:
            return
        if clause.replaced and any(part.feature == statement.feature for part in parts):
            continue  # "worn instead of stripped" says which value
        if clause.denied or clause.forward:
            opposite = _turned(domain, clause)
            statement = replace(statement, denied=True) if opposite == statement else opposite
        parts.append(statement)
    if parts and len({part.feature for part in parts}) == len(parts):
        yield _question(Asks.WHAT_IF, statements=tuple(parts))


def change(
    domain: Domain, bindings: tuple[Binding, ...], *, away: bool = False
) -> Iterator[Question]:
    """What would have to change for a class, or so that it is none."""
    goals = [binding for binding in bindings if binding.role == "said"]
    if len(goals) != 1:
        return
    said = goals[0].meaning
    assert isinstance(said, Said)
    label = said.statement.label
    if label is None:
        return
    if away:
        others = [key for key in domain.classes if key != label]
        if len(others) != 1:
            return
        label = others[0]
    yield _question(Asks.CHANGE_TO_CLASS, label=label)


def when(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """By which rules something is of a class."""
    for spoken in all_said(bindings)[:1]:
        if spoken.statement.label is not None and not spoken.denied:
            yield _question(Asks.WHEN_CLASS, label=spoken.statement.label)


def matters(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether a feature has to do with the class."""
    said = [spoken.statement.feature for spoken in all_said(bindings)]
    features = set(filter(None, (*said, *roles(bindings, "feature"))))
    if len(features) == 1 and None not in said:
        yield _question(Asks.MATTERS, feature=features.pop())


def because(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether it is of its class because of something."""
    said = all_said(bindings)
    labels = [spoken for spoken in said if spoken.statement.label is not None]
    causes = [spoken for spoken in said if spoken.statement.feature is not None]
    features = roles(bindings, "feature") if not causes else []
    if len(labels) > 1 or any(label.denied for label in labels) or len(causes) + len(features) != 1:
        return
    cause = Statement(feature=features[0]) if features else causes[0].statement
    if causes and causes[0].denied:
        cause = _turned(domain, causes[0])
        if cause == causes[0].statement:
            return
    label = labels[0].statement.label if labels else None
    yield _question(Asks.BECAUSE, label=label, feature=cause.feature, value=cause.value)


def possible(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """What a feature can be, whatever is seen."""
    features = dict.fromkeys(roles(bindings, "feature"))
    if len(features) == 1:
        yield _question(Asks.POSSIBLE, feature=next(iter(features)))


def rule(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """By which rule it is of its class; what is seen follows from no rule."""
    if not any(binding.role == "fact" for binding in bindings):
        yield _question(Asks.WHICH_RULE)


def difference(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """What tells what is shown from a class."""
    for spoken in all_said(bindings)[:1]:
        yield _question(Asks.DIFFERENCE_TO_CLASS, label=spoken.statement.label)


def sure(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """How sure something is."""
    for spoken in all_said(bindings)[:1]:
        statement = spoken.statement
        if statement.label is not None:
            yield _question(Asks.HOW_SURE, label=statement.label)
        else:
            yield _question(Asks.HOW_SURE, feature=statement.feature)
        return
    features = roles(bindings, "feature")
    yield from (_question(Asks.HOW_SURE, feature=feature) for feature in features[:1])


def where(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Where something is seen."""
    for spoken in all_said(bindings)[:1]:
        statement = spoken.statement
        if statement.label is not None:
            yield _question(Asks.WHERE, label=statement.label)
        else:
            yield _question(Asks.WHERE, feature=statement.feature, value=statement.value)
        return
    for feature in roles(bindings, "feature")[:1]:
        values = domain.features[feature].values
        yield _question(Asks.WHERE, feature=feature, value="yes" if "yes" in values else None)


def value(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Which value a feature has."""
    facts = [binding.meaning for binding in bindings if binding.role == "fact"]
    # "How wide?" names a value, and asks for the feature.
    named = roles(bindings, "feature") or [stated(fact).feature or "" for fact in facts]
    features = dict.fromkeys(named)
    if len(features) != 1:
        return
    feature = next(iter(features))
    if all(stated(fact).feature == feature for fact in facts):
        yield _question(Asks.FEATURE_VALUE, feature=feature)


def choice(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Which of the values that are named."""
    said = [spoken.statement for spoken in all_said(bindings)]
    facts = [binding.meaning for binding in bindings if binding.role == "fact"]
    said += map(stated, facts)
    about = set(roles(bindings, "feature"))
    if len(set(said)) < 2:
        return
    features = {clause.feature for clause in said}
    if len(features) == 1 and None not in features and not about - features:
        yield _question(Asks.FEATURE_VALUE, feature=said[0].feature)


def grouped(_domain: Domain, bindings: tuple[Binding, ...], asks: Asks) -> Iterator[Question]:
    """Which features of a group have a value, or how many."""
    groups = [binding.meaning for binding in bindings if binding.role == "group"]
    said = all_said(bindings)
    for group in groups[:1]:
        assert isinstance(group, tuple)
        for clause in said:
            if clause.statement.feature in group and clause.statement.value is not None:
                yield _question(asks, value=clause.statement.value, group=group)
                return


def whether_or_not(_domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """Whether something is so or not: its value is asked for."""
    for said in all_said(bindings)[:1]:
        if said.statement.feature is None:
            yield _is(said.statement)
        else:
            yield _question(Asks.FEATURE_VALUE, feature=said.statement.feature)


def anybody(domain: Domain, *, nobody: bool) -> Iterator[Question]:
    """Whether somebody is to be seen, or nobody."""
    for question in persons(domain):
        value = "no" if nobody else "yes"
        statements = tuple(Statement(feature=key, value=value) for key in question.group)
        yield _question(Asks.ALL if nobody else Asks.EITHER, statements=statements)


def persons(domain: Domain) -> Iterator[Question]:
    """Who is to be seen."""
    features = tuple(persons_of(domain))
    if features:
        yield _question(Asks.DESCRIBE, group=features)


def told(domain: Domain, bindings: tuple[Binding, ...]) -> Iterator[Question]:
    """What follows from the picture for somebody."""
    keys = roles(bindings, "belief") or [
        key for key, belief in domain.beliefs.items() if belief.acts
    ]
    yield from (_question(Asks.BELIEF_VALUE, predicate=key) for key in keys[:1])


def of_static(domain: Domain, question: Question) -> Question | None:
    """Return a question about a static in its own form; None where it cannot be asked of one."""
    about = {question.feature, *(statement.feature for statement in question.statements)}
    if about.isdisjoint(domain.beliefs):
        return question
    asks, value = _OF_A_STATIC.get(question.asks), question.value
    if asks is None:
        return None
    if asks is Asks.BELIEF_VALUE and domain.beliefs[question.feature or ""].is_yes_or_no:
        asks, value = Asks.BELIEF_IS, "yes"  # "is it edible or not?"
    return _question(asks, predicate=question.feature, value=value)


_OF_A_STATIC = {
    Asks.FEATURE_IS: Asks.BELIEF_IS,
    Asks.FEATURE_VALUE: Asks.BELIEF_VALUE,
    Asks.WHY_VALUE: Asks.WHY_BELIEF,
    Asks.WHY_NOT_VALUE: Asks.WHY_NOT_BELIEF,
}


def plain(asks: Asks) -> Iterator[Question]:
    """What names nothing of the domain."""
    yield _question(asks)


def _is(statement: Statement) -> Question:
    return _about(Asks.IS_CLASS if statement.label else Asks.FEATURE_IS, statement)


def _turned(domain: Domain, said: Said) -> Statement:
    """The opposite of a statement, where there is one; else the statement."""
    statement = said.statement
    if statement.label is not None:
        others = [key for key in domain.classes if key != statement.label]
        return Statement(label=others[0]) if len(others) == 1 else statement
    belief = domain.beliefs.get(statement.feature or "")
    if belief is not None:
        # Of what may have several values, that one is not so says nothing of another.
        values = tuple(belief.literals) if belief.is_yes_or_no else ()
    else:
        values = domain.features[statement.feature or ""].values
    others = [value for value in values if value != statement.value]
    return replace(statement, value=others[0]) if len(others) == 1 else statement


def _question(asks: Asks, **about: Any) -> Question:
    return Question(asks=asks, text="", words=(), **about)


def _about(asks: Asks, statement: Statement) -> Question:
    return _question(asks, label=statement.label, feature=statement.feature, value=statement.value)
