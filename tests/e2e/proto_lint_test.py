"""The .proto files pass buf's STANDARD lint; skipped (exit code 77) where npx or what it fetches is missing.

Usage: proto_lint_test.py PROTO_FOLDER
"""

import shutil
import subprocess
import sys

SKIPPED = 77
BUF = ["npx", "--yes", "@bufbuild/buf@1"]


def main():
    if shutil.which("npx") is None:
        print("skipped: there is no npx (npm) to run buf with")
        return SKIPPED
    if subprocess.run([*BUF, "--version"], capture_output=True).returncode != 0:
        print("skipped: npx cannot get @bufbuild/buf, which takes a network or a cache of it")
        return SKIPPED
    return subprocess.run([*BUF, "lint"], cwd=sys.argv[1]).returncode


if __name__ == "__main__":
    sys.exit(main())
