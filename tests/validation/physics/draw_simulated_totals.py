"""Draws what simulated_totals_test found: the share of points within the reported uncertainty, by depth and incidence.

Usage: draw_simulated_totals.py FOUND.csv OUT.svg
"""

import csv
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "albtpu"
import matplotlib.pyplot as plt

with open(sys.argv[1]) as found:
    rows = [row for row in csv.reader(found) if row]
figure, axes = plt.subplots(1, 2, figsize=(8, 3), sharey=True, layout="constrained")
for axis, by, unit in ((axes[0], "depth", "m"), (axes[1], "incidence", "degree")):
    axis.axhspan(94.5, 95.5, color="0.92")
    axis.axhline(95, color="0.6", linewidth=0.8)
    for located, marker, colour in (("pulse", "o", "#0072b2"), ("local", "s", "#d55e00"), ("level", "^", "#009e73")):
        points = [(float(at), float(thu), float(tvu))
                  for name, kind, at, thu, tvu in rows if (name, kind) == (located, by)]
        axis.plot([p[0] for p in points], [p[1] for p in points], marker, color=colour, label=f"{located}, THU")
        axis.plot([p[0] for p in points], [p[2] for p in points], marker, color=colour, fillstyle="none",
                  label=f"{located}, TVU")
    axis.set_xlabel(f"{by}, {unit}")
    axis.set_ylim(94, 96)
axes[0].set_ylabel("points within, %")
axes[1].legend(ncols=2, fontsize=7, frameon=False)
figure.savefig(sys.argv[2], metadata={"Date": None})
