"""Rules made by example, by conditions, or accepted from what was learned; each a proposal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from seewhy.agent.axiom_revision import proposed_axioms
from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.things.concluded import where_axioms_speak
from seewhy.agent.things.thing_axioms import (
    axioms_of_rules,
    learn_rules_for_domain,
    with_axioms_about_things,
)
from seewhy.agent.working_knowledge import working_knowledge
from seewhy.domain.domain import Domain
from seewhy.errors import DomainError, RevisionError, SeeWhyError
from seewhy.induction.axiom_learning import LearningOptions
from seewhy.induction.candidate import Candidate
from seewhy.induction.things.rule_learning import ThingLearningOptions
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.scene import FeatureVector
from seewhy.revision.edit import KNOWLEDGE, LEARNED
from seewhy.revision.knowledge_text import axiom_added, learned_removed
from seewhy.revision.new_rule import Fit, fit_of, known_already, new_rule, rules_by_example
from seewhy.revision.proposal import Cause, Doubted, Proposal
from seewhy.revision.things.new_rule import new_thing_rule
from seewhy.revision.things.reasons import rule_of_reason
from seewhy.studio.doubting_things import doubted_of
from seewhy.studio.labelled_scenes import labelled_scenes
from seewhy.studio.project import Project
from seewhy.studio.project_model import ProjectModel
from seewhy.text.nearest import did_you_mean

__all__ = ["MadeRule", "learned_rules", "rules_from", "rules_in_words"]


@dataclass(frozen=True)
class MadeRule:
    """A rule that can be taken, and the pictures that it rests on.

    Attributes
    ----------
    proposal : Proposal
    rests_on, missed, against : tuple of str
        Pictures that it speaks about; examples that it does not; pictures of other classes that it
        speaks about.
    """

    proposal: Proposal
    rests_on: tuple[str, ...]
    missed: tuple[str, ...] = ()
    against: tuple[str, ...] = ()


def rules_from(
    project: Project,
    text: str,
    *,
    label: str,
    examples: Sequence[str] = (),
    conditions: Mapping[str, Sequence[str]],
) -> tuple[MadeRule, ...]:
    """Return the rules that conditions state, or that examples have in common.

    Parameters
    ----------
    project : Project
    text : str
        Of knowledge.al.
    label : str
        The class that the rule concludes.
    examples : sequence of str
        Pictures.
    conditions : mapping of str to sequence of str
        Feature → values, any of which a picture must show; where there are none, the smallest rules
        are looked for that cover the examples.

    Raises
    ------
    SeeWhyError
        If the class or a condition is none of the domain; if there are neither examples nor
        conditions, or an example has no label.
    RevisionError
        If no rule tells the examples from other classes, or the rule is known or never used.
    """
    domain, scenes = project.domain(), labelled_scenes(project)
    if label not in domain.classes:
        raise SeeWhyError(f"'{label}' is no class; {did_you_mean(label, list(domain.classes))}")
    if not examples and not conditions:
        raise SeeWhyError("nothing is chosen: choose pictures, or the values that a rule asks for")
    places = {picture: place for place, picture in enumerate(scenes.pictures)}
    lost = [picture for picture in examples if picture not in places]
    if lost:
        raise SeeWhyError(f"{lost[0]} has no class yet, so that nothing rests on it; label it")
    chosen = [places[picture] for picture in examples]
    _require_values(project, conditions)
    if conditions:
        stated = tuple(
            PathCondition(key, tuple(conditions[key]))
            for key in domain.features
            if key in conditions
        )
        candidates: Sequence[Candidate] = (Candidate(label, stated),)
        vector = scenes.vectors[chosen[0]] if chosen else _shown(domain, conditions)
    else:
        candidates = rules_by_example(domain, scenes, chosen, label)
        vector = scenes.vectors[chosen[0]]
        if not candidates:
            raise RevisionError(
                "nothing that these pictures have in common tells them from those of other "
                "classes; choose fewer, or add a feature that tells them apart"
            )
    doubted = _doubted(project, text, scenes, vector)
    return tuple(
        _made(scenes, proposal, fit_of(domain, scenes, candidate, chosen), label)
        for candidate in candidates
        if not _is_known(doubted, candidate, only=len(candidates) == 1)
        for proposal in new_rule(doubted, candidate)
    )


def learned_rules(model: ProjectModel, text: str) -> tuple[MadeRule, ...]:
    """Return the rules that the model learned, and those that the labelled pictures suggest.

    Raises
    ------
    SeeWhyError
        If the labelled pictures are of fewer than two classes.
    """
    project = model.project
    scenes = labelled_scenes(project)
    if len(set(scenes.labels)) < 2:
        raise SeeWhyError("a rule tells classes apart: label pictures of two classes first")
    if project.has_things:
        return _learned_of_things(project, scenes)
    unknown: FeatureVector = (None,) * len(project.domain().features)
    doubted = _doubted(project, text, scenes, unknown)
    found = proposed_axioms(doubted.known, scenes, options=LearningOptions()).axioms
    learned: tuple[Axiom, ...] = ()
    learned_text = ""
    if model.missing is None and model.trained_for_this:
        with model.at_work() as agent:
            learned, learned_text = agent.learned, model.texts()[LEARNED]
    said = {str(axiom) for axiom in learned}
    rules = [_accepted(doubted, axiom, learned_text) for axiom in learned]
    rules += [_accepted(doubted, axiom, "") for axiom in found if str(axiom) not in said]
    return tuple(rule for rule in rules if rule is not None)


def rules_in_words(project: Project, text: str) -> tuple[MadeRule, ...]:
    """Return the rule about things that a reason in words states.

    Raises
    ------
    QuestionError, RevisionError
        If the reason is not understood; if the rule is known already, or can never be used.
    """
    domain, scenes = project.domain(), labelled_scenes(project)
    rule = rule_of_reason(domain, text)
    doubted = doubted_of(project, scenes.vectors[0] if scenes.vectors else domain.vector({}))
    proposal = new_thing_rule(doubted, rule)
    (axiom,) = read_axioms(proposal.statement, doubted.known.domain.knowledge.signature)
    few = doubted.known.domain
    speaking = with_axioms_about_things(few, [axiom])
    (where,) = where_axioms_speak(speaking, [axiom], doubted.scenes.vectors)
    spoken = where.nonzero()[0].tolist()
    rests_on = tuple(scenes.pictures[n] for n in spoken if scenes.labels[n] == rule.label)
    against = tuple(scenes.pictures[n] for n in spoken if scenes.labels[n] != rule.label)
    return (MadeRule(proposal, rests_on, against=against),)


def _learned_of_things(project: Project, scenes: AnnotatedScenes) -> tuple[MadeRule, ...]:
    """The rules about things that the labelled pictures suggest."""
    doubted = doubted_of(project, scenes.vectors[0])
    few = doubted.known.domain
    judged = learn_rules_for_domain(few, doubted.scenes, ThingLearningOptions())
    found = axioms_of_rules(few, judged, doubted.scenes)
    rules = [_accepted(doubted, axiom, "") for axiom in found]
    return tuple(rule for rule in rules if rule is not None)


def _accepted(doubted: Doubted, axiom: Axiom, learned_text: str) -> MadeRule | None:
    """A learned axiom as one of knowledge.al; None where it would break the knowledge."""
    edit = axiom_added(doubted.texts[KNOWLEDGE], str(axiom), axiom.text)
    proposal = doubted.judged(Cause.MISSING, axiom.text, (edit,), statement=str(axiom))
    if proposal is None:
        return None
    if learned_text:
        proposal = replace(proposal, edits=(learned_removed(learned_text, axiom), edit))
    return MadeRule(proposal, axiom.origin.pictures)


def _made(scenes: AnnotatedScenes, proposal: Proposal, fit: Fit, label: str) -> MadeRule:
    def named(places: Sequence[int]) -> tuple[str, ...]:
        return tuple(scenes.pictures[place] for place in places)

    assert proposal.label == label
    return MadeRule(proposal, named(fit.covered), named(fit.missed), named(fit.against))


def _is_known(doubted: Doubted, candidate: Candidate, *, only: bool) -> bool:
    known = known_already(doubted.known, candidate)
    if known is not None and only:
        raise RevisionError(f'the rule is known already: "{known.text}"')
    return known is not None


def _doubted(
    project: Project, text: str, scenes: AnnotatedScenes, vector: FeatureVector
) -> Doubted:
    known = working_knowledge(project.domain())
    return Doubted(known, {KNOWLEDGE: text, LEARNED: ""}, vector, scenes)


def _require_values(project: Project, conditions: Mapping[str, Sequence[str]]) -> None:
    features = project.domain().features
    for key, values in conditions.items():
        for value in values:
            if key not in features or value not in features[key].values:
                raise DomainError(f"'{key}={value}' is no value of a feature; choose one")


def _shown(domain: Domain, conditions: Mapping[str, Sequence[str]]) -> FeatureVector:
    """A scene that shows the first value of each condition."""
    return domain.vector({key: values[0] for key, values in conditions.items()})
