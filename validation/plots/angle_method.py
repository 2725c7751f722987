"""Table 5: THU and TVU over depth."""

from matplotlib.figure import Figure


def table_5_thu_tvu(read):
    table = read("table_5")
    figure = Figure()
    axes = figure.subplots()
    for name, colour in (("thu", "tab:blue"), ("tvu", "tab:orange")):
        axes.plot(table["depth_m"], table[f"quadrature_{name}_m"], color=colour,
                  label=f"{name.upper()}, angle method by quadrature")
        axes.plot(table["depth_m"], table[f"paper_{name}_m"], "o", color=colour,
                  label=f"{name.upper()}, Table 5")
    axes.plot(table["depth_m"], table["s44_1b_tvu_limit_m"], "--", color="tab:gray",
              label="TVU limit, S-44 order 1b (95 %)")
    axes.set(xlabel="depth / m", ylabel="uncertainty, 2 sigma / m", xlim=(0, None), ylim=(0, None))
    axes.legend()
    return figure
