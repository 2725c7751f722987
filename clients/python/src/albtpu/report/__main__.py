"""python3 -m albtpu.report FOLDER: makes report.html or plan.html of the JSON in a folder."""

import pathlib
import sys

from .page import write_page
from .plan_page import write_plan


def main() -> int:
    if len(sys.argv) != 2:
        print("python3 -m albtpu.report: give one folder with report.json or plan.json", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    pages = {"plan.json": write_plan, "report.json": write_page}
    found = [write for name, write in pages.items() if (folder / name).exists()]
    if not found:
        print(f"{folder}: no report.json or plan.json; give the folder of a report", file=sys.stderr)
    for write in found:
        write(folder)
    return 0 if found else 1


if __name__ == "__main__":
    sys.exit(main())
