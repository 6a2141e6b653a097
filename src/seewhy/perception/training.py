"""How one feature's network is grown and trained."""

from __future__ import annotations

import math
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.perception.augmentation import augment
from seewhy.perception.calibration import fitted_temperature
from seewhy.perception.checkpoint import (
    Checkpoint,
    Position,
    Weights,
    checkpoint_file,
    fingerprint,
)
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.epochs import EpochTraining, batches, more_for, planned_epochs
from seewhy.perception.events import FeatureRecord, Kind, TrainingEvent
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import labelled, value_weights
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.new_network import constant_network, new_network, record_of
from seewhy.perception.optimisation import (
    descend,
    load_optimizer,
    new_optimizer,
    one_cycle,
    optimizer_tensors,
    slow_down,
)
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.validation import divided

__all__ = ["train_network"]

FLAT_GROWTHS = 2  # growths without gain that end the growing: one alone may be bad luck
MINIMAL_GAIN = 0.005  # in accuracy, for a growth to count as one that helped


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
    values = shown.values[feature]
    _, targets = labelled(shown.labels[feature], feature=feature, values=values)
    if len(np.unique(targets)) == 1 and start_from is None:
        network = constant_network(shown, feature, options=options)
        if course.on_progress is not None:
            text = f"{feature} is {values[int(targets[0])]} in every picture: nothing to learn"
            course.on_progress(TrainingEvent(feature, 1, 0, 0, 1.0, "done", text))
        return network, record_of(
            network,
            epochs=0,
            accuracy=1.0,
            threshold=options.threshold,
            training=len(targets),
            validation=0,
        )
    training = _Training(
        shown, feature, options=options, start_from=start_from, rehearsal=rehearsal
    )
    checkpoint = None
    if course.checkpoints is not None:
        checkpoint = Checkpoint(
            checkpoint_file(course.checkpoints, feature),
            fingerprint(
                shown, feature, options=options, start_from=start_from, rehearsal=rehearsal
            ),
        )
    training.run(checkpoint, course.on_progress)
    network = training.network.to("cpu").eval()
    return network, record_of(
        network,
        epochs=training.position.epochs_run,
        accuracy=training.position.best[0],
        threshold=options.threshold,
        training=len(training.examples.train),
        validation=training.examples.validated,
    )


@dataclass(frozen=True, eq=False)
class _Examples:
    """The pictures of which a feature is annotated, on the device, and which of them do what."""

    pictures: torch.Tensor
    targets: torch.Tensor
    train: torch.Tensor
    judged: torch.Tensor
    validated: int
    rehearsed: tuple[torch.Tensor, torch.Tensor] | None
    trained_values: npt.NDArray[np.int64]  # of all that is trained on, rehearsed as well
    loss_weights: torch.Tensor
    trained_pictures: npt.NDArray[np.uint8]


def _examples(
    shown: LabelledPictures,
    feature: str,
    *,
    options: TrainingOptions,
    rehearsal: Rehearsal | None,
    device: torch.device,
) -> _Examples:
    values = shown.values[feature]
    chosen, targets = labelled(shown.labels[feature], feature=feature, values=values)
    pictures = shown.pixels[chosen]
    train, validation = divided(
        shown,
        chosen,
        targets.tolist(),
        share=options.validation_share,
        seed=seed_of(options.seed, feature, "split"),
    )
    trained = targets[train]
    rehearsed = None
    if rehearsal is not None:
        _, again = labelled(rehearsal.labels[feature], feature=feature, values=values)
        known = torch.from_numpy(np.ascontiguousarray(rehearsal.pictures))
        rehearsed = known.to(device), torch.from_numpy(again).to(device)
        trained = np.concatenate([trained, again])
    # With too few pictures to spare any, those of training must do.
    judged = validation if len(validation) else train
    return _Examples(
        pictures=torch.from_numpy(np.ascontiguousarray(pictures)).to(device),
        targets=torch.from_numpy(targets).to(device),
        train=torch.from_numpy(train).to(device),
        judged=torch.from_numpy(judged).to(device),
        validated=len(validation),
        rehearsed=rehearsed,
        trained_values=trained.astype(np.int64),
        loss_weights=value_weights(targets[train], len(values), options.balance).to(device),
        trained_pictures=pictures[train],
    )


class _Training(EpochTraining):
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
        self.device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
        self.examples = _examples(
            shown, feature, options=options, rehearsal=rehearsal, device=self.device
        )
        self.judged = self.examples.judged
        count, tuning = len(self.examples.train), start_from is not None
        settling = planned_epochs(options.max_epochs, pictures=count, fine_tune=tuning)
        growing = planned_epochs(options.growing_epochs, pictures=count)
        self.patience = math.ceil(options.patience * more_for(count))
        self.planned = {"growing": growing, "settling": settling, "finished": settling}
        self.peak_rate = options.learning_rate / (3.0 if start_from else 1.0)
        with self.seeded("first"):
            self.network = new_network(shown.pixels.shape[1], len(shown.values[feature]), options)
        self.network.standardise_by(self.examples.trained_pictures)
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
        self.network.is_shown(self.examples.trained_values)
        self.network.to(self.device)
        self.optimizer = self.new_optimizer()
        if self.start_from is not None:
            self.position.stage, self.position.depth = "settling", self.network.depth
            # What was there is kept unless training on does better.
            self.position.best = self.score()
            self.remember()

    def resume(self, position: Position, tensors: dict[str, Weights]) -> None:
        """Go on from a checkpoint."""
        self.position = position
        with self.seeded("resume"):
            self.network = self.network.of_depth(position.depth)
        self.network.load_state_dict(tensors["network"])
        self.network.to(self.device)
        self.best, self.chosen = tensors.get("best", {}), tensors.get("chosen", {})
        self.optimizer = self.new_optimizer()
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

    def pass_over(self) -> None:
        """Pass once over the training pictures, each varied anew."""
        position, examples, rehearsed = self.position, self.examples, self.examples.rehearsed
        with self.seeded(position.stage, position.depth, position.epoch):
            self.network.train()
            for batch in batches(
                examples.train,
                size=self.options.batch_size,
                epoch=position.epoch,
                epochs=self.planned[position.stage],
                rehearsed=0 if rehearsed is None else len(rehearsed[1]),
            ):
                slow_down(self.optimizer, to=one_cycle(batch.progress))
                x, y = examples.pictures[batch.rows], examples.targets[batch.rows]
                if rehearsed is not None:
                    x = torch.cat([x, rehearsed[0][batch.again]])
                    y = torch.cat([y, rehearsed[1][batch.again]])
                logits = self.network(augment(x, self.options))
                weights = examples.loss_weights
                descend(functional.cross_entropy(logits, y, weight=weights), self.optimizer)

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
        self.optimizer = self.new_optimizer()
        return self.event(kind, accuracy)

    def calibrate(self) -> None:
        """Fit the temperature of the weights as they are."""
        logits, targets = self.judged_logits(), self.examples.targets[self.judged]
        self.network.temperature.fill_(fitted_temperature((logits.cpu(), targets.cpu())))

    def judged_logits(self) -> torch.Tensor:
        """Logits of the pictures by which the network is judged."""
        self.network.eval()
        pictures = self.examples.pictures
        with torch.inference_mode():
            return torch.cat([self.network(pictures[i]) for i in torch.split(self.judged, 256)])

    def score(self) -> list[float]:
        """Accuracy and mean loss on the pictures by which the network is judged."""
        logits, targets = self.judged_logits(), self.examples.targets[self.judged]
        accuracy = (logits.argmax(dim=1) == targets).double().mean()
        return [float(accuracy), float(functional.cross_entropy(logits.double(), targets))]

    def remember(self) -> None:
        """Copy the weights as they are: no epoch was better at this depth."""
        self.best = {name: tensor.clone() for name, tensor in self.network.state_dict().items()}

    def go_back(self) -> None:
        """Take the weights that were remembered."""
        self.network.load_state_dict(self.best)

    def new_optimizer(self) -> torch.optim.AdamW:
        """One that has seen nothing yet."""
        return new_optimizer(self.network, self.options, largest=self.peak_rate)

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
