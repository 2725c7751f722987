"""The page of a report of a survey, drawn from the report.json and grid.nc that `albtpu-query report` makes.

    python3 -m albtpu.report FOLDER

writes FOLDER/report.html, one file without anything from outside. It needs matplotlib and netCDF4.
"""

from .page import write_page

__all__ = ["write_page"]
