"""Write a domain of classes and features that somebody named, without a labelled picture."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from seewhy.data.importers.annotation import AnnotatedPicture, Box, Notes
from seewhy.data.importers.class_features import ClassFeatures, read_class_features
from seewhy.data.importers.names import same_words
from seewhy.data.importers.vocabulary import Vocabulary, vocabulary_of
from seewhy.data.importers.writing import CLASSES, class_table
from seewhy.dialogue.vocabulary import says_something
from seewhy.errors import DatasetError, DomainError
from seewhy.new_domain.from_pictures import WrittenDomain, write_domain_of
from seewhy.new_domain.sketch import (
    SketchThings,
    look_features,
    sketch_feature,
    sketch_of_vocabulary,
)
from seewhy.new_domain.thing_texts import RELATIONS
from seewhy.new_domain.words import in_a_sentence

__all__ = ["MOST_THINGS", "NamedDomain", "domain_from_names", "named_classes", "named_features"]

MOST_THINGS = 12
"""So many things a picture may show, where nothing else is said."""

_MOST_THINGS = 50
_YES_OR_NO = ("yes", "no")
_TABLE = "the table of classes"


@dataclass(frozen=True)
class NamedDomain:
    """What somebody named.

    Attributes
    ----------
    classes : sequence of str
        In their words.
    features : mapping of str to sequence of str
        Feature → its values, in their words.
    table : str
        A table with a row a class and a column a feature, for what follows from the class; its
        classes and features need not be named otherwise. Empty for none.
    subject : str
        How answers name the picture.
    thing : str
        What each of several things in a picture is called, as in "card"; empty where a picture is
        looked at as a whole. Then classes and features of the picture need not be named.
    of_things : mapping of str to sequence of str
        Feature of each thing → its values, in their words.
    most : int
        So many things a picture may show.
    """

    classes: Sequence[str] = ()
    features: Mapping[str, Sequence[str]] = field(default_factory=dict)
    table: str = ""
    subject: str = "the picture"
    thing: str = ""
    of_things: Mapping[str, Sequence[str]] = field(default_factory=dict)
    most: int = MOST_THINGS


def named_classes(text: str) -> tuple[str, ...]:
    """Return the classes of a text: a line each, or commas between them.

    Examples
    --------
    >>> named_classes("good, spoilt\\nunripe")
    ('good', 'spoilt', 'unripe')
    """
    parts = (part.strip() for line in text.splitlines() for part in line.split(","))
    return tuple(dict.fromkeys(part for part in parts if part))


def named_features(text: str) -> dict[str, tuple[str, ...]]:
    """Return feature → values of a text with a line a feature; one without values is yes or no.

    Raises
    ------
    DomainError
        If a line has no name or one value only, or a feature is named twice.

    Examples
    --------
    >>> named_features("colour: red, green\\nhas spots")
    {'colour': ('red', 'green'), 'has spots': ('yes', 'no')}
    """
    found: dict[str, tuple[str, ...]] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        name, colon, rest = (part.strip() for part in line.partition(":"))
        values = named_classes(rest) if colon else _YES_OR_NO
        if not name:
            raise DomainError(
                f"features, line {number}: has no name before the colon; write one such as "
                "'colour: red, green'"
            )
        if len(values) < 2:
            raise DomainError(
                f"features, line {number}: '{name}' needs at least two values with commas between "
                "them, or no colon where it is yes or no"
            )
        if same_words(name) in map(same_words, found):
            raise DomainError(
                f"features, line {number}: '{name}' is named twice; remove one of the lines"
            )
        found[name] = values
    return found


def domain_from_names(named: NamedDomain, folder: Path, *, data: str) -> WrittenDomain:
    """Write a domain folder, whole or not at all; it passes ``seewhy check``.

    Parameters
    ----------
    named : NamedDomain
    folder : Path
        The domain's; its name is that of the domain.
    data : str
        The folder of the pictures, for README.md.

    Raises
    ------
    DatasetError, DomainError
        If fewer than two classes are named, the table is none, or the folder is taken; if things
        have no feature, or one that the picture has, too.

    Examples
    --------
    >>> fruit = NamedDomain(("good", "spoilt"), {"colour": ("red", "brown")}, subject="the apple")
    >>> written = domain_from_names(fruit, Path(tempfile.mkdtemp()) / "fruit", data="photos")
    >>> written.classes, written.features
    (2, 1)
    """
    if not says_something(named.subject):
        raise DomainError(f"'{named.subject}' has no word; write one such as 'the apple'")
    said = _table_of(named.table) if named.table.strip() else None
    # What is named is what pictures would show, one a class and one a value.
    pictures = [
        *(AnnotatedPicture("", name) for name in named.classes),
        *(
            AnnotatedPicture("", "", {feature: value})
            for feature, values in named.features.items()
            for value in values
        ),
    ]
    if said is not None and named.classes:
        said = said.for_classes(named.classes)
    vocabulary = vocabulary_of(pictures, said, Notes(), as_said=True)
    things = _things(named, vocabulary)
    if len(vocabulary.classes) == 1 or (things is None and not vocabulary.classes):
        raise DomainError(
            "classes: name at least two, with commas between them; they are what a picture may be"
        )
    has_look = not vocabulary.features and things is None
    if has_look:
        said = look_features(vocabulary)
        vocabulary = vocabulary_of(pictures, said, Notes(), as_said=True)
    sketch = sketch_of_vocabulary(
        vocabulary,
        said,
        name=folder.name,
        subject=named.subject,
        source="names",
        is_look=has_look,
        things=things,
    )
    commands = (
        f"seewhy check {folder}",
        f"seewhy train {folder} --data {data} --out {data}/model",
        f"seewhy evaluate {data}/model --data {data}",
    )
    return write_domain_of(
        sketch,
        folder,
        classes_table="" if said is None else class_table(said, vocabulary),
        commands=commands,
        data=data,
    )


def _things(named: NamedDomain, vocabulary: Vocabulary) -> SketchThings | None:
    """What is said of the things in a picture; None where it is looked at as a whole."""
    one = in_a_sentence(named.thing)
    if not says_something(one):
        if named.of_things:
            raise DomainError(
                "things: say what one of them is called, such as 'card', or leave their features "
                "out"
            )
        return None
    if not named.of_things:
        raise DomainError(
            f"things: say what there is to see of each {one}, a feature in a line such as "
            "'colour: red, green'"
        )
    if not 1 <= named.most <= _MOST_THINGS:
        raise DomainError(
            f"things: a picture may show 1 to {_MOST_THINGS} of them, got {named.most}"
        )
    # What is named is what boxes would say of things, one a value.
    boxes = tuple(
        Box(0.0, 0.0, 1.0, 1.0, "", {feature: value})
        for feature, values in named.of_things.items()
        for value in values
    )
    picture = AnnotatedPicture("", boxes=boxes)
    attributes = vocabulary_of([picture], None, Notes(), as_said=True).attributes
    of_picture = {each.name: each.words for each in vocabulary.features.values()}
    taken = {*of_picture, *vocabulary.classes.values()}
    for words in attributes.values():
        if words.name in taken:
            raise DomainError(
                f"things: '{words.words}' is a feature or a class of the picture, too; call one "
                "of the two otherwise"
            )
    measured = {**of_picture, **{words.name: words.words for words in attributes.values()}}
    for name in RELATIONS:
        if name in measured:
            raise DomainError(
                f"'{measured[name]}' is what is measured between two things; call the feature "
                "otherwise"
            )
    features = {words.name: sketch_feature(words) for words in attributes.values()}
    return SketchThings(one, features, named.most)


def _table_of(text: str) -> ClassFeatures:
    """The table of a text; errors name lines of the text and no file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / CLASSES
        path.write_text(text, encoding="utf-8")
        try:
            return replace(read_class_features(path), said=_TABLE)
        except DatasetError as problem:
            raise DatasetError(str(problem).replace(str(path), _TABLE)) from None
