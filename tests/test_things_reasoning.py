"""Things in the reasoner, beside plain clingo with one program a scene."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from itertools import combinations

import clingo
import pytest

from seewhy.errors import KnowledgeError
from seewhy.knowledge import nearest_instances
from seewhy.knowledge.change import ChangeFinder
from seewhy.knowledge.grounding_size import grounding_size, large_grounding
from seewhy.knowledge.language import Knowledge, read_knowledge, read_literal
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import schema_with_things
from seewhy.knowledge.why import why
from seewhy.knowledge.why_not import why_not

SET = """\
#sort picture.
#sort card = things.
#sort count = 1..3.
#sort hue = {red, green, purple}.
#sort fill = {open, striped, solid}.
#sort form = {oval, diamond, squiggle}.
#static number(card, count).
#static colour(card, hue).
#static shading(card, fill).
#static shape(card, form).
#static mixed(card, card, card).
#static is_set(card, card, card).
#static some_set(picture).
%% two are alike and the third is not
mixed(A, B, C) if number(A, N), number(B, N), number(C, M), N != M.
mixed(A, B, C) if colour(A, N), colour(B, N), colour(C, M), N != M.
mixed(A, B, C) if shading(A, N), shading(B, N), shading(C, M), N != M.
mixed(A, B, C) if shape(A, N), shape(B, N), shape(C, M), N != M.
%% three cards are a set when each of the four is all alike or all different
is_set(A, B, C) if card(A), card(B), card(C), A < B, B < C, not mixed(A, B, C),
  not mixed(A, C, B), not mixed(B, C, A).
some_set(P) if picture(P), is_set(A, B, C).
-some_set(P) if picture(P), not some_set(P).
"""
SET_FEATURES = ("number", "colour", "shading", "shape")

BLOCKS = """\
#sort picture.
#sort block = things.
#sort hue = {red, green, blue}.
#static colour(block, hue).
#static round(block).
#static on(block, block).
#static displaced(block, block).
#static above(block, block).
#static tower(picture).
#static falls(block).
#static stable(picture).
above(X, Y) if on(X, Y).
above(X, Z) if on(X, Y), above(Y, Z).
falls(X) if on(X, Y), round(Y).
falls(X) if on(X, Y), displaced(X, Y), not held(X).
#static held(block).
held(X) if above(Y, X), colour(Y, red).
falls(X) if on(X, Y), falls(Y).
%% a picture with a block that falls is unstable
-stable(P) if picture(P), falls(X).
%% nothing falls
stable(P) if picture(P), not -stable(P), #count { X : block(X), not round(X) } > 0.
"""
BLOCK_FEATURES = ("colour", "round", "on", "displaced")


def world(
    source: str, most: int, seen: tuple[str, ...], classes: dict[str, str]
) -> tuple[Knowledge, SceneSchema]:
    knowledge = read_knowledge(source).with_things(most)
    plain = SceneSchema("picture", {}, {n: read_literal(t) for n, t in classes.items()}, {})
    return knowledge, schema_with_things(plain, knowledge.signature, seen)


def set_world(most: int) -> tuple[Knowledge, SceneSchema]:
    return world(
        SET, most, SET_FEATURES, {"set": "some_set(picture)", "none": "-some_set(picture)"}
    )


def block_world(most: int) -> tuple[Knowledge, SceneSchema]:
    return world(
        BLOCKS, most, BLOCK_FEATURES, {"stable": "stable(picture)", "unstable": "-stable(picture)"}
    )


def random_scene(
    schema: SceneSchema, chance: random.Random, things: int, *, unknown: float = 0.0
) -> FeatureVector:
    values: dict[str, str | None] = dict.fromkeys(list(schema.presence.values())[:things], "yes")
    for feature, literals in schema.features.items():
        requires = schema.requires.get(feature)
        if requires and all(named in values for named in requires) and chance.random() >= unknown:
            possible = list(literals)
            rarely = possible == ["yes", "no"] and chance.random() < 0.5
            values[feature] = "no" if rarely else chance.choice(possible)
    return schema.vector(values)


# A second opinion ---------------------------------------------------------------------------------


def facts(schema: SceneSchema, vector: FeatureVector) -> Iterator[str]:
    """What a scene shows, written down anew: only of things that are there."""
    for (feature, literals), value in zip(schema.features.items(), vector, strict=True):
        if value is None or (feature in schema.presence.values() and value == "no"):
            continue
        yield f"{literals[value]}."
        if len(literals) > 1 and "no" not in literals:
            yield from (f"-{literal}." for other, literal in literals.items() if other != value)


def by_the_book(source: str, schema: SceneSchema, vector: FeatureVector) -> frozenset[str] | None:
    """The beliefs by one program of plain clingo for the scene; None where it has no answer set."""
    lines = ["picture(picture)."]
    for statement in re.sub("%.*", "", source).split(".\n"):
        text = statement.strip()
        if text and not text.startswith("#"):
            lines.append(text.replace(" if ", " :- ") + ".")
    lines += facts(schema, vector)
    control = clingo.Control(["--warn=none"])
    control.add("base", [], "\n".join(lines))
    control.ground([("base", [])])
    found: list[frozenset[str]] = []
    control.solve(
        on_model=lambda model: found.append(frozenset(map(str, model.symbols(atoms=True))))
    )
    return found[0] - {"picture(picture)"} if found else None


def beliefs(reasoner: Reasoner, vector: FeatureVector) -> frozenset[str]:
    """What is believed, but that things are not there, which the second opinion leaves out."""
    absent = {
        f"-{named}"
        for named in reasoner.schema.presence.values()
        if vector[list(reasoner.schema.features).index(named)] == "no"
    }
    return frozenset(map(str, reasoner.believed(vector))) - absent


def label_of(schema: SceneSchema, believed: frozenset[str] | None) -> str | None:
    if believed is None:
        return None
    named = [n for n, literal in schema.classes.items() if str(literal) in believed]
    return named[0] if len(named) == 1 else None


# What is decided ----------------------------------------------------------------------------------


def test_every_three_cards_are_a_set_or_not_as_the_rule_has_it() -> None:
    _, schema = set_world(6)
    reasoner = Reasoner(set_world(6)[0], schema)
    chance = random.Random(0)
    scenes = [random_scene(schema, chance, 6) for _ in range(40)]
    found = reasoner.decide_all(scenes)
    for vector, decision in zip(scenes, found, strict=True):
        shown = dict(zip(schema.features, vector, strict=True))
        cards = [
            tuple(shown[f"{feature}(card{n})"] for feature in SET_FEATURES) for n in range(1, 7)
        ]
        sets = [
            names
            for names in combinations(range(6), 3)
            if all(len({cards[n][f] for n in names}) != 2 for f in range(4))
        ]
        assert decision.label == ("set" if sets else "none")
    vector = scenes[[decision.label for decision in found].index("set")]
    told = {str(s) for s in reasoner.believed(vector) if s.name == "is_set" and s.positive}
    shown = dict(zip(schema.features, vector, strict=True))
    expected = {
        f"is_set(card{a},card{b},card{c})"
        for a, b, c in combinations(range(1, 7), 3)
        if all(
            len({shown[f"{feature}(card{n})"] for n in (a, b, c)}) != 2 for feature in SET_FEATURES
        )
    }
    assert told == expected


@pytest.mark.parametrize("unknown", [0.0, 0.3])
def test_blocks_are_believed_what_plain_clingo_believes(unknown: float) -> None:
    knowledge, schema = block_world(4)
    together, alone = Reasoner(knowledge, schema), Reasoner(knowledge, schema)
    chance = random.Random(1)
    scenes = [
        random_scene(schema, chance, chance.randint(0, 4), unknown=unknown) for _ in range(40)
    ]
    decided = together.decide_all(scenes)
    for number, (vector, decision) in enumerate(zip(scenes, decided, strict=True)):
        expected = by_the_book(BLOCKS, schema, vector)
        assert decision.label == label_of(schema, expected)
        if number < 12:
            assert alone.decide(vector) == decision
            assert beliefs(alone, vector) == expected


def test_an_empty_picture_is_a_scene_too() -> None:
    knowledge, schema = block_world(3)
    decision = Reasoner(knowledge, schema).decide(schema.vector({}))
    assert (decision.label, decision.verdict) == (None, Verdict.SILENT)


def test_what_waits_for_itself_by_not_is_left_to_the_solver() -> None:
    source = """\
#sort picture. #sort block = things. #static round(block). #static kept(block).
#static left_out(block). #static good(picture).
kept(X) if block(X), not left_out(X).
left_out(X) if block(X), not kept(X).
good(P) if picture(P), round(X), kept(X).
good(P) if picture(P), round(X), left_out(X).
"""
    knowledge, schema = world(source, 2, ("round",), {"good": "good(picture)"})
    reasoner = Reasoner(knowledge, schema)
    scenes = [
        schema.vector({"block(block1)": "yes", "round(block1)": value, "block(block2)": there})
        for value in ("yes", "no")
        for there in ("yes", "no")
    ]
    assert reasoner._batch.outcomes(scenes[:2]) == [None, None]
    assert [reasoner.decide(vector).label for vector in scenes] == ["good", "good", None, None]


# Why ----------------------------------------------------------------------------------------------


def suffices(reasoner: Reasoner, vector: FeatureVector, features: tuple[str, ...]) -> None:
    """Scenes that share the named features are of the same class, as plain clingo decides them."""
    schema = reasoner.schema
    label = reasoner.decide(vector).label
    chance = random.Random(2)
    names = list(schema.features)
    for _ in range(15):
        values = {
            name: value for name, value in zip(names, vector, strict=True) if name in features
        }
        needed = {named for name in values for named in schema.requires.get(name, ())}
        for named in schema.presence.values():
            if named not in values:
                values[named] = "yes" if named in needed or chance.random() < 0.5 else "no"
        for name, literals in schema.features.items():
            requires = schema.requires.get(name)
            if requires and name not in values and all(values[n] == "yes" for n in requires):
                values[name] = chance.choice([*literals])
        assert label_of(schema, by_the_book(BLOCKS, schema, schema.vector(values))) == label


def test_reasons_are_enough_whatever_else_is_seen() -> None:
    knowledge, schema = block_world(4)
    reasoner = Reasoner(knowledge, schema)
    chance = random.Random(3)
    told = 0
    for _ in range(12):
        vector = random_scene(schema, chance, chance.randint(1, 4))
        label = reasoner.decide(vector).label
        if label is None:
            continue
        node = why(reasoner, vector, schema.classes[label])
        assert node is not None
        reasons = node.children if node.basis.value == "several reasons" else (node,)
        for reason in reasons[:3]:
            suffices(reasoner, vector, reason.features())
            told += 1
    assert told > 6


def scene_of(schema: SceneSchema, blocks: int, **values: str) -> FeatureVector:
    named: dict[str, str | None] = {}
    for name, value in values.items():
        predicate, *numbers = name.split("_")
        named[f"{predicate}({','.join(f'block{n}' for n in numbers)})"] = value
    present = dict.fromkeys(list(schema.presence.values())[:blocks], "yes")
    filled: dict[str, str | None] = {
        feature: "no" if "no" in literals else "green"
        for feature, literals in schema.features.items()
        if feature in schema.requires
        and all(named in present for named in schema.requires[feature])
    }
    return schema.vector({**filled, **present, **named})


def test_why_speaks_of_things_by_what_was_seen_of_them() -> None:
    knowledge, schema = block_world(4)
    reasoner = Reasoner(knowledge, schema)
    vector = scene_of(schema, 2, on_1_2="yes", round_2="yes")
    node = why(reasoner, vector, schema.classes["unstable"])
    assert node is not None
    assert node.features() == ("on(block1,block2)", "round(block2)")
    assert "block(block1)" not in node.to_text()


def test_what_is_not_there_is_told_once() -> None:
    knowledge, schema = block_world(4)
    reasoner = Reasoner(knowledge, schema)
    vector = scene_of(schema, 2, on_1_2="yes")
    node = why(reasoner, vector, schema.classes["stable"])
    assert node is not None
    assert {"block(block3)", "block(block4)"} <= set(node.features())
    lines = {line.strip("├─└│ ") for line in node.to_text().splitlines()}
    assert "but there is no other block" in lines or "there is no other block" in lines
    assert "not known" not in node.to_text()


def test_why_not_takes_the_nearest_things_and_none_that_are_not_there() -> None:
    knowledge, schema = block_world(4)
    reasoner = Reasoner(knowledge, schema)
    vector = scene_of(schema, 3, on_1_2="yes", round_3="yes")
    node = why_not(reasoner, vector, read_literal("falls(block1)"))
    assert not node.holds
    assert "block4" not in node.to_text()
    assert "on(block1, block1)" not in node.to_text()
    assert "round(block2)" in node.to_text()


def test_instances_of_things_are_looked_up_as_clingo_solves_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    knowledge, schema = block_world(4)
    chance = random.Random(5)
    scenes = [random_scene(schema, chance, chance.randint(0, 4), unknown=0.2) for _ in range(12)]
    asked = [read_literal(f"falls(block{n})") for n in (1, 2)] + [*schema.classes.values()]
    reasoner = Reasoner(knowledge, schema)
    looked_up = [why_not(reasoner, vector, literal) for vector in scenes for literal in asked]
    monkeypatch.setattr(nearest_instances, "_looked_up", lambda *_: None)
    assert looked_up == [
        why_not(reasoner, vector, literal) for vector in scenes for literal in asked
    ]


# What would have to be otherwise ------------------------------------------------------------------


def test_the_smallest_change_moves_takes_away_or_turns() -> None:
    knowledge, schema = block_world(3)
    finder = ChangeFinder(Reasoner(knowledge, schema))
    vector = scene_of(schema, 2, on_1_2="yes", round_2="yes")
    found = finder.smallest(vector, "stable", limit=10)
    assert {change.cost for change in found} == {1}
    assert {tuple((c.feature, c.before, c.after) for c in change.changes) for change in found} == {
        (("block(block2)", "yes", "no"),),
        (("on(block1,block2)", "yes", "no"),),
        (("round(block2)", "yes", "no"),),
    }


def test_which_card_would_complete_them() -> None:
    knowledge, schema = set_world(4)
    finder = ChangeFinder(Reasoner(knowledge, schema))
    cards = [("1", "red", "open", "oval"), ("2", "red", "solid", "diamond")]
    values: dict[str, str | None] = {}
    for number, card in enumerate(cards, start=1):
        values[f"card(card{number})"] = "yes"
        values |= {f"{f}(card{number})": value for f, value in zip(SET_FEATURES, card, strict=True)}
    vector = schema.vector(values)
    literal = read_literal("is_set(card1, card2, card3)")
    (change,) = [
        c
        for c in finder.smallest_for(vector, literal, limit=100)
        if all(
            dict(zip(schema.features, c.vector, strict=True))[f"{f}(card3)"] for f in SET_FEATURES
        )
    ] or finder.smallest_for(vector, literal, limit=1)
    assert change.changes[0].feature == "card(card3)"
    assert change.cost == 1


def test_of_the_places_of_things_the_first_is_taken() -> None:
    knowledge, schema = block_world(4)
    finder = ChangeFinder(Reasoner(knowledge, schema))
    found = finder.smallest(schema.vector({}), "stable", limit=10)
    assert {change.changes[0].feature for change in found} == {"block(block1)"}


def test_no_scene_that_differs_in_one_thing_is_overlooked() -> None:
    knowledge, schema = block_world(3)
    finder = ChangeFinder(Reasoner(knowledge, schema))
    chance = random.Random(4)
    tried = 0
    while tried < 3:
        vector = random_scene(schema, chance, 3)
        believed = label_of(schema, by_the_book(BLOCKS, schema, vector))
        if believed != "unstable":
            continue
        tried += 1
        found = finder.smallest(vector, "stable", limit=100)
        one = {
            after
            for after in differing_in_one(schema, vector)
            if label_of(schema, by_the_book(BLOCKS, schema, after)) == "stable"
        }
        if one:
            assert one == {change.vector for change in found}
        else:
            assert all(change.cost > 1 for change in found)


def differing_in_one(schema: SceneSchema, vector: FeatureVector) -> Iterator[FeatureVector]:
    shown = dict(zip(schema.features, vector, strict=True))
    for feature, literals in schema.features.items():
        if shown[feature] is None:
            continue
        for value in literals:
            if value == shown[feature]:
                continue
            values = {**shown, feature: value}
            if feature in schema.presence.values() and value == "no":
                values |= {
                    other: None for other, needs in schema.requires.items() if feature in needs
                }
            yield schema.vector(values)


# The language -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        (
            "#sort a = things.\n#sort b = things.",
            "k.al:2:1: 'b' is a second sort of things (the first, 'a', is at k.al:1:1); let all "
            "things be of one sort, and what kind of thing each is be a static of it",
        ),
        (
            "#sort a = things.\n#sort b = a + a.",
            "k.al:2:1: sort 'b' is made of 'a', which stands for what is found in the picture; "
            "give it sorts with members",
        ),
        (
            "#sort a = things. #static p(a).\np(a1).",
            "k.al:2:3: 'p' takes a a of the picture here, got 'a1'; use a variable such as T",
        ),
        (
            "#sort a = things. #static p(a).\na(X) if p(X).",
            "k.al:2:1: 'a' is a sort; its members are found in the picture, an axiom cannot add "
            "to them",
        ),
    ],
)
def test_what_cannot_be_said_of_things(source: str, problem: str) -> None:
    with pytest.raises(KnowledgeError) as error:
        read_knowledge(source, file="k.al")
    assert str(error.value) == problem


def test_a_name_that_a_thing_has_already() -> None:
    known = read_knowledge("#sort a = things.\n#sort b = {a1, c}.", file="k.al")
    with pytest.raises(KnowledgeError, match=r"k\.al:2:1: 'a1' is how a thing of the picture is"):
        known.with_things(3)


def test_a_sort_called_things_is_one_like_others() -> None:
    known = read_knowledge("#sort things = {cup, book}. #sort all = things.")
    assert known.signature.members("all") == ("cup", "book")


def test_things_are_counted_in_what_grows() -> None:
    known = read_knowledge("#sort a = things. #static p(a, a, a). p(X, Y, Z) if a(X), a(Y), a(Z).")
    assert grounding_size(known.with_things(10)).instances == 1000


def test_relations_that_things_show_are_counted_in_what_grows() -> None:
    known = read_knowledge(
        "#sort a = things.\n#static near(a, a). #static far(a, a).\n#static red(a).\n"
        "far(X, Y) if near(X, Y).",
        file="k.al",
    )
    assert grounding_size(known.with_things(10)).instances == 100 + 10 + 100
    seen = read_knowledge("#sort a = things.\n#static near(a, a).", file="k.al").with_things(100)
    assert large_grounding(seen) == (
        "k.al:2:1: 'near(a, a)' has up to 10,000 instances; every question waits for them"
    )
