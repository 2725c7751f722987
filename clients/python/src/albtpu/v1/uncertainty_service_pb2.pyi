from albtpu.v1 import budget_pb2 as _budget_pb2
from albtpu.v1 import pulse_pb2 as _pulse_pb2
from albtpu.v1 import sea_pb2 as _sea_pb2
from albtpu.v1 import table_pb2 as _table_pb2
from albtpu.v1 import uncertainty_pb2 as _uncertainty_pb2
from albtpu.v1 import water_pb2 as _water_pb2
from google.protobuf.internal import containers as _containers
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from typing import ClassVar as _ClassVar, Iterable as _Iterable, Mapping as _Mapping, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class CompileSeaRequest(_message.Message):
    __slots__ = ["correlation", "refractive_index", "sea", "with_file"]
    CORRELATION_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    WITH_FILE_FIELD_NUMBER: _ClassVar[int]
    correlation: _sea_pb2.CorrelationQuery
    refractive_index: float
    sea: _sea_pb2.SeaState
    with_file: bool
    def __init__(self, sea: _Optional[_Union[_sea_pb2.SeaState, _Mapping]] = ..., with_file: bool = ..., correlation: _Optional[_Union[_sea_pb2.CorrelationQuery, _Mapping]] = ..., refractive_index: _Optional[float] = ...) -> None: ...

class CompileSeaResponse(_message.Message):
    __slots__ = ["correlation", "file", "table"]
    CORRELATION_FIELD_NUMBER: _ClassVar[int]
    FILE_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    correlation: _sea_pb2.SeaCorrelation
    file: bytes
    table: _table_pb2.Table
    def __init__(self, table: _Optional[_Union[_table_pb2.Table, _Mapping]] = ..., file: _Optional[bytes] = ..., correlation: _Optional[_Union[_sea_pb2.SeaCorrelation, _Mapping]] = ...) -> None: ...

class GetTableRequest(_message.Message):
    __slots__ = ["table"]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    table: str
    def __init__(self, table: _Optional[str] = ...) -> None: ...

class GetTableResponse(_message.Message):
    __slots__ = ["table"]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    table: _table_pb2.Table
    def __init__(self, table: _Optional[_Union[_table_pb2.Table, _Mapping]] = ...) -> None: ...

class ListTablesRequest(_message.Message):
    __slots__ = []
    def __init__(self) -> None: ...

class ListTablesResponse(_message.Message):
    __slots__ = ["default_table", "tables"]
    DEFAULT_TABLE_FIELD_NUMBER: _ClassVar[int]
    TABLES_FIELD_NUMBER: _ClassVar[int]
    default_table: str
    tables: _containers.RepeatedCompositeFieldContainer[_table_pb2.TableSummary]
    def __init__(self, tables: _Optional[_Iterable[_Union[_table_pb2.TableSummary, _Mapping]]] = ..., default_table: _Optional[str] = ...) -> None: ...

class QueryBudgetRequest(_message.Message):
    __slots__ = ["aircraft", "options", "pulses", "quantities", "sea", "water"]
    AIRCRAFT_FIELD_NUMBER: _ClassVar[int]
    OPTIONS_FIELD_NUMBER: _ClassVar[int]
    PULSES_FIELD_NUMBER: _ClassVar[int]
    QUANTITIES_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    WATER_FIELD_NUMBER: _ClassVar[int]
    aircraft: _budget_pb2.AircraftColumns
    options: _budget_pb2.BudgetOptions
    pulses: _pulse_pb2.PulseColumns
    quantities: _containers.RepeatedScalarFieldContainer[_budget_pb2.BudgetQuantity]
    sea: _sea_pb2.SeaState
    water: _water_pb2.WaterState
    def __init__(self, options: _Optional[_Union[_budget_pb2.BudgetOptions, _Mapping]] = ..., pulses: _Optional[_Union[_pulse_pb2.PulseColumns, _Mapping]] = ..., aircraft: _Optional[_Union[_budget_pb2.AircraftColumns, _Mapping]] = ..., quantities: _Optional[_Iterable[_Union[_budget_pb2.BudgetQuantity, str]]] = ..., sea: _Optional[_Union[_sea_pb2.SeaState, _Mapping]] = ..., water: _Optional[_Union[_water_pb2.WaterState, _Mapping]] = ...) -> None: ...

class QueryBudgetResponse(_message.Message):
    __slots__ = ["azimuth_absent", "budget", "coverage", "outcome_axes", "outcomes", "pulse_count", "refractive_index", "sea", "table", "water"]
    AZIMUTH_ABSENT_FIELD_NUMBER: _ClassVar[int]
    BUDGET_FIELD_NUMBER: _ClassVar[int]
    COVERAGE_FIELD_NUMBER: _ClassVar[int]
    OUTCOMES_FIELD_NUMBER: _ClassVar[int]
    OUTCOME_AXES_FIELD_NUMBER: _ClassVar[int]
    PULSE_COUNT_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    WATER_FIELD_NUMBER: _ClassVar[int]
    azimuth_absent: bool
    budget: _budget_pb2.BudgetColumns
    coverage: _uncertainty_pb2.Coverage
    outcome_axes: bytes
    outcomes: bytes
    pulse_count: int
    refractive_index: float
    sea: _sea_pb2.SeaSummary
    table: _table_pb2.TableReference
    water: _water_pb2.WaterSummary
    def __init__(self, table: _Optional[_Union[_table_pb2.TableReference, _Mapping]] = ..., coverage: _Optional[_Union[_uncertainty_pb2.Coverage, str]] = ..., pulse_count: _Optional[int] = ..., outcomes: _Optional[bytes] = ..., outcome_axes: _Optional[bytes] = ..., azimuth_absent: bool = ..., budget: _Optional[_Union[_budget_pb2.BudgetColumns, _Mapping]] = ..., sea: _Optional[_Union[_sea_pb2.SeaSummary, _Mapping]] = ..., refractive_index: _Optional[float] = ..., water: _Optional[_Union[_water_pb2.WaterSummary, _Mapping]] = ...) -> None: ...

class QueryColumnsRequest(_message.Message):
    __slots__ = ["options", "pulses", "quantities", "sea"]
    OPTIONS_FIELD_NUMBER: _ClassVar[int]
    PULSES_FIELD_NUMBER: _ClassVar[int]
    QUANTITIES_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    options: QueryOptions
    pulses: _pulse_pb2.PulseColumns
    quantities: _containers.RepeatedScalarFieldContainer[_uncertainty_pb2.Quantity]
    sea: _sea_pb2.SeaState
    def __init__(self, options: _Optional[_Union[QueryOptions, _Mapping]] = ..., pulses: _Optional[_Union[_pulse_pb2.PulseColumns, _Mapping]] = ..., quantities: _Optional[_Iterable[_Union[_uncertainty_pb2.Quantity, str]]] = ..., sea: _Optional[_Union[_sea_pb2.SeaState, _Mapping]] = ...) -> None: ...

class QueryColumnsResponse(_message.Message):
    __slots__ = ["azimuth_absent", "coverage", "outcome_axes", "outcomes", "pulse_count", "refractive_index", "s44", "sea", "sea_surface", "sea_surface_standard_error", "table"]
    AZIMUTH_ABSENT_FIELD_NUMBER: _ClassVar[int]
    COVERAGE_FIELD_NUMBER: _ClassVar[int]
    OUTCOMES_FIELD_NUMBER: _ClassVar[int]
    OUTCOME_AXES_FIELD_NUMBER: _ClassVar[int]
    PULSE_COUNT_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    S44_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    SEA_SURFACE_FIELD_NUMBER: _ClassVar[int]
    SEA_SURFACE_STANDARD_ERROR_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    azimuth_absent: bool
    coverage: _uncertainty_pb2.Coverage
    outcome_axes: bytes
    outcomes: bytes
    pulse_count: int
    refractive_index: float
    s44: _uncertainty_pb2.S44Columns
    sea: _sea_pb2.SeaSummary
    sea_surface: _uncertainty_pb2.SeaSurfaceColumns
    sea_surface_standard_error: _uncertainty_pb2.SeaSurfaceColumns
    table: _table_pb2.TableReference
    def __init__(self, table: _Optional[_Union[_table_pb2.TableReference, _Mapping]] = ..., coverage: _Optional[_Union[_uncertainty_pb2.Coverage, str]] = ..., pulse_count: _Optional[int] = ..., outcomes: _Optional[bytes] = ..., outcome_axes: _Optional[bytes] = ..., azimuth_absent: bool = ..., sea_surface: _Optional[_Union[_uncertainty_pb2.SeaSurfaceColumns, _Mapping]] = ..., sea_surface_standard_error: _Optional[_Union[_uncertainty_pb2.SeaSurfaceColumns, _Mapping]] = ..., s44: _Optional[_Union[_uncertainty_pb2.S44Columns, _Mapping]] = ..., sea: _Optional[_Union[_sea_pb2.SeaSummary, _Mapping]] = ..., refractive_index: _Optional[float] = ...) -> None: ...

class QueryOptions(_message.Message):
    __slots__ = ["best_s44_order", "coverage", "refractive_index", "s44_order", "standard_errors", "table"]
    BEST_S44_ORDER_FIELD_NUMBER: _ClassVar[int]
    COVERAGE_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    S44_ORDER_FIELD_NUMBER: _ClassVar[int]
    STANDARD_ERRORS_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    best_s44_order: bool
    coverage: _uncertainty_pb2.Coverage
    refractive_index: float
    s44_order: _uncertainty_pb2.S44Order
    standard_errors: bool
    table: str
    def __init__(self, table: _Optional[str] = ..., coverage: _Optional[_Union[_uncertainty_pb2.Coverage, str]] = ..., standard_errors: bool = ..., best_s44_order: bool = ..., s44_order: _Optional[_Union[_uncertainty_pb2.S44Order, str]] = ..., refractive_index: _Optional[float] = ...) -> None: ...

class QueryPulsesRequest(_message.Message):
    __slots__ = ["options", "pulses", "sea"]
    OPTIONS_FIELD_NUMBER: _ClassVar[int]
    PULSES_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    options: QueryOptions
    pulses: _containers.RepeatedCompositeFieldContainer[_pulse_pb2.Pulse]
    sea: _sea_pb2.SeaState
    def __init__(self, options: _Optional[_Union[QueryOptions, _Mapping]] = ..., pulses: _Optional[_Iterable[_Union[_pulse_pb2.Pulse, _Mapping]]] = ..., sea: _Optional[_Union[_sea_pb2.SeaState, _Mapping]] = ...) -> None: ...

class QueryPulsesResponse(_message.Message):
    __slots__ = ["coverage", "refractive_index", "sea", "table", "uncertainties"]
    COVERAGE_FIELD_NUMBER: _ClassVar[int]
    REFRACTIVE_INDEX_FIELD_NUMBER: _ClassVar[int]
    SEA_FIELD_NUMBER: _ClassVar[int]
    TABLE_FIELD_NUMBER: _ClassVar[int]
    UNCERTAINTIES_FIELD_NUMBER: _ClassVar[int]
    coverage: _uncertainty_pb2.Coverage
    refractive_index: float
    sea: _sea_pb2.SeaSummary
    table: _table_pb2.TableReference
    uncertainties: _containers.RepeatedCompositeFieldContainer[_uncertainty_pb2.PulseUncertainty]
    def __init__(self, table: _Optional[_Union[_table_pb2.TableReference, _Mapping]] = ..., coverage: _Optional[_Union[_uncertainty_pb2.Coverage, str]] = ..., uncertainties: _Optional[_Iterable[_Union[_uncertainty_pb2.PulseUncertainty, _Mapping]]] = ..., sea: _Optional[_Union[_sea_pb2.SeaSummary, _Mapping]] = ..., refractive_index: _Optional[float] = ...) -> None: ...

class StreamColumnsRequest(_message.Message):
    __slots__ = ["query"]
    QUERY_FIELD_NUMBER: _ClassVar[int]
    query: QueryColumnsRequest
    def __init__(self, query: _Optional[_Union[QueryColumnsRequest, _Mapping]] = ...) -> None: ...

class StreamColumnsResponse(_message.Message):
    __slots__ = ["answer"]
    ANSWER_FIELD_NUMBER: _ClassVar[int]
    answer: QueryColumnsResponse
    def __init__(self, answer: _Optional[_Union[QueryColumnsResponse, _Mapping]] = ...) -> None: ...
