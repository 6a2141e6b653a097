"""What a phrase of a question states: a statement, and whether it is denied."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from seewhy.dialogue.asked import Statement
from seewhy.dialogue.grammar import Binding, Fold

__all__ = ["Said", "all_said", "companion_of_the_absent", "folds", "roles", "stated"]


@dataclass(frozen=True)
class Said:
    """A statement as it was said, and whether it was denied."""

    statement: Statement
    denied: bool = False
    forward: bool = False
    """Whether the "not" stands before the subject ("isn't it …"), which asks the same."""
    named: bool = False
    """Whether it was only named, and what is said of it follows."""
    replaced: bool = False
    """Whether something else is said instead of it."""
    beside: bool = False
    """Whether it is only said to be with, or without, what was said before."""
    verbless: bool = False
    """Whether it is named without a verb, and has the one of what was said before."""
    denied_by: str = ""
    """How it was denied: "gone" of what is away, "none" of what there is none of."""


_STATEMENTS = (
    "stated", "asserted", "left", "because", "making", "because_bare", "opposed", "supposed",
    "supposed_more", "other_one", "surely", "located", "group_state",
    "goal", "avoided", "one_value", "first_existing", "existing_too", "deny_one", "deny_other",
    "pair_rest", "lacking", "pair_two", "fragment_named",
    "supposed_kind", "first_doing", "other_doing", "denied_too", "other_class", "supposed_object",
    "no_object", "half", "inverted", "footing", "avoided_form",
    "goal_verb", "cause", "concluded", "matter_of", "matter_clause", "because_so", "left_claimed",
    "because_claimed", "because_told", "gone_too",
)  # fmt: skip

_BESIDE = ("equipment", "unequipped", "possessed", "dispossessed")
_ROLES: dict[str, Fold] = {
    name: lambda _, name=name, role=role: ((Binding(role, name),),)  # type: ignore[misc]
    for name, role in {
        "not": "denied", "none": "denied", "without": "denied", "not_longer": "denied",
        "gone": "denied", "taking": "denied", "put_back": "denied", "back": "denied",
        "free_of": "denied", "nothing": "denied", "fore": "forward", "asking_tag": "asking_tag",
        "asking_there": "asking_tag", "but": "but",
    }.items()
}  # fmt: skip


def folds() -> dict[str, Fold]:
    """Return what the bindings inside of a phrase come to, by the phrase's name."""
    return {
        **dict.fromkeys(_STATEMENTS, _folded),
        **_ROLES,
        **dict.fromkeys(_BESIDE, _folded_beside),
        "existing_named": _folded_named,
        "named_only": _folded_verbless,
        "existing_absent": _folded_verbless,
        "absent_named": _folded_verbless,
        "not_named": _folded_verbless,
        "neither_of": _folded_neither,
        "taken_away": _folded_neither,
        "unequipped_both": _folded_neither,
        "both_gone": _folded_neither,
        "either_gone": _folded_neither,
        "supposed_class": _folded_class,
        "parts_alike": _folded_parts,
        "replaced": _folded_replaced,
    }


def stated(fact: object) -> Statement:
    """Return the statement that a word of the lexicon stands for."""
    assert isinstance(fact, tuple)
    feature, value = fact
    return Statement(feature=feature, value=value)


def all_said(bindings: Iterable[Binding]) -> list[Said]:
    """Return what is stated, in the order in which it is said."""
    return [binding.meaning for binding in bindings if isinstance(binding.meaning, Said)]


def roles(bindings: Iterable[Binding], role: str) -> list[str]:
    """Return what the bindings of one role mean, in their order."""
    return [str(binding.meaning) for binding in bindings if binding.role == role]


def _folded(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is stated by a phrase, where its parts go together."""
    said = _said_in(bindings)
    rest = tuple(
        binding
        for binding in bindings
        if binding.role in ("feature", "group", "said", "counts", "supposed_class")
    )
    if said is None:
        return
    if said == ():
        if any(binding.role in ("fact", "label", "about") for binding in bindings):
            return
        yield rest
        return
    kept = tuple(binding for binding in bindings if binding.role == "said")
    yield (*kept, *(Binding("said", clause) for clause in said))


def _folded_beside(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What something else is with, or without."""
    for folded in _folded(bindings):
        yield tuple(
            Binding("said", replace(binding.meaning, beside=True))
            if isinstance(binding.meaning, Said)
            else binding
            for binding in folded
        )


def companion_of_the_absent(said: Iterable[Said]) -> bool:
    """Whether something is said to be with what is not there, as in "if Bob left with Sally".

    Who leaves with somebody is gone as well, and who leaves without stays or not.
    """
    before = False
    for spoken in said:
        if spoken.beside and before:
            return True
        before = spoken.denied and spoken.statement.feature is not None
    return False


def _folded_named(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is named first of two things of which the same is said."""
    for said in _said_in(bindings) or ():
        yield (Binding("said", replace(said, named=True)),)


def _folded_verbless(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is named without a verb; what else its words may state stays as it is."""
    for folded in _folded(bindings):
        yield tuple(
            Binding("said", replace(binding.meaning, verbless=True))
            if isinstance(binding.meaning, Said)
            else binding
            for binding in folded
        )


def _folded_class(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """A class that is supposed, which nothing can be concluded from."""
    yield tuple(Binding("supposed_class", label) for label in roles(bindings, "label")[:1])


def _folded_neither(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is denied of each by "neither … nor …"."""
    yield tuple(
        Binding("said", replace(said, denied=not said.denied)) for said in all_said(bindings)
    )


def _folded_parts(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is said of several parts at once; the state is read as the first part's."""
    parts = roles(bindings, "about")
    denied = any(binding.role == "denied" for binding in bindings)
    for statement in (stated(binding.meaning) for binding in bindings if binding.role == "fact"):
        if statement.feature == parts[0]:
            yield tuple(
                Binding("said", Said(replace(statement, feature=part), denied)) for part in parts
            )


def _folded_replaced(bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
    """What is named behind "instead of"."""
    for said in _said_in(bindings) or ():
        yield (Binding("said", replace(said, denied=True, replaced=True)),)


def _said_in(bindings: tuple[Binding, ...]) -> tuple[Said, ...] | None:
    """The one statement of a phrase; () where it states nothing, None where it is none."""
    facts = [binding.meaning for binding in bindings if binding.role == "fact"]
    labels = list(dict.fromkeys(binding.meaning for binding in bindings if binding.role == "label"))
    about = {binding.meaning for binding in bindings if binding.role in ("feature", "about")}
    denials = [str(binding.meaning) for binding in bindings if binding.role == "denied"]
    denied = len(denials) % 2 == 1
    denied_by = denials[0] if len(denials) == 1 else ""
    forward = any(binding.role == "forward" for binding in bindings)
    if not facts and not labels:
        return ()
    if len(facts) + len(labels) > 1:
        return None
    if labels:
        if about:
            return None
        return (Said(Statement(label=str(labels[0])), denied, forward, denied_by=denied_by),)
    statement = stated(facts[0])
    if about - {statement.feature}:
        return None
    return (Said(statement, denied, forward, denied_by=denied_by),)
