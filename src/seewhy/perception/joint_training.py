"""How the networks of all features are trained together, to tell feature vectors apart."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

import numpy as np
import torch

from seewhy.domain.tables import TOGETHER
from seewhy.perception.annotated_vectors import (
    UNKNOWN,
    AnnotatedVectors,
    ShownPictures,
    codes_of,
)
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
from seewhy.perception.epochs import EpochTraining, batches, planned_epochs
from seewhy.perception.events import FeatureRecord, Kind, TrainingEvent
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import value_weights
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.new_network import record_of
from seewhy.perception.optimisation import (
    load_optimizer,
    new_optimizer,
    one_cycle,
    optimizer_tensors,
    slow_down,
)
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.side_by_side import Threads, threads
from seewhy.perception.validation import divided

__all__ = ["train_jointly"]

_AT_ONCE = 256  # pictures of one forward pass where nothing is trained


def train_jointly(
    networks: Mapping[str, GrowingNetwork],
    shown: LabelledPictures,
    *,
    options: Mapping[str, TrainingOptions],
    fine_tune: bool,
    rehearsal: Rehearsal | None = None,
    course: Course = QUIETLY,
) -> dict[str, tuple[GrowingNetwork, FeatureRecord]]:
    """Train one network a feature so that together they tell annotated feature vectors apart.

    A domain asks for it by ``[networks] together``; use it where features are read together: a
    vector's probability is the product of its values' probabilities, and what matters is that the
    true vector's is greater than that of all others that pictures were annotated with. The loss
    is the cross-entropy of the true vector among them, and, with a smaller weight, that of each
    feature by itself, so that every network still sees its own feature and a combination that no
    picture showed can be read. All networks keep their depth; one temperature for all leaves the
    order of the vectors as it is.

    Parameters
    ----------
    networks : mapping of str to GrowingNetwork
        What to start from: untrained networks of their final depth, or trained ones. They are
        trained in place.
    shown : LabelledPictures
        With the labels of these networks' features.
    options : mapping of str to TrainingOptions
        Pictures are varied, and batches made, as the first feature's say.
    fine_tune : bool
        Whether the networks are trained already: half the epochs, a third of the learning rate.
    rehearsal : Rehearsal, optional
        As for :func:`~seewhy.perception.fitting_extractor.fit_extractor`.
    course : Course
        Its ``workers`` are threads here.

    Returns
    -------
    dict of str to (GrowingNetwork, FeatureRecord)
        In evaluation mode, on the CPU.

    Notes
    -----
    Departure from the paper, which trains every feature's network by itself. Source of the idea:
    Manhaeve et al. (2018), "DeepProbLog", who train networks through what is reasoned from them.
    """
    from loky import cpu_count  # counts the cores that this process may use

    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    count = cpu_count() if course.workers < 1 else course.workers
    with threads(1 if device.type == "cuda" else count) as several:
        training = _JointTraining(
            networks,
            shown,
            options=options,
            fine_tune=fine_tune,
            rehearsal=rehearsal,
            several=several,
        )
        checkpoint = None
        if course.checkpoints is not None:
            checkpoint = Checkpoint(
                checkpoint_file(course.checkpoints, TOGETHER),
                _fingerprint(networks, shown, options=options, rehearsal=rehearsal),
            )
        training.run(checkpoint, course.on_progress)
    return {
        name: (network.to("cpu").eval(), training.record(name))
        for name, network in training.networks.items()
    }


class _JointTraining(EpochTraining):
    """Networks, the pictures they learn from, and where their training stands."""

    patience = float("inf")

    def __init__(
        self,
        networks: Mapping[str, GrowingNetwork],
        shown: LabelledPictures,
        *,
        options: Mapping[str, TrainingOptions],
        fine_tune: bool,
        rehearsal: Rehearsal | None,
        several: Threads,
    ) -> None:
        self.options, self.shared = dict(options), next(iter(options.values()))
        self.fine_tune, self.several = fine_tune, several
        self.device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
        # The largest first: the threads then end at about the same time.
        order = sorted(networks, key=lambda name: -networks[name].parameters_count)
        self.networks = {name: networks[name].to(self.device) for name in order}
        codes = codes_of(shown.labels, shown.values, order)
        train, validation = divided(
            shown,
            np.arange(len(codes)),
            [tuple(vector) for vector in codes.tolist()],
            share=self.shared.validation_share,
            seed=seed_of(self.shared.seed, TOGETHER, "split"),
        )
        annotated, trained, again = codes, codes[train], None
        if rehearsal is not None:
            again = codes_of(rehearsal.labels, shown.values, order)
            annotated, trained = (np.concatenate([some, again]) for some in (codes, trained))
        self.vectors = AnnotatedVectors.among(annotated, device=self.device)
        self.shown = self.vectors.shown_by(shown.pixels, codes)
        self.again: ShownPictures | None = None
        if rehearsal is not None and again is not None:
            self.again = self.vectors.shown_by(rehearsal.pictures, again)
        self.train = torch.from_numpy(train).to(self.device)
        self.judged = torch.from_numpy(validation if len(validation) else train).to(self.device)
        self.validated = len(validation)
        self.weights = [
            value_weights(
                known[known != UNKNOWN], len(shown.values[name]), self.options[name].balance
            ).to(self.device)
            for name, known in zip(order, codes[train].T, strict=True)
        ]
        for network, known in zip(self.networks.values(), trained.T, strict=True):
            network.is_shown(known[known != UNKNOWN])
            if not fine_tune:
                network.standardise_by(shown.pixels[train])
        planned = planned_epochs(self.shared.max_epochs, pictures=len(train), fine_tune=fine_tune)
        self.planned = {"settling": planned, "finished": planned}
        largest = self.shared.learning_rate / (3.0 if fine_tune else 1.0)
        self.optimizers = {
            name: new_optimizer(network, self.options[name], largest=largest)
            for name, network in self.networks.items()
        }
        self.position = Position(stage="settling")
        self.best: dict[str, Weights] = {}
        self.accuracy: dict[str, float] = {}

    def begin(self) -> None:
        """Score what was there, if anything: it is kept unless training on does better."""
        if self.fine_tune:
            self.position.best = self.score()
            self.remember()

    def resume(self, position: Position, tensors: dict[str, Weights]) -> None:
        """Go on from a checkpoint."""
        self.position = position
        for number, (name, network) in enumerate(self.networks.items()):
            network.load_state_dict(tensors[f"network{number}"])
            load_optimizer(self.optimizers[name], tensors.get(f"optimizer{number}", {}))
        self.best = {
            name: tensors.get(f"best{number}", {}) for number, name in enumerate(self.networks)
        }
        if position.stage == "finished":
            self.score()

    def tensors(self) -> dict[str, Weights]:
        """What :meth:`resume` needs beside the position."""
        parts: dict[str, Weights] = {}
        for number, (name, network) in enumerate(self.networks.items()):
            parts[f"network{number}"] = dict(network.state_dict())
            if self.position.stage != "finished":
                parts[f"best{number}"] = self.best.get(name, {})
                parts[f"optimizer{number}"] = optimizer_tensors(self.optimizers[name])
        return parts

    def pass_over(self) -> None:
        """Pass once over the training pictures, each varied anew."""
        position, options = self.position, self.shared
        with seeded(self.device, options.seed, TOGETHER, position.epoch):
            for network in self.networks.values():
                network.train()
            for batch in batches(
                self.train,
                size=options.batch_size,
                epoch=position.epoch,
                epochs=self.planned["settling"],
                rehearsed=0 if self.again is None else len(self.again.x),
            ):
                shown = self.shown.of(batch.rows)
                if self.again is not None:
                    shown = shown.joined(self.again.of(batch.again))
                for optimizer in self.optimizers.values():
                    slow_down(optimizer, to=one_cycle(batch.progress))
                self._step(shown)

    def _step(self, shown: ShownPictures) -> None:
        x = augment(shown.x, self.shared)
        names = list(self.networks)
        # Threads draw no random numbers: dropout comes after, in this one.
        seen = self.several.map(lambda name: self.networks[name].embeddings(x), names)
        leaves = [embedding.detach().requires_grad_() for embedding in seen]
        for optimizer in self.optimizers.values():
            optimizer.zero_grad(set_to_none=True)
        logits = [
            network.logits(leaf)
            for network, leaf in zip(self.networks.values(), leaves, strict=True)
        ]
        self.vectors.loss(logits, shown, self.weights).backward()  # type: ignore[no-untyped-call]

        def back(number: int) -> None:
            torch.autograd.backward([seen[number]], [leaves[number].grad])
            self.optimizers[names[number]].step()

        self.several.map(back, range(len(names)))

    def judged_logits(self) -> list[torch.Tensor]:
        """Every network's logits of the pictures by which the networks are judged."""
        found = []
        for network in self.networks.values():
            network.eval()
            with torch.inference_mode():
                parts = torch.split(self.judged, _AT_ONCE)
                found.append(torch.cat([network(self.shown.x[part]) for part in parts]))
        return found

    def score(self) -> list[float]:
        """Share of vectors read rightly among the annotated ones, and the mean loss.

        Where no picture has all its values, the mean share of values read rightly.
        """
        logits = self.judged_logits()
        judged = self.shown.of(self.judged)
        for name, of_feature, codes in zip(self.networks, logits, judged.codes.T, strict=True):
            known = codes != UNKNOWN
            right = of_feature.argmax(dim=1)[known] == codes[known]
            self.accuracy[name] = float(right.double().mean()) if len(right) else 1.0
        loss = float(self.vectors.loss(logits, judged, self.weights))
        if not len(self.vectors.rows):
            return [float(np.mean(list(self.accuracy.values()))), loss]
        best = self.vectors.logits(logits).argmax(dim=1)
        right = judged.fitting[torch.arange(len(best), device=self.device), best]
        return [float(right.double().mean()), loss]

    def remember(self) -> None:
        """Copy the weights as they are: no epoch was better."""
        self.best = {
            name: {key: tensor.clone() for key, tensor in network.state_dict().items()}
            for name, network in self.networks.items()
        }

    def go_back(self) -> None:
        """Take the weights that were remembered."""
        for name, network in self.networks.items():
            network.load_state_dict(self.best[name])
        self.score()

    def calibrate(self) -> None:
        """Fit one temperature of all networks: it leaves the order of the vectors as it is."""
        pairs = []
        for of_feature, codes in zip(
            self.judged_logits(), self.shown.codes[self.judged].T, strict=True
        ):
            known = codes != UNKNOWN
            if of_feature.shape[1] > 1 and known.any():
                pairs.append((of_feature[known].cpu(), codes[known].cpu()))
        if pairs:
            temperature = fitted_temperature(*pairs)
            for network in self.networks.values():
                network.temperature.fill_(temperature)

    def record(self, name: str) -> FeatureRecord:
        """What came of training a feature."""
        return record_of(
            self.networks[name],
            epochs=self.position.epochs_run,
            accuracy=self.accuracy[name],
            threshold=self.options[name].threshold,
            training=len(self.train),
            validation=self.validated,
        )

    def event(self, kind: Kind, accuracy: float) -> TrainingEvent:
        """What just happened, in numbers and words."""
        position, planned = self.position, self.planned["settling"]
        words = f"all features {TOGETHER}: {accuracy:.1%} on validation"
        if kind == "epoch":
            words = f"{words}, epoch {position.epoch} of {planned}"
        depth = max(network.depth for network in self.networks.values())
        return TrainingEvent(TOGETHER, depth, position.epoch, planned, accuracy, kind, words)


def _fingerprint(
    networks: Mapping[str, GrowingNetwork],
    shown: LabelledPictures,
    *,
    options: Mapping[str, TrainingOptions],
    rehearsal: Rehearsal | None,
) -> str:
    digest = hashlib.sha256(TOGETHER.encode())
    for name, network in networks.items():
        digest.update(
            fingerprint(
                shown, name, options=options[name], start_from=network, rehearsal=rehearsal
            ).encode()
        )
    return digest.hexdigest()
