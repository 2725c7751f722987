from albtpu.v1 import pulse_pb2 as _pulse_pb2
from albtpu.v1 import sea_pb2 as _sea_pb2
from albtpu.v1 import uncertainty_pb2 as _uncertainty_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor
SCALE_LINEAR: Scale
SCALE_LOG: Scale
SCALE_UNSPECIFIED: Scale

class AttributeNumbers(_message.Message):
    __slots__ = ["values"]
    VALUES_FIELD_NUMBER: _ClassVar[int]
    values: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, values: _Optional[_Iterable[float]] = ...) -> None: ...

class AttributeValue(_message.Message):
    __slots__ = ["integer", "number", "numbers", "text"]
    INTEGER_FIELD_NUMBER: _ClassVar[int]
    NUMBERS_FIELD_NUMBER: _ClassVar[int]
    NUMBER_FIELD_NUMBER: _ClassVar[int]
    TEXT_FIELD_NUMBER: _ClassVar[int]
    integer: int
    number: float
    numbers: AttributeNumbers
    text: str
    def __init__(self, text: _Optional[str] = ..., integer: _Optional[int] = ..., number: _Optional[float] = ..., numbers: _Optional[_Union[AttributeNumbers, _Mapping]] = ...) -> None: ...

class Table(_message.Message):
    __slots__ = ["attributes", "axes", "campaign", "quantities", "reference", "sea", "title"]
    class AttributesEntry(_message.Message):
        __slots__ = ["key", "value"]
        KEY_FIELD_NUMBER: _ClassVar[int]
        VALUE_FIELD_NUMBER: _ClassVar[int]
        key: str
        value: AttributeValue
        def __init__(self, key: _Optional[str] = ..., value: _Optional[_Union[AttributeValue, _Mapping]] = ...) -> None: ...
    ATTRIBUTES_FIELD_NUMBER: _ClassVar[int]
    AXES_FIELD_NUMBER: _ClassVar[int]
    CAMPAIGN_FIELD_NUMBER: _ClassVar[int]
    QUANTITIES_FIELD_NUMBER: _ClassVar[int]
    REFERENCE_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    TITLE_FIELD_NUMBER: _ClassVar[int]
    attributes: _containers.MessageMap[str, AttributeValue]
    axes: _containers.RepeatedCompositeFieldContainer[TableAxis]
    campaign: str
    quantities: _containers.RepeatedCompositeFieldContainer[TableQuantity]
    reference: TableReference
    sea: _sea_pb2.SeaSummary
    title: str
    def __init__(self, reference: _Optional[_Union[TableReference, _Mapping]] = ..., title: _Optional[str] = ..., axes: _Optional[_Iterable[_Union[TableAxis, _Mapping]]] = ..., quantities: _Optional[_Iterable[_Union[TableQuantity, _Mapping]]] = ..., campaign: _Optional[str] = ..., attributes: _Optional[_Mapping[str, AttributeValue]] = ..., sea: _Optional[_Union[_sea_pb2.SeaSummary, _Mapping]] = ...) -> None: ...

class TableAxis(_message.Message):
    __slots__ = ["axis", "long_name", "name", "nodes", "scale", "units"]
    AXIS_FIELD_NUMBER: _ClassVar[int]
    LONG_NAME_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    NODES_FIELD_NUMBER: _ClassVar[int]
    SCALE_FIELD_NUMBER: _ClassVar[int]
    UNITS_FIELD_NUMBER: _ClassVar[int]
    axis: _pulse_pb2.Axis
    long_name: str
    name: str
    nodes: _containers.RepeatedScalarFieldContainer[float]
    scale: Scale
    units: str
    def __init__(self, axis: _Optional[_Union[_pulse_pb2.Axis, str]] = ..., name: _Optional[str] = ..., units: _Optional[str] = ..., long_name: _Optional[str] = ..., scale: _Optional[_Union[Scale, str]] = ..., nodes: _Optional[_Iterable[float]] = ...) -> None: ...

class TableQuantity(_message.Message):
    __slots__ = ["has_standard_error", "long_name", "name", "quantity", "scale", "units"]
    HAS_STANDARD_ERROR_FIELD_NUMBER: _ClassVar[int]
    LONG_NAME_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    QUANTITY_FIELD_NUMBER: _ClassVar[int]
    SCALE_FIELD_NUMBER: _ClassVar[int]
    UNITS_FIELD_NUMBER: _ClassVar[int]
    has_standard_error: bool
    long_name: str
    name: str
    quantity: _uncertainty_pb2.Quantity
    scale: Scale
    units: str
    def __init__(self, quantity: _Optional[_Union[_uncertainty_pb2.Quantity, str]] = ..., name: _Optional[str] = ..., units: _Optional[str] = ..., long_name: _Optional[str] = ..., scale: _Optional[_Union[Scale, str]] = ..., has_standard_error: bool = ...) -> None: ...

class TableReference(_message.Message):
    __slots__ = ["digest", "id", "name", "version"]
    DIGEST_FIELD_NUMBER: _ClassVar[int]
    ID_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    VERSION_FIELD_NUMBER: _ClassVar[int]
    digest: str
    id: str
    name: str
    version: str
    def __init__(self, name: _Optional[str] = ..., id: _Optional[str] = ..., version: _Optional[str] = ..., digest: _Optional[str] = ...) -> None: ...

class TableSummary(_message.Message):
    __slots__ = ["reference", "title"]
    REFERENCE_FIELD_NUMBER: _ClassVar[int]
    TITLE_FIELD_NUMBER: _ClassVar[int]
    reference: TableReference
    title: str
    def __init__(self, reference: _Optional[_Union[TableReference, _Mapping]] = ..., title: _Optional[str] = ...) -> None: ...

class Scale(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
