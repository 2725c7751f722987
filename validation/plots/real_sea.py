"""The spectra compared with measurements of real seas, and their effect on a beam."""

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
