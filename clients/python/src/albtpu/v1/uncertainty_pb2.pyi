from albtpu.v1 import pulse_pb2 as _pulse_pb2
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Mapping as _Mapping, Optional as _Optional, Union as _Union

COVERAGE_ONE_SIGMA: Coverage
COVERAGE_P95: Coverage
COVERAGE_TWO_SIGMA: Coverage
COVERAGE_UNSPECIFIED: Coverage
DESCRIPTOR: _descriptor.FileDescriptor
OUTCOME_INTERPOLATED: Outcome
OUTCOME_INVALID: Outcome
OUTCOME_OUT_OF_DOMAIN: Outcome
OUTCOME_UNSPECIFIED: Outcome
QUANTITY_BIAS_ALONG_BEAM: Quantity
QUANTITY_BIAS_VERTICAL: Quantity
QUANTITY_REFRACTION_ALONG_WIND: Quantity
QUANTITY_REFRACTION_CROSS_WIND: Quantity
QUANTITY_THU: Quantity
QUANTITY_TVU: Quantity
QUANTITY_UNSPECIFIED: Quantity
S44_ORDER_1A: S44Order
S44_ORDER_1B: S44Order
S44_ORDER_2: S44Order
S44_ORDER_EXCLUSIVE: S44Order
S44_ORDER_SPECIAL: S44Order
S44_ORDER_UNSPECIFIED: S44Order

class PulseUncertainty(_message.Message):
    __slots__ = ["axis", "azimuth_absent", "outcome", "s44", "sea_surface", "sea_surface_standard_error"]
    AXIS_FIELD_NUMBER: _ClassVar[int]
    AZIMUTH_ABSENT_FIELD_NUMBER: _ClassVar[int]
    OUTCOME_FIELD_NUMBER: _ClassVar[int]
    S44_FIELD_NUMBER: _ClassVar[int]
    SEA_SURFACE_FIELD_NUMBER: _ClassVar[int]
    SEA_SURFACE_STANDARD_ERROR_FIELD_NUMBER: _ClassVar[int]
    axis: _pulse_pb2.Axis
    azimuth_absent: bool
    outcome: Outcome
    s44: S44
    sea_surface: SeaSurface
    sea_surface_standard_error: SeaSurface
    def __init__(self, outcome: _Optional[_Union[Outcome, str]] = ..., axis: _Optional[_Union[_pulse_pb2.Axis, str]] = ..., azimuth_absent: bool = ..., sea_surface: _Optional[_Union[SeaSurface, _Mapping]] = ..., sea_surface_standard_error: _Optional[_Union[SeaSurface, _Mapping]] = ..., s44: _Optional[_Union[S44, _Mapping]] = ...) -> None: ...

class S44(_message.Message):
    __slots__ = ["best_order", "remaining_thu", "remaining_tvu"]
    BEST_ORDER_FIELD_NUMBER: _ClassVar[int]
    REMAINING_THU_FIELD_NUMBER: _ClassVar[int]
    REMAINING_TVU_FIELD_NUMBER: _ClassVar[int]
    best_order: S44Order
    remaining_thu: float
    remaining_tvu: float
    def __init__(self, best_order: _Optional[_Union[S44Order, str]] = ..., remaining_thu: _Optional[float] = ..., remaining_tvu: _Optional[float] = ...) -> None: ...

class S44Columns(_message.Message):
    __slots__ = ["best_orders", "remaining_thu", "remaining_tvu"]
    BEST_ORDERS_FIELD_NUMBER: _ClassVar[int]
    REMAINING_THU_FIELD_NUMBER: _ClassVar[int]
    REMAINING_TVU_FIELD_NUMBER: _ClassVar[int]
    best_orders: bytes
    remaining_thu: bytes
    remaining_tvu: bytes
    def __init__(self, best_orders: _Optional[bytes] = ..., remaining_thu: _Optional[bytes] = ..., remaining_tvu: _Optional[bytes] = ...) -> None: ...

class SeaSurface(_message.Message):
    __slots__ = ["bias_along_beam", "bias_vertical", "refraction_along_wind", "refraction_cross_wind", "thu", "tvu"]
    BIAS_ALONG_BEAM_FIELD_NUMBER: _ClassVar[int]
    BIAS_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    REFRACTION_ALONG_WIND_FIELD_NUMBER: _ClassVar[int]
    REFRACTION_CROSS_WIND_FIELD_NUMBER: _ClassVar[int]
    THU_FIELD_NUMBER: _ClassVar[int]
    TVU_FIELD_NUMBER: _ClassVar[int]
    bias_along_beam: float
    bias_vertical: float
    refraction_along_wind: float
    refraction_cross_wind: float
    thu: float
    tvu: float
    def __init__(self, refraction_along_wind: _Optional[float] = ..., refraction_cross_wind: _Optional[float] = ..., thu: _Optional[float] = ..., tvu: _Optional[float] = ..., bias_along_beam: _Optional[float] = ..., bias_vertical: _Optional[float] = ...) -> None: ...

class SeaSurfaceColumns(_message.Message):
    __slots__ = ["bias_along_beam", "bias_vertical", "refraction_along_wind", "refraction_cross_wind", "thu", "tvu"]
    BIAS_ALONG_BEAM_FIELD_NUMBER: _ClassVar[int]
    BIAS_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    REFRACTION_ALONG_WIND_FIELD_NUMBER: _ClassVar[int]
    REFRACTION_CROSS_WIND_FIELD_NUMBER: _ClassVar[int]
    THU_FIELD_NUMBER: _ClassVar[int]
    TVU_FIELD_NUMBER: _ClassVar[int]
    bias_along_beam: bytes
    bias_vertical: bytes
    refraction_along_wind: bytes
    refraction_cross_wind: bytes
    thu: bytes
    tvu: bytes
    def __init__(self, refraction_along_wind: _Optional[bytes] = ..., refraction_cross_wind: _Optional[bytes] = ..., thu: _Optional[bytes] = ..., tvu: _Optional[bytes] = ..., bias_along_beam: _Optional[bytes] = ..., bias_vertical: _Optional[bytes] = ...) -> None: ...

class Outcome(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class Coverage(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class Quantity(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class S44Order(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
