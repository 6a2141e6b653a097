"""Answer types: what an answer says, apart from the picture's values and the wording.

An answer type is what the recurrent network's softmax ranges over. The same types come out of
reasoning, so that both ways of answering are worded and scored alike.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from urllib.parse import unquote

from seewhy.dialogue.question import Question
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, say_features, say_open, sentence
from seewhy.errors import DomainError
from seewhy.files.toml_file import line_of
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.nearest import did_you_mean
from seewhy.text.slots import filled, wrong_slot
from seewhy.text.visible import visible

Changes = tuple[tuple[str, str], ...]
"""What would have to change: (feature, new value) pairs."""
SLOTS = (
    "it", "reasons", "changes", "asked", "class", "explanation", "scene", "required", "belief",
    "name", "value", "probably", "open",
)  # fmt: skip
"""What the wording of an answer may speak of; see answers.toml."""
_MOST_CLASSES_NAMED = 4


@dataclass(frozen=True)
class AnswerType:
    """The form of an answer, the features that it mentions, the changes that it proposes.

    ``values`` are what is believed, where the answer tells the value of a static. ``has_more`` says
    that there are further changes as small as ``changes``; types that differ in it are one.

    Examples
    --------
    >>> kind = AnswerType(form="reasons", mentions=("base", "lean"))
    >>> kind.identifier
    'reasons(base,lean)'
    >>> AnswerType.parse(kind.identifier) == kind
    True
    >>> AnswerType(form="change", changes=((("lean", "no"),),)).identifier
    'change()[lean=no]'
    >>> AnswerType(form="belief", values=("stop",)).identifier
    'belief(){stop}'
    >>> AnswerType(form="belief", values=('"a|b"',)).identifier
    'belief(){"a%7Cb"}'
    """

    form: str
    mentions: tuple[str, ...] = ()
    changes: tuple[Changes, ...] = ()
    values: tuple[str, ...] = ()
    has_more: bool = field(default=False, compare=False)

    @property
    def identifier(self) -> str:
        """The type as one string, the name of its output of the softmax."""
        alternatives = "".join(
            f"[{'&'.join(f'{feature}={_escaped(value)}' for feature, value in change)}]"
            for change in self.changes
        )
        believed = f"{{{'|'.join(map(_escaped, self.values))}}}" if self.values else ""
        return f"{self.form}({','.join(self.mentions)}){alternatives}{believed}"

    @staticmethod
    def parse(identifier: str) -> AnswerType:
        """Return the type that an identifier names.

        Raises
        ------
        ValueError
            It names none.
        """
        found = _IDENTIFIER.fullmatch(identifier)
        if found is None:
            raise ValueError(f"'{visible(identifier)}' names no type of answer")
        form, mentions, alternatives, believed = found.groups(default="")
        changes = tuple(
            tuple(
                (feature, unquote(value))
                for feature, _, value in (pair.partition("=") for pair in part.split("&"))
            )
            for part in alternatives[1:-1].split("][")
            if part
        )
        return AnswerType(
            form,
            tuple(filter(None, mentions.split(","))),
            changes,
            tuple(unquote(value) for value in believed.split("|") if value),
        )


_IDENTIFIER = re.compile(
    r"(\w+)\(([^(){}\[\]&=|]*)\)((?:\[[^(){}\[\]|,]*\])*)(?:\{([^(){}\[\]&=,]*)\})?"
)


def _escaped(value: str) -> str:
    """A value without the characters that divide an identifier."""
    return re.sub(r"[%(){}\[\]&=|,]", lambda found: f"%{ord(found.group()):02X}", value)


def word_answer(
    domain: Domain,
    question: Question,
    kind: AnswerType,
    *,
    vector: FeatureVector,
    label: str | None,
    probably: str = "",
) -> str:
    """Return an answer as a sentence: the type's template with the picture's values filled in.

    ``probably`` is the word that says that it is not sure; empty where it is.

    Examples
    --------
    >>> from seewhy.dialogue.question import Questions
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> question = Questions(domain).understand("why is it stable?")
    >>> word_answer(domain, question, AnswerType("reasons", ("base",)),
    ...             vector=("2", "wide", "no", "no"), label="stable")
    'The structure has a wide base.'
    >>> word_answer(domain, question, AnswerType("reasons", ("base",)), probably="perhaps",
    ...             vector=("2", "wide", "no", "no"), label="stable")
    'Perhaps because the structure has a wide base.'
    """
    form = kind.form
    if not any(domain.named(vector)[feature] for feature in kind.mentions):
        form = _WITHOUT_REASONS.get(form, form)
    template = _template(domain, form, unsure=bool(probably))
    # "The structure is stable, since it has …": the subject is named once.
    subject = "it" if "{it}" in template else None
    asked = _say_asked(domain, question)
    reasons = say_features(domain, vector, kind.mentions, subject=subject)
    said = filled(
        template,
        {
            "it": domain.subject,
            "reasons": reasons,
            "changes": _say_changes(domain, kind.changes),
            "asked": asked,
            "class": _say_class(domain, kind, label),
            "explanation": reasons,
            "scene": domain.scene.replace("_", " "),
            # "A stop sign is octagonal; the sign is …", "It is a stop sign when it is octagonal …".
            "required": _say_required(
                domain, kind.changes, subject="it" if "{asked}" in template else asked
            ),
            "probably": probably,
            **_say_belief(domain, question, kind),
        },
    )
    if kind.has_more:
        said = f"{said.rstrip(' .')}; {_OTHER_WAYS[kind.form]}"
    return sentence(" ".join(said.split()))


_OTHER_WAYS = {
    "change": "there are other ways as small",
    "difference": "there are other differences as small",
}
_WITHOUT_REASONS = {
    "reasons": "no_reasons",
    **{form: f"{form}_bare" for form in ("false_premise", "denied_not", "against", "difference")},
}
"""Forms that tell reasons, and what is said where there is none to tell."""


def _template(domain: Domain, form: str, *, unsure: bool) -> str:
    """The wording of a form; one that a domain words for itself is made unsure by a first word."""
    templates, reworded = answer_templates(domain), domain.questions.answers
    if not unsure:
        return templates[form]
    if form in reworded and f"{form}_unsure" not in reworded:
        wording = reworded[form]
        return wording if "{probably}" in wording else f"{{probably}}, {wording}"
    return templates[f"{form}_unsure"]


def word_supposed(
    domain: Domain, question: Question, answer: str, *, label: str, supposed: str
) -> str:
    """Return an answer that supposes what a question presumes, and says that it does.

    Parameters
    ----------
    domain : Domain
    question : Question
    answer : str
        The answer to the question, if the scene is of the class ``supposed``.
    label, supposed : str
        What the scene is taken to be, and what it is supposed to be.

    Examples
    --------
    >>> from seewhy.dialogue.question import Questions
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> question = Questions(domain).understand("why is it unstable?")
    >>> word_supposed(domain, question, "It leans.", label="stable", supposed="unstable")
    'I took the structure to be stable. If it is unstable, as you say: it leans.'
    """
    presumed = question.label == supposed
    said = filled(
        answer_templates(domain)["supposed" if presumed else "supposed_not"],
        {
            **dict.fromkeys(SLOTS, ""),
            "it": domain.subject,
            "asked": _say_asked(domain, question),
            "class": domain.classes[label if presumed else supposed].say,
            "explanation": f"{answer[:1].lower()}{answer[1:]}",
        },
    )
    return sentence(said)


def _say_asked(domain: Domain, question: Question) -> str:
    if question.label:
        return domain.classes[question.label].say
    classes = [scene_class.say for scene_class in domain.classes.values()]
    if len(classes) > _MOST_CLASSES_NAMED:
        classes = [*classes[:2], f"one of {len(classes) - 2} others"]
    return join_words(classes, word="or")


def _say_class(domain: Domain, kind: AnswerType, label: str | None) -> str:
    """The class of the picture, or all that are concluded of it."""
    if kind.form == "several":
        return "both " * (len(kind.values) == 2) + join_words(
            [domain.classes[key].say for key in kind.values]
        )
    return domain.classes[label].say if label else "undecided"


def _say_required(domain: Domain, alternatives: tuple[Changes, ...], *, subject: str) -> str:
    said = [
        say_features(
            domain, domain.vector(dict(change)), [feature for feature, _ in change], subject=subject
        )
        for change in alternatives
    ]
    return ", or ".join(said)


def _say_belief(domain: Domain, question: Question, kind: AnswerType) -> dict[str, str]:
    belief = domain.beliefs.get(question.predicate or "")
    if belief is None:
        name = domain.features[question.feature].name if question.feature else ""
        return {"belief": "", "name": name, "value": "", "open": ""}
    value = join_words([belief.words.get(value, value) for value in kind.values])
    said = filled(belief.say, {"it": domain.subject, "value": value})
    open_clause = say_open(domain, belief)
    return {"belief": said, "name": belief.name, "value": value, "open": open_clause}


def _say_changes(domain: Domain, alternatives: tuple[Changes, ...]) -> str:
    said = [
        join_words([_say_change(domain, feature, value) for feature, value in change])
        for change in alternatives
    ]
    return join_words(said, word="or") if len(said) < 2 else ", or ".join(said)


def _say_change(domain: Domain, feature: str, value: str) -> str:
    declared = domain.features[feature]
    said = value.replace("_", " ")
    return declared.change.get(value, f"let the {declared.name} be {said}").replace("{it}", "it")


@cache
def default_answer_templates() -> dict[str, str]:
    """Return how every form of answer is worded where a domain says nothing else.

    Examples
    --------
    >>> default_answer_templates()["yes_class"]
    'yes, {it} is {class}'
    """
    text = resources.files("seewhy.dialogue").joinpath("answers.toml").read_text(encoding="utf-8")
    return dict(tomllib.loads(text))


def answer_templates(domain: Domain) -> dict[str, str]:
    """Return the wording of every form of answer, the domain's own before the default.

    Raises
    ------
    DomainError
        Where questions.toml words a form that does not exist, or with an unknown slot.
    """
    defaults = default_answer_templates()
    path = domain.folder / "questions.toml"
    for form, template in domain.questions.answers.items():
        if form not in defaults:
            line = line_of(path.read_text(encoding="utf-8"), ["answers", form])
            raise DomainError(
                f"{path}:{line}: '{form}' is no form of answer; {did_you_mean(form, defaults)}"
            )
        wrong = wrong_slot(template, SLOTS)
        if wrong is not None:
            line = line_of(path.read_text(encoding="utf-8"), ["answers", form])
            raise DomainError(
                f"{path}:{line}: the answer '{form}' has '{wrong}', which is no slot; there are "
                f"{', '.join('{' + slot + '}' for slot in SLOTS)}"
            )
    return {**defaults, **domain.questions.answers}
