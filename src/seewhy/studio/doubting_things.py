"""An answer about things is doubted: which rule may be wrong, or missing, and what that changes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from seewhy.revision.edit import KNOWLEDGE, LEARNED
from seewhy.revision.proposal import Doubted, Proposal
from seewhy.revision.telling import say_consequences, say_decision
from seewhy.revision.things.doubted_scene import doubted_scene
from seewhy.revision.things.narrowed_rules import applies, thing_rule_revisions
from seewhy.revision.things.new_rule import new_thing_rule
from seewhy.revision.things.reasons import rule_of_reason
from seewhy.studio.labelled_scenes import drawn_scenes, labelled_scenes
from seewhy.studio.offered import Remedy
from seewhy.studio.writing import read_text

if TYPE_CHECKING:
    from seewhy.studio.project import Project
    from seewhy.studio.project_things import ProjectThings
    from seewhy.studio.thing_talk import ThingTalk

__all__ = ["doubted_of", "for_a_reason", "for_the_rules"]

_OF_EACH_KIND = 2


def for_the_rules(things: ProjectThings, talk: ThingTalk) -> tuple[Remedy, ...]:
    """Exceptions to the rules behind the class and the last answer, and rules that ask more."""
    with things.at_work():
        reasons = talk.replies[-1].reply.justification if talk.replies else None
        doubted = _doubted(things, talk)
        found = thing_rule_revisions(doubted, reasons, most=_OF_EACH_KIND)
        return _offered(doubted, talk, found)


def for_a_reason(things: ProjectThings, talk: ThingTalk, reason: str) -> tuple[Remedy, ...]:
    """The rule that a reason in words states.

    Raises
    ------
    QuestionError
        If the reason is not understood.
    RevisionError
        If the rule is known already, or can never be used.
    """
    with things.at_work():
        rule = rule_of_reason(things.project.domain(), reason)
        talk.wanted = rule.label
        doubted = _doubted(things, talk)
        return _offered(doubted, talk, [new_thing_rule(doubted, rule)])


def _offered(doubted: Doubted, talk: ThingTalk, found: Sequence[Proposal]) -> tuple[Remedy, ...]:
    return tuple(
        Remedy(key, proposal, _said_of(doubted, proposal))
        for key, proposal in talk.propose(found).items()
    )


def _said_of(doubted: Doubted, proposal: Proposal) -> str:
    """What would become of the picture and of others, in words."""
    domain, parts = doubted.known.domain, []
    where = applies(doubted, proposal)
    if where is not None:
        many = f"{where.scenes} picture{'' if where.scenes == 1 else 's'}"
        parts.append(
            f"of {many} with things drawn, the rule applies in {where.before}, then in "
            f"{where.after}"
        )
    if domain.classes:
        parts.append(say_decision(domain, proposal.decision))
        parts.append(say_consequences(proposal.consequences))
    elif where is None:
        parts.append("in no picture things are drawn, so that I cannot say which others change")
    return " ".join(f"{part[:1].upper()}{part[1:]}." for part in parts)


def doubted_of(
    project: Project, vector: tuple[str | None, ...], *, wanted: str | None = None
) -> Doubted:
    """A scene of the project's domain, and its labelled pictures, to judge proposals by."""
    folder = project.domain_folder
    assert folder is not None
    texts = {KNOWLEDGE: read_text(folder / KNOWLEDGE) or "", LEARNED: ""}
    scenes = labelled_scenes(project) if project.domain().classes else drawn_scenes(project)
    return doubted_scene(project.domain(), texts, vector, scenes, wanted=wanted)


def _doubted(things: ProjectThings, talk: ThingTalk) -> Doubted:
    vector = things.look(talk.picture).reading.vector
    return doubted_of(things.project, vector, wanted=talk.wanted)
