from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Optional as _Optional

AXIS_AZIMUTH: Axis
AXIS_DEPTH: Axis
AXIS_FETCH: Axis
AXIS_FOOTPRINT: Axis
AXIS_INCIDENCE: Axis
AXIS_UNSPECIFIED: Axis
AXIS_WIND_SPEED: Axis
DESCRIPTOR: _descriptor.FileDescriptor

class Pulse(_message.Message):
    __slots__ = ["azimuth", "depth", "fetch", "footprint", "incidence", "wind_speed"]
    AZIMUTH_FIELD_NUMBER: _ClassVar[int]
    DEPTH_FIELD_NUMBER: _ClassVar[int]
    FETCH_FIELD_NUMBER: _ClassVar[int]
    FOOTPRINT_FIELD_NUMBER: _ClassVar[int]
    INCIDENCE_FIELD_NUMBER: _ClassVar[int]
    WIND_SPEED_FIELD_NUMBER: _ClassVar[int]
    azimuth: float
    depth: float
    fetch: float
    footprint: float
    incidence: float
    wind_speed: float
    def __init__(self, wind_speed: _Optional[float] = ..., fetch: _Optional[float] = ..., incidence: _Optional[float] = ..., azimuth: _Optional[float] = ..., footprint: _Optional[float] = ..., depth: _Optional[float] = ...) -> None: ...

class PulseColumns(_message.Message):
    __slots__ = ["azimuth", "depth", "fetch", "footprint", "incidence", "wind_speed"]
    AZIMUTH_FIELD_NUMBER: _ClassVar[int]
    DEPTH_FIELD_NUMBER: _ClassVar[int]
    FETCH_FIELD_NUMBER: _ClassVar[int]
    FOOTPRINT_FIELD_NUMBER: _ClassVar[int]
    INCIDENCE_FIELD_NUMBER: _ClassVar[int]
    WIND_SPEED_FIELD_NUMBER: _ClassVar[int]
    azimuth: bytes
    depth: bytes
    fetch: bytes
    footprint: bytes
    incidence: bytes
    wind_speed: bytes
    def __init__(self, wind_speed: _Optional[bytes] = ..., fetch: _Optional[bytes] = ..., incidence: _Optional[bytes] = ..., azimuth: _Optional[bytes] = ..., footprint: _Optional[bytes] = ..., depth: _Optional[bytes] = ...) -> None: ...

class Axis(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
