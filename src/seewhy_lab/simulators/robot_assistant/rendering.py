"""Pictures of a room, ray-cast with MuJoCo: no OpenGL, no display."""

from __future__ import annotations

from collections.abc import Iterable

import mujoco
import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.camera import Camera, develop
from seewhy_lab.rendering.lighting import LIGHTS
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.texture import waves
from seewhy_lab.rendering.tracing import trace
from seewhy_lab.rendering.vectors import Array, along, column, unit
from seewhy_lab.simulators.robot_assistant.room import Room
from seewhy_lab.simulators.robot_assistant.solid import Solid, box
from seewhy_lab.simulators.robot_assistant.view import Decor, View

__all__ = ["Built", "render", "visible_pixels"]

_HIGH = 2.5  # The walls, in metres; the ceiling above them is white.


class Built:
    """A room as MuJoCo has it: which solid is what.

    Examples
    --------
    >>> from seewhy_lab.simulators.robot_assistant.room import furnished
    >>> from seewhy_lab.simulators.robot_assistant.view import random_decor, random_view
    >>> rng = np.random.default_rng(0)
    >>> room = furnished({"sofa"}, set(), rng)
    >>> built = Built(room, random_decor(room, rng))
    >>> visible_pixels(built, random_view(room, rng), size=32)["sofa"] > 20
    True
    """

    def __init__(self, room: Room, decor: Decor) -> None:
        self.decor = decor
        self.room = room
        self.names = tuple(sorted(room.names))
        solids = _shell(room, decor)
        owners = [-1] * len(solids)
        for placed in room.placed:
            owner = self.names.index(placed.thing.name) if placed.thing.name else -1
            added = placed.solids
            solids += added
            owners += [owner] * len(added)
        self.owners = np.array(owners)
        model = mujoco.MjModel.from_xml_string(
            f"<mujoco><worldbody>{''.join(map(_xml, solids))}</worldbody></mujoco>"
        )
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        self.scene = Scene(model, data)
        self.colours = np.array([solid.colour for solid in solids], np.float32).T ** 2.2
        self.glow = np.array([solid.glow for solid in solids], np.float32)
        self.gloss = np.array([solid.gloss for solid in solids], np.float32)


def _xml(solid: Solid) -> str:
    size, at, quat = (" ".join(f"{v:.5f}" for v in t) for t in (solid.size, solid.at, solid.quat))
    return f'<geom type="{solid.kind}" size="{size}" pos="{at}" quat="{quat}"/>'


def _shell(room: Room, decor: Decor) -> list[Solid]:
    """Floor, walls and what hangs on these; the floor is the first."""
    wide, deep = room.width, room.depth
    low = 0.5 * deep + 1.0  # The side walls go on behind the camera.
    walls = [
        box((wide + 4.0, deep + 4.0, 0.2), (0.0, 0.0, -0.1), decor.floor),
        box((wide + 0.4, 0.2, _HIGH), (0.0, deep / 2.0 + 0.1, _HIGH / 2.0), decor.wall),
    ]
    for side in (-1.0, 1.0):
        at = (side * (wide / 2.0 + 0.1), (deep / 2.0 - low) / 2.0, _HIGH / 2.0)
        walls.append(box((0.2, deep / 2.0 + low, _HIGH), at, decor.wall))
        at = (side * wide / 2.0, at[1], 0.05)
        walls.append(box((0.03, deep / 2.0 + low, 0.1), at, decor.skirting))
    walls.append(box((wide, 0.03, 0.1), (0.0, deep / 2.0, 0.05), decor.skirting))
    sky, frame = (0.80, 0.88, 0.96), (0.92, 0.92, 0.92)
    if decor.window < 0.6:
        x = (decor.window / 0.3 - 1.0) * (wide / 2.0 - 0.6)
        walls.append(box((1.0, 0.04, 1.05), (x, deep / 2.0, 1.65), frame))
        for pane in (-0.235, 0.235):
            walls.append(box((0.41, 0.05, 0.93), (x + pane, deep / 2.0, 1.65), sky, glow=0.9))
    if decor.picture < 0.4:
        side = -1.0 if decor.picture < 0.2 else 1.0
        at = (side * wide / 2.0, (decor.picture % 0.2) * 5.0 * deep / 2.0 - 0.2, 1.55)
        walls.append(box((0.05, 0.7, 0.5), at, (0.2, 0.2, 0.2)))
        walls.append(box((0.06, 0.62, 0.42), at, decor.picture_colour))
    return walls


def _camera(view: View, size: int) -> Camera:
    # The camera is told what it aims at, from how far: here it stands still and looks on.
    x, y, z = (coordinate + ahead for coordinate, ahead in zip(view.eye, view.forward, strict=True))
    return Camera(
        (x, y, z),
        1.0,
        azimuth=view.azimuth,
        elevation=view.elevation,
        lens=view.lens,
        size=size,
    )


def visible_pixels(built: Built, view: View, *, size: int = 48) -> dict[str, int]:
    """How many pixels of a picture of side `size` show each thing of the room."""
    camera = _camera(view, size)
    rows, columns = np.divmod(np.arange(size * size), size)
    geom, _, _ = built.scene.cast(camera.eye, camera.rays(rows + 0.5, columns + 0.5))
    owner = built.owners[geom[geom >= 0]]
    counts = np.bincount(owner[owner >= 0], minlength=len(built.names))
    return {name: int(count) for name, count in zip(built.names, counts, strict=True)}


def _spread_points(middle: Iterable[float], half: Iterable[float], seed: int) -> Array:
    """Points spread evenly in a cuboid with the given middle and half extents, shape (16, 3)."""
    # Powers of the plastic number's cubic relatives fill a cuboid evenly (Roberts, 2018).
    steps = np.array([0.8191725, 0.6710436, 0.5497005])
    places = (np.arange(LIGHTS)[:, None] * steps + (seed % 997) / 997.0) % 1.0
    return np.asarray(np.array([*middle]) + (2.0 * places - 1.0) * np.array([*half]))


def render(built: Built, view: View, *, size: int = 96) -> NDArray[np.uint8]:
    """The picture of a room, shape (size, size, 3).

    A larger `size` shows the same room in more detail.
    """
    decor, room = built.decor, built.room
    camera = _camera(view, size)
    ceiling = ((0.0, -0.3, _HIGH), (0.55 * room.width, 0.6 * room.depth, 0.02))
    lights = np.stack(
        [
            _spread_points(decor.light, decor.spread, decor.texture),
            _spread_points(*ceiling, decor.texture // 7),
        ]
    )
    light = trace(
        built.scene,
        camera,
        lights,
        shade=lambda hits, shares: _shade(built, hits, camera.eye, *shares),
        background=lambda rays, _: np.full((len(rays), 3), 0.7 * decor.fill + 0.25, np.float32),
    )
    rng = np.random.default_rng([decor.texture, 1])
    return develop(light, rng, exposure=decor.exposure, vignette=decor.vignette, noise=decor.noise)


def _floor(built: Built, at: Array) -> Array:
    """How much lighter or darker the floor is at places of shape (3, n)."""
    decor = built.decor
    rng = np.random.default_rng(decor.texture)
    tone = 1.0 + 0.06 * waves(at, rng, wavelength=0.5)
    if decor.floor_kind == "carpet":
        return np.asarray(tone + 0.05 * waves(at, rng, wavelength=0.05, count=6))
    rows = at[0] / decor.pitch
    if decor.floor_kind == "boards":
        board = np.floor(rows)
        tone *= 1.0 + 0.10 * np.sin(board * 12.9898 + decor.texture % 7)
        joint = np.minimum(rows - board, board + 1.0 - rows) * decor.pitch
    else:
        columns = at[1] / decor.pitch
        joint = (
            np.minimum(np.abs(rows - np.round(rows)), np.abs(columns - np.round(columns)))
            * decor.pitch
        )
    return np.asarray(tone * (1.0 - 0.35 * np.clip(1.0 - joint / 0.012, 0.0, 1.0)))


def _shade(built: Built, hits: Hits, eye: Array, lit: Array, open_sky: Array) -> Array:
    """The light that leaves each point towards `eye`, linear, shape (n, 3)."""
    decor = built.decor
    albedo = built.colours[:, hits.geom]
    floor = np.flatnonzero(hits.geom == 0)
    normal = np.ascontiguousarray(hits.normal.T, dtype=np.float32)
    point = np.ascontiguousarray(hits.point.T, dtype=np.float32)
    albedo[:, floor] *= _floor(built, point[:, floor])
    towards = column(decor.light) - point
    # A lamp of some size: what is close to it does not burn out.
    weaker = 4.0 / (1.5 + along(towards, towards))
    towards = unit(towards)
    direct = np.maximum(along(normal, towards), 0.0) * lit.astype(np.float32) * weaker
    # Light comes from the ceiling, and from the walls even where the ceiling is hidden.
    fill = decor.fill * (0.30 + open_sky.astype(np.float32) * (0.45 + 0.30 * normal[2]))
    floor_light = column(decor.floor) ** 2.2
    bounce = 0.22 * np.exp(-np.abs(point[2]) / 0.5) * (1.0 - normal[2]) * floor_light
    light = direct * column(decor.light_colour) + fill + bounce
    back = unit(column(eye) - point)
    shine = (
        np.maximum(along(normal, unit(back + towards)), 0.0) ** 30 * lit * built.gloss[hits.geom]
    )
    colour = albedo * (light + built.glow[hits.geom]) + 0.5 * shine
    return np.asarray(colour.T, np.float32)
