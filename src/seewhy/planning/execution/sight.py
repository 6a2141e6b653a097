"""What a robot sees: a picture of where it is, read by the networks of a model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import clingo
import numpy as np
from numpy.typing import NDArray

from seewhy.data.picture_source import load_depict
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import PlanningError
from seewhy.planning.domain import FILE, PlanningDomain
from seewhy.planning.execution.sensing import Sensors, condition_to_sense
from seewhy.planning.execution.transition_function import World

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent


@dataclass(frozen=True, eq=False)
class Look:
    """A picture that was taken, and what was read from it.

    Attributes
    ----------
    picture : ndarray of uint8, shape (height, width, 3)
    shown : dict of Symbol to bool
        The fluents that the picture is about, and whether each truly holds.
    read : dict of Symbol to bool
        Whether each holds by what the networks see.
    """

    picture: NDArray[np.uint8]
    shown: Mapping[clingo.Symbol, bool]
    read: Mapping[clingo.Symbol, bool]

    @property
    def misread(self) -> tuple[clingo.Symbol, ...]:
        """The fluents that are not as they were read, sorted."""
        return tuple(
            sorted(fluent for fluent in self.shown if self.shown[fluent] != self.read[fluent])
        )


class Sight:
    """The eyes of a robot: in simulation the domain's source draws the pictures that it takes.

    Parameters
    ----------
    domain : PlanningDomain
        Its ``[pictures]`` says which fluent each feature of a picture is about, and where.
    agent : Agent
        Trained on pictures of this domain; it reads them in its way of reading.

    Raises
    ------
    PlanningError
        If the domain says nothing of pictures, or the agent sees other features.
    """

    def __init__(self, domain: PlanningDomain, agent: Agent) -> None:
        if not domain.shows:
            raise PlanningError(
                f"{domain.folder / FILE}: nothing says what pictures show, so a model cannot see "
                "for the robot; add [pictures] with where and shows"
            )
        for feature in domain.shows:
            if feature not in agent.domain.features:
                raise PlanningError(
                    f"the model sees no '{feature}', which pictures show by "
                    f"{domain.folder / FILE}; it was trained for the domain "
                    f"'{agent.domain.name}', train one for '{domain.name}'"
                )
        self.domain = domain
        self.agent = agent
        self._sensors = Sensors(domain.knowledge, tuple(domain.shows.values()))

    @cached_property
    def _pictures(self) -> Domain:
        # A model keeps what its domain says, but not the source of pictures.
        return load_domain(self.domain.folder)

    def about(self, state: World) -> dict[str, clingo.Symbol]:
        """Return the features of a picture taken in a state, with the fluent that each is about.

        Raises
        ------
        PlanningError
            If a feature is about several fluents: the picture would be of several places.
        """
        found: dict[str, clingo.Symbol] = {}
        for fluent, _ in self._sensors.sensed(state):
            for feature, sensing in self.domain.shows.items():
                if condition_to_sense(sensing, fluent) is None:
                    continue
                if found.setdefault(feature, fluent) != fluent:
                    raise PlanningError(
                        f"{self.domain.folder / FILE}: [pictures] where holds for {fluent} and "
                        f"for {found[feature]} at once; a picture is of one place"
                    )
        return found

    def read(
        self, picture: NDArray[np.uint8], features: Mapping[str, clingo.Symbol]
    ) -> dict[clingo.Symbol, bool]:
        """Return of the fluents that a picture is about whether they hold, as the networks see it.

        ``features`` is as :meth:`about` gives it for where the robot is.
        """
        from seewhy.perception.picture import as_picture

        fit = self.agent.domain.pictures.fit
        pixels = as_picture(picture, size=self.agent.picture_size, fit=fit)
        (reading,) = self.agent.read(pixels[None])
        return {
            fluent: reading.features[feature].value == "yes" for feature, fluent in features.items()
        }

    def look(self, state: World, *, seed: int) -> Look:
        """Take a picture in a state of the simulated world, and read it."""
        features = self.about(state)
        shown = {fluent: fluent in state for fluent in features.values()}
        values = {key: "yes" if shown[fluent] else "no" for key, fluent in features.items()}
        picture = self._draw(values, seed=seed)
        return Look(picture, shown, self.read(picture, features))

    def _draw(self, features: Mapping[str, str], *, seed: int) -> Any:
        domain = self._pictures
        depict = load_depict(domain)
        try:
            return depict(features, seed=seed, size=domain.pictures.size)
        except Exception as problem:
            raise PlanningError(
                f"{self.domain.folder / 'domain.toml'}: the source '{domain.source}' fails at "
                f"depict({dict(features)}, seed={seed}, size={domain.pictures.size}): "
                f"{type(problem).__name__}: {problem}"
            ) from problem
