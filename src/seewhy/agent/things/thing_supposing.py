"""What if: an answer about a picture, and what follows, if its things were otherwise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seewhy.agent.things.thing_reply import PictureReply, ReadScene
from seewhy.dialogue.scene_beliefs import SceneBeliefs
from seewhy.dialogue.scene_conclusions import SceneConclusions
from seewhy.dialogue.things.edits import Add, Edit, edited
from seewhy.dialogue.things.evaluating import Evaluation
from seewhy.dialogue.things.said_once import said_once
from seewhy.dialogue.things.saying_edits import say_edit
from seewhy.dialogue.things.wording import ThingWords
from seewhy.knowledge.reasoner import Verdict

if TYPE_CHECKING:
    from seewhy.data.thing_scene import ThingScene
    from seewhy.dialogue.things.answering import ThingAnswerer

__all__ = ["SupposedThings", "say_edits", "suppose_things"]


@dataclass(frozen=True)
class SupposedThings:
    """What would be if the things in a picture were otherwise.

    Attributes
    ----------
    reply : PictureReply
        The question of the last answer, answered anew, with its reasons.
    scene : ThingScene
        The things as they would be, also those that would not be there.
    words : ThingWords
        How they would be called.
    without : int
        The set of those that would not be there.
    label, was : str or None
        The class that the rules conclude then, and as it was read; None where they do not.
    begins, ends : tuple of str
        What else follows then that did not before, and what does not any more, as clauses.
    contradicts : bool
        Whether there can be no such things, by the rules.
    """

    reply: PictureReply
    scene: ThingScene
    words: ThingWords
    without: int
    label: str | None
    was: str | None
    begins: tuple[str, ...]
    ends: tuple[str, ...]
    contradicts: bool

    def is_gone(self, number: int) -> bool:
        """Whether a thing would not be there."""
        return bool(self.without >> number & 1)

    def is_changed(self, number: int) -> bool:
        """Whether a thing would look otherwise than it was read; a new one does not."""
        seen = self.reply.read.scene
        return number < seen.count and any(
            column[number] != seen.values[key][number] for key, column in self.scene.values.items()
        )


def suppose_things(
    answerer: ThingAnswerer, reply: PictureReply, edits: Sequence[Edit]
) -> SupposedThings:
    """Return what would be; nothing is looked at anew.

    Parameters
    ----------
    answerer : ThingAnswerer
    reply : PictureReply
        Whose question is asked again.
    edits : sequence of Edit
        What is otherwise than it was read.
    """
    read = reply.read
    supposed = answerer.suppose(reply.reply, read.scene, edits)
    words, evaluation = supposed.words, supposed.words.evaluation
    scene, without = evaluation.scene, evaluation.without
    called = [read.words.name(number) for number in range(len(read.names))]
    before = SceneBeliefs(read.domain, read.reading.vector, called, reasoner=read.reasoner)
    then = before
    if isinstance(scene.conclusions, SceneConclusions) and edits:
        # Those of a domain in which things lose what they need, where that is taken away.
        conclusions = scene.conclusions
        vector = conclusions.vector(scene, without)
        names = [words.name(number) for number in range(scene.count)]
        then = SceneBeliefs(conclusions.domain, vector, names, reasoner=conclusions.reasoner)
    was, now = _concluded(before), _concluded(then)
    return SupposedThings(
        PictureReply(supposed, read, 1.0, None),
        scene,
        words,
        without,
        then.decision.label,
        before.decision.label,
        begins=tuple(now[key] for key in said_once(key for key in now if key not in was)),
        ends=tuple(was[key] for key in said_once(key for key in was if key not in now)),
        contradicts=then.decision.verdict in (Verdict.CONTRADICTION, Verdict.NO_ANSWER_SET),
    )


def _concluded(beliefs: SceneBeliefs) -> Mapping[str, str]:
    """What is concluded, in the knowledge language → as a clause."""
    return {str(literal): beliefs.say(literal) for literal in beliefs.concluded}


def say_edits(read: ReadScene, edits: Sequence[Edit]) -> list[str]:
    """Return changes as clauses behind "if", things being called as they were before."""
    scene, words = read.scene, read.words
    said = []
    for edit in edits:
        said.append(say_edit(edit, words))
        if isinstance(edit, Add):  # what comes behind it may speak of the new thing
            scene, _ = edited(scene, read.things, (edit,))
            words = ThingWords(Evaluation(scene, read.things))
    return said
