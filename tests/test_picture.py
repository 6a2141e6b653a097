"""Pictures of every kind become square arrays; what is no picture is refused in one sentence."""

from __future__ import annotations

import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception.picture import as_picture, read_picture


def refusal(path: Path) -> str:
    """The sentence with which ``path`` is refused, without its folder."""
    with pytest.raises(PictureError) as caught:
        read_picture(path, size=32)
    text = str(caught.value)
    assert str(path) in text
    assert "\n" not in text
    return text.replace(str(path), path.name)


def noise(width: int, height: int, channels: int = 3) -> np.ndarray:
    shape = (height, width, channels) if channels > 1 else (height, width)
    return np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8)


def claim_size(path: Path, width: int, height: int) -> None:
    """A PNG whose header claims a size, with next to nothing behind it."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(b"\0" * 100))
        + chunk(b"IEND", b"")
    )


# What is refused


def test_missing_file(tmp_path: Path) -> None:
    assert refusal(tmp_path / "gone.png") == (
        "gone.png does not exist: check the spelling of the path, upper and lower case included"
    )


def test_folder(tmp_path: Path) -> None:
    (tmp_path / "photos").mkdir()
    assert refusal(tmp_path / "photos") == (
        "photos is a folder, not a picture: give the path of a picture file"
    )


def test_empty_file(tmp_path: Path) -> None:
    (tmp_path / "a.png").touch()
    assert refusal(tmp_path / "a.png") == (
        "a.png is empty (0 bytes): copy the picture again from its source"
    )


@pytest.mark.parametrize("content", [b"name,class\na,b\n", b"<svg></svg>", b"\x00" * 64])
def test_no_picture(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.png").write_bytes(content)
    assert refusal(tmp_path / "a.png") == (
        "a.png is not a picture of a known type: save it as PNG or JPEG"
    )


@pytest.mark.parametrize("kind", ["png", "jpg", "gif", "bmp", "tiff", "webp"])
@pytest.mark.parametrize("share", [0.05, 0.5, 0.8])
def test_file_cut_short(tmp_path: Path, kind: str, share: float) -> None:
    path = tmp_path / f"a.{kind}"
    Image.fromarray(noise(64, 64)).save(path)
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
    text = refusal(path)
    assert "is damaged or cut short" in text or "is not a picture of a known type" in text


def test_damaged_inside(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.fromarray(noise(64, 64)).save(path)
    content = bytearray(path.read_bytes())
    content[200:400] = bytes(200)
    path.write_bytes(content)
    text = refusal(path)
    assert text.startswith("a.png is damaged or cut short (")
    assert text.endswith("): copy the picture again from its source")


@pytest.mark.parametrize("size", [(7, 100), (100, 7), (1, 1)])
def test_tiny(tmp_path: Path, size: tuple[int, int]) -> None:
    Image.new("RGB", size).save(tmp_path / "a.png")
    assert refusal(tmp_path / "a.png") == (
        f"a.png is {size[0]}×{size[1]} pixels, each side must be at least 8: "
        "use the picture in its original size"
    )


def test_enormous_is_refused_from_its_header(tmp_path: Path) -> None:
    claim_size(tmp_path / "a.png", 20_000, 5_001)
    assert refusal(tmp_path / "a.png") == (
        "a.png has 101 megapixels (20000×5001), more than the 100 megapixels that are read: "
        "scale it down first"
    )


def test_bomb(tmp_path: Path) -> None:
    claim_size(tmp_path / "a.png", 60_000, 60_000)
    assert refusal(tmp_path / "a.png") == (
        "a.png has far more than the 100 megapixels that are read: scale it down first"
    )


def test_below_the_limit_pillow_does_not_warn(tmp_path: Path, recwarn: pytest.WarningsRecorder):
    claim_size(tmp_path / "a.png", 19_000, 5_000)
    assert "is damaged or cut short" in refusal(tmp_path / "a.png")
    assert not recwarn.list


def test_size_asked_for() -> None:
    with pytest.raises(PictureError, match="size must be at least 8 pixels, got 4"):
        as_picture(noise(20, 20), size=4)


# What is read


def test_a_picture_of_the_asked_size_is_kept_as_it_is(tmp_path: Path) -> None:
    pixels = noise(32, 32)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    found = read_picture(str(tmp_path / "a.png"), size=32)
    assert found.dtype == np.uint8
    np.testing.assert_array_equal(found, pixels)


def test_greyscale(tmp_path: Path) -> None:
    Image.new("L", (40, 40), 77).save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == 77).all()


def test_bilevel(tmp_path: Path) -> None:
    Image.new("1", (40, 40), 1).save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == 255).all()


@pytest.mark.parametrize("kind", ["png", "tiff", "pgm"])
def test_sixteen_bit_is_scaled_not_clipped(tmp_path: Path, kind: str) -> None:
    grey = np.full((40, 40), 77 * 257, dtype=np.uint16)
    grey[:, 20:] = 200 * 257
    path = tmp_path / f"a.{kind}"
    if kind == "pgm":
        path.write_bytes(b"P5\n40 40\n65535\n" + grey.astype(">u2").tobytes())
    else:
        Image.fromarray(grey).save(path)
    found = read_picture(path, size=40)
    assert found.shape == (40, 40, 3)
    assert (found[:, :20] == 77).all()
    assert (found[:, 20:] == 200).all()


def test_floating_point_file(tmp_path: Path) -> None:
    Image.fromarray(np.full((20, 20), 0.5, dtype=np.float32)).save(tmp_path / "a.tiff")
    found = read_picture(tmp_path / "a.tiff", size=20)
    assert found.shape == (20, 20, 3)
    assert (found == 128).all()


def test_palette(tmp_path: Path) -> None:
    image = Image.new("RGB", (40, 40), (250, 10, 20)).quantize(4)
    assert image.mode == "P"
    image.save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == (250, 10, 20)).all()


@pytest.mark.parametrize("mode", ["RGBA", "LA", "P"])
def test_what_is_transparent_lies_on_white(tmp_path: Path, mode: str) -> None:
    image = Image.new("RGBA", (40, 40), (0, 0, 0, 0))
    if mode == "P":
        index = Image.new("P", (40, 40), 0)
        index.putpalette([0, 0, 0, 9, 9, 9])
        index.save(tmp_path / "a.png", transparency=0)
    else:
        image.convert(mode).save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == 255).all()


def test_half_transparent(tmp_path: Path) -> None:
    Image.new("RGBA", (40, 40), (0, 0, 0, 128)).save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == 127).all()


def test_cmyk(tmp_path: Path) -> None:
    Image.new("CMYK", (40, 40), (0, 255, 255, 0)).save(tmp_path / "a.jpg", quality=95)
    red, green, blue = read_picture(tmp_path / "a.jpg", size=16).reshape(-1, 3).mean(axis=0)
    assert red > 240
    assert green < 15
    assert blue < 15


def test_the_camera_s_rotation_is_applied(tmp_path: Path) -> None:
    pixels = np.zeros((40, 40, 3), dtype=np.uint8)
    pixels[:20] = 255  # light above
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned clockwise by a quarter
    Image.fromarray(pixels).save(tmp_path / "a.png", exif=exif)
    found = read_picture(tmp_path / "a.png", size=40)
    assert (found[:, 20:] == 255).all()
    assert (found[:, :20] == 0).all()


def test_the_first_frame_of_an_animation(tmp_path: Path) -> None:
    frames = [Image.new("RGB", (40, 40), colour) for colour in ("red", "blue")]
    frames[0].save(tmp_path / "a.gif", save_all=True, append_images=frames[1:])
    assert (read_picture(tmp_path / "a.gif", size=16) == (255, 0, 0)).all()


@pytest.mark.parametrize("wide", [True, False])
def test_not_square_is_padded_in_the_colour_of_the_border(tmp_path: Path, wide: bool) -> None:
    pixels = np.full((20, 40, 3), (10, 60, 200), dtype=np.uint8)
    pixels[8:12, 18:22] = 255  # a square thing in the middle
    pixels = pixels if wide else pixels.transpose(1, 0, 2)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    found = read_picture(tmp_path / "a.png", size=40)
    assert (found[[0, 0, -1, -1], [0, -1, 0, -1]] == (10, 60, 200)).all()
    rows, columns = np.nonzero((found == 255).all(axis=2))
    assert np.ptp(rows) == np.ptp(columns) == 3  # still square, in the middle
    assert rows.mean() == columns.mean() == 19.5


def test_very_long_picture(tmp_path: Path) -> None:
    Image.new("RGB", (3000, 8), "red").save(tmp_path / "a.png")
    assert (read_picture(tmp_path / "a.png", size=16) == (255, 0, 0)).all()


@pytest.mark.parametrize("kind", ["png", "jpg"])
def test_fine_patterns_fade_when_scaled_down(tmp_path: Path, kind: str) -> None:
    stripes = np.zeros((560, 560, 3), dtype=np.uint8)
    stripes[:, ::2] = 255
    Image.fromarray(stripes).save(tmp_path / f"a.{kind}", quality=95)
    found = read_picture(tmp_path / f"a.{kind}", size=56)[2:-2, 2:-2].astype(int)
    assert abs(found.mean() - 127.5) < 3
    assert np.ptp(found) < 20  # leaving out pixels would give 0 and 255


# Images and arrays


def test_an_open_image_is_left_open_and_unchanged() -> None:
    image = Image.new("RGB", (40, 20), "red")
    as_picture(image, size=16)
    assert image.size == (40, 20)
    assert image.getpixel((0, 0)) == (255, 0, 0)


@pytest.mark.parametrize(
    "array",
    [
        np.full((20, 20), 128, dtype=np.uint8),
        np.full((20, 20, 1), 128, dtype=np.uint8),
        np.full((20, 20, 3), 128, dtype=np.uint8),
        np.dstack([np.full((20, 20, 3), 128), np.full((20, 20), 255)]).astype(np.uint8),
        np.full((20, 20), 128 * 257, dtype=np.uint16),
        np.full((20, 20, 3), 128 / 255),
        np.full((20, 20), 128 / 255, dtype=np.float32),
    ],
    ids=["grey", "one channel", "rgb", "rgba", "uint16", "float rgb", "float grey"],
)
def test_arrays(array: np.ndarray) -> None:
    assert (as_picture(array, size=16) == 128).all()


def test_array_of_booleans() -> None:
    assert (as_picture(np.ones((20, 20), dtype=bool), size=16) == 255).all()


@pytest.mark.parametrize(
    ("array", "sentence"),
    [
        (
            np.zeros((3, 20, 20)),
            r"its shape is .*, got \(3, 20, 20\): reorder or convert it first",
        ),
        (np.zeros((0, 20)), r"got \(0, 20\)"),
        (np.full((20, 20), 200.0), r"values are in 0\.\.1, got 200\.\.200: divide by"),
        (np.full((20, 20), np.nan), r"values are in 0\.\.1, got nan"),
        (np.zeros((20, 20), dtype=np.int64), r"got int64: convert it with astype"),
        (np.zeros((5, 20)), r"the array is 20×5 pixels"),
    ],
)
def test_arrays_refused(array: np.ndarray, sentence: str) -> None:
    with pytest.raises(PictureError, match=sentence):
        as_picture(array, size=16)


def test_anything_else() -> None:
    with pytest.raises(PictureError, match="must be a path, a Pillow image or a NumPy array, got"):
        as_picture(3, size=16)  # type: ignore[arg-type]


def test_reading_pictures_does_not_import_torch() -> None:
    code = "import sys, seewhy.perception.picture; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
