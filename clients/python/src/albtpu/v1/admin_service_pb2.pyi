from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor
TABLE_CHANGE_KEPT: TableChange
TABLE_CHANGE_LOADED: TableChange
TABLE_CHANGE_REMOVED: TableChange
TABLE_CHANGE_UNSPECIFIED: TableChange

class ReloadTablesRequest(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class ReloadTablesResponse(_message.Message):
    __slots__ = ["tables"]
    TABLES_FIELD_NUMBER: _ClassVar[int]
    tables: _containers.RepeatedCompositeFieldContainer[ReloadedTable]
    def __init__(self, tables: _Optional[_Iterable[_Union[ReloadedTable, _Mapping]]] = ...) -> None: ...

class ReloadedTable(_message.Message):
    __slots__ = ["change", "name"]
    CHANGE_FIELD_NUMBER: _ClassVar[int]
    NAME_FIELD_NUMBER: _ClassVar[int]
    change: TableChange
    name: str
    def __init__(self, name: _Optional[str] = ..., change: _Optional[_Union[TableChange, str]] = ...) -> None: ...

class TableChange(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = []
