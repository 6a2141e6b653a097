"""Domain: a folder that a user writes, read and checked as a whole."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from seewhy.domain.belief import Belief, read_beliefs
from seewhy.domain.place import Place
from seewhy.domain.tables import (
    CLASS,
    EMBEDDED,
    NONE,
    RESERVED,
    SCENE,
    TOGETHER,
    ClassTable,
    DomainFile,
    FeatureTable,
    NetworkTable,
    PictureTable,
    QuestionsFile,
    ReadingRule,
)
from seewhy.errors import DomainError, KnowledgeError
from seewhy.files.toml_file import read_toml
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.consistency import check_consistency
from seewhy.knowledge.language import Knowledge, read_knowledge_file, read_literal
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.text.nearest import did_you_mean

FILES = ("domain.toml", "knowledge.al", "questions.toml")


@dataclass(frozen=True)
class Feature:
    """A feature: its values and how they are said.

    ``literals`` gives for every value the literal that is believed when the value is seen.
    """

    key: str
    name: str
    values: tuple[str, ...]
    say: Mapping[str, str]
    words: Mapping[str, tuple[str, ...]]
    change: Mapping[str, str]
    threshold: float
    channels: tuple[int, ...] | None
    dense: int | None
    change_cost: int
    literals: Mapping[str, Literal]


@dataclass(frozen=True)
class SceneClass:
    """A class of scenes: the literal that stands for it and how it is said."""

    key: str
    literal: Literal
    say: str
    words: tuple[str, ...]
    verbs: tuple[str, ...] = ()


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
        Every static of the scene, by itself or with one sort, that is no feature.
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

    @property
    def schema(self) -> SceneSchema:
        """How feature vectors and classes stand in the knowledge."""
        return SceneSchema(
            scene=self.scene,
            features={key: feature.literals for key, feature in self.features.items()},
            classes={key: scene_class.literal for key, scene_class in self.classes.items()},
            change_costs={key: feature.change_cost for key, feature in self.features.items()},
        )

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
        """Return the feature vector of named values; features left out are unknown."""
        return tuple(values.get(key) for key in self.features)

    def named(self, vector: FeatureVector) -> dict[str, str | None]:
        """Return feature name → value for a feature vector."""
        return dict(zip(self.features, vector, strict=True))


def bundled_domains() -> tuple[str, ...]:
    """Return the names of the domains that come with SeeWhy.

    Examples
    --------
    >>> "structure_stability" in bundled_domains()
    True
    """
    home = Path(__file__).parents[1] / "domains"
    return tuple(sorted(file.parent.name for file in home.glob("*/domain.toml")))


def domain_folder(name: str | Path) -> Path:
    """Return the folder of a bundled domain's name or of a path to a user's folder.

    Raises
    ------
    DomainError
        If there is neither; the text gives the nearest bundled name.
    """
    path = Path(name)
    if path.is_dir():
        return path
    if str(name) in bundled_domains():
        return Path(__file__).parents[1] / "domains" / str(name)
    if (Path(__file__).parents[1] / "domains" / str(name) / "planning.toml").is_file():
        raise DomainError(
            f"'{name}' is a domain that plans and has no pictures to train on; ask 'seewhy plan "
            f"{name}', 'seewhy simulate {name}' or 'seewhy check {name}'"
        )
    raise DomainError(
        f"'{name}' is neither a folder nor a bundled domain; "
        f"{did_you_mean(str(name), bundled_domains())}"
    )


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
    place = Place(path)
    _check_source(table, place)
    _check_scene(table, knowledge, place)
    features = {
        key: _feature(key, feature_table, table, knowledge, place)
        for key, feature_table in table.features.items()
    }
    classes = {
        key: _class(key, class_table, table, knowledge, place)
        for key, class_table in table.classes.items()
    }
    _check_classes(classes, place)
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
    )
    check_consistency(knowledge, domain.schema)
    return domain


def _check_source(table: DomainFile, place: Place) -> None:
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


def _check_shared_words(
    classes: Mapping[str, SceneClass], features: Mapping[str, Feature], place: Place
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


def _check_scene(table: DomainFile, knowledge: Knowledge, place: Place) -> None:
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
        if sort.members is None and sort.name != scene:
            raise DomainError(
                f"{sort.location}: sort '{sort.name}' has no members; only '{scene}', which "
                "stands for the picture, may be without"
            )


def _feature(
    key: str, table: FeatureTable, file: DomainFile, knowledge: Knowledge, place: Place
) -> Feature:
    predicate = knowledge.signature.predicates.get(key)

    def here() -> str:
        return place.at("features", key)

    scene = file.domain.scene
    if key in (CLASS, TOGETHER):
        raise DomainError(
            f"{here()}: '{key}' is what other networks than a feature's are called; call the "
            "feature otherwise"
        )
    if key == SCENE or key in file.classes:
        raise DomainError(
            f"{here()}: '{key}' is what "
            f"{'a whole picture' if key == SCENE else 'a class of this domain'} is called; call "
            "the feature otherwise"
        )
    if key in RESERVED:
        raise DomainError(
            f"{here()}: '{key}' is what another column of scenes.csv is called; call the feature "
            "otherwise"
        )
    if predicate is None:
        raise DomainError(
            f"{here()}: the feature '{key}' is not declared in knowledge.al; "
            f"{did_you_mean(key, knowledge.signature.predicates)}"
        )
    if not predicate.sorts or predicate.sorts[0] != scene or len(predicate.sorts) > 2:
        raise DomainError(
            f"{here()}: the feature '{key}' must be declared as '#static {key}({scene}).' (yes or "
            f"no) or '#static {key}({scene}, SORT).', got '{predicate}' "
            f"({predicate.location})"
        )
    if len(predicate.sorts) == 1:
        literals = {
            "yes": Literal(predicate=key, arguments=(scene,)),
            "no": Literal(predicate=key, arguments=(scene,), positive=False),
        }
    else:
        literals = {
            value: Literal(predicate=key, arguments=(scene, value))
            for value in knowledge.signature.members(predicate.sorts[1])
        }
    for value in table.values:
        if value not in literals:
            raise DomainError(
                f"{place.at('features', key, 'values', value)}: '{value}' is no value of "
                f"'{key}' in knowledge.al; {did_you_mean(value, literals)}"
            )
    for value in literals:
        if value not in table.values:
            raise DomainError(
                f"{here()}: nothing says how '{key}' = '{value}' is said; add "
                f'[features.{key}.values.{value}] with say = "…"'
            )
    tables = {value: table.values[value] for value in literals}
    return Feature(
        key=key,
        name=table.name,
        values=tuple(literals),
        say=MappingProxyType({value: value_table.say for value, value_table in tables.items()}),
        words=MappingProxyType(
            {value: (*value_table.words, value) for value, value_table in tables.items()}
        ),
        change=MappingProxyType(
            {
                value: value_table.change
                for value, value_table in tables.items()
                if value_table.change
            }
        ),
        threshold=table.threshold,
        channels=table.channels,
        dense=table.dense,
        change_cost=table.change_cost,
        literals=MappingProxyType(literals),
    )


def _check_classes(classes: Mapping[str, SceneClass], place: Place) -> None:
    keys: dict[Literal, str] = {}
    for key, scene_class in classes.items():
        first = keys.setdefault(scene_class.literal, key)
        if first != key:
            raise DomainError(
                f"{place.at('classes', key, 'literal')}: the literal '{scene_class.literal}' "
                f"stands for the classes '{first}' and '{key}'; no scene could be one of them and "
                "not the other, give each class a literal of its own"
            )


def _class(
    key: str, table: ClassTable, file: DomainFile, knowledge: Knowledge, place: Place
) -> SceneClass:
    def here() -> str:
        # Finding a line reads the file anew: only where there is something to say about it.
        return place.at("classes", key, "literal")

    scene = file.domain.scene
    try:
        literal = read_literal(table.literal)
    except KnowledgeError as problem:
        raise DomainError(f"{here()}: {problem}") from None
    predicates = knowledge.signature.predicates
    if literal.predicate not in predicates:
        raise DomainError(
            f"{here()}: the literal '{literal}' of class '{key}' uses '{literal.predicate}', which "
            f"knowledge.al does not declare; {did_you_mean(literal.predicate, predicates)}"
        )
    sorts = predicates[literal.predicate].sorts
    if len(sorts) != len(literal.arguments):
        raise DomainError(
            f"{here()}: '{literal.predicate}' takes {len(sorts)} "
            f"argument{'s' * (len(sorts) != 1)}, got '{literal}'"
        )
    arguments = []
    for argument, sort in zip(literal.arguments, sorts, strict=True):
        members = (scene,) if sort == scene else knowledge.signature.members(sort)
        term = scene if sort == scene and argument[0].isupper() else argument
        if term not in members:
            raise DomainError(
                f"{here()}: '{argument}' is not of sort '{sort}' in the literal '{literal}'; "
                f"{did_you_mean(argument, members)}"
            )
        arguments.append(term)
    return SceneClass(
        key=key,
        literal=Literal(
            predicate=literal.predicate, arguments=tuple(arguments), positive=literal.positive
        ),
        say=table.say,
        words=table.words or (table.say,),
        verbs=table.verbs,
    )
