"""A network that can be cut: this process in one network namespace, albtpu-serve in another, and a wire between them.

Both namespaces and the wire disappear when the processes in them end.
"""

import ctypes
import os
import subprocess

from names import unshare

CLONE_NEWNET = 0x40000000
HERE, THERE = "192.0.2.1", "192.0.2.2"  # Reserved for documentation (RFC 5737).
NOBODY = "02:00:00:00:00:99"  # A hardware address that nothing has.


def ip(*arguments, of=None):
    """Runs `ip` in the namespace of the process `of`, or in ours."""
    prefix = () if of is None else ("nsenter", f"--net=/proc/{of}/ns/net")
    subprocess.run([*prefix, "ip", *arguments], check=True, capture_output=True, text=True)


def enter():
    """Moves this process, which must have no threads yet, to a new namespace. Returns None, or why it failed."""
    if not unshare(ctypes.CDLL(None, use_errno=True), CLONE_NEWNET):
        return (f"this test needs a network namespace: cannot create one ({os.strerror(ctypes.get_errno())}); "
                "run as root with CAP_SYS_ADMIN, or allow user namespaces")
    try:
        ip("link", "set", "lo", "up")
    except OSError as error:
        return f"this test needs a network: cannot run ip ({error.strerror}); apt-get install iproute2"
    except subprocess.CalledProcessError as error:
        return f"this test needs a network: cannot set up lo ({error.stderr.strip()}); run as root with CAP_NET_ADMIN"
    return None


class Wire:
    """A wire from our namespace to that of `process`, which was started with `unshare --net`."""

    def __init__(self, process):
        self.pid = str(process.pid)
        ip("link", "add", "here", "type", "veth", "peer", "name", "there", "netns", self.pid)
        for name, address, of in (("here", HERE, None), ("there", THERE, self.pid)):
            ip("address", "add", f"{address}/24", "dev", name, of=of)
            ip("link", "set", name, "up", of=of)

    def remove(self):
        """Removes the wire at once; otherwise it would disappear some time after the namespace."""
        ip("link", "delete", "here")

    def cut(self):
        ip("link", "set", "there", "down", of=self.pid)

    def mend(self):
        ip("link", "set", "there", "up", of=self.pid)

    def lose(self):
        """From now on all packets are lost without an error."""
        for name, other, of in (("here", THERE, None), ("there", HERE, self.pid)):
            ip("neighbour", "replace", other, "lladdr", NOBODY, "nud", "permanent", "dev", name, of=of)

    def find(self):
        for name, other, of in (("here", THERE, None), ("there", HERE, self.pid)):
            ip("neighbour", "delete", other, "dev", name, of=of)
