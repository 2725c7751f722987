"""Checks the .proto files by the STANDARD rules of buf lint. Skipped (exit code 77) without npx or network.

Usage: proto_lint_test.py PROTO_FOLDER
"""

import shutil
import subprocess
import sys

SKIPPED = 77
BUF = ["npx", "--yes", "@bufbuild/buf@1"]


def main():
    if shutil.which("npx") is None:
        print("skipped: npx (npm), which runs buf, is missing")
        return SKIPPED
    if subprocess.run([*BUF, "--version"], capture_output=True).returncode != 0:
        print("skipped: npx cannot get @bufbuild/buf (needs a network or a cache)")
        return SKIPPED
    return subprocess.run([*BUF, "lint"], cwd=sys.argv[1]).returncode


if __name__ == "__main__":
    sys.exit(main())
