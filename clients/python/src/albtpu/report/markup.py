"""What all pages share: the document with its style, text and numbers in HTML, tables."""

from __future__ import annotations

import html
import os
import pathlib
from typing import Any

STYLE = """
:root { --ink: #1a1a1a; --soft: #5a5a5a; --line: #d5d5d5; --good: #006d4f; --open: #7d6100;
        --bad: #a63d00; }
* { box-sizing: border-box; }
body { font: 16px/1.45 system-ui, sans-serif; color: var(--ink); margin: 0 auto; padding: 0 16px 48px;
       max-width: 1240px; background: #fff; }
h1 { font-size: 1.35rem; margin: 16px 0 8px; }
h2 { font-size: 1.15rem; margin: 32px 0 8px; border-top: 1px solid var(--line); padding-top: 16px; }
h3 { font-size: 1rem; margin: 20px 0 4px; }
.verdict { border-left: 8px solid; padding: 10px 16px; background: #f6f6f6; }
.verdict b { font-size: 1.5rem; }
.pass { border-color: var(--good); } .pass b { color: var(--good); }
.open { border-color: var(--open); } .open b { color: var(--open); }
.fail { border-color: var(--bad); } .fail b { color: var(--bad); }
.verdict ul { margin: 8px 0 0; padding-left: 20px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 380px), 1fr)); gap: 12px;
            align-items: start; }
img { max-width: 100%; height: auto; display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin-bottom: 8px; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 7px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { white-space: normal; vertical-align: bottom; }
.group { text-align: center; border-left: 1px solid var(--line); }
th:first-child, td:first-child, .words td, .words th { text-align: left; }
.words td { white-space: normal; overflow-wrap: anywhere; }
.sortable th { cursor: pointer; } .sortable th:focus { outline: 2px solid #0072b2; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 215px), 1fr)); gap: 12px;
         margin: 12px 0; }
.tile { border-top: 4px solid var(--line); background: #f6f6f6; padding: 8px 12px; break-inside: avoid; }
.tile b { display: block; font-size: 1.5rem; }
.tile p { margin: 4px 0 0; font-size: 0.9rem; }
.titles { display: grid; grid-template-columns: max-content 1fr; gap: 2px 16px; margin: 8px 0; }
.titles dt { color: var(--soft); } .titles dd { margin: 0; overflow-wrap: anywhere; }
.signatures { display: grid; grid-template-columns: 1fr 1fr; gap: 32px; margin: 40px 0 8px; break-inside: avoid; }
.signatures div { border-top: 1px solid var(--ink); padding-top: 4px; }
.soft, caption { color: var(--soft); font-size: 0.9rem; text-align: left; }
.unbroken { white-space: nowrap; overflow-wrap: normal; }
.no { color: var(--bad); font-weight: 600; white-space: nowrap; overflow-wrap: normal; }
.matrix { font-size: 0.8rem; } .matrix th, .matrix td { padding: 3px 4px; }
.matrix td:first-child { white-space: normal; overflow-wrap: anywhere; min-width: 4.5em; }
@media print {
  html { font-size: 10pt; } .screen { display: none; } .soft { break-after: avoid; }
  body { max-width: none; padding: 0; font-size: 10pt; } h2, h3 { break-after: avoid; }
  img, tr { break-inside: avoid; } thead { display: table-header-group; }
  .wide { overflow: visible; } table { font-size: 7.5pt; max-width: 100%; } th, td { padding: 2px 4px; }
  .matrix { font-size: 6pt; table-layout: fixed; width: 100%; }
  .matrix th, .matrix td { padding: 1px 2px; white-space: normal; overflow-wrap: anywhere; hyphens: auto; }
  .pictures { grid-template-columns: 1fr 1fr; } .tiles { grid-template-columns: 1fr 1fr 1fr; }
  .tile b, .verdict b { font-size: 1.2rem; }
}
"""

# Of printed pages: what stands at their feet, and a margin for it.
PAGES = """
@page {{ margin: 16mm 14mm 18mm; @bottom-left {{ content: {foot}; font: 8pt system-ui, sans-serif; color: #5a5a5a; }}
         @bottom-right {{ content: "page " counter(page) " of " counter(pages); font: 8pt system-ui, sans-serif;
                          color: #5a5a5a; }} }}
"""

SCRIPT = """
document.querySelectorAll('.sortable').forEach(table => {
  const body = table.tBodies[0];
  const heads = table.tHead.rows[table.tHead.rows.length - 1].querySelectorAll('th');
  heads.forEach((head, column) => {
    head.tabIndex = 0;
    head.title = 'sort';
    const sort = () => {
      const up = head.getAttribute('aria-sort') !== 'ascending';
      heads.forEach(other => other.removeAttribute('aria-sort'));
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


def line_name(of: dict[str, Any], end: str = "") -> str:
    """A flight line, or one `end` of a difference of two, by its ID; where that stands for several, with its begin."""
    name, begin = str(of[end or "line"]), of.get(f"{end}_begin" if end else "begin")
    return name if begin is None else f"{name} from {begin:.0f} s on"


def write_document(path: pathlib.Path, title: str, body: str, foot: str = "") -> None:
    """A page that needs nothing from outside. `foot` stands at the foot of printed pages, beside their number. An
    earlier page is replaced by a whole one, or stays."""
    pages = PAGES.format(foot=_css_string(foot or title))
    script = f"\n<script>{SCRIPT}</script>" if '"sortable"' in body else ""
    _replace(
        path, '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{text(title)}</title><style>{STYLE}{pages}</style></head><body>{body}"
        f"{script}</body></html>\n")


def _replace(path: pathlib.Path, content: str) -> None:
    path = path.resolve()  # A link stays one.
    written = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        written.write_text(content, encoding="utf-8")
        os.replace(written, path)
    except BaseException:
        written.unlink(missing_ok=True)
        raise


def _css_string(words: str) -> str:
    """Quoted for a style sheet, in which no tag may end."""
    return '"' + "".join(each if each.isalnum() or each in " .,:;-–_()/" and each != "/" else f"\\{ord(each):x} "
                         for each in words) + '"'


def text(value: object) -> str:
    return html.escape(str(value))


def percent(part: float, digits: int = 1) -> str:
    """Never "100 %" of a part that is not all, nor "0 %" of one that is something."""
    shown = f"{100 * part:.{digits}f}"
    if part < 1 and float(shown) >= 100:
        return f"> {100 - 10 ** -digits:.{digits}f} %"
    if part > 0 and float(shown) <= 0:
        return f"< {10 ** -digits:.{digits}f} %"
    return f"{shown} %"


def table(head: list[str], rows: list[list[str]], kind: str = "", groups: list[tuple[str, int]] | None = None) -> str:
    """A table in HTML, of cells that are HTML, which scrolls sideways by itself where it is too wide. `groups` stand
    above the heads of as many columns each."""
    above = "".join(f'<th class="group" colspan="{columns}">{name}</th>' for name, columns in groups or [])
    above = f"<tr>{above}</tr>" if above else ""
    cells = "".join(f"<th>{each}</th>" for each in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return (f'<div class="wide"><table class="{kind}"><thead>{above}<tr>{cells}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def tiles(facts: list[tuple[str, str, str]]) -> str:
    """Titles with a large number each and what it is."""
    return '<div class="tiles">' + "".join(
        f'<div class="tile">{text(title)}<b>{text(number)}</b><p>{text(words)}</p></div>'
        for title, number, words in facts) + "</div>"


def definitions(facts: list[tuple[str, str]]) -> str:
    """Names and what they are."""
    return '<dl class="titles">' + "".join(f"<dt>{text(name)}</dt><dd>{text(value)}</dd>"
                                           for name, value in facts) + "</dl>"


def verdict_box(standing: str, sentence: str, points: list[str]) -> str:
    """What the reader wants to know first. `standing`: "pass", "open" or "fail". `points` are HTML."""
    items = "".join(f"<li>{each}</li>" for each in points)
    return f'<div class="verdict {standing}"><b>{text(sentence)}</b><ul>{items}</ul></div>'


def numbers_table(numbers: list[dict[str, Any]]) -> str:
    """The numbers of a budget with their sources; those that were assumed first."""
    rows = [[text(each["name"].replace("_", " ")), text(each.get("value", "")),
             "<span class='no'>assumed</span>" if each.get("assumed") else "",
             text(str(each.get("source", "")).removeprefix("assumed: "))]
            for each in sorted(numbers, key=lambda each: not each.get("assumed"))]
    return table(["number", "value", "", "source"], rows, "words")
