"""Answers about reasons: by which rules it is of a class, what matters to it, what else."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.certainty import least_sure
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reply import Classification, Reply
from seewhy.dialogue.told import Told
from seewhy.dialogue.tree_reason import tree_says
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_features, sentence
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

__all__ = ["OF_REASONS", "say_axiom", "tell_of_reasons"]

OF_REASONS = frozenset({Asks.WHEN_CLASS, Asks.MATTERS, Asks.BECAUSE, Asks.MORE, Asks.POSSIBLE})
"""What is answered here."""
_MOST_RULES = 6
_MOST_OTHERWISE = 2
_MOST_VALUES = 12
Decide = Callable[[FeatureVector], tuple[str | None, Node]]
"""The class of a scene, and why."""


def tell_of_reasons(
    reasoned: ReasonedAnswers,
    tree: DecisionTree,
    decide: Decide,
    scene: Classification,
    question: Question,
    *,
    why: Node,
    previous: Reply | None,
) -> Told:
    """Answer a question about reasons.

    Parameters
    ----------
    reasoned : ReasonedAnswers
    tree : DecisionTree
        What says when a class is, where no rule does.
    decide : callable
        The class that a scene of other values would be of, and why.
    scene : Classification
    question : Question
    why : Node
        The justification of the scene's class, or why there is none.
    previous : Reply or None
        What was answered before; "what else?" goes on from there.
    """
    domain = reasoned.domain
    match question.asks:
        case Asks.WHEN_CLASS:
            return _when(domain, tree, scene, question.label or "", why)
        case Asks.MATTERS:
            return _matters(domain, decide, scene, question.feature or "", why)
        case Asks.POSSIBLE:
            return _possible(domain, question.feature or "")
        case Asks.BECAUSE:
            return _because(domain, reasoned, scene, question, why)
        case _:
            return _more(domain, scene, why, previous)


def say_axiom(axiom: Axiom) -> str:
    """Return an axiom as a rule with the place where it stands."""
    file = axiom.location.file.replace("\\", "/").rsplit("/", 1)[-1]
    return f'the rule "{axiom.text}" ({file}:{axiom.location.line})'


def _when(domain: Domain, tree: DecisionTree, scene: Classification, label: str, why: Node) -> Told:
    """The rules that conclude a class."""
    literal = domain.classes[label].literal
    kind = AnswerType("when")
    is_it = f"{domain.subject} is {domain.classes[label].say}"
    rules = [
        axiom
        for axiom in domain.knowledge.axioms
        if axiom.head.predicate == literal.predicate
        and axiom.head.positive == literal.positive
        and axiom.head.arguments[1:] == literal.arguments[1:]
    ]
    if not rules:
        learned = tree_says(domain, tree, scene.vector, label)
        said = f"no rule of the knowledge says when {is_it}"
        text = said if learned is None else f"{said}; {learned.text}"
        return Told(kind, sentence(text), learned or why)
    told = join_words([say_axiom(axiom) for axiom in rules[:_MOST_RULES]], word="or")
    more = len(rules) - _MOST_RULES
    text = f"{is_it} by {told}" + (f", or by {more} others" if more > 0 else "")
    nodes = tuple(Node(str(axiom.head), axiom.text, Basis.AXIOM, axiom=axiom) for axiom in rules)
    return Told(kind, sentence(text), Node(str(literal), is_it, Basis.REASONS, children=nodes))


def _possible(domain: Domain, feature: str) -> Told:
    """What the domain says of a feature: the values that it may have."""
    declared = domain.features[feature]
    kind = AnswerType("possible", (feature,))
    clauses = [declared.say[value].replace("{it}", domain.subject) for value in declared.values]
    if set(declared.values) == {"yes", "no"}:
        text = f"either {clauses[0]} or {clauses[1].replace(domain.subject, 'it')}"
    else:
        words = [declared.words[value][0] for value in declared.values]
        more = len(words) - _MOST_VALUES
        shown = words if more <= 0 else [*words[:_MOST_VALUES], f"one of {more} others"]
        text = f"the {declared.name} is {join_words(shown, word='or')}"
    nodes = tuple(Node(feature, clause, Basis.REASONS) for clause in clauses)
    return Told(kind, sentence(text), Node(feature, text, Basis.REASONS, children=nodes))


def _matters(
    domain: Domain, decide: Decide, scene: Classification, feature: str, why: Node
) -> Told:
    """Whether another value of a feature would change the class, or a rule speaks of it."""
    declared, values = domain.features[feature], domain.named(scene.vector)
    kind = AnswerType("matters", (feature,))
    ground = least_sure(kind, scene, why)
    it = domain.subject
    otherwise = []
    for value in declared.values:
        label, _ = decide(domain.vector({**values, feature: value}))
        if value != values[feature] and label != scene.label:
            then = "I cannot tell what it is" if label is None else _is_class(domain, label, "it")
            otherwise.append(f"if {declared.say[value].replace('{it}', it)}, {then}")
    if otherwise:
        return Told(kind, sentence(f"yes: {'; '.join(otherwise[:_MOST_OTHERWISE])}"), why, ground)
    now = "I cannot tell what it is" if scene.label is None else _is_class(domain, scene.label, it)
    whatever = f"whatever the {declared.name} is, {now}"
    spoken_of = [axiom for axiom in _behind_classes(domain) if feature in axiom.predicates]
    if not spoken_of:
        text = f"no: no rule about the classes speaks of the {declared.name}, and {whatever}"
    else:
        text = f"not here: {whatever}; elsewhere it may, by {say_axiom(spoken_of[0])}"
    return Told(kind, sentence(text), why, ground)


def _behind_classes(domain: Domain) -> Iterator[Axiom]:
    """The axioms that a class may rest on, through whatever is concluded between."""
    reached = {scene_class.literal.predicate for scene_class in domain.classes.values()}
    left = list(domain.knowledge.axioms)
    while True:
        found = [axiom for axiom in left if axiom.head.predicate in reached]
        if not found:
            return
        left = [axiom for axiom in left if axiom not in found]
        for axiom in found:
            reached |= set(axiom.predicates)
        yield from found


def _because(
    domain: Domain, reasoned: ReasonedAnswers, scene: Classification, question: Question, why: Node
) -> Told:
    """Whether the reason that is supposed is the one, with the real ones."""
    feature = question.feature or ""
    values = domain.named(scene.vector)
    kind = AnswerType("because", why.features())
    ground = least_sure(kind, scene, why)
    if scene.label is None:
        return Told(kind, sentence(f"I cannot tell what {domain.subject} is"), why)
    is_it = _is_class(domain, scene.label, domain.subject)
    reasons = say_features(domain, scene.vector, why.features(), subject="it")
    since = f"{is_it}, since {reasons}" if reasons else is_it
    if question.label not in (None, scene.label):
        return Told(kind, sentence(f"no, {since}"), why, ground)
    if question.value is not None and values[feature] != question.value:
        seen = reasoned.seen(scene.vector, feature).text
        names_it = "{it}" in domain.features[feature].say.get(values[feature] or "", "")
        if names_it:
            since = since.replace(domain.subject, "it", 1)
        return Told(kind, sentence(f"no, {seen}; {since}"), why, ground)
    mine = _reason_with(why, feature)
    if mine is None:
        name = domain.features[feature].name
        return Told(kind, sentence(f"no, not because of the {name}: {since}"), why, ground)
    asked = mine.features()
    clause = say_features(domain, scene.vector, asked, subject=domain.subject)
    others = [key for key in why.features() if key not in asked]
    text = f"yes, since {clause}"
    if others:
        besides = say_features(domain, scene.vector, others, subject="it")
        text += f"; that {besides} is a reason as well"
    return Told(kind, sentence(text), why, ground)


def _reason_with(why: Node, feature: str) -> Node | None:
    """The reason that a feature is part of; None where it is part of none."""
    if feature not in why.features():
        return None
    if why.basis is Basis.REASONS:
        return next(child for child in why.children if feature in child.features())
    return why


def _more(domain: Domain, scene: Classification, why: Node, previous: Reply | None) -> Told:
    """The next reason, or else the next of what is seen, that was not yet told."""
    values = domain.named(scene.vector)
    told = _told_already(previous, values)
    because = why.features()
    reasons = [key for key, value in values.items() if key in because and key not in told and value]
    left = reasons or [key for key in values if key not in told and values[key] is not None]
    of_reasons = previous is not None and previous.question.asks in _ABOUT_REASONS
    if not left:
        kind = AnswerType("more", tuple(told))
        return Told(kind, "Nothing else: that is all that I know of it.", why)
    said = say_features(domain, scene.vector, left[:1], subject=domain.subject)
    kind = AnswerType("more", (*told, left[0]))
    if reasons and of_reasons:
        text = f"it also counts that {said}"
    else:
        text = f"I was also told that {said}" if scene.told else f"I also see that {said}"
        if of_reasons and previous is not None and previous.question.asks is not Asks.MORE:
            text = f"there is no other reason; {text}"
    return Told(kind, sentence(text), why, least_sure(AnswerType("value", (left[0],)), scene, why))


_ABOUT_REASONS = {
    Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.EXPLAIN, Asks.BECAUSE, Asks.CONTRAST, Asks.MORE,
}  # fmt: skip


def _told_already(previous: Reply | None, values: Mapping[str, str | None]) -> Sequence[str]:
    if previous is None:
        return ()
    changed = (feature for change in previous.kind.changes for feature, _ in change)
    return [key for key in dict.fromkeys((*previous.kind.mentions, *changed)) if key in values]


def _is_class(domain: Domain, label: str, subject: str) -> str:
    return f"{subject} is {domain.classes[label].say}"
