from albtpu.v1 import table_pb2 as _table_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

BIAS_HANDLING_CALIBRATED: BiasHandling
BIAS_HANDLING_CORRECT: BiasHandling
BIAS_HANDLING_NONE: BiasHandling
BIAS_HANDLING_UNSPECIFIED: BiasHandling
BIAS_HANDLING_VENDOR: BiasHandling
DESCRIPTOR: _descriptor.FileDescriptor
ECHO_DETECTOR_CENTROID: EchoDetector
ECHO_DETECTOR_HALF: EchoDetector
ECHO_DETECTOR_PEAK: EchoDetector
ECHO_DETECTOR_UNSPECIFIED: EchoDetector
JERLOV_TYPE_1C: JerlovType
JERLOV_TYPE_3C: JerlovType
JERLOV_TYPE_5C: JerlovType
JERLOV_TYPE_7C: JerlovType
JERLOV_TYPE_9C: JerlovType
JERLOV_TYPE_I: JerlovType
JERLOV_TYPE_IA: JerlovType
JERLOV_TYPE_IB: JerlovType
JERLOV_TYPE_II: JerlovType
JERLOV_TYPE_III: JerlovType
JERLOV_TYPE_UNSPECIFIED: JerlovType
KD_KIND_DIFFUSE532: KdKind
KD_KIND_JERLOV: KdKind
KD_KIND_SATELLITE490: KdKind
KD_KIND_SECCHI: KdKind
KD_KIND_SYSTEM: KdKind
KD_KIND_UNSPECIFIED: KdKind

class BiasCalibration(_message.Message):
    __slots__ = ["depth", "offset", "sigma"]
    DEPTH_FIELD_NUMBER: _ClassVar[int]
    OFFSET_FIELD_NUMBER: _ClassVar[int]
    SIGMA_FIELD_NUMBER: _ClassVar[int]
    depth: float
    offset: float
    sigma: float
    def __init__(self, depth: _Optional[float] = ..., offset: _Optional[float] = ..., sigma: _Optional[float] = ...) -> None: ...

class WaterState(_message.Message):
    __slots__ = ["absorption", "backscatter_fraction", "bias", "calibration", "detector", "field_of_view", "green_surface", "jerlov", "kd", "kd_kind", "kd_sigma", "omega0", "omega0_sigma", "photons", "processed_with", "pulse_length", "residual_fraction", "salinity", "scattering", "secchi", "temperature", "without_column"]
    ABSORPTION_FIELD_NUMBER: _ClassVar[int]
    BACKSCATTER_FRACTION_FIELD_NUMBER: _ClassVar[int]
    BIAS_FIELD_NUMBER: _ClassVar[int]
    CALIBRATION_FIELD_NUMBER: _ClassVar[int]
    DETECTOR_FIELD_NUMBER: _ClassVar[int]
    FIELD_OF_VIEW_FIELD_NUMBER: _ClassVar[int]
    GREEN_SURFACE_FIELD_NUMBER: _ClassVar[int]
    JERLOV_FIELD_NUMBER: _ClassVar[int]
    KD_FIELD_NUMBER: _ClassVar[int]
    KD_KIND_FIELD_NUMBER: _ClassVar[int]
    KD_SIGMA_FIELD_NUMBER: _ClassVar[int]
    OMEGA0_FIELD_NUMBER: _ClassVar[int]
    OMEGA0_SIGMA_FIELD_NUMBER: _ClassVar[int]
    PHOTONS_FIELD_NUMBER: _ClassVar[int]
    PROCESSED_WITH_FIELD_NUMBER: _ClassVar[int]
    PULSE_LENGTH_FIELD_NUMBER: _ClassVar[int]
    RESIDUAL_FRACTION_FIELD_NUMBER: _ClassVar[int]
    SALINITY_FIELD_NUMBER: _ClassVar[int]
    SCATTERING_FIELD_NUMBER: _ClassVar[int]
    SECCHI_FIELD_NUMBER: _ClassVar[int]
    TEMPERATURE_FIELD_NUMBER: _ClassVar[int]
    WITHOUT_COLUMN_FIELD_NUMBER: _ClassVar[int]
    absorption: float
    backscatter_fraction: float
    bias: BiasHandling
    calibration: BiasCalibration
    detector: EchoDetector
    field_of_view: float
    green_surface: bool
    jerlov: JerlovType
    kd: float
    kd_kind: KdKind
    kd_sigma: float
    omega0: float
    omega0_sigma: float
    photons: float
    processed_with: float
    pulse_length: float
    residual_fraction: float
    salinity: float
    scattering: float
    secchi: float
    temperature: float
    without_column: bool
    def __init__(self, kd: _Optional[float] = ..., kd_kind: _Optional[_Union[KdKind, str]] = ..., secchi: _Optional[float] = ..., jerlov: _Optional[_Union[JerlovType, str]] = ..., absorption: _Optional[float] = ..., scattering: _Optional[float] = ..., kd_sigma: _Optional[float] = ..., omega0: _Optional[float] = ..., omega0_sigma: _Optional[float] = ..., backscatter_fraction: _Optional[float] = ..., detector: _Optional[_Union[EchoDetector, str]] = ..., field_of_view: _Optional[float] = ..., pulse_length: _Optional[float] = ..., bias: _Optional[_Union[BiasHandling, str]] = ..., residual_fraction: _Optional[float] = ..., calibration: _Optional[_Union[BiasCalibration, _Mapping]] = ..., photons: _Optional[float] = ..., temperature: _Optional[float] = ..., salinity: _Optional[float] = ..., processed_with: _Optional[float] = ..., green_surface: bool = ..., without_column: bool = ...) -> None: ...

class WaterSummary(_message.Message):
    __slots__ = ["assumptions", "attenuation", "attenuation_log_sigma", "derivation", "greatest_depth", "greatest_footprint", "greatest_incidence", "green_surface_range", "table"]
    ASSUMPTIONS_FIELD_NUMBER: _ClassVar[int]
    ATTENUATION_FIELD_NUMBER: _ClassVar[int]
    ATTENUATION_LOG_SIGMA_FIELD_NUMBER: _ClassVar[int]
    DERIVATION_FIELD_NUMBER: _ClassVar[int]
    GREATEST_DEPTH_FIELD_NUMBER: _ClassVar[int]
    GREATEST_FOOTPRINT_FIELD_NUMBER: _ClassVar[int]
    GREATEST_INCIDENCE_FIELD_NUMBER: _ClassVar[int]
    GREEN_SURFACE_RANGE_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    assumptions: _containers.RepeatedScalarFieldContainer[str]
    attenuation: float
    attenuation_log_sigma: float
    derivation: str
    greatest_depth: float
    greatest_footprint: float
    greatest_incidence: float
    green_surface_range: float
    table: _table_pb2.TableReference
    def __init__(self, table: _Optional[_Union[_table_pb2.TableReference, _Mapping]] = ..., attenuation: _Optional[float] = ..., attenuation_log_sigma: _Optional[float] = ..., derivation: _Optional[str] = ..., greatest_depth: _Optional[float] = ..., greatest_incidence: _Optional[float] = ..., greatest_footprint: _Optional[float] = ..., green_surface_range: _Optional[float] = ..., assumptions: _Optional[_Iterable[str]] = ...) -> None: ...

class KdKind(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class JerlovType(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class EchoDetector(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class BiasHandling(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
