"""The HTTP proxy between a client and its server, by the environment.

The rule is that of the other clients: as in gRPC, the first of grpc_proxy, https_proxy and http_proxy that is set
counts, if it is an http:// URL. There is no proxy for loopback addresses and sockets of this machine, which it cannot
reach, and for the hosts that no_grpc_proxy, or else no_proxy, lists: ends of names, addresses, networks such as
10.0.0.0/8, or * for all.
"""

from __future__ import annotations

import ipaddress
import os
import re
from collections.abc import Mapping
from typing import NamedTuple

_SCHEME = re.compile(r"(?:dns:(?://[^/]*/)?|ipv4:|ipv6:)")
_LOOPBACK = ("127.0.0.0/8", "::1/128")


class Proxy(NamedTuple):
    """A proxy, without user and password, and the variable of the environment that names it."""

    url: str
    variable: str

    def __str__(self) -> str:
        return f"the proxy {self.url}, from {self.variable}"


def proxy_for(target: str, environment: Mapping[str, str] = os.environ) -> Proxy | None:
    """The proxy through which `target` is reached; None if there is none."""
    hosts = _hosts(target)
    if all(host.lower() == "localhost" or any(_is_in(host, network) for network in _LOOPBACK) for host in hosts):
        return None
    listed = environment.get("no_grpc_proxy", environment.get("no_proxy", ""))
    entries = [entry.strip() for entry in listed.split(",") if entry.strip()]
    if all(any(entry == "*" or _is_in(host, entry) or host.lower().endswith(entry.lower()) for entry in entries)
           for host in hosts):
        return None
    for variable in ("grpc_proxy", "https_proxy", "http_proxy"):
        if variable in environment:
            found = re.match(r"http://(?:.*@)?([^/@]+)", environment[variable])  # A password may have any characters.
            return Proxy(f"http://{found[1]}", variable) if found else None
    return None


def _hosts(target: str) -> list[str]:
    """The hosts of a target, without brackets. None for a socket of this machine."""
    if target.startswith(("unix:", "unix-abstract:")):
        return []
    addresses = _SCHEME.sub("", target, count=1).split(",")
    return [address.rpartition(":")[0].removeprefix("[").removesuffix("]") for address in addresses]


def _is_in(host: str, network: str) -> bool:
    try:
        address = ipaddress.ip_address(host)
        address = getattr(address, "ipv4_mapped", None) or address  # ::ffff:127.0.0.1
        return "/" in network and address in ipaddress.ip_network(network, strict=False)
    except ValueError:  # A name, or no network.
        return False
