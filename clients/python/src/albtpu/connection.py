"""The connection to a server: plain text or TLS, which failed calls to repeat, and how to report the others."""

from __future__ import annotations

import json
import os
import pathlib
import re
import time
from collections.abc import Iterator
from typing import Any, Union

import grpc
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

from .errors import ArgumentError, ServiceError, TableNotFoundError, UnreachableError
from .proxy import proxy_for

_OPTIONS = (
    # Calls go to all addresses of a name in turn.
    ("grpc.service_config", json.dumps({"loadBalancingConfig": [{"round_robin": {}}]})),
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.max_reconnect_backoff_ms", 2000),
    ("grpc.min_reconnect_backoff_ms", 5000),  # Time limit of one connection attempt; gRPC's default is 20 s.
    # A machine or network that fails does not close its connections. Keepalive pings, and their timeout, detect that.
    ("grpc.keepalive_time_ms", 20_000),
    ("grpc.keepalive_timeout_ms", 10_000),
)
File = Union[str, "os.PathLike[str]"]
_LARGEST_PORT = 65535  # gRPC takes larger ones modulo 65536.
_TARGET = re.compile(r"(?:[a-z]+:.*)?\S+:\w+|unix:\S+")

# The server is shutting down, restarting or at a limit; it may answer again in a moment.
_PASSING = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.RESOURCE_EXHAUSTED)
_FIRST_DELAY, _LONGEST_DELAY = 0.1, 1.0  # s


def open_channel(target: str, *, tls: bool, ca: File | None, cert: File | None, key: File | None,
                 token: str | None) -> grpc.Channel:
    """A channel, not yet connected. Raises ArgumentError, also for files that cannot be read."""
    if not isinstance(target, str) or not _TARGET.fullmatch(target):
        raise ArgumentError(f"the server is {target!r}: it should be HOST:PORT, dns:///HOST:PORT or "
                            "unix:PATH")
    port = target.rpartition(":")[2]
    if not target.startswith("unix:") and port.isdecimal() and int(port) > _LARGEST_PORT:
        raise ArgumentError(f"the server is {target!r}: its port should be at most {_LARGEST_PORT}")
    options = list(_OPTIONS)
    if proxy_for(target) is None:
        options.append(("grpc.enable_http_proxy", 0))
    if not (tls or ca or cert or key or token):
        return grpc.insecure_channel(target, options)
    if (cert is None) != (key is None):
        raise ArgumentError("a certificate needs its key and a key its certificate: give both 'cert' and 'key'")
    credentials = grpc.ssl_channel_credentials(*(_read(name, path) for name, path in
                                                 (("ca", ca), ("key", key), ("cert", cert))))
    if token is not None:
        bearer = grpc.access_token_call_credentials(token)
        credentials = grpc.composite_channel_credentials(credentials, bearer)
    return grpc.secure_channel(target, credentials, options)


def _read(name: str, path: File | None) -> bytes | None:
    if path is None:
        return None
    try:
        content = pathlib.Path(path).read_bytes()
    except OSError as error:
        raise ArgumentError(f"'{name}', {path}: {error.strerror or error}") from error
    if b"-----BEGIN " not in content:
        raise ArgumentError(f"'{name}', {path}: it should be a PEM file")
    return content


class Retries:
    """Waits between attempts, longer each time, for at most `patience` seconds since the last success."""

    def __init__(self, target: str, channel: grpc.Channel, patience: float) -> None:
        self._target, self._channel, self._patience = target, channel, patience
        self.succeeded()

    def succeeded(self) -> None:
        """Resets the delay and the time limit."""
        self._since: float | None = None
        self._delay = _FIRST_DELAY

    def wait_after(self, error: grpc.RpcError) -> None:
        """Waits before another attempt. Raises ServiceError if that is pointless or `patience` is used up."""
        self._since = self._since or time.monotonic()
        left = self._since + self._patience - time.monotonic()
        if error.code() not in _PASSING or left <= 0:
            raise service_error(self._target, error) from error
        self._channel.subscribe(_watch, try_to_connect=True)  # gRPC reconnects only while the state is watched.
        time.sleep(min(self._delay, left))
        self._channel.unsubscribe(_watch)
        self._delay = min(2 * self._delay, _LONGEST_DELAY)


def _watch(state: grpc.ChannelConnectivity) -> None:
    pass


def service_error(target: str, error: grpc.RpcError) -> ServiceError:
    """The exception of this package for a failed call."""
    proxy = proxy_for(target)
    through = f" (through {proxy})" if proxy else ""
    code, text = error.code(), f"server {target}{through}: {error.details()}{_field_violations(error)}"
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


_KEY = "grpc-status-details-bin"
_BAD_REQUEST = "type.googleapis.com/google.rpc.BadRequest"
# The parts of google/rpc/*.proto and google/protobuf/any.proto that are read here: field names in the order of
# their numbers. They are in a descriptor pool of their own: a program may have loaded Google's own files, and a
# pool accepts only one definition of a name.
_MESSAGES = {"Any": ("type_url", "*value"), "FieldViolation": ("field", "description"),
             "Status": (None, "message", "Any"), "BadRequest": ("FieldViolation",)}


def _field_violations(error: grpc.RpcError) -> str:
    """`; FIELD: DESCRIPTION` for each wrong field that the text of `error` does not mention yet."""
    text = error.details() or ""
    return "".join(f"; {field}: {what}" for field, what in _violations(error) if what not in text)


def _violations(error: grpc.RpcError) -> Iterator[tuple[str, str]]:
    for key, value in error.trailing_metadata() or ():
        if key != _KEY:
            continue
        try:
            for detail in _CLASSES["Status"].FromString(value).Any:
                if detail.type_url == _BAD_REQUEST:
                    for violation in _CLASSES["BadRequest"].FromString(detail.value).FieldViolation:
                        yield violation.field, violation.description
        except DecodeError:  # Ignored: the text of the error stands alone.
            return


def _make_messages() -> dict[str, Any]:
    file = descriptor_pb2.FileDescriptorProto(name="error_details", package="albtpu.details", syntax="proto3")
    kinds = descriptor_pb2.FieldDescriptorProto
    for name, fields in _MESSAGES.items():
        message = file.message_type.add(name=name)
        for number, field in enumerate(fields, 1):
            if field in _MESSAGES:
                message.field.add(name=field, number=number, label=kinds.LABEL_REPEATED,
                                  type=kinds.TYPE_MESSAGE, type_name=f".albtpu.details.{field}")
            elif field:
                kind = kinds.TYPE_BYTES if field.startswith("*") else kinds.TYPE_STRING
                message.field.add(name=field.lstrip("*"), number=number, label=kinds.LABEL_OPTIONAL,
                                  type=kind)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    make = getattr(message_factory, "GetMessageClass", None)
    if make is None:  # Protobuf before 4.22.
        make = message_factory.MessageFactory(pool).GetPrototype
    return {name: make(pool.FindMessageTypeByName(f"albtpu.details.{name}")) for name in _MESSAGES}


_CLASSES = _make_messages()
