"""Tell a justification as prose: the answer to "please explain this answer"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.dialogue.answer import SLOTS, answer_templates
from seewhy.dialogue.antecedent import say_values, supposed_values
from seewhy.dialogue.certainty import (
    Certainty,
    Ground,
    certainty_of,
    least_sure_told,
    weakest,
)
from seewhy.dialogue.reply import Reply
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import join_words, say_features, sentence
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.justification import Basis, Node
from seewhy.text.slots import filled


def narrate(domain: Domain, reply: Reply) -> str:
    """Return the steps behind a reply: what was seen, what it implies, by which axiom or path."""
    justification = reply.justification
    supposition = supposed_values(reply.kind)
    features = [key for key in justification.features() if key not in supposition]
    parts = [f"you asked: {reply.question.text}?"] if reply.question.text else []
    if supposition:
        parts.append(f"suppose that {say_values(domain, supposition)}")
    if reply.supposed is not None:
        taken, supposed = (
            domain.classes[classification.label or ""].say
            for classification in (reply.classification, reply.supposed)
        )
        parts.append(
            f"I took {domain.subject} to be {taken}; what follows supposes that it is {supposed}"
        )
    seen = say_features(domain, reply.scene.vector, features)
    if seen:
        # An absence may rest on what is not known.
        known = [feature for feature in features if feature in reply.features]
        sure = [reply.features[feature].probability for feature in known]
        each = "each with a probability of at least" if len(sure) > 1 else "with a probability of"
        adverb = certainty_of(least_sure_told(None, reply.scene, justification)).adverb
        begun = f"{adverb} {seen}" if adverb else f"I see that {seen}"
        told = f"I was told that {seen}"
        parts.append(told if reply.scene.told else f"{begun} ({each} {min(sure):.2f})")
    steps = _steps(justification, _Said(justification, _class_ground(reply)))
    if supposition and steps:
        steps[0] = f"then {steps[0]}"
    parts += steps
    if reply.kind.form == "no_belief":
        parts.append(justification.text)
    if reply.kind.form in ("undecided", "several", "contradictory"):
        parts.append("there were no such scenes to learn from either")
    told = " ".join(sentence(part) for part in parts)
    return filled(
        answer_templates(domain)["explain"],
        {**dict.fromkeys(SLOTS, ""), "it": domain.subject, "explanation": told},
    )


def _class_ground(reply: Reply) -> Ground | None:
    """How probable the class is, where it is not supposed."""
    scene = reply.scene
    if scene.label is None or scene.probability is None or reply.supposed is not None:
        return None
    return Ground(CLASS, scene.label, scene.probability)


@dataclass(frozen=True)
class _Said:
    """How surely each step of a justification may be said.

    Each is no surer than what it needs, and what the whole comes to no surer than the class.
    """

    whole: Node
    known: Ground | None

    def clause(self, node: Node) -> str:
        """The clause of a belief, with the word that says that it is not sure."""
        grounds = [weakest(node), self.known if node.literal == self.whole.literal else None]
        found = {certainty_of(ground) for ground in grounds}
        worst = max(found, key=list(Certainty).index)
        return f"{worst.adverb} {node.text}".strip()

    def missing(self, nodes: Sequence[Node]) -> str:
        """The word in front of what follows from conditions that all fail; one is enough."""
        best = max(nodes, key=lambda node: 1.0 if node.probability is None else node.probability)
        if best.probability is None:
            return ""
        adverb = certainty_of(Ground("", "", best.probability)).adverb
        return f"{adverb} " if adverb else ""


def _steps(node: Node, said: _Said) -> list[str]:
    tree = next((descendant for descendant in node.walk() if descendant.basis is Basis.TREE), None)
    if tree is not None:
        path, *learned, undecided = tree.children
        concluded = said.clause(tree)
        return [
            _why_undecided(undecided),
            f"so the decision tree is asked: {path.text}",
            # The path says what is so of such scenes; of this one it may not be sure.
            *([concluded] if concluded != tree.text else []),
            *(child.text for child in learned),
            *_axioms(node, said),
        ]
    if node.literal in ("undecided", "unknown") or node.basis is Basis.CONFLICT:
        return [_why_undecided(node)]
    steps = _axioms(node, said)
    refused = [child for child in node.children if child.is_refuted]
    steps += [step for child in refused[:3] for step in _not_applying(child, said)]
    steps += [child.text for child in node.children if child.basis in (Basis.PATH, Basis.PICTURES)]
    return list(dict.fromkeys(steps))


def _not_applying(refused: Node, said: _Said) -> list[str]:
    """That an axiom does not apply, with what is missing."""
    missing = [condition for condition in refused.children if not condition.holds]
    if refused.axiom is None or not missing:
        return []
    why = join_words([condition.text for condition in missing])
    return [f'{said.missing(missing)}the axiom "{refused.axiom.text}" does not apply, since {why}']


def _axioms(node: Node, said: _Said) -> list[str]:
    """The axioms that were used, what others rest on first; those of a tree's path are its own."""
    steps: list[str] = []
    for child in () if node.basis is Basis.TREE else node.children:
        if node.holds and child.is_refuted:
            steps += _not_applying(child, said)
        else:
            steps += _axioms(child, said)
    told = node.holds or node.basis is Basis.OTHERWISE
    if told and node.axiom is not None and _says_more(node.axiom):
        if node.basis is Basis.EXCEPTION:
            steps.append(f'{said.clause(node)}, though "{node.axiom.text}"')
        else:
            steps.append(f'{said.clause(node)}, because "{node.axiom.text}"')
    return list(dict.fromkeys(steps))


def _why_undecided(node: Node) -> str:
    if node.basis is Basis.CONFLICT:
        axioms = [n.axiom for n in node.walk() if n.axiom is not None and _says_more(n.axiom)]
        sides = list(dict.fromkeys(f'"{axiom.text}"' for axiom in axioms))
        if any(child.basis is Basis.FEATURE for child in node.children):
            agree = "do" if len(sides) > 1 else "does"
            return f"{node.text}: {join_words(sides)} {agree} not agree with what is seen"
        which = "all" if len(sides) > 2 else "both"
        return f"{node.text}: {join_words(sides)} cannot {which} hold"
    return node.text


def _says_more(axiom: Axiom) -> bool:
    """Whether an axiom says more than that its head is so, as facts without a sentence do not."""
    return bool(axiom.body) or axiom.has_sentence
