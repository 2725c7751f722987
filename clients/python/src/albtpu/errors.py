"""Errors that concern a query as a whole. A problem with a single pulse is its outcome, not an error."""


class Error(Exception):
    """Any failure of this package. Its text says what is wrong, where, and what is expected."""


class ArgumentError(Error, ValueError):
    """Invalid arguments of a query: an unknown name, an array of text, shapes that do not broadcast."""


class TableFileError(Error, ValueError):
    """A file is missing, is not a table, is damaged, or violates the format."""


class ServiceError(Error):
    """The server refused the query, or its answer is invalid.

    `code` is the name of the gRPC status, for example "RESOURCE_EXHAUSTED", or empty if there was none.
    """

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(message)
        self.code = code


class TableNotFoundError(ServiceError, LookupError):
    """The server has no table of that name, or no name was given and it has no default table."""


class UnreachableError(ServiceError, ConnectionError):
    """The server could not be reached or stopped answering, and did not recover within the time allowed."""


class TableChangedError(ServiceError):
    """The server replaced the table by a different one during the query. No answer mixes two tables."""
