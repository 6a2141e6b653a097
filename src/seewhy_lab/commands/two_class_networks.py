"""Would the network from end to end gain as much from a second one as SeeWhy from its features?

SeeWhy reads features together with the class that a network sees: five networks have a say in the
class of a structure, where end to end one has. Here a second network of the class is trained on the
same pictures, from another seed, and the two vote (their probabilities are multiplied). The trials
are those of a run of `seewhy experiment vqa`, whose networks are used where they are.

    python -m seewhy_lab two_class_networks RESULTS --trials 10 --sizes 100 200 400 800
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import torch

from seewhy.perception.domain_options import class_options
from seewhy_lab.experiments.experiment import Trial
from seewhy_lab.experiments.rows import read_trial
from seewhy_lab.experiments.running import prepare, setting_of
from seewhy_lab.experiments.seeing import class_network, see

OTHER_SEED = 1000


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, help="the --out of the run")
    parser.add_argument("--domain", default="structure_stability")
    parser.add_argument("--data", type=Path)
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 200, 400, 800])
    options = parser.parse_args()
    torch.set_num_threads(1)
    run = prepare("vqa", options.domain, options.results, data=options.data)
    setting = setting_of(run)
    names = list(setting.domain.classes)
    print("size  SeeWhy  one network  the second  both vote")
    for size in options.sizes:
        rows = []
        for seed in range(options.trials):
            trial = Trial(seed, size)
            seen = see(setting, trial)
            test = seen.test.scenes
            network_options = class_options(setting.domain, seed=seed + OTHER_SEED)
            second = class_network(seen.train.scenes, network_options)
            shown = second.probabilities(test.pictures(setting.domain.pictures.size))["class"]
            first = seen.test.classes
            true = np.array([names.index(label) for label in test.classes])
            found = {
                str(row["system"]): float(row["accuracy"])
                for row in read_trial(run.folder, trial) or ()
            }
            rows.append(
                [
                    found.get("seewhy", np.nan),
                    *(
                        np.mean(probabilities.argmax(axis=1) == true)
                        for probabilities in (first, shown, first * shown)
                    ),
                ]
            )
        print(size, *np.round(100 * np.mean(rows, axis=0), 1), flush=True)


if __name__ == "__main__":
    main()
