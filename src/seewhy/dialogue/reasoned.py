"""Answers from the knowledge: a query becomes an answer type with its justification."""

from __future__ import annotations

from dataclasses import dataclass, replace

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Question
from seewhy.domain import Domain
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not
from seewhy.wording import say_literal


@dataclass(frozen=True)
class ReasonedAnswer:
    """An answer type and the justification it was read off."""

    kind: AnswerType
    justification: Node


class ReasonedAnswers:
    """Answers questions about scenes that the knowledge decides.

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> from seewhy.dialogue.question import Questions
    >>> domain = load_domain("structure_stability")
    >>> answers = ReasonedAnswers(domain, Reasoner(domain.knowledge, domain.schema))
    >>> question = Questions(domain).understand("what is making this structure unstable?")
    >>> vector = domain.vector({"num_blocks": "3", "base": "wide", "lean": "no",
    ...                         "block_displaced": "yes"})
    >>> answers.answer(question, vector, "unstable").kind.identifier
    'reasons(block_displaced)'
    """

    def __init__(self, domain: Domain, reasoner: Reasoner) -> None:
        self.domain = domain
        self.reasoner = reasoner
        self.changes = ChangeFinder(reasoner)

    def answer(self, question: Question, vector: FeatureVector, label: str) -> ReasonedAnswer:
        """Answer a question about a scene of class ``label``.

        Raises
        ------
        ValueError
            If the question asks to explain: what it refers to is the agent's to know.
        """
        asked = question.label or label
        match question.asks:
            case Asks.CLASS:
                return ReasonedAnswer(AnswerType("class"), self.why_class(vector, label))
            case Asks.IS_CLASS:
                form = "yes_class" if asked == label else "no_class"
                return ReasonedAnswer(AnswerType(form), self.why_class(vector, label))
            case Asks.WHY_CLASS:
                node = self.why_class(vector, label)
                form = "reasons" if asked == label else "false_premise"
                return ReasonedAnswer(AnswerType(form, self._ordered(node.features())), node)
            case Asks.WHY_NOT_CLASS:
                return self._why_not(vector, label, asked)
            case Asks.CHANGE_TO_CLASS:
                return self._change(vector, label, asked)
            case Asks.FEATURE_VALUE | Asks.FEATURE_IS:
                return self.feature(question, vector)
        raise ValueError(f"'{question.asks}' is not a question about the scene")

    def feature(self, question: Question, vector: FeatureVector) -> ReasonedAnswer:
        """Answer a question about a feature, which needs no class."""
        feature = question.feature or ""
        value = self.domain.named(vector)[feature]
        form = "value"
        if question.asks is Asks.FEATURE_IS:
            form = "yes" if value == question.value else "no"
        node = self.seen(vector, feature)
        return ReasonedAnswer(AnswerType(form, (feature,)), node)

    def seen(self, vector: FeatureVector, feature: str) -> Node:
        """The node of a feature that the picture shows."""
        value = self.domain.named(vector)[feature]
        if value is None:
            text = f"the {self.domain.features[feature].name} is not known"
            return Node(feature, text, Basis.ABSENCE, feature=feature)
        literal = self.domain.features[feature].literals[value]
        return Node(
            literal=str(literal),
            text=say_literal(self.domain, literal),
            basis=Basis.FEATURE,
            feature=feature,
            value=value,
        )

    def why_class(self, vector: FeatureVector, label: str) -> Node:
        """The justification of the belief that a scene is of a class."""
        literal = self.domain.classes[label].literal
        node = why(self.reasoner, vector, literal, say=self._say)
        return node or why_not(self.reasoner, vector, literal, say=self._say)

    def why_not_class(self, vector: FeatureVector, label: str) -> Node:
        """The justification of the absence of the belief that a scene is of a class."""
        return why_not(self.reasoner, vector, self.domain.classes[label].literal, say=self._say)

    def _why_not(self, vector: FeatureVector, label: str, asked: str) -> ReasonedAnswer:
        if asked == label:
            node = self.why_class(vector, label)
            return ReasonedAnswer(AnswerType("denied_not", self._ordered(node.features())), node)
        refused = self.why_not_class(vector, asked)
        opposite = self.domain.classes[asked].literal.complement
        against = why(self.reasoner, vector, opposite, say=self._say)
        if against is not None:
            # What is believed false has reasons of its own; they say more than what is missing.
            node = replace(refused, children=(against, *refused.children))
            return ReasonedAnswer(AnswerType("against", self._ordered(against.features())), node)
        failed = {
            node.feature
            for node in (refused.children[0].children if refused.children else ())
            if not node.holds and node.feature
        }
        return ReasonedAnswer(AnswerType("against", self._ordered(tuple(failed))), refused)

    def _change(self, vector: FeatureVector, label: str, asked: str) -> ReasonedAnswer:
        if asked == label:
            return ReasonedAnswer(AnswerType("already"), self.why_class(vector, label))
        found = self.changes.smallest(vector, asked)
        alternatives = tuple(
            tuple((change.feature, change.after) for change in own.changes)
            for own in found
            if own.changes
        )
        if not alternatives:
            return ReasonedAnswer(AnswerType("no_change"), self.why_not_class(vector, asked))
        after = found[0].vector
        node = replace(
            self.why_class(after, asked),
            text=f"with this change, {self._say(self.domain.classes[asked].literal)}",
        )
        refused = self.why_not_class(vector, asked)
        return ReasonedAnswer(
            AnswerType("change", changes=alternatives),
            replace(refused, children=(*refused.children, node)),
        )

    def _ordered(self, features: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(feature for feature in self.domain.features if feature in features)

    def _say(self, literal: Literal) -> str:
        return say_literal(self.domain, literal)
