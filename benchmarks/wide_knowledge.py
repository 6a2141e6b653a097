"""Knowledge with hundreds of thousands of feature vectors, to measure distinct scenes on.

The bundled domain of structures has only 40 feature vectors; measured on it, distinct scenes
would be repeated ones.
"""

from __future__ import annotations

import numpy as np

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.knowledge.scene import FeatureVector, SceneSchema

FEATURES = {f"feature_{n}": ("red", "green", "blue", "white", "black") for n in range(6)}
SWITCHES = tuple(f"switch_{n}" for n in range(4))
CLASSES = tuple(f"kind_{n}" for n in range(6))


def wide_knowledge() -> Knowledge:
    """Ten features, six classes and thirty axioms: chains, `not`, exceptions, contradictions."""
    lines = [
        "#sort thing.",
        "#sort colour = {red, green, blue, white, black}.",
        f"#sort kind = {{{', '.join(CLASSES)}}}.",
        *(f"#static {name}(thing, colour)." for name in FEATURES),
        *(f"#static {name}(thing)." for name in SWITCHES),
        "#static kind_of(thing, kind).",
        "#static bright(thing).",
        "#static marked(thing).",
        "bright(S) if feature_0(S, white), not switch_0(S).",
        "bright(S) if feature_1(S, white), feature_2(S, C), C != black.",
        "-bright(S) if feature_0(S, black), feature_1(S, black).",
        "marked(S) if switch_1(S), not bright(S).",
        "marked(S) if feature_3(S, red), switch_2(S).",
        "-marked(S) if -switch_1(S), feature_3(S, green).",
    ]
    colours = FEATURES["feature_0"]
    for number in range(24):
        first, second = number % 6, (number * 5 + 1) % 6
        lines.append(
            f"kind_of(S, kind_{number % 6}) if feature_{first}(S, {colours[number % 5]}), "
            f"{'not ' if number % 3 else ''}feature_{second}(S, {colours[(number * 2 + 1) % 5]}), "
            f"{('marked(S)', 'not bright(S)', '-switch_3(S)')[number % 3]}."
        )
    return read_knowledge("\n".join(lines), file="wide.al")


def wide_schema() -> SceneSchema:
    """The schema of :func:`wide_knowledge`."""
    features = {
        name: {value: Literal(name, ("thing", value)) for value in values}
        for name, values in FEATURES.items()
    }
    for name in SWITCHES:
        literal = Literal(name, ("thing",))
        features[name] = {"yes": literal, "no": literal.complement}
    classes = {name: Literal("kind_of", ("thing", name)) for name in CLASSES}
    return SceneSchema("thing", features, classes, {})


def wide_vectors(count: int, *, seed: int = 0) -> list[FeatureVector]:
    """``count`` distinct feature vectors at random."""
    generator = np.random.default_rng(seed)
    values = [tuple(possible) for possible in wide_schema().features.values()]
    found: dict[FeatureVector, None] = {}
    while len(found) < count:
        found[tuple(possible[int(generator.integers(len(possible)))] for possible in values)] = None
    return list(found)
