"""The head of a report and its end: the project, where and when it was flown, and who signs."""

from __future__ import annotations

from .markup import definitions, text
from .verdict import Report

NAMES = {"number": "number", "client": "client", "surveyor": "surveyor", "area": "area", "aircraft": "aircraft",
         "remarks": "remarks"}


def name(report: Report) -> str:
    """That of the project, if it has one."""
    project = report.get("project") or {}
    return str(project.get("name", ""))


def dates(report: Report) -> str:
    """When it was flown, as the surveyor says or by the times of the points."""
    project, surveyed = report.get("project") or {}, report.get("surveyed")
    if project.get("dates"):
        return str(project["dates"])
    if not surveyed:
        return "not known: the times of the points have no dates"
    first, last = _minutes(surveyed["first"]), _minutes(surveyed["last"])
    return first if first == last else f"{first} to {last}"


def head(report: Report) -> str:
    """Title and project."""
    project = report.get("project") or {}
    facts = [(NAMES[key], str(project[key])) for key in NAMES if project.get(key)]
    facts.append(("flown", dates(report)))
    return f"<h1>{text(name(report) or 'Total propagated uncertainty of the survey')}</h1>" + definitions(facts)


def foot(report: Report) -> str:
    """What stands at the foot of printed pages."""
    surveyed = report.get("surveyed")
    project = report.get("project") or {}
    when = str(project.get("dates") or (surveyed["first"][:10] if surveyed else ""))
    return " – ".join(each for each in (name(report) or "Uncertainty of a survey", str(project.get("number", "")), when)
                      if each)


def signatures(report: Report) -> str:
    """Lines to sign on."""
    surveyor = str((report.get("project") or {}).get("surveyor", ""))
    made = text(f"{report['program']} {report['program_version']}")
    return ("<h2>Signature</h2><p class='soft'>The statements above are those of " + made + " from the files and"
            " numbers listed here. What it does not test is for the surveyor to show.</p>"
            f"<div class='signatures'><div>Place, date</div><div>{text(surveyor or 'Surveyor')}</div></div>")


def _minutes(utc: str) -> str:
    return utc[:16].replace("T", " ") + " UTC"
