"""What planning.toml says of sorts, fluents, actions and pictures that there are not."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from seewhy.domain.tables import FeatureTable
from seewhy.errors import PlanningError
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.goal import read_goal
from seewhy.planning.tables import MapTable, PlanningFile
from seewhy.text.nearest import did_you_mean
from seewhy.text.slots import wrong_slot

__all__ = ["goal_problems_of", "picture_problems_of", "problems_of"]

_SLOT = re.compile(r"\{(\d+)\}")


def problems_of(table: PlanningFile, knowledge: Knowledge) -> Iterator[tuple[tuple[str, ...], str]]:
    """What planning.toml says of things that the knowledge does not have."""
    signature = knowledge.signature
    fluents = {n: len(p.sorts) for n, p in signature.predicates.items() if p.kind.is_fluent}
    statics = {
        n: len(p.sorts) for n, p in signature.predicates.items() if p.kind is PredicateKind.STATIC
    }
    actions = {n: len(p.sorts) for n, p in signature.predicates.items() if p.kind.is_action}
    members = {member for sort in signature.sorts.values() for member in sort.members or ()}
    for sort in signature.sorts.values():
        if sort.members is None:
            yield ("planning",), f"the sort '{sort.name}' has no members ({sort.location})"
    if not any(p.kind is PredicateKind.ACTION for p in signature.predicates.values()):
        yield ("planning",), f"{knowledge.file} declares no action, so nothing can be planned"
    robot = table.planning.robot
    if robot is not None and robot not in members:
        yield ("planning", "robot"), f"'{robot}' is of no sort; {did_you_mean(robot, members)}"
    for key, things in (("things", table.things), ("possessives", table.possessives)):
        for thing in things:
            if thing not in members:
                yield (key, thing), f"'{thing}' is of no sort; {did_you_mean(thing, members)}"
    for kind, named, known in (
        ("fluents", _said(table.fluents), fluents),
        ("statics", _said(table.statics), statics),
        ("actions", _said(table.actions), actions),
    ):
        for name, texts in named.items():
            if name not in known:
                yield (kind, name), f"'{name}' is none of the {kind}; {did_you_mean(name, known)}"
                continue
            for key, text in texts:
                wrong = wrong_slot(_SLOT.sub("", text), ())
                if wrong is not None:
                    yield (
                        (kind, name, key),
                        f"'{text}' has '{wrong}', which is no slot; there are {{0}}, {{1}}, … for "
                        "the arguments",
                    )
                for slot in _SLOT.findall(text):
                    if int(slot) >= known[name]:
                        yield (
                            (kind, name, key),
                            f"'{name}' has {known[name]} arguments, counted from 0, but '{text}' "
                            f"asks for {{{slot}}}",
                        )
    if table.map is not None:
        yield from _map_problems(table.map, knowledge)
    for key, chances, wanted in (
        ("events", table.simulation.events, PredicateKind.EXOGENOUS_ACTION),
        ("failures", table.simulation.failures, PredicateKind.ACTION),
        ("durations", table.simulation.durations, PredicateKind.ACTION),
    ):
        names = [n for n, p in signature.predicates.items() if p.kind is wanted]
        for name in chances:
            if name not in names:
                yield (
                    ("simulation", key, name),
                    f"'{name}' is no {wanted.value}; {did_you_mean(name, names)}",
                )


def picture_problems_of(
    table: PlanningFile, features: Mapping[str, FeatureTable]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """What planning.toml says of features that domain.toml does not have."""
    for key in table.pictures.shows if table.pictures else ():
        here = ("pictures", "shows", key)
        if not features:
            yield here, "the folder has no domain.toml, which would name features of pictures"
        elif key not in features:
            yield here, f"'{key}' is no feature of domain.toml; {did_you_mean(key, features)}"
        elif {*features[key].values} != {"yes", "no"}:
            yield (
                here,
                f"the feature '{key}' has the values {', '.join(features[key].values)}; only one "
                "of yes and no says whether a fluent holds",
            )


def _map_problems(table: MapTable, knowledge: Knowledge) -> Iterator[tuple[tuple[str, ...], str]]:
    signature = knowledge.signature
    if table.places not in signature.sorts:
        remedy = did_you_mean(table.places, signature.sorts)
        yield ("map", "places"), f"'{table.places}' is no sort; {remedy}"
        return
    wanted: dict[str, tuple[str | None, str, list[str | None]]] = {
        "links": (table.links, "static", [table.places, table.places]),
        "where": (table.where, "fluent", [None, table.places]),
        "closed": (table.closed, "fluent", [table.places]),
    }
    for key, (name, kind, sorts) in wanted.items():
        if name is None:
            continue
        known = [n for n, p in signature.predicates.items() if kind in p.kind.value]
        if name not in known:
            yield ("map", key), f"'{name}' is no {kind}; {did_you_mean(name, known)}"
            continue
        declared = signature.predicates[name].sorts
        if len(declared) != len(sorts) or any(
            b not in (None, a) for a, b in zip(declared, sorts, strict=True)
        ):
            shown = ", ".join(sort or "thing" for sort in sorts)
            yield (
                ("map", key),
                f"'{signature.predicates[name]}' must be of the form {name}({shown})",
            )


def _said(tables: Mapping[str, object]) -> dict[str, list[tuple[str, str]]]:
    """Fluent, static or action → the keys of its table with their texts."""
    return {
        name: [
            (key, text)
            for key, said in vars(table).items()
            for text in ((said,) if isinstance(said, str) else said or ())
        ]
        for name, table in tables.items()
    }


def goal_problems_of(
    table: PlanningFile, knowledge: Knowledge
) -> Iterator[tuple[tuple[str, ...], str]]:
    """What is wrong with goals that can be said in words."""
    for number, goal in enumerate(table.goals):
        here = ("goals", str(number))
        try:
            variables = read_goal(goal.goal, knowledge).variables
        except PlanningError as problem:
            yield (*here, "goal"), str(problem)
            continue
        for text in goal.say:
            for slot in re.findall(r"\{([^{}]*)\}", text):
                if slot not in variables:
                    yield (
                        (*here, "say"),
                        f"'{text}' asks for {{{slot}}}, which is no variable of the goal "
                        f"'{goal.goal}'; {did_you_mean(slot, variables)}",
                    )
