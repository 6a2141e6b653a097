"""A rule that is wrong about a scene: it gets an exception, or asks one more condition."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from seewhy.domain.domain import Domain
from seewhy.domain.wording import say_values
from seewhy.induction.axiom_text import SCENE, condition_text
from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Axiom, AxiomKind, predicates_in, substitute, variables_in
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.reasoner import Decision, Reasoner
from seewhy.revision.consequences import Consequences, consequences
from seewhy.revision.edit import KNOWLEDGE, LEARNED, Edit
from seewhy.revision.knowledge_text import (
    axiom_added,
    condition_added,
    learned_removed,
    narrowed_statement,
)
from seewhy.revision.proposal import Cause, Doubted, Proposal

__all__ = [
    "NarrowedRule",
    "Narrowing",
    "exceptions_for",
    "narrowings",
    "rule_revisions",
    "rules_behind",
]

_MOST_TRIED = 64
"""So many narrowings are judged: each decides all annotated scenes again."""

_MOST_SPOKEN = 2_000
"""Of so many distinct scenes it is looked at whether a rule speaks about them."""


@dataclass(frozen=True)
class NarrowedRule:
    """An axiom with one more condition.

    Attributes
    ----------
    axiom : Axiom
        As it is.
    cause : Cause
        EXCEPTION: it does not apply where ``asked`` holds; NARROWED: only there.
    asked : PathCondition
    condition : str
        What is added to the axiom's body.
    """

    axiom: Axiom
    cause: Cause
    asked: PathCondition
    condition: str

    @property
    def statement(self) -> str:
        """The axiom as it would stand in the knowledge."""
        return narrowed_statement(self.axiom, self.condition)

    def said(self, domain: Domain) -> str:
        """What the axiom's sentence would say more."""
        clause = say_values(domain, self.asked.feature, self.asked.values).replace("{it}", "it")
        return f"{'unless' if self.cause is Cause.EXCEPTION else 'provided that'} {clause}"

    def sentence(self, domain: Domain) -> str:
        """The axiom's sentence as it would be."""
        return f"{self.axiom.text.removesuffix('.')}, {self.said(domain)}"

    def edits(self, doubted: Doubted) -> tuple[Edit, ...]:
        """What would be written; a learned axiom becomes one of knowledge.al."""
        domain, text = doubted.known.domain, doubted.texts[KNOWLEDGE]
        if not self.axiom.origin.learned:
            return (condition_added(text, self.axiom, self.condition, self.said(domain)),)
        return (
            learned_removed(doubted.texts[LEARNED], self.axiom),
            axiom_added(text, self.statement, self.sentence(domain)),
        )


@dataclass(frozen=True)
class Narrowing:
    """A narrowed rule, by which it does not apply to a scene any more, with what that changes."""

    rule: NarrowedRule
    decision: Decision
    consequences: Consequences


def rules_behind(doubted: Doubted) -> tuple[Axiom, ...]:
    """Return the axioms by which a scene is of its class, those first that conclude the class.

    Where the beliefs contradict each other, those that apply; none where nothing is concluded.
    """
    known, label = doubted.known, doubted.decision.label
    if label is not None:
        used = [
            node.axiom.identifier
            for node in known.reasoned.why_class(doubted.vector, label).walk()
            if node.axiom is not None and node.holds and not node.is_refuted
        ]
    else:
        believed = known.reasoner.answer_set(doubted.vector)
        used = [] if believed is None or not believed.conflict else [*believed.firings]
    axioms = {axiom.identifier: axiom for axiom in known.domain.knowledge.axioms}
    found = [axioms[name] for name in dict.fromkeys(used) if _scene_variable(axioms[name], doubted)]
    classes = {literal.predicate for literal in known.domain.schema.classes.values()}
    return tuple(sorted(found, key=lambda axiom: axiom.head.predicate not in classes))


def rule_revisions(doubted: Doubted, *, most: int = 1) -> tuple[Proposal, ...]:
    """Propose exceptions to the rules behind a scene's class, and rules that ask more.

    Of each kind those come first that cost the fewest annotated scenes that are right now.

    Parameters
    ----------
    doubted : Doubted
    most : int, default 1
        So many of each kind.

    Examples
    --------
    >>> from seewhy.agent.learning_from_pictures import AnnotatedScenes
    >>> from seewhy.agent.working_knowledge import working_knowledge
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.revision.proposal import texts_of
    >>> domain = load_domain("structure_stability")
    >>> known = working_knowledge(domain)
    >>> text = (domain.folder / "knowledge.al").read_text(encoding="utf-8")
    >>> scene = ("4", "wide", "no", "yes")
    >>> right = ("5", "narrow", "no", "yes")
    >>> scenes = AnnotatedScenes((scene, right), ("stable", "unstable"), ("a.png", "b.png"))
    >>> doubted = Doubted(known, texts_of(known, text), scene, scenes, "stable")
    >>> for proposal in rule_revisions(doubted):
    ...     print(proposal.statement, proposal.consequences.mended, proposal.consequences.lost)
    -stable(S) if block_displaced(S), not num_blocks(S, 4). 1 0
    -stable(S) if block_displaced(S), num_blocks(S, 5). 1 0
    """
    ranked = sorted(narrowings(doubted), key=lambda narrowing: _cost(narrowing, doubted))
    found: list[Proposal] = []
    chosen: list[Narrowing] = []
    for cause in (Cause.EXCEPTION, Cause.NARROWED):
        for narrowing in ranked:
            same = any(_says_the_same(narrowing, other, doubted) for other in chosen)
            if narrowing.rule.cause is not cause or same:
                continue
            proposal = _proposal(narrowing, doubted)
            if proposal is not None:
                found.append(proposal)
                chosen.append(narrowing)
            if sum(narrowing.rule.cause is cause for narrowing in chosen) == most:
                break
    return tuple(found)


def narrowings(doubted: Doubted) -> Iterator[Narrowing]:
    """Yield the narrowings of the rules behind a scene's class, each with what it would change."""
    domain = doubted.known.domain
    tried = 0
    for axiom in rules_behind(doubted):
        right = _rightly_spoken(axiom, doubted)
        for cause, asked in _conditions(axiom, doubted, right):
            rule = _narrowed_rule(axiom, cause, asked, doubted)
            (narrowed,) = read_axioms(rule.statement, domain.knowledge.signature)
            narrowed = replace(narrowed, identifier=axiom.identifier, origin=axiom.origin)
            axioms = [narrowed if other is axiom else other for other in domain.knowledge.axioms]
            after = Reasoner(
                replace(domain.knowledge, axioms=tuple(axioms)),
                domain.schema,
                minimality=doubted.known.minimality,
            )
            yield Narrowing(
                rule,
                after.decide(doubted.vector),
                consequences(doubted.known.reasoner, after, doubted.scenes),
            )
            tried += 1
            if tried == _MOST_TRIED:
                return


def _conditions(
    axiom: Axiom, doubted: Doubted, right: Sequence[tuple[str | None, ...]]
) -> Iterator[tuple[Cause, PathCondition]]:
    """What an axiom may ask more, so that it does not apply to the scene."""
    features = doubted.known.domain.features
    for column, (key, feature) in enumerate(features.items()):
        value = doubted.vector[column]
        numbers = all(number.isdecimal() for number in feature.values)
        if value is None or (_is_asked(axiom, key) and not numbers):
            continue
        yield Cause.EXCEPTION, PathCondition(key, (value,))
        shown = {vector[column] for vector in right} - {value, None}
        others = tuple(other for other in feature.values if other != value)
        asked = tuple(other for other in others if other in shown)
        if not asked and len(others) == 1 and not doubted.scenes.vectors:
            asked = others
        if asked and (len(asked) < len(others) or len(others) == 1):
            yield Cause.NARROWED, PathCondition(key, asked)


def _is_asked(axiom: Axiom, feature: str) -> bool:
    """Whether an axiom asks a feature's value already."""
    return any(feature in predicates_in(condition.text) for condition in axiom.body)


def _rightly_spoken(axiom: Axiom, doubted: Doubted) -> list[tuple[str | None, ...]]:
    """The annotated scenes that an axiom speaks about and that are decided rightly."""
    reasoner, scenes = doubted.known.reasoner, doubted.scenes
    distinct = dict.fromkeys(zip(scenes.vectors, scenes.labels, strict=True))
    found = []
    for vector, label in list(distinct)[:_MOST_SPOKEN]:
        if reasoner.decide(vector).label != label:
            continue
        answer_set = reasoner.answer_set(vector)
        if answer_set is not None and axiom.identifier in answer_set.firings:
            found.append(vector)
    return found


def _scene_variable(axiom: Axiom, doubted: Doubted) -> str | None:
    """The variable of an axiom that stands for the scene; None where its head has none."""
    if axiom.kind not in (AxiomKind.STATE_CONSTRAINT, AxiomKind.DEFAULT) or not axiom.body:
        return None
    signature = doubted.known.domain.knowledge.signature
    sorts = signature.predicates[axiom.head.predicate].sorts
    for argument, sort in zip(axiom.head.arguments, sorts, strict=True):
        if sort == doubted.known.domain.scene and variables_in(argument) == (argument,):
            return argument
    return None


def _narrowed_rule(
    axiom: Axiom, cause: Cause, asked: PathCondition, doubted: Doubted
) -> NarrowedRule:
    condition = _in_variables(asked, axiom, doubted)
    denied = "not " if cause is Cause.EXCEPTION else ""
    return NarrowedRule(axiom, cause, asked, f"{denied}{condition}")


def _in_variables(asked: PathCondition, axiom: Axiom, doubted: Doubted) -> str:
    """A condition with the axiom's variable of the scene, and a number that it does not have."""
    taken = set(axiom.variables)
    number = next(name for name in ("N", *(f"N{n}" for n in range(1, 99))) if name not in taken)
    text = condition_text(asked, doubted.known.domain.schema, number=number)
    return substitute(text, {SCENE: _scene_variable(axiom, doubted) or SCENE})


def _cost(narrowing: Narrowing, doubted: Doubted) -> tuple[int, ...]:
    """What speaks against a narrowing, the worst first."""
    found, decided = narrowing.consequences, narrowing.decision.label
    unchanged = decided == doubted.decision.label
    if doubted.wanted is not None:
        short = 0 if decided == doubted.wanted else 2 if decided is not None else 1
    else:
        short = 0
    return (
        int(unchanged or short == 2),
        found.lost,
        len(found.contradictions),
        short,
        -found.mended,
        len(narrowing.rule.asked.values),
    )


def _says_the_same(narrowing: Narrowing, other: Narrowing, doubted: Doubted) -> bool:
    """Whether two narrowings of an axiom are one where every feature is known."""
    one, two = narrowing.rule, other.rule
    if one.axiom is not two.axiom or one.asked.feature != two.asked.feature:
        return False
    values = doubted.known.domain.features[one.asked.feature].values
    return {*one.asked.values, *two.asked.values} == {*values}


def _proposal(narrowing: Narrowing, doubted: Doubted) -> Proposal | None:
    """A narrowing as a proposal; None where the knowledge is broken by it, or nothing changes."""
    if narrowing.decision == doubted.decision and not narrowing.consequences.changed:
        return None
    rule = narrowing.rule
    return doubted.judged(
        rule.cause,
        rule.sentence(doubted.known.domain),
        rule.edits(doubted),
        statement=rule.statement,
        about=rule.axiom.text,
    )


def exceptions_for(doubted: Doubted, candidate: Candidate) -> tuple[NarrowedRule, ...]:
    """Return the exceptions by which the rules behind a scene's class give way to another rule.

    Each rule gets as its exception what the other asks and it does not; where that is not one
    condition, there is no such exception, and none is returned.

    Examples
    --------
    >>> from seewhy.agent.learning_from_pictures import AnnotatedScenes
    >>> from seewhy.agent.working_knowledge import working_knowledge
    >>> from seewhy.domain.domain import load_domain
    >>> known = working_knowledge(load_domain("structure_stability"))
    >>> doubted = Doubted(known, {}, ("4", "wide", "no", "yes"), AnnotatedScenes((), (), ()))
    >>> wide = Candidate("stable", (PathCondition("base", ("wide",)),))
    >>> [rule.statement for rule in exceptions_for(doubted, wide)]
    ['-stable(S) if block_displaced(S), not base(S, wide).']
    """
    domain = doubted.known.domain
    classes = {literal.predicate for literal in domain.schema.classes.values()}
    found = []
    for axiom in rules_behind(doubted):
        if axiom.head.predicate not in classes:
            continue
        more = [asked for asked in candidate.conditions if not _is_asked(axiom, asked.feature)]
        if len(more) != 1:
            return ()
        found.append(_narrowed_rule(axiom, Cause.EXCEPTION, more[0], doubted))
    return tuple(found)
