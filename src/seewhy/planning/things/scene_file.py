"""Which scene a plan is about: the one that is given, or that of the domain's folder."""

from __future__ import annotations

from pathlib import Path

from seewhy.data.importers.clevr import read_scenes
from seewhy.data.thing_scene import ThingScene
from seewhy.domain.domain import load_domain
from seewhy.errors import PlanningError
from seewhy.planning.things.initial_scene import SceneOfPlan

__all__ = ["SCENE_FILE", "chosen_scene", "scene_of_plan"]

SCENE_FILE = "scene.json"
"""The things that there are at first, where no others are given; may be missing."""


def scene_of_plan(folder: Path, scene: ThingScene | None) -> SceneOfPlan | None:
    """Return the scene that a folder's plans begin with; None where they are about no things.

    Raises
    ------
    PlanningError
        If the plans are about things, and neither a scene is given nor the folder has one; or they
        are about none, and one is given.
    DomainError, DatasetError
        If domain.toml, or the folder's own scene, is wrong.
    """
    domain = load_domain(folder) if (folder / "domain.toml").is_file() else None
    if domain is None or domain.things is None:
        if scene is not None:
            raise PlanningError(
                f"{folder}: the domain has no [things], so that nothing can be planned about those "
                "of a scene; leave the scene out"
            )
        return None
    if scene is not None:
        return SceneOfPlan(domain, scene)
    kept = folder / SCENE_FILE
    if not kept.is_file():
        raise PlanningError(
            f"{folder}: plans are about the things of a picture, and nothing says which there are; "
            f"give them with --scene or --picture, or keep {SCENE_FILE} in the folder"
        )
    return SceneOfPlan(domain, next(iter(read_scenes(kept, domain.things).values())))


def chosen_scene(folder: Path, file: Path, image: str | None) -> ThingScene:
    """Return a scene of a file of annotated scenes, by its image_index.

    ``image`` may be left out where the file has one scene.

    Raises
    ------
    PlanningError
        If the domain has no things, or there is no such scene, or several.
    DomainError, DatasetError
        If domain.toml or the file is wrong.
    """
    things = load_domain(folder).things if (folder / "domain.toml").is_file() else None
    if things is None:
        raise PlanningError(
            f"{folder}: the domain has no [things] that a scene could show; leave the scene out"
        )
    scenes = {str(number): scene for number, scene in read_scenes(file, things).items()}
    if image is None and len(scenes) > 1:
        raise PlanningError(f"{file}: has {len(scenes)} scenes; say which with --image")
    chosen = next(iter(scenes)) if image is None else image
    if chosen not in scenes:
        raise PlanningError(f"{file}: has no scene with image_index {chosen}")
    return scenes[chosen]
