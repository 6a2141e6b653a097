"""A trained model on disk: one folder, without pickle, written whole or not at all."""

from __future__ import annotations

import json
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seewhy.agent.manifest_file import (
    MANIFEST,
    REMEDY,
    check_files,
    read_manifest,
    write_manifest,
)
from seewhy.agent.model_schema import ExperienceRows, Manifest, may_have, must_have
from seewhy.agent.reading_weights import ReadingWeights
from seewhy.agent.seeing import Seeing
from seewhy.agent.settings import Settings
from seewhy.agent.training_pictures import TrainingPictures
from seewhy.agent.working_knowledge import WorkingKnowledge, working_knowledge
from seewhy.dialogue.reference import Experience
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import FILES, REVISIONS
from seewhy.domain.reading_rule import ReadingRule
from seewhy.domain.tables import CLASS
from seewhy.errors import ModelError, SeeWhyError
from seewhy.files.folders import settle_folder, whole_folder
from seewhy.files.json_file import read_json
from seewhy.induction.tree import TREE, DecisionTree
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import LEARNED, Withdrawn, read_learned, write_learned
from seewhy.perception.backbones import NONE
from seewhy.text.visible import visible

if TYPE_CHECKING:
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
    from seewhy.perception.extractor import FeatureExtractor
    from seewhy.perception.eyes import Eyes

EXPERIENCE = "experience.json"
FORMAT = 5


@dataclass(frozen=True)
class Model:
    """Everything that training leaves behind.

    Attributes
    ----------
    settings : Settings
        What the agent was told.
    known : WorkingKnowledge
        Its knowledge, and what it remembers.
    seeing : Seeing
        What sees.
    tree : DecisionTree
    answerer : RecurrentAnswerer or None
        None where the knowledge decided all training scenes rightly.
    training_pictures : TrainingPictures
        Those that it was trained on.
    """

    settings: Settings
    known: WorkingKnowledge
    seeing: Seeing
    tree: DecisionTree
    answerer: RecurrentAnswerer | None
    training_pictures: TrainingPictures


def write_model(model: Model, folder: Path) -> None:
    """Write ``model`` to ``folder``; an older model there is replaced in one step.

    Raises
    ------
    ModelError
        If ``folder`` exists and is not a model.
    """
    check_target(folder)
    with whole_folder(folder, replacing=True) as temporary:
        (temporary / "domain").mkdir()
        known, seeing = model.known, model.seeing
        for name in FILES:
            shutil.copyfile(known.given.folder / name, temporary / "domain" / name)
        if (known.given.folder / REVISIONS).is_file():
            shutil.copyfile(known.given.folder / REVISIONS, temporary / "domain" / REVISIONS)
        if known.learned or known.withdrawn:
            write_learned(temporary, known.learned, known.withdrawn)
        seeing.trained.save(temporary / "perception")
        if seeing.familiarity is not None:
            seeing.familiarity.save(temporary / "perception")
        model.tree.save(temporary / "induction")
        if model.answerer is not None:
            model.answerer.save(temporary / "dialogue")
        (temporary / EXPERIENCE).write_text(_experience_text(model), encoding="utf-8")
        write_manifest(temporary, _manifest(model))


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
    settle_folder(folder)
    while True:
        state = _state(folder)
        try:
            return _read_model(folder, device=device)
        except ModelError:
            # What was read in the moment in which another model took its place is of neither.
            if _state(folder) == state:
                raise


def require_readable(model: Model, reading: ReadingRule, folder: Path) -> None:
    """Raise a ModelError if a model's pictures cannot be read in some way."""
    if reading == "with_class" and CLASS not in model.seeing.trained.values:
        raise ModelError(
            f"{folder}: the model has no network of the class; train it with --reading "
            "with_class, or read its pictures in another way"
        )


def _state(folder: Path) -> tuple[int, int] | None:
    try:
        found = folder.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _read_model(folder: Path, *, device: str) -> Model:
    manifest = read_manifest(folder, Manifest, number=FORMAT)
    check_files(folder, manifest.files, must=must_have(manifest), may=may_have(manifest))
    domain, learned, withdrawn = _read_domain(folder, manifest)
    seeing = _read_seeing(folder, manifest, domain, device=device)
    answerer = _read_answerer(folder / "dialogue", domain) if manifest.answers else None
    tree = _read_tree(folder / "induction", domain)
    return Model(
        settings=Settings(
            eyes=manifest.eyes,
            device=device,
            reading=manifest.reading,
            gate=manifest.gate,
            known_share=manifest.known_share,
            seed=manifest.seed,
        ),
        known=working_knowledge(
            domain,
            learned=learned,
            withdrawn=withdrawn,
            minimality=manifest.minimality,
            experience=_read_experience(folder / EXPERIENCE, domain),
        ),
        seeing=seeing,
        tree=tree,
        answerer=answerer,
        training_pictures=TrainingPictures(
            manifest.trained_on, manifest.without_class, manifest.without
        ),
    )


def _read_domain(
    folder: Path, manifest: Manifest
) -> tuple[Domain, tuple[Axiom, ...], tuple[Withdrawn, ...]]:
    """The domain as it was given, and the axioms that were learned and withdrawn."""
    try:
        domain = load_domain(folder / "domain")
        signature = domain.knowledge.signature
        learned, withdrawn = (
            read_learned(folder / LEARNED, signature) if LEARNED in manifest.files else ((), ())
        )
    except SeeWhyError as problem:
        raise ModelError(f"{folder}: the model's domain cannot be read: {problem}") from None
    if domain.name != manifest.domain:
        raise ModelError(
            f"{folder}: the model was trained for the domain '{visible(manifest.domain)}', but its "
            f"domain folder is '{domain.name}'; {REMEDY}"
        )
    return domain, learned, withdrawn


def _read_seeing(folder: Path, manifest: Manifest, domain: Domain, *, device: str) -> Seeing:
    from seewhy.perception.domain_options import seen_values
    from seewhy.perception.familiarity import FAMILIARITY, Familiarity

    extractor = _read_extractor(folder / "perception", manifest.eyes, device)
    with_class = CLASS in extractor.values
    if dict(extractor.values) != seen_values(domain, with_class=with_class):
        raise ModelError(
            f"{folder}: the networks recognise other features than the model's domain names; "
            f"{REMEDY}"
        )
    familiarity = None
    if f"perception/{FAMILIARITY}" in manifest.files:
        familiarity = Familiarity.load(folder / "perception", widths=extractor.widths)
    weights = {
        rule: ReadingWeights(found.features, found.witness)
        for rule, found in manifest.reading_weights.items()
    }
    return Seeing(extractor, familiarity, manifest.validation_scores, weights)


def _read_answerer(folder: Path, domain: Domain) -> RecurrentAnswerer:
    from seewhy.dialogue.learned import check_answers
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer

    answerer = RecurrentAnswerer.load(folder)
    check_answers(domain, answerer, folder)
    return answerer


def _read_tree(folder: Path, domain: Domain) -> DecisionTree:
    tree = DecisionTree.load(folder)
    values = {key: feature.values for key, feature in domain.features.items()}
    if tree.features != values or not {*tree.classes} <= domain.classes.keys():
        raise ModelError(
            f"{folder / TREE}: the tree tells apart other features or classes than "
            f"the model's domain names; {REMEDY}"
        )
    return tree


def _read_experience(file: Path, domain: Domain) -> Experience:
    rows = read_json(file, ExperienceRows, remedy=REMEDY).root
    values = [{*feature.values, None} for feature in domain.features.values()]
    for number, row in enumerate(rows):
        fits = len(row.features) == len(values) and all(
            value in known for value, known in zip(row.features, values, strict=True)
        )
        if not fits or not row.classes.keys() <= domain.classes.keys():
            raise ModelError(
                f"{file} is damaged ({number}: the model's domain has no such features or classes)"
                f": {REMEDY}"
            )
    return {row.features: row.classes for row in rows}


def _read_extractor(folder: Path, eyes: str, device: str) -> FeatureExtractor | Eyes:
    if eyes == NONE:
        from seewhy.perception.extractor import FeatureExtractor

        return FeatureExtractor.load(folder)
    from seewhy.perception.eyes import Eyes

    return Eyes.load(folder, device=device)


def _experience_text(model: Model) -> str:
    rows = [
        {"features": list(vector), "classes": dict(counts)}
        for vector, counts in sorted(model.known.experience.items(), key=lambda row: str(row[0]))
    ]
    return json.dumps(rows, indent=1)


def _manifest(model: Model) -> dict[str, Any]:
    from importlib.metadata import version

    settings, known, seeing = model.settings, model.known, model.seeing
    return {
        "format": FORMAT,
        "seewhy": version("seewhy"),
        "domain": known.given.name,
        "minimality": known.minimality,
        "seed": settings.seed,
        "eyes": settings.eyes,
        "reading_weights": {
            rule: asdict(weights) for rule, weights in seeing.reading_weights.items()
        },
        "reading": settings.reading,
        "gate": settings.gate,
        "known_share": settings.known_share,
        "validation_scores": dict(seeing.validation_scores),
        "without": list(model.training_pictures.without),
        "answers": model.answerer is not None,
        "trained_on": sorted(model.training_pictures.trained_on),
        "without_class": sorted(model.training_pictures.without_class),
    }
