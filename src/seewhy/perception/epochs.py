"""What trainings have in common that go by epochs: batches, the best epoch, going on later.

One network (:mod:`~seewhy.perception.training`) and the networks of all features together
(:mod:`~seewhy.perception.joint_training`) say what a pass, a score and a checkpoint are to them;
what happens when is here. Loops without validation take :func:`batches` alone.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import torch

from seewhy.perception.checkpoint import Checkpoint, Position, Weights
from seewhy.perception.events import Kind, Progress, TrainingEvent
from seewhy.perception.validation import clearly_better

__all__ = ["REHEARSED", "Batch", "EpochTraining", "batches", "planned_epochs"]

ENOUGH_PICTURES = 1000  # what `max_epochs` is meant for; fewer pictures get more epochs
PLENTY = 5000  # more pictures get fewer epochs, at least half
COOLING_STARTS = 0.7  # of the planned epochs; from here on steps are small
REHEARSED = 1000  # pictures of an earlier training in a pass, at most


def planned_epochs(epochs: int, *, pictures: int, fine_tune: bool = False) -> int:
    """Passes over so many training pictures, where ``epochs`` are meant for 1,000 to 5,000.

    Up to four times as many where pictures are fewer, down to half where they are more; half of
    that where networks are trained already.

    Examples
    --------
    >>> [planned_epochs(16, pictures=count) for count in (100, 500, 1000, 9000)]
    [64, 32, 16, 9]
    """
    fewer = max(0.5, min(1.0, PLENTY / pictures))
    return math.ceil(epochs * more_for(pictures) * fewer * (0.5 if fine_tune else 1.0))


def more_for(pictures: int) -> float:
    """How many times as many epochs few pictures get, 1 to 4.

    Examples
    --------
    >>> more_for(500)
    2.0
    """
    return min(4.0, max(1.0, ENOUGH_PICTURES / pictures))


@dataclass(frozen=True, eq=False)
class Batch:
    """What one step learns from.

    Attributes
    ----------
    progress : float
        How much of all epochs lies behind, 0..1, for the learning rate.
    rows : tensor of int
        The places of the examples.
    again : tensor of int
        The places of examples to rehearse.
    """

    progress: float
    rows: torch.Tensor
    again: torch.Tensor


def batches(
    rows: torch.Tensor, *, size: int, epoch: int, epochs: int, rehearsed: int = 0
) -> list[Batch]:
    """One pass over examples in a random order, in batches of about the same size.

    Parameters
    ----------
    rows : tensor of int
        The places of the examples.
    size : int
        Of a batch, at most.
    epoch, epochs : int
        Passes before this one, and of all.
    rehearsed : int, default 0
        Examples of an earlier training; as many as there are rows are rehearsed in the pass, at
        most :data:`REHEARSED`.

    Examples
    --------
    >>> [len(batch.rows) for batch in batches(torch.arange(10), size=4, epoch=0, epochs=1)]
    [4, 3, 3]
    """
    order = rows[torch.randperm(len(rows))]
    steps = math.ceil(len(order) / size)
    again = torch.randperm(rehearsed)[: min(len(rows), REHEARSED)].to(rows.device)
    parts = zip(torch.tensor_split(order, steps), torch.tensor_split(again, steps), strict=True)
    return [
        Batch((epoch + n / steps) / epochs, batch, more) for n, (batch, more) in enumerate(parts)
    ]


class EpochTraining(ABC):
    """Networks in training by epochs, and where that stands.

    Attributes
    ----------
    position : Position
        What a checkpoint needs beside tensors.
    planned : mapping of str to int
        Stage → its epochs.
    patience : float
        Epochs of the last stage without a better score after which it ends early.
    judged : tensor of int
        The places of the pictures by which networks are judged.
    """

    position: Position
    planned: Mapping[str, int]
    patience: float
    judged: torch.Tensor

    @abstractmethod
    def begin(self) -> None:
        """Make ready for the first epoch."""

    @abstractmethod
    def resume(self, position: Position, tensors: dict[str, Weights]) -> None:
        """Go on from a checkpoint."""

    @abstractmethod
    def tensors(self) -> dict[str, Weights]:
        """What :meth:`resume` needs beside the position."""

    @abstractmethod
    def pass_over(self) -> None:
        """Pass once over the training pictures, each varied anew."""

    @abstractmethod
    def score(self) -> list[float]:
        """Accuracy and mean loss on the pictures by which networks are judged."""

    @abstractmethod
    def remember(self) -> None:
        """Copy the weights as they are: no epoch was better."""

    @abstractmethod
    def go_back(self) -> None:
        """Take the weights that were remembered."""

    @abstractmethod
    def calibrate(self) -> None:
        """Fit the temperature of the weights as they are."""

    @abstractmethod
    def event(self, kind: Kind, accuracy: float) -> TrainingEvent:
        """What just happened, in numbers and words."""

    def grow_or_settle(self) -> TrainingEvent:
        """What ends the stage "growing"; only trainings that have one need it."""
        raise NotImplementedError

    def run(self, checkpoint: Checkpoint | None, on_progress: Progress | None) -> None:
        """Train to the end, or from a checkpoint to the end, with the same weights.

        The checkpoint is written after every epoch, before ``on_progress`` is called.
        """
        found = None if checkpoint is None else checkpoint.read(Position)
        if found is None:
            self.begin()
        else:
            self.resume(*found)
        tell: Callable[[TrainingEvent], None] = on_progress or (lambda _: None)
        if self.position.stage == "finished":
            tell(self.event("done", self.position.best[0]))
        while self.position.stage != "finished":
            event = self._advance()
            if checkpoint is not None:
                checkpoint.write(self.position, self.tensors())
            tell(event)

    def _advance(self) -> TrainingEvent:
        if self._epochs_are_left():
            return self._epoch()
        if self.position.stage == "growing":
            return self.grow_or_settle()
        return self._finish()

    def _epochs_are_left(self) -> bool:
        """Whether this stage has epochs to go; out of patience, it skips to its last ones."""
        position, planned = self.position, self.planned[self.position.stage]
        if position.since_best >= self.patience:
            # Stopping here would leave the weights as the large steps tossed them: cool down first.
            cooling = math.ceil(COOLING_STARTS * planned)
            position.epoch = cooling if position.epoch < cooling else planned
            position.since_best = 0
        return position.epoch < planned

    def _epoch(self) -> TrainingEvent:
        position = self.position
        self.pass_over()
        position.epoch += 1
        position.epochs_run += 1
        position.since_best += position.stage == "settling"
        accuracy, loss = self.score()
        if (accuracy, -loss) > (position.best[0], -position.best[1]):
            position.best, position.since_best = [accuracy, loss], 0
            self.remember()
        return self.event("epoch", accuracy)

    def _finish(self) -> TrainingEvent:
        """Keep the last weights, or others that did clearly better, and calibrate them."""
        last = self.score()
        if clearly_better(self.position.best[0], than=last[0], pictures=len(self.judged)):
            self.go_back()
        else:
            self.position.best = last
        self.position.stage = "finished"
        self.calibrate()
        return self.event("done", self.position.best[0])
