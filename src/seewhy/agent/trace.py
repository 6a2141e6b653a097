"""An execution trace: what each component did with a picture and a question about it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from seewhy.dialogue.certainty import Certainty, Ground
from seewhy.dialogue.constant_features import say_only_shown
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reply import UNCERTAIN, UNKNOWN, Classification, FeatureReading, Reply
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import join_words
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import TreePath
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.justification import Basis, Node

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.agent.seeing import Picture
    from seewhy.domain.domain import Domain


@dataclass(frozen=True)
class Concluded:
    """What the knowledge concluded about a picture, or why it was not asked.

    Attributes
    ----------
    label : str or None
        The class that is believed in every preferred answer set, if exactly one is.
    justification : Node or None
        Why that is believed, or why no class is; None where the knowledge was not asked.
    given_up : tuple of Axiom
        The defaults to which the first preferred answer set makes exceptions.
    not_asked : str or None
        Why it was not asked, as a clause.
    """

    label: str | None
    justification: Node | None
    given_up: tuple[Axiom, ...] = ()
    not_asked: str | None = None


@dataclass(frozen=True)
class Trace:
    """The way of one picture through the components.

    Use it to see where a wrong answer came from: what was seen, what was concluded from it,
    whether the tree had to be asked, how the question was understood and the answer found.
    Source: the execution traces of Riley and Sridharan (2019).

    Attributes
    ----------
    domain : Domain
    scene : Classification
    least_likeness : float or None
        Of pictures with a smaller score than this it is said that they are not known.
    concluded : Concluded
    path : TreePath or None
        The path that the picture took through the tree, where the tree was asked.
    no_tree : str or None
        Why the tree was not asked, as a clause.
    asked : str or None
        The question as it was put, if there was one.
    reply : Reply or None
    only_shown : mapping of str to str
        Of features of which training pictures showed one value, that value.
    """

    domain: Domain
    scene: Classification
    least_likeness: float | None
    concluded: Concluded
    path: TreePath | None
    no_tree: str | None
    asked: str | None = None
    reply: Reply | None = None
    only_shown: Mapping[str, str] = field(default_factory=dict)

    def to_text(self) -> str:
        """Return the trace for a person: the dialogue, then each component in turn."""
        parts = []
        if self.reply is not None:
            parts.append([f"Person: {self.asked}", f"Agent: {self.reply.text}"])
        parts.append(["networks", *_indented(self._say_seen())])
        parts.append(["knowledge", *_indented(self._say_concluded())])
        parts.append(["decision tree", *_indented(self._say_tree())])
        if self.reply is None:
            parts.append(["class", *_indented([self._say_class()])])
        else:
            parts.append(["question", *_indented(_say_question(self.reply))])
            parts.append(["answer", *_indented(self._say_answer(self.reply))])
        return "\n\n".join("\n".join(part) for part in parts)

    def to_dict(self) -> dict[str, Any]:
        """Return the trace as values that JSON can hold."""
        scene, concluded, path = self.scene, self.concluded, self.path
        why = concluded.justification
        told = {} if self.reply is None else self.reply.to_dict()
        return {
            "asked": self.asked,
            "text": None if self.reply is None else self.reply.text,
            "class": scene.label,
            "class_probability": _rounded(scene.probability),
            "method": scene.method,
            "networks": {
                "features": {key: _reading(feature) for key, feature in scene.features.items()},
                "class_seen": None
                if scene.class_seen is None
                else {"class": scene.class_seen[0], "probability": _rounded(scene.class_seen[1])},
                "score": _rounded(scene.score),
                "least_score": _rounded(self.least_likeness),
                "known": scene.verdict != UNKNOWN,
                "only_shown": dict(self.only_shown),
            },
            "knowledge": {
                "asked": concluded.not_asked is None,
                "not_asked": concluded.not_asked,
                "verdict": scene.verdict,
                "class": concluded.label,
                "exceptions": [str(axiom) for axiom in concluded.given_up],
                "justification": None if why is None else why.to_dict(),
            },
            "tree": {
                "asked": path is not None,
                "not_asked": self.no_tree,
                "path": None
                if path is None
                else {
                    "text": say_path(self.domain, path),
                    "conditions": {
                        condition.feature: list(condition.values) for condition in path.conditions
                    },
                    "class": path.label,
                    "support": path.support,
                    "precision": path.precision,
                },
            },
            "question": None
            if self.reply is None
            else {
                "text": f"{self.reply.question.text}?",
                "type": self.reply.question.asks.value,
                "arguments": _arguments(self.reply),
            },
            "answer": None
            if self.reply is None
            else {
                "found_by": found_by(self.reply),
                "type": self.reply.kind.identifier,
                **{key: told[key] for key in ("supposed", "certainty", "least_sure")},
                "justification": self.reply.justification.to_dict(),
            },
        }

    def _say_seen(self) -> Iterator[str]:
        yield from self._say_each_seen()
        said = say_only_shown(self.domain, self.scene.features, self.only_shown)
        if said:
            yield said
        yield from self._say_whole_seen()

    def _say_each_seen(self) -> Iterator[str]:
        for key, reading in self.scene.features.items():
            value = reading.value.replace("_", " ")
            line = f"{self.domain.features[key].name}: {value} (p = {reading.probability:.2f})"
            if reading.overruled is not None:
                alone, probability = reading.overruled
                line += (
                    f"; overruled: the network alone saw {alone.replace('_', ' ')} "
                    f"(p = {probability:.2f}), which does not fit what is known"
                )
                if self.scene.class_seen is not None:
                    line += " and the class that is seen"
            yield line

    def _say_whole_seen(self) -> Iterator[str]:
        if self.scene.class_seen is not None:
            label, probability = self.scene.class_seen
            yield (
                f"class: {self.domain.classes[label].say} (p = {probability:.2f}), seen by a "
                "network of its own; a witness to what the features are"
            )
        if self.least_likeness is not None:
            refused = self.scene.verdict == UNKNOWN
            yield (
                f"likeness to pictures of training: {self.scene.score or 0.0:.3f}; at least "
                f"{self.least_likeness:.3f} is asked for, so the picture is "
                f"{'not ' * refused}known"
            )

    def _say_concluded(self) -> Iterator[str]:
        concluded = self.concluded
        if concluded.justification is None:
            yield f"not asked: {concluded.not_asked}"
            return
        if concluded.label is not None:
            said = self.domain.classes[concluded.label].say
            yield f"every preferred answer set says that {self.domain.subject} is {said}:"
        else:
            yield "no class follows:"
        yield from _indented(concluded.justification.to_text().splitlines())
        for axiom in concluded.given_up:
            yield f'other than usual: "{axiom.text}" does not hold here'

    def _say_tree(self) -> Iterator[str]:
        if self.path is None:
            yield f"not asked: {self.no_tree}"
            return
        yield say_path(self.domain, self.path)
        seen = self.scene.class_seen
        if seen is not None and seen[0] == self.scene.label != self.path.label:
            yield f"outweighed by the class seen by itself: {seen[0]} (p = {seen[1]:.2f})"

    def _say_class(self) -> str:
        scene = self.scene
        if scene.label is None:
            return "none: neither the knowledge nor a tree gives one"
        sure = "" if scene.probability is None else f" (p = {scene.probability:.2f})"
        return f"{scene.label}{sure}, by the {_method(scene)}"

    def _say_answer(self, reply: Reply) -> Iterator[str]:
        if reply.supposed is not None:
            supposed = reply.supposed
            label = self.domain.classes[supposed.label or ""].say
            others = [
                f"{self.domain.features[key].name} {reading.value.replace('_', ' ')}"
                for key, reading in supposed.features.items()
                if reading.value != self.scene.features[key].value
            ]
            yield (
                f"supposes what the question presumes: {self.domain.subject} is {label} "
                f"(p = {supposed.probability or 0.0:.2f}), with "
                f"{join_words(others) if others else 'the same features'}"
            )
        if reply.least_sure is not None and reply.certainty not in (None, Certainty.SURE):
            yield _say_least_sure(self.domain, reply.least_sure)
        yield f"found by {found_by(reply)}"
        if reply.justification == self.concluded.justification:
            yield "because of what the knowledge concludes above"
            return
        yield "because:"
        yield from _indented(reply.justification.to_text().splitlines())


def trace(agent: Agent, image: Picture, question: str | None = None) -> Trace:
    """Classify a picture, answer the question about it if there is one, and keep every step.

    Raises
    ------
    QuestionError, PictureError, NotFittedError
        As :meth:`seewhy.Agent.ask`.
    """
    understood = None if question is None else agent.questions.understand(question)
    scene = agent.classify(image)
    reply = None if understood is None else agent.answer(scene, understood, image=image)
    return trace_of(agent, scene, asked=question, reply=reply)


def trace_of(
    agent: Agent, scene: Classification, *, asked: str | None = None, reply: Reply | None = None
) -> Trace:
    """Return the trace of a classification, and of an answer about it.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> values = {"num_blocks": "4", "base": "wide", "lean": "no", "block_displaced": "yes"}
    >>> scene = Classification(
    ...     "unstable", "knowledge", agent.domain.vector(values),
    ...     {key: FeatureReading(value, 0.9) for key, value in values.items()}, "believed")
    >>> reply = agent.answer(scene, agent.questions.understand("is it stable?"))
    >>> traced = trace_of(agent, scene, asked="is it stable?", reply=reply)
    >>> traced.concluded.label, traced.no_tree, found_by(reply)
    ('unstable', 'the knowledge decides', 'reasoning')
    """
    concluded = _concluded(agent, scene)
    path = agent.tree.path(scene.vector) if scene.method == "tree" else None
    return Trace(
        agent.domain,
        scene,
        agent.unknown_below,
        concluded,
        path,
        None if path is not None else _no_tree(scene),
        asked,
        reply,
        agent.only_shown,
    )


def found_by(reply: Reply) -> str:
    """Return which component found an answer, in words."""
    bases = {node.basis for node in reply.justification.walk()}
    if reply.question.asks is Asks.EXPLAIN:
        return "telling the steps behind the class"
    if Basis.RECURRENT in bases:
        return "the recurrent network (LSTM)"
    if reply.kind.form in ("undecided", "several", "contradictory", "unknown"):
        return "no component"
    if reply.question.feature is not None:
        return "reading the feature"
    return "reasoning"


def _concluded(agent: Agent, scene: Classification) -> Concluded:
    if scene.verdict == UNKNOWN:
        return Concluded(None, None, not_asked="the picture is like none that is known")
    if scene.verdict == UNCERTAIN:
        return Concluded(None, None, not_asked=agent.say_uncertain(scene))
    label = agent.reasoner.decide(scene.vector).label
    why = scene.read_in(
        agent.reasoned.undecided(scene.vector)
        if label is None
        else agent.reasoned.why_class(scene.vector, label)
    )
    beliefs = agent.reasoner.answer_set(scene.vector)
    names = {name for name, _ in beliefs.exceptions} if beliefs else set()
    axioms = agent.domain.knowledge.axioms
    return Concluded(label, why, tuple(axiom for axiom in axioms if axiom.identifier in names))


def _no_tree(scene: Classification) -> str:
    if scene.verdict == UNKNOWN:
        return "the picture is like none that is known"
    if scene.method == "knowledge":
        return "the knowledge decides"
    return "there is none, for training left nothing open"


def _method(scene: Classification) -> str:
    return "decision tree" if scene.method == "tree" else "knowledge"


def _say_question(reply: Reply) -> Iterator[str]:
    yield f"understood as: {reply.question.text}?"
    about = "".join(f", {name} {value}" for name, value in _arguments(reply).items())
    yield f"type: {reply.question.asks.value}{about}"


def _arguments(reply: Reply) -> dict[str, str]:
    question = reply.question
    named = {
        "class": question.label,
        "feature": question.feature,
        "value": question.value,
        "static": question.predicate,
    }
    return {name: value for name, value in named.items() if value is not None}


def _say_least_sure(domain: Domain, least: Ground) -> str:
    if least.feature == CLASS:
        what = f"the class: {domain.classes[least.value].say}"
    else:
        what = f"{domain.features[least.feature].name}: {least.value.replace('_', ' ')}"
    return f"not sure; the least sure that it rests on is {what} (p = {least.probability:.2f})"


def _reading(reading: FeatureReading) -> dict[str, Any]:
    value, probability = reading.overruled or (None, None)
    return {
        "value": reading.value,
        "probability": _rounded(reading.probability),
        "overruled": None
        if probability is None
        else {"value": value, "probability": _rounded(probability)},
    }


def _rounded(number: float | None) -> float | None:
    return None if number is None else round(number, 4)


def _indented(lines: Iterator[str] | list[str]) -> list[str]:
    return [f"  {line}" for line in lines]
