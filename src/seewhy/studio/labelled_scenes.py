"""The labelled pictures of a project as scenes, by which rules are judged."""

from __future__ import annotations

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.domain.tables import CLASS
from seewhy.studio.project import Project

__all__ = ["drawn_scenes", "labelled_scenes"]


def labelled_scenes(project: Project) -> AnnotatedScenes:
    """The pictures of a project whose class somebody said, with all else that was said of them.

    Of a domain with things, a picture in which nothing is drawn has no say, unless it is said that
    nothing is there.
    """
    domain, labels = project.domain(), project.labels()
    said = {
        picture: label
        for picture in project.pictures()
        if (label := labels.value(picture, CLASS)) in domain.classes and label is not None
    }
    if domain.things is not None:
        return _scenes_of_things(project, said)
    vectors = [
        domain.vector(
            {
                key: value
                for key, value in labels.values(picture).items()
                if key in domain.features and value in domain.features[key].values
            }
        )
        for picture in said
    ]
    return AnnotatedScenes(tuple(vectors), tuple(said.values()), tuple(said))


def drawn_scenes(project: Project) -> AnnotatedScenes:
    """The pictures of a project whose things are drawn, without their classes."""
    labels = project.labels()
    drawn = {
        picture: ""
        for picture in project.pictures()
        if (here := labels.drawn_in(picture)).none or here.things
    }
    return _scenes_of_things(project, drawn)


def _scenes_of_things(project: Project, said: dict[str, str]) -> AnnotatedScenes:
    labels = project.labels()
    drawn = {
        picture: label
        for picture, label in said.items()
        if (here := labels.drawn_in(picture)).none or here.things
    }
    if not drawn:
        return AnnotatedScenes((), (), ())
    dataset = project.dataset()
    names = map(dataset.name_of, dataset.scenes)
    vectors = dict(zip(names, dataset.vectors, strict=True))
    kept = tuple(name for name in drawn if name in vectors)
    return AnnotatedScenes(
        tuple(vectors[name] for name in kept), tuple(drawn[name] for name in kept), kept
    )
