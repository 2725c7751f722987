"""A sea for queries in place of a table: measured waves, waves of a model, or heights and periods.

    sea = albtpu.Sea.ndbc("41010.data_spec", time="2020-06-08T03:50Z").with_wind(6, from_=230)
    answer = service.query(sea=sea, incidence=theta, footprint=0.5, depth=d)

The service computes the table of the sea from the numbers of `Sea.message`, the same bits as the C++ library and
albtpu-query have of the same file. Angles are in degrees here and in radians in the message.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike

from .errors import ArgumentError
from .names import check_name

if TYPE_CHECKING:
    import pathlib

    import xarray

    from .service import Service
    from .table_file import TableFile

TAILS = ("wind", "relax", "level", "none")


@dataclass(frozen=True)
class Waves:
    """Waves by a height, a period and a direction: JONSWAP, in water of finite depth TMA."""

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


@dataclass(frozen=True)
class Sea:
    """What is known of a sea. Make one by a method, add what else is known by `with_wind`, `with_depth`, `with_tail`.

    waves:       `Waves` in a tuple, a `Spectrum`, or nothing: the sea of the wind alone.
    wind_speed:  m/s at 10 m; None: taken from the waves; 0: a calm.
    wind_from:   rad, of the compass; None: along the shortest waves.
    water_depth: m; None: deep.
    tail:        how far the level of the waves counts among the shorter ones, which the wind makes: "relax" (less with
                 every octave), "wind" (not at all), "level" (throughout), "none" (there are no shorter ones).
    tail_from:   Hz, from where these are joined; None: up to where the waves are trusted.
    """

    waves: Union[tuple[Waves, ...], Spectrum] = ()
    wind_speed: float | None = None
    wind_from: float | None = None
    water_depth: float | None = None
    tail: str = "relax"
    tail_from: float | None = None

    @classmethod
    def calm(cls) -> Sea:
        """No wind and no waves: flat water."""
        return cls(wind_speed=0.0)

    @classmethod
    def jonswap(cls, *, hs: float, tp: float, waves_from: float, gamma: float = 3.3,
                spread: float | None = None) -> Sea:
        """Waves by their significant height in m, peak period in s and the direction from which they come in degrees.

        gamma is the height of the peak, 3.3 for a wind sea and 5 to 10 for swell. spread is the circular standard
        deviation of the directions in degrees; without it, it grows away from the peak. Seas add up:

        >>> wind_sea = Sea.jonswap(hs=0.4, tp=2.7, waves_from=225)
        >>> sea = (wind_sea + Sea.jonswap(hs=1.1, tp=9.5, waves_from=295, gamma=7, spread=18)).with_wind(6, from_=225)
        >>> len(sea.waves)
        2
        """
        towards = _radians(_number("waves_from", waves_from)) + math.pi
        return cls(waves=(Waves(_number("hs", hs), _number("tp", tp), towards, _number("gamma", gamma),
                                None if spread is None else _radians(_number("spread", spread))),))

    @classmethod
    def spectrum(cls, frequencies: ArrayLike, energy: ArrayLike, *, r2: ArrayLike | None = None,
                 alpha2: ArrayLike | None = None, trusted_up_to: float | None = None,
                 record_length: float | None = None) -> Sea:
        """A spectrum of a buoy: energy in m2/Hz at frequencies in Hz, r2 and alpha2 in degrees from.

        Where r2 or alpha2 is NaN, and without them, waves are isotropic. trusted_up_to is in Hz. record_length is the
        time of the measurement in s, from which its sampling error follows.
        """
        f, e = _column("frequencies", frequencies), _column("energy", energy)
        waves = Spectrum(tuple(f), tuple(e), trusted_up_to=_maybe("trusted_up_to", trusted_up_to),
                         record_length=_maybe("record_length", record_length))
        if (r2 is None) != (alpha2 is None):
            raise ArgumentError("r2 and alpha2 belong together: give both, or neither")
        if r2 is not None and alpha2 is not None:
            waves = replace(waves, **_second_harmonic(e, _column("r2", r2), _column("alpha2", alpha2)))
        return cls(waves=waves)

    @classmethod
    def ndbc(cls, path: str | os.PathLike[str], time: object = None) -> Sea:
        """The spectrum of an NDBC buoy at a time: `.data_spec` with `.swr2` and `.swdir2` beside it, or of the history
        the file with `w` before the year, with those with `k` and `i` beside it; gzip or not.

        time is the UTC of a record, such as "2020-06-08T03:50Z" or a numpy.datetime64; without it, the last one. Raises
        ArgumentError for files that cannot be read and times that they do not have.
        """
        from .ndbc import read_spectrum
        return cls(waves=read_spectrum(path, time))

    @classmethod
    def from_xarray(cls, dataset: xarray.Dataset) -> Sea:
        """A directional spectrum as wavespectra has it: `efth` in m2/Hz/degree over `freq` in Hz and `dir`, the
        directions from which waves come, in degrees. Select one time and one place first.

        `wspd` in m/s, `wdir` in degrees from and `dpt` in m, where the dataset has them, are wind and depth.
        """
        from .directional import read_dataset
        waves, others = read_dataset(dataset)
        sea = cls(waves=waves, water_depth=others.get("dpt"))
        return sea if "wspd" not in others else sea.with_wind(others["wspd"], from_=others.get("wdir"))

    def with_wind(self, speed: float, *, from_: float | None = None) -> Sea:
        """The same sea with a wind: m/s at 10 m, and the direction from which it blows in degrees."""
        return replace(self, wind_speed=_number("speed", speed),
                       wind_from=None if from_ is None else _radians(_number("from_", from_)))

    def with_depth(self, depth: float) -> Sea:
        """The same sea in water of this depth in m."""
        return replace(self, water_depth=_number("depth", depth))

    def with_tail(self, tail: str, *, tail_from: float | None = None) -> Sea:
        """The same sea with other short waves; tail_from in Hz."""
        check_name("tail", tail, TAILS)
        return replace(self, tail=tail, tail_from=_maybe("tail_from", tail_from))

    def __add__(self, other: Sea) -> Sea:
        """The waves of both, which both must have by heights and periods; the rest is that of the first."""
        if not (isinstance(other, Sea) and isinstance(self.waves, tuple) and isinstance(other.waves, tuple)):
            raise ArgumentError("only seas by heights and periods add up (a spectrum has all waves already): add "
                                "the spectra first")
        return replace(self, waves=self.waves + other.waves)

    def compile(self, service: Service) -> TableFile:
        """The table of the sea, to be queried without the service and saved: see `TableFile.save`.

        The service computes it, as it does for queries, so both have the same numbers, and this package needs no
        physics of its own.
        """
        return service.compile(self)

    def message(self) -> Any:
        """albtpu.v1.SeaState."""
        from .v1 import sea_pb2
        state = sea_pb2.SeaState(
            wind_speed=self.wind_speed, wind_from=self.wind_from, water_depth=self.water_depth,
            tail_rule=f"TAIL_RULE_{self.tail.upper()}", tail_from=self.tail_from)
        if isinstance(self.waves, Spectrum):
            spectrum = self.waves
            state.frequency_spectrum.CopyFrom(sea_pb2.FrequencySpectrum(
                frequencies=spectrum.frequencies, densities=spectrum.densities,
                cosines=_flat(spectrum.cosines), sines=_flat(spectrum.sines),
                trusted_up_to=spectrum.trusted_up_to or spectrum.frequencies[-1],
                record_length=spectrum.record_length))
        elif self.waves:
            state.components.components.extend(
                sea_pb2.WaveComponent(significant_wave_height=waves.significant_wave_height,
                                      peak_period=waves.peak_period, gamma=waves.gamma,
                                      travels_towards=waves.travels_towards, spread=waves.spread)
                for waves in self.waves)
        return state


def _radians(degrees: float) -> float:
    return degrees * math.pi / 180  # In this order, for the same bits as in C++.


def _number(name: str, value: object) -> float:
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {value!r}: it should be a number") from None


def _maybe(name: str, value: object) -> float | None:
    return None if value is None else _number(name, value)


def _column(name: str, values: ArrayLike) -> list[float]:
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {values!r}: it should be numbers") from None
    if array.ndim != 1:
        raise ArgumentError(f"{name} has the shape {array.shape}: it should be a sequence of numbers")
    return [float(value) for value in array]


def _second_harmonic(energy: Sequence[float], r2: Sequence[float], alpha2: Sequence[float]) -> dict[str, Any]:
    """The fields of `Spectrum` for waves of a buoy; by `math`, which has the bits of C++."""
    if not len(energy) == len(r2) == len(alpha2):
        raise ArgumentError(f"energy, r2 and alpha2 have {len(energy)}, {len(r2)} and {len(alpha2)} numbers: they "
                            "should have as many as there are frequencies")
    cosines, sines = [], []
    for density, r, alpha in zip(energy, r2, alpha2):
        if math.isnan(r) or math.isnan(alpha):
            r = alpha = 0.0
        angle = 2 * _radians(alpha)
        cosines.append(density * r * math.cos(angle))
        sines.append(density * r * math.sin(angle))
    return dict(cosines=(tuple(cosines),), sines=(tuple(sines),))


def _flat(harmonics: Sequence[Sequence[float]]) -> list[float]:
    return [number for harmonic in harmonics for number in harmonic]
