"""Domain: a folder that a user writes, read and checked as a whole."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from seewhy.domain.belief import Belief, read_beliefs
from seewhy.domain.feature import Feature, feature_of_table
from seewhy.domain.folder import FILES, domain_folder
from seewhy.domain.key_place import KeyPlace
from seewhy.domain.question_tables import QuestionsFile
from seewhy.domain.reading_rule import ReadingRule
from seewhy.domain.scene_class import SceneClass, check_literals, class_of_table
from seewhy.domain.tables import EMBEDDED, NONE, DomainFile, NetworkTable, PictureTable
from seewhy.domain.things import Things, read_things
from seewhy.domain.whole_picture import WholePicture
from seewhy.errors import DomainError
from seewhy.files.toml_file import read_toml
from seewhy.knowledge.consistency import check_consistency
from seewhy.knowledge.language import Knowledge, read_knowledge_file
from seewhy.knowledge.learned_file import with_origins
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import schema_with_things
from seewhy.text.nearest import did_you_mean

__all__ = ["Domain", "load_domain"]


@dataclass(frozen=True)
class Domain:
    """Everything that a domain folder says.

    Attributes
    ----------
    name, title, subject : str
        How the domain and its pictures are called ("the structure").
    scene : str
        The sort that stands for the picture; also its name as a term in beliefs.
    features : mapping of str to Feature
        In the order of the file, which is the order of every feature vector.
    classes : mapping of str to SceneClass
    beliefs : mapping of str to Belief
        Every static of the scene and one sort that is no feature.
    knowledge : Knowledge
    questions : QuestionsFile
    pictures : PictureTable
    networks : NetworkTable
    folder : Path
    source : str or None
        The importable module that makes pictures (``draw(seed=, index=, size=)``).
    eyes : str or None
        The backbone that sees, or "none" for networks that grow; None: see :meth:`eyes_after`.
    reading : {"argmax", "consistent", "with_class"} or None
        How the features of a picture are read, see :mod:`seewhy.agent.consistent_reading`; None
        leaves it to what sees.
    known_share : float or None
        The share of pictures like those of training that is answered, see
        :mod:`seewhy.perception.conformal_threshold`; 1 answers every picture, None leaves it to
        what sees.
    things : Things or None
        The things of which a picture may show several. A domain with things may be without
        features and classes of the whole picture.

    Examples
    --------
    >>> domain = load_domain("structure_stability")
    >>> list(domain.features)
    ['num_blocks', 'base', 'lean', 'block_displaced']
    >>> domain.vector({"num_blocks": "2", "lean": "no"})
    ('2', None, 'no', None)
    """

    name: str
    title: str
    subject: str
    scene: str
    features: Mapping[str, Feature]
    classes: Mapping[str, SceneClass]
    beliefs: Mapping[str, Belief]
    knowledge: Knowledge
    questions: QuestionsFile
    pictures: PictureTable
    networks: NetworkTable
    folder: Path
    source: str | None
    eyes: str | None = None
    reading: ReadingRule | None = None
    known_share: float | None = None
    things: Things | None = None

    @cached_property
    def schema(self) -> SceneSchema:
        """How feature vectors and classes stand in the knowledge.

        Where there are things, what is seen of each stands behind the features of the picture.
        """
        schema = SceneSchema(
            scene=self.scene,
            features={key: feature.literals for key, feature in self.features.items()},
            classes={key: scene_class.literal for key, scene_class in self.classes.items()},
            change_costs={key: feature.change_cost for key, feature in self.features.items()},
        )
        if self.things is None:
            return schema
        return schema_with_things(schema, self.knowledge.signature, self.things.seen)

    def with_most_things(self, most: int) -> Domain:
        """Return the domain of pictures that show at most so many things.

        Examples
        --------
        >>> list(load_domain("tabletop").with_most_things(2).schema.presence)
        ['thing1', 'thing2']
        """
        if self.things is None:
            return self
        things = replace(self.things, most=most)
        return replace(self, things=things, knowledge=self.knowledge.with_things(most))

    def eyes_after(self, drawn: int) -> str:
        """Return what sees, where training begins with so many drawings.

        What the folder says. Where it says nothing: networks that grow, where drawings come first,
        which show what few labels do not; a backbone where none do (docs/eyes.md has figures).

        Examples
        --------
        >>> signs = load_domain("traffic_signs")
        >>> signs.eyes_after(9300), signs.eyes_after(0)
        ('none', 'efficientnet-lite0')
        """
        if self.eyes is not None:
            return self.eyes
        return NONE if drawn else EMBEDDED

    def vector(self, values: Mapping[str, str | None]) -> FeatureVector:
        """Return the feature vector of named values; features left out are unknown.

        Things are named as in the schema: ``thing(thing1)`` is "yes" where there is one, and
        those left out are not there.
        """
        return self.schema.vector(values)

    def named(self, vector: FeatureVector) -> dict[str, str | None]:
        """Return feature name → value for a feature vector, as far as the picture as a whole."""
        return dict(zip(self.features, vector[: len(self.features)], strict=True))


def load_domain(name: str | Path) -> Domain:
    """Load a bundled domain by name, or a user's domain by its folder.

    Raises
    ------
    DomainError, KnowledgeError
        If a file of the folder is missing or wrong; the text names file and line.

    Examples
    --------
    >>> load_domain("structure_stability").title
    'Structures of blocks'
    """
    folder = domain_folder(name)
    if (folder / "planning.toml").is_file() and not (folder / "domain.toml").is_file():
        raise DomainError(
            f"{folder}: the folder plans and has no pictures to train on; ask 'seewhy plan "
            f"{folder}', 'seewhy simulate {folder}' or 'seewhy check {folder}'"
        )
    for file in FILES:
        if not (folder / file).is_file():
            raise DomainError(
                f"{folder}: the domain has no {file}; a domain is a folder with "
                f"{', '.join(FILES)} ('seewhy new NAME' writes one)"
            )
    path = folder / "domain.toml"
    table = read_toml(path, DomainFile)
    knowledge = read_knowledge_file(folder / "knowledge.al").without_change
    questions = read_toml(folder / "questions.toml", QuestionsFile)
    place = KeyPlace(path)
    _check_source(table, place)
    _check_parts(table, place)
    _check_scene(table, knowledge, place)
    things = None if table.things is None else read_things(table.things, knowledge, place)
    if things is not None:
        knowledge = _with_origins(knowledge).with_things(things.most)
    features = {
        key: feature_of_table(key, feature_table, table, knowledge, place)
        for key, feature_table in table.features.items()
    }
    classes = {
        key: class_of_table(key, class_table, table, knowledge, place)
        for key, class_table in table.classes.items()
    }
    if things is not None:
        things = replace(things, whole=_whole(table, classes, questions))
    check_literals(classes, place)
    _check_shared_words(classes, features, place)
    of_classes = {scene_class.literal.predicate for scene_class in classes.values()}
    domain = Domain(
        name=table.domain.name,
        title=table.domain.title,
        subject=table.domain.subject,
        scene=table.domain.scene,
        features=MappingProxyType(features),
        classes=MappingProxyType(classes),
        beliefs=MappingProxyType(read_beliefs(table, of_classes, knowledge, place)),
        knowledge=knowledge,
        questions=questions,
        pictures=table.pictures,
        networks=table.networks,
        folder=folder,
        source=table.domain.source,
        eyes=table.domain.eyes,
        reading=table.domain.reading,
        known_share=table.domain.known_share,
        things=things,
    )
    check_consistency(knowledge, domain.schema)
    return domain


def _whole(
    table: DomainFile, classes: Mapping[str, SceneClass], questions: QuestionsFile
) -> WholePicture:
    """The picture as questions about its things may speak of it."""
    subject = table.domain.subject
    nouns = dict.fromkeys((subject.removeprefix("the "), table.domain.scene.replace("_", " ")))
    for noun in tuple(nouns):
        nouns |= dict.fromkeys(questions.synonyms.get(noun, ()))
    return WholePicture(subject, tuple(nouns), MappingProxyType(dict(classes)))


def _with_origins(knowledge: Knowledge) -> Knowledge:
    """The knowledge, with what those of its axioms rest on that were learned.

    Where pictures show one thing, what is learned is kept with the model.
    """
    source = Path(knowledge.file).read_text(encoding="utf-8")
    return replace(knowledge, axioms=with_origins(knowledge.axioms, source))


def _check_source(table: DomainFile, place: KeyPlace) -> None:
    """Refuse a source that lies outside of the domain's folder, but for modules of SeeWhy's own."""
    source = table.domain.source
    if source is None or re.fullmatch(r"seewhy(_lab)?(\.[a-z][a-z0-9_]*)+", source):
        return
    home = place.path.parent.resolve()
    if not source.endswith(".py") or not (home / source).resolve().is_relative_to(home):
        raise DomainError(
            f"{place.at('domain', 'source')}: source = '{source}' must be a file of this folder, "
            'such as "pictures.py": what lies elsewhere is not run'
        )


def _check_parts(table: DomainFile, place: KeyPlace) -> None:
    """Refuse a domain without features or classes, where there are no things."""
    for name, part in (("features", table.features), ("classes", table.classes)):
        if not part and table.things is None:
            raise DomainError(f"{place.at(name)}: '{name}' is missing; add it")


def _check_shared_words(
    classes: Mapping[str, SceneClass], features: Mapping[str, Feature], place: KeyPlace
) -> None:
    """Refuse a word that stands for two classes, or for two values of one feature."""
    spoken: dict[str, str] = {}
    for key, scene_class in classes.items():
        for word in scene_class.words:
            if spoken.setdefault(word.casefold(), key) != key:
                raise DomainError(
                    f"{place.at('classes', key)}: '{word}' stands for '{key}' and for "
                    f"'{spoken[word.casefold()]}'; let it stand for one"
                )
    for name, feature in features.items():
        values: dict[str, str] = {}
        for value, words in feature.words.items():
            for word in words:
                if values.setdefault(word.casefold(), value) != value:
                    raise DomainError(
                        f"{place.at('features', name, 'values', value)}: '{word}' stands for "
                        f"'{value}' and for '{values[word.casefold()]}'; let it stand for one"
                    )


def _check_scene(table: DomainFile, knowledge: Knowledge, place: KeyPlace) -> None:
    sorts = knowledge.signature.sorts
    scene = table.domain.scene
    here = place.at("domain", "scene")
    if scene not in sorts:
        raise DomainError(
            f"{here}: scene = '{scene}' is no sort of knowledge.al; {did_you_mean(scene, sorts)}"
        )
    if sorts[scene].members is not None:
        raise DomainError(
            f"{here}: the sort '{scene}' stands for the picture and must be declared without "
            f"members ('#sort {scene}.'), see {sorts[scene].location}"
        )
    for sort in sorts.values():
        if sort.of_things and table.things is None:
            raise DomainError(
                f"{sort.location}: the sort '{sort.name}' stands for things, of which domain.toml "
                f'says nothing; add [things] with sort = "{sort.name}"'
            )
        if sort.members is None and sort.name != scene and not sort.of_things:
            raise DomainError(
                f"{sort.location}: sort '{sort.name}' has no members; only '{scene}', which "
                "stands for the picture, may be without"
            )
