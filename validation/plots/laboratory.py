"""The laboratory of the paper: Table 4, and the wave staff of Table 2."""

import numpy
from matplotlib.figure import Figure
from matplotlib.patches import Circle


def table_4(read):
    cells = read("table_4")
    incidences = numpy.unique(cells["incidence_deg"])
    figure = Figure(figsize=(7, 2.4 * len(incidences) + 0.6))
    rows = figure.subplots(len(incidences), 2, sharex=True, sharey=True, squeeze=False)
    for row, incidence in zip(rows, incidences):
        at = cells[cells["incidence_deg"] == incidence]
        wind = at["wind_speed_m_s"]
        for axes, axis in zip(row, ("along", "cross")):
            axes.plot(wind, at[f"published_{axis}_wind_deg"], "o", color="tab:red", label="measured")
            axes.errorbar(wind, at[f"{axis}_wind_deg"], 2 * at[f"{axis}_wind_standard_error_deg"], fmt=".-",
                          color="tab:blue", capsize=3, label="virtual array")
            axes.plot(wind, at[f"full_beam_{axis}_wind_deg"], ".-", color="0.5", label="full beam")
            axes.set_title(f"{axis} wind, incidence {incidence:g}°", fontsize=10)
        row[0].set_ylabel("2σ (degrees)")
    for axes in rows[-1]:
        axes.set_xlabel("wind (m/s)")
    rows[0][0].set_ylim(bottom=0)  # last, because setting one end of the shared axis stops its automatic scaling
    rows[0][0].legend(loc=(0.02, 0.1), fontsize=8)
    return figure


def table_4_light(read):
    light = read("table_4_light")
    x, y = (numpy.unique(light[name]) * 100 for name in ("along_wind_m", "cross_wind_m"))
    figure = Figure(figsize=(6, 5))
    axes = figure.subplots()
    picture = axes.imshow(light["irradiance"].reshape(len(x), len(y)).T, origin="lower", cmap="gray",
                          extent=(x[0], x[-1], y[0], y[-1]), vmin=0, vmax=6, interpolation="nearest")
    for column in numpy.arange(-12.5, 13, 5):
        for row in numpy.arange(-12.5, 13, 5):
            axes.add_patch(Circle((column, row), 0.5, fill=False, color="tab:red", linewidth=1))
    axes.grid(False)
    axes.set_xlabel("along wind (cm)")
    axes.set_ylabel("cross wind (cm)")
    figure.colorbar(picture, label="irradiance over its mean on the water")
    return figure


def table_4_sensitivity(read):
    found = read("table_4_sensitivity")
    figure = Figure(figsize=(7, 7.2))
    apertures, detectors, heights = figure.subplots(3, 1)

    def draw(axes, parameter, label, **style):
        at = found[found["parameter"] == parameter]
        if len(at):
            at = at[numpy.argsort(at["value"])]
            axes.errorbar(at["value"], at["along_wind_deg"], 2 * at["along_wind_standard_error_deg"],
                          fmt=".-", capsize=3, label=label, **style)

    draw(apertures, "aperture (cm)", "uniform beam", color="tab:blue")
    draw(apertures, "aperture, gaussian beam (cm)", "gaussian beam", color="tab:orange")
    apertures.set_xlabel("aperture (cm)")
    draw(detectors, "detectors along 0.30 m", "apertures of 1 cm", color="tab:blue")
    detectors.set_xlabel("detectors along 0.30 m")
    draw(heights, "wave height, 2 m/s (mm)", "2 m/s", color="tab:blue")
    draw(heights, "wave height, 5.25 m/s (mm)", "5.25 m/s", color="tab:green")
    heights.set_xlabel("significant wave height (mm)")
    full_beam = found["full_beam_along_wind_deg"][0]
    for axes in (apertures, detectors):
        axes.axhline(full_beam, color="0.5", linestyle="--", label="full beam")
    for axes in (apertures, detectors, heights):
        axes.set_ylim(bottom=0)
        axes.set_ylabel("2σ along wind\n(degrees)")
        axes.legend(fontsize=9)
    return figure


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
