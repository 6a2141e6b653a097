"""The texts of a domain's files."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence

from seewhy.data.importers.names import predicate_name, valid_name
from seewhy.data.thing import CORNERS
from seewhy.dialogue.vocabulary import says_something
from seewhy.new_domain.common_keys import common_keys
from seewhy.new_domain.proposals import Proposals
from seewhy.new_domain.sketch import LOOK, Sketch, SketchFeature
from seewhy.new_domain.thing_texts import sort_of_things, thing_knowledge_lines, thing_lines
from seewhy.new_domain.words import (
    as_predicate,
    boolean_changes,
    boolean_clauses,
    boolean_questions,
    look_clause,
    plain_words,
)

_WIDTH = 96
_ABOUT_CLASSES = {
    "class": ["what is {it}", "what kind of {scene} is it", "what can you say about {it}"],
    "is_class": ["is {it} {class}", "is it {class}"],
    "why_not_class": ["why is {it} not {class}", "why not {class}", "what speaks against {class}"],
    "why_class": [
        "why is {it} {class}",
        "what makes {it} {class}",
        "why do you say it is {class}",
        "how do you know that it is {class}",
    ],
    "change_to_class": [
        "what would make {it} {class}",
        "what would have to change to make {it} {class}",
    ],
    "difference_to_class": [
        "how does {it} differ from {class}",
        "how is {it} different from {class}",
    ],
}


def scene_sort(sketch: Sketch) -> str:
    """Return the sort that stands for the picture; never the name of a feature."""
    words = [word for word in sketch.subject.split() if says_something(word)]
    sort = predicate_name([sketch.subject, *words][-1])
    return sort if sort not in sketch.features else f"shown_{sort}"


def class_predicate(sketch: Sketch) -> tuple[str, str]:
    """Return the static that says the class, and the sort of the classes."""
    taken = {*sketch.features, scene_sort(sketch), *map(value_sort, sketch.features)}
    static = next(name for name in ("of_kind", "of_class", "classified_as") if name not in taken)
    sort = next(name for name in ("kind", "scene_class", "class_value") if name not in taken)
    return static, sort


def value_sort(feature: str) -> str:
    """Return the sort of a feature's values."""
    return f"{feature}_value"


def thing_sort(sketch: Sketch) -> str:
    """Return the sort that stands for a thing in a picture."""
    taken = (*sketch.features, *class_predicate(sketch), scene_sort(sketch))
    return sort_of_things(sketch, taken)


def domain_text(sketch: Sketch) -> str:
    """Return domain.toml."""
    static, _ = class_predicate(sketch)
    lines = [
        f"# {_title(sketch)}: written from {_comment(sketch.source)}; edit it as you like.",
        "# What pictures show and how it is said: {it} stands for the subject.",
        "# `seewhy reference` lists every key; those that are often wanted stand here as comments,",
        "# each with an example.",
        "",
        "[domain]",
        f"name = {_quoted(sketch.name)}",
        f"title = {_quoted(_title(sketch))}",
        f"scene = {_quoted(scene_sort(sketch))}",
        f"subject = {_quoted(sketch.subject)}",
        "",
        *common_keys("domain"),
        "",
        "# [pictures]",
        *common_keys("pictures"),
    ]
    if sketch.has_look:
        lines += [
            "",
            "# The one feature says what the picture looks like as a whole, which is its class.",
            "# Features of your own (a colour, a shape, a part that is there or not) make reasons.",
        ]
    for name, feature in sketch.features.items():
        lines += ["", *_feature_lines(name, feature)]
    if sketch.things is not None:
        lines += thing_lines(sketch.things, thing_sort(sketch))
    if sketch.classes:
        lines += ["", f'# Answers say "{sketch.subject} is …" of a class.']
    for name, words in sketch.classes.items():
        said = as_predicate(words)
        # The name is a word for it where the words alone do not lead to it.
        others = [] if valid_name(words) == name else [said, plain_words(name)]
        lines += [
            "",
            f"[classes.{_key(name)}]",
            f'literal = "{static}(S, {name})"',
            f"say = {_quoted(said)}",
            *([f"words = {_listed(others)}"] if others else []),
        ]
    return "\n".join(lines) + "\n"


def knowledge_text(
    sketch: Sketch, axioms: Sequence[tuple[str, str]], proposed: Proposals, example: str
) -> str:
    """Return knowledge.al: the signature, axioms (their sentence and statement), or an example."""
    static, sort = class_predicate(sketch)
    scene = scene_sort(sketch)
    lines = [
        f"% The signature: sorts, and statics over them. '{scene}' is the picture at hand.",
        f"#sort {scene}.",
        *(_sort_lines(sort, sketch.classes) if sketch.classes else ()),
    ]
    things = sketch.things
    if things is not None:
        lines.append(f"#sort {thing_sort(sketch)} = things.")
        for name, feature in things.features.items():
            if not feature.is_boolean:
                lines += _sort_lines(value_sort(name), feature.values)
    for name, feature in sketch.features.items():
        if feature.is_look:
            continue
        if not feature.is_boolean:
            lines += _sort_lines(value_sort(name), feature.values)
    for name, feature in sketch.features.items():
        if feature.is_boolean:
            lines.append(f"#static {name}({scene}).")
        else:
            lines.append(
                f"#static {name}({scene}, {sort if feature.is_look else value_sort(name)})."
            )
    if things is not None:
        lines += thing_knowledge_lines(things, thing_sort(sketch))
    lines += [f"#static {static}({scene}, {sort}).", ""] if sketch.classes else [""]
    if sketch.has_look:
        lines += [
            "% Nothing but its look as a whole says what a picture shows; features would say more.",
            f"%% {sketch.subject} is of the kind that it looks like",
            f"{static}(S, K) if {LOOK}(S, K).",
        ]
    elif axioms:
        lines += [
            "% Proposals, which follow from classes.csv: each class by the fewest values that tell",
            "% it from all others there. The line above each (%%) is its sentence and appears in",
            "% answers. Change them, and add what you know.",
        ]
        for sentence, statement in axioms:
            lines += ["", f"%% {_comment(sentence)}", statement]
    else:
        lines += [
            "% Here belong axioms: what everybody knows who knows such pictures. They need not",
            "% cover everything: what they leave open is learned from your pictures."
            f"{' For example,' if example else ''}",
        ]
        if example:
            lines += ["% without the first % of each line:", "%"]
            lines += [f"% {line}" for line in example.splitlines()]
    for name, other in proposed.alike.items():
        lines += [
            "",
            f"% Nothing in classes.csv tells {name} from {other}: the pictures have to.",
        ]
    return "\n".join(lines) + "\n"


def questions_text(sketch: Sketch) -> str:
    """Return questions.toml."""
    scene = plain_words(scene_sort(sketch))
    lines = [
        "# What can be asked, and in which words. {it} stands for the picture's subject, {class}",
        "# for the words of a class, {value} for the words of a value; [...] may be left out.",
        "",
        'fillers = ["please", "can you tell me", "could you tell me", "do you think"]',
    ]
    for asks, patterns in _ABOUT_CLASSES.items() if sketch.classes else ():
        worded = [pattern.replace("{scene}", scene) for pattern in patterns]
        lines += _question({"asks": asks}, worded)
    for name, feature in sketch.features.items():
        if feature.is_boolean:
            keys = {"asks": "feature_is", "feature": name, "value": "yes"}
            lines += _question(keys, boolean_questions(feature.words))
            continue
        lines += _question(
            {"asks": "feature_value", "feature": name},
            ["what does {it} look like", "what does it look like"]
            if feature.is_look
            else [
                f"what is the {feature.words} of {{it}}",
                f"what is the {feature.words}",
                f"which {feature.words} does {{it}} have",
                f"what {feature.words} is {{it}}",
            ],
        )
        lines += _question(
            {"asks": "feature_is", "feature": name},
            ["does {it} look like {value}", "does {it} look {value}"]
            if feature.is_look
            else [
                f"is the {feature.words} of {{it}} {{value}}",
                f"is the {feature.words} {{value}}",
                f"does {{it}} have the {feature.words} {{value}}",
            ],
        )
    lines += _question(
        {"asks": "explain"}, ["please explain this answer", "explain your answer", "explain", "why"]
    )
    return "\n".join(lines) + "\n"


def readme_text(sketch: Sketch, commands: Sequence[str], data: str) -> str:
    """Return README.md."""
    columns = ",".join(["image", *(["class"] if sketch.classes else []), *sketch.features])
    features = (
        "Its one feature is what a picture looks like as a whole, because no other was found.\n"
        "That classifies pictures, but `why` has one reason only. Features of your own make\n"
        "reasons: write a table with a row a class and a column a feature (`class,colour,round`)\n"
        "and give it to `seewhy new … --from … --features TABLE`; or add columns to `scenes.csv`,\n"
        "declare them in `knowledge.al` and say them in `domain.toml`.\n"
        if sketch.has_look
        else "Edit the words in `domain.toml`: they are made from names, and you say it better.\n"
    )
    proposals = (
        "The axioms in `knowledge.al` are proposals that follow from `classes.csv`, which has the\n"
        "features of every class. Change them, and add what you know.\n"
        if sketch.class_values and not sketch.has_look
        else "`knowledge.al` has a place for axioms: what everybody knows who knows such\n"
        "pictures.\n"
    )
    listed = "\n".join(f"    {command}" for command in commands)
    of_things = (
        ""
        if sketch.things is None
        else f", and {len(sketch.things.features)} of each {sketch.things.one} in a picture"
    )
    return (
        f"# {sketch.name}\n\n"
        f"A domain of SeeWhy with {len(sketch.classes)} classes and {len(sketch.features)} "
        f"feature{'s' * (len(sketch.features) != 1)}{of_things}: what pictures show\n"
        "(`domain.toml`), what is known (`knowledge.al`), what can be asked (`questions.toml`).\n\n"
        f"{listed}\n\n{features}\n{proposals}\n"
        f"The pictures lie in `{data}` beside a table `scenes.csv`, one row a picture:\n\n"
        f"    {columns}\n\n{_boxes_text(sketch)}"
        "An empty cell is a value that nobody knows. A column `split` with the words `train` and\n"
        "`test` says which pictures are kept for evaluation; pictures that show the same thing\n"
        "share a word in a column `group`. Every key of the files: `seewhy reference`.\n"
    )


def _boxes_text(sketch: Sketch) -> str:
    """What README.md says of the table of things; empty where there are none."""
    if sketch.things is None:
        return ""
    columns = ",".join(["image", "thing", *CORNERS, *sketch.things.features])
    return f"Beside it lies `things.csv`, one row a {sketch.things.one}:\n\n    {columns}\n\n"


def _feature_lines(name: str, feature: SketchFeature) -> list[str]:
    lines = [
        f"[features.{_key(name)}]",
        f"name = {_quoted(feature.words)}",
        "",
        f"[features.{_key(name)}.values]",
    ]
    if feature.is_boolean:
        clauses, changes = boolean_clauses(feature.words), boolean_changes(feature.words)
        for value, clause, change in zip(("yes", "no"), clauses, changes, strict=True):
            lines.append(f"{value} = {{ say = {_quoted(clause)}, change = {_quoted(change)} }}")
        return lines
    for value, words in feature.values.items():
        if feature.is_look:
            said = look_clause(words)
            change = said.replace("{it} looks", "let it look")
            more = f", change = {_quoted(change)}"
            others = [as_predicate(words)]
        else:
            said = f"the {feature.words} of {{it}} is {words}"
            more = f", change = {_quoted(f'let the {feature.words} be {words}')}"
            others = [words]
        if plain_words(value) != others[0]:
            more = f", words = {_listed(others)}{more}"
        lines.append(f"{_key(value)} = {{ say = {_quoted(said)}{more} }}")
    return lines


def _question(keys: Mapping[str, str], patterns: Iterable[str]) -> list[str]:
    return [
        "",
        "[[question]]",
        *(f"{key} = {_quoted(value)}" for key, value in keys.items()),
        "patterns = [",
        *(f"  {_quoted(pattern)}," for pattern in patterns),
        "]",
    ]


def _sort_lines(name: str, members: Iterable[str]) -> list[str]:
    """The declaration of a sort, broken into lines of fair length."""
    lines, line = [], f"#sort {name} = {{"
    for number, member in enumerate(members):
        piece = f"{', ' if number else ''}{member}"
        if number and len(line) + len(piece) > _WIDTH:
            lines.append(f"{line},")
            line, piece = "    ", member
        line += piece
    return [*lines, f"{line}}}."]


def _title(sketch: Sketch) -> str:
    return plain_words(sketch.name).capitalize()


def _quoted(text: str) -> str:
    """A TOML string."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "")


def _listed(texts: Iterable[str]) -> str:
    return f"[{', '.join(map(_quoted, dict.fromkeys(texts)))}]"


def _key(name: str) -> str:
    """A TOML key; names of domains need no quotes."""
    return name


def _comment(text: str) -> str:
    return " ".join(text.split())
