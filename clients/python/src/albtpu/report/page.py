"""report.html: the verdict first, then its reasons."""

from __future__ import annotations

import json
import pathlib
from typing import Any

from . import appendix, charts, maps, project, verdict
from .markup import line_name, numbers_table, percent, table, text, tiles, verdict_box, write_document
from .verdict import CONTRIBUTIONS, COVERAGES, Report, limit_text


def write_page(folder: pathlib.Path) -> None:
    """Makes report.html in a folder that has report.json and grid.nc."""
    report: Report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    overview = maps.read_overview(folder / "grid.nc", report["metres_per_unit"])
    sections = [_first_screen(report), _summary(report), _maps(report, overview), _curves(report), _bands(report),
                _specifications(report), _bottom(report), _land(report), _lines(report), _crosscheck(report),
                _files(report), _numbers(report), appendix.appendix(report), project.signatures(report)]
    write_document(folder / "report.html", f"Uncertainty of a survey: {verdict.asked(report)}",
                   "\n" + "\n".join(sections), project.foot(report))


def _first_screen(report: Report) -> str:
    return (project.head(report) + verdict_box(verdict.standing(report), verdict.headline(report),
                                               [text(each) for each in verdict.doubts(report)])
            + tiles(verdict.beside(report))
            + "<ul>" + "".join(f"<li>{text(each)}</li>" for each in verdict.sentences(report)) + "</ul>")


def _summary(report: Report) -> str:
    files, lines, of_all = report["files"], report["lines"], report["all"]
    rows = [["points of the bottom", f"{of_all['points']:,}, {of_all['with_number']:,} of them with an uncertainty"],
            ["files; lines", f"{len(files)}; {len(lines)} (point source ID)"],
            ["coordinate system", text(report["crs"])],
            ["vertical datum of elevations", text(report.get("vertical_datum") or "not stated by the files; give"
                                                  " [datum] name")],
            ["depths", "below the water surface at the time of the flight"],
            ["uncertainties at", COVERAGES[report["coverage"]]],
            ["water-surface model used for refraction", text(appendix.surface_model(report))],
            ["made by", text(f"{report['program']} {report['program_version']}")]]
    for name in ("tvu", "thu"):
        if name in of_all:
            spread = of_all[name]
            rows.append([name.upper(), f"mean {spread['mean']:.3f}, median {spread['median']:.3f}, 95 % of the points"
                         f" below {spread['p95']:.3f}, maximum {spread['greatest']:.3f} m"])
    if "elevation" in of_all:
        spread = of_all["elevation"]
        rows.append(["elevations", f"{spread['least']:.2f} to {spread['greatest']:.2f} m, mean {spread['mean']:.2f} m"])
    if "bias_vertical" in of_all:
        rows.append(["mean bias left in the points", f"{of_all['bias_vertical']:+.3f} m upwards (positive: too"
                     f" shallow), {of_all['bias_along_beam']:+.3f} m along the beam; it is not part of the uncertainty,"
                     " and counts against limits"])
    return "<h2>What was surveyed</h2>" + table(["", ""], rows, "words")


def _maps(report: Report, overview: maps.Overview) -> str:
    figures = [maps.plan_of_lines(report, overview),
               maps.map_of_codes(overview, "order_met", "order of S-44 that all points of a cell meet"),
               maps.map_of_lengths(overview, "tvu", "TVU, mean of each cell"),
               maps.map_of_lengths(overview, "thu", "THU, mean of each cell"),
               maps.map_of_lengths(overview, "elevation",
                                   f"elevation, {report.get('vertical_datum') or 'datum not stated'}"),
               maps.map_of_lengths(overview, "depth", "depth below the water at the time of the flight"),
               maps.map_of_codes(overview, "dominant_share", "largest contribution to the vertical variance"),
               *maps.maps_of_gaps(overview)]
    return (f"<h2>Maps</h2><p class='soft'>Grid north is up; coordinates are those of {text(report['crs'])}. Cells of"
            f" {report['cell']:g} m are in grid.nc; a picture may combine several.</p>"
            f"<div class='pictures'>{''.join(figures)}</div>")


def _curves(report: Report) -> str:
    figures = [charts.against_depth(report, "tvu"), charts.against_depth(report, "thu"),
               *charts.shares_against_depth(report), charts.over_time(report),
               charts.histogram(report, "tvu"), charts.histogram(report, "thu")]
    return f"<h2>Against depth</h2><div class='pictures'>{''.join(figures)}</div>"


def _bands(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for band in report["depth_bands"]:
        met = band["meeting"][wanted] / band["with_number"]
        rows.append([_band_name(band), f"{band['with_number']:,}", f"{band['tvu']['median']:.3f}",
                     f"{band['tvu']['p95']:.3f}", f"{band['thu']['median']:.3f}", f"{band['thu']['p95']:.3f}",
                     f"{band['elevation']['mean']:.2f}", _judged(met, report)])
    head = ["depth [m]", "points", "TVU median [m]", "TVU 95th [m]", "THU median [m]", "THU 95th [m]",
            "mean elevation [m]", f"meet {text(verdict.asked(report))}"]
    return ("<h2>By depth</h2><p class='soft'>Points whose uncertainty was not computed have no depth and are not in"
            " this table.</p>" + table(head, rows) + appendix.contributions(report))


def _judged(fraction: float, report: Report, digits: int = 1) -> str:
    shown = percent(fraction, digits)
    return shown if 100 * fraction >= report["wanted"]["pass_share"] else f"<span class='no'>{shown}</span>"


def _specifications(report: Report) -> str:
    rows = []
    for specification in report["specifications"]:
        for entry in specification["classes"]:
            rows.append([text(specification["title"]), _short(entry["name"]), _unbroken(COVERAGES[entry["coverage"]]),
                         _unbroken(limit_text(entry["horizontal"])), _unbroken(limit_text(entry["vertical"])),
                         text(entry.get("also") or "–"), _judged(entry["fraction"], report)])
    return ("<h2>Specifications</h2><p class='soft'>A class is met where the uncertainty plus the magnitude of the bias"
            " is within each limit; d is the depth.</p>"
            + table(["specification", "class", "at", "THU limit", "TVU limit", "also asks (not tested)",
                     "points that meet it"],
                    rows, "words")
            + _sources(report["specifications"])
            + "<h3>By depth</h3><p class='soft'>% of the points with an uncertainty that meet each class.</p>"
            + _class_matrix(report, "depth [m]", [(_band_name(band), band["meeting"], band["with_number"])
                                                  for band in report["depth_bands"]], "matrix"))


def _sources(specifications: list[dict[str, Any]]) -> str:
    items = "".join(f"<li>{text(each['title'])}{_edition(each)}: {text(each['source'])}</li>"
                    for each in specifications)
    return f"<ul class='soft'>{items}</ul>"


def _short(name: str) -> str:
    return _unbroken(text(name)) if len(name) <= 12 else text(name)


def _unbroken(words: str) -> str:
    return f"<span class='unbroken'>{words}</span>"


def _bottom(report: Report) -> str:
    bottom = report["bottom"]
    of_cell, largest = bottom["points_of_covered_cells"], bottom["largest_void"]
    rows = [["surveyed area", f"{bottom['surveyed_area']:,.0f} m²: cells between points of the bottom along their row"
             " and along their column, without land"],
            ["cells with bottom", f"{percent(bottom['covered_share'])} of the surveyed cells of {bottom['cell']:g} m"],
            ["points of the bottom", f"{bottom['points_per_square_metre']:.2f} in a m², a spacing of"
             f" {bottom['spacing']:.2f} m; in cells that have any {of_cell['mean']:.1f} in the mean,"
             f" {of_cell['median']} in the median, at least {of_cell['p5']} in 95 %"],
            ["voids", f"{bottom['voids']:,}, of which {bottom['large_voids']:,} have at least"
             f" {bottom['large_void_area']:.1f} m²"]]
    if largest is not None:
        rows.append(["largest void", f"{largest['area']:,.0f} m², about {largest['x']:.1f}, {largest['y']:.1f}"])
    asks = verdict.also(report)
    if asks:
        rows.append([f"{text(verdict.asked(report))} asks", text(asks)])
    rows.append(["USGS Lidar Base Specification asks", "no voids of (4 × the aggregate nominal pulse spacing)² and more"
                 " but for water and dark surfaces, and first returns in 90 % of the cells of twice that spacing"])
    return ("<h2>Density and voids</h2><p class='soft'>What files can show of the coverage. Only points of the bottom"
            " count: a void may be deep or turbid water, or a gap between lines.</p>" + table(["", ""], rows, "words"))


def _edition(specification: dict[str, Any]) -> str:
    edition = specification.get("edition")
    return f", edition {text(edition)}" if edition else ""


def _land(report: Report) -> str:
    land = report.get("land")
    if not land:
        return ""
    checked, against = land["check_points"], land["against"]
    rows = [_rmse_row("all", land)] + [_rmse_row(f"{each['class']}", each) for each in land["by_class"]]
    parts = ["<h2>Land</h2><p class='soft'>Dry points, which the verdict does not judge: standard deviations of single"
             " points, and the root mean square errors of all, horizontal ones radial."]
    if land["water_surface_points"]:
        parts.append(f" {land['water_surface_points']:,} points of the water surface are not among them.")
    parts.append("</p>" + table(["class of LAS", "points", "σ horizontal median [m]", "95th [m]",
                                 "σ vertical median [m]", "95th [m]", "RMSE horizontal [m]", "RMSE vertical [m]",
                                 "RMSE 3D [m]"], rows))
    if checked["rmse_horizontal"] or checked["rmse_vertical"]:
        parts.append(f"<p>Check points with an RMSE of {checked['rmse_horizontal']:g} m horizontally and"
                     f" {checked['rmse_vertical']:g} m vertically will differ from the points by"
                     f" {against['difference_horizontal']:.3f} m and {against['difference_vertical']:.3f} m (RMSE);"
                     f" {against['judged_horizontal']:.3f} m and {against['judged_vertical']:.3f} m, which have the"
                     " errors of the check points once more, are held against the classes.</p>")
    classes = [[text(each["specification"]), text(each["name"]), _metres(each["horizontal"]),
                _metres(each["vertical"]), "yes" if each["met"] else "<span class='no'>no</span>"]
               for each in land["classes"]]
    if classes:
        parts.append(table(["specification", "class", "RMSE horizontal", "RMSE vertical", "met"], classes))
        parts.append(_sources([each for each in report["made_from"]["specifications"] if each["land"]]))
    return "".join(parts)


def _rmse_row(name: str, of: dict[str, Any]) -> list[str]:
    sigmas = [f"{of[key][at]:.3f}" for key in ("sigma_horizontal", "sigma_vertical") for at in ("median", "p95")]
    return [text(name), f"{of['points']:,}", *sigmas,
            *(f"{of[key]:.3f}" for key in ("rmse_horizontal", "rmse_vertical", "rmse_3d"))]


def _metres(length: float | None) -> str:
    return "–" if length is None else f"{length:g} m"


def _band_name(band: dict[str, Any]) -> str:
    return f"{band['from']}" + (f"–{band['to']}" if band["to"] is not None else " and more")


def _class_matrix(report: Report, what: str, rows: list[tuple[str, list[int], int]],
                  kind: str = "sortable matrix") -> str:
    """The percentage of points that meet each class. A row is a name, the points that meet each class, all points."""
    head = [what] + [text(entry["name"]) for each in report["specifications"] for entry in each["classes"]]
    groups = [("", 1), *((text(each["title"]), len(each["classes"])) for each in report["specifications"])]
    return table(head, [[text(name)] + [_judged(met / points, report, 0).replace(" %", "") if points else "–"
                                        for met in meeting]
                        for name, meeting, points in rows], kind, groups)


def _lines(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for line in report["lines"]:
        row = [line_name(line), f"{line['points']:,}".replace(",", ""),
               percent(1 - line["with_number"] / line["points"])]
        for name in ("tvu", "thu"):
            row += [f"{line[name][key]:.3f}" if name in line else "–" for key in ("median", "p95")]
        shares = line.get("shares_vertical")
        row.append(CONTRIBUTIONS[max(shares, key=lambda name: shares[name])] if shares else "–")
        row.append(_judged(line["meeting"][wanted] / line["points"], report))
        rows.append(row)
    head = ["line", "points", "uncertainty not computed", "TVU median [m]", "TVU 95th [m]", "THU median [m]",
            "THU 95th [m]", "largest contribution", f"meet {text(verdict.asked(report))}"]
    return ("<h2>Lines</h2><p class='soft screen'>Click the head of a column to sort.</p>"
            + table(head, rows, "sortable")
            + "<h3>Classes by line</h3><p class='soft'>% of the points that meet each class.</p>"
            + _class_matrix(report, "line", [(line_name(each), each["meeting"], each["points"])
                                             for each in report["lines"]]))


def _crosscheck(report: Report) -> str:
    check = report["crosscheck"]
    title = "<h2>Is the predicted uncertainty right? Overlapping lines</h2>"
    if check is None:
        return f"{title}<p>{text(verdict.nothing_to_compare(report))}</p>"
    rows = [["pairs of neighbouring points", f"{check['pairs']:,}; {check['outliers']} outliers left out"],
            ["reduced chi-square", f"{check['chi_square']:.2f} (1: as predicted); without the mean difference of each"
             f" two lines {check['chi_square_within_lines']:.2f}"],
            ["σ of pulses would have to be multiplied by", verdict.estimate_text(check["factor_pulse"])],
            ["of the sensor (scan angles, ranges)", verdict.estimate_text(check["factor_air"])],
            ["of the sea surface", verdict.estimate_text(check["factor_sea"])],
            ["σ of lines would have to be multiplied by", verdict.estimate_text(check["factor_line"])
             if check["factor_line"] is not None else "no error of a trajectory is predicted"],
            ["beyond 3 σ", f"{percent(check['beyond_three_sigma'], 2)} (normal errors: 0.27 %)"]]
    lines = [[" – ".join(line_name(each, end) for end in "ab"), str(each["pairs"]), f"{each['mean_difference']:+.3f}",
              f"{each['standard_error']:{'.1g' if each['standard_error'] < 0.0005 else '.3f'}}",
              f"{each['predicted']:.3f}", verdict.difference_text(each)]
             for each in check["lines"][:40]]
    return (title + "<p class='soft'>Heights of neighbouring points of different lines, corrected for the slope"
            " of the bottom, against the prediction for pulses and lines. Errors that all lines share"
            f" ({verdict.SHARED}) cancel and are not tested.</p>"
            + table(["", ""], rows, "words") + f"<div class='pictures'>{charts.chi_squares(check)}</div>"
            + table(["lines", "pairs", "mean difference [m]", "standard error [m]",
                     "σ of both trajectories [m]", ""], lines, "sortable"))


def _water(file: Report) -> str:
    attenuation = file.get("water_attenuation") or "left out"
    return f"{file['water_entered']}: {attenuation}" if file.get("water_entered") else attenuation


def _files(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for each in report["files"]:
        outcomes = ", ".join(f"{count:,}: {verdict.outcome_text(name)}" for name, count in each["outcomes"].items()
                             if name != "INTERPOLATED")
        wind = f"{each['wind_speed']:g} m/s" if isinstance(each["wind_speed"], (int, float)) else "–"
        sea = verdict.sea_text(each["sea"])
        met = each["meeting"][wanted] / each["points"] if each["points"] else 0
        rows.append([text(each["name"]), f"{each['points']:,}", wind, text(sea),
                     text(_water(each)), text(outcomes) or "none",
                     _judged(met, report)])
    return "<h2>Files, sea and water</h2>" + table(
        ["file", "points", "wind", "sea", "water as entered, and its attenuation", "uncertainty not computed",
         f"meet {text(verdict.asked(report))}"], rows, "words") + (
        "<h3>Classes by file</h3><p class='soft'>% of the points that meet each class.</p>"
        + _class_matrix(report, "file", [(each["name"], each["meeting"], each["points"]) for each in report["files"]]))


def _numbers(report: Report) -> str:
    return ("<h2>Numbers and assumptions</h2><p class='soft'>Assumed values are listed first.</p>"
            + numbers_table(report["numbers"]))
