"""A network that can be cut: this process in a network namespace, albtpu-serve in another, a wire in between.

Both namespaces and the wire go when the processes that are in them end.
"""

import ctypes
import os
import pathlib
import subprocess

CLONE_NEWUSER, CLONE_NEWNET = 0x10000000, 0x40000000
HERE, THERE = "192.0.2.1", "192.0.2.2"  # Documentation's (RFC 5737).
NOBODY = "02:00:00:00:00:99"  # An address of hardware that is nowhere.


def ip(*arguments, of=None):
    """In the namespace of the process `of`, or in ours."""
    prefix = () if of is None else ("nsenter", f"--net=/proc/{of}/ns/net")
    subprocess.run([*prefix, "ip", *arguments], check=True, capture_output=True, text=True)


def enter():
    """Moves this process, which has no threads yet, to a namespace of its own. Why not, or None when it is there."""
    user, group = os.geteuid(), os.getegid()
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(CLONE_NEWNET) != 0:
        if libc.unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0:
            return f"a namespace for the network needs root here: {os.strerror(ctypes.get_errno())}"
        pathlib.Path("/proc/self/setgroups").write_text("deny")
        pathlib.Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        pathlib.Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    try:
        ip("link", "set", "lo", "up")
    except (OSError, subprocess.CalledProcessError) as error:
        return f"the network cannot be set up: {error}"
    return None


class Wire:
    """From us to `process`, which was started with `unshare --net`."""

    def __init__(self, process):
        self.pid = str(process.pid)
        ip("link", "add", "here", "type", "veth", "peer", "name", "there", "netns", self.pid)
        for name, address, of in (("here", HERE, None), ("there", THERE, self.pid)):
            ip("address", "add", f"{address}/24", "dev", name, of=of)
            ip("link", "set", name, "up", of=of)

    def remove(self):
        """At once; with the namespace it would go some time later."""
        ip("link", "delete", "here")

    def cut(self):
        ip("link", "set", "there", "down", of=self.pid)

    def mend(self):
        ip("link", "set", "there", "up", of=self.pid)

    def lose(self):
        """From now on packets go to nobody, and no one is told."""
        for name, other, of in (("here", THERE, None), ("there", HERE, self.pid)):
            ip("neighbour", "replace", other, "lladdr", NOBODY, "nud", "permanent", "dev", name, of=of)

    def find(self):
        for name, other, of in (("here", THERE, None), ("there", HERE, self.pid)):
            ip("neighbour", "delete", other, "dev", name, of=of)
