"""What may stand in model.json and experience.json."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, RootModel

from seewhy.domain.folder import FILES, REVISIONS
from seewhy.domain.reading_rule import ReadingRule
from seewhy.files.json_file import Strict
from seewhy.knowledge.learned_file import LEARNED
from seewhy.knowledge.reasoner import Minimality
from seewhy.perception.backbones import NONE

__all__ = ["ExperienceRow", "ExperienceRows", "Manifest", "ReadingWeight", "may_have", "must_have"]

Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{1,128}$")]
Share = Annotated[float, Field(gt=0.0, le=1.0)]
Power = Annotated[float, Field(ge=0.0, le=1000.0)]


class ReadingWeight(Strict):
    """The fields of :class:`seewhy.agent.reading_weights.ReadingWeights`."""

    features: Power
    witness: Power


class Manifest(Strict):
    """model.json: what a model is, and the digest of each of its files."""

    format: int
    seewhy: str
    domain: str
    minimality: Minimality
    seed: Annotated[int, Field(ge=0, lt=2**63)]
    eyes: str
    reading: ReadingRule
    reading_weights: dict[ReadingRule, ReadingWeight]
    gate: Share | None
    known_share: Share
    validation_scores: dict[ReadingRule, list[float]]
    without: tuple[str, ...]
    answers: bool
    trained_on: frozenset[Digest]
    without_class: frozenset[Digest] = frozenset()
    files: dict[str, Digest]
    digest: Digest


class ExperienceRow(Strict):
    """A feature vector, and how often it was annotated with each class."""

    features: tuple[str | None, ...]
    classes: Annotated[dict[str, Annotated[int, Field(ge=1, le=10**9)]], Field(min_length=1)]


class ExperienceRows(RootModel[tuple[ExperienceRow, ...]]):
    """experience.json."""


def must_have(manifest: Manifest) -> tuple[str, ...]:
    """Return the files without which such a model is incomplete."""
    sees = "perception" if manifest.eyes == NONE else "eyes"
    seen = (f"perception/{sees}.json", f"perception/{sees}.safetensors")
    said = ("dialogue/answers.json", "dialogue/answers.safetensors") if manifest.answers else ()
    domain = (f"domain/{name}" for name in FILES)
    return (*said, *domain, "experience.json", "induction/tree.json", *seen)


def may_have(manifest: Manifest) -> tuple[str, ...]:
    """Return all files that such a model may have."""
    familiar = ("perception/familiarity.json", "perception/familiarity.safetensors")
    return (*must_have(manifest), LEARNED, f"domain/{REVISIONS}", *familiar)
