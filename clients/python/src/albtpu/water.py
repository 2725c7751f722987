"""The water of a query of the whole budget, in words: how clear it is, and what receives its light.

    water = albtpu.Water(secchi=5, detector="half", field_of_view=3, pulse_length=1.5, bias="correct")
    budget = service.query_budget(water=water, ...)

The words are those of `[water]` in the survey file of albtpu-query. The service computes the columns of the water from
`Water.message`, which has the same bits as the message of the C++ library for the same numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .arguments import check_name, read_optional, read_vector
from .errors import ArgumentError

KD_KINDS = ("satellite490", "diffuse532", "system", "secchi", "jerlov")
JERLOV_TYPES = ("I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C", "9C")
DETECTORS = ("peak", "half", "centroid")
BIASES = ("none", "correct", "vendor", "calibrated")

# The words of a field, and what stands before them on the wire.
_WORDS = {"kd_kind": (KD_KINDS, "KD_KIND"), "jerlov": (JERLOV_TYPES, "JERLOV_TYPE"),
          "detector": (DETECTORS, "ECHO_DETECTOR"), "bias": (BIASES, "BIAS_HANDLING")}
_NUMBERS = ("kd", "secchi", "absorption", "scattering", "kd_sigma", "omega0", "omega0_sigma", "backscatter_fraction",
            "field_of_view", "pulse_length", "residual_fraction", "photons", "temperature", "salinity",
            "processed_with")


@dataclass(frozen=True, kw_only=True)
class Water:
    """A water. Give exactly one of `kd` with `kd_kind`, `secchi`, `jerlov`, and `absorption` with `scattering`.

    kd:          attenuation in 1/m, of what kd_kind says: "satellite490" the sun's light at 490 nm, "diffuse532" at
                 532 nm, "system" the lidar's own echoes, "secchi" or "jerlov" derived from these.
    secchi:      Secchi depth in m.
    jerlov:      "I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C" or "9C".
    absorption, scattering: 1/m at 532 nm.
    kd_sigma:    1/m, standard deviation of the attenuation; None: what its kind is good for.
    omega0, omega0_sigma: single-scattering albedo and its standard deviation; None: 0.8 and 0.1.
    backscatter_fraction: the fraction of scattered light that turns back; None: between 0.01 and 0.03, the range of
                 the shipped table of the water column, which refuses others, and an omega0 above 0.96.
    detector:    how the receiver reads the time of an echo: "peak", "half" or "centroid".
    field_of_view: m, diameter of what the receiver sees on the surface, across the beam.
    pulse_length: ns, full width at half of the maximum.
    bias:        what the processing did about the bias of scattering: "none" leaves it in the points, "correct" took
                 away the mean, "vendor" left a residual_fraction, "calibrated" took away the mean scaled to a
                 calibration.
    residual_fraction: 0 to 1, with "vendor".
    calibration: m, with "calibrated": depth, offset (positive if the points were too shallow) and standard deviation.
    photons:     counted in an echo; None: their noise is in errors["bottom_range"].
    temperature, salinity: degrees C, 1: both or none. They give the refractive index where a query does not.
    processed_with: the index that ranges were computed with; None: the group index of the water.
    green_surface: a green laser located the surface by its returns.
    without_column: leave out scattering between surface and bottom; detector, field_of_view and pulse_length may then
                 be missing, and bias, residual_fraction, calibration and photons must be.
    """

    kd: float | None = None
    kd_kind: str | None = None
    secchi: float | None = None
    jerlov: str | None = None
    absorption: float | None = None
    scattering: float | None = None
    kd_sigma: float | None = None
    omega0: float | None = None
    omega0_sigma: float | None = None
    backscatter_fraction: float | None = None
    detector: str | None = None
    field_of_view: float | None = None
    pulse_length: float | None = None
    bias: str | None = None
    residual_fraction: float | None = None
    calibration: tuple[float, float, float] | None = None
    photons: float | None = None
    temperature: float | None = None
    salinity: float | None = None
    processed_with: float | None = None
    green_surface: bool = False
    without_column: bool = False

    def __post_init__(self) -> None:
        for name, (words, _) in _WORDS.items():
            if getattr(self, name) is not None:
                check_name(name, getattr(self, name), words)
        self._numbers()
        if self.without_column:
            for name in ("bias", "residual_fraction", "calibration", "photons"):
                if getattr(self, name) is not None:
                    raise ArgumentError(f"{name} has no effect with without_column; leave out one of the two")

    def _numbers(self) -> dict[str, Any]:
        numbers: dict[str, Any] = {name: read_optional(name, getattr(self, name)) for name in _NUMBERS}
        if self.calibration is not None:
            numbers["calibration"] = read_vector("calibration", self.calibration, ("depth", "offset", "sigma"))
        return numbers

    def message(self) -> Any:
        """albtpu.v1.WaterState."""
        from .v1 import water_pb2
        words: dict[str, Any] = {
            name: f"{prefix}_{getattr(self, name).upper()}" for name, (_, prefix) in _WORDS.items()
            if getattr(self, name) is not None}
        return water_pb2.WaterState(**self._numbers(), **words, green_surface=bool(self.green_surface),
                                    without_column=bool(self.without_column))
