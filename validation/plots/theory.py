"""Closed form and response theory against Monte Carlo and tracing."""

import numpy
from matplotlib.figure import Figure


def closed_form_map(read):
    table = read("closed_form_map_mean")
    table = table[table["azimuth_deg"] == 0]
    winds, incidences = numpy.unique(table["wind_speed_m_s"]), numpy.unique(table["incidence_deg"])
    figure = Figure(figsize=(7, 7))
    panels = figure.subplots(2, 1)
    for axes, column, title, colours in zip(
            panels, ("thu_ratio", "thu_ratio_se"),
            ("THU, Monte Carlo / closed form", "standard error of the ratio"), ("RdBu", "Greys")):
        values = table[column].reshape(len(winds), len(incidences)).T
        limits = {"vmin": 0.9, "vmax": 1.1} if column == "thu_ratio" else {"vmin": 0, "vmax": 2 * values.max()}
        image = axes.imshow(values, origin="lower", aspect="auto", cmap=colours, **limits)
        for i, row in enumerate(values):
            for w, value in enumerate(row):
                axes.text(w, i, f"{value:.3f}" if column == "thu_ratio" else f"{value:.1e}", ha="center", va="center",
                          fontsize=9)
        axes.set_xticks(range(len(winds)), [f"{wind:g}" for wind in winds])
        axes.set_yticks(range(len(incidences)), [f"{incidence:g}" for incidence in incidences])
        axes.set(title=title, xlabel="wind speed / (m/s)", ylabel="incidence / degree")
        axes.grid(False)
        figure.colorbar(image, ax=axes)
    return figure


def closed_form_departure(read):
    table = read("closed_form_map")
    table = table[(table["judged"] == "yes") & (table["azimuth_deg"] == 0)]
    figure = Figure(figsize=(7, 6))
    panels = figure.subplots(2, 1, sharex=True, sharey=True)
    for axes, incidence in zip(panels, (0, 25)):
        rows = table[table["incidence_deg"] == incidence]
        rows = rows[numpy.argsort(rows["mean_square_slope"])]
        slope = rows["mean_square_slope"]
        axes.fill_between(slope, rows["least_ratio"], rows["most_ratio"], color="tab:green",
                          alpha=0.15, label="explained by Snell's law and the grid")
        axes.errorbar(slope, rows["thu_ratio"], rows["thu_ratio_se"], fmt="o", markersize=3,
                      label="each sea and footprint, ± 1 standard error")
        axes.axhline(1, color="tab:gray")
        axes.set(title=f"incidence {incidence}°", ylabel="THU, Monte Carlo / closed form")
    panels[0].legend()
    panels[1].set_xlabel("mean square slope of the sea")
    return figure


def response_theory(read):
    figure = Figure(figsize=(7, 7.5))
    panels = figure.subplots(3, 1, sharex=True)
    groups = (("response_theory_many_seas", "tab:orange", "twelve seas, each with all its waves"),
              ("response_theory_resolved_seas", "tab:blue", "six seas without waves shorter than the grid"))
    for file, colour, label in groups:
        table = read(file)
        for axes, quantities in zip(panels, (("thu",), ("along", "cross"), ("tvu",))):
            for quantity in quantities:
                rows = table[table["quantity"] == quantity]
                axes.errorbar(rows["seen"], 100 * (rows["ratio"] - 1), 100 * rows["standard_error"], fmt="o",
                              markersize=2, linewidth=0.4, color=colour, zorder=0,
                              label=label if quantity == quantities[0] else None)
    for axes, title in zip(panels, ("THU", "refraction along and across the wind, from 0.2°",
                                    "TVU, from 5 mm at 10 m")):
        axes.set(title=title, ylabel="theory / tracing − 1, %", xscale="log")
        axes.axhline(0, color="tab:gray", linewidth=0.8)
        axes.set_rasterization_zorder(1)  # thousands of marks as one image
    panels[0].legend(loc="upper right")
    panels[0].set_ylim(-0.4, 0.7)  # with room for the legend
    panels[2].set_ylim(-1.5, 2.5)
    panels[2].set_xlabel("fraction of the mean square slope that the footprint passes: long footprints to the left")
    return figure
