"""Answers from a table file, without a service."""

from __future__ import annotations

import os
import pathlib

from .errors import ArgumentError, TableFileError
from .progress import Progress
from .query import Query
from .schema import ONE_SEA
from .source import UncertaintySource
from .table_answers import TableAnswers
from .table_reader import read_table
from .tables import Answered, SeaSummary, Table
from .uncertainties import AnswerColumns

_BLOCK = 16384  # Pulses. The intermediate results of one block fit in the processor's cache.


def open_table(path: str | os.PathLike[str]) -> TableFile:
    """Reads a table file into memory and checks its seal.

    Raises TableFileError, which says what is wrong with the file.

    >>> with open_table("survey.h5") as table:
    ...     table.table().axes["depth"].nodes[-1]
    60.0
    """
    path = pathlib.Path(path)
    try:
        return TableFile(path.stem, path.read_bytes())
    except OSError as error:
        raise TableFileError(f"{path}: {error.strerror or error}") from error
    except TableFileError as error:
        raise TableFileError(f"{path}: {error}") from error


class TableFile(UncertaintySource):
    """A table in memory. Outcomes are those of a service, values agree within 1e-5.

    Interpolates in double precision, some hundred thousand pulses per second, more if few axes vary. A service
    answers millions per second.
    """

    def __init__(self, name: str, file: bytes) -> None:
        self._file, self._content = file, read_table(name, file)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file of the table, which `open_table`, albtpu-query and albtpu-serve read. Not over another."""
        path = pathlib.Path(path)
        try:
            with path.open("xb") as file:
                file.write(self._file)
        except OSError as error:
            raise TableFileError(f"{path}: {error.strerror or error}") from error

    def table(self, name: str | None = None) -> Table:
        self._check_name(name)
        return self._content.table

    def _answer(self, query: Query, columns: AnswerColumns, progress: Progress) -> Answered:
        self._check_name(query.table)
        if query.sea is not None:
            raise ArgumentError("a table file cannot compute the table of a sea: query a service with 'sea', or make a "
                                "table of it with sea.compile(service)")
        answers = TableAnswers(self._content, query)
        for begin in range(0, query.size, _BLOCK):
            end = min(begin + _BLOCK, query.size)
            answers.fill(columns, begin, end)
            progress(end - begin)
        table = self._content.table
        return Answered(table.reference, SeaSummary.of_attributes(table.attributes) if self._has_one_sea() else None)

    def _has_one_sea(self) -> bool:
        return self._content.table.kind == ONE_SEA

    def _check_name(self, name: str | None) -> None:
        if name not in (None, reference := self._content.table.reference.name):
            raise ArgumentError(f"the file contains only the table '{reference}': omit table='{name}'")
