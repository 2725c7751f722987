"""Measurements of real seas against the spectra, and what remains if long waves are corrected for."""

import numpy
from matplotlib.figure import Figure

SPECTRA = (("apel", "Apel", "tab:blue"), ("elfouhaily", "Elfouhaily et al.", "tab:orange"))


def real_sea_slopes(read):
    table = read("real_sea_slopes")
    wind = table["wind_speed_m_s"]
    figure = Figure(figsize=(7, 4))
    for axes, direction, title, scatter in zip(figure.subplots(1, 2, sharey=True), ("along", "cross"),
                                               ("along the wind", "across the wind"), (0.004, 0.002)):
        observed = table[f"cox_munk_{direction}"]
        axes.fill_between(wind, observed - scatter, observed + scatter, color="tab:gray", alpha=0.35,
                          linewidth=0)
        axes.plot(wind, observed, color="black", label="Cox and Munk (1954)")
        for name, label, colour in SPECTRA:
            axes.plot(wind, table[f"{name}_{direction}"], color=colour, label=label)
        axes.set(xlabel="wind at 10 m / m s$^{-1}$", title=title, xlim=(1, 15), ylim=(0, None))
    figure.axes[0].set_ylabel("mean square slope")
    figure.axes[0].legend()
    return figure


def real_sea_heights(read):
    by_wind, by_fetch = read("real_sea_heights"), read("real_sea_heights_by_fetch")
    by_fetch = by_fetch[by_fetch["wind_speed_m_s"] == 10]
    figure = Figure(figsize=(7, 4))
    left, right = figure.subplots(1, 2)
    left.plot(by_wind["wind_speed_m_s"], by_wind["pierson_moskowitz_m"], color="black",
              label="Pierson, Moskowitz (1964)")
    left.plot(by_wind["wind_speed_m_s"], by_wind["pierson_moskowitz_wind_as_it_is_m"], ":", color="black",
              label="same, wind unconverted")
    right.loglog(by_fetch["fetch_km"], by_fetch["jonswap_m"], color="black", label="JONSWAP")
    for name, label, colour in SPECTRA:
        left.plot(by_wind["wind_speed_m_s"], by_wind[f"{name}_m"], color=colour, label=label)
        right.loglog(by_fetch["fetch_km"], by_fetch[f"{name}_m"], color=colour, label=label)
    left.set(xlabel="wind at 10 m / m s$^{-1}$", ylabel="significant wave height / m", xlim=(1, 15),
             ylim=(0, None))
    right.set(xlabel="fetch / km", title="10 m/s")
    left.set_title("fully developed")
    left.legend(fontsize="small")
    right.legend(fontsize="small")
    return figure


def spectra_thu(read):
    table = read("spectra_closed_form")
    table = table[table["incidence_deg"] == 20]
    figure = Figure(figsize=(7, 4))
    left, right = figure.subplots(1, 2, sharey=True)
    for footprint in (0.25, 0.5, 1, 2):
        rows = table[(table["footprint_m"] == footprint) & (table["fetch_km"] == "fully developed")]
        left.plot(rows["wind_speed_m_s"], rows["thu_ratio"], ".-", label=f"{footprint:g} m")
    for fetch in ("1", "10", "100", "fully developed"):
        rows = table[(table["footprint_m"] == 0.5) & (table["fetch_km"] == fetch)]
        right.plot(rows["wind_speed_m_s"], rows["thu_ratio"], ".-", label=fetch)
    for axes, title in ((left, "footprint"), (right, "fetch / km")):
        axes.axhline(1, color="black", linewidth=0.8)
        axes.set(xlabel="wind at 10 m / m s$^{-1}$", xlim=(2, 15))
        axes.legend(title=title, fontsize="small")
    left.set(ylabel="THU, Elfouhaily / Apel", ylim=(0, None))
    return figure


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
