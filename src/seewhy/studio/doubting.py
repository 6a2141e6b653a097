"""An answer is doubted: what may be wrong, what each remedy would change, and a remedy taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from seewhy.errors import QuestionError, RevisionError, SeeWhyError
from seewhy.revision.correction import cells_of
from seewhy.revision.misreading import misreadings
from seewhy.revision.new_rule import known_already, new_rule, reason_given
from seewhy.revision.proposal import Doubted, Proposal
from seewhy.revision.rule_revision import rule_revisions
from seewhy.revision.telling import say_consequences, say_decision
from seewhy.studio.answering_agent import CORRECTED
from seewhy.studio.labelled_scenes import labelled_scenes
from seewhy.studio.labelling import choose
from seewhy.studio.project_model import ProjectModel
from seewhy.studio.talk import Talk

if TYPE_CHECKING:
    from seewhy.studio.project import Project
    from seewhy.studio.record import Entry

__all__ = [
    "for_a_reason",
    "for_the_rules",
    "misread",
    "said_of",
    "take",
]

_READINGS = 4
_OF_EACH_KIND = 2


def misread(
    model: ProjectModel, talk: Talk, about: Sequence[tuple[str, str | None]] = ()
) -> dict[str, Proposal]:
    """What the picture may show instead of what was read, by the keys to take it with.

    Where no rule makes anything of another reading, what the least sure feature may be is offered.
    """
    with model.at_work():
        scene = model.look(talk.picture)
        certainty = {key: reading.certainty for key, reading in scene.features.items()}
        doubted = _doubted(model, talk)
        found = misreadings(doubted, certainty=certainty, about=about, most=_READINGS)
        if not found and not about:
            least_sure = min(certainty, key=lambda key: certainty[key])
            about = ((least_sure, None),)
            found = misreadings(doubted, certainty=certainty, about=about, most=_READINGS)
    return talk.propose(found)


def for_the_rules(model: ProjectModel, talk: Talk) -> dict[str, Proposal]:
    """Exceptions to the rules behind the picture's class, and rules that ask more."""
    with model.at_work():
        return talk.propose(rule_revisions(_doubted(model, talk), most=_OF_EACH_KIND))


def for_a_reason(model: ProjectModel, talk: Talk, reason: str) -> dict[str, Proposal]:
    """The rules that a reason in words states.

    Raises
    ------
    QuestionError
        If the reason is not understood.
    RevisionError
        If the rule is known already, or can never be used.
    """
    if " because " not in reason:
        raise QuestionError(
            f"'{reason.strip()}' gives no reason; say for instance 'it is CLASS because it ...'"
        )
    with model.at_work() as agent:
        stated = reason_given(agent.questions, reason)
        known = known_already(agent.known, stated)
        if known is not None:
            raise RevisionError(f'the rule is known already: "{known.text}"; say another reason')
        talk.wanted = stated.label
        return talk.propose(new_rule(_doubted(model, talk), stated))


def said_of(model: ProjectModel, proposal: Proposal) -> str:
    """What would become of the picture and of others, in words."""
    with model.at_work() as agent:
        parts = [say_decision(agent.domain, proposal.decision)]
        if proposal.reading is None:
            parts.append(say_consequences(proposal.consequences))
    return " ".join(f"{part[:1].upper()}{part[1:]}." for part in parts)


def take(project: Project, proposal: Proposal, *, picture: str, who: str) -> Entry:
    """Take a proposal: one more label, or one more revision of the knowledge.

    Raises
    ------
    SeeWhyError
        If a label is taken without a picture.
    RevisionError, DomainError, KnowledgeError
        If the knowledge has changed since this was proposed.
    """
    if proposal.reading is None:
        why = f"{proposal.cause.value}: {proposal.sentence}"
        return project.revise(proposal.edits, why=why, who=who)
    if not picture:
        raise SeeWhyError("no picture is spoken of; choose one on the page Ask")
    return choose(project, {picture: dict(cells_of(proposal))}, who=who, how=CORRECTED)


def _doubted(model: ProjectModel, talk: Talk) -> Doubted:
    with model.at_work() as agent:
        return Doubted(
            agent.known,
            model.texts(),
            model.look(talk.picture).vector,
            labelled_scenes(model.project),
            talk.wanted,
        )
