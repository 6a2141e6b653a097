"""How many pictures a second a model reads, reasons about and answers, in batch.

python -m seewhy_lab pictures_per_second MODEL PICTURES
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.question import Asks

QUESTIONS = 8


def main() -> None:
    """Time each step over all pictures of a folder, the second time round."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("pictures", type=Path)
    parser.add_argument("--count", type=int, default=2000)
    options = parser.parse_args()
    agent = Agent.load(options.model)
    scenes = Dataset.load(options.pictures, agent.domain)
    began = time.perf_counter()
    pixels = scenes.pictures(agent.domain.pictures.size)
    loaded = len(pixels) / (time.perf_counter() - began)
    pixels = pixels[np.random.default_rng(0).permutation(len(pixels))[: options.count]]
    questions = [
        question for question in agent.questions.one_of_each() if question.asks is not Asks.EXPLAIN
    ]
    rng = np.random.default_rng(1)
    asked = [rng.choice(len(questions), QUESTIONS, replace=False) for _ in pixels]
    assert agent.extractor is not None
    agent.classify_all(pixels[:256])
    began = time.perf_counter()
    probabilities = agent.extractor.probabilities(pixels)
    seen = time.perf_counter()
    found = agent.classify_all(pixels)
    classified = time.perf_counter()
    agent.answer_all(
        [
            (classification, questions[int(n)])
            for classification, numbers in zip(found, asked, strict=True)
            for n in numbers
        ]
    )
    answered = time.perf_counter()
    count = len(pixels)
    print(f"{count} pictures, {QUESTIONS} questions each")
    print(f"files read and scaled: {loaded:.0f} a second")
    print(f"networks alone: {count / (seen - began):.0f} pictures a second")
    print(f"networks and reasoning: {count / (classified - seen):.0f} pictures a second")
    print(f"answers: {QUESTIONS * count / (answered - classified):.0f} a second")
    one = (answered - classified) / QUESTIONS
    print(f"with one question each: {count / (classified - seen + one):.0f} pictures a second")
    print(f"with all: {count / (answered - seen):.0f} pictures a second")
    assert set(probabilities) == set(agent.domain.features)


if __name__ == "__main__":
    main()
