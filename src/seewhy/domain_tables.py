"""The tables of a domain's files: what may stand in domain.toml, and in questions.toml."""

from __future__ import annotations

from typing import Annotated, get_args
from typing import Literal as OneOf

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

ReadingRule = OneOf["argmax", "consistent", "with_class"]
"""How a picture's features are read; see :mod:`seewhy.reading`."""

READINGS: tuple[ReadingRule, ...] = get_args(ReadingRule)

CLASS = "class"
RESERVED = ("image", CLASS, "split", "group", "reasons")
"""Columns of scenes.csv that are no features."""
"""What the network of the class is called among those of the features."""

TOGETHER = "together"
"""What all networks of features are called where they are trained together."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)


class DomainTable(_Table):
    """``[domain]``: what the domain is called, which sort stands for the picture, how it is read.

    Below a ``known_share`` of 1, that share of the pictures like those of training is answered,
    and of others it is said that they are not known.
    """

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    title: str
    scene: str
    subject: str
    source: str | None = None
    reading: ReadingRule = "argmax"
    known_share: float = Field(default=1.0, gt=0.0, le=1.0)


class PictureTable(_Table):
    """``[pictures]``: how pictures are shown to the networks, and how they may be varied.

    See :func:`seewhy.perception.picture.read_picture` for ``fit`` and
    :class:`seewhy.perception.options.TrainingOptions` for the variations. Where there are
    photographs to train on, ``drawn`` pictures of the source are trained on before.
    """

    size: int = Field(default=56, ge=16, le=512)
    fit: OneOf["pad", "stretch"] = "pad"
    standard: OneOf["set", "picture"] = "set"
    flip: bool = False
    shift: float = Field(default=0.05, ge=0.0, le=0.5)
    rotate: float = Field(default=0.0, ge=0.0, le=180.0)
    scale: float = Field(default=0.0, ge=0.0, le=0.9)
    shear: float = Field(default=0.0, ge=0.0, le=0.9)
    brightness: float = Field(default=0.1, ge=0.0, le=0.9)
    contrast: float = Field(default=0.1, ge=0.0, le=0.9)
    colour: float = Field(default=0.1, ge=0.0, le=0.9)
    noise: float = Field(default=2.0, ge=0.0, le=128.0)
    drawn: int = Field(default=0, ge=0, le=1_000_000)


Channels = Annotated[tuple[Annotated[int, Field(ge=1, le=4096)], ...], Field(min_length=1)]


class NetworkTable(_Table):
    """``[networks]``: how large the networks become and how they are trained.

    See :class:`seewhy.perception.options.TrainingOptions`, and for ``together``
    :func:`seewhy.perception.extractor.fit_extractor`.
    """

    depth: int = Field(default=1, ge=1, le=16)
    channels: Channels = (8, 16, 32, 64)
    dense: int = Field(default=64, ge=1, le=65_536)
    epochs: int = Field(default=18, ge=1, le=10_000)
    patience: int = Field(default=6, ge=1, le=10_000)
    batch: int = Field(default=64, ge=1, le=65_536)
    together: bool = False


def _with_letters(word: str) -> str:
    if not any(character.isalnum() for character in word):
        raise ValueError(f"must have a letter or a digit, got '{word}'")
    return word


def _with_it_alone(text: str) -> str:
    if set("{}") & set(_with_letters(text).replace("{it}", "")):
        raise ValueError(f"{{it}} is the only slot that there is, got '{text}'")
    return text


def _with_value(text: str) -> str:
    rest = _with_letters(text).replace("{it}", "").replace("{value}", "")
    if set("{}") & set(rest) or "{value}" not in text:
        raise ValueError(f"must have the slot {{value}} and may have {{it}}, got '{text}'")
    return text


Word = Annotated[str, AfterValidator(_with_letters)]
Clause = Annotated[str, AfterValidator(_with_it_alone)]
BeliefClause = Annotated[str, AfterValidator(_with_value)]


class ValueTable(_Table):
    """``[features.NAME.values.VALUE]``: how a value is said, asked for and brought about."""

    say: Clause
    words: tuple[Word, ...] = ()
    change: Clause | None = None


class FeatureTable(_Table):
    """``[features.NAME]``: one feature, recognised by a network of its own.

    ``channels`` and ``dense`` are those of ``[networks]`` where left out.
    """

    name: str
    threshold: float = Field(default=0.9, gt=0.0, le=1.0)
    channels: Channels | None = None
    dense: int | None = Field(default=None, ge=1, le=65_536)
    change_cost: int = Field(default=1, ge=1, le=1000)
    values: dict[str, ValueTable] = Field(min_length=1)


class ClassTable(_Table):
    """``[classes.NAME]``: one class, the literal that stands for it, and its words."""

    literal: str
    say: Word
    words: tuple[Word, ...] = ()


class BeliefTable(_Table):
    """``[beliefs.NAME]``: how a static that is no feature, and its values, are said."""

    name: Word | None = None
    say: BeliefClause | None = None
    values: dict[str, Word] = {}


class DomainFile(_Table):
    """The whole of ``domain.toml``."""

    domain: DomainTable
    pictures: PictureTable = PictureTable()
    networks: NetworkTable = NetworkTable()
    features: dict[str, FeatureTable] = Field(min_length=1)
    classes: dict[str, ClassTable] = Field(min_length=2)
    beliefs: dict[str, BeliefTable] = {}


class QuestionTable(_Table):
    """``[[question]]``: what is asked, and the ways to ask it."""

    asks: str
    feature: str | None = None
    value: str | None = None
    predicate: str | None = None
    patterns: tuple[str, ...] = Field(min_length=1)


class QuestionsFile(_Table):
    """The whole of ``questions.toml``."""

    synonyms: dict[str, tuple[str, ...]] = {}
    fillers: tuple[str, ...] = ()
    answers: dict[str, str] = {}
    question: tuple[QuestionTable, ...] = Field(min_length=1)
