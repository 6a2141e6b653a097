"""A domain of fruits in a bowl, as somebody may write one, for tests; and one scene of it."""

from __future__ import annotations

import json
from pathlib import Path

DOMAIN = """
[domain]
name = "fruit_bowl"
title = "Fruits in a bowl"
scene = "bowl"
subject = "the bowl"

[classes.fresh]
literal = "fresh(B)"
say = "fresh"
words = ["fresh", "fine", "good"]
verbs = ["keep"]

[classes.spoiled]
literal = "-fresh(B)"
say = "spoiled"
words = ["spoiled", "bad", "off"]
verbs = ["spoil", "go off"]

[things]
sort = "fruit"
most = 6
one = "fruit"
words = ["piece"]

[things.features.species]
words = ["type", "sort", "kind"]

[things.features.species.values]
apple = { nouns = ["apple"] }
pear = { nouns = ["pear"] }
plum = { nouns = ["plum"] }

[things.features.colour]
words = ["color"]

[things.features.ripeness]
ordered = true
how = ["ripe"]

[things.features.rotten.values]
yes = { say = "{it} is rotten", words = ["rotten", "mouldy"] }
no = { say = "{it} is sound", words = ["sound"] }

[things.relations.left]
measure = "left"
say = "{0} is left of {1}"
words = ["left of", "to the left of"]
most = ["leftmost"]
side = ["left"]
converse = "right"

[things.relations.right]
measure = "right"
say = "{0} is right of {1}"
words = ["right of", "to the right of"]
most = ["rightmost"]
side = ["right"]
converse = "left"

[things.relations.touches]
measure = "seen"
say = "{0} touches {1}"
verbs = ["touch"]
words = ["next to", "beside"]
converse = "touches"

[things.conclusions.spoils]
say = "{it} will spoil"
deny = "{it} will keep"
words = ["at risk"]
verbs = ["spoil", "rot", "go bad"]

[things.conclusions.sold]
say = "{it} can be sold"
deny = "{it} cannot be sold"
words = ["good for sale"]
verbs = ["be sold"]
"""

KNOWLEDGE = """
#sort bowl.
#sort fruit = things.
#sort fruits = {apple, pear, plum}.
#sort hue = {red, green, yellow, blue}.
#sort degree = {unripe, ripe, overripe}.
#static species(fruit, fruits).
#static colour(fruit, hue).
#static ripeness(fruit, degree).
#static rotten(fruit).
#static left(fruit, fruit).
#static right(fruit, fruit).
#static touches(fruit, fruit).
#static spoils(fruit).
#static sold(fruit).
#static fresh(bowl).

%% what is rotten spoils
spoils(X) if rotten(X).
%% what touches something rotten spoils
spoils(X) if touches(X, Y), rotten(Y).
%% what is ripe and does not spoil can be sold
sold(X) if ripeness(X, ripe), not spoils(X).

%% no apple is blue
-colour(X, blue) if species(X, apple).

%% a bowl in which something spoils is spoiled
-fresh(B) if bowl(B), spoils(X).
%% a bowl in which nothing spoils is fresh
fresh(B) if bowl(B), not -fresh(B).
"""

SCENE = {
    "scenes": [
        {
            "image_index": 1,
            "objects": [
                {"species": "apple", "colour": "red", "ripeness": "ripe", "rotten": "no"},
                {"species": "pear", "colour": "green", "ripeness": "unripe", "rotten": "no"},
                {"species": "plum", "colour": "blue", "ripeness": "overripe", "rotten": "yes"},
                {"species": "apple", "colour": "green", "ripeness": "ripe", "rotten": "no"},
            ],
            "relationships": {
                "left": [[], [0], [0, 1], [0, 1, 2]],
                "touches": [[1], [0, 2], [1], []],
            },
        }
    ]
}


def write_fruits(folder: Path) -> Path:
    """Write the domain, and its scene beside it; return the domain's folder."""
    mine = folder / "fruit_bowl"
    mine.mkdir()
    (mine / "domain.toml").write_text(DOMAIN, encoding="utf-8")
    (mine / "knowledge.al").write_text(KNOWLEDGE, encoding="utf-8")
    (mine / "questions.toml").write_text("", encoding="utf-8")
    (folder / "scenes.json").write_text(json.dumps(SCENE), encoding="utf-8")
    return mine
