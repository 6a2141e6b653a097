"""Knowledge about scenes of ten things: four features, four relations, thirty axioms; and SET."""

from __future__ import annotations

import numpy as np

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import schema_with_things

THINGS = 10
FEATURES = {
    "colour": ("red", "green", "blue", "yellow"),
    "size": ("small", "large"),
    "shape": ("cube", "ball", "cylinder"),
    "material": ("metal", "rubber"),
}
RELATIONS = ("on", "left_of", "touching", "larger")
KINDS = tuple(f"kind_{n}" for n in range(4))
SET_FEATURES = {
    "number": ("one", "two", "three"),
    "colour": ("red", "green", "purple"),
    "shading": ("open", "striped", "solid"),
    "shape": ("oval", "diamond", "squiggle"),
}


def _declared(features: dict[str, tuple[str, ...]]) -> list[str]:
    return [
        "#sort picture.",
        "#sort thing = things.",
        *(f"#sort {name}_sort = {{{', '.join(values)}}}." for name, values in features.items()),
        *(f"#static {name}(thing, {name}_sort)." for name in features),
    ]


def tabletop_knowledge() -> Knowledge:
    """Thirty axioms: 10 over one thing, 20 over two; chains of three, with `not` and both signs."""
    values = [(name, value) for name, of_name in FEATURES.items() for value in of_name]

    def seen(number: int, variable: str) -> str:
        name, value = values[number % len(values)]
        return f"{name}({variable}, {value})"

    lines = [
        *_declared(FEATURES),
        *(f"#static {name}(thing, thing)." for name in RELATIONS),
        *(f"#static marked_{n}(thing)." for n in range(6)),
        *(f"#static linked_{n}(thing, thing)." for n in range(4)),
        "#static kind(picture, kind_sort).".replace("kind_sort", "class_sort"),
    ]
    lines.insert(0, f"#sort class_sort = {{{', '.join(KINDS)}}}.")
    lines += [
        f"marked_{n % 6}(X) if {seen(3 * n, 'X')}, not {seen(5 * n + 2, 'X')}." for n in range(10)
    ]
    lines += [
        f"marked_{n}(X) if {RELATIONS[n % 4]}(X, Y), {seen(7 * n + 1, 'Y')}, {seen(2 * n, 'X')}."
        for n in range(6)
    ]
    lines += [
        f"linked_{n % 4}(X, Y) if {RELATIONS[n % 4]}(X, Y), not {RELATIONS[(n + 1) % 4]}(Y, X), "
        f"marked_{n}(Y)."
        for n in range(6)
    ]
    lines += [
        f"kind(P, kind_{n % 4}) if picture(P), linked_{n % 4}(X, Y), not marked_{(n + 1) % 6}(X), "
        f"{seen(n, 'Y')}, {seen(4 * n + 6, 'X')}."
        for n in range(8)
    ]
    return read_knowledge("\n".join(lines), file="tabletop.al").with_things(THINGS)


def tabletop_schema(knowledge: Knowledge) -> SceneSchema:
    """The schema of :func:`tabletop_knowledge`."""
    classes = {name: Literal("kind", ("picture", name)) for name in KINDS}
    plain = SceneSchema("picture", {}, classes, {})
    return schema_with_things(plain, knowledge.signature, [*FEATURES, *RELATIONS])


def set_knowledge() -> Knowledge:
    """The rule of SET, over any three of the things."""
    lines = [
        *_declared(SET_FEATURES),
        "#static mixed(thing, thing, thing).",
        "#static some_set(picture).",
        *(
            f"mixed(A, B, C) if {name}(A, N), {name}(B, N), {name}(C, M), N != M, A < B."
            for name in SET_FEATURES
        ),
        "#static is_set(thing, thing, thing).",
        "is_set(A, B, C) if thing(A), thing(B), thing(C), A < B, B < C, not mixed(A, B, C), "
        "not mixed(A, C, B), not mixed(B, C, A).",
        "some_set(P) if picture(P), is_set(A, B, C).",
        "-some_set(P) if picture(P), not some_set(P).",
    ]
    return read_knowledge("\n".join(lines), file="set.al").with_things(THINGS)


def set_schema(knowledge: Knowledge) -> SceneSchema:
    """The schema of :func:`set_knowledge`."""
    some = Literal("some_set", ("picture",))
    plain = SceneSchema("picture", {}, {"set": some, "none": some.complement}, {})
    return schema_with_things(plain, knowledge.signature, [*SET_FEATURES])


def scenes_of_ten(schema: SceneSchema, count: int, *, seed: int = 0) -> list[FeatureVector]:
    """``count`` scenes of all ten things at random; a relation holds of one pair in five."""
    generator = np.random.default_rng(seed)
    found: dict[FeatureVector, None] = {}
    while len(found) < count:
        values: dict[str, str | None] = dict.fromkeys(schema.presence.values(), "yes")
        for feature, literals in schema.features.items():
            if "no" not in literals:
                values[feature] = list(literals)[int(generator.integers(len(literals)))]
            elif feature in schema.requires:
                values[feature] = "yes" if generator.random() < 0.2 else "no"
        found[schema.vector(values)] = None
    return list(found)
