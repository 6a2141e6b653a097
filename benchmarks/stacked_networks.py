"""Train the networks of several features one after the other, and stacked into one.

Stacked by `torch.func`: their weights in one tensor each, the networks mapped over by `vmap`, which
makes grouped convolutions of theirs. A step is forward, loss, backward and AdamW on a batch of
noise, on one thread. Both ways are timed turn by turn on the same machine; a ratio above 1 says
that stacked is faster.

    python benchmarks/stacked_networks.py
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import torch
import torch.nn.functional as functional
from torch.func import functional_call, stack_module_state

from seewhy.perception.network import GrowingNetwork, deepest
from seewhy.perception.optimisation import new_optimizer
from seewhy.perception.options import TrainingOptions

Step = Callable[[], None]


def main() -> None:
    """Print the milliseconds of a step for every depth, both ways, and the median ratio."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=56, help="side of the pictures in pixels")
    parser.add_argument("--networks", type=int, default=5)
    parser.add_argument("--values", type=int, default=4, help="values of each feature")
    parser.add_argument("--batch", type=int, default=32)
    parser.add_argument("--turns", type=int, default=15)
    options = parser.parse_args()
    torch.set_num_threads(1)
    shape = (options.batch, options.size, options.size, 3)
    pictures = torch.randint(0, 256, shape, dtype=torch.uint8).float()
    targets = torch.randint(0, options.values, (options.networks, options.batch))
    print(f"{options.networks} networks, {options.batch} pictures of {options.size} pixels")
    for depth in range(1, deepest(options.size) + 1):
        networks = [
            GrowingNetwork(size=options.size, values=options.values, depth=depth).train()
            for _ in range(options.networks)
        ]
        one_by_one = separate(networks, pictures, targets)
        together = stacked(networks, pictures, targets)
        times = turn_by_turn(one_by_one, together, turns=options.turns)
        ratio = statistics.median(first / second for first, second in times)
        first, second = (1000 * statistics.median(seconds) for seconds in zip(*times, strict=True))
        print(
            f"{depth} convolutions: one by one {first:.0f} ms, stacked {second:.0f} ms, "
            f"ratio {ratio:.2f}"
        )


def separate(networks: list[GrowingNetwork], pictures: torch.Tensor, targets: torch.Tensor) -> Step:
    """A step of each network by itself."""
    optimizers = [new_optimizer(network, TrainingOptions()) for network in networks]

    def step() -> None:
        for network, optimizer, right in zip(networks, optimizers, targets, strict=True):
            optimizer.zero_grad(set_to_none=True)
            functional.cross_entropy(network(pictures), right).backward()
            optimizer.step()

    return step


def stacked(networks: list[GrowingNetwork], pictures: torch.Tensor, targets: torch.Tensor) -> Step:
    """A step of all networks at once."""
    parameters, buffers = stack_module_state(networks)
    optimizer = torch.optim.AdamW(list(parameters.values()))
    shell = networks[0]

    def loss_of(
        weights: dict[str, torch.Tensor], state: dict[str, torch.Tensor], right: torch.Tensor
    ) -> torch.Tensor:
        return functional.cross_entropy(
            functional_call(shell, (weights, state), (pictures,)), right
        )

    every = torch.vmap(loss_of, randomness="different")

    def step() -> None:
        optimizer.zero_grad(set_to_none=True)
        every(parameters, buffers, targets).sum().backward()
        optimizer.step()

    return step


def turn_by_turn(first: Step, second: Step, *, turns: int) -> list[tuple[float, float]]:
    """Seconds of both steps, a pair a turn; one turn before warms up."""

    def seconds(step: Step) -> float:
        began = time.perf_counter()
        step()
        return time.perf_counter() - began

    return [(seconds(first), seconds(second)) for _ in range(turns + 1)][1:]


if __name__ == "__main__":
    main()
