"""The names of a source's classes, features and values, and the words that they come from."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from seewhy.data.importers.annotation import AnnotatedPicture, Box, Notes
from seewhy.data.importers.class_features import ClassFeatures
from seewhy.data.importers.names import distinct_names
from seewhy.data.importers.yes_or_no import yes_or_no
from seewhy.data.thing import CORNERS
from seewhy.domain.tables import NO_THINGS, RESERVED, SCENE, TOGETHER
from seewhy.domain.things import RESERVED as OF_THINGS

THING_COLUMNS = ("image", "thing", *CORNERS, "kind")
MOST_VALUES = 100
"""What has more different values is no feature."""

TOO_MANY_VALUES = f"columns with more than {MOST_VALUES} different values, left out"


@dataclass(frozen=True)
class FeatureWords:
    """A feature: its name, its words, and value in words → name of the value.

    ``is_boolean`` features have the values "yes" and "no".
    """

    name: str
    words: str
    values: Mapping[str, str]
    is_boolean: bool

    @property
    def value_words(self) -> dict[str, str]:
        """Name of a value → the first words for it."""
        return {"yes": "yes", "no": "no"} if self.is_boolean else _first_words(self.values)


@dataclass(frozen=True)
class Vocabulary:
    """All names that a source needs.

    Attributes
    ----------
    classes : mapping of str to str
        Class in words → its name.
    features, attributes : mapping of str to FeatureWords
        Feature (of a picture, of a box) in words → its name and values.
    kinds : mapping of str to str
        Kind of box in words → its name.
    """

    classes: Mapping[str, str]
    features: Mapping[str, FeatureWords]
    kinds: Mapping[str, str]
    attributes: Mapping[str, FeatureWords]

    @property
    def class_words(self) -> dict[str, str]:
        """Name of a class → the first words for it."""
        return _first_words(self.classes)

    @property
    def kind_words(self) -> dict[str, str]:
        """Name of a kind of box → the first words for it."""
        return _first_words(self.kinds)


def vocabulary_of(
    pictures: Sequence[AnnotatedPicture],
    class_features: ClassFeatures | None,
    notes: Notes,
    *,
    as_said: bool = False,
) -> Vocabulary:
    """Return the names for what a source says, in a natural order, or in the order it is said in.

    Spellings that mean the same become one name. What has too many values to be a feature is
    left out and noted.

    Examples
    --------
    >>> shown = [AnnotatedPicture("a.jpg", "Big Cat", {"Has Tail": "True"}),
    ...          AnnotatedPicture("b.jpg", "10", {"Has Tail": "false"}),
    ...          AnnotatedPicture("c.jpg", "9")]
    >>> found = vocabulary_of(shown, None, Notes())
    >>> found.classes
    {'9': '9', '10': '10', 'Big Cat': 'big_cat'}
    >>> found.features["Has Tail"].values
    {'false': 'no', 'True': 'yes'}
    """
    order = list if as_said else naturally
    classes = dict.fromkeys(picture.class_name for picture in pictures if picture.class_name)
    if class_features is not None:
        classes |= dict.fromkeys(class_features.values)
    said: dict[str, dict[str, None]] = {}
    for feature in class_features.features if class_features is not None else ():
        said[feature] = {}
    for values in class_features.values.values() if class_features is not None else ():
        _collect(said, values)
    for picture in pictures:
        _collect(said, picture.features)
    boxes = [box for picture in pictures for box in picture.boxes]
    of_boxes: dict[str, dict[str, None]] = {}
    for box in boxes:
        _collect(of_boxes, box.attributes)
    names = distinct_names(order(classes))
    _note_merged(names, "classes", notes)
    return Vocabulary(
        classes=names,
        # A feature that was called like a class would make both ambiguous.
        features=_features(
            said, (*RESERVED, NO_THINGS, TOGETHER, SCENE, *names.values()), notes, order
        ),
        kinds=distinct_names(order(dict.fromkeys(box.kind for box in boxes if box.kind))),
        attributes=_features(of_boxes, OF_THINGS, notes, order),
    )


def naturally(texts: Iterable[str]) -> list[str]:
    """Return texts in the order in which a person puts them: numbers by their size.

    Examples
    --------
    >>> naturally(["b10", "b9", "a"])
    ['a', 'b9', 'b10']
    """

    def order(text: str) -> tuple[list[tuple[int, int, str]], str]:
        pieces = re.findall(r"\d{1,18}|\D+|\d+", text.casefold())
        return [
            (0, int(piece), "") if piece.isdecimal() and len(piece) <= 18 else (1, 0, piece)
            for piece in pieces
        ], text

    return sorted(texts, key=order)


def named_features(
    features: Mapping[str, str], words: Mapping[str, FeatureWords]
) -> dict[str, str]:
    """Return feature name → value name of what is said in words.

    Examples
    --------
    >>> colour = FeatureWords("colour", "Colour", {"Dark Red": "dark_red"}, is_boolean=False)
    >>> named_features({"Colour": "Dark Red", "left out": "1"}, {"Colour": colour})
    {'colour': 'dark_red'}
    """
    return {
        words[feature].name: words[feature].values[value]
        for feature, value in features.items()
        if feature in words
    }


def named_box(box: Box, vocabulary: Vocabulary) -> tuple[str, dict[str, str]]:
    """Return the name of a box's kind, and those of its attributes and their values."""
    kind = vocabulary.kinds.get(box.kind, "")
    return kind, named_features(box.attributes, vocabulary.attributes)


def _first_words(names: Mapping[str, str]) -> dict[str, str]:
    found: dict[str, str] = {}
    for words, name in names.items():
        found.setdefault(name, words)
    return found


def _collect(said: dict[str, dict[str, None]], features: Mapping[str, str]) -> None:
    for feature, value in features.items():
        said.setdefault(feature, {}).setdefault(value)


def _features(
    said: Mapping[str, Iterable[str]],
    taken: Sequence[str],
    notes: Notes,
    order: Callable[[Iterable[str]], list[str]],
) -> dict[str, FeatureWords]:
    kept = {feature: list(values) for feature, values in said.items()}
    for feature, values in list(kept.items()):
        if len(values) > MOST_VALUES:
            notes.add(TOO_MANY_VALUES, f"{feature} ({len(values):,}, such as '{values[0]}')")
            del kept[feature]
    names = distinct_names(kept, taken=taken, predicates=True)
    merged: dict[str, list[str]] = {}
    for feature in kept:
        merged.setdefault(names[feature], []).append(feature)
    found: dict[str, FeatureWords] = {}
    for name, spellings in merged.items():
        values = order(dict.fromkeys(value for feature in spellings for value in kept[feature]))
        booleans = yes_or_no(values)
        words = FeatureWords(
            name=name,
            words=spellings[0],
            values=distinct_names(values) if booleans is None else booleans,
            is_boolean=booleans is not None,
        )
        for feature in spellings:
            found[feature] = words
    return {feature: found[feature] for feature in kept}


def _note_merged(names: Mapping[str, str], what: str, notes: Notes) -> None:
    by_name: dict[str, list[str]] = {}
    for words, name in names.items():
        by_name.setdefault(name, []).append(words)
    for spellings in by_name.values():
        if len(spellings) > 1:
            notes.add(f"{what} that are spelt differently, taken as one", " = ".join(spellings))
