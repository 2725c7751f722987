"""Maps of the sea surface's uncertainty over wind, incidence and depth: a notebook in cells, or a script.

    python3 uncertainty_maps.py survey.h5 FOLDER        (or HOST:PORT of a service instead of the table file)
"""

# %% The source of the answers, and the folder for the plots
import pathlib
import sys

import albtpu
import matplotlib.pyplot as plt
import numpy as np

where, folder = sys.argv[1], pathlib.Path(sys.argv[2])
source = albtpu.open_table(where) if where.endswith(".h5") else albtpu.connect(where)
axes = source.table().axes
print({name: f"{axis.nodes[0]:g} to {axis.nodes[-1]:g} {axis.units}" for name, axis in axes.items()})

# %% One query with three axes that broadcast to a cube
wind_speed = np.linspace(axes["wind_speed"].nodes[0], axes["wind_speed"].nodes[-1], 40)
incidence = np.array([0.0, 10.0, 20.0])
depth = np.linspace(0, axes["depth"].nodes[-1], 60)
answer = source.query(wind_speed=wind_speed[:, None, None], incidence=incidence[:, None], depth=depth,
                      footprint=0.5, coverage="p95", standard_errors=True, s44_order="special",
                      best_s44_order=True)
cube = answer.to_xarray(("wind_speed", "incidence", "depth"))
print(cube)

# %% THU over wind and depth, one panel per incidence
cube.thu.plot.contourf(x="wind_speed", y="depth", col="incidence", levels=12, yincrease=False)
plt.savefig(folder / "thu.png")

# %% Profiles with their standard errors
figure, axes_of_plot = plt.subplots()
for wind in (4.0, 8.0, 12.0):
    profile = cube.sel(incidence=10.0).sel(wind_speed=wind, method="nearest")
    axes_of_plot.errorbar(profile.tvu, profile.depth, xerr=profile.tvu_standard_error,
                          label=f"{profile.wind_speed.item():.1f} m/s")
axes_of_plot.set(xlabel="TVU of the sea surface [m, 95 %]", ylabel="depth [m]")
axes_of_plot.invert_yaxis()
axes_of_plot.legend(title="wind")
figure.savefig(folder / "tvu.png")

# %% The part of the Special Order limit that is left for all other sources of vertical error
plt.figure()
cube.remaining_tvu.sel(incidence=20.0).plot(x="wind_speed", y="depth", yincrease=False)
plt.savefig(folder / "special_order.png")

# %% The strictest S-44 order that the sea surface alone does not exceed
cube.best_s44_orders.sel(incidence=20.0).to_pandas().to_csv(folder / "best_orders.csv")
