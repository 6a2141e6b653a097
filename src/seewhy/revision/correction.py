"""A scene as somebody says it is, and where such a label would be kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from seewhy.agent.agent import Agent
from seewhy.data.dataset import TABLE, Dataset
from seewhy.dialogue.reply import Classification, FeatureReading
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.domain.wording import join_words
from seewhy.errors import DatasetError, RevisionError
from seewhy.revision.proposal import Proposal
from seewhy.revision.table_text import label_edits, read_text, rows_of

__all__ = ["Keeping", "cells_of", "corrected", "keeping"]


@dataclass(frozen=True)
class Keeping:
    """Whether a label would be written into a table, and a sentence that says so."""

    written: bool
    sentence: str


def keeping(
    proposal: Proposal, domain: Domain, dataset: Path | None, picture: Path | None
) -> Keeping:
    """Return where the label that a proposal is would be kept.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.reasoner import Decision, Verdict
    >>> from seewhy.revision.proposal import Cause
    >>> leans = Proposal(Cause.MISREAD, "it leans", (), Decision(None, Verdict.SILENT),
    ...                  reading=("lean", "yes"))
    >>> keeping(leans, load_domain("structure_stability"), None, None).sentence
    'It would hold for this conversation only; with --data DATASET it would be one more label.'
    """
    here = "It would hold for this conversation"
    if dataset is None or picture is None or proposal.reading is None:
        return Keeping(False, f"{here} only; with --data DATASET it would be one more label.")
    data, table = Dataset.load(dataset, domain), dataset / TABLE
    try:
        edits = label_edits(data, picture, cells_of(proposal), text=read_text(table))
    except (DatasetError, RevisionError) as problem:
        return Keeping(False, f"{here} only: {problem}.")
    if not edits:
        return Keeping(False, f"{here}; {table} says so already.")
    changed = [
        f"its {column} would be '{value}' instead of '{before}'"
        for column, value in cells_of(proposal).items()
        for before in sorted(_said(data, picture, column) - {value})
    ]
    if changed:
        return Keeping(True, f"In {table}, {join_words(changed)}.")
    return Keeping(True, f"It would be one more label in {table}.")


def _said(data: Dataset, picture: Path, column: str) -> set[str]:
    """What a table says of a picture in a column."""
    scenes = rows_of(data, picture)
    if column == CLASS:
        return {scene.label for scene in scenes if scene.label}
    place = list(data.domain.features).index(column)
    return {value for scene in scenes if (value := scene.vector[place]) is not None}


def cells_of(proposal: Proposal) -> dict[str, str]:
    """Return what a label says of a picture, by the columns of a table.

    Examples
    --------
    >>> from seewhy.knowledge.reasoner import Decision, Verdict
    >>> from seewhy.revision.proposal import Cause
    >>> cells_of(Proposal(Cause.MISREAD, "it leans", (), Decision(None, Verdict.SILENT),
    ...                   reading=("lean", "yes"), label="unstable"))
    {'lean': 'yes', 'class': 'unstable'}
    """
    cells = {} if proposal.reading is None else dict([proposal.reading])
    return cells if proposal.label is None else {**cells, CLASS: proposal.label}


def corrected(
    agent: Agent, scene: Classification, corrections: Mapping[str, str]
) -> Classification:
    """Return a scene with some features as somebody says they are, decided again.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> agent = Agent(load_domain("structure_stability"))
    >>> scene = agent.classify_values({"num_blocks": "2", "lean": "no"})
    >>> corrected(agent, scene, {"block_displaced": "yes"}).vector
    ('2', None, 'no', 'yes')
    """
    seen = agent.domain.named(scene.vector)
    changed = {key: value for key, value in corrections.items() if seen[key] != value}
    if not changed:
        return scene
    vector = agent.domain.vector({**seen, **changed})
    label, method, verdict = agent.deciding.decide(vector)
    features = dict(scene.features)
    for key, value in changed.items():
        read = scene.features.get(key)
        overruled = None if read is None else (read.value, read.probability)
        features[key] = FeatureReading(value, 1.0, None if scene.told else overruled)
    return replace(
        scene,
        label=label,
        method=method,
        vector=vector,
        features=features,
        verdict=verdict.value,
        probability=None if label is None else 1.0,
        otherwise=(),
    )
