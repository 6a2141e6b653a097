"""Answers from the knowledge: a query becomes an answer type with its justification."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.belief import ToldClass, believed_values, with_basis
from seewhy.dialogue.class_changes import Ways
from seewhy.dialogue.question import Asks, Question
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_literal, say_open
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.condition_nodes import once
from seewhy.knowledge.evidence import Evidence, evidence_of
from seewhy.knowledge.explanation import belief_node
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.occurrence import Occurrence
from seewhy.knowledge.odd_loop import say_odd_loop
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.why import contradiction, either_or, justify
from seewhy.knowledge.why_not import refuse, shortfall

_UNDECIDED = {
    Verdict.SILENT: "no axiom concludes a class",
    Verdict.SEVERAL: "it concludes more than one class",
    Verdict.CONTRADICTION: "it contradicts itself here",
    Verdict.NO_ANSWER_SET: "no set of beliefs agrees with all axioms",
    Verdict.BELIEVED: "",
}
_NO_CLASS = Node("none", "no class follows", Basis.ABSENCE)
_CLASSES_SHOWN = 3
_SCENES_REMEMBERED = 1_000
_NODES_REMEMBERED = 20_000


@dataclass(frozen=True)
class ReasonedAnswer:
    """An answer type and the justification it was read off."""

    kind: AnswerType
    justification: Node


class ReasonedAnswers:
    """Answers questions about scenes that the knowledge decides.

    Parameters
    ----------
    domain : Domain
    reasoner : Reasoner
    occurrence : Occurrence, optional
        Which scenes can be: what would have to change is answered with such.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.dialogue.question import Questions
    >>> domain = load_domain("structure_stability")
    >>> answers = ReasonedAnswers(domain, Reasoner(domain.knowledge, domain.schema))
    >>> question = Questions(domain).understand("what is making this structure unstable?")
    >>> vector = domain.vector({"num_blocks": "3", "base": "wide", "lean": "no",
    ...                         "block_displaced": "yes"})
    >>> answers.answer(question, vector, "unstable").kind.identifier
    'reasons(block_displaced)'
    """

    def __init__(
        self, domain: Domain, reasoner: Reasoner, occurrence: Occurrence | None = None
    ) -> None:
        self.domain = domain
        self.reasoner = reasoner
        self.told = ToldClass(domain, reasoner, say=self._say)
        # Scenes with many classes come back often: equal questions are answered once.
        self.evidence = lru_cache(maxsize=_SCENES_REMEMBERED)(self._evidence)
        self.why_class = lru_cache(maxsize=_NODES_REMEMBERED)(self._why_class)
        self.why_not_class = lru_cache(maxsize=_NODES_REMEMBERED)(self._why_not_class)
        self.undecided = lru_cache(maxsize=_SCENES_REMEMBERED)(self._undecided)
        self.ways = Ways(domain, ChangeFinder(reasoner, occurrence), self.why_class)

    def kind(self, question: Question, vector: FeatureVector, label: str) -> AnswerType:
        """Return the answer type alone, as :meth:`answer` does, without all of its justification.

        Raises
        ------
        ValueError
            If the question asks to explain: what it refers to is the agent's to know.
        """
        asked = question.label or label
        same = asked == label
        match question.asks:
            case Asks.CLASS:
                return AnswerType("class")
            case Asks.IS_CLASS:
                return AnswerType("yes_class" if same else "no_class")
            case Asks.WHY_CLASS:
                features = self._ordered(self.why_class(vector, label).features())
                return AnswerType("reasons" if same else "false_premise", features)
            case Asks.WHY_NOT_CLASS:
                if same:
                    features = self.why_class(vector, label).features()
                    return AnswerType("denied_not", self._ordered(features))
                return AnswerType("against", self._against(vector, asked))
            case Asks.CHANGE_TO_CLASS:
                return AnswerType("already") if same else self.ways.change(vector, asked)
            case Asks.DIFFERENCE_TO_CLASS:
                return AnswerType("same") if same else self.ways.difference(vector, asked)
            case Asks.FEATURE_VALUE | Asks.FEATURE_IS:
                return self.feature(question, vector).kind
            case Asks.BELIEF_VALUE:
                predicate = question.predicate or ""
                return _belief(believed_values(self.domain, self.about(vector, label), predicate))
        raise ValueError(f"'{question.asks}' is not a question about the scene")

    def answer(self, question: Question, vector: FeatureVector, label: str) -> ReasonedAnswer:
        """Answer a question about a scene of class ``label``.

        Raises
        ------
        ValueError
            As :meth:`kind`.
        """
        kind = self.kind(question, vector, label)
        asked = question.label or label
        match question.asks:
            case Asks.FEATURE_VALUE | Asks.FEATURE_IS:
                return self.feature(question, vector)
            case Asks.BELIEF_VALUE:
                return self.belief(question, vector, label, basis=self.why_class(vector, label))
            case Asks.WHY_NOT_CLASS if asked != label:
                return ReasonedAnswer(kind, self._refused(vector, asked))
            case Asks.CHANGE_TO_CLASS | Asks.DIFFERENCE_TO_CLASS if asked != label:
                return ReasonedAnswer(kind, self._changed(vector, asked, kind))
        return ReasonedAnswer(kind, self.why_class(vector, label))

    def feature(self, question: Question, vector: FeatureVector) -> ReasonedAnswer:
        """Answer a question about a feature, which needs no class."""
        feature = question.feature or ""
        value = self.domain.named(vector)[feature]
        form = "value"
        if question.asks is Asks.FEATURE_IS:
            form = "yes" if value == question.value else "no"
        if value is None:
            form = "feature_unknown"
        node = self.seen(vector, feature)
        return ReasonedAnswer(AnswerType(form, (feature,)), node)

    def belief(
        self, question: Question, vector: FeatureVector, label: str, *, basis: Node
    ) -> ReasonedAnswer:
        """Answer what is believed of a static, given that the scene is of class ``label``.

        ``basis`` is why it is of that class. Where the knowledge does not conclude the class,
        the class is told to it (:class:`~seewhy.dialogue.belief.ToldClass`).
        """
        belief = self.domain.beliefs[question.predicate or ""]
        evidence = self.about(vector, label)
        values = believed_values(self.domain, evidence, belief.key)
        basis = replace(basis, literal=str(literal_of(key_of(self.domain.classes[label].literal))))
        nodes = tuple(
            with_basis(node, basis)
            for value in values
            if (node := justify(evidence, belief.literals[value])) is not None
        )
        if len(nodes) == 1:
            return ReasonedAnswer(_belief(values), nodes[0])
        said = join_words([belief.words[value] for value in values])
        text = belief.say.replace("{it}", self.domain.subject).replace("{value}", said)
        if not values:
            text = f"nothing that is known says {say_open(self.domain, belief)}"
        node = Node(
            literal=f"{belief.key}({self.domain.scene}, _)",
            text=text,
            basis=Basis.REASONS if values else Basis.UNFOUNDED,
            holds=bool(values),
            children=nodes or (basis,),
        )
        return ReasonedAnswer(_belief(values), node)

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

    def nearest_classes(self, vector: FeatureVector, *, most: int) -> tuple[str, ...]:
        """Return the classes that are nearest to being believed, in the order of the domain.

        Those whose axioms have the fewest failed conditions, at most ``most``; all classes where
        only one would be left out.
        """
        classes = tuple(self.domain.classes)
        if len(classes) <= most + 1:
            return classes
        evidence = self.evidence(vector)
        failed = {
            label: shortfall(evidence, scene_class.literal)
            for label, scene_class in self.domain.classes.items()
        }
        able = [label for label in classes if failed[label] is not None]
        chosen = sorted(able, key=lambda label: failed[label] or 0)[:most]
        return tuple(label for label in classes if label in chosen)

    def undecided_kind(self, vector: FeatureVector) -> AnswerType:
        """Return the answer about a class where none is decided, with the classes concluded."""
        verdict = self.reasoner.decide(vector).verdict
        if verdict is Verdict.CONTRADICTION:
            return AnswerType("contradictory")
        if verdict is not Verdict.SEVERAL:
            return AnswerType("undecided")
        concluded = tuple(
            key
            for key, scene_class in self.domain.classes.items()
            if self._why(vector, scene_class.literal) is not None
        )
        return AnswerType("several", values=concluded)

    def _undecided(self, vector: FeatureVector) -> Node:
        """Why the knowledge does not decide a scene: of many classes, the nearest are looked at."""
        both = contradiction(self.reasoner, vector, say=self._say)
        if both is not None:
            return both
        verdict = self.reasoner.decide(vector).verdict
        if verdict is Verdict.SILENT and (cases := self._cases(vector)):
            said = [case.text for case in cases]
            return Node(
                literal="undecided",
                text=f"the knowledge does not decide: {' '.join(said)}",
                basis=Basis.CASES,
                holds=False,
                children=cases,
            )
        children: list[Node] = []
        if verdict is Verdict.SEVERAL:
            concluded = (
                self._why(vector, scene_class.literal)
                for scene_class in self.domain.classes.values()
            )
            children += [node for node in concluded if node is not None]
        if verdict is Verdict.SILENT:
            nearest = self.nearest_classes(vector, most=_CLASSES_SHOWN)
            children += [self.why_not_class(vector, label) for label in nearest]
            others = len(self.domain.classes) - len(nearest)
            if others:
                text = (
                    f"nor does it follow that {self.domain.subject} is of one of the "
                    f"{others} other classes"
                )
                children.append(Node("others", text, Basis.ABSENCE, holds=False))
        why = _UNDECIDED[verdict]
        if verdict is Verdict.NO_ANSWER_SET:
            why += f", since {say_odd_loop(self.reasoner.odd_loop(vector))}"
        return Node(
            literal="undecided",
            text=f"the knowledge does not decide: {why}",
            basis=Basis.ABSENCE,
            holds=False,
            children=tuple(children),
        )

    def _cases(self, vector: FeatureVector) -> tuple[Node, ...]:
        """What the answer sets say of the class of an undecided scene; empty if all are silent."""
        evidence = self.evidence(vector)
        cases: list[Node] = []
        for each in (evidence, *evidence.others):
            keys = [key_of(scene_class.literal) for scene_class in self.domain.classes.values()]
            concluded = [belief_node(each, key) for key in keys if key in each.holds]
            cases += concluded or [_NO_CLASS]
        return either_or(once(cases)) if set(cases) != {_NO_CLASS} else ()

    def _evidence(self, vector: FeatureVector) -> Evidence:
        return evidence_of(self.reasoner, vector, say=self._say)

    def about(self, vector: FeatureVector, label: str) -> Evidence:
        """What is believed of a scene, its class included whoever gave it."""
        if self.reasoner.decide(vector).label == label:
            return self.evidence(vector)
        return self.told.evidence(vector, label)

    def _why_class(self, vector: FeatureVector, label: str) -> Node:
        """The justification of the belief that a scene is of a class."""
        return self._why(vector, self.domain.classes[label].literal) or self.why_not_class(
            vector, label
        )

    def _why_not_class(self, vector: FeatureVector, label: str) -> Node:
        """The justification of the absence of the belief that a scene is of a class."""
        return refuse(self.evidence(vector), self.domain.classes[label].literal)

    def _why(self, vector: FeatureVector, literal: Literal) -> Node | None:
        if self.reasoner.answer_set(vector) is None:
            return None
        return justify(self.evidence(vector), literal)

    def _against(self, vector: FeatureVector, asked: str) -> tuple[str, ...]:
        """The features that speak against a class, or else those that its axioms miss."""
        against = self._why(vector, self.domain.classes[asked].literal.complement)
        if against is not None:
            # What is believed false has reasons of its own; they say more than what is missing.
            return self._ordered(against.features())
        return self._ordered(tuple(_missed(self.why_not_class(vector, asked))))

    def _refused(self, vector: FeatureVector, asked: str) -> Node:
        refused = self.why_not_class(vector, asked)
        against = self._why(vector, self.domain.classes[asked].literal.complement)
        return (
            refused if against is None else replace(refused, children=(against, *refused.children))
        )

    def _changed(self, vector: FeatureVector, asked: str, kind: AnswerType) -> Node:
        """Why a scene is not of a class, and why it would be with the change."""
        refused = self.why_not_class(vector, asked)
        if not kind.changes:
            return refused
        after = self.ways.smallest(vector, asked)[0].vector
        node = replace(
            self.why_class(after, asked),
            text=f"with this change, {self._say(self.domain.classes[asked].literal)}",
        )
        return replace(refused, children=(*refused.children, node))

    def _ordered(self, features: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(feature for feature in self.domain.features if feature in features)

    def _say(self, literal: Literal) -> str:
        return say_literal(self.domain, literal)


def _missed(refused: Node) -> set[str]:
    """The features that the nearest axiom misses, or the nearest one for what it misses."""
    if refused.basis is Basis.CASES:
        return set().union(*(_missed(case) for case in refused.children if not case.holds))
    nearest = next((child for child in refused.children if child.is_refuted), None)
    if nearest is None:
        return set(refused.features())
    return set().union(*(_missed(node) for node in nearest.children if not node.holds))


def _belief(values: tuple[str, ...]) -> AnswerType:
    return AnswerType("belief", values=values) if values else AnswerType("no_belief")
