"""Train and save a model with progress on the screen; a killed training goes on where it was."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy.cli.screen import progress, remark
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset
    from seewhy.domain.domain import Domain
    from seewhy.perception.events import EyesEvent, TrainingEvent


def trained_already(folder: Path, dataset: Dataset, *, seed: int) -> Agent | None:
    """Return the agent in ``folder`` if it came of this domain, these pictures and this seed.

    One that was trained with other options than the domain's is not what is looked for.
    """
    from seewhy.agent.agent import Agent
    from seewhy.domain.folder import FILES
    from seewhy.errors import ModelError

    try:
        agent = Agent.load(folder)
    except ModelError:
        return None
    same_domain = all(
        (agent.domain.folder / name).read_bytes() == (dataset.domain.folder / name).read_bytes()
        for name in FILES
    )
    same_pictures = agent.trained_on == frozenset(
        dataset.of_split("train").annotated().picture_digests()
    )
    plain = Agent(dataset.domain, seed=seed)
    same_options = all(
        getattr(agent, name) == getattr(plain, name)
        for name in ("seed", "eyes", "reading", "gate", "known_share", "without")
    )
    return agent if same_domain and same_pictures and same_options else None


def train_model(
    domain: Domain,
    data: Path,
    out: Path,
    *,
    without: Sequence[str] = (),
    start_from: Path | None = None,
    drawn: int | None = None,
    outside: bool = False,
    seed: int = 0,
    eyes: str | None = None,
    device: str = "auto",
    reading: str | None = None,
    gate: float | None = None,
    known_share: float | None = None,
) -> Agent:
    """Train an agent on the dataset in ``data`` and write it to ``out``.

    The options are those of :class:`~seewhy.agent.agent.Agent` and of its ``fit``. Checkpoints lie
    beside ``out`` until the model is written.

    Raises
    ------
    BusyError
        If another process trains a model for ``out``.
    """
    from seewhy.agent.agent import Agent
    from seewhy.agent.model import check_target, replaced_notice
    from seewhy.agent.pretraining import is_drawn
    from seewhy.cli.code_notice import remark_code
    from seewhy.files.locks import sole_writer
    from seewhy.perception.backbones import NONE

    check_target(out)
    earlier = Agent.load(start_from) if start_from else None
    checkpoints = out.with_name(f"{out.name}.training")
    agent = Agent(
        domain,
        seed=seed,
        eyes=eyes or domain.eyes_after(domain.pictures.drawn if drawn is None else drawn),
        device=device,
        reading=reading,
        gate=gate,
        known_share=known_share,
    )
    dataset = _data_to_train_on(data, domain, without=without, outside=outside)
    replaced = replaced_notice(out)
    if replaced is not None:
        remark(replaced)
    if drawn is None:
        drawn = 0 if is_drawn(dataset) else domain.pictures.drawn
    if drawn and earlier is None:
        remark_code(domain)
    with sole_writer(checkpoints), progress() as bars:
        drawing = bars.add_task("drawing pictures", total=None, visible=False)
        shown = eyes_progress(bars) if agent.eyes != NONE else networks_progress(bars, agent)
        agent.fit(
            dataset,
            without=without,
            start_from=earlier,
            drawn=drawn,
            on_picture=lambda done: bars.update(drawing, completed=done, visible=True),
            checkpoints=checkpoints,
            on_progress=shown,
        )
        agent.save(out)
        shutil.rmtree(checkpoints, ignore_errors=True)
    return agent


def _data_to_train_on(
    data: Path, domain: Domain, *, without: Sequence[str], outside: bool
) -> Dataset:
    """The dataset, if it can teach; what it shows too little of is remarked."""
    from seewhy.cli.read_data import read_data
    from seewhy.data.coverage import coverage_notices
    from seewhy.data.training_needs import require_feature_labels, require_two_classes

    dataset = read_data(data, domain, outside=outside)
    train = dataset.of_split("train").without_classes(without)
    require_two_classes(train)
    require_feature_labels(train)
    for notice in coverage_notices(train, without=without):
        remark(notice)
    return dataset


def networks_progress(bars: Progress, agent: Agent) -> Callable[[TrainingEvent], None]:
    """Show a bar for every network that grows."""
    from seewhy.domain.tables import CLASS, TOGETHER

    domain = agent.domain
    at_first = {TOGETHER} if domain.networks.together else set(domain.features)
    if agent.reading == "with_class":
        at_first.add(CLASS)
    tasks = {
        key: bars.add_task(key, total=None, visible=key in at_first)
        for key in (*domain.features, CLASS, TOGETHER)
    }

    def on_progress(event: TrainingEvent) -> None:
        bars.update(
            tasks[event.feature],
            description=f"{event.feature}, {event.depth} convolutions, "
            f"validation {percent(event.validation_accuracy)}",
            completed=event.epoch,
            total=event.epochs,
            visible=True,
        )
        if event.kind in ("grown", "done"):
            remark(event.message)

    return on_progress


def eyes_progress(bars: Progress) -> Callable[[EyesEvent], None]:
    """Show a bar for every stage in which eyes are taught."""
    tasks: dict[str, TaskID] = {}

    def on_progress(event: EyesEvent) -> None:
        if event.stage not in tasks:
            tasks[event.stage] = bars.add_task(event.stage, total=event.total)
        bars.update(tasks[event.stage], completed=event.done, total=event.total)
        if event.message is not None:
            remark(event.message)

    return on_progress
