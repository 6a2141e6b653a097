"""How one feature's network is trained: a loop that one reads in one sitting."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.perception import checkpoint
from seewhy.perception.augmentation import augment
from seewhy.perception.calibration import fitted_temperature
from seewhy.perception.checkpoint import Position, Weights
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.events import FeatureRecord, Kind, TrainingEvent
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import labelled, value_weights
from seewhy.perception.network import GrowingNetwork, deepest
from seewhy.perception.optimisation import (
    load_optimizer,
    new_optimizer,
    one_cycle,
    optimizer_tensors,
)
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.validation import clearly_better, split

__all__ = ["new_network", "planned_epochs", "train_network"]

ENOUGH_PICTURES = 1000  # what `max_epochs` is meant for; fewer pictures get more epochs
PLENTY = 5000  # more pictures get fewer epochs, at least half
FLAT_GROWTHS = 2  # growths without gain that end the growing: one alone may be bad luck
COOLING_STARTS = 0.7  # of the planned epochs; from here on steps are small
REHEARSED = 1000  # pictures of an earlier training in a pass, at most
MINIMAL_GAIN = 0.005  # in accuracy, for a growth to count as one that helped

Pictures = npt.NDArray[np.uint8]
Indices = npt.NDArray[np.int64]


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
    return math.ceil(epochs * _more_for(pictures) * fewer * (0.5 if fine_tune else 1.0))


def _more_for(pictures: int) -> float:
    return min(4.0, max(1.0, ENOUGH_PICTURES / pictures))


def train_network(
    shown: LabelledPictures,
    feature: str,
    *,
    options: TrainingOptions,
    start_from: GrowingNetwork | None = None,
    rehearsal: Rehearsal | None = None,
    course: Course = QUIETLY,
) -> tuple[GrowingNetwork, FeatureRecord]:
    """Grow and train the network of one feature.

    A network of ``options.depth`` convolutions is trained for a few epochs; while its validation
    accuracy is below the threshold and still improves, a convolution is added and the whole is
    trained again. The depth found is then trained until it no longer improves. The last weights
    are kept, unless others did clearly better on the validation pictures.

    Parameters
    ----------
    shown : LabelledPictures
        Those without a label of the feature are left out. Where they do not say on which ones to
        validate, ``options.validation_share`` of them are drawn, some of every value.
    feature : str
        Its name, for messages, checkpoints and seeds as well.
    options : TrainingOptions
        See there.
    start_from : GrowingNetwork, optional
        Its convolutions (and its head, where values and size agree) are trained on with half the
        epochs and a third of the learning rate; nothing grows.
    rehearsal : Rehearsal, optional
        Pictures that ``start_from`` was trained on, to go over again.
    course : Course
        With checkpoints, the state is written to one file after every epoch, and a call with the
        same data and options goes on from there and ends with the same weights as a call that was
        never interrupted. A file of other data or options, or a damaged one, is written over.
        ``on_progress`` is called after the checkpoint of each epoch is written.

    Returns
    -------
    network : GrowingNetwork
        In evaluation mode, on the CPU, with its temperature fitted.
    record : FeatureRecord
        What came of it.

    Raises
    ------
    DatasetError
        No picture is labelled, or a label is none of the values.

    Notes
    -----
    Source: Riley and Sridharan (2019), feature extraction. Departures: AdamW with a one-cycle
    learning rate and augmented pictures; the paper grows until the threshold, whereas here the
    depth found is trained on beyond it; growing also ends after two growths without gain.

    Examples
    --------
    >>> pictures = np.zeros((20, 16, 16, 3), dtype=np.uint8)
    >>> pictures[::2] = 200
    >>> shown = LabelledPictures(
    ...     pictures, {"light": ["on", "off"] * 10}, {"light": ["on", "off"]}
    ... )
    >>> options = TrainingOptions(max_epochs=2, growing_epochs=1)
    >>> network, record = train_network(shown, "light", options=options)
    >>> record.layers
    'conv 3→8, pool, dense 64, dropout 0.5, logits 2'
    """
    on_progress = course.on_progress
    _, targets = _labelled(shown, feature)
    if len(np.unique(targets)) == 1 and start_from is None:
        return _constant(shown, feature, options, on_progress)

    training = _Training(
        shown, feature, options=options, start_from=start_from, rehearsal=rehearsal
    )
    file, found, digest = None, None, ""
    if course.checkpoints is not None:
        file = checkpoint.checkpoint_file(course.checkpoints, feature)
        digest = checkpoint.fingerprint(
            shown, feature, options=options, start_from=start_from, rehearsal=rehearsal
        )
        found = checkpoint.read(file, digest, Position)
    if found is None:
        training.begin()
    else:
        training.resume(*found)

    if training.position.stage == "finished" and on_progress is not None:
        on_progress(training.event("done", training.position.best[0]))
    while training.position.stage != "finished":
        if training.epochs_are_left():
            event = training.train_epoch()
        elif training.position.stage == "growing":
            event = training.grow_or_settle()
        else:
            event = training.finish()
        if file is not None:
            checkpoint.write(file, digest, training.position, training.tensors())
        if on_progress is not None:
            on_progress(event)

    network = training.network.to("cpu").eval()
    return network, FeatureRecord(
        layers=network.layers,
        depth=network.depth,
        parameters=network.parameters_count,
        epochs=training.position.epochs_run,
        validation_accuracy=training.position.best[0],
        threshold=options.threshold,
        temperature=float(network.temperature),
        training_pictures=len(training.train),
        validation_pictures=len(training.validation),
    )


class _Training:
    """A network, the pictures it learns from, and where its training stands."""

    def __init__(
        self,
        shown: LabelledPictures,
        feature: str,
        *,
        options: TrainingOptions,
        start_from: GrowingNetwork | None,
        rehearsal: Rehearsal | None,
    ) -> None:
        if start_from is not None:
            options = replace(
                options,
                channels=start_from.channels,
                dense=start_from.dense,
                standard=start_from.standard,
            )
        self.feature, self.options, self.start_from = feature, options, start_from
        chosen, targets = _labelled(shown, feature)
        pictures, values = shown.pixels[chosen], len(shown.values[feature])
        if shown.validation is None:
            self.train, self.validation = split(
                targets.tolist(),
                share=options.validation_share,
                seed=seed_of(options.seed, feature, "split"),
                groups=None if shown.groups is None else [shown.groups[i] for i in chosen],
            )
        else:
            self.validation = np.flatnonzero(np.isin(chosen, shown.validation))
            self.train = np.setdiff1d(np.arange(len(targets)), self.validation)
        self.device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
        self.x = torch.from_numpy(np.ascontiguousarray(pictures)).to(self.device)
        self.y = torch.from_numpy(targets).to(self.device)
        self.rehearsed: tuple[torch.Tensor, torch.Tensor] | None = None
        trained_targets = targets[self.train]
        if rehearsal is not None:
            _, again = labelled(
                rehearsal.labels[feature], feature=feature, values=shown.values[feature]
            )
            self.rehearsed = (
                torch.from_numpy(np.ascontiguousarray(rehearsal.pictures)).to(self.device),
                torch.from_numpy(again).to(self.device),
            )
            trained_targets = np.concatenate([trained_targets, again])
        self.trained_values = trained_targets.astype(np.int64)
        # With too few pictures to spare any, those of training must do.
        judged = self.validation if len(self.validation) else self.train
        self.judged = torch.from_numpy(judged).to(self.device)
        self.loss_weights = value_weights(targets[self.train], values, options.balance).to(
            self.device
        )

        count, tuning = len(self.train), start_from is not None
        settling = planned_epochs(options.max_epochs, pictures=count, fine_tune=tuning)
        growing = planned_epochs(options.growing_epochs, pictures=count)
        self.patience = math.ceil(options.patience * _more_for(count))
        self.planned = {"growing": growing, "settling": settling, "finished": settling}
        self.peak_rate = options.learning_rate / (3.0 if start_from else 1.0)

        with self.seeded("first"):
            self.network = new_network(pictures.shape[1], values, options)
        self.network.standardise_by(pictures[self.train])
        self.position = Position(depth=self.network.depth)
        if self.network.depth == self.network.deepest:
            self.position.stage = "settling"
        self.best: Weights = {}  # of this depth
        self.chosen: Weights = {}  # of the best depth before

    def begin(self) -> None:
        """Take over the weights to start from, if any."""
        if self.start_from is not None:
            with self.seeded("adopt"):
                self.network.adopt(self.start_from)
        self.network.is_shown(self.trained_values)
        self.network.to(self.device)
        self.optimizer = new_optimizer(self.network, self.options)
        if self.start_from is not None:
            self.position.stage, self.position.depth = "settling", self.network.depth
            # What was there is kept unless training on does better.
            self.position.best, self.best = self.score(), self.weights()

    def resume(self, position: Position, tensors: dict[str, Weights]) -> None:
        """Go on from a checkpoint."""
        self.position = position
        with self.seeded("resume"):
            self.network = self.network.of_depth(position.depth)
        self.network.load_state_dict(tensors["network"])
        self.network.to(self.device)
        self.best, self.chosen = tensors.get("best", {}), tensors.get("chosen", {})
        self.optimizer = new_optimizer(self.network, self.options)
        load_optimizer(self.optimizer, tensors.get("optimizer", {}))

    def tensors(self) -> dict[str, Weights]:
        """What :meth:`resume` needs beside the position."""
        network = dict(self.network.state_dict())
        if self.position.stage == "finished":
            return {"network": network}
        return {
            "network": network,
            "best": self.best,
            "chosen": self.chosen,
            "optimizer": optimizer_tensors(self.optimizer),
        }

    def epochs_are_left(self) -> bool:
        """Whether this stage has epochs to go; out of patience, it skips to its last ones."""
        position, planned = self.position, self.planned[self.position.stage]
        if position.since_best >= self.patience:
            # Stopping here would leave the weights as the large steps tossed them: cool down first.
            cooling = math.ceil(COOLING_STARTS * planned)
            position.epoch = cooling if position.epoch < cooling else planned
            position.since_best = 0
        return position.epoch < planned

    def train_epoch(self) -> TrainingEvent:
        """Pass once over the training pictures, each varied anew."""
        position, options = self.position, self.options
        with self.seeded(position.stage, position.depth, position.epoch):
            order = torch.from_numpy(self.train)[torch.randperm(len(self.train))].to(self.device)
            steps = math.ceil(len(order) / options.batch_size)
            again = self.to_rehearse(steps)
            self.network.train()
            for i, batch in enumerate(torch.tensor_split(order, steps)):
                progress = (position.epoch + i / steps) / self.planned[position.stage]
                for group in self.optimizer.param_groups:
                    group["lr"] = self.peak_rate * one_cycle(progress)
                x, y = self.x[batch], self.y[batch]
                if self.rehearsed is not None:
                    x = torch.cat([x, self.rehearsed[0][again[i]]])
                    y = torch.cat([y, self.rehearsed[1][again[i]]])
                logits = self.network(augment(x, options))
                loss = functional.cross_entropy(logits, y, weight=self.loss_weights)
                self.optimizer.zero_grad(set_to_none=True)
                loss.backward()  # type: ignore[no-untyped-call]
                self.optimizer.step()
        position.epoch += 1
        position.epochs_run += 1
        position.since_best += position.stage == "settling"
        accuracy, mean_loss = self.score()
        if (accuracy, -mean_loss) > (position.best[0], -position.best[1]):
            position.best, position.since_best = [accuracy, mean_loss], 0
            self.best = self.weights()
        return self.event("epoch", accuracy)

    def to_rehearse(self, steps: int) -> tuple[torch.Tensor, ...]:
        """The numbers of the pictures to go over again in each step of this pass."""
        if self.rehearsed is None:
            return ()
        count = min(len(self.train), REHEARSED)
        chosen = torch.randperm(len(self.rehearsed[1]))[:count].to(self.device)
        return torch.tensor_split(chosen, steps)

    def grow_or_settle(self) -> TrainingEvent:
        """Add a convolution, or go back to the best depth if the accuracy suffices or stays."""
        position = self.position
        self.network.load_state_dict(self.best)
        if position.best[0] >= position.chosen[0] + MINIMAL_GAIN:
            position.chosen, position.chosen_depth = position.best, position.depth
            self.chosen, position.flat_growths = self.best, 0
        else:
            position.flat_growths += 1
        position.epoch = 0
        if (
            position.best[0] >= self.options.threshold
            or position.depth >= self.network.deepest
            or position.flat_growths >= FLAT_GROWTHS
        ):
            kind: Kind = "settled"
            position.stage, position.depth = "settling", position.chosen_depth
            with self.seeded("settle"):
                self.network = self.network.of_depth(position.depth).to(self.device)
            self.network.load_state_dict(self.chosen)
            position.best, self.best = position.chosen, self.chosen
            accuracy = position.best[0]
        else:
            kind = "grown"
            accuracy = position.best[0]
            with self.seeded("grow", position.depth):
                self.network.grow()
            position.depth, position.best = self.network.depth, [-1.0, math.inf]
        self.optimizer = new_optimizer(self.network, self.options)
        return self.event(kind, accuracy)

    def finish(self) -> TrainingEvent:
        """Keep the last weights, or others that did clearly better, and calibrate them."""
        last = self.score()
        if clearly_better(self.position.best[0], than=last[0], pictures=len(self.judged)):
            self.network.load_state_dict(self.best)
        else:
            self.position.best = last
        self.position.stage = "finished"
        logits, targets = self.judged_logits(), self.y[self.judged]
        self.network.temperature.fill_(fitted_temperature((logits.cpu(), targets.cpu())))
        return self.event("done", self.position.best[0])

    def judged_logits(self) -> torch.Tensor:
        """Logits of the pictures by which the network is judged."""
        self.network.eval()
        with torch.inference_mode():
            return torch.cat([self.network(self.x[i]) for i in torch.split(self.judged, 256)])

    def score(self) -> list[float]:
        """Accuracy and mean loss on the pictures by which the network is judged."""
        logits, targets = self.judged_logits(), self.y[self.judged]
        accuracy = (logits.argmax(dim=1) == targets).double().mean()
        return [float(accuracy), float(functional.cross_entropy(logits.double(), targets))]

    def weights(self) -> Weights:
        """A copy of the network's weights."""
        return {name: tensor.clone() for name, tensor in self.network.state_dict().items()}

    def seeded(self, *place: object) -> AbstractContextManager[None]:
        """Randomness of its own for a place in training, so that resuming changes nothing."""
        return seeded(self.device, self.options.seed, self.feature, *place)

    def event(self, kind: Kind, accuracy: float) -> TrainingEvent:
        """What just happened, in numbers and words."""
        position, layers = self.position, self.network.layers
        planned = self.planned[position.stage]
        scored = f"{accuracy:.1%} on validation"
        words = {
            "epoch": f"epoch {position.epoch} of {planned}, {scored}",
            "grown": f"{scored}, grows to {layers}",
            "settled": f"{scored}, stays with {layers}",
            "done": f"{scored} with {layers}",
        }
        message = f"{self.feature}: {words[kind]}"
        return TrainingEvent(
            self.feature, self.network.depth, position.epoch, planned, accuracy, kind, message
        )


def new_network(size: int, values: int, options: TrainingOptions) -> GrowingNetwork:
    """An untrained network for pictures of ``size`` pixels, as deep as it starts."""
    return GrowingNetwork(
        size=size,
        values=values,
        depth=min(options.depth, deepest(size)),
        dropout=options.dropout,
        dense=options.dense,
        channels=options.channels,
        standard=options.standard,
    )


def _labelled(shown: LabelledPictures, feature: str) -> tuple[Indices, Indices]:
    """The pictures with a label of the feature, and the index of each one's value."""
    return labelled(shown.labels[feature], feature=feature, values=shown.values[feature])


def _constant(
    shown: LabelledPictures,
    feature: str,
    options: TrainingOptions,
    on_progress: Callable[[TrainingEvent], None] | None,
) -> tuple[GrowingNetwork, FeatureRecord]:
    """Where only one value occurs nothing can be learned from the pictures: answer it always."""
    chosen, targets = _labelled(shown, feature)
    pictures, values = shown.pixels[chosen], shown.values[feature]
    with seeded(torch.device("cpu"), options.seed, feature, "first"):
        network = new_network(pictures.shape[1], len(values), options)
    network.standardise_by(pictures)
    network.is_shown(targets)
    # One more picture of each value is supposed, so that the others stay possible.
    counts = np.bincount(targets, minlength=len(values)) + 1.0
    network.always(torch.as_tensor(np.log(counts / counts.sum())))
    if on_progress is not None:
        text = f"{feature} is {values[int(targets[0])]} in every picture: nothing to learn"
        on_progress(TrainingEvent(feature, 1, 0, 0, 1.0, "done", text))
    return network.eval(), FeatureRecord(
        layers=network.layers,
        depth=network.depth,
        parameters=network.parameters_count,
        epochs=0,
        validation_accuracy=1.0,
        threshold=options.threshold,
        temperature=1.0,
        training_pictures=len(targets),
        validation_pictures=0,
    )
