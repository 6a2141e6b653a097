"""What the phrases of the grammar come to: conditions, descriptions and references."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.things import query
from seewhy.dialogue.things.chart import Fold

__all__ = ["PHRASES", "all_of", "meanings", "settled"]

Bindings = tuple[Binding, ...]


def meanings(bindings: Bindings, role: str) -> list[object]:
    """Return what stands in a role, in order."""
    return [binding.meaning for binding in bindings if binding.role == role]


def _one(bindings: Bindings, role: str) -> object | None:
    found = meanings(bindings, role)
    return found[0] if found else None


def _conditions(bindings: Bindings) -> tuple[query.Condition, ...]:
    return tuple(meanings(bindings, "condition"))  # type: ignore[arg-type]


def _condition(condition: query.Condition) -> Bindings:
    return (Binding("condition", condition),)


def all_of(conditions: Sequence[query.Condition]) -> query.Condition:
    """Return several conditions as one."""
    return conditions[0] if len(conditions) == 1 else query.All(tuple(conditions))


def settled(
    description: query.Description, antecedent: query.Reference | None = None
) -> query.Description:
    """Return a description in which "other" is other than what it speaks of.

    That is the first thing that its conditions refer to, or else what was spoken of before; where
    there is neither, it says nothing.
    """
    if query.Apart(None) not in description.conditions:
        return description
    others = [c for c in description.conditions if c != query.Apart(None)]
    referred = [reference for condition in others for reference in query.references_in(condition)]
    anchor = referred[0] if referred else antecedent
    apart = () if anchor is None else (query.Apart(anchor),)
    return query.Description((*others, *apart), description.selection, description.many)


def _apart(_: Bindings) -> Bindings:
    return _condition(query.Apart(None))


def _described(bindings: Bindings) -> Bindings:
    many = meanings(bindings, "many")
    described = query.Description(_conditions(bindings), many=bool(many and many[-1]))
    return (Binding("described", described),)


def _any_of(bindings: Bindings) -> Bindings:
    return _condition(query.AnyOf(_conditions(bindings)))


def _two_kinds(bindings: Bindings) -> Bindings | None:
    """Two adjectives before things: red and green ones are of either, small red ones are both."""
    found = _conditions(bindings)
    features = {c.feature for c in found if isinstance(c, query.HasValue)}
    return _any_of(bindings) if len(features) == 1 else None


def _noun_of(bindings: Bindings) -> Bindings:
    """ "Pieces of fruit": what it is, is said by the second, how many by the first."""
    many = meanings(bindings, "many")
    named = tuple(binding for binding in bindings if binding.role == "condition")
    return (*named, Binding("many", bool(many[0])))


def _less(bindings: Bindings) -> Bindings | None:
    compared = _one(bindings, "compared")
    if not isinstance(compared, tuple):
        return None
    feature, more = compared
    return (Binding("compared", (feature, not more)),)


def _most(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "ranked"):
        return bindings
    compared = _one(bindings, "compared")
    return (Binding("ranked", query.Ranked(*compared)),) if isinstance(compared, tuple) else None


def _least(bindings: Bindings) -> Bindings | None:
    less = _less(bindings)
    return None if less is None else _most(less)


def _one_or_other(bindings: Bindings) -> Bindings:
    """Which of two: those that are one or the other."""
    either = query.AnyOf(tuple(query.Is(_reference(bindings, at)) for at in (0, 1)))
    return (Binding("described", query.Description((either,))),)


def _best(bindings: Bindings) -> Bindings | None:
    """The one that comes first, by what is the most of several or is more than the other."""
    compared = _one(bindings, "compared")
    if isinstance(compared, tuple):
        bindings = (*bindings, Binding("ranked", query.Ranked(*compared)))
    return _picked(bindings)


def _all_of(bindings: Bindings) -> Bindings:
    return _condition(query.All(_conditions(bindings)))


def _not(bindings: Bindings) -> Bindings:
    return _condition(query.Not(all_of(_conditions(bindings))))


def _neither(bindings: Bindings) -> Bindings:
    return _condition(query.Not(query.AnyOf(_conditions(bindings))))


def _standing(bindings: Bindings) -> Bindings:
    return _condition(query.Related(str(_one(bindings, "relation")), _reference(bindings)))


def _stood_to(bindings: Bindings) -> Bindings:
    """What something else stands to: "the thing that the ball is left of"."""
    relation = str(_one(bindings, "relation"))
    return _condition(query.Related(relation, _reference(bindings), inverse=True))


def _either_kind(bindings: Bindings) -> Bindings:
    """Things of either of two descriptions: "cubes or green balls"."""
    kinds = [d for d in meanings(bindings, "described") if isinstance(d, query.Description)]
    either = query.AnyOf(tuple(all_of(settled(kind).conditions) for kind in kinds))
    return (
        Binding("described", query.Description((either,), many=any(kind.many for kind in kinds))),
    )


def _reference(bindings: Bindings, at: int = 0) -> query.Reference:
    found = meanings(bindings, "one")[at]
    if not isinstance(found, query.Reference):
        raise TypeError(f"must be a reference, got {found!r}")
    return found


def _shares(bindings: Bindings) -> Bindings:
    return _condition(query.Shares(str(_one(bindings, "feature")), _reference(bindings)))


def _of_one_feature(bindings: Bindings) -> Bindings | None:
    """Conditions with the feature that they are said of: "made of rubber", not "made of red"."""
    features = set(meanings(bindings, "feature"))
    for condition in _conditions(bindings):
        if isinstance(condition, query.HasValue | query.Shares):
            features.add(condition.feature)
    if len(features) > 1:
        return None
    return tuple(binding for binding in bindings if binding.role == "condition")


def _valued(bindings: Bindings) -> Bindings | None:
    kept = _of_one_feature(bindings)
    # The feature is kept for the participle in front: "made of the colour red" means nothing.
    return None if kept is None else (*kept, *(b for b in bindings if b.role == "feature"))


def _placed(bindings: Bindings) -> Bindings | None:
    return _of_one_feature(bindings)


def _in_corner(bindings: Bindings) -> Bindings:
    corner = _one(bindings, "corner")
    described = query.Description(selection=corner)  # type: ignore[arg-type]
    return _condition(query.Is(query.Reference(described)))


def _compares(bindings: Bindings) -> Bindings | None:
    compared = _one(bindings, "compared")
    if not isinstance(compared, tuple):
        return None
    feature, more = compared
    return _condition(query.Compares(feature, more, _reference(bindings)))


def _between(bindings: Bindings) -> Bindings:
    return _condition(query.Between(_reference(bindings), _reference(bindings, 1)))


def _beyond(bindings: Bindings) -> Bindings:
    return _condition(query.Apart(_reference(bindings)))


def _kind_of(bindings: Bindings) -> Bindings | None:
    described = _one(bindings, "described")
    if not isinstance(described, query.Description):
        return None
    return _condition(all_of(settled(described).conditions))


def _is(bindings: Bindings) -> Bindings:
    return _condition(query.Is(_reference(bindings)))


def _farthest(_: Bindings) -> Bindings:
    return (Binding("farthest", True),)


def _nearest(_: Bindings) -> Bindings:
    return (Binding("farthest", False),)


def _picked(bindings: Bindings) -> Bindings | None:
    described = _one(bindings, "described") or query.Description()
    if not isinstance(described, query.Description):
        return None
    rank, side = _one(bindings, "rank"), _one(bindings, "side")
    extreme, ranked = _one(bindings, "extreme"), _one(bindings, "ranked")
    farthest = _one(bindings, "farthest")
    selection: object = _one(bindings, "corner") or ranked
    if isinstance(extreme, query.Extreme) or side is not None:
        number = rank if isinstance(rank, int) else 1
        relation = extreme.relation if isinstance(extreme, query.Extreme) else str(side)
        selection = query.Extreme(relation, abs(number), from_end=number < 0)
    elif isinstance(rank, int):
        selection = query.Numbered(rank)
    elif farthest is not None:
        selection = query.Nearest(_reference(bindings), farthest=bool(farthest))
    picked = query.Description(described.conditions, selection, described.many)  # type: ignore[arg-type]
    return (Binding("described", picked),)


def _referring(which: query.References) -> Fold:
    def fold(bindings: Bindings) -> Bindings | None:
        described = _one(bindings, "described")
        if not isinstance(described, query.Description):
            return None
        meant = which
        if which is query.References.THE and described.many and described.selection is None:
            meant = query.References.EVERY  # "the cubes"
        return (Binding("one", query.Reference(settled(described), meant)),)

    return fold


def _numbered(bindings: Bindings) -> Bindings | None:
    number = _one(bindings, "number")
    if not isinstance(number, int) or number < 1 or any(meanings(bindings, "many")):
        return None
    described = query.Description(_conditions(bindings), query.Numbered(number))
    return (Binding("one", query.Reference(described)),)


def _counted_off(bindings: Bindings) -> Bindings | None:
    """Things by their numbers: "cards 1, 2 and 3"."""
    found = []
    for number in meanings(bindings, "number"):
        if not isinstance(number, int) or number < 1:
            return None
        described = query.Description(_conditions(bindings), query.Numbered(number))
        found.append(Binding("one", query.Reference(described)))
    return tuple(found)


def _ranked_off(bindings: Bindings) -> Bindings:
    """Things by their places: "the first and the second card"."""
    ranks = [rank for rank in meanings(bindings, "rank") if isinstance(rank, int)]
    conditions = _conditions(bindings)
    numbered = (query.Description(conditions, query.Numbered(rank)) for rank in ranks)
    return tuple(Binding("one", query.Reference(described)) for described in numbered)


PHRASES: dict[str, Fold] = {
    "ranked_off": _ranked_off,
    "apart": _apart,
    "else": _apart,
    "described": _described,
    "one_of_two": _any_of,
    "not_so": _not,
    "does_not": _not,
    "not_state": _not,
    "being_both": _all_of,
    "being_either": _any_of,
    "being_neither": _neither,
    "kind_of": _kind_of,
    "standing": _standing,
    "stood_to": _stood_to,
    "carried": _stood_to,
    "borne": _stood_to,
    "some_one": _described,
    "every_one": _described,
    "either_kind": _either_kind,
    "best": _best,
    "one_or_other": _one_or_other,
    "two_kinds": _two_kinds,
    "noun_of": _noun_of,
    "less_so": _less,
    "most_of_all": _most,
    "least_of_all": _least,
    "in_picture": lambda _: (),
    "verb_and_one": _standing,
    "same_as": _shares,
    "as_much": _shares,
    "sharing": _of_one_feature,
    "valued": _valued,
    "placed": _placed,
    "comparing": _compares,
    "amid": _between,
    "beyond": _beyond,
    "itself": _is,
    "fallen_without": _standing,
    "not_happening": _not,
    "some_thing": lambda _: (Binding("described", query.Description()),),
    "counted_off": _counted_off,
    "in_group": lambda bindings: _condition(query.PartOf(str(_one(bindings, "group")))),
    "in_no_group": lambda bindings: _condition(
        query.Not(query.PartOf(str(_one(bindings, "group"))))
    ),
    "in_corner": _in_corner,
    "near": _nearest,
    "far": _farthest,
    "picked": _picked,
    "the": _referring(query.References.THE),
    "some": _referring(query.References.SOME),
    "like": _described,
    "in_short": _referring(query.References.THE),
    "every": _referring(query.References.EVERY),
    "numbered": _numbered,
}
"""Phrase → what its bindings come to."""
