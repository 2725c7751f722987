"""What all pages share: the document with its style, text and numbers in HTML, tables."""

from __future__ import annotations

import html
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


def write_document(path: pathlib.Path, title: str, body: str) -> None:
    """A page that needs nothing from outside."""
    script = f"\n<script>{SCRIPT}</script>" if '"sortable"' in body else ""
    path.write_text(
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{text(title)}</title><style>{STYLE}</style></head><body>{body}"
        f"{script}</body></html>\n", encoding="utf-8")


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


def table(head: list[str], rows: list[list[str]], kind: str = "") -> str:
    """A table in HTML, of cells that are HTML, which scrolls sideways by itself where it is too wide."""
    cells = "".join(f"<th>{each}</th>" for each in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return (f'<div class="wide"><table class="{kind}"><thead><tr>{cells}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def verdict_box(standing: str, sentence: str, points: list[str]) -> str:
    """What the reader wants to know first. `standing`: "pass", "open" or "fail". `points` are HTML."""
    items = "".join(f"<li>{each}</li>" for each in points)
    return f'<div class="verdict {standing}"><b>{text(sentence)}</b><ul>{items}</ul></div>'


def numbers_table(numbers: list[dict[str, Any]]) -> str:
    """The numbers of a budget with their sources; those that were assumed first."""
    rows = [[text(each["name"].replace("_", " ")), text(each.get("value", "")),
             "<span class='no'>assumed</span>" if each.get("assumed") else "", text(each.get("source", ""))]
            for each in sorted(numbers, key=lambda each: not each.get("assumed"))]
    return table(["number", "value", "", "source"], rows, "words")
