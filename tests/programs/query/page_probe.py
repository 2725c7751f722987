"""What a browser says of a page of ours: Chromium without a window."""

import json
import os
import re
import subprocess

CHROMIUM = ("chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-quic",
            "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars")
PROBE = """<script>addEventListener('load', () => { document.body.dataset.probe = JSON.stringify({
  width: innerWidth, content: document.documentElement.scrollWidth,
  broken: [...document.images].filter(image => !(image.complete && image.naturalWidth)).length,
  cut: [...document.querySelectorAll('.wide')].filter(each => each.scrollWidth > each.clientWidth + 1)
    .map(each => each.textContent.slice(0, 60)),
  images: document.images.length, below: document.querySelector('.verdict').getBoundingClientRect().bottom,
  first: (table => { if (!table) return null; table.querySelector('th').click();
                     return table.tBodies[0].rows[0].cells[0].textContent; })(document.querySelector('.sortable'))
}); });</script>"""


def probe(page, folder, width, height, printed=False):
    """Its width, that of its content, the tables that are wider than their place, the pictures that it could not show,
    where the verdict ends, and what comes first in the first table that can be sorted after a click on its first head.
    Leaves WIDTH.png in `folder`. `printed`: in the style of paper."""
    probed = folder / "probe.html"
    text = page.read_text().replace("</body>", PROBE + "</body>")
    probed.write_text(text.replace("@media print", "@media all") if printed else text)
    result = subprocess.run(
        [*CHROMIUM, f"--user-data-dir={folder / 'browser'}", f"--window-size={width},{height}",
         f"--screenshot={folder / f'{width}.png'}", "--dump-dom", f"file://{probed}"],
        check=True, capture_output=True, text=True, timeout=120, env={**os.environ, "HOME": str(folder)})
    found = re.search(r'data-probe="([^"]*)"', result.stdout)
    if found is None:
        raise AssertionError(result.stderr)
    return json.loads(found.group(1).replace("&quot;", '"'))


def print_page(page, folder, paper):
    """The pages of it on `paper` ("A4", "letter"), as text each."""
    probed, made = folder / "printed.html", folder / f"{paper}.pdf"
    probed.write_text(page.read_text().replace("@page {", f"@page {{ size: {paper};"))
    subprocess.run([*CHROMIUM, f"--user-data-dir={folder / 'browser'}", f"--print-to-pdf={made}",
                    "--no-pdf-header-footer", f"file://{probed}"],
                   check=True, capture_output=True, timeout=120, env={**os.environ, "HOME": str(folder)})
    text = subprocess.run(["pdftotext", "-layout", made, "-"], check=True, capture_output=True, text=True).stdout
    return text.rstrip("\f").split("\f")
