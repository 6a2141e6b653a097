"""imported.json: what a dataset was imported from, and the words behind its names."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from seewhy.data.importers.file_names import RECORD
from seewhy.data.importers.vocabulary import FeatureWords, Vocabulary
from seewhy.errors import DatasetError


class FeatureRecord(BaseModel):
    """The words of a feature: its own, and value → words."""

    model_config = ConfigDict(extra="ignore")

    words: str
    is_boolean: bool = False
    values: dict[str, str] = Field(default_factory=dict)


class WordsRecord(BaseModel):
    """Name → words, of classes, features, kinds of things and their attributes."""

    model_config = ConfigDict(extra="ignore")

    classes: dict[str, str] = Field(default_factory=dict)
    features: dict[str, FeatureRecord] = Field(default_factory=dict)
    kinds: dict[str, str] = Field(default_factory=dict)
    attributes: dict[str, FeatureRecord] = Field(default_factory=dict)


class Record(BaseModel):
    """The whole of imported.json."""

    model_config = ConfigDict(extra="ignore")

    settings: dict[str, str]
    finished: bool = False
    words: WordsRecord = Field(default_factory=WordsRecord)
    report: dict[str, Any] = Field(default_factory=dict)


def read_record(folder: Path) -> Record | None:
    """Return what a dataset folder says of its import; None where it was not imported here.

    Raises
    ------
    DatasetError
        If the file is damaged.
    """
    path = folder / RECORD
    if not path.is_file():
        return None
    try:
        return Record.model_validate_json(path.read_bytes())
    except ValidationError:
        raise DatasetError(
            f"{path}: is not as the import wrote it; delete the folder and import again"
        ) from None


def words_of_vocabulary(vocabulary: Vocabulary) -> WordsRecord:
    """Return the words behind all names of a vocabulary."""
    return WordsRecord(
        classes=vocabulary.class_words,
        features={words.name: _feature(words) for words in vocabulary.features.values()},
        kinds=vocabulary.kind_words,
        attributes={words.name: _feature(words) for words in vocabulary.attributes.values()},
    )


def _feature(words: FeatureWords) -> FeatureRecord:
    return FeatureRecord(words=words.words, is_boolean=words.is_boolean, values=words.value_words)
