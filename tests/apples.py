"""A small domain of apples, annotated apples, and an agent without networks."""

from __future__ import annotations

from itertools import product
from pathlib import Path

from PIL import Image

from conftest import write_domain
from seewhy.agent.agent import Agent
from seewhy.domain.domain import Domain
from seewhy.knowledge.scene import FeatureVector

DOMAIN = """\
[domain]
name = "apples"
title = "Apples"
scene = "apple"
subject = "the apple"

[features.kind]
name = "kind"

[features.kind.values]
green = { say = "{it} is green", change = "take a green one" }
red = { say = "{it} is red", change = "take a red one" }
russet = { say = "{it} is a russet", change = "take a russet" }

[features.brown]
name = "brown"

[features.brown.values]
yes = { say = "{it} is brown", change = "take one that is not brown" }
no = { say = "{it} is not brown", change = "take one that is not brown" }

[features.soft]
name = "softness"

[features.soft.values]
yes = { say = "{it} is soft", words = ["soft"], change = "take a soft one" }
no = { say = "{it} is firm", words = ["firm"], change = "take a firm one" }

[classes.fresh]
literal = "fresh(A)"
say = "fresh"

[classes.spoilt]
literal = "-fresh(A)"
say = "spoilt"
"""

KNOWLEDGE = """\
% What the shop knows of apples.      (Do not reformat!)
#sort apple.
#sort sort_of_apple = {green, red, russet}.
#static kind(apple, sort_of_apple).
#static brown(apple).
#static soft(apple).
#static fresh(apple).

%% a brown apple
%% is spoilt.
-fresh(A) if
    brown(A)   % said by the buyer
    .

%% a firm apple that is not brown is fresh
fresh(X) if -soft(X),   -brown(X).
"""


QUESTIONS = """\
[[question]]
asks = "is_class"
patterns = ["is {it} {class}"]

[[question]]
asks = "why_class"
patterns = ["why is {it} {class}"]
"""


def class_of(vector: FeatureVector) -> str:
    """What apples really are: brown ones are spoilt, but firm russets; soft ones are, too."""
    kind, brown, soft = vector
    return "spoilt" if soft == "yes" or (brown == "yes" and kind != "russet") else "fresh"


VECTORS: tuple[FeatureVector, ...] = tuple(
    product(("green", "red", "russet"), ("yes", "no"), ("yes", "no"))
)


def write_apples(folder: Path, *, knowledge: str = KNOWLEDGE) -> Path:
    """Write the domain; line ends stay as ``knowledge`` has them."""
    return write_domain(folder, domain=DOMAIN, knowledge=knowledge, questions=QUESTIONS)


def write_apple_pictures(folder: Path, *, times: int = 2) -> Path:
    """Write a picture of every apple so many times, and what is annotated of them."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["image,class,kind,brown,soft"]
    for number, vector in enumerate(VECTORS * times):
        name = f"{number:02d}.png"
        Image.new("RGB", (8, 8), (7 * number, 90, 30)).save(folder / name)
        lines.append(",".join([name, class_of(vector), *map(str, vector)]))
    (folder / "scenes.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder


def apple_agent(domain: Domain, *, taught: bool = True) -> Agent:
    """An agent that sees nothing; its tree has seen every apple where it is taught."""
    agent = Agent(domain)
    if taught:
        agent.fit_induction(VECTORS, [class_of(vector) for vector in VECTORS], answers=False)
    return agent
