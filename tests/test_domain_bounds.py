"""What a stranger's domain folder may say: within bounds of size and time, and nothing is run."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import DOMAIN, KNOWLEDGE, QUESTIONS, write_domain
from seewhy.dialogue.answer import answer_templates
from seewhy.dialogue.question import Questions
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DomainError, SeeWhyError
from seewhy.files.toml_file import line_of
from seewhy.knowledge.program import program_text
from seewhy.text.slots import filled, wrong_slot


def refused(tmp_path: Path, **texts: str) -> str:
    """What is said of a domain of tiles with other texts, without its folder."""
    folder = write_domain(tmp_path / "tiles", **texts)
    with pytest.raises(SeeWhyError) as problem:
        Questions(load_domain(folder))
    said = str(problem.value)
    assert len(said.splitlines()) == 1
    assert len(said) < 700
    return said.replace(f"{folder}/", "")


@pytest.mark.parametrize(
    ("before", "after", "error"),
    [
        (
            'title = "Tiles"',
            f'title = "{"T" * 201}"',
            "domain.toml:3: 'domain.title' may have at most 200 characters, got 201",
        ),
        (
            'subject = "the tile"',
            'subject = "the {class}"',
            "domain.toml:5: 'domain.subject': must have no braces, got 'the {class}'",
        ),
        (
            'name = "colour"',
            f'name = "{"c" * 3000}"',
            "domain.toml:13: 'features.colour.name' may have at most 2000 characters, got 3000",
        ),
        ("[domain]", f"n = {'9' * 5000}\n[domain]", "domain.toml: has a number of thousands of "
         "digits; write a smaller"),
        ("[domain]", f"n = {'[' * 5000}\n[domain]", "domain.toml: has lists in lists in lists, "
         "which no table has"),
        ("[domain]", f"# {'x' * 4_000_000}\n[domain]", "domain.toml: has more than 4,000,000 "
         "characters; say it in fewer"),
    ],
    ids=range(6),
)  # fmt: skip
def test_what_is_too_large_is_refused(tmp_path: Path, before: str, after: str, error: str) -> None:
    assert before in DOMAIN
    assert refused(tmp_path, domain=DOMAIN.replace(before, after, 1)) == error


def renamed(old: str, new: str) -> dict[str, str]:
    return {
        "domain": DOMAIN.replace(f"features.{old}", f"features.{new}"),
        "knowledge": KNOWLEDGE.replace(f"{old}(", f"{new}("),
        "questions": QUESTIONS.replace(f'"{old}"', f'"{new}"'),
    }


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("good", "a class of this domain"),
        ("scene", "a whole picture"),
        ("class", None),
        ("image", None),
    ],
)
def test_a_feature_has_a_name_of_its_own(tmp_path: Path, name: str, what: str | None) -> None:
    texts = renamed("colour", name)
    if name == "good":
        name = "colour"
        texts = {"domain": DOMAIN.replace("classes.good", "classes.colour")}
    said = refused(tmp_path, **texts)
    assert said.startswith("domain.toml:")
    assert f": '{name}' is what " in said
    assert said.endswith(" called; call the feature otherwise")
    assert what is None or what in said


@pytest.mark.parametrize(
    "key", ['"a\\u001b[2J"', '""', '" a"', '"a\\nb"'], ids=["escape", "empty", "space", "line"]
)
def test_names_are_of_visible_characters(tmp_path: Path, key: str) -> None:
    said = refused(tmp_path, domain=DOMAIN.replace("[classes.good]", f"[classes.{key}]"))
    assert "': a name must be of visible characters, got '" in said
    assert said.isprintable()


@pytest.mark.parametrize(
    "template",
    [
        "{it.__class__}",
        "{it[0]}",
        "{it!r}",
        "{it:>1000000000}",
        "{0}",
        "{}",
        "{{it}}",
        "{it",
        "it}",
    ],
)
def test_answers_have_the_slots_that_exist_and_no_others(tmp_path: Path, template: str) -> None:
    text = QUESTIONS.replace('fillers = ["please"]\n', "")
    folder = write_domain(
        tmp_path / "tiles", questions=f'fillers = []\n[answers]\nyes = "yes, {template}"\n{text}'
    )
    with pytest.raises(
        DomainError, match=r"questions\.toml:3: the answer 'yes' has '.*', which is"
    ):
        answer_templates(load_domain(folder))


@given(st.text(alphabet="{}it.![]:09a", max_size=30))
def test_a_template_is_filled_with_what_is_given_or_is_refused(template: str) -> None:
    if wrong_slot(template, ("it",)) is None:
        assert filled(template, {"it": "{it}"}) == template
        assert "{" not in filled(template, {"it": "x"})
    else:
        assert "{" in template or "}" in template


def test_patterns_have_so_many_parts_that_may_be_left_out(tmp_path: Path) -> None:
    pattern = "is " + "[a] " * 30 + "{it} good or bad"
    text = QUESTIONS.replace("patterns = [", f'patterns = ["{pattern}", ', 1)
    assert ("has 30 parts that may be left out, more than 8; write several patterns") in refused(
        tmp_path, questions=text
    )


def test_there_are_so_many_wordings(tmp_path: Path) -> None:
    patterns = [f'"is {{it}} number {n} {"[a] " * 8}"' for n in range(200)]
    text = QUESTIONS.replace("patterns = [", f"patterns = [{', '.join(patterns)}, ", 1)
    assert " wordings of questions, more than 50,000; leave out patterns or [...]" in refused(
        tmp_path, questions=text
    )


def many_values(folder: Path, count: int) -> Domain:
    values = [f"v{number}" for number in range(count)]
    said = "".join(f'[features.kind.values.{v}]\nsay = "{{it}} is of {v}"\n' for v in values)
    return load_domain(
        write_domain(
            folder,
            domain='[domain]\nname = "tiles"\ntitle = "T"\nscene = "tile"\nsubject = "the tile"\n'
            f'[features.kind]\nname = "kind"\n{said}'
            '[classes.good]\nliteral = "good(T)"\nsay = "good"\n'
            '[classes.bad]\nliteral = "-good(T)"\nsay = "bad"\n',
            knowledge=f"#sort tile.\n#sort kind_of = {{{', '.join(values)}}}.\n"
            "#static kind(tile, kind_of).\n#static good(tile).\n"
            "good(T) if kind(T, v0).\n-good(T) if kind(T, v1).\n",
            questions='[[question]]\nasks = "feature_is"\nfeature = "kind"\n'
            'patterns = ["is {it} [really] of {value}"]\n',
        )
    )


def test_a_feature_of_hundreds_of_values_has_few_rules(tmp_path: Path) -> None:
    sizes = {}
    for count in (250, 500):
        domain = many_values(tmp_path / f"of_{count}", count)
        sizes[count] = len(program_text(domain.knowledge, domain.schema))
        assert len(Questions(domain).all) == 2 * count
    assert sizes[500] < 2.5 * sizes[250]  # a rule for each pair of values would make it 4


def seconds(work: Callable[[], object]) -> float:
    began = time.process_time()
    work()
    return time.process_time() - began


@pytest.mark.parametrize(
    "line",
    [
        "[" + " " * 100_000 + "x",
        "[a" + " a" * 50_000 + "]]]",
        "[" * 100_000,
        "[a]" + " " * 100_000 + "x",
        "a" * 100_000,
        "a" + " " * 100_000 + "x",
        '"' * 100_000,
        "a." * 50_000,
    ],
    ids=lambda line: repr(line[:4]),
)
def test_a_long_line_takes_no_time(line: str) -> None:
    assert seconds(lambda: line_of(line, ("a",))) < 0.5


@settings(max_examples=60)
@given(data=st.data())
def test_whatever_is_done_to_a_folder_it_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    texts = {"domain": DOMAIN, "questions": QUESTIONS}
    name = data.draw(st.sampled_from(sorted(texts)))
    text = texts[name]
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(at, min(len(text), at + 12)))
        new = data.draw(
            st.one_of(
                st.text(alphabet="{}[]=\"'.\n\\ #ab01-_", max_size=6),
                st.sampled_from(["{it}", "nan", "inf", "9" * 400, "true", "[[a]]", "1979-05-27"]),
            )
        )
        text = text[:at] + new + text[end:]
    folder = write_domain(tmp_path_factory.mktemp("spoilt") / "tiles", **{name: text})
    said = ""
    try:
        domain = load_domain(folder)
        Questions(domain)
        answer_templates(domain)
    except SeeWhyError as problem:
        said = str(problem)
    assert len(said.splitlines()) <= 1
