"""A photograph of a sign: it stands before a background, in some light, and is cut out."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from seewhy.perception.picture_file import SMALLEST_SIDE
from seewhy_lab.simulators.traffic_signs.backgrounds import background, mottled
from seewhy_lab.simulators.traffic_signs.camera import develop
from seewhy_lab.simulators.traffic_signs.pose import Crop, Pose, crop_around, random_pose
from seewhy_lab.simulators.traffic_signs.sign import Color, Face, Patch
from seewhy_lab.simulators.traffic_signs.surroundings import in_front, supports

__all__ = ["photograph", "photograph_scene"]

Picture = NDArray[np.float32]

_FINER = 3
"""Edges are drawn on a grid this much finer than the camera's."""


def photograph(face: Face, rng: np.random.Generator, *, size: int) -> NDArray[np.uint8]:
    """Return a photograph of a sign, cut out close around it.

    A sign that is not as wide as it is tall, or seen from the side, is cut out like that.

    Parameters
    ----------
    face : Face
    rng : numpy.random.Generator
        Chooses the pose, the light, the background and the camera.
    size : int
        Longer side of the result in pixels.
    """
    pose = random_pose(rng)
    crop = crop_around(pose.project(face.outline), rng)
    # The camera's own picture is mostly larger than what a network looks at.
    longer = float(np.clip(rng.lognormal(math.log(84), 0.42), 26, 2 * size))
    scale = longer / max(crop.width, crop.height)
    width, height = (max(12, round(side * scale)) for side in (crop.width, crop.height))
    layer = [*supports(face.outline, rng), *face.patches]
    color, mask = _drawn(layer, pose, crop, width, height)
    scene = background(rng, width, height)
    lit = _weathered(color, rng)
    lit = _lit(lit, rng)
    scene = scene + (lit - scene) * mask
    hiding = in_front(face.outline, rng)
    if hiding:
        color, mask = _drawn(hiding, pose, crop, width, height)
        scene = scene + (color - scene) * mask
    return photograph_scene(scene, rng, size=size)


def photograph_scene(scene: Picture, rng: np.random.Generator, *, size: int) -> NDArray[np.uint8]:
    """Return the photograph of what lies before the camera, ``size`` pixels on its longer side."""
    image = _beyond_the_edge(develop(scene, rng, sharpness=max(scene.shape[:2]) / size), rng)
    scale = size / max(image.size)
    width, height = (max(SMALLEST_SIDE, round(side * scale)) for side in image.size)
    return np.array(image.resize((width, height), Image.Resampling.BICUBIC))


def _drawn(
    patches: Iterable[Patch], pose: Pose, crop: Crop, width: int, height: int
) -> tuple[Picture, Picture]:
    """The colours of patches, and how much of each pixel they cover."""
    size = (width * _FINER, height * _FINER)
    color, mask = Image.new("RGB", size), Image.new("L", size)
    pen, stencil = ImageDraw.Draw(color), ImageDraw.Draw(mask)
    factor = np.array([size[0] / crop.width, size[1] / crop.height])
    for patch in patches:
        points = (pose.project(patch.points) - (crop.left, crop.top)) * factor
        corners = points.ravel().tolist()
        pen.polygon(corners, fill=_bytes(patch.color))
        stencil.polygon(corners, fill=255)
    covered = np.asarray(mask.reduce(_FINER), np.float32)[..., None] / np.float32(255)
    shown = np.asarray(color.reduce(_FINER), np.float32) / np.float32(255)
    # Where a pixel is covered in part, what is not covered counts as black in the mean.
    return shown / np.maximum(covered, np.float32(1 / 255)), covered


def _bytes(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in color)
    return red, green, blue


def _weathered(color: Picture, rng: np.random.Generator) -> Picture:
    """Paint fades in the sun and dirt runs down."""
    height, width = color.shape[:2]
    faded = max(0.0, rng.normal(0.0, 0.07)) if rng.random() > 0.06 else rng.uniform(0.2, 0.7)
    if faded:
        pale = np.array([0.78, 0.80, 0.77], np.float32) * np.float32(rng.uniform(0.7, 1.1))
        color = color + (pale - color) * np.float32(faded)
    if rng.random() < 0.3:
        dirt = mottled(rng, width, height, cells=rng.uniform(1.5, 6), rough=0.7)
        amount = np.clip(dirt * 0.5, 0, 1) * np.float32(rng.uniform(0.05, 0.5))
        soil = np.array([0.33, 0.33, 0.25], np.float32)
        color = color + (soil - color) * amount[..., None]
    return color


def _lit(color: Picture, rng: np.random.Generator) -> Picture:
    """Sun or shade on the plate, the shadows of leaves, the shine of the sky."""
    height, width = color.shape[:2]
    strength = math.exp(rng.normal(-0.02, 0.34))
    rows, columns = np.mgrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    slope = rng.normal(0.0, 0.06, 2)
    light = strength * (1.0 + slope[0] * rows + slope[1] * columns)
    pick = rng.random()
    if pick < 0.1:
        shadow = mottled(rng, width, height, cells=rng.uniform(1.5, 6), rough=0.5)
        light = light * np.where(shadow > rng.normal(0.3, 0.6), rng.uniform(0.3, 0.75), 1.0)
    elif pick < 0.14:
        angle = rng.uniform(0.0, 2.0 * math.pi)
        beyond = math.cos(angle) * columns + math.sin(angle) * rows > rng.normal(0.0, 0.4)
        light = light * np.where(beyond, rng.uniform(0.4, 0.8), 1.0)
    lit: Picture = color * light.astype(np.float32)[..., None]
    if rng.random() < 0.12:
        at, wide = rng.normal(0.0, 0.5, 2), rng.uniform(0.3, 1.2)
        shine = np.exp(-((rows - at[0]) ** 2 + (columns - at[1]) ** 2) / wide**2)
        lit = lit + (rng.uniform(0.05, 0.5) * shine).astype(np.float32)[..., None]
    return lit


def _beyond_the_edge(image: Image.Image, rng: np.random.Generator) -> Image.Image:
    """Where the cut goes beyond the camera's picture it is black."""
    if rng.random() >= 0.06:
        return image
    pixels = np.array(image)
    rows, columns = pixels.shape[:2]
    part = rng.exponential(0.05)
    side = rng.random()
    if side < 0.35:
        pixels[: math.ceil(part * rows)] = 0
    elif side < 0.6:
        pixels[:, : math.ceil(part * columns)] = 0
    else:
        pixels[:, -math.ceil(part * columns) :] = 0
    return Image.fromarray(pixels)
