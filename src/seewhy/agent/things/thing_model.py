"""A model of things on disk: one folder, without pickle, written whole or not at all."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from seewhy.agent.manifest_file import (
    MANIFEST,
    THINGS_FORMAT,
    check_files,
    read_manifest,
    write_manifest,
)
from seewhy.agent.model import check_target
from seewhy.agent.things.thing_seeing import ThingSeeing
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import FILES, REVISIONS
from seewhy.domain.tables import CLASS
from seewhy.errors import ModelError, SeeWhyError
from seewhy.files.folders import settle_folder, whole_folder
from seewhy.files.json_file import Strict
from seewhy.perception.domain_options import seen_values
from seewhy.perception.eyes import Eyes
from seewhy.perception.things.detector import CentreDetector, Detector, Trust
from seewhy.perception.things.given_detector import NoDetector, OnnxDetector
from seewhy.perception.things.thing_eyes import ThingEyes

__all__ = ["ThingModel", "read_thing_model", "write_domain_files", "write_thing_model"]

_THINGS, _WHOLE = "things", "whole"
_ONNX = "detector.onnx"

Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{1,128}$")]


@dataclass(frozen=True, eq=False)
class ThingModel:
    """Everything that training leaves behind.

    Attributes
    ----------
    seeing : ThingSeeing
        What sees, and the domain as its folder says it.
    seed : int
    trained_on : frozenset of str
        Digests of the pictures.
    """

    seeing: ThingSeeing
    seed: int
    trained_on: frozenset[str]


class ThingManifest(Strict):
    """model.json of a model of things."""

    format: str
    seewhy: str
    domain: str
    seed: Annotated[int, Field(ge=0, lt=2**63)]
    detector: Literal["centre map", "onnx", "given"]
    trust: Trust
    whole: tuple[str, ...]
    trained_on: frozenset[Digest]
    files: dict[str, Digest]
    digest: Digest


def write_thing_model(model: ThingModel, folder: Path) -> None:
    """Write a model to a folder; an older model there is replaced in one step.

    Raises
    ------
    ModelError
        If the folder exists and is not a model.
    """
    check_target(folder)
    seeing = model.seeing
    with whole_folder(folder, replacing=True) as temporary:
        (temporary / "domain").mkdir()
        for name in FILES:
            shutil.copyfile(seeing.domain.folder / name, temporary / "domain" / name)
        for part in (_THINGS, _WHOLE)[: 2 if seeing.whole else 1]:
            (temporary / part).mkdir()
        seeing.eyes.save(temporary / _THINGS)
        kind = "given"
        if isinstance(seeing.detector, CentreDetector):
            kind = "centre map"
            seeing.detector.save(temporary / _THINGS)
        elif isinstance(seeing.detector, OnnxDetector):
            kind = "onnx"
            shutil.copyfile(seeing.detector.file, temporary / _THINGS / _ONNX)
        if seeing.whole is not None:
            seeing.whole.save(temporary / _WHOLE)
        fields: dict[str, Any] = {
            "format": THINGS_FORMAT,
            "seewhy": version("seewhy"),
            "domain": seeing.domain.name,
            "seed": model.seed,
            "detector": kind,
            "trust": seeing.trust.model_dump(mode="json"),
            "whole": [] if seeing.whole is None else list(seeing.whole.values),
            "trained_on": sorted(model.trained_on),
        }
        write_manifest(temporary, fields)


def read_thing_model(
    folder: Path, *, device: str = "auto", detector: Detector | None = None
) -> ThingModel:
    """Read what :func:`write_thing_model` wrote.

    Parameters
    ----------
    folder : Path
    device : str
        Where eyes compute.
    detector : Detector, optional
        Of one's own; needed to find things where the model was trained with a function.

    Raises
    ------
    ModelError
        If the folder is missing, incomplete, edited, or of another format.
    """
    settle_folder(folder)
    manifest = read_manifest(folder, ThingManifest, number=THINGS_FORMAT)
    must = _files(manifest)
    check_files(folder, manifest.files, must=must, may=(*must, f"domain/{REVISIONS}"))
    domain = _domain(folder, manifest)
    assert domain.things is not None
    eyes = ThingEyes.load(folder / _THINGS, device=device)
    values = {key: feature.values for key, feature in domain.things.features.items()}
    whole = Eyes.load(folder / _WHOLE, device=device) if manifest.whole else None
    seen = seen_values(domain, with_class=True)
    if eyes.eyes.values != values or (
        whole is not None
        and any(
            seen.get(key) != row or key not in manifest.whole for key, row in whole.values.items()
        )
    ):
        raise ModelError(
            f"{folder}: what sees tells apart other features than the model's domain names; "
            "train it again"
        )
    if not eyes.related.keys() <= domain.things.relations.keys():
        raise ModelError(
            f"{folder}: what sees knows other relations than the model's domain; train it again"
        )
    if detector is None:
        detector = _detector(folder / _THINGS, manifest.detector)
    seeing = ThingSeeing(domain, eyes, detector, manifest.trust, whole)
    return ThingModel(seeing, manifest.seed, manifest.trained_on)


def write_domain_files(folder: Path, files: Mapping[str, str]) -> None:
    """Put other texts into the files of a model's domain; the model is written whole.

    Raises
    ------
    ModelError
        If the folder is no model of things.
    """
    manifest = read_manifest(folder, ThingManifest, number=THINGS_FORMAT)
    with whole_folder(folder, replacing=True) as temporary:
        shutil.copytree(folder, temporary, dirs_exist_ok=True)
        (temporary / MANIFEST).unlink()
        for name, text in files.items():
            (temporary / "domain" / name).write_bytes(text.encode())
        fields = manifest.model_dump(mode="json", exclude={"files", "digest"})
        write_manifest(temporary, {**fields, "trained_on": sorted(manifest.trained_on)})


def _detector(folder: Path, kind: str) -> Detector:
    if kind == "onnx":
        return OnnxDetector(folder / _ONNX)
    return CentreDetector.load(folder) if kind == "centre map" else NoDetector()


def _files(manifest: ThingManifest) -> tuple[str, ...]:
    """The files that such a model has."""
    kind = manifest.detector
    parts = [
        *(f"domain/{name}" for name in FILES),
        *(f"{_THINGS}/{name}.{ending}" for name in ("eyes", "things") for ending in _ENDINGS),
        *(f"{_THINGS}/detector.{ending}" for ending in _ENDINGS if kind == "centre map"),
        *([f"{_THINGS}/{_ONNX}"] if kind == "onnx" else []),
        *(f"{_WHOLE}/eyes.{ending}" for ending in _ENDINGS if manifest.whole),
    ]
    return tuple(parts)


_ENDINGS = ("json", "safetensors")


def _domain(folder: Path, manifest: ThingManifest) -> Domain:
    try:
        domain = load_domain(folder / "domain")
    except SeeWhyError as problem:
        raise ModelError(f"{folder}: the model's domain cannot be read: {problem}") from None
    if domain.name != manifest.domain or domain.things is None:
        raise ModelError(
            f"{folder}: the model's domain folder is of another domain; train it again"
        )
    if not {*manifest.whole} <= {*domain.features, CLASS}:
        raise ModelError(
            f"{folder}: what sees knows other features than the model's domain; train it again"
        )
    return domain
