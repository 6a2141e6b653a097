"""A conversation about the things in one picture, in which the rules about them are revised."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.domain.wording import sentence
from seewhy.errors import RevisionError
from seewhy.knowledge.reasoner import Verdict
from seewhy.revision.proposal import Doubted, Proposal
from seewhy.revision.remarks import Remark, Says, plain_remark
from seewhy.revision.revisions import Revisions
from seewhy.revision.said import Said
from seewhy.revision.telling import say_offer, say_proposal
from seewhy.revision.things.doubted_scene import doubted_scene, scenes_with_things
from seewhy.revision.things.narrowed_rules import thing_rule_revisions
from seewhy.revision.things.new_rule import new_thing_rule
from seewhy.revision.things.reasons import (
    class_named,
    example_of_a_reason,
    gives_reason,
    rule_of_reason,
)

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_reply import PictureReply, ReadScene

__all__ = ["ThingConversation"]


class ThingConversation:
    """Questions and remarks about the things in one picture, one after another.

    What was misread is not kept here: a label has a box, which is drawn in the studio.

    Parameters
    ----------
    agent : ThingAgent
    revisions : Revisions
        Of the agent's model; its dataset is whose pictures a revision would change.
    look : callable
        Returns what an agent makes of the picture.
    """

    def __init__(
        self,
        agent: ThingAgent,
        revisions: Revisions,
        *,
        look: Callable[[ThingAgent], ReadScene],
    ) -> None:
        self.agent = agent
        self.revisions = revisions
        self._look = look
        self.scene = look(agent)
        self.previous: PictureReply | None = None
        self.proposals: tuple[Proposal, ...] = ()

    def say(self, text: str) -> PictureReply | Said:
        """Answer a question, or say what follows from a remark.

        Raises
        ------
        QuestionError
            If it is neither, or a part of it is not understood.
        SeeWhyError
            If a revision cannot be taken or taken back.
        """
        remark = plain_remark(text, proposed=len(self.proposals))
        if remark is not None:
            return self._remarked(remark)
        if gives_reason(text):
            rule = rule_of_reason(self.agent.domain, text)
            return self._offered((new_thing_rule(self._doubted(rule.label), rule),))
        domain = self.agent.domain
        said_no = text.strip().casefold().startswith("no") and not text.rstrip().endswith("?")
        wanted = class_named(domain, text) if said_no else None
        if wanted is not None:
            if wanted == self.scene.reading.label:
                return Said(
                    sentence(f"I take {domain.subject} to be {domain.classes[wanted].say}, too")
                )
            return self._offered(self._rule_revisions(wanted))
        self.previous = self.agent.answer(text, self.scene, previous=self.previous)
        return self.previous

    def _remarked(self, remark: Remark) -> Said:
        if remark.says is Says.TAKE_BACK:
            return self._take_back(remark.number)
        if remark.says is Says.REFUSE:
            self.proposals = ()
            return Said("Nothing is changed.")
        if remark.says is Says.MISSING:
            return Said(f"Say what is missing: {self._example()}.")
        if remark.says in (Says.AGREE, Says.CHOOSE):
            if remark.number is None and len(self.proposals) > 1:
                which = f"Which one? Say 1 to {len(self.proposals)}, or no."
                return Said(which, proposals=self.proposals)
            place = 0 if remark.number is None else remark.number
            return self._take(self.proposals[place - 1 if place > 0 else place])
        return self._offered(self._rule_revisions(None))

    # Proposing --------------------------------------------------------------------------------

    def _rule_revisions(self, wanted: str | None) -> tuple[Proposal, ...]:
        reasons = None if self.previous is None else self.previous.reply.justification
        return thing_rule_revisions(self._doubted(wanted), reasons)

    def _doubted(self, wanted: str | None) -> Doubted:
        folder = self.revisions.dataset
        scenes = AnnotatedScenes((), (), ())
        if folder is not None:
            scenes = scenes_with_things(Dataset.load(folder, self.agent.domain))
        return doubted_scene(
            self.agent.domain,
            self.revisions.texts,
            self.scene.reading.vector,
            scenes,
            wanted=wanted,
        )

    def _offered(self, found: tuple[Proposal, ...]) -> Said:
        """Say proposals and ask which one to take; or say that there is none."""
        self.proposals = found
        misread = "What was misread is corrected in the studio (seewhy studio)."
        if not found:
            nothing = "I find no exception and no condition that mends it."
            return Said(f"{nothing} Say what is missing: {self._example()}. {misread}")
        told = [say_proposal(self.agent.domain, proposal) for proposal in found]
        return Said(say_offer(told), found)

    def _example(self) -> str:
        label = self.scene.reading.label
        other = next((key for key in self.agent.domain.classes if key != label), None)
        return f'"{example_of_a_reason(self.agent.domain, other)}"'

    # Taking -----------------------------------------------------------------------------------

    def _take(self, proposal: Proposal) -> Said:
        revision = self.revisions.take(proposal)
        self.proposals = ()
        self._know()
        taken = f'Taken as revision {revision.number}; "undo that" takes it back.'
        return Said(f"{taken}\n{self._concluded()}", revision=revision)

    def _take_back(self, number: int | None) -> Said:
        self.proposals = ()
        if number is None:
            active = [each.number for each in self.revisions.all if each.taken_back is None]
            if not active:
                return Said("There is nothing to take back.")
            number = active[-1]
        revision = self.revisions.take_back(number)
        self._know()
        back = f'Taken back: revision {number}, "{revision.taken.sentence}".'
        return Said(f"{back}\n{self._concluded()}", revision=revision)

    def _know(self) -> None:
        """Know what the files say by now, and look again."""
        domain = load_domain(self.revisions.domain_folder)
        if self.agent.domain.schema != domain.schema:
            raise RevisionError(
                f"{self.revisions.domain_folder}: things have other features than the model sees; "
                "train it again"
            )
        self.agent = self.agent.knowing(domain)
        self.scene = self._look(self.agent)
        self.previous = None

    def _concluded(self) -> str:
        """Of which class the picture is by the rules."""
        domain = self.agent.domain
        if not domain.classes:
            return "The next answer follows it."
        decision = self.agent.reasoner.decide(self.scene.reading.vector)
        if decision.label is not None:
            said = domain.classes[decision.label].say
            return sentence(f"by the rules, {domain.subject} is {said}")
        if decision.verdict is Verdict.SILENT:
            return sentence(f"no rule says of which class {domain.subject} is")
        return sentence(f"the rules do not agree on what {domain.subject} is")
