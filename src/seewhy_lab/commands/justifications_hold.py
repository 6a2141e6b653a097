"""Do justifications hold for any program? Random programs are checked against brute force.

    python -m seewhy_lab justifications_hold --programs 10000

Each program has up to eight axioms over three features: both negations, `not not`, comparisons,
aggregates, conditional literals, defaults and loops. `seewhy_lab.experiments.justifications` says
what is checked. Programs at fault are printed with the seed that makes them; the exit code is then
1.
"""

from __future__ import annotations

import argparse
import random
import sys
import time

from seewhy_lab.experiments.justifications import check
from seewhy_lab.experiments.random_knowledge import random_knowledge


def main() -> int:
    """Check programs and print how much was checked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0, help="of the first program")
    parser.add_argument("--scenes", type=int, default=3, help="asked about, of each program")
    options = parser.parse_args()
    beliefs = refusals = changes = faulty = 0
    begun = time.perf_counter()
    for number in range(options.programs):
        seed = options.seed + number
        tally = check(seed, scenes=options.scenes)
        beliefs += tally.beliefs
        refusals += tally.refusals
        changes += tally.changes
        if tally.faults:
            faulty += 1
            print(f"seed {seed}")
            print("\n".join(map(str, random_knowledge(random.Random(seed)).axioms)))
            print("\n".join(tally.faults), flush=True)
        if (number + 1) % 500 == 0:
            taken = time.perf_counter() - begun
            print(f"{number + 1} programs, {taken:.0f} s", file=sys.stderr, flush=True)
    print(
        f"{options.programs} programs: {beliefs} beliefs, {refusals} absent beliefs and {changes} "
        f"smallest changes checked; {faulty} programs at fault"
    )
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
