"""A camera: light and exposure, blur, fringes of colour, noise, compression."""

from __future__ import annotations

import io
import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

__all__ = ["develop"]

Picture = NDArray[np.float32]

MIDDLE = 0.37  # the light of a scene that a camera shows as it is


def develop(scene: Picture, rng: np.random.Generator, *, sharpness: float) -> Image.Image:
    """Return what a camera on a car makes of a scene.

    Parameters
    ----------
    scene : ndarray of float32, shape (height, width, 3)
        The light that reaches the camera; 1 is white in the middle of the day.
    sharpness : float
        How many pixels of the camera one pixel of the scene stands for: what is far off fills
        few pixels and is blurred more.
    """
    scene = _exposed(scene, rng)
    image = Image.fromarray((np.clip(scene, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8))
    image = _blurred(image, rng, sharpness=sharpness)
    pixels = np.asarray(image)
    if rng.random() < 0.5:
        pixels = _fringed(pixels, rng)
    if sharpness < 1.5 and rng.random() < 0.25:
        pixels = _combed(pixels, rng)
    pixels = _noisy(pixels, rng)
    image = Image.fromarray(pixels)
    if rng.random() < 0.4:
        image = _compressed(image, int(rng.integers(45, 95)))
    return image


def _exposed(scene: Picture, rng: np.random.Generator) -> Picture:
    """Exposure, the colour of the light, haze."""
    # A camera opens for a dark scene and closes for a bright one, though not all the way.
    follows = (MIDDLE / max(float(scene.mean()), 0.02)) ** 0.4
    gain = follows * math.exp(rng.normal(-0.06, 0.3))
    tint = np.exp(rng.normal(0.0, 0.02, 3))
    # White turns to cyan in bright pictures and to brown in dark ones.
    cool = 0.03 + 0.05 * math.log(gain) + rng.normal(0.0, 0.04)
    tint *= np.exp([-1.6 * cool, 0.8 * cool, 0.6 * cool])
    haze = max(0.0, rng.normal(0.01, 0.02)) * np.exp(rng.normal(0.0, 0.08, 3))
    exposed: Picture = scene * (gain * tint).astype(np.float32) + haze.astype(np.float32)
    gamma = rng.uniform(0.9, 1.25)
    grey = exposed.mean(axis=2, keepdims=True)
    exposed = np.maximum(grey + (exposed - grey) * np.float32(rng.uniform(0.75, 1.15)), 0.0)
    return exposed ** np.float32(gamma)


def _blurred(image: Image.Image, rng: np.random.Generator, *, sharpness: float) -> Image.Image:
    radius = rng.gamma(1.6, 0.2) / max(sharpness, 0.6) ** 0.4
    if rng.random() < 0.06:
        radius += rng.uniform(0.4, 1.5)
    image = image.filter(ImageFilter.GaussianBlur(radius))
    if rng.random() < 0.15:
        length = rng.uniform(0.4, 1.8)
        # The car moves along the road, so that most streaks are level.
        across, down = (length, 0.0) if rng.random() < 0.75 else (0.0, length)
        image = image.filter(ImageFilter.BoxBlur((across, down)))
    return image


def _fringed(pixels: NDArray[np.uint8], rng: np.random.Generator) -> NDArray[np.uint8]:
    """Red and blue a pixel beside green, as a mosaic of filters and a cheap lens make them."""
    fringed = pixels.copy()
    for channel, step in ((0, 1), (2, -1)):
        axis = int(rng.integers(2))
        moved = np.roll(pixels[..., channel], step * int(rng.choice([-1, 1])), axis=axis)
        part = rng.uniform(0.3, 1.0)
        mixed = pixels[..., channel] * (1 - part) + moved * part
        fringed[..., channel] = mixed.astype(np.uint8)
    return fringed


def _combed(pixels: NDArray[np.uint8], rng: np.random.Generator) -> NDArray[np.uint8]:
    """Every second row a little to the side: two half pictures, taken one after the other."""
    combed = pixels.copy()
    combed[1::2] = np.roll(pixels[1::2], int(rng.choice([-1, 1])), axis=1)
    part = rng.uniform(0.2, 0.8)
    return (pixels * (1 - part) + combed * part).astype(np.uint8)


def _noisy(pixels: NDArray[np.uint8], rng: np.random.Generator) -> NDArray[np.uint8]:
    level = rng.gamma(1.5, 1.8)
    noise = rng.standard_normal(pixels.shape, dtype=np.float32) * np.float32(level)
    if rng.random() < 0.5:
        noise = np.repeat(noise[..., :1], 3, axis=2)
    return np.clip(pixels + noise, 0.0, 255.0).astype(np.uint8)


def _compressed(image: Image.Image, quality: int) -> Image.Image:
    stream = io.BytesIO()
    image.save(stream, "JPEG", quality=quality)
    stream.seek(0)
    return Image.open(stream, formats=("JPEG",)).convert("RGB")
