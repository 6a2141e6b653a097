"""A question about a classified scene becomes a reply: by knowledge, or by what was learned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from seewhy.dialogue.answer import AnswerType, word_answer, word_supposed
from seewhy.dialogue.certainty import certainty_of, least_sure, least_sure_told
from seewhy.dialogue.class_differences import shared_by_pictures
from seewhy.dialogue.constant_features import with_only_shown
from seewhy.dialogue.default_reason import say_usual
from seewhy.dialogue.narration import narrate
from seewhy.dialogue.question import Asks, Question
from seewhy.dialogue.reason_answers import OF_REASONS, tell_of_reasons
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import Experience
from seewhy.dialogue.reply import UNCERTAIN, UNKNOWN, Classification, Reply
from seewhy.dialogue.telling import Look, tell
from seewhy.dialogue.told import Told
from seewhy.dialogue.tree_reason import tree_says
from seewhy.dialogue.weighing import Weighing
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import say_literal, sentence
from seewhy.induction.sentence import say_path
from seewhy.induction.tree import DecisionTree, TreePath
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.scene import FeatureVector

if TYPE_CHECKING:
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer

__all__ = ["Answering", "believed"]


@dataclass(frozen=True)
class Answering:
    """Answers questions about classified scenes.

    Where the knowledge classified a scene, it answers; where the tree did, the recurrent network
    chooses the answer.

    Attributes
    ----------
    domain : Domain
    reasoned : ReasonedAnswers
    tree : DecisionTree
    answerer : RecurrentAnswerer or None
        None where none was trained.
    experience : mapping
        The annotated feature vectors with their classes.
    gate, known_share, least_likeness : float
        What an answer says where a network was not sure enough, or a picture is not known; see
        :class:`seewhy.Agent`.
    trust : float
        How often who asks is right; see there.
    only_shown : mapping of str to str
        Of features of which training pictures showed one value, that value.

    Source: Riley and Sridharan (2019), section 3.
    """

    domain: Domain
    reasoned: ReasonedAnswers
    tree: DecisionTree
    answerer: RecurrentAnswerer | None
    experience: Experience
    gate: float = 0.0
    known_share: float = 1.0
    least_likeness: float = 0.0
    trust: float = 0.0
    only_shown: Mapping[str, str] = field(default_factory=dict)

    def answer(
        self,
        scene: Classification,
        question: Question,
        *,
        previous: Reply | None = None,
        look: Look | None = None,
    ) -> Reply:
        """Answer an understood question about a classified scene.

        Raises
        ------
        QuestionError
            If it asks where something is seen or what looks alike, and there is no ``look``.
        """
        reply = self._reply(scene, question, previous, look)
        return with_only_shown(self.domain, reply, self.only_shown)

    def _reply(
        self, scene: Classification, question: Question, previous: Reply | None, look: Look | None
    ) -> Reply:
        if question.asks is Asks.EXPLAIN:
            return self._explain(scene, question, previous)
        if not question.is_of_templates:
            return self._told(scene, question, previous, look)
        spoken_of = self._spoken_of(scene, question)
        kind, justification = self._answer(spoken_of, question)
        learned = self._beside_knowledge(spoken_of, question, kind)
        if learned:
            children = justification.children
            # Why the tree was asked stays the last.
            end = len(children) - (justification.basis is Basis.TREE)
            children = (*children[:end], *learned, *children[end:])
            justification = replace(justification, children=children)
        justification = spoken_of.read_in(justification)
        supposed = None if spoken_of is scene else spoken_of
        ground = least_sure(kind, spoken_of, justification, supposed=supposed is not None)
        text = word_answer(
            self.domain,
            question,
            kind,
            vector=spoken_of.vector,
            label=spoken_of.label,
            probably=certainty_of(ground).adverb,
        )
        usual = say_usual(kind, justification)
        text = " ".join(filter(None, [text, usual, *(sentence(node.text) for node in learned)]))
        if supposed is not None:
            text = word_supposed(
                self.domain, question, text, label=scene.label or "", supposed=supposed.label or ""
            )
        return Reply(question, text, spoken_of.method, justification, kind, scene, supposed, ground)

    def _beside_knowledge(
        self, scene: Classification, question: Question, kind: AnswerType
    ) -> tuple[Node, ...]:
        """What pictures and the tree say of a class, where nothing that is known concludes it."""
        nothing = kind.form in _NOTHING_KNOWN or (kind.form == "against" and not kind.mentions)
        if not nothing or question.label is None:
            return ()
        found = [tree_says(self.domain, self.tree, scene.vector, question.label)]
        if kind.form == "no_difference":
            pictures = shared_by_pictures(
                self.domain, self.experience, scene.vector, question.label
            )
            found.insert(0, pictures)
        return tuple(node for node in found if node is not None)

    def answer_all(self, asked: Sequence[tuple[Classification, Question]]) -> list[Reply]:
        """Answer many questions about classified scenes; the recurrent network runs once for all.

        The replies are those of :meth:`answer`, one by one.
        """
        from seewhy.dialogue.learned import learned_answers

        if self.answerer is not None:
            spoken_of = [(self._spoken_of(scene, question), question) for scene, question in asked]
            learned = [
                (question, scene.vector, scene.label, ())
                for scene, question in spoken_of
                if scene.label is not None and self._is_learned(scene, question)
            ]
            learned_answers(self.domain, self.answerer, learned)  # remembers them
        return [self.answer(scene, question) for scene, question in asked]

    def _told(
        self, scene: Classification, question: Question, previous: Reply | None, look: Look | None
    ) -> Reply:
        """Answer what domains have no templates for."""
        why = scene.read_in(self._why(scene))
        told = self._told_of(scene, question, why, previous, look)
        justification = scene.read_in(told.justification)
        return Reply(
            question,
            " ".join(filter(None, [told.text, say_usual(told.kind, justification)])),
            scene.method,
            justification,
            told.kind,
            scene,
            None,
            told.least_sure,
        )

    def _told_of(
        self,
        scene: Classification,
        question: Question,
        why: Node,
        previous: Reply | None,
        look: Look | None,
    ) -> Told:
        if scene.verdict == UNKNOWN and question.asks not in _OF_UNKNOWN_PICTURES:
            kind = AnswerType("unknown")
            words = word_answer(self.domain, question, kind, vector=scene.vector, label=None)
            return Told(kind, words, why)
        weighing = Weighing(self.domain, self.reasoned, self.tree, self._tree_why)
        if question.asks in OF_REASONS:
            return tell_of_reasons(
                self.reasoned, self.tree, weighing.decided, scene, question,
                why=why, previous=previous,
            )  # fmt: skip
        if question.asks in _WEIGHED:
            return weighing.weigh(scene, question, why=why, previous=previous)
        return tell(self.domain, self.reasoned, scene, question, why=why, look=look)

    def _why(self, scene: Classification) -> Node:
        """Why a scene is of its class, or of none."""
        if scene.verdict == UNKNOWN:
            return self._unknown(scene)
        if scene.label is None:
            return self.reasoned.undecided(scene.vector)
        if scene.method == "knowledge":
            return self.reasoned.why_class(scene.vector, scene.label)
        return self._tree_node(scene, scene.label, self.tree.path(scene.vector))

    def _tree_why(self, vector: FeatureVector, label: str) -> Node:
        """Why the tree takes a scene of some features for one of a class."""
        supposed = Classification(label, "tree", vector, {}, "")
        return self._tree_node(supposed, label, self.tree.path(vector))

    def _spoken_of(self, scene: Classification, question: Question) -> Classification:
        """What the answer to a question speaks of, which the question may presume."""
        found = believed(scene, question, trust=self.trust)
        # Of what the tree gave, nothing can be answered where no answers were learned.
        return scene if found.method == "tree" and self.answerer is None else found

    def _is_learned(self, scene: Classification, question: Question) -> bool:
        """Whether the recurrent network is asked."""
        return (
            scene.method == "tree"
            and self.answerer is not None
            and question.asks not in (Asks.BELIEF_VALUE, Asks.EXPLAIN)
        )

    def _answer(self, scene: Classification, question: Question) -> tuple[AnswerType, Node]:
        if scene.verdict == UNKNOWN:
            return AnswerType("unknown"), self._unknown(scene)
        if scene.method == "knowledge" and scene.label is not None:
            reasoned = self.reasoned.answer(question, scene.vector, scene.label)
            return reasoned.kind, reasoned.justification
        if question.asks is Asks.BELIEF_VALUE and scene.label is not None:
            # What follows from the class need not be learned, whoever gave the class.
            basis = self._tree_node(scene, scene.label, self.tree.path(scene.vector))
            reasoned = self.reasoned.belief(question, scene.vector, scene.label, basis=basis)
            return reasoned.kind, reasoned.justification
        if scene.label is None or self.answerer is None:
            if question.feature is not None:
                reasoned = self.reasoned.feature(question, scene.vector)
                return reasoned.kind, reasoned.justification
            return self.reasoned.undecided_kind(scene.vector), self.reasoned.undecided(scene.vector)
        return self._learned(scene, question, scene.label)

    def _learned(
        self, scene: Classification, question: Question, label: str
    ) -> tuple[AnswerType, Node]:
        from seewhy.dialogue.learned import learned_answers

        assert self.answerer is not None
        path = self.tree.path(scene.vector)
        tested = [condition.feature for condition in path.conditions]
        ((kind, probability),) = learned_answers(
            self.domain, self.answerer, [(question, scene.vector, label, tested)]
        )
        learned = Node(
            literal=kind.identifier,
            text="the answer was chosen by the recurrent network "
            f"(p = {probability:.2f} among the answers that fit)",
            basis=Basis.RECURRENT,
        )
        return kind, self._tree_node(scene, label, path, learned)

    def _tree_node(
        self,
        scene: Classification,
        label: str,
        path: TreePath,
        *learned: Node,
    ) -> Node:
        """The justification of a class that the tree gave and of an answer that was learned."""
        seen = tuple(self.reasoned.seen(scene.vector, c.feature) for c in path.conditions)
        literal = self.domain.classes[label].literal
        outweighs = scene.label == label != path.label and scene.class_seen is not None
        return Node(
            literal=str(literal),
            text=say_literal(self.domain, literal),
            basis=Basis.TREE,
            children=(
                Node(str(literal), say_path(self.domain, path), Basis.PATH, children=seen),
                *([self._witness(scene)] if outweighs else []),
                *learned,
                self._not_asked(scene)
                if scene.verdict == UNCERTAIN
                else self.reasoned.undecided(scene.vector),
            ),
        )

    def _witness(self, scene: Classification) -> Node:
        """That the class, seen by itself, outweighs what the tree makes of the features."""
        assert scene.class_seen is not None
        label, probability = scene.class_seen
        return Node(
            literal=CLASS,
            text=f"the class seen by itself, {self.domain.classes[label].say} (p = "
            f"{probability:.2f}), outweighs the tree",
            basis=Basis.CLASS_SEEN,
        )

    def _not_asked(self, scene: Classification) -> Node:
        """Why the knowledge is not asked about a scene whose reading is below the gate."""
        return Node(
            literal="undecided",
            text=f"the knowledge is not asked: {self.say_uncertain(scene)}",
            basis=Basis.ABSENCE,
            holds=False,
        )

    def say_uncertain(self, scene: Classification) -> str:
        """Say of which feature a network is too little sure for the gate."""
        least = scene.least_certain
        return (
            f"the {self.domain.features[least].name} is seen with a probability of "
            f"{scene.features[least].certainty:.2f} only, and {self.gate:.2f} is demanded"
        )

    def _unknown(self, scene: Classification) -> Node:
        """Why a picture is not known."""
        score, least = scene.score or 0.0, self.least_likeness
        return Node(
            literal="unknown",
            text=f"what is seen is like nothing that is known: its likeness to pictures of "
            f"training is {score:.3f}, and {self.known_share:.1%} of the pictures like those of "
            f"training have at least {least:.3f}",
            basis=Basis.ABSENCE,
            holds=False,
            children=tuple(self.reasoned.seen(scene.vector, key) for key in scene.features),
        )

    def _explain(self, scene: Classification, question: Question, previous: Reply | None) -> Reply:
        if previous is None:
            asks = Question(asks=Asks.CLASS, text="", words=())
            previous = self._reply(scene, asks, None, None)
        text = narrate(self.domain, previous)
        return Reply(
            question,
            text,
            previous.method,
            previous.justification,
            AnswerType("explain", previous.kind.mentions, previous.kind.changes),
            previous.classification,
            previous.supposed,
            least_sure_told(previous.least_sure, previous.scene, previous.justification),
        )


def believed(scene: Classification, question: Question, *, trust: float) -> Classification:
    """What a scene is supposed to be when a question is asked of it.

    A question may presume what the scene is not taken to be: "why is it unstable?" of a structure
    that is taken for stable. Where it may be so as well, the asker is believed; who presumes that
    it is *not* of a class is, where that is at least as probable as that the asker is wrong.

    Departure from the paper, whose questions presume nothing that is not so.
    """
    asks = question.asks
    if scene.label is None or question.label is None:
        return scene
    if asks is Asks.WHY_CLASS and scene.label != question.label:
        fitting = [
            alternative for alternative in scene.otherwise if alternative.label == question.label
        ]
    elif asks in _PRESUMES_ANOTHER and scene.label == question.label:
        fitting = [
            alternative for alternative in scene.otherwise if alternative.label != question.label
        ]
        if sum(alternative.probability or 0.0 for alternative in fitting) < 1.0 - trust:
            return scene
    else:
        return scene
    return fitting[0] if fitting else scene


_NOTHING_KNOWN = {"no_change", "no_difference"}
_OF_UNKNOWN_PICTURES = {Asks.SIMILAR, Asks.HOW_SURE}
_WEIGHED = {
    Asks.WHAT_IF, Asks.CONTRAST, Asks.WHICH_RULE, Asks.HOW_SURE, Asks.WHAT_TO_CHECK,
}  # fmt: skip
_PRESUMES_ANOTHER = {Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS, Asks.DIFFERENCE_TO_CLASS}
