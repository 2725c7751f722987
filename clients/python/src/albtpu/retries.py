"""Which failed calls to repeat, and how to report the others."""

from __future__ import annotations

import time

import grpc

from .error_details import field_violations
from .errors import ServiceError, TableNotFoundError, UnreachableError

# The server is shutting down, restarting or at a limit; it may answer again in a moment.
_PASSING = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.RESOURCE_EXHAUSTED)
_FIRST_DELAY, _LONGEST_DELAY = 0.1, 1.0  # s


class Retries:
    """Waits between attempts, longer each time, for at most `patience` seconds since the last success."""

    def __init__(self, channel: grpc.Channel, patience: float) -> None:
        self._channel, self._patience = channel, patience
        self.succeeded()

    def succeeded(self) -> None:
        """Resets the delay and the time limit."""
        self._since: float | None = None
        self._delay = _FIRST_DELAY

    def wait_after(self, error: grpc.RpcError) -> bool:
        """Waits, and returns whether to try again. False at once if that is pointless or `patience` is used up."""
        self._since = self._since or time.monotonic()
        left = self._since + self._patience - time.monotonic()
        if error.code() not in _PASSING or left <= 0:
            return False
        self._channel.subscribe(_watch, try_to_connect=True)  # gRPC reconnects only while the state is watched.
        time.sleep(min(self._delay, left))
        self._channel.unsubscribe(_watch)
        self._delay = min(2 * self._delay, _LONGEST_DELAY)
        return True


def _watch(state: grpc.ChannelConnectivity) -> None:
    pass


def service_error(target: str, error: grpc.RpcError) -> ServiceError:
    """The exception of this package for a failed call."""
    code, text = error.code(), f"server {target}: {error.details()}{field_violations(error)}"
    if code == grpc.StatusCode.UNAVAILABLE:
        hint = "start albtpu-serve there, check HOST:PORT, or check whether the server speaks TLS (ca=)"
        return UnreachableError(f"{text}: {hint}", code.name)
    if code == grpc.StatusCode.UNAUTHENTICATED:
        return ServiceError(f"{text} (token=)", code.name)
    if code == grpc.StatusCode.DEADLINE_EXCEEDED:
        return UnreachableError(text, code.name)
    if code in (grpc.StatusCode.NOT_FOUND, grpc.StatusCode.FAILED_PRECONDITION):
        return TableNotFoundError(text, code.name)
    return ServiceError(text, code.name)
