"""Lets xarray.open_dataset open table files. xarray loads this module through the entry point in pyproject.toml.

The package's own reader opens the file, rather than netCDF4 or h5netcdf: it needs only h5py, which the package depends
on anyway, and the values come from the same bytes whose seal was checked.
"""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable
from typing import Any

import h5py
import numpy as np
import xarray
from xarray.backends import BackendEntrypoint

from .schema import AXES, QUANTITIES, REFRACTIONS, STANDARD_ERROR
from .table_reader import MAGIC, TableContent, errors_naming, open_sealed, plain_attribute, read_content

# Attributes that describe the HDF5 storage. Readers of netCDF hide them, too.
_HIDDEN = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST", "_FillValue"}


class AlbtpuBackendEntrypoint(BackendEntrypoint):
    """Opens a table file of albtpu: checks its seal and reads all of it into memory.

    engine="netcdf4" gives the same dataset without checking the seal.
    """

    description = "Open table files of albtpu, after checking their seal"
    open_dataset_parameters = ("filename_or_obj", "drop_variables", "mask_and_scale", "decode_times",
                               "decode_timedelta", "use_cftime", "concat_characters", "decode_coords")

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        """Whether the file begins with the seal of a table. The extension .h5 says nothing: all HDF5 files have it."""
        try:
            if isinstance(filename_or_obj, (str, os.PathLike)):
                with open(filename_or_obj, "rb") as file:
                    return file.read(len(MAGIC)) == MAGIC
            return _peek(filename_or_obj) == MAGIC
        except (OSError, AttributeError, TypeError, ValueError):  # Not a local file, not a file, or a closed one.
            return False

    def open_dataset(  # type: ignore[override]  # xarray asks for named options, so that it can refuse others.
            self, filename_or_obj: Any, *, drop_variables: str | Iterable[str] | None = None,
            mask_and_scale: bool | None = None, decode_times: bool | None = None,
            decode_timedelta: bool | None = None, use_cftime: bool | None = None,
            concat_characters: bool | None = None, decode_coords: bool | str | None = None) -> xarray.Dataset:
        """The table as a dataset over its six axes. Raises TableFileError.

        The decoding options have no effect: a table has no times, packed values or arrays of characters.
        """
        dropped = {drop_variables} if isinstance(drop_variables, str) else set(drop_variables or ())
        with errors_naming(filename_or_obj):
            if isinstance(filename_or_obj, (str, os.PathLike)):
                path = pathlib.Path(filename_or_obj)
                name, file = path.stem, path.read_bytes()
            else:
                filename_or_obj.seek(0)
                name, file = "table", filename_or_obj.read()
            with open_sealed(file) as opened:
                dataset = _dataset(read_content(name, opened), opened)
        return dataset.drop_vars(dropped, errors="ignore")


def _peek(file: Any) -> bytes:
    begin = file.tell()
    head: bytes = file.read(len(MAGIC))
    file.seek(begin)
    return head


def _dataset(content: TableContent, file: h5py.File) -> xarray.Dataset:
    coordinates = {axis: (axis, content.table.axes[axis].nodes, _attributes(file[axis])) for axis in AXES}
    variables = {}
    for quantity in QUANTITIES:
        dimensions = tuple(AXES)[:-1] if quantity in REFRACTIONS else tuple(AXES)
        for name, values in ((quantity, content.values.get(quantity)),
                             (quantity + STANDARD_ERROR, content.standard_errors.get(quantity))):
            if values is not None:
                variables[name] = (dimensions, values, _attributes(file[name]))
    return xarray.Dataset(variables, coordinates, _attributes(file))


def _attributes(of: h5py.HLObject) -> dict[str, Any]:
    """Text, a number or an array of numbers, as readers of netCDF return them."""
    attributes = {name: plain_attribute(value) for name, value in of.attrs.items() if name not in _HIDDEN}
    return {name: np.array(value) if isinstance(value, list) else value for name, value in attributes.items()}
