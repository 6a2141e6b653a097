"""Train and save a model with progress on the screen; a killed training goes on where it was."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.cli.screen import percent, progress, remark

if TYPE_CHECKING:
    from seewhy.agent import Agent
    from seewhy.dataset import Dataset
    from seewhy.domain import Domain
    from seewhy.perception.events import TrainingEvent


def trained_already(folder: Path, dataset: Dataset, *, seed: int) -> Agent | None:
    """Return the agent in ``folder`` if it came of this domain, these pictures and this seed."""
    from seewhy.agent import Agent
    from seewhy.domain import FILES
    from seewhy.errors import ModelError

    try:
        agent = Agent.load(folder)
    except ModelError:
        return None
    same_domain = all(
        (agent.domain.folder / name).read_bytes() == (dataset.domain.folder / name).read_bytes()
        for name in FILES
    )
    same_pictures = agent.trained_on == frozenset(dataset.of_split("train").picture_digests())
    return agent if same_domain and same_pictures and agent.seed == seed else None


def train_model(
    domain: Domain, data: Path, out: Path, *, start_from: Path | None = None, seed: int = 0
) -> Agent:
    """Train an agent on the dataset in ``data`` and write it to ``out``.

    Checkpoints lie beside ``out`` until the model is written.
    """
    from seewhy.agent import Agent
    from seewhy.dataset import Dataset
    from seewhy.model import check_target

    check_target(out)
    dataset = Dataset.load(data, domain)
    earlier = Agent.load(start_from) if start_from else None
    checkpoints = out.with_name(f"{out.name}.training")
    agent = Agent(domain, seed=seed)
    with progress() as bars:
        tasks = {key: bars.add_task(key, total=None) for key in domain.features}

        def on_progress(event: TrainingEvent) -> None:
            bars.update(
                tasks[event.feature],
                description=f"{event.feature}, {event.depth} convolutions, "
                f"validation {percent(event.validation_accuracy)}",
                completed=event.epoch,
                total=event.epochs,
            )
            if event.kind in ("grown", "done"):
                remark(event.message)

        agent.fit(dataset, start_from=earlier, checkpoints=checkpoints, on_progress=on_progress)
    agent.save(out)
    shutil.rmtree(checkpoints, ignore_errors=True)
    return agent
