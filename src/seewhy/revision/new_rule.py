"""A rule that is missing: from the reason that somebody gives, or from examples of a class."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.working_knowledge import WorkingKnowledge
from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.lexicon import NUMBERS
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import Domain
from seewhy.errors import QuestionError, RevisionError
from seewhy.induction.axiom_text import axiom_statement, conjunctions
from seewhy.induction.candidate import Candidate, tally
from seewhy.induction.generalisation import generalised, most_general
from seewhy.induction.scene_table import SceneTable, scene_table
from seewhy.induction.sentence import say_rule
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.scene import FeatureVector
from seewhy.revision.edit import KNOWLEDGE
from seewhy.revision.knowledge_text import axiom_added
from seewhy.revision.proposal import Cause, Doubted, Proposal
from seewhy.revision.rule_revision import exceptions_for

__all__ = [
    "Fit",
    "fit_of",
    "known_already",
    "new_rule",
    "reason_given",
    "rules_by_example",
    "stated",
]

_MOST_CONDITIONS = 3
"""Of so many conditions all conjunctions are tried; of more, a rule is generalised."""


_PICTURES = ("pictures", "images", "photos", "photographs", "ones")


@dataclass(frozen=True)
class Fit:
    """How a rule fits annotated scenes.

    Attributes
    ----------
    covered : tuple of int
        The places of the examples that it speaks about.
    missed : tuple of int
        Those of the examples that it does not.
    against : tuple of int
        The scenes of other classes that it speaks about.
    """

    covered: tuple[int, ...]
    missed: tuple[int, ...]
    against: tuple[int, ...]


def reason_given(questions: Questions, text: str) -> Candidate:
    """Return the rule that a sentence with "because" states, in the words of the domain.

    Raises
    ------
    QuestionError
        If the sentence is not "it is CLASS because …", or a part of it is not understood.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> questions = Questions(load_domain("structure_stability"))
    >>> reason_given(questions, "these three are unstable because they lean").conditions
    (PathCondition(feature='lean', values=('yes',)),)
    """
    said, _, because = text.partition(" because ")
    (concluded,) = stated(questions, said)[:1] or (Statement(),)
    if concluded.label is None:
        classes = " or ".join(each.say for each in list(questions.domain.classes.values())[:3])
        raise QuestionError(
            f"'{' '.join(said.split())}' names no class, and a rule concludes one; say for "
            f"instance 'it is {classes} because …'"
        )
    conditions: dict[str, tuple[str, ...]] = {}
    for statement in stated(questions, because.removeprefix("of ")):
        if statement.feature is None or statement.value is None:
            raise QuestionError(
                f"'{' '.join(because.split())}' names no feature, and a rule asks what a picture "
                f"shows; the features are {', '.join(questions.domain.features)}"
            )
        conditions[statement.feature] = (statement.value,)
    ordered = (key for key in questions.domain.features if key in conditions)
    return Candidate(concluded.label, tuple(PathCondition(key, conditions[key]) for key in ordered))


def stated(questions: Questions, text: str) -> tuple[Statement, ...]:
    """Return what a statement says of the picture: classes and values of features.

    Raises
    ------
    QuestionError
        If it is not understood, or states alternatives.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> questions = Questions(load_domain("structure_stability"))
    >>> [str(said) for said in stated(questions, "it leans and the base is narrow")]
    ['lean=yes', 'base=narrow']
    """
    understood = questions.understand(_of_they(text, questions.domain))
    found = _statements(understood)
    if not found:
        raise QuestionError(
            f"'{' '.join(text.split())}' does not state one thing that a picture shows or is; say "
            "for instance " + " · ".join(f"'{said}'" for said in _examples(questions.domain)),
        )
    return found


def new_rule(
    doubted: Doubted, candidate: Candidate, *, sentence: str | None = None
) -> tuple[Proposal, ...]:
    """Propose a rule with what it would change; alternatives within it are a rule each.

    Where rules say otherwise of the scene that ask less, they give way: each gets the exception
    that the new rule names.

    Raises
    ------
    RevisionError
        If the rule can never be used because it contradicts what is known.

    Examples
    --------
    >>> from seewhy.agent.working_knowledge import working_knowledge
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.revision.proposal import texts_of
    >>> known = working_knowledge(load_domain("structure_stability"))
    >>> text = (known.given.folder / "knowledge.al").read_text(encoding="utf-8")
    >>> none = AnnotatedScenes((), (), ())
    >>> doubted = Doubted(known, texts_of(known, text), ("4", "wide", "yes", "no"), none)
    >>> rule = Candidate("unstable", (PathCondition("lean", ("yes",)),
    ...                               PathCondition("num_blocks", ("4",))))
    >>> (proposal,) = new_rule(doubted, rule)
    >>> proposal.statement, proposal.decision.label
    ('-stable(S) if lean(S), num_blocks(S, 4).', 'unstable')
    """
    domain = doubted.known.domain
    found = []
    for conjunction in conjunctions(candidate, domain.schema):
        statement = axiom_statement(conjunction, domain.schema)
        said = sentence or say_rule(domain, conjunction.conditions, conjunction.label)
        edit = axiom_added(doubted.texts[KNOWLEDGE], statement, said)
        about = {"statement": statement, "label": conjunction.label}
        proposal = doubted.judged(Cause.MISSING, said, (edit,), **about)
        applying = replace(doubted, vector=_vector_with(conjunction, doubted))
        if applying.decision.label not in (None, conjunction.label):
            given_way = exceptions_for(applying, conjunction)
            edits = (edit, *(each for rule in given_way for each in rule.edits(doubted)))
            exceptions = tuple(rule.sentence(domain) for rule in given_way)
            if exceptions:
                proposal = (
                    doubted.judged(Cause.MISSING, said, edits, exceptions=exceptions, **about)
                    or proposal
                )
        if proposal is None:
            raise RevisionError(
                f"the rule '{said}' can never be used: whenever it applies, what is known already "
                "says otherwise; say first which rule is wrong"
            )
        found.append(proposal)
    return tuple(found)


def _vector_with(candidate: Candidate, doubted: Doubted) -> FeatureVector:
    """The scene as it would be if a rule applied to it."""
    asked = {condition.feature: condition.values for condition in candidate.conditions}
    return tuple(
        value if key not in asked or value in asked[key] else asked[key][0]
        for key, value in zip(doubted.known.domain.features, doubted.vector, strict=True)
    )


def known_already(known: WorkingKnowledge, candidate: Candidate) -> Axiom | None:
    """Return an axiom that says what a rule says, or says it of more scenes; None without one.

    Examples
    --------
    >>> from seewhy.agent.working_knowledge import working_knowledge
    >>> from seewhy.domain.domain import load_domain
    >>> known = working_knowledge(load_domain("structure_stability"))
    >>> rule = Candidate("unstable", (PathCondition("block_displaced", ("yes",)),
    ...                               PathCondition("lean", ("yes",))))
    >>> known_already(known, rule).identifier
    'a1'
    """
    schema, signature = known.domain.schema, known.domain.knowledge.signature
    (rule, *others) = read_axioms(
        "\n".join(
            axiom_statement(conjunction, schema) for conjunction in conjunctions(candidate, schema)
        ),
        signature,
    )
    if others:
        return None
    asked = {str(condition) for condition in rule.body}
    for axiom in known.domain.knowledge.axioms:
        names = dict(zip(axiom.head.arguments, rule.head.arguments, strict=False))
        body = {str(part.literal.substitute(names)) if part.literal and not part.absent
                else part.text for part in axiom.body}  # fmt: skip
        if axiom.head.substitute(names) == rule.head and axiom.body and body <= asked:
            return axiom
    return None


def rules_by_example(
    domain: Domain, scenes: AnnotatedScenes, examples: Sequence[int], label: str, *, most: int = 3
) -> tuple[Candidate, ...]:
    """Return the smallest rules that cover examples of a class and that no scene speaks against.

    Parameters
    ----------
    domain : Domain
    scenes : AnnotatedScenes
        What is annotated; the examples count as of the class, whatever is annotated of them.
    examples : sequence of int
        The places of the examples among the scenes.
    label : str
        The class.
    most : int, default 3
        At most so many, those first that speak about most scenes of the class.

    Returns
    -------
    tuple of Candidate
        Empty where nothing that the examples have in common tells them from other classes.

    Raises
    ------
    RevisionError
        If there is no example.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> vectors = (("4", "narrow", "yes", "no"), ("5", "wide", "yes", "no"),
    ...            ("4", "wide", "no", "no"))
    >>> scenes = AnnotatedScenes(vectors, ("unstable", "unstable", "stable"), ("", "", ""))
    >>> [rule.conditions for rule in rules_by_example(domain, scenes, [0, 1], "unstable")]
    [(PathCondition(feature='lean', values=('yes',)),)]
    """
    if not examples:
        raise RevisionError("no example is given; choose at least one picture")
    table = _table(domain, scenes, examples, label)
    shared = [
        PathCondition(key, shown)
        for column, (key, feature) in enumerate(domain.features.items())
        if (shown := _shown(feature.values, [scenes.vectors[n][column] for n in examples]))
    ]
    for size in range(1, min(_MOST_CONDITIONS, len(shared)) + 1):
        fitting = [
            candidate
            for chosen in combinations(shared, size)
            if not tally(candidate := Candidate(label, chosen), table).wrong
        ]
        if fitting:
            ranked = sorted(fitting, key=lambda candidate: -tally(candidate, table).right)
            return tuple(ranked[:most])
    whole = Candidate(label, tuple(shared))
    if not shared or tally(whole, table).wrong:
        return ()
    return tuple(most_general([generalised(whole, table, tolerance=0.0)]))


def fit_of(
    domain: Domain, scenes: AnnotatedScenes, candidate: Candidate, examples: Sequence[int] = ()
) -> Fit:
    """Return how a rule fits annotated scenes, and which examples it covers.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> scenes = AnnotatedScenes((("4", "narrow", "yes", "no"), ("2", "wide", "yes", "no")),
    ...                          ("unstable", "stable"), ("a.png", "b.png"))
    >>> leans = Candidate("unstable", (PathCondition("lean", ("yes",)),))
    >>> fit_of(domain, scenes, leans, [0])
    Fit(covered=(0,), missed=(), against=(1,))
    """
    table = _table(domain, scenes, examples, candidate.label)
    rows = table.satisfying(candidate.conditions)
    spoken = {n for row in rows.nonzero()[0].tolist() for n in table.scenes[row]}
    against = (
        n for n in sorted(spoken.difference(examples)) if scenes.labels[n] != candidate.label
    )
    return Fit(
        tuple(n for n in examples if n in spoken),
        tuple(n for n in examples if n not in spoken),
        tuple(against),
    )


def _table(
    domain: Domain, scenes: AnnotatedScenes, examples: Sequence[int], label: str
) -> SceneTable:
    features = {key: feature.values for key, feature in domain.features.items()}
    labels = list(scenes.labels)
    for n in examples:
        labels[n] = label
    return scene_table(features, scenes.vectors, labels)


def _shown(values: Sequence[str], shown: Sequence[str | None]) -> tuple[str, ...]:
    """The values that examples show of a feature; none where one of them shows none, or all."""
    found = tuple(value for value in values if value in shown)
    return () if None in shown or len(found) == len(values) else found


def _of_they(text: str, domain: Domain) -> str:
    """A text about several pictures ("these three apples are …") as one about "they"."""
    several = {domain.scene.replace("_", " ") + "s", *_PICTURES, *NUMBERS, "all"}
    counted = "|".join((*map(re.escape, sorted(several)), r"\d+"))
    return re.sub(
        rf"^\s*(?:all (?:of )?)?(?:these|those|they)(?: (?:{counted}))*(?= )",
        "they",
        text.casefold(),
    )


def _statements(understood: Question) -> tuple[Statement, ...]:
    if understood.asks is Asks.IS_CLASS:
        return (Statement(label=understood.label),)
    if understood.asks is Asks.FEATURE_IS:
        return (Statement(feature=understood.feature, value=understood.value),)
    return understood.statements if understood.asks is Asks.ALL else ()


def _examples(domain: Domain) -> tuple[str, ...]:
    label = next(iter(domain.classes.values())).say
    feature = next(iter(domain.features.values()))
    return f"it is {label}", next(iter(feature.say.values())).replace("{it}", "it")
