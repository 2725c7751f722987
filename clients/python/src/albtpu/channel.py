"""The connection to a server: plain text or TLS, names with several addresses, reconnection."""

from __future__ import annotations

import json
import os
import pathlib
import re
from typing import Union

import grpc

from .errors import ArgumentError

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
_LOOPBACK = re.compile(r"(localhost|127\.[\d.]+|\[::1\]):\d+|unix:.*")
_TARGET = re.compile(r"(?:[a-z]+:.*)?\S+:\w+|unix:\S+")


def open_channel(target: str, *, tls: bool, ca: File | None, cert: File | None, key: File | None,
                 token: str | None) -> grpc.Channel:
    """A channel, not yet connected. Raises ArgumentError, also for files that cannot be read."""
    if not isinstance(target, str) or not _TARGET.fullmatch(target):
        raise ArgumentError(f"the server is {target!r}: it should be HOST:PORT, dns:///HOST:PORT or "
                            "unix:PATH")
    options = list(_OPTIONS)
    if _LOOPBACK.fullmatch(target):  # A proxy from the environment cannot reach our loopback.
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
