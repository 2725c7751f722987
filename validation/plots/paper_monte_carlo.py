"""Table 3, Figures 8 and 9: refraction angles over wind, incidence and diameter."""

import numpy
from matplotlib.figure import Figure

COLOURS = ["tab:blue", "tab:orange", "tab:green", "tab:red", "tab:purple"]


def table_3_angles(read):
    table = read("table_3")
    figure = Figure(figsize=(7, 4.6))
    panels = figure.subplots(1, 2, sharey=True)
    for axes, axis in zip(panels, ("along", "cross")):
        for incidence, colour in ((0, "tab:blue"), (20, "tab:orange")):
            rows = table[table["incidence_deg"] == incidence]
            wind = rows["wind_speed_m_s"]
            theory, = axes.plot(wind, rows[f"closed_form_{axis}_deg"], color=colour)
            scaled = axes.errorbar(wind, rows[f"sqrt2_monte_carlo_{axis}_deg"],
                                   rows[f"sqrt2_monte_carlo_{axis}_se_deg"], fmt="--", color=colour)
            paper, = axes.plot(wind, rows[f"paper_{axis}_deg"], "o", color=colour,
                               label="nadir" if incidence == 0 else f"{incidence}°")
        axes.set(title=f"{axis} wind", xlabel="wind speed / (m/s)", ylim=(0, 6.2))
    panels[0].set_ylabel("2 sigma of refraction / degree")
    panels[0].legend([paper, theory, scaled], ["Table 3", "closed form", "Monte Carlo, heights × √2"],
                     loc="upper left")
    panels[1].legend(loc="upper left", title="incidence")
    return figure


def figure_8(read):
    table = read("figure_8")
    figure = Figure()
    axes = figure.subplots()
    for diameter, colour in zip(numpy.unique(table["diameter_m"]), COLOURS):
        rows = table[table["diameter_m"] == diameter]
        wind = rows["wind_speed_m_s"]
        axes.errorbar(wind, rows["monte_carlo_deg"], rows["monte_carlo_se_deg"], fmt="o", color=colour)
        axes.plot(wind, rows["line_deg"], color=colour,
                  label=f"{diameter:g} m, R² = {rows['line_r_squared'][0]:.2f}")
    axes.set(xlabel="wind speed / (m/s)", ylabel="2 sigma along wind at 15° / degree", ylim=(0, None))
    axes.legend(title="diameter, line", loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def figure_9(read):
    table = read("figure_9")
    figure = Figure()
    axes = figure.subplots()
    diameter = table["diameter_m"]
    for axis, colour in (("along", "tab:blue"), ("cross", "tab:orange")):
        axes.errorbar(diameter, table[f"monte_carlo_{axis}_deg"], table[f"monte_carlo_{axis}_se_deg"], fmt="o",
                      color=colour, label=f"{axis} wind, Monte Carlo")
        axes.plot(diameter, table[f"closed_form_{axis}_deg"], color=colour, label=f"{axis} wind, closed form")
        axes.plot(diameter, table[f"equations_{axis}_deg"], "--", color=colour,
                  label=f"{axis} wind, Eq. 27-30")
    axes.set(xlabel="diameter / m", ylabel="mean 2 sigma of refraction / degree", xscale="log", ylim=(0, None))
    axes.set_xticks(diameter, [f"{d:g}" for d in diameter])
    axes.minorticks_off()
    axes.legend()
    return figure
