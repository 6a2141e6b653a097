"""Tell a justification as prose: the answer to "please explain this answer"."""

from __future__ import annotations

from seewhy.dialogue.answer import SLOTS, answer_templates
from seewhy.domain import Domain
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.justification import Basis, Node
from seewhy.reply import Reply
from seewhy.wording import join_words, say_features, sentence


def narrate(domain: Domain, reply: Reply) -> str:
    """Return the steps behind a reply: what was seen, what it implies, by which axiom or path."""
    justification = reply.justification
    features = justification.features()
    parts = [f"you asked: {reply.question.text}?"] if reply.question.text else []
    if reply.supposed is not None:
        taken, supposed = (
            domain.classes[own.label or ""].say for own in (reply.classification, reply.supposed)
        )
        parts.append(
            f"I took {domain.subject} to be {taken}; what follows supposes that it is {supposed}"
        )
    seen = say_features(domain, reply.scene.vector, features)
    if seen:
        sure = [reply.features[feature].probability for feature in features]
        each = "each with a probability of at least" if len(sure) > 1 else "with a probability of"
        parts.append(f"I see that {seen} ({each} {min(sure):.2f})")
    parts += _steps(justification)
    if reply.kind.form == "no_belief":
        parts.append(justification.text)
    if reply.kind.form == "undecided":
        parts.append("there were no such scenes to learn from either")
    told = " ".join(sentence(part) for part in parts)
    return answer_templates(domain)["explain"].format(
        **{**dict.fromkeys(SLOTS, ""), "it": domain.subject, "explanation": told}
    )


def _steps(node: Node) -> list[str]:
    tree = next((own for own in node.walk() if own.basis is Basis.TREE), None)
    if tree is not None:
        path, *learned, undecided = tree.children
        return [
            _why_undecided(undecided),
            f"so the decision tree is asked: {path.text}",
            *(own.text for own in learned),
            *_axioms(node),
        ]
    if node.literal in ("undecided", "unknown") or node.basis is Basis.CONFLICT:
        return [_why_undecided(node)]
    steps = _axioms(node)
    refused = [n for n in node.children if not n.holds and n.axiom is not None]
    for child in refused[:3]:
        assert child.axiom is not None
        missing = [c.text for c in child.children if not c.holds]
        if missing:
            steps.append(
                f'the axiom "{child.axiom.text}" does not apply, since {join_words(missing)}'
            )
    return list(dict.fromkeys(steps))


def _axioms(node: Node) -> list[str]:
    """The axioms that were used, what others rest on first; those of a tree's path are its own."""
    steps = [] if node.basis is Basis.TREE else [s for c in node.children for s in _axioms(c)]
    if node.holds and node.axiom is not None and _says_more(node.axiom):
        steps.append(f'{node.text}, because "{node.axiom.text}"')
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
    return bool(axiom.body) or axiom.text != str(axiom).rstrip(".")
