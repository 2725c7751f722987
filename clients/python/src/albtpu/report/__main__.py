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
    if (folder / "plan.json").exists():
        write_plan(folder)
    if (folder / "report.json").exists():
        write_page(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
