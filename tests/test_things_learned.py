"""Axioms about things, learned from annotated scenes: found, said, written, judged, refuted."""

from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import seewhy
from conftest import Run
from desk_builder import Desk, random_desk, write_desks, write_domain
from seewhy.agent.things.concluded import concluded_of_things, where_axioms_speak
from seewhy.data.dataset import Dataset
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing import Related as SaidRelated
from seewhy.data.thing import Thing
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, RevisionError
from seewhy.induction.axiom_learning import Fate
from seewhy.induction.things.conditions import (
    Alike,
    Alone,
    Atom,
    Condition,
    Grouped,
    HasValue,
    Pattern,
    Related,
    There,
    ThingRule,
    Whole,
    is_expressible,
)
from seewhy.induction.things.coverage import where
from seewhy.induction.things.description_length import exception_bits
from seewhy.induction.things.pattern_search import Contrast, PatternSearch
from seewhy.induction.things.rule_learning import (
    ThingLearningOptions,
    classified,
    learn_thing_rules,
)
from seewhy.induction.things.rule_sentence import say_condition, say_thing_rule
from seewhy.induction.things.rule_text import thing_rule_statement
from seewhy.induction.things.thing_table import ThingTable, as_bits, thing_table
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.scene import FeatureVector
from seewhy.revision.knowledge_text import with_learned

RED, BALL = HasValue(0, "colour", "red"), HasValue(0, "form", "ball")
LARGE = HasValue(1, "size", "large")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_domain(tmp_path_factory.mktemp("desk") / "desk")


@pytest.fixture(scope="module")
def domain(folder: Path) -> Domain:
    return load_domain(folder)


def red_on_large(desk: Desk) -> bool:
    return any(
        desk.things[above]["colour"] == "red" and desk.things[below]["size"] == "large"
        for above, below in desk.on
    )


def vector_of(domain: Domain, desk: Desk, light: str | None = None) -> FeatureVector:
    things = [Thing(str(number), values) for number, values in enumerate(desk.things)]
    said = [
        SaidRelated(relation, str(a), str(b), (a, b) in getattr(desk, relation))
        for relation in ("on", "touches")
        for a in range(len(things))
        for b in range(len(things))
        if a != b
    ]
    return vector_with_things(domain, (light,), things, said)


def scenes(domain: Domain, count: int, seed: int) -> tuple[list[Desk], ThingTable]:
    generator = np.random.default_rng(seed)
    desks = [random_desk(generator) for _ in range(count)]
    assert domain.things is not None
    vectors = [vector_of(domain, desk) for desk in desks]
    concluded = concluded_of_things(domain, vectors)
    return desks, thing_table(domain.things, domain.schema, vectors, concluded=concluded)


def random_pattern(generator: np.random.Generator) -> Pattern:
    """Any pattern: each atom of any kind, of any of its things."""
    things = int(generator.integers(1, 4))
    atoms: list[Atom] = []
    for _ in range(int(generator.integers(1, 5))):
        one, other, *_ = generator.permutation(3).tolist()
        kinds: list[Atom] = [
            HasValue(one, "colour", "red", bool(generator.integers(2))),
            HasValue(one, "form", "ball"),
            HasValue(one, "heavy", ("yes", "no")[generator.integers(2)]),
            HasValue(one, "free", ("yes", "no")[generator.integers(2)]),
            Alone(one, "touches", bool(generator.integers(2))),
            Related(one, other, ("on", "touches", "above")[generator.integers(3)]),
            Alike(*sorted((one, other)), "colour", bool(generator.integers(2))),
            Alike(*sorted((one, other)), "size", bool(generator.integers(2))),
            Grouped((0, 1, 2), "row"),
        ]
        atoms.append(kinds[generator.integers(len(kinds))])
    kept = [atom for atom in atoms if max(atom.things) < things]
    return Pattern.of(things, kept)


def test_an_axiom_says_in_the_language_what_its_rule_finds_in_scenes(domain: Domain) -> None:
    """Every kind of condition, alone and together: the reasoner agrees with the table."""
    generator = np.random.default_rng(0)
    assert domain.things is not None
    lights = ("bright", "dim", None)
    vectors = [
        vector_of(domain, random_desk(generator), lights[number % 3]) for number in range(24)
    ]
    concluded = concluded_of_things(domain, vectors)
    table = thing_table(domain.things, domain.schema, vectors, concluded=concluded)
    rules: list[tuple[Condition, ...]] = []
    while len(rules) < 40:
        conditions: list[Condition] = []
        for _ in range(int(generator.integers(1, 4))):
            pattern = random_pattern(generator)
            least = int(generator.integers(2, 4)) if pattern.things == 1 else 1
            there = There(pattern, least * int(generator.integers(2)) or 1)
            holds = bool(generator.integers(2))
            whole = Whole("light", "dim", holds)
            conditions.append(
                whole if generator.random() < 0.1 else there if holds else there.denied
            )
        if is_expressible(conditions):
            rules.append(tuple(conditions))
    signature = domain.knowledge.signature
    text = "\n".join(
        thing_rule_statement(ThingRule("good", rule), domain.things, domain.schema, signature)
        for rule in rules
    )
    speaking = where_axioms_speak(domain, read_axioms(text, signature), vectors)
    some = 0
    for rule, speaks, line in zip(rules, speaking, text.splitlines(), strict=True):
        expected = table.all_scenes
        for condition in rule:
            expected = expected & where(table, condition)
        assert as_bits(speaks).tolist() == expected.tolist(), line
        some += 0 < speaks.sum() < len(vectors)
    assert some > 10


@pytest.mark.parametrize(
    ("condition", "said", "written"),
    [
        (
            There(Pattern.of(2, [RED, BALL, LARGE, Related(0, 1, "on")])),
            "there is a red ball that is on a large thing",
            "on(X, Y), colour(X, red), form(X, ball), size(Y, large)",
        ),
        (
            There(Pattern.of(2, [RED, Related(0, 1, "touches"), Alike(0, 1, "size")])),
            "there is a red thing that touches a thing of the same size",
            "touches(X, Y), colour(X, red), size(X, Size1), size(Y, Size1)",
        ),
        (
            There(Pattern.of(3, [Alike(0, 1, "colour"), Alike(1, 2, "colour")]), holds=False),
            "there are no three things of the same colour",
            "#count { U, V, W : colour(U, Colour1), colour(V, Colour1), colour(W, Colour1), "
            "U != V, U != W, V != W } = 0",
        ),
        (
            There(Pattern.of(2, [Alike(0, 1, "colour", holds=False), Alike(0, 1, "size")])),
            "there are two things of the same size that differ in colour",
            "colour(X, Colour1), colour(Y, Colour2), Colour1 != Colour2, size(X, Size3), "
            "size(Y, Size3)",
        ),
        (
            There(Pattern.of(1, [BALL, HasValue(0, "colour", "red", holds=False)]), holds=False),
            "every ball is red",
            "#count { U : -colour(U, red), form(U, ball) } = 0",
        ),
        (
            There(Pattern.of(1, [HasValue(0, "heavy", "no")]), 3, holds=False),
            "there are at most two light things",
            "#count { U : -heavy(U) } < 3",
        ),
        (
            There(Pattern.of(1, [RED, Alone(0, "on")])),
            "there is a red thing such that nothing is on it",
            "#count { U1 : on(U1, X) } = 0, colour(X, red)",
        ),
        (
            There(Pattern.of(1, [HasValue(0, "free", "no"), Alone(0, "on", inverse=True)])),
            "there is a thing that is on nothing and not free",
            "thing(X), #count { U1 : on(X, U1) } = 0, not free(X)",
        ),
        (
            There(Pattern.of(3, [Grouped((0, 1, 2), "row"), RED])),
            "there is a red thing such that it, a thing and a thing are a row",
            "",
        ),
        (Whole("light", "dim", holds=False), "it is not so that the light is dim",
         "-light(S, dim)"),
    ],
)  # fmt: skip
def test_conditions_are_said_and_written(
    domain: Domain, condition: Condition, said: str, written: str
) -> None:
    assert say_condition(domain, condition) == said
    assert domain.things is not None
    rule = ThingRule("good", (condition,))
    statement = thing_rule_statement(rule, domain.things, domain.schema, domain.knowledge.signature)
    if written:
        assert statement == f"good(S) if picture(S), {written}."
    assert say_thing_rule(domain, rule) == f"if {said}, then the picture is good"


def test_a_pattern_is_one_whatever_its_things_are_numbered() -> None:
    generator = np.random.default_rng(1)
    for _ in range(50):
        pattern = random_pattern(generator)
        order = dict(enumerate(generator.permutation(pattern.things).tolist()))
        atoms = [atom.renamed(order) for atom in reversed(pattern.atoms)]
        assert Pattern.of(pattern.things, atoms) == pattern


def test_more_exceptions_never_take_fewer_bits() -> None:
    by_wrong = exception_bits(20, np.arange(41), positives=60, negatives=40)
    by_right = exception_bits(np.arange(61), 0, positives=60, negatives=40)
    assert (np.diff(by_wrong) > 0).all()
    assert by_right[-1] < by_right[0]


CONCEPTS: dict[str, tuple[Condition, ...]] = {
    "one on another": (There(Pattern.of(2, [RED, Related(0, 1, "on"), LARGE])),),
    "none": (There(Pattern.of(1, [BALL, RED]), holds=False),),
    "so many": (There(Pattern.of(1, [BALL]), 2),),
    "alike": (There(Pattern.of(3, [Alike(0, 1, "colour"), Alike(0, 2, "colour")])),),
    "concluded": (There(Pattern.of(1, [HasValue(0, "free", "yes"), RED])),),
    "both": (There(Pattern.of(1, [BALL])), There(Pattern.of(1, [RED]), holds=False)),
}


@pytest.mark.parametrize(("concept", "noise"), list(zip(CONCEPTS, [0.0, 0.1] * 3, strict=True)))
def test_a_concept_is_found_again(domain: Domain, concept: str, noise: float) -> None:
    """In 120 scenes, a tenth of them annotated wrongly or none; judged by as many others."""
    _, table = scenes(domain, 120, seed=2)
    _, others = scenes(domain, 120, seed=3)
    meant = [ThingRule("good", CONCEPTS[concept]), ThingRule("bad", (), ("good",))]
    generator = np.random.default_rng(4)
    other = {"good": "bad", "bad": "good"}
    labels = [
        other[str(label)] if generator.random() < noise else str(label)
        for label in classified(table, meant)
    ]
    judged = learn_thing_rules(table, labels, classes=["good", "bad"])
    rules = [found.rule for found in judged if found.fate is Fate.ACCEPTED]
    assert classified(others, rules) == classified(others, meant)
    meant_literals = sum(condition.literals for condition in CONCEPTS[concept])
    assert sum(rule.literals for rule in rules) <= meant_literals


def test_two_cases_of_a_class_become_two_rules(domain: Domain) -> None:
    _, table = scenes(domain, 200, seed=5)
    cases = [
        ThingRule("good", (There(Pattern.of(2, [RED, Related(0, 1, "on"), LARGE])),)),
        ThingRule("good", (There(Pattern.of(1, [BALL, HasValue(0, "colour", "green")]), 2),)),
    ]
    meant = [*cases, ThingRule("bad", (), ("good",))]
    labels = [str(label) for label in classified(table, meant)]
    judged = learn_thing_rules(table, labels, classes=["good", "bad"])
    found = [judgement.rule for judgement in judged]
    assert classified(table, found) == labels
    assert sum(rule.literals for rule in found) <= sum(rule.literals for rule in cases)


def test_nothing_is_learned_of_classes_by_lot(domain: Domain) -> None:
    _, table = scenes(domain, 60, seed=6)
    lots = np.random.default_rng(0).integers(2, size=60)
    labels = [("good", "bad")[lot] for lot in lots]
    judged = learn_thing_rules(table, labels, classes=["good", "bad"])
    assert not [found for found in judged if found.fate is Fate.ACCEPTED]
    assert learn_thing_rules(table, labels, classes=["good", "bad"]) == judged


def test_without_tolerance_nothing_speaks_against_a_rule(domain: Domain) -> None:
    _, table = scenes(domain, 150, seed=2)
    meant = [ThingRule("good", CONCEPTS["one on another"]), ThingRule("bad", (), ("good",))]
    labels = [str(label) for label in classified(table, meant)]
    labels[0] = "bad" if labels[0] == "good" else "good"
    options = ThingLearningOptions(tolerance=0.0)
    judged = learn_thing_rules(table, labels, classes=["good", "bad"], options=options)
    assert all(not found.tally.wrong for found in judged if found.fate is Fate.ACCEPTED)


def test_the_search_finds_what_trying_all_short_patterns_finds(domain: Domain) -> None:
    """Of all values of one thing and of a thing on another, the condition that tells most."""
    desks, table = scenes(domain, 80, seed=7)
    good = as_bits(np.array([red_on_large(desk) for desk in desks]))
    contrast = Contrast(good, table.all_scenes & ~good)
    best = PatternSearch(table).conditions(contrast)[0]
    values = [(key, value) for key, values in table.features.items() for value in values]
    tried = [
        Pattern.of(2, [HasValue(0, *upper), Related(0, 1, "on"), HasValue(1, *lower)])
        for upper in values
        for lower in values
    ]
    told = [float(contrast.bits_told(where(table, There(pattern)))) for pattern in tried]
    assert float(contrast.bits_told(best.covered)) >= max(told)


def learned(folder: Path, tmp_path: Path, **options: object) -> seewhy.LearnedAboutThings:
    domain = load_domain(folder)
    data = write_desks(tmp_path / "desks", red_on_large, 60)
    return seewhy.learn_about_things(domain, Dataset.load(data, domain), **options)  # type: ignore[arg-type]


def test_what_is_learned_is_judged_by_pictures_that_proposed_nothing(
    folder: Path, tmp_path: Path
) -> None:
    found = learned(folder, tmp_path)
    assert [str(axiom) for axiom in found.added] == [
        "good(S) if picture(S), on(X, Y), colour(X, red), size(Y, large).",
        "-good(S) if picture(S), not good(S).",
    ]
    assert (found.held_back, found.learned_from) == (12, 48)
    assert found.before is not None
    assert found.after is not None
    assert (found.before.right.right, found.after.right.right) == (0, 12)
    first, rest = found.added
    assert first.origin.support + rest.origin.support == 48
    assert len(first.origin.pictures) == first.origin.support
    assert [len(found.domain.knowledge.axioms), len(load_domain(folder).knowledge.axioms)] == [8, 6]


def test_what_nobody_accepts_is_not_added(folder: Path, tmp_path: Path) -> None:
    found = learned(folder, tmp_path, accept=lambda _: False)
    assert len(found.found) == 2
    assert not found.added
    assert found.domain.knowledge.axioms == load_domain(folder).knowledge.axioms


def test_learn_writes_axioms_that_decide_and_later_pictures_withdraw(
    folder: Path, tmp_path: Path, run: Run
) -> None:
    home = tmp_path / "mine"
    shutil.copytree(folder, home)
    data = write_desks(tmp_path / "first", red_on_large, 60)
    shown = run("learn", home, "--data", data, "--json")
    assert json.loads(shown.out)["added"] == []
    assert (home / "knowledge.al").read_text() == (folder / "knowledge.al").read_text()
    done = run("learn", home, "--data", data, "--yes")
    assert done.code == 0, done.err
    assert done.out.splitlines()[0] == (
        "proposed: good: there is a red thing that is on a large thing: 10 of 10 pictures"
    )
    scene = ["a.colour=red", "b.size=large", "on=a,b"]
    decided = run("decide", home, *scene)
    assert decided.out.startswith("class: good\n")
    assert "learned from 10 pictures" in decided.out
    assert "├─ a is red" in decided.out

    again = write_desks(tmp_path / "second", lambda desk: len(desk.things) > 3, 60, seed=1)
    later = run("learn", home, "--data", again, "--yes")
    assert later.out.count("withdrawn: ") == 2
    assert "otherwise, as images/" in later.out
    text = (home / "knowledge.al").read_text()
    assert "% withdrawn: good(S) if picture(S), on(X, Y)" in text
    assert "good(S) if picture(S), 4 <= #count { U: thing(U) }." in text.splitlines()
    assert run("decide", home, *scene).out.startswith("class: bad\n")


def test_a_bundled_domain_is_learned_about_in_a_copy(
    folder: Path, tmp_path: Path, run: Run
) -> None:
    data = write_desks(tmp_path / "desks", red_on_large, 60)
    asked = run("learn", "tabletop", "--data", data, "--yes")
    assert asked.code == 2
    assert "give --out FOLDER for a copy" in asked.err
    copy = tmp_path / "copy"
    assert run("learn", folder, "--data", data, "--yes", "--out", copy).code == 0
    assert len(load_domain(copy).knowledge.axioms) == 8
    assert len(load_domain(folder).knowledge.axioms) == 6
    full = run("learn", folder, "--data", data, "--yes", "--out", copy)
    assert full.code == 2
    assert "is there already" in full.err


def test_a_scene_of_a_file_is_decided_with_its_reasons(
    folder: Path, tmp_path: Path, run: Run
) -> None:
    home = tmp_path / "mine"
    shutil.copytree(folder, home)
    with (home / "knowledge.al").open("a") as file:
        file.write("%% two balls\ngood(P) if picture(P), #count { X : form(X, ball) } >= 2.\n")
    balls = [{"form": "ball", "colour": "red"}, {"form": "ball", "colour": "blue"}]
    scene = {"image_index": 0, "objects": balls, "relationships": {}}
    (tmp_path / "scenes.json").write_text(json.dumps({"scenes": [scene]}))
    told = run("decide", home, "--scene", tmp_path / "scenes.json")
    assert told.out.startswith('class: good\nbecause:\n  the picture is good: "two balls"')
    assert "the red ball is a ball" in told.out
    as_json = run("decide", home, "--scene", tmp_path / "scenes.json", "--json")
    assert json.loads(as_json.out)["class"] == "good"


def _without_classes(data: Path) -> None:
    file = data / "scenes.csv"
    file.write_text("\n".join(line.split(",")[0] for line in file.read_text().splitlines()) + "\n")


def _of_one_class(data: Path) -> None:
    file = data / "scenes.csv"
    file.write_text(file.read_text().replace(",bad", ",good"))


def _without_things(data: Path) -> None:
    (data / "things.csv").unlink()
    (data / "relations.csv").unlink()


def _few(data: Path) -> None:
    file = data / "scenes.csv"
    file.write_text("\n".join(file.read_text().splitlines()[:12]) + "\n")
    _without_things(data)


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (_without_classes, "scenes.csv: no row has a class, of which axioms are learned; fill"),
        (_of_one_class, "all 24 pictures are of the class 'good', and axioms are learned to tell"),
        (_without_things, "no picture has things; list them in things.csv, a row a thing"),
        (_few, "scenes.csv: 11 pictures have a class, and axioms about things are learned from 20"),
    ],
)
def test_what_cannot_teach_is_said_in_one_sentence(
    folder: Path, tmp_path: Path, run: Run, spoil: object, complaint: str
) -> None:
    data = write_desks(tmp_path / "desks", red_on_large, 24)
    assert callable(spoil)
    spoil(data)
    told = run("learn", folder, "--data", data, "--yes")
    assert told.code == 2
    assert complaint in told.err
    assert told.err.count("\n") == 1
    assert len(load_domain(folder).knowledge.axioms) == 6


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        (["--picture", "tree.svg"], "--picture is not for pictures of several things"),
        (["--without", "good(S)."], "--without goes with --runs"),
    ],
)
def test_options_that_are_not_for_things_are_refused(
    folder: Path, tmp_path: Path, run: Run, given: Sequence[str], complaint: str
) -> None:
    told = run("learn", folder, "--data", tmp_path, "--yes", *given)
    assert told.code == 2
    assert complaint in told.err


def test_a_domain_without_classes_cannot_be_taught(tmp_path: Path, run: Run) -> None:
    told = run("learn", "tabletop", "--data", tmp_path, "--json")
    assert told.code == 2
    assert "scenes.csv" in told.err  # the data are looked at first: there are none
    tabletop = load_domain("tabletop")
    with pytest.raises(seewhy.SeeWhyError, match="has 0 classes, and axioms are learned"):
        seewhy.learn_about_things(tabletop, Dataset((), tabletop, tmp_path))


def test_a_dataset_of_another_domain_is_refused(domain: Domain, tmp_path: Path) -> None:
    other = Dataset((), load_domain("tabletop"), tmp_path)
    with pytest.raises(DatasetError, match="is of the domain 'tabletop'"):
        seewhy.learn_about_things(domain, other)


def test_a_learned_axiom_that_somebody_changed_is_not_guessed_at(domain: Domain) -> None:
    (axiom,) = read_axioms("good(S) if picture(S), form(X, ball).", domain.knowledge.signature)
    axiom = replace(axiom, origin=replace(axiom.origin, learned=True, support=3))
    text = with_learned("#sort picture.\n", [axiom], [])
    gone = Withdrawn(str(axiom), "it was otherwise")
    assert str(axiom) not in with_learned(text, [], [gone]).splitlines()
    with pytest.raises(RevisionError, match=r"knowledge\.al has changed"):
        with_learned(text.replace("ball", "box"), [], [gone])
