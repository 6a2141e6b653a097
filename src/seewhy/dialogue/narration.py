"""Tell a justification as prose: the answer to "please explain this answer"."""

from __future__ import annotations

from seewhy.domain import Domain
from seewhy.knowledge.justification import Basis, Node
from seewhy.reply import Reply
from seewhy.wording import join_words, say_features, sentence


def narrate(domain: Domain, reply: Reply) -> str:
    """Return the steps behind a reply: what was seen, what it implies, by which axiom or path."""
    justification = reply.justification
    features = justification.features()
    parts = [f"you asked: {reply.question.text}?"] if reply.question.text else []
    seen = say_features(domain, reply.classification.vector, features)
    if seen:
        sure = [reply.features[feature].probability for feature in features]
        each = "each with a probability of at least" if len(sure) > 1 else "with a probability of"
        parts.append(f"I see that {seen} ({each} {min(sure):.2f})")
    parts += _steps(justification)
    if reply.kind.form == "undecided":
        parts.append("there were no such scenes to learn from either")
    return " ".join(sentence(part) for part in parts)


def _steps(node: Node) -> list[str]:
    if node.basis is Basis.TREE:
        path, answer, undecided = node.children
        return [
            _why_undecided(undecided),
            f"so the decision tree is asked: {path.text}",
            answer.text,
        ]
    if node.literal == "undecided" or node.basis is Basis.CONFLICT:
        return [_why_undecided(node)]
    believed = [n for n in node.walk() if n.holds and n.axiom is not None]
    refused = [n for n in node.children if not n.holds and n.axiom is not None]
    steps = [f'{n.text}, because "{n.axiom.text}"' for n in believed if n.axiom is not None]
    for child in refused[:3]:
        assert child.axiom is not None
        missing = [c.text for c in child.children if not c.holds]
        if missing:
            steps.append(
                f'the axiom "{child.axiom.text}" does not apply, since {join_words(missing)}'
            )
    return list(dict.fromkeys(steps))


def _why_undecided(node: Node) -> str:
    if node.basis is Basis.CONFLICT:
        sides = [f'"{n.axiom.text}"' for n in node.walk() if n.axiom is not None]
        return f"{node.text}: {join_words(list(dict.fromkeys(sides)))} cannot both hold"
    return node.text
