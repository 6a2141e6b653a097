"""Remove axioms of the structures' knowledge and learn them again from annotated scenes.

For each of the seventy ways to remove four of the eight axioms, scenes are drawn (every feature
vector as likely as every other), annotated by the full knowledge, or by the toss of a coin where it
leaves them open, and learned from with the four axioms that are left.

    python -m seewhy_lab axioms_recovered
    python -m seewhy_lab axioms_recovered --sizes 100 1000 --noise 0.05
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from itertools import combinations, product

import numpy as np

from seewhy.agent.learning_from_pictures import AnnotatedScenes, learn_for_domain, with_candidates
from seewhy.domain.domain import Domain, load_domain
from seewhy.induction.axiom_learning import LearningOptions
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

DOMAIN = "structure_stability"
SIZES = (100, 200, 500, 1000, 2000)
REMOVED = 4
ENOUGH = 10  # scenes in which a removed axiom must be needed for the data to support it


def concluded(domain: Domain, axiom: Axiom, space: list[FeatureVector]) -> dict[FeatureVector, str]:
    """The feature vectors that an axiom alone decides, with their class."""
    alone = Reasoner(replace(domain.knowledge, axioms=(axiom,)), domain.schema)
    decisions = zip(space, alone.decide_all(space), strict=True)
    return {vector: decision.label for vector, decision in decisions if decision.label is not None}


def main() -> None:
    """Print how much of what was removed is found again, for every number of scenes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="*", default=list(SIZES))
    parser.add_argument("--noise", type=float, default=0.0, help="the share of wrong labels")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    domain = load_domain(DOMAIN)
    given = domain.knowledge.axioms
    space: list[FeatureVector] = list(
        product(*(feature.values for feature in domain.features.values()))
    )
    full = Reasoner(domain.knowledge, domain.schema)
    truth = {vector: full.decide(vector).label for vector in space}
    spoken = [concluded(domain, axiom, space) for axiom in given]
    print("| scenes | agrees | least | without learning | axioms recovered | literals | seconds |")
    print("|---|---|---|---|---|---|---|")
    for size in options.sizes:
        rng = np.random.default_rng([options.seed, size])
        agrees, before, recovered, literals = [], [], [], []
        spent = 0.0
        for gone in combinations(range(len(given)), REMOVED):
            vectors = [space[n] for n in rng.integers(len(space), size=size)]
            classes = list(domain.classes)
            labels = [truth[vector] or classes[rng.integers(2)] for vector in vectors]
            wrong = rng.random(size) < options.noise
            labels = [
                classes[1 - classes.index(label)] if flip else label
                for label, flip in zip(labels, wrong, strict=True)
            ]
            kept = tuple(axiom for n, axiom in enumerate(given) if n not in gone)
            less = replace(domain, knowledge=replace(domain.knowledge, axioms=kept))
            began = time.perf_counter()
            learned = learn_for_domain(
                less,
                AnnotatedScenes(tuple(vectors), tuple(labels), ("",) * size),
                options=LearningOptions(tolerance=options.noise),
            )
            spent += time.perf_counter() - began
            candidates = [judgement.candidate for judgement in learned.accepted]
            more = Reasoner(
                with_candidates(less.knowledge, candidates, domain.schema), domain.schema
            )
            settled = [vector for vector in dict.fromkeys(vectors) if truth[vector] is not None]
            now = {
                vector: decision.label
                for vector, decision in zip(space, more.decide_all(space), strict=True)
            }
            without = Reasoner(less.knowledge, domain.schema).decide_all(space)
            old = dict(zip(space, without, strict=True))
            agrees.append(np.mean([now[vector] == truth[vector] for vector in settled]))
            before.append(np.mean([old[vector].label == truth[vector] for vector in settled]))
            literals += [candidate.literals for candidate in candidates]
            for number in gone:
                lost = [
                    vector
                    for vector in spoken[number]
                    if truth[vector] is not None and old[vector].label is None
                ]
                if sum(vector in lost for vector in vectors) >= ENOUGH:
                    decided = [vector for vector in lost if vector in set(vectors)]
                    recovered.append(all(now[vector] == truth[vector] for vector in decided))
        print(
            f"| {size} | {100 * np.mean(agrees):.2f} % | {100 * min(agrees):.1f} % "
            f"| {100 * np.mean(before):.1f} % | {100 * np.mean(recovered):.1f} % of "
            f"{len(recovered)} | {np.mean(literals):.2f} | {spent / len(agrees):.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
