"""The report of `albtpu-generate validate --quick`.

Usage: validate_test.py ALBTPU_GENERATE
"""

import csv
import html.parser
import importlib.util
import re
import shutil
import sys
import unittest

from commands import make_folder, run

GENERATE = sys.argv[1]


def validate(*arguments):
    return run(GENERATE, "validate", *arguments, timeout=None)


class Page(html.parser.HTMLParser):
    """Collects the references of the page, and checks that its elements are nested correctly."""

    VOID = {"meta", "img", "br", "link"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.anchors, self.images, self.foreign = [], set(), set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag not in self.VOID:
            self.open.append(tag)
        self.ids.add(attributes.get("id"))
        for name in ("href", "src"):
            target = attributes.get(name, "")
            if target.startswith("#"):
                self.anchors.add(target[1:])
            elif target.startswith("data:"):
                self.images.append(attributes)
            elif target:
                self.foreign.append(target)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup) / "a report"
        cls.made = validate("--quick", "--output", cls.folder)
        assert cls.made.returncode == 0, cls.made.stderr
        cls.text = (cls.folder / "report.html").read_text()
        cls.page = Page(cls.text)

    def summary(self):
        with open(self.folder / "summary.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_is_a_single_page_without_external_references(self):
        self.assertEqual(self.page.open, [])
        self.assertEqual(self.page.foreign, [])
        self.assertLessEqual(self.page.anchors, self.page.ids)

    def test_counts_its_verdicts(self):
        verdicts = [line["verdict"] for line in self.summary()]
        counts = {verdict: str(verdicts.count(verdict)) for verdict in ("agrees", "differs", "reported")}
        self.assertEqual(dict(line.split() for line in self.made.stdout.splitlines()), counts)

    def test_states_the_basis_of_every_comparison(self):
        for line in self.summary():
            self.assertTrue(line["basis"], line)
            self.assertTrue(line["ours"], line)
            if line["published"]:
                self.assertAlmostEqual(float(line["difference"]), float(line["ours"]) - float(line["published"]),
                                       delta=1e-6 * max(1, abs(float(line["published"]))))

    def test_has_every_table_and_figure_of_the_paper(self):
        studies = {line["study"] for line in self.summary()}
        for study in ("figures_2_and_3", "table_2", "table_3", "table_4", "table_5"):
            self.assertIn(study, studies)
        for table in self.folder.glob("*.csv"):
            rows = list(csv.reader(open(table, newline="")))
            self.assertGreater(len(rows), 1, table.name)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, table.name)

    def test_contains_its_figures(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.assertIn("Figures are missing", self.text)
            self.skipTest("matplotlib is missing; apt-get install python3-matplotlib")
        self.assertNotIn("is missing", self.text)
        self.assertEqual(len(self.page.images), len(list(self.folder.glob("*.svg"))))
        for image in self.page.images:
            self.assertGreater(len(image["alt"]), 20)

    def test_fits_the_screens_of_a_phone_and_a_desktop(self):
        browser = shutil.which("chromium")
        if browser is None:
            self.skipTest("chromium is missing; apt-get install chromium")
        for width in (390, 1280):
            frame = self.folder / "frame.html"
            frame.write_text(
                f'<iframe id="f" src="report.html" style="width:{width}px;height:800px;border:0"></iframe>'
                "<p id=seen></p><script>f.onload = () => { const page = f.contentDocument.documentElement;"
                "seen.textContent = `widths ${page.scrollWidth} ${page.clientWidth}`; }</script>")
            seen = run(browser, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files",
                       "--virtual-time-budget=20000", "--dump-dom", frame.as_uri()).stdout
            frame.unlink()
            scroll, client = map(int, re.search(r"widths (\d+) (\d+)", seen).groups())
            self.assertLessEqual(scroll, client, f"wider than {width} pixels")

    def test_is_replaced_only_with_overwrite(self):
        before = (self.folder / "report.html").stat().st_mtime_ns
        again = validate("--quick", "--output", self.folder)
        self.assertEqual(again.returncode, 1)
        self.assertIn("is not empty; give another folder, or replace an earlier report by --overwrite", again.stderr)
        self.assertEqual((self.folder / "report.html").stat().st_mtime_ns, before)

    def test_is_not_started_if_it_cannot_be_written(self):
        for output, code in ((self.folder / "none" / "deeper", 1), (self.folder / "summary.csv", 1)):
            run = validate("--output", output)
            self.assertEqual(run.returncode, code, run.stderr)
            self.assertNotIn("study 1", run.stderr)
        self.assertEqual(validate().returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
