"""Knowledge revised: proposals and what they would change, taking them, and taking them back."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from apples import (
    KNOWLEDGE,
    VECTORS,
    apple_agent,
    class_of,
    write_apple_pictures,
    write_apples,
)
from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.working_knowledge import working_knowledge
from seewhy.data.dataset import Dataset
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import load_domain
from seewhy.errors import DatasetError, DomainError, KnowledgeError, QuestionError, RevisionError
from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Origin
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.reasoner import Reasoner
from seewhy.revision import revisions as revisions_module
from seewhy.revision.consequences import Standing
from seewhy.revision.edit import Edit
from seewhy.revision.misreading import misreadings
from seewhy.revision.new_rule import fit_of, new_rule, reason_given, rules_by_example
from seewhy.revision.proposal import Cause, Doubted, Proposal
from seewhy.revision.record import RecordFile, TakenBack
from seewhy.revision.revisions import Revisions
from seewhy.revision.rule_revision import rule_revisions

RUSSET = ("russet", "yes", "no")
BROWN = PathCondition("brown", ("yes",))
SOFT = PathCondition("soft", ("yes",))
ALL = AnnotatedScenes(
    VECTORS, tuple(map(class_of, VECTORS)), tuple(f"{n}.png" for n in range(len(VECTORS)))
)
NONE = AnnotatedScenes((), (), ())


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_apples(tmp_path / "apples")


@pytest.fixture
def revisions(folder: Path) -> Revisions:
    return Revisions(folder)


def doubted(
    revisions: Revisions,
    vector: tuple[str | None, ...] = RUSSET,
    *,
    wanted: str | None = None,
    scenes: AnnotatedScenes = ALL,
) -> Doubted:
    return Doubted(revisions.known, revisions.texts, vector, scenes, wanted)


def soft_spoils(revisions: Revisions) -> Proposal:
    (proposal,) = new_rule(doubted(revisions, ("red", "no", "yes")), Candidate("spoilt", (SOFT,)))
    return proposal


# A rule that is wrong -------------------------------------------------------------------------


def test_an_exception_keeps_the_pictures_that_the_rule_is_right_about(revisions: Revisions) -> None:
    first, *_ = rule_revisions(doubted(revisions, wanted="fresh"))
    assert first.cause is Cause.EXCEPTION
    assert first.statement == "-fresh(A) if brown(A), not kind(A, russet)."
    assert first.sentence == "a brown apple is spoilt, unless it is a russet"
    assert first.consequences is not None
    assert first.consequences.moved(Standing.WRONG, Standing.OPEN)[0].picture == "9.png"


def test_the_narrowed_rule_asks_what_its_right_pictures_show(revisions: Revisions) -> None:
    _, second = rule_revisions(doubted(revisions, wanted="fresh"))
    assert second.cause is Cause.NARROWED
    # Of the features of this apple, only softness keeps more than one kind of brown apple apart.
    assert second.statement == "-fresh(A) if brown(A), soft(A)."
    assert second.sentence == "a brown apple is spoilt, provided that it is soft"


def test_the_file_stays_as_it_was_typed_but_for_the_rule(
    folder: Path, revisions: Revisions
) -> None:
    exception, _ = rule_revisions(doubted(revisions, wanted="fresh"))
    revisions.take(exception)
    expected = KNOWLEDGE.replace("%% is spoilt.", "%% is spoilt, unless it is a russet").replace(
        "said by the buyer\n    .", "said by the buyer\n    , not kind(A, russet)."
    )
    assert (folder / "knowledge.al").read_text() == expected
    assert load_domain(folder).knowledge.axioms[0].text == (
        "a brown apple is spoilt, unless it is a russet"
    )


def test_a_contradiction_is_mended_by_either_rule(tmp_path: Path) -> None:
    both = f"{KNOWLEDGE}\n%% a russet is fresh\nfresh(A) if kind(A, russet).\n"
    revisions = Revisions(write_apples(tmp_path / "apples", knowledge=both))
    first, *_ = rule_revisions(doubted(revisions, wanted="fresh"))
    assert first.decision.label == "fresh"
    assert first.about == "a brown apple is spoilt."


def test_a_scene_that_no_rule_decides_has_no_rule_to_revise(revisions: Revisions) -> None:
    assert rule_revisions(doubted(revisions, ("red", "no", "yes"))) == ()


def test_a_learned_axiom_is_narrowed_to_one_of_the_person(folder: Path) -> None:
    domain = load_domain(folder)
    (axiom,) = read_axioms("%% soft ones spoil\n-fresh(S) if soft(S).", domain.knowledge.signature)
    learned = replace(axiom, origin=Origin(learned=True, support=6, pictures=("a.png",)))
    agent = apple_agent(domain, taught=False)
    agent.know(agent.known.knowing([learned], ()))
    revisions = Revisions(folder, agent=agent)
    before = revisions.texts
    exception, *_ = rule_revisions(doubted(revisions, ("red", "no", "yes"), wanted="fresh"))
    assert exception.about == "soft ones spoil"
    revisions.take(exception)
    assert agent.learned == ()
    assert "soft ones spoil, unless" in revisions.texts["knowledge.al"]
    revisions.take_back(1)
    assert revisions.texts == before
    assert [(str(one), one.origin) for one in agent.learned] == [(str(axiom), learned.origin)]


# A feature that was misread -------------------------------------------------------------------


def test_misreadings_are_those_of_which_the_class_follows(revisions: Revisions) -> None:
    found = misreadings(doubted(revisions, ("red", "yes", "no")), certainty={"brown": 0.6})
    assert [(one.reading, one.decision.label) for one in found] == [(("brown", "no"), "fresh")]


def test_a_feature_that_is_doubted_may_be_anything_else(revisions: Revisions) -> None:
    found = misreadings(doubted(revisions), about=[("kind", None)])
    assert [one.reading for one in found] == [("kind", "green"), ("kind", "red")]
    (said,) = misreadings(doubted(revisions), about=[("kind", "red")])
    assert said.reading == ("kind", "red")


def test_a_label_is_a_cell_of_the_table_and_is_taken_back(folder: Path, tmp_path: Path) -> None:
    data = write_apple_pictures(tmp_path / "data")
    table = data / "scenes.csv"
    table.write_bytes(table.read_bytes().replace(b"\n", b"\r\n"))
    before = table.read_bytes()
    agent = apple_agent(load_domain(folder))
    revisions = Revisions(folder, agent=agent, dataset=data)
    picture = data / "00.png"
    (label,) = misreadings(doubted(revisions, VECTORS[0]), about=[("brown", "no")])
    revisions.take(label, picture=picture)
    assert table.read_bytes() == before.replace(
        b"00.png,spoilt,green,yes,yes", b"00.png,spoilt,green,no,yes"
    )
    assert agent.experience["green", "no", "yes"] == {"spoilt": 2}
    revisions.take_back(1)
    assert table.read_bytes() == before
    assert agent.experience["green", "no", "yes"] == {"spoilt": 1}
    assert agent.trained_on == frozenset()


def test_a_new_picture_gets_a_row(folder: Path, tmp_path: Path) -> None:
    data = write_apple_pictures(tmp_path / "data")
    table = data / "scenes.csv"
    table.write_text(table.read_text().rstrip("\n"))
    before = table.read_bytes()
    (data / "new, one.png").write_bytes((data / "00.png").read_bytes())
    revisions = Revisions(folder, dataset=data)
    (label,) = misreadings(doubted(revisions, wanted="fresh"), about=[("kind", "red")])
    revisions.take(label, picture=data / "new, one.png")
    assert table.read_bytes() == before + b'\n"new, one.png",fresh,red,,\n'
    assert len(Dataset.load(data, load_domain(folder))) == 25
    revisions.take_back(1)
    assert table.read_bytes() == before


def test_a_label_needs_a_dataset_a_column_and_a_picture_inside(
    folder: Path, tmp_path: Path
) -> None:
    data = write_apple_pictures(tmp_path / "data")
    revisions = Revisions(folder)
    (label,) = misreadings(doubted(revisions), about=[("kind", "red")])
    with pytest.raises(RevisionError, match=r"no dataset is at hand .* give --data FOLDER"):
        revisions.take(label, picture=data / "00.png")
    outside = tmp_path / "outside.png"
    outside.write_bytes((data / "00.png").read_bytes())
    with pytest.raises(DatasetError, match=r"outside\.png: lies outside of .* copy the picture"):
        Revisions(folder, dataset=data).take(label, picture=outside)
    rows = [line.rsplit(",", 1)[0] for line in (data / "scenes.csv").read_text().splitlines()]
    (data / "scenes.csv").write_text("\n".join(rows) + "\n")
    (soft,) = misreadings(doubted(revisions), about=[("soft", "yes")])
    with pytest.raises(RevisionError, match=r"scenes\.csv:1: the table has no column 'soft'"):
        Revisions(folder, dataset=data).take(soft, picture=data / "00.png")


def test_a_label_that_stands_there_already_is_refused(folder: Path, tmp_path: Path) -> None:
    data = write_apple_pictures(tmp_path / "data")
    revisions = Revisions(folder, dataset=data)
    (label,) = misreadings(doubted(revisions), about=[("kind", "green")])
    with pytest.raises(RevisionError, match=r"says so of 00\.png already"):
        revisions.take(label, picture=data / "00.png")


# A rule that is missing -----------------------------------------------------------------------


def test_a_reason_is_a_rule(revisions: Revisions) -> None:
    questions = Questions(revisions.known.domain)
    rule = reason_given(questions, "these three apples are spoilt because they are soft")
    assert rule == Candidate("spoilt", (SOFT,))
    (proposal,) = new_rule(doubted(revisions, ("red", "no", "yes")), rule)
    assert proposal.statement == "-fresh(S) if soft(S)."
    assert proposal.sentence == "if the apple is soft, then it is spoilt"
    assert proposal.decision.label == "spoilt"
    assert proposal.consequences is not None
    assert (proposal.consequences.gained, proposal.consequences.lost) == (3, 0)


@pytest.mark.parametrize(
    ("said", "complaint"),
    [
        ("it is brown because it is soft", "names no class"),
        ("it is spoilt because it is fresh", "names no feature"),
        ("it is spoilt because it is blue", "not understood"),
        ("it is spoilt because it is soft and it is firm", "not understood"),
        ("it is spoilt because it is soft or it is red", "does not state one"),
    ],
)
def test_what_is_no_reason_is_said(revisions: Revisions, said: str, complaint: str) -> None:
    with pytest.raises(QuestionError, match=complaint) as problem:
        reason_given(Questions(revisions.known.domain), said)
    assert "\n" not in str(problem.value)


def test_rules_that_ask_less_give_way_to_a_new_one(revisions: Revisions) -> None:
    rule = Candidate("fresh", (PathCondition("kind", ("russet",)), BROWN))
    (proposal,) = new_rule(doubted(revisions), rule)
    assert proposal.exceptions == ("a brown apple is spoilt, unless it is a russet",)
    assert proposal.decision.label == "fresh"
    before = revisions.texts
    revisions.take(proposal)
    assert Revisions(revisions.folder).known.reasoner.decide(RUSSET).label == "fresh"
    revisions.take_back(1)
    assert revisions.texts == before


def test_rules_give_way_to_one_that_does_not_apply_to_the_scene_itself(
    revisions: Revisions,
) -> None:
    rule = Candidate("fresh", (PathCondition("kind", ("russet",)), BROWN))
    (proposal,) = new_rule(doubted(revisions, ("russet", "no", "no")), rule)
    assert proposal.exceptions == ("a brown apple is spoilt, unless it is a russet",)


def test_a_rule_that_can_never_be_used_is_refused(revisions: Revisions) -> None:
    with pytest.raises(RevisionError, match=r"can never be used: .* say first which rule is wrong"):
        new_rule(doubted(revisions), Candidate("fresh", (BROWN,)))


def test_a_proposal_that_breaks_the_knowledge_is_not_taken(revisions: Revisions) -> None:
    good, *_ = rule_revisions(doubted(revisions, wanted="fresh"))
    statement = "\nfresh(A) if brown(A).\n"
    broken = replace(good, edits=(Edit("knowledge.al", len(KNOWLEDGE), "", statement),))
    with pytest.raises(KnowledgeError, match=r"knowledge\.al:\d+:1: .* can never be used"):
        revisions.take(broken)
    assert revisions.texts["knowledge.al"] == KNOWLEDGE
    assert revisions.all == ()


def test_rules_by_example_cover_the_examples_and_nothing_else(revisions: Revisions) -> None:
    domain = revisions.known.domain
    examples = [n for n, vector in enumerate(VECTORS) if vector[2] == "yes"]
    assert rules_by_example(domain, ALL, examples, "spoilt") == (Candidate("spoilt", (SOFT,)),)
    for count in (1, 2, 3):
        some = examples[:count]
        for rule in rules_by_example(domain, ALL, some, "spoilt"):
            fit = fit_of(domain, ALL, rule, some)
            assert (fit.covered, fit.missed, fit.against) == (tuple(some), (), ())


def test_examples_that_nothing_tells_apart_give_no_rule(revisions: Revisions) -> None:
    domain = revisions.known.domain
    same = AnnotatedScenes((RUSSET, RUSSET), ("fresh", "spoilt"), ("a.png", "b.png"))
    assert rules_by_example(domain, same, [0], "fresh") == ()
    with pytest.raises(RevisionError, match="no example is given"):
        rules_by_example(domain, ALL, [], "fresh")


# What would change ----------------------------------------------------------------------------


def every_proposal(revisions: Revisions, vector: tuple[str | None, ...]) -> list[Proposal]:
    found: list[Proposal] = []
    for wanted in ("fresh", "spoilt"):
        case = doubted(revisions, vector, wanted=wanted)
        found += rule_revisions(case, most=9)
        for rule in rules_by_example(
            case.known.domain, ALL, [VECTORS.index(vector)], wanted, most=9
        ):
            try:
                found += new_rule(case, rule)
            except RevisionError:
                continue
    return found


@pytest.mark.parametrize("vector", VECTORS)
def test_consequences_are_those_of_deciding_every_scene_again(
    folder: Path, tmp_path: Path, vector: tuple[str, ...]
) -> None:
    revisions = Revisions(folder)
    before = {each: revisions.known.reasoner.decide(each).label for each in VECTORS}
    proposals = every_proposal(revisions, vector)
    assert proposals
    for number, proposal in enumerate(proposals):
        text = revisions.texts["knowledge.al"]
        for edit in proposal.edits:
            text = edit.applied(text)
        after = load_domain(write_apples(tmp_path / str(number), knowledge=text))
        changed = []
        for place, each in enumerate(VECTORS):
            decided = Reasoner(after.knowledge, after.schema).decide(each).label
            if decided != before[each]:
                changed.append((f"{place}.png", class_of(each), before[each], decided))
        assert proposal.consequences is not None
        assert [
            (scene.picture, scene.label, scene.before, scene.after)
            for scene in proposal.consequences.changed
            if scene.before != scene.after
        ] == changed


def test_without_annotated_scenes_there_are_no_consequences(revisions: Revisions) -> None:
    for proposal in rule_revisions(doubted(revisions, wanted="fresh", scenes=NONE)):
        assert proposal.consequences is None


# Taking and taking back -----------------------------------------------------------------------

LINE_ENDS = {"lf": KNOWLEDGE, "crlf": "\ufeff" + KNOWLEDGE.replace("\n", "\r\n"),
             "no end": KNOWLEDGE.rstrip()}  # fmt: skip


@settings(max_examples=12)
@given(data=st.data())
def test_what_is_taken_and_taken_back_leaves_nothing(
    data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    text = LINE_ENDS[data.draw(st.sampled_from(sorted(LINE_ENDS)))]
    folder = write_apples(tmp_path_factory.mktemp("taken") / "apples", knowledge=text)
    agent = apple_agent(load_domain(folder))
    revisions = Revisions(folder, agent=agent)
    states = [(revisions.texts, agent.deciding.decide_all(VECTORS))]
    for _ in range(data.draw(st.integers(1, 3))):
        vector = data.draw(st.sampled_from(VECTORS))
        proposals = every_proposal(revisions, vector)
        if not proposals:
            break
        revisions.take(data.draw(st.sampled_from(proposals)))
        states.append((revisions.texts, agent.deciding.decide_all(VECTORS)))
        loaded = working_knowledge(load_domain(folder)).reasoner.decide_all(VECTORS)
        assert loaded == agent.reasoner.decide_all(VECTORS)
    for number in range(len(states) - 1, 0, -1):
        assert (revisions.texts, agent.deciding.decide_all(VECTORS)) == states[number]
        revisions.take_back(number)
    assert (revisions.texts, agent.deciding.decide_all(VECTORS)) == states[0]
    assert (folder / "knowledge.al").read_bytes() == text.encode()


def test_an_earlier_revision_is_taken_back_and_a_later_one_stays(revisions: Revisions) -> None:
    soft, red = (
        Candidate("spoilt", (SOFT,)),
        Candidate("spoilt", (PathCondition("kind", ("red",)), SOFT)),
    )
    for rule in (soft, red):
        revisions.take(new_rule(doubted(revisions, ("red", "no", "yes")), rule)[0])
    revisions.take_back(1)
    assert [str(axiom) for axiom in revisions.known.domain.knowledge.axioms[2:]] == [
        "-fresh(S) if kind(S, red), soft(S)."
    ]
    assert [revision.taken_back is None for revision in revisions.all] == [False, True]


def test_what_a_later_revision_changed_is_not_taken_back_first(revisions: Revisions) -> None:
    revisions.take(
        new_rule(doubted(revisions, ("red", "no", "yes")), Candidate("spoilt", (SOFT,)))[0]
    )
    revisions.take(rule_revisions(doubted(revisions, ("red", "no", "yes"), wanted="fresh"))[0])
    with pytest.raises(RevisionError, match=r"revision 2 changed what it wrote; take that one"):
        revisions.take_back(1)
    revisions.take_back(2)
    revisions.take_back(1)
    assert revisions.texts["knowledge.al"] == KNOWLEDGE


def test_what_a_person_changed_since_is_not_taken_back(folder: Path, revisions: Revisions) -> None:
    revisions.take(
        new_rule(doubted(revisions, ("red", "no", "yes")), Candidate("spoilt", (SOFT,)))[0]
    )
    text = (folder / "knowledge.al").read_text()
    (folder / "knowledge.al").write_text(text.replace("soft(S).", "soft(S), brown(S)."))
    with pytest.raises(RevisionError, match=r"knowledge\.al has changed: '.*' does not stand"):
        revisions.take_back(1)


def test_what_cannot_be_taken_back_is_said(revisions: Revisions) -> None:
    with pytest.raises(RevisionError, match="nothing was revised, so nothing is taken back"):
        revisions.take_back(1)
    revisions.take(rule_revisions(doubted(revisions, wanted="fresh"))[0])
    with pytest.raises(RevisionError, match=r"there is no revision 7; it must be one of: 1"):
        revisions.take_back(7)
    revisions.take_back(1)
    with pytest.raises(RevisionError, match="revision 1 was taken back already"):
        revisions.take_back(1)


def test_a_folder_that_cannot_be_written_changes_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    agent = apple_agent(load_domain(folder))
    revisions = Revisions(folder, agent=agent)
    (proposal, *_) = rule_revisions(doubted(revisions, wanted="fresh"))

    def refuse(path: Path, _: bytes) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(revisions_module, "write_whole", refuse)
    with pytest.raises(PermissionError):
        revisions.take(proposal)
    assert agent.reasoner.decide(RUSSET).label == "spoilt"
    assert (folder / "knowledge.al").read_text() == KNOWLEDGE


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DomainError, match=r"is neither a model nor a domain folder; give the"):
        Revisions(tmp_path)


# The record -----------------------------------------------------------------------------------


def test_the_record_keeps_lines_and_adds_to_them(folder: Path, revisions: Revisions) -> None:
    revisions.take(rule_revisions(doubted(revisions, wanted="fresh"))[0])
    first = (folder / "revisions.jsonl").read_bytes()
    revisions.take_back(1)
    both = (folder / "revisions.jsonl").read_bytes()
    assert both.startswith(first)
    assert [json.loads(line)["what"] for line in both.splitlines()] == ["taken", "taken back"]


EDIT = '{"file":"../x","at":0,"before":"","after":"x"}'
DAMAGE = {
    "no JSON": "{",
    "another key": '{"what":"taken back","number":1,"at":"2026-01-01T00:00:00+00:00","x":1}',
    "a number as text": '{"what":"taken back","number":"1","at":"2026-01-01T00:00:00+00:00"}',
    "another file": '{"what":"taken","number":1,"at":"2026-01-01T00:00:00+00:00",'
    f'"cause":"a rule is missing","sentence":"x","edits":[{EDIT}]}}',
    "numbers left out": '{"what":"taken","number":2,"at":"2026-01-01T00:00:00+00:00",'
    '"cause":"a rule is missing","sentence":"x","edits":[]}',
    "no text": "\udcff",
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_record_is_one_sentence(folder: Path, damage: str) -> None:
    (folder / "revisions.jsonl").write_bytes(DAMAGE[damage].encode(errors="surrogateescape"))
    with pytest.raises(RevisionError, match=r"revisions\.jsonl(:1)?: is damaged \(") as problem:
        Revisions(folder)
    assert "\n" not in str(problem.value)


def test_a_record_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record = RecordFile(tmp_path / "revisions.jsonl")
    record.append(TakenBack(number=1, at="2026-01-01T00:00:00+00:00"))
    monkeypatch.setattr("seewhy.revision.record.LARGEST", 10)
    with pytest.raises(RevisionError, match="has more than 0 MiB, which no record has"):
        record.lines()


def test_another_record_may_be_kept(folder: Path) -> None:
    class InMemory:
        def __init__(self) -> None:
            self.kept: list[object] = []

        def lines(self) -> list[object]:
            return self.kept

        def append(self, line: object) -> None:
            self.kept.append(line)

    record = InMemory()
    revisions = Revisions(folder, record=record)  # type: ignore[arg-type]
    revisions.take(rule_revisions(doubted(revisions, wanted="fresh"))[0])
    revisions.take_back(1)
    assert len(record.kept) == 2
    assert not (folder / "revisions.jsonl").exists()
