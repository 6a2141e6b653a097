"""A conversation about one picture, in which answers are doubted and the knowledge is revised."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.reply import Classification, Reply
from seewhy.domain.wording import join_clauses, sentence
from seewhy.errors import RevisionError
from seewhy.induction.candidate import Candidate
from seewhy.induction.sentence import say_rule
from seewhy.knowledge.reasoner import Verdict
from seewhy.revision.consequences import annotated_scenes
from seewhy.revision.correction import Keeping, corrected, keeping
from seewhy.revision.misreading import misreadings
from seewhy.revision.new_rule import known_already, new_rule, rules_by_example
from seewhy.revision.proposal import Cause, Doubted, Proposal
from seewhy.revision.remarks import Remark, Says, remark_of
from seewhy.revision.revisions import Revisions
from seewhy.revision.rule_revision import rule_revisions
from seewhy.revision.said import Said
from seewhy.revision.telling import say_offer, say_proposal

__all__ = ["Conversation", "Said"]


class Conversation:
    """Questions and remarks about one picture, one after another.

    Parameters
    ----------
    agent : Agent
    revisions : Revisions
        Of the agent's model; its dataset is where labels are written to.
    look : callable
        Returns what the agent makes of the picture by now.
    picture : Path, optional
        The picture's file, for questions about where something is, and for labels.

    Examples
    --------
    >>> import shutil, tempfile
    >>> from seewhy.domain.domain import load_domain
    >>> folder = Path(tempfile.mkdtemp()) / "structures"
    >>> _ = shutil.copytree(load_domain("structure_stability").folder, folder)
    >>> agent = Agent(load_domain(folder))
    >>> seen = {"num_blocks": "4", "base": "wide", "lean": "yes", "block_displaced": "no"}
    >>> talk = Conversation(
    ...     agent, Revisions(folder, agent=agent), look=lambda: agent.classify_values(seen)
    ... )
    >>> print(talk.say("it is unstable because it leans and has four blocks").text.split(". ")[0])
    A new rule: "if the structure has four blocks and it leans to one side, then it is unstable"
    >>> talk.say("yes").text.splitlines()[0]
    'Taken as revision 1; "undo that" takes it back.'
    """

    def __init__(
        self,
        agent: Agent,
        revisions: Revisions,
        *,
        look: Callable[[], Classification],
        picture: Path | None = None,
    ) -> None:
        self.agent = agent
        self.revisions = revisions
        self.picture = picture
        self._look = look
        self._corrections: dict[str, str] = {}
        self._done: list[_Done] = []
        self.previous: Reply | None = None
        self.proposals: tuple[Proposal, ...] = ()
        self.scene = look()

    def say(self, text: str) -> Reply | Said:
        """Answer a question, or say what follows from a remark.

        Raises
        ------
        QuestionError
            If it is neither, or a part of it is not understood.
        SeeWhyError
            If a revision cannot be taken or taken back.
        """
        remark = remark_of(self.agent.questions, text, proposed=len(self.proposals))
        if remark is None:
            return self._answer(text)
        if remark.says is Says.TAKE_BACK:
            return self._take_back(remark.number)
        if remark.says is Says.REFUSE:
            self.proposals = ()
            return Said("Nothing is changed.")
        if remark.says in (Says.AGREE, Says.CHOOSE):
            return self._agreed(remark)
        return self._propose(remark)

    def _answer(self, text: str) -> Reply:
        asked = self.previous.question if self.previous is not None else None
        understood = self.agent.questions.understand(text, previous=asked)
        reply = self.agent.answer(
            self.scene, understood, previous=self.previous, image=self.picture
        )
        if reply.kind.form != "explain":
            self.previous = reply
        return reply

    # Proposing --------------------------------------------------------------------------------

    def _propose(self, remark: Remark) -> Said:
        label = next((said.label for said in remark.statements if said.label), None)
        about = [(said.feature, said.value) for said in remark.statements if said.feature]
        if remark.says is Says.WRONG:
            about += self._just_told()
        agreed = self._agreeing(label, about)
        if agreed is not None:
            return Said(agreed)
        doubted = self._doubted(label)
        if remark.says is Says.BECAUSE and remark.reason is not None:
            return self._because(doubted, remark.reason)
        if remark.says is Says.MISSING:
            return Said(f"Say what is missing: {self._example()}.")
        found: list[Proposal] = []
        if remark.says is not Says.RULE_WRONG:
            found += misreadings(doubted, certainty=self._certainty, about=about)
        if not about:
            found += rule_revisions(doubted, most=2 if remark.says is Says.RULE_WRONG else 1)
            found += self._by_example(doubted)
        return self._proposed(found, self._nothing_to_propose(remark))

    def _just_told(self) -> list[tuple[str, str | None]]:
        """The feature that the last answer was about, if it was about one."""
        asked = None if self.previous is None else self.previous.question
        if (
            asked is None
            or asked.feature is None
            or asked.feature not in self.agent.domain.features
        ):
            return []
        return [(asked.feature, None)]

    def _agreeing(self, label: str | None, about: Sequence[tuple[str, str | None]]) -> str | None:
        """That what somebody says is what was seen already; None where it is not."""
        domain, seen = self.agent.domain, self.agent.domain.named(self.scene.vector)
        if label is not None and label == self.scene.label:
            return sentence(f"I take {domain.subject} to be {domain.classes[label].say}, too")
        told = [(key, value) for key, value in about if value is not None]
        if told and all(seen[key] == value for key, value in told):
            clauses = [domain.features[key].say[value] for key, value in told]
            return sentence(f"I see that, too: {join_clauses(clauses, subject=domain.subject)}")
        return None

    def _doubted(self, wanted: str | None) -> Doubted:
        known = self.agent.known
        return Doubted(
            known,
            self.revisions.texts,
            self.scene.vector,
            annotated_scenes(self._dataset(), known.experience),
            wanted,
        )

    def _dataset(self) -> Dataset | None:
        folder = self.revisions.dataset
        return None if folder is None else Dataset.load(folder, self.agent.domain)

    @property
    def _certainty(self) -> Mapping[str, float]:
        return {key: reading.certainty for key, reading in self.scene.features.items()}

    def _by_example(self, doubted: Doubted) -> tuple[Proposal, ...]:
        """A rule that annotated scenes of the wanted class share with this one."""
        if doubted.wanted is None or doubted.decision.label is not None:
            return ()
        known, scenes = doubted.known, doubted.scenes
        if doubted.wanted not in scenes.labels:
            return ()
        more = replace(
            scenes,
            vectors=(*scenes.vectors, doubted.vector),
            labels=(*scenes.labels, doubted.wanted),
            pictures=(*scenes.pictures, ""),
        )
        examples = [
            place
            for place, label in enumerate(more.labels)
            if label == doubted.wanted and more.vectors[place] == doubted.vector
        ]
        found = rules_by_example(known.domain, more, examples, doubted.wanted, most=1)
        try:
            return new_rule(doubted, found[0]) if found else ()
        except RevisionError:
            return ()

    def _because(self, doubted: Doubted, reason: Candidate) -> Said:
        """What follows from a reason: a rule, or that a feature was misread."""
        domain = self.agent.domain
        seen = domain.named(self.scene.vector)
        unseen = [
            (condition.feature, condition.values[0])
            for condition in reason.conditions
            if seen[condition.feature] not in condition.values
        ]
        known = known_already(self.agent.known, reason)
        doubted = replace(doubted, wanted=reason.label)
        found: list[Proposal] = []
        said = []
        if known is not None:
            said.append(f'The rule is known already: "{known.text.removesuffix(".")}".')
        else:
            found += new_rule(doubted, reason)
        if unseen:
            rule = say_rule(domain, reason.conditions, reason.label)
            clauses = [domain.features[key].say[seen[key] or ""] for key, _ in unseen if seen[key]]
            if clauses:
                said.append(sentence(f"I see that {join_clauses(clauses, subject=domain.subject)}"))
            said.append(f'So "{rule}" does not apply here, unless I misread that.')
            found += misreadings(doubted, certainty=self._certainty, about=unseen)
        return self._proposed(found, "Nothing is changed.", *said)

    def _proposed(self, found: Sequence[Proposal], nothing: str, *said: str) -> Said:
        """Say proposals and ask which one to take; or say that there is none."""
        self.proposals = tuple(found)
        if not found:
            return Said(" ".join((*said, nothing)))
        told = [self._told(proposal) for proposal in found]
        return Said(say_offer(told, *said), self.proposals)

    def _told(self, proposal: Proposal) -> str:
        said = say_proposal(self.agent.domain, proposal)
        if proposal.reading is None:
            return said
        scene = corrected(self.agent, self.scene, dict([proposal.reading]))
        return f"{said} {self._concluded(scene, then=True)} {self._keeping(proposal).sentence}"

    def _keeping(self, proposal: Proposal) -> Keeping:
        return keeping(proposal, self.agent.domain, self.revisions.dataset, self.picture)

    def _nothing_to_propose(self, remark: Remark) -> str:
        domain, scene = self.agent.domain, self.scene
        if remark.says is Says.RULE_WRONG and scene.method != "knowledge":
            begun = (
                f"No rule says of which class {domain.subject} is"
                f"{': the decision tree does' if scene.method == 'tree' else ''}"
            )
        else:
            begun = "I find no single change that mends it"
        return f"{begun}. Say what is missing: {self._example()}."

    def _example(self) -> str:
        domain = self.agent.domain
        other = next(
            (key for key in domain.classes if key != self.scene.label), next(iter(domain.classes))
        )
        feature = next(iter(domain.features.values()))
        clause = next(iter(feature.say.values())).replace("{it}", "it")
        return f'"it is {domain.classes[other].say} because {clause}"'

    # Taking -----------------------------------------------------------------------------------

    def _agreed(self, remark: Remark) -> Said:
        if remark.number is None and len(self.proposals) > 1:
            return Said(
                f"Which one? Say 1 to {len(self.proposals)}, or no.", proposals=self.proposals
            )
        place = 0 if remark.number is None else remark.number
        proposal = self.proposals[place - 1 if place > 0 else place]
        return self._take(proposal)

    def _take(self, proposal: Proposal) -> Said:
        revision = None
        written = proposal.reading is None or self._keeping(proposal).written
        if written:
            revision = self.revisions.take(proposal, picture=self.picture)
        self.proposals = ()
        feature, value = proposal.reading or ("", "")
        number = None if revision is None else revision.number
        self._done.append(_Done(number, feature, self._corrections.get(feature)))
        if feature:
            self._corrections[feature] = value
        begun = (
            "For this conversation, I take it so"
            if revision is None
            else f"Taken as revision {revision.number}"
        )
        self._see()
        lines = [f'{begun}; "undo that" takes it back.', self._concluded(self.scene)]
        if revision is not None and proposal.cause is Cause.MISREAD:
            lines.append("The networks learn it when they are trained again (seewhy train).")
        return Said("\n".join(lines), revision=revision)

    def _take_back(self, number: int | None) -> Said:
        self.proposals = ()
        done = next(
            (done for done in reversed(self._done) if number in (None, done.revision)), None
        )
        last = number if done is None else done.revision
        revision = None
        if last is None and done is None:
            active = [each.number for each in self.revisions.all if each.taken_back is None]
            if not active:
                return Said("There is nothing to take back.")
            last = active[-1]
        if last is not None:
            revision = self.revisions.take_back(last)
        if done is not None:
            self._done.remove(done)
            self._corrections.pop(done.feature, None)
            if done.before is not None:
                self._corrections[done.feature] = done.before
        self._see()
        said = "Taken back."
        if revision is not None:
            said = f'Taken back: revision {last}, "{revision.taken.sentence}".'
        return Said(f"{said}\n{self._concluded(self.scene)}", revision=revision)

    # Seeing -----------------------------------------------------------------------------------

    def _see(self) -> None:
        """Look at the picture again, with what is known and was corrected by now."""
        scene = self._look()
        self.scene = corrected(self.agent, scene, self._corrections)

    def _concluded(self, scene: Classification, *, then: bool = False) -> str:
        """Of which class a scene is, and why."""
        domain = self.agent.domain
        begun = "Then " if then else ""
        if scene.label is None:
            said = f"{begun}I cannot tell of which class {domain.subject} is"
            return sentence(said)
        said = f"{begun}{domain.subject} is {domain.classes[scene.label].say}"
        if scene.method == "tree":
            contradict = scene.verdict == Verdict.CONTRADICTION.value
            rules = "the rules contradict each other" if contradict else "no rule says so"
            return sentence(f"{said}: {rules}, the decision tree says it")
        why = Question(Asks.WHY_CLASS, "", (), label=scene.label)
        return f"{sentence(said)} {self.agent.answer(scene, why).text}"


@dataclass(frozen=True)
class _Done:
    """What was taken in a conversation: a revision, the correction of a feature, or both."""

    revision: int | None
    feature: str
    before: str | None
