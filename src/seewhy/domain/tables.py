"""What may stand in domain.toml."""

from __future__ import annotations

from typing import Annotated
from typing import Literal as OneOf

from pydantic import Field

from seewhy.domain.reading_rule import ReadingRule
from seewhy.domain.table_texts import BeliefClause, Clause, Key, Label, StrictTable, Word
from seewhy.domain.thing_tables import ThingsTable

EMBEDDED = "efficientnet-lite0"
"""The backbone that comes with SeeWhy."""

NONE = "none"
"""No backbone: networks grow on the domain's pictures alone, as in the paper."""

CLASS = "class"
"""What the network of the class is called among those of the features."""

SCENE = "scene"
"""What the whole picture is called among features, where eyes compare pictures."""

RESERVED = ("image", CLASS, "split", "group", "reasons")
"""Columns of scenes.csv that are no features."""

NO_THINGS = "things"
"""One more of these, where the domain has things: whether a picture is said to show none."""

TOGETHER = "together"
"""What all networks of features are called where they are trained together."""


class DomainTable(StrictTable):
    """``[domain]``: what the domain is called, which sort stands for the picture, how it is read.

    Below a ``known_share`` of 1, that share of the pictures like those of training is answered,
    and of others it is said that they are not known.
    """

    name: str = Field(
        pattern=r"^[a-z][a-z0-9_]*$",
        description="The domain's name in commands and in model files: small letters, digits and "
        "underscores.",
    )
    title: str = Field(max_length=200, description="The heading of reports and pages.")
    scene: str = Field(description="The sort of knowledge.al that stands for the picture.")
    subject: Label = Field(
        description="How answers name what a picture shows, as in `the apple`; {it} stands for it "
        "in all wordings.",
    )
    source: str | None = Field(
        default=None,
        description="The Python file of the domain's folder that makes pictures of the domain, for "
        "`seewhy data make`.",
    )
    eyes: str | None = Field(
        default=None,
        description="What sees: the name of a backbone, a network that has seen millions of "
        "pictures before and is tuned to the domain's, or `none` for networks that grow on the "
        f"domain's pictures alone, as in the paper. Where left out, `{EMBEDDED}`; `none` where "
        "training begins with drawings (`drawn` under `[pictures]`).",
    )
    reading: ReadingRule | None = Field(
        default=None,
        description="How values are read from what is seen: `argmax` takes the most probable value "
        "of each feature by itself, `consistent` the most probable values that go together by what "
        "is known, `with_class` those with the class, seen by itself, as one more witness. Where "
        'left out, `with_class`; `argmax` with `eyes = "none"`.',
    )
    known_share: float | None = Field(
        default=None,
        gt=0.0,
        le=1.0,
        description="The share of pictures like those of training that is answered; of all less "
        "like them it is said that they are not known, and at 1 every picture is answered. Where "
        'left out, 0.995; 1 with `eyes = "none"`.',
    )


class PictureTable(StrictTable):
    """``[pictures]``: how pictures are shown to the networks, and how they may be varied.

    See :func:`seewhy.perception.picture.read_picture` for ``fit`` and
    :class:`seewhy.perception.options.TrainingOptions` for the variations. Those that are left out
    are chosen from the pictures (:mod:`seewhy.perception.variations`), or have the defaults of
    TrainingOptions with ``eyes = "none"``. Where there are photographs to train on, ``drawn``
    pictures of the source are trained on before.
    """

    size: int = Field(
        default=56,
        ge=16,
        le=512,
        description="The side, in pixels, of the square that every picture becomes for networks "
        "that grow; a backbone has a side of its own.",
    )
    source_size: int = Field(
        default=112,
        ge=16,
        le=1024,
        description="The longer side, in pixels, of the pictures that `seewhy data make` makes "
        "with the domain's source.",
    )
    fit: OneOf["pad", "stretch"] = Field(
        default="pad",
        description="How a picture that is not square becomes one: `pad` adds a border and keeps "
        "shapes as they are, `stretch` is for pictures that are cut out close around one thing.",
    )
    standard: OneOf["set", "picture"] = Field(
        default="set",
        description="Whose mean and deviation the pixels are standardised by: those of all "
        "training pictures (`set`), or each picture's own (`picture`), which evens out light.",
    )
    flip: bool | None = Field(
        default=None,
        description="Whether half of the training pictures are mirrored left to right; say so only "
        "where a mirrored picture has the same features and the same class.",
    )
    shift: float | None = Field(
        default=None,
        ge=0.0,
        le=0.5,
        description="How far training pictures are moved at most in each direction, as a share of "
        "the side.",
    )
    rotate: float | None = Field(
        default=None,
        ge=0.0,
        le=180.0,
        description="How far training pictures are turned at most, in degrees to either side.",
    )
    scale: float | None = Field(
        default=None,
        ge=0.0,
        le=0.9,
        description="By which share the width and the height of training pictures grow or shrink "
        "at most, each on its own.",
    )
    shear: float | None = Field(
        default=None,
        ge=0.0,
        le=0.9,
        description="How far the top of training pictures is moved against the bottom at most, as "
        "a share of the side.",
    )
    brightness: float | None = Field(
        default=None,
        ge=0.0,
        le=0.9,
        description="By which share the brightness of training pictures changes at most.",
    )
    contrast: float | None = Field(
        default=None,
        ge=0.0,
        le=0.9,
        description="By which share the contrast of training pictures changes at most.",
    )
    colour: float | None = Field(
        default=None,
        ge=0.0,
        le=0.9,
        description="By which share red, green and blue of training pictures change at most, each "
        "on its own.",
    )
    noise: float | None = Field(
        default=None,
        ge=0.0,
        le=128.0,
        description="The standard deviation of the noise added to training pictures, in levels of "
        "0 to 255.",
    )
    drawn: int = Field(
        default=0,
        ge=0,
        le=1_000_000,
        description="How many pictures of the source the networks are trained on before "
        "photographs.",
    )


Channels = Annotated[tuple[Annotated[int, Field(ge=1, le=4096)], ...], Field(min_length=1)]


class NetworkTable(StrictTable):
    """``[networks]``: how large the networks become and how they are trained.

    See :class:`seewhy.perception.options.TrainingOptions`, and for ``together``
    :func:`seewhy.perception.fitting_extractor.fit_extractor`.
    """

    depth: int = Field(
        default=1,
        ge=1,
        le=16,
        description="The convolutions that a network starts with; it grows from there while it is "
        "less accurate than its feature's threshold.",
    )
    channels: Channels = Field(
        default=(8, 16, 32, 64),
        description="The channels of the first, second, … convolution.",
    )
    dense: int = Field(
        default=64,
        ge=1,
        le=65_536,
        description="The width of the layer after the convolutions.",
    )
    epochs: int = Field(
        default=18,
        ge=1,
        le=10_000,
        description="Passes over the training pictures; below 1,000 pictures there are up to four "
        "times as many, above 5,000 down to half.",
    )
    patience: int = Field(
        default=6,
        ge=1,
        le=10_000,
        description="Passes without improvement on the pictures kept for validation after which "
        "training ends.",
    )
    batch: int = Field(
        default=64,
        ge=1,
        le=65_536,
        description="Pictures in each step of training.",
    )
    together: bool = Field(
        default=False,
        description="Whether the networks of all features are trained together, so that each "
        "learns from what the others see.",
    )


class ValueTable(StrictTable):
    """``[features.NAME.values.VALUE]``: how a value is said, asked for and brought about."""

    say: Clause = Field(
        description="The clause that says it, as in `{it} has a narrow base`; {it} stands for the "
        "subject.",
    )
    words: tuple[Word, ...] = Field(
        default=(),
        description="Words by which questions may name the value, besides its own name.",
    )
    change: Clause | None = Field(
        default=None,
        description="The instruction that brings it about, as in `give it a narrow base`; without "
        "one, answers say `let the NAME be VALUE`.",
    )


class FeatureTable(StrictTable):
    """``[features.NAME]``: one feature, recognised by a network of its own.

    ``channels`` and ``dense`` are those of ``[networks]`` where left out.
    """

    name: Label = Field(description="What the feature is called in answers and tables.")
    threshold: float = Field(
        default=0.9,
        gt=0.0,
        le=1.0,
        description="The share of validation pictures read rightly at which its network stops "
        "growing.",
    )
    channels: Channels | None = Field(
        default=None,
        description="The channels of its network's convolutions; those of [networks] where left "
        "out.",
    )
    dense: int | None = Field(
        default=None,
        ge=1,
        le=65_536,
        description="The width of its network's last layer; that of [networks] where left out.",
    )
    change_cost: int = Field(
        default=1,
        ge=1,
        le=1000,
        description="How hard it is to change the feature; of several changes an answer names the "
        "one with the smallest sum.",
    )
    values: dict[Key, ValueTable] = Field(
        min_length=1,
        max_length=2000,
        description="A table for each value, and for each value of its sort in knowledge.al; a "
        "feature without a sort has the values yes and no.",
    )


class ClassTable(StrictTable):
    """``[classes.NAME]``: one class, the literal that stands for it, and its words."""

    literal: str = Field(
        description="The literal of knowledge.al that stands for the class, as in `-stable(S)`.",
    )
    say: Word = Field(description="How answers say it after `is`, as in `unstable`.")
    words: tuple[Word, ...] = Field(
        default=(),
        description="Words by which questions may name the class; where left out, what answers "
        "say.",
    )
    verbs: tuple[Word, ...] = Field(
        default=(),
        description="Verbs by which questions may say that the picture is of the class, as in "
        "`fall` for `will it fall?`.",
    )


class BeliefTable(StrictTable):
    """``[beliefs.NAME]``: how a static that is no feature, and its values, are said."""

    name: Word | None = Field(
        default=None,
        description="What it is called in answers; where left out, its name in knowledge.al.",
    )
    say: BeliefClause | None = Field(
        default=None,
        description="The clause that says a value, with {value} and perhaps {it}; where left out, "
        "`the NAME of {it} is {value}`, or what the static's name makes of it, as `{it} needs "
        "{value}` of `needs(apple, tool)`.",
    )
    values: dict[str, Word] = Field(
        default={},
        description="How each value is said; where left out, as in knowledge.al. A static "
        "of the picture alone has the values yes and no, as `can be eaten` and `cannot be eaten`.",
    )
    acts: tuple[Word, ...] = Field(
        default=(),
        description="What somebody may ask whether to do, as in `turn left` for `can I turn "
        "left?`; such a question is answered with the value.",
    )


class DomainFile(StrictTable):
    """The whole of ``domain.toml``."""

    domain: DomainTable = Field(
        description="What the domain is called, which sort stands for the picture, how pictures "
        "are read.",
    )
    pictures: PictureTable = Field(
        default=PictureTable(),
        description="How pictures are shown to the networks, and how they are varied in training.",
    )
    networks: NetworkTable = Field(
        default=NetworkTable(),
        description="How large the networks become that grow on the domain's pictures alone "
        '(`eyes = "none"`), and how they are trained.',
    )
    features: dict[Key, FeatureTable] = Field(
        default={},
        min_length=1,
        max_length=500,
        description="One table a feature, which knowledge.al declares as a static of the picture; "
        "only a domain with [things] may be without.",
    )
    classes: dict[Key, ClassTable] = Field(
        default={},
        min_length=2,
        max_length=2000,
        description="One table a class, of which every picture shows one; only a domain with "
        "[things] may be without.",
    )
    things: ThingsTable | None = Field(
        default=None,
        description="The things of which a picture may show several: how they are called, what "
        "is seen of each, what may hold between two.",
    )
    beliefs: dict[str, BeliefTable] = Field(
        default={},
        description="How statics of the picture that are no features are said, where their names "
        "do not do.",
    )
