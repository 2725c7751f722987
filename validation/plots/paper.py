"""The figures and tables of the paper: spectra, a beam through a surface, refraction, uncertainty over depth."""

import numpy
from matplotlib.colors import LightSource, LogNorm
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


def grid(table, x, y, value):
    points = round(numpy.sqrt(len(table)))
    return tuple(table[name].reshape(points, points) for name in (x, y, value))


def figure_2(read):
    spectrum, spreading = read("figure_2_spectrum"), read("figure_2_spreading")
    figure = Figure(figsize=(7, 6.4))
    panels = figure.subplot_mosaic([["a", "b"], ["c", "c"]], height_ratios=(1, 1.3))
    s, d, psi = panels["a"], panels["b"], panels["c"]

    s.loglog(spectrum["k_rad_per_m"], spectrum["s_m3"])
    peak = spectrum["k_rad_per_m"][numpy.argmax(spectrum["s_m3"])]
    s.axvline(peak, linestyle=":", color="tab:gray")
    s.set(xlabel="wavenumber / rad m$^{-1}$", ylabel="S(k) / m$^3$", title="(a)",
          ylim=(spectrum["s_m3"].max() * 1e-9, spectrum["s_m3"].max() * 3))

    d.plot(spreading["direction_deg"], spreading["spreading_per_rad"], label="travelling waves")
    d.plot(spreading["direction_deg"], spreading["frozen_per_rad"], "--", label="frozen surface")
    d.set(xlabel="direction from downwind / degree", ylabel="D / rad$^{-1}$", title="(b)",
          xticks=range(-180, 181, 90), ylim=(0, 0.58))
    d.legend(loc="upper right", fontsize="small")

    kx, ky, value = grid(read("figure_2_directional"), "kx_rad_per_m", "ky_rad_per_m", "psi_m4")
    image = psi.pcolormesh(kx, ky, numpy.maximum(value, value.max() * 1e-4), cmap="viridis", rasterized=True,
                           norm=LogNorm(value.max() * 1e-4, value.max()))
    psi.set(xlabel="downwind wavenumber / rad m$^{-1}$", ylabel="crosswind / rad m$^{-1}$", title="(c)",
            aspect="equal", ylim=(0.55 * ky.min(), 0.55 * ky.max()))
    psi.grid(False)
    figure.colorbar(image, ax=psi, label="$\\Psi$ / m$^4$")
    return figure


def figure_3(read):
    x, y, z = grid(read("figure_3_surface"), "x_m", "y_m", "elevation_m")
    rays = read("figure_3_rays")
    figure = Figure(figsize=(7, 6))
    axes = figure.add_subplot(projection="3d", computed_zorder=False)
    for ray in rays:
        for upper, lower, colour, order in (("above", "surface", "tab:red", 3),
                                            ("surface", "bottom", "tab:green", 1)):
            axes.plot(*([ray[f"{axis}_{upper}_m"], ray[f"{axis}_{lower}_m"]] for axis in "xyz"), color=colour,
                      linewidth=0.7, zorder=order)
    axes.scatter(rays["x_bottom_m"], rays["y_bottom_m"], rays["z_bottom_m"], s=5, color="tab:green", zorder=1)
    light = LightSource(azdeg=300, altdeg=25)
    shade = light.hillshade(z.T, dx=x[1, 0] - x[0, 0], dy=y[0, 1] - y[0, 0]).T
    shade = (shade - shade.min()) / (shade.max() - shade.min())
    opaque = numpy.full_like(shade, 0.85)
    colours = numpy.stack([0.15 + 0.6 * shade, 0.4 + 0.5 * shade, 0.6 + 0.4 * shade, opaque], -1)
    surface = axes.plot_surface(x, y, z, facecolors=colours, rcount=110, ccount=110, shade=False, linewidth=0,
                                antialiased=False, zorder=2)
    surface.set_rasterized(True)
    axes.set(xlabel="downwind / m", ylabel="crosswind / m", zlabel="elevation / m",
             zticks=(-0.2, -0.1, 0, 0.1))
    axes.set_box_aspect((x.max() - x.min(), y.max() - y.min(), 0.35), zoom=0.9)
    axes.view_init(elev=22, azim=-65)
    axes.zaxis.labelpad = 12
    axes.locator_params(axis="x", nbins=5)
    axes.locator_params(axis="y", nbins=5)
    return figure


def figure_3_spot(read):
    x, y, power = grid(read("figure_3_spot"), "x_m", "y_m", "power")
    edge, (still, moved) = read("figure_3_still_spot"), read("figure_3_centroids")
    figure = Figure(figsize=(5.6, 4.6))
    axes = figure.subplots()
    image = axes.pcolormesh(x, y, power, cmap="inferno", vmin=0, vmax=4, rasterized=True)
    axes.plot(edge["x_m"], edge["y_m"], color="white", linewidth=0.8, label="edge of the spot, still water")
    axes.plot(still["x_m"], still["y_m"], "+", color="white", markersize=10, label="its centroid")
    axes.plot(moved["x_m"], moved["y_m"], "x", color="cyan", label="centroid, this surface")
    axes.set(xlabel="downwind / m", ylabel="crosswind / m", aspect="equal")
    axes.grid(False)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=3, fontsize="x-small", facecolor="dimgray",
                frameon=True, labelcolor="white")
    figure.colorbar(image, ax=axes, label="power relative to still water")
    return figure


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
