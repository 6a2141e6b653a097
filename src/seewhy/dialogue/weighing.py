"""Answers that weigh: what if, rather than, how sure, by which rule, and what to check."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import islice, product

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.antecedent import say_denied, say_values, supposed_values
from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.certainty import SURE_FROM, Ground, least_sure
from seewhy.dialogue.reason_answers import say_axiom
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reply import Classification, Reply
from seewhy.dialogue.told import Told
from seewhy.dialogue.tree_reason import tree_says
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import join_words, say_features, sentence
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

__all__ = ["Weighing"]

_MOST_SUPPOSED = 256
_MOST_OUTCOMES = 3


@dataclass(frozen=True)
class Weighing:
    """Weighs one scene against others that it might be.

    Attributes
    ----------
    domain : Domain
    reasoned : ReasonedAnswers
    tree : DecisionTree
    tree_node : callable
        The justification of a class that the tree gives a scene.
    """

    domain: Domain
    reasoned: ReasonedAnswers
    tree: DecisionTree
    tree_node: Callable[[FeatureVector, str], Node]

    def weigh(
        self, scene: Classification, question: Question, *, why: Node, previous: Reply | None
    ) -> Told:
        """Answer a question that weighs; ``why`` is the justification of the scene's class."""
        match question.asks:
            case Asks.WHAT_IF:
                denied = any(statement.denied for statement in question.statements)
                what_if = self._what_if_not if denied else self._what_if
                return what_if(scene, question.statements)
            case Asks.CONTRAST:
                return self._contrast(scene, *question.statements, why=why)
            case Asks.WHICH_RULE:
                return self._which_rule(scene, previous.justification if previous else why)
            case Asks.HOW_SURE:
                return self._how_sure(scene, question, why=why, previous=previous)
            case _:
                return self._to_check(scene, why=why)

    def decided(self, vector: FeatureVector) -> tuple[str | None, Node]:
        """The class of a scene, and why."""
        label = self.reasoned.reasoner.decide(vector).label
        if label is not None:
            return label, self.reasoned.why_class(vector, label)
        if self.tree.fitted:
            label = self.tree.classify(vector)
            return label, self.tree_node(vector, label)
        return None, self.reasoned.undecided(vector)

    def _what_if(self, scene: Classification, supposed: Sequence[Statement]) -> Told:
        """The class if some features had other values, and its reasons."""
        domain = self.domain
        values = domain.named(scene.vector)
        changes = {other.feature or "": other.value or "" for other in supposed}
        already = all(values[key] == value for key, value in changes.items())
        vector = domain.vector({**values, **changes})
        label, node = self.decided(vector)
        ordered = [key for key in domain.features if key in changes]
        condition = say_values(domain, changes)
        kind = AnswerType("what_if", tuple(ordered), (tuple(changes.items()),))
        begun = f"{condition} as it is" if already else f"if {condition}"
        if label is None:
            link = "and then " if already else ""
            return Told(kind, sentence(f"{begun}, {link}I cannot tell what it is"), node)
        # "It is still stable": said where the class was known before and stays.
        still = "still " if label == scene.label and not already else ""
        reasons = [key for key in node.features() if key not in changes]
        named = any("{it}" in domain.features[key].say[changes[key]] for key in ordered)
        because = say_features(domain, vector, reasons, subject="it")
        link = " and" if already else ""
        it = "it" if named else domain.subject
        text = f"{begun},{link} {it} is {still}{domain.classes[label].say}"
        if because:
            text += f", since {because}"
        return Told(kind, sentence(text), node, _least_of(scene, [*reasons], but=changes))

    def _what_if_not(self, scene: Classification, supposed: Sequence[Statement]) -> Told:
        """The class if a feature had any value but one: what all others come to, or each."""
        domain = self.domain
        values = domain.named(scene.vector)
        given = {other.feature or "": other.value or "" for other in supposed if not other.denied}
        denied = {other.feature or "": other.value or "" for other in supposed if other.denied}
        choices = [
            [(key, value) for value in domain.features[key].values if value != but]
            for key, but in denied.items()
        ]
        found: dict[str | None, list[tuple[dict[str, str], Node]]] = {}
        for chosen in islice(product(*choices), _MOST_SUPPOSED):
            label, node = self.decided(domain.vector({**values, **given, **dict(chosen)}))
            found.setdefault(label, []).append((dict(chosen), node))
        label, ((instead, node), *_) = next(iter(found.items()))
        changes = {**given, **instead}
        kind = AnswerType("what_if", tuple(changes), (tuple(changes.items()),))
        clauses = [say_values(domain, given)] if given else []
        clauses += [
            say_denied(domain, key, value, given=bool(given)) for key, value in denied.items()
        ]
        begun = f"if {join_words(clauses)}"
        if len(found) == 1:
            still = "still " if label == scene.label else ""
            is_it = (
                "I cannot tell what it is"
                if label is None
                else (f"it is {still}{domain.classes[label].say}")
            )
            return Told(kind, sentence(f"{begun}, {is_it}"), node)
        told = []
        for other, ((chosen_values, _), *_) in found.items():
            then = "I cannot tell" if other is None else f"it is {domain.classes[other].say}"
            told.append(f"{then}, for instance, if {say_values(domain, chosen_values)}")
        more = "; it may be others" if len(told) > _MOST_OUTCOMES else ""
        text = f"{begun}, it depends: {'; '.join(told[:_MOST_OUTCOMES])}{more}"
        return Told(kind, sentence(text), node)

    def _contrast(
        self, scene: Classification, first: Statement, other: Statement, *, why: Node
    ) -> Told:
        """Why one class or value, and not another."""
        domain = self.domain
        if first.label is None:
            return self._contrast_values(scene, first, other)
        kind = AnswerType("contrast", why.features())
        if scene.label != first.label:
            taken = "not decided" if scene.label is None else domain.classes[scene.label].say
            text = f"{domain.subject} is not {domain.classes[first.label].say}: it is {taken}"
            because = say_features(domain, scene.vector, why.features(), subject="it")
            return Told(
                kind, sentence(f"{text}, since {because}" if because else text), why,
                least_sure(kind, scene, why),
            )  # fmt: skip
        asked = Question(Asks.WHY_NOT_CLASS, "", (), label=other.label)
        refused = self.reasoned.kind(asked, scene.vector, first.label)
        because = say_features(domain, scene.vector, why.features(), subject="it")
        text = f"{domain.subject} is {domain.classes[first.label].say}"
        if because:
            text += f", since {because}"
        against = [key for key in refused.mentions if key not in why.features()]
        said = say_features(domain, scene.vector, against, subject="it")
        if said:
            text += f"; it is not {domain.classes[other.label or ''].say}, since {said}"
        elif (required := self._required(scene.vector, other.label or "")) is not None:
            text += f"; it is {domain.classes[other.label or ''].say} when {required}"
        elif refused.form == "against" and not refused.mentions:
            text += f"; nothing that is known concludes {domain.classes[other.label or ''].say}"
            learned = tree_says(domain, self.tree, scene.vector, other.label or "")
            if learned is not None:
                text += f"; {learned.text}"
        return Told(kind, sentence(text), why, least_sure(kind, scene, why))

    def _required(self, vector: FeatureVector, label: str) -> str | None:
        """What the nearest scene of a class has that this one lacks; None where there is none."""
        asked = Question(Asks.DIFFERENCE_TO_CLASS, "", (), label=label)
        differing = self.reasoned.kind(asked, vector, "").changes
        if not differing:
            return None
        change = dict(differing[0])
        return say_features(self.domain, self.domain.vector(change), list(change), subject="it")

    def _contrast_values(self, scene: Classification, first: Statement, other: Statement) -> Told:
        """Why one value of a feature is seen, and not another."""
        domain, key = self.domain, first.feature or ""
        node = self.reasoned.seen(scene.vector, key)
        kind = AnswerType("contrast", (key,))
        value = domain.named(scene.vector)[key]
        if value is None:
            return Told(kind, sentence(f"I do not know: {node.text}"), node)
        if scene.told:
            but = "" if value == first.value else "but "
            return Told(kind, sentence(f"{but}I was told that {node.text}"), node)
        reading = scene.features[key]
        text = f"I see that {node.text}, with a probability of {reading.probability:.2f}"
        if value == first.value:
            instead = domain.features[key].say[other.value or ""].replace("{it}", "it")
            text += f"; that {instead} has at most {1.0 - reading.probability:.2f}"
        else:
            text = f"but {text}"
        return Told(kind, sentence(text), node, Ground(key, value, reading.probability))

    def _which_rule(self, scene: Classification, why: Node) -> Told:
        """The axioms behind an answer, or the tree's path."""
        kind = AnswerType("which_rule", why.features())
        if any(node.basis is Basis.TREE for node in why.walk()):
            path = self.tree.path(scene.vector)
            text = f"no rule of the knowledge decides it; the tree's: {say_path(self.domain, path)}"
            return Told(kind, sentence(text), why)
        axioms = dict.fromkeys(
            node.axiom for node in why.walk() if node.axiom is not None and node.holds
        )
        said = [say_axiom(axiom) for axiom in axioms if axiom.body]
        if not said:
            return Told(kind, sentence(f"none: {why.text}"), why)
        return Told(kind, sentence(f"by {join_words(said)}"), why)

    def _how_sure(
        self, scene: Classification, question: Question, *, why: Node, previous: Reply | None
    ) -> Told:
        """How probable a value, the class or the last answer is."""
        domain = self.domain
        if question.feature is not None:
            return self._sure_of_value(scene, question.feature)
        label = question.label
        if label is not None and scene.label is not None and label != scene.label:
            other = next((other for other in scene.otherwise if other.label == label), None)
            said = f"I take {domain.subject} to be {domain.classes[scene.label].say}"
            if other is not None and other.probability is not None:
                said += f"; that it is {domain.classes[label].say} has a probability of "
                said += f"{other.probability:.2f}"
            return Told(AnswerType("how_sure"), sentence(said), why)
        if previous is not None and label is None:
            ground, node = previous.least_sure, previous.justification
            supposition = supposed_values(previous.kind)
            if supposition:
                begun = f"my answer supposes that {say_values(domain, supposition)}"
                beside = f"beside that, {self._say_sure(scene, ground)}"
                told = AnswerType("how_sure")
                return Told(told, sentence(f"{begun}; {beside}"), node, ground)
        else:
            ground, node = least_sure(AnswerType("class"), scene, why), why
        said = self._say_sure(scene, ground)
        if scene.told and scene.label is not None:
            said = "; ".join([said, *_unsaid(node)])
        return Told(AnswerType("how_sure"), sentence(said), node, ground)

    def _say_sure(self, scene: Classification, ground: Ground | None) -> str:
        if scene.label is None:
            return "I cannot tell what it is, so there is nothing to be sure of"
        if scene.told:
            return "I am as sure as of what I was told"
        if ground is None:
            return "I am sure: nothing that it rests on is uncertain"
        about = "class" if ground.feature == CLASS else self.domain.features[ground.feature].name
        sure = "I am sure" if ground.probability >= SURE_FROM else "I am not sure"
        return (
            f"{sure}: the least sure is the {about}, with a probability of {ground.probability:.2f}"
        )

    def _sure_of_value(self, scene: Classification, feature: str) -> Told:
        node = self.reasoned.seen(scene.vector, feature)
        kind = AnswerType("how_sure", (feature,))
        if self.domain.named(scene.vector)[feature] is None:
            return Told(kind, sentence(f"I am not: {node.text}"), node)
        if scene.told:
            return Told(kind, sentence(f"I was told that {node.text}"), node)
        reading = scene.features[feature]
        ground = Ground(feature, reading.value, reading.probability)
        text = f"that {node.text} has a probability of {reading.probability:.2f}"
        return Told(kind, sentence(text), node, ground)

    def _to_check(self, scene: Classification, *, why: Node) -> Told:
        """What would change the class if it were otherwise, the least sure first."""
        domain = self.domain
        values = domain.named(scene.vector)
        unknown = [key for key, value in values.items() if value is None]
        kind = AnswerType("to_check", why.features())
        if unknown:
            names = join_words([f"the {domain.features[key].name}" for key in unknown])
            return Told(kind, sentence(f"check {names}, which I do not know"), why)
        by_sureness = sorted(scene.features, key=lambda key: scene.features[key].probability)
        for key in by_sureness:
            for value in domain.features[key].values:
                if value == values[key]:
                    continue
                label, _ = self.decided(domain.vector({**values, key: value}))
                if label is None or label == scene.label:
                    continue
                text = f"check the {domain.features[key].name} first"
                probability = scene.features[key].probability
                if not scene.told:
                    text += f": it is seen with a probability of {probability:.2f}"
                otherwise = domain.features[key].say[value].replace("{it}", domain.subject)
                named = "{it}" in domain.features[key].say[value]
                it = "it" if named else domain.subject
                text += f"; if {otherwise}, {it} is {domain.classes[label].say}"
                ground = Ground(key, values[key] or "", probability)
                return Told(kind, sentence(text), self.reasoned.seen(scene.vector, key), ground)
        least = by_sureness[0]
        text = "nothing by itself would change the class"
        if not scene.told:
            text += f"; the least sure is the {domain.features[least].name} "
            text += f"({scene.features[least].probability:.2f})"
        return Told(kind, sentence(text), why)


def _unsaid(node: Node) -> list[str]:
    """What a conclusion from told values rests on as well: that nothing says something."""
    absent = (step.text.removeprefix("supposing that ") for step in node.walk() if step.holds)
    return list(dict.fromkeys(text for text in absent if text.startswith("nothing says that ")))


def _least_of(
    scene: Classification, features: Sequence[str], *, but: dict[str, str]
) -> Ground | None:
    """The least sure of what is seen and not supposed."""
    grounds = [
        Ground(key, scene.features[key].value, scene.features[key].probability)
        for key in features
        if key in scene.features and key not in but
    ]
    return min(grounds, key=lambda ground: ground.probability, default=None)
