"""Draw boxes for things in the studio with a browser, and take pictures of the page.

    python -m seewhy_lab studio_boxes --out runs/boxes --screenshots docs/pictures/studio

Things on a table are drawn plainly, so that no photograph is needed; the domain is a copy of the
bundled ``tabletop``. Boxes are drawn by mouse and what they show is said by keys, as somebody
would; then the tables that the studio wrote are compared with what was drawn.
"""

from __future__ import annotations

import argparse
import csv
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import sync_playwright

from seewhy.domain.domain import load_domain
from seewhy.domain.folder import domain_folder
from seewhy_lab.walk.camera import Camera
from seewhy_lab.walk.serving import chromium, running_studio
from seewhy_lab.walk.table_pictures import DrawnBody, drawn_table, some_bodies

if TYPE_CHECKING:
    from playwright.sync_api import Page

_DOMAIN = "tabletop"
_THINGS = 4
_FEATURES = ("size", "colour", "material", "shape")


def options_of(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        "python -m seewhy_lab studio_boxes",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--pictures", type=int, default=2, help="how many are drawn in")
    parser.add_argument("--out", type=Path, required=True, help="the project; made anew")
    parser.add_argument("--screenshots", type=Path, help="where small pictures of the page go")
    return parser.parse_args(arguments)


def write_project(folder: Path, count: int) -> dict[str, list[DrawnBody]]:
    """Write pictures and the domain; return picture → its things."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copytree(domain_folder(_DOMAIN), folder / _DOMAIN)
    bodies = {f"table{seed}.png": some_bodies(_THINGS, seed=seed) for seed in range(count)}
    for name, things in bodies.items():
        drawn_table(things).save(folder / name)
    return bodies


def draw_boxes(page: Page, address: str, picture: str, bodies: Sequence[DrawnBody]) -> None:
    """Draw the box of each thing, and say its features by keys."""
    things = load_domain(_DOMAIN).things
    assert things is not None
    page.goto(f"{address}/label?picture={picture}")
    for number, body in enumerate(bodies, start=1):
        left, top, right, bottom = body.box
        for x, y, act in ((left, top, page.mouse.down), (right, bottom, page.mouse.up)):
            page.mouse.move(*_on_screen(page, x, y), steps=4)
            act()
        page.wait_for_selector(f".box.chosen[data-thing='{number}']")
        for key, feature in things.features.items():
            value = getattr(body, key)
            page.keyboard.press(str(feature.values.index(value) + 1))
            page.wait_for_selector(f"button.chosen[value='{key}={value}']")
        page.keyboard.press("Escape")
        page.wait_for_selector("#boxes:not([data-chosen])")


def _on_screen(page: Page, x: float, y: float) -> tuple[float, float]:
    """Where a pixel of the picture is shown."""
    across, down = page.evaluate(
        """([x, y]) => {
          const drawn = document.getElementById("boxes").getScreenCTM();
          const shown = new DOMPoint(x, y).matrixTransform(drawn);
          return [shown.x, shown.y];
        }""",
        [x, y],
    )
    return float(across), float(down)


def compared(table: Path, bodies: dict[str, list[DrawnBody]]) -> tuple[int, int, float]:
    """Return how many things stand in the table, how many are right, and the widest miss."""
    with table.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    right, widest = 0, 0.0
    for row in rows:
        body = bodies[row["image"]][int(row["thing"]) - 1]
        right += all(
            row[key] == getattr(body, key) for key in ("size", "colour", "material", "shape")
        )
        corners = zip(("left", "top", "right", "bottom"), body.box, strict=True)
        widest = max(widest, *(abs(float(row[corner]) - place) for corner, place in corners))
    return len(rows), right, widest


def main() -> None:
    """Draw, and print what stands in the table."""
    options = options_of()
    project = options.out / "table"
    bodies = write_project(project, options.pictures)
    problems: list[str] = []
    with running_studio(project, options.out / "studio.log") as address, sync_playwright() as used:
        browser = used.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(120_000)
        page.on(
            "console", lambda said: problems.append(said.text) if said.type == "error" else None
        )
        for picture, things in bodies.items():
            draw_boxes(page, address, picture, things)
        if options.screenshots:
            page.goto(f"{address}/label?picture={next(iter(bodies))}&thing=2")
            Camera(page, options.screenshots)("boxes")
        browser.close()
    count, right, widest = compared(project / "things.csv", bodies)
    print(f"{count} things drawn; all features of {right} are as drawn")
    print(f"corners are at most {widest:g} pixels beside those of the picture")
    print("errors of the browser:", *problems or ["none"])


if __name__ == "__main__":
    main()
