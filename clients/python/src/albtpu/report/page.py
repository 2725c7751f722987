"""report.html: the verdict first, then where it comes from."""

from __future__ import annotations

import html
import json
import pathlib
from typing import Any

from . import pictures, verdict
from .limits import COVERAGES, limit_text
from .overview import read_overview

Report = dict[str, Any]

STYLE = """
:root { --ink: #1a1a1a; --soft: #5a5a5a; --line: #d5d5d5; --good: #006d4f; --bad: #a63d00; }
* { box-sizing: border-box; }
body { font: 16px/1.45 system-ui, sans-serif; color: var(--ink); margin: 0 auto; padding: 0 16px 48px;
       max-width: 1240px; background: #fff; }
h1 { font-size: 1.35rem; margin: 16px 0 8px; }
h2 { font-size: 1.15rem; margin: 32px 0 8px; border-top: 1px solid var(--line); padding-top: 16px; }
h3 { font-size: 1rem; margin: 20px 0 4px; }
.verdict { border-left: 8px solid; padding: 10px 16px; background: #f6f6f6; }
.verdict b { font-size: 1.5rem; }
.pass { border-color: var(--good); } .pass b { color: var(--good); }
.fail { border-color: var(--bad); } .fail b { color: var(--bad); }
.verdict ul { margin: 8px 0 0; padding-left: 20px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 380px), 1fr)); gap: 12px;
            align-items: start; }
img { max-width: 100%; height: auto; display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 10px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child, .words td, .words th { text-align: left; }
.words td { white-space: normal; overflow-wrap: anywhere; }
.sortable th { cursor: pointer; } .sortable th:focus { outline: 2px solid #0072b2; }
.soft, caption { color: var(--soft); font-size: 0.9rem; text-align: left; }
.no { color: var(--bad); font-weight: 600; white-space: nowrap; overflow-wrap: normal; }
@media print { body { max-width: none; } h2 { break-after: avoid; } img, tr { break-inside: avoid; }
               .wide { overflow: visible; } }
"""

SCRIPT = """
document.querySelectorAll('.sortable').forEach(table => {
  const body = table.tBodies[0];
  table.querySelectorAll('th').forEach((head, column) => {
    head.tabIndex = 0;
    head.title = 'sort';
    const sort = () => {
      const up = head.getAttribute('aria-sort') !== 'ascending';
      table.querySelectorAll('th').forEach(other => other.removeAttribute('aria-sort'));
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const key = row => { const text = row.cells[column].dataset.value ?? row.cells[column].textContent;
                           const number = parseFloat(text.replace(/^[<>] /, ''));
                           return isNaN(number) ? text : number; };
      [...body.rows].sort((a, b) => (key(a) > key(b) ? 1 : key(a) < key(b) ? -1 : 0) * (up ? 1 : -1))
        .forEach(row => body.append(row));
    };
    head.addEventListener('click', sort);
    head.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });
  });
});
"""


def write_page(folder: pathlib.Path) -> None:
    """Makes report.html in a folder that has report.json and grid.nc."""
    report: Report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    overview = read_overview(folder / "grid.nc", report["metres_per_unit"])
    sections = [_first_screen(report), _summary(report), _maps(report, overview), _curves(report), _bands(report),
                _specifications(report), _lines(report), _crosscheck(report), _files(report), _numbers(report)]
    title = f"Uncertainty of a survey: {verdict.asked(report)}"
    page = (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>{html.escape(title)}</title><style>{STYLE}</style></head><body>\n"
            + "\n".join(sections) + f"\n<script>{SCRIPT}</script></body></html>\n")
    (folder / "report.html").write_text(page, encoding="utf-8")


def _text(value: object) -> str:
    return html.escape(str(value))


def _percent(part: float, digits: int = 1) -> str:
    """Never "100 %" of a part that is not all, nor "0 %" of one that is something."""
    shown = f"{100 * part:.{digits}f}"
    if part < 1 and float(shown) >= 100:
        return f"> {100 - 10 ** -digits:.{digits}f} %"
    if part > 0 and float(shown) <= 0:
        return f"< {10 ** -digits:.{digits}f} %"
    return f"{shown} %"


def table(head: list[str], rows: list[list[str]], kind: str = "") -> str:
    """A table in HTML, of cells that are HTML, which scrolls sideways by itself where it is too wide."""
    cells = "".join(f"<th>{each}</th>" for each in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return (f'<div class="wide"><table class="{kind}"><thead><tr>{cells}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def _first_screen(report: Report) -> str:
    wanted = report["wanted"]
    passes = wanted["passes"]
    word = "passes" if passes else "does not pass"
    points = "".join(f"<li>{_text(each)}</li>" for each in verdict.sentences(report))
    return (f"<h1>Total propagated uncertainty of the survey</h1>"
            f'<div class="verdict {"pass" if passes else "fail"}"><b>The survey {word} {_text(verdict.asked(report))}'
            f"</b><br>{_percent(wanted['fraction'], 2)} of {wanted['points']:,} points of the bottom meet it;"
            f" {wanted['pass_share']:g} % were asked for.<ul>{points}</ul></div>")


def _summary(report: Report) -> str:
    files, lines, of_all = report["files"], report["lines"], report["all"]
    rows = [["points of the bottom", f"{of_all['points']:,}, {of_all['with_number']:,} of them with a number"],
            ["files; lines", f"{len(files)}; {len(lines)} (point source ID)"],
            ["coordinate system", _text(report["crs"])],
            ["uncertainties at", COVERAGES[report["coverage"]]],
            ["table of the sea", _text(f"{report['table']['id']} {report['table']['version']}")],
            ["made by", _text(f"{report['program']} {report['program_version']}")]]
    for name in ("tvu", "thu"):
        if name in of_all:
            spread = of_all[name]
            rows.append([name.upper(), f"mean {spread['mean']:.3f}, median {spread['median']:.3f}, 95 % of the points"
                         f" below {spread['p95']:.3f}, greatest {spread['greatest']:.3f} m"])
    if "bias_vertical" in of_all:
        rows.append(["mean bias that is in the points", f"{of_all['bias_vertical']:+.3f} m (positive: too shallow);"
                     " it stands beside the uncertainty, and counts against limits"])
    return "<h2>What was surveyed</h2>" + table(["", ""], rows, "words")


def _maps(report: Report, overview: Any) -> str:
    figures = [pictures.map_of_codes(overview, "order_met", "order of S-44 that all points of a cell meet"),
               pictures.map_of_lengths(overview, "tvu", "TVU, mean of each cell"),
               pictures.map_of_lengths(overview, "thu", "THU, mean of each cell"),
               pictures.map_of_lengths(overview, "depth", "depth"),
               pictures.map_of_codes(overview, "dominant_share", "largest share of the vertical variance"),
               *pictures.maps_of_gaps(overview)]
    return (f"<h2>Maps</h2><p class='soft'>Grid north is up. Cells of {report['cell']:g} m are in grid.nc; a picture"
            f" may join several.</p><div class='pictures'>{''.join(figures)}</div>")


def _curves(report: Report) -> str:
    figures = [pictures.against_depth(report, "tvu"), pictures.against_depth(report, "thu"),
               pictures.shares_against_depth(report), pictures.over_time(report),
               pictures.histogram(report, "tvu"), pictures.histogram(report, "thu")]
    return f"<h2>Against depth</h2><div class='pictures'>{''.join(figures)}</div>"


def _bands(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for band in report["depth_bands"]:
        met = band["meeting"][wanted] / band["with_number"]
        rows.append([_band_name(band), f"{band['with_number']:,}", f"{band['tvu']['median']:.3f}",
                     f"{band['tvu']['p95']:.3f}", f"{band['thu']['median']:.3f}", f"{band['thu']['p95']:.3f}",
                     *(f"{100 * band['shares_vertical'][share]:.0f} %" for share in pictures.SHARES),
                     _judged(met, report)])
    head = ["depth [m]", "points", "TVU median [m]", "TVU 95th [m]", "THU median [m]", "THU 95th [m]",
            *pictures.SHARES, f"meet {_text(verdict.asked(report))}"]
    return ("<h2>By depth</h2><p class='soft'>Shares are of the vertical variance. Points without a number have no"
            " depth and are not in this table.</p>" + table(head, rows))


def _judged(fraction: float, report: Report, digits: int = 1) -> str:
    text = _percent(fraction, digits)
    return text if 100 * fraction >= report["wanted"]["pass_share"] else f"<span class='no'>{text}</span>"


def _specifications(report: Report) -> str:
    rows = []
    for specification in report["specifications"]:
        for of in specification["classes"]:
            rows.append([_text(specification["title"]), _text(of["name"]), COVERAGES[of["coverage"]],
                         limit_text(of["horizontal"]), limit_text(of["vertical"]), _judged(of["fraction"], report)])
    sources = "".join(f"<li>{_text(each['title'])}: {_text(each['source'])}</li>" for each in report["specifications"])
    return ("<h2>Specifications</h2><p class='soft'>A class is met where the uncertainty plus the magnitude of the bias"
            " is within each limit; d is the depth.</p>"
            + table(["specification", "class", "at", "THU limit", "TVU limit", "points that meet it"], rows)
            + f"<ul class='soft'>{sources}</ul>"
            + "<h3>By depth</h3><p class='soft'>% of the points with a number that meet each class.</p>"
            + _class_matrix(report, "depth [m]", [(_band_name(band), band["meeting"], band["with_number"])
                                                  for band in report["depth_bands"]], ""))


def _band_name(band: dict[str, Any]) -> str:
    return f"{band['from']}" + (f"–{band['to']}" if band["to"] is not None else " and more")


def _class_matrix(report: Report, what: str, rows: list[tuple[str, list[int], int]], kind: str = "sortable") -> str:
    """A row each with its name, how many points meet each class, and of how many: in %."""
    head = [what] + [f"{_text(each['title'])}<br>{_text(of['name'])}" for each in report["specifications"]
                     for of in each["classes"]]
    return table(head, [[_text(name)] + [_judged(met / points, report, 0) if points else "–" for met in meeting]
                        for name, meeting, points in rows], kind)


def _lines(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for line in report["lines"]:
        row = [str(line["line"]), f"{line['points']:,}".replace(",", ""),
               _percent(1 - line["with_number"] / line["points"])]
        for name in ("tvu", "thu"):
            row += [f"{line[name][key]:.3f}" if name in line else "–" for key in ("median", "p95")]
        shares = line.get("shares_vertical")
        row.append(max(shares, key=lambda name: shares[name]) if shares else "–")
        row.append(_judged(line["meeting"][wanted] / line["points"], report))
        rows.append(row)
    head = ["line", "points", "without number", "TVU median [m]", "TVU 95th [m]", "THU median [m]", "THU 95th [m]",
            "largest share", f"meet {_text(verdict.asked(report))}"]
    return ("<h2>Lines</h2><p class='soft'>A click on a head sorts.</p>" + table(head, rows, "sortable")
            + "<h3>Classes by line</h3><p class='soft'>% of the points that meet each class.</p>"
            + _class_matrix(report, "line", [(str(each["line"]), each["meeting"], each["points"])
                                             for each in report["lines"]]))


def _crosscheck(report: Report) -> str:
    check = report["crosscheck"]
    title = "<h2>Is the uncertainty true? Overlapping lines</h2>"
    if check is None:
        return title + "<p>No lines overlap, so that the files cannot show whether the prediction is true.</p>"
    rows = [["pairs of neighbouring points", f"{check['pairs']:,}; {check['outliers']} outliers left out"],
            ["reduced chi-square", f"{check['chi_square']:.2f} (1: as predicted); without the mean difference of each"
             f" two lines {check['chi_square_within_lines']:.2f}"],
            ["σ would have to be multiplied by", verdict.estimate_text(check["factor"])],
            ["that of the air side by", f"{verdict.estimate_text(check['factor_air'])};"
             f" it is {100 * check['air_in_variance']:.0f} % of the predicted variance"],
            ["that of the sea surface by", verdict.estimate_text(check["factor_sea"])],
            ["beyond 3 σ", f"{_percent(check['beyond_three_sigma'], 2)} (normal errors: 0.27 %)"]]
    lines = [[f"{each['a']} – {each['b']}", str(each["pairs"]), f"{each['mean_difference']:+.3f}",
              f"{each['standard_error']:.3f}" if each["standard_error"] is not None else "–"]
             for each in check["lines"][:40]]
    return (title + "<p class='soft'>Heights of neighbouring points of different lines, without the slope of the"
            " bottom, against what is predicted of pulses and lines. What all lines share (datum, index, calibration)"
            " cancels and is not tested.</p>" + table(["", ""], rows, "words")
            + f"<div class='pictures'>{pictures.chi_squares(check)}</div>"
            + table(["lines", "pairs", "mean difference [m]", "standard error [m]"], lines, "sortable"))


def _files(report: Report) -> str:
    wanted = report["wanted"]["index"]
    rows = []
    for each in report["files"]:
        outcomes = ", ".join(f"{count:,} {name}" for name, count in each["outcomes"].items() if name != "INTERPOLATED")
        wind = f"{each['wind_speed']:g} m/s" if isinstance(each["wind_speed"], (int, float)) else "–"
        sea = verdict.sea_text(each["sea"])
        met = each["meeting"][wanted] / each["points"] if each["points"] else 0
        rows.append([_text(each["name"]), f"{each['points']:,}", wind, _text(sea),
                     _text(each.get("water_attenuation") or "left out"), _text(outcomes) or "none",
                     _judged(met, report)])
    return "<h2>Files, sea and water</h2>" + table(
        ["file", "points", "wind", "sea", "attenuation of the water", "points without a number",
         f"meet {_text(verdict.asked(report))}"], rows, "words") + (
        "<h3>Classes by file</h3><p class='soft'>% of the points that meet each class.</p>"
        + _class_matrix(report, "file", [(each["name"], each["meeting"], each["points"]) for each in report["files"]]))


def _numbers(report: Report) -> str:
    rows = [[_text(each["name"].replace("_", " ")), _text(each.get("value", "")),
             "<span class='no'>assumed</span>" if each.get("assumed") else "", _text(each.get("source", ""))]
            for each in sorted(report["numbers"], key=lambda each: not each.get("assumed"))]
    return ("<h2>Numbers and assumptions</h2><p class='soft'>What was assumed comes first.</p>"
            + table(["number", "value", "", "source"], rows, "words"))
