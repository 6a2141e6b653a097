"""PlanningDomain: a folder with knowledge about change, read and checked as a whole."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import clingo

from seewhy.domain.folder import domain_folder
from seewhy.domain.tables import DomainFile, FeatureTable
from seewhy.errors import DomainError, PlanningError
from seewhy.files.toml_file import line_of, read_toml
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import fixed_rules
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.history import History, read_history_file
from seewhy.knowledge.language import Knowledge, read_knowledge_file
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.actors import actor_places
from seewhy.planning.execution.sensing import Sensing, SensingError, read_sensing
from seewhy.planning.tables import MapTable, PlanningFile, SimulationTable
from seewhy.planning.words import PlanningWords
from seewhy.text.nearest import did_you_mean, nearest
from seewhy.text.slots import wrong_slot

FILE = "planning.toml"
_SLOT = re.compile(r"\{(\d+)\}")


@dataclass(frozen=True)
class PlanningDomain:
    """Everything that a folder says about planning.

    Attributes
    ----------
    name, title : str
    knowledge : Knowledge
    history : History
        What is known at first (``history.al`` of the folder; empty where there is none).
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

    @property
    def sensors_err(self) -> bool:
        """Whether what is sensed may be wrong."""
        return self.seen_by_networks or any(sensing.error for sensing in self.sensing)

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
    >>> plans_only("tower_building"), plans_only("robot_assistant")
    (True, False)
    """
    return plans(name) and not _has(name, "domain.toml")


def _has(name: str | Path, file: str) -> bool:
    try:
        return (_folder(name) / file).is_file()
    except DomainError:
        return False


def load_planning_domain(name: str | Path) -> PlanningDomain:
    """Load a bundled planning domain by name, or a user's by its folder.

    Raises
    ------
    DomainError, KnowledgeError
        If a file of the folder is missing or wrong; the text names file and line.
    """
    folder = _folder(name)
    path = folder / FILE
    if not path.is_file():
        raise DomainError(
            f"{folder}: the domain has no {FILE}, so nothing can be planned in it; the domains "
            f"that plan are {', '.join(bundled_planning_domains())}"
        )
    table = read_toml(path, PlanningFile)
    knowledge = read_knowledge_file(folder / "knowledge.al")
    pictures = folder / "domain.toml"
    seen = read_toml(pictures, DomainFile) if pictures.is_file() else None
    if seen is not None:
        # The picture is nothing that there is in the world.
        knowledge = knowledge.without_sort(seen.domain.scene)
    source = path.read_text(encoding="utf-8-sig")
    features = {} if seen is None else seen.features
    for keys, problem in (*_problems(table, knowledge), *_picture_problems(table, features)):
        raise DomainError(f"{path}:{line_of(source, keys)}: {problem}")
    sensing, shows = _read_sensing(
        table, knowledge, at=lambda *keys: f"{path}:{line_of(source, keys)}"
    )
    past = folder / "history.al"
    return PlanningDomain(
        name=table.planning.name,
        title=table.planning.title,
        knowledge=knowledge,
        history=read_history_file(past, knowledge.signature) if past.is_file() else History(),
        words=PlanningWords(
            table.things,
            table.fluents,
            table.actions,
            table.planning.robot,
            possessives=table.possessives,
            statics=table.statics,
            actors=actor_places(knowledge.signature, table.actions, robot=table.planning.robot),
            fixed=frozenset(
                name
                for name, predicate in knowledge.signature.predicates.items()
                if predicate.kind is PredicateKind.STATIC
            ),
        ),
        robot=table.planning.robot,
        horizon=table.planning.horizon,
        answer_sets=table.planning.answer_sets,
        sensing=sensing,
        shows=MappingProxyType(shows),
        simulation=table.simulation,
        map=table.map,
        folder=folder,
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


def _folder(name: str | Path) -> Path:
    if not Path(name).is_dir() and str(name) in bundled_planning_domains():
        return Path(__file__).parents[1] / "domains" / str(name)
    try:
        return domain_folder(name)
    except DomainError:
        raise DomainError(
            f"'{name}' is neither a folder nor a bundled domain that plans; "
            f"{did_you_mean(str(name), bundled_planning_domains())}"
        ) from None


def _problems(table: PlanningFile, knowledge: Knowledge) -> Iterator[tuple[tuple[str, ...], str]]:
    """What planning.toml says of things that the knowledge does not have."""
    signature = knowledge.signature
    fluents = {n: len(p.sorts) for n, p in signature.predicates.items() if p.kind.is_fluent}
    statics = {
        n: len(p.sorts) for n, p in signature.predicates.items() if p.kind is PredicateKind.STATIC
    }
    actions = {n: len(p.sorts) for n, p in signature.predicates.items() if p.kind.is_action}
    members = {member for sort in signature.sorts.values() for member in sort.members or ()}
    for sort in signature.sorts.values():
        if sort.members is None:
            yield ("planning",), f"the sort '{sort.name}' has no members ({sort.location})"
    if not any(p.kind is PredicateKind.ACTION for p in signature.predicates.values()):
        yield ("planning",), f"{knowledge.file} declares no action, so nothing can be planned"
    robot = table.planning.robot
    if robot is not None and robot not in members:
        yield ("planning", "robot"), f"'{robot}' is of no sort; {did_you_mean(robot, members)}"
    for key, things in (("things", table.things), ("possessives", table.possessives)):
        for thing in things:
            if thing not in members:
                yield (key, thing), f"'{thing}' is of no sort; {did_you_mean(thing, members)}"
    for kind, named, known in (
        ("fluents", _said(table.fluents), fluents),
        ("statics", _said(table.statics), statics),
        ("actions", _said(table.actions), actions),
    ):
        for name, texts in named.items():
            if name not in known:
                yield (kind, name), f"'{name}' is none of the {kind}; {did_you_mean(name, known)}"
                continue
            for key, text in texts.items():
                wrong = wrong_slot(_SLOT.sub("", text), ())
                if wrong is not None:
                    yield (
                        (kind, name, key),
                        f"'{text}' has '{wrong}', which is no slot; there are {{0}}, {{1}}, … for "
                        "the arguments",
                    )
                for slot in _SLOT.findall(text):
                    if int(slot) >= known[name]:
                        yield (
                            (kind, name, key),
                            f"'{name}' has {known[name]} arguments, counted from 0, but '{text}' "
                            f"asks for {{{slot}}}",
                        )
    if table.map is not None:
        yield from _map_problems(table.map, knowledge)
    for key, chances, wanted in (
        ("events", table.simulation.events, PredicateKind.EXOGENOUS_ACTION),
        ("failures", table.simulation.failures, PredicateKind.ACTION),
        ("durations", table.simulation.durations, PredicateKind.ACTION),
    ):
        names = [n for n, p in signature.predicates.items() if p.kind is wanted]
        for name in chances:
            if name not in names:
                yield (
                    ("simulation", key, name),
                    f"'{name}' is no {wanted.value}; {did_you_mean(name, names)}",
                )


def _picture_problems(
    table: PlanningFile, features: Mapping[str, FeatureTable]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """What planning.toml says of features that domain.toml does not have."""
    for key in table.pictures.shows if table.pictures else ():
        here = ("pictures", "shows", key)
        if not features:
            yield here, "the folder has no domain.toml, which would name features of pictures"
        elif key not in features:
            yield here, f"'{key}' is no feature of domain.toml; {did_you_mean(key, features)}"
        elif {*features[key].values} != {"yes", "no"}:
            yield (
                here,
                f"the feature '{key}' has the values {', '.join(features[key].values)}; only one "
                "of yes and no says whether a fluent holds",
            )


def _map_problems(table: MapTable, knowledge: Knowledge) -> Iterator[tuple[tuple[str, ...], str]]:
    signature = knowledge.signature
    if table.places not in signature.sorts:
        remedy = did_you_mean(table.places, signature.sorts)
        yield ("map", "places"), f"'{table.places}' is no sort; {remedy}"
        return
    wanted: dict[str, tuple[str | None, str, list[str | None]]] = {
        "links": (table.links, "static", [table.places, table.places]),
        "where": (table.where, "fluent", [None, table.places]),
        "closed": (table.closed, "fluent", [table.places]),
    }
    for key, (name, kind, sorts) in wanted.items():
        if name is None:
            continue
        known = [n for n, p in signature.predicates.items() if kind in p.kind.value]
        if name not in known:
            yield ("map", key), f"'{name}' is no {kind}; {did_you_mean(name, known)}"
            continue
        declared = signature.predicates[name].sorts
        if len(declared) != len(sorts) or any(
            b not in (None, a) for a, b in zip(declared, sorts, strict=True)
        ):
            shown = ", ".join(sort or "thing" for sort in sorts)
            yield (
                ("map", key),
                f"'{signature.predicates[name]}' must be of the form {name}({shown})",
            )


def _said(tables: Mapping[str, object]) -> dict[str, dict[str, str]]:
    return {
        name: {key: text for key, text in vars(table).items() if text is not None}
        for name, table in tables.items()
    }
