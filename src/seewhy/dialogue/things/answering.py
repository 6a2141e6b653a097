"""Answers to questions about one scene's things, each with its reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.contrast import tell_change, tell_contrast, tell_why, tell_why_not
from seewhy.dialogue.things.edits import Edit, scene_after
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.fixing import fixed
from seewhy.dialogue.things.follow_up_forms import FollowUp
from seewhy.dialogue.things.outcome import Value, outcome_of
from seewhy.dialogue.things.query import (
    AnyOf,
    ClassIs,
    Completing,
    Consequence,
    Count,
    Describe,
    Description,
    Difference,
    Exists,
    Holds,
    Is,
    Most,
    MostCommon,
    Occurring,
    Query,
    Reference,
    References,
    SharedByMost,
    Together,
    ValueOf,
    Which,
    WhichClass,
)
from seewhy.dialogue.things.reading import QuestionReader, Reading
from seewhy.dialogue.things.reasons import Reasons
from seewhy.dialogue.things.saying_edits import say_edit
from seewhy.dialogue.things.supposing import NoOneWayError, supposed_edits
from seewhy.dialogue.things.telling import tell, tell_failure
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.things import Things
from seewhy.domain.wording import as_clause, join_words
from seewhy.errors import QuestionError
from seewhy.knowledge.justification import Basis, Node

__all__ = ["ThingAnswerer", "ThingReply"]


@dataclass(frozen=True, eq=False)
class ThingReply:
    """An answer about things.

    Attributes
    ----------
    question, text : str
        What was asked, and the answer as a sentence.
    query : Query
        What the question was taken to ask.
    value : bool, int, str, tuple or None
        The answer itself; None where it is not known, or the question speaks of a thing that is
        not there or not one.
    failed : UnclearReferenceError or None
        Why the question has no answer.
    spoken_of : Reference or None
        What "it" is in the next question.
    asks_how_sure : bool
        Whether it was asked how sure the answer is.
    """

    question: str
    text: str
    query: Query
    value: Value
    words: ThingWords
    failed: UnclearReferenceError | None = None
    spoken_of: Reference | None = None
    asks_how_sure: bool = False

    @cached_property
    def justification(self) -> Node:
        """The reasons, down to the things and what was seen of them."""
        if self.failed is None:
            return Reasons(self.words.evaluation, self.words).tree(self.query, self.text)
        reference = self.failed.reference
        counted = Count(Description(reference.description.conditions))
        try:
            return Reasons(self.words.evaluation, self.words).tree(counted, self.text)
        except UnclearReferenceError:
            return Node("reference", self.text, Basis.ABSENCE)

    def to_dict(self) -> dict[str, Any]:
        """Return the reply as values that JSON can hold."""
        return {
            "question": self.question,
            "text": self.text,
            "answer": list(self.value) if isinstance(self.value, tuple) else self.value,
            "understood": str(self.query),
            "justification": self.justification.to_dict(),
        }


class ThingAnswerer:
    """Answers questions about the things of a domain's scenes.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(
    ...     things,
    ...     [{"colour": "red", "shape": "cube"}, {"colour": "blue", "shape": "sphere"}],
    ...     relations={"left": [(0, 1)]},
    ... )
    >>> answerer = ThingAnswerer(things)
    >>> print(answerer.answer("What is left of the ball?", scene).text)
    There is one thing left of the blue sphere: the red cube.
    """

    def __init__(self, things: Things) -> None:
        self.things = things
        self.reader = QuestionReader(things)

    def answer(
        self, question: str, scene: ThingScene, *, previous: ThingReply | None = None
    ) -> ThingReply:
        """Answer a question about a scene.

        ``previous`` is the answer before, to which "it", "why?" and "and the red one?" go.

        Raises
        ------
        QuestionError
            If the question is not understood.
        """
        try:
            return self._answer(question, scene, previous)
        except NoOneWayError as problem:
            words = ThingWords(Evaluation(scene, self.things))
            raise QuestionError(_no_one_way(problem, words)) from None
        except RecursionError:
            raise QuestionError(
                "the question speaks of things by things by things, too many times over; ask in "
                "two steps"
            ) from None

    def suppose(self, reply: ThingReply, scene: ThingScene, edits: Sequence[Edit]) -> ThingReply:
        """Answer the question of an answer about a scene as it would be.

        Examples
        --------
        >>> from seewhy.data.thing_scene import thing_scene
        >>> from seewhy.dialogue.things.edits import Recolour
        >>> from seewhy.domain.domain import load_domain
        >>> things = load_domain("tabletop").things
        >>> scene = thing_scene(things, [{"colour": "red"}, {"colour": "blue"}], relations={})
        >>> answerer = ThingAnswerer(things)
        >>> reply = answerer.answer("How many red things are there?", scene)
        >>> answerer.suppose(reply, scene, [Recolour(1, "colour", "red")]).value
        2
        """
        supposed = self._answered(
            reply.question, Reading(reply.query), self._supposing(scene, edits), None
        )
        assert supposed is not None, "what was answered once is a question"
        return supposed

    def _supposing(self, scene: ThingScene, edits: Sequence[Edit]) -> ThingWords:
        """The words of a scene with changes made, and with what then follows in it."""
        changed, without = scene_after(scene, self.things, edits)
        return ThingWords(Evaluation(changed, self.things, without=without))

    def _answer(self, question: str, scene: ThingScene, previous: ThingReply | None) -> ThingReply:
        readings = self.reader.readings(
            question,
            antecedent=previous.spoken_of if previous else None,
            answered=previous is not None,
        )
        words = None if previous is None else previous.words
        if words is None or words.evaluation.scene is not scene or words.evaluation.without:
            words = ThingWords(Evaluation(scene, self.things))  # what was supposed is left again
        failed: ThingReply | None = None
        for reading in readings:
            reply = self._answered(question, reading, words, previous)
            if reply is not None and reply.failed is None:
                return reply
            failed = failed or reply
        if failed is None:
            raise QuestionError("I do not understand what the question has to do with the last")
        return failed

    def _answered(
        self, question: str, reading: Reading, words: ThingWords, previous: ThingReply | None
    ) -> ThingReply | None:
        query = reading.query
        if isinstance(query, FollowUp):
            followed = self._followed(question, query, reading, words, previous)
            if not isinstance(followed, FollowUp):
                return followed
            assert previous is not None, "what is asked instead follows an answer"
            replaced = _instead(previous.query, query.instead)
            if replaced is None:
                return None
            query = replaced
        if isinstance(query, Completing) and not self.things.groups:
            return None
        spoken_of = _spoken_of(query) or reading.spoken_of
        if isinstance(query, ClassIs | WhichClass):
            spoken_of = None  # "it" is the picture as a whole
        try:
            outcome = outcome_of(query, words.evaluation)
        except UnclearReferenceError as failed:
            text = tell_failure(failed, words)
            return ThingReply(question, text, query, None, words, failed, spoken_of)
        text = tell(query, outcome, words)
        return ThingReply(question, text, query, outcome.value, words, None, spoken_of)

    def _followed(
        self,
        question: str,
        asked: FollowUp,
        reading: Reading,
        words: ThingWords,
        previous: ThingReply | None,
    ) -> ThingReply | FollowUp | None:
        """What is asked about an answer; itself where the same is asked of something else."""
        if asked.asks == "what_if":
            return self._supposed(question, asked, previous, words)
        if asked.asks == "how_sure":
            return self._how_sure(question, previous, words)
        if asked.query is not None:
            about = Reading(asked.query, reading.spoken_of)
            if asked.asks == "why":
                return self._why(question, about, words, so=asked.wanted is not False)
            named = self._answered(question, about, words, None)
            return _about_answer(question, asked, named) if named and not named.failed else named
        if previous is None:
            return None
        return asked if asked.asks == "instead" else _about_answer(question, asked, previous)

    def _supposed(
        self, question: str, asked: FollowUp, previous: ThingReply | None, words: ThingWords
    ) -> ThingReply | None:
        """A question, or the one before, asked of the scene as it would be."""
        evaluation = words.evaluation
        if not isinstance(asked.instead, Reference):
            return None
        query = asked.query
        if query is None and previous is not None:
            query = previous.query
        if query is None or isinstance(query, Consequence):
            query = Consequence(asked.instead, asked.supposed)
            return self._answered(question, Reading(query), words, None)
        try:
            number = evaluation.the(asked.instead)
            edits = supposed_edits(number, asked.supposed, evaluation)
        except UnclearReferenceError as failed:
            text = tell_failure(failed, words)
            return ThingReply(question, text, query, None, words, failed)
        supposed = self._supposing(evaluation.scene, edits)
        reply = self._answered(question, Reading(fixed(query, evaluation)), supposed, None)
        return reply and replace(reply, text=f"Then: {as_clause(reply.text)}")

    def _why(
        self, question: str, about: Reading, words: ThingWords, *, so: bool
    ) -> ThingReply | None:
        """Why something is so, or is not, that a question names; where it is otherwise, that."""
        reply = self._answered(question, about, words, None)
        if reply is None or reply.failed is not None:
            return reply
        why = tell_why(reply.justification)
        if isinstance(reply.value, bool) and reply.value is not so:
            of_class = isinstance(reply.query, ClassIs)
            denied = "not " if so else ""
            why = f"But {as_clause(why)}" if of_class else f"But it is {denied}so: {why}"
        return replace(reply, text=why)

    def _how_sure(
        self, question: str, previous: ThingReply | None, words: ThingWords
    ) -> ThingReply | None:
        """How sure an answer is: as sure as what was said of the scene."""
        reply = previous
        if reply is None and self.things.whole.classes:
            reply = self._answered(question, Reading(WhichClass()), words, None)
        if reply is None:
            return None
        text = "I am as sure as of what I was told."
        if reply.value is None:
            text = "I gave no answer that I could be sure of."
        return replace(reply, question=question, text=text, asks_how_sure=True)


def _no_one_way(problem: NoOneWayError, words: ThingWords) -> str:
    """That what is supposed is not one change."""
    if not problem.ways:
        return "I know of no change of one or two things by which that would be so"
    said = [f"if {join_words([say_edit(e, words) for e in way])}" for way in problem.ways[:3]]
    more = ", or otherwise" if len(problem.ways) > len(said) else ""
    return f"that could come about in several ways: {'; '.join(said)}{more}; say which"


def _about_answer(question: str, asked: FollowUp, previous: ThingReply) -> ThingReply | None:
    """What is asked about an answer; the answer stays what is spoken of.

    None where what is asked does not go with it.
    """
    text: str | None
    if asked.asks == "change":
        text = tell_change(previous.query, previous.value, asked.wanted, previous.words)
    elif asked.asks == "contrast":
        text = tell_contrast(previous.query, asked.instead, previous.words)
    elif asked.asks == "why_not":
        text = tell_why_not(previous.query, previous.value, asked.wanted, previous.words)
    else:
        text = tell_why(previous.justification)
    if text is None:
        return None
    return ThingReply(
        question,
        text,
        previous.query,
        previous.value,
        previous.words,
        previous.failed,
        previous.spoken_of,
    )


def _spoken_of(query: Query) -> Reference | None:
    """What "it" means behind a question."""
    match query:
        case ValueOf(one=one) | Describe(one=one):
            return one
        case Holds(ones=(kind,), condition=Is(one=only)) if kind.which is References.EVERY:
            return only
        case Holds(ones=ones):
            return ones[0]
        case Together(ones=ones) | Completing(ones=ones):
            return _all_of(ones)
        case Difference(first=first, second=second):
            return _all_of((first, second))
        case Consequence(one=one):
            return one
        case Count(described=described) | Exists(described=described) | Which(described=described):
            return Reference(described)
        case Most(described=described) | SharedByMost(described=described):
            return Reference(described, References.EVERY)
        case MostCommon(described=described) | Occurring(described=described):
            return Reference(described, References.EVERY)
    return None


def _all_of(ones: tuple[Reference, ...]) -> Reference:
    """What "they" are."""
    if len(ones) == 1:
        return ones[0]
    any_of = AnyOf(tuple(Is(reference) for reference in ones))
    return Reference(Description((any_of,), many=True), References.EVERY)


def _instead(query: Query, instead: Description | Reference | None) -> Query | None:
    """The question before about something else: "and the red one?"."""
    if isinstance(instead, Reference):
        match query:
            case ValueOf(feature=feature):
                return ValueOf(feature, instead)
            case Describe(place=place):
                return Describe(instead, place)
            case Holds(ones=(kind,), condition=Is()) if kind.which is References.EVERY:
                return Holds((kind,), Is(instead)) if instead.which is References.THE else None
            case Holds(condition=condition):
                return Holds((instead,), condition)
        instead = instead.description
    if isinstance(instead, Description):
        match query:
            case Count():
                return Count(instead)
            case Exists(denied=denied):
                return Exists(instead, denied)
            case Which():
                return Which(instead)
            case Most() | SharedByMost() | MostCommon() | Occurring():
                return replace(query, described=instead)
    return None
