"""Per-pulse uncertainty of airborne lidar bathymetry: the contribution of the sea surface to THU and TVU.

    import albtpu
    with albtpu.connect("localhost:50051") as service:          # or albtpu.open_table("survey.h5")
        answer = service.query(wind_speed=5, incidence=theta, footprint=0.5, depth=d)
    answer.thu, answer.tvu, answer.outcome, answer.units, answer.table.digest

`help(albtpu.UncertaintySource.query)` documents the arguments of a query, `help(albtpu.Uncertainties)` its answer.
`albtpu.geometry` finds incidence, azimuth and footprint from the positions of sensor and points.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import (ArgumentError, Error, ServiceError, TableChangedError, TableFileError,
                     TableNotFoundError, UnreachableError)
from .schema import AXES, QUANTITIES
from .sea import Correlation, Sea
from .source import UncertaintySource
from .tables import Axis, Quantity, SeaSummary, Table, TableReference, TableSummary, WaterSummary
from .uncertainties import Uncertainties
from .water import Water

if TYPE_CHECKING:
    from . import geometry
    from .budget import BUDGET_QUANTITIES
    from .service import Service, connect
    from .table_file import TableFile, open_table

__version__ = "1.0.0"
__all__ = ["AXES", "ArgumentError", "Axis", "BUDGET_QUANTITIES", "Correlation", "Error",
           "QUANTITIES", "Quantity", "Sea", "SeaSummary", "Service",
           "ServiceError", "Table", "TableChangedError", "TableFile", "TableFileError", "TableNotFoundError",
           "TableReference", "TableSummary", "Uncertainties", "UncertaintySource", "UnreachableError", "Water",
           "WaterSummary", "connect", "geometry", "open_table"]

# Imported on first use: table files do not need gRPC and protobuf, and services do not need HDF5. pip installs neither
# unless asked.
_LATER = {"BUDGET_QUANTITIES": ".budget", "Service": ".service", "connect": ".service",
          "TableFile": ".table_file", "open_table": ".table_file"}


def __getattr__(name: str) -> Any:
    if name == "geometry":
        return import_module(".geometry", __name__)
    if name not in _LATER:
        raise AttributeError(f"module 'albtpu' has no attribute '{name}'")
    try:
        return getattr(import_module(_LATER[name], __name__), name)
    except ModuleNotFoundError as error:
        extra = {"grpc": "client", "google": "client", "h5py": "tables"}.get((error.name or "").split(".")[0])
        if extra is None:
            raise
        raise ModuleNotFoundError(f"albtpu.{name} needs {error.name}, which is missing; pip install 'albtpu[{extra}]'",
                                  name=error.name) from error
