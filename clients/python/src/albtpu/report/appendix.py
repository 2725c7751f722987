"""The uncertainty of a survey in the order of a descriptive report: B.2, sources, values and method."""

from __future__ import annotations

from .markup import percent, table, text
from .verdict import CONTRIBUTIONS, COVERAGES, SOURCES, Report, estimate_text


def surface_model(report: Report) -> str:
    """The table of the sea surface; its version says nothing where it was computed for the sea of the files."""
    model = report["table"]
    if model["id"] == "sea":
        return "computed for the described sea"
    return f"table {model['id']}, version {model['version']}"


def appendix(report: Report) -> str:
    """Section B.2."""
    return ("<h2>Appendix: B.2 Quality control, uncertainty</h2>" + _method(report) + _sources(report)
            + _results(report))


def _method(report: Report) -> str:
    datum = report.get("vertical_datum")
    elevations = f"in the vertical datum {text(datum)}" if datum else "in a vertical datum that the files do not state"
    return ("<h3>B.2.1 Method</h3><p>The uncertainty of each point is the sum of the covariances of sensor and"
            " trajectory, sea surface, water column and datum, propagated along the refracted beam of its pulse. THU"
            f" and TVU are stated at {COVERAGES[report['coverage']]}; biases are stated apart, and their magnitude is"
            " added where limits are compared. Water-surface model used for refraction: "
            f"{text(surface_model(report))}. Elevations are {elevations};"
            " depths are below the water surface at the time of the flight.</p>")


def _sources(report: Report) -> str:
    assumed = report.get("assumed")
    parts = ["<h3>B.2.2 Sources and values</h3>"]
    if assumed is None:
        parts.append("<p>Contributions by source are not known: an earlier version annotated the files.</p>")
    else:
        numbers = {each["name"]: each for each in report["numbers"]}
        rows = []
        for name, of in assumed["sources"].items():
            number = numbers.get({"extra": "extra_vertical"}.get(name, name), {})
            rows.append([text(SOURCES.get(name, name)), text(number.get("value", "–")),
                         percent(of["horizontal"]), percent(of["vertical"]),
                         text("not supplied, assumed" if number.get("assumed") else number.get("source", "–"))])
        rows.sort(key=lambda row: row[0])
        parts.append(table(["source", "value, 1σ", "of the horizontal variance", "of the vertical variance",
                            "supplied by"], rows, "words"))
        parts.append(f"<p class='soft'>How: {text(assumed['how'])}; {assumed['samples']:.0f} samples.</p>")
    return "".join(parts)


def contributions(report: Report) -> str:
    """Standard deviations and biases by depth, horizontally and vertically."""
    bands = report.get("contributions")
    if not bands:
        return ("<h3>Contributions by depth</h3><p class='soft'>Not known: an earlier version annotated the"
                " files.</p>")
    names = [name for name in CONTRIBUTIONS
             if name != "extra" or any(band[axis]["extra"] > 0 for band in bands
                                       for axis in ("sigma_horizontal", "sigma_vertical"))]
    horizontal = [*(name for name in names if name != "datum"), "total"]  # Nothing of the datum is horizontal.
    vertical = [*names, "total"]
    rows = []
    for band in bands:
        depth = f"{band['from']:g}" + (f"–{band['to']:g}" if band["to"] is not None else " and more")
        rows.append([depth, f"{band['points']:,.0f}", *(f"{band['sigma_horizontal'][name]:.3f}" for name in horizontal),
                     *(f"{band['sigma_vertical'][name]:.3f}" for name in vertical),
                     f"{band['bias_along_beam']:+.3f}", f"{band['bias_vertical']:+.3f}"])
    groups = [("", 2), ("horizontal", len(horizontal)), ("vertical", len(vertical)), ("mean bias", 2)]
    head = ["depth [m]", "points", *(CONTRIBUTIONS.get(name, name) for name in [*horizontal, *vertical]),
            "along the beam", "upwards"]
    return ("<h3>Contributions and biases by depth</h3><p class='soft'>Standard deviations in m (1σ, roots of the mean"
            " variances), horizontal ones radial; means of the biases in m.</p>" + table(head, rows, "matrix", groups))


def _results(report: Report) -> str:
    wanted, check = report["wanted"], report["crosscheck"]
    parts = ["<h3>B.2.3 Results and their test</h3><p>THU and TVU are within the limits at"
             f" {percent(wanted['fraction'], 2)} of {wanted['points']:,} points."]
    if check is not None:
        parts.append(f" Crosslines and overlapping lines: {text(check['conclusion'])}; σ of pulses would have to be"
                     f" multiplied by {text(estimate_text(check['factor_pulse']))}.")
    else:
        parts.append(" No overlapping lines test the prediction.")
    return "".join(parts) + "</p>"
