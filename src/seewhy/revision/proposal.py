"""A proposal: what may be wrong about an answer, what mends it, and what that would change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.working_knowledge import WorkingKnowledge, working_knowledge
from seewhy.errors import KnowledgeError
from seewhy.knowledge.consistency import check_consistency
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.learned_file import (
    learned_text,
    parse_learned,
    parse_withdrawn,
    with_origins,
)
from seewhy.knowledge.reasoner import Decision
from seewhy.knowledge.scene import FeatureVector
from seewhy.revision.consequences import Consequences, consequences
from seewhy.revision.edit import KNOWLEDGE, LEARNED, Edit, FileName, edited

__all__ = ["Cause", "Doubted", "Proposal", "known_by", "revised", "texts_of"]

Texts = Mapping[FileName, str]
"""What stands in the files that a revision may change."""


class Cause(StrEnum):
    """What is wrong where an answer is wrong, and how it is mended."""

    MISREAD = "a feature was misread"
    EXCEPTION = "the rule has an exception"
    NARROWED = "the rule asks too little"
    MISSING = "a rule is missing"


@dataclass(frozen=True)
class Proposal:
    """What may be wrong, and what would mend it.

    Attributes
    ----------
    cause : Cause
    sentence : str
        What is proposed, as a clause: a rule in words, or what the picture shows.
    edits : tuple of Edit
        What would be written into which file; none where a label has no dataset to stand in.
    decision : Decision
        What the knowledge would make of the scene.
    consequences : Consequences or None
        What would become of annotated scenes; None where there are none, or the knowledge stays.
    statement : str
        The axiom as it would stand in the knowledge; empty for a label.
    about : str
        The sentence of the axiom that is revised; empty where none is.
    exceptions : tuple of str
        For a new rule: how the rules would read that give way to it.
    reading : (str, str) or None
        For a label: the feature and its value.
    label : str or None
        For a label: the class, where somebody said it; for a rule, the class that it concludes.
    """

    cause: Cause
    sentence: str
    edits: tuple[Edit, ...]
    decision: Decision
    consequences: Consequences | None = None
    statement: str = ""
    about: str = ""
    exceptions: tuple[str, ...] = ()
    reading: tuple[str, str] | None = None
    label: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return the proposal as values that JSON can hold."""
        found = self.consequences
        return {
            "cause": self.cause.value,
            "sentence": self.sentence,
            "statement": self.statement or None,
            "about": self.about or None,
            "exceptions": list(self.exceptions),
            "feature": None if self.reading is None else self.reading[0],
            "value": None if self.reading is None else self.reading[1],
            "class": self.label,
            "class_then": self.decision.label,
            "verdict_then": self.decision.verdict.value,
            "consequences": None if found is None else found.to_dict(),
        }


@dataclass(frozen=True)
class Doubted:
    """A scene of which an answer is doubted, and what there is to judge proposals by.

    Attributes
    ----------
    known : WorkingKnowledge
    texts : mapping
        The files that it was read from.
    vector : FeatureVector
        What the scene is read as.
    scenes : AnnotatedScenes
        Annotated scenes; there may be none.
    wanted : str or None
        The class that the scene is of, where somebody said it.
    """

    known: WorkingKnowledge
    texts: Texts
    vector: FeatureVector
    scenes: AnnotatedScenes
    wanted: str | None = None

    @property
    def decision(self) -> Decision:
        """What the knowledge makes of the scene as it is."""
        return self.known.reasoner.decide(self.vector)

    def judged(
        self, cause: Cause, sentence: str, edits: Iterable[Edit], **about: Any
    ) -> Proposal | None:
        """Return a proposal with what it would change; None where the knowledge is broken by it."""
        written = tuple(edits)
        try:
            after = revised(self.known, self.texts, written)
        except KnowledgeError:
            return None
        found = None
        if self.scenes.vectors:
            found = consequences(self.known.reasoner, after.reasoner, self.scenes)
        decision = after.reasoner.decide(self.vector)
        return Proposal(cause, sentence, written, decision, found, **about)


def texts_of(known: WorkingKnowledge, knowledge: str) -> dict[FileName, str]:
    """Return the files that knowledge stands in; ``knowledge`` is the text of knowledge.al."""
    learned = known.learned or known.withdrawn
    return {
        KNOWLEDGE: knowledge,
        LEARNED: learned_text(known.learned, known.withdrawn) if learned else "",
    }


def known_by(known: WorkingKnowledge, texts: Texts) -> WorkingKnowledge:
    """Return what is known where the files of the knowledge hold these texts.

    Raises
    ------
    KnowledgeError
        If a statement is wrong, or an axiom can never be used because it contradicts another.
    """
    given = known.given
    knowledge = read_knowledge(texts[KNOWLEDGE], file=given.knowledge.file).without_change
    if given.things is not None:
        axioms = with_origins(knowledge.axioms, texts[KNOWLEDGE])
        knowledge = replace(knowledge, axioms=axioms).with_things(given.things.most)
    check_consistency(knowledge, given.schema)
    learned = texts.get(LEARNED, "")
    return working_knowledge(
        replace(given, knowledge=knowledge),
        learned=parse_learned(learned, knowledge.signature) if learned else (),
        withdrawn=parse_withdrawn(learned),
        minimality=known.minimality,
        experience=known.experience,
    )


def revised(known: WorkingKnowledge, texts: Texts, edits: Iterable[Edit]) -> WorkingKnowledge:
    """Return what is known where edits are made in the files of the knowledge.

    Raises
    ------
    KnowledgeError, RevisionError
        As :func:`known_by`; and if an edit finds no place.
    """
    return known_by(known, edited(texts, edits))
