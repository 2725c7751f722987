"""Names of this process and its children alone, in a namespace of mounts that nobody else sees."""

import ctypes
import os
import pathlib
import sys
import tempfile

CLONE_NEWNS, CLONE_NEWUSER, MS_REC, MS_PRIVATE, MS_BIND = 0x20000, 0x10000000, 0x4000, 1 << 18, 0x1000


def _enter(libc):
    """Moves this process, which has no threads yet, to a namespace of mounts of its own."""
    user, group = os.geteuid(), os.getegid()
    if libc.unshare(CLONE_NEWNS) != 0:
        if libc.unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0:
            return False
        pathlib.Path("/proc/self/setgroups").write_text("deny")
        pathlib.Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        pathlib.Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    return libc.mount(None, b"/", None, MS_REC | MS_PRIVATE, None) == 0


def give(names):
    """`names` has the addresses of each name, which are looked up nowhere else. Ends the test if that cannot be."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.mount.argtypes = [ctypes.c_char_p, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_ulong, ctypes.c_void_p]
    lines = [f"{address} {name}" for name, addresses in names.items() for address in addresses]
    # Who asks for addresses of version 6 as well is told at once that nobody is there.
    files = {"/etc/hosts": "127.0.0.1 localhost\n" + "".join(line + "\n" for line in lines),
             "/etc/resolv.conf": "nameserver 127.0.0.1\noptions timeout:1 attempts:1\n"}
    with tempfile.TemporaryDirectory() as folder:
        ready = _enter(libc)
        for path, text in files.items():
            source = pathlib.Path(folder, pathlib.Path(path).name)
            source.write_text(text)
            target = os.path.realpath(path)
            ready = ready and libc.mount(str(source).encode(), target.encode(), None, MS_BIND, None) == 0
    if not ready:
        print(f"skipped: names of our own need a namespace of mounts: {os.strerror(ctypes.get_errno())}")
        sys.exit(77)
