"""Directional spectra in xarray, by the conventions of wavespectra."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError
from .sea import Spectrum

if TYPE_CHECKING:
    import xarray

_FEWEST_DIRECTIONS = 8
_MOST_HARMONICS = 6
Doubles = NDArray[np.float64]


def read_dataset(dataset: xarray.Dataset) -> tuple[Spectrum, dict[str, float]]:
    """The spectrum, and the wind and depth that the dataset has. Raises ArgumentError."""
    if "efth" not in dataset:
        raise ArgumentError("the dataset has no variable efth (the spectrum, m2/Hz/degree): rename it so")
    efth = dataset["efth"].squeeze(drop=True)
    if sorted(map(str, efth.dims)) != ["dir", "freq"]:
        raise ArgumentError(f"efth has the dimensions {', '.join(map(str, efth.dims))}: select one time and one place, "
                            "so that freq and dir are left")
    efth = efth.transpose("freq", "dir").sortby("freq")
    density = np.asarray(efth, np.float64) * (180 / math.pi)  # m2/Hz/rad
    if not np.isfinite(density).all():
        raise ArgumentError("efth has values that are not finite: fill them, with 0 if there is no energy")
    weights = _direction_weights(np.radians(np.asarray(efth["dir"], np.float64)))
    bins = density @ weights.T  # energy, then cosine and sine of each harmonic
    frequencies = [float(f) for f in efth["freq"].values]
    columns = [tuple(column) for column in bins.T.tolist()]
    return (Spectrum(tuple(frequencies), columns[0], cosines=tuple(columns[1::2]), sines=tuple(columns[2::2])),
            {name: _single(dataset, name) for name in ("wspd", "wdir", "dpt") if name in dataset})


def _direction_weights(directions: Doubles) -> Doubles:
    """What a density of 1 in each direction contributes to the energy, then to cosine and sine of each harmonic."""
    if directions.size < _FEWEST_DIRECTIONS:
        raise ArgumentError(f"efth has {directions.size} directions: it should have {_FEWEST_DIRECTIONS} or more")
    widths = _widths(directions)
    weights = [widths]
    for n in range(1, 1 + min(_MOST_HARMONICS, (directions.size + 3) // 4 - 1)):
        weights += [widths * np.cos(2 * n * directions), widths * np.sin(2 * n * directions)]
    return np.array(weights)


def _widths(directions: Doubles) -> Doubles:
    """As DirectionalBins of sea/files: equal where gaps differ little, else half way to the neighbours."""
    turn, count = 2 * math.pi, directions.size
    order = np.argsort(directions % turn)
    turned = (directions % turn)[order]
    behind = np.diff(turned, append=turned[0] + turn)
    equal = turn / count
    if (np.abs(behind - equal) < 0.1 * equal).all():
        return np.full(count, equal)
    before, widest = np.roll(behind, 1), 2 * np.sort(behind)[count // 2]  # At a wider gap a sector ends.
    widths = np.empty(count)
    widths[order] = 0.5 * (np.where(before > widest, behind, before) + np.where(behind > widest, before, behind))
    return widths


def _single(dataset: Any, name: str) -> float:
    values = np.asarray(dataset[name], np.float64).reshape(-1)
    if values.size != 1:
        raise ArgumentError(f"{name} has {values.size} values: select one time and one place first")
    return float(values[0])
