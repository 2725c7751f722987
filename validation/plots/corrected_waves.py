"""The uncertainty that remains if waves longer than a length are corrected for."""

import numpy
from matplotlib.figure import Figure

WHOLE = 2000  # m, the abscissa of the uncorrected sea


def length(column):
    """Lengths in m. A column without the word "nothing" has been read as numbers."""
    return numpy.array([WHOLE if cell == "nothing" else float(cell) for cell in column])


def lines(axes, table, quantity, cases, label):
    for index, case in enumerate(cases):
        for spectrum, style in (("apel", "-"), ("elfouhaily", "--")):
            rows = table[(table["spectrum"] == spectrum) & case(table)]
            axes.plot(length(rows["corrected_above_m"]), rows[quantity], style, color=f"C{index}",
                      label=label[index] if spectrum == "apel" else None)


def finish(axes):
    axes.set_xscale("log")
    axes.invert_xaxis()
    axes.set_xticks([WHOLE, 300, 100, 30, 10, 3, 1], ["nothing", "300", "100", "30", "10", "3", "1"])
    axes.set_xticks([], minor=True)
    axes.tick_params(axis="x", labelrotation=45)
    axes.set_xlabel("corrected above / m")
    axes.set_ylim(0, None)


def corrected_waves(read):
    table = read("corrected_waves")
    figure = Figure(figsize=(7, 4.2))
    left, right = figure.subplots(1, 2, sharey=True)
    winds, footprints = (3, 6, 10, 15), (0.25, 0.5, 2)
    lines(left, table, "thu_left", [lambda t, w=w: (t["wind_speed_m_s"] == w) & (t["footprint_m"] == 0.5)
                                    for w in winds], [f"{w} m/s" for w in winds])
    lines(right, table, "thu_left", [lambda t, d=d: (t["wind_speed_m_s"] == 6) & (t["footprint_m"] == d)
                                     for d in footprints], [f"{d} m" for d in footprints])
    for axes, title, legend in ((left, "footprint 0.5 m", "wind"), (right, "wind 6 m/s", "footprint")):
        finish(axes)
        axes.set_title(title)
        axes.legend(title=legend, fontsize="small")
    left.set_ylabel("THU relative to the whole sea")
    return figure


def corrected_waves_thu(read):
    table, simulated = read("corrected_waves"), read("corrected_waves_monte_carlo")
    figure = Figure()
    axes = figure.subplots()
    winds = (3, 6, 10, 15)
    cases = [lambda t, w=w: (t["wind_speed_m_s"] == w) & (t["footprint_m"] == 0.25) for w in winds]
    lines(axes, table, "thu_per_depth", cases, [f"{w} m/s" for w in winds])
    depth = 20  # m
    axes.errorbar(length(simulated["corrected_above_m"]), simulated["thu_m"] / depth,
                  2 * simulated["thu_standard_error_m"] / depth, fmt="o", color="black", capsize=3, zorder=3,
                  label="Monte Carlo, 6 m/s")
    finish(axes)
    axes.set_ylabel("THU / m per m of depth")
    axes.legend()
    return figure
