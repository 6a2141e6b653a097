"""Learning axioms from annotated scenes."""

from __future__ import annotations

import dataclasses
import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from conftest import KNOWLEDGE, Run, draw_tile, write_domain
from seewhy.agent.agent import Agent
from seewhy.agent.learning_from_pictures import (
    AnnotatedScenes,
    axioms_of,
    contradicted,
    learn_for_domain,
    scenes_of,
    with_candidates,
)
from seewhy.agent.refutation import refuted
from seewhy.data.dataset import Dataset
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reference import ReferenceAnswers, experience_of
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, KnowledgeError
from seewhy.induction.axiom_learning import (
    Fate,
    LearningOptions,
    decide_by_candidates,
    learn_axioms,
)
from seewhy.induction.axiom_text import axiom_statement, conjunctions
from seewhy.induction.candidate import Candidate, chance, is_borne_out, tally
from seewhy.induction.generalisation import generalised, most_general
from seewhy.induction.scene_table import scene_table
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.learned_file import (
    LEARNED,
    Withdrawn,
    learned_text,
    parse_learned,
    read_learned,
)
from seewhy.knowledge.reasoner import Reasoner
from seewhy_lab.experiments.axioms import explanations

FEATURES = {"size": ("1", "2", "3", "4"), "colour": ("red", "green", "blue"), "lean": ("yes", "no")}
SPACE = list(product(*FEATURES.values()))
decide_by = decide_by_candidates(FEATURES)


def scenes(vectors: list[tuple[str | None, ...]], labels: list[str]) -> AnnotatedScenes:
    return AnnotatedScenes(tuple(vectors), tuple(labels), ("",) * len(labels))


def learned_texts(domain: Domain, some: AnnotatedScenes) -> list[str]:
    learned = learn_for_domain(domain, some)
    found = axioms_of(domain, [judgement.candidate for judgement in learned.accepted], some)
    return [str(axiom) for axiom in found]


# Induction ------------------------------------------------------------------------------------


def test_two_rules_are_found_as_they_are() -> None:
    vectors = SPACE * 10
    labels = ["down" if v[2] == "yes" and int(v[0]) > 2 else "up" for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by)
    assert {judgement.candidate for judgement in learned.accepted} == {
        Candidate("up", (PathCondition("size", ("1", "2")),)),
        Candidate("up", (PathCondition("lean", ("no",)),)),
        Candidate("down", (PathCondition("size", ("3", "4")), PathCondition("lean", ("yes",)))),
    }


@settings(max_examples=40)
@given(data=st.data())
def test_nothing_learned_is_wrong_about_the_scenes_it_was_learned_from(data: st.DataObject) -> None:
    rows = data.draw(st.lists(st.sampled_from(SPACE), min_size=4, max_size=60))
    labels = [data.draw(st.sampled_from(["up", "down", "odd"])) for _ in set(rows)]
    of = dict(zip(dict.fromkeys(rows), labels, strict=True))
    vectors = rows * 3
    learned = learn_axioms(FEATURES, vectors, [of[v] for v in vectors], decide=decide_by)
    table = scene_table(FEATURES, vectors, [of[v] for v in vectors])
    for judgement in learned.accepted:
        assert tally(judgement.candidate, table).wrong == 0
        assert judgement.tally.right >= 1
    assert not [
        (one, other)
        for one, other in combinations([judgement.candidate for judgement in learned.accepted], 2)
        if one.covers(other) or other.covers(one)
    ]


@settings(max_examples=40)
@given(data=st.data())
def test_no_condition_can_be_left_out_of_what_is_generalised(data: st.DataObject) -> None:
    rows = data.draw(st.lists(st.sampled_from(SPACE), min_size=1, max_size=30, unique=True))
    labels = [data.draw(st.sampled_from(["up", "down"])) for _ in rows]
    table = scene_table(FEATURES, rows, labels)
    start = Candidate(
        labels[0],
        tuple(PathCondition(f, (v,)) for f, v in zip(FEATURES, rows[0], strict=True)),
    )
    general = generalised(start, table, tolerance=0.0)
    assert general.covers(start)
    assert is_borne_out(general, table, 0.0)
    for left_out in general.conditions:
        rest = tuple(condition for condition in general.conditions if condition is not left_out)
        assert not is_borne_out(Candidate(general.label, rest), table, 0.0)


def test_shuffled_labels_lead_to_nothing() -> None:
    rng = np.random.default_rng(0)
    silly = 0
    for _ in range(100):
        vectors = [SPACE[n] for n in rng.integers(len(SPACE), size=200)]
        labels = [("up", "up", "down")[n] for n in rng.integers(3, size=200)]
        learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by)
        silly += bool(learned.accepted)
    assert silly <= 5


def test_wrong_annotation_is_tolerated_only_where_that_is_asked() -> None:
    rng = np.random.default_rng(1)
    vectors = SPACE * 150
    truth = ["down" if v[2] == "yes" else "up" for v in vectors]
    noisy = [
        ("up" if label == "down" else "down") if rng.random() < 0.05 else label for label in truth
    ]
    assert not learn_axioms(FEATURES, vectors, noisy, decide=decide_by).accepted
    tolerant = learn_axioms(
        FEATURES, vectors, noisy, decide=decide_by, options=LearningOptions(tolerance=0.05)
    )
    assert {judgement.candidate for judgement in tolerant.accepted} == {
        Candidate("down", (PathCondition("lean", ("yes",)),)),
        Candidate("up", (PathCondition("lean", ("no",)),)),
    }


@pytest.mark.parametrize(
    ("vectors", "labels"),
    [
        ([], []),
        ([("1", "red", "no")] * 50, ["up"] * 50),
        ([("1", "red", "no"), ("2", "red", "no")], ["up", "down"]),
        ([(None, None, None)] * 20, ["up", "down"] * 10),
    ],
    ids=["no scene", "one class", "fewer scenes than features", "nothing known"],
)
def test_where_there_is_nothing_to_learn(
    vectors: list[tuple[str | None, ...]], labels: list[str]
) -> None:
    assert not learn_axioms(FEATURES, vectors, labels, decide=decide_by).accepted


def test_values_that_are_not_known_and_features_that_do_not_vary() -> None:
    vectors = [(n, "red", lean) for n in ("1", None, "3") for lean in ("yes", "no", None)] * 20
    labels = [{"yes": "down", "no": "up"}.get(str(v[2]), "odd") for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by)
    assert {judgement.candidate for judgement in learned.accepted} == {
        Candidate("down", (PathCondition("lean", ("yes",)),)),
        Candidate("up", (PathCondition("lean", ("no",)),)),
    }


def test_too_few_scenes_are_named() -> None:
    vectors = SPACE * 10 + [("1", "red", "yes")] * 2
    labels = ["down" if v[2] == "yes" and v[0] == "4" and v[1] == "red" else "up" for v in vectors]
    learned = learn_axioms(
        FEATURES, vectors, labels, decide=decide_by, options=LearningOptions(support=0.9)
    )
    reasons = [
        judgement.reason for judgement in learned.judgements if judgement.fate is Fate.DROPPED
    ]
    assert any("are needed" in reason for reason in reasons)


def test_chance_falls_with_the_scenes_and_grows_with_what_was_tried() -> None:
    table = scene_table(FEATURES, SPACE * 4, ["up", "down"] * (2 * len(SPACE)))
    one = Candidate("up", (PathCondition("lean", ("yes",)),))
    two = Candidate("up", (PathCondition("colour", ("red",)), PathCondition("lean", ("yes",))))
    few, many = tally(one, table), replace(tally(one, table), right=90)
    assert chance(one, table, many) < chance(one, table, few)
    assert chance(two, table, few) > chance(one, table, few)


def test_equal_candidates_are_kept_once() -> None:
    lean = Candidate("up", (PathCondition("lean", ("yes",)),))
    assert most_general([lean, lean]) == [lean]


def test_the_paths_that_became_axioms_are_marked() -> None:
    vectors = [v for v in SPACE for _ in range(10)]
    odd = [("4", "red", "yes"), ("4", "red", "no")]
    labels = ["up" if v in odd else "down" if v[2] == "yes" else "up" for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by)
    paths = learned.tree.paths()
    marked = [paths[n] for n in sorted(learned.accepted_leaves)]
    assert marked
    for path in marked:
        assert any(
            judgement.candidate.covers(
                Candidate(
                    path.label,
                    tuple(c for f in FEATURES for c in path.conditions if c.feature == f),
                )
            )
            for judgement in learned.accepted
        )


def test_a_path_that_was_narrowed_is_marked_too() -> None:
    """What is left open is of one class: the tree is a leaf, and decided scenes narrow it."""
    vectors = SPACE * 10
    labels = ["down" if v[2] == "yes" else "up" for v in vectors]
    known = Candidate("down", (PathCondition("lean", ("yes",)),))
    learned = learn_axioms(
        FEATURES,
        vectors,
        labels,
        decide=lambda candidates, some: decide_by([known, *candidates], some),
    )
    assert [judgement.candidate.conditions for judgement in learned.accepted] == [
        (PathCondition("lean", ("no",)),)
    ]
    assert len(learned.tree.paths()) == 1
    assert learned.accepted_leaves == {0}


# With reasons ---------------------------------------------------------------------------------

RED_AND_LEANING = frozenset({"colour", "lean"})


def test_what_is_named_stays_a_condition() -> None:
    """All that lean are red here: by the classes alone, that it leans suffices."""
    vectors = [v for v in SPACE if v[1] == "red" or v[2] == "no"] * 5
    labels = ["down" if v[2] == "yes" else "up" for v in vectors]
    reasons = [RED_AND_LEANING if label == "down" else None for label in labels]
    down = [
        {
            judgement.candidate.conditions
            for judgement in learn_axioms(
                FEATURES, vectors, labels, decide=decide_by, reasons=some
            ).accepted
            if judgement.candidate.label == "down"
        }
        for some in ((), reasons)
    ]
    lean, red = PathCondition("lean", ("yes",)), PathCondition("colour", ("red",))
    assert down == [{(lean,)}, {(red, lean)}]


def test_what_is_explained_otherwise_is_rejected_and_says_so() -> None:
    """Most who say why a scene is up name its lean; of the small ones the size is named."""
    vectors = SPACE * 5
    labels = ["down" if v[2] == "yes" else "up" for v in vectors]
    reasons = [frozenset({"size"} if v[0] == "1" else {"lean"}) for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by, reasons=reasons)
    said = {
        judgement.candidate.conditions: (judgement.fate, judgement.reason)
        for judgement in learned.judgements
    }
    assert said[(PathCondition("lean", ("no",)),)] == (
        Fate.REJECTED,
        "15 of 60 are explained by other reasons",
    )
    assert said[(PathCondition("size", ("1",)),)] == (Fate.REJECTED, "15 scenes speak against it")
    assert not learned.accepted


def test_rules_that_apply_together_are_learned_one_by_one() -> None:
    """Where both apply all three features are named; each is learned where it applies alone."""

    def applying(v: tuple[str, ...]) -> list[set[str]]:
        rules = [({"lean"}, v[2] == "yes"), ({"size", "colour"}, v[0] in "12" and v[1] == "red")]
        return [features for features, applies in rules if applies]

    vectors = SPACE * 5
    labels = ["down" if applying(v) else "up" for v in vectors]
    reasons = [frozenset(set().union(*applying(v))) or None for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by, reasons=reasons)
    assert {
        judgement.candidate for judgement in learned.accepted if judgement.candidate.label == "down"
    } == {
        Candidate("down", (PathCondition("lean", ("yes",)),)),
        Candidate("down", (PathCondition("size", ("1", "2")), PathCondition("colour", ("red",)))),
    }


@settings(max_examples=40)
@given(data=st.data())
def test_what_is_learned_asks_nothing_that_no_reason_names(data: st.DataObject) -> None:
    of = {v: data.draw(st.sampled_from(["up", "down"])) for v in SPACE}
    names = st.frozensets(st.sampled_from(list(FEATURES)), min_size=1)
    why = {v: data.draw(st.none() | names) for v in SPACE}
    vectors = SPACE * 6
    learned = learn_axioms(
        FEATURES,
        vectors,
        [of[v] for v in vectors],
        decide=decide_by,
        reasons=[why[v] for v in vectors],
    )
    for judgement in learned.accepted:
        asked = {condition.feature for condition in judgement.candidate.conditions}
        spoken = [
            v
            for v in SPACE
            if all(
                v[list(FEATURES).index(c.feature)] in c.values
                for c in judgement.candidate.conditions
            )
        ]
        assert {of[v] for v in spoken} == {judgement.candidate.label}
        assert all(asked <= (why[v] or asked) for v in spoken)


LEAN, COLOUR, BOTH = frozenset({"lean"}), frozenset({"colour"}), frozenset({"lean", "colour"})


@pytest.mark.parametrize(
    ("said", "fate"),
    [
        ([BOTH], Fate.DROPPED),
        ([BOTH, BOTH], Fate.ACCEPTED),
        ([BOTH, None], Fate.DROPPED),
        ([BOTH, LEAN], Fate.REJECTED),
    ],
    ids=["one", "two alike", "one, and one that nobody explains", "two that differ"],
)
def test_two_scenes_explained_alike_are_enough(
    said: list[frozenset[str] | None], fate: Fate
) -> None:
    """Half of all scenes are of the class: so few prove nothing by themselves."""
    vectors = [("1", "red", "yes")] * len(said) + [("2", "green", "no")] * len(said)
    labels = ["down"] * len(said) + ["up"] * len(said)
    reasons = [*said, *([LEAN] * len(said))]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by, reasons=reasons)
    conditions = (PathCondition("colour", ("red",)), PathCondition("lean", ("yes",)))
    fates = {judgement.candidate: judgement.fate for judgement in learned.judgements}
    assert fates[Candidate("down", conditions)] is fate


def test_where_one_is_otherwise_two_are_not_enough() -> None:
    vectors = [("1", "red", "yes")] * 2 + [("1", "blue", "yes")] + [("2", "green", "no")] * 3
    labels = ["down", "down", "up", "up", "up", "up"]
    learned = learn_axioms(
        FEATURES,
        vectors,
        labels,
        decide=decide_by,
        reasons=[LEAN, LEAN, None, None, None, None],
        options=LearningOptions(tolerance=0.4),
    )
    (judgement,) = [
        judgement
        for judgement in learned.judgements
        if judgement.path.label == "down" and judgement.tally.wrong
    ]
    assert (judgement.fate, judgement.tally.right, judgement.tally.wrong) == (Fate.DROPPED, 2, 1)


def test_a_slip_of_who_says_why_is_tolerated_two_of_a_kind_are_not() -> None:
    vectors = [v for v in SPACE if v[0] in "12"] * 8
    labels = ["down" if v[2] == "yes" else "up" for v in vectors]
    down = Candidate("down", (PathCondition("lean", ("yes",)),))
    for slips, tolerance, learned_again in ((1, 0.0, False), (1, 0.05, True), (4, 0.05, False)):
        reasons = [LEAN if label == "down" else None for label in labels]
        ours = [n for n, v in enumerate(vectors) if v == ("1", "red", "yes")]
        for n in ours[:slips]:
            reasons[n] = COLOUR
        learned = learn_axioms(
            FEATURES,
            vectors,
            labels,
            decide=decide_by,
            reasons=reasons,
            options=LearningOptions(tolerance=tolerance),
        )
        assert (down in {judgement.candidate for judgement in learned.accepted}) == learned_again, (
            slips
        )


def test_paths_are_narrowed_around_what_is_explained_otherwise() -> None:
    """Up are the small ones of one colour, and those that lean: only the latter are explained."""
    vectors = [v for v in SPACE if not (v[0] == "1" and v[1] == "blue" and v[2] == "no")] * 8

    def is_up(v: tuple[str, ...]) -> bool:
        return v[2] == "yes" or (v[0] == "1" and v[1] == "red")

    labels = ["up" if is_up(v) else "down" for v in vectors]
    leaning = frozenset({"lean"})
    reasons = [leaning if v[2] == "yes" and v[1] != "red" else None for v in vectors]
    learned = learn_axioms(FEATURES, vectors, labels, decide=decide_by, reasons=reasons)
    decided = decide_by([judgement.candidate for judgement in learned.accepted], vectors)
    assert [decision.label for decision in decided] == labels


def test_reasons_are_of_the_scenes_that_they_were_given_for(tiles: Domain, tmp_path: Path) -> None:
    """One of three pictures that look the same is explained, and one was counted before."""
    (tmp_path / "images").mkdir()
    rows = []
    for n, cell in enumerate(("", "colour", "")):
        Image.new("RGB", (16, 16), (n, 0, 0)).save(tmp_path / "images" / f"{n}.png")
        rows.append(f"images/{n}.png,good,green,yes,{cell}")
    table = "\n".join(["image,class,colour,round,reasons", *rows])
    (tmp_path / "scenes.csv").write_text(table, encoding="utf-8")
    found = scenes_of(Dataset.load(tmp_path, tiles), {("green", "yes"): {"good": 1}}, ())
    assert found.pictures == ("images/0.png", "images/1.png", "images/2.png", "")
    assert found.reasons == (None, frozenset({"colour"}), None, None)


def test_scenes_that_nobody_can_place_propose_nothing() -> None:
    vectors = [("1", None, "yes")] * 20 + [("1", "red", "no")] * 20
    labels = ["down"] * 20 + ["up"] * 20
    learned = learn_axioms(
        FEATURES,
        vectors,
        labels,
        decide=decide_by,
        reasons=[frozenset({"colour"})] * 20 + [None] * 20,
    )
    assert {judgement.candidate.label for judgement in learned.accepted} <= {"up"}


def test_a_column_of_reasons_is_learned_from(tiles: Domain, tmp_path: Path) -> None:
    """The same pictures, with and without a reason for what the knowledge leaves open."""
    rows = [("good", "red", "yes"), ("good", "red", "no")] * 2
    rows += [("good", "green", "yes"), *[("bad", "blue", "no")] * 3] * 8
    (tmp_path / "images").mkdir()
    for n in range(len(rows)):
        Image.new("RGB", (16, 16), (n, 0, 0)).save(tmp_path / "images" / f"{n}.png")
    found = []
    for column, reason in (("", ""), (",reasons", ",colour round")):
        lines = [
            f"images/{n}.png,{','.join(row)}{reason if row[1] == 'green' else ',' * bool(column)}"
            for n, row in enumerate(rows)
        ]
        table = "\n".join([f"image,class,colour,round{column}", *lines])
        (tmp_path / "scenes.csv").write_text(table, encoding="utf-8")
        learning = Agent(tiles).learn(Dataset.load(tmp_path, tiles), answers=False)
        found.append({str(axiom) for axiom in learning.added})
    assert found == [
        {"good(S) if -colour(S, blue)."},
        {"good(S) if colour(S, green), round(S)."},
    ]


# With knowledge -------------------------------------------------------------------------------


def test_with_reasons_the_removed_axioms_themselves_are_found(structures: Domain) -> None:
    """What is learned decides all scenes as the full knowledge does, and for its reasons."""
    whole = Agent(structures)
    rng = np.random.default_rng(0)
    space = list(product(*(feature.values for feature in structures.features.values())))
    decided = [v for v in space if whole.reasoner.decide(v).label]
    vectors = [decided[n] for n in rng.integers(len(decided), size=800)]
    labels = [str(whole.reasoner.decide(v).label) for v in vectors]
    reference = ReferenceAnswers(structures, whole.reasoned, experience_of(vectors, labels))
    reasons = explanations(reference, whole.questions, vectors, labels)
    why = {
        question.label: question
        for question in whole.questions.all
        if question.asks is Asks.WHY_CLASS
    }
    for gone in list(combinations(range(8), 4))[::9]:
        kept = tuple(axiom for n, axiom in enumerate(structures.knowledge.axioms) if n not in gone)
        domain = replace(structures, knowledge=replace(structures.knowledge, axioms=kept))
        some = replace(scenes(vectors, labels), reasons=reasons)
        learned = learn_for_domain(domain, some)
        axioms = axioms_of(domain, [judgement.candidate for judgement in learned.accepted], some)
        agent = Agent(domain, learned=axioms)
        for vector, label in set(zip(vectors, labels, strict=True)):
            assert agent.reasoner.decide(vector).label == label
            told, meant = (
                answerer.kind(why[label], vector, label)
                for answerer in (agent.reasoned, whole.reasoned)
            )
            assert set(told.mentions) == set(meant.mentions), (gone, vector)


def test_removed_axioms_are_found_again(structures: Domain) -> None:
    """Every fifth way to remove four of the eight axioms; experiments run all seventy."""
    full = Reasoner(structures.knowledge, structures.schema)
    space = list(product(*(feature.values for feature in structures.features.values())))
    truth = {vector: full.decide(vector).label for vector in space}
    rng = np.random.default_rng(0)
    agreed, exact = [], 0
    for gone in list(combinations(range(8), 4))[::5]:
        vectors = [space[n] for n in rng.integers(len(space), size=1000)]
        labels = [truth[v] or ("stable", "unstable")[rng.integers(2)] for v in vectors]
        kept = tuple(axiom for n, axiom in enumerate(structures.knowledge.axioms) if n not in gone)
        domain = replace(structures, knowledge=replace(structures.knowledge, axioms=kept))
        learned = learn_for_domain(domain, scenes(vectors, labels))
        knowledge = with_candidates(
            domain.knowledge, [judgement.candidate for judgement in learned.accepted], domain.schema
        )
        reasoner = Reasoner(knowledge, domain.schema)
        settled = [v for v in space if truth[v] is not None and v in set(vectors)]
        same = [reasoner.decide(v).label == truth[v] for v in settled]
        agreed.append(np.mean(same))
        exact += all(same)
    assert np.mean(agreed) >= 0.99
    assert exact >= len(agreed) / 2


def test_an_axiom_that_contradicts_what_is_known_is_not_learned(structures: Domain) -> None:
    """The knowledge says that displaced blocks fall; pictures of some that stand are of no use."""
    vectors = [(n, "wide", "no", "yes") for n in "345"] * 20
    others = [("2", "narrow", "yes", "no")] * 40
    some = scenes([*vectors, *others], ["stable"] * 60 + ["unstable"] * 40)
    learned = learn_for_domain(structures, some)
    assert learned_texts(structures, some) == [
        str(axiom)
        for axiom in axioms_of(structures, [j.candidate for j in learned.accepted], some)
        if "-stable" in str(axiom)
    ]
    assert any(judgement.fate is Fate.REJECTED for judgement in learned.judgements)


def test_alternatives_become_an_axiom_each_and_what_is_excluded_is_denied() -> None:
    from seewhy.domain.domain import load_domain

    signs = load_domain("traffic_signs")
    shapes = signs.features["shape"].values
    label = next(iter(signs.classes))
    two = Candidate(label, (PathCondition("shape", shapes[:2]),))
    most = Candidate(label, (PathCondition("shape", shapes[:-1]),))
    assert len(conjunctions(two, signs.schema)) == 2
    (one,) = conjunctions(most, signs.schema)
    assert axiom_statement(one, signs.schema).endswith(f"if -shape(S, {shapes[-1]}).")


@settings(max_examples=30)
@given(data=st.data())
def test_a_statement_says_what_its_candidate_says(structures: Domain, data: st.DataObject) -> None:
    conditions = []
    for key, feature in structures.features.items():
        values = data.draw(st.sets(st.sampled_from(feature.values), min_size=1))
        if len(values) < len(feature.values):
            conditions.append(PathCondition(key, tuple(v for v in feature.values if v in values)))
    candidate = Candidate("unstable", tuple(conditions))
    nothing = replace(structures.knowledge, axioms=())
    reasoner = Reasoner(with_candidates(nothing, [candidate], structures.schema), structures.schema)
    space = list(product(*(feature.values for feature in structures.features.values())))
    features = {key: feature.values for key, feature in structures.features.items()}
    table = scene_table(features, space, ["unstable"] * len(space))
    said = [decision.label == "unstable" for decision in reasoner.decide_all(table.vectors)]
    assert said == table.satisfying(candidate.conditions).tolist()


# The file -------------------------------------------------------------------------------------


def test_learned_axioms_are_read_as_they_were_written(structures: Domain, tmp_path: Path) -> None:
    vectors = [(n, "wide", "no", moved) for n in "45" for moved in ("yes", "no")] * 20
    nothing = replace(structures, knowledge=replace(structures.knowledge, axioms=()))
    some = AnnotatedScenes(
        tuple(vectors),
        tuple("unstable" if v[3] == "yes" else "stable" for v in vectors),
        tuple(f"images/{n}.png" for n in range(len(vectors))),
    )
    learned = learn_for_domain(nothing, some)
    axioms = axioms_of(nothing, [judgement.candidate for judgement in learned.accepted], some)
    assert [axiom.origin.support for axiom in axioms] == [40, 40]
    assert axioms[0].origin.pictures[0].startswith("images/")
    text = learned_text(axioms)
    again = parse_learned(text, structures.knowledge.signature)
    assert [(str(axiom), axiom.text, axiom.origin) for axiom in again] == [
        (str(axiom), axiom.text, axiom.origin) for axiom in axioms
    ]
    (tmp_path / LEARNED).write_text(text, encoding="utf-8")
    assert read_learned(tmp_path / LEARNED, structures.knowledge.signature) == (
        tuple(
            replace(axiom, location=replace(axiom.location, file=str(tmp_path / LEARNED)))
            for axiom in again
        ),
        (),
    )


def test_an_axiom_without_what_it_was_learned_from(structures: Domain) -> None:
    with pytest.raises(KnowledgeError, match=r"learned\.al:1:1: nothing says what"):
        parse_learned("stable(S) if num_blocks(S, 2).", structures.knowledge.signature)


def test_declarations_have_no_place_among_learned_axioms(structures: Domain) -> None:
    with pytest.raises(KnowledgeError, match="declared in knowledge"):
        read_axioms("#sort colour = {red}.", structures.knowledge.signature)


# The agent ------------------------------------------------------------------------------------


def test_learning_from_pictures_reasons_with_what_it_learned(
    agent: Agent, model_folder: Path, dataset: Dataset, tmp_path: Path
) -> None:
    learner = Agent.load(model_folder)
    learning = learner.learn(dataset)
    assert learning.added
    assert learner.learned == learning.added
    assert [axiom.identifier for axiom in learner.learned] == [
        f"l{n}" for n in range(1, len(learner.learned) + 1)
    ]
    for axiom in learner.learned:
        assert axiom.origin.learned
        assert axiom.origin.things == "tiles"
        assert axiom.origin.pictures
    assert len(learner.given.knowledge.axioms) == len(agent.domain.knowledge.axioms)
    learner.save(tmp_path / "model")
    again = Agent.load(tmp_path / "model")
    assert [str(axiom) for axiom in again.learned] == [str(axiom) for axiom in learner.learned]
    vectors = dataset.vectors
    assert again.reasoner.decide_all(vectors) == learner.reasoner.decide_all(vectors)


def test_a_second_learning_from_the_same_pictures_finds_nothing_new(
    model_folder: Path, dataset: Dataset
) -> None:
    learner = Agent.load(model_folder)
    first = learner.learn(dataset)
    counted = sum(sum(counts.values()) for counts in learner.experience.values())
    second = learner.learn(dataset)
    assert (second.added, second.withdrawn) == ((), ())
    assert learner.learned == first.added
    assert sum(sum(counts.values()) for counts in learner.experience.values()) == counted


def test_pictures_that_contradict_an_axiom_withdraw_it(
    tiles: Domain, model_folder: Path, dataset: Dataset, tmp_path: Path
) -> None:
    learner = Agent.load(model_folder)
    learner.learn(dataset)
    before = [str(axiom) for axiom in learner.learned]
    (tmp_path / "images").mkdir()
    kinds = [(c, r) for c in ("red", "green", "blue") for r in ("yes", "no")]
    rows = ["image,class,colour,round"]
    for number, (colour, is_round) in enumerate(kinds * 3):
        draw_tile(colour, is_round, 1000 + number).save(tmp_path / "images" / f"{number}.png")
        label = learner.decide({"colour": colour, "round": is_round})
        other = "good" if label == "bad" else "bad"
        rows.append(f"images/{number}.png,{other},{colour},{is_round}")
    (tmp_path / "scenes.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    learning = learner.learn(Dataset.load(tmp_path, tiles))
    assert [gone.statement for gone in learning.withdrawn] == before
    assert all("are otherwise, as images/" in gone.reason for gone in learning.withdrawn)
    assert learner.withdrawn == learning.withdrawn


def test_a_more_general_axiom_takes_the_place_of_a_learned_one(
    tiles: Domain, dataset: Dataset
) -> None:
    general = next(
        axiom for axiom in Agent(tiles).learn(dataset, answers=False).added if len(axiom.body) == 1
    )
    value = "round" if "colour" in str(general) else "colour"
    more = {"round": "round(T)", "colour": "colour(T, red)"}[value].replace("T", "S")
    text = f"{str(general)[:-1]}, {more}."
    (narrow,) = read_axioms(text, tiles.knowledge.signature)
    narrow = dataclasses.replace(narrow, origin=Origin(learned=True, support=3))
    agent = Agent(tiles, learned=[narrow])
    learning = agent.learn(dataset, answers=False)
    assert str(general) in [str(axiom) for axiom in learning.added]
    assert [str(axiom) for axiom in agent.learned].count(text) == 0
    (gone,) = learning.withdrawn
    assert (gone.statement, gone.reason) == (text, f"{general} says it of more scenes")
    assert agent.withdrawn == (gone,)


def test_only_what_is_accepted_is_added(model_folder: Path, dataset: Dataset) -> None:
    learner = Agent.load(model_folder)
    asked: list[Axiom] = []
    learning = learner.learn(dataset, accept=lambda found: asked.extend(found) or [])
    assert tuple(asked) == learning.found
    assert learning.found
    assert learner.learned == ()


def test_a_dataset_of_another_domain(
    model_folder: Path, structures: Domain, dataset: Dataset
) -> None:
    with pytest.raises(DatasetError, match="is of the domain 'structure_stability'"):
        Agent.load(model_folder).learn(replace(dataset, domain=structures))


def test_an_axiom_learned_with_tolerance_is_not_withdrawn_for_the_same_errors(
    structures: Domain,
) -> None:
    (leans,) = read_axioms("-stable(S) if lean(S).", structures.knowledge.signature)
    leans = replace(leans, origin=Origin(learned=True, support=20, precision=0.95))
    vectors = [("2", "narrow", "yes", "no")] * 20
    same = scenes(vectors, ["unstable"] * 19 + ["stable"])
    worse = scenes(vectors, ["unstable"] * 18 + ["stable"] * 2)
    assert contradicted(structures, [leans], same) == []
    assert [axiom for axiom, _ in contradicted(structures, [leans], worse)] == [leans]


# Given axioms that scenes refute ----------------------------------------------------------------

WRONG = "round(T) if colour(T, red)."


@pytest.fixture
def misled(tmp_path: Path) -> Domain:
    """The tiles with an axiom about features that does not hold."""
    text = f"{KNOWLEDGE}\n%% red tiles are round\n{WRONG}\n"
    return load_domain(write_domain(tmp_path / "misled", knowledge=text))


def test_an_axiom_that_scenes_refute_is_set_aside(misled: Domain, dataset: Dataset) -> None:
    agent = Agent(misled)
    cornered = {"colour": "red", "round": "no"}
    assert agent.decide(cornered) is None  # a contradiction
    learning = agent.learn(dataset, answers=False)
    (gone,) = learning.withdrawn
    assert (gone.statement, gone.given) == (WRONG, True)
    assert gone.reason.startswith("7 of 14 tiles that it speaks about are otherwise, as images/")
    assert agent.decide(cornered) == "good"
    assert WRONG not in map(str, agent.domain.knowledge.axioms)
    assert WRONG in map(str, agent.given.knowledge.axioms)
    assert agent.learn(dataset, answers=False).withdrawn == ()
    agent.restore("a3")
    assert agent.withdrawn == ()
    assert agent.reasoner.decide(agent.domain.vector(cornered)).label is None
    with pytest.raises(KnowledgeError, match="'a3' is not set aside: no given axiom is"):
        agent.restore("a3")


def test_a_person_may_keep_an_axiom_that_scenes_refute(misled: Domain, dataset: Dataset) -> None:
    agent = Agent(misled)
    asked: list[str] = []

    def keep(refuted: Sequence[Withdrawn]) -> list[Withdrawn]:
        asked.extend(axiom.statement for axiom in refuted)
        return []

    learning = agent.learn(dataset, set_aside=keep, answers=False)
    assert asked == [WRONG]
    assert learning.withdrawn == ()
    assert WRONG in map(str, agent.domain.knowledge.axioms)


@pytest.mark.parametrize(
    ("wrong", "tolerance", "gone"), [(1, 0.0, 0), (2, 0.0, 0), (9, 0.0, 1), (9, 0.1, 0)]
)
def test_a_few_annotations_do_not_refute_an_axiom(
    misled: Domain, wrong: int, tolerance: float, gone: int
) -> None:
    vectors = [("red", "yes")] * (100 - wrong) + [("red", "no")] * wrong
    some = scenes(vectors, ["good"] * 100)
    assert len(refuted(misled, some, tolerance=tolerance)) == gone


def test_defaults_and_unknown_values_refute_nothing(tmp_path: Path, misled: Domain) -> None:
    unknown = scenes([("red", None), (None, "no")] * 50, ["good"] * 100)
    assert refuted(misled, unknown) == []
    text = f"{KNOWLEDGE}\ndefault {WRONG}\n"
    usual = load_domain(write_domain(tmp_path / "usual", knowledge=text))
    assert refuted(usual, scenes([("red", "no")] * 50, ["good"] * 50)) == []


def test_what_is_set_aside_is_kept_in_the_model(
    run: Run, misled: Domain, dataset: Dataset, model_folder: Path, tiles_data: Path, tmp_path: Path
) -> None:
    agent = Agent(misled)
    agent.extractor = Agent.load(model_folder).extractor
    agent.fit_induction(dataset.vectors, dataset.labels, answers=False)
    model = tmp_path / "model"
    agent.save(model)
    silent = run("learn", model, "--data", tiles_data, stdin="")
    assert silent.code == 2
    held, said = silent.err.splitlines()
    assert held == (
        "8 of 40 pictures are held back: nothing is learned from them, they judge what is proposed"
    )
    assert said.startswith("seewhy: no answer to 'set this axiom aside?', the model stays")
    shown = json.loads(run("learn", model, "--data", tiles_data, "--json").out)
    assert shown["withdrawn"] == []
    result = run("learn", model, "--data", tiles_data, "--yes")
    line = next(line for line in result.out.splitlines() if line.startswith("set aside"))
    assert line.startswith(f"set aside a3: {WRONG} ")
    assert "tiles that it speaks about are otherwise, as images/" in line
    again = Agent.load(model)
    assert [axiom.given for axiom in again.withdrawn] == [True]
    assert again.reasoner.decide(("red", "no")).label == "good"
    assert "set aside a3: " in run("axioms", model).out
    (gone,) = json.loads(run("axioms", model, "--json").out)["withdrawn"]
    assert (gone["statement"], gone["identifier"]) == (WRONG, "a3")
    assert run("axioms", model, "--restore", "a3").out == f"known again: {WRONG}\n"
    assert Agent.load(model).withdrawn == ()
    failed = run("axioms", model, "--restore", "a3")
    assert failed.code == 2
    assert failed.err == "seewhy: 'a3' is not set aside: no given axiom is\n"


# The command line -----------------------------------------------------------------------------


def test_learn_and_axioms(run: Run, model_folder: Path, tiles_data: Path, tmp_path: Path) -> None:
    model = tmp_path / "model"
    shutil.copytree(model_folder, model)
    shown = json.loads(run("learn", model, "--data", tiles_data, "--json").out)
    assert shown["found"]
    assert shown["added"] == []
    silent = run("learn", model, "--data", tiles_data, stdin="")
    assert silent.code == 2
    assert silent.err.splitlines()[1].startswith(
        "seewhy: no answer to 'add this axiom?', the model stays"
    )
    refused = run("learn", model, "--data", tiles_data, stdin="n\n" * 20)
    assert refused.code == 0
    assert "add this axiom?" in refused.out
    assert "added" not in refused.out
    drawn = tmp_path / "tree.svg"
    result = run("learn", model, "--data", tiles_data, "--yes", "--picture", drawn)
    assert "stroke='#1c7a3d'" in drawn.read_text(encoding="utf-8")
    assert result.code == 0
    assert "added l1:" in result.out
    assert (
        "annotated features classified rightly, of 8 held back: 87.5 % before, 87.5 % now"
        in result.out
    )
    listed = run("axioms", model)
    assert "learned from" in listed.out
    found = json.loads(run("axioms", model, "--json").out)
    learned = [axiom for axiom in found["axioms"] if axiom["learned"]]
    assert learned[0]["identifier"] == "l1"
    assert learned[0]["support"] >= len(learned[0]["pictures"]) > 0
    removed = run("axioms", model, "--remove", "l1")
    assert removed.out == f"withdrawn: {learned[0]['statement']}\n"
    after = json.loads(run("axioms", model, "--json").out)
    assert after["withdrawn"] == [
        {
            "statement": learned[0]["statement"],
            "reason": "a person withdrew it",
            "given": False,
        }
    ]


def test_an_axiom_that_is_not_there(run: Run, model_folder: Path) -> None:
    result = run("axioms", model_folder, "--remove", "l7")
    assert (result.code, result.out) == (2, "")
    assert result.err == "seewhy: 'l7' is no learned axiom: none was learned\n"
