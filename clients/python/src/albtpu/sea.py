"""The sea of a query, in place of a table: measured waves, waves of a model, or heights and periods.

    sea = albtpu.Sea.ndbc("41010.data_spec", time="2020-06-08T03:50Z").with_wind(6, from_=230)
    answer = service.query(sea=sea, incidence=theta, footprint=0.5, depth=d)

The service computes the table of the sea from `Sea.message`, which has the same bits as the message of the C++
library and of albtpu-query for the same file. Angles are in degrees here and in radians in the message.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import check_name, read_number, read_optional
from .errors import ArgumentError
from .ndbc import read_spectrum
from .spectrum import Spectrum, Waves, buoy_spectrum, dataset_spectrum, radians

if TYPE_CHECKING:
    import xarray

TAILS = ("wind", "relax", "level", "none")

Compiled = TypeVar("Compiled", covariant=True)


@dataclass(frozen=True)
class Correlation:
    """What pulses share of a sea: covariances over the variances of one pulse, one array of each, in the order asked.

    slope_x, slope_y: of the slopes along the axis of the sea and across it, averaged over the footprint.
    horizontal, vertical: of the errors of the reported points that the sea makes.
    height:           of the height of the water in the footprint.
    """

    slope_x: NDArray[np.float64]
    slope_y: NDArray[np.float64]
    horizontal: NDArray[np.float64]
    vertical: NDArray[np.float64]
    height: NDArray[np.float64]


class SeaCorrelator(Protocol):
    """What computes the correlation of pulses over a sea: an albtpu.Service."""

    @property
    def correlation(self) -> Callable[..., Correlation]: ...


class SeaCompiler(Protocol[Compiled]):
    """What makes the table of a sea: an albtpu.Service, which makes an albtpu.TableFile."""

    def compile(self, sea: Sea) -> Compiled: ...


@dataclass(frozen=True)
class Sea:
    """A sea state. Make one with a class method; `with_wind`, `with_depth` and `with_tail` add what else is known.

    waves:       `Waves` in a tuple, a `Spectrum`, or nothing: the sea of the wind alone.
    wind_speed:  m/s at 10 m; None: taken from the waves; 0: a calm.
    wind_from:   rad, of the compass; None: along the shortest waves.
    water_depth: m; None: deep.
    tail:        how much the level of the given waves influences the shorter ones, which the wind makes: "relax" (less
                 with every octave), "wind" (not at all), "level" (fully), "none" (there are no shorter waves).
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
        towards = radians(read_number("waves_from", waves_from)) + math.pi
        return cls(waves=(Waves(read_number("hs", hs), read_number("tp", tp), towards, read_number("gamma", gamma),
                                None if spread is None else radians(read_number("spread", spread))),))

    @classmethod
    def spectrum(cls, frequencies: ArrayLike, energy: ArrayLike, *, r2: ArrayLike | None = None,
                 alpha2: ArrayLike | None = None, trusted_up_to: float | None = None,
                 record_length: float | None = None) -> Sea:
        """A spectrum of a buoy: energy in m2/Hz at frequencies in Hz, r2 and alpha2 in degrees from.

        Where r2 or alpha2 is NaN, and without them, waves are isotropic. trusted_up_to is in Hz. record_length is the
        time of the measurement in s, from which its sampling error follows.
        """
        return cls(waves=buoy_spectrum(frequencies, energy, r2, alpha2, trusted_up_to, record_length))

    @classmethod
    def ndbc(cls, path: str | os.PathLike[str], time: object = None) -> Sea:
        """The spectrum of an NDBC buoy at a time: `.data_spec` with `.swr2` and `.swdir2` beside it, or of the history
        the file with `w` before the year, with those with `k` and `i` beside it; gzip or not.

        time is the UTC of a record, such as "2020-06-08T03:50Z" or a numpy.datetime64; without it, the last one. Raises
        ArgumentError for files that cannot be read and times that they do not have.
        """
        return cls(waves=read_spectrum(path, time))

    @classmethod
    def from_xarray(cls, dataset: xarray.Dataset) -> Sea:
        """A directional spectrum by the conventions of wavespectra: `efth` in m2/Hz/degree over `freq` in Hz and `dir`,
        the directions from which waves come, in degrees. Select one time and one place first.

        `wspd` in m/s, `wdir` in degrees from and `dpt` in m, where the dataset has them, are wind and depth.
        """
        waves, others = dataset_spectrum(dataset)
        sea = cls(waves=waves, water_depth=others.get("dpt"))
        return sea if "wspd" not in others else sea.with_wind(others["wspd"], from_=others.get("wdir"))

    def with_wind(self, speed: float, *, from_: float | None = None) -> Sea:
        """The same sea with a wind: m/s at 10 m, and the direction from which it blows in degrees."""
        return replace(self, wind_speed=read_number("speed", speed),
                       wind_from=None if from_ is None else radians(read_number("from_", from_)))

    def with_depth(self, depth: float) -> Sea:
        """The same sea in water of this depth in m."""
        return replace(self, water_depth=read_number("depth", depth))

    def with_tail(self, tail: str, *, tail_from: float | None = None) -> Sea:
        """The same sea with another rule for the short waves; tail_from in Hz."""
        check_name("tail", tail, TAILS)
        return replace(self, tail=tail, tail_from=read_optional("tail_from", tail_from))

    def __add__(self, other: Sea) -> Sea:
        """The waves of both, both given by heights and periods; everything else is that of the first."""
        if not (isinstance(other, Sea) and isinstance(self.waves, tuple) and isinstance(other.waves, tuple)):
            raise ArgumentError("only seas given by heights and periods can be added (a spectrum has all waves "
                                "already): add the spectra first")
        return replace(self, waves=self.waves + other.waves)

    def compile(self, service: SeaCompiler[Compiled]) -> Compiled:
        """The table of the sea as an albtpu.TableFile, to be queried without the service and saved.

        The service computes it, as it does for queries, so both have the same numbers, and this package needs no
        physics of its own.
        """
        return service.compile(self)

    def correlation(self, service: SeaCorrelator, dx: ArrayLike | None = None, dt: ArrayLike = 0.0, *,
                    footprint: float, incidence: float = 0.0, **question: Any) -> Correlation:
        """How the errors that this sea makes correlate between two pulses, or R of the mean over cells.

        dx: m, from the first footprint to the second on the water: (x, y), or an array of such pairs. x is the axis of
            the sea (the attribute `x_azimuth` of its table), y 90 degrees counter-clockwise from it.
        dt: s, how much later the second pulse is; one for all or one for each.

        Everything else is that of `Service.correlation`, which computes it:

        >>> sea.correlation(service, [(1, 0), (0, 1)], footprint=0.6, incidence=20).vertical    # doctest: +SKIP
        >>> share = sea.correlation(service, cell=[1, 2, 5], footprint=0.6).horizontal          # doctest: +SKIP
        >>> variance_of_mean = variance * (share + (1 - share) / pulses)                        # doctest: +SKIP
        """
        return service.correlation(self, dx=dx, dt=dt, footprint=footprint, incidence=incidence, **question)

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
                cosines=sum(spectrum.cosines, ()), sines=sum(spectrum.sines, ()),
                trusted_up_to=spectrum.frequencies[-1] if spectrum.trusted_up_to is None else spectrum.trusted_up_to,
                record_length=spectrum.record_length))
        elif self.waves:
            state.components.components.extend(
                sea_pb2.WaveComponent(significant_wave_height=waves.significant_wave_height,
                                      peak_period=waves.peak_period, gamma=waves.gamma,
                                      travels_towards=waves.travels_towards, spread=waves.spread)
                for waves in self.waves)
        return state
