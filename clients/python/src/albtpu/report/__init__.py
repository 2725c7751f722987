"""The page of a report or of a plan, drawn from what `albtpu-query report` and `albtpu-query plan` write.

    python3 -m albtpu.report FOLDER

writes FOLDER/report.html from report.json and grid.nc in it, or FOLDER/plan.html from plan.json: one file without
anything from outside. It needs matplotlib, and netCDF4 for a report.
"""

from .page import write_page
from .plan_page import write_plan

__all__ = ["write_page", "write_plan"]
