"""The tables of planning.toml: words for what changes, what the robot senses, what may happen."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Probability = Annotated[float, Field(ge=0.0, le=1.0)]
Seconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)


class PlanningTable(_Table):
    """``[planning]``: what the domain is called, and who acts.

    ``robot`` is the term that stands for whoever acts, if the knowledge has one. With
    ``answer_sets`` plans are sought by answer sets alone, as in the paper.
    """

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    title: str
    robot: str | None = None
    horizon: int = Field(default=50, ge=1, le=10_000)
    answer_sets: bool = False


class FluentTable(_Table):
    """``[fluents.NAME]``: how it is said that the fluent holds, and that it does not.

    ``[statics.NAME]`` says the same of statics.

    ``{0}``, ``{1}``, … are its arguments in words.
    """

    say: str
    deny: str | None = None


class ActionTable(_Table):
    """``[actions.NAME]``: "move to {1}" (``do``), "moved to {1}" (``did``).

    What happens unasked is said as a whole in ``did``: "{0} walked to {1}".
    """

    do: str | None = None
    did: str


class SensingTable(_Table):
    """``[[sensing]]``: a fluent whose truth the robot sees, where a condition holds.

    ``error`` is the probability that the sensor says the opposite (in simulation).
    """

    literal: str
    where: str
    error: Probability = 0.0


class PicturesTable(_Table):
    """``[pictures]``: what the pictures that the robot takes say, where networks see.

    ``shows`` gives, for features of domain.toml that have the values yes and no, the fluent whose
    truth each is, where the condition ``where`` holds.
    """

    where: str
    shows: dict[str, str] = Field(min_length=1)


class SimulationTable(_Table):
    """``[simulation]``: how often what happens, for the simulated world.

    ``events`` gives, for exogenous actions, the probability that one of this kind happens at a
    step; ``failures``, for actions, that it has no effect. ``before`` steps of events pass before
    the robot begins. ``unknown`` is the probability that a fluent of which nothing is known at
    first holds. ``durations`` gives, for actions, how many seconds one takes (1 where it says
    nothing); they change nothing in the world.
    """

    events: dict[str, Probability] = {}
    failures: dict[str, Probability] = {}
    durations: dict[str, Seconds] = {}
    before: int = Field(default=0, ge=0, le=10_000)
    unknown: Probability = 0.0


class MapTable(_Table):
    """``[map]``: how to draw where things are.

    ``places`` is a sort, ``links`` a static that joins two places, ``where`` the fluent that says
    which place a thing is in, ``closed`` one of places that cannot be entered.
    """

    places: str
    links: str
    where: str
    closed: str | None = None


class PlanningFile(_Table):
    """The whole of planning.toml.

    ``possessives`` says for a thing what stands for its name with 's, once it was named: "her".
    """

    planning: PlanningTable
    things: dict[str, str] = {}
    possessives: dict[str, str] = {}
    fluents: dict[str, FluentTable] = {}
    statics: dict[str, FluentTable] = {}
    actions: dict[str, ActionTable] = {}
    sensing: tuple[SensingTable, ...] = ()
    pictures: PicturesTable | None = None
    simulation: SimulationTable = SimulationTable()
    map: MapTable | None = None
