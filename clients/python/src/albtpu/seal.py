"""The user block of a table file, which detects damage to any byte (tables/FORMAT.md)."""

from __future__ import annotations

import hashlib
import struct

from .errors import TableFileError

MAGIC = b"\x89ALBTPU\n"
_HEAD = struct.Struct("<8sI4xQ32s")  # Magic, format version, length of the file, SHA-256 of all other bytes.
_DIGEST_BEGIN, _DIGEST_END = 24, 56
_SIZE = 512
_FORMAT_VERSION = 1


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
