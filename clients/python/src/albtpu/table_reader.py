"""Reads axes and values from the bytes of a table file and checks the rules of tables/FORMAT.md.

Unlike the C++ reader, it does not recompute the content digest and does not check the chunks before HDF5 inflates
them. The seal excludes accidental changes to either.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import struct
from collections.abc import Iterator
from typing import Any, NamedTuple

import h5py
import numpy as np

from .errors import TableFileError
from .schema import BIASES, KINDS, QUANTITIES, REFRACTIONS, SCALES, SEA_SURFACE, STANDARD_ERROR, Floats
from .tables import AttributeValue, Axis, Quantity, Table, TableReference

# The user block, which detects damage to any byte.
MAGIC = b"\x89ALBTPU\n"
_HEAD = struct.Struct("<8sI4xQ32s")  # Magic, format version, length of the file, SHA-256 of all other bytes.
_DIGEST_BEGIN, _DIGEST_END = 24, 56
_SIZE = 512
_FORMAT_VERSION = 1
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


def check_seal(file: bytes) -> None:
    """Raises TableFileError unless `file` is a sealed table. The text is to follow the name of the file."""
    if not file:
        raise TableFileError("is empty: not a table")
    if file[:len(MAGIC)] != MAGIC[:len(file)]:
        if file.startswith(b"\x89HDF\r\n\x1a\n"):
            raise TableFileError("is an HDF5 file without the seal of albtpu: not a table, or its first 512 "
                                 "bytes are lost")
        raise TableFileError("is not a table of albtpu: it does not begin with its seal")
    if len(file) < _SIZE:
        raise TableFileError(f"is truncated: it has {len(file)} bytes, a table has more than {_SIZE}")
    _, version, length, digest = _HEAD.unpack_from(file)
    if version != _FORMAT_VERSION:
        raise TableFileError(f"has format version {version}: this package reads version {_FORMAT_VERSION}")
    if len(file) < length:
        raise TableFileError(f"is truncated: it has {len(file)} of {length} bytes")
    if len(file) > length:
        raise TableFileError(f"is damaged: it has {len(file)} bytes, according to its seal {length}")
    sha = hashlib.sha256(file[:_DIGEST_BEGIN])
    sha.update(memoryview(file)[_DIGEST_END:])
    if sha.digest() != digest:
        raise TableFileError("is damaged: the SHA-256 of its bytes is not that of its seal")


def read_table(name: str, file: bytes) -> TableContent:
    """Reads the table in `file`. Raises TableFileError, whose text is to follow the name of the file."""
    with open_sealed(file) as opened:
        return read_content(name, opened)


@contextlib.contextmanager
def errors_naming(file: object) -> Iterator[None]:
    """Errors inside the `with` statement become TableFileErrors that begin with the name of the file."""
    try:
        yield
    except (OSError, TableFileError) as error:
        raise TableFileError(f"{file}: {getattr(error, 'strerror', None) or error}") from error


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
    axes = {axis: _read_axis(file, axis, kind) for axis in KINDS[kind].axes}
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
    if kind not in KINDS:
        expected = " or ".join(f"'{known}'" for known in KINDS)
        raise TableFileError(f"is a table of kind '{kind}': expected kind {expected}")
    return kind


def _read_axis(file: h5py.File, axis: str, kind: str) -> Axis:
    description = KINDS[kind].axes[axis]
    nodes = _floats(file, "axis", axis, description.units)
    if nodes.ndim != 1 or not 0 < nodes.size <= _MOST_NODES:
        raise TableFileError(f"axis '{axis}' has the shape {nodes.shape}: it should have one dimension, and "
                             f"1 to {_MOST_NODES} nodes")
    largest = KINDS[kind].greatest_azimuth if axis == "azimuth" else _GREATEST_NODE
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
    if scale not in SCALES[1:]:
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
