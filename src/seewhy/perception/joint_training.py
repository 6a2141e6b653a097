"""How the networks of all features are trained together, to tell feature vectors apart."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.domain.tables import TOGETHER
from seewhy.perception import checkpoint
from seewhy.perception.augmentation import augment
from seewhy.perception.calibration import fitted_temperature
from seewhy.perception.checkpoint import Position, Weights
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.events import FeatureRecord, Kind, TrainingEvent
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import labelled, value_weights
from seewhy.perception.network import GrowingNetwork
from seewhy.perception.optimisation import (
    load_optimizer,
    new_optimizer,
    one_cycle,
    optimizer_tensors,
)
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.rehearsal import Rehearsal
from seewhy.perception.training import REHEARSED, Pictures, planned_epochs
from seewhy.perception.validation import clearly_better, split

__all__ = ["train_jointly"]

VECTOR_SHARE = 0.7  # of the loss; the rest is that of the features each by itself
UNKNOWN = -1
_AT_ONCE = 256  # pictures of one forward pass where nothing is trained

Column = Sequence[str | None]
_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


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
        As for :func:`~seewhy.perception.extractor.fit_extractor`.
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
    training = _JointTraining(
        networks, shown, options=options, fine_tune=fine_tune, rehearsal=rehearsal
    )
    file, digest = None, ""
    if course.checkpoints is not None:
        file = checkpoint.checkpoint_file(course.checkpoints, TOGETHER)
        digest = _fingerprint(networks, shown, options=options, rehearsal=rehearsal)
        found = checkpoint.read(file, digest, Position)
        if found is not None:
            training.resume(*found)
    with _Threads(course.workers, training.device) as threads:
        while training.position.stage != "finished":
            event = training.train_epoch(threads) if training.epochs_are_left else training.finish()
            if file is not None:
                checkpoint.write(file, digest, training.position, training.tensors())
            if course.on_progress is not None:
                course.on_progress(event)
    return {
        name: (network.to("cpu").eval(), training.record(name))
        for name, network in training.networks.items()
    }


class _Threads:
    """Does the same for every network: on threads of one core each, the largest first."""

    def __init__(self, workers: int, device: torch.device) -> None:
        from loky import cpu_count  # counts the cores that this process may use

        self.count = 1 if device.type == "cuda" else cpu_count() if workers < 1 else workers

    def __enter__(self) -> _Threads:
        self.before = torch.get_num_threads()
        torch.set_num_threads(1)
        self.pool = ThreadPoolExecutor(self.count, initializer=lambda: torch.set_num_threads(1))
        return self

    def __exit__(self, *_: object) -> None:
        self.pool.shutdown(cancel_futures=True)
        torch.set_num_threads(self.before)

    def map(self, do: Callable[[_Item], _Result], items: Sequence[_Item]) -> list[_Result]:
        if self.count == 1:
            return [do(item) for item in items]
        return list(self.pool.map(do, items))


class _Shown(NamedTuple):
    """Pictures on the device, the code of every feature's value, and the vectors they may be."""

    x: torch.Tensor
    codes: torch.Tensor
    fitting: torch.Tensor  # (pictures, vectors): annotated vectors that known values agree with

    def of(self, positions: torch.Tensor) -> _Shown:
        return _Shown(self.x[positions], self.codes[positions], self.fitting[positions])


class _JointTraining:
    """Networks, the pictures they learn from, and where their training stands."""

    def __init__(
        self,
        networks: Mapping[str, GrowingNetwork],
        shown: LabelledPictures,
        *,
        options: Mapping[str, TrainingOptions],
        fine_tune: bool,
        rehearsal: Rehearsal | None,
    ) -> None:
        values = shown.values
        self.options = dict(options)
        self.shared = next(iter(options.values()))
        self.device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
        # The largest first: the threads then end at about the same time.
        order = sorted(networks, key=lambda name: -networks[name].parameters_count)
        self.networks = {name: networks[name].to(self.device) for name in order}
        codes = _codes(shown.labels, values, order)
        again = None if rehearsal is None else _codes(rehearsal.labels, values, order)
        annotated = codes if again is None else np.concatenate([codes, again])
        self.rows = np.unique(annotated[(annotated != UNKNOWN).all(axis=1)], axis=0)
        self.columns = torch.from_numpy(self.rows).to(self.device)
        self.shown = self._on_device(shown.pixels, codes)
        self.again = (
            None
            if rehearsal is None or again is None
            else self._on_device(rehearsal.pictures, again)
        )
        if shown.validation is None:
            self.train, self.validation = split(
                [tuple(vector) for vector in codes.tolist()],
                share=self.shared.validation_share,
                seed=seed_of(self.shared.seed, TOGETHER, "split"),
                groups=shown.groups,
            )
        else:
            self.train = np.setdiff1d(np.arange(len(codes)), shown.validation)
            self.validation = shown.validation
        judged = self.validation if len(self.validation) else self.train
        self.judged = torch.from_numpy(judged).to(self.device)
        self.weights = {
            name: value_weights(
                known[known != UNKNOWN], len(values[name]), self.options[name].balance
            ).to(self.device)
            for name, known in zip(order, codes[self.train].T, strict=True)
        }
        trained = codes[self.train] if again is None else np.concatenate([codes[self.train], again])
        for network, known in zip(self.networks.values(), trained.T, strict=True):
            network.is_shown(known[known != UNKNOWN])
        if not fine_tune:
            for network in self.networks.values():
                network.standardise_by(shown.pixels[self.train])
        self.planned = planned_epochs(
            self.shared.max_epochs, pictures=len(self.train), fine_tune=fine_tune
        )
        self.peak_rate = self.shared.learning_rate / (3.0 if fine_tune else 1.0)
        self.optimizers = {
            name: new_optimizer(network, self.options[name])
            for name, network in self.networks.items()
        }
        self.position = Position(stage="settling")
        self.best: dict[str, Weights] = {}
        self.accuracy: dict[str, float] = {}
        if fine_tune:
            # What was there is kept unless training on does better.
            self.position.best, self.best = self.score(), self.copied()

    def _on_device(self, pictures: Pictures, codes: npt.NDArray[np.int64]) -> _Shown:
        fitting = np.ones((len(codes), len(self.rows)), dtype=bool)
        for known, column in zip(codes.T, self.rows.T, strict=True):
            fitting &= (known[:, None] == column[None]) | (known[:, None] == UNKNOWN)
        return _Shown(
            torch.from_numpy(np.ascontiguousarray(pictures)).to(self.device),
            torch.from_numpy(codes).to(self.device),
            torch.from_numpy(fitting).to(self.device),
        )

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

    @property
    def epochs_are_left(self) -> bool:
        """Whether there are passes to go."""
        return self.position.epoch < self.planned

    def train_epoch(self, threads: _Threads) -> TrainingEvent:
        """Pass once over the training pictures, each varied anew."""
        position, options = self.position, self.shared
        with seeded(self.device, options.seed, TOGETHER, position.epoch):
            order = torch.from_numpy(self.train)[torch.randperm(len(self.train))].to(self.device)
            steps = math.ceil(len(order) / options.batch_size)
            rehearsed: Sequence[torch.Tensor] = ()
            if self.again is not None:
                count = min(len(self.train), REHEARSED)
                chosen = torch.randperm(len(self.again.x))[:count].to(self.device)
                rehearsed = torch.tensor_split(chosen, steps)
            for network in self.networks.values():
                network.train()
            for step, batch in enumerate(torch.tensor_split(order, steps)):
                shown = self.shown.of(batch)
                if self.again is not None:
                    more = self.again.of(rehearsed[step])
                    shown = _Shown(*map(torch.cat, zip(shown, more, strict=True)))
                rate = one_cycle((position.epoch + step / steps) / self.planned)
                self._step(shown, self.peak_rate * rate, threads)
        position.epoch += 1
        position.epochs_run += 1
        score = self.score()
        if (score[0], -score[1]) > (position.best[0], -position.best[1]):
            position.best, self.best = score, self.copied()
        return self.event("epoch", score[0])

    def _step(self, shown: _Shown, rate: float, threads: _Threads) -> None:
        x = augment(shown.x, self.shared)
        names = list(self.networks)
        # Threads draw no random numbers: dropout comes after, in this one.
        seen = threads.map(lambda name: self.networks[name].embeddings(x), names)
        leaves = [embedding.detach().requires_grad_() for embedding in seen]
        for optimizer in self.optimizers.values():
            optimizer.zero_grad(set_to_none=True)
            for group in optimizer.param_groups:
                group["lr"] = rate
        logits = [
            network.logits(leaf)
            for network, leaf in zip(self.networks.values(), leaves, strict=True)
        ]
        self._loss(logits, shown).backward()  # type: ignore[no-untyped-call]

        def back(number: int) -> None:
            torch.autograd.backward([seen[number]], [leaves[number].grad])
            self.optimizers[names[number]].step()

        threads.map(back, range(len(names)))

    def _loss(self, logits: Sequence[torch.Tensor], shown: _Shown) -> torch.Tensor:
        joint = self._joint(logits)
        some = shown.fitting.any(dim=1)
        fitting = joint.masked_fill(~shown.fitting, -torch.inf)[some]
        vectors = torch.logsumexp(joint[some], dim=1) - torch.logsumexp(fitting, dim=1)
        together = vectors.sum() / len(shown.x)
        alone = sum(
            functional.cross_entropy(of_feature, codes, weight=weight, ignore_index=UNKNOWN)
            for of_feature, codes, weight in zip(
                logits, shown.codes.T, self.weights.values(), strict=True
            )
            if (codes != UNKNOWN).any()
        )
        return VECTOR_SHARE * together + (1.0 - VECTOR_SHARE) * alone

    def _joint(self, logits: Sequence[torch.Tensor]) -> torch.Tensor:
        """The logits of all annotated vectors, shape (pictures, vectors)."""
        joint = torch.zeros((len(logits[0]), len(self.rows)), device=self.device)
        for of_feature, column in zip(logits, self.columns.T, strict=True):
            joint = joint + of_feature[:, column]
        return joint

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
        loss = float(self._loss(logits, judged))
        if not len(self.rows):
            return [float(np.mean(list(self.accuracy.values()))), loss]
        best = self._joint(logits).argmax(dim=1)
        right = judged.fitting[torch.arange(len(best), device=self.device), best]
        return [float(right.double().mean()), loss]

    def finish(self) -> TrainingEvent:
        """Keep the last weights, or others that did clearly better, and calibrate them."""
        last = self.score()
        if clearly_better(self.position.best[0], than=last[0], pictures=len(self.judged)):
            for name, network in self.networks.items():
                network.load_state_dict(self.best[name])
            self.score()
        else:
            self.position.best = last
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
        self.position.stage = "finished"
        return self.event("done", self.position.best[0])

    def copied(self) -> dict[str, Weights]:
        """A copy of all networks' weights."""
        return {
            name: {key: tensor.clone() for key, tensor in network.state_dict().items()}
            for name, network in self.networks.items()
        }

    def record(self, name: str) -> FeatureRecord:
        """What came of training a feature."""
        network = self.networks[name]
        return FeatureRecord(
            layers=network.layers,
            depth=network.depth,
            parameters=network.parameters_count,
            epochs=self.position.epochs_run,
            validation_accuracy=self.accuracy[name],
            threshold=self.options[name].threshold,
            temperature=float(network.temperature),
            training_pictures=len(self.train),
            validation_pictures=len(self.validation),
        )

    def event(self, kind: Kind, accuracy: float) -> TrainingEvent:
        """What just happened, in numbers and words."""
        position = self.position
        words = f"all features {TOGETHER}: {accuracy:.1%} on validation"
        if kind == "epoch":
            words = f"{words}, epoch {position.epoch} of {self.planned}"
        depth = max(network.depth for network in self.networks.values())
        return TrainingEvent(TOGETHER, depth, position.epoch, self.planned, accuracy, kind, words)


def _codes(
    labels: Mapping[str, Column], values: Mapping[str, Sequence[str]], names: Sequence[str]
) -> npt.NDArray[np.int64]:
    """The places of the values, shape (pictures, features); -1 where one is not known."""
    count = len(next(iter(labels.values())))
    codes = np.full((count, len(names)), UNKNOWN, dtype=np.int64)
    for column, name in enumerate(names):
        chosen, targets = labelled(labels[name], feature=name, values=values[name])
        codes[chosen, column] = targets
    return codes


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
            checkpoint.fingerprint(
                shown, name, options=options[name], start_from=network, rehearsal=rehearsal
            ).encode()
        )
    return digest.hexdigest()
