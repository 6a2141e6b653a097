"""Knowledge whose reasons are the hardest to find: defaults given up, aggregates and loops.

Eleven features with 18,432 feature vectors, and those with unknown values; six axioms count, sum
or speak of every part, four are defaults, and two absences wait for each other.
"""

from __future__ import annotations

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.knowledge.scene import FeatureVector, SceneSchema

PARTS = tuple(f"part_{number}" for number in range(1, 9))
FEATURES = {
    "material": ("glass", "steel", "wood"),
    "colour": ("red", "green", "blue", "white"),
    "tilt": ("1", "2", "3", "4", "5", "6"),
}
KNOWLEDGE = f"""\
#sort thing.
#sort part = {{{", ".join(PARTS)}}}.
#sort stuff = {{{", ".join(FEATURES["material"])}}}.
#sort shade = {{{", ".join(FEATURES["colour"])}}}.
#sort degree = 1..6.
#static fixed(thing, part).
#static material(thing, stuff).
#static colour(thing, shade).
#static tilt(thing, degree).
#static covered(thing, part).
#static worn(thing).
#static loose(thing).
#static tight(thing).
#static steady(thing).
#static safe(thing).

default covered(S, P) if fixed(S, P).
-covered(S, P) if fixed(S, P), colour(S, red), material(S, glass).
worn(S) if thing(S), #count {{ P : fixed(S, P), not covered(S, P) }} >= 3.
worn(S) if thing(S), not #count {{ P : fixed(S, P) }} > 2.
loose(S) if worn(S), not tight(S).
tight(S) if tilt(S, N), N < 4, not loose(S).

default steady(S) if thing(S), not loose(S).
-steady(S) if thing(S), #sum {{ N : tilt(S, N); 2, P : -fixed(S, P) }} > 12.
-fixed(S, part_2) if steady(S), material(S, glass), not colour(S, white).
-covered(S, part_1) if steady(S), fixed(S, part_1), #max {{ N : tilt(S, N) }} >= 4.

default safe(S) if thing(S).
-safe(S) if -steady(S), #count {{ P : fixed(S, P) }} < 7.
-safe(S) if worn(S), tilt(S, N), N > 3.
default safe(S) if thing(S); fixed(S, P) : part(P).
"""


def default_knowledge() -> Knowledge:
    """Defaults for parts, for steadiness and for safety, with their exceptions."""
    return read_knowledge(KNOWLEDGE, file="default.al")


def default_schema() -> SceneSchema:
    """The schema of :func:`default_knowledge`."""
    features: dict[str, dict[str, Literal]] = {
        name: {value: Literal(name, ("thing", value)) for value in values}
        for name, values in FEATURES.items()
    }
    for part in PARTS:
        literal = Literal("fixed", ("thing", part))
        features[part] = {"yes": literal, "no": literal.complement}
    safe = Literal("safe", ("thing",))
    return SceneSchema("thing", features, {"safe": safe, "unsafe": safe.complement}, {})


def scene_with_exception() -> FeatureVector:
    """A glass thing with part 2 in place: that it is steady is given up, and it is not safe."""
    fixed = ("yes", "yes", "no", "yes", "no", "yes", "yes", "no")
    return ("glass", "green", "2", *fixed)
