"""python3 -m albtpu.report FOLDER: makes report.html from report.json and grid.nc in a folder."""

import pathlib
import sys

from .page import write_page


def main() -> int:
    if len(sys.argv) != 2:
        print("python3 -m albtpu.report: give one folder with report.json and grid.nc", file=sys.stderr)
        return 2
    write_page(pathlib.Path(sys.argv[1]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
