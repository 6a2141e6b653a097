"""The things that a plan begins with: options of the commands that plan and simulate."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seewhy.cli.screen import remark

if TYPE_CHECKING:
    from seewhy.data.thing_scene import ThingScene
    from seewhy.planning.domain import PlanningDomain

SceneFile = Annotated[
    Path | None,
    typer.Option(
        "--scene",
        metavar="FILE",
        help="The things that there are at first: an annotated scene (docs/things.md).",
    ),
]
SceneNumber = Annotated[
    str | None,
    typer.Option("--image", help="Which scene of the file, by its image_index."),
]
PictureFile = Annotated[
    Path | None,
    typer.Option("--picture", help="A picture that shows the things that there are at first."),
]
ThingModelFolder = Annotated[
    Path | None,
    typer.Option("--model", help="The model that sees the things in --picture."),
]


@dataclass(frozen=True)
class BeginningScene:
    """Where the things come from that a plan begins with; the domain's own where nothing is given.

    Attributes
    ----------
    scene : Path or None
        A file of annotated scenes; ``image`` says which of them.
    picture, model : Path or None
        A picture, and what sees its things.
    """

    scene: Path | None = None
    image: str | None = None
    picture: Path | None = None
    model: Path | None = None

    def planning_domain(self, name: str) -> PlanningDomain:
        """Return the planning domain with these things; what a model saw of them may be wrong.

        Raises
        ------
        SeeWhyError
            If one option lacks another, or both kinds are given; if a file is missing or wrong.
        """
        from seewhy.planning.domain import load_planning_domain

        domain = load_planning_domain(name, scene=self._scene(name))
        return domain if self.picture is None else replace(domain, seen_by_networks=True)

    def _scene(self, name: str) -> ThingScene | None:
        from seewhy.errors import PlanningError
        from seewhy.planning.domain import planning_folder
        from seewhy.planning.things.scene_file import chosen_scene

        if (self.picture is None) != (self.model is None):
            lacking = "--model" if self.model is None else "--picture"
            raise PlanningError(
                f"a picture is seen by a model: give {lacking}, too, or --scene in their place"
            )
        if self.scene is None and self.image is not None:
            raise PlanningError("--image says which scene of a file: give the file with --scene")
        if self.scene is not None and self.picture is not None:
            raise PlanningError("--scene and --picture both say which things there are; give one")
        if self.scene is not None:
            return chosen_scene(planning_folder(name), self.scene, self.image)
        if self.picture is not None and self.model is not None:
            return _seen(name, self.picture, self.model)
        return None


def _seen(name: str, picture: Path, model: Path) -> ThingScene:
    """The things that a model sees in a picture; what is not sure of it is remarked."""
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.domain.domain import load_domain
    from seewhy.errors import PlanningError

    agent = ThingAgent.load(model)
    domain = load_domain(name)
    if domain.things is None or agent.things.seen != domain.things.seen:
        raise PlanningError(
            f"{model}: sees things of the domain '{agent.domain.name}', and the plan is about "
            f"those of '{domain.name}'; train a model for '{domain.name}'"
        )
    read = agent.scene_of(agent.read(picture))
    for notice in read.notices():
        remark(notice)
    for number in range(read.scene.count):
        remark(f"seen: {read.words.name(number)}")
    return read.scene
