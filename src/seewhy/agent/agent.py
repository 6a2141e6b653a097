"""Agent: a picture becomes features, features a class, a question an answer with its reasons."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.agent.class_shares import with_class_shares
from seewhy.agent.consistent_reading import (
    READINGS,
    UNWEIGHTED,
    ConsistentReading,
    Other,
    Reading,
    ReadingRule,
    ReadingWeights,
    fit_reading_weights,
    open_vectors,
    read_separately,
    reading_rule,
)
from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import answer_templates
from seewhy.dialogue.answering import Answering
from seewhy.dialogue.question import Question, Questions
from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import Experience, ReferenceAnswers, experience_of
from seewhy.dialogue.reply import UNCERTAIN, UNKNOWN, Classification, FeatureReading, Reply
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError, DomainError, KnowledgeError, ModelError, NotFittedError
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn, learned_text, parse_learned
from seewhy.knowledge.occurrence import Occurrence
from seewhy.knowledge.reasoner import Minimality, Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.backbones import NONE, require_backbone
from seewhy.perception.conformal_threshold import KNOWN_SHARE, refusal_threshold
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from PIL import Image

    from seewhy.agent.fitting import Taught
    from seewhy.agent.learning_from_pictures import Learning
    from seewhy.agent.pretraining import Pretrained
    from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
    from seewhy.induction.learning import LearningOptions
    from seewhy.perception.extractor import FeatureExtractor, Seen
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.familiarity import Familiarity, NearPicture
    from seewhy.perception.where import Where

    Picture = Path | str | Image.Image | np.ndarray[Any, Any]

Progress = Callable[[Any], None]


class Agent:
    """Answers questions about pictures of one domain and says why.

    Use it when you have a domain folder and some annotated pictures. The networks see, the
    knowledge reasons; what the knowledge leaves open, and only that, trains a decision tree (for
    the class) and a recurrent network (for the answers).

    Parameters
    ----------
    domain : Domain
        As its folder says it. What was learned is added and what is set aside is left out:
        ``agent.domain`` is what is reasoned with, ``agent.given`` what the folder says.
    minimality : {"cardinality", "inclusion"}
        Which exceptions to defaults are preferred; see
        :class:`~seewhy.knowledge.reasoner.Reasoner`.
    seed : int
        Two agents with the same seed and data agree, on processors with the same instruction set.
    eyes : str, optional
        The backbone that sees, see :mod:`seewhy.perception.backbones`; ``"none"``: networks that
        grow on the domain's pictures alone, as in the paper. Where left out,
        what the domain says (:meth:`~seewhy.domain.domain.Domain.eyes_after`).
    device : {"auto", "cpu", "cuda", "mps"}, default "auto"
        Where eyes compute: on a graphics processor where there is one. Networks that grow take CUDA
        where there is one, whatever is said.
    reading : {"argmax", "consistent", "with_class"}, optional
        How the features of a picture are read: each its most probable value, as in the paper,
        together the most probable vector that fits what is known
        (:class:`~seewhy.agent.consistent_reading.ConsistentReading`), or that with the class, seen
        by itself, as one more witness. What the domain says where left out; else
        ``"with_class"``, and ``"argmax"`` without eyes.
    gate : float, optional
        Scenes of which some network is less sure than this (0 to 1) are classified by the tree,
        whatever the knowledge says of them, and also train it: the paper's threshold on the
        confidence of extraction. None or 0: the knowledge is always asked first.
    known_share : float, optional
        Below 1: the share of pictures like those of training that is answered; of pictures less
        like them the agent says that it does not know them (see
        :mod:`seewhy.perception.conformal_threshold` and
        :class:`~seewhy.perception.familiarity.Familiarity`). 1 answers every picture. What the
        domain says where left out; else 0.995, and 1 without eyes.
    trust : float, default 0.9
        How often who asks is taken to be right about what a question presumes ("why is it
        unstable?"). Where the picture is not taken to be so, but it is more probable that it is
        than that who asks is wrong, the answer supposes it, and says so. 0: never.
    learned : sequence of Axiom, optional
        Axioms that were learned before.
    withdrawn : sequence of Withdrawn, optional
        Axioms that are known no more; given ones among them are set aside.

    Raises
    ------
    DomainError
        If an option is none of those, or out of its range.

    Source: Riley and Sridharan (2019), figure 1 and section 3. Departures are listed in
    docs/departures.md.

    Examples
    --------
    >>> import seewhy
    >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
    >>> agent.decide({"num_blocks": "4", "base": "wide", "lean": "no", "block_displaced": "yes"})
    'unstable'
    """

    def __init__(
        self,
        domain: Domain,
        *,
        minimality: Minimality = "cardinality",
        seed: int = 0,
        eyes: str | None = None,
        device: str = "auto",
        reading: str | None = None,
        gate: float | None = None,
        known_share: float | None = None,
        trust: float = 0.9,
        learned: Sequence[Axiom] = (),
        withdrawn: Sequence[Withdrawn] = (),
    ) -> None:
        self.given = domain
        self.seed = seed
        self.eyes = domain.eyes_after(domain.pictures.drawn) if eyes is None else eyes
        require_backbone(self.eyes)
        self.device = device
        grown = self.eyes == NONE
        self.reading = reading_rule(
            reading or domain.reading or ("argmax" if grown else "with_class")
        )
        self.gate = gate or None
        shares = (known_share, domain.known_share, 1.0 if grown else KNOWN_SHARE)
        self.known_share = next(share for share in shares if share is not None)
        self.trust = trust
        self._check_options()
        self.minimality: Minimality = minimality
        self.questions = Questions(domain)
        answer_templates(domain)  # a wrong template is found here, not after the training
        self.withdrawn = tuple(withdrawn)
        self._experience: Experience = {}
        self._know(learned)
        self.tree = DecisionTree({key: f.values for key, f in domain.features.items()})
        self.extractor: FeatureExtractor | Eyes | None = None
        self.reading_weights: dict[ReadingRule, ReadingWeights] = {}
        self.answerer: RecurrentAnswerer | None = None
        self.trained_on: frozenset[str] = frozenset()
        self.without_class: frozenset[str] = frozenset()
        self.without: tuple[str, ...] = ()
        self.familiarity: Familiarity | None = None
        self.validation_scores: dict[ReadingRule, list[float]] = {}

    def _check_options(self) -> None:
        if self.gate is not None and not 0.0 < self.gate <= 1.0:
            raise DomainError(f"gate must be 0 to 1, got {self.gate!r}")
        if not 0.0 < self.known_share <= 1.0:
            raise DomainError(f"known_share must be above 0, at most 1, got {self.known_share!r}")
        if not 0.0 <= self.trust < 1.0:
            raise DomainError(f"trust must be at least 0, below 1, got {self.trust!r}")

    def _know(self, learned: Sequence[Axiom]) -> None:
        """Reason with what is given, but for what is set aside, and with these axioms."""
        aside = {own.statement for own in self.withdrawn if own.given}
        text = learned_text(learned)
        signature = self.given.knowledge.signature
        self.learned = parse_learned(text, signature) if learned else ()
        given = (own for own in self.given.knowledge.axioms if str(own) not in aside)
        axioms = (*given, *self.learned)
        self.domain = replace(self.given, knowledge=replace(self.given.knowledge, axioms=axioms))
        self.reasoner = Reasoner(
            self.domain.knowledge, self.domain.schema, minimality=self.minimality
        )
        self._remember(self.experience)

    @property
    def experience(self) -> Experience:
        """How often each feature vector was annotated with each class."""
        return self._experience

    @experience.setter
    def experience(self, experience: Experience) -> None:
        self._remember(experience)

    def _remember(self, experience: Experience) -> None:
        """Read and answer as the annotated scenes suggest, too."""
        self._experience = experience
        counts = {vector: sum(own.values()) for vector, own in experience.items()}
        self.reasoned = ReasonedAnswers(self.domain, self.reasoner, Occurrence(counts))
        self._readers: dict[ReadingRule, ConsistentReading] = {}

    # Training -------------------------------------------------------------------------------

    def fit(
        self,
        dataset: Dataset,
        *,
        without: Sequence[str] = (),
        start_from: Agent | Pretrained | None = None,
        drawn: int | None = None,
        answers: bool = True,
        reference: ReferenceAnswers | None = None,
        workers: int = -1,
        checkpoints: Path | None = None,
        on_picture: Callable[[int], None] | None = None,
        on_progress: Progress | None = None,
    ) -> Agent:
        """Train on the scenes of a dataset (those with split "train", where there are splits).

        Pictures without a class teach what the networks of features see, and nothing else.

        Parameters
        ----------
        dataset : Dataset
        without : sequence of str
            Classes whose pictures are left out. What the knowledge says of them stays, so that
            they can be recognised all the same.
        start_from : Agent or Pretrained, optional
            Fine-tune this agent's networks instead of growing new ones, or those that
            :func:`seewhy.agent.pretraining.pretrained` trained on drawings.
        drawn : int, optional
            Before, the networks are trained on so many pictures that the domain's source draws:
            photographs then refine what they know. As many as the domain says where left out; none
            where the dataset was drawn itself or ``start_from`` is given.
        answers : bool, default True
            False leaves the recurrent network out, where only classes are of interest.
        reference : ReferenceAnswers, optional
            Whose answers to learn; see :meth:`fit_induction`.
        workers : int, default -1
            Features trained at the same time; -1: one a core. The weights do not depend on it.
        checkpoints : Path, optional
            A folder in which an interrupted training finds where it was.
        on_picture : callable, optional
            Called with the number of pictures drawn so far.
        on_progress : callable, optional
            Called with a :class:`~seewhy.perception.training.TrainingEvent` after every epoch.

        Raises
        ------
        DatasetError
            If the dataset is of another domain or of one class only, if no picture has a value of
            some feature, if a class to leave out is none of the domain's, or if there are both
            networks to start from and pictures to draw.
        """
        from seewhy.agent.fitting import grown_networks, taught_eyes
        from seewhy.perception.device import device_of

        self._require_own(dataset)
        scenes = dataset.of_split("train").without_classes(without)
        scenes.require_two_classes()
        scenes.require_feature_labels()
        scenes = scenes.annotated()
        if drawn and start_from is not None:
            raise DatasetError(
                "start_from, drawn: networks begin with what they know (--from) or with new "
                "drawings (--drawn); leave one of the two out"
            )
        first = self._drawings(
            dataset,
            start_from,
            drawn,
            without=without,
            workers=workers,
            checkpoints=checkpoints,
            on_picture=on_picture,
            on_progress=on_progress,
        )
        earlier = first or start_from
        if self.eyes == NONE:
            device_of(self.device)  # networks take CUDA where there is one; none that is not there
            taught = grown_networks(
                scenes,
                with_class=self.reading == "with_class",
                judged=self.known_share < 1.0,
                start_from=earlier,
                seed=self.seed,
                checkpoints=checkpoints,
                workers=workers,
                on_progress=on_progress,
            )
        else:
            taught = taught_eyes(
                scenes,
                backbone=self.eyes,
                device=self.device,
                start_from=earlier,
                seed=self.seed,
                checkpoints=checkpoints,
                on_progress=on_progress,
            )
        self.extractor = taught.extractor
        classed = scenes.with_class()
        with_label = [n for n, label in enumerate(scenes.labels) if label is not None]
        self.trained_on = frozenset(scenes.picture_digests())
        self.without_class = self.trained_on - frozenset(classed.picture_digests())
        self.without = tuple(dict.fromkeys(without))
        self.reading_weights = {}
        # Drawings show all classes alike; a few photographs leave most of them out.
        self.fit_induction(
            [*classed.vectors, *(first.vectors if first else ())],
            [*classed.classes, *(first.labels if first else ())],
            uncertain=self._uncertain(taught.seen.of(np.array(with_label, dtype=np.int64))),
            answers=answers,
            reference=reference,
        )
        self._weigh_reading(taught, scenes.labels)
        self._get_familiar(taught)
        return self

    def _drawings(
        self,
        dataset: Dataset,
        start_from: Agent | Pretrained | None,
        drawn: int | None,
        **options: Any,
    ) -> Pretrained | None:
        """Networks that know drawings, where there are to be any."""
        from seewhy.agent.pretraining import Pretrained, is_drawn, pretrained

        if start_from is not None:
            return start_from if isinstance(start_from, Pretrained) else None
        if drawn is None:
            drawn = 0 if is_drawn(dataset) else self.domain.pictures.drawn
        if not drawn:
            return None
        return pretrained(
            self.domain,
            eyes=self.eyes,
            device=self.device,
            count=drawn,
            seed=self.seed,
            with_class=self.reading == "with_class",
            **options,
        )

    def _weigh_reading(self, taught: Taught, labels: Sequence[str | None]) -> None:
        """Weigh what is seen by pictures that taught it nothing, for both consistent readings."""
        self.reading_weights = {}
        held = taught.held_out
        if held is None or not len(held.rows):
            return
        for rule in READINGS:
            if rule != "argmax":
                self.reading_weights[rule] = fit_reading_weights(
                    self._reader(rule), held.probabilities, [labels[n] for n in held.rows]
                )
        self._readers = {}

    def _get_familiar(self, taught: Taught) -> None:
        """Keep what is made of training pictures, and how like those others are."""
        self.familiarity, self.validation_scores = taught.familiarity, {}
        if taught.scores is not None:
            self.validation_scores = dict.fromkeys(READINGS, taught.scores)
        elif taught.judged is not None:
            for rule in READINGS:
                if rule == "with_class" and CLASS not in taught.judged.probabilities:
                    continue
                readings = self._read(taught.judged.probabilities, rule)
                self.validation_scores[rule] = self._scores(taught.judged, readings)

    def fit_induction(
        self,
        vectors: Sequence[FeatureVector],
        labels: Sequence[str],
        *,
        uncertain: Sequence[int] = (),
        answers: bool = True,
        reference: ReferenceAnswers | None = None,
    ) -> Agent:
        """Train the tree, and with ``answers`` the recurrent network, on what is left open.

        Only scenes whose annotated features the knowledge does not decide, or decides wrongly,
        are used (section 3.3 of the paper), and those at the positions ``uncertain``. The answers
        to learn are those of ``reference``; without it, those that follow from what is known.
        """
        from seewhy.dialogue.learned import fit_learned_answers

        self.experience = experience_of(vectors, labels)
        decisions = self.reasoner.decide_all(vectors)
        more = frozenset(uncertain)
        left = [n for n, own in enumerate(decisions) if own.label != labels[n] or n in more]
        left_vectors, left_labels = [vectors[n] for n in left], [labels[n] for n in left]
        self.tree.fit(left_vectors, left_labels, seed=self.seed)
        self.answerer = None
        if left and answers:
            self.answerer = fit_learned_answers(
                self.domain,
                self.questions,
                reference or self.reference,
                left_vectors,
                left_labels,
                seed=self.seed,
            )
        return self

    def learn(
        self,
        dataset: Dataset,
        *,
        options: LearningOptions | None = None,
        accept: Callable[[Sequence[Axiom]], Sequence[Axiom]] | None = None,
        set_aside: Callable[[Sequence[Withdrawn]], Sequence[Withdrawn]] | None = None,
        answers: bool = True,
    ) -> Learning:
        """Learn axioms from annotated pictures, and reason with them from now on.

        The pictures seen before count too. Axioms learned earlier that the pictures contradict
        are withdrawn, as are those that a more general new one makes needless. What the knowledge
        still leaves open trains the tree and the recurrent network again; the networks that see
        are not touched.

        Parameters
        ----------
        dataset : Dataset
            Of its splits, "train" is used.
        options : LearningOptions, optional
            How much evidence an axiom needs; the defaults where left out.
        accept : callable, optional
            Called with the axioms found; returns those to add. All are added without it.
        set_aside : callable, optional
            Called, before anything is learned, with the given axioms that the pictures refute
            (:func:`seewhy.agent.refutation.refuted`), if there are any; returns those to set aside.
            All are without it.
        answers : bool, default True
            False leaves the recurrent network out.

        Returns
        -------
        Learning
            What was found, added and withdrawn, and the judgement of every candidate.

        Raises
        ------
        DatasetError
            If the dataset is of another domain, or there is one class only.
        """
        from seewhy.agent.learning_from_pictures import (
            Learning,
            axioms_of,
            contradicted,
            learn_for_domain,
            scenes_of,
            superseded,
        )
        from seewhy.agent.refutation import refuted
        from seewhy.induction.learning import DEFAULTS

        options = DEFAULTS if options is None else options
        self._require_own(dataset)
        train = dataset.of_split("train")
        counted = self.trained_on - self.without_class
        scenes = scenes_of(train, self.experience, counted)
        if len(set(scenes.labels)) < 2:
            train.require_two_classes()
        before = len(self.withdrawn)
        gone = contradicted(
            self.given,
            self.learned,
            scenes,
            tolerance=options.tolerance,
            minimality=self.minimality,
        )
        kept = [own for own in self.learned if own not in [axiom for axiom, _ in gone]]
        wrong = [own for _, own in refuted(self.domain, scenes, tolerance=options.tolerance)]
        aside = tuple(wrong if set_aside is None or not wrong else set_aside(wrong))
        self.withdrawn = (*self.withdrawn, *(own for _, own in gone), *aside)
        self._know(kept)
        learned = learn_for_domain(self.domain, scenes, minimality=self.minimality, options=options)
        found = axioms_of(self.domain, [own.candidate for own in learned.accepted], scenes)
        chosen = tuple(found if accept is None else accept(found))
        narrow = superseded(kept, chosen)
        kept = [own for own in kept if own not in [axiom for axiom, _ in narrow]]
        self.withdrawn = (*self.withdrawn, *(own for _, own in narrow))
        self._know([*kept, *chosen])
        learned_from = frozenset(train.with_class().picture_digests())
        self.trained_on |= learned_from
        self.without_class -= learned_from
        self.fit_induction(scenes.vectors, scenes.labels, answers=answers)
        return Learning(
            found,
            self.learned[len(kept) :],
            self.withdrawn[before:],
            learned.judgements,
            learned.tree,
            learned.accepted_leaves,
        )

    def withdraw(self, identifier: str, *, reason: str = "a person withdrew it") -> Withdrawn:
        """Know a learned axiom no more; the tree and the answers are trained again without it.

        Raises
        ------
        KnowledgeError
            If no learned axiom has this identifier.
        """
        axiom = next((own for own in self.learned if own.identifier == identifier), None)
        if axiom is None:
            names = [own.identifier for own in self.learned]
            raise KnowledgeError(
                f"'{identifier}' is no learned axiom; {did_you_mean(identifier, names)}"
                if names
                else f"'{identifier}' is no learned axiom: none was learned"
            )
        gone = Withdrawn(str(axiom), reason)
        self.withdrawn = (*self.withdrawn, gone)
        self._know([own for own in self.learned if own is not axiom])
        from seewhy.agent.learning_from_pictures import AnnotatedScenes

        scenes = AnnotatedScenes.of_experience(self.experience)
        self.fit_induction(scenes.vectors, scenes.labels, answers=self.answerer is not None)
        return gone

    def restore(self, identifier: str) -> Axiom:
        """Know a given axiom again that was set aside.

        Raises
        ------
        KnowledgeError
            If no axiom with this identifier is set aside.
        """
        aside = {own.statement for own in self.withdrawn if own.given}
        candidates = {
            own.identifier: own for own in self.given.knowledge.axioms if str(own) in aside
        }
        if identifier not in candidates:
            raise KnowledgeError(
                f"'{identifier}' is not set aside; {did_you_mean(identifier, list(candidates))}"
                if candidates
                else f"'{identifier}' is not set aside: no given axiom is"
            )
        axiom = candidates[identifier]
        self.withdrawn = tuple(
            own for own in self.withdrawn if not (own.given and own.statement == str(axiom))
        )
        self._know(self.learned)
        from seewhy.agent.learning_from_pictures import AnnotatedScenes

        scenes = AnnotatedScenes.of_experience(self.experience)
        self.fit_induction(scenes.vectors, scenes.labels, answers=self.answerer is not None)
        return axiom

    def _require_own(self, dataset: Dataset) -> None:
        if dataset.domain.name != self.domain.name:
            raise DatasetError(
                f"{dataset.folder}: the dataset is of the domain '{dataset.domain.name}', the "
                f"agent of '{self.domain.name}'; load it with the agent's domain"
            )

    @property
    def reference(self) -> ReferenceAnswers:
        """What correct answers say about annotated scenes."""
        return ReferenceAnswers(self.domain, self.reasoned, self.experience)

    # Seeing ---------------------------------------------------------------------------------

    @property
    def picture_size(self) -> int:
        """The side, in pixels, of the pictures that the trained agent looks at."""
        return self.domain.pictures.size if self.extractor is None else self.extractor.size

    def read(self, pictures: np.ndarray[Any, Any]) -> list[Reading]:
        """Return what the features of pictures are taken to be.

        ``pictures`` is uint8 of shape (scenes, size, size, 3), of :attr:`picture_size`.
        """
        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit, or load a model")
        return self._read(self.extractor.probabilities(pictures), self.reading)

    def _read(
        self, probabilities: Mapping[str, np.ndarray[Any, Any]], rule: ReadingRule
    ) -> list[Reading]:
        if rule == "argmax":
            schema = self.reasoner.schema
            return with_class_shares(
                read_separately(schema, probabilities),
                schema,
                probabilities,
                shares_of_all=self._class_shares_of_all,
                label_of=lambda vector: self._decide(vector)[0],
                other_from=self._believed_from,
            )
        return self._reader(rule).read(probabilities)

    def _reader(self, rule: ReadingRule) -> ConsistentReading:
        if rule not in self._readers:
            self._readers[rule] = ConsistentReading(
                self.reasoner,
                open_vectors(self.reasoner, self.experience),
                label_of=lambda vector: self._decide(vector)[0],
                shares_of=self._class_shares,
                other_from=self._believed_from,
                witnessed=self._witnessed() if rule == "with_class" else (),
                weights=self.reading_weights.get(rule, UNWEIGHTED),
                outweighs=rule == "with_class" and rule in self.reading_weights,
            )
        return self._readers[rule]

    def _witnessed(self) -> frozenset[str]:
        """The classes that the network of the class was shown."""
        found = self.extractor.shown(CLASS) if self.extractor else frozenset()
        if not found:
            raise NotFittedError(
                "pictures are to be read with the class, but no network sees it; train with "
                "reading='with_class', or read in another way"
            )
        return found

    def _read_and_score(self, pictures: np.ndarray[Any, Any]) -> tuple[list[Reading], list[float]]:
        if self.extractor is None or self.familiarity is None:
            readings = self.read(pictures)
            return readings, [own.score for own in readings]
        seen = self.extractor.see(pictures)
        readings = self._read(seen.probabilities, self.reading)
        return readings, self._scores(seen, readings)

    def _scores(self, seen: Seen, readings: Sequence[Reading]) -> list[float]:
        """How like pictures are to those of training that show the values read."""
        assert self.familiarity is not None
        values = {
            key: [reading.features[key].value for reading in readings]
            if key in self.domain.features
            else [key] * len(readings)
            for key in self.familiarity.known
        }
        embeddings = {key: seen.embeddings[key] for key in values}
        return [float(own) for own in self.familiarity.likeness(embeddings, values)]

    def _uncertain(self, seen: Seen) -> list[int]:
        """The positions of the pictures of which some network is less sure than the gate."""
        if self.gate is None or not self.domain.features:
            return []
        surest = [seen.probabilities[key].max(axis=1) for key in self.domain.features]
        certainty = np.min(surest, axis=0)
        return [int(n) for n in np.flatnonzero(certainty < self.gate)]

    @property
    def unknown_below(self) -> float | None:
        """The score below which a picture is not known; None where every picture is answered."""
        scores = self.validation_scores.get(self.reading, [])
        return refusal_threshold(scores, known_share=self.known_share)

    # Deciding -------------------------------------------------------------------------------

    def decide(self, features: Mapping[str, str | None]) -> str | None:
        """Return the class of named feature values, by knowledge or by the tree."""
        return self._decide(self.domain.vector(features))[0]

    def _decide(self, vector: FeatureVector) -> tuple[str | None, str, Verdict]:
        return self._decide_all([vector])[vector]

    def _decide_all(
        self, vectors: Sequence[FeatureVector]
    ) -> dict[FeatureVector, tuple[str | None, str, Verdict]]:
        """The class of every feature vector, the method, and what the knowledge says."""
        decisions = dict(zip(vectors, self.reasoner.decide_all(vectors), strict=True))
        left = [vector for vector, own in decisions.items() if own.label is None]
        by_tree: dict[FeatureVector, str] = {}
        if left and self.tree.fitted:
            by_tree = dict(zip(left, self.tree.classify_all(left), strict=True))
        return {
            vector: (own.label, "knowledge", own.verdict)
            if own.label is not None
            else (by_tree.get(vector), "tree" if vector in by_tree else "none", own.verdict)
            for vector, own in decisions.items()
        }

    def classify(self, image: Picture) -> Classification:
        """Classify one picture (a path, a Pillow image or an array)."""
        from seewhy.perception.picture import as_picture

        pixels = as_picture(image, size=self.picture_size, fit=self.domain.pictures.fit)
        return self.classify_all(pixels[None])[0]

    def classify_values(self, features: Mapping[str, str]) -> Classification:
        """Classify what is said to be shown instead of seen, as if it were sure.

        ``features`` are named values; those left out are not known.

        Examples
        --------
        >>> import seewhy
        >>> agent = seewhy.Agent(seewhy.load_domain("structure_stability"))
        >>> agent.classify_values({"block_displaced": "yes"}).label
        'unstable'
        """
        vector = self.domain.vector(features)
        label, method, verdict = self._decide(vector)
        told = {key: FeatureReading(value, 1.0) for key, value in features.items()}
        ordered = {key: told[key] for key in self.domain.features if key in told}
        return Classification(label, method, vector, ordered, verdict.value, told=True)

    def classify_all(self, pictures: np.ndarray[Any, Any]) -> list[Classification]:
        """Classify pictures, uint8 of shape (scenes, size, size, 3), of :attr:`picture_size`."""
        readings, scores = self._read_and_score(pictures)
        decided = self._decide_all([own.vector for own in readings])
        uncertain = [own.vector for own in readings if self._below_gate(own)]
        by_tree: dict[FeatureVector, str] = {}
        if uncertain and self.tree.fitted:
            by_tree = dict(zip(uncertain, self.tree.classify_all(uncertain), strict=True))
        unknown_below = self.unknown_below
        found: list[Classification] = []
        for own, score in zip(readings, scores, strict=True):
            label, method, verdict = decided[own.vector]
            said, probability = verdict.value, own.probability if label is not None else None
            if unknown_below is not None and score < unknown_below:
                label, method, said, probability = None, "none", UNKNOWN, None
            elif by_tree and self._below_gate(own):
                label, method, said, probability = by_tree[own.vector], "tree", UNCERTAIN, None
            elif method == "tree" and own.leaning is not None:
                label = own.leaning
            scene = Classification(
                label,
                method,
                own.vector,
                own.features,
                said,
                probability,
                score,
                own.class_seen,
            )
            found.append(replace(scene, otherwise=self._otherwise(scene, own.others)))
        return found

    def nearest(self, image: Picture, *, count: int = 3) -> tuple[NearPicture, ...]:
        """Return the pictures of training that are most like one, the most alike first.

        Parameters
        ----------
        image : path, Pillow image or array
        count : int, default 3
            At most so many.

        Returns
        -------
        tuple of NearPicture
            Each with its likeness, 0 to 1, and what was annotated of it. None where networks grew
            on the domain's pictures alone: each makes something of its own of a picture.

        Raises
        ------
        NotFittedError, PictureError, DatasetError
            If the agent is not trained; if the image is no picture; if ``count`` is below 1.
        """
        from seewhy.perception.eyes import SCENE

        if count < 1:
            raise DatasetError(f"count: at least 1 picture has to be asked for, got {count}")
        extractor, pixels = self._looks_at(image)
        known = self.familiarity.known.get(SCENE) if self.familiarity else None
        if known is None or not known.pictures:
            return ()
        return known.nearest(extractor.see(pixels).embeddings[SCENE][0], count=count)

    def where(self, image: Picture, *, scene: Classification | None = None) -> dict[str, Where]:
        """Return where in a picture each feature is seen, and the class where that has a say.

        Parameters
        ----------
        image : path, Pillow image or array
        scene : Classification, optional
            What the picture is taken to be, as an answer has it; it is classified where left out.

        Returns
        -------
        dict of str to Where
            By feature, and "class"; see :func:`seewhy.perception.where.find_where`.

        Raises
        ------
        NotFittedError, PictureError
            If the agent is not trained; if the image is no picture.
        """
        from seewhy.perception.where import find_where

        extractor, pixels = self._looks_at(image)
        scene = self.classify_all(pixels[None])[0] if scene is None else scene
        values = {name: reading.value for name, reading in scene.features.items()}
        if scene.class_seen is not None:
            values[CLASS] = scene.class_seen[0]
        return find_where(extractor, pixels, values)

    def _looks_at(self, image: Picture) -> tuple[FeatureExtractor | Eyes, np.ndarray[Any, Any]]:
        """What sees, and an image as it sees it."""
        from seewhy.perception.picture import as_picture

        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit, or load a model")
        fit = self.domain.pictures.fit
        return self.extractor, as_picture(image, size=self.picture_size, fit=fit)

    @property
    def _believed_from(self) -> float:
        """How probable a class has to be for who presumes it to be believed.

        As probable as that who asks is wrong and names this class of all that the picture is not,
        which are named alike: with two classes 0.1 where nine in ten are right, with more less.
        """
        wrong = (1.0 - self.trust) / max(1, len(self.domain.classes) - 1)
        return wrong / (wrong + self.trust)

    def _class_shares(self, vector: FeatureVector) -> dict[str, float]:
        """The classes of a scene of some features, with the probability of each."""
        decision = self.reasoner.decide(vector)
        if decision.label is not None:
            return {decision.label: 1.0}
        return self.tree.probability(vector) if self.tree.fitted else {}

    def _class_shares_of_all(self, vectors: Sequence[FeatureVector]) -> list[dict[str, float]]:
        self.reasoner.decide_all(vectors)  # remembers them; at once is much faster
        return [self._class_shares(vector) for vector in vectors]

    def _otherwise(
        self, scene: Classification, others: Sequence[Other]
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
                for label, share in sorted(shares.items(), key=lambda own: -own[1])
                if label != scene.label and share >= self._believed_from
            ]
        found = []
        for own in others:
            decision = self.reasoner.decide(own.vector)
            known = decision.label == own.label and not gated
            found.append(
                replace(
                    scene,
                    label=own.label,
                    method="knowledge" if known else "tree",
                    vector=own.vector,
                    features=own.features,
                    verdict=scene.verdict if gated else decision.verdict.value,
                    probability=own.probability,
                )
            )
        return tuple(found)

    def _below_gate(self, reading: Reading) -> bool:
        gate = self.gate
        return gate is not None and any(own.certainty < gate for own in reading.features.values())

    # Answering ------------------------------------------------------------------------------

    def ask(self, image: Picture, question: str, *, previous: Reply | None = None) -> Reply:
        """Answer a question about a picture.

        Parameters
        ----------
        image : path, Pillow image or array
        question : str
            In plain words, see docs/questions.md; spelling and word forms are forgiven.
        previous : Reply, optional
            The answer before, which "please explain this answer" and "and the base?" are about;
            without it, the classification is explained.

        Raises
        ------
        QuestionError
            If the question is not understood; it names the nearest ones that are.
        PictureError
            If the image is no picture.
        """
        asked = previous.question if previous is not None else None
        understood = self.questions.understand(question, previous=asked)
        return self.answer(self.classify(image), understood, previous=previous, image=image)

    def answer(
        self,
        scene: Classification,
        question: Question,
        *,
        previous: Reply | None = None,
        image: Picture | None = None,
    ) -> Reply:
        """Answer an understood question about a classified scene.

        Raises
        ------
        QuestionError
            If it asks where something is seen or which pictures are similar, and there is no
            ``image``.
        """
        look = None if image is None else _Looking(self, image, scene)
        return self._answering.answer(scene, question, previous=previous, look=look)

    def answer_all(self, asked: Sequence[tuple[Classification, Question]]) -> list[Reply]:
        """Answer many questions about classified scenes; the recurrent network runs once for all.

        The replies are those of :meth:`answer`, one by one.
        """
        return self._answering.answer_all(asked)

    def say_uncertain(self, scene: Classification) -> str:
        """Say of which feature a network is too little sure for the gate."""
        return self._answering.say_uncertain(scene)

    @property
    def only_shown(self) -> dict[str, str]:
        """Of features of which training pictures showed one value only, that value."""
        if self.extractor is None:
            return {}
        shown = {key: self.extractor.shown(key) for key in self.domain.features}
        return {key: next(iter(own)) for key, own in shown.items() if len(own) == 1}

    @property
    def _answering(self) -> Answering:
        """What answers with all that is known and was learned by now."""
        return Answering(
            self.domain,
            self.reasoned,
            self.tree,
            self.answerer,
            self.experience,
            gate=self.gate or 0.0,
            known_share=self.known_share,
            least_likeness=self.unknown_below or 0.0,
            trust=self.trust,
            only_shown=self.only_shown,
        )

    # On disk --------------------------------------------------------------------------------

    def save(self, folder: Path | str) -> None:
        """Write the model to a folder, whole or not at all."""
        from seewhy.agent.model import Model, write_model

        if self.extractor is None:
            raise NotFittedError("the agent is not trained yet; call fit before save")
        model = Model(
            domain=self.given,
            learned=self.learned,
            withdrawn=self.withdrawn,
            extractor=self.extractor,
            tree=self.tree,
            answerer=self.answerer,
            experience=self.experience,
            trained_on=self.trained_on,
            without_class=self.without_class,
            minimality=self.minimality,
            seed=self.seed,
            eyes=self.eyes,
            reading=self.reading,
            reading_weights=self.reading_weights,
            gate=self.gate,
            known_share=self.known_share,
            familiarity=self.familiarity,
            validation_scores=self.validation_scores,
            without=self.without,
        )
        write_model(model, Path(folder))

    @staticmethod
    def load(
        folder: Path | str,
        *,
        device: str = "auto",
        reading: str | None = None,
        gate: float | None = None,
        known_share: float | None = None,
    ) -> Agent:
        """Read a model.

        Parameters
        ----------
        folder : Path or str
        device, reading, gate, known_share : optional
            As for :class:`Agent`, instead of what the model was trained with; a gate of 0 is none.

        Raises
        ------
        ModelError
            If the folder is incomplete, was edited, or was made by another version; or if pictures
            are to be read with a network of the class, and it has none.
        DomainError
            If an option is out of its range.
        """
        from seewhy.agent.model import read_model

        model = read_model(Path(folder), device=device)
        agent = Agent(
            model.domain,
            minimality=model.minimality,
            seed=model.seed,
            eyes=model.eyes,
            device=device,
            reading=model.reading if reading is None else reading,
            gate=model.gate if gate is None else gate,
            known_share=model.known_share if known_share is None else known_share,
            learned=model.learned,
            withdrawn=model.withdrawn,
        )
        if agent.reading == "with_class" and CLASS not in model.extractor.values:
            raise ModelError(
                f"{folder}: the model has no network of the class; train it with --reading "
                "with_class, or read its pictures in another way"
            )
        agent.extractor, agent.tree, agent.answerer = model.extractor, model.tree, model.answerer
        agent.reading_weights = dict(model.reading_weights)
        agent.experience, agent.trained_on = model.experience, model.trained_on
        agent.without_class = model.without_class
        agent.familiarity = model.familiarity
        agent.validation_scores = dict(model.validation_scores)
        agent.without = model.without
        return agent


class _Looking:
    """A picture that an agent can look at again."""

    def __init__(self, agent: Agent, image: Picture, scene: Classification) -> None:
        self._agent, self._image, self._scene = agent, image, scene

    def where(self) -> Mapping[str, Where]:
        return self._agent.where(self._image, scene=self._scene)

    def nearest(self) -> Sequence[NearPicture]:
        return self._agent.nearest(self._image)
