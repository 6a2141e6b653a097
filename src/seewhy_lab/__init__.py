"""The laboratory: the paper's evaluation, simulators of the bundled domains, BelgiumTS."""
