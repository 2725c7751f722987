"""The waves of a sea: by height and period, or a spectrum over frequency, of a buoy or of xarray."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .arguments import read_column, read_optional
from .errors import ArgumentError
from .schema import Doubles

if TYPE_CHECKING:
    import xarray

_FEWEST_DIRECTIONS = 8
_MOST_HARMONICS = 6


@dataclass(frozen=True)
class Waves:
    """Waves given by height, period and direction: JONSWAP, or TMA in water of finite depth."""

    significant_wave_height: float  # m
    peak_period: float  # s
    travels_towards: float  # rad, of the compass
    gamma: float = 3.3
    spread: float | None = None  # rad, circular standard deviation; None: grows away from the peak (Mitsuyasu)


@dataclass(frozen=True)
class Spectrum:
    """A spectrum over frequency. All sequences but those of harmonics have one number for each frequency."""

    frequencies: tuple[float, ...]  # Hz, increasing
    densities: tuple[float, ...]  # m2/Hz
    # For harmonics 2, 4 and so on: the integrals of cos(2 n c) and sin(2 n c) times the density over directions c.
    cosines: tuple[tuple[float, ...], ...] = ()
    sines: tuple[tuple[float, ...], ...] = ()
    trusted_up_to: float | None = None  # Hz; None: the last frequency
    record_length: float | None = None  # s, of a measurement; None: of a model


def radians(degrees: float) -> float:
    return degrees * math.pi / 180  # In this order, for the same bits as in C++.


def buoy_spectrum(frequencies: ArrayLike, energy: ArrayLike, r2: ArrayLike | None, alpha2: ArrayLike | None,
                  trusted_up_to: float | None, record_length: float | None) -> Spectrum:
    """The arguments of `Sea.spectrum`. Raises ArgumentError."""
    f, e = _column("frequencies", frequencies), _column("energy", energy)
    waves = Spectrum(tuple(f), tuple(e), trusted_up_to=read_optional("trusted_up_to", trusted_up_to),
                     record_length=read_optional("record_length", record_length))
    if (r2 is None) != (alpha2 is None):
        raise ArgumentError("r2 and alpha2 belong together: give both, or neither")
    if r2 is None or alpha2 is None:
        return waves
    return _with_second_harmonic(waves, _column("r2", r2), _column("alpha2", alpha2))


def _column(name: str, values: ArrayLike) -> list[float]:
    array = read_column(name, values)
    if array.ndim != 1 or array.size == 0:
        raise ArgumentError(f"{name} has the shape {array.shape}: it should be a sequence of numbers")
    return [float(value) for value in array]


def _with_second_harmonic(waves: Spectrum, r2: Sequence[float], alpha2: Sequence[float]) -> Spectrum:
    """By `math`, which has the bits of C++."""
    if not len(waves.densities) == len(r2) == len(alpha2):
        raise ArgumentError(f"energy, r2 and alpha2 have {len(waves.densities)}, {len(r2)} and {len(alpha2)} numbers: "
                            "they should have as many as there are frequencies")
    cosines, sines = [], []
    for density, r, alpha in zip(waves.densities, r2, alpha2):
        if math.isnan(r) or math.isnan(alpha):
            r = alpha = 0.0
        if not 0 <= r <= 1:
            raise ArgumentError(f"r2 has {r:g}: it should be 0 to 1")
        angle = 2 * radians(alpha)
        cosines.append(density * r * math.cos(angle))
        sines.append(density * r * math.sin(angle))
    return replace(waves, cosines=(tuple(cosines),), sines=(tuple(sines),))


def dataset_spectrum(dataset: xarray.Dataset) -> tuple[Spectrum, dict[str, float]]:
    """The spectrum of a dataset by the conventions of wavespectra, and the wind and depth that it has. Raises
    ArgumentError.
    """
    if "efth" not in dataset:
        raise ArgumentError("the dataset has no variable efth (the spectrum, m2/Hz/degree): rename the variable")
    efth = dataset["efth"].squeeze(drop=True)
    if sorted(map(str, efth.dims)) != ["dir", "freq"]:
        raise ArgumentError(f"efth has the dimensions {', '.join(map(str, efth.dims))}: select one time and one place, "
                            "leaving freq and dir")
    efth = efth.transpose("freq", "dir").sortby("freq")
    density = np.asarray(efth, np.float64) * (180 / math.pi)  # m2/Hz/rad
    if not np.isfinite(density).all():
        raise ArgumentError("efth has values that are not finite: fill them, with 0 if there is no energy")
    weights = _direction_weights(np.radians(np.asarray(efth["dir"], np.float64)))
    bins = density @ weights.T  # energy, then cosine and sine of each harmonic
    frequencies = [float(f) for f in efth["freq"].values]
    columns = [tuple(float(number) for number in column) for column in bins.T]
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
    before, widest = np.roll(behind, 1), 2 * np.sort(behind)[count // 2]  # A wider gap is the end of a sector.
    widths = np.empty(count)
    widths[order] = 0.5 * (np.where(before > widest, behind, before) + np.where(behind > widest, before, behind))
    return widths


def _single(dataset: Any, name: str) -> float:
    values = np.asarray(dataset[name], np.float64).reshape(-1)
    if values.size != 1:
        raise ArgumentError(f"{name} has {values.size} values: select one time and one place first")
    return float(values[0])
