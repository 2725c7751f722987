"""Reads axes and values from the bytes of a table file and checks the rules of tables/FORMAT.md.

Unlike the C++ reader, it does not recompute the content digest and does not check the chunks before HDF5 inflates
them. The seal excludes accidental changes to either.
"""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from typing import Any, NamedTuple

import h5py
import numpy as np
from numpy.typing import NDArray

from .errors import TableFileError
from .schema import (AXES_OF_KIND, BIASES, GREATEST_AZIMUTH, QUANTITIES, REFRACTIONS, SEA_SURFACE,
                     STANDARD_ERROR)
from .seal import check_seal
from .tables import AttributeValue, Axis, Quantity, Table, TableReference

Floats = NDArray[np.float32]
# Limits of tables/FORMAT.md.
_MOST_VALUES, _MOST_NODES, _LEAST_DISTANCE, _GREATEST_NODE, _GREATEST_VALUE = 2**28, 65536, 1e-6, 1e9, 1e6
_FILTERS = {h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_FLETCHER32}
_KIND = "table_kind"
_RESERVED = ("Conventions", "id", "version", "title", "coverage", "content_digest", "campaign", _KIND)


class TableContent(NamedTuple):
    """A table with its values."""

    table: Table
    values: dict[str, Floats]  # By quantity; dimensions in the order of the axes, without depth for refraction.
    standard_errors: dict[str, Floats]  # By quantity; only those that the table has.


def read_table(name: str, file: bytes) -> TableContent:
    """Reads the table in `file`. Raises TableFileError, whose text is to follow the name of the file."""
    with open_sealed(file) as opened:
        return read_content(name, opened)


@contextlib.contextmanager
def open_sealed(file: bytes) -> Iterator[h5py.File]:
    """Opens `file` after checking its seal. Errors of HDF5 inside the `with` statement become TableFileErrors."""
    check_seal(file)
    try:
        with h5py.File(io.BytesIO(file)) as opened:  # The same bytes whose seal was checked.
            yield opened
    except (OSError, KeyError) as error:
        raise TableFileError(f"is sealed, but cannot be read as HDF5: {error}") from error


def read_content(name: str, file: h5py.File) -> TableContent:
    """Reads a table from an open file. Raises TableFileError."""
    kind = _read_kind(file)
    if (coverage := _text(file, "coverage")) != "2 sigma":
        raise TableFileError(f"attribute 'coverage' is '{coverage}': it should be '2 sigma'")
    axes = {axis: _read_axis(file, axis, kind) for axis in AXES_OF_KIND[kind]}
    values, standard_errors, quantities = {}, {}, {}
    for quantity, (units, long_name) in QUANTITIES.items():
        if not _has(file, quantity):
            if quantity in BIASES:
                continue
            raise TableFileError(f"variable '{quantity}' is missing")
        values[quantity] = _read_values(file, quantity, quantity, axes)
        scale = _scale(file[quantity], "variable", quantity, values[quantity])
        if _has(file, errors := quantity + STANDARD_ERROR):
            standard_errors[quantity] = _read_values(file, errors, quantity, axes)
        quantities[quantity] = Quantity(units, long_name, scale, quantity in standard_errors)
    reference = TableReference(name, _text(file, "id"), _text(file, "version"), _text(file, "content_digest"))
    attributes = {key: plain_attribute(value) for key, value in sorted(file.attrs.items()) if key not in _RESERVED}
    table = Table(reference, _text(file, "title"), axes, quantities, _text(file, "campaign"), attributes, kind)
    return TableContent(table, values, standard_errors)


def _read_kind(file: h5py.File) -> str:
    """Refuses kinds of tables that are not known. Tables of the sea surface never name their kind."""
    if _KIND not in file.attrs:
        return SEA_SURFACE
    kind = _text(file, _KIND)
    if kind == SEA_SURFACE:
        raise TableFileError(f"attribute '{_KIND}' is '{kind}': files of that kind do not have it")
    if kind not in AXES_OF_KIND:
        expected = " or ".join(f"'{known}'" for known in AXES_OF_KIND)
        raise TableFileError(f"is a table of kind '{kind}': expected kind {expected}")
    return kind


def _read_axis(file: h5py.File, axis: str, kind: str) -> Axis:
    description = AXES_OF_KIND[kind][axis]
    nodes = _floats(file, "axis", axis, description.units)
    if nodes.ndim != 1 or not 0 < nodes.size <= _MOST_NODES:
        raise TableFileError(f"axis '{axis}' has the shape {nodes.shape}: it should have one dimension, and "
                             f"1 to {_MOST_NODES} nodes")
    largest = GREATEST_AZIMUTH[kind] if axis == "azimuth" else _GREATEST_NODE
    increase = bool((np.diff(nodes.astype(float)) >= _LEAST_DISTANCE).all())
    if not (nodes[0] >= 0 and nodes[-1] <= largest and increase):
        raise TableFileError(f"axis '{axis}' has nodes that are not finite, are negative, do not increase, "
                             f"or are above {largest:g}")
    return Axis(nodes, *description, _scale(file[axis], "axis", axis, nodes))


def _read_values(file: h5py.File, name: str, quantity: str, axes: dict[str, Axis]) -> Floats:
    values = _floats(file, "variable", name, QUANTITIES[quantity].units)
    expected = tuple(axis.nodes.size for axis in axes.values())
    expected = expected[:-1] if quantity in REFRACTIONS else expected
    if values.shape != expected:
        raise TableFileError(f"variable '{name}' has the shape {values.shape}: its axes have {expected}")
    if not (np.abs(values) <= _GREATEST_VALUE).all() or (name not in BIASES and (values < 0).any()):
        raise TableFileError(f"variable '{name}' has values that are not finite, above "
                             f"{_GREATEST_VALUE:g}, or negative")
    return values


def _has(file: h5py.File, name: str) -> bool:
    """Unlike `in`, does not follow links, which may lead to other files."""
    return bool(file.id.links.exists(name.encode()))


def _floats(file: h5py.File, kind: str, name: str, units: str) -> Floats:
    if not _has(file, name):
        raise TableFileError(f"{kind} '{name}' is missing")
    if file.id.links.get_info(name.encode()).type != h5py.h5l.TYPE_HARD:
        raise TableFileError(f"{kind} '{name}' is a link: it should be a dataset of this file")
    dataset = file.get(name)
    if not isinstance(dataset, h5py.Dataset) or dataset.dtype != np.dtype("<f4"):
        raise TableFileError(f"{kind} '{name}' is not a dataset of float32")
    creation = dataset.id.get_create_plist()
    if creation.get_external_count() or creation.get_layout() == h5py.h5d.VIRTUAL:
        raise TableFileError(f"{kind} '{name}' has its values in other files: they should be in this one")
    if not _FILTERS.issuperset(creation.get_filter(i)[0] for i in range(creation.get_nfilters())):
        raise TableFileError(f"{kind} '{name}' has filters other than shuffle and deflate")
    if dataset.size > _MOST_VALUES:
        raise TableFileError(f"{kind} '{name}' has {dataset.size} values: at most {_MOST_VALUES} are allowed")
    if (found := _text(dataset, "units")) != units:
        raise TableFileError(f"{kind} '{name}' is in '{found}': it should be in '{units}'")
    values: Floats = dataset[()]
    return values


def _scale(dataset: h5py.Dataset, kind: str, name: str, values: Floats) -> str:
    scale = _text(dataset, "interpolation")
    if scale not in ("linear", "log"):
        raise TableFileError(f"{kind} '{name}' has interpolation '{scale}': it should be 'linear' or 'log'")
    if scale == "log" and not (values > 0).all():
        raise TableFileError(f"{kind} '{name}' is on a log scale and not positive everywhere")
    return scale


def _text(of: h5py.HLObject, attribute: str) -> str:
    if attribute not in of.attrs:
        raise TableFileError(f"attribute '{attribute}' of '{of.name}' is missing")
    value = plain_attribute(of.attrs[attribute])
    if not isinstance(value, str):
        raise TableFileError(f"attribute '{attribute}' of '{of.name}' is a number: it should be text")
    return value


def plain_attribute(value: Any) -> AttributeValue:
    if isinstance(value, h5py.Empty):
        return ""
    if isinstance(value, bytes):
        return value.decode()
    return value.tolist() if hasattr(value, "tolist") else value
