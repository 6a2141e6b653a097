"""A trained model on disk: one folder, without pickle, written whole or not at all."""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.dialogue.reference import Experience
from seewhy.domain import FILES, Domain, load_domain
from seewhy.domain_tables import CLASS, ReadingRule
from seewhy.errors import ModelError, SeeWhyError
from seewhy.files import write_whole
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import LEARNED, Withdrawn, read_learned, write_learned
from seewhy.knowledge.reasoner import Minimality
from seewhy.perception.backbones import NONE
from seewhy.reading import ReadingWeights

if TYPE_CHECKING:
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
    from seewhy.perception.extractor import FeatureExtractor
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.familiarity import Familiarity

MANIFEST = "model.json"
FORMAT = 5

_KEYS = (
    *("domain", "minimality", "seed", "eyes", "reading", "reading_weights", "gate"),
    *("known_share", "validation_scores", "without", "answers", "trained_on", "files"),
)


@dataclass(frozen=True)
class Model:
    """Everything that training leaves behind.

    ``domain`` is as given; ``learned`` are the axioms that were found in pictures, ``withdrawn``
    those that were and are known no more. ``answerer`` is None where the knowledge decided all
    training scenes rightly; ``trained_on`` holds digests of the pictures, ``without`` the classes
    of which there were none on purpose, ``validation_scores`` how like those of training the
    pictures kept for validation are, under each way of reading; it and ``familiarity`` are empty
    where no picture is to be refused. ``without_class`` are those of ``trained_on`` that had no
    class, so that ``experience`` does not count them.
    """

    domain: Domain
    learned: tuple[Axiom, ...]
    withdrawn: tuple[Withdrawn, ...]
    extractor: FeatureExtractor | Eyes
    tree: DecisionTree
    answerer: RecurrentAnswerer | None
    experience: Experience
    trained_on: frozenset[str]
    without_class: frozenset[str]
    minimality: Minimality
    seed: int
    eyes: str
    reading: ReadingRule
    reading_weights: Mapping[ReadingRule, ReadingWeights]
    gate: float | None
    known_share: float
    familiarity: Familiarity | None
    validation_scores: Mapping[ReadingRule, list[float]]
    without: tuple[str, ...]


def write_model(model: Model, folder: Path) -> None:
    """Write ``model`` to ``folder``; an older model there is replaced in one step.

    Raises
    ------
    ModelError
        If ``folder`` exists and is not a model.
    """
    check_target(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(prefix=f".{folder.name}-", dir=folder.parent))
    try:
        temporary.chmod(0o755)
        (temporary / "domain").mkdir()
        for name in FILES:
            shutil.copyfile(model.domain.folder / name, temporary / "domain" / name)
        if model.learned or model.withdrawn:
            write_learned(temporary, model.learned, model.withdrawn)
        model.extractor.save(temporary / "perception")
        if model.familiarity is not None:
            model.familiarity.save(temporary / "perception")
        model.tree.save(temporary / "induction")
        if model.answerer is not None:
            model.answerer.save(temporary / "dialogue")
        write_whole(temporary / "experience.json", _experience_text(model))
        write_whole(temporary / MANIFEST, json.dumps(_manifest(model, temporary), indent=1))
        old = _set_aside(folder)
        if folder.exists():
            shutil.rmtree(old, ignore_errors=True)
            folder.rename(old)
        try:
            temporary.rename(folder)
        except BaseException:
            if old.exists():
                old.rename(folder)
            raise
        shutil.rmtree(old, ignore_errors=True)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _set_aside(folder: Path) -> Path:
    """Where an earlier model stands for the moment in which a new one takes its place."""
    return folder.with_name(f".{folder.name}-old")


def check_target(folder: Path) -> None:
    """Raise a ModelError if a model cannot be written to ``folder``."""
    if folder.is_file() or (
        folder.is_dir() and any(folder.iterdir()) and not (folder / MANIFEST).is_file()
    ):
        raise ModelError(
            f"{folder}: exists and is not a model; choose another folder for the model"
        )


def replaced_notice(folder: Path) -> str | None:
    """What is replaced when a model is written to ``folder``, in a sentence; None if nothing is."""
    if not (folder / MANIFEST).is_file():
        return None
    try:
        lines = (folder / LEARNED).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    learned = any(line and not line.startswith("%") for line in lines)
    return (
        f"{folder} holds a model, which is replaced when this training ends"
        f"{', with the axioms that it has learned' if learned else ''}; "
        "to keep it, name another folder"
    )


def read_model(folder: Path, *, device: str = "auto") -> Model:
    """Read what :func:`write_model` wrote; eyes are to compute on ``device``.

    Raises
    ------
    ModelError
        If the folder is missing, incomplete, edited, or of another format.
    """
    manifest = _read_manifest(folder)
    _check_files(folder, manifest["files"])
    try:
        domain = load_domain(folder / "domain")
        learned, withdrawn = read_learned(folder / LEARNED, domain.knowledge.signature)
    except SeeWhyError as problem:
        raise ModelError(f"{folder}: the model's domain cannot be read: {problem}") from None
    if domain.name != manifest["domain"]:
        raise ModelError(
            f"{folder}: the model was trained for the domain '{manifest['domain']}', but its "
            f"domain folder is '{domain.name}'; train it again"
        )
    from seewhy.perception.domain_options import seen_values
    from seewhy.perception.familiarity import FAMILIARITY, Familiarity

    extractor = _read_extractor(folder / "perception", manifest["eyes"], device)
    with_class = CLASS in extractor.values
    if dict(extractor.values) != seen_values(domain, with_class=with_class):
        raise ModelError(
            f"{folder}: the networks recognise other features than the model's domain names; "
            "train it again"
        )
    familiarity = None
    if f"perception/{FAMILIARITY}" in manifest["files"]:
        familiarity = Familiarity.load(folder / "perception")
    answerer = None
    if manifest["answers"]:
        from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer

        answerer = RecurrentAnswerer.load(folder / "dialogue")
    experience = json.loads((folder / "experience.json").read_text(encoding="utf-8"))
    return Model(
        domain=domain,
        learned=learned,
        withdrawn=withdrawn,
        extractor=extractor,
        tree=DecisionTree.load(folder / "induction"),
        answerer=answerer,
        experience={tuple(row["features"]): row["classes"] for row in experience},
        trained_on=frozenset(manifest["trained_on"]),
        without_class=frozenset(manifest.get("without_class", ())),
        minimality=manifest["minimality"],
        seed=manifest["seed"],
        eyes=manifest["eyes"],
        reading_weights={
            rule: ReadingWeights(**weights) for rule, weights in manifest["reading_weights"].items()
        },
        reading=manifest["reading"],
        gate=manifest["gate"],
        known_share=manifest["known_share"],
        familiarity=familiarity,
        validation_scores=manifest["validation_scores"],
        without=tuple(manifest["without"]),
    )


def _read_extractor(folder: Path, eyes: str, device: str) -> FeatureExtractor | Eyes:
    if eyes == NONE:
        from seewhy.perception.extractor import FeatureExtractor

        return FeatureExtractor.load(folder)
    from seewhy.perception.eyes import Eyes

    return Eyes.load(folder, device=device)


def _experience_text(model: Model) -> str:
    rows = [
        {"features": list(vector), "classes": dict(counts)}
        for vector, counts in sorted(model.experience.items(), key=lambda row: str(row[0]))
    ]
    return json.dumps(rows, indent=1)


def _manifest(model: Model, folder: Path) -> dict[str, Any]:
    from importlib.metadata import version

    manifest = {
        "format": FORMAT,
        "seewhy": version("seewhy"),
        "domain": model.domain.name,
        "minimality": model.minimality,
        "seed": model.seed,
        "eyes": model.eyes,
        "reading_weights": {
            rule: asdict(weights) for rule, weights in model.reading_weights.items()
        },
        "reading": model.reading,
        "gate": model.gate,
        "known_share": model.known_share,
        "validation_scores": dict(model.validation_scores),
        "without": list(model.without),
        "answers": model.answerer is not None,
        "trained_on": sorted(model.trained_on),
        "without_class": sorted(model.without_class),
        "files": {
            path.relative_to(folder).as_posix(): _digest(path)
            for path in sorted(folder.rglob("*"))
            if path.is_file()
        },
    }
    return {**manifest, "digest": _digest_of(manifest)}


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _digest_of(manifest: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(manifest, sort_keys=True).encode()).hexdigest()


def _read_manifest(folder: Path) -> dict[str, Any]:
    earlier = _set_aside(folder)
    if not folder.is_dir() and earlier.is_dir():
        raise ModelError(
            f"{folder}: a newer model was being written when the program was killed; rename "
            f"{earlier} to {folder} to have the earlier one back, or train again"
        )
    if not folder.is_dir():
        raise ModelError(f"{folder}: there is no such model; 'seewhy train' makes one")
    path = folder / MANIFEST
    if not path.is_file():
        raise ModelError(
            f"{folder}: is not a model, it has no {MANIFEST}; give the folder that 'seewhy "
            "train --out' wrote"
        )
    try:
        manifest: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        found = manifest["format"]
        if found == FORMAT:
            for key in _KEYS:
                manifest[key]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ModelError(f"{path}: cannot be read; train the model again") from None
    if found != FORMAT:
        raise ModelError(
            f"{path}: the model has format {found}, this version reads {FORMAT}; train it again"
        )
    digest = manifest.pop("digest", None)
    if digest != _digest_of(manifest):
        raise _changed(path)
    return manifest


def _check_files(folder: Path, files: dict[str, str]) -> None:
    for name, digest in files.items():
        path = folder / name
        if not path.is_file():
            raise ModelError(
                f"{folder}: the model is incomplete, {name} is missing; train it again"
            )
        if _digest(path) != digest:
            raise _changed(path)


def _changed(path: Path) -> ModelError:
    return ModelError(
        f"{path}: has changed since the model was trained; undo the change or train the model "
        "again (knowledge is edited in the domain's own folder)"
    )
