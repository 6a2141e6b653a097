"""Pictures of every kind become square arrays; what is no picture is refused in one sentence."""

from __future__ import annotations

import ast
import struct
import subprocess
import sys
import threading
import time
import warnings
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from seewhy.errors import PictureError
from seewhy.perception import picture, picture_bands, picture_file
from seewhy.perception.greys import of_eight_bits
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


@pytest.mark.parametrize("content", [b"name,class\na,b\n", b"<html>", b"\x00" * 64])
def test_no_picture(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.png").write_bytes(content)
    assert refusal(tmp_path / "a.png") == (
        "a.png is not a picture of a known type: save it as PNG or JPEG"
    )


POSTSCRIPT = "a.png is PostScript (EPS), a program and no picture: save it as PNG or JPEG"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 40 40\nshowpage\n", POSTSCRIPT),
        (b"\x04%!PS-Adobe-3.0\nshowpage\n", POSTSCRIPT),
        (b"\xc5\xd0\xd3\xc6" + bytes(28) + b"%!PS-Adobe-3.0 EPSF-3.0\n", POSTSCRIPT),
        (
            b"\xd7\xcd\xc6\x9a" + bytes(60),
            "a.png is a Windows metafile (WMF), a program and no picture: save it as PNG or JPEG",
        ),
        (
            b"\x01\x00\x00\x00" + bytes(36) + b" EMF" + bytes(60),
            "a.png is a Windows metafile (EMF), a program and no picture: save it as PNG or JPEG",
        ),
        (b"%PDF-1.7\n", "a.png is a PDF document, no picture: save it as PNG or JPEG"),
        (b"<svg></svg>", "a.png is an SVG drawing, which is not read: save it as PNG or JPEG"),
        (
            b'<?xml version="1.0"?>\n<svg></svg>',
            "a.png is an SVG drawing, which is not read: save it as PNG or JPEG",
        ),
        (
            b"\0\0\0\x20ftypheic" + bytes(60),
            "a.png is a HEIC or AVIF picture, which is not read: save it as PNG or JPEG",
        ),
        (bytes(128) + b"DICM", "a.png is a DICOM file, which is not read: save it as PNG or JPEG"),
    ],
)
def test_what_is_no_picture_is_named(tmp_path: Path, content: bytes, sentence: str) -> None:
    (tmp_path / "a.png").write_bytes(content)
    assert refusal(tmp_path / "a.png") == sentence


@pytest.mark.parametrize("ending", ["eps", "ico", "jp2", "tga", "pcx", "ppm"])
def test_only_formats_that_are_named_are_tried(tmp_path: Path, ending: str) -> None:
    """Whatever Pillow could write and read beside them is refused, however it is called."""
    Image.fromarray(noise(32, 32)).save(tmp_path / f"a.{ending}")
    for name in (f"a.{ending}", "a.png"):
        (tmp_path / name).write_bytes((tmp_path / f"a.{ending}").read_bytes())
        if ending == "ppm":
            assert read_picture(tmp_path / name, size=32).shape == (32, 32, 3)
        else:
            assert "save it as PNG or JPEG" in refusal(tmp_path / name)


def test_every_call_of_pillow_names_its_formats() -> None:
    """A picture of unknown origin must not choose the decoder that reads it."""
    root = Path(__file__).parents[1]
    calls = [
        (file.name, node)
        for folder in ("src", "benchmarks")
        for file in (root / folder).rglob("*.py")
        if "Image" in (text := file.read_text(encoding="utf-8")) and ".open(" in text
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("Image.open")
    ]
    assert calls
    for name, call in calls:
        assert "formats" in {keyword.arg for keyword in call.keywords}, f"{name}:{call.lineno}"


def test_a_jpeg_of_a_thousand_scans(tmp_path: Path) -> None:
    """Each would be a pass over the whole picture, for a hundred bytes."""
    path = tmp_path / "a.jpg"
    Image.new("RGB", (400, 400)).save(path, progressive=True)
    content = path.read_bytes()
    scan = content[content.rindex(b"\xff\xda") : -2]
    path.write_bytes(content[:-2] + scan * 20 + b"\xff\xd9")
    assert read_picture(path, size=16).shape == (16, 16, 3)
    path.write_bytes(content[:-2] + scan * 1000 + b"\xff\xd9")
    assert refusal(path) == (
        "a.jpg is a JPEG of more than 50 scans, as no camera writes it: save it again as PNG or "
        "JPEG"
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


@pytest.mark.parametrize(
    ("dtype", "white"),
    [
        (np.uint16, 255),
        (np.uint16, 4095),
        (np.uint16, 65535),
        (np.int32, 255),
        (np.int32, 4095),
        (np.int32, 65535),
        (np.int32, 1_000_000),
        (np.float32, 1),
        (np.float32, 255),
        (np.float32, 4095),
        (np.float32, 65535),
    ],
)
def test_greys_are_scaled_by_their_range(tmp_path: Path, dtype: type, white: int) -> None:
    grey = np.linspace(0, white, 40)[None].repeat(40, axis=0).astype(dtype)
    Image.fromarray(grey).save(tmp_path / "a.tiff")
    found = read_picture(tmp_path / "a.tiff", size=40)[..., 0]
    np.testing.assert_allclose(found, grey * (255.0 / white), atol=0.51)
    if dtype == np.uint16:
        np.testing.assert_array_equal(as_picture(grey, size=40)[..., 0], found)


def test_a_dark_picture_that_says_its_range_stays_dark(tmp_path: Path) -> None:
    grey = np.full((40, 40), 257, dtype=">u2")
    (tmp_path / "a.pgm").write_bytes(b"P5\n40 40\n65535\n" + grey.tobytes())
    assert (read_picture(tmp_path / "a.pgm", size=40) == 1).all()


def test_what_is_no_number_is_black_and_what_is_endless_white(tmp_path: Path) -> None:
    grey = np.full((40, 40), 0.5, dtype=np.float32)
    grey[:10], grey[10:20], grey[20:30] = np.nan, np.inf, -np.inf
    Image.fromarray(grey).save(tmp_path / "a.tiff")
    found = read_picture(tmp_path / "a.tiff", size=40)[..., 0]
    assert [int(found[row, 5]) for row in (5, 15, 25, 35)] == [0, 255, 0, 128]
    Image.fromarray(np.full((40, 40), np.nan, dtype=np.float32)).save(tmp_path / "a.tiff")
    assert refusal(tmp_path / "a.tiff") == (
        "a.tiff has no pixel that is a number: save it as PNG or JPEG"
    )


def test_a_signalling_nan_is_black_without_a_warning() -> None:
    bits = np.array([[0x7F800001, 0x3F000000]], dtype=np.uint32)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seen = of_eight_bits(bits.view(np.float32), 1.0)
    assert np.asarray(seen).tolist() == [[0, 128]]


def colours_of_16_bits(path: Path, value: int) -> None:
    row = b"\0" + struct.pack(">HHH", value, value // 2, 0) * 40

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", 40, 40, 16, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(row * 40))
        + chunk(b"IEND", b"")
    )


def test_colours_of_16_bits(tmp_path: Path) -> None:
    """Pillow keeps the upper half of each; of 12 bits in 16 that is nearly nothing."""
    colours_of_16_bits(tmp_path / "a.png", 0xFF00)
    assert (read_picture(tmp_path / "a.png", size=40) == (255, 127, 0)).all()
    colours_of_16_bits(tmp_path / "a.png", 0)
    assert (read_picture(tmp_path / "a.png", size=40) == 0).all()
    colours_of_16_bits(tmp_path / "a.png", 4095)
    assert refusal(tmp_path / "a.png") == (
        "a.png has colours of 16 bits and is nearly black, as pictures of 12 bits in 16 are: "
        "spread its values over the whole range, or save it with 8 bits a colour"
    )


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


# Large pictures


@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "P", "I;16", "F"])
@pytest.mark.parametrize("turned", [False, True])
def test_large_pictures_are_reduced_in_bands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mode: str, turned: bool
) -> None:
    """What is read of a picture hardly depends on whether it is reduced before."""
    soft = Image.fromarray(noise(9, 7)).resize((910, 707), Image.Resampling.BICUBIC)
    if mode in ("I;16", "F"):
        image = Image.fromarray(
            np.asarray(soft.convert("L")).astype(np.uint16 if mode == "I;16" else np.float32) * 200
        )
    else:
        image = soft.quantize(64) if mode == "P" else soft.convert(mode)
    if mode == "RGBA":
        image.putalpha(Image.linear_gradient("L").resize(image.size))
    exif = Image.Exif()
    exif[0x0112] = 6 if turned else 1
    image.save(tmp_path / "a.tiff", exif=exif)
    whole = read_picture(tmp_path / "a.tiff", size=32).astype(int)
    monkeypatch.setattr(picture, "_KEPT_WHOLE", 0)
    monkeypatch.setattr(picture_bands, "_BAND", 30_000)
    reduced = read_picture(tmp_path / "a.tiff", size=32).astype(int)
    assert np.abs(whole - reduced).max() <= 3


def test_large_pictures_take_bounded_memory(tmp_path: Path) -> None:
    """Of 30 megapixels in 16 bits with opacity, less than a third of what a plain way takes."""
    Image.new("RGBA", (6000, 5000), (9, 8, 7, 6)).save(tmp_path / "a.png", compress_level=1)
    code = (
        "import resource, sys; from seewhy.perception.picture import read_picture;"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss;"
        "read_picture(sys.argv[1], size=224);"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "a.png")]
    found = subprocess.run(command, check=True, capture_output=True)
    assert int(found.stdout) < 200 * 1024


def test_what_takes_too_much_memory_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_file, "MOST_MEMORY", 2**20)
    Image.new("L", (800, 800)).save(tmp_path / "a.png")
    assert "which take 0.0 GiB of memory to decode as PNG, more than" in refusal(tmp_path / "a.png")


def test_threads_share_the_memory() -> None:
    room = picture_file._Room(10)
    taken, most = 0, 0
    lock = threading.Lock()

    def take(number: int) -> None:
        nonlocal taken, most
        with room.taken(number):
            with lock:
                taken += number
                most = max(most, taken)
            time.sleep(0.002)
            with lock:
                taken -= number

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(take, [6, 3, 10, 4, 1, 5] * 5))
    assert (taken, room._free) == (0, 10)
    assert most == 10


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
