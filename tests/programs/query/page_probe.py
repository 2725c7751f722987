"""What a browser says of a page of ours: Chromium without a window."""

import json
import os
import re
import subprocess

PROBE = """<script>addEventListener('load', () => { document.body.dataset.probe = JSON.stringify({
  width: innerWidth, content: document.documentElement.scrollWidth,
  broken: [...document.images].filter(image => !(image.complete && image.naturalWidth)).length,
  images: document.images.length, below: document.querySelector('.verdict').getBoundingClientRect().bottom,
  first: (table => { if (!table) return null; table.querySelector('th').click();
                     return table.tBodies[0].rows[0].cells[0].textContent; })(document.querySelector('.sortable'))
}); });</script>"""


def probe(page, folder, width, height):
    """Its width, that of its content, the pictures that it could not show, where the verdict ends, and what comes first
    in the first table that can be sorted after a click on its first head. Leaves WIDTH.png in `folder`."""
    probed = folder / "probe.html"
    probed.write_text(page.read_text().replace("</body>", PROBE + "</body>"))
    result = subprocess.run(
        ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-quic",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
         f"--user-data-dir={folder / 'browser'}", f"--window-size={width},{height}",
         f"--screenshot={folder / f'{width}.png'}", "--dump-dom", f"file://{probed}"],
        check=True, capture_output=True, text=True, timeout=120, env={**os.environ, "HOME": str(folder)})
    found = re.search(r'data-probe="([^"]*)"', result.stdout)
    if found is None:
        raise AssertionError(result.stderr)
    return json.loads(found.group(1).replace("&quot;", '"'))
