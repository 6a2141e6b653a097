"""Networks that are trained on a domain's own drawings before they see photographs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from conftest import DOMAIN, KNOWLEDGE, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.agent.pretraining import is_drawn, pretrained
from seewhy.cli.main import main
from seewhy.data.dataset import Dataset
from seewhy.data.making import make_dataset
from seewhy.domain.domain import Domain, load_domain
from seewhy.errors import DatasetError, DomainError
from seewhy.perception.course import Course

SOURCE = """\
import numpy as np
RGB = {"red": (200, 50, 40), "green": (40, 160, 60), "blue": (50, 60, 200)}

def draw(*, seed, index, size):
    rng = np.random.default_rng([seed, index])
    colour, is_round = list(RGB)[index % 3], ("yes", "no")[index // 3 % 2]
    y, x = np.mgrid[:size, :size] / size - rng.uniform(0.4, 0.5, 2)[:, None, None]
    inside = x * x + y * y < 0.11 if is_round == "yes" else np.maximum(abs(x), abs(y)) < 0.33
    picture = np.where(inside[..., None], RGB[colour], 225).astype(np.uint8)
    good = colour == "red" or is_round == "yes"
    return picture, {"colour": colour, "round": is_round}, "good" if good else "bad"
"""
pytestmark = pytest.mark.usefixtures("in_one_process")


DRAWN = DOMAIN.replace('subject = "the tile"', 'subject = "the tile"\nsource = "draw.py"').replace(
    "shift = 0.05", "shift = 0.05\ndrawn = 40"
)
"""Tiles that a file of the folder draws; forty of them are trained on first."""


def domain_that_draws(folder: Path, text: str) -> Domain:
    write_domain(folder, domain=text)
    (folder / "draw.py").write_text(SOURCE)
    return load_domain(folder)


@pytest.fixture
def able(tmp_path: Path) -> Domain:
    """Networks of these learn tiles."""
    return domain_that_draws(tmp_path / "able", DRAWN)


@pytest.fixture
def drawing(tmp_path: Path) -> Domain:
    """Networks of these see pictures twice: for what does not ask how well they see."""
    return domain_that_draws(tmp_path / "tiles", f"{DRAWN}\n[networks]\nepochs = 2\n")


@pytest.fixture
def few(tmp_path: Path, drawing: Domain) -> Dataset:
    """Twelve pictures that nobody drew with the source."""
    return Dataset.load(write_tiles(tmp_path / "few", count=12), drawing)


def weights(agent: Agent) -> list[bytes]:
    assert agent.extractor is not None
    return [
        tensor.numpy().tobytes()
        for network in agent.extractor.networks.values()
        for tensor in network.state_dict().values()
    ]


def test_drawings_alone_teach_the_features(able: Domain, tmp_path: Path) -> None:
    drawn: list[int] = []
    extractor = pretrained(
        able, count=120, course=Course(workers=1, on_picture=drawn.append)
    ).extractor
    assert drawn == list(range(1, 121))
    scenes = Dataset.load(write_tiles(tmp_path / "others", count=48), able)
    probabilities = extractor.probabilities(scenes.pictures(16))
    for n, (key, feature) in enumerate(able.features.items()):
        true = [feature.values.index(str(vector[n])) for vector in scenes.vectors]
        assert (probabilities[key].argmax(axis=1) == true).mean() > 0.8


def test_as_many_drawings_as_the_domain_says_come_first(drawing: Domain, few: Dataset) -> None:
    counted: list[int] = []
    first = Agent(drawing).fit(few, workers=1, on_picture=counted.append)
    assert len(counted) == 40
    assert weights(first) == weights(Agent(drawing).fit(few, drawn=40, workers=1))
    assert weights(first) != weights(Agent(drawing).fit(few, drawn=0, workers=1))


def test_no_drawings_come_before_drawings_or_after_a_model(
    drawing: Domain, few: Dataset, tmp_path: Path
) -> None:
    made = make_dataset(drawing, tmp_path / "made", count=24, workers=1)
    drawings = Dataset.load(made.folder, drawing)
    assert is_drawn(drawings)
    assert not is_drawn(few)
    counted: list[int] = []
    agent = Agent(drawing).fit(drawings, workers=1, on_picture=counted.append)
    Agent(drawing).fit(few, start_from=agent, workers=1, on_picture=counted.append)
    assert counted == []


def test_an_interrupted_pretraining_goes_on_with_the_same_weights(
    drawing: Domain, few: Dataset, tmp_path: Path
) -> None:
    class StoppedError(Exception):
        pass

    def stop(number: int) -> None:
        if number == 25:
            raise StoppedError

    whole = Agent(drawing).fit(few, workers=1)
    folder = tmp_path / "checkpoints"
    with pytest.raises(StoppedError):
        Agent(drawing).fit(few, workers=1, checkpoints=folder, on_picture=stop)
    assert weights(Agent(drawing).fit(few, workers=1, checkpoints=folder)) == weights(whole)


def test_classes_left_out_are_not_drawn_either(drawing: Domain, few: Dataset) -> None:
    both = pretrained(drawing, count=36, course=Course(workers=1)).extractor
    good = pretrained(drawing, count=36, without=["bad"], course=Course(workers=1)).extractor
    pictures = np.stack([few.pictures(16)[n] for n in range(4)])
    assert not np.allclose(
        both.probabilities(pictures)["round"], good.probabilities(pictures)["round"]
    )
    # Bad tiles alone have corners and are green or blue: what is left says so.
    assert good.records["colour"].training_pictures < both.records["colour"].training_pictures


def test_what_no_photograph_shows_is_learned_from_drawings(drawing: Domain, few: Dataset) -> None:
    without_green = few.take([n for n, v in enumerate(few.vectors) if v[0] != "green"])
    agent = Agent(drawing).fit(without_green, workers=1)
    assert agent.decide({"colour": "green", "round": "yes"}) == "good"
    assert agent.decide({"colour": "green", "round": "no"}) == "bad"
    counted = sum(sum(counts.values()) for counts in agent.experience.values())
    assert counted == 40 + len(without_green.of_split("train"))


def test_a_value_that_no_photograph_shows_is_not_forgotten(able: Domain, few: Dataset) -> None:
    few = replace(few, domain=able)
    red = few.take([n for n, v in enumerate(few.vectors) if v[0] == "red" or v[1] == "yes"])
    only = red.take([n for n, v in enumerate(red.vectors) if v[0] != "green"])
    agent = Agent(able).fit(only, drawn=90, workers=1)
    assert agent.extractor is not None
    green = [n for n, v in enumerate(few.vectors) if v[0] == "green"]
    seen = agent.extractor.probabilities(few.pictures(16)[green])["colour"].argmax(axis=1)
    assert (seen == able.features["colour"].values.index("green")).all()


def test_a_domain_without_a_source_cannot_draw(few: Dataset, drawing: Domain) -> None:
    bare = replace(drawing, source=None)
    with pytest.raises(DomainError, match="the domain 'tiles' has no source of pictures"):
        Agent(bare).fit(replace(few, domain=bare), workers=1)


def test_the_command_says_how_many(
    drawing: Domain,
    few: Dataset,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def train(drawn: int) -> tuple[int, str]:
        command = ["train", drawing.folder, "--data", few.folder, "--out", tmp_path / "model"]
        monkeypatch.setattr("sys.argv", ["seewhy", *map(str, command), "--drawn", str(drawn)])
        with pytest.raises(SystemExit) as ended:
            main()
        return int(ended.value.code or 0), capsys.readouterr().err

    code, said = train(-1)
    assert code == 2
    assert "--drawn" in said
    assert train(0)[0] == 0
    agent = Agent.load(tmp_path / "model")
    assert weights(agent) == weights(Agent(drawing).fit(few, drawn=0))


# What the network of the class was shown ------------------------------------------------------


@pytest.fixture
def three(tmp_path: Path) -> Domain:
    """Tiles with a class that is never drawn, and few passes."""
    folder = write_domain(
        tmp_path / "three",
        domain=DOMAIN.replace('subject = "the tile"', 'subject = "the tile"\nsource = "draw.py"')
        + '\n[classes.odd]\nliteral = "odd(T)"\nsay = "odd"\n\n[networks]\nepochs = 2\n',
        knowledge=KNOWLEDGE.replace(
            "#static good(tile).", "#static good(tile).\n#static odd(tile)."
        ),
    )
    (folder / "draw.py").write_text(SOURCE)
    return load_domain(folder)


def labelled(scenes: Dataset, domain: Domain, *labels: str) -> Dataset:
    """The scenes with other classes, in turn."""
    relabelled = [
        replace(scene, label=labels[n % len(labels)], split=None)
        for n, scene in enumerate(scenes.scenes)
    ]
    return replace(scenes, domain=domain, scenes=tuple(relabelled))


def witness(domain: Domain) -> Agent:
    return Agent(domain, reading="with_class", known_share=1.0)


def shown(agent: Agent) -> frozenset[str]:
    assert agent.extractor is not None
    return agent.extractor.shown("class")


def test_a_class_was_shown_by_pictures_or_to_what_was_started_from(
    three: Domain, few: Dataset
) -> None:
    usual, odd = labelled(few, three, "good", "bad"), labelled(few, three, "odd", "bad")
    first = witness(three).fit(usual, drawn=0, answers=False, workers=1)
    assert shown(first) == {"good", "bad"}
    then = witness(three).fit(odd, start_from=first, answers=False, workers=1)
    assert shown(then) == {"good", "bad", "odd"}
    assert shown(first.fit(odd, start_from=first, answers=False, workers=1)) == shown(then)
    # Networks for larger pictures begin anew to tell classes apart.
    larger = replace(three, pictures=three.pictures.model_copy(update={"size": 20}))
    anew = witness(larger).fit(
        labelled(few, larger, "good", "bad"), start_from=then, answers=False, workers=1
    )
    assert shown(anew) == {"good", "bad"}


def test_classes_with_other_names_are_other_classes(three: Domain, few: Dataset) -> None:
    first = witness(three).fit(
        labelled(few, three, "good", "bad"), drawn=0, answers=False, workers=1
    )
    folder = three.folder
    text = (folder / "domain.toml").read_text().replace("[classes.bad]", "[classes.poor]")
    (folder / "domain.toml").write_text(text)
    renamed = load_domain(folder)
    then = witness(renamed).fit(
        labelled(few, renamed, "good", "odd"), start_from=first, answers=False, workers=1
    )
    assert shown(then) == {"good", "odd"}


def test_a_class_was_shown_by_drawings_of_which_the_class_was_learned(
    three: Domain, few: Dataset
) -> None:
    odd = labelled(few, three, "odd", "bad")
    taught = witness(three).fit(odd, drawn=24, answers=False, workers=1)
    assert shown(taught) == {"good", "bad", "odd"}
    features = pretrained(three, count=24, course=Course(workers=1))
    assert set(features.labels) == {"good", "bad"}
    later = witness(three).fit(odd, start_from=features, answers=False, workers=1)
    assert shown(later) == {"odd", "bad"}


def test_networks_begin_with_one_thing(three: Domain, few: Dataset) -> None:
    first = witness(three).fit(
        labelled(few, three, "good", "bad"), drawn=0, answers=False, workers=1
    )
    with pytest.raises(DatasetError) as problem:
        witness(three).fit(
            labelled(few, three, "good", "odd"), start_from=first, drawn=24, workers=1
        )
    assert str(problem.value) == (
        "start_from, drawn: networks begin with what they know (--from) or with new "
        "drawings (--drawn); leave one of the two out"
    )
