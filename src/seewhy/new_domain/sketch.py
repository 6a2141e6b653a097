"""What a domain to be written has: its classes and features, named and worded."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from seewhy.data.importers.class_features import ClassFeatures
from seewhy.data.importers.names import valid_name
from seewhy.data.importers.reading import ReadSource
from seewhy.data.importers.record import FeatureRecord, WordsRecord
from seewhy.data.importers.vocabulary import FeatureWords, Vocabulary, named_features
from seewhy.errors import DomainError
from seewhy.new_domain.words import in_a_sentence, plain_words

LOOK = "look"
_LOOK_WORDS = "look as a whole"


@dataclass(frozen=True)
class SketchFeature:
    """A feature: its words, and value → words; ``is_look`` says what the picture looks like."""

    words: str
    values: Mapping[str, str]
    is_boolean: bool = False
    is_look: bool = False


@dataclass(frozen=True)
class SketchThings:
    """The things in a picture: what one is called, its features, how many there may be."""

    one: str
    features: Mapping[str, SketchFeature]
    most: int


@dataclass(frozen=True)
class Sketch:
    """A domain to be written.

    Attributes
    ----------
    classes : mapping of str to str
        Class → its words.
    features : mapping of str to SketchFeature
    class_values : mapping
        Class → feature → value, where a table says what follows from a class; empty else.
    subject : str
        How answers name the picture; its last word names the sort.
    source : str
        What the domain is written from, for its first line.
    things : SketchThings or None
        Where a picture shows several; then there need be no classes and no features.
    """

    name: str
    classes: Mapping[str, str]
    features: Mapping[str, SketchFeature]
    class_values: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    subject: str = "the picture"
    source: str = ""
    things: SketchThings | None = None

    @property
    def has_look(self) -> bool:
        """Whether its one feature is what the picture looks like as a whole."""
        return any(feature.is_look for feature in self.features.values())


def sketch_of(
    read: ReadSource,
    *,
    name: str,
    subject: str,
    words: WordsRecord | None = None,
    is_look: bool = False,
) -> Sketch:
    """Return what a source that was read says.

    Parameters
    ----------
    read : ReadSource
    name, subject : str
    words : WordsRecord, optional
        The words behind names, where the source is a dataset that was imported.
    is_look : bool
        Whether its feature is that of :func:`look_features`.

    Raises
    ------
    DomainError
        If the source shows fewer than two classes.
    """
    return sketch_of_vocabulary(
        read.vocabulary,
        read.class_features,
        name=name,
        subject=subject,
        source=str(read.request.source),
        words=words,
        is_look=is_look,
    )


def sketch_of_vocabulary(
    vocabulary: Vocabulary,
    class_features: ClassFeatures | None,
    *,
    name: str,
    subject: str,
    source: str,
    words: WordsRecord | None = None,
    is_look: bool = False,
    things: SketchThings | None = None,
) -> Sketch:
    """Return what named classes and features make; see :func:`sketch_of`.

    Parameters
    ----------
    vocabulary : Vocabulary
    class_features : ClassFeatures or None
        What follows from the classes.
    name, subject, source : str
        As :class:`Sketch` has them.
    words, is_look
        As for :func:`sketch_of`.
    things : SketchThings, optional
        What a picture shows several of.
    """
    words = words or WordsRecord()
    classes = _distinct_words({**vocabulary.class_words, **_of(vocabulary, words)})
    if len(classes) < 2 and things is None:
        shown = f"one class only ('{next(iter(classes))}')" if classes else "no class"
        raise DomainError(
            f"{source}: says {shown}; a domain tells at least two classes apart: add pictures of "
            "another, or name what says the class (--class-column, --class, --inside)"
        )
    features = {}
    for feature in vocabulary.features.values():
        known = words.features.get(feature.name, FeatureRecord(words=feature.words))
        sketched = sketch_feature(feature, known)
        if is_look:
            sketched = SketchFeature(_LOOK_WORDS, classes, is_look=True)
        features[feature.name] = sketched
    return Sketch(
        name=name,
        classes=classes,
        features=features,
        class_values=_class_values(class_features, vocabulary),
        subject=subject,
        source=source,
        things=things,
    )


def sketch_feature(feature: FeatureWords, known: FeatureRecord | None = None) -> SketchFeature:
    """Return a feature with words for it and its values; ``known`` says some of them."""
    known = known or FeatureRecord(words=feature.words)
    spelt = {
        value: in_a_sentence(known.values.get(value, said))
        for value, said in feature.value_words.items()
    }
    return SketchFeature(
        _worded(in_a_sentence(known.words), feature.name),
        _distinct_words(spelt),
        is_boolean=feature.is_boolean,
    )


def _of(vocabulary: Vocabulary, words: WordsRecord) -> dict[str, str]:
    return {name: said for name, said in words.classes.items() if name in vocabulary.class_words}


def look_features(vocabulary: Vocabulary) -> ClassFeatures:
    """Return the feature that is the class itself, for a source that has no other.

    Knowledge and answers then have something to rest on: what the picture looks like as a whole.
    """
    values = {words: {LOOK: name} for words, name in vocabulary.classes.items()}
    return ClassFeatures((LOOK,), values, f"the feature '{LOOK}'")


def _class_values(said: ClassFeatures | None, vocabulary: Vocabulary) -> dict[str, dict[str, str]]:
    if said is None:
        return {}
    return {
        vocabulary.classes[label]: named_features(values, vocabulary.features)
        for label, values in said.values.items()
        if label in vocabulary.classes
    }


def _distinct_words(words: Mapping[str, str]) -> dict[str, str]:
    """Name → plain words, which are the name's own where two would be said alike."""
    found: dict[str, str] = {}
    used: Collection[str] = set()
    for name, said in words.items():
        spelt = _worded(plain_words(said), name)
        if valid_name(spelt) in used:
            spelt = plain_words(name)
        used = {*used, valid_name(spelt)}
        found[name] = spelt
    return found


def _worded(said: str, name: str) -> str:
    """Words that have a letter or digit in them, or else the name."""
    return said if any(character.isalnum() for character in said) else plain_words(name)
