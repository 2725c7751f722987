from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor
TAIL_RULE_LEVEL: TailRule
TAIL_RULE_NONE: TailRule
TAIL_RULE_RELAX: TailRule
TAIL_RULE_UNSPECIFIED: TailRule
TAIL_RULE_WIND: TailRule

class CorrelationQuery(_message.Message):
    __slots__ = ["azimuth", "cells", "footprint", "gaussian", "incidence", "refractive_index", "separations", "waves_travel_both_ways"]
    AZIMUTH_FIELD_NUMBER: _ClassVar[int]
    CELLS_FIELD_NUMBER: _ClassVar[int]
    FOOTPRINT_FIELD_NUMBER: _ClassVar[int]
    GAUSSIAN_FIELD_NUMBER: _ClassVar[int]
    INCIDENCE_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    SEPARATIONS_FIELD_NUMBER: _ClassVar[int]
    WAVES_TRAVEL_BOTH_WAYS_FIELD_NUMBER: _ClassVar[int]
    azimuth: float
    cells: _containers.RepeatedCompositeFieldContainer[SurfaceCell]
    footprint: float
    gaussian: bool
    incidence: float
    refractive_index: float
    separations: _containers.RepeatedCompositeFieldContainer[PulseSeparation]
    waves_travel_both_ways: bool
    def __init__(self, incidence: _Optional[float] = ..., azimuth: _Optional[float] = ..., footprint: _Optional[float] = ..., gaussian: bool = ..., refractive_index: _Optional[float] = ..., waves_travel_both_ways: bool = ..., separations: _Optional[_Iterable[_Union[PulseSeparation, _Mapping]]] = ..., cells: _Optional[_Iterable[_Union[SurfaceCell, _Mapping]]] = ...) -> None: ...

class FrequencySpectrum(_message.Message):
    __slots__ = ["cosines", "densities", "frequencies", "record_length", "sines", "trusted_up_to"]
    COSINES_FIELD_NUMBER: _ClassVar[int]
    DENSITIES_FIELD_NUMBER: _ClassVar[int]
    FREQUENCIES_FIELD_NUMBER: _ClassVar[int]
    RECORD_LENGTH_FIELD_NUMBER: _ClassVar[int]
    SINES_FIELD_NUMBER: _ClassVar[int]
    TRUSTED_UP_TO_FIELD_NUMBER: _ClassVar[int]
    cosines: _containers.RepeatedScalarFieldContainer[float]
    densities: _containers.RepeatedScalarFieldContainer[float]
    frequencies: _containers.RepeatedScalarFieldContainer[float]
    record_length: float
    sines: _containers.RepeatedScalarFieldContainer[float]
    trusted_up_to: float
    def __init__(self, frequencies: _Optional[_Iterable[float]] = ..., densities: _Optional[_Iterable[float]] = ..., cosines: _Optional[_Iterable[float]] = ..., sines: _Optional[_Iterable[float]] = ..., trusted_up_to: _Optional[float] = ..., record_length: _Optional[float] = ...) -> None: ...

class PulseCorrelation(_message.Message):
    __slots__ = ["height", "horizontal", "slope_x", "slope_y", "vertical"]
    HEIGHT_FIELD_NUMBER: _ClassVar[int]
    HORIZONTAL_FIELD_NUMBER: _ClassVar[int]
    SLOPE_X_FIELD_NUMBER: _ClassVar[int]
    SLOPE_Y_FIELD_NUMBER: _ClassVar[int]
    VERTICAL_FIELD_NUMBER: _ClassVar[int]
    height: float
    horizontal: float
    slope_x: float
    slope_y: float
    vertical: float
    def __init__(self, slope_x: _Optional[float] = ..., slope_y: _Optional[float] = ..., horizontal: _Optional[float] = ..., vertical: _Optional[float] = ..., height: _Optional[float] = ...) -> None: ...

class PulseSeparation(_message.Message):
    __slots__ = ["seconds", "x", "y"]
    SECONDS_FIELD_NUMBER: _ClassVar[int]
    X_FIELD_NUMBER: _ClassVar[int]
    Y_FIELD_NUMBER: _ClassVar[int]
    seconds: float
    x: float
    y: float
    def __init__(self, x: _Optional[float] = ..., y: _Optional[float] = ..., seconds: _Optional[float] = ...) -> None: ...

class SeaCorrelation(_message.Message):
    __slots__ = ["cells", "separations"]
    CELLS_FIELD_NUMBER: _ClassVar[int]
    SEPARATIONS_FIELD_NUMBER: _ClassVar[int]
    cells: _containers.RepeatedCompositeFieldContainer[PulseCorrelation]
    separations: _containers.RepeatedCompositeFieldContainer[PulseCorrelation]
    def __init__(self, separations: _Optional[_Iterable[_Union[PulseCorrelation, _Mapping]]] = ..., cells: _Optional[_Iterable[_Union[PulseCorrelation, _Mapping]]] = ...) -> None: ...

class SeaState(_message.Message):
    __slots__ = ["components", "frequency_spectrum", "tail_from", "tail_rule", "water_depth", "wavenumber_spectrum", "wind_from", "wind_speed"]
    COMPONENTS_FIELD_NUMBER: _ClassVar[int]
    FREQUENCY_SPECTRUM_FIELD_NUMBER: _ClassVar[int]
    TAIL_FROM_FIELD_NUMBER: _ClassVar[int]
    TAIL_RULE_FIELD_NUMBER: _ClassVar[int]
    WATER_DEPTH_FIELD_NUMBER: _ClassVar[int]
    WAVENUMBER_SPECTRUM_FIELD_NUMBER: _ClassVar[int]
    WIND_FROM_FIELD_NUMBER: _ClassVar[int]
    WIND_SPEED_FIELD_NUMBER: _ClassVar[int]
    components: WaveComponents
    frequency_spectrum: FrequencySpectrum
    tail_from: float
    tail_rule: TailRule
    water_depth: float
    wavenumber_spectrum: WavenumberSpectrum
    wind_from: float
    wind_speed: float
    def __init__(self, components: _Optional[_Union[WaveComponents, _Mapping]] = ..., frequency_spectrum: _Optional[_Union[FrequencySpectrum, _Mapping]] = ..., wavenumber_spectrum: _Optional[_Union[WavenumberSpectrum, _Mapping]] = ..., wind_speed: _Optional[float] = ..., wind_from: _Optional[float] = ..., water_depth: _Optional[float] = ..., tail_rule: _Optional[_Union[TailRule, str]] = ..., tail_from: _Optional[float] = ...) -> None: ...

class SeaSummary(_message.Message):
    __slots__ = ["assumptions", "share_measured", "significant_wave_height", "tail_from", "water_depth", "wind_speed", "x_azimuth"]
    ASSUMPTIONS_FIELD_NUMBER: _ClassVar[int]
    SHARE_MEASURED_FIELD_NUMBER: _ClassVar[int]
    SIGNIFICANT_WAVE_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    TAIL_FROM_FIELD_NUMBER: _ClassVar[int]
    WATER_DEPTH_FIELD_NUMBER: _ClassVar[int]
    WIND_SPEED_FIELD_NUMBER: _ClassVar[int]
    X_AZIMUTH_FIELD_NUMBER: _ClassVar[int]
    assumptions: _containers.RepeatedScalarFieldContainer[str]
    share_measured: float
    significant_wave_height: float
    tail_from: float
    water_depth: float
    wind_speed: float
    x_azimuth: float
    def __init__(self, x_azimuth: _Optional[float] = ..., significant_wave_height: _Optional[float] = ..., wind_speed: _Optional[float] = ..., water_depth: _Optional[float] = ..., tail_from: _Optional[float] = ..., share_measured: _Optional[float] = ..., assumptions: _Optional[_Iterable[str]] = ...) -> None: ...

class SurfaceCell(_message.Message):
    __slots__ = ["orientation", "side"]
    ORIENTATION_FIELD_NUMBER: _ClassVar[int]
    SIDE_FIELD_NUMBER: _ClassVar[int]
    orientation: float
    side: float
    def __init__(self, side: _Optional[float] = ..., orientation: _Optional[float] = ...) -> None: ...

class WaveComponent(_message.Message):
    __slots__ = ["gamma", "peak_period", "significant_wave_height", "spread", "travels_towards"]
    GAMMA_FIELD_NUMBER: _ClassVar[int]
    PEAK_PERIOD_FIELD_NUMBER: _ClassVar[int]
    SIGNIFICANT_WAVE_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    SPREAD_FIELD_NUMBER: _ClassVar[int]
    TRAVELS_TOWARDS_FIELD_NUMBER: _ClassVar[int]
    gamma: float
    peak_period: float
    significant_wave_height: float
    spread: float
    travels_towards: float
    def __init__(self, significant_wave_height: _Optional[float] = ..., peak_period: _Optional[float] = ..., gamma: _Optional[float] = ..., travels_towards: _Optional[float] = ..., spread: _Optional[float] = ...) -> None: ...

class WaveComponents(_message.Message):
    __slots__ = ["components"]
    COMPONENTS_FIELD_NUMBER: _ClassVar[int]
    components: _containers.RepeatedCompositeFieldContainer[WaveComponent]
    def __init__(self, components: _Optional[_Iterable[_Union[WaveComponent, _Mapping]]] = ...) -> None: ...

class WavenumberSpectrum(_message.Message):
    __slots__ = ["cosines", "densities", "sines", "wavenumbers"]
    COSINES_FIELD_NUMBER: _ClassVar[int]
    DENSITIES_FIELD_NUMBER: _ClassVar[int]
    SINES_FIELD_NUMBER: _ClassVar[int]
    WAVENUMBERS_FIELD_NUMBER: _ClassVar[int]
    cosines: _containers.RepeatedScalarFieldContainer[float]
    densities: _containers.RepeatedScalarFieldContainer[float]
    sines: _containers.RepeatedScalarFieldContainer[float]
    wavenumbers: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, wavenumbers: _Optional[_Iterable[float]] = ..., densities: _Optional[_Iterable[float]] = ..., cosines: _Optional[_Iterable[float]] = ..., sines: _Optional[_Iterable[float]] = ...) -> None: ...

class TailRule(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
