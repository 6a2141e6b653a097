"""A domain folder is read as a whole; what is wrong with it is said with file and line."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from conftest import DOMAIN, KNOWLEDGE, QUESTIONS
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import bundled_domains, domain_folder
from seewhy.errors import DomainError, KnowledgeError, SeeWhyError
from seewhy.files.toml_file import line_of
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.reasoner import Reasoner

FILES = {"domain.toml": DOMAIN, "knowledge.al": KNOWLEDGE, "questions.toml": QUESTIONS}
BUNDLED = "structure_stability"


def write(folder: Path, **changed: str) -> Path:
    folder.mkdir()
    for name, text in {**FILES, **changed}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def refusal(folder: Path) -> str:
    """The error without the folder, which it must name."""
    with pytest.raises((DomainError, KnowledgeError)) as caught:
        load_domain(folder)
    text = str(caught.value)
    assert isinstance(caught.value, SeeWhyError)
    assert "\n" not in text
    assert str(folder) in text
    return text.replace(f"{folder}/", "").replace(str(folder), "tiles")


def refused(tmp_path: Path, old: str, new: str, file: str = "domain.toml") -> str:
    """The error where one piece of a file is replaced."""
    assert FILES[file].count(old) >= 1
    return refusal(write(tmp_path / "tiles", **{file: FILES[file].replace(old, new, 1)}))


def line(text: str, file: str = "domain.toml") -> int:
    """The line of the good file where ``text`` first stands."""
    return FILES[file][: FILES[file].index(text)].count("\n") + 1


# What is loaded


def test_the_bundled_domain() -> None:
    domain = load_domain(BUNDLED)
    assert (domain.name, domain.scene, domain.subject) == (BUNDLED, "structure", "the structure")
    assert {key: feature.values for key, feature in domain.features.items()} == {
        "num_blocks": ("1", "2", "3", "4", "5"),
        "base": ("wide", "narrow"),
        "lean": ("yes", "no"),
        "block_displaced": ("yes", "no"),
    }
    assert domain.features["lean"].literals == {
        "yes": Literal("lean", ("structure",)),
        "no": Literal("lean", ("structure",), positive=False),
    }
    assert domain.features["num_blocks"].literals["3"] == Literal("num_blocks", ("structure", "3"))
    assert {key: str(scene_class.literal) for key, scene_class in domain.classes.items()} == {
        "stable": "stable(structure)",
        "unstable": "-stable(structure)",
    }
    assert domain.folder.name == BUNDLED
    assert Path(domain.knowledge.file) == domain.folder / "knowledge.al"
    assert BUNDLED in bundled_domains()


def everything(domain: Domain) -> dict[str, object]:
    """What a domain says, without where it stands."""
    return {
        **{key: value for key, value in vars(domain).items() if key not in ("folder", "knowledge")},
        "axioms": [
            (str(axiom), axiom.text, axiom.location.line, axiom.location.column)
            for axiom in domain.knowledge.axioms
        ],
        "sorts": {k: sort.members for k, sort in domain.knowledge.signature.sorts.items()},
        "schema": domain.schema,
    }


@pytest.mark.parametrize("name", bundled_domains())
def test_a_users_folder_is_worth_as_much_as_a_bundled_domain(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    for file in FILES:
        shutil.copy(domain_folder(name) / file, folder / file)
    bundled, copied = load_domain(name), load_domain(folder)
    assert everything(copied) == everything(bundled)
    assert load_domain(str(folder)).folder == folder
    vectors = [bundled.vector({}), *_some_vectors(bundled)]
    assert Reasoner(copied.knowledge, copied.schema).decide_all(vectors) == Reasoner(
        bundled.knowledge, bundled.schema
    ).decide_all(vectors)


def _some_vectors(domain: Domain) -> list[tuple[str | None, ...]]:
    return [
        domain.vector({key: feature.values[number % len(feature.values)]})
        for key, feature in domain.features.items()
        for number in range(5)
    ]


def test_a_folder_goes_before_a_bundled_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path / BUNDLED)
    monkeypatch.chdir(tmp_path)
    assert load_domain(BUNDLED).name == "tiles"


@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_files_of_any_editor(tmp_path: Path, mark: str, newline: str) -> None:
    plain = load_domain(write(tmp_path / "plain"))
    other = tmp_path / "other"
    other.mkdir()
    for name, text in FILES.items():
        (other / name).write_bytes((mark + text.replace("\n", newline)).encode())
    assert everything(load_domain(other)) == everything(plain)
    (other / "domain.toml").write_bytes(
        (mark + DOMAIN.replace("green = {", "gren = {").replace("\n", newline)).encode()
    )
    assert refusal(other).startswith(f"domain.toml:{line('green = {')}: 'gren' is no value")


def test_vectors_by_name(tmp_path: Path) -> None:
    domain = load_domain(write(tmp_path / "tiles"))
    assert domain.vector({"round": "no"}) == (None, "no")
    assert domain.named((None, "no")) == {"colour": None, "round": "no"}


def test_costs_thresholds_and_words(tmp_path: Path) -> None:
    text = DOMAIN.replace("threshold = 0.9\n", "threshold = 0.7\nchange_cost = 4\n", 1)
    domain = load_domain(write(tmp_path / "tiles", **{"domain.toml": text}))
    assert domain.schema.change_costs == {"colour": 4, "round": 1}
    assert domain.features["colour"].threshold == 0.7
    assert domain.features["round"].words == {"yes": ("round", "yes"), "no": ("cornered", "no")}
    assert domain.features["colour"].change["red"] == "paint it red"
    assert domain.classes["good"].words == ("good",)
    assert domain.classes["bad"].words == ("bad", "poor")


# Folders


def test_a_misspelt_name() -> None:
    with pytest.raises(DomainError) as caught:
        load_domain("structure_stabilty")
    assert str(caught.value) == (
        "'structure_stabilty' is neither a folder nor a bundled domain; "
        "did you mean 'structure_stability'?"
    )


def test_a_name_like_no_other() -> None:
    with pytest.raises(DomainError) as caught:
        domain_folder("zzz")
    assert str(caught.value) == (
        "'zzz' is neither a folder nor a bundled domain; "
        f"it must be one of: {', '.join(bundled_domains())}"
    )


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    path = write(tmp_path / "tiles") / "domain.toml"
    with pytest.raises(DomainError, match="is neither a folder nor a bundled domain"):
        load_domain(path)


@pytest.mark.parametrize("file", FILES)
def test_a_missing_file(tmp_path: Path, file: str) -> None:
    folder = write(tmp_path / "tiles")
    (folder / file).unlink()
    assert refusal(folder) == (
        f"tiles: the domain has no {file}; a domain is a folder with domain.toml, knowledge.al, "
        "questions.toml ('seewhy new NAME' writes one)"
    )


def test_a_file_that_is_not_text(tmp_path: Path) -> None:
    folder = write(tmp_path / "tiles")
    (folder / "domain.toml").write_bytes(b"[domain]\nname = '\xff'\n")
    assert refusal(folder) == (
        "domain.toml: cannot be read as UTF-8 text ('utf-8' codec can't decode byte 0xff in "
        "position 17: invalid start byte)"
    )


# domain.toml

NOT_TOML = {
    "no value": ("size = 16", "size =", 9, ":7: not valid TOML: invalid value"),
    "open text": (
        'name = "tiles"',
        'name = "tiles',
        2,
        ":14: not valid TOML: illegal character '\\n'",
    ),
    "no sign": ("shift = 0.05", "shift 0.05", 10, ":7: not valid TOML: expected '=' after a key "
                "in a key/value pair"),
}  # fmt: skip


@pytest.mark.parametrize("kind", NOT_TOML)
def test_what_is_not_toml(tmp_path: Path, kind: str) -> None:
    old, new, number, said = NOT_TOML[kind]
    assert refused(tmp_path, old, new) == f"domain.toml:{number}{said}"


def test_toml_that_ends_too_early_is_placed_at_its_end(tmp_path: Path) -> None:
    folder = write(tmp_path / "tiles", **{"domain.toml": DOMAIN + 'words = ["a",\n\n"b"'})
    last = DOMAIN.count("\n") + 3
    assert refusal(folder) == f"domain.toml:{last}:4: not valid TOML: unclosed array"


WRONG = {
    "unknown key, near": (
        "size = 16",
        "sizes = 16",
        "{}: 'pictures.sizes' is not known here; did you mean 'size'?",
    ),
    "unknown key of a feature": (
        "threshold = 0.9",
        "thresold = 0.9",
        "{}: 'features.colour.thresold' is not known here; did you mean 'threshold'?",
    ),
    "unknown key of a value": (
        'red = { say = "{it} is red", change',
        'red = { say = "{it} is red", chance',
        "{}: 'features.colour.values.red.chance' is not known here; did you mean 'change'?",
    ),
    "unknown table": (
        "[domain]",
        "[domian]",
        "{}: 'domian' is not known here; did you mean 'domain'?",
    ),
    "unknown key, none near": (
        'subject = "the tile"',
        'subject = "the tile"\nzzz = 1',
        "{+1}: 'domain.zzz' is not known here; it must be one of: name, title, scene, subject, "
        "source, eyes, reading, known_share",
    ),
    "missing key": ('title = "Tiles"\n', "", "1: 'domain.title' is missing; add it"),
    "missing words of a value": (
        'green = { say = "{it} is green", change',
        "green = { change",
        "{}: 'features.colour.values.green.say' is missing; add it",
    ),
    "name of two words": (
        'name = "tiles"',
        'name = "My Tiles"',
        "{}: 'domain.name': string should match pattern '^[a-z][a-z0-9_]*$', got 'My Tiles'",
    ),
    "too small": (
        "size = 16",
        "size = 5",
        "{}: 'pictures.size': input should be greater than or equal to 16, got 5",
    ),
    "too large": (
        "threshold = 0.9",
        "threshold = 1.5",
        "{}: 'features.colour.threshold': input should be less than or equal to 1, got 1.5",
    ),
    "no number": (
        "size = 16",
        'size = "big"',
        "{}: 'pictures.size': input should be a valid integer, unable to parse string as an "
        "integer, got 'big'",
    ),
    "not a list": (
        'words = ["bad", "poor"]',
        'words = "bad"',
        "{}: 'classes.bad.words' must be a list such as [\"…\"], got 'bad'",
    ),
    "scene is no sort": (
        'scene = "tile"',
        'scene = "tle"',
        "{}: scene = 'tle' is no sort of knowledge.al; did you mean 'tile'?",
    ),
    "scene has members": (
        'scene = "tile"',
        'scene = "hue"',
        "{}: the sort 'hue' stands for the picture and must be declared without members "
        "('#sort hue.'), see knowledge.al:2:1",
    ),
    "value not in the knowledge": (
        "green = {",
        "gren = {",
        "{}: 'gren' is no value of 'colour' in knowledge.al; did you mean 'green'?",
    ),
    "value of yes and no": (
        "yes = {",
        "maybe = {",
        "{}: 'maybe' is no value of 'round' in knowledge.al; it must be one of: yes, no",
    ),
    "class literal is none": (
        'literal = "good(T)"',
        'literal = "good(T"',
        "{}: 'good(T' is not a literal; write one such as stable(S) or -stable(S)",
    ),
    "class literal with not": (
        'literal = "good(T)"',
        'literal = "not good(T)"',
        "{}: 'not good(T)' is not a literal; write one such as stable(S) or -stable(S)",
    ),
    "class literal not declared": (
        'literal = "good(T)"',
        'literal = "god(T)"',
        "{}: the literal 'god(T)' of class 'good' uses 'god', which knowledge.al does not "
        "declare; did you mean 'good'?",
    ),
    "class literal without its argument": (
        'literal = "good(T)"',
        'literal = "good"',
        "{}: 'good' takes 1 argument, got 'good'",
    ),
    "class literal of a wrong sort": (
        'literal = "good(T)"',
        'literal = "colour(T, pink)"',
        "{}: 'pink' is not of sort 'hue' in the literal 'colour(T, pink)'; "
        "it must be one of: red, green, blue",
    ),
    "class literal with a variable that is not the scene": (
        'literal = "good(T)"',
        'literal = "colour(T, X)"',
        "{}: 'X' is not of sort 'hue' in the literal 'colour(T, X)'; "
        "it must be one of: red, green, blue",
    ),
    "two classes of one literal": (
        'literal = "-good(T)"',
        'literal = "good(tile)"',
        "{}: the literal 'good(tile)' stands for the classes 'good' and 'bad'; no scene could be "
        "one of them and not the other, give each class a literal of its own",
    ),
}


@pytest.mark.parametrize("kind", WRONG)
def test_what_is_wrong_in_domain_toml(tmp_path: Path, kind: str) -> None:
    old, new, said = WRONG[kind]
    number = line(old)
    expected = said.replace("{}:", f"{number}:").replace("{+1}", str(number + 1))
    assert refused(tmp_path, old, new) == f"domain.toml:{expected}"


def test_a_feature_that_is_not_declared(tmp_path: Path) -> None:
    text = DOMAIN.replace("features.colour", "features.color")
    assert refusal(write(tmp_path / "tiles", **{"domain.toml": text})) == (
        f"domain.toml:{line('[features.colour]')}: the feature 'color' is not declared in "
        "knowledge.al; did you mean 'colour'?"
    )


def test_a_value_that_nothing_says(tmp_path: Path) -> None:
    text = DOMAIN.replace('blue = { say = "{it} is blue", change = "paint it blue" }\n', "")
    assert refusal(write(tmp_path / "tiles", **{"domain.toml": text})) == (
        f"domain.toml:{line('[features.colour]')}: nothing says how 'colour' = 'blue' is said; "
        'add [features.colour.values.blue] with say = "…"'
    )


def test_fewer_than_two_classes(tmp_path: Path) -> None:
    text = DOMAIN[: DOMAIN.index("[classes.bad]")]
    assert refusal(write(tmp_path / "tiles", **{"domain.toml": text})) == (
        f"domain.toml:{line('[classes.good]')}: 'classes' must have at least 2 of them, got 1"
    )


def test_no_features(tmp_path: Path) -> None:
    text = DOMAIN[: DOMAIN.index("[features")] + DOMAIN[DOMAIN.index("[classes") :]
    assert refusal(write(tmp_path / "tiles", **{"domain.toml": text})) == (
        "domain.toml:1: 'features' is missing; add it"
    )


@pytest.mark.parametrize(
    ("declared", "got"),
    [
        ("#static size(hue).", "size(hue)"),
        ("#static size.", "size"),
        ("#static size(tile, hue, hue).", "size(tile, hue, hue)"),
    ],
)
def test_a_feature_of_another_shape(tmp_path: Path, declared: str, got: str) -> None:
    feature = '[features.size]\nname = "size"\nvalues.yes.say = "large"\n\n'
    at = DOMAIN.index("[classes.good]")
    folder = write(
        tmp_path / "tiles",
        **{
            "domain.toml": DOMAIN[:at] + feature + DOMAIN[at:],
            "knowledge.al": KNOWLEDGE + declared,
        },
    )
    assert refusal(folder) == (
        f"domain.toml:{line('[classes.good]')}: the feature 'size' must be declared as "
        f"'#static size(tile).' (yes or no) or '#static size(tile, SORT).', got '{got}' "
        f"(knowledge.al:{KNOWLEDGE.count(chr(10)) + 1}:1)"
    )


# The other files


def test_a_second_sort_without_members(tmp_path: Path) -> None:
    assert refused(tmp_path, "#sort tile.", "#sort tile.\n#sort box.", "knowledge.al") == (
        "knowledge.al:2:1: sort 'box' has no members; only 'tile', which stands for the picture, "
        "may be without"
    )


def test_wrong_knowledge_names_the_file_of_the_folder(tmp_path: Path) -> None:
    assert refused(tmp_path, "good(T) if colour(T, red)", "good(T) if color(T, red)",
                   "knowledge.al") == (
        f"knowledge.al:{line('good(T) if', 'knowledge.al')}:12: 'color' is not declared; "
        "did you mean 'colour'?"
    )  # fmt: skip


def test_knowledge_that_contradicts_itself(tmp_path: Path) -> None:
    number = line("good(T) if", "knowledge.al")
    assert refused(
        tmp_path, "colour(T, red).\n", "colour(T, red).\n-good(T) if colour(T, red).\n",
        "knowledge.al",
    ) == (
        f"knowledge.al:{number}:1: 'good(T) if colour(T, red).' can never be used: whenever its "
        f"conditions hold, the axiom in line {number + 1} ('-good(T) if colour(T, red).') "
        "concludes the opposite; change or remove one of the two"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("fillers =", "filers =", "1: 'filers' is not known here; did you mean 'fillers'?"),
        (
            'asks = "is_class"',
            'ask = "is_class"',
            "8: 'question.1.ask' is not known here; did you mean 'asks'?",
        ),
        (
            'patterns = ["is {it} {class}"]',
            "patterns = []",
            "9: 'question.1.patterns' must have at least 1 of them, got 0",
        ),
    ],
)
def test_what_is_wrong_in_questions_toml(tmp_path: Path, old: str, new: str, said: str) -> None:
    assert refused(tmp_path, old, new, "questions.toml") == f"questions.toml:{said}"


def test_no_questions_leave_all_to_the_grammar(tmp_path: Path) -> None:
    folder = write(tmp_path / "tiles", **{"questions.toml": ""})
    assert load_domain(str(folder)).questions.question == ()


# Lines

TABLES = """\
top = 1
[a]
x = 1
"quoted key" = 2
b.c = 3

[[row]]
x = 1
[[row]]
x = 2
[deep.er.still]
x = {y = 1}
"""


@pytest.mark.parametrize(
    ("keys", "number"),
    [
        (["top"], 1),
        (["a"], 2),
        (["a", "x"], 3),
        (["a", "quoted key"], 4),
        (["a", "b", "c"], 5),
        (["a", "b"], 5),
        (["a", "missing"], 2),
        (["row"], 7),
        (["row", "0", "x"], 8),
        (["row", "1", "x"], 10),
        (["row", "1", "missing"], 9),
        (["deep"], 11),
        (["deep", "er", "still", "x", "y"], 12),
        (["missing"], 1),
    ],
)
def test_the_line_of_a_key(keys: list[str], number: int) -> None:
    assert line_of(TABLES, keys) == number
