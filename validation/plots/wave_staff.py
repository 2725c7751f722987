"""Figures of the wave staff study, Table 2."""

import numpy
from matplotlib.figure import Figure


def table_2(read):
    figure = Figure(figsize=(7, 5.6))
    wavelength, height = figure.subplots(2, 1, sharex=True)
    measured, winds = read("table_2"), read("table_2_winds")
    shades = iter(numpy.linspace(0.75, 0, 6))
    for wind in numpy.unique(winds["wind_speed_m_s"]):
        sea = winds[(winds["wind_speed_m_s"] == wind) & (winds["fetch_m"] < 10)]
        style = {"color": str(next(shades)), "label": f"Apel, {wind:g} m/s"}
        wavelength.plot(sea["fetch_m"], 100 * sea["peak_wavelength_m"], **style)
        height.plot(sea["fetch_m"], 1000 * sea["significant_wave_height_m"], **style)
    for axes, quantity, scale in ((wavelength, "peak_wavelength_m", 100),
                                  (height, "significant_wave_height_m", 1000)):
        axes.plot(measured["fetch_m"], scale * measured[f"published_{quantity}"], "o", color="tab:red",
                  label="measured")
    wavelength.set_ylabel("peak wavelength (cm)")
    height.set_ylabel("significant wave\nheight (mm)")
    height.set_xlabel("fetch (m)")
    for axes in (wavelength, height):
        axes.set_ylim(bottom=0)
    wavelength.legend(ncols=2, fontsize=8)
    return figure


def table_2_spectrum(read):
    figure = Figure()
    axes = figure.subplots()
    spectra, measured = read("table_2_spectrum"), read("table_2")
    fetches = numpy.unique(spectra["fetch_m"])
    for fetch, color in zip((fetches[0], fetches[-1]), ("tab:blue", "tab:orange")):
        at = spectra[spectra["fetch_m"] == fetch]
        axes.semilogy(at["frequency_hz"], at["spectrum_m2_per_hz"], color=color,
                      label=f"spectrum, fetch {fetch:g} m")
        axes.semilogy(at["frequency_hz"], at["staff_m2_per_hz"], ".", markersize=4, color=color,
                      label=f"staff, fetch {fetch:g} m")
        peak = measured["published_peak_frequency_hz"][measured["fetch_m"] == fetch][0]
        axes.axvline(peak, color=color, linestyle="--", linewidth=1)
    highest = spectra["spectrum_m2_per_hz"].max()
    axes.set_ylim(1e-4 * highest, 3 * highest)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("elevation (m²/Hz)")
    axes.legend()
    return figure
