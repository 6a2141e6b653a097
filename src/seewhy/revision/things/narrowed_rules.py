"""A rule about things that is wrong about a scene: it gets an exception, or asks one more thing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from seewhy.agent.things.concluded import where_axioms_speak
from seewhy.domain.domain import Domain
from seewhy.domain.thing_wording import described
from seewhy.domain.things import SEEN, Things
from seewhy.induction.things.conditions import HasValue, Pattern, Related, There
from seewhy.induction.things.rule_sentence import say_condition
from seewhy.induction.things.rule_text import counted_condition
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.justification import Node
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.reasoner import Decision, Reasoner
from seewhy.knowledge.things import literals_about, of_things
from seewhy.revision.consequences import Consequences, consequences
from seewhy.revision.edit import KNOWLEDGE, Edit
from seewhy.revision.knowledge_text import condition_added, narrowed_statement
from seewhy.revision.proposal import Cause, Doubted, Proposal, revised
from seewhy.revision.things.doubted_scene import axioms_behind

__all__ = ["Applies", "applies", "edit_of", "giving_way", "thing_rule_revisions"]

_MOST_TRIED = 48
"""So many narrowings are judged: each decides all annotated scenes again."""

_COUNTED = {"U", "V", "W"}
"""The variables of what is counted; an axiom that uses one of them is not counted into."""


@dataclass(frozen=True)
class Asked:
    """One more condition of an axiom.

    Attributes
    ----------
    axiom : Axiom
    cause : Cause
        EXCEPTION or NARROWED.
    condition : str
        In the knowledge language.
    said : str
        The clause that it adds to the axiom's sentence.
    """

    axiom: Axiom
    cause: Cause
    condition: str
    said: str

    @property
    def statement(self) -> str:
        """The axiom as it would read."""
        return narrowed_statement(self.axiom, self.condition)

    @property
    def sentence(self) -> str:
        """Its sentence as it would be."""
        return f"{self.axiom.text.removesuffix('.')}, {self.said}"


@dataclass(frozen=True)
class Applies:
    """In how many of some scenes an axiom applies as it is, and as it would read."""

    scenes: int
    before: int
    after: int


@dataclass(frozen=True)
class _Judged:
    asked: Asked
    decision: Decision
    consequences: Consequences


def thing_rule_revisions(
    doubted: Doubted, reasons: Node | None = None, *, most: int = 2
) -> tuple[Proposal, ...]:
    """Propose exceptions to the rules behind an answer, and rules that ask more.

    Of each kind those come first that cost the fewest annotated scenes that are right now.

    Parameters
    ----------
    doubted : Doubted
        Made by :func:`~seewhy.revision.things.doubted_scene.doubted_scene`.
    reasons : Node, optional
        The justification of the answer, whose axioms may be wrong, too.
    most : int, default 2
        So many of each kind.
    """
    judged = [_judged(asked, doubted) for asked in _tried(doubted, reasons)]
    judged.sort(key=lambda judgement: _cost(judgement, doubted))
    found: list[Proposal] = []
    for cause in (Cause.EXCEPTION, Cause.NARROWED):
        offered = 0
        for judgement in judged:
            if judgement.asked.cause is not cause or offered == most:
                continue
            proposal = _proposal(judgement, doubted)
            if proposal is not None:
                found.append(proposal)
                offered += 1
    return tuple(found)


def giving_way(doubted: Doubted, label: str) -> tuple[Asked, ...]:
    """Return the exceptions by which rules for other classes give way to what is of a class."""
    domain = doubted.known.domain
    concluded = domain.classes[label]
    others = {
        scene_class.literal.predicate: scene_class.literal
        for scene_class in domain.classes.values()
        if scene_class is not concluded
    }
    found = []
    for axiom in axioms_behind(doubted):
        other = others.get(axiom.head.predicate)
        scene = _scene_variable(axiom, domain)
        if other is None or other.positive != axiom.head.positive or scene is None:
            continue
        wanted = str(domain.schema.of_any_scene(concluded.literal, scene))
        if f"not {wanted}" in {condition.text for condition in axiom.body}:
            continue
        said = f"unless it is {concluded.say}"
        found.append(Asked(axiom, Cause.EXCEPTION, f"not {wanted}", said))
    return tuple(found)


def applies(doubted: Doubted, proposal: Proposal) -> Applies | None:
    """Return where an axiom applies that concludes no class; None of others, or without scenes."""
    before = doubted.known.domain
    classes = {scene_class.literal.predicate for scene_class in before.classes.values()}
    old = next((each for each in before.knowledge.axioms if each.text == proposal.about), None)
    if old is None or old.head.predicate in classes or not doubted.scenes.vectors:
        return None
    after = revised(doubted.known, doubted.texts, proposal.edits).domain
    new = next(each for each in after.knowledge.axioms if each.text == proposal.sentence)
    vectors = doubted.scenes.vectors
    (was,), (is_then,) = (
        where_axioms_speak(domain, [axiom], vectors)
        for domain, axiom in ((before, old), (after, new))
    )
    return Applies(len(vectors), int(was.sum()), int(is_then.sum()))


def edit_of(asked: Asked, doubted: Doubted) -> tuple[Edit, ...]:
    """What would be written."""
    text = doubted.texts[KNOWLEDGE]
    return (condition_added(text, asked.axiom, asked.condition, asked.said),)


# What may be asked more ----------------------------------------------------------------------


def _tried(doubted: Doubted, reasons: Node | None) -> list[Asked]:
    """What is judged: of every axiom behind the answer first what is asked of its own things."""
    behind = [
        axiom
        for axiom in axioms_behind(doubted, reasons)
        if axiom.kind in (AxiomKind.STATE_CONSTRAINT, AxiomKind.DEFAULT) and axiom.body
    ]
    near = [asked for axiom in behind for asked in _of_its_things(axiom, doubted)]
    near += [asked for axiom in behind for asked in _of_the_whole(axiom, doubted)]
    far = [asked for axiom in behind for asked in _of_what_is_there(axiom, doubted)]
    return [*near, *far][:_MOST_TRIED]


def _of_its_things(axiom: Axiom, doubted: Doubted) -> Iterator[Asked]:
    """That a thing that the axiom speaks of has another value than those that it is about here."""
    domain, bindings = doubted.known.domain, _bindings(axiom, doubted)
    things = domain.things
    assert things is not None, "the domain has no things"
    signature = domain.knowledge.signature
    shown = dict(zip(domain.schema.features, doubted.vector, strict=True))
    called = _called(axiom, things, bindings, domain)
    for variable, name in called.items():
        for key, feature in things.features.items():
            if _asks(axiom, key, variable):
                continue
            seen = {shown[of_things(key, binding[variable])] for binding in bindings}
            if len(seen) != 1 or None in seen:
                continue
            value = str(next(iter(seen)))
            literals = literals_about(signature.predicates[key], (variable,), signature)
            clause = feature.say[value].replace("{it}", name)
            yield Asked(axiom, Cause.EXCEPTION, f"not {literals[value]}", f"unless {clause}")
            if len(feature.values) > 2:
                for other in feature.values:
                    clause = feature.say[other].replace("{it}", name)
                    if other != value:
                        said = f"provided that {clause}"
                        yield Asked(axiom, Cause.NARROWED, str(literals[other]), said)


def _of_the_whole(axiom: Axiom, doubted: Doubted) -> Iterator[Asked]:
    """That the picture as a whole has another value."""
    domain, scene = doubted.known.domain, _scene_variable(axiom, doubted.known.domain)
    if scene is None:
        return
    shown = dict(zip(domain.schema.features, doubted.vector, strict=True))
    for key, feature in domain.features.items():
        value = shown[key]
        if value is None or _asks(axiom, key, scene):
            continue
        for other in feature.values:
            literal = str(domain.schema.of_any_scene(domain.schema.features[key][other], scene))
            clause = feature.say[other].replace("{it}", domain.subject)
            if other == value:
                yield Asked(axiom, Cause.EXCEPTION, f"not {literal}", f"unless {clause}")
            elif len(feature.values) > 2:
                yield Asked(axiom, Cause.NARROWED, literal, f"provided that {clause}")


def _of_what_is_there(axiom: Axiom, doubted: Doubted) -> Iterator[Asked]:
    """That there is not what is there, or is what is not."""
    domain = doubted.known.domain
    things = domain.things
    assert things is not None, "the domain has no things"
    if _COUNTED & set(axiom.variables):
        return
    schema, signature = domain.schema, domain.knowledge.signature
    for there, seen in _patterns(doubted):
        condition = replace(there, holds=not seen)
        text = counted_condition(condition, things, schema, signature)
        if text in {part.text for part in axiom.body}:
            continue
        cause = Cause.EXCEPTION if seen else Cause.NARROWED
        joined = "unless" if seen else "provided that"
        yield Asked(axiom, cause, text, f"{joined} {say_condition(domain, there)}")


def _patterns(doubted: Doubted) -> Iterator[tuple[There, bool]]:
    """What there may be in a scene, and whether it is there; what is there comes first."""
    domain = doubted.known.domain
    things = domain.things
    assert things is not None, "the domain has no things"
    shown = dict(zip(domain.schema.features, doubted.vector, strict=True))
    here = [term for term, there in domain.schema.presence.items() if shown[there] == "yes"]
    missing = []
    for key, feature in things.features.items():
        seen = {shown[of_things(key, term)] for term in here}
        for value in feature.values:
            there = There(Pattern.of(1, [HasValue(0, key, value)]))
            if value in seen:
                yield there, True
            else:
                missing.append(there)
    for key, relation in things.relations.items():
        if relation.measure != SEEN:  # boxes nearly always have some order
            continue
        related = There(Pattern.of(2, [Related(0, 1, key)]))
        pairs = ((one, other) for one in here for other in here if one != other)
        if any(shown[of_things(key, *pair)] == "yes" for pair in pairs):
            yield related, True
        else:
            missing.append(related)
    yield from ((there, False) for there in missing)


def _bindings(axiom: Axiom, doubted: Doubted) -> list[dict[str, str]]:
    """What the variables of an axiom stand for wherever it applies to the scene."""
    believed = doubted.known.reasoner.answer_set(doubted.vector)
    instances = [] if believed is None else believed.firings.get(axiom.identifier, [])
    return [dict(zip(axiom.variables, instance, strict=True)) for instance in instances]


def _called(
    axiom: Axiom, things: Things, bindings: Sequence[dict[str, str]], domain: Domain
) -> dict[str, str]:
    """The variables of an axiom that stand for things, and how its sentence may call them."""
    found: dict[str, str] = {}
    plain = f"the {things.one}"
    for variable in axiom.variables:
        if not bindings or any(each[variable] not in domain.schema.presence for each in bindings):
            continue
        values: dict[str, str | None] = {}
        signature = domain.knowledge.signature
        for key in things.features:
            literals = literals_about(signature.predicates[key], (variable,), signature)
            asked = {str(literal): value for value, literal in literals.items()}
            conditions = (condition.text for condition in axiom.body)
            values[key] = next((asked[text] for text in conditions if text in asked), None)
        name = f"the {described(things, values)}"
        other = name in found.values() or (name == plain and found)
        found[variable] = f"the other {name[4:]}" if other else name
    return found


def _asks(axiom: Axiom, predicate: str, variable: str) -> bool:
    """Whether an axiom asks a feature of what a variable stands for."""
    return any(
        condition.literal is not None
        and condition.literal.predicate == predicate
        and variable in condition.literal.arguments
        for condition in axiom.body
    )


def _scene_variable(axiom: Axiom, domain: Domain) -> str | None:
    """The variable of an axiom that stands for the picture; None where its head has none."""
    sorts = domain.knowledge.signature.predicates[axiom.head.predicate].sorts
    for argument, sort in zip(axiom.head.arguments, sorts, strict=True):
        if sort == domain.scene and argument in axiom.variables:
            return argument
    return None


# Judging -------------------------------------------------------------------------------------


def _judged(asked: Asked, doubted: Doubted) -> _Judged:
    domain = doubted.known.domain
    (narrowed,) = read_axioms(asked.statement, domain.knowledge.signature)
    narrowed = replace(narrowed, identifier=asked.axiom.identifier, origin=asked.axiom.origin)
    axioms = [narrowed if axiom is asked.axiom else axiom for axiom in domain.knowledge.axioms]
    knowledge = replace(domain.knowledge, axioms=tuple(axioms))
    after = Reasoner(knowledge, domain.schema, minimality=doubted.known.minimality)
    return _Judged(
        asked,
        after.decide(doubted.vector),
        consequences(doubted.known.reasoner, after, doubted.scenes),
    )


def _cost(judged: _Judged, doubted: Doubted) -> tuple[int, ...]:
    """What speaks against a narrowing, the worst first."""
    found, decided = judged.consequences, judged.decision.label
    short = 0
    if doubted.wanted is not None:
        short = 0 if decided == doubted.wanted else 2 if decided is not None else 1
    return (
        int(decided == doubted.decision.label or short == 2),
        found.lost,
        len(found.contradictions),
        short,
        -found.mended,
        int("#count" in judged.asked.condition),
    )


def _proposal(judged: _Judged, doubted: Doubted) -> Proposal | None:
    """A narrowing as a proposal; None where the knowledge is broken by it, or nothing changes."""
    asked = judged.asked
    classes = {each.literal.predicate for each in doubted.known.domain.classes.values()}
    unchanged = judged.decision == doubted.decision and not judged.consequences.changed
    if unchanged and (asked.axiom.head.predicate in classes or "#count" in asked.condition):
        return None
    return doubted.judged(
        asked.cause,
        asked.sentence,
        edit_of(asked, doubted),
        statement=asked.statement,
        about=asked.axiom.text,
    )
