"""Answers about what is seen: its values, several at once, where, and what else looks like it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.certainty import Ground
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reply import Classification
from seewhy.dialogue.static_answers import tell_static
from seewhy.dialogue.told import Told
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import join_clauses, join_words, say_features, sentence
from seewhy.errors import QuestionError
from seewhy.knowledge.justification import Basis, Node

if TYPE_CHECKING:
    from seewhy.perception.familiarity import NearPicture
    from seewhy.perception.where import Where

__all__ = ["Look", "tell"]


class Look(Protocol):
    """A picture that can be looked at again."""

    def where(self) -> Mapping[str, Where]:
        """Where each feature is seen, and the class where that has a say."""

    def nearest(self) -> Sequence[NearPicture]:
        """The pictures of training that are most like it, the most alike first."""


def tell(
    domain: Domain,
    reasoned: ReasonedAnswers,
    scene: Classification,
    question: Question,
    *,
    why: Node,
    look: Look | None,
) -> Told:
    """Answer a question about what is seen.

    Parameters
    ----------
    domain : Domain
    reasoned : ReasonedAnswers
        What words a feature as a step of a justification.
    scene : Classification
    question : Question
    why : Node
        The justification of the scene's class, or why there is none.
    look : Look or None
        The picture, for questions that need it.

    Raises
    ------
    QuestionError
        If a question needs the picture, or a trained model, and there is none.
    """
    match question.asks:
        case Asks.WHY_VALUE | Asks.WHY_NOT_VALUE:
            return _seen_by(domain, reasoned, scene, question, look)
        case Asks.BELIEF_IS | Asks.WHY_BELIEF | Asks.WHY_NOT_BELIEF:
            return tell_static(domain, reasoned, scene, question, why)
        case Asks.WHERE:
            return _where(domain, reasoned, scene, question, look)
        case Asks.SIMILAR:
            return _similar(domain, why, look)
        case Asks.DESCRIBE:
            return _description(domain, reasoned, scene, question, why)
        case Asks.WHICH | Asks.HOW_MANY:
            return _of_group(domain, reasoned, scene, question)
        case _:
            return _joined(domain, reasoned, scene, question, why)


def _all_seen(
    reasoned: ReasonedAnswers, scene: Classification, features: Sequence[str], text: str
) -> Node:
    """The features that an answer rests on, one beside the other."""
    nodes = tuple(reasoned.seen(scene.vector, feature) for feature in features)
    if len(nodes) == 1:
        return nodes[0]
    return Node("seen", text, Basis.REASONS, children=nodes)


def _least(scene: Classification, features: Sequence[str]) -> Ground | None:
    grounds = [
        Ground(key, scene.features[key].value, scene.features[key].probability)
        for key in features
        if key in scene.features
    ]
    return min(grounds, key=lambda ground: ground.probability, default=None)


def _seen_by(
    domain: Domain,
    reasoned: ReasonedAnswers,
    scene: Classification,
    question: Question,
    look: Look | None,
) -> Told:
    """What a value was seen by: its probability, what was overruled, and where."""
    feature = question.feature or ""
    value = domain.named(scene.vector)[feature]
    node = reasoned.seen(scene.vector, feature)
    kind = AnswerType("seen_by", (feature,))
    if value is None:
        text = f"I do not know: {node.text}"
        return Told(kind, sentence(text), node)
    reading = scene.features[feature]
    clause = domain.features[feature].say[value].replace("{it}", domain.subject)
    because = f"I was told that {clause}" if scene.told else f"I see that {clause}"
    if not scene.told:
        because += f", with a probability of {reading.probability:.2f}"
    if reading.overruled is not None:
        alone, probability = reading.overruled
        other = domain.features[feature].say[alone].replace("{it}", "it")
        because += (
            f"; by itself I would have seen that {other} ({probability:.2f}), which does not fit "
            "what is known"
        )
    elif look is not None:
        place = _place(look, feature)
        because += f", most of all {place}" if place else ""
    as_presumed = (value == question.value) == (question.asks is Asks.WHY_VALUE)
    text = because if as_presumed else f"but {because}"
    return Told(kind, sentence(text), node, _least(scene, [feature]))


def _place(look: Look, feature: str) -> str:
    """Where a feature is seen, in words; empty where no place matters."""
    found = look.where().get(feature)
    return found.place if found is not None and found.matters else ""


def _where(
    domain: Domain,
    reasoned: ReasonedAnswers,
    scene: Classification,
    question: Question,
    look: Look | None,
) -> Told:
    """Where something is seen, in words."""
    if look is None:
        raise QuestionError(
            "where something is seen can be told of a picture only, and there is none; ask "
            "'seewhy ask MODEL IMAGE'"
        )
    if question.label is not None:
        return _where_class(domain, reasoned, scene, question.label, look)
    feature = question.feature or ""
    value = domain.named(scene.vector)[feature]
    node = reasoned.seen(scene.vector, feature)
    kind = AnswerType("where", (feature,))
    ground = _least(scene, [feature])
    clause = node.text
    if value is None:
        return Told(kind, sentence(f"I do not know: {clause}"), node)
    if question.value is not None and value != question.value:
        return Told(kind, sentence(f"nowhere: {clause}"), node, ground)
    found = look.where().get(feature)
    if found is None or not found.matters:
        text = f"{clause}, and no single place of the picture tells it"
    else:
        text = f"{clause}, and I see it most of all {found.place}"
    return Told(kind, sentence(text), node, ground)


def _where_class(
    domain: Domain, reasoned: ReasonedAnswers, scene: Classification, label: str, look: Look
) -> Told:
    """Where that is seen which makes a scene one of its class."""
    if scene.label != label:
        taken = "I cannot tell" if scene.label is None else domain.classes[scene.label].say
        said = f"nowhere: {domain.subject} is {taken}" if scene.label else f"nowhere: {taken}"
        node = (
            reasoned.undecided(scene.vector)
            if scene.label is None
            else reasoned.why_class(scene.vector, scene.label)
        )
        return Told(AnswerType("where"), sentence(said), node)
    node = reasoned.why_class(scene.vector, label)
    places = look.where()
    features = [key for key in domain.features if key in node.features()]
    told = []
    for feature in (*features, CLASS):
        found = places.get(feature)
        if found is not None and found.matters:
            name = "class by itself" if feature == CLASS else domain.features[feature].name
            told.append(f"the {name} {found.place}")
    text = f"I see {join_words(told)}" if told else "no single place of the picture tells it"
    return Told(AnswerType("where", tuple(features)), sentence(text), node, _least(scene, features))


def _similar(domain: Domain, why: Node, look: Look | None) -> Told:
    """The pictures of training that are most like the one at hand."""
    if look is None:
        raise QuestionError(
            "similar pictures can be named for a picture only, and there is none; ask 'seewhy ask "
            "MODEL IMAGE'"
        )
    near = look.nearest()
    if not near:
        text = "I cannot tell: networks that grew on these pictures alone keep none to compare with"
    else:
        listed = join_words([_near_picture(domain, picture) for picture in near])
        text = f"of the pictures of training, the most like it: {listed}"
    return Told(AnswerType("similar"), sentence(text), why)


def _near_picture(domain: Domain, near: NearPicture) -> str:
    label = near.picture.label
    said = f"{domain.classes[label].say}, " if label is not None else ""
    return f"{near.picture.name} ({said}alike to {near.likeness:.2f})"


def _description(
    domain: Domain,
    reasoned: ReasonedAnswers,
    scene: Classification,
    question: Question,
    why: Node,
) -> Told:
    """All that is seen, or what is seen of some features that are together."""
    if question.group:
        values = domain.named(scene.vector)
        there = [key for key in question.group if values[key] == "yes"]
        shown = there or list(question.group)
        text = say_features(domain, scene.vector, shown) or "I do not know"
        return Told(
            AnswerType("description", tuple(shown)),
            sentence(text),
            _all_seen(reasoned, scene, shown, text),
            _least(scene, question.group),
        )
    features = [key for key, value in domain.named(scene.vector).items() if value is not None]
    said = say_features(domain, scene.vector, features) or "I know nothing of its features"
    if scene.label is None:
        text = f"{said}; I cannot tell what {domain.subject} is"
    else:
        text = f"{said}; {domain.subject} is {domain.classes[scene.label].say}"
    return Told(
        AnswerType("description", tuple(features)), sentence(text), why, _least(scene, features)
    )


def _of_group(
    domain: Domain, reasoned: ReasonedAnswers, scene: Classification, question: Question
) -> Told:
    """Which features of a group have a value, and how many."""
    values = domain.named(scene.vector)
    value = question.value or ""
    found = [key for key in question.group if values[key] == value]
    unknown = [key for key in question.group if values[key] is None]
    names = [f"the {domain.features[key].name}" for key in found]
    state = domain.features[question.group[0]].words[value][0]
    one = len(found) == 1
    if question.asks is Asks.HOW_MANY:
        text = f"{len(found)} of {len(question.group)} {'is' if one else 'are'} {state}"
        text += f": {join_words(names)}" if names else ""
    elif names:
        text = f"{join_words(names)} {'is' if one else 'are'} {state}"
    else:
        text = f"none of them is {state}"
    if unknown:
        text += f"; of {join_words([domain.features[key].name for key in unknown])} I do not know"
    return Told(
        AnswerType("group", tuple(found)),
        sentence(text),
        _all_seen(reasoned, scene, question.group, text),
        _least(scene, question.group),
    )


def _joined(
    domain: Domain,
    reasoned: ReasonedAnswers,
    scene: Classification,
    question: Question,
    why: Node,
) -> Told:
    """Whether all of several things are so, or any of them."""
    values = domain.named(scene.vector)
    so = [_holds(values, scene, statement) for statement in question.statements]
    both = question.asks is Asks.ALL
    features = [
        statement.feature for statement in question.statements if statement.feature is not None
    ]
    told = [
        statement
        for statement, holds in zip(question.statements, so, strict=True)
        if both or holds or not any(so)
    ]
    said = [_say_as_it_is(domain, values, scene, picture) for picture in told]
    text = join_clauses(list(dict.fromkeys(said)), subject=domain.subject)
    known = all(so) if both else any(so)
    if not known and None in so:
        answer = f"I cannot tell: {text}"
    else:
        answer = f"{'yes' if known else 'no'}, {text}"
    node = _all_seen(reasoned, scene, features, text)
    if len(features) < len(question.statements):
        node = (
            Node("seen", text, Basis.REASONS, children=(why, *node.children)) if features else why
        )
    return Told(
        AnswerType("all" if both else "either", tuple(features)),
        sentence(answer),
        node,
        _least(scene, features),
    )


def _holds(
    values: Mapping[str, str | None], scene: Classification, statement: Statement
) -> bool | None:
    """Whether a statement is so; None where that is not known."""
    found = scene.label if statement.label is not None else values[statement.feature or ""]
    return None if found is None else found == (statement.label or statement.value)


def _say_as_it_is(
    domain: Domain,
    values: Mapping[str, str | None],
    scene: Classification,
    statement: Statement,
) -> str:
    """What is so of the class or the feature that a statement is about."""
    if statement.label is not None:
        said = domain.classes[scene.label].say if scene.label else "not decided"
        return f"{{it}} is {said}"
    feature = domain.features[statement.feature or ""]
    value = values[feature.key]
    return f"the {feature.name} is not known" if value is None else feature.say[value]
