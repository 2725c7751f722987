"""Per-pulse uncertainty of airborne lidar bathymetry: what the sea surface does to each pulse of a survey.

    import albtpu
    with albtpu.connect("localhost:50051") as service:          # or albtpu.open_table("survey.h5")
        answer = service.query(wind_speed=5, incidence=theta, footprint=0.5, depth=d)
    answer.thu, answer.tvu, answer.outcome, answer.units, answer.table.digest

`help(albtpu.UncertaintySource.query)` has all that can be asked, `help(albtpu.Uncertainties)` what is
answered.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import (ArgumentError, Error, ServiceError, TableChangedError, TableFileError,
                     TableNotFoundError, UnreachableError)
from .schema import AXES, QUANTITIES
from .source import UncertaintySource
from .tables import Axis, Quantity, Table, TableReference, TableSummary
from .uncertainties import Uncertainties

if TYPE_CHECKING:
    from .service import Service, connect
    from .table_file import TableFile, open_table

__version__ = "0.1.0"
__all__ = ["AXES", "ArgumentError", "Axis", "Error", "QUANTITIES", "Quantity", "Service", "ServiceError",
           "Table", "TableChangedError", "TableFile", "TableFileError", "TableNotFoundError",
           "TableReference", "TableSummary", "Uncertainties", "UncertaintySource", "UnreachableError",
           "connect", "open_table"]

# Loaded when they are used: files want no gRPC, services no HDF5.
_LATER = {"Service": ".service", "connect": ".service",
          "TableFile": ".table_file", "open_table": ".table_file"}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module 'albtpu' has no attribute '{name}'")
    return getattr(import_module(_LATER[name], __name__), name)
