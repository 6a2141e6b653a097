"""What the files of a new domain say of the things in a picture."""

from __future__ import annotations

import json
from collections.abc import Sequence

from seewhy.data.importers.names import predicate_name
from seewhy.new_domain.sketch import Sketch, SketchFeature, SketchThings
from seewhy.new_domain.words import boolean_clauses, plain_words

__all__ = ["RELATIONS", "sort_of_things", "thing_knowledge_lines", "thing_lines", "thing_statics"]

RELATIONS = {
    "left": ("right", "left of", ("to the left of", "on the left of"), "leftmost", ("left",)),
    "right": ("left", "right of", ("to the right of", "on the right of"), "rightmost", ("right",)),
    "above": ("below", "above", ("higher than",), "topmost", ("top",)),
    "below": ("above", "below", ("lower than",), "lowest", ("bottom",)),
}
"""What boxes measure: its converse, words, further words, what the first is, and its side."""


def sort_of_things(sketch: Sketch, taken: Sequence[str]) -> str:
    """Return the sort that stands for a thing; none of the names that are taken."""
    assert sketch.things is not None
    sort = predicate_name(sketch.things.one.split()[-1])
    return sort if sort not in {*taken, *thing_statics(sketch.things)} else f"one_{sort}"


def thing_statics(things: SketchThings) -> list[str]:
    """Return the statics about things: their features, and what is measured."""
    return [*things.features, *RELATIONS]


def thing_lines(things: SketchThings, sort: str) -> list[str]:
    """Return the lines of ``[things]`` in domain.toml."""
    lines = [
        "",
        "# What a picture may show several of. `seewhy reference` lists what else may stand here;",
        '# relations that boxes do not measure ("on") have measure = "seen", and are labelled.',
        "[things]",
        f"sort = {json.dumps(sort)}",
        f"most = {things.most}",
        f"one = {_quoted(things.one)}",
    ]
    for name, feature in things.features.items():
        lines += ["", f"[things.features.{name}]", f"name = {_quoted(feature.words)}"]
        lines += ["", f"[things.features.{name}.values]", *_value_lines(feature)]
    for name, (converse, first, others, most, side) in RELATIONS.items():
        lines += [
            "",
            f"[things.relations.{name}]",
            f"measure = {json.dumps(name)}",
            f'say = "{{0}} is {first} {{1}}"',
            f"words = {json.dumps([first, *others])}",
            f"most = {json.dumps([most])}",
            f"side = {json.dumps(list(side))}",
            f"converse = {json.dumps(converse)}",
        ]
    return lines


def thing_knowledge_lines(things: SketchThings, sort: str) -> list[str]:
    """Return the declarations of what is seen of things."""
    lines = [f"#static {name}({sort}, {sort})." for name in RELATIONS]
    for name, feature in things.features.items():
        value = "" if feature.is_boolean else f", {name}_value"
        lines.append(f"#static {name}({sort}{value}).")
    return lines


def _value_lines(feature: SketchFeature) -> list[str]:
    if not feature.is_boolean:
        return [
            f"{value} = {{}}"
            if plain_words(value) == words
            else f"{value} = {{ words = [{_quoted(words)}] }}"
            for value, words in feature.values.items()
        ]
    yes, no = boolean_clauses(feature.words)
    said = yes.removeprefix("{it} ")
    called = f", words = [{_quoted(said.removeprefix('is '))}]" if said.startswith("is ") else ""
    if said.startswith("has "):
        called = f", behind = {_quoted(said.replace('has ', 'with ', 1))}"
    return [f"yes = {{ say = {_quoted(yes)}{called} }}", f"no = {{ say = {_quoted(no)} }}"]


def _quoted(text: str) -> str:
    """A TOML string."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "")
