"""things.csv and relations.csv of a project: written whole from its record, and taken in."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import permutations
from pathlib import Path
from typing import Any

from seewhy.data.measured import MEASURES, STANDING
from seewhy.data.scene import Scene
from seewhy.data.scene_vector import feet_of
from seewhy.data.table_writing import text_of_table
from seewhy.data.thing import RELATIONS, THINGS, Related, Thing
from seewhy.data.thing_tables import cells_of_relations, cells_of_things, with_things
from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.studio.drawn_things import Pair, PictureThings, corners_of

__all__ = ["changes_in_tables", "said_first", "things_tables"]


def things_tables(drawn: Mapping[str, PictureThings], things: Things) -> dict[str, str]:
    """The texts of things.csv and relations.csv.

    A table that lists a relation says of all pairs that it leaves out that it does not hold. Pairs
    of which nobody said anything therefore stand in it as unknown, or as they are measured.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.studio.drawn_things import DrawnThing
    >>> here = PictureThings({"1": DrawnThing("1")})
    >>> print(things_tables({"a.png": here}, load_domain("tabletop").things)["things.csv"])
    image,thing,left,top,right,bottom,size,colour,material,shape
    a.png,1,,,,,,,,
    <BLANKLINE>
    """
    known = {picture: _known(here, things) for picture, here in sorted(drawn.items())}
    named = [
        (picture, Scene(Path(picture), (), things=found))
        for picture, found in known.items()
        if found
    ]
    listed = {relation for here in drawn.values() for relation, _, _ in here.related}
    listed &= set(things.seen)
    related = [
        (
            picture,
            replace(scene, related=tuple(_rows(drawn[picture], scene.things, things, listed))),
        )
        for picture, scene in named
    ]
    return {
        THINGS: text_of_table(cells_of_things(named, things)),
        RELATIONS: text_of_table(cells_of_relations(_without_needless(related))),
    }


def said_first(pair: Pair, things: Things) -> Pair:
    """The same of a relation and its converse: said of the one that domain.toml names first.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> said_first(("right", "book", "cup"), load_domain("tabletop").things)
    ('left', 'cup', 'book')
    """
    relation, thing, other = pair
    converse = things.relations[relation].converse
    order = list(things.relations)
    if converse is not None and order.index(converse) < order.index(relation):
        return converse, other, thing
    return pair


def changes_in_tables(
    folder: Path, pictures: Sequence[str], domain: Domain, drawn: Mapping[str, PictureThings]
) -> dict[str, Any] | None:
    """The body of an entry that takes in what tables say otherwise than the record.

    None where they agree, and where there are none.

    Raises
    ------
    DatasetError
        If a table is wrong.
    """
    assert domain.things is not None, "the domain has no things"
    scenes = with_things([Scene(folder / name, ()) for name in pictures], pictures, domain, folder)
    boxes: dict[str, dict[str, Any]] = {}
    related: dict[str, list[list[str | bool | None]]] = {}
    for name, scene in zip(pictures, scenes, strict=True):
        here = drawn.get(name, PictureThings())
        if changes := _changes(here, scene.things):
            boxes[name] = changes
        now = {
            said_first((said.relation, said.thing, said.other), domain.things): said.holds
            for said in scene.related
        }
        said = {pair: now.get(pair) for pair in {**here.related, **now}}
        if changed := [
            [*pair, holds] for pair, holds in said.items() if here.related.get(pair) != holds
        ]:
            related[name] = changed
    found = {"boxes": boxes, "related": related}
    return {**found, "how": "table"} if boxes or related else None


def _changes(here: PictureThings, found: Sequence[Thing]) -> dict[str, Any]:
    """What became of things, from the record's to those of a table."""
    changes: dict[str, Any] = {}
    for thing in found:
        before = here.things.get(thing.name)
        known = {} if before is None else before.as_thing().values
        change: dict[str, Any] = {} if before is not None else {"new": True}
        if before is None or before.box != thing.box:
            change["box"] = None if thing.box is None else corners_of(thing.box)
        values = {
            key: thing.values.get(key)
            for key in {**known, **thing.values}
            if known.get(key) != thing.values.get(key)
        }
        if values:
            change["values"] = values
        if change:
            changes[thing.name] = change
    names = {thing.name for thing in found}
    return changes | {name: None for name in here.things if name not in names}


def _known(here: PictureThings, things: Things) -> tuple[Thing, ...]:
    """The things of a picture with what the domain knows by now."""
    features = things.features
    return tuple(
        replace(
            thing,
            values={
                key: value
                for key, value in thing.values.items()
                if key in features and value in features[key].values
            },
        )
        for thing in (drawn.as_thing() for drawn in here.things.values())
    )


def _rows(
    here: PictureThings, found: Sequence[Thing], things: Things, listed: Collection[str]
) -> Iterator[Related]:
    boxes = {thing.name: thing.box for thing in found}
    said = [Related(*key, holds) for key, holds in here.related.items()]
    standing = {name: boxes.get(foot) for name, foot in feet_of(things, boxes, said).items()}
    for relation in things.relations:
        if relation not in listed:
            continue
        measure = MEASURES.get(things.relations[relation].measure)
        where = standing if things.relations[relation].measure in STANDING else boxes
        for thing, other in permutations(found, 2):
            holds = here.related.get((relation, thing.name, other.name))
            box, beside = where[thing.name], where[other.name]
            if holds is None and measure is not None and box and beside:
                holds = bool(measure(box, beside))
            yield Related(relation, thing.name, other.name, holds)


def _without_needless(named: Sequence[tuple[str, Scene]]) -> list[tuple[str, Scene]]:
    """Leave out what does not hold: what a table does not list is not so, if it lists any."""
    needed = {
        said.relation for _, scene in named for said in scene.related if said.holds is not False
    }
    found = []
    for name, scene in named:
        rows = []
        for said in scene.related:
            if said.holds is not False or said.relation not in needed:
                rows.append(said)
                needed.add(said.relation)
        found.append((name, replace(scene, related=tuple(rows))))
    return found
