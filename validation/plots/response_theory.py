"""The response theory over tracing, beam by beam."""

from matplotlib.figure import Figure


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
