"""Of which class a scene is: by the knowledge, or by the tree where that leaves it open."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from seewhy.agent.picture_reading import Other, Reading
from seewhy.agent.working_knowledge import WorkingKnowledge
from seewhy.dialogue.reply import UNCERTAIN, UNKNOWN, Classification, FeatureReading
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.reasoner import Verdict
from seewhy.knowledge.scene import FeatureVector

__all__ = ["Decided", "Deciding", "Demands", "below_gate"]


class Decided(NamedTuple):
    """The class of a feature vector, what gives it, and what the knowledge says of the vector."""

    label: str | None
    method: str
    verdict: Verdict


@dataclass(frozen=True)
class Demands:
    """What is asked of a picture before it is decided, and of what it may be as well.

    Attributes
    ----------
    gate : float or None
        How sure every network has to be for the knowledge to be asked.
    unknown_below : float or None
        The score below which a picture is not known.
    believed_from : float
        How probable a class has to be for who presumes it to be believed.
    """

    gate: float | None
    unknown_below: float | None
    believed_from: float


@dataclass(frozen=True)
class Deciding:
    """Knowledge, and the tree that is asked where it leaves a scene open.

    Attributes
    ----------
    known : WorkingKnowledge
    tree : DecisionTree
    """

    known: WorkingKnowledge
    tree: DecisionTree

    def decide(self, vector: FeatureVector) -> Decided:
        """The class of a feature vector."""
        return self.decide_all([vector])[vector]

    def decide_all(self, vectors: Sequence[FeatureVector]) -> dict[FeatureVector, Decided]:
        """The class of every feature vector."""
        decisions = dict(zip(vectors, self.known.reasoner.decide_all(vectors), strict=True))
        by_tree = self._by_tree(
            vector for vector, decision in decisions.items() if decision.label is None
        )
        return {
            vector: Decided(decision.label, "knowledge", decision.verdict)
            if decision.label is not None
            else Decided(
                by_tree.get(vector), "tree" if vector in by_tree else "none", decision.verdict
            )
            for vector, decision in decisions.items()
        }

    def _by_tree(self, vectors: Iterable[FeatureVector]) -> dict[FeatureVector, str]:
        """What the tree makes of feature vectors; nothing where there is none."""
        asked = list(vectors) if self.tree.fitted else []
        return dict(zip(asked, self.tree.classify_all(asked), strict=True)) if asked else {}

    def label_of(self, vector: FeatureVector) -> str | None:
        """The class of a feature vector, if it has one."""
        return self.decide(vector).label

    def class_shares(self, vector: FeatureVector) -> dict[str, float]:
        """The classes of a scene of some features, with the probability of each."""
        decision = self.known.reasoner.decide(vector)
        if decision.label is not None:
            return {decision.label: 1.0}
        return self.tree.probability(vector) if self.tree.fitted else {}

    def class_shares_of_all(self, vectors: Sequence[FeatureVector]) -> list[dict[str, float]]:
        """What :meth:`class_shares` gives for each of many."""
        self.known.reasoner.decide_all(vectors)  # remembers them; at once is much faster
        return [self.class_shares(vector) for vector in vectors]

    def classify_told(self, features: Mapping[str, str]) -> Classification:
        """Classify what is said to be shown instead of seen, as if it were sure."""
        domain = self.known.domain
        vector = domain.vector(features)
        label, method, verdict = self.decide(vector)
        told = {
            key: FeatureReading(features[key], 1.0) for key in domain.features if key in features
        }
        return Classification(label, method, vector, told, verdict.value, told=True)

    def classify(
        self, readings: Sequence[Reading], scores: Sequence[float], demands: Demands
    ) -> list[Classification]:
        """Classify pictures by what their features were read as.

        Parameters
        ----------
        readings : sequence of Reading
        scores : sequence of float
            How like each picture is to those of training.
        demands : Demands
        """
        decided = self.decide_all([reading.vector for reading in readings])
        uncertain = self._by_tree(
            reading.vector for reading in readings if below_gate(reading, demands.gate)
        )
        found: list[Classification] = []
        for reading, score in zip(readings, scores, strict=True):
            label, method, verdict = decided[reading.vector]
            said, probability = verdict.value, None if label is None else reading.probability
            if demands.unknown_below is not None and score < demands.unknown_below:
                label, method, said, probability = None, "none", UNKNOWN, None
            elif uncertain and below_gate(reading, demands.gate):
                label, method = uncertain[reading.vector], "tree"
                said, probability = UNCERTAIN, None
            elif method == "tree" and reading.leaning is not None:
                label = reading.leaning
            scene = Classification(
                label=label,
                method=method,
                vector=reading.vector,
                features=reading.features,
                verdict=said,
                probability=probability,
                score=score,
                class_seen=reading.class_seen,
            )
            others = self._others(scene, reading.others, demands.believed_from)
            found.append(replace(scene, otherwise=others))
        return found

    def _others(
        self, scene: Classification, others: Sequence[Other], believed_from: float
    ) -> tuple[Classification, ...]:
        """What a classified scene may be as well, where an asker who presumes it is believed."""
        if scene.label is None:
            return ()
        gated = scene.verdict == UNCERTAIN
        if scene.method == "tree" and (gated or not others):
            # A witness may leave no other reading, but it does not settle what the tree doubts.
            shares = self.tree.probability(scene.vector)
            others = [
                Other(label, share, scene.vector, scene.features)
                for label, share in sorted(shares.items(), key=lambda item: -item[1])
                if label != scene.label and share >= believed_from
            ]
        found = []
        for other in others:
            decision = self.known.reasoner.decide(other.vector)
            known = decision.label == other.label and not gated
            found.append(
                replace(
                    scene,
                    label=other.label,
                    method="knowledge" if known else "tree",
                    vector=other.vector,
                    features=other.features,
                    verdict=scene.verdict if gated else decision.verdict.value,
                    probability=other.probability,
                )
            )
        return tuple(found)


def below_gate(reading: Reading, gate: float | None) -> bool:
    """Whether some network is less sure of a picture than a gate demands."""
    return gate is not None and any(
        feature.certainty < gate for feature in reading.features.values()
    )
