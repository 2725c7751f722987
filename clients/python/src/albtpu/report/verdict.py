"""What a report says in words: where a survey fails, why, which line is the worst, and what would help most."""

from __future__ import annotations

from typing import Any

from .markup import line_name, percent

Report = dict[str, Any]

COVERAGES = {"p95": "95 %", "2sigma": "2σ", "1sigma": "1σ"}

OUTCOMES = {"NO_TRAJECTORY": "no trajectory at their time",
            "UNCERTAIN_TRAJECTORY": "a trajectory too uncertain to give an incidence",
            "NO_SURFACE": "no water surface known above them",
            "NO_SEA": "no state of the sea at their time",
            "ABOVE_WATER": "they lie above the water",
            "DRY": "they lie above the water",
            "NO_CHANNEL": "of a scanner that [[sensor.channel]] does not map",
            "NO_WATER": "outside the table of the water column",
            "UNKNOWN": "a reason that the summaries do not name",
            "INVALID": "invalid numbers"}

CONTRIBUTIONS = {"air": "sensor and trajectory", "sea": "sea surface", "water": "water column", "datum": "datum",
                 "extra": "added by the surveyor"}

SOURCES = {"position": "position of the trajectory", "attitude": "attitude of the trajectory", "boresight": "boresight",
           "lever_arm": "lever arm", "scan": "scan angle", "time": "clock", "range_offset": "range offset",
           "bottom_range": "range to the bottom", "surface_range": "range to the surface",
           "surface_height": "height of the water surface", "index": "refractive index", "sea": "sea surface",
           "water": "water column", "datum": "vertical datum", "extra": "added by the surveyor"}

REMEDIES = {"air": "sensor and trajectory (scan angles, ranges, calibration): better numbers for the sensor, or a"
                   " lower flight",
            "sea": "the sea surface: a calmer sea, or smaller incidence",
            "water": "the water column: a measured attenuation, or bias = \"correct\"",
            "datum": "the vertical datum: a better separation model, or delivery above the ellipsoid",
            "extra": "what [extra] of the survey file adds: a smaller number, where it can be shown"}


def asked(report: Report) -> str:
    """ "IHO S-44 1b" """
    return f"{report['wanted']['specification']} {report['wanted']['class']}"


def headline(report: Report) -> str:
    """What was tested, and what was found: THU and TVU of points against limits."""
    wanted = report["wanted"]
    share, of = percent(wanted["fraction"], 2), f"{wanted['points']:,} points of the bottom"
    found = (f"THU and TVU are within the limits of {asked(report)} at {share} of {of} (at least"
             f" {wanted['pass_share']:g} % required)" if wanted["passes"] else
             f"THU and TVU are not within the limits of {asked(report)}: they are at only {share} of {of} (at least"
             f" {wanted['pass_share']:g} % required)")
    but = "but" if wanted["passes"] else "and"
    return f"{found}, {but} overlapping lines contradict the prediction" if contradicted(report) else found


def contradicted(report: Report) -> bool:
    """Do overlapping lines differ from the prediction?"""
    return report["crosscheck"] is not None and report["crosscheck"]["agrees"] is False


def standing(report: Report) -> str:
    """ "fail" of limits, "open" where the numbers are not tested by overlap, or contradicted, or assumed; or "pass"."""
    if not report["wanted"]["passes"]:
        return "fail"
    return "open" if doubts(report) else "pass"


def doubts(report: Report) -> list[str]:
    """Why limits that are met are not yet proof, or what else is wrong where they are not."""
    check, assumed, wanted = report["crosscheck"], report.get("assumed"), report["wanted"]
    found = []
    if check is None:
        found.append("No overlapping lines test the prediction.")
    elif not check["agrees"]:
        found.append(f"{_sentence(check['conclusion'])}.")
    if assumed is None:
        found.append("How much of the variance rests on assumed numbers is not known.")
    elif assumed["share"] > assumed["greatest_for_green"]:
        found.append(f"More than a third of the variance, {percent(assumed['share'])}, rests on assumed numbers.")
    for key, what in (("with_factor", "points, with the factor of the overlap applied,"), ("nodes", "the nodes")):
        if wanted.get(key) is not None and not wanted[key]["passes"]:
            found.append(f"Only {percent(wanted[key]['fraction'])} of {what} are within the limits.")
    return found


def _sentence(words: str) -> str:
    return words[:1].upper() + words[1:]


def sentences(report: Report) -> list[str]:
    """Is the prediction right, where and why does a survey fail, what helps, what is untested."""
    found = [_help(report), _assumption(report), _truth(report), *_with_factor(report), *_nodes(report),
             *_gaps(report), *_depths(report), *_lines(report), NOT_TESTED]
    return [each for each in found if each]


def beside(report: Report) -> list[tuple[str, str, str]]:
    """What stands beside the verdict, equally large: a title, the number, and what it is."""
    return [_assumed(report), _differences(report), _density(report), _voids(report), _also(report)]


def _assumed(report: Report) -> tuple[str, str, str]:
    assumed = report.get("assumed")
    count = sum(1 for each in report["numbers"] if each.get("assumed"))
    numbers = f"{count} of {len(report['numbers'])} numbers were assumed; they are listed at the end"
    if assumed is None:
        return ("Rests on assumed numbers", "not known", f"An earlier version annotated the files. {numbers}.")
    return ("Rests on assumed numbers", percent(assumed["share"]),
            f"of the variance: {percent(assumed['horizontal'])} horizontally, {percent(assumed['vertical'])}"
            f" vertically; more than a third is not green. {numbers}.")


def _differences(report: Report) -> tuple[str, str, str]:
    check = report["crosscheck"]
    if check is None or not check["lines"]:
        return ("Differences between lines", "not tested", nothing_to_compare(report))
    lines = check["lines"]
    mean = sum(abs(each["mean_difference"]) for each in lines) / len(lines)
    worst = max(lines, key=lambda each: abs(each["z"]))
    return ("Differences between lines", f"{mean:.3f} m",
            f"mean of {len(lines)} pairs of lines. The worst pair, {line_name(worst, 'a')} and {line_name(worst, 'b')},"
            f" differs by {abs(worst['mean_difference']):.3f} m, {difference_text(worst)}.{_standing_out(lines)}")


def _standing_out(lines: list[dict[str, Any]]) -> str:
    """The line that lies above, or below, each of at least two others, and by the most in the mean."""
    above: dict[str, list[float]] = {}
    for each in lines:
        above.setdefault(line_name(each, "a"), []).append(each["mean_difference"])
        above.setdefault(line_name(each, "b"), []).append(-each["mean_difference"])
    of_line = {line: sum(values) / len(values) for line, values in above.items()
               if len(values) > 1 and (min(values) > 0 or max(values) < 0)}
    if not of_line:
        return ""
    line = max(of_line, key=lambda each: abs(of_line[each]))
    side = "above" if of_line[line] > 0 else "below"
    return (f" Line {line} lies {side} all {len(above[line])} lines that it overlaps, by {abs(of_line[line]):.3f} m in"
            " the mean.")


def _density(report: Report) -> tuple[str, str, str]:
    bottom = report["bottom"]
    of_cell = bottom["points_of_covered_cells"]
    return ("Density of the bottom", f"{bottom['points_per_square_metre']:.2f} per m²",
            f"a spacing of {bottom['spacing']:.2f} m. Cells of {bottom['cell']:g} m that have any have"
            f" {of_cell['median']} in the median, at least {of_cell['p5']} in 95 % of them.")


def _voids(report: Report) -> tuple[str, str, str]:
    bottom = report["bottom"]
    largest = bottom["largest_void"]
    if largest is None:
        return ("Voids", percent(0), f"Every cell of {bottom['cell']:g} m in the surveyed area has a point of the"
                " bottom.")
    return ("Voids", percent(bottom["empty_share"]),
            f"of the surveyed cells of {bottom['cell']:g} m have no bottom. The largest void has"
            f" {largest['area']:,.0f} m², at {largest['x']:.1f}, {largest['y']:.1f};"
            f" {bottom['large_voids']:,} have {bottom['large_void_area']:.1f} m² or more (4 spacings squared).")


def also(report: Report) -> str | None:
    """What the wanted class asks beside THU and TVU."""
    for specification in report["specifications"]:
        for entry in specification["classes"]:
            if entry["index"] == report["wanted"]["index"]:
                text: str | None = entry.get("also")
                return text
    return None


def _also(report: Report) -> tuple[str, str, str]:
    words = also(report)
    return (f"{asked(report)} also asks", "not tested",
            f"{words[:1].upper()}{words[1:]}. Density and voids are what files can show of it." if words else
            "What else the specification asks, these files cannot show.")


def _with_factor(report: Report) -> list[str]:
    factor = report["wanted"].get("with_factor")
    if factor is None:
        return []
    return [f"With the factor of the overlap, {factor['factor']:.2f}, applied to every σ, {percent(factor['fraction'])}"
            f" of the points are within the limits: {'enough' if factor['passes'] else 'too few'}."]


def _nodes(report: Report) -> list[str]:
    nodes = report["wanted"].get("nodes")
    if nodes is None:
        return []
    return [f"Of the surface's {nodes['nodes']:,} nodes of {nodes['cell']:g} m, {percent(nodes['fraction'])} are within"
            f" the limits: {'enough' if nodes['passes'] else 'too few'}."]


def limit_text(limit: dict[str, Any] | None) -> str:
    """ "√(0.5² + (0.013 d)²) m" """
    if limit is None:
        return "–"
    if limit["of_depth"] == 0:
        return f"{limit['constant']:g} m"
    if limit["combined"] == "rss":
        return f"√({limit['constant']:g}² + ({limit['of_depth']:g} d)²) m"
    return f"{limit['constant']:g} m + {100 * limit['of_depth']:g} % d"


def estimate_text(estimate: dict[str, Any]) -> str:
    """ "1.02 (95 %: 0.96 to 1.08)" """
    if estimate["value"] is None:
        return "not known"
    if estimate["value"] < 0.005:  # The differences are no larger than those of the other parts.
        return "0: no such error shows" + (f" (95 %: at most {estimate['high']:.2f})" if estimate["high"] else "")
    if estimate["low"] is None:
        return f"{estimate['value']:.2f} (a single overlap gives no interval)"
    return f"{estimate['value']:.2f} (95 %: {estimate['low']:.2f} to {estimate['high']:.2f})"


def outcome_text(name: str) -> str:
    """An outcome in words."""
    if name.startswith("OUT_OF_DOMAIN"):
        return f"outside the table ({name.partition(':')[2].replace(':', ' ')})"
    return OUTCOMES.get(name, name)


def sea_text(sea: object) -> str:
    """The waves in a few words, without the wind."""
    if not isinstance(sea, dict):
        return "from the wind"
    parts = []
    if sea.get("file"):
        parts.append(f"{sea['file']}{', ' + sea['place'] if sea.get('place') else ''}")
    facts = [sea[key] for key in ("first", "last") if isinstance(sea.get(key), dict)]
    for key, name, unit in (("significant_wave_height", "Hs", "m"), ("peak_period", "Tp", "s")):
        values = [each[key] for each in facts if isinstance(each.get(key), (int, float))]
        if values:
            low, high = f"{min(values):.2g}", f"{max(values):.2g}"
            parts.append(f"{name} {low if low == high else f'{low} to {high}'} {unit}")
    if sea.get("by_time"):
        parts.append("interpolated to the time of each pulse")
    return "; ".join(parts) or "waves as given"


def _gaps(report: Report) -> list[str]:
    wanted = report["wanted"]
    gaps = wanted["points"] - wanted["with_number"]
    if gaps == 0:
        return []
    why = sorted(wanted["without_number"].items(), key=lambda each: -each[1])
    words = "; ".join(f"{count:,}: {outcome_text(name)}" for name, count in why)
    return [f"{gaps:,} points ({100 * gaps / wanted['points']:.1f} %) have no uncertainty computed and count as not"
            f" meeting it ({words})."]


def _depths(report: Report) -> list[str]:
    index, share = report["wanted"]["index"], report["wanted"]["pass_share"] / 100
    bad = [band for band in report["depth_bands"] if band["meeting"][index] < share * band["with_number"]]
    if not bad:
        failing = report["wanted"]["failing"]["points"]
        if failing == 0 and report["wanted"]["with_number"] > 0:
            return [f"Every point with an uncertainty meets {asked(report)}, at all depths."]
        return [] if report["wanted"]["with_number"] == 0 else ["Of the points with an uncertainty, enough meet"
                                                                f" {asked(report)} at all depths."]
    text = ", ".join(f"{band['from']}{'–' + str(band['to']) if band['to'] is not None else ' and more'} m"
                     f" ({100 * band['meeting'][index] / band['with_number']:.0f} %)" for band in bad)
    return [f"Too few points with an uncertainty meet {asked(report)} at depths of {text}."]


def _lines(report: Report) -> list[str]:
    index = report["wanted"]["index"]
    lines = [line for line in report["lines"] if line["points"]]
    if len(lines) < 2:
        return []
    worst = min(lines, key=lambda line: line["meeting"][index] / line["points"])
    fraction = worst["meeting"][index] / worst["points"]
    if fraction < 1:
        gaps = 1 - worst["with_number"] / worst["points"]
        return [f"The worst line is {line_name(worst)}: {100 * fraction:.1f} % of its points meet it,"
                f" {100 * gaps:.1f} % have no uncertainty computed."]
    worst = max((line for line in lines if "tvu" in line), key=lambda line: line["tvu"]["p95"])
    return [f"No line fails; line {line_name(worst)} has the largest TVU ({worst['tvu']['p95']:.3f} m at its 95th"
            " percentile)."]


def _help(report: Report) -> str:
    wanted = report["wanted"]
    failing = wanted["failing"]
    gaps = wanted["points"] - wanted["with_number"]
    if gaps > failing["points"] and gaps > 0.001 * wanted["points"]:
        name = max(wanted["without_number"], key=lambda each: wanted["without_number"][each], default="")
        words = f"What would help most: an uncertainty for the points that have none ({outcome_text(name)})."
        return words if name else ""
    shares = report["all"].get("shares_vertical")
    if not shares:
        return ""
    if failing["points"]:
        share = max(failing["largest_share"], key=lambda each: failing["largest_share"][each])
        count = failing["largest_share"][share]
        return (f"What would help most: {REMEDIES[share]}. It is the largest contribution to the vertical variance at"
                f" {100 * count / failing['points']:.0f} % of the points that do not meet it.")
    share = max(shares, key=lambda each: shares[each])
    return (f"The largest contribution to the vertical variance, {100 * shares[share]:.0f} %, is that of"
            f" {REMEDIES[share]}.")


def _assumption(report: Report) -> str:
    """What would help most where too much was assumed."""
    assumed = report.get("assumed")
    if assumed is None or assumed["share"] <= assumed["greatest_for_green"]:
        return ""
    axis = "vertical" if assumed["vertical"] >= assumed["horizontal"] else "horizontal"
    names = {each["name"] for each in report["numbers"] if each.get("assumed")}
    of_source = {name: of[axis] for name, of in assumed["sources"].items()
                 if name in names or (name == "water" and any(each.startswith("water_") for each in names))}
    if not of_source:
        return ""
    name = max(of_source, key=lambda each: of_source[each])
    return (f"What would help most against assumptions: state the uncertainty of the {SOURCES.get(name, name)}; the"
            f" assumed one makes {percent(of_source[name])} of the {axis} variance.")


def nothing_to_compare(report: Report) -> str:
    """Why overlapping lines say nothing, where the report has no cross-check."""
    reason = report.get("nothing_to_compare", "no lines overlap")
    return f"{reason[:1].upper()}{reason[1:]}, so the files cannot show whether the prediction is right."


# What all lines share, and what an order also asks, which points alone cannot show.
SHARED = "lever arm, boresight, clock, index, water level, datum"
NOT_TESTED = ("Not tested, because these files cannot show it: coverage and feature detection; errors that all lines"
              f" share ({SHARED}).")


def _truth(report: Report) -> str:
    check = report["crosscheck"]
    if check is None:  # It stands above, beside the verdict.
        return ""
    text = "" if contradicted(report) else f"{_sentence(check['conclusion'])}. "  # A contradiction stands above.
    text += f"σ of pulses would have to be multiplied by {estimate_text(check['factor_pulse'])}"
    if check["factor_line"] is not None:
        text += f", σ of lines by {estimate_text(check['factor_line'])}"
    if check["lines"]:
        worst = max(check["lines"], key=lambda each: abs(each["z"]))
        text += (f". The worst difference of two lines ({worst['a']} and {worst['b']}) is"
                 f" {abs(worst['mean_difference']):.3f} m, {difference_text(worst)}")
    return text + "."


def difference_text(line: dict[str, Any]) -> str:
    """ "1.4 σ: as predicted" """
    return f"{abs(line['z']):.1f} σ: {'as predicted' if line['as_predicted'] else 'more than predicted'}"
