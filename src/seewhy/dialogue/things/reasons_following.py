"""Why something follows, of things and of several together, down to what was seen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

from seewhy.dialogue.things.edits import scene_after
from seewhy.dialogue.things.following import (
    class_that_follows,
    completions,
    consequences,
    group_of,
    numbers_of,
    with_one_more,
)
from seewhy.dialogue.things.query import (
    ClassIs,
    Completing,
    Consequence,
    Groups,
    Together,
    WhichClass,
)
from seewhy.dialogue.things.supposing import supposed_edits
from seewhy.dialogue.things.telling_following import no_group
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.wording import join_words
from seewhy.knowledge.justification import Basis, Node
from seewhy.text.nouns import with_article

__all__ = [
    "of_class",
    "of_completing",
    "of_consequence",
    "of_groups",
    "of_part",
    "of_together",
    "shortened",
    "why_class",
    "why_concluded",
]

_MOST_DENIED = 4
"""Groups of which it is told why they are none; of more only their number."""

_DEPTH = 2
"""Of each thing that is left out of an answer, so many steps of the reason are told."""


def why_concluded(
    key: str, numbers: Sequence[int], words: ThingWords, *, subject: str | None = None
) -> Node:
    """Return why something is concluded of things, or why it is not.

    ``subject`` is what the first of them is called there.
    """
    scene = words.evaluation.scene
    text = f"{key}({','.join(map(words.term, numbers))})"
    if scene.conclusions is None:
        return Node(text, "nothing was concluded of the things", Basis.ABSENCE)
    names = _names(words)
    node = scene.conclusions.why(scene, key, numbers, names, without=words.evaluation.without)
    node = _named_once(node, [names[number] for number in numbers])
    if subject is None or subject == names[numbers[0]]:
        return node
    return replace(node, text=node.text.replace(names[numbers[0]], subject, 1))


def why_class(label: str, words: ThingWords) -> Node:
    """Return why the picture as a whole is of a class, or why it is not."""
    evaluation = words.evaluation
    scene, whole = evaluation.scene, words.things.whole
    if scene.conclusions is None:
        return Node("class", "nothing was concluded of the things", Basis.ABSENCE)
    if scene.label_seen and scene.label == label:
        text = f"{whole.say(label, be='looks')} as a whole"
        return Node("class", text, Basis.FEATURE, feature="class", value=label)
    return scene.conclusions.why_class(scene, label, _names(words), without=evaluation.without)


def of_class(query: ClassIs | WhichClass, words: ThingWords) -> Iterator[Node]:
    """Yield why the picture is of the class that it is; where that is open, why of none."""
    label = words.evaluation.scene.label
    if label is None and isinstance(query, ClassIs):
        label = query.label
    for asked in words.things.whole.classes if label is None else (label,):
        yield why_class(asked, words)


def _named_once(node: Node, names: Sequence[str]) -> Node:
    """The things of a group are named once, and are "the three" from there on."""
    if len(names) < 3:
        return node
    listed = join_words(list(names))
    children = (_renamed(child, listed, len(names)) for child in node.children)
    return replace(node, children=tuple(children))


def _renamed(node: Node, listed: str, count: int) -> Node:
    children = tuple(_renamed(child, listed, count) for child in node.children)
    text = node.text.replace(listed, f"the {number_word(count)}")
    return replace(node, text=text, children=children)


def shortened(node: Node, depth: int = _DEPTH) -> Node:
    """Return the beginning of a reason why something is not so: what lies deeper is left out."""
    children = tuple(shortened(child, depth - 1) for child in node.children) if depth else ()
    return replace(node, children=children)


def _names(words: ThingWords) -> list[str]:
    return [words.name(number) for number in range(words.evaluation.scene.count)]


def of_consequence(query: Consequence, words: ThingWords) -> Iterator[Node]:
    """Yield why each thing comes true."""
    evaluation = words.evaluation
    scene = evaluation.scene
    number = evaluation.the(query.one)
    found = consequences(query, evaluation)
    if found is None or scene.conclusions is None:
        return
    edits = supposed_edits(number, query.supposed, evaluation)
    then, without = scene_after(scene, evaluation.things, edits, without=evaluation.without)
    assert then.conclusions is not None, "nothing was concluded of the scene"
    for follows in found:
        if follows.relation is not None:
            yield why_concluded(follows.relation, (follows.number, number), words)
        else:
            yield then.conclusions.why(
                then, follows.conclusion, (follows.number,), _names(words), without=without
            )
    label = class_that_follows(query, evaluation)
    if label is not None:
        yield then.conclusions.why_class(then, label, _names(words), without=without)
    if not found and query.supposed is None:
        for key, relation in evaluation.things.relations.items():
            if relation.removed is not None:
                for other in range(scene.count):
                    if other != number:
                        yield why_concluded(key, (other, number), words)


def of_groups(query: Groups, words: ThingWords) -> Iterator[Node]:
    """Yield why each is such a group; where none is, in how many ways that was looked for."""
    evaluation = words.evaluation
    found = evaluation.scene.groups.get(query.group, ())
    for numbers in found:
        yield why_concluded(query.group, numbers, words)
    if found:
        return
    group = words.things.groups[query.group]
    ways = list(combinations(range(evaluation.scene.count), group.size))
    denied = ways if len(ways) <= _MOST_DENIED else []
    children = tuple(why_concluded(query.group, numbers, words) for numbers in denied)
    yield Node("not", no_group(group, words), Basis.ABSENCE, children=children)


def of_part(group: str, number: int, words: ThingWords) -> Iterator[Node]:
    """Yield why the groups of which a thing is one are such."""
    for numbers in words.evaluation.scene.groups.get(group, ()):
        if number in numbers:
            yield why_concluded(group, numbers, words)


def of_together(query: Together, words: ThingWords) -> Iterator[Node]:
    """Yield why things are such a group, or why they are none."""
    numbers = numbers_of(query.ones, words.evaluation)
    if len(numbers) == words.things.groups[query.group].size:
        yield why_concluded(query.group, numbers, words)


def of_completing(query: Completing, words: ThingWords) -> Iterator[Node]:
    """Yield why each thing that would complete a group does."""
    evaluation = words.evaluation
    scene = evaluation.scene
    group = group_of(query, words.things.groups)
    chosen = numbers_of(query.ones, evaluation)
    for completion in completions(query, evaluation) or ():
        if completion.number is not None:
            yield why_concluded(group.key, sorted((*chosen, completion.number)), words)
        elif scene.conclusions is not None and scene.count < words.things.most:
            more = with_one_more(scene, evaluation, completion.values)
            names = [*_names(words), with_article(words.described(completion.values))]
            numbers = (*chosen, scene.count)
            node = scene.conclusions.why(more, group.key, numbers, names)
            yield _named_once(node, [names[number] for number in numbers])
