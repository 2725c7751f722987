"""Spectra of NDBC buoys: the twin of sea/files/ndbc_spectra.h, for one record.

In real time a line has pairs of a value and its frequency in parentheses; in the history the first line has the
frequencies, years may have two digits, minutes may be missing, and r2 is in hundredths. 999 is a missing value.
"""

from __future__ import annotations

import gzip
import os
import pathlib
import re
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .errors import ArgumentError
from .spectrum import Spectrum, buoy_spectrum

TRUSTED_UP_TO = 0.4  # Hz: above, the hull of a 3 m discus buoy hardly follows the waves.
RECORD_LENGTH = 1200.0  # s over which NDBC measures waves each hour.
_MISSING = 999.0


class _Row(NamedTuple):
    time: np.datetime64
    values: dict[float, float]  # By frequency in Hz, without missing ones.


def read_spectrum(path: str | os.PathLike[str], time: object) -> Spectrum:
    """The waves of the record at `time`, or of the last one. Raises ArgumentError."""
    path = pathlib.Path(path)
    rows = {row.time: row for row in reversed(list(_rows(path, "spec_1")))}  # Of equal times, the first one counts.
    rows = {row.time: row for row in rows.values() if len(row.values) >= 2}
    if not rows:
        raise ArgumentError(f"{path}: no record has energy; give another file")
    times = list(np.sort(list(rows)))
    row = rows[times[-1] if time is None else _known_time(path, time, times)]
    r2, alpha2 = (_beside(other, quantity, row.time) for other, quantity in _companions(path))
    frequencies, energy = list(row.values), list(row.values.values())
    nan = float("nan")
    try:
        return buoy_spectrum(frequencies, energy, [r2.get(f, nan) for f in frequencies],
                             [alpha2.get(f, nan) for f in frequencies], min(TRUSTED_UP_TO, frequencies[-1]),
                             RECORD_LENGTH)
    except ArgumentError as error:
        raise ArgumentError(f"{path}, {row.time}: {error}") from None


def _known_time(path: pathlib.Path, time: object, known: list[np.datetime64]) -> np.datetime64:
    text = time.removesuffix("Z") if isinstance(time, str) else time
    try:
        wanted = np.datetime64(text, "m")  # type: ignore[call-overload]
    except (TypeError, ValueError):
        raise ArgumentError(f"time is {time!r}: it should be like '2020-06-08T03:50Z'") from None
    if wanted in known:
        return wanted
    closest = min(known, key=lambda other: abs(other - wanted))
    raise ArgumentError(f"{path}: there is no record at {wanted}Z (they are from {known[0]}Z to {known[-1]}Z); the "
                        f"closest is at {closest}Z")


def _companions(path: pathlib.Path) -> tuple[tuple[pathlib.Path, str], tuple[pathlib.Path, str]]:
    """The files of r2 and alpha2 beside that of energy."""
    found = re.fullmatch(r"(.*)w(\d{4}.*)", path.name)
    if path.suffix == ".data_spec" or not found:
        return (path.with_suffix(".swr2"), "r2_1"), (path.with_suffix(".swdir2"), "alpha2_1")
    return tuple((path.with_name(letter.join(found.groups())), quantity)  # type: ignore[return-value]
                 for letter, quantity in (("k", "r2_1"), ("i", "alpha2_1")))


def _beside(path: pathlib.Path, quantity: str, time: np.datetime64) -> dict[float, float]:
    if not path.exists():
        return {}
    for row in _rows(path, quantity):
        if row.time == time:
            return row.values
    return {}


def _rows(path: pathlib.Path, quantity: str) -> Iterator[_Row]:
    try:
        with gzip.open(path, "rt") if path.suffix == ".gz" else open(path) as file:
            lines = [words for line in file if (words := line.split())]
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise ArgumentError(f"{path}: {getattr(error, 'strerror', None) or error}") from error
    header = lines[0] if lines else []
    if len(header) < 5 or header[0].lstrip("#") not in ("YY", "YYYY") or header[1:4] != ["MM", "DD", "hh"]:
        raise ArgumentError(f"{path}: its first line is not that of an NDBC file of spectra")
    real_time, date = "(freq_1)" in header, 5 if header[4] == "mm" else 4
    if real_time and quantity not in header:
        raise ArgumentError(f"{path}: its first line does not name {quantity}; give the .data_spec file, with .swr2 "
                            "and .swdir2 beside it")
    for number, words in enumerate(lines[1:], 2):
        if words[0].startswith("#"):
            continue
        try:
            if real_time:
                pairs = words[date + (quantity == "spec_1"):]  # Sep_Freq
                frequencies = [float(word[1:-1]) for word in pairs[1::2]]
                values = [float(word) for word in pairs[::2]]
            else:
                frequencies = [float(word) for word in header[date:]]
                values = [float(word) for word in words[date:]]
            yield _Row(_time(words, date), _present(frequencies, values, not real_time and quantity == "r2_1"))
        except (ValueError, IndexError):
            raise ArgumentError(f"{path}: line {number} does not match the first line; get another copy") from None


def _time(words: list[str], date: int) -> np.datetime64:
    year = f"19{words[0]}" if len(words[0]) == 2 else words[0]
    hour, minute = words[3], words[4] if date == 5 else "00"
    return np.datetime64(f"{year}-{words[1]:0>2}-{words[2]:0>2}T{hour:0>2}:{minute:0>2}", "m")


def _present(frequencies: list[float], values: list[float], hundredths: bool) -> dict[float, float]:
    if len(frequencies) != len(values) or any(b <= a for a, b in zip(frequencies, frequencies[1:])):
        raise ValueError
    return {f: value / 100 if hundredths else value for f, value in zip(frequencies, values) if value != _MISSING}
