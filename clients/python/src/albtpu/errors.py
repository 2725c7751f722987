"""What can go wrong with a query as a whole. What is wrong with one pulse is its outcome, and no error."""


class Error(Exception):
    """Any failure of this package. Its text says what was wrong, where, and what would be right."""


class ArgumentError(Error, ValueError):
    """Arguments that are no query: an unknown name, an array of text, shapes that do not broadcast."""


class TableFileError(Error, ValueError):
    """A file is not there, is not a table, is damaged, or breaks a rule of the format."""


class ServiceError(Error):
    """The server refused, or answered what it should not.

    `code` is the name of the gRPC status, "RESOURCE_EXHAUSTED" for example; empty if there was none.
    """

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(message)
        self.code = code


class TableNotFoundError(ServiceError, LookupError):
    """The server has no table of that name, or none was named and it has no default."""


class UnreachableError(ServiceError, ConnectionError):
    """The server could not be reached, went away or fell silent, and did not come back in the time given."""


class TableChangedError(ServiceError):
    """The table was replaced by one of other content while it was asked; no answer mixes the two."""
