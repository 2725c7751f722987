from albtpu.v1 import uncertainty_pb2 as _uncertainty_pb2
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Mapping as _Mapping, Optional as _Optional, Union as _Union

BUDGET_QUANTITY_BEST_S44_ORDER: BudgetQuantity
BUDGET_QUANTITY_BIAS_ALONG_BEAM: BudgetQuantity
BUDGET_QUANTITY_BIAS_VERTICAL: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_AIR: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_LINE: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_PULSE: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_SEA: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_SURVEY: BudgetQuantity
BUDGET_QUANTITY_COVARIANCE_TOTAL: BudgetQuantity
BUDGET_QUANTITY_THU_AIR: BudgetQuantity
BUDGET_QUANTITY_THU_SEA: BudgetQuantity
BUDGET_QUANTITY_THU_WATER: BudgetQuantity
BUDGET_QUANTITY_TOTAL_THU: BudgetQuantity
BUDGET_QUANTITY_TOTAL_TVU: BudgetQuantity
BUDGET_QUANTITY_TVU_AIR: BudgetQuantity
BUDGET_QUANTITY_TVU_SEA: BudgetQuantity
BUDGET_QUANTITY_TVU_WATER: BudgetQuantity
BUDGET_QUANTITY_UNSPECIFIED: BudgetQuantity
DESCRIPTOR: _descriptor.FileDescriptor
SURFACE_LOCATION_LEVEL: SurfaceLocation
SURFACE_LOCATION_LOCAL: SurfaceLocation
SURFACE_LOCATION_PULSE: SurfaceLocation
SURFACE_LOCATION_UNSPECIFIED: SurfaceLocation

class AirErrors(_message.Message):
    __slots__ = ["attitude", "boresight", "bottom_range", "index", "lever_arm", "position", "range_offset", "scan", "surface_height", "surface_range", "time"]
    ATTITUDE_FIELD_NUMBER: _ClassVar[int]
    BORESIGHT_FIELD_NUMBER: _ClassVar[int]
    BOTTOM_RANGE_FIELD_NUMBER: _ClassVar[int]
    INDEX_FIELD_NUMBER: _ClassVar[int]
    LEVER_ARM_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    RANGE_OFFSET_FIELD_NUMBER: _ClassVar[int]
    SCAN_FIELD_NUMBER: _ClassVar[int]
    SURFACE_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    SURFACE_RANGE_FIELD_NUMBER: _ClassVar[int]
    TIME_FIELD_NUMBER: _ClassVar[int]
    attitude: RollPitchHeading
    boresight: ForwardRightDown
    bottom_range: float
    index: float
    lever_arm: float
    position: NorthEastDown
    range_offset: float
    scan: float
    surface_height: float
    surface_range: float
    time: float
    def __init__(self, position: _Optional[_Union[NorthEastDown, _Mapping]] = ..., attitude: _Optional[_Union[RollPitchHeading, _Mapping]] = ..., boresight: _Optional[_Union[ForwardRightDown, _Mapping]] = ..., lever_arm: _Optional[float] = ..., scan: _Optional[float] = ..., time: _Optional[float] = ..., range_offset: _Optional[float] = ..., bottom_range: _Optional[float] = ..., surface_height: _Optional[float] = ..., index: _Optional[float] = ..., surface_range: _Optional[float] = ...) -> None: ...

class AircraftColumns(_message.Message):
    __slots__ = ["altitude", "beam_azimuth", "heading", "heading_sigma", "pitch", "pitch_rate", "pitch_sigma", "position_sigma_down", "position_sigma_east", "position_sigma_north", "roll", "roll_rate", "roll_sigma", "velocity_down", "velocity_east", "velocity_north", "water_bias_along", "water_bias_vertical", "water_correlation", "water_noise", "water_sigma_along", "water_sigma_vertical", "wave_height", "yaw_rate"]
    ALTITUDE_FIELD_NUMBER: _ClassVar[int]
    BEAM_AZIMUTH_FIELD_NUMBER: _ClassVar[int]
    HEADING_FIELD_NUMBER: _ClassVar[int]
    HEADING_SIGMA_FIELD_NUMBER: _ClassVar[int]
    PITCH_FIELD_NUMBER: _ClassVar[int]
    PITCH_RATE_FIELD_NUMBER: _ClassVar[int]
    PITCH_SIGMA_FIELD_NUMBER: _ClassVar[int]
    POSITION_SIGMA_DOWN_FIELD_NUMBER: _ClassVar[int]
    POSITION_SIGMA_EAST_FIELD_NUMBER: _ClassVar[int]
    POSITION_SIGMA_NORTH_FIELD_NUMBER: _ClassVar[int]
    ROLL_FIELD_NUMBER: _ClassVar[int]
    ROLL_RATE_FIELD_NUMBER: _ClassVar[int]
    ROLL_SIGMA_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_DOWN_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_EAST_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_NORTH_FIELD_NUMBER: _ClassVar[int]
    WATER_BIAS_ALONG_FIELD_NUMBER: _ClassVar[int]
    WATER_BIAS_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    WATER_CORRELATION_FIELD_NUMBER: _ClassVar[int]
    WATER_NOISE_FIELD_NUMBER: _ClassVar[int]
    WATER_SIGMA_ALONG_FIELD_NUMBER: _ClassVar[int]
    WATER_SIGMA_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    WAVE_HEIGHT_FIELD_NUMBER: _ClassVar[int]
    YAW_RATE_FIELD_NUMBER: _ClassVar[int]
    altitude: bytes
    beam_azimuth: bytes
    heading: bytes
    heading_sigma: bytes
    pitch: bytes
    pitch_rate: bytes
    pitch_sigma: bytes
    position_sigma_down: bytes
    position_sigma_east: bytes
    position_sigma_north: bytes
    roll: bytes
    roll_rate: bytes
    roll_sigma: bytes
    velocity_down: bytes
    velocity_east: bytes
    velocity_north: bytes
    water_bias_along: bytes
    water_bias_vertical: bytes
    water_correlation: bytes
    water_noise: bytes
    water_sigma_along: bytes
    water_sigma_vertical: bytes
    wave_height: bytes
    yaw_rate: bytes
    def __init__(self, altitude: _Optional[bytes] = ..., beam_azimuth: _Optional[bytes] = ..., roll: _Optional[bytes] = ..., pitch: _Optional[bytes] = ..., heading: _Optional[bytes] = ..., velocity_north: _Optional[bytes] = ..., velocity_east: _Optional[bytes] = ..., velocity_down: _Optional[bytes] = ..., roll_rate: _Optional[bytes] = ..., pitch_rate: _Optional[bytes] = ..., yaw_rate: _Optional[bytes] = ..., position_sigma_north: _Optional[bytes] = ..., position_sigma_east: _Optional[bytes] = ..., position_sigma_down: _Optional[bytes] = ..., roll_sigma: _Optional[bytes] = ..., pitch_sigma: _Optional[bytes] = ..., heading_sigma: _Optional[bytes] = ..., wave_height: _Optional[bytes] = ..., water_sigma_along: _Optional[bytes] = ..., water_sigma_vertical: _Optional[bytes] = ..., water_correlation: _Optional[bytes] = ..., water_noise: _Optional[bytes] = ..., water_bias_along: _Optional[bytes] = ..., water_bias_vertical: _Optional[bytes] = ...) -> None: ...

class BudgetColumns(_message.Message):
    __slots__ = ["best_s44_orders", "bias_along_beam", "bias_vertical", "covariance_air", "covariance_line", "covariance_pulse", "covariance_sea", "covariance_survey", "covariance_total", "thu_air", "thu_sea", "thu_water", "total_thu", "total_tvu", "tvu_air", "tvu_sea", "tvu_water"]
    BEST_S44_ORDERS_FIELD_NUMBER: _ClassVar[int]
    BIAS_ALONG_BEAM_FIELD_NUMBER: _ClassVar[int]
    BIAS_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_AIR_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_LINE_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_PULSE_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_SEA_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_SURVEY_FIELD_NUMBER: _ClassVar[int]
    COVARIANCE_TOTAL_FIELD_NUMBER: _ClassVar[int]
    THU_AIR_FIELD_NUMBER: _ClassVar[int]
    THU_SEA_FIELD_NUMBER: _ClassVar[int]
    THU_WATER_FIELD_NUMBER: _ClassVar[int]
    TOTAL_THU_FIELD_NUMBER: _ClassVar[int]
    TOTAL_TVU_FIELD_NUMBER: _ClassVar[int]
    TVU_AIR_FIELD_NUMBER: _ClassVar[int]
    TVU_SEA_FIELD_NUMBER: _ClassVar[int]
    TVU_WATER_FIELD_NUMBER: _ClassVar[int]
    best_s44_orders: bytes
    bias_along_beam: bytes
    bias_vertical: bytes
    covariance_air: bytes
    covariance_line: bytes
    covariance_pulse: bytes
    covariance_sea: bytes
    covariance_survey: bytes
    covariance_total: bytes
    thu_air: bytes
    thu_sea: bytes
    thu_water: bytes
    total_thu: bytes
    total_tvu: bytes
    tvu_air: bytes
    tvu_sea: bytes
    tvu_water: bytes
    def __init__(self, total_thu: _Optional[bytes] = ..., total_tvu: _Optional[bytes] = ..., thu_air: _Optional[bytes] = ..., tvu_air: _Optional[bytes] = ..., thu_sea: _Optional[bytes] = ..., tvu_sea: _Optional[bytes] = ..., bias_along_beam: _Optional[bytes] = ..., bias_vertical: _Optional[bytes] = ..., covariance_total: _Optional[bytes] = ..., covariance_air: _Optional[bytes] = ..., covariance_sea: _Optional[bytes] = ..., covariance_pulse: _Optional[bytes] = ..., covariance_line: _Optional[bytes] = ..., covariance_survey: _Optional[bytes] = ..., best_s44_orders: _Optional[bytes] = ..., thu_water: _Optional[bytes] = ..., tvu_water: _Optional[bytes] = ...) -> None: ...

class BudgetOptions(_message.Message):
    __slots__ = ["coverage", "datum", "errors", "extra_horizontal", "extra_vertical", "lever_arm", "located", "refractive_index", "sea_axis", "table"]
    COVERAGE_FIELD_NUMBER: _ClassVar[int]
    DATUM_FIELD_NUMBER: _ClassVar[int]
    ERRORS_FIELD_NUMBER: _ClassVar[int]
    EXTRA_HORIZONTAL_FIELD_NUMBER: _ClassVar[int]
    EXTRA_VERTICAL_FIELD_NUMBER: _ClassVar[int]
    LEVER_ARM_FIELD_NUMBER: _ClassVar[int]
    LOCATED_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    SEA_AXIS_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    coverage: _uncertainty_pb2.Coverage
    datum: float
    errors: AirErrors
    extra_horizontal: float
    extra_vertical: float
    lever_arm: ForwardRightDown
    located: SurfaceLocation
    refractive_index: float
    sea_axis: float
    table: str
    def __init__(self, table: _Optional[str] = ..., coverage: _Optional[_Union[_uncertainty_pb2.Coverage, str]] = ..., errors: _Optional[_Union[AirErrors, _Mapping]] = ..., located: _Optional[_Union[SurfaceLocation, str]] = ..., lever_arm: _Optional[_Union[ForwardRightDown, _Mapping]] = ..., refractive_index: _Optional[float] = ..., datum: _Optional[float] = ..., sea_axis: _Optional[float] = ..., extra_horizontal: _Optional[float] = ..., extra_vertical: _Optional[float] = ...) -> None: ...

class ForwardRightDown(_message.Message):
    __slots__ = ["down", "forward", "right"]
    DOWN_FIELD_NUMBER: _ClassVar[int]
    FORWARD_FIELD_NUMBER: _ClassVar[int]
    RIGHT_FIELD_NUMBER: _ClassVar[int]
    down: float
    forward: float
    right: float
    def __init__(self, forward: _Optional[float] = ..., right: _Optional[float] = ..., down: _Optional[float] = ...) -> None: ...

class NorthEastDown(_message.Message):
    __slots__ = ["down", "east", "north"]
    DOWN_FIELD_NUMBER: _ClassVar[int]
    EAST_FIELD_NUMBER: _ClassVar[int]
    NORTH_FIELD_NUMBER: _ClassVar[int]
    down: float
    east: float
    north: float
    def __init__(self, north: _Optional[float] = ..., east: _Optional[float] = ..., down: _Optional[float] = ...) -> None: ...

class RollPitchHeading(_message.Message):
    __slots__ = ["heading", "pitch", "roll"]
    HEADING_FIELD_NUMBER: _ClassVar[int]
    PITCH_FIELD_NUMBER: _ClassVar[int]
    ROLL_FIELD_NUMBER: _ClassVar[int]
    heading: float
    pitch: float
    roll: float
    def __init__(self, roll: _Optional[float] = ..., pitch: _Optional[float] = ..., heading: _Optional[float] = ...) -> None: ...

class SurfaceLocation(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []

class BudgetQuantity(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
