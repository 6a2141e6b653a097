"""Answer types: what an answer says, apart from the picture's values and the wording.

An answer type is what the recurrent network's softmax ranges over. The same types come out of
reasoning, so that both ways of answering are worded and scored alike.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources

from seewhy.dialogue.question import Question
from seewhy.domain import Domain
from seewhy.errors import DomainError
from seewhy.knowledge.scene import FeatureVector
from seewhy.nearest import did_you_mean
from seewhy.toml_file import line_of
from seewhy.wording import join_words, say_features, sentence

Changes = tuple[tuple[str, str], ...]
"""What would have to change: (feature, new value) pairs."""


@dataclass(frozen=True)
class AnswerType:
    """The form of an answer, the features that it mentions, the changes that it proposes.

    Examples
    --------
    >>> kind = AnswerType(form="reasons", mentions=("base", "lean"))
    >>> kind.identifier
    'reasons(base,lean)'
    >>> AnswerType.parse(kind.identifier) == kind
    True
    >>> AnswerType(form="change", changes=((("lean", "no"),),)).identifier
    'change()[lean=no]'
    """

    form: str
    mentions: tuple[str, ...] = ()
    changes: tuple[Changes, ...] = ()

    @property
    def identifier(self) -> str:
        """The type as one string, the name of its output of the softmax."""
        alternatives = "".join(
            f"[{'&'.join(f'{feature}={value}' for feature, value in change)}]"
            for change in self.changes
        )
        return f"{self.form}({','.join(self.mentions)}){alternatives}"

    @staticmethod
    def parse(identifier: str) -> AnswerType:
        """Return the type that an identifier names."""
        form, rest = identifier.split("(", 1)
        mentions, _, alternatives = rest.partition(")")
        changes = tuple(
            tuple((pair.split("=", 1)[0], pair.split("=", 1)[1]) for pair in part.split("&"))
            for part in alternatives.strip("[]").split("][")
            if part
        )
        return AnswerType(form, tuple(filter(None, mentions.split(","))), changes)


def word_answer(
    domain: Domain,
    question: Question,
    kind: AnswerType,
    *,
    vector: FeatureVector,
    label: str | None,
) -> str:
    """Return an answer as a sentence: the type's template with the picture's values filled in.

    Examples
    --------
    >>> from seewhy.dialogue.question import Questions
    >>> from seewhy.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> question = Questions(domain).understand("why is it stable?")
    >>> word_answer(domain, question, AnswerType("reasons", ("base",)),
    ...             vector=("2", "wide", "no", "no"), label="stable")
    'The structure has a wide base.'
    """
    templates = answer_templates(domain)
    form = kind.form
    # "The structure is stable, since it has …": the subject is named once.
    subject = "it" if "{it}" in templates[form] else None
    reasons = say_features(domain, vector, kind.mentions, subject=subject)
    if not reasons and f"{form}_bare" in templates:
        form = f"{form}_bare"
    elif not reasons and form == "reasons":
        form = "no_reasons"
    said = templates[form].format(
        it=domain.subject,
        reasons=reasons,
        changes=_say_changes(domain, kind.changes),
        asked=(
            domain.classes[question.label].say
            if question.label
            else join_words([own.say for own in domain.classes.values()], word="or")
        ),
        **{"class": domain.classes[label].say if label else "undecided"},
        explanation=reasons,
    )
    return sentence(said)


def _say_changes(domain: Domain, alternatives: tuple[Changes, ...]) -> str:
    said = [
        join_words([_say_change(domain, feature, value) for feature, value in change])
        for change in alternatives
    ]
    return join_words(said, word="or") if len(said) < 2 else ", or ".join(said)


def _say_change(domain: Domain, feature: str, value: str) -> str:
    own = domain.features[feature]
    return own.change.get(value, f"let the {own.name} be {value}").replace("{it}", "it")


@cache
def _defaults() -> dict[str, str]:
    text = resources.files("seewhy.dialogue").joinpath("answers.toml").read_text(encoding="utf-8")
    return dict(tomllib.loads(text))


def answer_templates(domain: Domain) -> dict[str, str]:
    """Return the wording of every form of answer, the domain's own before the default.

    Raises
    ------
    DomainError
        Where questions.toml words a form that does not exist, or with an unknown slot.
    """
    defaults = _defaults()
    path = domain.folder / "questions.toml"
    for form, template in domain.questions.answers.items():
        if form not in defaults:
            line = line_of(path.read_text(encoding="utf-8"), ["answers", form])
            raise DomainError(
                f"{path}:{line}: '{form}' is no form of answer; {did_you_mean(form, defaults)}"
            )
        slots = ("it", "reasons", "changes", "asked", "class", "explanation")
        try:
            template.format(**dict.fromkeys(slots, ""))
        except (AttributeError, KeyError, IndexError, TypeError, ValueError):
            line = line_of(path.read_text(encoding="utf-8"), ["answers", form])
            raise DomainError(
                f"{path}:{line}: the answer '{form}' uses a slot that does not exist; there are "
                f"{', '.join('{' + slot + '}' for slot in slots)}"
            ) from None
    return {**defaults, **domain.questions.answers}
