"""PlanningDomain: a folder with knowledge about change, read and checked as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import clingo

from seewhy.data.thing_scene import ThingScene
from seewhy.domain.folder import domain_folder
from seewhy.domain.tables import DomainFile
from seewhy.errors import DomainError, PlanningError
from seewhy.files.toml_file import line_of, read_toml
from seewhy.knowledge.axiom import Axiom, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import fixed_rules
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.history import History, read_history_file
from seewhy.knowledge.language import Knowledge, read_knowledge_file
from seewhy.knowledge.made_changeable import read_changeable_files
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.actors import actor_places
from seewhy.planning.domain_checks import goal_problems_of, picture_problems_of, problems_of
from seewhy.planning.execution.sensing import Sensing, SensingError, read_sensing
from seewhy.planning.tables import GoalTable, MapTable, PlanningFile, SimulationTable
from seewhy.planning.things.initial_scene import SceneOfPlan, thing_clauses, with_scene
from seewhy.planning.things.scene_file import scene_of_plan
from seewhy.planning.words import PlanningWords
from seewhy.text.nearest import did_you_mean, nearest

FILE = "planning.toml"
CHANGE = "planning.al"
"""What may change of what knowledge.al says, and what brings it about; may be missing."""


@dataclass(frozen=True)
class PlanningDomain:
    """Everything that a folder says about planning.

    Attributes
    ----------
    name, title : str
    knowledge : Knowledge
    history : History
        What is known at first: ``history.al`` of the folder, if there is one, and what is seen of
        the things of a picture.
    words : PlanningWords
        How fluents, actions and things are said.
    robot : str or None
        The term that stands for whoever acts.
    horizon : int
        The greatest number of actions that planning tries.
    answer_sets : bool
        Whether answer sets alone are asked for plans, as in the paper.
    sensing, simulation
        What the robot senses, and what may happen, in simulation.
    shows : mapping of str to Sensing
        For features of the folder's domain.toml the fluent whose truth they are, in a picture that
        the robot takes.
    map : MapTable or None
        How to draw where things are.
    folder : Path
    seen_by_networks : bool
        Whether networks read the pictures that the robot takes.
    goals : tuple of GoalTable
        Goals that can be said in words.
    at_first : SceneOfPlan or None
        The things of a picture, where planning is about them.
    seen_at_first : tuple of Literal
        What is seen of them that may change.
    seen_axioms : tuple of Axiom
        What is seen of them that never changes.

    Examples
    --------
    >>> domain = load_planning_domain("robot_assistant")
    >>> domain.title
    'A robot that delivers messages in an office building'
    """

    name: str
    title: str
    knowledge: Knowledge
    history: History
    words: PlanningWords
    robot: str | None
    horizon: int
    answer_sets: bool
    sensing: tuple[Sensing, ...]
    shows: Mapping[str, Sensing]
    simulation: SimulationTable
    map: MapTable | None
    folder: Path
    seen_by_networks: bool = False
    goals: tuple[GoalTable, ...] = ()
    at_first: SceneOfPlan | None = None
    seen_at_first: tuple[Literal, ...] = ()
    seen_axioms: tuple[Axiom, ...] = ()

    @property
    def sensors_err(self) -> bool:
        """Whether what is sensed may be wrong."""
        return self.seen_by_networks or any(sensing.error for sensing in self.sensing)

    def history_of(self, file: Path) -> History:
        """Return what a file says was seen and done, with what is seen of things at first.

        Raises
        ------
        KnowledgeError
            If the file is missing or wrong.
        PlanningError
            If it says of things what is not so of those that there are.
        """
        said = read_history_file(file, self.knowledge.signature)
        for predicate in sorted({literal.predicate for literal in said.statics}):
            known = set(self.statics(predicate))
            for literal in said.statics:
                if literal.predicate == predicate and clingo.parse_term(str(literal)) not in known:
                    raise PlanningError(
                        f"{file}: says '{literal}', which is not so of the things that the plan "
                        "begins with; give the scene that the file is about with --scene"
                    )
        return said.with_observations(self.seen_at_first, step=0)

    def about(self, scene: ThingScene) -> PlanningDomain:
        """Return the domain about the things of another scene, with the same axioms.

        Of what was seen and done with others nothing is left.

        Raises
        ------
        PlanningError
            If the scene has no things, or the domain plans about none.

        Examples
        --------
        >>> from seewhy.data.thing_scene import thing_scene
        >>> table = load_planning_domain("tabletop")
        >>> ball = thing_scene(table.at_first.things, [{"shape": "sphere"}], relations={})
        >>> table.about(ball).words.name("thing1")
        'the sphere'
        """
        if self.at_first is None:
            raise PlanningError(f"{self.folder}: plans are about no things of pictures")
        seen = set(self.seen_axioms)
        given = tuple(axiom for axiom in self.knowledge.axioms if axiom not in seen)
        at_first = replace(self.at_first, scene=scene)
        knowledge, seen_at_first = with_scene(replace(self.knowledge, axioms=given), at_first)
        before = self.at_first.names().keys()
        names = {key: name for key, name in self.words.things.items() if key not in before}
        return replace(
            self,
            knowledge=knowledge,
            history=History().with_observations(seen_at_first, step=0),
            words=replace(self.words, things={**names, **at_first.names()}),
            at_first=at_first,
            seen_at_first=tuple(seen_at_first),
            seen_axioms=_added(given, knowledge),
        )

    def statics(self, predicate: str) -> list[clingo.Symbol]:
        """The literals about a static that follow from the knowledge, sorted."""
        control = BoundedControl(
            "\n".join(fixed_rules(self.knowledge)), size=grounding_size(self.knowledge)
        )
        literals = (atom.symbol.arguments[0] for atom in control.by_signature("holds", 1))
        return sorted(literal for literal in literals if literal.name == predicate)

    def knowing(self, axioms: Iterable[Axiom]) -> PlanningDomain:
        """Return the domain with further axioms in its knowledge: what a robot has learned.

        Examples
        --------
        >>> from seewhy.knowledge.language import read_axioms
        >>> office = load_planning_domain("robot_assistant")
        >>> learned = read_axioms("default -closed(kitchen).", office.knowledge.signature)
        >>> office.knowing(learned).knowledge.axioms[-1].identifier
        'l1'
        """
        known = self.knowledge
        return replace(self, knowledge=replace(known, axioms=(*known.axioms, *axioms)))

    def without(self, statement: str) -> PlanningDomain:
        """Return the domain without one axiom: what a robot knows that was never told it.

        Raises
        ------
        PlanningError
            If the knowledge has no such axiom; the text names the nearest one.

        Examples
        --------
        >>> office = load_planning_domain("robot_assistant")
        >>> less = office.without("loc(P, L) if work_place(P, L), not -loc(P, L).")
        >>> len(office.knowledge.axioms) - len(less.knowledge.axioms)
        1
        """
        known = self.knowledge
        wanted = " ".join(statement.split()).rstrip(".")
        kept = tuple(axiom for axiom in known.axioms if str(axiom).rstrip(".") != wanted)
        if len(kept) == len(known.axioms):
            statements = [str(axiom).rstrip(".") for axiom in known.axioms]
            head = wanted.split(" if ")[0]
            alike = [candidate for candidate in statements if candidate.split(" if ")[0] == head]
            close = nearest(wanted, alike or statements, at_least=0.0 if alike else 60.0)
            remedy = f"did you mean '{close}'?" if close else f"see {known.file}"
            raise PlanningError(f"the knowledge has no axiom '{wanted}'; {remedy}")
        return replace(self, knowledge=replace(known, axioms=kept))


def bundled_planning_domains() -> tuple[str, ...]:
    """Return the names of the planning domains that come with SeeWhy.

    Examples
    --------
    >>> "robot_assistant" in bundled_planning_domains()
    True
    """
    home = Path(__file__).parents[1] / "domains"
    return tuple(sorted(file.parent.name for file in home.glob(f"*/{FILE}")))


def plans(name: str | Path) -> bool:
    """Whether a folder, or a bundled domain of that name, has planning.toml.

    Examples
    --------
    >>> plans("robot_assistant"), plans("traffic_signs")
    (True, False)
    """
    return _has(name, FILE)


def plans_only(name: str | Path) -> bool:
    """Whether a folder, or a bundled domain of that name, has planning.toml and no domain.toml.

    Examples
    --------
    >>> plans_only("tabletop"), plans_only("robot_assistant")
    (False, False)
    """
    return plans(name) and not _has(name, "domain.toml")


def _has(name: str | Path, file: str) -> bool:
    try:
        return (planning_folder(name) / file).is_file()
    except DomainError:
        return False


def load_planning_domain(name: str | Path, *, scene: ThingScene | None = None) -> PlanningDomain:
    """Load a bundled planning domain by name, or a user's by its folder.

    Parameters
    ----------
    name : str or Path
    scene : ThingScene, optional
        The things that there are at first, where the domain plans about things of pictures; where
        left out, those of ``scene.json`` in the folder.

    Raises
    ------
    DomainError, KnowledgeError
        If a file of the folder is missing or wrong; the text names file and line.
    PlanningError
        If the domain plans about things, and nothing says which there are; or plans about none,
        and a scene is given.

    Examples
    --------
    >>> load_planning_domain("tabletop").words.name("thing1")
    'the small red metal cube'
    """
    folder = planning_folder(name)
    path = folder / FILE
    if not path.is_file():
        raise DomainError(
            f"{folder}: the domain has no {FILE}, so nothing can be planned in it; the domains "
            f"that plan are {', '.join(bundled_planning_domains())}"
        )
    table = read_toml(path, PlanningFile)
    pictures = folder / "domain.toml"
    seen = read_toml(pictures, DomainFile) if pictures.is_file() else None
    knowledge = _read_knowledge(folder, picture=None if seen is None else seen.domain.scene)
    past = folder / "history.al"
    at_first = scene_of_plan(folder, scene)
    seen_at_first: list[Literal] = []
    given = knowledge.axioms
    if at_first is not None:
        knowledge, seen_at_first = with_scene(knowledge, at_first)
    source = path.read_text(encoding="utf-8-sig")
    features = {} if seen is None else seen.features
    for keys, problem in (
        *problems_of(table, knowledge),
        *picture_problems_of(table, features),
        *goal_problems_of(table, knowledge),
    ):
        raise DomainError(f"{path}:{line_of(source, keys)}: {problem}")
    sensing, shows = _read_sensing(
        table, knowledge, at=lambda *keys: f"{path}:{line_of(source, keys)}"
    )
    history = read_history_file(past, knowledge.signature) if past.is_file() else History()
    return PlanningDomain(
        name=table.planning.name,
        title=table.planning.title,
        knowledge=knowledge,
        history=history.with_observations(seen_at_first, step=0),
        words=_words(table, knowledge, at_first),
        robot=table.planning.robot,
        horizon=table.planning.horizon,
        answer_sets=table.planning.answer_sets,
        sensing=sensing,
        shows=MappingProxyType(shows),
        simulation=table.simulation,
        map=table.map,
        folder=folder,
        goals=table.goals,
        at_first=at_first,
        seen_at_first=tuple(seen_at_first),
        seen_axioms=_added(given, knowledge),
    )


def _added(given: tuple[Axiom, ...], knowledge: Knowledge) -> tuple[Axiom, ...]:
    """The axioms of a knowledge that were not given before."""
    before = set(given)
    return tuple(axiom for axiom in knowledge.axioms if axiom not in before)


def _read_knowledge(folder: Path, *, picture: str | None) -> Knowledge:
    """What knowledge.al says, with planning.al what may change of it; nothing of the picture.

    The picture is nothing that there is in the world; ``picture`` is its sort.
    """
    given, change = folder / "knowledge.al", folder / CHANGE
    if change.is_file():
        found = read_changeable_files(given, change, without=picture or "")
    else:
        found = read_knowledge_file(given)
    return found if picture is None else found.without_sort(picture)


def _words(
    table: PlanningFile, knowledge: Knowledge, at_first: SceneOfPlan | None
) -> PlanningWords:
    """How all that there is is said; of a picture's things as its domain says it."""
    predicates = knowledge.signature.predicates
    clauses = {} if at_first is None else thing_clauses(at_first.things, knowledge)
    fixed = frozenset(
        name for name, found in predicates.items() if found.kind is PredicateKind.STATIC
    )
    statics = {name: said for name, said in clauses.items() if name in fixed}
    fluents = {name: said for name, said in clauses.items() if name not in fixed}
    return PlanningWords(
        {**table.things, **({} if at_first is None else at_first.names())},
        {**fluents, **table.fluents},
        table.actions,
        table.planning.robot,
        possessives=table.possessives,
        statics={**statics, **table.statics},
        actors=actor_places(knowledge.signature, table.actions, robot=table.planning.robot),
        fixed=fixed,
    )


def _read_sensing(
    table: PlanningFile, knowledge: Knowledge, *, at: Callable[..., str]
) -> tuple[tuple[Sensing, ...], dict[str, Sensing]]:
    """What the robot senses, and what its pictures show; ``at`` gives the place of some keys."""
    sensing = []
    for number, entry in enumerate(table.sensing):
        try:
            sensing.append(read_sensing(entry.literal, entry.where, knowledge, error=entry.error))
        except SensingError as problem:
            place = at("sensing", str(number), problem.part)
            raise DomainError(f"{place}: {problem}") from None
    shows = {}
    for feature, literal in (table.pictures.shows if table.pictures else {}).items():
        where = table.pictures.where if table.pictures else ""
        try:
            shows[feature] = read_sensing(literal, where, knowledge)
        except SensingError as problem:
            keys = ("shows", feature) if problem.part == "literal" else ("where",)
            raise DomainError(f"{at('pictures', *keys)}: {problem}") from None
    return tuple(sensing), shows


def planning_folder(name: str | Path) -> Path:
    """Return the folder of a bundled planning domain's name, or of a path to a user's folder.

    Raises
    ------
    DomainError
        If there is neither; the text gives the nearest bundled name.
    """
    if not Path(name).is_dir() and str(name) in bundled_planning_domains():
        return Path(__file__).parents[1] / "domains" / str(name)
    try:
        return domain_folder(name)
    except DomainError:
        raise DomainError(
            f"'{name}' is neither a folder nor a bundled domain that plans; "
            f"{did_you_mean(str(name), bundled_planning_domains())}"
        ) from None
