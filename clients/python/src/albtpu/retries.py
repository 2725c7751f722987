"""What a failed call means, and whether it is worth another try."""

from __future__ import annotations

import time

import grpc

from .error_details import added_by_details
from .errors import ServiceError, TableNotFoundError, UnreachableError

# The server goes, restarts or is at its limit: it may be well in a moment.
_PASSING = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.RESOURCE_EXHAUSTED)
_FIRST_DELAY, _LONGEST_DELAY = 0.1, 1.0  # s


class Retries:
    """Waits longer and longer between tries, `patience` seconds in all since the last success."""

    def __init__(self, channel: grpc.Channel, patience: float) -> None:
        self._channel, self._patience = channel, patience
        self.succeeded()

    def succeeded(self) -> None:
        """Begins anew: the next failure is the first."""
        self._since: float | None = None
        self._delay = _FIRST_DELAY

    def wait_after(self, error: grpc.RpcError) -> bool:
        """Waits and returns whether to try again; False at once when it is of no use or took too long."""
        self._since = self._since or time.monotonic()
        left = self._since + self._patience - time.monotonic()
        if error.code() not in _PASSING or left <= 0:
            return False
        self._channel.subscribe(_watch, try_to_connect=True)  # gRPC connects only while somebody watches.
        time.sleep(min(self._delay, left))
        self._channel.unsubscribe(_watch)
        self._delay = min(2 * self._delay, _LONGEST_DELAY)
        return True


def _watch(state: grpc.ChannelConnectivity) -> None:
    pass


def explained(target: str, error: grpc.RpcError) -> ServiceError:
    """The failure in the words of this package."""
    code, text = error.code(), f"server {target}: {error.details()}{added_by_details(error)}"
    if code == grpc.StatusCode.UNAVAILABLE:
        hint = ("start albtpu-serve there, name the HOST:PORT where it listens, or see that it speaks TLS "
                "if you do (ca=)")
        return UnreachableError(f"{text}: {hint}", code.name)
    if code == grpc.StatusCode.UNAUTHENTICATED:
        return ServiceError(f"{text} (token=)", code.name)
    if code == grpc.StatusCode.DEADLINE_EXCEEDED:
        return UnreachableError(text, code.name)
    if code in (grpc.StatusCode.NOT_FOUND, grpc.StatusCode.FAILED_PRECONDITION):
        return TableNotFoundError(text, code.name)
    return ServiceError(text, code.name)
