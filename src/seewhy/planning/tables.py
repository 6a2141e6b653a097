"""The tables of planning.toml: words for what changes, what the robot senses, what may happen."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from seewhy.domain.table_texts import Spoken, StrictTable, Word

Probability = Annotated[float, Field(ge=0.0, le=1.0)]
Seconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


class PlanningTable(StrictTable):
    """``[planning]``: what the domain is called, and who acts."""

    name: str = Field(
        pattern=r"^[a-z][a-z0-9_]*$",
        description="The domain's name in commands: small letters, digits and underscores.",
    )
    title: str = Field(description="The heading of reports and pages.")
    robot: str | None = Field(
        default=None,
        description="The term that stands for whoever acts, if the knowledge has one.",
    )
    horizon: int = Field(
        default=50, ge=1, le=10_000, description="The most steps that a plan may have."
    )
    answer_sets: bool = Field(
        default=False,
        description="Whether plans are sought by answer sets alone, as in the paper.",
    )


class FluentTable(StrictTable):
    """``[fluents.NAME]``: how it is said that the fluent holds, and that it does not.

    ``[statics.NAME]`` says the same of statics.
    """

    say: Spoken = Field(
        description="The clause that says that it holds, as in `{0} is in {1}`; {0}, {1}, … are "
        "its arguments in words.",
    )
    deny: Spoken | None = Field(
        default=None,
        description="The clause that says that it does not hold; where left out, `it is not so "
        "that …`.",
    )


class ActionTable(StrictTable):
    """``[actions.NAME]``: "move to {1}" (``do``), "moved to {1}" (``did``)."""

    do: Spoken | None = Field(
        default=None,
        description="The instruction, as in `move to {1}`; what happens unasked has none.",
    )
    did: Spoken = Field(
        description="What was done, as in `moved to {1}`; what happens unasked is said as a whole, "
        "as in `{0} walked to {1}`.",
    )
    also: tuple[Spoken, ...] = Field(
        default=(),
        description="Other instructions by which goals and questions may name it, as in "
        "`go to {1}`.",
    )


class GoalTable(StrictTable):
    """``[[goals]]``: a goal as one says it: "make a tower of {N}"."""

    say: tuple[str, ...] = Field(
        min_length=1,
        description="The instructions, as in `make a tower of {N}`; {N} is a variable of the goal.",
    )
    goal: str = Field(description="What shall hold then, as in `tower_of(N)`.")


class SensingTable(StrictTable):
    """``[[sensing]]``: a fluent whose truth the robot sees, where a condition holds."""

    literal: str = Field(description="The fluent, as in `loc(A, L)`.")
    where: str = Field(description="The condition on which it is seen, as in `loc(rob1, L)`.")
    error: Probability = Field(
        default=0.0,
        description="How probably the sensor says the opposite, in the simulated world.",
    )


class PicturesTable(StrictTable):
    """``[pictures]``: what the pictures that the robot takes say, where networks see."""

    where: str = Field(
        description="The condition on which a picture shows what it shows, as in `loc(rob1, L)`."
    )
    shows: dict[str, str] = Field(
        min_length=1,
        description="For features of domain.toml that have the values yes and no, the fluent whose "
        "truth each is.",
    )


class SimulationTable(StrictTable):
    """``[simulation]``: how often what happens, for the simulated world."""

    events: dict[str, Probability] = Field(
        default={},
        description="For exogenous actions, how probably one of this kind happens at a step.",
    )
    failures: dict[str, Probability] = Field(
        default={}, description="For actions, how probably one has no effect."
    )
    durations: dict[str, Seconds] = Field(
        default={},
        description="For actions, how many seconds one takes, 1 where left out; they change "
        "nothing in the world.",
    )
    before: int = Field(
        default=0,
        ge=0,
        le=10_000,
        description="How many steps of events pass before the robot begins.",
    )
    unknown: Probability = Field(
        default=0.0,
        description="How probably a fluent of which nothing is known at first holds.",
    )


class MapTable(StrictTable):
    """``[map]``: how to draw where things are."""

    places: str = Field(description="The sort of places.")
    links: str = Field(description="The static that joins two places.")
    where: str = Field(description="The fluent that says which place a thing is in.")
    closed: str | None = Field(
        default=None, description="The fluent of places that cannot be entered."
    )


class PlanningFile(StrictTable):
    """The whole of planning.toml."""

    planning: PlanningTable = Field(description="What the domain is called, and who acts.")
    things: dict[str, Word] = Field(
        default={}, description="For terms of the knowledge, how they are said."
    )
    possessives: dict[str, Word] = Field(
        default={},
        description="For a thing, what stands for its name with 's once it was named, as in `her`.",
    )
    fluents: dict[str, FluentTable] = Field(
        default={}, description="How it is said that a fluent holds, and that it does not."
    )
    statics: dict[str, FluentTable] = Field(
        default={}, description="How it is said that a static holds, and that it does not."
    )
    actions: dict[str, ActionTable] = Field(
        default={}, description="How it is said that an action is to be done, and that it was."
    )
    goals: tuple[GoalTable, ...] = Field(
        default=(),
        description="Goals that can be said in words, beside those that actions bring about and "
        "what fluents say.",
    )
    sensing: tuple[SensingTable, ...] = Field(
        default=(),
        description="One table a fluent whose truth the robot sees, where a condition holds.",
    )
    pictures: PicturesTable | None = Field(
        default=None,
        description="What the pictures that the robot takes say, where networks see for it.",
    )
    simulation: SimulationTable = Field(
        default=SimulationTable(),
        description="How often what happens, for the simulated world.",
    )
    map: MapTable | None = Field(default=None, description="How to draw where things are.")
