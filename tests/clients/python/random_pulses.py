"""Pulses with every outcome: inside a table, on its nodes and edges, outside of it, and invalid."""

import numpy as np

from albtpu import AXES

BAD = (np.nan, np.inf, -np.inf, -1.0, 0.0, -0.0, 1e38, 1e300)


def pulses_of_all_kinds(table, count, seed=1):
    """Six columns of float64, between nodes or on them; up to a third of the pulses have bad numbers."""
    random = np.random.default_rng(seed)
    columns = {}
    for name in AXES:
        nodes = table.axes[name].nodes.astype(float)
        between = random.uniform(nodes[0], nodes[-1], count)
        on = nodes[random.integers(nodes.size, size=count)]
        column = np.where(random.integers(2, size=count) == 0, between, on)
        just_off = np.nextafter(np.float32([nodes[0], nodes[-1]]), np.float32([-1, np.inf]))
        strange = random.choice(np.append(BAD, just_off), count)
        bad = (np.arange(count) % 3 == 0) & (random.integers(6, size=count) == 0)
        columns[name] = np.where(bad, strange, column)
    columns["azimuth"] += 180.0 * random.integers(-3, 4, count)
    columns["azimuth"] *= random.choice([-1.0, 1.0], count)
    return columns
